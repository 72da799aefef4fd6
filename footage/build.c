/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "build.h"

#include "build_private.h"

#include <string.h>

static float radians(float degrees)
{
    return degrees * (WO_PI / 180);
}

void *wo_build_new(wo_builder *b, size_t count, size_t size)
{
    void *const made = b->status == WO_OK ? wo_new(b->context, b->error, count, size) : NULL;
    if (!made && b->status == WO_OK)
        b->status = WO_ERR_NOMEM;
    return made;
}

void *wo_build_copy(wo_builder *b, const void *from, size_t count, size_t size)
{
    void *const made = wo_build_new(b, count, size);
    return made ? memcpy(made, from, count * size) : NULL;
}

/* A larger array when count fills room; old stays valid after a failure. */
static void *grown(wo_builder *b, void *old, size_t count, size_t *room, size_t size)
{
    if (count < *room)
        return old;
    const size_t more = *room ? 2 * *room : 16;
    void *const made = wo_build_new(b, more, size);
    if (!made)
        return old;
    if (count)
        memcpy(made, old, count * size);
    wo_delete(b->context, old);
    *room = more;
    return made;
}

wo_affine wo_pose_matrix(const wo_pose *pose)
{
    const float cy = cosf(radians(pose->yaw)), sy = sinf(radians(pose->yaw));
    const float cp = cosf(radians(pose->pitch)), sp = sinf(radians(pose->pitch));
    const float cr = cosf(radians(pose->roll)), sr = sinf(radians(pose->roll));
    return (wo_affine){{{cy * cr + sy * sp * sr, sy * sp * cr - cy * sr, sy * cp, pose->at.x},
                        {cp * sr, cp * cr, -sp, pose->at.y},
                        {cy * sp * sr - sy * cr, sy * sr + cy * sp * cr, cy * cp, pose->at.z}}};
}

wo_shape *wo_build_shape(wo_builder *b, wo_shape_kind kind, const wo_texture *texture,
                         const wo_affine *to_world)
{
    wo_scene *const scene = b->scene;
    scene->shapes =
        grown(b, scene->shapes, scene->shape_count, &scene->shape_room, sizeof *scene->shapes);
    if (b->status != WO_OK)
        return NULL;
    wo_shape *const s = &scene->shapes[scene->shape_count++];
    *s = (wo_shape){.kind = kind,
                    .texture = *texture,
                    .per_piece = 1,
                    .sheet = INFINITY,
                    .lit = true,
                    .map_width = 2,
                    .map_height = 2,
                    .texel_floats = 3};
    const wo_affine pose = wo_affine_after(&b->to_camera, to_world);
    s->to_texture = wo_affine_rigid_inverse(&pose);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            s->to_texture.m[i][j] *= texture->scale;
    return s;
}

void wo_build_place(const wo_affine *to_camera, wo_vec p, float out[4])
{
    const wo_vec c = wo_affine_point(to_camera, p);
    out[0] = c.x;
    out[1] = c.y;
    out[2] = c.z;
}

/* The caster wants three floats a vertex; the scene keeps four. */
static wo_status add_mesh(wo_builder *b, const wo_shape *s, int kind)
{
    float(*vertices)[3] = wo_build_new(b, s->point_count, sizeof *vertices);
    if (!vertices)
        return b->status;
    for (size_t i = 0; i < s->point_count; i++)
        memcpy(vertices[i], s->points[i], sizeof vertices[i]);
    const wo_status status =
        wo_raycast_add_quads(b->scene->cast, kind, (const float(*)[3])vertices, s->point_count,
                             (const uint32_t(*)[4])s->quads, s->primitives, NULL, b->error);
    wo_delete(b->context, vertices);
    return status;
}

void wo_build_finish(wo_builder *b, wo_shape *s, int kind)
{
    if (b->status != WO_OK)
        return;
    const size_t area = (size_t)s->map_width * (size_t)s->map_height;
    const bool by_point = s->kind == WO_SHAPE_GRID || s->kind == WO_SHAPE_RODS;
    s->texels = by_point ? s->point_count : area * s->primitives;
    if (s->lit)
        s->map = wo_build_new(b, s->texels, (size_t)s->texel_floats * sizeof *s->map);
    if (b->status != WO_OK)
        return;
    if (s->kind == WO_SHAPE_BALLS)
        b->status = wo_raycast_add_spheres(b->scene->cast, kind, (const float(*)[4])s->points,
                                           s->point_count, NULL, b->error);
    else if (s->kind == WO_SHAPE_RODS)
        b->status = wo_raycast_add_rods(b->scene->cast, kind, (const float(*)[4])s->points,
                                        s->point_count, s->first, s->primitives, NULL, b->error);
    else
        b->status = add_mesh(b, s, kind);
}

wo_status wo_scene_create(const wo_context *context, const wo_scene_entry *entry, uint64_t seed,
                          double tangent_x, double tangent_y, wo_scene **scene, wo_error *error)
{
    *scene = NULL;
    wo_builder b = {.context = context, .error = error, .random = {seed}};
    b.scene = wo_build_new(&b, 1, sizeof *b.scene);
    if (!b.scene)
        return b.status;
    /* Lens rays see a little more of the ground than the picture does. */
    b.scene->screen_x = 1.2f * (float)tangent_x;
    b.scene->screen_y = 1.2f * (float)tangent_y;
    wo_noise_make(seed, &b.scene->noise);
    wo_build_camera(&b, 0, 0);
    b.status = wo_raycast_create(&b.scene->cast, error);
    if (b.status == WO_OK)
        entry->build(&b);
    if (b.status == WO_OK)
        b.status = wo_raycast_commit(b.scene->cast, error);
    if (b.status != WO_OK)
        wo_scene_destroy(context, &b.scene);
    *scene = b.scene;
    return b.status;
}

