/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/highlights.h"

#include "defocus/highlights_image.h"
#include "defocus/lens_rays.h"
#include "defocus/point_image.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* Highlights of one vergence in a square of SQUARE px share one image, that of its middle. Images
   are made for as many of these groups at a time as fit into BATCH floats; then bands of BAND rows
   are drawn. */
enum { SQUARE = 8, BAND = 64, BATCH = 1 << 22 };

typedef struct group {
    size_t first, end; /* in the list */
    int32_t x, y;      /* middle of the square */
    size_t memory;     /* floats before its own */
    wo_point_image image;
} group;

typedef struct draw_job {
    const wo_context *context;
    wo_highlights *highlights;
    const wo_stack *stack;
    const wo_lens *lens;
    float v_most; /* no surface is nearer */
    group *groups;
    size_t from, to; /* the batch */
    float *nodes;
    double *room; /* [workers][room_size] */
    size_t room_size;
    wo_point_pixel *pixels; /* [workers][pixels_size] */
    size_t pixels_size;
    atomic_bool stop;
} draw_job;

static int32_t square_of(int32_t x)
{
    return x >= 0 ? x / SQUARE : -((SQUARE - 1 - x) / SQUARE);
}

static int order(int32_t a, int32_t b)
{
    return (a > b) - (a < b);
}

/* Highlights of a group stand together; the order does not depend on the window. */
static int compare(const void *pa, const void *pb)
{
    const wo_highlight *a = pa;
    const wo_highlight *b = pb;
    const int keys[] = {order(square_of(a->y), square_of(b->y)),
                        order(square_of(a->x), square_of(b->x)),
                        (a->v > b->v) - (a->v < b->v),
                        order(a->sheet, b->sheet),
                        order(a->y, b->y),
                        order(a->x, b->x)};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (keys[i] != 0)
            return keys[i];
    return 0;
}

static bool together(const wo_highlight *a, const wo_highlight *b)
{
    return square_of(a->y) == square_of(b->y) && square_of(a->x) == square_of(b->x) && a->v == b->v;
}

static size_t find_groups(const wo_highlights *highlights, group *groups)
{
    const wo_highlight *list = highlights->list;
    size_t count = 0;
    for (size_t i = 0; i < highlights->count; i++) {
        if (i == 0 || !together(&list[i - 1], &list[i]))
            groups[count++] = (group){.first = i,
                                      .x = square_of(list[i].x) * SQUARE + SQUARE / 2,
                                      .y = square_of(list[i].y) * SQUARE + SQUARE / 2};
        groups[count - 1].end = i + 1;
    }
    return count;
}

/* Can its light reach what is drawn? */
static bool in_sight(const draw_job *job, const group *g)
{
    const int32_t reach =
        wo_point_image_reach(job->lens, (double)job->highlights->list[g->first].v) + SQUARE;
    const wo_rect middle = {g->x, g->y, g->x + 1, g->y + 1};
    return !wo_rect_empty(
        wo_rect_intersect(wo_rect_grow(middle, reach, reach), job->highlights->drawn));
}

static void make_image(void *user, size_t index, unsigned worker)
{
    (void)worker;
    draw_job *job = user;
    group *g = &job->groups[job->from + index];
    if (wo_aborted(job->context)) {
        atomic_store(&job->stop, true);
        return;
    }
    wo_point_image_make(job->lens, g->x, g->y, (double)job->highlights->list[g->first].v,
                        job->nodes + g->memory, &g->image);
}

/* The nearest surface that rays from these pixels to the highlight may meet. */
static float nearest(const draw_job *job, const wo_highlight *h, wo_rect pixels)
{
    const double reach = job->lens->reach(job->lens->self, (double)h->v, (double)job->v_most);
    const int32_t grow = (int32_t)fmin(reach, WO_MAX_COORDINATE) + WO_RAYS_MARGIN;
    const wo_rect seen = wo_rect_intersect(wo_rect_grow(pixels, grow, grow), job->stack->area);
    float v = -INFINITY;
    unsigned flags = 0;
    for (int s = 0; s < job->stack->sheets && !wo_rect_empty(seen); s++)
        v = fmaxf(v, wo_stack_bounds(job->stack, s, seen, &flags).v_max);
    return v;
}

