/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/adaptive.h"
#include "defocus/hybrid.h"

#include <math.h>
#include <string.h>

/* Of the variance of noise smoothing leaves more than one part in as many as there are taps:
   neighbours share rays, and a little detail moves. Measured on footage. */
#define SMOOTH_LEAVES 1.3f
#define SMOOTH_MOVES  0.02f

/* Below this light is black. */
#define DARK 0.02f

float wo_hybrid_scale(float light)
{
    return 0.5f / sqrtf(fmaxf(light, 0) + DARK);
}

void wo_hybrid_kernels(wo_hybrid_kernel kernels[WO_HYBRID_KERNELS])
{
    for (int q = 0; q < WO_HYBRID_KERNELS; q++) {
        wo_hybrid_kernel *const k = &kernels[q];
        const double radius = q / 4.0;
        /* All pixels within the radius; of more than there is room for, every n-th of both
           diagonals' grid. */
        int step = 1;
        int modulus = 1;
        for (;;) {
            int n = 0;
            k->count = 0;
            for (int y = -WO_HYBRID_REACH; y <= WO_HYBRID_REACH; y++) {
                for (int x = -WO_HYBRID_REACH; x <= WO_HYBRID_REACH; x++) {
                    if (x * x + y * y > radius * radius + 1e-9 || ((x + step * y) % modulus) != 0)
                        continue;
                    if (n++ >= WO_HYBRID_TAPS_MAX)
                        continue;
                    k->x[k->count] = (int8_t)x;
                    k->y[k->count++] = (int8_t)y;
                }
            }
            if (n <= WO_HYBRID_TAPS_MAX)
                break;
            /* Lattices of 2, 5 and 13 px to a cell. */
            step = modulus == 1 ? 1 : modulus == 2 ? 2 : 5;
            modulus = modulus == 1 ? 2 : modulus == 2 ? 5 : 13;
        }
        for (int i = 0; i < k->count; i++)
            k->weight[i] = 1.0f / (float)k->count;
        k->gain = k->count > 1 ? fminf(1, SMOOTH_LEAVES / (float)k->count + SMOOTH_MOVES) : 1;
    }
}

/* Radius of smoothing, as part of the radius of blur beyond SMOOTH_FROM_PX, at SMOOTH_RAYS rays a
   pixel; it falls with this power of their number, as noise falls. Found by rendering the footage:
   less leaves noise, more takes detail. */
#define SMOOTH_NEAR    0.22
#define SMOOTH_FAR     0.35
#define SMOOTH_FROM_PX 1.0
#define SMOOTH_RAYS    16.0
#define SMOOTH_POWER   0.3

static ptrdiff_t cell_origin(const wo_hybrid *h, int32_t column, int32_t row)
{
    return (ptrdiff_t)row * WO_HYBRID_CELL * h->width + (ptrdiff_t)column * WO_HYBRID_CELL;
}

int wo_hybrid_kernel_for(const wo_hybrid *h, bool near, double rays, double coverage,
                         double by_vergence)
{
    if (!(by_vergence > 0))
        return 0;
    const double blur = h->scene->lens->px_per_dioptre * coverage / by_vergence;
    const double part =
        (near ? SMOOTH_NEAR : SMOOTH_FAR) * pow(SMOOTH_RAYS / fmax(1, rays), SMOOTH_POWER);
    const double q = 4 * part * (blur - SMOOTH_FROM_PX);
    return (int)(q < 0 ? 0 : q > WO_HYBRID_KERNELS - 1 ? WO_HYBRID_KERNELS - 1 : q + 0.5);
}

wo_rect wo_hybrid_view(const wo_hybrid *h, int32_t column, int32_t row)
{
    const wo_rect cell = {column, row, column + 1, row + 1};
    const wo_rect all = {0, 0, h->columns, h->rows};
    return wo_rect_contains(h->inner, cell) ? h->inner : all;
}

