/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/highlights.h"

#include "defocus/highlights_image.h"
#include "defocus/march.h"

#include <math.h>
#include <string.h>

typedef struct take_job {
    wo_sheet *sheets;
    size_t sheet_count;
    const wo_lens *lens;
    wo_highlights *out;
    wo_rect tiles; /* of counts: one more on all sides than out->tiles */
    size_t *counts;
} take_job;

/* Vergences of highlights are rounded to steps of 1/QUANTUM px of blur, so that many share one
   image. Images that are drawn are rounded to twice as much for each QUANTUM_EVEN px. */
#define QUANTUM      32.0
#define QUANTUM_EVEN 16.0

/* What makes a pixel of a sheet a highlight. */
typedef struct spot {
    float v;     /* rounded */
    float reach; /* px */
    float taken; /* of its light, 0..1 */
} spot;

/* Part of the light above the level that is connected: a blur that grows slowly may not change the
   picture at once. */
static float fade(double reach)
{
    const double t = (reach - WO_HIGHLIGHT_FROM) / (WO_HIGHLIGHT_WHOLE - WO_HIGHLIGHT_FROM);
    return (float)(t >= 1 ? 1 : t * t * (3 - 2 * t));
}

static inline bool is_bright(const float c[4])
{
    return (c[0] > WO_HIGHLIGHT_LEVEL) | (c[1] > WO_HIGHLIGHT_LEVEL) | (c[2] > WO_HIGHLIGHT_LEVEL);
}

/* Light of a highlight that stays. Rays of a lens with a table each carry one wavelength, and what
   is left to them shows as coloured grain: little is, from twice the level on. */
static float rest_of(const wo_lens *lens, float peak)
{
    const float part = lens->connect ? 0 : fminf(peak / WO_HIGHLIGHT_LEVEL - 1, 1);
    return WO_HIGHLIGHT_LEVEL + part * (WO_HIGHLIGHT_REST - WO_HIGHLIGHT_LEVEL);
}

/* One bright pixel of a sheet that is a highlight, or not. */
static bool is_highlight(const take_job *job, const wo_sheet *sheet, size_t at, spot *found)
{
    const float *c = sheet->c[at];
    if (isnan(sheet->v[at]))
        return false;
    const float peak = fmaxf(c[0], fmaxf(c[1], c[2]));
    const wo_lens *lens = job->lens;
    double step = lens->px_per_dioptre * QUANTUM;
    const double radius = fabs((double)sheet->v[at]) * lens->px_per_dioptre;
    if (!lens->connect && radius > QUANTUM_EVEN)
        step /= exp2(floor(log2(radius / QUANTUM_EVEN)) + 1);
    found->v = (float)(rint(sheet->v[at] * step) / step);
    found->reach = (float)lens->reach(lens->self, found->v, found->v);
    const double exact = lens->reach(lens->self, sheet->v[at], sheet->v[at]);
    if (!(exact > WO_HIGHLIGHT_FROM))
        return false;
    found->taken = fade(exact) * (peak - rest_of(lens, peak)) / peak;
    return true;
}

static wo_rect tile_of(wo_rect tiles, size_t index)
{
    const int32_t columns = wo_rect_width(tiles);
    const int32_t tx = tiles.x1 + (int32_t)(index % (size_t)columns);
    const int32_t ty = tiles.y1 + (int32_t)(index / (size_t)columns);
    return wo_tile_rect(tx, ty);
}

static void count_tile(void *user, size_t index, unsigned worker)
{
    (void)worker;
    take_job *job = user;
    spot found;
    for (size_t s = 0; s < job->sheet_count; s++) {
        const wo_sheet *sheet = &job->sheets[s];
        const wo_rect r = wo_rect_intersect(tile_of(job->tiles, index), sheet->area);
        const int32_t w = wo_rect_width(sheet->area);
        for (int32_t y = r.y1; sheet->any && y < r.y2; y++)
            for (int32_t x = r.x1; x < r.x2; x++) {
                const size_t at = (size_t)((y - sheet->area.y1) * w + x - sheet->area.x1);
                if (is_bright(sheet->c[at]))
                    job->counts[index] += is_highlight(job, sheet, at, &found);
            }
    }
}

