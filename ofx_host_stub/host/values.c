/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "internal.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *type, *word;
    int dimension;
    bool integer, is_text;
} types[] = {
    [WO_HOST_PARAM_INTEGER] = {kOfxParamTypeInteger, "integer", 1, true, false},
    [WO_HOST_PARAM_DOUBLE] = {kOfxParamTypeDouble, "double", 1, false, false},
    [WO_HOST_PARAM_BOOLEAN] = {kOfxParamTypeBoolean, "boolean", 1, true, false},
    [WO_HOST_PARAM_CHOICE] = {kOfxParamTypeChoice, "choice", 1, true, false},
    [WO_HOST_PARAM_STR_CHOICE] = {kOfxParamTypeStrChoice, "string choice", 0, false, true},
    [WO_HOST_PARAM_RGBA] = {kOfxParamTypeRGBA, "rgba", 4, false, false},
    [WO_HOST_PARAM_RGB] = {kOfxParamTypeRGB, "rgb", 3, false, false},
    [WO_HOST_PARAM_DOUBLE_2D] = {kOfxParamTypeDouble2D, "double2d", 2, false, false},
    [WO_HOST_PARAM_DOUBLE_3D] = {kOfxParamTypeDouble3D, "double3d", 3, false, false},
    [WO_HOST_PARAM_INTEGER_2D] = {kOfxParamTypeInteger2D, "integer2d", 2, true, false},
    [WO_HOST_PARAM_INTEGER_3D] = {kOfxParamTypeInteger3D, "integer3d", 3, true, false},
    [WO_HOST_PARAM_STRING] = {kOfxParamTypeString, "string", 0, false, true},
    [WO_HOST_PARAM_CUSTOM] = {kOfxParamTypeCustom, "custom", 0, false, true},
    [WO_HOST_PARAM_GROUP] = {kOfxParamTypeGroup, "group", 0, false, false},
    [WO_HOST_PARAM_PAGE] = {kOfxParamTypePage, "page", 0, false, false},
    [WO_HOST_PARAM_PUSH_BUTTON] = {kOfxParamTypePushButton, "push button", 0, false, false},
};

const char *wo_host_param_type_text(wo_host_param_type type)
{
    return (size_t)type < WO_COUNT(types) ? types[type].word : "unknown";
}

bool wo_param_type_of(const char *type, wo_host_param_type *kind, int *dimension, bool *is_text)
{
    for (size_t i = 0; i < WO_COUNT(types); i++) {
        if (strcmp(types[i].type, type) != 0)
            continue;
        *kind = (wo_host_param_type)i;
        *dimension = types[i].dimension;
        *is_text = types[i].is_text;
        return true;
    }
    return false;
}

bool wo_par_is_integer(const wo_par *par)
{
    return types[par->kind].integer;
}

bool wo_par_animates(const wo_par *par)
{
    return (par->dimension > 0 || par->is_text) && par->kind != WO_HOST_PARAM_CUSTOM &&
           wo_props_int(&par->props, kOfxParamPropAnimates, 0, 0) != 0;
}

void wo_par_limits(const wo_par *par, int dimension, double *min, double *max)
{
    *min = -DBL_MAX;
    *max = DBL_MAX;
    if (par->kind == WO_HOST_PARAM_BOOLEAN) {
        *min = 0;
        *max = 1;
    } else if (par->kind == WO_HOST_PARAM_CHOICE) {
        *min = 0;
        *max = wo_props_count(&par->props, kOfxParamPropChoiceOption) - 1;
    } else if (wo_par_is_integer(par)) {
        *min = wo_props_int(&par->props, kOfxParamPropMin, dimension, INT_MIN);
        *max = wo_props_int(&par->props, kOfxParamPropMax, dimension, INT_MAX);
    } else if (par->dimension > 0) {
        *min = wo_props_double(&par->props, kOfxParamPropMin, dimension, -DBL_MAX);
        *max = wo_props_double(&par->props, kOfxParamPropMax, dimension, DBL_MAX);
    }
}

/* Keys hold their value until the next one instead of moving towards it. */
static bool steps(const wo_par *par)
{
    return par->is_text || par->kind == WO_HOST_PARAM_BOOLEAN ||
           par->kind == WO_HOST_PARAM_CHOICE ||
           strcmp(wo_props_text(&par->props, kOfxParamInterpType, 0, ""),
                  kOfxParamInterpTypeConstantStep) == 0;
}

/* Index of the last key at or before time, or -1. */
static ptrdiff_t key_before(const wo_par *par, double time)
{
    size_t low = 0, high = par->key_count;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (par->keys[middle].time <= time)
            low = middle + 1;
        else
            high = middle;
    }
    return (ptrdiff_t)low - 1;
}

void wo_par_at(const wo_par *par, double time, double values[4])
{
    memcpy(values, par->value, sizeof par->value);
    if (par->key_count == 0)
        return;
    const ptrdiff_t before = key_before(par, time);
    const wo_key *a = &par->keys[before < 0 ? 0 : before];
    memcpy(values, a->value, sizeof a->value);
    if (before < 0 || (size_t)before + 1 >= par->key_count || steps(par))
        return;
    const wo_key *b = a + 1;
    const double t = (time - a->time) / (b->time - a->time);
    for (int i = 0; i < par->dimension; i++) {
        values[i] = a->value[i] * (1 - t) + b->value[i] * t;
        if (wo_par_is_integer(par))
            values[i] = floor(values[i] + 0.5);
    }
}

