/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* How the time of the method spread grows with the radius: one table on stdout, and the exponent of
   the line through log(time) over log(radius). One distance, everything blurred alike, the stage of
   rendering alone: point spreads, sorting, spreading, laying. Best of several. */
#include "bench_args.h"
#include "defocus/renderer.h"
#include "tests/property/scenes.h"

#include <stdio.h>
#include <stdlib.h>

static wo_image noise(wo_rect extent)
{
    wo_image out = picture_make(extent, 4);
    rng r = {1};
    for (int32_t i = 0; i < 4 * wo_rect_width(extent) * wo_rect_height(extent); i++)
        out.data[i] = i % 4 == 3 ? 1 : (float)rng_unit(&r);
    return out;
}

static double measure(const wo_context *context, wo_rect extent, double radius, int method,
                      int repeats)
{
    scene s;
    scene_init(&s, extent);
    s.params.method = method;
    s.params.samples = 64;
    s.params.focus_distance = 2;
    s.params.max_radius = 400;
    scene_px_per_dioptre(&s, 4 * radius);
    s.clip[WO_CLIP_SOURCE] = noise(extent);
    picture_fill(scene_clip(&s, WO_CLIP_DEPTH, 1), (const float[1]){4});
    double best = 1e30;
    for (int i = 0; i < repeats; i++) {
        wo_image out = picture_make(extent, 4);
        wo_report report = {0};
        wo_error error = {WO_OK, ""};
        if (scene_run(&s, context, extent, &out, &report, &error) != WO_OK) {
            fprintf(stderr, "bench_spread: %s\n", error.text);
            exit(1);
        }
        if (fabs(report.largest_radius / radius - 1) > 0.01) {
            fprintf(stderr, "bench_spread: radius %g, not %g\n", report.largest_radius, radius);
            exit(1);
        }
        best = fmin(best, report.seconds[WO_STAGE_RENDER]);
        picture_free(&out);
    }
    scene_free(&s);
    return best;
}

int main(int argc, char **argv)
{
    static const double radii[] = {25, 50, 100, 200};
    const bench_args args = bench_args_read("bench_spread", argc, argv, 960, 3);
    wo_context context = WO_CONTEXT_INIT;
    context.runner = threads_runner(&args.threads);
    const wo_rect extent = {0, 0, args.width, args.width * 9 / 16};
    printf("%u threads, %d x %d px\n", args.threads, extent.x2, extent.y2);
    double sums[4] = {0};
    for (size_t i = 0; i < WO_COUNT(radii); i++) {
        const double t = measure(&context, extent, radii[i], WO_METHOD_SPREAD, args.repeats);
        const double x = log(radii[i]);
        const double y = log(t);
        printf("radius %5.0f px %8.3f s\n", radii[i], t);
        fflush(stdout);
        sums[0] += x;
        sums[1] += y;
        sums[2] += x * x;
        sums[3] += x * y;
    }
    const double n = WO_COUNT(radii);
    printf("time grows as radius^%.3f\n",
           (n * sums[3] - sums[0] * sums[1]) / (n * sums[2] - sums[0] * sums[0]));
    return 0;
}
