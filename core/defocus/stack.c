/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/stack.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* Rows end in spare floats, so that a vector that starts inside never leaves the memory. */
enum { SPARE = WO_LANES };

static int32_t floor_to(int32_t x, int32_t grid)
{
    const int32_t r = x % grid;
    return x - (r < 0 ? r + grid : r);
}

wo_rect wo_stack_grid(wo_rect r)
{
    return (wo_rect){floor_to(r.x1, WO_BLOCK), floor_to(r.y1, WO_CELL),
                     floor_to(r.x2 + WO_BLOCK - 1, WO_BLOCK),
                     floor_to(r.y2 + WO_CELL - 1, WO_CELL)};
}

typedef struct pack_job {
    wo_stack *stack;
    const wo_sheet *sheets[WO_SHEETS_MAX];
    const uint8_t *opaque;
    wo_rect extent;
} pack_job;

static int32_t inside(int32_t x, int32_t low, int32_t high)
{
    return x < low ? low : x >= high ? high - 1 : x;
}

/* Vergences of one sheet in a block of WO_BLOCK x WO_CELL px and in the ring around it, row by row.
   Beyond the stack its last pixels count once more. */
enum { BLOCK_RING = WO_BLOCK + 2, ROWS_RING = WO_CELL + 2 };
typedef struct block {
    float v[ROWS_RING][BLOCK_RING];
    bool any; /* surface */
} block;

static void take_block(const pack_job *job, const wo_sheet *sheet, int32_t x1, int32_t y1,
                       block *out)
{
    const wo_rect a = job->stack->area;
    const wo_rect e = job->extent;
    const wo_rect both = wo_rect_intersect(a, e);
    const bool whole = x1 > both.x1 && x1 + WO_BLOCK < both.x2;
    const ptrdiff_t w = wo_rect_width(sheet->area);
    int any = 0;
    for (int32_t j = 0; j < ROWS_RING; j++) {
        const int32_t y = inside(inside(y1 + j - 1, a.y1, a.y2), e.y1, e.y2);
        const float *from = sheet->v + (y - sheet->area.y1) * w - sheet->area.x1;
        if (whole)
            memcpy(out->v[j], from + x1 - 1, sizeof out->v[j]);
        for (int32_t i = 0; i < BLOCK_RING && !whole; i++)
            out->v[j][i] = from[inside(inside(x1 + i - 1, a.x1, a.x2), e.x1, e.x2)];
        for (int32_t i = 0; i < BLOCK_RING; i++)
            any |= out->v[j][i] == out->v[j][i];
    }
    out->any = any;
}

/* One row of a block into its runs. */
static void pack_vergence(const wo_stack *stack, const float *v, float *to)
{
    for (int run = 0; run < WO_PHASES; run++)
        for (int i = 0; i < WO_LANES; i++)
            to[run * stack->run + i] = v[WO_PHASES * i + run];
}

static void pack_colour(const pack_job *job, int s, int32_t x1, int32_t y, bool any)
{
    const wo_stack *stack = job->stack;
    const wo_sheet *sheet = job->sheets[s];
    const wo_rect e = job->extent;
    const ptrdiff_t to = wo_stack_at(stack, x1, y);
    const ptrdiff_t row = (inside(y, e.y1, e.y2) - sheet->area.y1) * wo_rect_width(sheet->area);
    const float(*from)[4] = (const float(*)[4])sheet->c + row - sheet->area.x1;
    float beyond[WO_BLOCK][4];
    if (x1 >= e.x1 && x1 + WO_BLOCK <= e.x2) {
        from += x1;
    } else {
        for (int32_t i = 0; i < WO_BLOCK && any; i++)
            memcpy(beyond[i], from[inside(x1 + i, e.x1, e.x2)], sizeof beyond[i]);
        from = (const float(*)[4])beyond;
    }
    for (int k = 0; k < 4; k++) {
        for (int run = 0; run < WO_PHASES; run++) {
            float *c = stack->c[s][k] + to + run * stack->run;
            for (int i = 0; i < WO_LANES && any; i++)
                c[i] = from[WO_PHASES * i + run][k];
            if (!any)
                memset(c, 0, WO_LANES * sizeof *c);
        }
    }
}

/* Is the scene opaque at a pixel and at all around it? Beside a transparent pixel the interpolated
   coverage is below 1, and what passes there is no loss. */
