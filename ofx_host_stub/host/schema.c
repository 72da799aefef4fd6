/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "internal.h"

#include "wideopen/base.h"
#include "wideopen/ofx_camera.h"

#include <float.h>
#include <limits.h>
#include <string.h>

/* Which object has which properties, of which type, how many, who writes. W: the plugin may; R:
   only the host does. */
#define INT_W(name, count, number)                                                                 \
    {                                                                                              \
        name, WO_PROP_INT, count, true, number, NULL                                               \
    }
#define INT_R(name, count, number)                                                                 \
    {                                                                                              \
        name, WO_PROP_INT, count, false, number, NULL                                              \
    }
#define DOUBLE_W(name, count, number)                                                              \
    {                                                                                              \
        name, WO_PROP_DOUBLE, count, true, number, NULL                                            \
    }
#define DOUBLE_R(name, count, number)                                                              \
    {                                                                                              \
        name, WO_PROP_DOUBLE, count, false, number, NULL                                           \
    }
#define TEXT_W(name, count, text)                                                                  \
    {                                                                                              \
        name, WO_PROP_STRING, count, true, 0, text                                                 \
    }
#define TEXT_R(name, count, text)                                                                  \
    {                                                                                              \
        name, WO_PROP_STRING, count, false, 0, text                                                \
    }
#define POINTER_W(name)                                                                            \
    {                                                                                              \
        name, WO_PROP_POINTER, 1, true, 0, NULL                                                    \
    }
#define POINTER_R(name)                                                                            \
    {                                                                                              \
        name, WO_PROP_POINTER, 1, false, 0, NULL                                                   \
    }

#define ADD(props, rows) wo_props_add(props, rows, WO_COUNT(rows))

static const wo_prop_row host_rows[] = {
    INT_R(kOfxPropAPIVersion, 0, 0),
    TEXT_R(kOfxPropType, 1, kOfxTypeImageEffectHost),
    TEXT_R(kOfxPropName, 1, "org.wideopen.host"),
    TEXT_R(kOfxPropLabel, 1, "WideOpen"),
    INT_R(kOfxPropVersion, 0, 0),
    TEXT_R(kOfxPropVersionLabel, 1, WO_VERSION_TEXT),
    POINTER_R(kOfxPropHostOSHandle),
    INT_R(kOfxImageEffectHostPropIsBackground, 1, 0),
    TEXT_R(kOfxImageEffectHostPropNativeOrigin, 1, kOfxHostNativeOriginBottomLeft),
    INT_R(kOfxImageEffectPropSupportsOverlays, 1, 0),
    INT_R(kOfxImageEffectPropSupportsMultiResolution, 1, 1),
    INT_R(kOfxImageEffectPropSupportsTiles, 1, 1),
    INT_R(kOfxImageEffectPropTemporalClipAccess, 1, 1),
    TEXT_R(kOfxImageEffectPropSupportedComponents, 0, NULL),
    TEXT_R(kOfxImageEffectPropSupportedContexts, 0, NULL),
    TEXT_R(kOfxImageEffectPropSupportedPixelDepths, 0, NULL),
    INT_R(kOfxImageEffectPropSupportsMultipleClipDepths, 1, 0),
    INT_R(kOfxImageEffectPropSupportsMultipleClipPARs, 1, 0),
    INT_R(kOfxImageEffectPropSetableFrameRate, 1, 0),
    INT_R(kOfxImageEffectPropSetableFielding, 1, 0),
    INT_R(kOfxImageEffectInstancePropSequentialRender, 1, 0),
    INT_R(kOfxImageEffectPropRenderQualityDraft, 1, 1),
    INT_R(kOfxParamHostPropSupportsCustomInteract, 1, 0),
    INT_R(kOfxParamHostPropSupportsStringAnimation, 1, 1),
    INT_R(kOfxParamHostPropSupportsChoiceAnimation, 1, 1),
    INT_R(kOfxParamHostPropSupportsBooleanAnimation, 1, 1),
    INT_R(kOfxParamHostPropSupportsCustomAnimation, 1, 0),
    INT_R(kOfxParamHostPropSupportsStrChoice, 1, 1),
    INT_R(kOfxParamHostPropSupportsStrChoiceAnimation, 1, 1),
    INT_R("OfxParamHostPropSupportsParametricAnimation", 1, 0),
    INT_R(kOfxParamHostPropMaxParameters, 1, -1),
    INT_R(kOfxParamHostPropMaxPages, 1, 0),
    INT_R(kOfxParamHostPropPageRowColumnCount, 2, 0),
    TEXT_R(kOfxImageEffectPropCPURenderSupported, 1, "true"),
    TEXT_R(kOfxImageEffectPropOpenGLRenderSupported, 1, "false"),
    TEXT_R(kOfxImageEffectPropCudaRenderSupported, 1, "false"),
    TEXT_R(kOfxImageEffectPropCudaStreamSupported, 1, "false"),
    TEXT_R(kOfxImageEffectPropMetalRenderSupported, 1, "false"),
    TEXT_R(kOfxImageEffectPropOpenCLRenderSupported, 1, "false"),
    TEXT_R(kOfxImageEffectPropOpenCLSupported, 1, "false"),
    TEXT_R(kOfxImageEffectPropColourManagementStyle, 1, kOfxImageEffectColourManagementCore),
    TEXT_R(kOfxImageEffectPropColourManagementAvailableConfigs, 0, NULL),
};

