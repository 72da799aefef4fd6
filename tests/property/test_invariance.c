/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "effects/lens_blur_plan.h"

#include "cases.h"
#include "near.h"
#include "scenes.h"

#include <string.h>

static const wo_rect frame = {-13, -7, 147, 89};

/* Any depth, also steps, slopes and holes, in front of and behind the focus. */
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

/* A picture of one colour, whatever its depth, stays that colour, also where its light is bright
   enough for highlights. */
static void constant_stays_constant(void **state)
{
    (void)state;
    const float levels[] = {0.18f, 3.9f, 40, 3000};
    rng r = {1};
    for (size_t i = 0; i < (size_t)cases_of(4, 2) * WO_COUNT(levels); i++) {
        const float level = levels[i % WO_COUNT(levels)];
        const float c[4] = {level, 0.5f * level, 0.03f * level, 1};
        scene s;
        scene_init(&s, i < 4 ? frame : (wo_rect){3, 5, 50, 40});
        scene_px_per_dioptre(&s, 20);
        s.params.samples = 16;
        s.params.blades = (int32_t)i % 4 * 3;
        picture_fill(scene_clip(&s, WO_CLIP_SOURCE, 4), c);
        random_depth(&s, &r);
        wo_report report = {0};
        wo_image out = scene_render(&s, &report);
        assert_true(report.tiles[WO_TILE_MARCH] > 0);
        for (int32_t y = out.bounds.y1; y < out.bounds.y2; y++)
            for (int32_t x = out.bounds.x1; x < out.bounds.x2; x++) {
                const float *const p = wo_image_at(&out, x, y);
                for (int k = 0; k < 3; k++)
                    assert_near((double)p[k], (double)c[k], 1e-5 * (double)fmaxf(c[k], 1));
                assert_near((double)p[3], 1, 1e-6);
            }
        picture_free(&out);
        scene_free(&s);
    }
}

static void opaque_stays_opaque(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 6; i++) {
        scene s;
        scene_init(&s, frame);
        scene_px_per_dioptre(&s, i % 2 ? 12 : 60);
        s.params.samples = i < 5 ? 33 : 300;
        if (i & 2) /* the second layer is opaque behind the holes of the first */
            scene_fill_layers(&s, i);
        else
            scene_fill_busy(&s, i);
        if (i & 1)
            random_depth(&s, &(rng){i});
        wo_image out = scene_render(&s, NULL);
        assert_true(picture_finite(&out));
        double least = 1;
        double most = 0;
        for (int32_t y = out.bounds.y1; y < out.bounds.y2; y++)
            for (int32_t x = out.bounds.x1; x < out.bounds.x2; x++) {
                least = fmin(least, (double)wo_image_at(&out, x, y)[3]);
                most = fmax(most, (double)wo_image_at(&out, x, y)[3]);
            }
        assert_at_most(1 - least, 1e-6);
        assert_at_most(most, 1);
        picture_free(&out);
        scene_free(&s);
    }
}

/* The same scene with every coordinate moved. */
static void move(scene *s, int32_t dx, int32_t dy)
{
    wo_rect *const rects[] = {&s->geometry.extent, &s->geometry.format};
    for (size_t i = 0; i < WO_COUNT(rects); i++)
        *rects[i] =
            (wo_rect){rects[i]->x1 + dx, rects[i]->y1 + dy, rects[i]->x2 + dx, rects[i]->y2 + dy};
    for (int i = 0; i < WO_LENS_BLUR_CLIPS; i++)
        if (s->clip[i].data)
            s->clip[i].bounds = s->geometry.extent;
}

/* Neighbouring tiles use different lens rays, so that no pattern shows; with one pencil for all of
   them what is left must not depend on the place. */
static wo_image render_one_pencil(const scene *s)
{
    const wo_context context = WO_CONTEXT_INIT;
    const wo_plan_args args = scene_args(s, s->geometry.extent);
    wo_plan *plan = NULL;
    assert_int_equal(wo_lens_blur.plan_create(&context, &s->params, &args, &plan, NULL), WO_OK);
    plan->lens.sets = 1;
    plan->level[plan->taps].sets = 1;
    wo_image out = picture_make(s->geometry.extent, 4);
    assert_int_equal(wo_lens_blur.render(plan, args.window, &out, NULL, NULL), WO_OK);
    wo_lens_blur.plan_destroy(&plan);
    return out;
}

static void scene_for_moves(scene *s)
{
    scene_init(s, frame);
    scene_px_per_dioptre(s, 12);
    s->params.max_radius = 15;
    s->params.samples = 48;
    scene_fill_layers(s, 11);
}

static void whole_tiles_move_exactly(void **state)
{
    (void)state;
    const int32_t by[][2] = {{64, 16}, {-64, 0}, {0, -16}, {320, 480}, {-3200, 4000}};
    scene s;
    scene_for_moves(&s);
    wo_image still = render_one_pencil(&s);
    for (size_t i = 0; i < WO_COUNT(by); i += (size_t)cases_of(1, 2)) {
        move(&s, by[i][0], by[i][1]);
        wo_image moved = render_one_pencil(&s);
        moved.bounds = still.bounds;
        assert_true(picture_same_bytes(&moved, &still, still.bounds));
        picture_free(&moved);
        move(&s, -by[i][0], -by[i][1]);
    }
    picture_free(&still);
    scene_free(&s);
}

/* The picture moves along with the scene up to the noise that another seed would make, too. */
static void any_move_stays_within_noise(void **state)
{
    (void)state;
    const int32_t by[][2] = {{1, 0}, {0, 1}, {3, 5}, {-17, 9}, {32, 16}};
    scene s;
    scene_for_moves(&s);
    wo_image still = scene_render(&s, NULL);
    s.params.seed = 1;
    wo_image other = scene_render(&s, NULL);
    s.params.seed = 0;
    const double noise = picture_rms(&other, &still, still.bounds);
    for (size_t i = 0; i < WO_COUNT(by); i += (size_t)cases_of(1, 2)) {
        move(&s, by[i][0], by[i][1]);
        wo_image moved = scene_render(&s, NULL);
        moved.bounds = still.bounds;
        assert_at_most(picture_rms(&moved, &still, still.bounds), 1.2 * noise);
        picture_free(&moved);
        move(&s, -by[i][0], -by[i][1]);
    }
    /* The check would see a picture that lags behind by one pixel. */
    wo_image late = still;
    late.bounds.x1++;
    late.bounds.x2++;
    const wo_rect both = wo_rect_intersect(late.bounds, still.bounds);
    assert_true(picture_rms(&late, &still, both) > 2 * noise);
    picture_free(&other);
    picture_free(&still);
    scene_free(&s);
}

/* Views without noise move exactly, whatever the distance. */
static void views_move_exactly(void **state)
{
    (void)state;
    const int32_t outputs[] = {WO_OUTPUT_COC, WO_OUTPUT_DEPTH};
    for (size_t i = 0; i < WO_COUNT(outputs); i++) {
        scene s;
        scene_for_moves(&s);
        s.params.output = outputs[i];
        wo_image still = scene_render(&s, NULL);
        move(&s, 7, -19);
        wo_image moved = scene_render(&s, NULL);
        moved.bounds = still.bounds;
        assert_true(picture_same_bytes(&moved, &still, still.bounds));
        picture_free(&moved);
        picture_free(&still);
        scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constant_stays_constant),  cmocka_unit_test(opaque_stays_opaque),
        cmocka_unit_test(whole_tiles_move_exactly), cmocka_unit_test(any_move_stays_within_noise),
        cmocka_unit_test(views_move_exactly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
