/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/image.h"

static const wo_rect nothing = {0, 0, 0, 0};

static int32_t min_of(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static int32_t max_of(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

/* Sums of coordinates stay inside 32 bits by stopping at their ends. */
static int32_t saturate(int64_t value)
{
    return value < INT32_MIN ? INT32_MIN : value > INT32_MAX ? INT32_MAX : (int32_t)value;
}

bool wo_rect_empty(wo_rect r)
{
    return r.x2 <= r.x1 || r.y2 <= r.y1;
}

int32_t wo_rect_width(wo_rect r)
{
    return wo_rect_empty(r) ? 0 : saturate((int64_t)r.x2 - r.x1);
}

int32_t wo_rect_height(wo_rect r)
{
    return wo_rect_empty(r) ? 0 : saturate((int64_t)r.y2 - r.y1);
}

wo_rect wo_rect_intersect(wo_rect a, wo_rect b)
{
    const wo_rect r = {max_of(a.x1, b.x1), max_of(a.y1, b.y1), min_of(a.x2, b.x2),
                       min_of(a.y2, b.y2)};
    return wo_rect_empty(a) || wo_rect_empty(b) || wo_rect_empty(r) ? nothing : r;
}

wo_rect wo_rect_union(wo_rect a, wo_rect b)
{
    if (wo_rect_empty(a))
        return wo_rect_empty(b) ? nothing : b;
    if (wo_rect_empty(b))
        return a;
    return (wo_rect){min_of(a.x1, b.x1), min_of(a.y1, b.y1), max_of(a.x2, b.x2),
                     max_of(a.y2, b.y2)};
}

wo_rect wo_rect_grow(wo_rect r, int32_t dx, int32_t dy)
{
    if (wo_rect_empty(r))
        return nothing;
    const wo_rect grown = {saturate((int64_t)r.x1 - dx), saturate((int64_t)r.y1 - dy),
                           saturate((int64_t)r.x2 + dx), saturate((int64_t)r.y2 + dy)};
    return wo_rect_empty(grown) ? nothing : grown;
}

bool wo_rect_contains(wo_rect outer, wo_rect inner)
{
    return wo_rect_empty(inner) || (inner.x1 >= outer.x1 && inner.x2 <= outer.x2 &&
                                    inner.y1 >= outer.y1 && inner.y2 <= outer.y2);
}

bool wo_rect_equal(wo_rect a, wo_rect b)
{
    if (wo_rect_empty(a) || wo_rect_empty(b))
        return wo_rect_empty(a) && wo_rect_empty(b);
    return a.x1 == b.x1 && a.y1 == b.y1 && a.x2 == b.x2 && a.y2 == b.y2;
}
