/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WIDEOPEN_APERTURE_H
#define WIDEOPEN_APERTURE_H

#include "wideopen/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The shape of the open aperture inside the unit disc. Samples and mask come from the same
   description: a boundary r(angle), turned and squeezed. */
typedef struct wo_aperture {
    int blades;       /* 0 = round, else 3..16: a polygon inscribed in the unit circle */
    double curvature; /* -1..1: 0 straight blades, 1 round, negative bent inwards */
    double rotation;  /* degrees, counter-clockwise with y up: angle of a vertex from +x */
    double aspect;    /* width / height, 0.1..10; the longer side keeps the unit radius */
} wo_aperture;

#define WO_APERTURE_INIT                                                                           \
    {                                                                                              \
        .aspect = 1                                                                                \
    }
#define WO_BLADES_MAX 16

/* Checks the ranges. */
WO_NODISCARD wo_status wo_aperture_validate(const wo_aperture *aperture, wo_error *error);

/* A description made ready: tables only, no memory of its own, const after it is made. */
typedef struct wo_aperture_shape {
    wo_aperture aperture;
    double area;             /* of the shape; pi for the full disc */
    double turn;             /* radians */
    double scale_x, scale_y; /* both in (0, 1] */
    float sector[257];       /* area fraction to angle fraction within one blade */
} wo_aperture_shape;

/* Needs a valid description. Does not fail. */
void wo_aperture_make(const wo_aperture *aperture, wo_aperture_shape *shape);

/* Maps (s, t) of the unit square to a point of the shape, equal areas to equal areas, so that well
   spread points stay well spread (concentric discs, then the boundary). Does not fail. */
void wo_aperture_sample(const wo_aperture_shape *shape, double s, double t, double u[2]);

/* True when the point lies inside. */
bool wo_aperture_inside(const wo_aperture_shape *shape, double x, double y);

/* Fills size x size floats (row 0 at the bottom, [-1, 1] in both directions) with the covered
   fraction of each cell, 0..1. Does not fail. */
void wo_aperture_mask(const wo_aperture_shape *shape, int size, float *mask);

#ifdef __cplusplus
}
#endif
#endif
