/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "internal.h"

#include "wideopen/ofx_camera.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* -------------------------------------------------------------------------------------- regions */

#define SNAP 1e-6 /* of a pixel: what rounding may have added on the way there and back */

static int32_t to_pixel(double value)
{
    if (!(value > -WO_MAX_COORDINATE))
        return -WO_MAX_COORDINATE;
    return value < WO_MAX_COORDINATE ? (int32_t)value : WO_MAX_COORDINATE;
}

wo_rect wo_region_pixels(wo_host_region r, double scale_x, double scale_y, double aspect)
{
    if (!(r.x2 > r.x1 && r.y2 > r.y1))
        return (wo_rect){0, 0, 0, 0};
    const wo_rect pixels = {
        to_pixel(floor(r.x1 * scale_x / aspect + SNAP)), to_pixel(floor(r.y1 * scale_y + SNAP)),
        to_pixel(ceil(r.x2 * scale_x / aspect - SNAP)), to_pixel(ceil(r.y2 * scale_y - SNAP))};
    return wo_rect_empty(pixels) ? (wo_rect){0, 0, 0, 0} : pixels;
}

wo_host_region wo_pixels_region(wo_rect p, double scale_x, double scale_y, double aspect)
{
    return (wo_host_region){p.x1 * aspect / scale_x, p.y1 / scale_y, p.x2 * aspect / scale_x,
                            p.y2 / scale_y};
}

bool wo_region_infinite(wo_host_region r)
{
    return r.x1 <= -WO_INFINITE || r.y1 <= -WO_INFINITE || r.x2 >= WO_INFINITE ||
           r.y2 >= WO_INFINITE;
}

wo_host_region wo_project_region(const wo_host_instance *instance)
{
    const wo_host_project *p = &instance->project;
    return (wo_host_region){p->offset[0], p->offset[1], p->offset[0] + p->size[0],
                            p->offset[1] + p->size[1]};
}

static bool region_empty(wo_host_region r)
{
    return !(r.x2 > r.x1 && r.y2 > r.y1);
}

static wo_host_region join(wo_host_region a, wo_host_region b)
{
    if (region_empty(a))
        return b;
    if (region_empty(b))
        return a;
    return (wo_host_region){fmin(a.x1, b.x1), fmin(a.y1, b.y1), fmax(a.x2, b.x2), fmax(a.y2, b.y2)};
}

static bool region_sane(wo_host_region r)
{
    return r.x2 >= r.x1 && r.y2 >= r.y1; /* NaN fails */
}

wo_status wo_port_region(wo_port *port, double time, wo_host_region *region, wo_error *error)
{
    *region = (wo_host_region){0};
    if (!port->connected)
        return wo_fail(error, WO_ERR_NOT_FOUND, "clip %.60s is not connected", port->name);
    WO_TRY(port->source.region(port->source.user, time, region, error));
    if (!region_sane(*region))
        return wo_fail(error, WO_ERR_RANGE, "clip %.60s covers %g, %g to %g, %g", port->name,
                       region->x1, region->y1, region->x2, region->y2);
    return WO_OK;
}

static void set_region(wo_props *props, const char *name, wo_host_region r)
{
    wo_props_set_double(props, name, 0, r.x1);
    wo_props_set_double(props, name, 1, r.y1);
    wo_props_set_double(props, name, 2, r.x2);
    wo_props_set_double(props, name, 3, r.y2);
}

static wo_host_region get_region(const wo_props *props, const char *name)
{
    return (wo_host_region){wo_props_double(props, name, 0, 0), wo_props_double(props, name, 1, 0),
                            wo_props_double(props, name, 2, 0), wo_props_double(props, name, 3, 0)};
}

wo_clip_name wo_with_clip(const char *prefix, const wo_port *port)
{
    wo_clip_name name;
    snprintf(name.text, sizeof name.text, "%s%s", prefix, port->name);
    return name;
}

void wo_arguments(wo_props *in, wo_props *out, wo_host_instance *instance, double time,
                  const double scale[2])
{
    wo_props_init(in, instance->object.host, WO_PROPS_NEVER, "the arguments");
    wo_props_init(out, instance->object.host, WO_PROPS_ACTION, "the answers");
    wo_props_add_one(in, kOfxPropTime, WO_PROP_DOUBLE, 1, false);
    wo_props_set_double(in, kOfxPropTime, 0, time);
    if (!scale)
        return;
    wo_props_add_one(in, kOfxImageEffectPropRenderScale, WO_PROP_DOUBLE, 2, false);
    wo_props_set_double(in, kOfxImageEffectPropRenderScale, 0, scale[0]);
    wo_props_set_double(in, kOfxImageEffectPropRenderScale, 1, scale[1]);
}

