/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "worker.h"

void wo_progress_begin(wo_progress *progress, const wo_context *context)
{
    progress->context = context;
    progress->done = progress->share = progress->shown = 0;
    progress->steps = 0;
    atomic_init(&progress->step, 0);
    atomic_flag_clear(&progress->busy);
    atomic_init(&progress->stopped, false);
}

void wo_progress_stage(wo_progress *progress, double share, size_t steps)
{
    progress->done += progress->share;
    progress->share = share;
    progress->steps = steps;
    atomic_store(&progress->step, 0);
}

void wo_progress_add(wo_progress *progress, size_t steps)
{
    const size_t now = atomic_fetch_add(&progress->step, steps) + steps;
    const wo_context *const context = progress->context;
    /* Who finds the line taken does not wait: the next step will report. */
    if (!context || !context->progress || progress->steps == 0 ||
        atomic_flag_test_and_set(&progress->busy))
        return;
    const double fraction =
        progress->done + progress->share * (double)now / (double)progress->steps;
    if (fraction > progress->shown) {
        progress->shown = fraction > 1 ? 1 : fraction;
        context->progress(context->progress_user, progress->shown);
    }
    atomic_flag_clear(&progress->busy);
}

bool wo_progress_aborted(wo_progress *progress)
{
    if (!atomic_load(&progress->stopped) && wo_aborted(progress->context))
        atomic_store(&progress->stopped, true);
    return atomic_load(&progress->stopped);
}
