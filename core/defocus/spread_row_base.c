/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include <stdint.h>
#include <string.h>

/* Four at a time, any machine. */
typedef struct d4 {
    double x[4];
} d4;
typedef struct i4 {
    uint64_t x[4];
} i4;

static inline d4 d4_set(double x)
{
    return (d4){{x, x, x, x}};
}
static inline d4 d4_load(const float *p)
{
    return (d4){{(double)p[0], (double)p[1], (double)p[2], (double)p[3]}};
}
static inline d4 d4_mul(d4 a, d4 b)
{
    for (int k = 0; k < 4; k++)
        a.x[k] *= b.x[k];
    return a;
}
static inline d4 d4_add(d4 a, d4 b)
{
    for (int k = 0; k < 4; k++)
        a.x[k] += b.x[k];
    return a;
}
static inline i4 i4_of(d4 a)
{
    i4 b;
    memcpy(&b, &a, sizeof b);
    return b;
}
static inline i4 i4_sub(i4 a, i4 b)
{
    for (int k = 0; k < 4; k++)
        a.x[k] -= b.x[k];
    return a;
}
static inline void i4_add_to(uint64_t *p, i4 a)
{
    for (int k = 0; k < 4; k++)
        p[k] += a.x[k];
}

#define WO_SPREAD_FUNCTION wo_spread_base
#include "defocus/spread_row.inc.h"

wo_spread_function *wo_spread_choose(int cpu)
{
#if defined(__x86_64__)
    if (cpu & WO_CPU_AVX2)
        return wo_spread_avx2;
#endif
    (void)cpu;
    return wo_spread_base;
}
