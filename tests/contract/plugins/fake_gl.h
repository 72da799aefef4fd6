/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TESTS_FAKE_GL_H
#define WO_TESTS_FAKE_GL_H

/* What was done with the OpenGL of fake_gl.c, its symbol "fake_gl_record". */
typedef struct fake_gl {
    int calls;
    int pushed, popped;
    int begun, ended;
    int stray; /* calls at the wrong place: inside or outside of glBegin and glEnd */
    int dashed, blended;
    struct {
        double x, y;
        float colour[4];
        float width;
        unsigned mode;
        int dashed;
    } vertices[2048];
    int vertex_count;
} fake_gl;

#endif
