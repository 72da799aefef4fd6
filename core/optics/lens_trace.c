/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/lens_trace.h"

#include <math.h>

enum { NEWTON_MAX = 60 };
#define STEEP 0.05 /* dz below which a ray runs along the plane of the vertex */

/* Sag of a surface and half its slope by r^2 ( dz/dr = 2 r * slope ); false outside its domain. */
static bool sag_of(const wo_system_surface *s, double r2, double *sag, double *slope)
{
    const double root2 = 1 - (1 + s->k) * s->c * s->c * r2;
    if (!(root2 > 0))
        return false;
    const double root = sqrt(root2);
    double z = 0;
    double dz = 0;
    for (int i = s->terms - 1; i >= 0; i--) {
        dz = dz * r2 + (i + 1) * s->a[i];
        z = z * r2 + s->a[i];
    }
    *sag = s->c * r2 / (1 + root) + z * r2;
    *slope = s->c / (2 * root) + dz;
    return isfinite(*sag) && isfinite(*slope);
}

/* A ray relative to a vertex. */
typedef struct local_ray {
    double x, y, z, dx, dy, dz;
} local_ray;

static double radius2(const wo_system_surface *s, double x, double y)
{
    return s->meridian == WO_MERIDIAN_BOTH ? x * x + y * y
           : s->meridian == WO_MERIDIAN_X  ? x * x
                                           : y * y;
}

/* Moves the ray onto an asphere, from where it stands (Newton's method), to where it crosses it
   from the front to the back (with > 0) or the other way (< 0); false when it does not get there.
   n: unnormalised normal with n[2] = 1. */
static bool reach_asphere(const wo_system_surface *s, double with, local_ray *r, double n[3])
{
    const bool in_x = s->meridian != WO_MERIDIAN_Y;
    const bool in_y = s->meridian != WO_MERIDIAN_X;
    for (int i = 0; i < NEWTON_MAX; i++) {
        double sag;
        double slope;
        if (!sag_of(s, radius2(s, r->x, r->y), &sag, &slope))
            return false;
        n[0] = in_x ? -2 * slope * r->x : 0;
        n[1] = in_y ? -2 * slope * r->y : 0;
        n[2] = 1;
        const double fall = n[0] * r->dx + n[1] * r->dy + r->dz;
        const double t = (sag - r->z) / fall;
        if (!isfinite(t) || fall * with <= 0)
            return false;
        r->x += t * r->dx;
        r->y += t * r->dy;
        r->z += t * r->dz;
        if (fabs(t) < 1e-13 * (1 + fabs(r->x) + fabs(r->y)))
            return true;
    }
    return false;
}

/* Moves the ray onto the surface, to where it crosses it as reach_asphere says; n: its unit normal,
   turned with the ray. The ray itself may run either way: at a strongly curved first surface light
   arrives from the side, and from behind the plane of its vertex. */
static bool reach(const wo_system_surface *s, double with, local_ray *r, double n[3])
{
    /* Close to the vertex first: what follows is small. */
    const bool steep = fabs(r->dz) < STEEP;
    const double t0 = steep ? -(r->x * r->dx + r->y * r->dy + r->z * r->dz) : -r->z / r->dz;
    r->x += t0 * r->dx;
    r->y += t0 * r->dy;
    r->z = steep ? r->z + t0 * r->dz : 0;
    const bool in_x = s->meridian != WO_MERIDIAN_Y;
    const bool in_y = s->meridian != WO_MERIDIAN_X;
    const double across = (in_x ? r->x * r->dx : 0) + (in_y ? r->y * r->dy : 0);
    const double flat = (in_x ? r->dx * r->dx : 0) + (in_y ? r->dy * r->dy : 0);
    const double a = s->c * (flat + (1 + s->k) * r->dz * r->dz);
    const double b = r->dz - s->c * (across + (1 + s->k) * r->z * r->dz);
    const double c = s->c * (radius2(s, r->x, r->y) + (1 + s->k) * r->z * r->z) - 2 * r->z;
    const double d = b * b - a * c;
    if (d >= 0) {
        /* Of a t^2 - 2 b t + c = 0 the root with b - a t = +-sqrt(d), without cancellation. */
        const double root = copysign(sqrt(d), with);
        const double t = b * root >= 0 ? c / (b + root) : (b - root) / a;
        r->x += t * r->dx;
        r->y += t * r->dy;
        r->z += t * r->dz;
        n[0] = in_x ? -s->c * r->x : 0;
        n[1] = in_y ? -s->c * r->y : 0;
        n[2] = 1 - s->c * (1 + s->k) * r->z;
    }
    if (s->terms > 0) {
        if (!reach_asphere(s, with, r, n))
            return false;
    } else if (!(d >= 0) || !(n[2] > 0)) {
        return false; /* beside the surface, or on its far half */
    }
    const double scale = copysign(1 / sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), with);
    n[0] *= scale;
    n[1] *= scale;
    n[2] *= scale;
    return isfinite(n[0]) && isfinite(n[1]) && isfinite(r->x) && isfinite(r->y);
}

