/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_POINT_IMAGE_PRIVATE_H
#define WO_CORE_DEFOCUS_POINT_IMAGE_PRIVATE_H

#include "defocus/point_image.h"

/* What point_image.c makes and point_image_draw.c draws. */

/* Places are multiples of this, so that sums of them with whole numbers are exact, whatever the
   rows that are drawn. px */
#define WO_PLACE_PX 0x1p-20

/* Values of a node: where the ray lands, its slope, its light, and above 1 it is blocked. */
enum { WO_NODE_X, WO_NODE_Y, WO_NODE_BX, WO_NODE_BY, WO_NODE_LIGHT, WO_NODE_CLIP, WO_NODE_VALUES };

/* Floats of one value of one line. */
static inline size_t wo_node_stride(const wo_iris_grid *grid)
{
    return (size_t)wo_iris_grid_points(grid) + WO_LANES;
}

/* Corners of triangle kind of the cell (ring, spoke), see iris_grid.h. */
static inline void wo_cell_corners(const wo_iris_grid *g, int ring, int spoke, int kind, int at[3])
{
    const int next = spoke + 1 < g->spokes ? spoke + 1 : 0;
    at[0] = ring * g->spokes + spoke;
    at[1] = kind == 0 ? at[0] + g->spokes : (ring + 1) * g->spokes + next;
    at[2] = kind == 0 ? (ring + 1) * g->spokes + next : ring * g->spokes + next;
}

/* Part of a triangle whose corners have these clips that light gets through. */
double wo_open_part(double a, double b, double c);

/* What is quadratic in x and y, by its coefficients of 1, x, y, x^2 + y^2, x^2 - y^2, 2 x y. */
static inline float wo_quadratic(const float t[WO_POINT_TERMS], float x, float y)
{
    return t[0] + t[1] * x + t[2] * y + t[3] * (x * x + y * y) + t[4] * (x * x - y * y) +
           t[5] * (2 * x * y);
}

#endif
