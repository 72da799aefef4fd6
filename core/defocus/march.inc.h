/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* The march kernels over the vectors of simd_*.h; compiled once for each instruction set by the
   file that includes it after them and defines WO_MARCH_KERNELS. See march.h for what they do. */

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
   colour: those more than *limit dioptres away; NULL = there are none. Beside a change of coverage
   it overshoots 0..1: colour and coverage do so together, which keeps every sum over the ray right;
   cut, one colour would not stay one colour. */
WO_SIMD void sample_smooth(const wo_march_view *view, int s, int32_t x, int32_t y, int run_index,
                           int dx, int dy, vf tx, vf ty, const float *limit, vf out[4])
{
    const vf half = v_set(0.5f);
    const vf one = v_set(1);
    const vf xx = v_mul(tx, tx);
    const vf yy = v_mul(ty, ty);
    const vf wx[3] = {v_sub(xx, v_mul(half, tx)), v_sub(one, v_add(xx, xx)), v_fma(half, tx, xx)};
    const vf wy[3] = {v_sub(yy, v_mul(half, ty)), v_sub(one, v_add(yy, yy)), v_fma(half, ty, yy)};
    ptrdiff_t column[3];
    for (int a = 0; a < 3; a++)
        column[a] = place(view, x, y, run_index, dx + a - 1, dy);
    const ptrdiff_t centre = column[1];
    const vf v = v_load(view->v[s] + centre);
    const vf most = v_set(limit ? *limit : 0);
    vf own = v_mul(wx[1], wy[1]);
    for (int k = 0; k < 4; k++)
        out[k] = v_set(0);
    for (int b = 0; b < 3; b++) {
        for (int a = 0; a < 3; a++) {
            if (a == 1 && b == 1)
                continue;
            const ptrdiff_t at = column[a] + (b - 1) * view->row;
            const vf w = v_mul(wx[a], wy[b]);
            vf here = w;
            if (limit) {
                const vf away = v_abs(v_sub(v_load(view->v[s] + at), v));
                here = v_mask(v_less_equal(away, most), w);
                own = v_add(own, v_sub(w, here));
            }
            for (int k = 0; k < 4; k++)
                out[k] = v_fma(here, v_load(view->c[s][k] + at), out[k]);
        }
    }
    for (int k = 0; k < 4; k++)
        out[k] = v_fma(own, v_load(view->c[s][k] + centre), out[k]);
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

/* Sums of what is much blurred, over all rays of a pencil. */
typedef struct parts {
    vf near[WO_PART_SUMS], far[WO_PART_SUMS];
    vf v_apart, v_behind; /* dioptres, + and - */
    vf scale[4];          /* weights of the ray at work */
} parts;

WO_SIMD void add_part(vf sum[WO_PART_SUMS], const vf scale[4], vm mask, vf light, vf v,
                      const vf c[4])
{
    light = v_mask(mask, light);
    for (int k = 0; k < 3; k++) {
        const vf part = v_mul(light, scale[k]);
        sum[k] = v_fma(part, c[k], sum[k]);
        sum[WO_PART_COVERAGE + k] = v_fma(part, c[3], sum[WO_PART_COVERAGE + k]);
    }
    const vf stopped = v_mul(v_mul(light, scale[3]), c[3]);
    sum[WO_PART_BLUR] = v_add(sum[WO_PART_BLUR], v_mask(mask, v_div(stopped, v_abs(v))));
}

/* light: what arrives at a surface at vergence v. p: NULL = parts are not wanted. */
WO_SIMD void keep_apart(parts *p, vm mask, vf light, vf v, const vf c[4])
{
    if (!p)
        return;
    const vm near = m_and(mask, v_less(p->v_apart, v));
    const vm far = m_and(mask, v_less(v, p->v_behind));
    if (m_any(near))
        add_part(p->near, p->scale, near, light, v, c);
    if (m_any(far))
        add_part(p->far, p->scale, far, light, v, c);
}

WO_SIMD void meet(rays *r, vm mask, vf v, const vf c[4], int is_guess, parts *p)
{
    keep_apart(p, mask, r->light, v, c);
    const vf light = v_mask(mask, r->light);
    for (int k = 0; k < 4; k++)
        r->c[k] = v_fma(light, c[k], r->c[k]);
    const vf stopped = v_mul(light, c[3]);
    if (is_guess)
        r->guessed = v_add(r->guessed, stopped);
    r->light = v_sub(r->light, stopped);
}

/* Several sheets at one step: nearest first, lane by lane; the first sheet first where they meet.
 */
static void meet_in_order(rays *r, hit *hits, int count, const bool *guessed, parts *p)
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
        /* The nearest of the rest moves up past its neighbours: equals keep the order of sheets. */
        for (int j = count - 1; j > i; j--) {
            hit *const o = &hits[j - 1];
            hit *const q = &hits[j];
            const vm swap = v_less(o->v, q->v);
            const vf v = o->v;
            const vf g = is_guess[j - 1];
            o->v = v_select(swap, q->v, v);
            q->v = v_select(swap, v, q->v);
            is_guess[j - 1] = v_select(swap, is_guess[j], g);
            is_guess[j] = v_select(swap, g, is_guess[j]);
            for (int k = 0; k < 4; k++) {
                const vf c = o->c[k];
                o->c[k] = v_select(swap, q->c[k], c);
                q->c[k] = v_select(swap, c, q->c[k]);
            }
        }
        keep_apart(p, v_less(nothing, hits[i].v), r->light, hits[i].v, hits[i].c);
        const vf stopped = v_mul(r->light, hits[i].c[3]);
        for (int k = 0; k < 4; k++)
            r->c[k] = v_fma(r->light, hits[i].c[k], r->c[k]);
        r->guessed = v_fma(stopped, is_guess[i], r->guessed);
        r->light = v_sub(r->light, stopped);
    }
}

