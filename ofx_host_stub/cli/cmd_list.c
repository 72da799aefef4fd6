/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "command.h"
#include "json.h"
#include "session.h"

static const wo_option options[] = {
    {"--json", NULL, NULL, "Print JSON.", false},
    WO_OPTION_PLUGIN_PATH,
    WO_OPTION_NOTES,
};

static const wo_usage usage = {
    .command = "list",
    .synopsis = "[--json] [--plugin-path DIR]",
    .about = "Lists every plugin that is found: identifier, version, label and contexts. Of two "
             "with one identifier the first found wins, unless the other is newer.",
    .options = options,
    .option_count = WO_COUNT(options),
};

static void print_text(const wo_host *host)
{
    for (size_t i = 0; i < wo_host_plugin_count(host); i++) {
        const wo_host_plugin *const plugin = wo_host_plugin_at(host, i);
        printf("%-36s %u.%u  %-24s", plugin->identifier, plugin->version_major,
               plugin->version_minor, plugin->label);
        for (size_t k = 0; k < plugin->context_count; k++)
            printf("%s%s", k ? ", " : "", plugin->contexts[k].short_name);
        putchar('\n');
    }
}

static void print_json(const wo_host *host)
{
    wo_json json;
    wo_json_begin(&json, stdout);
    wo_json_object(&json, NULL);
    wo_json_array(&json, "plugins");
    for (size_t i = 0; i < wo_host_plugin_count(host); i++) {
        const wo_host_plugin *const plugin = wo_host_plugin_at(host, i);
        wo_json_object(&json, NULL);
        wo_json_text(&json, "identifier", plugin->identifier);
        wo_json_integer(&json, "versionMajor", plugin->version_major);
        wo_json_integer(&json, "versionMinor", plugin->version_minor);
        wo_json_text(&json, "label", plugin->label);
        wo_json_text(&json, "group", plugin->group);
        wo_json_text(&json, "bundle", plugin->bundle);
        wo_json_array(&json, "contexts");
        for (size_t k = 0; k < plugin->context_count; k++)
            wo_json_text(&json, NULL, plugin->contexts[k].short_name);
        wo_json_close(&json);
        wo_json_close(&json);
    }
    wo_json_close(&json);
    wo_json_array(&json, "notes");
    for (size_t i = 0; i < wo_host_note_count(host); i++)
        wo_json_text(&json, NULL, wo_host_note(host, i));
    wo_json_close(&json);
    wo_json_close(&json);
}

static int run(const wo_args *args)
{
    wo_host *host;
    const int code = wo_session_open(args, (wo_host_config){.background = true}, &host);
    if (code != WO_EXIT_OK)
        return code;
    if (wo_args_count(args, "--json"))
        print_json(host);
    else
        print_text(host);
    const bool none = wo_host_plugin_count(host) == 0;
    if (none || wo_args_count(args, "--notes"))
        wo_session_notes(host);
    if (none)
        wo_message("no plugins found; set OFX_PLUGIN_PATH or give --plugin-path DIR");
    wo_host_destroy(&host);
    return WO_EXIT_OK;
}

int wo_cmd_list(int argc, char **argv)
{
    wo_args args;
    int code = wo_args_read(&args, &usage, argc, argv);
    if (code == WO_EXIT_OK && args.help)
        wo_args_help(&usage, stdout);
    else if (code == WO_EXIT_OK)
        code = run(&args);
    wo_args_free(&args);
    return code;
}
