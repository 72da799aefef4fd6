/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_IMAGE_IO_H
#define WO_BRIDGE_IMAGE_IO_H

#include "wideopen/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Image files in and out. Pixels are 32-bit floats, interleaved, y up (row 0 of pixels is the
   bottom row of data_window). Both windows are in OFX orientation: y up, origin at the lower left
   of the display window, so a file whose display window is 0..w-1 x 0..h-1 gives {0, 0, w, h}.
   Values are those of the file: nothing is linearised, premultiplied or clipped while reading. All
   functions may be called from any thread; one file is used by one thread at a time. */

typedef enum wo_io_type { WO_IO_INT, WO_IO_FLOAT, WO_IO_TEXT } wo_io_type;

/* kind tells how EXR stores the value where type alone does not: "double" beside WO_IO_FLOAT; with
   WO_IO_TEXT one of v2i v2f v2d v3i v3f v3d box2i box2f m33f m33d m44f m44d chromaticities
   rational timecode keycode floatvector (text holds the numbers, separated by spaces) or
   stringvector (one string a line). "" means a plain int, float or string. */
typedef struct wo_io_attribute {
    char *name; /* "wideopen:focalLength" */
    wo_io_type type;
    double number;
    char *text; /* WO_IO_TEXT, else NULL */
    char *kind; /* never NULL */
} wo_io_attribute;

/* One part (subimage, layer) of a file. Files whose alpha is not multiplied into the colour (PNG,
   TGA, many TIFF) carry the attribute "oiio:UnassociatedAlpha" = 1. Attributes that are members
   here already (windows, channels, pixel aspect, name) are not repeated among the attributes. */
