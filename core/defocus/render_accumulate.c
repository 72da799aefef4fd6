/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/accumulate.h"

#include <math.h>

/* Samples of the first batch of adaptive sampling, and of each half of the second estimate. */
enum { FIRST_BATCH = 16 };
/* The standard error of the mean of two halves, as a part of half their difference: lattices of
   samples are better than independent ones. */
#define HALVES_ERROR 0.85
/* Errors are means over blocks of so many px: 16 x 8. */
enum { BLOCK = 16 };

typedef struct accumulate_job {
    wo_accumulate all;
    wo_accumulator *worker; /* one for each */
} accumulate_job;

/* Estimated squared error of blocks of a tile, displayed. Returns the mean over the tile. */
static double estimate(const wo_accumulator *worker, double square[WO_TILE_WIDTH / BLOCK])
{
    double all = 0;
    for (int b = 0; b < WO_TILE_WIDTH / BLOCK; b++) {
        double sum = 0;
        for (int i = 0; i < BLOCK * WO_TILE_HEIGHT; i++) {
            float c[2][4];
            float guessed;
            for (int half = 0; half < 2; half++)
                wo_accumulate_mean(worker, half, b * BLOCK + i % BLOCK, i / BLOCK, c[half],
                                   &guessed);
            for (int k = 0; k < 3; k++) {
                const double d =
                    0.5 * HALVES_ERROR * (double)(wo_display(c[0][k]) - wo_display(c[1][k]));
                sum += d * d / 3;
            }
        }
        square[b] = sum / (BLOCK * WO_TILE_HEIGHT);
        all += square[b] / (WO_TILE_WIDTH / BLOCK);
    }
    return all;
}

/* Moves the second half into the first. */
static void join_halves(wo_accumulator *worker)
{
    for (int level = 0; level <= worker->level_used; level++) {
        float *const to = worker->sums[0][level].plane[0];
        float *const from = worker->sums[1][level].plane[0];
        for (size_t i = 0; i < sizeof worker->sums[0][0] / sizeof *to; i++) {
            to[i] += from[i];
            from[i] = 0;
        }
    }
}

/* Colour straight through the pixel, where no ray of some colour saw anything. */
static void straight_through(const wo_stack *stack, int32_t x, int32_t y, float c[4])
{
    const ptrdiff_t at = wo_stack_at(stack, x, y);
    float best = -INFINITY;
    for (int s = 0; s < stack->sheets; s++) {
        if (!(stack->v[s][at] > best))
            continue;
        best = stack->v[s][at];
        for (int k = 0; k < 4; k++)
            c[k] = stack->c[s][k][at];
    }
}

static void store(const wo_defocus *scene, const wo_accumulator *worker, int32_t tx, int32_t ty,
                  int samples, wo_tile_pixels *pixels)
{
    for (int32_t y = 0; y < WO_TILE_HEIGHT; y++) {
        for (int32_t x = 0; x < WO_TILE_WIDTH; x++) {
            float *c = pixels->c[y][x];
            float guessed;
            if (!wo_accumulate_mean(worker, 2, x, y, c, &guessed)) {
                float through[4] = {0};
                straight_through(scene->stack, tx * WO_TILE_WIDTH + x, ty * WO_TILE_HEIGHT + y,
                                 through);
                for (int k = 0; k < 4; k++)
                    c[k] = c[k] != 0 ? c[k] : through[k];
            }
            pixels->guessed[y][x] = fminf(guessed / (float)samples, 1);
        }
    }
}

static void tell(wo_tile_facts *facts, float rays, const double square[WO_TILE_WIDTH / BLOCK])
{
    for (int32_t y = 0; y < WO_TILE_HEIGHT; y++) {
        for (int32_t x = 0; x < WO_TILE_WIDTH; x++) {
            facts->rays[y][x] = rays;
            facts->error[y][x] = (float)sqrt(square[x / BLOCK]);
        }
    }
}

