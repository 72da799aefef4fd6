/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/hybrid.h"

#include <math.h>
#include <string.h>

/* Noise is taken to be so many times what the halves of the rays say, because what 64 pixels say
   varies, and too much noise is worse than too little of what the filter missed. */
#define NOISE_TRUST 1.5f
/* Noise in the mean of a cell: its pixels share rays, so it is more than 1/64. */
#define MEAN_NOISE 0.0625f
/* Of the variance of noise, what the mean of a cell has; and how much more error there is than what
   is told here. Measured on footage. */
#define LEFT_OVER 0.15f
#define MORE      1.25f

static float scale_of(const float filtered[4], int k)
{
    return k < 3 ? wo_hybrid_scale(filtered[k]) : 1;
}

static float square(float x)
{
    return x * x;
}

/* How much of a variance is not noise. */
static float part_over(float variance, float noise)
{
    return variance > noise ? 1 - noise / variance : noise > 0 ? 0.0f : 1.0f;
}

void wo_hybrid_lean_on(float (*const rays[WO_HYBRID_CELL])[4],
                       float (*const filtered[WO_HYBRID_CELL])[4], const wo_hybrid_noise *noise,
                       wo_hybrid_lean *lean)
{
    enum { PIXELS = WO_HYBRID_CELL * WO_HYBRID_CELL };
    *lean = (wo_hybrid_lean){.known = true};
    for (int y = 0; y < WO_HYBRID_CELL; y++)
        for (int x = 0; x < WO_HYBRID_CELL; x++)
            for (int k = 0; k < 4; k++)
                lean->shift[k] += (rays[y][x][k] - filtered[y][x][k]) *
                                  scale_of(filtered[y][x], k) * (1.0f / PIXELS);
    float detail = 0;
    float shifted = 0;
    for (int k = 0; k < 3; k++)
        shifted += square(lean->shift[k]) * (1.0f / 3);
    for (int y = 0; y < WO_HYBRID_CELL; y++)
        for (int x = 0; x < WO_HYBRID_CELL; x++)
            for (int k = 0; k < 3; k++)
                detail += square((rays[y][x][k] - filtered[y][x][k]) *
                                     wo_hybrid_scale(filtered[y][x][k]) -
                                 lean->shift[k]);
    detail *= 1.0f / (3 * PIXELS);
    lean->keep = part_over(detail, NOISE_TRUST * noise->noise);
    const float shift = part_over(shifted, MEAN_NOISE * noise->noise);
    for (int k = 0; k < 4; k++)
        lean->shift[k] *= shift;
    /* What noise is kept, and what is not noise and lost. */
    const float lost = fmaxf(detail - noise->noise, 0);
    const float gone = 1 - lean->keep;
    lean->error = MORE * noise->shown *
                  ((lean->keep * lean->keep + LEFT_OVER) * noise->noise + gone * gone * lost +
                   lean->keep * noise->lost);
}

/* Shift and keep between the cells. */
typedef struct blend {
    float shift[4];
    float keep;
} blend;

static void add_cell(const wo_hybrid_lean *cell, float weight, blend *sum)
{
    for (int k = 0; k < 4; k++)
        sum->shift[k] += weight * cell->shift[k];
    sum->keep += weight * cell->keep;
}

float wo_hybrid_mix(const wo_hybrid_lean *const around[3][3], int x, int y, const float rays[4],
                    const float filtered[4], float out[4])
{
    const wo_hybrid_lean *const own = around[1][1];
    memcpy(out, rays, 4 * sizeof *out);
    if (!own->known)
        return 1;
    /* From the middles of cells. */
    const float px = ((float)x + 0.5f) / WO_HYBRID_CELL - 0.5f;
    const float py = ((float)y + 0.5f) / WO_HYBRID_CELL - 0.5f;
    const int left = px < 0 ? 0 : 1;
    const int low = py < 0 ? 0 : 1;
    const float tx = px < 0 ? px + 1 : px;
    const float ty = py < 0 ? py + 1 : py;
    blend sum = {0};
    for (int j = 0; j < 2; j++) {
        for (int i = 0; i < 2; i++) {
            const wo_hybrid_lean *cell = around[low + j][left + i];
            add_cell(cell && cell->known ? cell : own, (i ? tx : 1 - tx) * (j ? ty : 1 - ty), &sum);
        }
    }
    for (int k = 0; k < 4; k++) {
        const float difference = rays[k] - filtered[k];
        if (difference == 0)
            continue;
        const float shift = sum.shift[k] / scale_of(filtered, k);
        const float c = filtered[k] + shift + sum.keep * (difference - shift);
        /* Less than nothing only where one of the two is. */
        out[k] = fmaxf(c, fminf(fminf(rays[k], filtered[k]), 0));
    }
    out[3] = rays[3] == 1 ? 1 : fminf(out[3], 1);
    return sum.keep;
}
