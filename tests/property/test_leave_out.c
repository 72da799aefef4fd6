/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "effects/lens_blur_plan.h"
#include "optics/lens_choice.h"

#include "near.h"
#include "scenes.h"

#include <string.h>

/* What a plan leaves out changes nothing that anybody could see, and is reported with its saving:
   every scene is rendered with and without. */

static const wo_rect frame = {-9, 5, 183, 117};

/* With the classes of tiles made anew. */
static wo_image render_with(const scene *s, unsigned leave_out, wo_report *report)
{
    const wo_context context = WO_CONTEXT_INIT;
    const wo_plan_args args = scene_args(s, s->geometry.extent);
    wo_plan *plan = NULL;
    wo_error error = {WO_OK, ""};
    if (wo_lens_blur.plan_create(&context, &s->params, &args, &plan, &error) != WO_OK)
        fail_msg("%s", error.text);
    wo_lens_rays_destroy(&context, &plan->rays);
    const int32_t margin = plan->setup.margin;
    assert_int_equal(wo_lens_rays_create(&context, &plan->stack, &plan->lens,
                                         wo_rect_grow(plan->window, margin, margin), plan->reach,
                                         leave_out, &plan->rays, NULL),
                     WO_OK);
    wo_image out = picture_make(s->geometry.extent, 4);
    assert_int_equal(wo_lens_blur.render(plan, args.window, &out, report, NULL), WO_OK);
    wo_lens_blur.plan_destroy(&plan);
    return out;
}

/* Amount of an omission that the report lists; 0 = it does not. */
static double left_out(const wo_report *report, const char *what)
{
    for (int i = 0; i < report->left_out_count; i++)
        if (strcmp(report->left_out[i].what, what) == 0)
            return report->left_out[i].amount;
    return 0;
}

/* Renders with and without an omission; what: NULL = it must not be listed either way. */
static double difference(const scene *s, unsigned with, unsigned without, const char *what)
{
    wo_report reports[2] = {0};
    wo_image a = render_with(s, with, &reports[0]);
    wo_image b = render_with(s, without, &reports[1]);
    if (what) {
        assert_true(left_out(&reports[0], what) > 0);
        assert_true(left_out(&reports[1], what) == 0);
    }
    const double d = picture_difference(&a, &b, s->geometry.extent);
    picture_free(&a);
    picture_free(&b);
    return d;
}

/* Nothing but what the two boxes and the slope hide. The filter draws its taps after what the tile
 * holds. */
static void hidden_surfaces(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 8; i++) {
        scene s;
        scene_init(&s, frame);
        scene_px_per_dioptre(&s, i < 4 ? 8 : 3);
        s.params.samples = 24;
        s.params.method = WO_METHOD_RAYS;
        scene_fill_busy(&s, i);
        if (i & 2) { /* an opaque layer behind all of it */
            memcpy(scene_clip(&s, 2, 4)->data, s.clip[0].data,
                   sizeof(float[4]) * (size_t)(wo_rect_width(frame) * wo_rect_height(frame)));
            picture_fill(scene_clip(&s, 3, 1), (const float[1]){30});
        }
        if (i == 6) { /* rays with an offset of their own, coma and all */
            s.params.lens = WO_LENS_SINGLET;
            s.params.f_stop = fmax(s.params.f_stop, 4);
        }
        assert_at_most(
            difference(&s, WO_LEAVE_OUT_HIDDEN, 0, i & 2 ? "layers behind opaque surfaces" : NULL),
            1e-5); /* rounding beside lights of 400 */
        scene_free(&s);
    }
}

/* Holes, steps and the least transparency let rays through: nothing is left out. */
static void what_does_not_hide(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        scene s;
        scene_init(&s, frame);
        scene_px_per_dioptre(&s, 12);
        s.params.samples = 16;
        const float front = i == 1 ? 0.999f : 1;
        picture_fill(scene_clip(&s, 0, 4), (const float[4]){0.2f, 0.2f, 0.2f, front});
        picture_fill(scene_clip(&s, 1, 1), (const float[1]){1});
        picture_fill(scene_clip(&s, 2, 4), (const float[4]){0.9f, 0, 0, 1});
        picture_fill(scene_clip(&s, 3, 1), (const float[1]){9});
        for (int32_t y = frame.y1; y < frame.y2; y++)
            for (int32_t x = frame.x1; x < frame.x2; x++) {
                if (i == 2 && x % 8 == 3 && y % 8 == 2) /* a hole in every cell */
                    memset(wo_image_at(&s.clip[0], x, y), 0, sizeof(float[4]));
                if (i == 3) /* steps of more than 1.5 px of blur */
                    *wo_image_at(&s.clip[1], x, y) = x & 4 ? 1.0f : 0.85f;
            }
        wo_report report = {0};
        wo_image out = render_with(&s, WO_LEAVE_OUT_ALL, &report);
        assert_true((left_out(&report, "layers behind opaque surfaces") > 0) == (i == 0));
        picture_free(&out);
        if (i > 0)
            assert_true(difference(&s, WO_LEAVE_OUT_ALL, 0, NULL) < 0.01);
        scene_free(&s);
    }
}

