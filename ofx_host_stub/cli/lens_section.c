/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "lens_panels.h"

#include <math.h>
#include <stdio.h>

enum { ARC = 41, FAN = 7, PATH = WO_SURFACES_MAX + 3 };

/* One meridian of the lens at one scale. */
typedef struct section {
    const wo_lens_view *view;
    wo_svg *svg;
    wo_meridian meridian;
    double z0, scale; /* page x of z = 0; px per mm */
    double axis;      /* page y of the axis */
    wo_box box;
} section;

static double at_z(const section *s, double z)
{
    return s->z0 + z * s->scale;
}

static double at_h(const section *s, double h)
{
    return s->axis - h * s->scale;
}

/* Clear radius as drawn: of unlimited surfaces, that of the widest other one; never beyond where
   the surface ends. */
static double drawn_semi(const wo_lens_view *view, wo_meridian meridian, int i)
{
    const wo_surface *const surface = &view->lens.surface[i];
    double semi = surface->stop ? view->open_semi : surface->semi_aperture;
    const bool limited = semi > 0;
    for (int k = 0; !limited && k < view->lens.count; k++)
        semi = fmax(semi, view->lens.surface[k].semi_aperture);
    if (semi <= 0)
        semi = isfinite(view->first[1].ep_d) ? fmax(view->first[1].ep_d, 1) : 10;
    for (int k = 0; k < 200 && isnan(wo_lens_sag(surface, meridian, semi)); k++)
        semi *= 0.98;
    return semi;
}

static int arc(const section *s, int i, double semi, bool downwards, double *x, double *y)
{
    for (int k = 0; k < ARC; k++) {
        const double h = semi * (2.0 * k / (ARC - 1) - 1) * (downwards ? -1 : 1);
        const double sag = wo_lens_sag(&s->view->lens.surface[i], s->meridian, h);
        x[k] = at_z(s, s->view->system.surface[i].z + sag);
        y[k] = at_h(s, h);
    }
    return ARC;
}

static bool is_glass(const wo_surface *surface)
{
    return surface->glass.nd > 1.01;
}

/* The element between surface i and the next; denser glass is darker. */
static void draw_element(const section *s, int i)
{
    static const char *const fills[] = {"#e6f0fa", "#d3e4f5", "#bdd5ee"};
    static const wo_pen pen = {"#3a4a5c", 1, NULL};
    const wo_lens_view *const view = s->view;
    const double nd = view->lens.surface[i].glass.nd;
    const double front = drawn_semi(view, s->meridian, i);
    const double back = drawn_semi(view, s->meridian, i + 1), edge = fmax(front, back);
    double x[2 * ARC + 2], y[2 * ARC + 2];
    int n = arc(s, i, front, false, x, y);
    const double front_x = x[n - 1], front_low = x[0];
    double back_x[ARC], back_y[ARC];
    arc(s, i + 1, back, true, back_x, back_y);
    x[n] = front >= back ? back_x[0] : front_x;
    y[n++] = at_h(s, edge);
    for (int k = 0; k < ARC; k++, n++) {
        x[n] = back_x[k];
        y[n] = back_y[k];
    }
    x[n] = front >= back ? back_x[ARC - 1] : front_low;
    y[n++] = at_h(s, -edge);
    wo_svg_path(s->svg, &pen, fills[nd > 1.7 ? 2 : nd > 1.58 ? 1 : 0], x, y, n);
}

static void draw_glass(const section *s)
{
    static const wo_pen pen = {"#3a4a5c", 1, NULL};
    const wo_prescription *const lens = &s->view->lens;
    for (int i = 0; i + 1 < lens->count; i++)
        if (is_glass(&lens->surface[i]))
            draw_element(s, i);
    for (int i = 0; i < lens->count; i++) {
        const bool drawn =
            is_glass(&lens->surface[i]) || (i > 0 && is_glass(&lens->surface[i - 1]));
        if (drawn && i + 1 < lens->count)
            continue;
        double x[ARC], y[ARC];
        if (!lens->surface[i].stop)
            wo_svg_path(s->svg, &pen, NULL, x, y,
                        arc(s, i, drawn_semi(s->view, s->meridian, i), false, x, y));
    }
}

static double tallest(const section *s)
{
    double h = 0;
    for (int i = 0; i < s->view->lens.count; i++)
        h = fmax(h, drawn_semi(s->view, s->meridian, i));
    return h;
}

