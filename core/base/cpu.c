/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/context.h"

int wo_cpu_detect(int mask)
{
    int found = WO_CPU_BASE;
#if defined(__GNUC__) && (defined(__x86_64__) || defined(__i386__))
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        found |= WO_CPU_AVX2;
#endif
    return found & mask;
}
