/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/accumulate.h"

#include <math.h>
#include <string.h>

/* Samples of a surface may be so much closer than the pixels of its level. */
#define LEVEL_SPACING 1.0
/* px of blur that a surface may differ by over a cell: up to the first its level of detail counts
   in full, beyond the second it is 0. */
#define LEVEL_BEND_FULL 1.0
#define LEVEL_BEND_NONE 2.0
/* px beyond its reach that a tile at a coarser level may look. */
enum { LEVEL_MARGIN = 10 };
/* Views of one raster position may differ by so much, px. */
#define SAME_PX 0.1f
/* Views are added up by so many before they join the sums, to keep rounding small. */
enum { CHUNK = 32 };

wo_status wo_accumulate_create(const wo_defocus *scene, wo_accumulate *all, wo_error *error)
{
    const wo_context *context = scene->context;
    const wo_lens_rays *rays = scene->rays;
    *all = (wo_accumulate){.scene = scene,
                           .kernels = wo_draw_choose(wo_cpu_detect(context->cpu)),
                           .levels = 1,
                           .v_connect = (float)(WO_CONNECT_PX / scene->lens->px_per_dioptre)};
    wo_status status = wo_pieces_create(context, scene->stack, scene->lens, all->v_connect,
                                        &all->pieces[0], error);
    /* Coarser levels, if any tile wants them. */
    const int samples = scene->quality.adaptive ? scene->levels[0].count : scene->lens->count;
    double level = 0;
    for (int32_t ty = rays->tiles.y1; status == WO_OK && ty < rays->tiles.y2; ty++)
        for (int32_t tx = rays->tiles.x1; tx < rays->tiles.x2; tx++)
            level = fmax(level, wo_accumulate_level(all, tx, ty, samples));
    for (; status == WO_OK && all->levels < ceil(level) + 1; all->levels++)
        status = wo_pieces_coarser(context, &all->pieces[all->levels - 1], all->v_connect,
                                   &all->pieces[all->levels], error);
    if (status != WO_OK)
        wo_accumulate_destroy(all);
    return status;
}

void wo_accumulate_destroy(wo_accumulate *all)
{
    for (int i = 0; i < WO_LEVELS; i++)
        wo_pieces_destroy(all->scene->context, &all->pieces[i]);
}

/* Is all that rect sees of a sheet solid? *bend becomes the largest difference of vergence over a
   cell. */
static bool is_whole(const wo_accumulate *all, int s, wo_rect rect, float *bend)
{
    const wo_stack *stack = all->scene->stack;
    const wo_pieces *p = &all->pieces[0];
    rect = wo_rect_intersect(rect, stack->area);
    for (int32_t j = (rect.y1 - p->y1) / WO_CELL; j <= (rect.y2 - 1 - p->y1) / WO_CELL; j++) {
        for (int32_t i = (rect.x1 - p->x1) / WO_CELL; i <= (rect.x2 - 1 - p->x1) / WO_CELL; i++) {
            if (!(p->piece[s][j * p->columns + i / 2].whole & 1 << (i & 1)))
                return false;
            *bend = fmaxf(*bend, stack->steps[s][(ptrdiff_t)j * stack->cell_columns + i]);
        }
    }
    return true;
}

double wo_accumulate_level(const wo_accumulate *all, int32_t tx, int32_t ty, int samples)
{
    const wo_lens *lens = all->scene->lens;
    const wo_ray_tile *tile = wo_lens_rays_at(all->scene->rays, tx, ty);
    int sheet = -1;
    for (int s = 0; s < all->scene->stack->sheets; s++) {
        if (tile->bounds[s].v_min > tile->bounds[s].v_max)
            continue;
        if (sheet >= 0)
            return 0;
        sheet = s;
    }
    if (sheet < 0)
        return 0;
    const wo_bounds b = tile->bounds[sheet];
    if (b.v_min <= 0 && b.v_max >= 0)
        return 0;
    const double radius = fmin(lens->reach(lens->self, (double)b.v_min, (double)b.v_min),
                               lens->reach(lens->self, (double)b.v_max, (double)b.v_max));
    const double level = log2(LEVEL_SPACING * radius * sqrt(3.14159265358979 / samples));
    if (!(level > 0))
        return 0;
    const int32_t grow = (int32_t)ceilf(tile->reach) + LEVEL_MARGIN;
    float bend = 0;
    if (!is_whole(all, sheet, wo_rect_grow(wo_tile_rect(tx, ty), grow, grow), &bend))
        return 0;
    const double px = (double)bend * lens->px_per_dioptre;
    const double part = (LEVEL_BEND_NONE - px) / (LEVEL_BEND_NONE - LEVEL_BEND_FULL);
    return fmin(level, WO_LEVELS - 1) * fmin(fmax(part, 0), 1);
}

