/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/iris_grid.h"

#include "base/simd.h"

#include <math.h>

/* An iris whose light is uneven needs so many rings for each onion ring, and in all when it has
   grain; its light is the mean of SUB * SUB places of each cell. */
enum { RINGS_AN_ONION = 4, RINGS_OF_GRAIN = 72, SUB = 4 };

static void choose_size(const wo_aperture_shape *shape, int index, wo_iris_grid *grid)
{
    static const int sizes[WO_IRIS_GRIDS][2] = {{8, 48},  {16, 64},  {20, 80},
                                                {24, 96}, {32, 128}, {40, 160}};
    const wo_aperture *a = &shape->aperture;
    grid->reach = index < WO_IRIS_GRIDS - 1 ? 8 << index : INFINITY;
    grid->rings = sizes[index][0];
    grid->spokes = sizes[index][1];
    int wanted = a->ring_amount > 0 ? RINGS_AN_ONION * a->ring_count : 0;
    if (a->grain_amount > 0) {
        wanted = wanted > RINGS_OF_GRAIN ? wanted : RINGS_OF_GRAIN;
        grid->spokes *= 2;
    }
    /* Rings finer than two thirds of a pixel show nothing more. */
    const int most = 12 << index;
    wanted = wanted < most ? wanted : most;
    grid->rings = grid->rings > wanted ? grid->rings : wanted;
    /* Corners of the boundary and the middles between them are spokes. */
    const int parts = shape->sectors > 0 ? 2 * shape->sectors : 1;
    grid->spokes = (grid->spokes + parts - 1) / parts * parts;
}

/* Mean weight over the cell between two radii and two angles in turns. */
static double cell_weight(const wo_aperture_shape *shape, double r0, double r1, double turns,
                          double wide)
{
    if (shape->even)
        return 1;
    double sum = 0;
    for (int i = 0; i < SUB * SUB; i++) {
        const double part = ((double)(i / SUB) + 0.5) / SUB;
        double u[2];
        wo_aperture_polar(shape, sqrt(r0 * r0 + part * (r1 * r1 - r0 * r0)),
                          turns + wide * (i % SUB + 0.5) / SUB, u);
        sum += wo_aperture_weight(shape, u[0], u[1]);
    }
    return sum / (SUB * SUB);
}

static double area(const wo_iris_grid *g, int a, int b, int c)
{
    return fabs((double)((g->s[b] - g->s[a]) * (g->t[c] - g->t[a]) -
                         (g->t[b] - g->t[a]) * (g->s[c] - g->s[a])));
}

static void fill(const wo_aperture_shape *shape, wo_iris_grid *g)
{
    for (int i = 0; i <= g->rings; i++)
        for (int j = 0; j < g->spokes; j++) {
            double u[2];
            wo_aperture_polar(shape, (double)i / g->rings, (double)j / g->spokes, u);
            g->s[i * g->spokes + j] = (float)u[0];
            g->t[i * g->spokes + j] = (float)u[1];
        }
    double sum = 0;
    for (int i = 0; i < g->rings; i++)
        for (int j = 0; j < g->spokes; j++) {
            const int next = (j + 1) % g->spokes;
            const int a = i * g->spokes + j;
            const int b = a + g->spokes;
            const int c = (i + 1) * g->spokes + next;
            const int d = i * g->spokes + next;
            const double light =
                (2 * i + 1) * cell_weight(shape, (double)i / g->rings, (i + 1.0) / g->rings,
                                          (double)j / g->spokes, 1.0 / g->spokes);
            const double outer = area(g, a, b, c);
            const double inner = area(g, a, c, d);
            const double part = outer + inner > 0 ? outer / (outer + inner) : 0;
            g->light[2 * a] = (float)(light * part);
            g->light[2 * a + 1] = (float)(light * (1 - part));
            sum += light;
        }
    for (int i = 0; i < 2 * g->rings * g->spokes; i++)
        g->light[i] = sum > 0 ? (float)((double)g->light[i] / sum) : 0;
}

wo_status wo_iris_grids_create(const wo_context *context, const wo_aperture_shape *shape,
                               wo_iris_grid grids[WO_IRIS_GRIDS], wo_error *error)
{
    size_t room = 0;
    for (int i = 0; i < WO_IRIS_GRIDS; i++) {
        grids[i] = (wo_iris_grid){0};
        choose_size(shape, i, &grids[i]);
        room += 4 * ((size_t)wo_iris_grid_points(&grids[i]) + WO_LANES);
    }
    float *memory = wo_new(context, error, room, sizeof *memory);
    grids[0].memory = memory;
    if (!memory)
        return WO_ERR_NOMEM;
    for (int i = 0; i < WO_IRIS_GRIDS; i++) {
        const size_t n = (size_t)wo_iris_grid_points(&grids[i]) + WO_LANES;
        grids[i].s = memory;
        grids[i].t = memory + n;
        grids[i].light = memory + 2 * n;
        memory += 4 * n;
        fill(shape, &grids[i]);
    }
    return WO_OK;
}

void wo_iris_grids_destroy(const wo_context *context, wo_iris_grid grids[WO_IRIS_GRIDS])
{
    wo_delete(context, grids[0].memory);
    grids[0].memory = NULL;
}

const wo_iris_grid *wo_iris_grid_for(const wo_iris_grid grids[WO_IRIS_GRIDS], double reach)
{
    int i = 0;
    while (i < WO_IRIS_GRIDS - 1 && !(reach <= grids[i].reach))
        i++;
    return &grids[i];
}
