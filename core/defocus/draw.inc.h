/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* The kernels of draw.h over the vectors of simd_*.h; compiled once for each instruction set by the
   file that includes it after them and defines WO_DRAW_KERNELS. */

#include "defocus/draw.h"

#include <math.h>
#include <string.h>

/* The displacement A + B v: s(v) = am + bm v along its longer axis, n = n0 + slope s across. */
typedef struct line {
    float am, bm, n0, slope;
    int upright;   /* the longer axis is y */
    int dir;       /* of a ray's steps from near to far */
    float connect; /* dioptres: neighbours closer than this are one surface for the ray */
} line;

WO_SIMD line line_of(const wo_view_ray *ray)
{
    line l;
    l.upright = fabsf(ray->by) > fabsf(ray->bx);
    l.am = l.upright ? ray->ay : ray->ax;
    l.bm = l.upright ? ray->by : ray->bx;
    const float an = l.upright ? ray->ax : ray->ay;
    const float bn = l.upright ? ray->bx : ray->by;
    l.slope = l.bm != 0 ? bn / l.bm : 0;
    l.n0 = an - l.slope * l.am;
    l.dir = l.bm >= 0 ? -1 : 1;
    l.connect = WO_CONNECT_PX / fmaxf(fabsf(l.bm), 1e-30f);
    return l;
}

WO_SIMD int nearest(float x)
{
    return (int)lrintf(x);
}

WO_SIMD int across_at(const line *l, int i)
{
    return nearest(l->n0 + l->slope * (float)i);
}

WO_SIMD void raster_of(const line *l, int i, int *dx, int *dy)
{
    const int j = across_at(l, i);
    *dx = l->upright ? j : i;
    *dy = l->upright ? i : j;
}

/* Where a surface that is crossed at step i counts as met: first in the step. */
WO_SIMD float crossed_at(const line *l, int i)
{
    return ((float)i - 0.5f * (float)l->dir - l->am) / l->bm;
}

/* Dodgson's quadratic interpolation (1997), tx, ty px beside the middle of nine. */
WO_SIMD void stencil_of(vf tx, vf ty, vf w[9])
{
    const vf half = v_set(0.5f);
    const vf one = v_set(1);
    const vf xx = v_mul(tx, tx);
    const vf yy = v_mul(ty, ty);
    const vf wx[3] = {v_sub(xx, v_mul(half, tx)), v_sub(one, v_add(xx, xx)), v_fma(half, tx, xx)};
    const vf wy[3] = {v_sub(yy, v_mul(half, ty)), v_sub(one, v_add(yy, yy)), v_fma(half, ty, yy)};
    for (int n = 0; n < 9; n++)
        w[n] = v_mul(wx[n % 3], wy[n / 3]);
}

static void add_stencil(float tx, float ty, float w[9])
{
    const float wx[3] = {tx * tx - 0.5f * tx, 1 - 2 * tx * tx, tx * tx + 0.5f * tx};
    const float wy[3] = {ty * ty - 0.5f * ty, 1 - 2 * ty * ty, ty * ty + 0.5f * ty};
    for (int n = 0; n < 9; n++)
        w[n] += wx[n % 3] * wy[n / 3];
}

/* Mean stencil of rays at vergence v whose raster is (dx, dy) there. */
static void mean_stencil(const wo_view_ray *rays, int count, float v, int dx, int dy, float w[9])
{
    for (int n = 0; n < 9; n++)
        w[n] = 0;
    for (int m = 0; m < count; m++)
        add_stencil(rays[m].ax + rays[m].bx * v - (float)dx,
                    rays[m].ay + rays[m].by * v - (float)dy, w);
    for (int n = 0; n < 9; n++)
        w[n] /= (float)count;
}

/* px that a surface may be drawn beside its exact place: rounding on both axes, and crossings. */
#define REACH 3.5f

static float least(float a, float b)
{
    return a < b ? a : b;
}

static float most(float a, float b)
{
    return a > b ? a : b;
}

/* Rounds to whole numbers: below 2^22 this is what the addition leaves. */
WO_SIMD vf rounded(vf x)
{
    const vf big = v_set(0x1.8p23f);
    return v_sub(v_add(x, big), big);
}

