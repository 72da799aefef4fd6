/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_memory.h"

/* Hosts promise 16 byte alignment at best, so a block is found by the header before it:

       base ... | header | memory, aligned to WO_ALIGNMENT ...
*/
typedef struct header {
    void *base;                 /* of the memory suite, or NULL */
    OfxImageMemoryHandle image; /* of the effect suite, or NULL */
} header;

enum { EXTRA = sizeof(header) + WO_ALIGNMENT };

static bool has_memory(const wo_ofx_suites *suites)
{
    return suites->memory && suites->memory->memoryAlloc && suites->memory->memoryFree;
}

static bool has_image_memory(const wo_ofx_suites *suites)
{
    return suites->effect->imageMemoryAlloc && suites->effect->imageMemoryFree &&
           suites->effect->imageMemoryLock && suites->effect->imageMemoryUnlock;
}

static void *get(void *user, size_t bytes)
{
    const wo_ofx_memory *const memory = user;
    const wo_ofx_suites *const suites = memory->suites;
    header block = {NULL, NULL};
    void *base = NULL;

    if (bytes > SIZE_MAX - EXTRA)
        return NULL;
    bytes += EXTRA;
    if (has_memory(suites)) {
        if (suites->memory->memoryAlloc(memory->effect, bytes, &block.base) != kOfxStatOK)
            return NULL;
        base = block.base;
    } else {
        if (suites->effect->imageMemoryAlloc(memory->effect, bytes, &block.image) != kOfxStatOK ||
            !block.image)
            return NULL;
        if (suites->effect->imageMemoryLock(block.image, &base) != kOfxStatOK || !base) {
            suites->effect->imageMemoryFree(block.image);
            return NULL;
        }
    }
    if (!base)
        return NULL;
    char *const after = (char *)base + sizeof(header);
    char *const aligned = after + (WO_ALIGNMENT - (uintptr_t)after % WO_ALIGNMENT) % WO_ALIGNMENT;
    ((header *)(void *)aligned)[-1] = block;
    return aligned;
}

static void put(void *user, void *aligned)
{
    const wo_ofx_memory *const memory = user;
    const wo_ofx_suites *const suites = memory->suites;
    if (!aligned)
        return;
    const header block = ((header *)aligned)[-1];
    if (block.base) {
        suites->memory->memoryFree(block.base);
    } else {
        suites->effect->imageMemoryUnlock(block.image);
        suites->effect->imageMemoryFree(block.image);
    }
}

wo_allocator wo_ofx_allocator(wo_ofx_memory *memory)
{
    if (!has_memory(memory->suites) && !has_image_memory(memory->suites))
        return (wo_allocator){NULL, NULL, NULL};
    return (wo_allocator){memory, get, put};
}
