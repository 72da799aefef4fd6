/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/pencil.h"

#include <math.h>

/* All sets together hold about this many rays, so that they stay in the cache. */
enum { RAYS_WANTED = 1 << 16, SETS_MIN = 16, SETS_MAX = 512 };

static void thin_pencil(const void *self, double x, double y, unsigned set, wo_pencil *out)
{
    (void)x;
    (void)y;
    const wo_thin_pencils *p = self;
    const size_t n = (size_t)p->count;
    const float *rays = p->rays + 4 * n * set;
    *out = (wo_pencil){p->count,     rays,         rays + n,
                       rays + 2 * n, rays + 3 * n, p->weights ? p->weights + n * set : NULL};
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
    const int sets = RAYS_WANTED / count;
    p->sets = (unsigned)(sets < SETS_MIN ? SETS_MIN : sets > SETS_MAX ? SETS_MAX : sets);
    wo_aperture_make(aperture, &p->shape);
    const size_t n = (size_t)count;
    p->rays = wo_new(context, error, (size_t)p->sets * n, 4 * sizeof *p->rays);
    if (p->rays && !p->shape.even)
        p->weights = wo_new(context, error, (size_t)p->sets * n, sizeof *p->weights);
    if (!p->rays || (!p->shape.even && !p->weights)) {
        wo_thin_pencils_destroy(context, &p);
        return WO_ERR_NOMEM;
    }
    /* The two-dimensional additive recurrence of the plastic number (Roberts 2018), one random
       shift for each set (Cranley and Patterson 1976). */
    for (unsigned set = 0; set < p->sets; set++) {
        const double shift_s = wo_hash(2 * set + 1 + 0x9e3779b9u * seed) * 0x1p-32;
        const double shift_t = wo_hash(2 * set + 2 + 0x85ebca6bu * seed) * 0x1p-32;
        float *rays = p->rays + 4 * n * set;
        for (size_t i = 0; i < n; i++) {
            double whole;
            double u[2];
            const double s = modf(shift_s + ((double)i + 0.5) / (double)n, &whole);
            const double t = modf(shift_t + (double)i * 0.6180339887498949, &whole);
            wo_aperture_sample(&p->shape, s, t, u);
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
                     .pencil = thin_pencil,
                     .reach = thin_reach,
                     .px_per_dioptre = pencils->lens.k * fmax(1, pencils->stretch),
                     .connect = thin_connect};
}
