/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_FOOTAGE_TEXTURE_H
#define WO_FOOTAGE_TEXTURE_H

#include "vec.h"
#include "wideopen/base.h"

/* Solid textures: colours of points in space, so they need no seams and fit any shape. Cells have
   the size 1; q.y is the way up for those that know one. Edges are ramps, not steps. */
typedef enum wo_texture_kind {
    WO_TEXTURE_PLAIN,   /* a */
    WO_TEXTURE_CHECKER, /* cells of a and b */
    WO_TEXTURE_STRIPES, /* across x */
    WO_TEXTURE_DOTS,    /* balls of b in a */
    WO_TEXTURE_MARBLE,  /* clouds of a and b */
    WO_TEXTURE_VEINS,   /* thin winding lines of b in a */
    WO_TEXTURE_BRICKS,  /* in the xy plane: bricks of 2 x 1 in shades of a, joints of b */
    WO_TEXTURE_BOARDS,  /* in the xz plane: boards along z in shades between a and b */
    WO_TEXTURE_RINGS,   /* round the y axis, like wood */
    WO_TEXTURE_CHART,   /* in the xz plane: checker, discs, rules and crosses in turn */
    WO_TEXTURE_WAVES /* half way from a to b, plus sin(2 pi x) and sin(2 pi y) of a quarter each */
} wo_texture_kind;

typedef struct wo_texture {
    wo_texture_kind kind;
    float a[3], b[3];  /* scene-linear Rec.709 reflectances, 0..1 */
    float scale;       /* cells per metre */
    float grain;       /* 0..1: clouds that darken and brighten by this much */
    float grain_scale; /* cells of the clouds per cell of the texture */
} wo_texture;

/* Values on a lattice, for clouds; 4096 numbers of 0..1. */
typedef struct wo_noise {
    float value[4096];
} wo_noise;

void wo_noise_make(uint64_t seed, wo_noise *noise);

/* Smooth noise, mean about 0.5, features of size 1. */
float wo_noise_at(const wo_noise *noise, wo_vec q);

/* octaves of it, each half as large and half as strong as the one before; 0..1. */
float wo_noise_clouds(const wo_noise *noise, wo_vec q, int octaves);

/* Colour at q, which is already in cells. Does not fail. */
void wo_texture_at(const wo_texture *texture, const wo_noise *noise, wo_vec q, float rgb[3]);

#endif