static void pack_opaque(const pack_job *job, int32_t x1, int32_t y)
{
    const wo_stack *stack = job->stack;
    const wo_rect a = job->sheets[0]->area;
    const wo_rect e = job->extent;
    const ptrdiff_t w = wo_rect_width(a);
    const ptrdiff_t to = wo_stack_at(stack, x1, y);
    const int32_t from_y = inside(y, e.y1, e.y2);
    const uint8_t *rows[3];
    for (int j = 0; j < 3; j++)
        rows[j] = job->opaque + (inside(from_y + j - 1, a.y1, a.y2) - a.y1) * w - a.x1;
    for (int32_t i = 0; i < WO_BLOCK; i++) {
        const int32_t x = inside(x1 + i, e.x1, e.x2);
        const int32_t left = x > a.x1 ? x - 1 : x;
        const int32_t right = x + 1 < a.x2 ? x + 1 : x;
        int all = 1;
        for (int j = 0; j < 3; j++)
            all &= rows[j][left] & rows[j][x] & rows[j][right];
        stack->opaque[to + i % WO_PHASES * stack->run + i / WO_PHASES] = (float)all;
    }
}

/* What the pixels of a block are, by run and place in it: a cell has two places of each run. */
typedef struct marks {
    int open[WO_PHASES][WO_LANES], lit[WO_PHASES][WO_LANES];
} marks;

static void mark_row(const wo_stack *stack, int s, int32_t x1, int32_t y, marks *out)
{
    for (int run = 0; run < WO_PHASES; run++) {
        const ptrdiff_t at = wo_stack_at(stack, x1 + run, y);
        const float *v = stack->v[s] + at;
        const float *r = stack->c[s][0] + at;
        const float *g = stack->c[s][1] + at;
        const float *b = stack->c[s][2] + at;
        const float *alpha = stack->c[s][3] + at;
        for (int i = 0; i < WO_LANES; i++) {
            const int any = v[i] == v[i];
            out->open[run][i] |= any & !(alpha[i] >= WO_OPAQUE);
            out->lit[run][i] |= any & ((r[i] != 0) | (g[i] != 0) | (b[i] != 0));
        }
    }
}

/* Vergences of a block by column, its ring included. */
typedef struct summary {
    float v_min[BLOCK_RING], v_max[BLOCK_RING]; /* without the ring above and below */
    int gaps[BLOCK_RING], gaps_around[BLOCK_RING];
    float step[BLOCK_RING]; /* largest difference of neighbours */
    float next[BLOCK_RING]; /* the same with those in the next column */
} summary;

static float larger(float a, float b)
{
    return a > b ? a : b;
}

static void sum_up(const block *b, summary *out)
{
    memset(out, 0, sizeof *out);
    for (int i = 0; i < BLOCK_RING; i++) {
        out->v_min[i] = INFINITY;
        out->v_max[i] = -INFINITY;
    }
    for (int j = 0; j < ROWS_RING; j++) {
        const float *v = b->v[j];
        const int own = j > 0 && j <= WO_CELL;
        for (int i = 0; i < BLOCK_RING; i++) {
            const int gap = !(v[i] == v[i]);
            out->gaps[i] |= gap & own;
            out->gaps_around[i] |= gap;
            out->v_min[i] = own && v[i] < out->v_min[i] ? v[i] : out->v_min[i];
            out->v_max[i] = own && v[i] > out->v_max[i] ? v[i] : out->v_max[i];
        }
        for (int i = 0; i + 1 < BLOCK_RING; i++)
            out->next[i] = larger(fabsf(v[i + 1] - v[i]), out->next[i]);
        if (j + 1 == ROWS_RING)
            break;
        const float *up = b->v[j + 1];
        for (int i = 0; i < BLOCK_RING; i++)
            out->step[i] = larger(fabsf(up[i] - v[i]), out->step[i]);
        for (int i = 0; i + 1 < BLOCK_RING; i++) {
            const float rising = fabsf(up[i + 1] - v[i]);
            const float falling = fabsf(up[i] - v[i + 1]);
            out->next[i] = larger(larger(rising, falling), out->next[i]);
        }
    }
}

/* Everything about the cells of a block; their steps together with those to the ring around
   them. */
