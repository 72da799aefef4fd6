/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/sheet.h"

#include <math.h>
#include <string.h>

/* A surface ends where its neighbour's blur is larger by this many px of radius. */
#define GAP_PX 1.0
/* Less weight than this is no evidence of a surface. */
#define WEIGHT_MIN 1e-4f

enum { LEVELS_MAX = 16, CHANNELS = 6 }; /* r g b a, vergence: all times weight; weight */

typedef struct level {
    wo_rect cells; /* in units of 2^k px, absolute */
    float (*sum)[CHANNELS];
} level;

typedef struct fill_job {
    const wo_sheet *sheets;
    size_t count;
    double gap; /* dioptres */
    level *fine;
    level *coarse;
    wo_sheet *hidden;
    float *far_v; /* farthest surface of each pixel, NaN when none */
    uint8_t *far_sheet;
} fill_job;

static size_t cell_at(const level *l, int32_t x, int32_t y)
{
    return (size_t)(y - l->cells.y1) * (size_t)wo_rect_width(l->cells) + (size_t)(x - l->cells.x1);
}

static int32_t floor_half(int32_t x)
{
    return x >= 0 ? x / 2 : -((1 - x) / 2);
}

static wo_rect halved(wo_rect r)
{
    return (wo_rect){floor_half(r.x1), floor_half(r.y1), floor_half(r.x2 - 1) + 1,
                     floor_half(r.y2 - 1) + 1};
}

static void farthest_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    fill_job *job = user;
    const size_t w = (size_t)wo_rect_width(job->hidden->area);
    float *far_v = job->far_v + index * w;
    uint8_t *far_sheet = job->far_sheet + index * w;
    for (size_t i = 0; i < w; i++)
        far_v[i] = NAN;
    memset(far_sheet, 0, w);
    for (size_t s = 0; s < job->count; s++) {
        const float *v = job->sheets[s].v + index * w;
        for (size_t i = 0; i < w && job->sheets[s].any; i++) {
            const bool farther = !isnan(v[i]) && !(v[i] >= far_v[i]);
            far_v[i] = farther ? v[i] : far_v[i];
            far_sheet[i] = farther ? (uint8_t)s : far_sheet[i];
        }
    }
}

/* Each near side of an edge learns the mean of the farther surfaces beside it. */
static void seed_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    fill_job *job = user;
    const wo_rect area = job->hidden->area;
    const int32_t w = wo_rect_width(area);
    const int32_t h = wo_rect_height(area);
    const int32_t y = (int32_t)index;
    bool even = false;
    for (int32_t x = 0; x < w; x++) {
        const size_t at = index * (size_t)w + (size_t)x;
        float *sum = job->fine->sum[at];
        if (x % WO_STRIP == 0)
            even = wo_sheet_even(job->far_v, w, h, x, y, 1, job->gap, true);
        if (even || isnan(job->far_v[at]))
            continue;
        for (int32_t b = y > 0 ? -1 : 0; b <= (y + 1 < h); b++) {
            for (int32_t a = x > 0 ? -1 : 0; a <= (x + 1 < w); a++) {
                const size_t q = at + (size_t)(b * w + a);
                if (!((double)job->far_v[at] - job->far_v[q] > job->gap))
                    continue;
                const float *c = job->sheets[job->far_sheet[q]].c[q];
                for (int k = 0; k < 4; k++)
                    sum[k] += c[k];
                sum[4] += job->far_v[q];
                sum[5] += 1;
            }
        }
        const float scale = sum[5] > 0 ? 1 / sum[5] : 0;
        for (int k = 0; k < CHANNELS; k++)
            sum[k] *= scale;
    }
}

static void pull_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    fill_job *job = user;
    const level *fine = job->fine;
    level *coarse = job->coarse;
    const int32_t y = coarse->cells.y1 + (int32_t)index;
    const wo_rect f = fine->cells;
    const ptrdiff_t w = wo_rect_width(f);
    for (int32_t x = coarse->cells.x1; x < coarse->cells.x2; x++) {
        float *sum = coarse->sum[index * (size_t)wo_rect_width(coarse->cells) +
                                 (size_t)(x - coarse->cells.x1)];
        for (int32_t j = 2 * y; j < 2 * y + 2; j++) {
            for (int32_t i = 2 * x; i < 2 * x + 2; i++) {
                if (i < f.x1 || i >= f.x2 || j < f.y1 || j >= f.y2)
                    continue;
                const float *part = fine->sum[(j - f.y1) * w + i - f.x1];
                for (int k = 0; k < CHANNELS && part[5] > 0; k++)
                    sum[k] += part[k];
            }
        }
        if (!(sum[5] > 0))
            continue;
        const float scale = sum[5] > 1 ? 1 / sum[5] : 1;
        for (int k = 0; k < CHANNELS; k++)
            sum[k] *= scale;
    }
}

