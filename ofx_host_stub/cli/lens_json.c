/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "json.h"
#include "lens_data.h"
#include "lens_panels.h"

#include "wideopen/lens_diagram.h"

#include <math.h>

enum { ZONES = 33 };

static void zones(wo_json *json)
{
    double rho[ZONES];
    for (int i = 0; i < ZONES; i++)
        rho[i] = (double)i / (ZONES - 1);
    wo_json_numbers(json, "zones", rho, ZONES);
}

static void seidel(const wo_lens_view *view, wo_json *json)
{
    wo_seidel sums;
    double colour[2];
    if (!wo_lens_has_seidel(view)) {
        wo_json_text(json, "seidel", NULL);
        return;
    }
    const double ep_d = view->first[1].ep_d;
    wo_system_seidel(&view->system, ep_d, view->half_field, &sums);
    wo_system_chromatic_sums(&view->lens, ep_d, view->half_field, WO_NM_F, WO_NM_C, colour);
    const double wolf[5] = {sums.b, sums.c, sums.d, sums.e, sums.f};
    wo_json_object(json, "seidel");
    wo_json_number(json, "half_field", view->half_field);
    wo_json_numbers(json, "sums", sums.s, 5);
    wo_json_numbers(json, "chromatic_sums", colour, 2);
    wo_json_numbers(json, "born_wolf", wolf, 5);
    wo_json_number(json, "lagrange", sums.lagrange);
    wo_json_close(json);
}

static void aberration(const wo_lens_view *view, wo_json *json)
{
    wo_lens_aberration a;
    wo_lens_aberration_make(view, ZONES, &a);
    wo_json_array(json, "aberration");
    for (int m = 0; m < 2; m++) {
        if (!a.has[m])
            continue;
        wo_json_object(json, NULL);
        wo_json_text(json, "meridian", m == 0 ? "y" : "x");
        wo_json_number(json, "pupil_radius", a.radius[m]);
        zones(json);
        wo_json_array(json, "lines");
        for (int l = 0; l < WO_LENS_LINES; l++) {
            wo_json_object(json, NULL);
            wo_json_number(json, "wavelength", wo_lens_nm[l]);
            wo_json_numbers(json, "focus_shift", a.focus[m][l], ZONES);
            wo_json_numbers(json, "slope", a.slope[m][l], ZONES);
            wo_json_close(json);
        }
        wo_json_close(json);
        wo_json_close(json);
    }
    wo_json_close(json);
}

static void pencils(const wo_lens_view *view, wo_json *json)
{
    wo_diagram diagram;
    wo_error error = {WO_OK, ""};
    wo_json_object(json, "pencils");
    if (wo_diagram_of_lens(&view->lens, 0, view->vf, wo_lens_nm, WO_LENS_LINES, &diagram, &error) !=
        WO_OK) {
        wo_json_text(json, "note", error.text);
        wo_json_close(json);
        return;
    }
    wo_json_number(json, "pupil_radius", diagram.radius);
    zones(json);
    wo_json_array(json, "lines");
    for (int l = 0; l < WO_LENS_LINES; l++) {
        wo_json_object(json, NULL);
        wo_json_number(json, "wavelength", diagram.nm[l]);
        wo_json_numbers(json, "vergence_shift", diagram.shift[l], diagram.zones);
        wo_json_close(json);
    }
    wo_json_close(json);
    wo_json_close(json);
}

static void over_field(const wo_lens_view *view, wo_json *json)
{
    wo_lens_field_curves c;
    wo_lens_field_curves_make(view, &c);
    wo_json_object(json, "field");
    wo_json_numbers(json, "angle", c.field, WO_LENS_FIELD_STEPS);
    wo_json_text(json, "measured_in", view->across == WO_MERIDIAN_X ? "x" : "y");
    wo_json_numbers(json, "lit_iris", c.lit, WO_LENS_FIELD_STEPS);
    wo_json_numbers(json, "illumination", c.illumination, WO_LENS_FIELD_STEPS);
    wo_json_text(json, "distortion_against", c.equidistant ? "angle" : "tangent");
    for (int m = 0; m < 2; m++) {
        if (!c.has[m])
            continue;
        wo_json_numbers(json, m == 0 ? "image_height" : "image_height_x", c.height[m],
                        WO_LENS_FIELD_STEPS);
        wo_json_numbers(json, m == 0 ? "distortion" : "distortion_x", c.distortion[m],
                        WO_LENS_FIELD_STEPS);
    }
    wo_json_close(json);
}

static void spots(const wo_lens_view *view, wo_json *json)
{
    wo_json_array(json, "spots");
    for (int f = 0; f < WO_LENS_FIELDS; f++) {
        const double field = wo_lens_fields[f] * view->half_field;
        wo_json_object(json, NULL);
        wo_json_number(json, "angle", field);
        wo_json_number(json, "rms", wo_lens_spot_rms(view, field));
        wo_json_close(json);
    }
    wo_json_close(json);
}

void wo_lens_print_json(const wo_lens_view *view, const wo_first_order *first, FILE *out)
{
    wo_json json;
    wo_error error = {WO_OK, ""};
    wo_json_begin(&json, out);
    wo_json_object(&json, NULL);
    wo_json_text(&json, "name", view->lens.name);
    wo_json_text(&json, "title", view->lens.title);
    wo_json_text(&json, "source", view->lens.source);
    wo_json_number(&json, "wavelength", view->nm);
    for (size_t i = 0; i < WO_LENS_ROWS; i++)
        wo_json_number(&json, wo_lens_rows[i].key, wo_lens_row(first, i));
    if (view->system.clamped)
        wo_json_text(&json, "note", wo_lens_clamped_note);
    wo_json_number(&json, "oal", first->oal);
    wo_json_number(&json, "f_number", view->f_number);
    wo_json_number(&json, "half_field", view->half_field);
    wo_json_number(&json, "focus", view->vf > 0 ? 1 / view->vf : INFINITY);
    wo_json_number(&json, "image", view->image);
    wo_json_number(&json, "petzval_radius", wo_lens_petzval_radius(view));
    seidel(view, &json);
    if (wo_lens_needs_image(view, &error) == WO_OK) {
        aberration(view, &json);
        pencils(view, &json);
        over_field(view, &json);
        spots(view, &json);
    } else
        wo_json_text(&json, "image_note", error.text);
    wo_json_close(&json);
}
