/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "spectrum/bands.h"

#include "wideopen/glass.h"

#include <math.h>
#include <string.h>

#define FIRST_NM 380.0
#define STEP_NM  5.0
#define LOW_NM   410.0
#define HIGH_NM  690.0

static const double cie1931[][3] = {
#include "spectrum/cie1931.inc"
};

/* XYZ to Rec. 709 (its primaries and D65). */
static const double rec709[3][3] = {{3.2404542, -1.5371385, -0.4985314},
                                    {-0.9692660, 1.8760108, 0.0415560},
                                    {0.0556434, -0.2040259, 1.0572252}};

static void matching(double nm, double rgb[3])
{
    const double at = (nm - FIRST_NM) / STEP_NM;
    const size_t i = (size_t)at;
    const double t = at - (double)i;
    for (int c = 0; c < 3; c++) {
        rgb[c] = 0;
        for (int k = 0; k < 3; k++)
            rgb[c] += rec709[c][k] * ((1 - t) * cie1931[i][k] + t * cie1931[i + 1][k]);
        rgb[c] = fmax(rgb[c], 0);
    }
}

void wo_bands_make(int count, wo_bands *bands)
{
    enum { STEPS = 64 };
    memset(bands, 0, sizeof *bands);
    count = count < 1 ? 1 : count > WO_BANDS_MAX ? WO_BANDS_MAX : count;
    bands->count = count;
    double sum[3] = {0};
    const double width = (HIGH_NM - LOW_NM) / count;
    for (int i = 0; i < count; i++) {
        bands->nm[i] = LOW_NM + width * (i + 0.5);
        for (int k = 0; k < STEPS; k++) {
            double rgb[3];
            matching(LOW_NM + width * (i + (k + 0.5) / STEPS), rgb);
            for (int c = 0; c < 3; c++) {
                bands->weight[i][c] += rgb[c];
                sum[c] += rgb[c];
            }
        }
    }
    for (int i = 0; i < count; i++)
        for (int c = 0; c < 3; c++)
            bands->weight[i][c] *= count / sum[c];
    if (count == 1)
        bands->nm[0] = WO_NM_D;
}
