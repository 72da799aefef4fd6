/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "cases.h"
#include "focus/focus.h"
#include "near.h"
#include "optics/lens_choice.h"
#include "scenes.h"

#include <string.h>

/* Focus control of LensBlur as a whole: from depth under the points to the picture. */

static void set_point(scene *s, int i, double px, double py)
{
    s->params.focus_point[i][0] = px;
    s->params.focus_point[i][1] = py;
}

/* A chart on a plane that runs away from the camera to the upper right. */
static void slanted_chart(scene *s, wo_rect extent)
{
    scene_init(s, extent);
    wo_image *const colour = scene_clip(s, WO_CLIP_SOURCE, 4);
    wo_image *const depth = scene_clip(s, WO_CLIP_DEPTH, 1);
    for (int32_t y = extent.y1; y < extent.y2; y++)
        for (int32_t x = extent.x1; x < extent.x2; x++) {
            float *const c = wo_image_at(colour, x, y);
            c[0] = c[1] = c[2] = (x / 3 + y / 4) & 1 ? 0.9f : 0.1f;
            c[3] = 1;
            const double u = (x + 0.5 - extent.x1) / wo_rect_width(extent);
            const double v = (y + 0.5 - extent.y1) / wo_rect_height(extent);
            *wo_image_at(depth, x, y) = (float)(1 / (1.4 - 0.5 * u - 0.6 * v));
        }
}

static double largest_coc(const wo_image *coc)
{
    double largest = 0;
    for (int32_t y = coc->bounds.y1; y < coc->bounds.y2; y++)
        for (int32_t x = coc->bounds.x1; x < coc->bounds.x2; x++)
            largest = fmax(largest, fabs((double)*wo_image_at(coc, x, y)));
    return largest;
}

static void a_slanted_plane_is_sharp_all_over(void **state)
{
    (void)state;
    const wo_rect extents[] = {{0, 0, 160, 90}, {-30, 11, 170, 101}};
    const double scales[] = {1, 0.5};
    for (int n = 0; n < 4; n++) {
        scene s;
        slanted_chart(&s, extents[n / 2]);
        const double scale = s.geometry.render_scale = scales[n % 2];
        s.geometry.pixel_stretch = n == 3 ? 0.5 : 1;
        scene_px_per_dioptre(&s, 30);
        s.params.samples = 16;
        s.params.focus_by = WO_FOCUS_BY_PLANE;
        s.params.breathing = n & 1;
        /* Canonical coordinates of places in px from the corner. */
        const double stretch = s.geometry.pixel_stretch;
        const double aspect = s.geometry.pixel_aspect = n & 1 ? 2 : 1;
        const double at[3][2] = {{20.3, 15.8}, {140, 30}, {70.5, 80}};
        for (int i = 0; i < 3; i++)
            set_point(&s, i, (extents[n / 2].x1 + at[i][0]) * aspect / scale,
                      (extents[n / 2].y1 / stretch + at[i][1]) * aspect / scale);
        s.params.output = WO_OUTPUT_COC;
        wo_image coc = scene_render(&s, NULL);
        assert_at_most(largest_coc(&coc), 0.05);
        s.params.output = WO_OUTPUT_IMAGE;
        wo_image out = scene_render(&s, NULL);
        assert_at_most(picture_difference(&out, &s.clip[WO_CLIP_SOURCE], out.bounds), 1e-6);
        /* Which no focus distance does. */
        s.params.focus_by = WO_FOCUS_BY_POINT;
        s.params.output = WO_OUTPUT_COC;
        picture_free(&coc);
        coc = scene_render(&s, NULL);
        assert_true(largest_coc(&coc) > 5);
        const int32_t x = (int32_t)(extents[n / 2].x1 + 20.3);
        const int32_t y = (int32_t)(extents[n / 2].y1 + 15.8 * s.geometry.pixel_stretch);
        assert_near((double)*wo_image_at(&coc, x, y), 0, 0.2);
        picture_free(&coc);
        picture_free(&out);
        scene_free(&s);
    }
}

