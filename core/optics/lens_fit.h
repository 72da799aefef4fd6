/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_OPTICS_LENS_FIT_H
#define WO_CORE_OPTICS_LENS_FIT_H

#include "optics/lens_table.h"

/* Polynomials of a table fitted to rays of a model, by least squares: a factorisation for each
   field point serves all wavelengths and all degrees. */
typedef struct wo_lens_fit wo_lens_fit;

WO_NODISCARD wo_status wo_lens_fit_create(const wo_context *context, const wo_lens_model *model,
                                          const wo_lens_request *request, wo_lens_fit **fit,
                                          wo_error *error);
void wo_lens_fit_destroy(const wo_context *context, wo_lens_fit **fit);

/* Traces and factorises for field points at equal steps from 0 to field; those that are there from
   a call with (nodes + 1) / 2 are kept. 5 <= nodes <= WO_FIT_NODES_MAX, odd. */
enum { WO_FIT_NODES_MAX = 33 };
WO_NODISCARD wo_status wo_lens_fit_nodes(const wo_context *context, wo_lens_fit *fit, double field,
                                         int nodes, wo_error *error);
/* The largest field, up to this one, for which there are rays enough to fit; 0 when there is none.
 */
double wo_lens_fit_field(const wo_lens_fit *fit, double field);
/* Is there a place in the iris without rays? */
bool wo_lens_fit_edge(const wo_lens_fit *fit);
/* Largest RMS residual of a ray at a field point and wavelength, px, for a degree. */
double wo_lens_fit_residual(const wo_lens_fit *fit, int degree);
/* node[lines][nodes] of this degree. */
void wo_lens_fit_solve(const wo_context *context, const wo_lens_fit *fit, int degree,
                       wo_table_node *node);

#endif
