/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/aperture.h"

#include "near.h"
#include "scenes.h"

#include <string.h>

#define PI 3.14159265358979323846

#define IRIS(count, ...)                                                                           \
    {                                                                                              \
        .aspect = 1, .blades = count, __VA_ARGS__                                                  \
    }
#define STAR(count, ...) IRIS(count, .form = WO_APERTURE_STAR, __VA_ARGS__)
#define HEART(...)       IRIS(0, .form = WO_APERTURE_HEART, __VA_ARGS__)

static const wo_aperture many[] = {
    IRIS(6, .opening = 0.5),
    IRIS(5, .opening = 1, .rotation = 20),
    IRIS(3, .curvature = -0.6, .opening = 0.25),
    STAR(5, .rotation = 90),
    STAR(3, .curvature = -1),
    STAR(16, .curvature = 1),
    STAR(7, .curvature = 0.3, .opening = 0.4, .obstruction = 0.3),
    STAR(5, .rotation = 13, .obstruction = 0.7),
    HEART(.rotation = 0),
    HEART(.rotation = 40, .obstruction = 0.3),
    HEART(.obstruction = 0.65),
    HEART(.obstruction = 0.8),
    HEART(.obstruction = 0.75, .opening = 0.1, .rotation = -70),
    IRIS(0, .obstruction = 0.5),
    IRIS(0, .obstruction = 0.95),
    IRIS(6, .obstruction = 0.4, .rotation = 7),
    IRIS(6, .obstruction = 0.9),
    IRIS(3, .obstruction = 0.5),
    IRIS(3, .obstruction = 0.8, .rotation = 11),
    IRIS(0, .apodization = 1),
    IRIS(6, .apodization = 0.5),
    IRIS(0, .edge = 1),
    IRIS(0, .edge = -1),
    IRIS(8, .edge = 0.3, .obstruction = 0.2),
    IRIS(0, .ring_amount = 1, .ring_count = 5),
    IRIS(0, .ring_amount = 0.5, .ring_count = WO_RINGS_MAX),
    IRIS(0, .grain_amount = 1, .grain_seed = 7),
    STAR(6, .grain_amount = 0.5, .apodization = 0.3, .edge = 0.2),
    HEART(.grain_amount = 0.5, .ring_amount = 0.3, .ring_count = 3, .obstruction = 0.2),
};

static wo_aperture_shape shape_of(const wo_aperture *aperture)
{
    wo_error error = {WO_OK, ""};
    wo_aperture_shape shape;
    if (wo_aperture_validate(aperture, &error) != WO_OK)
        fail_msg("%s", error.text);
    wo_aperture_make(aperture, &shape);
    return shape;
}

static double area_of(wo_aperture aperture)
{
    return shape_of(&aperture).area;
}

static void areas(void **state)
{
    (void)state;
    for (int n = 3; n <= WO_BLADES_MAX; n++) {
        for (int k = -2; k <= 2; k++) {
            const double valley = cos(PI / n) * (0.55 + 0.45 * k / 2);
            const wo_aperture star = STAR(n, .curvature = 0.5 * k);
            assert_close(area_of(star), n * valley * sin(PI / n), 1e-9);
        }
        const wo_aperture full = STAR(n, .curvature = 1);
        assert_close(area_of(full), 0.5 * n * sin(2 * PI / n), 1e-9);
    }
    /* A square of half diagonal 1 and two half discs, inside a circle that touches its tip. */
    const double size = 1.2612038749637415;
    const wo_aperture heart = HEART(.rotation = 5);
    assert_close(area_of(heart), (2 + PI / 2) / (size * size), 1e-7);
    const wo_aperture narrow_heart = {.form = WO_APERTURE_HEART, .aspect = 0.25};
    assert_close(area_of(narrow_heart), 0.25 * (2 + PI / 2) / (size * size), 1e-7);
    for (int i = 0; i < 20; i++) {
        const double o = fmin(0.05 * i, WO_OBSTRUCTION_MAX);
        const wo_aperture ring = IRIS(0, .obstruction = o);
        assert_close(area_of(ring), PI * (1 - o * o), 1e-12);
        /* A disc out of a hexagon; when it is wider than the flats, segments of it stay inside. */
        const double flat = cos(PI / 6);
        const double beyond =
            o > flat ? acos(flat / o) * o * o - flat * sqrt(o * o - flat * flat) : 0;
        const wo_aperture hexagon = IRIS(6, .obstruction = o);
        assert_near(area_of(hexagon), 3 * sin(PI / 3) - PI * o * o + 6 * beyond, 1e-6);
    }
}

