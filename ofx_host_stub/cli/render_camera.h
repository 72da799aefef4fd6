/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_RENDER_CAMERA_H
#define WO_CLI_RENDER_CAMERA_H

#include "render_job.h"

/* The camera that a picture's metadata names: the host passes it on, the plugin uses it. */

/* Writes into own, separated by blanks, the keys of the camera's parameters that --set names. */
void wo_camera_own(const wo_args *args, char *own, size_t size);

/* Lets the plugin take the camera from the metadata, if it can and --set cameraFrom does not say
   otherwise. */
void wo_camera_choose(wo_render_job *job);

/* Says which values the metadata of the present Source gives, and which it cannot. */
void wo_camera_tell(const wo_render_job *job);

#endif
