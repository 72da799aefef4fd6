/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_OPTICS_IRIS_GRID_H
#define WO_CORE_OPTICS_IRIS_GRID_H

#include "wideopen/aperture.h"

/* The open iris cut into triangles, for lenses whose picture of a point is drawn triangle by
   triangle: rings of equal width about the middle, spokes of equal area between them, so that the
   boundary of the iris is an edge of triangles whatever its form. Point (ring, spoke) has the index
   ring * spokes + spoke; ring 0 is the middle, or the rim of the obstruction. The cell between two
   rings and two spokes is cut from its inner corner at spoke to its outer one at spoke + 1; of its
   triangles, 0 has the edge on the outer ring and 1 that on the inner. */
typedef struct wo_iris_grid {
    double reach; /* px: fine enough for pictures of a point up to this radius */
    int rings, spokes;
    float *s, *t;  /* [(rings + 1) * spokes], and room for WO_LANES more */
    float *light;  /* [rings][spokes][2] share of each triangle, the sum is 1 */
    float *memory; /* that of all grids belongs to the first */
} wo_iris_grid;

/* Grids for radii 8, 16, 32 .. px; the last one is for all that are larger. */
enum { WO_IRIS_GRIDS = 6 };

/* Needs a shape without a kernel. After a failure there is nothing to destroy. */
WO_NODISCARD wo_status wo_iris_grids_create(const wo_context *context,
                                            const wo_aperture_shape *shape,
                                            wo_iris_grid grids[WO_IRIS_GRIDS], wo_error *error);
void wo_iris_grids_destroy(const wo_context *context, wo_iris_grid grids[WO_IRIS_GRIDS]);

/* The coarsest that is fine enough. */
const wo_iris_grid *wo_iris_grid_for(const wo_iris_grid grids[WO_IRIS_GRIDS], double reach);

static inline int wo_iris_grid_points(const wo_iris_grid *grid)
{
    return (grid->rings + 1) * grid->spokes;
}

#endif
