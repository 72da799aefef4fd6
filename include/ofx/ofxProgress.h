/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Progress suite: a progress bar for long work outside rendering. */

#ifndef WO_OFX_PROGRESS_H
#define WO_OFX_PROGRESS_H

#include "ofxCore.h"

#ifdef __cplusplus
extern "C" {
#endif

#define kOfxProgressSuite "OfxProgressSuite"

/* Version 1. effectInstance is an OfxImageEffectHandle; one bar at a time for each instance.
 * progressUpdate takes 0..1 and answers kOfxStatOK to go on, kOfxStatReplyNo to stop. */
typedef struct OfxProgressSuiteV1 {
    OfxStatus (*progressStart)(void *effectInstance, const char *label);
    OfxStatus (*progressUpdate)(void *effectInstance, double progress);
    OfxStatus (*progressEnd)(void *effectInstance);
} OfxProgressSuiteV1;

/* Version 2: as version 1, and messageid may name the message for translation. */
typedef struct OfxProgressSuiteV2 {
    OfxStatus (*progressStart)(void *effectInstance, const char *message, const char *messageid);
    OfxStatus (*progressUpdate)(void *effectInstance, double progress);
    OfxStatus (*progressEnd)(void *effectInstance);
} OfxProgressSuiteV2;

#ifdef __cplusplus
}
#endif

#endif
