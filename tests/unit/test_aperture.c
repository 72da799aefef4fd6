/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/aperture.h"

#include "near.h"
#include "scenes.h"

#include <string.h>

#define PI 3.14159265358979323846

#define SHAPE(count, curved, turned, wide)                                                         \
    {                                                                                              \
        .blades = count, .curvature = curved, .rotation = turned, .aspect = wide                   \
    }

static wo_aperture_shape shape_of(int blades, double curvature, double rotation, double aspect)
{
    const wo_aperture aperture = SHAPE(blades, curvature, rotation, aspect);
    wo_error error = {WO_OK, ""};
    wo_aperture_shape shape;
    if (wo_aperture_validate(&aperture, &error) != WO_OK)
        fail_msg("%s", error.text);
    wo_aperture_make(&aperture, &shape);
    return shape;
}

/* Shapes for the tests that hold for all. */
static const wo_aperture many[] = {
    SHAPE(0, 0, 0, 1),       SHAPE(3, 0, 0, 1),    SHAPE(3, 0, 40, 1),   SHAPE(4, 0, 45, 1),
    SHAPE(5, 0.3, 12, 1),    SHAPE(6, 0, 0, 1),    SHAPE(6, 0, 17, 0.5), SHAPE(7, -0.4, 100, 1),
    SHAPE(8, 0.5, -33, 2),   SHAPE(9, 1, 0, 1),    SHAPE(16, 0, 3, 1),   SHAPE(3, -1, 10, 1),
    SHAPE(5, -0.8, 371, 10), SHAPE(0, 0, 30, 0.1), SHAPE(3, 0, 10, 0.1), SHAPE(11, 0.9, 1e6, 3),
    SHAPE(6, 0, -1e6, 0.7)};

/* Integrals of sec^k over a blade, -h..h. */
static double area_closed_form(int blades, double c)
{
    if (blades == 0)
        return PI;
    const double h = PI / blades;
    const double q = cos(h);
    const double log_term = log((1 + sin(h)) / (1 - sin(h)));
    const double s1 = q * log_term;
    const double s2 = q * q * 2 * tan(h);
    const double s3 = q * q * q * (tan(h) / q + log_term / 2);
    const double s4 = q * q * q * q * 2 * (tan(h) + pow(tan(h), 3) / 3);
    if (c >= 0) /* r = (1 - c) s + c */
        return blades * 0.5 * ((1 - c) * (1 - c) * s2 + 2 * c * (1 - c) * s1 + c * c * 2 * h);
    /* r = (1 + c) s - c s^2 */
    return blades * 0.5 * ((1 + c) * (1 + c) * s2 - 2 * c * (1 + c) * s3 + c * c * s4);
}

static void areas(void **state)
{
    (void)state;
    for (int blades = 3; blades <= WO_BLADES_MAX; blades++)
        assert_close(shape_of(blades, 0, 0, 1).area, 0.5 * blades * sin(2 * PI / blades), 1e-10);
    for (size_t i = 0; i < WO_COUNT(many); i++) {
        const wo_aperture a = many[i];
        const double squeeze = a.aspect < 1 ? a.aspect : 1 / a.aspect;
        const double want = area_closed_form(a.blades, a.curvature) * squeeze;
        assert_close(shape_of(a.blades, a.curvature, a.rotation, a.aspect).area, want, 1e-10);
    }
    assert_close(shape_of(0, 0, 0, 1).area, PI, 1e-15);
    assert_close(shape_of(5, 1, 0, 1).area, PI, 1e-10);
}

static void samples_lie_inside(void **state)
{
    (void)state;
    for (size_t i = 0; i < WO_COUNT(many); i++) {
        wo_aperture_shape shape;
        wo_aperture_make(&many[i], &shape);
        rng r = {i};
        for (int n = 0; n < 20000; n++) {
            /* Corners and edges of the unit square, too. */
            const double s = n % 7 == 0 ? (n / 7) % 2 : rng_unit(&r);
            const double t = n % 5 == 0 ? (n / 5) % 2 : rng_unit(&r);
            double u[2];
            wo_aperture_sample(&shape, s, t, u);
            assert_true(isfinite(u[0]) && isfinite(u[1]));
            /* The table of a blade is good to a thousandth. */
            assert_true(wo_aperture_inside(&shape, 0.999 * u[0], 0.999 * u[1]));
        }
        double centre[2];
        wo_aperture_sample(&shape, 0.5, 0.5, centre);
        assert_near(centre[0], 0, 1e-12);
        assert_near(centre[1], 0, 1e-12);
    }
}

/* Chi-square of samples over cells against the areas of the cells in a fine mask; bend spoils the
   samples for the check of the check. Returns how many standard deviations it is too large. */
