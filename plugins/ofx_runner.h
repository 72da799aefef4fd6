/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_PLUGINS_OFX_RUNNER_H
#define WO_PLUGINS_OFX_RUNNER_H

#include "ofx_suites.h"
#include "wideopen/context.h"

/* The host's threads as a runner of the core; one for each render action. */
typedef struct wo_ofx_threads {
    const OfxMultiThreadSuiteV1 *suite; /* NULL = run on the calling thread */
    unsigned workers;
} wo_ofx_threads;

/* Asks the host how many threads there are; one if it cannot say, has no suite, or the caller is
   already one of them, for the suite does not nest. */
wo_ofx_threads wo_ofx_threads_of(const wo_ofx_suites *suites);

/* threads is borrowed by the runner. */
wo_runner wo_ofx_runner(wo_ofx_threads *threads);

#endif