/* A ray's way through the sheets, in steps from near to far: step = dir i. */
typedef struct way {
    line l;
    int dir;
    int first, last;
    float base;    /* the step of a surface at vergence v is base - fall v */
    float fall;    /* >= 0 */
    float connect; /* dioptres: neighbours closer than this are one surface for this ray */
    int from[WO_SHEETS_MAX], to[WO_SHEETS_MAX]; /* no surface of the sheet is met before or after */
} way;

/* Part of a way, at most WO_CELL steps, and the sheets that may be met in it. */
typedef struct stretch {
    int count;
    int sheet[WO_SHEETS_MAX];
    int from[WO_SHEETS_MAX], to[WO_SHEETS_MAX];
    bool joined[WO_SHEETS_MAX]; /* neighbours are one surface everywhere */
    int first, last;
    int next; /* no sheet can be met between the end of this part and this step */
} stretch;

WO_SIMD way way_of(const wo_march_view *view, const wo_pencil *pencil, int n)
{
    way w;
    w.l = line_of(pencil, n);
    w.dir = w.l.bm >= 0 ? -1 : 1;
    w.base = w.l.am * (float)w.dir;
    w.fall = fabsf(w.l.bm);
    w.connect = WO_CONNECT_PX / fmaxf(w.fall, 1e-30f);
    w.first = INT_MAX;
    w.last = INT_MIN;
    for (int s = 0; s < view->sheets; s++) {
        w.from[s] = nearest(w.base - w.fall * view->bounds[s].v_max);
        w.to[s] = nearest(w.base - w.fall * view->bounds[s].v_min);
        w.first = w.from[s] < w.first ? w.from[s] : w.first;
        w.last = w.to[s] > w.last ? w.to[s] : w.last;
    }
    return w;
}

/* Across the longer axis at a step. */
WO_SIMD int across_at(const way *w, int step)
{
    return nearest(w->l.n0 + w->l.slope * (float)(w->dir * step));
}

/* Where a way is at a step, as an offset from the pixels. */
WO_SIMD ptrdiff_t way_place(const wo_march_view *view, int32_t x, int32_t y, int run_index,
                            const way *w, int step)
{
    const int i = w->dir * step;
    const int j = across_at(w, step);
    return w->l.upright ? place(view, x, y, run_index, j, i) : place(view, x, y, run_index, i, j);
}

