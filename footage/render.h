/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_FOOTAGE_RENDER_H
#define WO_FOOTAGE_RENDER_H

#include "camera.h"
#include "footage.h"
#include "random.h"
#include "scene.h"
#include "worker.h"

/* The two ways of looking at a lit scene. footage has its images, all zero; both are stages of
   progress. */

/* Pinhole, depth, normals, layers. */
WO_NODISCARD wo_status wo_render_through_pinhole(const wo_context *context, const wo_scene *scene,
                                                 const wo_camera *camera, wo_footage *footage,
                                                 wo_progress *progress, double share,
                                                 wo_error *error);

/* Reference and its error. */
WO_NODISCARD wo_status wo_render_through_lens(const wo_context *context, const wo_scene *scene,
                                              const wo_camera *camera, wo_footage *footage,
                                              wo_progress *progress, double share, wo_error *error);

/* Batches a reference of at least spp rays is made of, and rays of one batch. */
void wo_render_batches(int spp, int *batches, int *rays);

/* An image of zeroes from context's allocator. */
WO_NODISCARD wo_status wo_render_image(const wo_context *context, wo_rect bounds, int components,
                                       wo_image *image, wo_error *error);

/* One key for the samples of a pixel. */
static inline uint32_t wo_pixel_key(uint64_t seed, int32_t x, int32_t y, uint32_t purpose)
{
    return wo_stir(wo_stir((uint32_t)seed ^ (uint32_t)x * 0x01000193u, (uint32_t)(seed >> 32)),
                   wo_stir((uint32_t)y, purpose));
}

#endif
