/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_PLUGINS_OFX_MEMORY_H
#define WO_PLUGINS_OFX_MEMORY_H

#include "ofx_suites.h"
#include "wideopen/context.h"

/* The host's memory as memory of the core: from its memory suite, else from the image memory of its
   effect suite, else from the C library. Plain data that must outlive what came from it. */
typedef struct wo_ofx_memory {
    const wo_ofx_suites *suites;
    OfxImageEffectHandle effect;
} wo_ofx_memory;

/* memory is borrowed by the allocator. Any thread. */
wo_allocator wo_ofx_allocator(wo_ofx_memory *memory);

#endif
