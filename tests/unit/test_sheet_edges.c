/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/sheet.h"

#include "near.h"
#include "scenes.h"

#include <string.h>

static const wo_context plain = WO_CONTEXT_INIT;

enum { SIDE = 24 };
static const wo_rect square = {0, 0, SIDE, SIDE};

static wo_sheet sheet_make(wo_rect area)
{
    wo_sheet sheet;
    wo_error error = {WO_OK, ""};
    assert_int_equal(wo_sheet_create(&plain, area, &sheet, &error), WO_OK);
    const size_t n = (size_t)wo_rect_width(area) * (size_t)wo_rect_height(area);
    for (size_t i = 0; i < n; i++)
        sheet.v[i] = NAN;
    return sheet;
}

static void put(wo_sheet *sheet, size_t at, float v, const float c[4])
{
    sheet->v[at] = v;
    memcpy(sheet->c[at], c, sizeof sheet->c[at]);
    sheet->any = true;
}

/* The part of a pixel on the near side of a straight edge, by 16 x 16 points. */
static double near_part(double angle, double shift, int32_t x, int32_t y)
{
    int inside = 0;
    for (int i = 0; i < 256; i++) {
        const double px = x + (i % 16 + 0.5) / 16 - SIDE * 0.5;
        const double py = y + ((double)(i / 16) + 0.5) / 16 - SIDE * 0.5;
        inside += px * cos(angle) + py * sin(angle) < shift;
    }
    return inside / 256.0;
}

static const float near_colour[4] = {0.9f, 0.2f, 0.1f, 1};
static const float far_colour[4] = {0.1f, 0.5f, 0.8f, 1};
static const float v_near = 3;
static const float v_far = 0.25f;

/* An antialiased edge between two surfaces; the depth is that of the pixel's centre. */
static wo_sheet edge_scene(double angle, double shift)
{
    wo_sheet sheet = sheet_make(square);
    for (int32_t i = 0; i < SIDE * SIDE; i++) {
        const double part = near_part(angle, shift, i % SIDE, i / SIDE);
        const double centre = (i % SIDE + 0.5 - SIDE * 0.5) * cos(angle) +
                              ((double)(i / SIDE) + 0.5 - SIDE * 0.5) * sin(angle);
        float c[4];
        for (int k = 0; k < 4; k++)
            c[k] = (float)(part * (double)near_colour[k] + (1 - part) * (double)far_colour[k]);
        put(&sheet, (size_t)i, centre < shift ? v_near : v_far, c);
    }
    return sheet;
}

static void mixtures_are_unmixed(void **state)
{
    (void)state;
    int64_t mixed = 0;
    for (int turn = 0; turn < 16; turn++) {
        const double angle = turn * 0.41;
        const double shift = 0.13 * turn - 1;
        wo_sheet sheet = edge_scene(angle, shift);
        wo_sheet before = edge_scene(angle, shift);
        wo_sheet edges = sheet_make(square);
        int64_t split = 0;
        int64_t counted = 0;
        assert_int_equal(wo_sheet_split_edges(&plain, 4, NULL, &sheet, &edges, &split, NULL),
                         WO_OK);
        /* Away from the border of the picture, where the neighbours are known. */
        for (int32_t i = 0; i < SIDE * SIDE; i++) {
            const double part = near_part(angle, shift, i % SIDE, i / SIDE);
            const float *back = sheet.c[i];
            const float *front = edges.c[i];
            const bool is_split = !isnan(edges.v[i]);
            counted += is_split;
            if (i % SIDE < 2 || i % SIDE >= SIDE - 2 || i / SIDE < 2 || i / SIDE >= SIDE - 2)
                continue;
            assert_true(sheet.v[i] == before.v[i]);
            if (!is_split) {
                assert_memory_equal(back, before.c[i], sizeof sheet.c[i]);
                /* What is left mixed is next to nothing. */
                if (part > 0 && part < 1)
                    assert_true(part < 0.02 || part > 0.98);
                continue;
            }
            mixed++;
            const bool own_is_near = sheet.v[i] == v_near;
            assert_true(edges.v[i] == (own_is_near ? v_far : v_near));
            /* The nearer over the farther gives the pixel back. */
            const float *over = own_is_near ? back : front;
            const float *under = own_is_near ? front : back;
            for (int k = 0; k < 4; k++) {
                const double composite = (double)over[k] + (1 - (double)over[3]) * (double)under[k];
                assert_near(composite, (double)before.c[i][k], 2e-3);
                assert_near((double)over[k], part * (double)near_colour[k], 0.02);
                assert_near((double)under[k], (double)far_colour[k], 0.02);
            }
        }
        assert_int_equal(counted, split);
        assert_true(edges.any == (split > 0));
        wo_sheet_destroy(&plain, &sheet);
        wo_sheet_destroy(&plain, &before);
        wo_sheet_destroy(&plain, &edges);
    }
    assert_true(mixed > 16 * SIDE / 2);
}