/* Sheets with a surface that can be met in steps first..last: hit within half a step, or crossed
   by up to the length of a connection. */
WO_SIMD void look_ahead(const wo_march_view *view, int32_t x, int32_t y, int run_index,
                        const way *w, int first, int last, stretch *out)
{
    const int i0 = w->dir * first;
    const int i1 = w->dir * last;
    const int j0 = across_at(w, first);
    const int j1 = across_at(w, last);
    const int i = i0 < i1 ? i0 : i1;
    const int j = j0 < j1 ? j0 : j1;
    const int32_t left = x + run_index + (w->l.upright ? j : i);
    const int32_t low = y + (w->l.upright ? i : j);
    const ptrdiff_t cell = (ptrdiff_t)(low / WO_CELL) * view->span_columns + left / WO_CELL;
    out->count = 0;
    out->first = INT_MAX;
    out->last = INT_MIN;
    out->next = INT_MAX;
    for (int s = 0; s < view->sheets; s++) {
        if (last < w->to[s]) {
            const int next = w->from[s] > last ? w->from[s] : last + 1;
            out->next = next < out->next ? next : out->next;
        }
        if (first > w->to[s] || last < w->from[s])
            continue;
        const wo_span b = view->spans[s][cell];
        const float nearest_step = w->base - w->fall * b.v_max - 0.51f;
        const float farthest_step = w->base - w->fall * b.v_min + (0.51f + WO_CONNECT_PX);
        if (!(nearest_step <= (float)last && farthest_step >= (float)first))
            continue;
        int from = w->from[s] > first ? w->from[s] : first;
        int to = w->to[s] < last ? w->to[s] : last;
        if (nearest_step > (float)from)
            from = (int)ceilf(nearest_step);
        if (farthest_step < (float)to)
            to = (int)floorf(farthest_step);
        if (from > to)
            continue;
        out->sheet[out->count] = s;
        out->joined[out->count] = b.step <= w->connect;
        out->from[out->count] = from;
        out->to[out->count++] = to;
        out->first = from < out->first ? from : out->first;
        out->last = to > out->last ? to : out->last;
    }
}

/* Where a sheet stands at one step. */
typedef struct meeting {
    vm mask;    /* lanes that meet it */
    vm crossed; /* of these, passed from before to behind it since the last step */
    vf e, e0;   /* steps from here to the surface, now and one step before */
    vf v;
} meeting;

WO_SIMD meeting meet_sheet(const float *plane, ptrdiff_t at, vf fall, vf origin, vf before,
                           vm alive)
{
    meeting m;
    m.v = v_load(plane + at);
    m.e = v_fma(fall, m.v, origin);
    m.e0 = before;
    m.crossed = m_and(m_and(v_less(m.e, v_set(-0.5f)), v_less(v_set(0.5f), before)),
                      v_less_equal(v_sub(before, m.e), v_set(1 + WO_CONNECT_PX)));
    m.mask = m_and(m_or(v_less_equal(v_abs(m.e), v_set(0.5f)), m.crossed), alive);
    return m;
}

/* Colour at a meeting; at is the place of the pixels at step i (dx, dy from the ray's own). */
WO_SIMD void colour_of(const wo_march_view *view, int s, int32_t x, int32_t y, int run_index,
                       const way *w, int i, int j, ptrdiff_t at, const meeting *m,
                       const float *limit, vf c[4])
{
    if (i > WO_SMOOTH_PX || i < -WO_SMOOTH_PX) {
        for (int k = 0; k < 4; k++)
            c[k] = v_load(view->c[s][k] + at);
        return;
    }
    /* Where along the axis the surface is met, beside this pixel's centre. */
    const vf cross_t = v_sub(v_div(m->e0, v_sub(m->e0, m->e)), v_set(1));
    const vf t = v_mask(m->mask, v_mul(v_set((float)w->dir), v_select(m->crossed, cross_t, m->e)));
    const vf across =
        v_fma(v_set(w->l.slope), t, v_set(w->l.n0 + w->l.slope * (float)i - (float)j));
    if (w->l.upright)
        sample_smooth(view, s, x, y, run_index, j, i, across, t, limit, c);
    else
        sample_smooth(view, s, x, y, run_index, i, j, t, across, limit, c);
}

