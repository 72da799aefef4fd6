/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/pieces.h"

#include <math.h>

/* Where the pixels of a new level come from. */
typedef struct cut_job {
    wo_pieces *to;
    const wo_stack *stack;  /* level 0 */
    const wo_pieces *finer; /* the others */
    const wo_lens *lens;
    float v_connect; /* the others */
    size_t *first;   /* [rows] pieces with surfaces: counted, then summed up */
} cut_job;

static int32_t clamp(int32_t x, int32_t low, int32_t high)
{
    return x < low ? low : x > high ? high : x;
}

/* Vergence and, unless NULL, colour of pixel (x, y) of a sheet of a level made earlier, relative to
   the level's first. */
static float finer_at(const wo_pieces *p, int s, int32_t x, int32_t y, float c[4])
{
    const wo_piece *piece = &p->piece[s][(y / WO_PIECE_HEIGHT) * p->columns + x / WO_PIECE_WIDTH];
    if (!piece->plane)
        return NAN;
    const int at = wo_piece_at(x % WO_PIECE_WIDTH, y % WO_PIECE_HEIGHT);
    for (int k = 0; c && k < 4; k++)
        c[k] = piece->plane[(WO_PIECE_RED + k) * WO_PIECE_PLANE + at];
    return piece->plane[WO_PIECE_SOLID * WO_PIECE_PLANE + at];
}

static float mean_of_four(const cut_job *job, int s, int32_t x, int32_t y, float c[4])
{
    const wo_pieces *p = job->finer;
    const int32_t right = p->columns * WO_PIECE_WIDTH - 1;
    const int32_t top = p->rows * WO_PIECE_HEIGHT - 1;
    float low = INFINITY;
    float high = -INFINITY;
    float sum = 0;
    for (int k = 0; c && k < 4; k++)
        c[k] = 0;
    for (int i = 0; i < 4; i++) {
        float one[4];
        const float v = finer_at(p, s, clamp(2 * x + (i & 1), 0, right),
                                 clamp(2 * y + (i >> 1), 0, top), c ? one : NULL);
        if (isnan(v))
            return NAN;
        low = fminf(low, v);
        high = fmaxf(high, v);
        sum += v;
        for (int k = 0; c && k < 4; k++)
            c[k] += 0.25f * one[k];
    }
    return high - low <= job->v_connect ? 0.25f * sum : NAN;
}

/* Pixel (x, y) of the new level, relative to its first; repeated beyond the area. */
static float read(const cut_job *job, int s, int32_t x, int32_t y, float c[4])
{
    const wo_pieces *to = job->to;
    x = clamp(x, 0, to->columns * WO_PIECE_WIDTH - 1);
    y = clamp(y, 0, to->rows * WO_PIECE_HEIGHT - 1);
    if (job->finer)
        return mean_of_four(job, s, x, y, c);
    const wo_stack *stack = job->stack;
    const ptrdiff_t at = wo_stack_at(stack, stack->area.x1 + x, stack->area.y1 + y);
    for (int k = 0; c && k < 4; k++)
        c[k] = stack->c[s][k][at];
    return wo_piece_vergence(stack->v[s][at], s);
}

static bool is_used(const cut_job *job, int s, int32_t column, int32_t row)
{
    for (int32_t y = 0; y < WO_PIECE_HEIGHT; y++)
        for (int32_t x = 0; x < WO_PIECE_WIDTH; x++)
            if (!isnan(read(job, s, column * WO_PIECE_WIDTH + x, row * WO_PIECE_HEIGHT + y, NULL)))
                return true;
    return false;
}

static uint8_t opaque_in(const cut_job *job, int32_t column, int32_t row)
{
    const wo_stack *stack = job->stack;
    int count = 0;
    for (int32_t y = 0; y < WO_PIECE_HEIGHT; y++)
        for (int32_t x = 0; x < WO_PIECE_WIDTH; x++)
            count += stack->opaque[wo_stack_at(stack, stack->area.x1 + column * WO_PIECE_WIDTH + x,
                                               stack->area.y1 + row * WO_PIECE_HEIGHT + y)] > 0.5f;
    return (uint8_t)(count == 0 ? 0 : 1 + (count == WO_PIECE_WIDTH * WO_PIECE_HEIGHT));
}

