/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/*
 * Colour management, since 1.5.
 *
 * Host and effect descriptor offer styles and configs; the host takes the highest style both know
 * and writes it on the instance. In kOfxImageEffectActionGetClipPreferences the plugin wishes for
 * colour spaces, the host sets kOfxImageClipPropColourspace on each input, and the plugin must look
 * there, for wishes may be ignored. Masks and alpha-only clips have no colour space.
 *
 * Define OFX_NO_DEFAULT_COLORSPACE_HEADER to leave out the names of the native colour spaces.
 */

#ifndef WO_OFX_COLOUR_H
#define WO_OFX_COLOUR_H

#include "ofxCore.h"
#include "ofxImageEffect.h"

#ifndef OFX_NO_DEFAULT_COLORSPACE_HEADER
#include "ofx-native-v1.5_aces-v1.3_ocio-v2.3.h"
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* The handle is an instance. inArgs hold the host's wishes, outArgs
 * kOfxImageClipPropColourspace. */
#define kOfxImageEffectActionGetOutputColourspace "OfxImageEffectActionGetOutputColourspace"

/* string on host, descriptor and instance: one of those below, lowest first. */
#define kOfxImageEffectPropColourManagementStyle "OfxImageEffectPropColourManagementStyle"

#define kOfxImageEffectColourManagementNone  "OfxImageEffectColourManagementNone"
#define kOfxImageEffectColourManagementBasic "OfxImageEffectColourManagementBasic"
#define kOfxImageEffectColourManagementCore  "OfxImageEffectColourManagementCore"
#define kOfxImageEffectColourManagementFull  "OfxImageEffectColourManagementFull"
#define kOfxImageEffectColourManagementOCIO  "OfxImageEffectColourManagementOCIO"

/* string xN on host and effect descriptor: native configs it knows. */
#define kOfxImageEffectPropColourManagementAvailableConfigs                                        \
    "OfxImageEffectPropColourManagementAvailableConfigs"

/* string on the instance: the native config in use. */
#define kOfxImageEffectPropColourManagementConfig "OfxImageEffectPropColourManagementConfig"

/* string on the instance, OCIO style: path or URI of the config. */
#define kOfxImageEffectPropOCIOConfig "OfxImageEffectPropOCIOConfig"

/* string on the instance, OCIO style: display of the viewer. */
#define kOfxImageEffectPropOCIODisplay "OfxImageEffectPropOCIODisplay"

/* string on the instance, OCIO style: view of the viewer. */
#define kOfxImageEffectPropOCIOView "OfxImageEffectPropOCIOView"

/* string on the instance, native styles: colour space of the viewer. */
#define kOfxImageEffectPropDisplayColourspace "OfxImageEffectPropDisplayColourspace"

/* string on a clip: its colour space. */
#define kOfxImageClipPropColourspace "OfxImageClipPropColourspace"

/* string xN: wished colour spaces, best first. */
#define kOfxImageClipPropPreferredColourspaces "OfxImageClipPropPreferredColourspaces"

#ifdef __cplusplus
}
#endif

#endif
