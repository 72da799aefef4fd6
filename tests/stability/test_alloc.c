/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "cases.h"
#include "defocus/renderer.h"
#include "near.h"
#include "optics/lens_choice.h"
#include "scenes.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

static const wo_rect small = {-3, -2, 45, 30};

/* Counts what is taken and given back; the call number fail_at gets nothing. */
typedef struct bank {
    atomic_long calls, live;
    long fail_at;
    size_t largest;
} bank;

static void *bank_get(void *user, size_t bytes)
{
    bank *b = user;
    const long call = atomic_fetch_add(&b->calls, 1);
    if (call == b->fail_at)
        return NULL;
    void *memory =
        aligned_alloc(WO_ALIGNMENT, (bytes + WO_ALIGNMENT - 1) / WO_ALIGNMENT * WO_ALIGNMENT);
    assert_non_null(memory);
    memset(memory, 0xa5, bytes);
    atomic_fetch_add(&b->live, 1);
    b->largest = bytes > b->largest ? bytes : b->largest;
    return memory;
}

static void bank_put(void *user, void *memory)
{
    bank *b = user;
    if (memory)
        atomic_fetch_sub(&b->live, 1);
    free(memory);
}

static wo_context context_of(bank *b, long fail_at)
{
    *b = (bank){.fail_at = fail_at};
    wo_context context = WO_CONTEXT_INIT;
    context.allocator = (wo_allocator){b, bank_get, bank_put};
    return context;
}

/* Two layers, a clean plate, edges, hidden surfaces, highlights, a mask: every part of the plan is
 * made. */
static scene two_layers(void)
{
    scene s;
    scene_init(&s, small);
    s.params.samples = 4;
    s.params.max_radius = 24;
    scene_px_per_dioptre(&s, 14);
    scene_fill_layers(&s, 2);
    picture_fill(scene_clip(&s, WO_CLIP_MASK, 1), (const float[1]){1});
    picture_fill(scene_clip(&s, WO_CLIP_BACKGROUND, 4), (const float[4]){0.5f, 0.5f, 0.5f, 1});
    return s;
}

static void fail_each_allocation(int32_t lens, int32_t method)
{
    scene s = two_layers();
    s.params.method = method;
    s.params.lens = lens;
    s.params.wavelengths = 3;
    const wo_plan_args args = scene_args(&s, small);
    bank b;
    wo_context context = context_of(&b, -1);
    wo_plan *plan = NULL;
    assert_int_equal(wo_lens_blur.plan_create(&context, &s.params, &args, &plan, NULL), WO_OK);
    char text[4096];
    assert_true(wo_lens_blur.plan_print(plan, text, sizeof text) > 0);
    const bool cast = lens != WO_LENS_THIN && method == WO_METHOD_REFERENCE;
    assert_true(cast || !strstr(text, "highlights  0"));
    assert_true(lens == WO_LENS_THIN || strstr(text, "3 wavelengths"));
    const long planned = atomic_load(&b.calls);
    assert_true(planned > 15);
    wo_image out = picture_make(small, 4);
    assert_int_equal(wo_lens_blur.render(plan, small, &out, NULL, NULL), WO_OK);
    const long calls = atomic_load(&b.calls);
    assert_true(calls > planned);
    wo_image want = scene_render(&s, NULL);
    assert_true(picture_same_bytes(&out, &want, small));
    wo_lens_blur.plan_destroy(&plan);
    assert_int_equal(atomic_load(&b.live), 0);
    wo_lens_blur.plan_destroy(&plan);
    /* A method of many allocations makes them in the same few places: later ones by samples. Where
     * cases are few, methods in turns share those that all have. */
    const long every = cases_of(1, 2);
    for (long i = method % every; i < calls; i += i < planned ? every : 1 + (i - planned) / 12) {
        context = context_of(&b, i);
        wo_error error = {WO_OK, ""};
        plan = (wo_plan *)&b;
        wo_status status = wo_lens_blur.plan_create(&context, &s.params, &args, &plan, &error);
        if (status == WO_OK)
            status = wo_lens_blur.render(plan, small, &out, NULL, &error);
        if (i >= planned)
            wo_lens_blur.plan_destroy(&plan);
        if (status != WO_ERR_NOMEM)
            print_error("allocation %ld of %ld: status %d\n", i, calls, (int)status);
        assert_int_equal(status, WO_ERR_NOMEM);
        assert_int_equal(error.status, WO_ERR_NOMEM);
        assert_non_null(strstr(error.text, "memory"));
        assert_null(plan);
        assert_int_equal(atomic_load(&b.live), 0);
    }
    picture_free(&out);
    picture_free(&want);
    scene_free(&s);
}

