/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "lens_panels.h"

#include <math.h>
#include <stdio.h>

#define RADIANS 0.017453292519943295

const wo_pen wo_lens_line_pens[WO_LENS_LINES] = {
    {"#1f4fd8", 1.4, "7 3"}, {"#128a3c", 1.6, NULL}, {"#d0241c", 1.4, "2 2"}};
const char *const wo_lens_line_names[WO_LENS_LINES] = {"F 486 nm", "d 588 nm", "C 656 nm"};
const wo_pen wo_lens_field_pens[WO_LENS_FIELDS] = {
    {"#1f4fd8", 0.9, NULL}, {"#128a3c", 0.9, NULL}, {"#d0241c", 0.9, NULL}};

wo_plot wo_panel_begin(wo_svg *svg, wo_box box, const char *title, wo_axis x, wo_axis y,
                       const wo_pen *pens, const char *const *names, int count)
{
    wo_svg_text(svg, box.x + 12, box.y + 18, 13, WO_ANCHOR_START, true, title);
    wo_plot_legend(svg, box.x + box.w - 16, box.y + 37, pens, names, count);
    box.y += 16;
    box.h -= 16;
    return wo_plot_begin(svg, box, NULL, x, y);
}

/* ----------------------------------------------------------------- longitudinal aberration */

void wo_panel_aberration(const wo_lens_view *view, wo_svg *svg, wo_box box)
{
    wo_lens_aberration a;
    double rho[WO_LENS_ZONES];
    char label[128], number[2][32];
    wo_lens_aberration_make(view, WO_LENS_ZONES, &a);
    for (int i = 0; i < a.zones; i++)
        rho[i] = (double)i / (a.zones - 1);
    wo_axis x = {.low = 0, .high = 0, .label = "Focus shift, mm", .ticks = 5};
    for (int c = 0; c < 2 * WO_LENS_LINES; c++)
        if (a.has[c / WO_LENS_LINES])
            wo_axis_cover(&x, a.focus[c / WO_LENS_LINES][c % WO_LENS_LINES], a.zones);
    wo_axis_widen(&x, 1e-4);
    wo_axis_round(&x);
    for (int m = 0; m < 2; m++)
        wo_plot_number(number[m], sizeof number[m], a.radius[m], 2);
    if (view->anamorphic)
        snprintf(label, sizeof label, "Pupil height (1 = %s mm, in x %s)", number[0], number[1]);
    else
        snprintf(label, sizeof label, "Pupil height (1 = %s mm)", number[0]);
    const wo_axis y = {.low = 0, .high = 1, .label = label, .ticks = 5};
    const wo_plot plot = wo_panel_begin(svg, box,
                                        view->anamorphic ? "Longitudinal aberration (thin: in x)"
                                                         : "Longitudinal aberration",
                                        x, y, wo_lens_line_pens, wo_lens_line_names, WO_LENS_LINES);
    for (int c = 0; c < 2 * WO_LENS_LINES; c++) {
        wo_pen pen = wo_lens_line_pens[c % WO_LENS_LINES];
        if (c >= WO_LENS_LINES)
            pen.width = 0.7;
        if (a.has[c / WO_LENS_LINES])
            wo_plot_curve(&plot, &pen, a.focus[c / WO_LENS_LINES][c % WO_LENS_LINES], rho, a.zones);
    }
}

/* ------------------------------------------------------------------ illumination, distortion */

static wo_axis field_axis(const wo_lens_view *view)
{
    return (wo_axis){.low = 0, .high = view->half_field, .label = "Field, \xC2\xB0", .ticks = 5};
}

void wo_panel_illumination(const wo_lens_view *view, const wo_lens_field_curves *curves,
                           wo_svg *svg, wo_box box)
{
    static const wo_pen pens[3] = {
        {"#404040", 1.2, "6 3"}, {"#c05a00", 1.6, NULL}, {"#a0a0a0", 1, "2 2"}};
    static const char *const names[3] = {"lit part of the iris", "light", "cos\xE2\x81\xB4"};
    double percent[3][WO_LENS_FIELD_STEPS];
    for (int i = 0; i < WO_LENS_FIELD_STEPS; i++) {
        percent[0][i] = 100 * curves->lit[i];
        percent[1][i] = 100 * curves->illumination[i];
        percent[2][i] = curves->field[i] < 90 ? 100 * pow(cos(curves->field[i] * RADIANS), 4) : 0;
    }
    wo_axis y = {.low = 0, .high = 100, .label = "Of the iris; of the axis, %", .ticks = 5};
    wo_axis_cover(&y, percent[0], 2 * WO_LENS_FIELD_STEPS);
    y.high *= y.high > 100.5 ? 1.02 : 1; /* the cover of all: nothing is cut off */
    const wo_plot plot = wo_panel_begin(svg, box,
                                        view->across == WO_MERIDIAN_X ? "Relative illumination in x"
                                                                      : "Relative illumination",
                                        field_axis(view), y, pens, names, 3);
    for (int c = 2; c >= 0; c--)
        wo_plot_curve(&plot, &pens[c], curves->field, percent[c], WO_LENS_FIELD_STEPS);
}

void wo_panel_distortion(const wo_lens_view *view, const wo_lens_field_curves *curves, wo_svg *svg,
                         wo_box box)
{
    static const wo_pen pens[2] = {{"#5a2ca0", 1.6, NULL}, {"#a0602c", 1.4, "6 3"}};
    static const char *const names[2] = {"in y", "in x"};
    double percent[2][WO_LENS_FIELD_STEPS];
    const int count = curves->has[1] ? 2 : 1;
    for (int m = 0; m < count; m++)
        for (int i = 0; i < WO_LENS_FIELD_STEPS; i++)
            percent[m][i] = 100 * curves->distortion[m][i];
    wo_axis x = {.low = 0,
                 .high = 0,
                 .label = curves->equidistant ? "Distortion against f \xCE\xB8, %"
                                              : "Distortion against f tan \xCE\xB8, %",
                 .ticks = 4};
    wo_axis_cover(&x, percent[0], count * WO_LENS_FIELD_STEPS);
    wo_axis_widen(&x, 0.02);
    wo_axis_round(&x);
    const wo_plot plot = wo_panel_begin(svg, box, "Distortion", x, field_axis(view), pens, names,
                                        count == 2 ? 2 : 0);
    for (int c = 0; c < count; c++)
        wo_plot_curve(&plot, &pens[c], percent[c], curves->field, WO_LENS_FIELD_STEPS);
}
