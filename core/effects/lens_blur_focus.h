/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_EFFECTS_LENS_BLUR_FOCUS_H
#define WO_CORE_EFFECTS_LENS_BLUR_FOCUS_H

#include "effects/lens_blur.h"
#include "focus/focus.h"

/* Focus control of LensBlur: from parameters, depth under the points and the Focus clip to what is
   in focus where. */

/* wo_effect.handles. */
int wo_lens_blur_handles(const void *params, bool *joined);

/* Without pixels: is the focus one distance, and that the focus distance? */
bool wo_lens_blur_focus_is_plain(const wo_lens_blur_params *params, bool has_map);

/* Pixels that are read for the points, whatever is rendered; empty when none are. All tiles read
   the same, so that all have the same focus. */
wo_rect wo_lens_blur_focus_area(const wo_lens_blur_params *params, const wo_geometry *geometry,
                                bool has_map);

/* Reads the points and makes the focus; then setup's lens focuses where the focus crosses the axis
   (with breathing no nearer than at twice the focal length), and v_min, v_max follow. */
WO_NODISCARD wo_status wo_lens_blur_focus_make(const wo_lens_blur_params *params,
                                               const wo_plan_args *args, wo_lens_blur_setup *setup,
                                               wo_focus *focus, wo_error *error);

#endif
