/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/filter_frame.h"
#include "defocus/filter_scene.h"
#include "defocus/renderer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The scatter-as-you-gather filter (filter.h). A pixel's neighbours up to INNER px are all looked
   at, so that what is sharp stays sharp and small blur has no noise; beyond them taps stand for an
   area each: rays of the lens's pencil, drawn out to the largest circle of confusion that the
   footprint of the tile holds, one set of them for what lies before the focus, one for what lies
   behind. A median takes out what noise the taps leave. */
enum { INNER = 2 };
/* Every circle of the tile is larger than this: neighbours are left to the taps. px */
#define INNER_LAST 8.0f
/* Circles of a side of the focus smaller than this part of the largest need taps of their own, more
   of them towards the middle. */
#define ALIKE 0.6f
/* A lens that leaves more than this in its best focus has no circle of confusion that one disc
   could stand for: its tiles are given to the rays. px */
#define REST_MAX 1.0f
/* A tap beyond the tile's own reach would leave the stack: rounding and soft edges. px */
enum { BEYOND = 2 };

/* Less light than this tells no colour. */
#define LEAST_LIGHT 1e-6f

typedef struct filter_job {
    const wo_defocus *scene;
    const wo_lens *lens; /* whose rays are the taps */
    wo_filter_scene filter;
    const wo_filter_kernels *kernels;
    const wo_frame *frame;
    wo_frame raw; /* before the median: rays, and in error the part of the light from taps */
    bool with_rays;
} filter_job;

/* One side of the focus in the footprint of a tile. */
typedef struct side {
    float least, most; /* px: radius */
} side;

/* A tile at work. */
typedef struct tile_job {
    const filter_job *job;
    wo_filter_view view;
    const wo_filter_shape *shape;
    const wo_ray_tile *tile;
    wo_rect rect;
    side sides[2]; /* before the focus, behind it */
    bool inner;
    int32_t limit; /* px: no tap goes farther in x or y */
    wo_filter_taps taps;
    wo_pencil_room room;
} tile_job;

static int32_t reach_of(const wo_ray_tile *tile)
{
    return (int32_t)ceilf(tile->footprint) + BEYOND;
}

static void widen(side *s, float least, float most)
{
    s->least = fminf(s->least, least);
    s->most = fmaxf(s->most, most);
}

/* Circles on both sides of the focus, from the bounds of the footprint. */
static void find_sides(tile_job *t)
{
    const wo_filter_shape *shape = t->shape;
    t->sides[0] = t->sides[1] = (side){INFINITY, 0};
    for (int s = 0; s < t->job->scene->stack->sheets; s++) {
        const wo_bounds b = t->tile->bounds[s];
        if (b.v_min > b.v_max)
            continue;
        const float low = (b.v_min - shape->v0) * shape->ppd;
        const float high = (b.v_max - shape->v0) * shape->ppd;
        if (high >= 0)
            widen(&t->sides[0], wo_filter_radius(shape, fmaxf(low, 0)),
                  wo_filter_radius(shape, high));
        if (low < 0)
            widen(&t->sides[1], wo_filter_radius(shape, fminf(high, 0)),
                  wo_filter_radius(shape, low));
    }
    t->inner = fminf(t->sides[0].least, t->sides[1].least) < INNER_LAST;
}

/* A distance in px as filter.h wants it: over the extent of the aperture in its direction, but for
   the first px, so that what is in focus reaches no neighbour, whatever the shape. */
static float in_extents(float away, float outer)
{
    return away < 1 ? away : 1 + (away - 1) / outer;
}

static float offset_in_extents(const wo_filter_shape *shape, float x, float y)
{
    if (x == 0 && y == 0)
        return 0;
    return in_extents(hypotf(x, y), shape->outer[wo_filter_bin(x, y)]);
}

static bool is_inner(int x, int y)
{
    return x * x + y * y <= INNER * INNER + 1;
}

/* The neighbours, as far as any circle of the tile reaches. */
static void inner_taps(const tile_job *t, wo_filter_taps *taps)
{
    const wo_filter_shape *shape = t->shape;
    const float most = fmaxf(t->sides[0].most, t->sides[1].most) + 1;
    taps->count = 0;
    for (int y = -INNER; y <= INNER; y++) {
        for (int x = -INNER; x <= INNER; x++) {
            const float away = offset_in_extents(shape, (float)x, (float)y);
            const float back = offset_in_extents(shape, (float)-x, (float)-y);
            if (!is_inner(x, y) || fminf(away, back) > most)
                continue;
            const int i = taps->count++;
            taps->dx[i] = x;
            taps->dy[i] = y;
            taps->away[i] = hypotf((float)x, (float)y);
            taps->before[i] = away;
            taps->behind[i] = back;
            taps->area[i] = 1;
        }
    }
}

