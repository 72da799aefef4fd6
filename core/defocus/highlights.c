/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/highlights.h"

#include "defocus/march.h"

#include <math.h>
#include <string.h>

static int32_t floor_div(int32_t x, int32_t d)
{
    return x >= 0 ? x / d : -((d - 1 - x) / d);
}

typedef struct take_job {
    wo_sheet *sheets;
    size_t sheet_count;
    const wo_lens *lens;
    wo_highlights *out;
    wo_rect tiles; /* of counts: one more on all sides than out->tiles */
    size_t *counts;
} take_job;

/* Vergences of highlights are rounded to steps of 1/QUANTUM px of blur, so that few shares are
   worked out; CACHE of them are kept. Images that are drawn are rounded to twice as much for each
   QUANTUM_EVEN px. */
#define QUANTUM      32.0
#define QUANTUM_EVEN 16.0
enum { CACHE = 64 };

typedef struct share_cache {
    float v[CACHE];
    double share[CACHE];
    int count;
} share_cache;

/* The pixel of a highlight is already as soft as the picture, so large discs need no soft edge. But
   discs up to SOFT px of reach have edges cut by the area of each pixel, so that they grow
   smoothly; from there to twice that it matters less and less, and then the middle of the pixel
   counts. The area is looked at in places of a lattice: no two are in one row or column, which a
   rim could reach at once. */
#define SOFT 2.0
enum { PLACES = 144, STRIDE = 89 };

/* Density of rays over the pixel at the offset (dx, dy), and one of them. */
static double density_at(const wo_lens *lens, int32_t dx, int32_t dy, float v, float reach,
                         double line[4])
{
    const double soft = fmin(fmax(2 - (double)reach / SOFT, 0), 1);
    double sum = 0;
    double middle[4];
    const double density = lens->connect(lens->self, dx, dy, v, middle);
    /* Corners and middle alike: the edge is elsewhere. */
    double corners[4] = {0};
    for (int i = 0; i < 4 && soft > 0; i++)
        corners[i] = lens->connect(lens->self, dx + (i & 1) - 0.5, dy + i / 2 - 0.5, v, line);
    const bool even = corners[0] == corners[1] && corners[0] == corners[2] &&
                      corners[0] == corners[3] && corners[0] == density &&
                      (corners[0] > 0 || dx * dx + dy * dy > 2);
    for (int i = 0; i < PLACES && soft > 0 && !even; i++) {
        const double x = dx + (i + 0.5) / PLACES - 0.5;
        const double y = dy + (STRIDE * i % PLACES + 0.5) / PLACES - 0.5;
        double inside[4];
        const double d = lens->connect(lens->self, x, y, v, inside);
        if (d > 0)
            memcpy(line, inside, sizeof inside);
        sum += d;
    }
    sum = soft * (even ? corners[0] : sum / PLACES);
    /* The ray through the middle, if it is there. */
    if (density > 0)
        memcpy(line, middle, sizeof middle);
    return sum + (1 - soft) * density;
}

/* px from the middle of a highlight that its light may reach. */
static int32_t extent_of(float reach)
{
    return (int32_t)ceilf(reach + 0.5f);
}

/* Share of the light that reaches one pixel for a unit of connect density, so that the sum over all
   pixels is 1. Large pictures of the aperture are counted on every step-th pixel of each row, each
   row from another start. */
static double share(const wo_lens *lens, float v, float reach)
{
    enum { COUNTED = 128 };
    const double golden = 0.6180339887498949;
    const int32_t r = extent_of(reach);
    const int32_t step = r / COUNTED > 1 ? r / COUNTED : 1;
    double sum = 0;
    double line[4];
    for (int32_t dy = -r; dy <= r; dy++) {
        double whole;
        const int32_t start = (int32_t)(step * modf((dy + r) * golden, &whole));
        for (int32_t dx = start - r; dx <= r; dx += step)
            sum += density_at(lens, dx, dy, v, reach, line);
    }
    return sum > 0 ? 1 / (sum * step) : 0;
}

static double cached_share(share_cache *cache, const wo_lens *lens, float v, float reach)
{
    for (int i = 0; i < cache->count && i < CACHE; i++)
        if (cache->v[i] == v)
            return cache->share[i];
    const int at = cache->count++ % CACHE;
    cache->v[at] = v;
    return cache->share[at] = share(lens, v, reach);
}

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
    return (wo_rect){tx * WO_TILE_WIDTH, ty * WO_TILE_HEIGHT, (tx + 1) * WO_TILE_WIDTH,
                     (ty + 1) * WO_TILE_HEIGHT};
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