typedef struct wo_io_part {
    char *name; /* part name, "" when there is none */
    wo_rect data_window;
    wo_rect display_window;
    double pixel_aspect;
    int channels;
    char **channel_names; /* [channels] "R", "diffuse.R", "Z"; R, G, B, A come in this order */
    float *pixels;        /* NULL when only the header was read, or fault says something */
    char *fault;          /* why the pixels could not be read, NULL when nothing is wrong */
    int bits;             /* of the file's samples, the widest channel: 8, 10, 12, 16, 32 */
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

/* Pixels of one file never take more memory than this, in bytes. */
#define WO_IO_MAX_BYTES ((uint64_t)64 << 30)

/* What the colours of files with this extension are without a word in the file: "sRGB", "linear",
   "KodakLog" in OpenImageIO's words, "" for unknown extensions. */
const char *wo_io_usual_space(const char *path);

/* Are files of these names of one format? "jpg" and "jpeg" are. */
bool wo_io_same_format(const char *path, const char *other);

/* Reads every part; headers_only leaves pixels NULL. *file is owned by the caller until
   wo_io_file_destroy; NULL after a failure. EXR is known by its first bytes, other formats by their
   extension: png tif tiff jpg jpeg dpx cin hdr tga bmp ppm pgm pnm webp jp2.
   Truncated or hostile files give WO_ERR_FORMAT, missing ones WO_ERR_IO, pictures beyond
   WO_MAX_SIDE or WO_IO_MAX_BYTES WO_ERR_RANGE before anything of that size is allocated. Where only
   some of several parts can be read, the others have a fault instead of pixels. Pixels are never
   there by halves.
   Formats other than EXR, and B44 and DWA of EXR, are decoded by the program wideopen-read, which
   must lie beside the running program. It is started with the first such file, with stdin, stdout
   and stderr on /dev/null and in a process group of its own, and stays for the next; it ends when
   this program ends, or by wo_io_end_helpers, and is a child process (one for every thread that
   reads at the same time) to programs that wait for theirs. Each file is decoded in a fork of it,
   so a damaged file cannot do more than end that: WO_ERR_FORMAT, "the PNG reader crashed". The
   fork may take 256 MiB + 3 times the pixels + 2 times the file of memory, 10 s + 1 s for each 16
   MiB of pixels of processor time, four times that and 30 s by the clock without progress, and
   write no file; under sanitizers one allocation is limited to 1 GiB instead. Their pictures come
   upright: what "Orientation" says of stored rows and columns is done and made 1. EXR: tiled parts
   give their full resolution. Deep parts are flattened: R, G, B, A (of every layer) are composited
   front to back by Z with A, everything else is that of the nearest sample, and the part carries
   "wideopen:flattenedDeep" = 1; ZBack is taken for a point. Channels stored at reduced resolution
   are interpolated linearly. Luminance and chroma (Y, RY, BY of one layer, at any resolution)
   become R, G, B of the chromaticities that the file states. A missing or damaged table of lines is
   made anew from the lines. Unsigned integers are exact up to 2^24. */
WO_NODISCARD wo_status wo_io_read(const char *path, bool headers_only, wo_io_file **file,
                                  wo_error *error);
void wo_io_file_destroy(wo_io_file **file);
/* How many files one such fork reads, 16 at first, and whether it goes on behind a file that it
   refused, not at first: what a damaged file did to its memory then ends with it. A file on which a
   fork ends that has read others is tried again in a fresh one. With 1 no file ever shares a fork,
   which takes some milliseconds more for each. Any thread. */
void wo_io_files_per_process(unsigned files, bool behind_refused);
/* Ends the processes that wait for further files; the next file starts one anew. */
void wo_io_end_helpers(void);

/* How samples are stored. */
typedef enum wo_io_depth {
    WO_IO_AUTO,
    WO_IO_BYTE,
    WO_IO_SHORT,
    WO_IO_HALF,
    WO_IO_SINGLE
} wo_io_depth;

/* Writes the parts to path (format by its extension; several parts, data windows and attributes
   need EXR), to a temporary name beside it first and then renamed, so path never holds half a file
   and an older file survives a failure. A symbolic link is followed; what exists and is no
   ordinary file is refused.
   EXR takes WO_IO_AUTO (half for R, G, B, A and a lone Y, float for Z, N, P, ids and the rest),
   WO_IO_HALF and WO_IO_SINGLE. Half holds +-65504 at most: larger values and infinities are
   stored as that; NaN stays NaN. Lossless ZIP, or what an attribute "compression" asks for among
   none, rle, zips, zip, piz. Several parts need different names.
   png tif tiff jpg jpeg dpx hdr tga bmp ppm take one part of 1 to 4 channels and show the display
   window: what lies outside is cut, what is missing is 0. WO_IO_AUTO is 8 bits for png jpg tga
   bmp ppm, 10 for dpx, 16 for tif, float for hdr. Integers are clipped to 0..1, rounded to nearest,
   NaN becomes 0. Alpha is left out where the format has none. Values are stored as they are: PNG
   and TGA readers expect colour that is not multiplied by alpha (see wo_io_unpremultiply); TIFF is
   tagged by the attribute "oiio:UnassociatedAlpha". */
WO_NODISCARD wo_status wo_io_write(const char *path, const wo_io_part *parts, size_t part_count,
                                   wo_io_depth depth, wo_error *error);

/* Makes an empty file with part_count zeroed parts, and helpers to fill one by hand. All strings
   and arrays inside are malloc-ed and go with wo_io_file_destroy. */
WO_NODISCARD wo_status wo_io_file_create(size_t part_count, wo_io_file **file, wo_error *error);
/* Gives a part its windows, channel names (copied) and zeroed pixels; name NULL means "". What the
   part held before is freed. A part outside a file must start as zero bytes. */
WO_NODISCARD wo_status wo_io_part_init(wo_io_part *part, const char *name, wo_rect data_window,
                                       wo_rect display_window, const char *const *channel_names,
                                       int channels, wo_error *error);
/* Frees what a part holds and leaves zero bytes; for parts that belong to no file. */
void wo_io_part_clear(wo_io_part *part);
WO_NODISCARD wo_status wo_io_part_set_number(wo_io_part *part, const char *name, double number,
                                             wo_error *error);
WO_NODISCARD wo_status wo_io_part_set_text(wo_io_part *part, const char *name, const char *text,
                                           wo_error *error);
/* Copies an attribute with its type and kind; one of the same name is replaced. */
WO_NODISCARD wo_status wo_io_part_set(wo_io_part *part, const wo_io_attribute *attribute,
                                      wo_error *error);
/* NULL when the part has no such attribute. */
const wo_io_attribute *wo_io_part_find(const wo_io_part *part, const char *name);

/* Picks a view out of a file by the command line's words: "" = RGBA/RGB/Y/Z of the first part (Y
   with A is a grey RGBA); "Z",
   "R,G,B", "diffuse" (a layer: diffuse.R ...), "partname" or "partname:Z". The result is a newly
   malloc-ed interleaved buffer of 1, 3 or 4 components in image->data, freed by the caller with
   free(); part tells which part it came from. Unknown names list what the file has.
   Words are looked up as channels, then layers, then parts, each in file order, in the case given
   and then in any case; a layer may be named by its last words ("Combined" for
   ViewLayer.Combined.R), a part without a name by its number from 0. "rgb" and "rgba" mean R,G,B
   and R,G,B,A where nothing is called so. */
WO_NODISCARD wo_status wo_io_select(const wo_io_file *file, const char *channels, wo_image *image,
                                    const wo_io_part **part, wo_error *error);

/* Reads a file and picks a view at once: *file holds headers only, *image what wo_io_select gives,
   of part *part. Of an EXR only the channels that are wanted are kept while it is read, and a fault
   of another part does not matter. */
WO_NODISCARD wo_status wo_io_read_view(const char *path, const char *channels, wo_io_file **file,
                                       wo_image *image, size_t *part, wo_error *error);

/* Colour times alpha, and colour over alpha (left alone where alpha is 0); only of 4 components. */
void wo_io_premultiply(wo_image *image);
void wo_io_unpremultiply(wo_image *image);

/* "shot.%04d.exr" or "shot.####.exr" at frame, or a copy when there is no such mark. A mark is %d,
   %Nd or %0Nd (N 1..9), or two or more #; every mark of the path is replaced, but none in the
   names of leading folders that are there, and none when a file of just this name is there. */
WO_NODISCARD wo_status wo_io_frame_path(const char *pattern, int frame, char *buffer, size_t size,
                                        wo_error *error);
bool wo_io_is_sequence(const char *pattern);

#ifdef __cplusplus
}
#endif
#endif
