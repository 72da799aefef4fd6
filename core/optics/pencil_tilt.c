/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/pencil_tilt.h"

#include <math.h>

/* 1 - b.B is 0.5 or more but for rounding. */
#define LEAST 0.25f

static void tilted_pencil(const void *self, double x, double y, unsigned set, int first,
                          wo_pencil_room *room, wo_pencil *out)
{
    const wo_tilted_pencils *p = self;
    wo_pencil in;
    p->inside->pencil(p->inside->self, x, y, set, first, room, &in);
    const float b0 = (float)p->b[0];
    const float b1 = (float)p->b[1];
    for (int i = 0; i < in.count; i++) {
        const float ax = in.ax[i];
        const float ay = in.ay[i];
        const float bx = in.bx[i];
        const float by = in.by[i];
        const float scale = 1 / fmaxf(1 - (b0 * bx + b1 * by), LEAST);
        const float along = (b0 * ax + b1 * ay) * scale;
        room->ax[i] = ax + bx * along;
        room->ay[i] = ay + by * along;
        room->bx[i] = bx * scale;
        room->by[i] = by * scale;
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
    return lens;
}

double wo_lens_slope(const wo_lens *lens)
{
    const double v = 0.01 / lens->px_per_dioptre;
    const double wide = lens->reach(lens->self, v, v) - lens->reach(lens->self, 0, 0);
    return fmax(wide / v, lens->px_per_dioptre);
}
