/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "session.h"

#include <math.h>
#include <string.h>

enum { NAME_WIDTH = 24 };

void wo_print_clips(FILE *out, const wo_host_context_info *context)
{
    for (size_t i = 0; i < context->clip_count; i++) {
        const wo_host_clip_info *const clip = &context->clips[i];
        fprintf(out, "  %-*s%s%s%s%s%s%s%s", NAME_WIDTH, clip->name,
                clip->components & WO_HOST_RGBA ? "RGBA " : "",
                clip->components & WO_HOST_RGB ? "RGB " : "",
                clip->components & WO_HOST_ALPHA ? "one channel " : "",
                clip->output ? "(output) " : "", clip->optional ? "(optional) " : "",
                clip->mask ? "(matte) " : "", clip->temporal ? "(other frames too) " : "");
        fprintf(out, "%s\n", clip->label && strcmp(clip->label, clip->name) ? clip->label : "");
    }
}

static void print_range(FILE *out, double min, double max)
{
    const double huge = 1e9; /* what plugins say for "no limit" is larger */
    const bool below = min > -huge, above = max < huge;
    if (below && above)
        fprintf(out, " %g..%g", min, max);
    else if (below)
        fprintf(out, " %g or more", min);
    else if (above)
        fprintf(out, " up to %g", max);
}

static void print_choices(FILE *out, const wo_host_param_info *param)
{
    for (size_t i = 0; i < param->choice_count; i++)
        fprintf(out, "%s%s", i ? " | " : " ",
                param->choice_keys ? param->choice_keys[i] : param->choices[i]);
}

static void print_default(FILE *out, const wo_host_param_info *param)
{
    fputs(", default ", out);
    if (param->kind == WO_HOST_PARAM_CHOICE) {
        const double index = param->initial[0];
        if (index >= 0 && index < (double)param->choice_count)
            fputs(param->choices[(size_t)index], out);
    } else if (param->kind == WO_HOST_PARAM_BOOLEAN) {
        fputs(param->initial[0] > 0 ? "true" : "false", out);
    } else if (param->dimension == 0) {
        fprintf(out, "\"%s\"", param->initial_text);
    }
    const bool numbers =
        param->kind != WO_HOST_PARAM_CHOICE && param->kind != WO_HOST_PARAM_BOOLEAN;
    for (int i = 0; numbers && i < param->dimension; i++)
        fprintf(out, "%s%g", i ? "," : "", param->initial[i]);
}

static bool holds_value(const wo_host_param_info *param)
{
    return param->kind != WO_HOST_PARAM_GROUP && param->kind != WO_HOST_PARAM_PAGE &&
           param->kind != WO_HOST_PARAM_PUSH_BUTTON;
}

static void print_param(FILE *out, const wo_host_param_info *param)
{
    const bool fits = fprintf(out, "  %-*s", NAME_WIDTH, param->script_name) <= NAME_WIDTH + 2;
    fprintf(out, "%s%s%s", fits ? "" : " ", param->label,
            param->label && *param->label ? ": " : "");
    fputs(wo_host_param_type_text(param->kind), out);
    const bool ranged =
        param->kind != WO_HOST_PARAM_BOOLEAN && param->dimension > 0 && param->choice_count == 0;
    if (ranged)
        print_range(out, param->min[0], param->max[0]);
    print_choices(out, param);
    print_default(out, param);
    fprintf(out, "%s%s\n", param->animates ? "" : ", constant over time",
            param->secret ? ", hidden" : "");
    if (param->hint && *param->hint)
        wo_print_wrapped(out, param->hint, 0, NAME_WIDTH + 2);
}

void wo_print_params(FILE *out, const wo_host_context_info *context)
{
    const char *parent = "";
    for (size_t i = 0; i < context->param_count; i++) {
        const wo_host_param_info *const param = &context->params[i];
        if (!holds_value(param))
            continue;
        if (strcmp(param->parent, parent) != 0) {
            parent = param->parent;
            const wo_host_param_info *const group = wo_host_find_param(context, parent);
            fprintf(out, " %s\n", group ? group->label : parent);
        }
        print_param(out, param);
    }
}
