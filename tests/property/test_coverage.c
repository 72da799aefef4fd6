/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "blur_footage.h"
#include "cases.h"
#include "defocus/renderer.h"
#include "footage.h"
#include "near.h"
#include "scenes.h"

#include <stdlib.h>
#include <string.h>

/* What every method owes coverage: an opaque scene stays opaque to the last bit, and a picture of
   one colour keeps it. Loops over all methods, so that a new one is tested without a new line. */
static const wo_context plain = WO_CONTEXT_INIT;

/* More than one tile in x and in y. */
enum { WIDE = 72, HIGH = 24 };
static const wo_rect frame = {0, 0, WIDE, HIGH};

static bool all_opaque(const wo_image *picture)
{
    for (int32_t y = picture->bounds.y1; y < picture->bounds.y2; y++)
        for (int32_t x = picture->bounds.x1; x < picture->bounds.x2; x++)
            if (wo_image_at(picture, x, y)[3] != 1)
                return false;
    return true;
}

/* Fewer samples for the slow ones. */
static int samples_of(int method)
{
    return method == WO_METHOD_REFERENCE ? 12 : 48;
}

static void render_opaque(const wo_footage *set, int method, int layers)
{
    wo_error error = {WO_OK, ""};
    wo_lens_blur_params params;
    wo_image inputs[WO_LENS_BLUR_CLIPS];
    wo_plan_args args;
    blur_footage_setup(set, layers, samples_of(method), &params, inputs, &args);
    params.method = method;
    wo_image out = picture_make(args.window, 4);
    if (wo_effect_run(&wo_lens_blur, &plain, &params, &args, &out, NULL, &error) != WO_OK)
        fail_msg("%s", error.text);
    for (int32_t y = args.window.y1; y < args.window.y2; y++)
        for (int32_t x = args.window.x1; x < args.window.x2; x++) {
            const float a = wo_image_at(&out, x, y)[3];
            if (a != 1)
                fail_msg("%s, %s, %d layers: coverage of pixel %d %d is 1 - %g", set->scene->name,
                         wo_renderer_of((wo_method)method)->key, layers, x, y, 1 - (double)a);
        }
    picture_free(&out);
}

/* Every scene of the footage, one picture and in layers. */
static void opaque_stays_opaque(void **state)
{
    (void)state;
    wo_error error = {WO_OK, ""};
    for (size_t i = (size_t)cases_of(0, 1); wo_footage_scene_at(i); i += (size_t)cases_of(1, 2)) {
        const wo_footage_options options = {.scene = wo_footage_scene_at(i)->name,
                                            .width = 66,
                                            .height = 37,
                                            .samples = 8,
                                            .layers = 4};
        wo_footage *set = NULL;
        if (wo_footage_make(&plain, &options, &set, &error) != WO_OK)
            fail_msg("%s", error.text);
        /* The lamp hangs in front of nothing. */
        const bool opaque = all_opaque(&set->colour);
        assert_true(opaque || strcmp(options.scene, "lamp") == 0);
        for (int method = 0; opaque && method < WO_METHOD_COUNT; method++) {
            render_opaque(set, method, 0);
            render_opaque(set, method, 4);
        }
        wo_footage_destroy(&plain, &set);
    }
}

/* Any depths, and coverage that is 1 only in all layers together. */
static void opaque_whatever_the_depth(void **state)
{
    (void)state;
    for (int method = 0; method < WO_METHOD_COUNT; method++) {
        for (uint64_t seed = 0; seed < 6; seed++) {
            scene s;
            scene_init(&s, frame);
            scene_px_per_dioptre(&s, 9 * (double)(1 + seed % 3));
            s.params.method = method;
            s.params.samples = samples_of(method);
            if (seed % 2)
                scene_fill_layers(&s, seed);
            else
                scene_fill_busy(&s, seed);
            rng r = {seed};
            const bool noise = seed >= 4;
            for (int32_t n = 0; noise && n < WIDE * HIGH; n++)
                s.clip[WO_CLIP_DEPTH].data[n] = (float)exp(rng_range(&r, -1, 3));
            wo_image out = scene_render(&s, NULL);
            assert_true(all_opaque(&out));
            picture_free(&out);
            scene_free(&s);
        }
    }
}

