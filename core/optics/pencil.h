/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_OPTICS_PENCIL_H
#define WO_CORE_OPTICS_PENCIL_H

#include "base/simd.h"
#include "optics/iris_grid.h"
#include "wideopen/context.h"
#include "wideopen/optics.h"

/* A pencil: the rays of one sensor point, each a straight line in vergence,
       p(v) - x = (ax + bx v, ay + by v)   [px]
   with a weight. Lens models make pencils; renderers consume them; neither knows the other. */
typedef struct wo_pencil {
    int count;
    const float *ax, *ay, *bx, *by; /* [count], borrowed from the lens or from a room */
    const float *weight[3];         /* [count] for red, green and blue; all NULL = all 1 */
} wo_pencil;

/* Renderers may use one pencil for so many pixels of a row. */
enum { WO_PENCIL_SERVES = 64 };

/* Room for the rays a lens makes at one time. */
enum { WO_PENCIL_PIECE = 512 };
typedef struct wo_pencil_room {
    float ax[WO_PENCIL_PIECE + WO_LANES], ay[WO_PENCIL_PIECE + WO_LANES];
    float bx[WO_PENCIL_PIECE + WO_LANES], by[WO_PENCIL_PIECE + WO_LANES];
    float weight[3][WO_PENCIL_PIECE + WO_LANES];
} wo_pencil_room;

/* Rays of one wavelength through points of the iris, each array with room for WO_LANES more. */
typedef struct wo_iris_rays {
    float *ax, *ay, *bx, *by; /* px and px per dioptre, as in wo_pencil */
    float *weight;            /* as if nothing blocked it; light of the iris itself is left out */
    float *clip; /* above 1 the ray is blocked; passes 1 smoothly from point to point */
} wo_iris_rays;

/* What a lens without connect says of its iris, so that pictures of a point can be drawn. */
typedef struct wo_lens_iris {
    const wo_iris_grid *grids;      /* [WO_IRIS_GRIDS] */
    bool same;                      /* for every sensor point */
    int lines;                      /* wavelengths */
    const double (*line_weight)[3]; /* [lines] in red, green and blue; the mean of each is 1 */
    /* Rays of a wavelength at the sensor point (x, y) px through count points (s, t), whose arrays
       have room for WO_LANES more. Any thread. */
    void (*rays)(const void *self, double x, double y, int line, const float *s, const float *t,
                 int count, const wo_iris_rays *out);
} wo_lens_iris;

/* A lens as a renderer sees it. Const after it is made, shared by all threads. */
typedef struct wo_lens {
    const void *self;
    unsigned
        sets;  /* number of different pencils for one sensor point; neighbours use different ones */
    int count; /* rays of a pencil */
    int half;  /* rays 0..half-1 and the rest are two good samplings of the lens each */
    /* Rays first.. of pencil number set (0..sets-1) at the sensor point (x, y) px, as many as are
       left but no more than WO_PENCIL_PIECE. first: a multiple of that. *out may point into *room.
     */
    void (*pencil)(const void *self, double x, double y, unsigned set, int first,
                   wo_pencil_room *room, wo_pencil *out);
    bool colours; /* weights may differ between red, green and blue */
    /* Largest distance |p(v) - x| of any ray over v_far <= v <= v_near, px. */
    double (*reach)(const void *self, double v_far, double v_near);
    /* px of blur radius per dioptre, for comparing vergences. */
    double px_per_dioptre;
    /* Density of rays, per px^2, that cross the picture at offset (dx, dy) from the sensor point at
       vergence v, and the ray itself; 0 when none does. NULL = not known in closed form: then iris
       is there, if points are to be drawn. */
    double (*connect)(const void *self, double dx, double dy, double v, double line[4]);
    wo_lens_iris iris; /* iris.rays NULL = not known */
} wo_lens;

/* The thin lens with an aperture shape: K u (v - vf). stretch: vertical px per horizontal px. */
typedef struct wo_thin_pencils {
    wo_thin_lens lens;
    wo_aperture_shape shape;
    double stretch;
    int count;
    unsigned sets;
    float *rays;    /* [sets][4][count] */
    float *weights; /* [sets][count], mean 1; NULL = all 1 */
} wo_thin_pencils;

/* count >= 1 samples of the aperture in each set. seed changes the samples, not the picture. */
WO_NODISCARD wo_status wo_thin_pencils_create(const wo_context *context, const wo_thin_lens *lens,
                                              const wo_aperture *aperture, double stretch,
                                              int count, uint32_t seed, wo_thin_pencils **pencils,
                                              wo_error *error);
void wo_thin_pencils_destroy(const wo_context *context, wo_thin_pencils **pencils);
wo_lens wo_thin_pencils_lens(const wo_thin_pencils *pencils);

/* Mixes the bits of a 32-bit number; for choosing pencils. */
static inline uint32_t wo_hash(uint32_t x)
{
    x ^= x >> 16;
    x *= 0x21f0aaadu;
    x ^= x >> 15;
    x *= 0xd35a2d97u;
    x ^= x >> 15;
    return x;
}

#endif