static const wo_prop_row descriptor_rows[] = {
    TEXT_R(kOfxPropType, 1, kOfxTypeImageEffect),
    TEXT_W(kOfxPropLabel, 1, ""),
    TEXT_W(kOfxPropShortLabel, 1, ""),
    TEXT_W(kOfxPropLongLabel, 1, ""),
    INT_W(kOfxPropVersion, 0, 0),
    TEXT_W(kOfxPropVersionLabel, 1, ""),
    TEXT_W(kOfxPropPluginDescription, 1, ""),
    TEXT_W(kOfxPropIcon, 2, ""),
    TEXT_R(kOfxImageEffectPropContext, 1, ""),
    TEXT_W(kOfxImageEffectPropSupportedContexts, 0, NULL),
    TEXT_W(kOfxImageEffectPluginPropGrouping, 1, ""),
    INT_W(kOfxImageEffectPluginPropObsolete, 1, 0),
    INT_W(kOfxImageEffectPluginPropSingleInstance, 1, 0),
    TEXT_W(kOfxImageEffectPluginRenderThreadSafety, 1, kOfxImageEffectRenderInstanceSafe),
    INT_W(kOfxImageEffectPluginPropHostFrameThreading, 1, 1),
    POINTER_W(kOfxImageEffectPluginPropOverlayInteractV1),
    POINTER_W(kOfxImageEffectPluginPropOverlayInteractV2),
    INT_W(kOfxImageEffectPropSupportsOverlays, 1, 1),
    INT_W(kOfxImageEffectPropSupportsMultiResolution, 1, 1),
    INT_W(kOfxImageEffectPropSupportsTiles, 1, 1),
    INT_W(kOfxImageEffectPropTemporalClipAccess, 1, 0),
    TEXT_W(kOfxImageEffectPropSupportedPixelDepths, 0, NULL),
    INT_W(kOfxImageEffectPluginPropFieldRenderTwiceAlways, 1, 1),
    INT_W(kOfxImageEffectPropSupportsMultipleClipDepths, 1, 0),
    INT_W(kOfxImageEffectPropSupportsMultipleClipPARs, 1, 0),
    TEXT_W(kOfxImageEffectPropClipPreferencesSlaveParam, 0, NULL),
    INT_W(kOfxImageEffectInstancePropSequentialRender, 1, 0),
    TEXT_W(kOfxImageEffectPropNoSpatialAwareness, 1, "false"),
    TEXT_R(kOfxPluginPropFilePath, 1, ""),
    TEXT_W(kOfxImageEffectPropCPURenderSupported, 1, "true"),
    TEXT_W(kOfxImageEffectPropOpenGLRenderSupported, 1, "false"),
    TEXT_W(kOfxOpenGLPropPixelDepth, 0, NULL),
    TEXT_W(kOfxImageEffectPropCudaRenderSupported, 1, "false"),
    TEXT_W(kOfxImageEffectPropCudaStreamSupported, 1, "false"),
    TEXT_W(kOfxImageEffectPropMetalRenderSupported, 1, "false"),
    TEXT_W(kOfxImageEffectPropOpenCLRenderSupported, 1, "false"),
    TEXT_W(kOfxImageEffectPropOpenCLSupported, 1, "false"),
    TEXT_W(kOfxImageEffectPropColourManagementStyle, 1, kOfxImageEffectColourManagementNone),
    TEXT_W(kOfxImageEffectPropColourManagementAvailableConfigs, 0, NULL),
};