/* The same in pixels, for the cell with this corner. */
static wo_rect pixels_seen(const wo_hybrid *h, int32_t left, int32_t low)
{
    const wo_rect r = wo_hybrid_view(h, left / WO_HYBRID_CELL, low / WO_HYBRID_CELL);
    return (wo_rect){r.x1 * WO_HYBRID_CELL, r.y1 * WO_HYBRID_CELL, r.x2 * WO_HYBRID_CELL,
                     r.y2 * WO_HYBRID_CELL};
}

static int32_t clamp_to(int32_t x, int32_t from, int32_t to)
{
    return x < from ? from : x >= to ? to - 1 : x;
}

/* Sum of a plane over a cell. */
static double sum_of(const wo_hybrid *h, int plane, int32_t column, int32_t row)
{
    const float *const at = h->plane[plane] + cell_origin(h, column, row);
    double sum = 0;
    for (int y = 0; y < WO_HYBRID_CELL; y++)
        for (int x = 0; x < WO_HYBRID_CELL; x++)
            sum += (double)at[y * h->width + x];
    return sum;
}

void wo_hybrid_choose(wo_hybrid *h, int32_t row)
{
    enum { NEAR, NEAR_BLUR, FAR, FAR_BLUR, NEAR_NOISE, FAR_NOISE, OPEN, SHOWN, SUMS };
    /* Green stands for all colours. */
    static const int planes[SUMS] = {WO_HYBRID_NEAR + WO_PART_COVERAGE + 1,
                                     WO_HYBRID_NEAR + WO_PART_BLUR,
                                     WO_HYBRID_FAR + WO_PART_COVERAGE + 1,
                                     WO_HYBRID_FAR + WO_PART_BLUR,
                                     WO_HYBRID_NOISE + 0,
                                     WO_HYBRID_NOISE + 1,
                                     WO_HYBRID_OPEN,
                                     WO_HYBRID_SHOWN};
    const double cell_pixels = WO_HYBRID_CELL * WO_HYBRID_CELL;
    for (int32_t column = 0; column < h->columns; column++) {
        double sum[SUMS] = {0};
        int cells = 0;
        const wo_rect view = wo_hybrid_view(h, column, row);
        for (int32_t b = row - 1; b <= row + 1; b++) {
            for (int32_t a = column - 1; a <= column + 1; a++) {
                if (a < view.x1 || b < view.y1 || a >= view.x2 || b >= view.y2)
                    continue;
                cells++;
                for (int s = 0; s < SUMS; s++)
                    sum[s] += sum_of(h, planes[s], a, b);
            }
        }
        wo_hybrid_cell *const cell = &h->cells[(ptrdiff_t)row * h->columns + column];
        const double rays =
            (double)
                h->rays[row * wo_rect_width(h->tiles) + column * WO_HYBRID_CELL / WO_TILE_WIDTH];
        cell->near = (uint8_t)wo_hybrid_kernel_for(h, true, rays, sum[NEAR], sum[NEAR_BLUR]);
        cell->far = (uint8_t)wo_hybrid_kernel_for(h, false, rays, sum[FAR], sum[FAR_BLUR]);
        cell->jitter = (float)(WO_HALVES_TO_ERROR * WO_HALVES_TO_ERROR *
                               sum_of(h, WO_HYBRID_JITTER, column, row) / cell_pixels);
        for (int n = 0; n < 3; n++)
            cell->noise[n] = (float)(sum_of(h, WO_HYBRID_NOISE + n, column, row) / cell_pixels);
        for (int n = 0; n < 2; n++)
            cell->around[n] = (float)(sum[NEAR_NOISE + n] / (cells * cell_pixels));
        cell->shown = sum[OPEN] > 0 ? (float)(sum[SHOWN] / sum[OPEN]) : 1;
    }
}

/* A cell of planes from..from+count-1, smoothed. Beyond the area its edge is repeated. */
typedef float block[WO_HYBRID_CELL][WO_HYBRID_CELL];