/* No light above 1. */
static void dim(const scene *s)
{
    for (int32_t y = frame.y1; y < frame.y2; y++)
        for (int32_t x = frame.x1; x < frame.x2; x++)
            for (int k = 0; k < 3; k++) {
                float *const c = wo_image_at(&s->clip[0], x, y);
                c[k] = fminf(c[k], 1);
            }
}

/* In focus: what is left out is blur of less than a twentieth of a pixel. */
static void sharp_tiles(void **state)
{
    (void)state;
    scene s;
    scene_init(&s, frame);
    scene_px_per_dioptre(&s, 0.15);
    s.params.samples = 32;
    scene_fill_busy(&s, 3);
    s.params.focus_distance = 3;
    /* Lights of up to 400: the largest step between neighbours counts. */
    assert_at_most(difference(&s, WO_LEAVE_OUT_SHARP, 0, "rays of sharp tiles"), 400 * 0.05);
    dim(&s);
    assert_at_most(difference(&s, WO_LEAVE_OUT_SHARP, 0, "rays of sharp tiles"), 0.012);
    scene_free(&s);
}

/* One sheet within a pixel of blur: marching would find the same pixels but where a ray meets the
   next one first. */
static void tiles_of_one_depth(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        scene s;
        scene_init(&s, frame);
        scene_px_per_dioptre(&s, 20);
        s.params.samples = 64;
        scene_fill_busy(&s, 5);
        dim(&s);
        for (int32_t y = frame.y1; y < frame.y2; y++)
            for (int32_t x = frame.x1; x < frame.x2; x++)
                *wo_image_at(&s.clip[1], x, y) = (float)(i == 0 ? 2 : 2 + 0.002 * x);
        assert_at_most(difference(&s, WO_LEAVE_OUT_SINGLE | WO_LEAVE_OUT_HIDDEN,
                                  WO_LEAVE_OUT_HIDDEN, "marching in tiles of one depth"),
                       i == 0 ? 1e-5 : 0.02);
        scene_free(&s);
    }
}

static void black_tiles(void **state)
{
    (void)state;
    for (int method = 0; method < WO_METHOD_REFERENCE; method++) {
        scene s;
        scene_init(&s, frame);
        scene_px_per_dioptre(&s, 6);
        s.params.samples = 16;
        s.params.method = method;
        scene_fill_busy(&s, 8);
        for (int32_t y = frame.y1; y < frame.y2; y++)
            for (int32_t x = frame.x1; x < frame.x1 + 120; x++)
                memset(wo_image_at(&s.clip[0], x, y), 0, sizeof(float[3]));
        wo_report report = {0};
        wo_image a = render_with(&s, WO_LEAVE_OUT_ALL, &report);
        assert_true(report.tiles[WO_TILE_BLACK] > 0);
        assert_true(left_out(&report, "rays of black tiles") > 0);
        wo_image b = render_with(&s, WO_LEAVE_OUT_ALL & ~(unsigned)WO_LEAVE_OUT_BLACK, NULL);
        /* The filter's median looks one pixel into the tile beside. */
        assert_at_most(picture_difference(&a, &b, frame), 1e-6);
        picture_free(&a);
        picture_free(&b);
        scene_free(&s);
    }
}

/* All of it together, on scenes that have all of it. */
static void everything(void **state)
{
    (void)state;
    for (int method = 0; method < WO_METHOD_REFERENCE; method++) {
        scene s;
        scene_init(&s, frame);
        scene_px_per_dioptre(&s, 5);
        s.params.samples = 64;
        s.params.method = method;
        scene_fill_layers(&s, 4);
        wo_report report = {0};
        wo_image a = render_with(&s, WO_LEAVE_OUT_ALL, &report);
        wo_image b = render_with(&s, 0, NULL);
        const double rms = picture_rms(&a, &b, frame);
        assert_at_most(rms, 1.0 / 1000);
        for (int i = 0; i < report.left_out_count; i++) {
            assert_true(report.left_out[i].what[0] && report.left_out[i].why[0]);
            assert_true(report.left_out[i].amount >= 0);
        }
        picture_free(&a);
        picture_free(&b);
        scene_free(&s);
    }
}

