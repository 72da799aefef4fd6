/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Any design that comes with the library at any f-number, focal length, sensor, size and focus, by
   any method, on a scene with lamps behind near things: a finite picture, or an error that says
   why. WO_TEST_LENSES in the environment: how many combinations. */
#include "cases.h"
#include "defocus/renderer.h"
#include "near.h"
#include "optics/lens_choice.h"
#include "scenes.h"

#include <string.h>

static void lamps(scene *s, rng *r)
{
    wo_image *source = &s->clip[WO_CLIP_SOURCE];
    const wo_rect b = source->bounds;
    for (int i = 0; i < 12; i++) {
        const int32_t x = rng_int(r, 0, wo_rect_width(b) - 1);
        const int32_t y = rng_int(r, 0, wo_rect_height(b) - 1);
        float *pixel = wo_image_at(source, b.x1 + x, b.y1 + y);
        for (int k = 0; k < 3; k++)
            pixel[k] = (float)rng_range(r, 5, 2000);
    }
}

static void random_lens(scene *s, rng *r)
{
    wo_lens_blur_params *p = &s->params;
    static const double stops[] = {0.7, 1.4, 2, 2.8, 4, 5.6, 8};
    p->lens = rng_unit(r) < 0.9 ? WO_LENS_PRESCRIPTION : WO_LENS_SEIDEL;
    p->lens_design = rng_int(r, 0, WO_LENS_DESIGNS - 1);
    p->f_stop = stops[rng_int(r, 0, (int32_t)WO_COUNT(stops) - 1)];
    p->focal_length = exp(rng_range(r, log(8), log(300)));
    p->sensor_width = exp(rng_range(r, log(5), log(80)));
    p->focus_distance = exp(rng_range(r, log(0.5), log(50)));
    p->samples = rng_int(r, 1, 24);
    p->wavelengths = rng_int(r, 1, 6);
    p->best_focus = rng_int(r, 0, 1);
    p->method = rng_int(r, 0, WO_METHOD_COUNT - 1);
    p->max_radius = rng_range(r, 4, 60);
    p->breathing = rng_int(r, 0, 1);
    p->seed = rng_int(r, 0, 1000);
}

/* 1 when there is a picture. */
static int survives(const scene *s, int number)
{
    const wo_context context = WO_CONTEXT_INIT;
    wo_error error = {WO_OK, ""};
    wo_report report = {0};
    wo_image out = picture_make(s->geometry.extent, 4);
    const wo_status status = scene_run(s, &context, out.bounds, &out, &report, &error);
    const wo_lens_blur_params *p = &s->params;
    const bool good =
        status == WO_OK ? picture_finite(&out) : status == error.status && strlen(error.text) > 10;
    if (!good)
        fail_msg(
            "combination %d: %s at %g mm, f/%g, sensor %g mm, focus %g m, method %d: status %d, "
            "\"%s\"",
            number, wo_lens_design(p->lens_design), p->focal_length, p->f_stop, p->sensor_width,
            p->focus_distance, p->method, (int)status, error.text);
    picture_free(&out);
    return status == WO_OK;
}

static void any_lens_anywhere(void **state)
{
    (void)state;
    const char *wanted = getenv("WO_TEST_LENSES");
    const int count = wanted ? atoi(wanted) : cases_of(60, 12);
    int pictures = 0;
    for (int i = 0; i < count; i++) {
        rng r = {1000003u * (uint64_t)(i + 1)};
        scene s;
        scene_init(&s, (wo_rect){0, 0, rng_int(&r, 16, 96), rng_int(&r, 16, 64)});
        scene_fill_busy(&s, rng_bits(&r));
        lamps(&s, &r);
        random_lens(&s, &r);
        pictures += survives(&s, i);
        scene_free(&s);
    }
    print_message("%d of %d combinations gave a picture, the others an error\n", pictures, count);
    assert_true(pictures > count / 2);
}

/* As a user found it: 50 mm f/1.4 before a sensor of 50 mm, lamps in the corners, four rays. */
static void lamps_beyond_the_image_circle(void **state)
{
    (void)state;
    rng r = {7};
    scene s;
    scene_init(&s, (wo_rect){0, 0, 240, 135});
    scene_fill_busy(&s, 3);
    lamps(&s, &r);
    static const double sensors[] = {36, 50};
    for (size_t i = 0; i < WO_COUNT(sensors); i++) {
        random_lens(&s, &r);
        for (int k = 0; wo_lens_names[k]; k++)
            if (strcmp(wo_lens_names[k], "petzval_laikin_f14") == 0)
                s.params.lens_design = k;
        s.params.lens = WO_LENS_PRESCRIPTION;
        s.params.method = WO_METHOD_HYBRID;
        s.params.max_radius = 100;
        s.params.f_stop = 1.4;
        s.params.focal_length = 50;
        s.params.sensor_width = sensors[i];
        s.params.samples = 4;
        assert_int_equal(survives(&s, (int)i), 1);
    }
    scene_free(&s);
}

static bool warned(const scene *s, const char *key)
{
    wo_report report = {0};
    wo_image out = scene_render(s, &report);
    bool any = false;
    for (int i = 0; i < report.warning_count; i++)
        any |= strcmp(report.warnings[i].key, key) == 0;
    picture_free(&out);
    return any;
}

/* What shows in the picture is told: steps where rays are shared, lenses without a table. */
static void what_shows_is_told(void **state)
{
    (void)state;
    scene s;
    scene_init(&s, (wo_rect){0, 0, 160, 90});
    scene_fill_busy(&s, 3);
    s.params.samples = 4;
    s.params.wavelengths = 1;
    s.params.focal_length = 50;
    s.params.sensor_width = 36;
    s.params.f_stop = 1.4;
    assert_false(warned(&s, "lens-steps"));
    s.params.lens = WO_LENS_SINGLET;
    assert_true(warned(&s, "lens-steps"));
    s.params.f_stop = 11;
    assert_false(warned(&s, "lens-steps"));
    assert_false(warned(&s, "lens-table"));
    s.params.lens = WO_LENS_PRESCRIPTION;
    for (int k = 0; k < WO_LENS_DESIGNS; k++)
        if (strcmp(wo_lens_design((size_t)k), "asphere_edmund_54") == 0)
            s.params.lens_design = k;
    s.params.f_stop = 0.7;
    s.params.sensor_width = 50;
    assert_true(warned(&s, "lens-table"));
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_lens_anywhere),
        cmocka_unit_test(lamps_beyond_the_image_circle),
        cmocka_unit_test(what_shows_is_told),
    };
    return cmocka_run_group_tests_name("lens_random", tests, NULL, NULL);
}
