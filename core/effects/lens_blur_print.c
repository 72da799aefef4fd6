/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "effects/lens_blur_plan.h"

#include "optics/lens_choice.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#define FOCUS_BY(name, key, label) key,
static const char *const focus_by[] = {WO_FOCUS_BY_LIST(FOCUS_BY)};

typedef struct printer {
    char *buffer;
    size_t size;
    int length;
} printer;

static void add(printer *p, const char *format, ...) WO_PRINTF(2, 3);

static void add(printer *p, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    const size_t used = (size_t)p->length < p->size ? (size_t)p->length : p->size;
    const int n = vsnprintf(p->buffer ? p->buffer + used : NULL, p->size - used, format, args);
    va_end(args);
    p->length += n > 0 ? n : 0;
}

static void add_camera(printer *p, const wo_camera_use *use)
{
    add(p, "camera      ");
    if (use->key[0])
        add(p, "%s %g%s%s from ", use->key, use->value, use->unit[0] ? " " : "", use->unit);
    add(p, "%s", use->name);
    if (use->why[0])
        add(p, ": not used, %s", use->why);
    add(p, "\n");
}

static void add_warnings(printer *p, const wo_report *report)
{
    for (int i = 0; i < report->warning_count; i++)
        add(p, "warning     %s\n", report->warnings[i].text);
}

void wo_lens_blur_warn_of_colour(wo_report *report)
{
    if (report->sanitised_colour > 0)
        wo_report_warn(
            report, "colour-cut",
            "%lld samples of the pictures are no light: what is not finite was taken for "
            "0, what lies beyond 1e30 was cut to that",
            (long long)report->sanitised_colour);
}

const wo_report *wo_lens_blur_plan_report(const wo_plan *plan)
{
    return &plan->report;
}

int wo_lens_blur_plan_print(const wo_plan *plan, char *buffer, size_t size)
{
    printer p = {buffer, size, 0};
    const wo_lens_blur_setup *s = &plan->setup;
    const wo_rect w = plan->window;
    int64_t tiles[WO_TILE_CLASS_COUNT] = {0};
    double reach = 0;
    const size_t count =
        (size_t)wo_rect_width(plan->rays.tiles) * (size_t)wo_rect_height(plan->rays.tiles);
    for (size_t i = 0; plan->rays.tile && i < count; i++) {
        tiles[plan->rays.tile[i].class]++;
        reach = fmax(reach, (double)plan->rays.tile[i].reach);
    }
    if (size > 0)
        buffer[0] = 0;
    add(&p, "window      %d,%d .. %d,%d (%d x %d px)\n", w.x1, w.y1, w.x2, w.y2, wo_rect_width(w),
        wo_rect_height(w));
    const wo_focus *focus = &plan->focus;
    add(&p, "lens        %g mm f/%g, focus at %.6g m; blur radius %.4g px per dioptre\n",
        plan->params.focal_length, plan->params.f_stop, focus->v_axis != 0 ? 1 / focus->v_axis : 0,
        plan->copy ? s->lens.k : plan->lens.px_per_dioptre);
    for (int i = 0; i < plan->report.camera_count; i++)
        add_camera(&p, &plan->report.camera[i]);
    if (focus->options.count > 0 || !focus->flat)
        add(&p, "focus       by %s, %d points; tilt %.4g px of blur radius for each px%s\n",
            s->focus_map ? "clip" : focus_by[focus->options.by], focus->options.count,
            focus->tilt_slope, focus->tilt_asked > focus->tilt_slope ? " (limited)" : "");
    if (plan->table[0]) {
        const wo_table_facts *f = &plan->facts;
        const bool real =
            plan->params.lens == WO_LENS_PRESCRIPTION || plan->params.lens == WO_LENS_SEIDEL;
        const char *design = real ? wo_lens_design(plan->params.lens_design) : "";
        add(&p,
            "            %s%s%s, f/%.4g reached; %d wavelengths (colours part by %.2f px), "
            "aberrations "
            "up to %.2f px in the plane of focus\n",
            wo_lens_blur_lens_labels[plan->params.lens], design[0] ? " " : "", design,
            plan->f_number, f->wavelengths, f->colour_px, f->aberration_px);
        if (f->exact)
            add(&p, "rays        traced exactly, one by one");
        else
            add(&p,
                "table       degree %d, %d field points; %.4f px RMS from the exact rays, %.3f of "
                "the "
                "lit iris",
                f->degree, f->nodes, f->rms_px, f->lit_error);
        add(&p, "; lit to %.1f degrees\n", atan(f->field_lit) * (180 / 3.14159265358979323846));
    }
    if (plan->copy) {
        add(&p, "blur        none: all in focus, the source is copied\n");
        add_warnings(&p, &plan->report);
        return p.length;
    }
    add(&p, "blur        largest radius %.2f px (limit %.2f px)\n", reach, s->radius);
    add(&p,
        "layers      %d connected, %s; %d sheets after splitting edges and continuing hidden "
        "surfaces\n",
        s->layers, s->has_depth ? "with depth" : "no depth: all at infinity", plan->stack.sheets);
    add(&p, "highlights  %zu connected directly\n", plan->highlights.count);
    if (plan->quality.adaptive)
        add(&p, "samples     up to %d lens rays for each pixel, to an error of %g; ",
            plan->quality.max_rays, plan->quality.target_error);
    else
        add(&p, "samples     %d lens rays for each pixel; ", plan->quality.samples);
    add(&p, "%u different pencils; method %s\n", plan->lens.sets,
        wo_renderer_of((wo_method)plan->params.method)->key);
    for (int i = 0; i < WO_TILE_CLASS_COUNT; i++)
        add(&p, "tiles       %-7s %lld\n", wo_tile_class_text((wo_tile_class)i),
            (long long)tiles[i]);
    for (int i = 0; i < plan->report.left_out_count; i++)
        add(&p, "left out    %s: %s\n", plan->report.left_out[i].what,
            plan->report.left_out[i].why);
    add_warnings(&p, &plan->report);
    return p.length;
}
