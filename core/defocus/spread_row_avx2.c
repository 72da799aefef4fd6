/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include <immintrin.h>
#include <stdint.h>

typedef __m256d d4;
typedef __m256i i4;

static inline d4 d4_set(double x)
{
    return _mm256_set1_pd(x);
}
static inline d4 d4_load(const float *p)
{
    return _mm256_cvtps_pd(_mm_loadu_ps(p));
}
static inline d4 d4_mul(d4 a, d4 b)
{
    return _mm256_mul_pd(a, b);
}
static inline d4 d4_add(d4 a, d4 b)
{
    return _mm256_add_pd(a, b);
}
static inline i4 i4_of(d4 a)
{
    return _mm256_castpd_si256(a);
}
static inline i4 i4_sub(i4 a, i4 b)
{
    return _mm256_sub_epi64(a, b);
}
static inline void i4_add_to(uint64_t *p, i4 a)
{
    __m256i *const to = (__m256i *)(void *)p;
    _mm256_storeu_si256(to, _mm256_add_epi64(_mm256_loadu_si256(to), a));
}

#define WO_SPREAD_FUNCTION wo_spread_avx2
#include "defocus/spread_row.inc.h"
