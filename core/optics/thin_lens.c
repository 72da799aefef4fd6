/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/optics.h"

#include <math.h>

wo_status wo_thin_lens_make(double focal_mm, double sensor_mm, double f_stop, double focus_m,
                            bool breathing, double width_px, wo_thin_lens *lens, wo_error *error)
{
    *lens = (wo_thin_lens){0};
    if (!(focal_mm > 0 && focal_mm <= 1e6))
        return wo_fail(error, WO_ERR_RANGE, "focal length %g mm: must be above 0 mm", focal_mm);
    if (!(sensor_mm > 0 && sensor_mm <= 1e6))
        return wo_fail(error, WO_ERR_RANGE, "sensor width %g mm: must be above 0 mm", sensor_mm);
    if (!(f_stop > 0 && isfinite(f_stop)))
        return wo_fail(error, WO_ERR_RANGE, "f-number %g: must be above 0", f_stop);
    if (!isfinite(focus_m))
        return wo_fail(error, WO_ERR_RANGE, "focus distance %g m: must be finite; 0 is infinity",
                       focus_m);
    if (!(width_px > 0 && isfinite(width_px)))
        return wo_fail(error, WO_ERR_RANGE, "picture width %g px: must be above 0", width_px);
    const double focal_m = focal_mm * 1e-3;
    /* As for depths, nothing is nearer than WO_VERGENCE_MAX can say. */
    const double vf = focus_m != 0 ? fmin(fmax(1 / focus_m, -WO_VERGENCE_MAX), WO_VERGENCE_MAX) : 0;
    double image_m = focal_m;
    if (breathing) {
        if (!(vf * focal_m < 1))
            return wo_fail(error, WO_ERR_RANGE,
                           "focus distance %g m: with breathing it must be beyond the focal length "
                           "of %g mm",
                           focus_m, focal_mm);
        image_m = focal_m / (1 - vf * focal_m);
    }
    lens->vf = vf;
    lens->focal_px = width_px * image_m / (sensor_mm * 1e-3);
    lens->k = lens->focal_px * focal_m / (2 * f_stop);
    return WO_OK;
}

double wo_thin_lens_coc(const wo_thin_lens *lens, double v)
{
    return lens->k * fabs(v - lens->vf);
}
