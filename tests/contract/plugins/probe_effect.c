/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "probe_effect.h"

#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

struct wo_plan {
    wo_context context;
    probe_params params;
    wo_geometry geometry;
    wo_rect window;
    wo_image inputs[PROBE_CLIPS];
    wo_alpha alpha[PROBE_CLIPS];
    int32_t rx, ry;
    unsigned workers;
    wo_report report;
    atomic_bool *busy; /* [workers]: no two calls may be the same worker at once */
};

static const char *const troubles[] = {"none", "fail", "slow", "wait", "warn", NULL};
static const char *const trouble_labels[] = {"No trouble", "Fail", "Be slow", "Wait", "Warn", NULL};

static const wo_param params[] = {
    {.key = "radius",
     .label = "Radius",
     .help = "Half the width of the box.",
     .unit = "px",
     .group = "blur",
     .type = WO_PARAM_DOUBLE,
     .offset = offsetof(probe_params, radius),
     .initial = {2},
     .min = 0,
     .max = 1000,
     .ui_min = 0,
     .ui_max = 20,
     .animates = true},
    {.key = "angle",
     .label = "Angle",
     .help = "Turns red.",
     .unit = "deg",
     .group = "blur",
     .type = WO_PARAM_DOUBLE,
     .offset = offsetof(probe_params, angle),
     .min = -360,
     .max = 360,
     .ui_min = -180,
     .ui_max = 180,
     .animates = true},
    {.key = "repeats",
     .label = "Repeats",
     .help = "Added to blue.",
     .unit = "",
     .group = "blur",
     .type = WO_PARAM_INT,
     .offset = offsetof(probe_params, repeats),
     .min = 0,
     .max = 9,
     .ui_min = 0,
     .ui_max = 5,
     .animates = true},
    {.key = "on",
     .label = "On",
     .help = "Off: the picture is left as it is.",
     .unit = "",
     .group = "blur",
     .type = WO_PARAM_BOOL,
     .offset = offsetof(probe_params, on),
     .initial = {1},
     .min = 0,
     .max = 1,
     .ui_min = 0,
     .ui_max = 1,
     .animates = true},
    {.key = "trouble",
     .label = "Trouble",
     .help = "What goes wrong.",
     .unit = "",
     .group = "rest",
     .type = WO_PARAM_CHOICE,
     .offset = offsetof(probe_params, trouble),
     .min = 0,
     .max = 4,
     .ui_min = 0,
     .ui_max = 4,
     .choices = troubles,
     .choice_labels = trouble_labels},
    {.key = "centre",
     .label = "Centre",
     .help = "Added to red and green.",
     .unit = "px",
     .group = "rest",
     .type = WO_PARAM_POINT,
     .offset = offsetof(probe_params, centre),
     .min = -5000,
     .max = 5000,
     .ui_min = 0,
     .ui_max = 2000,
     .animates = true},
    {.key = "tint",
     .label = "Tint",
     .help = "Multiplies the picture.",
     .unit = "",
     .group = "rest",
     .type = WO_PARAM_COLOUR,
     .offset = offsetof(probe_params, tint),
     .initial = {1, 1, 1},
     .min = 0,
     .max = 8,
     .ui_min = 0,
     .ui_max = 1,
     .animates = true},
    {.key = "note",
     .label = "Note",
     .help = "Printed with the plan.",
     .unit = "",
     .group = "rest",
     .type = WO_PARAM_STRING,
     .offset = offsetof(probe_params, note),
     .initial_text = "nothing"},
};

static const wo_param_group groups[] = {{"blur", "Blur", true}, {"rest", "The rest", false}};

static const wo_clip clips[PROBE_CLIPS] = {
    [PROBE_SOURCE] = {.name = "Source",
                      .label = "Source",
                      .help = "The picture.",
                      .components = WO_COMPONENT_ALPHA | WO_COMPONENT_RGB | WO_COMPONENT_RGBA},
    [PROBE_DEPTH] = {.name = "Depth",
                     .label = "Depth",
                     .help = "Added to green.",
                     .components = WO_COMPONENT_ALPHA | WO_COMPONENT_RGB | WO_COMPONENT_RGBA,
                     .optional = true,
                     .data = true},
    [PROBE_MASK] = {.name = "Mask",
                    .label = "Mask",
                    .help = "Where it works.",
                    .components = WO_COMPONENT_ALPHA,
                    .optional = true,
                    .mask = true},
    [PROBE_EXTRA] = {.name = "Extra",
                     .label = "Extra layer",
                     .help = "Laid over the picture.",
                     .components = WO_COMPONENT_RGB | WO_COMPONENT_RGBA,
                     .optional = true},
};

static int32_t reach(double radius, double scale)
{
    return (int32_t)floor(radius * scale + 0.5);
}

