/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "suites.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

static wo_object *find_set(OfxParamSetHandle handle, const char *function)
{
    wo_process_lock();
    wo_object *object = wo_handle_find(handle, WO_HANDLE_PARAM_SET);
    const char *why = object ? NULL : wo_handle_fault(handle, WO_HANDLE_PARAM_SET);
    wo_process_unlock();
    if (why)
        wo_violate(NULL, "%s: the parameter set handle is %s", function, why);
    return object;
}

static wo_par *find_param(OfxParamHandle handle, const char *function)
{
    wo_process_lock();
    wo_par *par = wo_handle_find(handle, WO_HANDLE_PARAM);
    const char *why = par ? NULL : wo_handle_fault(handle, WO_HANDLE_PARAM);
    wo_process_unlock();
    if (why)
        wo_violate(NULL, "%s: the parameter handle is %s", function, why);
    return par;
}

static OfxStatus no_place(const char *function)
{
    wo_violate(NULL, "%s: no place for the result", function);
    return kOfxStatErrValue;
}

static OfxStatus define(OfxParamSetHandle handle, const char *type, const char *name,
                        OfxPropertySetHandle *properties)
{
    wo_object *object = find_set(handle, "paramDefine");
    const wo_frame *frame = wo_frame_now();
    wo_host_param_type kind;
    int dimension;
    bool is_text;
    if (!object)
        return kOfxStatErrBadHandle;
    if (!frame || frame->action != WO_ACTION_DESCRIBE_IN_CONTEXT || frame->object != object) {
        wo_violate(object->host, "paramDefine outside of %s",
                   kOfxImageEffectActionDescribeInContext);
        return kOfxStatFailed;
    }
    if (!type || !name || !*name) {
        wo_violate(object->host, "paramDefine without a %s", type ? "name" : "type");
        return kOfxStatErrValue;
    }
    if (!wo_param_type_of(type, &kind, &dimension, &is_text))
        return kOfxStatErrUnsupported;
    if (wo_object_param(object, name)) {
        wo_violate(object->host, "paramDefine: there are two parameters \"%.80s\"", name);
        return kOfxStatErrExists;
    }
    wo_par *par = wo_object_add_param(object, type, name);
    if (!par)
        return kOfxStatErrMemory;
    if (properties)
        *properties = (OfxPropertySetHandle)par->props.handle;
    return kOfxStatOK;
}

static OfxStatus get_handle(OfxParamSetHandle handle, const char *name, OfxParamHandle *param,
                            OfxPropertySetHandle *properties)
{
    wo_object *object = find_set(handle, "paramGetHandle");
    if (!object)
        return kOfxStatErrBadHandle;
    if (!param)
        return no_place("paramGetHandle");
    *param = NULL;
    if (properties)
        *properties = NULL;
    wo_par *par = name ? wo_object_param(object, name) : NULL;
    if (!par)
        return kOfxStatErrUnknown;
    *param = (OfxParamHandle)par->handle;
    if (properties)
        *properties = (OfxPropertySetHandle)par->props.handle;
    return kOfxStatOK;
}

static OfxStatus set_properties(OfxParamSetHandle handle, OfxPropertySetHandle *properties)
{
    wo_object *object = find_set(handle, "paramSetGetPropertySet");
    if (!object)
        return kOfxStatErrBadHandle;
    if (!properties)
        return no_place("paramSetGetPropertySet");
    *properties = (OfxPropertySetHandle)object->param_set_props.handle;
    return kOfxStatOK;
}

static OfxStatus param_properties(OfxParamHandle handle, OfxPropertySetHandle *properties)
{
    wo_par *par = find_param(handle, "paramGetPropertySet");
    if (!par)
        return kOfxStatErrBadHandle;
    if (!properties)
        return no_place("paramGetPropertySet");
    *properties = (OfxPropertySetHandle)par->props.handle;
    return kOfxStatOK;
}

/* -------------------------------------------------------------------------------------- reading */

