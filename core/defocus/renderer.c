/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/renderer.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

const wo_renderer *wo_renderer_of(wo_method method)
{
    static const wo_renderer *const renderers[] = {
#define WO_METHOD_ADDRESS(name, renderer) &renderer,
        WO_RENDERER_LIST(WO_METHOD_ADDRESS)
#undef WO_METHOD_ADDRESS
    };
    const unsigned index = (unsigned)method;
    return index < WO_COUNT(renderers) ? renderers[index] : NULL;
}

float wo_display(float x)
{
    if (!(x > 0))
        return 0;
    if (x >= 1)
        return 1;
    return x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1 / 2.4f) - 0.055f;
}

/* Is a tile, or one that it reaches, looked at by anybody? */
static bool wanted(const wo_frame *frame, int32_t tx, int32_t ty, int32_t reach)
{
    const wo_rect tile = wo_tile_rect(tx, ty);
    const wo_rect r =
        wo_rect_intersect(wo_tiles_of(wo_rect_grow(tile, reach, reach)), frame->tiles);
    for (int32_t y = r.y1; y < r.y2; y++)
        for (int32_t x = r.x1; x < r.x2; x++)
            if (!frame->skip[(size_t)(y - frame->tiles.y1) * (size_t)wo_rect_width(frame->tiles) +
                             (size_t)(x - frame->tiles.x1)])
                return true;
    return false;
}

wo_status wo_frame_around(const wo_context *context, const wo_frame *frame, wo_rect window,
                          int32_t reach, unsigned planes, wo_frame *around, wo_error *error)
{
    *around = (wo_frame){.window = window, .tiles = wo_tiles_of(window)};
    const size_t n = (size_t)wo_rect_width(window) * (size_t)wo_rect_height(window);
    const struct {
        unsigned plane;
        float **memory;
    } floats[] = {{WO_FRAME_PIXELS, &around->guessed},
                  {WO_FRAME_RAYS, &around->rays},
                  {WO_FRAME_MASK, &around->mask},
                  {WO_FRAME_ERROR, &around->error}};
    if (planes & WO_FRAME_PIXELS &&
        !(around->c = wo_new_large(context, error, n, sizeof *around->c)))
        return WO_ERR_NOMEM;
    for (size_t i = 0; i < WO_COUNT(floats); i++)
        if (planes & floats[i].plane &&
            !(*floats[i].memory = wo_new_large(context, error, n, sizeof(float))))
            return WO_ERR_NOMEM;
    if (!frame->skip)
        return WO_OK;
    const wo_rect t = around->tiles;
    around->skip = wo_new(context, error, (size_t)wo_rect_width(t) * (size_t)wo_rect_height(t), 1);
    if (!around->skip)
        return WO_ERR_NOMEM;
    size_t i = 0;
    for (int32_t ty = t.y1; ty < t.y2; ty++)
        for (int32_t tx = t.x1; tx < t.x2; tx++)
            around->skip[i++] = !wanted(frame, tx, ty, reach);
    return WO_OK;
}

void wo_frame_destroy(const wo_context *context, wo_frame *around)
{
    wo_delete(context, around->c);
    wo_delete(context, around->guessed);
    wo_delete(context, around->rays);
    wo_delete(context, around->mask);
    wo_delete(context, around->error);
    wo_delete(context, around->skip);
    *around = (wo_frame){0};
}

typedef struct frame_job {
    const wo_defocus *scene;
    const wo_frame *frame;
    wo_tile_function *function;
    void *user;
    double from, to;
    wo_report *parts; /* one for each worker */
    atomic_bool stop;
    atomic_llong done;
} frame_job;

static void put_tile(const wo_frame *frame, int32_t tx, int32_t ty, const wo_tile_pixels *pixels,
                     const wo_tile_facts *facts)
{
    const int32_t left = tx * WO_TILE_WIDTH;
    const int32_t low = ty * WO_TILE_HEIGHT;
    const wo_rect tile = {left, low, left + WO_TILE_WIDTH, low + WO_TILE_HEIGHT};
    const wo_rect r = wo_rect_intersect(tile, frame->window);
    const size_t w = (size_t)wo_rect_width(frame->window);
    const size_t n = (size_t)wo_rect_width(r);
    for (int32_t y = r.y1; y < r.y2; y++) {
        const size_t at = (size_t)(y - frame->window.y1) * w + (size_t)(r.x1 - frame->window.x1);
        const int32_t row = y - low;
        const int32_t x = r.x1 - left;
        if (frame->c) {
            memcpy(frame->c + at, pixels->c[row] + x, n * sizeof frame->c[0]);
            memcpy(frame->guessed + at, pixels->guessed[row] + x, n * sizeof(float));
        }
        if (frame->rays)
            memcpy(frame->rays + at, facts->rays[row] + x, n * sizeof(float));
        if (frame->mask)
            memcpy(frame->mask + at, facts->mask[row] + x, n * sizeof(float));
        if (frame->error)
            memcpy(frame->error + at, facts->error[row] + x, n * sizeof(float));
    }
}

