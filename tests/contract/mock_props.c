/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "mock_internal.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static atomic_int live_sets;

int mock_allocations_of_sets(bool forget)
{
    if (forget)
        atomic_store(&live_sets, 0);
    return atomic_load(&live_sets);
}

OfxPropertySetHandle set_new(void)
{
    atomic_fetch_add(&live_sets, 1);
    return calloc(1, sizeof(struct OfxPropertySetStruct));
}

void prop_clear(prop *p)
{
    for (int i = 0; p->type == 's' && i < p->count; i++)
        free(p->values[i].s);
    memset(p, 0, sizeof *p);
}

void set_free(OfxPropertySetHandle set)
{
    if (!set)
        return;
    for (int i = 0; i < set->count; i++)
        prop_clear(&set->items[i]);
    free(set);
    atomic_fetch_sub(&live_sets, 1);
}

prop *prop_find(OfxPropertySetHandle set, const char *name)
{
    for (int i = 0; set && i < set->count; i++)
        if (strcmp(set->items[i].name, name) == 0)
            return &set->items[i];
    return NULL;
}

static prop *grow(OfxPropertySetHandle set, const char *name, char type, int index)
{
    prop *p = prop_find(set, name);
    if ((mock.forget && strcmp(mock.forget, name) == 0) || index < 0 || index >= VALUES_MAX)
        return NULL;
    if (!p && set->count < PROPS_MAX) {
        p = &set->items[set->count++];
        snprintf(p->name, sizeof p->name, "%s", name);
        p->type = type;
    }
    if (!p || p->type != type || index > p->count)
        return NULL;
    if (index == p->count)
        p->count++;
    return p;
}

OfxStatus put_int(OfxPropertySetHandle set, const char *name, int index, int value)
{
    prop *const p = grow(set, name, 'i', index);
    if (!p)
        return kOfxStatErrUnknown;
    p->values[index].i = value;
    return kOfxStatOK;
}

OfxStatus put_double(OfxPropertySetHandle set, const char *name, int index, double value)
{
    prop *const p = grow(set, name, 'd', index);
    if (!p)
        return kOfxStatErrUnknown;
    p->values[index].d = value;
    return kOfxStatOK;
}

OfxStatus put_text(OfxPropertySetHandle set, const char *name, int index, const char *value)
{
    prop *const p = grow(set, name, 's', index);
    if (!p)
        return kOfxStatErrUnknown;
    const size_t size = strlen(value) + 1;
    free(p->values[index].s);
    p->values[index].s = malloc(size);
    memcpy(p->values[index].s, value, size);
    return kOfxStatOK;
}

OfxStatus put_pointer(OfxPropertySetHandle set, const char *name, int index, void *value)
{
    if ((mock.flags & MOCK_NO_INSTANCE_DATA) && strcmp(name, kOfxPropInstanceData) == 0)
        return kOfxStatErrUnknown;
    prop *const p = grow(set, name, 'p', index);
    if (!p)
        return kOfxStatErrUnknown;
    p->values[index].p = value;
    return kOfxStatOK;
}

static const prop *look(OfxPropertySetHandle set, const char *name, char type, int index)
{
    const prop *const p = prop_find(set, name);
    if (!p || (mock.forget && strcmp(mock.forget, name) == 0))
        return NULL;
    return p->type == type && index >= 0 && index < p->count ? p : NULL;
}

OfxStatus get_int(OfxPropertySetHandle set, const char *name, int index, int *value)
{
    const prop *const p = look(set, name, 'i', index);
    if (p)
        *value = p->values[index].i;
    return p ? kOfxStatOK : kOfxStatErrUnknown;
}

OfxStatus get_double(OfxPropertySetHandle set, const char *name, int index, double *value)
{
    const prop *const p = look(set, name, 'd', index);
    if (p)
        *value = p->values[index].d;
    return p ? kOfxStatOK : kOfxStatErrUnknown;
}

OfxStatus get_text(OfxPropertySetHandle set, const char *name, int index, char **value)
{
    const prop *const p = look(set, name, 's', index);
    if (p)
        *value = p->values[index].s;
    return p ? kOfxStatOK : kOfxStatErrUnknown;
}

OfxStatus get_pointer(OfxPropertySetHandle set, const char *name, int index, void **value)
{
    const prop *const p = look(set, name, 'p', index);
    if (p)
        *value = p->values[index].p;
    return p ? kOfxStatOK : kOfxStatErrUnknown;
}

static OfxStatus get_dimension(OfxPropertySetHandle set, const char *name, int *count)
{
    const prop *const p = prop_find(set, name);
    if (p)
        *count = p->count;
    return p ? kOfxStatOK : kOfxStatErrUnknown;
}

/* The vector functions are left out, as some hosts do. */
const void *mock_property_suite(void)
{
    static const OfxPropertySuiteV1 suite = {.propSetPointer = put_pointer,
                                             .propSetString = put_text,
                                             .propSetDouble = put_double,
                                             .propSetInt = put_int,
                                             .propGetPointer = get_pointer,
                                             .propGetString = get_text,
                                             .propGetDouble = get_double,
                                             .propGetInt = get_int,
                                             .propGetDimension = get_dimension};
    return &suite;
}
