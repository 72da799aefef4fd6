/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/spread_row.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

/* Layered run-length spreading.

   A row of the picture is made from its lights, bucket by bucket from the front: each light writes
   where the levels of its point spread's row change into a row of differences, whose running sum
   is the light of the bucket. Memory is a few rows for each worker, whatever the number of buckets;
   rows are independent, and sums of whole numbers have no order.

   Buckets are put together so that one surface may lie in many of them: along the lens opening the
   parts that buckets cover are laid one beside the other until it is full, and only then over what
   was laid first. Two halves of a slanted plane add up to a whole; a surface behind a blurred edge
   fills what the edge leaves; what is behind a whole translucent surface is seen through it. */

/* Light below this fraction is not followed further. */
#define FAINT 1e-4

/* The lens opening of one colour. */
typedef struct opening {
    double laid;                       /* fraction that the newest surfaces cover */
    double through_laid, through_rest; /* light that passes there, and in the rest */
    double covered;                    /* light that was stopped */
} opening;

/* Red, green, blue, all; or the last one for all of them, where the lens treats them alike. */
enum { ALL = 3, COLOURS = 4 };

/* A pixel as far as it is made. */
typedef struct pixel {
    double c[3];
    double guessed;
    opening open[COLOURS];
    int32_t end; /* no light comes from buckets behind this one */
} pixel;

/* What a bucket sends to a pixel. */
typedef struct bucket_sums {
    double c[3];
    double cover[COLOURS];
    double present[COLOURS]; /* cover and what is there but lets light through */
    double guessed;
} bucket_sums;

/* Memory of a worker, for the pixels of a row. */
typedef struct row_room {
    uint64_t *steps;   /* [planes][width][4] differences */
    bucket_sums *sums; /* [width] */
    pixel *pixels;     /* [width] */
} row_room;

/* Of a cell of a sheet: it is one opaque surface, also with the cell to the right and above. */
enum { FILLED = 1, FILLED_RIGHT = 2, FILLED_ABOVE = 4 };

typedef struct spread_job {
    const wo_defocus *scene;
    const wo_frame *frame;
    wo_spread_light light;
    int32_t *holes; /* [h + 1][w + 1] pixels of light.rect that are not opaque, below and left */
    uint8_t *filled[WO_SHEETS_MAX]; /* [cells] */
    uint8_t *filled_memory;
    int32_t *ends;  /* [tiles] of the frame: end_of */
    row_room *room; /* [workers] */
    int32_t width;
    wo_spread_function *write;
    wo_report *parts; /* [workers] */
    atomic_bool stop;
    atomic_int done;
} spread_job;

/* Lights of class 0 are counted in steps of this part, see spread_light.h. */
#define UNIT  0x1p46
#define CLASS 0x1p-12

static double class_unit(uint32_t plane)
{
    double unit = UNIT;
    for (uint32_t class = plane / WO_LIGHT_KINDS; class > 0; class --)
        unit *= CLASS;
    return unit;
}

