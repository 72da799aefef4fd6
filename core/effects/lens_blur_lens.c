/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "effects/lens_blur_plan.h"

#include "optics/lens_choice.h"

#include <math.h>
#include <stdio.h>

/* Tangent of the farthest field point that a table is made for: some 85 degrees. */
#define FIELD_MAX 11.0

/* Rays of the first level when adaptive, but at least so many for each wavelength. */
enum { FIRST_RAYS = 16, FIRST_RAYS_A_LINE = 2 };

static int wavelengths_of(const wo_lens_blur_params *p)
{
    const int most = p->sampling == WO_SAMPLING_ADAPTIVE ? p->max_rays : p->samples;
    return p->wavelengths < most ? p->wavelengths : most;
}

/* Numbers of rays: one, or doubled and doubled until the budget; and what the method wants for
   taps, if none of these will do. */
static void list_lenses(wo_plan *plan, int count[WO_LEVELS_MAX])
{
    const wo_lens_blur_params *p = &plan->params;
    int levels = 0;
    if (p->sampling == WO_SAMPLING_FIXED) {
        count[levels++] = p->samples;
    } else {
        int rays = FIRST_RAYS;
        while (wo_lens_blur_has_table(p) && rays < FIRST_RAYS_A_LINE * wavelengths_of(p))
            rays *= 2;
        for (; levels < WO_LEVELS_MAX - 1 && (levels == 0 || rays < p->max_rays); rays *= 2)
            count[levels++] = rays < p->max_rays ? rays : p->max_rays;
    }
    plan->levels = plan->lenses = levels;
    plan->taps = -1;
    const int wanted = wo_renderer_of((wo_method)p->method)->taps;
    if (wanted == 0)
        return;
    plan->taps = 0;
    while (plan->taps < levels && count[plan->taps] < wanted)
        plan->taps++;
    if (plan->taps == levels)
        count[plan->lenses++] = wanted;
}

/* Those that borrow the table first. */
static void destroy_tables(wo_plan *plan)
{
    for (int i = WO_LEVELS_MAX - 1; i >= 0; i--)
        wo_table_pencils_destroy(&plan->context, &plan->table[i]);
    wo_delete(&plan->context, plan->chosen);
    plan->chosen = NULL;
}

/* Says why rays are traced one by one that were to come from a table. */
static void warn_table(wo_plan *plan)
{
    const wo_table_facts *f = &plan->facts;
    char why[128] = "it lets too few rays through for one";
    if (isfinite(f->rms_px))
        snprintf(why, sizeof why,
                 "the best one is off by %.2g px RMS (at most %g) and by %.2g of the lit iris (at "
                 "most %g)",
                 f->rms_px, WO_TABLE_MOST_PX, f->lit_error, WO_TABLE_MOST_LIT);
    wo_report_warn(
        &plan->report, "lens-table",
        "no table can stand for this lens at f/%.3g: %s. Its rays are traced one by one: "
        "right, but slow. A smaller aperture or field makes it fast",
        plan->f_number, why);
}

/* Any lens but the thin one, through its table. */
static wo_status make_table_lens(wo_plan *plan, wo_error *error)
{
    const wo_lens_blur_params *p = &plan->params;
    const wo_lens_blur_setup *s = &plan->setup;
    const wo_geometry *g = &plan->geometry;
    const wo_rect far = wo_rect_union(g->extent, g->format);
    int count[WO_LEVELS_MAX];
    list_lenses(plan, count);
    const int wavelengths = wavelengths_of(p);
    wo_table_pencil_options options = {
        .aperture = &s->aperture,
        .focal_px = s->lens.focal_px,
        .stretch = g->pixel_stretch,
        .centre_x = 0.5 * (g->format.x1 + g->format.x2),
        .centre_y = 0.5 * (g->format.y1 + g->format.y2),
        .max_reach = s->upright_reach,
        .v_limit = s->v_max,
        .half_diagonal =
            0.5 * hypot(wo_rect_width(g->format), wo_rect_height(g->format) / g->pixel_stretch),
        .doors = {p->door_left, p->door_right, p->door_bottom, p->door_top},
        .count = count[0],
        .wavelengths = wavelengths,
        .exact = p->method == WO_METHOD_REFERENCE,
        .seed = (uint32_t)p->seed,
    };
    const double dx = fmax(far.x2 - options.centre_x, options.centre_x - far.x1);
    const double dy = fmax(far.y2 - options.centre_y, options.centre_y - far.y1);
    const double corner = hypot(dx, dy / g->pixel_stretch) / s->lens.focal_px;
    wo_bands bands;
    wo_bands_make(wavelengths, &bands);
    const wo_lens_choice choice = {
        .kind = (wo_lens_kind)p->lens,
        .design = wo_lens_design(p->lens_design),
        .diagram = (wo_diagram_preset)p->lens_diagram,
        .residual = p->lens_residual,
        .glass = p->lens_glass,
        .bending = p->lens_bending,
        .thickness_mm = p->lens_thickness,
        .focal_mm = p->focal_length,
        .f_number = p->f_stop,
        .cats_eye = p->cats_eye * corner * s->lens.focal_px / options.half_diagonal,
        .best_focus = p->best_focus != 0,
        .vf = s->lens.vf,
        .half_field = fmin(fmax(corner, 1e-3), FIELD_MAX),
        .nm = bands.nm,
        .lines = bands.count,
    };
    wo_chosen_lens *const chosen = wo_new(&plan->context, error, 1, sizeof *chosen);
    if (!chosen)
        return WO_ERR_NOMEM;
    plan->chosen = chosen;
    wo_status status = wo_lens_choose(&choice, chosen, error);
    if (status == WO_OK) {
        options.px_per_dioptre =
            s->lens.k * fmax(1, g->pixel_stretch) * (p->f_stop / fmax(chosen->f_number, p->f_stop));
        status = wo_table_pencils_create(&plan->context, &chosen->model, &options, &plan->table[0],
                                         &plan->facts, error);
        for (int i = 1; status == WO_OK && i < plan->lenses; i++)
            status = wo_table_pencils_again(&plan->context, plan->table[0], &s->aperture, count[i],
                                            &plan->table[i], error);
    }
    plan->f_number = chosen->f_number;
    if (status != WO_OK)
        return status;
    for (int i = 0; i < plan->lenses; i++)
        plan->level[i] = wo_table_pencils_lens(plan->table[i]);
    if (plan->facts.wavelengths < wavelengths)
        wo_report_leave_out(&plan->report, "wavelengths",
                            "colours part by less than a twentieth of a pixel",
                            wavelengths - plan->facts.wavelengths, "wavelengths");
    if (plan->facts.exact && !options.exact)
        warn_table(plan);
    if (plan->facts.step_px > WO_STEP_PX)
        wo_report_warn(
            &plan->report, "lens-steps",
            "the aberrations of this lens change by %.2g px (RMS) over the %d px of a row "
            "that share rays: steps may show there. A larger picture, a smaller aperture "
            "or a longer lens has smaller ones",
            plan->facts.step_px, WO_PENCIL_SERVES);
    if (plan->facts.beyond > 0)
        wo_report_leave_out(&plan->report, "lens rays", "they go farther than the largest blur",
                            100 * plan->facts.beyond, "% of those tried");
    return WO_OK;
}