static void every_allocation_fails_once(void **state)
{
    (void)state;
    for (int32_t method = 0; method < WO_METHOD_COUNT; method++) {
        fail_each_allocation(WO_LENS_THIN, method);
        fail_each_allocation(WO_LENS_THICK, method);
    }
}

static void the_limit_of_one_allocation(void **state)
{
    (void)state;
    scene s = two_layers();
    bank b;
    wo_context context = context_of(&b, -1);
    wo_image out = picture_make(small, 4);
    assert_int_equal(scene_run(&s, &context, small, &out, NULL, NULL), WO_OK);
    const size_t largest = b.largest;
    context.max_bytes = largest;
    assert_int_equal(scene_run(&s, &context, small, &out, NULL, NULL), WO_OK);
    for (size_t limit = largest - 1; limit > 0; limit /= 3) {
        context.max_bytes = limit;
        wo_error error = {WO_OK, ""};
        assert_int_equal(scene_run(&s, &context, small, &out, NULL, &error), WO_ERR_NOMEM);
        assert_non_null(strstr(error.text, "limit"));
        assert_int_equal(atomic_load(&b.live), 0);
    }
    picture_free(&out);
    scene_free(&s);
}

typedef struct stopper {
    atomic_long polls;
    long stop_at;
} stopper;

static bool aborted(void *user)
{
    stopper *stop = user;
    return atomic_fetch_add(&stop->polls, 1) >= stop->stop_at;
}

/* Stopped at every moment in turn, with one thread and with three. */
static void stopped_at_every_poll(void **state)
{
    (void)state;
    scene s = two_layers();
    const unsigned threads[] = {1, 3};
    for (size_t t = 0; t < 2 * WO_METHOD_COUNT; t++) {
        s.params.method = (int32_t)(t / 2);
        s.params.samples = s.params.method == WO_METHOD_REFERENCE ? 1 : 4;
        wo_image want = scene_render(&s, NULL);
        long polls = 1;
        for (long n = 0; n <= polls; n += 1 + polls / cases_of(8, 4)) {
            bank b;
            stopper stop = {.stop_at = n == 0 ? 1000000 : n - 1};
            wo_context context = context_of(&b, -1);
            context.runner = threads_runner(&threads[t % 2]);
            context.abort_user = &stop;
            context.aborted = aborted;
            wo_image out = picture_make(small, 4);
            wo_report report = {0};
            wo_error error = {WO_OK, ""};
            const wo_status status = scene_run(&s, &context, small, &out, &report, &error);
            if (n == 0) {
                assert_int_equal(status, WO_OK);
                polls = atomic_load(&stop.polls);
                assert_true(polls > 30);
            } else {
                assert_int_equal(status, WO_ABORTED);
            }
            if (status == WO_OK)
                assert_true(picture_same_bytes(&out, &want, small));
            assert_int_equal(atomic_load(&b.live), 0);
            picture_free(&out);
        }
        picture_free(&want);
    }
    scene_free(&s);
}

/* Enough polls: the longest stretch of work between two of them is short. */
static void polls_are_frequent(void **state)
{
    (void)state;
    scene s = two_layers();
    s.params.samples = 5000;
    stopper stop = {.stop_at = 1000000000};
    wo_context context = WO_CONTEXT_INIT;
    context.abort_user = &stop;
    context.aborted = aborted;
    wo_image out = picture_make(small, 4);
    wo_report report = {0};
    assert_int_equal(scene_run(&s, &context, small, &out, &report, NULL), WO_OK);
    /* A millisecond is some 20000 rays of the slowest kernel. */
    assert_at_most((double)report.rays / (double)atomic_load(&stop.polls), 20000);
    picture_free(&out);
    scene_free(&s);
}

/* Progress only rises, and ends at 1. */
static void note_progress(void *user, double fraction)
{
    double *const last = user;
    assert_true(fraction >= last[0] && fraction <= 1);
    last[0] = fraction;
}

static void progress_rises(void **state)
{
    (void)state;
    scene s = two_layers();
    double last[1] = {0};
    wo_context context = WO_CONTEXT_INIT;
    context.progress_user = last;
    context.progress = note_progress;
    wo_image out = picture_make(small, 4);
    assert_int_equal(scene_run(&s, &context, small, &out, NULL, NULL), WO_OK);
    assert_true(last[0] == 1);
    picture_free(&out);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_allocation_fails_once),
        cmocka_unit_test(the_limit_of_one_allocation),
        cmocka_unit_test(stopped_at_every_poll),
        cmocka_unit_test(polls_are_frequent),
        cmocka_unit_test(progress_rises),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
