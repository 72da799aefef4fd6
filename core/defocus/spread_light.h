/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_SPREAD_LIGHT_H
#define WO_CORE_DEFOCUS_SPREAD_LIGHT_H

#include "defocus/point_spread.h"
#include "defocus/renderer.h"

/* The light of a stack, sorted for spreading: row by row, and in each row by buckets of vergence
   from front to back. Nothing in it depends on the window: bounds of buckets, radii of point
   spreads and the steps that light is counted in are absolute. */

/* What a light adds to. */
typedef enum wo_light_kind {
    WO_LIGHT_GIVEN,   /* r g b and coverage */
    WO_LIGHT_GUESSED, /* the same, of invented surfaces */
    WO_LIGHT_CLEAR,   /* all alike: what is there but lets light through, 1 - coverage */
    WO_LIGHT_COVER,   /* coverage three times, for lenses with a point spread for each colour */
    WO_LIGHT_KINDS
} wo_light_kind;

/* Sums are whole numbers of steps, so that they have no order and nothing is left over behind a
   bright light: class n holds colours below 2^(4 + 12 n) in steps of 2^(12 n - 46). Coverage is
   always of class 0. */
enum { WO_LIGHT_CLASSES = 9, WO_LIGHT_PLANES = WO_LIGHT_KINDS * WO_LIGHT_CLASSES };

typedef struct wo_light {
    int32_t x;
    uint32_t spread; /* in wo_spread_light.spreads */
    uint32_t plane;  /* kind + WO_LIGHT_KINDS * class */
    float c[4];
} wo_light;

typedef struct wo_spread_light {
    wo_rect rect;   /* of the source pixels */
    int buckets;    /* 0 is the nearest */
    int planes;     /* of the lights there are */
    wo_light *list; /* in the order of rows, then buckets, then x */
    size_t count;
    size_t *first;            /* [h][buckets + 1] in list */
    wo_point_spread *spreads; /* [places]; those that no light uses are empty */
    size_t places;
    int32_t *reach; /* [buckets] px: no light of it goes farther */
    /* The rule from vergence to point spread. */
    float *exact; /* [exact_count] vergences of level pieces of the scene, rising */
    size_t exact_count;
    double px_per_dioptre;
    double fine;   /* radii for each of those of a lens that is the same everywhere */
    int32_t radii; /* numbers of radii are -radii..radii */
    double scale;  /* of the buckets */
    int32_t nearest;
    bool same;     /* the lens is the same everywhere: one zone */
    wo_rect zones; /* in units of WO_ZONE px, absolute */
} wo_spread_light;

/* Lenses that differ over the picture have one point spread for each zone of so many px. */
#define WO_ZONE 128

/* A vergence at a pixel. */
typedef struct wo_spread_place {
    int32_t x, y;
    double v;
} wo_spread_place;

/* The light of rect, which must lie inside the stack's area; polls for an abort. asked: what
   wo_spread_light_at will be asked for, beside what the scene itself needs. */
WO_NODISCARD wo_status wo_spread_light_create(const wo_defocus *scene, wo_rect rect,
                                              const wo_spread_place *asked, size_t asked_count,
                                              wo_spread_light *light, wo_error *error);
void wo_spread_light_destroy(const wo_context *context, wo_spread_light *light);

/* The bucket of a vergence; outside 0..buckets - 1 for what lies before or behind all lights. */
int32_t wo_spread_light_bucket(const wo_spread_light *light, double v);

/* The point spread of a vergence at a pixel. */
const wo_point_spread *wo_spread_light_at(const wo_spread_light *light, wo_spread_place place);

#endif
