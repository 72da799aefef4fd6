/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_params.h"

#include <math.h>

/* Value of one number parameter; the types of the pointers are those of ofx_describe.c. */
static OfxStatus read_values(const wo_ofx_suites *suites, const wo_param *param, OfxParamHandle h,
                             double time, double values[3])
{
    int whole = 0;
    OfxStatus status = kOfxStatFailed;
    switch (param->type) {
    case WO_PARAM_DOUBLE:
        return suites->param->paramGetValueAtTime(h, time, &values[0]);
    case WO_PARAM_POINT:
        return suites->param->paramGetValueAtTime(h, time, &values[0], &values[1]);
    case WO_PARAM_COLOUR:
        return suites->param->paramGetValueAtTime(h, time, &values[0], &values[1], &values[2]);
    case WO_PARAM_INT:
    case WO_PARAM_BOOL:
    case WO_PARAM_CHOICE:
        status = suites->param->paramGetValueAtTime(h, time, &whole);
        values[0] = param->type == WO_PARAM_BOOL ? whole != 0 : whole;
        break;
    case WO_PARAM_STRING:
        break;
    }
    return status;
}

static wo_status read_param(const wo_ofx_suites *suites, const wo_param *param, OfxParamHandle h,
                            double time, void *params, wo_error *error)
{
    if (param->type == WO_PARAM_STRING) {
        char *text = NULL;
        if (suites->param->paramGetValueAtTime(h, time, &text) != kOfxStatOK)
            return wo_fail(error, WO_ERR_NOT_FOUND, "%s: the host gives no text", param->key);
        return wo_param_set_text(param, params, text ? text : "", error);
    }
    double values[3] = {0, 0, 0};
    if (read_values(suites, param, h, time, values) != kOfxStatOK)
        return wo_fail(error, WO_ERR_NOT_FOUND, "%s: the host gives no value", param->key);
    if (param->type != WO_PARAM_BOOL && param->type != WO_PARAM_CHOICE)
        for (int i = 0; i < wo_param_values(param); i++)
            if (!isnan(values[i]))
                values[i] = fmin(fmax(values[i], param->min), param->max);
    return wo_param_set(param, params, values, error);
}

wo_status wo_ofx_read_params(const wo_ofx_suites *suites, const wo_effect *effect,
                             OfxImageEffectHandle handle, double time, void *params,
                             wo_error *error)
{
    OfxParamSetHandle set = NULL;
    wo_params_default(effect->params, effect->param_count, params);
    if (suites->effect->getParamSet(handle, &set) != kOfxStatOK || !set)
        return wo_fail(error, WO_ERR_NOT_FOUND, "the host has no parameters for this effect");
    for (size_t i = 0; i < effect->param_count; i++) {
        const wo_param *const param = &effect->params[i];
        OfxParamHandle h = NULL;
        if (suites->param->paramGetHandle(set, param->key, &h, NULL) == kOfxStatOK && h)
            WO_TRY(read_param(suites, param, h, time, params, error));
    }
    return WO_OK;
}
