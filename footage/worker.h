/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_FOOTAGE_WORKER_H
#define WO_FOOTAGE_WORKER_H

#include "wideopen/context.h"

#include <stdatomic.h>

/* Progress over several stages, reported from any worker, one at a time and rising. */
typedef struct wo_progress {
    const wo_context *context;
    double done, share; /* of the whole: earlier stages, this stage */
    size_t steps;       /* of this stage */
    atomic_size_t step;
    atomic_flag busy;
    atomic_bool stopped;
    double shown;
} wo_progress;

void wo_progress_begin(wo_progress *progress, const wo_context *context);

/* The next stage takes share of the whole (all shares add up to 1) in this many steps. Not while
   workers run. */
void wo_progress_stage(wo_progress *progress, double share, size_t steps);
void wo_progress_add(wo_progress *progress, size_t steps);

/* True when the caller wants the work to stop; once true it stays true. Any worker. */
bool wo_progress_aborted(wo_progress *progress);

#endif