/* Everything a view is drawn with. */
typedef struct drawing {
    const wo_draw *d;
    const wo_view_ray *rays;
    int count;
    line l;
    wo_view *view;
    int64_t writes;
} drawing;

/* Colours of sixteen solid pixels, mixed with those neighbours of their surface that are covered as
   they are. */
WO_SIMD void shade(const wo_piece *piece, int at, float connect, const vf w[9], vf c[3])
{
    const float *const plane = piece->plane;
    const float *const v = plane + WO_PIECE_V * WO_PIECE_PLANE;
    const float *const alpha = plane + WO_PIECE_ALPHA * WO_PIECE_PLANE;
    const float *const red = plane + WO_PIECE_RED * WO_PIECE_PLANE;
    const vf here = v_load(v + at);
    const bool joined = piece->full && piece->high - piece->low <= connect;
    vf own = w[4];
    for (int k = 0; k < 3; k++)
        c[k] = v_set(0);
    for (int n = 0; n < 9; n++) {
        if (n == 4)
            continue;
        const int beside = at + (n / 3 - 1) * WO_PIECE_ROW + n % 3 - 1;
        vf part = w[n];
        if (!joined) {
            const vf away = v_abs(v_sub(v_load(v + beside), here));
            const vm full = v_less_equal(v_set(1), v_load(alpha + beside));
            part = v_mask(m_and(v_less_equal(away, v_set(connect)), full), part);
            own = v_add(own, v_sub(w[n], part));
        }
        for (int k = 0; k < 3; k++)
            c[k] = v_fma(part, v_load(red + k * WO_PIECE_PLANE + beside), c[k]);
    }
    for (int k = 0; k < 3; k++)
        c[k] = v_fma(own, v_load(red + k * WO_PIECE_PLANE + at), c[k]);
}

WO_SIMD void plain(const wo_piece *piece, int at, vf c[3])
{
    for (int k = 0; k < 3; k++)
        c[k] = v_load(piece->plane + (WO_PIECE_RED + k) * WO_PIECE_PLANE + at);
}

/* Where the vector at v is nearer than what the view holds. */
WO_SIMD vm nearer(const wo_view *view, int place, vf v)
{
    return v_less(v_load(view->plane[WO_VIEW_V] + place), v);
}

WO_SIMD void put(wo_view *view, int place, vm mask, vf v, const vf c[3], vf guessed)
{
    float *const at = view->plane[0] + place;
    v_store(at, v_select(mask, v, v_load(at)));
    for (int k = 0; k < 3; k++) {
        float *const to = at + (WO_VIEW_RED + k) * WO_VIEW_PLANE;
        v_store(to, v_select(mask, c[k], v_load(to)));
    }
    float *const alpha = at + WO_VIEW_ALPHA * WO_VIEW_PLANE;
    v_store(alpha, v_select(mask, v_set(1), v_load(alpha)));
    float *const guess = at + WO_VIEW_GUESSED * WO_VIEW_PLANE;
    v_store(guess, v_select(mask, guessed, v_load(guess)));
}

/* Stencil of one ray at step i, t px farther along the longer axis. */
WO_SIMD void stencil_beside(const line *l, int i, vf t, vf w[9])
{
    const float beside = l->n0 + l->slope * (float)i - (float)across_at(l, i);
    const vf across = v_fma(v_set(l->slope), t, v_set(beside));
    stencil_of(l->upright ? across : t, l->upright ? t : across, w);
}

/* Rows first..last - 1 of a piece, moved as a whole. x, y: the piece's first pixel in the view, not
   yet moved. */
