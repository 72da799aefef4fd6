/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_ADAPTIVE_H
#define WO_CORE_DEFOCUS_ADAPTIVE_H

#include "defocus/renderer.h"

/* Lens rays for a tile: a fixed number, or in passes until the error that the two halves of the
   rays show is small enough. Each pass is a lattice of its own, larger than the one before.

   A lattice's variance falls faster than the number n of its rays (measured on footage: n^-1.6), so
   passes are weighed by n^1.6, and its halves differ more than those of independent rays would:
   half their difference times WO_HALVES_TO_ERROR is the standard error of the whole. But where the
   halves do not agree about the light at all, there was more of it to be found than there are rays:
   they found it by chance, as independent rays do, and their difference counts almost whole.
   Sampling ends when WO_ERROR_SIGMAS standard errors are below the target: what is left, nobody
   sees. */
#define WO_LATTICE_POWER   1.6
#define WO_HALVES_TO_ERROR 0.60
#define WO_CHANCE_TO_ERROR 0.84
#define WO_ERROR_SIGMAS    3.0

/* Sums of all vectors of a tile, the halves of the rays by themselves. */
typedef struct wo_tile_sums {
    wo_march_sums halves[WO_TILE_HEIGHT][WO_PHASES][2];
    double rays;  /* a pixel */
    double scale; /* light of one ray: the sum of its weights over passes */
} wo_tile_sums;

/* What the halves of the rays say about a tile: sums over its pixels and colours. */
typedef struct wo_noise {
    double square; /* of half their difference, displayed */
    double apart;  /* the same, times the part of their light that they do not share, 0..1 */
} wo_noise;

/* Adds one pixel, with the light of highlights on top of both halves. Returns the mean over its
   colours of the square. */
float wo_noise_add(wo_noise *noise, const float a[3], const float b[3], const float light[3]);

/* What these squares are to be multiplied by to be the variance of the whole. */
double wo_noise_factor(const wo_noise *noise);

/* Called after every pass: mean variance over the tile, in the displayed value. */
typedef double wo_tile_error(void *user, const wo_tile_work *work, const wo_tile_sums *sums);

/* Samples a tile that is not empty. report: rays and steps. false when stopped. */
bool wo_tile_sample(const wo_defocus *scene, wo_tile_work *work, wo_tile_error *error, void *user,
                    wo_tile_sums *sums, wo_report *report);

/* The level whose rays, after those that were traced (the last of them at level last), are likely
   to bring an error that is too_large times the target down to it; -1 = none is left. */
int wo_next_level(const wo_defocus *scene, int last, double rays, double too_large);

#endif
