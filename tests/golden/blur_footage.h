/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TESTS_BLUR_FOOTAGE_H
#define WO_TESTS_BLUR_FOOTAGE_H

#include "effects/lens_blur.h"
#include "footage.h"
#include "wideopen/effect.h"

/* Puts a footage set through LensBlur with its own camera. layers 0: Source and Depth alone, else
   so many of its layers. *out is RGBA over the set's frame, to be freed by the caller with free().
 */
wo_status blur_footage(const wo_context *context, const wo_footage *set, int layers, int samples,
                       wo_image *out, wo_report *report, wo_error *error);

/* Parameters and clips of the same, for callers that plan by themselves. inputs has
   WO_LENS_BLUR_CLIPS entries. */
void blur_footage_setup(const wo_footage *set, int layers, int samples, wo_lens_blur_params *params,
                        wo_image *inputs, wo_plan_args *args);

#endif
