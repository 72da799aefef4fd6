/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/accumulate.h"

#include <math.h>
#include <string.h>

/* px of reach up to which thin pixels are interpolated. */
#define MIXED_PX 40.0
/* px that pixels are drawn beside their exact place. */
enum { DRAW_MARGIN = 4 };

void wo_thin_forget(const wo_context *context, wo_accumulator *worker)
{
    wo_delete(context, worker->thin_v);
    wo_delete(context, worker->thin_at);
    wo_delete(context, worker->thin_order);
    wo_delete(context, worker->thin_hits);
    wo_delete(context, worker->thin_around);
    worker->thin_around = NULL;
    worker->around_room = 0;
    worker->thin_hits = NULL;
    worker->thin_v = NULL;
    worker->thin_at = NULL;
    worker->thin_order = NULL;
    worker->thin_room = 0;
}

static bool make_thin_room(const wo_context *context, wo_accumulator *worker, size_t count)
{
    if (count <= worker->thin_room)
        return true;
    wo_thin_forget(context, worker);
    const size_t room = (count + count / 2 + WO_LANES) / WO_LANES * WO_LANES;
    worker->thin_v = wo_new(context, NULL, room, 3 * sizeof *worker->thin_v);
    worker->thin_at = wo_new(context, NULL, room, 2 * sizeof *worker->thin_at);
    worker->thin_order = wo_new(context, NULL, room, 4 * sizeof *worker->thin_order);
    worker->thin_hits = wo_new(context, NULL, room, 3 * sizeof *worker->thin_hits);
    if (!worker->thin_v || !worker->thin_at || !worker->thin_order || !worker->thin_hits) {
        wo_thin_forget(context, worker);
        return false;
    }
    worker->thin_room = room;
    return true;
}

/* May thin pixels of this piece be seen in the tile? */
static bool reaches(const wo_accumulate *all, const wo_piece *piece, int32_t column, int32_t row,
                    wo_rect tile)
{
    const wo_lens *lens = all->scene->lens;
    const wo_pieces *p = &all->pieces[0];
    if (piece->thin == 0)
        return false;
    const double reach = lens->reach(lens->self, (double)piece->low, (double)piece->high);
    const int32_t grow = (int32_t)ceil(reach) + DRAW_MARGIN;
    const int32_t x = p->x1 + column * WO_PIECE_WIDTH;
    const int32_t y = p->y1 + row * WO_PIECE_HEIGHT;
    const wo_rect rect = {x, y, x + WO_PIECE_WIDTH, y + WO_PIECE_HEIGHT};
    return !wo_rect_empty(wo_rect_intersect(wo_rect_grow(tile, grow, grow), rect));
}

