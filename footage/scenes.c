/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "scenes.h"

const wo_wave_plane wo_two_planes[2] = {
    {WO_TWO_PLANES_FRONT,
     WO_TWO_PLANES_EDGE *WO_TWO_PLANES_FRONT - 2,
     2,
     {.kind = WO_TEXTURE_WAVES, .a = {0.55f, 0.1f, 0.04f}, .b = {1, 0.6f, 0.2f}, .scale = 9}},
    {WO_TWO_PLANES_BACK,
     0,
     8,
     {.kind = WO_TEXTURE_WAVES, .a = {0.01f, 0.05f, 0.12f}, .b = {0.1f, 0.4f, 0.6f}, .scale = 4}},
};

const wo_lamp wo_single_lamp = {{0.012f, -0.007f, -1}, 0.0006f, {1000, 800, 500}};

static void two_planes(wo_builder *b)
{
    for (int i = 0; i < 2; i++) {
        const wo_wave_plane *const p = &wo_two_planes[i];
        wo_build_chart(b, (wo_vec){p->centre_x, 0, -p->depth}, (wo_vec){p->half, 0, 0},
                       (wo_vec){0, p->half, 0}, &p->texture);
    }
}

static void slanted_plane(wo_builder *b)
{
    static const wo_texture texture = {.kind = WO_TEXTURE_CHART,
                                       .a = {0.03f, 0.035f, 0.05f},
                                       .b = {0.85f, 0.8f, 0.7f},
                                       .scale = 9};
    wo_build_camera(b, 0.45f, 20);
    wo_build_chart(b, (wo_vec){0, 0, -2}, (wo_vec){4, 0, 0}, (wo_vec){0, 0, -4}, &texture);
}

static void lamp(wo_builder *b)
{
    const wo_vec c = wo_single_lamp.centre;
    const float ball[1][4] = {{c.x, c.y, c.z, wo_single_lamp.radius}};
    wo_build_lamps(b, ball, &wo_single_lamp.radiance, 1);
}

const wo_scene_entry wo_scene_entries[] = {
    {{"still-life", "A room of solids on a checkered floor, some of them close to the lens.", 960,
      540, 50, 1.4, 3.3},
     wo_scene_still_life},
    {{"night-lights",
      "A dark street with lamps of radiance 20 to 2000 before and behind the focus.", 640, 360, 50,
      1.2, 3},
     wo_scene_night_lights},
    {{"fence", "A garden seen through a wire fence that is close and out of focus.", 960, 540, 50,
      1.8, 6},
     wo_scene_fence},
    {{"slanted-plane", "One chart that runs through the focus at an angle, and nothing else.", 640,
      360, 50, 1.4, 1.3},
     slanted_plane},
    {{"hair", "Thousands of strands and blades, thinner than pixels.", 640, 360, 50, 1.8, 1.75},
     wo_scene_hair},
    {{"two-planes", "A plane with a straight edge over half of another: edges in closed form.", 640,
      360, 50, 1.4, 4},
     two_planes},
    {{"lamp", "One small lamp in the dark: the point spread of the lens.", 320, 180, 50, 1.4, 4},
     lamp},
};

const size_t wo_scene_entry_count = WO_COUNT(wo_scene_entries);
