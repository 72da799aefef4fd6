/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "scenes.h"

static const float pot[][2] = {{0.001f, 0},    {0.14f, 0},     {0.14f, 0},     {0.2f, 0.3f},
                               {0.21f, 0.36f}, {0.21f, 0.36f}, {0.24f, 0.36f}, {0.24f, 0.36f},
                               {0.24f, 0.44f}, {0.24f, 0.44f}, {0.001f, 0.42f}};
static const float finial[][2] = {{0.001f, 0},    {0.16f, 0},     {0.16f, 0},     {0.16f, 0.06f},
                                  {0.16f, 0.06f}, {0.06f, 0.12f}, {0.09f, 0.2f},  {0.19f, 0.36f},
                                  {0.15f, 0.52f}, {0.05f, 0.62f}, {0.001f, 0.72f}};

static void garden(wo_builder *b)
{
    static const wo_texture gravel = {.kind = WO_TEXTURE_MARBLE,
                                      .a = {0.2f, 0.17f, 0.12f},
                                      .b = {0.36f, 0.34f, 0.22f},
                                      .scale = 5,
                                      .grain = 0.5f,
                                      .grain_scale = 4};
    static const wo_texture wall = {.kind = WO_TEXTURE_BRICKS,
                                    .a = {0.62f, 0.5f, 0.42f},
                                    .b = {0.46f, 0.44f, 0.4f},
                                    .scale = 4,
                                    .grain = 0.35f,
                                    .grain_scale = 0.5f};
    static const wo_texture hedge = {.kind = WO_TEXTURE_MARBLE,
                                     .a = {0.04f, 0.12f, 0.03f},
                                     .b = {0.2f, 0.38f, 0.08f},
                                     .scale = 14};
    wo_build_ground(b, (wo_vec){0, 0, -7}, (wo_vec){12, 0, 0}, (wo_vec){0, 0, -6}, &gravel);
    wo_build_panel(b, (wo_vec){0, 1.7f, -8.4f}, (wo_vec){9, 0, 0}, (wo_vec){0, 2.2f, 0}, &wall);
    wo_build_box(b, &(wo_pose){{-3.1f, 0.4f, -7.7f}, 0, 0, 0}, (wo_vec){1.2f, 0.5f, 0.3f}, &hedge);
    wo_build_box(b, &(wo_pose){{3.1f, 0.4f, -7.7f}, 0, 0, 0}, (wo_vec){1.2f, 0.5f, 0.3f}, &hedge);
}

static void row_of_things(wo_builder *b)
{
    static const wo_texture_kind kinds[] = {
        WO_TEXTURE_CHECKER, WO_TEXTURE_DOTS, WO_TEXTURE_STRIPES, WO_TEXTURE_MARBLE,
        WO_TEXTURE_VEINS,   WO_TEXTURE_DOTS, WO_TEXTURE_CHECKER};
    for (int i = 0; i < (int)WO_COUNT(kinds); i++) {
        wo_texture base = {.kind = WO_TEXTURE_MARBLE, .scale = 6}, top = {.kind = kinds[i]};
        wo_build_colour(b, 0.45f, 0.6f, base.a);
        wo_build_colour(b, 0.25f, 0.75f, base.b);
        wo_build_colour(b, 0.85f, 0.75f, top.a);
        wo_build_colour(b, 0.6f, 0.8f, top.b);
        top.scale = wo_build_random(b, 8, 16);
        const float x = 0.63f * (float)(i - 3), height = wo_build_random(b, 0.26f, 0.36f);
        const float z = -5.75f + wo_build_random(b, -0.15f, 0.15f);
        const wo_pose foot = {{x, height - 0.06f, z}, wo_build_random(b, -35, 35), 0, 0};
        wo_build_box(b, &foot, (wo_vec){0.19f, height, 0.19f}, &base);
        wo_pose on_top = {{x, 2 * height - 0.06f, z}, wo_build_random(b, 0, 90), 0, 0};
        switch (i % 4) {
        case 0:
            wo_build_lathe(b, &on_top, pot, WO_COUNT(pot), &top);
            break;
        case 1:
            on_top.at.y += 0.21f;
            on_top.pitch = 30;
            wo_build_ball(b, &on_top, 0.22f, &top);
            break;
        case 2:
            wo_build_lathe(b, &on_top, finial, WO_COUNT(finial), &top);
            break;
        default:
            on_top.at.y += 0.27f;
            on_top.pitch = 90;
            on_top.yaw = 20;
            wo_build_torus(b, &on_top, 0.19f, 0.08f, &top);
            break;
        }
    }
}

