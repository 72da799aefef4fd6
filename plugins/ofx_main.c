/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_describe.h"
#include "ofx_geometry.h"
#include "ofx_render.h"

#include "ofx/ofxColour.h"

#include <stdio.h>
#include <string.h>

enum { NAME_SIZE = 128 };

/* Name of the property of one clip among the arguments of an action. */
static const char *clip_property(char name[NAME_SIZE], const char *prefix, const char *clip)
{
    snprintf(name, NAME_SIZE, "%s%s", prefix, clip);
    return name;
}

static OfxStatus set_rect(const wo_ofx_action *action, const char *name, OfxRectD r)
{
    const double sides[4] = {r.x1, r.y1, r.x2, r.y2};
    for (int i = 0; i < 4; i++) {
        const OfxStatus status = wo_ofx_set_double(action->suites, action->out, name, i, sides[i]);
        if (status != kOfxStatOK)
            return status;
    }
    return kOfxStatOK;
}

/* The picture is where Source is, whatever other clips cover. */
static OfxStatus get_region_of_definition(wo_ofx_action *action)
{
    wo_ofx_read_geometry(action);
    if (!action->geometry.connected[0])
        return kOfxStatReplyDefault;
    return set_rect(action, kOfxImageEffectPropRegionOfDefinition, action->region);
}

static wo_status regions_of_interest(wo_ofx_action *action)
{
    const wo_effect *const effect = action->effect;
    char name[NAME_SIZE];
    double sides[4];

    WO_TRY(wo_ofx_action_read(action));
    if (!wo_ofx_read_doubles(action->suites, action->in, kOfxImageEffectPropRegionOfInterest, 4,
                             sides))
        return wo_fail(&action->error, WO_ERR_ARGUMENT, "the host names no region of interest");
    const OfxRectD region = {sides[0], sides[1], sides[2], sides[3]};
    const wo_rect window = wo_ofx_to_pixels(action, region);
    for (size_t i = 0; i < effect->clip_count; i++) {
        wo_rect needed = {0, 0, 0, 0}, extent;
        if (!action->geometry.connected[i])
            continue;
        WO_TRY(
            effect->region(action->params, &action->geometry, window, i, &needed, &action->error));
        /* Never nothing: a window beside a small clip still sees its edge. */
        if (wo_ofx_clip_extent(action, i, &extent))
            needed = wo_ofx_visible(needed, extent);
        /* A host that does not know the property fetches what it likes; render looks again. */
        set_rect(action, clip_property(name, "OfxImageClipPropRoI_", effect->clips[i].name),
                 wo_ofx_to_canonical(action, needed));
    }
    return WO_OK;
}

/* A host copies the clip as it is, so that must be what rendering would make: premultiplied RGBA.
 */
static bool is_plain_copy(const wo_ofx_action *action, size_t clip)
{
    const OfxPropertySetHandle set = action->clips[clip].properties;
    const char *const components =
        wo_ofx_get_string(action->suites, set, kOfxImageEffectPropComponents);
    const char *const alpha =
        wo_ofx_get_string(action->suites, set, kOfxImageEffectPropPreMultiplication);
    return components && strcmp(components, kOfxImageComponentRGBA) == 0 &&
           !(alpha && strcmp(alpha, kOfxImageUnPreMultiplied) == 0);
}

static wo_status is_identity(wo_ofx_action *action, bool *identity)
{
    const wo_effect *const effect = action->effect;
    *identity = false;
    WO_TRY(wo_ofx_action_read(action));
    const int clip = effect->identity(action->params, &action->geometry);
    if (clip < 0 || (size_t)clip >= effect->clip_count || !action->geometry.connected[clip] ||
        !is_plain_copy(action, (size_t)clip))
        return WO_OK;
    *identity =
        wo_ofx_set_string(action->suites, action->out, kOfxPropName, 0, effect->clips[clip].name) ==
            kOfxStatOK &&
        wo_ofx_set_double(action->suites, action->out, kOfxPropTime, 0, action->time) == kOfxStatOK;
    return WO_OK;
}

/* Colour comes scene-linear and data as it is, if the host can; wishes are those its style knows.
 */
static void wish_colourspaces(const wo_ofx_action *action, const wo_clip *clip)
{
    const wo_ofx_suites *const s = action->suites;
    const char *const style =
        wo_ofx_get_string(s, action->properties, kOfxImageEffectPropColourManagementStyle);
    const char *components[3];
    char name[NAME_SIZE];
    int count = 0;

    if (!style || strcmp(style, kOfxImageEffectColourManagementNone) == 0 || clip->mask ||
        (wo_ofx_components(clip->components, components) == 1 &&
         clip->components == WO_COMPONENT_ALPHA))
        return;
    clip_property(name, "OfxImageClipPropPreferredColourspaces_", clip->name);
    if (clip->data) {
        wo_ofx_set_string(s, action->out, name, 0, kOfxColourspaceOfxRaw);
        return;
    }
    if (strcmp(style, kOfxImageEffectColourManagementBasic) != 0)
        wo_ofx_set_string(s, action->out, name, count++, kOfxColourspaceLinRec709Srgb);
    wo_ofx_set_string(s, action->out, name, count, kOfxColourspaceOfxSceneLinear);
}

