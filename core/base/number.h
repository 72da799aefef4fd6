/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_BASE_NUMBER_H
#define WO_CORE_BASE_NUMBER_H

#include "wideopen/base.h"

/* Decimal text and back, the same in every locale: the decimal point is always a point. */

/* Room for any number wo_number_print writes, with the final zero. */
#define WO_NUMBER_SIZE 32

/* Reads one finite decimal number, with an optional sign, point and exponent, from the start of
   text; *end (if not NULL) is set behind it. Blanks, hexadecimal, "inf" and "nan" are not numbers.
   False if there is no number or it is too large for a double; *value is then untouched. Any
   thread. */
bool wo_number_read(const char *text, const char **end, double *value);

/* Shortest text that wo_number_read turns into the same double; "nan", "inf" and "-inf" for what
   has no digits. Returns the length. Any thread. */
int wo_number_print(double value, char text[WO_NUMBER_SIZE]);

#endif
