/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_HOST_SUITES_H
#define WO_HOST_SUITES_H

#include "internal.h"

#include "ofxMemory.h"
#include "ofxMessage.h"
#include "ofxMultiThread.h"
#include "ofxProgress.h"
#include "ofxTimeLine.h"
#include "wideopen/ofx_report.h"

/* Tables plugins get; their functions are called from any thread, with anything as arguments. */
extern const OfxPropertySuiteV1 wo_property_suite;
extern const OfxImageEffectSuiteV1 wo_effect_suite;
extern const OfxParameterSuiteV1 wo_parameter_suite;
extern const OfxMemorySuiteV1 wo_memory_suite;
extern const OfxMultiThreadSuiteV1 wo_thread_suite;
extern const OfxMessageSuiteV1 wo_message_suite_1;
extern const OfxMessageSuiteV2 wo_message_suite_2;
extern const OfxProgressSuiteV1 wo_progress_suite_1;
extern const OfxProgressSuiteV2 wo_progress_suite_2;
extern const OfxTimeLineSuiteV1 wo_timeline_suite;
extern const WideOpenReportSuiteV1 wo_report_suite;

/* Members of wo_effect_suite that live in memory.c. */
OfxStatus wo_image_memory_alloc(OfxImageEffectHandle effect, size_t bytes,
                                OfxImageMemoryHandle *memory);
OfxStatus wo_image_memory_free(OfxImageMemoryHandle memory);
OfxStatus wo_image_memory_lock(OfxImageMemoryHandle memory, void **data);
OfxStatus wo_image_memory_unlock(OfxImageMemoryHandle memory);

#endif
