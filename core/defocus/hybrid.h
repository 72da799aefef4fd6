/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_HYBRID_H
#define WO_CORE_DEFOCUS_HYBRID_H

#include "defocus/renderer.h"

/* Lens rays where they are needed, smoothing and filtering where that is right (after Tan et al.
   2022 as told by Marsicano 2024, chapter 5, with what goes wrong there mended). In two steps.

   Smoothing. Few rays a pixel find exactly what is in focus, and leave noise in what is far out of
   it: how much of a near surface covers the pixel, and its colour. But the picture of such a
   surface is smooth by the size of its blur. So the light of the rays is kept apart by where it
   came from: far in front of the focus, about it, far behind. The picture in front is smoothed by
   a fraction of its own blur, its coverage too; what is behind keeps its detail and fills exactly
   the light that is left. The parts are put together once, at the end: no dark edges, nothing
   counted twice.

   Leaning. The filter (filter.h) has no noise but is wrong where surfaces hide each other; rays
   are right everywhere but noisy. Their difference is noise, and what the filter gets wrong. The
   two halves of the rays say how large noise is in each cell of 8 x 8 px, so it is known which part
   of the difference is more than noise (Wiener's filter): so much of it is added to the filtered
   picture, and of its mean over the cell nearly all. Where the filter is right the picture is its;
   where it is wrong it is that of the rays; and with more and more rays it becomes that everywhere,
   whatever the filter did. */

/* Blur of more px of radius than this is kept apart. */
#define WO_HYBRID_APART_PX 3.0

/* What the rays leave of a pixel, as fractions of all light: one plane of floats each. */
enum {
    WO_HYBRID_NEAR,                                /* as WO_PART_* */
    WO_HYBRID_FAR = WO_HYBRID_NEAR + WO_PART_SUMS, /* the same behind the focus */
    WO_HYBRID_REST = WO_HYBRID_FAR + WO_PART_SUMS, /* r g b a of what is neither */
    WO_HYBRID_LEFT = WO_HYBRID_REST + 4,           /* light that nothing stopped */
    WO_HYBRID_GUESSED,
    WO_HYBRID_NOISE,                        /* near, far, rest: variance, in roots of light
                                               (wo_hybrid_scale) */
    WO_HYBRID_JITTER = WO_HYBRID_NOISE + 3, /* of near and far together: square of half the
                                               difference between the halves of the rays */
    WO_HYBRID_OPEN,                         /* the same of all ... */
    WO_HYBRID_SHOWN,                        /* ... and of the displayed value */
    WO_HYBRID_LIGHT, /* red, green, blue of highlights, on top; only where the scene has some */
    WO_HYBRID_PLANES = WO_HYBRID_LIGHT + 3
};

enum { WO_HYBRID_CELL = 8, WO_HYBRID_TAPS_MAX = 64, WO_HYBRID_KERNELS = 33 };

/* Roots of light: what is decided in them is right when the picture is made darker, too; the
   displayed value ends at white. A difference d of light about this much light is d times this
   scale. */
float wo_hybrid_scale(float light);

/* Mean over red, green and blue; the same to the bit where they agree. */
static inline float wo_hybrid_mean(float r, float g, float b)
{
    return r == g && g == b ? r : (r + g + b) * (1.0f / 3);
}

/* A kernel over whole pixels. gain: how much of the variance it leaves. */
typedef struct wo_hybrid_kernel {
    int count;
    int8_t x[WO_HYBRID_TAPS_MAX], y[WO_HYBRID_TAPS_MAX];
    float weight[WO_HYBRID_TAPS_MAX];
    float gain;
} wo_hybrid_kernel;

/* Largest offset of a tap, px. */
#define WO_HYBRID_REACH 8
/* px beyond a cell that must be traced to smooth it: taps, and the cells around. */
#define WO_HYBRID_AROUND (WO_HYBRID_REACH + 2 * WO_HYBRID_CELL)

