/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "picture_file.h"

#include "bridge/colour_label.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool wo_picture_exists(const char *pattern, int frame)
{
    char path[PATH_MAX];
    return wo_io_frame_path(pattern, frame, path, sizeof path, NULL) == WO_OK &&
           access(path, F_OK) == 0;
}

wo_status wo_picture_split(const char *text, int frame, char **file, char **channels,
                           wo_error *error)
{
    const size_t whole = strlen(text), first = strcspn(text, ":");
    *channels = NULL;
    *file = malloc(whole + 1);
    if (!*file)
        return wo_fail(error, WO_ERR_NOMEM, "out of memory for a file name");
    size_t length = first;
    for (;;) {
        memcpy(*file, text, length);
        (*file)[length] = '\0';
        if (wo_picture_exists(*file, frame))
            break;
        if (length == whole) {
            length = first;
            (*file)[length] = '\0';
            break;
        }
        length += 1 + strcspn(text + length + 1, ":");
    }
    *channels = strdup(text + length + (length < whole));
    if (*channels)
        return WO_OK;
    free(*file);
    *file = NULL;
    return wo_fail(error, WO_ERR_NOMEM, "out of memory for channel names");
}

/* Component c from a pixel that has many. */
static float component(const float *pixel, int many, int c)
{
    if (c == 3)
        return many == 4 ? pixel[3] : 1;
    return pixel[many > 2 ? c : 0];
}

wo_status wo_picture_components(wo_image *image, int components, wo_error *error)
{
    const int many = image->components;
    if (many == components)
        return WO_OK;
    const size_t count = (size_t)components, row = (size_t)wo_rect_width(image->bounds);
    const size_t pixels = row * (size_t)wo_rect_height(image->bounds);
    float *const made = malloc(pixels * count * sizeof *made);
    if (!made)
        return wo_fail(error, WO_ERR_NOMEM, "out of memory for a picture of %zu pixels", pixels);
    for (size_t i = 0; i < pixels; i++)
        for (size_t c = 0; c < count; c++)
            made[i * count + c] = component(image->data + i * (size_t)many, many, (int)c);
    free(image->data);
    image->data = made;
    image->components = components;
    image->row_bytes = (ptrdiff_t)(row * count * sizeof *made);
    return WO_OK;
}

wo_status wo_picture_linear(const wo_colour *colour, const wo_io_file *file, size_t part,
                            const char *space, wo_image *image, wo_error *error)
{
    const wo_io_attribute *const said =
        wo_io_part_find(&file->parts[part], "oiio:UnassociatedAlpha");
    const bool straight = said && said->type != WO_IO_TEXT && said->number != 0;
    const bool silent = strcmp(file->format, "dpx") == 0 || strcmp(file->format, "cineon") == 0;
    if (image->components == 1)
        WO_TRY(wo_picture_components(image, 3, error));
    if (!straight && !silent)
        return wo_colour_convert(colour, space, WO_COLOUR_WORKING, image, error);
    WO_TRY(wo_colour_convert_straight(colour, space, WO_COLOUR_WORKING, image, error));
    if (straight)
        wo_io_premultiply(image);
    return WO_OK;
}

static wo_status load(const wo_colour *colour, const char *space, const char *path,
                      const char *channels, wo_io_file **file, wo_image *image, wo_error *error)
{
    const wo_io_part *part = NULL;
    char name[256];
    WO_TRY(wo_io_read(path, false, file, error));
    WO_TRY(wo_io_select(*file, channels, image, &part, error));
    if (!space) {
        WO_TRY(wo_label_space(colour, path, part, name, sizeof name, NULL, error));
        space = name;
    }
    return wo_picture_linear(colour, *file, (size_t)(part - (*file)->parts), space, image, error);
}

wo_status wo_picture_load(const wo_colour *colour, const char *space, const char *text,
                          wo_image *image, wo_error *error)
{
    char *path, *channels;
    wo_io_file *file = NULL;
    *image = (wo_image){0};
    WO_TRY(wo_picture_split(text, 1, &path, &channels, error));
    const wo_status status = load(colour, space, path, channels, &file, image, error);
    wo_io_file_destroy(&file);
    free(path);
    free(channels);
    if (status != WO_OK) {
        free(image->data);
        *image = (wo_image){0};
    }
    return status;
}

wo_status wo_picture_save(const char *path, const wo_image *image, wo_error *error)
{
    static const char *const names[] = {"R", "G", "B"};
    wo_io_part part = {0};
    wo_status status = wo_io_part_init(&part, NULL, image->bounds, image->bounds, names, 3, error);
    if (status == WO_OK) {
        const size_t row = (size_t)wo_rect_width(image->bounds) * 3;
        for (int y = image->bounds.y1; y < image->bounds.y2; y++)
            memcpy(part.pixels + (size_t)(y - image->bounds.y1) * row,
                   wo_image_at(image, image->bounds.x1, y), row * sizeof(float));
        status = wo_io_write(path, &part, 1, WO_IO_AUTO, error);
    }
    wo_io_part_clear(&part);
    return status;
}

wo_status wo_picture_check_space(const wo_colour *colour, const char *space, wo_error *error)
{
    float pixel[3] = {0.5f, 0.5f, 0.5f};
    wo_image image = {pixel, {0, 0, 1, 1}, sizeof pixel, 3};
    return space ? wo_colour_convert(colour, space, WO_COLOUR_WORKING, &image, error) : WO_OK;
}
