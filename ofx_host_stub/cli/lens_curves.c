/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "lens_curves.h"
#include "lens_view_private.h"

#include <math.h>

#define RADIANS 0.017453292519943295

/* ----------------------------------------------------------------- longitudinal aberration */

static const wo_meridian meridians[2] = {WO_MERIDIAN_Y, WO_MERIDIAN_X};

static void follow_zone(const wo_lens_view *view, const wo_system *system, wo_meridian meridian,
                        double h, double *focus, double *slope)
{
    const int axis = meridian == WO_MERIDIAN_X ? 0 : 1;
    wo_lens_ray ray = wo_lens_aim(view, meridian, 0, h);
    wo_lens_trace(system, 0, system->count - 1, WO_TRACE_CLIP, meridian, &ray);
    *focus = *slope = NAN;
    if (ray.outcome != WO_RAY_PASSED)
        return;
    *slope = ray.d[axis] / ray.d[2];
    *focus = ray.p[2] - ray.p[axis] / *slope - wo_lens_sensor_z(view);
}

/* From the coordinate of the bundle to that of the pupil. */
static double pupil_scale(const wo_lens_view *view)
{
    const double pupil = isfinite(view->first[1].ep_z) ? view->first[1].ep_z : 0;
    const double far = 1000 / view->vf;
    return view->vf > 0 ? far / (far - pupil) : 1;
}

void wo_lens_aberration_make(const wo_lens_view *view, int zones, wo_lens_aberration *out)
{
    *out = (wo_lens_aberration){.zones = zones};
    for (int m = 0; m < 2; m++) {
        double low, high, chief;
        out->has[m] = (m == 0 || view->anamorphic) &&
                      wo_lens_fan(view, meridians[m], 0, WO_TRACE_CLIP, &low, &high, &chief);
        if (!out->has[m])
            continue;
        out->radius[m] = high * pupil_scale(view);
        for (int l = 0; l < WO_LENS_LINES; l++) {
            double *const focus = out->focus[m][l], *const slope = out->slope[m][l];
            focus[0] = wo_system_image(&view->line[l], meridians[m], view->vf) - view->image;
            slope[0] = 0;
            for (int i = 1; i < zones; i++)
                follow_zone(view, &view->line[l], meridians[m], high * i / (zones - 1), &focus[i],
                            &slope[i]);
        }
    }
}

/* -------------------------------------------------------------------- illumination, distortion */

static bool is_dark(const wo_lens_view *view, double field)
{
    wo_lens_span span;
    return !wo_lens_find_span(view, view->across, field, &span);
}

/* At the place where the chief ray lands. */
static void illumination(const wo_lens_view *view, wo_lens_field_curves *out)
{
    const double iris = view->lens.surface[view->lens.stop].semi_aperture;
    const double *const height = out->height[view->across == WO_MERIDIAN_X ? 1 : 0];
    double axis = NAN;
    for (int i = 0; i < WO_LENS_FIELD_STEPS; i++) {
        wo_lens_beam beam;
        if (is_dark(view, out->field[i]))
            beam = (wo_lens_beam){0, 0};
        else if (!wo_lens_beam_make(view, height[i], &beam) && isnan(height[i]))
            beam = (wo_lens_beam){NAN, NAN};
        axis = i == 0 ? beam.light : axis;
        out->lit[i] = beam.iris / (3.14159265358979323846 * iris * iris);
        if (out->lit[i] > 1) /* by rounding */
            out->lit[i] = 1;
        out->illumination[i] = beam.light / axis;
    }
}

/* Against the image height that a small angle's would give at the same scale. */
static void distortion(const wo_lens_view *view, int m, wo_lens_field_curves *out)
{
    const double small = fmin(0.05, view->half_field / 100) * RADIANS;
    const double scale =
        wo_lens_chief_height(view, &view->system, meridians[m], small / RADIANS) / small;
    for (int i = 0; i < WO_LENS_FIELD_STEPS; i++) {
        const double angle = out->field[i] * RADIANS;
        const double ideal = scale * (out->equidistant ? angle : tan(angle));
        out->height[m][i] =
            i == 0 ? 0 : wo_lens_chief_height(view, &view->system, meridians[m], out->field[i]);
        out->distortion[m][i] = i == 0 ? 0 : out->height[m][i] / ideal - 1;
    }
}

void wo_lens_field_curves_make(const wo_lens_view *view, wo_lens_field_curves *out)
{
    *out = (wo_lens_field_curves){.equidistant = view->half_field >= 90,
                                  .has = {true, view->anamorphic}};
    for (int i = 0; i < WO_LENS_FIELD_STEPS; i++)
        out->field[i] = view->half_field * i / (WO_LENS_FIELD_STEPS - 1);
    for (int m = 0; m < 2; m++)
        if (out->has[m])
            distortion(view, m, out);
    illumination(view, out);
}

/* ---------------------------------------------------------------------------- third order */

bool wo_lens_has_seidel(const wo_lens_view *view)
{
    return !view->anamorphic && isfinite(view->first[1].ep_d) && view->half_field < 89;
}

double wo_lens_petzval_radius(const wo_lens_view *view)
{
    const wo_system *const system = &view->system;
    double sum = 0;
    for (int i = 0; i < system->count; i++) {
        const wo_system_surface *const s = &system->surface[i];
        const double c = s->c + (s->terms > 0 ? 2 * s->a[0] : 0);
        if (s->meridian != WO_MERIDIAN_X)
            sum += c * (s->n1 - s->n0) / (s->n0 * s->n1);
    }
    return fabs(sum) < 1e-12 ? INFINITY : -1 / (sum * system->surface[system->count - 1].n1);
}
