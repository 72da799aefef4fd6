/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "lens_panels.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define RADIANS 0.017453292519943295

const wo_pen wo_lens_line_pens[WO_LENS_LINES] = {
    {"#1f4fd8", 1.4, "7 3"}, {"#128a3c", 1.6, NULL}, {"#d0241c", 1.4, "2 2"}};
const char *const wo_lens_line_names[WO_LENS_LINES] = {"F 486 nm", "d 588 nm", "C 656 nm"};
const wo_pen wo_lens_field_pens[WO_LENS_FIELDS] = {
    {"#1f4fd8", 0.9, NULL}, {"#128a3c", 0.9, NULL}, {"#d0241c", 0.9, NULL}};

/* A diagram with the legend in a row of its own. */
static wo_plot begin_with_legend(wo_svg *svg, wo_box box, const char *title, wo_axis x, wo_axis y,
                                 const wo_pen *pens, const char *const *names, int count)
{
    wo_svg_text(svg, box.x + 12, box.y + 18, 13, WO_ANCHOR_START, true, title);
    wo_plot_legend(svg, box.x + box.w - 16, box.y + 37, pens, names, count);
    box.y += 16;
    box.h -= 16;
    return wo_plot_begin(svg, box, NULL, x, y);
}

/* ----------------------------------------------------------------- longitudinal aberration */

enum { ZONES = 101, CURVES = 2 * WO_LENS_LINES };

/* Where the ray of a zone crosses the axis, behind the sensor; NAN when it does not get through. */
static double zone_focus(const wo_lens_view *view, const wo_system *system, wo_meridian meridian,
                         double h)
{
    const int axis = meridian == WO_MERIDIAN_X ? 0 : 1;
    wo_lens_ray ray = wo_lens_aim(view, meridian, 0, h);
    wo_lens_trace(system, 0, system->count - 1, WO_TRACE_CLIP, meridian, &ray);
    if (ray.outcome != WO_RAY_PASSED)
        return NAN;
    return ray.p[2] - ray.p[axis] * ray.d[2] / ray.d[axis] - wo_lens_sensor_z(view);
}

static void aberration_curves(const wo_lens_view *view, double focus[CURVES][ZONES],
                              double rho[ZONES])
{
    static const wo_meridian meridians[] = {WO_MERIDIAN_Y, WO_MERIDIAN_X};
    for (int m = 0; m < 2; m++) {
        double low, high, chief;
        const bool open = (m == 0 || view->anamorphic) &&
                          wo_lens_fan(view, meridians[m], 0, 0, &low, &high, &chief);
        for (int l = 0; l < WO_LENS_LINES; l++)
            for (int i = 0; i < ZONES; i++) {
                rho[i] = (double)i / (ZONES - 1);
                double *const f = &focus[m * WO_LENS_LINES + l][i];
                if (!open)
                    *f = NAN;
                else if (i == 0)
                    *f = wo_system_image(&view->line[l], meridians[m], view->vf) - view->image;
                else
                    *f = zone_focus(view, &view->line[l], meridians[m], high * rho[i]);
            }
    }
}

void wo_panel_aberration(const wo_lens_view *view, wo_svg *svg, wo_box box)
{
    double focus[CURVES][ZONES], rho[ZONES];
    char label[96], number[32];
    aberration_curves(view, focus, rho);
    wo_axis x = {.low = 0, .high = 0, .label = "Focus shift, mm", .ticks = 5};
    wo_axis_cover(&x, focus[0], CURVES * ZONES);
    wo_axis_widen(&x, 1e-4);
    wo_axis_round(&x);
    snprintf(label, sizeof label, "Pupil height (1 = %s mm)",
             wo_plot_number(number, sizeof number, view->first[1].ep_d / 2, 2));
    const wo_axis y = {.low = 0, .high = 1, .label = label, .ticks = 5};
    const wo_plot plot = begin_with_legend(
        svg, box,
        view->anamorphic ? "Longitudinal aberration (thin: in x)" : "Longitudinal aberration", x, y,
        wo_lens_line_pens, wo_lens_line_names, WO_LENS_LINES);
    for (int c = 0; c < CURVES; c++) {
        wo_pen pen = wo_lens_line_pens[c % WO_LENS_LINES];
        if (c >= WO_LENS_LINES)
            pen.width = 0.7;
        wo_plot_curve(&plot, &pen, focus[c], rho, ZONES);
    }
}

/* ------------------------------------------------------------------------------- spots */

typedef struct spot {
    wo_bundle bundle[WO_LENS_LINES]; /* x, y: on the sensor, from the centroid, mm; or NAN */
    double rms, extent;
    int count;
} spot;

