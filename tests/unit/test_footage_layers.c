/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "footage_test.h"

#include "scenes.h"
#include "tests/property/cases.h"

static const double pi = 3.14159265358979323846;

/* Place of the front plane's edge in the picture. */
static double edge_of(const wo_footage *set)
{
    const wo_footage_options *const o = &set->options;
    return o->width / 2.0 + o->width * o->focal_mm / 36 * (double)WO_TWO_PLANES_EDGE;
}

/* Mean of sin(2 pi (p scale)) over [a, b]. */
static double mean_wave(double a, double b, double scale)
{
    const double w = 2 * pi * scale;
    return (cos(w * a) - cos(w * b)) / (w * (b - a));
}

/* The colour of a plane in a pixel, by integral calculus. */
static double wave_colour(const wo_footage *set, const wo_wave_plane *plane, int x, int y, int c)
{
    const wo_footage_options *const o = &set->options;
    const double m = plane->depth / (o->width * o->focal_mm / 36); /* metres per px */
    const double px = (x - o->width / 2.0) * m - plane->centre_x, py = (y - o->height / 2.0) * m;
    const double t = 0.5 + 0.25 * (mean_wave(px, px + m, plane->texture.scale) +
                                   mean_wave(py, py + m, plane->texture.scale));
    return plane->texture.a[c] + (plane->texture.b[c] - plane->texture.a[c]) * t;
}

static wo_footage *two_planes(int samples, int layers)
{
    return make_set(&(wo_footage_options){.scene = "two-planes",
                                          .width = 120,
                                          .height = 66,
                                          .samples = samples,
                                          .layers = layers},
                    2);
}

static void two_planes_have_their_depths_and_colours(void **state)
{
    (void)state;
    wo_footage *set = two_planes(64, 0);
    const double edge = edge_of(set);
    for (int y = 0; y < 66; y++)
        for (int x = 0; x < 120; x++) {
            const bool front = x + 0.5 < edge;
            const wo_wave_plane *const plane = &wo_two_planes[front ? 0 : 1];
            assert_true(fabs(*wo_image_at(&set->depth, x, y) / plane->depth - 1.0) < 1e-5);
            const float *const n = wo_image_at(&set->normal, x, y);
            assert_true(n[0] == 0 && n[1] == 0 && n[2] == 1);
            const float *const rgba = wo_image_at(&set->colour, x, y);
            assert_true(fabsf(rgba[3] - 1) < 1e-5f);
            if (fabs(x + 0.5 - edge) < 1)
                continue;
            for (int c = 0; c < 3; c++)
                assert_true(fabs(rgba[c] - wave_colour(set, plane, x, y, c)) < 0.004);
        }
    free_set(&set);
}

/* The front layer's coverage adds up to the place of the edge; behind it the other plane is whole,
   with its own depth and nothing of the front's colour. */
static void patches_are_honest_at_an_edge(void **state)
{
    (void)state;
    wo_footage *set = two_planes(64, 3);
    const double edge = edge_of(set);
    double covered = 0;
    for (int y = 0; y < 66; y++)
        for (int x = 0; x < 120; x++) {
            const double left = edge - x, share = left < 0 ? 0 : left > 1 ? 1 : left;
            const int back = share > 0 ? 1 : 0;
            const float *const front = wo_image_at(&set->layer[0], x, y);
            const float *const behind = wo_image_at(&set->layer[back], x, y);
            if (share > 0) {
                covered += front[3];
                assert_true(fabs(front[3] - share) < 0.03);
                assert_true(fabsf(*wo_image_at(&set->layer_depth[0], x, y) - WO_TWO_PLANES_FRONT) <
                            1e-5f);
                for (int c = 0; c < 3; c++) {
                    const double own = wave_colour(set, &wo_two_planes[0], x, y, c);
                    assert_true(fabs(front[c] - own * front[3]) < 0.03);
                }
            }
            assert_true(fabsf(behind[3] - 1) < 1e-5f);
            assert_true(fabsf(*wo_image_at(&set->layer_depth[back], x, y) - WO_TWO_PLANES_BACK) <
                        1e-4f);
            for (int c = 0; c < 3; c++) {
                const double own = wave_colour(set, &wo_two_planes[1], x, y, c);
                assert_true(fabs(behind[c] - own) < 0.02);
            }
            assert_true(wo_image_at(&set->layer[2], x, y)[3] == 0);
            assert_true(*wo_image_at(&set->layer_depth[2], x, y) == 0);
        }
    if (fabs(covered / 66 - edge) > 0.01)
        fail_msg("the edge is at %g px, the coverage says %g", edge, covered / 66);
    assert_int_equal(set->layer_pixels[0], 120 * 66);
    assert_int_equal(set->layer_pixels[1], 66 * (int)ceil(edge));
    free_set(&set);
}

