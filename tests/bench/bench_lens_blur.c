/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* How fast LensBlur is, and how much faster than its slow twin: one table on stdout.

   The twin marches every ray of every pixel by itself in double precision over the whole range of
   depths (march_reference.c), on as many threads; of it only every TWIN_PART-th tile is run and the
   time multiplied. Times are the best of several, planning included unless it says rays. */
#include "blur_footage.h"
#include "effects/lens_blur_plan.h"
#include "tests/property/scenes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { TWIN_PART = 16, THREADS_MAX = 256 };

static int repeats = 3;

static void stop(const wo_error *error)
{
    fprintf(stderr, "bench_lens_blur: %s\n", error->text);
    exit(1);
}

static wo_footage *make(const wo_context *context, const char *name, int width, int height)
{
    wo_footage *set = NULL;
    wo_error error = {0};
    const wo_footage_options options = {
        .scene = name, .width = width, .height = height, .samples = 16, .layers = 4};
    if (wo_footage_make(context, &options, &set, &error) != WO_OK)
        stop(&error);
    return set;
}

typedef struct timing {
    double total;  /* s, planning and rendering */
    double render; /* s, rays */
    double rays;   /* count */
} timing;

static timing measure(const wo_context *context, const wo_footage *set, int layers, int samples)
{
    timing best = {1e30, 1e30, 0};
    for (int i = 0; i < repeats; i++) {
        wo_image out;
        wo_report report = {0};
        wo_error error = {0};
        const double start = wo_seconds();
        if (blur_footage(context, set, layers, samples, &out, &report, &error) != WO_OK)
            stop(&error);
        const double total = wo_seconds() - start;
        free(out.data);
        best.total = total < best.total ? total : best.total;
        const double render = report.seconds[WO_STAGE_RENDER];
        best.render = render < best.render ? render : best.render;
        best.rays = (double)report.rays;
    }
    return best;
}

typedef struct twin_job {
    const wo_plan *plan;
    const wo_lens_rays *rays;
} twin_job;

static void twin_tile(void *user, size_t index, unsigned number)
{
    (void)number;
    const twin_job *t = user;
    const size_t tile = index * TWIN_PART + (index * 7) % TWIN_PART;
    const size_t columns = (size_t)wo_rect_width(t->rays->tiles);
    if (tile >= columns * (size_t)wo_rect_height(t->rays->tiles))
        return;
    wo_tile_pixels pixels;
    wo_report report = {0};
    (void)wo_lens_rays_tile(t->rays, &t->plan->context,
                            t->rays->tiles.x1 + (int32_t)(tile % columns),
                            t->rays->tiles.y1 + (int32_t)(tile / columns), &pixels, &report);
}

/* Seconds of the twin for the whole picture: the same scene with every tile marched over the range
   of all depths, one pixel at a time. */
static double measure_twin(const wo_context *context, const wo_footage *set, int layers,
                           int samples)
{
    wo_lens_blur_params params;
    wo_image inputs[WO_LENS_BLUR_CLIPS];
    wo_plan_args args;
    wo_plan *plan = NULL;
    wo_error error = {0};
    blur_footage_setup(set, layers, samples, &params, inputs, &args);
    if (wo_lens_blur_plan_create(context, &params, &args, &plan, &error) != WO_OK)
        stop(&error);
    wo_lens_rays *rays = &plan->rays;
    const size_t tiles = (size_t)wo_rect_width(rays->tiles) * (size_t)wo_rect_height(rays->tiles);
    wo_bounds all[WO_SHEETS_MAX];
    for (int s = 0; s < plan->stack.sheets; s++) {
        unsigned flags = 0;
        all[s] = wo_stack_bounds(&plan->stack, s, plan->stack.area, &flags);
    }
    rays->kernels = &wo_march_reference;
    for (size_t i = 0; i < tiles; i++) {
        rays->tile[i].class = WO_TILE_MARCH;
        memcpy(rays->tile[i].bounds, all, sizeof all);
    }
    twin_job t = {plan, rays};
    const double start = wo_seconds();
    wo_run(context, twin_tile, &t, (tiles + TWIN_PART - 1) / TWIN_PART);
    const double seconds = (wo_seconds() - start) * TWIN_PART;
    wo_lens_blur_plan_destroy(&plan);
    return seconds;
}

static void row(const char *name, const wo_footage *set, int layers, int samples, timing t)
{
    char given[24] = "source+depth";
    if (layers > 0)
        snprintf(given, sizeof given, "%d layers", layers);
    printf("%-12s %5d x %-5d %-13s %5d rays %8.3f s %8.3f s rays %7.1f M rays/s\n", name,
           wo_rect_width(set->colour.bounds), wo_rect_height(set->colour.bounds), given, samples,
           t.total, t.render, t.rays / t.render / 1e6);
    fflush(stdout);
}

int main(int argc, char **argv)
{
    unsigned threads = (unsigned)sysconf(_SC_NPROCESSORS_ONLN);
    const char *name = "still-life";
    int width = 1920;
    bool quick = false;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--threads") == 0 && i + 1 < argc) {
            threads = (unsigned)strtoul(argv[++i], NULL, 10);
        } else if (strcmp(argv[i], "--scene") == 0 && i + 1 < argc) {
            name = argv[++i];
        } else if (strcmp(argv[i], "--repeats") == 0 && i + 1 < argc) {
            repeats = atoi(argv[++i]);
        } else if (strcmp(argv[i], "--width") == 0 && i + 1 < argc) {
            width = atoi(argv[++i]);
        } else if (strcmp(argv[i], "--quick") == 0) {
            quick = true;
        } else {
            fprintf(stderr, "usage: bench_lens_blur [--threads N] [--scene NAME] [--width PX] "
                            "[--repeats N] [--quick]\n");
            return 2;
        }
    }
    if (repeats < 1)
        repeats = 1;
    if (threads < 1 || threads > THREADS_MAX)
        threads = 1;
    wo_context context = WO_CONTEXT_INIT;
    context.runner = threads_runner(&threads);
    wo_footage *hd = make(&context, name, width, width * 9 / 16);
    printf("%u threads, %s\n", threads,
           wo_cpu_detect(WO_CPU_AUTO) & WO_CPU_AVX2 ? "AVX2" : "plain kernels");

    static const int samples[] = {16, 64, 256};
    static const int layers[] = {0, 1, 2, 4};
    for (size_t i = 0; i < WO_COUNT(layers); i++)
        row(name, hd, layers[i], 64, measure(&context, hd, layers[i], 64));
    if (quick) {
        wo_footage_destroy(&context, &hd);
        return 0;
    }
    for (size_t i = 0; i < WO_COUNT(samples); i++)
        row(name, hd, 2, samples[i], measure(&context, hd, 2, samples[i]));
    static const int sizes[][2] = {{960, 540}, {1920, 1080}, {3840, 2160}};
    for (size_t i = 0; i < WO_COUNT(sizes); i++) {
        wo_footage *set = make(&context, name, sizes[i][0], sizes[i][1]);
        row(name, set, 2, 64, measure(&context, set, 2, 64));
        wo_footage_destroy(&context, &set);
    }
    wo_context base = context;
    base.cpu = WO_CPU_BASE;
    const timing plain = measure(&base, hd, 2, 64);
    printf("plain kernels:");
    row(name, hd, 2, 64, plain);

    const timing fast = measure(&context, hd, 2, 64);
    const double slow = measure_twin(&context, hd, 2, 64);
    printf("twin %.1f s, ours %.3f s: %.1f times faster\n", slow, fast.total, slow / fast.total);
    wo_footage_destroy(&context, &hd);
    return 0;
}
