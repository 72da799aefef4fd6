/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_describe.h"

#include "ofx_overlay.h"

#include "ofx/ofxColour.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define TRY_OFX(call)                                                                              \
    do {                                                                                           \
        const OfxStatus try_status = (call);                                                       \
        if (try_status != kOfxStatOK)                                                              \
            return try_status;                                                                     \
    } while (0)

static const char page_name[] = "Controls";

static void set_labels(const wo_ofx_suites *s, OfxPropertySetHandle set, const char *label)
{
    wo_ofx_set_string(s, set, kOfxPropLabel, 0, label);
    wo_ofx_set_string(s, set, kOfxPropShortLabel, 0, label);
    wo_ofx_set_string(s, set, kOfxPropLongLabel, 0, label);
}

/* Colour management is offered to hosts that speak of it; pixels are wanted scene-linear then. */
static void offer_colour_management(const wo_ofx_suites *s, OfxPropertySetHandle set)
{
    const char *const style =
        wo_ofx_get_string(s, s->host, kOfxImageEffectPropColourManagementStyle);
    if (!style || strcmp(style, kOfxImageEffectColourManagementNone) == 0)
        return;
    wo_ofx_set_string(s, set, kOfxImageEffectPropColourManagementStyle, 0,
                      kOfxImageEffectColourManagementCore);
    wo_ofx_set_string(s, set, kOfxImageEffectPropColourManagementAvailableConfigs, 0,
                      kOfxConfigIdentifier);
}

OfxStatus wo_ofx_describe(const wo_ofx_plugin *plugin, OfxImageEffectHandle handle)
{
    static const char *const contexts[] = {kOfxImageEffectContextFilter,
                                           kOfxImageEffectContextGeneral};
    static const char *const depths[] = {kOfxBitDepthFloat, kOfxBitDepthHalf, kOfxBitDepthShort,
                                         kOfxBitDepthByte};
    static const struct {
        const char *name;
        int value;
    } flags[] = {
        {kOfxImageEffectPluginPropSingleInstance, 0},
        {kOfxImageEffectPluginPropHostFrameThreading, 0},
        {kOfxImageEffectPropSupportsMultiResolution, 1},
        {kOfxImageEffectPropSupportsTiles, 1},
        {kOfxImageEffectPropTemporalClipAccess, 0},
        {kOfxImageEffectPluginPropFieldRenderTwiceAlways, 0},
        {kOfxImageEffectPropSupportsMultipleClipDepths, 1},
        {kOfxImageEffectPropSupportsMultipleClipPARs, 0},
    };
    const wo_ofx_suites *const s = &plugin->suites;
    const wo_effect *const effect = plugin->effect();
    OfxPropertySetHandle set = NULL;

    TRY_OFX(s->effect->getPropertySet(handle, &set));
    set_labels(s, set, effect->label);
    wo_ofx_set_string(s, set, kOfxImageEffectPluginPropGrouping, 0, plugin->group);
    for (size_t i = 0; i < WO_COUNT(contexts); i++)
        TRY_OFX(
            wo_ofx_set_string(s, set, kOfxImageEffectPropSupportedContexts, (int)i, contexts[i]));
    for (size_t i = 0; i < WO_COUNT(depths); i++)
        TRY_OFX(
            wo_ofx_set_string(s, set, kOfxImageEffectPropSupportedPixelDepths, (int)i, depths[i]));

    /* A host that does not know one of these behaves as if it was not set, which does no harm. */
    for (size_t i = 0; i < WO_COUNT(flags); i++)
        wo_ofx_set_int(s, set, flags[i].name, 0, flags[i].value);
    wo_ofx_set_string(s, set, kOfxImageEffectPluginRenderThreadSafety, 0,
                      kOfxImageEffectRenderFullySafe);
    const int version[] = {WO_VERSION_MAJOR, WO_VERSION_MINOR, WO_VERSION_PATCH};
    for (size_t i = 0; i < WO_COUNT(version); i++)
        wo_ofx_set_int(s, set, kOfxPropVersion, (int)i, version[i]);
    wo_ofx_set_string(s, set, kOfxPropVersionLabel, 0, WO_VERSION_TEXT);
    if (effect->help)
        wo_ofx_set_string(s, set, kOfxPropPluginDescription, 0, effect->help);
    offer_colour_management(s, set);
    wo_ofx_overlay_describe(plugin, set);
    return kOfxStatOK;
}

int wo_ofx_components(uint32_t components, const char *names[3])
{
    int count = 0;
    if (components & WO_COMPONENT_RGBA)
        names[count++] = kOfxImageComponentRGBA;
    if (components & WO_COMPONENT_RGB)
        names[count++] = kOfxImageComponentRGB;
    if (components & WO_COMPONENT_ALPHA)
        names[count++] = kOfxImageComponentAlpha;
    return count;
}