/* Lists the highlights of a tile; the sheets stay as they are. */
static void list_tile(void *user, size_t index, unsigned worker)
{
    (void)worker;
    take_job *job = user;
    wo_highlight *to = job->out->list + job->out->first[index];
    if (job->out->first[index + 1] == job->out->first[index])
        return;
    int packed = 0; /* place of the sheet in the stack, which has no empty ones */
    for (size_t s = 0; s < job->sheet_count; s++) {
        const wo_sheet *sheet = &job->sheets[s];
        const wo_rect r = wo_rect_intersect(tile_of(job->out->tiles, index), sheet->area);
        const int32_t w = wo_rect_width(sheet->area);
        for (int32_t y = r.y1; sheet->any && y < r.y2; y++) {
            for (int32_t x = r.x1; x < r.x2; x++) {
                const size_t at = (size_t)((y - sheet->area.y1) * w + x - sheet->area.x1);
                spot found;
                if (is_bright(sheet->c[at]) && is_highlight(job, sheet, at, &found))
                    *to++ = (wo_highlight){.x = x,
                                           .y = y,
                                           .v = found.v,
                                           .reach = found.reach,
                                           .taken = found.taken,
                                           .sheet = packed};
            }
        }
        packed += sheet->any;
    }
}

/* Takes the light of a tile's highlights out of the sheets. */
static void take_tile(void *user, size_t index, unsigned worker)
{
    (void)worker;
    take_job *job = user;
    wo_sheet *sheet = job->sheets;
    int packed = 0;
    for (size_t i = job->out->first[index]; i < job->out->first[index + 1]; i++) {
        wo_highlight *h = &job->out->list[i];
        for (; packed < h->sheet || !sheet->any; sheet++)
            packed += sheet->any;
        const size_t at =
            (size_t)((h->y - sheet->area.y1) * wo_rect_width(sheet->area) + h->x - sheet->area.x1);
        const double part = job->out->images ? job->out->images[h->image].share : 1;
        /* Slits that no pixel looks through: the light stays with the surface. */
        h->taken = part > 0 ? h->taken : 0;
        for (int k = 0; k < 3; k++) {
            h->c[k] = (float)(part * h->taken) * sheet->c[at][k];
            sheet->c[at][k] -= h->taken * sheet->c[at][k];
        }
    }
}

/* True when so many pixels of a tile of out->tiles and the eight around it are bright, of those
   that there are, that they are an area of light. */
static bool crowded(const take_job *job, int32_t tx, int32_t ty)
{
    size_t bright = 0;
    size_t pixels = 0;
    const int32_t columns = wo_rect_width(job->tiles);
    for (int32_t y = ty - 1; y <= ty + 1; y++) {
        for (int32_t x = tx - 1; x <= tx + 1; x++) {
            const size_t index = (size_t)((y - job->tiles.y1) * columns + x - job->tiles.x1);
            const wo_rect r = wo_rect_intersect(tile_of(job->tiles, index), job->sheets[0].area);
            bright += job->counts[index];
            pixels += (size_t)wo_rect_width(r) * (size_t)wo_rect_height(r);
        }
    }
    return (double)bright > WO_HIGHLIGHT_CROWD * (double)pixels;
}

wo_status wo_highlights_take(const wo_context *context, wo_sheet *sheets, size_t count,
                             wo_rect area, const wo_lens *lens, wo_highlights *highlights,
                             wo_error *error)
{
    *highlights = (wo_highlights){0};
    if ((!lens->connect && !lens->iris.rays) || wo_rect_empty(area))
        return WO_OK;
    const wo_rect tiles = {wo_floor_div(area.x1, WO_TILE_WIDTH),
                           wo_floor_div(area.y1, WO_TILE_HEIGHT),
                           wo_floor_div(area.x2 - 1, WO_TILE_WIDTH) + 1,
                           wo_floor_div(area.y2 - 1, WO_TILE_HEIGHT) + 1};
    highlights->tiles = tiles;
    take_job job = {sheets, count, lens, highlights, wo_rect_grow(tiles, 1, 1), NULL};
    const size_t counted = (size_t)wo_rect_width(job.tiles) * (size_t)wo_rect_height(job.tiles);
    const size_t taken = (size_t)wo_rect_width(tiles) * (size_t)wo_rect_height(tiles);
    wo_status status = WO_ERR_NOMEM;
    if (!(job.counts = wo_new(context, error, counted, sizeof *job.counts)))
        goto done;
    if (!(highlights->first = wo_new(context, error, taken + 1, sizeof *highlights->first)))
        goto done;
    wo_run(context, count_tile, &job, counted);
    size_t i = 0;
    for (int32_t ty = tiles.y1; ty < tiles.y2; ty++) {
        for (int32_t tx = tiles.x1; tx < tiles.x2; tx++, i++) {
            const size_t own = job.counts[(size_t)((ty - job.tiles.y1) * wo_rect_width(job.tiles) +
                                                   tx - job.tiles.x1)];
            highlights->first[i + 1] = highlights->first[i] + (crowded(&job, tx, ty) ? 0 : own);
        }
    }
    highlights->count = highlights->first[taken];
    if (highlights->count > 0) {
        highlights->list = wo_new(context, error, highlights->count, sizeof *highlights->list);
        if (!highlights->list)
            goto done;
        wo_run(context, list_tile, &job, taken);
        if (lens->connect)
            status = wo_highlight_images_make(context, lens, highlights, error);
        if (lens->connect && status != WO_OK)
            goto done;
        wo_run(context, take_tile, &job, taken);
        for (i = 0; i < highlights->count; i++)
            highlights->reach = fmaxf(highlights->reach, highlights->list[i].reach);
    }
    status = WO_OK;
done:
    wo_delete(context, job.counts);
    if (status != WO_OK)
        wo_highlights_destroy(context, highlights);
    return status;
}

