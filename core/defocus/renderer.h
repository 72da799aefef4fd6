/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_RENDERER_H
#define WO_CORE_DEFOCUS_RENDERER_H

#include "defocus/highlights.h"
#include "defocus/lens_rays.h"

/* A method: from the scene (stack, highlights) and a lens to pixels. Methods know pencils, never a
   lens; a new one is one file and one row of WO_RENDERER_LIST. */

/* How much work a picture is worth. */
typedef struct wo_quality {
    int samples; /* lens rays a pixel, or what the method makes of them: >= 1 */
    bool adaptive;
    double target_error; /* adaptive: RMSE of the displayed value (sRGB curve, 0..1) of a tile */
    int max_rays;        /* adaptive: no pixel gets more */
} wo_quality;

/* What every method is given; const, shared by all workers. */
typedef struct wo_defocus {
    const wo_context *context;
    const wo_stack *stack; /* without the light that the highlights took out of it */
    const wo_lens *lens;   /* with quality.samples rays, or when adaptive the most of one pass */
    const wo_lens *levels; /* [level_count] the same lens with more and more rays, when adaptive */
    int level_count;
    const wo_lens *taps; /* the same lens with at least wo_renderer.taps rays; NULL if that is 0 */
    const wo_highlights *highlights;
    const wo_lens_rays *rays; /* the class of every tile; renders one with all rays */
    wo_rect extent;           /* where the picture has pixels */
    wo_rect format;           /* the frame the camera saw */
    wo_quality quality;
} wo_defocus;

/* A window of results, row by row; borrowed. window lies inside the planned one. */
typedef struct wo_frame {
    wo_rect window;
    wo_rect tiles;  /* wo_tiles_of(window) */
    uint8_t *skip;  /* [tiles] 1 = nobody looks at it: leave it 0; NULL = none */
    float (*c)[4];  /* premultiplied */
    float *guessed; /* fraction of the light that came from invented surfaces */
    float *rays;    /* lens rays spent on the pixel; NULL = not wanted */
    float *mask;    /* how much of the pixel rays alone decide, 0..1; NULL = not wanted */
    float *error;   /* estimated standard error of the displayed value, the mean of the squares
                       of the three colours; NAN = not known; NULL = not wanted */
} wo_frame;

/* Planes of a frame of a method's own. */
enum { WO_FRAME_PIXELS = 1, WO_FRAME_RAYS = 2, WO_FRAME_MASK = 4, WO_FRAME_ERROR = 8 };

/* Memory for window, which contains frame->window. Tiles are skipped that lie more than reach px
   from all tiles of frame that somebody looks at. Destroy in any case. */
WO_NODISCARD wo_status wo_frame_around(const wo_context *context, const wo_frame *frame,
                                       wo_rect window, int32_t reach, unsigned planes,
                                       wo_frame *around, wo_error *error);
void wo_frame_destroy(const wo_context *context, wo_frame *around);

typedef struct wo_renderer {
    const char *key;
    const char *label;
    bool estimates; /* its own error: frame->error is wanted always */
    int taps;       /* it wants scene->taps, of so many rays */
    int32_t margin; /* px round the window for which scene->rays and the stack must hold tiles */
    /* Fills all of frame. report: rays, steps, tiles and omissions are added to. Takes what memory
       it needs from the context and gives it back; polls the context for an abort. */
    wo_status (*render)(const wo_defocus *scene, const wo_frame *frame, wo_report *report,
                        wo_error *error);
} wo_renderer;

#define WO_RENDERER_LIST(X)                                                                        \
    X(WO_METHOD_HYBRID, wo_render_hybrid)                                                          \
    X(WO_METHOD_RAYS, wo_render_rays)                                                              \
    X(WO_METHOD_FILTER, wo_render_filter)                                                          \
    X(WO_METHOD_SPREAD, wo_render_spread)                                                          \
    X(WO_METHOD_ACCUMULATE, wo_render_accumulate)                                                  \
    X(WO_METHOD_REFERENCE, wo_render_reference)

typedef enum wo_method {
#define WO_METHOD_ENUM(name, renderer) name,
    WO_RENDERER_LIST(WO_METHOD_ENUM)
#undef WO_METHOD_ENUM
        WO_METHOD_COUNT
} wo_method;

#define WO_METHOD_EXTERN(name, renderer) extern const wo_renderer renderer;
WO_RENDERER_LIST(WO_METHOD_EXTERN)
#undef WO_METHOD_EXTERN

const wo_renderer *wo_renderer_of(wo_method method);

/* What a tile function fills besides its pixels. */
typedef struct wo_tile_facts {
    float rays[WO_TILE_HEIGHT][WO_TILE_WIDTH];
    float mask[WO_TILE_HEIGHT][WO_TILE_WIDTH]; /* at first 1, or 0 in tiles without blur */
    float error[WO_TILE_HEIGHT][WO_TILE_WIDTH];
} wo_tile_facts;

/* One tile; false when stopped. */
typedef bool wo_tile_function(void *user, int32_t tx, int32_t ty, unsigned worker,
                              wo_tile_pixels *pixels, wo_tile_facts *facts, wo_report *part);

/* Runs function over the tiles of a frame on all workers, puts their pixels into it, adds their
   reports up in the order of tiles, tells progress from..to. WO_ABORTED when stopped. */
WO_NODISCARD wo_status wo_frame_tiles(const wo_defocus *scene, const wo_frame *frame, double from,
                                      double to, wo_tile_function *function, void *user,
                                      wo_report *report, wo_error *error);

/* Light of the highlights on a tile, red, green and blue, which methods render without it. */
typedef float wo_tile_light[WO_TILE_HEIGHT][WO_TILE_WIDTH][3];

/* Finds it and counts the rays. False where there is none: light is 0. */
bool wo_tile_find_light(const wo_defocus *scene, int32_t tx, int32_t ty, wo_tile_light light,
                        wo_report *part);
void wo_tile_add_light(wo_tile_pixels *pixels, wo_tile_light light);
/* Both, for methods that need it only at the end. */
void wo_tile_highlights(const wo_defocus *scene, int32_t tx, int32_t ty, wo_tile_pixels *pixels,
                        wo_report *part);

/* The displayed value that errors are measured in: the sRGB curve of x cut to 0..1. */
float wo_display(float x);

#endif
