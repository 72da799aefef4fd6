/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TESTS_MOCK_OVERLAY_H
#define WO_TESTS_MOCK_OVERLAY_H

#include "mock_host.h"
#include "ofx/ofxDrawSuite.h"
#include "ofx/ofxInteract.h"

/* The viewer of the mock host: it keeps what interacts draw as a list. */

enum { MOCK_TEXT = -1 };

/* One call of draw or drawText, with what was set before. */
typedef struct mock_drawing {
    int kind; /* OfxDrawPrimitive or MOCK_TEXT */
    OfxPointD points[32];
    int count;
    OfxRGBAColourF colour;
    float width;
    int stipple; /* OfxDrawLineStipplePattern */
    char text[64];
} mock_drawing;

typedef struct mock_viewer_state {
    /* Set by the test. */
    double pixel[2];
    bool no_pixel, no_effect, no_context, no_properties; /* not said */
    bool colourless;                                     /* getColour fails */

    /* Read by the test. */
    mock_drawing drawings[256];
    int count;
    int redraws;
} mock_viewer_state;

extern mock_viewer_state mock_viewer;

/* Back to pixels of size 1 and nothing drawn. */
void mock_viewer_reset(void);

/* Colour of the host for overlays. */
OfxRGBAColourF mock_colour(OfxStandardColour colour);

/* Describes and creates an interact; NULL and the answer in *status if that failed. */
OfxInteractHandle mock_interact_create(OfxPluginEntryPoint *entry, OfxImageEffectHandle effect,
                                       OfxStatus *status);
void mock_interact_destroy(OfxPluginEntryPoint *entry, OfxInteractHandle interact);

/* Sends an action; pen NULL: not said. What was drawn before is forgotten first. */
OfxStatus mock_interact(OfxPluginEntryPoint *entry, OfxInteractHandle interact, const char *action,
                        const double pen[2]);

/* Parameter at an index of kOfxInteractPropSlaveToParam, or NULL. */
const char *mock_interact_slave(OfxInteractHandle interact, int index);

#endif
