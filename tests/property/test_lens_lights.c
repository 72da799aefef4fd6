/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/renderer.h"
#include "near.h"
#include "optics/lens_choice.h"
#include "scenes.h"

/* Lamps behind the focus, through lenses with a table; the right half of the picture lies behind an
   edge in front of the focus, which hides part of the second lamp's disc. */
enum { WIDE = 128, HIGH = 64, NEAR_X = 72 };
static const int32_t lamps[][2] = {{30, 20}, {68, 32}, {110, 50}};

static void make_scene(scene *s, int kind, bool hidden)
{
    scene_init(s, (wo_rect){0, 0, WIDE, HIGH});
    s->params.lens = kind;
    s->params.focus_distance = 0.25;
    s->params.sensor_width = 24;
    s->params.best_focus = 0;
    s->params.f_stop = 2;
    s->params.samples = 16;
    s->params.wavelengths = 1;
    wo_image *const back = scene_clip(s, 2, 4);
    picture_fill(back, (const float[4]){0.05f, 0.05f, 0.05f, 1});
    picture_fill(scene_clip(s, 3, 1), (const float[1]){20});
    for (size_t i = 0; i < WO_COUNT(lamps); i++)
        for (int32_t k = 0; k < 4; k++)
            for (int c = 0; c < 3; c++)
                wo_image_at(back, lamps[i][0] + k % 2, lamps[i][1] + k / 2)[c] = 100;
    wo_image *const front = scene_clip(s, WO_CLIP_SOURCE, 4);
    picture_fill(scene_clip(s, WO_CLIP_DEPTH, 1), (const float[1]){0.17f});
    for (int32_t y = 0; y < HIGH && hidden; y++)
        for (int32_t x = NEAR_X; x < WIDE; x++)
            for (int c = 0; c < 4; c++)
                wo_image_at(front, x, y)[c] = c < 3 ? 0.02f : 1;
}

static double light_of(const wo_image *image, int32_t x1, int32_t x2)
{
    double sum = 0;
    for (int32_t y = 0; y < HIGH; y++)
        for (int32_t x = x1; x < x2; x++)
            sum += (double)wo_image_at(image, x, y)[1];
    return sum;
}

/* The difference of means over blocks of 4 x 4 px, over the largest mean. */
static double block_error(const wo_image *a, const wo_image *b)
{
    double square = 0;
    double peak = 0;
    for (int32_t y = 0; y < HIGH; y += 4)
        for (int32_t x = 0; x < WIDE; x += 4) {
            double sum[2] = {0};
            for (int k = 0; k < 16; k++) {
                sum[0] += (double)wo_image_at(a, x + k % 4, y + k / 4)[1];
                sum[1] += (double)wo_image_at(b, x + k % 4, y + k / 4)[1];
            }
            square += (sum[0] - sum[1]) * (sum[0] - sum[1]);
            peak = fmax(peak, sum[1]);
        }
    return sqrt(square / (WIDE * HIGH / 16.0)) / peak;
}

/* Whatever hides a lamp from a part of the lens: the same light as by brute force. */
static void lamps_are_hidden_as_by_rays(void **state)
{
    (void)state;
    /* The same all over the picture: rays share one pencil over 64 px, drawn lamps do not. */
    static const int diagrams[] = {WO_DIAGRAM_SPHERICAL, WO_DIAGRAM_ASPHERICAL};
    for (size_t i = 0; i < WO_COUNT(diagrams); i++) {
        for (int hidden = 0; hidden < 2; hidden++) {
            scene s;
            make_scene(&s, WO_LENS_DIAGRAM, hidden);
            s.params.lens_diagram = diagrams[i];
            wo_image drawn = scene_render(&s, NULL);
            s.params.method = WO_METHOD_REFERENCE;
            s.params.samples = 1024;
            wo_image cast = scene_render(&s, NULL);
            assert_at_most(block_error(&drawn, &cast), 0.02);
            assert_close(light_of(&drawn, 0, NEAR_X), light_of(&cast, 0, NEAR_X), 0.015);
            assert_close(light_of(&drawn, NEAR_X, WIDE), light_of(&cast, NEAR_X, WIDE), 0.015);
            picture_free(&cast);
            picture_free(&drawn);
            scene_free(&s);
        }
    }
}

/* A window of the picture, planned by itself, and any number of threads make the same bytes. */
static void windows_and_threads(void **state)
{
    (void)state;
    scene s;
    make_scene(&s, WO_LENS_SINGLET, true);
    wo_image whole = scene_render(&s, NULL);
    const unsigned threads[] = {1, 3};
    for (size_t i = 0; i < WO_COUNT(threads); i++) {
        wo_context context = WO_CONTEXT_INIT;
        context.runner = threads_runner(&threads[i]);
        wo_image out = picture_make(whole.bounds, 4);
        const int32_t step = 23 + 30 * (int32_t)i;
        for (int32_t y = 0; y < HIGH; y += step)
            for (int32_t x = 0; x < WIDE; x += step) {
                const wo_rect window =
                    wo_rect_intersect((wo_rect){x, y, x + step, y + step}, whole.bounds);
                assert_int_equal(scene_run(&s, &context, window, &out, NULL, NULL), WO_OK);
            }
        assert_true(picture_same_bytes(&out, &whole, whole.bounds));
        picture_free(&out);
    }
    picture_free(&whole);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lamps_are_hidden_as_by_rays),
        cmocka_unit_test(windows_and_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
