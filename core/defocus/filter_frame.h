/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_FILTER_FRAME_H
#define WO_CORE_DEFOCUS_FILTER_FRAME_H

#include "defocus/renderer.h"

/* The method `filter` (filter.h) for methods that build on it. with_rays: tiles that the filter
   cannot do are given to lens rays; otherwise they are left black and frame->mask, which is 0
   elsewhere, is 1 there. scene->rays must hold 1 px around the frame. */
WO_NODISCARD wo_status wo_filter_frame(const wo_defocus *scene, const wo_frame *frame,
                                       bool with_rays, wo_report *report, wo_error *error);

#endif