static bool accumulate_tile(void *user, int32_t tx, int32_t ty, unsigned index,
                            wo_tile_pixels *pixels, wo_tile_facts *facts, wo_report *part)
{
    const accumulate_job *job = user;
    const wo_accumulate *all = &job->all;
    const wo_defocus *scene = all->scene;
    wo_accumulator *worker = &job->worker[index];
    const wo_tile_class class = wo_lens_rays_at(scene->rays, tx, ty)->class;
    double square[WO_TILE_WIDTH / BLOCK] = {0};
    if (class == WO_TILE_EMPTY || class == WO_TILE_SHARP) {
        if (!wo_lens_rays_tile(scene->rays, scene->context, tx, ty, pixels, part))
            return false;
        tell(facts, class == WO_TILE_SHARP ? 1 : 0, square);
        return true;
    }
    if (!wo_accumulate_begin(all, worker, tx, ty))
        return false;
    /* Every batch is spread evenly over the lens, and the later ones are as large as all before
       them: two halves. */
    const int count = scene->lens->count;
    int stride = 2;
    while (scene->quality.adaptive && count / (2 * stride) >= FIRST_BATCH)
        stride *= 2;
    const double target = scene->quality.target_error * scene->quality.target_error;
    worker->writes = 0;
    int samples = 0;
    for (int step = stride; step > 0; step /= 2) {
        const int first = step == stride ? 0 : step;
        const int jump = step == stride ? stride : 2 * step;
        samples = (count + step - 1) / step;
        if (first > 0 && step < stride / 2)
            join_halves(worker);
        const double level = wo_accumulate_level(all, tx, ty, samples);
        if (!wo_accumulate_add(all, worker, tx, ty, first > 0, first, jump, level))
            return false;
        const double pixels_drawn = level * (count - first) / jump;
        worker->spared += pixels_drawn > 0 ? pixels_drawn : 0;
        if (first > 0 && scene->quality.adaptive && estimate(worker, square) <= target)
            break;
    }
    if (!scene->quality.adaptive)
        estimate(worker, square);
    if (count == 1)
        for (int b = 0; b < WO_TILE_WIDTH / BLOCK; b++)
            square[b] = NAN;
    store(scene, worker, tx, ty, samples, pixels);
    wo_tile_highlights(scene, tx, ty, pixels, part);
    tell(facts, (float)samples, square);
    part->tiles[class]++;
    part->rays += (int64_t)samples * WO_TILE_WIDTH * WO_TILE_HEIGHT;
    part->steps += worker->writes;
    return true;
}

static wo_status render(const wo_defocus *scene, const wo_frame *frame, wo_report *report,
                        wo_error *error)
{
    const wo_context *context = scene->context;
    const unsigned workers = wo_workers(context);
    accumulate_job job = {.worker = wo_new(context, error, workers, sizeof *job.worker)};
    if (!job.worker)
        return WO_ERR_NOMEM;
    wo_status status = wo_accumulate_create(scene, &job.all, error);
    for (unsigned i = 0; status == WO_OK && i < workers; i++)
        status = wo_accumulator_create(context, scene->lens->count, &job.worker[i], error);
    if (status == WO_OK)
        status = wo_frame_tiles(scene, frame, 0, 1, accumulate_tile, &job, report, error);
    double reused = 0;
    double coarser = 0;
    for (unsigned i = 0; i < workers; i++) {
        if (job.worker[i].no_memory && status == WO_ABORTED)
            status = wo_fail(error, WO_ERR_NOMEM, "no memory for the thin pixels of a tile");
        reused += (double)job.worker[i].reused;
        coarser += job.worker[i].spared;
        wo_accumulator_destroy(context, &job.worker[i]);
    }
    if (status == WO_OK && reused > 0)
        wo_report_leave_out(report, "views of tiles", "another sample lands on the same raster",
                            reused, "views");
    if (status == WO_OK && coarser > 0)
        wo_report_leave_out(report, "pixels of views", "a coarser level is fine enough", coarser,
                            "pixels");
    wo_accumulate_destroy(&job.all);
    wo_delete(context, job.worker);
    return status;
}

const wo_renderer wo_render_accumulate = {
    .key = "accumulate", .label = "Accumulate", .estimates = true, .render = render};
