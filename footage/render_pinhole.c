/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "peel.h"
#include "render.h"

#include <string.h>

/* A ray goes on this much further than its last hit. */
#define ONWARDS 1.00001f

enum {
    PURPOSE_PINHOLE = 1,
    GROUP = 8, /* pixels side by side whose rays go together, so that packets are full */
    RAYS_MAX = GROUP * WO_PEEL_SAMPLES_MAX
};

/* Which ray of which pixel of the group. */
typedef struct open_ray {
    int pixel, sample;
} open_ray;

/* Room of one worker. */
typedef struct room {
    wo_peel_pixel pixel[GROUP];
    wo_hit centre[GROUP]; /* first hit of the ray through the centre */
    wo_ray ray[RAYS_MAX];
    wo_hit hit[RAYS_MAX];
    open_ray open[RAYS_MAX];
    int64_t dropped;
} room;

typedef struct task {
    const wo_scene *scene;
    const wo_camera *camera;
    wo_footage *footage;
    wo_image *layer, *layer_depth;
    int layers;   /* to peel */
    int hits_max; /* of one ray */
    uint32_t (*sobol)[WO_SOBOL_DIMENSIONS];
    room *rooms;
    wo_progress *progress;
} task;

/* Rays of count pixels from (x, y) on; centres first, then pixel by pixel. Returns their number. */
static int make_rays(const task *t, room *r, int32_t x, int32_t y, int count)
{
    const int samples = t->footage->options.samples + 1;
    int made = 0;
    for (int p = 0; p < count; p++) {
        r->pixel[p].samples = samples;
        r->pixel[p].footprint = 1 / t->camera->focal_px;
        r->pixel[p].offset[0] = 0;
        r->pixel[p].count[0] = 0;
        r->centre[p].geometry = WO_RAYCAST_NONE;
        r->open[made] = (open_ray){p, 0};
        r->ray[made++] = wo_camera_ray(t->camera, (float)(x + p) + 0.5f, (float)y + 0.5f, 0, 0);
    }
    for (int p = 0; p < count; p++) {
        const uint32_t key = wo_pixel_key(t->footage->options.seed, x + p, y, PURPOSE_PINHOLE);
        const uint32_t keys[2] = {wo_stir(key, 0), wo_stir(key, 1)};
        for (int s = 1; s < samples; s++) {
            const float dx = wo_scrambled(t->sobol[s - 1][0], keys[0]);
            const float dy = wo_scrambled(t->sobol[s - 1][1], keys[1]);
            r->pixel[p].offset[s] = (dx - 0.5f) * (dx - 0.5f) + (dy - 0.5f) * (dy - 0.5f);
            r->pixel[p].count[s] = 0;
            r->open[made] = (open_ray){p, s};
            r->ray[made++] = wo_camera_ray(t->camera, (float)(x + p) + dx, (float)y + dy, 0, 0);
        }
    }
    return made;
}

static void store_hit(const task *t, const wo_ray *ray, const wo_hit *hit, wo_peel_hit *out)
{
    wo_look look;
    wo_scene_shade(t->scene, ray, hit, &look);
    wo_scene_add_glow(t->scene, &look, look.rgb);
    memcpy(out->rgb, look.rgb, sizeof out->rgb);
    out->z = hit->t;
    out->sheet = t->scene->shapes[hit->geometry].sheet;
    out->piece = wo_scene_piece(t->scene, hit);
    if (t->footage->options.back_faces) {
        const float *const n = hit->normal, *const d = ray->direction;
        out->piece = out->piece << 1 | (n[0] * d[0] + n[1] * d[1] + n[2] * d[2] > 0);
    }
}

/* Follows all rays of a group through everything they meet. */
static void peel(const task *t, room *r, int open)
{
    const int mode =
        WO_RAYS_COHERENT | (t->footage->options.back_faces ? WO_RAYS_ANY : WO_RAYS_FRONT_ONLY);
    for (int k = 0; k < t->hits_max && open > 0; k++) {
        wo_raycast_trace(t->scene->cast, r->ray, r->hit, (size_t)open, mode);
        int still = 0;
        for (int i = 0; i < open; i++) {
            const wo_hit *const hit = &r->hit[i];
            const open_ray which = r->open[i];
            wo_peel_pixel *const pixel = &r->pixel[which.pixel];
            if (hit->geometry == WO_RAYCAST_NONE)
                continue;
            if (which.sample == 0 && k == 0)
                r->centre[which.pixel] = *hit;
            store_hit(t, &r->ray[i], hit, &pixel->hit[which.sample][k]);
            pixel->count[which.sample] = k + 1;
            r->open[still] = which;
            r->ray[still] = r->ray[i];
            r->ray[still++].near = hit->t * ONWARDS;
        }
        open = still;
    }
}

static void store_layers(const task *t, room *r, int p, int32_t x, int32_t y)
{
    wo_peel_layer out[WO_PEEL_LAYERS_MAX];
    int filled;
    if (t->footage->options.peel == WO_FOOTAGE_HITS)
        filled = wo_peel_hits(&r->pixel[p], t->layers, out);
    else
        filled = wo_peel_patches(&r->pixel[p], t->layers, out, &r->dropped);
    for (int k = 0; k < filled; k++) {
        memcpy(wo_image_at(&t->layer[k], x, y), out[k].rgba, sizeof out[k].rgba);
        *wo_image_at(&t->layer_depth[k], x, y) = out[k].z;
    }
}

