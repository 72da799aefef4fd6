/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "pencil_map_file.h"

#include "bridge/image_io.h"

#include <stdio.h>
#include <string.h>

#define LOW   "wideopen:pencilLow"
#define HIGH  "wideopen:pencilHigh"
#define SCALE "wideopen:pencilScale"

enum { NAME = 8 };

static void channel_name(int line, char name[NAME])
{
    snprintf(name, NAME, "L%03d", line % 1000);
}

static wo_status set_double(wo_io_part *part, const char *name, double value, wo_error *error)
{
    char key[64], kind[] = "double";
    snprintf(key, sizeof key, "%s", name);
    const wo_io_attribute attribute = {key, WO_IO_FLOAT, value, NULL, kind};
    return wo_io_part_set(part, &attribute, error);
}

static void wavelength_name(int line, char name[32])
{
    snprintf(name, 32, "wideopen:pencilL%03d", line % 1000);
}

static wo_status set_scales(wo_io_part *part, const wo_pencil_map *map, wo_error *error)
{
    WO_TRY(set_double(part, LOW, map->v_low, error));
    WO_TRY(set_double(part, HIGH, map->v_high, error));
    WO_TRY(set_double(part, SCALE, map->k, error));
    for (int l = 0; l < map->lines; l++) {
        char name[32];
        wavelength_name(l, name);
        WO_TRY(set_double(part, name, map->nm[l], error));
    }
    return WO_OK;
}

static wo_status init_parts(wo_io_part parts[2], const wo_pencil_map *map, wo_error *error)
{
    char names[WO_PENCIL_LINES_MAX][NAME];
    const char *channels[WO_PENCIL_LINES_MAX];
    for (int l = 0; l < map->lines; l++) {
        channel_name(l, names[l]);
        channels[l] = names[l];
    }
    const wo_rect wide = {0, 0, map->radii, map->distances};
    const wo_rect narrow = {0, 0, 1, map->distances};
    WO_TRY(wo_io_part_init(&parts[0], "density", wide, wide, channels, map->lines, error));
    WO_TRY(wo_io_part_init(&parts[1], "height", narrow, wide, channels, map->lines, error));
    return set_scales(&parts[0], map, error);
}

wo_status wo_pencil_map_save(const char *path, const wo_pencil_map *map, wo_error *error)
{
    WO_TRY(wo_pencil_map_validate(map, error));
    wo_io_part parts[2] = {{0}, {0}};
    wo_status status = init_parts(parts, map, error);
    if (status == WO_OK) {
        const size_t lines = (size_t)map->lines;
        const size_t rows = (size_t)map->distances;
        const size_t pixels = rows * (size_t)map->radii;
        for (size_t l = 0; l < lines; l++) {
            for (size_t i = 0; i < pixels; i++)
                parts[0].pixels[i * lines + l] = map->density[l * pixels + i];
            for (size_t i = 0; i < rows; i++)
                parts[1].pixels[i * lines + l] = (float)map->height[l * rows + i];
        }
        status = wo_io_write(path, parts, 2, WO_IO_SINGLE, error);
    }
    wo_io_part_clear(&parts[0]);
    wo_io_part_clear(&parts[1]);
    return status;
}

static const wo_io_part *find_part(const wo_io_file *file, const char *name)
{
    for (size_t i = 0; i < file->part_count; i++)
        if (strcmp(file->parts[i].name, name) == 0)
            return &file->parts[i];
    return NULL;
}

static wo_status get_number(const wo_io_part *part, const char *name, double *value,
                            wo_error *error)
{
    const wo_io_attribute *const a = wo_io_part_find(part, name);
    if (!a || a->type == WO_IO_TEXT)
        return wo_fail(error, WO_ERR_FORMAT, "no pencil map: the number %s is missing", name);
    *value = a->number;
    return WO_OK;
}

/* Which channel of the part holds this wavelength; -1 for none. */
static int find_channel(const wo_io_part *part, int line)
{
    char name[NAME];
    channel_name(line, name);
    for (int i = 0; i < part->channels; i++)
        if (strcmp(part->channel_names[i], name) == 0)
            return i;
    return -1;
}

static wo_status check_shape(const wo_io_part *density, const wo_io_part *height, wo_error *error)
{
    if (!density || !height)
        return wo_fail(error, WO_ERR_FORMAT,
                       "no pencil map: it must have the parts density and height");
    const wo_rect wide = density->data_window, narrow = height->data_window;
    if (wo_rect_width(narrow) != 1 || wo_rect_height(narrow) != wo_rect_height(wide) ||
        height->channels != density->channels)
        return wo_fail(error, WO_ERR_FORMAT,
                       "no pencil map: the part height must be 1 wide, as high as density (%d) and "
                       "of as many channels (%d)",
                       wo_rect_height(wide), density->channels);
    return WO_OK;
}

static wo_status fill(const wo_io_part *density, const wo_io_part *height, wo_pencil_map *map,
                      wo_error *error)
{
    WO_TRY(get_number(density, LOW, &map->v_low, error));
    WO_TRY(get_number(density, HIGH, &map->v_high, error));
    WO_TRY(get_number(density, SCALE, &map->k, error));
    for (int l = 0; l < map->lines; l++) {
        char name[32];
        wavelength_name(l, name);
        WO_TRY(get_number(density, name, &map->nm[l], error));
    }
    const size_t channels = (size_t)map->lines;
    const size_t rows = (size_t)map->distances;
    const size_t pixels = rows * (size_t)map->radii;
    for (int l = 0; l < map->lines; l++) {
        const int from = find_channel(density, l), beside = find_channel(height, l);
        if (from < 0 || beside < 0)
            return wo_fail(error, WO_ERR_FORMAT,
                           "no pencil map: channels must be called L000, L001 and so on");
        for (size_t i = 0; i < pixels; i++)
            map->density[(size_t)l * pixels + i] = density->pixels[i * channels + (size_t)from];
        for (size_t i = 0; i < rows; i++)
            map->height[(size_t)l * rows + i] =
                (double)height->pixels[i * channels + (size_t)beside];
    }
    wo_error found = {WO_OK, ""};
    if (wo_pencil_map_validate(map, &found) != WO_OK)
        return wo_fail(error, WO_ERR_FORMAT, "no pencil map: %s", found.text);
    return WO_OK;
}

static wo_status load(const wo_context *context, const wo_io_file *file, wo_pencil_map **map,
                      wo_error *error)
{
    const wo_io_part *const density = find_part(file, "density");
    const wo_io_part *const height = find_part(file, "height");
    WO_TRY(check_shape(density, height, error));
    for (size_t i = 0; i < file->part_count; i++)
        if (file->parts[i].fault)
            return wo_fail(error, WO_ERR_FORMAT, "%s", file->parts[i].fault);
    wo_error found = {WO_OK, ""};
    const wo_status status =
        wo_pencil_map_new(context, wo_rect_height(density->data_window),
                          wo_rect_width(density->data_window), density->channels, map, &found);
    if (status != WO_OK)
        return wo_fail(error, status == WO_ERR_RANGE ? WO_ERR_FORMAT : status, "%s", found.text);
    return fill(density, height, *map, error);
}

wo_status wo_pencil_map_load(const wo_context *context, const char *path, wo_pencil_map **map,
                             wo_error *error)
{
    *map = NULL;
    wo_io_file *file = NULL;
    WO_TRY(wo_io_read(path, false, &file, error));
    const wo_status status = load(context, file, map, error);
    wo_io_file_destroy(&file);
    if (status != WO_OK)
        wo_pencil_map_destroy(context, map);
    return status;
}
