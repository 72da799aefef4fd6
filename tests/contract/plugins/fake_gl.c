/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "fake_gl.h"

#include <string.h>

enum { LINE_STIPPLE = 0xb24 };

fake_gl fake_gl_record;

static unsigned mode;
static float colour[4], width;
static int inside;

void glBegin(unsigned what);
void glEnd(void);
void glVertex2d(double x, double y);
void glColor4f(float r, float g, float b, float a);
void glLineWidth(float pixels);
void glLineStipple(int factor, unsigned short pattern);
void glEnable(unsigned what);
void glDisable(unsigned what);
void glBlendFunc(unsigned source, unsigned destination);
void glPushAttrib(unsigned what);
void glPopAttrib(void);

static void call(int wanted)
{
    fake_gl_record.calls++;
    if (inside != wanted)
        fake_gl_record.stray++;
}

void glBegin(unsigned what)
{
    call(0);
    inside = 1;
    mode = what;
    fake_gl_record.begun++;
}

void glEnd(void)
{
    call(1);
    inside = 0;
    fake_gl_record.ended++;
}

void glVertex2d(double x, double y)
{
    const int i = fake_gl_record.vertex_count;
    call(1);
    if (i == sizeof fake_gl_record.vertices / sizeof *fake_gl_record.vertices)
        return;
    fake_gl_record.vertices[i].x = x;
    fake_gl_record.vertices[i].y = y;
    memcpy(fake_gl_record.vertices[i].colour, colour, sizeof colour);
    fake_gl_record.vertices[i].width = width;
    fake_gl_record.vertices[i].mode = mode;
    fake_gl_record.vertices[i].dashed = fake_gl_record.dashed;
    fake_gl_record.vertex_count++;
}

void glColor4f(float r, float g, float b, float a)
{
    call(0);
    memcpy(colour, (float[4]){r, g, b, a}, sizeof colour);
}

void glLineWidth(float pixels)
{
    call(0);
    width = pixels;
}

void glLineStipple(int factor, unsigned short pattern)
{
    call(0);
    fake_gl_record.stray += factor < 1 || !pattern;
}

void glEnable(unsigned what)
{
    call(0);
    if (what == LINE_STIPPLE)
        fake_gl_record.dashed = 1;
}

void glDisable(unsigned what)
{
    call(0);
    if (what == LINE_STIPPLE)
        fake_gl_record.dashed = 0;
}

void glBlendFunc(unsigned source, unsigned destination)
{
    call(0);
    fake_gl_record.blended += source != destination;
}

void glPushAttrib(unsigned what)
{
    call(0);
    fake_gl_record.pushed += what != 0;
}

void glPopAttrib(void)
{
    call(0);
    fake_gl_record.popped++;
}
