/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/pencil.h"

#include "optics/sampling.h"

#include <math.h>

static void thin_pencil(const void *self, double x, double y, unsigned set, int first,
                        wo_pencil_room *room, wo_pencil *out)
{
    (void)x;
    (void)y;
    (void)room;
    const wo_thin_pencils *p = self;
    const size_t n = (size_t)p->count;
    const float *rays = p->rays + 4 * n * set + first;
    const int left = p->count - first;
    *out = (wo_pencil){.count = left < WO_PENCIL_PIECE ? left : WO_PENCIL_PIECE,
                       .ax = rays,
                       .ay = rays + n,
                       .bx = rays + 2 * n,
                       .by = rays + 3 * n};
    for (int k = 0; k < 3 && p->weights; k++)
        out->weight[k] = p->weights + n * set + first;
}

static double thin_reach(const void *self, double v_far, double v_near)
{
    const wo_thin_pencils *p = self;
    const double r = fmax(wo_thin_lens_coc(&p->lens, v_far), wo_thin_lens_coc(&p->lens, v_near));
    return r * fmax(1, p->stretch);
}

static double thin_connect(const void *self, double dx, double dy, double v, double line[4])
{
    const wo_thin_pencils *p = self;
    const double k = p->lens.k;
    const double scale = k * (v - p->lens.vf);
    if (scale == 0)
        return 0;
    const double ux = dx / scale;
    const double uy = dy / (scale * p->stretch);
    const double density = wo_aperture_density(&p->shape, ux, uy);
    if (density == 0)
        return 0;
    line[2] = k * ux;
    line[3] = k * uy * p->stretch;
    line[0] = -line[2] * p->lens.vf;
    line[1] = -line[3] * p->lens.vf;
    return density / (scale * scale * p->stretch);
}

wo_status wo_thin_pencils_create(const wo_context *context, const wo_thin_lens *lens,
                                 const wo_aperture *aperture, double stretch, int count,
                                 uint32_t seed, wo_thin_pencils **pencils, wo_error *error)
{
    *pencils = NULL;
    WO_TRY(wo_aperture_validate(aperture, error));
    if (count < 1)
        return wo_fail(error, WO_ERR_RANGE, "%d samples: at least 1 is needed", count);
    wo_thin_pencils *p = wo_new(context, error, 1, sizeof *p);
    if (!p)
        return WO_ERR_NOMEM;
    p->lens = *lens;
    p->stretch = stretch;
    p->count = count;
    p->sets = wo_lattice_sets(count);
    wo_aperture_make(aperture, &p->shape);
    const size_t n = (size_t)count;
    p->rays = wo_new(context, error, (size_t)p->sets * n, 4 * sizeof *p->rays);
    if (p->rays && !p->shape.even)
        p->weights = wo_new(context, error, (size_t)p->sets * n, sizeof *p->weights);
    if (!p->rays || (!p->shape.even && !p->weights)) {
        wo_thin_pencils_destroy(context, &p);
        return WO_ERR_NOMEM;
    }
    for (unsigned set = 0; set < p->sets; set++) {
        float *rays = p->rays + 4 * n * set;
        for (size_t i = 0; i < n; i++) {
            double u[2];
            wo_lattice_point(seed, set, wo_lattice_order((int)i, count) + 0.5, count, 0, &p->shape,
                             u);
            const double bx = lens->k * u[0];
            const double by = lens->k * u[1] * stretch;
            rays[i] = (float)(-bx * lens->vf);
            rays[n + i] = (float)(-by * lens->vf);
            rays[2 * n + i] = (float)bx;
            rays[3 * n + i] = (float)by;
            if (p->weights)
                p->weights[n * set + i] =
                    (float)(wo_aperture_weight(&p->shape, u[0], u[1]) / p->shape.light);
        }
    }
    *pencils = p;
    return WO_OK;
}

void wo_thin_pencils_destroy(const wo_context *context, wo_thin_pencils **pencils)
{
    if (*pencils) {
        wo_delete(context, (*pencils)->rays);
        wo_delete(context, (*pencils)->weights);
    }
    wo_delete(context, *pencils);
    *pencils = NULL;
}

wo_lens wo_thin_pencils_lens(const wo_thin_pencils *pencils)
{
    return (wo_lens){.self = pencils,
                     .sets = pencils->sets,
                     .count = pencils->count,
                     .half = pencils->count / 2,
                     .pencil = thin_pencil,
                     .reach = thin_reach,
                     .px_per_dioptre = pencils->lens.k * fmax(1, pencils->stretch),
                     .connect = thin_connect};
}