static void draw_iris(const section *s)
{
    static const wo_pen blade = {"#101010", 2.2, NULL};
    const int i = s->view->lens.stop;
    const wo_surface *const stop = &s->view->lens.surface[i];
    const double wide = drawn_semi(s->view, s->meridian, i);
    const double semi = stop->semi_aperture > 0 ? stop->semi_aperture : wide;
    const double sag = wo_lens_sag(stop, s->meridian, semi), out = wide + 0.22 * tallest(s);
    const double x = at_z(s, s->view->system.surface[i].z + (isnan(sag) ? 0 : sag));
    for (int side = -1; side <= 1; side += 2) {
        wo_svg_line(s->svg, &blade, x, at_h(s, side * semi), x, at_h(s, side * out));
        wo_svg_line(s->svg, &blade, x - 4, at_h(s, side * semi), x + 4, at_h(s, side * semi));
    }
}

/* Follows one ray surface by surface to end_z; gives the points and whether it got through. */
static bool follow(const section *s, double field, double h, double end_z, double *x, double *y,
                   int *count)
{
    const wo_system *const system = &s->view->system;
    const int axis = s->meridian == WO_MERIDIAN_X ? 0 : 1;
    wo_lens_ray ray = wo_lens_aim(s->view, s->meridian, field, h);
    int n = 0;
    bool passed = true;
    x[n] = at_z(s, ray.p[2]);
    y[n++] = at_h(s, ray.p[axis]);
    for (int i = 0; i < system->count && passed; i++) {
        wo_lens_trace(system, i, i, WO_TRACE_CLIP | WO_TRACE_IRIS, s->meridian, &ray);
        passed = ray.outcome == WO_RAY_PASSED;
        if (ray.outcome == WO_RAY_MISSED)
            break;
        x[n] = at_z(s, ray.p[2]);
        y[n++] = at_h(s, ray.p[axis]);
    }
    if (passed) {
        x[n] = at_z(s, end_z);
        y[n++] = at_h(s, ray.p[axis] + (end_z - ray.p[2]) * ray.d[axis] / ray.d[2]);
    }
    *count = n;
    return passed;
}

/* A fan of one field. What is stopped on its way is pale and ends there. */
static void draw_fan(const section *s, int f, unsigned flags, bool stopped, double end_z)
{
    static const wo_pen pale = {"#a4a4a4", 0.7, NULL};
    const double field = wo_lens_fields[f] * s->view->half_field;
    double low, high, chief;
    if (!wo_lens_fan(s->view, s->meridian, field, flags, &low, &high, &chief))
        return;
    if (stopped && f == 0) { /* the whole entrance pupil: some of it may never see the iris */
        const double pupil = s->view->first[s->meridian == WO_MERIDIAN_X ? 0 : 1].ep_d / 2;
        const double semi = fmin(pupil, drawn_semi(s->view, s->meridian, 0));
        low = fmin(low, -semi);
        high = fmax(high, semi);
    }
    const double inset = (high - low) * 1e-5, step = (high - low - 2 * inset) / (FAN - 1);
    for (int i = 0; i < FAN; i++) {
        double x[PATH], y[PATH];
        int count;
        const bool passed = follow(s, field, low + inset + step * i, end_z, x, y, &count);
        if (passed != stopped)
            wo_svg_path(s->svg, passed ? &wo_lens_field_pens[f] : &pale, NULL, x, y, count);
    }
}

/* Of the rays that would fill the iris those that do not get through, then what does. */
static void draw_rays(const section *s, double end_z)
{
    for (int f = 0; f < WO_LENS_FIELDS; f++)
        draw_fan(s, f, 0, true, end_z);
    for (int f = 0; f < WO_LENS_FIELDS; f++)
        draw_fan(s, f, WO_TRACE_CLIP, false, end_z);
}

static void mark(const section *s, double z, double above, const char *name)
{
    static const wo_pen pen = {"#202020", 1.2, NULL};
    const double x = at_z(s, z);
    if (!isfinite(z) || x < s->box.x + 8 || x > s->box.x + s->box.w - 8)
        return;
    wo_svg_line(s->svg, &pen, x, s->axis - 4, x, s->axis + 4);
    wo_svg_text(s->svg, x, s->axis - above, 11, WO_ANCHOR_MIDDLE, true, name);
}

static void draw_frame(const section *s, double end_z, double height)
{
    static const wo_pen axis = {"#909090", 0.8, "10 3 2 3"}, sensor = {"#101010", 1.6, NULL};
    const wo_box b = s->box;
    wo_svg_line(s->svg, &axis, b.x, s->axis, b.x + b.w, s->axis);
    if (isfinite(s->view->image) && end_z == wo_lens_sensor_z(s->view))
        wo_svg_line(s->svg, &sensor, at_z(s, end_z), at_h(s, -height), at_z(s, end_z),
                    at_h(s, height));
    const wo_first_order *const first = &s->view->first[s->meridian == WO_MERIDIAN_X ? 0 : 1];
    mark(s, first->H1, 7, "H");
    mark(s, s->view->system.z_last + first->H2, -16, "H\xE2\x80\xB2");
}

