/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/sheet.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* px to the nearest unmixed pixel on either side, at most: a filter 3 px wide mixes three pixels
   of an edge, and from the first of them to the other side it is three. */
enum { RUN = 4, DIRECTIONS = 4, CHAIN = 4 };
/* A change below this fraction of the whole step is the slope of a surface, in depth and in
   vergence: what is little of the one can be much of the other. */
#define FLAT 0.01
/* What still changes by more at the end of what is looked at is a slope, no step; what changes by
   less there may change twice as fast on the way. */
#define SLOPE 0.04
/* A pixel that is one with a block of 2 x 2 to this fraction is a surface, not a mixture. */
#define SAME 0.01
/* Two surfaces whose blur differs by less than this many px of radius need no repair, */
#define STEP_PX 0.75
/* nor a pixel whose own blur is as near to that of one of them. */
#define OFF_PX 0.1

typedef struct way {
    int8_t x, y; /* px */
} way;

typedef struct repair_job {
    const wo_sheet_source *source;
    wo_sheet *sheet;
    wo_rect counted;
    const float *v; /* [h][w] before any repair */
    float *depth;   /* [h][w] samples as they were filtered; NaN = none */
    way *to;        /* [h][w] to the pixel whose surface a pixel belongs to: mostly itself */
    float *mix;     /* [h][w] out */
    int64_t *rows;
    double step, off; /* dioptres */
    int32_t w, h;
} repair_job;

static void depth_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    repair_job *job = user;
    const wo_image *image = job->source->depth;
    const int last = image->components - 1;
    const int channel = job->source->depth_channel < last ? job->source->depth_channel : last;
    const wo_rect b = image->bounds;
    const int32_t row = job->sheet->area.y1 + (int32_t)index;
    const int32_t y = row < b.y1 ? b.y1 : row >= b.y2 ? b.y2 - 1 : row;
    for (int32_t i = 0; i < job->w; i++) {
        const int32_t column = job->sheet->area.x1 + i;
        const int32_t x = column < b.x1 ? b.x1 : column >= b.x2 ? b.x2 - 1 : column;
        const float z = wo_image_at(image, x, y)[channel];
        job->depth[index * (size_t)job->w + (size_t)i] = isfinite(z) ? z : NAN;
    }
}

/* A step of depth through a pixel along a line: the two surfaces it mixes. */
typedef struct mixed {
    size_t near, far; /* unmixed pixels */
    way to_near, to_far;
    double part;      /* of the near one in the depth */
    double steepness; /* dioptres for each px between them */
} mixed;

static bool inside(const repair_job *job, int32_t x, int32_t y)
{
    return x >= 0 && x < job->w && y >= 0 && y < job->h;
}

/* How far depth runs on from (x, y) in the direction (a, b), in the sense of sign; at most RUN.
 *open: it may run on farther, or beyond the picture. */
static int run_of(const repair_job *job, int32_t x, int32_t y, int a, int b, int sign, bool *open)
{
    const float *at = job->depth + (ptrdiff_t)y * job->w + x;
    const ptrdiff_t next = (ptrdiff_t)b * job->w + a;
    int n = 0;
    while (n < RUN && inside(job, x + (n + 1) * a, y + (n + 1) * b) &&
           (at[(n + 1) * next] - at[n * next]) * (float)sign > 0)
        n++;
    *open = n == RUN || !inside(job, x + (n + 1) * a, y + (n + 1) * b);
    return n;
}

/* How much two pixels differ, relative to the step between two others: in depth or in vergence,
   whatever is more. */
static double difference(const repair_job *job, size_t a, size_t b, const size_t step[2])
{
    const double z = fabs((double)job->depth[step[0]] - (double)job->depth[step[1]]);
    const double v = fabs((double)job->v[step[0]] - (double)job->v[step[1]]);
    const double dz = fabs((double)job->depth[a] - (double)job->depth[b]);
    const double dv = fabs((double)job->v[a] - (double)job->v[b]);
    return fmax(dz / z, dv > 0 && v > 0 ? dv / v : 0);
}

/* Shortens one end of a run by what is slope of a surface; false when all of it may be. */
static bool trim(const repair_job *job, ptrdiff_t next, const size_t whole[2], bool open,
                 size_t *end, int *run)
{
    double flat = FLAT;
    if (open) {
        const double last = difference(job, *end, *end - (size_t)next, whole);
        if (!(last <= SLOPE))
            return false;
        flat = fmax(flat, 2 * last);
    }
    while (*run > 0 && difference(job, *end, *end - (size_t)next, whole) <= flat) {
        *end -= (size_t)next;
        (*run)--;
    }
    return *run > 0;
}