/* Transmission of unpolarised light through a bare surface (Fresnel). */
static double transmission(double n0, double n1, double cos0, double cos1)
{
    const double s = (n0 * cos0 - n1 * cos1) / (n0 * cos0 + n1 * cos1);
    const double p = (n1 * cos0 - n0 * cos1) / (n1 * cos0 + n0 * cos1);
    return 1 - 0.5 * (s * s + p * p);
}

/* One ray through one surface, with the light (with > 0) or against it (< 0). */
static wo_outcome pass(const wo_system_surface *s, double with, bool is_stop, unsigned flags,
                       local_ray *r, double *weight)
{
    double n[3] = {0, 0, 1};
    if (!reach(s, with, r, n))
        return WO_RAY_MISSED;
    const unsigned wanted = is_stop ? WO_TRACE_IRIS : WO_TRACE_CLIP;
    if ((flags & wanted) && r->x * r->x + r->y * r->y > s->semi2)
        return WO_RAY_BLOCKED;
    if (s->n0 == s->n1)
        return WO_RAY_PASSED;
    const double n_in = with > 0 ? s->n0 : s->n1;
    const double n_out = with > 0 ? s->n1 : s->n0;
    const double mu = n_in / n_out;
    const double cos0 = n[0] * r->dx + n[1] * r->dy + n[2] * r->dz;
    const double square = 1 - mu * mu * (1 - cos0 * cos0);
    if (!(cos0 > 0))
        return WO_RAY_MISSED;
    if (!(square >= 0))
        return WO_RAY_REFLECTED;
    const double cos1 = sqrt(square);
    const double g = cos1 - mu * cos0;
    r->dx = mu * r->dx + g * n[0];
    r->dy = mu * r->dy + g * n[1];
    r->dz = mu * r->dz + g * n[2];
    if (weight && (flags & WO_TRACE_FRESNEL))
        *weight *= transmission(n_in, n_out, cos0, cos1);
    return WO_RAY_PASSED;
}

void wo_system_trace(const wo_system *system, int first, int last, bool reverse, unsigned flags,
                     const wo_rays *rays, int count, double *stop_x, double *stop_y)
{
    const double with = reverse ? -1 : 1;
    const int entry = reverse ? system->count - 1 : 0;
    for (int i = 0; i < count; i++) {
        local_ray r = {rays->x[i], rays->y[i], rays->z[i], rays->dx[i], rays->dy[i], rays->dz[i]};
        wo_outcome outcome = WO_RAY_PASSED;
        for (int k = 0; k <= last - first && outcome == WO_RAY_PASSED; k++) {
            const int at = reverse ? last - k : first + k;
            const wo_system_surface *s = &system->surface[at];
            r.z -= s->z;
            const bool onwards = at == entry || (r.dz < 0) == reverse;
            outcome = onwards ? pass(s, with, at == system->stop, flags, &r,
                                     rays->weight ? &rays->weight[i] : NULL)
                              : WO_RAY_MISSED;
            r.z += s->z;
            if (at == system->stop && stop_x) {
                stop_x[i] = r.x;
                stop_y[i] = r.y;
            }
        }
        rays->x[i] = r.x;
        rays->y[i] = r.y;
        rays->z[i] = r.z;
        rays->dx[i] = r.dx;
        rays->dy[i] = r.dy;
        rays->dz[i] = r.dz;
        rays->outcome[i] = (uint8_t)outcome;
    }
}

bool wo_system_trace_meridional(const wo_system *system, double y, double *crossing, double *slope)
{
    /* q: distance of the ray from the vertex; u: its angle with the axis. */
    double q = y;
    double u = 0;
    for (int i = 0; i < system->count; i++) {
        const wo_system_surface *s = &system->surface[i];
        if (s->k != 0 || s->terms > 0 || s->meridian != WO_MERIDIAN_BOTH)
            return false;
        const double sin0 = q * s->c + sin(u);
        const double sin1 = sin0 * s->n0 / s->n1;
        if (!(fabs(sin0) <= 1 && fabs(sin1) <= 1))
            return false;
        const double i0 = asin(sin0);
        const double i1 = asin(sin1);
        const double u1 = u + i1 - i0;
        q *= (cos(u1) + cos(i1)) / (cos(u) + cos(i0));
        u = u1;
        if (i < system->count - 1)
            q += (system->surface[i + 1].z - s->z) * sin(u);
    }
    *crossing = -q / sin(u);
    *slope = tan(u);
    return true;
}
