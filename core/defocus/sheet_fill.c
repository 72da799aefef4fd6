/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/sheet.h"

#include <math.h>
#include <string.h>

/* A surface ends where its neighbour's blur is larger by this many px of radius. */
#define GAP_PX 1.0
/* Less weight than this is no evidence of a surface. */
#define WEIGHT_MIN 1e-4f
/* So much a light is still worth where there is nothing else. */
#define TRUST_MIN 1e-3f

/* Lines through a pixel, and how many steps along each are looked at, at most. */
enum { LINES = 8, FIRST_LINES = 4, REACH = 16, CELL = 8 };
static const int8_t line_way[LINES][2] = {{1, 0}, {0, 1}, {1, 1},  {-1, 1},
                                          {5, 2}, {2, 5}, {-2, 5}, {-5, 2}};
/* Two ends of a line whose colours differ by this belong together hardly any more; a px of blur
   between them counts as BLUR_AS_COLOUR. */
#define ALIKE          0.15f
#define BLUR_AS_COLOUR 0.3f
/* What an end counts whose line has no other end. */
#define ALONE 0.3f
/* The smooth continuation counts as an end so far away, 1/px. */
#define SMOOTH 0.1f

enum { LEVELS_MAX = 16, CHANNELS = 6 }; /* r g b a, vergence: all times weight; weight */

typedef struct level {
    wo_rect cells; /* in units of 2^k px, absolute */
    float (*sum)[CHANNELS];
} level;

typedef struct line_step {
    int x, y;
    ptrdiff_t offset;
} line_step;

typedef struct fill_job {
    const wo_sheet *sheets;
    size_t count;
    double gap; /* dioptres */
    level *fine;
    level *coarse;
    wo_sheet *hidden;
    float *far_v; /* farthest surface of each pixel, NaN when none */
    uint8_t *far_sheet;
    int reach; /* steps along lines */
    line_step step[LINES][REACH + 2];
    float length[LINES]; /* px of a step */
    float *cell_far;     /* farthest vergence of each CELL x CELL px */
    int32_t cell_columns, cell_rows;
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

/* What a colour says about what is beside it: lights are small, and do not go on. */
static float trust(const float c[4])
{
    const float bright = fmaxf(fmaxf(c[0], c[1]), fmaxf(c[2], 1));
    return fmaxf(1 / (bright * bright), TRUST_MIN);
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
        int count = 0;
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
                const float weight = trust(c);
                for (int k = 0; k < 4; k++)
                    sum[k] += weight * c[k];
                sum[4] += weight * job->far_v[q];
                sum[5] += weight;
                count++;
            }
        }
        const float scale = count > 0 ? 1 / (float)count : 0;
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

/* Where a line first meets a farther surface. */
typedef struct line_end {
    float distance; /* px; 0 = nowhere */
    float c[4];
    float v;
} line_end;

/* Of so many steps those that stay inside the area. */
static int steps_inside(const fill_job *job, int32_t x, int32_t y, int line, int sign, int steps)
{
    const int32_t w = wo_rect_width(job->hidden->area);
    const int32_t h = wo_rect_height(job->hidden->area);
    for (; steps > 0; steps--) {
        const int32_t i = x + sign * job->step[line][steps].x;
        const int32_t j = y + sign * job->step[line][steps].y;
        if (i >= 0 && j >= 0 && i < w && j < h)
            break;
    }
    return steps;
}

/* The end's colour is the mean of the first two pixels: the first may be a mixture. */
static line_end find_end(const fill_job *job, int32_t x, int32_t y, int line, int sign, int reach)
{
    line_end end = {0};
    const float *v = job->far_v + (size_t)y * (size_t)wo_rect_width(job->hidden->area) + x;
    const float gap = (float)job->gap;
    const float own = *v - gap;
    const int inside = steps_inside(job, x, y, line, sign, reach + 1);
    float before = own;
    for (int n = 1; n <= reach && n <= inside; n++) {
        const ptrdiff_t at = sign * job->step[line][n].offset;
        const bool farther = v[at] < own && v[at] < before;
        before = v[at] - gap;
        if (isnan(before))
            break;
        if (!farther)
            continue;
        const ptrdiff_t next = n < inside ? sign * job->step[line][n + 1].offset : at;
        end.v = v[at];
        float sum = 0;
        for (int i = 0; i < 2; i++) {
            const float *q = v + (i == 0 ? at : next);
            if (!(fabsf(*q - end.v) <= gap))
                continue;
            const float *c = job->sheets[job->far_sheet[q - job->far_v]].c[q - job->far_v];
            const float weight = trust(c);
            for (int k = 0; k < 4; k++)
                end.c[k] += weight * c[k];
            sum += weight;
        }
        /* A light says nothing. */
        if (sum < 0.5f)
            break;
        for (int k = 0; k < 4; k++)
            end.c[k] /= sum;
        end.distance = (float)n * job->length[line];
        break;
    }
    return end;
}

/* How much the two ends of a line look like one thing that goes on between them: more when they
   are alike and differ from what is around, less the longer the line is than the shortest. */
static float belong(const fill_job *job, const line_end end[2], const float mean[3], float shortest)
{
    const float shorter = shortest / (end[0].distance + end[1].distance);
    const float blur = (end[0].v - end[1].v) / (float)job->gap * BLUR_AS_COLOUR;
    float apart = ALIKE * ALIKE + blur * blur;
    float special = ALIKE * ALIKE;
    for (int k = 0; k < 3; k++) {
        const float d = end[0].c[k] - end[1].c[k];
        const float m = 0.5f * (end[0].c[k] + end[1].c[k]) - mean[k];
        apart += d * d;
        special += m * m;
    }
    return shorter * shorter * shorter * special / apart;
}

