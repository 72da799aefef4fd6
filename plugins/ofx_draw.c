/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_draw.h"

#include <math.h>
#include <stdio.h>

static const float rim = 2; /* px by which a dark line is wider than the line on it */

/* Colours where the host names none. */
static const OfxRGBAColourF own_inks[WO_OFX_INKS] = {
    [WO_OFX_INK_RIM] = {0.0f, 0.0f, 0.0f, 0.8f},
    [WO_OFX_INK_IDLE] = {0.85f, 0.85f, 0.85f, 1.0f},
    [WO_OFX_INK_PICKED] = {1.0f, 0.75f, 0.1f, 1.0f},
    [WO_OFX_INK_JOIN] = {0.4f, 0.8f, 1.0f, 1.0f},
    [WO_OFX_INK_TEXT] = {0.95f, 0.95f, 0.95f, 1.0f},
};

bool wo_ofx_can_draw(const wo_ofx_suites *suites)
{
    return suites->draw && suites->draw->setColour && suites->draw->draw;
}

static void read_suite_inks(wo_ofx_canvas *canvas)
{
    static const struct {
        wo_ofx_ink ink;
        OfxStandardColour colour;
    } rows[] = {{WO_OFX_INK_IDLE, kOfxStandardColourOverlayDeselected},
                {WO_OFX_INK_PICKED, kOfxStandardColourOverlayActive},
                {WO_OFX_INK_JOIN, kOfxStandardColourOverlayMarqueeFG},
                {WO_OFX_INK_TEXT, kOfxStandardColourOverlayText}};
    for (size_t i = 0; i < WO_COUNT(rows) && canvas->suite->getColour; i++) {
        OfxRGBAColourF colour = {0, 0, 0, 0};
        if (canvas->suite->getColour(canvas->context, rows[i].colour, &colour) == kOfxStatOK)
            canvas->inks[rows[i].ink] = colour;
    }
}

/* The one colour a host may wish for is that of handles at rest and their numbers. */
static void read_suggested_ink(wo_ofx_canvas *canvas, const wo_ofx_suites *suites,
                               OfxPropertySetHandle interact)
{
    double rgb[3];
    if (!wo_ofx_read_doubles(suites, interact, kOfxInteractPropSuggestedColour, 3, rgb))
        return;
    const OfxRGBAColourF colour = {(float)rgb[0], (float)rgb[1], (float)rgb[2], 1};
    canvas->inks[WO_OFX_INK_IDLE] = colour;
    canvas->inks[WO_OFX_INK_TEXT] = colour;
}

bool wo_ofx_canvas_begin(wo_ofx_canvas *canvas, const wo_ofx_suites *suites,
                         OfxPropertySetHandle args, OfxPropertySetHandle interact,
                         const double pixel[2], bool may_gl)
{
    *canvas = (wo_ofx_canvas){.pixel = {pixel[0], pixel[1]}};
    for (int i = 0; i < WO_OFX_INKS; i++)
        canvas->inks[i] = own_inks[i];
    canvas->context = wo_ofx_get_pointer(suites, args, kOfxInteractPropDrawContext);
    if (canvas->context && wo_ofx_can_draw(suites)) {
        canvas->suite = suites->draw;
        read_suite_inks(canvas);
        return true;
    }
    if (!may_gl || !wo_ofx_gl_find(&canvas->gl))
        return false;
    read_suggested_ink(canvas, suites, interact);
    wo_ofx_gl_begin(&canvas->gl);
    return true;
}

void wo_ofx_canvas_end(const wo_ofx_canvas *canvas)
{
    if (!canvas->suite)
        wo_ofx_gl_end(&canvas->gl);
}

static void stroke(const wo_ofx_canvas *canvas, wo_ofx_ink ink, bool dashed, float width,
                   OfxDrawPrimitive kind, const OfxPointD *points, int count)
{
    const OfxDrawSuiteV1 *const suite = canvas->suite;
    if (!suite) {
        wo_ofx_gl_lines(&canvas->gl, &canvas->inks[ink], dashed, width, kind, points, count);
        return;
    }
    suite->setColour(canvas->context, &canvas->inks[ink]);
    if (suite->setLineWidth)
        suite->setLineWidth(canvas->context, width);
    if (suite->setLineStipple)
        suite->setLineStipple(canvas->context, dashed ? kOfxDrawLineStipplePatternDash
                                                      : kOfxDrawLineStipplePatternSolid);
    suite->draw(canvas->context, kind, points, count);
}

void wo_ofx_canvas_lines(const wo_ofx_canvas *canvas, wo_ofx_ink ink, bool dashed, float width,
                         OfxDrawPrimitive kind, const OfxPointD *points, int count)
{
    stroke(canvas, WO_OFX_INK_RIM, dashed, width + rim, kind, points, count);
    stroke(canvas, ink, dashed, width, kind, points, count);
}

/* A number in the seven strokes of a pocket calculator:

       -0-
      5   1
       -6-       a digit is 7 px wide and 12 px high, and the next one 11 px further
      4   2
       -3-
*/
static void digits(const wo_ofx_canvas *canvas, wo_ofx_ink ink, OfxPointD at, int number)
{
    static const unsigned char strokes[10] = {0x3f, 0x06, 0x5b, 0x4f, 0x66,
                                              0x6d, 0x7d, 0x07, 0x7f, 0x6f};
    static const unsigned char ends[7][4] = {{0, 12, 7, 12}, {7, 12, 7, 6}, {7, 6, 7, 0},
                                             {0, 0, 7, 0},   {0, 0, 0, 6},  {0, 6, 0, 12},
                                             {0, 6, 7, 6}};
    char text[16];
    OfxPointD points[sizeof text * WO_COUNT(ends) * 2];
    int count = 0;

    const int length = snprintf(text, sizeof text, "%d", number < 0 ? 0 : number);
    for (int i = 0; i < length; i++)
        for (size_t j = 0; j < WO_COUNT(ends); j++)
            for (int k = 0; k < 4 && (strokes[text[i] - '0'] >> j & 1); k += 2)
                points[count++] = (OfxPointD){at.x + (11 * i + ends[j][k]) * canvas->pixel[0],
                                              at.y + ends[j][k + 1] * canvas->pixel[1]};
    wo_ofx_canvas_lines(canvas, ink, false, 1.5f, kOfxDrawPrimitiveLines, points, count);
}

void wo_ofx_canvas_label(const wo_ofx_canvas *canvas, wo_ofx_ink ink, OfxPointD at,
                         const char *text, int number)
{
    const OfxDrawSuiteV1 *const suite = canvas->suite;
    const int align = kOfxDrawTextAlignmentLeft | kOfxDrawTextAlignmentBottom;
    if (!suite || !suite->drawText) {
        digits(canvas, ink, at, number);
        return;
    }
    const OfxPointD below = {at.x + canvas->pixel[0], at.y - canvas->pixel[1]};
    suite->setColour(canvas->context, &canvas->inks[WO_OFX_INK_RIM]);
    suite->drawText(canvas->context, text, &below, align);
    suite->setColour(canvas->context, &canvas->inks[ink]);
    suite->drawText(canvas->context, text, &at, align);
}
