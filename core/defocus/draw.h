/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_DRAW_H
#define WO_CORE_DEFOCUS_DRAW_H

#include "defocus/march.h"
#include "defocus/pieces.h"

/* The picture seen from one point of the lens, drawn from pieces: a surface at pixel q and vergence
   v is seen at q - (A + B v) (Jeong, section 3.1). Hits, order and colours are those of march.h,
   with the roles of pixel and surface exchanged: a pixel of a surface is drawn where a ray would
   hit it, and into the cracks that a ray would cross.

   Solid pixels are drawn by whole vectors, nearest vergence wins; then thin ones come before them,
   nearest first. Lens rays that land on the same raster position everywhere are one view, drawn
   once and counted as often (Jeong, section 3.3). Each of them is then cast into the surfaces of
   that view, less than a pixel beside it (Jeong, section 3.4): it takes the mean colour of the
   neighbours that it passes between. Two cases miss: where the neighbour is another surface, the
   ray is stopped here and takes the colour of the view; where there is nothing at all, it goes on,
   and takes what is behind. */

/* A lens ray, in pixels of the level that is drawn. */
typedef struct wo_view_ray {
    float ax, ay, bx, by;
} wo_view_ray;

enum {
    WO_VIEW_ROWS = WO_TILE_HEIGHT,
    WO_VIEW_WIDTH = WO_TILE_WIDTH,
    WO_VIEW_ROW = WO_VIEW_WIDTH + 2 * WO_LANES, /* vectors may stick out on both sides */
    WO_VIEW_PLANE = WO_VIEW_ROWS * WO_VIEW_ROW
};

/* Planes of a view: vergence of the nearest solid surface (-infinity: none), premultiplied colour
   and coverage, part of the light that came from invented surfaces. */
enum { WO_VIEW_V, WO_VIEW_RED, WO_VIEW_ALPHA = WO_VIEW_RED + 3, WO_VIEW_GUESSED, WO_VIEW_PLANES };

/* A thin pixel's neighbours, and itself, the fifth: what they lend to a ray that takes them for one
   surface with it. */
typedef struct wo_thin_around {
    float c[9][4];
    float away[9]; /* dioptres; infinite where another sheet has a surface and this one has none */
} wo_thin_around;

/* A thin pixel of a tile. */
typedef struct wo_thin_at {
    const wo_piece *piece;
    const wo_thin_around *around; /* NULL = not wanted: its blur is large */
    float c[4];
    float drop; /* dioptres to its farthest neighbour */
    int16_t at; /* in the planes of the piece */
    int16_t guessed;
} wo_thin_at;

/* What the thin pixels of a view add up to, at one pixel. */
typedef struct wo_thin_sum {
    float c[4];
    float light, guessed; /* light that they let through */
} wo_thin_sum;

/* Where a thin pixel is met. */
typedef struct wo_thin_hit {
    float v, t; /* vergence; px to the exact place along the longer axis */
    int32_t n, step;
    int16_t x, y; /* in the view */
} wo_thin_hit;

/* Thin pixels that a view may show, nearest first; arrays of floats so that vectors can look
   where they land. Their number is a multiple of WO_LANES; spare ones are NaN. */
typedef struct wo_thin {
    int count;
    const float *v, *x, *y; /* relative to the first pixel of the view */
    const wo_thin_at *at;
    wo_thin_hit *hits; /* room for 3 count */
} wo_thin;

typedef struct wo_view {
    int32_t width, height; /* at most WO_VIEW_WIDTH x WO_VIEW_ROWS */
    float plane[WO_VIEW_PLANES][WO_VIEW_PLANE];
    wo_thin_sum thin[WO_VIEW_ROWS][WO_VIEW_WIDTH];
} wo_view;

/* What may be seen in a view. */
typedef struct wo_draw {
    const wo_pieces *pieces;
    int32_t x1, y1;                  /* first pixel of the view, in pixels of the level */
    wo_bounds bounds[WO_SHEETS_MAX]; /* of each sheet; no pixel outside of them can be seen */
    float v_low, v_high;             /* of all of these */
    wo_thin thin;
} wo_draw;

/* Sums of views over [WO_VIEW_ROWS][WO_VIEW_WIDTH] pixels: colour, coverage and guessed light times
   weights, and the weights: of the three colours, and of the rest. Where all rays weigh 1 the
   weights of colours are not summed. */
enum { WO_SUM_GUESSED = 4, WO_SUM_WEIGHTS = 5, WO_SUM_REST = 8, WO_SUMS = 9 };
typedef struct wo_view_sums {
    float plane[WO_SUMS][WO_VIEW_ROWS * WO_VIEW_WIDTH];
} wo_view_sums;

typedef struct wo_draw_kernels {
    /* Draws the view of the rays, which land on the same raster position everywhere when there is
       more than one; returns the raster writes. */
    int64_t (*draw)(const wo_draw *draw, const wo_view_ray *rays, int count, wo_view *view);
    /* Adds count times a view, times the weights of the colours unless they are NULL (sums over the
       rays then). lost: light that is left at a pixel saw something that no sheet holds (march.h),
       [WO_VIEW_ROWS][WO_VIEW_WIDTH]; NULL = all do. */
    void (*add)(const wo_view *view, const uint8_t *lost, float count, const float *weight,
                wo_view_sums *sums);
} wo_draw_kernels;

/* (dx, dy) of the raster at vergence v: a surface there is drawn so far to the left and below.
   Returns the larger one, along the longer axis. */
int wo_view_step(const wo_view_ray *ray, float v, int *dx, int *dy);

/* Kernels for these instruction sets (WO_CPU_*). */
const wo_draw_kernels *wo_draw_choose(int cpu);

extern const wo_draw_kernels wo_draw_base;
#if defined(__x86_64__)
extern const wo_draw_kernels wo_draw_avx2;
#endif

#endif
