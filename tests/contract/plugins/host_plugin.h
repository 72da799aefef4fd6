/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TEST_HOST_PLUGIN_H
#define WO_TEST_HOST_PLUGIN_H

/* What the test plugins of the host share: suites and short ways to them. One copy for each plugin.
 */

#include "ofxCore.h"
#include "ofxImageEffect.h"
#include "ofxMemory.h"
#include "ofxMessage.h"
#include "ofxMultiThread.h"
#include "ofxProgress.h"
#include "ofxTimeLine.h"
#include "wideopen/ofx_report.h"

#include <stdbool.h>
#include <stddef.h>

static struct {
    const OfxHost *host;
    const OfxPropertySuiteV1 *prop;
    const OfxImageEffectSuiteV1 *effect;
    const OfxParameterSuiteV1 *param;
    const OfxMemorySuiteV1 *memory;
    const OfxMultiThreadSuiteV1 *thread;
    const OfxMessageSuiteV2 *message;
    const OfxProgressSuiteV2 *progress;
    const OfxTimeLineSuiteV1 *timeline;
    const WideOpenReportSuiteV1 *report;
} ofx;

static inline const void *ofx_fetch(const char *name, int version)
{
    return ofx.host->fetchSuite(ofx.host->host, name, version);
}

static inline bool ofx_load(void)
{
    ofx.prop = ofx_fetch(kOfxPropertySuite, 1);
    ofx.effect = ofx_fetch(kOfxImageEffectSuite, 1);
    ofx.param = ofx_fetch(kOfxParameterSuite, 1);
    ofx.memory = ofx_fetch(kOfxMemorySuite, 1);
    ofx.thread = ofx_fetch(kOfxMultiThreadSuite, 1);
    ofx.message = ofx_fetch(kOfxMessageSuite, 2);
    ofx.progress = ofx_fetch(kOfxProgressSuite, 2);
    ofx.timeline = ofx_fetch(kOfxTimeLineSuite, 1);
    ofx.report = ofx_fetch(kWideOpenReportSuite, 1);
    return ofx.prop && ofx.effect && ofx.param && ofx.memory && ofx.thread && ofx.message &&
           ofx.progress && ofx.timeline && ofx.report;
}

/* An image as the plugin sees it. */
typedef struct picture {
    OfxPropertySetHandle handle;
    float *data;
    OfxRectI bounds;
    int row_bytes;
    int components;
} picture;

static inline float *picture_at(const picture *p, int x, int y)
{
    return (float *)((char *)p->data + (ptrdiff_t)(y - p->bounds.y1) * p->row_bytes) +
           (ptrdiff_t)(x - p->bounds.x1) * p->components;
}

static inline OfxImageClipHandle clip_of(OfxImageEffectHandle effect, const char *name)
{
    OfxImageClipHandle clip = NULL;
    ofx.effect->clipGetHandle(effect, name, &clip, NULL);
    return clip;
}

static inline OfxStatus picture_get(OfxImageClipHandle clip, double time, const OfxRectD *region,
                                    picture *p)
{
    void *data = NULL;
    char *text = NULL;
    *p = (picture){0};
    const OfxStatus status = ofx.effect->clipGetImage(clip, time, region, &p->handle);
    if (status != kOfxStatOK)
        return status;
    ofx.prop->propGetPointer(p->handle, kOfxImagePropData, 0, &data);
    ofx.prop->propGetIntN(p->handle, kOfxImagePropBounds, 4, &p->bounds.x1);
    ofx.prop->propGetInt(p->handle, kOfxImagePropRowBytes, 0, &p->row_bytes);
    ofx.prop->propGetString(p->handle, kOfxImageEffectPropComponents, 0, &text);
    p->data = data;
    p->components = text[17] == 'A' ? 1 : text[20] == 'A' ? 4 : 3; /* behind OfxImageComponent */
    return kOfxStatOK;
}

static inline OfxPropertySetHandle props_of(OfxImageEffectHandle effect)
{
    OfxPropertySetHandle props = NULL;
    ofx.effect->getPropertySet(effect, &props);
    return props;
}

static inline OfxParamSetHandle params_of(OfxImageEffectHandle effect)
{
    OfxParamSetHandle params = NULL;
    ofx.effect->getParamSet(effect, &params);
    return params;
}

static inline OfxParamHandle param_of(OfxImageEffectHandle effect, const char *name)
{
    OfxParamHandle param = NULL;
    ofx.param->paramGetHandle(params_of(effect), name, &param, NULL);
    return param;
}

static inline OfxPropertySetHandle define_param(OfxImageEffectHandle effect, const char *type,
                                                const char *name)
{
    OfxPropertySetHandle props = NULL;
    ofx.param->paramDefine(params_of(effect), type, name, &props);
    return props;
}

static inline OfxPropertySetHandle define_clip(OfxImageEffectHandle effect, const char *name,
                                               bool optional)
{
    OfxPropertySetHandle props = NULL;
    ofx.effect->clipDefine(effect, name, &props);
    ofx.prop->propSetInt(props, kOfxImageClipPropOptional, 0, optional);
    return props;
}

#endif
