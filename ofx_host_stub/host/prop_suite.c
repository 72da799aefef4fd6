/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "suites.h"

#include <string.h>

/* The process lock is held from enter to leave: sets that one thread frees cannot vanish under
   another one's hands. */

static const char *const type_faults[] = {"it is an int", "it is a double", "it is a string",
                                          "it is a pointer"};

static OfxStatus leave(OfxStatus status)
{
    wo_process_unlock();
    return status;
}

/* What the violation says is gathered under the lock and written after it. */
static OfxStatus leave_with(const char *function, const char *name, const wo_props *props,
                            OfxStatus status, const char *why)
{
    wo_host *host = props->host;
    char what[sizeof props->what];
    memcpy(what, props->what, sizeof what);
    wo_process_unlock();
    wo_violate(host, "%s of \"%.80s\" of %s: %s", function, name ? name : "NULL", what, why);
    return status;
}

static OfxStatus enter(OfxPropertySetHandle handle, const char *name, const char *function,
                       wo_props **props)
{
    wo_process_lock();
    *props = wo_handle_find(handle, WO_HANDLE_PROPS);
    if (!*props) {
        const char *why = wo_handle_fault(handle, WO_HANDLE_PROPS);
        wo_process_unlock();
        wo_violate(NULL, "%s of \"%.80s\": the property set handle is %s", function,
                   name ? name : "NULL", why);
        return kOfxStatErrBadHandle;
    }
    if (!name)
        return leave_with(function, name, *props, kOfxStatErrUnknown, "the name is NULL");
    return kOfxStatOK;
}

/* Properties that a set does not have and a plugin wants to write: a fault when the name is one of
   the standard's, a note when it belongs to makers of hosts. */
static OfxStatus leave_unknown(const char *function, const char *name, const wo_props *props)
{
    wo_host *const host = props->host;
    if (!wo_is_extension(name))
        return leave_with(function, name, props, kOfxStatErrUnknown, "there is no such property");
    wo_process_unlock();
    wo_note_extension(host, name);
    return kOfxStatErrUnknown;
}

/* What happens while pixels are made must change nothing that a user sees. */
static bool is_render(wo_action action)
{
    return action == WO_ACTION_BEGIN_RENDER || action == WO_ACTION_RENDER ||
           action == WO_ACTION_END_RENDER;
}

static bool writable_now(const wo_props *props, const char *name)
{
    const wo_frame *frame = wo_frame_now();
    switch (props->when) {
    case WO_PROPS_NEVER:
        return false;
    case WO_PROPS_DESCRIBE:
        return frame && (frame->action == WO_ACTION_DESCRIBE ||
                         frame->action == WO_ACTION_DESCRIBE_IN_CONTEXT);
    case WO_PROPS_INSTANCE:
        return strcmp(name, kOfxParamPropDataPtr) == 0 || strcmp(name, kOfxPropInstanceData) == 0 ||
               (frame && !is_render(frame->action));
    case WO_PROPS_ACTION:
        return frame != NULL;
    }
    return false;
}

/* Finds a property to write; after anything but kOfxStatOK the lock is given back. */
static OfxStatus enter_write(OfxPropertySetHandle handle, const char *name, wo_prop_type type,
                             const char *function, wo_props **props, wo_prop **prop)
{
    const OfxStatus status = enter(handle, name, function, props);
    if (status != kOfxStatOK)
        return status;
    *prop = wo_props_find(*props, name);
    if (!*prop)
        return leave_unknown(function, name, *props);
    if ((*prop)->type != type)
        return leave_with(function, name, *props, kOfxStatErrValue, type_faults[(*prop)->type]);
    if (!(*prop)->plugin_writes)
        return leave_with(function, name, *props, kOfxStatErrValue, "it is read-only");
    if (!writable_now(*props, name))
        return leave_with(function, name, *props, kOfxStatFailed,
                          "it may not be written in this action");
    return kOfxStatOK;
}

static OfxStatus put(wo_prop *prop, int index, wo_prop_value value)
{
    if (prop->type != WO_PROP_STRING)
        prop->values[index] = value;
    else if (!wo_prop_put_text(prop, index, value.text))
        return kOfxStatErrMemory;
    prop->touched = true;
    return kOfxStatOK;
}

