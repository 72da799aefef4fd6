/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_BASE_SIMD_AVX2_H
#define WO_CORE_BASE_SIMD_AVX2_H

/* The vectors of simd_base.h in AVX2 and FMA, two registers each. */
#include "base/simd.h"

#include <immintrin.h>
#include <stdint.h>

typedef struct vf {
    __m256 a, b;
} vf;
typedef vf vm;

#define WO_SIMD           static inline __attribute__((always_inline))
#define WO_PAIR(op, x, y) ((vf){op((x).a, (y).a), op((x).b, (y).b)})

WO_SIMD vf v_set(float x)
{
    const __m256 a = _mm256_set1_ps(x);
    return (vf){a, a};
}
WO_SIMD vf v_load(const float *p)
{
    return (vf){_mm256_loadu_ps(p), _mm256_loadu_ps(p + 8)};
}
WO_SIMD void v_store(float *p, vf x)
{
    _mm256_storeu_ps(p, x.a);
    _mm256_storeu_ps(p + 8, x.b);
}
WO_SIMD vf v_add(vf x, vf y)
{
    return WO_PAIR(_mm256_add_ps, x, y);
}
WO_SIMD vf v_sub(vf x, vf y)
{
    return WO_PAIR(_mm256_sub_ps, x, y);
}
WO_SIMD vf v_mul(vf x, vf y)
{
    return WO_PAIR(_mm256_mul_ps, x, y);
}
WO_SIMD vf v_div(vf x, vf y)
{
    return WO_PAIR(_mm256_div_ps, x, y);
}
WO_SIMD vf v_fma(vf x, vf y, vf z)
{
    return (vf){_mm256_fmadd_ps(x.a, y.a, z.a), _mm256_fmadd_ps(x.b, y.b, z.b)};
}
WO_SIMD vf v_min(vf x, vf y)
{
    return WO_PAIR(_mm256_min_ps, x, y);
}
WO_SIMD vf v_max(vf x, vf y)
{
    return WO_PAIR(_mm256_max_ps, x, y);
}
WO_SIMD vm v_less(vf x, vf y)
{
    return (vm){_mm256_cmp_ps(x.a, y.a, _CMP_LT_OQ), _mm256_cmp_ps(x.b, y.b, _CMP_LT_OQ)};
}
WO_SIMD vm v_less_equal(vf x, vf y)
{
    return (vm){_mm256_cmp_ps(x.a, y.a, _CMP_LE_OQ), _mm256_cmp_ps(x.b, y.b, _CMP_LE_OQ)};
}
WO_SIMD vm m_and(vm x, vm y)
{
    return WO_PAIR(_mm256_and_ps, x, y);
}
WO_SIMD vm m_or(vm x, vm y)
{
    return WO_PAIR(_mm256_or_ps, x, y);
}
WO_SIMD vm m_except(vm x, vm y)
{
    return WO_PAIR(_mm256_andnot_ps, y, x);
}
WO_SIMD vm m_set(int32_t x)
{
    const __m256 a = _mm256_castsi256_ps(_mm256_set1_epi32(x));
    return (vm){a, a};
}
WO_SIMD int m_any(vm x)
{
    return _mm256_movemask_ps(_mm256_or_ps(x.a, x.b));
}
WO_SIMD vf v_select(vm m, vf x, vf y)
{
    return (vf){_mm256_blendv_ps(y.a, x.a, m.a), _mm256_blendv_ps(y.b, x.b, m.b)};
}
WO_SIMD vf v_mask(vm m, vf x)
{
    return WO_PAIR(_mm256_and_ps, m, x);
}
WO_SIMD vf v_abs(vf x)
{
    const __m256 sign = _mm256_set1_ps(-0.0f);
    return (vf){_mm256_andnot_ps(sign, x.a), _mm256_andnot_ps(sign, x.b)};
}

#endif