static wo_status make_lens(wo_plan *plan, wo_error *error)
{
    plan->f_number = plan->params.f_stop;
    if (wo_lens_blur_has_table(&plan->params)) {
        WO_TRY(make_table_lens(plan, error));
        if (!plan->facts.ideal)
            return WO_OK;
        destroy_tables(plan);
        wo_report_leave_out(&plan->report, "table of the lens",
                            "it has no aberrations: a thin lens", 0, "");
    }
    /* Inside the renderer vergence is counted from the focus. */
    wo_thin_lens lens = plan->setup.lens;
    lens.vf = 0;
    int count[WO_LEVELS_MAX];
    list_lenses(plan, count);
    for (int i = 0; i < plan->lenses; i++) {
        WO_TRY(wo_thin_pencils_create(&plan->context, &lens, &plan->setup.aperture,
                                      plan->geometry.pixel_stretch, count[i],
                                      (uint32_t)plan->params.seed, &plan->pencils[i], error));
        plan->level[i] = wo_thin_pencils_lens(plan->pencils[i]);
    }
    return WO_OK;
}

/* The focus gets to know the lens, and the lens the tilt of the focus. */
static void tilt_lens(wo_plan *plan)
{
    wo_focus_fit_lens(&plan->focus, plan->setup.lens.k, wo_lens_slope(&plan->level[0]));
    if (plan->focus.tilt_slope == 0)
        return;
    for (int i = 0; i < plan->lenses; i++) {
        plan->upright[i] = plan->level[i];
        plan->tilted[i] = (wo_tilted_pencils){.inside = &plan->upright[i],
                                              .b = {plan->focus.tilt[0], plan->focus.tilt[1]},
                                              .slope = plan->focus.tilt_slope};
        plan->level[i] = wo_tilted_pencils_lens(&plan->tilted[i]);
    }
    if (plan->focus.tilt_asked > plan->focus.tilt_slope)
        wo_report_leave_out(
            &plan->report, "tilt of the plane of focus", "it would cut through the entrance pupil",
            100 * (1 - plan->focus.tilt_slope / plan->focus.tilt_asked), "% of the slope");
}

static void survey_aperture(wo_plan *plan)
{
    enum { POINTS = 256 };
    wo_aperture_make(&plan->setup.aperture, &plan->aperture);
    double most = 0;
    for (int i = 0; i < POINTS * POINTS; i++)
        most = fmax(most, wo_aperture_density(&plan->aperture, 2 * (i % POINTS + 0.5) / POINTS - 1,
                                              2 * (i / POINTS + 0.5) / POINTS - 1));
    plan->aperture_scale = most > 0 ? 1 / most : 0;
}

wo_status wo_lens_blur_lens_make(wo_plan *plan, wo_error *error)
{
    WO_TRY(make_lens(plan, error));
    if (plan->params.output == WO_OUTPUT_APERTURE)
        survey_aperture(plan);
    tilt_lens(plan);
    plan->lens = plan->level[plan->levels - 1];
    return WO_OK;
}

void wo_lens_blur_lens_destroy(wo_plan *plan)
{
    for (int i = 0; i < WO_LEVELS_MAX; i++)
        wo_thin_pencils_destroy(&plan->context, &plan->pencils[i]);
    destroy_tables(plan);
}
