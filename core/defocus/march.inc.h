/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* The march kernels over the vectors of simd_*.h; compiled once for each instruction set by the file
   that includes it after them and defines WO_MARCH_KERNELS. See march.h for what they do. */

#include "defocus/march.h"

#include <limits.h>
#include <math.h>

/* Sums of so many rays are added up before they join the total, to keep rounding small. */
enum { CHUNK = 32 };

/* One ray for all lanes: s(v) = am + bm v along its longer axis, n = n0 + slope i across. */
typedef struct line {
    float am, bm, n0, slope;
    int upright; /* the longer axis is y */
} line;

WO_SIMD line line_of(const wo_pencil *pencil, int i)
{
    const float ax = pencil->ax[i];
    const float ay = pencil->ay[i];
    const float bx = pencil->bx[i];
    const float by = pencil->by[i];
    line l;
    l.upright = fabsf(by) > fabsf(bx);
    l.am = l.upright ? ay : ax;
    l.bm = l.upright ? by : bx;
    const float an = l.upright ? ax : ay;
    const float bn = l.upright ? bx : by;
    l.slope = l.bm != 0 ? bn / l.bm : 0;
    l.n0 = an - l.slope * l.am;
    return l;
}

WO_SIMD int nearest(float x)
{
    return (int)lrintf(x);
}

/* Offset in a plane of lane 0 moved by (dx, dy) px. */
WO_SIMD ptrdiff_t place(const wo_march_view *view, int32_t x, int32_t y, int run_index, int dx,
                        int dy)
{
    const int moved = run_index + dx;
    return (y + dy) * view->row + (moved & (WO_PHASES - 1)) * view->run + x / WO_PHASES +
           (moved >> 2);
}

/* Colour of sheet s around the pixels at (dx, dy), at the fractions (tx, ty) beside their centres:
   Dodgson's quadratic interpolation (1997). Neighbours on another surface lend the pixel's own
   colour. */
WO_SIMD void sample_smooth(const wo_march_view *view, int s, int32_t x, int32_t y, int run_index,
                           int dx, int dy, vf tx, vf ty, vf out[4])
{
    const vf half = v_set(0.5f);
    const vf one = v_set(1);
    const vf xx = v_mul(tx, tx);
    const vf yy = v_mul(ty, ty);
    const vf wx[3] = {v_sub(xx, v_mul(half, tx)), v_sub(one, v_add(xx, xx)),
                      v_fma(half, tx, xx)};
    const vf wy[3] = {v_sub(yy, v_mul(half, ty)), v_sub(one, v_add(yy, yy)),
                      v_fma(half, ty, yy)};
    ptrdiff_t column[3];
    for (int a = 0; a < 3; a++)
        column[a] = place(view, x, y, run_index, dx + a - 1, dy);
    const ptrdiff_t centre = column[1];
    const vf v = v_load(view->v[s] + centre);
    const vf limit = v_set(view->v_connect);
    vf own = v_mul(wx[1], wy[1]);
    for (int k = 0; k < 4; k++)
        out[k] = v_set(0);
    for (int b = 0; b < 3; b++) {
        for (int a = 0; a < 3; a++) {
            if (a == 1 && b == 1)
                continue;
            const ptrdiff_t at = column[a] + (b - 1) * view->row;
            const vf w = v_mul(wx[a], wy[b]);
            const vm joined = v_less_equal(v_abs(v_sub(v_load(view->v[s] + at), v)), limit);
            const vf here = v_mask(joined, w);
            own = v_add(own, v_sub(w, here));
            for (int k = 0; k < 4; k++)
                out[k] = v_fma(here, v_load(view->c[s][k] + at), out[k]);
        }
    }
    for (int k = 0; k < 4; k++)
        out[k] = v_fma(own, v_load(view->c[s][k] + centre), out[k]);
    /* Overshoot may not make coverage leave 0..1. */
    out[3] = v_select(v_less(one, out[3]), one, out[3]);
    out[3] = v_select(v_less(out[3], v_set(0)), v_set(0), out[3]);
}

typedef struct hit {
    vm mask;
    vf v;
    vf c[4];
    int sheet;
} hit;

/* What the rays of a vector carry. */
typedef struct rays {
    vf light; /* not yet stopped, 0..1 */
    vf c[4];
    vf guessed;
} rays;

WO_SIMD void meet(rays *r, vm mask, const vf c[4], int is_guess)
{
    const vf light = v_mask(mask, r->light);
    for (int k = 0; k < 4; k++)
        r->c[k] = v_fma(light, c[k], r->c[k]);
    const vf stopped = v_mul(light, c[3]);
    if (is_guess)
        r->guessed = v_add(r->guessed, stopped);
    r->light = v_sub(r->light, stopped);
}

