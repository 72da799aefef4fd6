/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "render_camera.h"
#include "render_job.h"

#include <stdlib.h>
#include <string.h>

const char *wo_render_help(const wo_render_job *job, char *buffer, size_t size)
{
    snprintf(buffer, size, "render %s", job->plugin->identifier);
    return buffer;
}

static int unknown_param(const wo_render_job *job, const char *name)
{
    const size_t count = job->context->param_count;
    const char **const names = malloc((count + 1) * sizeof *names);
    char near[1024] = "";
    size_t used = 0;
    for (size_t i = 0; names && i < count; i++)
        if (job->context->params[i].kind != WO_HOST_PARAM_GROUP &&
            job->context->params[i].kind != WO_HOST_PARAM_PAGE)
            names[used++] = job->context->params[i].script_name;
    const int hits = names ? wo_near_words(name, names, used, near, sizeof near) : 0;
    free(names);
    char help[256];
    return wo_usage_fault(wo_render_help(job, help, sizeof help),
                          "%s has no parameter \"%s\"; %s %s", job->plugin->identifier, name,
                          hits ? "did you mean" : "there are", near);
}

/* Writes keys without the name that may stand before each "@"; keys has room for text. */
static void strip_names(const char *name, const char *text, char *keys)
{
    const size_t length = strlen(name);
    bool start = true; /* of the text, or behind a comma */
    while (*text) {
        if (start && strncmp(text, name, length) == 0 && text[length] == '@')
            text += length;
        start = *text == ',';
        *keys++ = *text++;
    }
    *keys = '\0';
}

/* "name=value", or "name@frame:value,name@frame:value,..." for keys. */
static int set_param(wo_render_job *job, const char *text)
{
    const size_t length = strcspn(text, "=@");
    char name[128];
    if (length == 0 || length >= sizeof name || !text[length])
        return wo_usage_fault("render", "--set is \"%s\", but must be NAME=VALUE", text);
    snprintf(name, sizeof name, "%.*s", (int)length, text);
    const wo_host_param_info *const param = wo_host_find_param(job->context, name);
    if (!param)
        return unknown_param(job, name);
    char *const value = malloc(strlen(text) + 1);
    if (!value) {
        wo_message("out of memory for --set %.80s", text);
        return WO_EXIT_FAILURE;
    }
    if (text[length] == '=')
        strcpy(value, text + length + 1);
    else
        strip_names(name, text, value);
    wo_error error = {0};
    const wo_status status = wo_host_param_set_text(job->instance, param->name, value, &error);
    free(value);
    if (status == WO_OK)
        return WO_EXIT_OK;
    if (status == WO_ERR_NOMEM)
        return wo_failure(&error);
    char help[256];
    return wo_usage_fault(wo_render_help(job, help, sizeof help), "--set %s: %s", text, error.text);
}

int wo_render_set_params(wo_render_job *job)
{
    for (int i = 0; i < wo_args_count(job->args, "--set"); i++) {
        const int code = set_param(job, wo_args_value(job->args, "--set", i));
        if (code != WO_EXIT_OK)
            return code;
    }
    wo_camera_choose(job);
    return WO_EXIT_OK;
}
