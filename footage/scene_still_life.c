/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "scenes.h"

/* Lathe profiles: radius, height. */
static const float pawn[][2] = {{0.001f, 0},     {0.13f, 0},      {0.13f, 0},      {0.135f, 0.03f},
                                {0.11f, 0.07f},  {0.06f, 0.13f},  {0.045f, 0.28f}, {0.05f, 0.33f},
                                {0.085f, 0.35f}, {0.085f, 0.35f}, {0.08f, 0.375f}, {0.045f, 0.39f},
                                {0.045f, 0.39f}, {0.088f, 0.44f}, {0.098f, 0.5f},  {0.07f, 0.565f},
                                {0.001f, 0.6f}};
static const float vase[][2] = {{0.001f, 0},    {0.14f, 0},     {0.14f, 0},      {0.22f, 0.2f},
                                {0.24f, 0.4f},  {0.16f, 0.62f}, {0.085f, 0.78f}, {0.09f, 0.86f},
                                {0.13f, 0.92f}, {0.13f, 0.92f}, {0.001f, 0.92f}};
static const float bowl[][2] = {{0.001f, 0},    {0.1f, 0},      {0.1f, 0},      {0.09f, 0.03f},
                                {0.2f, 0.1f},   {0.27f, 0.22f}, {0.27f, 0.22f}, {0.25f, 0.22f},
                                {0.25f, 0.22f}, {0.001f, 0.17f}};
static const float cone[][2] = {{0.001f, 0}, {0.3f, 0}, {0.3f, 0}, {0.001f, 1}};

static void room(wo_builder *b)
{
    static const wo_texture floor = {.kind = WO_TEXTURE_CHECKER,
                                     .a = {0.62f, 0.54f, 0.44f},
                                     .b = {0.06f, 0.08f, 0.13f},
                                     .scale = 3.2f,
                                     .grain = 0.25f,
                                     .grain_scale = 2.3f};
    static const wo_texture wall = {.kind = WO_TEXTURE_BRICKS,
                                    .a = {0.42f, 0.4f, 0.42f},
                                    .b = {0.3f, 0.29f, 0.29f},
                                    .scale = 3,
                                    .grain = 0.3f,
                                    .grain_scale = 1.1f};
    static const wo_texture panels[] = {{.kind = WO_TEXTURE_MARBLE,
                                         .a = {0.5f, 0.2f, 0.15f},
                                         .b = {0.75f, 0.5f, 0.35f},
                                         .scale = 2.4f},
                                        {.kind = WO_TEXTURE_DOTS,
                                         .a = {0.25f, 0.35f, 0.6f},
                                         .b = {0.2f, 0.12f, 0.4f},
                                         .scale = 3.2f},
                                        {.kind = WO_TEXTURE_STRIPES,
                                         .a = {0.7f, 0.62f, 0.3f},
                                         .b = {0.2f, 0.4f, 0.35f},
                                         .scale = 3.5f}};
    wo_build_ground(b, (wo_vec){0, 0, -6}, (wo_vec){14, 0, 0}, (wo_vec){0, 0, -9}, &floor);
    /* Surfaces pass through each other, so that no seam is open. */
    wo_build_panel(b, (wo_vec){0, 1.9f, -10}, (wo_vec){9, 0, 0}, (wo_vec){0, 2.1f, 0}, &wall);
    for (int i = 0; i < 3; i++)
        wo_build_panel(b, (wo_vec){-3.1f + 3.0f * (float)i, 1.15f, -9.6f + 0.3f * (float)(i % 2)},
                       (wo_vec){1.1f, 0, 0.15f * (float)(1 - i)}, (wo_vec){0, 1.2f, 0}, &panels[i]);
}