static void push_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    fill_job *job = user;
    level *fine = job->fine;
    const level *coarse = job->coarse;
    const wo_rect c = coarse->cells;
    const int32_t y = fine->cells.y1 + (int32_t)index;
    float(*row)[CHANNELS] = fine->sum + cell_at(fine, fine->cells.x1, y);
    const int32_t y0 = floor_half(y);
    const int32_t y1 = y & 1 ? y0 + 1 : y0 - 1;
    const size_t w = (size_t)wo_rect_width(c);
    const size_t row0 = (size_t)(y0 - c.y1) * w;
    const size_t row1 = y1 >= c.y1 && y1 < c.y2 ? (size_t)(y1 - c.y1) * w : row0;
    for (int32_t x = fine->cells.x1; x < fine->cells.x2; x++) {
        float *sum = row[x - fine->cells.x1];
        const float rest = 1 - sum[5];
        if (!(rest > 0))
            continue;
        const int32_t x0 = floor_half(x);
        int32_t x1 = x & 1 ? x0 + 1 : x0 - 1;
        if (x1 < c.x1 || x1 >= c.x2)
            x1 = x0;
        const size_t i0 = (size_t)(x0 - c.x1);
        const size_t i1 = (size_t)(x1 - c.x1);
        const float *p00 = coarse->sum[row0 + i0];
        const float *p01 = coarse->sum[row0 + i1];
        const float *p10 = coarse->sum[row1 + i0];
        const float *p11 = coarse->sum[row1 + i1];
        for (int k = 0; k < CHANNELS; k++)
            sum[k] += rest * 0.0625f * (9 * p00[k] + 3 * p01[k] + 3 * p10[k] + p11[k]);
    }
}

static void emit_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    fill_job *job = user;
    const size_t w = (size_t)wo_rect_width(job->hidden->area);
    for (size_t at = index * w; at < (index + 1) * w; at++) {
        const float *sum = job->fine->sum[at];
        const float weight = sum[5];
        const float v = sum[4] / weight;
        const bool behind = weight > WEIGHT_MIN && (double)job->far_v[at] - (double)v > job->gap;
        job->hidden->v[at] = behind ? v : NAN;
        for (int k = 0; k < 4; k++)
            job->hidden->c[at][k] = behind ? sum[k] / weight : 0;
    }
}

int32_t wo_sheet_fill_margin(int levels)
{
    return (int32_t)1 << (levels + 1);
}

wo_status wo_sheet_fill_hidden(const wo_context *context, const wo_sheet *sheets, size_t count,
                               double px_per_dioptre, int levels, wo_sheet *hidden, wo_error *error)
{
    level pyramid[LEVELS_MAX + 1] = {0};
    fill_job job = {
        .sheets = sheets, .count = count, .gap = GAP_PX / px_per_dioptre, .hidden = hidden};
    const size_t n = (size_t)wo_rect_width(hidden->area) * (size_t)wo_rect_height(hidden->area);
    wo_status status = WO_ERR_NOMEM;
    levels = levels > LEVELS_MAX ? LEVELS_MAX : levels;
    if (!(job.far_v = wo_new_raw(context, error, n, sizeof *job.far_v)))
        goto done;
    if (!(job.far_sheet = wo_new_raw(context, error, n, sizeof *job.far_sheet)))
        goto done;
    for (int k = 0; k <= levels; k++) {
        level *l = &pyramid[k];
        l->cells = k == 0 ? hidden->area : halved(pyramid[k - 1].cells);
        const size_t cells = (size_t)wo_rect_width(l->cells) * (size_t)wo_rect_height(l->cells);
        if (!(l->sum = wo_new_large(context, error, cells, sizeof *l->sum)))
            goto done;
    }
    const size_t h = (size_t)wo_rect_height(hidden->area);
    job.fine = &pyramid[0];
    wo_run(context, farthest_row, &job, h);
    wo_run(context, seed_row, &job, h);
    for (int k = 1; k <= levels; k++) {
        job.fine = &pyramid[k - 1];
        job.coarse = &pyramid[k];
        wo_run(context, pull_row, &job, (size_t)wo_rect_height(job.coarse->cells));
    }
    for (int k = levels; k >= 1; k--) {
        job.fine = &pyramid[k - 1];
        job.coarse = &pyramid[k];
        wo_run(context, push_row, &job, (size_t)wo_rect_height(job.fine->cells));
    }
    wo_run(context, emit_row, &job, h);
    hidden->guessed = true;
    for (size_t i = 0; i < n && !hidden->any; i++)
        hidden->any = !isnan(hidden->v[i]);
    status = WO_OK;
done:
    for (int k = 0; k <= levels; k++)
        wo_delete(context, pyramid[k].sum);
    wo_delete(context, job.far_v);
    wo_delete(context, job.far_sheet);
    return status;
}
