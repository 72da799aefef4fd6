/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "host_fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const wo_rect whole = {0, 0, 0, 0};

/* A host, an instance of Good and a picture; torn down with no violations left. */
typedef struct set {
    wo_host *host;
    wo_host_instance *instance;
    wo_host_still source, mask;
} set;

static set set_up(const char *context, unsigned threads, bool strict, unsigned layout)
{
    set s = {.host = fixture_host("good", threads, strict, layout)};
    s.instance = fixture_instance(s.host, "Good", context);
    s.source.image = fixture_picture((wo_rect){-3, 2, 37, 32}, 4, 7);
    s.mask.image = fixture_picture((wo_rect){5, 5, 30, 25}, 1, 8);
    return s;
}

static void tear_down(set *s)
{
    wo_host_instance_destroy(&s->instance);
    fixture_no_violations(s->host);
    wo_host_destroy(&s->host);
    assert_null(s->host);
    free(s->source.image.data);
    free(s->mask.image.data);
}

static void set_text(set *s, const char *name, const char *text)
{
    ok(wo_host_param_set_text(s->instance, name, text, &ok_error));
}

/* Inversion is exact: 1 - x. */
static void pixels_are_right(void **state)
{
    (void)state;
    set s = set_up("Filter", 2, true, WO_HOST_NEGATIVE_ROWS | WO_HOST_PADDED_ROWS);
    wo_host_render_result result;
    fixture_connect(s.instance, "Source", &s.source);
    set_text(&s, "invert", "on");
    wo_image image = fixture_render(s.instance, 1, 1, whole, 0, &result);
    assert_true(wo_rect_equal(image.bounds, s.source.image.bounds));
    assert_int_equal(result.tiles, 1);
    assert_false(result.identity);
    assert_true(result.input_pixels == 40 * 30);
    for (int32_t y = image.bounds.y1; y < image.bounds.y2; y++)
        for (int32_t x = image.bounds.x1; x < image.bounds.x2; x++)
            for (int c = 0; c < 4; c++) {
                const float in = wo_image_at(&s.source.image, x, y)[c];
                assert_true(wo_image_at(&image, x, y)[c] == (c < 3 ? 1 - in : in));
            }
    wo_host_image_free(&image);
    assert_null(image.data);
    tear_down(&s);
}

/* Tiles, threads, strictness and layouts change nothing, at any scale. */
static void whole_equals_parts(void **state)
{
    static const double scales[] = {1, 0.5, 0.25, 1.0 / 3};
    static const unsigned layouts[] = {0, WO_HOST_NEGATIVE_ROWS, WO_HOST_PADDED_ROWS,
                                       WO_HOST_NEGATIVE_ROWS | WO_HOST_PADDED_ROWS |
                                           WO_HOST_LARGER_IMAGES};
    (void)state;
    for (size_t k = 0; k < WO_COUNT(scales); k++) {
        wo_image reference = {0};
        for (size_t i = 0; i < WO_COUNT(layouts); i++) {
            for (int strict = 0; strict < 2; strict++) {
                set s = set_up("General", 1 + 2 * (unsigned)strict, strict, layouts[i]);
                wo_host_render_result result;
                fixture_connect(s.instance, "Source", &s.source);
                fixture_connect(s.instance, "Mask", &s.mask);
                set_text(&s, "radius", "4");
                set_text(&s, "gain", "1.5");
                wo_image image = fixture_render(s.instance, 1, scales[k], whole, 0, &result);
                wo_image tiles = fixture_render(s.instance, 1, scales[k], whole, 7, &result);
                assert_true(result.tiles > 1);
                fixture_same(&image, &tiles);
                if (!reference.data)
                    reference = image;
                else
                    fixture_same(&reference, &image);
                if (image.data != reference.data)
                    wo_host_image_free(&image);
                wo_host_image_free(&tiles);
                tear_down(&s);
            }
        }
        assert_int_equal(wo_rect_width(reference.bounds), /* -7 to 41 */
                         (int)ceil(41 * scales[k]) - (int)floor(-7 * scales[k]));
        wo_host_image_free(&reference);
    }
}

