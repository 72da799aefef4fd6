/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_BENCH_H
#define WO_CLI_BENCH_H

#include "json.h"
#include "plot.h"
#include "wideopen/status.h"

#include <stdio.h>

/* Error against run time: the results of `wideopen bench`, what follows from them, and how they are
   written. A shot is one scene with what the plugin is given of it; a point is one method with one
   setting on a shot. Errors are root mean squares of the displayed value (sRGB curve, 0..1). */

enum { WO_BENCH_METHODS = 16, WO_BENCH_SETTINGS = 24, WO_BENCH_RUNS = 16 };

typedef struct wo_bench_setting {
    bool adaptive;
    double value;  /* rays of each pixel, or the target error */
    char text[24]; /* "64", "0.004" */
} wo_bench_setting;

typedef enum wo_bench_state {
    WO_BENCH_WAITING,
    WO_BENCH_DONE,
    WO_BENCH_FAILED,
    WO_BENCH_LEFT_OUT /* the method does not have it */
} wo_bench_state;

typedef struct wo_bench_point {
    wo_bench_state state;
    char why[256];             /* it failed or was left out */
    int runs;                  /* finished; run k renders with seed k */
    double seconds;            /* by the clock of the bench, best of the runs, as the next three */
    double wall_seconds;       /* of the render action, planning included */
    double cpu_seconds;        /* of all threads together */
    double own_seconds;        /* as the plugin reports it; NAN = unknown */
    double rays;               /* mean of the runs, as the rest; NAN = unknown */
    double rmse, ssim, relmse; /* against the reference; rmse: root of the mean square */
    double estimate;           /* the method's own idea of its sampling error; NAN = none */
    double sampling;           /* against its own converged picture; NAN = not known */
    double ratio[WO_BENCH_RUNS]; /* sampling / estimate of each run; NAN = not known */
} wo_bench_point;

typedef struct wo_bench_shot {
    char scene[64];
    bool layers;          /* all layers are given; else one picture with its depth */
    wo_bench_state state; /* FAILED: no point was rendered; LEFT_OUT: there are no layers */
    char why[256];
    int width, height, given; /* px; number of layers given */
    double noise;             /* standard error of the reference; NAN = unknown */
    wo_bench_point *points;   /* [method_count * setting_count], method by method */
} wo_bench_shot;

typedef struct wo_bench {
    const char *plugin;
    unsigned version[2], threads;
    int runs, converged, crop;
    bool cpu_clock;        /* times are those of all processors together, not of the wall's clock */
    double time_tolerance; /* a part of a time that counts as noise of the clock */
    char method[WO_BENCH_METHODS][32];
    int method_count;
    wo_bench_setting setting[WO_BENCH_SETTINGS];
    int setting_count;
    int judged;             /* the method all others are held against; -1 = none */
    int base, base_setting; /* rays 256; -1 = not among the points */
    wo_bench_shot *shots;
    int shot_count;
} wo_bench;

/* An error is reached when it is exceeded by no more than this part of it. */
#define WO_BENCH_REACHED 0.01
/* Estimates are good within this factor. */
#define WO_BENCH_CALIBRATED 1.25

const wo_bench_point *wo_bench_at(const wo_bench *bench, const wo_bench_shot *shot, int method,
                                  int setting);
const char *wo_bench_given(const wo_bench_shot *shot); /* "layers", "sd" */
const char *wo_bench_state_text(wo_bench_state state); /* "done" ... */
double wo_bench_psnr(double rmse);                     /* dB; infinite for 0 */

/* ------------------------------------------------------------------------------- what follows */

/* Number of a finished point of another method that has no more error in less time than a point,
   the time by more than the tolerance; -1 when there is none. */
int wo_bench_beaten(const wo_bench *bench, const wo_bench_shot *shot, int point);

/* True when no other point at all is better in error or time and not worse in the other, tolerance
   aside. */
bool wo_bench_on_front(const wo_bench *bench, const wo_bench_shot *shot, int point);

/* Seconds in which a method reaches an error, along straight lines
   between its best points in a diagram with logarithmic axes; its first point's seconds when that
   is better; infinite when no point is that good; NAN when there are no points. */
double wo_bench_time_at(const wo_bench *bench, const wo_bench_shot *shot, int method, double error);

/* A shot as the judged method sees it; points is 0 where no other method finished. */
typedef struct wo_bench_verdict {
    int points, unbeaten; /* finished ones, those that none of the others beats */
    double share;         /* time at the error of rays 256 over the time of rays 256; NAN */
} wo_bench_verdict;
wo_bench_verdict wo_bench_judge(const wo_bench *bench, const wo_bench_shot *shot);

/* All shots that are given the same. */
typedef struct wo_bench_summary {
    int shots;    /* with a verdict */
    int on_front; /* whose points are all unbeaten */
    int compared; /* with a share */
    int halved;   /* with a share of at most a half */
} wo_bench_summary;
wo_bench_summary wo_bench_sum(const wo_bench *bench, bool layers);

/* Renders with an estimate and a known sampling error; method -1 = all. */
typedef struct wo_bench_calibration {
    int renders, within;      /* within the factor */
    double low, median, high; /* of sampling / estimate; NAN without renders */
} wo_bench_calibration;
wo_bench_calibration wo_bench_calibrate(const wo_bench *bench, int method);

/* How many points failed. */
int wo_bench_failures(const wo_bench *bench);

/* --------------------------------------------------------------------------------- as texts */

/* A number with up to 7 digits, with a point in every locale; "" for what is not finite. */
char *wo_bench_number(char *text, size_t size, double value);

/* What is on the front of a shot, and how the judged method does. */
void wo_bench_sentence(const wo_bench *bench, const wo_bench_shot *shot, char *text, size_t size);
/* The whole run in a few lines, each ended by a line feed. */
void wo_bench_conclusion(const wo_bench *bench, char *text, size_t size);

void wo_bench_table(const wo_bench *bench, FILE *out);
void wo_bench_csv(const wo_bench *bench, FILE *out);
void wo_bench_json(const wo_bench *bench, FILE *out);

/* Error over time of one shot; the caller frees svg whatever becomes of it. */
WO_NODISCARD wo_status wo_bench_plot(const wo_bench *bench, const wo_bench_shot *shot, wo_svg *svg,
                                     wo_error *error);
/* Plots, tables and sentences on one page that needs no other file. */
WO_NODISCARD wo_status wo_bench_page(const wo_bench *bench, FILE *out, wo_error *error);

#endif
