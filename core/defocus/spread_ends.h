/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_SPREAD_ENDS_H
#define WO_CORE_DEFOCUS_SPREAD_ENDS_H

#include "defocus/spread_light.h"

/* Light below this fraction is not followed further. */
#define WO_SPREAD_FAINT 1e-4

/* Pixels that a tile's rays can touch. */
wo_rect wo_spread_footprint(const wo_defocus *scene, int32_t tx, int32_t ty);

/* For each of tiles (in units of tiles) the nearest bucket behind which nothing is seen from it:
   one surface blocks every ray (wo_lens_rays_blocks). INT32_MAX where there is none. Freed with
   wo_delete. */
WO_NODISCARD wo_status wo_spread_ends_create(const wo_defocus *scene, const wo_spread_light *light,
                                             wo_rect tiles, int32_t **ends, wo_error *error);

#endif
