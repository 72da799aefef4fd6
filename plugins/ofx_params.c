/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_params.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Values that no parameter has: where they still stand the host has written nothing. */
static const double no_number = -DBL_MAX;
static const int no_whole = INT_MIN;

/* Calls with the pointers a row's type wants: the types are those of ofx_describe.c. Hosts that do
   not know the one at a time know the one of now. */
#define READ(...)                                                                                  \
    ((s->paramGetValueAtTime && s->paramGetValueAtTime(h, time, __VA_ARGS__) == kOfxStatOK) ||     \
     (s->paramGetValue && s->paramGetValue(h, __VA_ARGS__) == kOfxStatOK))

static bool read_values(const OfxParameterSuiteV1 *s, const wo_param *param, OfxParamHandle h,
                        double time, double values[3])
{
    int whole = no_whole;
    for (int i = 0; i < 3; i++)
        values[i] = no_number;
    switch (param->type) {
    case WO_PARAM_DOUBLE:
        return READ(&values[0]) && values[0] != no_number;
    case WO_PARAM_POINT:
        return READ(&values[0], &values[1]) && values[0] != no_number && values[1] != no_number;
    case WO_PARAM_COLOUR:
        return READ(&values[0], &values[1], &values[2]) && values[0] != no_number &&
               values[1] != no_number && values[2] != no_number;
    case WO_PARAM_INT:
    case WO_PARAM_BOOL:
    case WO_PARAM_CHOICE:
        if (!READ(&whole) || whole == no_whole)
            return false;
        values[0] = param->type == WO_PARAM_BOOL ? whole != 0 : whole;
        return true;
    case WO_PARAM_STRING:
        break;
    }
    return false;
}

/* *given is false where the default stays. */
static wo_status read_param(const OfxParameterSuiteV1 *s, const wo_param *param, OfxParamHandle h,
                            double time, void *params, bool *given, wo_error *error)
{
    if (param->type == WO_PARAM_STRING) {
        char *text = NULL;
        *given = READ(&text) && text;
        return *given ? wo_param_set_text(param, params, text, error) : WO_OK;
    }
    double values[3];
    *given = read_values(s, param, h, time, values);
    if (!*given)
        return WO_OK;
    if (param->type != WO_PARAM_BOOL && param->type != WO_PARAM_CHOICE)
        for (int i = 0; i < wo_param_values(param); i++)
            if (!isnan(values[i]))
                values[i] = fmin(fmax(values[i], param->min), param->max);
    return wo_param_set(param, params, values, error);
}

static void lose(wo_ofx_lost *lost, const char *key)
{
    if (!lost || lost->count++ >= WO_OFX_LOST_NAMED)
        return;
    const size_t used = strlen(lost->keys);
    snprintf(lost->keys + used, sizeof lost->keys - used, "%s%s", used ? ", " : "", key);
}

wo_status wo_ofx_read_params(const wo_ofx_suites *suites, const wo_effect *effect,
                             OfxImageEffectHandle handle, double time, void *params,
                             wo_ofx_lost *lost, wo_error *error)
{
    OfxParamSetHandle set = NULL;
    if (lost)
        *lost = (wo_ofx_lost){.count = 0};
    wo_params_default(effect->params, effect->param_count, params);
    if (suites->effect->getParamSet(handle, &set) != kOfxStatOK)
        set = NULL;
    for (size_t i = 0; i < effect->param_count; i++) {
        const wo_param *const param = &effect->params[i];
        OfxParamHandle h = NULL;
        bool given = false;
        if (set && suites->param->paramGetHandle(set, param->key, &h, NULL) == kOfxStatOK && h)
            WO_TRY(read_param(suites->param, param, h, time, params, &given, error));
        if (!given)
            lose(lost, param->key);
    }
    return WO_OK;
}
