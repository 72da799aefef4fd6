/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "effects/lens_blur_plan.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

/* A guess counts as visible above this fraction of a pixel's light. */
#define GUESS_VISIBLE (1.0f / 255)
/* Fractions are summed as whole numbers, so that the order of tiles does not matter. */
#define GUESS_UNIT 1e6

typedef struct render_job {
    const wo_plan *plan;
    wo_rect window;
    wo_rect tiles;
    const wo_image *output;
    atomic_bool stop;
    atomic_llong done;
    atomic_llong rays, steps;
    atomic_llong guessed, guessed_pixels;
    atomic_llong unmasked; /* tiles whose mask is zero */
    atomic_llong tile[WO_TILE_CLASS_COUNT];
} render_job;

static float mask_at(const wo_plan *plan, int32_t x, int32_t y)
{
    const wo_image *m = &plan->mask;
    if (x < m->bounds.x1 || x >= m->bounds.x2 || y < m->bounds.y1 || y >= m->bounds.y2)
        return 0;
    const float value = wo_image_at(m, x, y)[m->components == 4 ? 3 : 0];
    return value >= 0 ? fminf(value, 1) : 0;
}

static bool tile_masked_out(const render_job *job, wo_rect r)
{
    for (int32_t y = r.y1; y < r.y2; y++)
        for (int32_t x = r.x1; x < r.x2; x++)
            if (mask_at(job->plan, x, y) > 0)
                return false;
    return true;
}

static void write_image(const render_job *job, wo_rect tile, wo_rect r,
                        const wo_tile_pixels *pixels)
{
    const wo_plan *plan = job->plan;
    for (int32_t y = r.y1; y < r.y2; y++) {
        float *to = wo_image_at(job->output, r.x1, y);
        for (int32_t x = r.x1; x < r.x2; x++, to += 4) {
            const float *c = pixels->c[y - tile.y1][x - tile.x1];
            const float mix = plan->setup.mask_used ? mask_at(plan, x, y) : 1;
            float source[4] = {0};
            if (mix < 1)
                wo_read_colour(&plan->source, plan->source_alpha, x, y, source);
            for (int k = 0; k < 4; k++)
                to[k] = mix < 1 ? source[k] + mix * (c[k] - source[k]) : c[k];
        }
    }
}

static float nearest_surface(const wo_stack *stack, int32_t x, int32_t y)
{
    const ptrdiff_t at = wo_stack_at(stack, x, y);
    float v = NAN;
    for (int s = 0; s < stack->sheets; s++)
        if (!stack->guessed[s] && stack->v[s][at] == stack->v[s][at] && !(stack->v[s][at] <= v))
            v = stack->v[s][at];
    return v;
}

/* The views other than the image: one number in r, g, b. */
static void write_view(const render_job *job, const wo_ray_tile *tile, wo_rect r)
{
    const wo_plan *plan = job->plan;
    for (int32_t y = r.y1; y < r.y2; y++) {
        float *to = wo_image_at(job->output, r.x1, y);
        for (int32_t x = r.x1; x < r.x2; x++, to += 4) {
            const float v = nearest_surface(&plan->stack, x, y);
            const double absolute = (double)v + plan->setup.lens.vf;
            double value = 0;
            if (plan->params.output == WO_OUTPUT_COC)
                value = isnan(v) ? 0 : plan->setup.lens.k * (double)v;
            else if (plan->params.output == WO_OUTPUT_DEPTH)
                value = absolute > 1e-9 ? 1 / absolute : 0;
            else if (tile->class == WO_TILE_SHARP)
                value = 1;
            else if (tile->class != WO_TILE_EMPTY)
                value = plan->params.samples;
            to[0] = to[1] = to[2] = (float)value;
            to[3] = 1;
        }
    }
}

