/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "io_exr_private.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Headers, and which pixels are read. */

/* Channel order. */

typedef struct place {
    const char *name;
    int index;     /* in the file */
    int component; /* 0 R, 1 G, 2 B, 3 A, 4 anything else */
    bool chroma;
} place;

/* Layers by name, the nameless one first; R G B A lead inside a layer. */
static int compare_places(const void *left, const void *right)
{
    const place *const a = left, *const b = right;
    const size_t length_a = wo_io_layer_length(a->name), length_b = wo_io_layer_length(b->name);
    const size_t shorter = length_a < length_b ? length_a : length_b;
    const int layer = memcmp(a->name, b->name, shorter);
    if (layer)
        return layer;
    if (length_a != length_b)
        return length_a < length_b ? -1 : 1;
    if (a->component != b->component)
        return a->component - b->component;
    const int name = strcmp(a->name, b->name);
    return name ? name : a->index - b->index;
}

static place place_of(const exr_attr_chlist_t *list, int index)
{
    const char *const name = list->entries[index].name.str;
    place made = {name, index, wo_io_component(name), wo_exr_is_chroma(list, name)};
    const size_t length = strlen(name);
    if (made.chroma) /* .RY, .Y or .BY */
        made.component = length < 2 || name[length - 2] == '.' ? 1
                         : name[length - 2] == 'R'             ? 0
                                                               : 2;
    return made;
}

/* Windows. */

static wo_status part_windows(const wo_exr_stream *stream, exr_const_context_t exr, int index,
                              wo_rect *data, wo_rect *display, wo_error *error)
{
    exr_attr_box2i_t inner, outer;
    WO_EXR_TRY(stream, exr_get_data_window(exr, index, &inner));
    WO_EXR_TRY(stream, exr_get_display_window(exr, index, &outer));
    const int64_t values[8] = {(int64_t)inner.min.x - outer.min.x,
                               (int64_t)outer.max.y - inner.max.y,
                               (int64_t)inner.max.x - outer.min.x + 1,
                               (int64_t)outer.max.y - inner.min.y + 1,
                               0,
                               0,
                               (int64_t)outer.max.x - outer.min.x + 1,
                               (int64_t)outer.max.y - outer.min.y + 1};
    int32_t cut[8];
    for (int i = 0; i < 8; i++)
        cut[i] = (int32_t)(values[i] < INT32_MIN   ? INT32_MIN
                           : values[i] > INT32_MAX ? INT32_MAX
                                                   : values[i]);
    *data = (wo_rect){cut[0], cut[1], cut[2], cut[3]};
    *display = (wo_rect){cut[4], cut[5], cut[6], cut[7]};
    return WO_OK;
}

/* "RY" to "R", "Y" to "G", "BY" to "B". */
static void name_as_colour(char *name, int component)
{
    char *const last = name + strlen(name) - 1;
    if (component == 1)
        *last = 'G';
    else
        *last = '\0';
}

/* Header of one part; channels is the list in file order, malloc-ed. */
static wo_status read_head(const wo_exr_stream *stream, exr_const_context_t exr, int index,
                           wo_io_part *part, wo_exr_channel **channels, uint64_t *bytes,
                           wo_error *error)
{
    const exr_attr_chlist_t *list = NULL;
    const char *name = NULL;
    float aspect = 1;
    wo_rect data, display;

    *channels = NULL;
    WO_TRY(part_windows(stream, exr, index, &data, &display, error));
    WO_EXR_TRY(stream, exr_get_channels(exr, index, &list));
    WO_EXR_TRY(stream, exr_get_pixel_aspect_ratio(exr, index, &aspect));
    if (exr_get_name(exr, index, &name) != EXR_ERR_SUCCESS)
        name = NULL;
    WO_TRY(wo_io_check_size(stream->path, data, display, list->num_channels, bytes, error));

    const size_t count = (size_t)list->num_channels;
    place *const places = calloc(count, sizeof *places);
    const char **const names = calloc(count, sizeof *names);
    *channels = calloc(count, sizeof **channels);
    wo_status status = WO_OK;
    if (!places || !names || !*channels)
        status = wo_fail(error, WO_ERR_NOMEM, "no memory for %zu channels", count);
    for (size_t i = 0; status == WO_OK && i < count; i++)
        places[i] = place_of(list, (int)i);
    if (status == WO_OK) {
        qsort(places, count, sizeof *places, compare_places);
        for (size_t i = 0; i < count; i++) {
            const exr_attr_chlist_entry_t *const entry = &list->entries[places[i].index];
            names[i] = places[i].name;
            (*channels)[places[i].index] =
                (wo_exr_channel){.target = (int)i,
                                 .type = entry->pixel_type,
                                 .bytes = entry->pixel_type == EXR_PIXEL_HALF ? 2 : 4,
                                 .chroma = places[i].chroma && places[i].component == 0,
                                 .x_sampling = entry->x_sampling,
                                 .y_sampling = entry->y_sampling};
        }
        status = wo_io_part_head(part, name, data, display, names, (int)count, error);
        for (size_t i = 0; status == WO_OK && i < count; i++)
            if (places[i].chroma)
                name_as_colour(part->channel_names[i], places[i].component);
    }
    free(places);
    free((void *)names);
    WO_TRY(status);

    part->pixel_aspect = aspect > 0 && aspect < 1e6f ? (double)aspect : 1;
    part->bits = 16;
    part->is_float = false;
    for (size_t i = 0; i < count; i++) {
        const exr_attr_chlist_entry_t *const entry = &list->entries[i];
        if (entry->pixel_type != EXR_PIXEL_HALF)
            part->bits = 32;
        if (entry->pixel_type != EXR_PIXEL_UINT)
            part->is_float = true;
    }
    return wo_exr_read_attributes(stream, exr, index, part, error);
}

