/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_POINT_IMAGE_H
#define WO_CORE_DEFOCUS_POINT_IMAGE_H

#include "optics/pencil.h"
#include "wideopen/image.h"

/* What a lens makes of one pixel of light, drawn without noise: each triangle of the iris lands as
   a triangle on the sensor and spreads its share of the light evenly over it, cut by the pixels
   exactly. Folds of the map are caustics: their triangles lie over each other and add up. For
   lenses that know their iris (wo_lens.iris).

   A sensor point x sees the picture at x + D(x, u) through the iris point u, D = A + B v. The light
   of the picture's point q lands where x + D(x, u) = q. D, weights and clips are taken to be
   quadratic in x over the blur, from six field points; so a lens that differs over the blur is
   right to second order, and so is the light: 1 / |I + dD/dx|, over what a white picture would get.
 */
enum { WO_POINT_TERMS = 6 };

typedef struct wo_point_image {
    const wo_iris_grid *grid;
    int lines;   /* that are drawn: wavelengths that part by less than MERGE px share one */
    int colours; /* 1 = red, green and blue alike but for white, 3 */
    double line_colour[16][3];
    double v;
    float white[3][WO_POINT_TERMS]; /* light of a white picture around the point */
    wo_rect rect;                   /* of the lit pixels, counted from the point's */
    float *node;                    /* [lines][6][points]: x, y, bx, by, light, clip; borrowed */
} wo_point_image;

/* Floats of memory that an image at this vergence needs. */
size_t wo_point_image_room(const wo_lens *lens, double v);

/* The image of the picture's point (x, y) px at vergence v; memory: as above, used until the image
   is not. Any thread. */
void wo_point_image_make(const wo_lens *lens, double x, double y, double v, float *memory,
                         wo_point_image *image);

/* Light of one pixel, as part of the point's, and the rays that bring it. */
typedef struct wo_point_pixel {
    float light[3];
    float part[2]; /* of rays whose triangles lie as on the iris, and of those whose triangles are
                      mirrored, as beyond a fold; the sum is 1, or 0 without light */
    float b[2][2]; /* px per dioptre: the mean of each */
} wo_point_pixel;

/* Doubles of memory that drawing rows of images takes; room for rows of all colours and rays. */
size_t wo_point_image_draw_room(const wo_lens *lens, double v, int32_t rows);

/* Rows y1..y2-1 of the rect: pixels [y2 - y1][width of rect]. rays: fill in part and b, too. What a
   row gets does not depend on the others that are asked for. Any thread. */
void wo_point_image_draw(const wo_point_image *image, int32_t y1, int32_t y2, bool rays,
                         double *room, wo_point_pixel *pixels);

/* The triangles of one line as points, for images that are not larger than a few pixels: calls dot
   for each that gets light through, in px from the point's pixel. Light is without the division by
   white. Any thread. */
typedef void wo_point_dot(void *user, double x, double y, double light);
void wo_point_image_dots(const wo_point_image *image, int line, wo_point_dot *dot, void *user);

/* Largest distance of a pixel of such an image from its point; no rect is larger. */
int32_t wo_point_image_reach(const wo_lens *lens, double v);

#endif
