/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/renderer.h"
#include "near.h"
#include "optics/lens_choice.h"
#include "scenes.h"

#include <limits.h>
#include <pthread.h>
#include <stdatomic.h>
#include <string.h>

/* Every method on several threads: those of the runner inside one render, those of a host that asks
   for several windows of one plan at once, and one that says stop. Small enough for
   ThreadSanitizer; how it runs does not depend on the size. */

static const wo_rect frame = {-7, 3, 73, 43};

static void scene_make(scene *s, int method, bool traced)
{
    scene_init(s, frame);
    s->params.method = method;
    s->params.samples = method == WO_METHOD_REFERENCE ? 2 : 8;
    s->params.max_radius = 24;
    s->params.wavelengths = 3;
    if (traced)
        s->params.lens = WO_LENS_THICK;
    else
        scene_px_per_dioptre(s, 20);
    scene_fill_layers(s, 3);
    wo_image *const mask = scene_clip(s, WO_CLIP_MASK, 1);
    for (int32_t y = frame.y1; y < frame.y2; y++)
        for (int32_t x = frame.x1; x < frame.x2; x++)
            *wo_image_at(mask, x, y) = x < 10 ? 0 : 1;
}

static void runners_change_nothing(const scene *s, const wo_image *want)
{
    const unsigned counts[] = {2, 5};
    for (size_t i = 0; i < WO_COUNT(counts); i++) {
        wo_context context = WO_CONTEXT_INIT;
        context.runner = threads_runner(&counts[i]);
        wo_image out = picture_make(frame, 4);
        wo_report report = {0};
        assert_int_equal(scene_run(s, &context, frame, &out, &report, NULL), WO_OK);
        assert_true(picture_same_bytes(&out, want, frame));
        picture_free(&out);
    }
}

/* A host's thread: every third tile, with a report of its own. */
enum { TILE = 16, HOST_THREADS = 3 };
typedef struct host_thread {
    const wo_plan *plan;
    const wo_image *out;
    int first;
    wo_status worst;
} host_thread;

static void *render_tiles(void *user)
{
    host_thread *const t = user;
    int index = 0;
    for (int32_t y = frame.y1; y < frame.y2; y += TILE)
        for (int32_t x = frame.x1; x < frame.x2; x += TILE, index++) {
            const wo_rect tile = wo_rect_intersect((wo_rect){x, y, x + TILE, y + TILE}, frame);
            wo_report report = {0};
            wo_error error = {WO_OK, ""};
            if (index % HOST_THREADS != t->first)
                continue;
            const wo_status status = wo_lens_blur.render(t->plan, tile, t->out, &report, &error);
            t->worst = status != WO_OK ? status : t->worst;
        }
    return NULL;
}

static void windows_of_one_plan_at_once(const scene *s, const wo_image *want)
{
    const unsigned two = 2;
    wo_context context = WO_CONTEXT_INIT;
    context.runner = threads_runner(&two);
    const wo_plan_args args = scene_args(s, frame);
    wo_plan *plan = NULL;
    assert_int_equal(wo_lens_blur.plan_create(&context, &s->params, &args, &plan, NULL), WO_OK);
    wo_image out = picture_make(frame, 4);
    pthread_t threads[HOST_THREADS];
    host_thread jobs[HOST_THREADS];
    for (int i = 0; i < HOST_THREADS; i++) {
        jobs[i] = (host_thread){plan, &out, i, WO_OK};
        assert_int_equal(pthread_create(&threads[i], NULL, render_tiles, &jobs[i]), 0);
    }
    for (int i = 0; i < HOST_THREADS; i++) {
        assert_int_equal(pthread_join(threads[i], NULL), 0);
        assert_int_equal(jobs[i].worst, WO_OK);
    }
    assert_true(picture_same_bytes(&out, want, frame));
    picture_free(&out);
    wo_lens_blur.plan_destroy(&plan);
}

/* Says stop at the poll so many after the first, from whichever thread asks. */
typedef struct stopper {
    atomic_long polls;
    long stop_at;
} stopper;

static bool aborted(void *user)
{
    stopper *const stop = user;
    return atomic_fetch_add(&stop->polls, 1) >= stop->stop_at;
}

static void stopped_on_three_threads(const scene *s)
{
    const unsigned three = 3;
    long polls = LONG_MAX;
    for (int n = 0; n < 4; n++) {
        stopper stop = {.stop_at = n == 0 ? LONG_MAX : polls * n / 4};
        wo_context context = WO_CONTEXT_INIT;
        context.runner = threads_runner(&three);
        context.abort_user = &stop;
        context.aborted = aborted;
        wo_image out = picture_make(frame, 4);
        const wo_status status = scene_run(s, &context, frame, &out, NULL, NULL);
        assert_int_equal(status, n == 0 ? WO_OK : WO_ABORTED);
        polls = n == 0 ? atomic_load(&stop.polls) : polls;
        picture_free(&out);
    }
}

static void every_method(void **state)
{
    (void)state;
    for (int method = 0; method < WO_METHOD_COUNT; method++) {
        /* A lens that keeps its formula, and one that is traced. */
        for (int traced = 0; traced < 2; traced++) {
            scene s;
            scene_make(&s, method, traced);
            wo_image want = scene_render(&s, NULL);
            assert_true(picture_finite(&want));
            runners_change_nothing(&s, &want);
            windows_of_one_plan_at_once(&s, &want);
            if (!traced)
                stopped_on_three_threads(&s);
            picture_free(&want);
            scene_free(&s);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_method)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
