/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TEST_FOOTAGE_TEST_H
#define WO_TEST_FOOTAGE_TEST_H

/* What the tests of the footage generator share. */

#include "cli/threads.h"
#include "footage.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Makes a set on threads threads; a failure fails the test. */
static inline wo_footage *make_set(const wo_footage_options *options, unsigned threads)
{
    wo_context context = WO_CONTEXT_INIT;
    wo_error error = {0};
    wo_footage *set = NULL;
    if (threads > 1)
        context.runner = wo_threads_runner(&threads);
    if (wo_footage_make(&context, options, &set, &error) != WO_OK)
        fail_msg("%s: %s", options->scene, error.text);
    return set;
}

/* make_set's memory comes from malloc, so no context is needed to give it back. */
static inline void free_set(wo_footage **set)
{
    wo_footage_destroy(NULL, set);
}

static inline size_t image_bytes(const wo_image *image)
{
    return (size_t)wo_rect_height(image->bounds) * (size_t)image->row_bytes;
}

static inline bool same_bytes(const wo_image *a, const wo_image *b)
{
    if (!a->data || !b->data)
        return a->data == b->data;
    return image_bytes(a) == image_bytes(b) && memcmp(a->data, b->data, image_bytes(a)) == 0;
}

#endif
