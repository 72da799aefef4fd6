/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/lens_aim.h"

#include <math.h>

static const wo_system *system_at(const wo_exact_lens *lens, double nm)
{
    const wo_system *best = &lens->reference;
    for (int i = 0; i < lens->lines; i++)
        if (fabs(lens->line[i].nm - nm) < fabs(best->nm - nm))
            best = &lens->line[i];
    return best;
}

/* The rest of a ray that is aimed: the squares of its relative radii at the surfaces that clip, and
   the scene's end of it, at the plane of the entrance pupil. */
static bool finish(const wo_exact_lens *lens, const wo_system *system, const double s[2],
                   const double slope[2], double clip[WO_MODEL_CLIPS], wo_beam *out)
{
    for (int side = 0; side < 2; side++) {
        const bool reverse = side == 1;
        *out = wo_beam_from_iris(lens, s, slope, reverse);
        const int count = reverse ? system->stop : system->count - system->stop;
        for (int k = 0; k < count; k++) {
            const int at = reverse ? system->stop - 1 - k : system->stop + k;
            if (!wo_beam_through(system, at, at, reverse, out))
                return false;
            for (int c = 0; c < lens->clips; c++)
                if (lens->clip_surface[c] == at)
                    clip[c] =
                        (out->p[0] * out->p[0] + out->p[1] * out->p[1]) / system->surface[at].semi2;
        }
    }
    if (!(out->d[2] < 0))
        return false;
    wo_beam_run_to(out, lens->ep_z);
    return isfinite(out->p[0]) && isfinite(out->p[1]);
}

static bool ray_of(const wo_exact_lens *lens, const wo_system *system, double h, const double s[2],
                   const wo_aimed *aimed, wo_model_ray *ray)
{
    wo_beam out;
    if (!finish(lens, system, s, aimed->slope, ray->clip, &out))
        return false;
    for (int k = 0; k < 2; k++) {
        ray->b[k] = out.p[k] * 1e-3;
        ray->a[k] = -out.d[k] / out.d[2] + ray->b[k] * lens->vf;
    }
    ray->a[0] -= h;
    /* Etendue: the iris element's area times the projected solid angle in which it sees the sensor
       element, dp dq / (1 + p^2 + q^2)^2 for slopes p and q. */
    const double *const slope = aimed->slope;
    const double square = 1 + slope[0] * slope[0] + slope[1] * slope[1];
    ray->weight = fabs(lens->axis_jacobian / aimed->jacobian) / (square * square);
    return isfinite(ray->a[0]) && isfinite(ray->a[1]) && isfinite(ray->weight);
}

static void exact_rays(const void *self, double h, const double *nm, int lines,
                       const double (*u)[2], int count, wo_model_ray *out)
{
    const wo_exact_lens *lens = self;
    static const double centre[2] = {0, 0};
    wo_aim_target target;
    wo_aimed middle[WO_LINES_MAX];
    if (!wo_aim_at_field(lens, h, &target))
        return;
    for (int k = 0; k < lines; k++)
        if (!wo_aim(lens, system_at(lens, nm[k]), &target, &target.middle, NULL, centre,
                    &middle[k]))
            return;
    for (int i = 0; i < count; i++) {
        const double s[2] = {lens->iris * u[i][0], lens->iris * u[i][1]};
        wo_aimed aimed = middle[0];
        bool all = true;
        for (int k = 0; k < lines && all; k++) {
            const wo_system *system = system_at(lens, nm[k]);
            const wo_aimed before = aimed;
            wo_model_ray *const ray = &out[(size_t)k * (size_t)count + (size_t)i];
            all = wo_aim(lens, system, &target, &middle[k], k > 0 ? &before : NULL, s, &aimed) &&
                  ray_of(lens, system, h, s, &aimed, ray);
        }
        for (int k = 0; k < lines && !all; k++)
            out[(size_t)k * (size_t)count + (size_t)i].weight = 0;
    }
}

/* The surfaces outside whose clear radius a ray falls, one bit each; the iris does not count. */
static uint64_t blocked_by(const wo_exact_lens *lens, const double s[2], const double slope[2])
{
    const wo_system *const system = &lens->reference;
    uint64_t mask = 0;
    for (int side = 0; side < 2; side++) {
        wo_beam b = wo_beam_from_iris(lens, s, slope, side == 1);
        const int count = side ? system->stop : system->count - system->stop;
        for (int i = 0; i < count; i++) {
            const int at = side ? system->stop - 1 - i : system->stop + i;
            if (!wo_beam_through(system, at, at, side == 1, &b))
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
        wo_aim_target target;
        if (!wo_aim_at_field(lens, lens->field_max * f / FIELDS, &target))
            continue;
        for (int k = 0; k < PLACES; k++) {
            const double r = lens->iris * sqrt((k + 1.0) / PLACES);
            const double s[2] = {r * cos(2.399963 * k), r * sin(2.399963 * k)};
            wo_aimed aimed;
            if (wo_aim(lens, &lens->reference, &target, &target.middle, NULL, s, &aimed))
                masks[count++] = blocked_by(lens, s, aimed.slope);
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
    enum { STEPS = 64, HALVINGS = 8 };
    wo_aim_target target;
    double reached = 0;
    double step = half_field / STEPS;
    for (int i = 1; i <= STEPS; i++) {
        if (!wo_aim_at_field(lens, half_field * i / STEPS, &target))
            break;
        reached = half_field * i / STEPS;
    }
    for (int i = 0; i < HALVINGS && reached < half_field; i++) {
        step *= 0.5;
        if (wo_aim_at_field(lens, reached + step, &target))
            reached += step;
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
    static const double middle[1][2] = {{0, 0}};
    static const double line[1] = {WO_NM_D};
    wo_model_ray axis = {.weight = 0};
    exact_rays(out, 0, line, 1, middle, 1, &axis);
    if (!(axis.weight > 0))
        return wo_fail(error, WO_ERR_UNSUPPORTED, "%s lets no light through its middle",
                       lens->name);
    out->axis_jacobian = 1 / axis.weight;
    return WO_OK;
}

wo_lens_model wo_exact_lens_model(const wo_exact_lens *lens)
{
    return (wo_lens_model){.self = lens,
                           .clips = lens->clips,
                           .field_max = lens->field_max,
                           .reference_nm = WO_NM_D,
                           .rays = exact_rays};
}
