/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "lens_view_private.h"

#include <math.h>

#define RADIANS 0.017453292519943295

const double wo_lens_nm[WO_LENS_LINES] = {WO_NM_F, WO_NM_D, WO_NM_C};
const double wo_lens_fields[WO_LENS_FIELDS] = {0, 0.7, 1};

double wo_lens_sag(const wo_surface *s, wo_meridian meridian, double r)
{
    if (s->meridian != WO_MERIDIAN_BOTH && s->meridian != meridian)
        return 0;
    const double r2 = r * r, root2 = 1 - (1 + s->conic) * s->curvature * s->curvature * r2;
    if (root2 < 0)
        return NAN;
    double sum = 0;
    for (int i = s->asphere_terms - 1; i >= 0; i--)
        sum = sum * r2 + s->asphere[i];
    return s->curvature * r2 / (1 + sqrt(root2)) + sum * r2;
}

double wo_lens_sensor_z(const wo_lens_view *view)
{
    return view->system.z_last + view->image;
}

/* A pupil at infinity counts as one at the first vertex. */
static double pupil_z(const wo_lens_view *view)
{
    return isfinite(view->first[1].ep_z) ? view->first[1].ep_z : 0;
}

static wo_status stop_down(wo_lens_view *view, double f_number, wo_error *error)
{
    wo_surface *const stop = &view->lens.surface[view->lens.stop];
    if (f_number <= 0)
        return WO_OK;
    const wo_first_order *const open = &view->first[1];
    const double semi = fabs(open->efl / open->ep_mag) / (2 * f_number);
    if (!isfinite(semi) || semi <= 0)
        return wo_fail(error, WO_ERR_UNSUPPORTED,
                       "%s has no f-number: no focal length, or no pupil in front",
                       view->lens.name);
    if (stop->semi_aperture > 0 && semi > stop->semi_aperture * 1.0005)
        return wo_fail(error, WO_ERR_RANGE, "f/%.4g is wider than %s opens: f/%.4g", f_number,
                       view->lens.name, open->fno);
    stop->semi_aperture = semi;
    return WO_OK;
}

static void make_systems(wo_lens_view *view)
{
    wo_system_make(&view->lens, view->nm, &view->system);
    for (int i = 0; i < WO_LENS_LINES; i++)
        wo_system_make(&view->lens, wo_lens_nm[i], &view->line[i]);
    wo_system_first_order(&view->system, WO_MERIDIAN_X, &view->first[0]);
    wo_system_first_order(&view->system, WO_MERIDIAN_Y, &view->first[1]);
    for (int m = 0; m < 2; m++)
        if (!isfinite(view->first[m].ep_d))
            view->first[m].fno = NAN;
}

static double field_of(const wo_lens_view *view)
{
    wo_lens_beam axis, beam;
    if (!wo_lens_beam_make(view, 0, &axis))
        return 1;
    for (double field = 45; field > 1; field -= 1) {
        const double height = wo_lens_chief_height(view, &view->system, view->across, field);
        if (wo_lens_beam_make(view, height, &beam) && beam.light > axis.light / 3)
            return field;
    }
    return 1;
}

/* That of the entrance pupil, unless clear radii leave less of it than the iris does. */
static double working_f_number(const wo_lens_view *view)
{
    double clear_low, clear_high, low, high, chief;
    const double paraxial = view->first[1].fno;
    if (!wo_lens_fan(view, WO_MERIDIAN_Y, 0, WO_TRACE_CLIP, &clear_low, &clear_high, &chief))
        return paraxial;
    const double clear = fabs(view->first[1].efl) / (clear_high - clear_low);
    if (!isfinite(paraxial) || !wo_lens_fan(view, WO_MERIDIAN_Y, 0, 0, &low, &high, &chief))
        return clear;
    return clear_high - clear_low < 0.98 * (high - low) ? fmax(clear, paraxial) : paraxial;
}

