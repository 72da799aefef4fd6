/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_OPTICS_SAMPLING_H
#define WO_CORE_OPTICS_SAMPLING_H

#include "wideopen/aperture.h"

/* How many different sets of count samples there are: so many that no pattern shows, so few that
   they stay in the cache. */
unsigned wo_lattice_sets(int count);

/* The point of a lattice of n that comes j-th: first every second one, n / 2 of them, then those
   between: each half is a lattice, too. */
static inline int wo_lattice_order(int j, int n)
{
    return j < n / 2 ? 2 * j + 1 : 2 * (j - n / 2);
}

/* Point at of n (0 <= at < n, fractions allowed) of a lattice over the aperture: the golden ratio's
   rank-1 lattice, moved for each set (Cranley and Patterson 1976). row tells
   lattices of one set from each other. */
void wo_lattice_point(uint32_t seed, unsigned set, double at, int n, int row,
                      const wo_aperture_shape *shape, double u[2]);

#endif
