/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "lens_panels.h"

#include <math.h>
#include <stdio.h>

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
        if (!wo_bundle_fill(view, view->across, field, 1400, &s->bundle[l]))
            continue;
        wo_bundle_scatter(&s->bundle[l], view->across, l); /* no line's dots on another's */
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

double wo_lens_spot_rms(const wo_lens_view *view, double field)
{
    spot s;
    spot_make(view, field, &s);
    for (int l = 0; l < WO_LENS_LINES; l++)
        wo_bundle_free(&s.bundle[l]);
    return s.rms;
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
    wo_panel_begin(svg, box,
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
