/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_ARGS_H
#define WO_CLI_ARGS_H

#include "wideopen/base.h"

#include <stdio.h>

/* Command lines as tables. A command states its options in one array; parsing, --help and the texts
   of mistakes come from it. "--name value", "--name=value", "-o value" and "-ovalue" are
   understood, "--" ends the options, every command has --help. One thread per object. */

typedef struct wo_option {
    const char *name;     /* "--threads" */
    const char *shorter;  /* "-o", or NULL */
    const char *argument; /* "N"; NULL = a switch */
    const char *help;     /* one or two sentences; wrapped when printed */
    bool repeats;         /* may be given more than once; otherwise that is a mistake */
} wo_option;

typedef struct wo_usage {
    const char *command;     /* "render" */
    const char *synopsis;    /* what follows the command: "PLUGIN [options] -o FILE" */
    const char *about;       /* a paragraph; line feeds start new ones */
    const char *positionals; /* names of the plain words, for mistakes: "PLUGIN" */
    int positionals_min, positionals_max;
    const wo_option *options; /* without --help */
    size_t option_count;
    const char *after; /* printed as it stands at the end of the help; or NULL */
} wo_usage;

typedef struct wo_args {
    const wo_usage *usage;
    bool help; /* --help was given: nothing else is checked */
    int positional_count;
    const char **positionals; /* borrowed from argv */
    int given_count;
    struct wo_given {
        const wo_option *option;
        const char *value; /* NULL for a switch */
    } * given;
} wo_args;

/* Reads argv[1..]; argv stays borrowed until wo_args_free. Returns an exit code: WO_EXIT_OK, or
   WO_EXIT_USAGE or WO_EXIT_FAILURE after printing why. wo_args_free takes what any of these
   left. */
int wo_args_read(wo_args *args, const wo_usage *usage, int argc, char **argv) WO_NODISCARD;
void wo_args_free(wo_args *args);

/* Prints synopsis, text, options and the end of the help. */
void wo_args_help(const wo_usage *usage, FILE *out);

/* How often an option was given; its i-th value, or NULL beyond the last. name is the long name and
   must be in the table. */
int wo_args_count(const wo_args *args, const char *name);
const char *wo_args_value(const wo_args *args, const char *name, int i);

/* Numbers: *value keeps what it holds when the option was not given. False after printing a
   mistake: not a number, or outside min..max. */
bool wo_args_int(const wo_args *args, const char *name, int min, int max, int *value) WO_NODISCARD;
bool wo_args_double(const wo_args *args, const char *name, double min, double max,
                    double *value) WO_NODISCARD;

/* Reads "1,2,3" with exactly count finite numbers; false otherwise, without a message. */
bool wo_read_numbers(const char *text, double *values, int count) WO_NODISCARD;

/* Reads "WxH", both 1..65536; false otherwise, without a message. */
bool wo_read_size(const char *text, int *width, int *height) WO_NODISCARD;

/* Chooses from words the ones that look like word and joins them with ", " into buffer; all of them
   when none does. For "did you mean". Returns the number of near ones. */
int wo_near_words(const char *word, const char *const *words, size_t count, char *buffer,
                  size_t size);

/* Prints text to out, wrapped at 100 columns, every line indented by indent columns; the first line
   continues at column at. Line feeds start new lines. */
void wo_print_wrapped(FILE *out, const char *text, int at, int indent);

#endif
