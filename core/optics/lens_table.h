/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_OPTICS_LENS_TABLE_H
#define WO_CORE_OPTICS_LENS_TABLE_H

#include "optics/lens_model.h"
#include "wideopen/context.h"

/* A lens model as polynomials in the iris coordinates (s, t), one set for each of some field points
   and wavelengths; between field points the coefficients are interpolated by cubics. The field
   point lies on +x, so that mirror symmetry halves the terms: a_x, b_x, weight and clips are even
   in t, a_y and b_y odd. */
enum {
    WO_TABLE_DEGREE_MAX = 15,
    WO_TABLE_CLIP_DEGREE = 6,
    /* Terms s^i t^j of degree i + j <= d with even j, and with odd j. */
    WO_TABLE_EVEN_MAX = 72,
    WO_TABLE_ODD_MAX = 64,
    WO_TABLE_CLIP_TERMS = 16
};

/* Polynomials at one field point and wavelength; rows of equal j one after the other, i rising. */
typedef struct wo_table_node {
    float ax[WO_TABLE_EVEN_MAX], bx[WO_TABLE_EVEN_MAX], weight[WO_TABLE_EVEN_MAX];
    float ay[WO_TABLE_ODD_MAX], by[WO_TABLE_ODD_MAX];
    float clip[WO_MODEL_CLIPS][WO_TABLE_CLIP_TERMS];
} wo_table_node;

typedef struct wo_lens_table {
    int lines, nodes, degree, clips;
    double nm[WO_LINES_MAX];
    double field_max; /* tangent of the last node */
    int lit;          /* the first so many nodes get light, 4..nodes */
    double field_lit; /* tangent of the last of these: the edge of the image circle */
    double rms_px;    /* error against the model in random rays, as wo_lens_table_create says */
    double worst_px;
    wo_table_node *node; /* [lines][nodes] */
} wo_lens_table;

/* Fits the model for wavelengths nm[lines] with the lowest degree that leaves no more than
   target_px of RMS error, measured in random rays of the field and the iris that the model lets
   through: focal_px |da + db dv|, the larger of dv = 0 and dv = blur_dioptres. If none does, the
   best; rms_px says so. Uses the context's threads. */
WO_NODISCARD wo_status wo_lens_table_create(const wo_context *context, const wo_lens_model *model,
                                            const double *nm, int lines, double focal_px,
                                            double blur_dioptres, double target_px,
                                            wo_lens_table **table, wo_error *error);
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
