/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_instance.h"

#include "ofx_camera.h"
#include "ofx_geometry.h"

#include <stdio.h>
#include <string.h>

OfxStatus wo_ofx_instance_create(const wo_ofx_plugin *plugin, OfxImageEffectHandle handle)
{
    const wo_ofx_suites *const suites = &plugin->suites;
    wo_ofx_memory memory = {suites, handle};
    const wo_context context = {.allocator = wo_ofx_allocator(&memory)};
    OfxPropertySetHandle properties = NULL;

    if (suites->effect->getPropertySet(handle, &properties) != kOfxStatOK || !properties)
        return kOfxStatFailed;
    wo_ofx_instance *const instance = wo_new(&context, NULL, 1, sizeof *instance);
    if (!instance)
        return kOfxStatErrMemory;
    atomic_init(&instance->complaining, false);
    atomic_init(&instance->progressing, false);
    atomic_init(&instance->warning, 0);
    atomic_init(&instance->kinds, 0);
    atomic_init(&instance->place, 0);
    atomic_init(&instance->popped_up, 0);
    /* A host that cannot keep it must do without the flags. */
    if (suites->property->propSetPointer(properties, kOfxPropInstanceData, 0, instance) !=
        kOfxStatOK)
        wo_delete(&context, instance);
    return kOfxStatOK;
}

OfxStatus wo_ofx_instance_destroy(const wo_ofx_plugin *plugin, OfxImageEffectHandle handle)
{
    const wo_ofx_suites *const suites = &plugin->suites;
    wo_ofx_memory memory = {suites, handle};
    const wo_context context = {.allocator = wo_ofx_allocator(&memory)};
    OfxPropertySetHandle properties = NULL;

    if (suites->effect->getPropertySet(handle, &properties) != kOfxStatOK || !properties)
        return kOfxStatFailed;
    wo_delete(&context, wo_ofx_get_pointer(suites, properties, kOfxPropInstanceData));
    suites->property->propSetPointer(properties, kOfxPropInstanceData, 0, NULL);
    return kOfxStatOK;
}

void wo_ofx_action_begin(wo_ofx_action *action, const wo_ofx_plugin *plugin,
                         OfxImageEffectHandle handle, OfxPropertySetHandle in,
                         OfxPropertySetHandle out)
{
    const wo_ofx_suites *const suites = &plugin->suites;
    *action = (wo_ofx_action){.suites = suites,
                              .effect = plugin->effect(),
                              .handle = handle,
                              .in = in,
                              .out = out,
                              .memory = {suites, handle},
                              .scale = {1, 1},
                              .aspect = 1,
                              .to_pixels = {1, 1},
                              .geometry = WO_GEOMETRY_INIT};
    action->context.allocator = wo_ofx_allocator(&action->memory);
    if (suites->effect->getPropertySet(handle, &action->properties) != kOfxStatOK)
        action->properties = NULL;
    action->instance = wo_ofx_get_pointer(suites, action->properties, kOfxPropInstanceData);
    for (size_t i = 0; i < action->effect->clip_count; i++)
        if (suites->effect->clipGetHandle(handle, action->effect->clips[i].name,
                                          &action->clips[i].handle,
                                          &action->clips[i].properties) != kOfxStatOK) {
            action->clips[i].handle = NULL;
            action->clips[i].properties = NULL;
        }
}

bool wo_ofx_clip_connected(const wo_ofx_action *action, size_t clip)
{
    /* Hosts that say nothing are taken to be connected; whether an image comes is seen later. */
    return action->clips[clip].handle &&
           wo_ofx_get_int(action->suites, action->clips[clip].properties,
                          kOfxImageClipPropConnected, 1) != 0;
}

wo_status wo_ofx_action_read(wo_ofx_action *action)
{
    const wo_ofx_suites *const suites = action->suites;
    const wo_effect *const effect = action->effect;

    wo_ofx_read_geometry(action);
    wo_ofx_read_camera(action);
    action->params = wo_new(&action->context, &action->error, 1, effect->params_size);
    if (!action->params)
        return action->error.status;
    return wo_ofx_read_params(suites, effect, action->handle, action->time, action->params,
                              &action->lost, &action->error);
}

/* The newer suite keeps the text beside the node until it is cleared; the older one pops it up,
   which must happen once and not for every tile. */
