/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/lens_diagram.h"
#include "wideopen/lens_trace.h"

#include <math.h>

/* The point of the sensor on the axis, and the lens it looks out through. */
typedef struct view {
    const wo_system *system;
    double sensor_z, pupil_z;
} view;

/* A ray leaves the sensor at this slope: where it passes the plane of the entrance pupil and how
   steeply it goes on, both in front of the lens. false: it does not come out. */
static bool look_out(const view *v, double slope, unsigned flags, double *height, double *leaving)
{
    const double c = 1 / sqrt(1 + slope * slope);
    double x = 0, y = 0, z = v->sensor_z;
    double dx = 0, dy = slope * c, dz = -c;
    uint8_t outcome = WO_RAY_MISSED;
    const wo_rays ray = {&x, &y, &z, &dx, &dy, &dz, NULL, &outcome};
    wo_system_trace(v->system, 0, v->system->count - 1, true, flags, &ray, 1, NULL, NULL);
    *leaving = dy / dz;
    *height = y + (v->pupil_z - z) * *leaving;
    return outcome == WO_RAY_PASSED && isfinite(*height);
}

/* Height in the plane of the entrance pupil of the last ray that comes out. slope: of a paraxial
   ray of height 1; radius: what to expect. */
static double edge_of(const view *v, double slope, double radius, unsigned flags)
{
    enum { STEPS = 64 };
    double height = 0, leaving;
    double in = 0, out = 0, edge = 0;
    for (int i = 1; i <= 2 * STEPS && out == 0; i++) {
        const double next = slope * radius * i / STEPS;
        if (look_out(v, next, flags, &height, &leaving) && fabs(height) > edge) {
            in = next;
            edge = fabs(height);
        } else
            out = next;
    }
    for (int i = 0; i < 60 && out != 0; i++) {
        const double middle = (in + out) / 2;
        if (look_out(v, middle, flags, &height, &leaving) && fabs(height) >= edge) {
            in = middle;
            edge = fabs(height);
        } else
            out = middle;
    }
    return edge;
}

/* Vergence in dioptres, from the entrance pupil, of the axial point that the zone of this height
   sees sharp. Secant steps from below, a slope of a lower zone, and a guess. */
static bool zone_focus(const view *v, double height, double below, double *slope, double *vergence)
{
    double a = below;
    double b = *slope;
    double ya, yb, leaving;
    if (!look_out(v, a, 0, &ya, &leaving))
        return false;
    for (int k = 0; k < 40 && !look_out(v, b, 0, &yb, &leaving); k++)
        b = 0.5 * (a + b);
    if (!look_out(v, b, 0, &yb, &leaving))
        return false;
    for (int i = 0; i < 60 && fabs(yb - height) > 1e-11 * height && yb != ya; i++) {
        double next = b - (yb - height) * (b - a) / (yb - ya);
        a = b;
        ya = yb;
        for (int k = 0; k < 40 && !look_out(v, next, 0, &yb, &leaving); k++)
            next = 0.5 * (a + next);
        b = next;
        if (!look_out(v, b, 0, &yb, &leaving))
            return false;
    }
    *slope = b;
    *vergence = leaving / yb * 1e3;
    return fabs(yb - height) <= 1e-6 * height && isfinite(*vergence);
}

static wo_status trace_line(const view *v, double radius, double paraxial_slope, double vf,
                            int zones, double *shift, wo_error *error)
{
    double slope = paraxial_slope * radius * 1e-3;
    double before = radius * 1e-3;
    for (int i = 0; i < zones; i++) {
        /* Close to the axis in place of on it, where height and slope vanish together. */
        const double height = i > 0 ? radius * i / (zones - 1) : radius * 1e-3;
        double vergence;
        const double below = i > 0 ? slope : 0.99 * slope;
        slope *= height / before;
        if (!zone_focus(v, height, below, &slope, &vergence))
            return wo_fail(error, WO_ERR_RANGE,
                           "no light of %g nm passes the zone at %.3g of the aperture: stop the "
                           "lens down",
                           v->system->nm, (double)i / (zones - 1));
        before = height;
        shift[i] = vergence - vf;
    }
    return WO_OK;
}

wo_status wo_diagram_of_lens(const wo_prescription *lens, double f_number, double vf,
                             const double *nm, int lines, wo_diagram *diagram, wo_error *error)
{
    *diagram = (wo_diagram){0};
    WO_TRY(wo_prescription_validate(lens, error));
    if (!(f_number == 0 || (f_number >= 0.1 && f_number <= 1e4)))
        return wo_fail(error, WO_ERR_RANGE, "f-number %g: must be 0 (open) or 0.1..1e4", f_number);
    if (!(fabs(vf) <= WO_DIAGRAM_SHIFT_MAX))
        return wo_fail(error, WO_ERR_RANGE, "focus at %g dioptres: must be within %g", vf,
                       WO_DIAGRAM_SHIFT_MAX);
    if (lines < 1 || lines > WO_DIAGRAM_LINES)
        return wo_fail(error, WO_ERR_RANGE, "%d wavelengths: must be 1..%d", lines,
                       WO_DIAGRAM_LINES);
    wo_system system;
    wo_first_order first;
    wo_system_make(lens, WO_NM_D, &system);
    wo_system_first_order(&system, WO_MERIDIAN_Y, &first);
    const double image = wo_system_image(&system, WO_MERIDIAN_Y, vf);
    if (!isfinite(first.efl) || !isfinite(first.ep_z) || !isfinite(image))
        return wo_fail(error, WO_ERR_UNSUPPORTED,
                       "the lens %s has no focal length, entrance pupil or image at finite places",
                       lens->name);
    double paraxial = first.ep_d / 2;
    if (f_number > 0)
        paraxial = fmin(paraxial, fabs(first.efl) / (2 * f_number));
    if (!(paraxial > 0 && isfinite(paraxial)))
        return wo_fail(error, WO_ERR_RANGE,
                       "the iris of the lens %s is unlimited: give an f-number", lens->name);
    const double iris = paraxial / fabs(first.ep_mag);
    system.surface[system.stop].semi2 = iris * iris;
    diagram->zones = WO_DIAGRAM_ZONES;
    diagram->lines = lines;
    view v = {&system, system.z_last + image, first.ep_z};
    /* Slope at the sensor of a ray of height 1 in the entrance pupil, from one close to the axis.
     */
    double height, leaving;
    const double tiny = 1e-6;
    if (!look_out(&v, tiny, 0, &height, &leaving) || height == 0)
        return wo_fail(error, WO_ERR_UNSUPPORTED, "the lens %s passes no light along its axis",
                       lens->name);
    const double slope = tiny / height;
    double radius = edge_of(&v, slope, paraxial, WO_TRACE_CLIP | WO_TRACE_IRIS);
    for (int l = 0; l < lines; l++) {
        wo_system_make(lens, nm[l], &system);
        radius = fmin(radius, edge_of(&v, slope, radius, 0));
    }
    if (!(radius > 0))
        return wo_fail(error, WO_ERR_UNSUPPORTED, "the lens %s passes no light beside its axis",
                       lens->name);
    diagram->radius = radius;
    for (int l = 0; l < lines; l++) {
        diagram->nm[l] = nm[l];
        wo_system_make(lens, nm[l], &system);
        WO_TRY(trace_line(&v, radius, slope, vf, diagram->zones, diagram->shift[l], error));
    }
    return wo_diagram_validate(diagram, error);
}
