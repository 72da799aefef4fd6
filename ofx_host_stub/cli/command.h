/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_COMMAND_H
#define WO_CLI_COMMAND_H

#include "wideopen/status.h"

#include <stdio.h>

/* The frame of the program: a table of commands, each one function in cmd_<name>.c. */

/* What a command returns: the exit code of the program. */
enum {
    WO_EXIT_OK = 0,
    WO_EXIT_FAILURE = 1,      /* a render or a file failed */
    WO_EXIT_USAGE = 2,        /* the command line makes no sense */
    WO_EXIT_INTERRUPTED = 130 /* stopped by an interrupt; half-written files are removed */
};

typedef struct wo_command {
    const char *name;                  /* first word of the command line */
    const char *summary;               /* one line for the list of commands */
    int (*run)(int argc, char **argv); /* argv[0] is the name; returns an exit code */
} wo_command;

int wo_cmd_list(int argc, char **argv);
int wo_cmd_describe(int argc, char **argv);
int wo_cmd_render(int argc, char **argv);
int wo_cmd_footage(int argc, char **argv);
int wo_cmd_lens(int argc, char **argv);
int wo_cmd_compare(int argc, char **argv);
int wo_cmd_bench(int argc, char **argv);
int wo_cmd_sheet(int argc, char **argv);
int wo_cmd_json(int argc, char **argv);

/* Writes text that may come from a file: bytes that would steer a terminal, and such that are no
   UTF-8, become \x1b; lines and tabs stay. */
void wo_put_clean(const char *text, FILE *out);

/* One line on stderr by wo_put_clean, with the program's name before it; data goes to stdout by
   printf. Any thread. */
void wo_message(const char *format, ...) WO_PRINTF(1, 2);

/* The same for a mistake on the command line of command; points to its --help; gives
   WO_EXIT_USAGE. */
int wo_usage_fault(const char *command, const char *format, ...) WO_PRINTF(2, 3);

/* Prints error->text as a message; gives WO_EXIT_FAILURE, or WO_EXIT_INTERRUPTED after an
   interrupt. */
int wo_failure(const wo_error *error);

/* From now on what ends the program by a signal (an interrupt, a closed terminal, a farm's term)
   first calls clean_up, which must be safe in a signal handler. Signals that are ignored already
   (nohup) stay so; a file that may not grow is an error of writing. Host thread only. */
void wo_interrupt_watch(void (*clean_up)(void));

/* From the first call on, SIGINT, SIGTERM and SIGHUP set a flag instead of ending the program;
   another one a moment later ends it at once. Host thread only. */
void wo_interrupt_catch(void);

/* True after an interrupt. user is ignored, so that it fits every abort callback. Any thread. */
bool wo_interrupted(void *user);

/* A bar on stderr, drawn by wo_bar_move (fraction 0..1) and only when shown is true; wo_bar_end
   erases it. One call at a time. */
typedef struct wo_bar {
    bool shown;
    int permille; /* what is drawn, -1 = nothing */
    char label[64];
} wo_bar;
void wo_bar_begin(wo_bar *bar, bool shown, const char *label);
void wo_bar_move(wo_bar *bar, double fraction);
void wo_bar_end(wo_bar *bar);

/* What --progress and --no-progress mean: forced on, forced off, else on when stderr is a
   terminal. */
bool wo_bar_wanted(bool forced, bool forbidden);

#endif
