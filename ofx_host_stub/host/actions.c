/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "internal.h"

#include <stdlib.h>
#include <string.h>

/* What an action may answer beside the failures every action may answer, and what a plugin may do
   in it. */
enum { OK = 1, DEFAULT = 2, MISSING = 4, UNLICENSED = 8, FORMAT = 16, ANY = 32 };
enum { SETS = 1, IMAGES = 2 };

static const char *const texts[WO_ACTION_COUNT] = {
#define WO_ACTION_TEXT(name, text) [name] = text,
    WO_ACTION_LIST(WO_ACTION_TEXT)
#undef WO_ACTION_TEXT
};

static unsigned answers_of(wo_action action)
{
    switch (action) {
    case WO_ACTION_LOAD:
        return OK | DEFAULT | MISSING;
    case WO_ACTION_DESCRIBE:
    case WO_ACTION_DESCRIBE_IN_CONTEXT:
        return OK | MISSING;
    case WO_ACTION_CREATE:
        return OK | DEFAULT | MISSING;
    case WO_ACTION_DESTROY:
        return ANY;
    case WO_ACTION_BEGIN_RENDER:
        return OK | DEFAULT | UNLICENSED;
    case WO_ACTION_RENDER:
        return OK | UNLICENSED | FORMAT;
    default:
        return OK | DEFAULT;
    }
}

static unsigned rights_of(wo_action action)
{
    switch (action) {
    case WO_ACTION_CREATE:
    case WO_ACTION_SYNC:
        return SETS;
    case WO_ACTION_BEGIN_CHANGED:
    case WO_ACTION_CHANGED:
    case WO_ACTION_END_CHANGED:
        return SETS | IMAGES;
    case WO_ACTION_BEGIN_RENDER:
    case WO_ACTION_RENDER:
    case WO_ACTION_END_RENDER:
        return IMAGES;
    default:
        return 0;
    }
}

bool wo_action_sets_params(wo_action action)
{
    return rights_of(action) & SETS;
}

bool wo_action_gets_images(wo_action action)
{
    return rights_of(action) & IMAGES;
}

const char *wo_action_text(wo_action action)
{
    return texts[action];
}

static const struct {
    OfxStatus status;
    const char *text;
} answer_texts[] = {
    {kOfxStatOK, "kOfxStatOK"},
    {kOfxStatFailed, "kOfxStatFailed"},
    {kOfxStatErrFatal, "kOfxStatErrFatal"},
    {kOfxStatErrUnknown, "kOfxStatErrUnknown"},
    {kOfxStatErrMissingHostFeature, "kOfxStatErrMissingHostFeature"},
    {kOfxStatErrUnsupported, "kOfxStatErrUnsupported"},
    {kOfxStatErrExists, "kOfxStatErrExists"},
    {kOfxStatErrFormat, "kOfxStatErrFormat"},
    {kOfxStatErrMemory, "kOfxStatErrMemory"},
    {kOfxStatErrBadHandle, "kOfxStatErrBadHandle"},
    {kOfxStatErrBadIndex, "kOfxStatErrBadIndex"},
    {kOfxStatErrValue, "kOfxStatErrValue"},
    {kOfxStatReplyYes, "kOfxStatReplyYes"},
    {kOfxStatReplyNo, "kOfxStatReplyNo"},
    {kOfxStatReplyDefault, "kOfxStatReplyDefault"},
    {kOfxStatUnlicensed, "kOfxStatUnlicensed"},
    {kOfxStatErrImageFormat, "kOfxStatErrImageFormat"},
};

const char *wo_ofx_status_text(OfxStatus status)
{
    for (size_t i = 0; i < WO_COUNT(answer_texts); i++)
        if (answer_texts[i].status == status)
            return answer_texts[i].text;
    return "an unknown status";
}

static wo_status status_of(OfxStatus status)
{
    switch (status) {
    case kOfxStatOK:
    case kOfxStatReplyDefault:
        return WO_OK;
    case kOfxStatErrMemory:
        return WO_ERR_NOMEM;
    case kOfxStatErrImageFormat:
    case kOfxStatErrFormat:
        return WO_ERR_FORMAT;
    case kOfxStatErrMissingHostFeature:
    case kOfxStatErrUnsupported:
        return WO_ERR_UNSUPPORTED;
    default:
        return WO_ERR_LIBRARY;
    }
}

