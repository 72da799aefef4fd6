/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "build_private.h"

enum {
    PANEL_MAP = 48,
    BOX_MAP = 24,
    LEAF_MAP = 2,
    BALL_MAP = 40,
    SCREEN_MAP_X = 448,
    SCREEN_MAP_Y = 252,
    LATHE_AROUND = 64,
    LATHE_ROWS = 9, /* of one stretch of the profile */
    TORUS_AROUND = 96,
    TORUS_ACROSS = 32
};

/* The frame of something flat: x along a, then y along b; those that want the ground get z along b.
 */
static wo_affine flat_frame(wo_vec centre, wo_vec half_a, wo_vec half_b, wo_texture_kind kind)
{
    const wo_vec x = wo_vec_unit(half_a), n = wo_vec_unit(wo_vec_cross(half_a, half_b));
    const wo_vec b = wo_vec_cross(n, x);
    const bool ground = kind == WO_TEXTURE_BOARDS || kind == WO_TEXTURE_CHART;
    const wo_vec y = ground ? wo_vec_scale(n, -1) : b, z = ground ? b : n;
    return (wo_affine){
        {{x.x, y.x, z.x, centre.x}, {x.y, y.y, z.y, centre.y}, {x.z, y.z, z.z, centre.z}}};
}

static wo_shape *add_flat(wo_builder *b, wo_shape_kind kind, wo_vec centre, wo_vec half_a,
                          wo_vec half_b, const wo_texture *texture)
{
    const wo_affine frame = flat_frame(centre, half_a, half_b, texture->kind);
    wo_shape *const s = wo_build_shape(b, kind, texture, &frame);
    if (!s)
        return NULL;
    s->primitives = 1;
    s->point_count = 4;
    s->points = wo_build_new(b, 4, sizeof *s->points);
    s->quads = wo_build_new(b, 1, sizeof *s->quads);
    if (b->status != WO_OK)
        return NULL;
    for (uint32_t i = 0; i < 4; i++) {
        const float along_a = i == 1 || i == 2 ? 1.0f : -1.0f, along_b = i >= 2 ? 1.0f : -1.0f;
        const wo_vec p = wo_vec_along(wo_vec_along(centre, half_a, along_a), half_b, along_b);
        wo_build_place(&b->to_camera, p, s->points[i]);
        s->quads[0][i] = i;
    }
    return s;
}

void wo_build_ground(wo_builder *b, wo_vec centre, wo_vec half_a, wo_vec half_b,
                     const wo_texture *texture)
{
    wo_shape *const s = add_flat(b, WO_SHAPE_SCREEN, centre, half_a, half_b, texture);
    if (!s)
        return;
    s->map_width = SCREEN_MAP_X;
    s->map_height = SCREEN_MAP_Y;
    wo_build_finish(b, s, WO_RAYCAST_OPEN);
}

void wo_build_panel(wo_builder *b, wo_vec centre, wo_vec half_a, wo_vec half_b,
                    const wo_texture *texture)
{
    wo_shape *const s = add_flat(b, WO_SHAPE_QUADS, centre, half_a, half_b, texture);
    if (!s)
        return;
    s->map_width = s->map_height = PANEL_MAP;
    wo_build_finish(b, s, WO_RAYCAST_OPEN);
}

void wo_build_chart(wo_builder *b, wo_vec centre, wo_vec half_a, wo_vec half_b,
                    const wo_texture *texture)
{
    wo_shape *const s = add_flat(b, WO_SHAPE_QUADS, centre, half_a, half_b, texture);
    if (!s)
        return;
    s->lit = false;
    wo_build_finish(b, s, WO_RAYCAST_OPEN);
}

