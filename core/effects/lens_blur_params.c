/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "effects/lens_blur.h"

#include "defocus/renderer.h"
#include "focus/focus.h"
#include "optics/lens_choice.h"
#include "spectrum/bands.h"

#define FIELD(name) offsetof(wo_lens_blur_params, name)

const wo_param_group wo_lens_blur_groups[WO_LENS_BLUR_GROUPS] = {
    {"camera", "Camera", true},
    {"focusControl", "Focus", false},
    {"depth", "Depth and layers", true},
    {"aperture", "Aperture", true},
    {"lensModel", "Lens", false},
    {"quality", "Quality", true},
    {"view", "Output", true},
};

#define DEPTH_KEY(name, key, label)   key,
#define DEPTH_LABEL(name, key, label) label,
static const char *const depth_modes[] = {WO_DEPTH_MODE_LIST(DEPTH_KEY) NULL};
static const char *const depth_mode_labels[] = {WO_DEPTH_MODE_LIST(DEPTH_LABEL) NULL};
static const char *const channels[] = {"red", "green", "blue", "alpha", NULL};
static const char *const channel_labels[] = {"Red", "Green", "Blue", "Alpha", NULL};
static const char *const forms[] = {"iris", "star", "heart", NULL};
static const char *const form_labels[] = {"Iris", "Star", "Heart", NULL};
static const char *const outputs[] = {"image",   "coc",      "depth",      "rays",
                                      "error",   "guessed",  "focusPlane", "split",
                                      "rayMask", "aperture", NULL};
static const char *const output_labels[] = {"Image",    "CoC",      "Depth",       "Rays",
                                            "Error",    "Guessed",  "Focus plane", "Split",
                                            "Ray mask", "Aperture", NULL};
static const char *const repairs[] = {"off", "colour", "all", NULL};
static const char *const repair_labels[] = {"Off", "Colour", "All", NULL};

static const char *const methods[] = {"hybrid",     "rays",      "filter", "spread",
                                      "accumulate", "reference", NULL};
static const char *const method_labels[] = {"Hybrid",     "Rays",      "Filter", "Spread",
                                            "Accumulate", "Reference", NULL};
static const char *const samplings[] = {"fixed", "adaptive", NULL};
static const char *const sampling_labels[] = {"Fixed", "Adaptive", NULL};

static const char *const cameras[] = {"parameters",
                                      "metadata",
                                      "metadataOwnFocus",
                                      "metadataOwnFNumber",
                                      "metadataOwnFocusAndFNumber",
                                      NULL};
static const char *const camera_labels[] = {"Parameters",
                                            "Metadata",
                                            "Metadata, own focus",
                                            "Metadata, own f-number",
                                            "Metadata, own focus and f-number",
                                            NULL};

#include "effects/focus_choices.inc.h"
#include "effects/lens_choices.inc.h"

