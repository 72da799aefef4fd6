/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "render_job.h"

#include <math.h>
#include <string.h>

/* The clip that the project is made for; NULL when there is none. */
static const wo_input *main_clip(const wo_render_job *job)
{
    const wo_input *const source = wo_inputs_find(job->inputs, "Source");
    return source ? source : wo_inputs_at(job->inputs, 0);
}

static void choose_project(wo_render_job *job, const wo_input *main)
{
    const wo_io_part *const header = wo_input_header(main);
    job->project = header->display_window;
    job->pixel_aspect = wo_part_aspect(header);
    wo_inputs_fit(job->inputs, main,
                  &(wo_project_pixels){job->project, job->pixel_aspect, job->clip_size});
}

static wo_clip_format format_of(const wo_input *input, const wo_host_source *source)
{
    return (wo_clip_format){source->components, source->pixel_aspect, source->frame_rate,
                            wo_input_is_raw(input)};
}

static wo_status connect_clip(wo_render_job *job, const wo_host_project *project, wo_input *input,
                              wo_error *error)
{
    const wo_host_source source = wo_input_source(input, project);
    for (size_t i = 0; wo_inputs_at(job->inputs, i); i++)
        if (wo_inputs_at(job->inputs, i) == input)
            job->formats[i] = format_of(input, &source);
    return wo_host_set_clip(job->instance, wo_input_clip(input), &source, error);
}

/* Clips for which the plugin wants numbers are raw, whatever they look like. */
static wo_status follow_wishes(wo_render_job *job, const wo_host_project *project, wo_error *error)
{
    const wo_host_preferences *preferences = NULL;
    wo_input *changed[WO_INPUTS_MAX];
    size_t count = 0;
    WO_TRY(wo_host_get_preferences(job->instance, &preferences, error));
    for (size_t i = 0; i < preferences->clip_count; i++) {
        const wo_host_clip_preference *const wish = &preferences->clips[i];
        wo_input *const input = wo_inputs_find(job->inputs, wish->clip);
        if (input && wish->colourspace_count > 0 && !wo_input_is_raw(input) &&
            strcmp(wish->colourspaces[0], WO_OFX_SPACE_RAW) == 0) {
            wo_input_set_raw(input, true);
            changed[count++] = input;
        }
    }
    for (size_t i = 0; i < count; i++)
        WO_TRY(connect_clip(job, project, changed[i], error));
    return WO_OK;
}

/* How long the shot is: what --range says, else what the sequences cover, else what is rendered. It
   must not depend on which of its frames are: farms cut shots into pieces. */
static void choose_range(const wo_render_job *job, wo_host_project *project)
{
    const wo_input *input;
    bool any = false;
    project->first_frame = job->range.count ? job->range.first : job->frames.first;
    project->last_frame = job->range.count ? job->range.last : job->frames.last;
    for (size_t i = 0; !job->range.count && (input = wo_inputs_at(job->inputs, i)); i++) {
        int first, last;
        if (!wo_input_frames(input, &first, &last))
            continue;
        project->first_frame = any ? fmin(project->first_frame, first) : first;
        project->last_frame = any ? fmax(project->last_frame, last) : last;
        any = true;
    }
}

wo_status wo_render_make_instance(wo_render_job *job, wo_error *error)
{
    const wo_input *const main = main_clip(job);
    if (main)
        choose_project(job, main);
    const wo_rect p = job->project;
    wo_host_project project = WO_HOST_PROJECT_INIT;
    project.size[0] = wo_rect_width(p) * job->pixel_aspect;
    project.size[1] = wo_rect_height(p);
    project.offset[0] = p.x1 * job->pixel_aspect;
    project.offset[1] = p.y1;
    project.pixel_aspect = job->pixel_aspect;
    if (main)
        project.frame_rate = wo_input_rate(main, project.frame_rate);
    choose_range(job, &project);
    WO_TRY(wo_host_instance_create(job->host, job->plugin, job->context->name, &project,
                                   &job->instance, error));
    for (size_t i = 0; wo_inputs_at(job->inputs, i); i++)
        WO_TRY(connect_clip(job, &project, wo_inputs_at(job->inputs, i), error));
    return follow_wishes(job, &project, error);
}

static bool is_another_format(const wo_render_job *job)
{
    const wo_input *const main = main_clip(job);
    const wo_io_part *const header = main ? wo_input_header(main) : NULL;
    wo_host_project project = WO_HOST_PROJECT_INIT;
    if (!main)
        return false;
    if (!wo_rect_equal(job->project, header->display_window) ||
        job->pixel_aspect != wo_part_aspect(header))
        return true;
    project.frame_rate = wo_input_rate(main, project.frame_rate);
    for (size_t i = 0; wo_inputs_at(job->inputs, i); i++) {
        wo_input *const input = wo_inputs_at(job->inputs, i);
        const wo_host_source source = wo_input_source(input, &project); /* changes nothing now */
        const wo_clip_format now = format_of(input, &source), *const then = &job->formats[i];
        if (now.components != then->components || now.pixel_aspect != then->pixel_aspect ||
            now.frame_rate != then->frame_rate || now.raw != then->raw)
            return true;
    }
    return false;
}

wo_status wo_render_follow_format(wo_render_job *job, wo_error *error)
{
    if (!is_another_format(job))
        return WO_OK;
    wo_host_instance_destroy(&job->instance);
    WO_TRY(wo_render_make_instance(job, error));
    return wo_render_set_params(job) == WO_EXIT_OK
               ? WO_OK
               : wo_fail(error, WO_ERR_ARGUMENT, "the parameters do not suit these files");
}
