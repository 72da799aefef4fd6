/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_RENDER_OUTPUT_H
#define WO_CLI_RENDER_OUTPUT_H

#include "bridge/colour.h"
#include "bridge/image_io.h"

/* Writing what a render made. */

typedef struct wo_output {
    const char *pattern; /* file name, with a frame mark for sequences */
    const char *space;   /* the file's colour space; NULL = by the rules of the configuration */
    wo_io_depth depth;
    wo_colour *colour;
    const char *made_by; /* "org.wideopen.LensBlur 0.1", an attribute of the file */
} wo_output;

/* Fails early on what is wrong with the name: no such folder, an extension no format has. */
WO_NODISCARD wo_status wo_output_check(const wo_output *output, int frame, wo_error *error);

/* Writes image (scene-linear, premultiplied; it is converted in place) in display, with the
   attributes of header (NULL: none). raw: the pixels are numbers, not colours. path gets the file's
   name. */
WO_NODISCARD wo_status wo_output_write(const wo_output *output, int frame, wo_image *image,
                                       wo_rect display, const wo_io_part *header, bool raw,
                                       char *path, size_t path_size, wo_error *error);

#endif
