/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "bridge/raycast.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

static const uint32_t box_faces[6][4] = {{0, 1, 5, 4}, {3, 2, 6, 7}, {2, 0, 4, 6},
                                         {1, 3, 7, 5}, {4, 5, 7, 6}, {1, 0, 2, 3}};

static wo_raycast *new_cast(void)
{
    wo_raycast *cast = NULL;
    wo_error error = {0};
    assert_int_equal(wo_raycast_create(&cast, &error), WO_OK);
    return cast;
}

/* A box of half width 1 round (0, 0, z). */
static void add_box(wo_raycast *cast, int kind, float z)
{
    float corners[8][3];
    wo_error error = {0};
    for (int i = 0; i < 8; i++) {
        corners[i][0] = i & 1 ? 1.0f : -1.0f;
        corners[i][1] = i & 2 ? 1.0f : -1.0f;
        corners[i][2] = z + (i & 4 ? 1.0f : -1.0f);
    }
    assert_int_equal(
        wo_raycast_add_quads(cast, kind, (const float(*)[3])corners, 8, box_faces, 6, NULL, &error),
        WO_OK);
}

static wo_ray ray_at(float x, float y, float near)
{
    return (wo_ray){{x, y, 0}, near, {0, 0, -1}, INFINITY};
}

static wo_hit trace(const wo_raycast *cast, wo_ray ray, int mode)
{
    wo_hit hit;
    wo_raycast_trace(cast, &ray, &hit, 1, mode);
    return hit;
}

static void box_is_entered_and_left(void **state)
{
    (void)state;
    wo_raycast *cast = new_cast();
    wo_error error = {0};
    add_box(cast, WO_RAYCAST_CLOSED, -5);
    assert_int_equal(wo_raycast_commit(cast, &error), WO_OK);
    const wo_hit in = trace(cast, ray_at(0.25f, -0.5f, 0), WO_RAYS_ANY);
    assert_int_equal(in.geometry, 0);
    assert_true(fabsf(in.t - 4) < 1e-5f);
    assert_true(in.normal[2] > 0 && in.normal[0] == 0 && in.normal[1] == 0);
    const wo_hit out = trace(cast, ray_at(0.25f, -0.5f, 4.5f), WO_RAYS_COHERENT);
    assert_true(fabsf(out.t - 6) < 1e-5f);
    assert_true(out.normal[2] < 0);
    /* From inside there is no front face. */
    assert_int_equal(trace(cast, ray_at(0.25f, -0.5f, 4.5f), WO_RAYS_FRONT_ONLY).geometry,
                     WO_RAYCAST_NONE);
    assert_true(fabsf(trace(cast, ray_at(0.25f, -0.5f, 0), WO_RAYS_FRONT_ONLY).t - 4) < 1e-5f);
    assert_int_equal(trace(cast, ray_at(1.5f, 0, 0), WO_RAYS_ANY).geometry, WO_RAYCAST_NONE);
    wo_raycast_destroy(&cast);
    assert_null(cast);
}

static void open_faces_have_two_sides(void **state)
{
    (void)state;
    wo_raycast *cast = new_cast();
    wo_error error = {0};
    add_box(cast, WO_RAYCAST_OPEN, -5);
    assert_int_equal(wo_raycast_commit(cast, &error), WO_OK);
    assert_true(fabsf(trace(cast, ray_at(0, 0.1f, 4.5f), WO_RAYS_FRONT_ONLY).t - 6) < 1e-5f);
    wo_raycast_destroy(&cast);
}

static void quad_coordinates_follow_the_corners(void **state)
{
    (void)state;
    static const float corners[4][3] = {{0, 0, -2}, {4, 0, -2}, {4, 2, -2}, {0, 2, -2}};
    static const uint32_t face[1][4] = {{0, 1, 2, 3}};
    wo_raycast *cast = new_cast();
    wo_error error = {0};
    assert_int_equal(wo_raycast_add_quads(cast, WO_RAYCAST_OPEN, corners, 4, face, 1, NULL, &error),
                     WO_OK);
    assert_int_equal(wo_raycast_commit(cast, &error), WO_OK);
    for (int i = 0; i < 12; i++)
        for (int k = 0; k < 12; k++) {
            const float u = ((float)i + 0.5f) / 12, v = ((float)k + 0.5f) / 12;
            const wo_hit hit = trace(cast, ray_at(4 * u, 2 * v, 0), WO_RAYS_ANY);
            assert_true(fabsf(hit.u - u) < 1e-5f && fabsf(hit.v - v) < 1e-5f);
        }
    wo_raycast_destroy(&cast);
}

