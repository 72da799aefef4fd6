/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/march.h"

#include <math.h>
#include <stdlib.h>

/* The rules of march.h once more: one pixel, one ray, one step at a time, in double precision, over
   the whole range of vergences and without interpolation. For tests and for timing; slow. */
typedef struct patch {
    double v;
    int sheet;
} patch;

static ptrdiff_t place_of(const wo_march_view *view, int32_t x, int32_t y, int dx, int dy)
{
    const int32_t px = x + dx;
    return (y + dy) * view->row + (px & (WO_PHASES - 1)) * view->run + px / WO_PHASES;
}

static void interpolate(const wo_march_view *view, int s, int32_t x, int32_t y, int dx, int dy,
                        double tx, double ty, double limit, double c[4])
{
    const double wx[3] = {tx * tx - 0.5 * tx, 1 - 2 * tx * tx, tx * tx + 0.5 * tx};
    const double wy[3] = {ty * ty - 0.5 * ty, 1 - 2 * ty * ty, ty * ty + 0.5 * ty};
    const ptrdiff_t centre = place_of(view, x, y, dx, dy);
    for (int k = 0; k < 4; k++)
        c[k] = 0;
    for (int b = 0; b < 3; b++) {
        for (int a = 0; a < 3; a++) {
            ptrdiff_t at = place_of(view, x, y, dx + a - 1, dy + b - 1);
            if (!(fabs((double)view->v[s][at] - (double)view->v[s][centre]) <= limit))
                at = centre;
            for (int k = 0; k < 4; k++)
                c[k] += wx[a] * wy[b] * (double)view->c[s][k][at];
        }
    }
}

/* Of one ray. */
typedef struct ray_sums {
    double c[4];
    double weight;
    double guessed;
    double near[WO_PART_SUMS], far[WO_PART_SUMS];
} ray_sums;

static void add_part(double sum[WO_PART_SUMS], double light, double v, const double c[4])
{
    for (int k = 0; k < 3; k++) {
        sum[k] += light * c[k];
        sum[WO_PART_COVERAGE + k] += light * c[3];
    }
    sum[WO_PART_BLUR] += light * c[3] / fabs(v);
}