/* Several sheets at one step: nearest first, lane by lane. */
static void meet_in_order(rays *r, hit *hits, int count, const bool *guessed)
{
    vf is_guess[WO_SHEETS_MAX];
    const vf nothing = v_set(-INFINITY);
    for (int i = 0; i < count; i++) {
        is_guess[i] = v_set(guessed[hits[i].sheet] ? 1.0f : 0.0f);
        hits[i].v = v_select(hits[i].mask, hits[i].v, nothing);
        for (int k = 0; k < 4; k++)
            hits[i].c[k] = v_mask(hits[i].mask, hits[i].c[k]);
    }
    for (int i = 0; i < count; i++) {
        for (int j = i + 1; j < count; j++) {
            const vm swap = v_less(hits[i].v, hits[j].v);
            const vf v = hits[i].v;
            const vf g = is_guess[i];
            hits[i].v = v_select(swap, hits[j].v, v);
            hits[j].v = v_select(swap, v, hits[j].v);
            is_guess[i] = v_select(swap, is_guess[j], g);
            is_guess[j] = v_select(swap, g, is_guess[j]);
            for (int k = 0; k < 4; k++) {
                const vf c = hits[i].c[k];
                hits[i].c[k] = v_select(swap, hits[j].c[k], c);
                hits[j].c[k] = v_select(swap, c, hits[j].c[k]);
            }
        }
        const vf stopped = v_mul(r->light, hits[i].c[3]);
        for (int k = 0; k < 4; k++)
            r->c[k] = v_fma(r->light, hits[i].c[k], r->c[k]);
        r->guessed = v_fma(stopped, is_guess[i], r->guessed);
        r->light = v_sub(r->light, stopped);
    }
}

static void march(const wo_march_view *view, int32_t x, int32_t y, int run_index,
                  const wo_pencil *pencil, wo_march_sums *sums)
{
    const vf half = v_set(0.5f);
    const vf minus_half = v_set(-0.5f);
    const vf one = v_set(1);
    const vf connect = v_set(1 + WO_CONNECT_PX);
    const vf light_min = v_set(WO_LIGHT_MIN);
    const int sheets = view->sheets;
    vf total[6];
    vf chunk[6];
    for (int k = 0; k < 6; k++)
        total[k] = chunk[k] = v_set(0);
    int64_t steps = 0;

    for (int n = 0; n < pencil->count; n++) {
        const line l = line_of(pencil, n);
        /* From near to far, bm v falls or rises with the sign of bm; each sheet has its own part of
           the way: no surface of it is met before or after. */
        const int dir = l.bm >= 0 ? -1 : 1;
        int from[WO_SHEETS_MAX];
        int to[WO_SHEETS_MAX];
        int first = INT_MAX;
        int last = INT_MIN;
        for (int s = 0; s < sheets; s++) {
            from[s] = dir * nearest(l.am + l.bm * view->bounds[s].v_max);
            to[s] = dir * nearest(l.am + l.bm * view->bounds[s].v_min);
            first = from[s] < first ? from[s] : first;
            last = to[s] > last ? to[s] : last;
        }
        const vf bm = v_set(l.bm * (float)dir);
        rays r = {one, {v_set(0), v_set(0), v_set(0), v_set(0)}, v_set(0)};
        vm alive = m_set(-1);
        vf before[WO_SHEETS_MAX]; /* e of the step before: above 0.5 = in front */
        for (int s = 0; s < sheets; s++)
            before[s] = v_set(NAN);
        int next = first;
        for (int step = first; step <= last; step = next) {
            const int i = dir * step;
            next = INT_MAX;
            const int j = nearest(l.n0 + l.slope * (float)i);
            const int dx = l.upright ? j : i;
            const int dy = l.upright ? i : j;
            const ptrdiff_t at = place(view, x, y, run_index, dx, dy);
            const vf origin = v_set((l.am - (float)i) * (float)dir);
            hit hits[WO_SHEETS_MAX];
            int count = 0;
            const int smooth = i <= WO_SMOOTH_PX && i >= -WO_SMOOTH_PX;
            for (int s = 0; s < sheets; s++) {
                if (step < from[s] || step >= to[s]) {
                    if (step < from[s])
                        next = from[s] < next ? from[s] : next;
                    if (step != to[s])
                        continue;
                } else {
                    next = step + 1;
                }
                steps++;
                const vf v = v_load(view->v[s] + at);
                const vf e = v_fma(bm, v, origin);
                const vf e0 = before[s];
                before[s] = e;
                vm m = v_less_equal(v_abs(e), half);
                const vm crossed = m_and(m_and(v_less(e, minus_half), v_less(half, e0)),
                                         v_less_equal(v_sub(e0, e), connect));
                m = m_and(m_or(m, crossed), alive);
                if (!m_any(m))
                    continue;
                hit *h = &hits[count++];
                h->mask = m;
                h->v = v;
                h->sheet = s;
                if (!smooth) {
                    for (int k = 0; k < 4; k++)
                        h->c[k] = v_load(view->c[s][k] + at);
                    continue;
                }
                /* Where along the axis the surface is met, beside this pixel's centre. */
                const vf cross_t = v_sub(v_div(e0, v_sub(e0, e)), one);
                const vf t =
                    v_mask(m, v_mul(v_set((float)dir), v_select(crossed, cross_t, e)));
                const vf across = v_fma(v_set(l.slope), t,
                                        v_set(l.n0 + l.slope * (float)i - (float)j));
                if (l.upright)
                    sample_smooth(view, s, x, y, run_index, dx, dy, across, t, h->c);
                else
                    sample_smooth(view, s, x, y, run_index, dx, dy, t, across, h->c);
            }
            if (count == 1)
                meet(&r, hits[0].mask, hits[0].c, view->guessed[hits[0].sheet]);
            else if (count > 1)
                meet_in_order(&r, hits, count, view->guessed);
            if (count > 0) {
                alive = v_less(light_min, r.light);
                if (!m_any(alive))
                    break;
            }
        }
        const vf left = r.light;
        vm ends = m_except(m_set(-1), alive);
        if (m_any(alive)) {
            const int j = nearest(l.n0 + l.slope * (float)(dir * last));
            const int dx = l.upright ? j : dir * last;
            const int dy = l.upright ? dir * last : j;
            const vm lost = m_and(
                v_less(half, v_load(view->opaque + place(view, x, y, run_index, dx, dy))), alive);
            ends = m_or(ends, lost);
            r.guessed = v_add(r.guessed, v_mask(lost, left));
        }
        vf weight = v_select(ends, v_sub(one, left), one);
        if (pencil->weight) {
            const vf w = v_set(pencil->weight[n]);
            for (int k = 0; k < 4; k++)
                r.c[k] = v_mul(r.c[k], w);
            weight = v_mul(weight, w);
            r.guessed = v_mul(r.guessed, w);
        }
        for (int k = 0; k < 4; k++)
            chunk[k] = v_add(chunk[k], r.c[k]);
        chunk[4] = v_add(chunk[4], weight);
        chunk[5] = v_add(chunk[5], r.guessed);
        if (n % CHUNK == CHUNK - 1 || n == pencil->count - 1) {
            for (int k = 0; k < 6; k++) {
                total[k] = v_add(total[k], chunk[k]);
                chunk[k] = v_set(0);
            }
        }
    }
    for (int k = 0; k < 4; k++)
        v_store(sums->c[k], total[k]);
    v_store(sums->weight, total[4]);
    v_store(sums->guessed, total[5]);
    sums->steps = steps * WO_LANES;
}

