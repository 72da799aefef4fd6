/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_ADAPTIVE_H
#define WO_CORE_DEFOCUS_ADAPTIVE_H

#include "defocus/renderer.h"

/* Lens rays for a tile: a fixed number, or in passes until the error that the two halves of the
   rays show is small enough. Each pass is a lattice of its own, larger than the one before.

   A lattice's variance falls faster than the number n of its rays (measured on footage: n^-1.6), so
   passes are weighed by n^1.6, and its halves differ more than those of independent rays would:
   half their difference times WO_HALVES_TO_ERROR is the standard error of the whole. Sampling ends
   when WO_ERROR_SIGMAS standard errors are below the target: what is left, nobody sees. */
#define WO_LATTICE_POWER   1.6
#define WO_HALVES_TO_ERROR 0.60
#define WO_ERROR_SIGMAS    3.0

/* Sums of all vectors of a tile, the halves of the rays by themselves. */
typedef struct wo_tile_sums {
    wo_march_sums halves[WO_TILE_HEIGHT][WO_PHASES][2];
    double rays;  /* a pixel */
    double scale; /* light of one ray: the sum of its weights over passes */
} wo_tile_sums;

/* Square of half the difference of the halves at a pixel, in the displayed value. */
float wo_tile_noise(const wo_tile_work *work, const wo_tile_sums *sums, int32_t row, int run_index,
                    int i);

/* Called after every pass: the mean over the tile of wo_tile_noise, or of what the method leaves of
   it. */
typedef double wo_tile_error(void *user, const wo_tile_work *work, const wo_tile_sums *sums);

/* Samples a tile that is not empty. report: rays and steps. false when stopped. */
bool wo_tile_sample(const wo_defocus *scene, wo_tile_work *work, wo_tile_error *error, void *user,
                    wo_tile_sums *sums, wo_report *report);

/* The level whose rays, after those that were traced (the last of them at level last), are likely
   to bring an error that is too_large times the target down to it; -1 = none is left. */
int wo_next_level(const wo_defocus *scene, int last, double rays, double too_large);

/* Displayed value per light about the mean of a and b, which differ by noise. */
float wo_shown(float a, float b);

#endif
