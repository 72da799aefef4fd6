/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_FOOTAGE_BUILD_PRIVATE_H
#define WO_FOOTAGE_BUILD_PRIVATE_H

#include "build.h"

/* What the parts of the builder share. */

/* A copy that belongs to the scene; NULL after a failure. */
void *wo_build_copy(wo_builder *b, const void *from, size_t count, size_t size);

/* Own coordinates of a thing to the world. */
wo_affine wo_pose_matrix(const wo_pose *pose);

/* Takes the next shape; its texture sits in the frame to_world. NULL after a failure. */
wo_shape *wo_build_shape(wo_builder *b, wo_shape_kind kind, const wo_texture *texture,
                         const wo_affine *to_world);

/* Puts a point into the first three floats of out. */
void wo_build_place(const wo_affine *to_camera, wo_vec p, float out[4]);

/* Makes the map of a filled shape and hands its geometry to the ray caster. */
void wo_build_finish(wo_builder *b, wo_shape *s, int kind);

#endif