static OfxStatus set_one(OfxPropertySetHandle handle, const char *name, wo_prop_type type,
                         int index, wo_prop_value value, const char *function)
{
    wo_props *props;
    wo_prop *prop;
    const OfxStatus status = enter_write(handle, name, type, function, &props, &prop);
    if (status != kOfxStatOK)
        return status;
    if (index < 0 || (prop->fixed ? index >= prop->fixed : index > prop->count))
        return leave_with(function, name, props, kOfxStatErrBadIndex, "the index is out of range");
    if (type == WO_PROP_STRING && !value.text)
        return leave_with(function, name, props, kOfxStatErrValue, "the value is NULL");
    if (index >= prop->count && !wo_prop_resize(prop, index + 1))
        return leave(kOfxStatErrMemory);
    return leave(put(prop, index, value));
}

static OfxStatus set_many(OfxPropertySetHandle handle, const char *name, wo_prop_type type,
                          int count, const void *values, size_t size, const char *function)
{
    wo_props *props;
    wo_prop *prop;
    OfxStatus status = enter_write(handle, name, type, function, &props, &prop);
    if (status != kOfxStatOK)
        return status;
    if (count < 0 || (prop->fixed && count > prop->fixed))
        return leave_with(function, name, props, kOfxStatErrBadIndex,
                          "the count is not the property's dimension");
    if (count > 0 && !values)
        return leave_with(function, name, props, kOfxStatErrValue, "the values are NULL");
    for (int i = 0; type == WO_PROP_STRING && i < count; i++)
        if (!((const char *const *)values)[i])
            return leave_with(function, name, props, kOfxStatErrValue, "a value is NULL");
    if (!prop->fixed && !wo_prop_resize(prop, count))
        return leave(kOfxStatErrMemory);
    prop->touched = true;
    for (int i = 0; i < count && status == kOfxStatOK; i++) {
        wo_prop_value value = {0};
        memcpy(&value, (const char *)values + (size_t)i * size, size);
        status = put(prop, i, value);
    }
    return leave(status);
}

/* Reading what is not there is a plain answer for optional and growing properties, a breach where
   the standard fixes the type or the dimension. */
static OfxStatus get_many(OfxPropertySetHandle handle, const char *name, wo_prop_type type,
                          int from, int count, void *values, size_t size, const char *function)
{
    wo_props *props;
    OfxStatus status = enter(handle, name, function, &props);
    if (status != kOfxStatOK)
        return status;
    const wo_prop *prop = wo_props_find(props, name);
    if (!prop)
        return leave(kOfxStatErrUnknown);
    if (!values)
        return leave_with(function, name, props, kOfxStatErrValue, "no place for the value");
    if (prop->type != type)
        return leave_with(function, name, props, kOfxStatErrValue, type_faults[prop->type]);
    if (from < 0 || count < 0 || from > prop->count || count > prop->count - from) {
        if (prop->fixed || from < 0 || count < 0)
            return leave_with(function, name, props, kOfxStatErrBadIndex,
                              "the index is out of range");
        return leave(kOfxStatErrBadIndex);
    }
    for (int i = 0; i < count; i++)
        memcpy((char *)values + (size_t)i * size, &prop->values[from + i], size);
    return leave(kOfxStatOK);
}

static OfxStatus set_pointer(OfxPropertySetHandle set, const char *name, int index, void *value)
{
    return set_one(set, name, WO_PROP_POINTER, index, (wo_prop_value){.pointer = value},
                   "propSetPointer");
}

static OfxStatus set_string(OfxPropertySetHandle set, const char *name, int index,
                            const char *value)
{
    return set_one(set, name, WO_PROP_STRING, index, (wo_prop_value){.text = (char *)value},
                   "propSetString");
}

static OfxStatus set_double(OfxPropertySetHandle set, const char *name, int index, double value)
{
    return set_one(set, name, WO_PROP_DOUBLE, index, (wo_prop_value){.real = value},
                   "propSetDouble");
}

static OfxStatus set_int(OfxPropertySetHandle set, const char *name, int index, int value)
{
    return set_one(set, name, WO_PROP_INT, index, (wo_prop_value){.number = value}, "propSetInt");
}

static OfxStatus set_pointers(OfxPropertySetHandle set, const char *name, int count,
                              void *const *values)
{
    return set_many(set, name, WO_PROP_POINTER, count, values, sizeof *values, "propSetPointerN");
}

