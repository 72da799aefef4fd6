/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "io_exr_private.h"

#include <math.h>
#include <string.h>

/* Luminance and chroma: Y = wr R + wg G + wb B, RY = (R - Y) / Y, BY = (B - Y) / Y. */

static const char *word_of(const char *channel)
{
    const size_t layer = wo_io_layer_length(channel);
    return layer ? channel + layer + 1 : channel;
}

bool wo_exr_is_chroma(const exr_attr_chlist_t *list, const char *name)
{
    const size_t layer = wo_io_layer_length(name);
    int found = 0;
    bool is_one = false;
    for (int i = 0; i < list->num_channels; i++) {
        const char *const other = list->entries[i].name.str;
        if (wo_io_layer_length(other) != layer || strncmp(other, name, layer) != 0)
            continue;
        const char *const word = word_of(other);
        if (wo_io_component(other) < 3)
            return false;
        if (!strcmp(word, "Y") || !strcmp(word, "RY") || !strcmp(word, "BY")) {
            found++;
            is_one |= !strcmp(other, name);
        }
    }
    return found == 3 && is_one;
}

void wo_exr_interpolate(wo_io_part *part, const wo_exr_channel *channel)
{
    const int32_t width = wo_rect_width(part->data_window);
    const int32_t height = wo_rect_height(part->data_window);
    const int32_t xs = channel->x_sampling, ys = channel->y_sampling;
    const size_t stride = (size_t)part->channels, row = (size_t)width * stride;
    float *const pixels = part->pixels + channel->target;
    for (int32_t y = 0; y < height; y += ys) {
        float *const line = pixels + (size_t)(height - 1 - y) * row;
        for (int32_t x = 0; x < width; x++) {
            const int32_t a = x - x % xs, b = a + xs < width ? a + xs : a;
            const float t = (float)(x - a) / (float)xs;
            if (x > a)
                line[(size_t)x * stride] =
                    (1 - t) * line[(size_t)a * stride] + t * line[(size_t)b * stride];
        }
    }
    for (int32_t y = 0; y < height; y++) {
        const int32_t a = y - y % ys, b = a + ys < height ? a + ys : a;
        const float t = (float)(y - a) / (float)ys;
        const float *const above = pixels + (size_t)(height - 1 - a) * row;
        const float *const below = pixels + (size_t)(height - 1 - b) * row;
        float *const line = pixels + (size_t)(height - 1 - y) * row;
        for (int32_t x = 0; y > a && x < width; x++)
            line[(size_t)x * stride] =
                (1 - t) * above[(size_t)x * stride] + t * below[(size_t)x * stride];
    }
}

static double det(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) +
           c[0] * (a[1] * b[2] - a[2] * b[1]);
}

static void column(float x, float y, double out[3])
{
    out[0] = (double)x / (double)y;
    out[1] = 1;
    out[2] = (1 - (double)x - (double)y) / (double)y;
}

/* What red, green and blue weigh in Y; those of Rec. 709 when the primaries make no sense. */
static void weights_of(const exr_attr_chromaticities_t *primaries, double weights[3])
{
    static const double rec709[3] = {0.2126, 0.7152, 0.0722};
    memcpy(weights, rec709, sizeof rec709);
    if (!primaries)
        return;
    double r[3], g[3], b[3], white[3];
    column(primaries->red_x, primaries->red_y, r);
    column(primaries->green_x, primaries->green_y, g);
    column(primaries->blue_x, primaries->blue_y, b);
    column(primaries->white_x, primaries->white_y, white);
    const double all = det(r, g, b);
    const double made[3] = {det(white, g, b) / all, det(r, white, b) / all, det(r, g, white) / all};
    if (made[0] > -1 && made[0] < 2 && made[1] > 1e-3 && made[1] < 2 && made[2] > -1 && made[2] < 2)
        memcpy(weights, made, sizeof made);
}

void wo_exr_chroma_to_rgb(wo_io_part *part, int red, const exr_attr_chromaticities_t *primaries)
{
    const size_t stride = (size_t)part->channels;
    const size_t count =
        (size_t)wo_rect_width(part->data_window) * (size_t)wo_rect_height(part->data_window);
    double weights[3];
    weights_of(primaries, weights);
    float *at = part->pixels + red;
    for (size_t i = 0; i < count; i++, at += stride) {
        const double luminance = (double)at[1];
        const double r = ((double)at[0] + 1) * luminance, b = ((double)at[2] + 1) * luminance;
        at[0] = (float)r;
        at[1] = (float)((luminance - weights[0] * r - weights[2] * b) / weights[1]);
        at[2] = (float)b;
    }
}
