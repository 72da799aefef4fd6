/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_IMAGE_IO_PRIVATE_H
#define WO_BRIDGE_IMAGE_IO_PRIVATE_H

#include "image_io.h"

#include <locale.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What the files of image_io share; nobody else includes this. */

#define WO_IO_MAX_CHANNELS   4096
#define WO_IO_MAX_PARTS      4096
#define WO_IO_MAX_ATTRIBUTES 4096 /* of a part */

/* End of a path that fits into an error text. */
const char *wo_io_shown(const char *path);

/* Numbers in attributes have a decimal point whatever the program's locale: gives this thread the C
   locale, and back what it had. */
locale_t wo_io_plain_locale(void);
void wo_io_restore_locale(locale_t before);

/* Copy of a string, NULL when there is no memory. */
char *wo_io_copy_text(const char *text);

/* Refuses windows and channel counts beyond the limits, and adds the bytes of the part's pixels to
 *total. Call before allocating. */
WO_NODISCARD wo_status wo_io_check_size(const char *path, wo_rect data_window,
                                        wo_rect display_window, int64_t channels, uint64_t *total,
                                        wo_error *error);

/* Like wo_io_part_init, without pixels. */
WO_NODISCARD wo_status wo_io_part_head(wo_io_part *part, const char *name, wo_rect data_window,
                                       wo_rect display_window, const char *const *channel_names,
                                       int channels, wo_error *error);
/* Gives a part that has none zeroed pixels. */
WO_NODISCARD wo_status wo_io_part_pixels(wo_io_part *part, wo_error *error);

/* Turns and mirrors what the attribute "Orientation" says is stored in another way than it is seen,
   and makes that 1. */
WO_NODISCARD wo_status wo_io_part_upright(wo_io_part *part, wo_error *error);

/* Adds an attribute. text and kind may be NULL. */
WO_NODISCARD wo_status wo_io_part_add(wo_io_part *part, const char *name, wo_io_type type,
                                      double number, const char *text, const char *kind,
                                      wo_error *error);

/* What a channel is, from the last word of its name: 0 R, 1 G, 2 B, 3 A, 4 anything else. */
int wo_io_component(const char *channel);
/* Length of the layer's name before the last '.', 0 when there is none. */
size_t wo_io_layer_length(const char *channel);

/* What words choose of a file. */
#define WO_IO_MOST_CHOSEN 4
typedef struct wo_io_choice {
    const wo_io_part *part;
    int channels[WO_IO_MOST_CHOSEN]; /* one may stand several times */
    int count;                       /* 0 = nothing found */
} wo_io_choice;

/* Headers are enough; what cannot be an image is refused in words. */
WO_NODISCARD wo_status wo_io_choose(const wo_io_file *file, const char *channels,
                                    wo_io_choice *chosen, wo_error *error);
/* An image of the part's pixels as they are chosen; its data is malloc-ed. */
WO_NODISCARD wo_status wo_io_copy_choice(const wo_io_choice *chosen, wo_image *image,
                                         wo_error *error);

/* Formats but EXR. */
typedef struct wo_io_format {
    const char *extension;
    const char *library_name; /* OpenImageIO's */
    bool readable, writable;
    wo_io_depth automatic;
    bool has_byte, has_short, has_single, has_alpha, has_grey;
} wo_io_format;

/* NULL when the extension is not known. */
const wo_io_format *wo_io_format_of(const char *path);

/* Does the extension ask for EXR, which wo_io_format_of does not know? */
bool wo_io_is_exr(const char *path);

/* Refuses cut files that the library would take for whole ones, and heads that claim far more than
   the file can hold. *promised is what the head says of the pixels, as bytes of floats; 0 where the
   format is not looked into. */
WO_NODISCARD wo_status wo_io_check_whole(const char *path, int fd, const wo_io_format *format,
                                         uint64_t *promised, wo_error *error);

/* io_exr_*.c. fd is open, positioned anywhere, and stays open; path is for texts and for the
   fallback below. Reading leaves a half-filled *file to the caller when it fails. */
WO_NODISCARD wo_status wo_io_exr_read(const char *path, int fd, bool headers_only,
                                      wo_io_file **file, wo_error *error);
/* Reads the headers, and of the pixels what the words choose, into *image. */
WO_NODISCARD wo_status wo_io_exr_read_view(const char *path, int fd, const char *channels,
                                           wo_io_file **file, wo_image *image, size_t *part,
                                           wo_error *error);
WO_NODISCARD wo_status wo_io_exr_write(const char *path, int fd, const wo_io_part *parts,
                                       size_t part_count, wo_io_depth depth, wo_error *error);

/* io_oiio_write.cc, by way of io_late.c */
WO_NODISCARD wo_status wo_io_oiio_write(const char *path, int fd, const wo_io_format *format,
                                        const wo_io_part *part, wo_io_depth depth, wo_error *error);

#ifdef __cplusplus
}
#endif
#endif
