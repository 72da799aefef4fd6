/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* The method filter: what must hold whatever the picture is, and how near it comes to rays. */
#include "effects/lens_blur_plan.h"

#include "cases.h"
#include "near.h"
#include "optics/lens_choice.h"
#include "scenes.h"

#include <stdlib.h>
#include <string.h>

static const wo_rect frame = {-13, 5, 147, 101};

static void scene_make(scene *s, int kind)
{
    scene_init(s, frame);
    s->params.method = WO_METHOD_FILTER;
    s->params.samples = 12;
    scene_px_per_dioptre(s, kind % 2 ? 12 : 40);
    if (kind % 2) /* a window needs only a part of the picture */
        s->params.max_radius = 7;
    s->params.blades = kind % 2 ? 5 : 0;
    s->params.obstruction = kind == 3 ? 0.4 : 0;
    if (kind < 2)
        scene_fill_busy(s, (uint64_t)kind);
    else
        scene_fill_layers(s, (uint64_t)kind);
}

/* No highlights: they are rays of their own, and begin at 2 px. */
static void dim(scene *s)
{
    for (int32_t i = 0; i < wo_rect_width(frame) * wo_rect_height(frame) * 4; i++)
        s->clip[WO_CLIP_SOURCE].data[i] = fminf(s->clip[WO_CLIP_SOURCE].data[i], 1);
}

/* A step of depth in front of the focus and one behind, a slope between. */
static void fill_depth(scene *s)
{
    wo_image *const depth = scene_clip(s, WO_CLIP_DEPTH, 1);
    const wo_rect e = s->geometry.extent;
    for (int32_t y = e.y1; y < e.y2; y++)
        for (int32_t x = e.x1; x < e.x2; x++)
            *wo_image_at(depth, x, y) = x < 40                  ? 0.9f
                                        : (x / 20 + y / 16) % 3 ? 2 + 0.02f * (float)y
                                                                : 30;
}

static void constant_stays_constant(void **state)
{
    (void)state;
    const float levels[] = {0.18f, 3.9f, 3000};
    for (size_t i = 0; i < WO_COUNT(levels); i++) {
        const float c[4] = {levels[i], 0.5f * levels[i], 0.03f * levels[i], 1};
        scene s;
        scene_make(&s, 0);
        s.params.blades = (int32_t)i * 3;
        s.params.obstruction = i == 1 ? 0.5 : 0;
        picture_fill(scene_clip(&s, WO_CLIP_SOURCE, 4), c);
        fill_depth(&s);
        wo_image out = scene_render(&s, NULL);
        /* Light far above white is taken out of the sheets, and put back by rays of its own. */
        const double tolerance = i < 2 ? 1e-6 : 1e-5;
        for (int32_t y = frame.y1; y < frame.y2; y++)
            for (int32_t x = frame.x1; x < frame.x2; x++) {
                for (int k = 0; k < 3; k++)
                    assert_near((double)wo_image_at(&out, x, y)[k], (double)c[k],
                                tolerance * (double)fmaxf(c[0], 1));
                assert_true(wo_image_at(&out, x, y)[3] == 1);
            }
        picture_free(&out);
        scene_free(&s);
    }
}

static void opaque_stays_opaque(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        scene s;
        scene_make(&s, kind);
        s.params.samples = kind == 1 ? 700 : 9;
        if (kind < 2)
            fill_depth(&s);
        wo_image out = scene_render(&s, NULL);
        assert_true(picture_finite(&out));
        for (int32_t y = frame.y1; y < frame.y2; y++)
            for (int32_t x = frame.x1; x < frame.x2; x++)
                assert_true(wo_image_at(&out, x, y)[3] == 1);
        picture_free(&out);
        scene_free(&s);
    }
}

/* What has no surface stays clear; the edge of what has one becomes soft around its middle. */
static void holes_stay_holes(void **state)
{
    (void)state;
    scene s;
    scene_make(&s, 0);
    scene_px_per_dioptre(&s, 25);
    s.params.samples = 128;
    wo_image *const source = scene_clip(&s, WO_CLIP_SOURCE, 4);
    wo_image *const depth = scene_clip(&s, WO_CLIP_DEPTH, 1);
    picture_fill(depth, (const float[1]){1});
    for (int32_t y = frame.y1; y < frame.y2; y++)
        for (int32_t x = frame.x1; x < frame.x2; x++)
            for (int k = 0; k < 4; k++)
                wo_image_at(source, x, y)[k] = x < 60 ? 1 : 0;
    wo_image out = scene_render(&s, NULL); /* radius 15 px */
    for (int32_t y = frame.y1; y < frame.y2; y++) {
        assert_true(wo_image_at(&out, 40, y)[3] == 1);
        assert_true(wo_image_at(&out, 80, y)[3] == 0);
        assert_near((double)wo_image_at(&out, 59, y)[3], 0.5, 0.12);
        for (int32_t x = frame.x1; x < frame.x2; x++)
            assert_near((double)wo_image_at(&out, x, y)[0], (double)wo_image_at(&out, x, y)[3],
                        1e-5);
    }
    picture_free(&out);
    scene_free(&s);
}

