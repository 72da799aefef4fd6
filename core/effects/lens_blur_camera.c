/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "effects/lens_blur.h"

#include <string.h>

/* Which of the metadata's values cameraFrom keeps its hands off. */
static bool is_own(int32_t from, wo_camera_value value)
{
    switch ((wo_lens_blur_camera)from) {
    case WO_CAMERA_FROM_METADATA:
        return false;
    case WO_CAMERA_FROM_OWN_FOCUS:
        return value == WO_CAMERA_FOCUS;
    case WO_CAMERA_FROM_OWN_STOP:
        return value == WO_CAMERA_F_NUMBER;
    case WO_CAMERA_FROM_OWN_BOTH:
        return value == WO_CAMERA_FOCUS || value == WO_CAMERA_F_NUMBER;
    case WO_CAMERA_FROM_PARAMETERS:
        break;
    }
    return true;
}

void wo_lens_blur_use_camera(wo_lens_blur_params *params, const wo_camera *camera,
                             wo_report *report)
{
    double *const fields[] = {
        [WO_CAMERA_FOCAL_LENGTH] = &params->focal_length,
        [WO_CAMERA_SENSOR_WIDTH] = &params->sensor_width,
        [WO_CAMERA_F_NUMBER] = &params->f_stop,
        [WO_CAMERA_FOCUS] = &params->focus_distance,
        [WO_CAMERA_NEAR] = &params->depth_near,
        [WO_CAMERA_FAR] = &params->depth_far,
        [WO_CAMERA_UNITS] = &params->depth_scale,
    };
    _Static_assert(WO_COUNT(fields) == WO_CAMERA_VALUES, "a field for every value");
    const double units = params->depth_scale;
    for (int i = 0; i < WO_CAMERA_VALUES; i++) {
        const wo_camera_value value = (wo_camera_value)i;
        const bool kept = is_own(params->camera_from, value);
        const bool own = kept || camera->own[i];
        double number;
        const char *name;
        if (!wo_camera_get(camera, value, units, &number, &name))
            continue;
        if (!own)
            *fields[i] = number;
        wo_report_camera(report, wo_camera_key(value), number, wo_camera_unit(value), name,
                         kept  ? "cameraFrom leaves it to the parameter"
                         : own ? "the parameter is set by hand"
                               : "");
    }
    for (int i = 0; i < camera->refused_count; i++)
        wo_report_camera(report, "", 0, "", camera->refused[i].name, camera->refused[i].why);
}