static void middle(wo_builder *b)
{
    static const wo_texture cream = {
        .kind = WO_TEXTURE_VEINS, .a = {0.8f, 0.74f, 0.66f}, .b = {0.55f, 0.2f, 0.14f}, .scale = 7};
    static const wo_texture yellow = {.kind = WO_TEXTURE_CHECKER,
                                      .a = {0.8f, 0.62f, 0.05f},
                                      .b = {0.1f, 0.4f, 0.22f},
                                      .scale = 12};
    static const wo_texture stripes = {.kind = WO_TEXTURE_STRIPES,
                                       .a = {0.85f, 0.3f, 0.05f},
                                       .b = {0.85f, 0.75f, 0.6f},
                                       .scale = 26};
    static const wo_texture dots = {
        .kind = WO_TEXTURE_DOTS, .a = {0.35f, 0.3f, 0.08f}, .b = {0.16f, 0.2f, 0.7f}, .scale = 7};
    static const wo_texture red = {.kind = WO_TEXTURE_MARBLE,
                                   .a = {0.7f, 0.07f, 0.06f},
                                   .b = {0.8f, 0.45f, 0.25f},
                                   .scale = 9};
    static const wo_texture green = {.kind = WO_TEXTURE_STRIPES,
                                     .a = {0.1f, 0.55f, 0.16f},
                                     .b = {0.65f, 0.42f, 0.12f},
                                     .scale = 18};
    static const wo_texture blue = {.kind = WO_TEXTURE_MARBLE,
                                    .a = {0.08f, 0.14f, 0.4f},
                                    .b = {0.75f, 0.78f, 0.8f},
                                    .scale = 5};
    static const wo_texture rose = {.kind = WO_TEXTURE_CHECKER,
                                    .a = {0.75f, 0.4f, 0.42f},
                                    .b = {0.5f, 0.2f, 0.25f},
                                    .scale = 16,
                                    .grain = 0.2f,
                                    .grain_scale = 0.6f};
    static const wo_texture wood = {.kind = WO_TEXTURE_RINGS,
                                    .a = {0.34f, 0.17f, 0.07f},
                                    .b = {0.66f, 0.42f, 0.2f},
                                    .scale = 9};
    static const wo_texture violet = {
        .kind = WO_TEXTURE_DOTS, .a = {0.45f, 0.12f, 0.5f}, .b = {0.9f, 0.75f, 0.3f}, .scale = 8};
    wo_build_lathe(b, &(wo_pose){{0.03f, 0, -3.16f}, 20, 0, 0}, pawn, WO_COUNT(pawn), &cream);
    wo_build_box(b, &(wo_pose){{-0.55f, 0.15f, -3.35f}, 28, 0, 0}, (wo_vec){0.15f, 0.15f, 0.15f},
                 &yellow);
    wo_build_ball(b, &(wo_pose){{0.42f, 0.1f, -3.10f}, 0, 20, 55}, 0.1f, &stripes);
    wo_build_ball(b, &(wo_pose){{-0.42f, 0.3f, -4.25f}, 15, 30, 0}, 0.3f, &dots);
    wo_build_lathe(b, &(wo_pose){{0.28f, 0, -5.00f}, 0, 0, 0}, cone, WO_COUNT(cone), &red);
    wo_build_torus(b, &(wo_pose){{1.05f, 0.37f, -3.85f}, -35, 90, 0}, 0.27f, 0.1f, &green);
    wo_build_lathe(b, &(wo_pose){{-1.35f, 0, -5.10f}, 0, 0, 0}, vase, WO_COUNT(vase), &blue);
    wo_build_box(b, &(wo_pose){{1.05f, 0.32f, -5.40f}, 20, 0, 0}, (wo_vec){0.34f, 0.32f, 0.34f},
                 &rose);
    wo_build_lathe(b, &(wo_pose){{1.1f, 0.64f, -5.40f}, 0, 0, 0}, bowl, WO_COUNT(bowl), &wood);
    wo_build_ball(b, &(wo_pose){{2.3f, 0.7f, -7.60f}, 0, 0, 0}, 0.7f, &wood);
    wo_build_box(b, &(wo_pose){{-2.3f, 0.6f, -7.40f}, 40, 0, 0}, (wo_vec){0.45f, 0.6f, 0.45f},
                 &violet);
    wo_build_torus(b, &(wo_pose){{-0.6f, 0.62f, -7.20f}, 25, 80, 0}, 0.45f, 0.16f, &red);
}

