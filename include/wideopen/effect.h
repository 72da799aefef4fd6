/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WIDEOPEN_EFFECT_H
#define WIDEOPEN_EFFECT_H

#include "wideopen/camera.h"
#include "wideopen/context.h"
#include "wideopen/image.h"
#include "wideopen/param.h"
#include "wideopen/report.h"

#ifdef __cplusplus
extern "C" {
#endif

/* An effect as data and a few functions: what a plugin, a command or a program runs.

   The way of a picture:   params (what the user wants)
                             -> region     what is needed of each clip for a window
                             -> plan       made once, const, shared by all threads
                             -> render     any window inside the planned one
                             -> report     what it did and cost
*/

#define WO_CLIPS_MAX 16

/* Legal components of a clip, or-ed. */
enum { WO_COMPONENT_ALPHA = 1, WO_COMPONENT_RGB = 2, WO_COMPONENT_RGBA = 4 };

typedef struct wo_clip {
    const char *name; /* OFX clip name: "Source", "Depth" ... */
    const char *label;
    const char *help;
    uint32_t components; /* WO_COMPONENT_* */
    bool optional;
    bool mask; /* a matte: one channel, no colour */
    bool data; /* numbers, not colour (depth): no colour management */
} wo_clip;

typedef struct wo_param_group {
    const char *key;
    const char *label;
    bool open; /* shown open at first */
} wo_param_group;

/* What is known about the picture before its pixels. Sizes in pixels at the present render scale.
 */
typedef struct wo_geometry {
    wo_rect format;       /* the frame the camera saw: its width is the sensor's width */
    wo_rect extent;       /* where Source has pixels (region of definition) */
    double render_scale;  /* horizontal; parameters in px are multiplied by it */
    double pixel_stretch; /* height of a horizontal pixel's worth in vertical pixels:
                             pixel aspect ratio times vertical over horizontal render scale */
    double pixel_aspect;  /* pixel aspect ratio: points are in canonical coordinates, which are
                             px times it, over the render scale */
    bool connected[WO_CLIPS_MAX];
    wo_camera camera; /* that the picture's metadata names; zero where nothing is known */
} wo_geometry;

#define WO_GEOMETRY_INIT                                                                           \
    {                                                                                              \
        .render_scale = 1, .pixel_stretch = 1, .pixel_aspect = 1                                   \
    }

/* State of Source's alpha; outputs are always premultiplied. */
typedef enum wo_alpha {
    WO_ALPHA_PREMULTIPLIED,
    WO_ALPHA_UNPREMULTIPLIED,
    WO_ALPHA_OPAQUE
} wo_alpha;

/* Pixels for a plan. The views are borrowed until the plan is destroyed. A clip without pixels
   has inputs[i].data == NULL. Bounds must hold what region() asked for, cut to the extent of
   Source; beyond the bounds an input repeats its edge pixel. (The OFX glue gives colour and mask
   clips that are smaller than Source a border of zeros; depth repeats its edge.) */
typedef struct wo_plan_args {
    wo_geometry geometry;
    wo_rect window;         /* what will be rendered */
    const wo_image *inputs; /* [clip_count] in the order of wo_effect.clips */
    wo_alpha alpha[WO_CLIPS_MAX];
} wo_plan_args;

typedef struct wo_plan wo_plan; /* each effect has its own */

typedef struct wo_effect {
    const char *name;  /* "LensBlur": last part of the OFX identifier */
    const char *label; /* "Lens Blur" */
    const char *help;  /* one paragraph */
    size_t params_size;
    const wo_param *params;
    size_t param_count;
    const wo_param_group *groups;
    size_t group_count;
    const wo_clip *clips; /* clips[0] is Source */
    size_t clip_count;

    /* Region of clip needed to render window, in px, before cutting to the clip's extent. */
    wo_status (*region)(const void *params, const wo_geometry *geometry, wo_rect window,
                        size_t clip, wo_rect *needed, wo_error *error);

    /* Index of the clip the output is a plain copy of, or -1; decided without pixels. */
    int (*identity)(const void *params, const wo_geometry *geometry);

    /* How many of the points marked wo_param.overlay are in use, the first ones of the table;
       *joined says whether they belong together (a plane through them) and are shown joined by
       lines. NULL: all of them, each for itself. */
    int (*handles)(const void *params, bool *joined);

    /* *plan is NULL after a failure. One thread; the work inside uses context->runner. Keeps a copy
       of params, and of *context, whose pointers must stay valid until the plan is destroyed. */
    wo_status (*plan_create)(const wo_context *context, const void *params,
                             const wo_plan_args *args, wo_plan **plan, wo_error *error);

    /* Plan as text for people, as snprintf. */
    int (*plan_print)(const wo_plan *plan, char *buffer, size_t size);

    /* What planning has to report; its warnings are known before anything is rendered. Borrowed
       from the plan. NULL: planning warns of nothing. */
    const wo_report *(*plan_report)(const wo_plan *plan);

    /* Writes window of output (RGBA, premultiplied); window must lie inside the planned one and
       output->bounds; its part beyond geometry.extent becomes 0. report may be NULL; else it is
       added to. Any thread, also several windows of one plan at once. Returns
       WO_ABORTED when the caller wanted to stop. */
    wo_status (*render)(const wo_plan *plan, wo_rect window, const wo_image *output,
                        wo_report *report, wo_error *error);

    /* Takes NULL and half-built plans; sets *plan to NULL. */
    void (*plan_destroy)(wo_plan **plan);
} wo_effect;

/* All effects of the library; ends with NULL. */
extern const wo_effect *const wo_effects[];

/* Effect by name, or NULL. */
const wo_effect *wo_effect_find(const char *name);

/* One call for programs: checks params, plans and renders window into output. */
WO_NODISCARD wo_status wo_effect_run(const wo_effect *effect, const wo_context *context,
                                     const void *params, const wo_plan_args *args,
                                     const wo_image *output, wo_report *report, wo_error *error);

#ifdef __cplusplus
}
#endif
#endif
