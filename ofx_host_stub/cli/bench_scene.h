/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_BENCH_SCENE_H
#define WO_CLI_BENCH_SCENE_H

#include "footage.h"
#include "render_input.h"

/* Scenes as folders:
     pinhole.exr                       colour; with a part "depth" when there is no depth.exr
     depth.exr                         its depth
     layers.exr                        parts layer1, layer1_depth, ...; or instead of it
     layer1.exr, layer1_depth.exr ...
     truth.exr or reference.exr        what a lens blur has to meet
   Every picture is as in `wideopen footage`; the camera is in the attributes wideopen:... of
   pinhole.exr or of layer 1. */

/* Makes the footage of options in a folder of its own below root and writes its name to folder (of
   size bytes). Footage that is there already is taken unless fresh is set. With reference_spp 0 it
   gets 1024 rays a pixel, and 4096 where 1024 leave noise above -50 dB. */
WO_NODISCARD wo_status wo_bench_footage(const wo_context *context, wo_footage_options options,
                                        const char *root, bool fresh, char *folder, size_t size,
                                        wo_error *error);

/* Adds the clips of a folder to inputs: Source and Depth from the pinhole picture, or with layers
   from layer 1, and Layer2, Depth2 ... as far as context has such clips and there are files. *given
   is the number of layers, 0 when the folder has none: then nothing was added. */
WO_NODISCARD wo_status wo_bench_add_clips(wo_inputs *inputs, const wo_host_context_info *context,
                                          const char *folder, bool layers, int *given,
                                          wo_error *error);

/* Loads the reference, linear; image->data is malloc-ed. *noise is the standard error of its
   displayed value, NAN when the file does not say. */
WO_NODISCARD wo_status wo_bench_reference(const wo_colour *colour, const char *folder,
                                          wo_image *image, double *noise, wo_error *error);

/* Gives an instance's camera parameters what the file of Source says. */
WO_NODISCARD wo_status wo_bench_camera(wo_host_instance *instance, const wo_io_part *header,
                                       wo_error *error);

#endif
