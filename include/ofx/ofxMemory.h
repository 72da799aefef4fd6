/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Memory suite: plain memory that the host can count. Images use the image effect suite instead. */

#ifndef WO_OFX_MEMORY_H
#define WO_OFX_MEMORY_H

#include <stddef.h>

#include "ofxCore.h"

#ifdef __cplusplus
extern "C" {
#endif

#define kOfxMemorySuite "OfxMemorySuite"

/* Version 1. `handle` is the effect instance that pays for the memory, or NULL. */
typedef struct OfxMemorySuiteV1 {
    OfxStatus (*memoryAlloc)(void *handle, size_t nBytes, void **allocatedData);
    OfxStatus (*memoryFree)(void *allocatedData);
} OfxMemorySuiteV1;

#ifdef __cplusplus
}
#endif

#endif