/* What a vector's rays know on their way. */
typedef struct travel {
    rays r;
    vm alive;
    vf before[WO_SHEETS_MAX]; /* e of the step before: above 0.5 = in front */
    int known[WO_SHEETS_MAX]; /* the step that before belongs to */
    int64_t steps;
} travel;

/* A stretch with one sheet in it: the usual case. */
WO_SIMD void travel_one(const wo_march_view *view, int32_t x, int32_t y, int run_index,
                        const way *w, vf fall, const stretch *part, travel *t, parts *p)
{
    const int s = part->sheet[0];
    const float *const plane = view->v[s];
    vf before = t->before[s];
    int step = part->first;
    for (; step <= part->last; step++) {
        const int i = w->dir * step;
        const int j = across_at(w, step);
        const ptrdiff_t at =
            w->l.upright ? place(view, x, y, run_index, j, i) : place(view, x, y, run_index, i, j);
        const meeting m =
            meet_sheet(plane, at, fall, v_set(w->base - (float)step), before, t->alive);
        before = m.e;
        if (!m_any(m.mask))
            continue;
        vf c[4];
        if (part->joined[0])
            colour_of(view, s, x, y, run_index, w, i, j, at, &m, NULL, c);
        else
            colour_of(view, s, x, y, run_index, w, i, j, at, &m, &w->connect, c);
        meet(&t->r, m.mask, m.v, c, view->guessed[s], p);
        t->alive = v_less(v_set(WO_LIGHT_MIN), t->r.light);
        if (!m_any(t->alive))
            break;
    }
    t->before[s] = before;
    t->known[s] = part->last;
    t->steps += step - part->first;
}

/* A stretch with several sheets. */
WO_SIMD void travel_many(const wo_march_view *view, int32_t x, int32_t y, int run_index,
                         const way *w, vf fall, const stretch *part, travel *t, parts *p)
{
    for (int step = part->first; step <= part->last; step++) {
        const int i = w->dir * step;
        const int j = across_at(w, step);
        const ptrdiff_t at =
            w->l.upright ? place(view, x, y, run_index, j, i) : place(view, x, y, run_index, i, j);
        const vf origin = v_set(w->base - (float)step);
        hit hits[WO_SHEETS_MAX];
        int count = 0;
        for (int a = 0; a < part->count; a++) {
            if (step < part->from[a] || step > part->to[a])
                continue;
            const int s = part->sheet[a];
            const meeting m = meet_sheet(view->v[s], at, fall, origin, t->before[s], t->alive);
            t->before[s] = m.e;
            t->known[s] = step;
            t->steps++;
            if (!m_any(m.mask))
                continue;
            hit *h = &hits[count++];
            h->mask = m.mask;
            h->v = m.v;
            h->sheet = s;
            colour_of(view, s, x, y, run_index, w, i, j, at, &m, &w->connect, h->c);
        }
        if (count == 0)
            continue;
        if (count == 1)
            meet(&t->r, hits[0].mask, hits[0].v, hits[0].c, view->guessed[hits[0].sheet], p);
        else
            meet_in_order(&t->r, hits, count, view->guessed, p);
        t->alive = v_less(v_set(WO_LIGHT_MIN), t->r.light);
        if (!m_any(t->alive))
            return;
    }
}

/* The step before a sheet comes into view again, if it was out of it. */
WO_SIMD void catch_up(const wo_march_view *view, int32_t x, int32_t y, int run_index, const way *w,
                      vf fall, const stretch *part, travel *t)
{
    for (int a = 0; a < part->count; a++) {
        const int s = part->sheet[a];
        const int step = part->from[a] - 1;
        if (t->known[s] == step)
            continue;
        t->known[s] = step;
        t->before[s] = v_set(NAN);
        if (step < w->from[s])
            continue;
        const ptrdiff_t at = way_place(view, x, y, run_index, w, step);
        t->before[s] = v_fma(fall, v_load(view->v[s] + at), v_set(w->base - (float)step));
        t->steps++;
    }
}

