/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_STACK_H
#define WO_CORE_DEFOCUS_STACK_H

#include "base/simd.h"
#include "defocus/sheet.h"

/* The scene as the kernels read it: every sheet as five float planes over one area, edges repeated
   beyond the extent, so that no ray ever needs a bounds check.

   A row holds its pixels in WO_PHASES runs: pixel x lies in run x & 3 at place x >> 2. Sixteen
   neighbours of one run are four pixels apart in the picture; they form the vector of a kernel and
   share a lens sample, while the pixels between them use other samples: no pattern shows, and
   every load is contiguous whatever the offset. */
#define WO_PHASES      4
#define WO_BLOCK       (WO_PHASES * WO_LANES) /* px of one row that four vectors cover */
#define WO_TILE_WIDTH  WO_BLOCK
#define WO_TILE_HEIGHT 8
#define WO_SHEETS_MAX  10
#define WO_CELL        8 /* px, side of a cell of bounds */
/* What a vector can touch in WO_CELL steps of a ray, wherever it starts in a cell. */
#define WO_SPAN_X 10
#define WO_SPAN_Y 2

/* What a sheet has somewhere in a cell. */
enum {
    WO_CELL_GAPS = 1, /* no surface */
    WO_CELL_OPEN = 2, /* coverage below WO_OPAQUE */
    WO_CELL_LIT = 4   /* a colour other than black */
};
/* Lets no light through that anybody could see. */
#define WO_OPAQUE (1 - 1e-6f)

/* Bounds of one sheet over some pixels; v_min > v_max when it has no surface there. */
typedef struct wo_bounds {
    float v_min, v_max;
} wo_bounds;

/* The same over all that a vector can touch in one stretch of a ray. */
typedef struct wo_span {
    float v_min, v_max;
    float step; /* dioptres: no two neighbours differ by more; infinite where a pixel is empty */
} wo_span;

typedef struct wo_stack {
    wo_rect area;  /* x1 is a multiple of WO_BLOCK, y1 of WO_CELL */
    ptrdiff_t run; /* floats of one run of a row */
    ptrdiff_t row; /* floats of one row: WO_PHASES * run */
    int sheets;
    float *v[WO_SHEETS_MAX];
    float *c[WO_SHEETS_MAX][4]; /* finite but of no meaning where there is no surface */
    bool guessed[WO_SHEETS_MAX];
    float *opaque; /* 1 where the scene as given is opaque, there and all around, else 0 */
    float *memory;
    int32_t cell_columns, cell_rows;
    wo_bounds *cells[WO_SHEETS_MAX]; /* [rows][columns] */
    wo_span *spans[WO_SHEETS_MAX];   /* [rows][columns] over the WO_SPAN_X x WO_SPAN_Y cells from
                                        here on */
    float *steps[WO_SHEETS_MAX];     /* [rows][columns] wo_span.step of one cell */
    uint8_t *flags[WO_SHEETS_MAX];   /* [rows][columns] WO_CELL_* */
    void *cell_memory;
} wo_stack;

/* Towards minus infinity; d > 0. */
static inline int32_t wo_floor_div(int32_t x, int32_t d)
{
    return x >= 0 ? x / d : -((d - 1 - x) / d);
}

/* Tile (tx, ty) of the absolute grid, in px. */
static inline wo_rect wo_tile_rect(int32_t tx, int32_t ty)
{
    return (wo_rect){tx * WO_TILE_WIDTH, ty * WO_TILE_HEIGHT, (tx + 1) * WO_TILE_WIDTH,
                     (ty + 1) * WO_TILE_HEIGHT};
}

/* Place of pixel (x, y) in a plane. */
static inline ptrdiff_t wo_stack_at(const wo_stack *stack, int32_t x, int32_t y)
{
    const ptrdiff_t i = x - stack->area.x1;
    return (y - stack->area.y1) * stack->row + (i & (WO_PHASES - 1)) * stack->run + i / WO_PHASES;
}

/* Packs the sheets that hold anything; area is grown to the grid. sheets, all of one area, must
   cover the part of area inside extent; pixels outside repeat the nearest inside. opaque: 0
   or 1 for each pixel of the sheets' area. */
WO_NODISCARD wo_status wo_stack_create(const wo_context *context, const wo_sheet *sheets,
                                       size_t count, const uint8_t *opaque, wo_rect area,
                                       wo_rect extent, wo_stack *stack, wo_error *error);
void wo_stack_destroy(const wo_context *context, wo_stack *stack);

/* Area that wo_stack_create makes of this one. */
wo_rect wo_stack_grid(wo_rect area);

/* Bounds of a sheet over the cells that touch r, which must lie inside the area; the WO_CELL_* of
   all of them are added to *flags. */
wo_bounds wo_stack_bounds(const wo_stack *stack, int sheet, wo_rect r, unsigned *flags);

/* Largest step of vergence between neighbours, diagonal ones too, of which at least one lies in the
   same cells; infinite where the sheet is empty. */
float wo_stack_step(const wo_stack *stack, int sheet, wo_rect r);

/* Colour of the nearest surface straight through a pixel, for one whose light was all lost. c stays
   as it is where there is none. */
void wo_stack_straight(const wo_stack *stack, int32_t x, int32_t y, float c[4]);

#endif
