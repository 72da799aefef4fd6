/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/context.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const wo_context plain = {.cpu = 0};

static void memory_is_zeroed_and_aligned(void **state)
{
    (void)state;
    for (size_t size = 1; size < 5000; size = size * 3 + 1) {
        wo_error error = {WO_OK, ""};
        unsigned char *bytes = wo_new(&plain, &error, size, 1);
        assert_non_null(bytes);
        assert_int_equal((uintptr_t)bytes % WO_ALIGNMENT, 0);
        for (size_t i = 0; i < size; i++)
            assert_int_equal(bytes[i], 0);
        memset(bytes, 0xff, size);
        wo_delete(&plain, bytes);
    }
    wo_delete(&plain, NULL);
    wo_delete(NULL, NULL);
}

static void impossible_sizes_are_refused(void **state)
{
    (void)state;
    wo_error error = {WO_OK, ""};
    assert_null(wo_new(&plain, &error, 0, 8));
    assert_int_equal(error.status, WO_ERR_ARGUMENT);
    assert_null(wo_new(&plain, &error, 8, 0));
    assert_int_equal(error.status, WO_ERR_ARGUMENT);
    assert_null(wo_new(&plain, &error, SIZE_MAX / 2, 3));
    assert_int_equal(error.status, WO_ERR_NOMEM);
    assert_null(wo_new(&plain, &error, SIZE_MAX, SIZE_MAX));
    assert_int_equal(error.status, WO_ERR_NOMEM);
    /* Rounding up to the alignment must not wrap. */
    assert_null(wo_new(&plain, &error, SIZE_MAX, 1));
    assert_int_equal(error.status, WO_ERR_NOMEM);
    assert_null(wo_new(&plain, NULL, 0, 0));
}

static void the_limit_is_kept(void **state)
{
    (void)state;
    const wo_context context = {.max_bytes = 1000};
    wo_error error = {WO_OK, ""};
    void *memory = wo_new(&context, &error, 125, 8);
    assert_non_null(memory);
    wo_delete(&context, memory);
    assert_null(wo_new(&context, &error, 1001, 1));
    assert_int_equal(error.status, WO_ERR_NOMEM);
    assert_non_null(strstr(error.text, "1000"));
}

typedef struct heap {
    int live;
    int calls;
    size_t offset; /* makes the memory misaligned */
    bool empty;
} heap;

static void *heap_get(void *user, size_t bytes)
{
    heap *const h = user;
    h->calls++;
    if (h->empty)
        return NULL;
    char *memory = aligned_alloc(64, (bytes + 127) / 64 * 64);
    h->live++;
    return memory + h->offset;
}

static void heap_put(void *user, void *memory)
{
    heap *const h = user;
    h->live--;
    free((char *)memory - h->offset);
}

static void the_callers_allocator_is_used(void **state)
{
    (void)state;
    heap h = {0};
    const wo_context context = {.allocator = {&h, heap_get, heap_put}};
    wo_error error = {WO_OK, ""};
    int *numbers = wo_new(&context, &error, 10, sizeof *numbers);
    assert_non_null(numbers);
    assert_int_equal(numbers[9], 0);
    assert_int_equal(h.live, 1);
    wo_delete(&context, numbers);
    wo_delete(&context, NULL);
    assert_int_equal(h.live, 0);

    h.empty = true;
    assert_null(wo_new(&context, &error, 10, 1));
    assert_int_equal(error.status, WO_ERR_NOMEM);
    h.empty = false;
    h.offset = 8;
    assert_null(wo_new(&context, &error, 10, 1));
    assert_int_equal(error.status, WO_ERR_ARGUMENT);
    assert_int_equal(h.live, 0);
    assert_int_equal(h.calls, 3);
}

typedef struct trace {
    size_t order[8];
    unsigned workers[8];
    size_t calls;
} trace;

static void note(void *job, size_t index, unsigned worker)
{
    trace *const t = job;
    t->order[t->calls] = index;
    t->workers[t->calls++] = worker;
}

static void without_a_runner_work_is_serial(void **state)
{
    (void)state;
    trace t = {.calls = 0};
    wo_run(&plain, note, &t, 5);
    assert_int_equal(t.calls, 5);
    for (size_t i = 0; i < 5; i++) {
        assert_int_equal(t.order[i], i);
        assert_int_equal(t.workers[i], 0);
    }
    wo_run(NULL, note, &t, 2);
    assert_int_equal(t.calls, 7);
    wo_run(&plain, note, &t, 0);
    assert_int_equal(t.calls, 7);
    assert_int_equal(wo_workers(&plain), 1);
    assert_int_equal(wo_workers(NULL), 1);
}

static unsigned three(void *user)
{
    (void)user;
    return 3;
}

static unsigned none(void *user)
{
    (void)user;
    return 0;
}

static void backwards(void *user, void (*func)(void *job, size_t index, unsigned worker), void *job,
                      size_t count)
{
    ++*(int *)user;
    while (count-- > 0)
        func(job, count, (unsigned)(count % 3));
}

static void the_callers_runner_is_used(void **state)
{
    (void)state;
    int runs = 0;
    wo_context context = {.runner = {&runs, three, backwards}};
    trace t = {.calls = 0};
    wo_run(&context, note, &t, 4);
    assert_int_equal(runs, 1);
    assert_int_equal(t.calls, 4);
    assert_int_equal(t.order[0], 3);
    assert_int_equal(t.workers[1], 2);
    wo_run(&context, note, &t, 0);
    assert_int_equal(runs, 1);
    assert_int_equal(wo_workers(&context), 3);
    context.runner.workers = none;
    assert_int_equal(wo_workers(&context), 1);
    context.runner.workers = three;
    context.runner.run = NULL;
    assert_int_equal(wo_workers(&context), 1);
}

static bool is_set(void *user)
{
    return *(bool *)user;
}

static void abort_is_asked_for(void **state)
{
    (void)state;
    bool stop = false;
    const wo_context context = {.abort_user = &stop, .aborted = is_set};
    assert_false(wo_aborted(&plain));
    assert_false(wo_aborted(NULL));
    assert_false(wo_aborted(&context));
    stop = true;
    assert_true(wo_aborted(&context));
}

static void instruction_sets_obey_the_mask(void **state)
{
    (void)state;
    const int all = wo_cpu_detect(WO_CPU_AUTO);
    assert_int_equal(wo_cpu_detect(WO_CPU_BASE), WO_CPU_BASE);
    assert_int_equal(wo_cpu_detect(WO_CPU_AVX2), all & WO_CPU_AVX2);
    assert_int_equal(all & ~WO_CPU_AVX2, 0);
#if defined(__AVX2__) && defined(__FMA__)
    assert_int_equal(all, WO_CPU_AVX2);
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_is_zeroed_and_aligned),
        cmocka_unit_test(impossible_sizes_are_refused),
        cmocka_unit_test(the_limit_is_kept),
        cmocka_unit_test(the_callers_allocator_is_used),
        cmocka_unit_test(without_a_runner_work_is_serial),
        cmocka_unit_test(the_callers_runner_is_used),
        cmocka_unit_test(abort_is_asked_for),
        cmocka_unit_test(instruction_sets_obey_the_mask),
    };
    return cmocka_run_group_tests_name("context", tests, NULL, NULL);
}
