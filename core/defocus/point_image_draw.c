/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/point_image_private.h"

#include <math.h>
#include <string.h>

/* Triangles of less area are lines, whose light goes to the pixels under them. px^2 */
#define THIN_PX2 1e-3
/* Less light than this part of the point's is what is left of running sums. */
#define LIGHT_LEAST 1e-10

/* A corner of a triangle, or between two of them; px, pixel 0 is 0..1. */
typedef struct corner {
    double x, y;
} corner;

/* Sums that are drawn into: differences along each row, whose running sums are the picture. */
typedef struct canvas {
    double *sums; /* [rows][width + 2][channels] */
    wo_rect rect; /* of the rows */
    ptrdiff_t width;
} canvas;

/* Channels: colours; then for each kind of rays its light and that times b. */
enum { KIND = 3, CHANNELS_MAX = 3 + 2 * KIND };

/* Of numbers that are none of them NaN. */
static inline double least(double a, double b)
{
    return a < b ? a : b;
}

static inline double most(double a, double b)
{
    return a > b ? a : b;
}

static inline void add(double *to, const double *value, double times, int channels)
{
    for (int k = 0; k < channels; k++)
        to[k] += value[k] * times;
}

/* What lies right of the edge from (x0, y0) to (x1, y1) gets value, times how much of its height
   the edge passes: less it when the edge goes up. */
static inline void draw_edge(const canvas *c, corner from, corner to_corner, const double *value,
                             int channels)
{
    const bool up = to_corner.y > from.y;
    const double sign = up ? -1 : 1;
    const corner low = up ? from : to_corner;
    const corner high = up ? to_corner : from;
    const double x0 = low.x - c->rect.x1;
    const double y0 = low.y - c->rect.y1;
    const double x1 = high.x - c->rect.x1;
    const double y1 = high.y - c->rect.y1;
    const double rows = wo_rect_height(c->rect);
    if (!(y1 > 0 && y0 < rows && y1 > y0))
        return;
    const double slope = (x1 - x0) / (y1 - y0);
    const double end = least(y1, rows);
    double y = most(y0, 0);
    double x = x0 + (y - y0) * slope;
    for (int32_t row = (int32_t)y; row < end; row++) {
        const double y_next = least(row + 1.0, end);
        const double x_next = y_next == y1 ? x1 : x0 + (y_next - y0) * slope;
        double *to = c->sums + row * c->width * channels;
        const double left = least(x, x_next);
        const double right = most(x, x_next);
        const double tall = sign * (y_next - y);
        int32_t column = (int32_t)left;
        if (right <= column + 1.0) {
            const double inside = 0.5 * (left + right) - column;
            add(to + column * channels, value, tall * (1 - inside), channels);
            add(to + (column + 1) * channels, value, tall * inside, channels);
        } else {
            const double a_px = tall / (right - left);
            for (double at = left; at < right; column++) {
                const double next = least(column + 1.0, right);
                const double inside = 0.5 * (at + next) - column;
                add(to + column * channels, value, a_px * (next - at) * (1 - inside), channels);
                add(to + (column + 1) * channels, value, a_px * (next - at) * inside, channels);
                at = next;
            }
        }
        y = y_next;
        x = x_next;
    }
}

/* One wavelength being drawn. */
typedef struct drawing {
    const wo_point_image *image;
    canvas to;
    const float *x, *y, *bx, *by, *light, *clip;
    const double *colour;
    double mean;     /* of the colours */
    float low, high; /* y of nodes that touch the rows */
} drawing;

static inline corner corner_at(const drawing *d, int i)
{
    return (corner){(double)d->x[i] + 0.5, (double)d->y[i] + 0.5};
}

/* What a triangle sends: light, and to its kind of rays that times its mean ray. */
static inline void send(const drawing *d, const int at[3], double light, bool mirrored, int colours,
                        bool rays, double *value)
{
    for (int k = 0; k < colours; k++)
        value[k] = light * d->colour[k];
    if (!rays)
        return;
    for (int k = 0; k < 2 * KIND; k++)
        value[colours + k] = 0;
    double *const to = value + colours + (mirrored ? KIND : 0);
    to[0] = light * d->mean;
    to[1] = to[0] / 3 * (double)(d->bx[at[0]] + d->bx[at[1]] + d->bx[at[2]]);
    to[2] = to[0] / 3 * (double)(d->by[at[0]] + d->by[at[1]] + d->by[at[2]]);
}