/* Does depth step over the pixel in the direction (a, b), from one surface to another? */
static bool step_along(const repair_job *job, int32_t x, int32_t y, int a, int b, mixed *out)
{
    const size_t here = (size_t)y * (size_t)job->w + (size_t)x;
    const ptrdiff_t next = (ptrdiff_t)b * job->w + a;
    if (!inside(job, x + a, y + b) || !inside(job, x - a, y - b))
        return false;
    const float rise = job->depth[here + (size_t)next] - job->depth[here];
    const float fall = job->depth[here - (size_t)next] - job->depth[here];
    if (!(rise > 0 && fall < 0) && !(rise < 0 && fall > 0))
        return false;
    const int sign = rise > 0 ? 1 : -1;
    bool open[2];
    int up = run_of(job, x, y, a, b, sign, &open[0]);
    int down = run_of(job, x, y, -a, -b, -sign, &open[1]);
    size_t end[2] = {here + (size_t)(up * next), here - (size_t)(down * next)};
    const size_t whole[2] = {end[0], end[1]};
    if (!trim(job, next, whole, open[0], &end[0], &up) ||
        !trim(job, -next, whole, open[1], &end[1], &down))
        return false;
    const bool near = isnan(job->v[end[1]]) || job->v[end[0]] > job->v[end[1]];
    out->near = end[near ? 0 : 1];
    out->far = end[near ? 1 : 0];
    const way first = {(int8_t)(up * a), (int8_t)(up * b)};
    const way second = {(int8_t)(-down * a), (int8_t)(-down * b)};
    out->to_near = near ? first : second;
    out->to_far = near ? second : first;
    if (isnan(job->v[out->near]))
        return false;
    const double far_z = job->depth[out->far];
    out->part = ((double)job->depth[here] - far_z) / ((double)job->depth[out->near] - far_z);
    const double height =
        isnan(job->v[out->far]) ? HUGE_VAL : (double)job->v[out->near] - job->v[out->far];
    out->steepness = height / ((up + down) * (a && b ? 1.41421356237309505 : 1));
    return height > job->step;
}

/* Is the pixel one with a block of 2 x 2? Across an edge depth changes from pixel to pixel. */
static bool is_surface(const repair_job *job, int32_t x, int32_t y, const mixed *m)
{
    const size_t at = (size_t)y * (size_t)job->w + (size_t)x;
    const size_t step[2] = {m->near, m->far};
    for (int corner = 0; corner < 4; corner++) {
        const int a = corner & 1 ? 1 : -1;
        const int b = corner & 2 ? 1 : -1;
        if (x + a < 0 || x + a >= job->w || y + b < 0 || y + b >= job->h)
            continue;
        const ptrdiff_t up = (ptrdiff_t)b * job->w;
        if (difference(job, at, at + (size_t)a, step) <= SAME &&
            difference(job, at, at + (size_t)up, step) <= SAME &&
            difference(job, at, at + (size_t)(up + a), step) <= SAME)
            return true;
    }
    return false;
}

static const int direction[DIRECTIONS][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};

/* Nearly every pixel can be told not to be on a step by the vergences on the line through it, which
   are too near to each other. Bit i of even[k]: so in direction i at x + k. */
static void find_even(const repair_job *job, int32_t x, int32_t y, uint8_t even[WO_STRIP])
{
    memset(even, 0, WO_STRIP);
    if (x < RUN || y < RUN || x + WO_STRIP + RUN > job->w || y + RUN >= job->h)
        return;
    for (int i = 0; i < DIRECTIONS; i++) {
        const ptrdiff_t next = (ptrdiff_t)direction[i][1] * job->w + direction[i][0];
        const float *v = job->v + (ptrdiff_t)y * job->w + x - RUN * next;
        float low[WO_STRIP], high[WO_STRIP];
        float sum[WO_STRIP] = {0}; /* NaN when any is */
        memcpy(low, v, sizeof low);
        memcpy(high, v, sizeof high);
        for (int t = 0; t <= 2 * RUN; t++, v += next)
            for (int k = 0; k < WO_STRIP; k++) {
                low[k] = v[k] < low[k] ? v[k] : low[k];
                high[k] = v[k] > high[k] ? v[k] : high[k];
                sum[k] += v[k];
            }
        for (int k = 0; k < WO_STRIP; k++)
            even[k] |=
                (uint8_t)(((double)high[k] - (double)low[k] <= job->step && !isnan(sum[k])) << i);
    }
}

