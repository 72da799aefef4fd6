/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_runner.h"

#include <stdatomic.h>

enum { WORKERS_MAX = 256 };

typedef struct work {
    void (*func)(void *job, size_t index, unsigned worker);
    void *job;
    size_t count;
    unsigned workers;
    atomic_size_t next;  /* first index nobody has taken */
    atomic_uint entered; /* threads that have come */
} work;

static void take_all(work *w, unsigned worker)
{
    for (;;) {
        const size_t index = atomic_fetch_add_explicit(&w->next, 1, memory_order_relaxed);
        if (index >= w->count)
            return;
        w->func(w->job, index, worker);
    }
}

/* Worker numbers are handed out here: the host's own may repeat, and it may send more threads than
   were asked for, or one after the other. */
static void enter(unsigned thread, unsigned threads, void *custom)
{
    work *const w = custom;
    (void)thread;
    (void)threads;
    const unsigned worker = atomic_fetch_add_explicit(&w->entered, 1, memory_order_relaxed);
    if (worker < w->workers)
        take_all(w, worker);
}

static unsigned workers(void *user)
{
    const wo_ofx_threads *const threads = user;
    return threads->workers;
}

static void run(void *user, void (*func)(void *job, size_t index, unsigned worker), void *job,
                size_t count)
{
    const wo_ofx_threads *const threads = user;
    work w = {.func = func, .job = job, .count = count, .workers = threads->workers};
    atomic_init(&w.next, 0);
    atomic_init(&w.entered, 0);

    /* The status tells nothing more: what no thread took, because the host refused or sent none, is
       done here, when all of them are back. */
    if (threads->suite && threads->workers > 1 && count > 1)
        threads->suite->multiThread(
            enter, count < threads->workers ? (unsigned)count : threads->workers, &w);
    take_all(&w, 0);
}

wo_ofx_threads wo_ofx_threads_of(const wo_ofx_suites *suites)
{
    const OfxMultiThreadSuiteV1 *const suite = suites->thread;
    unsigned count = 1;
    if (!suite || !suite->multiThread || !suite->multiThreadNumCPUs ||
        (suite->multiThreadIsSpawnedThread && suite->multiThreadIsSpawnedThread()) ||
        suite->multiThreadNumCPUs(&count) != kOfxStatOK || count < 2)
        return (wo_ofx_threads){NULL, 1};
    return (wo_ofx_threads){suite, count < WORKERS_MAX ? count : WORKERS_MAX};
}

wo_runner wo_ofx_runner(wo_ofx_threads *threads)
{
    return (wo_runner){threads, workers, run};
}
