/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "half.h"
#include "io_exr_private.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Samples lie in a file with their low byte first. */
static inline float half_at(const uint8_t *row, size_t i)
{
    return wo_half_to_float((uint16_t)(row[2 * i] | row[2 * i + 1] << 8));
}

static inline uint32_t word_at(const uint8_t *row, size_t i)
{
    const uint8_t *const at = row + 4 * i;
    return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

float wo_exr_sample(const uint8_t *row, exr_pixel_type_t type, size_t i)
{
    if (type == EXR_PIXEL_HALF)
        return half_at(row, i);
    return type == EXR_PIXEL_UINT ? (float)word_at(row, i) : wo_float_of_bits(word_at(row, i));
}

/* count samples of one channel to every stride-th float. */
static void unpack_row(const uint8_t *row, exr_pixel_type_t type, size_t count, float *to,
                       size_t stride)
{
    if (type == EXR_PIXEL_HALF)
        for (size_t i = 0; i < count; i++)
            to[i * stride] = half_at(row, i);
    else if (type == EXR_PIXEL_FLOAT)
        for (size_t i = 0; i < count; i++)
            to[i * stride] = wo_float_of_bits(word_at(row, i));
    else
        for (size_t i = 0; i < count; i++)
            to[i * stride] = (float)word_at(row, i);
}

/* Channel order. */

typedef struct place {
    const char *name;
    int index; /* in the file */
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
    const int component_a = wo_io_component(a->name), component_b = wo_io_component(b->name);
    if (component_a != component_b)
        return component_a - component_b;
    const int name = strcmp(a->name, b->name);
    return name ? name : a->index - b->index;
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
        places[i] = (place){list->entries[i].name.str, (int)i};
    if (status == WO_OK) {
        qsort(places, count, sizeof *places, compare_places);
        for (size_t i = 0; i < count; i++) {
            const exr_attr_chlist_entry_t *const entry = &list->entries[places[i].index];
            names[i] = places[i].name;
            (*channels)[places[i].index] = (wo_exr_channel){
                (int)i, entry->pixel_type, entry->pixel_type == EXR_PIXEL_HALF ? 2 : 4};
        }
        status = wo_io_part_head(part, name, data, display, names, (int)count, error);
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

/* Pixels. */

static wo_status damaged(const wo_exr_source *source, const char *what)
{
    return wo_fail(source->error, WO_ERR_FORMAT, "%s: %s", wo_io_shown(source->stream->path), what);
}

static wo_status unpack_flat(const wo_exr_source *source, const exr_decode_pipeline_t *decode)
{
    wo_io_part *const part = source->part;
    const size_t width = (size_t)decode->chunk.width, height = (size_t)decode->chunk.height;
    const size_t part_width = (size_t)wo_rect_width(part->data_window);
    const size_t part_height = (size_t)wo_rect_height(part->data_window);
    const size_t stride = (size_t)part->channels;
    const uint8_t *row = decode->unpacked_buffer;

    if (!row || decode->chunk.unpacked_size != width * height * source->pixel_bytes)
        return damaged(source, "a block of pixels has a wrong size");
    if ((size_t)source->x + width > part_width || (size_t)source->y + height > part_height)
        return damaged(source, "a block of pixels lies outside the picture");
    for (size_t line = 0; line < height; line++) {
        const size_t up = part_height - 1 - ((size_t)source->y + line);
        float *const to = part->pixels + (up * part_width + (size_t)source->x) * stride;
        for (size_t c = 0; c < stride; c++) {
            const wo_exr_channel channel = source->channels[c];
            unpack_row(row, channel.type, width, to + channel.target, stride);
            row += width * channel.bytes;
        }
    }
    return WO_OK;
}

static exr_result_t unpack(exr_decode_pipeline_t *decode)
{
    wo_exr_source *const source = decode->decoding_user_data;
    const bool deep =
        source->storage == EXR_STORAGE_DEEP_SCANLINE || source->storage == EXR_STORAGE_DEEP_TILED;
    source->status = deep ? wo_exr_flatten(source, decode) : unpack_flat(source, decode);
    return source->status == WO_OK ? EXR_ERR_SUCCESS : EXR_ERR_CORRUPT_CHUNK;
}

/* Sizes a chunk claims, against what the file can hold; zlib packs at most about 1 : 1032. */
static wo_status check_chunk(const wo_exr_source *source, const exr_chunk_info_t *chunk)
{
    const uint64_t file = (uint64_t)source->stream->size;
    const bool deep =
        source->storage == EXR_STORAGE_DEEP_SCANLINE || source->storage == EXR_STORAGE_DEEP_TILED;
    if (chunk->width < 1 || chunk->height < 1)
        return damaged(source, "a block of pixels has no size");
    if (chunk->packed_size > file || (deep && chunk->sample_count_table_size > file))
        return damaged(source, "a block of pixels is larger than the file");
    if (!deep && source->compression == EXR_COMPRESSION_NONE &&
        chunk->packed_size != chunk->unpacked_size)
        return damaged(source, "a block of plain pixels has a wrong size");
    if (deep && chunk->unpacked_size > 1100 * chunk->packed_size + 4096)
        return damaged(source, "a block of deep pixels claims too many samples");
    if (deep && chunk->sample_count_table_size == 0)
        return damaged(source, "a block of deep pixels has no sample counts");
    return WO_OK;
}

static wo_status run_chunk(wo_exr_source *source, exr_decode_pipeline_t *decode, bool *started,
                           const exr_chunk_info_t *chunk)
{
    wo_error *const error = source->error;
    WO_TRY(check_chunk(source, chunk));
    if (!*started) {
        WO_EXR_TRY(source->stream,
                   exr_decoding_initialize(source->exr, source->index, chunk, decode));
        *started = true;
        decode->decode_flags = EXR_DECODE_SAMPLE_COUNTS_AS_INDIVIDUAL;
        decode->decoding_user_data = source;
        decode->alloc_fn = wo_exr_get_buffer;
        decode->free_fn = wo_exr_put_buffer;
        WO_EXR_TRY(source->stream,
                   exr_decoding_choose_default_routines(source->exr, source->index, decode));
        decode->unpack_and_convert_fn = unpack;
    } else {
        WO_EXR_TRY(source->stream, exr_decoding_update(source->exr, source->index, chunk, decode));
    }
    source->status = WO_OK;
    const exr_result_t result = exr_decoding_run(source->exr, source->index, decode);
    WO_TRY(source->status);
    WO_EXR_TRY(source->stream, result);
    return WO_OK;
}

static wo_status read_chunks(wo_exr_source *source, exr_decode_pipeline_t *decode, bool *started)
{
    wo_error *const error = source->error;
    exr_chunk_info_t chunk;
    exr_attr_box2i_t window;
    const int32_t width = wo_rect_width(source->part->data_window);
    const int32_t height = wo_rect_height(source->part->data_window);

    if (source->tile_width > 0) {
        for (int32_t y = 0; y < height; y += source->tile_height)
            for (int32_t x = 0; x < width; x += source->tile_width) {
                const int column = x / source->tile_width, row = y / source->tile_height;
                WO_EXR_TRY(source->stream, exr_read_tile_chunk_info(source->exr, source->index,
                                                                    column, row, 0, 0, &chunk));
                source->x = x;
                source->y = y;
                WO_TRY(run_chunk(source, decode, started, &chunk));
            }
        return WO_OK;
    }
    int32_t lines = 0;
    WO_EXR_TRY(source->stream, exr_get_data_window(source->exr, source->index, &window));
    WO_EXR_TRY(source->stream, exr_get_scanlines_per_chunk(source->exr, source->index, &lines));
    if (lines < 1)
        return damaged(source, "blocks of no lines");
    for (int32_t y = 0; y < height; y += lines) {
        WO_EXR_TRY(source->stream, exr_read_scanline_chunk_info(source->exr, source->index,
                                                                window.min.y + y, &chunk));
        source->x = 0;
        source->y = y;
        WO_TRY(run_chunk(source, decode, started, &chunk));
    }
    return WO_OK;
}

/* A file of a few bytes must not make us allocate gigabytes: each chunk has 8 bytes in the table
   and at least 8 of its own, and no compression reaches 1 : 4096, or 1 : 65536 for DWA. */
static wo_status check_plausible(const wo_exr_source *source)
{
    int32_t chunks = 0;
    wo_error *const error = source->error;
    WO_EXR_TRY(source->stream, exr_get_chunk_count(source->exr, source->index, &chunks));
    const uint64_t file = (uint64_t)source->stream->size;
    if (chunks < 1 || (uint64_t)chunks * 16 > file)
        return damaged(source, "the file is too short for its picture");
    const uint64_t pixels = (uint64_t)wo_rect_width(source->part->data_window) *
                            (uint64_t)wo_rect_height(source->part->data_window);
    const bool deep =
        source->storage == EXR_STORAGE_DEEP_SCANLINE || source->storage == EXR_STORAGE_DEEP_TILED;
    const uint64_t least = pixels * (deep ? 4 : source->pixel_bytes);
    if (least / (source->compression < EXR_COMPRESSION_DWAA ? 4096 : 65536) > file)
        return damaged(source, "the file is too short for its picture");
    return WO_OK;
}

/* OpenEXRCore 3.1 has no DWA, and its B44 takes float channels apart wrongly: those go through
   OpenImageIO. */
static wo_status read_pixels(wo_exr_stream *stream, exr_const_context_t exr, int index,
                             wo_io_part *part, const wo_exr_channel *channels, wo_error *error)
{
    wo_exr_source source = {.stream = stream,
                            .exr = exr,
                            .index = index,
                            .part = part,
                            .channels = channels,
                            .error = error};
    const exr_attr_chlist_t *list = NULL;
    WO_EXR_TRY(stream, exr_get_storage(exr, index, &source.storage));
    WO_EXR_TRY(stream, exr_get_compression(exr, index, &source.compression));
    WO_EXR_TRY(stream, exr_get_channels(exr, index, &list));
    for (int i = 0; i < list->num_channels; i++) {
        const exr_attr_chlist_entry_t *const entry = &list->entries[i];
        source.pixel_bytes += channels[i].bytes;
        if (entry->x_sampling != 1 || entry->y_sampling != 1)
            return wo_fail(error, WO_ERR_UNSUPPORTED,
                           "%s: channel %s is stored at 1/%d x 1/%d of the resolution; save the "
                           "picture as plain RGB",
                           wo_io_shown(stream->path), entry->name.str, (int)entry->x_sampling,
                           (int)entry->y_sampling);
    }
    if (source.storage == EXR_STORAGE_TILED || source.storage == EXR_STORAGE_DEEP_TILED) {
        WO_EXR_TRY(stream,
                   exr_get_tile_sizes(exr, index, 0, 0, &source.tile_width, &source.tile_height));
        if (source.tile_width < 1 || source.tile_height < 1 ||
            source.tile_width > WO_MAX_COORDINATE || source.tile_height > WO_MAX_COORDINATE)
            return damaged(&source, "tiles of an impossible size");
    }
    WO_TRY(check_plausible(&source));
    WO_TRY(wo_io_part_pixels(part, error));
    if (source.compression >= EXR_COMPRESSION_B44)
        return wo_io_oiio_exr_pixels(stream->path, index, part, error);

    exr_decode_pipeline_t decode = EXR_DECODE_PIPELINE_INITIALIZER;
    bool started = false;
    const wo_status status = read_chunks(&source, &decode, &started);
    if (started)
        exr_decoding_destroy(exr, &decode);
    free(source.scratch);
    return status;
}

static wo_status read_parts(wo_exr_stream *stream, exr_const_context_t exr, bool headers_only,
                            wo_io_file **file, wo_error *error)
{
    int count = 0;
    uint64_t bytes = 0;
    WO_EXR_TRY(stream, exr_get_count(exr, &count));
    WO_TRY(wo_io_file_create(count > 0 ? (size_t)count : 0, file, error));
    free((*file)->format);
    (*file)->format = wo_io_copy_text("openexr");
    if (!(*file)->format)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for an image file");
    for (int i = 0; i < count; i++) {
        wo_exr_channel *channels = NULL;
        wo_io_part *const part = &(*file)->parts[i];
        wo_status status = read_head(stream, exr, i, part, &channels, &bytes, error);
        if (status == WO_OK && !headers_only)
            status = read_pixels(stream, exr, i, part, channels, error);
        free(channels);
        WO_TRY(status);
    }
    return WO_OK;
}

wo_status wo_io_exr_read(const char *path, int fd, bool headers_only, wo_io_file **file,
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
        status = read_parts(&stream, exr, headers_only, file, error);
    exr_finish(&exr);
    wo_exr_end();
    /* short of memory the library leaves things out and goes on */
    if (stream.no_memory)
        status = wo_exr_failure(&stream, EXR_ERR_OUT_OF_MEMORY, error);
    return status;
}
