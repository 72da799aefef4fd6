/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_plugin.h"
#include "wideopen/effect.h"

#include <math.h>
#include <string.h>

/* Calls itself LensBlur, but only pretends: each method adds noise of a known size to the displayed
   value of Source, or fails in a way of its own. What `wideopen bench` is tested with. */

typedef enum method {
    RAYS,   /* noise 0.2 / sqrt(samples), no estimate */
    HYBRID, /* half of it with estimate; adaptive: 0.9 of the target */
    LIAR,   /* the same, but claims a third */
    BROKEN, /* fails */
    HOLES,  /* some pixels are no numbers */
    SLEEPY, /* does not end by itself */
    REFERENCE
} method;

typedef struct tricks_params {
    int32_t method;
    int32_t sampling; /* 1 = adaptive */
    int32_t samples;
    double target;
    int32_t seed;
} tricks_params;

struct wo_plan {
    wo_context context;
    tricks_params params;
    wo_image source;
    double size; /* of the noise */
};

static const char *const methods[] = {"rays",  "hybrid", "liar",      "broken",
                                      "holes", "sleepy", "reference", NULL};
static const char *const method_labels[] = {"Rays",  "Hybrid", "Liar",      "Broken",
                                            "Holes", "Sleepy", "Reference", NULL};
static const char *const samplings[] = {"fixed", "adaptive", NULL};
static const char *const sampling_labels[] = {"Fixed", "Adaptive", NULL};

static const wo_param params[] = {
    {.key = "method",
     .label = "Method",
     .help = "What to pretend.",
     .unit = "",
     .group = "all",
     .type = WO_PARAM_CHOICE,
     .offset = offsetof(tricks_params, method),
     .max = REFERENCE,
     .ui_max = REFERENCE,
     .choices = methods,
     .choice_labels = method_labels},
    {.key = "sampling",
     .label = "Sampling",
     .help = "Fixed or adaptive.",
     .unit = "",
     .group = "all",
     .type = WO_PARAM_CHOICE,
     .offset = offsetof(tricks_params, sampling),
     .max = 1,
     .ui_max = 1,
     .choices = samplings,
     .choice_labels = sampling_labels},
    {.key = "samples",
     .label = "Samples",
     .help = "Less noise.",
     .unit = "",
     .group = "all",
     .type = WO_PARAM_INT,
     .offset = offsetof(tricks_params, samples),
     .initial = {64},
     .min = 1,
     .max = 16384,
     .ui_min = 1,
     .ui_max = 256},
    {.key = "targetError",
     .label = "Target error",
     .help = "The noise there may be.",
     .unit = "",
     .group = "all",
     .type = WO_PARAM_DOUBLE,
     .offset = offsetof(tricks_params, target),
     .initial = {0.004},
     .max = 1,
     .ui_max = 1},
    {.key = "seed",
     .label = "Seed",
     .help = "Other noise.",
     .unit = "",
     .group = "all",
     .type = WO_PARAM_INT,
     .offset = offsetof(tricks_params, seed),
     .max = 1e9,
     .ui_max = 9},
};

static const wo_param_group groups[] = {{"all", "All", true}};

#define COLOUR (WO_COMPONENT_RGB | WO_COMPONENT_RGBA)
#define NUMBER (WO_COMPONENT_ALPHA | COLOUR)

static const wo_clip clips[] = {
    {.name = "Source", .label = "Source", .help = "The picture.", .components = COLOUR},
    {.name = "Depth",
     .label = "Depth",
     .help = "Ignored.",
     .components = NUMBER,
     .optional = true,
     .data = true},
    {.name = "Layer2",
     .label = "Layer 2",
     .help = "Ignored.",
     .components = COLOUR,
     .optional = true},
    {.name = "Depth2",
     .label = "Depth 2",
     .help = "Ignored.",
     .components = NUMBER,
     .optional = true,
     .data = true},
};

static wo_status region(const void *p, const wo_geometry *geometry, wo_rect window, size_t clip,
                        wo_rect *needed, wo_error *error)
{
    (void)p, (void)geometry, (void)clip, (void)error;
    *needed = window;
    return WO_OK;
}

static int identity(const void *p, const wo_geometry *geometry)
{
    (void)p, (void)geometry;
    return -1;
}

static void plan_destroy(wo_plan **place)
{
    if (!*place)
        return;
    const wo_context context = (*place)->context;
    wo_delete(&context, *place);
    *place = NULL;
}