/* Coloured canes, upright and before the wall. */
static void canes(wo_builder *b)
{
    enum { COUNT = 46, POINTS = 5 };
    static const wo_texture paint = {.kind = WO_TEXTURE_PLAIN, .a = {1, 1, 1}, .scale = 1};
    float points[COUNT * POINTS][4], tints[COUNT][3];
    for (int i = 0; i < COUNT; i++) {
        const float x = wo_build_random(b, -3, 3), z = wo_build_random(b, -7.9f, -6.3f);
        const float height = wo_build_random(b, 0.8f, 2.1f), lean = wo_build_random(b, -0.1f, 0.1f);
        const float radius = wo_build_random(b, 0.006f, 0.016f);
        for (int k = 0; k < POINTS; k++) {
            const float t = (float)k / (POINTS - 1);
            float *const p = points[i * POINTS + k];
            p[0] = x + lean * t;
            p[1] = height * t - 0.02f;
            p[2] = z;
            p[3] = radius;
        }
        wo_build_colour(b, 0.8f, 0.75f, tints[i]);
    }
    wo_build_rods(b, (const float(*)[4])points, COUNT, POINTS, (const float(*)[3])tints, &paint);
}

/* Two sets of slanted wires; every other one lies behind. */
static void wires(wo_builder *b)
{
    enum { EACH = 15, COUNT = 2 * EACH, POINTS = 9 };
    static const wo_texture zinc = {.kind = WO_TEXTURE_MARBLE,
                                    .a = {0.3f, 0.32f, 0.34f},
                                    .b = {0.5f, 0.5f, 0.48f},
                                    .scale = 60};
    float points[COUNT * POINTS][4];
    for (int i = 0; i < COUNT; i++) {
        const float slope = i < EACH ? 1.0f : -1.0f;
        const float middle = 0.115f * ((float)(i % EACH) - 0.5f * (EACH - 1));
        for (int k = 0; k < POINTS; k++) {
            const float t = -0.62f + 1.24f * (float)k / (POINTS - 1);
            /* A place in the picture at 1 m, then out to the fence. */
            const float x = (middle + 0.5f * t) / 0.36f, y = 0.62f * slope * t / 0.2025f;
            const wo_vec p = wo_build_view(b, x, y, 1.15f + (i < EACH ? 0.005f : -0.005f));
            float *const out = points[i * POINTS + k];
            out[0] = p.x;
            out[1] = p.y;
            out[2] = p.z;
            out[3] = 0.0042f;
        }
    }
    wo_build_rods(b, (const float(*)[4])points, COUNT, POINTS, NULL, &zinc);
}

static void vine(wo_builder *b)
{
    enum { COUNT = 46 };
    static const wo_texture leaf = {
        .kind = WO_TEXTURE_PLAIN, .a = {1, 1, 1}, .scale = 12, .grain = 0.35f, .grain_scale = 2};
    wo_vec corners[COUNT][4];
    float tints[COUNT][3];
    for (int i = 0; i < COUNT; i++) {
        const bool right = i % 3 == 0;
        const float t = wo_build_random(b, 0, 1), size = wo_build_random(b, 0.025f, 0.05f);
        const wo_vec p = wo_build_view(
            b, (right ? 0.82f : -0.85f) + wo_build_random(b, -0.22f, 0.22f) * (1.2f - t),
            1.1f - (right ? 1.1f : 1.7f) * t, wo_build_random(b, 1.0f, 1.14f));
        const wo_vec tip = wo_vec_unit(
            (wo_vec){wo_build_random(b, -0.8f, 0.8f), -1, wo_build_random(b, -0.3f, 0.5f)});
        const wo_vec side =
            wo_vec_unit(wo_vec_cross(tip, (wo_vec){wo_build_random(b, -0.5f, 0.5f), 0.2f, 1}));
        corners[i][0] = p;
        corners[i][1] = wo_vec_along(wo_vec_along(p, tip, 0.4f * size), side, 0.42f * size);
        corners[i][2] = wo_vec_along(p, tip, size);
        corners[i][3] = wo_vec_along(wo_vec_along(p, tip, 0.4f * size), side, -0.42f * size);
        const float value = wo_build_random(b, 0.35f, 0.7f);
        tints[i][0] = value * wo_build_random(b, 0.3f, 0.6f);
        tints[i][1] = value;
        tints[i][2] = 0.12f * value;
    }
    wo_build_leaves(b, (const wo_vec(*)[4])corners, COUNT, (const float(*)[3])tints, &leaf);
}

void wo_scene_fence(wo_builder *b)
{
    static const wo_sky sky = {.zenith = {0.4f, 0.5f, 0.7f},
                               .horizon = {0.4f, 0.42f, 0.44f},
                               .ground = {0.12f, 0.11f, 0.08f},
                               .bounce = {0.1f, 0.09f, 0.07f}};
    static const float sun[3] = {0.95f, 0.82f, 0.62f};
    wo_build_camera(b, 1.15f, 3.5f);
    wo_build_sky(b, &sky);
    wo_build_sun(b, -48, 44, 1.2f, sun);
    garden(b);
    row_of_things(b);
    canes(b);
    wires(b);
    vine(b);
}
