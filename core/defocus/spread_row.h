/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_SPREAD_ROW_H
#define WO_CORE_DEFOCUS_SPREAD_ROW_H

#include "defocus/spread_light.h"

/* The inner loop of the method spread: lights into one row of differences for each plane. */

/* Columns x1..x2 - 1. */
typedef struct wo_span_x {
    int32_t x1, x2;
} wo_span_x;

typedef struct wo_spread_row {
    const wo_point_spread *spreads;
    int32_t x; /* of the row's first pixel */
    int32_t width;
    int32_t reach;                /* px: no light goes farther */
    double unit[WO_LIGHT_PLANES]; /* steps for a light of 1 */
    uint64_t *steps;              /* [planes][stride] differences: [width][4] */
    size_t stride;
    wo_span_x touched[WO_LIGHT_PLANES]; /* relative to x; grows; may reach beyond the row */
} wo_spread_row;

/* Adds the lights from one row of the scene, dy px below. Differences left of the row go to its
   first pixel, those right of it nowhere. Returns how many were written. All kernels write the same
   whole numbers. */
typedef int64_t wo_spread_function(wo_spread_row *row, const wo_light *light, const wo_light *end,
                                   int32_t dy);

/* The kernel for these instruction sets (WO_CPU_*). */
wo_spread_function *wo_spread_choose(int cpu);

extern wo_spread_function wo_spread_base;
#if defined(__x86_64__)
extern wo_spread_function wo_spread_avx2;
#endif

#endif
