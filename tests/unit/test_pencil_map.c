/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/lens_diagram.h"

#include "near.h"
#include "scenes.h"

#include <math.h>
#include <string.h>

static const double lines[] = {450, WO_NM_F, WO_NM_D, WO_NM_C, 690};
enum { LINES = 5 };

static wo_pencil_map *map_of(const wo_diagram *d, double k, double low, double high, int distances,
                             int radii)
{
    wo_pencil_map *map = NULL;
    wo_error error = {WO_OK, ""};
    if (wo_pencil_map_create(NULL, d, k, low, high, distances, radii, lines, LINES, &map, &error) !=
            WO_OK ||
        wo_pencil_map_validate(map, &error) != WO_OK)
        fail_msg("%s", error.text);
    return map;
}

static wo_diagram preset(wo_diagram_preset type, double focal, double n)
{
    wo_diagram d;
    assert_int_equal(wo_diagram_make(type, focal, n, 1, &d, NULL), WO_OK);
    return d;
}

static double row_energy(const wo_pencil_map *map, int row)
{
    double sum = 0;
    for (int i = 0; i < map->radii; i++)
        sum += (double)map->density[(size_t)row * (size_t)map->radii + (size_t)i] * (2.0 * i + 1);
    return sum / map->radii / map->radii;
}

static void energy(void **state)
{
    (void)state;
    for (int type = 0; type < WO_DIAGRAM_PRESET_COUNT; type++) {
        const wo_diagram d = preset((wo_diagram_preset)type, 50, 1.4);
        const int radii[] = {2, 17, 64, 300};
        for (size_t i = 0; i < WO_COUNT(radii); i++) {
            wo_pencil_map *map = map_of(&d, 100, -3, 4, 29, radii[i]);
            for (int row = 0; row < LINES * map->distances; row++)
                assert_near(row_energy(map, row), 1, 1e-6);
            wo_pencil_map_destroy(NULL, &map);
            assert_null(map);
        }
    }
}

static void perfect_is_uniform(void **state)
{
    (void)state;
    const wo_diagram d = preset(WO_DIAGRAM_PERFECT, 50, 2);
    wo_pencil_map *map = map_of(&d, 250, -2, 2, 65, 128);
    const size_t count = (size_t)LINES * 65 * 128;
    for (size_t i = 0; i < count; i++)
        assert_near((double)map->density[i], 1, 2e-7);
    for (int i = 0; i < 65; i++)
        assert_near(map->height[i], 250 * fabs(-2 + i / 16.0), 1e-9);
    assert_near(wo_pencil_map_height(map, 1.03, 555), 257.5, 1e-9);
    assert_near(wo_pencil_map_at(map, 1.03, -257.4, 555), 1, 2e-7);
    assert_near(wo_pencil_map_at(map, 1.03, 257.6, 555), 0, 0);
    /* The focus itself: a point. */
    assert_near(map->height[32], 0, 0);
    assert_near(wo_pencil_map_at(map, 0, 0, 555), 1, 0);
    assert_near(wo_pencil_map_at(map, 0, 1e-9, 555), 0, 0);
    wo_pencil_map_destroy(NULL, &map);
}

/* Rays counted one by one against the rings. */
static void agrees_with_rays(void **state)
{
    (void)state;
    enum { RAYS = 400000, RADII = 32 };
    for (int type = 0; type < WO_DIAGRAM_PRESET_COUNT; type++) {
        const wo_diagram d = preset((wo_diagram_preset)type, 85, 2);
        wo_pencil_map *map = map_of(&d, 40, -1.5, 1.5, 13, RADII);
        for (int row = 0; row < map->distances; row++) {
            const int line = row % LINES;
            const size_t index = (size_t)line * (size_t)map->distances + (size_t)row;
            const double v = -1.5 + row * 0.25;
            const double height = map->height[index];
            int count[RADII] = {0};
            if (height == 0)
                continue;
            for (int i = 0; i < RAYS; i++) {
                const double rho = sqrt((i + 0.5) / RAYS);
                const double r = fabs(40 * rho * (v - wo_diagram_at(&d, rho, lines[line])));
                const int ring = (int)(r / height * RADII);
                assert_true(r <= height * (1 + 1e-6));
                count[ring < RADII ? ring : RADII - 1]++;
            }
            for (int j = 0; j < RADII; j++) {
                const double want = (double)count[j] / RAYS;
                const double got = (double)map->density[index * RADII + (size_t)j] * (2.0 * j + 1) /
                                   (RADII * RADII);
                assert_near(got, want, 2e-4);
            }
        }
        wo_pencil_map_destroy(NULL, &map);
    }
}

