/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/filter_frame.h"
#include "defocus/hybrid.h"

#include <math.h>
#include <string.h>

enum {
    CELL = WO_HYBRID_CELL,
    ACROSS = WO_TILE_WIDTH / CELL, /* cells of a tile, which is one cell high */
    /* px that a pixel's cell, and those around, go beyond it. */
    LEAN_AROUND = 2 * CELL - 1,
    /* Few taps leave noise that the rays would have to mend; on footage 64 leave a tenth more. */
    TAPS = 256
};

/* Parts of the work that are done when the picture is filtered, traced, smoothed. */
#define FILTERED 0.15
#define TRACED   0.9
#define SMOOTHED 0.95

typedef struct hybrid_job {
    const wo_defocus *scene;
    wo_hybrid rays;
    wo_frame traced;             /* tiles alone */
    wo_frame filtered, smoothed; /* of whole cells */
    wo_rect cells;               /* the same, absolute */
    wo_rect format;              /* in cells */
    wo_hybrid_lean *lean;        /* [cells] */
} hybrid_job;

static wo_rect in_cells(wo_rect r)
{
    return (wo_rect){wo_floor_div(r.x1, CELL), wo_floor_div(r.y1, CELL),
                     wo_floor_div(r.x2 - 1, CELL) + 1, wo_floor_div(r.y2 - 1, CELL) + 1};
}

static wo_rect in_px(wo_rect cells)
{
    return (wo_rect){cells.x1 * CELL, cells.y1 * CELL, cells.x2 * CELL, cells.y2 * CELL};
}

static wo_rect tiles_in_px(wo_rect tiles)
{
    return (wo_rect){tiles.x1 * WO_TILE_WIDTH, tiles.y1 * WO_TILE_HEIGHT, tiles.x2 * WO_TILE_WIDTH,
                     tiles.y2 * WO_TILE_HEIGHT};
}

/* Coverage is the same for all colours if the lens does not part them. */
static bool is_shared(const wo_defocus *scene, int plane)
{
    const int part = plane < WO_HYBRID_REST ? plane % WO_PART_SUMS : 0;
    return !scene->lens->colours && part > WO_PART_COVERAGE && part < WO_PART_BLUR;
}