wo_status wo_lens_view_make(const wo_prescription *lens, const wo_lens_setup *setup,
                            wo_lens_view *view, wo_error *error)
{
    *view = (wo_lens_view){
        .lens = *lens, .nm = setup->nm, .open_semi = lens->surface[lens->stop].semi_aperture};
    for (int i = 0; i < lens->count; i++)
        view->anamorphic = view->anamorphic || lens->surface[i].meridian != WO_MERIDIAN_BOTH;
    make_systems(view);
    view->across =
        fabs(view->first[0].efl) < 0.99 * fabs(view->first[1].efl) ? WO_MERIDIAN_X : WO_MERIDIAN_Y;
    WO_TRY(stop_down(view, setup->f_number, error));
    make_systems(view);
    view->vf = setup->focus_m > 0 ? 1 / setup->focus_m : 0;
    if (view->vf > 0 && pupil_z(view) - 1000 / view->vf > -1)
        return wo_fail(error, WO_ERR_RANGE, "an object at %g m lies inside of %s", setup->focus_m,
                       lens->name);
    const double x = wo_system_image(&view->system, WO_MERIDIAN_X, view->vf);
    const double y = wo_system_image(&view->system, WO_MERIDIAN_Y, view->vf);
    view->image = isfinite(x) && isfinite(y) ? (x + y) / 2 : isfinite(y) ? y : x;
    view->f_number = working_f_number(view);
    view->half_field = setup->half_field > 0 ? setup->half_field : lens->half_field;
    if (view->half_field <= 0)
        view->half_field = field_of(view);
    if (view->vf > 0 && view->half_field >= WO_LENS_PLANE_FIELD)
        return wo_fail(error, WO_ERR_RANGE,
                       "a half field of %g degrees with an object at %g m: the plane in focus ends "
                       "before %g degrees; give a smaller --field, or no --focus",
                       view->half_field, setup->focus_m, WO_LENS_PLANE_FIELD);
    return WO_OK;
}

wo_status wo_lens_needs_image(const wo_lens_view *view, wo_error *error)
{
    if (isfinite(view->image) && view->image > -view->system.z_last &&
        isfinite(view->first[1].efl) && view->first[1].ep_d > 0)
        return WO_OK;
    return wo_fail(error, WO_ERR_UNSUPPORTED,
                   "%s makes no real image of an object at that distance: only its section and "
                   "first-order data can be had",
                   view->lens.name);
}

static double front_semi(const wo_lens_view *view)
{
    const double semi = view->lens.surface[0].semi_aperture;
    if (semi > 0)
        return semi;
    double largest = fmax(view->first[1].ep_d, view->first[0].ep_d) / 2;
    if (!isfinite(largest) || largest <= 0)
        largest = 10;
    for (int i = 0; i < view->lens.count; i++)
        largest = fmax(largest, view->lens.surface[i].semi_aperture);
    return largest * 1.5;
}

/* Of every ray that meets the clear first surface, the largest coordinate in the plane that
   wo_lens_aim_at counts in. */
static double reach_of(const wo_lens_view *view, double field)
{
    const double semi = front_semi(view), angle = fabs(field) * RADIANS;
    const double x = wo_lens_sag(&view->lens.surface[0], WO_MERIDIAN_X, semi);
    const double y = wo_lens_sag(&view->lens.surface[0], WO_MERIDIAN_Y, semi);
    const double sag = fmax(isnan(x) ? semi : fabs(x), isnan(y) ? semi : fabs(y));
    const double pupil = view->lens.surface[0].semi_aperture > 0 ? 0 : fabs(pupil_z(view));
    if (view->vf > 0)
        return semi * 1.02 + sag * (tan(angle) + semi * view->vf / 1000) + pupil * tan(angle);
    return semi * 1.02 + (sag + pupil) * sin(angle);
}

