/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TESTS_SCENES_H
#define WO_TESTS_SCENES_H

#include "effects/lens_blur.h"
#include "wideopen/effect.h"

#include <math.h>

/* Small made-up scenes for LensBlur, and a way to run it. Helpers fail the running test when
   something goes wrong that the test did not ask for. */

/* Repeatable random numbers: splitmix64. */
typedef struct rng {
    uint64_t state;
} rng;

uint64_t rng_bits(rng *r);
double rng_unit(rng *r); /* 0 <= x < 1 */
double rng_range(rng *r, double low, double high);
int32_t rng_int(rng *r, int32_t low, int32_t high); /* both ends included */

/* A picture with memory of its own. */
wo_image picture_make(wo_rect bounds, int32_t components);
void picture_free(wo_image *picture);
/* Same pixels, with rows of pad more floats and, if upside_down, the last row first in memory. */
wo_image picture_relaid(const wo_image *picture, int32_t pad, bool upside_down);
void picture_free_relaid(wo_image *picture, bool upside_down);
void picture_fill(const wo_image *picture, const float *pixel);
/* Largest absolute difference of any sample over bounds; infinity when one is not finite. */
double picture_difference(const wo_image *a, const wo_image *b, wo_rect bounds);
double picture_rms(const wo_image *a, const wo_image *b, wo_rect bounds);
bool picture_same_bytes(const wo_image *a, const wo_image *b, wo_rect bounds);
bool picture_finite(const wo_image *picture);

/* A scene: parameters at their defaults, format = extent, Source premultiplied. */
typedef struct scene {
    wo_lens_blur_params params;
    wo_geometry geometry;
    wo_alpha alpha[WO_CLIPS_MAX];
    wo_image clip[WO_LENS_BLUR_CLIPS]; /* owned */
} scene;

void scene_init(scene *s, wo_rect extent);
void scene_free(scene *s);
/* Makes a clip's picture over the extent, zero. */
wo_image *scene_clip(scene *s, int clip, int32_t components);
/* Sets f-number so that a dioptre away from focus has this radius in px. */
void scene_px_per_dioptre(scene *s, double px);

wo_plan_args scene_args(const scene *s, wo_rect window);
/* Plans for window and renders it into out, whose bounds must hold it. */
wo_status scene_run(const scene *s, const wo_context *context, wo_rect window, const wo_image *out,
                    wo_report *report, wo_error *error);
/* The whole extent with the default context; never fails. */
wo_image scene_render(const scene *s, wo_report *report);

/* Random smooth colours, opaque; a slope of depth with two boxes of other depths on it and a step
   across. seed chooses. */
void scene_fill_busy(scene *s, uint64_t seed);
/* Source and Depth, and a second layer behind holes: coverage 0..1 in the front layer. */
void scene_fill_layers(scene *s, uint64_t seed);

/* A window with its first corner in a rectangle and sides of 1..width and 1..height px. */
wo_rect random_window(rng *r, wo_rect in, int32_t width, int32_t height);
/* Renders a window, out of no more of each clip than region() asks for: the same bytes as in the
   picture of the whole extent, and zero beyond it. */
void scene_check_window(const scene *s, const wo_context *context, wo_rect window,
                        const wo_image *whole);

/* count threads for each run; plain data, needs no end. */
wo_runner threads_runner(const unsigned *count);

#endif