static void land(const wo_lens_view *view, wo_bundle *bundle, double sum[2], int *count)
{
    const double sensor = wo_lens_sensor_z(view);
    const wo_rays *const r = &bundle->rays;
    for (int i = 0; i < bundle->count; i++) {
        const double t = (sensor - r->z[i]) / r->dz[i];
        const bool passed = r->outcome[i] == WO_RAY_PASSED;
        r->x[i] = passed ? r->x[i] + t * r->dx[i] : NAN;
        r->y[i] = passed ? r->y[i] + t * r->dy[i] : NAN;
        if (passed) {
            sum[0] += r->x[i];
            sum[1] += r->y[i];
            *count += 1;
        }
    }
}

static void centre(spot *s, const double sum[2])
{
    double squares = 0;
    for (int l = 0; l < WO_LENS_LINES; l++)
        for (int i = 0; i < s->bundle[l].count; i++) {
            double *const x = &s->bundle[l].rays.x[i], *const y = &s->bundle[l].rays.y[i];
            if (isnan(*x))
                continue;
            *x -= sum[0] / s->count;
            *y -= sum[1] / s->count;
            squares += *x * *x + *y * *y;
            s->extent = fmax(s->extent, fmax(fabs(*x), fabs(*y)));
        }
    s->rms = s->count ? sqrt(squares / s->count) : NAN;
}

static void spot_make(const wo_lens_view *view, double field, spot *s)
{
    double sum[2] = {0, 0};
    *s = (spot){.rms = NAN};
    for (int l = 0; l < WO_LENS_LINES; l++) {
        if (!wo_bundle_fill(view, view->across, field, WO_LATTICE_GRID, 900, &s->bundle[l]))
            continue;
        wo_bundle_trace(view, &view->line[l], view->across, field, WO_TRACE_CLIP | WO_TRACE_IRIS,
                        &s->bundle[l]);
        land(view, &s->bundle[l], sum, &s->count);
    }
    centre(s, sum);
}

/* The longest of 1, 2 or 5 times a power of ten micrometres up to limit mm. */
static double bar_length(double limit)
{
    const double um = fmax(limit * 1000, 1e-6), ten = pow(10, floor(log10(um)));
    return (um >= 5 * ten ? 5 : um >= 2 * ten ? 2 : 1) * ten;
}

static void draw_spot(wo_svg *svg, const spot *s, double cx, double cy, double scale)
{
    for (int l = 0; l < WO_LENS_LINES; l++) {
        const wo_bundle *const b = &s->bundle[l];
        for (int i = 0; i < b->count; i++) {
            b->px[i] = cx + b->rays.x[i] * scale;
            b->py[i] = cy - b->rays.y[i] * scale;
        }
        wo_svg_dots(svg, wo_lens_line_pens[l].colour, 1.2, b->px, b->py, b->count);
    }
}

static void label_spot(const wo_lens_view *view, wo_svg *svg, const spot *s, int f, double cx,
                       double y)
{
    char text[96], a[32], b[32];
    snprintf(text, sizeof text, "%s\xC2\xB0",
             wo_plot_number(a, sizeof a, wo_lens_fields[f] * view->half_field, 1));
    wo_svg_text(svg, cx, y, 12, WO_ANCHOR_MIDDLE, true, text);
    snprintf(text, sizeof text, "RMS %s \xC2\xB5m", wo_plot_number(b, sizeof b, s->rms * 1000, 1));
    wo_svg_text(svg, cx, y + 15, 11, WO_ANCHOR_MIDDLE, false,
                s->count ? text : "no light gets through");
}

void wo_panel_spots(const wo_lens_view *view, wo_svg *svg, wo_box box)
{
    spot spots[WO_LENS_FIELDS];
    double extent = 1e-5;
    for (int f = 0; f < WO_LENS_FIELDS; f++) {
        spot_make(view, wo_lens_fields[f] * view->half_field, &spots[f]);
        extent = fmax(extent, spots[f].extent);
    }
    const wo_axis none = {.low = 0, .high = 1};
    begin_with_legend(svg, box,
                      view->across == WO_MERIDIAN_X ? "Spot diagrams over the field in x"
                                                    : "Spot diagrams over the field",
                      none, none, wo_lens_line_pens, wo_lens_line_names, WO_LENS_LINES);
    const double cell = (box.w - 28) / WO_LENS_FIELDS, top = box.y + 52, foot = 66;
    const double height = box.h - 52 - foot - 12;
    const double scale = fmin(cell, height) * 0.46 / extent;
    for (int f = 0; f < WO_LENS_FIELDS; f++) {
        const double cx = box.x + 12 + cell * (f + 0.5);
        draw_spot(svg, &spots[f], cx, top + height / 2, scale);
        label_spot(view, svg, &spots[f], f, cx, top + height + 16);
        for (int l = 0; l < WO_LENS_LINES; l++)
            wo_bundle_free(&spots[f].bundle[l]);
    }
    const double um = bar_length(cell * 0.6 / scale), pixels = um / 1000 * scale;
    const double x = box.x + box.w / 2 - pixels / 2, y = box.y + box.h - 24;
    char text[64], number[32];
    const wo_pen pen = {"#202020", 1.5, NULL};
    wo_svg_line(svg, &pen, x, y, x + pixels, y);
    wo_svg_line(svg, &pen, x, y - 4, x, y + 4);
    wo_svg_line(svg, &pen, x + pixels, y - 4, x + pixels, y + 4);
    snprintf(text, sizeof text, "%s \xC2\xB5m",
             wo_plot_number(number, sizeof number, um, um < 1 ? 3 : 0));
    wo_svg_text(svg, x + pixels + 8, y + 4, 11, WO_ANCHOR_START, false, text);
}

