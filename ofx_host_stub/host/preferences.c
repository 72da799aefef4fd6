/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "internal.h"

#include <string.h>

/* ----------------------------------------------------------------------------- clip preferences */

static const char *const alpha_texts[] = {kOfxImageOpaque, kOfxImagePreMultiplied,
                                          kOfxImageUnPreMultiplied};

static bool is_mandated(const wo_host_instance *instance, const wo_port *port)
{
    return strcmp(instance->context->short_name, "General") != 0 &&
           (port->output || !wo_props_int(&port->props, kOfxImageClipPropOptional, 0, 0));
}

static wo_status check_connected(const wo_host_instance *instance, wo_error *error)
{
    for (size_t i = 0; i < instance->object.port_count; i++) {
        const wo_port *port = instance->object.ports[i];
        if (!port->output && !port->connected &&
            !wo_props_int(&port->props, kOfxImageClipPropOptional, 0, 0))
            return wo_fail(error, WO_ERR_ARGUMENT, "clip %.60s must be connected", port->name);
    }
    return WO_OK;
}

static void offer_clip(wo_props *out, const wo_port *port)
{
    const wo_clip_name components = wo_with_clip("OfxImageClipPropComponents_", port);
    const wo_clip_name depth = wo_with_clip("OfxImageClipPropDepth_", port);
    const wo_clip_name aspect = wo_with_clip("OfxImageClipPropPAR_", port);
    const wo_clip_name wishes = wo_with_clip("OfxImageClipPropPreferredColourspaces_", port);
    wo_props_add_one(out, components.text, WO_PROP_STRING, 1, true);
    wo_props_add_one(out, depth.text, WO_PROP_STRING, 1, true);
    wo_props_add_one(out, aspect.text, WO_PROP_DOUBLE, 1, true);
    wo_props_set_text(out, components.text, 0, wo_components_text(port->components));
    wo_props_set_text(out, depth.text, 0, kOfxBitDepthFloat);
    wo_props_set_double(out, aspect.text, 0,
                        wo_props_double(&port->props, kOfxImagePropPixelAspectRatio, 0, 1));
    if (!port->output)
        wo_props_add_one(out, wishes.text, WO_PROP_STRING, 0, true);
}

static wo_status take_clip(wo_host_instance *instance, const wo_props *out, wo_port *port,
                           wo_error *error)
{
    wo_host *host = instance->object.host;
    const char *name = port->name;
    const wo_clip_name components = wo_with_clip("OfxImageClipPropComponents_", port);
    const wo_clip_name depth = wo_with_clip("OfxImageClipPropDepth_", port);
    const wo_clip_name aspect = wo_with_clip("OfxImageClipPropPAR_", port);
    const wo_clip_name wishes = wo_with_clip("OfxImageClipPropPreferredColourspaces_", port);
    const char *text = wo_props_text(out, components.text, 0, "");
    const int32_t count = wo_components_of(text);
    const bool supported =
        count > 0 && wo_props_has_text(&port->props, kOfxImageEffectPropSupportedComponents, text);
    if (count != port->components && !port->connected && !port->output) {
        if (supported && !is_mandated(instance, port))
            port->components = count;
    } else if (count != port->components) {
        if (is_mandated(instance, port))
            wo_violate(host, "the components of \"%.80s\" cannot be changed in this context", name);
        else if (!supported)
            wo_violate(host, "\"%.80s\" does not support %.80s", name, text);
        else
            port->components = count;
    }
    if (strcmp(wo_props_text(out, depth.text, 0, ""), kOfxBitDepthFloat) != 0)
        wo_violate(host, "the depth of \"%.80s\" cannot be changed in this host", name);
    if (wo_props_double(out, aspect.text, 0, 1) !=
        wo_props_double(&port->props, kOfxImagePropPixelAspectRatio, 0, 1))
        wo_violate(host, "the pixel aspect of \"%.80s\" cannot be changed in this host", name);
    wo_port_say_components(port);
    wo_texts_clear(&port->wishes);
    wo_prop *listed = wo_props_find(&port->props, kOfxImageClipPropPreferredColourspaces);
    bool ok = wo_prop_resize(listed, 0);
    for (int i = 0; ok && i < wo_props_count(out, wishes.text); i++) {
        const char *wish = wo_props_text(out, wishes.text, i, "");
        wo_props_set_text(&port->props, kOfxImageClipPropPreferredColourspaces, i, wish);
        ok = wo_texts_add(&port->wishes, wish);
    }
    if (!ok || port->props.failed) {
        port->props.failed = false;
        return wo_fail(error, WO_ERR_NOMEM, "no memory for the preferences of %.60s", name);
    }
    return WO_OK;
}

