/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/*
 * Image effects: the plugin API that all our plugins speak.
 *
 * Coordinates: y is up and the origin is at the bottom left. Canonical coordinates know neither
 * render scale nor pixel aspect; pixel X = x * scaleX / aspect, pixel Y = y * scaleY (half of that
 * for a single field). Regions of definition and interest are canonical, render windows and image
 * bounds are pixels.
 */

#ifndef WO_OFX_IMAGE_EFFECT_H
#define WO_OFX_IMAGE_EFFECT_H

#include "ofxCore.h"
#include "ofxInteract.h"
#include "ofxMemory.h"
#include "ofxMessage.h"
#include "ofxMultiThread.h"
#include "ofxParam.h"
#include "ofxPixels.h"
#include "ofxProperty.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A descriptor while the plugin describes itself, an instance afterwards. */
typedef struct OfxImageEffectStruct *OfxImageEffectHandle;

/* One input or the output of an instance. */
typedef struct OfxImageClipStruct *OfxImageClipHandle;

/* A block from imageMemoryAlloc. */
typedef struct OfxImageMemoryStruct *OfxImageMemoryHandle;

/* For OfxPlugin.pluginApi and OfxPlugin.apiVersion. */
#define kOfxImageEffectPluginApi        "OfxImageEffectPluginAPI"
#define kOfxImageEffectPluginApiVersion 1

/* The image is of a kind the plugin or host cannot handle. */
#define kOfxStatErrImageFormat 1000

/* Values of kOfxPropType. */
#define kOfxTypeImageEffectHost     "OfxTypeImageEffectHost"
#define kOfxTypeImageEffect         "OfxTypeImageEffect"
#define kOfxTypeImageEffectInstance "OfxTypeImageEffectInstance"
#define kOfxTypeClip                "OfxTypeClip"
#define kOfxTypeImage               "OfxTypeImage"

/* ---- Actions --------------------------------------------------------------------------------- */

/* The handle is a descriptor. Clips and parameters are defined here, once for each context. */
#define kOfxImageEffectActionDescribeInContext "OfxImageEffectActionDescribeInContext"

/* The handle is an instance in all that follow. Some of their arguments are one property for each
 * clip, named by a prefix with the name of the clip behind it: OfxImageClipPropComponents_,
 * OfxImageClipPropDepth_, OfxImageClipPropPAR_, OfxImageClipPropPreferredColourspaces_ (clip
 * preferences), OfxImageClipPropRoI_ (regions of interest), OfxImageClipPropFrameRange_ (frames
 * needed). */

/* What kinds of image come in and go out. */
#define kOfxImageEffectActionGetClipPreferences "OfxImageEffectActionGetClipPreferences"

/* Where the output is, which part of the inputs and which frames it needs, when it exists. */
#define kOfxImageEffectActionGetRegionOfDefinition "OfxImageEffectActionGetRegionOfDefinition"
#define kOfxImageEffectActionGetRegionsOfInterest  "OfxImageEffectActionGetRegionsOfInterest"
#define kOfxImageEffectActionGetFramesNeeded       "OfxImageEffectActionGetFramesNeeded"
#define kOfxImageEffectActionGetTimeDomain         "OfxImageEffectActionGetTimeDomain"

/* kOfxStatOK: the output is a copy of the clip named in outArgs. */
#define kOfxImageEffectActionIsIdentity "OfxImageEffectActionIsIdentity"

/* Begin and End bracket every run of renders, even of one frame. */
#define kOfxImageEffectActionBeginSequenceRender "OfxImageEffectActionBeginSequenceRender"
#define kOfxImageEffectActionRender              "OfxImageEffectActionRender"
#define kOfxImageEffectActionEndSequenceRender   "OfxImageEffectActionEndSequenceRender"

/* ---- Contexts -------------------------------------------------------------------------------- */

/* string: the context of an instance, or the one being described. */
#define kOfxImageEffectPropContext "OfxImageEffectPropContext"

