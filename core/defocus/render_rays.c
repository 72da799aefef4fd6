/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/adaptive.h"

#include <math.h>
#include <string.h>

/* Every pixel by lens rays alone: as many for all, or as many as a tile needs. */

/* Both halves of the rays of one vector together. */
static wo_march_sums whole(const wo_tile_sums *sums, int32_t row, int run_index)
{
    wo_march_sums all = sums->halves[row][run_index][0];
    wo_march_add(&all, &sums->halves[row][run_index][1]);
    return all;
}

typedef struct noise_map {
    float noise[WO_TILE_HEIGHT][WO_TILE_WIDTH];
} noise_map;

static double error_of(void *user, const wo_tile_work *work, const wo_tile_sums *sums)
{
    noise_map *map = user;
    double sum = 0;
    for (int32_t row = 0; row < WO_TILE_HEIGHT; row++) {
        for (int x = 0; x < WO_TILE_WIDTH; x++) {
            map->noise[row][x] = wo_tile_noise(work, sums, row, x % WO_PHASES, x / WO_PHASES);
            sum += (double)map->noise[row][x];
        }
    }
    return sum / (WO_TILE_WIDTH * WO_TILE_HEIGHT);
}

/* Noise is told by squares of 8 px: one pixel says little. */
enum { SQUARE = WO_TILE_HEIGHT };

static void put_errors(const noise_map *map, wo_tile_facts *facts)
{
    for (int32_t x0 = 0; x0 < WO_TILE_WIDTH; x0 += SQUARE) {
        float sum = 0;
        for (int32_t y = 0; y < SQUARE; y++)
            for (int32_t x = x0; x < x0 + SQUARE; x++)
                sum += map->noise[y][x];
        const float e = (float)WO_HALVES_TO_ERROR * sqrtf(sum / (SQUARE * SQUARE));
        for (int32_t y = 0; y < SQUARE; y++)
            for (int32_t x = x0; x < x0 + SQUARE; x++)
                facts->error[y][x] = e;
    }
}

static bool rays_tile(void *user, int32_t tx, int32_t ty, unsigned worker, wo_tile_pixels *pixels,
                      wo_tile_facts *facts, wo_report *part)
{
    (void)worker;
    const wo_defocus *scene = user;
    wo_tile_work work;
    wo_tile_sums sums;
    noise_map map;
    memset(pixels, 0, sizeof *pixels);
    memset(facts->rays, 0, sizeof facts->rays);
    memset(facts->error, 0, sizeof facts->error);
    wo_tile_work_begin(scene->rays, scene->context, tx, ty, INFINITY, &work);
    part->tiles[work.tile->class]++;
    if (work.tile->class == WO_TILE_EMPTY)
        return true;
    if (!wo_tile_sample(scene, &work, error_of, &map, &sums, part))
        return false;
    for (int32_t row = 0; row < WO_TILE_HEIGHT; row++) {
        for (int run_index = 0; run_index < WO_PHASES; run_index++) {
            const wo_march_sums all = whole(&sums, row, run_index);
            for (int i = 0; i < WO_LANES; i++) {
                const int x = run_index + WO_PHASES * i;
                wo_tile_work_pixel(&work, &all, row, run_index, i, pixels->c[row][x]);
                pixels->guessed[row][x] = fminf(fmaxf(all.guessed[i] / (float)sums.scale, 0), 1);
                facts->rays[row][x] = (float)sums.rays;
            }
        }
    }
    put_errors(&map, facts);
    wo_tile_highlights(scene, tx, ty, pixels, part);
    return true;
}

static wo_status render(const wo_defocus *scene, const wo_frame *frame, wo_report *report,
                        wo_error *error)
{
    wo_defocus own = *scene;
    return wo_frame_tiles(scene, frame, 0, 1, rays_tile, &own, report, error);
}

const wo_renderer wo_render_rays = {
    .key = "rays", .label = "Rays", .estimates = true, .render = render};