static void identity_is_a_copy(void **state)
{
    (void)state;
    set s = set_up("Filter", 1, true, 0);
    wo_host_render_result result;
    fixture_connect(s.instance, "Source", &s.source);
    wo_image image = fixture_render(s.instance, 1, 1, whole, 5, &result);
    assert_true(result.identity);
    assert_string_equal(result.identity_clip, "Source");
    assert_int_equal(result.tiles, 0);
    fixture_same(&image, &s.source.image);
    wo_host_image_free(&image);
    tear_down(&s);
}

/* A window inside a bigger view: pixels outside of the window stay, those without picture are
 * black. */
static void windows(void **state)
{
    (void)state;
    for (int strict = 0; strict < 2; strict++) {
        set s = set_up("Filter", 1, strict, 0);
        wo_host_render_result result;
        wo_error error = {0};
        fixture_connect(s.instance, "Source", &s.source);
        set_text(&s, "gain", "2");
        wo_image view = fixture_picture((wo_rect){-10, -10, 60, 60}, 4, 3);
        wo_image before = fixture_picture((wo_rect){-10, -10, 60, 60}, 4, 3);
        wo_host_render_args args = WO_HOST_RENDER_INIT;
        args.time = 1;
        args.window = (wo_rect){-8, 20, 10, 40};
        ok(wo_host_render(s.instance, &args, &view, &result, &ok_error));
        for (int32_t y = -10; y < 60; y++) {
            for (int32_t x = -10; x < 60; x++) {
                const bool in = x >= -8 && x < 10 && y >= 20 && y < 40;
                const bool picture = x >= -3 && x < 37 && y >= 2 && y < 32;
                for (int c = 0; c < 4; c++) {
                    const float is = wo_image_at(&view, x, y)[c];
                    const float was = wo_image_at(&before, x, y)[c];
                    const float twice = picture ? 2 * wo_image_at(&s.source.image, x, y)[c] : 0;
                    assert_true(is == (in ? twice : was));
                }
            }
        }
        args.window = (wo_rect){-20, 0, 5, 5}; /* not inside the view */
        assert_int_equal(wo_host_render(s.instance, &args, &view, &result, &error),
                         WO_ERR_ARGUMENT);
        wo_image wrong = {
            .data = view.data, .bounds = {0, 0, 4, 4}, .row_bytes = 48, .components = 3};
        args.window = (wo_rect){0, 0, 4, 4};
        assert_int_equal(wo_host_render(s.instance, &args, &wrong, &result, &error),
                         WO_ERR_ARGUMENT);
        args.window = (wo_rect){1000, 1000, 1010, 1010}; /* nothing there */
        wo_image black = {0};
        ok(wo_host_render(s.instance, &args, &black, &result, &ok_error));
        for (int i = 0; i < 400; i++)
            assert_true(black.data[i] == 0);
        wo_host_image_free(&black);
        free(view.data);
        free(before.data);
        tear_down(&s);
    }
}

static void animation_is_followed(void **state)
{
    (void)state;
    set s = set_up("Filter", 2, true, 0);
    fixture_connect(s.instance, "Source", &s.source);
    set_text(&s, "gain", "key@1:2,key@11:4");
    set_text(&s, "invert", "@1:false,@6:true");
    for (int time = 1; time <= 11; time += 5) {
        wo_image image = fixture_render(s.instance, time, 1, whole, 0, NULL);
        const float gain = time == 1 ? 2 : time == 6 ? 3 : 4;
        const float in = wo_image_at(&s.source.image, 4, 5)[1];
        const float is = wo_image_at(&image, 4, 5)[1];
        assert_float_equal(is, time == 1 ? gain * in : 1 - gain * in, 1e-6);
        wo_host_image_free(&image);
    }
    tear_down(&s);
}

