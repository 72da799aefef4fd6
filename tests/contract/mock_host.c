/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "mock_internal.h"

#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <pthread.h>

#include "ofx/ofxDrawSuite.h"
#include "ofx/ofxInteract.h"
#include "ofx/ofxMemory.h"
#include "ofx/ofxMessage.h"
#include "ofx/ofxProgress.h"

mock_state mock;

static atomic_long allocations;
static atomic_int live_blocks, aborts, threads_started, updates;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

void mock_reset(void)
{
    memset(&mock, 0, sizeof mock);
    mock.cpus = 2;
    mock.fail_after = -1;
    mock.abort_after = -1;
    atomic_store(&allocations, 0);
    atomic_store(&live_blocks, 0);
    atomic_store(&aborts, 0);
    atomic_store(&threads_started, 0);
    atomic_store(&updates, 0);
    mock_allocations_of_sets(true);
}

/* Counters that threads touch become plain ones for the test. */
void mock_settle(void)
{
    mock.allocations = atomic_load(&allocations);
    mock.live_blocks = atomic_load(&live_blocks);
    mock.threads_started = atomic_load(&threads_started);
    mock.progress_updates = atomic_load(&updates);
    mock.live_sets = mock_allocations_of_sets(false);
}

/* ---- memory ---- */

static bool exhausted(void)
{
    const long call = atomic_fetch_add(&allocations, 1);
    return mock.fail_after >= 0 && call >= mock.fail_after;
}

static OfxStatus memory_alloc(void *handle, size_t bytes, void **data)
{
    (void)handle;
    *data = NULL;
    if (exhausted())
        return kOfxStatErrMemory;
    /* Odd on purpose: 8 byte alignment is all that is sure. */
    char *const block = malloc(bytes + 8);
    if (!block)
        return kOfxStatErrMemory;
    *data = block + 8;
    atomic_fetch_add(&live_blocks, 1);
    return kOfxStatOK;
}

static OfxStatus memory_free(void *data)
{
    atomic_fetch_sub(&live_blocks, 1);
    free((char *)data - 8);
    return kOfxStatOK;
}

OfxStatus mock_image_alloc(OfxImageEffectHandle effect, size_t bytes, OfxImageMemoryHandle *handle)
{
    void *data = NULL;
    const OfxStatus status = memory_alloc(effect, bytes, &data);
    *handle = data;
    return status;
}

OfxStatus mock_image_free(OfxImageMemoryHandle handle)
{
    return memory_free(handle);
}

OfxStatus mock_image_lock(OfxImageMemoryHandle handle, void **data)
{
    *data = handle;
    return kOfxStatOK;
}

OfxStatus mock_image_unlock(OfxImageMemoryHandle handle)
{
    return handle ? kOfxStatOK : kOfxStatErrBadHandle;
}

int mock_abort(OfxImageEffectHandle effect)
{
    (void)effect;
    const int call = atomic_fetch_add(&aborts, 1);
    return mock.abort_after >= 0 && call >= mock.abort_after;
}

/* ---- threads ---- */

typedef struct thread_job {
    OfxThreadFunctionV1 *func;
    unsigned index, count;
    void *custom;
} thread_job;

static void *thread_main(void *user)
{
    const thread_job *const job = user;
    atomic_fetch_add(&threads_started, 1);
    job->func(mock.threading == MOCK_THREADS_SAME ? 0 : job->index, job->count, job->custom);
    return NULL;
}

static OfxStatus multi_thread(OfxThreadFunctionV1 func, unsigned count, void *custom)
{
    pthread_t threads[64];
    thread_job jobs[64];
    mock.multi_thread_calls++;
    if (mock.threading == MOCK_THREADS_FAIL)
        return kOfxStatErrExists;
    if (mock.threading == MOCK_THREADS_EMPTY)
        return kOfxStatOK;
    if (mock.threading == MOCK_THREADS_SERIAL) {
        for (unsigned i = 0; i < count; i++)
            func(i, count, custom);
        return kOfxStatOK;
    }
    unsigned started = 0;
    const unsigned wanted = mock.threading == MOCK_THREADS_MORE ? 2 * count : count;
    for (; started < wanted && started < 64; started++) {
        jobs[started] = (thread_job){func, started, wanted, custom};
        if (pthread_create(&threads[started], NULL, thread_main, &jobs[started]) != 0)
            break;
    }
    for (unsigned i = 0; i < started; i++)
        pthread_join(threads[i], NULL);
    return kOfxStatOK;
}

static OfxStatus cpu_count(unsigned *count)
{
    *count = mock.cpus;
    return kOfxStatOK;
}

static int is_spawned(void)
{
    return mock.spawned;
}

/* ---- messages, progress, report ---- */

static OfxStatus show(void *handle, const char *type, const char *id, const char *format, ...)
{
    va_list arguments;
    (void)handle;
    (void)id;
    va_start(arguments, format);
    pthread_mutex_lock(&lock);
    mock.messages++;
    vsnprintf(mock.message, sizeof mock.message, format, arguments);
    pthread_mutex_unlock(&lock);
    va_end(arguments);
    return type ? kOfxStatOK : kOfxStatErrValue;
}

