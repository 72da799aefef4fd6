/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/sheet.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A surface farther than this counts as "no depth" where an edge needs a neighbour's. */
#define V_NONE 1e-6

wo_status wo_sheet_create(const wo_context *context, wo_rect area, wo_sheet *sheet, wo_error *error)
{
    *sheet = (wo_sheet){.area = area};
    const size_t n = (size_t)wo_rect_width(area) * (size_t)wo_rect_height(area);
    sheet->v = wo_new_raw(context, error, n, sizeof *sheet->v);
    if (sheet->v)
        sheet->c = wo_new_raw(context, error, n, sizeof *sheet->c);
    if (!sheet->c) {
        wo_sheet_destroy(context, sheet);
        return WO_ERR_NOMEM;
    }
    return WO_OK;
}

void wo_sheet_destroy(const wo_context *context, wo_sheet *sheet)
{
    wo_delete(context, sheet->v);
    wo_delete(context, sheet->c);
    *sheet = (wo_sheet){0};
}

bool wo_sheet_range(const wo_sheet *sheet, float *v_min, float *v_max)
{
    enum { LANES = 16 };
    const size_t n = (size_t)wo_rect_width(sheet->area) * (size_t)wo_rect_height(sheet->area);
    float low[LANES];
    float high[LANES];
    for (size_t k = 0; k < LANES; k++) {
        low[k] = INFINITY;
        high[k] = -INFINITY;
    }
    for (size_t i = 0; i < n; i += LANES) {
        const size_t lanes = n - i < LANES ? n - i : LANES;
        for (size_t k = 0; k < lanes; k++) {
            low[k] = sheet->v[i + k] < low[k] ? sheet->v[i + k] : low[k];
            high[k] = sheet->v[i + k] > high[k] ? sheet->v[i + k] : high[k];
        }
    }
    *v_min = low[0];
    *v_max = high[0];
    for (size_t k = 1; k < LANES; k++) {
        *v_min = low[k] < *v_min ? low[k] : *v_min;
        *v_max = high[k] > *v_max ? high[k] : *v_max;
    }
    return *v_min <= *v_max;
}

bool wo_sheet_even(const float *v, int32_t w, int32_t h, int32_t x, int32_t y, int32_t around,
                   double range, bool gaps)
{
    enum { MOST = WO_STRIP + 2 * 8 };
    const int32_t x1 = x > around ? x - around : 0;
    const int32_t x2 = x + WO_STRIP + around < w ? x + WO_STRIP + around : w;
    const int32_t y1 = y > around ? y - around : 0;
    const int32_t y2 = y + around + 1 < h ? y + around + 1 : h;
    float low[MOST], high[MOST];
    int empty = 0;
    for (int32_t i = 0; i < MOST; i++) {
        low[i] = INFINITY;
        high[i] = -INFINITY;
    }
    for (int32_t j = y1; j < y2; j++) {
        const float *row = v + (ptrdiff_t)j * w + x1;
        for (int32_t i = 0; i < x2 - x1; i++) {
            low[i] = row[i] < low[i] ? row[i] : low[i];
            high[i] = row[i] > high[i] ? row[i] : high[i];
            empty |= !(row[i] == row[i]);
        }
    }
    for (int32_t i = 1; i < x2 - x1; i++) {
        low[0] = low[i] < low[0] ? low[i] : low[0];
        high[0] = high[i] > high[0] ? high[i] : high[0];
    }
    return high[0] < low[0] || ((gaps || !empty) && (double)high[0] - (double)low[0] <= range);
}

typedef struct load_job {
    const wo_sheet_source *source;
    wo_rect counted;
    wo_sheet *sheet;
    wo_sheet_counts *rows; /* [h], so that no two workers share one */
    uint8_t *seen;         /* [h][w] 1 = has a depth of its own */
} load_job;

static int32_t clamp_to(int32_t x, int32_t low, int32_t high)
{
    return x < low ? low : x >= high ? high - 1 : x;
}

