/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_HALF_H
#define WO_BRIDGE_HALF_H

#include <stdint.h>
#include <string.h>

/* 16-bit floats (1 sign, 5 exponent, 10 mantissa bits). None of these fails. */

static inline float wo_float_of_bits(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline uint32_t wo_bits_of_float(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* Exact; the product with 2^112 moves the exponent and normalises subnormals in one step. */
static inline float wo_half_to_float(uint16_t half)
{
    const uint32_t magnitude = (uint32_t)(half & 0x7fff) << 13;
    const uint32_t sign = (uint32_t)(half & 0x8000) << 16;
    const uint32_t scaled =
        wo_bits_of_float(wo_float_of_bits(magnitude) * wo_float_of_bits((127u + 112u) << 23));
    const uint32_t special = magnitude | 0x7f800000u;
    return wo_float_of_bits(sign | (magnitude >= 0x0f800000u ? special : scaled));
}

/* Nearest, ties to even; beyond +-65504 and infinity give +-65504, NaN stays NaN. */
static inline uint16_t wo_half_from_float(float value)
{
    const uint32_t bits = wo_bits_of_float(value);
    const uint32_t magnitude = bits & 0x7fffffffu;
    const uint32_t sign = (bits >> 16) & 0x8000u;
    uint32_t half;
    if (magnitude > 0x7f800000u)
        half = 0x7e00u;
    else if (magnitude >= 0x477fe000u)
        half = 0x7bffu;
    else if (magnitude < 0x38800000u)
        half = wo_bits_of_float(wo_float_of_bits(magnitude) + 0.5f) - 0x3f000000u;
    else
        half = (magnitude - (112u << 23) + 0x0fffu + ((magnitude >> 13) & 1u)) >> 13;
    return (uint16_t)(sign | half);
}

#endif
