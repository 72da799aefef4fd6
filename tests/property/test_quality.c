/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "cases.h"
#include "defocus/renderer.h"
#include "near.h"
#include "scenes.h"

#include <string.h>

static const wo_rect frame = {0, 0, 96, 64};

static scene blurred_scene(uint64_t seed)
{
    scene s;
    scene_init(&s, frame);
    scene_px_per_dioptre(&s, 16);
    scene_fill_layers(&s, seed);
    return s;
}

/* More rays, less error; and at any number of rays hybrid is nearer to the truth than rays alone,
   and comes nearer with more. */
static void more_rays_less_error(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < (uint64_t)cases_of(2, 1); seed++) {
        scene s = blurred_scene(seed);
        s.params.method = WO_METHOD_RAYS;
        s.params.samples = 4096;
        s.params.seed = 99;
        wo_image truth = scene_render(&s, NULL);
        s.params.seed = 5;
        double last[2] = {INFINITY, INFINITY}; /* of rays, of hybrid */
        for (int32_t samples = 4; samples <= 1024; samples *= 4) {
            double error[2];
            s.params.samples = samples;
            for (int hybrid = 0; hybrid < 2; hybrid++) {
                s.params.method = hybrid ? WO_METHOD_HYBRID : WO_METHOD_RAYS;
                wo_image out = scene_render(&s, NULL);
                error[hybrid] = picture_rms(&out, &truth, frame);
                picture_free(&out);
            }
            /* Pure chance would halve it. */
            assert_at_most(error[0], 0.55 * last[0]);
            if (samples > 4) {
                assert_at_most(error[1], 1.05 * error[0]);
                assert_at_most(error[1], samples > 16 ? 0.7 * last[1] : 0.8 * error[0]);
            }
            last[0] = error[0];
            last[1] = error[1];
        }
        picture_free(&truth);
        scene_free(&s);
    }
}

/* Root of the mean square of the difference of displayed values, as errors are estimated. */
static double displayed_rms(const wo_image *a, const wo_image *b)
{
    double sum = 0;
    for (int32_t i = 0; i < 96 * 64; i++)
        for (int k = 0; k < 3; k++) {
            const double d =
                (double)(wo_display(a->data[4 * i + k]) - wo_display(b->data[4 * i + k]));
            sum += d * d;
        }
    return sqrt(sum / (96 * 64 * 3));
}

static double estimated_rms(const wo_report *report)
{
    double sum = 0;
    double pixels = 0;
    for (int i = 0; i < WO_TILE_CLASS_COUNT; i++) {
        sum += report->square_error[i];
        pixels += (double)report->error_pixels[i];
    }
    return sqrt(sum / pixels);
}

/* The error that a render says it has is that against the converged picture: within a factor 1.25
   for nine of ten renders by rays or hybrid, for none off by more than 1.6. */
static void errors_are_as_estimated(void **state)
{
    (void)state;
    static const struct {
        wo_sampling sampling;
        int32_t samples;
        double target;
    } work[] = {
        {WO_SAMPLING_FIXED, 16, 1},
        {WO_SAMPLING_FIXED, 64, 1},
        {WO_SAMPLING_ADAPTIVE, 1, 4.0 / 255},
        {WO_SAMPLING_ADAPTIVE, 1, 2.0 / 255},
    };
    static const int32_t methods[] = {WO_METHOD_RAYS, WO_METHOD_HYBRID};
    int renders = 0;
    int within = 0;
    for (uint64_t seed = 0; seed < 2; seed++) {
        scene s = blurred_scene(seed);
        s.params.method = WO_METHOD_RAYS;
        s.params.samples = 1024;
        s.params.seed = 99;
        wo_image truth = scene_render(&s, NULL);
        for (size_t m = 0; m < WO_COUNT(methods); m++) {
            for (size_t i = 0; i < WO_COUNT(work); i++) {
                s.params.method = methods[m];
                s.params.sampling = work[i].sampling;
                s.params.samples = work[i].samples;
                s.params.target_error = work[i].target;
                s.params.seed = 5;
                wo_report report = {0};
                wo_image out = scene_render(&s, &report);
                const double ratio = displayed_rms(&out, &truth) / estimated_rms(&report);
                renders++;
                within += ratio <= 1.25 && ratio >= 1 / 1.25;
                assert_at_most(ratio, 1.6);
                assert_at_most(1 / ratio, 1.6);
                picture_free(&out);
            }
        }
        picture_free(&truth);
        scene_free(&s);
    }
    print_message("errors as estimated, within 1.25: %d of %d\n", within, renders);
    assert_true(10 * within >= 9 * renders);
}

