/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/stack.h"

#include <math.h>

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

/* Is the scene opaque at a pixel and at all around it? Beside a transparent pixel the interpolated
   coverage is below 1, and what passes there is no loss. */
static bool opaque_around(const pack_job *job, int32_t x, int32_t y)
{
    const wo_rect a = job->sheets[0]->area;
    const ptrdiff_t w = wo_rect_width(a);
    bool all = true;
    for (int32_t ny = y > a.y1 ? y - 1 : y; ny <= y + 1 && ny < a.y2; ny++)
        for (int32_t nx = x > a.x1 ? x - 1 : x; nx <= x + 1 && nx < a.x2; nx++)
            all &= job->opaque[(ny - a.y1) * w + nx - a.x1];
    return all;
}

static void pack_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const pack_job *job = user;
    const wo_stack *stack = job->stack;
    const int32_t y = stack->area.y1 + (int32_t)index;
    const wo_rect e = job->extent;
    const int32_t from_y = y < e.y1 ? e.y1 : y >= e.y2 ? e.y2 - 1 : y;
    for (int s = 0; s < stack->sheets; s++) {
        const wo_sheet *sheet = job->sheets[s];
        const ptrdiff_t w = wo_rect_width(sheet->area);
        const ptrdiff_t from = (from_y - sheet->area.y1) * w - sheet->area.x1;
        for (int32_t x = stack->area.x1; x < stack->area.x2; x++) {
            const int32_t from_x = x < e.x1 ? e.x1 : x >= e.x2 ? e.x2 - 1 : x;
            const ptrdiff_t to = wo_stack_at(stack, x, y);
            stack->v[s][to] = sheet->v[from + from_x];
            for (int k = 0; k < 4; k++)
                stack->c[s][k][to] = sheet->c[from + from_x][k];
            if (s == 0)
                stack->opaque[to] = opaque_around(job, from_x, from_y);
        }
    }
}

static int32_t inside(int32_t x, int32_t low, int32_t high)
{
    return x < low ? low : x >= high ? high - 1 : x;
}

/* A cell and the ring of pixels around it. */
enum { RING = WO_CELL + 2 };
typedef float patch[RING][RING];

/* Largest difference of neighbours; infinite with a gap among them. */
static float step_of(patch v)
{
    float step = 0;
    for (int y = 0; y < RING; y++) {
        for (int x = 0; x < RING; x++) {
            const float here = v[y][x];
            const float others[4] = {x + 1 < RING ? v[y][x + 1] : here,
                                     y + 1 < RING ? v[y + 1][x] : here,
                                     x + 1 < RING && y + 1 < RING ? v[y + 1][x + 1] : here,
                                     x > 0 && y + 1 < RING ? v[y + 1][x - 1] : here};
            for (int k = 0; k < 4; k++) {
                const float d = fabsf(others[k] - here);
                step = d <= step ? step : d;
            }
        }
    }
    return isnan(step) ? INFINITY : step;
}

/* Everything about one cell; its steps together with those to the ring around it. */
static void bound_cell(const wo_stack *stack, int s, int32_t x1, int32_t y1, size_t cell)
{
    const wo_rect a = stack->area;
    wo_bounds in = {INFINITY, -INFINITY};
    unsigned flags = 0;
    bool gap_around = false;
    patch v;
    for (int32_t j = 0; j < RING; j++) {
        for (int32_t i = 0; i < RING; i++) {
            const ptrdiff_t at =
                wo_stack_at(stack, inside(x1 + i - 1, a.x1, a.x2), inside(y1 + j - 1, a.y1, a.y2));
            v[j][i] = stack->v[s][at];
            gap_around |= isnan(v[j][i]);
            if (i < 1 || i > WO_CELL || j < 1 || j > WO_CELL)
                continue;
            if (isnan(v[j][i])) {
                flags |= WO_CELL_GAPS;
                continue;
            }
            in.v_min = v[j][i] < in.v_min ? v[j][i] : in.v_min;
            in.v_max = v[j][i] > in.v_max ? v[j][i] : in.v_max;
            if (!(stack->c[s][3][at] >= WO_OPAQUE))
                flags |= WO_CELL_OPEN;
            for (int k = 0; k < 3; k++)
                if (stack->c[s][k][at] != 0)
                    flags |= WO_CELL_LIT;
        }
    }
    stack->cells[s][cell] = in;
    stack->steps[s][cell] = gap_around ? INFINITY : step_of(v);
    stack->flags[s][cell] = (uint8_t)flags;
}

static void bound_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const pack_job *job = user;
    const wo_stack *stack = job->stack;
    const size_t first = index * (size_t)stack->cell_columns;
    for (int s = 0; s < stack->sheets; s++)
        for (int32_t i = 0; i < stack->cell_columns; i++)
            bound_cell(stack, s, stack->area.x1 + i * WO_CELL,
                       stack->area.y1 + (int32_t)index * WO_CELL, first + (size_t)i);
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
    if (stack->sheets > 0) {
        const size_t plane = (size_t)stack->row * h;
        const size_t cells = (size_t)stack->cell_columns * (size_t)stack->cell_rows;
        stack->cell_memory = wo_new(context, error, cells * (size_t)stack->sheets,
                                    sizeof **stack->cells + sizeof **stack->spans +
                                        sizeof **stack->steps + sizeof **stack->flags);
        stack->memory = wo_new_large(context, error, plane,
                                     ((size_t)stack->sheets * 5 + 1) * sizeof *stack->memory);
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
    }
    wo_run(context, pack_row, &job, h);
    wo_run(context, bound_row, &job, (size_t)stack->cell_rows);
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
