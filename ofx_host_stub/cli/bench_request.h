/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_BENCH_REQUEST_H
#define WO_CLI_BENCH_REQUEST_H

#include "bench_run.h"

#include <limits.h>

enum { WO_BENCH_SCENES = 32 };

/* What the command line of `wideopen bench` asks for, apart from what needs the plugin. */
typedef struct wo_bench_request {
    const wo_args *args;
    const char *output;
    char root[PATH_MAX];        /* of the footage */
    wo_footage_options footage; /* without a scene */
    char scene[WO_BENCH_SCENES][64];
    int scene_count;
    int folder_count; /* the last so many of them are folders of --scene-dir, in their order */
    bool given[2];    /* layers, sd */
    unsigned threads; /* 0 = all cores */
    bool progress;
} wo_bench_request;

/* Fills request, the settings and numbers of job->bench, and job->limit; the rest of both is zero.
   Returns an exit code, after printing a mistake. */
int wo_bench_read(wo_bench_request *request, const wo_args *args, wo_bench_job *job) WO_NODISCARD;

/* The words of "a,b,c", each shorter than 64 bytes; false when there are more than most or an empty
   one. */
bool wo_bench_split(const char *text, char words[][64], int most, int *count) WO_NODISCARD;

#endif
