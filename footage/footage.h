/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_FOOTAGE_H
#define WO_FOOTAGE_H

#include "wideopen/context.h"
#include "wideopen/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Test footage: procedural scenes seen through a pinhole (colour, depth, normals), as layers that a
   lens can look behind, and through a thin lens by brute force, which is the truth a lens blur has
   to meet.

   Surfaces are diffuse or glow: the light that leaves a point is the same in every direction, as
   any lens blur that works on pictures must assume, so pinhole, layers and lens reference show the
   same radiance. The light on the surfaces (soft shadows, sky, lamps) is computed once into maps
   that belong to the scene; it adds no noise and no difference between them.

   Camera: at the origin, x to the right, y up, looking along -z; depth is planar distance in
   metres. The field of view belongs to the focal length and does not change with the focus. The
   pixel filter is the pixel's own square, for pinhole, layers and reference alike.

   Everything is a function of the options alone: same bytes for every number of threads. */

#define WO_FOOTAGE_LAYERS_MAX  8
#define WO_FOOTAGE_SAMPLES_MAX 256

/* One scene of the table. */
typedef struct wo_footage_scene {
    const char *name; /* "still-life" */
    const char *help; /* one sentence */
    int width, height;
    double focal_mm, f_stop, focus_m;
} wo_footage_scene;

/* The scenes; index beyond the last gives NULL. Any thread. */
const wo_footage_scene *wo_footage_scene_at(size_t index);
const wo_footage_scene *wo_footage_scene_find(const char *name);

typedef enum wo_footage_peel {
    /* Surfaces that are continuous within a pixel form one patch with its own coverage and depth:
       at an edge the front layer holds the covered part only, the surface behind is whole.
       Composited in the order of depth the layers give the pinhole picture; a lens finds colours of
       one surface at the depth of that surface. A patch has a depth wherever it has coverage. */
    WO_FOOTAGE_PATCHES,
    /* Layer k averages the k-th hits of the rays in the pixel; depth is that of the centre's ray, 0
       where that has no k-th hit. What renderers give: an edge pixel mixes near and far colour. */
    WO_FOOTAGE_HITS
} wo_footage_peel;

/* Zero members mean the default. */
typedef struct wo_footage_options {
    const char *scene;
    int width, height; /* px; 0: the scene's. One given: the other follows */
    int overscan;      /* px that pinhole and layers show beyond the frame on all sides, so that a
                          lens finds what the reference sees; 0..a tenth of the shorter side */
    int samples;       /* rays per pixel of pinhole and layers, 1..256; 0: 32 */
    int layers;        /* 0..8; 0: none. With 1, hits are taken whatever peel says */
    wo_footage_peel peel;
    bool back_faces;   /* peel the faces of solids that the lens centre sees from inside, too */
    bool umbra;        /* leave out what no ray through the lens can reach */
    int reference_spp; /* lens rays per pixel, 0 or 16..2^20; 0: no reference. Rounded up */
    uint64_t seed;     /* 0 is a seed like any other */
    double focal_mm, f_stop, focus_m; /* 0: the scene's; focus INFINITY or negative are legal */
    int blades;      /* 0: round, else 3..16 straight blades, corners on the circle */
    double rotation; /* degrees, counter-clockwise: angle of a corner from +x, as the
                        photographer looks out */
} wo_footage_options;

/* 36 mm, the width of all sensors here. */
#define WO_FOOTAGE_SENSOR_MM 36.0

/* A finished set. Images are y up; the reference has the bounds {0, 0, width, height} of the frame,
   all others as much more as the overscan. What was not asked for has data = NULL. Depth 0 means no
   surface. Normals point to the camera's side of open surfaces and out of solids, in camera
   coordinates. */
typedef struct wo_footage {
    const wo_footage_scene *scene;
    wo_footage_options options; /* with the defaults filled in */
    wo_rect frame;
    wo_image colour, depth, normal; /* RGBA, 1, 3 */
    int layer_count;
    wo_image layer[WO_FOOTAGE_LAYERS_MAX];       /* premultiplied RGBA */
    wo_image layer_depth[WO_FOOTAGE_LAYERS_MAX]; /* 1 */
    int64_t layer_pixels[WO_FOOTAGE_LAYERS_MAX]; /* with coverage */
    int64_t umbra_dropped;    /* patches left out because no lens ray reaches them */
    int64_t deeper_dropped;   /* patches behind the last layer, each hidden behind a whole one */
    wo_image reference;       /* RGBA */
    wo_image reference_error; /* RGB: standard error of the mean, from independent batches */
    int batches;
    double noise_psnr; /* dB: the mean's noise, sRGB curve of values clipped to 0..1 */
    double seconds[3]; /* light, pinhole and layers, reference; wall clock */
} wo_footage;

/* Makes a set in memory, from context's allocator; *footage is owned by the caller until
   wo_footage_destroy and NULL after a failure. Unknown scenes list the known ones. Progress and
   abort of the context are honoured; progress is called by one thread at a time. */
WO_NODISCARD wo_status wo_footage_make(const wo_context *context, const wo_footage_options *options,
                                       wo_footage **footage, wo_error *error);
void wo_footage_destroy(const wo_context *context, wo_footage **footage);

/* Names of the files wo_footage_write makes. */
#define WO_FOOTAGE_PINHOLE         "pinhole.exr"
#define WO_FOOTAGE_LAYERS          "layers.exr"
#define WO_FOOTAGE_REFERENCE       "reference.exr"
#define WO_FOOTAGE_REFERENCE_ERROR "reference_error.exr"

/* Writes the set into an existing folder. pinhole.exr has the parts "rgba", "depth" (Z) and
   "normal" (N.X N.Y N.Z), layers.exr "layer1", "layer1_depth" and so on, the others one part. The
   frame is the display window. Every part carries the camera: wideopen:focalLength and
   wideopen:sensorWidth (mm), wideopen:fStop, wideopen:focusDistance (m), wideopen:blades,
   wideopen:rotation, wideopen:scene, wideopen:seed. */
WO_NODISCARD wo_status wo_footage_write(const wo_footage *footage, const char *folder,
                                        wo_error *error);

/* Both in one: what `wideopen footage` does. *footage may be NULL when the caller does not want to
   look at the set. */
WO_NODISCARD wo_status wo_footage_render(const wo_context *context,
                                         const wo_footage_options *options, const char *folder,
                                         wo_footage **footage, wo_error *error);

#ifdef __cplusplus
}
#endif
#endif