const char *wo_par_text_at(const wo_par *par, double time)
{
    if (par->key_count == 0)
        return par->text;
    const ptrdiff_t before = key_before(par, time);
    const char *text = par->keys[before < 0 ? 0 : before].text;
    return text ? text : "";
}

/* Slope of the straight pieces; at a key, of the piece after it. */
void wo_par_slope(const wo_par *par, double time, double slope[4])
{
    memset(slope, 0, 4 * sizeof *slope);
    const ptrdiff_t before = key_before(par, time);
    if (before < 0 || (size_t)before + 1 >= par->key_count || steps(par))
        return;
    const wo_key *a = &par->keys[before], *b = a + 1;
    for (int i = 0; i < par->dimension; i++)
        slope[i] = (b->value[i] - a->value[i]) / (b->time - a->time);
}

void wo_par_integral(const wo_par *par, double from, double to, double integral[4])
{
    const double sign = from <= to ? 1 : -1;
    double at = from <= to ? from : to;
    const double end = from <= to ? to : from;
    memset(integral, 0, 4 * sizeof *integral);
    while (at < end) {
        const ptrdiff_t before = key_before(par, at);
        double next = end;
        if ((size_t)(before + 1) < par->key_count && par->keys[before + 1].time < end)
            next = par->keys[before + 1].time;
        double value[4];
        wo_par_at(par, steps(par) ? at : (at + next) / 2, value); /* straight piece: exact */
        for (int i = 0; i < par->dimension; i++)
            integral[i] += sign * value[i] * (next - at);
        at = next;
    }
}

void wo_par_show_animating(wo_par *par)
{
    wo_prop *prop = wo_props_find(&par->props, kOfxParamPropIsAnimating);
    wo_process_lock();
    if (prop && prop->count > 0)
        prop->values[0].number = par->key_count > 0;
    wo_process_unlock();
}

static void drop_keys(wo_par *par)
{
    for (size_t i = 0; i < par->key_count; i++)
        free(par->keys[i].text);
    par->key_count = 0;
}

void wo_par_clear_keys(wo_par *par)
{
    drop_keys(par);
    wo_par_show_animating(par);
}

void wo_par_free_values(wo_par *par)
{
    drop_keys(par);
    free(par->keys);
    free(par->text);
    par->keys = NULL;
    par->text = NULL;
    par->key_capacity = 0;
}

bool wo_par_set(wo_par *par, const double values[4], const char *text)
{
    if (par->is_text && !wo_text_set(&par->text, text))
        return false;
    if (!par->is_text)
        memcpy(par->value, values, sizeof par->value);
    wo_par_clear_keys(par);
    return true;
}

bool wo_par_set_key(wo_par *par, double time, const double values[4], const char *text)
{
    const ptrdiff_t before = key_before(par, time);
    if (before >= 0 && par->keys[before].time == time) {
        wo_key *key = &par->keys[before];
        if (par->is_text)
            return wo_text_set(&key->text, text);
        memcpy(key->value, values, sizeof key->value);
        return true;
    }
    wo_key key = {.time = time};
    if (par->is_text && !(key.text = wo_text_copy(text)))
        return false;
    if (!par->is_text)
        memcpy(key.value, values, sizeof key.value);
    wo_key *keys = wo_grow(par->keys, par->key_count, &par->key_capacity, sizeof *par->keys);
    if (!keys) {
        free(key.text);
        return false;
    }
    par->keys = keys;
    const size_t at = (size_t)(before + 1);
    memmove(&keys[at + 1], &keys[at], (par->key_count - at) * sizeof *keys);
    keys[at] = key;
    par->key_count++;
    wo_par_show_animating(par);
    return true;
}

bool wo_par_delete_key(wo_par *par, double time)
{
    const ptrdiff_t at = key_before(par, time);
    if (at < 0 || par->keys[at].time != time)
        return false;
    if (par->key_count == 1) { /* what it held stays as the plain value */
        memcpy(par->value, par->keys[0].value, sizeof par->value);
        if (par->is_text) {
            free(par->text);
            par->text = par->keys[0].text;
            par->keys[0].text = NULL;
        }
    }
    free(par->keys[at].text);
    par->key_count--;
    memmove(&par->keys[at], &par->keys[at + 1], (par->key_count - (size_t)at) * sizeof *par->keys);
    wo_par_show_animating(par);
    return true;
}

int wo_par_find_key(const wo_par *par, double time, int direction)
{
    ptrdiff_t at = key_before(par, time);
    if (direction == 0)
        return at >= 0 && par->keys[at].time == time ? (int)at : -1;
    if (direction > 0)
        return (size_t)(at + 1) < par->key_count ? (int)(at + 1) : -1;
    if (at >= 0 && par->keys[at].time == time)
        at--;
    return (int)at;
}

bool wo_par_copy(wo_par *to, const wo_par *from, double offset, const double *range)
{
    const bool all = !range || (range[0] == 0 && range[1] == 0);
    if (to == from)
        return true;
    if (!wo_par_set(to, from->value, from->text))
        return false;
    for (size_t i = 0; i < from->key_count; i++) {
        const wo_key *key = &from->keys[i];
        if (!all && !(key->time >= range[0] && key->time <= range[1]))
            continue;
        if (!wo_par_set_key(to, key->time + offset, key->value, key->text ? key->text : ""))
            return false;
    }
    return true;
}
