/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "lens_view_private.h"

#include <math.h>

#define PI 3.14159265358979323846

/* ----------------------------------------------------------------------------- one ray */

/* Rays of an object point, in the coordinates of a bundle; or from a point of the sensor, height mm
   from the axis, in those of the plane of the last vertex, against the light. */
typedef struct beam_of {
    const wo_lens_view *view;
    wo_meridian meridian;
    bool from_sensor;
    double field, height;
} beam_of;

/* From the sensor to the plane of its coordinates: the last vertex's, but for a sensor close to
   that. */
static double away_of(const wo_lens_view *view)
{
    const double semi = fmax(view->lens.surface[view->lens.count - 1].semi_aperture, 1e-3);
    return copysign(fmax(fabs(view->image), 0.05 * semi), view->image);
}

static void leave_sensor(const beam_of *b, double px, double py, double p[3], double d[3])
{
    const wo_lens_view *const view = b->view;
    const bool in_x = b->meridian == WO_MERIDIAN_X;
    const double away = away_of(view), way = away > 0 ? 1 : -1;
    const double sensor[3] = {in_x ? b->height : 0, in_x ? 0 : b->height, wo_lens_sensor_z(view)};
    const double length = hypot(hypot(px - sensor[0], py - sensor[1]), away);
    d[0] = way * (px - sensor[0]) / length;
    d[1] = way * (py - sensor[1]) / length;
    d[2] = -fabs(away) / length;
    /* A virtual image's rays begin at the last vertex. */
    const double t = view->image < 0 ? (view->system.z_last - sensor[2]) / d[2] : 0;
    for (int k = 0; k < 3; k++)
        p[k] = sensor[k] + t * d[k];
}

/* Whether the ray passes; where it crosses the iris, along and across; its squared cosine where it
   sets off. */
static bool probe(const beam_of *b, double along, double across, unsigned flags, double stop[2],
                  double *cos2)
{
    const bool in_x = b->meridian == WO_MERIDIAN_X;
    const double px = in_x ? along : across, py = in_x ? across : along;
    double p[3], d[3], x = NAN, y = NAN;
    uint8_t outcome = 0;
    if (b->from_sensor)
        leave_sensor(b, px, py, p, d);
    else
        wo_lens_aim_at(b->view, b->meridian, b->field, px, py, p, d);
    *cos2 = d[2] * d[2];
    const wo_system *const system = &b->view->system;
    const wo_rays rays = {&p[0], &p[1], &p[2], &d[0], &d[1], &d[2], NULL, &outcome};
    wo_system_trace(system, 0, system->count - 1, b->from_sensor, flags, &rays, 1, &x, &y);
    stop[0] = in_x ? x : y;
    stop[1] = in_x ? y : x;
    return outcome == WO_RAY_PASSED;
}

static const unsigned whole = WO_TRACE_CLIP | WO_TRACE_IRIS;