/* Rays of a pencil as taps out to the largest circle of one side of the focus. */
static void ray_taps(tile_job *t, int which, const wo_pencil *pencil)
{
    const wo_filter_shape *shape = t->shape;
    const side *s = &t->sides[which];
    wo_filter_taps *taps = &t->taps;
    float reach;
    float share;
    wo_filter_disc(&t->job->filter.discs, s->most, 0, &reach, &share);
    const bool alike = s->least > ALIKE * s->most;
    const float sign = which == 0 ? 1.0f : -1.0f;
    const float rays = (float)t->job->lens->count * shape->lit;
    const float area = 3.14159265f * (1 - shape->hole * shape->hole) / rays;
    taps->count = 0;
    for (int n = 0; n < pencil->count; n++) {
        const float bx = pencil->bx[n];
        const float by = pencil->by[n];
        const float weight =
            pencil->weight[0]
                ? (pencil->weight[0][n] + pencil->weight[1][n] + pencil->weight[2][n]) * (1.0f / 3)
                : 1;
        const float b = sqrtf(bx * bx + by * by);
        if (!(weight > 0) || !(b > 0))
            continue;
        const float outer = shape->outer[wo_filter_bin(bx, by)];
        const float rho = fminf(b / (shape->ppd * outer), 1);
        /* Drawn evenly over the area, or evenly along the radius. */
        const float at = alike ? rho : rho * rho;
        const float farthest = (reach - 0.5f) * outer + 1;
        const float away = at * farthest;
        const int dx = (int)lrintf(sign * away * bx / b);
        const int dy = (int)lrintf(sign * away * by / b);
        if (t->inner && is_inner(dx, dy))
            continue;
        if (abs(dx) > t->limit || abs(dy) > t->limit)
            continue;
        const int i = taps->count++;
        taps->dx[i] = dx;
        taps->dy[i] = dy;
        taps->away[i] = away;
        const float extents = in_extents(away, outer);
        taps->before[i] = which == 0 ? extents : INFINITY;
        taps->behind[i] = which == 1 ? extents : INFINITY;
        const float scale = farthest / outer;
        taps->area[i] = weight * area * scale * scale * (alike ? 1 : 2 * at);
    }
}

/* What becomes of the sums of a vector. */
typedef struct picture {
    float c[4][WO_LANES];
    float guessed[WO_LANES];
    float far[WO_LANES];    /* part of the light that came from beyond the neighbours */
    bool nothing[WO_LANES]; /* was met where the scene is opaque */
} picture;

/* The classes front to back. Light that is left where the scene is opaque saw what no surface
   holds: it does not count. neighbours: sums without the taps. */
static void compose(const wo_filter_sums *sums, const wo_filter_sums *neighbours, picture *out)
{
    for (int i = 0; i < WO_LANES; i++) {
        const float before = sums->c[WO_FILTER_BEFORE][3][i];
        const float own = sums->c[WO_FILTER_OWN][3][i];
        const float behind = sums->behind[i];
        const float expected = sums->expected[i] * sums->own_share[i];
        const float left = before < 1 ? 1 - before : 0;
        const float a_own = own < expected ? own / expected : own > 0 ? 1.0f : 0.0f;
        const float w_before = before > 1 ? 1 / before : 1;
        const float w_own = own > 0 ? left * a_own / own : 0;
        const float all_behind = fmaxf(behind, sums->c[WO_FILTER_BEHIND][3][i]);
        const float w_behind = all_behind > 0 ? left * (1 - a_own) / all_behind : 0;
        float sum[4];
        for (int k = 0; k < 4; k++)
            sum[k] = w_before * sums->c[WO_FILTER_BEFORE][k][i] +
                     w_own * sums->c[WO_FILTER_OWN][k][i] +
                     w_behind * sums->c[WO_FILTER_BEHIND][k][i];
        const float near = w_before * neighbours->c[WO_FILTER_BEFORE][3][i] +
                           w_own * neighbours->c[WO_FILTER_OWN][3][i] +
                           w_behind * neighbours->c[WO_FILTER_BEHIND][3][i];
        const float guessed = w_before * sums->guessed[WO_FILTER_BEFORE][i] +
                              w_own * sums->guessed[WO_FILTER_OWN][i] +
                              w_behind * sums->guessed[WO_FILTER_BEHIND][i];
        const float all = sum[3] < 1 ? sum[3] : 1;
        const float lost = sums->own_open[i] ? 1 : sums->open[i] * sums->own_share[i];
        const float open = lost < 1 - all ? lost : 1 - all;
        /* What is more than all light takes the colours along with it. */
        const float norm = sum[3] < 1 ? sum[3] + open : sum[3];
        const float scale = norm > LEAST_LIGHT ? 1 / norm : 0;
        for (int k = 0; k < 3; k++)
            out->c[k][i] = sum[k] * scale;
        out->c[3][i] = open > 0 ? all * scale : 1;
        out->guessed[i] = guessed * scale;
        out->far[i] = sum[3] > near ? 1 - near / sum[3] : 0;
        out->nothing[i] = !(norm > LEAST_LIGHT);
    }
}

