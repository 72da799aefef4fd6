/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TESTS_PROBE_EFFECT_H
#define WO_TESTS_PROBE_EFFECT_H

#include "wideopen/effect.h"

/* A box blur with every kind of parameter and clip: what the glue is tested with, independent of
   the real effects. Its plan prints what it was given, one "key=value" a line. */

typedef enum probe_trouble {
    PROBE_TROUBLE_NONE,
    PROBE_TROUBLE_FAIL, /* render fails with a text */
    PROBE_TROUBLE_SLOW, /* every row takes a millisecond */
    PROBE_TROUBLE_WAIT, /* render goes on until it is aborted */
    PROBE_TROUBLE_WARN  /* the plan warns of the note, the render of rows */
} probe_trouble;

typedef struct probe_params {
    double radius;   /* px */
    double angle;    /* deg; added to red, in turns */
    int32_t repeats; /* added to blue */
    int32_t on;
    int32_t trouble;
    double centre[2]; /* px; added to red and green, in 1/1000 */
    double tint[3];
    char note[WO_PARAM_STRING_SIZE];
} probe_params;

enum { PROBE_SOURCE, PROBE_DEPTH, PROBE_MASK, PROBE_EXTRA, PROBE_CLIPS };

extern const wo_effect probe_effect;

/* The same with points that are handles: three of them, as many as "uses" says, in "mode" each or
   plane. */
const wo_effect *pointing_effect(void);

#endif
