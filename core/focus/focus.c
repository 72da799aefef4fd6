/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "focus/focus.h"

#include "wideopen/optics.h"

#include <math.h>

/* px of blur, at most, that keep the order of surfaces which are equally sharp. */
#define ORDER_PX 0.02

static double half_diagonal(const wo_focus_options *o)
{
    return 0.5 * hypot(wo_rect_width(o->format), wo_rect_height(o->format) / o->stretch);
}

void wo_focus_place(const wo_focus_options *o, double px, double py, wo_focus_point *point)
{
    const double unit = half_diagonal(o);
    point->x = (px - 0.5 * ((double)o->format.x1 + o->format.x2)) / unit;
    point->y = (py - 0.5 * ((double)o->format.y1 + o->format.y2)) / (unit * o->stretch);
}

double wo_focus_presence(const wo_focus_options *o, double px, double py, double fade)
{
    const double dx = fmax(fmax(o->format.x1 - px, px - o->format.x2), 0);
    const double dy = fmax(fmax(o->format.y1 - py, py - o->format.y2), 0) / o->stretch;
    const double outside = hypot(dx, dy) / half_diagonal(o);
    if (outside == 0)
        return 1;
    if (!(outside < fade))
        return 0;
    const double t = outside / fade;
    return 1 - t * t * (3 - 2 * t);
}

/* The points together are there as far as the one that is there most, smoothly. */
static double presence_of(const wo_focus_options *o)
{
    double absent = 1;
    for (int i = 0; i < o->count; i++)
        if (o->points[i].weight > 0)
            absent *= 1 - o->presence[i];
    return 1 - absent;
}

/* Vergence in focus and amount at a place in units of half the diagonal. */
static double surface(const wo_focus *f, double x, double y, double *amount)
{
    const wo_focus_options *o = &f->options;
    double v = o->vf;
    double dof = 1;
    *amount = 1;
    if (f->presence > 0) {
        if (o->by != WO_FOCUS_BY_PLANE || f->amounts)
            (void)wo_focus_surface_at(o->points, o->count, o->falloff, x, y, &v, &dof);
        if (o->by == WO_FOCUS_BY_PLANE)
            v = f->plane.v + f->plane.gx * x + f->plane.gy * y;
        v = o->vf + f->presence * (v - o->vf);
        *amount = 1 + f->presence * (dof - 1);
    }
    return v + o->curvature * (x * x + y * y);
}

void wo_focus_make(const wo_focus_options *options, wo_focus *focus)
{
    *focus = (wo_focus){.options = *options};
    wo_focus_options *o = &focus->options;
    focus->half_diagonal = half_diagonal(o);
    focus->centre_x = 0.5 * ((double)o->format.x1 + o->format.x2);
    focus->centre_y = 0.5 * ((double)o->format.y1 + o->format.y2);
    if (o->by == WO_FOCUS_BY_DISTANCE)
        o->count = 0;
    if (o->by == WO_FOCUS_BY_POINT && o->count > 1)
        o->count = 1;
    if (!o->map.data)
        o->map_is = WO_FOCUS_MAP_OFF;
    focus->presence = presence_of(o);
    for (int i = 0; i < o->count; i++)
        focus->amounts |= o->points[i].weight > 0 && o->points[i].dof != 1;
    focus->ordered = focus->amounts || o->protect_near > 0 || o->protect_far > 0 ||
                     o->near_gain != 1 || o->far_gain != 1;
    focus->flat = !focus->ordered && o->curvature == 0 && o->map_is == WO_FOCUS_MAP_OFF &&
                  (o->by == WO_FOCUS_BY_DISTANCE || o->by == WO_FOCUS_BY_POINT);
    if (o->by == WO_FOCUS_BY_PLANE && o->map_is == WO_FOCUS_MAP_OFF &&
        wo_focus_plane_fit(o->points, o->count, &focus->plane)) {
        focus->tilt[0] = focus->presence * focus->plane.gx / focus->half_diagonal;
        focus->tilt[1] = focus->presence * focus->plane.gy / (focus->half_diagonal * o->stretch);
    }
    double amount;
    focus->v_axis = surface(focus, 0, 0, &amount);
}

void wo_focus_fit_lens(wo_focus *focus, double k, double slope)
{
    focus->k = k;
    focus->tilt_asked = slope * hypot(focus->tilt[0], focus->tilt[1]);
    focus->tilt_slope = fmin(focus->tilt_asked, WO_FOCUS_TILT_MAX);
    if (focus->tilt_asked > WO_FOCUS_TILT_MAX) {
        const double part = WO_FOCUS_TILT_MAX / focus->tilt_asked;
        focus->plane.gx *= part;
        focus->plane.gy *= part;
        focus->tilt[0] *= part;
        focus->tilt[1] *= part;
    }
}

double wo_focus_at(const wo_focus *focus, int32_t x, int32_t y, double *amount)
{
    return surface(focus, (x + 0.5 - focus->centre_x) / focus->half_diagonal,
                   (y + 0.5 - focus->centre_y) / (focus->half_diagonal * focus->options.stretch),
                   amount);
}

static float map_at(const wo_image *map, int32_t x, int32_t y)
{
    const wo_rect b = map->bounds;
    x = x < b.x1 ? b.x1 : x >= b.x2 ? b.x2 - 1 : x;
    y = y < b.y1 ? b.y1 : y >= b.y2 ? b.y2 - 1 : y;
    return wo_image_at(map, x, y)[0];
}

/* What is in focus: the map's word, if it is one, else the surface's. */
static double in_focus(const wo_focus *focus, int32_t x, int32_t y, double *amount)
{
    const wo_focus_options *o = &focus->options;
    if (o->map_is == WO_FOCUS_MAP_OFF)
        return wo_focus_at(focus, x, y, amount);
    const double sample = (double)map_at(&o->map, x, y);
    *amount = 1;
    double vf = o->vf;
    if (o->map_is == WO_FOCUS_MAP_VERGENCE && isfinite(sample))
        vf = sample;
    if (o->map_is == WO_FOCUS_MAP_DISTANCE && sample > 0 && isfinite(sample))
        vf = 1 / sample;
    return fmin(fmax(vf, -WO_VERGENCE_MAX), WO_VERGENCE_MAX);
}

/* Counts from the borders of the zone that stays sharp. Distances before and behind vf become
   vergences without going through infinity: 1 / (1 / vf -+ m) - vf. */
static double zone(const wo_focus_options *o, double vf, double w)
{
    if (!(vf > 0))
        return w;
    const double reach = vf * (w > 0 ? o->protect_near : o->protect_far);
    if (w > 0)
        return reach < 1 ? fmax(w - vf * reach / (1 - reach), 0) : 0;
    return fmin(w + vf * reach / (1 + reach), 0);
}

double wo_focus_from(const wo_focus *focus, int32_t x, int32_t y, double v)
{
    const wo_focus_options *o = &focus->options;
    if (focus->flat)
        return v - focus->v_axis;
    double amount = 1;
    double w;
    double asked; /* in the right order */
    if (o->map_is == WO_FOCUS_MAP_RADIUS) {
        const double radius = (double)map_at(&o->map, x, y) * o->map_scale;
        w = isfinite(radius) ? radius / focus->k : 0;
        asked = w;
    } else {
        const double vf = in_focus(focus, x, y, &amount);
        asked = v - vf;
        w = zone(o, vf, asked);
    }
    w *= amount * (w > 0 ? o->near_gain : o->far_gain);
    if (focus->ordered)
        w += ORDER_PX * asked / (1 + focus->k * fabs(asked));
    return w;
}
