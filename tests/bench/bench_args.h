/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TESTS_BENCH_ARGS_H
#define WO_TESTS_BENCH_ARGS_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* What the small benches are told: threads, width of a 16:9 picture in px, repeats. */
typedef struct bench_args {
    unsigned threads;
    int width, repeats;
} bench_args;

/* Arguments over the defaults of width and repeats, every processor; a mistake ends the program. */
static inline bench_args bench_args_read(const char *name, int argc, char **argv, int width,
                                         int repeats)
{
    bench_args args = {(unsigned)sysconf(_SC_NPROCESSORS_ONLN), width, repeats};
    for (int i = 1; i < argc; i += 2) {
        const int value = i + 1 < argc ? atoi(argv[i + 1]) : 0;
        if (value > 0 && strcmp(argv[i], "--threads") == 0) {
            args.threads = (unsigned)value;
        } else if (value > 0 && strcmp(argv[i], "--width") == 0) {
            args.width = value;
        } else if (value > 0 && strcmp(argv[i], "--repeats") == 0) {
            args.repeats = value;
        } else {
            fprintf(stderr, "usage: %s [--threads N] [--width PX] [--repeats N]\n", name);
            exit(2);
        }
    }
    return args;
}

#endif
