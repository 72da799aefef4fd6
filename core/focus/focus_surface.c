/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "focus/focus_surface.h"

#include <math.h>
#include <stddef.h>

/* Directions in which the points of a plane are spread by less than this part of the others do not
   tilt it, as a variance; nor does a spread below this length squared. */
#define THIN  1e-4
#define POINT 1e-8
/* Of the moving fit: the same, against the distance from the points; and the softening. */
#define REACH 1e-2
#define SOFT2 2.5e-3

/* Weighted sums about the mean. */
typedef struct moments {
    double weight, x, y, v;
    double xx, xy, yy, xv, yv;
} moments;

/* weight: in place of the points' own. */
static moments about_mean(const wo_focus_point *points, const double *weight, int count)
{
    moments m = {0};
    for (int i = 0; i < count; i++) {
        const double w = weight ? weight[i] : points[i].weight;
        m.weight += w;
        m.x += w * points[i].x;
        m.y += w * points[i].y;
        m.v += w * points[i].v;
    }
    if (!(m.weight > 0))
        return m;
    m.x /= m.weight;
    m.y /= m.weight;
    m.v /= m.weight;
    for (int i = 0; i < count; i++) {
        const double w = (weight ? weight[i] : points[i].weight) / m.weight;
        const double x = points[i].x - m.x;
        const double y = points[i].y - m.y;
        m.xx += w * x * x;
        m.xy += w * x * y;
        m.yy += w * y * y;
        m.xv += w * x * (points[i].v - m.v);
        m.yv += w * y * (points[i].v - m.v);
    }
    return m;
}

/* Slope with Tikhonov's filter: variances far above least count fully, those below fade out. */
static void slope(const moments *m, double least, double *gx, double *gy)
{
    const double a = m->xx * m->xx + m->xy * m->xy + least * least;
    const double b = m->xy * (m->xx + m->yy);
    const double c = m->xy * m->xy + m->yy * m->yy + least * least;
    const double p = m->xx * m->xv + m->xy * m->yv;
    const double q = m->xy * m->xv + m->yy * m->yv;
    const double det = a * c - b * b;
    *gx = det > 0 ? (c * p - b * q) / det : 0;
    *gy = det > 0 ? (a * q - b * p) / det : 0;
}

bool wo_focus_plane_fit(const wo_focus_point *points, int count, wo_focus_plane *plane)
{
    const moments m = about_mean(points, NULL, count);
    *plane = (wo_focus_plane){0};
    if (!(m.weight > 0))
        return false;
    slope(&m, THIN * (m.xx + m.yy) + POINT, &plane->gx, &plane->gy);
    plane->v = m.v - plane->gx * m.x - plane->gy * m.y;
    return true;
}

/* r2^(-falloff/2); whole powers without pow. */
static double fall(double r2, double falloff)
{
    const int whole = (int)falloff;
    if (falloff != whole)
        return pow(r2, -0.5 * falloff);
    double power = whole & 1 ? sqrt(r2) : 1;
    for (int i = whole >> 1; i > 0; i--)
        power *= r2;
    return 1 / power;
}

bool wo_focus_surface_at(const wo_focus_point *points, int count, double falloff, double x,
                         double y, double *v, double *dof)
{
    double r2[WO_FOCUS_POINTS];
    double soft[WO_FOCUS_POINTS];
    double nearest = INFINITY;
    for (int i = 0; i < count; i++) {
        const double dx = points[i].x - x;
        const double dy = points[i].y - y;
        r2[i] = dx * dx + dy * dy;
        if (points[i].weight > 0)
            nearest = fmin(nearest, r2[i]);
    }
    if (nearest == INFINITY)
        return false;
    double far2 = 0;
    double softened = 0;
    double sum = 0;
    double mx = 0, my = 0, mv = 0, md = 0;
    for (int i = 0; i < count; i++) {
        const wo_focus_point *p = &points[i];
        soft[i] =
            p->weight > 0 ? p->weight * fall((r2[i] + SOFT2) / (nearest + SOFT2), falloff) : 0;
        softened += soft[i];
        far2 += soft[i] * r2[i];
        double w = 0;
        if (p->weight > 0)
            w = nearest > 0  ? p->weight * fall(r2[i] / nearest, falloff)
                : r2[i] == 0 ? p->weight
                             : 0;
        sum += w;
        mx += w * (x - p->x);
        my += w * (y - p->y);
        mv += w * p->v;
        md += w * p->dof;
    }
    const moments m = about_mean(points, soft, count);
    double gx, gy;
    slope(&m, REACH * far2 / softened + POINT, &gx, &gy);
    *v = (mv + gx * mx + gy * my) / sum;
    *dof = md / sum;
    return true;
}

static void sort_by_vergence(wo_focus_point *samples, int count)
{
    for (int i = 1; i < count; i++) {
        const wo_focus_point moved = samples[i];
        int to = i;
        for (; to > 0 && samples[to - 1].v > moved.v; to--)
            samples[to] = samples[to - 1];
        samples[to] = moved;
    }
}

double wo_focus_pick(wo_focus_point *samples, int count)
{
    sort_by_vergence(samples, count);
    const int half = count / 2 + 1;
    int first = 0;
    for (int i = 1; i + half <= count; i++)
        if (samples[i + half - 1].v - samples[i].v <=
            samples[first + half - 1].v - samples[first].v)
            first = i;
    const double low = samples[first].v;
    const double high = samples[first + half - 1].v;
    const double from = low - (high - low);
    const double to = high + (high - low);
    int begin = first;
    int end = first + half;
    while (begin > 0 && samples[begin - 1].v >= from)
        begin--;
    while (end < count && samples[end].v <= to)
        end++;
    wo_focus_plane plane;
    (void)wo_focus_plane_fit(samples + begin, end - begin, &plane);
    return fmin(fmax(plane.v, from), to);
}
