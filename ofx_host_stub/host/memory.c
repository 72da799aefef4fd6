/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "suites.h"

#include <stdlib.h>
#include <string.h>

#define GUARD      1024 /* bytes before and after; a multiple of the alignment */
#define GUARD_BYTE 0xa5
#define ALIGNMENT  64

/* Memory of the memory suite (handle NULL, known by its address) and image memory. */
struct wo_block {
    wo_block *next;
    void *data;
    size_t bytes;
    void *handle;
    const OfxPlugin *plugin; /* NULL when nobody knows */
    const wo_object *object; /* NULL when it was asked for without one */
};

#define BUCKETS 1024

static wo_block *buckets[BUCKETS]; /* under the process lock; see process.c */

/* Between its guards the memory is as it comes. */
static void *guarded(size_t bytes)
{
    if (bytes > SIZE_MAX - 2 * GUARD - ALIGNMENT)
        return NULL;
    const size_t whole = (bytes + 2 * GUARD + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    unsigned char *base = aligned_alloc(ALIGNMENT, whole);
    if (!base)
        return NULL;
    memset(base, GUARD_BYTE, GUARD);
    memset(base + GUARD + bytes, GUARD_BYTE, whole - GUARD - bytes);
    return base + GUARD;
}

void *wo_guarded_alloc(size_t bytes)
{
    void *const memory = guarded(bytes);
    return memory ? memset(memory, 0, bytes) : NULL;
}

bool wo_guarded_intact(const void *memory, size_t bytes)
{
    const unsigned char *data = memory;
    for (size_t i = 0; i < GUARD; i++)
        if (data[bytes + i] != GUARD_BYTE || *(data - 1 - i) != GUARD_BYTE)
            return false;
    return true;
}

void wo_guarded_free(void *memory)
{
    if (memory)
        free((unsigned char *)memory - GUARD);
}

static wo_block **bucket(const void *data)
{
    return &buckets[((uintptr_t)data / ALIGNMENT) % BUCKETS];
}

/* A block that is still unknown to the lists; NULL when out of memory. */
static wo_block *block_new(const wo_object *object, size_t bytes)
{
    const wo_frame *frame = wo_frame_now();
    wo_block *block = calloc(1, sizeof *block);
    void *data = guarded(bytes); /* the standard promises no zeros */
    if (!block || !data) {
        free(block);
        wo_guarded_free(data);
        return NULL;
    }
    block->data = data;
    block->bytes = bytes;
    block->object = object;
    block->plugin = object                  ? object->entry->plugin
                    : frame && frame->entry ? frame->entry->plugin
                                            : NULL;
    return block;
}

static void block_add(wo_block *block)
{
    wo_process_lock();
    wo_block **first = bucket(block->data);
    block->next = *first;
    *first = block;
    wo_process_unlock();
}

/* The lock is held; does nothing when the block is not in the lists. */
static void block_unlink(const wo_block *block)
{
    wo_block **link = bucket(block->data);
    while (*link && *link != block)
        link = &(*link)->next;
    if (*link)
        *link = block->next;
}

static void block_free(wo_block *block)
{
    if (!wo_guarded_intact(block->data, block->bytes))
        wo_violate(block->object ? block->object->host : NULL,
                   "bytes outside of a block of %zu bytes of %smemory were written", block->bytes,
                   block->handle ? "image " : "");
    wo_guarded_free(block->data);
    free(block);
}

static OfxStatus memory_alloc(void *handle, size_t bytes, void **data)
{
    const wo_object *object = NULL;
    if (!data) {
        wo_violate(NULL, "memoryAlloc: no place for the result");
        return kOfxStatErrValue;
    }
    *data = NULL;
    if (handle && !(object = wo_find_effect(handle, "memoryAlloc")))
        return kOfxStatErrBadHandle;
    wo_block *block = block_new(object, bytes);
    if (!block)
        return kOfxStatErrMemory;
    block_add(block);
    *data = block->data;
    return kOfxStatOK;
}

static OfxStatus memory_free(void *data)
{
    wo_process_lock();
    wo_block *block = *bucket(data);
    while (block && (block->data != data || block->handle))
        block = block->next;
    if (block)
        block_unlink(block);
    wo_process_unlock();
    if (!block) {
        wo_violate(NULL, "memoryFree of %s",
                   data ? "memory that memoryAlloc has not given, or that is free already"
                        : "NULL");
        return kOfxStatErrBadHandle;
    }
    block_free(block);
    return kOfxStatOK;
}

const OfxMemorySuiteV1 wo_memory_suite = {
    .memoryAlloc = memory_alloc,
    .memoryFree = memory_free,
};

OfxStatus wo_image_memory_alloc(OfxImageEffectHandle effect, size_t bytes,
                                OfxImageMemoryHandle *memory)
{
    const wo_object *object = NULL;
    if (!memory) {
        wo_violate(NULL, "imageMemoryAlloc: no place for the result");
        return kOfxStatErrValue;
    }
    *memory = NULL;
    if (effect && !(object = wo_find_effect(effect, "imageMemoryAlloc")))
        return kOfxStatErrBadHandle;
    wo_block *block = block_new(object, bytes);
    if (block && !(block->handle = wo_handle_add(WO_HANDLE_MEMORY, block))) {
        wo_guarded_free(block->data);
        free(block);
        block = NULL;
    }
    if (!block)
        return kOfxStatErrMemory;
    block_add(block);
    *memory = (OfxImageMemoryHandle)block->handle;
    return kOfxStatOK;
}

/* The lock is held when a block comes back. */
static wo_block *find_image_memory(OfxImageMemoryHandle memory, const char *function)
{
    wo_process_lock();
    wo_block *block = wo_handle_find(memory, WO_HANDLE_MEMORY);
    if (block)
        return block;
    const char *why = wo_handle_fault(memory, WO_HANDLE_MEMORY);
    wo_process_unlock();
    wo_violate(NULL, "%s: the image memory handle is %s", function, why);
    return NULL;
}

OfxStatus wo_image_memory_free(OfxImageMemoryHandle memory)
{
    wo_block *block = find_image_memory(memory, "imageMemoryFree");
    if (!block)
        return kOfxStatErrBadHandle;
    wo_handle_remove(block->handle);
    block_unlink(block);
    wo_process_unlock();
    block_free(block);
    return kOfxStatOK;
}

/* The memory never moves: locks change nothing, and the standard takes one too few or too many. */
OfxStatus wo_image_memory_lock(OfxImageMemoryHandle memory, void **data)
{
    wo_block *block = find_image_memory(memory, "imageMemoryLock");
    if (!block)
        return kOfxStatErrBadHandle;
    if (data)
        *data = block->data;
    wo_process_unlock();
    if (data)
        return kOfxStatOK;
    wo_violate(NULL, "imageMemoryLock: no place for the result");
    return kOfxStatErrValue;
}

OfxStatus wo_image_memory_unlock(OfxImageMemoryHandle memory)
{
    if (!find_image_memory(memory, "imageMemoryUnlock"))
        return kOfxStatErrBadHandle;
    wo_process_unlock();
    return kOfxStatOK;
}

void wo_memory_check_left(const OfxPlugin *plugin, const wo_object *object)
{
    wo_block *left = NULL;
    wo_process_lock();
    for (size_t i = 0; i < BUCKETS; i++) {
        wo_block **link = &buckets[i];
        while (*link) {
            wo_block *block = *link;
            if (object ? block->object == object : block->plugin == plugin) {
                *link = block->next;
                block->next = left;
                left = block;
                wo_handle_remove(block->handle);
            } else {
                link = &block->next;
            }
        }
    }
    wo_process_unlock();
    while (left) {
        wo_block *next = left->next;
        wo_violate(NULL, "%zu bytes of %s were not freed", left->bytes,
                   left->handle ? "image memory (imageMemoryAlloc)" : "memory (memoryAlloc)");
        block_free(left);
        left = next;
    }
}

void wo_memory_forget(void)
{
    for (size_t i = 0; i < BUCKETS; i++) {
        while (buckets[i]) {
            wo_block *block = buckets[i];
            buckets[i] = block->next;
            wo_guarded_free(block->data);
            free(block);
        }
    }
}