/* The steepest step over a pixel: the others go along the edge. */
static bool find_step(const repair_job *job, int32_t x, int32_t y, unsigned even, mixed *best)
{
    bool found = false;
    for (int i = 0; i < DIRECTIONS; i++) {
        mixed m = {0};
        if (even & 1u << i || !step_along(job, x, y, direction[i][0], direction[i][1], &m))
            continue;
        if (!found || m.steepness > best->steepness)
            *best = m;
        found = true;
    }
    return found;
}

static void find_pixel(repair_job *job, int32_t x, int32_t y, unsigned even)
{
    const size_t at = (size_t)y * (size_t)job->w + (size_t)x;
    mixed m = {0};
    if (isnan(job->v[at]) || !find_step(job, x, y, even, &m) || is_surface(job, x, y, &m))
        return;
    job->to[at] = m.part >= 0.5 || isnan(job->v[m.far]) ? m.to_near : m.to_far;
    job->mix[at] = (float)m.part;
}

static void find_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    repair_job *job = user;
    const int32_t y = (int32_t)index;
    const size_t w = (size_t)job->w;
    memset(job->to + index * w, 0, w * sizeof *job->to);
    for (size_t at = index * w; at < (index + 1) * w; at++)
        job->mix[at] = NAN;
    for (int32_t x = 0; x < job->w; x += WO_STRIP) {
        uint8_t even[WO_STRIP];
        if (wo_sheet_even(job->v, job->w, job->h, x, y, RUN, job->step, false))
            continue;
        find_even(job, x, y, even);
        for (int32_t i = 0; i < WO_STRIP && x + i < job->w; i++)
            if (even[i] != (1 << DIRECTIONS) - 1)
                find_pixel(job, x + i, y, even[i]);
    }
}

/* Where edges cross, what looked unmixed may be a mixture that belongs to a third pixel. */
static size_t surface_of(const repair_job *job, size_t at)
{
    for (int i = 0; i < CHAIN; i++)
        at += (size_t)((ptrdiff_t)job->to[at].y * job->w + job->to[at].x);
    return at;
}

static void repair_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    repair_job *job = user;
    const int32_t y = job->sheet->area.y1 + (int32_t)index;
    for (int32_t i = 0; i < job->w; i++) {
        const size_t at = index * (size_t)job->w + (size_t)i;
        if (job->to[at].x == 0 && job->to[at].y == 0)
            continue;
        const float v = job->v[surface_of(job, at)];
        if (!(fabs((double)v - (double)job->v[at]) > job->off)) {
            job->mix[at] = NAN;
            continue;
        }
        job->sheet->v[at] = v;
        const int32_t x = job->sheet->area.x1 + i;
        job->rows[index] += y >= job->counted.y1 && y < job->counted.y2 && x >= job->counted.x1 &&
                            x < job->counted.x2;
    }
}

wo_status wo_sheet_repair_depth(const wo_context *context, const wo_sheet_source *source,
                                double px_per_dioptre, wo_rect counted, wo_sheet *sheet, float *mix,
                                int64_t *repaired, wo_error *error)
{
    repair_job job = {.source = source,
                      .sheet = sheet,
                      .counted = counted,
                      .mix = mix,
                      .step = STEP_PX / px_per_dioptre,
                      .off = OFF_PX / px_per_dioptre,
                      .w = wo_rect_width(sheet->area),
                      .h = wo_rect_height(sheet->area)};
    const size_t n = (size_t)job.w * (size_t)job.h;
    float *before = NULL;
    wo_status status = WO_ERR_NOMEM;
    if (!(job.rows = wo_new(context, error, (size_t)job.h, sizeof *job.rows)))
        goto done;
    if (!(job.depth = wo_new_raw(context, error, n, sizeof *job.depth)))
        goto done;
    if (!(job.to = wo_new_raw(context, error, n, sizeof *job.to)))
        goto done;
    if (!(before = wo_new_raw(context, error, n, sizeof *before)))
        goto done;
    memcpy(before, sheet->v, n * sizeof *before);
    job.v = before;
    wo_run(context, depth_row, &job, (size_t)job.h);
    wo_run(context, find_row, &job, (size_t)job.h);
    wo_run(context, repair_row, &job, (size_t)job.h);
    for (int32_t y = 0; y < job.h; y++)
        *repaired += job.rows[y];
    status = WO_OK;
done:
    wo_delete(context, job.rows);
    wo_delete(context, job.depth);
    wo_delete(context, job.to);
    wo_delete(context, before);
    return status;
}