/* All in focus: the source, as the rays would have it. An empty second layer keeps the plan from
   the short way. */
static void a_sharp_picture_is_copied(void **state)
{
    (void)state;
    for (int i = 0; i < 12; i++) {
        scene s;
        scene_init(&s, frame);
        scene_px_per_dioptre(&s, 0.004);
        s.params.samples = 16;
        s.params.method = i % WO_METHOD_REFERENCE;
        s.alpha[0] = (wo_alpha)(i % 3);
        s.params.depth_mode = i % 4 == 3   ? WO_DEPTH_RAY
                              : i % 4 == 2 ? WO_DEPTH_INVERSE
                                           : WO_DEPTH_DISTANCE;
        scene_fill_busy(&s, (uint64_t)i);
        rng r = {(uint64_t)i};
        for (int n = 0; n < 40 && i > 5; n++) { /* all that can be wrong with a picture */
            const int32_t x = rng_int(&r, frame.x1, frame.x2 - 1);
            const int32_t y = rng_int(&r, frame.y1, frame.y2 - 1);
            const float odd[] = {NAN, INFINITY, -1, 0, 1e32f, 0.5f};
            wo_image_at(&s.clip[0], x, y)[n % 4] = odd[n % 6];
            *wo_image_at(&s.clip[1], x, y) = odd[n % 4];
        }
        wo_report reports[2] = {0};
        wo_image a = scene_render(&s, &reports[0]);
        scene_clip(&s, 2, 4);
        wo_image b = scene_render(&s, &reports[1]);
        const double pixels = (double)(wo_rect_width(frame) * wo_rect_height(frame));
        assert_true(left_out(&reports[0], "everything") == 16 * pixels);
        assert_true(left_out(&reports[1], "everything") == 0);
        assert_true(picture_difference(&a, &b, frame) == 0);
        assert_int_equal(reports[0].pixels, reports[1].pixels);
        assert_int_equal(reports[0].sanitised_colour, reports[1].sanitised_colour);
        assert_int_equal(reports[0].sanitised_depth, reports[1].sanitised_depth);
        assert_int_equal(reports[0].tiles[WO_TILE_SHARP], reports[1].tiles[WO_TILE_SHARP]);
        picture_free(&a);
        picture_free(&b);
        scene_free(&s);
    }
}

/* One blurred pixel anywhere, and the picture is rendered. */
static void one_blurred_pixel_is_seen(void **state)
{
    (void)state;
    const int32_t at[][2] = {{-9, 5}, {182, 5}, {-9, 116}, {182, 116}, {100, 60}};
    for (size_t i = 0; i < WO_COUNT(at); i++) {
        scene s;
        scene_init(&s, frame);
        scene_px_per_dioptre(&s, 0.1);
        s.params.samples = 16;
        scene_fill_busy(&s, 2);
        picture_fill(&s.clip[1], (const float[1]){2.5f});
        wo_report reports[2] = {0};
        wo_image a = scene_render(&s, &reports[0]);
        picture_free(&a);
        *wo_image_at(&s.clip[1], at[i][0], at[i][1]) = 0.9f;
        a = scene_render(&s, &reports[1]);
        picture_free(&a);
        assert_true(left_out(&reports[0], "everything") > 0);
        assert_true(left_out(&reports[1], "everything") == 0);
        /* Unless nothing is there. */
        memset(wo_image_at(&s.clip[0], at[i][0], at[i][1]), 0, sizeof(float[4]));
        reports[1] = (wo_report){0};
        a = scene_render(&s, &reports[1]);
        picture_free(&a);
        assert_true(left_out(&reports[1], "everything") > 0);
        scene_free(&s);
    }
}

