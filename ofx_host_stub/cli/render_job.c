/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "render_job.h"

#include "bridge/colour_label.h"
#include "render_camera.h"

#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <time.h>

double wo_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

bool wo_render_progress(void *user, const char *label, double fraction)
{
    wo_render_job *const job = user;
    (void)label;
    if (fraction >= 0) {
        pthread_mutex_lock(&job->lock);
        const double done = (double)job->frame_index + fmin(fraction, 1);
        wo_bar_move(&job->bar, done / (double)job->frames.count);
        pthread_mutex_unlock(&job->lock);
    }
    return !wo_interrupted(NULL);
}

static void publish(void *user, const char *kind, const char *text)
{
    if (!wo_record_publish(user, kind, text))
        wo_message("out of memory: a report of the plugin is lost");
}

/* Each kind of warning once, not while the bar is drawn. */
static void tell_warnings(wo_render_job *job)
{
    for (; job->warnings_told < job->record.warning_count; job->warnings_told++) {
        const wo_warning_record *const w = &job->record.warnings[job->warnings_told];
        if (job->frames.count > 1)
            wo_message("warning: frame %d: %s", w->frame, w->text);
        else
            wo_message("warning: %s", w->text);
    }
}

/* ------------------------------------------------------------------------------------ one frame */

/* The project's pixels at the scale of the render. */
static wo_rect scaled_project(const wo_render_job *job)
{
    const wo_rect p = job->project;
    const double sx = job->render.scale_x, sy = job->render.scale_y;
    return (wo_rect){(int32_t)floor(p.x1 * sx), (int32_t)floor(p.y1 * sy), (int32_t)ceil(p.x2 * sx),
                     (int32_t)ceil(p.y2 * sy)};
}

static bool output_is_raw(wo_render_job *job)
{
    const wo_host_preferences *preferences = NULL;
    if (wo_host_get_preferences(job->instance, &preferences, NULL) != WO_OK)
        return false;
    for (size_t i = 0; i < preferences->clip_count; i++)
        if (strcmp(preferences->clips[i].clip, "Output") == 0)
            return strcmp(preferences->clips[i].colourspace, WO_OFX_SPACE_RAW) == 0;
    return false;
}

/* What the file that was written does not tell or hold. */
static bool warn_of_output(wo_render_job *job, const wo_written *written)
{
    char text[512];
    bool kept = true;
    if (written->unsaid) {
        snprintf(text, sizeof text,
                 "%.200s is in the colour space %.80s, but its format cannot say so: what reads it "
                 "has to be told (--in-space)",
                 written->path, written->space);
        kept = wo_record_warn(&job->record, "output-space", text);
    }
    if (written->cut > 0) {
        snprintf(text, sizeof text,
                 "%.200s: %lld samples lie beyond 65504, all that half holds, and were cut; --bits "
                 "float keeps them",
                 written->path, (long long)written->cut);
        kept = wo_record_warn(&job->record, "output-cut", text) && kept;
    }
    tell_warnings(job);
    return kept;
}

static wo_status write_frame(wo_render_job *job, wo_frame_record *frame, wo_image *image,
                             wo_error *error)
{
    const wo_input *const source = wo_inputs_find(job->inputs, "Source");
    const wo_origin origin = source ? wo_input_origin(source) : (wo_origin){0};
    wo_written written;
    WO_TRY(wo_output_write(&job->output, frame->frame, image, scaled_project(job),
                           source ? &origin : NULL, output_is_raw(job), &written, error));
    frame->output = strdup(written.path);
    frame->space = strdup(written.space);
    return frame->output && frame->space && warn_of_output(job, &written)
               ? WO_OK
               : wo_fail(error, WO_ERR_NOMEM, "out of memory for the report");
}

static void tell_frame(const wo_frame_record *frame)
{
    char copy[96] = "";
    if (frame->identity)
        snprintf(copy, sizeof copy, " (nothing to do: a copy of %s)", frame->identity_clip);
    wo_message("%s: %dx%d in %.2f s, read %.2f s, written %.2f s%s", frame->output,
               wo_rect_width(frame->window), wo_rect_height(frame->window), frame->render_seconds,
               frame->read_seconds, frame->write_seconds, copy);
}

