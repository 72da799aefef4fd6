/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "json.h"

#include <stdlib.h>
#include <string.h>

/* Each skip_ function takes the start of something and gives its end, or NULL when it is
   malformed. */

enum { DEPTH_MAX = 64 };

static const char *skip_blanks(const char *s)
{
    return s + strspn(s, " \t\r\n");
}

static const char *skip_string(const char *s)
{
    if (*s++ != '"')
        return NULL;
    for (; *s != '"'; s++) {
        if ((unsigned char)*s < 0x20)
            return NULL;
        if (*s != '\\')
            continue;
        s++;
        if (*s == 'u') {
            if (strspn(s + 1, "0123456789abcdefABCDEF") < 4)
                return NULL;
            s += 4;
        } else if (*s == '\0' || !strchr("\"\\/bfnrt", *s)) {
            return NULL;
        }
    }
    return s + 1;
}

static const char *skip_digits(const char *s)
{
    const size_t count = strspn(s, "0123456789");
    return count ? s + count : NULL;
}

static const char *skip_number(const char *s)
{
    s += *s == '-';
    const bool leading_zero = *s == '0';
    const char *const first = s;
    s = skip_digits(s);
    if (!s || (leading_zero && s != first + 1))
        return NULL;
    if (*s == '.' && !(s = skip_digits(s + 1)))
        return NULL;
    if (*s == 'e' || *s == 'E') {
        s++;
        s += *s == '+' || *s == '-';
        s = skip_digits(s);
    }
    return s;
}

static const char *skip_value(const char *s, int depth);

/* One "key": value or value; *value gets the start of the value. */
static const char *skip_member(const char *s, bool keyed, int depth, const char **value)
{
    if (keyed) {
        s = skip_string(s);
        if (!s)
            return NULL;
        s = skip_blanks(s);
        if (*s++ != ':')
            return NULL;
        s = skip_blanks(s);
    }
    *value = s;
    return skip_value(s, depth);
}

static const char *skip_container(const char *s, int depth)
{
    const bool keyed = *s == '{';
    const char closing = keyed ? '}' : ']';
    if (depth >= DEPTH_MAX)
        return NULL;
    s = skip_blanks(s + 1);
    if (*s == closing)
        return s + 1;
    for (;;) {
        const char *value;
        s = skip_member(s, keyed, depth + 1, &value);
        if (!s)
            return NULL;
        s = skip_blanks(s);
        if (*s == closing)
            return s + 1;
        if (*s++ != ',')
            return NULL;
        s = skip_blanks(s);
    }
}

static const char *skip_value(const char *s, int depth)
{
    static const char *const words[] = {"true", "false", "null"};
    if (*s == '{' || *s == '[')
        return skip_container(s, depth);
    if (*s == '"')
        return skip_string(s);
    for (size_t i = 0; i < WO_COUNT(words); i++)
        if (strncmp(s, words[i], strlen(words[i])) == 0)
            return s + strlen(words[i]);
    return skip_number(s);
}

bool wo_json_valid(const char *text)
{
    const char *const end = skip_value(skip_blanks(text), 0);
    return end && *skip_blanks(end) == '\0';
}

/* Member of the container at s whose key, or index, is the first length letters of name. */
static const char *find_member(const char *s, const char *name, size_t length)
{
    const bool keyed = *s == '{';
    const char closing = keyed ? '}' : ']';
    char *after = NULL;
    const unsigned long wanted = keyed ? 0 : strtoul(name, &after, 10);
    if (!keyed && (after != name + length || *name < '0' || *name > '9'))
        return NULL;
    s = skip_blanks(s + 1);
    for (unsigned long i = 0; *s != closing; i++) {
        const char *const key = s + 1, *value;
        s = skip_member(s, keyed, 0, &value);
        if (!s)
            return NULL;
        if (keyed ? strncmp(key, name, length) == 0 && key[length] == '"' : i == wanted)
            return value;
        s = skip_blanks(s);
        if (*s == ',')
            s = skip_blanks(s + 1);
    }
    return NULL;
}

bool wo_json_find(const char *text, const char *path, const char **begin, size_t *length)
{
    const char *s = skip_blanks(text);
    while (*path) {
        const size_t part = strcspn(path, ".");
        s = part && (*s == '{' || *s == '[') ? find_member(s, path, part) : NULL;
        if (!s)
            return false;
        path += part;
        if (*path == '.' && path[1] == '\0')
            return false;
        path += *path == '.';
    }
    const char *const end = skip_value(s, 0);
    if (!end)
        return false;
    *begin = s;
    *length = (size_t)(end - s);
    return true;
}
