/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "effects/lens_blur_plan.h"

#include "defocus/depth_check.h"
#include "effects/lens_blur_focus.h"

#include <math.h>
#include <string.h>
#include <time.h>

double wo_seconds(void)
{
    struct timespec now;
    return timespec_get(&now, TIME_UTC) ? (double)now.tv_sec + 1e-9 * (double)now.tv_nsec : 0;
}

/* Layers, then the clean plate, split edges, what is hidden. */
enum { BACKGROUND = WO_LENS_BLUR_LAYERS, EDGES, HIDDEN, SHEETS };

/* Between the steps of planning: does the caller still want the picture? */
static wo_status go_on(const wo_context *context, wo_error *error)
{
    return wo_aborted(context) ? wo_fail(error, WO_ABORTED, "stopped by the user") : WO_OK;
}

static void destroy_sheets(const wo_context *context, wo_sheet sheets[SHEETS])
{
    for (int i = 0; i < SHEETS; i++)
        wo_sheet_destroy(context, &sheets[i]);
}

static void empty_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const wo_sheet *sheet = user;
    const size_t w = (size_t)wo_rect_width(sheet->area);
    for (size_t at = index * w; at < (index + 1) * w; at++)
        sheet->v[at] = NAN;
    memset(sheet->c + index * w, 0, w * sizeof *sheet->c);
}

static wo_status empty_sheet(const wo_context *context, wo_rect area, wo_sheet *sheet,
                             wo_error *error)
{
    WO_TRY(wo_sheet_create(context, area, sheet, error));
    wo_run(context, empty_row, sheet, (size_t)wo_rect_height(area));
    return WO_OK;
}

wo_sheet_source wo_lens_blur_layer(const wo_plan *plan, const wo_plan_args *args, int layer)
{
    const wo_lens_blur_setup *setup = &plan->setup;
    const int clip = layer == BACKGROUND ? WO_CLIP_BACKGROUND : 2 * layer;
    return (wo_sheet_source){
        .colour = &args->inputs[clip],
        .depth = plan->params.use_depth ? &args->inputs[clip + 1] : NULL,
        .depth_channel = plan->params.depth_channel,
        .alpha = args->alpha[clip],
        .reading = setup->reading,
        .extent = plan->geometry.extent,
        .format = plan->geometry.format,
        .focal_px = setup->lens.focal_px,
        .stretch = plan->geometry.pixel_stretch,
        .v_origin = plan->focus.v_axis,
        .focus = plan->focus.flat || plan->params.output == WO_OUTPUT_DEPTH ? NULL : &plan->focus,
        .v_min = setup->v_min,
        .v_max = setup->v_max,
    };
}

static wo_status load_layers(const wo_plan *plan, const wo_plan_args *args, wo_rect area,
                             wo_sheet sheets[SHEETS], wo_sheet_counts *counts, wo_error *error)
{
    const wo_lens_blur_setup *setup = &plan->setup;
    for (int i = 0; i <= BACKGROUND; i++) {
        const wo_sheet_source source = wo_lens_blur_layer(plan, args, i);
        const bool used = i == BACKGROUND ? setup->background_used && setup->fill_levels > 0
                                          : setup->layer_used[i];
        if (!used || !source.colour->data)
            continue;
        WO_TRY(wo_sheet_create(&plan->context, area, &sheets[i], error));
        WO_TRY(wo_sheet_load(&plan->context, &source, plan->window, &sheets[i], counts, error));
        WO_TRY(go_on(&plan->context, error));
    }
    return WO_OK;
}

/* Where the layers as given let (almost) no light through. */
#define OPAQUE_LEFT 1e-3f

typedef struct opaque_job {
    const wo_sheet *sheets;
    size_t row;
    uint8_t *opaque;
} opaque_job;

