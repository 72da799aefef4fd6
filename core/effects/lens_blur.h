/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_EFFECTS_LENS_BLUR_H
#define WO_CORE_EFFECTS_LENS_BLUR_H

#include "focus/focus_surface.h"
#include "wideopen/aperture.h"
#include "wideopen/effect.h"
#include "wideopen/optics.h"

typedef enum wo_lens_blur_output {
    WO_OUTPUT_IMAGE,
    WO_OUTPUT_COC,
    WO_OUTPUT_DEPTH,
    WO_OUTPUT_RAYS,
    WO_OUTPUT_ERROR,
    WO_OUTPUT_GUESSED,
    WO_OUTPUT_FOCUS,
    WO_OUTPUT_SPLIT,
    WO_OUTPUT_MASK,
    WO_OUTPUT_APERTURE,
    WO_OUTPUT_COUNT
} wo_lens_blur_output;

/* Whose camera counts where the metadata names one. */
typedef enum wo_lens_blur_camera {
    WO_CAMERA_FROM_PARAMETERS,
    WO_CAMERA_FROM_METADATA,
    WO_CAMERA_FROM_OWN_FOCUS, /* metadata, but the parameter's focus */
    WO_CAMERA_FROM_OWN_STOP,
    WO_CAMERA_FROM_OWN_BOTH
} wo_lens_blur_camera;

/* What the user wants; the rows of the table in lens_blur_params.c describe each field. */
typedef struct wo_lens_blur_params {
    int32_t camera_from;
    double focal_length;
    double sensor_width;
    double f_stop;
    double focus_distance;
    int32_t breathing;
    int32_t focus_by;
    int32_t focus_clip;
    double field_curvature;
    double protect_near, protect_far;
    double near_gain, far_gain;
    int32_t focus_points;
    double focus_falloff;
    double focus_fade;
    double focus_point[WO_FOCUS_POINTS][2];
    double focus_offset[WO_FOCUS_POINTS];
    double focus_weight[WO_FOCUS_POINTS];
    double focus_dof[WO_FOCUS_POINTS];
    int32_t use_depth;
    int32_t depth_mode;
    double depth_scale;
    double depth_near;
    double depth_far;
    int32_t depth_channel;
    int32_t layers;
    int32_t edge_repair;
    int32_t use_mask;
    int32_t blades;
    double curvature;
    double rotation;
    double aspect;
    int32_t aperture_form;
    double opening;
    double obstruction;
    double apodization;
    double edge;
    double ring_amount;
    int32_t ring_count;
    double grain_amount;
    int32_t grain_seed;
    double cats_eye;
    double door_left, door_right, door_bottom, door_top;
    int32_t lens;
    int32_t lens_design;
    int32_t lens_diagram;
    double lens_residual;
    int32_t lens_glass;
    double lens_bending;
    double lens_thickness;
    int32_t best_focus;
    int32_t wavelengths;
    int32_t method;
    int32_t sampling;
    int32_t samples;
    double target_error;
    int32_t max_rays;
    int32_t seed;
    double max_radius;
    int32_t output;
} wo_lens_blur_params;

enum { WO_LENS_BLUR_PARAMS = 60 + 4 * WO_FOCUS_POINTS, WO_LENS_BLUR_GROUPS = 7 };
typedef enum wo_edge_repair {
    WO_EDGES_AS_THEY_ARE,
    WO_EDGES_OF_COLOUR,
    WO_EDGES_OF_COLOUR_AND_DEPTH,
    WO_EDGE_REPAIR_COUNT
} wo_edge_repair;
typedef enum wo_sampling { WO_SAMPLING_FIXED, WO_SAMPLING_ADAPTIVE, WO_SAMPLING_COUNT } wo_sampling;

extern const wo_param wo_lens_blur_table[WO_LENS_BLUR_PARAMS];
extern const char *const wo_lens_blur_lens_labels[];
extern const wo_param_group wo_lens_blur_groups[WO_LENS_BLUR_GROUPS];

/* Clips by index. */
#define WO_LENS_BLUR_LAYERS 4
enum {
    WO_CLIP_SOURCE = 0, /* layer i: colour 2 i, depth 2 i + 1 */
    WO_CLIP_DEPTH = 1,
    WO_CLIP_MASK = 2 * WO_LENS_BLUR_LAYERS,
    WO_CLIP_FOCUS,
    WO_CLIP_BACKGROUND, /* what Source hides, as a picture of its own: a clean plate */
    WO_CLIP_BACKGROUND_DEPTH,
    WO_LENS_BLUR_CLIPS
};
extern const wo_clip wo_lens_blur_clips[WO_LENS_BLUR_CLIPS];

/* Everything that follows from parameters and geometry alone. */
typedef struct wo_lens_blur_setup {
    wo_thin_lens lens;
    wo_aperture aperture;
    wo_depth_reading reading;
    bool has_depth;
    int layers; /* that take part */
    bool layer_used[WO_LENS_BLUR_LAYERS];
    bool mask_used;
    bool background_used;
    bool focus_map;       /* the Focus clip says where the focus is */
    double radius;        /* largest circle of confusion that is drawn, px */
    double reach;         /* px: no ray of the lens goes farther, aberrations and tilt included */
    double upright_reach; /* the same before the tilt */
    double v_min, v_max;
    int32_t margin;  /* px round a window that the method wants tiles for */
    int fill_levels; /* of the continuation of hidden surfaces; 0 = no depth, nothing to continue */
} wo_lens_blur_setup;

/* Does the lens need more than the pencils of the thin lens? */
bool wo_lens_blur_has_table(const wo_lens_blur_params *params);

/* Puts the camera of the metadata in place of the parameters that camera_from gives up. Each value
   that is known, and each that was refused, is noted in report, which may be NULL. Doing it twice
   is doing it once. */
void wo_lens_blur_use_camera(wo_lens_blur_params *params, const wo_camera *camera,
                             wo_report *report);

/* With the camera of the metadata, if params want it. */
WO_NODISCARD wo_status wo_lens_blur_prepare(const wo_lens_blur_params *params,
                                            const wo_geometry *geometry, wo_lens_blur_setup *setup,
                                            wo_error *error);

/* What is read of the layers for a window, before cutting to the extent. */
wo_rect wo_lens_blur_layers_area(const wo_lens_blur_setup *setup, wo_rect window);
/* What the stack for a window holds when no ray goes farther than reach, px; window must not be
   empty. */
wo_rect wo_lens_blur_stack_area(const wo_lens_blur_setup *setup, wo_rect window, double reach);

extern const wo_effect wo_lens_blur;

#endif