/* Continues what ends at a near thing on both sides of it. */
static void look_across(const fill_job *job, int32_t x, int32_t y, int reach, float c[4], float *v)
{
    line_end end[LINES][2];
    float mean[3] = {0};
    float weight = 0;
    float shortest = INFINITY;
    for (int line = 0; line < LINES; line++) {
        /* Too deep behind: the first lines, all around, would have found something. */
        if (line == FIRST_LINES && !(weight > 0))
            return;
        for (int e = 0; e < 2; e++) {
            const line_end *const found = &end[line][e];
            end[line][e] = find_end(job, x, y, line, 1 - 2 * e, reach);
            if (!(found->distance > 0))
                continue;
            weight += 1 / found->distance;
            for (int k = 0; k < 3; k++)
                mean[k] += found->c[k] / found->distance;
        }
        if (end[line][0].distance > 0 && end[line][1].distance > 0)
            shortest = fminf(shortest, end[line][0].distance + end[line][1].distance);
    }
    for (int k = 0; k < 3; k++)
        mean[k] /= weight;
    float sum[5] = {SMOOTH * c[0], SMOOTH * c[1], SMOOTH * c[2], SMOOTH * c[3], SMOOTH * *v};
    weight = SMOOTH;
    for (int line = 0; line < LINES; line++) {
        const bool both = end[line][0].distance > 0 && end[line][1].distance > 0;
        const float factor = both ? belong(job, end[line], mean, shortest) : ALONE;
        for (int e = 0; e < 2; e++) {
            const line_end *const found = &end[line][e];
            if (!(found->distance > 0))
                continue;
            const float w =
                factor * (1 / found->distance - 1 / (job->length[line] * (float)(reach + 1)));
            for (int k = 0; k < 4; k++)
                sum[k] += w * found->c[k];
            sum[4] += w * found->v;
            weight += w;
        }
    }
    for (int k = 0; k < 4; k++)
        c[k] = sum[k] / weight;
    *v = sum[4] / weight;
}

static void cell_far_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    fill_job *job = user;
    const int32_t w = wo_rect_width(job->hidden->area);
    const int32_t h = wo_rect_height(job->hidden->area);
    for (int32_t i = 0; i < job->cell_columns; i++) {
        float far = INFINITY;
        for (int32_t y = (int32_t)index * CELL; y < ((int32_t)index + 1) * CELL && y < h; y++)
            for (int32_t x = i * CELL; x < (i + 1) * CELL && x < w; x++)
                far = fminf(far, job->far_v[(size_t)y * (size_t)w + (size_t)x]);
        job->cell_far[index * (size_t)job->cell_columns + (size_t)i] = far;
    }
}

/* Farthest vergence that a line from somewhere in a cell can meet. */
static float far_around(const fill_job *job, int32_t column, int32_t row)
{
    const int32_t ring = (job->reach + CELL - 1) / CELL;
    float far = INFINITY;
    for (int32_t j = row > ring ? row - ring : 0; j <= row + ring && j < job->cell_rows; j++)
        for (int32_t i = column > ring ? column - ring : 0;
             i <= column + ring && i < job->cell_columns; i++)
            far = fminf(far, job->cell_far[(size_t)j * (size_t)job->cell_columns + (size_t)i]);
    return far;
}

static void across_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const fill_job *job = user;
    const int32_t w = wo_rect_width(job->hidden->area);
    const int32_t y = (int32_t)index;
    for (int32_t column = 0; column < job->cell_columns; column++) {
        const float far = far_around(job, column, y / CELL);
        for (int32_t x = column * CELL; x < (column + 1) * CELL && x < w; x++) {
            const size_t at = index * (size_t)w + (size_t)x;
            float *v = &job->hidden->v[at];
            const double parallax = ((double)job->far_v[at] - (double)far) / job->gap * GAP_PX;
            if (isnan(*v) || !(parallax > GAP_PX))
                continue;
            const int reach = (int)fmin(2 * parallax + 2, job->reach);
            look_across(job, x, y, reach, job->hidden->c[at], v);
        }
    }
}

/* Steps along the lines: one px of the longer axis each. */
static void make_lines(fill_job *job, int levels)
{
    const int margin = wo_sheet_fill_margin(levels);
    job->reach = margin - 1 < REACH ? margin - 1 : REACH;
    for (int line = 0; line < LINES; line++) {
        const int a = line_way[line][0];
        const int b = line_way[line][1];
        const double longer = fmax(fabs((double)a), fabs((double)b));
        job->length[line] = (float)(sqrt((double)(a * a + b * b)) / longer);
        for (int n = 0; n < REACH + 2; n++) {
            line_step *const step = &job->step[line][n];
            step->x = (int)round(n * a / longer);
            step->y = (int)round(n * b / longer);
            step->offset = (ptrdiff_t)step->y * wo_rect_width(job->hidden->area) + step->x;
        }
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
    job.cell_columns = (wo_rect_width(hidden->area) + CELL - 1) / CELL;
    job.cell_rows = (wo_rect_height(hidden->area) + CELL - 1) / CELL;
    if (!(job.cell_far = wo_new(context, error, (size_t)job.cell_columns * (size_t)job.cell_rows,
                                sizeof *job.cell_far)))
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
    make_lines(&job, levels);
    wo_run(context, cell_far_row, &job, (size_t)job.cell_rows);
    wo_run(context, across_row, &job, h);
    hidden->guessed = true;
    for (size_t i = 0; i < n && !hidden->any; i++)
        hidden->any = !isnan(hidden->v[i]);
    status = WO_OK;
done:
    for (int k = 0; k <= levels; k++)
        wo_delete(context, pyramid[k].sum);
    wo_delete(context, job.far_v);
    wo_delete(context, job.cell_far);
    wo_delete(context, job.far_sheet);
    return status;
}
