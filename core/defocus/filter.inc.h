/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* The kernels of filter.h over the vectors of simd_*.h; compiled once for each instruction set by
   the file that includes it after them and defines WO_FILTER_KERNELS. */

#include "defocus/filter.h"

#include <math.h>
#include <string.h>

/* px of blur that make another surface, and how much more for each px between pixel and tap. */
#define CLASS_PX    0.5f
#define CLASS_SLOPE 0.25f

WO_SIMD vf clip01(vf x)
{
    return v_min(v_max(x, v_set(0)), v_set(1));
}

/* wo_filter_soft; with a hole of this part of the disc. */
WO_SIMD vf met(vf reach, vf away, float hole)
{
    const vf one = v_set(1);
    const vf r = v_sub(reach, v_set(0.5f));
    const vf steep = v_fma(v_set(-WO_FILTER_SOFT), v_min(r, one), one);
    const vf t = clip01(v_mul(v_add(v_sub(r, away), one), steep));
    const vf outer = v_mul(t, t);
    if (!(hole > 0))
        return outer;
    const vf inner = v_mul(r, v_set(hole));
    return v_mul(outer, clip01(v_add(v_sub(away, inner), one)));
}

/* Shares of a place in the three classes. */
typedef struct split {
    vf part[WO_FILTER_CLASSES];
} split;

WO_SIMD split split_of(vf d, vf own, float away)
{
    const float slope = 1 / (1 + CLASS_SLOPE * away);
    const vf scaled = v_mul(v_sub(d, own), v_set(slope));
    const vf limit = v_set((CLASS_PX + CLASS_SLOPE * away) * slope);
    split s;
    s.part[WO_FILTER_BEFORE] = clip01(v_sub(scaled, limit));
    s.part[WO_FILTER_BEHIND] = clip01(v_sub(v_sub(v_set(0), scaled), limit));
    s.part[WO_FILTER_OWN] =
        v_sub(v_set(1), v_add(s.part[WO_FILTER_BEFORE], s.part[WO_FILTER_BEHIND]));
    return s;
}

typedef struct totals {
    vf c[WO_FILTER_CLASSES][4];
    vf guessed[WO_FILTER_CLASSES];
    vf behind, expected, open;
} totals;

WO_SIMD void add_class(const wo_filter_picture *p, ptrdiff_t at, vf cover, int class, vf w,
                       totals *t)
{
    const vf zero = v_set(0);
    if (!m_any(v_less(zero, w)))
        return;
    for (int k = 0; k < 3; k++)
        t->c[class][k] = v_fma(w, v_load(p->c[k] + at), t->c[class][k]);
    const vf a = v_mul(w, cover);
    t->c[class][3] = v_add(t->c[class][3], a);
    if (p->guessed)
        t->guessed[class] = v_fma(a, v_load(p->guessed + at), t->guessed[class]);
}