/* One ray where many are wanted cannot know its error, and does not say that it is none. */
static void one_ray_tells_no_error(void **state)
{
    (void)state;
    static const int32_t methods[] = {WO_METHOD_RAYS, WO_METHOD_HYBRID, WO_METHOD_ACCUMULATE};
    scene s = blurred_scene(1);
    for (size_t m = 0; m < WO_COUNT(methods); m++) {
        for (int32_t samples = 1; samples <= 2; samples++) {
            wo_report report = {0};
            s.params.method = methods[m];
            s.params.samples = samples;
            wo_image out = scene_render(&s, &report);
            assert_int_equal(report.error_pixels[WO_TILE_MARCH] > 0, samples > 1);
            picture_free(&out);
        }
    }
    scene_free(&s);
}

static void seeds_differ_and_agree(void **state)
{
    (void)state;
    scene s = blurred_scene(3);
    s.params.samples = 256;
    wo_image a = scene_render(&s, NULL);
    wo_image same = scene_render(&s, NULL);
    s.params.seed = 1;
    wo_image b = scene_render(&s, NULL);
    assert_true(picture_same_bytes(&a, &same, frame));
    assert_false(picture_same_bytes(&a, &b, frame));
    double mean[2] = {0, 0};
    for (int32_t i = 0; i < 96 * 64 * 4; i++) {
        mean[0] += (double)a.data[i];
        mean[1] += (double)b.data[i];
    }
    assert_close(mean[0], mean[1], 1e-3);
    picture_free(&a);
    picture_free(&b);
    picture_free(&same);
    scene_free(&s);
}

static void masks(void **state)
{
    (void)state;
    scene s = blurred_scene(4);
    wo_image blurred = scene_render(&s, NULL);
    const wo_image *const source = &s.clip[WO_CLIP_SOURCE];
    const int32_t components[] = {1, 3, 4};
    for (size_t i = 0; i < WO_COUNT(components); i++) {
        wo_image *const mask = scene_clip(&s, WO_CLIP_MASK, components[i]);
        /* A mask of four channels is read from its alpha. */
        const bool alpha = components[i] == 4;
        const float zero[4] = {alpha ? 1 : 0, 1, 1, 0};
        picture_fill(mask, zero);
        wo_image out = scene_render(&s, NULL);
        assert_true(picture_same_bytes(&out, source, frame));
        const float nan[4] = {alpha ? 1 : NAN, 1, 1, NAN};
        picture_fill(mask, nan);
        picture_free(&out);
        out = scene_render(&s, NULL);
        assert_true(picture_same_bytes(&out, source, frame));
        const float one[4] = {alpha ? 0 : 1, 0, 0, 1};
        picture_fill(mask, one);
        picture_free(&out);
        out = scene_render(&s, NULL);
        assert_true(picture_same_bytes(&out, &blurred, frame));
        const float more[4] = {alpha ? 0 : 7, 0, 0, 7};
        picture_fill(mask, more);
        picture_free(&out);
        out = scene_render(&s, NULL);
        assert_true(picture_same_bytes(&out, &blurred, frame));
        const float half[4] = {alpha ? 0 : 0.5f, 0, 0, 0.5f};
        picture_fill(mask, half);
        picture_free(&out);
        out = scene_render(&s, NULL);
        for (int32_t n = 0; n < 96 * 64 * 4; n++) {
            const double mean = ((double)source->data[n] + (double)blurred.data[n]) / 2;
            assert_near((double)out.data[n], mean, 1e-6 * fmax(1, fabs(mean)));
        }
        /* Turned off, the mask is not there. */
        picture_fill(mask, zero);
        s.params.use_mask = 0;
        picture_free(&out);
        out = scene_render(&s, NULL);
        s.params.use_mask = 1;
        assert_true(picture_same_bytes(&out, &blurred, frame));
        picture_free(&out);
    }
    picture_free(&blurred);
    scene_free(&s);
}