static void what_is_no_edge_stays(void **state)
{
    (void)state;
    /* No visible step: the same scene where a dioptre is a small part of a px. */
    wo_sheet sheet = edge_scene(0.5, 0.2);
    wo_sheet edges = sheet_make(square);
    int64_t split = 0;
    assert_int_equal(wo_sheet_split_edges(&plain, 0.2, NULL, &sheet, &edges, &split, NULL), WO_OK);
    assert_int_equal(split, 0);
    assert_false(edges.any);
    /* Two surfaces that meet without a mixture. */
    for (size_t i = 0; i < SIDE * SIDE; i++)
        put(&sheet, i, i % SIDE < 11 ? v_near : v_far, i % SIDE < 11 ? near_colour : far_colour);
    assert_int_equal(wo_sheet_split_edges(&plain, 4, NULL, &sheet, &edges, &split, NULL), WO_OK);
    assert_int_equal(split, 0);
    /* A third colour at the edge is no mixture of the two. */
    const float green[4] = {0, 3, 0, 1};
    for (size_t y = 0; y < SIDE; y++)
        put(&sheet, y * SIDE + 11, v_far, green);
    assert_int_equal(wo_sheet_split_edges(&plain, 4, NULL, &sheet, &edges, &split, NULL), WO_OK);
    assert_int_equal(split, 0);
    for (size_t y = 0; y < SIDE; y++)
        assert_memory_equal(sheet.c[y * SIDE + 11], green, sizeof green);
    wo_sheet_destroy(&plain, &sheet);
    wo_sheet_destroy(&plain, &edges);
}

static void taken_places_stay_taken(void **state)
{
    (void)state;
    wo_sheet sheet = edge_scene(0, 0.4);
    wo_sheet edges = sheet_make(square);
    const float other[4] = {7, 7, 7, 1};
    for (size_t i = 0; i < SIDE * SIDE / 2; i++)
        put(&edges, i, 9, other);
    int64_t split = 5;
    assert_int_equal(wo_sheet_split_edges(&plain, 4, NULL, &sheet, &edges, &split, NULL), WO_OK);
    assert_true(split > 5 + SIDE / 2 - 2 && split <= 5 + SIDE / 2 + 1);
    for (size_t i = 0; i < SIDE * SIDE / 2; i++) {
        assert_true(edges.v[i] == 9);
        assert_memory_equal(edges.c[i], other, sizeof other);
    }
    wo_sheet_destroy(&plain, &sheet);
    wo_sheet_destroy(&plain, &edges);
}

/* A colour that changes smoothly over the picture. */
static void far_pattern(int32_t x, int32_t y, float c[4])
{
    c[0] = 0.5f + 0.004f * (float)x;
    c[1] = 0.5f - 0.003f * (float)y;
    c[2] = 0.3f;
    c[3] = 1;
}

static wo_sheet box_scene(wo_rect area, wo_rect box)
{
    wo_sheet sheet = sheet_make(area);
    const int32_t w = wo_rect_width(area);
    for (int32_t y = area.y1; y < area.y2; y++)
        for (int32_t x = area.x1; x < area.x2; x++) {
            const bool in = wo_rect_contains(box, (wo_rect){x, y, x + 1, y + 1});
            float c[4];
            far_pattern(x, y, c);
            put(&sheet, (size_t)((y - area.y1) * w + x - area.x1), in ? v_near : v_far,
                in ? near_colour : c);
        }
    return sheet;
}

static wo_sheet fill(const wo_sheet *sheets, size_t count, int levels)
{
    wo_sheet hidden = sheet_make(sheets[0].area);
    assert_int_equal(wo_sheet_fill_hidden(&plain, sheets, count, 4, levels, &hidden, NULL), WO_OK);
    assert_true(hidden.guessed);
    return hidden;
}

