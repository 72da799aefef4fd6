/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_RENDER_OUTPUT_H
#define WO_CLI_RENDER_OUTPUT_H

#include "bridge/colour.h"
#include "bridge/image_io.h"

#include <limits.h>

/* Writing what a render made. */

typedef struct wo_output {
    const char *pattern; /* file name, with a frame mark for sequences */
    const char *space; /* the file's colour space; NULL = Source's in files of the same format whose
                          names the configuration's rules treat alike, else by these rules */
    wo_io_depth depth;
    wo_colour *colour;
    const char *made_by; /* "org.wideopen.LensBlur 0.1", an attribute of the file */
} wo_output;

/* Fails early on what is wrong with the name: no such folder, an extension no format has. */
WO_NODISCARD wo_status wo_output_check(const wo_output *output, int frame, wo_error *error);

/* The file that Source came from. */
typedef struct wo_origin {
    const wo_io_part *header;
    const char *path;
    const char *space; /* what it was read in; NULL = numbers */
    bool forced; /* the space was given by hand: what the file says of itself does not count */
} wo_origin;

/* What was written. */
typedef struct wo_written {
    char path[PATH_MAX];
    char space[256]; /* "raw" for numbers */
    bool unsaid;     /* the file cannot say that it is in this space: it will be read as another */
    int64_t cut;     /* samples beyond what half holds */
} wo_written;

/* Writes image (scene-linear, premultiplied; it is converted in place) in display, with the
   attributes and, where it is in the same space, the labels of origin (NULL: none). raw: the pixels
   are numbers, not colours. */
WO_NODISCARD wo_status wo_output_write(const wo_output *output, int frame, wo_image *image,
                                       wo_rect display, const wo_origin *origin, bool raw,
                                       wo_written *written, wo_error *error);

#endif
