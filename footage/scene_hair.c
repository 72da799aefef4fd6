/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "scenes.h"

enum { STRANDS = 5200, POINTS = 7, BLADES = 420, BLADE_POINTS = 5 };

static void set_point(float out[4], wo_vec p, float radius)
{
    out[0] = p.x;
    out[1] = p.y;
    out[2] = p.z;
    out[3] = radius;
}

/* A ball with hair that starts upright and then hangs. */
static void head(wo_builder *b)
{
    static const wo_texture skin = {.kind = WO_TEXTURE_MARBLE,
                                    .a = {0.3f, 0.16f, 0.08f},
                                    .b = {0.45f, 0.26f, 0.14f},
                                    .scale = 12};
    static const wo_texture hair = {.kind = WO_TEXTURE_PLAIN, .a = {1, 1, 1}, .scale = 1};
    const wo_vec centre = {0.03f, 0.98f, -2.05f};
    const float radius = 0.24f, golden = WO_PI * (3 - sqrtf(5));
    wo_build_ball(b, &(wo_pose){centre, 0, 0, 0}, radius, &skin);
    float(*points)[4] = wo_build_new(b, STRANDS * POINTS, sizeof *points);
    float(*tints)[3] = wo_build_new(b, STRANDS, sizeof *tints);
    for (int i = 0; i < STRANDS && points && tints; i++) {
        const float h = 1 - 2 * ((float)i + 0.5f) / STRANDS, r = sqrtf(1 - h * h);
        const float angle = golden * (float)i;
        const wo_vec root = {r * cosf(angle), h, r * sinf(angle)};
        const float length = wo_build_random(b, 0.12f, 0.2f);
        wo_vec p = wo_vec_along(centre, root, 0.98f * radius);
        wo_vec way = wo_vec_add(root, (wo_vec){wo_build_random(b, -0.25f, 0.25f),
                                               wo_build_random(b, -0.25f, 0.25f),
                                               wo_build_random(b, -0.25f, 0.25f)});
        for (int k = 0; k < POINTS; k++) {
            const float t = (float)k / (POINTS - 1);
            set_point(points[i * POINTS + k], p, 0.0011f * (1 - 0.8f * t));
            way = wo_vec_unit(wo_vec_add(way, (wo_vec){0.12f, -0.32f, 0}));
            p = wo_vec_along(p, way, length / (POINTS - 1));
        }
        /* Two colours in bands, and some variety. */
        const float band = 0.5f + 0.5f * sinf(9 * root.y + 3 * root.x);
        const float value = wo_build_random(b, 0.55f, 1.05f);
        tints[i][0] = value * wo_mix(0.72f, 0.3f, band);
        tints[i][1] = value * wo_mix(0.42f, 0.1f, band);
        tints[i][2] = value * wo_mix(0.16f, 0.05f, band);
    }
    if (points && tints)
        wo_build_rods(b, (const float(*)[4])points, STRANDS, POINTS, (const float(*)[3])tints,
                      &hair);
    wo_build_free(b, points);
    wo_build_free(b, tints);
}

/* Blades of grass from before the focus to far behind. */
static void grass(wo_builder *b)
{
    static const wo_texture green = {.kind = WO_TEXTURE_PLAIN, .a = {1, 1, 1}, .scale = 1};
    float(*points)[4] = wo_build_new(b, BLADES * BLADE_POINTS, sizeof *points);
    float(*tints)[3] = wo_build_new(b, BLADES, sizeof *tints);
    for (int i = 0; i < BLADES && points && tints; i++) {
        /* As many for every step of vergence. */
        const float depth = 1 / wo_build_random(b, 0.19f, 1.25f);
        const float x = wo_build_random(b, -0.42f, 0.42f) * depth;
        const float height = depth < 1.5f ? wo_build_random(b, 0.25f, 0.4f) * depth + 0.55f
                                          : wo_build_random(b, 0.6f, 1.15f);
        const float bend = wo_build_random(b, -0.2f, 0.2f) * height;
        for (int k = 0; k < BLADE_POINTS; k++) {
            const float t = (float)k / (BLADE_POINTS - 1);
            set_point(points[i * BLADE_POINTS + k],
                      (wo_vec){x + bend * t * t, height * (t - 0.1f * t * t), -depth},
                      0.0032f * (1 - 0.9f * t));
        }
        const float value = wo_build_random(b, 0.25f, 0.8f), dry = wo_build_random(b, 0, 1);
        tints[i][0] = value * wo_mix(0.35f, 0.9f, dry * dry);
        tints[i][1] = value * wo_mix(0.8f, 0.75f, dry * dry);
        tints[i][2] = value * 0.2f;
    }
    if (points && tints)
        wo_build_rods(b, (const float(*)[4])points, BLADES, BLADE_POINTS, (const float(*)[3])tints,
                      &green);
    wo_build_free(b, points);
    wo_build_free(b, tints);
}

void wo_scene_hair(wo_builder *b)
{
    static const wo_sky sky = {.zenith = {0.45f, 0.52f, 0.65f},
                               .horizon = {0.4f, 0.4f, 0.42f},
                               .ground = {0.1f, 0.1f, 0.07f},
                               .bounce = {0.06f, 0.05f, 0.04f}};
    static const float sun[3] = {1.1f, 0.95f, 0.7f};
    static const wo_texture earth = {.kind = WO_TEXTURE_MARBLE,
                                     .a = {0.14f, 0.1f, 0.06f},
                                     .b = {0.2f, 0.22f, 0.09f},
                                     .scale = 6,
                                     .grain = 0.4f,
                                     .grain_scale = 3};
    static const wo_texture backdrop = {.kind = WO_TEXTURE_MARBLE,
                                        .a = {0.05f, 0.16f, 0.12f},
                                        .b = {0.75f, 0.62f, 0.28f},
                                        .scale = 1.7f};
    wo_build_camera(b, 1.05f, 2.5f);
    wo_build_sky(b, &sky);
    wo_build_sun(b, 60, 48, 2, sun);
    wo_build_ground(b, (wo_vec){0, 0, -6}, (wo_vec){9, 0, 0}, (wo_vec){0, 0, -6}, &earth);
    wo_build_panel(b, (wo_vec){0, 2, -6.5f}, (wo_vec){7, 0, 0}, (wo_vec){0, 2.5f, 0}, &backdrop);
    head(b);
    grass(b);
}
