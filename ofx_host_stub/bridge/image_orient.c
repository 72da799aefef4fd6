/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "image_io_private.h"

#include <stdlib.h>
#include <string.h>

/* Cameras store the picture as the sensor lay and say how: where row 0 and column 0 are seen. */

typedef struct point {
    int32_t x, y; /* y down, from the upper left of the display window */
} point;

/* Where a stored pixel is seen, by the numbers of Exif and TIFF. w and h are those of the stored
   display window. */
static point seen_at(int orientation, int32_t x, int32_t y, int32_t w, int32_t h)
{
    const int32_t left = w - 1 - x, up = h - 1 - y;
    switch (orientation) {
    case 2:
        return (point){left, y};
    case 3:
        return (point){left, up};
    case 4:
        return (point){x, up};
    case 5:
        return (point){y, x};
    case 6:
        return (point){up, x};
    case 7:
        return (point){up, left};
    case 8:
        return (point){y, left};
    default:
        return (point){x, y};
    }
}

static void turn_pixels(const wo_io_part *part, int orientation, wo_rect data, int32_t height,
                        float *to)
{
    const wo_rect old = part->data_window;
    const int32_t w = wo_rect_width(part->display_window);
    const int32_t h = wo_rect_height(part->display_window);
    const size_t bytes = (size_t)part->channels * sizeof(float);
    const float *from = part->pixels;
    for (int32_t y = old.y1; y < old.y2; y++)
        for (int32_t x = old.x1; x < old.x2; x++, from += part->channels) {
            const point p = seen_at(orientation, x, h - 1 - y, w, h);
            const size_t row = (size_t)(height - 1 - p.y - data.y1);
            const size_t at = row * (size_t)wo_rect_width(data) + (size_t)(p.x - data.x1);
            memcpy(to + at * (size_t)part->channels, from, bytes);
        }
}

wo_status wo_io_part_upright(wo_io_part *part, wo_error *error)
{
    const wo_io_attribute *const said = wo_io_part_find(part, "Orientation");
    const int orientation = said && said->type == WO_IO_INT ? (int)said->number : 1;
    if (orientation < 2 || orientation > 8)
        return WO_OK;
    const wo_rect old = part->data_window;
    const int32_t w = wo_rect_width(part->display_window);
    const int32_t h = wo_rect_height(part->display_window);
    const bool turned = orientation >= 5;
    const int32_t height = turned ? w : h;
    const point a = seen_at(orientation, old.x1, h - 1 - old.y1, w, h);
    const point b = seen_at(orientation, old.x2 - 1, h - old.y2, w, h);
    const wo_rect data = {a.x < b.x ? a.x : b.x, height - 1 - (a.y > b.y ? a.y : b.y),
                          (a.x > b.x ? a.x : b.x) + 1, height - (a.y < b.y ? a.y : b.y)};
    if (part->pixels) {
        const size_t pixels = (size_t)wo_rect_width(old) * (size_t)wo_rect_height(old);
        float *const upright = calloc(pixels, (size_t)part->channels * sizeof *upright);
        if (!upright)
            return wo_fail(error, WO_ERR_NOMEM, "no memory to turn %d x %d pixels", (int)w, (int)h);
        turn_pixels(part, orientation, data, height, upright);
        free(part->pixels);
        part->pixels = upright;
    }
    part->data_window = data;
    part->display_window = (wo_rect){0, 0, turned ? h : w, height};
    if (turned)
        part->pixel_aspect = 1 / part->pixel_aspect;
    return wo_io_part_add(part, "Orientation", WO_IO_INT, 1, NULL, NULL, error);
}
