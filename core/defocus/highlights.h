/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_HIGHLIGHTS_H
#define WO_CORE_DEFOCUS_HIGHLIGHTS_H

#include "defocus/stack.h"
#include "optics/pencil.h"

/* Highlights: small, very bright pixels. Lens rays find them rarely, which shows as noise and torn
   edges of their discs. The part of their light above WO_HIGHLIGHT_LEVEL is taken out of the sheets
   and joined to each output pixel by the one ray that connects them, if nothing is in between: no
   noise, exact energy. (Sampling the lights in place of the lens, as path tracers do.) Of lenses
   that do not know that ray the picture of each highlight is drawn (point_image.h). */
#define WO_HIGHLIGHT_LEVEL 4.0f  /* scene-linear; 1 is diffuse white */
#define WO_HIGHLIGHT_REST  0.25f /* what bright ones keep whose picture is drawn */
/* px of blur: smaller is left to the rays, and from WHOLE on no light above the level is; between,
   a part that rises smoothly. */
#define WO_HIGHLIGHT_FROM  1.0
#define WO_HIGHLIGHT_WHOLE 2.5
#define WO_HIGHLIGHT_CROWD                                                                         \
    (2.0 / 3) /* of the pixels of 3 x 3 tiles: more are an area, not points */

typedef struct wo_highlight {
    int32_t x, y;
    float v;
    float reach;  /* px */
    float taken;  /* part of its pixel's light, 0..1 */
    int sheet;    /* of the stack */
    float c[3];   /* light above the level, times the share that one connecting ray carries relative
                     to lens.connect's density: the discrete sum over all pixels is exact */
    size_t image; /* of lenses that connect */
} wo_highlight;

/* What highlights of one vergence have in common. */
typedef struct wo_highlight_image {
    float v;
    float reach;       /* px */
    int32_t extent;    /* px: nothing is further from the middle */
    size_t uses;       /* highlights */
    double share;      /* 1 / the sum of the densities; 0: no pixel sees it */
    float *density;    /* [2 extent + 1][2 extent + 1] of lens.connect where the picture has these
                          pixels; NULL = not kept: too large, or too many of them */
    double (*line)[4]; /* their rays; NULL where the middle of a pixel decides: lens.connect's */
} wo_highlight_image;

typedef struct wo_highlights {
    wo_highlight *list; /* sorted by tile row */
    size_t count;
    float reach;                /* largest */
    wo_rect tiles;              /* in units of tiles, absolute */
    size_t *first;              /* [tiles + 1] */
    wo_highlight_image *images; /* by vergence; of lenses that connect */
    size_t image_count;
    float *densities; /* of all images */
    double (*lines)[4];
    wo_rect drawn;    /* px; whole tiles */
    float (*glow)[3]; /* [h][w] of drawn: all their light; NULL = not drawn, or nothing to draw */
} wo_highlights;

/* Takes the highlights within area, on the grid of tiles, out of the sheets, which must also hold
   one tile more on all sides, as far as the extent goes. Does nothing for lenses that neither
   connect nor know their iris. WO_ABORTED when stopped. */
WO_NODISCARD wo_status wo_highlights_take(const wo_context *context, wo_sheet *sheets, size_t count,
                                          wo_rect area, const wo_lens *lens,
                                          wo_highlights *highlights, wo_error *error);
void wo_highlights_destroy(const wo_context *context, wo_highlights *highlights);

/* For lenses that do not connect; does nothing for others. Draws the highlights, with what hides
   them in the stack, over the tiles that touch window. WO_ABORTED when stopped. */
WO_NODISCARD wo_status wo_highlights_draw(const wo_context *context, wo_highlights *highlights,
                                          const wo_stack *stack, const wo_lens *lens,
                                          wo_rect window, wo_error *error);

/* Part of a highlight's light that gets to pixel (x, y) along the line p(v) - (x, y) = line[0..1] +
   line[2..3] v. sheets: bits of those that may be in the way. v_near: no surface on the way is
   nearer. */
float wo_highlight_seen(const wo_highlight *highlight, const wo_stack *stack, const wo_lens *lens,
                        unsigned sheets, int32_t x, int32_t y, const double line[4], float v_near);
/* Vergence from which on a surface can hide it. */
float wo_highlight_hidden_from(const wo_highlight *highlight, const wo_lens *lens);

/* Adds their light to the pixels of one tile: sums[y][x][rgb]. v_near: nearest surface of the
   tile's footprint. Returns the number of connecting rays. */
int64_t wo_highlights_add(const wo_highlights *highlights, const wo_stack *stack,
                          const wo_lens *lens, wo_rect tile, float v_near,
                          float sums[WO_TILE_HEIGHT][WO_TILE_WIDTH][3]);

#endif