static void smooth(const wo_hybrid *h, const wo_hybrid_kernel *k, int32_t left, int32_t low,
                   int from, int count, block *out)
{
    const wo_rect seen = pixels_seen(h, left, low);
    const wo_rect cell = {left, low, left + WO_HYBRID_CELL, low + WO_HYBRID_CELL};
    const bool inside =
        wo_rect_contains(seen, wo_rect_grow(cell, WO_HYBRID_REACH, WO_HYBRID_REACH));
    memset(out, 0, (size_t)count * sizeof *out);
    for (int i = 0; i < k->count; i++) {
        const float weight = k->weight[i];
        for (int y = 0; y < WO_HYBRID_CELL; y++) {
            int32_t row = low + y + k->y[i];
            if (inside) {
                const ptrdiff_t at = row * h->width + left + k->x[i];
                for (int p = 0; p < count; p++) {
                    const float *const in = h->plane[from + p] + at;
                    for (int x = 0; x < WO_HYBRID_CELL; x++)
                        out[p][y][x] += weight * in[x];
                }
                continue;
            }
            row = clamp_to(row, seen.y1, seen.y2);
            for (int x = 0; x < WO_HYBRID_CELL; x++) {
                const int32_t column = clamp_to(left + x + k->x[i], seen.x1, seen.x2);
                for (int p = 0; p < count; p++)
                    out[p][y][x] += weight * h->plane[from + p][row * h->width + column];
            }
        }
    }
}

static float coverage_at(const wo_hybrid *h, int part, int k, ptrdiff_t at)
{
    return h->plane[part + WO_PART_COVERAGE + k][at];
}

static float mean_coverage(const wo_hybrid *h, int part, ptrdiff_t at)
{
    return wo_hybrid_mean(coverage_at(h, part, 0, at), coverage_at(h, part, 1, at),
                          coverage_at(h, part, 2, at));
}

/* Colour of what lies behind the near part, where a pixel's own rays saw almost nothing of it. */
static void look_around(const wo_hybrid *h, const wo_hybrid_kernel *k, int32_t x, int32_t y,
                        float behind[4])
{
    const wo_rect seen = pixels_seen(h, x, y);
    float open[4] = {0};
    memset(behind, 0, 4 * sizeof *behind);
    for (int i = 0; i < k->count; i++) {
        const int32_t column = clamp_to(x + k->x[i], seen.x1, seen.x2);
        const int32_t row = clamp_to(y + k->y[i], seen.y1, seen.y2);
        const ptrdiff_t at = row * h->width + column;
        for (int c = 0; c < 3; c++) {
            behind[c] += h->plane[WO_HYBRID_REST + c][at] + h->plane[WO_HYBRID_FAR + c][at];
            open[c] += 1 - coverage_at(h, WO_HYBRID_NEAR, c, at);
        }
        behind[3] += h->plane[WO_HYBRID_REST + 3][at] + mean_coverage(h, WO_HYBRID_FAR, at);
        open[3] += 1 - mean_coverage(h, WO_HYBRID_NEAR, at);
    }
    for (int c = 0; c < 4; c++)
        behind[c] = open[c] > 0 ? behind[c] / open[c] : 0;
}

/* Light less than this says nothing about what it came from. */
#define OPEN_MIN 0.02f

/* Colours of one cell. */
typedef float colours[WO_HYBRID_CELL][WO_HYBRID_CELL][4];

/* The parts as they are. */
static void add_up(const wo_hybrid *h, int32_t left, int32_t low, colours out)
{
    for (int y = 0; y < WO_HYBRID_CELL; y++) {
        for (int x = 0; x < WO_HYBRID_CELL; x++) {
            const ptrdiff_t at = (low + y) * h->width + left + x;
            for (int k = 0; k < 3; k++)
                out[y][x][k] = h->plane[WO_HYBRID_REST + k][at] + h->plane[WO_HYBRID_FAR + k][at] +
                               h->plane[WO_HYBRID_NEAR + k][at];
            out[y][x][3] = h->plane[WO_HYBRID_REST + 3][at] + mean_coverage(h, WO_HYBRID_FAR, at) +
                           mean_coverage(h, WO_HYBRID_NEAR, at);
            if (h->plane[WO_HYBRID_LEFT][at] == 0)
                out[y][x][3] = 1;
        }
    }
}