static void complain(const wo_ofx_action *action)
{
    const wo_ofx_suites *const suites = action->suites;
    wo_ofx_instance *const instance = action->instance;
    const bool before = instance && atomic_exchange(&instance->complaining, true);
    const char *const text =
        action->error.text[0] ? action->error.text : wo_status_text(action->error.status);

    if (instance)
        atomic_store(&instance->warning, 0); /* one text at a time stands there */
    if (suites->message2 && suites->message2->setPersistentMessage) {
        suites->message2->setPersistentMessage(action->handle, kOfxMessageError, "WideOpenError",
                                               "%s", text);
        return;
    }
    if (before)
        return;
    if (suites->message && suites->message->message)
        suites->message->message(action->handle, kOfxMessageError, "WideOpenError", "%s", text);
    else if (suites->message2 && suites->message2->message)
        suites->message2->message(action->handle, kOfxMessageError, "WideOpenError", "%s", text);
}

static void make_up(const wo_ofx_action *action)
{
    const OfxMessageSuiteV2 *const message = action->suites->message2;
    if (action->instance && atomic_exchange(&action->instance->complaining, false) && message &&
        message->clearPersistentMessage)
        message->clearPersistentMessage(action->handle);
}

OfxStatus wo_ofx_action_end(wo_ofx_action *action, wo_status status, bool done)
{
    wo_delete(&action->context, action->params);
    action->params = NULL;
    if (status != WO_OK && status != WO_ABORTED) {
        if (action->error.status != status)
            wo_fail(&action->error, status, "%s", wo_status_text(status));
        complain(action);
    } else if (status == WO_OK && done) {
        make_up(action);
    }
    return wo_ofx_status(status);
}

/* FNV-1a, never 0. */
static uint64_t hash_of(const void *data, size_t size)
{
    const unsigned char *const bytes = data;
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ bytes[i]) * 0x100000001b3u;
    return hash ? hash : 1;
}

/* All texts of a report, one a line; *kinds gets a bit for each key. */
static size_t join(const wo_report *report, char *text, size_t size, uint64_t *kinds)
{
    size_t used = 0;
    *kinds = 0;
    for (int i = 0; i < report->warning_count; i++) {
        const char *const key = report->warnings[i].key;
        *kinds |= (uint64_t)1 << hash_of(key, strlen(key)) % 64;
        used += (size_t)snprintf(text + used, size - used, "%s%s", used ? "\n" : "",
                                 report->warnings[i].text);
    }
    return used;
}

/* Should this text take the place of what stands there? Of a tile only if it tells of more. */
static bool is_news(wo_ofx_instance *instance, uint64_t hash, uint64_t kinds, uint64_t place,
                    bool whole)
{
    if (!instance)
        return true;
    const uint64_t told =
        whole ? atomic_exchange(&instance->kinds, kinds) : atomic_fetch_or(&instance->kinds, kinds);
    const uint64_t now = atomic_load(&instance->warning);
    if (now != 0 && (whole ? now == hash : (told | kinds) == told))
        return false;
    atomic_store(&instance->place, place);
    return atomic_exchange(&instance->warning, hash) != hash;
}

void wo_ofx_warn(const wo_ofx_action *action, const wo_report *report, wo_rect window)
{
    const OfxMessageSuiteV1 *const one = action->suites->message;
    const OfxMessageSuiteV2 *const two = action->suites->message2;
    wo_ofx_instance *const instance = action->instance;
    const bool whole = wo_rect_contains(window, action->geometry.extent);
    const int32_t sides[4] = {window.x1, window.y1, window.x2, window.y2};
    const uint64_t place = hash_of(sides, sizeof sides);
    char text[WO_WARNINGS_MAX * (WO_WARNING_SIZE + 1)] = "";
    uint64_t kinds;
    const size_t length = join(report, text, sizeof text, &kinds);
    if (length == 0) {
        if (instance && (whole || atomic_load(&instance->place) == place) &&
            atomic_exchange(&instance->warning, 0)) {
            atomic_store(&instance->kinds, 0);
            if (two && two->clearPersistentMessage)
                two->clearPersistentMessage(action->handle);
        }
    } else if (two && two->setPersistentMessage) {
        if (is_news(instance, hash_of(text, length), kinds, place, whole))
            two->setPersistentMessage(action->handle, kOfxMessageWarning, "WideOpenWarning", "%s",
                                      text);
    } else if (instance && (atomic_fetch_or(&instance->popped_up, kinds) & kinds) != kinds) {
        if (one && one->message)
            one->message(action->handle, kOfxMessageWarning, "WideOpenWarning", "%s", text);
        else if (two && two->message)
            two->message(action->handle, kOfxMessageWarning, "WideOpenWarning", "%s", text);
    }
}
