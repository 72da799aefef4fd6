/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WIDEOPEN_LENS_TRACE_H
#define WIDEOPEN_LENS_TRACE_H

#include "wideopen/prescription.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A prescription at one wavelength, traced: paraxially (the system matrix), exactly (skew rays) and
   in third order. Lengths in mm, z from the first vertex along the light. */

typedef struct wo_system_surface {
    double c, k, a[WO_ASPHERE_MAX];
    int terms;
    wo_meridian meridian;
    double z;      /* of the vertex */
    double semi2;  /* square of the clear radius; INFINITY = unlimited */
    double n0, n1; /* index in front and behind */
} wo_system_surface;

typedef struct wo_system {
    int count, stop;
    double nm;
    double z_last; /* of the last vertex */
    wo_system_surface surface[WO_SURFACES_MAX];
    bool clamped; /* some glass was asked outside its range */
} wo_system;

/* Needs a valid prescription. Does not fail. */
void wo_system_make(const wo_prescription *lens, double nm, wo_system *system);

/* First-order data (Marsicano 3.22 to 3.31 with the corrections: the transfer matrix has +d/n, no
   transfer after the last surface). Values that lie at infinity are INFINITY: ep_z of a lens that
   is telecentric in object space, efl of one without power. */
typedef struct wo_first_order {
    double efl;        /* effective focal length */
    double bfd;        /* last vertex to the rear focus */
    double ffd;        /* first vertex to the front focus; negative: in front */
    double H1, H2;     /* principal planes: from the first vertex, from the last vertex */
    double ep_z, ep_d; /* entrance pupil: from the first vertex; diameter */
    double ep_mag;     /* its size in units of the iris */
    double xp_z, xp_d; /* exit pupil: from the last vertex; diameter */
    double xp_mag;
    double fno; /* efl / ep_d */
    double oal; /* first to last vertex */
} wo_first_order;

/* meridian: WO_MERIDIAN_X or WO_MERIDIAN_Y; BOTH means X. */
void wo_system_first_order(const wo_system *system, wo_meridian meridian, wo_first_order *out);

/* Last vertex to the paraxial image of the plane at vergence vf dioptres in front of the entrance
   pupil (0 = infinity, negative = beyond). Linear in vf inside, so nothing is singular at infinity;
   INFINITY when the image itself lies there. */
double wo_system_image(const wo_system *system, wo_meridian meridian, double vf);

/* Rays, by arrays of count. Directions are unit vectors. */
typedef struct wo_rays {
    double *x, *y, *z;    /* mm */
    double *dx, *dy, *dz; /* dz > 0 with the light, < 0 against it; but see below */
    double *weight;       /* light that gets through, for WO_TRACE_FRESNEL; may be NULL */
    uint8_t *outcome;     /* wo_outcome */
} wo_rays;

typedef enum wo_outcome {
    WO_RAY_PASSED,
    WO_RAY_MISSED,    /* met no surface */
    WO_RAY_REFLECTED, /* total reflection */
    WO_RAY_BLOCKED    /* fell outside a clear radius */
} wo_outcome;

enum {
    WO_TRACE_CLIP = 1, /* clear radii of all surfaces but the iris stop rays */
    WO_TRACE_IRIS = 2, /* the iris, fully open, stops rays */
    WO_TRACE_FRESNEL =
        4 /* weight is multiplied by the transmission of bare surfaces, unpolarised */
};

/* Traces through surfaces first..last (indices, first <= last), with the light or against it
   (reverse). Rays come in where they stand, in the medium in front of the first (behind the last)
   surface, and leave standing on the last one met. What comes to the lens's own first surface
   (reverse: its last) may run either way, if it meets the surface from that side: light reaches a
   dome at more than 90 degrees to the axis. A ray that does not get through keeps where it
   was stopped. stop_xy (may be NULL, else two arrays of count): where rays met the iris, x then y.
 */
void wo_system_trace(const wo_system *system, int first, int last, bool reverse, unsigned flags,
                     const wo_rays *rays, int count, double *stop_x, double *stop_y);

/* One ray by the meridional formulas alone (angles, no vectors), rotationally symmetric spheres
   only: an independent check. Enters parallel to the axis at height y; gives the crossing with the
   axis from the last vertex, and the slope. false: it does not pass. */
bool wo_system_trace_meridional(const wo_system *system, double y, double *crossing, double *slope);

/* Seidel sums, infinite object (Welford's S_I..S_V; Born and Wolf's B..F, Marsicano 3.36 with the
   corrected brackets, n0 = l0 = lambda0 = 1), and the chromatic sums C_I, C_II between two
   wavelengths. Aspheric terms A4 and conics are included. */
typedef struct wo_seidel {
    double s[5];
    double b, c, d, e, f;
    double lagrange;
} wo_seidel;
/* ep_d: diameter of the entrance pupil, mm; field: half field in degrees, 0 < field < 89. */
void wo_system_seidel(const wo_system *system, double ep_d, double field, wo_seidel *out);
void wo_system_chromatic_sums(const wo_prescription *lens, double ep_d, double field, double nm_low,
                              double nm_high, double sums[2]);

#ifdef __cplusplus
}
#endif
#endif
