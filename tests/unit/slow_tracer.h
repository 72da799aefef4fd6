/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TESTS_SLOW_TRACER_H
#define WO_TESTS_SLOW_TRACER_H

#include "wideopen/prescription.h"

#include <math.h>

/* Rays through a prescription with the light, by other means than the library's: an asphere is met
   by differences of the sag along the ray, a sphere by the distance from its centre; refraction
   goes by the cross product with the normal. Lenses of revolution. */

typedef struct slow_ray {
    double p[3], d[3];
    bool passed;
    double iris; /* radius at which it met the iris, in parts of the iris's own */
} slow_ray;

static inline double slow_sag(const wo_surface *s, double r2)
{
    double sum = 0, power = r2;
    for (int i = 0; i < s->asphere_terms; i++, power *= r2)
        sum += s->asphere[i] * power;
    const double root = 1 - (1 + s->conic) * s->curvature * s->curvature * r2;
    return root >= 0 ? s->curvature * r2 / (1 + sqrt(root)) + sum : NAN;
}

static inline double slow_above(const wo_surface *s, const slow_ray *r, double z, double t)
{
    const double x = r->p[0] + t * r->d[0], y = r->p[1] + t * r->d[1];
    return r->p[2] + t * r->d[2] - z - slow_sag(s, x * x + y * y);
}

/* Distance along the ray to a sphere, where it enters it from the front; NAN: not at all. */
static inline double slow_to_sphere(const wo_surface *s, const slow_ray *r, double z)
{
    const double radius = 1 / s->curvature;
    const double c[3] = {-r->p[0], -r->p[1], z + radius - r->p[2]};
    const double along = c[0] * r->d[0] + c[1] * r->d[1] + c[2] * r->d[2];
    const double square =
        radius * radius - (c[0] * c[0] + c[1] * c[1] + c[2] * c[2] - along * along);
    if (!(square >= 0))
        return NAN;
    const double t = radius > 0 ? along - sqrt(square) : along + sqrt(square);
    /* On the half of the sphere that faces the vertex. */
    return (r->p[2] + t * r->d[2] - z - radius) * radius < 0 ? t : NAN;
}

static inline double slow_to(const wo_surface *s, const slow_ray *r, double z)
{
    const bool sphere = s->conic == 0 && s->asphere_terms == 0 && s->curvature != 0;
    if (sphere)
        return slow_to_sphere(s, r, z);
    const double plane = (z - r->p[2]) / r->d[2];
    if (s->curvature == 0 && s->asphere_terms == 0)
        return r->d[2] > 0 ? plane : NAN;
    double t = plane;
    for (int i = 0; i < 100; i++) {
        const double h = 1e-5, here = slow_above(s, r, z, t);
        const double step =
            here * 2 * h / (slow_above(s, r, z, t + h) - slow_above(s, r, z, t - h));
        if (fabs(step) < 1e-13 * (1 + fabs(t)))
            return t;
        t -= step;
    }
    return fabs(slow_above(s, r, z, t)) < 1e-10 ? t : NAN;
}

static inline void slow_normal(const wo_surface *s, const slow_ray *r, double n[3])
{
    const double r2 = r->p[0] * r->p[0] + r->p[1] * r->p[1];
    const double c = s->curvature;
    double slope = c / sqrt(1 - (1 + s->conic) * c * c * r2), power = 1;
    for (int i = 0; i < s->asphere_terms; i++, power *= r2)
        slope += 2 * (i + 1) * s->asphere[i] * power;
    n[0] = -slope * r->p[0];
    n[1] = -slope * r->p[1];
    n[2] = 1;
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + 1);
    for (int k = 0; k < 3; k++)
        n[k] /= length;
}

static inline bool slow_refract(slow_ray *r, const double n[3], double mu)
{
    const double x[3] = {n[1] * r->d[2] - n[2] * r->d[1], n[2] * r->d[0] - n[0] * r->d[2],
                         n[0] * r->d[1] - n[1] * r->d[0]};
    const double sine2 = mu * mu * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    if (!(sine2 <= 1) || !(n[0] * r->d[0] + n[1] * r->d[1] + n[2] * r->d[2] > 0))
        return false;
    /* mu (n x d) x n is what stays of the direction in the surface. */
    const double t[3] = {x[1] * n[2] - x[2] * n[1], x[2] * n[0] - x[0] * n[2],
                         x[0] * n[1] - x[1] * n[0]};
    for (int k = 0; k < 3; k++)
        r->d[k] = mu * t[k] + sqrt(1 - sine2) * n[k];
    return true;
}

/* iris: its radius; the clear radii stop rays, too. */
static inline void slow_trace(const wo_prescription *lens, double nm, double iris, slow_ray *r)
{
    double z = 0, before = 1;
    r->passed = false;
    r->iris = NAN;
    for (int i = 0; i < lens->count; i++) {
        const wo_surface *const s = &lens->surface[i];
        const double behind = wo_glass_index(&s->glass, nm, NULL), t = slow_to(s, r, z);
        if (isnan(t) || (i > 0 && !(r->d[2] > 0)))
            return;
        for (int k = 0; k < 3; k++)
            r->p[k] += t * r->d[k];
        const double radius = hypot(r->p[0], r->p[1]);
        if (s->stop)
            r->iris = radius / iris;
        const double limit = s->stop ? iris : s->semi_aperture > 0 ? s->semi_aperture : INFINITY;
        double n[3];
        slow_normal(s, r, n);
        if (!(radius <= limit) || !slow_refract(r, n, before / behind))
            return;
        before = behind;
        z += s->thickness;
    }
    r->passed = true;
}

#endif