/* Sums: colours, weights, guessed light. */
enum { SUMS = 9, WEIGHTS = 4, GUESSED = 8 };

/* A ray that no light comes through. */
WO_SIMD bool is_dark(const wo_pencil *pencil, int n)
{
    return pencil->weight[0] && pencil->weight[0][n] == 0 && pencil->weight[1][n] == 0 &&
           pencil->weight[2][n] == 0;
}

WO_SIMD void add_ray(const wo_pencil *pencil, int n, const vf c[4], vf weight, vf guessed,
                     vf sum[SUMS])
{
    if (!pencil->weight[0]) {
        for (int k = 0; k < 4; k++)
            sum[k] = v_add(sum[k], c[k]);
        sum[WEIGHTS] = v_add(sum[WEIGHTS], weight);
        sum[GUESSED] = v_add(sum[GUESSED], guessed);
        return;
    }
    const float r = pencil->weight[0][n];
    const float g = pencil->weight[1][n];
    const float b = pencil->weight[2][n];
    const vf scale[4] = {v_set(r), v_set(g), v_set(b), v_set((r + g + b) * (1.0f / 3))};
    for (int k = 0; k < 4; k++) {
        sum[k] = v_fma(c[k], scale[k], sum[k]);
        sum[WEIGHTS + k] = v_fma(weight, scale[k], sum[WEIGHTS + k]);
    }
    sum[GUESSED] = v_fma(guessed, scale[3], sum[GUESSED]);
}

WO_SIMD void add_chunk(vf total[SUMS], vf chunk[SUMS])
{
    for (int k = 0; k < SUMS; k++) {
        total[k] = v_add(total[k], chunk[k]);
        chunk[k] = v_set(0);
    }
}

WO_SIMD void store_sums(const wo_pencil *pencil, const vf total[SUMS], wo_march_sums *sums)
{
    for (int k = 0; k < 4; k++) {
        v_store(sums->c[k], total[k]);
        v_store(sums->weight[k], total[pencil->weight[0] ? WEIGHTS + k : WEIGHTS]);
    }
    v_store(sums->guessed, total[GUESSED]);
}

WO_SIMD void begin_parts(const wo_march_view *view, parts *p)
{
    for (int k = 0; k < WO_PART_SUMS; k++)
        p->near[k] = p->far[k] = v_set(0);
    for (int k = 0; k < 4; k++)
        p->scale[k] = v_set(1);
    p->v_apart = v_set(view->v_apart);
    p->v_behind = v_set(-view->v_apart);
}

WO_SIMD void weigh_parts(const wo_pencil *pencil, int n, parts *p)
{
    if (!pencil->weight[0])
        return;
    float sum = 0;
    for (int k = 0; k < 3; k++) {
        p->scale[k] = v_set(pencil->weight[k][n]);
        sum += pencil->weight[k][n];
    }
    p->scale[3] = v_set(sum * (1.0f / 3));
}

WO_SIMD void store_parts(const parts *p, wo_march_sums *sums)
{
    for (int k = 0; k < WO_PART_SUMS; k++) {
        v_store(sums->near[k], p->near[k]);
        v_store(sums->far[k], p->far[k]);
    }
}

