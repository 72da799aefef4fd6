/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "internal.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LARGER_X 5 /* WO_HOST_LARGER_IMAGES */
#define LARGER_Y 3

wo_status wo_fetch_pixels(wo_port *port, double time, const double scale[2], const wo_image *image,
                          wo_error *error)
{
    const wo_host_source *source = &port->source;
    const wo_host_request request = {
        .time = time, .scale_x = scale[0], .scale_y = scale[1], .region = image->bounds};
    if (source->components == image->components)
        return source->pixels(source->user, &request, image, error);
    wo_buffer raw;
    if (!wo_buffer_make(port->owner->host, &raw, image->bounds, source->components))
        return wo_fail(error, WO_ERR_NOMEM, "no memory for pixels of %.60s", port->name);
    const wo_status status = source->pixels(source->user, &request, &raw.view, error);
    if (status == WO_OK)
        wo_copy_window(&raw.view, image, image->bounds);
    wo_buffer_free(&raw);
    return status;
}

static const char *alpha_text(wo_host_alpha alpha)
{
    static const char *const texts[] = {kOfxImageOpaque, kOfxImagePreMultiplied,
                                        kOfxImageUnPreMultiplied};
    return texts[alpha];
}

/* Remembers the first failure of a source; the render that needed it fails with its text. */
static void keep_error(wo_host_instance *instance, const wo_error *error, wo_status status)
{
    pthread_mutex_lock(&instance->lock);
    if (instance->source_error.status == WO_OK) {
        instance->source_error = *error;
        instance->source_error.status = status;
    }
    pthread_mutex_unlock(&instance->lock);
}

static void set_rect(wo_props *props, const char *name, wo_rect r)
{
    wo_props_set_int(props, name, 0, r.x1);
    wo_props_set_int(props, name, 1, r.y1);
    wo_props_set_int(props, name, 2, r.x2);
    wo_props_set_int(props, name, 3, r.y2);
}

static void describe(wo_handout *handout, const wo_image *view, wo_rect region,
                     const double scale[2], double time)
{
    wo_props *props = &handout->props;
    wo_port *port = handout->port;
    wo_host *host = port->owner->host;
    char id[160];
    wo_schema_image(props);
    wo_props_set_text(props, kOfxImageEffectPropComponents, 0,
                      wo_components_text(view->components));
    wo_props_set_text(props, kOfxImageEffectPropPreMultiplication, 0,
                      wo_props_text(&port->props, kOfxImageEffectPropPreMultiplication, 0,
                                    alpha_text(port->source.alpha)));
    wo_props_set_double(props, kOfxImageEffectPropRenderScale, 0, scale[0]);
    wo_props_set_double(props, kOfxImageEffectPropRenderScale, 1, scale[1]);
    wo_props_set_double(props, kOfxImagePropPixelAspectRatio, 0,
                        wo_props_double(&port->props, kOfxImagePropPixelAspectRatio, 0, 1));
    wo_props_set_pointer(props, kOfxImagePropData, 0, view->data);
    wo_props_set_int(props, kOfxImagePropRowBytes, 0, (int)view->row_bytes);
    set_rect(props, kOfxImagePropBounds, view->bounds);
    set_rect(props, kOfxImagePropRegionOfDefinition, region);
    if (port->identity && !port->output)
        snprintf(id, sizeof id, "%.40s@%g*%g,%g:%d,%d,%d,%d:%.40s", port->name, time, scale[0],
                 scale[1], view->bounds.x1, view->bounds.y1, view->bounds.x2, view->bounds.y2,
                 port->identity);
    else
        snprintf(id, sizeof id, "%.40s#%u", port->name, atomic_fetch_add(&host->image_counter, 1));
    wo_props_set_text(props, kOfxImagePropUniqueIdentifier, 0, id);
}

static void handout_free(wo_handout *handout)
{
    if (!handout)
        return;
    wo_props_clear(&handout->props);
    wo_buffer_free(&handout->buffer);
    free(handout);
}

