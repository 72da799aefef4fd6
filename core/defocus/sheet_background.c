/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/sheet.h"

#include <math.h>

/* What is not farther than a surface by this many px of blur radius is not behind it. */
#define BEHIND_PX 1.0
/* As much coverage as this hides what is behind. */
#define WHOLE 0.999f

typedef struct behind_job {
    const wo_sheet *sheets;
    size_t count;
    double gap; /* dioptres */
    wo_sheet *edges;
    wo_sheet *plate;
    wo_sheet *hidden;
} behind_job;

/* Is there a surface in front of vergence v, and none at it or behind it that covers the pixel? */
static bool is_hidden(const behind_job *job, size_t at, double v)
{
    bool nearer = false;
    for (size_t s = 0; s < job->count; s++) {
        const wo_sheet *sheet = &job->sheets[s];
        if (!sheet->any || isnan(sheet->v[at]))
            continue;
        if ((double)sheet->v[at] - v > job->gap)
            nearer = true;
        else if (sheet->c[at][3] > WHOLE)
            return false;
    }
    return nearer;
}

static void keep_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    behind_job *job = user;
    const size_t w = (size_t)wo_rect_width(job->plate->area);
    for (size_t at = index * w; at < (index + 1) * w; at++) {
        const float v = job->plate->v[at];
        if (isnan(v))
            continue;
        if (!is_hidden(job, at, (double)v))
            job->plate->v[at] = NAN;
        else if ((double)job->edges->v[at] - (double)v <= job->gap)
            job->edges->v[at] = NAN;
    }
}

static void lend_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    behind_job *job = user;
    const size_t w = (size_t)wo_rect_width(job->plate->area);
    for (size_t at = index * w; at < (index + 1) * w; at++) {
        if (isnan(job->plate->v[at]))
            continue;
        const float edge = job->edges->v[at];
        wo_sheet *lender =
            isnan(edge) || !is_hidden(job, at, (double)edge) ? job->hidden : job->edges;
        job->plate->v[at] = lender->v[at];
        lender->v[at] = NAN;
    }
}

static void note_any(wo_sheet *sheet)
{
    const size_t n = (size_t)wo_rect_width(sheet->area) * (size_t)wo_rect_height(sheet->area);
    sheet->any = false;
    for (size_t i = 0; i < n && !sheet->any; i++)
        sheet->any = !isnan(sheet->v[i]);
}

void wo_sheet_keep_hidden(const wo_context *context, const wo_sheet *sheets, size_t count,
                          double px_per_dioptre, wo_sheet *edges, wo_sheet *plate)
{
    behind_job job = {sheets, count, BEHIND_PX / px_per_dioptre, edges, plate, NULL};
    wo_run(context, keep_row, &job, (size_t)wo_rect_height(plate->area));
    note_any(plate);
    note_any(edges);
}

void wo_sheet_lend_depth(const wo_context *context, const wo_sheet *sheets, size_t count,
                         double px_per_dioptre, wo_sheet *edges, wo_sheet *hidden, wo_sheet *plate)
{
    behind_job job = {sheets, count, BEHIND_PX / px_per_dioptre, edges, plate, hidden};
    wo_run(context, lend_row, &job, (size_t)wo_rect_height(plate->area));
    note_any(plate);
    note_any(edges);
    note_any(hidden);
}