static void straight_through(const wo_filter_view *view, ptrdiff_t at, float c[4])
{
    const float share = view->near.share[at];
    for (int k = 0; k < 3 && share > 0; k++)
        c[k] = view->near.c[k][at] / share;
    c[3] = view->near.cover[at];
}

/* One vector of a row; false when stopped. */
static bool gather_vector(tile_job *t, int32_t row, int run_index, unsigned set,
                          const wo_filter_taps *inner, wo_tile_pixels *pixels, wo_tile_facts *facts,
                          wo_report *part)
{
    const filter_job *job = t->job;
    const wo_lens *lens = job->lens;
    const wo_rect area = job->filter.area;
    const int32_t x = t->rect.x1 - area.x1;
    const int32_t y = t->rect.y1 + row - area.y1;
    wo_filter_sums sums = {0};
    int taps = 0;
    if (t->inner)
        part->steps += job->kernels->gather(&t->view, x, y, run_index, inner, &sums);
    const wo_filter_sums neighbours = sums;
    for (int which = 0; which < 2; which++) {
        if (!(t->sides[which].most > (t->inner ? INNER : 0)))
            continue;
        for (int first = 0; first < lens->count; first += WO_PENCIL_PIECE) {
            wo_pencil pencil;
            if (wo_aborted(job->scene->context))
                return false;
            lens->pencil(lens->self, t->rect.x1 + 0.5 * WO_TILE_WIDTH, t->rect.y1 + row + 0.5, set,
                         first, &t->room, &pencil);
            ray_taps(t, which, &pencil);
            taps += t->taps.count;
            part->steps += job->kernels->gather(&t->view, x, y, run_index, &t->taps, &sums);
        }
    }
    part->rays += (int64_t)taps * WO_LANES;
    picture out;
    compose(&sums, &neighbours, &out);
    for (int i = 0; i < WO_LANES; i++) {
        const int at = run_index + WO_PHASES * i;
        for (int k = 0; k < 4; k++)
            pixels->c[row][at][k] = out.c[k][i];
        if (out.nothing[i])
            straight_through(&t->view,
                             y * t->view.row + run_index * t->view.run + x / WO_PHASES + i,
                             pixels->c[row][at]);
        pixels->guessed[row][at] = out.guessed[i];
        facts->rays[row][at] = (float)taps;
        facts->error[row][at] = out.far[i];
    }
    return true;
}

/* Is no pixel of the vector wanted? */
static bool unwanted(const wo_rect *window, const wo_rect *tile, int32_t row, int run_index)
{
    const int32_t y = tile->y1 + row;
    const int32_t first = tile->x1 + run_index;
    const int32_t last = first + WO_TILE_WIDTH - WO_PHASES;
    if (y < window->y1 || y >= window->y2)
        return true;
    /* All the same but for the tiles beside the window. */
    return last < window->x1 || first >= window->x2;
}

/* NULL = the tile has no blur. */
static const wo_filter_shape *shape_of(const filter_job *job, int32_t tx, int32_t ty)
{
    const wo_ray_tile *tile = wo_lens_rays_at(job->scene->rays, tx, ty);
    if (tile->class == WO_TILE_EMPTY || wo_ray_tile_straight(tile))
        return NULL;
    return wo_filter_shape_at(&job->filter, tx * WO_TILE_WIDTH, ty * WO_TILE_HEIGHT);
}

