/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "internal.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void value_free(const wo_prop *prop, wo_prop_value *value)
{
    if (prop->type == WO_PROP_STRING)
        free(value->text);
    *value = (wo_prop_value){0};
}

bool wo_prop_resize(wo_prop *prop, int count)
{
    if (count == prop->count)
        return true;
    wo_prop_value *values = NULL;
    if (count > 0) {
        values = calloc((size_t)count, sizeof *values);
        if (!values)
            return false;
    }
    for (int i = 0; i < prop->count; i++) {
        if (i < count)
            values[i] = prop->values[i];
        else
            value_free(prop, &prop->values[i]);
    }
    free(prop->values);
    prop->values = values;
    prop->count = count;
    return true;
}

bool wo_prop_put_text(wo_prop *prop, int index, const char *value)
{
    char *copy = wo_text_copy(value ? value : "");
    if (!copy)
        return false;
    free(prop->values[index].text);
    prop->values[index].text = copy;
    return true;
}

static bool reset(wo_prop *prop)
{
    if (!wo_prop_resize(prop, prop->fixed))
        return false;
    for (int i = 0; i < prop->count; i++) {
        switch (prop->type) {
        case WO_PROP_INT:
            prop->values[i].number = (int)prop->number;
            break;
        case WO_PROP_DOUBLE:
            prop->values[i].real = prop->number;
            break;
        case WO_PROP_POINTER:
            prop->values[i].pointer = NULL;
            break;
        case WO_PROP_STRING:
            if (!wo_prop_put_text(prop, i, prop->text))
                return false;
            break;
        }
    }
    return true;
}

void wo_prop_reset(wo_prop *prop)
{
    (void)reset(prop); /* without memory a text keeps its value */
}

void wo_props_init(wo_props *props, wo_host *host, wo_props_when when, const char *format, ...)
{
    va_list args;
    *props = (wo_props){.host = host, .when = when};
    va_start(args, format);
    vsnprintf(props->what, sizeof props->what, format, args);
    va_end(args);
    props->handle = wo_handle_add(WO_HANDLE_PROPS, props);
    props->failed = !props->handle;
}

void wo_props_clear(wo_props *props)
{
    wo_process_lock();
    wo_handle_remove(props->handle);
    wo_prop *items = props->items;
    const size_t count = props->count;
    *props = (wo_props){0};
    wo_process_unlock();
    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < items[i].count; k++)
            value_free(&items[i], &items[i].values[k]);
        free(items[i].values);
        free(items[i].name);
    }
    free(items);
}

wo_prop *wo_props_find(const wo_props *props, const char *name)
{
    for (size_t i = 0; i < props->count; i++)
        if (strcmp(props->items[i].name, name) == 0)
            return &props->items[i];
    return NULL;
}

static void add(wo_props *props, const wo_prop_row *row)
{
    if (wo_props_find(props, row->name))
        return;
    wo_prop *items = wo_grow(props->items, props->count, &props->capacity, sizeof *props->items);
    if (!items) {
        props->failed = true;
        return;
    }
    props->items = items;
    wo_prop prop = {
        .name = wo_text_copy(row->name),
        .type = row->type,
        .fixed = row->count,
        .plugin_writes = row->plugin_writes,
        .number = row->number,
        .text = row->text,
    };
    if (!prop.name || !reset(&prop)) {
        props->failed = true;
        for (int i = 0; i < prop.count; i++)
            value_free(&prop, &prop.values[i]);
        free(prop.values);
        free(prop.name);
        return;
    }
    props->items[props->count++] = prop;
}

void wo_props_add(wo_props *props, const wo_prop_row *rows, size_t count)
{
    for (size_t i = 0; i < count; i++)
        add(props, &rows[i]);
}

void wo_props_add_one(wo_props *props, const char *name, wo_prop_type type, int count,
                      bool plugin_writes)
{
    add(props, &(wo_prop_row){name, type, count, plugin_writes, 0, NULL});
}

void wo_props_copy(wo_props *to, const wo_props *from)
{
    for (size_t i = 0; i < from->count; i++) {
        const wo_prop *p = &from->items[i];
        add(to, &(wo_prop_row){p->name, p->type, p->fixed, false, p->number, p->text});
        wo_prop *q = wo_props_find(to, p->name);
        if (!q || !wo_prop_resize(q, p->count)) {
            to->failed = true;
            return;
        }
        q->touched = p->touched;
        for (int k = 0; k < p->count; k++) {
            if (p->type != WO_PROP_STRING)
                q->values[k] = p->values[k];
            else if (!wo_prop_put_text(q, k, p->values[k].text))
                to->failed = true;
        }
    }
}

void wo_props_allow(wo_props *props, const char *name)
{
    wo_prop *prop = wo_props_find(props, name);
    if (prop)
        prop->plugin_writes = true;
}

/* Place of one value, made when it is the next one of a growing property. */
static wo_prop_value *place(wo_props *props, const char *name, wo_prop_type type, int index)
{
    wo_prop *prop = wo_props_find(props, name);
    if (!prop || prop->type != type || index < 0 || (prop->fixed && index >= prop->fixed) ||
        (index >= prop->count && !wo_prop_resize(prop, index + 1))) {
        props->failed = true;
        return NULL;
    }
    return &prop->values[index];
}

void wo_props_set_int(wo_props *props, const char *name, int index, int value)
{
    wo_prop_value *at = place(props, name, WO_PROP_INT, index);
    if (at)
        at->number = value;
}

void wo_props_set_double(wo_props *props, const char *name, int index, double value)
{
    wo_prop_value *at = place(props, name, WO_PROP_DOUBLE, index);
    if (at)
        at->real = value;
}

void wo_props_set_text(wo_props *props, const char *name, int index, const char *value)
{
    if (!place(props, name, WO_PROP_STRING, index))
        return;
    if (!wo_prop_put_text(wo_props_find(props, name), index, value))
        props->failed = true;
}

void wo_props_set_pointer(wo_props *props, const char *name, int index, void *value)
{
    wo_prop_value *at = place(props, name, WO_PROP_POINTER, index);
    if (at)
        at->pointer = value;
}

static const wo_prop_value *look(const wo_props *props, const char *name, wo_prop_type type,
                                 int index)
{
    const wo_prop *prop = wo_props_find(props, name);
    if (!prop || prop->type != type || index < 0 || index >= prop->count)
        return NULL;
    return &prop->values[index];
}

int wo_props_int(const wo_props *props, const char *name, int index, int otherwise)
{
    const wo_prop_value *at = look(props, name, WO_PROP_INT, index);
    return at ? at->number : otherwise;
}

double wo_props_double(const wo_props *props, const char *name, int index, double otherwise)
{
    const wo_prop_value *at = look(props, name, WO_PROP_DOUBLE, index);
    return at ? at->real : otherwise;
}

const char *wo_props_text(const wo_props *props, const char *name, int index, const char *otherwise)
{
    const wo_prop_value *at = look(props, name, WO_PROP_STRING, index);
    return at && at->text ? at->text : otherwise;
}

int wo_props_count(const wo_props *props, const char *name)
{
    const wo_prop *prop = wo_props_find(props, name);
    return prop ? prop->count : 0;
}

bool wo_props_has_text(const wo_props *props, const char *name, const char *value)
{
    for (int i = 0; i < wo_props_count(props, name); i++)
        if (strcmp(wo_props_text(props, name, i, ""), value) == 0)
            return true;
    return false;
}