static const wo_prop_row instance_rows[] = {
    TEXT_R(kOfxPropType, 1, kOfxTypeImageEffectInstance),
    TEXT_R(kOfxImageEffectPropContext, 1, ""),
    POINTER_W(kOfxPropInstanceData),
    DOUBLE_R(kOfxImageEffectPropProjectSize, 2, 0),
    DOUBLE_R(kOfxImageEffectPropProjectOffset, 2, 0),
    DOUBLE_R(kOfxImageEffectPropProjectExtent, 2, 0),
    DOUBLE_R(kOfxImageEffectPropProjectPixelAspectRatio, 1, 1),
    DOUBLE_R(kOfxImageEffectInstancePropEffectDuration, 1, 0),
    INT_W(kOfxImageEffectInstancePropSequentialRender, 1, 0),
    INT_W(kOfxImageEffectPropSupportsTiles, 1, 1),
    TEXT_W(kOfxImageEffectPropOpenGLRenderSupported, 1, "false"),
    TEXT_R(kOfxImageEffectPropCPURenderSupported, 1, "true"),
    DOUBLE_R(kOfxImageEffectPropFrameRate, 1, 0),
    INT_R(kOfxPropIsInteractive, 1, 0),
    TEXT_R(kOfxImageEffectPropOCIOConfig, 1, ""),
    TEXT_R(kOfxImageEffectPropOCIODisplay, 1, ""),
    TEXT_R(kOfxImageEffectPropOCIOView, 1, ""),
    TEXT_R(kOfxImageEffectPropColourManagementConfig, 1, ""),
    TEXT_R(kOfxImageEffectPropColourManagementStyle, 1, kOfxImageEffectColourManagementNone),
    TEXT_R(kOfxImageEffectPropDisplayColourspace, 1, ""),
    POINTER_R(kOfxImageEffectPropPluginHandle),
};

static const wo_prop_row param_set_rows[] = {
    INT_W(kOfxPropParamSetNeedsSyncing, 1, 1),
    TEXT_W(kOfxPluginPropParamPageOrder, 0, NULL),
};

static const wo_prop_row clip_rows[] = {
    TEXT_R(kOfxPropType, 1, kOfxTypeClip),
    TEXT_R(kOfxPropName, 1, ""),
    TEXT_W(kOfxPropLabel, 1, ""),
    TEXT_W(kOfxPropShortLabel, 1, ""),
    TEXT_W(kOfxPropLongLabel, 1, ""),
    TEXT_W(kOfxPropIcon, 2, ""),
    TEXT_W(kOfxImageEffectPropSupportedComponents, 0, NULL),
    INT_W(kOfxImageEffectPropTemporalClipAccess, 1, 0),
    INT_W(kOfxImageClipPropOptional, 1, 0),
    TEXT_W(kOfxImageClipPropFieldExtraction, 1, kOfxImageFieldDoubled),
    INT_W(kOfxImageClipPropIsMask, 1, 0),
    INT_W(kOfxImageEffectPropSupportsTiles, 1, 1),
};

static const wo_prop_row clip_instance_rows[] = {
    TEXT_R(kOfxImageClipPropColourspace, 1, ""),
    TEXT_R(kOfxImageClipPropPreferredColourspaces, 0, NULL),
    TEXT_R(kOfxImageEffectPropPixelDepth, 1, kOfxBitDepthNone),
    TEXT_R(kOfxImageEffectPropComponents, 1, kOfxImageComponentNone),
    TEXT_R(kOfxImageClipPropUnmappedPixelDepth, 1, kOfxBitDepthNone),
    TEXT_R(kOfxImageClipPropUnmappedComponents, 1, kOfxImageComponentNone),
    TEXT_R(kOfxImageEffectPropPreMultiplication, 1, kOfxImageOpaque),
    DOUBLE_R(kOfxImagePropPixelAspectRatio, 1, 1),
    DOUBLE_R(kOfxImageEffectPropFrameRate, 1, 0),
    DOUBLE_R(kOfxImageEffectPropFrameRange, 2, 0),
    TEXT_R(kOfxImageClipPropFieldOrder, 1, kOfxImageFieldNone),
    INT_R(kOfxImageClipPropConnected, 1, 0),
    DOUBLE_R(kOfxImageEffectPropUnmappedFrameRange, 2, 0),
    DOUBLE_R(kOfxImageEffectPropUnmappedFrameRate, 1, 0),
    INT_R(kOfxImageClipPropContinuousSamples, 1, 0),
    TEXT_R(kWideOpenClipPropMetadataNames, 0, NULL),
    TEXT_R(kWideOpenClipPropMetadataValues, 0, NULL),
};

