/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name, *short_name;
} contexts[] = {
    {kOfxImageEffectContextFilter, "Filter"},
    {kOfxImageEffectContextGeneral, "General"},
    {kOfxImageEffectContextGenerator, "Generator"},
};

/* --------------------------------------------------------------------------------------- checks */

static bool is_group(const wo_object *object, const char *name)
{
    const wo_par *par = wo_object_param(object, name);
    return par && par->kind == WO_HOST_PARAM_GROUP;
}

static void check_default(const wo_par *par)
{
    const bool integer = wo_par_is_integer(par);
    const bool normalised =
        strcmp(wo_props_text(&par->props, kOfxParamPropDefaultCoordinateSystem, 0, ""),
               kOfxParamCoordinatesNormalised) == 0;
    for (int i = 0; i < par->dimension; i++) {
        double min, max;
        const double value = integer ? wo_props_int(&par->props, kOfxParamPropDefault, i, 0)
                                     : wo_props_double(&par->props, kOfxParamPropDefault, i, 0);
        wo_par_limits(par, i, &min, &max);
        if (par->kind == WO_HOST_PARAM_CHOICE && max < 0)
            wo_violate(NULL, "choice \"%.80s\" has no options", par->name);
        else if (!(min <= max))
            wo_violate(NULL, "the range of \"%.80s\" is %g to %g", par->name, min, max);
        else if (!normalised && !(value >= min && value <= max))
            wo_violate(NULL, "the default of \"%.80s\" is %g, outside of %g to %g", par->name,
                       value, min, max);
    }
    if (par->kind != WO_HOST_PARAM_STR_CHOICE)
        return;
    if (wo_props_count(&par->props, kOfxParamPropChoiceEnum) !=
        wo_props_count(&par->props, kOfxParamPropChoiceOption))
        wo_violate(NULL, "choice \"%.80s\" has not as many keys as options", par->name);
    if (!wo_props_has_text(&par->props, kOfxParamPropChoiceEnum,
                           wo_props_text(&par->props, kOfxParamPropDefault, 0, "")))
        wo_violate(NULL, "the default of \"%.80s\" is none of its keys", par->name);
}

static void check_params(const wo_object *object)
{
    for (size_t i = 0; i < object->param_count; i++) {
        const wo_par *par = object->params[i];
        const char *parent = wo_props_text(&par->props, kOfxParamPropParent, 0, "");
        if (*parent && !is_group(object, parent))
            wo_violate(NULL, "the parent of \"%.80s\" is \"%.80s\", which is no group", par->name,
                       parent);
        for (int k = 0; k < wo_props_count(&par->props, kOfxParamPropPageChild); k++) {
            const char *child = wo_props_text(&par->props, kOfxParamPropPageChild, k, "");
            if (!wo_object_param(object, child) && strcmp(child, kOfxParamPageSkipRow) != 0 &&
                strcmp(child, kOfxParamPageSkipColumn) != 0)
                wo_violate(NULL, "page \"%.80s\" holds \"%.80s\", which is no parameter", par->name,
                           child);
        }
        check_default(par);
    }
}

/* A plugin for several inputs that has no Source as a Filter, but has them all in General. */
static bool is_rather_general(const wo_object *object)
{
    return strcmp(object->context, kOfxImageEffectContextFilter) == 0 &&
           !wo_object_port(object, kOfxImageEffectSimpleSourceClipName) &&
           wo_object_port(object, kOfxImageEffectOutputClipName) &&
           wo_props_has_text(&object->props, kOfxImageEffectPropSupportedContexts,
                             kOfxImageEffectContextGeneral);
}

/* Clips a context cannot be without. */
static bool check_clips(const wo_object *object)
{
    const wo_port *output = wo_object_port(object, kOfxImageEffectOutputClipName);
    const wo_port *source = wo_object_port(object, kOfxImageEffectSimpleSourceClipName);
    const bool filter = strcmp(object->context, kOfxImageEffectContextFilter) == 0;
    const bool general = strcmp(object->context, kOfxImageEffectContextGeneral) == 0;
    bool ok = true;
    if (!output || (filter && !source)) {
        wo_violate(NULL, "the clip \"%s\" is not defined",
                   output ? kOfxImageEffectSimpleSourceClipName : kOfxImageEffectOutputClipName);
        ok = false;
    }
    for (size_t i = 0; i < object->port_count; i++) {
        const wo_port *port = object->ports[i];
        if (wo_props_count(&port->props, kOfxImageEffectPropSupportedComponents) == 0)
            wo_violate(NULL, "the clip \"%.80s\" supports no components", port->name);
        if (!general && port != output && !(filter && port == source) &&
            !wo_props_int(&port->props, kOfxImageClipPropOptional, 0, 0))
            wo_violate(NULL, "the clip \"%.80s\" is not optional", port->name);
    }
    return ok;
}

