/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_OPTICS_APERTURE_KERNEL_H
#define WO_CORE_OPTICS_APERTURE_KERNEL_H

#include "wideopen/aperture.h"

/* A kernel made ready: pixels of constant light, sampled by inverting the share of each row and of
   each pixel in its row. Coordinates are the aperture's, before it is turned and squeezed. */
typedef struct wo_kernel_table wo_kernel_table;

/* Pixels that an obstruction of this radius covers wholly are dark; those it covers partly are
   not. */
WO_NODISCARD wo_status wo_kernel_table_create(const wo_context *context,
                                              const wo_aperture_kernel *kernel, double obstruction,
                                              wo_kernel_table **table, wo_error *error);
void wo_kernel_table_destroy(const wo_context *context, wo_kernel_table **table);

void wo_kernel_table_sample(const wo_kernel_table *table, double s, double t, double u[2]);

/* Light of the pixel at a point over that of the brightest; 0 outside. */
double wo_kernel_table_value(const wo_kernel_table *table, double x, double y);

/* Integral of the values. */
double wo_kernel_table_area(const wo_kernel_table *table);

#endif
