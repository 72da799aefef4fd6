/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_OPTICS_LEAST_SQUARES_H
#define WO_CORE_OPTICS_LEAST_SQUARES_H

/* Least squares by Householder reflections. Columns that depend on earlier ones are left out. */

/* a [rows][columns] becomes R in its upper triangle, b [rows][sides] becomes Q^T b. */
void wo_qr_factor(double *a, int rows, int columns, double *b, int sides);

/* From these: the solution x [count][sides] for the first count columns alone. stride: columns of a
   as factorised. */
void wo_qr_solve(const double *a, int stride, int count, const double *b, int sides, double *x);

#endif
