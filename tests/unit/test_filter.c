/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/filter_scene.h"
#include "near.h"
#include "scenes.h"

#include <stdlib.h>
#include <string.h>

static const wo_filter_kernels *kernels[2];
static int kernel_count;

static int by_value(const void *a, const void *b)
{
    const float x = *(const float *)a;
    const float y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Against sorting; few different values, so that equals meet. */
static void median_is_the_middle(void **state)
{
    (void)state;
    enum { W = 4 * WO_LANES };
    rng r = {3};
    float rows[3][W + 2];
    for (int n = 0; n < 50; n++) {
        for (int j = 0; j < 3; j++)
            for (int i = 0; i < W + 2; i++)
                rows[j][i] = n % 2 ? (float)rng_int(&r, -3, 3) : (float)rng_range(&r, -1, 1e4);
        for (int k = 0; k < kernel_count; k++) {
            float out[W];
            const float *const at[3] = {rows[0] + 1, rows[1] + 1, rows[2] + 1};
            kernels[k]->median(at, W, out);
            for (int i = 0; i < W; i++) {
                float nine[9];
                for (int j = 0; j < 9; j++)
                    nine[j] = rows[j / 3][i + j % 3];
                qsort(nine, 9, sizeof nine[0], by_value);
                assert_true(out[i] == nine[4]);
            }
        }
    }
}

/* A soft disc over the pixels blurs as much as the circle it stands for, and its shares add up. */
static void discs_blur_as_circles_do(void **state)
{
    (void)state;
    wo_filter_discs discs;
    float reach;
    float share;
    wo_filter_discs_make(&discs);
    wo_filter_disc(&discs, 0, 0, &reach, &share);
    assert_true(reach == 0.5f && share == 1);
    float last = 0.5f;
    for (int i = 1; i <= 400; i++) {
        const double r = 0.05 * i;
        wo_filter_disc(&discs, (float)r, 0, &reach, &share);
        assert_true(reach > last && (double)reach < r + 0.5);
        last = reach;
        double sum = 0;
        double moment = 0;
        for (int y = -22; y <= 22; y++)
            for (int x = -22; x <= 22; x++) {
                const double steep = 1 - fmin((double)reach - 0.5, 1) / 4;
                const double t = ((double)reach + 0.5 - hypot(x, y)) * steep;
                const double w = t < 0 ? 0 : fmin(t * t, 1);
                sum += w;
                moment += w * x * x;
            }
        assert_near(2 * sqrt(moment / sum), r, r < 3 ? 0.02 : 0.05);
        assert_near(sum * (double)share, 1, r < 3 ? 0.01 : 0.02);
    }
}

static void bins_are_directions(void **state)
{
    (void)state;
    int last = 0;
    for (int i = 0; i < 3600; i++) {
        const double a = i * 3.14159265358979 / 1800;
        const int bin = wo_filter_bin((float)cos(a), (float)sin(a));
        assert_int_equal(bin, wo_filter_bin((float)(1e-3 * cos(a)), (float)(1e-3 * sin(a))));
        assert_true(bin == last || bin == last + 1);
        last = bin;
    }
    assert_int_equal(last, WO_FILTER_BINS - 1);
}

typedef struct probe {
    wo_stack stack;
    wo_filter_scene scene;
} probe;

/* The shape that is found for the pencils of an aperture over an empty piece of scene. */
static wo_filter_shape shape_of(const wo_aperture *aperture, double stretch, int count)
{
    const wo_thin_lens lens = {.k = 20};
    const wo_rect area = {0, 0, 64, 8};
    wo_sheet sheet;
    uint8_t opaque[64 * 8];
    memset(opaque, 1, sizeof opaque);
    assert_int_equal(wo_sheet_create(NULL, area, &sheet, NULL), WO_OK);
    memset(sheet.v, 0, sizeof opaque * sizeof *sheet.v);
    memset(sheet.c, 0, sizeof opaque * sizeof *sheet.c);
    sheet.any = true;
    wo_thin_pencils *pencils = NULL;
    assert_int_equal(
        wo_thin_pencils_create(NULL, &lens, aperture, stretch, count, 0, &pencils, NULL), WO_OK);
    const wo_lens made = wo_thin_pencils_lens(pencils);
    probe p;
    assert_int_equal(wo_stack_create(NULL, &sheet, 1, opaque, area, area, &p.stack, NULL), WO_OK);
    assert_int_equal(wo_filter_scene_create(NULL, &p.stack, &made, area, &p.scene, NULL), WO_OK);
    const wo_filter_shape shape = *wo_filter_shape_at(&p.scene, 3, 3);
    wo_filter_scene_destroy(NULL, &p.scene);
    wo_stack_destroy(NULL, &p.stack);
    wo_sheet_destroy(NULL, &sheet);
    wo_thin_pencils_destroy(NULL, &pencils);
    return shape;
}

static void shapes_are_those_of_the_aperture(void **state)
{
    (void)state;
    const int counts[] = {1, 16, 100, 3000};
    for (size_t i = 0; i < WO_COUNT(counts); i++) {
        const wo_aperture disc = WO_APERTURE_INIT;
        const wo_filter_shape shape = shape_of(&disc, 1, counts[i]);
        assert_near((double)shape.ppd, 20, counts[i] == 1 ? 1.5 : 0.4);
        assert_near((double)shape.v0, 0, 1e-6);
        assert_near((double)shape.rest, 0, 1e-4);
        assert_true(shape.lit == 1);
        assert_true(counts[i] == 1 || shape.hole == 0);
        for (int b = 0; b < WO_FILTER_BINS && counts[i] > 1; b++)
            assert_near((double)shape.outer[b], 1, 0.08);
    }
    wo_aperture a = WO_APERTURE_INIT;
    a.blades = 4; /* a square on its corner: area 2 r^2, corners at r */
    wo_filter_shape shape = shape_of(&a, 1, 256);
    const double ppd = 20 * sqrt(2 / 3.14159265);
    assert_near((double)shape.ppd, ppd, 0.4);
    assert_near((double)shape.outer[0] * ppd, 20, 1);
    assert_near((double)shape.outer[WO_FILTER_BINS / 8] * ppd, 20 / sqrt(2), 1);
    a = (wo_aperture)WO_APERTURE_INIT;
    a.obstruction = 0.5;
    shape = shape_of(&a, 1, 256);
    assert_near((double)shape.hole, 0.5, 0.05);
    a.obstruction = 0;
    shape = shape_of(&a, 2, 256); /* tall pixels */
    assert_near((double)shape.ppd, 20 * sqrt(2), 0.6);
    assert_near((double)(shape.outer[WO_FILTER_BINS / 4] / shape.outer[0]), 2, 0.2);
}

int main(void)
{
    kernels[kernel_count++] = wo_filter_choose(WO_CPU_BASE);
    if (wo_filter_choose(wo_cpu_detect(WO_CPU_AUTO)) != kernels[0])
        kernels[kernel_count++] = wo_filter_choose(wo_cpu_detect(WO_CPU_AUTO));
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(median_is_the_middle),
        cmocka_unit_test(discs_blur_as_circles_do),
        cmocka_unit_test(bins_are_directions),
        cmocka_unit_test(shapes_are_those_of_the_aperture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
