/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "lens_view_private.h"

#include <math.h>
#include <stdlib.h>

static bool allocate(wo_bundle *bundle, int count)
{
    enum { ARRAYS = 10 };
    const size_t n = (size_t)count;
    double *const d = calloc(n, ARRAYS * sizeof *d + 1);
    *bundle = (wo_bundle){0};
    if (!d)
        return false;
    bundle->rays = (wo_rays){.x = d,
                             .y = d + n,
                             .z = d + 2 * n,
                             .dx = d + 3 * n,
                             .dy = d + 4 * n,
                             .dz = d + 5 * n,
                             .outcome = (uint8_t *)(d + ARRAYS * n)};
    bundle->px = d + 6 * n;
    bundle->py = d + 7 * n;
    bundle->stop_x = d + 8 * n;
    bundle->stop_y = d + 9 * n;
    bundle->count = count;
    return true;
}

void wo_bundle_free(wo_bundle *bundle)
{
    free(bundle->rays.x);
    *bundle = (wo_bundle){0};
}

/* -0.5..0.5, unlike its neighbours'. */
static double scramble(uint32_t x)
{
    x = (x ^ x >> 16) * 0x45d9f3bU;
    x = (x ^ x >> 16) * 0x45d9f3bU;
    return (double)(x ^ x >> 16) / 4294967296.0 - 0.5;
}

/* Additive recurrence with the plastic number, moved by up to half the distance of two rays: even,
   without rows that would show as moire. Pairs lie on both sides of the meridian, as the lens does.
 */
void wo_bundle_scatter(wo_bundle *bundle, wo_meridian meridian, int turn)
{
    const double w = bundle->x2 - bundle->x1, h = bundle->y2 - bundle->y1;
    const double apart = sqrt(2 * w * h / bundle->count);
    for (int i = 0; i < bundle->count; i++) {
        const int k = i / 2;
        const uint32_t number = 2 * (uint32_t)k + 0x9E3779B9U * (uint32_t)turn;
        const double u = 0.618034 * turn + 0.7548776662466927 * k + scramble(number) * apart / w;
        const double v =
            0.414214 * turn + 0.5698402909980532 * k + scramble(number + 1) * apart / h;
        bundle->px[i] = bundle->x1 + w * (u - floor(u));
        bundle->py[i] = bundle->y1 + h * (v - floor(v));
        if (i % 2 == 1 && meridian == WO_MERIDIAN_X)
            bundle->py[i] = -bundle->py[i];
        else if (i % 2 == 1)
            bundle->px[i] = -bundle->px[i];
    }
}

void wo_bundle_trace(const wo_lens_view *view, const wo_system *system, wo_meridian meridian,
                     double field, unsigned flags, wo_bundle *bundle)
{
    const wo_rays *const r = &bundle->rays;
    for (int i = 0; i < bundle->count; i++) {
        double p[3], d[3];
        wo_lens_aim_at(view, meridian, field, bundle->px[i], bundle->py[i], p, d);
        r->x[i] = p[0];
        r->y[i] = p[1];
        r->z[i] = p[2];
        r->dx[i] = d[0];
        r->dy[i] = d[1];
        r->dz[i] = d[2];
        bundle->stop_x[i] = bundle->stop_y[i] = NAN;
    }
    wo_system_trace(system, 0, system->count - 1, false, flags, r, bundle->count, bundle->stop_x,
                    bundle->stop_y);
}

bool wo_bundle_fill(const wo_lens_view *view, wo_meridian meridian, double field, int count,
                    wo_bundle *bundle)
{
    wo_lens_span s;
    *bundle = (wo_bundle){0};
    if (!wo_lens_find_span(view, meridian, field, &s) || !allocate(bundle, count))
        return false;
    const bool in_x = meridian == WO_MERIDIAN_X;
    bundle->x1 = in_x ? s.low : -s.across;
    bundle->x2 = in_x ? s.high : s.across;
    bundle->y1 = in_x ? -s.across : s.low;
    bundle->y2 = in_x ? s.across : s.high;
    bundle->area = (bundle->x2 - bundle->x1) * (bundle->y2 - bundle->y1) / count;
    wo_bundle_scatter(bundle, meridian, 0);
    return true;
}
