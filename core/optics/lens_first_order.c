/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/lens_paraxial.h"

#include <math.h>

void wo_system_make(const wo_prescription *lens, double nm, wo_system *system)
{
    *system = (wo_system){.count = lens->count, .stop = lens->stop, .nm = nm};
    double n = 1;
    double z = 0;
    for (int i = 0; i < lens->count; i++) {
        const wo_surface *from = &lens->surface[i];
        wo_system_surface *to = &system->surface[i];
        *to = (wo_system_surface){.c = from->curvature,
                                  .k = from->conic,
                                  .terms = from->asphere_terms,
                                  .meridian = from->meridian,
                                  .z = z,
                                  .n0 = n,
                                  .n1 = wo_glass_index(&from->glass, nm, &system->clamped)};
        for (int k = 0; k < WO_ASPHERE_MAX; k++)
            to->a[k] = k < from->asphere_terms ? from->asphere[k] : 0;
        const double semi = from->semi_aperture;
        to->semi2 = semi > 0 ? semi * semi : INFINITY;
        n = to->n1;
        system->z_last = z;
        z += from->thickness;
    }
}

double wo_paraxial_curvature(const wo_system_surface *s, wo_meridian meridian)
{
    if (s->meridian != WO_MERIDIAN_BOTH &&
        s->meridian != (meridian == WO_MERIDIAN_Y ? WO_MERIDIAN_Y : WO_MERIDIAN_X))
        return 0;
    return s->c + (s->terms > 0 ? 2 * s->a[0] : 0);
}

wo_paraxial wo_paraxial_refract(wo_paraxial ray, const wo_system_surface *s, wo_meridian meridian)
{
    ray.v -= ray.y * (s->n1 - s->n0) * wo_paraxial_curvature(s, meridian);
    return ray;
}

wo_paraxial wo_paraxial_through(const wo_system *system, wo_meridian meridian, int first, int last,
                                wo_paraxial ray)
{
    for (int i = first; i <= last; i++) {
        const wo_system_surface *s = &system->surface[i];
        ray = wo_paraxial_refract(ray, s, meridian);
        if (i < last)
            ray.y += (system->surface[i + 1].z - s->z) * ray.v / s->n1;
    }
    return ray;
}

/* A quotient whose 0 denominator, up to rounding, means infinity. */
static double over(double a, double b, double scale)
{
    return fabs(b) <= 1e-14 * scale ? INFINITY : a / b;
}

void wo_system_first_order(const wo_system *system, wo_meridian meridian, wo_first_order *out)
{
    const int last = system->count - 1;
    const int stop = system->stop;
    const double n_last = system->surface[last].n1;
    /* Columns of the system matrix: what becomes of (y, n u) = (1, 0) and (0, 1). */
    const wo_paraxial one = wo_paraxial_through(system, meridian, 0, last, (wo_paraxial){1, 0});
    const wo_paraxial two = wo_paraxial_through(system, meridian, 0, last, (wo_paraxial){0, 1});
    const double power_scale = 1e-3;
    *out = (wo_first_order){.oal = system->z_last};
    out->efl = over(-1, one.v, power_scale);
    out->bfd = over(-n_last * one.y, one.v, power_scale);
    out->ffd = over(two.v, one.v, power_scale);
    out->H1 = isfinite(out->efl) ? out->ffd + out->efl : INFINITY;
    out->H2 = isfinite(out->efl) ? out->bfd - n_last * out->efl : INFINITY;

    /* From the first vertex to the plane of the iris, in front of its own surface. */
    double a = 1;
    double b = 0;
    if (stop > 0) {
        const double gap = system->surface[stop].z - system->surface[stop - 1].z;
        const double n = system->surface[stop].n0;
        const wo_paraxial p =
            wo_paraxial_through(system, meridian, 0, stop - 1, (wo_paraxial){1, 0});
        const wo_paraxial q =
            wo_paraxial_through(system, meridian, 0, stop - 1, (wo_paraxial){0, 1});
        a = p.y + gap * p.v / n;
        b = q.y + gap * q.v / n;
    }
    const double radius = sqrt(system->surface[stop].semi2);
    out->ep_z = over(b, a, 1);
    out->ep_mag = over(1, a, 1);
    out->ep_d = 2 * radius * fabs(out->ep_mag);
    const wo_paraxial r = wo_paraxial_through(system, meridian, stop, last, (wo_paraxial){0, 1});
    out->xp_z = over(-n_last * r.y, r.v, 1);
    out->xp_mag = over(1, r.v, 1);
    out->xp_d = 2 * radius * fabs(out->xp_mag);
    out->fno = isfinite(out->efl) && isfinite(out->ep_d) ? fabs(out->efl) / out->ep_d
               : isfinite(out->ep_d)                     ? INFINITY
                                                         : 0;
}

double wo_system_image(const wo_system *system, wo_meridian meridian, double vf)
{
    wo_first_order o;
    wo_system_first_order(system, meridian, &o);
    const double slope = vf * 1e-3;
    /* The object is on the axis; the ray has height 1 at the entrance pupil. */
    const double y = isfinite(o.ep_z) ? 1 - slope * o.ep_z : 1;
    const wo_paraxial end =
        wo_paraxial_through(system, meridian, 0, system->count - 1, (wo_paraxial){y, slope});
    return over(-system->surface[system->count - 1].n1 * end.y, end.v, 1e-6);
}