static void tell_plan(const wo_render_job *job, const wo_frame_record *frame)
{
    if (job->frames.count > 1)
        printf("frame %d\n", frame->frame);
    if (frame->identity)
        printf("nothing to do: the output is a copy of %s\n", frame->identity_clip);
    else if (frame->plan)
        printf("%s%s", frame->plan,
               *frame->plan && frame->plan[strlen(frame->plan) - 1] == '\n' ? "" : "\n");
    else
        wo_message("%s does not tell its plan", job->plugin->identifier);
}

/* --window, cut to where the plugin has pixels; empty when there was none. */
static wo_status cut_window(wo_render_job *job, double time, wo_rect *window, wo_error *error)
{
    wo_host_region region;
    wo_rect all;
    *window = job->render.window;
    if (wo_rect_empty(*window))
        return WO_OK;
    WO_TRY(wo_host_get_region(job->instance, time, job->render.scale_x, job->render.scale_y,
                              &region, &all, error));
    *window = wo_rect_intersect(*window, all);
    if (wo_rect_empty(*window))
        return wo_fail(error, WO_ERR_RANGE,
                       "--window holds no pixel of the picture, which reaches from %d,%d to %d,%d",
                       all.x1, all.y1, all.x2, all.y2);
    return WO_OK;
}

static wo_status render_image(wo_render_job *job, wo_frame_record *frame, wo_image *image,
                              wo_error *error)
{
    wo_host_render_args args = job->render;
    wo_host_render_result result = {0};
    WO_TRY(cut_window(job, frame->frame, &args.window, error));
    args.time = frame->frame;
    args.report = job->explain ? WO_HOST_REPORT_EXPLAIN : WO_HOST_REPORT_RENDER;
    args.report_user = &job->record;
    args.publish = publish;
    wo_bar_begin(&job->bar,
                 wo_bar_wanted(wo_args_count(job->args, "--progress") > 0,
                               wo_args_count(job->args, "--no-progress") > 0),
                 job->plugin->label);
    wo_render_progress(job, "", 0);
    const double start = wo_seconds();
    wo_status status = wo_host_render(job->instance, &args, image, &result, error);
    frame->render_seconds = wo_seconds() - start;
    pthread_mutex_lock(&job->lock);
    wo_bar_end(&job->bar);
    pthread_mutex_unlock(&job->lock);
    tell_warnings(job);
    frame->window = result.window;
    frame->actions = result.tiles;
    frame->identity = result.identity;
    if (result.identity && result.identity_clip)
        snprintf(frame->identity_clip, sizeof frame->identity_clip, "%s", result.identity_clip);
    const char *const said = wo_host_persistent_message(job->instance);
    if (status == WO_OK)
        status = wo_inputs_check_given(job->inputs, frame->frame, error);
    if (status == WO_OK && *said)
        wo_message("plugin: %s", said);
    return status;
}

/* A frame that is missing of a clip. */
static wo_status note_missing(wo_render_job *job, wo_error *error, const char *format, ...)
{
    char text[512];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    if (!wo_record_add_warning(&job->record, "missing-frame", text))
        return wo_fail(error, WO_ERR_NOMEM, "out of memory for the report");
    tell_warnings(job);
    return WO_OK;
}

static wo_status note_held(wo_render_job *job, int frame, wo_error *error)
{
    for (size_t i = 0; wo_inputs_at(job->inputs, i); i++) {
        const wo_input *const input = wo_inputs_at(job->inputs, i);
        int held;
        if (wo_input_is_held(input, frame, &held))
            WO_TRY(note_missing(job, error,
                                "clip %s: %.300s has no frame %d, frame %d stands in its place",
                                wo_input_clip(input), wo_input_file(input), frame, held));
    }
    return WO_OK;
}

/* Colours that are read as depth, unless their channel was chosen. */
static wo_status note_colours(wo_render_job *job, wo_error *error)
{
    char channel[32] = "", text[512];
    if (wo_host_param_get_text(job->instance, "depthChannel", 0, channel, sizeof channel) < 0 ||
        strcasecmp(channel, "red") != 0)
        return WO_OK;
    for (size_t i = 0; wo_inputs_at(job->inputs, i); i++) {
        const wo_input *const input = wo_inputs_at(job->inputs, i);
        if (!wo_input_is_coloured_depth(input))
            continue;
        snprintf(text, sizeof text,
                 "clip %s: %.300s shows colours, of which the first is read as depth; name the "
                 "channel that holds it, as in --clip %s=FILE:Z",
                 wo_input_clip(input), wo_input_file(input), wo_input_clip(input));
        if (!wo_record_warn(&job->record, "depth-colour", text))
            return wo_fail(error, WO_ERR_NOMEM, "out of memory for the report");
    }
    tell_warnings(job);
    return WO_OK;
}

