/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_IMAGE_IO_H
#define WO_BRIDGE_IMAGE_IO_H

#include "wideopen/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Image files in and out. Pixels are 32-bit floats, interleaved, y up (row 0 of pixels is the bottom
   row of data_window). Both windows are in OFX orientation: y up, origin at the lower left of
   the display window, so a file whose display window is 0..w-1 x 0..h-1 gives {0, 0, w, h}. */

typedef enum wo_io_type { WO_IO_INT, WO_IO_FLOAT, WO_IO_TEXT } wo_io_type;

typedef struct wo_io_attribute {
    char *name; /* "wideopen:focalLength" */
    wo_io_type type;
    double number;
    char *text; /* WO_IO_TEXT */
} wo_io_attribute;

/* One part (subimage, layer) of a file. */
typedef struct wo_io_part {
    char *name; /* part name, "" when there is none */
    wo_rect data_window;
    wo_rect display_window;
    double pixel_aspect;
    int channels;
    char **channel_names; /* [channels] "R", "diffuse.R", "Z" */
    float *pixels;        /* NULL when only the header was read */
    int bits;             /* of the file's samples: 8, 16, 32 */
    bool is_float;        /* half and float */
    char *colour_space;   /* what the file says of itself, "" when it says nothing */
    wo_io_attribute *attributes;
    size_t attribute_count;
} wo_io_part;

typedef struct wo_io_file {
    wo_io_part *parts;
    size_t part_count;
    char *format; /* "openexr", "png" ... */
} wo_io_file;

/* Reads every part; headers_only leaves pixels NULL. *file is owned by the caller until
   wo_io_file_destroy. Truncated or hostile files give WO_ERR_FORMAT, missing ones WO_ERR_IO. */
WO_NODISCARD wo_status wo_io_read(const char *path, bool headers_only, wo_io_file **file,
                                  wo_error *error);
void wo_io_file_destroy(wo_io_file **file);

/* How samples are stored. */
typedef enum wo_io_depth { WO_IO_AUTO, WO_IO_BYTE, WO_IO_SHORT, WO_IO_HALF, WO_IO_SINGLE } wo_io_depth;

/* Writes the parts to path (format by its extension; several parts, data windows and attributes need
   EXR), to a temporary name beside it first and then renamed, so path never holds half a file.
   WO_IO_AUTO: half for colour and float for Z, N, P and the like in EXR, else the format's own. */
WO_NODISCARD wo_status wo_io_write(const char *path, const wo_io_part *parts, size_t part_count,
                                   wo_io_depth depth, wo_error *error);

/* Makes an empty file with part_count zeroed parts, and helpers to fill one by hand. All strings and
   arrays inside are malloc-ed and go with wo_io_file_destroy. */
WO_NODISCARD wo_status wo_io_file_create(size_t part_count, wo_io_file **file, wo_error *error);
/* Gives a part its windows, channel names (copied) and zeroed pixels. */
WO_NODISCARD wo_status wo_io_part_init(wo_io_part *part, const char *name, wo_rect data_window,
                                       wo_rect display_window, const char *const *channel_names,
                                       int channels, wo_error *error);
WO_NODISCARD wo_status wo_io_part_set_number(wo_io_part *part, const char *name, double number,
                                             wo_error *error);
WO_NODISCARD wo_status wo_io_part_set_text(wo_io_part *part, const char *name, const char *text,
                                           wo_error *error);
const wo_io_attribute *wo_io_part_find(const wo_io_part *part, const char *name);

/* Picks a view out of a file by the command line's words: "" = RGBA/RGB/Y/Z of the first part; "Z",
   "R,G,B", "diffuse" (a layer: diffuse.R ...), "partname" or "partname:Z". The result is a newly
   malloc-ed interleaved buffer of 1, 3 or 4 components in image->data, freed by the caller with
   free(); part tells which part it came from. Unknown names list what the file has. */
WO_NODISCARD wo_status wo_io_select(const wo_io_file *file, const char *channels, wo_image *image,
                                    const wo_io_part **part, wo_error *error);

/* "shot.%04d.exr" or "shot.####.exr" at frame, or a copy when there is no such mark. */
WO_NODISCARD wo_status wo_io_frame_path(const char *pattern, int frame, char *buffer, size_t size,
                                        wo_error *error);
bool wo_io_is_sequence(const char *pattern);

#ifdef __cplusplus
}
#endif
#endif
