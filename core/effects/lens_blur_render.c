/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "effects/lens_blur_views.h"

#include <math.h>
#include <string.h>

/* A guess counts as visible above this fraction of a pixel's light. */
#define GUESS_VISIBLE (1.0f / 255)

static float mask_at(const wo_plan *plan, int32_t x, int32_t y)
{
    const wo_image *m = &plan->mask;
    if (x < m->bounds.x1 || x >= m->bounds.x2 || y < m->bounds.y1 || y >= m->bounds.y2)
        return 0;
    const float value = wo_image_at(m, x, y)[m->components == 4 ? 3 : 0];
    return value >= 0 ? fminf(value, 1) : 0;
}

static bool masked_out(const wo_plan *plan, wo_rect r)
{
    for (int32_t y = r.y1; y < r.y2; y++)
        for (int32_t x = r.x1; x < r.x2; x++)
            if (mask_at(plan, x, y) > 0)
                return false;
    return true;
}

/* A render on its way: the frame and the memory behind it. */
typedef struct render_job {
    const wo_plan *plan;
    const wo_view *view;
    const wo_image *output;
    wo_frame frame;
    uint8_t *skip;
    int64_t skipped;
} render_job;

static void skip_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    render_job *job = user;
    const wo_rect tiles = job->frame.tiles;
    const int32_t low = (tiles.y1 + (int32_t)index) * WO_TILE_HEIGHT;
    for (int32_t tx = tiles.x1; tx < tiles.x2; tx++) {
        const wo_rect tile = {tx * WO_TILE_WIDTH, low, (tx + 1) * WO_TILE_WIDTH,
                              low + WO_TILE_HEIGHT};
        job->skip[index * (size_t)wo_rect_width(tiles) + (size_t)(tx - tiles.x1)] =
            masked_out(job->plan, wo_rect_intersect(tile, job->frame.window));
    }
}

static wo_status make_frame(render_job *job, const wo_renderer *renderer, wo_error *error)
{
    const wo_context *context = &job->plan->context;
    wo_frame *frame = &job->frame;
    const int output = job->plan->params.output;
    const size_t w = (size_t)wo_rect_width(frame->window);
    const size_t h = (size_t)wo_rect_height(frame->window);
    if (!(frame->c = wo_new_large(context, error, w * h, sizeof *frame->c)) ||
        !(frame->guessed = wo_new_large(context, error, w * h, sizeof *frame->guessed)))
        return WO_ERR_NOMEM;
    if (output == WO_OUTPUT_RAYS &&
        !(frame->rays = wo_new_large(context, error, w * h, sizeof *frame->rays)))
        return WO_ERR_NOMEM;
    if (output == WO_OUTPUT_MASK &&
        !(frame->mask = wo_new_large(context, error, w * h, sizeof *frame->mask)))
        return WO_ERR_NOMEM;
    if ((renderer->estimates || output == WO_OUTPUT_ERROR) &&
        !(frame->error = wo_new_large(context, error, w * h, sizeof *frame->error)))
        return WO_ERR_NOMEM;
    if (job->plan->setup.mask_used) {
        const size_t tiles =
            (size_t)wo_rect_width(frame->tiles) * (size_t)wo_rect_height(frame->tiles);
        if (!(job->skip = wo_new(context, error, tiles, sizeof *job->skip)))
            return WO_ERR_NOMEM;
        wo_run(context, skip_row, job, (size_t)wo_rect_height(frame->tiles));
        for (size_t i = 0; i < tiles; i++)
            job->skipped += job->skip[i];
        frame->skip = job->skip;
    }
    return WO_OK;
}

static void destroy_frame(render_job *job)
{
    const wo_context *context = &job->plan->context;
    wo_delete(context, job->frame.c);
    wo_delete(context, job->frame.guessed);
    wo_delete(context, job->frame.rays);
    wo_delete(context, job->frame.mask);
    wo_delete(context, job->frame.error);
    wo_delete(context, job->skip);
}

static void write_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const render_job *job = user;
    const wo_plan *plan = job->plan;
    const wo_rect r = job->frame.window;
    const int32_t y = r.y1 + (int32_t)index;
    float *to = wo_image_at(job->output, r.x1, y);
    for (int32_t x = r.x1; x < r.x2; x++, to += 4) {
        float c[4];
        job->view->pixel(plan, job->frame.c ? &job->frame : NULL, x, y, c);
        const float mix = plan->params.output == WO_OUTPUT_IMAGE && plan->setup.mask_used
                              ? mask_at(plan, x, y)
                              : 1;
        float source[4] = {0};
        if (mix < 1)
            wo_read_colour(&plan->source, plan->source_alpha, x, y, source);
        for (int k = 0; k < 4; k++)
            to[k] = mix < 1 ? source[k] + mix * (c[k] - source[k]) : c[k];
    }
}

static void clear_outside(const wo_image *output, wo_rect window, wo_rect inside)
{
    if (wo_rect_contains(inside, window))
        return;
    for (int32_t y = window.y1; y < window.y2; y++) {
        float *to = wo_image_at(output, window.x1, y);
        for (int32_t x = window.x1; x < window.x2; x++, to += 4)
            if (x < inside.x1 || x >= inside.x2 || y < inside.y1 || y >= inside.y2)
                memset(to, 0, 4 * sizeof *to);
    }
}

/* What the pixels tell: guessed light, estimated error. In the order of pixels, so that threads
   change nothing. */