static double edge_of(const wo_pencil_map *map, double v, double nm)
{
    return wo_pencil_map_at(map, v, 0.998 * wo_pencil_map_height(map, v, nm), nm);
}

/* Kawase's slides, read from the map. */
static void edges(void **state)
{
    (void)state;
    wo_diagram d = preset(WO_DIAGRAM_SPHERICAL, 49.83, 1.9617);
    wo_pencil_map *map = map_of(&d, 100, -5, 5, 101, 200);
    assert_true(wo_pencil_map_height(map, 4.4, WO_NM_F) <
                0.95 * wo_pencil_map_height(map, 4.4, WO_NM_C));
    assert_true(wo_pencil_map_height(map, -3, WO_NM_F) >
                1.05 * wo_pencil_map_height(map, -3, WO_NM_C));
    assert_true(edge_of(map, 4.4, WO_NM_C) > 2 && edge_of(map, -3, WO_NM_F) < 0.6);
    assert_true(wo_pencil_map_at(map, -3, 0, WO_NM_D) > 2);
    wo_pencil_map_destroy(NULL, &map);
    d = preset(WO_DIAGRAM_ACHROMAT_A, 250, 4.922);
    map = map_of(&d, 1000, -0.1, 0.1, 41, 128);
    assert_true(edge_of(map, -0.08, WO_NM_D) > 1.03 && edge_of(map, 0.08, WO_NM_D) < 0.97);
    assert_true(wo_pencil_map_at(map, -0.08, 0, WO_NM_D) > 1);
    assert_true(wo_pencil_map_at(map, 0.08, 0, WO_NM_D) < 1);
    for (int side = -1; side <= 1; side += 2)
        for (int i = 1; i <= 3; i += 2)
            assert_true(side * (wo_pencil_map_height(map, side * 0.08, lines[i]) -
                                wo_pencil_map_height(map, side * 0.08, WO_NM_D)) >
                        0);
    wo_pencil_map_destroy(NULL, &map);
}

static void clamped_places(void **state)
{
    (void)state;
    const wo_diagram d = preset(WO_DIAGRAM_ACHROMAT_B, 50, 1.4);
    wo_pencil_map *map = map_of(&d, 100, -2, 2, 33, 64);
    const double odd[] = {NAN, INFINITY, -INFINITY, 0, 1e300, -1e300, 3, -3, 500};
    for (size_t i = 0; i < WO_COUNT(odd); i++)
        for (size_t j = 0; j < WO_COUNT(odd); j++)
            for (size_t l = 0; l < WO_COUNT(odd); l++) {
                const double at = wo_pencil_map_at(map, odd[i], odd[j], odd[l]);
                assert_true(isfinite(at) && at >= 0);
            }
    assert_near(wo_pencil_map_at(map, 0.3, NAN, 500), 0, 0);
    assert_near(wo_pencil_map_height(map, 9, 500), wo_pencil_map_height(map, 2, 500), 0);
    wo_pencil_map_destroy(NULL, &map);
    wo_pencil_map_destroy(NULL, NULL);
}

static bool always(void *user)
{
    (void)user;
    return true;
}