/* What a disc of radius r round a place shows of sin(k . place): the mean, by quadrature. */
static double mean_over_disc(double kx, double ky, double phase, double r)
{
    enum { RINGS = 24, SPOKES = 48 };
    double sum = 0;
    for (int i = 0; i < RINGS; i++)
        for (int j = 0; j < SPOKES; j++) {
            const double rho = r * sqrt((i + 0.5) / RINGS);
            const double turn = 6.283185307179586 * (j + 0.5 * (i & 1)) / SPOKES;
            sum += sin(phase + rho * (kx * cos(turn) + ky * sin(turn)));
        }
    return sum / (RINGS * SPOKES);
}

/* A wall that stands upright in front of a tilted lens: through the sensor point x it is blurred by
   exactly the disc K |v - vf(x)| round x, though its pixels are counted from the focus at their
   own places. */
static void a_tilted_lens_blurs_a_wall_as_it_should(void **state)
{
    (void)state;
    const wo_rect extent = {0, 0, 240, 60};
    const double wave = 0.3;
    const double k = 60;
    for (int sign = -1; sign <= 1; sign += 2) {
        scene s;
        slanted_chart(&s, extent);
        scene_px_per_dioptre(&s, k);
        s.params.samples = 512;
        s.params.focus_by = WO_FOCUS_BY_PLANE;
        s.params.focus_points = 2;
        /* vf is 1/3 on the left, 1/3 + 0.6 on the right, where the wall is. */
        set_point(&s, 0, 120 - 100 * sign, 30);
        set_point(&s, 1, 120 + 100 * sign, 30);
        s.params.focus_offset[0] = -0.5;
        s.params.focus_offset[1] = 0.4;
        const float three = 3;
        picture_fill(&s.clip[WO_CLIP_DEPTH], &three);
        for (int32_t y = extent.y1; y < extent.y2; y++)
            for (int32_t x = extent.x1; x < extent.x2; x++)
                for (int i = 0; i < 3; i++)
                    wo_image_at(&s.clip[WO_CLIP_SOURCE], x, y)[i] =
                        (float)(1 + sin(wave * (x + 0.5)));
        wo_image out = scene_render(&s, NULL);
        double worst = 0;
        double upright = 0;
        for (int32_t x = 70; x < 170; x++) {
            const double w = (-0.5 + 0.9 * (0.5 + sign * (x + 0.5 - 120) / 200.0));
            const double got = (double)wo_image_at(&out, x, 30)[0] - 1;
            const double want = mean_over_disc(wave, 0, wave * (x + 0.5), k * fabs(w));
            /* With every pixel blurred for itself, the disc would not be round x. */
            worst = fmax(worst, fabs(got - want));
            upright = fmax(upright, fabs(want));
        }
        assert_true(upright > 0.9);
        assert_at_most(worst, 0.02);
        picture_free(&out);
        scene_free(&s);
    }
}

/* Focus control in all its ways over a scene of layers. */
enum { WAYS = 6 };
static void scene_of_way(scene *s, int way, wo_rect extent)
{
    scene_init(s, extent);
    scene_px_per_dioptre(s, 24);
    s->params.samples = 8;
    s->params.max_radius = 9;
    scene_fill_layers(s, (uint64_t)way);
    s->params.focus_by = way < 4 ? way : 0;
    s->params.focus_points = 5;
    rng r = {(uint64_t)way};
    for (int i = 0; i < WO_FOCUS_POINTS; i++) {
        set_point(s, i, rng_range(&r, -20, 200), rng_range(&r, -20, 120));
        s->params.focus_offset[i] = rng_range(&r, -0.1, 0.1);
        s->params.focus_weight[i] = rng_range(&r, 0.5, 2);
        s->params.focus_dof[i] = way == 3 ? rng_range(&r, 0, 2) : 1;
    }
    if (way == 0 || way == 3) {
        s->params.field_curvature = 0.3;
        s->params.protect_near = 0.05;
        s->params.protect_far = 0.3;
        s->params.near_gain = 1.5;
        s->params.far_gain = 0.7;
    }
    s->params.output = way == 1 ? WO_OUTPUT_COC : WO_OUTPUT_IMAGE;
    if (way < 4)
        return;
    s->params.focus_clip = way == 4 ? WO_FOCUS_MAP_DISTANCE : WO_FOCUS_MAP_RADIUS;
    wo_image *const map = scene_clip(s, WO_CLIP_FOCUS, way == 4 ? 1 : 4);
    for (int32_t y = extent.y1; y < extent.y2; y++)
        for (int32_t x = extent.x1; x < extent.x2; x++)
            *wo_image_at(map, x, y) =
                way == 4 ? (x % 7 ? 2 + 0.01f * (float)y : NAN) : (float)(x - y) * 0.05f;
}

