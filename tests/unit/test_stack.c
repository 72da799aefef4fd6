/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/stack.h"

#include "near.h"
#include "scenes.h"

#include <string.h>

static const wo_context plain = WO_CONTEXT_INIT;

static wo_sheet random_sheet(wo_rect area, rng *r, double gaps)
{
    wo_sheet sheet;
    assert_int_equal(wo_sheet_create(&plain, area, &sheet, NULL), WO_OK);
    const size_t n = (size_t)wo_rect_width(area) * (size_t)wo_rect_height(area);
    for (size_t i = 0; i < n; i++) {
        sheet.v[i] = rng_unit(r) < gaps ? NAN : (float)rng_range(r, -1, 1);
        for (int k = 0; k < 4; k++)
            sheet.c[i][k] = (float)rng_unit(r);
    }
    sheet.any = gaps < 1;
    return sheet;
}

static int32_t clamped(int32_t x, int32_t low, int32_t high)
{
    return x < low ? low : x >= high ? high - 1 : x;
}

static bool same(float a, float b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static void the_grid(void **state)
{
    (void)state;
    rng r = {1};
    for (int i = 0; i < 1000; i++) {
        const wo_rect a = {rng_int(&r, -300, 300), rng_int(&r, -300, 300), 0, 0};
        const wo_rect in = {a.x1, a.y1, a.x1 + rng_int(&r, 1, 90), a.y1 + rng_int(&r, 1, 90)};
        const wo_rect out = wo_stack_grid(in);
        assert_true(wo_rect_contains(out, in));
        assert_int_equal(((out.x1 % WO_BLOCK) + WO_BLOCK) % WO_BLOCK, 0);
        assert_int_equal(((out.x2 % WO_BLOCK) + WO_BLOCK) % WO_BLOCK, 0);
        assert_int_equal(((out.y1 % WO_CELL) + WO_CELL) % WO_CELL, 0);
        assert_int_equal(((out.y2 % WO_CELL) + WO_CELL) % WO_CELL, 0);
        assert_true(in.x1 - out.x1 < WO_BLOCK && out.x2 - in.x2 < WO_BLOCK);
        assert_true(in.y1 - out.y1 < WO_CELL && out.y2 - in.y2 < WO_CELL);
    }
}

static void pixels_have_places_of_their_own(void **state)
{
    (void)state;
    const wo_rect extent = {-40, -5, 40, 20};
    uint8_t opaque[80 * 25] = {0};
    rng r = {2};
    wo_sheet sheet = random_sheet(extent, &r, 0);
    wo_stack stack;
    assert_int_equal(wo_stack_create(&plain, &sheet, 1, opaque, extent, extent, &stack, NULL),
                     WO_OK);
    const size_t size = (size_t)stack.row * (size_t)wo_rect_height(stack.area);
    uint8_t *seen = wo_new(&plain, NULL, size, 1);
    assert_non_null(seen);
    for (int32_t y = stack.area.y1; y < stack.area.y2; y++)
        for (int32_t x = stack.area.x1; x < stack.area.x2; x++) {
            const ptrdiff_t at = wo_stack_at(&stack, x, y);
            assert_true(at >= 0 && (size_t)at < size);
            assert_int_equal(seen[at]++, 0);
            /* Pixels of a vector, four apart, lie side by side. */
            if (x + WO_PHASES < stack.area.x2)
                assert_int_equal(wo_stack_at(&stack, x + WO_PHASES, y), at + 1);
        }
    wo_delete(&plain, seen);
    wo_sheet_destroy(&plain, &sheet);
    wo_stack_destroy(&plain, &stack);
    assert_null(stack.memory);
    wo_stack_destroy(&plain, &stack);
}

/* Five sheets, of which three hold something, packed for an area that reaches over the extent. */
static void packing_and_bounds(void **state)
{
    (void)state;
    rng r = {3};
    const wo_rect extent = {-50, -30, 61, 44};
    const wo_rect held = {-50, -30, 40, 40}; /* sheets, less than the extent on two sides */
    const wo_rect area = {-70, -41, -5, 13};
    const double gaps[5] = {0, 1, 0.02, 1, 0.97};
    wo_sheet sheets[5];
    for (int s = 0; s < 5; s++)
        sheets[s] = random_sheet(held, &r, gaps[s]);
    sheets[4].guessed = true;
    uint8_t opaque[90 * 70];
    for (size_t i = 0; i < sizeof opaque; i++)
        opaque[i] = rng_unit(&r) < 0.95;
    wo_stack stack;
    assert_int_equal(wo_stack_create(&plain, sheets, 5, opaque, area, extent, &stack, NULL), WO_OK);
    assert_int_equal(stack.sheets, 3);
    assert_true(wo_rect_equal(stack.area, wo_stack_grid(area)));
    assert_false(stack.guessed[0] || stack.guessed[1]);
    assert_true(stack.guessed[2]);
    const int from[3] = {0, 2, 4};
    for (int32_t y = stack.area.y1; y < stack.area.y2; y++)
        for (int32_t x = stack.area.x1; x < stack.area.x2; x++) {
            const int32_t px = clamped(x, extent.x1, extent.x2);
            const int32_t py = clamped(y, extent.y1, extent.y2);
            const size_t i = (size_t)((py - held.y1) * 90 + px - held.x1);
            bool closed = true;
            for (int k = 0; k < 9; k++) {
                const int32_t nx = clamped(px + k % 3 - 1, held.x1, held.x2);
                const int32_t ny = clamped(py + k / 3 - 1, held.y1, held.y2);
                closed &= opaque[(ny - held.y1) * 90 + nx - held.x1];
            }
            const ptrdiff_t at = wo_stack_at(&stack, x, y);
            assert_true(stack.opaque[at] == (float)closed);
            for (int s = 0; s < 3; s++) {
                assert_true(same(stack.v[s][at], sheets[from[s]].v[i]));
                for (int k = 0; k < 4; k++)
                    assert_true(isnan(stack.v[s][at])
                                    ? isfinite(stack.c[s][k][at])
                                    : same(stack.c[s][k][at], sheets[from[s]].c[i][k]));
            }
        }
    for (int n = 0; n < 400; n++) {
        wo_rect q = {rng_int(&r, stack.area.x1, stack.area.x2 - 1),
                     rng_int(&r, stack.area.y1, stack.area.y2 - 1), 0, 0};
        q.x2 = rng_int(&r, q.x1 + 1, n % 3 ? stack.area.x2 : q.x1 + 1);
        q.y2 = rng_int(&r, q.y1 + 1, n % 3 ? stack.area.y2 : q.y1 + 1);
        for (int s = 0; s < 3; s++) {
            unsigned flags = 0;
            const wo_bounds bounds = wo_stack_bounds(&stack, s, q, &flags);
            /* By hand, over the cells that touch. */
            const wo_rect a = stack.area;
            float low = INFINITY;
            float high = -INFINITY;
            unsigned seen = 0;
            float step = 0;
            for (int32_t y = q.y1 - (q.y1 - a.y1) % WO_CELL; y < q.y2 || (y - a.y1) % WO_CELL; y++)
                for (int32_t x = q.x1 - (q.x1 - a.x1) % WO_CELL; x < q.x2 || (x - a.x1) % WO_CELL;
                     x++) {
                    const float v = stack.v[s][wo_stack_at(&stack, x, y)];
                    const bool gap = isnan(v);
                    seen |= gap ? WO_CELL_GAPS : 0;
                    if (!gap && stack.c[s][3][wo_stack_at(&stack, x, y)] < 1)
                        seen |= WO_CELL_OPEN;
                    if (!gap && stack.c[s][0][wo_stack_at(&stack, x, y)] != 0)
                        seen |= WO_CELL_LIT;
                    for (int k = 0; k < 9; k++) {
                        const int32_t nx = clamped(x + k % 3 - 1, a.x1, a.x2);
                        const int32_t ny = clamped(y + k / 3 - 1, a.y1, a.y2);
                        const float near = stack.v[s][wo_stack_at(&stack, nx, ny)];
                        step = fabsf(v - near) <= step ? step : fabsf(v - near);
                    }
                    low = fminf(low, v);
                    high = fmaxf(high, v);
                }
            assert_true(bounds.v_min == low && bounds.v_max == high);
            assert_int_equal(flags, seen);
            /* Also the steps just outside may count. */
            const float told = wo_stack_step(&stack, s, q);
            assert_true(isnan(step) ? isinf(told) : told >= step);
        }
    }
    for (int s = 0; s < 5; s++)
        wo_sheet_destroy(&plain, &sheets[s]);
    wo_stack_destroy(&plain, &stack);
}

/* A span bounds all that a vector meets in one stretch of a ray, and every step beside it. */
static void spans_cover_a_stretch(void **state)
{
    (void)state;
    rng r = {6};
    const wo_rect area = {0, 0, 4 * WO_BLOCK, 64};
    static uint8_t opaque[4 * WO_BLOCK * 64];
    wo_sheet sheet = random_sheet(area, &r, 0);
    for (int32_t y = 0; y < 64; y++)
        for (int32_t x = 0; x < area.x2; x++) /* steps that grow to the right, a few holes */
            sheet.v[y * area.x2 + x] *= rng_unit(&r) < 1e-3 ? NAN : (float)x / (float)area.x2;
    wo_stack stack;
    assert_int_equal(wo_stack_create(&plain, &sheet, 1, opaque, area, area, &stack, NULL), WO_OK);
    int holes = 0;
    for (int n = 0; n < 4000; n++) {
        const int32_t x = rng_int(&r, 1, area.x2 - WO_BLOCK - WO_CELL - 1);
        const int32_t y = rng_int(&r, 1, area.y2 - WO_CELL - 2);
        const wo_span span =
            stack.spans[0][(ptrdiff_t)(y / WO_CELL) * stack.cell_columns + x / WO_CELL];
        holes += isinf(span.step) != 0;
        for (int lane = 0; lane < WO_LANES; lane++) {
            const int32_t px = x + WO_PHASES * lane + rng_int(&r, 0, WO_CELL - 1);
            const int32_t py = y + rng_int(&r, 0, WO_CELL - 1);
            const float v = stack.v[0][wo_stack_at(&stack, px, py)];
            assert_false(v < span.v_min || v > span.v_max);
            for (int k = 0; k < 9; k++) {
                const float near = stack.v[0][wo_stack_at(&stack, px + k % 3 - 1, py + k / 3 - 1)];
                assert_true(isinf(span.step) || fabsf(v - near) <= span.step);
            }
        }
    }
    assert_in_range(holes, 1, 3999);
    wo_sheet_destroy(&plain, &sheet);
    wo_stack_destroy(&plain, &stack);
}

static void a_gap_once_seen_stays_seen(void **state)
{
    (void)state;
    rng r = {4};
    const wo_rect area = {0, 0, 32, 8};
    uint8_t opaque[32 * 8] = {0};
    wo_sheet sheet = random_sheet(area, &r, 0);
    wo_stack stack;
    assert_int_equal(wo_stack_create(&plain, &sheet, 1, opaque, area, area, &stack, NULL), WO_OK);
    unsigned flags = WO_CELL_GAPS;
    wo_stack_bounds(&stack, 0, area, &flags);
    assert_true(flags & WO_CELL_GAPS);
    flags = 0;
    wo_stack_bounds(&stack, 0, area, &flags);
    assert_false(flags & WO_CELL_GAPS);
    wo_sheet_destroy(&plain, &sheet);
    wo_stack_destroy(&plain, &stack);
}

static void a_stack_of_nothing(void **state)
{
    (void)state;
    rng r = {5};
    const wo_rect area = {0, 0, 40, 9};
    uint8_t opaque[40 * 9] = {0};
    wo_sheet sheets[2] = {random_sheet(area, &r, 1), {.area = area}};
    wo_stack stack;
    assert_int_equal(wo_stack_create(&plain, sheets, 2, opaque, area, area, &stack, NULL), WO_OK);
    assert_int_equal(stack.sheets, 0);
    wo_sheet_destroy(&plain, &sheets[0]);
    wo_stack_destroy(&plain, &stack);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_grid),           cmocka_unit_test(pixels_have_places_of_their_own),
        cmocka_unit_test(packing_and_bounds), cmocka_unit_test(a_gap_once_seen_stays_seen),
        cmocka_unit_test(a_stack_of_nothing), cmocka_unit_test(spans_cover_a_stretch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