/* Kernels by radius in quarters of a px, of equal weights: [0] is the pixel itself. */
void wo_hybrid_kernels(wo_hybrid_kernel kernels[WO_HYBRID_KERNELS]);

/* Of a cell of 8 x 8 px and those around it. */
typedef struct wo_hybrid_cell {
    uint8_t near, far; /* kernels */
    float noise[3];    /* of this cell alone: mean variances of near, far, rest */
    float around[2];   /* the same of near and far, with the cells around */
    float shown;       /* the displayed value has so many times the variance */
    float jitter;      /* of this cell alone: variance that smoothing may take away */
} wo_hybrid_cell;

typedef struct wo_hybrid {
    const wo_defocus *scene;
    wo_rect tiles; /* those that are traced */
    wo_rect area;  /* the same in px */
    ptrdiff_t width;
    float *memory;
    /* Coverage is one plane for all colours if the lens does not part them. */
    float *plane[WO_HYBRID_PLANES];
    float *rays; /* [tiles] a pixel */
    wo_hybrid_cell *cells;
    int32_t columns, rows; /* of cells */
    wo_rect inner; /* cells of the format's tiles: they look at no others, so that a render of
                      the format traces nothing beyond it */
    wo_hybrid_kernel kernels[WO_HYBRID_KERNELS];
} wo_hybrid;

/* Index of the kernel for a part with these sums of coverage and of coverage over vergence, at so
   many rays a pixel. */
int wo_hybrid_kernel_for(const wo_hybrid *hybrid, bool near, double rays, double coverage,
                         double by_vergence);

/* Cells that the cell (column, row) may look at, from the area's corner. */
wo_rect wo_hybrid_view(const wo_hybrid *hybrid, int32_t column, int32_t row);

/* Fills the planes of one tile. false when stopped. */
bool wo_hybrid_trace(wo_hybrid *hybrid, int32_t tx, int32_t ty, wo_report *part);

/* Chooses the kernels of a row of cells from the planes. */
void wo_hybrid_choose(wo_hybrid *hybrid, int32_t row);

/* Expected squares of errors of a cell, in roots of light. */
typedef struct wo_hybrid_noise {
    float noise, lost; /* variance; detail that was smoothed away */
    float shown;       /* the displayed value has so many times as much; NAN = nothing is known */
} wo_hybrid_noise;

/* Puts the parts of one tile together, without the highlights' light. noise: of each of its cells.
 */
void wo_hybrid_join(const wo_hybrid *hybrid, int32_t tx, int32_t ty, wo_tile_pixels *pixels,
                    wo_tile_facts *facts, wo_hybrid_noise noise[WO_TILE_WIDTH / WO_HYBRID_CELL]);

/* How a cell leans on the filter. */
typedef struct wo_hybrid_lean {
    bool known;     /* false: the picture of the rays stands as it is */
    float shift[4]; /* mean difference of rays and filter, times wo_hybrid_scale */
    float keep;     /* part of the difference's detail that is not noise */
    float error;    /* square of the expected error, displayed; NAN = not known */
} wo_hybrid_lean;

/* rays, filtered: rows of the two pictures of one cell. noise: expected errors of the rays'
   picture. Differences are scaled by what the filter shows, so that a lamp does not show in the
   mean of its cell, and noise does not pull the mean down. */
void wo_hybrid_lean_on(float (*const rays[WO_HYBRID_CELL])[4],
                       float (*const filtered[WO_HYBRID_CELL])[4], const wo_hybrid_noise *noise,
                       wo_hybrid_lean *lean);

/* One pixel, of which rays and filtered are the two pictures. around[y][x]: its cell in the middle
   and those around; NULL = there is none. (x, y): place of the pixel in the cell, px. Returns which
   part of the detail came from the rays. */
float wo_hybrid_mix(const wo_hybrid_lean *const around[3][3], int x, int y, const float rays[4],
                    const float filtered[4], float out[4]);

#endif
