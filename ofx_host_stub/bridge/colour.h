/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_COLOUR_H
#define WO_BRIDGE_COLOUR_H

#include "wideopen/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Colour spaces by an OpenColorIO configuration. A wo_colour never changes after it is made: any
   thread may use it, many at once. Names of colour spaces are those of the configuration, its
   aliases or its roles; an unknown one gives WO_ERR_NOT_FOUND and the names there are. */
typedef struct wo_colour wo_colour;

/* Role of the space all rendering is done in: linear light. */
#define WO_COLOUR_WORKING "scene_linear"

/* Loads a configuration: the file named, else the one the environment variable OCIO names, else
   WideOpen's own, which is built in. NULL and "" mean not named. Owned by the caller until
   wo_colour_destroy. */
WO_NODISCARD wo_status wo_colour_create(const char *config, wo_colour **colour, wo_error *error);
void wo_colour_destroy(wo_colour **colour);

/* Where the configuration came from: a path, or "built in". Lives as long as colour. */
const char *wo_colour_origin(const wo_colour *colour);
/* Its colour spaces; name NULL beyond the last. Lives as long as colour. */
size_t wo_colour_count(const wo_colour *colour);
const char *wo_colour_name(const wo_colour *colour, size_t index);

/* Colour space of an image file: what the file says of itself (wo_io_part.colour_space) if the
   configuration knows that name, else by the configuration's file rules. says may be NULL or "".
   The file need not exist. */
WO_NODISCARD wo_status wo_colour_of_file(const wo_colour *colour, const char *path,
                                         const char *says, char *name, size_t size,
                                         wo_error *error);

/* Does the space hold numbers that are no colour? Unknown names do not. */
bool wo_colour_is_data(const wo_colour *colour, const char *name);

/* Converts in place. 4 components are taken as premultiplied: where alpha is neither 0 nor 1 the
   colour is divided by it, converted and multiplied again; alpha itself never changes, and
   colour of alpha 0 (light that adds) is converted as it is. 1 component is never converted, nor
   is anything to or from a data space. Values are neither clipped nor limited beyond what the
   configuration does; NaN stays NaN. */
WO_NODISCARD wo_status wo_colour_convert(const wo_colour *colour, const char *from, const char *to,
                                         wo_image *image, wo_error *error);

/* The same with colour that is not multiplied by alpha. */
WO_NODISCARD wo_status wo_colour_convert_straight(const wo_colour *colour, const char *from,
                                                  const char *to, wo_image *image, wo_error *error);

/* Scene to screen: from a colour space through a view of a display (NULL or "": the configuration's
   first), 1 or more of the image's components as above. The result is meant for 0..1 and is not
   clipped here. */
WO_NODISCARD wo_status wo_colour_display(const wo_colour *colour, const char *from,
                                         const char *display, const char *view, wo_image *image,
                                         wo_error *error);

/* Displays and their views as text, one "display: view, view" a line; the length as snprintf
   returns it. */
int wo_colour_list_displays(const wo_colour *colour, char *buffer, size_t size);

#ifdef __cplusplus
}
#endif
#endif
