/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_instance.h"

#include "ofx_camera.h"
#include "ofx_geometry.h"

#include <stdio.h>

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
static uint64_t hash_of(const char *text)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (; *text; text++)
        hash = (hash ^ (unsigned char)*text) * 0x100000001b3u;
    return hash ? hash : 1;
}

void wo_ofx_warn(const wo_ofx_action *action, const wo_report *report, bool whole)
{
    const OfxMessageSuiteV1 *const one = action->suites->message;
    const OfxMessageSuiteV2 *const two = action->suites->message2;
    wo_ofx_instance *const instance = action->instance;
    char text[WO_WARNINGS_MAX * (WO_WARNING_SIZE + 1)] = "";
    uint64_t kinds = 0;
    size_t used = 0;
    for (int i = 0; i < report->warning_count; i++) {
        kinds |= (uint64_t)1 << hash_of(report->warnings[i].key) % 64;
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%s", used ? "\n" : "",
                                 report->warnings[i].text);
    }
    if (!used) {
        if (whole && instance && atomic_exchange(&instance->warning, 0) && two &&
            two->clearPersistentMessage)
            two->clearPersistentMessage(action->handle);
        return;
    }
    if (two && two->setPersistentMessage) {
        const uint64_t hash = hash_of(text);
        if (!instance || atomic_exchange(&instance->warning, hash) != hash)
            two->setPersistentMessage(action->handle, kOfxMessageWarning, "WideOpenWarning", "%s",
                                      text);
        return;
    }
    if (!instance || (atomic_fetch_or(&instance->popped_up, kinds) & kinds) == kinds)
        return;
    if (one && one->message)
        one->message(action->handle, kOfxMessageWarning, "WideOpenWarning", "%s", text);
    else if (two && two->message)
        two->message(action->handle, kOfxMessageWarning, "WideOpenWarning", "%s", text);
}