/* string xN on host and effect descriptor: contexts it can do. */
#define kOfxImageEffectPropSupportedContexts "OfxImageEffectPropSupportedContexts"

#define kOfxImageEffectContextGenerator  "OfxImageEffectContextGenerator"
#define kOfxImageEffectContextFilter     "OfxImageEffectContextFilter"
#define kOfxImageEffectContextTransition "OfxImageEffectContextTransition"
#define kOfxImageEffectContextPaint      "OfxImageEffectContextPaint"
#define kOfxImageEffectContextGeneral    "OfxImageEffectContextGeneral"
#define kOfxImageEffectContextRetimer    "OfxImageEffectContextRetimer"

/* Names of clips and parameters that contexts prescribe. */
#define kOfxImageEffectOutputClipName               "Output"
#define kOfxImageEffectSimpleSourceClipName         "Source"
#define kOfxImageEffectTransitionSourceFromClipName "SourceFrom"
#define kOfxImageEffectTransitionSourceToClipName   "SourceTo"
#define kOfxImageEffectTransitionParamName          "Transition"
#define kOfxImageEffectRetimerParamName             "SourceTime"

/* ---- Effect: who and how --------------------------------------------------------------------- */

/* string: menu of the plugin, with slashes for submenus. */
#define kOfxImageEffectPluginPropGrouping "OfxImageEffectPluginPropGrouping"

/* int 0/1: load old projects with it, offer it to nobody. After 1.5. */
#define kOfxImageEffectPluginPropObsolete "OfxImageEffectPluginPropObsolete"

/* pointer, from the host on an instance: the OfxPlugin it was made from. */
#define kOfxImageEffectPropPluginHandle "OfxImageEffectPropPluginHandle"

/* int 0/1: no more than one instance may live. */
#define kOfxImageEffectPluginPropSingleInstance "OfxImageEffectPluginPropSingleInstance"

/* string: how much may render at once, one of the three below: one render in all instances, one
 * render in each instance, any number. */
#define kOfxImageEffectPluginRenderThreadSafety "OfxImageEffectPluginRenderThreadSafety"

#define kOfxImageEffectRenderUnsafe       "OfxImageEffectRenderUnsafe"
#define kOfxImageEffectRenderInstanceSafe "OfxImageEffectRenderInstanceSafe"
#define kOfxImageEffectRenderFullySafe    "OfxImageEffectRenderFullySafe"

/* int 0/1: the host may cut one frame into windows and render them in parallel. */
#define kOfxImageEffectPluginPropHostFrameThreading "OfxImageEffectPluginPropHostFrameThreading"

/* string xN: parameters whose change calls for kOfxImageEffectActionGetClipPreferences. */
#define kOfxImageEffectPropClipPreferencesSlaveParam "OfxImageEffectPropClipPreferencesSlaveParam"

/* int: frames must come in order: 0 no, 1 yes, 2 preferred. On the host: 0 never, 1 always if
 * asked for, 2 sometimes. */
#define kOfxImageEffectInstancePropSequentialRender "OfxImageEffectInstancePropSequentialRender"

/* int 0/1: render is called for each field even where both see the same input. */
#define kOfxImageEffectPluginPropFieldRenderTwiceAlways                                            \
    "OfxImageEffectPluginPropFieldRenderTwiceAlways"

/* ---- Effect and host: abilities -------------------------------------------------------------- */

/* int 0/1, host: no user interface at all. */
#define kOfxImageEffectHostPropIsBackground "OfxImageEffectHostPropIsBackground"

/* string, host: where its own coordinates start, one of the three below. Since 1.4; OFX
 * coordinates stay bottom left. */
#define kOfxImageEffectHostPropNativeOrigin "OfxImageEffectHostPropNativeOrigin"

#define kOfxHostNativeOriginBottomLeft "kOfxImageEffectHostPropNativeOriginBottomLeft"
#define kOfxHostNativeOriginTopLeft    "kOfxImageEffectHostPropNativeOriginTopLeft"
#define kOfxHostNativeOriginCenter     "kOfxImageEffectHostPropNativeOriginCenter"

