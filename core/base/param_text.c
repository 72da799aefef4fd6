/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/param.h"

#include "number.h"

#include <stdio.h>
#include <string.h>

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static const char *skip_blanks(const char *text)
{
    while (is_blank(*text))
        text++;
    return text;
}

/* Whether text, less the blanks around it, is this word. */
static bool is_word(const char *text, const char *word)
{
    const size_t length = strlen(word);
    text = skip_blanks(text);
    return strncmp(text, word, length) == 0 && *skip_blanks(text + length) == '\0';
}

/* Exactly count numbers with commas between. */
static bool read_numbers(const char *text, int count, double values[3])
{
    const char *at = text;
    for (int i = 0; i < count; i++) {
        if (i > 0 && *at++ != ',')
            return false;
        if (!wo_number_read(skip_blanks(at), &at, &values[i]))
            return false;
        at = skip_blanks(at);
    }
    return *at == '\0';
}

static bool read_bool(const char *text, double *value)
{
    static const char *const words[][2] = {
        {"false", "true"}, {"no", "yes"}, {"off", "on"}, {"0", "1"}};
    for (size_t i = 0; i < WO_COUNT(words); i++)
        for (int j = 0; j < 2; j++)
            if (is_word(text, words[i][j])) {
                *value = j;
                return true;
            }
    return false;
}

static bool read_choice(const wo_param *param, const char *text, double *value)
{
    const int count = wo_param_choice_count(param);
    for (int i = 0; i < count; i++)
        if (is_word(text, param->choices[i])) {
            *value = i;
            return true;
        }
    return read_numbers(text, 1, value);
}

/* The choices as "a, b, c", cut where the buffer ends. */
static void list_choices(const wo_param *param, char *buffer, size_t size)
{
    size_t used = 0;
    buffer[0] = '\0';
    for (int i = 0; i < wo_param_choice_count(param) && used < size; i++) {
        const int wrote =
            snprintf(buffer + used, size - used, "%s%s", i ? ", " : "", param->choices[i]);
        if (wrote < 0)
            return;
        used += (size_t)wrote;
    }
}

wo_status wo_param_parse(const wo_param *param, const char *text, void *params, wo_error *error)
{
    static const char *const wanted[] = {"text", "a number", "two numbers x,y",
                                         "three numbers r,g,b"};
    double values[3] = {0, 0, 0};
    char choices[160];

    if (!text)
        return wo_fail(error, WO_ERR_ARGUMENT, "%s: no value was given", param->key);
    switch (param->type) {
    case WO_PARAM_STRING:
        return wo_param_set_text(param, params, text, error);
    case WO_PARAM_BOOL:
        if (!read_bool(text, values))
            return wo_fail(error, WO_ERR_ARGUMENT, "%s: \"%.64s\" is neither true nor false",
                           param->key, text);
        break;
    case WO_PARAM_CHOICE:
        if (!read_choice(param, text, values)) {
            list_choices(param, choices, sizeof choices);
            return wo_fail(error, WO_ERR_ARGUMENT, "%s: \"%.32s\" is none of %s", param->key, text,
                           choices);
        }
        break;
    case WO_PARAM_DOUBLE:
    case WO_PARAM_INT:
    case WO_PARAM_POINT:
    case WO_PARAM_COLOUR:
        if (!read_numbers(text, wo_param_values(param), values))
            return wo_fail(error, WO_ERR_ARGUMENT, "%s: \"%.64s\" is not %s", param->key, text,
                           wanted[wo_param_values(param)]);
        break;
    }
    return wo_param_set(param, params, values, error);
}

int wo_param_print(const wo_param *param, const void *params, char *buffer, size_t size)
{
    double values[3];
    char text[3][WO_NUMBER_SIZE];

    if (param->type == WO_PARAM_STRING)
        return snprintf(buffer, size, "%s", wo_param_get_text(param, params));
    wo_param_get(param, params, values);
    if (param->type == WO_PARAM_BOOL)
        return snprintf(buffer, size, "%s", values[0] != 0 ? "true" : "false");
    if (param->type == WO_PARAM_CHOICE && values[0] >= 0 &&
        values[0] < wo_param_choice_count(param))
        return snprintf(buffer, size, "%s", param->choices[(int)values[0]]);
    const int count = wo_param_values(param);
    for (int i = 0; i < 3; i++)
        wo_number_print(values[i], text[i]);
    return snprintf(buffer, size, "%s%s%s%s%s", text[0], count > 1 ? "," : "",
                    count > 1 ? text[1] : "", count > 2 ? "," : "", count > 2 ? text[2] : "");
}
