/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_FOOTAGE_PEEL_H
#define WO_FOOTAGE_PEEL_H

#include "camera.h"
#include "scene.h"

/* What the rays of one pixel met, and how that becomes layers. */

#define WO_PEEL_SAMPLES_MAX (WO_FOOTAGE_SAMPLES_MAX + 1)
#define WO_PEEL_DEPTH_MAX   24 /* hits of one ray */
#define WO_PEEL_LAYERS_MAX  16 /* before the umbra takes some away */

typedef struct wo_peel_hit {
    float z;        /* planar depth */
    float sheet;    /* of the shape */
    uint64_t piece; /* equal for what may be one surface */
    float rgb[3];
    int patch; /* used while patches are formed */
} wo_peel_hit;

/* Sample 0 is the ray through the pixel's centre; it gives depth and no colour. */
typedef struct wo_peel_pixel {
    int samples;                       /* with sample 0 */
    float footprint;                   /* width of a pixel at depth 1, m */
    float offset[WO_PEEL_SAMPLES_MAX]; /* squared distance from the centre, px */
    int count[WO_PEEL_SAMPLES_MAX];
    wo_peel_hit hit[WO_PEEL_SAMPLES_MAX][WO_PEEL_DEPTH_MAX];
} wo_peel_pixel;

/* One layer at one pixel; coverage 0 = empty. */
typedef struct wo_peel_layer {
    float rgba[4]; /* premultiplied */
    float z;
} wo_peel_layer;

/* The k-th hits to layer k. Returns how many of the layers are filled; the rest is zero. */
int wo_peel_hits(const wo_peel_pixel *pixel, int layers, wo_peel_layer *out);

/* One surface to a layer, see WO_FOOTAGE_PATCHES. *dropped is raised by the patches behind the last
   layer. Hits of pixel get their patch. */
int wo_peel_patches(wo_peel_pixel *pixel, int layers, wo_peel_layer *out, int64_t *dropped);

/* Pinhole colour, and depth and normal at the centre. */
void wo_peel_first(const wo_peel_pixel *pixel, float rgba[4], float *z);

/* Leaves out patches that no ray through the lens reaches, and moves deeper ones up. Lee, Eisemann
   and Seidel 2010 (section 3.1): a pixel at depth d that reaches to the centres of its neighbours,
   s to each side, hides everything down to the depth d + d s / (E - s), and all there is when E <=
   s. With s = d / F that is K (1/d - 1/z) <= 1 px, K = F E. Here the neighbours must be there: all
   nine pixels round the patch need a whole patch in front of it by that rule, so nothing that can
   be seen is lost. Images are layers before, filled in the first count; work has room for a byte
   per pixel and layer. Returns the number of patches left out. */
int64_t wo_peel_umbra(const wo_camera *camera, wo_image *layer, wo_image *layer_depth, int layers,
                      uint8_t *work);

#endif