/* Pixels in focus that nothing blurred comes near are the source, bit by bit. */
static void focus_is_the_source(void **state)
{
    (void)state;
    scene s;
    scene_make(&s, 0);
    scene_fill_busy(&s, 5);
    wo_image *const depth = &s.clip[WO_CLIP_DEPTH];
    const float focus = (float)s.params.focus_distance;
    scene_px_per_dioptre(&s, 10); /* the box: 6 px */
    for (int32_t y = frame.y1; y < frame.y2; y++)
        for (int32_t x = frame.x1; x < frame.x2; x++)
            *wo_image_at(depth, x, y) = x > 60 && x < 90 && y > 40 && y < 60 ? 1 : focus;
    wo_report report = {0};
    wo_image out = scene_render(&s, &report);
    assert_true(report.tiles[WO_TILE_MARCH] > 0);
    int64_t exact = 0;
    int64_t blurred = 0;
    for (int32_t y = frame.y1; y < frame.y2; y++)
        for (int32_t x = frame.x1; x < frame.x2; x++) {
            const float *const want = wo_image_at(&s.clip[WO_CLIP_SOURCE], x, y);
            const bool same = memcmp(wo_image_at(&out, x, y), want, 4 * sizeof(float)) == 0;
            const bool near = x > 50 && x < 100 && y > 30 && y < 70;
            exact += same;
            blurred += !same;
            assert_true(same || near);
        }
    assert_true(exact > 0 && blurred > 600);
    picture_free(&out);
    scene_free(&s);
}

/* One distance: against the reference with many rays. The error of the mean of n taps must not be
   more than this. */
static void one_vergence_against_brute_force(void **state)
{
    (void)state;
    const struct {
        int32_t samples;
        double most;
    } steps[] = {{16, 0.010}, {64, 0.005}, {256, 0.003}};
    /* 12 px in front, 7.5 px behind, 1.1 px: there rays interpolate colours, which blurs more. */
    const double depths[] = {1.0, 40, 2.2};
    for (size_t d = 0; d < WO_COUNT(depths); d++) {
        scene s;
        scene_make(&s, 0);
        scene_fill_busy(&s, 8);
        s.params.blades = d == 1 ? 5 : 0;
        dim(&s);
        picture_fill(&s.clip[WO_CLIP_DEPTH], (const float[1]){(float)depths[d]});
        scene_px_per_dioptre(&s, 20);
        s.params.method = WO_METHOD_RAYS;
        s.params.samples = 2048;
        wo_image want = scene_render(&s, NULL);
        s.params.method = WO_METHOD_FILTER;
        double last = INFINITY;
        for (size_t i = 0; i < WO_COUNT(steps); i++) {
            s.params.samples = steps[i].samples;
            wo_image out = scene_render(&s, NULL);
            const double error = picture_rms(&out, &want, frame);
            print_message("%4.1f m, %3d taps: RMSE %.5f\n", depths[d], steps[i].samples, error);
            assert_at_most(error, d < 2 ? steps[i].most : 0.006);
            /* Below 2 px there are no taps. */
            assert_at_most(error, d < 2 ? 0.7 * last : INFINITY);
            last = error;
            picture_free(&out);
        }
        picture_free(&want);
        scene_free(&s);
    }
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

static void small_blur_comes_smoothly(void **state)
{
    (void)state;
    enum { STEPS = 40 };
    for (int shape = 0; shape < 2; shape++) {
        scene s;
        scene_make(&s, 0);
        scene_fill_busy(&s, 2);
        dim(&s);
        s.params.samples = 64;
        s.params.blades = shape ? 6 : 0;
        picture_fill(&s.clip[WO_CLIP_DEPTH], (const float[1]){1});
        const double dioptres = 1 - 1 / s.params.focus_distance;
        wo_image last = {0};
        double steps[STEPS];
        for (int i = 0; i <= STEPS; i++) {
            scene_px_per_dioptre(&s, fmax(0.05 * i, 1e-3) / dioptres);
            wo_image out = scene_render(&s, NULL);
            if (i > 0)
                steps[i - 1] = picture_rms(&out, &last, frame);
            picture_free(&last);
            last = out;
        }
        picture_free(&last);
        qsort(steps, STEPS, sizeof steps[0], by_value);
        print_message("steps of 0.05 px: median %.6f, largest %.6f\n", steps[STEPS / 2],
                      steps[STEPS - 1]);
        assert_at_most(steps[STEPS - 1], 2 * steps[STEPS / 2]);
        assert_true(steps[0] > 0);
        scene_free(&s);
    }
}

/* Busy layers: near to rays, and nearer than a picture with another focus would be. */
static void near_to_rays(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; kind += 2) {
        scene s;
        scene_make(&s, kind);
        scene_px_per_dioptre(&s, 14);
        s.params.samples = 512;
        wo_image out = scene_render(&s, NULL);
        s.params.method = WO_METHOD_RAYS;
        wo_image want = scene_render(&s, NULL);
        const double error = picture_rms(&out, &want, frame);
        s.params.focus_distance *= 1.1;
        wo_image other = scene_render(&s, NULL);
        print_message("kind %d: RMSE %.5f, of another focus %.5f\n", kind, error,
                      picture_rms(&other, &want, frame));
        assert_at_most(error, picture_rms(&other, &want, frame));
        picture_free(&out);
        picture_free(&want);
        picture_free(&other);
        scene_free(&s);
    }
}