int wo_read_colour(const wo_image *image, wo_alpha alpha, int32_t x, int32_t y, float c[4])
{
    int sanitised = 0;
    const float *p = wo_image_at(image, clamp_to(x, image->bounds.x1, image->bounds.x2),
                                 clamp_to(y, image->bounds.y1, image->bounds.y2));
    const int n = image->components;
    c[3] = 1;
    for (int i = 0; i < 3; i++)
        c[i] = n == 1 ? p[0] : p[i];
    if (n == 4 && alpha != WO_ALPHA_OPAQUE)
        c[3] = p[3];
    for (int i = 0; i < 4; i++) {
        if (!isfinite(c[i])) {
            c[i] = 0;
            sanitised++;
        } else if (fabsf(c[i]) > WO_COLOUR_MAX) {
            c[i] = copysignf(WO_COLOUR_MAX, c[i]);
            sanitised++;
        }
    }
    c[3] = fminf(fmaxf(c[3], 0), 1);
    if (n == 4 && alpha == WO_ALPHA_UNPREMULTIPLIED)
        for (int i = 0; i < 3; i++)
            c[i] *= c[3];
    return sanitised;
}

bool wo_row_is_plain(const wo_image *image, wo_alpha alpha, int32_t x1, int32_t x2, int32_t y)
{
    const wo_rect b = image->bounds;
    if (image->components != 4 || alpha != WO_ALPHA_PREMULTIPLIED || x1 < b.x1 || x2 > b.x2 ||
        y < b.y1 || y >= b.y2)
        return false;
    static const float low[4] = {-WO_COLOUR_MAX, -WO_COLOUR_MAX, -WO_COLOUR_MAX, 0};
    static const float high[4] = {WO_COLOUR_MAX, WO_COLOUR_MAX, WO_COLOUR_MAX, 1};
    const float *p = wo_image_at(image, x1, y);
    int bad[4] = {0};
    for (int32_t x = x1; x < x2; x++, p += 4)
        for (int k = 0; k < 4; k++)
            bad[k] |= !(p[k] >= low[k]) | !(p[k] <= high[k]);
    return !(bad[0] | bad[1] | bad[2] | bad[3]);
}

/* Samples of the depth in row y, those of the nearest row beyond the bounds; that of column x is
   at (x - bounds.x1) * components. NULL when there is none. */
static const float *depth_row(const wo_sheet_source *source, int32_t y)
{
    const wo_image *image = source->depth;
    if (!image || !image->data)
        return NULL;
    const int last = image->components - 1;
    return wo_image_at(image, image->bounds.x1, clamp_to(y, image->bounds.y1, image->bounds.y2)) +
           (source->depth_channel < last ? source->depth_channel : last);
}

static double vergence_in_row(const wo_sheet_source *source, const float *row, int32_t x, int32_t y,
                              bool *valid)
{
    const wo_image *image = source->depth;
    *valid = true;
    if (!row)
        return 0;
    const double sample =
        row[(ptrdiff_t)(clamp_to(x, image->bounds.x1, image->bounds.x2) - image->bounds.x1) *
            image->components];
    double cosine = 1;
    if (source->reading.mode == WO_DEPTH_RAY) {
        const double cx = 0.5 * ((double)source->format.x1 + source->format.x2);
        const double cy = 0.5 * ((double)source->format.y1 + source->format.y2);
        const double dx = (x + 0.5 - cx) / source->focal_px;
        const double dy = (y + 0.5 - cy) / (source->focal_px * source->stretch);
        cosine = 1 / sqrt(1 + dx * dx + dy * dy);
    }
    return wo_depth_vergence(&source->reading, sample, cosine, valid);
}

double wo_read_vergence(const wo_sheet_source *source, int32_t x, int32_t y, bool *valid)
{
    return vergence_in_row(source, depth_row(source, y), x, y, valid);
}