static float seen_part(const draw_job *job, const wo_highlight *h, int32_t x, int32_t y,
                       const wo_point_pixel *p, float v_near)
{
    float hidden = 0;
    for (int i = 0; i < 2; i++) {
        if (!(p->part[i] > 0))
            continue;
        const double bx = (double)p->b[i][0];
        const double by = (double)p->b[i][1];
        const double line[4] = {h->x - x - bx * (double)h->v, h->y - y - by * (double)h->v, bx, by};
        hidden +=
            p->part[i] * (1 - wo_highlight_seen(h, job->stack, job->lens, ~0u, x, y, line, v_near));
    }
    return fmaxf(1 - hidden, 0);
}

/* Rows y1..y2-1 of the picture. */
static void add_highlight(const draw_job *job, const group *g, const wo_highlight *h,
                          int32_t from_row, const wo_point_pixel *pixels, bool hidden, float v_near,
                          wo_rect band)
{
    const wo_highlights *highlights = job->highlights;
    const wo_rect d = highlights->drawn;
    const wo_rect disc = {g->image.rect.x1 + h->x, g->image.rect.y1 + h->y, g->image.rect.x2 + h->x,
                          g->image.rect.y2 + h->y};
    /* The lens promises that nothing is farther; what was planned goes no farther. */
    const int32_t extent = wo_highlight_extent(h->reach);
    const wo_rect planned = {h->x - extent, h->y - extent, h->x + extent + 1, h->y + extent + 1};
    const wo_rect r = wo_rect_intersect(wo_rect_intersect(disc, planned), band);
    if (wo_rect_empty(r))
        return;
    const int32_t width = wo_rect_width(g->image.rect);
    for (int32_t y = r.y1; y < r.y2; y++) {
        const wo_point_pixel *p =
            pixels + (ptrdiff_t)(y - h->y - from_row) * width + (r.x1 - disc.x1);
        float(*to)[3] = highlights->glow + (size_t)(y - d.y1) * (size_t)wo_rect_width(d) +
                        (size_t)(r.x1 - d.x1);
        for (int32_t x = r.x1; x < r.x2; x++, p++, to++) {
            if (!(p->light[0] > 0 || p->light[1] > 0 || p->light[2] > 0))
                continue;
            const float seen = hidden ? seen_part(job, h, x, y, p, v_near) : 1;
            for (int k = 0; k < 3; k++)
                (*to)[k] += seen * (p->light[k] * h->c[k]);
        }
    }
}

static void draw_group(const draw_job *job, const group *g, wo_rect band, unsigned worker)
{
    const wo_highlight *list = job->highlights->list;
    int32_t low = INT32_MAX;
    int32_t high = INT32_MIN;
    for (size_t i = g->first; i < g->end; i++) {
        low = list[i].y < low ? list[i].y : low;
        high = list[i].y > high ? list[i].y : high;
    }
    const wo_rect rect = g->image.rect;
    const int32_t y1 = band.y1 - high > rect.y1 ? band.y1 - high : rect.y1;
    const int32_t y2 = band.y2 - low < rect.y2 ? band.y2 - low : rect.y2;
    const wo_rect lit = wo_rect_intersect(band, (wo_rect){g->x - SQUARE / 2 + rect.x1, y1 + low,
                                                          g->x + SQUARE / 2 + rect.x2, y2 + high});
    if (y1 >= y2 || wo_rect_empty(lit))
        return;
    const float v_near = nearest(job, &list[g->first], lit);
    const bool hidden = v_near > wo_highlight_hidden_from(&list[g->first], job->lens);
    wo_point_pixel *pixels = job->pixels + worker * job->pixels_size;
    wo_point_image_draw(&g->image, y1, y2, hidden, job->room + worker * job->room_size, pixels);
    for (size_t i = g->first; i < g->end; i++)
        add_highlight(job, g, &list[i], y1, pixels, hidden, v_near, band);
}

static void draw_band(void *user, size_t index, unsigned worker)
{
    draw_job *job = user;
    const wo_rect drawn = job->highlights->drawn;
    const int32_t y = drawn.y1 + BAND * (int32_t)index;
    const wo_rect band = {drawn.x1, y, drawn.x2, y + BAND < drawn.y2 ? y + BAND : drawn.y2};
    for (size_t i = job->from; i < job->to; i++) {
        if (wo_aborted(job->context)) {
            atomic_store(&job->stop, true);
            return;
        }
        draw_group(job, &job->groups[i], band, worker);
    }
}

