/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "suites.h"

#include <string.h>

wo_object *wo_find_effect(const void *handle, const char *function)
{
    wo_process_lock();
    wo_object *object = wo_handle_find(handle, WO_HANDLE_EFFECT);
    const char *why = object ? NULL : wo_handle_fault(handle, WO_HANDLE_EFFECT);
    wo_process_unlock();
    if (why)
        wo_violate(NULL, "%s: the effect handle is %s", function, why);
    return object;
}

wo_host_instance *wo_find_instance(const void *handle, const char *function)
{
    wo_object *object = wo_find_effect(handle, function);
    if (object && !object->instance) {
        wo_violate(object->host, "%s: the effect is a descriptor, not an instance", function);
        return NULL;
    }
    return (wo_host_instance *)object;
}

static wo_port *find_port(OfxImageClipHandle handle, const char *function)
{
    wo_process_lock();
    wo_port *port = wo_handle_find(handle, WO_HANDLE_CLIP);
    const char *why = port ? NULL : wo_handle_fault(handle, WO_HANDLE_CLIP);
    wo_process_unlock();
    if (why)
        wo_violate(NULL, "%s: the clip handle is %s", function, why);
    return port;
}

static OfxStatus no_place(const char *function)
{
    wo_violate(NULL, "%s: no place for the result", function);
    return kOfxStatErrValue;
}

static OfxStatus get_property_set(OfxImageEffectHandle effect, OfxPropertySetHandle *properties)
{
    wo_object *object = wo_find_effect(effect, "getPropertySet");
    if (!object)
        return kOfxStatErrBadHandle;
    if (!properties)
        return no_place("getPropertySet");
    *properties = (OfxPropertySetHandle)object->props.handle;
    return kOfxStatOK;
}

static OfxStatus get_param_set(OfxImageEffectHandle effect, OfxParamSetHandle *params)
{
    wo_object *object = wo_find_effect(effect, "getParamSet");
    if (!object)
        return kOfxStatErrBadHandle;
    if (!params)
        return no_place("getParamSet");
    *params = (OfxParamSetHandle)object->param_set;
    return kOfxStatOK;
}

static OfxStatus clip_define(OfxImageEffectHandle effect, const char *name,
                             OfxPropertySetHandle *properties)
{
    const wo_frame *frame = wo_frame_now();
    wo_object *object = wo_find_effect(effect, "clipDefine");
    if (!object)
        return kOfxStatErrBadHandle;
    if (!frame || frame->action != WO_ACTION_DESCRIBE_IN_CONTEXT || frame->object != object) {
        wo_violate(object->host, "clipDefine outside of %s",
                   kOfxImageEffectActionDescribeInContext);
        return kOfxStatFailed;
    }
    if (!name || !*name) {
        wo_violate(object->host, "clipDefine without a name");
        return kOfxStatErrValue;
    }
    if (wo_object_port(object, name)) {
        wo_violate(object->host, "clipDefine: there are two clips \"%.80s\"", name);
        return kOfxStatErrExists;
    }
    wo_port *port = wo_object_add_port(object, name);
    if (!port)
        return kOfxStatErrMemory;
    if (properties)
        *properties = (OfxPropertySetHandle)port->props.handle;
    return kOfxStatOK;
}

static OfxStatus clip_get_handle(OfxImageEffectHandle effect, const char *name,
                                 OfxImageClipHandle *clip, OfxPropertySetHandle *properties)
{
    wo_host_instance *instance = wo_find_instance(effect, "clipGetHandle");
    if (!instance)
        return kOfxStatErrBadHandle;
    if (!clip)
        return no_place("clipGetHandle");
    *clip = NULL;
    if (properties)
        *properties = NULL;
    wo_port *port = name ? wo_object_port(&instance->object, name) : NULL;
    if (!port) /* asking whether a clip is there is no breach */
        return kOfxStatErrUnknown;
    *clip = (OfxImageClipHandle)port->handle;
    if (properties)
        *properties = (OfxPropertySetHandle)port->props.handle;
    return kOfxStatOK;
}

static OfxStatus clip_get_property_set(OfxImageClipHandle clip, OfxPropertySetHandle *properties)
{
    wo_port *port = find_port(clip, "clipGetPropertySet");
    if (!port)
        return kOfxStatErrBadHandle;
    if (!properties)
        return no_place("clipGetPropertySet");
    *properties = (OfxPropertySetHandle)port->props.handle;
    return kOfxStatOK;
}

