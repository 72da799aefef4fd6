/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/renderer.h"

#include <math.h>

/* The same number of lens rays for every pixel that is blurred. */
static bool rays_tile(void *user, int32_t tx, int32_t ty, unsigned worker, wo_tile_pixels *pixels,
                      wo_tile_facts *facts, wo_report *part)
{
    (void)worker;
    const wo_defocus *scene = user;
    if (!wo_lens_rays_tile(scene->rays, scene->context, tx, ty, pixels, part))
        return false;
    wo_tile_highlights(scene, tx, ty, pixels, part);
    const wo_tile_class class = wo_lens_rays_at(scene->rays, tx, ty)->class;
    const float rays = class == WO_TILE_EMPTY   ? 0
                       : class == WO_TILE_SHARP ? 1
                                                : (float)scene->quality.samples;
    for (int32_t y = 0; y < WO_TILE_HEIGHT; y++) {
        for (int32_t x = 0; x < WO_TILE_WIDTH; x++) {
            facts->rays[y][x] = rays;
            facts->error[y][x] = rays <= 1 ? 0 : NAN;
        }
    }
    return true;
}

static wo_status render(const wo_defocus *scene, const wo_frame *frame, wo_report *report,
                        wo_error *error)
{
    wo_defocus own = *scene;
    return wo_frame_tiles(scene, frame, 0, 1, rays_tile, &own, report, error);
}

const wo_renderer wo_render_rays = {.key = "rays", .label = "Rays", .render = render};
