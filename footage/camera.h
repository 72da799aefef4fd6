/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_FOOTAGE_CAMERA_H
#define WO_FOOTAGE_CAMERA_H

#include "bridge/raycast.h"
#include "vec.h"

/* A thin lens in the plane z = 0, written here once more and on its own, so that the reference does
   not share mistakes with what it judges. Point u of the unit disc sees through pixel place x the
   line that crosses depth z at pinhole place x + F E u (1/z - vf), because it starts at E u and
   meets the pinhole's ray in the plane of focus. */
typedef struct wo_camera {
    float centre_x, centre_y; /* px: the axis */
    float focal_px;           /* F */
    float radius;             /* E: of the entrance pupil, m */
    float focus;              /* vf: 1/m */
    int blades;
    float turn; /* radians */
} wo_camera;

void wo_camera_make(int width, int height, double focal_mm, double sensor_mm, double f_stop,
                    double focus_m, int blades, double rotation, wo_camera *camera);

/* A point of the open aperture for (s, t) of the unit square, equal areas to equal areas. */
void wo_camera_aperture(const wo_camera *camera, float s, float t, float u[2]);
bool wo_camera_open(const wo_camera *camera, const float u[2]);
/* Area of the opening in units of E^2. */
float wo_camera_area(const wo_camera *camera);

/* The ray of lens point u through pixel place (x, y); t along it is planar depth. */
static inline wo_ray wo_camera_ray(const wo_camera *camera, float x, float y, float ux, float uy)
{
    const float ox = camera->radius * ux, oy = camera->radius * uy;
    return (wo_ray){{ox, oy, 0},
                    1e-3f,
                    {(x - camera->centre_x) / camera->focal_px - ox * camera->focus,
                     (y - camera->centre_y) / camera->focal_px - oy * camera->focus, -1},
                    INFINITY};
}

#endif