static void trace(const wo_march_view *view, int32_t x, int32_t y, const wo_pencil *pencil, int n,
                  ray_sums *out, int64_t *steps)
{
    const bool upright = fabsf(pencil->by[n]) > fabsf(pencil->bx[n]);
    const double am = (double)(upright ? pencil->ay : pencil->ax)[n];
    const double bm = (double)(upright ? pencil->by : pencil->bx)[n];
    const double an = (double)(upright ? pencil->ax : pencil->ay)[n];
    const double bn = (double)(upright ? pencil->bx : pencil->by)[n];
    const double slope = bm != 0 ? bn / bm : 0;
    double v_near = -INFINITY;
    double v_far = INFINITY;
    for (int s = 0; s < view->sheets; s++) {
        v_near = fmax(v_near, (double)view->bounds[s].v_max);
        v_far = fmin(v_far, (double)view->bounds[s].v_min);
    }
    const int dir = bm >= 0 ? -1 : 1;
    const double limit = (double)WO_CONNECT_PX / fmax(fabs(bm), 1e-30);
    const int last = (int)lrint(am + bm * v_far);
    double light = 1;
    double before[WO_SHEETS_MAX];
    for (int s = 0; s < view->sheets; s++)
        before[s] = NAN;
    int dx = 0;
    int dy = 0;
    for (int i = (int)lrint(am + bm * v_near);; i += dir) {
        const double across = an + slope * (i - am);
        const int j = (int)lrint(across);
        dx = upright ? j : i;
        dy = upright ? i : j;
        patch hits[WO_SHEETS_MAX];
        double at_t[WO_SHEETS_MAX];
        int count = 0;
        for (int s = 0; s < view->sheets; s++) {
            const double v = (double)view->v[s][place_of(view, x, y, dx, dy)];
            const double e = (am + bm * v - i) * dir;
            const double e0 = before[s];
            before[s] = e;
            (*steps)++;
            const bool crossed = e < -0.5 && e0 > 0.5 && e0 - e <= 1 + (double)WO_CONNECT_PX;
            if (!(fabs(e) <= 0.5) && !crossed)
                continue;
            int k = count++;
            for (; k > 0 && hits[k - 1].v < v; k--) {
                hits[k] = hits[k - 1];
                at_t[k] = at_t[k - 1];
            }
            hits[k] = (patch){v, s};
            at_t[k] = dir * (crossed ? e0 / (e0 - e) - 1 : e);
        }
        for (int h = 0; h < count; h++) {
            const int s = hits[h].sheet;
            double c[4];
            if (abs(i) <= WO_SMOOTH_PX) {
                const double beside = across - j + slope * at_t[h];
                interpolate(view, s, x, y, dx, dy, upright ? beside : at_t[h],
                            upright ? at_t[h] : beside, limit, c);
            } else {
                for (int k = 0; k < 4; k++)
                    c[k] = (double)view->c[s][k][place_of(view, x, y, dx, dy)];
            }
            if (hits[h].v > (double)view->v_apart)
                add_part(out->near, light, hits[h].v, c);
            if (hits[h].v < -(double)view->v_apart)
                add_part(out->far, light, hits[h].v, c);
            for (int k = 0; k < 3; k++)
                out->c[k] += light * c[k];
            out->guessed += view->guessed[s] ? light * c[3] : 0;
            light -= light * c[3];
        }
        if (light <= (double)WO_LIGHT_MIN || i == last)
            break;
    }
    const bool faint = light <= (double)WO_LIGHT_MIN;
    const bool lost = !faint && view->opaque[place_of(view, x, y, dx, dy)] > 0.5f;
    out->c[3] = 1 - light;
    out->weight = faint || lost ? 1 - light : 1;
    out->guessed += lost ? light : 0;
}

static void march(const wo_march_view *view, int32_t x, int32_t y, int run_index,
                  const wo_pencil *pencil, wo_march_sums *sums)
{
    *sums = (wo_march_sums){0};
    for (int lane = 0; lane < WO_LANES; lane++) {
        double sum[4] = {0};
        double weight[4] = {0};
        double guessed = 0;
        double near[WO_PART_SUMS] = {0};
        double far[WO_PART_SUMS] = {0};
        for (int n = 0; n < pencil->count; n++) {
            ray_sums ray = {.weight = 0};
            double w[4] = {1, 1, 1, 1};
            for (int k = 0; k < 3 && pencil->weight[0]; k++)
                w[k] = (double)pencil->weight[k][n];
            w[3] = (w[0] + w[1] + w[2]) / 3;
            trace(view, x + run_index + WO_PHASES * lane, y, pencil, n, &ray, &sums->steps);
            for (int k = 0; k < 4; k++) {
                sum[k] += w[k] * ray.c[k];
                weight[k] += w[k] * ray.weight;
            }
            for (int k = 0; k < WO_PART_SUMS; k++) {
                near[k] += w[k < WO_PART_BLUR ? k % 3 : 3] * ray.near[k];
                far[k] += w[k < WO_PART_BLUR ? k % 3 : 3] * ray.far[k];
            }
            guessed += w[3] * ray.guessed;
        }
        for (int k = 0; k < 4; k++) {
            sums->c[k][lane] = (float)sum[k];
            sums->weight[k][lane] = (float)weight[k];
        }
        for (int k = 0; k < WO_PART_SUMS; k++) {
            sums->near[k][lane] = (float)near[k];
            sums->far[k][lane] = (float)far[k];
        }
        sums->guessed[lane] = (float)guessed;
    }
}

const wo_march_kernels wo_march_reference = {march, march, march};
