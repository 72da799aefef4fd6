/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/pencil_tilt.h"

#include <math.h>

/* 1 - b.B is 0.5 or more but for rounding. */
#define LEAST 0.25f

/* One ray of the lens inside becomes one of the tilted lens. */
static void tilt_ray(const wo_tilted_pencils *p, float a[2], float b[2])
{
    const float b0 = (float)p->b[0];
    const float b1 = (float)p->b[1];
    const float scale = 1 / fmaxf(1 - (b0 * b[0] + b1 * b[1]), LEAST);
    const float along = (b0 * a[0] + b1 * a[1]) * scale;
    for (int k = 0; k < 2; k++) {
        a[k] += b[k] * along;
        b[k] *= scale;
    }
}

static void tilted_iris_rays(const void *self, double x, double y, int line, const float *s,
                             const float *t, int count, const wo_iris_rays *out)
{
    const wo_tilted_pencils *p = self;
    p->inside->iris.rays(p->inside->self, x, y, line, s, t, count, out);
    for (int i = 0; i < count; i++) {
        float a[2] = {out->ax[i], out->ay[i]};
        float b[2] = {out->bx[i], out->by[i]};
        tilt_ray(p, a, b);
        out->ax[i] = a[0];
        out->ay[i] = a[1];
        out->bx[i] = b[0];
        out->by[i] = b[1];
    }
}

static void tilted_pencil(const void *self, double x, double y, unsigned set, int first,
                          wo_pencil_room *room, wo_pencil *out)
{
    const wo_tilted_pencils *p = self;
    wo_pencil in;
    p->inside->pencil(p->inside->self, x, y, set, first, room, &in);
    for (int i = 0; i < in.count; i++) {
        float a[2] = {in.ax[i], in.ay[i]};
        float b[2] = {in.bx[i], in.by[i]};
        tilt_ray(p, a, b);
        room->ax[i] = a[0];
        room->ay[i] = a[1];
        room->bx[i] = b[0];
        room->by[i] = b[1];
    }
    *out = in;
    out->ax = room->ax;
    out->ay = room->ay;
    out->bx = room->bx;
    out->by = room->by;
}

static double tilted_reach(const void *self, double v_far, double v_near)
{
    const wo_tilted_pencils *p = self;
    return p->inside->reach(p->inside->self, v_far, v_near) / (1 - p->slope);
}

/* Rays of the lens inside that cross at d do so at the vergence w + b.d from their focus; their
   density at one w is 1 - b.B times that at one v. */
static double tilted_connect(const void *self, double dx, double dy, double w, double line[4])
{
    const wo_tilted_pencils *p = self;
    const double v = w + p->b[0] * dx + p->b[1] * dy;
    const double density = p->inside->connect(p->inside->self, dx, dy, v, line);
    if (!(density > 0))
        return 0;
    const double part = 1 - (p->b[0] * line[2] + p->b[1] * line[3]);
    if (!(part > 0))
        return 0;
    const double along = (p->b[0] * line[0] + p->b[1] * line[1]) / part;
    line[0] += line[2] * along;
    line[1] += line[3] * along;
    line[2] /= part;
    line[3] /= part;
    return density * part;
}

wo_lens wo_tilted_pencils_lens(const wo_tilted_pencils *tilted)
{
    wo_lens lens = *tilted->inside;
    lens.self = tilted;
    lens.pencil = tilted_pencil;
    lens.reach = tilted_reach;
    if (lens.connect)
        lens.connect = tilted_connect;
    if (lens.iris.rays)
        lens.iris.rays = tilted_iris_rays;
    return lens;
}

double wo_lens_slope(const wo_lens *lens)
{
    const double v = 0.01 / lens->px_per_dioptre;
    const double wide = lens->reach(lens->self, v, v) - lens->reach(lens->self, 0, 0);
    return fmax(wide / v, lens->px_per_dioptre);
}