static OfxStatus readable(OfxParamHandle handle, const char *function, wo_par **par)
{
    *par = find_param(handle, function);
    if (!*par)
        return kOfxStatErrBadHandle;
    if (!(*par)->owner->instance) {
        wo_violate((*par)->owner->host, "%s of \"%.80s\", which is a descriptor's", function,
                   (*par)->name);
        return kOfxStatErrBadHandle;
    }
    if ((*par)->dimension == 0 && !(*par)->is_text) {
        wo_violate((*par)->owner->host, "%s of \"%.80s\", which has no value", function,
                   (*par)->name);
        return kOfxStatErrUnsupported;
    }
    if (!wo_frame_now())
        wo_violate((*par)->owner->host, "%s of \"%.80s\" outside of any action", function,
                   (*par)->name);
    return kOfxStatOK;
}

static OfxStatus give_numbers(const wo_par *par, const double values[4], const char *function,
                              va_list args)
{
    for (int i = 0; i < par->dimension; i++) {
        void *place =
            wo_par_is_integer(par) ? (void *)va_arg(args, int *) : (void *)va_arg(args, double *);
        if (!place)
            return no_place(function);
        if (wo_par_is_integer(par))
            *(int *)place = (int)values[i];
        else
            *(double *)place = values[i];
    }
    return kOfxStatOK;
}

static OfxStatus give(const wo_par *par, double time, const char *function, va_list args)
{
    if (par->is_text) {
        const char **place = va_arg(args, const char **);
        if (!place)
            return no_place(function);
        *place = wo_par_text_at(par, time);
        return kOfxStatOK;
    }
    double values[4];
    wo_par_at(par, time, values);
    return give_numbers(par, values, function, args);
}

static OfxStatus get_value(OfxParamHandle handle, ...)
{
    wo_par *par;
    const OfxStatus status = readable(handle, "paramGetValue", &par);
    if (status != kOfxStatOK)
        return status;
    const wo_frame *frame = wo_frame_now();
    const double time = frame ? frame->time : ((wo_host_instance *)par->owner)->time;
    va_list args;
    va_start(args, handle);
    const OfxStatus given = give(par, time, "paramGetValue", args);
    va_end(args);
    return given;
}

static OfxStatus get_value_at(OfxParamHandle handle, OfxTime time, ...)
{
    wo_par *par;
    const OfxStatus status = readable(handle, "paramGetValueAtTime", &par);
    if (status != kOfxStatOK)
        return status;
    va_list args;
    va_start(args, time);
    const OfxStatus given = give(par, time, "paramGetValueAtTime", args);
    va_end(args);
    return given;
}

/* Slopes and integrals exist for doubles and colours. */
static OfxStatus smooth(OfxParamHandle handle, const char *function, wo_par **par)
{
    const OfxStatus status = readable(handle, function, par);
    if (status != kOfxStatOK)
        return status;
    if ((*par)->is_text || wo_par_is_integer(*par)) {
        wo_violate((*par)->owner->host, "%s of \"%.80s\", which is a %s", function, (*par)->name,
                   wo_host_param_type_text((*par)->kind));
        return kOfxStatErrUnsupported;
    }
    return kOfxStatOK;
}

static OfxStatus get_derivative(OfxParamHandle handle, OfxTime time, ...)
{
    wo_par *par;
    double values[4];
    const OfxStatus status = smooth(handle, "paramGetDerivative", &par);
    if (status != kOfxStatOK)
        return status;
    wo_par_slope(par, time, values);
    va_list args;
    va_start(args, time);
    const OfxStatus given = give_numbers(par, values, "paramGetDerivative", args);
    va_end(args);
    return given;
}

static OfxStatus get_integral(OfxParamHandle handle, OfxTime from, OfxTime to, ...)
{
    wo_par *par;
    double values[4];
    const OfxStatus status = smooth(handle, "paramGetIntegral", &par);
    if (status != kOfxStatOK)
        return status;
    wo_par_integral(par, from, to, values);
    va_list args;
    va_start(args, to);
    const OfxStatus given = give_numbers(par, values, "paramGetIntegral", args);
    va_end(args);
    return given;
}

/* -------------------------------------------------------------------------------------- writing */

static OfxStatus allowed(const wo_object *object, const char *what, const char *function)
{
    const wo_frame *frame = wo_frame_now();
    if (!frame) {
        wo_violate(object->host, "%s of %.80s outside of any action", function, what);
        return kOfxStatFailed;
    }
    if (frame->object != object || !wo_action_sets_params(frame->action) || frame->spawned) {
        wo_violate(object->host, "%s of %.80s in an action that must not change parameters",
                   function, what);
        return kOfxStatFailed;
    }
    return kOfxStatOK;
}