static OfxStatus define_clip(const wo_ofx_suites *s, OfxImageEffectHandle handle,
                             const wo_clip *clip, bool optional)
{
    const char *components[3];
    const int count = wo_ofx_components(clip->components, components);
    OfxPropertySetHandle set = NULL;

    TRY_OFX(s->effect->clipDefine(handle, clip->name, &set));
    if (clip->label)
        set_labels(s, set, clip->label);
    for (int i = 0; i < count; i++)
        TRY_OFX(
            wo_ofx_set_string(s, set, kOfxImageEffectPropSupportedComponents, i, components[i]));
    TRY_OFX(wo_ofx_set_int(s, set, kOfxImageClipPropOptional, 0, optional));
    wo_ofx_set_int(s, set, kOfxImageClipPropIsMask, 0, clip->mask);
    wo_ofx_set_int(s, set, kOfxImageEffectPropTemporalClipAccess, 0, 0);
    wo_ofx_set_int(s, set, kOfxImageEffectPropSupportsTiles, 0, 1);
    return kOfxStatOK;
}

/* OpenFX type of a row, and whether this host can animate it. */
static const char *type_of(const wo_ofx_suites *s, const wo_param *param, bool *animates)
{
    const char *ability = NULL, *type = kOfxParamTypeDouble;
    switch (param->type) {
    case WO_PARAM_DOUBLE:
        break;
    case WO_PARAM_INT:
        type = kOfxParamTypeInteger;
        break;
    case WO_PARAM_BOOL:
        type = kOfxParamTypeBoolean;
        ability = kOfxParamHostPropSupportsBooleanAnimation;
        break;
    case WO_PARAM_CHOICE:
        type = kOfxParamTypeChoice;
        ability = kOfxParamHostPropSupportsChoiceAnimation;
        break;
    case WO_PARAM_POINT:
        type = kOfxParamTypeDouble2D;
        break;
    case WO_PARAM_COLOUR:
        type = kOfxParamTypeRGB;
        break;
    case WO_PARAM_STRING:
        type = kOfxParamTypeString;
        ability = kOfxParamHostPropSupportsStringAnimation;
        break;
    }
    *animates = param->animates && (!ability || wo_ofx_get_int(s, s->host, ability, 0) != 0);
    return type;
}

/* Step of a control: the power of ten at or below a thousandth of the slider. */
static double step_of(const wo_param *param)
{
    const double range = param->ui_max - param->ui_min;
    return range > 0 && range < 1e12 ? pow(10, floor(log10(range / 1000) + 1e-9)) : 0.01;
}

static OfxStatus describe_doubles(const wo_ofx_suites *s, OfxPropertySetHandle set,
                                  const wo_param *param)
{
    const double step = step_of(param);
    const double digits = fmin(fmax(ceil(-log10(step) - 1e-9), 0), 6);
    for (int i = 0; i < wo_param_values(param); i++) {
        TRY_OFX(wo_ofx_set_double(s, set, kOfxParamPropDefault, i, param->initial[i]));
        wo_ofx_set_double(s, set, kOfxParamPropMin, i, param->min);
        wo_ofx_set_double(s, set, kOfxParamPropMax, i, param->max);
        wo_ofx_set_double(s, set, kOfxParamPropDisplayMin, i, param->ui_min);
        wo_ofx_set_double(s, set, kOfxParamPropDisplayMax, i, param->ui_max);
    }
    if (param->type == WO_PARAM_COLOUR)
        return kOfxStatOK;
    wo_ofx_set_double(s, set, kOfxParamPropIncrement, 0, step);
    wo_ofx_set_int(s, set, kOfxParamPropDigits, 0, (int)digits);
    /* Other units stay plain: hosts rescale some of the typed lengths behind the plugin's back. */
    wo_ofx_set_string(s, set, kOfxParamPropDoubleType, 0,
                      param->unit && strcmp(param->unit, "deg") == 0 ? kOfxParamDoubleTypeAngle
                                                                     : kOfxParamDoubleTypePlain);
    return kOfxStatOK;
}

static int whole(double value)
{
    return (int)fmin(fmax(value, INT32_MIN), INT32_MAX);
}

static OfxStatus describe_values(const wo_ofx_suites *s, OfxPropertySetHandle set,
                                 const wo_param *param)
{
    const char *const *const labels = param->choice_labels ? param->choice_labels : param->choices;
    switch (param->type) {
    case WO_PARAM_DOUBLE:
    case WO_PARAM_POINT:
    case WO_PARAM_COLOUR:
        return describe_doubles(s, set, param);
    case WO_PARAM_INT:
        wo_ofx_set_int(s, set, kOfxParamPropMin, 0, whole(param->min));
        wo_ofx_set_int(s, set, kOfxParamPropMax, 0, whole(param->max));
        wo_ofx_set_int(s, set, kOfxParamPropDisplayMin, 0, whole(param->ui_min));
        wo_ofx_set_int(s, set, kOfxParamPropDisplayMax, 0, whole(param->ui_max));
        break;
    case WO_PARAM_CHOICE:
        for (int i = 0; i < wo_param_choice_count(param); i++)
            TRY_OFX(wo_ofx_set_string(s, set, kOfxParamPropChoiceOption, i, labels[i]));
        break;
    case WO_PARAM_STRING:
        return wo_ofx_set_string(s, set, kOfxParamPropDefault, 0,
                                 param->initial_text ? param->initial_text : "");
    case WO_PARAM_BOOL:
        break;
    }
    return wo_ofx_set_int(s, set, kOfxParamPropDefault, 0, whole(param->initial[0]));
}

