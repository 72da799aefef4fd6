/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "base/simd_base.h"

#define WO_MARCH_KERNELS wo_march_base
#include "defocus/march.inc.h"

const wo_march_kernels *wo_march_choose(int cpu)
{
#if defined(__x86_64__)
    if (cpu & WO_CPU_AVX2)
        return &wo_march_avx2;
#endif
    (void)cpu;
    return &wo_march_base;
}
