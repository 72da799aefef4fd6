/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* A plugin is linked to nothing but the C library; the OpenGL of an interact is the one that the
   host has in its process already. */
#define _GNU_SOURCE /* RTLD_DEFAULT */

#include "ofx_draw.h"

#include <string.h>

#ifndef _WIN32
#include <dlfcn.h>
#endif

/* Numbers of OpenGL 1.x. */
enum {
    GL_LINES = 1,
    GL_LINE_LOOP = 2,
    GL_LINE_STRIP = 3,
    GL_SRC_ALPHA = 0x302,
    GL_ONE_MINUS_SRC_ALPHA = 0x303,
    GL_LINE_SMOOTH = 0xb20,
    GL_LINE_STIPPLE = 0xb24,
    GL_LIGHTING = 0xb50,
    GL_DEPTH_TEST = 0xb71,
    GL_BLEND = 0xbe2,
    GL_TEXTURE_2D = 0xde1,
    GL_CURRENT_BIT = 1,
    GL_LINE_BIT = 4,
    GL_ENABLE_BIT = 0x2000,
    GL_COLOR_BUFFER_BIT = 0x4000
};

#ifdef _WIN32
bool wo_ofx_gl_find(wo_ofx_gl *gl)
{
    (void)gl; /* no overlay there but with the draw suite */
    return false;
}
#else
static bool find_in(void *library, wo_ofx_gl *gl)
{
    static const struct {
        const char *name;
        size_t offset;
    } rows[] = {
        {"glBegin", offsetof(wo_ofx_gl, begin)},
        {"glEnd", offsetof(wo_ofx_gl, end)},
        {"glVertex2d", offsetof(wo_ofx_gl, vertex)},
        {"glColor4f", offsetof(wo_ofx_gl, colour)},
        {"glLineWidth", offsetof(wo_ofx_gl, width)},
        {"glLineStipple", offsetof(wo_ofx_gl, stipple)},
        {"glEnable", offsetof(wo_ofx_gl, enable)},
        {"glDisable", offsetof(wo_ofx_gl, disable)},
        {"glBlendFunc", offsetof(wo_ofx_gl, blend)},
        {"glPushAttrib", offsetof(wo_ofx_gl, push)},
        {"glPopAttrib", offsetof(wo_ofx_gl, pop)},
    };
    for (size_t i = 0; i < WO_COUNT(rows); i++) {
        void *const address = dlsym(library, rows[i].name);
        if (!address)
            return false;
        memcpy((char *)gl + rows[i].offset, &address, sizeof address);
    }
    return true;
}

/* Visible to all, or loaded by the host for itself alone; never loaded from here. */
bool wo_ofx_gl_find(wo_ofx_gl *gl)
{
    if (find_in(RTLD_DEFAULT, gl))
        return true;
    void *const library = dlopen("libGL.so.1", RTLD_LAZY | RTLD_NOLOAD);
    if (!library)
        return false;
    const bool found = find_in(library, gl);
    dlclose(library);
    return found;
}
#endif

void wo_ofx_gl_begin(const wo_ofx_gl *gl)
{
    gl->push(GL_CURRENT_BIT | GL_LINE_BIT | GL_ENABLE_BIT | GL_COLOR_BUFFER_BIT);
    gl->disable(GL_LIGHTING);
    gl->disable(GL_TEXTURE_2D);
    gl->disable(GL_DEPTH_TEST);
    gl->enable(GL_LINE_SMOOTH);
    gl->enable(GL_BLEND);
    gl->blend(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

void wo_ofx_gl_end(const wo_ofx_gl *gl)
{
    gl->pop();
}

void wo_ofx_gl_lines(const wo_ofx_gl *gl, const OfxRGBAColourF *colour, bool dashed, float width,
                     OfxDrawPrimitive kind, const OfxPointD *points, int count)
{
    gl->colour(colour->r, colour->g, colour->b, colour->a);
    gl->width(width);
    gl->stipple(1, 0xf0f0);
    (dashed ? gl->enable : gl->disable)(GL_LINE_STIPPLE);
    gl->begin(kind == kOfxDrawPrimitiveLines       ? GL_LINES
              : kind == kOfxDrawPrimitiveLineStrip ? GL_LINE_STRIP
                                                   : GL_LINE_LOOP);
    for (int i = 0; i < count; i++)
        gl->vertex(points[i].x, points[i].y);
    gl->end();
}