static void draw_moved(drawing *g, const wo_piece *piece, int first, int last, int32_t x, int32_t y,
                       int i, float guess)
{
    wo_view *const view = g->view;
    int dx;
    int dy;
    raster_of(&g->l, i, &dx, &dy);
    const int32_t left = x - dx;
    const int32_t low = y - dy;
    if (left <= -WO_PIECE_WIDTH || left >= view->width)
        return;
    first = low + first < 0 ? -low : first;
    last = low + last > view->height ? view->height - low : last;
    const bool near = i <= WO_SMOOTH_PX && i >= -WO_SMOOTH_PX;
    const float *const solid = piece->plane + WO_PIECE_SOLID * WO_PIECE_PLANE;
    float mean[9];
    const bool moves = near && g->count == 1;
    const vf am = v_set(g->l.am - (float)i);
    const vf bm = v_set(g->l.bm);
    vf w[9];
    if (near && !moves) {
        mean_stencil(g->rays, g->count, 0.5f * (g->d->v_low + g->d->v_high), dx, dy, mean);
        for (int n = 0; n < 9; n++)
            w[n] = v_set(mean[n]);
    }
    for (int row = first; row < last; row++) {
        const int at = wo_piece_at(0, row);
        const int place = (low + row) * WO_VIEW_ROW + WO_LANES + left;
        const vf v = v_load(solid + at);
        const vm mask = nearer(view, place, v);
        if (!m_any(mask))
            continue;
        vf c[3];
        if (moves)
            stencil_beside(&g->l, i, v_fma(bm, v, am), w);
        if (near)
            shade(piece, at, g->l.connect, w, c);
        else
            plain(piece, at, c);
        put(view, place, mask, v, c, v_set(guess));
        g->writes += WO_LANES;
    }
}

/* One row of a piece at one step: the pixels that a ray would hit or cross there. */
static void draw_step(drawing *g, const wo_piece *piece, int row, int32_t x, int32_t y, int i,
                      float guess)
{
    wo_view *const view = g->view;
    const line *const l = &g->l;
    int dx;
    int dy;
    raster_of(l, i, &dx, &dy);
    const int32_t left = x - dx;
    const int32_t low = y + row - dy;
    if (left <= -WO_PIECE_WIDTH || left >= view->width || low < 0 || low >= view->height)
        return;
    const int at = wo_piece_at(0, row);
    const int place = low * WO_VIEW_ROW + WO_LANES + left;
    const vf v = v_load(piece->plane + WO_PIECE_SOLID * WO_PIECE_PLANE + at);
    vm mask = nearer(view, place, v);
    if (!m_any(mask))
        return;
    const int back = across_at(l, i) - across_at(l, i - l->dir);
    const int before = l->upright ? l->dir * WO_PIECE_ROW + back : l->dir + back * WO_PIECE_ROW;
    const float *const all = piece->plane + WO_PIECE_V * WO_PIECE_PLANE;
    const vf dir = v_set((float)l->dir);
    const vf am = v_set(l->am - (float)i);
    const vf bm = v_set(l->bm);
    const vf e = v_mul(dir, v_fma(bm, v, am));
    const vf v0 = v_load(all + at - before);
    const vf e0 = v_fma(dir, v_fma(bm, v0, am), v_set(1));
    const vm crossed = m_and(m_and(v_less(e, v_set(-0.5f)), v_less(v_set(0.5f), e0)),
                             v_less_equal(v_sub(e0, e), v_set(1 + WO_CONNECT_PX)));
    mask = m_and(mask, m_or(v_less_equal(v_abs(e), v_set(0.5f)), crossed));
    if (!m_any(mask))
        return;
    const vf cross_t = v_sub(v_div(e0, v_sub(e0, e)), v_set(1));
    const vf met = v_select(crossed, v_set(crossed_at(l, i)), v);
    mask = m_and(mask, nearer(view, place, met));
    if (!m_any(mask))
        return;
    vf c[3];
    if (i <= WO_SMOOTH_PX && i >= -WO_SMOOTH_PX) {
        vf w[9];
        stencil_beside(l, i, v_mask(mask, v_mul(dir, v_select(crossed, cross_t, e))), w);
        shade(piece, at, g->l.connect, w, c);
    } else {
        plain(piece, at, c);
    }
    put(view, place, mask, met, c, v_set(guess));
    g->writes += WO_LANES;
}

/* A row whose pixels move by very different amounts: each step that one of them is hit at, and the
   two after it, where it may be crossed, up to dir * end. */
