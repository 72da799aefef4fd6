/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TESTS_CASES_H
#define WO_TESTS_CASES_H

#include <stdlib.h>

/* How many cases of a kind a test goes through: all of them in an ordinary build; few of them,
   which run through the same code, where each takes 3 to 30 times as long: with sanitizers, and
   with the variable WO_TEST_FEW_CASES in the environment, which ./check sets for valgrind. Only for
   numbers of alike cases; what a test demands of each is the same everywhere. */
static inline int cases_of(int all, int few)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    (void)all;
    return few;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
    (void)all;
    return few;
#endif
#endif
    return getenv("WO_TEST_FEW_CASES") ? few : all;
}

#endif
