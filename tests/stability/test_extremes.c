/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "near.h"
#include "scenes.h"

#include <float.h>
#include <string.h>

static const wo_context plain = WO_CONTEXT_INIT;

/* A scene that must come out whole and finite; returns what it was like. */
static wo_report finite(const scene *s)
{
    wo_report report = {0};
    wo_image out = scene_render(s, &report);
    assert_true(picture_finite(&out));
    for (int32_t y = out.bounds.y1; y < out.bounds.y2; y++)
        for (int32_t x = out.bounds.x1; x < out.bounds.x2; x++) {
            const float a = wo_image_at(&out, x, y)[3];
            assert_true(a >= 0 && a <= 1.000001f);
        }
    assert_true(report.guessed >= 0 && report.guessed <= 1.000001);
    picture_free(&out);
    return report;
}

static wo_status refused(const scene *s, const char *word)
{
    wo_error error = {WO_OK, ""};
    wo_image out = picture_make((wo_rect){0, 0, 8, 8}, 4);
    const wo_status status = scene_run(s, &plain, out.bounds, &out, NULL, &error);
    if (status == WO_OK || !strstr(error.text, word))
        print_error("status %d, \"%s\" without \"%s\"\n", (int)status, error.text, word);
    assert_int_not_equal(status, WO_OK);
    assert_int_equal(error.status, status);
    assert_non_null(strstr(error.text, word));
    picture_free(&out);
    return status;
}

static scene busy(wo_rect extent)
{
    scene s;
    scene_init(&s, extent);
    scene_fill_layers(&s, 5);
    s.params.samples = 16;
    s.params.max_radius = 40; /* to plan for 100 px around it would cost most of the time */
    return s;
}

static const wo_rect small = {0, 0, 70, 50};

static void depths_that_are_none(void **state)
{
    (void)state;
    const float bad[] = {NAN, INFINITY, -INFINITY, 0,       -0.0f,
                         -3,  -FLT_MAX, FLT_MAX,   FLT_MIN, 1e-45f};
    rng r = {1};
    for (size_t i = 0; i <= WO_COUNT(bad); i++) {
        for (int mode = 0; mode < WO_DEPTH_MODE_COUNT; mode++) {
            scene s = busy(small);
            s.params.depth_mode = mode;
            for (int32_t n = 0; n < 70 * 50; n++) {
                /* Everywhere, here and there, or all of them mixed. */
                const size_t which = i < WO_COUNT(bad) ? i : (size_t)rng_int(&r, 0, 9);
                if (mode % 2 == 0 || rng_unit(&r) < 0.4)
                    s.clip[WO_CLIP_DEPTH].data[n] = bad[which];
            }
            const wo_report report = finite(&s);
            if (mode == WO_DEPTH_DISTANCE && i < 7)
                assert_true(report.sanitised_depth > 2000);
            scene_free(&s);
        }
    }
}

/* Where every depth is bad, everything is infinitely far. */
static void no_depth_is_infinity(void **state)
{
    (void)state;
    scene s;
    scene_init(&s, small);
    scene_fill_busy(&s, 3);
    scene_px_per_dioptre(&s, 10);
    picture_fill(&s.clip[WO_CLIP_DEPTH], (const float[1]){NAN});
    wo_image bad = scene_render(&s, NULL);
    picture_free(&s.clip[WO_CLIP_DEPTH]);
    wo_report report = {0};
    wo_image missing = scene_render(&s, &report);
    assert_near(picture_difference(&bad, &missing, small), 0, 1e-5);
    assert_true(report.largest_radius > 1);
    assert_int_equal(report.sanitised_depth, 0);
    /* ... and in focus when the lens is. */
    s.params.focus_distance = 0;
    wo_image sharp = scene_render(&s, NULL);
    assert_true(picture_same_bytes(&sharp, &s.clip[WO_CLIP_SOURCE], small));
    picture_free(&bad);
    picture_free(&missing);
    picture_free(&sharp);
    scene_free(&s);
}

static void lenses(void **state)
{
    (void)state;
    const double stops[] = {0.5, 0.01, 1e6};
    const double focus[] = {0, -1, -1e-9, -1e-60, 1e9, -1e9, 3, 0.01, 1e-9, 1e-300};
    for (size_t i = 0; i < WO_COUNT(stops); i++)
        for (size_t k = 0; k < 2 * WO_COUNT(focus); k++) {
            scene s = busy(small);
            s.params.f_stop = stops[i];
            s.params.focus_distance = focus[k / 2];
            s.params.breathing = k % 2;
            if (k % 2 && focus[k / 2] > 0 && focus[k / 2] < 0.05) {
                assert_int_equal(refused(&s, "focal length"), WO_ERR_RANGE);
            } else {
                const wo_report report = finite(&s);
                assert_true(report.largest_radius <= s.params.max_radius + 1e-3);
                if (i == 1 && k % 2 == 0)
                    assert_true(report.clamped_radius > 0);
            }
            scene_free(&s);
        }
}

