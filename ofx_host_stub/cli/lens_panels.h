/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_LENS_PANELS_H
#define WO_CLI_LENS_PANELS_H

#include "lens_curves.h"
#include "plot.h"

/* Drawings of a lens, each inside a box of a page. All but the section need an image. */

void wo_panel_section(const wo_lens_view *view, wo_svg *svg, wo_box box);
void wo_panel_aberration(const wo_lens_view *view, wo_svg *svg, wo_box box);
void wo_panel_spots(const wo_lens_view *view, wo_svg *svg, wo_box box);
void wo_panel_illumination(const wo_lens_view *view, const wo_lens_field_curves *curves,
                           wo_svg *svg, wo_box box);
void wo_panel_distortion(const wo_lens_view *view, const wo_lens_field_curves *curves, wo_svg *svg,
                         wo_box box);
void wo_panel_data(const wo_lens_view *view, wo_svg *svg, wo_box box);

/* A diagram with the legend in a row of its own. */
wo_plot wo_panel_begin(wo_svg *svg, wo_box box, const char *title, wo_axis x, wo_axis y,
                       const wo_pen *pens, const char *const *names, int count);

/* Pens of the F, d and C lines and of the three fields. */
extern const wo_pen wo_lens_line_pens[WO_LENS_LINES];
extern const char *const wo_lens_line_names[WO_LENS_LINES];
extern const wo_pen wo_lens_field_pens[WO_LENS_FIELDS];

/* A page of panels, to a file. */
typedef enum wo_lens_page {
    WO_PAGE_SECTION,
    WO_PAGE_ABERRATION,
    WO_PAGE_SPOTS,
    WO_PAGE_VIGNETTING,
    WO_PAGE_ALL
} wo_lens_page;
WO_NODISCARD wo_status wo_lens_page_save(const wo_lens_view *view, wo_lens_page page,
                                         const char *path, wo_error *error);

/* A picture of the bokeh on the axis and off it, through focus. */
WO_NODISCARD wo_status wo_lens_strip_save(const wo_lens_view *view, const char *path,
                                          wo_error *error);

/* The pencil map of the axial bundle at F, d and C, heights in micrometres on the sensor. */
WO_NODISCARD wo_status wo_lens_pencil_map_save(const wo_lens_view *view, const char *path,
                                               wo_error *error);

#endif