static void take_alpha(wo_host_instance *instance, const wo_props *out)
{
    const char *text = wo_props_text(out, kOfxImageEffectPropPreMultiplication, 0, "");
    for (size_t i = 0; i < WO_COUNT(alpha_texts); i++) {
        if (strcmp(text, alpha_texts[i]) == 0) {
            instance->preferences.alpha = (wo_host_alpha)i;
            return;
        }
    }
    wo_violate(instance->object.host, "\"%.80s\" is no state of premultiplication", text);
}

static wo_status take_preferences(wo_host_instance *instance, const wo_props *out, wo_port *output,
                                  wo_error *error)
{
    wo_host *host = instance->object.host;
    wo_host_preferences *p = &instance->preferences;
    for (size_t i = 0; i < instance->object.port_count; i++)
        WO_TRY(take_clip(instance, out, instance->object.ports[i], error));
    take_alpha(instance, out);
    if (wo_props_double(out, kOfxImageEffectPropFrameRate, 0, 0) != p->frame_rate)
        wo_violate(host, "the frame rate cannot be changed in this host");
    if (strcmp(wo_props_text(out, kOfxImageClipPropFieldOrder, 0, ""), kOfxImageFieldNone) != 0)
        wo_violate(host, "the field order cannot be changed in this host");
    p->continuous = wo_props_int(out, kOfxImageClipPropContinuousSamples, 0, 0);
    p->frame_varying = wo_props_int(out, kOfxImageEffectFrameVarying, 0, 0);
    wo_props_set_text(&output->props, kOfxImageEffectPropPreMultiplication, 0,
                      alpha_texts[p->alpha]);
    wo_props_set_int(&output->props, kOfxImageClipPropContinuousSamples, 0, p->continuous);
    return WO_OK;
}

static wo_status ask_preferences(wo_host_instance *instance, wo_error *error)
{
    wo_object *object = &instance->object;
    wo_port *output = wo_object_port(object, kOfxImageEffectOutputClipName);
    wo_host_preferences *p = &instance->preferences;
    wo_props in, out;
    if (!wo_clips_describe(instance))
        return wo_fail(error, WO_ERR_NOMEM, "no memory for clip preferences");
    wo_arguments(&in, &out, instance, instance->time, NULL);
    for (size_t i = 0; i < object->port_count; i++)
        offer_clip(&out, object->ports[i]);
    wo_props_add_one(&out, kOfxImageEffectPropFrameRate, WO_PROP_DOUBLE, 1, true);
    wo_props_add_one(&out, kOfxImageClipPropFieldOrder, WO_PROP_STRING, 1, true);
    wo_props_add_one(&out, kOfxImageEffectPropPreMultiplication, WO_PROP_STRING, 1, true);
    wo_props_add_one(&out, kOfxImageClipPropContinuousSamples, WO_PROP_INT, 1, true);
    wo_props_add_one(&out, kOfxImageEffectFrameVarying, WO_PROP_INT, 1, true);
    wo_props_set_double(&out, kOfxImageEffectPropFrameRate, 0, p->frame_rate);
    wo_props_set_text(&out, kOfxImageClipPropFieldOrder, 0, kOfxImageFieldNone);
    wo_props_set_text(&out, kOfxImageEffectPropPreMultiplication, 0, alpha_texts[p->alpha]);
    wo_frame frame = {.action = WO_ACTION_PREFERENCES, .time = instance->time, .scale = {1, 1}};
    wo_status status = wo_act_on(instance, &frame, NULL, &out, NULL, error);
    if (status == WO_OK) {
        wo_frame_set(&frame); /* faults are those of this action */
        status = take_preferences(instance, &out, output, error);
        wo_frame_set(frame.outer);
    }
    if (status == WO_OK && output->props.failed) {
        output->props.failed = false;
        status = wo_fail(error, WO_ERR_NOMEM, "no memory for clip preferences");
    }
    wo_props_clear(&in);
    wo_props_clear(&out);
    return status;
}

/* --------------------------------------------------------------------------------- colourspaces */

