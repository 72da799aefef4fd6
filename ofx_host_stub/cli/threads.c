/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "threads.h"

#include <pthread.h>
#include <stdatomic.h>
#include <unistd.h>

enum { THREADS_MAX = 256 };

typedef struct job {
    void (*func)(void *job, size_t index, unsigned worker);
    void *user;
    size_t count;
    atomic_size_t next;
} job;

typedef struct member {
    job *work;
    unsigned number;
    pthread_t thread;
    bool started;
} member;

static void *work(void *user)
{
    const member *m = user;
    for (size_t i; (i = atomic_fetch_add(&m->work->next, 1)) < m->work->count;)
        m->work->func(m->work->user, i, m->number);
    return NULL;
}

static unsigned workers(void *user)
{
    return *(const unsigned *)user;
}

static void run(void *user, void (*func)(void *, size_t, unsigned), void *data, size_t count)
{
    member crew[THREADS_MAX] = {{0}};
    job shared = {.func = func, .user = data, .count = count};
    const unsigned n = workers(user);
    for (unsigned i = 0; i < n; i++) {
        crew[i].work = &shared;
        crew[i].number = i;
        /* Who cannot be started is not missed: the others take the work, at worst this thread. */
        crew[i].started = i > 0 && pthread_create(&crew[i].thread, NULL, work, &crew[i]) == 0;
    }
    work(&crew[0]);
    for (unsigned i = 1; i < n; i++)
        if (crew[i].started)
            pthread_join(crew[i].thread, NULL);
}

wo_runner wo_threads_runner(unsigned *count)
{
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    if (*count == 0)
        *count = cores > 0 ? (unsigned)cores : 1;
    if (*count > THREADS_MAX)
        *count = THREADS_MAX;
    return (wo_runner){count, workers, run};
}