/* Which pieces hold anything: marked as full. */
static void count_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const cut_job *job = user;
    const wo_pieces *to = job->to;
    for (int s = 0; s < to->sheets; s++) {
        for (int32_t i = 0; i < to->columns; i++) {
            const bool used = is_used(job, s, i, (int32_t)index);
            to->piece[s][index * (size_t)to->columns + (size_t)i].full = used;
            job->first[index] += used;
        }
    }
    for (int32_t i = 0; !job->finer && i < to->columns; i++)
        to->opaque[index * (size_t)to->columns + (size_t)i] = opaque_in(job, i, (int32_t)index);
}

static bool is_void(const cut_job *job, int32_t x, int32_t y)
{
    for (int s = 0; s < job->to->sheets; s++)
        if (!isnan(read(job, s, x, y, NULL)))
            return false;
    return true;
}

static bool is_solid(const cut_job *job, const float *plane, int at)
{
    const float *v = plane + WO_PIECE_V * WO_PIECE_PLANE;
    const float *alpha = plane + WO_PIECE_ALPHA * WO_PIECE_PLANE;
    if (!(alpha[at] >= 1))
        return false;
    const wo_lens *lens = job->lens;
    const double here = (double)v[at];
    const bool sharp = lens && lens->reach(lens->self, here, here) <= WO_PIECE_SHARP_PX;
    for (int i = 0; i < 9; i++) {
        const int beside = at + (i / 3 - 1) * WO_PIECE_ROW + i % 3 - 1;
        if (isinf(v[beside]))
            return false;
        if (sharp && !isnan(v[beside]) && !(alpha[beside] >= 1))
            return false;
    }
    return true;
}

static void cut_piece(const cut_job *job, int s, int32_t column, int32_t row, float *plane,
                      wo_piece *piece)
{
    float *const v = plane + WO_PIECE_V * WO_PIECE_PLANE;
    float *const solid = plane + WO_PIECE_SOLID * WO_PIECE_PLANE;
    *piece = (wo_piece){
        .v_min = INFINITY, .v_max = -INFINITY, .low = INFINITY, .high = -INFINITY, .plane = plane};
    for (int32_t y = 0; y < WO_PIECE_HEIGHT; y++)
        piece->row[y] = (wo_piece_row){INFINITY, -INFINITY, INFINITY, -INFINITY};
    for (int32_t y = -1; y <= WO_PIECE_HEIGHT; y++) {
        for (int32_t x = -1; x <= WO_PIECE_WIDTH; x++) {
            const int at = wo_piece_at(x, y);
            const int32_t from_x = column * WO_PIECE_WIDTH + x;
            const int32_t from_y = row * WO_PIECE_HEIGHT + y;
            float c[4];
            const float here = read(job, s, from_x, from_y, c);
            v[at] = here;
            for (int k = 0; k < 4; k++)
                plane[(WO_PIECE_RED + k) * WO_PIECE_PLANE + at] = isnan(here) ? 0 : c[k];
            solid[at] = here;
            if (isnan(here)) {
                if (!job->finer && is_void(job, from_x, from_y))
                    v[at] = INFINITY;
                continue;
            }
            piece->low = fminf(piece->low, here);
            piece->high = fmaxf(piece->high, here);
            for (int32_t i = y > 0 ? y - 1 : 0; i <= y + 1 && i < WO_PIECE_HEIGHT; i++) {
                piece->row[i].low = fminf(piece->row[i].low, here);
                piece->row[i].high = fmaxf(piece->row[i].high, here);
            }
        }
    }
    piece->whole = 3;
    for (int32_t y = 0; y < WO_PIECE_HEIGHT; y++) {
        for (int32_t x = 0; x < WO_PIECE_WIDTH; x++) {
            const int at = wo_piece_at(x, y);
            const bool surface = isfinite(v[at]);
            if (!surface || !is_solid(job, plane, at)) {
                piece->thin = (uint8_t)(piece->thin + surface);
                piece->whole &= (uint8_t) ~(1 << x / WO_CELL);
                solid[at] = NAN;
                continue;
            }
            piece->row[y].v_min = fminf(piece->row[y].v_min, v[at]);
            piece->row[y].v_max = fmaxf(piece->row[y].v_max, v[at]);
        }
        piece->v_min = fminf(piece->v_min, piece->row[y].v_min);
        piece->v_max = fmaxf(piece->v_max, piece->row[y].v_max);
    }
    bool gap = false;
    for (int at = 0; at < WO_PIECE_PLANE; at++)
        gap |= !(plane[WO_PIECE_ALPHA * WO_PIECE_PLANE + at] >= 1);
    piece->full = !gap;
}