/* Names of colour spaces in files that nobody here knows. */
static wo_status note_spaces(wo_render_job *job, wo_error *error)
{
    char text[512];
    for (size_t i = 0; wo_inputs_at(job->inputs, i); i++) {
        const wo_origin from = wo_input_origin(wo_inputs_at(job->inputs, i));
        const char *const name = from.space && !from.forced
                                     ? wo_label_unknown(job->colour, from.path, from.header)
                                     : NULL;
        if (!name)
            continue;
        snprintf(text, sizeof text,
                 "%.200s says that its colours are in %.80s, which the colour configuration does "
                 "not know; they are taken for %.80s (--in-space says otherwise)",
                 from.path, name, from.space);
        if (!wo_record_warn(&job->record, "input-space", text))
            return wo_fail(error, WO_ERR_NOMEM, "out of memory for the report");
    }
    tell_warnings(job);
    return WO_OK;
}

static wo_status render_frame(wo_render_job *job, wo_frame_record *frame, wo_error *error)
{
    const double start = wo_seconds();
    const wo_input *const absent =
        job->missing == WO_MISSING_SKIP ? wo_inputs_missing(job->inputs, frame->frame) : NULL;
    if (absent) {
        frame->skipped = true;
        return note_missing(job, error, "clip %s: %.300s has no frame %d, which is left out",
                            wo_input_clip(absent), wo_input_file(absent), frame->frame);
    }
    WO_TRY(wo_inputs_prepare(job->inputs, frame->frame, error));
    WO_TRY(wo_render_follow_format(job, error));
    WO_TRY(note_held(job, frame->frame, error));
    WO_TRY(note_spaces(job, error));
    if (!job->record.plugin) {
        wo_camera_tell(job);
        WO_TRY(note_colours(job, error));
    }
    if (!job->record.plugin && !wo_record_begin(&job->record, job->instance, frame->frame))
        return wo_fail(error, WO_ERR_NOMEM, "out of memory for the report");
    frame->read_seconds = wo_seconds() - start + job->opening_seconds;
    job->opening_seconds = 0;

    wo_image image = {0};
    WO_TRY(render_image(job, frame, &image, error));
    wo_status status = WO_OK;
    const double rendered = wo_seconds();
    if (!job->explain && image.data) {
        status = write_frame(job, frame, &image, error);
        frame->write_seconds = wo_seconds() - rendered;
    } else if (!job->explain) {
        status = wo_fail(error, WO_ERR_RANGE, "frame %d has no pixels: nothing is written",
                         frame->frame);
    }
    wo_host_image_free(&image);
    return status;
}

wo_status wo_render_frames(wo_render_job *job, wo_error *error)
{
    const bool json = wo_args_count(job->args, "--json") > 0;
    const double start = wo_seconds();
    wo_status status = WO_OK;
    bool any = false;
    for (size_t i = 0; i < job->frames.count && status == WO_OK; i++) {
        wo_frame_record *const frame = wo_record_next(&job->record, job->frames.numbers[i]);
        if (!frame)
            return wo_fail(error, WO_ERR_NOMEM, "out of memory for the report");
        job->frame_index = i;
        status = wo_interrupted(NULL) ? wo_fail(error, WO_ABORTED, "interrupted")
                                      : render_frame(job, frame, error);
        if (status == WO_OK && frame->skipped)
            ;
        else if (status == WO_OK && !job->explain)
            tell_frame(frame);
        else if (status == WO_OK && !json)
            tell_plan(job, frame);
        any = any || !frame->skipped;
        if (status == WO_OK && wo_interrupted(NULL)) /* while it was written, too */
            status = wo_fail(error, WO_ABORTED, "interrupted");
        job->record.seconds = wo_seconds() - start;
    }
    return status == WO_OK && !any
               ? wo_fail(error, WO_ERR_NOT_FOUND, "no frame was rendered: none has all its files")
               : status;
}