static OfxStatus get_clip_preferences(const wo_ofx_action *action)
{
    const wo_ofx_suites *const s = action->suites;
    const wo_effect *const effect = action->effect;
    const char *const context =
        wo_ofx_get_string(s, action->properties, kOfxImageEffectPropContext);
    const bool depths =
        wo_ofx_get_int(s, s->host, kOfxImageEffectPropSupportsMultipleClipDepths, 0) != 0;
    char name[NAME_SIZE];

    /* Only in the General context may a plugin choose the components of its output. */
    if (context && strcmp(context, kOfxImageEffectContextGeneral) == 0)
        wo_ofx_set_string(
            s, action->out,
            clip_property(name, "OfxImageClipPropComponents_", kOfxImageEffectOutputClipName), 0,
            kOfxImageComponentRGBA);
    if (depths)
        wo_ofx_set_string(
            s, action->out,
            clip_property(name, "OfxImageClipPropDepth_", kOfxImageEffectOutputClipName), 0,
            kOfxBitDepthFloat);
    for (size_t i = 0; i < effect->clip_count; i++) {
        if (!wo_ofx_clip_connected(action, i))
            continue;
        if (depths)
            wo_ofx_set_string(s, action->out,
                              clip_property(name, "OfxImageClipPropDepth_", effect->clips[i].name),
                              0, kOfxBitDepthFloat);
        wish_colourspaces(action, &effect->clips[i]);
    }
    wo_ofx_set_string(s, action->out, kOfxImageEffectPropPreMultiplication, 0,
                      kOfxImagePreMultiplied);
    return kOfxStatOK;
}

static OfxStatus load(wo_ofx_plugin *plugin)
{
    const wo_effect *const effect = plugin->effect();
    if (!effect || effect->clip_count < 1 || effect->clip_count > WO_CLIPS_MAX)
        return kOfxStatFailed;
    return wo_ofx_fetch_suites(plugin->host, &plugin->suites);
}

/* Actions on an instance, after the arguments have been looked at. */
static OfxStatus act(const wo_ofx_plugin *plugin, const char *name, OfxImageEffectHandle handle,
                     OfxPropertySetHandle in, OfxPropertySetHandle out)
{
    wo_ofx_action action;
    wo_status status = WO_OK;
    bool identity = false;

    if (strcmp(name, kOfxImageEffectActionRender) == 0)
        return in ? wo_ofx_render(plugin, handle, in) : kOfxStatFailed;
    if (strcmp(name, kOfxActionCreateInstance) == 0)
        return wo_ofx_instance_create(plugin, handle);
    if (strcmp(name, kOfxActionDestroyInstance) == 0)
        return wo_ofx_instance_destroy(plugin, handle);
    if (!out)
        return kOfxStatReplyDefault;

    if (strcmp(name, kOfxImageEffectActionGetRegionOfDefinition) == 0) {
        wo_ofx_action_begin(&action, plugin, handle, in, out);
        return get_region_of_definition(&action);
    }
    if (strcmp(name, kOfxImageEffectActionGetClipPreferences) == 0) {
        wo_ofx_action_begin(&action, plugin, handle, in, out);
        return get_clip_preferences(&action);
    }
    if (strcmp(name, kOfxImageEffectActionGetRegionsOfInterest) == 0) {
        wo_ofx_action_begin(&action, plugin, handle, in, out);
        status = regions_of_interest(&action);
        return wo_ofx_action_end(&action, status, false);
    }
    if (strcmp(name, kOfxImageEffectActionIsIdentity) == 0) {
        wo_ofx_action_begin(&action, plugin, handle, in, out);
        status = is_identity(&action, &identity);
        const OfxStatus answer = wo_ofx_action_end(&action, status, identity);
        return answer == kOfxStatOK && !identity ? kOfxStatReplyDefault : answer;
    }
    return kOfxStatReplyDefault;
}

OfxStatus wo_ofx_main(wo_ofx_plugin *plugin, const char *action, const void *handle,
                      OfxPropertySetHandle in, OfxPropertySetHandle out)
{
    const OfxImageEffectHandle effect = (OfxImageEffectHandle)handle;

    if (!action)
        return kOfxStatErrValue;
    if (strcmp(action, kOfxActionLoad) == 0)
        return load(plugin);
    if (strcmp(action, kOfxActionUnload) == 0) {
        plugin->suites = (wo_ofx_suites){0};
        return kOfxStatOK;
    }
    if (!plugin->suites.property) /* never loaded, or the host was refused */
        return kOfxStatErrMissingHostFeature;
    if (!effect)
        return kOfxStatErrBadHandle;
    if (strcmp(action, kOfxActionDescribe) == 0)
        return wo_ofx_describe(plugin, effect);
    if (strcmp(action, kOfxImageEffectActionDescribeInContext) == 0)
        return wo_ofx_describe_in_context(plugin, effect, in);
    return act(plugin, action, effect, in, out);
}