/* int 0/1, host: interacts in the viewer. */
#define kOfxImageEffectPropSupportsOverlays "OfxImageEffectPropSupportsOverlays"

/* pointer: OfxPluginEntryPoint of an overlay drawn with OpenGL, or NULL. */
#define kOfxImageEffectPluginPropOverlayInteractV1 "OfxImageEffectPluginPropOverlayInteractV1"

/* pointer: OfxPluginEntryPoint of an overlay drawn with the draw suite, or NULL. Since 1.5. */
#define kOfxImageEffectPluginPropOverlayInteractV2 "OfxImageEffectPluginPropOverlayInteractV2"

/* int 0/1: images of differing size and origin. */
#define kOfxImageEffectPropSupportsMultiResolution "OfxImageEffectPropSupportsMultiResolution"

/* int 0/1: images may be parts of the whole. */
#define kOfxImageEffectPropSupportsTiles "OfxImageEffectPropSupportsTiles"

/* int 0/1: images from other times than the rendered one. */
#define kOfxImageEffectPropTemporalClipAccess "OfxImageEffectPropTemporalClipAccess"

/* int 0/1: clips of differing bit depth. The string differs from the name. */
#define kOfxImageEffectPropSupportsMultipleClipDepths "OfxImageEffectPropMultipleClipDepths"

/* int 0/1: clips of differing pixel aspect. */
#define kOfxImageEffectPropSupportsMultipleClipPARs "OfxImageEffectPropSupportsMultipleClipPARs"

/* int 0/1: the effect may change the frame rate of its output. */
#define kOfxImageEffectPropSetableFrameRate "OfxImageEffectPropSetableFrameRate"

/* int 0/1: the effect may change the fielding of its output. */
#define kOfxImageEffectPropSetableFielding "OfxImageEffectPropSetableFielding"

/* string xN: bit depths it can do. */
#define kOfxImageEffectPropSupportedPixelDepths "OfxImageEffectPropSupportedPixelDepths"

/* string xN: component types it can do, on host and clip. */
#define kOfxImageEffectPropSupportedComponents "OfxImageEffectPropSupportedComponents"

/* string "true" or "false": an output pixel depends on the input pixel at its place and on
 * nothing else. Since 1.5.1. */
#define kOfxImageEffectPropNoSpatialAwareness "OfxImageEffectPropNoSpatialAwareness"

/* ---- Pixels ---------------------------------------------------------------------------------- */

/* string: one of the bit depths of ofxCore.h. */
#define kOfxImageEffectPropPixelDepth "OfxImageEffectPropPixelDepth"

/* string: one of those below. */
#define kOfxImageEffectPropComponents "OfxImageEffectPropComponents"

#define kOfxImageComponentNone  "OfxImageComponentNone"
#define kOfxImageComponentRGBA  "OfxImageComponentRGBA"
#define kOfxImageComponentRGB   "OfxImageComponentRGB"
#define kOfxImageComponentAlpha "OfxImageComponentAlpha"

/* string: one of the three below. */
#define kOfxImageEffectPropPreMultiplication "OfxImageEffectPropPreMultiplication"

#define kOfxImageOpaque          "OfxImageOpaque"
#define kOfxImagePreMultiplied   "OfxImageAlphaPremultiplied"
#define kOfxImageUnPreMultiplied "OfxImageAlphaUnPremultiplied"

/* double: width over height of one pixel. */
#define kOfxImagePropPixelAspectRatio "OfxImagePropPixelAspectRatio"

/* ---- Project and instance -------------------------------------------------------------------- */

/* double x2: size of the project window, canonical. */
#define kOfxImageEffectPropProjectSize "OfxImageEffectPropProjectSize"

/* double x2: its lower left corner, canonical. */
#define kOfxImageEffectPropProjectOffset "OfxImageEffectPropProjectOffset"

/* double x2: its upper right corner, canonical. */
#define kOfxImageEffectPropProjectExtent "OfxImageEffectPropProjectExtent"

