/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Exact rays: against the meridional formulas, under rotation, backwards; what becomes of those
   that do not get through, and how much light does. */
#include "lens_test.h"
#include "scenes.h"

static const double lines_nm[3] = {WO_NM_F, WO_NM_D, WO_NM_C};

static wo_first_order first_order_of(const wo_system *system)
{
    wo_first_order o;
    wo_system_first_order(system, WO_MERIDIAN_X, &o);
    return o;
}

/* A ray of the axial pupil's disc, turned by angles whose tangents lie within slope. */
static test_ray random_ray(rng *r, const wo_first_order *o, double slope)
{
    const double height = 0.5 * o->ep_d * sqrt(rng_unit(r));
    const double angle = rng_range(r, 0, 6.283185307179586);
    const double tx = rng_range(r, -slope, slope);
    const double ty = rng_range(r, -slope, slope);
    const double n = 1 / sqrt(1 + tx * tx + ty * ty);
    const double z = -10;
    return (test_ray){.p = {height * cos(angle) + tx * (z - o->ep_z),
                            height * sin(angle) + ty * (z - o->ep_z), z},
                      .d = {tx * n, ty * n, n}};
}

static void skew_rays_agree_with_the_meridional_formulas(void **state)
{
    (void)state;
    int lenses = 0;
    int rays = 0;
    for (size_t i = 0; wo_lens_name_at(i); i++) {
        for (int line = 0; line < 3; line++) {
            const wo_system system = builtin_system(wo_lens_name_at(i), lines_nm[line]);
            if (!is_spherical(&system))
                continue;
            lenses += line == 0;
            const wo_first_order o = first_order_of(&system);
            for (int k = 1; k <= 100; k++) {
                const double y = 0.5 * o.ep_d * k / 100;
                const double angle = 0.7 * k;
                double cross;
                double slope;
                const test_ray r =
                    trace_whole(&system, 0, parallel_ray(y * cos(angle), y * sin(angle)));
                const bool passed = wo_system_trace_meridional(&system, y, &cross, &slope);
                assert_int_equal(passed, r.outcome == WO_RAY_PASSED);
                if (!passed)
                    continue;
                const double across = r.p[0] * cos(angle) + r.p[1] * sin(angle);
                const double tangent = (r.d[0] * cos(angle) + r.d[1] * sin(angle)) / r.d[2];
                assert_near(r.p[2] - system.z_last - across / tangent, cross, 1e-9);
                assert_near(tangent, slope, 1e-11);
                assert_near(r.p[0] * sin(angle) - r.p[1] * cos(angle), 0, 1e-11);
                rays++;
            }
        }
    }
    assert_int_equal(lenses, 26);
    assert_true(rays > 0.98 * 100 * 3 * lenses);
}

static void turn(double v[3], double angle)
{
    const double x = v[0];
    v[0] = x * cos(angle) - v[1] * sin(angle);
    v[1] = x * sin(angle) + v[1] * cos(angle);
}

static void turned_rays_give_turned_results(void **state)
{
    (void)state;
    rng random = {1};
    int rays = 0;
    for (size_t i = 0; wo_lens_name_at(i); i++) {
        const wo_system system = builtin_system(wo_lens_name_at(i), WO_NM_D);
        if (!is_round(&system))
            continue;
        const wo_first_order o = first_order_of(&system);
        for (int k = 0; k < 60; k++) {
            const double angle = rng_range(&random, -4, 4);
            const test_ray ray = random_ray(&random, &o, 0.1);
            test_ray turned = ray;
            turn(turned.p, angle);
            turn(turned.d, angle);
            test_ray a = trace_whole(&system, 0, ray);
            const test_ray b = trace_whole(&system, 0, turned);
            assert_int_equal(a.outcome, b.outcome);
            if (a.outcome != WO_RAY_PASSED)
                continue;
            turn(a.p, angle);
            turn(a.d, angle);
            for (int c = 0; c < 3; c++) {
                assert_near(a.p[c], b.p[c], 1e-9);
                assert_near(a.d[c], b.d[c], 1e-11);
            }
            rays++;
        }
    }
    assert_true(rays > 0.8 * 60 * 29);
}

