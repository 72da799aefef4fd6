/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/adaptive.h"
#include "defocus/hybrid.h"

#include <math.h>
#include <string.h>

/* Near, far, rest, jitter, open, shown. */
enum {
    JITTER = WO_HYBRID_JITTER - WO_HYBRID_NOISE,
    OPEN,
    SHOWN,
    NOISES = WO_HYBRID_LIGHT - WO_HYBRID_NOISE
};

/* One pixel of sums, each part divided by the light of its colour. */
typedef struct split {
    float c[4];
    float near[WO_PART_SUMS], far[WO_PART_SUMS];
} split;

static void part_of(const wo_march_sums *sums, int i, const float sum[WO_PART_SUMS][WO_LANES],
                    float out[WO_PART_SUMS])
{
    for (int k = 0; k < WO_PART_SUMS; k++) {
        const float weight = sums->weight[k < WO_PART_BLUR ? k % 3 : 3][i];
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
        for (int k = 0; k < 3; k++) {
            part[k] = s->c[k];
            part[WO_PART_COVERAGE + k] = s->c[3];
        }
        part[WO_PART_BLUR] = s->c[3] / fabsf(0.5f * (b.v_min + b.v_max));
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

/* Squares of the noise of the parts, from two halves of the rays. Coverage and colour of a part
   err together: what counts is the part against that which fills the light left by it. */
static void noise_of(const split *all, const split *a, const split *b, float noise[NOISES])
{
    for (int k = 0; k < 3; k++) {
        const int a_k = WO_PART_COVERAGE + k;
        const float left = 1 - all->near[a_k];
        const float far_a = all->far[a_k];
        const float behind = left > 1e-3f ? (all->c[k] - all->near[k]) / left : all->near[k];
        const float beyond = far_a > 1e-3f ? all->far[k] / far_a : 0;
        const float near = a->near[k] - b->near[k] - behind * (a->near[a_k] - b->near[a_k]);
        const float far = a->far[k] - b->far[k] - beyond * (a->far[a_k] - b->far[a_k]);
        const float scale = 0.5f * wo_hybrid_scale(all->c[k]);
        const float open = a->c[k] - b->c[k];
        const float d[SHOWN] = {near, far, open - near - far, near + far, open};
        for (int n = 0; n < SHOWN; n++) {
            const float e = scale * d[n];
            noise[n] += e * e * (1.0f / 3);
        }
    }
}

static float mean_coverage(const float part[WO_PART_SUMS])
{
    const float *const a = part + WO_PART_COVERAGE;
    return wo_hybrid_mean(a[0], a[1], a[2]);
}

static void put(wo_hybrid *h, ptrdiff_t at, const split *s, float guessed,
                const float noise[NOISES])
{
    for (int k = 0; k < WO_PART_SUMS; k++) {
        h->plane[WO_HYBRID_NEAR + k][at] = s->near[k];
        h->plane[WO_HYBRID_FAR + k][at] = s->far[k];
    }
    for (int k = 0; k < 3; k++)
        h->plane[WO_HYBRID_REST + k][at] = s->c[k] - s->near[k] - s->far[k];
    h->plane[WO_HYBRID_REST + 3][at] = s->c[3] - mean_coverage(s->near) - mean_coverage(s->far);
    h->plane[WO_HYBRID_LEFT][at] = 1 - s->c[3];
    h->plane[WO_HYBRID_GUESSED][at] = guessed;
    for (int n = 0; n < NOISES; n++)
        h->plane[WO_HYBRID_NOISE + n][at] = noise[n];
}

/* A tile, looked at. */
typedef struct looked {
    const wo_hybrid *hybrid;
    wo_tile_light light;
    split all[WO_TILE_HEIGHT][WO_TILE_WIDTH];
    float noise[WO_TILE_HEIGHT][WO_TILE_WIDTH][NOISES];
    float factor; /* to variances */
} looked;

/* The parts of a pixel, and what its halves say of their noise. */
static void look_at(looked *seen, const wo_tile_work *work, const wo_tile_sums *sums, int32_t row,
                    int x, wo_noise *tile)
{
    const int run_index = x % WO_PHASES;
    const int i = x / WO_PHASES;
    const wo_march_sums *const halves = sums->halves[row][run_index];
    wo_march_sums both = halves[0];
    wo_march_add(&both, &halves[1]);
    split *const all = &seen->all[row][x];
    float *const noise = seen->noise[row][x];
    split half[2];
    memset(noise, 0, NOISES * sizeof *noise);
    if (split_pixel(work, &both, row, run_index, i, all) && sums->rays > 1 &&
        split_pixel(work, &halves[0], row, run_index, i, &half[0]) &&
        split_pixel(work, &halves[1], row, run_index, i, &half[1])) {
        noise_of(all, &half[0], &half[1], noise);
        noise[SHOWN] = wo_noise_add(tile, half[0].c, half[1].c, seen->light[row][x]);
    }
}

/* What smoothing will leave of the noise, as far as this tile can tell. */
static double error_of(void *user, const wo_tile_work *work, const wo_tile_sums *sums)
{
    looked *const seen = user;
    const wo_hybrid *h = seen->hybrid;
    wo_noise tile = {0};
    double total = 0;
    for (int x0 = 0; x0 < WO_TILE_WIDTH; x0 += WO_HYBRID_CELL) {
        double noise[NOISES] = {0};
        double near[2] = {0};
        double far[2] = {0};
        for (int32_t row = 0; row < WO_TILE_HEIGHT; row++) {
            for (int x = x0; x < x0 + WO_HYBRID_CELL; x++) {
                look_at(seen, work, sums, row, x, &tile);
                const split *const s = &seen->all[row][x];
                const float *const one = seen->noise[row][x];
                for (int n = 0; n < NOISES; n++)
                    noise[n] += (double)one[n];
                near[0] += (double)mean_coverage(s->near);
                near[1] += (double)s->near[WO_PART_BLUR];
                far[0] += (double)mean_coverage(s->far);
                far[1] += (double)s->far[WO_PART_BLUR];
            }
        }
        const int near_kernel = wo_hybrid_kernel_for(h, true, sums->rays, near[0], near[1]);
        const int far_kernel = wo_hybrid_kernel_for(h, false, sums->rays, far[0], far[1]);
        const double shown = noise[OPEN] > 0 ? noise[SHOWN] / noise[OPEN] : 1;
        total += shown * (noise[0] * (double)h->kernels[near_kernel].gain +
                          noise[1] * (double)h->kernels[far_kernel].gain + noise[2]);
    }
    seen->factor = (float)wo_noise_factor(&tile);
    return (double)seen->factor * total / (WO_TILE_WIDTH * WO_TILE_HEIGHT);
}

bool wo_hybrid_trace(wo_hybrid *h, int32_t tx, int32_t ty, wo_report *part)
{
    const wo_defocus *scene = h->scene;
    const size_t tile =
        (size_t)(ty - h->tiles.y1) * (size_t)wo_rect_width(h->tiles) + (size_t)(tx - h->tiles.x1);
    const ptrdiff_t origin = (ptrdiff_t)(ty * WO_TILE_HEIGHT - h->area.y1) * h->width +
                             (tx * WO_TILE_WIDTH - h->area.x1);
    wo_tile_work work;
    wo_tile_sums sums;
    wo_tile_work_begin(scene->rays, scene->context, tx, ty,
                       (float)(WO_HYBRID_APART_PX / scene->lens->px_per_dioptre), &work);
    if (work.tile->class == WO_TILE_EMPTY) {
        for (int32_t row = 0; row < WO_TILE_HEIGHT; row++)
            for (int32_t x = 0; x < WO_TILE_WIDTH; x++)
                h->plane[WO_HYBRID_LEFT][origin + row * h->width + x] = 1;
        return true;
    }
    looked seen;
    seen.hybrid = h;
    const bool lit = wo_tile_find_light(scene, tx, ty, seen.light, part);
    if (!wo_tile_sample(scene, &work, error_of, &seen, &sums, part))
        return false;
    h->rays[tile] = (float)sums.rays;
    for (int32_t row = 0; row < WO_TILE_HEIGHT; row++) {
        for (int x = 0; x < WO_TILE_WIDTH; x++) {
            const int run_index = x % WO_PHASES;
            const int i = x / WO_PHASES;
            const wo_march_sums *const halves = sums.halves[row][run_index];
            for (int n = 0; n < JITTER; n++)
                seen.noise[row][x][n] *= seen.factor;
            put(h, origin + row * h->width + x, &seen.all[row][x],
                fminf(fmaxf((halves[0].guessed[i] + halves[1].guessed[i]) / (float)sums.scale, 0),
                      1),
                seen.noise[row][x]);
            for (int k = 0; lit && k < 3; k++)
                h->plane[WO_HYBRID_LIGHT + k][origin + row * h->width + x] = seen.light[row][x][k];
        }
    }
    return true;
}