static double chi_square(const wo_aperture_shape *shape, double bend)
{
    enum { CELLS = 12, FINE = 16, SIZE = CELLS * FINE, SAMPLES = 60000 };
    static float mask[SIZE * SIZE];
    double area[CELLS * CELLS] = {0};
    double hits[CELLS * CELLS] = {0};
    double total = 0;
    wo_aperture_mask(shape, SIZE, mask);
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            area[y / FINE * CELLS + x / FINE] += (double)mask[y * SIZE + x];
            total += (double)mask[y * SIZE + x];
        }
    rng r = {42};
    for (int n = 0; n < SAMPLES; n++) {
        double u[2];
        const double s = rng_unit(&r);
        wo_aperture_sample(shape, s, rng_unit(&r), u);
        const double scale = pow(fmax(hypot(u[0], u[1]), 1e-9), bend);
        const int x = (int)floor((u[0] * scale * 0.999999 + 1) / 2 * CELLS);
        const int y = (int)floor((u[1] * scale * 0.999999 + 1) / 2 * CELLS);
        assert_true(x >= 0 && x < CELLS && y >= 0 && y < CELLS);
        hits[y * CELLS + x]++;
    }
    double sum = 0;
    double rest_want = 0;
    double rest_hits = 0;
    int cells = 0;
    for (int i = 0; i < CELLS * CELLS; i++) {
        const double want = area[i] / total * SAMPLES;
        if (want < 20) { /* slivers go together */
            rest_want += want;
            rest_hits += hits[i];
            continue;
        }
        sum += (hits[i] - want) * (hits[i] - want) / want;
        cells++;
    }
    if (rest_want > 5) {
        sum += (rest_hits - rest_want) * (rest_hits - rest_want) / rest_want;
        cells++;
    }
    const double freedom = cells - 1;
    return (sum - freedom) / sqrt(2 * freedom);
}

static void samples_are_uniform(void **state)
{
    (void)state;
    for (size_t i = 0; i < WO_COUNT(many); i++) {
        wo_aperture_shape shape;
        wo_aperture_make(&many[i], &shape);
        assert_at_most(chi_square(&shape, 0), 5);
    }
    /* The check finds samples that crowd a little around the middle. */
    const wo_aperture_shape hexagon = shape_of(6, 0, 17, 1);
    assert_true(chi_square(&hexagon, 0.05) > 10);
}

static void similar_shapes_hold_their_share(void **state)
{
    (void)state;
    for (size_t i = 0; i < WO_COUNT(many); i++) {
        wo_aperture_shape shape;
        wo_aperture_make(&many[i], &shape);
        enum { SIDE = 400 };
        int inner[3] = {0};
        for (int n = 0; n < SIDE * SIDE; n++) {
            double u[2];
            wo_aperture_sample(&shape, (n % SIDE + 0.5) / SIDE, ((double)(n / SIDE) + 0.5) / SIDE,
                               u);
            for (int k = 0; k < 3; k++) {
                const double part = 0.25 * (k + 1);
                inner[k] += wo_aperture_inside(&shape, u[0] / part, u[1] / part);
            }
        }
        for (int k = 0; k < 3; k++)
            assert_near(inner[k] / (double)(SIDE * SIDE), 0.0625 * (k + 1) * (k + 1), 4e-3);
    }
}

static void vertices_point_the_right_way(void **state)
{
    (void)state;
    const double rotations[] = {0, 20, -35, 90, 123.4, 720 + 20};
    for (int blades = 3; blades <= 9; blades++) {
        for (size_t i = 0; i < WO_COUNT(rotations); i++) {
            const wo_aperture_shape shape = shape_of(blades, 0, rotations[i], 1);
            const double turn = rotations[i] * PI / 180;
            for (int k = 0; k < blades; k++) {
                const double vertex = turn + 2 * PI * k / blades;
                const double middle = vertex + PI / blades;
                const double flat = cos(PI / blades);
                assert_true(wo_aperture_inside(&shape, 0.9999 * cos(vertex), 0.9999 * sin(vertex)));
                assert_false(
                    wo_aperture_inside(&shape, 1.0001 * cos(vertex), 1.0001 * sin(vertex)));
                assert_true(wo_aperture_inside(&shape, 0.9999 * flat * cos(middle),
                                               0.9999 * flat * sin(middle)));
                assert_false(wo_aperture_inside(&shape, 1.0001 * flat * cos(middle),
                                                1.0001 * flat * sin(middle)));
            }
            double best[2] = {0, 0};
            rng r = {i};
            for (int n = 0; n < 20000; n++) {
                double u[2];
                const double s = rng_unit(&r);
                wo_aperture_sample(&shape, s, rng_unit(&r), u);
                if (hypot(u[0], u[1]) > hypot(best[0], best[1]))
                    memcpy(best, u, sizeof best);
            }
            const double off = remainder(atan2(best[1], best[0]) - turn, 2 * PI / blades);
            assert_near(off, 0, 0.06);
        }
    }
}

