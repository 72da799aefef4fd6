/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_MARCH_H
#define WO_CORE_DEFOCUS_MARCH_H

#include "defocus/stack.h"
#include "optics/pencil.h"

/* Lens rays through a stack (Lee, Eisemann, Seidel 2010, section 3.1; Jeong, section 3.4).

   A ray walks along its footprint, the line p(v) from the nearest vergence to the farthest, one
   pixel of its longer axis at a time, and looks at every sheet at once. The patch of a pixel is
   hit where the ray, at the patch's vergence, is within half a pixel of it, or where it passed from
   before to behind a surface that is connected: no step that is more than WO_CONNECT_PX for this
   ray. So a surface whose blur grows is let go of by one ray after the other, those through the
   rim of the lens first, and nothing pops. The nearest hit comes first; coverage below 1 lets the
   rest of the light through. Light that is left where the scene is opaque saw something that no
   sheet holds: the ray counts only as far as it was stopped. */
#define WO_CONNECT_PX 1.5f
/* Up to so many px from the pixel itself, colours are interpolated between pixels that are
   connected for the ray; farther out the blur hides the difference. */
#define WO_SMOOTH_PX 4
/* Light below this fraction is not followed further. */
#define WO_LIGHT_MIN (1.0f / 1024)

/* What the kernels need of one tile. */
typedef struct wo_march_view {
    int sheets;
    const float *v[WO_SHEETS_MAX];
    const float *c[WO_SHEETS_MAX][4];
    bool guessed[WO_SHEETS_MAX];
    const float *opaque;             /* of the stack */
    ptrdiff_t run, row;              /* of the stack */
    wo_bounds bounds[WO_SHEETS_MAX]; /* of each sheet over the footprint of the tile */
    const wo_span *spans[WO_SHEETS_MAX];
    int32_t span_columns;
    float v_apart; /* dioptres, > 0: surfaces nearer than this, or farther than minus this, are
                      summed apart as well */
} wo_march_view;

/* Red, green, blue; the coverage that each of them met; coverage over the distance from the focus
   in dioptres, which gives the harmonic mean of blur. */
#define WO_PART_COVERAGE 3
#define WO_PART_BLUR     6
#define WO_PART_SUMS     7

/* Sums over a pencil, for the pixels of a vector. */
typedef struct wo_march_sums {
    float c[4][WO_LANES];               /* r g b a, times their weights */
    float weight[4][WO_LANES];          /* a ray's weight for alpha is the mean of its three */
    float guessed[WO_LANES];            /* part of the light that came from invented surfaces */
    float near[WO_PART_SUMS][WO_LANES]; /* the part of c in front of the focus by v_apart ... */
    float far[WO_PART_SUMS][WO_LANES];  /* ... and behind; only march_apart fills them */
    int64_t steps;                      /* lookups of a sheet, each for one pixel */
} wo_march_sums;

/* (x, y): place of the first pixel of a block relative to the stack's area, x a multiple of
   WO_BLOCK; run_index 0..3 picks the vector of the block. sums are overwritten. */
typedef void wo_march_function(const wo_march_view *view, int32_t x, int32_t y, int run_index,
                               const wo_pencil *pencil, wo_march_sums *sums);

typedef struct wo_march_kernels {
    wo_march_function *march;       /* any scene */
    wo_march_function *march_apart; /* the same, with the sums of near and far */
    wo_march_function *single; /* one sheet without gaps whose vergences differ by less than a px of
                                  blur: one lookup for each ray */
} wo_march_kernels;

/* Kernels for these instruction sets (WO_CPU_*). */
const wo_march_kernels *wo_march_choose(int cpu);

extern const wo_march_kernels wo_march_base;
/* One pixel at a time in double precision: the slow twin, for tests and timing. */
extern const wo_march_kernels wo_march_reference;
#if defined(__x86_64__)
extern const wo_march_kernels wo_march_avx2;
#endif

#endif
