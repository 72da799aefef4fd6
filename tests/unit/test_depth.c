/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/optics.h"

#include "near.h"
#include "scenes.h"

#include <float.h>

static double read_as(wo_depth_mode mode, double scale, double sample, double cosine, bool *valid)
{
    const wo_depth_reading reading = {mode, scale, 0.5, 100};
    return wo_depth_vergence(&reading, sample, cosine, valid);
}

static void distance(void **state)
{
    (void)state;
    bool valid = false;
    assert_close(read_as(WO_DEPTH_DISTANCE, 1, 4, 0.1, &valid), 0.25, 1e-15);
    assert_true(valid);
    assert_close(read_as(WO_DEPTH_DISTANCE, 100, 250, 1, &valid), 0.4, 1e-15);
    assert_true(valid);
    /* Nearer than can be told apart: the largest vergence, not infinity. */
    assert_true(read_as(WO_DEPTH_DISTANCE, 1, 1e-30, 1, &valid) == WO_VERGENCE_MAX);
    assert_true(valid);
    assert_true(read_as(WO_DEPTH_DISTANCE, 1e9, DBL_TRUE_MIN, 1, &valid) <= WO_VERGENCE_MAX);
}

static void negative(void **state)
{
    (void)state;
    bool valid = false;
    assert_close(read_as(WO_DEPTH_NEGATIVE, 1, -4, 0.1, &valid), 0.25, 1e-15);
    assert_true(valid);
    assert_close(read_as(WO_DEPTH_NEGATIVE, 100, -250, 1, &valid), 0.4, 1e-15);
}

static void inverse(void **state)
{
    (void)state;
    bool valid = false;
    assert_close(read_as(WO_DEPTH_INVERSE, 1, 4, 1, &valid), 4, 1e-15);
    /* 1 / units times units per metre. */
    assert_close(read_as(WO_DEPTH_INVERSE, 100, 0.004, 1, &valid), 0.4, 1e-15);
    assert_true(valid);
    assert_true(read_as(WO_DEPTH_INVERSE, 1, 0, 1, &valid) == 0);
    assert_true(valid);
    assert_true(read_as(WO_DEPTH_INVERSE, 1, 1e30, 1, &valid) == WO_VERGENCE_MAX);
    assert_true(valid);
}

static void ray(void **state)
{
    (void)state;
    bool valid = false;
    /* 5 m along a ray whose cosine is 0.8 is 4 m of planar distance. */
    assert_close(read_as(WO_DEPTH_RAY, 1, 5, 0.8, &valid), 0.25, 1e-15);
    assert_true(valid);
    assert_close(read_as(WO_DEPTH_RAY, 10, 50, 0.8, &valid), 0.25, 1e-15);
    assert_true(read_as(WO_DEPTH_RAY, 1, 5, 0, &valid) == 0);
    assert_false(valid);
}

static void normalised(void **state)
{
    (void)state;
    bool valid = false;
    assert_close(read_as(WO_DEPTH_NORMALISED, 1, 0, 1, &valid), 2, 1e-15);
    assert_true(valid);
    assert_close(read_as(WO_DEPTH_NORMALISED, 1, 1, 1, &valid), 0.01, 1e-15);
    assert_close(read_as(WO_DEPTH_NORMALISED, 1, 0.5, 1, &valid), 1 / 50.25, 1e-15);
    /* Outside 0..1 the ends hold. */
    assert_close(read_as(WO_DEPTH_NORMALISED, 1, -3, 1, &valid), 2, 1e-15);
    assert_true(valid);
    assert_close(read_as(WO_DEPTH_NORMALISED, 1, 7, 1, &valid), 0.01, 1e-15);
    /* White may be near. */
    const wo_depth_reading white_near = {WO_DEPTH_NORMALISED, 1, 100, 0.5};
    assert_close(wo_depth_vergence(&white_near, 1, 1, &valid), 2, 1e-15);
    assert_close(wo_depth_vergence(&white_near, 0, 1, &valid), 0.01, 1e-15);
}

static void no_surface(void **state)
{
    (void)state;
    const struct {
        wo_depth_mode mode;
        double sample;
    } none[] = {
        {WO_DEPTH_DISTANCE, NAN},
        {WO_DEPTH_DISTANCE, INFINITY},
        {WO_DEPTH_DISTANCE, -INFINITY},
        {WO_DEPTH_DISTANCE, 0},
        {WO_DEPTH_DISTANCE, -0.0},
        {WO_DEPTH_DISTANCE, -2},
        {WO_DEPTH_NEGATIVE, NAN},
        {WO_DEPTH_NEGATIVE, -INFINITY},
        {WO_DEPTH_NEGATIVE, 0},
        {WO_DEPTH_NEGATIVE, 2},
        {WO_DEPTH_RAY, NAN},
        {WO_DEPTH_RAY, INFINITY},
        {WO_DEPTH_RAY, -INFINITY},
        {WO_DEPTH_RAY, 0},
        {WO_DEPTH_RAY, -2},
        {WO_DEPTH_INVERSE, NAN},
        {WO_DEPTH_INVERSE, INFINITY},
        {WO_DEPTH_INVERSE, -INFINITY},
        {WO_DEPTH_INVERSE, -2},
        {WO_DEPTH_NORMALISED, NAN},
        {WO_DEPTH_NORMALISED, INFINITY},
        {WO_DEPTH_NORMALISED, -INFINITY},
    };
    for (size_t i = 0; i < WO_COUNT(none); i++) {
        bool valid = true;
        const double v = read_as(none[i].mode, 1, none[i].sample, 1, &valid);
        if (v != 0 || valid)
            print_error("row %zu: %g, %d\n", i, v, valid);
        assert_true(v == 0);
        assert_false(valid);
    }
}

static void always_a_number(void **state)
{
    (void)state;
    rng r = {3};
    for (int i = 0; i < 20000; i++) {
        const wo_depth_reading reading = {
            (wo_depth_mode)rng_int(&r, 0, WO_DEPTH_MODE_COUNT - 1),
            pow(10, rng_range(&r, -9, 9)),
            pow(10, rng_range(&r, -6, 9)),
            pow(10, rng_range(&r, -6, 9)),
        };
        const double sample = rng_range(&r, -1, 4) < 0 ? -pow(10, rng_range(&r, -320, 308))
                                                       : pow(10, rng_range(&r, -320, 308));
        bool valid = false;
        const double v = wo_depth_vergence(&reading, sample, rng_unit(&r), &valid);
        assert_true(v >= 0 && v <= WO_VERGENCE_MAX);
        if (!valid)
            assert_true(v == 0);
    }
}

static void nearer_is_larger(void **state)
{
    (void)state;
    bool valid;
    double last = INFINITY;
    for (int i = 1; i < 1000; i++) {
        const double v = read_as(WO_DEPTH_DISTANCE, 1, 0.01 * i, 1, &valid);
        assert_true(v < last);
        last = v;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distance),        cmocka_unit_test(negative),
        cmocka_unit_test(inverse),         cmocka_unit_test(ray),
        cmocka_unit_test(normalised),      cmocka_unit_test(no_surface),
        cmocka_unit_test(always_a_number), cmocka_unit_test(nearer_is_larger),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
