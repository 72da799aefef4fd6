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

/* What a tile's passes say about its noise. All pixels share the points of a pass, so that one pass
   is one draw of chance: the squares of all passes are added up, not their differences. */
typedef struct tile_noise {
    wo_tile_light light;
    double weight;                                   /* of the passes: what one sample sums up to */
    float last[WO_TILE_HEIGHT][WO_TILE_WIDTH][3];    /* weight times half the halves' difference */
    float squares[WO_TILE_HEIGHT][WO_TILE_WIDTH][3]; /* of what each pass added to it */
    double variance[BLOCKS];                         /* displayed */
} tile_noise;

/* Two halves of a pixel that differ by what the passes together say, after another one. False where
   nothing is known. */
static bool look_at(const wo_accumulator *worker, tile_noise *t, int x, int y, float a[3],
                    float b[3])
{
    float c[2][4];
    float guessed;
    if (!wo_accumulate_mean(worker, 0, x, y, c[0], &guessed) ||
        !wo_accumulate_mean(worker, 1, x, y, c[1], &guessed))
        return false;
    for (int k = 0; k < 3; k++) {
        const float now = (float)t->weight * 0.5f * (c[1][k] - c[0][k]);
        const float step = now - t->last[y][x][k];
        t->last[y][x][k] = now;
        t->squares[y][x][k] += step * step;
        const float d = sqrtf(t->squares[y][x][k]) / (float)t->weight;
        const float mean = 0.5f * (c[0][k] + c[1][k]);
        a[k] = mean - d;
        b[k] = mean + d;
    }
    return true;
}

/* After a pass. Returns the mean variance of the tile. */
static double noise_of(const wo_accumulator *worker, tile_noise *t)
{
    wo_noise noise = {0};
    double all = 0;
    for (int block = 0; block < BLOCKS; block++) {
        double sum = 0;
        for (int i = 0; i < BLOCK * WO_TILE_HEIGHT; i++) {
            const int x = block * BLOCK + i % BLOCK;
            const int y = i / BLOCK;
            float a[3];
            float b[3];
            if (look_at(worker, t, x, y, a, b))
                sum += (double)wo_noise_add(&noise, a, b, t->light[y][x]);
        }
        t->variance[block] = sum / (BLOCK * WO_TILE_HEIGHT);
    }
    const double factor = wo_noise_factor(&noise);
    for (int block = 0; block < BLOCKS; block++) {
        t->variance[block] *= factor;
        all += t->variance[block] / BLOCKS;
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

static void tell(wo_tile_facts *facts, float rays, const double variance[BLOCKS])
{
    for (int32_t y = 0; y < WO_TILE_HEIGHT; y++) {
        for (int32_t x = 0; x < WO_TILE_WIDTH; x++) {
            facts->rays[y][x] = rays;
            facts->error[y][x] = (float)sqrt(variance[x / BLOCK]);
        }
    }
}

/* Views until the error is small enough (adaptive.h). */
static bool sample(const wo_accumulate *all, wo_accumulator *worker, int32_t tx, int32_t ty,
                   int *rays, tile_noise *noise)
{
    const wo_defocus *scene = all->scene;
    const wo_quality *quality = &scene->quality;
    *rays = 0;
    int level = 0;
    for (unsigned pass = 0;; pass++) {
        const wo_lens *lens = quality->adaptive ? &scene->levels[level] : scene->lens;
        const double scale = quality->adaptive ? pow((double)lens->count / scene->levels[0].count,
                                                     WO_LATTICE_POWER - 1)
                                               : 1;
        if (!wo_accumulate_add(all, worker, lens, pass, tx, ty, scale))
            return false;
        *rays += lens->count;
        noise->weight += scale * lens->count;
        const double e = WO_ERROR_SIGMAS * sqrt(noise_of(worker, noise));
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
    tile_noise noise = {0};
    if (tile->class == WO_TILE_EMPTY || straight) {
        tell(facts, straight ? 1 : 0, noise.variance);
        return wo_lens_rays_tile(scene->rays, scene->context, tx, ty, pixels, part);
    }
    int rays;
    const bool lit = wo_tile_find_light(scene, tx, ty, noise.light, part);
    worker->writes = 0;
    if (!wo_accumulate_begin(all, worker, tx, ty) || !sample(all, worker, tx, ty, &rays, &noise))
        return false;
    for (int b = 0; rays == 1 && b < BLOCKS; b++)
        noise.variance[b] = NAN;
    store(scene, worker, tx, ty, noise.weight, pixels);
    if (lit)
        wo_tile_add_light(pixels, noise.light);
    tell(facts, (float)rays, noise.variance);
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