/* double: pixel aspect of the project. The string differs from the name. */
#define kOfxImageEffectPropProjectPixelAspectRatio "OfxImageEffectPropPixelAspectRatio"

/* double: frames the effect lasts. */
#define kOfxImageEffectInstancePropEffectDuration "OfxImageEffectInstancePropEffectDuration"

/* double: frames in a second, of a clip or an instance. */
#define kOfxImageEffectPropFrameRate "OfxImageEffectPropFrameRate"

/* double x2: first and last frame. */
#define kOfxImageEffectPropFrameRange "OfxImageEffectPropFrameRange"

/* int 0/1: the output changes with time though parameters and inputs do not. */
#define kOfxImageEffectFrameVarying "OfxImageEffectFrameVarying"

/* ---- Clips ----------------------------------------------------------------------------------- */

/* int 0/1, from the host: something is attached. */
#define kOfxImageClipPropConnected "OfxImageClipPropConnected"

/* int 0/1: the effect can do without. */
#define kOfxImageClipPropOptional "OfxImageClipPropOptional"

/* int 0/1: meant as a mask. */
#define kOfxImageClipPropIsMask "OfxImageClipPropIsMask"

/* int 0/1: images may be asked for between frames. */
#define kOfxImageClipPropContinuousSamples "OfxImageClipPropContinuousSamples"

/* string: bit depth before the host converted for the effect. */
#define kOfxImageClipPropUnmappedPixelDepth "OfxImageClipPropUnmappedPixelDepth"

/* string: component type before the host converted. */
#define kOfxImageClipPropUnmappedComponents "OfxImageClipPropUnmappedComponents"

/* double: frame rate before the host converted. */
#define kOfxImageEffectPropUnmappedFrameRate "OfxImageEffectPropUnmappedFrameRate"

/* double x2: frame range before the host converted. */
#define kOfxImageEffectPropUnmappedFrameRange "OfxImageEffectPropUnmappedFrameRange"

/* string: none, lower first or upper first. */
#define kOfxImageClipPropFieldOrder "OfxImageClipPropFieldOrder"

/* string: how the effect wants fields: none, both, single or doubled. */
#define kOfxImageClipPropFieldExtraction "OfxImageClipPropFieldExtraction"

/* Fields. */
#define kOfxImageFieldNone    "OfxFieldNone"
#define kOfxImageFieldLower   "OfxFieldLower"
#define kOfxImageFieldUpper   "OfxFieldUpper"
#define kOfxImageFieldBoth    "OfxFieldBoth"
#define kOfxImageFieldSingle  "OfxFieldSingle"
#define kOfxImageFieldDoubled "OfxFieldDoubled"

/* ---- Images ---------------------------------------------------------------------------------- */

/* pointer: component 0 of the pixel at the lower left of the bounds. Device memory in a GPU
 * render. */
#define kOfxImagePropData "OfxImagePropData"

/* int x4: x1, y1, x2, y2 of the pixels in memory. */
#define kOfxImagePropBounds "OfxImagePropBounds"

/* int x4: where the image is defined, in pixels; memory may hold less. */
#define kOfxImagePropRegionOfDefinition "OfxImagePropRegionOfDefinition"

/* int: bytes from a row to the one above it; may be negative and may include padding. */
#define kOfxImagePropRowBytes "OfxImagePropRowBytes"

/* string: which fields the image holds. */
#define kOfxImagePropField "OfxImagePropField"

/* string: differs when the pixels do. */
#define kOfxImagePropUniqueIdentifier "OfxImagePropUniqueIdentifier"

/* ---- Arguments of actions -------------------------------------------------------------------- */

/* double x2: size of the images over full size; 1, 1 is full. */
#define kOfxImageEffectPropRenderScale "OfxImageEffectPropRenderScale"

/* int x4: pixels to render. */
#define kOfxImageEffectPropRenderWindow "OfxImageEffectPropRenderWindow"

/* double x4: canonical rectangle. */
#define kOfxImageEffectPropRegionOfDefinition "OfxImageEffectPropRegionOfDefinition"