static void components_follow_preferences(void **state)
{
    (void)state;
    set s = set_up("General", 1, true, 0);
    const wo_host_preferences *p = NULL;
    wo_error error = {0};
    assert_int_equal(wo_host_get_preferences(s.instance, &p, &error), WO_ERR_ARGUMENT);
    assert_non_null(strstr(error.text, "Source"));
    fixture_connect(s.instance, "Source", &s.source);
    ok(wo_host_get_preferences(s.instance, &p, &ok_error));
    assert_int_equal(p->clip_count, 3);
    assert_int_equal(p->clips[0].components, 4);
    assert_int_equal(p->clips[2].components, 4);
    assert_int_equal(p->alpha, WO_HOST_PREMULTIPLIED);
    assert_int_equal(p->clips[0].colourspace_count, 1);
    assert_string_equal(p->clips[0].colourspaces[0], "lin_rec709_srgb");
    assert_string_equal(p->clips[0].colourspace, "");
    set_text(&s, "mono", "true"); /* a slave of the preferences */
    set_text(&s, "gain", "2");
    ok(wo_host_get_preferences(s.instance, &p, &ok_error));
    assert_int_equal(p->clips[0].components, 1);
    assert_int_equal(p->clips[2].components, 1);
    assert_int_equal(p->alpha, WO_HOST_OPAQUE);
    wo_image image = fixture_render(s.instance, 1, 1, whole, 0, NULL);
    assert_int_equal(image.components, 1);
    assert_true(wo_image_at(&image, 3, 9)[0] == 2 * wo_image_at(&s.source.image, 3, 9)[3]);
    wo_host_image_free(&image);
    set_text(&s, "mono", "false"); /* and back */
    ok(wo_host_get_preferences(s.instance, &p, &ok_error));
    assert_int_equal(p->clips[0].components, 4);
    assert_int_equal(p->clips[2].components, 4);
    tear_down(&s);
}

static void colourspaces_are_carried(void **state)
{
    (void)state;
    set s = set_up("Filter", 1, true, 0);
    const wo_host_preferences *p = NULL;
    wo_host_source source = WO_HOST_SOURCE_INIT;
    source.user = &s.source;
    source.region = wo_host_still_region;
    source.pixels = wo_host_still_pixels;
    source.colourspace = "ACEScg";
    ok(wo_host_set_clip(s.instance, "Source", &source, &ok_error));
    source.user = &s.mask;
    source.components = 1;
    ok(wo_host_set_clip(s.instance, "Mask", &source, &ok_error));
    ok(wo_host_get_preferences(s.instance, &p, &ok_error));
    assert_string_equal(p->clips[0].colourspace, "ACEScg");
    assert_string_equal(p->clips[1].colourspace, ""); /* masks have none */
    assert_string_equal(p->clips[2].colourspace, "ACEScg");
    tear_down(&s);
}

static void generator_without_clips(void **state)
{
    (void)state;
    set s = set_up("Generator", 2, true, WO_HOST_NEGATIVE_ROWS);
    wo_host_render_result result;
    set_text(&s, "invert", "1");
    wo_image image = fixture_render(s.instance, 1, 0.5, whole, 0, &result);
    assert_true(wo_rect_equal(image.bounds, (wo_rect){0, 0, 20, 15}));
    assert_true(image.data[0] == 1 && image.data[3] == 0);
    wo_host_image_free(&image);
    tear_down(&s);
}

static void pixel_aspect_counts(void **state)
{
    (void)state;
    set s = set_up("Filter", 1, true, 0);
    wo_host_region region;
    wo_rect pixels;
    s.source.pixel_aspect = 2;
    fixture_connect(s.instance, "Source", &s.source);
    set_text(&s, "gain", "3");
    ok(wo_host_get_region(s.instance, 1, 0.5, 0.5, &region, &pixels, &ok_error));
    assert_true(region.x1 == -6 && region.x2 == 74 && region.y1 == 2 && region.y2 == 32);
    assert_true(wo_rect_equal(pixels, (wo_rect){-2, 1, 19, 16}));
    wo_image image = fixture_render(s.instance, 1, 1, whole, 0, NULL);
    assert_true(wo_image_at(&image, 8, 8)[2] == 3 * wo_image_at(&s.source.image, 8, 8)[2]);
    wo_host_image_free(&image);
    tear_down(&s);
}

