/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_geometry.h"

#include <math.h>

/* Products such as 1920 * (1 / 3.0) miss whole pixels by rounding only. */
static const double slack = 1e-4;

/* INT_MIN and INT_MAX mean "without end", and so does anything that no picture reaches. */
static bool is_finite_side(double v)
{
    return v > -WO_MAX_COORDINATE && v < WO_MAX_COORDINATE;
}

static bool is_finite_region(OfxRectD r)
{
    return is_finite_side(r.x1) && is_finite_side(r.y1) && is_finite_side(r.x2) &&
           is_finite_side(r.y2) && r.x2 > r.x1 && r.y2 > r.y1;
}

static int32_t whole(double v)
{
    return (int32_t)fmin(fmax(v, -WO_MAX_COORDINATE), WO_MAX_COORDINATE);
}

static wo_rect pixels_of(const wo_ofx_action *action, OfxRectD r)
{
    const double sx = action->to_pixels[0], sy = action->to_pixels[1];
    const wo_rect pixels = {whole(floor(r.x1 * sx + slack)), whole(floor(r.y1 * sy + slack)),
                            whole(ceil(r.x2 * sx - slack)), whole(ceil(r.y2 * sy - slack))};
    return wo_rect_empty(pixels) ? (wo_rect){0, 0, 0, 0} : pixels;
}

/* Endless sides of r replaced by those of frame. */
static OfxRectD cut(OfxRectD r, OfxRectD frame)
{
    if (!is_finite_side(r.x1))
        r.x1 = frame.x1;
    if (!is_finite_side(r.y1))
        r.y1 = frame.y1;
    if (!is_finite_side(r.x2))
        r.x2 = frame.x2;
    if (!is_finite_side(r.y2))
        r.y2 = frame.y2;
    return r;
}

/* The project's window, or false if the host says nothing that could be one. */
static bool read_project(const wo_ofx_action *action, OfxRectD *frame)
{
    const wo_ofx_suites *const s = action->suites;
    double size[2] = {0, 0}, offset[2] = {0, 0}, extent[2] = {0, 0};
    wo_ofx_read_doubles(s, action->properties, kOfxImageEffectPropProjectSize, 2, size);
    wo_ofx_read_doubles(s, action->properties, kOfxImageEffectPropProjectOffset, 2, offset);
    wo_ofx_read_doubles(s, action->properties, kOfxImageEffectPropProjectExtent, 2, extent);

    *frame = (OfxRectD){offset[0], offset[1], offset[0] + size[0], offset[1] + size[1]};
    if (size[0] >= 1 && size[1] >= 1 && is_finite_region(*frame))
        return true;
    *frame = (OfxRectD){0, 0, extent[0], extent[1]};
    return extent[0] >= 1 && extent[1] >= 1 && is_finite_region(*frame);
}

static bool read_source(const wo_ofx_action *action, OfxRectD *region)
{
    *region = (OfxRectD){0, 0, 0, 0};
    return wo_ofx_clip_connected(action, 0) &&
           action->suites->effect->clipGetRegionOfDefinition(action->clips[0].handle, action->time,
                                                             region) == kOfxStatOK &&
           region->x2 > region->x1 && region->y2 > region->y1;
}

void wo_ofx_read_geometry(wo_ofx_action *action)
{
    const wo_ofx_suites *const s = action->suites;
    wo_geometry *const geometry = &action->geometry;
    double scale[2] = {1, 1};

    /* Passed on as it comes: some hosts count seconds. */
    action->time = wo_ofx_get_double(s, action->in, kOfxPropTime, 0);

    /* The scale of the action counts; what images say of theirs is not to be trusted. */
    wo_ofx_read_doubles(s, action->in, kOfxImageEffectPropRenderScale, 2, scale);
    for (int i = 0; i < 2; i++)
        action->scale[i] = scale[i] > 1e-6 && scale[i] < 1e6 ? scale[i] : 1;

    double aspect =
        wo_ofx_get_double(s, action->clips[0].properties, kOfxImagePropPixelAspectRatio, 0);
    if (!(aspect > 1e-3 && aspect < 1e3))
        aspect =
            wo_ofx_get_double(s, action->properties, kOfxImageEffectPropProjectPixelAspectRatio, 1);
    action->aspect = aspect > 1e-3 && aspect < 1e3 ? aspect : 1;

    action->to_pixels[0] = action->scale[0] / action->aspect;
    action->to_pixels[1] = action->scale[1];

    OfxRectD frame, region;
    const bool has_frame = read_project(action, &frame);
    const bool has_source = read_source(action, &region);
    if (!has_frame)
        frame = has_source && is_finite_region(region) ? region : (OfxRectD){0, 0, 1, 1};
    action->endless = has_source && !is_finite_region(region);
    region = has_source ? cut(region, frame) : frame;
    if (!is_finite_region(region))
        region = frame;
    action->frame = frame;
    action->region = region;

    *geometry = (wo_geometry)WO_GEOMETRY_INIT;
    geometry->format = pixels_of(action, frame);
    geometry->extent = pixels_of(action, region);
    geometry->render_scale = action->scale[0];
    geometry->pixel_stretch = action->aspect * action->scale[1] / action->scale[0];
    geometry->pixel_aspect = action->aspect;
    for (size_t i = 0; i < action->effect->clip_count; i++)
        geometry->connected[i] = wo_ofx_clip_connected(action, i);
}