/* double x4: canonical rectangle. */
#define kOfxImageEffectPropRegionOfInterest "OfxImageEffectPropRegionOfInterest"

/* string: none, both, lower or upper. */
#define kOfxImageEffectPropFieldToRender "OfxImageEffectPropFieldToRender"

/* double: frames from one render to the next. */
#define kOfxImageEffectPropFrameStep "OfxImageEffectPropFrameStep"

/* int 0/1: frames really come in order. */
#define kOfxImageEffectPropSequentialRenderStatus "OfxImageEffectPropSequentialRenderStatus"

/* int 0/1: a user waits for this render. */
#define kOfxImageEffectPropInteractiveRenderStatus "OfxImageEffectPropInteractiveRenderStatus"

/* int 0/1: speed matters more than quality. Since 1.4. */
#define kOfxImageEffectPropRenderQualityDraft "OfxImageEffectPropRenderQualityDraft"

/* string "true" or "false": for a small preview. Since 1.5.1. */
#define kOfxImageEffectPropThumbnailRender "OfxImageEffectPropThumbnailRender"

/* string: what to do without a licence, one of the two below. After 1.5. */
#define kOfxImageEffectPropBehaviourWhenUnlicensed "OfxImageEffectPropBehaviourWhenUnlicensed"

#define kOfxUnlicensedContinue "OfxUnlicensedContinue"
#define kOfxUnlicensedFail     "OfxUnlicensedFail"

/* ---- Suite ----------------------------------------------------------------------------------- */

#define kOfxImageEffectSuite "OfxImageEffectSuite"

/* Version 1. */
typedef struct OfxImageEffectSuiteV1 {
    OfxStatus (*getPropertySet)(OfxImageEffectHandle imageEffect, OfxPropertySetHandle *propHandle);
    OfxStatus (*getParamSet)(OfxImageEffectHandle imageEffect, OfxParamSetHandle *paramSet);

    /* Only in kOfxImageEffectActionDescribeInContext. */
    OfxStatus (*clipDefine)(OfxImageEffectHandle imageEffect, const char *name,
                            OfxPropertySetHandle *propertySet);

    /* Only on instances; the handle lives as long as they do. propertySet may be NULL. */
    OfxStatus (*clipGetHandle)(OfxImageEffectHandle imageEffect, const char *name,
                               OfxImageClipHandle *clip, OfxPropertySetHandle *propertySet);
    OfxStatus (*clipGetPropertySet)(OfxImageClipHandle clip, OfxPropertySetHandle *propHandle);

    /* `region` is canonical, or NULL for what the host finds right. kOfxStatFailed: there is no
     * image, take it as transparent black and go on. Release each handle within the action. */
    OfxStatus (*clipGetImage)(OfxImageClipHandle clip, OfxTime time, const OfxRectD *region,
                              OfxPropertySetHandle *imageHandle);
    OfxStatus (*clipReleaseImage)(OfxPropertySetHandle imageHandle);

    /* `bounds` is canonical and may be infinite, see kOfxFlagInfiniteMax. */
    OfxStatus (*clipGetRegionOfDefinition)(OfxImageClipHandle clip, OfxTime time, OfxRectD *bounds);

    /* An answer, not a status: 1 if the render should stop, else 0. */
    int (*abort)(OfxImageEffectHandle imageEffect);

    /* Memory for pixels. It may move while unlocked; locks nest and give 16 byte alignment.
     * instanceHandle may be NULL. */
    OfxStatus (*imageMemoryAlloc)(OfxImageEffectHandle instanceHandle, size_t nBytes,
                                  OfxImageMemoryHandle *memoryHandle);
    OfxStatus (*imageMemoryFree)(OfxImageMemoryHandle memoryHandle);
    OfxStatus (*imageMemoryLock)(OfxImageMemoryHandle memoryHandle, void **returnedPtr);
    OfxStatus (*imageMemoryUnlock)(OfxImageMemoryHandle memoryHandle);
} OfxImageEffectSuiteV1;

#ifdef __cplusplus
}
#endif

#endif
