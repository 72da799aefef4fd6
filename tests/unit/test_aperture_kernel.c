/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/aperture.h"

#include "near.h"
#include "optics/pencil.h"
#include "scenes.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

static const wo_aperture plain = WO_APERTURE_INIT;

static wo_aperture_shape shape_of(const wo_aperture *aperture, const float *data, int width,
                                  int height)
{
    const wo_aperture_kernel kernel = {data, width, height, width};
    wo_error error = {WO_OK, ""};
    wo_aperture_shape shape;
    if (wo_aperture_make_kernel(NULL, aperture, &kernel, &shape, &error) != WO_OK)
        fail_msg("%s", error.text);
    return shape;
}

static void one_pixel_is_a_square(void **state)
{
    (void)state;
    const float values[] = {1, FLT_MIN / 4, FLT_MAX, 0.3f};
    for (size_t i = 0; i < WO_COUNT(values); i++) {
        wo_aperture_shape shape = shape_of(&plain, &values[i], 1, 1);
        const double half = sqrt(0.5);
        assert_close(shape.area, 2, 1e-12);
        assert_true(shape.even);
        assert_true(wo_aperture_inside(&shape, 0.9999 * half, -0.9999 * half));
        assert_false(wo_aperture_inside(&shape, 0, 1.0001 * half));
        assert_near(wo_aperture_density(&shape, 0.1, 0.2), 0.5, 1e-12);
        double u[2];
        wo_aperture_sample(&shape, 0, 1, u);
        assert_near(u[0], -half, 1e-12);
        assert_near(u[1], half, 1e-12);
        wo_aperture_sample(&shape, 0.75, 0.5, u);
        assert_near(u[0], half / 2, 1e-12);
        assert_near(u[1], 0, 1e-12);
        wo_aperture_destroy(NULL, &shape);
        wo_aperture_destroy(NULL, &shape);
    }
}

static void values_are_shares(void **state)
{
    (void)state;
    /* Row 0 at the bottom; dark, non-finite and negative values in between and at the ends. */
    const float data[] = {0, -1, 0, 0, 0, NAN, 3, 0, 1, 0, 0, INFINITY, 0, 2, 0, -INFINITY, 0, 0};
    wo_aperture_shape shape = shape_of(&plain, data, 6, 3);
    /* The farthest corner is 3 to the left and 0.5 up. */
    const double side = 1 / hypot(3, 0.5);
    assert_close(shape.area, side * side * 6 / 3, 1e-12);
    double hits[3][6] = {{0}};
    enum { SAMPLES = 60000 };
    for (int n = 0; n < SAMPLES; n++) {
        double u[2];
        double whole;
        wo_aperture_sample(&shape, modf(n * 0.6180339887498949, &whole), (n + 0.5) / SAMPLES, u);
        assert_true(hypot(u[0], u[1]) <= 1 + 1e-12);
        const int x = (int)floor(u[0] / side + 3);
        const int y = (int)floor(u[1] / side + 1.5);
        assert_true(x >= 0 && x < 6 && y >= 0 && y < 3);
        hits[y][x] += 6.0 / SAMPLES;
    }
    for (int i = 0; i < 18; i++) {
        const double want = isfinite(data[i]) && data[i] > 0 ? (double)data[i] : 0;
        assert_near(hits[i / 6][i % 6], want, want > 0 ? 0.01 : 0);
        const double x = (i % 6 - 2.5) * side;
        const double y = (i / 6 - 1.0) * side;
        assert_near(wo_aperture_density(&shape, x, y), want / (6 * side * side), 1e-12);
        assert_true(wo_aperture_inside(&shape, x, y) == (want > 0));
    }
    wo_aperture_destroy(NULL, &shape);
}

/* Weighted samples against the mask, for a picture of noise that is turned, squeezed and holed. */
static void mask_agrees(void **state)
{
    (void)state;
    enum { W = 17, H = 11, SIZE = 24, FINE = 8, WIDE = SIZE * FINE, SAMPLES = 200000 };
    static float fine[WIDE * WIDE];
    static double mask[SIZE * SIZE];
    static double share[SIZE * SIZE];
    float data[W * H];
    rng r = {5};
    for (int i = 0; i < W * H; i++)
        data[i] = (float)fmax(rng_range(&r, -0.5, 1), 0) * 1e30f;
    const wo_aperture apertures[] = {
        WO_APERTURE_INIT,
        {.aspect = 0.6, .rotation = 33},
        {.aspect = 1.4, .rotation = -100, .obstruction = 0.45},
        {.aspect = 1, .apodization = 0.4, .edge = -0.5, .grain_amount = 0.3},
    };
    for (size_t i = 0; i < WO_COUNT(apertures); i++) {
        wo_aperture_shape shape = shape_of(&apertures[i], data, W, H);
        memset(share, 0, sizeof share);
        memset(mask, 0, sizeof mask);
        wo_aperture_mask(&shape, WIDE, fine);
        double sum = 0;
        for (int n = 0; n < WIDE * WIDE; n++) {
            sum += (double)fine[n] * 4 / (WIDE * WIDE);
            mask[n / WIDE / FINE * SIZE + n % WIDE / FINE] += (double)fine[n] / (FINE * FINE);
        }
        assert_close(sum, shape.area * shape.light, 3e-3);
        const double each = shape.area * SIZE * SIZE / 4 / SAMPLES;
        for (int n = 0; n < SAMPLES; n++) {
            double u[2];
            double whole;
            wo_aperture_sample(&shape, modf(n * 0.6180339887498949, &whole), (n + 0.5) / SAMPLES,
                               u);
            const int x = (int)fmin((u[0] + 1) / 2 * SIZE, SIZE - 1);
            const int y = (int)fmin((u[1] + 1) / 2 * SIZE, SIZE - 1);
            share[y * SIZE + x] += each * wo_aperture_weight(&shape, u[0], u[1]);
        }
        for (int n = 0; n < SIZE * SIZE; n++)
            assert_near(share[n], mask[n], 0.06);
        wo_aperture_destroy(NULL, &shape);
    }
}

