/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_LENS_CURVES_H
#define WO_CLI_LENS_CURVES_H

#include "lens_view.h"

/* The numbers behind the drawings of a lens. */

enum { WO_LENS_ZONES = 101, WO_LENS_FIELD_STEPS = 25 };

/* Longitudinal aberration of the object point on the axis. The pupil coordinate of a ray is the
   height at which it crosses the plane of the entrance pupil (of one at infinity: of the first
   vertex) in front of the lens, in parts of that of the last ray of nm that the iris and the clear
   radii let through. */
typedef struct wo_lens_aberration {
    int zones;                                     /* at i / (zones - 1) */
    bool has[2];                                   /* in y; in x, of anamorphic lenses alone */
    double radius[2];                              /* mm, height of the last ray */
    double focus[2][WO_LENS_LINES][WO_LENS_ZONES]; /* mm from the sensor to where the ray crosses
                                                      the axis; NAN: it does not get through */
    double slope[2][WO_LENS_LINES][WO_LENS_ZONES]; /* of the ray behind the lens */
} wo_lens_aberration;
/* zones: 2..WO_LENS_ZONES. */
void wo_lens_aberration_make(const wo_lens_view *view, int zones, wo_lens_aberration *out);

/* Over the field, at nm. */
typedef struct wo_lens_field_curves {
    double field[WO_LENS_FIELD_STEPS];         /* degrees */
    double lit[WO_LENS_FIELD_STEPS];           /* part of the iris that place sees */
    double illumination[WO_LENS_FIELD_STEPS];  /* light on the sensor of an even bright scene, in
                                                  parts of that on the axis, where the chief ray
                                                  lands: what that place sees through the lens */
    bool has[2];                               /* in y, in x */
    double height[2][WO_LENS_FIELD_STEPS];     /* mm on the sensor, of the chief ray */
    double distortion[2][WO_LENS_FIELD_STEPS]; /* part that it is higher than the ideal one */
    bool equidistant; /* which is f times the angle, and not f times its tangent: for half fields of
                         90 degrees and more */
} wo_lens_field_curves;
void wo_lens_field_curves_make(const wo_lens_view *view, wo_lens_field_curves *out);

/* Third order needs a lens of revolution, an entrance pupil and a half field below 89 degrees. */
bool wo_lens_has_seidel(const wo_lens_view *view);

/* Of the Petzval surface at its vertex, negative: hollow towards the lens. INFINITY: plane. */
double wo_lens_petzval_radius(const wo_lens_view *view);

/* RMS radius in mm of the light of F, d and C around its middle on the sensor; NAN: none. */
double wo_lens_spot_rms(const wo_lens_view *view, double field);

#endif