static void opaque_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const opaque_job *job = user;
    for (size_t at = index * job->row; at < (index + 1) * job->row; at++) {
        float left = 1;
        for (int i = 0; i < WO_LENS_BLUR_LAYERS; i++)
            if (job->sheets[i].any)
                left *= 1 - job->sheets[i].c[at][3];
        job->opaque[at] = left < OPAQUE_LEFT;
    }
}

/* Brute force draws no pictures of points. */
static bool connects(const wo_plan *plan)
{
    return plan->lens.connect || plan->params.method != WO_METHOD_REFERENCE;
}

static void note_layers(wo_plan *plan, const wo_sheet sheets[SHEETS], int64_t split)
{
    wo_report *report = &plan->report;
    for (int i = 0; i < WO_LENS_BLUR_LAYERS; i++)
        if (plan->setup.layer_used[i] && !sheets[i].any)
            wo_report_leave_out(report, "layers", "empty or not connected", 1, "layers");
    if (!plan->setup.has_depth && !plan->setup.focus_map)
        wo_report_leave_out(report, "edges and hidden surfaces", "no depth: one distance", 0, "");
    else if (split == 0)
        wo_report_leave_out(report, "sheet of split edges", "no pixel mixes two distances", 1,
                            "sheets");
    if (plan->geometry.connected[WO_CLIP_BACKGROUND] && !sheets[BACKGROUND].any)
        wo_report_leave_out(report, "clean plate",
                            plan->setup.has_depth ? "it shows nothing that is hidden"
                                                  : "without depth nothing is hidden",
                            1, "sheets");
    if (plan->setup.has_depth && !sheets[HIDDEN].any)
        wo_report_leave_out(report, "sheet of hidden surfaces", "nothing is hidden", 1, "sheets");
    if (!connects(plan))
        wo_report_leave_out(report, "connections to highlights",
                            "the reference finds them by rays alone", 0, "");
    else if (plan->highlights.count == 0)
        wo_report_leave_out(report, "connections to highlights", "no blurred highlight", 0, "");
}

/* For the view: pixels of the window that were touched. */
static void mark_split(wo_plan *plan, wo_rect area, const float *v, uint8_t mark)
{
    const wo_rect w = plan->window;
    for (int32_t y = w.y1; y < w.y2; y++) {
        const float *row = v + (size_t)(y - area.y1) * (size_t)wo_rect_width(area);
        uint8_t *to = plan->split + (size_t)(y - w.y1) * (size_t)wo_rect_width(w);
        for (int32_t x = w.x1; x < w.x2; x++)
            if (!isnan(row[x - area.x1]))
                to[x - w.x1] = mark;
    }
}

/* Antialiased depth, then antialiased colour. The clean plate is not split: nobody sees its edges
   in focus. */
static wo_status mend_edges(wo_plan *plan, const wo_plan_args *args, int layer,
                            wo_sheet sheets[SHEETS], int64_t *split, wo_error *error)
{
    const wo_context *context = &plan->context;
    const wo_sheet_source source = wo_lens_blur_layer(plan, args, layer);
    const double px = plan->lens.px_per_dioptre;
    wo_sheet *sheet = &sheets[layer];
    const size_t n = (size_t)wo_rect_width(sheet->area) * (size_t)wo_rect_height(sheet->area);
    float *mix = NULL;
    wo_status status = go_on(context, error);
    if (status == WO_OK && plan->params.edge_repair == WO_EDGES_OF_COLOUR_AND_DEPTH &&
        source.depth && source.depth->data) {
        if (!(mix = wo_new_raw(context, error, n, sizeof *mix)))
            return WO_ERR_NOMEM;
        status = wo_sheet_repair_depth(context, &source, px, plan->window, sheet, mix,
                                       &plan->report.mixed_depth, error);
        if (status == WO_OK && plan->split)
            mark_split(plan, sheet->area, mix, WO_SPLIT_DEPTH);
    }
    if (status == WO_OK)
        status = go_on(context, error);
    if (status == WO_OK && layer != BACKGROUND)
        status = wo_sheet_split_edges(context, px, mix, sheet, &sheets[EDGES], split, error);
    wo_delete(context, mix);
    return status;
}