static void single(const wo_march_view *view, int32_t x, int32_t y, int run_index,
                   const wo_pencil *pencil, wo_march_sums *sums)
{
    const float v_middle = 0.5f * (view->bounds[0].v_min + view->bounds[0].v_max);
    vf total[5];
    vf chunk[5];
    for (int k = 0; k < 5; k++)
        total[k] = chunk[k] = v_set(0);
    for (int n = 0; n < pencil->count; n++) {
        const line l = line_of(pencil, n);
        const int i = nearest(l.am + l.bm * v_middle);
        const float across = l.n0 + l.slope * (float)i;
        const int j = nearest(across);
        const int dx = l.upright ? j : i;
        const int dy = l.upright ? i : j;
        const ptrdiff_t at = place(view, x, y, run_index, dx, dy);
        vf c[4];
        if (i <= WO_SMOOTH_PX && i >= -WO_SMOOTH_PX) {
            const vf t = v_fma(v_set(l.bm), v_load(view->v[0] + at), v_set(l.am - (float)i));
            const vf u = v_fma(v_set(l.slope), t, v_set(across - (float)j));
            if (l.upright)
                sample_smooth(view, 0, x, y, run_index, dx, dy, u, t, c);
            else
                sample_smooth(view, 0, x, y, run_index, dx, dy, t, u, c);
        } else {
            for (int k = 0; k < 4; k++)
                c[k] = v_load(view->c[0][k] + at);
        }
        const float w = pencil->weight ? pencil->weight[n] : 1;
        for (int k = 0; k < 4; k++)
            chunk[k] = v_fma(c[k], v_set(w), chunk[k]);
        chunk[4] = v_add(chunk[4], v_set(w));
        if (n % CHUNK == CHUNK - 1 || n == pencil->count - 1) {
            for (int k = 0; k < 5; k++) {
                total[k] = v_add(total[k], chunk[k]);
                chunk[k] = v_set(0);
            }
        }
    }
    for (int k = 0; k < 4; k++)
        v_store(sums->c[k], total[k]);
    v_store(sums->weight, total[4]);
    v_store(sums->guessed, v_set(0));
    if (view->guessed[0])
        v_store(sums->guessed, total[3]);
    sums->steps = (int64_t)pencil->count * WO_LANES;
}

const wo_march_kernels WO_MARCH_KERNELS = {march, single};
