/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TEST_BRIDGE_TEST_H
#define WO_TEST_BRIDGE_TEST_H

/* What the tests of the bridges share: a folder of their own and small pictures. */

#include "image_io.h"

#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

static char test_folder[256];

static inline const char *in_folder(const char *name)
{
    static char paths[4][512];
    static unsigned turn;
    char *const path = paths[turn++ % 4];
    snprintf(path, sizeof paths[0], "%s/%s", test_folder, name);
    return path;
}

static inline int make_folder(void **state)
{
    const char *const base = getenv("TMPDIR");
    (void)state;
    snprintf(test_folder, sizeof test_folder, "%s/wideopen-test-XXXXXX",
             base && *base ? base : "/tmp");
    return mkdtemp(test_folder) ? 0 : -1;
}

/* Number of entries; their names are removed if asked. */
static inline int count_files(bool remove)
{
    DIR *const folder = opendir(test_folder);
    int count = 0;
    if (!folder)
        return -1;
    for (struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
        if (!strcmp(entry->d_name, ".") || !strcmp(entry->d_name, ".."))
            continue;
        count++;
        if (remove)
            unlink(in_folder(entry->d_name));
    }
    closedir(folder);
    return count;
}

static inline int remove_folder(void **state)
{
    (void)state;
    count_files(true);
    return rmdir(test_folder);
}

/* Every test starts in an empty folder. */
static inline int empty_folder(void **state)
{
    (void)state;
    return count_files(true) < 0 ? -1 : 0;
}

#define assert_ok(call)                                                                            \
    do {                                                                                           \
        if ((call) != WO_OK)                                                                       \
            fail_msg("%s", fault.text);                                                            \
    } while (0)

/* The call fails with this status and says something that contains words. */
#define assert_fault(call, expected, words)                                                        \
    do {                                                                                           \
        fault.text[0] = '\0';                                                                      \
        const wo_status got = (call);                                                              \
        if (got != (expected) || !strstr(fault.text, words))                                       \
            fail_msg("%s, \"%s\" instead of %s, \"%s\"", wo_status_text(got), fault.text,          \
                     wo_status_text(expected), words);                                             \
    } while (0)

static wo_error fault;

/* A repeatable number in 0..1. */
static inline float noise(uint32_t i)
{
    i = (i ^ 61u) ^ (i >> 16);
    i *= 9u;
    i ^= i >> 4;
    i *= 0x27d4eb2du;
    i ^= i >> 15;
    return (float)(i >> 8) / 16777216.0f;
}

/* Fills every sample with low..high noise. */
static inline void fill_noise(wo_io_part *part, float low, float high)
{
    const size_t count = (size_t)wo_rect_width(part->data_window) *
                         (size_t)wo_rect_height(part->data_window) * (size_t)part->channels;
    for (size_t i = 0; i < count; i++)
        part->pixels[i] = low + (high - low) * noise((uint32_t)i);
}

static inline float *sample_at(const wo_io_part *part, int x, int y, int channel)
{
    const wo_rect r = part->data_window;
    return part->pixels +
           ((size_t)(y - r.y1) * (size_t)wo_rect_width(r) + (size_t)(x - r.x1)) *
               (size_t)part->channels +
           channel;
}

static inline void write_bytes(const char *path, const void *bytes, size_t size)
{
    FILE *const file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

/* The whole file, malloc-ed. */
static inline unsigned char *read_bytes(const char *path, size_t *size)
{
    FILE *const file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    *size = (size_t)ftell(file);
    rewind(file);
    unsigned char *const bytes = malloc(*size + 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *size, file), *size);
    fclose(file);
    return bytes;
}

#endif
