/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "render_camera.h"

#include "wideopen/camera.h"

#include <string.h>

static const char choice[] = "cameraFrom";

static bool is_set(const wo_args *args, const char *name)
{
    for (int i = 0; i < wo_args_count(args, "--set"); i++) {
        const char *const text = wo_args_value(args, "--set", i);
        if (strcspn(text, "=@") == strlen(name) && strncmp(text, name, strlen(name)) == 0)
            return true;
    }
    return false;
}

void wo_camera_own(const wo_args *args, char *own, size_t size)
{
    size_t used = 0;
    own[0] = '\0';
    for (int i = 0; i < WO_CAMERA_VALUES && used < size; i++)
        if (is_set(args, wo_camera_key((wo_camera_value)i)))
            used += (size_t)snprintf(own + used, size - used, "%s%s", used ? " " : "",
                                     wo_camera_key((wo_camera_value)i));
}

static bool is_chosen_here(const wo_render_job *job)
{
    return job->metadata && !is_set(job->args, choice) && wo_host_find_param(job->context, choice);
}

void wo_camera_choose(wo_render_job *job)
{
    wo_error error = {0};
    if (is_chosen_here(job) &&
        wo_host_param_set_text(job->instance, choice, "metadata", &error) != WO_OK)
        wo_message("the camera of the metadata is not used: %s", error.text);
}

static void add(void *to, const char *name, const char *value)
{
    wo_camera_read(to, name, value);
}

void wo_camera_tell(const wo_render_job *job)
{
    const wo_input *const source = wo_inputs_find(job->inputs, "Source");
    wo_camera camera = {0};
    char taken[256] = "";
    size_t used = 0;
    if (!source || !is_chosen_here(job))
        return;
    const char *const file = wo_input_file(source);
    wo_input_metadata(source, add, &camera);
    for (int i = 0; i < WO_CAMERA_VALUES && used < sizeof taken; i++) {
        const wo_camera_value value = (wo_camera_value)i;
        double number;
        const char *name;
        if (!camera.own[i] && wo_camera_get(&camera, value, 1, &number, &name))
            used += (size_t)snprintf(taken + used, sizeof taken - used, "%s%s %g", used ? ", " : "",
                                     wo_camera_key(value), number);
    }
    if (used > 0)
        wo_message("camera of %s: %s (--no-metadata leaves it alone)", file, taken);
    for (int i = 0; i < camera.refused_count; i++)
        wo_message("%s of %s is not used: %s", camera.refused[i].name, file, camera.refused[i].why);
}