void wo_build_camera(wo_builder *b, float height, float tilt)
{
    const float c = cosf(radians(tilt)), s = sinf(radians(tilt));
    b->to_camera = (wo_affine){{{1, 0, 0, 0}, {0, c, -s, -c * height}, {0, s, c, -s * height}}};
}

void wo_build_sky(wo_builder *b, const wo_sky *sky)
{
    b->scene->sky = *sky;
    b->scene->sky.up = wo_affine_direction(&b->to_camera, (wo_vec){0, 1, 0});
}

void wo_build_sun(wo_builder *b, float yaw, float height, float radius, const float colour[3])
{
    if (b->scene->sun_count == WO_SUNS_MAX)
        return;
    const float level = cosf(radians(height));
    const wo_vec towards = {level * sinf(radians(yaw)), sinf(radians(height)),
                            level * cosf(radians(yaw))};
    wo_sun *const sun = &b->scene->suns[b->scene->sun_count++];
    sun->towards = wo_affine_direction(&b->to_camera, towards);
    sun->radius = radians(radius);
    for (int c = 0; c < 3; c++)
        sun->colour[c] = colour[c];
}

wo_vec wo_build_view(const wo_builder *b, float x, float y, float depth)
{
    const wo_affine back = wo_affine_rigid_inverse(&b->to_camera);
    /* All scenes are composed for one shape of picture. */
    return wo_affine_point(&back, (wo_vec){0.36f * x * depth, 0.2025f * y * depth, -depth});
}

void wo_build_free(wo_builder *b, void *room)
{
    wo_delete(b->context, room);
}

float wo_build_random(wo_builder *b, float low, float high)
{
    return wo_random_between(&b->random, low, high);
}

void wo_build_colour(wo_builder *b, float saturation, float value, float rgb[3])
{
    const float hue = wo_random_unit(&b->random) * 2 * WO_PI;
    for (int c = 0; c < 3; c++) {
        const float wave = 0.5f + 0.5f * cosf(hue - 2 * WO_PI / 3 * (float)c);
        rgb[c] = value * wo_mix(1, wave * wave, saturation);
    }
}

void wo_build_lamps(wo_builder *b, const float (*balls)[4], const float (*radiance)[3], int count)
{
    static const wo_texture black = {.kind = WO_TEXTURE_PLAIN, .scale = 1};
    static const wo_affine identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    wo_shape *const s = wo_build_shape(b, WO_SHAPE_BALLS, &black, &identity);
    if (!s)
        return;
    wo_scene *const scene = b->scene;
    s->lit = false;
    s->primitives = (uint32_t)count;
    s->point_count = (size_t)count;
    s->first_lamp = (uint32_t)scene->lamp_count;
    s->points = wo_build_new(b, s->point_count, sizeof *s->points);
    s->glow = wo_build_copy(b, radiance, s->point_count, sizeof *s->glow);
    for (int i = 0; i < count && b->status == WO_OK; i++) {
        wo_build_place(&b->to_camera, (wo_vec){balls[i][0], balls[i][1], balls[i][2]},
                       s->points[i]);
        s->points[i][3] = balls[i][3];
        scene->lamps =
            grown(b, scene->lamps, scene->lamp_count, &scene->lamp_room, sizeof *scene->lamps);
        if (b->status != WO_OK)
            return;
        scene->lamps[scene->lamp_count++] =
            (wo_lamp){{s->points[i][0], s->points[i][1], s->points[i][2]},
                      balls[i][3],
                      {radiance[i][0], radiance[i][1], radiance[i][2]}};
    }
    wo_build_finish(b, s, WO_RAYCAST_CLOSED);
}

void wo_build_rods(wo_builder *b, const float (*points)[4], int chains, int length,
                   const float (*tints)[3], const wo_texture *texture)
{
    static const wo_affine identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    wo_shape *const s = wo_build_shape(b, WO_SHAPE_RODS, texture, &identity);
    if (!s)
        return;
    s->per_piece = (uint32_t)(length - 1);
    s->sheet = 0.05f;
    s->primitives = (uint32_t)(chains * (length - 1));
    s->point_count = (size_t)(chains * length);
    s->texel_floats = 12;
    s->points = wo_build_copy(b, points, s->point_count, sizeof *s->points);
    s->first = wo_build_new(b, s->primitives, sizeof *s->first);
    if (tints)
        s->tint = wo_build_copy(b, tints, (size_t)chains, sizeof *s->tint);
    if (b->status != WO_OK)
        return;
    for (size_t i = 0; i < s->point_count; i++)
        wo_build_place(&b->to_camera, (wo_vec){points[i][0], points[i][1], points[i][2]},
                       s->points[i]);
    for (uint32_t i = 0; i < s->primitives; i++)
        s->first[i] = i + i / s->per_piece;
    wo_build_finish(b, s, WO_RAYCAST_CLOSED);
}

void wo_build_rod(wo_builder *b, wo_vec from, wo_vec to, float radius, const wo_texture *texture)
{
    enum { POINTS = 9 };
    float points[POINTS][4];
    for (int i = 0; i < POINTS; i++) {
        const wo_vec p = wo_vec_along(from, wo_vec_sub(to, from), (float)i / (float)(POINTS - 1));
        points[i][0] = p.x;
        points[i][1] = p.y;
        points[i][2] = p.z;
        points[i][3] = radius;
    }
    wo_build_rods(b, (const float(*)[4])points, 1, POINTS, NULL, texture);
}
