/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/lens_choice.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define DESIGN_KEY(key, name)  key,
#define DESIGN_NAME(key, name) name,
const char *const wo_lens_names[] = {WO_LENS_DESIGN_LIST(DESIGN_KEY) NULL};
static const char *const designs[] = {WO_LENS_DESIGN_LIST(DESIGN_NAME)};
_Static_assert(WO_COUNT(designs) == WO_LENS_DESIGNS, "as many rows as designs");

const char *wo_lens_design(int place)
{
    return place >= 0 && place < WO_LENS_DESIGNS ? designs[place] : NULL;
}

static bool zonal_ray(const void *self, double h, const double u[2], double nm, wo_model_ray *ray)
{
    const wo_zonal_lens *lens = self;
    const double shift = wo_diagram_at(&lens->diagram, hypot(u[0], u[1]), nm);
    for (int k = 0; k < 2; k++) {
        ray->b[k] = lens->radius * u[k];
        ray->a[k] = -ray->b[k] * shift;
    }
    ray->weight = 1;
    const double beside = u[0] - lens->cats_eye * h;
    ray->clip[0] = beside * beside + u[1] * u[1];
    return true;
}

wo_lens_model wo_zonal_lens_model(const wo_zonal_lens *lens)
{
    return (wo_lens_model){.self = lens,
                           .clips = lens->cats_eye != 0,
                           .field_max = lens->half_field,
                           .reference_nm = WO_NM_D,
                           .ray = zonal_ray};
}

/* Welford 1986, 6.5: transverse aberrations of third order. Distortion is left out: the field point
   is where the chief ray says. An object at tangent h of the picture sends its light with the slope
   -h. */
static bool seidel_ray(const void *self, double h, const double u[2], double nm, wo_model_ray *ray)
{
    const wo_seidel_lens *lens = self;
    const double *s = lens->sums.s;
    const double f = -h / lens->tangent;
    const double r2 = u[0] * u[0] + u[1] * u[1];
    const double along = s[0] * r2 * u[0] + s[1] * f * (3 * u[0] * u[0] + u[1] * u[1]) +
                         (3 * s[2] + s[3]) * f * f * u[0];
    const double across =
        s[0] * r2 * u[1] + s[1] * f * 2 * u[0] * u[1] + (s[2] + s[3]) * f * f * u[1];
    double shift = 0;
    double nearest = INFINITY;
    for (int i = 0; i < lens->lines; i++) {
        if (fabs(lens->nm[i] - nm) < nearest) {
            nearest = fabs(lens->nm[i] - nm);
            shift = lens->shift[i];
        }
    }
    ray->b[0] = lens->radius * u[0];
    ray->b[1] = lens->radius * u[1];
    ray->a[0] = along * lens->scale - ray->b[0] * shift;
    ray->a[1] = across * lens->scale - ray->b[1] * shift;
    ray->weight = 1;
    return true;
}

wo_lens_model wo_seidel_lens_model(const wo_seidel_lens *lens)
{
    return (wo_lens_model){
        .self = lens, .field_max = lens->half_field, .reference_nm = WO_NM_D, .ray = seidel_ray};
}

static wo_first_order order_at(const wo_prescription *lens, double nm)
{
    wo_system system;
    wo_first_order order;
    wo_system_make(lens, nm, &system);
    wo_system_first_order(&system, WO_MERIDIAN_X, &order);
    return order;
}

static wo_status check_lens(const wo_prescription *lens, wo_first_order *order, wo_error *error)
{
    WO_TRY(wo_lens_model_check(lens, error));
    *order = order_at(lens, WO_NM_D);
    if (!(order->efl > 0) || !isfinite(order->efl) || !isfinite(order->ep_z) || !(order->fno > 0))
        return wo_fail(
            error, WO_ERR_UNSUPPORTED,
            "%s cannot be put behind a picture: focal length %g mm, entrance pupil at %g "
            "mm",
            lens->name, order->efl, order->ep_z);
    return WO_OK;
}