static void check_descriptor(const wo_object *object)
{
    const wo_props *props = &object->props;
    const char *safety = wo_props_text(props, kOfxImageEffectPluginRenderThreadSafety, 0, "");
    if (wo_props_count(props, kOfxImageEffectPropSupportedContexts) == 0)
        wo_violate(NULL, "it supports no contexts");
    if (wo_props_count(props, kOfxImageEffectPropSupportedPixelDepths) == 0)
        wo_violate(NULL, "it supports no pixel depths");
    if (!*wo_props_text(props, kOfxPropLabel, 0, ""))
        wo_violate(NULL, "it has no label");
    if (strcmp(safety, kOfxImageEffectRenderUnsafe) != 0 &&
        strcmp(safety, kOfxImageEffectRenderInstanceSafe) != 0 &&
        strcmp(safety, kOfxImageEffectRenderFullySafe) != 0)
        wo_violate(NULL, "\"%.80s\" is no degree of thread safety", safety);
    const char *identifier = object->entry->info.identifier;
    for (const char *c = identifier; *c; c++) {
        if (*c <= ' ' || *c > '~') {
            wo_violate(NULL, "the identifier has blanks or is not ASCII");
            break;
        }
    }
}

/* ---------------------------------------------------------------------------------- descriptors */

static void object_free(wo_object **object)
{
    if (*object)
        wo_object_clear(*object);
    free(*object);
    *object = NULL;
}

static wo_object *object_new(wo_entry *entry, const char *context)
{
    wo_object *object = calloc(1, sizeof *object);
    if (object && !wo_object_init(object, entry->host, entry, context, false))
        object_free(&object);
    return object;
}

/* Load and Describe. kOfxStatErrMemory without an answer when the host itself has no memory. */
static OfxStatus describe(wo_entry *entry)
{
    object_free(&entry->descriptor);
    OfxStatus status = wo_entry_load(entry);
    if (status != kOfxStatOK)
        return status;
    entry->descriptor = object_new(entry, NULL);
    if (!entry->descriptor)
        return kOfxStatErrMemory;
    wo_props_set_text(&entry->descriptor->props, kOfxPluginPropFilePath, 0, entry->bundle);
    wo_frame frame = {.action = WO_ACTION_DESCRIBE, .object = entry->descriptor, .scale = {1, 1}};
    return wo_act(entry, &frame, NULL, NULL);
}

/* The descriptor of a context starts as a copy of the plain one. */
static bool describe_context(wo_entry *entry, const char *context, wo_object **out,
                             OfxStatus *status, bool *rather_general)
{
    wo_props in;
    wo_object *object = object_new(entry, context);
    *out = object;
    if (!object)
        return false;
    const wo_props *from = &entry->descriptor->props;
    wo_props_copy(&object->props, from);
    for (size_t i = 0; i < from->count; i++)
        wo_props_find(&object->props, from->items[i].name)->plugin_writes =
            from->items[i].plugin_writes;
    wo_props_set_text(&object->props, kOfxImageEffectPropContext, 0, context);
    wo_props_init(&in, entry->host, WO_PROPS_NEVER, "the arguments");
    wo_props_add_one(&in, kOfxImageEffectPropContext, WO_PROP_STRING, 1, false);
    wo_props_set_text(&in, kOfxImageEffectPropContext, 0, context);
    const bool ready = !object->props.failed && !in.failed;
    wo_frame frame = {.action = WO_ACTION_DESCRIBE_IN_CONTEXT, .object = object, .scale = {1, 1}};
    if (ready)
        *status = wo_act(entry, &frame, &in, NULL);
    wo_props_clear(&in);
    if (ready && *status == kOfxStatOK) {
        wo_frame_set(&frame); /* so that faults are blamed on this action */
        check_params(object);
        if (is_rather_general(object)) {
            *rather_general = true;
            wo_note(entry->host, "%s: %s has no clip Source as Filter: General is offered",
                    entry->bundle, entry->identifier);
        } else if (!check_clips(object)) {
            *status = kOfxStatFailed;
        }
        wo_frame_set(frame.outer);
    }
    return ready;
}

