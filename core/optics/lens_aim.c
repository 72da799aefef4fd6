/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/lens_aim.h"

#include <math.h>

enum { NEWTON_MAX = 14, HALVINGS = 5 };

/* Of the way from the iris to the sensor: how near to its place a ray must land. */
#define LANDS      1e-11
#define SLOPE_STEP 1e-6 /* for differences */
#define LONGEST    0.5  /* change of a slope at once */
#define STALE      0.1  /* where an error falls by less, derivatives are taken anew */
#define FIRST_PART 0.25
#define LEAST_PART (1.0 / 64)

bool wo_beam_through(const wo_system *system, int first, int last, bool reverse, wo_beam *b)
{
    if (first > last)
        return true;
    uint8_t outcome;
    const wo_rays rays = {&b->p[0], &b->p[1], &b->p[2], &b->d[0],
                          &b->d[1], &b->d[2], NULL,     &outcome};
    wo_system_trace(system, first, last, reverse, 0, &rays, 1, NULL, NULL);
    return outcome == WO_RAY_PASSED;
}

void wo_beam_run_to(wo_beam *b, double z)
{
    const double t = (z - b->p[2]) / b->d[2];
    for (int k = 0; k < 3; k++)
        b->p[k] += t * b->d[k];
}

wo_beam wo_beam_from_iris(const wo_exact_lens *lens, const double s[2], const double slope[2],
                          bool reverse)
{
    const double n = (reverse ? -1 : 1) / sqrt(1 + slope[0] * slope[0] + slope[1] * slope[1]);
    const double z = lens->reference.surface[lens->reference.stop].z;
    return (wo_beam){{s[0], s[1], z}, {slope[0] * n, slope[1] * n, n}};
}

/* Where a ray that leaves the iris lands on the sensor, beside (x, 0). */
static bool land(const wo_exact_lens *lens, const wo_system *system, const double s[2],
                 const double slope[2], double x, double error[2])
{
    wo_beam b = wo_beam_from_iris(lens, s, slope, false);
    if (!wo_beam_through(system, system->stop, system->count - 1, false, &b) || !(b.d[2] > 0))
        return false;
    wo_beam_run_to(&b, lens->sensor_z);
    error[0] = b.p[0] - x;
    error[1] = b.p[1];
    return isfinite(error[0]) && isfinite(error[1]);
}

static bool derive(const wo_exact_lens *lens, const wo_system *system, const double s[2], double x,
                   const double error[2], wo_aimed *aimed)
{
    for (int k = 0; k < 2; k++) {
        double slope[2] = {aimed->slope[0], aimed->slope[1]};
        double beside[2];
        slope[k] += SLOPE_STEP;
        if (!land(lens, system, s, slope, x, beside))
            return false;
        aimed->j[k] = (beside[0] - error[0]) / SLOPE_STEP;
        aimed->j[2 + k] = (beside[1] - error[1]) / SLOPE_STEP;
    }
    aimed->jacobian = aimed->j[0] * aimed->j[3] - aimed->j[1] * aimed->j[2];
    return fabs(aimed->jacobian) > 0;
}

/* Newton's method in the two slopes, from aimed->slope with the derivatives aimed->j (all 0 = not
   known). A step that loses the ray, or lands farther off, is halved. */
