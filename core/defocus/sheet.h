/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_SHEET_H
#define WO_CORE_DEFOCUS_SHEET_H

#include "focus/focus.h"
#include "wideopen/context.h"
#include "wideopen/effect.h"
#include "wideopen/image.h"
#include "wideopen/optics.h"

/* A sheet: one layer of the scene made ready for the renderer. Each pixel of area is a small patch
   of surface at vergence v, premultiplied colour and coverage c, or nothing (v is NaN). Vergences
   inside the renderer are counted from the focus, so that they stay exact where it matters. */
typedef struct wo_sheet {
    wo_rect area;
    float *v;      /* [h][w] dioptres from v_origin; NaN = no surface */
    float (*c)[4]; /* [h][w] r g b a */
    bool guessed;  /* invented: what no layer of the scene holds */
    bool any;      /* holds at least one surface */
} wo_sheet;

/* With memory that is not cleared. */
WO_NODISCARD wo_status wo_sheet_create(const wo_context *context, wo_rect area, wo_sheet *sheet,
                                       wo_error *error);
void wo_sheet_destroy(const wo_context *context, wo_sheet *sheet);

/* Nearest and farthest of its surfaces; false when it has none. */
bool wo_sheet_range(const wo_sheet *sheet, float *v_min, float *v_max);

/* Can nothing of a strip be a step of vergence? It is WO_STRIP values of a row of v, an array of
   w x h, from (x, y) on; all that are no more than around (at most 8) px away count, too. So when
   the surfaces lie within range of each other, and no pixel is empty (gaps: or whatever is); also
   when all are. */
enum { WO_STRIP = 32 };
bool wo_sheet_even(const float *v, int32_t w, int32_t h, int32_t x, int32_t y, int32_t around,
                   double range, bool gaps);

/* How a layer's images become a sheet. */
typedef struct wo_sheet_source {
    const wo_image *colour;
    const wo_image *depth; /* NULL or not connected: everything at infinity */
    int depth_channel;     /* 0..3; the last one there is when the image has fewer */
    wo_alpha alpha;
    wo_depth_reading reading;
    wo_rect extent;        /* pixels outside it do not exist */
    wo_rect format;        /* the optical axis goes through its centre */
    double focal_px;       /* for WO_DEPTH_RAY */
    double stretch;        /* vertical px per horizontal px */
    const wo_focus *focus; /* NULL: one distance is in focus, v_origin */
    double v_origin;       /* 1/m, taken from every vergence: the focus */
    double v_min, v_max;   /* from the origin; surfaces beyond are drawn there: largest radius */
} wo_sheet_source;

/* What was met on the way; added to. */
typedef struct wo_sheet_counts {
    int64_t sanitised_colour;
    int64_t sanitised_depth;
    int64_t edge_depth;
    int64_t clamped_radius;
} wo_sheet_counts;

/* Fills sheet->area (which must lie inside the extent) from the images. counted: pixels outside of
   it are not counted. Pixels with coverage but without depth (an antialiased edge whose centre
   missed) take the nearest surface among their neighbours in the layer; fully covered ones are
   infinitely far. */
WO_NODISCARD wo_status wo_sheet_load(const wo_context *context, const wo_sheet_source *source,
                                     wo_rect counted, wo_sheet *sheet, wo_sheet_counts *counts,
                                     wo_error *error);

/* More light than there is anywhere; sums over all rays of a pixel stay finite. */
#define WO_COLOUR_MAX 1e30f

/* Colour of one pixel: premultiplied, finite, coverage 0..1; outside the bounds the nearest pixel.
   Returns how many samples were not finite, or cut to WO_COLOUR_MAX. */
int wo_read_colour(const wo_image *image, wo_alpha alpha, int32_t x, int32_t y, float c[4]);

/* Would wo_read_colour give the pixels x1..x2 of a row as they are? */
bool wo_row_is_plain(const wo_image *image, wo_alpha alpha, int32_t x1, int32_t x2, int32_t y);