static void bound_cells(const wo_stack *stack, int s, const summary *c, const marks *m,
                        size_t first)
{
    for (size_t cell = 0; cell < WO_BLOCK / WO_CELL; cell++) {
        const size_t left = cell * WO_CELL; /* the ring's column beside it */
        wo_bounds in = {INFINITY, -INFINITY};
        float step = larger(c->step[left], larger(c->step[left + WO_CELL + 1], c->next[left]));
        int gaps = 0;
        int around = c->gaps_around[left] | c->gaps_around[left + WO_CELL + 1];
        for (size_t i = left + 1; i <= left + WO_CELL; i++) {
            in.v_min = c->v_min[i] < in.v_min ? c->v_min[i] : in.v_min;
            in.v_max = c->v_max[i] > in.v_max ? c->v_max[i] : in.v_max;
            step = larger(larger(c->step[i], c->next[i]), step);
            gaps |= c->gaps[i];
            around |= c->gaps_around[i];
        }
        int open = 0;
        int lit = 0;
        for (int run = 0; run < WO_PHASES; run++)
            for (size_t i = left / WO_PHASES; i < (left + WO_CELL) / WO_PHASES; i++) {
                open |= m->open[run][i];
                lit |= m->lit[run][i];
            }
        stack->cells[s][first + cell] = in;
        stack->steps[s][first + cell] = around ? INFINITY : step;
        stack->flags[s][first + cell] =
            (uint8_t)((gaps ? WO_CELL_GAPS : 0) | (open ? WO_CELL_OPEN : 0) |
                      (lit ? WO_CELL_LIT : 0));
    }
}

static void pack_block(const pack_job *job, int s, int32_t x1, int32_t y1, size_t first)
{
    const wo_stack *stack = job->stack;
    block b;
    summary c;
    marks m = {0};
    take_block(job, job->sheets[s], x1, y1, &b);
    for (int32_t y = y1; y < y1 + WO_CELL; y++) {
        pack_vergence(stack, b.v[y - y1 + 1] + 1, stack->v[s] + wo_stack_at(stack, x1, y));
        pack_colour(job, s, x1, y, b.any);
        if (b.any)
            mark_row(stack, s, x1, y, &m);
    }
    if (b.any) {
        sum_up(&b, &c);
        bound_cells(stack, s, &c, &m, first);
        return;
    }
    for (size_t cell = first; cell < first + WO_BLOCK / WO_CELL; cell++) {
        stack->cells[s][cell] = (wo_bounds){INFINITY, -INFINITY};
        stack->steps[s][cell] = INFINITY;
        stack->flags[s][cell] = WO_CELL_GAPS;
    }
}

static void pack_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const pack_job *job = user;
    const wo_stack *stack = job->stack;
    const wo_rect a = stack->area;
    const int32_t y1 = a.y1 + (int32_t)index * WO_CELL;
    size_t cell = index * (size_t)stack->cell_columns;
    for (int32_t x = a.x1; x < a.x2; x += WO_BLOCK, cell += WO_BLOCK / WO_CELL) {
        for (int s = 0; s < stack->sheets; s++)
            pack_block(job, s, x, y1, cell);
        for (int32_t y = y1; y < y1 + WO_CELL; y++)
            pack_opaque(job, x, y);
    }
    const size_t spare = SPARE * sizeof(float);
    for (int32_t y = y1; y < y1 + WO_CELL; y++) {
        for (int run = 1; run <= WO_PHASES; run++) {
            const ptrdiff_t end = wo_stack_at(stack, a.x1, y) + run * stack->run - SPARE;
            memset(stack->opaque + end, 0, spare);
            for (int s = 0; s < stack->sheets; s++) {
                memset(stack->v[s] + end, 0, spare);
                for (int k = 0; k < 4; k++)
                    memset(stack->c[s][k] + end, 0, spare);
            }
        }
    }
}

/* Min/max N-buffers (Decoret 2005) of one size. */
static void span_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const pack_job *job = user;
    const wo_stack *stack = job->stack;
    const size_t columns = (size_t)stack->cell_columns;
    const size_t rows = (size_t)stack->cell_rows;
    for (int s = 0; s < stack->sheets; s++) {
        for (size_t i = 0; i < columns; i++) {
            wo_span span = {INFINITY, -INFINITY, 0};
            for (size_t j = index; j < index + WO_SPAN_Y && j < rows; j++)
                for (size_t k = i; k < i + WO_SPAN_X && k < columns; k++) {
                    const wo_bounds cell = stack->cells[s][j * columns + k];
                    const float step = stack->steps[s][j * columns + k];
                    span.v_min = cell.v_min < span.v_min ? cell.v_min : span.v_min;
                    span.v_max = cell.v_max > span.v_max ? cell.v_max : span.v_max;
                    span.step = step > span.step ? step : span.step;
                }
            stack->spans[s][index * columns + i] = span;
        }
    }
}

