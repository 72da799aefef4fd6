/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "effects/lens_blur_focus.h"
#include "effects/lens_blur_plan.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

/* One layer without blur is the source itself: no sheets, no stack, no rays. Told from its depth
   before anything is loaded; the first blurred pixel ends the search. */
typedef struct search_job {
    const wo_plan *plan;
    wo_sheet_source source;
    double px; /* px per dioptre */
    wo_rect area;
    atomic_bool blurred;
    atomic_llong sanitised, clamped;
} search_job;

static bool is_sharp(const search_job *job, double v)
{
    const wo_sheet_source *s = &job->source;
    v = fmin(fmax(v - s->v_origin, s->v_min), s->v_max);
    return fabs(v) * job->px < WO_SHARP_PX;
}

/* Loops over so many floats side by side become vectors. */
enum { LANES = 16 };

/* Least and greatest of samples, stride apart; false when one is not a positive number. */
static bool range_of(const float *p, int32_t count, int stride, float range[2])
{
    float low[LANES];
    float high[LANES];
    int bad[LANES];
    for (int k = 0; k < LANES; k++) {
        low[k] = high[k] = *p;
        bad[k] = !(*p > 0);
    }
    int32_t i = 0;
    for (; stride == 1 && i + LANES <= count; i += LANES)
        for (int k = 0; k < LANES; k++) {
            const float x = p[i + k];
            low[k] = x < low[k] ? x : low[k];
            high[k] = x > high[k] ? x : high[k];
            bad[k] |= !(x > 0);
        }
    for (; i < count; i++) {
        const float x = p[i * stride];
        low[0] = x < low[0] ? x : low[0];
        high[0] = x > high[0] ? x : high[0];
        bad[0] |= !(x > 0);
    }
    for (int k = 1; k < LANES; k++) {
        low[0] = fminf(low[0], low[k]);
        high[0] = fmaxf(high[0], high[k]);
        bad[0] |= bad[k];
    }
    range[0] = low[0];
    range[1] = high[0];
    return !bad[0] && isfinite(high[0]);
}

/* Vergence is monotonic in positive samples, so the ends of a row's range speak for all of it. */
static bool row_is_sharp(const search_job *job, int32_t y)
{
    const wo_sheet_source *s = &job->source;
    const wo_image *depth = s->depth;
    const int last = depth->components - 1;
    const int32_t left = job->area.x1 > depth->bounds.x1 ? job->area.x1 : depth->bounds.x1;
    const int32_t right = job->area.x2 < depth->bounds.x2 ? job->area.x2 : depth->bounds.x2;
    float range[2];
    if (s->reading.mode == WO_DEPTH_RAY || left >= right || y < depth->bounds.y1 ||
        y >= depth->bounds.y2 ||
        !range_of(wo_image_at(depth, left, y) + (s->depth_channel < last ? s->depth_channel : last),
                  right - left, depth->components, range))
        return false;
    for (int i = 0; i < 2; i++) {
        bool valid;
        const double v = wo_depth_vergence(&s->reading, (double)range[i], 1, &valid);
        if (!valid || !is_sharp(job, v) || v - s->v_origin < s->v_min || v - s->v_origin > s->v_max)
            return false;
    }
    return true;
}

static void search_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    search_job *job = user;
    const wo_sheet_source *s = &job->source;
    const wo_rect window = job->plan->window;
    const int32_t y = job->area.y1 + (int32_t)index;
    if (atomic_load_explicit(&job->blurred, memory_order_relaxed) || row_is_sharp(job, y))
        return;
    for (int32_t x = job->area.x1; x < job->area.x2; x++) {
        bool valid;
        float c[4];
        const double v = wo_read_vergence(s, x, y, &valid);
        const bool inside = v - s->v_origin >= s->v_min && v - s->v_origin <= s->v_max;
        if (valid && inside && is_sharp(job, v))
            continue;
        wo_read_colour(s->colour, s->alpha, x, y, c);
        if (c[0] == 0 && c[1] == 0 && c[2] == 0 && c[3] == 0)
            continue;
        if (!is_sharp(job, v)) {
            atomic_store(&job->blurred, true);
            return;
        }
        if (x >= window.x1 && x < window.x2 && y >= window.y1 && y < window.y2) {
            atomic_fetch_add(&job->sanitised, !valid);
            atomic_fetch_add(&job->clamped, !inside);
        }
    }
}