/* Lays the layers over each other from back to front. */
static void composite(const wo_footage *set, int32_t x, int32_t y, double rgba[4])
{
    memset(rgba, 0, 4 * sizeof *rgba);
    for (int k = set->layer_count - 1; k >= 0; k--) {
        const float *const top = wo_image_at(&set->layer[k], x, y);
        for (int c = 0; c < 4; c++)
            rgba[c] = top[c] + (1 - (double)top[3]) * rgba[c];
    }
}

/* The cheapest to build first. */
static const char *const crowded[] = {"fence", "still-life", "night-lights"};

static void check_layers(const wo_footage *set)
{
    const wo_footage_options *const o = &set->options;
    for (int32_t y = 0; y < o->height; y++)
        for (int32_t x = 0; x < o->width; x++) {
            float before = 0;
            bool ended = false;
            for (int k = 0; k < set->layer_count; k++) {
                const float *const rgba = wo_image_at(&set->layer[k], x, y);
                const float z = *wo_image_at(&set->layer_depth[k], x, y);
                if (rgba[3] == 0) {
                    assert_true(rgba[0] == 0 && rgba[1] == 0 && rgba[2] == 0);
                    ended = true;
                    continue;
                }
                assert_false(ended);
                assert_true(rgba[3] > 0 && rgba[3] <= 1.00001f);
                for (int c = 0; c < 3; c++)
                    assert_true(rgba[c] >= 0 && isfinite(rgba[c]));
                if (o->peel == WO_FOOTAGE_PATCHES)
                    assert_true(z > before && isfinite(z));
                before = z;
            }
        }
}

/* The plain peel: its first layer is the pinhole, byte for byte, and its depths those of the
 * centre. */
static void hits_start_with_the_pinhole(void **state)
{
    (void)state;
    for (size_t i = 0; i < (size_t)cases_of(WO_COUNT(crowded), 1); i++) {
        wo_footage_options o = {.scene = crowded[i],
                                .width = 64,
                                .height = 36,
                                .layers = 4,
                                .samples = 8,
                                .peel = WO_FOOTAGE_HITS};
        wo_footage *set = make_set(&o, 4);
        check_layers(set);
        assert_true(same_bytes(&set->layer[0], &set->colour));
        assert_true(same_bytes(&set->layer_depth[0], &set->depth));
        int64_t deeper = 0;
        for (int32_t y = 0; y < 36; y++)
            for (int32_t x = 0; x < 64; x++)
                for (int k = 1; k < 4; k++) {
                    const float front = *wo_image_at(&set->layer_depth[k - 1], x, y);
                    const float z = *wo_image_at(&set->layer_depth[k], x, y);
                    assert_true(z == 0 || z > front);
                    deeper += z > 0;
                }
        assert_true(deeper > 64 * 36 / 3);
        o.layers = 1;
        o.peel = WO_FOOTAGE_PATCHES;
        wo_footage *one = i == 0 ? make_set(&o, 4) : NULL;
        assert_true(!one || same_bytes(&one->layer[0], &set->colour));
        free_set(&one);
        free_set(&set);
    }
}

/* The faces of solids that look away are peeled on request only. */
static void back_faces_are_a_choice(void **state)
{
    (void)state;
    wo_footage_options o = {
        .scene = "still-life", .width = 96, .height = 54, .layers = 4, .samples = 8};
    wo_footage *without = make_set(&o, 4);
    o.back_faces = true;
    wo_footage *with = make_set(&o, 4);
    check_layers(with);
    assert_true(same_bytes(&with->colour, &without->colour));
    assert_true(with->layer_pixels[2] > without->layer_pixels[2] + 96 * 54 / 10);
    free_set(&with);
    free_set(&without);
}

/* Whether a ray through the open lens that reaches the film anywhere in reach passes the front
   plane on its way to a place of the back one: in pinhole coordinates the edge moves by K u (v1 -
   v2) against it, |u| <= 1. The place is the right end of a pixel. */
static bool in_sight(double k, double edge, int x)
{
    const double slide = k * (1 / (double)WO_TWO_PLANES_FRONT - 1 / (double)WO_TWO_PLANES_BACK);
    return x + 1 + slide > edge;
}

