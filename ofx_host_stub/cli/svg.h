/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_SVG_H
#define WO_CLI_SVG_H

#include "wideopen/status.h"

/* Line drawings as SVG 1.1, y down, in CSS pixels. Text is escaped, bytes that are no UTF-8 become
   U+FFFD, numbers do not depend on the locale and are rounded to 1/100, so equal drawings give
   equal bytes. Points that are no finite numbers are left out and part a line. Nothing fails before
   wo_svg_finish. One thread per object. */

typedef struct wo_svg {
    char *text;
    size_t length, size;
    bool failed; /* out of memory */
    bool clipped;
    double left, top, right, bottom; /* of the clip box */
} wo_svg;

typedef struct wo_pen {
    const char *colour; /* "#c02020" */
    double width;
    const char *dash; /* "6 3", NULL = solid */
} wo_pen;

typedef struct wo_box {
    double x, y, w, h;
} wo_box;

typedef enum wo_anchor { WO_ANCHOR_START, WO_ANCHOR_MIDDLE, WO_ANCHOR_END } wo_anchor;

void wo_svg_begin(wo_svg *svg, double width, double height, const char *title);
void wo_svg_line(wo_svg *svg, const wo_pen *pen, double x1, double y1, double x2, double y2);
/* fill: a colour; NULL leaves the path open. pen NULL = no outline. */
void wo_svg_path(wo_svg *svg, const wo_pen *pen, const char *fill, const double *x, const double *y,
                 int count);
void wo_svg_dots(wo_svg *svg, const char *colour, double diameter, const double *x, const double *y,
                 int count);
void wo_svg_text(wo_svg *svg, double x, double y, double size, wo_anchor anchor, bool bold,
                 const char *text);
/* Reads upwards. */
void wo_svg_text_up(wo_svg *svg, double x, double y, double size, wo_anchor anchor,
                    const char *text);
/* Open paths and dots until wo_svg_clip_end are cut at the box, in numbers: not every viewer knows
   clip paths. Filled paths and text are not. */
void wo_svg_clip_begin(wo_svg *svg, wo_box box);
void wo_svg_clip_end(wo_svg *svg);

/* Ends the drawing; WO_ERR_NOMEM when there was no memory for some of it. */
WO_NODISCARD wo_status wo_svg_finish(wo_svg *svg, wo_error *error);
void wo_svg_free(wo_svg *svg);

#endif