static void unusable_kernels_are_refused(void **state)
{
    (void)state;
    const float dark[4] = {0, -1, NAN, INFINITY};
    const float lit[1] = {1};
    const struct {
        wo_aperture_kernel kernel;
        const char *word;
    } bad[] = {
        {{dark, 2, 2, 2}, "dark"},
        {{NULL, 2, 2, 2}, "no pixels"},
        {{lit, 0, 1, 1}, "0 x 1"},
        {{lit, 1, -7, 1}, "1 x -7"},
        {{lit, WO_KERNEL_SIDE_MAX + 1, 1, 1}, "1..2048"},
        {{lit, 1, INT32_MAX, 1}, "1..2048"},
    };
    for (size_t i = 0; i < WO_COUNT(bad); i++) {
        wo_error error = {WO_OK, ""};
        wo_aperture_shape shape;
        assert_true(wo_aperture_make_kernel(NULL, &plain, &bad[i].kernel, &shape, &error) != WO_OK);
        assert_null(shape.kernel);
        if (!strstr(error.text, bad[i].word))
            fail_msg("\"%s\" does not speak of %s", error.text, bad[i].word);
    }
    const wo_aperture absurd = {.aspect = NAN};
    const wo_aperture_kernel kernel = {lit, 1, 1, 1};
    wo_aperture_shape shape;
    assert_int_equal(wo_aperture_make_kernel(NULL, &absurd, &kernel, &shape, NULL), WO_ERR_RANGE);
}

/* Memory that ends after so many requests. */
static void *last_memory(void *user, size_t bytes)
{
    int *left = user;
    return (*left)-- > 0 ? aligned_alloc(WO_ALIGNMENT, (bytes + 63) / 64 * 64) : NULL;
}

static void put_back(void *user, void *memory)
{
    (void)user;
    free(memory);
}

static void missing_memory_is_an_error(void **state)
{
    (void)state;
    const float lit[6] = {1, 2, 3, 4, 5, 6};
    const wo_aperture_kernel kernel = {lit, 3, 2, 3};
    for (int allowed = 0; allowed <= 3; allowed++) {
        int left = allowed;
        const wo_context context = {.allocator = {&left, last_memory, put_back}};
        wo_aperture_shape shape;
        const wo_status status = wo_aperture_make_kernel(&context, &plain, &kernel, &shape, NULL);
        assert_int_equal(status, allowed < 3 ? WO_ERR_NOMEM : WO_OK);
        wo_aperture_destroy(&context, &shape);
    }
}

static void cats_eye(void **state)
{
    (void)state;
    const double cases[][3] = {{0, 0.5, 0.5},      {1, 0, 0},     {0.5, 0.6, -0.3}, {1.5, 0.8, 0.6},
                               {-1.2, 0.1, -0.95}, {2, 0.6, 0.8}, {3, -0.7, 0.7}};
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        const double *c = cases[i];
        enum { SIDE = 1000 };
        double sum = 0;
        for (int n = 0; n < SIDE * SIDE; n++)
            sum += wo_aperture_cats_eye(c[0], c[1], c[2], 2 * (n % SIDE + 0.5) / SIDE - 1,
                                        2 * ((double)(n / SIDE) + 0.5) / SIDE - 1);
        assert_near(wo_aperture_cats_eye_area(c[0], c[1], c[2]), sum * 4 / (SIDE * SIDE), 5e-4);
    }
    assert_close(wo_aperture_cats_eye_area(1, 0.6, 0.8), 2 * PI / 3 - sqrt(3) / 2, 1e-12);
    assert_close(wo_aperture_cats_eye_area(5, 0, 0), PI, 1e-15);
    /* Behind the pupil the far side stays open, before it the near side. */
    assert_true(wo_aperture_cats_eye(1, 1, 0, 0.9, 0));
    assert_false(wo_aperture_cats_eye(1, 1, 0, -0.1, 0));
    assert_true(wo_aperture_cats_eye(-1, 1, 0, -0.9, 0));
    assert_false(wo_aperture_cats_eye(-1, 1, 0, 0.1, 0));
    assert_false(wo_aperture_cats_eye(1, 0, 0, NAN, 0));
    assert_false(wo_aperture_cats_eye(NAN, 1, 0, 0, 0));
}

