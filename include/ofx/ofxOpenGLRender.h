/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* The old name of ofxGPURender.h. */

#ifndef WO_OFX_OPENGL_RENDER_H
#define WO_OFX_OPENGL_RENDER_H

#include "ofxGPURender.h"

#endif
