/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_JSON_H
#define WO_CLI_JSON_H

#include "wideopen/base.h"

#include <stdio.h>

/* JSON out and in. The writer keeps commas, indentation and escapes right; numbers do not depend on
   the locale; what JSON cannot say (NaN, infinity) becomes null; bytes that are no UTF-8 become
   U+FFFD. One thread per object. */

#define WO_JSON_DEPTH 32

typedef struct wo_json {
    FILE *out;
    int depth;
    bool closing_bracket[WO_JSON_DEPTH]; /* true: array, false: object */
    bool filled[WO_JSON_DEPTH];
} wo_json;

void wo_json_begin(wo_json *json, FILE *out);

/* key is NULL inside arrays and for the outermost value. */
void wo_json_object(wo_json *json, const char *key);
void wo_json_array(wo_json *json, const char *key);
void wo_json_close(wo_json *json); /* the innermost object or array; a line feed after the last */
void wo_json_text(wo_json *json, const char *key, const char *text); /* NULL writes null */
void wo_json_number(wo_json *json, const char *key, double number);
void wo_json_integer(wo_json *json, const char *key, long long number);
void wo_json_numbers(wo_json *json, const char *key, const double *numbers, int count); /* array */
void wo_json_bool(wo_json *json, const char *key, bool value);

/* Text that claims to be JSON itself: written as it stands when wo_json_valid, else as a string. */
void wo_json_raw(wo_json *json, const char *key, const char *text);

/* True for exactly one JSON value with blanks around it, nested at most 64 deep. */
bool wo_json_valid(const char *text);

/* Finds a value by path: keys and array indices joined by dots, "frames.0.rays"; "" is the whole
   text. *begin and *length say where it stands in text; false when there is no such value. text
   must be valid. */
bool wo_json_find(const char *text, const char *path, const char **begin, size_t *length);

#endif