static void regions_are_told(void **state)
{
    (void)state;
    set s = set_up("Filter", 1, true, 0);
    wo_host_region region, needed[3];
    wo_rect pixels;
    double ranges[3][2], first, last;
    wo_error error = {0};
    fixture_connect(s.instance, "Source", &s.source);
    set_text(&s, "radius", "6");
    ok(wo_host_get_region(s.instance, 1, 1, 1, &region, &pixels, &ok_error));
    assert_true(wo_rect_equal(pixels, (wo_rect){-9, -4, 43, 38}));
    ok(wo_host_get_needed(s.instance, 1, 1, 1, (wo_host_region){10, 10, 20, 20}, needed, 3,
                          &ok_error));
    assert_true(needed[0].x1 == 4 && needed[0].y2 == 26);
    assert_true(needed[1].x1 == 10 && needed[1].y2 == 20); /* Mask: as asked */
    assert_true(needed[2].x1 == 0 && needed[2].x2 == 0);   /* Output */
    assert_int_equal(wo_host_get_needed(s.instance, 1, 1, 1, region, needed, 2, &error),
                     WO_ERR_ARGUMENT);
    assert_int_equal(wo_host_get_region(s.instance, 1, 0, 1, &region, &pixels, &error),
                     WO_ERR_RANGE);
    assert_int_equal(wo_host_get_region(s.instance, (double)NAN, 1, 1, &region, &pixels, &error),
                     WO_ERR_RANGE);
    ok(wo_host_get_frames_needed(s.instance, 5, ranges, 3, &ok_error));
    assert_true(ranges[0][0] == 5 && ranges[0][1] == 5);
    ok(wo_host_get_time_domain(s.instance, &first, &last, &ok_error));
    assert_true(first == 1 && last == 1);
    tear_down(&s);
}

/* Sources that fail, lie, or have no picture. */
typedef enum fault { NO_PICTURE, BROKEN, NO_REGION, NAN_REGION, INFINITE_REGION } fault;

static wo_status faulty_region(void *user, double time, wo_host_region *region, wo_error *error)
{
    (void)time;
    if (*(fault *)user == NO_REGION)
        return wo_fail(error, WO_ERR_IO, "the disk is gone");
    *region = (wo_host_region){0, 0, *(fault *)user == NAN_REGION ? (double)NAN : 40, 30};
    if (*(fault *)user == INFINITE_REGION)
        *region = (wo_host_region){-1e10, -1e10, 1e10, 1e10};
    return WO_OK;
}

static wo_status faulty_pixels(void *user, const wo_host_request *request, const wo_image *image,
                               wo_error *error)
{
    assert_true(wo_rect_equal(request->region, image->bounds));
    if (*(fault *)user == NO_PICTURE)
        return wo_fail(error, WO_ERR_NOT_FOUND, "no such frame");
    if (*(fault *)user == BROKEN)
        return wo_fail(error, WO_ERR_FORMAT, "the file is damaged");
    for (int32_t y = image->bounds.y1; y < image->bounds.y2; y++)
        wo_image_at(image, image->bounds.x1, y)[0] = 0.5f;
    return WO_OK;
}

