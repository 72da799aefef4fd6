/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/spread_ends.h"

#include <math.h>

typedef struct ends_job {
    const wo_defocus *scene;
    const wo_spread_light *light;
    wo_rect tiles;
    int32_t *ends; /* [tiles] */
} ends_job;

wo_rect wo_spread_footprint(const wo_defocus *scene, int32_t tx, int32_t ty)
{
    const int32_t reach =
        (int32_t)ceilf(wo_lens_rays_at(scene->rays, tx, ty)->footprint) + WO_RAYS_MARGIN;
    return wo_rect_grow(wo_tile_rect(tx, ty), reach, reach);
}

static int32_t end_of(const ends_job *job, int32_t tx, int32_t ty)
{
    const wo_stack *stack = job->scene->stack;
    const wo_ray_tile *tile = wo_lens_rays_at(job->scene->rays, tx, ty);
    const wo_rect r = wo_rect_intersect(wo_spread_footprint(job->scene, tx, ty), stack->area);
    int32_t end = INT32_MAX;
    for (int s = 0; s < stack->sheets; s++) {
        float v_min;
        if (tile->bounds[s].v_min > tile->bounds[s].v_max ||
            !wo_lens_rays_blocks(job->scene->rays, s, r, &v_min))
            continue;
        const int32_t b = wo_spread_light_bucket(job->light, (double)v_min);
        end = b < end ? b : end;
    }
    return end;
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
    ends_job job = {.scene = scene, .light = light, .tiles = tiles};
    *ends = NULL;
    job.ends = wo_new(context, error, (size_t)wo_rect_width(tiles) * (size_t)wo_rect_height(tiles),
                      sizeof *job.ends);
    if (!job.ends)
        return WO_ERR_NOMEM;
    wo_run(context, find_ends, &job, (size_t)wo_rect_height(tiles));
    *ends = job.ends;
    return WO_OK;
}
