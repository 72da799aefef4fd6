/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "render.h"

#include <string.h>

/* Distributed ray tracing through the lens (Cook, Porter and Carpenter 1984). Every pixel takes a
   number of independent batches, each a scrambled Sobol set over the pixel's square and the
   aperture; the spread of the batches is the error of their mean.

   A lamp far out of focus is met by few of these rays, and each brings thousands. Where a lamp can
   only be seen through a small part of the aperture, its light is left out of the common rays and
   gathered by rays through that part alone, weighted by its area. */

enum {
    PURPOSE_REFERENCE = 2,
    CHUNK = 64,
    BATCHES_MAX = 16,
    LAMP_RAYS_LEAST = 4 /* of a batch; a lamp gets a quarter of the batch if that is more */
};

/* A part of the aperture is small below this radius. */
#define SMALL_PART 1.0f
/* Of a pixel, with something to spare. */
#define HALF_DIAGONAL 0.7072f

void wo_render_batches(int spp, int *batches, int *rays)
{
    *batches = spp >= 256 ? BATCHES_MAX : BATCHES_MAX / 2;
    *rays = (spp + *batches - 1) / *batches;
}

/* A lamp with rays of its own at one pixel. */
typedef struct spot {
    uint32_t lamp;
    float at[2];  /* px: where the pinhole shows its middle */
    float per_px; /* lens units per px: 1 / (K (v - vf)) */
    float radius; /* of the part of the aperture that may see it from one place of the pixel */
    float u[2];   /* middle of the part seen from the pixel's centre */
    float reach;  /* radius of the parts of all places of the pixel together */
} spot;

typedef struct room {
    wo_ray ray[CHUNK];
    wo_hit hit[CHUNK];
    spot *spots; /* [lamp_count] of the pixel at hand */
    size_t spot_count;
    uint32_t *pixel; /* [lamp_count]: number of the pixel where the lamp last was a spot */
} room;

typedef struct task {
    const wo_scene *scene;
    const wo_camera *camera;
    wo_footage *footage;
    uint32_t (*sobol)[WO_SOBOL_DIMENSIONS]; /* [rays] */
    int batches, rays, lamp_rays;
    float inverse_area;
    room *rooms;
    double *row_squares; /* [height] */
    wo_progress *progress;
} task;

/* A lens point u sees through place x what lies at pinhole place x + K u (v - vf), v = 1/z. Turned
   round, a ball's outline gives the part of the aperture that sees it. The ball's nearest and
   farthest depth and the slant of the view widen it: more than needed is harmless, less would lose
   light. */
static bool find_spot(const wo_camera *camera, const wo_lamp *lamp, float x, float y, spot *out)
{
    const float z = -lamp->centre.z, r = 1.001f * lamp->radius;
    if (z - r <= 1e-3f)
        return false;
    const float k = camera->focal_px * camera->radius;
    const float v = 1 / z, near = 1 / (z - r), far = 1 / (z + r);
    const float least = fminf(fabsf(near - camera->focus), fabsf(far - camera->focus));
    if ((near - camera->focus) * (far - camera->focus) <= 0 || k * least <= 0)
        return false;
    const float px = camera->centre_x + camera->focal_px * lamp->centre.x * v;
    const float py = camera->centre_y + camera->focal_px * lamp->centre.y * v;
    *out = (spot){.lamp = out->lamp, .at = {px, py}, .per_px = 1 / (k * (v - camera->focus))};
    out->u[0] = (px - x) * out->per_px;
    out->u[1] = (py - y) * out->per_px;
    /* Places of all points of the ball lie within this of the centre's, whatever their depth; and
       the division differs over the ball by the same share. */
    const float slant = sqrtf(lamp->centre.x * lamp->centre.x + lamp->centre.y * lamp->centre.y);
    const float place = camera->focal_px * near * r * (1 + (slant + r + camera->radius) * near);
    const float most = fmaxf(fabsf(near - camera->focus), fabsf(far - camera->focus));
    const float own = fabsf(v - camera->focus);
    const float spread = fmaxf(own / least - 1, 1 - own / most);
    const float aside = HALF_DIAGONAL * fabsf(out->per_px);
    out->radius = place / (k * least) +
                  spread * (sqrtf(out->u[0] * out->u[0] + out->u[1] * out->u[1]) + aside);
    out->reach = out->radius + aside;
    return out->reach < SMALL_PART;
}

