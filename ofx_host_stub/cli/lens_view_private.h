/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_LENS_VIEW_PRIVATE_H
#define WO_CLI_LENS_VIEW_PRIVATE_H

#include "lens_view.h"

/* Sets off, in front of the lens, the ray at (px, py) of the bundle: of a distant object in the
   plane through the first vertex across the bundle's direction, the first vertex's own at a field
   of 0, with the coordinate of the meridian turned towards the axis; of a near one in the plane of
   the first vertex. */
void wo_lens_aim_at(const wo_lens_view *view, wo_meridian meridian, double field, double px,
                    double py, double p[3], double d[3]);

/* What the passing rays of a bundle fill, and a margin: from low to high along the meridian, as far
   as across on either side of it. */
typedef struct wo_lens_span {
    double low, high, across;
} wo_lens_span;
/* False: nothing passes. */
bool wo_lens_find_span(const wo_lens_view *view, wo_meridian meridian, double field,
                       wo_lens_span *span) WO_NODISCARD;

#endif
