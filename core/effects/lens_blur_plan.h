/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_EFFECTS_LENS_BLUR_PLAN_H
#define WO_CORE_EFFECTS_LENS_BLUR_PLAN_H

#include "defocus/renderer.h"
#include "effects/lens_blur.h"
#include "optics/pencil_table.h"

/* The plan of LensBlur: the scene made ready, the lens, a class for every tile. */
struct wo_plan {
    wo_context context;
    wo_lens_blur_params params;
    wo_lens_blur_setup setup;
    wo_geometry geometry;
    wo_rect window;
    wo_image mask, source; /* borrowed */
    wo_alpha source_alpha;
    wo_thin_pencils *pencils; /* the one or the other */
    wo_table_pencils *table;
    wo_table_facts facts; /* of the table */
    double f_number;      /* reached by the lens */
    wo_lens lens;
    wo_stack stack;
    wo_highlights highlights;
    wo_lens_rays rays;
    wo_quality quality;
    uint8_t *split;   /* over the window, only for the view: WO_SPLIT_* */
    wo_report report; /* of the planning; counted with the first window that is rendered */
};

enum { WO_SPLIT_NONE, WO_SPLIT_DEPTH, WO_SPLIT_TWO };

wo_status wo_lens_blur_plan_create(const wo_context *context, const void *params,
                                   const wo_plan_args *args, wo_plan **plan, wo_error *error);
int wo_lens_blur_plan_print(const wo_plan *plan, char *buffer, size_t size);
wo_status wo_lens_blur_render(const wo_plan *plan, wo_rect window, const wo_image *output,
                              wo_report *report, wo_error *error);
void wo_lens_blur_plan_destroy(wo_plan **plan);

/* Seconds of a steady clock. */
double wo_seconds(void);

#endif