static void find_spots(const task *t, room *r, int32_t x, int32_t y, uint32_t number)
{
    r->spot_count = 0;
    for (size_t i = 0; i < t->scene->lamp_count; i++) {
        spot found = {.lamp = (uint32_t)i};
        if (!find_spot(t->camera, &t->scene->lamps[i], (float)x + 0.5f, (float)y + 0.5f, &found))
            continue;
        /* Small even if out of reach: then no common ray meets the lamp either. */
        r->pixel[i] = number;
        if (found.u[0] * found.u[0] + found.u[1] * found.u[1] <
            (1 + found.reach) * (1 + found.reach))
            r->spots[r->spot_count++] = found;
    }
}

/* Sums of one batch's common rays. */
static void common_rays(const task *t, room *r, int32_t x, int32_t y, uint32_t key, uint32_t number,
                        float sum[4])
{
    const uint32_t keys[4] = {wo_stir(key, 0), wo_stir(key, 1), wo_stir(key, 2), wo_stir(key, 3)};
    for (int at = 0; at < t->rays; at += CHUNK) {
        const int count = t->rays - at < CHUNK ? t->rays - at : CHUNK;
        for (int i = 0; i < count; i++) {
            const uint32_t *const bits = t->sobol[at + i];
            float u[2];
            wo_camera_aperture(t->camera, wo_scrambled(bits[2], keys[2]),
                               wo_scrambled(bits[3], keys[3]), u);
            r->ray[i] = wo_camera_ray(t->camera, (float)x + wo_scrambled(bits[0], keys[0]),
                                      (float)y + wo_scrambled(bits[1], keys[1]), u[0], u[1]);
        }
        wo_raycast_trace(t->scene->cast, r->ray, r->hit, (size_t)count, WO_RAYS_COHERENT);
        for (int i = 0; i < count; i++) {
            if (r->hit[i].geometry == WO_RAYCAST_NONE)
                continue;
            wo_look look;
            wo_scene_shade(t->scene, &r->ray[i], &r->hit[i], &look);
            if (look.lamp >= 0 && r->pixel[look.lamp] != number)
                wo_scene_add_glow(t->scene, &look, look.rgb);
            for (int c = 0; c < 3; c++)
                sum[c] += look.rgb[c];
            sum[3] += 1;
        }
    }
}

/* Adds one batch's mean light of a lamp. */
static void spot_rays(const task *t, room *r, const spot *s, int32_t x, int32_t y, uint32_t key,
                      float mean[4])
{
    const uint32_t keys[4] = {wo_stir(key, 0), wo_stir(key, 1), wo_stir(key, 2), wo_stir(key, 3)};
    int met = 0;
    for (int at = 0; at < t->lamp_rays; at += CHUNK) {
        const int count = t->lamp_rays - at < CHUNK ? t->lamp_rays - at : CHUNK;
        int used = 0;
        for (int i = 0; i < count; i++) {
            const uint32_t *const bits = t->sobol[at + i];
            const float turn = 2 * WO_PI * wo_scrambled(bits[2], keys[2]);
            const float out = s->radius * sqrtf(wo_scrambled(bits[3], keys[3]));
            const float px = (float)x + wo_scrambled(bits[0], keys[0]);
            const float py = (float)y + wo_scrambled(bits[1], keys[1]);
            const float u[2] = {(s->at[0] - px) * s->per_px + out * cosf(turn),
                                (s->at[1] - py) * s->per_px + out * sinf(turn)};
            if (wo_camera_open(t->camera, u))
                r->ray[used++] = wo_camera_ray(t->camera, px, py, u[0], u[1]);
        }
        wo_raycast_trace(t->scene->cast, r->ray, r->hit, (size_t)used, WO_RAYS_COHERENT);
        for (int i = 0; i < used; i++) {
            if (r->hit[i].geometry == WO_RAYCAST_NONE)
                continue;
            const wo_shape *const shape = &t->scene->shapes[r->hit[i].geometry];
            met += shape->glow && shape->first_lamp + r->hit[i].primitive == s->lamp;
        }
    }
    const float weight =
        WO_PI * s->radius * s->radius * t->inverse_area * (float)met / (float)t->lamp_rays;
    for (int c = 0; c < 3; c++)
        mean[c] += weight * t->scene->lamps[s->lamp].radiance[c];
}

static double shown(double value)
{
    const double x = value < 0 ? 0 : value > 1 ? 1 : value;
    return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
}

/* Mean and standard error of the batches; and the variance of the shown mean by leaving out one
   batch after the other, summed over the three colours. */