static const wo_prop_row image_rows[] = {
    TEXT_R(kOfxPropType, 1, kOfxTypeImage),
    TEXT_R(kOfxImageEffectPropPixelDepth, 1, kOfxBitDepthFloat),
    TEXT_R(kOfxImageEffectPropComponents, 1, kOfxImageComponentNone),
    TEXT_R(kOfxImageEffectPropPreMultiplication, 1, kOfxImageOpaque),
    DOUBLE_R(kOfxImageEffectPropRenderScale, 2, 1),
    DOUBLE_R(kOfxImagePropPixelAspectRatio, 1, 1),
    POINTER_R(kOfxImagePropData),
    INT_R(kOfxImagePropBounds, 4, 0),
    INT_R(kOfxImagePropRegionOfDefinition, 4, 0),
    INT_R(kOfxImagePropRowBytes, 1, 0),
    TEXT_R(kOfxImagePropField, 1, kOfxImageFieldNone),
    TEXT_R(kOfxImagePropUniqueIdentifier, 1, ""),
};

static const wo_prop_row param_rows[] = {
    TEXT_R(kOfxPropType, 1, kOfxTypeParameter),
    TEXT_R(kOfxPropName, 1, ""),
    TEXT_W(kOfxPropLabel, 1, ""),
    TEXT_W(kOfxPropShortLabel, 1, ""),
    TEXT_W(kOfxPropLongLabel, 1, ""),
    TEXT_R(kOfxParamPropType, 1, ""),
    INT_W(kOfxParamPropSecret, 1, 0),
    TEXT_W(kOfxParamPropHint, 1, ""),
    TEXT_W(kOfxParamPropScriptName, 1, ""),
    TEXT_W(kOfxParamPropParent, 1, ""),
    INT_W(kOfxParamPropEnabled, 1, 1),
    POINTER_W(kOfxParamPropDataPtr),
    TEXT_W(kOfxPropIcon, 2, ""),
};

static const wo_prop_row param_control_rows[] = {
    /* all but groups and pages */
    POINTER_W(kOfxParamPropInteractV1),
    DOUBLE_R(kOfxParamPropInteractSize, 2, 0),
    DOUBLE_W(kOfxParamPropInteractSizeAspect, 1, 1),
    DOUBLE_W(kOfxParamPropInteractMinimumSize, 2, 10),
    INT_W(kOfxParamPropInteractPreferedSize, 2, 10),
    INT_R(kOfxParamPropHasHostOverlayHandle, 1, 0),
    INT_W(kOfxParamPropUseHostOverlayHandle, 1, 0),
};

static const wo_prop_row param_value_rows[] = {
    INT_W(kOfxParamPropAnimates, 1, 1),
    INT_R(kOfxParamPropIsAnimating, 1, 0),
    INT_R(kOfxParamPropIsAutoKeying, 1, 0),
    INT_W(kOfxParamPropPersistant, 1, 1),
    INT_W(kOfxParamPropEvaluateOnChange, 1, 1),
    INT_W(kOfxParamPropPluginMayWrite, 1, 0),
    TEXT_W(kOfxParamPropCacheInvalidation, 1, kOfxParamInvalidateValueChange),
    INT_W(kOfxParamPropCanUndo, 1, 1),
};

static const wo_prop_row param_double_rows[] = {
    DOUBLE_W(kOfxParamPropIncrement, 1, 1),
    INT_W(kOfxParamPropDigits, 1, 2),
    TEXT_W(kOfxParamPropDoubleType, 1, kOfxParamDoubleTypePlain),
    TEXT_W(kOfxParamPropDefaultCoordinateSystem, 1, kOfxParamCoordinatesCanonical),
};

static const wo_prop_row param_button_rows[] = {
    INT_W(kOfxParamPropEvaluateOnChange, 1, 1),
    INT_W(kOfxParamPropCanUndo, 1, 1),
};