/* A tile that is left out, because the filter cannot do it and rays are not asked for. */
static bool is_without(const filter_job *job, int32_t tx, int32_t ty)
{
    const wo_filter_shape *shape = shape_of(job, tx, ty);
    return !job->with_rays && shape && shape->rest > REST_MAX;
}

static bool gather_tile(void *user, int32_t tx, int32_t ty, unsigned worker, wo_tile_pixels *pixels,
                        wo_tile_facts *facts, wo_report *part)
{
    (void)worker;
    const filter_job *job = user;
    const wo_defocus *scene = job->scene;
    const wo_ray_tile *tile = wo_lens_rays_at(scene->rays, tx, ty);
    memset(facts, 0, sizeof *facts);
    const wo_filter_shape *shape = shape_of(job, tx, ty);
    if (is_without(job, tx, ty)) {
        memset(pixels, 0, sizeof *pixels);
        return !wo_aborted(scene->context);
    }
    if (!shape || shape->rest > REST_MAX) {
        const float rays = tile->class == WO_TILE_EMPTY ? 0
                           : wo_ray_tile_straight(tile) ? 1
                                                        : (float)scene->lens->count;
        for (int i = 0; i < WO_TILE_WIDTH * WO_TILE_HEIGHT; i++)
            facts->rays[i / WO_TILE_WIDTH][i % WO_TILE_WIDTH] = rays;
        return wo_lens_rays_tile(scene->rays, scene->context, tx, ty, pixels, part);
    }
    memset(pixels, 0, sizeof *pixels);
    part->tiles[tile->class]++;
    tile_job t = {.job = job, .tile = tile, .shape = shape, .limit = reach_of(tile)};
    t.rect = wo_tile_rect(tx, ty);
    t.view = wo_filter_view_of(&job->filter, wo_rect_grow(t.rect, t.limit, t.limit));
    t.view.hole = t.shape->hole;
    find_sides(&t);
    wo_filter_taps inner;
    inner_taps(&t, &inner);
    for (int32_t row = 0; row < WO_TILE_HEIGHT; row++) {
        const uint32_t where =
            (uint32_t)tx * 0x9e3779b1u + (uint32_t)(t.rect.y1 + row) * 0x85ebca77u;
        for (int run_index = 0; run_index < WO_PHASES; run_index++) {
            if (unwanted(&job->raw.window, &t.rect, row, run_index))
                continue;
            const uint32_t set = wo_hash(where) + 0x3c6ef372u * (uint32_t)run_index;
            if (!gather_vector(&t, row, run_index, wo_hash(set) % job->lens->sets, &inner, pixels,
                               facts, part))
                return false;
        }
    }
    return true;
}

/* Rows of the raw frame around a tile, one px more on every side. */
typedef struct around {
    float c[4][WO_TILE_HEIGHT + 2][WO_TILE_WIDTH + 2 + WO_LANES];
} around;

static void read_around(const wo_frame *raw, int32_t left, int32_t low, around *out)
{
    const wo_rect r = raw->window;
    const size_t w = (size_t)wo_rect_width(r);
    for (int32_t j = 0; j < WO_TILE_HEIGHT + 2; j++) {
        const int32_t y = low + j - 1;
        for (int32_t i = 0; i < WO_TILE_WIDTH + 2; i++) {
            const int32_t x = left + i - 1;
            const bool inside = x >= r.x1 && x < r.x2 && y >= r.y1 && y < r.y2;
            const size_t at = (size_t)(y - r.y1) * w + (size_t)(x - r.x1);
            for (int k = 0; k < 4; k++)
                out->c[k][j][i] = inside ? raw->c[at][k] : 0;
        }
    }
}

