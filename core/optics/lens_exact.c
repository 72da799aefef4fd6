/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/lens_model.h"

#include <math.h>

/* A ray in the lens: place and direction. */
typedef struct beam {
    double p[3], d[3];
} beam;

static bool through(const wo_system *system, int first, int last, bool reverse, beam *b)
{
    if (first > last)
        return true;
    uint8_t outcome;
    const wo_rays rays = {&b->p[0], &b->p[1], &b->p[2], &b->d[0],
                          &b->d[1], &b->d[2], NULL,     &outcome};
    wo_system_trace(system, first, last, reverse, 0, &rays, 1, NULL, NULL);
    return outcome == WO_RAY_PASSED;
}

static beam from_iris(const wo_exact_lens *lens, const double s[2], const double slope[2],
                      bool reverse)
{
    const double n = (reverse ? -1 : 1) / sqrt(1 + slope[0] * slope[0] + slope[1] * slope[1]);
    const double z = lens->reference.surface[lens->reference.stop].z;
    return (beam){{s[0], s[1], z}, {slope[0] * n, slope[1] * n, n}};
}

static void run_to(beam *b, double z)
{
    const double t = (z - b->p[2]) / b->d[2];
    for (int k = 0; k < 3; k++)
        b->p[k] += t * b->d[k];
}

/* Where a ray that leaves the iris lands on the sensor; slopes are those at the iris. */
static bool land(const wo_exact_lens *lens, const wo_system *system, const double s[2],
                 const double slope[2], beam *out)
{
    *out = from_iris(lens, s, slope, false);
    if (!through(system, system->stop, system->count - 1, false, out) || !(out->d[2] > 0))
        return false;
    run_to(out, lens->sensor_z);
    return isfinite(out->p[0]) && isfinite(out->p[1]);
}

/* The same ray, followed to the scene; at the plane of the entrance pupil. */
static bool look(const wo_exact_lens *lens, const wo_system *system, const double s[2],
                 const double slope[2], beam *out)
{
    *out = from_iris(lens, s, slope, true);
    if (!through(system, 0, system->stop - 1, true, out) || !(out->d[2] < 0))
        return false;
    run_to(out, lens->ep_z);
    return isfinite(out->p[0]) && isfinite(out->p[1]);
}

/* Where a ray crosses the plane of focus, seen from the scene's origin. */
static double seen_at_focus(const wo_exact_lens *lens, const beam *b)
{
    return -b->d[0] / b->d[2] + b->p[0] * 1e-3 * lens->vf;
}

/* Slope at the middle of the iris whose ray shows tangent h in the plane of focus, in the reference
   wavelength (the secant method from the paraxial value). */