static void opening_goes_from_blades_to_round(void **state)
{
    (void)state;
    for (int n = 3; n <= WO_BLADES_MAX; n++) {
        const wo_aperture closed = IRIS(n, .rotation = 9);
        const wo_aperture open = IRIS(n, .rotation = 9, .opening = 1);
        const wo_aperture half = IRIS(n, .rotation = 9, .opening = 0.5);
        const wo_aperture curved = IRIS(n, .rotation = 9, .curvature = 0.5);
        const wo_aperture_shape shape = shape_of(&open);
        assert_close(shape.area, PI, 1e-12);
        assert_close(area_of(closed), 0.5 * n * sin(2 * PI / n), 1e-10);
        assert_close(area_of(half), area_of(curved), 1e-12);
        rng r = {(uint64_t)n};
        for (int i = 0; i < 1000; i++) {
            const double a = rng_range(&r, 0, 2 * PI);
            assert_true(wo_aperture_inside(&shape, 0.9999999 * cos(a), 0.9999999 * sin(a)));
            assert_false(wo_aperture_inside(&shape, 1.0000001 * cos(a), 1.0000001 * sin(a)));
            /* The samples are those of a disc, turned. */
            const wo_aperture round = IRIS(0, .rotation = 9);
            const wo_aperture_shape disc = shape_of(&round);
            double u[2];
            double v[2];
            const double s = rng_unit(&r);
            const double t = rng_unit(&r);
            wo_aperture_sample(&shape, s, t, u);
            wo_aperture_sample(&disc, s, t, v);
            assert_near(u[0], v[0], 1e-6);
            assert_near(u[1], v[1], 1e-6);
        }
    }
    double last = 0;
    for (int i = 0; i <= 100; i++) {
        const wo_aperture iris = IRIS(5, .opening = 0.01 * i);
        const double area = area_of(iris);
        assert_true(area > last && (i == 0 || area - last < 0.02));
        last = area;
    }
}

static void forms_stand_as_described(void **state)
{
    (void)state;
    const wo_aperture upright = HEART(.rotation = 0);
    const wo_aperture_shape heart = shape_of(&upright);
    assert_true(wo_aperture_inside(&heart, 0, -0.9999));
    assert_false(wo_aperture_inside(&heart, 0, -1.0001));
    assert_false(wo_aperture_inside(&heart, 0.02, -0.99));
    const double notch = (1 - 0.26120387496374148) / 1.2612038749637415;
    assert_true(wo_aperture_inside(&heart, 0, notch - 1e-4));
    assert_false(wo_aperture_inside(&heart, 0, notch + 1e-4));
    for (int side = -1; side <= 1; side += 2) {
        /* Far end of a lobe: from the middle through the centre of its disc to the circle. */
        const double x = side * 0.5;
        const double y = 0.5 - 0.26120387496374148;
        const double length = hypot(x, y);
        assert_true(wo_aperture_inside(&heart, 0.9999 * x / length, 0.9999 * y / length));
        assert_false(wo_aperture_inside(&heart, 1.0001 * x / length, 1.0001 * y / length));
    }
    const wo_aperture five = STAR(5, .rotation = 90);
    const wo_aperture_shape star = shape_of(&five);
    const double valley = 0.55 * cos(PI / 5);
    for (int i = 0; i < 5; i++) {
        const double a = PI / 2 + 2 * PI * i / 5;
        const double b = a + PI / 5;
        assert_true(wo_aperture_inside(&star, 0.9999 * cos(a), 0.9999 * sin(a)));
        assert_true(wo_aperture_inside(&star, 0.9999 * valley * cos(b), 0.9999 * valley * sin(b)));
        assert_false(wo_aperture_inside(&star, 1.0001 * valley * cos(b), 1.0001 * valley * sin(b)));
    }
    const wo_aperture mirror = IRIS(0, .obstruction = 0.4);
    const wo_aperture_shape ring = shape_of(&mirror);
    assert_false(wo_aperture_inside(&ring, 0, 0));
    assert_false(wo_aperture_inside(&ring, 0.3999, 0));
    assert_true(wo_aperture_inside(&ring, 0.4001, 0));
}