static void draw_torn(drawing *g, const wo_piece *piece, int row, int32_t x, int32_t y, int end,
                      float guess)
{
    enum { STEPS = 3 * WO_LANES };
    const line *const l = &g->l;
    const float *const solid = piece->plane + WO_PIECE_SOLID * WO_PIECE_PLANE + wo_piece_at(0, row);
    float hits[WO_LANES];
    v_store(hits, rounded(v_fma(v_set(l->bm), v_load(solid), v_set(l->am))));
    int done[STEPS];
    int count = 0;
    for (int lane = 0; lane < WO_PIECE_WIDTH; lane++) {
        if (isnan(hits[lane]) || (lane > 0 && hits[lane] == hits[lane - 1]))
            continue;
        for (int more = 0; more < 3; more++) {
            const int i = (int)hits[lane] + more * l->dir;
            if (l->dir * i > end)
                break;
            bool again = false;
            for (int n = count - 1; n >= 0 && !again; n--)
                again = done[n] == i;
            if (again)
                continue;
            done[count++] = i;
            draw_step(g, piece, row, x, y, i, guess);
        }
    }
}

/* Rows whose pixels move by different amounts. */
static void draw_rows(drawing *g, const wo_piece *piece, int32_t x, int32_t y, float guess)
{
    enum { FEW = 4 };
    const line *const l = &g->l;
    const wo_view_ray *const ray = g->rays;
    for (int row = 0; row < WO_PIECE_HEIGHT; row++) {
        const wo_piece_row *const r = &piece->row[row];
        if (r->v_min > r->v_max)
            continue;
        const float y1 = (float)(y + row) - (ray->ay + ray->by * r->v_min);
        const float y2 = (float)(y + row) - (ray->ay + ray->by * r->v_max);
        if (most(y1, y2) < -REACH || least(y1, y2) > (float)g->view->height + REACH - 1)
            continue;
        const int from = nearest(l->am + l->bm * r->low);
        if (from == nearest(l->am + l->bm * r->high)) {
            draw_moved(g, piece, row, row + 1, x, y, from, guess);
            continue;
        }
        const int near = nearest(l->am + l->bm * r->v_max);
        const int far = nearest(l->am + l->bm * r->v_min);
        /* The farthest neighbour, that a ray comes past: no pixel is crossed beyond it. */
        const int end = l->dir * nearest(l->am + l->bm * r->low);
        if ((far - near) * l->dir > FEW) {
            draw_torn(g, piece, row, x, y, end, guess);
            continue;
        }
        for (int i = l->dir * near; i <= l->dir * far + 2 && i <= end; i++)
            draw_step(g, piece, row, x, y, l->dir * i, guess);
    }
}

static void draw_piece(drawing *g, const wo_piece *piece, int32_t x, int32_t y, float guess)
{
    const line *const l = &g->l;
    const int i = nearest(l->am + l->bm * piece->low);
    if (g->count > 1 || i == nearest(l->am + l->bm * piece->high))
        draw_moved(g, piece, 0, WO_PIECE_HEIGHT, x, y, i, guess);
    else
        draw_rows(g, piece, x, y, guess);
}

static int32_t floor_div(float x, int32_t d)
{
    return (int32_t)floorf(x / (float)d);
}

/* Pieces of a sheet that may be seen: in each row of pieces, those vergences that bring it into the
   view, and the columns that they come from. */
static void draw_sheet(drawing *g, int s)
{
    const wo_draw *const d = g->d;
    const wo_pieces *const p = d->pieces;
    const wo_view_ray *const ray = g->rays;
    const wo_bounds b = d->bounds[s];
    const float guess = p->guessed[s] ? 1.0f : 0.0f;
    const int32_t x0 = d->x1 - p->x1;
    const int32_t y0 = d->y1 - p->y1;
    const float right = (float)(g->view->width - 1);
    const float top = (float)(g->view->height - 1);
    const float dy1 = ray->ay + ray->by * b.v_min;
    const float dy2 = ray->ay + ray->by * b.v_max;
    int32_t row = floor_div((float)y0 + least(dy1, dy2) - REACH, WO_PIECE_HEIGHT);
    int32_t last_row = floor_div((float)y0 + top + most(dy1, dy2) + REACH, WO_PIECE_HEIGHT);
    row = row < 0 ? 0 : row;
    last_row = last_row >= p->rows ? p->rows - 1 : last_row;
    for (; row <= last_row; row++) {
        const int32_t y = row * WO_PIECE_HEIGHT - y0;
        wo_bounds seen = b;
        if (fabsf(ray->by) > 1e-6f) {
            const float v1 = ((float)y - top - REACH - ray->ay) / ray->by;
            const float v2 = ((float)(y + WO_PIECE_HEIGHT - 1) + REACH - ray->ay) / ray->by;
            seen.v_min = most(seen.v_min, least(v1, v2));
            seen.v_max = least(seen.v_max, most(v1, v2));
            if (seen.v_min > seen.v_max)
                continue;
        }
        const float dx1 = ray->ax + ray->bx * seen.v_min;
        const float dx2 = ray->ax + ray->bx * seen.v_max;
        int32_t i = floor_div((float)x0 + least(dx1, dx2) - REACH, WO_PIECE_WIDTH);
        int32_t last = floor_div((float)x0 + right + most(dx1, dx2) + REACH, WO_PIECE_WIDTH);
        i = i < 0 ? 0 : i;
        last = last >= p->columns ? p->columns - 1 : last;
        for (; i <= last; i++) {
            const wo_piece *piece = &p->piece[s][row * p->columns + i];
            if (piece->v_min <= seen.v_max && piece->v_max >= seen.v_min)
                draw_piece(g, piece, i * WO_PIECE_WIDTH - x0, y, guess);
        }
    }
}