static const wo_prop_row param_string_rows[] = {
    TEXT_W(kOfxParamPropStringMode, 1, kOfxParamStringIsSingleLine),
    INT_W(kOfxParamPropStringFilePathExists, 1, 1),
};

static const char *const contexts[] = {kOfxImageEffectContextFilter, kOfxImageEffectContextGeneral,
                                       kOfxImageEffectContextGenerator};
static const char *const components[] = {kOfxImageComponentRGBA, kOfxImageComponentRGB,
                                         kOfxImageComponentAlpha};

void wo_schema_host(wo_props *props, const wo_host_config *config)
{
    ADD(props, host_rows);
    wo_props_set_int(props, kOfxPropAPIVersion, 0, 1);
    wo_props_set_int(props, kOfxPropAPIVersion, 1, 5);
    wo_props_set_int(props, kOfxPropVersion, 0, WO_VERSION_MAJOR);
    wo_props_set_int(props, kOfxPropVersion, 1, WO_VERSION_MINOR);
    wo_props_set_int(props, kOfxPropVersion, 2, WO_VERSION_PATCH);
    for (int i = 0; i < (int)WO_COUNT(contexts); i++)
        wo_props_set_text(props, kOfxImageEffectPropSupportedContexts, i, contexts[i]);
    for (int i = 0; i < (int)WO_COUNT(components); i++)
        wo_props_set_text(props, kOfxImageEffectPropSupportedComponents, i, components[i]);
    wo_props_set_text(props, kOfxImageEffectPropSupportedPixelDepths, 0, kOfxBitDepthFloat);
    wo_props_set_text(props, kOfxImageEffectPropColourManagementAvailableConfigs, 0,
                      WO_NATIVE_CONFIG);
    wo_props_set_int(props, kOfxImageEffectHostPropIsBackground, 0, config->background);
}

void wo_schema_descriptor(wo_props *props)
{
    ADD(props, descriptor_rows);
}

void wo_schema_instance(wo_props *props)
{
    ADD(props, instance_rows);
}

void wo_schema_param_set(wo_props *props)
{
    ADD(props, param_set_rows);
}

void wo_schema_clip(wo_props *props, const char *name)
{
    ADD(props, clip_rows);
    wo_props_set_text(props, kOfxPropName, 0, name);
    wo_props_set_text(props, kOfxPropLabel, 0, name);
}

void wo_schema_clip_instance(wo_props *props)
{
    ADD(props, clip_instance_rows);
}

void wo_schema_image(wo_props *props)
{
    ADD(props, image_rows);
}

static void add_numeric(wo_props *props, wo_host_param_type kind, int dimension, bool integer)
{
    const bool colour = kind == WO_HOST_PARAM_RGB || kind == WO_HOST_PARAM_RGBA;
    const wo_prop_type type = integer ? WO_PROP_INT : WO_PROP_DOUBLE;
    const double low = integer ? INT_MIN : -DBL_MAX;
    const double high = integer ? INT_MAX : DBL_MAX;
    const wo_prop_row rows[] = {
        {kOfxParamPropMin, type, dimension, true, low, NULL},
        {kOfxParamPropMax, type, dimension, true, high, NULL},
        {kOfxParamPropDisplayMin, type, dimension, true, colour ? 0 : low, NULL},
        {kOfxParamPropDisplayMax, type, dimension, true, colour ? 1 : high, NULL},
    };
    ADD(props, rows);
    if (dimension > 1)
        wo_props_add(props, &(wo_prop_row)TEXT_W(kOfxParamPropDimensionLabel, dimension, ""), 1);
    static const char *const axes[] = {"x", "y", "z"}, *const colours[] = {"r", "g", "b", "a"};
    for (int i = 0; dimension > 1 && i < dimension; i++)
        wo_props_set_text(props, kOfxParamPropDimensionLabel, i, colour ? colours[i] : axes[i]);
}

/* Which kinds animate unless the plugin says otherwise. */
static bool animates(wo_host_param_type kind)
{
    switch (kind) {
    case WO_HOST_PARAM_BOOLEAN:
    case WO_HOST_PARAM_CHOICE:
    case WO_HOST_PARAM_STR_CHOICE:
    case WO_HOST_PARAM_STRING:
    case WO_HOST_PARAM_CUSTOM:
        return false;
    default:
        return true;
    }
}

