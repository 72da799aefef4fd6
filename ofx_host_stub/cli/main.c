/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "args.h"
#include "bridge/new_file.h"
#include "command.h"
#include "session.h"

#include <stdio.h>
#include <string.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

static const wo_command commands[] = {
    {"list", "every plugin that is found", wo_cmd_list},
    {"describe", "contexts, clips and parameters of a plugin", wo_cmd_describe},
    {"render", "run a plugin on image files", wo_cmd_render},
    {"footage", "make test scenes with depth, layers and a lens reference", wo_cmd_footage},
    {"lens", "what a lens is: data, section, aberrations, bokeh", wo_cmd_lens},
    {"compare", "how far one picture is from another", wo_cmd_compare},
    {"bench", "error against run time of every method", wo_cmd_bench},
    {"sheet", "put pictures side by side under captions", wo_cmd_sheet},
    {"json", "check a JSON file and print values from it", wo_cmd_json},
};

static void print_help(FILE *out)
{
    fputs("WideOpen " WO_VERSION_TEXT ": lenses for pictures that were made without one.\n\n"
          "wideopen COMMAND [options]        wideopen COMMAND --help says more\n\n",
          out);
    for (size_t i = 0; i < WO_COUNT(commands); i++)
        fprintf(out, "  %-10s %s\n", commands[i].name, commands[i].summary);
    fputs("\nPlugins are looked for in --plugin-path, in the folder Plugins beside this program, "
          "in\n"
          "OFX_PLUGIN_PATH and in the system's folder; what is known of them is kept in\n"
          "WIDEOPEN_PLUGIN_CACHE, which may be off.\n"
          "Exit code: 0 done, 1 a render or a file failed, 2 the command line makes no sense, 130\n"
          "interrupted. Messages go to stderr, data to stdout.\n",
          out);
}

/* Planes of one frame go into the memory of those of the last: asking the system for it anew, page
   by page, costs a tenth of a render. */
static void keep_memory(void)
{
#ifdef __GLIBC__
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, -1);
#endif
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], WO_SESSION_DESCRIBER) == 0)
        return wo_host_describer(argc - 2, argv + 2);
    keep_memory();
    wo_interrupt_watch(wo_new_file_remove_all);
    if (argc < 2) {
        print_help(stderr);
        return WO_EXIT_USAGE;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 ||
        strcmp(argv[1], "help") == 0) {
        print_help(stdout);
        return WO_EXIT_OK;
    }
    if (strcmp(argv[1], "--version") == 0) {
        puts("wideopen " WO_VERSION_TEXT);
        return WO_EXIT_OK;
    }
    const char *names[WO_COUNT(commands)];
    for (size_t i = 0; i < WO_COUNT(commands); i++) {
        names[i] = commands[i].name;
        if (strcmp(argv[1], commands[i].name) == 0) {
            int code = commands[i].run(argc - 1, argv + 1);
            if (code == WO_EXIT_OK && wo_interrupted(NULL))
                code = wo_failure(&(wo_error){0}); /* it came when all was nearly done */
            if (fflush(stdout) == 0 && !ferror(stdout))
                return code;
            wo_message("cannot write to standard output: is the disk full or the pipe closed?");
            return code == WO_EXIT_OK ? WO_EXIT_FAILURE : code;
        }
    }
    char near[256];
    const int hits = wo_near_words(argv[1], names, WO_COUNT(names), near, sizeof near);
    wo_message("unknown command \"%s\"; %s %s", argv[1], hits ? "did you mean" : "there are", near);
    wo_message("wideopen --help lists what they do");
    return WO_EXIT_USAGE;
}
