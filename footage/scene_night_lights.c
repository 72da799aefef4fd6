/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "scenes.h"

/* A chess queen. */
static const float figure[][2] = {
    {0.001f, 0},     {0.2f, 0},       {0.2f, 0},       {0.205f, 0.05f}, {0.16f, 0.09f},
    {0.16f, 0.09f},  {0.17f, 0.13f},  {0.12f, 0.2f},   {0.075f, 0.36f}, {0.062f, 0.56f},
    {0.075f, 0.68f}, {0.075f, 0.68f}, {0.13f, 0.7f},   {0.13f, 0.73f},  {0.08f, 0.75f},
    {0.08f, 0.75f},  {0.105f, 0.78f}, {0.07f, 0.81f},  {0.07f, 0.81f},  {0.1f, 0.9f},
    {0.15f, 1.0f},   {0.15f, 1.0f},   {0.125f, 1.0f},  {0.125f, 1.0f},  {0.08f, 1.03f},
    {0.03f, 1.05f},  {0.03f, 1.05f},  {0.045f, 1.08f}, {0.035f, 1.11f}, {0.001f, 1.125f}};

static void street(wo_builder *b)
{
    static const wo_texture ground = {.kind = WO_TEXTURE_BRICKS,
                                      .a = {0.16f, 0.15f, 0.16f},
                                      .b = {0.05f, 0.05f, 0.06f},
                                      .scale = 3.5f,
                                      .grain = 0.4f,
                                      .grain_scale = 0.8f};
    static const wo_texture bricks = {.kind = WO_TEXTURE_BRICKS,
                                      .a = {0.32f, 0.16f, 0.11f},
                                      .b = {0.16f, 0.15f, 0.15f},
                                      .scale = 2.6f,
                                      .grain = 0.3f,
                                      .grain_scale = 0.9f};
    static const wo_texture door = {.kind = WO_TEXTURE_STRIPES,
                                    .a = {0.05f, 0.22f, 0.3f},
                                    .b = {0.04f, 0.13f, 0.2f},
                                    .scale = 5};
    static const wo_texture iron = {
        .kind = WO_TEXTURE_PLAIN, .a = {0.12f, 0.13f, 0.14f}, .scale = 1};
    const wo_vec across_ground = {0, 0, -12}; /* bricks lie along the street */
    wo_build_ground(b, (wo_vec){0, 0, -10}, (wo_vec){22, 0, 0}, across_ground, &ground);
    wo_build_panel(b, (wo_vec){0, 3.6f, -14}, (wo_vec){14, 0, 0}, (wo_vec){0, 4, 0}, &bricks);
    wo_build_panel(b, (wo_vec){2.2f, 1.1f, -13.9f}, (wo_vec){0.8f, 0, 0}, (wo_vec){0, 1.3f, 0},
                   &door);
    for (int i = -7; i <= 9; i++) {
        const float x = 0.8f + 0.22f * (float)i;
        wo_build_rod(b, (wo_vec){x, 0, -6.5f}, (wo_vec){x, 1.35f, -6.5f}, 0.014f, &iron);
    }
    for (int i = 0; i < 2; i++)
        wo_build_rod(b, (wo_vec){-0.9f, 0.2f + 1.05f * (float)i, -6.5f},
                     (wo_vec){3, 0.2f + 1.05f * (float)i, -6.5f}, 0.016f, &iron);
}

