/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/aperture.h"

#include <math.h>

#define PI 3.14159265358979323846

enum { SECTOR = 256 };

wo_status wo_aperture_validate(const wo_aperture *a, wo_error *error)
{
    if (!(a->blades == 0 || (a->blades >= 3 && a->blades <= WO_BLADES_MAX)))
        return wo_fail(error, WO_ERR_RANGE, "%d aperture blades: must be 0 (round) or 3..%d",
                       a->blades, WO_BLADES_MAX);
    if (!(a->curvature >= -1 && a->curvature <= 1))
        return wo_fail(error, WO_ERR_RANGE, "blade curvature %g: must be -1..1", a->curvature);
    if (!isfinite(a->rotation))
        return wo_fail(error, WO_ERR_RANGE, "aperture rotation %g: must be finite", a->rotation);
    if (!(a->aspect >= 0.1 && a->aspect <= 10))
        return wo_fail(error, WO_ERR_RANGE, "aperture aspect %g: must be 0.1..10", a->aspect);
    return WO_OK;
}

/* Boundary of a blade at angle a from its vertex, 0 <= a <= 2 pi / blades. */
static double blade_radius(const wo_aperture *aperture, double a)
{
    if (aperture->blades == 0)
        return 1;
    const double half = PI / aperture->blades;
    const double straight = cos(half) / cos(a - half);
    const double c = aperture->curvature;
    return c >= 0 ? straight + c * (1 - straight) : straight * (1 + c * (1 - straight));
}

void wo_aperture_make(const wo_aperture *aperture, wo_aperture_shape *shape)
{
    *shape = (wo_aperture_shape){.aperture = *aperture, .scale_x = 1, .scale_y = 1};
    shape->turn = fmod(aperture->rotation, 360) * (PI / 180);
    if (aperture->aspect < 1)
        shape->scale_x = aperture->aspect;
    else
        shape->scale_y = 1 / aperture->aspect;
    const int blades = aperture->blades;
    if (blades == 0) {
        for (int i = 0; i <= SECTOR; i++)
            shape->sector[i] = (float)i / SECTOR;
        shape->area = PI * shape->scale_x * shape->scale_y;
        return;
    }
    /* Cumulative area over the blade's angle by Simpson's rule on fine steps, then inverted. */
    enum { FINE = 4096 };
    double total = 0;
    double cumulative[FINE + 1];
    const double span = 2 * PI / blades;
    cumulative[0] = 0;
    for (int i = 0; i < FINE; i++) {
        const double a = span * i / FINE;
        const double h = span / FINE;
        const double r0 = blade_radius(aperture, a);
        const double r1 = blade_radius(aperture, a + 0.5 * h);
        const double r2 = blade_radius(aperture, a + h);
        total += h / 12 * (r0 * r0 + 4 * r1 * r1 + r2 * r2);
        cumulative[i + 1] = total;
    }
    int j = 0;
    for (int i = 0; i <= SECTOR; i++) {
        const double want = total * i / SECTOR;
        while (j < FINE - 1 && cumulative[j + 1] < want)
            j++;
        const double part = (want - cumulative[j]) / (cumulative[j + 1] - cumulative[j]);
        shape->sector[i] = (float)((j + part) / FINE);
    }
    shape->area = total * blades * shape->scale_x * shape->scale_y;
}

/* Shirley and Chiu's concentric map, 1997: unit square to radius and angle in turns, 0..1. */
static void concentric(double s, double t, double *radius, double *turns)
{
    const double a = 2 * s - 1;
    const double b = 2 * t - 1;
    double angle;
    if (fabs(a) > fabs(b)) {
        *radius = fabs(a);
        angle = 0.125 * (b / a) + (a < 0 ? 0.5 : 0);
    } else {
        *radius = fabs(b);
        angle = b != 0 ? 0.25 - 0.125 * (a / b) + (b < 0 ? 0.5 : 0) : 0;
    }
    *turns = angle - floor(angle);
}

void wo_aperture_sample(const wo_aperture_shape *shape, double s, double t, double u[2])
{
    double radius;
    double turns;
    concentric(s, t, &radius, &turns);
    const int blades = shape->aperture.blades;
    double angle = 2 * PI * turns;
    if (blades > 0) {
        double whole;
        const double within = modf(turns * blades, &whole);
        const double at = within * SECTOR;
        const int i = at < SECTOR - 1 ? (int)at : SECTOR - 1;
        const double part = shape->sector[i] + (at - i) * (shape->sector[i + 1] - shape->sector[i]);
        const double inside = part * 2 * PI / blades;
        radius *= blade_radius(&shape->aperture, inside);
        angle = 2 * PI * whole / blades + inside;
    }
    angle += shape->turn;
    u[0] = radius * cos(angle) * shape->scale_x;
    u[1] = radius * sin(angle) * shape->scale_y;
}

bool wo_aperture_inside(const wo_aperture_shape *shape, double x, double y)
{
    x /= shape->scale_x;
    y /= shape->scale_y;
    const double r2 = x * x + y * y;
    if (!(r2 <= 1))
        return false;
    if (shape->aperture.blades == 0)
        return true;
    const double span = 2 * PI / shape->aperture.blades;
    double angle = fmod(atan2(y, x) - shape->turn, span);
    if (angle < 0)
        angle += span;
    const double r = blade_radius(&shape->aperture, angle);
    return r2 <= r * r;
}

void wo_aperture_mask(const wo_aperture_shape *shape, int size, float *mask)
{
    enum { SUB = 8 };
    for (int y = 0; y < size; y++) {
        for (int x = 0; x < size; x++) {
            int hits = 0;
            for (int i = 0; i < SUB * SUB; i++) {
                const double px = x + (i % SUB + 0.5) / SUB;
                const double py = y + ((double)(i / SUB) + 0.5) / SUB;
                hits += wo_aperture_inside(shape, 2 * px / size - 1, 2 * py / size - 1);
            }
            mask[(size_t)y * (size_t)size + (size_t)x] = (float)hits / (SUB * SUB);
        }
    }
}
