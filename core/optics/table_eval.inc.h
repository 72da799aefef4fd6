/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Polynomials of lens_table.h over the vectors of simd_*.h; compiled once for each instruction set
   by the file that includes it after them and defines WO_TABLE_EVAL. */
#include "optics/lens_table.h"

/* Rows of powers of t: sum_j t^j sum_i c s^i with j = first, first + 2 .. and i + j <= degree. */
WO_SIMD vf row_sum(const float *c, int degree, vf s)
{
    vf sum = v_set(c[degree]);
    for (int i = degree - 1; i >= 0; i--)
        sum = v_fma(sum, s, v_set(c[i]));
    return sum;
}

WO_SIMD vf even_sum(const float *c, int degree, vf s, vf t2)
{
    /* From the last row, the shortest, to the first. */
    int begin[WO_TABLE_DEGREE_MAX / 2 + 1];
    int rows = 0;
    for (int j = 0, at = 0; j <= degree; j += 2) {
        begin[rows++] = at;
        at += degree - j + 1;
    }
    vf sum = row_sum(c + begin[rows - 1], degree - 2 * (rows - 1), s);
    for (int r = rows - 2; r >= 0; r--)
        sum = v_fma(sum, t2, row_sum(c + begin[r], degree - 2 * r, s));
    return sum;
}

void WO_TABLE_EVAL(const wo_lens_table *table, const wo_table_node *node, const float *s,
                   const float *t, int count, const wo_table_rays *out)
{
    const int d = table->degree;
    const vf one = v_set(1);
    for (int n = 0; n < count; n += WO_LANES) {
        const vf x = v_load(s + n);
        const vf y = v_load(t + n);
        const vf y2 = v_mul(y, y);
        vf weight = even_sum(node->weight, d, x, y2);
        weight = v_select(v_less(weight, v_set(0)), v_set(0), weight);
        vf most = v_set(0);
        for (int k = 0; k < table->clips + table->edge; k++) {
            const vf q = k < table->clips ? even_sum(node->clip[k], WO_TABLE_CLIP_DEGREE, x, y2)
                                          : even_sum(node->edge, WO_TABLE_EDGE_DEGREE, x, y2);
            if (out->clip)
                most = v_select(v_less(most, q), q, most);
            else
                weight = v_mask(v_less_equal(q, one), weight);
        }
        if (out->clip)
            v_store(out->clip + n, most);
        v_store(out->weight + n, weight);
        v_store(out->ax + n, even_sum(node->ax, d, x, y2));
        v_store(out->bx + n, even_sum(node->bx, d, x, y2));
        v_store(out->ay + n, v_mul(y, even_sum(node->ay, d - 1, x, y2)));
        v_store(out->by + n, v_mul(y, even_sum(node->by, d - 1, x, y2)));
    }
}
