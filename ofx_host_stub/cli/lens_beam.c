/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "lens_view_private.h"

#include <math.h>

#define PI 3.14159265358979323846

/* ----------------------------------------------------------------------------- one ray */

typedef struct beam_of {
    const wo_lens_view *view;
    wo_meridian meridian;
    double field;
} beam_of;

/* A ray of the bundle, behind the lens, with where it crossed the iris and, seen along the meridian
   and across it, where it lands. */
typedef struct probe_ray {
    bool passed;
    double cos_in;  /* of its angle in front of the lens */
    double stop[2]; /* along, across */
    double landed[2];
} probe_ray;

static probe_ray probe(const beam_of *b, double along, double across, unsigned flags)
{
    const bool in_x = b->meridian == WO_MERIDIAN_X;
    double p[3], d[3], stop[2] = {NAN, NAN};
    uint8_t outcome = 0;
    wo_lens_aim_at(b->view, b->meridian, b->field, in_x ? along : across, in_x ? across : along, p,
                   d);
    probe_ray r = {.cos_in = d[2]};
    const wo_system *const system = &b->view->system;
    const wo_rays rays = {&p[0], &p[1], &p[2], &d[0], &d[1], &d[2], NULL, &outcome};
    wo_system_trace(system, 0, system->count - 1, false, flags, &rays, 1, &stop[0], &stop[1]);
    const double t = (wo_lens_sensor_z(b->view) - p[2]) / d[2];
    r.passed = outcome == WO_RAY_PASSED;
    for (int k = 0; k < 2; k++) {
        const int axis = (k == 0) == in_x ? 0 : 1;
        r.stop[k] = stop[axis];
        r.landed[k] = p[axis] + t * d[axis];
    }
    return r;
}

static const unsigned whole = WO_TRACE_CLIP | WO_TRACE_IRIS;

static bool passes(const beam_of *b, double along, double across)
{
    return probe(b, along, across, whole).passed;
}

/* ------------------------------------------------------------------------------- span */

enum { SIDE = 40 };

/* The passing places of a grid of half a span; touching: those that reach its border. */
static bool scan(const beam_of *b, const wo_lens_span *s, wo_lens_span *found, bool touching[3])
{
    const double step = (s->high - s->low) / SIDE, over = s->across / SIDE;
    bool any = false;
    touching[0] = touching[1] = touching[2] = false;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int column = i % SIDE, row = i / SIDE;
        const double along = s->low + step * (column + 0.5), across = over * (row + 0.5);
        if (!passes(b, along, across))
            continue;
        found->low = any ? fmin(found->low, along) : along;
        found->high = any ? fmax(found->high, along) : along;
        found->across = any ? fmax(found->across, across) : across;
        touching[0] = touching[0] || column == 0;
        touching[1] = touching[1] || column == SIDE - 1;
        touching[2] = touching[2] || row == SIDE - 1;
        any = true;
    }
    found->low -= step;
    found->high += step;
    found->across += over;
    return any;
}

/* Begins with what passes in the meridian, and widens it where rays pass at the border. */
bool wo_lens_find_span(const wo_lens_view *view, wo_meridian meridian, double field,
                       wo_lens_span *span)
{
    enum { TURNS = 8 };
    double low, high, chief;
    if (!wo_lens_fan(view, meridian, field, WO_TRACE_CLIP, &low, &high, &chief) &&
        !wo_lens_fan(view, meridian, field, 0, &low, &high, &chief))
        return false;
    const beam_of b = {view, meridian, field};
    const bool in_x = meridian == WO_MERIDIAN_X;
    const double shape = view->first[in_x ? 1 : 0].ep_d / view->first[in_x ? 0 : 1].ep_d;
    const double half = fmax((high - low) / 2, 1e-9);
    wo_lens_span s = {low - 0.1 * half, high + 0.1 * half,
                      1.2 * half * (isfinite(shape) ? fmax(1, shape) : 1)};
    *span = (wo_lens_span){0, 0, 0};
    bool touching[3] = {true, true, true}, any = false;
    for (int i = 0; i < TURNS; i++) {
        any = scan(&b, &s, span, touching);
        if (!any || !(touching[0] || touching[1] || touching[2]))
            break;
        const double wide = (s.high - s.low) / 4;
        s.low -= touching[0] ? wide : 0;
        s.high += touching[1] ? wide : 0;
        s.across *= touching[2] ? 1.6 : 1;
    }
    return any;
}

