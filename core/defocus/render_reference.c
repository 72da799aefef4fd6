/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/renderer.h"

#include <math.h>
#include <string.h>

/* Brute force: every lens ray of every pixel by itself, in double precision, along the whole range
   of depths of the scene, nothing left out. For checking the other methods on any scene. */
typedef struct reference_job {
    const wo_defocus *scene;
    wo_lens_rays rays;
} reference_job;

static bool reference_tile(void *user, int32_t tx, int32_t ty, unsigned worker,
                           wo_tile_pixels *pixels, wo_tile_facts *facts, wo_report *part)
{
    (void)worker;
    const reference_job *job = user;
    const wo_defocus *scene = job->scene;
    if (!wo_lens_rays_tile(&job->rays, scene->context, tx, ty, pixels, part))
        return false;
    wo_tile_highlights(scene, tx, ty, pixels, part);
    for (int32_t y = 0; y < WO_TILE_HEIGHT; y++) {
        for (int32_t x = 0; x < WO_TILE_WIDTH; x++) {
            facts->rays[y][x] = (float)scene->lens->count;
            facts->error[y][x] = NAN;
        }
    }
    return true;
}

static wo_status render(const wo_defocus *scene, const wo_frame *frame, wo_report *report,
                        wo_error *error)
{
    const wo_context *context = scene->context;
    reference_job job = {scene, *scene->rays};
    const size_t tiles =
        (size_t)wo_rect_width(job.rays.tiles) * (size_t)wo_rect_height(job.rays.tiles);
    job.rays.kernels = &wo_march_reference;
    job.rays.tile = wo_new(context, error, tiles, sizeof *job.rays.tile);
    if (!job.rays.tile)
        return WO_ERR_NOMEM;
    wo_ray_tile all = {.class = WO_TILE_MARCH, .v_near = -INFINITY};
    for (int s = 0; s < scene->stack->sheets; s++) {
        unsigned flags = 0;
        all.bounds[s] = wo_stack_bounds(scene->stack, s, scene->stack->area, &flags);
        all.v_near = fmaxf(all.v_near, all.bounds[s].v_max);
    }
    if (scene->stack->sheets == 0)
        all.class = WO_TILE_EMPTY;
    for (size_t i = 0; i < tiles; i++)
        job.rays.tile[i] = all;
    const wo_status status =
        wo_frame_tiles(scene, frame, 0, 1, reference_tile, &job, report, error);
    wo_delete(context, job.rays.tile);
    return status;
}

const wo_renderer wo_render_reference = {
    .key = "reference", .label = "Reference", .render = render};