void wo_build_box(wo_builder *b, const wo_pose *pose, wo_vec half, const wo_texture *texture)
{
    /* Corner i has the signs of its three bits; faces wind counter-clockwise seen from outside. */
    static const uint32_t faces[6][4] = {{0, 1, 5, 4}, {3, 2, 6, 7}, {2, 0, 4, 6},
                                         {1, 3, 7, 5}, {4, 5, 7, 6}, {1, 0, 2, 3}};
    const wo_affine frame = wo_pose_matrix(pose);
    wo_shape *const s = wo_build_shape(b, WO_SHAPE_QUADS, texture, &frame);
    if (!s)
        return;
    const wo_affine place = wo_affine_after(&b->to_camera, &frame);
    s->primitives = s->per_piece = 6;
    s->point_count = 8;
    s->map_width = s->map_height = BOX_MAP;
    s->points = wo_build_new(b, 8, sizeof *s->points);
    s->quads = wo_build_copy(b, faces, 6, sizeof *s->quads);
    if (b->status != WO_OK)
        return;
    for (int i = 0; i < 8; i++) {
        const wo_vec corner = {i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y,
                               i & 4 ? half.z : -half.z};
        wo_build_place(&place, corner, s->points[i]);
    }
    wo_build_finish(b, s, WO_RAYCAST_CLOSED);
}

void wo_build_ball(wo_builder *b, const wo_pose *pose, float radius, const wo_texture *texture)
{
    const wo_affine frame = wo_pose_matrix(pose);
    wo_shape *const s = wo_build_shape(b, WO_SHAPE_BALLS, texture, &frame);
    if (!s)
        return;
    s->primitives = 1;
    s->point_count = 1;
    s->map_width = s->map_height = BALL_MAP;
    s->points = wo_build_new(b, 1, sizeof *s->points);
    if (b->status != WO_OK)
        return;
    wo_build_place(&b->to_camera, pose->at, s->points[0]);
    s->points[0][3] = radius;
    wo_build_finish(b, s, WO_RAYCAST_CLOSED);
}

/* A mesh of around x rows vertices whose faces are made here. */
static wo_shape *add_grid(wo_builder *b, const wo_affine *frame, int around, int rows, float sheet,
                          const wo_texture *texture)
{
    wo_shape *const s = wo_build_shape(b, WO_SHAPE_GRID, texture, frame);
    if (!s)
        return NULL;
    s->map_width = around + 1;
    s->map_height = rows;
    s->sheet = sheet;
    s->primitives = s->per_piece = (uint32_t)(around * (rows - 1));
    s->point_count = (size_t)(around + 1) * (size_t)rows;
    s->points = wo_build_new(b, s->point_count, sizeof *s->points);
    s->normals = wo_build_new(b, s->point_count, sizeof *s->normals);
    s->quads = wo_build_new(b, s->primitives, sizeof *s->quads);
    if (b->status != WO_OK)
        return NULL;
    const uint32_t width = (uint32_t)around + 1;
    for (uint32_t i = 0; i < s->primitives; i++) {
        const uint32_t low = i / (uint32_t)around * width + i % (uint32_t)around;
        s->quads[i][0] = low;
        s->quads[i][1] = low + 1;
        s->quads[i][2] = low + 1 + width;
        s->quads[i][3] = low + width;
    }
    return s;
}

/* A vertex at distance r from the axis and height y; (nr, ny) is its normal in that half plane. */
static void set_vertex(wo_shape *s, const wo_affine *place, int row, int column, float r, float y,
                       float nr, float ny)
{
    const int around = s->map_width - 1;
    const float angle = 2 * WO_PI * (float)(column % around) / (float)around;
    const float c = cosf(angle), d = -sinf(angle);
    const size_t i = (size_t)row * (size_t)s->map_width + (size_t)column;
    wo_build_place(place, (wo_vec){r * c, y, r * d}, s->points[i]);
    s->normals[i] = wo_vec_unit(wo_affine_direction(place, (wo_vec){nr * c, ny, nr * d}));
}