static int64_t gather(const wo_filter_view *view, int32_t x, int32_t y, int run_index,
                      const wo_filter_taps *taps, wo_filter_sums *sums)
{
    const vf zero = v_set(0);
    const vf one = v_set(1);
    const float hole = view->hole;
    const ptrdiff_t here = y * view->row + run_index * view->run + x / WO_PHASES;
    const vf own_d = v_load(view->near.d + here);
    const vf own_reach = v_load(view->near.reach + here);
    const vm own_behind = v_less(own_d, zero);
    int64_t steps = 0;
    totals t;
    for (int j = 0; j < WO_FILTER_CLASSES; j++) {
        for (int k = 0; k < 4; k++)
            t.c[j][k] = v_load(sums->c[j][k]);
        t.guessed[j] = v_load(sums->guessed[j]);
    }
    t.behind = v_load(sums->behind);
    t.expected = v_load(sums->expected);
    t.open = v_load(sums->open);
    for (int i = 0; i < taps->count; i++) {
        const int moved = run_index + taps->dx[i];
        const ptrdiff_t at = (y + taps->dy[i]) * view->row + (moved & (WO_PHASES - 1)) * view->run +
                             x / WO_PHASES + (moved >> 2);
        const vf area = v_set(taps->area[i]);
        const vf before = v_set(taps->before[i]);
        const vf behind = v_set(taps->behind[i]);
        const vf expected = v_mul(met(own_reach, v_select(own_behind, behind, before), hole), area);
        t.expected = v_add(t.expected, expected);
        if (view->open)
            t.open = v_fma(expected, v_load(view->open + at), t.open);

        const vf d = v_load(view->near.d + at);
        const vf near_met =
            met(v_load(view->near.reach + at), v_select(v_less(d, zero), behind, before), hole);
        const bool is_met = m_any(v_less(zero, near_met));
        steps++;
        split s;
        if (is_met) {
            s = split_of(d, own_d, taps->away[i]);
            const vf share = v_load(view->near.share + at);
            const vf w = v_mul(near_met, area);
            const vf full = v_mul(v_load(view->near.cover + at), share);
            for (int j = 0; j < WO_FILTER_CLASSES; j++)
                add_class(&view->near, at, full, j, v_mul(w, s.part[j]), &t);
            t.behind = v_fma(v_mul(w, share), s.part[WO_FILTER_BEHIND], t.behind);
        }
        if (!view->far.d)
            continue;
        const vf far_d = v_load(view->far.d + at);
        const vf far_met =
            met(v_load(view->far.reach + at), v_select(v_less(far_d, zero), behind, before), hole);
        steps++;
        if (!m_any(v_less(zero, far_met)))
            continue;
        /* Within a class the nearer surface hides the farther one at the same place. */
        if (!is_met)
            s = split_of(d, own_d, taps->away[i]);
        const vf cover = v_load(view->near.cover + at);
        const vf share = v_load(view->far.share + at);
        const vf w = v_mul(far_met, area);
        const vf full = v_mul(v_load(view->far.cover + at), share);
        const split f = split_of(far_d, own_d, taps->away[i]);
        for (int j = 0; j < WO_FILTER_CLASSES; j++) {
            const vf left = v_sub(one, v_mul(cover, s.part[j]));
            add_class(&view->far, at, full, j, v_mul(v_mul(w, f.part[j]), left), &t);
        }
        const vf left = v_sub(one, s.part[WO_FILTER_BEHIND]);
        t.behind = v_fma(v_mul(v_mul(w, share), f.part[WO_FILTER_BEHIND]), left, t.behind);
    }
    for (int j = 0; j < WO_FILTER_CLASSES; j++) {
        for (int k = 0; k < 4; k++)
            v_store(sums->c[j][k], t.c[j][k]);
        v_store(sums->guessed[j], t.guessed[j]);
    }
    v_store(sums->behind, t.behind);
    v_store(sums->expected, t.expected);
    v_store(sums->own_share, v_load(view->near.share + here));
    for (int i = 0; i < WO_LANES && view->open; i++)
        sums->own_open[i] = view->open[here + i] > 0;
    v_store(sums->open, t.open);
    return steps * WO_LANES;
}

WO_SIMD void order(vf *a, vf *b)
{
    const vf low = v_min(*a, *b);
    *b = v_max(*a, *b);
    *a = low;
}

static void median(const float *const rows[3], int count, float *out)
{
    for (int i = 0; i < count; i += WO_LANES) {
        vf p[9];
        for (int j = 0; j < 9; j++)
            p[j] = v_load(rows[j / 3] + i + j % 3 - 1);
        for (int j = 0; j < 9; j += 3) {
            order(&p[j + 1], &p[j + 2]);
            order(&p[j], &p[j + 1]);
            order(&p[j + 1], &p[j + 2]);
        }
        /* The largest of the least, the middle of the middles, the least of the largest. */
        const vf least = v_max(v_max(p[0], p[3]), p[6]);
        const vf most = v_min(v_min(p[2], p[5]), p[8]);
        const vf middle = v_max(v_min(p[1], p[4]), v_min(v_max(p[1], p[4]), p[7]));
        v_store(out + i, v_max(v_min(least, middle), v_min(v_max(least, middle), most)));
    }
}

const wo_filter_kernels WO_FILTER_KERNELS = {gather, median};
