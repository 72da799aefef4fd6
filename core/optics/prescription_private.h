/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_OPTICS_PRESCRIPTION_PRIVATE_H
#define WO_CORE_OPTICS_PRESCRIPTION_PRIVATE_H

#include "wideopen/prescription.h"

/* Shared by the files of glasses and prescriptions. Any thread. */

#define WO_RADIUS_MAX 1e9 /* mm, of a radius in a text; beyond, the curvature is written */

/* Whether two names of glasses are one: case does not matter. */
bool wo_glass_name_is(const char *a, const char *b);
/* Whether a glass of its own may be called so. */
bool wo_glass_name_legal(const char *name);
/* All members the same. */
bool wo_glass_same(const wo_glass *a, const wo_glass *b);
/* Whether a glass is as the functions of glass.h give it. */
wo_status wo_glass_check(const wo_glass *glass, wo_error *error);
/* A glass that a text has to define: with a formula, and not of the catalogue. */
bool wo_glass_own(const wo_glass *glass);

/* An identifier for a lens: 1..63 of letters, digits, _ and -. */
bool wo_lens_name_legal(const char *name);

/* One line of UTF-8 without control characters and without blanks around it. */
wo_status wo_line_check(const char *text, size_t bytes, size_t most, const char *what,
                        wo_error *error);

/* What can be said of one surface alone, and of everything but the surfaces. What is not said yet
   (zero) is all right. */
wo_status wo_surface_check(const wo_surface *surface, wo_error *error);
wo_status wo_lens_header_check(const wo_prescription *lens, wo_error *error);

/* The formats of wo_prescription_parse. The prescription is zero before; what they say of it is
   checked, but for wo_prescription_validate. */
typedef struct wo_lines wo_lines;
wo_status wo_lens_read(wo_lines *lines, wo_prescription *lens);
wo_status wo_dat_read(wo_lines *lines, wo_prescription *lens);
/* A radius as a curvature; 0 is a plane. */
wo_status wo_radius_read(const wo_lines *lines, double radius, double *curvature);

/* The designs that come with the library, sorted by name; generated from footage/lenses. */
typedef struct wo_lens_text {
    const char *name;
    const char *text;
} wo_lens_text;

extern const wo_lens_text wo_lens_texts[];
extern const size_t wo_lens_text_count;

#endif
