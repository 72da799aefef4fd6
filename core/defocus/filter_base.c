/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "base/simd_base.h"

#define WO_FILTER_KERNELS wo_filter_base
#include "defocus/filter.inc.h"

const wo_filter_kernels *wo_filter_choose(int cpu)
{
#if defined(__x86_64__)
    if (cpu & WO_CPU_AVX2)
        return &wo_filter_avx2;
#endif
    (void)cpu;
    return &wo_filter_base;
}