wo_rect wo_ofx_to_pixels(const wo_ofx_action *action, OfxRectD region)
{
    const wo_rect all = wo_rect_union(action->geometry.format, action->geometry.extent);
    return pixels_of(action, cut(region, wo_ofx_to_canonical(action, all)));
}

/* The same but for rounding. */
static bool is_near(wo_rect a, wo_rect b)
{
    return wo_rect_contains(wo_rect_grow(a, 1, 1), b) && wo_rect_contains(wo_rect_grow(b, 1, 1), a);
}

/* Where an image says that its clip has pixels; empty where it does not say. */
static wo_rect defined_by(const wo_ofx_action *action, OfxPropertySetHandle image)
{
    int sides[4];
    if (!wo_ofx_read_ints(action->suites, image, kOfxImagePropRegionOfDefinition, 4, sides))
        return (wo_rect){0, 0, 0, 0};
    const wo_rect defined = {sides[0], sides[1], sides[2], sides[3]};
    return wo_rect_empty(defined) ? (wo_rect){0, 0, 0, 0} : defined;
}

void wo_ofx_adopt_extent(wo_ofx_action *action, OfxPropertySetHandle image)
{
    const wo_rect theirs = defined_by(action, image);
    if (!wo_rect_empty(theirs) && is_near(action->geometry.extent, theirs))
        action->geometry.extent = theirs;
}

bool wo_ofx_adopt_pixels(wo_ofx_action *action, OfxPropertySetHandle image, wo_rect bounds)
{
    const wo_rect extent = action->geometry.extent, defined = defined_by(action, image);
    const double kept[2] = {action->to_pixels[0], action->to_pixels[1]};
    if (wo_rect_empty(bounds) || wo_rect_contains(wo_rect_grow(extent, 1, 1), bounds))
        return false;
    action->to_pixels[0] = action->to_pixels[1] = 1;
    const wo_rect raw = pixels_of(action, action->region);
    if (is_near(raw, bounds) || (!wo_rect_empty(defined) && is_near(raw, defined))) {
        action->geometry.extent = raw;
        /* The project may be as the standard has it nevertheless. */
        if (!is_near(action->geometry.format, raw))
            action->geometry.format = pixels_of(action, action->frame);
        return true;
    }
    action->to_pixels[0] = kept[0];
    action->to_pixels[1] = kept[1];
    return false;
}

void wo_ofx_adopt_source(wo_ofx_action *action, OfxPropertySetHandle image, wo_rect bounds)
{
    const wo_rect defined = defined_by(action, image);
    if (wo_rect_empty(bounds) || wo_ofx_adopt_pixels(action, image, bounds) || action->endless)
        return;
    const wo_rect there = wo_rect_empty(defined) ? bounds : defined;
    if (!wo_rect_contains(wo_rect_grow(action->geometry.extent, 1, 1), there))
        action->geometry.extent = wo_rect_union(action->geometry.extent, there);
}

bool wo_ofx_clip_extent(const wo_ofx_action *action, size_t clip, wo_rect *extent)
{
    OfxRectD region = {0, 0, 0, 0};
    if (action->suites->effect->clipGetRegionOfDefinition(action->clips[clip].handle, action->time,
                                                          &region) != kOfxStatOK)
        return false;
    *extent = wo_ofx_to_pixels(action, region);
    return !wo_rect_empty(*extent);
}

/* Largest part of first..end inside low..high, at least one wide. */
static void slide(int32_t *first, int32_t *end, int32_t low, int32_t high)
{
    *first = *first < low ? low : *first > high - 1 ? high - 1 : *first;
    *end = *end < low + 1 ? low + 1 : *end > high ? high : *end;
}

wo_rect wo_ofx_visible(wo_rect needed, wo_rect all)
{
    if (wo_rect_empty(needed))
        return (wo_rect){0, 0, 0, 0};
    slide(&needed.x1, &needed.x2, all.x1, all.x2);
    slide(&needed.y1, &needed.y2, all.y1, all.y2);
    return needed;
}

OfxRectD wo_ofx_to_canonical(const wo_ofx_action *action, wo_rect pixels)
{
    const double sx = 1 / action->to_pixels[0], sy = 1 / action->to_pixels[1];
    return (OfxRectD){pixels.x1 * sx, pixels.y1 * sy, pixels.x2 * sx, pixels.y2 * sy};
}