static void cut_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const cut_job *job = user;
    const wo_pieces *to = job->to;
    float *plane = to->memory + job->first[index] * WO_PIECE_PLANES * WO_PIECE_PLANE;
    for (int s = 0; s < to->sheets; s++) {
        for (int32_t i = 0; i < to->columns; i++) {
            wo_piece *piece = &to->piece[s][index * (size_t)to->columns + (size_t)i];
            const bool used = piece->full;
            *piece = (wo_piece){.v_min = INFINITY, .v_max = -INFINITY};
            if (!used)
                continue;
            cut_piece(job, s, i, (int32_t)index, plane, piece);
            plane += WO_PIECE_PLANES * WO_PIECE_PLANE;
        }
    }
}

static wo_status cut(const wo_context *context, cut_job *job, wo_error *error)
{
    wo_pieces *to = job->to;
    const size_t rows = (size_t)to->rows;
    const size_t all = rows * (size_t)to->columns;
    if (to->sheets == 0)
        return WO_OK;
    if (!(to->pieces = wo_new(context, error, all * (size_t)to->sheets, sizeof *to->pieces)) ||
        !(to->opaque = wo_new(context, error, all, sizeof *to->opaque)) ||
        !(job->first = wo_new(context, error, rows, sizeof *job->first)))
        return WO_ERR_NOMEM;
    for (int s = 0; s < to->sheets; s++)
        to->piece[s] = to->pieces + all * (size_t)s;
    wo_run(context, count_row, job, rows);
    size_t count = 0;
    for (size_t i = 0; i < rows; i++) {
        const size_t here = job->first[i];
        job->first[i] = count;
        count += here;
    }
    if (count > 0)
        to->memory = wo_new_raw(context, error, count,
                                WO_PIECE_PLANES * WO_PIECE_PLANE * sizeof *to->memory);
    if (to->memory)
        wo_run(context, cut_row, job, rows);
    wo_delete(context, job->first);
    job->first = NULL;
    return to->memory || count == 0 ? WO_OK : WO_ERR_NOMEM;
}

wo_status wo_pieces_create(const wo_context *context, const wo_stack *stack, const wo_lens *lens,
                           wo_pieces *pieces, wo_error *error)
{
    *pieces = (wo_pieces){.x1 = stack->area.x1,
                          .y1 = stack->area.y1,
                          .columns = wo_rect_width(stack->area) / WO_PIECE_WIDTH,
                          .rows = wo_rect_height(stack->area) / WO_PIECE_HEIGHT,
                          .sheets = stack->sheets};
    for (int s = 0; s < stack->sheets; s++)
        pieces->guessed[s] = stack->guessed[s];
    cut_job job = {.to = pieces, .stack = stack, .lens = lens};
    const wo_status status = cut(context, &job, error);
    if (status != WO_OK)
        wo_pieces_destroy(context, pieces);
    return status;
}

wo_status wo_pieces_coarser(const wo_context *context, const wo_pieces *finer, float v_connect,
                            wo_pieces *pieces, wo_error *error)
{
    const int32_t width = (finer->columns * WO_PIECE_WIDTH + 1) / 2;
    const int32_t height = (finer->rows * WO_PIECE_HEIGHT + 1) / 2;
    *pieces = *finer;
    pieces->level = finer->level + 1;
    pieces->x1 = finer->x1 / 2;
    pieces->y1 = finer->y1 / 2;
    pieces->columns = (width + WO_PIECE_WIDTH - 1) / WO_PIECE_WIDTH;
    pieces->rows = (height + WO_PIECE_HEIGHT - 1) / WO_PIECE_HEIGHT;
    pieces->pieces = NULL;
    pieces->opaque = NULL;
    pieces->memory = NULL;
    cut_job job = {.to = pieces, .finer = finer, .v_connect = v_connect};
    const wo_status status = cut(context, &job, error);
    if (status != WO_OK)
        wo_pieces_destroy(context, pieces);
    return status;
}

void wo_pieces_destroy(const wo_context *context, wo_pieces *pieces)
{
    wo_delete(context, pieces->pieces);
    wo_delete(context, pieces->opaque);
    wo_delete(context, pieces->memory);
    *pieces = (wo_pieces){0};
}