static void refused(void **state)
{
    (void)state;
    wo_diagram d = preset(WO_DIAGRAM_SPHERICAL, 50, 2);
    const struct {
        double k, low, high;
        int distances, radii, lines;
    } bad[] = {{0, -1, 1, 9, 9, 1},        {-1, -1, 1, 9, 9, 1},      {NAN, -1, 1, 9, 9, 1},
               {1, 1, 1, 9, 9, 1},         {1, 1, -1, 9, 9, 1},       {1, NAN, 1, 9, 9, 1},
               {1, -1, INFINITY, 9, 9, 1}, {1, -1, 1, 1, 9, 1},       {1, -1, 1, 9, 1, 1},
               {1, -1, 1, 9, 9, 0},        {1, -1, 1, 9999, 9, 1},    {1, -1, 1, 9, 9999, 1},
               {1, -1, 1, 9, 9, 300},      {INFINITY, -1, 1, 9, 9, 1}};
    wo_pencil_map *map = NULL;
    wo_error error;
    for (size_t i = 0; i < WO_COUNT(bad); i++) {
        assert_int_equal(wo_pencil_map_create(NULL, &d, bad[i].k, bad[i].low, bad[i].high,
                                              bad[i].distances, bad[i].radii, lines, bad[i].lines,
                                              &map, &error),
                         WO_ERR_RANGE);
        assert_null(map);
    }
    const double falling[] = {500, 400}, none[] = {NAN};
    assert_int_equal(wo_pencil_map_create(NULL, &d, 1, -1, 1, 9, 9, falling, 2, &map, &error),
                     WO_ERR_RANGE);
    assert_int_equal(wo_pencil_map_create(NULL, &d, 1, -1, 1, 9, 9, none, 1, &map, &error),
                     WO_ERR_RANGE);
    const wo_context small = {.max_bytes = 1000};
    assert_int_equal(wo_pencil_map_create(&small, &d, 1, -1, 1, 99, 99, lines, 1, &map, &error),
                     WO_ERR_NOMEM);
    const wo_context stopped = {.aborted = always};
    assert_int_equal(wo_pencil_map_create(&stopped, &d, 1, -1, 1, 9, 9, lines, 1, &map, &error),
                     WO_ABORTED);
    assert_null(map);
    d.shift[0][0] = NAN;
    assert_int_equal(wo_pencil_map_create(NULL, &d, 1, -1, 1, 9, 9, lines, 1, &map, &error),
                     WO_ERR_RANGE);
    d = preset(WO_DIAGRAM_SPHERICAL, 50, 2);
    map = map_of(&d, 1, -1, 1, 9, 9);
    map->density[40] = NAN;
    assert_int_equal(wo_pencil_map_validate(map, &error), WO_ERR_FORMAT);
    map->density[40] = 0;
    map->height[0] = -1;
    assert_int_equal(wo_pencil_map_validate(map, &error), WO_ERR_FORMAT);
    wo_pencil_map_destroy(NULL, &map);
}

/* Equations 5.5 to 5.9 in the distances they were written in. */
static void profile_mapping(void **state)
{
    (void)state;
    rng r = {7};
    for (int i = 0; i < 2000; i++) {
        const double focal = rng_range(&r, 0.01, 0.3);
        const double nd = rng_range(&r, 1.4, 1.9);
        const double at = wo_profile_focal(focal, nd, nd + rng_range(&r, -0.02, 0.02));
        const double df = rng_range(&r, 1.5, 100) * focal;
        const double d = rng_range(&r, 1.5, 100) * focal;
        const double dr = rng_range(&r, 1.2, 3) * focal;
        const wo_profile profile = {focal, 1 / dr};
        const double u = df * focal / (df - focal);
        const double coc = u * (1 / at - 1 / d) - 1;
        const double image = wo_profile_image(&profile, 1 / d, 1 / df, at);
        assert_near(image * (1 / focal - 1 / dr) - 1, coc, 1e-9);
        assert_near(-u * wo_profile_distance(&profile, 1 / d, 1 / df, at), coc, 1e-9);
        if (fabs(image - focal) < 0.02 * focal)
            continue;
        /* (5.7) with the focus distance d(u''). */
        const double looked = image * focal / (image - focal);
        assert_near((dr - looked) / (looked - focal) * focal / dr, coc, 1e-7);
    }
    const wo_profile profile = {0.05, 10};
    assert_near(wo_profile_distance(&profile, 0, 0, 0.05), 0, 0);
    assert_true(isinf(wo_profile_image(&profile, 0, 20, 0.05)));
    assert_true(isinf(wo_profile_image(&profile, 0, NAN, 0.05)));
    /* F 50 mm, E 12.5 mm, focused at 2 m in red, seen at 475 nm: 0.2165 mm, where (5.8) as printed
       gives none at all. */
    const double blue = 0.05 * 0.983391;
    const double u = 1 / (1 / 0.05 - 1 / 2.0);
    assert_near(-12.5 * u * wo_profile_distance(&profile, 0.5, 0.5, blue), 0.2165, 2e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energy),           cmocka_unit_test(perfect_is_uniform),
        cmocka_unit_test(agrees_with_rays), cmocka_unit_test(edges),
        cmocka_unit_test(clamped_places),   cmocka_unit_test(refused),
        cmocka_unit_test(profile_mapping),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
