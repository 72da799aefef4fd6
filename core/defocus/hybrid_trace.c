/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/hybrid.h"

#include <math.h>
#include <string.h>

/* One pixel of sums, each part divided by the light of its colour. */
typedef struct split {
    float c[4];
    float near[WO_PART_SUMS], far[WO_PART_SUMS];
} split;

/* Channel whose weight a part has. */
static int channel_of(int k)
{
    return k < 3 ? k : 3;
}

static void part_of(const wo_march_sums *sums, int i, const float sum[WO_PART_SUMS][WO_LANES],
                    float out[WO_PART_SUMS])
{
    for (int k = 0; k < WO_PART_SUMS; k++) {
        const float weight = sums->weight[channel_of(k)][i];
        out[k] = weight > 0 ? sum[k][i] / weight : 0;
    }
}

/* In a tile of one vergence all light is of one part. */
static void split_single(const wo_tile_work *work, split *s)
{
    for (int n = 0; n < work->rays->stack->sheets; n++) {
        const wo_bounds b = work->tile->bounds[n];
        if (b.v_min > b.v_max)
            continue;
        const bool near = b.v_min > work->view.v_apart;
        if (!near && !(b.v_max < -work->view.v_apart))
            continue;
        float *const part = near ? s->near : s->far;
        memcpy(part, s->c, sizeof s->c);
        part[4] = s->c[3] / fabsf(0.5f * (b.v_min + b.v_max));
    }
}

static bool split_pixel(const wo_tile_work *work, const wo_march_sums *sums, int32_t row,
                        int run_index, int i, split *s)
{
    memset(s, 0, sizeof *s);
    if (!wo_tile_work_pixel(work, sums, row, run_index, i, s->c))
        return false;
    if (work->tile->class == WO_TILE_SINGLE) {
        split_single(work, s);
    } else {
        part_of(sums, i, sums->near, s->near);
        part_of(sums, i, sums->far, s->far);
    }
    return true;
}

/* How much a difference of light at x shows. */
static float shown(float from, float to, float d)
{
    const float step = to - from;
    if (fabsf(step) > 1e-6f)
        return (wo_display(to) - wo_display(from)) / step * d;
    return from < 0.0031308f ? 12.92f * d
           : from < 1        ? 1.055f / 2.4f * powf(from, 1 / 2.4f - 1) * d
                             : 0;
}

/* Squares of the noise of the parts, from two halves of the rays. Coverage and colour of a part
   err together: what counts is the part against that which fills the light left by it. */
static void noise_of(const split *all, const split *a, const split *b, float noise[3])
{
    const float open = 1 - all->near[3];
    const float far_a = all->far[3];
    for (int k = 0; k < 3; k++) {
        const float behind = open > 1e-3f ? (all->c[k] - all->near[k]) / open : all->near[k];
        const float beyond = far_a > 1e-3f ? all->far[k] / far_a : 0;
        const float near = a->near[k] - b->near[k] - behind * (a->near[3] - b->near[3]);
        const float far = a->far[k] - b->far[k] - beyond * (a->far[3] - b->far[3]);
        const float rest = a->c[k] - b->c[k] - near - far;
        const float d[3] = {near, far, rest};
        for (int n = 0; n < 3; n++) {
            const float e = 0.5f * shown(b->c[k], a->c[k], d[n]);
            noise[n] += e * e * (1.0f / 3);
        }
    }
}

static void put(wo_hybrid *h, ptrdiff_t at, const split *s, float guessed, const float noise[3])
{
    for (int k = 0; k < WO_PART_SUMS; k++) {
        h->plane[WO_HYBRID_NEAR + k][at] = s->near[k];
        h->plane[WO_HYBRID_FAR + k][at] = s->far[k];
    }
    for (int k = 0; k < 4; k++)
        h->plane[WO_HYBRID_REST + k][at] = s->c[k] - s->near[k] - s->far[k];
    h->plane[WO_HYBRID_LEFT][at] = 1 - s->c[3];
    h->plane[WO_HYBRID_GUESSED][at] = guessed;
    for (int n = 0; n < 3; n++)
        h->plane[WO_HYBRID_NOISE + n][at] = noise[n];
}

bool wo_hybrid_trace(wo_hybrid *h, int32_t tx, int32_t ty, wo_report *part)
{
    const wo_defocus *scene = h->scene;
    const size_t tile =
        (size_t)(ty - h->tiles.y1) * (size_t)wo_rect_width(h->tiles) + (size_t)(tx - h->tiles.x1);
    wo_tile_work work;
    wo_tile_work_begin(scene->rays, scene->context, tx, ty,
                       (float)(WO_HYBRID_APART_PX / scene->lens->px_per_dioptre), &work);
    const wo_tile_class class = work.tile->class;
    const ptrdiff_t origin = (ptrdiff_t)(ty * WO_TILE_HEIGHT - h->area.y1) * h->width +
                             (tx * WO_TILE_WIDTH - h->area.x1);
    if (class == WO_TILE_EMPTY) {
        for (int32_t row = 0; row < WO_TILE_HEIGHT; row++)
            for (int32_t x = 0; x < WO_TILE_WIDTH; x++)
                h->plane[WO_HYBRID_LEFT][origin + row * h->width + x] = 1;
        return true;
    }
    const int count = class == WO_TILE_SHARP ? 1 : scene->lens->count;
    h->rays[tile] = (float)count;
    for (int32_t row = 0; row < WO_TILE_HEIGHT; row++) {
        for (int run_index = 0; run_index < WO_PHASES; run_index++) {
            wo_march_sums halves[2];
            if (!wo_tile_work_vector(&work, scene->lens, 0, row, run_index, halves))
                return false;
            wo_march_sums sums = halves[0];
            wo_march_add(&sums, &halves[1]);
            part->steps += sums.steps;
            part->rays += (int64_t)count * WO_LANES;
            for (int i = 0; i < WO_LANES; i++) {
                split all;
                split half[2];
                float noise[3] = {0};
                if (split_pixel(&work, &sums, row, run_index, i, &all) && count > 1 &&
                    split_pixel(&work, &halves[0], row, run_index, i, &half[0]) &&
                    split_pixel(&work, &halves[1], row, run_index, i, &half[1]))
                    noise_of(&all, &half[0], &half[1], noise);
                put(h, origin + row * h->width + run_index + WO_PHASES * i, &all,
                    sums.guessed[i] / (float)count, noise);
            }
        }
    }
    return true;
}
