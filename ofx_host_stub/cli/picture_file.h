/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_PICTURE_FILE_H
#define WO_CLI_PICTURE_FILE_H

#include "bridge/colour.h"
#include "bridge/image_io.h"

/* Pictures as the command line names them: "FILE[:CHANNELS]". */

/* Splits text; a colon may be part of the file's name: the shortest part before a colon that is a
   file (at frame, for sequences) wins, then the whole; when nothing is, the first colon splits.
   *file and *channels are malloc-ed, NULL after a failure. */
WO_NODISCARD wo_status wo_picture_split(const char *text, int frame, char **file, char **channels,
                                        wo_error *error);

/* Is there a file at this frame? */
bool wo_picture_exists(const char *pattern, int frame);

/* Brings an image of a file's part from space to linear light, colour multiplied by alpha. Files
   whose colour is not multiplied are converted first; DPX and Cineon say nothing of alpha, their
   colour is converted as it is and taken for light that is multiplied. A grey image becomes RGB, so
   that it can be converted; its memory may move. */
WO_NODISCARD wo_status wo_picture_linear(const wo_colour *colour, const wo_io_file *file,
                                         size_t part, const char *space, wo_image *image,
                                         wo_error *error);

/* Gives an image so many components, 1, 3 or 4: grey is repeated, alpha that is missing is 1; one
   component of colours is the first, and colour without alpha is what lies over black. The data is
   malloc-ed and without gaps; it may move. */
WO_NODISCARD wo_status wo_picture_components(wo_image *image, int components, wo_error *error);

/* Reads "FILE[:CHANNELS]" as linear light; space NULL: by the file's rules. image->data is
   malloc-ed. */
WO_NODISCARD wo_status wo_picture_load(const wo_colour *colour, const char *space, const char *text,
                                       wo_image *image, wo_error *error);

/* Saves RGB values of 0..1 as they are, 8 bits where the format has them. */
WO_NODISCARD wo_status wo_picture_save(const char *path, const wo_image *image, wo_error *error);

/* A name the configuration does not know is WO_ERR_NOT_FOUND. NULL is legal: nothing to check. */
WO_NODISCARD wo_status wo_picture_check_space(const wo_colour *colour, const char *space,
                                              wo_error *error);

#endif