/* One colour, premultiplied by any coverage, over depths of every kind. */
static void constant_stays_constant(void **state)
{
    (void)state;
    const float colours[][4] = {
        {0.6f, 0.25f, 1.5f, 1}, {3e-4f, 7, -0.5f, 1}, {0.2f, 0.1f, 0.05f, 1}};
    for (int method = 0; method < WO_METHOD_COUNT; method++) {
        for (uint64_t seed = 0; seed < 6; seed++) {
            scene s;
            scene_init(&s, frame);
            scene_px_per_dioptre(&s, 16);
            s.params.method = method;
            s.params.samples = samples_of(method);
            scene_fill_busy(&s, seed);
            const float *colour = colours[seed % WO_COUNT(colours)];
            picture_fill(&s.clip[WO_CLIP_SOURCE], colour);
            rng r = {seed};
            for (int32_t n = 0; seed >= 3 && n < WIDE * HIGH; n++)
                s.clip[WO_CLIP_DEPTH].data[n] = (float)exp(rng_range(&r, -1, 3));
            wo_image out = scene_render(&s, NULL);
            for (int32_t i = 0; i < 4 * WIDE * HIGH; i++)
                assert_close((double)out.data[i], (double)colour[i % 4], 1e-6);
            picture_free(&out);
            scene_free(&s);
        }
    }
}

/* What is behind everything is nothing: coverage of a lone plane of one coverage stays. */
static void even_coverage_stays(void **state)
{
    (void)state;
    const float colour[4] = {0.25f, 0.125f, 0.5f, 0.5f};
    for (int method = 0; method < WO_METHOD_COUNT; method++) {
        scene s;
        scene_init(&s, frame);
        scene_px_per_dioptre(&s, 20);
        s.params.method = method;
        s.params.samples = samples_of(method);
        picture_fill(scene_clip(&s, WO_CLIP_SOURCE, 4), colour);
        picture_fill(scene_clip(&s, WO_CLIP_DEPTH, 1), (const float[1]){1.25f});
        wo_image out = scene_render(&s, NULL);
        for (int32_t i = 0; i < 4 * WIDE * HIGH; i++)
            assert_near((double)out.data[i], (double)colour[i % 4], 1e-6);
        picture_free(&out);
        scene_free(&s);
    }
}

/* Premultiplied, unpremultiplied and without alpha: the same scene, the same picture. */
static void every_kind_of_alpha(void **state)
{
    (void)state;
    for (int method = 0; method < WO_METHOD_COUNT; method++) {
        scene s;
        scene_init(&s, frame);
        s.params.method = method;
        s.params.samples = samples_of(method);
        scene_fill_layers(&s, 2);
        wo_image *const source = &s.clip[WO_CLIP_SOURCE];
        s.alpha[WO_CLIP_SOURCE] = WO_ALPHA_PREMULTIPLIED;
        wo_image premultiplied = scene_render(&s, NULL);
        for (int32_t n = 0; n < WIDE * HIGH; n++)
            for (int k = 0; k < 3; k++)
                source->data[4 * n + k] /=
                    source->data[4 * n + 3] > 0 ? source->data[4 * n + 3] : 1;
        s.alpha[WO_CLIP_SOURCE] = WO_ALPHA_UNPREMULTIPLIED;
        wo_image straight = scene_render(&s, NULL);
        for (int32_t i = 0; i < 4 * WIDE * HIGH; i++)
            assert_near((double)straight.data[i], (double)premultiplied.data[i],
                        2e-5 * fmax(1, fabs((double)premultiplied.data[i])));
        picture_free(&premultiplied);
        picture_free(&straight);

        /* Opaque: with an alpha of 1, said to be opaque whatever it holds, and without one. */
        scene_fill_busy(&s, 2);
        picture_free(&s.clip[2]);
        picture_free(&s.clip[3]);
        s.alpha[WO_CLIP_SOURCE] = WO_ALPHA_PREMULTIPLIED;
        wo_image one = scene_render(&s, NULL);
        wo_image rgb = picture_make(frame, 3);
        for (int32_t n = 0; n < WIDE * HIGH; n++) {
            memcpy(rgb.data + 3 * n, source->data + 4 * n, 3 * sizeof *rgb.data);
            source->data[4 * n + 3] = 0.25f;
        }
        s.alpha[WO_CLIP_SOURCE] = WO_ALPHA_OPAQUE;
        wo_image said = scene_render(&s, NULL);
        assert_true(picture_same_bytes(&one, &said, frame));
        picture_free(&s.clip[WO_CLIP_SOURCE]);
        s.clip[WO_CLIP_SOURCE] = rgb;
        s.alpha[WO_CLIP_SOURCE] = WO_ALPHA_PREMULTIPLIED;
        wo_image without = scene_render(&s, NULL);
        assert_true(picture_same_bytes(&one, &without, frame));
        picture_free(&one);
        picture_free(&said);
        picture_free(&without);
        scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(opaque_stays_opaque),     cmocka_unit_test(opaque_whatever_the_depth),
        cmocka_unit_test(constant_stays_constant), cmocka_unit_test(even_coverage_stays),
        cmocka_unit_test(every_kind_of_alpha),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
