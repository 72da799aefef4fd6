/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_PLUGINS_OFX_SUITES_H
#define WO_PLUGINS_OFX_SUITES_H

#include "ofx/ofxCore.h"
#include "ofx/ofxDrawSuite.h"
#include "ofx/ofxImageEffect.h"
#include "ofx/ofxInteract.h"
#include "ofx/ofxMemory.h"
#include "ofx/ofxMessage.h"
#include "ofx/ofxMultiThread.h"
#include "ofx/ofxParam.h"
#include "ofx/ofxProgress.h"
#include "ofx/ofxProperty.h"
#include "wideopen/ofx_report.h"
#include "wideopen/status.h"

/* What a host offers, fetched once in the Load action and only read afterwards. property, effect
   and param are there and have every function the glue calls; the others are NULL, or lack
   functions, where the host does. The tables belong to the host. */
typedef struct wo_ofx_suites {
    OfxPropertySetHandle host;
    const OfxPropertySuiteV1 *property;
    const OfxImageEffectSuiteV1 *effect;
    const OfxParameterSuiteV1 *param;
    const OfxMemorySuiteV1 *memory;
    const OfxMultiThreadSuiteV1 *thread;
    const OfxMessageSuiteV1 *message;
    const OfxMessageSuiteV2 *message2;
    const OfxProgressSuiteV1 *progress;
    const OfxProgressSuiteV2 *progress2;
    const OfxInteractSuiteV1 *interact;
    const OfxDrawSuiteV1 *draw;
    const WideOpenReportSuiteV1 *report;
} wo_ofx_suites;

/* Fills *suites; kOfxStatErrMissingHostFeature, and *suites empty, where the host lacks what the
   glue cannot do without. Host thread only. */
OfxStatus wo_ofx_fetch_suites(const OfxHost *host, wo_ofx_suites *suites);

/* The one place where statuses of the core become statuses of OpenFX. */
OfxStatus wo_ofx_status(wo_status status);

/* Reading properties. A property that is missing, short, or of another type is no failure: the get
   functions answer the fallback, the read functions false with *values untouched. NULL sets are
   legal and hold nothing. Strings belong to the host and live as long as the property keeps its
   value. Any thread. */
int wo_ofx_get_int(const wo_ofx_suites *suites, OfxPropertySetHandle set, const char *name,
                   int fallback);
double wo_ofx_get_double(const wo_ofx_suites *suites, OfxPropertySetHandle set, const char *name,
                         double fallback);
const char *wo_ofx_get_string(const wo_ofx_suites *suites, OfxPropertySetHandle set,
                              const char *name);
void *wo_ofx_get_pointer(const wo_ofx_suites *suites, OfxPropertySetHandle set, const char *name);
bool wo_ofx_read_ints(const wo_ofx_suites *suites, OfxPropertySetHandle set, const char *name,
                      int count, int *values);
bool wo_ofx_read_doubles(const wo_ofx_suites *suites, OfxPropertySetHandle set, const char *name,
                         int count, double *values);

/* Whether string property name of the set has this value at any index. */
bool wo_ofx_has_string(const wo_ofx_suites *suites, OfxPropertySetHandle set, const char *name,
                       const char *value);

/* Writing properties. The answer is that of the host. */
OfxStatus wo_ofx_set_int(const wo_ofx_suites *suites, OfxPropertySetHandle set, const char *name,
                         int index, int value);
OfxStatus wo_ofx_set_double(const wo_ofx_suites *suites, OfxPropertySetHandle set, const char *name,
                            int index, double value);
OfxStatus wo_ofx_set_string(const wo_ofx_suites *suites, OfxPropertySetHandle set, const char *name,
                            int index, const char *value);

#endif
