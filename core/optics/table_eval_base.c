/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "base/simd_base.h"

#define WO_TABLE_EVAL wo_table_eval_base
#include "optics/table_eval.inc.h"

wo_table_function *wo_table_choose(int cpu)
{
#if defined(__x86_64__)
    if (cpu & WO_CPU_AVX2)
        return wo_table_eval_avx2;
#endif
    (void)cpu;
    return wo_table_eval_base;
}