static wo_status carry(wo_port *port, const char *colourspace, wo_error *error)
{
    wo_props_set_text(&port->props, kOfxImageClipPropColourspace, 0, colourspace);
    if (!port->props.failed && wo_text_set(&port->carries, colourspace))
        return WO_OK;
    port->props.failed = false;
    return wo_fail(error, WO_ERR_NOMEM, "no memory for a colourspace");
}

/* Colourspace an answer means: "OfxColourspace_<clip>" is that of a clip. */
static const char *resolve(const wo_host_instance *instance, const char *answer)
{
    static const char prefix[] = "OfxColourspace_";
    if (strncmp(answer, prefix, sizeof prefix - 1) != 0)
        return answer;
    const wo_port *port = wo_object_port(&instance->object, answer + sizeof prefix - 1);
    if (port && !port->output)
        return port->carries;
    wo_violate(instance->object.host, "%s: \"%.80s\" names no input clip",
               kOfxImageEffectActionGetOutputColourspace, answer);
    return "";
}

static wo_status ask_colourspace(wo_host_instance *instance, wo_port *output, const char *first,
                                 wo_error *error)
{
    wo_props in, out;
    OfxStatus answer = kOfxStatReplyDefault;
    wo_arguments(&in, &out, instance, instance->time, NULL);
    wo_props_add_one(&in, kOfxImageClipPropPreferredColourspaces, WO_PROP_STRING, 0, false);
    if (*first)
        wo_props_set_text(&in, kOfxImageClipPropPreferredColourspaces, 0, first);
    wo_props_add_one(&out, kOfxImageClipPropColourspace, WO_PROP_STRING, 1, true);
    wo_props_set_text(&out, kOfxImageClipPropColourspace, 0, first);
    wo_frame frame = {.action = WO_ACTION_COLOURSPACE, .time = instance->time, .scale = {1, 1}};
    wo_status status = wo_act_on(instance, &frame, &in, &out, &answer, error);
    if (status == WO_OK)
        status = carry(
            output,
            answer == kOfxStatOK
                ? resolve(instance, wo_props_text(&out, kOfxImageClipPropColourspace, 0, first))
                : first,
            error);
    wo_props_clear(&in);
    wo_props_clear(&out);
    return status;
}

static wo_status negotiate_colour(wo_host_instance *instance, wo_error *error)
{
    const char *first = "";
    const bool managed = strcmp(wo_props_text(&instance->object.props,
                                              kOfxImageEffectPropColourManagementStyle, 0, ""),
                                kOfxImageEffectColourManagementNone) != 0;
    wo_port *output = wo_object_port(&instance->object, kOfxImageEffectOutputClipName);
    for (size_t i = 0; i < instance->object.port_count; i++) {
        wo_port *port = instance->object.ports[i];
        const bool colour = managed && port->connected && port->components > 1 &&
                            !wo_props_int(&port->props, kOfxImageClipPropIsMask, 0, 0);
        if (port->output)
            continue;
        WO_TRY(carry(port, colour && port->colourspace ? port->colourspace : "", error));
        if (!*first)
            first = port->carries;
    }
    if (!managed)
        return carry(output, "", error);
    return ask_colourspace(instance, output, first, error);
}

wo_status wo_prepare(wo_host_instance *instance, wo_error *error)
{
    WO_TRY(check_connected(instance, error));
    if (instance->preferences_stale) {
        WO_TRY(ask_preferences(instance, error));
        instance->preferences_stale = false;
        instance->colourspace_stale = true;
    }
    if (instance->colourspace_stale) {
        WO_TRY(negotiate_colour(instance, error));
        instance->colourspace_stale = false;
    }
    return WO_OK;
}

wo_status wo_host_get_preferences(wo_host_instance *instance,
                                  const wo_host_preferences **preferences, wo_error *error)
{
    *preferences = NULL;
    WO_TRY(wo_prepare(instance, error));
    for (size_t i = 0; i < instance->object.port_count; i++) {
        const wo_port *port = instance->object.ports[i];
        instance->clip_preferences[i] = (wo_host_clip_preference){
            .clip = port->name,
            .connected = port->connected,
            .components = port->components,
            .pixel_aspect = wo_props_double(&port->props, kOfxImagePropPixelAspectRatio, 0, 1),
            .colourspaces = (const char *const *)port->wishes.items,
            .colourspace_count = port->wishes.count,
            .colourspace = port->carries,
        };
    }
    instance->preferences.clips = instance->clip_preferences;
    instance->preferences.clip_count = instance->object.port_count;
    *preferences = &instance->preferences;
    return WO_OK;
}