static wo_status plan_create(const wo_context *context, const void *p, const wo_plan_args *args,
                             wo_plan **place, wo_error *error)
{
    wo_plan *const plan = *place = wo_new(context, error, 1, sizeof *plan);
    if (!plan)
        return WO_ERR_NOMEM;
    plan->context = *context;
    memcpy(&plan->params, p, sizeof plan->params);
    plan->source = args->inputs[0];
    const double rays = 0.2 / sqrt(plan->params.samples);
    plan->size = plan->params.method == RAYS  ? rays
                 : plan->params.sampling == 1 ? 0.9 * plan->params.target
                                              : rays / 2;
    return WO_OK;
}

static int plan_print(const wo_plan *plan, char *buffer, size_t size)
{
    (void)plan;
    if (size > 0)
        buffer[0] = '\0';
    return 0;
}

/* The displayed value and back, on the upper part of the sRGB curve. */
static double shown(double x)
{
    return x <= 0.0031308 ? 12.92 * fmax(x, 0) : 1.055 * pow(fmin(x, 1), 1 / 2.4) - 0.055;
}

static double linear(double s)
{
    return pow((s + 0.055) / 1.055, 2.4);
}

static double sign(const wo_plan *plan, int32_t x, int32_t y, int c)
{
    uint32_t bits = (uint32_t)x * 2654435761u ^ (uint32_t)y * 2246822519u ^
                    ((uint32_t)plan->params.seed * 4u + (uint32_t)c) * 3266489917u;
    bits = (bits ^ bits >> 15) * 2246822519u;
    bits = (bits ^ bits >> 13) * 3266489917u;
    return bits >> 31 ? 1 : -1;
}

static void pixel(const wo_plan *plan, int32_t x, int32_t y, float *out)
{
    const wo_rect b = plan->source.bounds;
    const bool inside = x >= b.x1 && x < b.x2 && y >= b.y1 && y < b.y2;
    const float *const in = inside ? wo_image_at(&plan->source, x, y) : NULL;
    for (int c = 0; c < 3; c++) /* well inside of what can be displayed, noise and all */
        out[c] = (float)linear(0.3 + 0.4 * shown(in ? (double)in[c] : 0) +
                               plan->size * sign(plan, x, y, c));
    if (plan->params.method == HOLES && x % 8 == 0)
        out[1] = NAN;
    out[3] = 1;
}

static wo_status render(const wo_plan *plan, wo_rect window, const wo_image *output,
                        wo_report *report, wo_error *error)
{
    const int64_t pixels = (int64_t)wo_rect_width(window) * wo_rect_height(window);
    const double claimed = plan->params.method == LIAR ? plan->size / 3 : plan->size;
    if (plan->params.method == BROKEN)
        return wo_fail(error, WO_ERR_INTERNAL, "this method, \"broken\", never works");
    while (plan->params.method == SLEEPY)
        if (wo_aborted(&plan->context))
            return WO_ABORTED;
    for (int32_t y = window.y1; y < window.y2; y++)
        for (int32_t x = window.x1; x < window.x2; x++)
            pixel(plan, x, y, wo_image_at(output, x, y));
    if (!report)
        return WO_OK;
    report->pixels += pixels;
    report->rays += pixels * plan->params.samples;
    if (plan->params.method == HYBRID || plan->params.method == LIAR) {
        report->error_pixels[0] += pixels;
        report->square_error[0] += claimed * claimed * (double)pixels;
    }
    return WO_OK;
}

static const wo_effect tricks = {
    .name = "LensBlur",
    .label = "Lens Blur, not really",
    .help = "Noise of a known size, for tests.",
    .params_size = sizeof(tricks_params),
    .params = params,
    .param_count = WO_COUNT(params),
    .groups = groups,
    .group_count = WO_COUNT(groups),
    .clips = clips,
    .clip_count = WO_COUNT(clips),
    .region = region,
    .identity = identity,
    .plan_create = plan_create,
    .plan_print = plan_print,
    .render = render,
    .plan_destroy = plan_destroy,
};

static wo_ofx_plugin plugin;

static void set_host(OfxHost *host)
{
    plugin.host = host;
}

static OfxStatus main_entry(const char *action, const void *handle, OfxPropertySetHandle in,
                            OfxPropertySetHandle out)
{
    return wo_ofx_main(&plugin, action, handle, in, out);
}

static const wo_effect *effect(void)
{
    return &tricks;
}

static wo_ofx_plugin plugin = {
    .ofx = {.pluginApi = kOfxImageEffectPluginApi,
            .apiVersion = kOfxImageEffectPluginApiVersion,
            .pluginIdentifier = "org.wideopen.LensBlur",
            .pluginVersionMajor = WO_VERSION_MAJOR,
            .pluginVersionMinor = 9999, /* the highest is taken */
            .setHost = set_host,
            .mainEntry = main_entry},
    .group = "WideOpen/Test",
    .effect = effect,
};

wo_ofx_plugin *const wo_ofx_plugins[] = {&plugin, NULL};
