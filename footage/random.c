/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "random.h"

/* splitmix64 (Steele, Lea, Flood 2014). */
uint32_t wo_random_bits(wo_random *random)
{
    uint64_t z = random->state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (uint32_t)((z ^ (z >> 31)) >> 32);
}

float wo_random_unit(wo_random *random)
{
    return (float)(wo_random_bits(random) >> 8) * 0x1p-24f;
}

float wo_random_between(wo_random *random, float low, float high)
{
    return low + (high - low) * wo_random_unit(random);
}

/* Direction numbers by the recurrence of the primitive polynomials 1, 1+x, 1+x+x^2, 1+x+x^3. */
void wo_sobol_mirrored(uint32_t index, uint32_t mirrored[WO_SOBOL_DIMENSIONS])
{
    static const struct {
        uint32_t degree, middle, first[3];
    } polynomials[WO_SOBOL_DIMENSIONS] = {
        {0, 0, {0}}, {1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}};
    for (int d = 0; d < WO_SOBOL_DIMENSIONS; d++) {
        const uint32_t degree = polynomials[d].degree;
        uint32_t direction[32], x = 0;
        for (uint32_t i = 0; i < 32; i++) {
            if (degree == 0) {
                direction[i] = 1u << (31 - i);
            } else if (i < degree) {
                direction[i] = polynomials[d].first[i] << (31 - i);
            } else {
                direction[i] = direction[i - degree] ^ (direction[i - degree] >> degree);
                for (uint32_t k = 1; k < degree; k++)
                    if ((polynomials[d].middle >> (degree - 1 - k)) & 1)
                        direction[i] ^= direction[i - k];
            }
            if ((index >> i) & 1)
                x ^= direction[i];
        }
        mirrored[d] = wo_mirror_bits(x);
    }
}
