/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_FOOTAGE_VEC_H
#define WO_FOOTAGE_VEC_H

#include <math.h>

/* Points and directions in metres. None of these fails. */
typedef struct wo_vec {
    float x, y, z;
} wo_vec;

#define WO_PI 3.14159265358979323846f

static inline wo_vec wo_vec_add(wo_vec a, wo_vec b)
{
    return (wo_vec){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline wo_vec wo_vec_sub(wo_vec a, wo_vec b)
{
    return (wo_vec){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline wo_vec wo_vec_scale(wo_vec a, float s)
{
    return (wo_vec){a.x * s, a.y * s, a.z * s};
}

/* a + b s */
static inline wo_vec wo_vec_along(wo_vec a, wo_vec b, float s)
{
    return (wo_vec){a.x + b.x * s, a.y + b.y * s, a.z + b.z * s};
}

static inline float wo_vec_dot(wo_vec a, wo_vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline wo_vec wo_vec_cross(wo_vec a, wo_vec b)
{
    return (wo_vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline float wo_vec_length(wo_vec a)
{
    return sqrtf(wo_vec_dot(a, a));
}

/* The zero vector stays what it is. */
static inline wo_vec wo_vec_unit(wo_vec a)
{
    const float length = wo_vec_length(a);
    return length > 0 ? wo_vec_scale(a, 1 / length) : a;
}

static inline float wo_mix(float a, float b, float t)
{
    return a + (b - a) * t;
}

static inline float wo_clamp(float x, float low, float high)
{
    return x < low ? low : x > high ? high : x;
}

/* An affine map: rows of (matrix | offset). */
typedef struct wo_affine {
    float m[3][4];
} wo_affine;

static inline wo_vec wo_affine_direction(const wo_affine *a, wo_vec d)
{
    return (wo_vec){a->m[0][0] * d.x + a->m[0][1] * d.y + a->m[0][2] * d.z,
                    a->m[1][0] * d.x + a->m[1][1] * d.y + a->m[1][2] * d.z,
                    a->m[2][0] * d.x + a->m[2][1] * d.y + a->m[2][2] * d.z};
}

static inline wo_vec wo_affine_point(const wo_affine *a, wo_vec p)
{
    return wo_vec_add(wo_affine_direction(a, p), (wo_vec){a->m[0][3], a->m[1][3], a->m[2][3]});
}

/* a after b */
static inline wo_affine wo_affine_after(const wo_affine *a, const wo_affine *b)
{
    wo_affine made;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            made.m[i][j] = a->m[i][0] * b->m[0][j] + a->m[i][1] * b->m[1][j] +
                           a->m[i][2] * b->m[2][j] + (j == 3 ? a->m[i][3] : 0);
    return made;
}

/* The way back of a rotation with offset. */
static inline wo_affine wo_affine_rigid_inverse(const wo_affine *a)
{
    wo_affine made;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            made.m[i][j] = a->m[j][i];
        made.m[i][3] =
            -(a->m[0][i] * a->m[0][3] + a->m[1][i] * a->m[1][3] + a->m[2][i] * a->m[2][3]);
    }
    return made;
}

#endif
