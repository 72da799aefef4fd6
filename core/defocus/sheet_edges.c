/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/sheet.h"

#include <math.h>
#include <string.h>

/* Two neighbours whose blur differs by more than this many px of radius are different surfaces. */
#define STEP_PX 0.75
/* Less of the other surface than this is left where it is. */
#define MIX_MIN 0.004
/* How far from the line between the two pure colours a mixture may lie, relative to its length. */
#define RESIDUAL_MAX 0.5
/* Squared distance of two colours from which on colour says more about a mixture than depth. */
#define DEPTH_TRUST 0.01

typedef struct split_job {
    wo_sheet *sheet;
    wo_sheet *edges;
    const float *mix;
    float (*colour)[4]; /* the sheet's colours before any split */
    uint8_t *edge;      /* 1 = a neighbour in 3 x 3 is another surface */
    int64_t *rows;
    double step; /* STEP_PX in dioptres */
    int32_t w, h;
} split_job;

static bool differs(const split_job *job, float a, float b)
{
    return fabs((double)a - b) > job->step;
}

static void mark_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    split_job *job = user;
    const int32_t y = (int32_t)index;
    const float *v = job->sheet->v;
    bool even = false;
    for (int32_t x = 0; x < job->w; x++) {
        const size_t at = index * (size_t)job->w + (size_t)x;
        if (x % WO_STRIP == 0)
            even = wo_sheet_even(v, job->w, job->h, x, y, 1, job->step, true);
        if (even || isnan(v[at]))
            continue;
        for (int32_t b = y > 0 ? -1 : 0; b <= (y + 1 < job->h); b++)
            for (int32_t a = x > 0 ? -1 : 0; a <= (x + 1 < job->w); a++) {
                const float q = v[at + (size_t)(b * job->w + a)];
                if (!isnan(q) && differs(job, q, v[at]))
                    job->edge[at] = 1;
            }
    }
}

/* The surface beside (x, y) with the largest step of vergence; NaN when there is none. */
static float other_surface(const split_job *job, int32_t x, int32_t y)
{
    const float *v = job->sheet->v;
    const float own = v[(size_t)y * (size_t)job->w + (size_t)x];
    float best = NAN;
    for (int32_t b = y > 0 ? -1 : 0; b <= (y + 1 < job->h); b++)
        for (int32_t a = x > 0 ? -1 : 0; a <= (x + 1 < job->w); a++) {
            const float q = v[(size_t)(y + b) * (size_t)job->w + (size_t)(x + a)];
            if (!isnan(q) && differs(job, q, own) && !(fabsf(q - own) <= fabsf(best - own)))
                best = q;
        }
    return best;
}

/* Mean colours of the two surfaces around (x, y), from pixels that mix nothing where there are any.
 */
static bool pure_colours(const split_job *job, int32_t x, int32_t y, float other, double own_c[4],
                         double other_c[4])
{
    const float *v = job->sheet->v;
    const float own = v[(size_t)y * (size_t)job->w + (size_t)x];
    double own_w = 0;
    double other_w = 0;
    for (int i = 0; i < 4; i++)
        own_c[i] = other_c[i] = 0;
    for (int32_t b = -2; b <= 2; b++) {
        for (int32_t a = -2; a <= 2; a++) {
            const int32_t i = x + a;
            const int32_t j = y + b;
            if ((a == 0 && b == 0) || i < 0 || j < 0 || i >= job->w || j >= job->h)
                continue;
            const size_t at = (size_t)j * (size_t)job->w + (size_t)i;
            const double weight = (job->edge[at] ? 1e-3 : 1.0) / (a * a + b * b);
            const bool is_own = !isnan(v[at]) && !differs(job, v[at], own);
            const bool is_other = !isnan(v[at]) && !is_own && !differs(job, v[at], other);
            for (int k = 0; k < 4; k++) {
                own_c[k] += is_own ? weight * job->colour[at][k] : 0;
                other_c[k] += is_other ? weight * job->colour[at][k] : 0;
            }
            own_w += is_own ? weight : 0;
            other_w += is_other ? weight : 0;
        }
    }
    if (!(own_w > 0 && other_w > 0))
        return false;
    for (int k = 0; k < 4; k++) {
        own_c[k] /= own_w;
        other_c[k] /= other_w;
    }
    return true;
}

