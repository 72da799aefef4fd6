/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/lens_rays.h"

#include "optics/pencil_tilt.h"

#include <assert.h>
#include <math.h>
#include <string.h>

static_assert(WO_TILE_WIDTH <= (int)WO_PENCIL_SERVES, "one pencil serves a row of a tile");

wo_rect wo_tiles_of(wo_rect r)
{
    if (wo_rect_empty(r))
        return (wo_rect){0};
    return (wo_rect){wo_floor_div(r.x1, WO_TILE_WIDTH), wo_floor_div(r.y1, WO_TILE_HEIGHT),
                     wo_floor_div(r.x2 - 1, WO_TILE_WIDTH) + 1,
                     wo_floor_div(r.y2 - 1, WO_TILE_HEIGHT) + 1};
}

bool wo_lens_rays_blocks(const wo_lens_rays *rays, int sheet, wo_rect r, float *v_min)
{
    unsigned flags = 0;
    const wo_bounds bounds = wo_stack_bounds(rays->stack, sheet, r, &flags);
    *v_min = bounds.v_min;
    return !(flags & (WO_CELL_GAPS | WO_CELL_OPEN)) &&
           wo_stack_step(rays->stack, sheet, r) <= rays->v_step;
}

static wo_rect reached(wo_rect rect, double reach)
{
    const int32_t grow = (int32_t)ceil(reach) + WO_RAYS_MARGIN;
    return wo_rect_grow(rect, grow, grow);
}

/* A tile on its way to a class. */
typedef struct survey {
    wo_rect rect;
    double reach[WO_SHEETS_MAX]; /* px */
    unsigned flags[WO_SHEETS_MAX];
    bool closed; /* no ray gets through */
} survey;

/* Bounds narrow the reach, the reach narrows the bounds, for each sheet by itself (Lee et al. 2010,
   "Bounding the Footprint"), until nothing changes any more: so what comes out does not depend on
   max_reach, which depends on the window. */
static void find_bounds(const wo_lens_rays *rays, double max_reach, survey *found,
                        wo_ray_tile *tile)
{
    const wo_lens *lens = rays->lens;
    for (int s = 0; s < rays->stack->sheets; s++) {
        wo_bounds *const bounds = &tile->bounds[s];
        double *const reach = &found->reach[s];
        double last = INFINITY;
        *reach = max_reach;
        while (ceil(*reach) < last) {
            last = ceil(*reach);
            found->flags[s] = 0;
            *bounds = wo_stack_bounds(rays->stack, s, reached(found->rect, last), &found->flags[s]);
            if (bounds->v_min > bounds->v_max)
                break;
            *reach = fmin(*reach, lens->reach(lens->self, bounds->v_min, bounds->v_max));
        }
        if (bounds->v_min <= bounds->v_max)
            tile->footprint = fmaxf(tile->footprint, (float)*reach);
    }
}

/* Takes what lies behind a surface that stops every ray. A surface that blocks is met at the latest
   where it is met, and nothing farther before: steps are in the order of vergence. */
static void cut_hidden(const wo_lens_rays *rays, survey *found, wo_ray_tile *tile)
{
    float cut = -INFINITY;
    for (int s = 0; s < rays->stack->sheets; s++) {
        float v_min;
        if (tile->bounds[s].v_min <= tile->bounds[s].v_max &&
            wo_lens_rays_blocks(rays, s, reached(found->rect, found->reach[s]), &v_min))
            cut = fmaxf(cut, v_min);
    }
    found->closed = cut > -INFINITY;
    for (int s = 0; s < rays->stack->sheets; s++) {
        wo_bounds *const bounds = &tile->bounds[s];
        if (bounds->v_min > bounds->v_max || bounds->v_min >= cut)
            continue;
        if (bounds->v_max < cut) {
            *bounds = (wo_bounds){INFINITY, -INFINITY};
            tile->hidden++;
            continue;
        }
        bounds->v_min = cut;
        found->reach[s] = fmin(found->reach[s],
                               rays->lens->reach(rays->lens->self, bounds->v_min, bounds->v_max));
    }
}

