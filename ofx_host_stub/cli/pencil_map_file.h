/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_PENCIL_MAP_FILE_H
#define WO_CLI_PENCIL_MAP_FILE_H

#include "wideopen/lens_diagram.h"

/* Pencil maps as EXR files of two parts: "density", radii wide and distances high (row 0, v_low,
   at the bottom), and "height", 1 wide, in px. Channel L000 of both is the first wavelength, L001
   the next one. Attributes of "density": wideopen:pencilLow and wideopen:pencilHigh (dioptres from
   the focus), wideopen:pencilScale (px per dioptre), wideopen:pencilL000 and so on (nm).
   Densities and heights are 32-bit floats, the rest is exact. */

WO_NODISCARD wo_status wo_pencil_map_save(const char *path, const wo_pencil_map *map,
                                          wo_error *error);

/* *map is the caller's, until wo_pencil_map_destroy with the same context; NULL after a failure.
   WO_ERR_FORMAT for a file that is no pencil map or holds what cannot be one. */
WO_NODISCARD wo_status wo_pencil_map_load(const wo_context *context, const char *path,
                                          wo_pencil_map **map, wo_error *error);

#endif
