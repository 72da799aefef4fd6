/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WIDEOPEN_IMAGE_H
#define WIDEOPEN_IMAGE_H

#include "wideopen/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Half-open rectangle of pixels: x1 <= x < x2, y1 <= y < y2; y points up as in OpenFX.
   Pixel (x, y) covers the unit square whose centre is (x + 0.5, y + 0.5). */
typedef struct wo_rect {
    int32_t x1, y1, x2, y2;
} wo_rect;

/* None of these fails; empty rectangles come back as {0, 0, 0, 0}. Any thread. */
bool wo_rect_empty(wo_rect r);
int32_t wo_rect_width(wo_rect r);
int32_t wo_rect_height(wo_rect r);
wo_rect wo_rect_intersect(wo_rect a, wo_rect b);
wo_rect wo_rect_union(wo_rect a, wo_rect b);
wo_rect wo_rect_grow(wo_rect r, int32_t dx, int32_t dy);
bool wo_rect_contains(wo_rect outer, wo_rect inner);
bool wo_rect_equal(wo_rect a, wo_rect b);

/* Largest side of an image the core takes, and largest absolute pixel coordinate. */
#define WO_MAX_SIDE       65536
#define WO_MAX_COORDINATE (1 << 24)

/* A borrowed view of interleaved 32-bit float pixels (1 = alpha or any single channel, 3 = RGB,
   4 = RGBA). data addresses pixel (bounds.x1, bounds.y1); row_bytes may be negative or padded. A
   view with data = NULL is "not connected". Ownership stays with whoever made it. */
typedef struct wo_image {
    float *data;
    wo_rect bounds;
    ptrdiff_t row_bytes;
    int32_t components;
} wo_image;

/* Address of pixel (x, y); the caller keeps inside the bounds. */
static inline float *wo_image_at(const wo_image *image, int32_t x, int32_t y)
{
    return (float *)((char *)image->data + (ptrdiff_t)(y - image->bounds.y1) * image->row_bytes) +
           (ptrdiff_t)(x - image->bounds.x1) * image->components;
}

/* Checks a view: components 1, 3 or 4, sane bounds, rows that do not overlap. An unconnected view
   is valid. name goes into the text. Any thread. */
WO_NODISCARD wo_status wo_image_validate(const wo_image *image, const char *name, wo_error *error);

#ifdef __cplusplus
}
#endif
#endif
