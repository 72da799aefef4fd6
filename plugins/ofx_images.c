/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_images.h"

#include "ofx_geometry.h"

#include <string.h>

static bool read_depth(const char *text, wo_depth *depth)
{
    static const char *const names[] = {kOfxBitDepthByte, kOfxBitDepthShort, kOfxBitDepthHalf,
                                        kOfxBitDepthFloat};
    for (size_t i = 0; i < WO_COUNT(names); i++)
        if (text && strcmp(text, names[i]) == 0) {
            *depth = (wo_depth)i;
            return true;
        }
    return false;
}

static int32_t component_count(const char *text)
{
    return !text                                        ? 0
           : strcmp(text, kOfxImageComponentRGBA) == 0  ? 4
           : strcmp(text, kOfxImageComponentRGB) == 0   ? 3
           : strcmp(text, kOfxImageComponentAlpha) == 0 ? 1
                                                        : 0;
}

/* Reads an image's own description; what the clip said before is not relied on. data stays NULL
   where the image has no pixels. */
static wo_status inspect(wo_ofx_action *action, const char *name, wo_ofx_image *image)
{
    const wo_ofx_suites *const s = action->suites;
    wo_pixels *const p = &image->pixels;
    int bounds[4] = {0, 0, 0, 0};

    void *const data = wo_ofx_get_pointer(s, image->handle, kOfxImagePropData);
    wo_ofx_read_ints(s, image->handle, kOfxImagePropBounds, 4, bounds);
    p->bounds = (wo_rect){bounds[0], bounds[1], bounds[2], bounds[3]};
    if (!data || wo_rect_empty(p->bounds))
        return WO_OK;

    const char *const depth = wo_ofx_get_string(s, image->handle, kOfxImageEffectPropPixelDepth);
    const char *const components =
        wo_ofx_get_string(s, image->handle, kOfxImageEffectPropComponents);
    p->components = component_count(components);
    if (p->components == 0)
        return wo_fail(&action->error, WO_ERR_FORMAT, "%s: images of %.80s are not known", name,
                       components ? components : "no components");
    if (!read_depth(depth, &p->depth))
        return wo_fail(&action->error, WO_ERR_FORMAT, "%s: pixels of %.80s are not known", name,
                       depth ? depth : "no depth");

    const int64_t row =
        (int64_t)wo_rect_width(p->bounds) * p->components * (int64_t)wo_depth_bytes(p->depth);
    p->row_bytes = wo_ofx_get_int(s, image->handle, kOfxImagePropRowBytes, 0);
    if (wo_rect_height(p->bounds) > 1 && p->row_bytes < row && p->row_bytes > -row)
        return wo_fail(&action->error, WO_ERR_FORMAT,
                       "%s: rows of %td bytes overlap, %lld are needed", name, p->row_bytes,
                       (long long)row);
    p->data = data;
    return WO_OK;
}

/* Whether the core can look at the host's floats. */
static bool is_borrowable(const wo_pixels *p, uint32_t accepted)
{
    const uint32_t kind = p->components == 4   ? WO_COMPONENT_RGBA
                          : p->components == 3 ? WO_COMPONENT_RGB
                                               : WO_COMPONENT_ALPHA;
    return p->depth == WO_DEPTH_FLOAT && (accepted & kind) &&
           (uintptr_t)p->data % sizeof(float) == 0 &&
           (wo_rect_height(p->bounds) == 1 || p->row_bytes % (ptrdiff_t)sizeof(float) == 0);
}

/* Components of a copy: those of the image if the clip takes them, else the nearest it does. */
static int32_t best_components(int32_t have, uint32_t accepted)
{
    const bool one = accepted & WO_COMPONENT_ALPHA, three = accepted & WO_COMPONENT_RGB,
               four = accepted & WO_COMPONENT_RGBA;
    if ((have == 1 && one) || (have == 3 && three) || (have == 4 && four))
        return have;
    return four ? 4 : three ? 3 : 1;
}

/* The part of a view inside a window, which its bounds hold. */
static wo_image part_of(const wo_image *image, wo_rect window)
{
    return (wo_image){wo_image_at(image, window.x1, window.y1), window, image->row_bytes,
                      image->components};
}

static wo_image borrowed(const wo_pixels *p, wo_rect window)
{
    const wo_image whole = {p->data, p->bounds, p->row_bytes, p->components};
    return part_of(&whole, window);
}

