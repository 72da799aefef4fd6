/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "suites.h"

#include <stdlib.h>
#include <unistd.h>

#define THREADS_MAX 1024

/* ------------------------------------------------------------------------------------- the pool */

/* One call of multiThread. It lives on the stack of its caller, which works on it as well. */
typedef struct job {
    struct job *next;
    OfxThreadFunctionV1 *func;
    void *arg;
    unsigned count; /* threadMax */
    unsigned started, ended;
    const wo_frame *frame; /* of the caller; NULL when it was in no action */
} job;

struct wo_pool {
    pthread_mutex_t lock;
    pthread_cond_t work, done;
    job *jobs; /* with indices that nobody has started, first come first */
    bool quit;
    unsigned size;    /* threads at work at most, the caller among them */
    unsigned spawned; /* size - 1 when all could be made */
    pthread_t *threads;
};

/* Takes the next index of a job; the lock is held. */
static unsigned start_one(wo_pool *pool, job *j)
{
    const unsigned index = j->started++;
    if (j->started == j->count) {
        job **link = &pool->jobs;
        while (*link != j)
            link = &(*link)->next;
        *link = j->next;
    }
    return index;
}

static void run_one(const job *j, unsigned index)
{
    const wo_frame *before = wo_frame_now();
    wo_frame frame = {0};
    if (j->frame)
        frame = *j->frame;
    frame.outer = before;
    frame.thread_index = index;
    frame.spawned = true;
    wo_frame_set(&frame);
    j->func(index, j->count, j->arg);
    wo_frame_set(before);
}

static void end_one(wo_pool *pool, job *j)
{
    if (++j->ended == j->count)
        pthread_cond_broadcast(&pool->done);
}

static void *worker(void *user)
{
    wo_pool *pool = user;
    pthread_mutex_lock(&pool->lock);
    for (;;) {
        while (!pool->jobs && !pool->quit)
            pthread_cond_wait(&pool->work, &pool->lock);
        if (!pool->jobs)
            break;
        job *j = pool->jobs;
        const unsigned index = start_one(pool, j);
        pthread_mutex_unlock(&pool->lock);
        run_one(j, index);
        pthread_mutex_lock(&pool->lock);
        end_one(pool, j);
    }
    pthread_mutex_unlock(&pool->lock);
    return NULL;
}

wo_status wo_pool_create(unsigned threads, wo_pool **out, wo_error *error)
{
    *out = NULL;
    if (threads == 0) {
        const long cores = sysconf(_SC_NPROCESSORS_ONLN);
        threads = cores > 0 ? (unsigned)cores : 1;
    }
    if (threads > THREADS_MAX)
        threads = THREADS_MAX;
    wo_pool *pool = calloc(1, sizeof *pool);
    pthread_t *handles = calloc(threads, sizeof *handles);
    if (!pool || !handles || pthread_mutex_init(&pool->lock, NULL) != 0) {
        free(handles);
        free(pool);
        return wo_fail(error, WO_ERR_NOMEM, "no memory for %u threads", threads);
    }
    pthread_cond_init(&pool->work, NULL);
    pthread_cond_init(&pool->done, NULL);
    pool->threads = handles;
    while (pool->spawned + 1 < threads &&
           pthread_create(&handles[pool->spawned], NULL, worker, pool) == 0)
        pool->spawned++;
    pool->size = pool->spawned + 1; /* what the machine would give */
    *out = pool;
    return WO_OK;
}

void wo_pool_destroy(wo_pool **place)
{
    wo_pool *pool = *place;
    if (!pool)
        return;
    pthread_mutex_lock(&pool->lock);
    pool->quit = true;
    pthread_cond_broadcast(&pool->work);
    pthread_mutex_unlock(&pool->lock);
    for (unsigned i = 0; i < pool->spawned; i++)
        pthread_join(pool->threads[i], NULL);
    pthread_cond_destroy(&pool->work);
    pthread_cond_destroy(&pool->done);
    pthread_mutex_destroy(&pool->lock);
    free(pool->threads);
    free(pool);
    *place = NULL;
}

unsigned wo_pool_size(const wo_pool *pool)
{
    return pool ? pool->size : 1;
}

