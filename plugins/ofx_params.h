/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_PLUGINS_OFX_PARAMS_H
#define WO_PLUGINS_OFX_PARAMS_H

#include "ofx_suites.h"
#include "wideopen/effect.h"

/* Parameters that a host does not have, or of which it gives no value. */
enum { WO_OFX_LOST_NAMED = 8 };
typedef struct wo_ofx_lost {
    int count;
    char keys[256]; /* of the first, with commas */
} wo_ofx_lost;

/* Fills the effect's params struct with the instance's values at a time. A parameter the host does
   not have, or gives no value of, keeps its default and is written down in *lost (may be NULL); a
   number beyond its range, as interpolation between keys makes it, becomes the end of the range;
   NaN and texts that are too long are failures. Lengths in px are not scaled: the core multiplies
   them by wo_geometry.render_scale. Any thread. */
WO_NODISCARD wo_status wo_ofx_read_params(const wo_ofx_suites *suites, const wo_effect *effect,
                                          OfxImageEffectHandle handle, double time, void *params,
                                          wo_ofx_lost *lost, wo_error *error);

#endif
