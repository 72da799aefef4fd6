/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "args.h"
#include "command.h"
#include "json.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static const wo_usage usage = {
    .command = "json",
    .synopsis = "FILE [PATH ...]",
    .about = "Checks that FILE (\"-\": standard input) is one JSON value and prints the values at "
             "the paths on one line with tabs between them, so that scripts need no other tool. A "
             "path is keys and array indices joined by dots; \"-\" is printed where there is no "
             "such value. Strings are printed without their quotes.",
    .positionals = "FILE",
    .positionals_min = 1,
    .positionals_max = 64,
    .after = "Example:\n  wideopen json report.json frames.0.rays frames.0.seconds.render\n",
};

/* The whole stream as a malloc-ed string; NULL when it cannot be read or holds a zero byte. */
static char *read_all(FILE *in)
{
    size_t size = 0, room = 1 << 16;
    char *text = malloc(room);
    while (text) {
        size += fread(text + size, 1, room - 1 - size, in);
        if (size < room - 1)
            break;
        room *= 2;
        char *const more = realloc(text, room);
        if (!more)
            free(text);
        text = more;
    }
    if (!text || ferror(in) || memchr(text, 0, size)) {
        free(text);
        return NULL;
    }
    text[size] = '\0';
    return text;
}

static void print_value(const char *text, const char *path)
{
    const char *begin;
    size_t length;
    if (!wo_json_find(text, path, &begin, &length)) {
        fputs("-", stdout);
    } else {
        const bool string = *begin == '"';
        printf("%.*s", (int)(length - (string ? 2 : 0)), begin + string);
    }
}

static int print_paths(const wo_args *args, const char *text)
{
    if (!wo_json_valid(text)) {
        wo_message("%s is not valid JSON", args->positionals[0]);
        return WO_EXIT_FAILURE;
    }
    for (int i = 1; i < args->positional_count; i++) {
        if (i > 1)
            putchar('\t');
        print_value(text, args->positionals[i]);
    }
    if (args->positional_count > 1)
        putchar('\n');
    return WO_EXIT_OK;
}

static int run(const wo_args *args)
{
    const char *const path = args->positionals[0];
    const bool standard = strcmp(path, "-") == 0;
    FILE *const in = standard ? stdin : fopen(path, "rb");
    if (!in) {
        wo_message("cannot open %s: %s", path, strerror(errno));
        return WO_EXIT_FAILURE;
    }
    char *const text = read_all(in);
    if (!standard)
        fclose(in);
    if (!text) {
        wo_message("cannot read %s as text", path);
        return WO_EXIT_FAILURE;
    }
    const int code = print_paths(args, text);
    free(text);
    return code;
}

int wo_cmd_json(int argc, char **argv)
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