/* ------------------------------------------------------------------------------------- metadata */

static void add_metadata(void *to, const char *name, const char *value)
{
    wo_props *props = to;
    const int count = wo_props_count(props, kWideOpenClipPropMetadataNames);
    wo_props_set_text(props, kWideOpenClipPropMetadataNames, count, name);
    wo_props_set_text(props, kWideOpenClipPropMetadataValues, count, value);
}

static wo_status read_metadata(wo_port *port, double time, wo_error *error)
{
    static const char *const names[] = {kWideOpenClipPropMetadataNames,
                                        kWideOpenClipPropMetadataValues};
    bool ok = true;
    for (size_t i = 0; i < WO_COUNT(names); i++) {
        wo_prop *prop = wo_props_find(&port->props, names[i]);
        ok = ok && prop && wo_prop_resize(prop, 0);
    }
    wo_status status = WO_OK;
    if (ok && port->connected && port->source.metadata)
        status = port->source.metadata(port->source.user, time, add_metadata, &port->props, error);
    if (!ok || port->props.failed) {
        port->props.failed = false;
        return wo_fail(error, WO_ERR_NOMEM, "no memory for the metadata of %.60s", port->name);
    }
    return status == WO_ERR_NOT_FOUND ? WO_OK : status; /* no picture at this time */
}

/* Everything a plugin may look at before the pixels of a time. */
static wo_status prepare_at(wo_host_instance *instance, double time, wo_error *error)
{
    WO_TRY(wo_prepare(instance, error));
    for (size_t i = 0; i < instance->object.port_count; i++) {
        wo_port *port = instance->object.ports[i];
        if (port->output || (port->has_metadata && port->metadata_time == time))
            continue;
        port->has_metadata = false;
        WO_TRY(read_metadata(port, time, error));
        port->has_metadata = true;
        port->metadata_time = time;
    }
    return WO_OK;
}

/* --------------------------------------------------------------- region, needed, frames, domain */

wo_status wo_default_region(wo_host_instance *instance, double time, wo_host_region *region,
                            wo_error *error)
{
    const bool filter = strcmp(instance->context->short_name, "Filter") == 0;
    wo_host_region all = {0}, one;
    *region = wo_project_region(instance);
    if (strcmp(instance->context->short_name, "Generator") == 0)
        return WO_OK;
    for (size_t i = 0; i < instance->object.port_count; i++) {
        wo_port *port = instance->object.ports[i];
        const bool source = strcmp(port->name, kOfxImageEffectSimpleSourceClipName) == 0;
        const bool counts =
            source || (!filter && !wo_props_int(&port->props, kOfxImageClipPropOptional, 0, 0));
        if (!port->connected || !counts)
            continue;
        wo_error local = {0};
        const wo_status status = wo_port_region(port, time, &one, &local);
        if (status == WO_ERR_NOT_FOUND) /* no picture at this time */
            continue;
        if (status != WO_OK)
            return wo_fail(error, status, "%s", local.text);
        all = join(all, one);
    }
    if (!region_empty(all))
        *region = all;
    return WO_OK;
}

static wo_status check_scale(double scale_x, double scale_y, double time, wo_error *error)
{
    if (!(scale_x > 0 && scale_y > 0 && scale_x <= 64 && scale_y <= 64 && isfinite(time)))
        return wo_fail(error, WO_ERR_RANGE, "render scale %g, %g at time %g", scale_x, scale_y,
                       time);
    return WO_OK;
}

