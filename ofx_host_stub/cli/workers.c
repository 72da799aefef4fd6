/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "workers.h"

#include <pthread.h>
#include <stdatomic.h>
#include <unistd.h>

enum { WORKERS_MAX = 256 };

typedef struct work {
    void (*func)(void *job, size_t index, unsigned worker);
    void *job;
    size_t count;
    atomic_size_t next;
} work;

typedef struct worker {
    work *work;
    unsigned number;
} worker;

static void *serve(void *user)
{
    const worker *const self = user;
    work *const w = self->work;
    size_t i;
    while ((i = atomic_fetch_add(&w->next, 1)) < w->count)
        w->func(w->job, i, self->number);
    return NULL;
}

static unsigned workers(void *user)
{
    return *(const unsigned *)user;
}

static void run(void *user, void (*func)(void *job, size_t index, unsigned worker), void *job,
                size_t count)
{
    const unsigned wanted = workers(user);
    work w = {.func = func, .job = job, .count = count};
    worker each[WORKERS_MAX];
    pthread_t threads[WORKERS_MAX];
    unsigned started = 0;
    atomic_init(&w.next, 0);
    for (unsigned i = 0; i < wanted; i++)
        each[i] = (worker){&w, i};
    /* The caller is worker 0. */
    while (started + 1 < wanted &&
           pthread_create(&threads[started], NULL, serve, &each[started + 1]) == 0)
        started++;
    serve(&each[0]);
    while (started > 0)
        pthread_join(threads[--started], NULL);
}

wo_runner wo_workers_make(unsigned *count)
{
    if (*count == 0) {
        const long cores = sysconf(_SC_NPROCESSORS_ONLN);
        *count = cores > 0 ? (unsigned)cores : 1;
    }
    if (*count > WORKERS_MAX)
        *count = WORKERS_MAX;
    return (wo_runner){.user = count, .workers = workers, .run = run};
}