/* Own memory for a view of the window. */
static wo_status own_view(wo_ofx_action *action, const char *name, wo_ofx_image *image,
                          wo_rect window, int32_t components)
{
    const size_t row = (size_t)wo_rect_width(window) * (size_t)components;
    if (wo_rect_width(window) > WO_MAX_SIDE || wo_rect_height(window) > WO_MAX_SIDE)
        return wo_fail(&action->error, WO_ERR_RANGE, "%s: %dx%d pixels are too many", name,
                       (int)wo_rect_width(window), (int)wo_rect_height(window));
    image->own = wo_new(&action->context, &action->error, (size_t)wo_rect_height(window),
                        row * sizeof(float));
    if (!image->own)
        return action->error.status;
    image->view = (wo_image){image->own, window, (ptrdiff_t)(row * sizeof(float)), components};
    return WO_OK;
}

static wo_alpha alpha_of(const wo_ofx_action *action, size_t clip, const wo_ofx_image *image)
{
    const wo_ofx_suites *const s = action->suites;
    const char *state = wo_ofx_get_string(s, image->handle, kOfxImageEffectPropPreMultiplication);
    if (!state)
        state = wo_ofx_get_string(s, action->clips[clip].properties,
                                  kOfxImageEffectPropPreMultiplication);
    /* Where the view's alpha is made up, it is 1. */
    if (image->pixels.components == 3 ||
        (image->pixels.components == 1 && image->view.components != 1) ||
        (state && strcmp(state, kOfxImageOpaque) == 0))
        return WO_ALPHA_OPAQUE;
    return state && strcmp(state, kOfxImageUnPreMultiplied) == 0 ? WO_ALPHA_UNPREMULTIPLIED
                                                                 : WO_ALPHA_PREMULTIPLIED;
}

/* Fetches the image and reads its description; region NULL leaves the choice to the host, which
   knows the regions of interest. */
static wo_status fetch(wo_ofx_action *action, size_t clip, const OfxRectD *region,
                       wo_ofx_image *image)
{
    const OfxStatus status = action->suites->effect->clipGetImage(
        action->clips[clip].handle, action->time, region, &image->handle);
    if (status != kOfxStatOK)
        image->handle = NULL;
    if (status == kOfxStatErrMemory)
        return wo_fail(&action->error, WO_ERR_NOMEM, "%s: the host has no memory for the image",
                       action->effect->clips[clip].name);
    if (!image->handle) /* Failed means: take it as not there */
        return WO_OK;
    return inspect(action, action->effect->clips[clip].name, image);
}

/* Whether an image holds what is seen of its clip through needed; hosts round the sides of regions
   in their own ways, hence the one pixel of grace. */
static bool suffices(const wo_ofx_action *action, size_t clip, const wo_ofx_image *image,
                     wo_rect needed, wo_rect *wanted)
{
    wo_rect extent;
    int sides[4];
    if (!wo_ofx_clip_extent(action, clip, &extent))
        return true;
    if (wo_ofx_read_ints(action->suites, image->handle, kOfxImagePropRegionOfDefinition, 4,
                         sides)) {
        const wo_rect all = {sides[0], sides[1], sides[2], sides[3]};
        if (!wo_rect_empty(all))
            extent = all;
    }
    *wanted = wo_ofx_visible(needed, extent);
    return wo_rect_contains(wo_rect_grow(image->pixels.bounds, 1, 1), *wanted);
}

/* Where a clip ends within the frame of Source there is nothing: no colour, no alpha, no mask. The
   core repeats edges, which is right for Source and for data only; such clips get a border of
   zeros. */
static bool ends_inside(const wo_ofx_action *action, size_t clip, wo_rect seen)
{
    wo_rect extent;
    return clip > 0 && !action->effect->clips[clip].data &&
           wo_ofx_clip_extent(action, clip, &extent) && !wo_rect_contains(extent, seen);
}

/* A copy of what the image holds of the window, zero elsewhere. Where there is an alpha it tells
   the picture from the border. */
static wo_status copy_with_border(wo_ofx_action *action, size_t clip, wo_ofx_image *image,
                                  wo_rect window)
{
    const wo_clip *const about = &action->effect->clips[clip];
    const bool alpha = about->components & WO_COMPONENT_RGBA && image->pixels.components != 1;
    WO_TRY(own_view(action, about->name, image, window,
                    alpha ? 4 : best_components(image->pixels.components, about->components)));
    const wo_rect inside = wo_rect_intersect(window, image->pixels.bounds);
    image->alpha = alpha_of(action, clip, image);
    if (wo_rect_empty(inside))
        return WO_OK;
    const wo_image part = part_of(&image->view, inside);
    wo_pixels_read(&image->pixels, &part);
    if (part.components == 4 && image->alpha == WO_ALPHA_OPAQUE)
        for (int32_t y = inside.y1; y < inside.y2; y++)
            for (int32_t x = inside.x1; x < inside.x2; x++)
                wo_image_at(&part, x, y)[3] = 1;
    return WO_OK;
}

