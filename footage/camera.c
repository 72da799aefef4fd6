/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "camera.h"

void wo_camera_make(int width, int height, double focal_mm, double sensor_mm, double f_stop,
                    double focus_m, int blades, double rotation, wo_camera *camera)
{
    *camera = (wo_camera){
        .centre_x = 0.5f * (float)width,
        .centre_y = 0.5f * (float)height,
        .focal_px = (float)(width * focal_mm / sensor_mm),
        .radius = (float)(focal_mm * 1e-3 / (2 * f_stop)),
        .focus = (float)(1 / focus_m),
        .blades = blades,
        .turn = (float)(fmod(rotation, 360) * 3.14159265358979323846 / 180),
    };
}

void wo_camera_aperture(const wo_camera *camera, float s, float t, float u[2])
{
    if (camera->blades == 0) {
        /* Squares round the middle become circles (Shirley and Chiu 1997). */
        const float a = 2 * s - 1, b = 2 * t - 1;
        float r, angle;
        if (fabsf(a) > fabsf(b)) {
            r = a;
            angle = WO_PI / 4 * (b / a);
        } else {
            r = b;
            angle = b != 0 ? WO_PI / 2 - WO_PI / 4 * (a / b) : 0;
        }
        u[0] = r * cosf(angle);
        u[1] = r * sinf(angle);
        return;
    }
    /* A triangle from the middle to two neighbouring corners, then a place in it. */
    const float sector = s * (float)camera->blades;
    const int i = (int)sector < camera->blades ? (int)sector : camera->blades - 1;
    const float step = 2 * WO_PI / (float)camera->blades;
    const float from = camera->turn + step * (float)i, to = from + step;
    const float r = sqrtf(t), along = sector - (float)i;
    u[0] = r * wo_mix(cosf(from), cosf(to), along);
    u[1] = r * wo_mix(sinf(from), sinf(to), along);
}

bool wo_camera_open(const wo_camera *camera, const float u[2])
{
    const float r = u[0] * u[0] + u[1] * u[1];
    if (camera->blades == 0 || r > 1)
        return r <= 1;
    const float step = 2 * WO_PI / (float)camera->blades;
    const float side = cosf(0.5f * step);
    for (int i = 0; i < camera->blades; i++) {
        const float angle = camera->turn + step * ((float)i + 0.5f);
        if (u[0] * cosf(angle) + u[1] * sinf(angle) > side)
            return false;
    }
    return true;
}

float wo_camera_area(const wo_camera *camera)
{
    return camera->blades == 0
               ? WO_PI
               : 0.5f * (float)camera->blades * sinf(2 * WO_PI / (float)camera->blades);
}