static void umbra_drops_what_no_ray_reaches(void **state)
{
    (void)state;
    static const double f_stops[] = {1.4, 4.2, 4.5, 6, 11, 1e5};
    for (size_t i = 0; i < WO_COUNT(f_stops); i++) {
        wo_footage_options o = {.scene = "two-planes",
                                .width = 120,
                                .height = 66,
                                .layers = 2,
                                .samples = 16,
                                .f_stop = f_stops[i]};
        wo_footage *all = make_set(&o, 4);
        o.umbra = true;
        wo_footage *some = make_set(&o, 4);
        const double k = 120 * 50.0 / 36 * 0.05 / (2 * f_stops[i]), edge = edge_of(all);
        const double slide = k * (1 / 0.8 - 1 / 4.0);
        int64_t dropped = 0;
        for (int y = 0; y < 66; y++)
            for (int x = 0; x < 120; x++) {
                const bool had = wo_image_at(&all->layer[1], x, y)[3] > 0;
                const bool has = wo_image_at(&some->layer[1], x, y)[3] > 0;
                assert_true(memcmp(wo_image_at(&all->layer[0], x, y),
                                   wo_image_at(&some->layer[0], x, y), 4 * sizeof(float)) == 0);
                if (had && !has) {
                    dropped++;
                    assert_false(in_sight(k, edge, x));
                } else {
                    assert_true(had == has);
                }
                /* And by the rule itself: whole neighbours on all sides, within the umbra. */
                const bool inside = x > 0 && y > 0 && y < 65 && x + 2 <= floor(edge);
                if (had)
                    assert_true(has == !(inside && slide <= 1));
            }
        assert_int_equal(some->umbra_dropped, dropped);
        assert_int_equal(all->umbra_dropped, 0);
        assert_true(slide > 1 ? dropped == 0 : dropped > 1000);
        free_set(&all);
        free_set(&some);
    }
}

/* What is dropped makes room for deeper surfaces, and nothing else appears. */
static void umbra_moves_deeper_surfaces_up(void **state)
{
    (void)state;
    wo_footage_options o = {
        .scene = "fence", .width = 96, .height = 54, .layers = 4, .samples = 8, .f_stop = 8};
    wo_footage *all = make_set(&o, 4);
    o.umbra = true;
    wo_footage *some = make_set(&o, 4);
    check_layers(some);
    assert_true(some->umbra_dropped > 0);
    int64_t before = 0, after = 0;
    for (int k = 0; k < 4; k++) {
        before += all->layer_pixels[k];
        after += some->layer_pixels[k];
    }
    assert_true(after < before);
    assert_true(same_bytes(&all->colour, &some->colour));
    free_set(&all);
    free_set(&some);
}

/* Layers over each other are the pinhole picture. */
static void check_composite(const wo_footage *set)
{
    for (int32_t y = 0; y < set->options.height; y++)
        for (int32_t x = 0; x < set->options.width; x++) {
            double rgba[4];
            const float *const whole = wo_image_at(&set->colour, x, y);
            composite(set, x, y, rgba);
            for (int c = 0; c < 4; c++)
                if (!(fabs(rgba[c] - whole[c]) < 1e-4 * (whole[c] + 1)))
                    fail_msg("%s at %d %d: %g for %g", set->options.scene, x, y, rgba[c], whole[c]);
        }
}

/* Every scene is whole: something everywhere (but for the lamp in the dark), finite and not black;
   its layers are ordered by depth, filled from the front, and together the pinhole picture. */
static void scenes_fill_the_picture(void **state)
{
    (void)state;
    for (size_t i = 0; wo_footage_scene_at(i); i++) {
        const char *const name = wo_footage_scene_at(i)->name;
        wo_footage *set = make_set(&(wo_footage_options){.scene = name,
                                                         .width = 96,
                                                         .height = 54,
                                                         .samples = 16,
                                                         .layers = 4,
                                                         .reference_spp = 16,
                                                         .seed = 9},
                                   4);
        double light = 0;
        check_layers(set);
        check_composite(set);
        for (int32_t y = 0; y < 54; y++)
            for (int32_t x = 0; x < 96; x++) {
                const float *const seen[2] = {wo_image_at(&set->colour, x, y),
                                              wo_image_at(&set->reference, x, y)};
                for (int k = 0; k < 2; k++)
                    for (int c = 0; c < 4; c++)
                        assert_true(isfinite(seen[k][c]) && seen[k][c] >= 0);
                light += seen[1][1];
                if (strcmp(name, "lamp") == 0)
                    continue;
                assert_true(fabsf(seen[0][3] - 1) < 1e-4f && fabsf(seen[1][3] - 1) < 1e-4f);
                assert_true(*wo_image_at(&set->depth, x, y) > 0.1f);
                const float *const n = wo_image_at(&set->normal, x, y);
                assert_true(fabsf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 1e-3f);
            }
        if (!(light > 1))
            fail_msg("%s is black", name);
        free_set(&set);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_planes_have_their_depths_and_colours),
        cmocka_unit_test(patches_are_honest_at_an_edge),
        cmocka_unit_test(hits_start_with_the_pinhole),
        cmocka_unit_test(back_faces_are_a_choice),
        cmocka_unit_test(umbra_drops_what_no_ray_reaches),
        cmocka_unit_test(umbra_moves_deeper_surfaces_up),
        cmocka_unit_test(scenes_fill_the_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