wo_status wo_stack_create(const wo_context *context, const wo_sheet *sheets, size_t count,
                          const uint8_t *opaque, wo_rect area, wo_rect extent, wo_stack *stack,
                          wo_error *error)
{
    area = wo_stack_grid(area);
    *stack = (wo_stack){.area = area};
    pack_job job = {.stack = stack, .opaque = opaque, .extent = extent};
    for (size_t s = 0; s < count && stack->sheets < WO_SHEETS_MAX; s++) {
        if (!sheets[s].any)
            continue;
        stack->guessed[stack->sheets] = sheets[s].guessed;
        job.sheets[stack->sheets++] = &sheets[s];
    }
    const size_t h = (size_t)wo_rect_height(area);
    stack->run = wo_rect_width(area) / WO_PHASES + SPARE;
    stack->row = stack->run * WO_PHASES;
    stack->cell_columns = wo_rect_width(area) / WO_CELL;
    stack->cell_rows = wo_rect_height(area) / WO_CELL;
    if (stack->sheets == 0)
        return WO_OK;
    const size_t plane = (size_t)stack->row * h;
    const size_t cells = (size_t)stack->cell_columns * (size_t)stack->cell_rows;
    stack->cell_memory = wo_new_raw(context, error, cells * (size_t)stack->sheets,
                                    sizeof **stack->cells + sizeof **stack->spans +
                                        sizeof **stack->steps + sizeof **stack->flags);
    stack->memory =
        wo_new_raw(context, error, plane, ((size_t)stack->sheets * 5 + 1) * sizeof *stack->memory);
    if (!stack->memory || !stack->cell_memory) {
        wo_stack_destroy(context, stack);
        return WO_ERR_NOMEM;
    }
    float *next = stack->memory;
    stack->opaque = next;
    next += plane;
    const size_t all = cells * (size_t)stack->sheets;
    wo_bounds *const bounds = stack->cell_memory;
    wo_span *const spans = (wo_span *)(bounds + all);
    float *const steps = (float *)(spans + all);
    uint8_t *const flags = (uint8_t *)(steps + all);
    for (int s = 0; s < stack->sheets; s++) {
        stack->v[s] = next;
        for (int k = 0; k < 4; k++)
            stack->c[s][k] = next + plane * (size_t)(k + 1);
        next += 5 * plane;
        stack->cells[s] = bounds + cells * (size_t)s;
        stack->spans[s] = spans + cells * (size_t)s;
        stack->steps[s] = steps + cells * (size_t)s;
        stack->flags[s] = flags + cells * (size_t)s;
    }
    wo_run(context, pack_row, &job, (size_t)stack->cell_rows);
    wo_run(context, span_row, &job, (size_t)stack->cell_rows);
    return WO_OK;
}

void wo_stack_destroy(const wo_context *context, wo_stack *stack)
{
    wo_delete(context, stack->memory);
    wo_delete(context, stack->cell_memory);
    *stack = (wo_stack){0};
}

/* Cells that touch r. */
static wo_rect cells_of(const wo_stack *stack, wo_rect r)
{
    return (wo_rect){(r.x1 - stack->area.x1) / WO_CELL, (r.y1 - stack->area.y1) / WO_CELL,
                     (r.x2 - 1 - stack->area.x1) / WO_CELL + 1,
                     (r.y2 - 1 - stack->area.y1) / WO_CELL + 1};
}

wo_bounds wo_stack_bounds(const wo_stack *stack, int sheet, wo_rect r, unsigned *flags)
{
    assert(wo_rect_contains(stack->area, r));
    wo_bounds out = {INFINITY, -INFINITY};
    const wo_rect cells = cells_of(stack, r);
    for (int32_t j = cells.y1; j < cells.y2; j++) {
        const wo_bounds *row = stack->cells[sheet] + (ptrdiff_t)j * stack->cell_columns;
        const uint8_t *flag = stack->flags[sheet] + (ptrdiff_t)j * stack->cell_columns;
        for (int32_t i = cells.x1; i < cells.x2; i++) {
            out.v_min = row[i].v_min < out.v_min ? row[i].v_min : out.v_min;
            out.v_max = row[i].v_max > out.v_max ? row[i].v_max : out.v_max;
            *flags |= flag[i];
        }
    }
    return out;
}

float wo_stack_step(const wo_stack *stack, int sheet, wo_rect r)
{
    assert(wo_rect_contains(stack->area, r));
    float step = 0;
    const wo_rect cells = cells_of(stack, r);
    for (int32_t j = cells.y1; j < cells.y2; j++) {
        const float *row = stack->steps[sheet] + (ptrdiff_t)j * stack->cell_columns;
        for (int32_t i = cells.x1; i < cells.x2; i++)
            step = row[i] > step ? row[i] : step;
    }
    return step;
}

void wo_stack_straight(const wo_stack *stack, int32_t x, int32_t y, float c[4])
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
