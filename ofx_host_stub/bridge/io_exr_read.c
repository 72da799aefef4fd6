/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "half.h"
#include "io_child_private.h"
#include "io_exr_private.h"

#include <stdlib.h>

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

/* Pixels. */

static wo_status damaged(const wo_exr_source *source, const char *what)
{
    return wo_fail(source->error, WO_ERR_FORMAT, "%s: %s", wo_io_shown(source->stream->path), what);
}

/* Pixels of first to first + count that have a sample, as the file counts. */
static size_t samples_in(int64_t first, size_t count, int32_t sampling)
{
    const int64_t skipped = ((first % sampling) + sampling) % sampling;
    const int64_t before = skipped ? sampling - skipped : 0;
    return (int64_t)count > before ? (size_t)(((int64_t)count - before - 1) / sampling + 1) : 0;
}

static size_t flat_bytes(const wo_exr_source *source, size_t width, size_t height)
{
    size_t bytes = 0;
    for (size_t c = 0; c < source->channel_count; c++) {
        const wo_exr_channel *const channel = &source->channels[c];
        bytes += samples_in((int64_t)source->left + source->x, width, channel->x_sampling) *
                 samples_in((int64_t)source->top + source->y, height, channel->y_sampling) *
                 channel->bytes;
    }
    return bytes;
}

static wo_status unpack_flat(const wo_exr_source *source, const exr_decode_pipeline_t *decode)
{
    wo_io_part *const part = source->part;
    const size_t width = (size_t)decode->chunk.width, height = (size_t)decode->chunk.height;
    const size_t part_width = (size_t)wo_rect_width(part->data_window);
    const size_t part_height = (size_t)wo_rect_height(part->data_window);
    const size_t stride = (size_t)part->channels;
    const uint8_t *row = decode->unpacked_buffer;

    if (!row || decode->chunk.unpacked_size != flat_bytes(source, width, height))
        return damaged(source, "a block of pixels has a wrong size");
    if ((size_t)source->x + width > part_width || (size_t)source->y + height > part_height)
        return damaged(source, "a block of pixels lies outside the picture");
    for (size_t line = 0; line < height; line++) {
        const size_t up = part_height - 1 - ((size_t)source->y + line);
        float *const to = part->pixels + (up * part_width + (size_t)source->x) * stride;
        for (size_t c = 0; c < source->channel_count; c++) {
            const wo_exr_channel *const channel = &source->channels[c];
            if (!samples_in((int64_t)source->top + source->y + (int64_t)line, 1,
                            channel->y_sampling))
                continue;
            const size_t count =
                samples_in((int64_t)source->left + source->x, width, channel->x_sampling);
            if (channel->target >= 0)
                unpack_row(row, channel->type, count, to + channel->target,
                           stride * (size_t)channel->x_sampling);
            row += count * channel->bytes;
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

/* Channels of lower resolution: only what the standard allows, and what the libraries can read. */
static wo_status check_sampling(const wo_exr_source *source, bool *reduced)
{
    const int32_t width = wo_rect_width(source->part->data_window);
    const int32_t height = wo_rect_height(source->part->data_window);
    *reduced = false;
    for (size_t c = 0; c < source->channel_count; c++) {
        const int32_t xs = source->channels[c].x_sampling, ys = source->channels[c].y_sampling;
        if (xs == 1 && ys == 1)
            continue;
        *reduced = true;
        if (xs < 1 || ys < 1 || width % xs || height % ys || source->left % xs || source->top % ys)
            return damaged(source, "channels whose resolution does not divide the picture's");
    }
    if (*reduced && source->storage != EXR_STORAGE_SCANLINE)
        return damaged(source, "tiles or deep pixels with channels of reduced resolution");
    if (*reduced && source->compression >= EXR_COMPRESSION_DWAA)
        return wo_fail(source->error, WO_ERR_UNSUPPORTED,
                       "%s: channels of reduced resolution packed as DWA; save the picture with "
                       "another compression",
                       wo_io_shown(source->stream->path));
    return WO_OK;
}

/* What is left to do when all samples are there. */
static void finish_channels(const wo_exr_source *source)
{
    const exr_attribute_t *said = NULL;
    for (size_t c = 0; c < source->channel_count; c++) {
        const wo_exr_channel *const channel = &source->channels[c];
        if (channel->target >= 0 && (channel->x_sampling > 1 || channel->y_sampling > 1))
            wo_exr_interpolate(source->part, channel);
    }
    if (exr_get_attribute_by_name(source->exr, source->index, "chromaticities", &said) !=
            EXR_ERR_SUCCESS ||
        said->type != EXR_ATTR_CHROMATICITIES)
        said = NULL;
    for (size_t c = 0; c < source->channel_count; c++)
        if (source->channels[c].chroma && source->channels[c].target >= 0)
            wo_exr_chroma_to_rgb(source->part, source->channels[c].target,
                                 said ? said->chromaticities : NULL);
}

/* OpenEXRCore 3.1 has no DWA, and its B44 takes float channels apart wrongly: those go through
   OpenImageIO, which does not read channels of reduced resolution. */
wo_status wo_exr_read_pixels(wo_exr_stream *stream, exr_const_context_t exr, int index,
                             wo_io_part *part, const wo_exr_channel *channels, size_t count,
                             wo_error *error)
{
    wo_exr_source source = {.stream = stream,
                            .exr = exr,
                            .index = index,
                            .part = part,
                            .channels = channels,
                            .channel_count = count,
                            .error = error};
    exr_attr_box2i_t window;
    bool reduced;
    WO_EXR_TRY(stream, exr_get_storage(exr, index, &source.storage));
    WO_EXR_TRY(stream, exr_get_compression(exr, index, &source.compression));
    WO_EXR_TRY(stream, exr_get_data_window(exr, index, &window));
    source.left = window.min.x;
    source.top = window.min.y;
    for (size_t i = 0; i < count; i++)
        source.pixel_bytes += channels[i].bytes;
    WO_TRY(check_sampling(&source, &reduced));
    if (source.storage == EXR_STORAGE_TILED || source.storage == EXR_STORAGE_DEEP_TILED) {
        WO_EXR_TRY(stream,
                   exr_get_tile_sizes(exr, index, 0, 0, &source.tile_width, &source.tile_height));
        if (source.tile_width < 1 || source.tile_height < 1 ||
            source.tile_width > WO_MAX_COORDINATE || source.tile_height > WO_MAX_COORDINATE)
            return damaged(&source, "tiles of an impossible size");
    }
    WO_TRY(check_plausible(&source));
    WO_TRY(wo_io_part_pixels(part, error));
    if (source.compression >= EXR_COMPRESSION_B44 && !reduced) {
        WO_TRY(wo_io_exr_pixels_apart(stream->path, stream->fd, index, part, error));
        finish_channels(&source);
        return WO_OK;
    }

    exr_decode_pipeline_t decode = EXR_DECODE_PIPELINE_INITIALIZER;
    bool started = false;
    const wo_status status = read_chunks(&source, &decode, &started);
    if (started)
        exr_decoding_destroy(exr, &decode);
    free(source.scratch);
    if (status == WO_OK)
        finish_channels(&source);
    return status;
}
