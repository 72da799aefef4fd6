/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "mock_internal.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static OfxParamHandle find_param(OfxParamSetHandle set, const char *name)
{
    for (int i = 0; i < set->count; i++)
        if (strcmp(set->items[i].name, name) == 0)
            return &set->items[i];
    return NULL;
}

static bool fails(const char *name, mock_loss how)
{
    return mock.lose == how && mock.lost && (!*mock.lost || strcmp(mock.lost, name) == 0);
}

static OfxStatus param_define(OfxParamSetHandle set, const char *type, const char *name,
                              OfxPropertySetHandle *props)
{
    if (mock.refuse && strcmp(mock.refuse, type) == 0)
        return kOfxStatErrUnsupported;
    if (fails(name, MOCK_LOSE_DEFINE))
        return kOfxStatFailed;
    if (find_param(set, name) || set->count == PARAMS_MAX)
        return kOfxStatErrExists;
    const OfxParamHandle param = &set->items[set->count++];
    memset(param, 0, sizeof *param);
    snprintf(param->name, sizeof param->name, "%s", name);
    snprintf(param->type, sizeof param->type, "%s", type);
    param->props = set_new();
    *props = param->props;
    return kOfxStatOK;
}

static OfxStatus param_get_handle(OfxParamSetHandle set, const char *name, OfxParamHandle *param,
                                  OfxPropertySetHandle *props)
{
    *param = fails(name, MOCK_LOSE_HANDLE) ? NULL : find_param(set, name);
    if (*param && props)
        *props = (*param)->props;
    return *param ? kOfxStatOK : kOfxStatErrUnknown;
}

static void give(OfxParamHandle param, va_list arguments)
{
    if (strcmp(param->type, kOfxParamTypeString) == 0) {
        *va_arg(arguments, char **) = param->text;
    } else if (strcmp(param->type, kOfxParamTypeDouble) == 0 ||
               strcmp(param->type, kOfxParamTypeDouble2D) == 0 ||
               strcmp(param->type, kOfxParamTypeRGB) == 0) {
        const int count = strcmp(param->type, kOfxParamTypeRGB) == 0        ? 3
                          : strcmp(param->type, kOfxParamTypeDouble2D) == 0 ? 2
                                                                            : 1;
        for (int i = 0; i < count; i++)
            *va_arg(arguments, double *) = param->numbers[i];
    } else {
        *va_arg(arguments, int *) = (int)param->numbers[0];
    }
}

static OfxStatus param_get(OfxParamHandle param, ...)
{
    va_list arguments;
    if (fails(param->name, MOCK_LOSE_VALUE))
        return kOfxStatFailed;
    if (fails(param->name, MOCK_LOSE_SILENTLY))
        return kOfxStatOK;
    va_start(arguments, param);
    give(param, arguments);
    va_end(arguments);
    return kOfxStatOK;
}

static OfxStatus param_get_at(OfxParamHandle param, OfxTime time, ...)
{
    va_list arguments;
    (void)time;
    if (fails(param->name, MOCK_LOSE_VALUE) || fails(param->name, MOCK_LOSE_AT_TIME))
        return kOfxStatErrUnsupported;
    if (fails(param->name, MOCK_LOSE_SILENTLY))
        return kOfxStatOK;
    va_start(arguments, time);
    give(param, arguments);
    va_end(arguments);
    return kOfxStatOK;
}

/* Of all types only points are set by plugins. */
static OfxStatus param_set(OfxParamHandle param, ...)
{
    va_list arguments;
    if (strcmp(param->type, kOfxParamTypeDouble2D) != 0)
        return kOfxStatErrUnsupported;
    va_start(arguments, param);
    for (int i = 0; i < 2; i++)
        param->numbers[i] = va_arg(arguments, double);
    va_end(arguments);
    mock.values_set++;
    return kOfxStatOK;
}

static OfxStatus edit_begin(OfxParamSetHandle set, const char *name)
{
    mock.edits_begun++;
    snprintf(mock.edit, sizeof mock.edit, "%s", name);
    return set ? kOfxStatOK : kOfxStatErrBadHandle;
}