/* What is behind the layers: the clean plate, then what can be told from the surfaces around. */
static wo_status add_hidden(wo_plan *plan, bool plate_has_depth, wo_sheet sheets[SHEETS],
                            wo_error *error)
{
    const wo_context *context = &plan->context;
    const double px = plan->lens.px_per_dioptre;
    wo_sheet *plate = &sheets[BACKGROUND];
    const bool any = plate->any;
    plate->any = false; /* it hides nothing itself */
    if (any && plate_has_depth)
        wo_sheet_keep_hidden(context, sheets, WO_LENS_BLUR_LAYERS, px, &sheets[EDGES], plate);
    WO_TRY(go_on(context, error));
    WO_TRY(empty_sheet(context, sheets[EDGES].area, &sheets[HIDDEN], error));
    WO_TRY(wo_sheet_fill_hidden(context, sheets, HIDDEN, px, plan->setup.fill_levels,
                                &sheets[HIDDEN], error));
    if (any && !plate_has_depth)
        wo_sheet_lend_depth(context, sheets, WO_LENS_BLUR_LAYERS, px, &sheets[EDGES],
                            &sheets[HIDDEN], plate);
    return WO_OK;
}

/* All that a scene with depth needs besides its layers. */
static wo_status add_sheets(wo_plan *plan, const wo_plan_args *args, wo_rect area,
                            wo_sheet sheets[SHEETS], int64_t *split, wo_error *error)
{
    const wo_context *context = &plan->context;
    const wo_rect w = plan->window;
    if (plan->params.output == WO_OUTPUT_SPLIT &&
        !(plan->split =
              wo_new(context, error, (size_t)wo_rect_width(w) * (size_t)wo_rect_height(w), 1)))
        return WO_ERR_NOMEM;
    WO_TRY(empty_sheet(context, area, &sheets[EDGES], error));
    for (int i = 0; i <= BACKGROUND; i++)
        if (sheets[i].any && plan->params.edge_repair != WO_EDGES_AS_THEY_ARE)
            WO_TRY(mend_edges(plan, args, i, sheets, split, error));
    if (plan->split)
        mark_split(plan, area, sheets[EDGES].v, WO_SPLIT_TWO);
    const wo_image *plate_depth = &args->inputs[WO_CLIP_BACKGROUND_DEPTH];
    return add_hidden(plan, plate_depth->data != NULL, sheets, error);
}

/* How far the rays of any tile can go: mostly much less than the limit. */
static double reach_of(const wo_plan *plan, const wo_sheet sheets[SHEETS])
{
    const wo_lens *lens = &plan->lens;
    double reach = 0;
    for (int i = 0; i < SHEETS; i++) {
        float v_min, v_max;
        if (sheets[i].any && wo_sheet_range(&sheets[i], &v_min, &v_max))
            reach = fmax(reach, lens->reach(lens->self, (double)v_min, (double)v_max));
    }
    return fmin(reach, plan->setup.reach);
}

/* Depth that cannot be what was meant. */
static wo_status check_depth(wo_plan *plan, const wo_plan_args *args, wo_error *error)
{
    const wo_lens_blur_setup *setup = &plan->setup;
    const wo_rect whole = wo_rect_intersect(plan->geometry.format, plan->geometry.extent);
    for (int i = 0; i <= BACKGROUND; i++) {
        const wo_sheet_source source = wo_lens_blur_layer(plan, args, i);
        const int index = i == BACKGROUND ? WO_CLIP_BACKGROUND_DEPTH : 2 * i + 1;
        const wo_depth_clip clip = {.name = wo_lens_blur_clips[index].name,
                                    .may_be_sky = i > 0,
                                    .part = !wo_rect_contains(plan->window, whole)};
        const bool used = i == BACKGROUND ? setup->background_used : setup->layer_used[i];
        if (used && source.colour->data)
            WO_TRY(
                wo_depth_check(&plan->context, &source, plan->window, &clip, &plan->report, error));
    }
    return WO_OK;
}