static bool legal(wo_action action, OfxStatus status)
{
    const unsigned answers = answers_of(action);
    if (answers & ANY)
        return true;
    switch (status) {
    case kOfxStatFailed:
    case kOfxStatErrFatal:
    case kOfxStatErrMemory:
        return true;
    case kOfxStatOK:
        return answers & OK;
    case kOfxStatReplyDefault:
        return answers & DEFAULT;
    case kOfxStatErrMissingHostFeature:
        return answers & MISSING;
    case kOfxStatUnlicensed:
        return answers & UNLICENSED;
    case kOfxStatErrImageFormat:
        return answers & FORMAT;
    default:
        return false;
    }
}

OfxStatus wo_act(wo_entry *entry, wo_frame *frame, wo_props *in, wo_props *out)
{
    if ((in && in->failed) || (out && out->failed))
        return kOfxStatErrMemory;
    wo_host_instance *instance =
        frame->object && frame->object->instance ? (wo_host_instance *)frame->object : NULL;
    frame->outer = wo_frame_now();
    frame->host = entry->host;
    frame->entry = entry;
    frame->serial = atomic_fetch_add(&entry->host->serial, 1) + 1;
    frame->thread_index = 0;
    frame->spawned = false;
    wo_frame_set(frame);
    wo_surroundings before;
    wo_surroundings_enter(&before);
    OfxStatus status =
        entry->plugin->mainEntry(texts[frame->action], frame->object ? frame->object->handle : NULL,
                                 in ? (OfxPropertySetHandle)in->handle : NULL,
                                 out ? (OfxPropertySetHandle)out->handle : NULL);
    wo_surroundings_leave(&before);
    if (!legal(frame->action, status)) {
        wo_violate(entry->host, "it answers %s (%d)", wo_ofx_status_text(status), status);
        status = kOfxStatFailed;
    }
    if (instance) {
        wo_images_check_left(instance, frame->serial);
        if (frame->action != WO_ACTION_RENDER)
            wo_messages_check_left(instance);
        if (status == kOfxStatErrFatal)
            atomic_store(&instance->fatal, true);
    }
    wo_frame_set(frame->outer);
    return status;
}

wo_status wo_act_on(wo_host_instance *instance, wo_frame *frame, wo_props *in, wo_props *out,
                    OfxStatus *answer, wo_error *error)
{
    frame->object = &instance->object;
    if (atomic_load(&instance->fatal))
        return wo_fail(error, WO_ERR_LIBRARY, "%.80s has declared this instance broken",
                       instance->object.entry->info.identifier);
    if ((in && in->failed) || (out && out->failed))
        return wo_fail(error, WO_ERR_NOMEM, "no memory for the arguments of %s",
                       wo_action_text(frame->action));
    const OfxStatus status = wo_act(instance->object.entry, frame, in, out);
    if (answer)
        *answer = status;
    if (status == kOfxStatOK || status == kOfxStatReplyDefault)
        return WO_OK;
    pthread_mutex_lock(&instance->lock);
    const char *text = instance->persistent ? instance->persistent : "";
    const wo_status failed =
        wo_fail(error, status_of(status), "%.60s: %s%s%s", wo_action_text(frame->action),
                wo_ofx_status_text(status), *text ? ": " : "", text);
    char *whole = error && !strstr(error->text, text) ? wo_text_copy(text) : NULL;
    pthread_mutex_unlock(&instance->lock);
    const wo_host_config *config = &instance->object.host->config;
    if (whole && config->message)
        (void)config->message(config->user, WO_HOST_MESSAGE_ERROR, "", whole);
    free(whole);
    return failed;
}

/* -------------------------------------------------------------------------------------- changes */

void wo_mark_changed(wo_host_instance *instance, const char *param)
{
    instance->colourspace_stale = true;
    instance->has_region = false;
    if (wo_props_has_text(&instance->object.entry->descriptor->props,
                          kOfxImageEffectPropClipPreferencesSlaveParam, param))
        instance->preferences_stale = true;
}

