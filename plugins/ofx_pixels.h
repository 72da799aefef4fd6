/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_PLUGINS_OFX_PIXELS_H
#define WO_PLUGINS_OFX_PIXELS_H

#include "wideopen/image.h"

/* Pixels as hosts store them, to and from 32-bit float. Byte and short are full range: 255 and
   65535 are 1. Nothing here touches a colour space. */

typedef enum wo_depth { WO_DEPTH_BYTE, WO_DEPTH_SHORT, WO_DEPTH_HALF, WO_DEPTH_FLOAT } wo_depth;

/* A borrowed view of a host's pixels; data need not be aligned, row_bytes may be negative. */
typedef struct wo_pixels {
    void *data; /* pixel (bounds.x1, bounds.y1) */
    wo_rect bounds;
    ptrdiff_t row_bytes;
    int32_t components; /* 1, 3 or 4 */
    wo_depth depth;
} wo_pixels;

size_t wo_depth_bytes(wo_depth depth);

/* A positive finite float, or any other: exact both ways; to half rounds to nearest even. */
float wo_half_to_float(uint16_t half);
uint16_t wo_float_to_half(float value);

/* Fills the whole of to from from, whose bounds must hold those of to. Components are mapped: one
   channel is spread over R, G, B with alpha 1; RGB gets alpha 1; to one channel goes the alpha of
   RGBA, or the R of RGB. Any thread. */
void wo_pixels_read(const wo_pixels *from, const wo_image *to);

/* Writes the whole of from, RGBA, into to, whose bounds must hold it. RGB drops the alpha, one
   channel is the alpha. Integers are clamped and rounded, NaN is 0. Any thread. */
void wo_pixels_write(const wo_image *from, const wo_pixels *to);

#endif
