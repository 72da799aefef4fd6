/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WIDEOPEN_REPORT_H
#define WIDEOPEN_REPORT_H

#include "wideopen/camera.h"

#ifdef __cplusplus
extern "C" {
#endif

#define WO_STAGE_LIST(X)                                                                           \
    X(WO_STAGE_INPUT, "input")   /* sanitising, vergence, coverage, premultiplication */           \
    X(WO_STAGE_BOUNDS, "bounds") /* min/max vergence */                                            \
    X(WO_STAGE_PLAN, "plan")     /* classes of tiles */                                            \
    X(WO_STAGE_RENDER, "render") /* lens rays */                                                   \
    X(WO_STAGE_OUTPUT, "output") /* mask, writing */

typedef enum wo_stage {
#define WO_STAGE_ENUM(name, text) name,
    WO_STAGE_LIST(WO_STAGE_ENUM)
#undef WO_STAGE_ENUM
        WO_STAGE_COUNT
} wo_stage;

#define WO_TILE_CLASS_LIST(X)                                                                      \
    X(WO_TILE_EMPTY, "empty")   /* nothing there: zero */                                          \
    X(WO_TILE_SHARP, "sharp")   /* no blur: copied */                                              \
    X(WO_TILE_BLACK, "black")   /* nothing but black is seen: copied */                            \
    X(WO_TILE_SINGLE, "single") /* one vergence: one lookup a ray */                               \
    X(WO_TILE_MARCH, "march")   /* rays march through the layers */

typedef enum wo_tile_class {
#define WO_TILE_ENUM(name, text) name,
    WO_TILE_CLASS_LIST(WO_TILE_ENUM)
#undef WO_TILE_ENUM
        WO_TILE_CLASS_COUNT
} wo_tile_class;

/* Something that was not done, and why; texts are constant strings. */
typedef struct wo_left_out {
    const char *what;
    const char *why;
    double amount; /* how much of it, in unit */
    const char *unit;
} wo_left_out;

#define WO_LEFT_OUT_MAX 16

/* An attribute of the picture's metadata that speaks of the camera. */
typedef struct wo_camera_use {
    const char *key; /* of the parameter that it replaces; "" = refused. Constant texts. */
    double value;    /* in unit */
    const char *unit;
    const char *why; /* it is not used; "" = it is */
    char name[WO_CAMERA_NAME_SIZE];
} wo_camera_use;

#define WO_CAMERA_USES_MAX (WO_CAMERA_VALUES + WO_CAMERA_REFUSALS_MAX)

enum { WO_WARNINGS_MAX = 8, WO_WARNING_SIZE = 384 };

/* What a user has to know, though the picture could be made: input that cannot be what was meant, a
   promise that is not kept. */
typedef struct wo_warning {
    const char *key; /* names the kind, the same in every release: "depth-negative". Constant. */
    char text[WO_WARNING_SIZE]; /* what was found, and what to do */
} wo_warning;

/* What a render did and what it cost. Plain data, filled by the core, owned by the caller. */
typedef struct wo_report {
    double seconds[WO_STAGE_COUNT]; /* wall clock */
    int64_t pixels;                 /* written */
    int64_t rays;                   /* lens rays: pixels times samples where rays were traced */
    int64_t steps;                  /* layer lookups of all rays, each for one pixel */
    int64_t tiles[WO_TILE_CLASS_COUNT];
    /* Estimated error of the displayed value (sRGB curve, 0..1), for methods that estimate it: sums
       of squares over error_pixels pixels, by class of tile. */
    double square_error[WO_TILE_CLASS_COUNT];
    int64_t error_pixels[WO_TILE_CLASS_COUNT];
    double guessed;           /* fraction of all light that came from invented surfaces, 0..1 */
    int64_t guessed_pixels;   /* pixels with more than 1/255 of such light */
    int64_t sanitised_colour; /* samples that were NaN or Inf and became 0 */
    int64_t sanitised_depth;  /* samples that were NaN, Inf, zero or negative: infinitely far */
    int64_t mixed_depth;      /* pixels whose antialiased depth was repaired */
    int64_t edge_depth;       /* covered pixels without depth that took a neighbour's */
    int64_t clamped_radius;   /* pixels whose circle of confusion was cut to maxRadius */
    double largest_radius;    /* largest circle of confusion drawn, px, radius */
    int left_out_count;
    wo_left_out left_out[WO_LEFT_OUT_MAX];
    int camera_count;
    wo_camera_use camera[WO_CAMERA_USES_MAX];
    int warning_count;
    wo_warning warnings[WO_WARNINGS_MAX];
} wo_report;

const char *wo_stage_text(wo_stage stage);
const char *wo_tile_class_text(wo_tile_class tile);

/* Notes an omission; beyond WO_LEFT_OUT_MAX it is dropped. Equal what and why add their amounts. */
void wo_report_leave_out(wo_report *report, const char *what, const char *why, double amount,
                         const char *unit);

/* Notes an attribute of the camera; beyond WO_CAMERA_USES_MAX, or without a report, it is dropped.
   name is copied. */
void wo_report_camera(wo_report *report, const char *key, double value, const char *unit,
                      const char *name, const char *why);

/* Warns. The text stays as it is where the key has one already; beyond WO_WARNINGS_MAX, or without
   a report, it is dropped. key is a constant text without blanks and colons. */
void wo_report_warn(wo_report *report, const char *key, const char *format, ...) WO_PRINTF(3, 4);

/* Adds the counters of part to total (several windows of one picture). The camera is that of the
   first part that has one, and so is the text of each warning. */
void wo_report_add(wo_report *total, const wo_report *part);

/* One JSON object, always complete and valid; what is not finite becomes null, and when it does not
   fit the buffer holds {} only. Returns the length as snprintf does. */
int wo_report_json(const wo_report *report, char *buffer, size_t size);

#ifdef __cplusplus
}
#endif
#endif
