/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/lens_table.h"

#include <math.h>

enum { POINTS = 256, HALVINGS = 6 };

#define GOLDEN_ANGLE 2.399963229728653

double wo_lens_ray_reach(const wo_lens_request *request, const wo_model_ray *ray)
{
    const double far =
        hypot(ray->a[0], ray->a[1]) + request->blur_dioptres * hypot(ray->b[0], ray->b[1]);
    return request->focal_px * far;
}

bool wo_lens_ray_counts(const wo_lens_model *model, const wo_lens_request *request,
                        const wo_model_ray *ray)
{
    return wo_model_ray_clip(model, ray) <= 1 && wo_lens_ray_reach(request, ray) <= request->max_px;
}

static double lit_part(const wo_lens_model *model, const wo_lens_request *request, double h)
{
    double u[POINTS][2];
    wo_model_ray ray[POINTS];
    for (int i = 0; i < POINTS; i++) {
        const double r = sqrt((i + 0.5) / POINTS);
        u[i][0] = r * cos(GOLDEN_ANGLE * i);
        u[i][1] = r * sin(GOLDEN_ANGLE * i);
    }
    wo_lens_model_rays(model, h, &model->reference_nm, 1, (const double(*)[2])u, POINTS, ray);
    int lit = 0;
    for (int i = 0; i < POINTS; i++)
        lit += wo_lens_ray_counts(model, request, &ray[i]);
    return (double)lit / POINTS;
}

typedef struct lit_job {
    const wo_lens_model *model;
    const wo_lens_request *request;
    wo_lens_lit *lit;
} lit_job;

static void lit_field(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const lit_job *job = user;
    const double h = job->lit->field * (double)index / (WO_LIT_FIELDS - 1);
    job->lit->part[index] = lit_part(job->model, job->request, h);
}

wo_status wo_lens_lit_measure(const wo_context *context, const wo_lens_model *model,
                              const wo_lens_request *request, wo_lens_lit *lit, wo_error *error)
{
    *lit = (wo_lens_lit){.field = model->field_max};
    lit_job job = {model, request, lit};
    wo_run(context, lit_field, &job, WO_LIT_FIELDS);
    int last = WO_LIT_FIELDS - 1;
    while (last >= 0 && lit->part[last] < WO_LIT_LEAST)
        last--;
    double step = lit->field / (WO_LIT_FIELDS - 1);
    double edge = lit->field * last / (WO_LIT_FIELDS - 1);
    for (int i = 0; i < HALVINGS && last >= 0 && last < WO_LIT_FIELDS - 1; i++) {
        step *= 0.5;
        if (lit_part(model, request, edge + step) >= WO_LIT_LEAST)
            edge += step;
    }
    if (!(edge > 0))
        return wo_fail(
            error, WO_ERR_UNSUPPORTED,
            "the lens lights nothing beyond %.3g degrees from its axis: its image circle "
            "is too small",
            last < 0 ? 0 : atan(edge) * 57.29577951308232);
    if (edge < lit->field) {
        lit->field = edge;
        wo_run(context, lit_field, &job, WO_LIT_FIELDS);
    }
    return WO_OK;
}

double wo_lens_lit_field(const wo_lens_lit *lit, double part)
{
    int last = WO_LIT_FIELDS - 1;
    while (last > 0 && lit->part[last] < part)
        last--;
    return lit->field * last / (WO_LIT_FIELDS - 1);
}

void wo_iris_place(int i, int count, double u[2])
{
    const double r = i % 4 == 0 ? 1 : sqrt((i + 0.5) / count);
    u[0] = r * cos(GOLDEN_ANGLE * i);
    u[1] = r * sin(GOLDEN_ANGLE * i);
}

void wo_lens_survey(const wo_lens_model *model, const wo_lens_request *request, double field,
                    double *colour_px, double *beyond)
{
    enum { FIELDS = 5, PLACES = 64 };
    double u[PLACES][2];
    wo_model_ray ray[WO_LINES_MAX][PLACES];
    int seen = 0;
    int far = 0;
    *colour_px = 0;
    for (int i = 0; i < PLACES; i++)
        wo_iris_place(i, PLACES, u[i]);
    for (int k = 0; k < FIELDS; k++) {
        const double h = field * k / (FIELDS - 1);
        for (int line = 0; line < request->lines; line++)
            wo_lens_model_rays(model, h, &request->nm[line], 1, (const double(*)[2])u, PLACES,
                               ray[line]);
        for (int line = 0; line < request->lines; line++)
            for (int i = 0; i < PLACES; i++) {
                const wo_model_ray *const first = &ray[0][i];
                const wo_model_ray *const r = &ray[line][i];
                const bool counts = wo_lens_ray_counts(model, request, r);
                const bool open = wo_model_ray_clip(model, r) <= 1;
                seen += open;
                far += open && !counts;
                const double da = hypot(r->a[0] - first->a[0], r->a[1] - first->a[1]);
                const double db = hypot(r->b[0] - first->b[0], r->b[1] - first->b[1]);
                if (counts && wo_lens_ray_counts(model, request, first))
                    *colour_px =
                        fmax(*colour_px, request->focal_px * (da + request->blur_dioptres * db));
            }
    }
    *beyond = seen > 0 ? (double)far / seen : 0;
}
