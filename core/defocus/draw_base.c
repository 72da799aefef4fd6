/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "base/simd_base.h"

#define WO_DRAW_KERNELS wo_draw_base
#include "defocus/draw.inc.h"

int wo_view_step(const wo_view_ray *ray, float v, int *dx, int *dy)
{
    const line l = line_of(ray);
    const int i = nearest(l.am + l.bm * v);
    raster_of(&l, i, dx, dy);
    return i;
}

const wo_draw_kernels *wo_draw_choose(int cpu)
{
#if defined(__x86_64__)
    if (cpu & WO_CPU_AVX2)
        return &wo_draw_avx2;
#endif
    (void)cpu;
    return &wo_draw_base;
}
