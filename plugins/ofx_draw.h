/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_PLUGINS_OFX_DRAW_H
#define WO_PLUGINS_OFX_DRAW_H

#include "ofx_suites.h"

/* Lines and labels over a viewer, with the draw suite of OpenFX 1.5 or with OpenGL. Every line has
   a dark rim, so that it is seen over any picture. Points are in canonical coordinates. */

typedef enum wo_ofx_ink {
    WO_OFX_INK_RIM, /* behind the others */
    WO_OFX_INK_IDLE,
    WO_OFX_INK_PICKED,
    WO_OFX_INK_JOIN,
    WO_OFX_INK_TEXT,
    WO_OFX_INKS
} wo_ofx_ink;

/* The functions of OpenGL 1.x that drawing needs. */
typedef struct wo_ofx_gl {
    void (*begin)(unsigned mode);
    void (*end)(void);
    void (*vertex)(double x, double y);
    void (*colour)(float r, float g, float b, float a);
    void (*width)(float pixels);
    void (*stipple)(int factor, unsigned short pattern);
    void (*enable)(unsigned what);
    void (*disable)(unsigned what);
    void (*blend)(unsigned source, unsigned destination);
    void (*push)(unsigned what);
    void (*pop)(void);
} wo_ofx_gl;

/* One draw action; lives on its stack. */
typedef struct wo_ofx_canvas {
    const OfxDrawSuiteV1 *suite;  /* NULL: OpenGL */
    OfxDrawContextHandle context; /* of the suite */
    wo_ofx_gl gl;
    double pixel[2]; /* size of a screen pixel, canonical, > 0 */
    OfxRGBAColourF inks[WO_OFX_INKS];
} wo_ofx_canvas;

/* Whether the host has a draw suite that can draw. */
bool wo_ofx_can_draw(const wo_ofx_suites *suites);

/* Begins to draw: with the draw suite if args, those of the draw action, hold its context, else
   with OpenGL if may_gl says that the host has made a context of it current. interact, the
   properties of the interact, may be NULL. false if there is nothing to draw with; no end then. */
bool wo_ofx_canvas_begin(wo_ofx_canvas *canvas, const wo_ofx_suites *suites,
                         OfxPropertySetHandle args, OfxPropertySetHandle interact,
                         const double pixel[2], bool may_gl);
void wo_ofx_canvas_end(const wo_ofx_canvas *canvas);

/* Lines of width screen pixels: from each even point to the next one (Lines), through all points
   (LineStrip), and back to the first (LineLoop). */
void wo_ofx_canvas_lines(const wo_ofx_canvas *canvas, wo_ofx_ink ink, bool dashed, float width,
                         OfxDrawPrimitive kind, const OfxPointD *points, int count);

/* A text whose lower left corner is at a point; OpenGL has no letters: number is written then. */
void wo_ofx_canvas_label(const wo_ofx_canvas *canvas, wo_ofx_ink ink, OfxPointD at,
                         const char *text, int number);

/* ofx_draw_gl.c: looks up OpenGL in the running program, whatever version it is of; the plugin is
   not linked to it. false if the program has not loaded it. */
bool wo_ofx_gl_find(wo_ofx_gl *gl);
void wo_ofx_gl_begin(const wo_ofx_gl *gl);
void wo_ofx_gl_end(const wo_ofx_gl *gl);
void wo_ofx_gl_lines(const wo_ofx_gl *gl, const OfxRGBAColourF *colour, bool dashed, float width,
                     OfxDrawPrimitive kind, const OfxPointD *points, int count);

#endif
