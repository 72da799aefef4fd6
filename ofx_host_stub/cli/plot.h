/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_PLOT_H
#define WO_CLI_PLOT_H

#include "svg.h"

/* Diagrams on a drawing: axes with round numbers, curves, legends. */

#define WO_TICKS_MAX 24

typedef struct wo_ticks {
    double value[WO_TICKS_MAX];
    int count;
    double step;
    int decimals; /* that tell them apart; -1: too large or too small, written with an exponent */
} wo_ticks;

/* Multiples of 1, 2 or 5 times a power of ten in low..high, about wanted (2..16) of them. Ranges
   that are empty, reversed or no numbers are taken for something near. */
void wo_ticks_make(double low, double high, int wanted, wo_ticks *ticks);

/* 1, 2 and 5 times powers of ten; more of them up to one decade, powers of ten alone beyond five.
   low and high above zero, others are taken for something near. There may be none in a range of
   less than a factor 1.5. step and decimals mean nothing here. */
void wo_ticks_make_log(double low, double high, wo_ticks *ticks);

/* Text of a number, with a point in every locale; decimals as in wo_ticks. Returns text. */
char *wo_plot_number(char *text, size_t size, double value, int decimals);

typedef struct wo_axis {
    double low, high;
    const char *label; /* with its unit; NULL = no ticks either */
    int ticks;         /* about so many; 0 = 5; not of a logarithmic axis */
    bool log;          /* logarithmic: what is not above zero cannot be shown */
} wo_axis;

/* Makes the axis cover the values, as far as they are finite, then round: low and high come to lie
   on ticks. An axis with low > high is empty; on a logarithmic one zero and less do not count. */
void wo_axis_cover(wo_axis *axis, const double *values, int count);
void wo_axis_round(wo_axis *axis);
/* At least so long, about the same middle. */
void wo_axis_widen(wo_axis *axis, double least);

typedef struct wo_plot {
    wo_svg *svg;
    wo_box box; /* of the curves */
    wo_axis x, y;
} wo_plot;

/* A diagram inside box with title (NULL = none) and labels around it; the frame begins 30 px below
   the box's top. */
wo_plot wo_plot_begin(wo_svg *svg, wo_box box, const char *title, wo_axis x, wo_axis y);
double wo_plot_x(const wo_plot *plot, double x);
double wo_plot_y(const wo_plot *plot, double y);
void wo_plot_curve(const wo_plot *plot, const wo_pen *pen, const double *x, const double *y,
                   int count);

/* At most how wide a text is, in a font of the usual proportions. */
double wo_plot_text_width(const char *text, double size, bool bold);

/* A row of pens and names that ends at x. */
void wo_plot_legend(wo_svg *svg, double x, double y, const wo_pen *pens, const char *const *names,
                    int count);

#endif