static void samples_lie_inside(void **state)
{
    (void)state;
    for (size_t i = 0; i < WO_COUNT(many); i++) {
        const wo_aperture_shape shape = shape_of(&many[i]);
        int outside = 0;
        rng r = {i};
        for (int n = 0; n < 20000; n++) {
            const double s = n % 7 == 0 ? (n / 7) % 2 : rng_unit(&r);
            const double t = n % 5 == 0 ? (n / 5) % 2 : rng_unit(&r);
            double u[2];
            wo_aperture_sample(&shape, s, t, u);
            assert_true(hypot(u[0], u[1]) <= 1 + 1e-12);
            assert_true(hypot(u[0], u[1]) >= many[i].obstruction - 1e-12);
            const double weight = wo_aperture_weight(&shape, u[0], u[1]);
            assert_true(weight >= 0 && weight <= 16);
            /* But for points on the very border. */
            const bool border = s == 0 || s == 1 || t == 0 || t == 1;
            outside += !border && !wo_aperture_inside(&shape, u[0], u[1]);
        }
        assert_at_most(outside, 20);
    }
}

/* Well spread weighted samples against the mask, cell by cell. */
static void mask_agrees(void **state)
{
    (void)state;
    enum { SIZE = 24, FINE = 8, WIDE = SIZE * FINE, SAMPLES = 200000 };
    static float fine[WIDE * WIDE];
    static double mask[SIZE * SIZE];
    static double share[SIZE * SIZE];
    for (size_t i = 0; i < WO_COUNT(many); i++) {
        const wo_aperture_shape shape = shape_of(&many[i]);
        const double cell = 4.0 / (SIZE * SIZE);
        const double each = shape.area / cell / SAMPLES;
        double sum = 0;
        double most = 0;
        wo_aperture_mask(&shape, WIDE, fine);
        memset(mask, 0, sizeof mask);
        for (int n = 0; n < WIDE * WIDE; n++) {
            assert_true(fine[n] >= 0);
            sum += (double)fine[n];
            most = fmax(most, (double)fine[n]);
            mask[n / WIDE / FINE * SIZE + n % WIDE / FINE] += (double)fine[n] / (FINE * FINE);
        }
        assert_near(sum * 4 / (WIDE * WIDE), shape.area * shape.light, 0.001);
        memset(share, 0, sizeof share);
        for (int n = 0; n < SAMPLES; n++) {
            double u[2];
            double whole;
            wo_aperture_sample(&shape, (n + 0.5) / SAMPLES, modf(n * 0.6180339887498949, &whole),
                               u);
            const int x = (int)fmin((u[0] + 1) / 2 * SIZE, SIZE - 1);
            const int y = (int)fmin((u[1] + 1) / 2 * SIZE, SIZE - 1);
            share[y * SIZE + x] += each * wo_aperture_weight(&shape, u[0], u[1]);
        }
        for (int n = 0; n < SIZE * SIZE; n++)
            if (!(fabs(share[n] - mask[n]) <= 0.08 * fmax(1, most)))
                fail_msg("shape %zu, cell %d: samples %g, mask %g", i, n, share[n], mask[n]);
    }
}

/* Random samples over cells against the areas of the cells in a fine mask; returns how many
   standard deviations chi-square is too large. */