static void tiles_threads_and_masks_change_nothing(void **state)
{
    (void)state;
    rng r = {7};
    for (int kind = 0; kind < 4; kind++) {
        scene s;
        scene_make(&s, kind);
        wo_image whole = scene_render(&s, NULL);
        for (int n = 0; n < cases_of(10, 3); n++) {
            const unsigned threads = (unsigned)n % 4 + 1;
            wo_context context = WO_CONTEXT_INIT;
            context.runner = threads_runner(&threads);
            scene_check_window(&s, &context, n == 1 ? frame : random_window(&r, frame, 80, 60),
                               &whole);
        }
        /* Where the mask is 1 the picture is the same, whatever tiles were left out. */
        wo_image *const mask = scene_clip(&s, WO_CLIP_MASK, 1);
        const wo_rect lit = {60, 50, 75, 62};
        for (int32_t y = lit.y1; y < lit.y2; y++)
            for (int32_t x = lit.x1; x < lit.x2; x++)
                *wo_image_at(mask, x, y) = 1;
        wo_report report = {0};
        wo_image out = scene_render(&s, &report);
        assert_true(picture_same_bytes(&out, &whole, lit));
        picture_free(&out);
        picture_free(&whole);
        scene_free(&s);
    }
}

static void kernels_agree(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        scene s;
        scene_make(&s, kind);
        const wo_context base = {.cpu = WO_CPU_BASE};
        wo_image want = scene_render(&s, NULL);
        wo_image out = picture_make(frame, 4);
        assert_int_equal(scene_run(&s, &base, frame, &out, NULL, NULL), WO_OK);
        for (int32_t y = frame.y1; y < frame.y2; y++)
            for (int32_t x = frame.x1; x < frame.x2; x++)
                for (int k = 0; k < 4; k++)
                    assert_close((double)wo_image_at(&out, x, y)[k],
                                 (double)wo_image_at(&want, x, y)[k], 1e-3);
        picture_free(&want);
        picture_free(&out);
        scene_free(&s);
    }
}

/* Lenses with rays of their own: small aberrations are drawn as discs, large ones by rays. */
static void any_lens(void **state)
{
    (void)state;
    const int32_t lenses[] = {WO_LENS_THICK, WO_LENS_SINGLET, WO_LENS_PRESCRIPTION};
    for (size_t i = 0; i < WO_COUNT(lenses); i++) {
        scene s;
        scene_make(&s, 0);
        scene_px_per_dioptre(&s, 10);
        dim(&s);
        s.params.lens = lenses[i];
        s.params.cats_eye = 0.3;
        s.params.wavelengths = 1;
        s.params.samples = 256;
        wo_image out = scene_render(&s, NULL);
        s.params.method = WO_METHOD_RAYS;
        wo_image want = scene_render(&s, NULL);
        print_message("lens %d: RMSE %.5f\n", lenses[i], picture_rms(&out, &want, frame));
        assert_at_most(picture_rms(&out, &want, frame), 0.05);
        picture_free(&out);
        picture_free(&want);
        scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constant_stays_constant),
        cmocka_unit_test(opaque_stays_opaque),
        cmocka_unit_test(holes_stay_holes),
        cmocka_unit_test(focus_is_the_source),
        cmocka_unit_test(one_vergence_against_brute_force),
        cmocka_unit_test(small_blur_comes_smoothly),
        cmocka_unit_test(near_to_rays),
        cmocka_unit_test(tiles_threads_and_masks_change_nothing),
        cmocka_unit_test(kernels_agree),
        cmocka_unit_test(any_lens),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