static void tiles_are_the_whole(void **state)
{
    (void)state;
    const wo_context context = WO_CONTEXT_INIT;
    const wo_rect frame = {-21, 9, 140, 90};
    rng r = {7};
    for (int way = 0; way < WAYS; way++) {
        scene s;
        scene_of_way(&s, way, frame);
        wo_image whole = scene_render(&s, NULL);
        assert_true(picture_finite(&whole));
        for (int n = 0; n < cases_of(6, 3); n++)
            scene_check_window(&s, &context, random_window(&r, frame, 50, 40), &whole);
        picture_free(&whole);
        scene_free(&s);
    }
}

/* A point that leaves the frame: the focus goes over to the focus distance without a jump, and with
   Source alone. */
static void a_point_that_leaves_does_not_pop(void **state)
{
    (void)state;
    scene s;
    slanted_chart(&s, (wo_rect){0, 0, 64, 36});
    picture_free(&s.clip[WO_CLIP_DEPTH]);
    scene_px_per_dioptre(&s, 10);
    s.params.output = WO_OUTPUT_COC;
    s.params.focus_distance = 5; /* 0.2: 2 px */
    s.params.focus_offset[0] = 0.5;
    s.params.focus_fade = 0.5;
    for (int by = WO_FOCUS_BY_POINT; by < WO_FOCUS_BY_COUNT; by++) {
        double last = NAN;
        s.params.focus_by = by;
        s.params.focus_points = 1;
        for (int px = 60; px < 90; px++) {
            set_point(&s, 0, px, 18);
            wo_image coc = scene_render(&s, NULL);
            const double c = (double)*wo_image_at(&coc, 32, 18);
            assert_true(px > 60 || fabs(c + 5) < 1e-5);
            assert_true(px < 64 + 19 || fabs(c + 2) < 1e-5);
            assert_true(px == 60 || fabs(c - last) < 0.3);
            last = c;
            picture_free(&coc);
        }
    }
    scene_free(&s);
}

static void a_clip_drives_the_focus(void **state)
{
    (void)state;
    scene s;
    slanted_chart(&s, (wo_rect){0, 0, 96, 40});
    scene_px_per_dioptre(&s, 20);
    s.params.output = WO_OUTPUT_COC;
    s.geometry.render_scale = 0.5;
    wo_image *const map = scene_clip(&s, WO_CLIP_FOCUS, 1);
    for (int32_t y = 0; y < 40; y++)
        for (int32_t x = 0; x < 96; x++)
            *wo_image_at(map, x, y) = (float)(x - 48) * 0.25f;
    s.params.focus_clip = WO_FOCUS_MAP_RADIUS;
    for (int depth = 0; depth < 2; depth++) {
        s.params.use_depth = depth;
        wo_image coc = scene_render(&s, NULL);
        for (int32_t x = 0; x < 96; x++)
            assert_near((double)*wo_image_at(&coc, x, 7), (x - 48) * 0.125, 1e-5);
        picture_free(&coc);
    }
    /* What lies at the distance that the clip says is sharp. */
    s.params.focus_clip = WO_FOCUS_MAP_DISTANCE;
    picture_fill(map, (const float[1]){0});
    for (int32_t y = 0; y < 40; y++)
        for (int32_t x = 0; x < 96; x++)
            *wo_image_at(map, x, y) = *wo_image_at(&s.clip[WO_CLIP_DEPTH], x, y);
    wo_image coc = scene_render(&s, NULL);
    assert_at_most(largest_coc(&coc), 1e-5);
    picture_free(&coc);
    s.params.focus_clip = WO_FOCUS_MAP_OFF;
    coc = scene_render(&s, NULL);
    assert_true(largest_coc(&coc) > 1);
    picture_free(&coc);
    scene_free(&s);
}

