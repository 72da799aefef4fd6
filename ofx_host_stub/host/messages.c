/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "suites.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------------------------- messages */

static bool type_of(const char *text, wo_host_message *type)
{
    static const char *const texts[] = {
        [WO_HOST_MESSAGE_FATAL] = kOfxMessageFatal,
        [WO_HOST_MESSAGE_ERROR] = kOfxMessageError,
        [WO_HOST_MESSAGE_WARNING] = kOfxMessageWarning,
        [WO_HOST_MESSAGE_INFO] = kOfxMessageMessage,
        [WO_HOST_MESSAGE_LOG] = kOfxMessageLog,
        [WO_HOST_MESSAGE_QUESTION] = kOfxMessageQuestion,
    };
    for (size_t i = 0; text && i < WO_COUNT(texts); i++) {
        if (strcmp(texts[i], text) != 0)
            continue;
        *type = (wo_host_message)i;
        return true;
    }
    return false;
}

/* The text a plugin's printf arguments make; freed by the caller; NULL when out of memory. */
static char *compose(const char *format, va_list args)
{
    va_list again;
    va_copy(again, args);
    const int length = vsnprintf(NULL, 0, format, args);
    char *text = length >= 0 ? malloc((size_t)length + 1) : NULL;
    if (text)
        vsnprintf(text, (size_t)length + 1, format, again);
    va_end(again);
    return text;
}

/* The lawful beginning of all three functions. *instance may come back NULL: no handle was given.
 */
static OfxStatus begin(void *handle, const char *type_text, const char *format,
                       const char *function, wo_host_instance **instance, wo_host_message *type)
{
    *instance = NULL;
    if (handle) {
        wo_object *object = wo_find_effect(handle, function);
        if (!object)
            return kOfxStatErrBadHandle;
        if (object->instance)
            *instance = (wo_host_instance *)object;
    }
    if (!type_of(type_text, type) || !format) {
        wo_violate(NULL, "%s: \"%.80s\" is no type of message, or there is no text", function,
                   type_text ? type_text : "NULL");
        return kOfxStatErrValue;
    }
    return kOfxStatOK;
}

static OfxStatus message(void *handle, const char *type_text, const char *id, const char *format,
                         ...)
{
    wo_host_instance *instance;
    wo_host_message type;
    const OfxStatus status = begin(handle, type_text, format, "message", &instance, &type);
    if (status != kOfxStatOK)
        return status;
    va_list args;
    va_start(args, format);
    char *text = compose(format, args);
    va_end(args);
    if (!text)
        return kOfxStatErrMemory;
    const wo_host *host = wo_host_to_blame(instance ? instance->object.host : NULL);
    bool yes = false;
    if (host && host->config.message)
        yes = host->config.message(host->config.user, type, id ? id : "", text);
    free(text);
    if (type == WO_HOST_MESSAGE_QUESTION)
        return yes ? kOfxStatReplyYes : kOfxStatReplyNo;
    return kOfxStatOK;
}

static OfxStatus set_persistent(void *handle, const char *type_text, const char *id,
                                const char *format, ...)
{
    wo_host_instance *instance;
    wo_host_message type;
    (void)id;
    OfxStatus status = begin(handle, type_text, format, "setPersistentMessage", &instance, &type);
    if (status != kOfxStatOK)
        return status;
    if (!instance || type == WO_HOST_MESSAGE_QUESTION || type == WO_HOST_MESSAGE_LOG) {
        wo_violate(NULL, "setPersistentMessage %s",
                   instance ? "with a question or a log entry" : "without an instance");
        return instance ? kOfxStatErrValue : kOfxStatErrBadHandle;
    }
    va_list args;
    va_start(args, format);
    char *text = compose(format, args);
    va_end(args);
    if (!text)
        return kOfxStatErrMemory;
    pthread_mutex_lock(&instance->lock);
    free(instance->persistent);
    instance->persistent = text;
    pthread_mutex_unlock(&instance->lock);
    return kOfxStatOK;
}

static OfxStatus clear_persistent(void *handle)
{
    wo_host_instance *instance = wo_find_instance(handle, "clearPersistentMessage");
    if (!instance)
        return kOfxStatErrBadHandle;
    pthread_mutex_lock(&instance->lock);
    free(instance->persistent);
    instance->persistent = NULL;
    pthread_mutex_unlock(&instance->lock);
    return kOfxStatOK;
}

const char *wo_host_persistent_message(const wo_host_instance *instance)
{
    return instance->persistent ? instance->persistent : "";
}

/* ------------------------------------------------------------------------------------- progress */

static OfxStatus progress_start(wo_host_instance *instance, const char *label)
{
    char *copy = wo_text_copy(label ? label : "");
    if (!copy)
        return kOfxStatErrMemory;
    pthread_mutex_lock(&instance->lock);
    const bool going = instance->progress != NULL;
    free(instance->progress);
    instance->progress = copy;
    pthread_mutex_unlock(&instance->lock);
    if (going)
        wo_violate(instance->object.host, "progressStart before progressEnd of the last one");
    return kOfxStatOK;
}

static OfxStatus progress_start_1(void *handle, const char *label)
{
    wo_host_instance *instance = wo_find_instance(handle, "progressStart");
    return instance ? progress_start(instance, label) : kOfxStatErrBadHandle;
}

static OfxStatus progress_start_2(void *handle, const char *label, const char *id)
{
    (void)id;
    return progress_start_1(handle, label);
}