int wo_accumulate_level_of(double level, int n)
{
    double share = 0.5 / (1 << 12);
    double digit = 0.5;
    for (unsigned bits = (unsigned)n; bits != 0; bits >>= 1, digit *= 0.5)
        share += bits & 1 ? digit : 0;
    return (int)floor(level + fmin(share, 1 - 1e-9));
}

wo_status wo_accumulator_create(const wo_context *context, int count, wo_accumulator *worker,
                                wo_error *error)
{
    const size_t n = (size_t)count;
    if (!(worker->ray = wo_new(context, error, n, sizeof *worker->ray)) ||
        !(worker->group = wo_new(context, error, n, sizeof *worker->group)) ||
        !(worker->weight = wo_new(context, error, n, sizeof *worker->weight)) ||
        !(worker->same = wo_new(context, error, n, sizeof *worker->same)))
        return WO_ERR_NOMEM;
    return WO_OK;
}

void wo_accumulator_destroy(const wo_context *context, wo_accumulator *worker)
{
    wo_thin_forget(context, worker);
    wo_delete(context, worker->ray);
    wo_delete(context, worker->group);
    wo_delete(context, worker->weight);
    wo_delete(context, worker->same);
}

static void read_rays(const wo_lens *lens, unsigned set, wo_accumulator *worker, int32_t tx,
                      int32_t ty)
{
    for (int first = 0; first < lens->count; first += WO_PENCIL_PIECE) {
        wo_pencil pencil;
        lens->pencil(lens->self, (tx + 0.5) * WO_TILE_WIDTH, (ty + 0.5) * WO_TILE_HEIGHT, set,
                     first, &worker->room, &pencil);
        worker->weighted = pencil.weight[0] != NULL;
        for (int n = 0; n < pencil.count; n++) {
            worker->ray[first + n] =
                (wo_view_ray){pencil.ax[n], pencil.ay[n], pencil.bx[n], pencil.by[n]};
            for (int k = 0; k < 3; k++)
                worker->weight[first + n][k] = pencil.weight[0] ? pencil.weight[k][n] : 1;
        }
    }
}

bool wo_accumulate_begin(const wo_accumulate *all, wo_accumulator *worker, int32_t tx, int32_t ty)
{
    const wo_ray_tile *tile = wo_lens_rays_at(all->scene->rays, tx, ty);
    const wo_rect rect = wo_tile_rect(tx, ty);
    float low = INFINITY;
    float high = -INFINITY;
    for (int s = 0; s < all->scene->stack->sheets; s++) {
        low = fminf(low, tile->bounds[s].v_min);
        high = fmaxf(high, tile->bounds[s].v_max);
    }
    for (int level = 0; level < all->levels; level++) {
        wo_draw *draw = &worker->draw[level];
        *draw = (wo_draw){.pieces = &all->pieces[level],
                          .v_connect = all->v_connect * (float)(1 << level),
                          .x1 = rect.x1 >> level,
                          .y1 = rect.y1 >> level,
                          .v_low = low,
                          .v_high = high};
        for (int s = 0; s < all->scene->stack->sheets; s++)
            draw->bounds[s] =
                (wo_bounds){wo_piece_vergence(tile->bounds[s].v_min, s), tile->bounds[s].v_max};
        for (int half = 0; half < 2; half++)
            memset(&worker->sums[half][level], 0, sizeof worker->sums[half][level]);
    }
    worker->level_used = 0;
    if (!wo_thin_gather(all, worker, rect, tile->reach, &worker->draw[0].thin)) {
        worker->no_memory = true;
        return false;
    }
    return true;
}

/* Where the light that a view of this ray has left is lost: 0 nowhere, 2 everywhere, 1 = written to
   worker->lost. */