const wo_param wo_lens_blur_table[WO_LENS_BLUR_PARAMS] = {
    {.key = "cameraFrom",
     .label = "Camera from",
     .unit = "",
     .group = "camera",
     .help = "Parameters: the values below and those of Depth, whatever the file says. The others "
             "put the camera that the metadata of Source or Depth names in their place, value by "
             "value (focal length, sensor width, f-number, focus, near, far, units); what the "
             "metadata lacks stays as set here, and so does what is called own. Needs a host that "
             "passes metadata on; in others it changes nothing.",
     .type = WO_PARAM_CHOICE,
     .offset = FIELD(camera_from),
     .initial = {WO_CAMERA_FROM_PARAMETERS},
     .min = 0,
     .max = 4,
     .ui_min = 0,
     .ui_max = 4,
     .choices = cameras,
     .choice_labels = camera_labels},
    {.key = "focalLength",
     .label = "Focal length",
     .unit = "mm",
     .group = "camera",
     .help = "Focal length of the lens. With the sensor width it gives the field of view that the "
             "picture was rendered with.",
     .type = WO_PARAM_DOUBLE,
     .offset = FIELD(focal_length),
     .initial = {50},
     .min = 0.1,
     .max = 1e5,
     .ui_min = 8,
     .ui_max = 300,
     .animates = true},
    {.key = "sensorWidth",
     .label = "Sensor width",
     .unit = "mm",
     .group = "camera",
     .help = "Width of the film back: what the whole width of the format shows.",
     .type = WO_PARAM_DOUBLE,
     .offset = FIELD(sensor_width),
     .initial = {36},
     .min = 0.1,
     .max = 1e5,
     .ui_min = 5,
     .ui_max = 70,
     .animates = true},
    {.key = "fStop",
     .label = "f-number",
     .unit = "",
     .group = "camera",
     .help = "Focal length over the diameter of the entrance pupil. Smaller numbers blur more.",
     .type = WO_PARAM_DOUBLE,
     .offset = FIELD(f_stop),
     .initial = {2.8},
     .min = 0.01,
     .max = 1e6,
     .ui_min = 0.7,
     .ui_max = 22,
     .animates = true},
    {.key = "focusDistance",
     .label = "Focus distance",
     .unit = "m",
     .group = "camera",
     .help = "Planar distance of the plane in focus. 0 is infinity; negative values focus beyond "
             "infinity.",
     .type = WO_PARAM_DOUBLE,
     .offset = FIELD(focus_distance),
     .initial = {2.5},
     .min = -1e9,
     .max = 1e9,
     .ui_min = 0,
     .ui_max = 20,
     .animates = true},
    {.key = "breathing",
     .label = "Lens breathing",
     .unit = "",
     .group = "camera",
     .help = "Size the blur for a lens that moves to focus: its image distance in place of the "
             "focal length. Off for pictures of CG cameras, whose field of view is fixed.",
     .type = WO_PARAM_BOOL,
     .offset = FIELD(breathing),
     .initial = {0},
     .min = 0,
     .max = 1,
     .ui_min = 0,
     .ui_max = 1},
#include "effects/focus_params.inc.h"
    {.key = "useDepth",
     .label = "Use depth",
     .unit = "",
     .group = "depth",
     .help = "Off: the Depth clips are ignored and everything is infinitely far. For hosts that "
             "deliver black for clips that are not connected.",
     .type = WO_PARAM_BOOL,
     .offset = FIELD(use_depth),
     .initial = {1},
     .min = 0,
     .max = 1,
     .ui_min = 0,
     .ui_max = 1},
    {.key = "depthMode",
     .label = "Depth is",
     .unit = "",
     .group = "depth",
     .help =
         "What the numbers of the Depth clips mean. Distance: along the axis. Inverse: one over "
         "it. Ray: distance from the camera. Normalised: 0 is Near, 1 is Far. Negative: distance "
         "with a minus, as z in camera space is. Zero, negative and non-finite distances are "
         "infinitely far.",
     .type = WO_PARAM_CHOICE,
     .offset = FIELD(depth_mode),
     .initial = {WO_DEPTH_DISTANCE},
     .min = 0,
     .max = WO_DEPTH_MODE_COUNT - 1,
     .ui_min = 0,
     .ui_max = WO_DEPTH_MODE_COUNT - 1,
     .choices = depth_modes,
     .choice_labels = depth_mode_labels},
    {.key = "depthScale",
     .label = "Units per metre",
     .unit = "1/m",
     .group = "depth",
     .help = "How many scene units make a metre: 1 for metres, 100 for centimetres.",
     .type = WO_PARAM_DOUBLE,
     .offset = FIELD(depth_scale),
     .initial = {1},
     .min = 1e-9,
     .max = 1e9,
     .ui_min = 0.01,
     .ui_max = 1000,
     .animates = true},
    {.key = "near",
     .label = "Near",
     .unit = "m",
     .group = "depth",
     .help = "Distance of depth 0 when depth is normalised.",
     .type = WO_PARAM_DOUBLE,
     .offset = FIELD(depth_near),
     .initial = {0.1},
     .min = 1e-6,
     .max = 1e9,
     .ui_min = 0.01,
     .ui_max = 10,
     .animates = true},
    {.key = "far",
     .label = "Far",
     .unit = "m",
     .group = "depth",
     .help = "Distance of depth 1 when depth is normalised. May be nearer than Near: white is "
             "near.",
     .type = WO_PARAM_DOUBLE,
     .offset = FIELD(depth_far),
     .initial = {100},
     .min = 1e-6,
     .max = 1e9,
     .ui_min = 1,
     .ui_max = 1000,
     .animates = true},
    {.key = "depthChannel",
     .label = "Depth channel",
     .unit = "",
     .group = "depth",
     .help = "Channel of the Depth clips that holds the depth. Clips with fewer channels give "
             "their last one: Red suits those of one.",
     .type = WO_PARAM_CHOICE,
     .offset = FIELD(depth_channel),
     .initial = {0},
     .min = 0,
     .max = 3,
     .ui_min = 0,
     .ui_max = 3,
     .choices = channels,
     .choice_labels = channel_labels},
    {.key = "layers",
     .label = "Layers",
     .unit = "",
     .group = "depth",
     .help = "How many layers to use at most, Source included. Layers that are not connected do "
             "not count.",
     .type = WO_PARAM_INT,
     .offset = FIELD(layers),
     .initial = {WO_LENS_BLUR_LAYERS},
     .min = 1,
     .max = WO_LENS_BLUR_LAYERS,
     .ui_min = 1,
     .ui_max = WO_LENS_BLUR_LAYERS},
    {.key = "edgeRepair",
     .label = "Edge repair",
     .unit = "",
     .group = "depth",
     .help =
         "Pixels at edges that mix two surfaces are split into a front and a back part before "
         "they are blurred. Colour: antialiased colour, by the colours around. All: antialiased "
         "depth, too; pixels whose depth is a mixture get back the depth of a surface, and "
         "depth that was not antialiased stays what it is. Off: every pixel is one surface.",
     .type = WO_PARAM_CHOICE,
     .offset = FIELD(edge_repair),
     .initial = {WO_EDGES_OF_COLOUR_AND_DEPTH},
     .min = 0,
     .max = WO_EDGE_REPAIR_COUNT - 1,
     .ui_min = 0,
     .ui_max = WO_EDGE_REPAIR_COUNT - 1,
     .choices = repairs,
     .choice_labels = repair_labels},
    {.key = "useMask",
     .label = "Use mask",
     .unit = "",
     .group = "depth",
     .help = "Mix the blurred picture with the source by the Mask clip, where there is one: 1 is "
             "blurred, 0 is the source.",
     .type = WO_PARAM_BOOL,
     .offset = FIELD(use_mask),
     .initial = {1},
     .min = 0,
     .max = 1,
     .ui_min = 0,
     .ui_max = 1},
#include "effects/lens_params.inc.h"
    {.key = "method",
     .label = "Method",
     .unit = "",
     .group = "quality",
     .help = "How the blur is made. Hybrid: the filter, and lens rays, whose noise tells where the "
             "filter is wrong: the best picture for the time. Rays: lens rays alone. "
             "Filter: every pixel gathers what blurs over it; the fastest, for previews. Spread: "
             "every pixel's light is spread over its circle of confusion, distance by distance: no "
             "noise; Samples sets how finely distances are told apart. Accumulate: whole pictures, "
             "each seen from one point of the lens: no noise, but ghosts. Reference: rays by brute "
             "force, some 25 times slower, for checking.",
     .type = WO_PARAM_CHOICE,
     .offset = FIELD(method),
     .initial = {WO_METHOD_HYBRID},
     .min = 0,
     .max = WO_METHOD_COUNT - 1,
     .ui_min = 0,
     .ui_max = WO_METHOD_COUNT - 1,
     .choices = methods,
     .choice_labels = method_labels},
    {.key = "sampling",
     .label = "Sampling",
     .unit = "",
     .group = "quality",
     .help =
         "Fixed: as many lens rays as Samples says. Adaptive: as many as the target error needs, "
         "no more than Most rays.",
     .type = WO_PARAM_CHOICE,
     .offset = FIELD(sampling),
     .initial = {WO_SAMPLING_FIXED},
     .min = 0,
     .max = WO_SAMPLING_COUNT - 1,
     .ui_min = 0,
     .ui_max = WO_SAMPLING_COUNT - 1,
     .choices = samplings,
     .choice_labels = sampling_labels},
    {.key = "targetError",
     .label = "Target error",
     .unit = "",
     .group = "quality",
     .help = "Adaptive sampling goes on until noise beyond this is not to be expected: until three "
             "estimated standard errors of the displayed picture (black 0, white 1) are below it. "
             "1/255 = 0.004 is one step of an 8-bit display.",
     .type = WO_PARAM_DOUBLE,
     .offset = FIELD(target_error),
     .initial = {0.004},
     .min = 0,
     .max = 1,
     .ui_min = 0.001,
     .ui_max = 0.02},
    {.key = "maxRays",
     .label = "Most rays",
     .unit = "",
     .group = "quality",
     .help = "Adaptive sampling gives no pixel more lens rays than this.",
     .type = WO_PARAM_INT,
     .offset = FIELD(max_rays),
     .initial = {1024},
     .min = 1,
     .max = 16384,
     .ui_min = 16,
     .ui_max = 4096},
    {.key = "samples",
     .label = "Samples",
     .unit = "",
     .group = "quality",
     .help = "Lens rays for each pixel. Four times as many halve the noise, or better.",
     .type = WO_PARAM_INT,
     .offset = FIELD(samples),
     .initial = {64},
     .min = 1,
     .max = 16384,
     .ui_min = 8,
     .ui_max = 1024},
    {.key = "seed",
     .label = "Seed",
     .unit = "",
     .group = "quality",
     .help = "Chooses another pattern of lens rays; animate it to let the noise change.",
     .type = WO_PARAM_INT,
     .offset = FIELD(seed),
     .initial = {0},
     .min = 0,
     .max = 1e9,
     .ui_min = 0,
     .ui_max = 1000,
     .animates = true},
    {.key = "maxRadius",
     .label = "Largest radius",
     .unit = "px",
     .group = "quality",
     .help = "Blur is cut to circles of confusion of this radius at full resolution. It bounds "
             "what a tile must read around itself.",
     .type = WO_PARAM_DOUBLE,
     .offset = FIELD(max_radius),
     .initial = {100},
     .min = 0,
     .max = 2048,
     .ui_min = 0,
     .ui_max = 300,
     .animates = true},
    {.key = "output",
     .label = "Output",
     .unit = "",
     .group = "view",
     .help =
         "The image, or a view of the plan: the radius of the circle of confusion in px "
         "(positive in front of the focus, negative behind), the depth in metres, the lens rays "
         "of each pixel, its estimated error, how much of its light was guessed, "
         "what is in front of the focus (blue), in it to half a px (green) and behind it (red), or "
         "the pixels that edge repair split in two (1) or whose depth alone it mended (0.5), what "
         "is "
         "left to rays where the method smooths the rest, or the aperture.",
     .type = WO_PARAM_CHOICE,
     .offset = FIELD(output),
     .initial = {WO_OUTPUT_IMAGE},
     .min = 0,
     .max = WO_OUTPUT_COUNT - 1,
     .ui_min = 0,
     .ui_max = WO_OUTPUT_COUNT - 1,
     .choices = outputs,
     .choice_labels = output_labels},
};

