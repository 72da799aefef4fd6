/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "half.h"
#include "io_exr_private.h"

#include <stdlib.h>
#include <string.h>

typedef struct drain {
    const wo_io_part *part;
    const wo_exr_channel *channels; /* in file order */
    size_t pixel_bytes;
    int32_t y; /* top line of the chunk, y down, from 0 */
    exr_result_t (*compress)(exr_encode_pipeline_t *encode); /* the library's */
} drain;

static bool is_colour(const char *channel)
{
    return wo_io_component(channel) < 4 || !strcmp(channel, "Y");
}

static void pack_row(const float *from, size_t stride, size_t count, exr_pixel_type_t type,
                     uint8_t *to)
{
    for (size_t i = 0; i < count; i++) {
        if (type == EXR_PIXEL_HALF) {
            const uint16_t half = wo_half_from_float(from[i * stride]);
            to[2 * i] = (uint8_t)half;
            to[2 * i + 1] = (uint8_t)(half >> 8);
        } else {
            const uint32_t bits = wo_bits_of_float(from[i * stride]);
            for (unsigned k = 0; k < 4; k++)
                to[4 * i + k] = (uint8_t)(bits >> (8 * k));
        }
    }
}

static exr_result_t pack(exr_encode_pipeline_t *encode)
{
    const drain *const source = encode->encoding_user_data;
    const wo_io_part *const part = source->part;
    const size_t width = (size_t)wo_rect_width(part->data_window);
    const size_t height = (size_t)wo_rect_height(part->data_window);
    const size_t lines = (size_t)encode->chunk.height;
    const size_t bytes = width * lines * source->pixel_bytes;
    uint8_t *to = encode->packed_buffer;

    if ((size_t)encode->chunk.width != width || (size_t)source->y + lines > height || !to ||
        encode->packed_alloc_size < bytes)
        return EXR_ERR_INVALID_ARGUMENT;
    for (size_t line = 0; line < lines; line++) {
        const size_t up = height - 1 - ((size_t)source->y + line);
        const float *const row = part->pixels + up * width * (size_t)part->channels;
        for (int c = 0; c < part->channels; c++) {
            const wo_exr_channel channel = source->channels[c];
            pack_row(row + channel.target, (size_t)part->channels, width, channel.type, to);
            to += width * channel.bytes;
        }
    }
    encode->packed_bytes = bytes;
    return EXR_ERR_SUCCESS;
}

/* Readers take a block as long as its pixels for one that is not compressed. The library (3.1)
   keeps its own when it comes out at exactly that length. */
static exr_result_t compress(exr_encode_pipeline_t *encode)
{
    const drain *const source = encode->encoding_user_data;
    const exr_result_t result = source->compress(encode);
    if (result == EXR_ERR_SUCCESS && encode->compressed_buffer && encode->packed_buffer &&
        encode->compressed_bytes == encode->packed_bytes &&
        encode->compressed_alloc_size >= encode->packed_bytes)
        memcpy(encode->compressed_buffer, encode->packed_buffer, encode->packed_bytes);
    return result;
}

static exr_compression_t compression_of(const wo_io_part *part)
{
    static const char *const lossless[] = {"none", "rle", "zips", "zip", "piz"};
    const wo_io_attribute *const wish = wo_io_part_find(part, "compression");
    for (size_t i = 0; wish && wish->type == WO_IO_TEXT && i < WO_COUNT(lossless); i++)
        if (!strcmp(wish->text, lossless[i]))
            return (exr_compression_t)i;
    return EXR_COMPRESSION_ZIP;
}

/* Finds the place of a channel of the file among the part's. */
static int target_of(const wo_io_part *part, const char *name)
{
    for (int i = 0; i < part->channels; i++)
        if (!strcmp(part->channel_names[i], name))
            return i;
    return -1;
}