static void the_far_side_goes_on_behind(void **state)
{
    (void)state;
    const wo_rect area = {-32, -32, 32, 32};
    const wo_rect box = {-9, -6, 8, 11};
    wo_sheet sheet = box_scene(area, box);
    wo_sheet hidden = fill(&sheet, 1, 5);
    assert_true(hidden.any);
    for (int32_t y = area.y1; y < area.y2; y++)
        for (int32_t x = area.x1; x < area.x2; x++) {
            const size_t i = (size_t)((y + 32) * 64 + x + 32);
            if (!wo_rect_contains(box, (wo_rect){x, y, x + 1, y + 1})) {
                assert_true(isnan(hidden.v[i]));
                continue;
            }
            float c[4];
            far_pattern(x, y, c);
            assert_near((double)hidden.v[i], (double)v_far, 1e-5);
            assert_near((double)hidden.c[i][3], 1, 1e-5);
            for (int k = 0; k < 3; k++)
                assert_near((double)hidden.c[i][k], (double)c[k], 0.04);
        }
    /* The same from a smaller area, inside its margin: the grid is absolute. */
    const wo_rect part = {-16, -16, 32, 16};
    wo_sheet cut = box_scene(part, box);
    wo_sheet again = fill(&cut, 1, 2);
    wo_sheet wide = fill(&sheet, 1, 2);
    const int32_t margin = wo_sheet_fill_margin(2);
    assert_int_equal(margin, 8);
    const wo_rect inner = wo_rect_grow(part, -margin - 1, -margin - 1);
    for (int32_t y = inner.y1; y < inner.y2; y++)
        for (int32_t x = inner.x1; x < inner.x2; x++) {
            const size_t i = (size_t)((y - part.y1) * 48 + x - part.x1);
            const size_t j = (size_t)((y + 32) * 64 + x + 32);
            assert_memory_equal(&again.v[i], &wide.v[j], sizeof again.v[i]);
            assert_memory_equal(again.c[i], wide.c[j], sizeof again.c[i]);
        }
    wo_sheet_destroy(&plain, &sheet);
    wo_sheet_destroy(&plain, &hidden);
    wo_sheet_destroy(&plain, &cut);
    wo_sheet_destroy(&plain, &again);
    wo_sheet_destroy(&plain, &wide);
}

static void the_fill_reaches_as_far_as_it_says(void **state)
{
    (void)state;
    const wo_rect area = {-64, -64, 64, 64};
    const wo_rect box = {-50, -50, 50, 50};
    wo_sheet sheet = box_scene(area, box);
    wo_sheet hidden = fill(&sheet, 1, 3);
    for (int32_t x = -50; x < 50; x++) {
        const int32_t from_edge = x < 0 ? x + 50 : 49 - x;
        const bool filled = !isnan(hidden.v[64 * 128 + x + 64]);
        if (from_edge < 8)
            assert_true(filled);
        if (from_edge > wo_sheet_fill_margin(3))
            assert_false(filled);
    }
    wo_sheet_destroy(&plain, &sheet);
    wo_sheet_destroy(&plain, &hidden);
}

static void nothing_is_hidden(void **state)
{
    (void)state;
    const wo_rect area = {0, 0, 32, 32};
    /* One plane, and one plane that leans gently. */
    wo_sheet sheet = box_scene(area, (wo_rect){0});
    wo_sheet hidden = fill(&sheet, 1, 4);
    assert_false(hidden.any);
    wo_sheet_destroy(&plain, &hidden);
    for (size_t i = 0; i < 32 * 32; i++)
        sheet.v[i] = 0.1f * (float)(i % 32);
    hidden = fill(&sheet, 1, 4);
    assert_false(hidden.any);
    wo_sheet_destroy(&plain, &hidden);
    /* What a second layer holds everywhere needs no guess. */
    wo_sheet both[3] = {
        box_scene(area, (wo_rect){8, 8, 20, 20}), box_scene(area, (wo_rect){0}), {.area = area}};
    hidden = fill(both, 3, 4);
    assert_false(hidden.any);
    for (size_t i = 0; i < 32 * 32; i++)
        assert_true(isnan(hidden.v[i]));
    wo_sheet_destroy(&plain, &hidden);
    wo_sheet_destroy(&plain, &sheet);
    wo_sheet_destroy(&plain, &both[0]);
    wo_sheet_destroy(&plain, &both[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mixtures_are_unmixed),
        cmocka_unit_test(what_is_no_edge_stays),
        cmocka_unit_test(taken_places_stay_taken),
        cmocka_unit_test(the_far_side_goes_on_behind),
        cmocka_unit_test(the_fill_reaches_as_far_as_it_says),
        cmocka_unit_test(nothing_is_hidden),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