static void aim_from_infinity(const wo_lens_view *view, wo_meridian meridian, double field,
                              double px, double py, double p[3], double d[3])
{
    const double across = sin(field * RADIANS), along = cos(field * RADIANS);
    const bool in_x = meridian == WO_MERIDIAN_X;
    const double back = 2 * front_semi(view) + 1;
    d[0] = in_x ? across : 0;
    d[1] = in_x ? 0 : across;
    d[2] = along;
    p[0] = (in_x ? px * along : px) - d[0] * back;
    p[1] = (in_x ? py : py * along) - d[1] * back;
    p[2] = -(in_x ? px : py) * across - d[2] * back;
}

void wo_lens_aim_at(const wo_lens_view *view, wo_meridian meridian, double field, double px,
                    double py, double p[3], double d[3])
{
    if (!(view->vf > 0)) {
        aim_from_infinity(view, meridian, field, px, py, p, d);
        return;
    }
    const double slope = tan(field * RADIANS), far = 1000 / view->vf;
    const double sx = meridian == WO_MERIDIAN_X ? slope : 0, sy = slope - sx;
    const double to_plane = far - pupil_z(view);
    const double back = fmin(front_semi(view) + 1, to_plane);
    d[0] = (px + sx * far) / to_plane;
    d[1] = (py + sy * far) / to_plane;
    const double length = sqrt(1 + d[0] * d[0] + d[1] * d[1]);
    p[0] = px - d[0] * back;
    p[1] = py - d[1] * back;
    p[2] = -back;
    d[0] /= length;
    d[1] /= length;
    d[2] = 1 / length;
}

wo_lens_ray wo_lens_aim(const wo_lens_view *view, wo_meridian meridian, double field, double h)
{
    wo_lens_ray ray = {.outcome = WO_RAY_PASSED, .stop = NAN};
    wo_lens_aim_at(view, meridian, field, meridian == WO_MERIDIAN_X ? h : 0,
                   meridian == WO_MERIDIAN_X ? 0 : h, ray.p, ray.d);
    return ray;
}

void wo_lens_trace(const wo_system *system, int first, int last, unsigned flags,
                   wo_meridian meridian, wo_lens_ray *ray)
{
    uint8_t outcome = 0;
    double stop[2] = {NAN, NAN};
    const wo_rays rays = {.x = &ray->p[0],
                          .y = &ray->p[1],
                          .z = &ray->p[2],
                          .dx = &ray->d[0],
                          .dy = &ray->d[1],
                          .dz = &ray->d[2],
                          .outcome = &outcome};
    wo_system_trace(system, first, last, false, flags, &rays, 1, &stop[0], &stop[1]);
    ray->outcome = (wo_outcome)outcome;
    if (first <= system->stop && system->stop <= last)
        ray->stop = stop[meridian == WO_MERIDIAN_X ? 0 : 1];
}

/* ------------------------------------------------------------------------------- fans */

typedef struct fan {
    const wo_lens_view *view;
    wo_meridian meridian;
    double field, reach;
} fan;

enum { PROBES = 801 };

static double place(const fan *f, int i, int probes)
{
    return f->reach * (2.0 * i / (probes - 1) - 1);
}

static wo_lens_ray probe(const fan *f, double h, unsigned flags)
{
    const wo_system *const system = &f->view->system;
    wo_lens_ray ray = wo_lens_aim(f->view, f->meridian, f->field, h);
    wo_lens_trace(system, 0, flags & WO_TRACE_CLIP ? system->count - 1 : system->stop, flags,
                  f->meridian, &ray);
    return ray;
}

static bool passes(const fan *f, double h, unsigned flags)
{
    return probe(f, h, flags).outcome == WO_RAY_PASSED;
}

/* Where passing begins between a height that does not pass and one that does. */
static double edge(const fan *f, unsigned flags, double out, double in)
{
    for (int i = 0; i < 50; i++) {
        const double middle = (out + in) / 2;
        if (passes(f, middle, flags))
            in = middle;
        else
            out = middle;
    }
    return in;
}

/* The ray through the middle of the iris, of those that cross it the way paraxial rays do the one
   closest to the axis: far out others may get there, near to grazing a surface. */
