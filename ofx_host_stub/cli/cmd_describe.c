/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "command.h"
#include "json.h"
#include "session.h"

static const wo_option options[] = {
    {"--json", NULL, NULL, "Print JSON: every context with its clips and parameters.", false},
    {"--context", NULL, "NAME",
     "General, Filter or Generator; without it the first of these that the plugin has.", false},
    WO_OPTION_PLUGIN_PATH,
    WO_OPTION_PLUGIN_CACHE,
    WO_OPTION_PLUGIN_WAIT,
    WO_OPTION_NOTES,
};

static const wo_usage usage = {
    .command = "describe",
    .synopsis = "PLUGIN [--json] [--context NAME]",
    .about = "Says what a plugin is: contexts, clips, parameters with their ranges and defaults. "
             "PLUGIN is an identifier or its last part, as wideopen list prints them.",
    .positionals = "PLUGIN",
    .positionals_min = 1,
    .positionals_max = 1,
    .options = options,
    .option_count = WO_COUNT(options),
    .after = "Example:\n  wideopen describe LensBlur\n",
};

static const char *safety_text(wo_host_safety safety)
{
    static const char *const texts[] = {"one render in the process", "one render per instance",
                                        "any number of renders"};
    return texts[safety];
}

static void print_text(const wo_host_plugin *plugin, const wo_host_context_info *context)
{
    printf("%s %u.%u: %s\n", plugin->identifier, plugin->version_major, plugin->version_minor,
           plugin->label);
    if (*plugin->description)
        wo_print_wrapped(stdout, plugin->description, 0, 0);
    printf("\ngroup     %s\nbundle    %s\nthreads   %s%s\n", plugin->group, plugin->bundle,
           safety_text(plugin->safety), plugin->tiles ? ", tiles" : "");
    fputs("contexts ", stdout);
    for (size_t i = 0; i < plugin->context_count; i++)
        printf(" %s", plugin->contexts[i].short_name);
    printf("\n\nClips (%s):\n", context->short_name);
    wo_print_clips(stdout, context);
    printf("\nParameters (%s):\n", context->short_name);
    wo_print_params(stdout, context);
}

static void json_param(wo_json *json, const wo_host_param_info *param)
{
    wo_json_object(json, NULL);
    wo_json_text(json, "name", param->name);
    wo_json_text(json, "scriptName", param->script_name);
    wo_json_text(json, "label", param->label);
    wo_json_text(json, "hint", param->hint);
    wo_json_text(json, "parent", param->parent);
    wo_json_text(json, "type", wo_host_param_type_text(param->kind));
    if (param->dimension > 0) {
        wo_json_numbers(json, "default", param->initial, param->dimension);
        wo_json_numbers(json, "min", param->min, param->dimension);
        wo_json_numbers(json, "max", param->max, param->dimension);
        wo_json_numbers(json, "displayMin", param->ui_min, param->dimension);
        wo_json_numbers(json, "displayMax", param->ui_max, param->dimension);
    } else if (param->initial_text) {
        wo_json_text(json, "default", param->initial_text);
    }
    if (param->choice_count > 0) {
        wo_json_array(json, "choices");
        for (size_t i = 0; i < param->choice_count; i++)
            wo_json_text(json, NULL,
                         param->choice_keys ? param->choice_keys[i] : param->choices[i]);
        wo_json_close(json);
    }
    wo_json_bool(json, "animates", param->animates);
    wo_json_bool(json, "secret", param->secret);
    wo_json_bool(json, "enabled", param->enabled);
    wo_json_close(json);
}

static void json_clip(wo_json *json, const wo_host_clip_info *clip)
{
    wo_json_object(json, NULL);
    wo_json_text(json, "name", clip->name);
    wo_json_text(json, "label", clip->label);
    wo_json_array(json, "components");
    if (clip->components & WO_HOST_ALPHA)
        wo_json_text(json, NULL, "Alpha");
    if (clip->components & WO_HOST_RGB)
        wo_json_text(json, NULL, "RGB");
    if (clip->components & WO_HOST_RGBA)
        wo_json_text(json, NULL, "RGBA");
    wo_json_close(json);
    wo_json_bool(json, "output", clip->output);
    wo_json_bool(json, "optional", clip->optional);
    wo_json_bool(json, "mask", clip->mask);
    wo_json_bool(json, "temporal", clip->temporal);
    wo_json_bool(json, "tiles", clip->tiles);
    wo_json_close(json);
}

static void json_context(wo_json *json, const wo_host_context_info *context)
{
    wo_json_object(json, NULL);
    wo_json_text(json, "name", context->short_name);
    wo_json_array(json, "clips");
    for (size_t i = 0; i < context->clip_count; i++)
        json_clip(json, &context->clips[i]);
    wo_json_close(json);
    wo_json_array(json, "params");
    for (size_t i = 0; i < context->param_count; i++)
        json_param(json, &context->params[i]);
    wo_json_close(json);
    wo_json_close(json);
}

/* only is the one context asked for, or NULL for all of them. */
static void print_json(const wo_host_plugin *plugin, const wo_host_context_info *only)
{
    wo_json json;
    wo_json_begin(&json, stdout);
    wo_json_object(&json, NULL);
    wo_json_text(&json, "identifier", plugin->identifier);
    wo_json_integer(&json, "versionMajor", plugin->version_major);
    wo_json_integer(&json, "versionMinor", plugin->version_minor);
    wo_json_text(&json, "label", plugin->label);
    wo_json_text(&json, "group", plugin->group);
    wo_json_text(&json, "description", plugin->description);
    wo_json_text(&json, "bundle", plugin->bundle);
    wo_json_text(&json, "threads", safety_text(plugin->safety));
    wo_json_bool(&json, "tiles", plugin->tiles);
    wo_json_bool(&json, "multiResolution", plugin->multi_resolution);
    wo_json_bool(&json, "temporal", plugin->temporal);
    wo_json_text(&json, "colourManagement", plugin->colour_style);
    wo_json_array(&json, "contexts");
    for (size_t i = 0; i < plugin->context_count; i++)
        if (!only || only == &plugin->contexts[i])
            json_context(&json, &plugin->contexts[i]);
    wo_json_close(&json);
    wo_json_close(&json);
}

static int describe(const wo_args *args, wo_host *host)
{
    const wo_host_plugin *const plugin = wo_session_plugin(host, args->positionals[0]);
    if (wo_args_count(args, "--notes"))
        wo_session_notes(host);
    if (!plugin)
        return WO_EXIT_USAGE;
    const char *const name = wo_args_value(args, "--context", 0);
    const wo_host_context_info *const context = wo_session_context(plugin, name, "describe");
    if (!context)
        return WO_EXIT_USAGE;
    if (wo_args_count(args, "--json"))
        print_json(plugin, name ? context : NULL);
    else
        print_text(plugin, context);
    return WO_EXIT_OK;
}

int wo_cmd_describe(int argc, char **argv)
{
    wo_args args;
    wo_host *host = NULL;
    int code = wo_args_read(&args, &usage, argc, argv);
    if (code == WO_EXIT_OK && args.help) {
        wo_args_help(&usage, stdout);
    } else if (code == WO_EXIT_OK) {
        code = wo_session_open(&args, (wo_host_config){.background = true}, &host);
        if (code == WO_EXIT_OK)
            code = describe(&args, host);
    }
    (void)wo_session_violations(host);
    wo_host_destroy(&host);
    wo_args_free(&args);
    return code;
}
