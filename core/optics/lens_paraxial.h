/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_OPTICS_LENS_PARAXIAL_H
#define WO_CORE_OPTICS_LENS_PARAXIAL_H

#include "wideopen/lens_trace.h"

/* A paraxial ray at a vertex: height in mm and slope times index. */
typedef struct wo_paraxial {
    double y, v;
} wo_paraxial;

/* Curvature that a paraxial ray of this meridian sees. */
double wo_paraxial_curvature(const wo_system_surface *surface, wo_meridian meridian);

wo_paraxial wo_paraxial_refract(wo_paraxial ray, const wo_system_surface *surface,
                                wo_meridian meridian);

/* From in front of surface first to behind surface last. */
wo_paraxial wo_paraxial_through(const wo_system *system, wo_meridian meridian, int first, int last,
                                wo_paraxial ray);

#endif