/* ------------------------------------------------------------------------------- beam */

enum { ROWS = 20, SAMPLES = 48, NODES = 6 };

/* Gauss and Legendre's, on 0..1. */
static const double node[NODES] = {0.033765242898423975, 0.16939530676686776, 0.38069040695840156,
                                   0.61930959304159849,  0.83060469323313224, 0.96623475710157603};
static const double node_weight[NODES] = {0.085662246189585178, 0.18038078652406930,
                                          0.23395696728634552,  0.23395696728634552,
                                          0.18038078652406930,  0.085662246189585178};

/* Where passing ends between a place that passes and one that does not. */
static double border(const beam_of *b, double across, double in, double out)
{
    for (int i = 0; i < 24; i++) {
        const double middle = (in + out) / 2;
        if (passes(b, middle, across))
            in = middle;
        else
            out = middle;
    }
    return in;
}

typedef struct sums {
    double flux, iris, moment;
} sums;

/* The part of a row between two borders. */
static void add_part(const beam_of *b, double across, double from, double to, double weight,
                     sums *sum)
{
    const double width = to - from, step = 1e-4 * width;
    for (int i = 0; i < NODES && width > 0; i++) {
        const double along = from + node[i] * width, part = weight * node_weight[i] * width;
        const probe_ray r = probe(b, along, across, 0);
        const probe_ray a1 = probe(b, along - step, across, 0);
        const probe_ray a2 = probe(b, along + step, across, 0);
        const probe_ray c1 = probe(b, along, across - step, 0);
        const probe_ray c2 = probe(b, along, across + step, 0);
        const double jacobian = ((a2.stop[0] - a1.stop[0]) * (c2.stop[1] - c1.stop[1]) -
                                 (a2.stop[1] - a1.stop[1]) * (c2.stop[0] - c1.stop[0])) /
                                (4 * step * step);
        const double c = r.cos_in * r.cos_in;
        const double light = part * (b->view->vf > 0 ? c * c : 1);
        if (!r.passed || !isfinite(jacobian))
            continue;
        sum->flux += light;
        sum->moment += light * r.landed[0];
        sum->iris += part * fabs(jacobian);
    }
}

static void add_row(const beam_of *b, const wo_lens_span *s, double across, double weight,
                    sums *sum)
{
    const double step = (s->high - s->low) / SAMPLES;
    bool before = false;
    double from = 0;
    for (int i = 0; i <= SAMPLES + 1; i++) {
        const double along = s->low + step * i;
        const bool now = i <= SAMPLES && passes(b, along, across);
        if (now && !before)
            from = border(b, across, along, along - step);
        else if (!now && before)
            add_part(b, across, from, border(b, across, along - step, along), weight, sum);
        before = now;
    }
}

static bool row_passes(const beam_of *b, const wo_lens_span *s, double across)
{
    for (int i = 0; i <= SAMPLES; i++)
        if (passes(b, s->low + (s->high - s->low) * i / SAMPLES, across))
            return true;
    return false;
}

bool wo_lens_beam_make(const wo_lens_view *view, double field, wo_lens_beam *beam)
{
    const beam_of b = {view, view->across, field};
    wo_lens_span s;
    sums sum = {0, 0, 0};
    *beam = (wo_lens_beam){0};
    if (!wo_lens_find_span(view, view->across, field, &s))
        return false;
    double in = 0, out = s.across;
    for (int i = 0; i < 14; i++) {
        const double middle = i == 0 ? s.across * (1 - 2.0 / SIDE) : (in + out) / 2;
        if (row_passes(&b, &s, middle))
            in = middle;
        else
            out = middle;
    }
    /* Rows at sines of even angles: close together where the beam ends. */
    for (int i = 0; i < ROWS; i++) {
        const double angle = (i + 0.5) / ROWS * (PI / 2);
        add_row(&b, &s, in * sin(angle), 2 * in * cos(angle) * (PI / 2) / ROWS, &sum);
    }
    *beam = (wo_lens_beam){sum.flux, sum.iris, sum.flux > 0 ? sum.moment / sum.flux : NAN};
    return sum.flux > 0;
}
