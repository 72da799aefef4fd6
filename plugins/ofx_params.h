/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_PLUGINS_OFX_PARAMS_H
#define WO_PLUGINS_OFX_PARAMS_H

#include "ofx_suites.h"
#include "wideopen/effect.h"

/* Fills the effect's params struct with the instance's values at a time. A parameter the host does
   not have keeps its default; a number beyond its range, as interpolation between keys makes it,
   becomes the end of the range; NaN and texts that are too long are failures. Lengths in px are not
   scaled: the core multiplies them by wo_geometry.render_scale. Any thread. */
WO_NODISCARD wo_status wo_ofx_read_params(const wo_ofx_suites *suites, const wo_effect *effect,
                                          OfxImageEffectHandle handle, double time, void *params,
                                          wo_error *error);

#endif