static OfxStatus multi_thread(OfxThreadFunctionV1 func, unsigned int threads, void *arg)
{
    const wo_frame *frame = wo_frame_now();
    if (!func || threads == 0) {
        wo_violate(NULL, "multiThread with %s", func ? "no threads" : "no function");
        return kOfxStatErrValue;
    }
    if (frame && frame->spawned) {
        wo_violate(frame->host, "multiThread inside of multiThread");
        return kOfxStatErrExists;
    }
    wo_host *host = wo_host_to_blame(NULL);
    wo_pool *pool = host ? host->pool : NULL;
    const unsigned size = wo_pool_size(pool);
    job j = {.func = func, .arg = arg, .count = threads < size ? threads : size, .frame = frame};
    if (!frame)
        wo_violate(NULL, "multiThread outside of any action");
    if (j.count == 1 || !pool) {
        j.count = 1;
        run_one(&j, 0);
        return kOfxStatOK;
    }
    pthread_mutex_lock(&pool->lock);
    job **link = &pool->jobs;
    while (*link)
        link = &(*link)->next;
    *link = &j;
    pthread_cond_broadcast(&pool->work);
    while (j.started < j.count) {
        const unsigned index = start_one(pool, &j);
        pthread_mutex_unlock(&pool->lock);
        run_one(&j, index);
        pthread_mutex_lock(&pool->lock);
        end_one(pool, &j);
    }
    while (j.ended < j.count)
        pthread_cond_wait(&pool->done, &pool->lock);
    pthread_mutex_unlock(&pool->lock);
    return kOfxStatOK;
}

static OfxStatus cpu_count(unsigned int *count)
{
    if (!count) {
        wo_violate(NULL, "multiThreadNumCPUs: no place for the result");
        return kOfxStatErrValue;
    }
    const wo_host *host = wo_host_to_blame(NULL);
    *count = host ? wo_pool_size(host->pool) : 1;
    return kOfxStatOK;
}

static OfxStatus thread_index(unsigned int *index)
{
    const wo_frame *frame = wo_frame_now();
    if (!index) {
        wo_violate(NULL, "multiThreadIndex: no place for the result");
        return kOfxStatErrValue;
    }
    *index = frame ? frame->thread_index : 0;
    return kOfxStatOK;
}

static int is_spawned(void)
{
    const wo_frame *frame = wo_frame_now();
    return frame && frame->spawned;
}

/* ---------------------------------------------------------------------------------- the mutexes */

struct wo_mutex {
    wo_mutex *next;
    void *handle;
    pthread_mutex_t lock; /* what follows */
    pthread_cond_t freed;
    unsigned depth; /* a thread may lock it several times */
    pthread_t owner;
    unsigned users; /* calls that are inside, under the process lock */
    const OfxPlugin *plugin;
};

static wo_mutex *mutexes; /* under the process lock; see process.c */

static void mutex_free(wo_mutex *mutex)
{
    pthread_cond_destroy(&mutex->freed);
    pthread_mutex_destroy(&mutex->lock);
    free(mutex);
}

/* NULL after a violation, else a mutex that cannot vanish until mutex_leave. */
static wo_mutex *mutex_enter(OfxMutexHandle handle, const char *function)
{
    wo_process_lock();
    wo_mutex *mutex = wo_handle_find(handle, WO_HANDLE_MUTEX);
    const char *why = mutex ? NULL : wo_handle_fault(handle, WO_HANDLE_MUTEX);
    if (mutex)
        mutex->users++;
    wo_process_unlock();
    if (why)
        wo_violate(NULL, "%s: the mutex handle is %s", function, why);
    return mutex;
}

static void mutex_leave(wo_mutex *mutex)
{
    wo_process_lock();
    mutex->users--;
    wo_process_unlock();
}

static OfxStatus mutex_create(OfxMutexHandle *handle, int lock_count)
{
    const wo_frame *frame = wo_frame_now();
    if (!handle) {
        wo_violate(NULL, "mutexCreate: no place for the result");
        return kOfxStatErrValue;
    }
    *handle = NULL;
    wo_mutex *mutex = calloc(1, sizeof *mutex);
    if (!mutex)
        return kOfxStatErrMemory;
    pthread_mutex_init(&mutex->lock, NULL);
    pthread_cond_init(&mutex->freed, NULL);
    mutex->depth = lock_count > 0 ? (unsigned)lock_count : 0; /* below 0 is legal */
    mutex->owner = pthread_self();
    mutex->plugin = frame && frame->entry ? frame->entry->plugin : NULL;
    mutex->handle = wo_handle_add(WO_HANDLE_MUTEX, mutex);
    if (!mutex->handle) {
        mutex_free(mutex);
        return kOfxStatErrMemory;
    }
    wo_process_lock();
    mutex->next = mutexes;
    mutexes = mutex;
    wo_process_unlock();
    *handle = (OfxMutexHandle)mutex->handle;
    return kOfxStatOK;
}