static wo_ray_tile classify(const wo_lens_rays *rays, int32_t tx, int32_t ty, double max_reach,
                            unsigned leave_out)
{
    wo_ray_tile tile = {.class = WO_TILE_EMPTY, .v_near = -INFINITY};
    survey found = {.rect = wo_tile_rect(tx, ty)};
    find_bounds(rays, max_reach, &found, &tile);
    if (leave_out & WO_LEAVE_OUT_HIDDEN)
        cut_hidden(rays, &found, &tile);
    int sheets = 0;
    bool gaps = false;
    bool black = found.closed;
    double spread = 0;
    for (int s = 0; s < rays->stack->sheets; s++) {
        const wo_bounds bounds = tile.bounds[s];
        if (bounds.v_min > bounds.v_max)
            continue;
        sheets++;
        gaps |= (found.flags[s] & WO_CELL_GAPS) != 0;
        black &= !(found.flags[s] & WO_CELL_LIT) && !rays->stack->guessed[s];
        spread = rays->lens->px_per_dioptre * ((double)bounds.v_max - bounds.v_min);
        tile.reach = fmaxf(tile.reach, (float)found.reach[s]);
        tile.v_near = fmaxf(tile.v_near, bounds.v_max);
    }
    if (sheets == 0)
        return tile;
    tile.class = WO_TILE_MARCH;
    if (tile.reach < WO_SHARP_PX && (leave_out & WO_LEAVE_OUT_SHARP))
        tile.class = WO_TILE_SHARP;
    else if (black && (leave_out & WO_LEAVE_OUT_BLACK))
        tile.class = WO_TILE_BLACK;
    else if (sheets == 1 && !gaps && spread < WO_SINGLE_PX && (leave_out & WO_LEAVE_OUT_SINGLE))
        tile.class = WO_TILE_SINGLE;
    return tile;
}

typedef struct classify_job {
    wo_lens_rays *rays;
    double reach;
    unsigned leave_out;
} classify_job;

static void classify_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const classify_job *job = user;
    const wo_rect tiles = job->rays->tiles;
    const size_t columns = (size_t)wo_rect_width(tiles);
    for (size_t i = 0; i < columns; i++)
        job->rays->tile[index * columns + i] =
            classify(job->rays, tiles.x1 + (int32_t)i, tiles.y1 + (int32_t)index, job->reach,
                     job->leave_out);
}

wo_status wo_lens_rays_create(const wo_context *context, const wo_stack *stack, const wo_lens *lens,
                              wo_rect window, double max_reach, unsigned leave_out,
                              wo_lens_rays *rays, wo_error *error)
{
    *rays = (wo_lens_rays){.stack = stack,
                           .lens = lens,
                           .kernels = wo_march_choose(wo_cpu_detect(context->cpu)),
                           .tiles = wo_tiles_of(window),
                           .v_step = (float)(0.999 * WO_CONNECT_PX / wo_lens_slope(lens))};
    const size_t rows = (size_t)wo_rect_height(rays->tiles);
    rays->tile =
        wo_new(context, error, (size_t)wo_rect_width(rays->tiles) * rows, sizeof *rays->tile);
    if (!rays->tile)
        return WO_ERR_NOMEM;
    classify_job job = {rays, max_reach, leave_out};
    wo_run(context, classify_row, &job, rows);
    return WO_OK;
}

void wo_lens_rays_destroy(const wo_context *context, wo_lens_rays *rays)
{
    wo_delete(context, rays->tile);
    *rays = (wo_lens_rays){0};
}

const wo_ray_tile *wo_lens_rays_at(const wo_lens_rays *rays, int32_t tx, int32_t ty)
{
    return &rays->tile[(size_t)(ty - rays->tiles.y1) * (size_t)wo_rect_width(rays->tiles) +
                       (size_t)(tx - rays->tiles.x1)];
}