static bool passes(const beam_of *b, double along, double across)
{
    double stop[2], cos2;
    return probe(b, along, across, whole, stop, &cos2);
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

/* Begins with what passes in the meridian from low to high, and widens it where rays pass at the
   border. shape: how much wider the beam is across than along, about. */
static bool span_from(const beam_of *b, double low, double high, double shape, wo_lens_span *span)
{
    enum { TURNS = 8 };
    const double half = fmax((high - low) / 2, 1e-9);
    wo_lens_span s = {low - 0.1 * half, high + 0.1 * half, 1.2 * half * shape};
    bool touching[3] = {true, true, true}, any = false;
    *span = (wo_lens_span){0, 0, 0};
    for (int i = 0; i < TURNS; i++) {
        any = scan(b, &s, span, touching);
        if (!any || !(touching[0] || touching[1] || touching[2]))
            break;
        const double wide = (s.high - s.low) / 4;
        s.low -= touching[0] ? wide : 0;
        s.high += touching[1] ? wide : 0;
        s.across *= touching[2] ? 1.6 : 1;
    }
    return any;
}

bool wo_lens_find_span(const wo_lens_view *view, wo_meridian meridian, double field,
                       wo_lens_span *span)
{
    double low, high, chief;
    if (!wo_lens_fan(view, meridian, field, WO_TRACE_CLIP, &low, &high, &chief) &&
        !wo_lens_fan(view, meridian, field, 0, &low, &high, &chief))
        return false;
    const beam_of b = {.view = view, .meridian = meridian, .field = field};
    const bool in_x = meridian == WO_MERIDIAN_X;
    const double shape = view->first[in_x ? 1 : 0].ep_d / view->first[in_x ? 0 : 1].ep_d;
    return span_from(&b, low, high, isfinite(shape) ? fmax(1, shape) : 1, span);
}

/* Of every ray from the sensor point that meets the clear last surface, the largest coordinate. */
static double rear_reach(const beam_of *b)
{
    const wo_lens_view *const view = b->view;
    const wo_surface *const last = &view->lens.surface[view->lens.count - 1];
    double semi = last->semi_aperture;
    if (!(semi > 0)) {
        semi = isfinite(view->first[1].xp_d) ? view->first[1].xp_d / 2 : 0;
        for (int i = 0; i < view->lens.count; i++)
            semi = fmax(semi, view->lens.surface[i].semi_aperture);
        semi = 1.5 * semi + fabs(b->height);
    }
    const double sag = fabs(wo_lens_sag(last, b->meridian, semi));
    const double far = fabs(away_of(view));
    const double reach = 1.02 * semi + (isnan(sag) ? semi : sag) * (semi + fabs(b->height)) / far;
    return fmax(reach, fabs(b->height) + 3 * far * (far > fabs(view->image)));
}

static bool span_of_sensor(const beam_of *b, wo_lens_span *span)
{
    enum { PROBES = 801 };
    const double reach = rear_reach(b), step = 2 * reach / (PROBES - 1);
    double low = NAN, high = NAN;
    for (int i = 0; i < PROBES; i++) {
        const double along = -reach + step * i;
        if (!passes(b, along, 0))
            continue;
        low = isnan(low) ? along - step : low;
        high = along + step;
    }
    return !isnan(low) && span_from(b, low, high, 1, span);
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
    double light, iris;
} sums;

/* The part of a row between two borders. */
static void add_part(const beam_of *b, double across, double from, double to, double weight,
                     sums *sum)
{
    const double width = to - from, step = 1e-4 * width;
    for (int i = 0; i < NODES && width > 0; i++) {
        const double along = from + node[i] * width, part = weight * node_weight[i] * width;
        double here[2], a1[2], a2[2], c1[2], c2[2], cos2, ignored;
        const bool passed = probe(b, along, across, 0, here, &cos2) &&
                            probe(b, along - step, across, 0, a1, &ignored) &&
                            probe(b, along + step, across, 0, a2, &ignored) &&
                            probe(b, along, across - step, 0, c1, &ignored) &&
                            probe(b, along, across + step, 0, c2, &ignored);
        if (!passed)
            continue;
        const double jacobian =
            ((a2[0] - a1[0]) * (c2[1] - c1[1]) - (a2[1] - a1[1]) * (c2[0] - c1[0])) /
            (4 * step * step);
        sum->light += part * cos2 * cos2;
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

bool wo_lens_beam_make(const wo_lens_view *view, double height, wo_lens_beam *beam)
{
    const beam_of b = {
        .view = view, .meridian = view->across, .from_sensor = true, .height = height};
    wo_lens_span s;
    sums sum = {0, 0};
    *beam = (wo_lens_beam){0, 0};
    if (!isfinite(height) || !span_of_sensor(&b, &s))
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
    /* Solid angle times cosine: dA cos^4 / distance^2. */
    *beam = (wo_lens_beam){sum.light / (away_of(view) * away_of(view)), sum.iris};
    return sum.light > 0;
}
