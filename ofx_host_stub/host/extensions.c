/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "internal.h"

#include <string.h>

/* Properties with a name as the standard gives them that are none of the object's, and yet no
   fault: makers of hosts have named extensions so, and plugins set them in every host. The standard
   has taken over some later, for objects of another kind. */
static const char *const names[] = {
    /* layout of parameters, planes, views and formats in compositors */
    "OfxParamPropHint", /* the standard has it for parameters; clips are explained with it, too */
    "OfxParamPropLayoutHint",
    "OfxParamPropLayoutPadWidth",
    "OfxParamPropChoiceLabelOption",
    "OfxParamPropChoiceOrder", /* of the standard, for menus, which this host has none of */
    "OfxImageEffectPropIdentityPlane",
    "OfxImageEffectPropRenderPlanes",
    "OfxImageEffectPropRenderAllPlanes",
    "OfxImageEffectPropRenderView",
    "OfxImageEffectPropViewsToRender",
    "OfxImageClipPropFormat",
    "OfxImageEffectPropCanDistort",
    "OfxPropMatrix3x3",
    "OfxPropInverseDistortionFunction",
    "OfxPropInverseDistortionFunctionData",
    "OfxPropInverseDistortionFunctionDataSize",
    "OfxPropInverseDistortionDataFreeFunction",
    "OfxInteractPropScreenPixelRatio",
    "OfxPropOverlayColour",
    /* curves */
    "OfxHostPropSupportedParametricInterpolations",
    "OfxParamPropParametricIsPeriodic",
    "OfxParamParametricInterpolationCustomInterpCallbackV1",
    /* editors */
    "OfxImageEffectPropRenderQuality",
    "OfxImageEffectPropRenderQualityDraft", /* of hosts and renders, not of effects */
    "OfxImageEffectPropPixelOrder",
    "OfxImageEffectPropResolvePage",
    "OfxImageEffectPropHelpFile",
    "OfxImageEffectPropHelpContextID",
    "OfxParamPropParameterExpanded",
    "OfxParamPropColorWheelLevel",
    "OfxParamColorDefaultColorspace",
    "OfxImageEffectPluginPropHWndInteractV1",
    "kOfxImageClipPropThumbnail",
};

static const char *const beginnings[] = {
    "OfxImageEffectPropVegas",         "OfxPropVegas", "OfxProbPluginVegas", "OfxHWndInteractProp",
    "OfxImageClipPropFrameRangeView_",
};

bool wo_is_extension(const char *name)
{
    if (strncmp(name, "Ofx", 3) != 0 && strncmp(name, "kOfx", 4) != 0)
        return true; /* the standard owns no others */
    for (size_t i = 0; i < WO_COUNT(names); i++)
        if (strcmp(name, names[i]) == 0)
            return true;
    for (size_t i = 0; i < WO_COUNT(beginnings); i++)
        if (strncmp(name, beginnings[i], strlen(beginnings[i])) == 0)
            return true;
    return false;
}

void wo_note_extension(wo_host *host, const char *name)
{
    const wo_frame *frame = wo_frame_now();
    wo_note_once(host, name, "%s sets \"%.80s\", an extension that this host does not have",
                 frame && frame->entry ? frame->entry->info.identifier : "a plugin", name);
}