static void rays_return_the_way_they_came(void **state)
{
    (void)state;
    rng random = {2};
    int rays = 0;
    for (size_t i = 0; wo_lens_name_at(i); i++) {
        const wo_system system = builtin_system(wo_lens_name_at(i), lines_nm[i % 3]);
        const wo_first_order o = first_order_of(&system);
        const int last = system.count - 1;
        int passed = 0;
        for (int k = 0; k < 200; k++) {
            const test_ray ray = random_ray(&random, &o, 0.15);
            test_ray r = trace_whole(&system, 0, ray);
            if (r.outcome != WO_RAY_PASSED)
                continue;
            const double length = sqrt(r.d[0] * r.d[0] + r.d[1] * r.d[1] + r.d[2] * r.d[2]);
            assert_near(length, 1, 1e-13);
            const double stop[2] = {r.stop[0], r.stop[1]};
            for (int c = 0; c < 3; c++)
                r.d[c] = -r.d[c];
            r = trace_ray(&system, 0, last, true, 0, r);
            assert_int_equal(r.outcome, WO_RAY_PASSED);
            assert_near(r.stop[0], stop[0], 1e-9);
            assert_near(r.stop[1], stop[1], 1e-9);
            const double to = (ray.p[2] - r.p[2]) / r.d[2];
            for (int c = 0; c < 3; c++) {
                assert_near(r.p[c] + to * r.d[c], ray.p[c], 1e-9);
                assert_near(-r.d[c], ray.d[c], 1e-12);
            }
            passed++;
        }
        if (passed < 100)
            fail_msg("%s: only %d rays passed", wo_lens_name_at(i), passed);
        rays += passed;
    }
    assert_true(rays > 0.8 * 200 * 30);
}

/* Piece by piece is the same as at once. */
static void parts_of_a_lens(void **state)
{
    (void)state;
    rng random = {3};
    const wo_system system = builtin_system("masterprime_zeiss_asph", WO_NM_D);
    const wo_first_order o = first_order_of(&system);
    for (int k = 0; k < 50; k++) {
        const test_ray ray = random_ray(&random, &o, 0.1);
        const test_ray whole = trace_whole(&system, 0, ray);
        test_ray part = ray;
        for (int at = 0; at < system.count; at++) {
            part = trace_ray(&system, at, at, false, 0, part);
            if (part.outcome != WO_RAY_PASSED)
                break;
        }
        assert_int_equal(part.outcome, whole.outcome);
        for (int c = 0; c < 3; c++) {
            assert_near(part.p[c], whole.p[c], 1e-12);
            assert_near(part.d[c], whole.d[c], 1e-14);
        }
    }
}

static wo_system system_of(const test_surface *surfaces, int count)
{
    const wo_prescription lens = lens_of(surfaces, count);
    wo_system system;
    wo_system_make(&lens, WO_NM_D, &system);
    return system;
}

static double sphere_sag(double radius, double height)
{
    return radius - copysign(sqrt(radius * radius - height * height), radius);
}

static void light_through_a_plate(void **state)
{
    (void)state;
    static const double indices[] = {1.2, 1.5168, 2, 3.5};
    for (size_t i = 0; i < WO_COUNT(indices); i++) {
        const double n = indices[i];
        const test_surface plate[] = {{0, 5, n, 0, true}, {0, 10, 1, 0, false}};
        const wo_system system = system_of(plate, 2);
        test_ray r = trace_whole(&system, WO_TRACE_FRESNEL, parallel_ray(3, -2));
        const double one = 4 * n / ((n + 1) * (n + 1));
        assert_int_equal(r.outcome, WO_RAY_PASSED);
        assert_near(r.weight, one * one, 1e-14);
        assert_near(trace_whole(&system, 0, parallel_ray(3, -2)).weight, 1, 0);

        /* At an angle: the ray is displaced, and Fresnel's formulas in sines and tangents. */
        for (int k = 1; k < 18; k++) {
            const double a = k * 5 * (3.14159265358979323846 / 180);
            const double b = asin(sin(a) / n);
            const test_ray ray = {.p = {0, 0, 0}, .d = {0, sin(a), cos(a)}};
            r = trace_whole(&system, WO_TRACE_FRESNEL, ray);
            assert_near(r.p[1], 5 * tan(b), 1e-12);
            assert_near(r.d[1], sin(a), 1e-14);
            const double s = sin(a - b) / sin(a + b);
            const double p = tan(a - b) / tan(a + b);
            const double t = 1 - 0.5 * (s * s + p * p);
            assert_near(r.weight, t * t, 1e-12);
            assert_true(r.weight > 0 && r.weight < 1);
        }
    }
}

