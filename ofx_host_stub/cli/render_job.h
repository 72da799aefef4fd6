/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_RENDER_JOB_H
#define WO_CLI_RENDER_JOB_H

#include "args.h"
#include "command.h"
#include "frames.h"
#include "render_input.h"
#include "render_output.h"
#include "render_report.h"

#include <pthread.h>

/* What the host is told of a clip before it asks for pixels. */
typedef struct wo_clip_format {
    int components;
    double pixel_aspect, frame_rate;
    bool raw;
} wo_clip_format;

/* One run of `wideopen render`: what the command line asked for and what came of it. */
typedef struct wo_render_job {
    const wo_args *args;
    wo_frames frames;
    wo_frames range;            /* of the whole shot; empty = not said */
    wo_host_render_args render; /* scale, window, tiles */
    wo_output output;
    wo_rect project; /* display window at full size, pixels */
    double pixel_aspect;
    wo_clip_size clip_size;
    wo_missing_frames missing;
    bool explain;
    bool metadata; /* plugins see the attributes of the files */
    char own[128]; /* parameters of the camera that --set names */

    wo_host *host;
    const wo_host_plugin *plugin;
    const wo_host_context_info *context;
    wo_host_instance *instance;
    wo_clip_format formats[WO_INPUTS_MAX]; /* that it was made for */
    wo_colour *colour;
    wo_inputs *inputs;
    wo_record record;
    size_t warnings_told;   /* of record's */
    bool judged;            /* the plugin's breaches are printed */
    double opening_seconds; /* spent on reading files before the first frame */

    wo_bar bar; /* drawn by whichever thread has news; guarded by lock */
    pthread_mutex_t lock;
    size_t frame_index;
} wo_render_job;

/* Adds what --clip says, and checks that nothing is missing; gives an exit code, and has said why.
 */
int wo_render_add_clips(wo_render_job *job);

/* Makes the project and an instance in it, with its clips connected. */
WO_NODISCARD wo_status wo_render_make_instance(wo_render_job *job, wo_error *error);

/* Sets what --set says. Returns an exit code and has said what is wrong. */
int wo_render_set_params(wo_render_job *job);

/* "render PLUGIN": the command whose --help lists clips and parameters, for wo_usage_fault. */
const char *wo_render_help(const wo_render_job *job, char *buffer, size_t size);

/* Makes project and instance anew where the files of this frame are of another format than those
   they were made for: a frame must not depend on the one a job began with. */
WO_NODISCARD wo_status wo_render_follow_format(wo_render_job *job, wo_error *error);

/* Renders and writes every frame; stops at the first failure. The instance, its clips and
   parameters are set. */
WO_NODISCARD wo_status wo_render_frames(wo_render_job *job, wo_error *error);

/* Progress callback of the host; user is the job. */
bool wo_render_progress(void *user, const char *label, double fraction);

/* Seconds on a clock that never jumps. */
double wo_seconds(void);

#endif