static wo_status draw_batches(draw_job *job, size_t count, wo_error *error)
{
    const int32_t rows = wo_rect_height(job->highlights->drawn);
    for (job->from = 0; job->from < count; job->from = job->to) {
        size_t floats = 0;
        for (job->to = job->from; job->to < count; job->to++) {
            group *g = &job->groups[job->to];
            const size_t own =
                wo_point_image_room(job->lens, (double)job->highlights->list[g->first].v);
            if (job->to > job->from && floats + own > BATCH)
                break;
            g->memory = floats;
            floats += own;
        }
        wo_run(job->context, make_image, job, job->to - job->from);
        if (!atomic_load(&job->stop))
            wo_run(job->context, draw_band, job, (size_t)(rows + BAND - 1) / BAND);
        if (atomic_load(&job->stop))
            return wo_fail(error, WO_ABORTED, "stopped by the user");
    }
    return WO_OK;
}

/* What the groups need at most, and memory for it. */
static wo_status make_room(draw_job *job, size_t count, wo_error *error)
{
    size_t most = 0;
    size_t all = 0;
    for (size_t i = 0; i < count; i++) {
        const double v = (double)job->highlights->list[job->groups[i].first].v;
        const size_t nodes = wo_point_image_room(job->lens, v);
        const size_t room = wo_point_image_draw_room(job->lens, v, BAND + SQUARE);
        const size_t pixels =
            (2 * (size_t)wo_point_image_reach(job->lens, v) + 1) * (BAND + SQUARE);
        most = most > nodes ? most : nodes;
        all += nodes;
        job->room_size = job->room_size > room ? job->room_size : room;
        job->pixels_size = job->pixels_size > pixels ? job->pixels_size : pixels;
    }
    const size_t batch = most > BATCH ? most : BATCH;
    const unsigned workers = wo_workers(job->context);
    job->nodes = wo_new(job->context, error, all < batch ? all : batch, sizeof *job->nodes);
    if (!job->nodes)
        return WO_ERR_NOMEM;
    job->room = wo_new(job->context, error, workers * job->room_size, sizeof *job->room);
    if (!job->room)
        return WO_ERR_NOMEM;
    job->pixels = wo_new(job->context, error, workers * job->pixels_size, sizeof *job->pixels);
    return job->pixels ? WO_OK : WO_ERR_NOMEM;
}

wo_status wo_highlights_draw(const wo_context *context, wo_highlights *highlights,
                             const wo_stack *stack, const wo_lens *lens, wo_rect window,
                             wo_error *error)
{
    if (lens->connect || highlights->count == 0 || wo_rect_empty(window))
        return WO_OK;
    const wo_rect tiles = wo_tiles_of(window);
    const wo_rect drawn = {tiles.x1 * WO_TILE_WIDTH, tiles.y1 * WO_TILE_HEIGHT,
                           tiles.x2 * WO_TILE_WIDTH, tiles.y2 * WO_TILE_HEIGHT};
    highlights->drawn = drawn;
    qsort(highlights->list, highlights->count, sizeof *highlights->list, compare);
    draw_job job = {.context = context,
                    .highlights = highlights,
                    .stack = stack,
                    .lens = lens,
                    .v_most = -INFINITY};
    unsigned flags = 0;
    for (int s = 0; s < stack->sheets; s++)
        job.v_most = fmaxf(job.v_most, wo_stack_bounds(stack, s, stack->area, &flags).v_max);
    wo_status status = WO_ERR_NOMEM;
    if (!(highlights->glow = wo_new_large(
              context, error, (size_t)wo_rect_width(drawn) * (size_t)wo_rect_height(drawn),
              sizeof *highlights->glow)) ||
        !(job.groups = wo_new(context, error, highlights->count, sizeof *job.groups)))
        goto done;
    size_t count = 0;
    const size_t all = find_groups(highlights, job.groups);
    for (size_t i = 0; i < all; i++)
        if (in_sight(&job, &job.groups[i]))
            job.groups[count++] = job.groups[i];
    status = count > 0 ? make_room(&job, count, error) : WO_OK;
    if (status == WO_OK)
        status = draw_batches(&job, count, error);
done:
    wo_delete(context, job.groups);
    wo_delete(context, job.nodes);
    wo_delete(context, job.room);
    wo_delete(context, job.pixels);
    return status;
}
