/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/point_spread.h"
#include "effects/lens_blur_plan.h"
#include "optics/lens_choice.h"

#include "cases.h"
#include "near.h"
#include "scenes.h"

#include <stdlib.h>

static const wo_rect frame = {-13, -7, 67, 49};

static scene spread_scene(wo_rect extent, double px_per_dioptre)
{
    scene s;
    scene_init(&s, extent);
    s.params.method = WO_METHOD_SPREAD;
    s.params.samples = 64;
    s.params.focus_distance = 2;
    scene_px_per_dioptre(&s, px_per_dioptre);
    return s;
}

static void fill_noise(wo_image *source, uint64_t seed)
{
    rng r = {seed};
    for (int32_t i = 0; i < wo_rect_width(source->bounds) * wo_rect_height(source->bounds); i++)
        for (int k = 0; k < 4; k++)
            source->data[4 * i + k] = k < 3 ? (float)rng_range(&r, 0.05, 3.5) : 1;
}

/* No lights. */
static void dim(wo_image *source)
{
    const int32_t n = wo_rect_width(source->bounds) * wo_rect_height(source->bounds);
    for (int32_t i = 0; i < 4 * n; i++)
        source->data[i] = fminf(source->data[i], 2);
}

/* Everything at the distance that is blurred by radius px; negative: nearer than the focus. */
static void level_depth(scene *s, double px_per_dioptre, double radius)
{
    picture_fill(scene_clip(s, WO_CLIP_DEPTH, 1),
                 (const float[1]){(float)(1 / (0.5 - radius / px_per_dioptre))});
}

static int32_t into(int32_t x, int32_t low, int32_t high)
{
    return x < low ? low : x >= high ? high - 1 : x;
}

/* Convolution with the raster, in double precision; edges repeated. */
static void convolve(const wo_image *source, const wo_point_raster *raster, int32_t x, int32_t y,
                     double c[3])
{
    const wo_rect r = raster->rect;
    const wo_rect b = source->bounds;
    const double *value = raster->value;
    c[0] = c[1] = c[2] = 0;
    for (int32_t ey = r.y1; ey < r.y2; ey++)
        for (int32_t ex = r.x1; ex < r.x2; ex++, value++) {
            const float *p =
                wo_image_at(source, into(x - ex, b.x1, b.x2), into(y - ey, b.y1, b.y2));
            for (int k = 0; k < 3; k++)
                c[k] += *value * (double)p[k];
        }
}

/* One distance: the picture convolved with the point spread, to 1e-5. */
static void one_distance_is_a_convolution(void **state)
{
    (void)state;
    const double px_per_dioptre = 180;
    const double radius[] = {0.3, 1.77, 7.93, -9.37, 24.41, -58.3};
    for (int kind = 0; kind < 4; kind++) {
        const int step = cases_of(1, 2);
        for (size_t i = (size_t)(kind % step); i < WO_COUNT(radius); i += (size_t)step) {
            scene s = spread_scene(frame, px_per_dioptre);
            s.params.blades = kind == 1 ? 5 : 0;
            s.params.obstruction = kind == 2 ? 0.4 : 0;
            s.params.apodization = kind == 3 ? 0.7 : 0;
            fill_noise(scene_clip(&s, WO_CLIP_SOURCE, 4), i);
            level_depth(&s, px_per_dioptre, radius[i]);
            wo_image out = scene_render(&s, NULL);
            const wo_context context = WO_CONTEXT_INIT;
            const wo_plan_args args = scene_args(&s, frame);
            wo_plan *plan = NULL;
            assert_int_equal(wo_lens_blur.plan_create(&context, &s.params, &args, &plan, NULL),
                             WO_OK);
            const double v = (double)plan->stack.v[0][0];
            assert_close(plan->lens.reach(plan->lens.self, v, v), fabs(radius[i]), 1e-4);
            wo_point_raster raster;
            assert_int_equal(wo_point_raster_create(&context, &plan->lens, 0, 0, v, &raster, NULL),
                             WO_OK);
            double worst = 0;
            for (int32_t y = frame.y1; y < frame.y2; y += 5)
                for (int32_t x = frame.x1; x < frame.x2; x += 5) {
                    double c[3];
                    convolve(&s.clip[WO_CLIP_SOURCE], &raster, x, y, c);
                    for (int k = 0; k < 3; k++)
                        worst = fmax(worst, fabs((double)wo_image_at(&out, x, y)[k] / c[k] - 1));
                }
            assert_at_most(worst, 1e-6);
            wo_point_raster_destroy(&context, &raster);
            wo_lens_blur.plan_destroy(&plan);
            picture_free(&out);
            scene_free(&s);
        }
    }
}