static OfxStatus set_persistent(void *handle, const char *type, const char *id, const char *format,
                                ...)
{
    va_list arguments;
    (void)handle;
    (void)id;
    va_start(arguments, format);
    pthread_mutex_lock(&lock);
    mock.persistent++;
    mock.persistent_set = true;
    vsnprintf(mock.message, sizeof mock.message, format, arguments);
    pthread_mutex_unlock(&lock);
    va_end(arguments);
    return type ? kOfxStatOK : kOfxStatErrValue;
}

static OfxStatus clear_persistent(void *handle)
{
    (void)handle;
    mock.persistent_set = false;
    return kOfxStatOK;
}

static OfxStatus start1(void *effect, const char *label)
{
    mock.progress_starts++;
    return effect && label ? kOfxStatOK : kOfxStatErrBadHandle;
}

static OfxStatus start2(void *effect, const char *label, const char *id)
{
    return id ? start1(effect, label) : kOfxStatErrValue;
}

static OfxStatus update(void *effect, double progress)
{
    (void)effect;
    atomic_fetch_add(&updates, 1);
    pthread_mutex_lock(&lock);
    if (progress < mock.progress_last)
        mock.progress_last = -1; /* a step back */
    else if (mock.progress_last >= 0)
        mock.progress_last = progress;
    pthread_mutex_unlock(&lock);
    return mock.cancel ? kOfxStatReplyNo : kOfxStatOK;
}

static OfxStatus end(void *effect)
{
    mock.progress_ends++;
    return effect ? kOfxStatOK : kOfxStatErrBadHandle;
}

static int mode(void *effect)
{
    return effect ? mock.report_mode : 0;
}

static int publish(void *effect, const char *kind, const char *text)
{
    (void)effect;
    snprintf(mock.kind, sizeof mock.kind, "%s", kind);
    snprintf(mock.published, sizeof mock.published, "%s", text);
    return 0;
}

/* ---- suites ---- */

static const OfxMemorySuiteV1 memory_suite = {memory_alloc, memory_free};
static const OfxMultiThreadSuiteV1 thread_suite = {.multiThread = multi_thread,
                                                   .multiThreadNumCPUs = cpu_count,
                                                   .multiThreadIsSpawnedThread = is_spawned};
static const OfxMultiThreadSuiteV1 hollow_threads = {.multiThreadNumCPUs = cpu_count};
static const OfxMessageSuiteV1 message1 = {show};
static const OfxMessageSuiteV2 message2 = {show, set_persistent, clear_persistent};
static const OfxMessageSuiteV2 hollow_message2 = {NULL, NULL, NULL};
static const OfxProgressSuiteV1 progress1 = {start1, update, end};
static const OfxProgressSuiteV2 progress2 = {start2, update, end};
static const OfxProgressSuiteV2 hollow_progress = {start2, NULL, NULL};
static const WideOpenReportSuiteV1 report_suite = {mode, publish};

static const void *pick(unsigned absent, const void *suite)
{
    return mock.flags & absent ? NULL : suite;
}

const void *mock_suite(const char *name, int version)
{
    const unsigned flags = mock.flags;
    if (strcmp(name, kOfxPropertySuite) == 0 && version == 1)
        return pick(MOCK_NO_PROPERTIES, mock_property_suite());
    if (strcmp(name, kOfxParameterSuite) == 0 && version == 1)
        return pick(MOCK_NO_PARAMS, mock_param_suite());
    if (strcmp(name, kOfxImageEffectSuite) == 0 && version == 1)
        return mock_effect_suite(flags & MOCK_HOLLOW_EFFECT);
    if (strcmp(name, kOfxMemorySuite) == 0 && version == 1)
        return pick(MOCK_NO_MEMORY, &memory_suite);
    if (strcmp(name, kOfxMultiThreadSuite) == 0 && version == 1)
        return pick(MOCK_NO_THREADS, flags & MOCK_HOLLOW_THREADS ? &hollow_threads : &thread_suite);
    if (strcmp(name, kOfxMessageSuite) == 0 && version == 1)
        return pick(MOCK_NO_MESSAGE1, &message1);
    if (strcmp(name, kOfxMessageSuite) == 0 && version == 2)
        return pick(MOCK_NO_MESSAGE2, flags & MOCK_HOLLOW_MESSAGE2 ? &hollow_message2 : &message2);
    if (strcmp(name, kOfxProgressSuite) == 0)
        return pick(MOCK_NO_PROGRESS, version == 1 ? (const void *)&progress1
                                      : flags & MOCK_HOLLOW_PROGRESS
                                          ? (const void *)&hollow_progress
                                          : (const void *)&progress2);
    if (strcmp(name, kOfxInteractSuite) == 0 && version == 1)
        return pick(MOCK_NO_INTERACT, mock_interact_suite());
    if (strcmp(name, kOfxDrawSuite) == 0 && version == 1)
        return pick(MOCK_NO_DRAW, mock_draw_suite(flags & MOCK_HOLLOW_DRAW));
    if (strcmp(name, kWideOpenReportSuite) == 0 && version == 1)
        return pick(MOCK_NO_REPORT, &report_suite);
    return NULL;
}
