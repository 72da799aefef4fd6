/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_SIMD_AVX2_H
#define WO_CORE_DEFOCUS_SIMD_AVX2_H

/* The vectors of simd_base.h in AVX2 and FMA. */
#include <immintrin.h>
#include <stdint.h>

typedef __m256 vf;
typedef __m256 vm;

#define WO_SIMD static inline __attribute__((always_inline))

WO_SIMD vf v_set(float x)
{
    return _mm256_set1_ps(x);
}
WO_SIMD vf v_load(const float *p)
{
    return _mm256_loadu_ps(p);
}
WO_SIMD void v_store(float *p, vf x)
{
    _mm256_storeu_ps(p, x);
}
WO_SIMD vf v_add(vf x, vf y)
{
    return _mm256_add_ps(x, y);
}
WO_SIMD vf v_sub(vf x, vf y)
{
    return _mm256_sub_ps(x, y);
}
WO_SIMD vf v_mul(vf x, vf y)
{
    return _mm256_mul_ps(x, y);
}
WO_SIMD vf v_div(vf x, vf y)
{
    return _mm256_div_ps(x, y);
}
WO_SIMD vf v_fma(vf x, vf y, vf z)
{
    return _mm256_fmadd_ps(x, y, z);
}
WO_SIMD vm v_less(vf x, vf y)
{
    return _mm256_cmp_ps(x, y, _CMP_LT_OQ);
}
WO_SIMD vm v_less_equal(vf x, vf y)
{
    return _mm256_cmp_ps(x, y, _CMP_LE_OQ);
}
WO_SIMD vm m_and(vm x, vm y)
{
    return _mm256_and_ps(x, y);
}
WO_SIMD vm m_or(vm x, vm y)
{
    return _mm256_or_ps(x, y);
}
WO_SIMD vm m_except(vm x, vm y)
{
    return _mm256_andnot_ps(y, x);
}
WO_SIMD vm m_set(int32_t x)
{
    return _mm256_castsi256_ps(_mm256_set1_epi32(x));
}
WO_SIMD int m_any(vm x)
{
    return _mm256_movemask_ps(x);
}
WO_SIMD vf v_select(vm m, vf x, vf y)
{
    return _mm256_blendv_ps(y, x, m);
}
WO_SIMD vf v_mask(vm m, vf x)
{
    return _mm256_and_ps(m, x);
}
WO_SIMD vf v_abs(vf x)
{
    return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), x);
}

#endif
