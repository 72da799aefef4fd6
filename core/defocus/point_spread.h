/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_POINT_SPREAD_H
#define WO_CORE_DEFOCUS_POINT_SPREAD_H

#include "optics/pencil.h"
#include "wideopen/image.h"

/* The point spread of a lens at a vergence: what fraction of the light of a surface pixel each
   sensor pixel gets when nothing else is in the way. A sensor pixel x sees the picture at
   x + A + B v; so the light of the picture's pixel q goes to q - (A + B v). */

/* Fractions by pixel. */
typedef struct wo_point_raster {
    wo_rect rect;  /* of the lit pixels, counted from the source pixel */
    int channels;  /* 1 = all colours alike; 4 = red, green, blue, their mean */
    double *value; /* [channels][h][w]; each channel's sum is 1 */
    double noise;  /* fraction of the largest value below which differences mean nothing */
} wo_point_raster;

/* At the sensor point (x, y) px. Lenses with connect: its density, with the area that each pixel
   covers of it at the rim; near the source, weighted as march.h interpolates colours there, so that
   it is smooth in v from radius 0 on. Other lenses: their image of a point (point_image.h). A blur
   below WO_SHARP_PX is none. Any thread. */
WO_NODISCARD wo_status wo_point_raster_create(const wo_context *context, const wo_lens *lens,
                                              double x, double y, double v, wo_point_raster *raster,
                                              wo_error *error);
void wo_point_raster_destroy(const wo_context *context, wo_point_raster *raster);

/* The same as runs along x: from step.x on a row has these values (red, green, blue, mean), up to
   its next step; the last one of a row is 0. Even apertures have few steps a row, whatever their
   radius. */
typedef struct wo_point_step {
    int32_t x;
    float level[4];
} wo_point_step;

typedef struct wo_point_spread {
    wo_rect rect;         /* holds all that is not 0 */
    uint32_t *first;      /* [h + 1] of each row in step */
    wo_point_step *steps; /* [first[h]] */
} wo_point_spread;

/* Values of a row that differ by no more than raster.noise of the largest one become their mean. */
WO_NODISCARD wo_status wo_point_spread_create(const wo_context *context,
                                              const wo_point_raster *raster,
                                              wo_point_spread *spread, wo_error *error);
void wo_point_spread_destroy(const wo_context *context, wo_point_spread *spread);

#endif