/* Light that nothing is drawn for. */
#define LIGHT_NONE 1e-5f

/* A thin pixel that is met, with the light that those before it let through. */
static void draw_thin(drawing *g, const wo_thin_hit *hit)
{
    const line *const l = &g->l;
    const wo_thin_at *const thin = &g->d->thin.at[hit->n];
    wo_thin_sum *const sum = &g->view->thin[hit->y][hit->x];
    if (sum->light <= LIGHT_NONE)
        return;
    float c[4];
    memcpy(c, thin->c, sizeof c);
    if (thin->around && hit->step <= WO_SMOOTH_PX && hit->step >= -WO_SMOOTH_PX) {
        float w[9] = {0};
        if (g->count > 1) {
            int dx;
            int dy;
            raster_of(l, hit->step, &dx, &dy);
            mean_stencil(g->rays, g->count, 0.5f * (g->d->v_low + g->d->v_high), dx, dy, w);
        } else {
            const float i = (float)hit->step;
            const float across =
                l->n0 + l->slope * i - (float)across_at(l, hit->step) + l->slope * hit->t;
            add_stencil(l->upright ? across : hit->t, l->upright ? hit->t : across, w);
        }
        float own = 1;
        for (int n = 0; n < 9; n++)
            own -= w[n] = thin->around->away[n] <= l->connect ? w[n] : 0;
        for (int k = 0; k < 4; k++)
            c[k] *= own;
        for (int n = 0; n < 9; n++)
            for (int k = 0; k < 4; k++)
                c[k] += w[n] * thin->around->c[n][k];
        /* Where interpolation leaves 0..1, colours are cut as coverage is. */
        if (c[3] < 0)
            return;
        for (int k = 0; k < 4; k++)
            c[k] /= most(c[3], 1);
    }
    for (int k = 0; k < 4; k++)
        sum->c[k] += sum->light * c[k];
    if (thin->guessed)
        sum->guessed += sum->light * c[3];
    sum->light -= sum->light * c[3];
    g->writes++;
}

/* What is solid shows through the light that is left. */
static void put_thins(wo_view *view)
{
    for (int y = 0; y < view->height; y++) {
        for (int x = 0; x < view->width; x++) {
            const wo_thin_sum *const sum = &view->thin[y][x];
            float *const to = view->plane[0] + y * WO_VIEW_ROW + WO_LANES + x;
            if (sum->light >= 1 && sum->c[0] == 0 && sum->c[1] == 0 && sum->c[2] == 0)
                continue;
            for (int k = 0; k < 3; k++) {
                float *const c = to + (WO_VIEW_RED + k) * WO_VIEW_PLANE;
                *c = sum->c[k] + sum->light * *c;
            }
            float *const alpha = to + WO_VIEW_ALPHA * WO_VIEW_PLANE;
            *alpha = *alpha >= 1 ? 1 : least(sum->c[3] + sum->light * *alpha, 1);
            float *const guessed = to + WO_VIEW_GUESSED * WO_VIEW_PLANE;
            *guessed = sum->guessed + sum->light * *guessed;
        }
    }
}

/* Is there room for light at vergence v of pixel (x, y) of a view? */
WO_SIMD bool is_open(const wo_view *view, float v, int x, int y)
{
    return x >= 0 && x < view->width && y >= 0 && y < view->height &&
           v > view->plane[WO_VIEW_V][y * WO_VIEW_ROW + WO_LANES + x];
}

