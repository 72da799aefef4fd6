/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "blur_footage.h"

#include <stdlib.h>

void blur_footage_setup(const wo_footage *set, int layers, int samples, wo_lens_blur_params *params,
                        wo_image *inputs, wo_plan_args *args)
{
    wo_params_default(wo_lens_blur_table, WO_LENS_BLUR_PARAMS, params);
    params->focal_length = set->options.focal_mm;
    params->sensor_width = WO_FOOTAGE_SENSOR_MM;
    params->f_stop = set->options.f_stop;
    params->focus_distance = set->options.focus_m;
    params->blades = set->options.blades;
    params->rotation = set->options.rotation;
    params->samples = samples;
    for (int i = 0; i < WO_LENS_BLUR_CLIPS; i++)
        inputs[i] = (wo_image){0};
    *args = (wo_plan_args){.geometry = WO_GEOMETRY_INIT, .inputs = inputs};
    args->geometry.format = args->window = set->frame;
    args->geometry.extent = set->colour.bounds;
    inputs[WO_CLIP_SOURCE] = layers > 0 ? set->layer[0] : set->colour;
    inputs[WO_CLIP_DEPTH] = layers > 0 ? set->layer_depth[0] : set->depth;
    for (int i = 1; i < layers && i < WO_LENS_BLUR_LAYERS; i++) {
        inputs[2 * i] = set->layer[i];
        inputs[2 * i + 1] = set->layer_depth[i];
    }
    for (int i = 0; i < WO_LENS_BLUR_CLIPS; i++)
        args->geometry.connected[i] = inputs[i].data != NULL;
}

wo_status blur_footage(const wo_context *context, const wo_footage *set, int layers, int samples,
                       wo_image *out, wo_report *report, wo_error *error)
{
    wo_lens_blur_params params;
    wo_image inputs[WO_LENS_BLUR_CLIPS];
    wo_plan_args args;
    blur_footage_setup(set, layers, samples, &params, inputs, &args);
    const size_t w = (size_t)wo_rect_width(args.window);
    const size_t h = (size_t)wo_rect_height(args.window);
    *out = (wo_image){calloc(4 * w * h, sizeof(float)), args.window,
                      (ptrdiff_t)(4 * w * sizeof(float)), 4};
    if (!out->data)
        return wo_fail(error, WO_ERR_NOMEM, "out of memory for the picture");
    return wo_effect_run(&wo_lens_blur, context, &params, &args, out, report, error);
}
