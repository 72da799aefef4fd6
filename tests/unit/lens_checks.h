/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TESTS_LENS_CHECKS_H
#define WO_TESTS_LENS_CHECKS_H

#include "wideopen/prescription.h"

#include <math.h>

enum { FIRST_VALUES = 13, COLOUR_VALUES = 7, LSA_VALUES = 13, PENCIL_VALUES = 33 };

typedef struct first_check {
    const char *name;
    wo_meridian meridian;
    double value[FIRST_VALUES];
} first_check;

typedef struct colour_check {
    const char *name;
    double shift[COLOUR_VALUES];
} colour_check;

typedef struct seidel_check {
    const char *name;
    double ep_d, field;
    double s[5], c[2];
} seidel_check;

typedef struct wolf_check {
    const char *name;
    double ep_d, field;
    double value[5];
} wolf_check;

typedef struct lsa_check {
    const char *name;
    double semi;
    double shift[3][LSA_VALUES];
} lsa_check;

typedef struct pencil_check {
    const char *name;
    double semi, bfd;
    double shift[3][PENCIL_VALUES];
} pencil_check;

#endif
