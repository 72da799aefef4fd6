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

/* The soft disc that stands for a circle of confusion of radius r, in px: it reaches so far, half
   of its edge of one px beyond, and a pixel under it gets this share of the light. Its second
   moment over the pixels is that of the circle, so that small circles blur as much as they should;
   radius 0 reaches no neighbour. */
static inline float wo_filter_reach(float r)
{
    const float rr = r * r;
    const float small = rr < 1 ? 1 - rr : 0;
    const float inner = small * (0.6875f + 0.3125f * small);
    const float moment = rr - 5.0f / 12 + 0.66666f * inner;
    return sqrtf(moment > 0.25f ? moment : 0.25f);
}

static inline float wo_filter_share(float reach, float hole)
{
    const float gap = (reach - 0.5f) * hole - 0.5f;
    const float open = gap > 0 ? gap * gap : 0;
    const float area = 3.14159265f * (reach * reach + 0.0683f - open);
    return area > 1 ? 1 / area : 1;
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