static wo_status make_view(wo_ofx_action *action, size_t clip, wo_rect needed, wo_ofx_image *image)
{
    const wo_clip *const about = &action->effect->clips[clip];
    const wo_rect window = wo_ofx_visible(needed, image->pixels.bounds);
    const wo_rect seen = wo_rect_intersect(needed, action->geometry.extent);

    if (ends_inside(action, clip, seen)) {
        const wo_rect held = wo_rect_intersect(needed, image->pixels.bounds);
        WO_TRY(copy_with_border(action, clip, image, wo_rect_union(seen, held)));
        if (image->alpha == WO_ALPHA_OPAQUE && image->view.components == 4)
            image->alpha = WO_ALPHA_PREMULTIPLIED;
        return WO_OK;
    }
    if (is_borrowable(&image->pixels, about->components)) {
        image->view = borrowed(&image->pixels, window);
    } else {
        WO_TRY(own_view(action, about->name, image, window,
                        best_components(image->pixels.components, about->components)));
        wo_pixels_read(&image->pixels, &image->view);
    }
    image->alpha = alpha_of(action, clip, image);
    return WO_OK;
}

wo_status wo_ofx_open_input(wo_ofx_action *action, size_t clip, wo_rect needed, wo_ofx_image *image)
{
    *image = (wo_ofx_image){.handle = NULL};
    if (!action->geometry.connected[clip] || wo_rect_empty(needed))
        return WO_OK;
    WO_TRY(fetch(action, clip, NULL, image));

    /* A host that never asked for regions of interest may have chosen too little. */
    wo_rect wanted = {0, 0, 0, 0};
    if (image->pixels.data && !suffices(action, clip, image, needed, &wanted)) {
        const OfxRectD region = wo_ofx_to_canonical(action, wanted);
        wo_ofx_image again = {.handle = NULL};
        const wo_status status = fetch(action, clip, &region, &again);
        if (status == WO_OK && again.pixels.data &&
            suffices(action, clip, &again, needed, &wanted)) {
            wo_ofx_close(action, image);
            *image = again;
        } else {
            wo_ofx_close(action, &again);
            WO_TRY(status);
        }
    }
    if (!image->pixels.data)
        return WO_OK;

    WO_TRY(make_view(action, clip, needed, image));
    return wo_image_validate(&image->view, action->effect->clips[clip].name, &action->error);
}

wo_status wo_ofx_look_at_source(wo_ofx_action *action)
{
    wo_ofx_image image = {.handle = NULL};
    if (!action->geometry.connected[0])
        return WO_OK;
    const wo_status status = fetch(action, 0, NULL, &image);
    if (status == WO_OK && image.pixels.data)
        wo_ofx_adopt_source(action, image.handle, image.pixels.bounds);
    wo_ofx_close(action, &image);
    return status;
}

wo_status wo_ofx_open_output(wo_ofx_action *action, wo_rect *window, wo_ofx_image *image)
{
    const wo_ofx_suites *const s = action->suites;
    OfxImageClipHandle clip = NULL;
    *image = (wo_ofx_image){.handle = NULL};

    if (s->effect->clipGetHandle(action->handle, kOfxImageEffectOutputClipName, &clip, NULL) !=
            kOfxStatOK ||
        s->effect->clipGetImage(clip, action->time, NULL, &image->handle) != kOfxStatOK ||
        !image->handle) {
        image->handle = NULL;
        return wo_fail(&action->error, WO_ERR_NOT_FOUND, "the host gives no image to render into");
    }
    WO_TRY(inspect(action, kOfxImageEffectOutputClipName, image));
    *window = wo_rect_intersect(*window, image->pixels.bounds);
    if (!image->pixels.data || wo_rect_empty(*window)) {
        *window = (wo_rect){0, 0, 0, 0};
        return WO_OK;
    }
    if (is_borrowable(&image->pixels, WO_COMPONENT_RGBA)) {
        image->view = borrowed(&image->pixels, *window);
        return wo_image_validate(&image->view, kOfxImageEffectOutputClipName, &action->error);
    }
    return own_view(action, kOfxImageEffectOutputClipName, image, *window, 4);
}

void wo_ofx_finish_output(const wo_ofx_image *image)
{
    if (image->own)
        wo_pixels_write(&image->view, &image->pixels);
}

void wo_ofx_clear_output(const wo_ofx_image *image)
{
    const wo_rect bounds = image->view.bounds;
    const size_t bytes = (size_t)wo_rect_width(bounds) * 4 * sizeof(float);
    for (int32_t y = bounds.y1; y < bounds.y2; y++)
        memset(wo_image_at(&image->view, bounds.x1, y), 0, bytes);
}

void wo_ofx_close(wo_ofx_action *action, wo_ofx_image *image)
{
    wo_delete(&action->context, image->own);
    if (image->handle)
        action->suites->effect->clipReleaseImage(image->handle);
    *image = (wo_ofx_image){.handle = NULL};
}
