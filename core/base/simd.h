/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_BASE_SIMD_H
#define WO_CORE_BASE_SIMD_H

/* Floats of one vector, whatever the instruction set (simd_base.h, simd_avx2.h). */
#define WO_LANES 16

#endif
