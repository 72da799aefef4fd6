/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/adaptive.h"
#include "defocus/hybrid.h"

#include <math.h>
#include <string.h>

/* Neighbours share rays, and a little detail moves: measured on footage. */
#define SMOOTH_LEAVES 3.0f

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
        k->gain = fminf(1, SMOOTH_LEAVES / (float)k->count);
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

void wo_hybrid_choose(wo_hybrid *h, int32_t row)
{
    static const int sums[] = {WO_HYBRID_NEAR + 3, WO_HYBRID_NEAR + 4,  WO_HYBRID_FAR + 3,
                               WO_HYBRID_FAR + 4,  WO_HYBRID_NOISE + 0, WO_HYBRID_NOISE + 1,
                               WO_HYBRID_NOISE + 2};
    enum { SUMS = sizeof sums / sizeof sums[0] };
    for (int32_t column = 0; column < h->columns; column++) {
        double sum[SUMS] = {0};
        int cells = 0;
        double own = 0;
        for (int32_t b = row - 1; b <= row + 1; b++) {
            for (int32_t a = column - 1; a <= column + 1; a++) {
                if (a < 0 || b < 0 || a >= h->columns || b >= h->rows)
                    continue;
                const ptrdiff_t at = cell_origin(h, a, b);
                cells++;
                for (int s = 0; s < SUMS; s++)
                    for (int y = 0; y < WO_HYBRID_CELL; y++)
                        for (int x = 0; x < WO_HYBRID_CELL; x++)
                            sum[s] += (double)h->plane[sums[s]][at + y * h->width + x];
                if (a == column && b == row)
                    for (int y = 0; y < WO_HYBRID_CELL; y++)
                        for (int x = 0; x < WO_HYBRID_CELL; x++)
                            for (int n = 0; n < 3; n++)
                                own += (double)h->plane[WO_HYBRID_NOISE + n][at + y * h->width + x];
            }
        }
        wo_hybrid_cell *const cell = &h->cells[(ptrdiff_t)row * h->columns + column];
        const double rays =
            (double)
                h->rays[row * wo_rect_width(h->tiles) + column * WO_HYBRID_CELL / WO_TILE_WIDTH];
        cell->near = (uint8_t)wo_hybrid_kernel_for(h, true, rays, sum[0], sum[1]);
        cell->far = (uint8_t)wo_hybrid_kernel_for(h, false, rays, sum[2], sum[3]);
        cell->own_noise = (float)(own / (WO_HYBRID_CELL * WO_HYBRID_CELL));
        for (int n = 0; n < 3; n++)
            cell->noise[n] = (float)(sum[4 + n] / (cells * WO_HYBRID_CELL * WO_HYBRID_CELL));
    }
}

/* A cell of planes from..from+count-1, smoothed. Beyond the area its edge is repeated. */
typedef float block[WO_HYBRID_CELL][WO_HYBRID_CELL];

static void smooth(const wo_hybrid *h, const wo_hybrid_kernel *k, int32_t left, int32_t low,
                   int from, int count, block *out)
{
    const int32_t w = wo_rect_width(h->area);
    const int32_t height = wo_rect_height(h->area);
    const bool inside = left >= WO_HYBRID_REACH && low >= WO_HYBRID_REACH &&
                        left + WO_HYBRID_CELL + WO_HYBRID_REACH <= w &&
                        low + WO_HYBRID_CELL + WO_HYBRID_REACH <= height;
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
            row = row < 0 ? 0 : row >= height ? height - 1 : row;
            for (int x = 0; x < WO_HYBRID_CELL; x++) {
                int32_t column = left + x + k->x[i];
                column = column < 0 ? 0 : column >= w ? w - 1 : column;
                for (int p = 0; p < count; p++)
                    out[p][y][x] += weight * h->plane[from + p][row * h->width + column];
            }
        }
    }
}

/* Colour of what lies behind the near part, where a pixel's own rays saw almost nothing of it. */
static void look_around(const wo_hybrid *h, const wo_hybrid_kernel *k, int32_t x, int32_t y,
                        float behind[4])
{
    const int32_t w = wo_rect_width(h->area);
    const int32_t height = wo_rect_height(h->area);
    float open = 0;
    for (int c = 0; c < 4; c++)
        behind[c] = 0;
    for (int i = 0; i < k->count; i++) {
        int32_t column = x + k->x[i];
        int32_t row = y + k->y[i];
        column = column < 0 ? 0 : column >= w ? w - 1 : column;
        row = row < 0 ? 0 : row >= height ? height - 1 : row;
        const ptrdiff_t at = row * h->width + column;
        for (int c = 0; c < 4; c++)
            behind[c] += h->plane[WO_HYBRID_REST + c][at] + h->plane[WO_HYBRID_FAR + c][at];
        open += 1 - h->plane[WO_HYBRID_NEAR + 3][at];
    }
    for (int c = 0; c < 4; c++)
        behind[c] = open > 0 ? behind[c] / open : 0;
}

