/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_PIECES_H
#define WO_CORE_DEFOCUS_PIECES_H

#include "defocus/stack.h"
#include "optics/pencil.h"

/* A stack cut into pieces of 16 x 8 px for drawing (render_accumulate.c): what is solid by whole
   vectors, what is not by single pixels. Coarser levels hold means of 2 x 2 pixels of the next
   finer one (Jeong, section 3.2: discrete levels of detail). Const once made. */
enum {
    WO_PIECE_WIDTH = WO_LANES,
    WO_PIECE_HEIGHT = WO_CELL,
    WO_PIECE_ROW = WO_PIECE_WIDTH + 2, /* floats of a row: a ring of neighbours goes around */
    WO_PIECE_PLANE = WO_PIECE_ROW * (WO_PIECE_HEIGHT + 2)
};

/* Planes of a piece. SOLID: the vergence of solid pixels, NaN elsewhere. V: of all; NaN where this
   sheet has no surface, +infinity where no sheet has one. */
enum {
    WO_PIECE_SOLID,
    WO_PIECE_V,
    WO_PIECE_RED,
    WO_PIECE_ALPHA = WO_PIECE_RED + 3,
    WO_PIECE_PLANES
};

/* Solid: coverage 1, and no neighbour where no sheet has a surface; where the blur is small also no
   neighbour on the same sheet with coverage below 1, as colours are interpolated there. The other
   pixels are thin. */
#define WO_PIECE_SHARP_PX 6
typedef struct wo_piece_row {
    float v_min, v_max; /* of the solid pixels of a row */
    float low, high;    /* of all surfaces of the row and of its neighbours */
} wo_piece_row;

typedef struct wo_piece {
    float v_min, v_max; /* of its solid pixels; v_min > v_max: none */
    float low, high;    /* of all its surfaces and those of the ring */
    bool full;          /* there is one everywhere, of coverage 1 */
    uint8_t whole;      /* bit i: all pixels of cell i of the two that it covers are solid */
    uint8_t thin;       /* pixels that are thin */
    const float *plane; /* [WO_PIECE_PLANES][WO_PIECE_PLANE]; NULL = no surface */
    wo_piece_row row[WO_PIECE_HEIGHT];
} wo_piece;

/* Place of pixel (x, y) of a piece, 0,0 = its first own, in one of its planes. */
static inline int wo_piece_at(int x, int y)
{
    return (y + 1) * WO_PIECE_ROW + x + 1;
}

/* Vergence v of a sheet as its pieces hold it. Where vergences are equal the first sheet is the
   nearest: later ones go behind it by the least that can be told. */
static inline float wo_piece_vergence(float v, int sheet)
{
    return v - (float)sheet * ((v < 0 ? -v : v) * 1.2e-7f + 1e-30f);
}

#define WO_LEVELS 3

typedef struct wo_pieces {
    int level;      /* its pixels are 2^level px wide */
    int32_t x1, y1; /* first pixel, in pixels of the level */
    int32_t columns, rows;
    int sheets;
    bool guessed[WO_SHEETS_MAX];
    wo_piece *piece[WO_SHEETS_MAX]; /* [rows][columns] */
    wo_piece *pieces;
    uint8_t *opaque; /* [rows][columns] level 0: 0 nowhere opaque in the piece, 1 in parts, 2 all */
    float *memory;
} wo_pieces;

/* Level 0. */
WO_NODISCARD wo_status wo_pieces_create(const wo_context *context, const wo_stack *stack,
                                        const wo_lens *lens, wo_pieces *pieces, wo_error *error);

/* The next coarser level. A pixel whose four are not solid and one surface (vergences no more than
   v_connect apart, dioptres) is left empty. */
WO_NODISCARD wo_status wo_pieces_coarser(const wo_context *context, const wo_pieces *finer,
                                         float v_connect, wo_pieces *pieces, wo_error *error);
void wo_pieces_destroy(const wo_context *context, wo_pieces *pieces);

#endif