/* ------------------------------------------------------------------ illumination, distortion */

enum { FIELDS = 25 };

static double passed_area(const wo_lens_view *view, double field)
{
    wo_bundle b;
    if (!wo_bundle_fill(view, view->across, field, WO_LATTICE_GRID, 16384, &b))
        return 0;
    int passed = 0;
    wo_bundle_trace(view, &view->system, view->across, field, WO_TRACE_CLIP | WO_TRACE_IRIS, &b);
    for (int i = 0; i < b.count; i++)
        passed += b.rays.outcome[i] == WO_RAY_PASSED;
    const double area = passed * b.area;
    wo_bundle_free(&b);
    return area;
}

void wo_panel_illumination(const wo_lens_view *view, wo_svg *svg, wo_box box)
{
    static const wo_pen pens[2] = {{"#404040", 1.2, "6 3"}, {"#c05a00", 1.6, NULL}};
    static const char *const names[2] = {"clear apertures", "and cos\xE2\x81\xB4"};
    double field[FIELDS], light[2][FIELDS];
    double full = 0;
    for (int i = 0; i < FIELDS; i++) {
        field[i] = view->half_field * i / (FIELDS - 1);
        const double area = passed_area(view, field[i]);
        full = i == 0 ? area : full;
        light[0][i] = 100 * area / full;
        light[1][i] = light[0][i] * pow(cos(field[i] * RADIANS), 4);
    }
    const wo_axis x = {.low = 0, .high = view->half_field, .label = "Field, \xC2\xB0", .ticks = 5};
    wo_axis y = {.low = 0, .high = 100, .label = "Relative illumination, %", .ticks = 5};
    wo_axis_cover(&y, light[0], FIELDS);
    y.high = y.high > 100.5 ? y.high * 1.02 : 100;
    const wo_plot plot = begin_with_legend(
        svg, box, view->across == WO_MERIDIAN_X ? "Vignetting in x" : "Vignetting", x, y, pens,
        names, 2);
    for (int c = 0; c < 2; c++)
        wo_plot_curve(&plot, &pens[c], field, light[c], FIELDS);
}

/* Against the image height that a small angle's would give at the same scale. */
static void distortion_curve(const wo_lens_view *view, wo_meridian meridian, const double *field,
                             double *percent)
{
    const double small = fmin(0.05, view->half_field / 100);
    const double scale =
        wo_lens_chief_height(view, &view->system, meridian, small) / tan(small * RADIANS);
    for (int i = 0; i < FIELDS; i++) {
        const double h = wo_lens_chief_height(view, &view->system, meridian, field[i]);
        percent[i] = i == 0 ? 0 : 100 * (h / (scale * tan(field[i] * RADIANS)) - 1);
    }
}

void wo_panel_distortion(const wo_lens_view *view, wo_svg *svg, wo_box box)
{
    static const wo_pen pens[2] = {{"#5a2ca0", 1.6, NULL}, {"#a0602c", 1.4, "6 3"}};
    static const char *const names[2] = {"in y", "in x"};
    double field[FIELDS], percent[2][FIELDS];
    const int curves = view->anamorphic ? 2 : 1;
    for (int i = 0; i < FIELDS; i++)
        field[i] = view->half_field * i / (FIELDS - 1);
    distortion_curve(view, WO_MERIDIAN_Y, field, percent[0]);
    if (curves == 2)
        distortion_curve(view, WO_MERIDIAN_X, field, percent[1]);
    wo_axis x = {.low = 0, .high = 0, .label = "Distortion, %", .ticks = 4};
    wo_axis_cover(&x, percent[0], curves * FIELDS);
    wo_axis_widen(&x, 0.02);
    wo_axis_round(&x);
    const wo_axis y = {.low = 0, .high = view->half_field, .label = "Field, \xC2\xB0", .ticks = 5};
    const wo_plot plot =
        begin_with_legend(svg, box, "Distortion", x, y, pens, names, curves == 2 ? 2 : 0);
    for (int c = 0; c < curves; c++)
        wo_plot_curve(&plot, &pens[c], percent[c], field, FIELDS);
}