static wo_status bracket(wo_host_instance *instance, wo_action action, const char *reason,
                         wo_error *error)
{
    wo_props in;
    wo_frame frame = {.action = action, .time = instance->time, .scale = {1, 1}};
    wo_props_init(&in, instance->object.host, WO_PROPS_NEVER, "the arguments");
    wo_props_add_one(&in, kOfxPropChangeReason, WO_PROP_STRING, 1, false);
    wo_props_set_text(&in, kOfxPropChangeReason, 0, reason);
    const wo_status status = wo_act_on(instance, &frame, &in, NULL, NULL, error);
    wo_props_clear(&in);
    return status;
}

static wo_status tell(wo_host_instance *instance, const char *type, const char *name,
                      const char *reason, wo_error *error)
{
    wo_props in;
    wo_frame frame = {.action = WO_ACTION_CHANGED, .time = instance->time, .scale = {1, 1}};
    wo_props_init(&in, instance->object.host, WO_PROPS_NEVER, "the arguments");
    wo_props_add_one(&in, kOfxPropType, WO_PROP_STRING, 1, false);
    wo_props_add_one(&in, kOfxPropName, WO_PROP_STRING, 1, false);
    wo_props_add_one(&in, kOfxPropChangeReason, WO_PROP_STRING, 1, false);
    wo_props_add_one(&in, kOfxPropTime, WO_PROP_DOUBLE, 1, false);
    wo_props_add_one(&in, kOfxImageEffectPropRenderScale, WO_PROP_DOUBLE, 2, false);
    wo_props_set_text(&in, kOfxPropType, 0, type);
    wo_props_set_text(&in, kOfxPropName, 0, name);
    wo_props_set_text(&in, kOfxPropChangeReason, 0, reason);
    wo_props_set_double(&in, kOfxPropTime, 0, instance->time);
    wo_props_set_double(&in, kOfxImageEffectPropRenderScale, 0, 1);
    wo_props_set_double(&in, kOfxImageEffectPropRenderScale, 1, 1);
    const wo_status status = wo_act_on(instance, &frame, &in, NULL, NULL, error);
    wo_props_clear(&in);
    return status;
}

/* A plugin that answers changes with changes is told of those, too, but not without end. */
#define ROUNDS_MAX 4

/* The earliest change up to a number that the plugin has not been told of; NULL when there is none.
 */
static wo_par *next_change(const wo_host_instance *instance, unsigned last)
{
    wo_par *next = NULL;
    for (size_t i = 0; i < instance->object.param_count; i++) {
        wo_par *par = instance->object.params[i];
        if (par->plugin_changed && par->change <= last && (!next || par->change < next->change))
            next = par;
    }
    return next;
}

static wo_status tell_own_changes(wo_host_instance *instance, wo_error *error)
{
    for (int round = 0; round < ROUNDS_MAX && instance->any_plugin_changed; round++) {
        instance->any_plugin_changed = false;
        WO_TRY(bracket(instance, WO_ACTION_BEGIN_CHANGED, kOfxChangePluginEdited, error));
        const unsigned last = instance->changes;
        wo_status status = WO_OK;
        for (wo_par *par; status == WO_OK && (par = next_change(instance, last));) {
            par->plugin_changed = false;
            status = tell(instance, kOfxTypeParameter, par->name, kOfxChangePluginEdited, error);
        }
        const wo_status ended = bracket(instance, WO_ACTION_END_CHANGED, kOfxChangePluginEdited,
                                        status == WO_OK ? error : NULL);
        WO_TRY(status);
        WO_TRY(ended);
    }
    instance->any_plugin_changed = false;
    for (size_t i = 0; i < instance->object.param_count; i++)
        instance->object.params[i]->plugin_changed = false;
    return WO_OK;
}

wo_status wo_tell_changed(wo_host_instance *instance, const char *type, const char *name,
                          const char *reason, wo_error *error)
{
    WO_TRY(bracket(instance, WO_ACTION_BEGIN_CHANGED, reason, error));
    const wo_status status = tell(instance, type, name, reason, error);
    const wo_status ended =
        bracket(instance, WO_ACTION_END_CHANGED, reason, status == WO_OK ? error : NULL);
    WO_TRY(status);
    WO_TRY(ended);
    return tell_own_changes(instance, error);
}
