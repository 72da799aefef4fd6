/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "cases.h"
#include "defocus/renderer.h"

#include "near.h"
#include "scenes.h"

#include <stdlib.h>
#include <string.h>

/* A slow focus pull does not pop: how much the largest of the steps of 0.05 px from radius 0 to 2
   px changes the picture, against the median step. */

enum { STEPS = 40, METHODS = WO_METHOD_REFERENCE };
static const wo_rect frame = {0, 0, 96, 64};

/* Noise between random values on a grid of 3 px, edges, and a box nearer than the rest; lights: so
   many bright pixels on it. */
static void fill(scene *s, int lights)
{
    rng r = {5};
    float grid[33][23];
    for (int i = 0; i < 33; i++)
        for (int j = 0; j < 23; j++)
            grid[i][j] = (float)rng_unit(&r);
    wo_image *const source = scene_clip(s, WO_CLIP_SOURCE, 4);
    wo_image *const depth = scene_clip(s, WO_CLIP_DEPTH, 1);
    for (int32_t y = 0; y < 64; y++)
        for (int32_t x = 0; x < 96; x++) {
            const int i = x / 3;
            const int j = y / 3;
            const float tx = (float)(x % 3) / 3;
            const float ty = (float)(y % 3) / 3;
            const float low = grid[i][j] + tx * (grid[i + 1][j] - grid[i][j]);
            const float high = grid[i][j + 1] + tx * (grid[i + 1][j + 1] - grid[i][j + 1]);
            const bool box = x > 30 && x < 60 && y > 20 && y < 44;
            float *const c = wo_image_at(source, x, y);
            for (int k = 0; k < 3; k++)
                c[k] = (low + ty * (high - low)) * (box ? 0.9f : (x + y) / 16 % 2 ? 0.5f : 0.25f);
            c[3] = 1;
            *wo_image_at(depth, x, y) = box ? 4.0f / 3 : 4;
        }
    for (int n = 0; n < lights; n++) {
        float *const c = wo_image_at(source, rng_int(&r, 4, 91), rng_int(&r, 4, 59));
        c[0] = c[1] = c[2] = 60;
    }
}

static int by_size(const void *a, const void *b)
{
    const double *x = a;
    const double *y = b;
    return (*x > *y) - (*x < *y);
}

/* Of the displayed value: a light too bright to show changes nothing. */
static double displayed_rms(const wo_image *a, const wo_image *b)
{
    double sum = 0;
    for (int32_t y = frame.y1; y < frame.y2; y++)
        for (int32_t x = frame.x1; x < frame.x2; x++)
            for (int k = 0; k < 3; k++) {
                const float p = wo_display(wo_image_at(a, x, y)[k]);
                const float q = wo_display(wo_image_at(b, x, y)[k]);
                sum += (double)((p - q) * (p - q));
            }
    return sqrt(sum / (3.0 * wo_rect_width(frame) * wo_rect_height(frame)));
}

static void check(int method, int lights, double bar)
{
    scene s;
    scene_init(&s, frame);
    s.params.method = method;
    s.params.samples = 64;
    s.params.focus_distance = 2;
    fill(&s, lights);
    double steps[STEPS];
    wo_image last = {0};
    for (int i = 0; i <= STEPS; i++) {
        /* A quarter of a dioptre before the focus, and as much behind it. */
        scene_px_per_dioptre(&s, fmax(0.05 * i, 1e-4) / 0.25);
        wo_image out = scene_render(&s, NULL);
        if (i > 0)
            steps[i - 1] = displayed_rms(&out, &last);
        picture_free(&last);
        last = out;
    }
    picture_free(&last);
    scene_free(&s);
    qsort(steps, STEPS, sizeof *steps, by_size);
    const double median = 0.5 * (steps[STEPS / 2 - 1] + steps[STEPS / 2]);
    print_message("%s, %d lights: largest step %.2f of the median\n",
                  wo_renderer_of((wo_method)method)->key, lights, steps[STEPS - 1] / median);
    assert_true(median > 0);
    assert_at_most(steps[STEPS - 1], bar * median);
}

/* Where cases are few each method is looked at with detail or with lights.
   2 is wanted. What is above is not reached yet, and may not get worse: spread darkens the pixels
   beside a light before it lights them, as interpolation overshoots. */
static const double bars[METHODS][2] = {
    [WO_METHOD_HYBRID] = {2, 2},   [WO_METHOD_RAYS] = {2, 2},       [WO_METHOD_FILTER] = {2, 2},
    [WO_METHOD_SPREAD] = {2, 2.6}, [WO_METHOD_ACCUMULATE] = {2, 2},
};

static void detail_blurs_smoothly(void **state)
{
    (void)state;
    for (int method = 0; method < METHODS; method += cases_of(1, 2))
        check(method, 0, bars[method][0]);
}

static void lights_blur_smoothly(void **state)
{
    (void)state;
    for (int method = cases_of(0, 1); method < METHODS; method += cases_of(1, 2))
        check(method, 12, bars[method][1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(detail_blurs_smoothly),
        cmocka_unit_test(lights_blur_smoothly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
