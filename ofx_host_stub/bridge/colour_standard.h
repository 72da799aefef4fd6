/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_COLOUR_STANDARD_H
#define WO_BRIDGE_COLOUR_STANDARD_H

#include "wideopen/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Colour spaces that files and configurations name in many ways. */
typedef struct wo_colour_standard {
    const char *id;      /* the Color Interop Forum's, "" where it has none */
    const char *library; /* what OpenImageIO calls it, "" where it has no word */
    float primaries[8];  /* x, y of red, green, blue and white; all 0 = not told */
    bool linear;
    const char *names[12]; /* in configurations, what is usual first; NULL ends them */
} wo_colour_standard;

/* The standard that has this id, library's word or name, in any case; NULL when there is none. */
const wo_colour_standard *wo_colour_standard_named(const char *word);

/* The linear one whose primaries, as written in a file, are these; NULL when there is none. */
const wo_colour_standard *wo_colour_standard_by_primaries(const float primaries[8]);

/* Are these the same to the digits that people write? */
bool wo_colour_same_primaries(const float a[8], const float b[8]);

#ifdef __cplusplus
}
#endif
#endif