static OfxStatus writable(OfxParamHandle handle, const char *function, wo_par **par)
{
    const OfxStatus status = readable(handle, function, par);
    return status == kOfxStatOK ? allowed((*par)->owner, (*par)->name, function) : status;
}

static void note_change(wo_par *par)
{
    wo_host_instance *instance = (wo_host_instance *)par->owner;
    wo_mark_changed(instance, par->name);
    if (wo_frame_now()->action == WO_ACTION_CREATE)
        return;
    if (!par->plugin_changed)
        par->change = ++instance->changes;
    par->plugin_changed = true;
    instance->any_plugin_changed = true;
}

/* Reads the values of a setter; numbers beyond the hard range are brought to its end. */
static OfxStatus take(const wo_par *par, const char *function, double values[4], const char **text,
                      va_list args)
{
    memset(values, 0, 4 * sizeof *values);
    *text = NULL;
    if (par->is_text) {
        *text = va_arg(args, const char *);
        if (!*text || (par->kind == WO_HOST_PARAM_STR_CHOICE &&
                       !wo_props_has_text(&par->props, kOfxParamPropChoiceEnum, *text))) {
            wo_violate(par->owner->host, "%s of \"%.80s\" to %.80s", function, par->name,
                       *text ? *text : "NULL");
            return kOfxStatErrValue;
        }
        return kOfxStatOK;
    }
    for (int i = 0; i < par->dimension; i++) {
        double min, max;
        const double value = wo_par_is_integer(par) ? va_arg(args, int) : va_arg(args, double);
        wo_par_limits(par, i, &min, &max);
        if (isnan(value) ||
            (par->kind == WO_HOST_PARAM_CHOICE && !(value >= min && value <= max))) {
            wo_violate(par->owner->host, "%s of \"%.80s\" to %g", function, par->name, value);
            return kOfxStatErrValue;
        }
        values[i] = fmin(fmax(value, min), max);
    }
    return kOfxStatOK;
}

static OfxStatus set_value(OfxParamHandle handle, ...)
{
    wo_par *par;
    double values[4];
    const char *text;
    OfxStatus status = writable(handle, "paramSetValue", &par);
    if (status != kOfxStatOK)
        return status;
    va_list args;
    va_start(args, handle);
    status = take(par, "paramSetValue", values, &text, args);
    va_end(args);
    if (status != kOfxStatOK)
        return status;
    if (!wo_par_set(par, values, text))
        return kOfxStatErrMemory;
    note_change(par);
    return kOfxStatOK;
}

static OfxStatus set_value_at(OfxParamHandle handle, OfxTime time, ...)
{
    wo_par *par;
    double values[4];
    const char *text;
    OfxStatus status = writable(handle, "paramSetValueAtTime", &par);
    if (status != kOfxStatOK)
        return status;
    va_list args;
    va_start(args, time);
    status = take(par, "paramSetValueAtTime", values, &text, args);
    va_end(args);
    if (status != kOfxStatOK)
        return status;
    if (!isfinite(time)) {
        wo_violate(par->owner->host, "paramSetValueAtTime of \"%.80s\" at time %g", par->name,
                   time);
        return kOfxStatErrValue;
    }
    /* One that does not animate takes the value for all times. */
    if (!(wo_par_animates(par) ? wo_par_set_key(par, time, values, text)
                               : wo_par_set(par, values, text)))
        return kOfxStatErrMemory;
    note_change(par);
    return kOfxStatOK;
}

/* ----------------------------------------------------------------------------------------- keys */

static OfxStatus key_count(OfxParamHandle handle, unsigned int *count)
{
    wo_par *par;
    const OfxStatus status = readable(handle, "paramGetNumKeys", &par);
    if (status != kOfxStatOK)
        return status;
    if (!count)
        return no_place("paramGetNumKeys");
    *count = (unsigned)par->key_count;
    return kOfxStatOK;
}