static void sizes(void **state)
{
    (void)state;
    const wo_rect extents[] = {{0, 0, 1, 1},
                               {-5, -7, -4, -6},
                               {0, 0, 8192, 64},
                               {0, 0, 3, 5000},
                               {0, 0, 2, 1},
                               {-4100, 17, -4000, 18},
                               {1 << 23, 0, (1 << 23) + 40, 9}};
    for (size_t i = 0; i < WO_COUNT(extents); i++) {
        scene s = busy(extents[i]);
        s.params.samples = i == 2 ? 2 : 16;
        s.params.f_stop = 0.5;
        finite(&s);
        scene_free(&s);
    }
}

static void one_pixel_is_its_colour(void **state)
{
    (void)state;
    scene s;
    scene_init(&s, (wo_rect){4, 4, 5, 5});
    s.params.focal_length = 1000;
    s.params.f_stop = 0.05;
    picture_fill(scene_clip(&s, WO_CLIP_SOURCE, 4), (const float[4]){0.3f, 0.6f, 0.9f, 1});
    picture_fill(scene_clip(&s, WO_CLIP_DEPTH, 1), (const float[1]){1});
    wo_image out = scene_render(&s, NULL);
    assert_near(picture_difference(&out, &s.clip[WO_CLIP_SOURCE], out.bounds), 0, 1e-6);
    picture_free(&out);
    scene_free(&s);
}

static void clips_that_are_missing(void **state)
{
    (void)state;
    scene s = busy(small);
    picture_free(&s.clip[WO_CLIP_DEPTH]);
    finite(&s);
    picture_free(&s.clip[3]);
    finite(&s);
    scene_clip(&s, WO_CLIP_DEPTH, 1);
    picture_free(&s.clip[WO_CLIP_SOURCE]);
    assert_int_equal(refused(&s, "Source"), WO_ERR_ARGUMENT);
    scene_free(&s);
}

static void empty_layers(void **state)
{
    (void)state;
    const float nothing[4] = {0, 0, 0, 0};
    scene s = busy(small);
    picture_fill(&s.clip[2], nothing);
    finite(&s);
    picture_fill(&s.clip[WO_CLIP_SOURCE], nothing);
    wo_report report = {0};
    wo_image out = scene_render(&s, &report);
    for (int32_t i = 0; i < 70 * 50 * 4; i++)
        assert_true(out.data[i] == 0);
    assert_int_equal(report.rays, 0);
    assert_true(report.tiles[WO_TILE_EMPTY] > 0);
    assert_int_equal(report.tiles[WO_TILE_MARCH], 0);
    /* Light without coverage. */
    picture_fill(&s.clip[WO_CLIP_SOURCE], (const float[4]){1, 2, 3, 0});
    finite(&s);
    picture_free(&out);
    scene_free(&s);
}

static void colours(void **state)
{
    (void)state;
    const float values[] = {1e30f, -1e30f, -1, FLT_MAX, -FLT_MAX, NAN, INFINITY, -INFINITY, 1e-45f};
    rng r = {3};
    for (size_t i = 0; i <= WO_COUNT(values); i++) {
        for (int alpha = 0; alpha < 3; alpha++) {
            scene s = busy(small);
            s.alpha[WO_CLIP_SOURCE] = (wo_alpha)alpha;
            s.params.samples = i % 3 ? 16 : 200;
            for (int32_t n = 0; n < 70 * 50 * 4; n++) {
                const size_t which =
                    i < WO_COUNT(values) ? i : (size_t)rng_int(&r, 0, WO_COUNT(values) - 1);
                if (alpha == 2 || rng_unit(&r) < 0.3)
                    s.clip[WO_CLIP_SOURCE].data[n] = values[which];
            }
            finite(&s);
            scene_free(&s);
        }
    }
}

/* Lights of several depths with as much blur as there can be. */
static void lights_with_the_largest_blur(void **state)
{
    (void)state;
    scene s = busy((wo_rect){0, 0, 100, 40});
    s.params.max_radius = 2048;
    s.params.samples = 2;
    s.params.focal_length = 100;
    scene_px_per_dioptre(&s, 900);
    for (int32_t i = 0; i < 4; i++) {
        s.clip[WO_CLIP_SOURCE].data[4 * 999 * i] = 1000;
        s.clip[WO_CLIP_DEPTH].data[999 * i] = 0.4f + 0.3f * (float)i;
    }
    finite(&s);
    scene_free(&s);
}