/* Vergence of one pixel of a layer, 0 with *valid = false where there is none; outside the bounds
   the nearest pixel. Of source the depth, its channel and reading, format, focal_px and stretch are
   read. */
double wo_read_vergence(const wo_sheet_source *source, int32_t x, int32_t y, bool *valid);

/* px that wo_sheet_load looks beyond a pixel. */
#define WO_SHEET_LOAD_MARGIN 2

/* Repairs antialiased depth: a pixel whose depth lies on a step between two surfaces, where it
   mixes both and belongs to neither, gets the vergence of the one that has the larger part in it.
   The surfaces are the nearest pixels on either side, at most 4 px away, from where depth goes on
   flat or turns round: slopes and blocks of 2 x 2 px of one depth stay as they are; of a ball,
   the last px before its outline may go flat. Beside the border of the picture, where the other
   side of a step may be outside, steep steps stay, too. Depth mixes in the unit it is given in,
   whatever that is, also with a background at 1e10. Only a visible difference of blur counts
   (px_per_dioptre). source->depth must be connected. mix, as large as the sheet, becomes the part
   of the nearer surface in each repaired pixel's depth and NaN elsewhere; *repaired is added to,
   for pixels of counted. */
WO_NODISCARD wo_status wo_sheet_repair_depth(const wo_context *context,
                                             const wo_sheet_source *source, double px_per_dioptre,
                                             wo_rect counted, wo_sheet *sheet, float *mix,
                                             int64_t *repaired, wo_error *error);
/* px that the repair looks beyond a pixel. */
#define WO_SHEET_REPAIR_MARGIN 22

/* Splits pixels that mix two surfaces (antialiased colour over unfiltered or repaired depth) into
   the part that belongs to their own depth, which stays, and the part of the neighbouring surface,
   which goes into edges, where that pixel is still free. Only steps of vergence that make a visible
   difference of blur count (px_per_dioptre). The parts are those that explain the colour; where the
   two surfaces have much the same colour, those of mix (of wo_sheet_repair_depth; NULL = unknown).
   edges must have the sheet's area and start as all NaN; *split is added to. */
WO_NODISCARD wo_status wo_sheet_split_edges(const wo_context *context, double px_per_dioptre,
                                            const float *mix, wo_sheet *sheet, wo_sheet *edges,
                                            int64_t *split, wo_error *error);
#define WO_SHEET_SPLIT_MARGIN 3

/* Invents what lies behind the farthest surfaces of the sheets: wherever a farther surface ends at
   a nearer one, it is continued behind it, smoothly, up to about 2^levels px. The pull-push
   interpolation of Gortler et al. 1996, on a grid fixed in absolute coordinates. */
WO_NODISCARD wo_status wo_sheet_fill_hidden(const wo_context *context, const wo_sheet *sheets,
                                            size_t count, double px_per_dioptre, int levels,
                                            wo_sheet *hidden, wo_error *error);

/* Leaves of a clean plate only what is behind the count layers, which have its area: where a
   surface is nearer by a visible difference of blur, and none that covers the pixel is at the
   plate's own depth or farther. Elsewhere the scene itself shows it, or shows nothing. What edges
   (of wo_sheet_split_edges) took from the pixels around for the same place goes. */
void wo_sheet_keep_hidden(const wo_context *context, const wo_sheet *layers, size_t count,
                          double px_per_dioptre, wo_sheet *edges, wo_sheet *plate);

/* A clean plate without depth takes that of the continued surfaces (hidden, of
   wo_sheet_fill_hidden, and edges), and their place: what they hold where the plate has nothing
   stays. */
void wo_sheet_lend_depth(const wo_context *context, const wo_sheet *layers, size_t count,
                         double px_per_dioptre, wo_sheet *edges, wo_sheet *hidden, wo_sheet *plate);

/* px that the fill with so many levels looks beyond a pixel; and the grid it wants areas on. */
int32_t wo_sheet_fill_margin(int levels);

#endif
