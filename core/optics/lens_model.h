/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_OPTICS_LENS_MODEL_H
#define WO_CORE_OPTICS_LENS_MODEL_H

#include "wideopen/lens_diagram.h"
#include "wideopen/lens_trace.h"

/* A lens as a function: one ray of the pencil at a field point, for a place in the iris and a
   wavelength. All models but the thin lens are given so; a table (lens_table.h) makes them fast.

   Lengths are those of the scene: the picture is a plane at distance 1 from the entrance pupil, a
   ray crosses it at p(v) = x + a + b (v - vf), v in dioptres, b in metres. */
enum { WO_MODEL_CLIPS = 6 };

typedef struct wo_model_ray {
    double a[2];   /* tangent, beside the field point's own: aberration in the plane of focus */
    double b[2];   /* m */
    double weight; /* light through this part of the iris, relative to the middle on the axis; 0:
                      there is no such ray */
    double clip[WO_MODEL_CLIPS]; /* squares of radius over clear radius where it matters; any above
                                    1 blocks the ray */
} wo_model_ray;

typedef struct wo_lens_model {
    const void *self;
    int clips;           /* how many of clip[] count */
    double field_max;    /* tangent; beyond it no light arrives */
    double reference_nm; /* the wavelength that the focus is set with */
    double refocus; /* dioptres: the lens is focused so much nearer than its paraxial rays say */
    /* One of these two; wo_lens_model_rays calls it. Field point at tangent h along +x, u in the
       unit disc of the iris. Any thread. */
    bool (*ray)(const void *self, double h, const double u[2], double nm, wo_model_ray *ray);
    /* Many places in each of the wavelengths at once, where that is cheaper: out[lines][count], of
       zeros. A place without a ray in one of them has none in any. */
    void (*rays)(const void *self, double h, const double *nm, int lines, const double (*u)[2],
                 int count, wo_model_ray *out);
} wo_lens_model;

/* Is it a valid prescription, and of revolution? */
WO_NODISCARD wo_status wo_lens_model_check(const wo_prescription *lens, wo_error *error);

/* Rays of a field point through count places in each of the wavelengths, with the model's refocus:
   out[lines][count]. */
void wo_lens_model_rays(const wo_lens_model *model, double h, const double *nm, int lines,
                        const double (*u)[2], int count, wo_model_ray *out);
/* One of them; false: there is no such ray. */
bool wo_lens_model_ray(const wo_lens_model *model, double h, const double u[2], double nm,
                       wo_model_ray *ray);

/* The largest of the ray's clips; INFINITY for a ray that is not there. Above 1 it is blocked. */
double wo_model_ray_clip(const wo_lens_model *model, const wo_model_ray *ray);

/* The refocus that makes the spot on the axis smallest (RMS) in the reference wavelength. */
double wo_lens_model_best_focus(const wo_lens_model *model);

/* A prescription, traced exactly. The ray of an iris point that ends at the sensor point of the
   field is found by Newton's method. */
enum { WO_LINES_MAX = 16 };

typedef struct wo_exact_lens {
    wo_system reference;
    wo_system line[WO_LINES_MAX];
    int lines;
    double vf;       /* dioptres */
    double iris;     /* mm, radius as stopped down */
    double ep_z;     /* mm, where the scene's origin lies */
    double sensor_z; /* mm */
    double axis_jacobian;
    int clip_surface[WO_MODEL_CLIPS];
    int clips;
    double field_max;
    double f_number; /* what was reached */
} wo_exact_lens;

/* f_number 0 or faster than the design: the iris fully open (out->f_number says what that is).
   half_field: tangent up to which rays are wanted. */
WO_NODISCARD wo_status wo_exact_lens_make(const wo_prescription *lens, double f_number, double vf,
                                          double half_field, const double *nm, int lines,
                                          wo_exact_lens *out, wo_error *error);
wo_lens_model wo_exact_lens_model(const wo_exact_lens *lens);

#endif
