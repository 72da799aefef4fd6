/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Names the standard has withdrawn. Hosts need them for old plugins; new plugins leave them out. */

#ifndef WO_OFX_OLD_H
#define WO_OFX_OLD_H

#include "ofxCore.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Component type. */
#define kOfxImageComponentYUVA "OfxImageComponentYUVA"

typedef struct OfxYUVAColourB {
    unsigned char y, u, v, a;
} OfxYUVAColourB;

typedef struct OfxYUVAColourS {
    unsigned short y, u, v, a;
} OfxYUVAColourS;

typedef struct OfxYUVAColourF {
    float y, u, v, a;
} OfxYUVAColourF;

/* int 0/1: the effect is analysing. Withdrawn in 1.4. */
#define kOfxImageEffectPropInAnalysis "OfxImageEffectPropInAnalysis"

/* int x2: size of the viewport in pixels. Withdrawn in 1.3. */
#define kOfxInteractPropViewportSize "OfxInteractPropViewport"

/* Values of kOfxParamPropDoubleType that count in units of the project size. Withdrawn in 1.2. */
#define kOfxParamDoubleTypeNormalisedX          "OfxParamDoubleTypeNormalisedX"
#define kOfxParamDoubleTypeNormalisedY          "OfxParamDoubleTypeNormalisedY"
#define kOfxParamDoubleTypeNormalisedXAbsolute  "OfxParamDoubleTypeNormalisedXAbsolute"
#define kOfxParamDoubleTypeNormalisedYAbsolute  "OfxParamDoubleTypeNormalisedYAbsolute"
#define kOfxParamDoubleTypeNormalisedXY         "OfxParamDoubleTypeNormalisedXY"
#define kOfxParamDoubleTypeNormalisedXYAbsolute "OfxParamDoubleTypeNormalisedXYAbsolute"

#ifdef __cplusplus
}
#endif

#endif
