/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "lines.h"

#include "base/number.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static bool is_blank(char c)
{
    return c == ' ' || c == '\t';
}

wo_lines wo_lines_begin(const char *text, size_t bytes, const char *file, wo_error *error)
{
    static const char mark[] = "\xef\xbb\xbf";
    const size_t skip = bytes >= 3 && memcmp(text, mark, 3) == 0 ? 3 : 0;
    return (wo_lines){.file = file, .next = text + skip, .end = text + bytes, .error = error};
}

bool wo_lines_next(wo_lines *lines)
{
    if (lines->next == lines->end)
        return false;
    lines->at = lines->next;
    const char *const feed = memchr(lines->at, '\n', (size_t)(lines->end - lines->at));
    lines->next = feed ? feed + 1 : lines->end;
    lines->stop = feed ? feed : lines->end;
    if (lines->stop > lines->at && lines->stop[-1] == '\r')
        lines->stop--;
    lines->line++;
    return true;
}

wo_status wo_lines_fail(const wo_lines *lines, wo_status status, const char *format, ...)
{
    char text[sizeof((wo_error *)0)->text];
    va_list arguments;
    va_start(arguments, format);
    if (vsnprintf(text, sizeof text, format, arguments) < 0)
        text[0] = '\0';
    va_end(arguments);
    return wo_fail(lines->error, status, "%s:%d: %s", lines->file, lines->line ? lines->line : 1,
                   text);
}

bool wo_lines_more(wo_lines *lines)
{
    while (lines->at < lines->stop && is_blank(*lines->at))
        lines->at++;
    return lines->at < lines->stop && *lines->at != '#';
}

wo_status wo_lines_word(wo_lines *lines, const char *what, char word[WO_WORD_SIZE])
{
    word[0] = '\0';
    if (!wo_lines_more(lines))
        return wo_lines_fail(lines, WO_ERR_FORMAT, "%s is missing", what);
    size_t length = 0;
    for (; lines->at < lines->stop && !is_blank(*lines->at) && *lines->at != '#'; lines->at++) {
        const unsigned char byte = (unsigned char)*lines->at;
        if (byte <= ' ' || byte > '~')
            return wo_lines_fail(lines, WO_ERR_FORMAT, "byte 0x%02x in %s: must be printable ASCII",
                                 byte, what);
        if (length + 1 == WO_WORD_SIZE)
            return wo_lines_fail(lines, WO_ERR_FORMAT,
                                 "\"%.16s...\" for %s: must be at most %d characters", word, what,
                                 WO_WORD_SIZE - 1);
        word[length++] = *lines->at;
        word[length] = '\0';
    }
    return WO_OK;
}

wo_status wo_lines_parse(const wo_lines *lines, const char *what, const char *text, double *value)
{
    const char *end = NULL;
    *value = 0;
    if (!wo_number_read(text, &end, value) || *end != '\0')
        return wo_lines_fail(lines, WO_ERR_FORMAT, "\"%s\" for %s: must be a finite number", text,
                             what);
    if (*value == 0 && text[strcspn(text, "123456789eE")] >= '1' &&
        text[strcspn(text, "123456789eE")] <= '9')
        return wo_lines_fail(lines, WO_ERR_RANGE, "\"%s\" for %s: is too close to 0", text, what);
    return WO_OK;
}

wo_status wo_lines_number(wo_lines *lines, const char *what, double *value)
{
    char word[WO_WORD_SIZE];
    *value = 0;
    WO_TRY(wo_lines_word(lines, what, word));
    return wo_lines_parse(lines, what, word, value);
}

wo_status wo_lines_rest(wo_lines *lines, const char *what, const char **text, size_t *bytes)
{
    const char *end = lines->stop;
    while (lines->at < end && is_blank(*lines->at))
        lines->at++;
    while (end > lines->at && is_blank(end[-1]))
        end--;
    *text = lines->at;
    *bytes = (size_t)(end - lines->at);
    lines->at = lines->stop;
    if (*bytes == 0)
        return wo_lines_fail(lines, WO_ERR_FORMAT, "%s is missing", what);
    return WO_OK;
}

wo_status wo_lines_done(wo_lines *lines)
{
    if (!wo_lines_more(lines))
        return WO_OK;
    char word[WO_WORD_SIZE];
    WO_TRY(wo_lines_word(lines, "what follows", word));
    return wo_lines_fail(lines, WO_ERR_FORMAT, "\"%s\": nothing more may stand in this line", word);
}