static void barn_doors(void **state)
{
    (void)state;
    const wo_barn_doors none = {0};
    const wo_barn_doors doors = {.left = 0.5, .right = 1.5, .bottom = 2, .top = 0.25};
    const double fields[][2] = {{0, 0}, {0.5, 0}, {1, 0}, {-1, 0}, {0, 0.7}, {0, -0.6}};
    const double cuts[] = {0, 0.75, 1.5, 0.5, 0.175, 1.2};
    for (size_t i = 0; i < WO_COUNT(cuts); i++) {
        /* One door at a time cuts a segment of this height. */
        const double flat = 1 - cuts[i];
        const double want = PI - (acos(flat) - flat * sqrt(1 - flat * flat));
        enum { SIDE = 1000 };
        double sum = 0;
        for (int n = 0; n < SIDE * SIDE; n++) {
            const double x = 2 * (n % SIDE + 0.5) / SIDE - 1;
            const double y = 2 * ((double)(n / SIDE) + 0.5) / SIDE - 1;
            const bool in = x * x + y * y <= 1;
            assert_true(wo_barn_doors_pass(&none, fields[i][0], fields[i][1], x, y));
            sum += in && wo_barn_doors_pass(&doors, fields[i][0], fields[i][1], x, y);
        }
        assert_near(sum * 4 / (SIDE * SIDE), want, 2e-3);
    }
    assert_false(wo_barn_doors_pass(&doors, 0.5, 0, 0.3, 0));
    assert_true(wo_barn_doors_pass(&doors, 0.5, 0, -0.9, 0));
    assert_false(wo_barn_doors_pass(&doors, 0, -0.6, 0, -0.3));
    assert_true(wo_barn_doors_pass(&doors, -1, -1, 0, 0) == false);
}

/* Rays of the thin lens carry the weights; connect knows their density. */
static void pencils_carry_the_weights(void **state)
{
    (void)state;
    const wo_thin_lens lens = {.k = 10};
    const wo_aperture apertures[] = {
        WO_APERTURE_INIT,
        {.aspect = 1, .apodization = 0.7},
        {.aspect = 0.7, .blades = 5, .rotation = 7, .edge = 0.8, .obstruction = 0.4},
        {.aspect = 1, .form = WO_APERTURE_HEART, .ring_amount = 0.5, .ring_count = 4},
    };
    for (size_t i = 0; i < WO_COUNT(apertures); i++) {
        wo_thin_pencils *pencils;
        assert_int_equal(
            wo_thin_pencils_create(NULL, &lens, &apertures[i], 1.5, 700, 3, &pencils, NULL), WO_OK);
        const wo_lens view = wo_thin_pencils_lens(pencils);
        wo_aperture_shape shape;
        wo_aperture_make(&apertures[i], &shape);
        double sum = 0;
        for (unsigned set = 0; set < view.sets; set++) {
            for (int first = 0; first < view.count; first += WO_PENCIL_PIECE) {
                static wo_pencil_room room;
                wo_pencil p;
                view.pencil(view.self, 0, 0, set, first, &room, &p);
                assert_true((p.weight[0] == NULL) == (i == 0));
                for (int n = 0; p.weight[0] && n < p.count; n++) {
                    const double x = (double)p.bx[n] / lens.k;
                    const double y = (double)p.by[n] / (lens.k * 1.5);
                    const double want = wo_aperture_weight(&shape, x, y) / shape.light;
                    for (int k = 0; k < 3; k++)
                        assert_near((double)p.weight[k][n], want, 1e-4);
                    sum += (double)p.weight[0][n] / view.count / view.sets;
                }
            }
        }
        assert_near(sum, i > 0, 1e-3);
        double light = 0;
        for (int y = -160; y <= 160; y++)
            for (int x = -110; x <= 110; x++) {
                double line[4];
                light += view.connect(view.self, x, y, -10, line);
            }
        assert_near(light, 1, 5e-3);
        wo_thin_pencils_destroy(NULL, &pencils);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_pixel_is_a_square),
        cmocka_unit_test(values_are_shares),
        cmocka_unit_test(mask_agrees),
        cmocka_unit_test(unusable_kernels_are_refused),
        cmocka_unit_test(missing_memory_is_an_error),
        cmocka_unit_test(cats_eye),
        cmocka_unit_test(barn_doors),
        cmocka_unit_test(pencils_carry_the_weights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
