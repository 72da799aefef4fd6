/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "lens_panels.h"
#include "text_file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { HEAD = 78 };

/* "-" for what the lens does not have. */
static const char *length_text(char *text, size_t size, double value)
{
    char number[32];
    snprintf(text, size, isfinite(value) ? "%s mm" : "%s",
             wo_plot_number(number, sizeof number, value, 3));
    return text;
}

/* A line of the head: smaller where it would not fit into the width, down to three quarters, and
   then cut. */
static void draw_fitting(wo_svg *svg, double y, double size, double width, bool bold,
                         const char *text)
{
    const double room = width - 56, least = 0.75 * size;
    char line[600];
    snprintf(line, sizeof line, "%s", text);
    size = fmax(least, fmin(size, size * room / wo_plot_text_width(text, size, bold)));
    for (size_t length = strlen(line);
         length > 0 && wo_plot_text_width(line, size, bold) > room * 1.0001;) {
        do
            length--;
        while (length > 0 && ((unsigned char)text[length] & 0xC0) == 0x80);
        snprintf(line, sizeof line, "%.*s...", (int)length, text);
    }
    wo_svg_text(svg, 28, y, size, WO_ANCHOR_START, bold, line);
}

static void draw_head(const wo_lens_view *view, wo_svg *svg, double width)
{
    char text[600], efl[40], fno[32], field[32], nm[32], focus[64] = "infinity", metres[32];
    const wo_prescription *const lens = &view->lens;
    if (view->vf > 0)
        snprintf(focus, sizeof focus, "%s m from the entrance pupil",
                 wo_plot_number(metres, sizeof metres, 1 / view->vf, 3));
    draw_fitting(svg, 30, 18, width, true, lens->title[0] ? lens->title : lens->name);
    snprintf(text, sizeof text, "focal length %s, f/%s, half field %s\xC2\xB0, %s nm, object at %s",
             length_text(efl, sizeof efl, view->first[1].efl),
             wo_plot_number(fno, sizeof fno, view->f_number, 2),
             wo_plot_number(field, sizeof field, view->half_field, 1),
             wo_plot_number(nm, sizeof nm, view->nm, 1), focus);
    draw_fitting(svg, 50, 12, width, false, text);
    if (lens->source[0]) {
        snprintf(text, sizeof text, "Source: %s", lens->source);
        draw_fitting(svg, 67, 10, width, false, text);
    }
}

static void draw_seidel(const wo_lens_view *view, wo_svg *svg, wo_box box)
{
    static const char *const names[7] = {
        "S I, spherical aberration",   "S II, coma",      "S III, astigmatism",
        "S IV, field curvature",       "S V, distortion", "C I, axial colour, F to C",
        "C II, lateral colour, F to C"};
    const double ep_d = view->first[1].ep_d;
    wo_seidel seidel;
    double sums[7], colour[2];
    double y = box.y + 18;
    wo_svg_text(svg, box.x + 12, y, 13, WO_ANCHOR_START, true,
                "Seidel sums, object at infinity, \xC2\xB5m");
    if (!wo_lens_has_seidel(view)) {
        wo_svg_text(svg, box.x + 12, y + 22, 11, WO_ANCHOR_START, false,
                    isfinite(ep_d) ? "none: the half field is 89\xC2\xB0 or more"
                                   : "none: no entrance pupil");
        return;
    }
    wo_system_seidel(&view->system, ep_d, view->half_field, &seidel);
    wo_system_chromatic_sums(&view->lens, ep_d, view->half_field, WO_NM_F, WO_NM_C, colour);
    for (int i = 0; i < 7; i++)
        sums[i] = i < 5 ? seidel.s[i] : colour[i - 5];
    for (int i = 0; i < 7; i++) {
        char text[32];
        y += i == 0 ? 22 : 18;
        wo_svg_text(svg, box.x + 12, y, 11, WO_ANCHOR_START, false, names[i]);
        wo_svg_text(svg, box.x + box.w - 16, y, 11, WO_ANCHOR_END, false,
                    wo_plot_number(text, sizeof text, sums[i] * 1000, 2));
    }
}