void wo_highlights_destroy(const wo_context *context, wo_highlights *highlights)
{
    wo_delete(context, highlights->list);
    wo_delete(context, highlights->first);
    wo_delete(context, highlights->glow);
    wo_delete(context, highlights->images);
    wo_delete(context, highlights->densities);
    wo_delete(context, highlights->lines);
    *highlights = (wo_highlights){0};
}

/* A patch hides a highlight when its blur radius says that it is nearer by so many px: little for
   other sheets, more for the highlight's own, which goes on beside it. */
#define HIDES_PX     0.05f
#define HIDES_OWN_PX 0.5f

/* From which vergence on a sheet can hide a highlight. */
static float hides_from(const wo_highlight *h, int sheet, float px_per_dioptre)
{
    return h->v + (sheet == h->sheet ? HIDES_OWN_PX : HIDES_PX) / px_per_dioptre;
}

/* Which sheets, as bits, have a surface in these pixels that can hide it. */
static unsigned hiders(const wo_stack *stack, unsigned sheets, wo_rect way, const wo_highlight *h,
                       float px_per_dioptre)
{
    unsigned flags = 0;
    unsigned out = 0;
    for (int s = 0; s < stack->sheets; s++)
        if (sheets >> s & 1 &&
            wo_stack_bounds(stack, s, way, &flags).v_max > hides_from(h, s, px_per_dioptre))
            out |= 1u << s;
    return out;
}

/* Light that gets through from a highlight to pixel (x, y) along the line; the rules of march.h,
   one ray at a time. */
static float visible(const wo_stack *stack, unsigned sheets, int32_t x, int32_t y,
                     const double line[4], const wo_highlight *h, float v_near,
                     float px_per_dioptre)
{
    const bool upright = fabs(line[3]) > fabs(line[2]);
    const float am = (float)line[upright ? 1 : 0];
    const float bm = (float)line[upright ? 3 : 2];
    const float slope = bm != 0 ? (float)line[upright ? 2 : 3] / bm : 0;
    const float n0 = (float)line[upright ? 0 : 1] - slope * am;
    const float s_near = am + bm * v_near;
    const float s_end = am + bm * h->v;
    const int dir = s_near >= s_end ? -1 : 1;
    const int last = (int)lrintf(s_end);
    int which[WO_SHEETS_MAX];
    float before[WO_SHEETS_MAX];
    int count = 0;
    for (int s = 0; s < stack->sheets; s++) {
        before[s] = NAN;
        which[count] = s;
        count += (int)(sheets >> s & 1);
    }
    float light = 1;
    for (int i = (int)lrintf(s_near); light > WO_LIGHT_MIN; i += dir) {
        const int j = (int)lrintf(n0 + slope * (float)i);
        const ptrdiff_t at = wo_stack_at(stack, x + (upright ? j : i), y + (upright ? i : j));
        for (int n = 0; n < count; n++) {
            const int s = which[n];
            const float q = stack->v[s][at];
            const float e = (am + bm * q - (float)i) * (float)dir;
            const float e0 = before[s];
            before[s] = e;
            const bool hit =
                fabsf(e) <= 0.5f || (e < -0.5f && e0 > 0.5f && e0 - e <= 1 + WO_CONNECT_PX);
            if (hit && q > hides_from(h, s, px_per_dioptre))
                light *= 1 - stack->c[s][3][at];
        }
        if (i == last)
            return light;
    }
    return 0;
}

