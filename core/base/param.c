/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/param.h"

#include "number.h"

#include <math.h>
#include <string.h>

int wo_param_values(const wo_param *param)
{
    switch (param->type) {
    case WO_PARAM_DOUBLE:
    case WO_PARAM_INT:
    case WO_PARAM_BOOL:
    case WO_PARAM_CHOICE:
        return 1;
    case WO_PARAM_POINT:
        return 2;
    case WO_PARAM_COLOUR:
        return 3;
    case WO_PARAM_STRING:
        break;
    }
    return 0;
}

int wo_param_choice_count(const wo_param *param)
{
    int count = 0;
    if (param->type == WO_PARAM_CHOICE && param->choices)
        while (param->choices[count])
            count++;
    return count;
}

const wo_param *wo_param_find(const wo_param *table, size_t count, const char *key)
{
    for (size_t i = 0; key && i < count; i++)
        if (strcmp(table[i].key, key) == 0)
            return &table[i];
    return NULL;
}

static bool is_whole_type(wo_param_type type)
{
    return type == WO_PARAM_INT || type == WO_PARAM_BOOL || type == WO_PARAM_CHOICE;
}

static void *field(const wo_param *param, void *params)
{
    return (char *)params + param->offset;
}

static const void *const_field(const wo_param *param, const void *params)
{
    return (const char *)params + param->offset;
}

/* The values must already fit the C type of the field. */
static void store(const wo_param *param, void *params, const double values[3])
{
    if (is_whole_type(param->type)) {
        const int32_t whole = (int32_t)values[0];
        memcpy(field(param, params), &whole, sizeof whole);
    } else {
        memcpy(field(param, params), values, (size_t)wo_param_values(param) * sizeof *values);
    }
}

static void store_text(const wo_param *param, void *params, const char *text, size_t length)
{
    char *const target = field(param, params);
    memcpy(target, text, length);
    memset(target + length, 0, WO_PARAM_STRING_SIZE - length);
}

void wo_params_default(const wo_param *table, size_t count, void *params)
{
    for (size_t i = 0; i < count; i++) {
        const wo_param *const param = &table[i];
        if (param->type == WO_PARAM_STRING) {
            const char *const text = param->initial_text ? param->initial_text : "";
            const size_t length = strlen(text);
            store_text(param, params, text,
                       length < WO_PARAM_STRING_SIZE ? length : WO_PARAM_STRING_SIZE - 1);
        } else {
            store(param, params, param->initial);
        }
    }
}

/* Booleans and choices bring their own range; the others have the table's. */
static void hard_range(const wo_param *param, double *min, double *max)
{
    *min = 0;
    *max = 1;
    if (param->type == WO_PARAM_CHOICE) {
        *max = wo_param_choice_count(param) - 1;
    } else if (param->type == WO_PARAM_INT) {
        *min = fmax(param->min, INT32_MIN);
        *max = fmin(param->max, INT32_MAX);
    } else if (param->type != WO_PARAM_BOOL) {
        *min = param->min;
        *max = param->max;
    }
}

static wo_status check(const wo_param *param, const double values[3], wo_error *error)
{
    double min, max;
    char text[WO_NUMBER_SIZE], low[WO_NUMBER_SIZE], high[WO_NUMBER_SIZE];
    hard_range(param, &min, &max);
    for (int i = 0; i < wo_param_values(param); i++) {
        if (!(values[i] >= min && values[i] <= max)) {
            wo_number_print(values[i], text);
            wo_number_print(min, low);
            wo_number_print(max, high);
            return wo_fail(error, WO_ERR_RANGE, "%s: %s is outside %s..%s", param->key, text, low,
                           high);
        }
        if (is_whole_type(param->type) && values[i] != floor(values[i])) {
            wo_number_print(values[i], text);
            return wo_fail(error, WO_ERR_RANGE, "%s: %s is not a whole number", param->key, text);
        }
    }
    return WO_OK;
}

void wo_param_get(const wo_param *param, const void *params, double values[3])
{
    values[0] = values[1] = values[2] = 0;
    if (is_whole_type(param->type)) {
        int32_t whole;
        memcpy(&whole, const_field(param, params), sizeof whole);
        values[0] = whole;
    } else {
        memcpy(values, const_field(param, params), (size_t)wo_param_values(param) * sizeof *values);
    }
}

wo_status wo_param_set(const wo_param *param, void *params, const double values[3], wo_error *error)
{
    if (param->type == WO_PARAM_STRING)
        return wo_fail(error, WO_ERR_ARGUMENT, "%s: is a text, not a number", param->key);
    WO_TRY(check(param, values, error));
    store(param, params, values);
    return WO_OK;
}

const char *wo_param_get_text(const wo_param *param, const void *params)
{
    return param->type == WO_PARAM_STRING ? const_field(param, params) : NULL;
}

wo_status wo_param_set_text(const wo_param *param, void *params, const char *text, wo_error *error)
{
    if (param->type != WO_PARAM_STRING)
        return wo_fail(error, WO_ERR_ARGUMENT, "%s: is a number, not a text", param->key);
    if (!text)
        return wo_fail(error, WO_ERR_ARGUMENT, "%s: no text was given", param->key);
    const size_t length = strlen(text);
    if (length >= WO_PARAM_STRING_SIZE)
        return wo_fail(error, WO_ERR_RANGE, "%s: a text of %zu bytes is longer than %d bytes",
                       param->key, length, WO_PARAM_STRING_SIZE - 1);
    store_text(param, params, text, length);
    return WO_OK;
}

wo_status wo_params_validate(const wo_param *table, size_t count, const void *params,
                             wo_error *error)
{
    for (size_t i = 0; i < count; i++) {
        const wo_param *const param = &table[i];
        double values[3];
        if (param->type == WO_PARAM_STRING) {
            if (!memchr(const_field(param, params), '\0', WO_PARAM_STRING_SIZE))
                return wo_fail(error, WO_ERR_RANGE, "%s: the text has no end within %d bytes",
                               param->key, WO_PARAM_STRING_SIZE);
            continue;
        }
        wo_param_get(param, params, values);
        WO_TRY(check(param, values, error));
    }
    return WO_OK;
}