/* Three colours and their coverages: of these, those that differ. */
enum { SMOOTHED = WO_PART_COVERAGE + 3 };

static int planes_of(const wo_hybrid *h)
{
    return h->scene->lens->colours ? SMOOTHED : WO_PART_COVERAGE + 1;
}

/* The parts with near and far smoothed. */
static void add_up_smooth(const wo_hybrid *h, const wo_hybrid_cell *cell, int32_t left, int32_t low,
                          colours out)
{
    const wo_hybrid_kernel *const near_kernel = &h->kernels[cell->near];
    block near[SMOOTHED];
    block far[SMOOTHED];
    smooth(h, near_kernel, left, low, WO_HYBRID_NEAR, planes_of(h), near);
    if (cell->far > 0)
        smooth(h, &h->kernels[cell->far], left, low, WO_HYBRID_FAR, planes_of(h), far);
    for (int y = 0; y < WO_HYBRID_CELL; y++) {
        for (int x = 0; x < WO_HYBRID_CELL; x++) {
            const ptrdiff_t at = (low + y) * h->width + left + x;
            float behind[4];
            float open[4];
            float covered[4];
            for (int k = 0; k < 3; k++) {
                const int a = h->scene->lens->colours ? WO_PART_COVERAGE + k : WO_PART_COVERAGE;
                behind[k] = h->plane[WO_HYBRID_REST + k][at];
                /* What is far keeps its part of the light and takes its colour from around. */
                if (cell->far > 0 && far[a][y][x] > OPEN_MIN)
                    behind[k] += coverage_at(h, WO_HYBRID_FAR, k, at) * far[k][y][x] / far[a][y][x];
                else
                    behind[k] += h->plane[WO_HYBRID_FAR + k][at];
                open[k] = 1 - coverage_at(h, WO_HYBRID_NEAR, k, at);
                covered[k] = fminf(fmaxf(near[a][y][x], 0), 1);
            }
            behind[3] = h->plane[WO_HYBRID_REST + 3][at] + mean_coverage(h, WO_HYBRID_FAR, at);
            open[3] = 1 - mean_coverage(h, WO_HYBRID_NEAR, at);
            covered[3] = wo_hybrid_mean(covered[0], covered[1], covered[2]);
            const bool closed = fminf(fminf(open[0], open[1]), open[2]) < OPEN_MIN;
            if (closed)
                look_around(h, near_kernel, left + x, low + y, behind);
            float *const c = out[y][x];
            for (int k = 0; k < 4; k++)
                c[k] = (k < 3 ? near[k][y][x] : covered[3]) +
                       (1 - covered[k]) * (closed ? behind[k] : behind[k] / open[k]);
            if (h->plane[WO_HYBRID_LEFT][at] == 0)
                c[3] = 1;
        }
    }
}

/* The estimate of noise in one cell may be too small by this. */
#define JITTER_TRUST 4.0f

/* Of what smoothing moves more than noise explains (as many times its estimate), so much is detail
   that is lost: an error of its own. Measured on footage. */
#define DETAIL_FROM 3.0f
#define DETAIL_LOST 0.7f

/* Smoothing takes noise away, and detail. Their sum is what it moves; the part of it that noise
   explains is taken (James and Stein 1961). *lost: mean square of the detail that goes with it. */