static void count_pixels(const render_job *job, wo_report *report)
{
    const wo_frame *frame = &job->frame;
    const wo_rect r = frame->window;
    double guessed = 0;
    for (int32_t y = r.y1; y < r.y2; y++) {
        for (int32_t x = r.x1; x < r.x2; x++) {
            const size_t at = wo_frame_at(frame, x, y);
            guessed += (double)frame->guessed[at];
            report->guessed_pixels += frame->guessed[at] > GUESS_VISIBLE;
        }
        for (int32_t x = r.x1; frame->error && x < r.x2; x++) {
            const float e = frame->error[wo_frame_at(frame, x, y)];
            const wo_rect tile = wo_tiles_of((wo_rect){x, y, x + 1, y + 1});
            const wo_tile_class class = wo_lens_rays_at(&job->plan->rays, tile.x1, tile.y1)->class;
            if (isnan(e))
                continue;
            report->error_pixels[class]++;
            report->square_error[class] += (double)e * (double)e;
        }
    }
    report->guessed = guessed / (double)report->pixels;
}

static void note_tiles(const render_job *job, wo_report *report)
{
    const wo_plan *plan = job->plan;
    const wo_rect tiles = job->frame.tiles;
    int64_t hidden = 0;
    for (int32_t ty = tiles.y1; ty < tiles.y2; ty++) {
        for (int32_t tx = tiles.x1; tx < tiles.x2; tx++) {
            const wo_ray_tile *tile = wo_lens_rays_at(&plan->rays, tx, ty);
            report->largest_radius = fmax(report->largest_radius, (double)tile->reach);
            hidden += tile->hidden;
        }
    }
    const double tile_rays = (double)plan->lens.count * WO_TILE_WIDTH * WO_TILE_HEIGHT;
    const double others = tile_rays * (1 - 1.0 / plan->lens.count);
    if (report->tiles[WO_TILE_EMPTY] > 0)
        wo_report_leave_out(report, "rays of empty tiles", "nothing is there",
                            tile_rays * (double)report->tiles[WO_TILE_EMPTY], "rays");
    if (report->tiles[WO_TILE_SHARP] > 0 && plan->lens.count > 1)
        wo_report_leave_out(report, "rays of sharp tiles", "no blur: one ray a pixel",
                            others * (double)report->tiles[WO_TILE_SHARP], "rays");
    if (report->tiles[WO_TILE_BLACK] > 0 && plan->lens.count > 1)
        wo_report_leave_out(report, "rays of black tiles", "they see nothing else",
                            others * (double)report->tiles[WO_TILE_BLACK], "rays");
    if (report->tiles[WO_TILE_SINGLE] > 0)
        wo_report_leave_out(report, "marching in tiles of one depth", "one lookup a ray is exact",
                            (double)report->tiles[WO_TILE_SINGLE], "tiles");
    if (hidden > 0)
        wo_report_leave_out(report, "layers behind opaque surfaces", "no ray reaches them",
                            (double)hidden, "layers of tiles");
    if (job->skipped > 0)
        wo_report_leave_out(report, "tiles outside the mask", "the source shows",
                            (double)job->skipped, "tiles");
}

static wo_status render_frame(render_job *job, wo_report *report, wo_error *error)
{
    const wo_plan *plan = job->plan;
    const wo_renderer *renderer = wo_renderer_of((wo_method)plan->params.method);
    wo_report part = plan->report;
    const double start = wo_seconds();
    WO_TRY(make_frame(job, renderer, error));
    const wo_defocus scene = {.context = &plan->context,
                              .stack = &plan->stack,
                              .lens = &plan->lens,
                              .levels = plan->level,
                              .level_count = plan->levels,
                              .taps = plan->taps < 0 ? NULL : &plan->level[plan->taps],
                              .highlights = &plan->highlights,
                              .rays = &plan->rays,
                              .extent = plan->geometry.extent,
                              .format = plan->geometry.format,
                              .quality = plan->quality};
    WO_TRY(renderer->render(&scene, &job->frame, &part, error));
    part.seconds[WO_STAGE_RENDER] = wo_seconds() - start;
    part.pixels = (int64_t)wo_rect_width(job->frame.window) * wo_rect_height(job->frame.window);
    if (report) {
        count_pixels(job, &part);
        note_tiles(job, &part);
        wo_report_add(report, &part);
    }
    return WO_OK;
}

wo_status wo_lens_blur_render(const wo_plan *plan, wo_rect window, const wo_image *output,
                              wo_report *report, wo_error *error)
{
    WO_TRY(wo_image_validate(output, "output", error));
    if (!output->data || output->components != 4)
        return wo_fail(error, WO_ERR_ARGUMENT, "the output must be RGBA");
    if (!wo_rect_contains(output->bounds, window))
        return wo_fail(error, WO_ERR_ARGUMENT, "the window reaches beyond the output image");
    const wo_rect inside = wo_rect_intersect(window, plan->geometry.extent);
    if (!wo_rect_contains(plan->window, inside))
        return wo_fail(error, WO_ERR_ARGUMENT, "the window reaches beyond the planned one");
    clear_outside(output, window, inside);
    if (wo_rect_empty(inside))
        return WO_OK;
    if (plan->copy)
        return wo_lens_blur_copy(plan, inside, output, report, error);
    render_job job = {.plan = plan,
                      .view = &wo_views[plan->params.output],
                      .output = output,
                      .frame = {.window = inside, .tiles = wo_tiles_of(inside)}};
    wo_status status = WO_OK;
    if (job.view->rendered)
        status = render_frame(&job, report, error);
    if (status == WO_OK)
        wo_run(&plan->context, write_row, &job, (size_t)wo_rect_height(inside));
    destroy_frame(&job);
    return status;
}