static wo_status define_part(const wo_exr_stream *stream, exr_context_t exr, const wo_io_part *part,
                             bool named, wo_io_depth depth, wo_error *error)
{
    int index = 0;
    const wo_rect data = part->data_window, display = part->display_window;
    const int32_t height = wo_rect_height(display);
    /* y down from the top of the display window, whose upper left pixel is 0, 0 in the file */
    const exr_attr_box2i_t outer = {.min = {.arr = {0, 0}},
                                    .max = {.arr = {wo_rect_width(display) - 1, height - 1}}};
    const exr_attr_box2i_t inner = {
        .min = {.arr = {data.x1 - display.x1, display.y2 - data.y2}},
        .max = {.arr = {data.x2 - 1 - display.x1, display.y2 - 1 - data.y1}}};
    const exr_attr_v2f_t centre = {.arr = {0, 0}};
    const float aspect =
        part->pixel_aspect > 0 && part->pixel_aspect < 1e6 ? (float)part->pixel_aspect : 1.0f;

    WO_EXR_TRY(stream, exr_add_part(exr, named ? part->name : NULL, EXR_STORAGE_SCANLINE, &index));
    WO_EXR_TRY(stream,
               exr_initialize_required_attr(exr, index, &outer, &inner, aspect, &centre, 1,
                                            EXR_LINEORDER_INCREASING_Y, compression_of(part)));
    WO_EXR_TRY(stream, exr_set_zip_compression_level(exr, index, 4));
    for (int i = 0; i < part->channels; i++) {
        const char *const name = part->channel_names[i];
        if (target_of(part, name) != i)
            return wo_fail(error, WO_ERR_ARGUMENT, "%s: two channels are called %s",
                           wo_io_shown(stream->path), name);
        const bool half = depth == WO_IO_HALF || (depth == WO_IO_AUTO && is_colour(name));
        WO_EXR_TRY(stream,
                   exr_add_channel(exr, index, name, half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT,
                                   EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
    }
    return wo_exr_write_attributes(stream, exr, index, part, error);
}

static wo_status encode_chunks(const wo_exr_stream *stream, exr_context_t exr, int index,
                               drain *source, exr_encode_pipeline_t *encode, bool *started,
                               wo_error *error)
{
    exr_chunk_info_t chunk;
    exr_attr_box2i_t window;
    int32_t lines = 0;
    WO_EXR_TRY(stream, exr_get_data_window(exr, index, &window));
    WO_EXR_TRY(stream, exr_get_scanlines_per_chunk(exr, index, &lines));
    for (int32_t y = 0; y < wo_rect_height(source->part->data_window); y += lines) {
        source->y = y;
        WO_EXR_TRY(stream, exr_write_scanline_chunk_info(exr, index, window.min.y + y, &chunk));
        if (!*started) {
            WO_EXR_TRY(stream, exr_encoding_initialize(exr, index, &chunk, encode));
            *started = true;
            for (int c = 0; c < encode->channel_count; c++) {
                exr_coding_channel_info_t *const channel = &encode->channels[c];
                channel->encode_from_ptr = (const uint8_t *)source->part->pixels;
                channel->user_pixel_stride = channel->bytes_per_element;
                channel->user_line_stride = channel->bytes_per_element;
            }
            WO_EXR_TRY(stream, exr_encoding_choose_default_routines(exr, index, encode));
            encode->convert_and_pack_fn = pack;
            source->compress = encode->compress_fn;
            if (encode->compress_fn)
                encode->compress_fn = compress;
            encode->encoding_user_data = source;
        } else {
            WO_EXR_TRY(stream, exr_encoding_update(exr, index, &chunk, encode));
        }
        WO_EXR_TRY(stream, exr_encoding_run(exr, index, encode));
    }
    return WO_OK;
}

static wo_status write_part(const wo_exr_stream *stream, exr_context_t exr, int index,
                            const wo_io_part *part, wo_error *error)
{
    const exr_attr_chlist_t *list = NULL;
    WO_EXR_TRY(stream, exr_get_channels(exr, index, &list));
    wo_exr_channel *const channels = calloc((size_t)list->num_channels, sizeof *channels);
    if (!channels)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for %d channels", list->num_channels);
    drain source = {.part = part, .channels = channels};
    for (int i = 0; i < list->num_channels; i++) {
        const exr_attr_chlist_entry_t *const entry = &list->entries[i];
        channels[i] = (wo_exr_channel){.target = target_of(part, entry->name.str),
                                       .type = entry->pixel_type,
                                       .bytes = entry->pixel_type == EXR_PIXEL_HALF ? 2 : 4,
                                       .x_sampling = 1,
                                       .y_sampling = 1};
        source.pixel_bytes += channels[i].bytes;
    }
    exr_encode_pipeline_t encode = EXR_ENCODE_PIPELINE_INITIALIZER;
    bool started = false;
    const wo_status status = encode_chunks(stream, exr, index, &source, &encode, &started, error);
    if (started)
        exr_encoding_destroy(exr, &encode);
    free(channels);
    return status;
}

/* Names beyond 31 characters need a flag in the file that very old readers refuse. */
static bool has_long_names(const wo_io_part *parts, size_t part_count)
{
    for (size_t i = 0; i < part_count; i++) {
        for (int c = 0; c < parts[i].channels; c++)
            if (strlen(parts[i].channel_names[c]) > 31)
                return true;
        for (size_t a = 0; a < parts[i].attribute_count; a++)
            if (strlen(parts[i].attributes[a].name) > 31)
                return true;
    }
    return false;
}

static wo_status write_parts(const wo_exr_stream *stream, exr_context_t exr,
                             const wo_io_part *parts, size_t part_count, wo_io_depth depth,
                             wo_error *error)
{
    if (has_long_names(parts, part_count))
        WO_EXR_TRY(stream, exr_set_longname_support(exr, 1));
    for (size_t i = 0; i < part_count; i++)
        WO_TRY(define_part(stream, exr, &parts[i],
                           part_count > 1 || (parts[i].name && *parts[i].name), depth, error));
    WO_EXR_TRY(stream, exr_write_header(exr));
    for (size_t i = 0; i < part_count; i++)
        WO_TRY(write_part(stream, exr, (int)i, &parts[i], error));
    return WO_OK;
}

static wo_status check_names(const char *path, const wo_io_part *parts, size_t part_count,
                             wo_error *error)
{
    for (size_t i = 0; part_count > 1 && i < part_count; i++) {
        const char *const name = parts[i].name;
        if (!name || !*name)
            return wo_fail(error, WO_ERR_ARGUMENT, "%s: part %zu of %zu needs a name",
                           wo_io_shown(path), i, part_count);
        for (size_t k = 0; k < i; k++)
            if (!strcmp(name, parts[k].name))
                return wo_fail(error, WO_ERR_ARGUMENT, "%s: two parts are called %s",
                               wo_io_shown(path), name);
    }
    return WO_OK;
}

wo_status wo_io_exr_write(const char *path, int fd, const wo_io_part *parts, size_t part_count,
                          wo_io_depth depth, wo_error *error)
{
    wo_exr_stream stream = {.path = path, .fd = fd};
    WO_TRY(check_names(path, parts, part_count, error));

    exr_context_t exr = NULL;
    wo_exr_begin(&stream);
    const exr_context_initializer_t settings = wo_exr_settings(&stream);
    exr_result_t result = exr_start_write(&exr, path, EXR_WRITE_FILE_DIRECTLY, &settings);
    wo_status status = WO_OK;
    if (result == EXR_ERR_SUCCESS) {
        status = write_parts(&stream, exr, parts, part_count, depth, error);
        result = exr_finish(&exr);
        if (result == EXR_ERR_SUCCESS && stream.system_error)
            result = EXR_ERR_WRITE_IO;
    }
    wo_exr_end();
    WO_TRY(status);
    WO_EXR_TRY(&stream, result);
    return WO_OK;
}