static void subject(wo_builder *b)
{
    static const wo_texture stone = {.kind = WO_TEXTURE_MARBLE,
                                     .a = {0.42f, 0.33f, 0.25f},
                                     .b = {0.7f, 0.62f, 0.52f},
                                     .scale = 9};
    static const wo_texture post = {
        .kind = WO_TEXTURE_VEINS, .a = {0.2f, 0.36f, 0.3f}, .b = {0.5f, 0.6f, 0.5f}, .scale = 6};
    static const wo_texture ball = {.kind = WO_TEXTURE_CHECKER,
                                    .a = {0.55f, 0.1f, 0.45f},
                                    .b = {0.3f, 0.32f, 0.08f},
                                    .scale = 16};
    static const wo_texture box = {
        .kind = WO_TEXTURE_DOTS, .a = {0.08f, 0.4f, 0.08f}, .b = {0.7f, 0.25f, 0.6f}, .scale = 12};
    wo_build_box(b, &(wo_pose){{-0.28f, 0.35f, -3}, 20, 0, 0}, (wo_vec){0.2f, 0.4f, 0.2f}, &post);
    wo_build_lathe(b, &(wo_pose){{-0.28f, 0.75f, -3}, 0, 0, 0}, figure, WO_COUNT(figure), &stone);
    wo_build_ball(b, &(wo_pose){{0.48f, 1.02f, -3.3f}, 20, 20, 0}, 0.17f, &ball);
    wo_build_box(b, &(wo_pose){{0.5f, 0.42f, -3.3f}, 35, 0, 0}, (wo_vec){0.26f, 0.43f, 0.26f},
                 &box);
}

static void sprig(wo_builder *b, wo_vec from, wo_vec along, int count)
{
    static const wo_texture leaf = {
        .kind = WO_TEXTURE_PLAIN, .a = {1, 1, 1}, .scale = 9, .grain = 0.35f, .grain_scale = 2};
    enum { LEAVES_MAX = 40 };
    wo_vec corners[LEAVES_MAX][4];
    float tints[LEAVES_MAX][3];
    for (int i = 0; i < count && i < LEAVES_MAX; i++) {
        const float length = wo_build_random(b, 0.03f, 0.06f), t = (float)i / (float)count;
        wo_vec p = wo_vec_along(from, along, t);
        p = wo_vec_add(p, (wo_vec){wo_build_random(b, -0.06f, 0.06f),
                                   wo_build_random(b, -0.05f, 0.05f),
                                   wo_build_random(b, -0.09f, 0.09f)});
        const wo_vec tip =
            wo_vec_unit((wo_vec){wo_build_random(b, -1, 1), wo_build_random(b, -1, 0.4f),
                                 wo_build_random(b, -0.6f, 0.6f)});
        const wo_vec side =
            wo_vec_unit(wo_vec_cross(tip, (wo_vec){wo_build_random(b, -0.3f, 0.3f), 0.3f, 1}));
        corners[i][0] = p;
        corners[i][1] = wo_vec_along(wo_vec_along(p, tip, 0.45f * length), side, 0.3f * length);
        corners[i][2] = wo_vec_along(p, tip, length);
        corners[i][3] = wo_vec_along(wo_vec_along(p, tip, 0.45f * length), side, -0.3f * length);
        const float value = wo_build_random(b, 0.25f, 0.6f);
        tints[i][0] = 0.3f * value;
        tints[i][1] = value;
        tints[i][2] = 0.15f * value;
    }
    wo_build_leaves(b, (const wo_vec(*)[4])corners, count, (const float(*)[3])tints, &leaf);
}

enum { LAMPS_MAX = 200 };

typedef struct lamps {
    float ball[LAMPS_MAX][4], radiance[LAMPS_MAX][3];
    int count;
} lamps;

static void hang(wo_builder *b, lamps *l, wo_vec at, float radius, float strength, float saturation)
{
    if (l->count == LAMPS_MAX)
        return;
    const float ball[4] = {at.x, at.y, at.z, radius};
    for (int i = 0; i < 4; i++)
        l->ball[l->count][i] = ball[i];
    wo_build_colour(b, saturation, strength, l->radiance[l->count]);
    /* Lamps are rather warm. */
    l->radiance[l->count][2] *= 0.65f;
    l->count++;
}

