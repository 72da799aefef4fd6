/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Clips of an instance. What they say of themselves is at all times what would come if the plugin
   had no wishes: that of the source, mapped to what the clip takes, or of the first kind it takes
   as long as nothing is connected. */

static const char *const alpha_texts[] = {kOfxImageOpaque, kOfxImagePreMultiplied,
                                          kOfxImageUnPreMultiplied};

int32_t wo_port_components(const wo_port *port)
{
    const int32_t components = port->connected ? port->source.components : 0;
    static const int32_t order[][3] = {{1, 3, 4}, {3, 4, 1}, {4, 3, 1}};
    const int32_t *best = components == 1 ? order[0] : components == 3 ? order[1] : order[2];
    const int known = wo_props_count(&port->props, kOfxImageEffectPropSupportedComponents);
    for (int i = 0; components > 0 && i < 3; i++)
        if (wo_props_has_text(&port->props, kOfxImageEffectPropSupportedComponents,
                              wo_components_text(best[i])))
            return best[i];
    for (int i = 0; components == 0 && i < known; i++) {
        const int32_t first = wo_components_of(
            wo_props_text(&port->props, kOfxImageEffectPropSupportedComponents, i, ""));
        if (first != 0)
            return first;
    }
    return components > 0 ? components : 4;
}

/* Where alpha is made up, it is 1. */
wo_host_alpha wo_port_alpha(const wo_port *port)
{
    if (port->components == 3 ||
        (port->connected && port->components == 4 && port->source.components != 4))
        return WO_HOST_OPAQUE;
    return port->connected ? port->source.alpha : WO_HOST_PREMULTIPLIED;
}

static void say_range(wo_props *props, double first, double last)
{
    wo_props_set_double(props, kOfxImageEffectPropFrameRange, 0, first);
    wo_props_set_double(props, kOfxImageEffectPropFrameRange, 1, last);
    wo_props_set_double(props, kOfxImageEffectPropUnmappedFrameRange, 0, first);
    wo_props_set_double(props, kOfxImageEffectPropUnmappedFrameRange, 1, last);
}

static void say_rate(wo_props *props, double rate)
{
    wo_props_set_double(props, kOfxImageEffectPropFrameRate, 0, rate);
    wo_props_set_double(props, kOfxImageEffectPropUnmappedFrameRate, 0, rate);
}

void wo_port_say_components(wo_port *port)
{
    wo_props_set_text(&port->props, kOfxImageEffectPropComponents, 0,
                      wo_components_text(port->components));
    if (!port->output)
        wo_props_set_text(&port->props, kOfxImageEffectPropPreMultiplication, 0,
                          alpha_texts[wo_port_alpha(port)]);
}

static void describe_input(wo_port *port, const wo_host_project *project)
{
    const wo_host_source *s = &port->source;
    const bool connected = port->connected;
    wo_props *props = &port->props;
    port->components = wo_port_components(port);
    wo_port_say_components(port);
    wo_props_set_int(props, kOfxImageClipPropConnected, 0, connected);
    wo_props_set_text(props, kOfxImageEffectPropPixelDepth, 0, kOfxBitDepthFloat);
    wo_props_set_text(props, kOfxImageClipPropUnmappedPixelDepth, 0,
                      connected ? kOfxBitDepthFloat : kOfxBitDepthNone);
    wo_props_set_text(props, kOfxImageClipPropUnmappedComponents, 0,
                      wo_components_text(connected ? s->components : 0));
    wo_props_set_double(props, kOfxImagePropPixelAspectRatio, 0,
                        connected ? s->pixel_aspect : project->pixel_aspect);
    say_rate(props, connected ? s->frame_rate : project->frame_rate);
    say_range(props, connected ? s->first_frame : project->first_frame,
              connected ? s->last_frame : project->last_frame);
    wo_props_set_int(props, kOfxImageClipPropContinuousSamples, 0, connected && s->continuous);
}

/* --------------------------------------------------------------------------------------- Output */

static int32_t output_components(const wo_host_instance *instance, const wo_port *output)
{
    int32_t components = 4, most = 0;
    const wo_port *source = wo_object_port(&instance->object, kOfxImageEffectSimpleSourceClipName);
    for (size_t i = 0; i < instance->object.port_count; i++) {
        const wo_port *port = instance->object.ports[i];
        if (port->connected && port->components > most)
            most = port->components;
    }
    if (strcmp(instance->context->short_name, "Filter") == 0 && source && source->connected)
        components = source->components;
    else if (strcmp(instance->context->short_name, "General") == 0)
        components = most;
    if (most == 0)
        return wo_port_components(output);
    if (!wo_props_has_text(&output->props, kOfxImageEffectPropSupportedComponents,
                           wo_components_text(components)))
        for (int32_t c = 4; c >= 1; c--)
            if (wo_props_has_text(&output->props, kOfxImageEffectPropSupportedComponents,
                                  wo_components_text(c)))
                return c;
    return components;
}

static wo_host_alpha output_alpha(const wo_host_instance *instance)
{
    bool any = false, unpremultiplied = false;
    for (size_t i = 0; i < instance->object.port_count; i++) {
        const wo_port *port = instance->object.ports[i];
        if (port->output || !port->connected)
            continue;
        any = true;
        if (port->components != 4)
            continue;
        if (wo_port_alpha(port) == WO_HOST_PREMULTIPLIED)
            return WO_HOST_PREMULTIPLIED;
        unpremultiplied |= wo_port_alpha(port) == WO_HOST_UNPREMULTIPLIED;
    }
    return unpremultiplied ? WO_HOST_UNPREMULTIPLIED : any ? WO_HOST_OPAQUE : WO_HOST_PREMULTIPLIED;
}