static void render_tile(void *user, size_t index, unsigned worker)
{
    (void)worker;
    render_job *job = user;
    const wo_plan *plan = job->plan;
    if (atomic_load_explicit(&job->stop, memory_order_relaxed))
        return;
    const int32_t columns = wo_rect_width(job->tiles);
    const int32_t tx = job->tiles.x1 + (int32_t)(index % (size_t)columns);
    const int32_t ty = job->tiles.y1 + (int32_t)(index / (size_t)columns);
    const wo_rect tile = {tx * WO_TILE_WIDTH, ty * WO_TILE_HEIGHT, (tx + 1) * WO_TILE_WIDTH,
                          (ty + 1) * WO_TILE_HEIGHT};
    const wo_rect r = wo_rect_intersect(tile, job->window);
    wo_tile_pixels pixels;
    wo_report part = {0};
    if (plan->params.output != WO_OUTPUT_IMAGE) {
        write_view(job, wo_lens_rays_at(&plan->rays, tx, ty), r);
    } else if (plan->setup.mask_used && tile_masked_out(job, r)) {
        memset(&pixels, 0, sizeof pixels);
        write_image(job, tile, r, &pixels);
        atomic_fetch_add(&job->unmasked, 1);
    } else {
        if (!wo_lens_rays_tile(&plan->rays, &plan->context, tx, ty, &pixels, &part)) {
            atomic_store(&job->stop, true);
            return;
        }
        write_image(job, tile, r, &pixels);
        double guessed = 0;
        for (int32_t y = r.y1; y < r.y2; y++)
            for (int32_t x = r.x1; x < r.x2; x++) {
                const float g = pixels.guessed[y - tile.y1][x - tile.x1];
                guessed += (double)g;
                part.guessed_pixels += g > GUESS_VISIBLE;
            }
        atomic_fetch_add(&job->guessed, (long long)(guessed * GUESS_UNIT));
        atomic_fetch_add(&job->guessed_pixels, (long long)part.guessed_pixels);
        atomic_fetch_add(&job->rays, (long long)part.rays);
        atomic_fetch_add(&job->steps, (long long)part.steps);
        for (int i = 0; i < WO_TILE_CLASS_COUNT; i++)
            atomic_fetch_add(&job->tile[i], (long long)part.tiles[i]);
    }
    const long long total = (long long)columns * wo_rect_height(job->tiles);
    const long long done = atomic_fetch_add(&job->done, 1) + 1;
    if (plan->context.progress && (done * 100 / total != (done - 1) * 100 / total))
        plan->context.progress(plan->context.progress_user, (double)done / (double)total);
}

static void clear_outside(const wo_image *output, wo_rect window, wo_rect inside)
{
    for (int32_t y = window.y1; y < window.y2; y++) {
        float *to = wo_image_at(output, window.x1, y);
        for (int32_t x = window.x1; x < window.x2; x++, to += 4)
            if (x < inside.x1 || x >= inside.x2 || y < inside.y1 || y >= inside.y2)
                memset(to, 0, 4 * sizeof *to);
    }
}

static void fill_report(const render_job *job, double seconds, wo_report *report)
{
    const wo_plan *plan = job->plan;
    wo_report part = plan->report;
    const int64_t pixels =
        (int64_t)wo_rect_width(job->window) * (int64_t)wo_rect_height(job->window);
    part.seconds[WO_STAGE_RENDER] = seconds;
    part.pixels = pixels;
    part.rays = atomic_load(&job->rays);
    part.steps = atomic_load(&job->steps);
    for (int i = 0; i < WO_TILE_CLASS_COUNT; i++)
        part.tiles[i] = atomic_load(&job->tile[i]);
    part.guessed =
        pixels > 0 ? (double)atomic_load(&job->guessed) / GUESS_UNIT / (double)pixels : 0;
    part.guessed_pixels = atomic_load(&job->guessed_pixels);
    for (int32_t ty = job->tiles.y1; ty < job->tiles.y2; ty++)
        for (int32_t tx = job->tiles.x1; tx < job->tiles.x2; tx++)
            part.largest_radius =
                fmax(part.largest_radius, (double)wo_lens_rays_at(&plan->rays, tx, ty)->reach);
    const double tile_rays = (double)plan->params.samples * WO_TILE_WIDTH * WO_TILE_HEIGHT;
    if (part.tiles[WO_TILE_EMPTY] > 0)
        wo_report_leave_out(&part, "rays of empty tiles", "nothing is there",
                            tile_rays * (double)part.tiles[WO_TILE_EMPTY], "rays");
    if (part.tiles[WO_TILE_SHARP] > 0 && plan->params.samples > 1)
        wo_report_leave_out(&part, "rays of sharp tiles", "no blur: one ray a pixel",
                            tile_rays * (1 - 1.0 / plan->params.samples) *
                                (double)part.tiles[WO_TILE_SHARP],
                            "rays");
    if (part.tiles[WO_TILE_SINGLE] > 0)
        wo_report_leave_out(&part, "marching in tiles of one depth", "one lookup a ray is exact",
                            (double)part.tiles[WO_TILE_SINGLE], "tiles");
    if (atomic_load(&job->unmasked) > 0)
        wo_report_leave_out(&part, "tiles outside the mask", "the source shows",
                            (double)atomic_load(&job->unmasked), "tiles");
    wo_report_add(report, &part);
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
    const double start = wo_seconds();
    render_job job = {
        .plan = plan, .window = inside, .tiles = wo_tiles_of(inside), .output = output};
    wo_run(&plan->context, render_tile, &job,
           (size_t)wo_rect_width(job.tiles) * (size_t)wo_rect_height(job.tiles));
    if (atomic_load(&job.stop))
        return wo_fail(error, WO_ABORTED, "stopped by the user");
    if (report)
        fill_report(&job, wo_seconds() - start, report);
    return WO_OK;
}
