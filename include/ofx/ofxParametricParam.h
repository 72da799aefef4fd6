/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Parametric parameters: curves over a position, one or more of them in one parameter, edited by
 * the user through control points. */

#ifndef WO_OFX_PARAMETRIC_PARAM_H
#define WO_OFX_PARAMETRIC_PARAM_H

#include <stdbool.h>

#include "ofxCore.h"
#include "ofxParam.h"

#ifdef __cplusplus
extern "C" {
#endif

#define kOfxParametricParameterSuite "OfxParametricParameterSuite"

/* Type name for OfxParameterSuiteV1.paramDefine. */
#define kOfxParamTypeParametric "OfxParamTypeParametric"

/* int: number of curves. */
#define kOfxParamPropParametricDimension "OfxParamPropParametricDimension"

/* double xN: r, g, b of each curve, curve after curve. */
#define kOfxParamPropParametricUIColour "OfxParamPropParametricUIColour"

/* pointer: OfxPluginEntryPoint of an interact drawn behind the curves, or NULL. */
#define kOfxParamPropParametricInteractBackground "OfxParamPropParametricInteractBackground"

/* int 0/1, host: curves can be animated. */
#define kOfxParamHostPropSupportsParametricAnimation "OfxParamHostPropSupportsParametricAnimation"

/* double x2: first and last position. */
#define kOfxParamPropParametricRange "OfxParamPropParametricRange"

/* Version 1. `param` may be the descriptor's handle while the plugin describes itself, which sets
 * the default curves. Curves and control points count from 0; addAnimationKey asks for a key at
 * `time`. */
typedef struct OfxParametricParameterSuiteV1 {
    OfxStatus (*parametricParamGetValue)(OfxParamHandle param, int curveIndex, OfxTime time,
                                         double parametricPosition, double *returnValue);
    OfxStatus (*parametricParamGetNControlPoints)(OfxParamHandle param, int curveIndex, double time,
                                                  int *returnValue);
    OfxStatus (*parametricParamGetNthControlPoint)(OfxParamHandle param, int curveIndex,
                                                   double time, int nthCtl, double *key,
                                                   double *value);
    OfxStatus (*parametricParamSetNthControlPoint)(OfxParamHandle param, int curveIndex,
                                                   double time, int nthCtl, double key,
                                                   double value, bool addAnimationKey);
    OfxStatus (*parametricParamAddControlPoint)(OfxParamHandle param, int curveIndex, double time,
                                                double key, double value, bool addAnimationKey);
    OfxStatus (*parametricParamDeleteControlPoint)(OfxParamHandle param, int curveIndex,
                                                   int nthCtl);
    OfxStatus (*parametricParamDeleteAllControlPoints)(OfxParamHandle param, int curveIndex);
} OfxParametricParameterSuiteV1;

#ifdef __cplusplus
}
#endif

#endif