static void sources_may_fail(void **state)
{
    static const struct {
        fault what;
        wo_status status;
        const char *text;
    } cases[] = {
        {NO_PICTURE, WO_OK, ""},
        {BROKEN, WO_ERR_FORMAT, "the file is damaged"},
        {NO_REGION, WO_ERR_IO, "the disk is gone"},
        {NAN_REGION, WO_ERR_RANGE, "covers"},
        {INFINITE_REGION, WO_OK, ""},
    };
    (void)state;
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        set s = set_up("Filter", 1, true, 0);
        fault what = cases[i].what;
        wo_error error = {0};
        wo_image image = {0};
        wo_host_render_args args = WO_HOST_RENDER_INIT;
        wo_host_source source = WO_HOST_SOURCE_INIT;
        source.user = &what;
        source.region = faulty_region;
        source.pixels = faulty_pixels;
        ok(wo_host_set_clip(s.instance, "Source", &source, &ok_error));
        set_text(&s, "gain", "2");
        args.time = 1;
        assert_int_equal(wo_host_render(s.instance, &args, &image, NULL, &error), cases[i].status);
        assert_non_null(strstr(error.text, cases[i].text));
        assert_int_equal(error.status, cases[i].status);
        if (cases[i].status == WO_OK) {
            assert_int_equal(wo_rect_width(image.bounds), 40);
            assert_true(image.data[0] == (what == INFINITE_REGION ? 1.0f : 0.0f));
        } else {
            assert_null(image.data);
        }
        wo_host_image_free(&image);
        set_text(&s, "gain", "1"); /* the same as an identity */
        error = (wo_error){0};
        assert_int_equal(wo_host_render(s.instance, &args, &image, NULL, &error), cases[i].status);
        assert_non_null(strstr(error.text, cases[i].text));
        assert_int_equal(error.status, cases[i].status);
        wo_host_image_free(&image);
        tear_down(&s);
    }
}

static void take_text(void *user, const char *kind, const char *text)
{
    snprintf(user, 100, "%s=%s", kind, text);
}

static void reports_arrive(void **state)
{
    (void)state;
    set s = set_up("Filter", 2, true, 0);
    char text[100] = "";
    wo_image image = {0};
    wo_host_render_args args = WO_HOST_RENDER_INIT;
    args.time = 1;
    args.publish = take_text;
    args.report_user = text;
    fixture_connect(s.instance, "Source", &s.source);
    set_text(&s, "gain", "2");
    ok(wo_host_render(s.instance, &args, &image, NULL, &ok_error));
    assert_string_equal(text, "");
    wo_host_image_free(&image);
    args.report = WO_HOST_REPORT_RENDER;
    ok(wo_host_render(s.instance, &args, &image, NULL, &ok_error));
    assert_string_equal(text, "report={\"rows\": 1}");
    wo_host_image_free(&image);
    args.report = WO_HOST_REPORT_EXPLAIN;
    ok(wo_host_render(s.instance, &args, &image, NULL, &ok_error));
    assert_string_equal(text, "plan=it blurs");
    wo_host_image_free(&image);
    tear_down(&s);
}

/* The still source at small scales: averages, or picks. */
static void stills_scale(void **state)
{
    float pixels[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}; /* 4 x 3 */
    wo_host_still still = {.image = {pixels, {0, 0, 4, 3}, 16, 1}};
    float small[4] = {0};
    const wo_image out = {small, {0, 0, 2, 2}, 8, 1};
    const wo_host_request request = {.scale_x = 0.5, .scale_y = 0.5, .region = {0, 0, 2, 2}};
    wo_host_region region;
    (void)state;
    ok(wo_host_still_region(&still, 1, &region, &ok_error));
    assert_true(region.x2 == 4 && region.y2 == 3);
    ok(wo_host_still_pixels(&still, &request, &out, &ok_error));
    assert_true(small[0] == 2.5f && small[1] == 4.5f && small[2] == 8.5f && small[3] == 10.5f);
    still.nearest = true;
    ok(wo_host_still_pixels(&still, &request, &out, &ok_error));
    assert_true(small[0] == 0 && small[1] == 2 && small[2] == 8 && small[3] == 10);
    still.image.data = NULL;
    assert_int_equal(wo_host_still_pixels(&still, &request, &out, NULL), WO_ERR_NOT_FOUND);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_are_right),
        cmocka_unit_test(whole_equals_parts),
        cmocka_unit_test(identity_is_a_copy),
        cmocka_unit_test(windows),
        cmocka_unit_test(animation_is_followed),
        cmocka_unit_test(components_follow_preferences),
        cmocka_unit_test(colourspaces_are_carried),
        cmocka_unit_test(generator_without_clips),
        cmocka_unit_test(pixel_aspect_counts),
        cmocka_unit_test(regions_are_told),
        cmocka_unit_test(sources_may_fail),
        cmocka_unit_test(reports_arrive),
        cmocka_unit_test(stills_scale),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