/* -------------------------------------------------------------------------------- plain structs */

static unsigned component_bits(const wo_props *props)
{
    return (wo_props_has_text(props, kOfxImageEffectPropSupportedComponents,
                              kOfxImageComponentAlpha)
                ? WO_HOST_ALPHA
                : 0u) |
           (wo_props_has_text(props, kOfxImageEffectPropSupportedComponents, kOfxImageComponentRGB)
                ? WO_HOST_RGB
                : 0u) |
           (wo_props_has_text(props, kOfxImageEffectPropSupportedComponents, kOfxImageComponentRGBA)
                ? WO_HOST_RGBA
                : 0u);
}

static void fill_clip(wo_host_clip_info *info, const wo_port *port)
{
    const wo_props *props = &port->props;
    *info = (wo_host_clip_info){
        .name = port->name,
        .label = wo_props_text(props, kOfxPropLabel, 0, ""),
        .components = component_bits(props),
        .output = port->output,
        .optional = wo_props_int(props, kOfxImageClipPropOptional, 0, 0),
        .mask = wo_props_int(props, kOfxImageClipPropIsMask, 0, 0),
        .temporal = wo_props_int(props, kOfxImageEffectPropTemporalClipAccess, 0, 0),
        .tiles = wo_props_int(props, kOfxImageEffectPropSupportsTiles, 0, 1),
    };
}

/* Texts of a list property as an array; NULL for none, *ok false when out of memory. */
static const char **text_array(const wo_props *props, const char *name, bool *ok)
{
    const int count = wo_props_count(props, name);
    if (count == 0)
        return NULL;
    const char **texts = calloc((size_t)count, sizeof *texts);
    if (!texts)
        *ok = false;
    for (int i = 0; texts && i < count; i++)
        texts[i] = wo_props_text(props, name, i, "");
    return texts;
}

/* Numbers of a property whatever their type. */
static double number(const wo_props *props, const char *name, int index, double otherwise)
{
    const wo_prop *prop = wo_props_find(props, name);
    if (!prop || index >= prop->count)
        return otherwise;
    return prop->type == WO_PROP_INT ? prop->values[index].number : prop->values[index].real;
}

static bool fill_param(wo_host_param_info *info, const wo_par *par)
{
    const wo_props *props = &par->props;
    const bool is_double = par->dimension > 0 && !wo_par_is_integer(par);
    bool ok = true;
    *info = (wo_host_param_info){
        .name = par->name,
        .script_name = wo_props_text(props, kOfxParamPropScriptName, 0, par->name),
        .label = wo_props_text(props, kOfxPropLabel, 0, ""),
        .hint = wo_props_text(props, kOfxParamPropHint, 0, ""),
        .parent = wo_props_text(props, kOfxParamPropParent, 0, ""),
        .type = wo_props_text(props, kOfxParamPropType, 0, ""),
        .kind = par->kind,
        .dimension = par->dimension,
        .initial_text = par->is_text ? wo_props_text(props, kOfxParamPropDefault, 0, "") : "",
        .increment = wo_props_double(props, kOfxParamPropIncrement, 0, 1),
        .digits = wo_props_int(props, kOfxParamPropDigits, 0, 0),
        .double_type = is_double ? wo_props_text(props, kOfxParamPropDoubleType, 0, "") : "",
        .string_mode = wo_props_text(props, kOfxParamPropStringMode, 0, ""),
        .choices = text_array(props, kOfxParamPropChoiceOption, &ok),
        .choice_keys = text_array(props, kOfxParamPropChoiceEnum, &ok),
        .choice_count = (size_t)wo_props_count(props, kOfxParamPropChoiceOption),
        .normalised = strcmp(wo_props_text(props, kOfxParamPropDefaultCoordinateSystem, 0, ""),
                             kOfxParamCoordinatesNormalised) == 0,
        .animates = wo_par_animates(par),
        .secret = wo_props_int(props, kOfxParamPropSecret, 0, 0),
        .enabled = wo_props_int(props, kOfxParamPropEnabled, 0, 1),
        .evaluates = wo_props_int(props, kOfxParamPropEvaluateOnChange, 0, 1),
        .persistent = wo_props_int(props, kOfxParamPropPersistant, 0, 1),
        .open = wo_props_int(props, kOfxParamPropGroupOpen, 0, 1),
    };
    const wo_prop *low = wo_props_find(props, kOfxParamPropDisplayMin);
    const wo_prop *high = wo_props_find(props, kOfxParamPropDisplayMax);
    const bool colour = par->kind == WO_HOST_PARAM_RGB || par->kind == WO_HOST_PARAM_RGBA;
    for (int i = 0; i < par->dimension; i++) {
        info->initial[i] = number(props, kOfxParamPropDefault, i, 0);
        wo_par_limits(par, i, &info->min[i], &info->max[i]);
        /* Unset slider ranges are the hard ones, but for colours, which show 0 to 1. */
        info->ui_min[i] = low && (low->touched || colour)
                              ? number(props, kOfxParamPropDisplayMin, i, info->min[i])
                              : info->min[i];
        info->ui_max[i] = high && (high->touched || colour)
                              ? number(props, kOfxParamPropDisplayMax, i, info->max[i])
                              : info->max[i];
    }
    return ok;
}

