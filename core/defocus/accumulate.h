/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_ACCUMULATE_H
#define WO_CORE_DEFOCUS_ACCUMULATE_H

#include "defocus/draw.h"
#include "defocus/renderer.h"

/* Accumulation over lens samples (Jeong, chapter 3; Haeberli and Akeley 1990): the mean of the
   views from points of the lens, the same points for all pixels. Here: one tile of it. */

/* What all tiles share; const while they are drawn. */
typedef struct wo_accumulate {
    const wo_defocus *scene;
    const wo_draw_kernels *kernels;
    wo_pieces pieces[WO_LEVELS];
    int levels;      /* made of these */
    float v_connect; /* dioptres: a coarser pixel mixes no more */
} wo_accumulate;

WO_NODISCARD wo_status wo_accumulate_create(const wo_defocus *scene, wo_accumulate *all,
                                            wo_error *error);
void wo_accumulate_destroy(wo_accumulate *all);

/* Real-valued level of detail of a tile for so many samples, 0..WO_LEVELS - 1: the level's pixels
   are as wide as the samples of the least blurred surface are apart (Jeong 3.3, with the distance
   of samples for the size of triangles). 0 unless all that the tile can see is one solid surface
   without steps; continuous in blur and slope. */
double wo_accumulate_level(const wo_accumulate *all, int32_t tx, int32_t ty, int samples);

/* The level that sample n of a lattice is drawn at: floor or ceiling of level, in proportion, so
   that the samples of both are spread evenly over the lens. */
int wo_accumulate_level_of(double level, int n);

/* A sample among those that land on the same raster position. */
typedef struct wo_same {
    int dx, dy; /* of the group's first */
    int next;   /* of the group; -1 = last */
    int link;   /* first of another group with the same hash; -1 = last */
} wo_same;

/* A worker's memory; the size depends on the number of samples only, but for the thin pixels of one
   tile, which grow with the area that its rays reach. */
typedef struct wo_accumulator {
    wo_pencil_room room;
    wo_view view;
    wo_view_sums part;               /* of a few views */
    wo_view_sums sums[2][WO_LEVELS]; /* of two halves of the samples */
    uint8_t lost[WO_VIEW_ROWS * WO_VIEW_WIDTH];
    wo_view_ray *ray;   /* [count] of the tile */
    float (*weight)[3]; /* [count]; see weighted */
    bool weighted;
    wo_same *same;               /* [count] */
    wo_view_ray *group;          /* [count] */
    wo_draw draw[WO_LEVELS];     /* of the tile */
    float *thin_v;               /* [3 thin_room] and x, y */
    wo_thin_at *thin_at;         /* [2 thin_room] sorted, and as found */
    uint32_t *thin_order;        /* [4 thin_room] */
    wo_thin_hit *thin_hits;      /* [3 thin_room] */
    wo_thin_around *thin_around; /* [around_room] */
    size_t thin_room, around_room;
    int level_used; /* the coarsest of the tile */
    int64_t writes;
    int64_t reused; /* views that another stood for */
    double spared;  /* pixels that coarser levels did not draw */
    bool no_memory;
} wo_accumulator;

WO_NODISCARD wo_status wo_accumulator_create(const wo_context *context, int count,
                                             wo_accumulator *worker, wo_error *error);
void wo_accumulator_destroy(const wo_context *context, wo_accumulator *worker);

/* The thin pixels that may be seen in a tile, nearest first, in the memory of the worker. reach: of
   the tile, px. False without memory. */
bool wo_thin_gather(const wo_accumulate *all, wo_accumulator *worker, wo_rect tile, float reach,
                    wo_thin *thin);
void wo_thin_forget(const wo_context *context, wo_accumulator *worker);

/* Makes a worker ready for a tile: thin pixels, sums of 0. False without memory. */
bool wo_accumulate_begin(const wo_accumulate *all, wo_accumulator *worker, int32_t tx, int32_t ty);

/* Adds the views from all points of a lens (the scene's, with any number of rays up to the worker's
   count), each counted scale times: the two halves of its rays to sums[0] and [1]. pass: other
   points. False when stopped. */
bool wo_accumulate_add(const wo_accumulate *all, wo_accumulator *worker, const wo_lens *lens,
                       unsigned pass, int32_t tx, int32_t ty, double scale);

/* Mean over one half, or both (half = 2), at pixel (x, y) of the tile: premultiplied colour, and
   the sum of guessed light. False where nothing is known of a colour (its c is 0). */
bool wo_accumulate_mean(const wo_accumulator *worker, int half, int x, int y, float c[4],
                        float *guessed);

#endif