static double chi_square(const wo_aperture_shape *shape)
{
    enum { CELLS = 12, FINE = 16, SIZE = CELLS * FINE, SAMPLES = 60000 };
    static float mask[SIZE * SIZE];
    double want[CELLS * CELLS] = {0};
    double hits[CELLS * CELLS] = {0};
    double total = 0;
    wo_aperture_mask(shape, SIZE, mask);
    for (int n = 0; n < SIZE * SIZE; n++) {
        want[n / SIZE / FINE * CELLS + n % SIZE / FINE] += (double)mask[n];
        total += (double)mask[n];
    }
    rng r = {99};
    for (int n = 0; n < SAMPLES; n++) {
        double u[2];
        const double s = rng_unit(&r);
        wo_aperture_sample(shape, s, rng_unit(&r), u);
        const int x = (int)((u[0] * 0.999999 + 1) / 2 * CELLS);
        const int y = (int)((u[1] * 0.999999 + 1) / 2 * CELLS);
        hits[y * CELLS + x]++;
    }
    double sum = 0;
    double freedom = -1;
    for (int i = 0; i < CELLS * CELLS; i++) {
        const double mean = want[i] / total * SAMPLES;
        if (mean < 20)
            continue;
        sum += (hits[i] - mean) * (hits[i] - mean) / mean;
        freedom++;
    }
    return (sum - freedom) / sqrt(2 * freedom);
}

static void samples_are_uniform(void **state)
{
    (void)state;
    for (size_t i = 0; i < WO_COUNT(many); i++) {
        wo_aperture bare = many[i];
        bare.apodization = bare.edge = bare.ring_amount = bare.grain_amount = 0;
        const wo_aperture_shape shape = shape_of(&bare);
        assert_true(shape.even && shape.light == 1);
        const double off = chi_square(&shape);
        if (!(off <= 5))
            fail_msg("shape %zu: chi-square is %g deviations too large", i, off);
    }
}

static double light_of(wo_aperture aperture)
{
    return shape_of(&aperture).light;
}

static void weights_have_their_means(void **state)
{
    (void)state;
    for (int i = 1; i <= 10; i++) {
        const double a = 0.1 * i;
        const double k = 2 * a * log(10);
        const wo_aperture smooth = IRIS(0, .apodization = a);
        assert_close(light_of(smooth), (1 - exp(-k)) / k, 1e-4);
        const wo_aperture bubble = IRIS(0, .edge = a);
        const wo_aperture creamy = IRIS(0, .edge = -a);
        assert_near(light_of(bubble), 1, 1e-3);
        assert_near(light_of(creamy), 1, 1e-3);
        const wo_aperture onion = IRIS(0, .ring_amount = a, .ring_count = 3 * i);
        assert_near(light_of(onion), 1, 1e-2 * a);
        const wo_aperture grain = IRIS(0, .grain_amount = a, .grain_seed = (uint32_t)i);
        assert_near(light_of(grain), 1, 0.05 * a);
    }
    const wo_aperture none = IRIS(6, .ring_count = 9, .grain_seed = 5);
    assert_true(shape_of(&none).even);
    /* The rim and the middle, as the formulas say. */
    const wo_aperture smooth = IRIS(0, .apodization = 1);
    const wo_aperture_shape stf = shape_of(&smooth);
    assert_near(wo_aperture_weight(&stf, 0, 0), 1, 0);
    assert_near(wo_aperture_weight(&stf, 0.6, 0.8), 0.01, 1e-12);
    const wo_aperture bubble = IRIS(0, .edge = 0.5);
    const wo_aperture_shape bright = shape_of(&bubble);
    assert_near(wo_aperture_weight(&bright, 0, 0), 0.5, 1e-12);
    assert_near(wo_aperture_weight(&bright, 0, 1), 2.5, 1e-12);
    const wo_aperture rings = IRIS(0, .ring_amount = 0.5, .ring_count = 4);
    const wo_aperture_shape onion = shape_of(&rings);
    assert_near(wo_aperture_weight(&onion, 0.25, 0), 1.5, 1e-12);
    assert_near(wo_aperture_weight(&onion, 0, 0.375), 0.5, 1e-12);
    /* Other grain for another seed, the same for the same; about half of it above 1. */
    const wo_aperture first = IRIS(0, .grain_amount = 1, .grain_seed = 1);
    const wo_aperture second = IRIS(0, .grain_amount = 1, .grain_seed = 2);
    const wo_aperture_shape one = shape_of(&first);
    const wo_aperture_shape two = shape_of(&second);
    const wo_aperture_shape again = shape_of(&first);
    int above = 0;
    double apart = 0;
    for (int i = 0; i < 1000; i++) {
        const double x = i * 0.0007;
        const double y = -0.6 + i * 0.001;
        const double w = wo_aperture_weight(&one, x, y);
        above += w > 1;
        apart = fmax(apart, fabs(w - wo_aperture_weight(&two, x, y)));
        assert_true(w == wo_aperture_weight(&again, x, y));
        assert_near(wo_aperture_weight(&one, x + 1e-6, y), w, 2e-4);
    }
    assert_true(above > 300 && above < 700 && apart > 0.5);
}

