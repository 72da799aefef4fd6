/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_BENCH_RUN_H
#define WO_CLI_BENCH_RUN_H

#include "args.h"
#include "bench.h"
#include "bench_scene.h"
#include "command.h"

/* The renders of `wideopen bench`: the plugin through the host, pictures in memory. */

typedef struct wo_bench_job {
    wo_bench *bench;
    const wo_args *args; /* --set of every render */
    double limit;        /* s, of one render; it fails when it takes longer */

    wo_host *host; /* with wo_bench_stopped of this job as aborted callback */
    const wo_host_plugin *plugin;
    const wo_host_context_info *context;
    wo_colour *colour;
    int choice[WO_BENCH_METHODS]; /* of parameter method, for each method of bench */

    double deadline; /* of the render that runs; 0 = none */
    wo_bar bar;
    int rendered, to_render; /* for the bar */
} wo_bench_job;

/* Abort callback; user is the job. Any thread. */
bool wo_bench_stopped(void *user);

/* Renders every point of shot from the files of folder, wherever one fails: what went wrong is
   written into the shot and its points. Only an interrupt stops it, or no memory for the points.
   shot->scene and shot->layers are set; shot->points is the caller's to free. */
WO_NODISCARD wo_status wo_bench_shoot(wo_bench_job *job, const char *folder, wo_bench_shot *shot,
                                      wo_error *error);

#endif
