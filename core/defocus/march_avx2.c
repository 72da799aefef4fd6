/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "base/simd_avx2.h"

#define WO_MARCH_KERNELS wo_march_avx2
#include "defocus/march.inc.h"
