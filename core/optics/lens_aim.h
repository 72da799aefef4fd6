/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_OPTICS_LENS_AIM_H
#define WO_CORE_OPTICS_LENS_AIM_H

#include "optics/lens_model.h"

/* Rays through a prescription, aimed: from a place in the iris to a place on the sensor. Clear
   radii do not count, only whether there is such a ray. Of the rays of one place that land at the
   same point those of one family are found, the one that holds the ray through the middle of the
   iris: their landing places turn with their slopes as there (jacobian > 0). Any thread. */

/* A ray in the lens: place and direction. */
typedef struct wo_beam {
    double p[3], d[3];
} wo_beam;

/* Follows it through surfaces first..last; false when it does not get through. */
bool wo_beam_through(const wo_system *system, int first, int last, bool reverse, wo_beam *b);
void wo_beam_run_to(wo_beam *b, double z);
/* From place s of the iris (mm) with the slopes dx/dz and dy/dz there, to the sensor or back. */
wo_beam wo_beam_from_iris(const wo_exact_lens *lens, const double s[2], const double slope[2],
                          bool reverse);

typedef struct wo_aimed {
    double slope[2];
    double j[4];     /* of the landing place by the slopes, by rows; near to them at least */
    double jacobian; /* its determinant, at them */
} wo_aimed;

/* The sensor point whose chief ray (through the middle of the iris, reference wavelength) shows
   tangent h in the plane of focus. */
typedef struct wo_aim_target {
    double x;        /* mm; y is 0 */
    wo_aimed middle; /* the chief ray */
} wo_aim_target;
bool wo_aim_at_field(const wo_exact_lens *lens, double h, wo_aim_target *target);

/* The ray from s to the target. guess: one from nearby in place or wavelength, tried first; NULL =
   none. middle: the ray from the middle of the iris in this wavelength, from which the way to s is
   taken in steps when need be. */
bool wo_aim(const wo_exact_lens *lens, const wo_system *system, const wo_aim_target *target,
            const wo_aimed *middle, const wo_aimed *guess, const double s[2], wo_aimed *aimed);

#endif
