/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_OPTICS_LENS_TABLE_H
#define WO_CORE_OPTICS_LENS_TABLE_H

#include "optics/lens_model.h"
#include "wideopen/context.h"

/* A lens model as polynomials in the iris coordinates (s, t), one set for each of some field points
   and wavelengths; between field points the coefficients are interpolated by cubics. The field
   point lies on +x, so that mirror symmetry halves the terms: a_x, b_x, weight, clips and edge are
   even in t, a_y and b_y odd. */
enum {
    WO_TABLE_DEGREE_MAX = 15,
    WO_TABLE_CLIP_DEGREE = 6,
    WO_TABLE_EDGE_DEGREE = 10,
    /* Terms s^i t^j of degree i + j <= d with even j, and with odd j. */
    WO_TABLE_EVEN_MAX = 72,
    WO_TABLE_ODD_MAX = 64,
    WO_TABLE_CLIP_TERMS = 16,
    WO_TABLE_EDGE_TERMS = 36
};

/* Polynomials at one field point and wavelength; rows of equal j one after the other, i rising. */
typedef struct wo_table_node {
    float ax[WO_TABLE_EVEN_MAX], bx[WO_TABLE_EVEN_MAX], weight[WO_TABLE_EVEN_MAX];
    float ay[WO_TABLE_ODD_MAX], by[WO_TABLE_ODD_MAX];
    float clip[WO_MODEL_CLIPS][WO_TABLE_CLIP_TERMS];
    float edge[WO_TABLE_EDGE_TERMS]; /* above 1 there are no rays: they miss a surface, are
                                        reflected totally, or go much too far */
} wo_table_node;

/* What is wanted of a lens. */
typedef struct wo_lens_request {
    const double *nm; /* [lines], 1..WO_LINES_MAX */
    int lines;
    double focal_px;
    double blur_dioptres; /* from the focus, either way */
    double max_px;        /* rays with |a| + blur |b| beyond it do not count; INFINITY = all do */
} wo_lens_request;

/* focal_px (|a| + blur |b|): no farther does it go within the blur. */
double wo_lens_ray_reach(const wo_lens_request *request, const wo_model_ray *ray);
/* Is the ray there, not blocked, and does it stay within max_px? */
bool wo_lens_ray_counts(const wo_lens_model *model, const wo_lens_request *request,
                        const wo_model_ray *ray);

/* How much of the iris is lit, over the field. */
enum { WO_LIT_FIELDS = 33 };
typedef struct wo_lens_lit {
    double field;               /* tangent: up to there at least WO_LIT_LEAST of it is */
    double part[WO_LIT_FIELDS]; /* 0..1, at equal steps of the tangent from 0 to field */
} wo_lens_lit;
#define WO_LIT_LEAST 0.02

/* Measured with rays of the model, in the reference wavelength. WO_ERR_UNSUPPORTED when it is dark.
 */
WO_NODISCARD wo_status wo_lens_lit_measure(const wo_context *context, const wo_lens_model *model,
                                           const wo_lens_request *request, wo_lens_lit *lit,
                                           wo_error *error);
/* The outermost field of which at least so much is lit. */
double wo_lens_lit_field(const wo_lens_lit *lit, double part);

/* Place number i of count in the iris, to look at it: evenly all over, and of every four one on its
   edge. */
void wo_iris_place(int i, int count, double u[2]);

/* Of rays over the field: how far the wavelengths part from the first, px, and which part of those
   that get through go beyond max_px. */
void wo_lens_survey(const wo_lens_model *model, const wo_lens_request *request, double field,
                    double *colour_px, double *beyond);

typedef struct wo_lens_table {
    int lines, nodes, degree, clips;
    bool edge; /* is there a place in the iris without rays? */
    double nm[WO_LINES_MAX];
    double field; /* tangent of the last node: the edge of the image circle or of what was wanted */
    double rms_px; /* error against the model in random rays, as wo_lens_table_create says */
    double worst_px;
    double lit_error;    /* largest difference in the lit part of the iris, over the field */
    wo_table_node *node; /* [lines][nodes] */
} wo_lens_table;

/* Fits the model with the lowest degree and the fewest field points that leave no more than
   target_px of RMS error, in random rays of the field and the iris: of rays that both let through
   focal_px |da + db dv|, the larger of dv = 0 and dv = blur_dioptres; of rays that only one of them
   lets through, how far they are from the place in the iris where the other's end. If none does,
   the best; rms_px says so. Uses the context's threads. */
WO_NODISCARD wo_status wo_lens_table_create(const wo_context *context, const wo_lens_model *model,
                                            const wo_lens_request *request, const wo_lens_lit *lit,
                                            double target_px, wo_lens_table **table,
                                            wo_error *error);
void wo_lens_table_destroy(const wo_context *context, wo_lens_table **table);

/* The polynomials at tangent h >= 0 of one line; beyond the image circle those of its edge. Any
   thread. */
void wo_lens_table_node(const wo_lens_table *table, int line, double h, wo_table_node *out);

/* Evaluates them for count iris points (arrays with room for a multiple of 16). Blocked rays get
   weight 0; or, when clip is there, keep it: then that holds the largest of the clips, 0 without
   any, and above 1 a ray is blocked. */
typedef struct wo_table_rays {
    float *ax, *ay, *bx, *by, *weight;
    float *clip; /* NULL = not wanted */
} wo_table_rays;

typedef void wo_table_function(const wo_lens_table *table, const wo_table_node *node,
                               const float *s, const float *t, int count, const wo_table_rays *out);
extern wo_table_function wo_table_eval_base;
#if defined(__x86_64__)
extern wo_table_function wo_table_eval_avx2;
#endif
wo_table_function *wo_table_choose(int cpu);

#endif
