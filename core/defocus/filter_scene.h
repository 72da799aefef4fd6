/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_FILTER_SCENE_H
#define WO_CORE_DEFOCUS_FILTER_SCENE_H

#include "defocus/filter.h"
#include "wideopen/status.h"

#include <math.h>

/* What the filter knows of a lens around one place of the picture: how large and of which shape the
   circle of confusion is at a vergence. Taken from the lens's own pencils, whatever the lens. */
enum { WO_FILTER_BINS = 64 };
typedef struct wo_filter_shape {
    float v0;   /* dioptres: vergence of the smallest circle */
    float ppd;  /* px per dioptre: radius of the disc of the same area */
    float rest; /* px: root mean square of what does not come to the focus, at v0 */
    float hole; /* of the aperture, over its extent; 0 = none */
    float lit;  /* part of the rays that carry light */
    float outer[WO_FILTER_BINS]; /* extent of the aperture by direction (wo_filter_bin), over ppd,
                                    for what is in front of the focus */
} wo_filter_shape;

/* Direction of (x, y), not (0, 0): 0..WO_FILTER_BINS - 1. */
int wo_filter_bin(float x, float y);

/* Soft discs (filter.h) for circles of confusion of radius i / WO_FILTER_FINE px: their reach, and
   the share of the light that a pixel in the middle of one gets. The second moment of a disc over
   the pixels is that of the circle, so that small circles blur as much as they should and grow
   evenly; radius 0 reaches no neighbour. */
enum { WO_FILTER_FINE = 32, WO_FILTER_RADII = 3 * WO_FILTER_FINE };
typedef struct wo_filter_discs {
    float reach[WO_FILTER_RADII + 2];
    float share[WO_FILTER_RADII + 2];
} wo_filter_discs;
void wo_filter_discs_make(wo_filter_discs *discs);

/* The disc for radius r; hole as in wo_filter_shape. */
static inline void wo_filter_disc(const wo_filter_discs *discs, float r, float hole, float *reach,
                                  float *share)
{
    const float at = r * WO_FILTER_FINE;
    if (at < WO_FILTER_RADII) {
        const int i = (int)at;
        const float t = at - (float)i;
        *reach = discs->reach[i] + t * (discs->reach[i + 1] - discs->reach[i]);
        *share = discs->share[i] + t * (discs->share[i + 1] - discs->share[i]);
    } else {
        /* The edge lies so far inside, and has such a variance. */
        const float inside = 7.0f / 18;
        const float variance = 8.0f / 81;
        const float edge = sqrtf(r * r - 5 * variance);
        *reach = edge + inside;
        *share = 1 / (3.14159265f * (edge * edge + variance));
    }
    const float gap = (*reach - 0.5f) * hole - 0.5f;
    if (gap > 0)
        *share /= 1 - 3.14159265f * gap * gap * *share;
}

/* Radius of the circle of confusion d px from the smallest. */
static inline float wo_filter_radius(const wo_filter_shape *shape, float d)
{
    return sqrtf(d * d + shape->rest * shape->rest);
}

/* The scene as two pictures, and the shape of the aperture on a grid over it. */
typedef struct wo_filter_scene {
    const wo_stack *stack;
    const wo_lens *lens;
    wo_filter_discs discs;
    wo_rect area;   /* of the pictures: on the grid of a stack */
    wo_rect blocks; /* of shapes, in units of blocks, absolute */
    wo_filter_shape *shape;
    wo_filter_view view; /* set hole to that of the shape */
    float *memory;
    uint8_t *flags; /* of each WO_BLOCK x WO_CELL px of area */
} wo_filter_scene;

/* What is anywhere in a block of flags. */
enum { WO_FILTER_FAR = 1, WO_FILTER_OPEN = 2 };

/* area: what taps can look at; inside that of the stack. */
WO_NODISCARD wo_status wo_filter_scene_create(const wo_context *context, const wo_stack *stack,
                                              const wo_lens *lens, wo_rect area,
                                              wo_filter_scene *scene, wo_error *error);
void wo_filter_scene_destroy(const wo_context *context, wo_filter_scene *scene);

/* The shape for pixel (x, y) of the area. */
const wo_filter_shape *wo_filter_shape_at(const wo_filter_scene *scene, int32_t x, int32_t y);

/* The scene as seen by taps in r, which lies inside the area: no more of it than is there. */
wo_filter_view wo_filter_view_of(const wo_filter_scene *scene, wo_rect r);

#endif
