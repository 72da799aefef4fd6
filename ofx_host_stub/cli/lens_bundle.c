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

typedef struct span {
    double x1, y1, x2, y2;
} span;

static void place_grid(wo_bundle *bundle, int columns, int rows, span s)
{
    for (int i = 0; i < bundle->count; i++) {
        bundle->px[i] = s.x1 + (s.x2 - s.x1) * (i % columns + 0.5) / columns;
        bundle->py[i] = s.y1 + (s.y2 - s.y1) * (i / columns + 0.5) / rows;
    }
}

/* Additive recurrence with the plastic number: even, without rows. */
void wo_bundle_scatter(wo_bundle *bundle, int turn)
{
    const double w = bundle->x2 - bundle->x1, h = bundle->y2 - bundle->y1;
    for (int i = 0; i < bundle->count; i++) {
        const double u = 0.618034 * turn + 0.7548776662466927 * i;
        const double v = 0.414214 * turn + 0.5698402909980532 * i;
        bundle->px[i] = bundle->x1 + w * (u - floor(u));
        bundle->py[i] = bundle->y1 + h * (v - floor(v));
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

/* Where a coarse grid begins: around what passes the iris in the meridian; across it, by the shape
   of the pupil. */
static bool guess_span(const wo_lens_view *view, wo_meridian meridian, double field, span *s)
{
    double low, high, chief;
    if (!wo_lens_fan(view, meridian, field, 0, &low, &high, &chief))
        return false;
    const bool in_x = meridian == WO_MERIDIAN_X;
    const double half = (high - low) / 2, middle = (high + low) / 2;
    const double shape = view->first[in_x ? 1 : 0].ep_d / view->first[in_x ? 0 : 1].ep_d;
    const double across = 1.8 * half * (isfinite(shape) ? fmax(1, shape) : 1);
    *s = in_x ? (span){middle - 1.2 * half, -across, middle + 1.2 * half, across}
              : (span){-across, middle - 1.2 * half, across, middle + 1.2 * half};
    return true;
}

/* The rectangle that the passing rays of a coarse grid fill, a step wider. */
static bool find_span(const wo_lens_view *view, wo_meridian meridian, double field, span *s)
{
    enum { SIDE = 56 };
    wo_bundle coarse;
    span all;
    if (!guess_span(view, meridian, field, &all))
        return false;
    const double step_x = (all.x2 - all.x1) / SIDE, step_y = (all.y2 - all.y1) / SIDE;
    bool found = false;
    if (!allocate(&coarse, SIDE * SIDE))
        return false;
    place_grid(&coarse, SIDE, SIDE, all);
    wo_bundle_trace(view, &view->system, meridian, field, WO_TRACE_CLIP | WO_TRACE_IRIS, &coarse);
    for (int i = 0; i < coarse.count; i++) {
        if (coarse.rays.outcome[i] != WO_RAY_PASSED)
            continue;
        const double x = coarse.px[i], y = coarse.py[i];
        *s = found ? (span){fmin(s->x1, x), fmin(s->y1, y), fmax(s->x2, x), fmax(s->y2, y)}
                   : (span){x, y, x, y};
        found = true;
    }
    wo_bundle_free(&coarse);
    *s = (span){s->x1 - step_x, s->y1 - step_y, s->x2 + step_x, s->y2 + step_y};
    return found;
}

bool wo_bundle_fill(const wo_lens_view *view, wo_meridian meridian, double field,
                    wo_lattice lattice, int count, wo_bundle *bundle)
{
    span s = {0, 0, 0, 0};
    *bundle = (wo_bundle){0};
    if (!find_span(view, meridian, field, &s))
        return false;
    const double w = s.x2 - s.x1, h = s.y2 - s.y1;
    const int columns = (int)fmax(1, ceil(sqrt(count * w / h)));
    const int rows = (int)fmax(1, ceil(columns * h / w));
    const bool grid = lattice == WO_LATTICE_GRID;
    if (!allocate(bundle, grid ? columns * rows : count))
        return false;
    bundle->x1 = s.x1;
    bundle->y1 = s.y1;
    bundle->x2 = s.x2;
    bundle->y2 = s.y2;
    if (grid)
        place_grid(bundle, columns, rows, s);
    else
        wo_bundle_scatter(bundle, 0);
    bundle->area = w * h / bundle->count;
    return true;
}
