/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/adaptive.h"

#include <math.h>
#include <string.h>

float wo_noise_add(wo_noise *noise, const float a[3], const float b[3], const float light[3])
{
    float sum = 0;
    for (int k = 0; k < 3; k++) {
        const float d = 0.5f * (wo_display(a[k] + light[k]) - wo_display(b[k] + light[k]));
        const float all = fmaxf(fabsf(a[k]) + fabsf(b[k]), 1e-4f);
        sum += d * d * (1.0f / 3);
        noise->square += (double)(d * d);
        noise->apart += (double)(d * d * fminf(fabsf(a[k] - b[k]) / all, 1));
    }
    return sum;
}

/* Parts of the light from where to where a lattice turns into chance. Measured on footage. */
#define APART_FROM 0.35
#define APART_TO   0.65

double wo_noise_factor(const wo_noise *noise)
{
    const double lattice = WO_HALVES_TO_ERROR * WO_HALVES_TO_ERROR;
    const double chance = WO_CHANCE_TO_ERROR * WO_CHANCE_TO_ERROR;
    const double apart = noise->square > 0 ? noise->apart / noise->square : 0;
    const double t = fmin(fmax((apart - APART_FROM) / (APART_TO - APART_FROM), 0), 1);
    return lattice + (chance - lattice) * t * t * (3 - 2 * t);
}

static void scale_sums(wo_march_sums *sums, float scale)
{
    for (int i = 0; i < WO_LANES; i++) {
        for (int k = 0; k < 4; k++) {
            sums->c[k][i] *= scale;
            sums->weight[k][i] *= scale;
        }
        for (int k = 0; k < WO_PART_SUMS; k++) {
            sums->near[k][i] *= scale;
            sums->far[k][i] *= scale;
        }
        sums->guessed[i] *= scale;
    }
}

static bool trace(wo_tile_work *work, const wo_lens *lens, unsigned pass, double scale,
                  wo_tile_sums *sums, wo_report *report)
{
    const int count = wo_ray_tile_straight(work->tile) ? 1 : lens->count;
    for (int32_t row = 0; row < WO_TILE_HEIGHT; row++) {
        for (int run_index = 0; run_index < WO_PHASES; run_index++) {
            wo_march_sums halves[2];
            if (!wo_tile_work_vector(work, lens, pass, row, run_index, halves))
                return false;
            for (int h = 0; h < 2; h++) {
                report->steps += halves[h].steps;
                if (scale != 1)
                    scale_sums(&halves[h], (float)scale);
                wo_march_add(&sums->halves[row][run_index][h], &halves[h]);
            }
        }
    }
    report->rays += (int64_t)count * WO_TILE_WIDTH * WO_TILE_HEIGHT;
    sums->rays += count;
    sums->scale += scale * count;
    return true;
}

int wo_next_level(const wo_defocus *scene, int last, double rays, double too_large)
{
    const double wanted = rays * (pow(too_large, 2 / WO_LATTICE_POWER) - 1);
    int level = -1;
    for (int i = last; i < scene->level_count; i++) {
        if (rays + scene->levels[i].count > scene->quality.max_rays)
            break;
        level = i;
        if (scene->levels[i].count >= wanted)
            break;
    }
    return level;
}

bool wo_tile_sample(const wo_defocus *scene, wo_tile_work *work, wo_tile_error *error, void *user,
                    wo_tile_sums *sums, wo_report *report)
{
    memset(sums, 0, sizeof *sums);
    if (!scene->quality.adaptive) {
        if (!trace(work, scene->lens, 0, 1, sums, report))
            return false;
        error(user, work, sums);
        return true;
    }
    int level = 0;
    for (unsigned pass = 0;; pass++) {
        const wo_lens *lens = &scene->levels[level];
        const double scale =
            pow((double)lens->count / scene->levels[0].count, WO_LATTICE_POWER - 1);
        if (!trace(work, lens, pass, scale, sums, report))
            return false;
        const double e = WO_ERROR_SIGMAS * sqrt(error(user, work, sums));
        if (e <= scene->quality.target_error || wo_ray_tile_straight(work->tile))
            return true;
        const double too_large =
            scene->quality.target_error > 0 ? e / scene->quality.target_error : INFINITY;
        level = wo_next_level(scene, level, sums->rays, too_large);
        if (level < 0)
            return true;
    }
}
