/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_LENS_VIEW_PRIVATE_H
#define WO_CLI_LENS_VIEW_PRIVATE_H

#include "lens_view.h"

/* Sets off, in front of the lens, the ray that crosses the first vertex plane at (px, py). */
void wo_lens_aim_at(const wo_lens_view *view, wo_meridian meridian, double field, double px,
                    double py, double p[3], double d[3]);

#endif
