/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_FOOTAGE_RANDOM_H
#define WO_FOOTAGE_RANDOM_H

#include "wideopen/base.h"

/* Random and well spread numbers that depend on nothing but their arguments. None of these fails.
 */

/* A stream of its own for every seed. */
typedef struct wo_random {
    uint64_t state;
} wo_random;
uint32_t wo_random_bits(wo_random *random);
float wo_random_unit(wo_random *random);                           /* [0, 1) */
float wo_random_between(wo_random *random, float low, float high); /* [low, high) */

/* Stirs two words into one. */
static inline uint32_t wo_stir(uint32_t a, uint32_t b)
{
    uint32_t h = a ^ (b * 0x9e3779b9u + 0x7f4a7c15u + (a << 6) + (a >> 2));
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return h ^ (h >> 16);
}

/* Points of the first four dimensions of Sobol's sequence with mirrored bits. */
#define WO_SOBOL_DIMENSIONS 4
void wo_sobol_mirrored(uint32_t index, uint32_t mirrored[WO_SOBOL_DIMENSIONS]);

static inline uint32_t wo_mirror_bits(uint32_t x)
{
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
}

/* A coordinate in [0, 1) from its mirrored bits, scrambled as by Owen: every bit is flipped by a
   hash of the bits above it and of seed. The hash is that of Laine and Karras 2011 with the
   constants of Burley 2020. Different seeds give independent sets that are each as well spread as
   the first. */
static inline float wo_scrambled(uint32_t mirrored, uint32_t seed)
{
    uint32_t x = mirrored + seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return (float)(wo_mirror_bits(x) >> 8) * 0x1p-24f;
}

#endif
