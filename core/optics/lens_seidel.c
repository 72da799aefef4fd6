/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/lens_paraxial.h"

#include <math.h>
#include <string.h>

/* Axial and chief paraxial ray in front of a surface. */
typedef struct pair {
    wo_paraxial axial, chief;
} pair;

static pair first_rays(const wo_system *system, double ep_d, double field, double *tangent)
{
    wo_first_order o;
    wo_system_first_order(system, WO_MERIDIAN_X, &o);
    *tangent = tan(field * (3.14159265358979323846 / 180));
    const double ep_z = isfinite(o.ep_z) ? o.ep_z : 0;
    return (pair){{0.5 * ep_d, 0}, {-ep_z * *tangent, *tangent}};
}

static void next_rays(const wo_system *system, int i, pair *p)
{
    const wo_system_surface *s = &system->surface[i];
    p->axial = wo_paraxial_refract(p->axial, s, WO_MERIDIAN_X);
    p->chief = wo_paraxial_refract(p->chief, s, WO_MERIDIAN_X);
    if (i + 1 < system->count) {
        const double gap = (system->surface[i + 1].z - s->z) / s->n1;
        p->axial.y += gap * p->axial.v;
        p->chief.y += gap * p->chief.v;
    }
}

void wo_system_seidel(const wo_system *system, double ep_d, double field, wo_seidel *out)
{
    double tangent;
    pair p = first_rays(system, ep_d, field, &tangent);
    memset(out, 0, sizeof *out);
    const double h = tangent * 0.5 * ep_d;
    out->lagrange = h;
    double *const sum = out->s;
    for (int i = 0; i < system->count; i++) {
        const wo_system_surface *s = &system->surface[i];
        const double c = wo_paraxial_curvature(s, WO_MERIDIAN_X);
        const double y = p.axial.y;
        const double yc = p.chief.y;
        const double a = p.axial.v + s->n0 * y * c; /* refraction invariants n i */
        const double ac = p.chief.v + s->n0 * yc * c;
        const double un = p.axial.v / (s->n0 * s->n0);
        next_rays(system, i, &p);
        /* Here v is the slope behind times n1 at this surface: transfer leaves it alone. */
        const double delta = p.axial.v / (s->n1 * s->n1) - un;
        const double inverse = 1 / s->n1 - 1 / s->n0;
        const double inverse2 = 1 / (s->n1 * s->n1) - 1 / (s->n0 * s->n0);
        sum[0] -= a * a * y * delta;
        sum[1] -= a * ac * y * delta;
        sum[2] -= ac * ac * y * delta;
        sum[3] -= h * h * c * inverse;
        /* The form without a quotient of the invariants (Welford 1986, 8.2). */
        sum[4] -= ac * (ac * ac * y * inverse2 - (h + ac * y) * yc * c * inverse);
        /* What the profile adds to the sphere of the paraxial curvature, in r^4. */
        const double base = s->meridian == WO_MERIDIAN_BOTH || c != 0 ? s->c : 0;
        const double g =
            (1 + s->k) * base * base * base / 8 + (s->terms > 1 ? s->a[1] : 0) - c * c * c / 8;
        const double figure = 8 * g * (s->n1 - s->n0) * y;
        sum[0] += figure * y * y * y;
        sum[1] += figure * y * y * yc;
        sum[2] += figure * y * yc * yc;
        sum[4] += figure * yc * yc * yc;
    }
    /* Born and Wolf's coefficients of the same aberration (the identity of both notations for
       n0 = l0 = lambda0 = 1: rho the radius of the entrance pupil, y0 = -tan(field)). */
    const double rho = 0.5 * ep_d;
    const double y0 = -tangent;
    out->b = sum[0] / (2 * rho * rho * rho * rho);
    out->f = -sum[1] / (2 * y0 * rho * rho * rho);
    out->c = sum[2] / (2 * y0 * y0 * rho * rho);
    out->d = out->c + sum[3] / (2 * y0 * y0 * rho * rho);
    out->e = -sum[4] / (2 * y0 * y0 * y0 * rho);
}

void wo_system_chromatic_sums(const wo_prescription *lens, double ep_d, double field, double nm_low,
                              double nm_high, double sums[2])
{
    wo_system middle;
    wo_system low;
    wo_system high;
    wo_system_make(lens, WO_NM_D, &middle);
    wo_system_make(lens, nm_low, &low);
    wo_system_make(lens, nm_high, &high);
    double tangent;
    pair p = first_rays(&middle, ep_d, field, &tangent);
    sums[0] = sums[1] = 0;
    for (int i = 0; i < middle.count; i++) {
        const wo_system_surface *s = &middle.surface[i];
        const double c = wo_paraxial_curvature(s, WO_MERIDIAN_X);
        const double y = p.axial.y;
        const double a = p.axial.v + s->n0 * y * c;
        const double ac = p.chief.v + s->n0 * p.chief.y * c;
        const double spread = (low.surface[i].n1 - high.surface[i].n1) / s->n1 -
                              (low.surface[i].n0 - high.surface[i].n0) / s->n0;
        sums[0] += a * y * spread;
        sums[1] += ac * y * spread;
        next_rays(&middle, i, &p);
    }
}