/* Nothing is left behind very bright light: beyond its reach not a bit changes. */
static void bright_light_leaves_no_residue(void **state)
{
    (void)state;
    const wo_rect wide = {0, 0, 256, 96};
    const float bright[] = {1e4f, 1e6f, 3e17f, 5e29f};
    for (size_t i = 0; i <= WO_COUNT(bright); i++) {
        static wo_image without;
        scene s = spread_scene(wide, 40);
        wo_image *const source = scene_clip(&s, WO_CLIP_SOURCE, 4);
        fill_noise(source, 3);
        level_depth(&s, 40, -10.6);
        /* An area: the light of single pixels is taken out as highlights. */
        const wo_rect lamp = {64, 32, 176, 72};
        for (int32_t y = lamp.y1; i > 0 && y < lamp.y2; y++)
            for (int32_t x = lamp.x1; x < lamp.x2; x++)
                for (int k = 0; k < 3; k++)
                    wo_image_at(source, x, y)[k] = bright[i - 1] * (1 + 0.1f * (float)(x & 3));
        wo_image out = scene_render(&s, NULL);
        assert_true(picture_finite(&out));
        if (i == 0) {
            without = out;
        } else {
            const wo_rect parts[] = {{0, 0, 256, 20}, {0, 0, 52, 96}, {188, 0, 256, 96}};
            for (size_t k = 0; k < WO_COUNT(parts); k++)
                assert_true(picture_same_bytes(&out, &without, parts[k]));
            assert_close((double)wo_image_at(&out, 120, 52)[0], 1.15 * (double)bright[i - 1], 0.02);
            picture_free(&out);
        }
        if (i == WO_COUNT(bright))
            picture_free(&without);
        scene_free(&s);
    }
}

static void random_depth(scene *s, rng *r)
{
    wo_image *const depth = scene_clip(s, WO_CLIP_DEPTH, 1);
    const int32_t size = rng_int(r, 1, 30);
    const uint64_t salt = rng_bits(r);
    const wo_rect e = s->geometry.extent;
    for (int32_t y = e.y1; y < e.y2; y++)
        for (int32_t x = e.x1; x < e.x2; x++) {
            rng patch = {salt + (uint64_t)((y - e.y1) / size) * 977 +
                         (uint64_t)((x - e.x1) / size)};
            const double z = exp(rng_range(&patch, log(0.7), log(40)));
            *wo_image_at(depth, x, y) = (float)(rng_unit(&patch) < 0.1 ? 0 : z + 0.01 * x);
        }
}

static void constant_stays_constant(void **state)
{
    (void)state;
    const float levels[] = {0.18f, 40, 3000, 1e-4f};
    rng r = {1};
    for (size_t i = 0; i < 8; i++) {
        const float level = levels[i % WO_COUNT(levels)];
        const float c[4] = {level, 0.5f * level, 0.03f * level, 1};
        scene s = spread_scene(frame, 20);
        s.params.blades = (int32_t)i % 4 * 3;
        s.params.lens = i == 7 ? WO_LENS_THICK : WO_LENS_THIN;
        picture_fill(scene_clip(&s, WO_CLIP_SOURCE, 4), c);
        random_depth(&s, &r);
        wo_image out = scene_render(&s, NULL);
        for (int32_t y = frame.y1; y < frame.y2; y++)
            for (int32_t x = frame.x1; x < frame.x2; x++) {
                const float *const p = wo_image_at(&out, x, y);
                for (int k = 0; k < 3; k++)
                    assert_close((double)p[k], (double)c[k], 1e-6);
                assert_true(p[3] == 1);
            }
        picture_free(&out);
        scene_free(&s);
    }
}

