/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "cases.h"
#include "near.h"
#include "scenes.h"

#include <string.h>

static const wo_rect frame = {-21, 9, 140, 105};

static void scene_make_in(scene *s, int kind, wo_rect extent)
{
    scene_init(s, extent);
    scene_px_per_dioptre(s, kind % 2 ? 14 : 45);
    s->params.samples = 12;
    if (kind % 2) /* a window needs only a part of the picture */
        s->params.max_radius = 7;
    s->params.blades = kind % 2 ? 6 : 0;
    s->params.seed = kind;
    if (kind < 2)
        scene_fill_busy(s, (uint64_t)kind);
    else
        scene_fill_layers(s, (uint64_t)kind);
    /* An area of light beside single lights: many of its tiles are crowded, some are not. */
    for (int32_t y = 20; y < 80 && kind == 1; y++)
        for (int32_t x = 30; x < 130 - y / 2; x++)
            wo_image_at(&s->clip[WO_CLIP_SOURCE], x, y)[y & 1] = 25;
    /* A clean plate: without depth, and with one. */
    wo_image *const plate = kind == 1 || kind == 2 ? scene_clip(s, WO_CLIP_BACKGROUND, 4) : NULL;
    wo_image *const plate_depth = kind == 2 ? scene_clip(s, WO_CLIP_BACKGROUND_DEPTH, 1) : NULL;
    for (int32_t y = extent.y1; plate && y < extent.y2; y++)
        for (int32_t x = extent.x1; x < extent.x2; x++) {
            const float level = 0.02f * (float)((x + 3 * y) & 31);
            const float c[4] = {level, 0.3f, 0.8f - level, 1};
            memcpy(wo_image_at(plate, x, y), c, sizeof c);
            if (plate_depth)
                *wo_image_at(plate_depth, x, y) = 6 + 0.02f * (float)(y & 63);
        }
    if (kind != 3)
        return;
    wo_image *const mask = scene_clip(s, WO_CLIP_MASK, 1);
    for (int32_t y = extent.y1; y < extent.y2; y++)
        for (int32_t x = extent.x1; x < extent.x2; x++)
            *wo_image_at(mask, x, y) = fminf(fmaxf(0.02f * (float)(x - 40), 0), 1);
}

static void scene_make(scene *s, int kind)
{
    scene_make_in(s, kind, frame);
}

static void tiles_are_the_whole(void **state)
{
    (void)state;
    const wo_context context = WO_CONTEXT_INIT;
    rng r = {7};
    for (int kind = 0; kind < 4; kind++) {
        scene s;
        scene_make(&s, kind);
        wo_image whole = scene_render(&s, NULL);
        for (int n = 0; n < cases_of(24, 6); n++) {
            wo_rect window = random_window(&r, frame, 50, 40);
            if (n % 3 == 0) { /* large ones, over the border, too */
                window.x2 = rng_int(&r, window.x1 + 1, frame.x2 + 20);
                window.y2 = rng_int(&r, window.y1 + 1, frame.y2 + 20);
            }
            scene_check_window(&s, &context, window, &whole);
        }
        picture_free(&whole);
        scene_free(&s);
    }
}

/* Narrow windows far from each other's sight, on a picture so long that each needs but a part of
   it: what lies hidden behind wide objects is the same all over. */
static void parts_of_a_long_picture(void **state)
{
    (void)state;
    const wo_context context = WO_CONTEXT_INIT;
    const wo_rect extent = {-100, 0, 900, 24};
    rng r = {17};
    for (int kind = 0; kind < 3; kind += 2) {
        scene s;
        scene_make_in(&s, kind, extent);
        /* Posts with 20 px of blur in front of the focus, what is behind them with some 30 px: rays
           past an edge see deep behind the post. */
        s.params.max_radius = 32;
        s.params.focus_distance = 1 / 1.28;
        scene_px_per_dioptre(&s, 28);
        for (int32_t x = extent.x1; x < extent.x2;) {
            for (int32_t end = x + rng_int(&r, 60, 120); x < end && x < extent.x2; x++)
                for (int32_t y = 0; y < 24; y++)
                    *wo_image_at(&s.clip[WO_CLIP_DEPTH], x, y) = 0.5f;
            x += rng_int(&r, 30, 60);
        }
        wo_image whole = scene_render(&s, NULL);
        for (int n = 0; n < cases_of(40, 12); n++) {
            const int32_t x = rng_int(&r, extent.x1, extent.x2 - 30);
            const wo_rect window = {x, 3, x + rng_int(&r, 1, 30), 20};
            wo_image out = picture_make(window, 4);
            assert_int_equal(scene_run(&s, &context, window, &out, NULL, NULL), WO_OK);
            assert_true(picture_same_bytes(&out, &whole, window));
            picture_free(&out);
        }
        picture_free(&whole);
        scene_free(&s);
    }
}

