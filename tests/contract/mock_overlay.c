/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "mock_overlay.h"

#include "mock_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct OfxInteract {
    OfxPropertySetHandle props;
    OfxImageEffectHandle effect;
};

mock_viewer_state mock_viewer;

static mock_drawing pen; /* what the next drawing will look like */

void mock_viewer_reset(void)
{
    memset(&mock_viewer, 0, sizeof mock_viewer);
    mock_viewer.pixel[0] = mock_viewer.pixel[1] = 1;
}

/* ---- interact suite ---- */

static OfxStatus swap_buffers(OfxInteractHandle interact)
{
    return interact ? kOfxStatOK : kOfxStatErrBadHandle;
}

static OfxStatus redraw(OfxInteractHandle interact)
{
    mock_viewer.redraws++;
    return interact ? kOfxStatOK : kOfxStatErrBadHandle;
}

static OfxStatus get_property_set(OfxInteractHandle interact, OfxPropertySetHandle *props)
{
    if (mock_viewer.no_properties)
        return kOfxStatErrUnsupported;
    *props = interact->props;
    return kOfxStatOK;
}

const void *mock_interact_suite(void)
{
    static const OfxInteractSuiteV1 suite = {swap_buffers, redraw, get_property_set};
    return &suite;
}

/* ---- draw suite ---- */

OfxRGBAColourF mock_colour(OfxStandardColour colour)
{
    return (OfxRGBAColourF){0.1f * (float)colour, 0.5f, 0.25f, 1};
}

static bool drawn_in(OfxDrawContextHandle context)
{
    return (void *)context == (void *)&mock_viewer;
}

static OfxStatus get_colour(OfxDrawContextHandle context, OfxStandardColour which,
                            OfxRGBAColourF *colour)
{
    if (mock_viewer.colourless || !drawn_in(context))
        return kOfxStatFailed;
    *colour = mock_colour(which);
    return kOfxStatOK;
}

static OfxStatus set_colour(OfxDrawContextHandle context, const OfxRGBAColourF *colour)
{
    pen.colour = *colour;
    return drawn_in(context) ? kOfxStatOK : kOfxStatErrBadHandle;
}

static OfxStatus set_width(OfxDrawContextHandle context, float width)
{
    pen.width = width;
    return drawn_in(context) ? kOfxStatOK : kOfxStatErrBadHandle;
}

static OfxStatus set_stipple(OfxDrawContextHandle context, OfxDrawLineStipplePattern pattern)
{
    pen.stipple = (int)pattern;
    return drawn_in(context) ? kOfxStatOK : kOfxStatErrBadHandle;
}

static OfxStatus put(OfxDrawContextHandle context, int kind, const char *text,
                     const OfxPointD *points, int count)
{
    if (!drawn_in(context) || mock_viewer.count == (int)WO_COUNT(mock_viewer.drawings) ||
        count < 1 || count > (int)WO_COUNT(pen.points))
        return kOfxStatErrValue;
    mock_drawing *const drawing = &mock_viewer.drawings[mock_viewer.count++];
    *drawing = pen;
    drawing->kind = kind;
    drawing->count = count;
    memcpy(drawing->points, points, (size_t)count * sizeof *points);
    snprintf(drawing->text, sizeof drawing->text, "%s", text);
    return kOfxStatOK;
}

static OfxStatus draw(OfxDrawContextHandle context, OfxDrawPrimitive primitive,
                      const OfxPointD *points, int count)
{
    return put(context, (int)primitive, "", points, count);
}

static OfxStatus draw_text(OfxDrawContextHandle context, const char *text, const OfxPointD *at,
                           int alignment)
{
    return alignment ? put(context, MOCK_TEXT, text, at, 1) : kOfxStatErrValue;
}

const void *mock_draw_suite(bool hollow)
{
    static const OfxDrawSuiteV1 full = {get_colour,  set_colour, set_width,
                                        set_stipple, draw,       draw_text};
    static const OfxDrawSuiteV1 empty = {.getColour = get_colour};
    return hollow ? &empty : &full;
}

/* ---- actions ---- */

static void fill(OfxPropertySetHandle in, OfxInteractHandle interact, const double at[2])
{
    put_double(in, kOfxPropTime, 0, 1);
    if (!mock_viewer.no_effect)
        put_pointer(in, kOfxPropEffectInstance, 0, interact->effect);
    if (!mock_viewer.no_context)
        put_pointer(in, kOfxInteractPropDrawContext, 0, &mock_viewer);
    for (int i = 0; i < 2 && !mock_viewer.no_pixel; i++)
        put_double(in, kOfxInteractPropPixelScale, i, mock_viewer.pixel[i]);
    for (int i = 0; i < 2 && at; i++)
        put_double(in, kOfxInteractPropPenPosition, i, at[i]);
}

OfxStatus mock_interact(OfxPluginEntryPoint *entry, OfxInteractHandle interact, const char *action,
                        const double at[2])
{
    const OfxPropertySetHandle in = set_new();
    mock_viewer.count = 0;
    memset(&pen, 0, sizeof pen);
    fill(in, interact, at);
    const OfxStatus status = entry(action, interact, in, NULL);
    set_free(in);
    mock_settle();
    return status;
}

static void release(OfxInteractHandle interact)
{
    set_free(interact->props);
    free(interact);
    mock_settle();
}

OfxInteractHandle mock_interact_create(OfxPluginEntryPoint *entry, OfxImageEffectHandle effect,
                                       OfxStatus *status)
{
    const OfxInteractHandle interact = calloc(1, sizeof *interact);
    interact->props = set_new();
    interact->effect = effect;
    *status = entry(kOfxActionDescribe, interact, NULL, NULL);
    if (*status == kOfxStatOK) {
        put_pointer(interact->props, kOfxPropEffectInstance, 0, effect);
        *status = entry(kOfxActionCreateInstance, interact, NULL, NULL);
    }
    if (*status == kOfxStatOK)
        return interact;
    release(interact);
    return NULL;
}

void mock_interact_destroy(OfxPluginEntryPoint *entry, OfxInteractHandle interact)
{
    entry(kOfxActionDestroyInstance, interact, NULL, NULL);
    release(interact);
}

const char *mock_interact_slave(OfxInteractHandle interact, int index)
{
    char *name = NULL;
    get_text(interact->props, kOfxInteractPropSlaveToParam, index, &name);
    return name;
}