/* Where thin pixel n is crossed, if anywhere; at most two steps. hit: the step that it is hit at.
 */
static int note_crossed(const drawing *g, int n, float v, int hit, wo_thin_hit *out)
{
    const line *const l = &g->l;
    const wo_thin *const list = &g->d->thin;
    const wo_thin_at *const thin = &list->at[n];
    const float *const all = thin->piece->plane + WO_PIECE_V * WO_PIECE_PLANE + thin->at;
    int count = 0;
    for (int more = 1; more < 3; more++) {
        const int i = hit + more * l->dir;
        const int back = across_at(l, i) - across_at(l, i - l->dir);
        const int from = l->upright ? l->dir * WO_PIECE_ROW + back : l->dir + back * WO_PIECE_ROW;
        const float e = (float)l->dir * (l->am + l->bm * v - (float)i);
        const float e0 = (float)l->dir * (l->am + l->bm * all[-from] - (float)i) + 1;
        if (!(e < -0.5f && e0 > 0.5f && e0 - e <= 1 + WO_CONNECT_PX))
            continue;
        int dx;
        int dy;
        raster_of(l, i, &dx, &dy);
        const int x = (int)list->x[n] - dx;
        const int y = (int)list->y[n] - dy;
        const float met = crossed_at(l, i);
        const float t = (float)l->dir * (e0 / (e0 - e) - 1);
        if (is_open(g->view, met, x, y))
            out[count++] = (wo_thin_hit){met, t, n, i, (int16_t)x, (int16_t)y};
    }
    return count;
}

/* Is a met before b? Equals keep their order. */
WO_SIMD bool before(const wo_thin_hit *a, const wo_thin_hit *b)
{
    return a->v > b->v || (a->v == b->v && a->n < b->n);
}

static void sort_hits(wo_thin_hit *hit, int count)
{
    int gap = 1;
    while (gap < count / 3)
        gap = 3 * gap + 1;
    for (; gap > 0; gap /= 3) {
        for (int i = gap; i < count; i++) {
            const wo_thin_hit one = hit[i];
            int k = i;
            for (; k >= gap && before(&one, &hit[k - gap]); k -= gap)
                hit[k] = hit[k - gap];
            hit[k] = one;
        }
    }
}

/* Finds what is met, hits in the order of the list and crossings apart, and draws both in their
   order. */
static void draw_thins(drawing *g)
{
    const line *const l = &g->l;
    const wo_thin *const list = &g->d->thin;
    if (list->count == 0)
        return;
    for (int y = 0; y < g->view->height; y++)
        for (int x = 0; x < g->view->width; x++)
            g->view->thin[y][x] = (wo_thin_sum){{0}, 1, 0};
    const vf right = v_set((float)g->view->width + 2.5f);
    const vf top = v_set((float)g->view->height + 2.5f);
    wo_thin_hit *const hits = list->hits;
    wo_thin_hit *const crossings = hits + list->count;
    int hit_count = 0;
    int crossing_count = 0;
    for (int first = 0; first < list->count; first += WO_LANES) {
        const vf s = v_fma(v_set(l->bm), v_load(list->v + first), v_set(l->am));
        const vf i = rounded(s);
        const vf j = rounded(v_fma(v_set(l->slope), i, v_set(l->n0)));
        const vf x = v_sub(v_load(list->x + first), l->upright ? j : i);
        const vf y = v_sub(v_load(list->y + first), l->upright ? i : j);
        const vm seen = m_and(m_and(v_less(v_set(-3.5f), x), v_less(x, right)),
                              m_and(v_less(v_set(-3.5f), y), v_less(y, top)));
        if (!m_any(seen))
            continue;
        float to[5][WO_LANES];
        v_store(to[0], v_mask(seen, v_set(1)));
        v_store(to[1], i);
        v_store(to[2], v_sub(s, i));
        v_store(to[3], x);
        v_store(to[4], y);
        for (int lane = 0; lane < WO_LANES; lane++) {
            if (to[0][lane] == 0)
                continue;
            const int n = first + lane;
            const float v = list->v[n];
            const float t = to[2][lane];
            const int step = (int)to[1][lane];
            const int px = (int)to[3][lane];
            const int py = (int)to[4][lane];
            if (is_open(g->view, v, px, py))
                hits[hit_count++] = (wo_thin_hit){v, t, n, step, (int16_t)px, (int16_t)py};
            /* A ray comes past the farthest neighbour at least half a step after this. */
            if (g->count == 1 && (float)l->dir * t + fabsf(l->bm) * list->at[n].drop > 0.49f)
                crossing_count += note_crossed(g, n, v, step, crossings + crossing_count);
        }
    }
    sort_hits(crossings, crossing_count);
    for (int a = 0, b = 0; a < hit_count || b < crossing_count;) {
        const bool own = b == crossing_count || (a < hit_count && hits[a].v >= crossings[b].v);
        draw_thin(g, own ? &hits[a++] : &crossings[b++]);
    }
    put_thins(g->view);
}