static wo_march_view view_of(const wo_lens_rays *rays, const wo_ray_tile *tile)
{
    const wo_stack *stack = rays->stack;
    wo_march_view view = {.opaque = stack->opaque,
                          .run = stack->run,
                          .row = stack->row,
                          .span_columns = stack->cell_columns,
                          .v_connect = (float)(WO_CONNECT_PX / rays->lens->px_per_dioptre)};
    for (int s = 0; s < stack->sheets; s++) {
        if (tile->bounds[s].v_min > tile->bounds[s].v_max)
            continue;
        view.bounds[view.sheets] = tile->bounds[s];
        view.spans[view.sheets] = stack->spans[s];
        view.v[view.sheets] = stack->v[s];
        memcpy(view.c[view.sheets], stack->c[s], sizeof view.c[0]);
        view.guessed[view.sheets++] = stack->guessed[s];
    }
    return view;
}

/* Colour straight through the pixel, nearest surface first, for a pixel all of whose rays were
   lost, or all of one colour's in a corner that few rays reach. As for a ray: where the scene is
   opaque, what was not stopped does not count. */
static void straight_through(const wo_march_view *view, ptrdiff_t at, float c[4])
{
    float sum[3] = {0};
    float light = 1;
    float last = INFINITY;
    for (int i = 0; i < view->sheets && light > WO_LIGHT_MIN; i++) {
        int next = -1;
        for (int s = 0; s < view->sheets; s++)
            if (view->v[s][at] < last && (next < 0 || view->v[s][at] > view->v[next][at]))
                next = s;
        if (next < 0)
            break;
        last = view->v[next][at];
        for (int k = 0; k < 3; k++)
            sum[k] += light * view->c[next][k][at];
        light -= light * view->c[next][3][at];
    }
    const float stopped = 1 - light;
    const bool ends = light <= WO_LIGHT_MIN || view->opaque[at] > 0.5f;
    const float weight = ends ? stopped : 1;
    for (int k = 0; k < 3; k++)
        c[k] = weight > 0 ? sum[k] / weight : 0;
    c[3] = weight > 0 ? stopped / weight : 0;
}

void wo_march_add(wo_march_sums *total, const wo_march_sums *part)
{
    for (int i = 0; i < WO_LANES; i++) {
        for (int k = 0; k < 4; k++) {
            total->c[k][i] += part->c[k][i];
            total->weight[k][i] += part->weight[k][i];
        }
        for (int k = 0; k < WO_PART_SUMS; k++) {
            total->near[k][i] += part->near[k][i];
            total->far[k][i] += part->far[k][i];
        }
        total->guessed[i] += part->guessed[i];
    }
    total->steps += part->steps;
}

bool wo_tile_work_pixel(const wo_tile_work *work, const wo_march_sums *sums, int32_t row,
                        int run_index, int i, float c[4])
{
    const int32_t x = work->rect.x1 + run_index + WO_PHASES * i;
    bool lost = !(sums->weight[3][i] > 0);
    for (int k = 0; k < 3; k++)
        lost |= !(sums->weight[k][i] > 0);
    if (lost) {
        for (int k = 0; k < 4; k++)
            c[k] = 0;
        straight_through(&work->view, wo_stack_at(work->rays->stack, x, work->rect.y1 + row), c);
    }
    for (int k = 0; k < 4; k++)
        if (sums->weight[k][i] > 0)
            c[k] = sums->c[k][i] / sums->weight[k][i];
    c[3] = fminf(fmaxf(c[3], 0), 1);
    return !lost;
}

void wo_tile_work_begin(const wo_lens_rays *rays, const wo_context *context, int32_t tx, int32_t ty,
                        float v_apart, wo_tile_work *work)
{
    work->rays = rays;
    work->context = context;
    work->tile = wo_lens_rays_at(rays, tx, ty);
    work->tx = tx;
    work->ty = ty;
    work->rect = wo_tile_rect(tx, ty);
    work->view = view_of(rays, work->tile);
    work->view.v_apart = v_apart;
}

