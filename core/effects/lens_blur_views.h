/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_EFFECTS_LENS_BLUR_VIEWS_H
#define WO_CORE_EFFECTS_LENS_BLUR_VIEWS_H

#include "effects/lens_blur_plan.h"

/* What LensBlur can show besides the picture; the row of each wo_lens_blur_output. */
typedef struct wo_view {
    bool rendered; /* shows what only rendering tells: frame is there; else it is NULL */
    void (*pixel)(const wo_plan *plan, const wo_frame *frame, int32_t x, int32_t y, float out[4]);
} wo_view;

extern const wo_view wo_views[WO_OUTPUT_COUNT];

/* Place of pixel (x, y) in the planes of a frame. */
static inline size_t wo_frame_at(const wo_frame *frame, int32_t x, int32_t y)
{
    return (size_t)(y - frame->window.y1) * (size_t)wo_rect_width(frame->window) +
           (size_t)(x - frame->window.x1);
}

#endif