wo_status wo_seidel_lens_make(const wo_prescription *lens, double f_number, double half_field,
                              const double *nm, int lines, wo_seidel_lens *out, wo_error *error)
{
    wo_first_order order;
    WO_TRY(check_lens(lens, &order, error));
    if (lines < 1 || lines > WO_LINES_MAX)
        return wo_fail(error, WO_ERR_RANGE, "%d wavelengths: must be 1..%d", lines, WO_LINES_MAX);
    const double n = fmax(f_number, order.fno);
    const double ep_d = order.efl / n;
    wo_system system;
    wo_system_make(lens, WO_NM_D, &system);
    *out = (wo_seidel_lens){
        .radius = 0.5e-3 * ep_d, .half_field = half_field, .tangent = tan(0.2), .lines = lines};
    wo_system_seidel(&system, ep_d, 0.2 * (180 / 3.14159265358979323846), &out->sums);
    /* n' u' = -ep_d / (2 efl); the error on the sensor over efl is the tangent in front. */
    out->scale = -1 / ep_d;
    for (int i = 0; i < lines; i++) {
        out->nm[i] = nm[i];
        /* Where the image of infinity lies behind that of the d line, seen from the scene. */
        out->shift[i] = -1e3 * (order_at(lens, nm[i]).bfd - order.bfd) / (order.efl * order.efl);
    }
    return WO_OK;
}

wo_status wo_singlet(const wo_glass *glass, double focal_mm, double f_number, double bending,
                     double thickness_mm, wo_prescription *lens, wo_error *error)
{
    const double n = wo_glass_index(glass, WO_NM_D, NULL);
    if (!(focal_mm > 0 && f_number > 0 && n > 1) || !(fabs(bending) <= 10) || !(thickness_mm >= 0))
        return wo_fail(
            error, WO_ERR_RANGE,
            "a singlet of %g mm, f/%g, bending %g, %g mm thick: focal length and f-number "
            "above 0, bending -10..10, thickness 0 or more",
            focal_mm, f_number, bending, thickness_mm);
    /* Lens maker: 1/f = (n - 1) (k + (n - 1) t a b k^2 / n), curvatures a k and b k, a - b = 1. */
    const double a = 0.5 * (bending + 1);
    const double b = 0.5 * (bending - 1);
    const double q = (n - 1) * thickness_mm * a * b / n;
    const double p = 1 / (focal_mm * (n - 1));
    const double root = 1 + 4 * q * p;
    if (!(root > 0))
        return wo_fail(error, WO_ERR_RANGE,
                       "no singlet of %g mm is %g mm thick with bending %g: make it thinner",
                       focal_mm, thickness_mm, bending);
    const double k = 2 * p / (1 + sqrt(root));
    memset(lens, 0, sizeof *lens);
    snprintf(lens->name, sizeof lens->name, "singlet");
    lens->count = 2;
    lens->focal_mm = focal_mm;
    lens->f_number = f_number;
    const double semi = 0.5 * focal_mm / f_number;
    lens->surface[0] = (wo_surface){.curvature = a * k,
                                    .thickness = thickness_mm,
                                    .semi_aperture = semi,
                                    .glass = *glass,
                                    .stop = true};
    lens->surface[1] =
        (wo_surface){.curvature = b * k, .thickness = focal_mm, .glass = wo_glass_air()};
    return wo_prescription_validate(lens, error);
}

static wo_status make_singlet(const wo_lens_choice *c, wo_prescription *lens, wo_error *error)
{
#define WO_GLASS_NAME(key, label, name) name,
    static const char *const names[] = {WO_LENS_GLASS_LIST(WO_GLASS_NAME)};
#undef WO_GLASS_NAME
    const wo_glass *glass =
        c->glass >= 0 && c->glass < (int)WO_COUNT(names) ? wo_glass_find(names[c->glass]) : NULL;
    if (!glass)
        return wo_fail(error, WO_ERR_RANGE, "there is no glass number %d", c->glass);
    return wo_singlet(glass, c->focal_mm, c->f_number, c->bending, c->thickness_mm, lens, error);
}