static int find_lost(const wo_accumulate *all, wo_accumulator *worker, const wo_view_ray *ray)
{
    const wo_draw *draw = &worker->draw[0];
    const wo_pieces *p = &all->pieces[0];
    const wo_stack *stack = all->scene->stack;
    int dx;
    int dy;
    wo_view_step(ray, draw->v_low, &dx, &dy);
    const int32_t x = draw->x1 + dx;
    const int32_t y = draw->y1 + dy;
    bool all_lost = true;
    bool any_lost = false;
    for (int32_t j = (y - p->y1) / WO_PIECE_HEIGHT;
         j <= (y + WO_VIEW_ROWS - 1 - p->y1) / WO_PIECE_HEIGHT; j++) {
        for (int32_t i = (x - p->x1) / WO_PIECE_WIDTH;
             i <= (x + WO_VIEW_WIDTH - 1 - p->x1) / WO_PIECE_WIDTH; i++) {
            const uint8_t opaque = p->opaque[j * p->columns + i];
            all_lost &= opaque == 2;
            any_lost |= opaque != 0;
        }
    }
    if (all_lost || !any_lost)
        return all_lost ? 2 : 0;
    for (int32_t row = 0; row < WO_VIEW_ROWS; row++)
        for (int32_t i = 0; i < WO_VIEW_WIDTH; i++)
            worker->lost[row * WO_VIEW_WIDTH + i] =
                stack->opaque[wo_stack_at(stack, x + i, y + row)] > 0.5f;
    return 1;
}

/* Draws the view of the group that starts at sample n and adds it to the part. */
static void add_view(const wo_accumulate *all, wo_accumulator *worker, int level, int n,
                     double scale)
{
    const float px = 1.0f / (float)(1 << level);
    int count = 0;
    float weight[3] = {0};
    for (; n >= 0; n = worker->same[n].next) {
        const wo_view_ray *r = &worker->ray[n];
        worker->group[count++] = (wo_view_ray){r->ax * px, r->ay * px, r->bx * px, r->by * px};
        for (int k = 0; k < 3; k++)
            weight[k] += (float)scale * worker->weight[n][k];
    }
    wo_view *view = &worker->view;
    view->width = WO_VIEW_WIDTH >> level;
    view->height = WO_VIEW_ROWS >> level;
    worker->writes += all->kernels->draw(&worker->draw[level], worker->group, count, view);
    worker->reused += count - 1;
    worker->spared += (double)count * (WO_TILE_WIDTH * WO_TILE_HEIGHT - view->width * view->height);
    const int lost = level > 0 ? 2 : find_lost(all, worker, &worker->group[0]);
    if (lost == 0)
        memset(worker->lost, 0, sizeof worker->lost);
    all->kernels->add(view, lost == 2 ? NULL : worker->lost, (float)(scale * count),
                      worker->weighted ? weight : NULL, &worker->part);
}

static void add_part(wo_accumulator *worker, int half, int level)
{
    float *const part = worker->part.plane[0];
    float *const to = worker->sums[half][level].plane[0];
    for (size_t i = 0; i < sizeof worker->part / sizeof *part; i++) {
        to[i] += part[i];
        part[i] = 0;
    }
}

enum { HASH = 64 };

/* Does every surface of the tile land on one raster position (dx, dy)? */
static bool lands_once(const wo_draw *draw, const wo_view_ray *r, int *dx, int *dy)
{
    if (!((draw->v_high - draw->v_low) * fmaxf(fabsf(r->bx), fabsf(r->by)) <= SAME_PX))
        return false;
    int x;
    int y;
    wo_view_step(r, draw->v_low, dx, dy);
    wo_view_step(r, draw->v_high, &x, &y);
    return x == *dx && y == *dy;
}

/* Joins sample n to the group that lands where it lands; false when it is a group's first. */
static bool join(wo_accumulator *worker, int heads[HASH], int n, int dx, int dy)
{
    wo_same *const same = worker->same;
    int *const head = &heads[(unsigned)(dx * 8 + dy) % HASH];
    for (int first = *head; first >= 0; first = same[first].link) {
        if (same[first].dx != dx || same[first].dy != dy)
            continue;
        same[n].next = same[first].next;
        same[first].next = n;
        return true;
    }
    same[n] = (wo_same){dx, dy, -1, *head};
    *head = n;
    return false;
}

/* Chooses the samples first..end - 1 that are drawn at a level, and joins those of one raster
   position: the others' link is -2. */