static wo_status region(const void *p, const wo_geometry *geometry, wo_rect window, size_t clip,
                        wo_rect *needed, wo_error *error)
{
    const probe_params *const values = p;
    if (clip >= PROBE_CLIPS)
        return wo_fail(error, WO_ERR_ARGUMENT, "there is no clip %zu", clip);
    const double scale = geometry->render_scale;
    *needed = clip == PROBE_SOURCE
                  ? wo_rect_grow(window, reach(values->radius, scale),
                                 reach(values->radius, scale * geometry->pixel_stretch))
                  : window;
    return WO_OK;
}

static int identity(const void *p, const wo_geometry *geometry)
{
    const probe_params *const values = p;
    (void)geometry;
    return values->on ? -1 : PROBE_SOURCE;
}

static void plan_destroy(wo_plan **place)
{
    wo_plan *const plan = *place;
    if (!plan)
        return;
    const wo_context context = plan->context;
    wo_delete(&context, plan->busy);
    wo_delete(&context, plan);
    *place = NULL;
}

static wo_status plan_create(const wo_context *context, const void *p, const wo_plan_args *args,
                             wo_plan **place, wo_error *error)
{
    *place = NULL;
    wo_plan *plan = wo_new(context, error, 1, sizeof *plan);
    if (!plan)
        return WO_ERR_NOMEM;
    plan->context = *context;
    memcpy(&plan->params, p, sizeof plan->params);
    plan->geometry = args->geometry;
    plan->window = args->window;
    memcpy(plan->alpha, args->alpha, sizeof plan->alpha);
    memcpy(plan->inputs, args->inputs, sizeof plan->inputs);
    plan->rx = reach(plan->params.radius, args->geometry.render_scale);
    plan->ry =
        reach(plan->params.radius, args->geometry.render_scale * args->geometry.pixel_stretch);
    for (int i = 0; i < PROBE_CLIPS; i++) {
        const wo_status status = wo_image_validate(&plan->inputs[i], clips[i].name, error);
        if (status != WO_OK) {
            plan_destroy(&plan);
            return status;
        }
    }
    plan->workers = wo_workers(context);
    plan->busy = wo_new(context, error, plan->workers, sizeof *plan->busy);
    if (!plan->busy) {
        plan_destroy(&plan);
        return WO_ERR_NOMEM;
    }
    if (plan->params.trouble == PROBE_TROUBLE_WARN)
        wo_report_warn(&plan->report, "probe-note", "the note is %s", plan->params.note);
    *place = plan;
    return WO_OK;
}

static const wo_report *plan_report(const wo_plan *plan)
{
    return &plan->report;
}

static int plan_print(const wo_plan *plan, char *buffer, size_t size)
{
    const wo_geometry *const g = &plan->geometry;
    const wo_image *const in = plan->inputs;
    return snprintf(
        buffer, size,
        "format=%d,%d,%d,%d\nextent=%d,%d,%d,%d\nwindow=%d,%d,%d,%d\nscale=%.6f\nstretch=%.6f\n"
        "connected=%d%d%d%d\npixels=%d%d%d%d\nalpha=%d\nreach=%d,%d\nworkers=%u\nnote=%s\n"
        "camera=%g %s %g\n",
        g->format.x1, g->format.y1, g->format.x2, g->format.y2, g->extent.x1, g->extent.y1,
        g->extent.x2, g->extent.y2, plan->window.x1, plan->window.y1, plan->window.x2,
        plan->window.y2, g->render_scale, g->pixel_stretch, g->connected[0], g->connected[1],
        g->connected[2], g->connected[3], in[0].data ? in[0].components : 0,
        in[1].data ? in[1].components : 0, in[2].data ? in[2].components : 0,
        in[3].data ? in[3].components : 0, (int)plan->alpha[0], plan->rx, plan->ry,
        wo_workers(&plan->context), plan->params.note, g->camera.facts[WO_CAMERA_F_NUMBER].value,
        g->camera.facts[WO_CAMERA_F_NUMBER].name, g->camera.facts[WO_CAMERA_FOCUS].value);
}

static int32_t clamp(int32_t value, int32_t low, int32_t high)
{
    return value < low ? low : value > high ? high : value;
}

/* Premultiplied RGBA of the nearest pixel there is. */
static void fetch(const wo_plan *plan, int clip, int32_t x, int32_t y, double rgba[4])
{
    const wo_image *const image = &plan->inputs[clip];
    const wo_alpha alpha = plan->alpha[clip];
    const float *const at = wo_image_at(image, clamp(x, image->bounds.x1, image->bounds.x2 - 1),
                                        clamp(y, image->bounds.y1, image->bounds.y2 - 1));
    for (int i = 0; i < 3; i++)
        rgba[i] = at[image->components == 1 ? 0 : i];
    rgba[3] = image->components == 4 && alpha != WO_ALPHA_OPAQUE ? (double)at[3] : 1;
    if (image->components == 4 && alpha == WO_ALPHA_UNPREMULTIPLIED)
        for (int i = 0; i < 3; i++)
            rgba[i] *= rgba[3];
}

static double single(const wo_plan *plan, int clip, int32_t x, int32_t y, double otherwise)
{
    double rgba[4];
    if (!plan->inputs[clip].data)
        return otherwise;
    fetch(plan, clip, x, y, rgba);
    return rgba[0];
}

