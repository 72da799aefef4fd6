/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "internal.h"

#include <limits.h>
#include <string.h>

#define PAD_FLOATS 7
#define PAD_BYTE   0x5a

/* A quiet NaN with a payload of our own: plugins that compute never write it. */
static const uint32_t unwritten = 0x7fdb0f5eu;

static const struct {
    int32_t components;
    const char *text;
} component_texts[] = {
    {1, kOfxImageComponentAlpha},
    {3, kOfxImageComponentRGB},
    {4, kOfxImageComponentRGBA},
};

const char *wo_components_text(int32_t components)
{
    for (size_t i = 0; i < WO_COUNT(component_texts); i++)
        if (component_texts[i].components == components)
            return component_texts[i].text;
    return kOfxImageComponentNone;
}

int32_t wo_components_of(const char *text)
{
    for (size_t i = 0; i < WO_COUNT(component_texts); i++)
        if (strcmp(component_texts[i].text, text) == 0)
            return component_texts[i].components;
    return 0;
}

/* First byte of row i, counted in memory. */
static unsigned char *row_at(const wo_buffer *buffer, size_t i)
{
    return buffer->memory + (i + 1) * buffer->pitch;
}

static size_t height_of(const wo_buffer *buffer)
{
    return (size_t)wo_rect_height(buffer->view.bounds);
}

bool wo_buffer_make(wo_host *host, wo_buffer *buffer, wo_rect bounds, int32_t components)
{
    *buffer = (wo_buffer){0};
    const int64_t width = (int64_t)bounds.x2 - bounds.x1;
    const int64_t height = (int64_t)bounds.y2 - bounds.y1;
    if (width < 1 || height < 1 || width > WO_MAX_SIDE || height > WO_MAX_SIDE)
        return false;
    const size_t length = (size_t)width * (size_t)components * sizeof(float);
    const size_t pad = host->config.layout & WO_HOST_PADDED_ROWS ? PAD_FLOATS * sizeof(float) : 0;
    const size_t rows = (size_t)height;
    buffer->length = length;
    buffer->pitch = length + pad;
    buffer->bytes = buffer->pitch * (rows + 2);
    buffer->memory = wo_guarded_alloc(buffer->bytes);
    if (!buffer->memory)
        return false;
    buffer->view = (wo_image){.bounds = bounds, .components = components};
    memset(buffer->memory, PAD_BYTE, buffer->pitch);
    memset(row_at(buffer, rows), PAD_BYTE, buffer->pitch);
    for (size_t i = 0; pad > 0 && i < rows; i++)
        memset(row_at(buffer, i) + length, PAD_BYTE, pad);
    const bool negative = host->config.layout & WO_HOST_NEGATIVE_ROWS;
    buffer->view.data = (float *)(void *)row_at(buffer, negative ? rows - 1 : 0);
    buffer->view.row_bytes = negative ? -(ptrdiff_t)buffer->pitch : (ptrdiff_t)buffer->pitch;
    return true;
}

void wo_buffer_free(wo_buffer *buffer)
{
    wo_guarded_free(buffer->memory);
    *buffer = (wo_buffer){0};
}

static bool all_pad(const unsigned char *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (bytes[i] != PAD_BYTE)
            return false;
    return true;
}

bool wo_buffer_intact(const wo_buffer *buffer)
{
    const size_t rows = height_of(buffer);
    if (!wo_guarded_intact(buffer->memory, buffer->bytes) ||
        !all_pad(buffer->memory, buffer->pitch) || !all_pad(row_at(buffer, rows), buffer->pitch))
        return false;
    for (size_t i = 0; i < rows; i++)
        if (!all_pad(row_at(buffer, i) + buffer->length, buffer->pitch - buffer->length))
            return false;
    return true;
}

uint64_t wo_buffer_sum(const wo_buffer *buffer)
{
    uint64_t sum = 0x9e3779b97f4a7c15u;
    for (size_t i = 0; i < height_of(buffer); i++) {
        const unsigned char *row = row_at(buffer, i);
        for (size_t k = 0; k < buffer->length; k += sizeof(uint32_t)) {
            uint32_t word;
            memcpy(&word, row + k, sizeof word);
            sum = (sum ^ word) * 0x100000001b3u;
        }
    }
    return sum;
}

void wo_buffer_blank(const wo_buffer *buffer)
{
    for (size_t i = 0; i < height_of(buffer); i++) {
        unsigned char *row = row_at(buffer, i);
        for (size_t k = 0; k < buffer->length; k += sizeof unwritten)
            memcpy(row + k, &unwritten, sizeof unwritten);
    }
}

void wo_buffer_check(const wo_frame *frame, const wo_buffer *buffer, wo_rect window)
{
    const wo_image *view = &buffer->view;
    const wo_rect b = view->bounds;
    long long inside = 0, outside = 0;
    for (int32_t y = b.y1; y < b.y2; y++) {
        for (int32_t x = b.x1; x < b.x2; x++) {
            const bool in = x >= window.x1 && x < window.x2 && y >= window.y1 && y < window.y2;
            const float *pixel = wo_image_at(view, x, y);
            int blank = 0;
            for (int c = 0; c < view->components; c++) {
                uint32_t word;
                memcpy(&word, pixel + c, sizeof word);
                blank += word == unwritten;
            }
            inside += in && blank > 0;
            outside += !in && blank < view->components;
        }
    }
    if (outside > 0)
        wo_violate_in(frame, "pixels of the output outside of the render window were written");
    if (inside > 0)
        wo_violate_in(frame, "pixels of the render window were not written");
}

void wo_convert_row(const float *from, int32_t from_components, float *to, int32_t to_components,
                    int32_t count)
{
    if (from_components == to_components) {
        memcpy(to, from, (size_t)count * (size_t)to_components * sizeof *to);
        return;
    }
    for (int32_t i = 0; i < count; i++, from += from_components, to += to_components) {
        if (to_components == 1) {
            to[0] = from_components == 4 ? from[3] : from[0];
        } else if (from_components == 1) {
            to[0] = to[1] = to[2] = from[0];
            if (to_components == 4)
                to[3] = 1;
        } else {
            memcpy(to, from, 3 * sizeof *to);
            if (to_components == 4)
                to[3] = 1;
        }
    }
}

void wo_copy_window(const wo_image *from, const wo_image *to, wo_rect window)
{
    for (int32_t y = window.y1; y < window.y2; y++)
        wo_convert_row(wo_image_at(from, window.x1, y), from->components,
                       wo_image_at(to, window.x1, y), to->components, wo_rect_width(window));
}
