/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/least_squares.h"

#include <math.h>

#define DEPENDENT 1e-11

/* to -= factor * (sum over the rows of w times from), row by row, so that memory is read in order:
   applies I - beta w w^T to columns first..count-1 of m [rows][count], with w in w[rows]. */
static void reflect(const double *w, double beta, int rows, double *m, int first, int count,
                    double *dot)
{
    for (int j = first; j < count; j++)
        dot[j] = 0;
    for (int i = 0; i < rows; i++)
        for (int j = first; j < count; j++)
            dot[j] += w[i] * m[i * count + j];
    for (int i = 0; i < rows; i++) {
        const double part = beta * w[i];
        for (int j = first; j < count; j++)
            m[i * count + j] -= part * dot[j];
    }
}

void wo_qr_factor(double *a, int rows, int columns, double *b, int sides)
{
    enum { ROWS_MAX = 1024, COLUMNS_MAX = 128 };
    double w[ROWS_MAX];
    double dot[COLUMNS_MAX];
    for (int k = 0; k < columns && k < rows; k++) {
        double norm2 = 0;
        for (int i = k; i < rows; i++)
            norm2 += a[i * columns + k] * a[i * columns + k];
        const double norm = sqrt(norm2);
        if (norm < DEPENDENT) {
            a[k * columns + k] = 0;
            continue;
        }
        const double alpha = a[k * columns + k] > 0 ? -norm : norm;
        for (int i = k; i < rows; i++)
            w[i] = a[i * columns + k];
        w[k] -= alpha;
        const double beta = -1 / (alpha * w[k]); /* 2 / |w|^2 */
        reflect(w + k, beta, rows - k, a + k * columns, k + 1, columns, dot);
        reflect(w + k, beta, rows - k, b + k * sides, 0, sides, dot);
        a[k * columns + k] = alpha;
    }
}

void wo_qr_solve(const double *a, int stride, int count, const double *b, int sides, double *x)
{
    for (int k = count - 1; k >= 0; k--) {
        const double pivot = a[k * stride + k];
        for (int j = 0; j < sides; j++) {
            double sum = b[k * sides + j];
            for (int i = k + 1; i < count; i++)
                sum -= a[k * stride + i] * x[i * sides + j];
            x[k * sides + j] = pivot != 0 ? sum / pivot : 0;
        }
    }
}