static bool chief(const wo_exact_lens *lens, double h, double *slope)
{
    static const double middle[2] = {0, 0};
    double x0 = 0;
    double f0 = -h;
    beam b;
    double s[2] = {1e-5, 0};
    if (!look(lens, &lens->reference, middle, s, &b))
        return false;
    const double rate = seen_at_focus(lens, &b) / 1e-5;
    double x1 = h / rate;
    for (int i = 0; i < 60; i++) {
        s[0] = x1;
        if (!look(lens, &lens->reference, middle, s, &b)) {
            x1 = 0.5 * (x0 + x1);
            continue;
        }
        const double f1 = seen_at_focus(lens, &b) - h;
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

/* Newton's method in the two slopes, for a ray from s that lands at (x, 0). jacobian: of the
   landing place by the slopes. */
static bool aim(const wo_exact_lens *lens, const wo_system *system, const double s[2], double x,
                double slope[2], double *jacobian, beam *landed)
{
    const double step = 1e-6;
    for (int i = 0; i < 40; i++) {
        beam px;
        beam py;
        if (!land(lens, system, s, slope, landed)) {
            slope[0] *= 0.9;
            slope[1] *= 0.9;
            continue;
        }
        const double beside[2] = {slope[0] + step, slope[1]};
        const double above[2] = {slope[0], slope[1] + step};
        if (!land(lens, system, s, beside, &px) || !land(lens, system, s, above, &py))
            return false;
        const double j[4] = {(px.p[0] - landed->p[0]) / step, (py.p[0] - landed->p[0]) / step,
                             (px.p[1] - landed->p[1]) / step, (py.p[1] - landed->p[1]) / step};
        *jacobian = j[0] * j[3] - j[1] * j[2];
        const double ex = landed->p[0] - x;
        const double ey = landed->p[1];
        if (ex * ex + ey * ey < 1e-24 * (1 + x * x))
            return true;
        if (!(fabs(*jacobian) > 0))
            return false;
        double dx = (j[3] * ex - j[1] * ey) / *jacobian;
        double dy = (j[0] * ey - j[2] * ex) / *jacobian;
        const double longest = fmax(fabs(dx), fabs(dy));
        if (longest > 0.5) {
            dx *= 0.5 / longest;
            dy *= 0.5 / longest;
        }
        slope[0] -= dx;
        slope[1] -= dy;
        if (longest < 1e-15)
            return true;
    }
    return false;
}

/* The same for a ray whose slope is that of the middle of the iris so far. Far out a second ray
   from s may land at the same place, near to grazing some surface; where Newton's method finds that
   one (its jacobian is negative) or none, the way there goes over points between. */
static bool aim_from_middle(const wo_exact_lens *lens, const wo_system *system, const double s[2],
                            double x, double slope[2], double *jacobian, beam *landed)
{
    enum { STEPS = 8 };
    double direct[2] = {slope[0], slope[1]};
    if (aim(lens, system, s, x, direct, jacobian, landed) && *jacobian > 0) {
        slope[0] = direct[0];
        slope[1] = direct[1];
        return true;
    }
    for (int i = 1; i <= STEPS; i++) {
        const double part = (double)i / STEPS;
        const double between[2] = {part * s[0], part * s[1]};
        if (!aim(lens, system, between, x, slope, jacobian, landed) || !(*jacobian > 0))
            return false;
    }
    return true;
}

/* Squares of the relative radii at the surfaces that clip. */
static bool clip_of(const wo_exact_lens *lens, const wo_system *system, const double s[2],
                    const double slope[2], double clip[WO_MODEL_CLIPS])
{
    for (int side = 0; side < 2; side++) {
        const bool reverse = side == 1;
        beam b = from_iris(lens, s, slope, reverse);
        const int count = reverse ? system->stop : system->count - system->stop;
        for (int k = 0; k < count; k++) {
            const int at = reverse ? system->stop - 1 - k : system->stop + k;
            if (!through(system, at, at, reverse, &b))
                return false;
            for (int c = 0; c < lens->clips; c++)
                if (lens->clip_surface[c] == at)
                    clip[c] = (b.p[0] * b.p[0] + b.p[1] * b.p[1]) / system->surface[at].semi2;
        }
    }
    return true;
}

static const wo_system *system_at(const wo_exact_lens *lens, double nm)
{
    const wo_system *best = &lens->reference;
    for (int i = 0; i < lens->lines; i++)
        if (fabs(lens->line[i].nm - nm) < fabs(best->nm - nm))
            best = &lens->line[i];
    return best;
}

static bool exact_ray(const void *self, double h, const double u[2], double nm, wo_model_ray *ray)
{
    const wo_exact_lens *lens = self;
    const wo_system *system = system_at(lens, nm);
    static const double middle[2] = {0, 0};
    double start;
    beam b;
    if (!chief(lens, h, &start))
        return false;
    double slope[2] = {start, 0};
    if (!land(lens, &lens->reference, middle, slope, &b))
        return false;
    const double x = b.p[0];
    const double s[2] = {lens->iris * u[0], lens->iris * u[1]};
    double jacobian = 1;
    if (!aim_from_middle(lens, system, s, x, slope, &jacobian, &b))
        return false;
    beam out;
    if (!look(lens, system, s, slope, &out))
        return false;
    ray->b[0] = out.p[0] * 1e-3;
    ray->b[1] = out.p[1] * 1e-3;
    ray->a[0] = seen_at_focus(lens, &out) - h;
    ray->a[1] = -out.d[1] / out.d[2] + ray->b[1] * lens->vf;
    /* Etendue: the iris element's area times the projected solid angle in which it sees the sensor
       element, dp dq / (1 + p^2 + q^2)^2 for slopes p and q. */
    const double square = 1 + slope[0] * slope[0] + slope[1] * slope[1];
    ray->weight = fabs(lens->axis_jacobian / jacobian) / (square * square);
    return isfinite(ray->a[0]) && isfinite(ray->a[1]) && isfinite(ray->weight) &&
           clip_of(lens, system, s, slope, ray->clip);
}

/* The surfaces outside whose clear radius a ray falls, one bit each; the iris does not count. */
static uint64_t blocked_by(const wo_exact_lens *lens, const double s[2], const double slope[2])
{
    const wo_system *const system = &lens->reference;
    uint64_t mask = 0;
    for (int side = 0; side < 2; side++) {
        beam b = from_iris(lens, s, slope, side == 1);
        const int count = side ? system->stop : system->count - system->stop;
        for (int i = 0; i < count; i++) {
            const int at = side ? system->stop - 1 - i : system->stop + i;
            if (!through(system, at, at, side == 1, &b))
                break;
            const double r2 = b.p[0] * b.p[0] + b.p[1] * b.p[1];
            if (at != system->stop && r2 > system->surface[at].semi2)
                mask |= (uint64_t)1 << at;
        }
    }
    return mask;
}

/* Surfaces that stop light, over the field: first the one that stops most, then the one that stops
   most of the rest. */
static void choose_clips(wo_exact_lens *lens)
{
    enum { FIELDS = 12, PLACES = 60 };
    uint64_t masks[(FIELDS + 1) * PLACES];
    int count = 0;
    for (int f = 0; f <= FIELDS; f++) {
        double slope[2] = {0, 0};
        static const double middle[2] = {0, 0};
        beam b;
        if (!chief(lens, lens->field_max * f / FIELDS, &slope[0]) ||
            !land(lens, &lens->reference, middle, slope, &b))
            continue;
        const double x = b.p[0];
        for (int k = 0; k < PLACES; k++) {
            const double r = lens->iris * sqrt((k + 1.0) / PLACES);
            const double s[2] = {r * cos(2.399963 * k), r * sin(2.399963 * k)};
            double aimed[2] = {slope[0], 0};
            double jacobian;
            if (aim_from_middle(lens, &lens->reference, s, x, aimed, &jacobian, &b))
                masks[count++] = blocked_by(lens, s, aimed);
        }
    }
    for (lens->clips = 0; lens->clips < WO_MODEL_CLIPS; lens->clips++) {
        int stopped[WO_SURFACES_MAX] = {0};
        int best = 0;
        for (int at = 0; at < lens->reference.count; at++) {
            for (int i = 0; i < count; i++)
                stopped[at] += (masks[i] >> at & 1) != 0;
            best = stopped[at] > stopped[best] ? at : best;
        }
        if (stopped[best] == 0)
            return;
        lens->clip_surface[lens->clips] = best;
        for (int i = 0; i < count; i++)
            masks[i] = masks[i] >> best & 1 ? 0 : masks[i];
    }
}

/* The largest field, up to half_field, whose chief ray gets through the lens. */
static double reachable_field(const wo_exact_lens *lens, double half_field)
{
    static const double middle[2] = {0, 0};
    enum { STEPS = 64 };
    double reached = 0;
    for (int i = 1; i <= STEPS; i++) {
        const double h = half_field * i / STEPS;
        double slope[2] = {0, 0};
        beam b;
        if (!chief(lens, h, &slope[0]) || !land(lens, &lens->reference, middle, slope, &b))
            break;
        reached = h;
    }
    return reached;
}

wo_status wo_exact_lens_make(const wo_prescription *lens, double f_number, double vf,
                             double half_field, const double *nm, int lines, wo_exact_lens *out,
                             wo_error *error)
{
    WO_TRY(wo_lens_model_check(lens, error));
    if (lines < 1 || lines > WO_LINES_MAX)
        return wo_fail(error, WO_ERR_RANGE, "%d wavelengths: must be 1..%d", lines, WO_LINES_MAX);
    *out = (wo_exact_lens){.lines = lines, .vf = vf};
    wo_system_make(lens, WO_NM_D, &out->reference);
    for (int i = 0; i < lines; i++)
        wo_system_make(lens, nm[i], &out->line[i]);
    wo_first_order first;
    wo_system_first_order(&out->reference, WO_MERIDIAN_X, &first);
    const double image = wo_system_image(&out->reference, WO_MERIDIAN_X, vf);
    if (!isfinite(first.efl) || !isfinite(first.ep_z) || !isfinite(first.fno) || first.fno <= 0)
        return wo_fail(error, WO_ERR_UNSUPPORTED, "%s has %s: it cannot be put behind a picture",
                       lens->name,
                       !isfinite(first.efl) ? "no power" : "an entrance pupil at infinity or none");
    if (!(image > 0) || !isfinite(image))
        return wo_fail(error, WO_ERR_RANGE,
                       "%s gives no real image of an object at %g dioptres: focus farther away",
                       lens->name, vf);
    if (vf > 0 && 1e3 / vf <= first.ep_z)
        return wo_fail(error, WO_ERR_RANGE,
                       "%s focused at %g dioptres, %g mm in front of its entrance pupil: that is "
                       "inside of the lens, focus farther away than %g mm",
                       lens->name, vf, 1e3 / vf, first.ep_z);
    const double full = sqrt(out->reference.surface[lens->stop].semi2);
    out->f_number = f_number > first.fno ? f_number : first.fno;
    out->iris = full * first.fno / out->f_number;
    out->ep_z = first.ep_z;
    out->sensor_z = out->reference.z_last + image;
    out->axis_jacobian = 1;
    out->field_max = half_field;
    out->field_max = reachable_field(out, half_field);
    if (out->field_max == 0)
        return wo_fail(error, WO_ERR_UNSUPPORTED, "%s lets no light through", lens->name);
    choose_clips(out);
    wo_model_ray axis;
    static const double middle[2] = {0, 0};
    if (!exact_ray(out, 0, middle, WO_NM_D, &axis))
        return wo_fail(error, WO_ERR_UNSUPPORTED, "%s lets no light through its middle",
                       lens->name);
    out->axis_jacobian = 1 / axis.weight;
    return WO_OK;
}

wo_lens_model wo_exact_lens_model(const wo_exact_lens *lens)
{
    return (wo_lens_model){lens, lens->clips, lens->field_max, WO_NM_D, 0, exact_ray};
}