void wo_lens_blur_find_copy(wo_plan *plan, const wo_plan_args *args)
{
    const wo_lens_blur_setup *setup = &plan->setup;
    const wo_lens_blur_params *params = &plan->params;
    const wo_rect seen = wo_lens_blur_stack_area(setup, plan->window, setup->reach);
    if (params->output != WO_OUTPUT_IMAGE || params->method == WO_METHOD_REFERENCE ||
        setup->layers != 1 || wo_lens_blur_has_table(params) ||
        !wo_lens_blur_focus_is_plain(params, setup->focus_map) || !plan->focus.flat)
        return;
    search_job job = {
        .plan = plan,
        .source = wo_lens_blur_layer(plan, args, 0),
        .px = setup->lens.k * fmax(1, plan->geometry.pixel_stretch),
        .area = wo_rect_intersect(seen, plan->geometry.extent),
    };
    const double start = wo_seconds();
    atomic_init(&job.blurred, false);
    atomic_init(&job.sanitised, 0);
    atomic_init(&job.clamped, 0);
    if (job.source.depth && job.source.depth->data)
        wo_run(&plan->context, search_row, &job, (size_t)wo_rect_height(job.area));
    else
        atomic_store(&job.blurred, !is_sharp(&job, 0));
    plan->copy = !atomic_load(&job.blurred);
    plan->report.seconds[WO_STAGE_PLAN] += wo_seconds() - start;
    if (!plan->copy)
        return;
    plan->report.sanitised_depth = atomic_load(&job.sanitised);
    plan->report.clamped_radius = atomic_load(&job.clamped);
}

typedef struct copy_job {
    const wo_plan *plan;
    wo_rect window;
    const wo_image *output;
    atomic_llong sanitised;
} copy_job;

static void copy_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    copy_job *job = user;
    const wo_plan *plan = job->plan;
    const wo_rect r = job->window;
    const int32_t y = r.y1 + (int32_t)index;
    float *to = wo_image_at(job->output, r.x1, y);
    if (wo_row_is_plain(&plan->source, plan->source_alpha, r.x1, r.x2, y)) {
        memcpy(to, wo_image_at(&plan->source, r.x1, y), (size_t)wo_rect_width(r) * 4 * sizeof *to);
        return;
    }
    int64_t sanitised = 0;
    for (int32_t x = r.x1; x < r.x2; x++, to += 4)
        sanitised += wo_read_colour(&plan->source, plan->source_alpha, x, y, to);
    atomic_fetch_add(&job->sanitised, sanitised);
}

wo_status wo_lens_blur_copy(const wo_plan *plan, wo_rect window, const wo_image *output,
                            wo_report *report, wo_error *error)
{
    copy_job job = {.plan = plan, .window = window, .output = output};
    const double start = wo_seconds();
    atomic_init(&job.sanitised, 0);
    if (wo_aborted(&plan->context))
        return wo_fail(error, WO_ABORTED, "stopped by the user");
    wo_run(&plan->context, copy_row, &job, (size_t)wo_rect_height(window));
    if (!report)
        return WO_OK;
    wo_report part = plan->report;
    const wo_rect tiles = wo_tiles_of(window);
    part.seconds[WO_STAGE_RENDER] = wo_seconds() - start;
    part.pixels = (int64_t)wo_rect_width(window) * wo_rect_height(window);
    part.tiles[WO_TILE_SHARP] = (int64_t)wo_rect_width(tiles) * wo_rect_height(tiles);
    part.sanitised_colour = atomic_load(&job.sanitised);
    wo_lens_blur_warn_of_colour(&part);
    if (wo_renderer_of((wo_method)plan->params.method)->estimates)
        part.error_pixels[WO_TILE_SHARP] = part.pixels; /* and no error in them */
    const int rays = plan->quality.adaptive ? plan->quality.max_rays : plan->quality.samples;
    wo_report_leave_out(&part, "everything", "all in focus: the source is copied",
                        (double)rays * (double)part.pixels, "rays");
    wo_report_add(report, &part);
    return WO_OK;
}