static float part_of_noise(const wo_hybrid_cell *cell, colours own, colours smoothed, float *lost)
{
    float moved = 0;
    for (int y = 0; y < WO_HYBRID_CELL; y++) {
        for (int x = 0; x < WO_HYBRID_CELL; x++) {
            for (int k = 0; k < 3; k++) {
                const float d = (own[y][x][k] - smoothed[y][x][k]) * wo_hybrid_scale(own[y][x][k]);
                moved += d * d;
            }
        }
    }
    moved *= 1.0f / (3 * WO_HYBRID_CELL * WO_HYBRID_CELL);
    const float noise = JITTER_TRUST * cell->jitter;
    const float part = moved <= noise ? 1 : noise / moved;
    *lost = DETAIL_LOST * part * part * fmaxf(moved - DETAIL_FROM * cell->jitter, 0);
    return part;
}

/* Variance of a pixel of which a part is smoothed: what is left of its own noise, and the mean of
   the noise around, of which the pixel's own is one in as many as there are taps. */
static float noise_left(const wo_hybrid_kernel *k, float part, float own, float around)
{
    if (k->count <= 1)
        return own;
    const float rest = 1 - part;
    return own * rest * (rest + 2 * part / (float)k->count) + around * part * part * k->gain;
}

void wo_hybrid_join(const wo_hybrid *h, int32_t tx, int32_t ty, wo_tile_pixels *pixels,
                    wo_tile_facts *facts, wo_hybrid_noise noise[WO_TILE_WIDTH / WO_HYBRID_CELL])
{
    const size_t tile =
        (size_t)(ty - h->tiles.y1) * (size_t)wo_rect_width(h->tiles) + (size_t)(tx - h->tiles.x1);
    const int32_t low = ty * WO_TILE_HEIGHT - h->area.y1;
    /* One ray where many are wanted says nothing of its error. */
    const bool known =
        h->rays[tile] != 1 || wo_ray_tile_straight(wo_lens_rays_at(h->scene->rays, tx, ty));
    for (int32_t x0 = 0; x0 < WO_TILE_WIDTH; x0 += WO_HYBRID_CELL) {
        const int32_t left = tx * WO_TILE_WIDTH - h->area.x1 + x0;
        const wo_hybrid_cell *const cell =
            &h->cells[(ptrdiff_t)(low / WO_HYBRID_CELL) * h->columns + left / WO_HYBRID_CELL];
        colours own;
        colours smoothed;
        add_up(h, left, low, own);
        float part = 0;
        float lost = 0;
        if (cell->near > 0 || cell->far > 0) {
            add_up_smooth(h, cell, left, low, smoothed);
            part = part_of_noise(cell, own, smoothed, &lost);
        }
        noise[x0 / WO_HYBRID_CELL] = (wo_hybrid_noise){
            .noise = noise_left(&h->kernels[cell->near], part, cell->noise[0], cell->around[0]) +
                     noise_left(&h->kernels[cell->far], part, cell->noise[1], cell->around[1]) +
                     cell->noise[2],
            .lost = lost,
            .shown = known ? cell->shown : NAN};
        for (int y = 0; y < WO_HYBRID_CELL; y++) {
            for (int x = 0; x < WO_HYBRID_CELL; x++) {
                float *const c = pixels->c[y][x0 + x];
                for (int k = 0; k < 4; k++)
                    c[k] = part > 0 ? own[y][x][k] + part * (smoothed[y][x][k] - own[y][x][k])
                                    : own[y][x][k];
                pixels->guessed[y][x0 + x] =
                    h->plane[WO_HYBRID_GUESSED][(low + y) * h->width + left + x];
                const ptrdiff_t at = (low + y) * h->width + left + x;
                facts->rays[y][x0 + x] = h->rays[tile];
                facts->mask[y][x0 + x] *=
                    1 - part * ((cell->near > 0 ? mean_coverage(h, WO_HYBRID_NEAR, at) : 0) +
                                (cell->far > 0 ? mean_coverage(h, WO_HYBRID_FAR, at) : 0));
            }
        }
    }
}
