/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/aperture.h"

#include <math.h>

bool wo_aperture_cats_eye(double amount, double fx, double fy, double ux, double uy)
{
    const double dx = ux - amount * fx;
    const double dy = uy - amount * fy;
    return ux * ux + uy * uy <= 1 && dx * dx + dy * dy <= 1;
}

double wo_aperture_cats_eye_area(double amount, double fx, double fy)
{
    const double half = 0.5 * fabs(amount) * hypot(fx, fy);
    return half < 1 ? 2 * (acos(half) - half * sqrt(1 - half * half)) : 0;
}

bool wo_barn_doors_pass(const wo_barn_doors *doors, double fx, double fy, double ux, double uy)
{
    return ux + doors->right * fmax(fx, 0) <= 1 && -ux + doors->left * fmax(-fx, 0) <= 1 &&
           uy + doors->top * fmax(fy, 0) <= 1 && -uy + doors->bottom * fmax(-fy, 0) <= 1;
}