wo_status wo_host_get_region(wo_host_instance *instance, double time, double scale_x,
                             double scale_y, wo_host_region *region, wo_rect *pixels,
                             wo_error *error)
{
    const double scale[2] = {scale_x, scale_y};
    wo_props in, out;
    wo_host_region usual = {0};
    *region = usual;
    if (pixels)
        *pixels = (wo_rect){0, 0, 0, 0};
    WO_TRY(check_scale(scale_x, scale_y, time, error));
    WO_TRY(prepare_at(instance, time, error));
    WO_TRY(wo_default_region(instance, time, &usual, error));
    wo_arguments(&in, &out, instance, time, scale);
    wo_props_add_one(&out, kOfxImageEffectPropRegionOfDefinition, WO_PROP_DOUBLE, 4, true);
    set_region(&out, kOfxImageEffectPropRegionOfDefinition, usual);
    wo_frame frame = {.action = WO_ACTION_REGION, .time = time, .scale = {scale_x, scale_y}};
    const wo_status status = wo_act_on(instance, &frame, &in, &out, NULL, error);
    *region = get_region(&out, kOfxImageEffectPropRegionOfDefinition);
    wo_props_clear(&in);
    wo_props_clear(&out);
    WO_TRY(status);
    if (!region_sane(*region)) {
        wo_violate_in(&frame, "the region is %g, %g to %g, %g", region->x1, region->y1, region->x2,
                      region->y2);
        *region = usual;
    }
    instance->has_region = true;
    instance->region = *region;
    instance->region_time = time;
    if (pixels) {
        const wo_port *output = wo_object_port(&instance->object, kOfxImageEffectOutputClipName);
        *pixels = wo_region_pixels(
            wo_region_infinite(*region) ? wo_project_region(instance) : *region, scale_x, scale_y,
            wo_props_double(&output->props, kOfxImagePropPixelAspectRatio, 0, 1));
    }
    return WO_OK;
}

wo_status wo_host_get_needed(wo_host_instance *instance, double time, double scale_x,
                             double scale_y, wo_host_region region, wo_host_region *needed,
                             size_t count, wo_error *error)
{
    const double scale[2] = {scale_x, scale_y};
    wo_props in, out;
    if (count != instance->object.port_count)
        return wo_fail(error, WO_ERR_ARGUMENT, "there are %zu clips, not %zu",
                       instance->object.port_count, count);
    WO_TRY(check_scale(scale_x, scale_y, time, error));
    WO_TRY(prepare_at(instance, time, error));
    wo_arguments(&in, &out, instance, time, scale);
    wo_props_add_one(&in, kOfxImageEffectPropRegionOfInterest, WO_PROP_DOUBLE, 4, false);
    set_region(&in, kOfxImageEffectPropRegionOfInterest, region);
    for (size_t i = 0; i < count; i++) {
        const wo_port *port = instance->object.ports[i];
        const wo_clip_name name = wo_with_clip("OfxImageClipPropRoI_", port);
        needed[i] = (wo_host_region){0};
        if (port->output)
            continue;
        wo_props_add_one(&out, name.text, WO_PROP_DOUBLE, 4, true);
        set_region(&out, name.text, region);
    }
    wo_frame frame = {.action = WO_ACTION_NEEDED, .time = time, .scale = {scale_x, scale_y}};
    const wo_status status = wo_act_on(instance, &frame, &in, &out, NULL, error);
    for (size_t i = 0; status == WO_OK && i < count; i++) {
        const wo_port *port = instance->object.ports[i];
        if (port->output)
            continue;
        needed[i] = get_region(&out, wo_with_clip("OfxImageClipPropRoI_", port).text);
        if (region_sane(needed[i]))
            continue;
        wo_violate_in(&frame, "the region of interest of \"%.80s\" is %g, %g to %g, %g", port->name,
                      needed[i].x1, needed[i].y1, needed[i].x2, needed[i].y2);
        needed[i] = region;
    }
    wo_props_clear(&in);
    wo_props_clear(&out);
    return status;
}

wo_status wo_host_get_frames_needed(wo_host_instance *instance, double time, double (*ranges)[2],
                                    size_t count, wo_error *error)
{
    wo_props in, out;
    if (count != instance->object.port_count)
        return wo_fail(error, WO_ERR_ARGUMENT, "there are %zu clips, not %zu",
                       instance->object.port_count, count);
    for (size_t i = 0; i < count; i++)
        ranges[i][0] = ranges[i][1] = time;
    WO_TRY(wo_prepare(instance, error));
    if (!instance->object.entry->info.temporal)
        return WO_OK;
    wo_arguments(&in, &out, instance, time, NULL);
    for (size_t i = 0; i < count; i++) {
        const wo_clip_name name =
            wo_with_clip("OfxImageClipPropFrameRange_", instance->object.ports[i]);
        if (instance->object.ports[i]->output)
            continue;
        wo_props_add_one(&out, name.text, WO_PROP_DOUBLE, 0, true);
        wo_props_set_double(&out, name.text, 0, time);
        wo_props_set_double(&out, name.text, 1, time);
    }
    wo_frame frame = {.action = WO_ACTION_FRAMES, .time = time, .scale = {1, 1}};
    const wo_status status = wo_act_on(instance, &frame, &in, &out, NULL, error);
    for (size_t i = 0; status == WO_OK && i < count; i++) {
        const wo_clip_name name =
            wo_with_clip("OfxImageClipPropFrameRange_", instance->object.ports[i]);
        const int numbers = wo_props_count(&out, name.text);
        if (instance->object.ports[i]->output)
            continue;
        if (numbers % 2 != 0)
            wo_violate_in(&frame, "the frames needed of \"%.80s\" are %d numbers, not pairs",
                          instance->object.ports[i]->name, numbers);
        for (int k = 0; k + 1 < numbers; k += 2) {
            const double first = wo_props_double(&out, name.text, k, time);
            const double last = wo_props_double(&out, name.text, k + 1, time);
            /* a last one before the first: none */
            if (!isfinite(first) || !isfinite(last))
                wo_violate_in(&frame, "the frames needed of \"%.80s\" are %g to %g",
                              instance->object.ports[i]->name, first, last);
            else if (k == 0) {
                ranges[i][0] = first;
                ranges[i][1] = last;
            }
        }
    }
    wo_props_clear(&in);
    wo_props_clear(&out);
    return status;
}