static bool fill_context(wo_host_context_info *info, const wo_object *object,
                         const char *short_name)
{
    wo_host_clip_info *clips = calloc(object->port_count + 1, sizeof *clips);
    wo_host_param_info *params = calloc(object->param_count + 1, sizeof *params);
    bool ok = clips && params;
    *info = (wo_host_context_info){
        .name = object->context,
        .short_name = short_name,
        .clips = clips,
        .clip_count = clips ? object->port_count : 0,
        .params = params,
        .param_count = params ? object->param_count : 0,
    };
    for (size_t i = 0; i < info->clip_count; i++)
        fill_clip(&clips[i], object->ports[i]);
    for (size_t i = 0; i < info->param_count; i++)
        ok = fill_param(&params[i], object->params[i]) && ok;
    return ok;
}

static bool fill_plugin(wo_entry *entry)
{
    const wo_props *props = &entry->descriptor->props;
    const char *safety = wo_props_text(props, kOfxImageEffectPluginRenderThreadSafety, 0, "");
    wo_host_plugin *info = &entry->info;
    bool ok = true;
    info->label = wo_props_text(props, kOfxPropLabel, 0, "");
    info->group = wo_props_text(props, kOfxImageEffectPluginPropGrouping, 0, "");
    info->description = wo_props_text(props, kOfxPropPluginDescription, 0, "");
    info->context_names = entry->context_names =
        text_array(props, kOfxImageEffectPropSupportedContexts, &ok);
    info->context_name_count =
        entry->context_names ? (size_t)wo_props_count(props, kOfxImageEffectPropSupportedContexts)
                             : 0;
    info->contexts = entry->context_infos;
    info->context_count = entry->context_count;
    info->safety = strcmp(safety, kOfxImageEffectRenderFullySafe) == 0 ? WO_HOST_FULLY_SAFE
                   : strcmp(safety, kOfxImageEffectRenderUnsafe) == 0  ? WO_HOST_UNSAFE
                                                                       : WO_HOST_INSTANCE_SAFE;
    info->tiles = wo_props_int(props, kOfxImageEffectPropSupportsTiles, 0, 1);
    info->multi_resolution = wo_props_int(props, kOfxImageEffectPropSupportsMultiResolution, 0, 1);
    info->temporal = wo_props_int(props, kOfxImageEffectPropTemporalClipAccess, 0, 0);
    info->float_pixels =
        wo_props_has_text(props, kOfxImageEffectPropSupportedPixelDepths, kOfxBitDepthFloat);
    info->colour_style = wo_props_text(props, kOfxImageEffectPropColourManagementStyle, 0, "");
    return ok;
}

const char *wo_own_violation(const wo_entry *entry, size_t index)
{
    const char *text = wo_host_violation(entry->host, index);
    const size_t own = strlen(entry->identifier);
    const bool named =
        text && strncmp(text, entry->identifier, own) == 0 && strncmp(text + own, ": ", 2) == 0;
    return named ? text + own + 2 : text;
}

/* The answer of a plugin that fails; with the breach that it commits, if it does. */
static void note_failure(wo_entry *entry, const char *what, OfxStatus status, size_t breaches)
{
    const char *breach = wo_own_violation(entry, breaches);
    wo_note_failure(entry->host, "%s: %s %s: %s%s%s", entry->bundle, entry->identifier, what,
                    wo_ofx_status_text(status), breach ? "; " : "", breach ? breach : "");
}