static void pixel(const wo_plan *plan, int32_t x, int32_t y, float *out)
{
    const probe_params *const p = &plan->params;
    double sum[4] = {0, 0, 0, 0}, here[4], rgba[4];
    fetch(plan, PROBE_SOURCE, x, y, here);
    for (int32_t j = -plan->ry; j <= plan->ry; j++)
        for (int32_t i = -plan->rx; i <= plan->rx; i++) {
            fetch(plan, PROBE_SOURCE, x + i, y + j, rgba);
            for (int k = 0; k < 4; k++)
                sum[k] += rgba[k];
        }
    const double area = (2.0 * plan->rx + 1) * (2.0 * plan->ry + 1);
    const double mask = single(plan, PROBE_MASK, x, y, 1);
    const double scale = plan->geometry.render_scale;
    const double add[3] = {p->angle / 360 + p->centre[0] * scale / 1000,
                           single(plan, PROBE_DEPTH, x, y, 0) + p->centre[1] * scale / 1000,
                           p->repeats};
    for (int k = 0; k < 3; k++)
        sum[k] = sum[k] / area * p->tint[k] + add[k];
    sum[3] /= area;
    memset(rgba, 0, sizeof rgba);
    if (plan->inputs[PROBE_EXTRA].data)
        fetch(plan, PROBE_EXTRA, x, y, rgba);
    for (int k = 0; k < 4; k++)
        out[k] = (float)((here[k] + (sum[k] - here[k]) * mask) * (1 - rgba[3]) + rgba[k]);
}

typedef struct work {
    const wo_plan *plan;
    const wo_image *output;
    wo_rect window;
    atomic_bool aborted;
    atomic_bool clash; /* of workers */
    atomic_int rows;
} work;

static void pause_a_little(void)
{
    const clock_t start = clock();
    while (clock() - start < CLOCKS_PER_SEC / 1000)
        continue;
}

static void draw_row(work *w, int32_t y)
{
    if (w->plan->params.trouble >= PROBE_TROUBLE_SLOW)
        pause_a_little();
    while (w->plan->params.trouble == PROBE_TROUBLE_WAIT && !wo_aborted(&w->plan->context))
        pause_a_little();
    if (wo_aborted(&w->plan->context)) {
        atomic_store(&w->aborted, true);
        return;
    }
    for (int32_t x = w->window.x1; x < w->window.x2; x++)
        pixel(w->plan, x, y, wo_image_at(w->output, x, y));
    const int done = atomic_fetch_add(&w->rows, 1) + 1;
    if (w->plan->context.progress)
        w->plan->context.progress(w->plan->context.progress_user,
                                  (double)done / wo_rect_height(w->window));
}

static void row(void *job, size_t index, unsigned worker)
{
    work *const w = job;
    if (worker >= w->plan->workers || atomic_exchange(&w->plan->busy[worker], true)) {
        atomic_store(&w->clash, true);
        return;
    }
    if (!atomic_load(&w->aborted))
        draw_row(w, w->window.y1 + (int32_t)index);
    atomic_store(&w->plan->busy[worker], false);
}

static wo_status render(const wo_plan *plan, wo_rect window, const wo_image *output,
                        wo_report *report, wo_error *error)
{
    work w = {.plan = plan, .output = output, .window = window};
    if (!wo_rect_contains(plan->window, window) || !wo_rect_contains(output->bounds, window))
        return wo_fail(error, WO_ERR_ARGUMENT, "the window is not inside the plan");
    if (plan->params.trouble == PROBE_TROUBLE_FAIL)
        return wo_fail(error, WO_ERR_INTERNAL, "trouble was asked for: %s", plan->params.note);
    atomic_init(&w.aborted, false);
    atomic_init(&w.clash, false);
    atomic_init(&w.rows, 0);
    wo_run(&plan->context, row, &w, (size_t)wo_rect_height(window));
    if (atomic_load(&w.clash))
        return wo_fail(error, WO_ERR_INTERNAL, "two calls at once are the same worker");
    if (atomic_load(&w.aborted))
        return WO_ABORTED;
    if (report) {
        wo_report_add(report, &plan->report);
        if (plan->params.trouble == PROBE_TROUBLE_WARN)
            wo_report_warn(report, "probe-rows", "some rows are %s", "odd");
        report->pixels += (int64_t)wo_rect_width(window) * wo_rect_height(window);
        wo_report_leave_out(report, "lens", "this is a box", 1, "lenses");
    }
    return WO_OK;
}

const wo_effect probe_effect = {
    .name = "Probe",
    .label = "Probe",
    .help = "A box blur for tests.",
    .params_size = sizeof(probe_params),
    .params = params,
    .param_count = WO_COUNT(params),
    .groups = groups,
    .group_count = WO_COUNT(groups),
    .clips = clips,
    .clip_count = PROBE_CLIPS,
    .region = region,
    .identity = identity,
    .plan_create = plan_create,
    .plan_print = plan_print,
    .plan_report = plan_report,
    .render = render,
    .plan_destroy = plan_destroy,
};
