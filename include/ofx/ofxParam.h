/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/*
 * Parameters: what the user can set and animate.
 *
 * A plugin defines them in kOfxImageEffectActionDescribeInContext and reads them from its
 * instances. The host owns every value, key and control.
 */

#ifndef WO_OFX_PARAM_H
#define WO_OFX_PARAM_H

#include <stddef.h>

#include "ofxCore.h"
#include "ofxProperty.h"

#ifdef __cplusplus
extern "C" {
#endif

#define kOfxParameterSuite "OfxParameterSuite"

/* One parameter, and all parameters of one effect. */
typedef struct OfxParamStruct *OfxParamHandle;
typedef struct OfxParamSetStruct *OfxParamSetHandle;

/* Values of kOfxPropType for a parameter descriptor and for a parameter of an instance. */
#define kOfxTypeParameter         "OfxTypeParameter"
#define kOfxTypeParameterInstance "OfxTypeParameterInstance"

/* ---- Parameter types ------------------------------------------------------------------------- */

/* Values as int. */
#define kOfxParamTypeInteger   "OfxParamTypeInteger"
#define kOfxParamTypeInteger2D "OfxParamTypeInteger2D"
#define kOfxParamTypeInteger3D "OfxParamTypeInteger3D"
#define kOfxParamTypeBoolean   "OfxParamTypeBoolean"
#define kOfxParamTypeChoice    "OfxParamTypeChoice"

/* Values as double; colours are not clamped. */
#define kOfxParamTypeDouble   "OfxParamTypeDouble"
#define kOfxParamTypeDouble2D "OfxParamTypeDouble2D"
#define kOfxParamTypeDouble3D "OfxParamTypeDouble3D"
#define kOfxParamTypeRGB      "OfxParamTypeRGB"
#define kOfxParamTypeRGBA     "OfxParamTypeRGBA"

/* Values as string. StrChoice since 1.5, only where kOfxParamHostPropSupportsStrChoice is 1. */
#define kOfxParamTypeString    "OfxParamTypeString"
#define kOfxParamTypeStrChoice "OfxParamTypeStrChoice"
#define kOfxParamTypeCustom    "OfxParamTypeCustom"

/* Value as OfxBytes, since 1.5. */
#define kOfxParamTypeBytes "OfxParamTypeBytes"

/* No value: layout and buttons. */
#define kOfxParamTypeGroup      "OfxParamTypeGroup"
#define kOfxParamTypePage       "OfxParamTypePage"
#define kOfxParamTypePushButton "OfxParamTypePushButton"

/* The value of a kOfxParamTypeBytes parameter. */
typedef struct OfxBytes {
    const unsigned char *data;
    size_t length;
} OfxBytes;

/* ---- What the host can do -------------------------------------------------------------------- */

/* int 0/1: which kinds of parameter can be animated. */
#define kOfxParamHostPropSupportsCustomAnimation    "OfxParamHostPropSupportsCustomAnimation"
#define kOfxParamHostPropSupportsStringAnimation    "OfxParamHostPropSupportsStringAnimation"
#define kOfxParamHostPropSupportsBooleanAnimation   "OfxParamHostPropSupportsBooleanAnimation"
#define kOfxParamHostPropSupportsChoiceAnimation    "OfxParamHostPropSupportsChoiceAnimation"
#define kOfxParamHostPropSupportsStrChoiceAnimation "OfxParamHostPropSupportsStrChoiceAnimation"

/* int 0/1: kOfxParamTypeStrChoice exists. Since 1.5. */
#define kOfxParamHostPropSupportsStrChoice "OfxParamHostPropSupportsStrChoice"

/* int 0/1: parameters may have an interact. */
#define kOfxParamHostPropSupportsCustomInteract "OfxParamHostPropSupportsCustomInteract"

/* int: most parameters an effect may have; -1 is no limit. */
#define kOfxParamHostPropMaxParameters "OfxParamHostPropMaxParameters"

/* int: most pages; 0 is no page layout. */
#define kOfxParamHostPropMaxPages "OfxParamHostPropMaxPages"

/* int x2: columns, then rows of a page. */
#define kOfxParamHostPropPageRowColumnCount "OfxParamHostPropPageRowColumnCount"

/* ---- Any parameter --------------------------------------------------------------------------- */

/* string: the type it was defined with. */
#define kOfxParamPropType "OfxParamPropType"

/* string: tool tip. */
#define kOfxParamPropHint "OfxParamPropHint"

/* string: name in scripts; the name if unset. */
#define kOfxParamPropScriptName "OfxParamPropScriptName"

/* string: name of the group it is in; empty at the top. */
#define kOfxParamPropParent "OfxParamPropParent"

/* int 0/1: the user may change it. */
#define kOfxParamPropEnabled "OfxParamPropEnabled"

/* int 0/1: hidden from the user. */
#define kOfxParamPropSecret "OfxParamPropSecret"

/* pointer: private to the plugin. */
#define kOfxParamPropDataPtr "OfxParamPropDataPtr"

/* ---- Parameters with a value ----------------------------------------------------------------- */

/* int, double, string or pointer xN, as the type says: the default value. */
#define kOfxParamPropDefault "OfxParamPropDefault"

/* int 0/1: may have keys. */
#define kOfxParamPropAnimates "OfxParamPropAnimates"

/* int 0/1, from the host: has keys. */
#define kOfxParamPropIsAnimating "OfxParamPropIsAnimating"

/* int 0/1, from the host: a change by the user makes a key. */
#define kOfxParamPropIsAutoKeying "OfxParamPropIsAutoKeying"

/* int 0/1: saved with the project. The spelling is part of the ABI. */
#define kOfxParamPropPersistant "OfxParamPropPersistant"

/* int 0/1: a change calls for a new render. */
#define kOfxParamPropEvaluateOnChange "OfxParamPropEvaluateOnChange"

/* int 0/1: the host keeps changes for undo. */
#define kOfxParamPropCanUndo "OfxParamPropCanUndo"

/* int 0/1: the plugin sets it itself. Withdrawn in 1.4. */
#define kOfxParamPropPluginMayWrite "OfxParamPropPluginMayWrite"

/* string: what a change at one time makes stale, one of the three below. */
#define kOfxParamPropCacheInvalidation "OfxParamPropCacheInvalidation"

#define kOfxParamInvalidateValueChange      "OfxParamInvalidateValueChange"
#define kOfxParamInvalidateValueChangeToEnd "OfxParamInvalidateValueChangeToEnd"
#define kOfxParamInvalidateAll              "OfxParamInvalidateAll"

/* ---- Numbers --------------------------------------------------------------------------------- */

/* int or double xN, as the type says: the legal range. */
#define kOfxParamPropMin "OfxParamPropMin"
#define kOfxParamPropMax "OfxParamPropMax"

/* int or double xN: the range of the slider. */
#define kOfxParamPropDisplayMin "OfxParamPropDisplayMin"
#define kOfxParamPropDisplayMax "OfxParamPropDisplayMax"

/* double: one step of the control. */
#define kOfxParamPropIncrement "OfxParamPropIncrement"

/* int: digits shown after the point. */
#define kOfxParamPropDigits "OfxParamPropDigits"

/* string, one for each dimension: x, y, z or r, g, b, a if unset. */
#define kOfxParamPropDimensionLabel "OfxParamPropDimensionLabel"

/* string: what a double means, one of those below. */
#define kOfxParamPropDoubleType "OfxParamPropDoubleType"

#define kOfxParamDoubleTypePlain        "OfxParamDoubleTypePlain"
#define kOfxParamDoubleTypeScale        "OfxParamDoubleTypeScale"
#define kOfxParamDoubleTypeAngle        "OfxParamDoubleTypeAngle"
#define kOfxParamDoubleTypeTime         "OfxParamDoubleTypeTime"
#define kOfxParamDoubleTypeAbsoluteTime "OfxParamDoubleTypeAbsoluteTime"
#define kOfxParamDoubleTypeX            "OfxParamDoubleTypeX"
#define kOfxParamDoubleTypeY            "OfxParamDoubleTypeY"
#define kOfxParamDoubleTypeXAbsolute    "OfxParamDoubleTypeXAbsolute"
#define kOfxParamDoubleTypeYAbsolute    "OfxParamDoubleTypeYAbsolute"
#define kOfxParamDoubleTypeXY           "OfxParamDoubleTypeXY"
#define kOfxParamDoubleTypeXYAbsolute   "OfxParamDoubleTypeXYAbsolute"

/* string: units of the default of a size or position, one of the two below. Values are always
 * canonical. */
#define kOfxParamPropDefaultCoordinateSystem "OfxParamPropDefaultCoordinateSystem"

#define kOfxParamCoordinatesCanonical  "OfxParamCoordinatesCanonical"
#define kOfxParamCoordinatesNormalised "OfxParamCoordinatesNormalised"

/* int 0/1: show a time parameter on the time line. */
#define kOfxParamPropShowTimeMarker "OfxParamPropShowTimeMarker"

/* int 0/1, from the host: it can draw a handle in the viewer for this parameter. */
#define kOfxParamPropHasHostOverlayHandle "OfxParamPropHasHostOverlayHandle"

/* int 0/1: please draw it. The string begins with a k. */
#define kOfxParamPropUseHostOverlayHandle "kOfxParamPropUseHostOverlayHandle"

/* string on the descriptor of a one-dimensional int or double: how keys are joined, one of the
 * three below. After 1.5. */
#define kOfxParamInterpType "OfxParamInterpType"

#define kOfxParamInterpTypeConstantStep "OfxParamInterpTypeConstantStep"
#define kOfxParamInterpTypeLinear       "OfxParamInterpTypeLinear"
#define kOfxParamInterpTypeSmooth       "OfxParamInterpTypeSmooth"

/* ---- Choices --------------------------------------------------------------------------------- */

/* string xN: the entries as the user sees them. */
#define kOfxParamPropChoiceOption "OfxParamPropChoiceOption"

/* int xN: place in the menu of each entry of a choice. Since 1.5. */
#define kOfxParamPropChoiceOrder "OfxParamPropChoiceOrder"

/* string xN: stored value of each entry of a string choice. Since 1.5. */
#define kOfxParamPropChoiceEnum "OfxParamPropChoiceEnum"

/* ---- Strings --------------------------------------------------------------------------------- */

/* string: one of those below. */
#define kOfxParamPropStringMode "OfxParamPropStringMode"

#define kOfxParamStringIsSingleLine     "OfxParamStringIsSingleLine"
#define kOfxParamStringIsMultiLine      "OfxParamStringIsMultiLine"
#define kOfxParamStringIsFilePath       "OfxParamStringIsFilePath"
#define kOfxParamStringIsDirectoryPath  "OfxParamStringIsDirectoryPath"
#define kOfxParamStringIsLabel          "OfxParamStringIsLabel"
#define kOfxParamStringIsRichTextFormat "OfxParamStringIsRichTextFormat"

/* int 0/1: the path must exist already. */
#define kOfxParamPropStringFilePathExists "OfxParamPropStringFilePathExists"

/* ---- Custom parameters ----------------------------------------------------------------------- */

/* Blends two keys of a custom parameter. inArgs hold kOfxPropName, kOfxPropTime and the last
 * three properties below; outArgs take the result as string x1 in kOfxParamPropCustomValue. */
typedef OfxStatus(OfxCustomParamInterpFuncV1)(OfxParamSetHandle instance,
                                              OfxPropertySetHandle inArgs,
                                              OfxPropertySetHandle outArgs);

/* pointer: the OfxCustomParamInterpFuncV1 of the parameter. The string differs from the name. */
#define kOfxParamPropCustomInterpCallbackV1 "OfxParamPropCustomCallbackV1"

/* string x2: values of the keys before and after. */
#define kOfxParamPropCustomValue "OfxParamPropCustomValue"

/* double x2: times of these keys. */
#define kOfxParamPropInterpolationTime "OfxParamPropInterpolationTime"

/* double: 0..1 from the first to the second. */
#define kOfxParamPropInterpolationAmount "OfxParamPropInterpolationAmount"

/* ---- Groups, pages and the whole set --------------------------------------------------------- */

/* int 0/1: a group starts unfolded. */
#define kOfxParamPropGroupOpen "OfxParamPropGroupOpen"

/* string xN: parameters on a page, in order. */
#define kOfxParamPropPageChild "OfxParamPropPageChild"

/* Gaps, to be used in place of a name in kOfxParamPropPageChild. */
#define kOfxParamPageSkipRow    "OfxParamPageSkipRow"
#define kOfxParamPageSkipColumn "OfxParamPageSkipColumn"

/* string xN on the set: names of the pages, in order. */
#define kOfxPluginPropParamPageOrder "OfxPluginPropParamPageOrder"

/* int 0/1 on the set: private data is newer than the parameters, kOfxActionSyncPrivateData is
 * due. */
#define kOfxPropParamSetNeedsSyncing "OfxPropParamSetNeedsSyncing"

/* ---- A parameter that is an interact --------------------------------------------------------- */

/* pointer: OfxPluginEntryPoint of the interact, or NULL. */
#define kOfxParamPropInteractV1 "OfxParamPropInteractV1"

/* double x2, from the host: size now, in pixels. */
#define kOfxParamPropInteractSize "OfxParamPropInteractSize"

/* double: wished width over height. */
#define kOfxParamPropInteractSizeAspect "OfxParamPropInteractSizeAspect"

/* double x2: least size, in pixels. */
#define kOfxParamPropInteractMinimumSize "OfxParamPropInteractMinimumSize"

/* int x2: wished size, in pixels. The spelling is part of the ABI. */
#define kOfxParamPropInteractPreferedSize "OfxParamPropInteractPreferedSize"

/* ---- Suite ----------------------------------------------------------------------------------- */

/* Version 1.
 *
 * The variadic arguments follow the type of the parameter: one for each dimension. Getters take
 * int *, double * or char ** (the string belongs to the host and lives until the next call for
 * that parameter, or the end of the action). Setters take int, double or const char *.
 *
 * Getters may be called in any action but the describe ones. Setters, keys, copy and edit only in
 * kOfxActionCreateInstance, kOfxActionInstanceChanged and interact actions, never in a render. */
typedef struct OfxParameterSuiteV1 {
    /* Only in kOfxImageEffectActionDescribeInContext. A host without that type answers
     * kOfxStatErrUnsupported. propertySet receives the descriptor. */
    OfxStatus (*paramDefine)(OfxParamSetHandle paramSet, const char *paramType, const char *name,
                             OfxPropertySetHandle *propertySet);

    /* propertySet may be NULL. */
    OfxStatus (*paramGetHandle)(OfxParamSetHandle paramSet, const char *name, OfxParamHandle *param,
                                OfxPropertySetHandle *propertySet);
    OfxStatus (*paramSetGetPropertySet)(OfxParamSetHandle paramSet,
                                        OfxPropertySetHandle *propHandle);
    OfxStatus (*paramGetPropertySet)(OfxParamHandle param, OfxPropertySetHandle *propHandle);

    OfxStatus (*paramGetValue)(OfxParamHandle paramHandle, ...);
    OfxStatus (*paramGetValueAtTime)(OfxParamHandle paramHandle, OfxTime time, ...);

    /* Double and colour types only. */
    OfxStatus (*paramGetDerivative)(OfxParamHandle paramHandle, OfxTime time, ...);
    OfxStatus (*paramGetIntegral)(OfxParamHandle paramHandle, OfxTime time1, OfxTime time2, ...);

    OfxStatus (*paramSetValue)(OfxParamHandle paramHandle, ...);

    /* Makes a key. */
    OfxStatus (*paramSetValueAtTime)(OfxParamHandle paramHandle, OfxTime time, ...);

    /* Keys count from 0, in order of time. */
    OfxStatus (*paramGetNumKeys)(OfxParamHandle paramHandle, unsigned int *numberOfKeys);
    OfxStatus (*paramGetKeyTime)(OfxParamHandle paramHandle, unsigned int nthKey, OfxTime *time);

    /* direction: 0 the key at `time`, > 0 the next after it, < 0 the last before it. If there is
     * none, index is -1 and the answer is kOfxStatFailed. */
    OfxStatus (*paramGetKeyIndex)(OfxParamHandle paramHandle, OfxTime time, int direction,
                                  int *index);
    OfxStatus (*paramDeleteKey)(OfxParamHandle paramHandle, OfxTime time);
    OfxStatus (*paramDeleteAllKeys)(OfxParamHandle paramHandle);

    /* dstOffset is added to the times of the keys. frameRange limits which keys are copied; NULL
     * or [0, 0] copies all. */
    OfxStatus (*paramCopy)(OfxParamHandle paramTo, OfxParamHandle paramFrom, OfxTime dstOffset,
                           const OfxRangeD *frameRange);

    /* Bracket changes that are one step to undo; `name` is shown to the user. */
    OfxStatus (*paramEditBegin)(OfxParamSetHandle paramSet, const char *name);
    OfxStatus (*paramEditEnd)(OfxParamSetHandle paramSet);
} OfxParameterSuiteV1;

#ifdef __cplusplus
}
#endif

#endif