static bool tell_progress(wo_host_instance *instance, double fraction, bool *going)
{
    const wo_host_config *config = &instance->object.host->config;
    char label[128] = "";
    pthread_mutex_lock(&instance->lock);
    *going = instance->progress != NULL;
    if (*going)
        snprintf(label, sizeof label, "%s", instance->progress);
    if (fraction < 0) {
        free(instance->progress);
        instance->progress = NULL;
    }
    pthread_mutex_unlock(&instance->lock);
    return !*going || !config->progress || config->progress(config->user, label, fraction);
}

static OfxStatus progress_update(void *handle, double fraction)
{
    wo_host_instance *instance = wo_find_instance(handle, "progressUpdate");
    bool going;
    if (!instance)
        return kOfxStatErrBadHandle;
    if (!(fraction >= 0 && fraction <= 1)) {
        wo_violate(instance->object.host, "progressUpdate to %g, which is not 0 to 1", fraction);
        fraction = fraction > 1 ? 1 : 0;
    }
    if (!tell_progress(instance, fraction, &going)) {
        atomic_store(&instance->stop, true);
        return kOfxStatReplyNo;
    }
    if (!going)
        wo_violate(instance->object.host, "progressUpdate without progressStart");
    return going ? kOfxStatOK : kOfxStatFailed;
}

static OfxStatus progress_end(void *handle)
{
    wo_host_instance *instance = wo_find_instance(handle, "progressEnd");
    bool going;
    if (!instance)
        return kOfxStatErrBadHandle;
    (void)tell_progress(instance, -1, &going);
    if (!going)
        wo_violate(instance->object.host, "progressEnd without progressStart");
    return going ? kOfxStatOK : kOfxStatFailed;
}

void wo_messages_check_left(wo_host_instance *instance)
{
    bool going;
    (void)tell_progress(instance, -1, &going);
    if (going)
        wo_violate(instance->object.host, "progressStart without progressEnd");
    if (instance->edits > 0)
        wo_violate(instance->object.host, "paramEditBegin without paramEditEnd");
    instance->edits = 0;
}

bool wo_host_wants_stop(wo_host_instance *instance)
{
    const wo_host_config *config = &instance->object.host->config;
    if (atomic_load(&instance->stop))
        return true;
    if (!config->aborted || !config->aborted(config->user))
        return false;
    atomic_store(&instance->stop, true);
    return true;
}

/* ------------------------------------------------------------------------------------ time line */

static OfxStatus get_time(void *handle, double *time)
{
    const wo_frame *frame = wo_frame_now();
    wo_host_instance *instance = wo_find_instance(handle, "getTime");
    if (!instance)
        return kOfxStatErrBadHandle;
    if (!time) {
        wo_violate(instance->object.host, "getTime: no place for the result");
        return kOfxStatErrValue;
    }
    *time = frame && frame->object == &instance->object ? frame->time : instance->time;
    return kOfxStatOK;
}

static OfxStatus goto_time(void *handle, double time)
{
    const wo_frame *frame = wo_frame_now();
    wo_host_instance *instance = wo_find_instance(handle, "gotoTime");
    if (!instance)
        return kOfxStatErrBadHandle;
    if (!frame || frame->object != &instance->object || !wo_action_sets_params(frame->action)) {
        wo_violate(instance->object.host, "gotoTime in an action that must not move the time line");
        return kOfxStatFailed;
    }
    instance->time = time;
    return kOfxStatOK;
}

static OfxStatus get_bounds(void *handle, double *first, double *last)
{
    wo_host_instance *instance = wo_find_instance(handle, "getTimeBounds");
    if (!instance)
        return kOfxStatErrBadHandle;
    if (!first || !last) {
        wo_violate(instance->object.host, "getTimeBounds: no place for the result");
        return kOfxStatErrValue;
    }
    *first = instance->project.first_frame;
    *last = instance->project.last_frame;
    return kOfxStatOK;
}

/* -------------------------------------------------------------------------------------- reports */

static int report_mode(void *handle)
{
    wo_host_instance *instance = wo_find_instance(handle, "mode");
    return instance ? atomic_load(&instance->report) : kWideOpenReportNone;
}

static int publish(void *handle, const char *kind, const char *text)
{
    wo_host_instance *instance = wo_find_instance(handle, "publish");
    if (!instance)
        return 1;
    if (!kind || !text || atomic_load(&instance->report) == kWideOpenReportNone) {
        wo_violate(instance->object.host, "publish of %s",
                   kind && text ? "a report that nobody has asked for" : "nothing");
        return 1;
    }
    pthread_mutex_lock(&instance->publish_lock);
    if (instance->publish)
        instance->publish(instance->report_user, kind, text);
    pthread_mutex_unlock(&instance->publish_lock);
    return 0;
}

const OfxMessageSuiteV1 wo_message_suite_1 = {.message = message};

const OfxMessageSuiteV2 wo_message_suite_2 = {
    .message = message,
    .setPersistentMessage = set_persistent,
    .clearPersistentMessage = clear_persistent,
};

const OfxProgressSuiteV1 wo_progress_suite_1 = {
    .progressStart = progress_start_1,
    .progressUpdate = progress_update,
    .progressEnd = progress_end,
};

const OfxProgressSuiteV2 wo_progress_suite_2 = {
    .progressStart = progress_start_2,
    .progressUpdate = progress_update,
    .progressEnd = progress_end,
};

const OfxTimeLineSuiteV1 wo_timeline_suite = {
    .getTime = get_time,
    .gotoTime = goto_time,
    .getTimeBounds = get_bounds,
};

const WideOpenReportSuiteV1 wo_report_suite = {
    .mode = report_mode,
    .publish = publish,
};