static void set_hint(const wo_ofx_suites *s, OfxPropertySetHandle set, const wo_param *param)
{
    char hint[2048];
    const char *const help = param->help ? param->help : "";
    if (param->unit && param->unit[0])
        snprintf(hint, sizeof hint, "%s [%s]", help, param->unit);
    else
        snprintf(hint, sizeof hint, "%s", help);
    wo_ofx_set_string(s, set, kOfxParamPropHint, 0, hint);
}

/* A host that cannot make a parameter says so in one way or another; the effect then runs with the
   default. */
static bool is_lack(OfxStatus status)
{
    return status != kOfxStatErrMemory && status != kOfxStatErrFatal;
}

static OfxStatus define_group(const wo_ofx_suites *s, OfxParamSetHandle params,
                              const wo_param_group *group, bool *defined)
{
    OfxPropertySetHandle set = NULL;
    OfxStatus status = s->param->paramDefine(params, kOfxParamTypeGroup, group->key, &set);
    if (status == kOfxStatOK && !set)
        status = kOfxStatFailed;
    *defined = status == kOfxStatOK;
    if (status != kOfxStatOK)
        return is_lack(status) ? kOfxStatOK : status;
    set_labels(s, set, group->label);
    wo_ofx_set_int(s, set, kOfxParamPropGroupOpen, 0, group->open);
    return kOfxStatOK;
}

static OfxStatus define_param(const wo_ofx_suites *s, OfxParamSetHandle params,
                              const wo_param *param, bool has_groups, bool *defined)
{
    bool animates = false;
    OfxPropertySetHandle set = NULL;
    const char *const type = type_of(s, param, &animates);
    OfxStatus status = s->param->paramDefine(params, type, param->key, &set);

    if (status == kOfxStatOK && !set)
        status = kOfxStatFailed;
    *defined = status == kOfxStatOK;
    if (status != kOfxStatOK)
        return is_lack(status) ? kOfxStatOK : status;
    set_labels(s, set, param->label);
    set_hint(s, set, param);
    wo_ofx_set_string(s, set, kOfxParamPropScriptName, 0, param->key);
    wo_ofx_set_int(s, set, kOfxParamPropAnimates, 0, animates);
    if (has_groups && param->group && param->group[0])
        wo_ofx_set_string(s, set, kOfxParamPropParent, 0, param->group);
    return describe_values(s, set, param);
}

static OfxStatus define_params(const wo_ofx_suites *s, OfxImageEffectHandle handle,
                               const wo_effect *effect)
{
    OfxParamSetHandle params = NULL;
    OfxPropertySetHandle page = NULL;
    bool has_groups = true;
    int children = 0;

    TRY_OFX(s->effect->getParamSet(handle, &params));
    for (size_t i = 0; i < effect->group_count && has_groups; i++)
        TRY_OFX(define_group(s, params, &effect->groups[i], &has_groups));
    if (s->param->paramDefine(params, kOfxParamTypePage, page_name, &page) == kOfxStatOK && page)
        set_labels(s, page, page_name);
    else
        page = NULL;
    for (size_t i = 0; i < effect->param_count; i++) {
        bool defined = false;
        TRY_OFX(define_param(s, params, &effect->params[i], has_groups, &defined));
        if (page && defined)
            wo_ofx_set_string(s, page, kOfxParamPropPageChild, children++, effect->params[i].key);
    }
    return kOfxStatOK;
}

OfxStatus wo_ofx_describe_in_context(const wo_ofx_plugin *plugin, OfxImageEffectHandle handle,
                                     OfxPropertySetHandle in)
{
    static const wo_clip output = {
        .name = kOfxImageEffectOutputClipName, .label = "Output", .components = WO_COMPONENT_RGBA};
    const wo_ofx_suites *const s = &plugin->suites;
    const wo_effect *const effect = plugin->effect();
    const char *const context = wo_ofx_get_string(s, in, kOfxImageEffectPropContext);
    /* In a filter only Source may be demanded. */
    const bool filter = !context || strcmp(context, kOfxImageEffectContextGeneral) != 0;

    if (context && filter && strcmp(context, kOfxImageEffectContextFilter) != 0)
        return kOfxStatErrUnsupported;
    for (size_t i = 0; i < effect->clip_count; i++)
        TRY_OFX(define_clip(s, handle, &effect->clips[i],
                            effect->clips[i].optional || (filter && i > 0)));
    TRY_OFX(define_clip(s, handle, &output, false));
    return define_params(s, handle, effect);
}
