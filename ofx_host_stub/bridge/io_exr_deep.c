/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "io_exr_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Deep pixels to flat ones. A line of a chunk holds, channel after channel, the samples of all its
   pixels from left to right. */

typedef struct sample_order {
    float depth;
    int32_t index;
} sample_order;

/* Near first; samples without a depth last; equal depths keep the file's order. */
static int compare_depth(const void *left, const void *right)
{
    const sample_order *const a = left, *const b = right;
    const bool none_a = isnan(a->depth), none_b = isnan(b->depth);
    if (none_a != none_b)
        return none_a ? 1 : -1;
    if (!none_a && a->depth < b->depth)
        return -1;
    if (!none_a && a->depth > b->depth)
        return 1;
    return a->index < b->index ? -1 : a->index > b->index;
}

static int find_channel(const wo_io_part *part, const char *name)
{
    for (int i = 0; i < part->channels; i++)
        if (!strcmp(part->channel_names[i], name))
            return i;
    return -1;
}

static wo_status damaged(const wo_exr_source *source, const char *what)
{
    return wo_fail(source->error, WO_ERR_FORMAT, "%s: %s", wo_io_shown(source->stream->path), what);
}

/* Room for count samples, kept from pixel to pixel. */
static sample_order *scratch_for(wo_exr_source *source, size_t count)
{
    const size_t bytes = count * sizeof(sample_order);
    if (bytes > source->scratch_size) {
        free(source->scratch);
        source->scratch = malloc(bytes);
        source->scratch_size = source->scratch ? bytes : 0;
    }
    return source->scratch;
}

/* Rows of the channels of one line, indexed by the part's channels. */
typedef struct deep_line {
    const uint8_t **rows;
    exr_pixel_type_t *types;
    int alpha, depth; /* the part's channels, -1 = none */
} deep_line;

static void flatten_pixel(const wo_exr_source *source, const deep_line *line,
                          const sample_order *order, size_t count, size_t first, float *pixel)
{
    float through = 1;
    for (size_t s = 0; s < count && through > 0; s++) {
        const size_t i = first + (size_t)order[s].index;
        for (int c = 0; c < source->part->channels; c++) {
            const float value = wo_exr_sample(line->rows[c], line->types[c], i);
            if (wo_io_component(source->part->channel_names[c]) < 4)
                pixel[c] += through * value;
            else if (s == 0)
                pixel[c] = value;
        }
        const float alpha =
            line->alpha < 0 ? 1
                            : wo_exr_sample(line->rows[line->alpha], line->types[line->alpha], i);
        through *= alpha < 1 ? 1 - (alpha > 0 ? alpha : 0) : 0;
    }
}

/* Samples of each pixel, malloc-ed. The library leaves the running sums of plain files undecoded;
   they start anew on each line. */
