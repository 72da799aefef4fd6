/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_PICTURE_H
#define WO_BRIDGE_PICTURE_H

#include "wideopen/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Pictures compared and shown. Any thread. Images made here are y up, interleaved and tight; their
   data is malloc-ed and freed by the caller with free(). */

/* How far OUT is from REF. R, G, B of all pixels count alike, alpha does not; both are
   scene-linear. "Seen" values are clipped to 0..1 and put on the sRGB curve. Sums are made in
   double precision and in row order, so equal pictures give equal bytes. */
typedef struct wo_picture_error {
    double relmse;     /* mean of (out - ref)^2 / (ref^2 + 0.01) */
    double psnr_lin;   /* dB, values clipped to 0..1; infinite for equal pictures */
    double psnr;       /* dB, seen values */
    double ssim;       /* of seen luma (Rec.709 weights), 11 x 11 Gaussian of sigma 1.5 pixels */
    double max_error;  /* largest absolute difference */
    double energy;     /* sum of out over sum of ref; NaN for a black ref */
    int64_t nonfinite; /* NaN and infinite samples of out; if any, all the rest is 0 */
    int32_t width, height; /* what was compared, pixels */
} wo_picture_error;

/* Compares two pictures of 1, 3 or 4 components (one grey counts as three equal ones) and equal
   size, without a border of crop pixels. REF must be finite. */
WO_NODISCARD wo_status wo_picture_compare(const wo_image *ref, const wo_image *out, int32_t crop,
                                          wo_picture_error *result, wo_error *error);

/* Writes result as one JSON object; infinite and undefined numbers become null. Returns the length
   as snprintf does. */
int wo_picture_json(const wo_picture_error *result, char *buffer, size_t size);

/* Changes the size; smaller by area average, larger by linear interpolation. */
WO_NODISCARD wo_status wo_picture_resize(const wo_image *image, int32_t width, int32_t height,
                                         wo_image *result, wo_error *error);

/* Linear light to seen values, in place: clipped to 0..1 and put on the sRGB curve; NaN becomes
   magenta in RGB pictures and 0 in others; alpha is left alone. */
void wo_picture_encode(wo_image *image);

typedef enum wo_picture_difference {
    WO_DIFFERENCE_MAGNITUDE, /* largest channel difference: black, violet, orange, white */
    WO_DIFFERENCE_SIGNED     /* luma difference: blue where out is darker, red where brighter */
} wo_picture_difference;

/* Seen difference of two pictures in false colour, RGB, with a labelled scale bar under it (so the
   result is higher than ref by the bar). limit is the difference shown at the end of the scale,
   in seen values (0.1 is a good start); 0 takes the largest one present. */
WO_NODISCARD wo_status wo_picture_show_difference(const wo_image *ref, const wo_image *out,
                                                  wo_picture_difference kind, double limit,
                                                  wo_image *result, wo_error *error);

/* One picture of a sheet. */
typedef struct wo_picture_cell {
    const wo_image *image;  /* 1, 3 or 4 components; NULL leaves the place empty */
    bool linear;            /* scene-linear, else already on the sRGB curve */
    const char *caption[2]; /* lines under it, NULL = none; UTF-8 beyond ASCII shows as ? */
} wo_picture_cell;

typedef struct wo_picture_layout {
    const char *title;    /* row on top, NULL = none */
    const char *subtitle; /* smaller, under the title, NULL = none */
    int32_t columns;      /* 0 = about as wide as high */
    int32_t cell_width;   /* pixels of a picture; 0 = 480 */
    int32_t cell_height;  /* 0 = by the shape of the first picture */
} wo_picture_layout;

/* A contact sheet: cells in rows from the top left, each fitted into its place with its shape kept,
   on neutral dark grey. The result is RGB on the sRGB curve, 0..1, ready to be saved as 8 bits. */
WO_NODISCARD wo_status wo_picture_sheet(const wo_picture_layout *layout,
                                        const wo_picture_cell *cells, size_t count,
                                        wo_image *result, wo_error *error);

#ifdef __cplusplus
}
#endif
#endif
