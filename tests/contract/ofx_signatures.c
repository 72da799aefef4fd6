/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* The signature of every function of every suite in our OpenFX headers. Sizes and offsets, which
   ofx_abi_dump.c compares, do not see a wrong argument; a compiler that takes this file does. */

#include "ofxCore.h"
#include "ofxDialog.h"
#include "ofxDrawSuite.h"
#include "ofxGPURender.h"
#include "ofxImageEffect.h"
#include "ofxInteract.h"
#include "ofxMemory.h"
#include "ofxMessage.h"
#include "ofxMultiThread.h"
#include "ofxParam.h"
#include "ofxParametricParam.h"
#include "ofxProgress.h"
#include "ofxProperty.h"
#include "ofxTimeLine.h"

#include <stdbool.h>
#include <stddef.h>

/* The member of the suite points to a function with this result and these arguments. */
#define SIGNATURE(suite, member, result, ...)                                                      \
    _Static_assert(_Generic(((const suite *)0)->member, result(*)(__VA_ARGS__) : 1, default : 0),  \
                   #suite "." #member)

/* A pointer to the type is a pointer like this. */
#define POINTER(type, pointer)                                                                     \
    _Static_assert(_Generic((type *)0, pointer : 1, default : 0), #type " is not " #pointer)

POINTER(OfxStatus, int *);
POINTER(OfxTime, double *);
POINTER(OfxPluginEntryPoint,
        OfxStatus (*)(const char *, const void *, OfxPropertySetHandle, OfxPropertySetHandle));
POINTER(OfxThreadFunctionV1, void (*)(unsigned int, unsigned int, void *));
POINTER(OfxCustomParamInterpFuncV1,
        OfxStatus (*)(OfxParamSetHandle, OfxPropertySetHandle, OfxPropertySetHandle));

SIGNATURE(OfxHost, fetchSuite, const void *, OfxPropertySetHandle, const char *, int);
SIGNATURE(OfxPlugin, setHost, void, OfxHost *);
SIGNATURE(OfxPlugin, mainEntry, OfxStatus, const char *, const void *, OfxPropertySetHandle,
          OfxPropertySetHandle);

SIGNATURE(OfxPropertySuiteV1, propSetPointer, OfxStatus, OfxPropertySetHandle, const char *, int,
          void *);
SIGNATURE(OfxPropertySuiteV1, propSetString, OfxStatus, OfxPropertySetHandle, const char *, int,
          const char *);
SIGNATURE(OfxPropertySuiteV1, propSetDouble, OfxStatus, OfxPropertySetHandle, const char *, int,
          double);
SIGNATURE(OfxPropertySuiteV1, propSetInt, OfxStatus, OfxPropertySetHandle, const char *, int, int);
SIGNATURE(OfxPropertySuiteV1, propSetPointerN, OfxStatus, OfxPropertySetHandle, const char *, int,
          void *const *);
SIGNATURE(OfxPropertySuiteV1, propSetStringN, OfxStatus, OfxPropertySetHandle, const char *, int,
          const char *const *);
SIGNATURE(OfxPropertySuiteV1, propSetDoubleN, OfxStatus, OfxPropertySetHandle, const char *, int,
          const double *);
SIGNATURE(OfxPropertySuiteV1, propSetIntN, OfxStatus, OfxPropertySetHandle, const char *, int,
          const int *);
SIGNATURE(OfxPropertySuiteV1, propGetPointer, OfxStatus, OfxPropertySetHandle, const char *, int,
          void **);
SIGNATURE(OfxPropertySuiteV1, propGetString, OfxStatus, OfxPropertySetHandle, const char *, int,
          char **);
SIGNATURE(OfxPropertySuiteV1, propGetDouble, OfxStatus, OfxPropertySetHandle, const char *, int,
          double *);
SIGNATURE(OfxPropertySuiteV1, propGetInt, OfxStatus, OfxPropertySetHandle, const char *, int,
          int *);
SIGNATURE(OfxPropertySuiteV1, propGetPointerN, OfxStatus, OfxPropertySetHandle, const char *, int,
          void **);
SIGNATURE(OfxPropertySuiteV1, propGetStringN, OfxStatus, OfxPropertySetHandle, const char *, int,
          char **);
SIGNATURE(OfxPropertySuiteV1, propGetDoubleN, OfxStatus, OfxPropertySetHandle, const char *, int,
          double *);
SIGNATURE(OfxPropertySuiteV1, propGetIntN, OfxStatus, OfxPropertySetHandle, const char *, int,
          int *);
SIGNATURE(OfxPropertySuiteV1, propReset, OfxStatus, OfxPropertySetHandle, const char *);
SIGNATURE(OfxPropertySuiteV1, propGetDimension, OfxStatus, OfxPropertySetHandle, const char *,
          int *);

SIGNATURE(OfxImageEffectSuiteV1, getPropertySet, OfxStatus, OfxImageEffectHandle,
          OfxPropertySetHandle *);
SIGNATURE(OfxImageEffectSuiteV1, getParamSet, OfxStatus, OfxImageEffectHandle, OfxParamSetHandle *);
SIGNATURE(OfxImageEffectSuiteV1, clipDefine, OfxStatus, OfxImageEffectHandle, const char *,
          OfxPropertySetHandle *);
SIGNATURE(OfxImageEffectSuiteV1, clipGetHandle, OfxStatus, OfxImageEffectHandle, const char *,
          OfxImageClipHandle *, OfxPropertySetHandle *);
SIGNATURE(OfxImageEffectSuiteV1, clipGetPropertySet, OfxStatus, OfxImageClipHandle,
          OfxPropertySetHandle *);
SIGNATURE(OfxImageEffectSuiteV1, clipGetImage, OfxStatus, OfxImageClipHandle, OfxTime,
          const OfxRectD *, OfxPropertySetHandle *);
SIGNATURE(OfxImageEffectSuiteV1, clipReleaseImage, OfxStatus, OfxPropertySetHandle);
SIGNATURE(OfxImageEffectSuiteV1, clipGetRegionOfDefinition, OfxStatus, OfxImageClipHandle, OfxTime,
          OfxRectD *);
SIGNATURE(OfxImageEffectSuiteV1, abort, int, OfxImageEffectHandle);
SIGNATURE(OfxImageEffectSuiteV1, imageMemoryAlloc, OfxStatus, OfxImageEffectHandle, size_t,
          OfxImageMemoryHandle *);
SIGNATURE(OfxImageEffectSuiteV1, imageMemoryFree, OfxStatus, OfxImageMemoryHandle);
SIGNATURE(OfxImageEffectSuiteV1, imageMemoryLock, OfxStatus, OfxImageMemoryHandle, void **);
SIGNATURE(OfxImageEffectSuiteV1, imageMemoryUnlock, OfxStatus, OfxImageMemoryHandle);

SIGNATURE(OfxMemorySuiteV1, memoryAlloc, OfxStatus, void *, size_t, void **);
SIGNATURE(OfxMemorySuiteV1, memoryFree, OfxStatus, void *);

SIGNATURE(OfxMultiThreadSuiteV1, multiThread, OfxStatus, OfxThreadFunctionV1, unsigned int, void *);
SIGNATURE(OfxMultiThreadSuiteV1, multiThreadNumCPUs, OfxStatus, unsigned int *);
SIGNATURE(OfxMultiThreadSuiteV1, multiThreadIndex, OfxStatus, unsigned int *);
SIGNATURE(OfxMultiThreadSuiteV1, multiThreadIsSpawnedThread, int, void);
SIGNATURE(OfxMultiThreadSuiteV1, mutexCreate, OfxStatus, OfxMutexHandle *, int);
SIGNATURE(OfxMultiThreadSuiteV1, mutexDestroy, OfxStatus, OfxMutexHandle);
SIGNATURE(OfxMultiThreadSuiteV1, mutexLock, OfxStatus, OfxMutexHandle);
SIGNATURE(OfxMultiThreadSuiteV1, mutexUnLock, OfxStatus, OfxMutexHandle);
SIGNATURE(OfxMultiThreadSuiteV1, mutexTryLock, OfxStatus, OfxMutexHandle);

SIGNATURE(OfxMessageSuiteV1, message, OfxStatus, void *, const char *, const char *, const char *,
          ...);

SIGNATURE(OfxMessageSuiteV2, message, OfxStatus, void *, const char *, const char *, const char *,
          ...);
SIGNATURE(OfxMessageSuiteV2, setPersistentMessage, OfxStatus, void *, const char *, const char *,
          const char *, ...);
SIGNATURE(OfxMessageSuiteV2, clearPersistentMessage, OfxStatus, void *);

SIGNATURE(OfxProgressSuiteV1, progressStart, OfxStatus, void *, const char *);
SIGNATURE(OfxProgressSuiteV1, progressUpdate, OfxStatus, void *, double);
SIGNATURE(OfxProgressSuiteV1, progressEnd, OfxStatus, void *);

SIGNATURE(OfxProgressSuiteV2, progressStart, OfxStatus, void *, const char *, const char *);
SIGNATURE(OfxProgressSuiteV2, progressUpdate, OfxStatus, void *, double);
SIGNATURE(OfxProgressSuiteV2, progressEnd, OfxStatus, void *);

SIGNATURE(OfxTimeLineSuiteV1, getTime, OfxStatus, void *, double *);
SIGNATURE(OfxTimeLineSuiteV1, gotoTime, OfxStatus, void *, double);
SIGNATURE(OfxTimeLineSuiteV1, getTimeBounds, OfxStatus, void *, double *, double *);

SIGNATURE(OfxParameterSuiteV1, paramDefine, OfxStatus, OfxParamSetHandle, const char *,
          const char *, OfxPropertySetHandle *);
SIGNATURE(OfxParameterSuiteV1, paramGetHandle, OfxStatus, OfxParamSetHandle, const char *,
          OfxParamHandle *, OfxPropertySetHandle *);
SIGNATURE(OfxParameterSuiteV1, paramSetGetPropertySet, OfxStatus, OfxParamSetHandle,
          OfxPropertySetHandle *);
SIGNATURE(OfxParameterSuiteV1, paramGetPropertySet, OfxStatus, OfxParamHandle,
          OfxPropertySetHandle *);
SIGNATURE(OfxParameterSuiteV1, paramGetValue, OfxStatus, OfxParamHandle, ...);
SIGNATURE(OfxParameterSuiteV1, paramGetValueAtTime, OfxStatus, OfxParamHandle, OfxTime, ...);
SIGNATURE(OfxParameterSuiteV1, paramGetDerivative, OfxStatus, OfxParamHandle, OfxTime, ...);
SIGNATURE(OfxParameterSuiteV1, paramGetIntegral, OfxStatus, OfxParamHandle, OfxTime, OfxTime, ...);
SIGNATURE(OfxParameterSuiteV1, paramSetValue, OfxStatus, OfxParamHandle, ...);
SIGNATURE(OfxParameterSuiteV1, paramSetValueAtTime, OfxStatus, OfxParamHandle, OfxTime, ...);
SIGNATURE(OfxParameterSuiteV1, paramGetNumKeys, OfxStatus, OfxParamHandle, unsigned int *);
SIGNATURE(OfxParameterSuiteV1, paramGetKeyTime, OfxStatus, OfxParamHandle, unsigned int, OfxTime *);
SIGNATURE(OfxParameterSuiteV1, paramGetKeyIndex, OfxStatus, OfxParamHandle, OfxTime, int, int *);
SIGNATURE(OfxParameterSuiteV1, paramDeleteKey, OfxStatus, OfxParamHandle, OfxTime);
SIGNATURE(OfxParameterSuiteV1, paramDeleteAllKeys, OfxStatus, OfxParamHandle);
SIGNATURE(OfxParameterSuiteV1, paramCopy, OfxStatus, OfxParamHandle, OfxParamHandle, OfxTime,
          const OfxRangeD *);
SIGNATURE(OfxParameterSuiteV1, paramEditBegin, OfxStatus, OfxParamSetHandle, const char *);
SIGNATURE(OfxParameterSuiteV1, paramEditEnd, OfxStatus, OfxParamSetHandle);

SIGNATURE(OfxParametricParameterSuiteV1, parametricParamGetValue, OfxStatus, OfxParamHandle, int,
          OfxTime, double, double *);
SIGNATURE(OfxParametricParameterSuiteV1, parametricParamGetNControlPoints, OfxStatus,
          OfxParamHandle, int, double, int *);
SIGNATURE(OfxParametricParameterSuiteV1, parametricParamGetNthControlPoint, OfxStatus,
          OfxParamHandle, int, double, int, double *, double *);
SIGNATURE(OfxParametricParameterSuiteV1, parametricParamSetNthControlPoint, OfxStatus,
          OfxParamHandle, int, double, int, double, double, bool);
SIGNATURE(OfxParametricParameterSuiteV1, parametricParamAddControlPoint, OfxStatus, OfxParamHandle,
          int, double, double, double, bool);
SIGNATURE(OfxParametricParameterSuiteV1, parametricParamDeleteControlPoint, OfxStatus,
          OfxParamHandle, int, int);
SIGNATURE(OfxParametricParameterSuiteV1, parametricParamDeleteAllControlPoints, OfxStatus,
          OfxParamHandle, int);

SIGNATURE(OfxInteractSuiteV1, interactSwapBuffers, OfxStatus, OfxInteractHandle);
SIGNATURE(OfxInteractSuiteV1, interactRedraw, OfxStatus, OfxInteractHandle);
SIGNATURE(OfxInteractSuiteV1, interactGetPropertySet, OfxStatus, OfxInteractHandle,
          OfxPropertySetHandle *);

SIGNATURE(OfxDrawSuiteV1, getColour, OfxStatus, OfxDrawContextHandle, OfxStandardColour,
          OfxRGBAColourF *);
SIGNATURE(OfxDrawSuiteV1, setColour, OfxStatus, OfxDrawContextHandle, const OfxRGBAColourF *);
SIGNATURE(OfxDrawSuiteV1, setLineWidth, OfxStatus, OfxDrawContextHandle, float);
SIGNATURE(OfxDrawSuiteV1, setLineStipple, OfxStatus, OfxDrawContextHandle,
          OfxDrawLineStipplePattern);
SIGNATURE(OfxDrawSuiteV1, draw, OfxStatus, OfxDrawContextHandle, OfxDrawPrimitive,
          const OfxPointD *, int);
SIGNATURE(OfxDrawSuiteV1, drawText, OfxStatus, OfxDrawContextHandle, const char *,
          const OfxPointD *, int);

SIGNATURE(OfxImageEffectOpenGLRenderSuiteV1, clipLoadTexture, OfxStatus, OfxImageClipHandle,
          OfxTime, const char *, const OfxRectD *, OfxPropertySetHandle *);
SIGNATURE(OfxImageEffectOpenGLRenderSuiteV1, clipFreeTexture, OfxStatus, OfxPropertySetHandle);
SIGNATURE(OfxImageEffectOpenGLRenderSuiteV1, flushResources, OfxStatus, void);

SIGNATURE(OfxOpenCLProgramSuiteV1, compileProgram, OfxStatus, const char *, int, void *);

SIGNATURE(OfxDialogSuiteV1, RequestDialog, OfxStatus, void *);
SIGNATURE(OfxDialogSuiteV1, NotifyRedrawPending, OfxStatus, void);

/* The three functions every plugin exports. */
_Static_assert(_Generic(&OfxGetNumberOfPlugins, int (*)(void) : 1, default : 0), "exports");
_Static_assert(_Generic(&OfxGetPlugin, OfxPlugin *(*)(int) : 1, default : 0), "exports");
_Static_assert(_Generic(&OfxSetHost, OfxStatus (*)(const OfxHost *) : 1, default : 0), "exports");

/* Whoever compiles this has run the test. */
int main(void)
{
    return 0;
}
