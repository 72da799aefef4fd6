/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/hybrid.h"

#include <math.h>
#include <stdatomic.h>

/* Tiles of the frame and of its margin, as far as the picture goes, or the format if the frame lies
   inside it. */
static wo_rect tiles_of(const wo_defocus *scene, const wo_frame *frame)
{
    const wo_rect r = wo_rect_intersect(
        wo_rect_grow(frame->window, WO_HYBRID_MARGIN, WO_HYBRID_MARGIN), scene->extent);
    const wo_rect format = wo_tiles_of(scene->format);
    const wo_rect all = wo_tiles_of(r);
    return wo_rect_contains(format, frame->tiles) ? wo_rect_intersect(all, format) : all;
}

static wo_rect inner_of(const wo_hybrid *h)
{
    const wo_rect t = wo_rect_intersect(wo_tiles_of(h->scene->format), h->tiles);
    enum { ACROSS = WO_TILE_WIDTH / WO_HYBRID_CELL, DOWN = WO_TILE_HEIGHT / WO_HYBRID_CELL };
    return (wo_rect){(t.x1 - h->tiles.x1) * ACROSS, (t.y1 - h->tiles.y1) * DOWN,
                     (t.x2 - h->tiles.x1) * ACROSS, (t.y2 - h->tiles.y1) * DOWN};
}

/* Coverage is the same for all colours if the lens does not part them. */
static bool is_shared(const wo_defocus *scene, int plane)
{
    const int part = plane < WO_HYBRID_REST ? plane % WO_PART_SUMS : 0;
    return !scene->lens->colours && part > WO_PART_COVERAGE && part < WO_PART_BLUR;
}

static wo_status create(const wo_defocus *scene, const wo_frame *frame, wo_hybrid *h,
                        wo_error *error)
{
    const wo_context *context = scene->context;
    *h = (wo_hybrid){.scene = scene, .frame = frame, .tiles = tiles_of(scene, frame)};
    h->area = (wo_rect){h->tiles.x1 * WO_TILE_WIDTH, h->tiles.y1 * WO_TILE_HEIGHT,
                        h->tiles.x2 * WO_TILE_WIDTH, h->tiles.y2 * WO_TILE_HEIGHT};
    h->width = wo_rect_width(h->area);
    h->columns = wo_rect_width(h->area) / WO_HYBRID_CELL;
    h->rows = wo_rect_height(h->area) / WO_HYBRID_CELL;
    h->inner = inner_of(h);
    const size_t pixels = (size_t)h->width * (size_t)wo_rect_height(h->area);
    const size_t tiles = (size_t)wo_rect_width(h->tiles) * (size_t)wo_rect_height(h->tiles);
    const bool lit = scene->highlights && scene->highlights->count > 0;
    const int used = lit ? WO_HYBRID_PLANES : WO_HYBRID_LIGHT;
    size_t planes = 0;
    for (int k = 0; k < used; k++)
        planes += !is_shared(scene, k);
    if (!(h->memory = wo_new_large(context, error, pixels, planes * sizeof(float))) ||
        !(h->rays = wo_new(context, error, tiles, sizeof *h->rays)) ||
        !(h->cells =
              wo_new(context, error, (size_t)h->columns * (size_t)h->rows, sizeof *h->cells)))
        return WO_ERR_NOMEM;
    float *next = h->memory;
    for (int k = 0; k < used; k++) {
        h->plane[k] = is_shared(scene, k) ? h->plane[k - 1] : next;
        next += is_shared(scene, k) ? 0 : pixels;
    }
    wo_hybrid_kernels(h->kernels);
    return WO_OK;
}

static void destroy(wo_hybrid *h)
{
    const wo_context *context = h->scene->context;
    wo_delete(context, h->memory);
    wo_delete(context, h->rays);
    wo_delete(context, h->cells);
}

