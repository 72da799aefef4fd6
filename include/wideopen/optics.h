/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WIDEOPEN_OPTICS_H
#define WIDEOPEN_OPTICS_H

#include "wideopen/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Depth is vergence v = 1/z in dioptres (1/m), z the planar distance along the optical axis in
   metres. Infinity is 0 and nothing is singular there. A ray that reaches pixel x through the point
   u of the unit disc (as the photographer looks out through the lens) crosses the pinhole picture
   at

       p(v) = x + K u (v - vf)          [px]

   with the focus vergence vf and K = F E, F = W f / sensor width the focal length in pixels of a
   picture W pixels wide and E = f / (2 N) the radius of the entrance pupil in metres. The circle
   of confusion has the radius K |v - vf|: the thin lens of Potmesil and Chakravarty 1981, as in
   Lee, Eisemann and Seidel 2010 (section 3.1) and Jeong's dissertation (equations 5.6 and 5.7),
   written without their singularities. N is the f-number of the entrance pupil. */
typedef struct wo_thin_lens {
    double k;        /* px m: radius of the circle of confusion per dioptre; >= 0 */
    double vf;       /* 1/m: vergence in focus; 0 = infinity, negative = beyond it */
    double focal_px; /* F, px */
} wo_thin_lens;

/* focal_mm > 0, sensor_mm > 0, f_stop > 0 (all finite); focus_m = 0 means infinity, negative is
   beyond it; width_px > 0. breathing: F uses the image distance s = 1 / (1/f - vf) in place of f,
   as a lens that focuses by moving does; then the focus must be farther than the focal length. Any
   thread. */
WO_NODISCARD wo_status wo_thin_lens_make(double focal_mm, double sensor_mm, double f_stop,
                                         double focus_m, bool breathing, double width_px,
                                         wo_thin_lens *lens, wo_error *error);

/* Radius in px of the circle of confusion of a surface at vergence v. Does not fail. */
double wo_thin_lens_coc(const wo_thin_lens *lens, double v);

/* How a depth sample is to be read. */
#define WO_DEPTH_MODE_LIST(X)                                                                      \
    X(WO_DEPTH_DISTANCE, "distance", "Distance")                                                   \
    X(WO_DEPTH_INVERSE, "inverse", "Inverse")                                                      \
    X(WO_DEPTH_RAY, "ray", "Ray")                                                                  \
    X(WO_DEPTH_NORMALISED, "normalised", "Normalised")                                             \
    X(WO_DEPTH_NEGATIVE, "negative", "Negative")

typedef enum wo_depth_mode {
#define WO_DEPTH_ENUM(name, key, label) name,
    WO_DEPTH_MODE_LIST(WO_DEPTH_ENUM)
#undef WO_DEPTH_ENUM
        WO_DEPTH_MODE_COUNT
} wo_depth_mode;

typedef struct wo_depth_reading {
    wo_depth_mode mode;
    double scale;         /* scene units per metre, > 0 */
    double near_m, far_m; /* WO_DEPTH_NORMALISED: metres at 0 and at 1, > 0; linear between */
} wo_depth_reading;

/* Vergence of a sample. cosine = z / distance along the pixel's ray (WO_DEPTH_RAY, else unused).
   What is NaN, infinite, or not a depth (zero or negative; for WO_DEPTH_NEGATIVE zero or
   positive, for WO_DEPTH_INVERSE negative, for WO_DEPTH_NORMALISED NaN or infinite) means "no
   surface here": 0 is returned (infinitely far) and *valid becomes false. The result is finite and
   >= 0, at most WO_VERGENCE_MAX. Does not fail. */
#define WO_VERGENCE_MAX 1e6
double wo_depth_vergence(const wo_depth_reading *reading, double sample, double cosine,
                         bool *valid);

#ifdef __cplusplus
}
#endif
#endif
