/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_OPTICS_PENCIL_TILT_H
#define WO_CORE_OPTICS_PENCIL_TILT_H

#include "optics/pencil.h"

/* Any lens, tilted against its sensor: its focus is at vergence vf(x) = vf0 + b.x, affine in the
   sensor point x. A ray of the lens inside, p - x = A + B (v - vf(x)), meets surfaces that are
   counted from the focus at their own pixel, w = v - vf(p). With d = p - x it is again a line,
       d = A + B (w + b.d)   =>   d = A + B (b.A) / (1 - b.B)  +  w B / (1 - b.B),
   exactly, and along it w grows with v: the order of surfaces stays. (The plane of focus of
   Merklinger 1996, as Lee, Eisemann, Seidel 2010 use it in section 5.1.) */
typedef struct wo_tilted_pencils {
    const wo_lens *inside; /* borrowed */
    double b[2];           /* dioptres per px */
    double slope;          /* largest |b.B| of a ray; < 1 */
} wo_tilted_pencils;

/* slope: 0 <= slope <= 0.5. The lens reaches 1 / (1 - slope) times as far. tilted and inside are
   borrowed by the result. */
wo_lens wo_tilted_pencils_lens(const wo_tilted_pencils *tilted);

/* Largest |B| of a lens, px per dioptre, by what it says of its reach. */
double wo_lens_slope(const wo_lens *lens);

#endif
