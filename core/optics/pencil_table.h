/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_OPTICS_PENCIL_TABLE_H
#define WO_CORE_OPTICS_PENCIL_TABLE_H

#include "optics/lens_table.h"
#include "optics/pencil.h"
#include "spectrum/bands.h"

/* Pencils of any lens model: samples of the iris, each with one wavelength. Their rays come from a
   table of the model, or from the model itself, traced one by one. */
typedef struct wo_table_pencils wo_table_pencils;

typedef struct wo_table_pencil_options {
    const wo_aperture *aperture;
    double focal_px;           /* px per tangent, horizontally */
    double stretch;            /* vertical px per horizontal px */
    double centre_x, centre_y; /* px, where the axis meets the picture */
    double px_per_dioptre;     /* as the thin lens of this f-number has it */
    double max_reach;          /* px; rays that would go farther at |v| <= v_limit are left out */
    double v_limit;            /* dioptres from the focus */
    double half_diagonal;      /* px, horizontal ones: the field of the barn doors */
    wo_barn_doors doors;
    int count;       /* rays of a pencil */
    int wavelengths; /* 1..16 */
    bool exact;      /* trace every ray, also where a table would do */
    uint32_t seed;
} wo_table_pencil_options;

/* What was found out about the lens on the way; for plans and reports. */
typedef struct wo_table_facts {
    int wavelengths; /* used: 1 when colours do not part by more than WO_COLOUR_PX */
    double colour_px;
    bool exact;        /* traced one by one: asked for, or no table is good enough */
    int degree, nodes; /* of the table; 0 = none was made */
    double rms_px;     /* of the table against the model, lens_table.h */
    double lit_error;
    double field_lit;
    bool ideal;           /* rays are those of a thin lens to WO_IDEAL_PX */
    double beyond;        /* part of the rays that are left out because they go too far */
    double aberration_px; /* longest a of any ray that gets through */
    double step_px;       /* RMS of how far rays move from one pencil's place to the next */
} wo_table_facts;

#define WO_COLOUR_PX 0.05
#define WO_TABLE_PX  0.03 /* wanted of a table */
#define WO_IDEAL_PX  0.001
/* A table that is farther off than this is not used. */
#define WO_TABLE_MOST_PX  0.25
#define WO_TABLE_MOST_LIT 0.02
#define WO_STEP_PX        2.0 /* more shows */

/* Borrows the model. No ray goes farther than the lens's reach says, whatever the model does. */
WO_NODISCARD wo_status wo_table_pencils_create(const wo_context *context,
                                               const wo_lens_model *model,
                                               const wo_table_pencil_options *options,
                                               wo_table_pencils **pencils, wo_table_facts *facts,
                                               wo_error *error);
/* The same lens with another number of rays, count >= 1. It borrows the table of first, which must
   outlive it. */
WO_NODISCARD wo_status wo_table_pencils_again(const wo_context *context,
                                              const wo_table_pencils *first,
                                              const wo_aperture *aperture, int count,
                                              wo_table_pencils **pencils, wo_error *error);
void wo_table_pencils_destroy(const wo_context *context, wo_table_pencils **pencils);
wo_lens wo_table_pencils_lens(const wo_table_pencils *pencils);

#endif
