/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WIDEOPEN_PRESCRIPTION_H
#define WIDEOPEN_PRESCRIPTION_H

#include "wideopen/glass.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The prescription of a lens: its surfaces from front to back, as light passes them. Lengths in mm,
   z from the first vertex along the light; x to the right, y up. */

#define WO_SURFACES_MAX 64
#define WO_ASPHERE_MAX  8

typedef enum wo_meridian {
    WO_MERIDIAN_BOTH, /* rotationally symmetric */
    WO_MERIDIAN_X,    /* a cylinder with power in x only */
    WO_MERIDIAN_Y     /* in y only */
} wo_meridian;

/* Sag: z(r) = c r^2 / (1 + sqrt(1 - (1 + conic) c^2 r^2)) + A2 r^2 + A4 r^4 + ...; for cylinders r
   is the coordinate of the meridian. */
typedef struct wo_surface {
    double curvature; /* 1/mm, c; positive: the centre lies on the image side; 0 = plane */
    double conic;
    double asphere[WO_ASPHERE_MAX]; /* A2, A4, ... A16 */
    int asphere_terms;              /* 0..8: how many of them count */
    double thickness;     /* mm to the next vertex; of the last: to the sensor as designed */
    double semi_aperture; /* mm, clear radius; 0 = unlimited */
    wo_meridian meridian;
    wo_glass glass; /* the medium behind */
    bool stop;      /* the iris; its semi_aperture is the iris fully open */
} wo_surface;

typedef struct wo_prescription {
    char name[64];   /* an identifier: letters, digits, _ and - */
    char title[128]; /* for people */
    char source[256];
    double focal_mm;   /* as designed; 0 = not said */
    double f_number;   /* as designed; 0 = not said */
    double half_field; /* degrees; 0 = not said */
    int count;
    int stop; /* index of the surface with the iris */
    wo_surface surface[WO_SURFACES_MAX];
} wo_prescription;

/* Reads a text: the .lens format of docs in core/optics/lens_format.md, or, when its first word
   that is not a comment is a number, the four columns of a pbrt lens file (radius, thickness,
   index, diameter, in mm; the row of radius 0 and index 0, or 1 where air is before, is the iris).
   text need not end in 0. name (may be NULL) is that of the file, for messages, and the lens's name
   (its stem) when the text does not say one. Errors name the line, and *lens is zero then. Never
   reads beyond bytes; any bytes are legal input. Any thread. */
WO_NODISCARD wo_status wo_prescription_parse(const char *text, size_t bytes, const char *name,
                                             wo_prescription *lens, wo_error *error);

/* What the parser makes sure of, for prescriptions made by other means: 1..64 surfaces, exactly one
   stop, finite numbers, thickness -1e4..1e5 mm and curvature -10..10 /mm, something with power; an
   identifier as name, UTF-8 without control characters as texts, glasses as the functions of
   glass.h make them. Any thread. */
WO_NODISCARD wo_status wo_prescription_validate(const wo_prescription *lens, wo_error *error);

/* Writes the .lens format that gives the same prescription again, every number equal, if valid.
   Returns the length without the closing 0, also when size was too small for it (as snprintf).
   Notes and comments of a text that was read are not kept. Any thread. */
size_t wo_prescription_print(const wo_prescription *lens, char *text, size_t size);

/* The designs that come with the library, sorted, by number (NULL beyond the last) or by name. Any
   thread. */
const char *wo_lens_name_at(size_t index);
WO_NODISCARD wo_status wo_lens_find(const char *name, wo_prescription *lens, wo_error *error);

/* All lengths times factor; nothing happens when that is not positive and finite. */
void wo_prescription_scale(wo_prescription *lens, double factor);

#ifdef __cplusplus
}
#endif
#endif
