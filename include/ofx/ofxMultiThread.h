/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Multithread suite: the host's threads and mutexes, so that a plugin needs none of its own. */

#ifndef WO_OFX_MULTI_THREAD_H
#define WO_OFX_MULTI_THREAD_H

#include "ofxCore.h"

#ifdef __cplusplus
extern "C" {
#endif

#define kOfxMultiThreadSuite "OfxMultiThreadSuite"

typedef struct OfxMutex *OfxMutexHandle;

/* The work, called once for each thread; threadIndex is 0 .. threadMax - 1. */
typedef void(OfxThreadFunctionV1)(unsigned int threadIndex, unsigned int threadMax,
                                  void *customArg);

/* Version 1. */
typedef struct OfxMultiThreadSuiteV1 {
    /* Runs `func` on up to nThreads threads and returns when all are done. The host may use fewer,
     * even one. Not to be nested: a call from a spawned thread answers kOfxStatErrExists. */
    OfxStatus (*multiThread)(OfxThreadFunctionV1 func, unsigned int nThreads, void *customArg);
    OfxStatus (*multiThreadNumCPUs)(unsigned int *nCPUs);

    /* Index of the calling thread; 0 outside multiThread. */
    OfxStatus (*multiThreadIndex)(unsigned int *threadIndex);

    /* An answer, not a status: 1 inside a thread that multiThread spawned, else 0. */
    int (*multiThreadIsSpawnedThread)(void);

    /* lockCount is how often the new mutex is already locked. */
    OfxStatus (*mutexCreate)(OfxMutexHandle *mutex, int lockCount);
    OfxStatus (*mutexDestroy)(const OfxMutexHandle mutex);
    OfxStatus (*mutexLock)(const OfxMutexHandle mutex);
    OfxStatus (*mutexUnLock)(const OfxMutexHandle mutex);

    /* Never waits; kOfxStatFailed if another thread holds it. */
    OfxStatus (*mutexTryLock)(const OfxMutexHandle mutex);
} OfxMultiThreadSuiteV1;

#ifdef __cplusplus
}
#endif

#endif
