/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/point_image_private.h"

#include <math.h>
#include <string.h>

/* Wavelengths that land no farther apart than this are drawn as one. px */
#define MERGE_PX   0.2
#define MERGE_PART 0.004 /* of the radius, where that is more */
#define PI         3.14159265358979323846

/* Where a picture is drawn together more than this by a change of the lens over the blur, nothing
   is known. */
#define LEAST_DET 0.1f

enum {
    X = WO_NODE_X,
    Y = WO_NODE_Y,
    BX = WO_NODE_BX,
    BY = WO_NODE_BY,
    LIGHT = WO_NODE_LIGHT,
    CLIP = WO_NODE_CLIP,
    VALUES = WO_NODE_VALUES
};
enum { FIELDS = 6, PROBES = 32 };

static int32_t reach_of(double reach)
{
    return (int32_t)(1.25 * reach) + 3;
}

int32_t wo_point_image_reach(const wo_lens *lens, double v)
{
    return reach_of(lens->reach(lens->self, v, v));
}

size_t wo_point_image_room(const wo_lens *lens, double v)
{
    const wo_iris_grid *grid = wo_iris_grid_for(lens->iris.grids, lens->reach(lens->self, v, v));
    return ((size_t)lens->iris.lines + FIELDS) * VALUES * wo_node_stride(grid);
}

/* Part of a triangle whose corners have these clips that light gets through. */
double wo_open_part(double a, double b, double c)
{
    const int open = (a <= 1) + (b <= 1) + (c <= 1);
    if (open == 0 || open == 3)
        return open / 3;
    const bool one = open == 1;
    /* The corner that differs from the others comes first. */
    if ((b <= 1) == one) {
        const double swap = a;
        a = b;
        b = swap;
    } else if ((c <= 1) == one) {
        const double swap = a;
        a = c;
        c = swap;
    }
    const double corner = (1 - a) / (b - a) * ((1 - a) / (c - a));
    return one ? corner : 1 - corner;
}

static double white_of(const wo_iris_grid *g, const wo_iris_rays *rays)
{
    double sum = 0;
    for (int i = 0; i < g->rings; i++)
        for (int j = 0; j < g->spokes; j++)
            for (int kind = 0; kind < 2; kind++) {
                int at[3];
                wo_cell_corners(g, i, j, kind, at);
                double weight = 0;
                for (int k = 0; k < 3; k++)
                    weight += (double)rays->weight[at[k]];
                const double open =
                    wo_open_part((double)rays->clip[at[0]], (double)rays->clip[at[1]],
                                 (double)rays->clip[at[2]]);
                sum += (double)g->light[2 * (i * g->spokes + j) + kind] * weight / 3 * open;
            }
    return sum;
}

/* What is quadratic in x and y is known from its values at the point and at a pentagon around it:
   coefficients of 1, x, y, x^2 + y^2, x^2 - y^2, 2 x y. */
enum { TERMS = WO_POINT_TERMS };

typedef struct field {
    int count;               /* FIELDS, or 1 where the lens is the same everywhere */
    double place[FIELDS][2]; /* px */
    float share[FIELDS][TERMS];
} field;

static void make_field(double radius, bool same, field *f)
{
    *f = (field){.count = 1, .share = {{1}}};
    if (same)
        return;
    *f = (field){.count = FIELDS, .share = {{1, 0, 0, (float)(-1 / (radius * radius)), 0, 0}}};
    for (int k = 1; k < FIELDS; k++) {
        const double angle = 2 * PI * k / (FIELDS - 1);
        const double part = 2.0 / (FIELDS - 1);
        f->place[k][0] = radius * cos(angle);
        f->place[k][1] = radius * sin(angle);
        f->share[k][1] = (float)(part * cos(angle) / radius);
        f->share[k][2] = (float)(part * sin(angle) / radius);
        f->share[k][3] = (float)(0.5 * part / (radius * radius));
        f->share[k][4] = (float)(part * cos(2 * angle) / (radius * radius));
        f->share[k][5] = (float)(part * sin(2 * angle) / (radius * radius));
    }
}

/* Of so many points at a time, so that compilers make vectors of them. */
enum { LANES = 16 };

static inline void terms_of(const field *f, const float value[FIELDS][LANES],
                            float out[TERMS][LANES])
{
    for (int l = 0; l < LANES; l++) {
        out[0][l] = value[0][l];
        out[3][l] = f->share[0][3] * value[0][l];
        out[1][l] = out[2][l] = out[4][l] = out[5][l] = 0;
    }
    for (int k = 1; k < f->count; k++)
        for (int n = 1; n < TERMS; n++)
            for (int l = 0; l < LANES; l++)
                out[n][l] += f->share[k][n] * value[k][l];
}

static inline float value_of(float t[TERMS][LANES], int l, float x, float y)
{
    const float own[TERMS] = {t[0][l], t[1][l], t[2][l], t[3][l], t[4][l], t[5][l]};
    return wo_quadratic(own, x, y);
}