static OfxStatus set_strings(OfxPropertySetHandle set, const char *name, int count,
                             const char *const *values)
{
    return set_many(set, name, WO_PROP_STRING, count, values, sizeof *values, "propSetStringN");
}

static OfxStatus set_doubles(OfxPropertySetHandle set, const char *name, int count,
                             const double *values)
{
    return set_many(set, name, WO_PROP_DOUBLE, count, values, sizeof *values, "propSetDoubleN");
}

static OfxStatus set_ints(OfxPropertySetHandle set, const char *name, int count, const int *values)
{
    return set_many(set, name, WO_PROP_INT, count, values, sizeof *values, "propSetIntN");
}

static OfxStatus get_pointer(OfxPropertySetHandle set, const char *name, int index, void **value)
{
    return get_many(set, name, WO_PROP_POINTER, index, 1, value, sizeof *value, "propGetPointer");
}

static OfxStatus get_string(OfxPropertySetHandle set, const char *name, int index, char **value)
{
    return get_many(set, name, WO_PROP_STRING, index, 1, value, sizeof *value, "propGetString");
}

static OfxStatus get_double(OfxPropertySetHandle set, const char *name, int index, double *value)
{
    return get_many(set, name, WO_PROP_DOUBLE, index, 1, value, sizeof *value, "propGetDouble");
}

static OfxStatus get_int(OfxPropertySetHandle set, const char *name, int index, int *value)
{
    return get_many(set, name, WO_PROP_INT, index, 1, value, sizeof *value, "propGetInt");
}

static OfxStatus get_pointers(OfxPropertySetHandle set, const char *name, int count, void **values)
{
    return get_many(set, name, WO_PROP_POINTER, 0, count, values, sizeof *values,
                    "propGetPointerN");
}

static OfxStatus get_strings(OfxPropertySetHandle set, const char *name, int count, char **values)
{
    return get_many(set, name, WO_PROP_STRING, 0, count, values, sizeof *values, "propGetStringN");
}

static OfxStatus get_doubles(OfxPropertySetHandle set, const char *name, int count, double *values)
{
    return get_many(set, name, WO_PROP_DOUBLE, 0, count, values, sizeof *values, "propGetDoubleN");
}

static OfxStatus get_ints(OfxPropertySetHandle set, const char *name, int count, int *values)
{
    return get_many(set, name, WO_PROP_INT, 0, count, values, sizeof *values, "propGetIntN");
}

static OfxStatus reset(OfxPropertySetHandle set, const char *name)
{
    wo_props *props;
    const OfxStatus status = enter(set, name, "propReset", &props);
    if (status != kOfxStatOK)
        return status;
    wo_prop *prop = wo_props_find(props, name);
    if (!prop)
        return leave_unknown("propReset", name, props);
    if (!prop->plugin_writes)
        return leave_with("propReset", name, props, kOfxStatErrValue, "it is read-only");
    if (!writable_now(props, name))
        return leave_with("propReset", name, props, kOfxStatFailed,
                          "it may not be written in this action");
    wo_prop_reset(prop);
    prop->touched = false;
    return leave(kOfxStatOK);
}

static OfxStatus dimension(OfxPropertySetHandle set, const char *name, int *count)
{
    wo_props *props;
    const OfxStatus status = enter(set, name, "propGetDimension", &props);
    if (status != kOfxStatOK)
        return status;
    const wo_prop *prop = wo_props_find(props, name);
    if (!prop)
        return leave(kOfxStatErrUnknown);
    if (!count)
        return leave_with("propGetDimension", name, props, kOfxStatErrValue,
                          "no place for the value");
    *count = prop->count;
    return leave(kOfxStatOK);
}

const OfxPropertySuiteV1 wo_property_suite = {
    .propSetPointer = set_pointer,
    .propSetString = set_string,
    .propSetDouble = set_double,
    .propSetInt = set_int,
    .propSetPointerN = set_pointers,
    .propSetStringN = set_strings,
    .propSetDoubleN = set_doubles,
    .propSetIntN = set_ints,
    .propGetPointer = get_pointer,
    .propGetString = get_string,
    .propGetDouble = get_double,
    .propGetInt = get_int,
    .propGetPointerN = get_pointers,
    .propGetStringN = get_strings,
    .propGetDoubleN = get_doubles,
    .propGetIntN = get_ints,
    .propReset = reset,
    .propGetDimension = dimension,
};
