/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Time line suite: where the user is in time. Not for rendering, which has its own time. */

#ifndef WO_OFX_TIME_LINE_H
#define WO_OFX_TIME_LINE_H

#include "ofxCore.h"

#ifdef __cplusplus
extern "C" {
#endif

#define kOfxTimeLineSuite "OfxTimeLineSuite"

/* Version 1. `instance` is an OfxImageEffectHandle. */
typedef struct OfxTimeLineSuiteV1 {
    OfxStatus (*getTime)(void *instance, double *time);
    OfxStatus (*gotoTime)(void *instance, double time);
    OfxStatus (*getTimeBounds)(void *instance, double *firstTime, double *lastTime);
} OfxTimeLineSuiteV1;

#ifdef __cplusplus
}
#endif

#endif