/* All headers; channels of each part, malloc-ed with their array. */
static wo_status read_heads(wo_exr_stream *stream, exr_const_context_t exr, wo_io_file **file,
                            wo_exr_channel ***channels, wo_error *error)
{
    int count = 0;
    uint64_t bytes = 0;
    WO_EXR_TRY(stream, exr_get_count(exr, &count));
    WO_TRY(wo_io_file_create(count > 0 ? (size_t)count : 0, file, error));
    *channels = calloc((size_t)count, sizeof **channels);
    free((*file)->format);
    (*file)->format = wo_io_copy_text("openexr");
    if (!(*file)->format || !*channels)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for an image file");
    for (int i = 0; i < count; i++)
        WO_TRY(read_head(stream, exr, i, &(*file)->parts[i], &(*channels)[i], &bytes, error));
    return WO_OK;
}

/* The pixels of every part. One that cannot be read has a fault, unless that is true of all. */
static wo_status read_parts(wo_exr_stream *stream, exr_const_context_t exr, wo_io_file *file,
                            wo_exr_channel *const *channels, wo_error *error)
{
    wo_error first = {0};
    bool any = false;
    for (size_t i = 0; i < file->part_count; i++) {
        wo_io_part *const part = &file->parts[i];
        wo_error own = {0};
        stream->words[0] = '\0';
        stream->system_error = 0;
        const wo_status status = wo_exr_read_pixels(stream, exr, (int)i, part, channels[i],
                                                    (size_t)part->channels, &own);
        any |= status == WO_OK;
        if (status == WO_OK)
            continue;
        if (status == WO_ERR_NOMEM)
            return wo_fail(error, status, "%s", own.text);
        if (!first.text[0])
            first = own;
        free(part->pixels);
        part->pixels = NULL;
        part->fault = wo_io_copy_text(own.text);
        if (!part->fault)
            return wo_fail(error, WO_ERR_NOMEM, "no memory for a text");
    }
    return any ? WO_OK : wo_fail(error, first.status, "%s", first.text);
}

/* The wanted channels of a part as a part of their own, and an image of it. */
static wo_status read_chosen(wo_exr_stream *stream, exr_const_context_t exr, int index,
                             const wo_io_choice *chosen, const wo_exr_channel *channels,
                             wo_image *image, wo_error *error)
{
    const wo_io_part *const whole = chosen->part;
    const size_t count = (size_t)whole->channels;
    const char **const names = calloc(count, sizeof *names);
    int *const places = calloc(count, sizeof *places);
    wo_exr_channel *const wanted = calloc(count, sizeof *wanted);
    wo_io_part part = {0};
    wo_io_choice own = {.part = &part, .count = chosen->count};
    int kept = 0;
    wo_status status = WO_OK;
    if (!names || !places || !wanted)
        status = wo_fail(error, WO_ERR_NOMEM, "no memory for %zu channels", count);
    for (size_t i = 0; status == WO_OK && i < count; i++) {
        bool keep = false;
        for (int k = 0; k < chosen->count; k++)
            keep |= chosen->channels[k] == (int)i;
        for (size_t c = 0; c < count; c++) /* R, G and B of chroma need each other */
            if (channels[c].chroma && (int)i >= channels[c].target &&
                (int)i < channels[c].target + 3)
                for (int k = 0; k < chosen->count; k++)
                    keep |= chosen->channels[k] >= channels[c].target &&
                            chosen->channels[k] < channels[c].target + 3;
        places[i] = keep ? kept : -1;
        if (keep)
            names[kept++] = whole->channel_names[i];
    }
    if (status == WO_OK)
        status = wo_io_part_head(&part, whole->name, whole->data_window, whole->display_window,
                                 names, kept, error);
    if (status == WO_OK) {
        for (size_t c = 0; c < count; c++) {
            wanted[c] = channels[c];
            wanted[c].target = places[channels[c].target];
        }
        for (int k = 0; k < chosen->count; k++)
            own.channels[k] = places[chosen->channels[k]];
        status = wo_exr_read_pixels(stream, exr, index, &part, wanted, count, error);
    }
    if (status == WO_OK)
        status = wo_io_copy_choice(&own, image, error);
    wo_io_part_clear(&part);
    free((void *)names);
    free(places);
    free(wanted);
    return status;
}

