/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_SIMD_BASE_H
#define WO_CORE_DEFOCUS_SIMD_BASE_H

/* Vectors of sixteen floats as two of eight, in the compiler's own vector types, which it splits
   into what the machine has: any machine. */
#include <stdint.h>
#include <string.h>

typedef float f8 __attribute__((vector_size(32)));
typedef int32_t m8 __attribute__((vector_size(32)));
typedef struct vf {
    f8 a, b;
} vf;
typedef struct vm {
    m8 a, b;
} vm;

#define WO_SIMD           static inline __attribute__((always_inline))
#define WO_PAIR(type, op) ((type){op(x.a, y.a), op(x.b, y.b)})

WO_SIMD vf v_set(float x)
{
    const f8 a = {x, x, x, x, x, x, x, x};
    return (vf){a, a};
}
WO_SIMD vf v_load(const float *p)
{
    vf r;
    memcpy(&r.a, p, sizeof r.a);
    memcpy(&r.b, p + 8, sizeof r.b);
    return r;
}
WO_SIMD void v_store(float *p, vf x)
{
    memcpy(p, &x.a, sizeof x.a);
    memcpy(p + 8, &x.b, sizeof x.b);
}
WO_SIMD vf v_add(vf x, vf y)
{
    return (vf){x.a + y.a, x.b + y.b};
}
WO_SIMD vf v_sub(vf x, vf y)
{
    return (vf){x.a - y.a, x.b - y.b};
}
WO_SIMD vf v_mul(vf x, vf y)
{
    return (vf){x.a * y.a, x.b * y.b};
}
WO_SIMD vf v_div(vf x, vf y)
{
    return (vf){x.a / y.a, x.b / y.b};
}
/* x y + z */
WO_SIMD vf v_fma(vf x, vf y, vf z)
{
    return (vf){x.a * y.a + z.a, x.b * y.b + z.b};
}
WO_SIMD vm v_less(vf x, vf y)
{
    return (vm){x.a < y.a, x.b < y.b};
}
WO_SIMD vm v_less_equal(vf x, vf y)
{
    return (vm){x.a <= y.a, x.b <= y.b};
}
WO_SIMD vm m_and(vm x, vm y)
{
    return (vm){x.a & y.a, x.b & y.b};
}
WO_SIMD vm m_or(vm x, vm y)
{
    return (vm){x.a | y.a, x.b | y.b};
}
/* x and not y */
WO_SIMD vm m_except(vm x, vm y)
{
    return (vm){x.a & ~y.a, x.b & ~y.b};
}
WO_SIMD vm m_set(int32_t x)
{
    const m8 a = {x, x, x, x, x, x, x, x};
    return (vm){a, a};
}
WO_SIMD int m_any(vm x)
{
    const m8 o = x.a | x.b;
    int64_t q[4];
    memcpy(q, &o, sizeof q);
    return (q[0] | q[1] | q[2] | q[3]) != 0;
}
/* where m: x, else y */
WO_SIMD vf v_select(vm m, vf x, vf y)
{
    return (vf){(f8)((m.a & (m8)x.a) | (~m.a & (m8)y.a)), (f8)((m.b & (m8)x.b) | (~m.b & (m8)y.b))};
}
WO_SIMD vf v_mask(vm m, vf x)
{
    return (vf){(f8)(m.a & (m8)x.a), (f8)(m.b & (m8)x.b)};
}
WO_SIMD vf v_abs(vf x)
{
    const m8 k = {INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX,
                  INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX};
    return (vf){(f8)((m8)x.a & k), (f8)((m8)x.b & k)};
}

#endif