static OfxStatus key_time(OfxParamHandle handle, unsigned int index, OfxTime *time)
{
    wo_par *par;
    const OfxStatus status = readable(handle, "paramGetKeyTime", &par);
    if (status != kOfxStatOK)
        return status;
    if (!time)
        return no_place("paramGetKeyTime");
    if (index >= par->key_count)
        return kOfxStatErrBadIndex;
    *time = par->keys[index].time;
    return kOfxStatOK;
}

static OfxStatus key_index(OfxParamHandle handle, OfxTime time, int direction, int *index)
{
    wo_par *par;
    const OfxStatus status = readable(handle, "paramGetKeyIndex", &par);
    if (status != kOfxStatOK)
        return status;
    if (!index)
        return no_place("paramGetKeyIndex");
    *index = wo_par_find_key(par, time, direction);
    return *index < 0 ? kOfxStatFailed : kOfxStatOK;
}

static OfxStatus delete_key(OfxParamHandle handle, OfxTime time)
{
    wo_par *par;
    const OfxStatus status = writable(handle, "paramDeleteKey", &par);
    if (status != kOfxStatOK)
        return status;
    if (!wo_par_delete_key(par, time))
        return kOfxStatErrBadIndex;
    note_change(par);
    return kOfxStatOK;
}

static OfxStatus delete_keys(OfxParamHandle handle)
{
    wo_par *par;
    const OfxStatus status = writable(handle, "paramDeleteAllKeys", &par);
    if (status != kOfxStatOK)
        return status;
    while (par->key_count > 1)
        wo_par_delete_key(par, par->keys[par->key_count - 1].time);
    if (par->key_count == 1)
        wo_par_delete_key(par, par->keys[0].time);
    note_change(par);
    return kOfxStatOK;
}

static OfxStatus copy(OfxParamHandle to, OfxParamHandle from, OfxTime offset,
                      const OfxRangeD *range)
{
    wo_par *a, *b;
    OfxStatus status = writable(to, "paramCopy", &a);
    if (status == kOfxStatOK)
        status = readable(from, "paramCopy", &b);
    if (status != kOfxStatOK)
        return status;
    if (a->kind != b->kind) {
        wo_violate(a->owner->host, "paramCopy of \"%.80s\" to \"%.80s\", which is of another type",
                   b->name, a->name);
        return kOfxStatErrValue;
    }
    const double limits[2] = {range ? range->min : 0, range ? range->max : 0};
    if (!wo_par_copy(a, b, offset, range ? limits : NULL))
        return kOfxStatErrMemory;
    note_change(a);
    return kOfxStatOK;
}

static OfxStatus edit_begin(OfxParamSetHandle handle, const char *name)
{
    (void)name; /* there is no undo to show it in */
    wo_object *object = find_set(handle, "paramEditBegin");
    if (!object)
        return kOfxStatErrBadHandle;
    const OfxStatus status = allowed(object, "the parameter set", "paramEditBegin");
    if (status == kOfxStatOK)
        ((wo_host_instance *)object)->edits++;
    return status;
}

static OfxStatus edit_end(OfxParamSetHandle handle)
{
    wo_object *object = find_set(handle, "paramEditEnd");
    if (!object)
        return kOfxStatErrBadHandle;
    const OfxStatus status = allowed(object, "the parameter set", "paramEditEnd");
    if (status != kOfxStatOK)
        return status;
    wo_host_instance *instance = (wo_host_instance *)object;
    if (instance->edits == 0) {
        wo_violate(object->host, "paramEditEnd without paramEditBegin");
        return kOfxStatFailed;
    }
    instance->edits--;
    return kOfxStatOK;
}

const OfxParameterSuiteV1 wo_parameter_suite = {
    .paramDefine = define,
    .paramGetHandle = get_handle,
    .paramSetGetPropertySet = set_properties,
    .paramGetPropertySet = param_properties,
    .paramGetValue = get_value,
    .paramGetValueAtTime = get_value_at,
    .paramGetDerivative = get_derivative,
    .paramGetIntegral = get_integral,
    .paramSetValue = set_value,
    .paramSetValueAtTime = set_value_at,
    .paramGetNumKeys = key_count,
    .paramGetKeyTime = key_time,
    .paramGetKeyIndex = key_index,
    .paramDeleteKey = delete_key,
    .paramDeleteAllKeys = delete_keys,
    .paramCopy = copy,
    .paramEditBegin = edit_begin,
    .paramEditEnd = edit_end,
};