wo_status wo_host_get_time_domain(wo_host_instance *instance, double *first, double *last,
                                  wo_error *error)
{
    wo_props in, out;
    wo_frames_of_inputs(instance, first, last);
    WO_TRY(wo_prepare(instance, error));
    if (strcmp(instance->context->short_name, "General") != 0)
        return WO_OK;
    wo_arguments(&in, &out, instance, instance->time, NULL);
    wo_props_add_one(&out, kOfxImageEffectPropFrameRange, WO_PROP_DOUBLE, 2, true);
    wo_props_set_double(&out, kOfxImageEffectPropFrameRange, 0, *first);
    wo_props_set_double(&out, kOfxImageEffectPropFrameRange, 1, *last);
    wo_frame frame = {.action = WO_ACTION_TIME_DOMAIN, .time = instance->time, .scale = {1, 1}};
    const wo_status status = wo_act_on(instance, &frame, NULL, &out, NULL, error);
    const double range[2] = {wo_props_double(&out, kOfxImageEffectPropFrameRange, 0, *first),
                             wo_props_double(&out, kOfxImageEffectPropFrameRange, 1, *last)};
    wo_props_clear(&in);
    wo_props_clear(&out);
    WO_TRY(status);
    if (!(range[0] <= range[1])) { /* NaN fails */
        wo_violate_in(&frame, "the time domain is %g to %g", range[0], range[1]);
        return WO_OK;
    }
    *first = range[0];
    *last = range[1];
    return WO_OK;
}

wo_status wo_ask_identity(wo_host_instance *instance, double time, const double scale[2],
                          wo_rect window, wo_port **port, double *other_time, wo_error *error)
{
    wo_props in, out;
    OfxStatus answer = kOfxStatReplyDefault;
    *port = NULL;
    *other_time = time;
    wo_arguments(&in, &out, instance, time, scale);
    wo_props_add_one(&in, kOfxImageEffectPropFieldToRender, WO_PROP_STRING, 1, false);
    wo_props_set_text(&in, kOfxImageEffectPropFieldToRender, 0, kOfxImageFieldNone);
    wo_props_add_one(&in, kOfxImageEffectPropRenderWindow, WO_PROP_INT, 4, false);
    wo_props_set_int(&in, kOfxImageEffectPropRenderWindow, 0, window.x1);
    wo_props_set_int(&in, kOfxImageEffectPropRenderWindow, 1, window.y1);
    wo_props_set_int(&in, kOfxImageEffectPropRenderWindow, 2, window.x2);
    wo_props_set_int(&in, kOfxImageEffectPropRenderWindow, 3, window.y2);
    wo_props_add_one(&out, kOfxPropName, WO_PROP_STRING, 1, true);
    wo_props_add_one(&out, kOfxPropTime, WO_PROP_DOUBLE, 1, true);
    wo_props_set_double(&out, kOfxPropTime, 0, time);
    wo_frame frame = {.action = WO_ACTION_IDENTITY, .time = time, .scale = {scale[0], scale[1]}};
    const wo_status status = wo_act_on(instance, &frame, &in, &out, &answer, error);
    if (status == WO_OK && answer == kOfxStatOK) {
        const char *name = wo_props_text(&out, kOfxPropName, 0, "");
        *port = wo_object_port(&instance->object, name);
        *other_time = wo_props_double(&out, kOfxPropTime, 0, time);
        if (!*port || (*port)->output || !isfinite(*other_time)) {
            wo_violate_in(&frame, "identity with \"%.80s\", which is no input clip", name);
            *port = NULL;
        }
    }
    wo_props_clear(&in);
    wo_props_clear(&out);
    return status;
}
