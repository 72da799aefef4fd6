/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/*
 * Interacts: drawing and mouse work of a plugin inside the host's viewer or parameter panel.
 *
 * An interact has its own entry point, an OfxPluginEntryPoint whose handle is an OfxInteractHandle.
 * It gets kOfxActionDescribe, kOfxActionCreateInstance and kOfxActionDestroyInstance as an effect
 * does, and the actions below. kOfxStatOK means handled, kOfxStatReplyDefault passes the event on.
 */

#ifndef WO_OFX_INTERACT_H
#define WO_OFX_INTERACT_H

#include "ofxCore.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct OfxInteract *OfxInteractHandle;

#define kOfxInteractSuite "OfxInteractSuite"

/* ---- Actions --------------------------------------------------------------------------------- */

#define kOfxInteractActionDraw      "OfxInteractActionDraw"
#define kOfxInteractActionPenMotion "OfxInteractActionPenMotion"
#define kOfxInteractActionPenDown   "OfxInteractActionPenDown"
#define kOfxInteractActionPenUp     "OfxInteractActionPenUp"
#define kOfxInteractActionKeyDown   "OfxInteractActionKeyDown"
#define kOfxInteractActionKeyUp     "OfxInteractActionKeyUp"
#define kOfxInteractActionKeyRepeat "OfxInteractActionKeyRepeat"
#define kOfxInteractActionGainFocus "OfxInteractActionGainFocus"
#define kOfxInteractActionLoseFocus "OfxInteractActionLoseFocus"

/* ---- Properties ------------------------------------------------------------------------------ */

/* string xN, written by the plugin: parameters whose change makes the host redraw. */
#define kOfxInteractPropSlaveToParam "OfxInteractPropSlaveToParam"

/* double x2: size of a screen pixel in canonical units. */
#define kOfxInteractPropPixelScale "OfxInteractPropPixelScale"

/* double x3: r, g, b behind the interact. */
#define kOfxInteractPropBackgroundColour "OfxInteractPropBackgroundColour"

/* double x3: r, g, b the host would like to see drawn. */
#define kOfxInteractPropSuggestedColour "OfxInteractPropSuggestedColour"

/* double x2: pen in canonical coordinates. */
#define kOfxInteractPropPenPosition "OfxInteractPropPenPosition"

/* int x2: pen in pixels of the viewport. */
#define kOfxInteractPropPenViewportPosition "OfxInteractPropPenViewportPosition"

/* double: 0..1. */
#define kOfxInteractPropPenPressure "OfxInteractPropPenPressure"

/* int: bits of a colour component of the frame buffer. */
#define kOfxInteractPropBitDepth "OfxInteractPropBitDepth"

/* int 0/1: the frame buffer has alpha. */
#define kOfxInteractPropHasAlpha "OfxInteractPropHasAlpha"

/* Version 1, for OpenGL and for draw suite interacts. */
typedef struct OfxInteractSuiteV1 {
    OfxStatus (*interactSwapBuffers)(OfxInteractHandle interactInstance);
    OfxStatus (*interactRedraw)(OfxInteractHandle interactInstance);
    OfxStatus (*interactGetPropertySet)(OfxInteractHandle interactInstance,
                                        OfxPropertySetHandle *property);
} OfxInteractSuiteV1;

#ifdef __cplusplus
}
#endif

#endif