#define COLOUR(clip_name, clip_label, clip_help, is_optional)                                      \
    {                                                                                              \
        .name = clip_name, .label = clip_label, .help = clip_help, .optional = is_optional,        \
        .components = WO_COMPONENT_RGBA | WO_COMPONENT_RGB                                         \
    }
#define DEPTH(clip_name, clip_label, clip_help)                                                    \
    {                                                                                              \
        .name = clip_name, .label = clip_label, .help = clip_help, .optional = true, .data = true, \
        .components = WO_COMPONENT_ALPHA | WO_COMPONENT_RGB | WO_COMPONENT_RGBA                    \
    }

const wo_clip wo_lens_blur_clips[WO_LENS_BLUR_CLIPS] = {
    COLOUR("Source", "Source", "The picture, seen through a pinhole.", false),
    DEPTH("Depth", "Depth",
          "Depth of Source. Best at pixel centres; antialiased depth is repaired."),
    COLOUR("Layer2", "Layer 2", "What Source hides: a second depth peel, or another object group.",
           true),
    DEPTH("Depth2", "Depth 2", "Depth of Layer 2."),
    COLOUR("Layer3", "Layer 3", "A third layer.", true),
    DEPTH("Depth3", "Depth 3", "Depth of Layer 3."),
    COLOUR("Layer4", "Layer 4", "A fourth layer.", true),
    DEPTH("Depth4", "Depth 4", "Depth of Layer 4."),
    {.name = "Mask",
     .label = "Mask",
     .help = "Where to blur: 1 blurred, 0 source.",
     .optional = true,
     .mask = true,
     .components = WO_COMPONENT_ALPHA | WO_COMPONENT_RGB | WO_COMPONENT_RGBA},
    DEPTH("Focus", "Focus",
          "Where the focus is, pixel by pixel, or how large the blur; see Focus clip is. The first "
          "channel counts."),
    COLOUR("Background", "Background",
           "Clean plate: the picture without what stands in front. It is seen where a blurred "
           "foreground lets through what Source hides, behind all layers, and is no guess.",
           true),
    DEPTH("BackgroundDepth", "Background depth",
          "Depth of Background. Without it the plate takes the depth of the far surfaces around "
          "whatever hides it."),
};