/* Newton's step of x + D(x) = 0; det = |I + dD/dx| before it. A det that is too small stays. */
static inline void step(float d[2][TERMS][LANES], float x[LANES], float y[LANES], float det[LANES])
{
    for (int l = 0; l < LANES; l++) {
        const float fx = x[l] + value_of(d[0], l, x[l], y[l]);
        const float fy = y[l] + value_of(d[1], l, x[l], y[l]);
        const float xx =
            1 + d[0][1][l] + 2 * ((d[0][3][l] + d[0][4][l]) * x[l] + d[0][5][l] * y[l]);
        const float xy = d[0][2][l] + 2 * ((d[0][3][l] - d[0][4][l]) * y[l] + d[0][5][l] * x[l]);
        const float yx = d[1][1][l] + 2 * ((d[1][3][l] + d[1][4][l]) * x[l] + d[1][5][l] * y[l]);
        const float yy =
            1 + d[1][2][l] + 2 * ((d[1][3][l] - d[1][4][l]) * y[l] + d[1][5][l] * x[l]);
        const float is = xx * yy - xy * yx;
        det[l] = det[l] > LEAST_DET ? is : 0;
        const float part = det[l] > LEAST_DET ? 1 / is : 0;
        x[l] -= part * (yy * fx - xy * fy);
        y[l] -= part * (xx * fy - yx * fx);
    }
}

/* One value of LANES rays of every field point. */
static void gather(const wo_iris_rays rays[FIELDS], int count, int k, int first,
                   float out[FIELDS][LANES])
{
    for (int f = 0; f < count; f++) {
        const float *const from[VALUES] = {rays[f].ax, rays[f].ay,     rays[f].bx,
                                           rays[f].by, rays[f].weight, rays[f].clip};
        memcpy(out[f], from[k] + first, LANES * sizeof(float));
    }
}

/* Where LANES rays of one wavelength land. */
static void land_some(const field *f, const wo_iris_rays rays[FIELDS], int first, float v,
                      float most, float *node, size_t stride)
{
    float from[VALUES][FIELDS][LANES];
    for (int k = 0; k < VALUES; k++)
        gather(rays, f->count, k, first, from[k]);
    for (int i = 0; i < f->count; i++)
        for (int l = 0; l < LANES; l++) {
            from[X][i][l] += v * from[BX][i][l];
            from[Y][i][l] += v * from[BY][i][l];
            /* Clips go with the square of a radius. */
            const float clip = from[CLIP][i][l];
            from[CLIP][i][l] = sqrtf(clip > 0 ? clip : 0);
        }
    float t[VALUES][TERMS][LANES];
    for (int k = 0; k < VALUES; k++)
        terms_of(f, from[k], t[k]);
    float x[LANES];
    float y[LANES];
    float det[LANES];
    for (int l = 0; l < LANES; l++) {
        x[l] = -t[X][0][l];
        y[l] = -t[Y][0][l];
        det[l] = 1;
    }
    for (int k = 0; k < 3; k++)
        step(t, x, y, det);
    for (int l = 0; l < LANES; l++) {
        /* What is farther off is beyond the clips, where the table knows nothing. */
        const bool lands = det[l] > LEAST_DET && x[l] * x[l] + y[l] * y[l] <= most * most;
        const float xl = lands ? rintf(x[l] / (float)WO_PLACE_PX) * (float)WO_PLACE_PX : 0;
        const float yl = lands ? rintf(y[l] / (float)WO_PLACE_PX) * (float)WO_PLACE_PX : 0;
        const float clip = value_of(t[CLIP], l, xl, yl);
        const float light = value_of(t[LIGHT], l, xl, yl);
        float *const to = node + first + l;
        to[X * stride] = xl;
        to[Y * stride] = yl;
        to[BX * stride] = lands ? value_of(t[BX], l, xl, yl) : 0;
        to[BY * stride] = lands ? value_of(t[BY], l, xl, yl) : 0;
        to[LIGHT * stride] = lands && light > 0 ? light / det[l] : 0;
        to[CLIP * stride] = lands && clip * clip < 4 ? clip * clip : 4;
    }
}