static wo_status build_scene(wo_plan *plan, const wo_plan_args *args, wo_error *error)
{
    const wo_context *context = &plan->context;
    const wo_rect extent = plan->geometry.extent;
    const wo_rect area =
        wo_rect_intersect(wo_lens_blur_layers_area(&plan->setup, plan->window), extent);
    wo_sheet sheets[SHEETS] = {0};
    wo_sheet_counts counts = {0};
    int64_t split = 0;
    double start = wo_seconds();
    const size_t w = (size_t)wo_rect_width(area);
    const size_t h = (size_t)wo_rect_height(area);
    uint8_t *opaque = wo_new(context, error, w * h, sizeof *opaque);
    if (!opaque)
        return WO_ERR_NOMEM;
    wo_status status = load_layers(plan, args, area, sheets, &counts, error);
    opaque_job job = {sheets, w, opaque};
    if (status == WO_OK)
        wo_run(context, opaque_row, &job, h);
    if (status == WO_OK && plan->setup.fill_levels > 0)
        status = add_sheets(plan, args, area, sheets, &split, error);
    if (status == WO_OK)
        status = go_on(context, error);
    plan->reach = reach_of(plan, sheets);
    const wo_rect seen = wo_lens_blur_stack_area(&plan->setup, plan->window, plan->reach);
    if (status == WO_OK && connects(plan))
        status = wo_highlights_take(context, sheets, SHEETS, wo_rect_intersect(seen, extent),
                                    &plan->lens, &plan->highlights, error);
    plan->report.seconds[WO_STAGE_INPUT] += wo_seconds() - start;
    start = wo_seconds();
    if (status == WO_OK)
        status = go_on(context, error);
    if (status == WO_OK)
        status =
            wo_stack_create(context, sheets, SHEETS, opaque, seen, extent, &plan->stack, error);
    if (status == WO_OK)
        status = wo_highlights_draw(context, &plan->highlights, &plan->stack, &plan->lens,
                                    plan->window, error);
    plan->report.seconds[WO_STAGE_BOUNDS] += wo_seconds() - start;
    plan->report.sanitised_colour = counts.sanitised_colour;
    wo_lens_blur_warn_of_colour(&plan->report);
    plan->report.sanitised_depth = counts.sanitised_depth;
    plan->report.edge_depth = counts.edge_depth;
    plan->report.clamped_radius = counts.clamped_radius;
    if (status == WO_OK)
        note_layers(plan, sheets, split);
    destroy_sheets(context, sheets);
    wo_delete(context, opaque);
    return status;
}

static wo_status check_args(const wo_plan_args *args, wo_error *error)
{
    const wo_geometry *g = &args->geometry;
    if (wo_rect_empty(g->format) || wo_rect_empty(g->extent))
        return wo_fail(error, WO_ERR_ARGUMENT, "the picture is empty");
    if (wo_rect_width(g->extent) > WO_MAX_SIDE || wo_rect_height(g->extent) > WO_MAX_SIDE)
        return wo_fail(error, WO_ERR_RANGE, "the picture is %d x %d px: at most %d on a side",
                       wo_rect_width(g->extent), wo_rect_height(g->extent), WO_MAX_SIDE);
    const wo_rect known = {-WO_MAX_COORDINATE, -WO_MAX_COORDINATE, WO_MAX_COORDINATE,
                           WO_MAX_COORDINATE};
    if (!wo_rect_contains(known, g->extent))
        return wo_fail(error, WO_ERR_RANGE, "the picture reaches beyond %d..%d px",
                       -WO_MAX_COORDINATE, WO_MAX_COORDINATE);
    if (!(g->render_scale > 0 && g->render_scale <= 64) ||
        !(g->pixel_stretch >= 1.0 / 64 && g->pixel_stretch <= 64) ||
        !(g->pixel_aspect > 1e-4 && g->pixel_aspect < 1e4))
        return wo_fail(error, WO_ERR_RANGE,
                       "render scale %g, pixel stretch %g, pixel aspect %g: out of range",
                       g->render_scale, g->pixel_stretch, g->pixel_aspect);
    if (wo_rect_empty(args->window))
        return wo_fail(error, WO_ERR_ARGUMENT, "nothing to render: the window is empty");
    for (size_t i = 0; i < WO_LENS_BLUR_CLIPS; i++)
        WO_TRY(wo_image_validate(&args->inputs[i], wo_lens_blur_clips[i].name, error));
    if (!args->inputs[WO_CLIP_SOURCE].data)
        return wo_fail(error, WO_ERR_ARGUMENT, "Source is not connected");
    return WO_OK;
}

