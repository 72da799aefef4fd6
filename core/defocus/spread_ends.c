/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/spread_ends.h"

#include <math.h>

/* Of a cell of a sheet: it is one opaque surface, also with the cell to the right and above. */
enum { FILLED = 1, FILLED_RIGHT = 2, FILLED_ABOVE = 4 };

typedef struct ends_job {
    const wo_defocus *scene;
    const wo_spread_light *light;
    wo_rect tiles;
    uint8_t *filled[WO_SHEETS_MAX]; /* [cells] */
    int32_t *ends;                  /* [tiles] */
} ends_job;

wo_rect wo_spread_footprint(const wo_defocus *scene, int32_t tx, int32_t ty)
{
    const int32_t reach =
        (int32_t)ceilf(wo_lens_rays_at(scene->rays, tx, ty)->reach) + WO_RAYS_MARGIN;
    return wo_rect_grow((wo_rect){tx * WO_TILE_WIDTH, ty * WO_TILE_HEIGHT, (tx + 1) * WO_TILE_WIDTH,
                                  (ty + 1) * WO_TILE_HEIGHT},
                        reach, reach);
}

/* The nearest bucket behind which nothing is seen from a tile: a surface without gaps, steps or
   clear places fills its footprint. */
static int32_t end_of(const ends_job *job, int32_t tx, int32_t ty)
{
    const wo_stack *stack = job->scene->stack;
    const wo_ray_tile *tile = wo_lens_rays_at(job->scene->rays, tx, ty);
    const wo_rect r = wo_rect_intersect(wo_spread_footprint(job->scene, tx, ty), stack->area);
    const int32_t i1 = (r.x1 - stack->area.x1) / WO_CELL;
    const int32_t i2 = (r.x2 - 1 - stack->area.x1) / WO_CELL;
    const int32_t j1 = (r.y1 - stack->area.y1) / WO_CELL;
    const int32_t j2 = (r.y2 - 1 - stack->area.y1) / WO_CELL;
    int32_t end = INT32_MAX;
    for (int s = 0; s < stack->sheets; s++) {
        bool filled = tile->bounds[s].v_min <= tile->bounds[s].v_max;
        float v_min = INFINITY;
        for (int32_t j = j1; j <= j2 && filled; j++)
            for (int32_t i = i1; i <= i2 && filled; i++) {
                const ptrdiff_t at = (ptrdiff_t)j * stack->cell_columns + i;
                const int wanted =
                    FILLED | (i < i2 ? FILLED_RIGHT : 0) | (j < j2 ? FILLED_ABOVE : 0);
                filled = (job->filled[s][at] & wanted) == wanted;
                v_min = fminf(v_min, stack->cells[s][at].v_min);
            }
        const int32_t b = filled ? wo_spread_light_bucket(job->light, (double)v_min) : end;
        end = b < end ? b : end;
    }
    return end;
}

/* True when two places of a sheet are one opaque surface. */
static bool one_surface(const ends_job *job, int s, int32_t x, int32_t y, int32_t dx, int32_t dy)
{
    const wo_stack *stack = job->scene->stack;
    if (x + dx >= stack->area.x2 || y + dy >= stack->area.y2)
        return false;
    const ptrdiff_t at = wo_stack_at(stack, x, y);
    const ptrdiff_t to = wo_stack_at(stack, x + dx, y + dy);
    const float opaque = 1 - (float)WO_SPREAD_FAINT;
    return stack->c[s][3][at] >= opaque && stack->c[s][3][to] >= opaque &&
           fabsf(stack->v[s][at] - stack->v[s][to]) <=
               WO_CONNECT_PX / (float)job->light->px_per_dioptre;
}

static void fill_cells(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const ends_job *job = user;
    const wo_stack *stack = job->scene->stack;
    const int32_t y1 = stack->area.y1 + (int32_t)index * WO_CELL;
    for (int s = 0; s < stack->sheets; s++) {
        for (int32_t i = 0; i < stack->cell_columns; i++) {
            const int32_t x1 = stack->area.x1 + i * WO_CELL;
            uint8_t filled = FILLED | FILLED_RIGHT | FILLED_ABOVE;
            for (int32_t y = y1; y < y1 + WO_CELL; y++)
                for (int32_t x = x1; x < x1 + WO_CELL; x++) {
                    const bool last_x = x + 1 == x1 + WO_CELL;
                    const bool last_y = y + 1 == y1 + WO_CELL;
                    if (!one_surface(job, s, x, y, 1, 0))
                        filled &= (uint8_t) ~(last_x ? FILLED_RIGHT : FILLED);
                    if (!one_surface(job, s, x, y, 0, 1))
                        filled &= (uint8_t) ~(last_y ? FILLED_ABOVE : FILLED);
                }
            job->filled[s][index * (size_t)stack->cell_columns + (size_t)i] = filled;
        }
    }
}

static void find_ends(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const ends_job *job = user;
    const wo_rect tiles = job->tiles;
    const size_t columns = (size_t)wo_rect_width(tiles);
    const int32_t ty = tiles.y1 + (int32_t)index;
    for (size_t i = 0; i < columns; i++)
        job->ends[index * columns + i] = end_of(job, tiles.x1 + (int32_t)i, ty);
}

wo_status wo_spread_ends_create(const wo_defocus *scene, const wo_spread_light *light,
                                wo_rect tiles, int32_t **ends, wo_error *error)
{
    const wo_context *context = scene->context;
    const wo_stack *stack = scene->stack;
    const size_t cells = (size_t)stack->cell_columns * (size_t)stack->cell_rows;
    ends_job job = {.scene = scene, .light = light, .tiles = tiles};
    *ends = NULL;
    uint8_t *filled = wo_new(context, error, cells * (size_t)stack->sheets, sizeof *filled);
    if (!filled)
        return WO_ERR_NOMEM;
    for (int s = 0; s < stack->sheets; s++)
        job.filled[s] = filled + cells * (size_t)s;
    job.ends = wo_new(context, error, (size_t)wo_rect_width(tiles) * (size_t)wo_rect_height(tiles),
                      sizeof *job.ends);
    if (job.ends) {
        wo_run(context, fill_cells, &job, (size_t)stack->cell_rows);
        wo_run(context, find_ends, &job, (size_t)wo_rect_height(tiles));
    }
    wo_delete(context, filled);
    *ends = job.ends;
    return job.ends ? WO_OK : WO_ERR_NOMEM;
}