/* Pixels the plugin gets of an input, before cutting to what there is. */
static wo_rect wanted(const wo_host_instance *instance, const wo_port *port, size_t index,
                      double time, const OfxRectD *region, wo_rect all)
{
    const wo_frame *frame = wo_frame_now();
    const double aspect = port->source.pixel_aspect;
    const bool tiles =
        wo_props_int(&instance->object.props, kOfxImageEffectPropSupportsTiles, 0, 1) &&
        wo_props_int(&port->props, kOfxImageEffectPropSupportsTiles, 0, 1);
    wo_rect needed = all;
    if (frame->tile)
        needed = wo_rect_intersect(
            wo_region_pixels(frame->tile->needed[index], frame->scale[0], frame->scale[1], aspect),
            all);
    if (!tiles)
        return all;
    if (!region)
        return needed;
    const wo_host_region asked = {region->x1, region->y1, region->x2, region->y2};
    const wo_rect pixels =
        wo_rect_intersect(wo_region_pixels(asked, frame->scale[0], frame->scale[1], aspect), all);
    /* Legal, but a host that fetches regions beforehand has to fetch once more. */
    if (frame->tile && time == frame->time && !wo_rect_contains(needed, pixels))
        wo_note_once(instance->object.host, "beyond the region of interest",
                     "%s: clipGetImage of \"%.80s\" beyond the region of interest given for it",
                     instance->object.entry->info.identifier, port->name);
    return pixels;
}

static OfxStatus input(wo_host_instance *instance, wo_handout *handout, size_t index, double time,
                       const OfxRectD *region)
{
    const wo_frame *frame = wo_frame_now();
    wo_port *port = handout->port;
    wo_host *host = instance->object.host;
    wo_error error = {0};
    wo_host_region defined;
    if (!port->connected)
        return kOfxStatFailed;
    if (time != frame->time &&
        !(wo_props_int(&port->props, kOfxImageEffectPropTemporalClipAccess, 0, 0) &&
          instance->object.entry->info.temporal))
        wo_violate(host, "clipGetImage of \"%.80s\" at another time without temporal access",
                   port->name);
    wo_status status = wo_port_region(port, time, &defined, &error);
    if (status == WO_OK) {
        if (wo_region_infinite(defined))
            defined = wo_project_region(instance);
        const wo_rect all =
            wo_region_pixels(defined, frame->scale[0], frame->scale[1], port->source.pixel_aspect);
        wo_rect bounds = wanted(instance, port, index, time, region, all);
        if (host->config.layout & WO_HOST_LARGER_IMAGES && !wo_rect_empty(bounds))
            bounds = wo_rect_intersect(wo_rect_grow(bounds, LARGER_X, LARGER_Y), all);
        if (wo_rect_empty(bounds))
            return kOfxStatFailed;
        if (!wo_buffer_make(host, &handout->buffer, bounds, port->components)) {
            status = wo_fail(&error, WO_ERR_NOMEM, "no memory for %d x %d pixels of %.60s",
                             wo_rect_width(bounds), wo_rect_height(bounds), port->name);
        } else {
            status = wo_fetch_pixels(port, time, frame->scale, &handout->buffer.view, &error);
            describe(handout, &handout->buffer.view, all, frame->scale, time);
        }
    }
    if (status == WO_ERR_NOT_FOUND)
        return kOfxStatFailed;
    if (status == WO_OK && handout->props.failed)
        status = wo_fail(&error, WO_ERR_NOMEM, "no memory for an image of %.60s", port->name);
    if (status != WO_OK) {
        keep_error(instance, &error, status);
        return status == WO_ERR_NOMEM ? kOfxStatErrMemory : kOfxStatFailed;
    }
    if (host->config.strict)
        handout->buffer.sum = wo_buffer_sum(&handout->buffer);
    return kOfxStatOK;
}

static OfxStatus output(wo_handout *handout, double time)
{
    const wo_frame *frame = wo_frame_now();
    if (!frame->tile) {
        wo_violate(NULL, "clipGetImage of the Output outside of %s", kOfxImageEffectActionRender);
        return kOfxStatFailed;
    }
    if (time != frame->time)
        wo_violate(NULL, "clipGetImage of the Output at time %g, which is not the rendered one",
                   time);
    describe(handout, &frame->tile->output.view, frame->tile->region, frame->scale, time);
    return handout->props.failed ? kOfxStatErrMemory : kOfxStatOK;
}

