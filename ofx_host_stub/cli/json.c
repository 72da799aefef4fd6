/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "json.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void wo_json_begin(wo_json *json, FILE *out)
{
    *json = (wo_json){.out = out};
}

static void line(wo_json *json)
{
    fputc('\n', json->out);
    for (int i = 0; i < json->depth; i++)
        fputs("  ", json->out);
}

/* Length of the well-formed UTF-8 sequence at s, 0 when there is none. */
static int utf8_length(const unsigned char *s)
{
    if (s[0] < 0x80)
        return 1;
    const int length = s[0] >= 0xF0 ? 4 : s[0] >= 0xE0 ? 3 : 2;
    if (s[0] < 0xC2 || s[0] > 0xF4)
        return 0;
    for (int i = 1; i < length; i++)
        if ((s[i] & 0xC0) != 0x80)
            return 0;
    const bool overlong = (s[0] == 0xE0 && s[1] < 0xA0) || (s[0] == 0xF0 && s[1] < 0x90);
    const bool outside = (s[0] == 0xED && s[1] > 0x9F) || (s[0] == 0xF4 && s[1] > 0x8F);
    return overlong || outside ? 0 : length;
}

static void quoted(FILE *out, const char *text)
{
    fputc('"', out);
    const unsigned char *s = (const unsigned char *)text;
    while (*s) {
        const int length = utf8_length(s);
        if (length == 0) {
            fputs("\\ufffd", out);
            s++;
        } else if (length == 1) {
            if (*s == '"' || *s == '\\')
                fprintf(out, "\\%c", *s);
            else if (*s == '\n')
                fputs("\\n", out);
            else if (*s < 0x20 || *s == 0x7F)
                fprintf(out, "\\u%04x", *s);
            else
                fputc(*s, out);
            s++;
        } else {
            fwrite(s, 1, (size_t)length, out);
            s += length;
        }
    }
    fputc('"', out);
}

/* Comma, line feed and key before a value. */
static void lead(wo_json *json, const char *key)
{
    if (json->depth == 0)
        return;
    bool *const filled = &json->filled[json->depth - 1];
    if (*filled)
        fputc(',', json->out);
    *filled = true;
    line(json);
    if (key) {
        quoted(json->out, key);
        fputs(": ", json->out);
    }
}

static void open_level(wo_json *json, const char *key, bool bracket)
{
    assert(json->depth < WO_JSON_DEPTH);
    lead(json, key);
    fputc(bracket ? '[' : '{', json->out);
    json->closing_bracket[json->depth] = bracket;
    json->filled[json->depth] = false;
    json->depth++;
}

void wo_json_object(wo_json *json, const char *key)
{
    open_level(json, key, false);
}

void wo_json_array(wo_json *json, const char *key)
{
    open_level(json, key, true);
}

void wo_json_close(wo_json *json)
{
    assert(json->depth > 0);
    json->depth--;
    if (json->filled[json->depth])
        line(json);
    fputc(json->closing_bracket[json->depth] ? ']' : '}', json->out);
    if (json->depth == 0)
        fputc('\n', json->out);
}

void wo_json_text(wo_json *json, const char *key, const char *text)
{
    lead(json, key);
    if (text)
        quoted(json->out, text);
    else
        fputs("null", json->out);
}

static void number_text(FILE *out, double number)
{
    if (!isfinite(number)) {
        fputs("null", out);
        return;
    }
    char text[64];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, number);
        if (strtod(text, NULL) == number)
            break;
    }
    bool inside_point = false;
    for (const char *s = text; *s; s++) {
        const bool plain = strchr("+-0123456789e", *s) != NULL;
        if (plain)
            fputc(*s, out);
        else if (!inside_point)
            fputc('.', out);
        inside_point = !plain;
    }
}

void wo_json_number(wo_json *json, const char *key, double number)
{
    lead(json, key);
    number_text(json->out, number);
}

void wo_json_numbers(wo_json *json, const char *key, const double *numbers, int count)
{
    lead(json, key);
    fputc('[', json->out);
    for (int i = 0; i < count; i++) {
        fputs(i ? ", " : "", json->out);
        number_text(json->out, numbers[i]);
    }
    fputc(']', json->out);
}

void wo_json_integer(wo_json *json, const char *key, long long number)
{
    lead(json, key);
    fprintf(json->out, "%lld", number);
}

void wo_json_bool(wo_json *json, const char *key, bool value)
{
    lead(json, key);
    fputs(value ? "true" : "false", json->out);
}

void wo_json_raw(wo_json *json, const char *key, const char *text)
{
    if (!wo_json_valid(text)) {
        wo_json_text(json, key, text);
        return;
    }
    lead(json, key);
    size_t length = strlen(text);
    while (length > 0 && strchr(" \t\r\n", text[length - 1]))
        length--;
    fwrite(text, 1, length, json->out);
}
