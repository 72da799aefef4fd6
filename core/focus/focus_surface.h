/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_FOCUS_FOCUS_SURFACE_H
#define WO_CORE_FOCUS_FOCUS_SURFACE_H

#include <stdbool.h>

/* Surfaces of focus through points (Lee, Eisemann, Seidel 2010, section 5). Places are in any one
   unit of length, the same in both directions; what a frame uses is half its diagonal. */
enum { WO_FOCUS_POINTS = 16 };

typedef struct wo_focus_point {
    double x, y;
    double v;      /* 1/m: the vergence that is in focus there */
    double dof;    /* amount of blur there */
    double weight; /* alpha; 0 = the point is not there */
} wo_focus_point;

/* v + gx x + gy y */
typedef struct wo_focus_plane {
    double v, gx, gy;
} wo_focus_plane;

/* Least squares plane through the points. A plane in space is affine in picture place and vergence,
   so this is the plane of focus of a tilted lens. Points in a line tilt it along that line only,
   one point not at all; on the way there the slope fades smoothly. false: no point has a weight. */
bool wo_focus_plane_fit(const wo_focus_point *points, int count, wo_focus_plane *plane);

/* Moving least squares of degree 1 at (x, y), with the weights weight / distance^falloff. (The
   paper prints "alpha^1/d^beta"; this is the one reading in which alpha > 1 strengthens a point
   and d = 0 interpolates it.) The slope comes from the same weights with the distance softened,
   kept so that no value lies further from the mean than some five standard deviations of the
   points: nothing is singular however they lie. The amount of blur has degree 0, so that it stays
   within those of the points. At a point both are exactly the point's; at points in one place,
   their weighted mean. The surface is smooth for falloff > 1; 1 gives a peak at each point.
   count <= WO_FOCUS_POINTS. false: no point has a weight. */
bool wo_focus_surface_at(const wo_focus_point *points, int count, double falloff, double x,
                         double y, double *v, double *dof);

/* The vergence at (0, 0) of the surface that most of the samples lie on, and never between two
   surfaces: the least interval of vergence with more than half of them, the nearer one of equals,
   as wide again on both sides, and a plane through those (their dof is not read, their weights
   must be 1). count >= 1; the samples are sorted. */
double wo_focus_pick(wo_focus_point *samples, int count);

#endif
