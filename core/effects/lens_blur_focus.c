/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "effects/lens_blur_focus.h"

#include "defocus/sheet.h"

#include <math.h>

/* Half the side of the window that is read around a point, px of the full resolution, and at least
   and at most so many px of the picture. */
#define WINDOW_PX 2.5
enum { WINDOW_LEAST = 1, WINDOW_MOST = 4, SAMPLES = (2 * WINDOW_MOST + 1) * (2 * WINDOW_MOST + 1) };

static int points_of(const wo_lens_blur_params *p)
{
    return p->focus_by == WO_FOCUS_BY_DISTANCE ? 0
           : p->focus_by == WO_FOCUS_BY_POINT  ? 1
                                               : p->focus_points;
}

int wo_lens_blur_handles(const void *params, bool *joined)
{
    const wo_lens_blur_params *p = params;
    *joined = p->focus_by == WO_FOCUS_BY_PLANE;
    return points_of(p);
}

bool wo_lens_blur_focus_is_plain(const wo_lens_blur_params *p, bool has_map)
{
    return p->focus_by == WO_FOCUS_BY_DISTANCE && !has_map && p->field_curvature == 0 &&
           p->protect_near == 0 && p->protect_far == 0 && p->near_gain == 1 && p->far_gain == 1;
}

/* A point in px of the picture, from canonical coordinates. */
static void place(const wo_lens_blur_params *p, const wo_geometry *g, int i, double at[2])
{
    const double unit = g->render_scale / g->pixel_aspect;
    at[0] = p->focus_point[i][0] * unit;
    at[1] = p->focus_point[i][1] * unit * g->pixel_stretch;
}

static double inside(double x, int32_t low, int32_t high)
{
    return fmin(fmax(x, low + 0.5), high - 0.5);
}

static int32_t half_window(double px)
{
    return (int32_t)fmin(fmax(px, WINDOW_LEAST), WINDOW_MOST);
}

/* The window of a point, after the point itself has been moved into the picture. */
static wo_rect window_of(const wo_geometry *g, double at[2])
{
    at[0] = inside(at[0], g->extent.x1, g->extent.x2);
    at[1] = inside(at[1], g->extent.y1, g->extent.y2);
    const int32_t rx = half_window(WINDOW_PX * g->render_scale);
    const int32_t ry = half_window(WINDOW_PX * g->render_scale * g->pixel_stretch);
    const int32_t x = (int32_t)floor(at[0]);
    const int32_t y = (int32_t)floor(at[1]);
    return wo_rect_intersect((wo_rect){x - rx, y - ry, x + rx + 1, y + ry + 1}, g->extent);
}

wo_rect wo_lens_blur_focus_area(const wo_lens_blur_params *params, const wo_geometry *geometry,
                                bool has_map)
{
    wo_rect area = {0};
    if (has_map || wo_rect_empty(geometry->extent))
        return area;
    for (int i = 0; i < points_of(params); i++) {
        double at[2];
        place(params, geometry, i, at);
        const wo_rect window = window_of(geometry, at);
        area = wo_rect_empty(area) ? window : wo_rect_union(area, window);
    }
    return area;
}

/* Vergence under a point: in every pixel the nearest layer's that is there, and of those what
   wo_focus_pick makes of them. What has no depth is infinitely far, as everywhere. */
static double vergence_under(const wo_lens_blur_params *p, const wo_plan_args *args,
                             const wo_lens_blur_setup *setup, const double point[2])
{
    const wo_geometry *g = &args->geometry;
    double at[2] = {point[0], point[1]};
    const wo_rect window = window_of(g, at);
    wo_focus_point samples[SAMPLES];
    int count = 0;
    for (int32_t y = window.y1; y < window.y2; y++) {
        for (int32_t x = window.x1; x < window.x2; x++) {
            double nearest = -1;
            for (int i = 0; i < WO_LENS_BLUR_LAYERS; i++) {
                const wo_image *colour = &args->inputs[2 * i];
                float c[4];
                bool valid;
                if (!setup->layer_used[i] || !colour->data)
                    continue;
                (void)wo_read_colour(colour, args->alpha[2 * i], x, y, c);
                if (c[3] == 0 && c[0] == 0 && c[1] == 0 && c[2] == 0)
                    continue;
                const wo_sheet_source source = {
                    .depth = p->use_depth ? &args->inputs[2 * i + 1] : NULL,
                    .depth_channel = p->depth_channel,
                    .reading = setup->reading,
                    .format = g->format,
                    .focal_px = setup->lens.focal_px,
                    .stretch = g->pixel_stretch,
                };
                nearest = fmax(nearest, wo_read_vergence(&source, x, y, &valid));
            }
            if (nearest >= 0)
                samples[count++] = (wo_focus_point){
                    .x = x + 0.5 - at[0], .y = y + 0.5 - at[1], .v = nearest, .weight = 1};
        }
    }
    return count > 0 ? wo_focus_pick(samples, count) : 0;
}

wo_status wo_lens_blur_focus_make(const wo_lens_blur_params *params, const wo_plan_args *args,
                                  wo_lens_blur_setup *setup, wo_focus *focus, wo_error *error)
{
    const wo_geometry *g = &args->geometry;
    wo_focus_options options = {
        .by = setup->focus_map ? WO_FOCUS_BY_DISTANCE : (wo_focus_by)params->focus_by,
        .vf = setup->lens.vf,
        .falloff = params->focus_falloff,
        .curvature = params->field_curvature,
        .protect_near = params->protect_near,
        .protect_far = params->protect_far,
        .near_gain = params->near_gain,
        .far_gain = params->far_gain,
        .map_is = setup->focus_map ? (wo_focus_map)params->focus_clip : WO_FOCUS_MAP_OFF,
        .map = args->inputs[WO_CLIP_FOCUS],
        .map_scale = g->render_scale,
        .format = g->format,
        .stretch = g->pixel_stretch,
        .count = setup->focus_map ? 0 : points_of(params),
    };
    for (int i = 0; i < options.count; i++) {
        wo_focus_point *point = &options.points[i];
        double at[2];
        place(params, g, i, at);
        wo_focus_place(&options, at[0], at[1], point);
        options.presence[i] = wo_focus_presence(&options, at[0], at[1], params->focus_fade);
        point->weight = params->focus_weight[i] * options.presence[i];
        point->dof = params->focus_dof[i];
        if (point->weight > 0)
            point->v = vergence_under(params, args, setup, at) + params->focus_offset[i];
    }
    wo_focus_make(&options, focus);
    if (options.count == 0)
        return WO_OK;
    double vf = focus->v_axis;
    if (params->breathing)
        vf = fmin(vf, 0.5 / (params->focal_length * 1e-3));
    WO_TRY(wo_thin_lens_make(params->focal_length, params->sensor_width, params->f_stop,
                             fabs(vf) > 1e-9 ? 1 / vf : 0, params->breathing != 0,
                             wo_rect_width(g->format), &setup->lens, error));
    setup->v_max = setup->radius / setup->lens.k;
    setup->v_min = -setup->v_max;
    return WO_OK;
}