static void opaque_stays_opaque(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 6; i++) {
        scene s = spread_scene(frame, i % 2 ? 12 : 60);
        s.params.lens = i == 5 ? WO_LENS_THICK : WO_LENS_THIN;
        if (i & 2)
            scene_fill_layers(&s, i);
        else
            scene_fill_busy(&s, i);
        if (i & 1)
            random_depth(&s, &(rng){i});
        wo_image out = scene_render(&s, NULL);
        assert_true(picture_finite(&out));
        for (int32_t n = 0; n < wo_rect_width(frame) * wo_rect_height(frame); n++)
            assert_true(out.data[4 * n + 3] == 1);
        picture_free(&out);
        scene_free(&s);
    }
}

/* A square in front of nothing: coverage as rays find it, also within its outline. */
static void holes_stay_transparent(void **state)
{
    (void)state;
    const wo_rect wide = {0, 0, 128, 96};
    wo_image out[2];
    for (int method = 0; method < 2; method++) {
        scene s = spread_scene(wide, 40);
        s.params.method = method ? WO_METHOD_SPREAD : WO_METHOD_RAYS;
        s.params.samples = 1024;
        wo_image *const source = scene_clip(&s, WO_CLIP_SOURCE, 4);
        for (int32_t y = 24; y < 72; y++)
            for (int32_t x = 32; x < 96; x++)
                for (int k = 0; k < 4; k++)
                    wo_image_at(source, x, y)[k] = 1;
        level_depth(&s, 40, -12);
        out[method] = scene_render(&s, NULL);
        scene_free(&s);
    }
    assert_at_most(picture_difference(&out[0], &out[1], wide), 0.02);
    assert_at_most((double)wo_image_at(&out[1], 36, 48)[3], 0.8);
    picture_free(&out[0]);
    picture_free(&out[1]);
}

/* Light that passes two translucent surfaces far apart: over, not added. */
static void translucent_surfaces_lie_over_each_other(void **state)
{
    (void)state;
    scene s = spread_scene(frame, 40);
    const float half[4] = {0.5f, 0, 0, 0.5f};
    const float green[4] = {0, 0.5f, 0, 0.5f};
    const float blue[4] = {0, 0, 1, 1};
    const float z[3] = {1, 2.5f, 50};
    const float *const c[3] = {half, green, blue};
    s.params.layers = 3;
    for (int i = 0; i < 3; i++) {
        picture_fill(scene_clip(&s, 2 * i, 4), c[i]);
        picture_fill(scene_clip(&s, 2 * i + 1, 1), &z[i]);
    }
    wo_image out = scene_render(&s, NULL);
    for (int32_t n = 0; n < wo_rect_width(frame) * wo_rect_height(frame); n++) {
        assert_near((double)out.data[4 * n], 0.5, 1e-5);
        assert_near((double)out.data[4 * n + 1], 0.25, 1e-5);
        assert_near((double)out.data[4 * n + 2], 0.25, 1e-5);
    }
    picture_free(&out);
    scene_free(&s);
}

