/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WIDEOPEN_APERTURE_H
#define WIDEOPEN_APERTURE_H

#include "wideopen/context.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What the boundary looks like before it is turned and squeezed. All fit the unit disc. */
typedef enum wo_aperture_form {
    WO_APERTURE_IRIS, /* blades: a polygon; without blades a disc */
    WO_APERTURE_STAR, /* as many points as blades, on the unit circle */
    WO_APERTURE_HEART /* a square on its corner and two half discs; the tip down */
} wo_aperture_form;

/* The open aperture inside the unit disc. Samples, weights and mask come from this one description:
   a boundary r(angle), turned and squeezed, less a disc in its middle; and how much light each of
   its points lets through. Radii r below are measured before squeezing. */
typedef struct wo_aperture {
    int blades;       /* 0 = round, else 3..16: a polygon inscribed in the unit circle */
    double curvature; /* -1..1: 0 straight blades, 1 round, negative bent inwards; the valleys of a
                         star: 0.55 + 0.45 curvature of where straight blades would be */
    double rotation;  /* degrees, counter-clockwise with y up: angle of a vertex from +x */
    double aspect;    /* width / height, 0.1..10; the longer side keeps the unit radius */
    wo_aperture_form form;
    double opening;      /* 0..1: 0 the boundary as it is, 1 round; radii in between are mixed */
    double obstruction;  /* 0..0.95: radius of a round obstruction in the middle */
    double apodization;  /* 0..1: a glass of transmission 10^(-2 apodization r^2) */
    double edge;         /* -1..1: e > 0 bright edge, 1 - e + 4 e r^6; e < 0 bright middle,
                            1 - |e| + 4 |e| (1 - r^2)^3; the mean over the disc is 1 */
    double ring_amount;  /* 0..1: onion rings 1 + ring_amount cos(2 pi ring_count r) */
    int ring_count;      /* 0..64 */
    double grain_amount; /* 0..1: smooth noise, 1 +- grain_amount, mean about 1 */
    uint32_t grain_seed;
} wo_aperture;

#define WO_APERTURE_INIT                                                                           \
    {                                                                                              \
        .aspect = 1                                                                                \
    }
#define WO_BLADES_MAX      16
#define WO_OBSTRUCTION_MAX 0.95
#define WO_RINGS_MAX       64

/* Checks the ranges. */
WO_NODISCARD wo_status wo_aperture_validate(const wo_aperture *aperture, wo_error *error);

/* A picture in place of the boundary, row 0 at the bottom. Its middle is the middle of the
   aperture; it is sized so that the farthest corner of its lit pixels touches the unit circle.
   Negative and non-finite values are 0. */
typedef struct wo_aperture_kernel {
    const float *data;
    int width, height; /* 1..WO_KERNEL_SIDE_MAX */
    ptrdiff_t row;     /* floats from one row to the next */
} wo_aperture_kernel;

#define WO_KERNEL_SIDE_MAX 2048

/* A description made ready: const after it is made, shared by all threads. */
typedef struct wo_aperture_shape {
    wo_aperture aperture;
    double area;  /* of the shape; pi for the full disc. With a kernel: of the clear opening that
                     lets as much light through, the brightest pixel being clear */
    double light; /* mean weight of the samples */
    bool even;    /* every weight is 1 */
    double turn;  /* radians */
    double scale_x, scale_y;              /* both in (0, 1] */
    int sectors;                          /* equal parts of the boundary, 0 = disc */
    double start;                         /* angle of the first part, radians */
    int steps;                            /* of the table */
    float sector[1025];                   /* area fraction to angle fraction within half a part */
    double dark_before, dark_at, dark_by; /* angle fractions that the obstruction leaves out */
    struct wo_kernel_table *kernel;       /* owned; NULL = a boundary */
} wo_aperture_shape;

/* Needs a valid description. Does not fail; the shape has no memory of its own. */
void wo_aperture_make(const wo_aperture *aperture, wo_aperture_shape *shape);

/* The same with a picture in place of form, blades, curvature and opening. Checks the description
   and the kernel, one without light included; the kernel is not needed afterwards. */
WO_NODISCARD wo_status wo_aperture_make_kernel(const wo_context *context,
                                               const wo_aperture *aperture,
                                               const wo_aperture_kernel *kernel,
                                               wo_aperture_shape *shape, wo_error *error);

/* Gives back the memory of a shape made with a kernel; legal for every other shape. */
void wo_aperture_destroy(const wo_context *context, wo_aperture_shape *shape);

/* Maps (s, t) of the unit square to a point of the shape, equal areas to equal areas, so that well
   spread points stay well spread (concentric discs, then the boundary). With a kernel the share of
   its light takes the place of areas. Does not fail. */
void wo_aperture_sample(const wo_aperture_shape *shape, double s, double t, double u[2]);

/* The point at part radius (0..1) of the way from the middle, or the obstruction, to the boundary,
   in the direction that has the part turns (of the whole, any) of the area before it: squares of
   radius times turns are areas, too. Not for kernels. Does not fail. */
void wo_aperture_polar(const wo_aperture_shape *shape, double radius, double turns, double u[2]);

/* Weight of a sample at this point: what apodization, edge, rings and grain let through. */
double wo_aperture_weight(const wo_aperture_shape *shape, double x, double y);

/* Light per area at a point, as weighted samples tend to; its integral over the shape is 1, and it
   is 0 outside. */
double wo_aperture_density(const wo_aperture_shape *shape, double x, double y);

/* True when the point lies inside. */
bool wo_aperture_inside(const wo_aperture_shape *shape, double x, double y);

/* Fills size x size floats (row 0 at the bottom, [-1, 1] in both directions) with what each cell
   lets through: covered fraction, times the weight, times a kernel's value over its largest. Does
   not fail. */
void wo_aperture_mask(const wo_aperture_shape *shape, int size, float *mask);

/* Vignetting: what else of the pupil is open for a point of the picture. The field (fx, fy) is its
   place from the middle in half diagonals, (ux, uy) a point of the pupil's unit disc, both as the
   photographer sees them. */

/* Cat's eye of two discs: inside the unit disc and inside another of radius 1 about amount times
   the field. Positive amounts stand for an opening behind the pupil, negative for one before it. */
bool wo_aperture_cats_eye(double amount, double fx, double fy, double ux, double uy);

/* Area of the cat's eye; pi in the middle of the picture, 0 where nothing is open. */
double wo_aperture_cats_eye_area(double amount, double fx, double fy);

/* Barn doors: straight edges before the lens that just touch the beam to the middle of the picture
   and cut the pupil by so many of its radii for a point at field 1 towards the door: at field f the
   right door lets pass what has ux <= 1 - right fx. 0 = no door. */
typedef struct wo_barn_doors {
    double left, right, bottom, top;
} wo_barn_doors;

bool wo_barn_doors_pass(const wo_barn_doors *doors, double fx, double fy, double ux, double uy);

#ifdef __cplusplus
}
#endif
#endif