static bool find_chief_among(const fan *f, int probes, double *chief)
{
    const double mag = f->view->first[f->meridian == WO_MERIDIAN_X ? 0 : 1].ep_mag;
    const double upright = mag > 0 ? 1 : -1;
    double low = 0, high = 0, before = NAN;
    bool found = false;
    for (int i = 0; i < probes; i++) {
        const wo_lens_ray ray = probe(f, place(f, i, probes), 0);
        const double now = ray.outcome == WO_RAY_PASSED ? ray.stop * upright : NAN;
        if (before <= 0 && now > 0 && (!found || fabs(place(f, i, probes)) < fabs(high))) {
            low = place(f, i - 1, probes);
            high = place(f, i, probes);
            found = true;
        }
        before = now;
    }
    for (int i = 0; i < 60 && found; i++) {
        const double middle = (low + high) / 2;
        const wo_lens_ray ray = probe(f, middle, 0);
        if (ray.outcome != WO_RAY_PASSED)
            return false;
        if (ray.stop * upright <= 0)
            low = middle;
        else
            high = middle;
    }
    *chief = (low + high) / 2;
    return found;
}

/* Of a wide dome the rays that reach the iris at all fill a narrow band. */
static bool find_chief(const fan *f, double *chief)
{
    return find_chief_among(f, PROBES, chief) || find_chief_among(f, 20 * PROBES, chief);
}

/* From the chief ray to the last that the iris lets through, upwards or downwards. */
static double rim(const fan *f, double chief, double way)
{
    double in = chief, step = f->reach * 1e-5;
    while (step < f->reach && passes(f, in + way * step, WO_TRACE_IRIS)) {
        in += way * step;
        step *= 1.2;
    }
    return edge(f, WO_TRACE_IRIS, in + way * step, in);
}

/* The part of low to high that passes, from its first to its last place. */
static bool narrow(const fan *f, unsigned flags, double *low, double *high)
{
    const double from = *low, step = (*high - from) / (PROBES - 1);
    int begin = -1, end = -1;
    for (int i = 0; i < PROBES; i++) {
        if (!passes(f, from + step * i, flags))
            continue;
        begin = begin < 0 ? i : begin;
        end = i;
    }
    if (begin < 0)
        return false;
    *low = begin == 0 ? from : edge(f, flags, from + step * (begin - 1), from + step * begin);
    if (end < PROBES - 1)
        *high = edge(f, flags, from + step * (end + 1), from + step * end);
    return true;
}

bool wo_lens_fan(const wo_lens_view *view, wo_meridian meridian, double field, unsigned flags,
                 double *low, double *high, double *chief)
{
    /* Farther out, too, than the first surface is clear. */
    const fan f = {view, meridian, field, 1.5 * reach_of(view, field)};
    const unsigned wanted = flags | WO_TRACE_IRIS;
    if (find_chief(&f, chief)) {
        *low = rim(&f, *chief, -1);
        *high = rim(&f, *chief, 1);
    } else {
        *chief = NAN;
        *low = -f.reach;
        *high = f.reach;
    }
    return (wanted == WO_TRACE_IRIS && !isnan(*chief)) || narrow(&f, wanted, low, high);
}

double wo_lens_chief_height(const wo_lens_view *view, const wo_system *system, wo_meridian meridian,
                            double field)
{
    const fan f = {view, meridian, field, 1.5 * reach_of(view, field)};
    double chief;
    if (!find_chief(&f, &chief))
        return NAN;
    wo_lens_ray ray = wo_lens_aim(view, meridian, field, chief);
    wo_lens_trace(system, 0, system->count - 1, 0, meridian, &ray);
    const int axis = meridian == WO_MERIDIAN_X ? 0 : 1;
    return ray.outcome == WO_RAY_PASSED
               ? ray.p[axis] + (wo_lens_sensor_z(view) - ray.p[2]) * ray.d[axis] / ray.d[2]
               : NAN;
}