static void aspect_and_curvature(void **state)
{
    (void)state;
    const wo_aperture_shape wide = shape_of(0, 0, 0, 2);
    assert_true(wo_aperture_inside(&wide, 0.999, 0));
    assert_true(wo_aperture_inside(&wide, 0, 0.499));
    assert_false(wo_aperture_inside(&wide, 0, 0.501));
    const wo_aperture_shape tall = shape_of(0, 0, 0, 0.25);
    assert_true(wo_aperture_inside(&tall, 0, 0.999));
    assert_true(wo_aperture_inside(&tall, 0.249, 0));
    assert_false(wo_aperture_inside(&tall, 0.251, 0));
    /* Turned first, squeezed afterwards: the vertex of a triangle at 90 degrees stays on y. */
    const wo_aperture_shape triangle = shape_of(3, 0, 90, 0.5);
    assert_true(wo_aperture_inside(&triangle, 0, 0.999));
    assert_false(wo_aperture_inside(&triangle, 0, -0.501));
    assert_true(wo_aperture_inside(&triangle, 0.5 * 0.865, -0.499));
    const wo_aperture_shape round = shape_of(5, 1, 33, 1);
    for (int i = 0; i < 360; i++) {
        const double a = i * PI / 180;
        assert_true(wo_aperture_inside(&round, 0.9999 * cos(a), 0.9999 * sin(a)));
        assert_false(wo_aperture_inside(&round, 1.0001 * cos(a), 1.0001 * sin(a)));
    }
    /* Middle of a blade: straight s, bent outwards s + c (1 - s), inwards s (1 + c (1 - s)). */
    const double s = cos(PI / 6);
    const double c[] = {-1, -0.5, 0, 0.5};
    for (size_t i = 0; i < WO_COUNT(c); i++) {
        const double r = c[i] >= 0 ? s + c[i] * (1 - s) : s * (1 + c[i] * (1 - s));
        const wo_aperture_shape shape = shape_of(6, c[i], 30, 1);
        assert_true(wo_aperture_inside(&shape, 0.9999 * r, 0));
        assert_false(wo_aperture_inside(&shape, 1.0001 * r, 0));
        assert_true(wo_aperture_inside(&shape, 0, 0.9999));
    }
    assert_false(wo_aperture_inside(&round, NAN, 0));
}

static void mask_agrees(void **state)
{
    (void)state;
    enum { SIZE = 24, SAMPLES = 200000 };
    static float mask[SIZE * SIZE];
    static double share[SIZE * SIZE];
    for (size_t i = 0; i < WO_COUNT(many); i++) {
        wo_aperture_shape shape;
        wo_aperture_make(&many[i], &shape);
        wo_aperture_mask(&shape, SIZE, mask);
        memset(share, 0, sizeof share);
        double sum = 0;
        for (int n = 0; n < SIZE * SIZE; n++) {
            assert_true(mask[n] >= 0 && mask[n] <= 1);
            sum += (double)mask[n];
        }
        const double cell = 4.0 / (SIZE * SIZE);
        /* An edge as long as the picture may miss half a row of the 8 x 8 points of each cell. */
        assert_near(sum * cell, shape.area, 2.0 / (8 * SIZE));
        /* Well spread samples fall into each cell as often as it is open. */
        const double each = shape.area / cell / SAMPLES;
        for (int n = 0; n < SAMPLES; n++) {
            double u[2];
            double whole;
            wo_aperture_sample(&shape, (n + 0.5) / SAMPLES, modf(n * 0.6180339887498949, &whole),
                               u);
            const int x = (int)fmin((u[0] + 1) / 2 * SIZE, SIZE - 1);
            const int y = (int)fmin((u[1] + 1) / 2 * SIZE, SIZE - 1);
            share[y * SIZE + x] += each;
        }
        for (int n = 0; n < SIZE * SIZE; n++)
            assert_near(share[n], (double)mask[n], 0.08);
    }
}

static void refused_values(void **state)
{
    (void)state;
    const wo_aperture bad[] = {
        SHAPE(1, 0, 0, 1),    SHAPE(2, 0, 0, 1),      SHAPE(17, 0, 0, 1),
        SHAPE(-1, 0, 0, 1),   SHAPE(6, 1.01, 0, 1),   SHAPE(6, -1.01, 0, 1),
        SHAPE(6, NAN, 0, 1),  SHAPE(6, 0, NAN, 1),    SHAPE(6, 0, INFINITY, 1),
        SHAPE(6, 0, 0, 0.09), SHAPE(6, 0, 0, 10.001), SHAPE(6, 0, 0, NAN),
        SHAPE(6, 0, 0, 0),    SHAPE(6, 0, 0, -1)};
    for (size_t i = 0; i < WO_COUNT(bad); i++) {
        wo_error error = {WO_OK, ""};
        assert_int_equal(wo_aperture_validate(&bad[i], &error), WO_ERR_RANGE);
        assert_true(error.text[0] != 0);
    }
    for (size_t i = 0; i < WO_COUNT(many); i++)
        assert_int_equal(wo_aperture_validate(&many[i], NULL), WO_OK);
    const wo_aperture initial = WO_APERTURE_INIT;
    assert_int_equal(wo_aperture_validate(&initial, NULL), WO_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(areas),
        cmocka_unit_test(samples_lie_inside),
        cmocka_unit_test(samples_are_uniform),
        cmocka_unit_test(similar_shapes_hold_their_share),
        cmocka_unit_test(vertices_point_the_right_way),
        cmocka_unit_test(aspect_and_curvature),
        cmocka_unit_test(mask_agrees),
        cmocka_unit_test(refused_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