static int identity_of(const scene *s)
{
    const wo_plan_args args = scene_args(s, s->geometry.extent);
    return wo_lens_blur.identity(&s->params, &args.geometry);
}

static void identity_where_nothing_can_blur(void **state)
{
    (void)state;
    scene s;
    scene_init(&s, frame);
    scene_fill_busy(&s, 6);
    assert_int_equal(identity_of(&s), -1);
    s.params.max_radius = 0;
    assert_int_equal(identity_of(&s), WO_CLIP_SOURCE);
    s.params.output = WO_OUTPUT_COC;
    assert_int_equal(identity_of(&s), -1);
    s.params.output = WO_OUTPUT_IMAGE;
    s.params.max_radius = 100;
    /* No depth: all at infinity, which is in focus or is not. */
    s.params.use_depth = 0;
    assert_int_equal(identity_of(&s), -1);
    s.params.focus_distance = 0;
    assert_int_equal(identity_of(&s), WO_CLIP_SOURCE);
    picture_free(&s.clip[WO_CLIP_DEPTH]);
    s.params.use_depth = 1;
    assert_int_equal(identity_of(&s), WO_CLIP_SOURCE);
    /* Layers must be put together, blurred or not. */
    scene_clip(&s, 2, 4);
    assert_int_equal(identity_of(&s), -1);
    s.params.layers = 1;
    assert_int_equal(identity_of(&s), WO_CLIP_SOURCE);
    s.params.f_stop = NAN;
    assert_int_equal(identity_of(&s), -1);
    scene_free(&s);
}

/* A picture that is in focus everywhere comes out as it went in, to the byte, whether the effect
   knows it beforehand or finds out; coverage too. */
static void sharp_is_the_source(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        scene s;
        scene_init(&s, frame);
        scene_fill_busy(&s, 8);
        wo_image *const source = &s.clip[WO_CLIP_SOURCE];
        if (kind == 0) { /* everything in the plane of focus */
            picture_fill(&s.clip[WO_CLIP_DEPTH], (const float[1]){4});
            s.params.focus_distance = 4;
        } else if (kind == 1) { /* at infinity */
            picture_fill(&s.clip[WO_CLIP_DEPTH], (const float[1]){INFINITY});
            s.params.focus_distance = 0;
        } else if (kind == 2) {
            s.params.max_radius = 0.04;
        } else { /* a lens like a pinhole */
            s.params.f_stop = 20000;
        }
        rng r = {9};
        for (int32_t i = 0; i < 96 * 64; i++) {
            const float a = i % 3 ? 1 : (float)rng_int(&r, 0, 250) / 255;
            for (int k = 0; k < 4; k++)
                source->data[4 * i + k] *= a;
        }
        wo_report report = {0};
        wo_image out = scene_render(&s, &report);
        assert_int_equal(report.tiles[WO_TILE_MARCH] + report.tiles[WO_TILE_SINGLE], 0);
        assert_true(picture_same_bytes(&out, source, frame));
        picture_free(&out);
        scene_free(&s);
    }
}

/* Coverage within a thousandth of 1 counts as 1. */
static void almost_opaque_stays_within_the_limit(void **state)
{
    (void)state;
    scene s;
    scene_init(&s, frame);
    s.params.focus_distance = 0;
    wo_image *const source = scene_clip(&s, WO_CLIP_SOURCE, 4);
    for (int32_t i = 0; i < 96 * 64; i++)
        for (int k = 0; k < 4; k++)
            source->data[4 * i + k] = 0.998f + 0.002f * (float)i / (96 * 64);
    wo_image out = scene_render(&s, NULL);
    assert_at_most(picture_difference(&out, source, frame), 1e-3);
    picture_free(&out);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(more_rays_less_error),
        cmocka_unit_test(errors_are_as_estimated),
        cmocka_unit_test(one_ray_tells_no_error),
        cmocka_unit_test(seeds_differ_and_agree),
        cmocka_unit_test(masks),
        cmocka_unit_test(identity_where_nothing_can_blur),
        cmocka_unit_test(sharp_is_the_source),
        cmocka_unit_test(almost_opaque_stays_within_the_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
