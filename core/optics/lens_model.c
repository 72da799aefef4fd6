/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/lens_model.h"

#include <math.h>

wo_status wo_lens_model_check(const wo_prescription *lens, wo_error *error)
{
    WO_TRY(wo_prescription_validate(lens, error));
    for (int i = 0; i < lens->count; i++)
        if (lens->surface[i].meridian != WO_MERIDIAN_BOTH)
            return wo_fail(error, WO_ERR_UNSUPPORTED,
                           "%s has cylinders (surface %d): only lenses of revolution can be put "
                           "behind a picture",
                           lens->name, i + 1);
    return WO_OK;
}

bool wo_lens_model_ray(const wo_lens_model *model, double h, const double u[2], double nm,
                       wo_model_ray *ray)
{
    if (!model->ray(model->self, h, u, nm, ray))
        return false;
    for (int k = 0; k < 2; k++)
        ray->a[k] += ray->b[k] * model->refocus;
    return true;
}

double wo_lens_model_best_focus(const wo_lens_model *model)
{
    enum { RINGS = 64 };
    double ab = 0;
    double bb = 0;
    for (int i = 0; i < RINGS; i++) {
        const double u[2] = {sqrt((i + 0.5) / RINGS), 0};
        wo_model_ray ray = {.weight = 0};
        if (!model->ray(model->self, 0, u, model->reference_nm, &ray))
            continue;
        ab += ray.weight * ray.a[0] * ray.b[0];
        bb += ray.weight * ray.b[0] * ray.b[0];
    }
    return bb > 0 ? -ab / bb : 0;
}
