/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* What a scene costs that needs nothing: all in focus, against copies of the same picture by as
   many threads. One table on stdout, best of several, each into memory that was written before. */
#include "bench_args.h"
#include "defocus/sheet.h"
#include "effects/lens_blur_plan.h"
#include "tests/property/scenes.h"

#include <stdio.h>
#include <string.h>

typedef struct copy_job {
    const wo_image *from, *to;
} copy_job;

static void copy_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const copy_job *job = user;
    const wo_rect r = job->from->bounds;
    const int32_t y = r.y1 + (int32_t)index;
    memcpy(wo_image_at(job->to, r.x1, y), wo_image_at(job->from, r.x1, y),
           (size_t)wo_rect_width(r) * 4 * sizeof(float));
}

/* As every effect reads: clean and premultiplied. */
static void read_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const copy_job *job = user;
    const wo_rect r = job->from->bounds;
    const int32_t y = r.y1 + (int32_t)index;
    for (int32_t x = r.x1; x < r.x2; x++)
        (void)wo_read_colour(job->from, WO_ALPHA_PREMULTIPLIED, x, y, wo_image_at(job->to, x, y));
}

int main(int argc, char **argv)
{
    const bench_args args = bench_args_read("bench_copy", argc, argv, 1920, 20);
    wo_context context = WO_CONTEXT_INIT;
    context.runner = threads_runner(&args.threads);
    const wo_rect extent = {0, 0, args.width, args.width * 9 / 16};
    const size_t rows = (size_t)wo_rect_height(extent);
    scene s;
    scene_init(&s, extent);
    scene_px_per_dioptre(&s, 0.02);
    scene_fill_busy(&s, 1);
    wo_image out = picture_make(extent, 4);
    copy_job job = {&s.clip[0], &out};
    enum { MEMCPY, READ, LENS_BLUR, ROWS };
    double best[ROWS] = {1e30, 1e30, 1e30};
    for (int i = 0; i < args.repeats; i++) {
        double start = wo_seconds();
        wo_run(&context, copy_row, &job, rows);
        best[MEMCPY] = fmin(best[MEMCPY], wo_seconds() - start);
        start = wo_seconds();
        wo_run(&context, read_row, &job, rows);
        best[READ] = fmin(best[READ], wo_seconds() - start);
        wo_report report = {0};
        wo_error error = {WO_OK, ""};
        start = wo_seconds();
        if (scene_run(&s, &context, extent, &out, &report, &error) != WO_OK) {
            fprintf(stderr, "bench_copy: %s\n", error.text);
            return 1;
        }
        best[LENS_BLUR] = fmin(best[LENS_BLUR], wo_seconds() - start);
        if (report.rays > 0 || report.tiles[WO_TILE_MARCH] > 0) {
            fprintf(stderr, "bench_copy: the scene is not all in focus\n");
            return 1;
        }
    }
    static const char *const names[ROWS] = {"memcpy of the picture", "reading it, clean",
                                            "LensBlur, all in focus"};
    printf("%u threads, %d x %d px\n", args.threads, wo_rect_width(extent), wo_rect_height(extent));
    for (int i = 0; i < ROWS; i++)
        printf("%-24s %7.2f ms %6.2f of memcpy %6.2f of reading\n", names[i], 1e3 * best[i],
               best[i] / best[MEMCPY], best[i] / best[READ]);
    picture_free(&out);
    scene_free(&s);
    return 0;
}
