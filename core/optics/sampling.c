/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/sampling.h"

#include "optics/pencil.h"

#include <math.h>

enum { RAYS_WANTED = 1 << 16, SETS_MIN = 16, SETS_MAX = 512 };

unsigned wo_lattice_sets(int count)
{
    const int sets = RAYS_WANTED / count;
    return (unsigned)(sets < SETS_MIN ? SETS_MIN : sets > SETS_MAX ? SETS_MAX : sets);
}

void wo_lattice_point(uint32_t seed, unsigned set, double at, int n, int row,
                      const wo_aperture_shape *shape, double u[2])
{
    /* Moved evenly over consecutive sets: Roberts' R2 sequence (2018), begun anew for each seed. */
    const double s = wo_hash(1 + 0x9e3779b9u * seed) * 0x1p-32 + set * 0.7548776662466927 + at / n;
    const double t = wo_hash(2 + 0x85ebca6bu * seed) * 0x1p-32 + set * 0.5698402909980532 +
                     floor(at) * 0.6180339887498949 + row * 0.7548776662466927;
    wo_aperture_sample(shape, s - floor(s), t - floor(t), u);
}
