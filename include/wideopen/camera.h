/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WIDEOPEN_CAMERA_H
#define WIDEOPEN_CAMERA_H

#include "wideopen/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The camera as the metadata of a picture names it: attributes of an EXR file, or what a host says
   of a clip. Every renderer has spellings and units of its own; core/optics/camera_metadata.md
   lists those that are understood, with their sources. What means different things to different
   programs is refused. */

/* What LensBlur can take over: the key of its parameter, the unit. */
#define WO_CAMERA_LIST(X)                                                                          \
    X(WO_CAMERA_FOCAL_LENGTH, "focalLength", "mm")                                                 \
    X(WO_CAMERA_SENSOR_WIDTH, "sensorWidth", "mm")                                                 \
    X(WO_CAMERA_F_NUMBER, "fStop", "")                                                             \
    X(WO_CAMERA_FOCUS, "focusDistance", "m") /* 0 = infinity */                                    \
    X(WO_CAMERA_NEAR, "near", "m")                                                                 \
    X(WO_CAMERA_FAR, "far", "m")                                                                   \
    X(WO_CAMERA_UNITS, "depthScale", "1/m") /* scene units of a metre */

typedef enum wo_camera_value {
#define WO_CAMERA_ENUM(name, key, unit) name,
    WO_CAMERA_LIST(WO_CAMERA_ENUM)
#undef WO_CAMERA_ENUM
        WO_CAMERA_VALUES,
    /* Attributes that give a sensor's width in a round-about way. */
    WO_CAMERA_FIELD_OF_VIEW = WO_CAMERA_VALUES, /* degrees, over the width */
    WO_CAMERA_PHOTOSITE_PITCH,                  /* micrometres */
    WO_CAMERA_PHOTOSITES,                       /* over the width */
    WO_CAMERA_FACTS
} wo_camera_value;

#define WO_CAMERA_NAME_SIZE 64 /* of an attribute's name; longer ones are cut */

typedef struct wo_camera_fact {
    double value;
    int32_t rank;     /* of the spelling, 1 is the best; 0 = not known */
    bool scene_units; /* value is a length in units of the scene */
    char name[WO_CAMERA_NAME_SIZE];
} wo_camera_fact;

typedef struct wo_camera_refusal {
    char name[WO_CAMERA_NAME_SIZE];
    const char *why; /* constant text */
} wo_camera_refusal;

#define WO_CAMERA_REFUSALS_MAX 6

/* All zero bytes: nothing is known. Plain data. */
typedef struct wo_camera {
    wo_camera_fact facts[WO_CAMERA_FACTS];
    bool own[WO_CAMERA_VALUES]; /* the user has set the parameter by hand, and it wins */
    int32_t refused_count;      /* noted; further ones are dropped */
    wo_camera_refusal refused[WO_CAMERA_REFUSALS_MAX];
} wo_camera;

/* Takes one attribute. Case and the prefixes "exr/" (Nuke) and "exrheader_" (RenderMan) do not
   matter. text holds a number with a decimal point, or for vectors and boxes all of them with
   blanks between. Of two names for one value the more particular wins: our own, then the
   renderer's, then the standard; of two attributes of one spelling the first. Names that say
   nothing about a camera are passed over; values that cannot be (not finite, negative, of no known
   lens) and names without one meaning are noted as refused. The text of "wideopen:own" is no
   number: it lists the keys of the parameters that the user has set by hand, separated by blanks.
   Returns true if the name is one of those that are understood or refused. Any thread, one camera
   at a time. Does not fail. */
bool wo_camera_read(wo_camera *camera, const char *name, const char *text);

/* A value in the unit of WO_CAMERA_LIST; units_per_metre (> 0) counts where the metadata does not
   say. *name (borrowed from camera) is where it comes from. False, with *value and *name
   untouched, if it is not known. Any thread. */
bool wo_camera_get(const wo_camera *camera, wo_camera_value value, double units_per_metre,
                   double *number, const char **name);

/* "fStop", "mm"; value < WO_CAMERA_VALUES. */
const char *wo_camera_key(wo_camera_value value);
const char *wo_camera_unit(wo_camera_value value);

#ifdef __cplusplus
}
#endif
#endif
