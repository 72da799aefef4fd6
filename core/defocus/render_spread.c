/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/spread_ends.h"
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

/* A row on its way. */
typedef struct row_room {
    wo_spread_row row;
    bucket_sums *sums; /* [width] */
    pixel *pixels;     /* [width] */
    bool open;         /* some pixel sees farther */
} row_room;

typedef struct spread_job {
    const wo_defocus *scene;
    const wo_frame *frame;
    wo_spread_light light;
    int32_t *holes; /* [h + 1][w + 1] pixels of light.rect that are not opaque, below and left */
    int32_t *ends;  /* [tiles] of the frame: buckets that each sees last */
    row_room *room; /* [workers][WO_TILE_HEIGHT] */
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

/* Writes the lights of a bucket into the differences of rows y1..y2 - 1, which share what they read
   of the scene. */
static int64_t write_bucket(const spread_job *job, row_room *rooms, wo_span_x s, int32_t y1,
                            int32_t y2, int b)
{
    const wo_spread_light *light = &job->light;
    const wo_rect r = light->rect;
    const int32_t reach = light->reach[b];
    int64_t written = 0;
    for (int32_t y = y1; y < y2; y++) {
        wo_spread_row *row = &rooms[y - y1].row;
        row->x = s.x1;
        row->width = s.x2 - s.x1;
        row->reach = reach;
        for (int p = 0; p < light->planes; p++)
            row->touched[p] = (wo_span_x){INT32_MAX, INT32_MIN};
    }
    const int32_t first_y = y1 - reach > r.y1 ? y1 - reach : r.y1;
    const int32_t end_y = y2 + reach < r.y2 ? y2 + reach : r.y2;
    for (int32_t from = first_y; from < end_y; from++) {
        const size_t *first =
            light->first + (size_t)(from - r.y1) * (size_t)(light->buckets + 1) + b;
        if (first[0] == first[1])
            continue;
        const wo_light *const end = light->list + first[1];
        const wo_light *const start = first_from(light->list + first[0], end, s.x1 - reach);
        for (int32_t y = y1; y < y2; y++)
            if (rooms[y - y1].open && y - from <= reach && from - y <= reach)
                written += job->write(&rooms[y - y1].row, start, end, y - from);
    }
    return written;
}

/* Running sums of the differences of a plane, which become 0 again. */
static void sum_plane(const row_room *room, int plane, wo_span_x t)
{
    uint64_t *steps = room->row.steps + (size_t)plane * room->row.stride;
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
    return b < p->end && light_left(&p->open[ALL]) > WO_SPREAD_FAINT;
}

/* Lays what a bucket holds; true when some pixel still sees farther. */
static bool lay_bucket(const spread_job *job, const row_room *room, int b)
{
    const int32_t width = room->row.width;
    wo_span_x all = {INT32_MAX, INT32_MIN};
    for (int p = 0; p < job->light.planes; p++) {
        wo_span_x t = room->row.touched[p];
        t.x1 = t.x1 > 0 ? t.x1 : 0;
        t.x2 = t.x2 < width ? t.x2 : width;
        if (t.x1 >= t.x2)
            continue;
        sum_plane(room, p, t);
        all.x1 = t.x1 < all.x1 ? t.x1 : all.x1;
        all.x2 = t.x2 > all.x2 ? t.x2 : all.x2;
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
        wo_stack_straight(job->scene->stack, x, y, c);
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
            holes = any_hole(job, wo_spread_footprint(job->scene, tile.x1, tile.y1))
                        ? wo_spread_light_at(&job->light, behind(job, tile.x1, tile.y1))
                        : NULL;
        tx = tile.x1;
        finish_pixel(job, &room->pixels[x - s.x1], holes, x, y);
    }
}

static bool make_rows(spread_job *job, row_room *rooms, wo_span_x s, int32_t y1, int32_t y2,
                      wo_report *part)
{
    for (int32_t y = y1; y < y2; y++) {
        start_row(job, &rooms[y - y1], s, y);
        rooms[y - y1].open = true;
    }
    bool open = true;
    for (int b = 0; b < job->light.buckets && open; b++) {
        if (wo_aborted(job->scene->context))
            return false;
        part->steps += write_bucket(job, rooms, s, y1, y2, b);
        open = false;
        for (int32_t y = y1; y < y2; y++) {
            row_room *room = &rooms[y - y1];
            room->open = room->open && lay_bucket(job, room, b);
            open |= room->open;
        }
    }
    for (int32_t y = y1; y < y2; y++)
        finish_row(job, &rooms[y - y1], s, y);
    return true;
}

static bool active(const spread_job *job, int32_t tx, int32_t ty)
{
    const wo_frame *frame = job->frame;
    const wo_rect tiles = frame->tiles;
    const size_t index =
        (size_t)(ty - tiles.y1) * (size_t)wo_rect_width(tiles) + (size_t)(tx - tiles.x1);
    const wo_ray_tile *tile = wo_lens_rays_at(job->scene->rays, tx, ty);
    return tile->class != WO_TILE_EMPTY && !wo_ray_tile_straight(tile) &&
           !(frame->skip && frame->skip[index]);
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
        if (atomic_load_explicit(&job->stop, memory_order_relaxed))
            return;
        if (!make_rows(job, &job->room[worker * WO_TILE_HEIGHT], (wo_span_x){r.x1, r.x2}, r.y1,
                       r.y2, &job->parts[worker]))
            atomic_store(&job->stop, true);
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
    const wo_ray_tile *tile = wo_lens_rays_at(scene->rays, tx, ty);
    if (wo_aborted(scene->context))
        return false;
    if (made) {
        const int32_t left = tx * WO_TILE_WIDTH;
        const int32_t low = ty * WO_TILE_HEIGHT;
        const wo_rect r = wo_rect_intersect(
            frame->window, (wo_rect){left, low, left + WO_TILE_WIDTH, low + WO_TILE_HEIGHT});
        memset(pixels, 0, sizeof *pixels);
        part->tiles[tile->class]++;
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
            facts->rays[y][x] = wo_ray_tile_straight(tile) ? 1 : 0;
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
                if (active(job, tx, ty) && any_hole(job, wo_spread_footprint(job->scene, tx, ty)))
                    asked[count++] = behind(job, tx, ty);
    }
    const wo_status status =
        wo_spread_light_create(job->scene, job->light.rect, asked, count, &job->light, error);
    wo_delete(context, asked);
    if (status != WO_OK)
        return status;
    WO_TRY(wo_spread_ends_create(job->scene, &job->light, tiles, &job->ends, error));
    const size_t w = (size_t)wo_rect_width(job->frame->window);
    if (!(job->parts = wo_new(context, error, workers, sizeof *job->parts)) ||
        !(job->room = wo_new(context, error, workers * WO_TILE_HEIGHT, sizeof *job->room)))
        return WO_ERR_NOMEM;
    const size_t planes = (size_t)job->light.planes;
    for (size_t i = 0; i < workers * WO_TILE_HEIGHT; i++) {
        row_room *room = &job->room[i];
        wo_spread_row *row = &room->row;
        row->spreads = job->light.spreads;
        row->stride = 4 * w;
        for (uint32_t p = 0; p < planes; p++)
            row->unit[p] = class_unit(p);
        if (!(row->steps = wo_new(context, error, planes * w, 4 * sizeof *row->steps)) ||
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
                all = wo_rect_union(all, wo_spread_footprint(job->scene, tx, ty));
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
    for (size_t i = 0; job.room && i < WO_TILE_HEIGHT * wo_workers(context); i++) {
        wo_delete(context, job.room[i].row.steps);
        wo_delete(context, job.room[i].sums);
        wo_delete(context, job.room[i].pixels);
    }
    wo_delete(context, job.room);
    wo_delete(context, job.parts);
    wo_delete(context, job.holes);
    wo_delete(context, job.ends);
    wo_spread_light_destroy(context, &job.light);
    return status;
}

const wo_renderer wo_render_spread = {.key = "spread", .label = "Spread", .render = render};