/* Bits of a float in the order of its values. */
static uint32_t ordered(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

/* Sorts order (indices) by key, both moved; room for as many more behind each. Stable. */
static void sort_thin(uint32_t *order, uint32_t *key, size_t count, size_t room)
{
    for (int shift = 0; shift < 32; shift += 8) {
        size_t first[257] = {0};
        uint32_t *const from = shift % 16 == 0 ? order : order + room;
        uint32_t *const to = shift % 16 == 0 ? order + room : order;
        uint32_t *const from_key = shift % 16 == 0 ? key : key + room;
        uint32_t *const to_key = shift % 16 == 0 ? key + room : key;
        for (size_t i = 0; i < count; i++)
            first[(from_key[i] >> shift & 255) + 1]++;
        for (int i = 0; i < 256; i++)
            first[i + 1] += first[i];
        for (size_t i = 0; i < count; i++) {
            const size_t at = first[from_key[i] >> shift & 255]++;
            to[at] = from[i];
            to_key[at] = from_key[i];
        }
    }
}

static size_t find_thin(const wo_accumulate *all, wo_rect tile, float reach, wo_thin_at *found)
{
    const wo_pieces *p = &all->pieces[0];
    const int32_t grow = (int32_t)ceilf(reach) + DRAW_MARGIN;
    const wo_rect rect = wo_rect_intersect(wo_rect_grow(tile, grow, grow), all->scene->stack->area);
    size_t count = 0;
    for (int s = 0; s < p->sheets; s++) {
        for (int32_t j = (rect.y1 - p->y1) / WO_PIECE_HEIGHT;
             j <= (rect.y2 - 1 - p->y1) / WO_PIECE_HEIGHT; j++) {
            for (int32_t i = (rect.x1 - p->x1) / WO_PIECE_WIDTH;
                 i <= (rect.x2 - 1 - p->x1) / WO_PIECE_WIDTH; i++) {
                const wo_piece *piece = &p->piece[s][j * p->columns + i];
                if (!reaches(all, piece, i, j, tile))
                    continue;
                if (!found) {
                    count += piece->thin;
                    continue;
                }
                for (int n = 0; n < WO_PIECE_WIDTH * WO_PIECE_HEIGHT; n++) {
                    const int at = wo_piece_at(n % WO_PIECE_WIDTH, n / WO_PIECE_WIDTH);
                    if (isfinite(piece->plane[WO_PIECE_V * WO_PIECE_PLANE + at]) &&
                        isnan(piece->plane[WO_PIECE_SOLID * WO_PIECE_PLANE + at]))
                        found[count++] = (wo_thin_at){
                            .piece = piece, .at = (int16_t)at, .guessed = p->guessed[s]};
                }
            }
        }
    }
    return count;
}

static float drop_at(const wo_thin_at *thin)
{
    const float *v = thin->piece->plane + WO_PIECE_V * WO_PIECE_PLANE + thin->at;
    float drop = 0;
    for (int n = 0; n < 9; n++)
        drop = fmaxf(drop, v[0] - v[(n / 3 - 1) * WO_PIECE_ROW + n % 3 - 1]);
    return drop;
}

/* The blur of a thin pixel is small enough that its colour is interpolated in more than a few of
   the views. */
static bool is_mixed(const wo_accumulate *all, const wo_thin_at *thin)
{
    const wo_lens *lens = all->scene->lens;
    const double v = (double)thin->piece->plane[WO_PIECE_V * WO_PIECE_PLANE + thin->at];
    return lens->reach(lens->self, v, v) < MIXED_PX;
}

static bool make_around_room(const wo_accumulate *all, wo_accumulator *worker,
                             const wo_thin_at *found, size_t count)
{
    const wo_context *context = all->scene->context;
    size_t mixed = 0;
    for (size_t i = 0; i < count; i++)
        mixed += is_mixed(all, &found[i]);
    if (mixed <= worker->around_room)
        return true;
    wo_delete(context, worker->thin_around);
    worker->around_room = mixed + mixed / 2;
    worker->thin_around = wo_new(context, NULL, worker->around_room, sizeof *worker->thin_around);
    return worker->thin_around != NULL;
}

/* What a thin pixel shows, and what it is mixed with where its blur is small: for a neighbour on
   another surface its own colour stands; one where there is nothing lends nothing. */
static void look_around(wo_thin_at *thin, wo_thin_around *around)
{
    const float *const red = thin->piece->plane + WO_PIECE_RED * WO_PIECE_PLANE + thin->at;
    const float *const v = thin->piece->plane + WO_PIECE_V * WO_PIECE_PLANE + thin->at;
    for (int k = 0; k < 4; k++)
        thin->c[k] = red[k * WO_PIECE_PLANE];
    thin->drop = drop_at(thin);
    thin->around = around;
    for (int n = 0; around && n < 9; n++) {
        const int beside = (n / 3 - 1) * WO_PIECE_ROW + n % 3 - 1;
        around->away[n] = isinf(v[beside])   ? 0
                          : isnan(v[beside]) ? INFINITY
                                             : fabsf(v[beside] - v[0]);
        for (int k = 0; k < 4; k++)
            around->c[n][k] = red[k * WO_PIECE_PLANE + beside];
    }
}

bool wo_thin_gather(const wo_accumulate *all, wo_accumulator *worker, wo_rect tile, float reach,
                    wo_thin *thin)
{
    const wo_pieces *p = &all->pieces[0];
    *thin = (wo_thin){0};
    const size_t count = find_thin(all, tile, reach, NULL);
    if (count == 0)
        return true;
    if (!make_thin_room(all->scene->context, worker, count))
        return false;
    const size_t room = worker->thin_room;
    uint32_t *const order = worker->thin_order;
    uint32_t *const key = order + 2 * room;
    wo_thin_at *const found = worker->thin_at + room;
    float *const v = worker->thin_v;
    float *const x = v + room;
    float *const y = x + room;
    find_thin(all, tile, reach, found);
    if (!make_around_room(all, worker, found, count))
        return false;
    size_t mixed = 0;
    for (size_t i = 0; i < count; i++) {
        order[i] = (uint32_t)i;
        key[i] = ~ordered(found[i].piece->plane[WO_PIECE_V * WO_PIECE_PLANE + found[i].at]);
    }
    sort_thin(order, key, count, room);
    for (size_t i = 0; i < count; i++) {
        const wo_thin_at one = found[order[i]];
        const int32_t piece =
            (int32_t)((one.piece - p->pieces) % ((ptrdiff_t)p->columns * p->rows));
        worker->thin_at[i] = one;
        look_around(&worker->thin_at[i],
                    is_mixed(all, &one) ? worker->thin_around + mixed++ : NULL);
        v[i] = one.piece->plane[WO_PIECE_V * WO_PIECE_PLANE + one.at];
        x[i] = (float)(p->x1 + piece % p->columns * WO_PIECE_WIDTH + one.at % WO_PIECE_ROW - 1 -
                       tile.x1);
        y[i] = (float)(p->y1 + piece / p->columns * WO_PIECE_HEIGHT + one.at / WO_PIECE_ROW - 1 -
                       tile.y1);
    }
    size_t spare = count;
    for (; spare % WO_LANES != 0; spare++)
        v[spare] = x[spare] = y[spare] = NAN;
    *thin = (wo_thin){(int)spare, v, x, y, worker->thin_at, worker->thin_hits};
    return true;
}
