/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WIDEOPEN_OFX_REPORT_H
#define WIDEOPEN_OFX_REPORT_H

/* A suite of our own, by which a host may ask our plugins what a render did. OpenFX lets hosts
   offer suites of their own; a host without this one answers NULL and nothing is reported.
   fetchSuite(host, kWideOpenReportSuite, 1). */
#define kWideOpenReportSuite "org.wideopen.ReportSuite"

typedef enum WideOpenReportMode {
    kWideOpenReportNone = 0,
    kWideOpenReportRender = 1, /* render, then publish kind "report": JSON of wo_report_json */
    kWideOpenReportExplain = 2 /* make the plan, publish kind "plan": text; render nothing */
} WideOpenReportMode;

typedef struct WideOpenReportSuiteV1 {
    /* effect: the OfxImageEffectHandle of the instance. Any thread, during the render action. */
    int (*mode)(void *effect);
    /* In both modes warnings may come first, each as kind "warning", text "KEY: what was found". */
    int (*publish)(void *effect, const char *kind, const char *text); /* text is copied; 0 = ok */
} WideOpenReportSuiteV1;

#endif