/* Several windows out of one plan, and more than once. */
static void windows_of_one_plan(void **state)
{
    (void)state;
    const wo_context context = WO_CONTEXT_INIT;
    scene s;
    scene_make(&s, 2);
    wo_image whole = scene_render(&s, NULL);
    const wo_plan_args args = scene_args(&s, frame);
    wo_plan *plan = NULL;
    assert_int_equal(wo_lens_blur.plan_create(&context, &s.params, &args, &plan, NULL), WO_OK);
    wo_image out = picture_make(frame, 4);
    rng r = {2};
    for (int n = 0; n < cases_of(20, 6); n++) {
        wo_rect window = {rng_int(&r, frame.x1, frame.x2 - 1), rng_int(&r, frame.y1, frame.y2 - 1),
                          0, 0};
        window.x2 = rng_int(&r, window.x1 + 1, frame.x2);
        window.y2 = rng_int(&r, window.y1 + 1, frame.y2);
        picture_fill(&out, (const float[4]){-7, -7, -7, -7});
        assert_int_equal(wo_lens_blur.render(plan, window, &out, NULL, NULL), WO_OK);
        assert_true(picture_same_bytes(&out, &whole, window));
        /* Nothing outside the window is touched. */
        for (int32_t y = frame.y1; y < frame.y2; y++)
            for (int32_t x = frame.x1; x < frame.x2; x++)
                if (!wo_rect_contains(window, (wo_rect){x, y, x + 1, y + 1}))
                    assert_true(wo_image_at(&out, x, y)[0] == -7);
    }
    wo_lens_blur.plan_destroy(&plan);
    assert_null(plan);
    picture_free(&out);
    picture_free(&whole);
    scene_free(&s);
}

static void threads_change_nothing(void **state)
{
    (void)state;
    const unsigned counts[] = {7, 2, 4, 1};
    for (int kind = 0; kind < 4; kind++) {
        scene s;
        scene_make(&s, kind);
        wo_report alone = {0};
        wo_image want = scene_render(&s, &alone);
        for (size_t i = 0; i < (size_t)cases_of(WO_COUNT(counts), 2); i++) {
            wo_context context = WO_CONTEXT_INIT;
            context.runner = threads_runner(&counts[i]);
            assert_int_equal(wo_workers(&context), counts[i]);
            wo_report report = {0};
            wo_image out = picture_make(frame, 4);
            assert_int_equal(scene_run(&s, &context, frame, &out, &report, NULL), WO_OK);
            assert_true(picture_same_bytes(&out, &want, frame));
            memcpy(report.seconds, alone.seconds, sizeof report.seconds);
            assert_memory_equal(&report, &alone, sizeof report);
            picture_free(&out);
        }
        picture_free(&want);
        scene_free(&s);
    }
}

/* Rows from the bottom or from the top, with room between them. */
static void rows_may_lie_anyhow(void **state)
{
    (void)state;
    const wo_context context = WO_CONTEXT_INIT;
    for (int kind = 0; kind < 4; kind++) {
        scene s;
        scene_make(&s, kind);
        wo_image want = scene_render(&s, NULL);
        for (int way = 0; way < 4; way++) {
            const bool down = way & 1;
            const int32_t pad = way & 2 ? 5 : 0;
            scene other = s;
            for (int i = 0; i < WO_LENS_BLUR_CLIPS; i++)
                if (s.clip[i].data)
                    other.clip[i] = picture_relaid(&s.clip[i], pad, down);
            wo_image out = picture_relaid(&want, pad, !down);
            picture_fill(&out, (const float[4]){-1, -1, -1, -1});
            assert_int_equal(scene_run(&other, &context, frame, &out, NULL, NULL), WO_OK);
            assert_true(picture_same_bytes(&out, &want, frame));
            /* The room between the rows of the output stays what it was: NaN. */
            for (int32_t y = frame.y1; y < frame.y2 && pad; y++)
                for (int32_t i = 0; i < pad; i++)
                    assert_true(isnan(wo_image_at(&out, frame.x2, y)[i]));
            picture_free_relaid(&out, !down);
            for (int i = 0; i < WO_LENS_BLUR_CLIPS; i++)
                if (other.clip[i].data)
                    picture_free_relaid(&other.clip[i], down);
        }
        picture_free(&want);
        scene_free(&s);
    }
}

/* Two machines may round differently, but not by more than a few hits on the border of patches. */
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
        int64_t different = 0;
        for (int32_t y = frame.y1; y < frame.y2; y++)
            for (int32_t x = frame.x1; x < frame.x2; x++)
                for (int k = 0; k < 4; k++) {
                    const double a = (double)wo_image_at(&out, x, y)[k];
                    const double b = (double)wo_image_at(&want, x, y)[k];
                    different += !(fabs(a - b) <= 1e-4 * fmax(1, fabs(b)));
                }
        assert_at_most((double)different, 1e-4 * 4 * 161 * 96);
        picture_free(&want);
        picture_free(&out);
        scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tiles_are_the_whole), cmocka_unit_test(parts_of_a_long_picture),
        cmocka_unit_test(windows_of_one_plan), cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(rows_may_lie_anyhow), cmocka_unit_test(kernels_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