static wo_status create_rays(const wo_defocus *scene, wo_rect tiles, wo_hybrid *h, wo_error *error)
{
    const wo_context *context = scene->context;
    *h = (wo_hybrid){.scene = scene, .tiles = tiles, .area = tiles_in_px(tiles)};
    h->width = wo_rect_width(h->area);
    h->columns = wo_rect_width(h->area) / CELL;
    h->rows = wo_rect_height(h->area) / CELL;
    const wo_rect t = wo_rect_intersect(wo_tiles_of(scene->format), tiles);
    h->inner = (wo_rect){(t.x1 - tiles.x1) * ACROSS, t.y1 - tiles.y1, (t.x2 - tiles.x1) * ACROSS,
                         t.y2 - tiles.y1};
    const size_t pixels = (size_t)h->width * (size_t)wo_rect_height(h->area);
    const size_t tile_count = (size_t)wo_rect_width(tiles) * (size_t)wo_rect_height(tiles);
    const bool lit = scene->highlights && scene->highlights->count > 0;
    const int used = lit ? WO_HYBRID_PLANES : WO_HYBRID_LIGHT;
    size_t planes = 0;
    for (int k = 0; k < used; k++)
        planes += !is_shared(scene, k);
    if (!(h->memory = wo_new_large(context, error, pixels, planes * sizeof(float))) ||
        !(h->rays = wo_new(context, error, tile_count, sizeof *h->rays)) ||
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

/* Cells of the frame and those around; tiles that must be traced for them. A render that lies
   inside the format looks at nothing beyond it, others as far as the picture goes. */
static wo_status create(const wo_defocus *scene, const wo_frame *frame, hybrid_job *job,
                        wo_error *error)
{
    const wo_context *context = scene->context;
    const wo_rect format = wo_tiles_of(scene->format);
    const wo_rect own = in_cells(frame->window);
    job->scene = scene;
    job->format = in_cells(tiles_in_px(format));
    const wo_rect all = wo_rect_contains(format, frame->tiles)
                            ? format
                            : wo_tiles_of(wo_rect_union(scene->extent, frame->window));
    job->cells = wo_rect_intersect(wo_rect_grow(own, 1, 1), in_cells(tiles_in_px(all)));
    const wo_rect window = in_px(job->cells);
    const wo_rect tiles = wo_rect_intersect(
        wo_tiles_of(wo_rect_grow(window, WO_HYBRID_AROUND, WO_HYBRID_AROUND)), all);
    WO_TRY(wo_frame_around(context, frame, tiles_in_px(tiles), LEAN_AROUND + WO_HYBRID_AROUND, 0,
                           &job->traced, error));
    WO_TRY(wo_frame_around(context, frame, window, LEAN_AROUND, WO_FRAME_PIXELS | WO_FRAME_MASK,
                           &job->filtered, error));
    WO_TRY(wo_frame_around(context, frame, window, LEAN_AROUND,
                           WO_FRAME_PIXELS | WO_FRAME_MASK | WO_FRAME_RAYS, &job->smoothed, error));
    const size_t cells = (size_t)wo_rect_width(job->cells) * (size_t)wo_rect_height(job->cells);
    if (!(job->lean = wo_new(context, error, cells, sizeof *job->lean)))
        return WO_ERR_NOMEM;
    return create_rays(scene, tiles, &job->rays, error);
}

static void destroy(hybrid_job *job)
{
    const wo_context *context = job->scene->context;
    wo_frame_destroy(context, &job->traced);
    wo_frame_destroy(context, &job->filtered);
    wo_frame_destroy(context, &job->smoothed);
    wo_delete(context, job->lean);
    wo_delete(context, job->rays.memory);
    wo_delete(context, job->rays.rays);
    wo_delete(context, job->rays.cells);
}

static void tell_filtered(void *user, double fraction)
{
    const wo_context *context = user;
    context->progress(context->progress_user, FILTERED * fraction);
}

/* The picture of the filter. Its rays and lookups count; tiles are counted once, with the rays. */
static wo_status filter(hybrid_job *job, wo_report *report, wo_error *error)
{
    wo_context outside = *job->scene->context;
    wo_context context = outside;
    if (outside.progress) {
        context.progress = tell_filtered;
        context.progress_user = &outside;
    }
    wo_defocus scene = *job->scene;
    scene.context = &context;
    scene.lens = scene.taps;
    scene.highlights = NULL;
    scene.quality.adaptive = false;
    wo_report part = {0};
    const wo_status status = wo_filter_frame(&scene, &job->filtered, false, &part, error);
    report->rays += part.rays;
    report->steps += part.steps;
    return status;
}

static bool trace_tile(void *user, int32_t tx, int32_t ty, unsigned worker, wo_tile_pixels *pixels,
                       wo_tile_facts *facts, wo_report *part)
{
    (void)worker;
    (void)pixels;
    (void)facts;
    hybrid_job *job = user;
    return wo_hybrid_trace(&job->rays, tx, ty, part);
}

static void choose_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    hybrid_job *job = user;
    wo_hybrid_choose(&job->rays, (int32_t)index);
}

static wo_hybrid_lean *lean_at(const hybrid_job *job, int32_t column, int32_t row)
{
    return &job->lean[(ptrdiff_t)(row - job->cells.y1) * wo_rect_width(job->cells) +
                      (column - job->cells.x1)];
}

static ptrdiff_t pixel_at(const wo_frame *frame, int32_t x, int32_t y)
{
    return (ptrdiff_t)(y - frame->window.y1) * wo_rect_width(frame->window) +
           (x - frame->window.x1);
}

/* Columns of cells of a tile that are inside the window. */
static void columns_of(const hybrid_job *job, int32_t tx, int32_t *from, int32_t *to)
{
    *from = tx * ACROSS > job->cells.x1 ? tx * ACROSS : job->cells.x1;
    *to = (tx + 1) * ACROSS < job->cells.x2 ? (tx + 1) * ACROSS : job->cells.x2;
}

static bool smooth_tile(void *user, int32_t tx, int32_t ty, unsigned worker, wo_tile_pixels *pixels,
                        wo_tile_facts *facts, wo_report *part)
{
    (void)worker;
    (void)part;
    const hybrid_job *job = user;
    if (wo_aborted(job->scene->context))
        return false;
    wo_hybrid_noise noise[ACROSS];
    wo_hybrid_join(&job->rays, tx, ty, pixels, facts, noise);
    const wo_ray_tile *tile = wo_lens_rays_at(job->scene->rays, tx, ty);
    const bool plain = tile->class == WO_TILE_EMPTY || wo_ray_tile_straight(tile);
    int32_t from;
    int32_t to;
    columns_of(job, tx, &from, &to);
    for (int32_t column = from; column < to; column++) {
        float(*rays[CELL])[4];
        float(*filtered[CELL])[4];
        const int32_t x = column * CELL - tx * WO_TILE_WIDTH;
        const ptrdiff_t at = pixel_at(&job->filtered, column * CELL, ty * CELL);
        for (int y = 0; y < CELL; y++) {
            rays[y] = pixels->c[y] + x;
            filtered[y] = job->filtered.c + at + (ptrdiff_t)y * wo_rect_width(job->filtered.window);
        }
        wo_hybrid_lean *const lean = lean_at(job, column, ty);
        const wo_hybrid_noise *const n = &noise[x / CELL];
        *lean = (wo_hybrid_lean){.keep = 1, .error = n->shown * (n->noise + n->lost)};
        if (!plain && !(job->filtered.mask[at] > 0))
            wo_hybrid_lean_on(rays, filtered, n, lean);
    }
    return true;
}

static bool mix_tile(void *user, int32_t tx, int32_t ty, unsigned worker, wo_tile_pixels *pixels,
                     wo_tile_facts *facts, wo_report *part)
{
    (void)worker;
    const hybrid_job *job = user;
    const wo_frame *smoothed = &job->smoothed;
    if (wo_aborted(job->scene->context))
        return false;
    part->tiles[wo_lens_rays_at(job->scene->rays, tx, ty)->class]++;
    memset(pixels, 0, sizeof *pixels);
    memset(facts, 0, sizeof *facts);
    int32_t from;
    int32_t to;
    columns_of(job, tx, &from, &to);
    for (int32_t column = from; column < to; column++) {
        const wo_rect own = {column, ty, column + 1, ty + 1};
        const wo_rect seen = wo_rect_contains(job->format, own) ? job->format : job->cells;
        const wo_hybrid_lean *around[3][3] = {{NULL}};
        for (int32_t y = 0; y < 3; y++) {
            for (int32_t x = 0; x < 3; x++) {
                const wo_rect other = {column + x - 1, ty + y - 1, column + x, ty + y};
                if (wo_rect_contains(seen, other) && wo_rect_contains(job->cells, other))
                    around[y][x] = lean_at(job, other.x1, other.y1);
            }
        }
        for (int y = 0; y < CELL; y++) {
            for (int x = 0; x < CELL; x++) {
                const int32_t in_tile = column * CELL - tx * WO_TILE_WIDTH + x;
                const ptrdiff_t at = pixel_at(smoothed, column * CELL + x, ty * CELL + y);
                facts->mask[y][in_tile] =
                    smoothed->mask[at] * wo_hybrid_mix(around, x, y, smoothed->c[at],
                                                       job->filtered.c[at], pixels->c[y][in_tile]);
                pixels->guessed[y][in_tile] = smoothed->guessed[at];
                facts->rays[y][in_tile] = smoothed->rays[at];
                facts->error[y][in_tile] = sqrtf(around[1][1]->error);
                const ptrdiff_t place =
                    (ptrdiff_t)(ty * CELL + y - job->rays.area.y1) * job->rays.width +
                    (column * CELL + x - job->rays.area.x1);
                for (int k = 0; job->rays.plane[WO_HYBRID_LIGHT] && k < 3; k++)
                    pixels->c[y][in_tile][k] += job->rays.plane[WO_HYBRID_LIGHT + k][place];
            }
        }
    }
    return true;
}

static wo_status render(const wo_defocus *scene, const wo_frame *frame, wo_report *report,
                        wo_error *error)
{
    hybrid_job job = {.scene = scene};
    wo_status status = create(scene, frame, &job, error);
    if (status == WO_OK)
        status = filter(&job, report, error);
    if (status == WO_OK)
        status =
            wo_frame_tiles(scene, &job.traced, FILTERED, TRACED, trace_tile, &job, report, error);
    if (status == WO_OK) {
        wo_run(scene->context, choose_row, &job, (size_t)job.rays.rows);
        status = wo_frame_tiles(scene, &job.smoothed, TRACED, SMOOTHED, smooth_tile, &job, report,
                                error);
    }
    if (status == WO_OK)
        status = wo_frame_tiles(scene, frame, SMOOTHED, 1, mix_tile, &job, report, error);
    destroy(&job);
    return status;
}

const wo_renderer wo_render_hybrid = {.key = "hybrid",
                                      .label = "Hybrid",
                                      .estimates = true,
                                      .taps = TAPS,
                                      .margin = LEAN_AROUND + WO_HYBRID_AROUND,
                                      .render = render};
