/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_SESSION_H
#define WO_CLI_SESSION_H

#include "args.h"
#include "host/found.h"

#include <stdio.h>

/* What the commands that load plugins share. */

/* Rows of the option table. */
#define WO_OPTION_PLUGIN_PATH                                                                      \
    {                                                                                              \
        "--plugin-path", NULL, "DIR",                                                              \
            "Look for plugins here first, then in the folder Plugins beside this program, then "   \
            "in the "                                                                              \
            "folders of OFX_PLUGIN_PATH and the system's own.",                                    \
            true                                                                                   \
    }
#define WO_OPTION_PLUGIN_CACHE                                                                     \
    {                                                                                              \
        "--plugin-cache", NULL, "DIR",                                                             \
            "Where to remember what plugins there are, or off; otherwise the variable "            \
            "WIDEOPEN_PLUGIN_CACHE, otherwise wideopen/plugins in XDG_CACHE_HOME or ~/.cache.",    \
            false                                                                                  \
    }
#define WO_OPTION_PLUGIN_WAIT                                                                      \
    {                                                                                              \
        "--plugin-wait", NULL, "SECONDS",                                                          \
            "How long a plugin may take to load and to describe itself before it is given up; "    \
            "30. "                                                                                 \
            "All but the one that is asked for do so in processes of their own.",                  \
            false                                                                                  \
    }
#define WO_OPTION_NOTES                                                                            \
    {                                                                                              \
        "--notes", NULL, NULL, "Say what was found but not taken as a plugin, and why.", false     \
    }

/* Makes a host that has searched --plugin-path, the folder Plugins beside the program and the
   search path, and describes plugins in processes of their own (wo_session_describer). The
   directories, describer, cache and limit of config are replaced, messages of plugins go to stderr
   when it has no message callback. Returns an exit code; *host is NULL unless it is WO_EXIT_OK.
   Prints why not. */
int wo_session_open(const wo_args *args, wo_host_config config, wo_host **host) WO_NODISCARD;

/* Prints the host's notes on stderr; those alone that tell of a plugin that fails. */
void wo_session_notes(const wo_host *host);
void wo_session_failures(const wo_host *host);

/* Unloads the plugins and prints every breach of the rules that they have committed, on stderr;
   returns how many. Instances are gone. Takes NULL. */
size_t wo_session_violations(wo_host *host);

/* Loads a plugin by name; after a miss NULL and a message that says what there is. */
const wo_host_plugin *wo_session_plugin(wo_host *host, const char *name);

/* What main does when the program is started as a describer: argv[1] is this word. */
#define WO_SESSION_DESCRIBER "--describe-binary"

/* Context by name, or with name NULL the one the host takes by itself: General, Filter, Generator.
   NULL and a message when the plugin does not have it. command is the asking one. */
const wo_host_context_info *wo_session_context(const wo_host_plugin *plugin, const char *name,
                                               const char *command);

/* Clips and parameters for people. */
void wo_print_clips(FILE *out, const wo_host_context_info *context);
void wo_print_params(FILE *out, const wo_host_context_info *context);

#endif
