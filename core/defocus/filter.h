/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_FILTER_H
#define WO_CORE_DEFOCUS_FILTER_H

#include "defocus/stack.h"
#include "optics/pencil.h"

/* Scatter-as-you-gather (Jimenez 2014; Tan et al. 2022 as told in Marsicano 2024, sections 5.0.1
   and 5.1.1): a pixel gathers from taps over the aperture, and each tap counts as far as its own
   circle of confusion reaches the pixel, divided by the area of that circle.

   What reaches a pixel is kept in three classes, by its vergence against the pixel's own surface:
   before it, of it, behind it. They are put together at the end, front to back:
       before + (1 - A(before)) (own + (1 - A(own)) behind / max(W(behind), A(behind))).
   Classes are told apart by more than CLASS_PX of blur, and more the farther the tap is away, so
   that a slope remains one surface. */

/* A soft disc of reach R stands for a circle of confusion. The light of a place so many px from its
   middle is the square of (R + 1/2 - away) (1 - SOFT min(R - 1/2, 1)), cut to 0..1: an edge of one
   px where the next pixels alone are reached, of 4/3 px soon after. The square, so that a pixel
   that a growing disc comes to gets little light at first: a bright point must not pop. R >= 1/2.
 */
#define WO_FILTER_SOFT 0.25f
static inline float wo_filter_soft(float reach, float away)
{
    const float r = reach - 0.5f;
    const float t = (r + 1 - away) * (1 - WO_FILTER_SOFT * (r < 1 ? r : 1));
    return t <= 0 ? 0 : t >= 1 ? 1 : t * t;
}

/* The scene as two pictures, the nearest surfaces and what is next behind them, on the layout of a
   stack. d is the vergence from the best focus, in px of blur radius; where there is no surface it
   and reach are WO_FILTER_NONE (or 0) and the rest is 0. */
#define WO_FILTER_NONE (-1e6f)
typedef struct wo_filter_picture {
    const float *d;
    const float *reach;   /* px: of the soft disc */
    const float *share;   /* one over the sum of the soft disc: of its light that a pixel gets */
    const float *cover;   /* coverage 0..1 */
    const float *c[3];    /* premultiplied, times share */
    const float *guessed; /* 1 where invented; NULL = nowhere */
} wo_filter_picture;

typedef struct wo_filter_view {
    wo_filter_picture near;
    wo_filter_picture far; /* far.d NULL = there is none */
    const float *open;     /* 1 where the scene may let light through; NULL = nowhere */
    ptrdiff_t run, row;    /* as in a stack */
    float hole;            /* of the aperture: radius, of the outer one; 0 = none */
} wo_filter_view;

/* Taps for all pixels of a vector, at whole pixels from each. */
typedef struct wo_filter_taps {
    int count;
    int dx[WO_PENCIL_PIECE], dy[WO_PENCIL_PIECE];
    float away[WO_PENCIL_PIECE]; /* px */
    /* A surface that reaches so far is met; px over the extent of the aperture in the direction of
       the tap, but for the first px; infinite = not asked. */
    float before[WO_PENCIL_PIECE]; /* surfaces before the focus */
    float behind[WO_PENCIL_PIECE];
    float area[WO_PENCIL_PIECE]; /* px^2 that the tap stands for */
} wo_filter_taps;

enum { WO_FILTER_BEFORE, WO_FILTER_OWN, WO_FILTER_BEHIND, WO_FILTER_CLASSES };

typedef struct wo_filter_sums {
    float c[WO_FILTER_CLASSES][4][WO_LANES];
    float guessed[WO_FILTER_CLASSES][WO_LANES];
    float behind[WO_LANES];    /* W: what of the class behind there could be */
    float expected[WO_LANES];  /* area that the pixel's own circle takes */
    float own_share[WO_LANES]; /* of the pixel's own surface: with expected A(own), were all the
                                  world like the pixel */
    float open[WO_LANES];      /* part of expected where the scene may let light through */
    bool own_open[WO_LANES];   /* it may at the pixel itself */
} wo_filter_sums;

/* Adds taps to sums; (x, y), run_index as in march.h. Returns lookups, each for one pixel. */
typedef int64_t wo_filter_function(const wo_filter_view *view, int32_t x, int32_t y, int run_index,
                                   const wo_filter_taps *taps, wo_filter_sums *sums);

/* Middle of nine of each of count floats: rows[0..2] point at the first, one px left and right of
   them are read as well. count: a multiple of WO_LANES. A network of minima and maxima (Smith
   1996). */
typedef void wo_median_function(const float *const rows[3], int count, float *out);

typedef struct wo_filter_kernels {
    wo_filter_function *gather;
    wo_median_function *median;
} wo_filter_kernels;

const wo_filter_kernels *wo_filter_choose(int cpu);

extern const wo_filter_kernels wo_filter_base;
#if defined(__x86_64__)
extern const wo_filter_kernels wo_filter_avx2;
#endif

#endif