/* A sagging wire with lamps. */
static void garland(wo_builder *b, lamps *l, wo_vec from, wo_vec to, float sag, int count,
                    float radius, float strength)
{
    static const wo_texture wire = {
        .kind = WO_TEXTURE_PLAIN, .a = {0.015f, 0.015f, 0.015f}, .scale = 1};
    enum { POINTS = 17 };
    float points[POINTS][4];
    for (int i = 0; i < POINTS; i++) {
        const float t = (float)i / (POINTS - 1);
        const wo_vec p = wo_vec_along(from, wo_vec_sub(to, from), t);
        points[i][0] = p.x;
        points[i][1] = p.y - 4 * sag * t * (1 - t) + 1.3f * radius;
        points[i][2] = p.z;
        points[i][3] = 0.15f * radius;
    }
    wo_build_rods(b, (const float(*)[4])points, 1, POINTS, NULL, &wire);
    for (int i = 0; i < count; i++) {
        const float t = ((float)i + 0.5f) / (float)count;
        wo_vec p = wo_vec_along(from, wo_vec_sub(to, from), t);
        p.y -= 4 * sag * t * (1 - t);
        hang(b, l, p, radius, strength * wo_build_random(b, 0.5f, 1.6f), 0.45f);
    }
}

static void lights(wo_builder *b)
{
    lamps l = {.count = 0};
    garland(b, &l, (wo_vec){-2.6f, 2.5f, -5}, (wo_vec){2.9f, 2.3f, -8}, 0.5f, 26, 0.014f, 90);
    garland(b, &l, (wo_vec){-4, 2.7f, -9.5f}, (wo_vec){4.5f, 2.9f, -10.5f}, 0.6f, 30, 0.02f, 70);
    garland(b, &l, wo_build_view(b, -1.2f, 1.15f, 1.1f), wo_build_view(b, 0.3f, 1.15f, 1.7f), 0.06f,
            7, 0.0035f, 160);
    for (int i = 0; i < 70; i++) {
        const wo_vec p = {wo_build_random(b, -5.2f, 5.2f), wo_build_random(b, 0.3f, 4.2f),
                          wo_build_random(b, -13.7f, -8)};
        hang(b, &l, p, wo_build_random(b, 0.009f, 0.022f),
             20 * powf(50, powf(wo_build_random(b, 0, 1), 2.5f)), wo_build_random(b, 0.1f, 0.95f));
    }
    for (int i = 0; i < 14; i++) {
        const wo_vec p = wo_build_view(b, wo_build_random(b, -1, 1), wo_build_random(b, -0.9f, 1),
                                       wo_build_random(b, 0.9f, 2));
        hang(b, &l, p, 0.002f, wo_build_random(b, 400, 2000), 0.6f);
    }
    wo_build_lamps(b, (const float(*)[4])l.ball, (const float(*)[3])l.radiance, l.count);
}

void wo_scene_night_lights(wo_builder *b)
{
    static const wo_sky sky = {.zenith = {0.012f, 0.016f, 0.03f},
                               .horizon = {0.02f, 0.02f, 0.026f},
                               .ground = {0.004f, 0.004f, 0.005f},
                               .bounce = {0.004f, 0.004f, 0.005f}};
    static const float moon[3] = {0.1f, 0.14f, 0.22f}, street_lamp[3] = {0.5f, 0.34f, 0.17f};
    wo_build_camera(b, 1.45f, 3);
    wo_build_sky(b, &sky);
    wo_build_sun(b, -50, 45, 2, moon);
    wo_build_sun(b, 65, 35, 4, street_lamp);
    street(b);
    subject(b);
    sprig(b, wo_build_view(b, -1.1f, 0.75f, 1.2f), (wo_vec){0.2f, -0.12f, 0.1f}, 34);
    sprig(b, wo_build_view(b, 0.85f, 0.1f, 1.5f), (wo_vec){0.08f, 0.3f, -0.1f}, 28);
    lights(b);
}
