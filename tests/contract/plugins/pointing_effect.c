/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "probe_effect.h"

typedef struct pointing_params {
    probe_params probe;
    int32_t mode, uses;
    double points[3][2];
    double centre[2];
} pointing_params;

enum { MODE_NOTHING, MODE_EACH, MODE_PLANE };

static const char *const modes[] = {"nothing", "each", "plane", NULL};

#define POINT(name, text, nth)                                                                     \
    {                                                                                              \
        .key = name, .label = text, .help = "A place.", .unit = "px", .group = "rest",             \
        .type = WO_PARAM_POINT, .offset = offsetof(pointing_params, points[nth]),                  \
        .initial = {10 + 20 * nth, 20 + 10 * (nth % 2)}, .min = -500, .max = 500, .ui_min = 0,     \
        .ui_max = 100, .animates = true, .overlay = true                                           \
    }

static const wo_param table[] = {
    {.key = "mode",
     .label = "Mode",
     .help = "What the points are for.",
     .unit = "",
     .group = "rest",
     .type = WO_PARAM_CHOICE,
     .offset = offsetof(pointing_params, mode),
     .initial = {MODE_EACH},
     .min = 0,
     .max = 2,
     .ui_min = 0,
     .ui_max = 2,
     .choices = modes,
     .overlay = true},
    {.key = "uses",
     .label = "Uses",
     .help = "How many points count.",
     .unit = "",
     .group = "rest",
     .type = WO_PARAM_INT,
     .offset = offsetof(pointing_params, uses),
     .initial = {2},
     .min = 0,
     .max = 3,
     .ui_min = 0,
     .ui_max = 3,
     .animates = true,
     .overlay = true},
    {.key = "centre",
     .label = "Centre",
     .help = "A point that is no handle.",
     .unit = "px",
     .group = "rest",
     .type = WO_PARAM_POINT,
     .offset = offsetof(pointing_params, centre),
     .min = -500,
     .max = 500,
     .ui_min = 0,
     .ui_max = 100},
    POINT("first", "Point 1", 0),
    POINT("second", "Point 2", 1),
    POINT("third", "Point 3", 2),
};

static int handles(const void *params, bool *joined)
{
    const pointing_params *const values = params;
    *joined = values->mode == MODE_PLANE;
    return values->mode == MODE_NOTHING ? 0 : values->uses;
}

const wo_effect *pointing_effect(void)
{
    static wo_effect effect;
    effect = probe_effect;
    effect.name = "Pointing";
    effect.params_size = sizeof(pointing_params);
    effect.params = table;
    effect.param_count = WO_COUNT(table);
    effect.handles = handles;
    return &effect;
}