static double close_pixel(const task *t, float (*batch)[4], float rgba[4], float error[3])
{
    const int n = t->batches;
    double squares = 0;
    for (int c = 0; c < 4; c++) {
        double sum = 0, spread = 0;
        for (int i = 0; i < n; i++)
            sum += batch[i][c];
        const double mean = sum / n;
        rgba[c] = (float)mean;
        if (c == 3)
            break;
        for (int i = 0; i < n; i++)
            spread += (batch[i][c] - mean) * (batch[i][c] - mean);
        error[c] = (float)sqrt(spread / (n - 1) / n);
        if (spread == 0)
            continue;
        double without[BATCHES_MAX], middle = 0, part = 0;
        for (int i = 0; i < n; i++) {
            without[i] = shown((sum - batch[i][c]) / (n - 1));
            middle += without[i] / n;
        }
        for (int i = 0; i < n; i++)
            part += (without[i] - middle) * (without[i] - middle);
        squares += part * (n - 1) / n;
    }
    return squares;
}

static void render_row(void *user, size_t row, unsigned worker)
{
    const task *const t = user;
    room *const r = &t->rooms[worker];
    wo_footage *const f = t->footage;
    const int32_t y = (int32_t)row;
    if (wo_progress_aborted(t->progress))
        return;
    double squares = 0;
    for (int32_t x = 0; x < f->options.width; x++) {
        /* Numbers from 1: zero is no pixel. */
        const uint32_t number = (uint32_t)y * (uint32_t)f->options.width + (uint32_t)x + 1;
        const uint32_t key = wo_pixel_key(f->options.seed, x, y, PURPOSE_REFERENCE);
        float batch[BATCHES_MAX][4];
        find_spots(t, r, x, y, number);
        for (int b = 0; b < t->batches; b++) {
            const uint32_t own = wo_stir(key, (uint32_t)b);
            float sum[4] = {0};
            common_rays(t, r, x, y, own, number, sum);
            for (int c = 0; c < 4; c++)
                batch[b][c] = sum[c] / (float)t->rays;
            for (size_t i = 0; i < r->spot_count; i++)
                spot_rays(t, r, &r->spots[i], x, y, wo_stir(own, 16 + r->spots[i].lamp), batch[b]);
        }
        squares += close_pixel(t, batch, wo_image_at(&f->reference, x, y),
                               wo_image_at(&f->reference_error, x, y));
    }
    t->row_squares[row] = squares;
    wo_progress_add(t->progress, 1);
}

wo_status wo_render_through_lens(const wo_context *context, const wo_scene *scene,
                                 const wo_camera *camera, wo_footage *footage,
                                 wo_progress *progress, double share, wo_error *error)
{
    const wo_footage_options *const o = &footage->options;
    const unsigned workers = wo_workers(context);
    task t = {.scene = scene,
              .camera = camera,
              .footage = footage,
              .progress = progress,
              .inverse_area = 1 / wo_camera_area(camera)};
    wo_render_batches(o->reference_spp, &t.batches, &t.rays);
    t.lamp_rays = t.rays / 4 > LAMP_RAYS_LEAST ? t.rays / 4 : LAMP_RAYS_LEAST;
    t.lamp_rays = t.lamp_rays < t.rays ? t.lamp_rays : t.rays;
    footage->batches = t.batches;
    const size_t lamps = scene->lamp_count ? scene->lamp_count : 1;
    wo_status status = WO_ERR_NOMEM;
    if (!(t.sobol = wo_new(context, error, (size_t)t.rays, sizeof *t.sobol)))
        goto done;
    if (!(t.row_squares = wo_new(context, error, (size_t)o->height, sizeof *t.row_squares)))
        goto done;
    if (!(t.rooms = wo_new(context, error, workers, sizeof *t.rooms)))
        goto done;
    for (unsigned i = 0; i < workers; i++) {
        if (!(t.rooms[i].spots = wo_new(context, error, lamps, sizeof *t.rooms[i].spots)))
            goto done;
        if (!(t.rooms[i].pixel = wo_new(context, error, lamps, sizeof *t.rooms[i].pixel)))
            goto done;
    }
    for (int i = 0; i < t.rays; i++)
        wo_sobol_mirrored((uint32_t)i, t.sobol[i]);
    wo_progress_stage(progress, share, (size_t)o->height);
    wo_run(context, render_row, &t, (size_t)o->height);
    status = wo_progress_aborted(progress) ? WO_ABORTED : WO_OK;
    double squares = 0;
    for (int y = 0; y < o->height; y++)
        squares += t.row_squares[y];
    footage->noise_psnr = -10 * log10(fmax(squares / (3.0 * o->width * o->height), 1e-20));
done:
    for (unsigned i = 0; t.rooms && i < workers; i++) {
        wo_delete(context, t.rooms[i].spots);
        wo_delete(context, t.rooms[i].pixel);
    }
    wo_delete(context, t.rooms);
    wo_delete(context, t.row_squares);
    wo_delete(context, t.sobol);
    return status;
}
