/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TESTS_NEAR_H
#define WO_TESTS_NEAR_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* Fails unless |got - want| <= tolerance; NaN fails. */
#define assert_near(got, want, tolerance)                                                          \
    near_check((got), (want), (tolerance), #got, __FILE__, __LINE__)

/* Fails unless |got - want| <= tolerance |want|. */
#define assert_close(got, want, tolerance)                                                         \
    near_check((got), (want), (tolerance)*fabs((double)(want)), #got, __FILE__, __LINE__)

/* Fails unless got <= limit; NaN fails. */
#define assert_at_most(got, limit) at_most_check((got), (limit), #got, __FILE__, __LINE__)

static inline void near_check(double got, double want, double tolerance, const char *what,
                              const char *file, int line)
{
    if (fabs(got - want) <= tolerance || got == want)
        return;
    print_error("%s is %.12g, should be %.12g within %.3g\n", what, got, want, tolerance);
    _fail(file, line);
}

static inline void at_most_check(double got, double limit, const char *what, const char *file,
                                 int line)
{
    if (got <= limit)
        return;
    print_error("%s is %.12g, should be at most %.12g\n", what, got, limit);
    _fail(file, line);
}

#endif