bool wo_schema_param(wo_props *props, const char *type, const char *name)
{
    wo_host_param_type kind;
    int dimension;
    bool is_text;
    if (!wo_param_type_of(type, &kind, &dimension, &is_text))
        return false;
    ADD(props, param_rows);
    wo_props_set_text(props, kOfxPropName, 0, name);
    wo_props_set_text(props, kOfxPropLabel, 0, name);
    wo_props_set_text(props, kOfxParamPropScriptName, 0, name);
    wo_props_set_text(props, kOfxParamPropType, 0, type);
    if (kind != WO_HOST_PARAM_GROUP && kind != WO_HOST_PARAM_PAGE)
        ADD(props, param_control_rows);
    const bool integer = kind == WO_HOST_PARAM_INTEGER || kind == WO_HOST_PARAM_BOOLEAN ||
                         kind == WO_HOST_PARAM_CHOICE || kind == WO_HOST_PARAM_INTEGER_2D ||
                         kind == WO_HOST_PARAM_INTEGER_3D;
    if (dimension > 0 || is_text) {
        const wo_prop_type stored = is_text   ? WO_PROP_STRING
                                    : integer ? WO_PROP_INT
                                              : WO_PROP_DOUBLE;
        ADD(props, param_value_rows);
        wo_props_add_one(props, kOfxParamPropDefault, stored, is_text ? 1 : dimension, true);
        wo_props_set_int(props, kOfxParamPropAnimates, 0, animates(kind));
    }
    switch (kind) {
    case WO_HOST_PARAM_DOUBLE:
        wo_props_add_one(props, kOfxParamPropShowTimeMarker, WO_PROP_INT, 1, true);
        wo_props_add(props, &(wo_prop_row)TEXT_W(kOfxParamInterpType, 1, kOfxParamInterpTypeLinear),
                     1);
        ADD(props, param_double_rows);
        add_numeric(props, kind, dimension, integer);
        break;
    case WO_HOST_PARAM_INTEGER:
        wo_props_add(props, &(wo_prop_row)TEXT_W(kOfxParamInterpType, 1, kOfxParamInterpTypeLinear),
                     1);
        add_numeric(props, kind, dimension, integer);
        break;
    case WO_HOST_PARAM_DOUBLE_2D:
    case WO_HOST_PARAM_DOUBLE_3D:
    case WO_HOST_PARAM_RGB:
    case WO_HOST_PARAM_RGBA:
        ADD(props, param_double_rows);
        add_numeric(props, kind, dimension, integer);
        break;
    case WO_HOST_PARAM_INTEGER_2D:
    case WO_HOST_PARAM_INTEGER_3D:
        add_numeric(props, kind, dimension, integer);
        break;
    case WO_HOST_PARAM_CHOICE:
        wo_props_add_one(props, kOfxParamPropChoiceOption, WO_PROP_STRING, 0, true);
        wo_props_add_one(props, kOfxParamPropChoiceOrder, WO_PROP_INT, 0, true);
        break;
    case WO_HOST_PARAM_STR_CHOICE:
        wo_props_add_one(props, kOfxParamPropChoiceOption, WO_PROP_STRING, 0, true);
        wo_props_add_one(props, kOfxParamPropChoiceEnum, WO_PROP_STRING, 0, true);
        wo_props_add_one(props, kOfxParamPropChoiceOrder, WO_PROP_INT, 0, true);
        break;
    case WO_HOST_PARAM_STRING:
        ADD(props, param_string_rows);
        break;
    case WO_HOST_PARAM_CUSTOM:
        wo_props_add(props, &(wo_prop_row)POINTER_W(kOfxParamPropCustomInterpCallbackV1), 1);
        break;
    case WO_HOST_PARAM_GROUP:
        wo_props_add(props, &(wo_prop_row)INT_W(kOfxParamPropGroupOpen, 1, 1), 1);
        break;
    case WO_HOST_PARAM_PAGE:
        wo_props_add_one(props, kOfxParamPropPageChild, WO_PROP_STRING, 0, true);
        break;
    case WO_HOST_PARAM_PUSH_BUTTON:
        ADD(props, param_button_rows);
        break;
    case WO_HOST_PARAM_BOOLEAN:
        break;
    }
    return true;
}
