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

WO_NODISCARD wo_status wo_sheet_create(const wo_context *context, wo_rect area, wo_sheet *sheet,
                                       wo_error *error);
void wo_sheet_destroy(const wo_context *context, wo_sheet *sheet);

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

/* Vergence of one pixel of a layer, 0 with *valid = false where there is none; outside the bounds
   the nearest pixel. Of source the depth, its channel and reading, format, focal_px and stretch are
   read. */
double wo_read_vergence(const wo_sheet_source *source, int32_t x, int32_t y, bool *valid);

/* px that wo_sheet_load looks beyond a pixel. */
#define WO_SHEET_LOAD_MARGIN 2

/* Splits pixels that mix two surfaces (antialiased colour over unfiltered depth) into the part that
   belongs to their own depth, which stays, and the part of the neighbouring surface, which goes
   into edges, where that pixel is still free. Only steps of vergence that make a visible difference
   of blur count (px_per_dioptre). edges must have the sheet's area and start as all NaN; *split is
   added to. */
WO_NODISCARD wo_status wo_sheet_split_edges(const wo_context *context, double px_per_dioptre,
                                            wo_sheet *sheet, wo_sheet *edges, int64_t *split,
                                            wo_error *error);
#define WO_SHEET_SPLIT_MARGIN 3

/* Invents what lies behind the farthest surfaces of the sheets: wherever a farther surface ends at
   a nearer one, it is continued behind it, smoothly, up to about 2^levels px. The pull-push
   interpolation of Gortler et al. 1996, on a grid fixed in absolute coordinates. */
WO_NODISCARD wo_status wo_sheet_fill_hidden(const wo_context *context, const wo_sheet *sheets,
                                            size_t count, double px_per_dioptre, int levels,
                                            wo_sheet *hidden, wo_error *error);

/* px that the fill with so many levels looks beyond a pixel; and the grid it wants areas on. */
int32_t wo_sheet_fill_margin(int levels);

#endif
