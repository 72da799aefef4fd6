/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_SPECTRUM_BANDS_H
#define WO_CORE_SPECTRUM_BANDS_H

/* Wavelengths that stand for red, green and blue. A picture has three numbers for the spectrum of a
   pixel; here the light of each is spread over the wavelengths that its primary of Rec. 709
   responds to: the colour matching functions of CIE 1931 in Rec. 709, negative parts left out.
   Spreading a white picture over the bands and adding up gives white again, exactly. */

enum { WO_BANDS_MAX = 16 };

typedef struct wo_bands {
    int count;
    double nm[WO_BANDS_MAX];
    double weight[WO_BANDS_MAX][3]; /* the mean of each column is 1 */
} wo_bands;

/* count bands of equal width over 410..690 nm, at their middles; 1: the d line, weights 1. count is
   clamped to 1..16. */
void wo_bands_make(int count, wo_bands *bands);

#endif