static bool finish_tile(void *user, int32_t tx, int32_t ty, unsigned worker, wo_tile_pixels *pixels,
                        wo_tile_facts *facts, wo_report *part)
{
    (void)worker;
    const filter_job *job = user;
    const wo_frame *raw = &job->raw;
    const int32_t left = tx * WO_TILE_WIDTH;
    const int32_t low = ty * WO_TILE_HEIGHT;
    const wo_rect r = wo_rect_intersect(
        (wo_rect){left, low, left + WO_TILE_WIDTH, low + WO_TILE_HEIGHT}, job->frame->window);
    const size_t w = (size_t)wo_rect_width(raw->window);
    const float without = is_without(job, tx, ty) ? 1 : 0;
    around from = {0};
    float middle[4][WO_TILE_WIDTH];
    if (wo_aborted(job->scene->context))
        return false;
    memset(pixels, 0, sizeof *pixels);
    memset(facts, 0, sizeof *facts);
    read_around(raw, left, low, &from);
    for (int32_t y = r.y1; y < r.y2; y++) {
        const int32_t j = y - low;
        for (int k = 0; k < 4; k++) {
            const float *const rows[3] = {from.c[k][j] + 1, from.c[k][j + 1] + 1,
                                          from.c[k][j + 2] + 1};
            job->kernels->median(rows, WO_TILE_WIDTH, middle[k]);
        }
        for (int32_t x = r.x1; x < r.x2; x++) {
            const int32_t i = x - left;
            const size_t at = (size_t)(y - raw->window.y1) * w + (size_t)(x - raw->window.x1);
            const float part_of_taps = raw->error[at];
            for (int k = 0; k < 4; k++) {
                const float own = raw->c[at][k];
                pixels->c[j][i][k] = own + part_of_taps * (middle[k][i] - own);
            }
            pixels->guessed[j][i] = raw->guessed[at];
            facts->rays[j][i] = raw->rays[at];
            facts->mask[j][i] = without;
            facts->error[j][i] = raw->rays[at] <= 1 ? 0 : NAN;
        }
    }
    wo_tile_highlights(job->scene, tx, ty, pixels, part);
    return true;
}

/* What the taps of all tiles of the raw frame can look at. */
static wo_rect seen_area(const filter_job *job)
{
    const wo_rect tiles = job->raw.tiles;
    wo_rect area = {0};
    for (int32_t ty = tiles.y1; ty < tiles.y2; ty++) {
        for (int32_t tx = tiles.x1; tx < tiles.x2; tx++) {
            const wo_ray_tile *tile = wo_lens_rays_at(job->scene->rays, tx, ty);
            const int32_t reach = reach_of(tile);
            const wo_rect rect = wo_tile_rect(tx, ty);
            if (tile->class != WO_TILE_EMPTY && !wo_ray_tile_straight(tile))
                area = wo_rect_union(area, wo_rect_grow(rect, reach, reach));
        }
    }
    return wo_rect_intersect(area, job->scene->stack->area);
}

/* No error is estimated, so adaptive sampling has no meaning: as many taps as there are samples, or
   the next smaller lattice. */
static const wo_lens *lens_of(const wo_defocus *scene)
{
    if (!scene->quality.adaptive || scene->level_count == 0)
        return scene->lens;
    const wo_lens *lens = &scene->levels[0];
    for (int i = 1; i < scene->level_count; i++)
        if (scene->levels[i].count <= scene->quality.samples)
            lens = &scene->levels[i];
    return lens;
}

wo_status wo_filter_frame(const wo_defocus *scene, const wo_frame *frame, bool with_rays,
                          wo_report *report, wo_error *error)
{
    const wo_context *context = scene->context;
    filter_job job = {.scene = scene,
                      .lens = lens_of(scene),
                      .frame = frame,
                      .with_rays = with_rays,
                      .kernels = wo_filter_choose(wo_cpu_detect(context->cpu))};
    wo_status status =
        wo_frame_around(context, frame, wo_rect_grow(frame->window, 1, 1), 1,
                        WO_FRAME_PIXELS | WO_FRAME_RAYS | WO_FRAME_ERROR, &job.raw, error);
    if (status == WO_OK)
        status = wo_filter_scene_create(context, scene->stack, job.lens, seen_area(&job),
                                        &job.filter, error);
    if (status == WO_OK)
        status = wo_frame_tiles(scene, &job.raw, 0, 0.9, gather_tile, &job, report, error);
    if (status == WO_OK)
        status = wo_frame_tiles(scene, frame, 0.9, 1, finish_tile, &job, report, error);
    wo_filter_scene_destroy(context, &job.filter);
    wo_frame_destroy(context, &job.raw);
    return status;
}

static wo_status render(const wo_defocus *scene, const wo_frame *frame, wo_report *report,
                        wo_error *error)
{
    return wo_filter_frame(scene, frame, true, report, error);
}

const wo_renderer wo_render_filter = {
    .key = "filter", .label = "Filter", .margin = 1, .render = render};