static void run_tile(void *user, size_t index, unsigned worker)
{
    frame_job *job = user;
    const wo_frame *frame = job->frame;
    if (atomic_load_explicit(&job->stop, memory_order_relaxed))
        return;
    const int32_t columns = wo_rect_width(frame->tiles);
    const int32_t tx = frame->tiles.x1 + (int32_t)(index % (size_t)columns);
    const int32_t ty = frame->tiles.y1 + (int32_t)(index / (size_t)columns);
    if (!frame->skip || !frame->skip[index]) {
        wo_tile_pixels pixels;
        wo_tile_facts facts;
        const wo_ray_tile *tile = wo_lens_rays_at(job->scene->rays, tx, ty);
        const float mask = tile->class == WO_TILE_EMPTY || wo_ray_tile_straight(tile) ? 0 : 1;
        for (int32_t i = 0; i < WO_TILE_HEIGHT * WO_TILE_WIDTH; i++)
            facts.mask[i / WO_TILE_WIDTH][i % WO_TILE_WIDTH] = mask;
        if (!job->function(job->user, tx, ty, worker, &pixels, &facts, &job->parts[worker])) {
            atomic_store(&job->stop, true);
            return;
        }
        put_tile(frame, tx, ty, &pixels, &facts);
    }
    const wo_context *context = job->scene->context;
    const long long total = (long long)columns * wo_rect_height(frame->tiles);
    const long long done = atomic_fetch_add(&job->done, 1) + 1;
    if (context->progress && done * 100 / total != (done - 1) * 100 / total)
        context->progress(context->progress_user,
                          job->from + (job->to - job->from) * (double)done / (double)total);
}

wo_status wo_frame_tiles(const wo_defocus *scene, const wo_frame *frame, double from, double to,
                         wo_tile_function *function, void *user, wo_report *report, wo_error *error)
{
    const wo_context *context = scene->context;
    const unsigned workers = wo_workers(context);
    frame_job job = {.scene = scene,
                     .frame = frame,
                     .function = function,
                     .user = user,
                     .from = from,
                     .to = to,
                     .parts = wo_new(context, error, workers, sizeof *job.parts)};
    if (!job.parts)
        return WO_ERR_NOMEM;
    wo_run(context, run_tile, &job,
           (size_t)wo_rect_width(frame->tiles) * (size_t)wo_rect_height(frame->tiles));
    for (unsigned i = 0; i < workers; i++)
        wo_report_add(report, &job.parts[i]);
    wo_delete(context, job.parts);
    return atomic_load(&job.stop) ? wo_fail(error, WO_ABORTED, "stopped by the user") : WO_OK;
}

bool wo_tile_find_light(const wo_defocus *scene, int32_t tx, int32_t ty, wo_tile_light light,
                        wo_report *part)
{
    memset(light, 0, sizeof(wo_tile_light));
    const wo_ray_tile *tile = wo_lens_rays_at(scene->rays, tx, ty);
    if (!scene->highlights || scene->highlights->count == 0 || tile->class == WO_TILE_EMPTY)
        return false;
    const wo_rect rect = wo_tile_rect(tx, ty);
    const int64_t rays =
        wo_highlights_add(scene->highlights, scene->stack, scene->lens, rect, tile->v_near, light);
    part->rays += rays;
    return rays > 0;
}

void wo_tile_add_light(wo_tile_pixels *pixels, wo_tile_light light)
{
    for (int32_t y = 0; y < WO_TILE_HEIGHT; y++)
        for (int32_t x = 0; x < WO_TILE_WIDTH; x++)
            for (int k = 0; k < 3; k++)
                pixels->c[y][x][k] += light[y][x][k];
}

void wo_tile_highlights(const wo_defocus *scene, int32_t tx, int32_t ty, wo_tile_pixels *pixels,
                        wo_report *part)
{
    wo_tile_light light;
    if (wo_tile_find_light(scene, tx, ty, light, part))
        wo_tile_add_light(pixels, light);
}