/* Rays from..to of a pencil. */
static wo_pencil pencil_part(const wo_pencil *pencil, int from, int to)
{
    wo_pencil part = {.count = to - from,
                      .ax = pencil->ax + from,
                      .ay = pencil->ay + from,
                      .bx = pencil->bx + from,
                      .by = pencil->by + from};
    for (int k = 0; k < 3 && pencil->weight[0]; k++)
        part.weight[k] = pencil->weight[k] + from;
    return part;
}

bool wo_tile_work_vector(wo_tile_work *work, const wo_lens *lens, unsigned pass, int32_t row,
                         int run_index, wo_march_sums halves[2])
{
    static const float zero[1] = {0};
    const wo_march_kernels *kernels = work->rays->kernels;
    const wo_rect area = work->rays->stack->area;
    const int32_t x = work->rect.x1 - area.x1;
    const int32_t y = work->rect.y1 + row - area.y1;
    const bool straight = wo_ray_tile_straight(work->tile);
    wo_march_function *kernel = work->tile->class == WO_TILE_SINGLE ? kernels->single
                                : isfinite(work->view.v_apart)      ? kernels->march_apart
                                                                    : kernels->march;
    /* At random: pencils in order would draw their pattern on the picture. */
    const uint32_t where = (uint32_t)work->tx * 0x9e3779b1u +
                           (uint32_t)(work->rect.y1 + row) * 0x85ebca77u + 0x2545f491u * pass;
    const uint32_t set = wo_hash(wo_hash(where) + 0x3c6ef372u * (uint32_t)run_index);
    halves[0] = halves[1] = (wo_march_sums){0};
    if (straight) {
        const wo_pencil ray = {.count = 1, .ax = zero, .ay = zero, .bx = zero, .by = zero};
        kernel(&work->view, x, y, run_index, &ray, &halves[1]);
        return !wo_aborted(work->context);
    }
    const int half = lens->half;
    for (int first = 0; first < lens->count; first += WO_PENCIL_PIECE) {
        wo_pencil pencil;
        lens->pencil(lens->self, work->rect.x1 + 0.5 * WO_TILE_WIDTH, work->rect.y1 + row + 0.5,
                     set % lens->sets, first, &work->room, &pencil);
        if (wo_aborted(work->context))
            return false;
        const int middle = half - first < 0              ? 0
                           : half - first > pencil.count ? pencil.count
                                                         : half - first;
        for (int h = 0; h < 2; h++) {
            wo_march_sums part = {0};
            const wo_pencil rays = h == 0 ? pencil_part(&pencil, 0, middle)
                                          : pencil_part(&pencil, middle, pencil.count);
            if (rays.count == 0)
                continue;
            kernel(&work->view, x, y, run_index, &rays, &part);
            wo_march_add(&halves[h], &part);
        }
    }
    return true;
}

bool wo_lens_rays_tile(const wo_lens_rays *rays, const wo_context *context, int32_t tx, int32_t ty,
                       wo_tile_pixels *pixels, wo_report *report)
{
    wo_tile_work work;
    wo_tile_work_begin(rays, context, tx, ty, INFINITY, &work);
    memset(pixels, 0, sizeof *pixels);
    report->tiles[work.tile->class]++;
    if (work.tile->class == WO_TILE_EMPTY)
        return true;
    const int count = wo_ray_tile_straight(work.tile) ? 1 : rays->lens->count;
    for (int32_t row = 0; row < WO_TILE_HEIGHT; row++) {
        for (int run_index = 0; run_index < WO_PHASES; run_index++) {
            wo_march_sums halves[2];
            if (!wo_tile_work_vector(&work, rays->lens, 0, row, run_index, halves))
                return false;
            wo_march_sums *const sums = &halves[0];
            wo_march_add(sums, &halves[1]);
            report->steps += sums->steps;
            report->rays += (int64_t)count * WO_LANES;
            for (int i = 0; i < WO_LANES; i++) {
                const int x = run_index + WO_PHASES * i;
                wo_tile_work_pixel(&work, sums, row, run_index, i, pixels->c[row][x]);
                pixels->guessed[row][x] = fminf(fmaxf(sums->guessed[i] / (float)count, 0), 1);
            }
        }
    }
    return true;
}
