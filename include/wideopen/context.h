/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WIDEOPEN_CONTEXT_H
#define WIDEOPEN_CONTEXT_H

#include "wideopen/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Memory comes from the caller. get returns NULL when there is none; memory must be aligned to
   WO_ALIGNMENT bytes; put takes what get gave, or NULL. Both are called from any thread. */
#define WO_ALIGNMENT 64
typedef struct wo_allocator {
    void *user;
    void *(*get)(void *user, size_t bytes);
    void (*put)(void *user, void *memory);
} wo_allocator;

/* Threads come from the caller. run calls func(job, i, worker) once for every i in 0..count-1, from
   any of its workers, and returns when all are done; worker is 0..workers()-1 and no two calls
   with the same worker overlap. Order of calls is free: results of the core never depend on it. */
typedef struct wo_runner {
    void *user;
    unsigned (*workers)(void *user);
    void (*run)(void *user, void (*func)(void *job, size_t index, unsigned worker), void *job,
                size_t count);
} wo_runner;

/* Instruction sets a kernel may use; WO_CPU_AUTO takes what the machine has. */
enum { WO_CPU_BASE = 0, WO_CPU_AVX2 = 1, WO_CPU_AUTO = 0x7fffffff };

/* Everything the core needs from outside. Plain data, const after it is filled, may be shared by
   all threads. Zero members mean: malloc, one thread, WO_CPU_BASE, no limit, never aborted. */
typedef struct wo_context {
    wo_allocator allocator;
    wo_runner runner;
    int cpu;
    size_t max_bytes; /* largest single allocation; 0 = no limit */
    void *abort_user;
    bool (*aborted)(void *user); /* polled every few milliseconds from any worker; NULL = never */
    void *progress_user;
    void (*progress)(void *user, double fraction); /* 0..1, any worker, rising; NULL = none */
} wo_context;

/* One thread, malloc, best kernels of this machine. */
#define WO_CONTEXT_INIT                                                                            \
    {                                                                                              \
        .cpu = WO_CPU_AUTO                                                                         \
    }

/* Instruction sets of this machine, limited by mask. Any thread. */
int wo_cpu_detect(int mask);

/* In the functions below a NULL context means one of zeros. */

/* Zeroed array of count elements of size bytes from the context's allocator. NULL and a text in
 *error on failure; count or size 0 and overflow are failures. Any thread. */
void *wo_new(const wo_context *context, wo_error *error, size_t count, size_t size) WO_NODISCARD;

/* The same for large arrays: all workers clear it. Not from inside a wo_run. */
void *wo_new_large(const wo_context *context, wo_error *error, size_t count,
                   size_t size) WO_NODISCARD;

/* The same, but not cleared: for arrays of which every byte is written before it is read. */
void *wo_new_raw(const wo_context *context, wo_error *error, size_t count,
                 size_t size) WO_NODISCARD;

/* Gives back what these gave; NULL is legal. Any thread. */
void wo_delete(const wo_context *context, void *memory);

/* Runs func over 0..count-1 with the context's runner, or serially when it has none. */
void wo_run(const wo_context *context, void (*func)(void *job, size_t index, unsigned worker),
            void *job, size_t count);

/* Number of workers wo_run may use; at least 1. */
unsigned wo_workers(const wo_context *context);

/* True when the caller wants the work to stop. Any thread. */
bool wo_aborted(const wo_context *context);

#ifdef __cplusplus
}
#endif
#endif
