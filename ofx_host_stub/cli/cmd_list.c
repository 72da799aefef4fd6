/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "command.h"
#include "json.h"
#include "session.h"

static const wo_option options[] = {
    {"--json", NULL, NULL, "Print JSON.", false},
    WO_OPTION_PLUGIN_PATH,
    WO_OPTION_PLUGIN_CACHE,
    WO_OPTION_PLUGIN_WAIT,
    WO_OPTION_NOTES,
};

static const wo_usage usage = {
    .command = "list",
    .synopsis = "[--json] [--plugin-path DIR]",
    .about = "Lists every plugin that is found: identifier, version, label and contexts. Of two "
             "with one identifier and major version the first found is listed, unless the other's "
             "minor version is higher; render and describe take the one of the nearest folder, in "
             "it that of the bundle with its name, then the highest version. On stderr: "
             "which binaries and plugins fail and why, and which break the rules of OpenFX. What "
             "fails does not end the command: its exit code says whether it could make the list.",
    .options = options,
    .option_count = WO_COUNT(options),
};

/* Columns of a text in UTF-8. */
static int columns(const char *text)
{
    int count = 0;
    for (; *text; text++)
        count += ((unsigned char)*text & 0xc0) != 0x80;
    return count;
}

static void print_column(const char *text, int width)
{
    wo_put_clean(text, stdout);
    printf("%*s", width > columns(text) ? width - columns(text) : 0, "");
}

static void version_text(const wo_host_found *found, char *text, size_t size)
{
    snprintf(text, size, "%u.%u", found->version_major, found->version_minor);
}

static void print_text(const wo_host *host)
{
    int widths[3] = {0};
    char version[32];
    for (size_t i = 0; i < wo_host_found_count(host); i++) {
        const wo_host_found *const found = wo_host_found_at(host, i);
        version_text(found, version, sizeof version);
        const char *const cells[] = {found->identifier, version, found->label};
        for (size_t k = 0; k < WO_COUNT(cells); k++)
            if (columns(cells[k]) > widths[k])
                widths[k] = columns(cells[k]);
    }
    for (size_t i = 0; i < wo_host_found_count(host); i++) {
        const wo_host_found *const found = wo_host_found_at(host, i);
        version_text(found, version, sizeof version);
        print_column(found->identifier, widths[0] + 2);
        print_column(version, widths[1] + 2);
        print_column(found->label, widths[2] + 2);
        for (size_t k = 0; k < found->context_count; k++)
            printf("%s%s", k ? ", " : "", found->contexts[k]);
        putchar('\n');
    }
}

static void print_json(const wo_host *host)
{
    wo_json json;
    wo_json_begin(&json, stdout);
    wo_json_object(&json, NULL);
    wo_json_array(&json, "plugins");
    for (size_t i = 0; i < wo_host_found_count(host); i++) {
        const wo_host_found *const found = wo_host_found_at(host, i);
        wo_json_object(&json, NULL);
        wo_json_text(&json, "identifier", found->identifier);
        wo_json_integer(&json, "versionMajor", found->version_major);
        wo_json_integer(&json, "versionMinor", found->version_minor);
        wo_json_text(&json, "label", found->label);
        wo_json_text(&json, "group", found->group);
        wo_json_text(&json, "bundle", found->bundle);
        wo_json_array(&json, "contexts");
        for (size_t k = 0; k < found->context_count; k++)
            wo_json_text(&json, NULL, found->contexts[k]);
        wo_json_close(&json);
        wo_json_integer(&json, "breaches", (long long)found->breaches);
        wo_json_close(&json);
    }
    wo_json_close(&json);
    wo_json_array(&json, "failures");
    for (size_t i = 0; i < wo_host_failure_count(host); i++)
        wo_json_text(&json, NULL, wo_host_failure(host, i));
    wo_json_close(&json);
    wo_json_array(&json, "notes");
    for (size_t i = 0; i < wo_host_note_count(host); i++)
        wo_json_text(&json, NULL, wo_host_note(host, i));
    wo_json_close(&json);
    wo_json_close(&json);
}

/* One line for each plugin that breaks the rules when it is described. */
static void tell_breaches(const wo_host *host)
{
    for (size_t i = 0; i < wo_host_found_count(host); i++) {
        const wo_host_found *const found = wo_host_found_at(host, i);
        if (found->breaches > 0)
            wo_message("%s breaks the rules of OpenFX %zu time%s: %.160s", found->identifier,
                       found->breaches, found->breaches == 1 ? "" : "s", found->breach);
    }
}

static int run(const wo_args *args)
{
    wo_host *host;
    wo_error error = {0};
    int code = wo_session_open(
        args, (wo_host_config){.background = true, .aborted = wo_interrupted}, &host);
    if (code == WO_EXIT_OK && wo_host_survey(host, &error) != WO_OK)
        code = wo_failure(&error);
    if (code != WO_EXIT_OK) {
        wo_host_destroy(&host);
        return code;
    }
    if (wo_args_count(args, "--json"))
        print_json(host);
    else
        print_text(host);
    fflush(stdout);
    const bool none = wo_host_found_count(host) == 0;
    if (none || wo_args_count(args, "--notes"))
        wo_session_notes(host);
    else
        wo_session_failures(host);
    tell_breaches(host);
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
    else if (code == WO_EXIT_OK) {
        wo_interrupt_catch();
        code = run(&args);
    }
    wo_args_free(&args);
    return code;
}