static void balls_and_rods_are_round(void **state)
{
    (void)state;
    static const float ball[1][4] = {{0, 0, -10, 2}};
    static const float points[3][4] = {{-3, 5, -4, 0.5f}, {0, 5, -4, 0.5f}, {3, 5, -4, 0.5f}};
    static const uint32_t first[2] = {0, 1};
    wo_raycast *cast = new_cast();
    wo_error error = {0};
    uint32_t balls, rods;
    assert_int_equal(wo_raycast_add_spheres(cast, WO_RAYCAST_CLOSED, ball, 1, &balls, &error),
                     WO_OK);
    assert_int_equal(
        wo_raycast_add_rods(cast, WO_RAYCAST_CLOSED, points, 3, first, 2, &rods, &error), WO_OK);
    assert_int_equal(wo_raycast_commit(cast, &error), WO_OK);
    for (int i = 0; i < 9; i++) {
        const float x = -1.8f + 0.45f * (float)i;
        const wo_hit hit = trace(cast, ray_at(x, 0, 0), WO_RAYS_FRONT_ONLY);
        const float depth = sqrtf(4 - x * x);
        assert_int_equal(hit.geometry, balls);
        assert_true(fabsf(hit.t - (10 - depth)) < 1e-4f);
        const float length = sqrtf(hit.normal[0] * hit.normal[0] + hit.normal[1] * hit.normal[1] +
                                   hit.normal[2] * hit.normal[2]);
        assert_true(fabsf(hit.normal[0] / length - x / 2) < 1e-4f);
        assert_true(fabsf(hit.normal[2] / length - depth / 2) < 1e-4f);
    }
    for (int i = 0; i < 11; i++) {
        const float x = -2.7f + 0.52f * (float)i, y = 5.3f;
        const wo_hit hit = trace(cast, ray_at(x, y, 0), WO_RAYS_ANY);
        assert_int_equal(hit.geometry, rods);
        assert_int_equal(hit.primitive, x < 0 ? 0 : 1);
        assert_true(fabsf(hit.t - (4 - 0.4f)) < 1e-4f);
        assert_true(fabsf(hit.u - (x < 0 ? (x + 3) / 3 : x / 3)) < 1e-4f);
    }
    assert_int_equal(trace(cast, ray_at(0, 5.51f, 0), WO_RAYS_ANY).geometry, WO_RAYCAST_NONE);
    wo_raycast_destroy(&cast);
}

static void blocked_looks_between_the_ends(void **state)
{
    (void)state;
    wo_raycast *cast = new_cast();
    wo_error error = {0};
    add_box(cast, WO_RAYCAST_CLOSED, -5);
    assert_int_equal(wo_raycast_commit(cast, &error), WO_OK);
    wo_ray rays[11];
    bool blocked[11];
    for (int i = 0; i < 11; i++)
        rays[i] = ray_at(0.1f, 0.2f, 0);
    rays[0].far = 3.9f;  /* before it */
    rays[1].far = 4.1f;  /* into it */
    rays[2].near = 4.1f; /* out of it */
    rays[3].near = 6.1f; /* behind it */
    rays[4].near = 2;
    rays[4].far = 1; /* no ray at all */
    rays[10].origin[0] = 3;
    wo_raycast_blocked(cast, rays, blocked, 11);
    static const bool expected[11] = {false, true, true, false, false, true,
                                      true,  true, true, true,  false};
    for (int i = 0; i < 11; i++)
        assert_int_equal(blocked[i], expected[i]);
    wo_raycast_destroy(&cast);
}

/* A lane of a packet knows nothing of its neighbours. */
static void packets_equal_single_rays(void **state)
{
    (void)state;
    enum { COUNT = 101 };
    wo_raycast *cast = new_cast();
    wo_error error = {0};
    add_box(cast, WO_RAYCAST_CLOSED, -5);
    assert_int_equal(wo_raycast_commit(cast, &error), WO_OK);
    wo_ray rays[COUNT];
    wo_hit hits[COUNT];
    for (int i = 0; i < COUNT; i++) {
        rays[i] = ray_at(0, 0, i % 7 == 3 ? 9.0f : 0);
        rays[i].far = i % 7 == 3 ? 1 : INFINITY;
        rays[i].direction[0] = 0.35f * sinf((float)i);
        rays[i].direction[1] = 0.35f * cosf(1.7f * (float)i);
    }
    wo_raycast_trace(cast, rays, hits, COUNT, WO_RAYS_ANY);
    int met = 0;
    for (int i = 0; i < COUNT; i++) {
        const wo_hit one = trace(cast, rays[i], WO_RAYS_ANY);
        assert_int_equal(one.geometry, hits[i].geometry);
        assert_true(fabsf(one.t - hits[i].t) <= 1e-6f * one.t);
        if (i % 7 == 3)
            assert_int_equal(hits[i].geometry, WO_RAYCAST_NONE);
        met += hits[i].geometry != WO_RAYCAST_NONE;
    }
    assert_in_range(met, 10, COUNT - 10);
    wo_raycast_destroy(&cast);
}

static void bad_arrays_are_refused(void **state)
{
    (void)state;
    static const float points[2][4] = {{0, 0, -1, 1}, {1, 0, -1, 1}};
    static const uint32_t beyond[1] = {1}, face[1][4] = {{0, 1, 2, 9}};
    static const float corners[4][3] = {{0}};
    wo_raycast *cast = new_cast();
    wo_error error = {0};
    assert_int_equal(wo_raycast_add_rods(cast, WO_RAYCAST_OPEN, points, 2, beyond, 1, NULL, &error),
                     WO_ERR_RANGE);
    assert_int_equal(wo_raycast_add_quads(cast, WO_RAYCAST_OPEN, corners, 4, face, 1, NULL, &error),
                     WO_ERR_RANGE);
    assert_int_equal(wo_raycast_add_spheres(cast, WO_RAYCAST_OPEN, points, 0, NULL, &error),
                     WO_ERR_ARGUMENT);
    wo_raycast_destroy(&cast);
    wo_raycast_destroy(&cast);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(box_is_entered_and_left),
        cmocka_unit_test(open_faces_have_two_sides),
        cmocka_unit_test(quad_coordinates_follow_the_corners),
        cmocka_unit_test(balls_and_rods_are_round),
        cmocka_unit_test(blocked_looks_between_the_ends),
        cmocka_unit_test(packets_equal_single_rays),
        cmocka_unit_test(bad_arrays_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
