/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Pixel types. Images interleave their components in this order: R G B A, R G B, or A alone.
 * B is 0..255, S is 0..65535, F and D are 0..1 by custom and unclamped. */

#ifndef WO_OFX_PIXELS_H
#define WO_OFX_PIXELS_H

#include "ofxCore.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct OfxRGBAColourB {
    unsigned char r, g, b, a;
} OfxRGBAColourB;

typedef struct OfxRGBAColourS {
    unsigned short r, g, b, a;
} OfxRGBAColourS;

typedef struct OfxRGBAColourF {
    float r, g, b, a;
} OfxRGBAColourF;

typedef struct OfxRGBAColourD {
    double r, g, b, a;
} OfxRGBAColourD;

typedef struct OfxRGBColourB {
    unsigned char r, g, b;
} OfxRGBColourB;

typedef struct OfxRGBColourS {
    unsigned short r, g, b;
} OfxRGBColourS;

typedef struct OfxRGBColourF {
    float r, g, b;
} OfxRGBColourF;

typedef struct OfxRGBColourD {
    double r, g, b;
} OfxRGBColourD;

#ifdef __cplusplus
}
#endif

#endif