static void load_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    load_job *job = user;
    const wo_sheet_source *source = job->source;
    const wo_rect area = job->sheet->area;
    const size_t w = (size_t)wo_rect_width(area);
    const int32_t y = area.y1 + (int32_t)index;
    const bool row_counted = y >= job->counted.y1 && y < job->counted.y2;
    wo_sheet_counts *counts = &job->rows[index];
    const float *depth = depth_row(source, y);
    const bool plain = wo_row_is_plain(source->colour, source->alpha, area.x1, area.x2, y);
    if (plain)
        memcpy(job->sheet->c + index * w, wo_image_at(source->colour, area.x1, y),
               w * sizeof *job->sheet->c);
    for (size_t i = 0; i < w; i++) {
        const int32_t x = area.x1 + (int32_t)i;
        const size_t at = index * w + i;
        const bool counted = row_counted && x >= job->counted.x1 && x < job->counted.x2;
        float *c = job->sheet->c[at];
        const int sanitised = plain ? 0 : wo_read_colour(source->colour, source->alpha, x, y, c);
        counts->sanitised_colour += counted ? sanitised : 0;
        const bool empty = c[3] == 0 && c[0] == 0 && c[1] == 0 && c[2] == 0;
        if (empty) {
            job->sheet->v[at] = NAN;
            job->seen[at] = 0;
            continue;
        }
        bool valid;
        double v = vergence_in_row(source, depth, x, y, &valid);
        counts->sanitised_depth += counted && !valid;
        job->seen[at] = v > V_NONE;
        v = source->focus ? wo_focus_from(source->focus, x, y, v) : v - source->v_origin;
        if (v < source->v_min || v > source->v_max) {
            v = fmin(fmax(v, source->v_min), source->v_max);
            counts->clamped_radius += counted;
        }
        job->sheet->v[at] = (float)v;
    }
}

/* Nearest surface with a depth of its own among the pixels at this distance; NaN when none. */
static float ring_vergence(const load_job *job, int32_t i, int32_t j, int ring)
{
    const int32_t w = wo_rect_width(job->sheet->area);
    const int32_t h = wo_rect_height(job->sheet->area);
    float best = NAN;
    for (int32_t b = -ring; b <= ring; b++) {
        for (int32_t a = -ring; a <= ring; a++) {
            const int32_t x = i + a;
            const int32_t y = j + b;
            if ((abs(a) != ring && abs(b) != ring) || x < 0 || y < 0 || x >= w || y >= h)
                continue;
            const size_t at = (size_t)y * (size_t)w + (size_t)x;
            if (job->seen[at] && !(job->sheet->v[at] <= best))
                best = job->sheet->v[at];
        }
    }
    return best;
}

static void edge_depth_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    load_job *job = user;
    const wo_rect area = job->sheet->area;
    const int32_t w = wo_rect_width(area);
    const int32_t y = area.y1 + (int32_t)index;
    for (int32_t i = 0; i < w; i++) {
        const size_t at = index * (size_t)w + (size_t)i;
        const float coverage = job->sheet->c[at][3];
        if (job->seen[at] || isnan(job->sheet->v[at]) || coverage >= 1)
            continue;
        float v = NAN;
        for (int ring = 1; ring <= WO_SHEET_LOAD_MARGIN && isnan(v); ring++)
            v = ring_vergence(job, i, (int32_t)index, ring);
        if (isnan(v))
            continue;
        job->sheet->v[at] = v;
        const int32_t x = area.x1 + i;
        job->rows[index].edge_depth += y >= job->counted.y1 && y < job->counted.y2 &&
                                       x >= job->counted.x1 && x < job->counted.x2;
    }
}

wo_status wo_sheet_load(const wo_context *context, const wo_sheet_source *source, wo_rect counted,
                        wo_sheet *sheet, wo_sheet_counts *counts, wo_error *error)
{
    const size_t w = (size_t)wo_rect_width(sheet->area);
    const size_t h = (size_t)wo_rect_height(sheet->area);
    load_job job = {source, counted, sheet, NULL, NULL};
    job.rows = wo_new(context, error, h, sizeof *job.rows);
    job.seen = job.rows ? wo_new_raw(context, error, w * h, sizeof *job.seen) : NULL;
    if (!job.seen) {
        wo_delete(context, job.rows);
        return WO_ERR_NOMEM;
    }
    wo_run(context, load_row, &job, h);
    wo_run(context, edge_depth_row, &job, h);
    for (size_t y = 0; y < h; y++) {
        counts->sanitised_colour += job.rows[y].sanitised_colour;
        counts->sanitised_depth += job.rows[y].sanitised_depth;
        counts->edge_depth += job.rows[y].edge_depth;
        counts->clamped_radius += job.rows[y].clamped_radius;
    }
    for (size_t i = 0; i < w * h && !sheet->any; i++)
        sheet->any = !isnan(sheet->v[i]);
    wo_delete(context, job.rows);
    wo_delete(context, job.seen);
    return WO_OK;
}