static void store_pixel(const task *t, room *r, int p, int32_t x, int32_t y)
{
    wo_footage *const f = t->footage;
    wo_peel_first(&r->pixel[p], wo_image_at(&f->colour, x, y), wo_image_at(&f->depth, x, y));
    if (r->centre[p].geometry != WO_RAYCAST_NONE) {
        const wo_ray ray = wo_camera_ray(t->camera, (float)x + 0.5f, (float)y + 0.5f, 0, 0);
        const wo_vec n = wo_scene_normal(t->scene, &ray, &r->centre[p]);
        float *const out = wo_image_at(&f->normal, x, y);
        out[0] = n.x;
        out[1] = n.y;
        out[2] = n.z;
    }
    if (t->layers > 0)
        store_layers(t, r, p, x, y);
}

static void render_row(void *user, size_t row, unsigned worker)
{
    const task *const t = user;
    room *const r = &t->rooms[worker];
    const wo_rect area = t->footage->colour.bounds;
    const int32_t y = area.y1 + (int32_t)row;
    if (wo_progress_aborted(t->progress))
        return;
    for (int32_t x = area.x1; x < area.x2; x += GROUP) {
        const int count = area.x2 - x < GROUP ? area.x2 - x : GROUP;
        peel(t, r, make_rays(t, r, x, y, count));
        for (int p = 0; p < count; p++)
            store_pixel(t, r, p, x + p, y);
    }
    wo_progress_add(t->progress, 1);
}

wo_status wo_render_image(const wo_context *context, wo_rect bounds, int components,
                          wo_image *image, wo_error *error)
{
    const ptrdiff_t width = wo_rect_width(bounds);
    const size_t pixels = (size_t)width * (size_t)wo_rect_height(bounds);
    *image = (wo_image){.bounds = bounds,
                        .row_bytes = width * components * (ptrdiff_t)sizeof(float),
                        .components = components};
    image->data = wo_new(context, error, pixels, (size_t)components * sizeof(float));
    return image->data ? WO_OK : WO_ERR_NOMEM;
}

/* Counts what is in the layers and hands them over; the ones beyond those asked for go. */
static void keep_layers(const wo_context *context, task *t)
{
    wo_footage *const f = t->footage;
    f->layer_count = f->options.layers;
    for (int k = 0; k < t->layers; k++) {
        if (k >= f->layer_count) {
            wo_delete(context, t->layer[k].data);
            wo_delete(context, t->layer_depth[k].data);
            continue;
        }
        f->layer[k] = t->layer[k];
        f->layer_depth[k] = t->layer_depth[k];
        const wo_rect area = f->layer[k].bounds;
        for (int32_t y = area.y1; y < area.y2; y++)
            for (int32_t x = area.x1; x < area.x2; x++)
                f->layer_pixels[k] += wo_image_at(&f->layer[k], x, y)[3] > 0;
    }
}

/* With the umbra rule more is peeled, so that what moves up is not missing. */
enum { UMBRA_SPARE = 4 };

wo_status wo_render_through_pinhole(const wo_context *context, const wo_scene *scene,
                                    const wo_camera *camera, wo_footage *footage,
                                    wo_progress *progress, double share, wo_error *error)
{
    const wo_footage_options *const o = &footage->options;
    wo_image layer[WO_PEEL_LAYERS_MAX] = {{0}}, layer_depth[WO_PEEL_LAYERS_MAX] = {{0}};
    task t = {.scene = scene,
              .camera = camera,
              .footage = footage,
              .layer = layer,
              .layer_depth = layer_depth,
              .progress = progress};
    const bool umbra = o->umbra && o->layers > 0;
    t.layers = umbra ? o->layers + UMBRA_SPARE : o->layers;
    t.hits_max = t.layers == 0 ? 1 : o->peel == WO_FOOTAGE_HITS ? t.layers : 2 * t.layers + 4;
    t.hits_max = t.hits_max < WO_PEEL_DEPTH_MAX ? t.hits_max : WO_PEEL_DEPTH_MAX;
    const wo_rect area = footage->colour.bounds;
    const size_t rows = (size_t)wo_rect_height(area);
    const unsigned workers = wo_workers(context);
    uint8_t *marks = NULL;
    wo_status status = WO_ERR_NOMEM;
    if (!(t.rooms = wo_new(context, error, workers, sizeof *t.rooms)))
        goto done;
    if (!(t.sobol = wo_new(context, error, (size_t)o->samples, sizeof *t.sobol)))
        goto done;
    if (umbra &&
        !(marks = wo_new(context, error, (size_t)wo_rect_width(area) * rows, (size_t)t.layers)))
        goto done;
    for (int k = 0; k < t.layers; k++)
        if (wo_render_image(context, area, 4, &layer[k], error) != WO_OK ||
            wo_render_image(context, area, 1, &layer_depth[k], error) != WO_OK)
            goto done;
    for (int s = 0; s < o->samples; s++)
        wo_sobol_mirrored((uint32_t)s, t.sobol[s]);
    wo_progress_stage(progress, share, rows);
    wo_run(context, render_row, &t, rows);
    if (wo_progress_aborted(progress)) {
        status = WO_ABORTED;
        goto done;
    }
    for (unsigned i = 0; i < workers; i++)
        footage->deeper_dropped += t.rooms[i].dropped;
    if (umbra)
        footage->umbra_dropped = wo_peel_umbra(camera, layer, layer_depth, t.layers, marks);
    keep_layers(context, &t);
    status = WO_OK;
done:
    for (int k = 0; k < t.layers && status != WO_OK; k++) {
        wo_delete(context, layer[k].data);
        wo_delete(context, layer_depth[k].data);
    }
    wo_delete(context, marks);
    wo_delete(context, t.sobol);
    wo_delete(context, t.rooms);
    return status;
}
