/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "base/simd_avx2.h"

#define WO_DRAW_KERNELS wo_draw_avx2
#include "defocus/draw.inc.h"
