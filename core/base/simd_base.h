/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_BASE_SIMD_BASE_H
#define WO_CORE_BASE_SIMD_BASE_H

/* Vectors of sixteen floats as four of four, in the compiler's own vector types: any machine. */
#include "base/simd.h"

#include <stdint.h>
#include <string.h>

typedef float f4 __attribute__((vector_size(16)));
typedef int32_t m4 __attribute__((vector_size(16)));
typedef struct vf {
    f4 a, b, c, d;
} vf;
typedef struct vm {
    m4 a, b, c, d;
} vm;

#define WO_SIMD static inline __attribute__((always_inline))

WO_SIMD vf v_set(float x)
{
    const f4 a = {x, x, x, x};
    return (vf){a, a, a, a};
}
WO_SIMD vf v_load(const float *p)
{
    vf r;
    memcpy(&r.a, p, sizeof r.a);
    memcpy(&r.b, p + 4, sizeof r.b);
    memcpy(&r.c, p + 8, sizeof r.c);
    memcpy(&r.d, p + 12, sizeof r.d);
    return r;
}
WO_SIMD void v_store(float *p, vf x)
{
    memcpy(p, &x.a, sizeof x.a);
    memcpy(p + 4, &x.b, sizeof x.b);
    memcpy(p + 8, &x.c, sizeof x.c);
    memcpy(p + 12, &x.d, sizeof x.d);
}
WO_SIMD vf v_add(vf x, vf y)
{
    return (vf){x.a + y.a, x.b + y.b, x.c + y.c, x.d + y.d};
}
WO_SIMD vf v_sub(vf x, vf y)
{
    return (vf){x.a - y.a, x.b - y.b, x.c - y.c, x.d - y.d};
}
WO_SIMD vf v_mul(vf x, vf y)
{
    return (vf){x.a * y.a, x.b * y.b, x.c * y.c, x.d * y.d};
}
WO_SIMD vf v_div(vf x, vf y)
{
    return (vf){x.a / y.a, x.b / y.b, x.c / y.c, x.d / y.d};
}
/* x y + z */
WO_SIMD vf v_fma(vf x, vf y, vf z)
{
    return v_add(v_mul(x, y), z);
}
WO_SIMD vm v_less(vf x, vf y)
{
    return (vm){x.a < y.a, x.b < y.b, x.c < y.c, x.d < y.d};
}
WO_SIMD vm v_less_equal(vf x, vf y)
{
    return (vm){x.a <= y.a, x.b <= y.b, x.c <= y.c, x.d <= y.d};
}
WO_SIMD vm m_and(vm x, vm y)
{
    return (vm){x.a & y.a, x.b & y.b, x.c & y.c, x.d & y.d};
}
WO_SIMD vm m_or(vm x, vm y)
{
    return (vm){x.a | y.a, x.b | y.b, x.c | y.c, x.d | y.d};
}
/* x and not y */
WO_SIMD vm m_except(vm x, vm y)
{
    return (vm){x.a & ~y.a, x.b & ~y.b, x.c & ~y.c, x.d & ~y.d};
}
WO_SIMD vm m_set(int32_t x)
{
    const m4 a = {x, x, x, x};
    return (vm){a, a, a, a};
}
WO_SIMD int m_any(vm x)
{
    const m4 o = x.a | x.b | x.c | x.d;
    int64_t q[2];
    memcpy(q, &o, sizeof q);
    return (q[0] | q[1]) != 0;
}
WO_SIMD vf v_of(vm x)
{
    return (vf){(f4)x.a, (f4)x.b, (f4)x.c, (f4)x.d};
}
WO_SIMD vm m_of(vf x)
{
    return (vm){(m4)x.a, (m4)x.b, (m4)x.c, (m4)x.d};
}
/* where m: x, else y */
WO_SIMD vf v_select(vm m, vf x, vf y)
{
    return v_of(m_or(m_and(m, m_of(x)), m_except(m_of(y), m)));
}
WO_SIMD vf v_min(vf x, vf y)
{
    return v_select(v_less(x, y), x, y);
}
WO_SIMD vf v_max(vf x, vf y)
{
    return v_select(v_less(y, x), x, y);
}
WO_SIMD vf v_mask(vm m, vf x)
{
    return v_of(m_and(m, m_of(x)));
}
WO_SIMD vf v_abs(vf x)
{
    return v_mask(m_set(INT32_MAX), x);
}

#endif