static OfxStatus edit_end(OfxParamSetHandle set)
{
    mock.edits_ended++;
    return set ? kOfxStatOK : kOfxStatErrBadHandle;
}

const void *mock_param_suite(void)
{
    static const OfxParameterSuiteV1 read_only = {.paramDefine = param_define,
                                                  .paramGetHandle = param_get_handle,
                                                  .paramGetValueAtTime = param_get_at};
    static const OfxParameterSuiteV1 timeless = {.paramDefine = param_define,
                                                 .paramGetHandle = param_get_handle,
                                                 .paramGetValue = param_get};
    static const OfxParameterSuiteV1 suite = {.paramDefine = param_define,
                                              .paramGetHandle = param_get_handle,
                                              .paramGetValue = param_get,
                                              .paramGetValueAtTime = param_get_at,
                                              .paramSetValue = param_set,
                                              .paramEditBegin = edit_begin,
                                              .paramEditEnd = edit_end};
    if (mock.flags & MOCK_TIMELESS)
        return &timeless;
    return mock.flags & MOCK_READ_ONLY ? &read_only : &suite;
}

bool mock_set_number(OfxImageEffectHandle effect, const char *name, double x, double y, double z)
{
    const OfxParamHandle param = find_param(&effect->params, name);
    if (param)
        memcpy(param->numbers, (double[3]){x, y, z}, sizeof param->numbers);
    return param != NULL;
}

bool mock_get_number(OfxImageEffectHandle effect, const char *name, double values[3])
{
    const OfxParamHandle param = find_param(&effect->params, name);
    if (param)
        memcpy(values, param->numbers, sizeof param->numbers);
    return param != NULL;
}

bool mock_set_text(OfxImageEffectHandle effect, const char *name, const char *text)
{
    const OfxParamHandle param = find_param(&effect->params, name);
    if (!param)
        return false;
    free(param->text);
    param->text = NULL;
    if (text) {
        param->text = malloc(strlen(text) + 1);
        strcpy(param->text, text);
    }
    return true;
}

/* The values an instance starts with are the defaults of the descriptor. */
void take_defaults(OfxImageEffectHandle effect)
{
    for (int i = 0; i < effect->params.count; i++) {
        const OfxParamHandle param = &effect->params.items[i];
        const prop *const initial = prop_find(param->props, kOfxParamPropDefault);
        if (initial && initial->type == 's')
            mock_set_text(effect, param->name, initial->values[0].s);
        for (int j = 0; initial && initial->type != 's' && j < initial->count && j < 3; j++)
            param->numbers[j] = initial->type == 'i' ? initial->values[j].i : initial->values[j].d;
    }
}

const char *mock_param_text(OfxImageEffectHandle effect, const char *param, const char *property,
                            int index)
{
    static char number[32];
    const OfxParamHandle p = find_param(&effect->params, param);
    const prop *const it = prop_find(*param ? (p ? p->props : NULL) : effect->props, property);
    if (!it || index >= it->count)
        return NULL;
    if (it->type == 's')
        return it->values[index].s;
    snprintf(number, sizeof number, "%g",
             it->type == 'i' ? it->values[index].i : it->values[index].d);
    return number;
}

void *mock_effect_pointer(OfxImageEffectHandle effect, const char *property)
{
    void *value = NULL;
    get_pointer(effect->props, property, 0, &value);
    return value;
}

int mock_clip_number(OfxImageEffectHandle effect, const char *clip, const char *property)
{
    int value = -1;
    for (int i = 0; i < effect->clip_count; i++)
        if (strcmp(effect->clips[i].name, clip) == 0)
            get_int(effect->clips[i].props, property, 0, &value);
    return value;
}

int mock_param_count(OfxImageEffectHandle effect)
{
    return effect->params.count;
}

bool mock_has_param(OfxImageEffectHandle effect, const char *param)
{
    return find_param(&effect->params, param) != NULL;
}
