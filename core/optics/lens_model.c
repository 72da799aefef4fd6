/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/lens_model.h"

#include <math.h>
#include <string.h>

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

static void all_rays(const wo_lens_model *model, double h, const double *nm, int lines,
                     const double (*u)[2], int count, wo_model_ray *out)
{
    memset(out, 0, (size_t)lines * (size_t)count * sizeof *out);
    if (model->rays) {
        model->rays(model->self, h, nm, lines, u, count, out);
        return;
    }
    for (int i = 0; i < lines * count; i++)
        if (!model->ray(model->self, h, u[i % count], nm[i / count], &out[i]))
            out[i].weight = 0;
}

void wo_lens_model_rays(const wo_lens_model *model, double h, const double *nm, int lines,
                        const double (*u)[2], int count, wo_model_ray *out)
{
    all_rays(model, h, nm, lines, u, count, out);
    for (int i = 0; i < lines * count; i++)
        for (int k = 0; k < 2; k++)
            out[i].a[k] += out[i].b[k] * model->refocus;
}

bool wo_lens_model_ray(const wo_lens_model *model, double h, const double u[2], double nm,
                       wo_model_ray *ray)
{
    wo_lens_model_rays(model, h, &nm, 1, (const double(*)[2])u, 1, ray);
    return ray->weight > 0;
}

double wo_model_ray_clip(const wo_lens_model *model, const wo_model_ray *ray)
{
    double most = ray->weight > 0 ? 0 : INFINITY;
    for (int k = 0; k < model->clips; k++)
        most = fmax(most, ray->clip[k]);
    return most;
}

double wo_lens_model_best_focus(const wo_lens_model *model)
{
    enum { RINGS = 64 };
    double u[RINGS][2];
    wo_model_ray ray[RINGS];
    for (int i = 0; i < RINGS; i++) {
        u[i][0] = sqrt((i + 0.5) / RINGS);
        u[i][1] = 0;
    }
    all_rays(model, 0, &model->reference_nm, 1, (const double(*)[2])u, RINGS, ray);
    double ab = 0;
    double bb = 0;
    for (int i = 0; i < RINGS; i++) {
        ab += ray[i].weight * ray[i].a[0] * ray[i].b[0];
        bb += ray[i].weight * ray[i].b[0] * ray[i].b[0];
    }
    return bb > 0 ? -ab / bb : 0;
}