static void frames_and_windows(void **state)
{
    (void)state;
    scene s = busy((wo_rect){-60, -41, 75, 22});
    s.geometry.format = (wo_rect){0, 0, 40, 20}; /* the picture is larger than the camera's frame */
    finite(&s);
    s.geometry.format = (wo_rect){-500, -500, 500, 500};
    finite(&s);
    s.geometry.pixel_stretch = 2;
    s.geometry.render_scale = 0.25;
    finite(&s);
    /* Nothing of the window exists: zero. */
    const wo_rect away = {200, 200, 240, 230};
    wo_image out = picture_make(away, 4);
    picture_fill(&out, (const float[4]){9, 9, 9, 9});
    wo_report report = {0};
    assert_int_equal(scene_run(&s, &plain, away, &out, &report, NULL), WO_OK);
    for (int32_t i = 0; i < 40 * 30 * 4; i++)
        assert_true(out.data[i] == 0);
    /* A window that the output cannot hold. */
    wo_error error = {WO_OK, ""};
    assert_int_equal(scene_run(&s, &plain, (wo_rect){200, 200, 241, 230}, &out, NULL, &error),
                     WO_ERR_ARGUMENT);
    assert_true(error.text[0] != 0);
    assert_int_equal(scene_run(&s, &plain, (wo_rect){0}, &out, NULL, &error), WO_ERR_ARGUMENT);
    picture_free(&out);
    scene_free(&s);
}

/* Hosts ask with windows as large as numbers go. */
static void endless_windows(void **state)
{
    (void)state;
    scene s = busy(small);
    const wo_rect endless = {INT32_MIN, INT32_MIN, INT32_MAX, INT32_MAX};
    const wo_rect corner = {INT32_MAX - 10, INT32_MAX - 10, INT32_MAX, INT32_MAX};
    const wo_rect windows[] = {endless, corner, {INT32_MIN, 0, INT32_MIN + 5, 5}};
    for (size_t i = 0; i < WO_COUNT(windows); i++) {
        const wo_plan_args args = scene_args(&s, windows[i]);
        wo_rect needed;
        assert_int_equal(wo_lens_blur.region(&s.params, &args.geometry, windows[i], WO_CLIP_SOURCE,
                                             &needed, NULL),
                         WO_OK);
        assert_true(wo_rect_contains(needed, wo_rect_intersect(windows[i], small)));
        wo_plan *plan = NULL;
        assert_int_equal(wo_lens_blur.plan_create(&plain, &s.params, &args, &plan, NULL), WO_OK);
        wo_lens_blur.plan_destroy(&plan);
    }
    /* An extent out there is refused. */
    s.geometry.extent = corner;
    wo_plan_args args = scene_args(&s, corner);
    wo_plan *plan = NULL;
    wo_error error = {WO_OK, ""};
    assert_int_equal(wo_lens_blur.plan_create(&plain, &s.params, &args, &plan, &error),
                     WO_ERR_RANGE);
    assert_null(plan);
    scene_free(&s);
}

static void geometries_that_are_none(void **state)
{
    (void)state;
    scene s = busy(small);
    const scene good = s;
    s.geometry.format = (wo_rect){0};
    refused(&s, "empty");
    s = good;
    s.geometry.extent = (wo_rect){5, 5, 5, 9};
    refused(&s, "empty");
    s = good;
    const double bad[] = {0, -1, NAN, INFINITY, 1e9};
    for (size_t i = 0; i < WO_COUNT(bad); i++) {
        s = good;
        s.geometry.render_scale = bad[i];
        refused(&s, "scale");
        s = good;
        s.geometry.pixel_stretch = bad[i];
        refused(&s, "stretch");
    }
    s = good;
    s.geometry.extent.x2 = 100000;
    refused(&s, "100000");
    s = good;
    s.clip[WO_CLIP_DEPTH].components = 2;
    refused(&s, "Depth");
    s = good;
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(depths_that_are_none),
        cmocka_unit_test(no_depth_is_infinity),
        cmocka_unit_test(lenses),
        cmocka_unit_test(sizes),
        cmocka_unit_test(one_pixel_is_its_colour),
        cmocka_unit_test(clips_that_are_missing),
        cmocka_unit_test(empty_layers),
        cmocka_unit_test(colours),
        cmocka_unit_test(lights_with_the_largest_blur),
        cmocka_unit_test(frames_and_windows),
        cmocka_unit_test(endless_windows),
        cmocka_unit_test(geometries_that_are_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
