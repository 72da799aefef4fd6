/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "effects/lens_blur.h"

#include "defocus/renderer.h"
#include "effects/lens_blur_focus.h"
#include "effects/lens_blur_plan.h"
#include "optics/lens_choice.h"

#include <math.h>

/* Hidden surfaces are continued so many times as far as the largest radius, rounded up to a power
   of two; beyond 2^FILL_LEVELS_MAX px they are unknown. */
enum { FILL_LEVELS_MAX = 9 };

/* Of a star without blades. */
enum { WO_STAR_POINTS = 5 };

/* px that loading, repair, splitting and seeding look beyond a pixel, one after the other. */
#define INPUT_MARGIN (WO_SHEET_LOAD_MARGIN + WO_SHEET_REPAIR_MARGIN + WO_SHEET_SPLIT_MARGIN + 1)

bool wo_lens_blur_has_table(const wo_lens_blur_params *p)
{
    return p->lens != WO_LENS_THIN || p->cats_eye != 0 || p->door_left != 0 || p->door_right != 0 ||
           p->door_bottom != 0 || p->door_top != 0;
}

wo_status wo_lens_blur_prepare(const wo_lens_blur_params *wanted, const wo_geometry *geometry,
                               wo_lens_blur_setup *setup, wo_error *error)
{
    wo_lens_blur_params own = *wanted;
    const wo_lens_blur_params *const params = &own;
    *setup = (wo_lens_blur_setup){0};
    wo_lens_blur_use_camera(&own, &geometry->camera, NULL);
    WO_TRY(wo_params_validate(wo_lens_blur_table, WO_LENS_BLUR_PARAMS, params, error));
    const double width = wo_rect_width(geometry->format);
    WO_TRY(wo_thin_lens_make(params->focal_length, params->sensor_width, params->f_stop,
                             params->focus_distance, params->breathing != 0, width, &setup->lens,
                             error));
    const bool star = params->aperture_form == WO_APERTURE_STAR;
    setup->aperture = (wo_aperture){
        .blades = params->blades >= 3 ? params->blades
                  : star              ? WO_STAR_POINTS
                                      : 0,
        .curvature = params->curvature,
        .rotation = params->rotation,
        .aspect = params->aspect,
        .form = (wo_aperture_form)params->aperture_form,
        .opening = params->opening,
        .obstruction = params->obstruction,
        .apodization = params->apodization,
        .edge = params->edge,
        .ring_amount = params->ring_amount,
        .ring_count = params->ring_count,
        .grain_amount = params->grain_amount,
        .grain_seed = (uint32_t)params->grain_seed,
    };
    setup->reading = (wo_depth_reading){(wo_depth_mode)params->depth_mode, params->depth_scale,
                                        params->depth_near, params->depth_far};
    for (int i = 0; i < WO_LENS_BLUR_LAYERS; i++) {
        setup->layer_used[i] = i < params->layers && (i == 0 || geometry->connected[2 * i]);
        setup->layers += setup->layer_used[i];
        setup->has_depth |=
            setup->layer_used[i] && params->use_depth && geometry->connected[2 * i + 1];
    }
    setup->background_used = setup->has_depth && geometry->connected[WO_CLIP_BACKGROUND];
    setup->mask_used = params->use_mask && geometry->connected[WO_CLIP_MASK];
    setup->focus_map = params->focus_clip != WO_FOCUS_MAP_OFF && geometry->connected[WO_CLIP_FOCUS];

    double radius = params->max_radius * geometry->render_scale;
    const double at_infinity = setup->lens.k * fabs(setup->lens.vf);
    if (!wo_lens_blur_focus_is_plain(params, setup->focus_map))
        ; /* what is in focus takes pixels to know */
    else if (!setup->has_depth)
        radius = fmin(radius, at_infinity);
    else if (params->depth_mode == WO_DEPTH_NORMALISED)
        radius = fmin(
            radius, fmax(at_infinity, fmax(wo_thin_lens_coc(&setup->lens, 1 / params->depth_near),
                                           wo_thin_lens_coc(&setup->lens, 1 / params->depth_far))));
    setup->radius = radius;
    setup->reach = params->lens == WO_LENS_THIN ? radius : 1.25 * radius + 0.06 * width;
    setup->reach *= fmax(1, geometry->pixel_stretch);
    setup->upright_reach = setup->reach;
    if (params->focus_by == WO_FOCUS_BY_PLANE && !setup->focus_map)
        setup->reach /= 1 - WO_FOCUS_TILT_MAX;
    setup->margin = wo_renderer_of((wo_method)params->method)->margin;
    setup->v_max = radius / setup->lens.k;
    setup->v_min = -setup->v_max;
    if ((setup->has_depth || setup->focus_map) && radius >= WO_SHARP_PX) {
        setup->fill_levels = 1;
        while (setup->fill_levels < FILL_LEVELS_MAX && ldexp(1, setup->fill_levels) < radius)
            setup->fill_levels++;
    }
    return WO_OK;
}

