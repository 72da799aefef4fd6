/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "session.h"

#include "bridge/beside.h"
#include "command.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { DIRECTORIES_MAX = 64 };

static bool is_directory(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

static bool print_plugin_message(void *user, wo_host_message type, const char *id, const char *text)
{
    static const char *const names[] = {"fatal: ", "error: ", "warning: ", "", "log: ", "asks: "};
    (void)user;
    (void)id;
    wo_message("plugin %s%s", names[type], text);
    return false;
}

/* Folder of the cache into path; "" = none. False after a message. */
static bool choose_cache(const wo_args *args, char *path, size_t size)
{
    const char *chosen = wo_args_value(args, "--plugin-cache", 0);
    const char *const xdg = getenv("XDG_CACHE_HOME"), *const home = getenv("HOME");
    int used = 0;
    if (!chosen)
        chosen = getenv("WIDEOPEN_PLUGIN_CACHE");
    if (chosen && *chosen)
        used = snprintf(path, size, "%s", strcmp(chosen, "off") == 0 ? "" : chosen);
    else if (xdg && *xdg == '/')
        used = snprintf(path, size, "%s/wideopen/plugins", xdg);
    else if (home && *home == '/')
        used = snprintf(path, size, "%s/.cache/wideopen/plugins", home);
    else
        *path = '\0';
    if (used >= 0 && (size_t)used < size)
        return true;
    wo_message("the path of the plugin cache is too long; give --plugin-cache DIR or off");
    return false;
}

int wo_session_open(const wo_args *args, wo_host_config config, wo_host **host)
{
    const char *directories[DIRECTORIES_MAX];
    size_t count = 0;
    *host = NULL;
    for (int i = 0; i < wo_args_count(args, "--plugin-path"); i++) {
        const char *const directory = wo_args_value(args, "--plugin-path", i);
        if (count >= DIRECTORIES_MAX - 1)
            return wo_usage_fault(args->usage->command, "more than %d times --plugin-path",
                                  DIRECTORIES_MAX - 1);
        if (!is_directory(directory)) {
            wo_message("--plugin-path %s is no directory; name one that holds .ofx.bundle folders",
                       directory);
            return WO_EXIT_FAILURE;
        }
        directories[count++] = directory;
    }
    char beside[PATH_MAX];
    if (wo_beside_program("Plugins", beside, sizeof beside) && is_directory(beside))
        directories[count++] = beside;
    static const char *const describer[] = {"/proc/self/exe", WO_SESSION_DESCRIBER, NULL};
    char cache[PATH_MAX];
    if (!choose_cache(args, cache, sizeof cache))
        return WO_EXIT_FAILURE;
    if (!wo_args_double(args, "--plugin-wait", 0.1, 3600, &config.describe_seconds))
        return WO_EXIT_USAGE;
    config.describer = describer;
    config.cache = cache;
    config.directories = directories;
    config.directory_count = count;
    config.search_path = true;
    if (!config.message)
        config.message = print_plugin_message;
    wo_error error = {0};
    return wo_host_create(&config, host, &error) == WO_OK ? WO_EXIT_OK : wo_failure(&error);
}

void wo_session_notes(const wo_host *host)
{
    for (size_t i = 0; i < wo_host_note_count(host); i++)
        wo_message("note: %s", wo_host_note(host, i));
}

void wo_session_failures(const wo_host *host)
{
    for (size_t i = 0; i < wo_host_failure_count(host); i++)
        wo_message("failed: %s", wo_host_failure(host, i));
}

size_t wo_session_violations(wo_host *host)
{
    if (!host)
        return 0;
    wo_host_unload(host); /* what is left behind is a breach, too */
    const size_t count = wo_host_violation_count(host);
    for (size_t i = 0; i < count; i++)
        wo_message("violation: %s", wo_host_violation(host, i));
    return count;
}

/* Those that speak of a name, and how many others there are. */
static void tell_failures_of(const wo_host *host, const char *name)
{
    size_t others = 0;
    for (size_t i = 0; i < wo_host_failure_count(host); i++) {
        if (strstr(wo_host_failure(host, i), name))
            wo_message("failed: %s", wo_host_failure(host, i));
        else
            others++;
    }
    if (others)
        wo_message("%zu %splugins or binaries failed; wideopen list names them", others,
                   others < wo_host_failure_count(host) ? "other " : "");
}

const wo_host_plugin *wo_session_plugin(wo_host *host, const char *name)
{
    const wo_host_plugin *plugin = NULL;
    wo_error error = {0};
    const wo_status status = wo_host_find_plugin(host, name, &plugin, &error);
    if (status == WO_OK)
        return plugin;
    wo_message("%s", error.text);
    if (status == WO_ERR_NOT_FOUND)
        tell_failures_of(host, name);
    if (status == WO_ERR_NOT_FOUND)
        wo_message("wideopen list shows what is found in --plugin-path, the folder Plugins beside "
                   "this program, OFX_PLUGIN_PATH and the system's folder");
    return NULL;
}

const wo_host_context_info *wo_session_context(const wo_host_plugin *plugin, const char *name,
                                               const char *command)
{
    static const char *const preferred[] = {"General", "Filter", "Generator"};
    for (size_t i = 0; !name && i < WO_COUNT(preferred); i++) {
        const wo_host_context_info *const context = wo_host_find_context(plugin, preferred[i]);
        if (context)
            return context;
    }
    const wo_host_context_info *const context = name ? wo_host_find_context(plugin, name) : NULL;
    if (context)
        return context;
    char there[512] = "none this host can run";
    size_t used = 0;
    for (size_t i = 0; i < plugin->context_count && used < sizeof there; i++)
        used += (size_t)snprintf(there + used, sizeof there - used, "%s%s", i ? ", " : "",
                                 plugin->contexts[i].short_name);
    wo_usage_fault(command, "%s has no context %s; it has: %s", plugin->identifier,
                   name ? name : "General, Filter or Generator", there);
    return NULL;
}