static void take_tile(void *user, size_t index, unsigned worker)
{
    (void)worker;
    take_job *job = user;
    wo_highlight *to = job->out->list + job->out->first[index];
    if (job->out->first[index + 1] == job->out->first[index])
        return;
    share_cache cache = {.count = 0};
    int packed = 0; /* place of the sheet in the stack, which has no empty ones */
    for (size_t s = 0; s < job->sheet_count; s++) {
        wo_sheet *sheet = &job->sheets[s];
        const wo_rect r = wo_rect_intersect(tile_of(job->out->tiles, index), sheet->area);
        const int32_t w = wo_rect_width(sheet->area);
        for (int32_t y = r.y1; sheet->any && y < r.y2; y++) {
            for (int32_t x = r.x1; x < r.x2; x++) {
                const size_t at = (size_t)((y - sheet->area.y1) * w + x - sheet->area.x1);
                spot found;
                if (!is_bright(sheet->c[at]) || !is_highlight(job, sheet, at, &found))
                    continue;
                const double part =
                    job->lens->connect ? cached_share(&cache, job->lens, found.v, found.reach) : 1;
                /* Slits that no pixel looks through: the light stays with the surface. */
                const float above = part > 0 ? found.taken : 0;
                *to = (wo_highlight){x, y, found.v, found.reach, packed, {0}};
                for (int k = 0; k < 3; k++) {
                    to->c[k] = (float)(part * above) * sheet->c[at][k];
                    sheet->c[at][k] -= above * sheet->c[at][k];
                }
                to++;
            }
        }
        packed += sheet->any;
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
    const wo_rect tiles = {floor_div(area.x1, WO_TILE_WIDTH), floor_div(area.y1, WO_TILE_HEIGHT),
                           floor_div(area.x2 - 1, WO_TILE_WIDTH) + 1,
                           floor_div(area.y2 - 1, WO_TILE_HEIGHT) + 1};
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

/* Light that gets through from a highlight to pixel (x, y) along the line; the rules of march.h,
   one ray at a time. */
static float visible(const wo_stack *stack, int32_t x, int32_t y, const double line[4],
                     const wo_highlight *h, float v_near, float px_per_dioptre)
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
    float before[WO_SHEETS_MAX];
    for (int s = 0; s < stack->sheets; s++)
        before[s] = NAN;
    float light = 1;
    for (int i = (int)lrintf(s_near); light > WO_LIGHT_MIN; i += dir) {
        const int j = (int)lrintf(n0 + slope * (float)i);
        const ptrdiff_t at = wo_stack_at(stack, x + (upright ? j : i), y + (upright ? i : j));
        for (int s = 0; s < stack->sheets; s++) {
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

/* True when no surface on the way of the ray, from where it may meet the nearest one to the
   highlight, can hide it. */
static bool nothing_between(const wo_stack *stack, int32_t x, int32_t y, const double line[4],
                            const wo_highlight *h, float v_near, float px_per_dioptre)
{
    const int32_t near_x = x + (int32_t)lrint(line[0] + line[2] * (double)v_near);
    const int32_t near_y = y + (int32_t)lrint(line[1] + line[3] * (double)v_near);
    const wo_rect way = {near_x < h->x ? near_x : h->x, near_y < h->y ? near_y : h->y,
                         (near_x > h->x ? near_x : h->x) + 1, (near_y > h->y ? near_y : h->y) + 1};
    unsigned flags = 0;
    for (int s = 0; s < stack->sheets; s++)
        if (wo_stack_bounds(stack, s, way, &flags).v_max > hides_from(h, s, px_per_dioptre))
            return false;
    return true;
}

float wo_highlight_hidden_from(const wo_highlight *h, const wo_lens *lens)
{
    return h->v + HIDES_PX / (float)lens->px_per_dioptre;
}

float wo_highlight_seen(const wo_highlight *h, const wo_stack *stack, const wo_lens *lens,
                        int32_t x, int32_t y, const double line[4], float v_near)
{
    const float px_per_dioptre = (float)lens->px_per_dioptre;
    if (v_near <= h->v || nothing_between(stack, x, y, line, h, v_near, px_per_dioptre))
        return 1;
    return visible(stack, x, y, line, h, v_near, px_per_dioptre);
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
    const int32_t reach = extent_of(highlights->reach);
    const wo_rect grown = wo_rect_grow(tile, reach, reach);
    const wo_rect tiles = wo_rect_intersect(highlights->tiles,
                                            (wo_rect){floor_div(grown.x1, WO_TILE_WIDTH),
                                                      floor_div(grown.y1, WO_TILE_HEIGHT),
                                                      floor_div(grown.x2 - 1, WO_TILE_WIDTH) + 1,
                                                      floor_div(grown.y2 - 1, WO_TILE_HEIGHT) + 1});
    for (int32_t ty = tiles.y1; ty < tiles.y2; ty++) {
        const size_t row =
            (size_t)(ty - highlights->tiles.y1) * (size_t)wo_rect_width(highlights->tiles);
        const size_t from = highlights->first[row + (size_t)(tiles.x1 - highlights->tiles.x1)];
        const size_t to = highlights->first[row + (size_t)(tiles.x2 - highlights->tiles.x1)];
        for (size_t i = from; i < to; i++) {
            const wo_highlight *h = &highlights->list[i];
            const int32_t r = extent_of(h->reach);
            const wo_rect disc =
                wo_rect_intersect(tile, (wo_rect){h->x - r, h->y - r, h->x + r + 1, h->y + r + 1});
            for (int32_t y = disc.y1; y < disc.y2; y++) {
                for (int32_t x = disc.x1; x < disc.x2; x++) {
                    double line[4];
                    const double density =
                        density_at(lens, h->x - x, h->y - y, h->v, h->reach, line);
                    if (!(density > 0))
                        continue;
                    rays++;
                    const float light =
                        (float)density * wo_highlight_seen(h, stack, lens, x, y, line, v_near);
                    float *sum = sums[y - tile.y1][x - tile.x1];
                    for (int k = 0; k < 3; k++)
                        sum[k] += light * h->c[k];
                }
            }
        }
    }
    return rays;
}
