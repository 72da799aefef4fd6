/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "depth_channel.h"
#include "render_job.h"

#include <stdio.h>
#include <string.h>

static int unknown_clip(const wo_render_job *job, const char *name)
{
    char there[512] = "";
    size_t used = 0;
    for (size_t i = 0; i < job->context->clip_count && used < sizeof there; i++)
        if (!job->context->clips[i].output)
            used += (size_t)snprintf(there + used, sizeof there - used, "%s%s", used ? ", " : "",
                                     job->context->clips[i].name);
    char help[256];
    return wo_usage_fault(wo_render_help(job, help, sizeof help),
                          "%s has no clip \"%s\"; it has: %s", job->plugin->identifier, name,
                          there);
}

static int add_clip(wo_render_job *job, const char *text)
{
    const char *const equals = strchr(text, '=');
    char name[128];
    if (!equals || equals == text || (size_t)(equals - text) >= sizeof name || !equals[1])
        return wo_usage_fault("render", "--clip is \"%s\", but must be NAME=FILE", text);
    snprintf(name, sizeof name, "%.*s", (int)(equals - text), text);
    const wo_host_clip_info *const clip = wo_host_find_clip(job->context, name);
    if (!clip || clip->output)
        return unknown_clip(job, name);
    if (wo_inputs_find(job->inputs, clip->name))
        return wo_usage_fault("render", "clip %s is given twice", clip->name);
    wo_error why = {0}, error = {0};
    if (wo_inputs_add(job->inputs, clip, equals + 1, job->frames.numbers[0], &why) == WO_OK) {
        const wo_input *const input = wo_inputs_find(job->inputs, clip->name);
        if (wo_input_found(input))
            wo_message("clip %s: channel %s of %s", clip->name, wo_input_found(input),
                       wo_input_file(input));
        return WO_EXIT_OK;
    }
    wo_fail(&error, why.status, "clip %s: %s", clip->name, why.text);
    return wo_failure(&error);
}

static bool is_depth(const char *clip_text)
{
    char name[128];
    snprintf(name, sizeof name, "%.*s", (int)strcspn(clip_text, "="), clip_text);
    return wo_is_depth_clip(name);
}

int wo_render_add_clips(wo_render_job *job)
{
    /* Depth last: whose it is says which of a file's layers it is. */
    for (int depth = 0; depth < 2; depth++)
        for (int i = 0; i < wo_args_count(job->args, "--clip"); i++) {
            const char *const text = wo_args_value(job->args, "--clip", i);
            if (is_depth(text) != (depth == 1))
                continue;
            const int code = add_clip(job, text);
            if (code != WO_EXIT_OK)
                return code;
        }
    for (size_t i = 0; i < job->context->clip_count; i++) {
        const wo_host_clip_info *const clip = &job->context->clips[i];
        char help[256];
        if (!clip->output && !clip->optional && !wo_inputs_find(job->inputs, clip->name))
            return wo_usage_fault(wo_render_help(job, help, sizeof help),
                                  "%s needs clip %s: give --clip %s=FILE", job->plugin->identifier,
                                  clip->name, clip->name);
    }
    for (int i = 0; i < wo_args_count(job->args, "--raw"); i++) {
        const char *const name = wo_args_value(job->args, "--raw", i);
        wo_input *const input = wo_inputs_find(job->inputs, name);
        if (!input)
            return wo_usage_fault("render", "--raw %s, but no --clip %s=FILE", name, name);
        wo_input_set_raw(input, true);
    }
    return WO_EXIT_OK;
}
