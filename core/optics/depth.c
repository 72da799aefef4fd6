/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/optics.h"

#include <math.h>

static double at_distance(double metres, bool *valid)
{
    if (!(metres > 0) || isinf(metres)) {
        *valid = false;
        return 0;
    }
    *valid = true;
    return fmin(1 / metres, WO_VERGENCE_MAX);
}

double wo_depth_vergence(const wo_depth_reading *reading, double sample, double cosine, bool *valid)
{
    switch (reading->mode) {
    case WO_DEPTH_INVERSE:
        *valid = sample >= 0 && !isinf(sample);
        return *valid ? fmin(sample * reading->scale, WO_VERGENCE_MAX) : 0;
    case WO_DEPTH_RAY:
        return at_distance(sample * cosine / reading->scale, valid);
    case WO_DEPTH_NORMALISED:
        if (!isfinite(sample)) {
            *valid = false;
            return 0;
        }
        sample = fmin(fmax(sample, 0), 1);
        return at_distance(reading->near_m + sample * (reading->far_m - reading->near_m), valid);
    case WO_DEPTH_NEGATIVE:
        return at_distance(-sample / reading->scale, valid);
    case WO_DEPTH_DISTANCE:
    case WO_DEPTH_MODE_COUNT:
        break;
    }
    return at_distance(sample / reading->scale, valid);
}