/* A thin triangle is a line from its first to its farthest corner. */
static void draw_thin(const canvas *c, const corner p[3], const double *value, int channels)
{
    int a = 0;
    int b = 1;
    double longest = 0;
    for (int k = 0; k < 3; k++) {
        const int n = (k + 1) % 3;
        const double length = hypot(p[n].x - p[k].x, p[n].y - p[k].y);
        if (length > longest) {
            longest = length;
            a = k;
            b = n;
        }
    }
    const int pieces = (int)ceil(2 * longest) + 1;
    for (int i = 0; i < pieces; i++) {
        const double part = (i + 0.5) / pieces;
        const int32_t x = (int32_t)floor(p[a].x + part * (p[b].x - p[a].x));
        const int32_t y = (int32_t)floor(p[a].y + part * (p[b].y - p[a].y));
        if (y < c->rect.y1 || y >= c->rect.y2)
            continue;
        double *to = c->sums + ((y - c->rect.y1) * c->width + x - c->rect.x1) * channels;
        add(to, value, 1.0 / pieces, channels);
        add(to + channels, value, -1.0 / pieces, channels);
    }
}

/* The part of a triangle where the clip, linear between the corners, is no more than 1. */
static int open_polygon(const drawing *d, const int at[3], corner out[4])
{
    int n = 0;
    for (int k = 0; k < 3; k++) {
        const int i = at[k];
        const int j = at[(k + 1) % 3];
        const double ci = (double)d->clip[i];
        const double cj = (double)d->clip[j];
        const corner p = corner_at(d, i);
        const corner q = corner_at(d, j);
        if (ci <= 1)
            out[n++] = p;
        if ((ci <= 1) != (cj <= 1)) {
            const double part = (1 - ci) / (cj - ci);
            out[n++] = (corner){rint((p.x + part * (q.x - p.x)) / WO_PLACE_PX) * WO_PLACE_PX,
                                rint((p.y + part * (q.y - p.y)) / WO_PLACE_PX) * WO_PLACE_PX};
        }
    }
    return n;
}

/* Light per area of a triangle, for its edges; all 0 when it was drawn at once. */
static inline void triangle(const drawing *d, int ring, int spoke, int kind, int colours, bool rays,
                            double *value)
{
    const int channels = colours + (rays ? 2 * KIND : 0);
    const wo_iris_grid *g = d->image->grid;
    int at[3];
    wo_cell_corners(g, ring, spoke, kind, at);
    memset(value, 0, (size_t)channels * sizeof *value);
    const float y0 = d->y[at[0]];
    const float y1 = d->y[at[1]];
    const float y2 = d->y[at[2]];
    if ((y0 < d->low && y1 < d->low && y2 < d->low) ||
        (y0 > d->high && y1 > d->high && y2 > d->high))
        return;
    const int open = (d->clip[at[0]] <= 1) + (d->clip[at[1]] <= 1) + (d->clip[at[2]] <= 1);
    const double share = (double)g->light[2 * (ring * g->spokes + spoke) + kind];
    if (open == 0 || !(share > 0))
        return;
    const corner p[3] = {corner_at(d, at[0]), corner_at(d, at[1]), corner_at(d, at[2])};
    const double light = share / 3 * (double)(d->light[at[0]] + d->light[at[1]] + d->light[at[2]]);
    const double area =
        0.5 * ((p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x));
    double sent[CHANNELS_MAX];
    if (fabs(area) < THIN_PX2) {
        const double part =
            wo_open_part((double)d->clip[at[0]], (double)d->clip[at[1]], (double)d->clip[at[2]]);
        send(d, at, light * part, area < 0, colours, rays, sent);
        draw_thin(&d->to, p, sent, channels);
        return;
    }
    send(d, at, light / area, area < 0, colours, rays, sent);
    if (open == 3) {
        memcpy(value, sent, (size_t)channels * sizeof *value);
        return;
    }
    corner polygon[4];
    const int n = open_polygon(d, at, polygon);
    for (int k = 0; k < n; k++)
        draw_edge(&d->to, polygon[k], polygon[(k + 1) % n], sent, channels);
}

static inline void shared_edge(const drawing *d, int from, int to, const double *left,
                               const double *right, int channels)
{
    if ((d->y[from] < d->low && d->y[to] < d->low) || (d->y[from] > d->high && d->y[to] > d->high))
        return;
    double value[CHANNELS_MAX];
    double most = 0;
    for (int k = 0; k < channels; k++) {
        value[k] = left[k] - right[k];
        most += fabs(value[k]);
    }
    if (most == 0)
        return;
    draw_edge(&d->to, corner_at(d, from), corner_at(d, to), value, channels);
}

/* Every edge is drawn once, with the difference between its two triangles. room: three rows of
   densities. */