/* Of these sheets, those that have a surface that can hide it on the way of the ray, from where it
   may meet the nearest one to the highlight. */
static unsigned between(const wo_stack *stack, unsigned sheets, int32_t x, int32_t y,
                        const double line[4], const wo_highlight *h, float v_near,
                        float px_per_dioptre)
{
    const int32_t near_x = x + (int32_t)lrint(line[0] + line[2] * (double)v_near);
    const int32_t near_y = y + (int32_t)lrint(line[1] + line[3] * (double)v_near);
    const wo_rect way = {near_x < h->x ? near_x : h->x, near_y < h->y ? near_y : h->y,
                         (near_x > h->x ? near_x : h->x) + 1, (near_y > h->y ? near_y : h->y) + 1};
    return hiders(stack, sheets, way, h, px_per_dioptre);
}

float wo_highlight_hidden_from(const wo_highlight *h, const wo_lens *lens)
{
    return h->v + HIDES_PX / (float)lens->px_per_dioptre;
}

/* The vergence, up to v_near, at which a ray that is at the highlight at its vergence is no farther
   from its pixel, along x and along y, than the lens promises of its rays there or at the
   highlight: what was planned holds no more. A ray that is at neither has -INFINITY. */
static float within_reach(const wo_highlight *h, const wo_lens *lens, const double line[4],
                          float v_near)
{
    const double most = fmax(wo_highlight_extent(h->reach),
                             1 + lens->reach(lens->self, (double)v_near, (double)v_near));
    double part = 1;
    for (int k = 0; k < 2; k++) {
        const double from = line[k] + line[2 + k] * (double)h->v;
        const double to = line[k] + line[2 + k] * (double)v_near;
        if (!(fabs(from) <= most + 1))
            return -INFINITY;
        if (!(fabs(to) <= most))
            part = fmin(part, fmax(0, (copysign(most, to) - from) / (to - from)));
    }
    return part < 1 ? h->v + (float)part * (v_near - h->v) : v_near;
}

float wo_highlight_seen(const wo_highlight *h, const wo_stack *stack, const wo_lens *lens,
                        unsigned sheets, int32_t x, int32_t y, const double line[4], float v_near)
{
    const float px_per_dioptre = (float)lens->px_per_dioptre;
    v_near = within_reach(h, lens, line, v_near);
    if (v_near <= h->v || !between(stack, sheets, x, y, line, h, v_near, px_per_dioptre))
        return 1;
    return visible(stack, sheets, x, y, line, h, v_near, px_per_dioptre);
}

/* Which sheets may hide it from these pixels. Its rays to them pass pixels between the highlight
   and the place where they are as near as the nearest surface. */
static unsigned may_hide(const wo_stack *stack, const wo_lens *lens, unsigned sheets,
                         wo_rect pixels, const wo_highlight *h, float v_near)
{
    enum { ROUNDING = 2 };
    if (v_near <= h->v)
        return 0;
    const double reach = lens->reach(lens->self, (double)v_near, (double)v_near);
    const int32_t grow = (int32_t)fmin(reach, WO_MAX_COORDINATE);
    const wo_rect middle = {h->x, h->y, h->x + 1, h->y + 1};
    const wo_rect ends = wo_rect_union(wo_rect_grow(pixels, grow, grow), middle);
    const wo_rect way = wo_rect_intersect(wo_rect_grow(ends, ROUNDING, ROUNDING), stack->area);
    return wo_rect_empty(way) ? 0 : hiders(stack, sheets, way, h, (float)lens->px_per_dioptre);
}

/* Adds one highlight to pixels of a tile; returns the number of rays. */
static int64_t add_to(const wo_highlights *highlights, const wo_highlight *h, const wo_stack *stack,
                      const wo_lens *lens, wo_rect tile, wo_rect pixels, unsigned sheets,
                      float v_near, float sums[WO_TILE_HEIGHT][WO_TILE_WIDTH][3])
{
    int64_t rays = 0;
    const wo_highlight_image *image = &highlights->images[h->image];
    const int32_t r = image->extent;
    for (int32_t y = pixels.y1; y < pixels.y2; y++) {
        const float *row = image->density ? image->density + (y - h->y + r) * (2 * r + 1) : NULL;
        for (int32_t x = pixels.x1; x < pixels.x2; x++) {
            double line[4];
            float light = row ? row[x - h->x + r] : 0;
            if (!row)
                light = (float)wo_highlight_density(lens, h->x - x, h->y - y, h->v, h->reach, line);
            if (!(light > 0))
                continue;
            rays++;
            if (row && sheets)
                wo_highlight_image_line(image, lens, h->x - x, h->y - y, line);
            if (sheets)
                light *= wo_highlight_seen(h, stack, lens, sheets, x, y, line, v_near);
            for (int k = 0; k < 3; k++)
                sums[y - tile.y1][x - tile.x1][k] += light * h->c[k];
        }
    }
    return rays;
}