/* Fraction of the other surface in a mixed colour; 0 when it is no such mixture. expected: what the
   depth says, NaN = nothing. */
static double mixture(const float c[4], const double own[4], const double other[4], double expected)
{
    double along = 0;
    double length = 0;
    double off = 0;
    for (int k = 0; k < 4; k++) {
        const double d = other[k] - own[k];
        along += (c[k] - own[k]) * d;
        length += d * d;
    }
    if (!(length > 1e-6))
        return isnan(expected) ? 0 : expected;
    const double trust = isnan(expected) ? 0 : DEPTH_TRUST;
    const double f =
        fmin(fmax((along + (trust > 0 ? trust * expected : 0)) / (length + trust), 0), 1);
    for (int k = 0; k < 4; k++) {
        const double r = c[k] - own[k] - f * (other[k] - own[k]);
        off += r * r;
    }
    return off <= RESIDUAL_MAX * RESIDUAL_MAX * length ? f : 0;
}

static void split_pixel(split_job *job, size_t at, float other_v, double f, const double own[4],
                        const double other[4])
{
    const float *c = job->colour[at];
    float *back = job->sheet->c[at];
    float *front = job->edges->c[at];
    const bool other_in_front = other_v > job->sheet->v[at];
    job->edges->v[at] = other_v;
    for (int k = 0; k < 4; k++) {
        const double rest = fmax(c[k] - f * other[k], fmin((1 - f) * own[k], 0));
        if (!other_in_front) {
            back[k] = (float)rest;
            front[k] = (float)other[k];
            continue;
        }
        /* What was hidden in this pixel is unmixed, or taken from beside it when too little is
         * left. */
        const double unmixed = f < 0.7 ? rest / (1 - f) : own[k];
        const bool sane = k < 3 && unmixed <= 2 * own[k] + 0.05;
        back[k] = (float)(sane ? unmixed : own[k]);
        front[k] = (float)(f * other[k]);
    }
}

static void split_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    split_job *job = user;
    for (int32_t x = 0; x < job->w; x++) {
        const size_t at = index * (size_t)job->w + (size_t)x;
        if (!job->edge[at] || !isnan(job->edges->v[at]))
            continue;
        double own[4];
        double other[4];
        const float other_v = other_surface(job, x, (int32_t)index);
        if (!pure_colours(job, x, (int32_t)index, other_v, own, other))
            continue;
        const double near_part = job->mix ? job->mix[at] : NAN;
        const double expected = other_v > job->sheet->v[at] ? near_part : 1 - near_part;
        const double f = mixture(job->colour[at], own, other, expected);
        if (f < MIX_MIN)
            continue;
        split_pixel(job, at, other_v, f, own, other);
        job->rows[index]++;
    }
}

wo_status wo_sheet_split_edges(const wo_context *context, double px_per_dioptre, const float *mix,
                               wo_sheet *sheet, wo_sheet *edges, int64_t *split, wo_error *error)
{
    split_job job = {.sheet = sheet,
                     .mix = mix,
                     .edges = edges,
                     .step = STEP_PX / px_per_dioptre,
                     .w = wo_rect_width(sheet->area),
                     .h = wo_rect_height(sheet->area)};
    const size_t n = (size_t)job.w * (size_t)job.h;
    wo_status status = WO_ERR_NOMEM;
    if (!(job.edge = wo_new(context, error, n, sizeof *job.edge)))
        goto done;
    if (!(job.rows = wo_new(context, error, (size_t)job.h, sizeof *job.rows)))
        goto done;
    if (!(job.colour = wo_new_raw(context, error, n, sizeof *job.colour)))
        goto done;
    memcpy(job.colour, sheet->c, n * sizeof *job.colour);
    wo_run(context, mark_row, &job, (size_t)job.h);
    wo_run(context, split_row, &job, (size_t)job.h);
    int64_t total = 0;
    for (int32_t y = 0; y < job.h; y++)
        total += job.rows[y];
    *split += total;
    edges->any = edges->any || total > 0;
    status = WO_OK;
done:
    wo_delete(context, job.edge);
    wo_delete(context, job.rows);
    wo_delete(context, job.colour);
    return status;
}