/* Puts wavelengths that land together into groups: group[line] rises from 0. Returns how many. */
static int merge(const wo_lens *lens, const wo_iris_grid *g, double x, double y, double v,
                 int group[16])
{
    float s[PROBES + WO_LANES] = {0};
    float t[PROBES + WO_LANES] = {0};
    for (int i = 0; i < PROBES; i++) {
        const int ring = i % 2 ? g->rings : g->rings / 2;
        const int at = ring * g->spokes + i * g->spokes / PROBES;
        s[i] = g->s[at];
        t[i] = g->t[at];
    }
    float out[2][VALUES][PROBES + WO_LANES];
    const double limit = fmax(MERGE_PX, MERGE_PART * lens->reach(lens->self, v, v));
    int groups = 0;
    for (int line = 0; line < lens->iris.lines; line++) {
        const bool first = line == 0;
        float(*const o)[PROBES + WO_LANES] = out[first ? 0 : 1];
        const wo_iris_rays rays = {o[0], o[1], o[2], o[3], o[4], o[5]};
        lens->iris.rays(lens->self, x, y, line, s, t, PROBES, &rays);
        double apart = 0;
        for (int i = 0; i < PROBES && !first; i++) {
            const float dx = o[0][i] - out[0][0][i] + (float)v * (o[2][i] - out[0][2][i]);
            const float dy = o[1][i] - out[0][1][i] + (float)v * (o[3][i] - out[0][3][i]);
            if (o[CLIP][i] <= 1)
                apart = fmax(apart, hypot((double)dx, (double)dy));
        }
        if (apart > limit) {
            groups++;
            memcpy(out[0], out[1], sizeof out[0]);
        }
        group[line] = groups;
    }
    return groups + 1;
}

/* The pixels that triangles may touch. */
static void find_rect(wo_point_image *image, size_t stride)
{
    float low[2] = {0, 0};
    float high[2] = {0, 0};
    const int points = wo_iris_grid_points(image->grid);
    for (int line = 0; line < image->lines; line++)
        for (int i = 0; i < points; i++)
            for (int k = 0; k < 2; k++) {
                const float at =
                    image->node[((size_t)line * VALUES + (size_t)k) * stride + (size_t)i];
                low[k] = at < low[k] ? at : low[k];
                high[k] = at > high[k] ? at : high[k];
            }
    image->rect =
        (wo_rect){(int32_t)floorf(low[0] + 0.5f), (int32_t)floorf(low[1] + 0.5f),
                  (int32_t)floorf(high[0] + 0.5f) + 1, (int32_t)floorf(high[1] + 0.5f) + 1};
}

void wo_point_image_make(const wo_lens *lens, double x, double y, double v, float *memory,
                         wo_point_image *image)
{
    const double reach = lens->reach(lens->self, v, v);
    *image = (wo_point_image){.grid = wo_iris_grid_for(lens->iris.grids, reach), .v = v};
    const wo_iris_grid *g = image->grid;
    const size_t stride = wo_node_stride(g);
    const int points = wo_iris_grid_points(g);
    int group[16];
    image->lines = merge(lens, g, x, y, v, group);
    image->colours = image->lines > 1 ? 3 : 1;
    image->node = memory + FIELDS * VALUES * stride;
    field f;
    make_field(0.8 * fmax(reach, 4), lens->iris.same, &f);
    wo_iris_rays rays[FIELDS];
    for (int k = 0; k < FIELDS; k++) {
        float *m = memory + (size_t)k * VALUES * stride;
        rays[k] = (wo_iris_rays){
            m, m + stride, m + 2 * stride, m + 3 * stride, m + 4 * stride, m + 5 * stride};
    }
    const int lines = lens->iris.lines;
    for (int line = 0, end; line < lines; line = end) {
        double *const colour = image->line_colour[group[line]];
        for (end = line; end < lines && group[end] == group[line]; end++)
            for (int c = 0; c < 3; c++)
                colour[c] += lens->iris.line_weight[end][c] / lines;
        float white[FIELDS][LANES] = {{0}};
        for (int k = 0; k < f.count; k++) {
            lens->iris.rays(lens->self, x + f.place[k][0], y + f.place[k][1], (line + end) / 2,
                            g->s, g->t, points, &rays[k]);
            white[k][0] = (float)white_of(g, &rays[k]);
        }
        float terms[TERMS][LANES];
        terms_of(&f, white, terms);
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < TERMS; k++)
                image->white[c][k] += (float)colour[c] * terms[k][0];
        for (int i = 0; i < points; i += LANES)
            land_some(&f, rays, i, (float)v, (float)(1.2 * reach + 1),
                      image->node + (size_t)group[line] * VALUES * stride, stride);
    }
    find_rect(image, stride);
}

void wo_point_image_dots(const wo_point_image *image, int line, wo_point_dot *dot, void *user)
{
    const wo_iris_grid *g = image->grid;
    const size_t stride = wo_node_stride(g);
    const float *m = image->node + (size_t)line * VALUES * stride;
    for (int i = 0; i < g->rings; i++)
        for (int j = 0; j < g->spokes; j++)
            for (int kind = 0; kind < 2; kind++) {
                int at[3];
                wo_cell_corners(g, i, j, kind, at);
                double mean[VALUES] = {0};
                for (int k = 0; k < VALUES; k++)
                    for (int n = 0; n < 3; n++)
                        mean[k] += (double)m[(size_t)k * stride + (size_t)at[n]] / 3;
                const float *clip = m + CLIP * stride;
                const double light =
                    mean[LIGHT] * (double)g->light[2 * (i * g->spokes + j) + kind] *
                    wo_open_part((double)clip[at[0]], (double)clip[at[1]], (double)clip[at[2]]);
                if (light > 0)
                    dot(user, mean[X], mean[Y], light);
            }
}