/* A slanted plane that goes through the focus hides what is behind it, without bands. */
static void a_slope_hides_what_is_behind(void **state)
{
    (void)state;
    const wo_rect wide = {0, 0, 256, 48};
    scene s = spread_scene(wide, 60);
    s.params.layers = 2;
    picture_fill(scene_clip(&s, WO_CLIP_SOURCE, 4), (const float[4]){0.2f, 0.2f, 0.2f, 1});
    picture_fill(scene_clip(&s, 2, 4), (const float[4]){2, 2, 2, 1});
    picture_fill(scene_clip(&s, 3, 1), (const float[1]){1000});
    wo_image *const depth = scene_clip(&s, WO_CLIP_DEPTH, 1);
    for (int32_t y = 0; y < 48; y++)
        for (int32_t x = 0; x < 256; x++)
            *wo_image_at(depth, x, y) = (float)(1 / (0.95 - 0.0035 * x));
    wo_image out = scene_render(&s, NULL);
    double worst = 0;
    for (int32_t n = 0; n < 256 * 48; n++)
        worst = fmax(worst, fabs((double)out.data[4 * n] - 0.2));
    assert_at_most(worst, 0.002);
    picture_free(&out);
    scene_free(&s);
}

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The radius grows from 0 to 2 px in steps of 0.05: no step shows. */
static void small_radii_grow_smoothly(void **state)
{
    (void)state;
    enum { STEPS = 40 };
    double step[STEPS];
    wo_image last = {0};
    for (int i = 0; i <= STEPS; i++) {
        scene s = spread_scene(frame, 40);
        scene_fill_busy(&s, 5);
        dim(&s.clip[WO_CLIP_SOURCE]);
        level_depth(&s, 40, -0.05 * i);
        wo_image out = scene_render(&s, NULL);
        if (i > 0)
            step[i - 1] = picture_rms(&out, &last, frame);
        picture_free(&last);
        last = out;
        scene_free(&s);
    }
    picture_free(&last);
    qsort(step, STEPS, sizeof *step, compare_doubles);
    print_message("largest step %g, median %g\n", step[STEPS - 1], step[STEPS / 2]);
    assert_at_most(step[STEPS - 1], 2 * step[STEPS / 2]);
}

static scene any_scene(int kind)
{
    scene s = spread_scene((wo_rect){-21, 9, 110, 65}, kind % 2 ? 14 : 45);
    s.params.blades = kind % 2 ? 6 : 0;
    s.params.max_radius = kind % 2 ? 7 : 100;
    s.params.lens = kind == 3 ? WO_LENS_THICK : WO_LENS_THIN;
    s.params.samples = kind == 3 ? 16 : 64;
    if (kind == 0)
        scene_fill_busy(&s, 7);
    else
        scene_fill_layers(&s, (uint64_t)kind);
    if (kind == 2)
        random_depth(&s, &(rng){5});
    /* Rays of a lens that cannot connect find lights by chance. */
    if (kind == 3)
        dim(&s.clip[WO_CLIP_SOURCE]);
    return s;
}

static void tiles_and_threads_change_nothing(void **state)
{
    (void)state;
    rng r = {7};
    for (int kind = 0; kind < 4; kind++) {
        scene s = any_scene(kind);
        const wo_rect extent = s.geometry.extent;
        wo_image whole = scene_render(&s, NULL);
        for (int n = 0; n < cases_of(5, 3); n++) {
            const unsigned threads = 1 + (unsigned)n % 3;
            wo_context context = WO_CONTEXT_INIT;
            context.runner = threads_runner(&threads);
            if (n < 2) /* whole numbers: the same on any machine */
                context.cpu = WO_CPU_BASE;
            const wo_rect window = n == 1 ? extent : random_window(&r, extent, 80, 40);
            scene_check_window(&s, &context, window, &whole);
        }
        picture_free(&whole);
        scene_free(&s);
    }
}

/* Against many rays. */
static void agrees_with_rays(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        scene s = any_scene(kind);
        const wo_rect extent = s.geometry.extent;
        s.params.samples = kind == 3 ? 64 : 256;
        wo_image got = scene_render(&s, NULL);
        s.params.method = WO_METHOD_RAYS;
        s.params.samples = 512;
        wo_image want = scene_render(&s, NULL);
        const double rms = picture_rms(&got, &want, extent);
        print_message("scene %d: %g from rays\n", kind, rms);
        assert_at_most(rms, 0.06);
        picture_free(&got);
        picture_free(&want);
        scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_distance_is_a_convolution),
        cmocka_unit_test(bright_light_leaves_no_residue),
        cmocka_unit_test(constant_stays_constant),
        cmocka_unit_test(opaque_stays_opaque),
        cmocka_unit_test(holes_stay_transparent),
        cmocka_unit_test(translucent_surfaces_lie_over_each_other),
        cmocka_unit_test(a_slope_hides_what_is_behind),
        cmocka_unit_test(small_radii_grow_smoothly),
        cmocka_unit_test(tiles_and_threads_change_nothing),
        cmocka_unit_test(agrees_with_rays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
