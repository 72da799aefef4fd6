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

/* Squares of 8 px: a pixel alone says little about its noise. */
enum { SQUARE = WO_TILE_HEIGHT, SQUARES = WO_TILE_WIDTH / SQUARE };

typedef struct tile_noise {
    wo_tile_light light;
    double variance[SQUARES];
} tile_noise;

static double error_of(void *user, const wo_tile_work *work, const wo_tile_sums *sums)
{
    tile_noise *tile = user;
    wo_noise noise = {0};
    double all = 0;
    for (int s = 0; s < SQUARES; s++) {
        double sum = 0;
        for (int32_t row = 0; row < SQUARE; row++) {
            for (int x = s * SQUARE; x < (s + 1) * SQUARE; x++) {
                const int run_index = x % WO_PHASES;
                const wo_march_sums *const halves = sums->halves[row][run_index];
                const int i = x / WO_PHASES;
                float a[4];
                float b[4];
                if (wo_tile_work_pixel(work, &halves[0], row, run_index, i, a) &&
                    wo_tile_work_pixel(work, &halves[1], row, run_index, i, b))
                    sum += (double)wo_noise_add(&noise, a, b, tile->light[row][x]);
            }
        }
        tile->variance[s] = sum / (SQUARE * SQUARE);
    }
    const double factor = wo_noise_factor(&noise);
    for (int s = 0; s < SQUARES; s++) {
        tile->variance[s] *= factor;
        all += tile->variance[s] / SQUARES;
    }
    return all;
}

static void put_errors(const tile_noise *tile, wo_tile_facts *facts)
{
    for (int32_t y = 0; y < WO_TILE_HEIGHT; y++)
        for (int32_t x = 0; x < WO_TILE_WIDTH; x++)
            facts->error[y][x] = (float)sqrt(tile->variance[x / SQUARE]);
}

static bool rays_tile(void *user, int32_t tx, int32_t ty, unsigned worker, wo_tile_pixels *pixels,
                      wo_tile_facts *facts, wo_report *part)
{
    (void)worker;
    const wo_defocus *scene = user;
    wo_tile_work work;
    wo_tile_sums sums;
    tile_noise noise;
    memset(pixels, 0, sizeof *pixels);
    memset(facts->rays, 0, sizeof facts->rays);
    memset(facts->error, 0, sizeof facts->error);
    wo_tile_work_begin(scene->rays, scene->context, tx, ty, INFINITY, &work);
    part->tiles[work.tile->class]++;
    if (work.tile->class == WO_TILE_EMPTY)
        return true;
    const bool lit = wo_tile_find_light(scene, tx, ty, noise.light, part);
    if (!wo_tile_sample(scene, &work, error_of, &noise, &sums, part))
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
    if (!wo_ray_tile_straight(work.tile)) {
        for (int s = 0; sums.rays == 1 && s < SQUARES; s++)
            noise.variance[s] = NAN;
        put_errors(&noise, facts);
    }
    if (lit)
        wo_tile_add_light(pixels, noise.light);
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
