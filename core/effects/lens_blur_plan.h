/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_EFFECTS_LENS_BLUR_PLAN_H
#define WO_CORE_EFFECTS_LENS_BLUR_PLAN_H

#include "defocus/renderer.h"
#include "effects/lens_blur.h"
#include "focus/focus.h"
#include "optics/lens_choice.h"
#include "optics/pencil_table.h"
#include "optics/pencil_tilt.h"

enum { WO_LEVELS_MAX = 12 };

/* The plan of LensBlur: the scene made ready, the lens, a class for every tile. */
struct wo_plan {
    wo_context context;
    wo_lens_blur_params params;
    wo_lens_blur_setup setup;
    wo_geometry geometry;
    wo_rect window;
    wo_image mask, source; /* borrowed */
    wo_alpha source_alpha;
    int lenses;                              /* all of one lens, with other numbers of rays */
    int levels;                              /* the first ones: more and more rays */
    int taps;                                /* one for wo_defocus.taps; -1 = not wanted */
    wo_thin_pencils *pencils[WO_LEVELS_MAX]; /* the one or the other */
    wo_table_pencils *table[WO_LEVELS_MAX];  /* [0] owns the table */
    wo_chosen_lens *chosen;                  /* what they were made of */
    wo_lens level[WO_LEVELS_MAX];
    wo_table_facts facts;       /* of the table */
    wo_aperture_shape aperture; /* for showing it */
    double aperture_scale;      /* 1 over its density where it is densest */
    double f_number;            /* reached by the lens */
    wo_focus focus;
    wo_lens upright[WO_LEVELS_MAX]; /* before the tilt */
    wo_tilted_pencils tilted[WO_LEVELS_MAX];
    wo_lens lens; /* the last level */
    double reach; /* px: no ray goes farther in this scene */
    wo_stack stack;
    wo_highlights highlights;
    wo_lens_rays rays;
    wo_quality quality;
    bool copy;        /* nothing is blurred: the source is the picture; lens, stack, highlights and
                         rays are not made */
    uint8_t *split;   /* over the window, only for the view: WO_SPLIT_* */
    wo_report report; /* of the planning; counted with the first window that is rendered */
};

enum { WO_SPLIT_NONE, WO_SPLIT_DEPTH, WO_SPLIT_TWO };

wo_status wo_lens_blur_plan_create(const wo_context *context, const void *params,
                                   const wo_plan_args *args, wo_plan **plan, wo_error *error);
int wo_lens_blur_plan_print(const wo_plan *plan, char *buffer, size_t size);
const wo_report *wo_lens_blur_plan_report(const wo_plan *plan);
/* Says that colour was cut, if any was. */
void wo_lens_blur_warn_of_colour(wo_report *report);
wo_status wo_lens_blur_render(const wo_plan *plan, wo_rect window, const wo_image *output,
                              wo_report *report, wo_error *error);
void wo_lens_blur_plan_destroy(wo_plan **plan);

/* The lens at every level, tilted as the focus wants it; needs params, geometry, setup and focus.
   What was made before a failure is destroyed with the plan. */
wo_status wo_lens_blur_lens_make(wo_plan *plan, wo_error *error);
void wo_lens_blur_lens_destroy(wo_plan *plan);

/* How a layer is read; layer WO_LENS_BLUR_LAYERS is the Background. */
wo_sheet_source wo_lens_blur_layer(const wo_plan *plan, const wo_plan_args *args, int layer);

/* Sets plan->copy when the one layer there is has no blur of WO_SHARP_PX anywhere; needs params,
   geometry, setup and focus, and a window that is not empty. What it costs to find out is a look at
   the depth, and less where there is blur. */
void wo_lens_blur_find_copy(wo_plan *plan, const wo_plan_args *args);

/* Renders such a plan; window lies inside the planned one. */
wo_status wo_lens_blur_copy(const wo_plan *plan, wo_rect window, const wo_image *output,
                            wo_report *report, wo_error *error);

/* Seconds of a steady clock. */
double wo_seconds(void);

#endif
