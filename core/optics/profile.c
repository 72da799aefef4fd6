/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/lens_diagram.h"

#include <math.h>

double wo_profile_focal(double focal_m, double index, double index_at)
{
    return focal_m * (index - 1) / (index_at - 1);
}

double wo_profile_image(const wo_profile *profile, double v, double vf, double focal_at_m)
{
    const double power = 1 / profile->focal_m;
    if (!(vf < power))
        return INFINITY;
    return (1 / focal_at_m - v) / ((power - vf) * (power - profile->vergence));
}

double wo_profile_distance(const wo_profile *profile, double v, double vf, double focal_at_m)
{
    return v - vf - (1 / focal_at_m - 1 / profile->focal_m);
}