/* ... squared, in units of the noise's variance. */
#define MOVE_LIMIT 9.0f

/* Smoothing may move a pixel as far as noise does, not farther: what is beyond is detail. */
static void keep_within_noise(const wo_hybrid *h, ptrdiff_t at, float noise, float c[4])
{
    float own[4];
    float moved = 0;
    for (int k = 0; k < 3; k++) {
        own[k] = h->plane[WO_HYBRID_NEAR + k][at] + h->plane[WO_HYBRID_FAR + k][at] +
                 h->plane[WO_HYBRID_REST + k][at];
        const float d = sqrtf(fminf(fmaxf(c[k], 0), 1)) - sqrtf(fminf(fmaxf(own[k], 0), 1));
        moved += d * d * (1.0f / 3);
    }
    own[3] = 1 - h->plane[WO_HYBRID_LEFT][at];
    const float most = MOVE_LIMIT * noise;
    if (moved <= most)
        return;
    const float part = sqrtf(most / moved);
    for (int k = 0; k < 4; k++)
        c[k] = own[k] + part * (c[k] - own[k]);
}

/* Light less than this says nothing about what it came from. */
#define OPEN_MIN 0.02f

void wo_hybrid_join(const wo_hybrid *h, int32_t tx, int32_t ty, wo_tile_pixels *pixels,
                    wo_tile_facts *facts)
{
    const size_t tile =
        (size_t)(ty - h->tiles.y1) * (size_t)wo_rect_width(h->tiles) + (size_t)(tx - h->tiles.x1);
    const int32_t low = ty * WO_TILE_HEIGHT - h->area.y1;
    for (int32_t x0 = 0; x0 < WO_TILE_WIDTH; x0 += WO_HYBRID_CELL) {
        const int32_t left = tx * WO_TILE_WIDTH - h->area.x1 + x0;
        const wo_hybrid_cell *const cell =
            &h->cells[(ptrdiff_t)(low / WO_HYBRID_CELL) * h->columns + left / WO_HYBRID_CELL];
        const wo_hybrid_kernel *const near_kernel = &h->kernels[cell->near];
        const wo_hybrid_kernel *const far_kernel = &h->kernels[cell->far];
        block near[4];
        block far[4];
        if (cell->near > 0)
            smooth(h, near_kernel, left, low, WO_HYBRID_NEAR, 4, near);
        if (cell->far > 0)
            smooth(h, far_kernel, left, low, WO_HYBRID_FAR, 4, far);
        const float noise =
            cell->noise[0] * near_kernel->gain + cell->noise[1] * far_kernel->gain + cell->noise[2];
        for (int y = 0; y < WO_HYBRID_CELL; y++) {
            for (int x = 0; x < WO_HYBRID_CELL; x++) {
                const ptrdiff_t at = (low + y) * h->width + left + x;
                float n[4];
                float behind[4];
                for (int k = 0; k < 4; k++) {
                    const float own = h->plane[WO_HYBRID_FAR + k][at];
                    n[k] = h->plane[WO_HYBRID_NEAR + k][at];
                    behind[k] = h->plane[WO_HYBRID_REST + k][at];
                    if (cell->far > 0 && k < 3 && far[3][y][x] > OPEN_MIN)
                        behind[k] += h->plane[WO_HYBRID_FAR + 3][at] * far[k][y][x] / far[3][y][x];
                    else
                        behind[k] += own;
                }
                float empty = h->plane[WO_HYBRID_LEFT][at];
                if (cell->near > 0) {
                    const float open = 1 - n[3];
                    const float covered = fminf(fmaxf(near[3][y][x], 0), 1);
                    for (int k = 0; k < 4; k++)
                        n[k] = near[k][y][x];
                    if (open < OPEN_MIN) {
                        look_around(h, near_kernel, left + x, low + y, behind);
                        for (int k = 0; k < 4; k++)
                            behind[k] *= 1 - covered;
                        empty = empty > 0 ? fmaxf(1 - covered - behind[3], 0) : 0;
                    } else {
                        const float scale = (1 - covered) / open;
                        for (int k = 0; k < 4; k++)
                            behind[k] *= scale;
                        empty *= scale;
                    }
                }
                float *const c = pixels->c[y][x0 + x];
                for (int k = 0; k < 3; k++)
                    c[k] = n[k] + behind[k];
                c[3] = 1 - empty;
                if (cell->near > 0 || cell->far > 0)
                    keep_within_noise(h, at, cell->own_noise, c);
                pixels->guessed[y][x0 + x] = h->plane[WO_HYBRID_GUESSED][at];
                facts->error[y][x0 + x] = (float)WO_HALVES_TO_ERROR * sqrtf(noise);
                facts->rays[y][x0 + x] = h->rays[tile];
            }
        }
    }
}
