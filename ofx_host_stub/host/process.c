/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "internal.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The suites' functions get a handle, or nothing at all, and may be called from any thread: which
   object is meant must be found without a host at hand. Hence the only mutable statics of the
   library, here, in load.c (a binary is in a process once, however many hosts use it) and in
   memory.c and threads.c (memoryFree and mutexLock know no host either). */

typedef struct slot {
    void *object; /* NULL = free */
    uint32_t generation;
    uint32_t next_free; /* index + 1; 0 = none */
    wo_handle_kind kind;
} slot;

static struct {
    pthread_mutex_t setup; /* hosts come and go one at a time; taken before lock */
    pthread_mutex_t lock;
    slot *slots;
    size_t count, capacity;
    uint32_t free_slot;  /* index + 1 */
    uint32_t generation; /* first generation of new slots */
    wo_host *hosts;
    OfxHost ofx_host;
    wo_props properties;   /* of ofx_host */
    char folder[PATH_MAX]; /* the working directory that is the caller's; "" = none is known */
    mode_t mask;           /* of new files */
} process = {
    .setup = PTHREAD_MUTEX_INITIALIZER, .lock = PTHREAD_MUTEX_INITIALIZER, .generation = 1};

static _Thread_local const wo_frame *frame_now;

const wo_frame *wo_frame_now(void)
{
    return frame_now;
}

void wo_frame_set(const wo_frame *frame)
{
    frame_now = frame;
}

void wo_process_lock(void)
{
    pthread_mutex_lock(&process.lock);
}

void wo_process_unlock(void)
{
    pthread_mutex_unlock(&process.lock);
}

/* handle = generation : 32, slot : 28, kind : 4 */
_Static_assert(sizeof(void *) == 8, "handles are 64 bits");
#define SLOTS_MAX (1u << 28)

static void *handle_of(uint32_t index)
{
    const slot *s = &process.slots[index];
    return (void *)(((uintptr_t)s->generation << 32) | ((uintptr_t)index << 4) |
                    (uintptr_t)s->kind);
}

void *wo_handle_add(wo_handle_kind kind, void *object)
{
    void *handle = NULL;
    wo_process_lock();
    if (process.free_slot == 0 && process.count < SLOTS_MAX) {
        slot *slots =
            wo_grow(process.slots, process.count, &process.capacity, sizeof *process.slots);
        if (slots) {
            process.slots = slots;
            slots[process.count] = (slot){.generation = process.generation};
            process.free_slot = (uint32_t)++process.count;
        }
    }
    if (process.free_slot != 0) {
        const uint32_t index = process.free_slot - 1;
        slot *s = &process.slots[index];
        process.free_slot = s->next_free;
        s->object = object;
        s->kind = kind;
        handle = handle_of(index);
    }
    wo_process_unlock();
    return handle;
}

static slot *slot_of(const void *handle)
{
    const size_t index = ((uintptr_t)handle & 0xffffffffu) >> 4;
    return index < process.count ? &process.slots[index] : NULL;
}

static uint32_t generation_of(const void *handle)
{
    return (uint32_t)((uintptr_t)handle >> 32);
}

static wo_handle_kind kind_of(const void *handle)
{
    return (wo_handle_kind)((uintptr_t)handle & 15u);
}

void wo_handle_remove(void *handle)
{
    slot *s = slot_of(handle);
    if (!handle || !s || !s->object || s->generation != generation_of(handle))
        return;
    s->object = NULL;
    s->generation++;
    s->next_free = process.free_slot;
    process.free_slot = (uint32_t)(s - process.slots) + 1;
}

void *wo_handle_find(const void *handle, wo_handle_kind kind)
{
    const slot *s = slot_of(handle);
    if (!handle || !s || !s->object || s->generation != generation_of(handle) ||
        s->kind != kind_of(handle) || s->kind != kind)
        return NULL;
    return s->object;
}

const char *wo_handle_fault(const void *handle, wo_handle_kind kind)
{
    const slot *s = slot_of(handle);
    if (!handle)
        return "NULL";
    if (!s || kind_of(handle) < WO_HANDLE_PROPS || kind_of(handle) > WO_HANDLE_MUTEX ||
        generation_of(handle) == 0 || generation_of(handle) > s->generation)
        return "unknown";
    if (generation_of(handle) < s->generation)
        return "freed already";
    return s->kind == kind ? "unknown" : "of another kind";
}

static const void *fetch_suite(OfxPropertySetHandle host, const char *name, int version)
{
    if (host != process.ofx_host.host || !name) {
        wo_violate(NULL, "fetchSuite with %s",
                   name ? "a host handle that is not the host's" : "the name NULL");
        return NULL;
    }
    return wo_suite(name, version);
}

OfxHost *wo_process_ofx_host(void)
{
    return &process.ofx_host;
}

static void remember_surroundings(void)
{
    if (!getcwd(process.folder, sizeof process.folder))
        process.folder[0] = '\0';
    process.mask = umask(077);
    umask(process.mask);
}

void wo_surroundings_enter(wo_surroundings *now)
{
    (void)fegetenv(&now->floats);
}

void wo_surroundings_leave(const wo_surroundings *before)
{
    (void)fesetenv(&before->floats);
    umask(process.mask);
    if (process.folder[0] && chdir(process.folder) != 0)
        return; /* it is gone: there is no way back */
}

bool wo_process_enter(wo_host *host, const wo_host_config *config)
{
    pthread_mutex_lock(&process.setup);
    wo_process_lock();
    const bool first = process.hosts == NULL;
    host->next = process.hosts;
    process.hosts = host;
    wo_process_unlock();
    if (first) {
        remember_surroundings();
        wo_props_init(&process.properties, host, WO_PROPS_NEVER, "the host");
        wo_schema_host(&process.properties, config);
        process.ofx_host.host = (OfxPropertySetHandle)process.properties.handle;
        process.ofx_host.fetchSuite = fetch_suite;
    }
    const bool ok = !process.properties.failed;
    pthread_mutex_unlock(&process.setup);
    return ok;
}

/* Nothing is left of the process's objects when its last host has gone. */
static void forget(void)
{
    wo_props_clear(&process.properties);
    wo_mutexes_check_left(NULL);
    wo_process_lock();
    wo_memory_forget();
    /* Generations go on, so that handles of this life are stale in the next. */
    for (size_t i = 0; i < process.count; i++)
        if (process.slots[i].generation >= process.generation)
            process.generation = process.slots[i].generation + 1;
    free(process.slots);
    process.slots = NULL;
    process.count = process.capacity = 0;
    process.free_slot = 0;
    wo_process_unlock();
}

void wo_process_leave(wo_host *host)
{
    pthread_mutex_lock(&process.setup);
    wo_process_lock();
    wo_host **link = &process.hosts;
    while (*link && *link != host)
        link = &(*link)->next;
    if (*link)
        *link = host->next;
    const bool last = process.hosts == NULL;
    process.properties.host = process.hosts;
    wo_process_unlock();
    if (last)
        forget();
    pthread_mutex_unlock(&process.setup);
}

/* Host to blame something on when neither a handle nor an action says which. */
static wo_host *any_host(void)
{
    wo_process_lock();
    wo_host *host = process.hosts;
    wo_process_unlock();
    return host;
}

wo_host *wo_host_to_blame(wo_host *host)
{
    if (host)
        return host;
    const wo_frame *frame = wo_frame_now();
    return frame && frame->host ? frame->host : any_host();
}