/* Adds one highlight to a tile: all of it where nothing is in between, else by WO_CELL columns. */
static int64_t add_highlight(const wo_highlights *highlights, const wo_highlight *h,
                             const wo_stack *stack, const wo_lens *lens, wo_rect tile, float v_near,
                             float sums[WO_TILE_HEIGHT][WO_TILE_WIDTH][3])
{
    const int32_t r = highlights->images[h->image].extent;
    const wo_rect disc =
        wo_rect_intersect(tile, (wo_rect){h->x - r, h->y - r, h->x + r + 1, h->y + r + 1});
    if (wo_rect_empty(disc))
        return 0;
    const unsigned sheets = may_hide(stack, lens, ~0u, disc, h, v_near);
    if (!sheets)
        return add_to(highlights, h, stack, lens, tile, disc, 0, v_near, sums);
    int64_t rays = 0;
    for (int32_t x = tile.x1; x < tile.x2; x += WO_CELL) {
        const wo_rect part = wo_rect_intersect(disc, (wo_rect){x, tile.y1, x + WO_CELL, tile.y2});
        if (!wo_rect_empty(part))
            rays += add_to(highlights, h, stack, lens, tile, part,
                           may_hide(stack, lens, sheets, part, h, v_near), v_near, sums);
    }
    return rays;
}

/* A tile of what is drawn already; returns how many of its pixels are lit. */
static int64_t add_drawn(const wo_highlights *highlights, wo_rect tile,
                         float sums[WO_TILE_HEIGHT][WO_TILE_WIDTH][3])
{
    const wo_rect d = highlights->drawn;
    const wo_rect r = wo_rect_intersect(tile, d);
    int64_t lit = 0;
    for (int32_t y = r.y1; y < r.y2; y++) {
        for (int32_t x = r.x1; x < r.x2; x++) {
            const float *c =
                highlights
                    ->glow[(size_t)(y - d.y1) * (size_t)wo_rect_width(d) + (size_t)(x - d.x1)];
            lit += c[0] > 0 || c[1] > 0 || c[2] > 0;
            for (int k = 0; k < 3; k++)
                sums[y - tile.y1][x - tile.x1][k] += c[k];
        }
    }
    return lit;
}

int64_t wo_highlights_add(const wo_highlights *highlights, const wo_stack *stack,
                          const wo_lens *lens, wo_rect tile, float v_near,
                          float sums[WO_TILE_HEIGHT][WO_TILE_WIDTH][3])
{
    int64_t rays = 0;
    if (highlights->count == 0)
        return 0;
    if (highlights->glow)
        return add_drawn(highlights, tile, sums);
    const int32_t reach = wo_highlight_extent(highlights->reach);
    const wo_rect grown = wo_rect_grow(tile, reach, reach);
    const wo_rect tiles = wo_rect_intersect(
        highlights->tiles,
        (wo_rect){wo_floor_div(grown.x1, WO_TILE_WIDTH), wo_floor_div(grown.y1, WO_TILE_HEIGHT),
                  wo_floor_div(grown.x2 - 1, WO_TILE_WIDTH) + 1,
                  wo_floor_div(grown.y2 - 1, WO_TILE_HEIGHT) + 1});
    for (int32_t ty = tiles.y1; ty < tiles.y2; ty++) {
        const size_t row =
            (size_t)(ty - highlights->tiles.y1) * (size_t)wo_rect_width(highlights->tiles);
        const size_t from = highlights->first[row + (size_t)(tiles.x1 - highlights->tiles.x1)];
        const size_t to = highlights->first[row + (size_t)(tiles.x2 - highlights->tiles.x1)];
        for (size_t i = from; i < to; i++)
            rays +=
                add_highlight(highlights, &highlights->list[i], stack, lens, tile, v_near, sums);
    }
    return rays;
}
