/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Dialog suite: a plugin asks the host for a safe moment to open a window of its own. */

#ifndef WO_OFX_DIALOG_H
#define WO_OFX_DIALOG_H

#include "ofxCore.h"

#ifdef __cplusplus
extern "C" {
#endif

#define kOfxDialogSuite "OfxDialogSuite"

/* Sent after RequestDialog, when the plugin may open its window. */
#define kOfxActionDialog "OfxActionDialog"

/* Version 1. user_data belongs to the plugin; the host does not look inside. */
typedef struct OfxDialogSuiteV1 {
    OfxStatus (*RequestDialog)(void *user_data);
    OfxStatus (*NotifyRedrawPending)(void);
} OfxDialogSuiteV1;

#ifdef __cplusplus
}
#endif

#endif