static wo_status count_samples(const wo_exr_source *source, const exr_decode_pipeline_t *decode,
                               int32_t **counts)
{
    const size_t width = (size_t)decode->chunk.width, height = (size_t)decode->chunk.height;
    const size_t bytes = width * height * sizeof **counts;
    const bool plain = source->compression == EXR_COMPRESSION_NONE;
    const uint8_t *const packed = decode->packed_sample_count_table;

    *counts = NULL;
    if (plain ? !packed || decode->chunk.sample_count_table_size < bytes
              : !decode->sample_count_table || decode->sample_count_alloc_size < bytes)
        return damaged(source, "a block of deep pixels has no sample counts");
    int32_t *const made = malloc(bytes);
    if (!made)
        return wo_fail(source->error, WO_ERR_NOMEM, "no memory for deep samples");
    if (!plain)
        memcpy(made, decode->sample_count_table, bytes);
    for (size_t i = 0, last = 0; plain && i < width * height; i++) {
        const uint8_t *const at = packed + 4 * i;
        const uint32_t sum =
            (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
        if (i % width == 0)
            last = 0;
        made[i] = sum >= last && sum <= INT32_MAX ? (int32_t)(sum - last) : -1;
        last = sum;
    }
    *counts = made;
    return WO_OK;
}

static wo_status flatten_lines(wo_exr_source *source, const exr_decode_pipeline_t *decode,
                               const int32_t *chunk_counts, deep_line *line)
{
    wo_io_part *const part = source->part;
    const size_t width = (size_t)decode->chunk.width, height = (size_t)decode->chunk.height;
    const size_t part_width = (size_t)wo_rect_width(part->data_window);
    const size_t part_height = (size_t)wo_rect_height(part->data_window);
    const uint8_t *at = decode->unpacked_buffer;

    for (size_t y = 0; y < height; y++) {
        const int32_t *const counts = chunk_counts + y * width;
        size_t total = 0, first = 0;
        for (size_t x = 0; x < width; x++)
            total += (size_t)counts[x];
        for (int c = 0; c < part->channels; c++) {
            const wo_exr_channel channel = source->channels[c];
            line->rows[channel.target] = at;
            line->types[channel.target] = channel.type;
            if (total)
                at += total * channel.bytes;
        }
        const size_t up = part_height - 1 - ((size_t)source->y + y);
        for (size_t x = 0; x < width; x++) {
            const size_t count = (size_t)counts[x];
            if (count == 0)
                continue;
            sample_order *const order = scratch_for(source, count);
            if (!order)
                return wo_fail(source->error, WO_ERR_NOMEM, "no memory for deep samples");
            for (size_t s = 0; s < count; s++) {
                order[s].index = (int32_t)s;
                order[s].depth = line->depth < 0
                                     ? 0
                                     : wo_exr_sample(line->rows[line->depth],
                                                     line->types[line->depth], first + s);
            }
            qsort(order, count, sizeof *order, compare_depth);
            const size_t pixel = up * part_width + (size_t)source->x + x;
            flatten_pixel(source, line, order, count, first,
                          part->pixels + pixel * (size_t)part->channels);
            first += count;
        }
    }
    return WO_OK;
}

static wo_status flatten_counted(wo_exr_source *source, const exr_decode_pipeline_t *decode,
                                 const int32_t *counts)
{
    wo_io_part *const part = source->part;
    const size_t pixels = (size_t)decode->chunk.width * (size_t)decode->chunk.height;
    const size_t channels = (size_t)part->channels;
    uint64_t total = 0;

    for (size_t i = 0; i < pixels; i++) {
        if (counts[i] < 0)
            return damaged(source, "a negative number of deep samples");
        total += (uint64_t)counts[i];
    }
    if (total * source->pixel_bytes != decode->chunk.unpacked_size)
        return damaged(source, "deep samples do not add up to their block's size");
    if (total == 0)
        return WO_OK;
    if (!decode->unpacked_buffer)
        return damaged(source, "a block of deep pixels has no samples");

    deep_line line = {.rows = calloc(channels, sizeof *line.rows),
                      .types = calloc(channels, sizeof *line.types),
                      .alpha = find_channel(part, "A"),
                      .depth = find_channel(part, "Z")};
    wo_status status = WO_OK;
    if (!line.rows || !line.types)
        status = wo_fail(source->error, WO_ERR_NOMEM, "no memory for deep samples");
    else
        status = flatten_lines(source, decode, counts, &line);
    free((void *)line.rows);
    free(line.types);
    return status;
}

wo_status wo_exr_flatten(wo_exr_source *source, const exr_decode_pipeline_t *decode)
{
    const wo_rect window = source->part->data_window;
    int32_t *counts = NULL;
    if (source->x + decode->chunk.width > wo_rect_width(window) ||
        source->y + decode->chunk.height > wo_rect_height(window))
        return damaged(source, "a block of pixels lies outside the picture");
    WO_TRY(count_samples(source, decode, &counts));
    const wo_status status = flatten_counted(source, decode, counts);
    free(counts);
    return status;
}