void wo_frames_of_inputs(const wo_host_instance *instance, double *first, double *last)
{
    bool any = false;
    *first = instance->project.first_frame;
    *last = instance->project.last_frame;
    for (size_t i = 0; i < instance->object.port_count; i++) {
        const wo_port *port = instance->object.ports[i];
        if (!port->connected)
            continue;
        *first = any ? fmin(*first, port->source.first_frame) : port->source.first_frame;
        *last = any ? fmax(*last, port->source.last_frame) : port->source.last_frame;
        any = true;
    }
}

static void describe_output(wo_host_instance *instance, wo_port *output)
{
    const wo_port *source = wo_object_port(&instance->object, kOfxImageEffectSimpleSourceClipName);
    const bool has_source = source && source->connected;
    const wo_host_project *project = &instance->project;
    wo_host_preferences *p = &instance->preferences;
    wo_props *props = &output->props;
    double first, last;
    output->components = output_components(instance, output);
    p->alpha = output_alpha(instance);
    p->frame_rate = has_source ? source->source.frame_rate : project->frame_rate;
    wo_frames_of_inputs(instance, &first, &last);
    wo_port_say_components(output);
    wo_props_set_text(props, kOfxImageClipPropUnmappedComponents, 0,
                      wo_components_text(output->components));
    wo_props_set_text(props, kOfxImageEffectPropPixelDepth, 0, kOfxBitDepthFloat);
    wo_props_set_text(props, kOfxImageClipPropUnmappedPixelDepth, 0, kOfxBitDepthFloat);
    wo_props_set_text(props, kOfxImageEffectPropPreMultiplication, 0, alpha_texts[p->alpha]);
    wo_props_set_double(props, kOfxImagePropPixelAspectRatio, 0,
                        has_source ? source->source.pixel_aspect : project->pixel_aspect);
    say_rate(props, p->frame_rate);
    say_range(props, first, last);
    wo_props_set_int(props, kOfxImageClipPropConnected, 0, 1);
    wo_props_set_int(props, kOfxImageClipPropContinuousSamples, 0, 0);
}

bool wo_clips_describe(wo_host_instance *instance)
{
    wo_port *output = wo_object_port(&instance->object, kOfxImageEffectOutputClipName);
    bool ok = true;
    for (size_t i = 0; i < instance->object.port_count; i++)
        if (!instance->object.ports[i]->output)
            describe_input(instance->object.ports[i], &instance->project);
    describe_output(instance, output);
    for (size_t i = 0; i < instance->object.port_count; i++) {
        ok = ok && !instance->object.ports[i]->props.failed;
        instance->object.ports[i]->props.failed = false;
    }
    return ok;
}

/* -------------------------------------------------------------------------------------- sources */

static wo_status check_source(const wo_port *port, const wo_host_source *source, wo_error *error)
{
    if (!source->region || !source->pixels)
        return wo_fail(error, WO_ERR_ARGUMENT, "the source of %.60s lacks a function", port->name);
    if (source->components != 1 && source->components != 3 && source->components != 4)
        return wo_fail(error, WO_ERR_ARGUMENT,
                       "the source of %.60s has %d components; 1, 3 or 4 "
                       "are legal",
                       port->name, source->components);
    if ((unsigned)source->alpha > WO_HOST_UNPREMULTIPLIED || !(source->pixel_aspect > 0) ||
        !isfinite(source->pixel_aspect) || !(source->frame_rate > 0) ||
        !(source->last_frame >= source->first_frame))
        return wo_fail(error, WO_ERR_RANGE,
                       "the source of %.60s has alpha %d, pixel aspect %g, frame rate %g, frames "
                       "%g to %g",
                       port->name, (int)source->alpha, source->pixel_aspect, source->frame_rate,
                       source->first_frame, source->last_frame);
    return WO_OK;
}

wo_status wo_host_set_clip(wo_host_instance *instance, const char *clip,
                           const wo_host_source *source, wo_error *error)
{
    wo_port *port = wo_object_port(&instance->object, clip);
    if (!port || port->output)
        return wo_fail(error, WO_ERR_NOT_FOUND, "%.60s has no input clip \"%.60s\"",
                       instance->object.entry->info.identifier, clip);
    if (source)
        WO_TRY(check_source(port, source, error));
    char *colourspace = NULL, *identity = NULL;
    if (source && (!wo_text_set(&colourspace, source->colourspace) ||
                   !wo_text_set(&identity, source->identity))) {
        free(colourspace);
        return wo_fail(error, WO_ERR_NOMEM, "no memory for clip %.60s", clip);
    }
    free(port->colourspace);
    free(port->identity);
    port->colourspace = colourspace;
    port->identity = identity;
    port->connected = source != NULL;
    port->has_metadata = false;
    port->source = source ? *source : (wo_host_source){0};
    port->source.colourspace = colourspace;
    port->source.identity = identity;
    instance->preferences_stale = instance->colourspace_stale = true;
    instance->has_region = false;
    if (!wo_clips_describe(instance)) {
        port->connected = false;
        return wo_fail(error, WO_ERR_NOMEM, "no memory for clip %.60s", clip);
    }
    if (!instance->notify)
        return WO_OK;
    return wo_tell_changed(instance, kOfxTypeClip, clip, kOfxChangeUserEdited, error);
}