/* The view of the focus: the colour says on which side of it a pixel is. */
static void the_view_shows_the_side(void **state)
{
    (void)state;
    scene s;
    slanted_chart(&s, (wo_rect){0, 0, 96, 40});
    scene_px_per_dioptre(&s, 20);
    s.params.focus_distance = 1.3;
    s.params.output = WO_OUTPUT_COC;
    wo_image coc = scene_render(&s, NULL);
    s.params.output = WO_OUTPUT_FOCUS;
    wo_image view = scene_render(&s, NULL);
    int seen[3] = {0};
    for (int32_t y = 0; y < 40; y++)
        for (int32_t x = 0; x < 96; x++) {
            const double c = (double)*wo_image_at(&coc, x, y);
            const float *const v = wo_image_at(&view, x, y);
            const int want = c > 0.5 ? 2 : c < -0.5 ? 0 : 1;
            for (int k = 0; k < 3; k++)
                assert_true(k == want || v[want] > v[k] + 0.05f);
            assert_true(v[3] == 1);
            seen[want]++;
        }
    for (int k = 0; k < 3; k++)
        assert_true(seen[k] > 100);
    picture_free(&coc);
    picture_free(&view);
    scene_free(&s);
}

/* With a traced lens, breathing and a point nearer than any lens can focus. */
static void any_lens_can_be_tilted(void **state)
{
    (void)state;
    scene s;
    slanted_chart(&s, (wo_rect){0, 0, 96, 54});
    scene_px_per_dioptre(&s, 20);
    s.params.samples = 32;
    s.params.focus_by = WO_FOCUS_BY_PLANE;
    set_point(&s, 0, 10, 10);
    set_point(&s, 1, 80, 10);
    set_point(&s, 2, 40, 45);
    s.params.lens = WO_LENS_SEIDEL;
    wo_image sharp = scene_render(&s, NULL);
    s.params.focus_by = WO_FOCUS_BY_POINT;
    wo_image blurred = scene_render(&s, NULL);
    wo_rect inner = wo_rect_grow(sharp.bounds, -8, -8);
    assert_true(picture_finite(&sharp));
    assert_true(picture_rms(&sharp, &s.clip[WO_CLIP_SOURCE], inner) <
                0.5 * picture_rms(&blurred, &s.clip[WO_CLIP_SOURCE], inner));
    picture_free(&sharp);
    picture_free(&blurred);
    s.params.lens = WO_LENS_THIN;
    s.params.breathing = 1;
    for (int by = WO_FOCUS_BY_POINT; by < WO_FOCUS_BY_COUNT; by++) {
        s.params.focus_by = by;
        for (int i = 0; i < 3; i++)
            s.params.focus_offset[i] = by == WO_FOCUS_BY_PLANE ? 1e6 * (i - 1) : 1e6;
        wo_image out = scene_render(&s, NULL);
        assert_true(picture_finite(&out));
        picture_free(&out);
    }
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_slanted_plane_is_sharp_all_over),
        cmocka_unit_test(a_tilted_lens_blurs_a_wall_as_it_should),
        cmocka_unit_test(tiles_are_the_whole),
        cmocka_unit_test(a_point_that_leaves_does_not_pop),
        cmocka_unit_test(a_clip_drives_the_focus),
        cmocka_unit_test(the_view_shows_the_side),
        cmocka_unit_test(any_lens_can_be_tilted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
