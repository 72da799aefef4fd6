/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_HIGHLIGHTS_IMAGE_H
#define WO_CORE_DEFOCUS_HIGHLIGHTS_IMAGE_H

#include "defocus/highlights.h"

/* Pictures of single highlights through a lens that connects. Only the vergence makes them differ,
   and highlights have theirs rounded, so those of one lamp share one picture. */

/* px from the middle of a highlight that its light may reach. */
int32_t wo_highlight_extent(float reach);

/* Density of rays over the pixel at the offset (dx, dy) from a highlight of vergence v, and one of
   them in line when it is above 0. */
double wo_highlight_density(const wo_lens *lens, int32_t dx, int32_t dy, float v, float reach,
                            double line[4]);

/* The ray of a pixel whose density is kept and above 0. */
void wo_highlight_image_line(const wo_highlight_image *image, const wo_lens *lens, int32_t dx,
                             int32_t dy, double line[4]);

/* Makes an image for each vergence in the list, in any order, and sets the image of each. Their
   densities are kept as far as there is room. WO_ABORTED when stopped. */
WO_NODISCARD wo_status wo_highlight_images_make(const wo_context *context, const wo_lens *lens,
                                                wo_highlights *highlights, wo_error *error);

#endif
