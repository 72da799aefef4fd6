/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_COLOUR_LABEL_H
#define WO_BRIDGE_COLOUR_LABEL_H

#include "colour.h"
#include "image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Labels: attributes by which an image file says what its colours are. A file that is written
   carries those of its pixels and no others. */

bool wo_label_is_one(const char *attribute);

/* Colour space of a part of a file at path by wo_colour_of_file; part NULL: of a file about to be
   written. ground may be NULL. */
WO_NODISCARD wo_status wo_label_space(const wo_colour *colour, const char *path,
                                      const wo_io_part *part, char *space, size_t size,
                                      wo_colour_ground *ground, wo_error *error);

/* The name a part gives its colour space where the configuration knows none of those it gives;
   NULL otherwise. Lives as long as the part. */
const char *wo_label_unknown(const wo_colour *colour, const char *path, const wo_io_part *part);

/* Labels a part that holds pixels in space, NULL for numbers that are no colours: the id of the
   Color Interop Forum, or the configuration's name where there is none; chromaticities; and
   colour_space in OpenImageIO's words. from, if not NULL, is the part of the file at from_path the
   pixels came from, in that same space: its labels stay, and where they say something nobody here
   knows, nothing is added. */
WO_NODISCARD wo_status wo_label_part(const wo_colour *colour, const char *space,
                                     const char *from_path, const wo_io_part *from,
                                     wo_io_part *part, wo_error *error);

#ifdef __cplusplus
}
#endif
#endif