void wo_build_torus(wo_builder *b, const wo_pose *pose, float radius, float tube,
                    const wo_texture *texture)
{
    const wo_affine frame = wo_pose_matrix(pose);
    wo_shape *const s = add_grid(b, &frame, TORUS_AROUND, TORUS_ACROSS + 1, tube, texture);
    if (!s)
        return;
    const wo_affine place = wo_affine_after(&b->to_camera, &frame);
    for (int row = 0; row <= TORUS_ACROSS; row++) {
        const float angle = 2 * WO_PI * (float)(row % TORUS_ACROSS) / (float)TORUS_ACROSS;
        const float c = cosf(angle), d = sinf(angle);
        for (int column = 0; column <= TORUS_AROUND; column++)
            set_vertex(s, &place, row, column, radius + tube * c, tube * d, c, d);
    }
    wo_build_finish(b, s, WO_RAYCAST_CLOSED);
}

static bool same(const float a[2], const float b[2])
{
    return a[0] == b[0] && a[1] == b[1];
}

/* A point at t of the stretch from profile[i] to profile[i + 1] and the direction there: a cubic
   whose ends lean towards the neighbours, or straight on beside a corner. */
static void profile_at(const float (*profile)[2], int count, int i, float t, float at[2],
                       float along[2])
{
    const float *const p = profile[i], *const q = profile[i + 1];
    const bool corner_p = i == 0 || same(profile[i - 1], p);
    const bool corner_q = i + 2 >= count || same(q, profile[i + 2]);
    for (int k = 0; k < 2; k++) {
        const float m = corner_p ? q[k] - p[k] : 0.5f * (q[k] - profile[i - 1][k]);
        const float n = corner_q ? q[k] - p[k] : 0.5f * (profile[i + 2][k] - p[k]);
        const float c = 3 * (q[k] - p[k]) - 2 * m - n, d = m + n - 2 * (q[k] - p[k]);
        at[k] = p[k] + t * (m + t * (c + t * d));
        along[k] = m + t * (2 * c + 3 * t * d);
    }
}

void wo_build_lathe(wo_builder *b, const wo_pose *pose, const float (*profile)[2], int count,
                    const wo_texture *texture)
{
    int stretches = 0;
    float widest = 0;
    for (int i = 0; i < count; i++) {
        widest = fmaxf(widest, profile[i][0]);
        stretches += i + 1 < count && !same(profile[i], profile[i + 1]);
    }
    const wo_affine frame = wo_pose_matrix(pose);
    /* Every stretch has its own first and last row, so that a corner keeps two normals. */
    wo_shape *const s =
        add_grid(b, &frame, LATHE_AROUND, stretches * LATHE_ROWS, 0.6f * widest, texture);
    if (!s)
        return;
    const wo_affine place = wo_affine_after(&b->to_camera, &frame);
    int row = 0;
    for (int i = 0; i + 1 < count; i++) {
        if (same(profile[i], profile[i + 1]))
            continue;
        for (int k = 0; k < LATHE_ROWS; k++, row++) {
            float at[2], along[2];
            profile_at(profile, count, i, (float)k / (LATHE_ROWS - 1), at, along);
            for (int column = 0; column <= LATHE_AROUND; column++)
                set_vertex(s, &place, row, column, fmaxf(at[0], 0), at[1], along[1], -along[0]);
        }
    }
    wo_build_finish(b, s, WO_RAYCAST_CLOSED);
}

void wo_build_leaves(wo_builder *b, const wo_vec (*corners)[4], int count, const float (*tints)[3],
                     const wo_texture *texture)
{
    static const wo_affine identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    wo_shape *const s = wo_build_shape(b, WO_SHAPE_QUADS, texture, &identity);
    if (!s)
        return;
    s->both_sides = true;
    s->map_width = s->map_height = LEAF_MAP;
    s->primitives = (uint32_t)count;
    s->point_count = 4 * (size_t)count;
    s->points = wo_build_new(b, s->point_count, sizeof *s->points);
    s->quads = wo_build_new(b, s->primitives, sizeof *s->quads);
    s->tint = wo_build_copy(b, tints, (size_t)count, sizeof *s->tint);
    if (b->status != WO_OK)
        return;
    for (uint32_t i = 0; i < s->point_count; i++) {
        wo_build_place(&b->to_camera, corners[i / 4][i % 4], s->points[i]);
        s->quads[i / 4][i % 4] = i;
    }
    wo_build_finish(b, s, WO_RAYCAST_OPEN);
}
