/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_LENS_RAYS_H
#define WO_CORE_DEFOCUS_LENS_RAYS_H

#include "defocus/march.h"
#include "wideopen/report.h"

/* The renderer of lens rays: a stack, a lens, a class for every tile; const once made. */
typedef struct wo_ray_tile {
    wo_tile_class class;
    float v_near;                    /* nearest surface of the footprint */
    float reach;                     /* px: of what can be seen */
    float footprint;                 /* px: of all sheets */
    int hidden;                      /* sheets that no ray can reach */
    wo_bounds bounds[WO_SHEETS_MAX]; /* of what can be seen of each sheet */
} wo_ray_tile;

typedef struct wo_lens_rays {
    const wo_stack *stack;
    const wo_lens *lens;
    const wo_march_kernels *kernels;
    wo_rect tiles; /* in units of tiles, absolute */
    wo_ray_tile *tile;
    float v_step; /* dioptres: neighbours closer than this are one surface for every ray */
} wo_lens_rays;

/* Below this radius a picture is sharp; below this difference of radius it has one depth. px. */
#define WO_SHARP_PX  0.05
#define WO_SINGLE_PX 1.0

/* px that a ray looks beyond its reach: interpolation and rounding. */
#define WO_RAYS_MARGIN 3
/* The same for stacks: pieces and coarser levels (pieces.h) look at whole cells beyond that. */
#define WO_STACK_MARGIN 20

/* What a plan may leave out; all of it but in tests, which look at the difference. */
enum {
    WO_LEAVE_OUT_SHARP = 1,  /* the rays of tiles without blur */
    WO_LEAVE_OUT_SINGLE = 2, /* marching in tiles of one vergence */
    WO_LEAVE_OUT_HIDDEN = 4, /* sheets, or the far part of them, that no ray can reach */
    WO_LEAVE_OUT_BLACK = 8,  /* the rays of tiles that see nothing but black */
    WO_LEAVE_OUT_ALL = 15
};

/* Tiles of the absolute grid that touch r, in units of tiles. */
wo_rect wo_tiles_of(wo_rect r);

/* The umbra (Lee et al. 2010, "Extended-umbra depth peeling", from the picture's side): is a sheet,
   over r, one opaque surface without gaps or steps of more than WO_CONNECT_PX? Then every ray that
   crosses it inside r is stopped by it, and nothing behind *v_min is seen. */
bool wo_lens_rays_blocks(const wo_lens_rays *rays, int sheet, wo_rect r, float *v_min);

/* Classes for the tiles that touch window. leave_out: WO_LEAVE_OUT_*. max_reach: no ray goes
   farther, px; the stack must hold those tiles grown by max_reach + WO_STACK_MARGIN. */
WO_NODISCARD wo_status wo_lens_rays_create(const wo_context *context, const wo_stack *stack,
                                           const wo_lens *lens, wo_rect window, double max_reach,
                                           unsigned leave_out, wo_lens_rays *rays, wo_error *error);
void wo_lens_rays_destroy(const wo_context *context, wo_lens_rays *rays);

/* One tile, whole: premultiplied colour, and the fraction of guessed light of each pixel, without
   the light of highlights. The report's rays, steps and tiles are added to. Any thread. */
typedef struct wo_tile_pixels {
    float c[WO_TILE_HEIGHT][WO_TILE_WIDTH][4];
    float guessed[WO_TILE_HEIGHT][WO_TILE_WIDTH];
} wo_tile_pixels;

/* (tx, ty) in units of tiles. Returns false when aborted. */
bool wo_lens_rays_tile(const wo_lens_rays *rays, const wo_context *context, int32_t tx, int32_t ty,
                       wo_tile_pixels *pixels, wo_report *report);

/* Is one ray through the pixel all that a pixel of the tile needs? */
static inline bool wo_ray_tile_straight(const wo_ray_tile *tile)
{
    return tile->class == WO_TILE_SHARP || tile->class == WO_TILE_BLACK;
}

/* Class and bounds of a tile. */
const wo_ray_tile *wo_lens_rays_at(const wo_lens_rays *rays, int32_t tx, int32_t ty);

/* A tile at work, for methods that want the sums of the rays themselves. Private to one worker. */
typedef struct wo_tile_work {
    const wo_lens_rays *rays;
    const wo_context *context;
    const wo_ray_tile *tile;
    int32_t tx, ty;
    wo_rect rect;
    wo_march_view view;
    wo_pencil_room room;
} wo_tile_work;

/* v_apart: see wo_march_view; INFINITY = nothing is kept apart. */
void wo_tile_work_begin(const wo_lens_rays *rays, const wo_context *context, int32_t tx, int32_t ty,
                        float v_apart, wo_tile_work *work);

/* Sums of the two halves of a pencil of the lens (which may have more or fewer rays than
   rays->lens) for one vector of pixels: rays 0..count/2-1, and the rest. A sharp or black tile
   gets one ray, in the second half. pass: other pencils for the same pixels. false when stopped. */
bool wo_tile_work_vector(wo_tile_work *work, const wo_lens *lens, unsigned pass, int32_t row,
                         int run_index, wo_march_sums halves[2]);

/* total += part. */
void wo_march_add(wo_march_sums *total, const wo_march_sums *part);

/* Pixel of lane i of these sums: colour, and true, or false when all rays were lost and the colour
   is that straight through the pixel. */
bool wo_tile_work_pixel(const wo_tile_work *work, const wo_march_sums *sums, int32_t row,
                        int run_index, int i, float c[4]);

#endif