static void light_through_the_designs(void **state)
{
    (void)state;
    rng random = {4};
    for (size_t i = 0; wo_lens_name_at(i); i++) {
        const wo_system system = builtin_system(wo_lens_name_at(i), WO_NM_D);
        const wo_first_order o = first_order_of(&system);
        double normal = 1;
        for (int k = 0; k < system.count; k++) {
            const double n0 = system.surface[k].n0;
            const double n1 = system.surface[k].n1;
            normal *= 4 * n0 * n1 / ((n0 + n1) * (n0 + n1));
        }
        test_ray r = trace_whole(&system, WO_TRACE_FRESNEL, parallel_ray(0, 0));
        assert_near(r.weight, normal, 1e-12);
        for (int k = 0; k < 100; k++) {
            r = trace_whole(&system, WO_TRACE_FRESNEL, random_ray(&random, &o, 0.1));
            if (r.outcome != WO_RAY_PASSED)
                continue;
            assert_true(r.weight > 0 && r.weight <= 1);
            /* The same loss on the way back. */
            const double there = r.weight;
            for (int c = 0; c < 3; c++)
                r.d[c] = -r.d[c];
            r = trace_ray(&system, 0, system.count - 1, true, WO_TRACE_FRESNEL, r);
            assert_near(r.weight, there, 1e-9);
        }
    }
}

static void total_reflection(void **state)
{
    (void)state;
    /* Flat in front, so that rays meet the rear sphere at the angle asin(y / 10). */
    const test_surface half[] = {{0, 10, 1.5, 0, true}, {-10, 10, 1, 0, false}};
    const wo_system system = system_of(half, 2);
    const double critical = 10 / 1.5;
    test_ray r = trace_whole(&system, 0, parallel_ray(0, critical - 1e-9));
    assert_int_equal(r.outcome, WO_RAY_PASSED);
    r = trace_whole(&system, 0, parallel_ray(0, critical + 1e-9));
    assert_int_equal(r.outcome, WO_RAY_REFLECTED);
    assert_near(r.p[1], critical, 1e-8);
    assert_near(r.p[2], 10 + sphere_sag(-10, critical), 1e-8);
    double cross;
    double slope;
    assert_true(wo_system_trace_meridional(&system, critical - 1e-9, &cross, &slope));
    assert_false(wo_system_trace_meridional(&system, critical + 1e-9, &cross, &slope));
}

static void missed_surfaces(void **state)
{
    (void)state;
    const test_surface ball[] = {{5, 10, 1.5, 0, true}, {-5, 10, 1, 0, false}};
    const wo_system system = system_of(ball, 2);
    assert_int_equal(trace_whole(&system, 0, parallel_ray(0, 4.9)).outcome, WO_RAY_PASSED);
    assert_int_equal(trace_whole(&system, 0, parallel_ray(0, 5.1)).outcome, WO_RAY_MISSED);
    assert_int_equal(trace_whole(&system, 0, parallel_ray(3.7, 3.7)).outcome, WO_RAY_MISSED);
    double cross;
    double slope;
    assert_false(wo_system_trace_meridional(&system, 5.1, &cross, &slope));

    /* Along the surfaces, and against the order asked for. */
    const test_ray flat = {.p = {0, 0, -10}, .d = {0, 1, 0}};
    assert_int_equal(trace_whole(&system, 0, flat).outcome, WO_RAY_MISSED);
    const test_ray away = {.p = {0, 0, -10}, .d = {0, 0, -1}};
    assert_int_equal(trace_whole(&system, 0, away).outcome, WO_RAY_MISSED);
    assert_int_equal(trace_ray(&system, 0, 1, true, 0, parallel_ray(0, 0)).outcome, WO_RAY_MISSED);
    const test_ray nothing = {.p = {NAN, 0, -10}, .d = {0, 0, 1}};
    assert_int_equal(trace_whole(&system, 0, nothing).outcome, WO_RAY_MISSED);
}