WO_SIMD void march_all(const wo_march_view *view, int32_t x, int32_t y, int run_index,
                       const wo_pencil *pencil, parts *p, wo_march_sums *sums)
{
    const vf half = v_set(0.5f);
    const vf one = v_set(1);
    const vf zero = v_set(0);
    vf total[SUMS];
    vf chunk[SUMS];
    for (int k = 0; k < SUMS; k++)
        total[k] = chunk[k] = zero;
    travel t;
    t.steps = 0;

    for (int n = 0; n < pencil->count; n++) {
        if (is_dark(pencil, n))
            continue;
        const way w = way_of(view, pencil, n);
        const vf fall = v_set(-w.fall);
        t.r = (rays){one, {zero, zero, zero, zero}, zero};
        t.alive = m_set(-1);
        if (p)
            weigh_parts(pencil, n, p);
        for (int s = 0; s < view->sheets; s++)
            t.known[s] = INT_MIN;
        stretch part = {.next = w.first};
        while (part.next <= w.last && m_any(t.alive)) {
            const int begin = part.next;
            const int end = begin + WO_CELL - 1 < w.last ? begin + WO_CELL - 1 : w.last;
            look_ahead(view, x, y, run_index, &w, begin, end, &part);
            catch_up(view, x, y, run_index, &w, fall, &part, &t);
            if (part.count == 1)
                travel_one(view, x, y, run_index, &w, fall, &part, &t, p);
            else
                travel_many(view, x, y, run_index, &w, fall, &part, &t, p);
        }
        const vf left = t.r.light;
        vm ends = m_except(m_set(-1), t.alive);
        if (m_any(t.alive)) {
            const ptrdiff_t at = way_place(view, x, y, run_index, &w, w.last);
            const vm lost = m_and(v_less(half, v_load(view->opaque + at)), t.alive);
            ends = m_or(ends, lost);
            t.r.guessed = v_add(t.r.guessed, v_mask(lost, left));
        }
        /* The same number twice where a ray ends: an opaque scene has a coverage of exactly 1. */
        const vf stopped = v_sub(one, left);
        t.r.c[3] = v_select(ends, stopped, t.r.c[3]);
        const vf weight = v_select(ends, stopped, one);
        add_ray(pencil, n, t.r.c, weight, t.r.guessed, chunk);
        if (n % CHUNK == CHUNK - 1)
            add_chunk(total, chunk);
    }
    add_chunk(total, chunk);
    store_sums(pencil, total, sums);
    sums->steps = t.steps * WO_LANES;
}

static void march(const wo_march_view *view, int32_t x, int32_t y, int run_index,
                  const wo_pencil *pencil, wo_march_sums *sums)
{
    march_all(view, x, y, run_index, pencil, NULL, sums);
}

static void march_apart(const wo_march_view *view, int32_t x, int32_t y, int run_index,
                        const wo_pencil *pencil, wo_march_sums *sums)
{
    parts p;
    begin_parts(view, &p);
    march_all(view, x, y, run_index, pencil, &p, sums);
    store_parts(&p, sums);
}

static void single(const wo_march_view *view, int32_t x, int32_t y, int run_index,
                   const wo_pencil *pencil, wo_march_sums *sums)
{
    const float v_middle = 0.5f * (view->bounds[0].v_min + view->bounds[0].v_max);
    vf total[SUMS];
    vf chunk[SUMS];
    for (int k = 0; k < SUMS; k++)
        total[k] = chunk[k] = v_set(0);
    for (int n = 0; n < pencil->count; n++) {
        if (is_dark(pencil, n))
            continue;
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
                sample_smooth(view, 0, x, y, run_index, dx, dy, u, t, NULL, c);
            else
                sample_smooth(view, 0, x, y, run_index, dx, dy, t, u, NULL, c);
        } else {
            for (int k = 0; k < 4; k++)
                c[k] = v_load(view->c[0][k] + at);
        }
        const vf one = v_set(1);
        const vf left = v_sub(one, c[3]);
        const vm ends = v_less_equal(left, v_set(WO_LIGHT_MIN));
        const vf weight = v_select(ends, c[3], one);
        add_ray(pencil, n, c, weight, view->guessed[0] ? c[3] : v_set(0), chunk);
        if (n % CHUNK == CHUNK - 1)
            add_chunk(total, chunk);
    }
    add_chunk(total, chunk);
    store_sums(pencil, total, sums);
    sums->steps = (int64_t)pencil->count * WO_LANES;
}

const wo_march_kernels WO_MARCH_KERNELS = {march, march_apart, single};