static int64_t draw(const wo_draw *d, const wo_view_ray *rays, int count, wo_view *view)
{
    drawing g = {.d = d, .rays = rays, .count = count, .l = line_of(rays), .view = view};
    for (int place = 0; place < view->height * WO_VIEW_ROW; place += WO_LANES)
        v_store(view->plane[WO_VIEW_V] + place, v_set(-INFINITY));
    for (int k = WO_VIEW_RED; k < WO_VIEW_PLANES; k++)
        memset(view->plane[k], 0, (size_t)view->height * WO_VIEW_ROW * sizeof(float));
    for (int s = 0; s < d->pieces->sheets; s++)
        if (d->bounds[s].v_min <= d->bounds[s].v_max)
            draw_sheet(&g, s);
    draw_thins(&g);
    return g.writes;
}

WO_SIMD void add_to(float *to, vf x)
{
    v_store(to, v_add(v_load(to), x));
}

static void add(const wo_view *view, const uint8_t *lost, float count, const float *weight,
                wo_view_sums *sums)
{
    const vf rest = v_set(weight ? (weight[0] + weight[1] + weight[2]) * (1.0f / 3) : count);
    const vf one = v_set(1);
    for (int y = 0; y < view->height; y++) {
        for (int x = 0; x < view->width; x += WO_LANES) {
            const int from = y * WO_VIEW_ROW + WO_LANES + x;
            float *const to = sums->plane[0] + y * WO_VIEW_WIDTH + x;
            vf alpha = v_load(view->plane[WO_VIEW_ALPHA] + from);
            alpha = v_select(v_less(one, alpha), one, alpha);
            vf guessed = v_load(view->plane[WO_VIEW_GUESSED] + from);
            vf seen = one;
            if (m_any(v_less(alpha, one))) {
                float part[WO_LANES];
                float guess[WO_LANES];
                v_store(part, alpha);
                v_store(guess, guessed);
                for (int n = 0; n < WO_LANES; n++) {
                    /* Where light ends, coverage and weight are the same number. */
                    const float left = 1 - part[n];
                    const bool is_lost = !lost || lost[y * WO_VIEW_WIDTH + x + n];
                    if (left > WO_LIGHT_MIN && !is_lost)
                        part[n] = 1;
                    if (left > WO_LIGHT_MIN && is_lost)
                        guess[n] += left;
                }
                seen = v_load(part);
                guessed = v_load(guess);
            }
            for (int k = 0; k < 3; k++) {
                const vf scale = weight ? v_set(weight[k]) : rest;
                add_to(to + k * (WO_VIEW_ROWS * WO_VIEW_WIDTH),
                       v_mul(scale, v_load(view->plane[WO_VIEW_RED + k] + from)));
                if (weight)
                    add_to(sums->plane[WO_SUM_WEIGHTS + k] + y * WO_VIEW_WIDTH + x,
                           v_mul(scale, seen));
            }
            add_to(sums->plane[3] + y * WO_VIEW_WIDTH + x, v_mul(rest, alpha));
            add_to(sums->plane[WO_SUM_GUESSED] + y * WO_VIEW_WIDTH + x, v_mul(rest, guessed));
            add_to(sums->plane[WO_SUM_REST] + y * WO_VIEW_WIDTH + x, v_mul(rest, seen));
        }
    }
}

const wo_draw_kernels WO_DRAW_KERNELS = {draw, add};
