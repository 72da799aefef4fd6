/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_PICTURE_FIT_H
#define WO_CLI_PICTURE_FIT_H

#include "bridge/image_io.h"

/* What becomes of a clip whose picture (display window) is not as large as the project. */
typedef enum wo_clip_size {
    WO_CLIP_SIZE_ERROR,
    WO_CLIP_SIZE_SCALE, /* display window upon display window */
    WO_CLIP_SIZE_KEEP   /* it lies where its own coordinates say, as in other hosts */
} wo_clip_size;

/* The pixels that all clips of a render have: those of Source. */
typedef struct wo_project_pixels {
    wo_rect window; /* display window */
    double aspect;  /* of a pixel */
    wo_clip_size size;
} wo_project_pixels;

/* Pixel aspect of a part; 1 where the file says nonsense. */
double wo_part_aspect(const wo_io_part *part);

/* Brings a part's picture, which is linear and premultiplied, onto the pixels of the project. Large
   in the same way with another pixel aspect it is resampled, another size is refused or treated as
   project->size says; most often nothing is to be done. nearest: samples are picked (depth, object
   numbers), else interpolated, or averaged where they become fewer. image->data is malloc-ed and
   replaced. */
WO_NODISCARD wo_status wo_picture_fit(const wo_project_pixels *project, const wo_io_part *part,
                                      bool nearest, wo_image *image, wo_error *error);

#endif
