/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
/* prints the ABI facts of a set of OFX headers; generated */
#include <stdio.h>
#include <stddef.h>
#include <stdbool.h>
#if __has_include("ofxCore.h")
#include "ofxCore.h"
#endif
#if __has_include("ofxProperty.h")
#include "ofxProperty.h"
#endif
#if __has_include("ofxMemory.h")
#include "ofxMemory.h"
#endif
#if __has_include("ofxMultiThread.h")
#include "ofxMultiThread.h"
#endif
#if __has_include("ofxMessage.h")
#include "ofxMessage.h"
#endif
#if __has_include("ofxProgress.h")
#include "ofxProgress.h"
#endif
#if __has_include("ofxTimeLine.h")
#include "ofxTimeLine.h"
#endif
#if __has_include("ofxParam.h")
#include "ofxParam.h"
#endif
#if __has_include("ofxParametricParam.h")
#include "ofxParametricParam.h"
#endif
#if __has_include("ofxInteract.h")
#include "ofxInteract.h"
#endif
#if __has_include("ofxKeySyms.h")
#include "ofxKeySyms.h"
#endif
#if __has_include("ofxPixels.h")
#include "ofxPixels.h"
#endif
#if __has_include("ofxDrawSuite.h")
#include "ofxDrawSuite.h"
#endif
#if __has_include("ofxImageEffect.h")
#include "ofxImageEffect.h"
#endif
#if __has_include("ofxGPURender.h")
#include "ofxGPURender.h"
#endif
#if __has_include("ofxColour.h")
#include "ofxColour.h"
#endif
#if __has_include("ofxDialog.h")
#include "ofxDialog.h"
#endif
#if __has_include("ofxOld.h")
#include "ofxOld.h"
#endif
int main(void){
#ifdef kOfxActionLoad
printf("S kOfxActionLoad \"%s\"\n",kOfxActionLoad);
#else
printf("S kOfxActionLoad MISSING\n");
#endif
#ifdef kOfxActionDescribe
printf("S kOfxActionDescribe \"%s\"\n",kOfxActionDescribe);
#else
printf("S kOfxActionDescribe MISSING\n");
#endif
#ifdef kOfxActionUnload
printf("S kOfxActionUnload \"%s\"\n",kOfxActionUnload);
#else
printf("S kOfxActionUnload MISSING\n");
#endif
#ifdef kOfxActionPurgeCaches
printf("S kOfxActionPurgeCaches \"%s\"\n",kOfxActionPurgeCaches);
#else
printf("S kOfxActionPurgeCaches MISSING\n");
#endif
#ifdef kOfxActionSyncPrivateData
printf("S kOfxActionSyncPrivateData \"%s\"\n",kOfxActionSyncPrivateData);
#else
printf("S kOfxActionSyncPrivateData MISSING\n");
#endif
#ifdef kOfxActionCreateInstance
printf("S kOfxActionCreateInstance \"%s\"\n",kOfxActionCreateInstance);
#else
printf("S kOfxActionCreateInstance MISSING\n");
#endif
#ifdef kOfxActionDestroyInstance
printf("S kOfxActionDestroyInstance \"%s\"\n",kOfxActionDestroyInstance);
#else
printf("S kOfxActionDestroyInstance MISSING\n");
#endif
#ifdef kOfxActionInstanceChanged
printf("S kOfxActionInstanceChanged \"%s\"\n",kOfxActionInstanceChanged);
#else
printf("S kOfxActionInstanceChanged MISSING\n");
#endif
#ifdef kOfxActionBeginInstanceChanged
printf("S kOfxActionBeginInstanceChanged \"%s\"\n",kOfxActionBeginInstanceChanged);
#else
printf("S kOfxActionBeginInstanceChanged MISSING\n");
#endif
#ifdef kOfxActionEndInstanceChanged
printf("S kOfxActionEndInstanceChanged \"%s\"\n",kOfxActionEndInstanceChanged);
#else
printf("S kOfxActionEndInstanceChanged MISSING\n");
#endif
#ifdef kOfxActionBeginInstanceEdit
printf("S kOfxActionBeginInstanceEdit \"%s\"\n",kOfxActionBeginInstanceEdit);
#else
printf("S kOfxActionBeginInstanceEdit MISSING\n");
#endif
#ifdef kOfxActionEndInstanceEdit
printf("S kOfxActionEndInstanceEdit \"%s\"\n",kOfxActionEndInstanceEdit);
#else
printf("S kOfxActionEndInstanceEdit MISSING\n");
#endif
#ifdef kOfxPropAPIVersion
printf("S kOfxPropAPIVersion \"%s\"\n",kOfxPropAPIVersion);
#else
printf("S kOfxPropAPIVersion MISSING\n");
#endif
#ifdef kOfxPropTime
printf("S kOfxPropTime \"%s\"\n",kOfxPropTime);
#else
printf("S kOfxPropTime MISSING\n");
#endif
#ifdef kOfxPropIsInteractive
printf("S kOfxPropIsInteractive \"%s\"\n",kOfxPropIsInteractive);
#else
printf("S kOfxPropIsInteractive MISSING\n");
#endif
#ifdef kOfxPluginPropFilePath
printf("S kOfxPluginPropFilePath \"%s\"\n",kOfxPluginPropFilePath);
#else
printf("S kOfxPluginPropFilePath MISSING\n");
#endif
#ifdef kOfxPropInstanceData
printf("S kOfxPropInstanceData \"%s\"\n",kOfxPropInstanceData);
#else
printf("S kOfxPropInstanceData MISSING\n");
#endif
#ifdef kOfxPropType
printf("S kOfxPropType \"%s\"\n",kOfxPropType);
#else
printf("S kOfxPropType MISSING\n");
#endif
#ifdef kOfxPropName
printf("S kOfxPropName \"%s\"\n",kOfxPropName);
#else
printf("S kOfxPropName MISSING\n");
#endif
#ifdef kOfxPropVersion
printf("S kOfxPropVersion \"%s\"\n",kOfxPropVersion);
#else
printf("S kOfxPropVersion MISSING\n");
#endif
#ifdef kOfxPropVersionLabel
printf("S kOfxPropVersionLabel \"%s\"\n",kOfxPropVersionLabel);
#else
printf("S kOfxPropVersionLabel MISSING\n");
#endif
#ifdef kOfxPropPluginDescription
printf("S kOfxPropPluginDescription \"%s\"\n",kOfxPropPluginDescription);
#else
printf("S kOfxPropPluginDescription MISSING\n");
#endif
#ifdef kOfxPropLabel
printf("S kOfxPropLabel \"%s\"\n",kOfxPropLabel);
#else
printf("S kOfxPropLabel MISSING\n");
#endif
#ifdef kOfxPropIcon
printf("S kOfxPropIcon \"%s\"\n",kOfxPropIcon);
#else
printf("S kOfxPropIcon MISSING\n");
#endif
#ifdef kOfxPropShortLabel
printf("S kOfxPropShortLabel \"%s\"\n",kOfxPropShortLabel);
#else
printf("S kOfxPropShortLabel MISSING\n");
#endif
#ifdef kOfxPropLongLabel
printf("S kOfxPropLongLabel \"%s\"\n",kOfxPropLongLabel);
#else
printf("S kOfxPropLongLabel MISSING\n");
#endif
#ifdef kOfxPropChangeReason
printf("S kOfxPropChangeReason \"%s\"\n",kOfxPropChangeReason);
#else
printf("S kOfxPropChangeReason MISSING\n");
#endif
#ifdef kOfxPropEffectInstance
printf("S kOfxPropEffectInstance \"%s\"\n",kOfxPropEffectInstance);
#else
printf("S kOfxPropEffectInstance MISSING\n");
#endif
#ifdef kOfxPropHostOSHandle
printf("S kOfxPropHostOSHandle \"%s\"\n",kOfxPropHostOSHandle);
#else
printf("S kOfxPropHostOSHandle MISSING\n");
#endif
#ifdef kOfxChangeUserEdited
printf("S kOfxChangeUserEdited \"%s\"\n",kOfxChangeUserEdited);
#else
printf("S kOfxChangeUserEdited MISSING\n");
#endif
#ifdef kOfxChangePluginEdited
printf("S kOfxChangePluginEdited \"%s\"\n",kOfxChangePluginEdited);
#else
printf("S kOfxChangePluginEdited MISSING\n");
#endif
#ifdef kOfxChangeTime
printf("S kOfxChangeTime \"%s\"\n",kOfxChangeTime);
#else
printf("S kOfxChangeTime MISSING\n");
#endif
#ifdef kOfxBitDepthNone
printf("S kOfxBitDepthNone \"%s\"\n",kOfxBitDepthNone);
#else
printf("S kOfxBitDepthNone MISSING\n");
#endif
#ifdef kOfxBitDepthByte
printf("S kOfxBitDepthByte \"%s\"\n",kOfxBitDepthByte);
#else
printf("S kOfxBitDepthByte MISSING\n");
#endif
#ifdef kOfxBitDepthShort
printf("S kOfxBitDepthShort \"%s\"\n",kOfxBitDepthShort);
#else
printf("S kOfxBitDepthShort MISSING\n");
#endif
#ifdef kOfxBitDepthHalf
printf("S kOfxBitDepthHalf \"%s\"\n",kOfxBitDepthHalf);
#else
printf("S kOfxBitDepthHalf MISSING\n");
#endif
#ifdef kOfxBitDepthFloat
printf("S kOfxBitDepthFloat \"%s\"\n",kOfxBitDepthFloat);
#else
printf("S kOfxBitDepthFloat MISSING\n");
#endif
#ifdef kOfxPropertySuite
printf("S kOfxPropertySuite \"%s\"\n",kOfxPropertySuite);
#else
printf("S kOfxPropertySuite MISSING\n");
#endif
#ifdef kOfxMemorySuite
printf("S kOfxMemorySuite \"%s\"\n",kOfxMemorySuite);
#else
printf("S kOfxMemorySuite MISSING\n");
#endif
#ifdef kOfxMultiThreadSuite
printf("S kOfxMultiThreadSuite \"%s\"\n",kOfxMultiThreadSuite);
#else
printf("S kOfxMultiThreadSuite MISSING\n");
#endif
#ifdef kOfxMessageSuite
printf("S kOfxMessageSuite \"%s\"\n",kOfxMessageSuite);
#else
printf("S kOfxMessageSuite MISSING\n");
#endif
#ifdef kOfxMessageFatal
printf("S kOfxMessageFatal \"%s\"\n",kOfxMessageFatal);
#else
printf("S kOfxMessageFatal MISSING\n");
#endif
#ifdef kOfxMessageError
printf("S kOfxMessageError \"%s\"\n",kOfxMessageError);
#else
printf("S kOfxMessageError MISSING\n");
#endif
#ifdef kOfxMessageWarning
printf("S kOfxMessageWarning \"%s\"\n",kOfxMessageWarning);
#else
printf("S kOfxMessageWarning MISSING\n");
#endif
#ifdef kOfxMessageMessage
printf("S kOfxMessageMessage \"%s\"\n",kOfxMessageMessage);
#else
printf("S kOfxMessageMessage MISSING\n");
#endif
#ifdef kOfxMessageLog
printf("S kOfxMessageLog \"%s\"\n",kOfxMessageLog);
#else
printf("S kOfxMessageLog MISSING\n");
#endif
#ifdef kOfxMessageQuestion
printf("S kOfxMessageQuestion \"%s\"\n",kOfxMessageQuestion);
#else
printf("S kOfxMessageQuestion MISSING\n");
#endif
#ifdef kOfxProgressSuite
printf("S kOfxProgressSuite \"%s\"\n",kOfxProgressSuite);
#else
printf("S kOfxProgressSuite MISSING\n");
#endif
#ifdef kOfxTimeLineSuite
printf("S kOfxTimeLineSuite \"%s\"\n",kOfxTimeLineSuite);
#else
printf("S kOfxTimeLineSuite MISSING\n");
#endif
#ifdef kOfxParameterSuite
printf("S kOfxParameterSuite \"%s\"\n",kOfxParameterSuite);
#else
printf("S kOfxParameterSuite MISSING\n");
#endif
#ifdef kOfxTypeParameter
printf("S kOfxTypeParameter \"%s\"\n",kOfxTypeParameter);
#else
printf("S kOfxTypeParameter MISSING\n");
#endif
#ifdef kOfxTypeParameterInstance
printf("S kOfxTypeParameterInstance \"%s\"\n",kOfxTypeParameterInstance);
#else
printf("S kOfxTypeParameterInstance MISSING\n");
#endif
#ifdef kOfxParamTypeInteger
printf("S kOfxParamTypeInteger \"%s\"\n",kOfxParamTypeInteger);
#else
printf("S kOfxParamTypeInteger MISSING\n");
#endif
#ifdef kOfxParamTypeDouble
printf("S kOfxParamTypeDouble \"%s\"\n",kOfxParamTypeDouble);
#else
printf("S kOfxParamTypeDouble MISSING\n");
#endif
#ifdef kOfxParamTypeBoolean
printf("S kOfxParamTypeBoolean \"%s\"\n",kOfxParamTypeBoolean);
#else
printf("S kOfxParamTypeBoolean MISSING\n");
#endif
#ifdef kOfxParamTypeChoice
printf("S kOfxParamTypeChoice \"%s\"\n",kOfxParamTypeChoice);
#else
printf("S kOfxParamTypeChoice MISSING\n");
#endif
#ifdef kOfxParamTypeStrChoice
printf("S kOfxParamTypeStrChoice \"%s\"\n",kOfxParamTypeStrChoice);
#else
printf("S kOfxParamTypeStrChoice MISSING\n");
#endif
#ifdef kOfxParamTypeRGBA
printf("S kOfxParamTypeRGBA \"%s\"\n",kOfxParamTypeRGBA);
#else
printf("S kOfxParamTypeRGBA MISSING\n");
#endif
#ifdef kOfxParamTypeRGB
printf("S kOfxParamTypeRGB \"%s\"\n",kOfxParamTypeRGB);
#else
printf("S kOfxParamTypeRGB MISSING\n");
#endif
#ifdef kOfxParamTypeDouble2D
printf("S kOfxParamTypeDouble2D \"%s\"\n",kOfxParamTypeDouble2D);
#else
printf("S kOfxParamTypeDouble2D MISSING\n");
#endif
#ifdef kOfxParamTypeInteger2D
printf("S kOfxParamTypeInteger2D \"%s\"\n",kOfxParamTypeInteger2D);
#else
printf("S kOfxParamTypeInteger2D MISSING\n");
#endif
#ifdef kOfxParamTypeDouble3D
printf("S kOfxParamTypeDouble3D \"%s\"\n",kOfxParamTypeDouble3D);
#else
printf("S kOfxParamTypeDouble3D MISSING\n");
#endif
#ifdef kOfxParamTypeInteger3D
printf("S kOfxParamTypeInteger3D \"%s\"\n",kOfxParamTypeInteger3D);
#else
printf("S kOfxParamTypeInteger3D MISSING\n");
#endif
#ifdef kOfxParamTypeString
printf("S kOfxParamTypeString \"%s\"\n",kOfxParamTypeString);
#else
printf("S kOfxParamTypeString MISSING\n");
#endif
#ifdef kOfxParamTypeCustom
printf("S kOfxParamTypeCustom \"%s\"\n",kOfxParamTypeCustom);
#else
printf("S kOfxParamTypeCustom MISSING\n");
#endif
#ifdef kOfxParamTypeBytes
printf("S kOfxParamTypeBytes \"%s\"\n",kOfxParamTypeBytes);
#else
printf("S kOfxParamTypeBytes MISSING\n");
#endif
#ifdef kOfxParamTypeGroup
printf("S kOfxParamTypeGroup \"%s\"\n",kOfxParamTypeGroup);
#else
printf("S kOfxParamTypeGroup MISSING\n");
#endif
#ifdef kOfxParamTypePage
printf("S kOfxParamTypePage \"%s\"\n",kOfxParamTypePage);
#else
printf("S kOfxParamTypePage MISSING\n");
#endif
#ifdef kOfxParamTypePushButton
printf("S kOfxParamTypePushButton \"%s\"\n",kOfxParamTypePushButton);
#else
printf("S kOfxParamTypePushButton MISSING\n");
#endif
#ifdef kOfxParamHostPropSupportsCustomAnimation
printf("S kOfxParamHostPropSupportsCustomAnimation \"%s\"\n",kOfxParamHostPropSupportsCustomAnimation);
#else
printf("S kOfxParamHostPropSupportsCustomAnimation MISSING\n");
#endif
#ifdef kOfxParamHostPropSupportsStringAnimation
printf("S kOfxParamHostPropSupportsStringAnimation \"%s\"\n",kOfxParamHostPropSupportsStringAnimation);
#else
printf("S kOfxParamHostPropSupportsStringAnimation MISSING\n");
#endif
#ifdef kOfxParamHostPropSupportsBooleanAnimation
printf("S kOfxParamHostPropSupportsBooleanAnimation \"%s\"\n",kOfxParamHostPropSupportsBooleanAnimation);
#else
printf("S kOfxParamHostPropSupportsBooleanAnimation MISSING\n");
#endif
#ifdef kOfxParamHostPropSupportsChoiceAnimation
printf("S kOfxParamHostPropSupportsChoiceAnimation \"%s\"\n",kOfxParamHostPropSupportsChoiceAnimation);
#else
printf("S kOfxParamHostPropSupportsChoiceAnimation MISSING\n");
#endif
#ifdef kOfxParamHostPropSupportsCustomInteract
printf("S kOfxParamHostPropSupportsCustomInteract \"%s\"\n",kOfxParamHostPropSupportsCustomInteract);
#else
printf("S kOfxParamHostPropSupportsCustomInteract MISSING\n");
#endif
#ifdef kOfxParamHostPropMaxParameters
printf("S kOfxParamHostPropMaxParameters \"%s\"\n",kOfxParamHostPropMaxParameters);
#else
printf("S kOfxParamHostPropMaxParameters MISSING\n");
#endif
#ifdef kOfxParamHostPropMaxPages
printf("S kOfxParamHostPropMaxPages \"%s\"\n",kOfxParamHostPropMaxPages);
#else
printf("S kOfxParamHostPropMaxPages MISSING\n");
#endif
#ifdef kOfxParamHostPropPageRowColumnCount
printf("S kOfxParamHostPropPageRowColumnCount \"%s\"\n",kOfxParamHostPropPageRowColumnCount);
#else
printf("S kOfxParamHostPropPageRowColumnCount MISSING\n");
#endif
#ifdef kOfxParamPageSkipRow
printf("S kOfxParamPageSkipRow \"%s\"\n",kOfxParamPageSkipRow);
#else
printf("S kOfxParamPageSkipRow MISSING\n");
#endif
#ifdef kOfxParamPageSkipColumn
printf("S kOfxParamPageSkipColumn \"%s\"\n",kOfxParamPageSkipColumn);
#else
printf("S kOfxParamPageSkipColumn MISSING\n");
#endif
#ifdef kOfxParamPropInteractV1
printf("S kOfxParamPropInteractV1 \"%s\"\n",kOfxParamPropInteractV1);
#else
printf("S kOfxParamPropInteractV1 MISSING\n");
#endif
#ifdef kOfxParamPropInteractSize
printf("S kOfxParamPropInteractSize \"%s\"\n",kOfxParamPropInteractSize);
#else
printf("S kOfxParamPropInteractSize MISSING\n");
#endif
#ifdef kOfxParamPropInteractSizeAspect
printf("S kOfxParamPropInteractSizeAspect \"%s\"\n",kOfxParamPropInteractSizeAspect);
#else
printf("S kOfxParamPropInteractSizeAspect MISSING\n");
#endif
#ifdef kOfxParamPropInteractMinimumSize
printf("S kOfxParamPropInteractMinimumSize \"%s\"\n",kOfxParamPropInteractMinimumSize);
#else
printf("S kOfxParamPropInteractMinimumSize MISSING\n");
#endif
#ifdef kOfxParamPropInteractPreferedSize
printf("S kOfxParamPropInteractPreferedSize \"%s\"\n",kOfxParamPropInteractPreferedSize);
#else
printf("S kOfxParamPropInteractPreferedSize MISSING\n");
#endif
#ifdef kOfxParamPropType
printf("S kOfxParamPropType \"%s\"\n",kOfxParamPropType);
#else
printf("S kOfxParamPropType MISSING\n");
#endif
#ifdef kOfxParamPropAnimates
printf("S kOfxParamPropAnimates \"%s\"\n",kOfxParamPropAnimates);
#else
printf("S kOfxParamPropAnimates MISSING\n");
#endif
#ifdef kOfxParamPropCanUndo
printf("S kOfxParamPropCanUndo \"%s\"\n",kOfxParamPropCanUndo);
#else
printf("S kOfxParamPropCanUndo MISSING\n");
#endif
#ifdef kOfxPropParamSetNeedsSyncing
printf("S kOfxPropParamSetNeedsSyncing \"%s\"\n",kOfxPropParamSetNeedsSyncing);
#else
printf("S kOfxPropParamSetNeedsSyncing MISSING\n");
#endif
#ifdef kOfxParamPropIsAnimating
printf("S kOfxParamPropIsAnimating \"%s\"\n",kOfxParamPropIsAnimating);
#else
printf("S kOfxParamPropIsAnimating MISSING\n");
#endif
#ifdef kOfxParamPropPluginMayWrite
printf("S kOfxParamPropPluginMayWrite \"%s\"\n",kOfxParamPropPluginMayWrite);
#else
printf("S kOfxParamPropPluginMayWrite MISSING\n");
#endif
#ifdef kOfxParamPropPersistant
printf("S kOfxParamPropPersistant \"%s\"\n",kOfxParamPropPersistant);
#else
printf("S kOfxParamPropPersistant MISSING\n");
#endif
#ifdef kOfxParamPropEvaluateOnChange
printf("S kOfxParamPropEvaluateOnChange \"%s\"\n",kOfxParamPropEvaluateOnChange);
#else
printf("S kOfxParamPropEvaluateOnChange MISSING\n");
#endif
#ifdef kOfxParamPropSecret
printf("S kOfxParamPropSecret \"%s\"\n",kOfxParamPropSecret);
#else
printf("S kOfxParamPropSecret MISSING\n");
#endif
#ifdef kOfxParamPropScriptName
printf("S kOfxParamPropScriptName \"%s\"\n",kOfxParamPropScriptName);
#else
printf("S kOfxParamPropScriptName MISSING\n");
#endif
#ifdef kOfxParamPropCacheInvalidation
printf("S kOfxParamPropCacheInvalidation \"%s\"\n",kOfxParamPropCacheInvalidation);
#else
printf("S kOfxParamPropCacheInvalidation MISSING\n");
#endif
#ifdef kOfxParamInvalidateValueChange
printf("S kOfxParamInvalidateValueChange \"%s\"\n",kOfxParamInvalidateValueChange);
#else
printf("S kOfxParamInvalidateValueChange MISSING\n");
#endif
#ifdef kOfxParamInvalidateValueChangeToEnd
printf("S kOfxParamInvalidateValueChangeToEnd \"%s\"\n",kOfxParamInvalidateValueChangeToEnd);
#else
printf("S kOfxParamInvalidateValueChangeToEnd MISSING\n");
#endif
#ifdef kOfxParamInvalidateAll
printf("S kOfxParamInvalidateAll \"%s\"\n",kOfxParamInvalidateAll);
#else
printf("S kOfxParamInvalidateAll MISSING\n");
#endif
#ifdef kOfxParamPropHint
printf("S kOfxParamPropHint \"%s\"\n",kOfxParamPropHint);
#else
printf("S kOfxParamPropHint MISSING\n");
#endif
#ifdef kOfxParamPropDefault
printf("S kOfxParamPropDefault \"%s\"\n",kOfxParamPropDefault);
#else
printf("S kOfxParamPropDefault MISSING\n");
#endif
#ifdef kOfxParamPropDoubleType
printf("S kOfxParamPropDoubleType \"%s\"\n",kOfxParamPropDoubleType);
#else
printf("S kOfxParamPropDoubleType MISSING\n");
#endif
#ifdef kOfxParamDoubleTypePlain
printf("S kOfxParamDoubleTypePlain \"%s\"\n",kOfxParamDoubleTypePlain);
#else
printf("S kOfxParamDoubleTypePlain MISSING\n");
#endif
#ifdef kOfxParamDoubleTypeScale
printf("S kOfxParamDoubleTypeScale \"%s\"\n",kOfxParamDoubleTypeScale);
#else
printf("S kOfxParamDoubleTypeScale MISSING\n");
#endif
#ifdef kOfxParamDoubleTypeAngle
printf("S kOfxParamDoubleTypeAngle \"%s\"\n",kOfxParamDoubleTypeAngle);
#else
printf("S kOfxParamDoubleTypeAngle MISSING\n");
#endif
#ifdef kOfxParamDoubleTypeTime
printf("S kOfxParamDoubleTypeTime \"%s\"\n",kOfxParamDoubleTypeTime);
#else
printf("S kOfxParamDoubleTypeTime MISSING\n");
#endif
#ifdef kOfxParamDoubleTypeAbsoluteTime
printf("S kOfxParamDoubleTypeAbsoluteTime \"%s\"\n",kOfxParamDoubleTypeAbsoluteTime);
#else
printf("S kOfxParamDoubleTypeAbsoluteTime MISSING\n");
#endif
#ifdef kOfxParamDoubleTypeX
printf("S kOfxParamDoubleTypeX \"%s\"\n",kOfxParamDoubleTypeX);
#else
printf("S kOfxParamDoubleTypeX MISSING\n");
#endif
#ifdef kOfxParamDoubleTypeY
printf("S kOfxParamDoubleTypeY \"%s\"\n",kOfxParamDoubleTypeY);
#else
printf("S kOfxParamDoubleTypeY MISSING\n");
#endif
#ifdef kOfxParamDoubleTypeXAbsolute
printf("S kOfxParamDoubleTypeXAbsolute \"%s\"\n",kOfxParamDoubleTypeXAbsolute);
#else
printf("S kOfxParamDoubleTypeXAbsolute MISSING\n");
#endif
#ifdef kOfxParamDoubleTypeYAbsolute
printf("S kOfxParamDoubleTypeYAbsolute \"%s\"\n",kOfxParamDoubleTypeYAbsolute);
#else
printf("S kOfxParamDoubleTypeYAbsolute MISSING\n");
#endif
#ifdef kOfxParamDoubleTypeXY
printf("S kOfxParamDoubleTypeXY \"%s\"\n",kOfxParamDoubleTypeXY);
#else
printf("S kOfxParamDoubleTypeXY MISSING\n");
#endif
#ifdef kOfxParamDoubleTypeXYAbsolute
printf("S kOfxParamDoubleTypeXYAbsolute \"%s\"\n",kOfxParamDoubleTypeXYAbsolute);
#else
printf("S kOfxParamDoubleTypeXYAbsolute MISSING\n");
#endif
#ifdef kOfxParamPropDefaultCoordinateSystem
printf("S kOfxParamPropDefaultCoordinateSystem \"%s\"\n",kOfxParamPropDefaultCoordinateSystem);
#else
printf("S kOfxParamPropDefaultCoordinateSystem MISSING\n");
#endif
#ifdef kOfxParamCoordinatesCanonical
printf("S kOfxParamCoordinatesCanonical \"%s\"\n",kOfxParamCoordinatesCanonical);
#else
printf("S kOfxParamCoordinatesCanonical MISSING\n");
#endif
#ifdef kOfxParamCoordinatesNormalised
printf("S kOfxParamCoordinatesNormalised \"%s\"\n",kOfxParamCoordinatesNormalised);
#else
printf("S kOfxParamCoordinatesNormalised MISSING\n");
#endif
#ifdef kOfxParamPropHasHostOverlayHandle
printf("S kOfxParamPropHasHostOverlayHandle \"%s\"\n",kOfxParamPropHasHostOverlayHandle);
#else
printf("S kOfxParamPropHasHostOverlayHandle MISSING\n");
#endif
#ifdef kOfxParamPropUseHostOverlayHandle
printf("S kOfxParamPropUseHostOverlayHandle \"%s\"\n",kOfxParamPropUseHostOverlayHandle);
#else
printf("S kOfxParamPropUseHostOverlayHandle MISSING\n");
#endif
#ifdef kOfxParamInterpTypeConstantStep
printf("S kOfxParamInterpTypeConstantStep \"%s\"\n",kOfxParamInterpTypeConstantStep);
#else
printf("S kOfxParamInterpTypeConstantStep MISSING\n");
#endif
#ifdef kOfxParamInterpTypeLinear
printf("S kOfxParamInterpTypeLinear \"%s\"\n",kOfxParamInterpTypeLinear);
#else
printf("S kOfxParamInterpTypeLinear MISSING\n");
#endif
#ifdef kOfxParamInterpTypeSmooth
printf("S kOfxParamInterpTypeSmooth \"%s\"\n",kOfxParamInterpTypeSmooth);
#else
printf("S kOfxParamInterpTypeSmooth MISSING\n");
#endif
#ifdef kOfxParamInterpType
printf("S kOfxParamInterpType \"%s\"\n",kOfxParamInterpType);
#else
printf("S kOfxParamInterpType MISSING\n");
#endif
#ifdef kOfxParamPropShowTimeMarker
printf("S kOfxParamPropShowTimeMarker \"%s\"\n",kOfxParamPropShowTimeMarker);
#else
printf("S kOfxParamPropShowTimeMarker MISSING\n");
#endif
#ifdef kOfxPluginPropParamPageOrder
printf("S kOfxPluginPropParamPageOrder \"%s\"\n",kOfxPluginPropParamPageOrder);
#else
printf("S kOfxPluginPropParamPageOrder MISSING\n");
#endif
#ifdef kOfxParamPropPageChild
printf("S kOfxParamPropPageChild \"%s\"\n",kOfxParamPropPageChild);
#else
printf("S kOfxParamPropPageChild MISSING\n");
#endif
#ifdef kOfxParamPropParent
printf("S kOfxParamPropParent \"%s\"\n",kOfxParamPropParent);
#else
printf("S kOfxParamPropParent MISSING\n");
#endif
#ifdef kOfxParamPropGroupOpen
printf("S kOfxParamPropGroupOpen \"%s\"\n",kOfxParamPropGroupOpen);
#else
printf("S kOfxParamPropGroupOpen MISSING\n");
#endif
#ifdef kOfxParamPropEnabled
printf("S kOfxParamPropEnabled \"%s\"\n",kOfxParamPropEnabled);
#else
printf("S kOfxParamPropEnabled MISSING\n");
#endif
#ifdef kOfxParamPropDataPtr
printf("S kOfxParamPropDataPtr \"%s\"\n",kOfxParamPropDataPtr);
#else
printf("S kOfxParamPropDataPtr MISSING\n");
#endif
#ifdef kOfxParamPropChoiceOption
printf("S kOfxParamPropChoiceOption \"%s\"\n",kOfxParamPropChoiceOption);
#else
printf("S kOfxParamPropChoiceOption MISSING\n");
#endif
#ifdef kOfxParamPropChoiceOrder
printf("S kOfxParamPropChoiceOrder \"%s\"\n",kOfxParamPropChoiceOrder);
#else
printf("S kOfxParamPropChoiceOrder MISSING\n");
#endif
#ifdef kOfxParamPropChoiceEnum
printf("S kOfxParamPropChoiceEnum \"%s\"\n",kOfxParamPropChoiceEnum);
#else
printf("S kOfxParamPropChoiceEnum MISSING\n");
#endif
#ifdef kOfxParamHostPropSupportsStrChoiceAnimation
printf("S kOfxParamHostPropSupportsStrChoiceAnimation \"%s\"\n",kOfxParamHostPropSupportsStrChoiceAnimation);
#else
printf("S kOfxParamHostPropSupportsStrChoiceAnimation MISSING\n");
#endif
#ifdef kOfxParamHostPropSupportsStrChoice
printf("S kOfxParamHostPropSupportsStrChoice \"%s\"\n",kOfxParamHostPropSupportsStrChoice);
#else
printf("S kOfxParamHostPropSupportsStrChoice MISSING\n");
#endif
#ifdef kOfxParamPropMin
printf("S kOfxParamPropMin \"%s\"\n",kOfxParamPropMin);
#else
printf("S kOfxParamPropMin MISSING\n");
#endif
#ifdef kOfxParamPropMax
printf("S kOfxParamPropMax \"%s\"\n",kOfxParamPropMax);
#else
printf("S kOfxParamPropMax MISSING\n");
#endif
#ifdef kOfxParamPropDisplayMin
printf("S kOfxParamPropDisplayMin \"%s\"\n",kOfxParamPropDisplayMin);
#else
printf("S kOfxParamPropDisplayMin MISSING\n");
#endif
#ifdef kOfxParamPropDisplayMax
printf("S kOfxParamPropDisplayMax \"%s\"\n",kOfxParamPropDisplayMax);
#else
printf("S kOfxParamPropDisplayMax MISSING\n");
#endif
#ifdef kOfxParamPropIncrement
printf("S kOfxParamPropIncrement \"%s\"\n",kOfxParamPropIncrement);
#else
printf("S kOfxParamPropIncrement MISSING\n");
#endif
#ifdef kOfxParamPropDigits
printf("S kOfxParamPropDigits \"%s\"\n",kOfxParamPropDigits);
#else
printf("S kOfxParamPropDigits MISSING\n");
#endif
#ifdef kOfxParamPropDimensionLabel
printf("S kOfxParamPropDimensionLabel \"%s\"\n",kOfxParamPropDimensionLabel);
#else
printf("S kOfxParamPropDimensionLabel MISSING\n");
#endif
#ifdef kOfxParamPropIsAutoKeying
printf("S kOfxParamPropIsAutoKeying \"%s\"\n",kOfxParamPropIsAutoKeying);
#else
printf("S kOfxParamPropIsAutoKeying MISSING\n");
#endif
#ifdef kOfxParamPropCustomInterpCallbackV1
printf("S kOfxParamPropCustomInterpCallbackV1 \"%s\"\n",kOfxParamPropCustomInterpCallbackV1);
#else
printf("S kOfxParamPropCustomInterpCallbackV1 MISSING\n");
#endif
#ifdef kOfxParamPropStringMode
printf("S kOfxParamPropStringMode \"%s\"\n",kOfxParamPropStringMode);
#else
printf("S kOfxParamPropStringMode MISSING\n");
#endif
#ifdef kOfxParamPropStringFilePathExists
printf("S kOfxParamPropStringFilePathExists \"%s\"\n",kOfxParamPropStringFilePathExists);
#else
printf("S kOfxParamPropStringFilePathExists MISSING\n");
#endif
#ifdef kOfxParamStringIsSingleLine
printf("S kOfxParamStringIsSingleLine \"%s\"\n",kOfxParamStringIsSingleLine);
#else
printf("S kOfxParamStringIsSingleLine MISSING\n");
#endif
#ifdef kOfxParamStringIsMultiLine
printf("S kOfxParamStringIsMultiLine \"%s\"\n",kOfxParamStringIsMultiLine);
#else
printf("S kOfxParamStringIsMultiLine MISSING\n");
#endif
#ifdef kOfxParamStringIsFilePath
printf("S kOfxParamStringIsFilePath \"%s\"\n",kOfxParamStringIsFilePath);
#else
printf("S kOfxParamStringIsFilePath MISSING\n");
#endif
#ifdef kOfxParamStringIsDirectoryPath
printf("S kOfxParamStringIsDirectoryPath \"%s\"\n",kOfxParamStringIsDirectoryPath);
#else
printf("S kOfxParamStringIsDirectoryPath MISSING\n");
#endif
#ifdef kOfxParamStringIsLabel
printf("S kOfxParamStringIsLabel \"%s\"\n",kOfxParamStringIsLabel);
#else
printf("S kOfxParamStringIsLabel MISSING\n");
#endif
#ifdef kOfxParamStringIsRichTextFormat
printf("S kOfxParamStringIsRichTextFormat \"%s\"\n",kOfxParamStringIsRichTextFormat);
#else
printf("S kOfxParamStringIsRichTextFormat MISSING\n");
#endif
#ifdef kOfxParamPropCustomValue
printf("S kOfxParamPropCustomValue \"%s\"\n",kOfxParamPropCustomValue);
#else
printf("S kOfxParamPropCustomValue MISSING\n");
#endif
#ifdef kOfxParamPropInterpolationTime
printf("S kOfxParamPropInterpolationTime \"%s\"\n",kOfxParamPropInterpolationTime);
#else
printf("S kOfxParamPropInterpolationTime MISSING\n");
#endif
#ifdef kOfxParamPropInterpolationAmount
printf("S kOfxParamPropInterpolationAmount \"%s\"\n",kOfxParamPropInterpolationAmount);
#else
printf("S kOfxParamPropInterpolationAmount MISSING\n");
#endif
#ifdef kOfxParametricParameterSuite
printf("S kOfxParametricParameterSuite \"%s\"\n",kOfxParametricParameterSuite);
#else
printf("S kOfxParametricParameterSuite MISSING\n");
#endif
#ifdef kOfxParamTypeParametric
printf("S kOfxParamTypeParametric \"%s\"\n",kOfxParamTypeParametric);
#else
printf("S kOfxParamTypeParametric MISSING\n");
#endif
#ifdef kOfxParamPropParametricDimension
printf("S kOfxParamPropParametricDimension \"%s\"\n",kOfxParamPropParametricDimension);
#else
printf("S kOfxParamPropParametricDimension MISSING\n");
#endif
#ifdef kOfxParamPropParametricUIColour
printf("S kOfxParamPropParametricUIColour \"%s\"\n",kOfxParamPropParametricUIColour);
#else
printf("S kOfxParamPropParametricUIColour MISSING\n");
#endif
#ifdef kOfxParamPropParametricInteractBackground
printf("S kOfxParamPropParametricInteractBackground \"%s\"\n",kOfxParamPropParametricInteractBackground);
#else
printf("S kOfxParamPropParametricInteractBackground MISSING\n");
#endif
#ifdef kOfxParamHostPropSupportsParametricAnimation
printf("S kOfxParamHostPropSupportsParametricAnimation \"%s\"\n",kOfxParamHostPropSupportsParametricAnimation);
#else
printf("S kOfxParamHostPropSupportsParametricAnimation MISSING\n");
#endif
#ifdef kOfxParamPropParametricRange
printf("S kOfxParamPropParametricRange \"%s\"\n",kOfxParamPropParametricRange);
#else
printf("S kOfxParamPropParametricRange MISSING\n");
#endif
#ifdef kOfxInteractSuite
printf("S kOfxInteractSuite \"%s\"\n",kOfxInteractSuite);
#else
printf("S kOfxInteractSuite MISSING\n");
#endif
#ifdef kOfxInteractPropSlaveToParam
printf("S kOfxInteractPropSlaveToParam \"%s\"\n",kOfxInteractPropSlaveToParam);
#else
printf("S kOfxInteractPropSlaveToParam MISSING\n");
#endif
#ifdef kOfxInteractPropPixelScale
printf("S kOfxInteractPropPixelScale \"%s\"\n",kOfxInteractPropPixelScale);
#else
printf("S kOfxInteractPropPixelScale MISSING\n");
#endif
#ifdef kOfxInteractPropBackgroundColour
printf("S kOfxInteractPropBackgroundColour \"%s\"\n",kOfxInteractPropBackgroundColour);
#else
printf("S kOfxInteractPropBackgroundColour MISSING\n");
#endif
#ifdef kOfxInteractPropSuggestedColour
printf("S kOfxInteractPropSuggestedColour \"%s\"\n",kOfxInteractPropSuggestedColour);
#else
printf("S kOfxInteractPropSuggestedColour MISSING\n");
#endif
#ifdef kOfxInteractPropPenPosition
printf("S kOfxInteractPropPenPosition \"%s\"\n",kOfxInteractPropPenPosition);
#else
printf("S kOfxInteractPropPenPosition MISSING\n");
#endif
#ifdef kOfxInteractPropPenViewportPosition
printf("S kOfxInteractPropPenViewportPosition \"%s\"\n",kOfxInteractPropPenViewportPosition);
#else
printf("S kOfxInteractPropPenViewportPosition MISSING\n");
#endif
#ifdef kOfxInteractPropPenPressure
printf("S kOfxInteractPropPenPressure \"%s\"\n",kOfxInteractPropPenPressure);
#else
printf("S kOfxInteractPropPenPressure MISSING\n");
#endif
#ifdef kOfxInteractPropBitDepth
printf("S kOfxInteractPropBitDepth \"%s\"\n",kOfxInteractPropBitDepth);
#else
printf("S kOfxInteractPropBitDepth MISSING\n");
#endif
#ifdef kOfxInteractPropHasAlpha
printf("S kOfxInteractPropHasAlpha \"%s\"\n",kOfxInteractPropHasAlpha);
#else
printf("S kOfxInteractPropHasAlpha MISSING\n");
#endif
#ifdef kOfxInteractActionDraw
printf("S kOfxInteractActionDraw \"%s\"\n",kOfxInteractActionDraw);
#else
printf("S kOfxInteractActionDraw MISSING\n");
#endif
#ifdef kOfxInteractActionPenMotion
printf("S kOfxInteractActionPenMotion \"%s\"\n",kOfxInteractActionPenMotion);
#else
printf("S kOfxInteractActionPenMotion MISSING\n");
#endif
#ifdef kOfxInteractActionPenDown
printf("S kOfxInteractActionPenDown \"%s\"\n",kOfxInteractActionPenDown);
#else
printf("S kOfxInteractActionPenDown MISSING\n");
#endif
#ifdef kOfxInteractActionPenUp
printf("S kOfxInteractActionPenUp \"%s\"\n",kOfxInteractActionPenUp);
#else
printf("S kOfxInteractActionPenUp MISSING\n");
#endif
#ifdef kOfxInteractActionKeyDown
printf("S kOfxInteractActionKeyDown \"%s\"\n",kOfxInteractActionKeyDown);
#else
printf("S kOfxInteractActionKeyDown MISSING\n");
#endif
#ifdef kOfxInteractActionKeyUp
printf("S kOfxInteractActionKeyUp \"%s\"\n",kOfxInteractActionKeyUp);
#else
printf("S kOfxInteractActionKeyUp MISSING\n");
#endif
#ifdef kOfxInteractActionKeyRepeat
printf("S kOfxInteractActionKeyRepeat \"%s\"\n",kOfxInteractActionKeyRepeat);
#else
printf("S kOfxInteractActionKeyRepeat MISSING\n");
#endif
#ifdef kOfxInteractActionGainFocus
printf("S kOfxInteractActionGainFocus \"%s\"\n",kOfxInteractActionGainFocus);
#else
printf("S kOfxInteractActionGainFocus MISSING\n");
#endif
#ifdef kOfxInteractActionLoseFocus
printf("S kOfxInteractActionLoseFocus \"%s\"\n",kOfxInteractActionLoseFocus);
#else
printf("S kOfxInteractActionLoseFocus MISSING\n");
#endif
#ifdef kOfxPropKeySym
printf("S kOfxPropKeySym \"%s\"\n",kOfxPropKeySym);
#else
printf("S kOfxPropKeySym MISSING\n");
#endif
#ifdef kOfxPropKeyString
printf("S kOfxPropKeyString \"%s\"\n",kOfxPropKeyString);
#else
printf("S kOfxPropKeyString MISSING\n");
#endif
#ifdef kOfxDrawSuite
printf("S kOfxDrawSuite \"%s\"\n",kOfxDrawSuite);
#else
printf("S kOfxDrawSuite MISSING\n");
#endif
#ifdef kOfxInteractPropDrawContext
printf("S kOfxInteractPropDrawContext \"%s\"\n",kOfxInteractPropDrawContext);
#else
printf("S kOfxInteractPropDrawContext MISSING\n");
#endif
#ifdef kOfxImageEffectPluginApi
printf("S kOfxImageEffectPluginApi \"%s\"\n",kOfxImageEffectPluginApi);
#else
printf("S kOfxImageEffectPluginApi MISSING\n");
#endif
#ifdef kOfxImageComponentNone
printf("S kOfxImageComponentNone \"%s\"\n",kOfxImageComponentNone);
#else
printf("S kOfxImageComponentNone MISSING\n");
#endif
#ifdef kOfxImageComponentRGBA
printf("S kOfxImageComponentRGBA \"%s\"\n",kOfxImageComponentRGBA);
#else
printf("S kOfxImageComponentRGBA MISSING\n");
#endif
#ifdef kOfxImageComponentRGB
printf("S kOfxImageComponentRGB \"%s\"\n",kOfxImageComponentRGB);
#else
printf("S kOfxImageComponentRGB MISSING\n");
#endif
#ifdef kOfxImageComponentAlpha
printf("S kOfxImageComponentAlpha \"%s\"\n",kOfxImageComponentAlpha);
#else
printf("S kOfxImageComponentAlpha MISSING\n");
#endif
#ifdef kOfxImageEffectContextGenerator
printf("S kOfxImageEffectContextGenerator \"%s\"\n",kOfxImageEffectContextGenerator);
#else
printf("S kOfxImageEffectContextGenerator MISSING\n");
#endif
#ifdef kOfxImageEffectContextFilter
printf("S kOfxImageEffectContextFilter \"%s\"\n",kOfxImageEffectContextFilter);
#else
printf("S kOfxImageEffectContextFilter MISSING\n");
#endif
#ifdef kOfxImageEffectContextTransition
printf("S kOfxImageEffectContextTransition \"%s\"\n",kOfxImageEffectContextTransition);
#else
printf("S kOfxImageEffectContextTransition MISSING\n");
#endif
#ifdef kOfxImageEffectContextPaint
printf("S kOfxImageEffectContextPaint \"%s\"\n",kOfxImageEffectContextPaint);
#else
printf("S kOfxImageEffectContextPaint MISSING\n");
#endif
#ifdef kOfxImageEffectContextGeneral
printf("S kOfxImageEffectContextGeneral \"%s\"\n",kOfxImageEffectContextGeneral);
#else
printf("S kOfxImageEffectContextGeneral MISSING\n");
#endif
#ifdef kOfxImageEffectContextRetimer
printf("S kOfxImageEffectContextRetimer \"%s\"\n",kOfxImageEffectContextRetimer);
#else
printf("S kOfxImageEffectContextRetimer MISSING\n");
#endif
#ifdef kOfxTypeImageEffectHost
printf("S kOfxTypeImageEffectHost \"%s\"\n",kOfxTypeImageEffectHost);
#else
printf("S kOfxTypeImageEffectHost MISSING\n");
#endif
#ifdef kOfxTypeImageEffect
printf("S kOfxTypeImageEffect \"%s\"\n",kOfxTypeImageEffect);
#else
printf("S kOfxTypeImageEffect MISSING\n");
#endif
#ifdef kOfxTypeImageEffectInstance
printf("S kOfxTypeImageEffectInstance \"%s\"\n",kOfxTypeImageEffectInstance);
#else
printf("S kOfxTypeImageEffectInstance MISSING\n");
#endif
#ifdef kOfxTypeClip
printf("S kOfxTypeClip \"%s\"\n",kOfxTypeClip);
#else
printf("S kOfxTypeClip MISSING\n");
#endif
#ifdef kOfxTypeImage
printf("S kOfxTypeImage \"%s\"\n",kOfxTypeImage);
#else
printf("S kOfxTypeImage MISSING\n");
#endif
#ifdef kOfxImageEffectActionGetRegionOfDefinition
printf("S kOfxImageEffectActionGetRegionOfDefinition \"%s\"\n",kOfxImageEffectActionGetRegionOfDefinition);
#else
printf("S kOfxImageEffectActionGetRegionOfDefinition MISSING\n");
#endif
#ifdef kOfxImageEffectActionGetRegionsOfInterest
printf("S kOfxImageEffectActionGetRegionsOfInterest \"%s\"\n",kOfxImageEffectActionGetRegionsOfInterest);
#else
printf("S kOfxImageEffectActionGetRegionsOfInterest MISSING\n");
#endif
#ifdef kOfxImageEffectActionGetTimeDomain
printf("S kOfxImageEffectActionGetTimeDomain \"%s\"\n",kOfxImageEffectActionGetTimeDomain);
#else
printf("S kOfxImageEffectActionGetTimeDomain MISSING\n");
#endif
#ifdef kOfxImageEffectActionGetFramesNeeded
printf("S kOfxImageEffectActionGetFramesNeeded \"%s\"\n",kOfxImageEffectActionGetFramesNeeded);
#else
printf("S kOfxImageEffectActionGetFramesNeeded MISSING\n");
#endif
#ifdef kOfxImageEffectActionGetClipPreferences
printf("S kOfxImageEffectActionGetClipPreferences \"%s\"\n",kOfxImageEffectActionGetClipPreferences);
#else
printf("S kOfxImageEffectActionGetClipPreferences MISSING\n");
#endif
#ifdef kOfxImageEffectActionIsIdentity
printf("S kOfxImageEffectActionIsIdentity \"%s\"\n",kOfxImageEffectActionIsIdentity);
#else
printf("S kOfxImageEffectActionIsIdentity MISSING\n");
#endif
#ifdef kOfxImageEffectActionRender
printf("S kOfxImageEffectActionRender \"%s\"\n",kOfxImageEffectActionRender);
#else
printf("S kOfxImageEffectActionRender MISSING\n");
#endif
#ifdef kOfxImageEffectActionBeginSequenceRender
printf("S kOfxImageEffectActionBeginSequenceRender \"%s\"\n",kOfxImageEffectActionBeginSequenceRender);
#else
printf("S kOfxImageEffectActionBeginSequenceRender MISSING\n");
#endif
#ifdef kOfxImageEffectActionEndSequenceRender
printf("S kOfxImageEffectActionEndSequenceRender \"%s\"\n",kOfxImageEffectActionEndSequenceRender);
#else
printf("S kOfxImageEffectActionEndSequenceRender MISSING\n");
#endif
#ifdef kOfxImageEffectActionDescribeInContext
printf("S kOfxImageEffectActionDescribeInContext \"%s\"\n",kOfxImageEffectActionDescribeInContext);
#else
printf("S kOfxImageEffectActionDescribeInContext MISSING\n");
#endif
#ifdef kOfxImageEffectPropSupportedContexts
printf("S kOfxImageEffectPropSupportedContexts \"%s\"\n",kOfxImageEffectPropSupportedContexts);
#else
printf("S kOfxImageEffectPropSupportedContexts MISSING\n");
#endif
#ifdef kOfxImageEffectPropPluginHandle
printf("S kOfxImageEffectPropPluginHandle \"%s\"\n",kOfxImageEffectPropPluginHandle);
#else
printf("S kOfxImageEffectPropPluginHandle MISSING\n");
#endif
#ifdef kOfxImageEffectHostPropIsBackground
printf("S kOfxImageEffectHostPropIsBackground \"%s\"\n",kOfxImageEffectHostPropIsBackground);
#else
printf("S kOfxImageEffectHostPropIsBackground MISSING\n");
#endif
#ifdef kOfxImageEffectPluginPropSingleInstance
printf("S kOfxImageEffectPluginPropSingleInstance \"%s\"\n",kOfxImageEffectPluginPropSingleInstance);
#else
printf("S kOfxImageEffectPluginPropSingleInstance MISSING\n");
#endif
#ifdef kOfxImageEffectPluginRenderThreadSafety
printf("S kOfxImageEffectPluginRenderThreadSafety \"%s\"\n",kOfxImageEffectPluginRenderThreadSafety);
#else
printf("S kOfxImageEffectPluginRenderThreadSafety MISSING\n");
#endif
#ifdef kOfxImageEffectRenderUnsafe
printf("S kOfxImageEffectRenderUnsafe \"%s\"\n",kOfxImageEffectRenderUnsafe);
#else
printf("S kOfxImageEffectRenderUnsafe MISSING\n");
#endif
#ifdef kOfxImageEffectRenderInstanceSafe
printf("S kOfxImageEffectRenderInstanceSafe \"%s\"\n",kOfxImageEffectRenderInstanceSafe);
#else
printf("S kOfxImageEffectRenderInstanceSafe MISSING\n");
#endif
#ifdef kOfxImageEffectRenderFullySafe
printf("S kOfxImageEffectRenderFullySafe \"%s\"\n",kOfxImageEffectRenderFullySafe);
#else
printf("S kOfxImageEffectRenderFullySafe MISSING\n");
#endif
#ifdef kOfxImageEffectPluginPropHostFrameThreading
printf("S kOfxImageEffectPluginPropHostFrameThreading \"%s\"\n",kOfxImageEffectPluginPropHostFrameThreading);
#else
printf("S kOfxImageEffectPluginPropHostFrameThreading MISSING\n");
#endif
#ifdef kOfxImageEffectPropSupportsMultipleClipDepths
printf("S kOfxImageEffectPropSupportsMultipleClipDepths \"%s\"\n",kOfxImageEffectPropSupportsMultipleClipDepths);
#else
printf("S kOfxImageEffectPropSupportsMultipleClipDepths MISSING\n");
#endif
#ifdef kOfxImageEffectPropSupportsMultipleClipPARs
printf("S kOfxImageEffectPropSupportsMultipleClipPARs \"%s\"\n",kOfxImageEffectPropSupportsMultipleClipPARs);
#else
printf("S kOfxImageEffectPropSupportsMultipleClipPARs MISSING\n");
#endif
#ifdef kOfxImageEffectPropClipPreferencesSlaveParam
printf("S kOfxImageEffectPropClipPreferencesSlaveParam \"%s\"\n",kOfxImageEffectPropClipPreferencesSlaveParam);
#else
printf("S kOfxImageEffectPropClipPreferencesSlaveParam MISSING\n");
#endif
#ifdef kOfxImageEffectPropSetableFrameRate
printf("S kOfxImageEffectPropSetableFrameRate \"%s\"\n",kOfxImageEffectPropSetableFrameRate);
#else
printf("S kOfxImageEffectPropSetableFrameRate MISSING\n");
#endif
#ifdef kOfxImageEffectPropSetableFielding
printf("S kOfxImageEffectPropSetableFielding \"%s\"\n",kOfxImageEffectPropSetableFielding);
#else
printf("S kOfxImageEffectPropSetableFielding MISSING\n");
#endif
#ifdef kOfxImageEffectInstancePropSequentialRender
printf("S kOfxImageEffectInstancePropSequentialRender \"%s\"\n",kOfxImageEffectInstancePropSequentialRender);
#else
printf("S kOfxImageEffectInstancePropSequentialRender MISSING\n");
#endif
#ifdef kOfxImageEffectPropSequentialRenderStatus
printf("S kOfxImageEffectPropSequentialRenderStatus \"%s\"\n",kOfxImageEffectPropSequentialRenderStatus);
#else
printf("S kOfxImageEffectPropSequentialRenderStatus MISSING\n");
#endif
#ifdef kOfxHostNativeOriginBottomLeft
printf("S kOfxHostNativeOriginBottomLeft \"%s\"\n",kOfxHostNativeOriginBottomLeft);
#else
printf("S kOfxHostNativeOriginBottomLeft MISSING\n");
#endif
#ifdef kOfxHostNativeOriginTopLeft
printf("S kOfxHostNativeOriginTopLeft \"%s\"\n",kOfxHostNativeOriginTopLeft);
#else
printf("S kOfxHostNativeOriginTopLeft MISSING\n");
#endif
#ifdef kOfxHostNativeOriginCenter
printf("S kOfxHostNativeOriginCenter \"%s\"\n",kOfxHostNativeOriginCenter);
#else
printf("S kOfxHostNativeOriginCenter MISSING\n");
#endif
#ifdef kOfxImageEffectHostPropNativeOrigin
printf("S kOfxImageEffectHostPropNativeOrigin \"%s\"\n",kOfxImageEffectHostPropNativeOrigin);
#else
printf("S kOfxImageEffectHostPropNativeOrigin MISSING\n");
#endif
#ifdef kOfxImageEffectPropInteractiveRenderStatus
printf("S kOfxImageEffectPropInteractiveRenderStatus \"%s\"\n",kOfxImageEffectPropInteractiveRenderStatus);
#else
printf("S kOfxImageEffectPropInteractiveRenderStatus MISSING\n");
#endif
#ifdef kOfxImageEffectPluginPropGrouping
printf("S kOfxImageEffectPluginPropGrouping \"%s\"\n",kOfxImageEffectPluginPropGrouping);
#else
printf("S kOfxImageEffectPluginPropGrouping MISSING\n");
#endif
#ifdef kOfxImageEffectPluginPropObsolete
printf("S kOfxImageEffectPluginPropObsolete \"%s\"\n",kOfxImageEffectPluginPropObsolete);
#else
printf("S kOfxImageEffectPluginPropObsolete MISSING\n");
#endif
#ifdef kOfxImageEffectPropSupportsOverlays
printf("S kOfxImageEffectPropSupportsOverlays \"%s\"\n",kOfxImageEffectPropSupportsOverlays);
#else
printf("S kOfxImageEffectPropSupportsOverlays MISSING\n");
#endif
#ifdef kOfxImageEffectPluginPropOverlayInteractV1
printf("S kOfxImageEffectPluginPropOverlayInteractV1 \"%s\"\n",kOfxImageEffectPluginPropOverlayInteractV1);
#else
printf("S kOfxImageEffectPluginPropOverlayInteractV1 MISSING\n");
#endif
#ifdef kOfxImageEffectPluginPropOverlayInteractV2
printf("S kOfxImageEffectPluginPropOverlayInteractV2 \"%s\"\n",kOfxImageEffectPluginPropOverlayInteractV2);
#else
printf("S kOfxImageEffectPluginPropOverlayInteractV2 MISSING\n");
#endif
#ifdef kOfxImageEffectPropSupportsMultiResolution
printf("S kOfxImageEffectPropSupportsMultiResolution \"%s\"\n",kOfxImageEffectPropSupportsMultiResolution);
#else
printf("S kOfxImageEffectPropSupportsMultiResolution MISSING\n");
#endif
#ifdef kOfxImageEffectPropSupportsTiles
printf("S kOfxImageEffectPropSupportsTiles \"%s\"\n",kOfxImageEffectPropSupportsTiles);
#else
printf("S kOfxImageEffectPropSupportsTiles MISSING\n");
#endif
#ifdef kOfxImageEffectPropTemporalClipAccess
printf("S kOfxImageEffectPropTemporalClipAccess \"%s\"\n",kOfxImageEffectPropTemporalClipAccess);
#else
printf("S kOfxImageEffectPropTemporalClipAccess MISSING\n");
#endif
#ifdef kOfxImageEffectPropContext
printf("S kOfxImageEffectPropContext \"%s\"\n",kOfxImageEffectPropContext);
#else
printf("S kOfxImageEffectPropContext MISSING\n");
#endif
#ifdef kOfxImageEffectPropPixelDepth
printf("S kOfxImageEffectPropPixelDepth \"%s\"\n",kOfxImageEffectPropPixelDepth);
#else
printf("S kOfxImageEffectPropPixelDepth MISSING\n");
#endif
#ifdef kOfxImageEffectPropComponents
printf("S kOfxImageEffectPropComponents \"%s\"\n",kOfxImageEffectPropComponents);
#else
printf("S kOfxImageEffectPropComponents MISSING\n");
#endif
#ifdef kOfxImagePropUniqueIdentifier
printf("S kOfxImagePropUniqueIdentifier \"%s\"\n",kOfxImagePropUniqueIdentifier);
#else
printf("S kOfxImagePropUniqueIdentifier MISSING\n");
#endif
#ifdef kOfxImageClipPropContinuousSamples
printf("S kOfxImageClipPropContinuousSamples \"%s\"\n",kOfxImageClipPropContinuousSamples);
#else
printf("S kOfxImageClipPropContinuousSamples MISSING\n");
#endif
#ifdef kOfxImageClipPropUnmappedPixelDepth
printf("S kOfxImageClipPropUnmappedPixelDepth \"%s\"\n",kOfxImageClipPropUnmappedPixelDepth);
#else
printf("S kOfxImageClipPropUnmappedPixelDepth MISSING\n");
#endif
#ifdef kOfxImageClipPropUnmappedComponents
printf("S kOfxImageClipPropUnmappedComponents \"%s\"\n",kOfxImageClipPropUnmappedComponents);
#else
printf("S kOfxImageClipPropUnmappedComponents MISSING\n");
#endif
#ifdef kOfxImageEffectPropPreMultiplication
printf("S kOfxImageEffectPropPreMultiplication \"%s\"\n",kOfxImageEffectPropPreMultiplication);
#else
printf("S kOfxImageEffectPropPreMultiplication MISSING\n");
#endif
#ifdef kOfxImageOpaque
printf("S kOfxImageOpaque \"%s\"\n",kOfxImageOpaque);
#else
printf("S kOfxImageOpaque MISSING\n");
#endif
#ifdef kOfxImagePreMultiplied
printf("S kOfxImagePreMultiplied \"%s\"\n",kOfxImagePreMultiplied);
#else
printf("S kOfxImagePreMultiplied MISSING\n");
#endif
#ifdef kOfxImageUnPreMultiplied
printf("S kOfxImageUnPreMultiplied \"%s\"\n",kOfxImageUnPreMultiplied);
#else
printf("S kOfxImageUnPreMultiplied MISSING\n");
#endif
#ifdef kOfxImageEffectPropSupportedPixelDepths
printf("S kOfxImageEffectPropSupportedPixelDepths \"%s\"\n",kOfxImageEffectPropSupportedPixelDepths);
#else
printf("S kOfxImageEffectPropSupportedPixelDepths MISSING\n");
#endif
#ifdef kOfxImageEffectPropSupportedComponents
printf("S kOfxImageEffectPropSupportedComponents \"%s\"\n",kOfxImageEffectPropSupportedComponents);
#else
printf("S kOfxImageEffectPropSupportedComponents MISSING\n");
#endif
#ifdef kOfxImageClipPropOptional
printf("S kOfxImageClipPropOptional \"%s\"\n",kOfxImageClipPropOptional);
#else
printf("S kOfxImageClipPropOptional MISSING\n");
#endif
#ifdef kOfxImageClipPropIsMask
printf("S kOfxImageClipPropIsMask \"%s\"\n",kOfxImageClipPropIsMask);
#else
printf("S kOfxImageClipPropIsMask MISSING\n");
#endif
#ifdef kOfxImagePropPixelAspectRatio
printf("S kOfxImagePropPixelAspectRatio \"%s\"\n",kOfxImagePropPixelAspectRatio);
#else
printf("S kOfxImagePropPixelAspectRatio MISSING\n");
#endif
#ifdef kOfxImageEffectPropFrameRate
printf("S kOfxImageEffectPropFrameRate \"%s\"\n",kOfxImageEffectPropFrameRate);
#else
printf("S kOfxImageEffectPropFrameRate MISSING\n");
#endif
#ifdef kOfxImageEffectPropUnmappedFrameRate
printf("S kOfxImageEffectPropUnmappedFrameRate \"%s\"\n",kOfxImageEffectPropUnmappedFrameRate);
#else
printf("S kOfxImageEffectPropUnmappedFrameRate MISSING\n");
#endif
#ifdef kOfxImageEffectPropFrameStep
printf("S kOfxImageEffectPropFrameStep \"%s\"\n",kOfxImageEffectPropFrameStep);
#else
printf("S kOfxImageEffectPropFrameStep MISSING\n");
#endif
#ifdef kOfxImageEffectPropFrameRange
printf("S kOfxImageEffectPropFrameRange \"%s\"\n",kOfxImageEffectPropFrameRange);
#else
printf("S kOfxImageEffectPropFrameRange MISSING\n");
#endif
#ifdef kOfxImageEffectPropUnmappedFrameRange
printf("S kOfxImageEffectPropUnmappedFrameRange \"%s\"\n",kOfxImageEffectPropUnmappedFrameRange);
#else
printf("S kOfxImageEffectPropUnmappedFrameRange MISSING\n");
#endif
#ifdef kOfxImageClipPropConnected
printf("S kOfxImageClipPropConnected \"%s\"\n",kOfxImageClipPropConnected);
#else
printf("S kOfxImageClipPropConnected MISSING\n");
#endif
#ifdef kOfxImageEffectFrameVarying
printf("S kOfxImageEffectFrameVarying \"%s\"\n",kOfxImageEffectFrameVarying);
#else
printf("S kOfxImageEffectFrameVarying MISSING\n");
#endif
#ifdef kOfxImageEffectPropRenderScale
printf("S kOfxImageEffectPropRenderScale \"%s\"\n",kOfxImageEffectPropRenderScale);
#else
printf("S kOfxImageEffectPropRenderScale MISSING\n");
#endif
#ifdef kOfxImageEffectPropRenderQualityDraft
printf("S kOfxImageEffectPropRenderQualityDraft \"%s\"\n",kOfxImageEffectPropRenderQualityDraft);
#else
printf("S kOfxImageEffectPropRenderQualityDraft MISSING\n");
#endif
#ifdef kOfxImageEffectPropNoSpatialAwareness
printf("S kOfxImageEffectPropNoSpatialAwareness \"%s\"\n",kOfxImageEffectPropNoSpatialAwareness);
#else
printf("S kOfxImageEffectPropNoSpatialAwareness MISSING\n");
#endif
#ifdef kOfxImageEffectPropThumbnailRender
printf("S kOfxImageEffectPropThumbnailRender \"%s\"\n",kOfxImageEffectPropThumbnailRender);
#else
printf("S kOfxImageEffectPropThumbnailRender MISSING\n");
#endif
#ifdef kOfxImageEffectPropProjectExtent
printf("S kOfxImageEffectPropProjectExtent \"%s\"\n",kOfxImageEffectPropProjectExtent);
#else
printf("S kOfxImageEffectPropProjectExtent MISSING\n");
#endif
#ifdef kOfxImageEffectPropProjectSize
printf("S kOfxImageEffectPropProjectSize \"%s\"\n",kOfxImageEffectPropProjectSize);
#else
printf("S kOfxImageEffectPropProjectSize MISSING\n");
#endif
#ifdef kOfxImageEffectPropProjectOffset
printf("S kOfxImageEffectPropProjectOffset \"%s\"\n",kOfxImageEffectPropProjectOffset);
#else
printf("S kOfxImageEffectPropProjectOffset MISSING\n");
#endif
#ifdef kOfxImageEffectPropProjectPixelAspectRatio
printf("S kOfxImageEffectPropProjectPixelAspectRatio \"%s\"\n",kOfxImageEffectPropProjectPixelAspectRatio);
#else
printf("S kOfxImageEffectPropProjectPixelAspectRatio MISSING\n");
#endif
#ifdef kOfxImageEffectInstancePropEffectDuration
printf("S kOfxImageEffectInstancePropEffectDuration \"%s\"\n",kOfxImageEffectInstancePropEffectDuration);
#else
printf("S kOfxImageEffectInstancePropEffectDuration MISSING\n");
#endif
#ifdef kOfxImageClipPropFieldOrder
printf("S kOfxImageClipPropFieldOrder \"%s\"\n",kOfxImageClipPropFieldOrder);
#else
printf("S kOfxImageClipPropFieldOrder MISSING\n");
#endif
#ifdef kOfxImagePropData
printf("S kOfxImagePropData \"%s\"\n",kOfxImagePropData);
#else
printf("S kOfxImagePropData MISSING\n");
#endif
#ifdef kOfxImagePropBounds
printf("S kOfxImagePropBounds \"%s\"\n",kOfxImagePropBounds);
#else
printf("S kOfxImagePropBounds MISSING\n");
#endif
#ifdef kOfxImagePropRegionOfDefinition
printf("S kOfxImagePropRegionOfDefinition \"%s\"\n",kOfxImagePropRegionOfDefinition);
#else
printf("S kOfxImagePropRegionOfDefinition MISSING\n");
#endif
#ifdef kOfxImagePropRowBytes
printf("S kOfxImagePropRowBytes \"%s\"\n",kOfxImagePropRowBytes);
#else
printf("S kOfxImagePropRowBytes MISSING\n");
#endif
#ifdef kOfxImagePropField
printf("S kOfxImagePropField \"%s\"\n",kOfxImagePropField);
#else
printf("S kOfxImagePropField MISSING\n");
#endif
#ifdef kOfxImageEffectPluginPropFieldRenderTwiceAlways
printf("S kOfxImageEffectPluginPropFieldRenderTwiceAlways \"%s\"\n",kOfxImageEffectPluginPropFieldRenderTwiceAlways);
#else
printf("S kOfxImageEffectPluginPropFieldRenderTwiceAlways MISSING\n");
#endif
#ifdef kOfxImageClipPropFieldExtraction
printf("S kOfxImageClipPropFieldExtraction \"%s\"\n",kOfxImageClipPropFieldExtraction);
#else
printf("S kOfxImageClipPropFieldExtraction MISSING\n");
#endif
#ifdef kOfxImageEffectPropFieldToRender
printf("S kOfxImageEffectPropFieldToRender \"%s\"\n",kOfxImageEffectPropFieldToRender);
#else
printf("S kOfxImageEffectPropFieldToRender MISSING\n");
#endif
#ifdef kOfxImageEffectPropRegionOfDefinition
printf("S kOfxImageEffectPropRegionOfDefinition \"%s\"\n",kOfxImageEffectPropRegionOfDefinition);
#else
printf("S kOfxImageEffectPropRegionOfDefinition MISSING\n");
#endif
#ifdef kOfxImageEffectPropRegionOfInterest
printf("S kOfxImageEffectPropRegionOfInterest \"%s\"\n",kOfxImageEffectPropRegionOfInterest);
#else
printf("S kOfxImageEffectPropRegionOfInterest MISSING\n");
#endif
#ifdef kOfxImageEffectPropRenderWindow
printf("S kOfxImageEffectPropRenderWindow \"%s\"\n",kOfxImageEffectPropRenderWindow);
#else
printf("S kOfxImageEffectPropRenderWindow MISSING\n");
#endif
#ifdef kOfxImageFieldNone
printf("S kOfxImageFieldNone \"%s\"\n",kOfxImageFieldNone);
#else
printf("S kOfxImageFieldNone MISSING\n");
#endif
#ifdef kOfxImageFieldLower
printf("S kOfxImageFieldLower \"%s\"\n",kOfxImageFieldLower);
#else
printf("S kOfxImageFieldLower MISSING\n");
#endif
#ifdef kOfxImageFieldUpper
printf("S kOfxImageFieldUpper \"%s\"\n",kOfxImageFieldUpper);
#else
printf("S kOfxImageFieldUpper MISSING\n");
#endif
#ifdef kOfxImageFieldBoth
printf("S kOfxImageFieldBoth \"%s\"\n",kOfxImageFieldBoth);
#else
printf("S kOfxImageFieldBoth MISSING\n");
#endif
#ifdef kOfxImageFieldSingle
printf("S kOfxImageFieldSingle \"%s\"\n",kOfxImageFieldSingle);
#else
printf("S kOfxImageFieldSingle MISSING\n");
#endif
#ifdef kOfxImageFieldDoubled
printf("S kOfxImageFieldDoubled \"%s\"\n",kOfxImageFieldDoubled);
#else
printf("S kOfxImageFieldDoubled MISSING\n");
#endif
#ifdef kOfxImageEffectPropBehaviourWhenUnlicensed
printf("S kOfxImageEffectPropBehaviourWhenUnlicensed \"%s\"\n",kOfxImageEffectPropBehaviourWhenUnlicensed);
#else
printf("S kOfxImageEffectPropBehaviourWhenUnlicensed MISSING\n");
#endif
#ifdef kOfxUnlicensedContinue
printf("S kOfxUnlicensedContinue \"%s\"\n",kOfxUnlicensedContinue);
#else
printf("S kOfxUnlicensedContinue MISSING\n");
#endif
#ifdef kOfxUnlicensedFail
printf("S kOfxUnlicensedFail \"%s\"\n",kOfxUnlicensedFail);
#else
printf("S kOfxUnlicensedFail MISSING\n");
#endif
#ifdef kOfxImageEffectOutputClipName
printf("S kOfxImageEffectOutputClipName \"%s\"\n",kOfxImageEffectOutputClipName);
#else
printf("S kOfxImageEffectOutputClipName MISSING\n");
#endif
#ifdef kOfxImageEffectSimpleSourceClipName
printf("S kOfxImageEffectSimpleSourceClipName \"%s\"\n",kOfxImageEffectSimpleSourceClipName);
#else
printf("S kOfxImageEffectSimpleSourceClipName MISSING\n");
#endif
#ifdef kOfxImageEffectTransitionSourceFromClipName
printf("S kOfxImageEffectTransitionSourceFromClipName \"%s\"\n",kOfxImageEffectTransitionSourceFromClipName);
#else
printf("S kOfxImageEffectTransitionSourceFromClipName MISSING\n");
#endif
#ifdef kOfxImageEffectTransitionSourceToClipName
printf("S kOfxImageEffectTransitionSourceToClipName \"%s\"\n",kOfxImageEffectTransitionSourceToClipName);
#else
printf("S kOfxImageEffectTransitionSourceToClipName MISSING\n");
#endif
#ifdef kOfxImageEffectTransitionParamName
printf("S kOfxImageEffectTransitionParamName \"%s\"\n",kOfxImageEffectTransitionParamName);
#else
printf("S kOfxImageEffectTransitionParamName MISSING\n");
#endif
#ifdef kOfxImageEffectRetimerParamName
printf("S kOfxImageEffectRetimerParamName \"%s\"\n",kOfxImageEffectRetimerParamName);
#else
printf("S kOfxImageEffectRetimerParamName MISSING\n");
#endif
#ifdef kOfxImageEffectSuite
printf("S kOfxImageEffectSuite \"%s\"\n",kOfxImageEffectSuite);
#else
printf("S kOfxImageEffectSuite MISSING\n");
#endif
#ifdef kOfxOpenGLRenderSuite
printf("S kOfxOpenGLRenderSuite \"%s\"\n",kOfxOpenGLRenderSuite);
#else
printf("S kOfxOpenGLRenderSuite MISSING\n");
#endif
#ifdef kOfxImageEffectPropOpenGLRenderSupported
printf("S kOfxImageEffectPropOpenGLRenderSupported \"%s\"\n",kOfxImageEffectPropOpenGLRenderSupported);
#else
printf("S kOfxImageEffectPropOpenGLRenderSupported MISSING\n");
#endif
#ifdef kOfxOpenGLPropPixelDepth
printf("S kOfxOpenGLPropPixelDepth \"%s\"\n",kOfxOpenGLPropPixelDepth);
#else
printf("S kOfxOpenGLPropPixelDepth MISSING\n");
#endif
#ifdef kOfxImageEffectPropOpenGLEnabled
printf("S kOfxImageEffectPropOpenGLEnabled \"%s\"\n",kOfxImageEffectPropOpenGLEnabled);
#else
printf("S kOfxImageEffectPropOpenGLEnabled MISSING\n");
#endif
#ifdef kOfxImageEffectPropOpenGLTextureIndex
printf("S kOfxImageEffectPropOpenGLTextureIndex \"%s\"\n",kOfxImageEffectPropOpenGLTextureIndex);
#else
printf("S kOfxImageEffectPropOpenGLTextureIndex MISSING\n");
#endif
#ifdef kOfxImageEffectPropOpenGLTextureTarget
printf("S kOfxImageEffectPropOpenGLTextureTarget \"%s\"\n",kOfxImageEffectPropOpenGLTextureTarget);
#else
printf("S kOfxImageEffectPropOpenGLTextureTarget MISSING\n");
#endif
#ifdef kOfxImageEffectPropCPURenderSupported
printf("S kOfxImageEffectPropCPURenderSupported \"%s\"\n",kOfxImageEffectPropCPURenderSupported);
#else
printf("S kOfxImageEffectPropCPURenderSupported MISSING\n");
#endif
#ifdef kOfxActionOpenGLContextAttached
printf("S kOfxActionOpenGLContextAttached \"%s\"\n",kOfxActionOpenGLContextAttached);
#else
printf("S kOfxActionOpenGLContextAttached MISSING\n");
#endif
#ifdef kOfxActionOpenGLContextDetached
printf("S kOfxActionOpenGLContextDetached \"%s\"\n",kOfxActionOpenGLContextDetached);
#else
printf("S kOfxActionOpenGLContextDetached MISSING\n");
#endif
#ifdef kOfxImageEffectPropCudaRenderSupported
printf("S kOfxImageEffectPropCudaRenderSupported \"%s\"\n",kOfxImageEffectPropCudaRenderSupported);
#else
printf("S kOfxImageEffectPropCudaRenderSupported MISSING\n");
#endif
#ifdef kOfxImageEffectPropCudaEnabled
printf("S kOfxImageEffectPropCudaEnabled \"%s\"\n",kOfxImageEffectPropCudaEnabled);
#else
printf("S kOfxImageEffectPropCudaEnabled MISSING\n");
#endif
#ifdef kOfxImageEffectPropCudaStreamSupported
printf("S kOfxImageEffectPropCudaStreamSupported \"%s\"\n",kOfxImageEffectPropCudaStreamSupported);
#else
printf("S kOfxImageEffectPropCudaStreamSupported MISSING\n");
#endif
#ifdef kOfxImageEffectPropCudaStream
printf("S kOfxImageEffectPropCudaStream \"%s\"\n",kOfxImageEffectPropCudaStream);
#else
printf("S kOfxImageEffectPropCudaStream MISSING\n");
#endif
#ifdef kOfxImageEffectPropMetalRenderSupported
printf("S kOfxImageEffectPropMetalRenderSupported \"%s\"\n",kOfxImageEffectPropMetalRenderSupported);
#else
printf("S kOfxImageEffectPropMetalRenderSupported MISSING\n");
#endif
#ifdef kOfxImageEffectPropMetalEnabled
printf("S kOfxImageEffectPropMetalEnabled \"%s\"\n",kOfxImageEffectPropMetalEnabled);
#else
printf("S kOfxImageEffectPropMetalEnabled MISSING\n");
#endif
#ifdef kOfxImageEffectPropMetalCommandQueue
printf("S kOfxImageEffectPropMetalCommandQueue \"%s\"\n",kOfxImageEffectPropMetalCommandQueue);
#else
printf("S kOfxImageEffectPropMetalCommandQueue MISSING\n");
#endif
#ifdef kOfxImageEffectPropOpenCLRenderSupported
printf("S kOfxImageEffectPropOpenCLRenderSupported \"%s\"\n",kOfxImageEffectPropOpenCLRenderSupported);
#else
printf("S kOfxImageEffectPropOpenCLRenderSupported MISSING\n");
#endif
#ifdef kOfxImageEffectPropOpenCLSupported
printf("S kOfxImageEffectPropOpenCLSupported \"%s\"\n",kOfxImageEffectPropOpenCLSupported);
#else
printf("S kOfxImageEffectPropOpenCLSupported MISSING\n");
#endif
#ifdef kOfxImageEffectPropOpenCLEnabled
printf("S kOfxImageEffectPropOpenCLEnabled \"%s\"\n",kOfxImageEffectPropOpenCLEnabled);
#else
printf("S kOfxImageEffectPropOpenCLEnabled MISSING\n");
#endif
#ifdef kOfxImageEffectPropOpenCLCommandQueue
printf("S kOfxImageEffectPropOpenCLCommandQueue \"%s\"\n",kOfxImageEffectPropOpenCLCommandQueue);
#else
printf("S kOfxImageEffectPropOpenCLCommandQueue MISSING\n");
#endif
#ifdef kOfxImageEffectPropOpenCLImage
printf("S kOfxImageEffectPropOpenCLImage \"%s\"\n",kOfxImageEffectPropOpenCLImage);
#else
printf("S kOfxImageEffectPropOpenCLImage MISSING\n");
#endif
#ifdef kOfxOpenCLProgramSuite
printf("S kOfxOpenCLProgramSuite \"%s\"\n",kOfxOpenCLProgramSuite);
#else
printf("S kOfxOpenCLProgramSuite MISSING\n");
#endif
#ifdef kOfxImageEffectPropColourManagementStyle
printf("S kOfxImageEffectPropColourManagementStyle \"%s\"\n",kOfxImageEffectPropColourManagementStyle);
#else
printf("S kOfxImageEffectPropColourManagementStyle MISSING\n");
#endif
#ifdef kOfxImageEffectColourManagementNone
printf("S kOfxImageEffectColourManagementNone \"%s\"\n",kOfxImageEffectColourManagementNone);
#else
printf("S kOfxImageEffectColourManagementNone MISSING\n");
#endif
#ifdef kOfxImageEffectColourManagementBasic
printf("S kOfxImageEffectColourManagementBasic \"%s\"\n",kOfxImageEffectColourManagementBasic);
#else
printf("S kOfxImageEffectColourManagementBasic MISSING\n");
#endif
#ifdef kOfxImageEffectColourManagementCore
printf("S kOfxImageEffectColourManagementCore \"%s\"\n",kOfxImageEffectColourManagementCore);
#else
printf("S kOfxImageEffectColourManagementCore MISSING\n");
#endif
#ifdef kOfxImageEffectColourManagementFull
printf("S kOfxImageEffectColourManagementFull \"%s\"\n",kOfxImageEffectColourManagementFull);
#else
printf("S kOfxImageEffectColourManagementFull MISSING\n");
#endif
#ifdef kOfxImageEffectColourManagementOCIO
printf("S kOfxImageEffectColourManagementOCIO \"%s\"\n",kOfxImageEffectColourManagementOCIO);
#else
printf("S kOfxImageEffectColourManagementOCIO MISSING\n");
#endif
#ifdef kOfxImageEffectPropColourManagementAvailableConfigs
printf("S kOfxImageEffectPropColourManagementAvailableConfigs \"%s\"\n",kOfxImageEffectPropColourManagementAvailableConfigs);
#else
printf("S kOfxImageEffectPropColourManagementAvailableConfigs MISSING\n");
#endif
#ifdef kOfxImageEffectPropColourManagementConfig
printf("S kOfxImageEffectPropColourManagementConfig \"%s\"\n",kOfxImageEffectPropColourManagementConfig);
#else
printf("S kOfxImageEffectPropColourManagementConfig MISSING\n");
#endif
#ifdef kOfxImageEffectPropOCIOConfig
printf("S kOfxImageEffectPropOCIOConfig \"%s\"\n",kOfxImageEffectPropOCIOConfig);
#else
printf("S kOfxImageEffectPropOCIOConfig MISSING\n");
#endif
#ifdef kOfxImageClipPropColourspace
printf("S kOfxImageClipPropColourspace \"%s\"\n",kOfxImageClipPropColourspace);
#else
printf("S kOfxImageClipPropColourspace MISSING\n");
#endif
#ifdef kOfxImageClipPropPreferredColourspaces
printf("S kOfxImageClipPropPreferredColourspaces \"%s\"\n",kOfxImageClipPropPreferredColourspaces);
#else
printf("S kOfxImageClipPropPreferredColourspaces MISSING\n");
#endif
#ifdef kOfxImageEffectPropDisplayColourspace
printf("S kOfxImageEffectPropDisplayColourspace \"%s\"\n",kOfxImageEffectPropDisplayColourspace);
#else
printf("S kOfxImageEffectPropDisplayColourspace MISSING\n");
#endif
#ifdef kOfxImageEffectPropOCIODisplay
printf("S kOfxImageEffectPropOCIODisplay \"%s\"\n",kOfxImageEffectPropOCIODisplay);
#else
printf("S kOfxImageEffectPropOCIODisplay MISSING\n");
#endif
#ifdef kOfxImageEffectPropOCIOView
printf("S kOfxImageEffectPropOCIOView \"%s\"\n",kOfxImageEffectPropOCIOView);
#else
printf("S kOfxImageEffectPropOCIOView MISSING\n");
#endif
#ifdef kOfxImageEffectActionGetOutputColourspace
printf("S kOfxImageEffectActionGetOutputColourspace \"%s\"\n",kOfxImageEffectActionGetOutputColourspace);
#else
printf("S kOfxImageEffectActionGetOutputColourspace MISSING\n");
#endif
#ifdef kOfxDialogSuite
printf("S kOfxDialogSuite \"%s\"\n",kOfxDialogSuite);
#else
printf("S kOfxDialogSuite MISSING\n");
#endif
#ifdef kOfxActionDialog
printf("S kOfxActionDialog \"%s\"\n",kOfxActionDialog);
#else
printf("S kOfxActionDialog MISSING\n");
#endif
#ifdef kOfxImageComponentYUVA
printf("S kOfxImageComponentYUVA \"%s\"\n",kOfxImageComponentYUVA);
#else
printf("S kOfxImageComponentYUVA MISSING\n");
#endif
#ifdef kOfxImageEffectPropInAnalysis
printf("S kOfxImageEffectPropInAnalysis \"%s\"\n",kOfxImageEffectPropInAnalysis);
#else
printf("S kOfxImageEffectPropInAnalysis MISSING\n");
#endif
#ifdef kOfxInteractPropViewportSize
printf("S kOfxInteractPropViewportSize \"%s\"\n",kOfxInteractPropViewportSize);
#else
printf("S kOfxInteractPropViewportSize MISSING\n");
#endif
#ifdef kOfxParamDoubleTypeNormalisedX
printf("S kOfxParamDoubleTypeNormalisedX \"%s\"\n",kOfxParamDoubleTypeNormalisedX);
#else
printf("S kOfxParamDoubleTypeNormalisedX MISSING\n");
#endif
#ifdef kOfxParamDoubleTypeNormalisedY
printf("S kOfxParamDoubleTypeNormalisedY \"%s\"\n",kOfxParamDoubleTypeNormalisedY);
#else
printf("S kOfxParamDoubleTypeNormalisedY MISSING\n");
#endif
#ifdef kOfxParamDoubleTypeNormalisedXAbsolute
printf("S kOfxParamDoubleTypeNormalisedXAbsolute \"%s\"\n",kOfxParamDoubleTypeNormalisedXAbsolute);
#else
printf("S kOfxParamDoubleTypeNormalisedXAbsolute MISSING\n");
#endif
#ifdef kOfxParamDoubleTypeNormalisedYAbsolute
printf("S kOfxParamDoubleTypeNormalisedYAbsolute \"%s\"\n",kOfxParamDoubleTypeNormalisedYAbsolute);
#else
printf("S kOfxParamDoubleTypeNormalisedYAbsolute MISSING\n");
#endif
#ifdef kOfxParamDoubleTypeNormalisedXY
printf("S kOfxParamDoubleTypeNormalisedXY \"%s\"\n",kOfxParamDoubleTypeNormalisedXY);
#else
printf("S kOfxParamDoubleTypeNormalisedXY MISSING\n");
#endif
#ifdef kOfxParamDoubleTypeNormalisedXYAbsolute
printf("S kOfxParamDoubleTypeNormalisedXYAbsolute \"%s\"\n",kOfxParamDoubleTypeNormalisedXYAbsolute);
#else
printf("S kOfxParamDoubleTypeNormalisedXYAbsolute MISSING\n");
#endif
#ifdef kOfxStatOK
printf("I kOfxStatOK %d\n",(int)kOfxStatOK);
#else
printf("I kOfxStatOK MISSING\n");
#endif
#ifdef kOfxStatFailed
printf("I kOfxStatFailed %d\n",(int)kOfxStatFailed);
#else
printf("I kOfxStatFailed MISSING\n");
#endif
#ifdef kOfxStatErrFatal
printf("I kOfxStatErrFatal %d\n",(int)kOfxStatErrFatal);
#else
printf("I kOfxStatErrFatal MISSING\n");
#endif
#ifdef kOfxStatErrUnknown
printf("I kOfxStatErrUnknown %d\n",(int)kOfxStatErrUnknown);
#else
printf("I kOfxStatErrUnknown MISSING\n");
#endif
#ifdef kOfxStatErrMissingHostFeature
printf("I kOfxStatErrMissingHostFeature %d\n",(int)kOfxStatErrMissingHostFeature);
#else
printf("I kOfxStatErrMissingHostFeature MISSING\n");
#endif
#ifdef kOfxStatErrUnsupported
printf("I kOfxStatErrUnsupported %d\n",(int)kOfxStatErrUnsupported);
#else
printf("I kOfxStatErrUnsupported MISSING\n");
#endif
#ifdef kOfxStatErrExists
printf("I kOfxStatErrExists %d\n",(int)kOfxStatErrExists);
#else
printf("I kOfxStatErrExists MISSING\n");
#endif
#ifdef kOfxStatErrFormat
printf("I kOfxStatErrFormat %d\n",(int)kOfxStatErrFormat);
#else
printf("I kOfxStatErrFormat MISSING\n");
#endif
#ifdef kOfxStatErrMemory
printf("I kOfxStatErrMemory %d\n",(int)kOfxStatErrMemory);
#else
printf("I kOfxStatErrMemory MISSING\n");
#endif
#ifdef kOfxStatErrBadHandle
printf("I kOfxStatErrBadHandle %d\n",(int)kOfxStatErrBadHandle);
#else
printf("I kOfxStatErrBadHandle MISSING\n");
#endif
#ifdef kOfxStatErrBadIndex
printf("I kOfxStatErrBadIndex %d\n",(int)kOfxStatErrBadIndex);
#else
printf("I kOfxStatErrBadIndex MISSING\n");
#endif
#ifdef kOfxStatErrValue
printf("I kOfxStatErrValue %d\n",(int)kOfxStatErrValue);
#else
printf("I kOfxStatErrValue MISSING\n");
#endif
#ifdef kOfxStatReplyYes
printf("I kOfxStatReplyYes %d\n",(int)kOfxStatReplyYes);
#else
printf("I kOfxStatReplyYes MISSING\n");
#endif
#ifdef kOfxStatReplyNo
printf("I kOfxStatReplyNo %d\n",(int)kOfxStatReplyNo);
#else
printf("I kOfxStatReplyNo MISSING\n");
#endif
#ifdef kOfxStatReplyDefault
printf("I kOfxStatReplyDefault %d\n",(int)kOfxStatReplyDefault);
#else
printf("I kOfxStatReplyDefault MISSING\n");
#endif
#ifdef kOfxStatUnlicensed
printf("I kOfxStatUnlicensed %d\n",(int)kOfxStatUnlicensed);
#else
printf("I kOfxStatUnlicensed MISSING\n");
#endif
#ifdef kOfxImageEffectPluginApiVersion
printf("I kOfxImageEffectPluginApiVersion %d\n",(int)kOfxImageEffectPluginApiVersion);
#else
printf("I kOfxImageEffectPluginApiVersion MISSING\n");
#endif
#ifdef kOfxStatErrImageFormat
printf("I kOfxStatErrImageFormat %d\n",(int)kOfxStatErrImageFormat);
#else
printf("I kOfxStatErrImageFormat MISSING\n");
#endif
#ifdef kOfxStatGPUOutOfMemory
printf("I kOfxStatGPUOutOfMemory %d\n",(int)kOfxStatGPUOutOfMemory);
#else
printf("I kOfxStatGPUOutOfMemory MISSING\n");
#endif
#ifdef kOfxStatGLOutOfMemory
printf("I kOfxStatGLOutOfMemory %d\n",(int)kOfxStatGLOutOfMemory);
#else
printf("I kOfxStatGLOutOfMemory MISSING\n");
#endif
#ifdef kOfxStatGPURenderFailed
printf("I kOfxStatGPURenderFailed %d\n",(int)kOfxStatGPURenderFailed);
#else
printf("I kOfxStatGPURenderFailed MISSING\n");
#endif
#ifdef kOfxStatGLRenderFailed
printf("I kOfxStatGLRenderFailed %d\n",(int)kOfxStatGLRenderFailed);
#else
printf("I kOfxStatGLRenderFailed MISSING\n");
#endif
#ifndef NO_OfxHost
printf("Z OfxHost %zu\n",sizeof(OfxHost));
printf("O OfxHost.host %zu\n",offsetof(OfxHost,host));
printf("O OfxHost.fetchSuite %zu\n",offsetof(OfxHost,fetchSuite));
#endif
#ifndef NO_OfxPlugin
printf("Z OfxPlugin %zu\n",sizeof(OfxPlugin));
printf("O OfxPlugin.pluginApi %zu\n",offsetof(OfxPlugin,pluginApi));
printf("O OfxPlugin.apiVersion %zu\n",offsetof(OfxPlugin,apiVersion));
printf("O OfxPlugin.pluginIdentifier %zu\n",offsetof(OfxPlugin,pluginIdentifier));
printf("O OfxPlugin.pluginVersionMajor %zu\n",offsetof(OfxPlugin,pluginVersionMajor));
printf("O OfxPlugin.pluginVersionMinor %zu\n",offsetof(OfxPlugin,pluginVersionMinor));
printf("O OfxPlugin.setHost %zu\n",offsetof(OfxPlugin,setHost));
printf("O OfxPlugin.mainEntry %zu\n",offsetof(OfxPlugin,mainEntry));
#endif
#ifndef NO_OfxRangeI
printf("Z OfxRangeI %zu\n",sizeof(OfxRangeI));
printf("O OfxRangeI.min %zu\n",offsetof(OfxRangeI,min));
printf("O OfxRangeI.max %zu\n",offsetof(OfxRangeI,max));
#endif
#ifndef NO_OfxRangeD
printf("Z OfxRangeD %zu\n",sizeof(OfxRangeD));
printf("O OfxRangeD.min %zu\n",offsetof(OfxRangeD,min));
printf("O OfxRangeD.max %zu\n",offsetof(OfxRangeD,max));
#endif
#ifndef NO_OfxPointI
printf("Z OfxPointI %zu\n",sizeof(OfxPointI));
printf("O OfxPointI.x %zu\n",offsetof(OfxPointI,x));
printf("O OfxPointI.y %zu\n",offsetof(OfxPointI,y));
#endif
#ifndef NO_OfxPointD
printf("Z OfxPointD %zu\n",sizeof(OfxPointD));
printf("O OfxPointD.x %zu\n",offsetof(OfxPointD,x));
printf("O OfxPointD.y %zu\n",offsetof(OfxPointD,y));
#endif
#ifndef NO_OfxRectI
printf("Z OfxRectI %zu\n",sizeof(OfxRectI));
printf("O OfxRectI.x1 %zu\n",offsetof(OfxRectI,x1));
printf("O OfxRectI.y1 %zu\n",offsetof(OfxRectI,y1));
printf("O OfxRectI.x2 %zu\n",offsetof(OfxRectI,x2));
printf("O OfxRectI.y2 %zu\n",offsetof(OfxRectI,y2));
#endif
#ifndef NO_OfxRectD
printf("Z OfxRectD %zu\n",sizeof(OfxRectD));
printf("O OfxRectD.x1 %zu\n",offsetof(OfxRectD,x1));
printf("O OfxRectD.y1 %zu\n",offsetof(OfxRectD,y1));
printf("O OfxRectD.x2 %zu\n",offsetof(OfxRectD,x2));
printf("O OfxRectD.y2 %zu\n",offsetof(OfxRectD,y2));
#endif
#ifndef NO_OfxPropertySuiteV1
printf("Z OfxPropertySuiteV1 %zu\n",sizeof(OfxPropertySuiteV1));
printf("O OfxPropertySuiteV1.propSetPointer %zu\n",offsetof(OfxPropertySuiteV1,propSetPointer));
printf("O OfxPropertySuiteV1.propSetString %zu\n",offsetof(OfxPropertySuiteV1,propSetString));
printf("O OfxPropertySuiteV1.propSetDouble %zu\n",offsetof(OfxPropertySuiteV1,propSetDouble));
printf("O OfxPropertySuiteV1.propSetInt %zu\n",offsetof(OfxPropertySuiteV1,propSetInt));
printf("O OfxPropertySuiteV1.propSetPointerN %zu\n",offsetof(OfxPropertySuiteV1,propSetPointerN));
printf("O OfxPropertySuiteV1.propSetStringN %zu\n",offsetof(OfxPropertySuiteV1,propSetStringN));
printf("O OfxPropertySuiteV1.propSetDoubleN %zu\n",offsetof(OfxPropertySuiteV1,propSetDoubleN));
printf("O OfxPropertySuiteV1.propSetIntN %zu\n",offsetof(OfxPropertySuiteV1,propSetIntN));
printf("O OfxPropertySuiteV1.propGetPointer %zu\n",offsetof(OfxPropertySuiteV1,propGetPointer));
printf("O OfxPropertySuiteV1.propGetString %zu\n",offsetof(OfxPropertySuiteV1,propGetString));
printf("O OfxPropertySuiteV1.propGetDouble %zu\n",offsetof(OfxPropertySuiteV1,propGetDouble));
printf("O OfxPropertySuiteV1.propGetInt %zu\n",offsetof(OfxPropertySuiteV1,propGetInt));
printf("O OfxPropertySuiteV1.propGetPointerN %zu\n",offsetof(OfxPropertySuiteV1,propGetPointerN));
printf("O OfxPropertySuiteV1.propGetStringN %zu\n",offsetof(OfxPropertySuiteV1,propGetStringN));
printf("O OfxPropertySuiteV1.propGetDoubleN %zu\n",offsetof(OfxPropertySuiteV1,propGetDoubleN));
printf("O OfxPropertySuiteV1.propGetIntN %zu\n",offsetof(OfxPropertySuiteV1,propGetIntN));
printf("O OfxPropertySuiteV1.propReset %zu\n",offsetof(OfxPropertySuiteV1,propReset));
printf("O OfxPropertySuiteV1.propGetDimension %zu\n",offsetof(OfxPropertySuiteV1,propGetDimension));
#endif
#ifndef NO_OfxMemorySuiteV1
printf("Z OfxMemorySuiteV1 %zu\n",sizeof(OfxMemorySuiteV1));
printf("O OfxMemorySuiteV1.memoryAlloc %zu\n",offsetof(OfxMemorySuiteV1,memoryAlloc));
printf("O OfxMemorySuiteV1.memoryFree %zu\n",offsetof(OfxMemorySuiteV1,memoryFree));
#endif
#ifndef NO_OfxMultiThreadSuiteV1
printf("Z OfxMultiThreadSuiteV1 %zu\n",sizeof(OfxMultiThreadSuiteV1));
printf("O OfxMultiThreadSuiteV1.multiThread %zu\n",offsetof(OfxMultiThreadSuiteV1,multiThread));
printf("O OfxMultiThreadSuiteV1.multiThreadNumCPUs %zu\n",offsetof(OfxMultiThreadSuiteV1,multiThreadNumCPUs));
printf("O OfxMultiThreadSuiteV1.multiThreadIndex %zu\n",offsetof(OfxMultiThreadSuiteV1,multiThreadIndex));
printf("O OfxMultiThreadSuiteV1.multiThreadIsSpawnedThread %zu\n",offsetof(OfxMultiThreadSuiteV1,multiThreadIsSpawnedThread));
printf("O OfxMultiThreadSuiteV1.mutexCreate %zu\n",offsetof(OfxMultiThreadSuiteV1,mutexCreate));
printf("O OfxMultiThreadSuiteV1.mutexDestroy %zu\n",offsetof(OfxMultiThreadSuiteV1,mutexDestroy));
printf("O OfxMultiThreadSuiteV1.mutexLock %zu\n",offsetof(OfxMultiThreadSuiteV1,mutexLock));
printf("O OfxMultiThreadSuiteV1.mutexUnLock %zu\n",offsetof(OfxMultiThreadSuiteV1,mutexUnLock));
printf("O OfxMultiThreadSuiteV1.mutexTryLock %zu\n",offsetof(OfxMultiThreadSuiteV1,mutexTryLock));
#endif
#ifndef NO_OfxMessageSuiteV1
printf("Z OfxMessageSuiteV1 %zu\n",sizeof(OfxMessageSuiteV1));
printf("O OfxMessageSuiteV1.message %zu\n",offsetof(OfxMessageSuiteV1,message));
#endif
#ifndef NO_OfxMessageSuiteV2
printf("Z OfxMessageSuiteV2 %zu\n",sizeof(OfxMessageSuiteV2));
printf("O OfxMessageSuiteV2.message %zu\n",offsetof(OfxMessageSuiteV2,message));
printf("O OfxMessageSuiteV2.setPersistentMessage %zu\n",offsetof(OfxMessageSuiteV2,setPersistentMessage));
printf("O OfxMessageSuiteV2.clearPersistentMessage %zu\n",offsetof(OfxMessageSuiteV2,clearPersistentMessage));
#endif
#ifndef NO_OfxProgressSuiteV1
printf("Z OfxProgressSuiteV1 %zu\n",sizeof(OfxProgressSuiteV1));
printf("O OfxProgressSuiteV1.progressStart %zu\n",offsetof(OfxProgressSuiteV1,progressStart));
printf("O OfxProgressSuiteV1.progressUpdate %zu\n",offsetof(OfxProgressSuiteV1,progressUpdate));
printf("O OfxProgressSuiteV1.progressEnd %zu\n",offsetof(OfxProgressSuiteV1,progressEnd));
#endif
#ifndef NO_OfxProgressSuiteV2
printf("Z OfxProgressSuiteV2 %zu\n",sizeof(OfxProgressSuiteV2));
printf("O OfxProgressSuiteV2.progressStart %zu\n",offsetof(OfxProgressSuiteV2,progressStart));
printf("O OfxProgressSuiteV2.progressUpdate %zu\n",offsetof(OfxProgressSuiteV2,progressUpdate));
printf("O OfxProgressSuiteV2.progressEnd %zu\n",offsetof(OfxProgressSuiteV2,progressEnd));
#endif
#ifndef NO_OfxTimeLineSuiteV1
printf("Z OfxTimeLineSuiteV1 %zu\n",sizeof(OfxTimeLineSuiteV1));
printf("O OfxTimeLineSuiteV1.getTime %zu\n",offsetof(OfxTimeLineSuiteV1,getTime));
printf("O OfxTimeLineSuiteV1.gotoTime %zu\n",offsetof(OfxTimeLineSuiteV1,gotoTime));
printf("O OfxTimeLineSuiteV1.getTimeBounds %zu\n",offsetof(OfxTimeLineSuiteV1,getTimeBounds));
#endif
#ifndef NO_OfxBytes
printf("Z OfxBytes %zu\n",sizeof(OfxBytes));
printf("O OfxBytes.data %zu\n",offsetof(OfxBytes,data));
printf("O OfxBytes.length %zu\n",offsetof(OfxBytes,length));
#endif
#ifndef NO_OfxParameterSuiteV1
printf("Z OfxParameterSuiteV1 %zu\n",sizeof(OfxParameterSuiteV1));
printf("O OfxParameterSuiteV1.paramDefine %zu\n",offsetof(OfxParameterSuiteV1,paramDefine));
printf("O OfxParameterSuiteV1.paramGetHandle %zu\n",offsetof(OfxParameterSuiteV1,paramGetHandle));
printf("O OfxParameterSuiteV1.paramSetGetPropertySet %zu\n",offsetof(OfxParameterSuiteV1,paramSetGetPropertySet));
printf("O OfxParameterSuiteV1.paramGetPropertySet %zu\n",offsetof(OfxParameterSuiteV1,paramGetPropertySet));
printf("O OfxParameterSuiteV1.paramGetValue %zu\n",offsetof(OfxParameterSuiteV1,paramGetValue));
printf("O OfxParameterSuiteV1.paramGetValueAtTime %zu\n",offsetof(OfxParameterSuiteV1,paramGetValueAtTime));
printf("O OfxParameterSuiteV1.paramGetDerivative %zu\n",offsetof(OfxParameterSuiteV1,paramGetDerivative));
printf("O OfxParameterSuiteV1.paramGetIntegral %zu\n",offsetof(OfxParameterSuiteV1,paramGetIntegral));
printf("O OfxParameterSuiteV1.paramSetValue %zu\n",offsetof(OfxParameterSuiteV1,paramSetValue));
printf("O OfxParameterSuiteV1.paramSetValueAtTime %zu\n",offsetof(OfxParameterSuiteV1,paramSetValueAtTime));
printf("O OfxParameterSuiteV1.paramGetNumKeys %zu\n",offsetof(OfxParameterSuiteV1,paramGetNumKeys));
printf("O OfxParameterSuiteV1.paramGetKeyTime %zu\n",offsetof(OfxParameterSuiteV1,paramGetKeyTime));
printf("O OfxParameterSuiteV1.paramGetKeyIndex %zu\n",offsetof(OfxParameterSuiteV1,paramGetKeyIndex));
printf("O OfxParameterSuiteV1.paramDeleteKey %zu\n",offsetof(OfxParameterSuiteV1,paramDeleteKey));
printf("O OfxParameterSuiteV1.paramDeleteAllKeys %zu\n",offsetof(OfxParameterSuiteV1,paramDeleteAllKeys));
printf("O OfxParameterSuiteV1.paramCopy %zu\n",offsetof(OfxParameterSuiteV1,paramCopy));
printf("O OfxParameterSuiteV1.paramEditBegin %zu\n",offsetof(OfxParameterSuiteV1,paramEditBegin));
printf("O OfxParameterSuiteV1.paramEditEnd %zu\n",offsetof(OfxParameterSuiteV1,paramEditEnd));
#endif
#ifndef NO_OfxParametricParameterSuiteV1
printf("Z OfxParametricParameterSuiteV1 %zu\n",sizeof(OfxParametricParameterSuiteV1));
printf("O OfxParametricParameterSuiteV1.parametricParamGetValue %zu\n",offsetof(OfxParametricParameterSuiteV1,parametricParamGetValue));
printf("O OfxParametricParameterSuiteV1.parametricParamGetNControlPoints %zu\n",offsetof(OfxParametricParameterSuiteV1,parametricParamGetNControlPoints));
printf("O OfxParametricParameterSuiteV1.parametricParamGetNthControlPoint %zu\n",offsetof(OfxParametricParameterSuiteV1,parametricParamGetNthControlPoint));
printf("O OfxParametricParameterSuiteV1.parametricParamSetNthControlPoint %zu\n",offsetof(OfxParametricParameterSuiteV1,parametricParamSetNthControlPoint));
printf("O OfxParametricParameterSuiteV1.parametricParamAddControlPoint %zu\n",offsetof(OfxParametricParameterSuiteV1,parametricParamAddControlPoint));
printf("O OfxParametricParameterSuiteV1.parametricParamDeleteControlPoint %zu\n",offsetof(OfxParametricParameterSuiteV1,parametricParamDeleteControlPoint));
printf("O OfxParametricParameterSuiteV1.parametricParamDeleteAllControlPoints %zu\n",offsetof(OfxParametricParameterSuiteV1,parametricParamDeleteAllControlPoints));
#endif
#ifndef NO_OfxInteractSuiteV1
printf("Z OfxInteractSuiteV1 %zu\n",sizeof(OfxInteractSuiteV1));
printf("O OfxInteractSuiteV1.interactSwapBuffers %zu\n",offsetof(OfxInteractSuiteV1,interactSwapBuffers));
printf("O OfxInteractSuiteV1.interactRedraw %zu\n",offsetof(OfxInteractSuiteV1,interactRedraw));
printf("O OfxInteractSuiteV1.interactGetPropertySet %zu\n",offsetof(OfxInteractSuiteV1,interactGetPropertySet));
#endif
#ifndef NO_OfxDrawSuiteV1
printf("Z OfxDrawSuiteV1 %zu\n",sizeof(OfxDrawSuiteV1));
printf("O OfxDrawSuiteV1.getColour %zu\n",offsetof(OfxDrawSuiteV1,getColour));
printf("O OfxDrawSuiteV1.setColour %zu\n",offsetof(OfxDrawSuiteV1,setColour));
printf("O OfxDrawSuiteV1.setLineWidth %zu\n",offsetof(OfxDrawSuiteV1,setLineWidth));
printf("O OfxDrawSuiteV1.setLineStipple %zu\n",offsetof(OfxDrawSuiteV1,setLineStipple));
printf("O OfxDrawSuiteV1.draw %zu\n",offsetof(OfxDrawSuiteV1,draw));
printf("O OfxDrawSuiteV1.drawText %zu\n",offsetof(OfxDrawSuiteV1,drawText));
#endif
#ifndef NO_OfxImageEffectSuiteV1
printf("Z OfxImageEffectSuiteV1 %zu\n",sizeof(OfxImageEffectSuiteV1));
printf("O OfxImageEffectSuiteV1.getPropertySet %zu\n",offsetof(OfxImageEffectSuiteV1,getPropertySet));
printf("O OfxImageEffectSuiteV1.getParamSet %zu\n",offsetof(OfxImageEffectSuiteV1,getParamSet));
printf("O OfxImageEffectSuiteV1.clipDefine %zu\n",offsetof(OfxImageEffectSuiteV1,clipDefine));
printf("O OfxImageEffectSuiteV1.clipGetHandle %zu\n",offsetof(OfxImageEffectSuiteV1,clipGetHandle));
printf("O OfxImageEffectSuiteV1.clipGetPropertySet %zu\n",offsetof(OfxImageEffectSuiteV1,clipGetPropertySet));
printf("O OfxImageEffectSuiteV1.clipGetImage %zu\n",offsetof(OfxImageEffectSuiteV1,clipGetImage));
printf("O OfxImageEffectSuiteV1.clipReleaseImage %zu\n",offsetof(OfxImageEffectSuiteV1,clipReleaseImage));
printf("O OfxImageEffectSuiteV1.clipGetRegionOfDefinition %zu\n",offsetof(OfxImageEffectSuiteV1,clipGetRegionOfDefinition));
printf("O OfxImageEffectSuiteV1.abort %zu\n",offsetof(OfxImageEffectSuiteV1,abort));
printf("O OfxImageEffectSuiteV1.imageMemoryAlloc %zu\n",offsetof(OfxImageEffectSuiteV1,imageMemoryAlloc));
printf("O OfxImageEffectSuiteV1.imageMemoryFree %zu\n",offsetof(OfxImageEffectSuiteV1,imageMemoryFree));
printf("O OfxImageEffectSuiteV1.imageMemoryLock %zu\n",offsetof(OfxImageEffectSuiteV1,imageMemoryLock));
printf("O OfxImageEffectSuiteV1.imageMemoryUnlock %zu\n",offsetof(OfxImageEffectSuiteV1,imageMemoryUnlock));
#endif
#ifndef NO_OfxImageEffectOpenGLRenderSuiteV1
printf("Z OfxImageEffectOpenGLRenderSuiteV1 %zu\n",sizeof(OfxImageEffectOpenGLRenderSuiteV1));
printf("O OfxImageEffectOpenGLRenderSuiteV1.clipLoadTexture %zu\n",offsetof(OfxImageEffectOpenGLRenderSuiteV1,clipLoadTexture));
printf("O OfxImageEffectOpenGLRenderSuiteV1.clipFreeTexture %zu\n",offsetof(OfxImageEffectOpenGLRenderSuiteV1,clipFreeTexture));
printf("O OfxImageEffectOpenGLRenderSuiteV1.flushResources %zu\n",offsetof(OfxImageEffectOpenGLRenderSuiteV1,flushResources));
#endif
#ifndef NO_OfxOpenCLProgramSuiteV1
printf("Z OfxOpenCLProgramSuiteV1 %zu\n",sizeof(OfxOpenCLProgramSuiteV1));
printf("O OfxOpenCLProgramSuiteV1.compileProgram %zu\n",offsetof(OfxOpenCLProgramSuiteV1,compileProgram));
#endif
#ifndef NO_OfxDialogSuiteV1
printf("Z OfxDialogSuiteV1 %zu\n",sizeof(OfxDialogSuiteV1));
printf("O OfxDialogSuiteV1.RequestDialog %zu\n",offsetof(OfxDialogSuiteV1,RequestDialog));
printf("O OfxDialogSuiteV1.NotifyRedrawPending %zu\n",offsetof(OfxDialogSuiteV1,NotifyRedrawPending));
#endif
#ifndef NO_OfxRGBAColourB
printf("Z OfxRGBAColourB %zu\n",sizeof(OfxRGBAColourB));
printf("O OfxRGBAColourB.r %zu\n",offsetof(OfxRGBAColourB,r));
printf("O OfxRGBAColourB.g %zu\n",offsetof(OfxRGBAColourB,g));
printf("O OfxRGBAColourB.b %zu\n",offsetof(OfxRGBAColourB,b));
printf("O OfxRGBAColourB.a %zu\n",offsetof(OfxRGBAColourB,a));
#endif
#ifndef NO_OfxRGBAColourS
printf("Z OfxRGBAColourS %zu\n",sizeof(OfxRGBAColourS));
printf("O OfxRGBAColourS.r %zu\n",offsetof(OfxRGBAColourS,r));
printf("O OfxRGBAColourS.g %zu\n",offsetof(OfxRGBAColourS,g));
printf("O OfxRGBAColourS.b %zu\n",offsetof(OfxRGBAColourS,b));
printf("O OfxRGBAColourS.a %zu\n",offsetof(OfxRGBAColourS,a));
#endif
#ifndef NO_OfxRGBAColourF
printf("Z OfxRGBAColourF %zu\n",sizeof(OfxRGBAColourF));
printf("O OfxRGBAColourF.r %zu\n",offsetof(OfxRGBAColourF,r));
printf("O OfxRGBAColourF.g %zu\n",offsetof(OfxRGBAColourF,g));
printf("O OfxRGBAColourF.b %zu\n",offsetof(OfxRGBAColourF,b));
printf("O OfxRGBAColourF.a %zu\n",offsetof(OfxRGBAColourF,a));
#endif
#ifndef NO_OfxRGBAColourD
printf("Z OfxRGBAColourD %zu\n",sizeof(OfxRGBAColourD));
printf("O OfxRGBAColourD.r %zu\n",offsetof(OfxRGBAColourD,r));
printf("O OfxRGBAColourD.g %zu\n",offsetof(OfxRGBAColourD,g));
printf("O OfxRGBAColourD.b %zu\n",offsetof(OfxRGBAColourD,b));
printf("O OfxRGBAColourD.a %zu\n",offsetof(OfxRGBAColourD,a));
#endif
#ifndef NO_OfxRGBColourB
printf("Z OfxRGBColourB %zu\n",sizeof(OfxRGBColourB));
printf("O OfxRGBColourB.r %zu\n",offsetof(OfxRGBColourB,r));
printf("O OfxRGBColourB.g %zu\n",offsetof(OfxRGBColourB,g));
printf("O OfxRGBColourB.b %zu\n",offsetof(OfxRGBColourB,b));
#endif
#ifndef NO_OfxRGBColourS
printf("Z OfxRGBColourS %zu\n",sizeof(OfxRGBColourS));
printf("O OfxRGBColourS.r %zu\n",offsetof(OfxRGBColourS,r));
printf("O OfxRGBColourS.g %zu\n",offsetof(OfxRGBColourS,g));
printf("O OfxRGBColourS.b %zu\n",offsetof(OfxRGBColourS,b));
#endif
#ifndef NO_OfxRGBColourF
printf("Z OfxRGBColourF %zu\n",sizeof(OfxRGBColourF));
printf("O OfxRGBColourF.r %zu\n",offsetof(OfxRGBColourF,r));
printf("O OfxRGBColourF.g %zu\n",offsetof(OfxRGBColourF,g));
printf("O OfxRGBColourF.b %zu\n",offsetof(OfxRGBColourF,b));
#endif
#ifndef NO_OfxRGBColourD
printf("Z OfxRGBColourD %zu\n",sizeof(OfxRGBColourD));
printf("O OfxRGBColourD.r %zu\n",offsetof(OfxRGBColourD,r));
printf("O OfxRGBColourD.g %zu\n",offsetof(OfxRGBColourD,g));
printf("O OfxRGBColourD.b %zu\n",offsetof(OfxRGBColourD,b));
#endif
return 0;}