static bool newton(const wo_exact_lens *lens, const wo_system *system, const double s[2], double x,
                   wo_aimed *aimed)
{
    const double near =
        LANDS * (lens->sensor_z - lens->reference.surface[lens->reference.stop].z + fabs(x));
    double e[2];
    if (!land(lens, system, s, aimed->slope, x, e))
        return false;
    bool fresh = false;
    for (int i = 0; i < NEWTON_MAX && hypot(e[0], e[1]) > near; i++) {
        double *const j = aimed->j;
        if (!(fabs(j[0] * j[3] - j[1] * j[2]) > 0)) {
            if (!derive(lens, system, s, x, e, aimed))
                return false;
            fresh = true;
        }
        const double det = j[0] * j[3] - j[1] * j[2];
        double d[2] = {(j[3] * e[0] - j[1] * e[1]) / det, (j[0] * e[1] - j[2] * e[0]) / det};
        const double longest = fmax(fabs(d[0]), fabs(d[1]));
        double part = longest > LONGEST ? LONGEST / longest : 1;
        const double slope[2] = {aimed->slope[0], aimed->slope[1]};
        const double before = hypot(e[0], e[1]);
        int halved = 0;
        double next[2];
        for (; halved <= HALVINGS; halved++, part *= 0.5) {
            for (int k = 0; k < 2; k++)
                aimed->slope[k] = slope[k] - part * d[k];
            if (land(lens, system, s, aimed->slope, x, next) && hypot(next[0], next[1]) < before)
                break;
        }
        const bool better = halved <= HALVINGS;
        if (!better) {
            aimed->slope[0] = slope[0];
            aimed->slope[1] = slope[1];
            /* As near as numbers go, or nowhere to go. */
            if (fresh)
                return before <= 100 * near && derive(lens, system, s, x, e, aimed);
        } else {
            e[0] = next[0];
            e[1] = next[1];
        }
        if (!better || hypot(e[0], e[1]) > STALE * before)
            j[0] = j[1] = j[2] = j[3] = 0;
        fresh = false;
    }
    return hypot(e[0], e[1]) <= near && derive(lens, system, s, x, e, aimed);
}

/* Where a ray at the middle of the iris crosses the plane of focus, seen from the scene's origin.
 */
static bool seen_at_focus(const wo_exact_lens *lens, double slope, double *tangent)
{
    static const double middle[2] = {0, 0};
    const double slopes[2] = {slope, 0};
    const wo_system *const system = &lens->reference;
    wo_beam b = wo_beam_from_iris(lens, middle, slopes, true);
    if (!wo_beam_through(system, 0, system->stop - 1, true, &b) || !(b.d[2] < 0))
        return false;
    wo_beam_run_to(&b, lens->ep_z);
    *tangent = -b.d[0] / b.d[2] + b.p[0] * 1e-3 * lens->vf;
    return isfinite(*tangent);
}

/* The secant method from the paraxial value. */
static bool chief(const wo_exact_lens *lens, double h, double *slope)
{
    double x0 = 0;
    double f0 = -h;
    double f1;
    if (!seen_at_focus(lens, 1e-5, &f1))
        return false;
    double x1 = h * 1e-5 / f1;
    for (int i = 0; i < 60; i++) {
        if (!seen_at_focus(lens, x1, &f1)) {
            x1 = 0.5 * (x0 + x1);
            continue;
        }
        f1 -= h;
        if (fabs(f1) < 1e-13 * (1 + h)) {
            *slope = x1;
            return true;
        }
        if (f1 == f0)
            return false;
        const double next = x1 - f1 * (x1 - x0) / (f1 - f0);
        x0 = x1;
        f0 = f1;
        x1 = next;
    }
    return false;
}

bool wo_aim_at_field(const wo_exact_lens *lens, double h, wo_aim_target *target)
{
    static const double middle[2] = {0, 0};
    static const double here[2] = {0, 0};
    double at[2];
    *target = (wo_aim_target){0};
    if (!chief(lens, h, &target->middle.slope[0]) ||
        !land(lens, &lens->reference, middle, target->middle.slope, 0, at))
        return false;
    target->x = at[0];
    return derive(lens, &lens->reference, middle, at[0], here, &target->middle);
}

bool wo_aim(const wo_exact_lens *lens, const wo_system *system, const wo_aim_target *target,
            const wo_aimed *middle, const wo_aimed *guess, const double s[2], wo_aimed *aimed)
{
    const wo_aimed *const first[2] = {guess, middle};
    for (int i = 0; i < 2; i++) {
        if (!first[i])
            continue;
        *aimed = *first[i];
        if (newton(lens, system, s, target->x, aimed) && aimed->jacobian > 0)
            return true;
    }
    /* Far out a second ray from s may land at the same place, near to grazing some surface; where
       Newton's method finds that one or none, the way there goes over points between. */
    wo_aimed at = *middle;
    double part = 0;
    for (double step = FIRST_PART; part < 1;) {
        const double next = fmin(part + step, 1);
        const double between[2] = {next * s[0], next * s[1]};
        wo_aimed trial = at;
        if (newton(lens, system, between, target->x, &trial) && trial.jacobian > 0) {
            at = trial;
            part = next;
            step *= 2;
        } else if ((step *= 0.5) < LEAST_PART) {
            return false;
        }
    }
    *aimed = at;
    return true;
}