/* Is the tile, or one beside it, looked at by anybody? */
static bool wanted(const wo_hybrid *h, int32_t tx, int32_t ty)
{
    const wo_frame *frame = h->frame;
    if (!frame->skip)
        return true;
    for (int32_t y = ty - 3; y <= ty + 3; y++) {
        for (int32_t x = tx - 1; x <= tx + 1; x++) {
            const bool known = x >= frame->tiles.x1 && x < frame->tiles.x2 &&
                               y >= frame->tiles.y1 && y < frame->tiles.y2;
            if (known &&
                !frame->skip[(size_t)(y - frame->tiles.y1) * (size_t)wo_rect_width(frame->tiles) +
                             (size_t)(x - frame->tiles.x1)])
                return true;
        }
    }
    return false;
}

/* Part of the work that tracing is, for progress. */
#define TRACED 0.9

typedef struct trace_job {
    wo_hybrid *hybrid;
    wo_report *parts; /* [workers] */
    atomic_bool stop;
    atomic_llong done;
} trace_job;

static void trace_tile(void *user, size_t index, unsigned worker)
{
    trace_job *job = user;
    wo_hybrid *h = job->hybrid;
    const int32_t columns = wo_rect_width(h->tiles);
    const int32_t tx = h->tiles.x1 + (int32_t)(index % (size_t)columns);
    const int32_t ty = h->tiles.y1 + (int32_t)(index / (size_t)columns);
    if (atomic_load_explicit(&job->stop, memory_order_relaxed) || !wanted(h, tx, ty))
        return;
    if (!wo_hybrid_trace(h, tx, ty, &job->parts[worker])) {
        atomic_store(&job->stop, true);
        return;
    }
    const wo_context *context = h->scene->context;
    const long long total = (long long)columns * wo_rect_height(h->tiles);
    const long long done = atomic_fetch_add(&job->done, 1) + 1;
    if (context->progress && done * 100 / total != (done - 1) * 100 / total)
        context->progress(context->progress_user, TRACED * (double)done / (double)total);
}

static wo_status trace(wo_hybrid *h, wo_report *report, wo_error *error)
{
    const wo_context *context = h->scene->context;
    const unsigned workers = wo_workers(context);
    trace_job job = {.hybrid = h};
    job.parts = wo_new(context, error, workers, sizeof *job.parts);
    if (!job.parts)
        return WO_ERR_NOMEM;
    wo_run(context, trace_tile, &job,
           (size_t)wo_rect_width(h->tiles) * (size_t)wo_rect_height(h->tiles));
    for (unsigned i = 0; i < workers; i++)
        wo_report_add(report, &job.parts[i]);
    wo_delete(context, job.parts);
    return atomic_load(&job.stop) ? wo_fail(error, WO_ABORTED, "stopped by the user") : WO_OK;
}

static void choose_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    wo_hybrid_choose(user, (int32_t)index);
}

static bool join_tile(void *user, int32_t tx, int32_t ty, unsigned worker, wo_tile_pixels *pixels,
                      wo_tile_facts *facts, wo_report *part)
{
    (void)worker;
    const wo_hybrid *h = user;
    if (wo_aborted(h->scene->context))
        return false;
    part->tiles[wo_lens_rays_at(h->scene->rays, tx, ty)->class]++;
    wo_hybrid_join(h, tx, ty, pixels, facts);
    return true;
}

static wo_status render(const wo_defocus *scene, const wo_frame *frame, wo_report *report,
                        wo_error *error)
{
    wo_hybrid h;
    wo_status status = create(scene, frame, &h, error);
    if (status == WO_OK)
        status = trace(&h, report, error);
    if (status == WO_OK) {
        wo_run(scene->context, choose_row, &h, (size_t)h.rows);
        status = wo_frame_tiles(scene, frame, TRACED, 1, join_tile, &h, report, error);
    }
    destroy(&h);
    return status;
}

const wo_renderer wo_render_hybrid = {.key = "hybrid",
                                      .label = "Hybrid",
                                      .estimates = true,
                                      .margin = WO_HYBRID_MARGIN,
                                      .render = render};
