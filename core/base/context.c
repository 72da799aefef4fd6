/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/context.h"

#include <stdlib.h>
#include <string.h>

static void *take(const wo_context *context, size_t bytes)
{
    if (context && context->allocator.get)
        return context->allocator.get(context->allocator.user, bytes);
    /* aligned_alloc wants whole multiples of the alignment. */
    const size_t rest = bytes % WO_ALIGNMENT;
    const size_t pad = rest ? WO_ALIGNMENT - rest : 0;
    return bytes <= SIZE_MAX - pad ? aligned_alloc(WO_ALIGNMENT, bytes + pad) : NULL;
}

/* Memory as it comes; *total is its size. */
static void *obtain(const wo_context *context, wo_error *error, size_t count, size_t size,
                    size_t *total)
{
    if (count == 0 || size == 0) {
        wo_fail(error, WO_ERR_ARGUMENT, "an array of %zu elements of %zu bytes was asked for",
                count, size);
        return NULL;
    }
    if (count > SIZE_MAX / size) {
        wo_fail(error, WO_ERR_NOMEM, "%zu elements of %zu bytes are more than memory can address",
                count, size);
        return NULL;
    }
    const size_t bytes = count * size;
    if (context && context->max_bytes && bytes > context->max_bytes) {
        wo_fail(error, WO_ERR_NOMEM, "%zu bytes are more than the limit of %zu bytes at once",
                bytes, context->max_bytes);
        return NULL;
    }
    void *memory = take(context, bytes);
    if (!memory) {
        wo_fail(error, WO_ERR_NOMEM, "no memory for %zu bytes", bytes);
        return NULL;
    }
    if ((uintptr_t)memory % WO_ALIGNMENT != 0) {
        wo_delete(context, memory);
        wo_fail(error, WO_ERR_ARGUMENT, "the allocator gave memory not aligned to %d bytes",
                WO_ALIGNMENT);
        return NULL;
    }
    *total = bytes;
    return memory;
}

void *wo_new(const wo_context *context, wo_error *error, size_t count, size_t size)
{
    size_t bytes;
    void *memory = obtain(context, error, count, size, &bytes);
    return memory ? memset(memory, 0, bytes) : NULL;
}

enum { PIECE = 1 << 20 };

typedef struct clear_job {
    char *memory;
    size_t bytes;
} clear_job;

static void clear_piece(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const clear_job *job = user;
    const size_t left = job->bytes - index * PIECE;
    memset(job->memory + index * PIECE, 0, left < PIECE ? left : PIECE);
}

void *wo_new_large(const wo_context *context, wo_error *error, size_t count, size_t size)
{
    size_t bytes;
    void *memory = obtain(context, error, count, size, &bytes);
    if (!memory)
        return NULL;
    clear_job job = {memory, bytes};
    wo_run(context, clear_piece, &job, (bytes + PIECE - 1) / PIECE);
    return memory;
}

void *wo_new_raw(const wo_context *context, wo_error *error, size_t count, size_t size)
{
    size_t bytes;
    void *memory = obtain(context, error, count, size, &bytes);
#ifndef NDEBUG
    if (memory)
        memset(memory, 0xff, bytes); /* NaN: whoever reads it all the same is found by tests */
#endif
    return memory;
}

void wo_delete(const wo_context *context, void *memory)
{
    if (!memory)
        return;
    if (!context || !context->allocator.get)
        free(memory);
    else if (context->allocator.put)
        context->allocator.put(context->allocator.user, memory);
}

void wo_run(const wo_context *context, void (*func)(void *job, size_t index, unsigned worker),
            void *job, size_t count)
{
    if (count == 0)
        return;
    if (context && context->runner.run) {
        context->runner.run(context->runner.user, func, job, count);
        return;
    }
    for (size_t i = 0; i < count; i++)
        func(job, i, 0);
}

unsigned wo_workers(const wo_context *context)
{
    /* Without run there is one thread, whatever workers says. */
    if (!context || !context->runner.run || !context->runner.workers)
        return 1;
    const unsigned workers = context->runner.workers(context->runner.user);
    return workers ? workers : 1;
}

bool wo_aborted(const wo_context *context)
{
    return context && context->aborted && context->aborted(context->abort_user);
}