static void choose(wo_accumulator *worker, int first, int end, double detail, int level)
{
    const float px = 1.0f / (float)(1 << level);
    int heads[HASH];
    for (int i = 0; i < HASH; i++)
        heads[i] = -1;
    for (int n = first; n < end; n++) {
        const float *w = worker->weight[n];
        const wo_view_ray *r = &worker->ray[n];
        const wo_view_ray ray = {r->ax * px, r->ay * px, r->bx * px, r->by * px};
        int dx = 0;
        int dy = 0;
        worker->same[n] = (wo_same){0, 0, -1, -2};
        if (wo_accumulate_level_of(detail, n - first) != level ||
            (w[0] == 0 && w[1] == 0 && w[2] == 0))
            continue;
        if (!lands_once(&worker->draw[level], &ray, &dx, &dy))
            worker->same[n].link = -1;
        else if (join(worker, heads, n, dx, dy))
            worker->same[n].link = -2;
    }
}

bool wo_accumulate_add(const wo_accumulate *all, wo_accumulator *worker, const wo_lens *lens,
                       unsigned pass, int32_t tx, int32_t ty, double scale)
{
    const double detail = wo_accumulate_level(all, tx, ty, lens->count);
    const int last = (int)ceil(detail);
    read_rays(lens, wo_hash(pass) % lens->sets, worker, tx, ty);
    for (int half = 0; half < 2; half++) {
        const int first = half == 0 ? 0 : lens->half;
        const int end = half == 0 ? lens->half : lens->count;
        for (int level = (int)floor(detail); level <= last; level++) {
            worker->level_used = level > worker->level_used ? level : worker->level_used;
            choose(worker, first, end, detail, level);
            int chunk = 0;
            for (int n = first; n < end; n++) {
                if (worker->same[n].link == -2)
                    continue;
                if (wo_aborted(all->scene->context))
                    return false;
                add_view(all, worker, level, n, scale);
                if (++chunk % CHUNK == 0)
                    add_part(worker, half, level);
            }
            add_part(worker, half, level);
        }
    }
    return !wo_aborted(all->scene->context);
}

/* A plane of coarse sums at pixel (x, y) of the tile: linear between pixels, and beyond the last
   ones, without changing sign there. */
static float between(const float *plane, int level, int x, int y)
{
    const float scale = 1.0f / (float)(1 << level);
    const int width = WO_VIEW_WIDTH >> level;
    const int height = WO_VIEW_ROWS >> level;
    const float px = ((float)x + 0.5f) * scale - 0.5f;
    const float py = ((float)y + 0.5f) * scale - 0.5f;
    int i = (int)px;
    int j = (int)py;
    i = i > width - 2 ? width - 2 : i;
    j = j > height - 2 ? height - 2 : j;
    const float *p = plane + j * WO_VIEW_WIDTH + i;
    const float low = p[0] + (px - (float)i) * (p[1] - p[0]);
    p += WO_VIEW_WIDTH;
    const float high = p[0] + (px - (float)i) * (p[1] - p[0]);
    const float value = low + (py - (float)j) * (high - low);
    const float nearest = plane[(y >> level) * WO_VIEW_WIDTH + (x >> level)];
    return value * nearest < 0 ? 0 : value;
}

bool wo_accumulate_mean(const wo_accumulator *worker, int half, int x, int y, float c[4],
                        float *guessed)
{
    float sum[WO_SUMS] = {0};
    for (int h = half == 2 ? 0 : half; h <= (half == 2 ? 1 : half); h++) {
        for (int level = 0; level <= worker->level_used; level++) {
            for (int k = 0; k < WO_SUMS; k++) {
                const float *plane = worker->sums[h][level].plane[k];
                sum[k] += level == 0 ? plane[y * WO_VIEW_WIDTH + x] : between(plane, level, x, y);
            }
        }
    }
    bool known = true;
    for (int k = 0; k < 4; k++) {
        const int w = worker->weighted && k < 3 ? WO_SUM_WEIGHTS + k : WO_SUM_REST;
        c[k] = sum[w] > 0 ? sum[k] / sum[w] : 0;
        known &= sum[w] > 0;
    }
    *guessed = sum[WO_SUM_GUESSED];
    c[3] = fminf(c[3], 1);
    return known;
}