/* Deep pixels need each other, and the other library gives all channels at once. */
static bool can_leave_out(exr_const_context_t exr, int index)
{
    exr_storage_t storage;
    exr_compression_t compression;
    return exr_get_storage(exr, index, &storage) == EXR_ERR_SUCCESS &&
           exr_get_compression(exr, index, &compression) == EXR_ERR_SUCCESS &&
           (storage == EXR_STORAGE_SCANLINE || storage == EXR_STORAGE_TILED) &&
           compression < EXR_COMPRESSION_B44;
}

/* What is wanted of a file: headers, everything, or a view. */
typedef struct wish {
    bool headers_only;
    const char *channels; /* of the view */
    wo_image *image;      /* NULL = no view */
    size_t *part;
} wish;

static wo_status read_view(wo_exr_stream *stream, exr_const_context_t exr, const wish *wanted,
                           const wo_io_file *file, wo_exr_channel *const *channels, wo_error *error)
{
    wo_io_choice chosen;
    WO_TRY(wo_io_choose(file, wanted->channels, &chosen, error));
    const size_t index = (size_t)(chosen.part - file->parts);
    *wanted->part = index;
    if (can_leave_out(exr, (int)index))
        return read_chosen(stream, exr, (int)index, &chosen, channels[index], wanted->image, error);
    wo_io_part *const part = &file->parts[index];
    wo_status status = wo_exr_read_pixels(stream, exr, (int)index, part, channels[index],
                                          (size_t)part->channels, error);
    if (status == WO_OK)
        status = wo_io_copy_choice(&chosen, wanted->image, error);
    free(part->pixels);
    part->pixels = NULL;
    return status;
}

static wo_status read_wish(wo_exr_stream *stream, exr_const_context_t exr, const wish *wanted,
                           wo_io_file **file, wo_error *error)
{
    wo_exr_channel **channels = NULL;
    wo_status status = read_heads(stream, exr, file, &channels, error);
    if (status == WO_OK && wanted->image)
        status = read_view(stream, exr, wanted, *file, channels, error);
    else if (status == WO_OK && !wanted->headers_only)
        status = read_parts(stream, exr, *file, channels, error);
    for (size_t i = 0; channels && i < (*file)->part_count; i++)
        free(channels[i]);
    free((void *)channels);
    return status;
}

static wo_status read_stream(const char *path, int fd, const wish *wanted, wo_io_file **file,
                             wo_error *error)
{
    struct stat about;
    wo_exr_stream stream = {.path = path, .fd = fd};
    if (fstat(fd, &about))
        return wo_fail(error, WO_ERR_IO, "cannot read %s", wo_io_shown(path));
    stream.size = about.st_size;

    exr_context_t exr = NULL;
    wo_exr_begin(&stream);
    const exr_context_initializer_t settings = wo_exr_settings(&stream);
    const exr_result_t result = exr_start_read(&exr, path, &settings);
    wo_status status = WO_OK;
    if (result != EXR_ERR_SUCCESS)
        status = wo_exr_failure(&stream, result, error);
    else
        status = read_wish(&stream, exr, wanted, file, error);
    exr_finish(&exr);
    wo_exr_end();
    /* short of memory the library leaves things out and goes on */
    if (stream.no_memory)
        status = wo_exr_failure(&stream, EXR_ERR_OUT_OF_MEMORY, error);
    return status;
}

wo_status wo_io_exr_read(const char *path, int fd, bool headers_only, wo_io_file **file,
                         wo_error *error)
{
    const wish wanted = {.headers_only = headers_only};
    return read_stream(path, fd, &wanted, file, error);
}

wo_status wo_io_exr_read_view(const char *path, int fd, const char *channels, wo_io_file **file,
                              wo_image *image, size_t *part, wo_error *error)
{
    const wish wanted = {.channels = channels, .image = image, .part = part};
    const wo_status status = read_stream(path, fd, &wanted, file, error);
    if (status != WO_OK) {
        free(image->data);
        *image = (wo_image){0};
    }
    return status;
}
