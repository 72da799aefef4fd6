/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_COLOUR_H
#define WO_BRIDGE_COLOUR_H

#include "colour_standard.h"
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

/* The configuration's name of what goes by this word: one of its own names, aliases or roles, else
   what a standard calls it (colour_standard.h: "lin_ap1_scene" is ACEScg in an ACES configuration);
   "linear" is the working space. false when there is none. */
bool wo_colour_find(const wo_colour *colour, const char *word, char *name, size_t size);

/* Which standard space this is, by its name and aliases; NULL when it is none that is known. */
const wo_colour_standard *wo_colour_standard_of(const wo_colour *colour, const char *name);

/* Why a file is in a colour space. */
typedef enum wo_colour_ground {
    WO_COLOUR_TOLD,   /* it says so */
    WO_COLOUR_RULE,   /* a rule of the configuration for its name, other than the default */
    WO_COLOUR_ASSUMED /* what files of its format hold, else the configuration's default */
} wo_colour_ground;

/* What a file says of its colours (colour_label.h collects that from one). */
typedef struct wo_colour_words {
    const char *words[8]; /* NULL ends them; the first the configuration knows counts */
    bool has_primaries;
    float primaries[8]; /* of linear light, as in wo_colour_standard */
} wo_colour_words;

/* Colour space of an image file, read or about to be written: what it says of itself, else the
   configuration's rule for its name, else what its format holds, else the default rule. Says is
   NULL or what the file says: a word that only repeats what every file of the format is taken for
   is nothing said, nor are primaries of Rec.709 in EXR, which are those of files without them. A
   default rule that gives data leaves EXR and HDR scene-linear. Reading and writing both ask this
   one function. The file need not exist. ground may be NULL. */
WO_NODISCARD wo_status wo_colour_of_file(const wo_colour *colour, const char *path,
                                         const wo_colour_words *says, char *name, size_t size,
                                         wo_colour_ground *ground, wo_error *error);

/* Does the space hold numbers that are no colour? Unknown names do not. */
bool wo_colour_is_data(const wo_colour *colour, const char *name);

/* Are both names of one space? Unknown names are not. */
bool wo_colour_is_same(const wo_colour *colour, const char *a, const char *b);

/* Converts in place; alpha itself never changes. 4 components are taken as multiplied by alpha. A
   linear conversion needs no regard for that. Encoded colour is divided by alpha, converted and
   multiplied again where code 0 is no light; where it is not (log), codes cannot have been
   multiplied, and they are converted as they are. The divisor is alpha or the largest code, up to
   1, if that is more: soft alpha under brighter colour never takes codes beyond 1, where curves
   run away, and the way back is the same. Colour of alpha 0 (light that adds) is converted as it
   is. 1 component is never converted, nor is anything to or from a data space. Values are neither
   clipped nor limited beyond what the configuration does; NaN stays NaN. */
WO_NODISCARD wo_status wo_colour_convert(const wo_colour *colour, const char *from, const char *to,
                                         wo_image *image, wo_error *error);

/* The same with colour that is not multiplied by alpha, or no encoded colour that is. */
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
