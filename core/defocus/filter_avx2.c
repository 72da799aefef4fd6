/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "base/simd_avx2.h"

#define WO_FILTER_KERNELS wo_filter_avx2
#include "defocus/filter.inc.h"