static OfxStatus clip_get_image(OfxImageClipHandle clip, OfxTime time, const OfxRectD *region,
                                OfxPropertySetHandle *image)
{
    wo_port *port = find_port(clip, "clipGetImage");
    if (image)
        *image = NULL;
    if (!port)
        return kOfxStatErrBadHandle;
    if (!image)
        return no_place("clipGetImage");
    if (!port->owner->instance) {
        wo_violate(port->owner->host, "clipGetImage of a descriptor's clip");
        return kOfxStatErrBadHandle;
    }
    return wo_image_hand_out((wo_host_instance *)port->owner, port, time, region, image);
}

static OfxStatus clip_get_region(OfxImageClipHandle clip, OfxTime time, OfxRectD *bounds)
{
    wo_port *port = find_port(clip, "clipGetRegionOfDefinition");
    wo_host_region region = {0};
    if (!port)
        return kOfxStatErrBadHandle;
    if (!bounds)
        return no_place("clipGetRegionOfDefinition");
    *bounds = (OfxRectD){0};
    if (!port->owner->instance) {
        wo_violate(port->owner->host, "clipGetRegionOfDefinition of a descriptor's clip");
        return kOfxStatErrBadHandle;
    }
    const wo_frame *frame = wo_frame_now();
    wo_host_instance *const instance = (wo_host_instance *)port->owner;
    wo_status status = WO_OK;
    if (port->output && frame && frame->tile)
        region = frame->tile->canonical;
    else if (port->output && instance->has_region && instance->region_time == time)
        region = instance->region;
    else if (port->output)
        status = wo_default_region(instance, time, &region, NULL);
    else
        status = wo_port_region(port, time, &region, NULL);
    if (status == WO_ERR_NOMEM)
        return kOfxStatErrMemory;
    if (status != WO_OK && status != WO_ERR_NOT_FOUND) /* nothing there is a region, too */
        return kOfxStatFailed;
    *bounds = (OfxRectD){region.x1 <= -WO_INFINITE ? kOfxFlagInfiniteMin : region.x1,
                         region.y1 <= -WO_INFINITE ? kOfxFlagInfiniteMin : region.y1,
                         region.x2 >= WO_INFINITE ? kOfxFlagInfiniteMax : region.x2,
                         region.y2 >= WO_INFINITE ? kOfxFlagInfiniteMax : region.y2};
    return kOfxStatOK;
}

static int stop(OfxImageEffectHandle effect)
{
    wo_host_instance *instance = wo_find_instance(effect, "abort");
    return instance && wo_host_wants_stop(instance);
}

const OfxImageEffectSuiteV1 wo_effect_suite = {
    .getPropertySet = get_property_set,
    .getParamSet = get_param_set,
    .clipDefine = clip_define,
    .clipGetHandle = clip_get_handle,
    .clipGetPropertySet = clip_get_property_set,
    .clipGetImage = clip_get_image,
    .clipReleaseImage = wo_image_take_back,
    .clipGetRegionOfDefinition = clip_get_region,
    .abort = stop,
    .imageMemoryAlloc = wo_image_memory_alloc,
    .imageMemoryFree = wo_image_memory_free,
    .imageMemoryLock = wo_image_memory_lock,
    .imageMemoryUnlock = wo_image_memory_unlock,
};

const void *wo_suite(const char *name, int version)
{
    static const struct {
        const char *name;
        int version;
        const void *table;
    } suites[] = {
        {kOfxPropertySuite, 1, &wo_property_suite},   {kOfxImageEffectSuite, 1, &wo_effect_suite},
        {kOfxParameterSuite, 1, &wo_parameter_suite}, {kOfxMemorySuite, 1, &wo_memory_suite},
        {kOfxMultiThreadSuite, 1, &wo_thread_suite},  {kOfxMessageSuite, 1, &wo_message_suite_1},
        {kOfxMessageSuite, 2, &wo_message_suite_2},   {kOfxProgressSuite, 1, &wo_progress_suite_1},
        {kOfxProgressSuite, 2, &wo_progress_suite_2}, {kOfxTimeLineSuite, 1, &wo_timeline_suite},
        {kWideOpenReportSuite, 1, &wo_report_suite},
    };
    for (size_t i = 0; i < WO_COUNT(suites); i++)
        if (suites[i].version == version && strcmp(suites[i].name, name) == 0)
            return suites[i].table;
    return NULL;
}