static OfxStatus mutex_destroy(const OfxMutexHandle handle)
{
    wo_mutex *mutex = mutex_enter(handle, "mutexDestroy");
    if (!mutex)
        return kOfxStatErrBadHandle;
    pthread_mutex_lock(&mutex->lock);
    const bool locked = mutex->depth > 0;
    pthread_mutex_unlock(&mutex->lock);
    wo_process_lock();
    mutex->users--;
    const bool used = mutex->users > 0;
    if (!used) {
        wo_handle_remove(mutex->handle);
        wo_mutex **link = &mutexes;
        while (*link && *link != mutex)
            link = &(*link)->next;
        if (*link)
            *link = mutex->next;
    }
    wo_process_unlock();
    if (used || locked)
        wo_violate(NULL, "mutexDestroy of a mutex that is locked");
    if (used)
        return kOfxStatFailed;
    mutex_free(mutex);
    return kOfxStatOK;
}

static OfxStatus take(OfxMutexHandle handle, bool wait, const char *function)
{
    wo_mutex *mutex = mutex_enter(handle, function);
    if (!mutex)
        return kOfxStatErrBadHandle;
    const pthread_t self = pthread_self();
    OfxStatus status = kOfxStatOK;
    pthread_mutex_lock(&mutex->lock);
    while (mutex->depth > 0 && !pthread_equal(mutex->owner, self)) {
        if (!wait) {
            status = kOfxStatFailed;
            break;
        }
        pthread_cond_wait(&mutex->freed, &mutex->lock);
    }
    if (status == kOfxStatOK) {
        mutex->owner = self;
        mutex->depth++;
    }
    pthread_mutex_unlock(&mutex->lock);
    mutex_leave(mutex);
    return status;
}

static OfxStatus mutex_lock(const OfxMutexHandle handle)
{
    return take(handle, true, "mutexLock");
}

static OfxStatus mutex_try_lock(const OfxMutexHandle handle)
{
    return take(handle, false, "mutexTryLock");
}

static OfxStatus mutex_unlock(const OfxMutexHandle handle)
{
    wo_mutex *mutex = mutex_enter(handle, "mutexUnLock");
    if (!mutex)
        return kOfxStatErrBadHandle;
    pthread_mutex_lock(&mutex->lock);
    const bool mine = mutex->depth > 0 && pthread_equal(mutex->owner, pthread_self());
    if (mine && --mutex->depth == 0)
        pthread_cond_signal(&mutex->freed);
    pthread_mutex_unlock(&mutex->lock);
    mutex_leave(mutex);
    if (mine)
        return kOfxStatOK;
    wo_violate(NULL, "mutexUnLock of a mutex that this thread has not locked");
    return kOfxStatFailed;
}

void wo_mutexes_check_left(const OfxPlugin *plugin)
{
    wo_mutex *left = NULL;
    wo_process_lock();
    wo_mutex **link = &mutexes;
    while (*link) {
        wo_mutex *mutex = *link;
        if (mutex->plugin == plugin) {
            *link = mutex->next;
            mutex->next = left;
            left = mutex;
            wo_handle_remove(mutex->handle);
        } else {
            link = &mutex->next;
        }
    }
    wo_process_unlock();
    while (left) {
        wo_mutex *next = left->next;
        if (plugin)
            wo_violate(NULL, "a mutex was not destroyed");
        mutex_free(left);
        left = next;
    }
}

const OfxMultiThreadSuiteV1 wo_thread_suite = {
    .multiThread = multi_thread,
    .multiThreadNumCPUs = cpu_count,
    .multiThreadIndex = thread_index,
    .multiThreadIsSpawnedThread = is_spawned,
    .mutexCreate = mutex_create,
    .mutexDestroy = mutex_destroy,
    .mutexLock = mutex_lock,
    .mutexUnLock = mutex_unlock,
    .mutexTryLock = mutex_try_lock,
};
