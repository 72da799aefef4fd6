/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "cases.h"
#include "near.h"
#include "scenes.h"

#include <stdio.h>
#include <string.h>

/* Parameters that nobody would choose: the picture is finite, or an error says what is wrong. */

static const wo_context plain = WO_CONTEXT_INIT;
static const wo_rect small = {-9, -5, 31, 22};

/* Values of a row that are legal, but on the brink. */
static double brink(const wo_param *row, rng *r)
{
    const double pick = rng_unit(r);
    if (pick < 0.25)
        return row->min;
    if (pick < 0.5)
        return row->max;
    if (row->type != WO_PARAM_DOUBLE)
        return rng_int(r, (int32_t)row->min, (int32_t)row->max);
    if (pick < 0.6 && row->min <= 0)
        return 0;
    /* Any order of magnitude. */
    const double top = fmax(fabs(row->min), fabs(row->max));
    const double value = top * pow(10, -rng_range(r, 0, rng_unit(r) < 0.2 ? 300 : 12));
    return fmin(fmax(rng_unit(r) < 0.5 ? -value : value, row->min), row->max);
}

static void set(scene *s, const wo_param *row, double value)
{
    const double values[3] = {value, value, value};
    wo_error error = {WO_OK, ""};
    /* Rays and large blur cost time, and nothing else. */
    if ((strcmp(row->key, "samples") == 0 || strcmp(row->key, "maxRays") == 0) && value > 40)
        return;
    if (strcmp(row->key, "maxRadius") == 0 && value > 150)
        return;
    if (wo_param_set(row, &s->params, values, &error) != WO_OK)
        fail_msg("%s", error.text);
}

static void describe(const scene *s)
{
    for (size_t i = 0; i < WO_LENS_BLUR_PARAMS; i++) {
        char text[64];
        wo_param_print(&wo_lens_blur_table[i], &s->params, text, sizeof text);
        print_error("  %s = %s\n", wo_lens_blur_table[i].key, text);
    }
}

/* 1 when there is a picture, 0 when there is an error. */
static int survives(const scene *s)
{
    wo_error error = {WO_OK, ""};
    wo_report report = {0};
    wo_image out = picture_make(s->geometry.extent, 4);
    const wo_status status = scene_run(s, &plain, out.bounds, &out, &report, &error);
    char json[8192];
    bool good =
        status == WO_OK ? picture_finite(&out) : status == error.status && strlen(error.text) > 10;
    good &= wo_report_json(&report, json, sizeof json) < (int)sizeof json;
    const wo_plan_args args = scene_args(s, out.bounds);
    wo_rect needed;
    /* What is wrong with a traced lens shows only when it is traced. */
    const wo_status region =
        wo_lens_blur.region(&s->params, &args.geometry, small, 0, &needed, NULL);
    good &= region == status || (region == WO_OK && wo_lens_blur_has_table(&s->params));
    const int identity = wo_lens_blur.identity(&s->params, &args.geometry);
    good &= identity == -1 || (identity == WO_CLIP_SOURCE && status == WO_OK);
    if (!good) {
        print_error("status %d, \"%s\"\n", (int)status, error.text);
        describe(s);
        fail();
    }
    picture_free(&out);
    return status == WO_OK;
}

static scene start(uint64_t seed)
{
    scene s;
    scene_init(&s, small);
    scene_fill_layers(&s, seed);
    s.params.samples = 9;
    s.params.max_rays = 40;
    s.params.max_radius = 40;
    return s;
}

/* Metadata of somebody's file; each value may be there, and be of any size. */
static void name_camera(scene *s, rng *r)
{
    static const char *const names[] = {
        "wideopen:focalLength",   "wideopen:sensorWidth", "wideopen:fStop", "cameraFov",
        "wideopen:focusDistance", "wideopen:near",        "cameraFarClip",  "wideopen:depthScale"};
    for (size_t i = 0; i < WO_COUNT(names); i++) {
        char text[40];
        const double value = pow(10, rng_range(r, -10, 10));
        snprintf(text, sizeof text, "%g", rng_unit(r) < 0.1 ? -value : value);
        if (rng_unit(r) < 0.5)
            wo_camera_read(&s->geometry.camera, names[i], text);
    }
    s->params.camera_from = rng_int(r, 1, 4);
}

static void each_end_of_each_range(void **state)
{
    (void)state;
    for (size_t i = 0; i < WO_LENS_BLUR_PARAMS; i++) {
        const wo_param *const row = &wo_lens_blur_table[i];
        for (int top = 0; top < 2; top++) {
            /* Where cases are few, one end with breathing and one without. */
            const int ways = cases_of(2, 1);
            for (int way = 0; way < ways; way++) {
                const int breathing = (way + top) & 1;
                scene s = start(i);
                s.params.breathing = breathing;
                set(&s, row, top ? row->max : row->min);
                const bool may_fail = s.params.breathing != 0;
                if (!survives(&s) && !may_fail) {
                    describe(&s);
                    fail();
                }
                scene_free(&s);
            }
        }
    }
}

static void random_combinations(void **state)
{
    (void)state;
    rng r = {2024};
    int pictures = 0;
    const int count = cases_of(300, 100);
    for (int n = 0; n < count; n++) {
        scene s = start(rng_bits(&r));
        const int changes = rng_int(&r, 1, WO_LENS_BLUR_PARAMS);
        for (int i = 0; i < changes; i++) {
            const wo_param *const row =
                &wo_lens_blur_table[rng_int(&r, 0, WO_LENS_BLUR_PARAMS - 1)];
            set(&s, row, brink(row, &r));
        }
        if (rng_unit(&r) < 0.3)
            s.geometry.render_scale = pow(2, rng_int(&r, -5, 1));
        if (rng_unit(&r) < 0.3)
            s.geometry.pixel_stretch = pow(2, rng_range(&r, -2, 2));
        if (rng_unit(&r) < 0.2)
            name_camera(&s, &r);
        pictures += survives(&s);
        scene_free(&s);
    }
    /* Most of them are pictures. */
    assert_true(pictures > count * 19 / 30);
    assert_true(pictures < count);
}

/* Numbers outside the ranges never reach the renderer. */
static void beyond_the_ranges(void **state)
{
    (void)state;
    for (size_t i = 0; i < WO_LENS_BLUR_PARAMS; i++) {
        const wo_param *const row = &wo_lens_blur_table[i];
        const double wrong[] = {NAN, INFINITY, -INFINITY, row->max * 1.001 + 1e-6,
                                row->min - 1e-6 - fabs(row->min) * 0.001};
        for (size_t k = 0; k < WO_COUNT(wrong); k++) {
            scene s = start(i);
            char *const field = (char *)&s.params + row->offset;
            if (row->type == WO_PARAM_DOUBLE || row->type == WO_PARAM_POINT) {
                memcpy(field, &wrong[k], sizeof wrong[k]);
            } else {
                const int32_t outside = (int32_t)(k % 2 ? row->max + 1 : row->min - 1);
                memcpy(field, &outside, sizeof outside);
            }
            wo_error error = {WO_OK, ""};
            wo_image out = picture_make(small, 4);
            const wo_status status = scene_run(&s, &plain, small, &out, NULL, &error);
            if (status != WO_ERR_RANGE || !strstr(error.text, row->key)) {
                print_error("%s: status %d, \"%s\"\n", row->key, (int)status, error.text);
                fail();
            }
            picture_free(&out);
            scene_free(&s);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_end_of_each_range),
        cmocka_unit_test(random_combinations),
        cmocka_unit_test(beyond_the_ranges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
