/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_LENS_DATA_H
#define WO_CLI_LENS_DATA_H

#include "lens_view.h"

#include <stdio.h>

/* What wideopen lens says of a lens. */

enum { WO_LENS_ROWS = 10 };

/* First-order data, as they are printed. */
typedef struct wo_lens_row_name {
    const char *key, *text;
    size_t offset; /* in wo_first_order */
} wo_lens_row_name;
extern const wo_lens_row_name wo_lens_rows[WO_LENS_ROWS];
double wo_lens_row(const wo_first_order *first, size_t row);

extern const char wo_lens_clamped_note[];

/* All that the page shows, as JSON; lengths in mm, angles in degrees, vergences in dioptres. first:
   of the meridian asked for. */
void wo_lens_print_json(const wo_lens_view *view, const wo_first_order *first, FILE *out);

#endif