bool wo_entry_describe(wo_entry *entry)
{
    const size_t breaches = wo_host_violation_count(entry->host);
    wo_host *host = entry->host;
    const char *identifier = entry->info.identifier;
    OfxStatus status = describe(entry);
    if (status == kOfxStatOK && host->config.strict) { /* as a well-known host does: once more */
        wo_entry_unload(entry);
        status = describe(entry);
    }
    if (status != kOfxStatOK) {
        note_failure(entry, "does not describe itself", status, breaches);
        return false;
    }
    wo_frame frame = {.outer = wo_frame_now(),
                      .host = host,
                      .entry = entry,
                      .object = entry->descriptor,
                      .action = WO_ACTION_DESCRIBE};
    wo_frame_set(&frame);
    check_descriptor(entry->descriptor);
    wo_frame_set(frame.outer);
    entry->contexts = calloc(WO_COUNT(contexts), sizeof *entry->contexts);
    entry->context_infos = calloc(WO_COUNT(contexts), sizeof *entry->context_infos);
    bool ok = entry->contexts && entry->context_infos;
    for (size_t i = 0; ok && i < WO_COUNT(contexts); i++) {
        const size_t n = entry->context_count;
        if (!wo_props_has_text(&entry->descriptor->props, kOfxImageEffectPropSupportedContexts,
                               contexts[i].name))
            continue;
        bool rather_general = false;
        ok = describe_context(entry, contexts[i].name, &entry->contexts[n], &status,
                              &rather_general);
        if (rather_general) {
            object_free(&entry->contexts[n]);
        } else if (ok && status == kOfxStatOK) {
            ok = fill_context(&entry->context_infos[n], entry->contexts[n], contexts[i].short_name);
            entry->context_count++;
        } else if (ok) {
            wo_note(host, "%s: %s does not describe itself as %s: %s", entry->bundle, identifier,
                    contexts[i].short_name, wo_ofx_status_text(status));
            object_free(&entry->contexts[n]);
        }
    }
    ok = ok && fill_plugin(entry);
    if (!ok)
        wo_note(host, "%s: %s: out of memory", entry->bundle, identifier);
    else if (entry->context_count == 0 && status == kOfxStatOK)
        wo_note(host, "%s: %s has no context this host can run", entry->bundle, identifier);
    else if (entry->context_count == 0)
        note_failure(entry, "describes itself in no context this host can run", status, breaches);
    return ok && entry->context_count > 0;
}

void wo_entry_forget(wo_entry *entry)
{
    for (size_t i = 0; entry->context_infos && i < WO_COUNT(contexts); i++) {
        wo_host_context_info *info = &entry->context_infos[i];
        for (size_t k = 0; k < info->param_count; k++) {
            free((void *)info->params[k].choices);
            free((void *)info->params[k].choice_keys);
        }
        free((void *)info->clips);
        free((void *)info->params);
    }
    for (size_t i = 0; entry->contexts && i < WO_COUNT(contexts); i++)
        object_free(&entry->contexts[i]);
    object_free(&entry->descriptor);
    free(entry->contexts);
    free(entry->context_infos);
    free(entry->context_names);
    entry->contexts = NULL;
    entry->context_infos = NULL;
    entry->context_names = NULL;
    entry->context_count = 0;
}

const wo_host_context_info *wo_host_find_context(const wo_host_plugin *plugin, const char *name)
{
    for (size_t i = 0; i < plugin->context_count; i++)
        if (strcmp(plugin->contexts[i].name, name) == 0 ||
            strcmp(plugin->contexts[i].short_name, name) == 0)
            return &plugin->contexts[i];
    return NULL;
}

const wo_host_param_info *wo_host_find_param(const wo_host_context_info *context, const char *name)
{
    for (size_t i = 0; i < context->param_count; i++)
        if (strcmp(context->params[i].name, name) == 0)
            return &context->params[i];
    for (size_t i = 0; i < context->param_count; i++)
        if (strcmp(context->params[i].script_name, name) == 0)
            return &context->params[i];
    return NULL;
}

const wo_host_clip_info *wo_host_find_clip(const wo_host_context_info *context, const char *name)
{
    for (size_t i = 0; i < context->clip_count; i++)
        if (strcmp(context->clips[i].name, name) == 0)
            return &context->clips[i];
    return NULL;
}