static int32_t floor_to(int32_t x, int32_t grid)
{
    const int32_t r = x % grid;
    return x - (r < 0 ? r + grid : r);
}

static wo_rect on_grid(wo_rect r, int32_t grid_x, int32_t grid_y)
{
    return (wo_rect){floor_to(r.x1, grid_x), floor_to(r.y1, grid_y),
                     floor_to(r.x2 + grid_x - 1, grid_x), floor_to(r.y2 + grid_y - 1, grid_y)};
}

wo_rect wo_lens_blur_stack_area(const wo_lens_blur_setup *setup, wo_rect window, double reach)
{
    const int32_t margin = (int32_t)ceil(reach) + WO_STACK_MARGIN;
    const wo_rect tiles =
        on_grid(wo_rect_grow(window, setup->margin, setup->margin), WO_TILE_WIDTH, WO_TILE_HEIGHT);
    return wo_stack_grid(wo_rect_grow(tiles, margin, margin));
}

wo_rect wo_lens_blur_layers_area(const wo_lens_blur_setup *setup, wo_rect window)
{
    /* Hosts ask for windows without end; no picture goes beyond this. */
    const wo_rect known = {-WO_MAX_COORDINATE, -WO_MAX_COORDINATE, WO_MAX_COORDINATE,
                           WO_MAX_COORDINATE};
    window = wo_rect_intersect(window, known);
    if (wo_rect_empty(window))
        return (wo_rect){0};
    const wo_rect stack = wo_lens_blur_stack_area(setup, window, setup->reach);
    /* Highlights are told from areas of light by whole tiles and those around them. */
    wo_rect area =
        wo_rect_grow(on_grid(stack, WO_TILE_WIDTH, WO_TILE_HEIGHT), WO_TILE_WIDTH, WO_TILE_HEIGHT);
    if (setup->fill_levels > 0) {
        const int32_t fill = wo_sheet_fill_margin(setup->fill_levels);
        const int32_t grid = (int32_t)1 << setup->fill_levels;
        area = on_grid(wo_rect_grow(area, fill, fill), grid, grid);
        area = wo_rect_grow(area, INPUT_MARGIN, INPUT_MARGIN);
    }
    return area;
}

static wo_status region(const void *params, const wo_geometry *geometry, wo_rect window,
                        size_t clip, wo_rect *needed, wo_error *error)
{
    wo_lens_blur_setup setup;
    *needed = (wo_rect){0};
    WO_TRY(wo_lens_blur_prepare(params, geometry, &setup, error));
    if (clip == WO_CLIP_MASK) {
        if (setup.mask_used)
            *needed = window;
        return WO_OK;
    }
    if (clip == WO_CLIP_FOCUS) {
        if (setup.focus_map)
            *needed = wo_lens_blur_layers_area(&setup, window);
        return WO_OK;
    }
    const bool plate = clip == WO_CLIP_BACKGROUND || clip == WO_CLIP_BACKGROUND_DEPTH;
    if (plate ? setup.background_used : clip < WO_CLIP_MASK && setup.layer_used[clip / 2]) {
        const wo_rect points = wo_lens_blur_focus_area(params, geometry, setup.focus_map);
        *needed = wo_lens_blur_layers_area(&setup, window);
        if (!wo_rect_empty(points) && !wo_rect_empty(*needed))
            *needed = wo_rect_union(*needed, points);
    }
    return WO_OK;
}

static int identity(const void *params, const wo_geometry *geometry)
{
    const wo_lens_blur_params *p = params;
    wo_lens_blur_setup setup;
    if (wo_lens_blur_prepare(p, geometry, &setup, NULL) != WO_OK)
        return -1;
    return p->output == WO_OUTPUT_IMAGE && p->lens == WO_LENS_THIN && setup.layers == 1 &&
                   setup.radius < WO_SHARP_PX
               ? WO_CLIP_SOURCE
               : -1;
}

const wo_effect wo_lens_blur = {
    .name = "LensBlur",
    .label = "Lens Blur",
    .help = "Depth of field of a real lens for a picture that was rendered or shot through a "
            "pinhole: every pixel is a bundle of lens rays through the picture and its depth. "
            "Layers hold what the picture hides; what no layer holds is invented and reported.",
    .params_size = sizeof(wo_lens_blur_params),
    .params = wo_lens_blur_table,
    .param_count = WO_LENS_BLUR_PARAMS,
    .groups = wo_lens_blur_groups,
    .group_count = WO_LENS_BLUR_GROUPS,
    .clips = wo_lens_blur_clips,
    .clip_count = WO_LENS_BLUR_CLIPS,
    .region = region,
    .identity = identity,
    .handles = wo_lens_blur_handles,
    .plan_create = wo_lens_blur_plan_create,
    .plan_print = wo_lens_blur_plan_print,
    .plan_report = wo_lens_blur_plan_report,
    .render = wo_lens_blur_render,
    .plan_destroy = wo_lens_blur_plan_destroy,
};