/* Light through nothing, coverage of less than any number: the same as nothing there. */
static void empty_tiles(void **state)
{
    (void)state;
    scene s;
    scene_init(&s, frame);
    scene_px_per_dioptre(&s, 6);
    s.params.samples = 16;
    scene_fill_busy(&s, 9);
    for (int pass = 0; pass < 2; pass++)
        for (int32_t y = frame.y1; y < frame.y2; y++)
            for (int32_t x = frame.x1 + 70; x < frame.x2; x++)
                memset(wo_image_at(&s.clip[0], x, y), 0, sizeof(float[4]));
    wo_report report = {0};
    wo_image a = scene_render(&s, &report);
    assert_true(left_out(&report, "rays of empty tiles") > 0);
    for (int32_t y = frame.y1; y < frame.y2; y++)
        for (int32_t x = frame.x2 - 32; x < frame.x2; x++)
            memcpy(wo_image_at(&s.clip[0], x, y), (const float[4]){0, 0, 0, 1e-30f},
                   sizeof(float[4]));
    report = (wo_report){0};
    wo_image b = scene_render(&s, &report);
    assert_at_most(picture_difference(&a, &b, frame), 1e-29);
    picture_free(&a);
    picture_free(&b);
    scene_free(&s);
}

static void empty_layers(void **state)
{
    (void)state;
    scene s;
    scene_init(&s, frame);
    scene_px_per_dioptre(&s, 9);
    s.params.samples = 16;
    scene_fill_busy(&s, 10);
    wo_image a = scene_render(&s, NULL);
    scene_clip(&s, 2, 4);
    picture_fill(scene_clip(&s, 3, 1), (const float[1]){1.5f});
    wo_report report = {0};
    wo_image b = scene_render(&s, &report);
    assert_true(left_out(&report, "layers") == 1);
    assert_true(picture_same_bytes(&a, &b, frame));
    picture_free(&a);
    picture_free(&b);
    scene_free(&s);
}

/* Where the mask is 0 the source shows, and all else is as if there were no such tiles. */
static void masked_tiles(void **state)
{
    (void)state;
    for (int method = 0; method < WO_METHOD_REFERENCE; method++) {
        scene s;
        scene_init(&s, frame);
        scene_px_per_dioptre(&s, 9);
        s.params.samples = 16;
        s.params.method = method;
        scene_fill_busy(&s, 11);
        wo_image a = scene_render(&s, NULL);
        wo_image *const mask = scene_clip(&s, WO_CLIP_MASK, 1);
        for (int32_t y = frame.y1; y < frame.y2; y++)
            for (int32_t x = frame.x1; x < frame.x1 + 60; x++)
                *wo_image_at(mask, x, y) = 1;
        wo_report report = {0};
        wo_image b = scene_render(&s, &report);
        assert_true(left_out(&report, "tiles outside the mask") > 0);
        wo_rect in = frame;
        in.x2 = in.x1 + 60;
        wo_rect out = frame;
        out.x1 = in.x2;
        assert_true(picture_same_bytes(&b, &a, in));
        assert_true(picture_same_bytes(&b, &s.clip[0], out));
        picture_free(&a);
        picture_free(&b);
        scene_free(&s);
    }
}

/* Colours that part by just more than what is left out, against one wavelength: the difference is
   what leaving out could make at most. */
static void unused_wavelengths(void **state)
{
    (void)state;
    scene s;
    scene_init(&s, frame);
    s.params.lens = WO_LENS_DIAGRAM;
    s.params.lens_diagram = WO_DIAGRAM_ACHROMAT_A;
    s.params.samples = 256;
    s.params.wavelengths = 8;
    s.params.focus_distance = 3;
    scene_fill_busy(&s, 12);
    dim(&s);
    picture_fill(&s.clip[1], (const float[1]){3});
    double used = 0; /* f-numbers: colours part, and do not */
    double unused = 0;
    for (double n = 4; n < 900 && unused == 0; n *= 1.2) {
        s.params.f_stop = n;
        wo_report report = {0};
        wo_image out = scene_render(&s, &report);
        if (left_out(&report, "wavelengths") > 0)
            unused = n;
        else
            used = n;
        picture_free(&out);
    }
    assert_true(used > 0 && unused > 0);
    s.params.f_stop = used;
    wo_image a = scene_render(&s, NULL);
    s.params.wavelengths = 1;
    wo_image b = scene_render(&s, NULL);
    assert_at_most(picture_difference(&a, &b, frame), 0.01);
    picture_free(&a);
    picture_free(&b);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hidden_surfaces),
        cmocka_unit_test(what_does_not_hide),
        cmocka_unit_test(sharp_tiles),
        cmocka_unit_test(tiles_of_one_depth),
        cmocka_unit_test(black_tiles),
        cmocka_unit_test(everything),
        cmocka_unit_test(a_sharp_picture_is_copied),
        cmocka_unit_test(one_blurred_pixel_is_seen),

        cmocka_unit_test(empty_tiles),
        cmocka_unit_test(empty_layers),
        cmocka_unit_test(masked_tiles),
        cmocka_unit_test(unused_wavelengths),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
