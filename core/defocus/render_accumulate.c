/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/accumulate.h"
#include "defocus/adaptive.h"

#include <math.h>

/* Errors are told by blocks of so many px: 16 x 8. */
enum { BLOCK = 16, BLOCKS = WO_TILE_WIDTH / BLOCK };

typedef struct accumulate_job {
    wo_accumulate all;
    wo_accumulator *worker; /* one for each */
} accumulate_job;

/* Variances of the blocks of a tile, in the displayed value. Returns their mean. */
static double noise_of(const wo_accumulator *worker, wo_tile_light light, double square[BLOCKS])
{
    wo_noise noise = {0};
    double all = 0;
    for (int b = 0; b < BLOCKS; b++) {
        double sum = 0;
        for (int i = 0; i < BLOCK * WO_TILE_HEIGHT; i++) {
            float c[2][4];
            float guessed;
            bool known = true;
            for (int half = 0; half < 2; half++)
                known &= wo_accumulate_mean(worker, half, b * BLOCK + i % BLOCK, i / BLOCK, c[half],
                                            &guessed);
            if (known)
                sum += (double)wo_noise_add(&noise, c[0], c[1],
                                            light[i / BLOCK][b * BLOCK + i % BLOCK]);
        }
        square[b] = sum / (BLOCK * WO_TILE_HEIGHT);
    }
    const double factor = wo_noise_factor(&noise);
    for (int b = 0; b < BLOCKS; b++) {
        square[b] *= factor;
        all += square[b] / BLOCKS;
    }
    return all;
}

static void store(const wo_defocus *scene, const wo_accumulator *worker, int32_t tx, int32_t ty,
                  double light, wo_tile_pixels *pixels)
{
    for (int32_t y = 0; y < WO_TILE_HEIGHT; y++) {
        for (int32_t x = 0; x < WO_TILE_WIDTH; x++) {
            float *c = pixels->c[y][x];
            float guessed;
            if (!wo_accumulate_mean(worker, 2, x, y, c, &guessed)) {
                float through[4] = {0};
                wo_stack_straight(scene->stack, tx * WO_TILE_WIDTH + x, ty * WO_TILE_HEIGHT + y,
                                  through);
                for (int k = 0; k < 4; k++)
                    c[k] = c[k] != 0 ? c[k] : through[k];
            }
            pixels->guessed[y][x] = fminf(guessed / (float)light, 1);
        }
    }
}

static void tell(wo_tile_facts *facts, float rays, const double square[BLOCKS])
{
    for (int32_t y = 0; y < WO_TILE_HEIGHT; y++) {
        for (int32_t x = 0; x < WO_TILE_WIDTH; x++) {
            facts->rays[y][x] = rays;
            facts->error[y][x] = (float)sqrt(square[x / BLOCK]);
        }
    }
}

/* Views until the error is small enough (adaptive.h); *light: what one sample would sum up to. */
static bool sample(const wo_accumulate *all, wo_accumulator *worker, int32_t tx, int32_t ty,
                   wo_tile_light highlights, int *rays, double *light, double square[BLOCKS])
{
    const wo_defocus *scene = all->scene;
    const wo_quality *quality = &scene->quality;
    *rays = 0;
    *light = 0;
    int level = 0;
    for (unsigned pass = 0;; pass++) {
        const wo_lens *lens = quality->adaptive ? &scene->levels[level] : scene->lens;
        const double scale = quality->adaptive ? pow((double)lens->count / scene->levels[0].count,
                                                     WO_LATTICE_POWER - 1)
                                               : 1;
        if (!wo_accumulate_add(all, worker, lens, pass, tx, ty, scale))
            return false;
        *rays += lens->count;
        *light += scale * lens->count;
        const double e = WO_ERROR_SIGMAS * sqrt(noise_of(worker, highlights, square));
        if (!quality->adaptive || e <= quality->target_error)
            return true;
        const double too_large = quality->target_error > 0 ? e / quality->target_error : INFINITY;
        level = wo_next_level(scene, level, *rays, too_large);
        if (level < 0)
            return true;
    }
}

static bool accumulate_tile(void *user, int32_t tx, int32_t ty, unsigned index,
                            wo_tile_pixels *pixels, wo_tile_facts *facts, wo_report *part)
{
    const accumulate_job *job = user;
    const wo_accumulate *all = &job->all;
    const wo_defocus *scene = all->scene;
    wo_accumulator *worker = &job->worker[index];
    const wo_ray_tile *tile = wo_lens_rays_at(scene->rays, tx, ty);
    const bool straight = wo_ray_tile_straight(tile);
    double square[BLOCKS] = {0};
    if (tile->class == WO_TILE_EMPTY || straight) {
        tell(facts, straight ? 1 : 0, square);
        return wo_lens_rays_tile(scene->rays, scene->context, tx, ty, pixels, part);
    }
    wo_tile_light highlights;
    int rays;
    double light;
    const bool lit = wo_tile_find_light(scene, tx, ty, highlights, part);
    worker->writes = 0;
    if (!wo_accumulate_begin(all, worker, tx, ty) ||
        !sample(all, worker, tx, ty, highlights, &rays, &light, square))
        return false;
    for (int b = 0; rays == 1 && b < BLOCKS; b++)
        square[b] = NAN;
    store(scene, worker, tx, ty, light, pixels);
    if (lit)
        wo_tile_add_light(pixels, highlights);
    tell(facts, (float)rays, square);
    part->tiles[tile->class]++;
    part->rays += (int64_t)rays * WO_TILE_WIDTH * WO_TILE_HEIGHT;
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
    int most = scene->lens->count;
    for (int i = 0; i < scene->level_count; i++)
        most = scene->levels[i].count > most ? scene->levels[i].count : most;
    wo_status status = wo_accumulate_create(scene, &job.all, error);
    for (unsigned i = 0; status == WO_OK && i < workers; i++)
        status = wo_accumulator_create(context, most, &job.worker[i], error);
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