/* First light of a row's bucket at or right of x. */
static const wo_light *first_from(const wo_light *low, const wo_light *high, int32_t x)
{
    while (low < high) {
        const wo_light *middle = low + (high - low) / 2;
        if (middle->x < x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Writes the lights of a bucket into the differences of row y; touched: columns of each plane. */
static int64_t write_bucket(const spread_job *job, const row_room *room, wo_span_x s, int32_t y,
                            int b, wo_span_x touched[WO_LIGHT_PLANES])
{
    const wo_spread_light *light = &job->light;
    const wo_rect r = light->rect;
    const int32_t reach = light->reach[b];
    const int32_t width = s.x2 - s.x1;
    int64_t written = 0;
    wo_spread_row row = {.spreads = light->spreads,
                         .x = s.x1,
                         .width = width,
                         .reach = reach,
                         .steps = room->steps,
                         .stride = 4 * (size_t)job->width};
    for (int p = 0; p < light->planes; p++) {
        row.touched[p] = (wo_span_x){INT32_MAX, INT32_MIN};
        row.unit[p] = class_unit((uint32_t)p);
    }
    const int32_t y1 = y - reach > r.y1 ? y - reach : r.y1;
    const int32_t y2 = y + reach + 1 < r.y2 ? y + reach + 1 : r.y2;
    for (int32_t from = y1; from < y2; from++) {
        const size_t *first =
            light->first + (size_t)(from - r.y1) * (size_t)(light->buckets + 1) + b;
        const wo_light *const end = light->list + first[1];
        written +=
            job->write(&row, first_from(light->list + first[0], end, s.x1 - reach), end, y - from);
    }
    memcpy(touched, row.touched, sizeof row.touched);
    return written;
}

/* Running sums of the differences of a plane, which become 0 again. */
static void sum_plane(const row_room *room, int plane, int32_t stride, wo_span_x t)
{
    uint64_t *steps = room->steps + 4 * (size_t)plane * (size_t)stride;
    const double unit = 1 / class_unit((uint32_t)plane);
    const int kind = plane % WO_LIGHT_KINDS;
    uint64_t sum[4] = {0};
    for (int32_t x = t.x1; x < t.x2; x++) {
        double c[4];
        for (int k = 0; k < 4; k++) {
            sum[k] += steps[4 * (ptrdiff_t)x + k];
            steps[4 * (ptrdiff_t)x + k] = 0;
            c[k] = (double)(int64_t)sum[k] * unit;
        }
        bucket_sums *to = &room->sums[x];
        const bool surface = kind == WO_LIGHT_GIVEN || kind == WO_LIGHT_GUESSED;
        for (int k = surface ? ALL : 0; k < COLOURS; k++) {
            to->present[k] += c[k];
            to->cover[k] += kind != WO_LIGHT_CLEAR ? c[k] : 0;
        }
        for (int k = 0; k < 3 && surface; k++)
            to->c[k] += c[k];
        to->guessed += kind == WO_LIGHT_GUESSED ? c[3] : 0;
    }
}

static double light_left(const opening *o)
{
    return o->laid * o->through_laid + (1 - o->laid) * o->through_rest;
}

/* Lays what covers so much behind what was laid before; returns the part of it that is seen. */
static double lay(opening *o, double cover, double present)
{
    if (!(present > 1e-9))
        return 0;
    const double covers = fmin(present, 1);
    const double clear = 1 - fmin(fmax(cover / present, 0), 1);
    const double beside = fmin(covers, 1 - o->laid);
    const double over = covers - beside;
    const double part = (beside * o->through_rest + over * o->through_laid) / present;
    const double passed = beside * o->through_rest * clear;
    if (over > 0) {
        const double rest = (o->laid - over) * o->through_laid + passed;
        o->through_rest = over < 1 ? rest / (1 - over) : 0;
        o->through_laid *= clear;
        o->laid = over;
    } else {
        o->through_laid = (o->laid * o->through_laid + passed) / (o->laid + beside);
        o->laid += beside;
    }
    o->covered += part * cover;
    return part;
}

static bool sees_farther(const pixel *p, int b)
{
    return b < p->end && light_left(&p->open[ALL]) > FAINT;
}

/* Lays what a bucket holds; true when some pixel still sees farther. */
static bool lay_bucket(const spread_job *job, const row_room *room, int32_t width, int b,
                       wo_span_x touched[WO_LIGHT_PLANES])
{
    wo_span_x all = {INT32_MAX, INT32_MIN};
    for (int p = 0; p < job->light.planes; p++) {
        wo_span_x *t = &touched[p];
        if (t->x1 >= t->x2)
            continue;
        t->x1 = t->x1 > 0 ? t->x1 : 0;
        t->x2 = t->x2 < width ? t->x2 : width;
        sum_plane(room, p, job->width, *t);
        all.x1 = t->x1 < all.x1 ? t->x1 : all.x1;
        all.x2 = t->x2 > all.x2 ? t->x2 : all.x2;
    }
    const int first = job->light.same ? ALL : 0;
    for (int32_t x = all.x1; x < all.x2; x++) {
        bucket_sums *sums = &room->sums[x];
        pixel *p = &room->pixels[x];
        if (sees_farther(p, b - 1)) {
            double part[COLOURS];
            for (int k = first; k < COLOURS; k++)
                part[k] = lay(&p->open[k], sums->cover[k], sums->present[k]);
            for (int k = 0; k < 3; k++)
                p->c[k] += part[first + k < COLOURS ? first + k : ALL] * sums->c[k];
            p->guessed += part[ALL] * sums->guessed;
        }
        memset(sums, 0, sizeof *sums);
    }
    for (int32_t x = 0; x < width; x++)
        if (sees_farther(&room->pixels[x], b))
            return true;
    return false;
}

static int32_t holes_in_row(const spread_job *job, int32_t y, int32_t x1, int32_t x2)
{
    const wo_rect r = job->light.rect;
    if (y < r.y1 || y >= r.y2)
        return 0;
    x1 = (x1 < r.x1 ? r.x1 : x1) - r.x1;
    x2 = (x2 > r.x2 ? r.x2 : x2) - r.x1;
    const ptrdiff_t w = wo_rect_width(r) + 1;
    const int32_t *below = job->holes + (y - r.y1) * w;
    const int32_t *above = below + w;
    return x1 < x2 ? above[x2] - above[x1] - below[x2] + below[x1] : 0;
}

static bool any_hole(const spread_job *job, wo_rect area)
{
    const wo_rect r = job->light.rect;
    area = wo_rect_intersect(area, r);
    if (!job->holes || wo_rect_empty(area))
        return false;
    const ptrdiff_t w = wo_rect_width(r) + 1;
    const int32_t *below = job->holes + (area.y1 - r.y1) * w;
    const int32_t *above = job->holes + (area.y2 - r.y1) * w;
    const int32_t x1 = area.x1 - r.x1;
    const int32_t x2 = area.x2 - r.x1;
    return above[x2] - above[x1] - below[x2] + below[x1] > 0;
}

static wo_spread_place behind(const spread_job *job, int32_t tx, int32_t ty)
{
    const wo_ray_tile *tile = wo_lens_rays_at(job->scene->rays, tx, ty);
    float v = INFINITY;
    for (int s = 0; s < job->scene->stack->sheets; s++)
        v = tile->bounds[s].v_min <= tile->bounds[s].v_max ? fminf(v, tile->bounds[s].v_min) : v;
    return (wo_spread_place){tx * WO_TILE_WIDTH + WO_TILE_WIDTH / 2,
                             ty * WO_TILE_HEIGHT + WO_TILE_HEIGHT / 2, (double)v};
}

static wo_rect tile_footprint(const spread_job *job, int32_t tx, int32_t ty)
{
    const int32_t reach =
        (int32_t)ceilf(wo_lens_rays_at(job->scene->rays, tx, ty)->reach) + WO_RAYS_MARGIN;
    return wo_rect_grow((wo_rect){tx * WO_TILE_WIDTH, ty * WO_TILE_HEIGHT, (tx + 1) * WO_TILE_WIDTH,
                                  (ty + 1) * WO_TILE_HEIGHT},
                        reach, reach);
}

/* Fraction of the lens opening of a pixel that looks, at the farthest surface, at places where the
   scene as given is not opaque. Light that is left elsewhere saw something that no sheet holds. */
static double holes_behind(const spread_job *job, const wo_point_spread *spread, int32_t x,
                           int32_t y)
{
    double clear = 0;
    for (int32_t ey = spread->rect.y1; ey < spread->rect.y2; ey++) {
        const uint32_t *row = spread->first + (ey - spread->rect.y1);
        for (uint32_t i = row[0]; i + 1 < row[1]; i++) {
            const wo_point_step *step = &spread->steps[i];
            clear += (double)step->level[3] *
                     holes_in_row(job, y - ey, x - step[1].x + 1, x - step->x + 1);
        }
    }
    return fmin(fmax(clear, 0), 1);
}

/* Colour straight through a pixel that saw nothing. */
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

/* The nearest bucket behind which nothing is seen from a tile: a surface without gaps, steps or
   clear places fills its footprint. */
static int32_t end_of(const spread_job *job, int32_t tx, int32_t ty)
{
    const wo_stack *stack = job->scene->stack;
    const wo_ray_tile *tile = wo_lens_rays_at(job->scene->rays, tx, ty);
    const wo_rect r = wo_rect_intersect(tile_footprint(job, tx, ty), stack->area);
    const int32_t i1 = (r.x1 - stack->area.x1) / WO_CELL;
    const int32_t i2 = (r.x2 - 1 - stack->area.x1) / WO_CELL;
    const int32_t j1 = (r.y1 - stack->area.y1) / WO_CELL;
    const int32_t j2 = (r.y2 - 1 - stack->area.y1) / WO_CELL;
    int32_t end = INT32_MAX;
    for (int s = 0; s < stack->sheets; s++) {
        bool filled = tile->bounds[s].v_min <= tile->bounds[s].v_max;
        float v_min = INFINITY;
        for (int32_t j = j1; j <= j2 && filled; j++)
            for (int32_t i = i1; i <= i2 && filled; i++) {
                const ptrdiff_t at = (ptrdiff_t)j * stack->cell_columns + i;
                const int wanted =
                    FILLED | (i < i2 ? FILLED_RIGHT : 0) | (j < j2 ? FILLED_ABOVE : 0);
                filled = (job->filled[s][at] & wanted) == wanted;
                v_min = fminf(v_min, stack->cells[s][at].v_min);
            }
        const int32_t b = filled ? wo_spread_light_bucket(&job->light, (double)v_min) : end;
        end = b < end ? b : end;
    }
    return end;
}

static void start_row(const spread_job *job, const row_room *room, wo_span_x s, int32_t y)
{
    int32_t tx = INT32_MIN;
    int32_t end = 0;
    for (int32_t x = s.x1; x < s.x2; x++) {
        const wo_rect tile = wo_tiles_of((wo_rect){x, y, x + 1, y + 1});
        if (tile.x1 != tx)
            end = job->ends[(size_t)(tile.y1 - job->frame->tiles.y1) *
                                (size_t)wo_rect_width(job->frame->tiles) +
                            (size_t)(tile.x1 - job->frame->tiles.x1)];
        tx = tile.x1;
        pixel *p = &room->pixels[x - s.x1];
        *p = (pixel){.end = end};
        for (int k = 0; k < COLOURS; k++)
            p->open[k].through_laid = p->open[k].through_rest = 1;
    }
}

static void finish_pixel(const spread_job *job, const pixel *p, const wo_point_spread *holes,
                         int32_t x, int32_t y)
{
    const wo_frame *frame = job->frame;
    const size_t at = (size_t)(y - frame->window.y1) * (size_t)wo_rect_width(frame->window) +
                      (size_t)(x - frame->window.x1);
    float *c = frame->c[at];
    const double left = light_left(&p->open[ALL]);
    const double clear =
        holes && sees_farther(p, job->light.buckets) ? holes_behind(job, holes, x, y) : 0;
    const int first = job->light.same ? ALL : 0;
    double weight[COLOURS];
    bool lost = false;
    for (int k = first; k < COLOURS; k++) {
        weight[k] = p->open[k].covered + fmin(light_left(&p->open[k]), clear);
        lost |= !(weight[k] > 1e-6);
    }
    frame->guessed[at] = 1;
    if (lost) {
        straight_through(job->scene->stack, x, y, c);
        return;
    }
    for (int k = 0; k < 3; k++)
        c[k] = (float)(p->c[k] / weight[first + k < COLOURS ? first + k : ALL]);
    c[3] = (float)fmin(p->open[ALL].covered / weight[ALL], 1);
    const bool closed = !sees_farther(p, job->light.buckets);
    const double unseen = closed ? 0 : left - fmin(left, clear);
    frame->guessed[at] = (float)fmin(fmax(p->guessed / fmin(weight[ALL], 1) + unseen, 0), 1);
}

static void finish_row(const spread_job *job, const row_room *room, wo_span_x s, int32_t y)
{
    int32_t tx = INT32_MIN;
    const wo_point_spread *holes = NULL; /* NULL = none in sight of the tile */
    for (int32_t x = s.x1; x < s.x2; x++) {
        const wo_rect tile = wo_tiles_of((wo_rect){x, y, x + 1, y + 1});
        if (tile.x1 != tx)
            holes = any_hole(job, tile_footprint(job, tile.x1, tile.y1))
                        ? wo_spread_light_at(&job->light, behind(job, tile.x1, tile.y1))
                        : NULL;
        tx = tile.x1;
        finish_pixel(job, &room->pixels[x - s.x1], holes, x, y);
    }
}

static bool make_row(spread_job *job, const row_room *room, wo_span_x s, int32_t y, wo_report *part)
{
    start_row(job, room, s, y);
    for (int b = 0; b < job->light.buckets; b++) {
        wo_span_x touched[WO_LIGHT_PLANES];
        if (wo_aborted(job->scene->context))
            return false;
        part->steps += write_bucket(job, room, s, y, b, touched);
        if (!lay_bucket(job, room, s.x2 - s.x1, b, touched))
            break;
    }
    finish_row(job, room, s, y);
    return true;
}

static bool active(const spread_job *job, int32_t tx, int32_t ty)
{
    const wo_frame *frame = job->frame;
    const wo_rect tiles = frame->tiles;
    const size_t index =
        (size_t)(ty - tiles.y1) * (size_t)wo_rect_width(tiles) + (size_t)(tx - tiles.x1);
    const wo_tile_class class = wo_lens_rays_at(job->scene->rays, tx, ty)->class;
    return class != WO_TILE_EMPTY && class != WO_TILE_SHARP && !(frame->skip && frame->skip[index]);
}

/* Tiles between others that are cheaper made than left out. */
enum { GAP = 2 };

/* A row of tiles. */
static void run_row(void *user, size_t index, unsigned worker)
{
    spread_job *job = user;
    const wo_rect tiles = job->frame->tiles;
    const int32_t ty = tiles.y1 + (int32_t)index;
    for (int32_t tx = tiles.x1; tx < tiles.x2; tx++) {
        if (!active(job, tx, ty))
            continue;
        int32_t last = tx;
        for (int32_t next = tx + 1; next < tiles.x2 && next <= last + 1 + GAP; next++)
            last = active(job, next, ty) ? next : last;
        const wo_rect r = wo_rect_intersect(
            job->frame->window, (wo_rect){tx * WO_TILE_WIDTH, ty * WO_TILE_HEIGHT,
                                          (last + 1) * WO_TILE_WIDTH, (ty + 1) * WO_TILE_HEIGHT});
        for (int32_t y = r.y1; y < r.y2; y++) {
            if (atomic_load_explicit(&job->stop, memory_order_relaxed))
                return;
            if (!make_row(job, &job->room[worker], (wo_span_x){r.x1, r.x2}, y, &job->parts[worker]))
                atomic_store(&job->stop, true);
        }
        tx = last;
    }
    const wo_context *context = job->scene->context;
    const int done = atomic_fetch_add(&job->done, 1) + 1;
    if (context->progress)
        context->progress(context->progress_user, 0.95 * done / wo_rect_height(tiles));
}

/* Sharp and empty tiles; highlights. */
static bool finish_tile(void *user, int32_t tx, int32_t ty, unsigned worker, wo_tile_pixels *pixels,
                        wo_tile_facts *facts, wo_report *part)
{
    (void)worker;
    const spread_job *job = user;
    const wo_defocus *scene = job->scene;
    const wo_frame *frame = job->frame;
    const bool made = active(job, tx, ty);
    const wo_tile_class class = wo_lens_rays_at(scene->rays, tx, ty)->class;
    if (wo_aborted(scene->context))
        return false;
    if (made) {
        const int32_t left = tx * WO_TILE_WIDTH;
        const int32_t low = ty * WO_TILE_HEIGHT;
        const wo_rect r = wo_rect_intersect(
            frame->window, (wo_rect){left, low, left + WO_TILE_WIDTH, low + WO_TILE_HEIGHT});
        memset(pixels, 0, sizeof *pixels);
        part->tiles[class]++;
        for (int32_t y = r.y1; y < r.y2; y++) {
            const size_t at =
                (size_t)(y - frame->window.y1) * (size_t)wo_rect_width(frame->window) +
                (size_t)(r.x1 - frame->window.x1);
            const size_t n = (size_t)wo_rect_width(r);
            memcpy(pixels->c[y - low] + (r.x1 - left), frame->c + at, n * sizeof frame->c[0]);
            memcpy(pixels->guessed[y - low] + (r.x1 - left), frame->guessed + at,
                   n * sizeof(float));
        }
    } else if (!wo_lens_rays_tile(scene->rays, scene->context, tx, ty, pixels, part)) {
        return false;
    }
    wo_tile_highlights(scene, tx, ty, pixels, part);
    for (int32_t y = 0; y < WO_TILE_HEIGHT; y++) {
        for (int32_t x = 0; x < WO_TILE_WIDTH; x++) {
            facts->rays[y][x] = class == WO_TILE_SHARP ? 1 : 0;
            facts->error[y][x] = made ? NAN : 0;
        }
    }
    return true;
}

/* Where the scene is not opaque, as a summed area. */
static wo_status find_holes(spread_job *job, wo_error *error)
{
    const wo_stack *stack = job->scene->stack;
    const wo_rect r = job->light.rect;
    const size_t w = (size_t)wo_rect_width(r) + 1;
    job->holes =
        wo_new(job->scene->context, error, ((size_t)wo_rect_height(r) + 1) * w, sizeof *job->holes);
    if (!job->holes)
        return WO_ERR_NOMEM;
    for (int32_t y = r.y1; y < r.y2; y++) {
        int32_t *to = job->holes + (size_t)(y - r.y1 + 1) * w;
        int32_t sum = 0;
        for (int32_t x = r.x1; x < r.x2; x++) {
            sum += stack->opaque[wo_stack_at(stack, x, y)] < 0.5f;
            to[x - r.x1 + 1] = to[x - r.x1 + 1 - (ptrdiff_t)w] + sum;
        }
    }
    if (job->holes[((size_t)wo_rect_height(r) + 1) * w - 1] == 0) {
        wo_delete(job->scene->context, job->holes);
        job->holes = NULL;
    }
    return WO_OK;
}

/* True when two places of a sheet are one opaque surface. */
static bool one_surface(const spread_job *job, int s, int32_t x, int32_t y, int32_t dx, int32_t dy)
{
    const wo_stack *stack = job->scene->stack;
    if (x + dx >= stack->area.x2 || y + dy >= stack->area.y2)
        return false;
    const ptrdiff_t at = wo_stack_at(stack, x, y);
    const ptrdiff_t to = wo_stack_at(stack, x + dx, y + dy);
    const float opaque = 1 - (float)FAINT;
    return stack->c[s][ALL][at] >= opaque && stack->c[s][ALL][to] >= opaque &&
           fabsf(stack->v[s][at] - stack->v[s][to]) <=
               WO_CONNECT_PX / (float)job->light.px_per_dioptre;
}

static void fill_cells(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const spread_job *job = user;
    const wo_stack *stack = job->scene->stack;
    const int32_t y1 = stack->area.y1 + (int32_t)index * WO_CELL;
    for (int s = 0; s < stack->sheets; s++) {
        for (int32_t i = 0; i < stack->cell_columns; i++) {
            const int32_t x1 = stack->area.x1 + i * WO_CELL;
            uint8_t filled = FILLED | FILLED_RIGHT | FILLED_ABOVE;
            for (int32_t y = y1; y < y1 + WO_CELL; y++)
                for (int32_t x = x1; x < x1 + WO_CELL; x++) {
                    const bool last_x = x + 1 == x1 + WO_CELL;
                    const bool last_y = y + 1 == y1 + WO_CELL;
                    if (!one_surface(job, s, x, y, 1, 0))
                        filled &= (uint8_t) ~(last_x ? FILLED_RIGHT : FILLED);
                    if (!one_surface(job, s, x, y, 0, 1))
                        filled &= (uint8_t) ~(last_y ? FILLED_ABOVE : FILLED);
                }
            job->filled[s][index * (size_t)stack->cell_columns + (size_t)i] = filled;
        }
    }
}

static void find_ends(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const spread_job *job = user;
    const wo_rect tiles = job->frame->tiles;
    const size_t columns = (size_t)wo_rect_width(tiles);
    const int32_t ty = tiles.y1 + (int32_t)index;
    for (size_t i = 0; i < columns; i++)
        job->ends[index * columns + i] = end_of(job, tiles.x1 + (int32_t)i, ty);
}

/* How far each tile sees. */
static wo_status close_tiles(spread_job *job, wo_error *error)
{
    const wo_context *context = job->scene->context;
    const wo_stack *stack = job->scene->stack;
    const wo_rect tiles = job->frame->tiles;
    const size_t cells = (size_t)stack->cell_columns * (size_t)stack->cell_rows;
    job->filled_memory =
        wo_new(context, error, cells * (size_t)stack->sheets, sizeof *job->filled_memory);
    if (!job->filled_memory)
        return WO_ERR_NOMEM;
    for (int s = 0; s < stack->sheets; s++)
        job->filled[s] = job->filled_memory + cells * (size_t)s;
    job->ends = wo_new(context, error, (size_t)wo_rect_width(tiles) * (size_t)wo_rect_height(tiles),
                       sizeof *job->ends);
    if (!job->ends)
        return WO_ERR_NOMEM;
    wo_run(context, fill_cells, job, (size_t)stack->cell_rows);
    wo_run(context, find_ends, job, (size_t)wo_rect_height(tiles));
    return WO_OK;
}

static wo_status prepare(spread_job *job, wo_error *error)
{
    const wo_context *context = job->scene->context;
    const wo_rect tiles = job->frame->tiles;
    const size_t workers = wo_workers(context);
    WO_TRY(find_holes(job, error));
    wo_spread_place *asked = NULL;
    size_t count = 0;
    if (job->holes) {
        const size_t most = (size_t)wo_rect_width(tiles) * (size_t)wo_rect_height(tiles);
        if (!(asked = wo_new(context, error, most, sizeof *asked)))
            return WO_ERR_NOMEM;
        for (int32_t ty = tiles.y1; ty < tiles.y2; ty++)
            for (int32_t tx = tiles.x1; tx < tiles.x2; tx++)
                if (active(job, tx, ty) && any_hole(job, tile_footprint(job, tx, ty)))
                    asked[count++] = behind(job, tx, ty);
    }
    const wo_status status =
        wo_spread_light_create(job->scene, job->light.rect, asked, count, &job->light, error);
    wo_delete(context, asked);
    if (status != WO_OK)
        return status;
    WO_TRY(close_tiles(job, error));
    job->width = wo_rect_width(job->frame->window);
    const size_t w = (size_t)job->width;
    if (!(job->parts = wo_new(context, error, workers, sizeof *job->parts)) ||
        !(job->room = wo_new(context, error, workers, sizeof *job->room)))
        return WO_ERR_NOMEM;
    for (size_t i = 0; i < workers; i++) {
        row_room *room = &job->room[i];
        if (!(room->steps =
                  wo_new(context, error, (size_t)job->light.planes * w, 4 * sizeof *room->steps)) ||
            !(room->sums = wo_new(context, error, w, sizeof *room->sums)) ||
            !(room->pixels = wo_new(context, error, w, sizeof *room->pixels)))
            return WO_ERR_NOMEM;
    }
    return WO_OK;
}

/* The part of the stack that active tiles see. */
static wo_rect seen(const spread_job *job)
{
    const wo_rect tiles = job->frame->tiles;
    wo_rect all = {0};
    for (int32_t ty = tiles.y1; ty < tiles.y2; ty++)
        for (int32_t tx = tiles.x1; tx < tiles.x2; tx++)
            if (active(job, tx, ty))
                all = wo_rect_union(all, tile_footprint(job, tx, ty));
    return wo_rect_intersect(all, job->scene->stack->area);
}

static wo_status render(const wo_defocus *scene, const wo_frame *frame, wo_report *report,
                        wo_error *error)
{
    const wo_context *context = scene->context;
    spread_job job = {
        .scene = scene, .frame = frame, .write = wo_spread_choose(wo_cpu_detect(context->cpu))};
    job.light.rect = seen(&job);
    wo_status status = WO_OK;
    if (!wo_rect_empty(job.light.rect)) {
        status = prepare(&job, error);
        if (status == WO_OK) {
            wo_run(context, run_row, &job, (size_t)wo_rect_height(frame->tiles));
            if (atomic_load(&job.stop))
                status = wo_fail(error, WO_ABORTED, "stopped by the user");
        }
        for (size_t i = 0; job.parts && i < wo_workers(context); i++)
            wo_report_add(report, &job.parts[i]);
    }
    if (status == WO_OK)
        status = wo_frame_tiles(scene, frame, 0.95, 1, finish_tile, &job, report, error);
    for (size_t i = 0; job.room && i < wo_workers(context); i++) {
        wo_delete(context, job.room[i].steps);
        wo_delete(context, job.room[i].sums);
        wo_delete(context, job.room[i].pixels);
    }
    wo_delete(context, job.room);
    wo_delete(context, job.parts);
    wo_delete(context, job.holes);
    wo_delete(context, job.filled_memory);
    wo_delete(context, job.ends);
    wo_spread_light_destroy(context, &job.light);
    return status;
}

const wo_renderer wo_render_spread = {.key = "spread", .label = "Spread", .render = render};
