/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "frames.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* A whole number at *text, which moves behind it. */
static bool read_int(const char **text, int *value)
{
    const char *const digits = *text + (**text == '-');
    char *end;
    if (!isdigit((unsigned char)*digits))
        return false;
    errno = 0;
    const long number = strtol(*text, &end, 10);
    if (errno || number < -100000000 || number > 100000000)
        return false;
    *value = (int)number;
    *text = end;
    return true;
}

static bool read_range(const char **text, int *first, int *last, int *step)
{
    *step = 1;
    if (!read_int(text, first))
        return false;
    *last = *first;
    if (**text == '-') {
        ++*text;
        if (!read_int(text, last) || *last < *first)
            return false;
        if (**text == 'x') {
            ++*text;
            if (!read_int(text, step) || *step < 1)
                return false;
        }
    }
    return **text == ',' || **text == '\0';
}

static wo_status append(wo_frames *frames, int first, int last, int step, wo_error *error)
{
    const size_t more = (size_t)((last - first) / step) + 1;
    if (more > WO_FRAMES_MAX || frames->count + more > WO_FRAMES_MAX)
        return wo_fail(error, WO_ERR_RANGE, "more than %d frames", WO_FRAMES_MAX);
    int *const numbers = realloc(frames->numbers, (frames->count + more) * sizeof *numbers);
    if (!numbers)
        return wo_fail(error, WO_ERR_NOMEM, "out of memory for %zu frames", frames->count + more);
    frames->numbers = numbers;
    for (size_t i = 0; i < more; i++)
        numbers[frames->count++] = first + (int)i * step;
    return WO_OK;
}

static void summarise(wo_frames *frames)
{
    const int *const numbers = frames->numbers;
    frames->first = frames->last = numbers[0];
    frames->step = frames->count > 1 ? numbers[1] - numbers[0] : 1;
    for (size_t i = 1; i < frames->count; i++) {
        frames->first = numbers[i] < frames->first ? numbers[i] : frames->first;
        frames->last = numbers[i] > frames->last ? numbers[i] : frames->last;
        if (numbers[i] - numbers[i - 1] != frames->step || frames->step < 1)
            frames->step = 1;
    }
}

wo_status wo_frames_read(const char *text, wo_frames *frames, wo_error *error)
{
    *frames = (wo_frames){0};
    const char *s = text;
    for (;;) {
        int first, last, step;
        wo_status status = WO_OK;
        if (!read_range(&s, &first, &last, &step))
            status = wo_fail(error, WO_ERR_ARGUMENT,
                             "\"%.80s\" is no list of frames; write 12, 1-100, 1-100x2 or several "
                             "of these with commas",
                             text);
        else
            status = append(frames, first, last, step, error);
        if (status != WO_OK) {
            wo_frames_free(frames);
            return status;
        }
        if (*s == '\0')
            break;
        s++;
    }
    summarise(frames);
    return WO_OK;
}

void wo_frames_free(wo_frames *frames)
{
    free(frames->numbers);
    *frames = (wo_frames){0};
}