static wo_status make_design(const wo_lens_choice *c, wo_prescription *lens, wo_error *error)
{
    wo_first_order order;
    WO_TRY(wo_lens_find(c->design, lens, error));
    WO_TRY(check_lens(lens, &order, error));
    wo_prescription_scale(lens, c->focal_mm / order.efl);
    return WO_OK;
}

/* The same shift for all zones: how much stronger the lens is than at the d line. */
static void flat_diagram(const wo_prescription *lens, const double *nm, int lines, wo_diagram *out)
{
    const double power = 1e3 / order_at(lens, WO_NM_D).efl;
    *out = (wo_diagram){.zones = 2, .lines = lines};
    for (int i = 0; i < lines; i++) {
        out->nm[i] = nm[i];
        out->shift[i][0] = out->shift[i][1] = 1e3 / order_at(lens, nm[i]).efl - power;
    }
}

static wo_status choose(const wo_lens_choice *c, wo_prescription *lens, wo_chosen_lens *out,
                        wo_error *error)
{
    const wo_zonal_lens zonal = {.radius = 0.5e-3 * c->focal_mm / c->f_number,
                                 .half_field = c->half_field,
                                 .cats_eye = c->half_field > 0 ? c->cats_eye / c->half_field : 0};
    out->f_number = c->f_number;
    switch (c->kind) {
    case WO_LENS_THIN:
        if (!(c->f_number > 0))
            return wo_fail(error, WO_ERR_RANGE, "a thin lens at f/%g: must be above 0",
                           c->f_number);
        out->as.zonal = zonal;
        out->as.zonal.diagram = (wo_diagram){.zones = 2, .lines = 1, .nm = {WO_NM_D}};
        out->model = wo_zonal_lens_model(&out->as.zonal);
        return WO_OK;
    case WO_LENS_THICK:
        WO_TRY(make_singlet(c, lens, error));
        out->as.zonal = zonal;
        flat_diagram(lens, c->nm, c->lines, &out->as.zonal.diagram);
        out->model = wo_zonal_lens_model(&out->as.zonal);
        return WO_OK;
    case WO_LENS_DIAGRAM:
        out->as.zonal = zonal;
        WO_TRY(wo_diagram_make(c->diagram, c->focal_mm, c->f_number, c->residual,
                               &out->as.zonal.diagram, error));
        out->model = wo_zonal_lens_model(&out->as.zonal);
        return WO_OK;
    case WO_LENS_SEIDEL:
        WO_TRY(make_design(c, lens, error));
        WO_TRY(wo_seidel_lens_make(lens, c->f_number, c->half_field, c->nm, c->lines,
                                   &out->as.seidel, error));
        out->f_number = 0.5e-3 * c->focal_mm / out->as.seidel.radius;
        out->model = wo_seidel_lens_model(&out->as.seidel);
        return WO_OK;
    case WO_LENS_SINGLET:
    case WO_LENS_PRESCRIPTION:
        WO_TRY(c->kind == WO_LENS_SINGLET ? make_singlet(c, lens, error)
                                          : make_design(c, lens, error));
        WO_TRY(wo_exact_lens_make(lens, c->f_number, c->vf, c->half_field, c->nm, c->lines,
                                  &out->as.exact, error));
        out->f_number = out->as.exact.f_number;
        out->model = wo_exact_lens_model(&out->as.exact);
        return WO_OK;
    case WO_LENS_KIND_COUNT:
        break;
    }
    return wo_fail(error, WO_ERR_ARGUMENT, "lens kind %d has no model", (int)c->kind);
}

wo_status wo_lens_choose(const wo_lens_choice *choice, wo_chosen_lens *out, wo_error *error)
{
    wo_prescription lens; /* some 20 kB; nothing keeps it */
    if (!(choice->focal_mm > 0 && isfinite(choice->focal_mm)) || isinf(choice->f_number))
        return wo_fail(error, WO_ERR_RANGE,
                       "a lens of %g mm at f/%g: must be a focal length above 0 and a finite "
                       "f-number",
                       choice->focal_mm, choice->f_number);
    WO_TRY(choose(choice, &lens, out, error));
    if (choice->best_focus)
        out->model.refocus = wo_lens_model_best_focus(&out->model);
    return WO_OK;
}