void wo_panel_data(const wo_lens_view *view, wo_svg *svg, wo_box box)
{
    static const struct {
        const char *name;
        size_t offset;
    } rows[] = {
        {"Focal length", offsetof(wo_first_order, efl)},
        {"Rear focus from the last vertex", offsetof(wo_first_order, bfd)},
        {"Front focus from the first vertex", offsetof(wo_first_order, ffd)},
        {"H from the first vertex", offsetof(wo_first_order, H1)},
        {"H\xE2\x80\xB2 from the last vertex", offsetof(wo_first_order, H2)},
        {"Entrance pupil from the first vertex", offsetof(wo_first_order, ep_z)},
        {"Entrance pupil, diameter", offsetof(wo_first_order, ep_d)},
        {"Exit pupil from the last vertex", offsetof(wo_first_order, xp_z)},
        {"Exit pupil, diameter", offsetof(wo_first_order, xp_d)},
        {"First to last vertex", offsetof(wo_first_order, oal)},
    };
    const double right = box.x + box.w - 16, other = right - 90;
    char title[64], number[32];
    double y = box.y + 18;
    snprintf(title, sizeof title, "First order at %s nm%s",
             wo_plot_number(number, sizeof number, view->nm, 1),
             view->anamorphic ? ", x and y" : "");
    wo_svg_text(svg, box.x + 12, y, 13, WO_ANCHOR_START, true, title);
    y += 6;
    for (size_t i = 0; i < WO_COUNT(rows); i++) {
        y += 18;
        char text[48];
        double value[2];
        for (int m = 0; m < 2; m++)
            value[m] = *(const double *)((const char *)&view->first[m] + rows[i].offset);
        wo_svg_text(svg, box.x + 12, y, 11, WO_ANCHOR_START, false, rows[i].name);
        wo_svg_text(svg, right, y, 11, WO_ANCHOR_END, false,
                    length_text(text, sizeof text, value[1]));
        if (view->anamorphic)
            wo_svg_text(svg, other, y, 11, WO_ANCHOR_END, false,
                        length_text(text, sizeof text, value[0]));
    }
    char text[48];
    wo_svg_text(svg, box.x + 12, y + 18, 11, WO_ANCHOR_START, false, "Last vertex to the sensor");
    wo_svg_text(svg, right, y + 18, 11, WO_ANCHOR_END, false,
                length_text(text, sizeof text, view->image));
    if (view->anamorphic)
        return;
    y += 18;
    wo_svg_text(svg, box.x + 12, y + 18, 11, WO_ANCHOR_START, false, "Petzval radius");
    wo_svg_text(svg, right, y + 18, 11, WO_ANCHOR_END, false,
                length_text(text, sizeof text, wo_lens_petzval_radius(view)));
    draw_seidel(view, svg, (wo_box){box.x, y + 30, box.w, 0});
}

static void draw_all(const wo_lens_view *view, wo_svg *svg)
{
    wo_panel_section(view, svg, (wo_box){16, HEAD, 860, 400});
    wo_panel_data(view, svg, (wo_box){892, HEAD, 370, 400});
    const double y = HEAD + 410, h = 350;
    wo_panel_aberration(view, svg, (wo_box){16, y, 300, h});
    wo_panel_spots(view, svg, (wo_box){322, y, 400, h});
    wo_lens_field_curves curves;
    wo_lens_field_curves_make(view, &curves);
    wo_panel_illumination(view, &curves, svg, (wo_box){728, y, 274, h});
    wo_panel_distortion(view, &curves, svg, (wo_box){1004, y, 260, h});
}

static void draw_field_curves(const wo_lens_view *view, wo_svg *svg, wo_box box)
{
    wo_lens_field_curves curves;
    wo_lens_field_curves_make(view, &curves);
    wo_panel_illumination(view, &curves, svg, (wo_box){box.x, box.y, box.w / 2 - 8, box.h});
    wo_panel_distortion(view, &curves, svg,
                        (wo_box){box.x + box.w / 2 + 8, box.y, box.w / 2 - 8, box.h});
}

wo_status wo_lens_page_save(const wo_lens_view *view, wo_lens_page page, const char *path,
                            wo_error *error)
{
    static const struct {
        const char *name;
        double width, height;
    } pages[] = {
        {"section", 1000, 600},      {"longitudinal aberration", 680, 640},
        {"spot diagrams", 900, 520}, {"illumination and distortion", 900, 500},
        {"lens data", 1280, 856},
    };
    char title[256];
    wo_svg svg;
    if (page != WO_PAGE_SECTION)
        WO_TRY(wo_lens_needs_image(view, error));
    const double w = pages[page].width, h = pages[page].height;
    const wo_box box = {16, HEAD, w - 32, h - HEAD - 12};
    snprintf(title, sizeof title, "%s: %s", view->lens.name, pages[page].name);
    wo_svg_begin(&svg, w, h, title);
    draw_head(view, &svg, w);
    switch (page) {
    case WO_PAGE_SECTION:
        wo_panel_section(view, &svg, box);
        break;
    case WO_PAGE_ABERRATION:
        wo_panel_aberration(view, &svg, box);
        break;
    case WO_PAGE_SPOTS:
        wo_panel_spots(view, &svg, box);
        break;
    case WO_PAGE_VIGNETTING:
        draw_field_curves(view, &svg, box);
        break;
    case WO_PAGE_ALL:
        draw_all(view, &svg);
        break;
    }
    wo_status status = wo_svg_finish(&svg, error);
    if (status == WO_OK)
        status = wo_text_save(path, svg.text, svg.length, error);
    wo_svg_free(&svg);
    return status;
}
