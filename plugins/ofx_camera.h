/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_PLUGINS_OFX_CAMERA_H
#define WO_PLUGINS_OFX_CAMERA_H

#include "ofx_instance.h"

/* Fills the camera of the action's geometry from what the host says of Source and of the clips of
   data, in this order (wideopen/ofx_camera.h); hosts that say nothing leave it empty. Does not
   fail. */
void wo_ofx_read_camera(wo_ofx_action *action);

#endif