wo_status wo_lens_blur_plan_create(const wo_context *context, const void *params,
                                   const wo_plan_args *args, wo_plan **out, wo_error *error)
{
    *out = NULL;
    WO_TRY(check_args(args, error));
    wo_plan *plan = wo_new(context, error, 1, sizeof *plan);
    if (!plan)
        return WO_ERR_NOMEM;
    plan->context = *context;
    memcpy(&plan->params, params, sizeof plan->params);
    plan->geometry = args->geometry;
    wo_lens_blur_use_camera(&plan->params, &plan->geometry.camera, &plan->report);
    for (size_t i = 0; i < WO_LENS_BLUR_CLIPS; i++)
        plan->geometry.connected[i] = args->inputs[i].data != NULL;
    const bool adaptive = plan->params.sampling == WO_SAMPLING_ADAPTIVE;
    plan->quality = (wo_quality){.samples = plan->params.samples,
                                 .adaptive = adaptive,
                                 .target_error = plan->params.target_error,
                                 .max_rays = plan->params.max_rays};
    plan->window = wo_rect_intersect(args->window, args->geometry.extent);
    plan->mask = args->inputs[WO_CLIP_MASK];
    plan->source = args->inputs[WO_CLIP_SOURCE];
    plan->source_alpha = args->alpha[WO_CLIP_SOURCE];
    wo_status status = wo_lens_blur_prepare(&plan->params, &plan->geometry, &plan->setup, error);
    if (status != WO_OK || wo_rect_empty(plan->window))
        goto done;
    status = wo_lens_blur_focus_make(&plan->params, args, &plan->setup, &plan->focus, error);
    if (status != WO_OK || (status = check_depth(plan, args, error)) != WO_OK)
        goto done;
    wo_lens_blur_find_copy(plan, args);
    if (plan->copy || (status = wo_lens_blur_lens_make(plan, error)) != WO_OK)
        goto done;
    if ((status = build_scene(plan, args, error)) != WO_OK)
        goto done;
    const double start = wo_seconds();
    /* Not what lies in the umbra of nearer sheets: on rough surfaces that is not proven to change
       nothing, and on footage it saves little. */
    const unsigned leave_out = WO_LEAVE_OUT_ALL & ~(unsigned)WO_LEAVE_OUT_HIDDEN;
    status = wo_lens_rays_create(&plan->context, &plan->stack, &plan->lens,
                                 wo_rect_grow(plan->window, plan->setup.margin, plan->setup.margin),
                                 plan->reach, leave_out, &plan->rays, error);
    plan->report.seconds[WO_STAGE_PLAN] += wo_seconds() - start;
done:
    if (status != WO_OK)
        wo_lens_blur_plan_destroy(&plan);
    *out = plan;
    return status;
}

void wo_lens_blur_plan_destroy(wo_plan **plan)
{
    if (!*plan)
        return;
    const wo_context context = (*plan)->context;
    wo_lens_rays_destroy(&context, &(*plan)->rays);
    wo_stack_destroy(&context, &(*plan)->stack);
    wo_highlights_destroy(&context, &(*plan)->highlights);
    wo_lens_blur_lens_destroy(*plan);
    wo_delete(&context, (*plan)->split);
    wo_delete(&context, *plan);
    *plan = NULL;
}