static inline void draw_line(const drawing *d, int colours, bool rays, double *room)
{
    const wo_iris_grid *g = d->image->grid;
    const int channels = colours + (rays ? 2 * KIND : 0);
    const int n = g->spokes;
    const size_t row = (size_t)n * (size_t)channels;
    double *below = room;       /* outer triangles of the ring before */
    double *outer = room + row; /* of this ring */
    double *inner = room + 2 * row;
    memset(below, 0, row * sizeof *below);
    memset(inner, 0, row * sizeof *inner);
    for (int i = 0; i <= g->rings; i++) {
        for (int j = 0; j < n; j++) {
            double *const o = outer + j * channels;
            double *const in = inner + j * channels;
            if (i < g->rings) {
                triangle(d, i, j, 0, colours, rays, o);
                triangle(d, i, j, 1, colours, rays, in);
            } else {
                memset(in, 0, (size_t)channels * sizeof *in);
            }
        }
        for (int j = 0; j < n; j++) {
            const int next = j + 1 < n ? j + 1 : 0;
            const int before = j > 0 ? j - 1 : n - 1;
            const int at = i * n + j;
            shared_edge(d, at, i * n + next, below + j * channels, inner + j * channels, channels);
            if (i == g->rings)
                continue;
            shared_edge(d, at, at + n, outer + j * channels, inner + before * channels, channels);
            shared_edge(d, at, (i + 1) * n + next, inner + j * channels, outer + j * channels,
                        channels);
        }
        double *const swap = below;
        below = outer;
        outer = swap;
    }
}

size_t wo_point_image_draw_room(const wo_lens *lens, double v, int32_t rows)
{
    const wo_iris_grid *g = wo_iris_grid_for(lens->iris.grids, lens->reach(lens->self, v, v));
    const size_t width = 2 * (size_t)wo_point_image_reach(lens, v) + 3;
    return CHANNELS_MAX * (3 * (size_t)g->spokes + width * (size_t)rows);
}

/* Running sums become pixels. */
static void finish_row(const wo_point_image *image, int32_t y, const double *sums, int colours,
                       bool rays, wo_point_pixel *pixels)
{
    const int channels = colours + (rays ? 2 * KIND : 0);
    double sum[CHANNELS_MAX] = {0};
    for (int32_t x = image->rect.x1; x < image->rect.x2; x++, sums += channels) {
        wo_point_pixel *const p = &pixels[x - image->rect.x1];
        *p = (wo_point_pixel){.light = {0}};
        for (int k = 0; k < channels; k++)
            sum[k] += sums[k];
        for (int c = 0; c < 3; c++) {
            const double white = (double)wo_quadratic(image->white[c], (float)x, (float)y);
            const double light = sum[colours == 3 ? c : 0];
            if (light > LIGHT_LEAST && white > 0.01 * (double)image->white[c][0])
                p->light[c] = (float)(light / white);
        }
        const double *const kinds = sum + colours;
        const double all = rays ? fmax(kinds[0], 0) + fmax(kinds[KIND], 0) : 0;
        for (int i = 0; i < 2 && all > LIGHT_LEAST; i++) {
            const double *const kind = kinds + i * KIND;
            if (!(kind[0] > 1e-3 * all))
                continue;
            p->part[i] = (float)(kind[0] / all);
            p->b[i][0] = (float)(kind[1] / kind[0]);
            p->b[i][1] = (float)(kind[2] / kind[0]);
        }
    }
}

static inline void draw(const wo_point_image *image, int32_t y1, int32_t y2, int colours, bool rays,
                        double *room, wo_point_pixel *pixels)
{
    const int channels = colours + (rays ? 2 * KIND : 0);
    const wo_iris_grid *g = image->grid;
    const size_t stride = wo_node_stride(g);
    const int32_t width = wo_rect_width(image->rect);
    drawing d = {.image = image,
                 .to = {.sums = room + 3 * (size_t)g->spokes * (size_t)channels,
                        .rect = {image->rect.x1, y1, image->rect.x2, y2},
                        .width = width + 2}};
    memset(d.to.sums, 0,
           (size_t)(y2 - y1) * (size_t)(width + 2) * (size_t)channels * sizeof *d.to.sums);
    d.low = (float)y1 - 0.5f;
    d.high = (float)y2 - 0.5f;
    for (int line = 0; line < image->lines; line++) {
        const float *m = image->node + (size_t)line * WO_NODE_VALUES * stride;
        d.x = m;
        d.y = m + stride;
        d.bx = m + 2 * stride;
        d.by = m + 3 * stride;
        d.light = m + 4 * stride;
        d.clip = m + 5 * stride;
        d.colour = image->line_colour[line];
        d.mean = colours == 3 ? (d.colour[0] + d.colour[1] + d.colour[2]) / 3 : d.colour[0];
        draw_line(&d, colours, rays, room);
    }
    for (int32_t y = y1; y < y2; y++)
        finish_row(image, y, d.to.sums + (y - y1) * d.to.width * channels, colours, rays,
                   pixels + (ptrdiff_t)(y - y1) * width);
}

void wo_point_image_draw(const wo_point_image *image, int32_t y1, int32_t y2, bool rays,
                         double *room, wo_point_pixel *pixels)
{
    if (image->colours == 3 && rays)
        draw(image, y1, y2, 3, true, room, pixels);
    else if (image->colours == 3)
        draw(image, y1, y2, 3, false, room, pixels);
    else if (rays)
        draw(image, y1, y2, 1, true, room, pixels);
    else
        draw(image, y1, y2, 1, false, room, pixels);
}