OfxStatus wo_image_hand_out(wo_host_instance *instance, wo_port *port, double time,
                            const OfxRectD *region, OfxPropertySetHandle *handle)
{
    const wo_frame *frame = wo_frame_now();
    if (!frame || frame->object != &instance->object || !wo_action_gets_images(frame->action)) {
        wo_violate(instance->object.host, "clipGetImage of \"%.80s\" %s", port->name,
                   frame ? "in an action without images" : "outside of any action");
        return kOfxStatFailed;
    }
    wo_handout *handout = calloc(1, sizeof *handout);
    if (!handout)
        return kOfxStatErrMemory;
    size_t index = 0;
    while (instance->object.ports[index] != port)
        index++;
    handout->port = port;
    handout->serial = frame->serial;
    wo_props_init(&handout->props, instance->object.host, WO_PROPS_NEVER, "an image of \"%.80s\"",
                  port->name);
    const OfxStatus status = handout->props.failed ? kOfxStatErrMemory
                             : port->output        ? output(handout, time)
                                                   : input(instance, handout, index, time, region);
    if (status != kOfxStatOK) {
        handout_free(handout);
        return status;
    }
    wo_process_lock();
    handout->props.handout = handout;
    wo_process_unlock();
    pthread_mutex_lock(&instance->lock);
    handout->next = instance->handouts;
    instance->handouts = handout;
    if (!port->output)
        instance->input_pixels += (int64_t)wo_rect_width(handout->buffer.view.bounds) *
                                  wo_rect_height(handout->buffer.view.bounds);
    pthread_mutex_unlock(&instance->lock);
    *handle = (OfxPropertySetHandle)handout->props.handle;
    return kOfxStatOK;
}

/* Checks what the plugin did to an input and frees it; it is in no list any more. */
static void finish(wo_handout *handout)
{
    const wo_buffer *buffer = &handout->buffer;
    if (buffer->memory && !wo_buffer_intact(buffer))
        wo_violate(handout->port->owner->host,
                   "bytes outside of an image of the input \"%.80s\" were written",
                   handout->port->name);
    if (buffer->sum != 0 && wo_buffer_sum(buffer) != buffer->sum)
        wo_violate(handout->port->owner->host, "an image of the input \"%.80s\" was written to",
                   handout->port->name);
    handout_free(handout);
}

OfxStatus wo_image_take_back(OfxPropertySetHandle handle)
{
    wo_process_lock();
    wo_props *props = wo_handle_find(handle, WO_HANDLE_PROPS);
    wo_handout *handout = props ? props->handout : NULL;
    const char *why = props ? "no image's" : wo_handle_fault(handle, WO_HANDLE_PROPS);
    if (handout) /* nobody else can release it from here on */
        wo_handle_remove(props->handle);
    wo_process_unlock();
    if (!handout) {
        wo_violate(NULL, "clipReleaseImage: the image handle is %s", why);
        return kOfxStatErrBadHandle;
    }
    wo_host_instance *instance = (wo_host_instance *)handout->port->owner;
    pthread_mutex_lock(&instance->lock);
    wo_handout **link = &instance->handouts;
    while (*link && *link != handout)
        link = &(*link)->next;
    if (*link)
        *link = handout->next;
    pthread_mutex_unlock(&instance->lock);
    finish(handout);
    return kOfxStatOK;
}

void wo_images_check_left(wo_host_instance *instance, uint64_t serial)
{
    wo_handout *left = NULL;
    pthread_mutex_lock(&instance->lock);
    wo_handout **link = &instance->handouts;
    while (*link) {
        wo_handout *handout = *link;
        if (handout->serial == serial) {
            *link = handout->next;
            handout->next = left;
            left = handout;
        } else {
            link = &handout->next;
        }
    }
    pthread_mutex_unlock(&instance->lock);
    while (left) {
        wo_handout *next = left->next;
        wo_violate(instance->object.host, "an image of \"%.80s\" was not released",
                   left->port->name);
        finish(left);
        left = next;
    }
}
