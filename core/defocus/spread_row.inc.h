/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
/* No guard: each kernel's file includes it once, after the vectors d4 and i4. */
#include "defocus/spread_row.h"

/* Adding this to a number below 2^51 leaves it, rounded, in the low bits. */
#define INTEGER 0x1.8p52

int64_t WO_SPREAD_FUNCTION(wo_spread_row *row, const wo_light *light, const wo_light *end,
                           int32_t dy)
{
    int64_t written = 0;
    const d4 integer = d4_set(INTEGER);
    const int32_t last = row->x + row->width + row->reach;
    for (; light < end && light->x < last; light++) {
        const wo_point_spread *spread = &row->spreads[light->spread];
        const wo_rect lit = spread->rect;
        const int32_t from = light->x - row->x;
        if (dy < lit.y1 || dy >= lit.y2 || from + lit.x2 < 0 || from + lit.x1 >= row->width)
            continue;
        const uint32_t *first = spread->first + (dy - lit.y1);
        const wo_point_step *step = spread->steps + first[0];
        const wo_point_step *const stop = spread->steps + first[1];
        const d4 c = d4_mul(d4_load(light->c), d4_set(row->unit[light->plane]));
        uint64_t *const to = row->steps + light->plane * row->stride;
        wo_span_x *const t = &row->touched[light->plane];
        i4 before = i4_of(integer);
        for (; step < stop; step++) {
            const int32_t x = from + step->x;
            if (x >= row->width)
                break;
            const i4 now = i4_of(d4_add(d4_mul(d4_load(step->level), c), integer));
            i4_add_to(to + 4 * (ptrdiff_t)(x > 0 ? x : 0), i4_sub(now, before));
            before = now;
        }
        written += first[1] - first[0];
        t->x1 = from + lit.x1 < t->x1 ? from + lit.x1 : t->x1;
        t->x2 = from + lit.x2 + 1 > t->x2 ? from + lit.x2 + 1 : t->x2;
    }
    return written;
}
