/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "base/simd_avx2.h"

#define WO_TABLE_EVAL wo_table_eval_avx2
#include "optics/table_eval.inc.h"