/* Close to the lens, and things that pass through many depths. */
static void near_things(wo_builder *b)
{
    static const wo_texture ball = {.kind = WO_TEXTURE_CHECKER,
                                    .a = {0.3f, 0.36f, 0.75f},
                                    .b = {0.7f, 0.72f, 0.8f},
                                    .scale = 22};
    static const wo_texture box = {.kind = WO_TEXTURE_MARBLE,
                                   .a = {0.12f, 0.65f, 0.55f},
                                   .b = {0.85f, 0.2f, 0.3f},
                                   .scale = 16};
    static const wo_texture white = {.kind = WO_TEXTURE_STRIPES,
                                     .a = {0.85f, 0.84f, 0.8f},
                                     .b = {0.7f, 0.1f, 0.08f},
                                     .scale = 12};
    static const wo_texture brass = {.kind = WO_TEXTURE_STRIPES,
                                     .a = {0.6f, 0.45f, 0.1f},
                                     .b = {0.15f, 0.1f, 0.05f},
                                     .scale = 20};
    static const wo_texture teal = {
        .kind = WO_TEXTURE_PLAIN, .a = {0.05f, 0.35f, 0.4f}, .scale = 1};
    wo_build_ball(b, &(wo_pose){wo_build_view(b, -0.8f, -0.72f, 0.78f), 20, 20, 0}, 0.06f, &ball);
    wo_build_box(b, &(wo_pose){wo_build_view(b, 0.78f, -0.66f, 0.95f), 30, 25, 10},
                 (wo_vec){0.06f, 0.06f, 0.06f}, &box);
    wo_build_rod(b, wo_build_view(b, -1.1f, 0.2f, 1.25f), wo_build_view(b, 0.1f, 1.15f, 1.5f),
                 0.008f, &white);
    wo_build_rod(b, wo_build_view(b, 0.55f, -1.3f, 1.5f), wo_build_view(b, 0.86f, 1.3f, 5.5f),
                 0.012f, &brass);
    wo_build_rod(b, wo_build_view(b, -0.16f, -1.2f, 1.7f), wo_build_view(b, -0.3f, 1.2f, 1.9f),
                 0.005f, &teal);
}

static void bulbs(wo_builder *b)
{
    enum { COUNT = 22 };
    float balls[COUNT][4], radiance[COUNT][3];
    for (int i = 0; i < COUNT; i++) {
        const float t = (float)i / (COUNT - 1), swing = 2 * fabsf(2 * t - 1) - 1;
        balls[i][0] = 3.6f * (2 * t - 1);
        balls[i][1] = 1.12f + 0.28f * swing * swing;
        balls[i][2] = -8.7f;
        balls[i][3] = 0.018f;
        wo_build_colour(b, 0.5f, wo_build_random(b, 20, 60), radiance[i]);
    }
    wo_build_lamps(b, (const float(*)[4])balls, (const float(*)[3])radiance, COUNT);
}

void wo_scene_still_life(wo_builder *b)
{
    static const wo_sky sky = {.zenith = {0.36f, 0.42f, 0.52f},
                               .horizon = {0.34f, 0.34f, 0.35f},
                               .ground = {0.12f, 0.1f, 0.09f},
                               .bounce = {0.1f, 0.09f, 0.08f}};
    static const float warm[3] = {1.05f, 0.9f, 0.7f};
    wo_build_camera(b, 1, 9.5f);
    wo_build_sky(b, &sky);
    wo_build_sun(b, -72, 42, 2.5f, warm);
    room(b);
    middle(b);
    near_things(b);
    bulbs(b);
}