/* A ruler in mm along the foot. */
static void draw_ruler(const section *s)
{
    static const wo_pen pen = {"#404040", 1, NULL};
    const wo_box b = s->box;
    const double y = b.y + b.h + 4;
    wo_ticks ticks;
    char text[32];
    wo_ticks_make((b.x - s->z0) / s->scale, (b.x + b.w - s->z0) / s->scale, 10, &ticks);
    wo_svg_line(s->svg, &pen, b.x, y, b.x + b.w, y);
    for (int i = 0; i < ticks.count; i++) {
        const double x = at_z(s, ticks.value[i]);
        wo_svg_line(s->svg, &pen, x, y, x, y + 4);
        wo_plot_number(text, sizeof text, ticks.value[i], ticks.decimals);
        wo_svg_text(s->svg, x, y + 16, 11, WO_ANCHOR_MIDDLE, false, text);
    }
    wo_svg_text(s->svg, b.x + b.w / 2, y + 31, 12, WO_ANCHOR_MIDDLE, false,
                "z from the first vertex, mm (the same scale across)");
}

/* Where the sensor is that is not drawn. */
static void note_sensor(const section *s)
{
    char text[96], number[32];
    const double image = s->view->image;
    if (isfinite(image))
        snprintf(text, sizeof text, "the sensor is not drawn: z = %s mm%s",
                 wo_plot_number(number, sizeof number, wo_lens_sensor_z(s->view), 1),
                 image >= 0 ? "" : ", a virtual image");
    else
        snprintf(text, sizeof text, "no sensor: the image is at infinity");
    wo_svg_text(s->svg, s->box.x + s->box.w, s->box.y + 12, 11, WO_ANCHOR_END, false, text);
}

static void draw_section(const wo_lens_view *view, wo_svg *svg, wo_meridian meridian, wo_box box)
{
    section s = {.view = view, .svg = svg, .meridian = meridian, .box = box};
    const double length = fmax(view->system.z_last, 1e-3);
    const bool image = isfinite(view->image) && view->image > 0 && view->image < 6 * length + 200;
    const double end_z = image ? wo_lens_sensor_z(view) : view->system.z_last + length;
    const double tall = tallest(&s);
    double height = tall * 0.3;
    for (int f = 0; image && f < WO_LENS_FIELDS; f++)
        height = fmax(height, fabs(wo_lens_chief_height(view, &view->system, meridian,
                                                        wo_lens_fields[f] * view->half_field)));
    const double before = 0.16 * (end_z + 1), half = fmax(tall, height) * 1.06;
    s.scale = fmin(box.w / (before + end_z * 1.04), box.h / (2 * half));
    s.z0 = box.x + (box.w - (end_z * 1.04 - before) * s.scale) / 2;
    s.axis = box.y + box.h / 2;
    wo_svg_clip_begin(svg, box);
    draw_glass(&s);
    draw_rays(&s, end_z);
    draw_iris(&s);
    draw_frame(&s, end_z, height);
    wo_svg_clip_end(svg);
    if (!image)
        note_sensor(&s);
    draw_ruler(&s);
}

void wo_panel_section(const wo_lens_view *view, wo_svg *svg, wo_box box)
{
    char names[WO_LENS_FIELDS][32], number[32];
    const char *list[WO_LENS_FIELDS];
    for (int f = 0; f < WO_LENS_FIELDS; f++) {
        snprintf(names[f], sizeof names[f], "%s\xC2\xB0",
                 wo_plot_number(number, sizeof number, wo_lens_fields[f] * view->half_field, 1));
        list[f] = names[f];
    }
    wo_svg_text(svg, box.x + 12, box.y + 18, 13, WO_ANCHOR_START, true,
                view->anamorphic ? "Section in y (above) and in x (below)" : "Section");
    wo_plot_legend(svg, box.x + box.w - 16, box.y + 18, wo_lens_field_pens, list, WO_LENS_FIELDS);
    wo_box inner = {box.x + 16, box.y + 28, box.w - 32, box.h - 28 - 44};
    if (view->anamorphic) {
        inner.h = (inner.h - 40) / 2;
        wo_box below = inner;
        below.y += inner.h + 40;
        draw_section(view, svg, WO_MERIDIAN_X, below);
    }
    draw_section(view, svg, WO_MERIDIAN_Y, inner);
}