static void clear_radii(void **state)
{
    (void)state;
    const test_surface lens[] = {
        {50, 3, 1.5, 8, false}, {0, 2, 1, 6, true}, {0, 2, 1.5, 7, false}, {-50, 40, 1, 0, false}};
    const wo_system system = system_of(lens, 4);
    const double z = sphere_sag(50, 7.5);
    /* Height; flags; outcome. Rays come to the iris somewhat lower than they enter. */
    const struct {
        double y;
        unsigned flags;
        wo_outcome outcome;
    } cases[] = {
        {7.99, WO_TRACE_CLIP, WO_RAY_BLOCKED}, /* at the third surface */
        {7.99, 0, WO_RAY_PASSED},
        {8.01, WO_TRACE_CLIP, WO_RAY_BLOCKED},
        {8.01, WO_TRACE_IRIS, WO_RAY_BLOCKED},
        {6.5, WO_TRACE_IRIS, WO_RAY_BLOCKED},
        {6.5, WO_TRACE_CLIP, WO_RAY_PASSED},
        {5.9, WO_TRACE_CLIP | WO_TRACE_IRIS, WO_RAY_PASSED},
        {100, 0, WO_RAY_MISSED},
    };
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        const test_ray r = trace_whole(&system, cases[i].flags, parallel_ray(0, cases[i].y));
        if (r.outcome != cases[i].outcome)
            fail_msg("height %g, flags %u: outcome %d", cases[i].y, cases[i].flags, (int)r.outcome);
    }
    /* A ray keeps the place where it was stopped. */
    test_ray r = trace_whole(&system, WO_TRACE_CLIP, parallel_ray(0, 8.01));
    assert_near(r.p[2], sphere_sag(50, 8.01), 1e-12);
    assert_near(r.p[1], 8.01, 1e-12);
    r = trace_whole(&system, WO_TRACE_IRIS, parallel_ray(7.5, 0));
    assert_near(r.p[2], 3, 1e-12);
    assert_near(r.p[0], r.stop[0], 0);
    /* Snell's law at the front, by hand: the ray bends by asin(y/R) - asin(y/(R n)). */
    const double bend = asin(7.5 / 50) - asin(7.5 / 75);
    assert_near(r.stop[0], 7.5 - (3 - z) * tan(bend), 1e-12);
}

static void many_rays_at_once(void **state)
{
    (void)state;
    enum { COUNT = 64 };
    rng random = {5};
    const wo_system system = builtin_system("zoom_canon_70_200_at_72", WO_NM_D);
    const wo_first_order o = first_order_of(&system);
    double v[6][COUNT], weight[COUNT], stop[2][COUNT];
    uint8_t outcome[COUNT];
    test_ray one[COUNT];
    const unsigned flags = WO_TRACE_CLIP | WO_TRACE_IRIS | WO_TRACE_FRESNEL;
    for (int i = 0; i < COUNT; i++) {
        const test_ray r = random_ray(&random, &o, 0.3);
        for (int c = 0; c < 3; c++) {
            v[c][i] = r.p[c];
            v[3 + c][i] = r.d[c];
        }
        weight[i] = 1;
        one[i] = trace_whole(&system, flags, r);
    }
    const wo_rays rays = {v[0], v[1], v[2], v[3], v[4], v[5], weight, outcome};
    wo_system_trace(&system, 0, system.count - 1, false, flags, &rays, COUNT, stop[0], stop[1]);
    int passed = 0;
    for (int i = 0; i < COUNT; i++) {
        assert_int_equal(outcome[i], one[i].outcome);
        assert_near(weight[i], one[i].weight, 0);
        for (int c = 0; c < 3; c++) {
            assert_near(v[c][i], one[i].p[c], 0);
            assert_near(v[3 + c][i], one[i].d[c], 0);
        }
        passed += outcome[i] == WO_RAY_PASSED;
    }
    assert_true(passed > 0 && passed < COUNT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(skew_rays_agree_with_the_meridional_formulas),
        cmocka_unit_test(turned_rays_give_turned_results),
        cmocka_unit_test(rays_return_the_way_they_came),
        cmocka_unit_test(parts_of_a_lens),
        cmocka_unit_test(light_through_a_plate),
        cmocka_unit_test(light_through_the_designs),
        cmocka_unit_test(total_reflection),
        cmocka_unit_test(missed_surfaces),
        cmocka_unit_test(clear_radii),
        cmocka_unit_test(many_rays_at_once),
    };
    return cmocka_run_group_tests_name("lens_trace", tests, NULL, NULL);
}
