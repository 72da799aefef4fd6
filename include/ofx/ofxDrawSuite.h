/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Draw suite, since 1.5: lets an interact draw without OpenGL. */

#ifndef WO_OFX_DRAW_SUITE_H
#define WO_OFX_DRAW_SUITE_H

#include "ofxCore.h"
#include "ofxPixels.h"

#ifdef __cplusplus
extern "C" {
#endif

#define kOfxDrawSuite "OfxDrawSuite"

/* Valid during one kOfxInteractActionDraw. */
typedef struct OfxDrawContext *OfxDrawContextHandle;

/* pointer, in the arguments of kOfxInteractActionDraw: the OfxDrawContextHandle to draw with. */
#define kOfxInteractPropDrawContext "OfxInteractPropDrawContext"

/* Colours of the host's own overlays. */
typedef enum OfxStandardColour {
    kOfxStandardColourOverlayBackground,
    kOfxStandardColourOverlayActive,
    kOfxStandardColourOverlaySelected,
    kOfxStandardColourOverlayDeselected,
    kOfxStandardColourOverlayMarqueeFG,
    kOfxStandardColourOverlayMarqueeBG,
    kOfxStandardColourOverlayText
} OfxStandardColour;

typedef enum OfxDrawLineStipplePattern {
    kOfxDrawLineStipplePatternSolid,
    kOfxDrawLineStipplePatternDot,
    kOfxDrawLineStipplePatternDash,
    kOfxDrawLineStipplePatternAltDash,
    kOfxDrawLineStipplePatternDotDash
} OfxDrawLineStipplePattern;

/* What a list of points means. A rectangle and an ellipse take two opposite corners. */
typedef enum OfxDrawPrimitive {
    kOfxDrawPrimitiveLines,
    kOfxDrawPrimitiveLineStrip,
    kOfxDrawPrimitiveLineLoop,
    kOfxDrawPrimitiveRectangle,
    kOfxDrawPrimitivePolygon,
    kOfxDrawPrimitiveEllipse
} OfxDrawPrimitive;

/* Bits to be combined, one horizontal and one vertical. */
typedef enum OfxDrawTextAlignment {
    kOfxDrawTextAlignmentLeft = 1,
    kOfxDrawTextAlignmentRight = 2,
    kOfxDrawTextAlignmentTop = 4,
    kOfxDrawTextAlignmentBottom = 8,
    kOfxDrawTextAlignmentBaseline = 16,
    kOfxDrawTextAlignmentCenterH = 3,
    kOfxDrawTextAlignmentCenterV = 12
} OfxDrawTextAlignment;

/* Version 1. Points are in the coordinates of the interact, canonical for an overlay. Colour, width
 * and stipple hold for what is drawn after them. */
typedef struct OfxDrawSuiteV1 {
    OfxStatus (*getColour)(OfxDrawContextHandle context, OfxStandardColour std_colour,
                           OfxRGBAColourF *colour);
    OfxStatus (*setColour)(OfxDrawContextHandle context, const OfxRGBAColourF *colour);
    OfxStatus (*setLineWidth)(OfxDrawContextHandle context, float width);
    OfxStatus (*setLineStipple)(OfxDrawContextHandle context, OfxDrawLineStipplePattern pattern);
    OfxStatus (*draw)(OfxDrawContextHandle context, OfxDrawPrimitive primitive,
                      const OfxPointD *points, int point_count);

    /* `alignment` is made of OfxDrawTextAlignment bits and places the text around `pos`. */
    OfxStatus (*drawText)(OfxDrawContextHandle context, const char *text, const OfxPointD *pos,
                          int alignment);
} OfxDrawSuiteV1;

#ifdef __cplusplus
}
#endif

#endif