static void density_integrates_to_one(void **state)
{
    (void)state;
    enum { SIDE = 1000 };
    for (size_t i = 0; i < WO_COUNT(many); i++) {
        const wo_aperture_shape shape = shape_of(&many[i]);
        double sum = 0;
        for (int n = 0; n < SIDE * SIDE; n++)
            sum += wo_aperture_density(&shape, 2 * (n % SIDE + 0.5) / SIDE - 1,
                                       2 * ((double)(n / SIDE) + 0.5) / SIDE - 1);
        assert_near(sum * 4 / (SIDE * SIDE), 1, 2e-3);
    }
    const wo_aperture_shape disc = shape_of(&(const wo_aperture)IRIS(0, .rotation = 1));
    assert_near(wo_aperture_density(&disc, NAN, 0), 0, 0);
    assert_near(wo_aperture_density(&disc, 0, INFINITY), 0, 0);
}

static void refused_values(void **state)
{
    (void)state;
    const struct {
        wo_aperture aperture;
        const char *word;
    } bad[] = {
        {IRIS(6, .opening = -0.01), "opening"},
        {IRIS(6, .opening = 1.01), "opening"},
        {IRIS(6, .opening = NAN), "opening"},
        {IRIS(6, .obstruction = -0.01), "obstruction"},
        {IRIS(6, .obstruction = 0.951), "obstruction"},
        {IRIS(6, .obstruction = NAN), "obstruction"},
        {IRIS(6, .apodization = 1.5), "apodization"},
        {IRIS(6, .apodization = -INFINITY), "apodization"},
        {IRIS(6, .apodization = NAN), "apodization"},
        {IRIS(6, .edge = 1.1), "edge"},
        {IRIS(6, .edge = NAN), "edge"},
        {IRIS(6, .ring_amount = 2), "rings"},
        {IRIS(6, .ring_amount = NAN), "rings"},
        {IRIS(6, .ring_count = -1), "rings"},
        {IRIS(6, .ring_count = 65), "rings"},
        {IRIS(6, .ring_count = INT32_MAX), "rings"},
        {IRIS(6, .grain_amount = -1e300), "grain"},
        {IRIS(6, .grain_amount = NAN), "grain"},
        {IRIS(6, .form = (wo_aperture_form)3), "form"},
        {STAR(0, .rotation = 0), "star"},
        {STAR(17, .rotation = 0), "blades"},
    };
    for (size_t i = 0; i < WO_COUNT(bad); i++) {
        wo_error error = {WO_OK, ""};
        assert_int_equal(wo_aperture_validate(&bad[i].aperture, &error), WO_ERR_RANGE);
        if (!strstr(error.text, bad[i].word))
            fail_msg("\"%s\" does not speak of %s", error.text, bad[i].word);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(areas),
        cmocka_unit_test(opening_goes_from_blades_to_round),
        cmocka_unit_test(forms_stand_as_described),
        cmocka_unit_test(samples_lie_inside),
        cmocka_unit_test(mask_agrees),
        cmocka_unit_test(samples_are_uniform),
        cmocka_unit_test(weights_have_their_means),
        cmocka_unit_test(density_integrates_to_one),
        cmocka_unit_test(refused_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
