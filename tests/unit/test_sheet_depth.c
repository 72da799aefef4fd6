/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/sheet.h"

#include "near.h"
#include "scenes.h"

#include <string.h>

static const wo_context plain = WO_CONTEXT_INIT;

enum { SIDE = 48, FINE = 8 };
static const wo_rect square = {0, 0, SIDE, SIDE};
#define PX 20.0 /* for each dioptre */

/* A scene of depths: metres at a point. */
typedef double depth_at(const void *what, double x, double y);

typedef struct edge {
    double angle, shift, near, far, half_width;
} edge;

static double edge_depth(const void *what, double x, double y)
{
    const edge *e = what;
    const double d = (x - SIDE * 0.5) * cos(e->angle) + (y - SIDE * 0.5) * sin(e->angle) - e->shift;
    const bool near = e->half_width > 0 ? fabs(d) < e->half_width : d < 0;
    return near ? e->near : e->far;
}

/* A leaning plane, a ball before it, a block whose corner is three steps high. */
static double solid_depth(const void *what, double x, double y)
{
    (void)what;
    const double r = hypot(x - 15, y - 17) / 11;
    if (r < 1)
        return 2 - 0.4 * sqrt(1 - r * r);
    if (x > 28 && y > 30)
        return x > 36 && y > 38 ? 0.7 : 1;
    return 3 + 0.04 * y;
}

typedef enum filter { CENTRE, BOX, SOFT } filter;

/* Depth as a renderer writes it: at the centre, over the pixel, or over 3 px by Blackman-Harris. */
static wo_image depth_image(depth_at *depth, const void *what, filter how, wo_rect area)
{
    wo_image out = picture_make(area, 1);
    for (int32_t y = area.y1; y < area.y2; y++)
        for (int32_t x = area.x1; x < area.x2; x++) {
            double sum = 0;
            double all = 0;
            for (int i = 0; how != CENTRE && i < FINE * FINE; i++) {
                const double size = how == SOFT ? 3 : 1;
                const double ox = (i % FINE + 0.5) / FINE - 0.5;
                const double oy = ((double)(i / FINE) + 0.5) / FINE - 0.5;
                double weight = 1;
                for (int k = 0; how == SOFT && k < 2; k++) {
                    const double t = 2 * 3.14159265358979323846 * ((k ? oy : ox) + 0.5);
                    weight *=
                        0.35875 - 0.48829 * cos(t) + 0.14128 * cos(2 * t) - 0.01168 * cos(3 * t);
                }
                sum += weight * depth(what, x + 0.5 + size * ox, y + 0.5 + size * oy);
                all += weight;
            }
            *wo_image_at(&out, x, y) = (float)(all > 0 ? sum / all : depth(what, x + 0.5, y + 0.5));
        }
    return out;
}

/* Loads and repairs; *before gets the vergences as loaded. */
static wo_sheet repaired(const wo_image *depth, wo_rect area, float *before, int64_t *count)
{
    wo_sheet sheet;
    wo_sheet_counts counts = {0};
    wo_image colour = picture_make(depth->bounds, 4);
    picture_fill(&colour, (const float[4]){0.5f, 0.5f, 0.5f, 1});
    const wo_sheet_source source = {.colour = &colour,
                                    .depth = depth,
                                    .reading = {WO_DEPTH_DISTANCE, 1, 0.1, 100},
                                    .extent = depth->bounds,
                                    .format = depth->bounds,
                                    .focal_px = 1000,
                                    .stretch = 1,
                                    .v_origin = 0.4,
                                    .v_min = -10,
                                    .v_max = 10};
    const size_t n = (size_t)wo_rect_width(area) * (size_t)wo_rect_height(area);
    assert_int_equal(wo_sheet_create(&plain, area, &sheet, NULL), WO_OK);
    assert_int_equal(wo_sheet_load(&plain, &source, area, &sheet, &counts, NULL), WO_OK);
    if (before)
        memcpy(before, sheet.v, n * sizeof *before);
    wo_image mix = picture_make(area, 1);
    *count = 0;
    assert_int_equal(
        wo_sheet_repair_depth(&plain, &source, PX, area, &sheet, mix.data, count, NULL), WO_OK);
    int64_t marked = 0;
    for (size_t i = 0; i < n; i++) {
        marked += !isnan(mix.data[i]);
        assert_true(isnan(mix.data[i]) || (mix.data[i] >= 0 && mix.data[i] <= 1));
    }
    assert_true(marked <= *count);
    picture_free(&colour);
    picture_free(&mix);
    return sheet;
}

/* How many pixels inside belong to neither surface. */
static int in_between(const wo_sheet *sheet, double near, double far)
{
    int found = 0;
    for (int32_t y = 6; y < SIDE - 6; y++)
        for (int32_t x = 6; x < SIDE - 6; x++) {
            const double v = (double)sheet->v[y * SIDE + x] + 0.4;
            found += fmin(fabs(v - near), fabs(v - far)) * PX > 0.5;
        }
    return found;
}

static void edges_become_hard(void **state)
{
    (void)state;
    const double far[] = {4, 30, 1e10};
    for (filter how = BOX; how <= SOFT; how++) {
        for (int turn = 0; turn < 24; turn++) {
            const edge e = {0.29 * turn, 0.17 * turn - 1.6, 0.8 + 0.05 * turn, far[turn % 3],
                            turn % 2 ? 0 : 3 + 0.2 * turn};
            wo_image depth = depth_image(edge_depth, &e, how, square);
            float before[SIDE * SIDE];
            int64_t count;
            wo_sheet sheet = repaired(&depth, square, before, &count);
            assert_true(count > SIDE / 4);
            const int left = in_between(&sheet, 1 / e.near, 1 / e.far);
            assert_int_equal(left, 0);
            /* On the side that has the larger part. */
            int wrong = 0;
            for (int32_t i = 0; i < SIDE * SIDE; i++) {
                const bool near = edge_depth(&e, i % SIDE + 0.5, i / SIDE + 0.5) == e.near;
                const bool is_near = ((double)sheet.v[i] + 0.4) * 2 > 1 / e.near + 1 / e.far;
                const bool border =
                    i % SIDE < 2 || i % SIDE >= SIDE - 2 || i / SIDE < 2 || i / SIDE >= SIDE - 2;
                wrong += near != is_near && !border;
            }
            assert_at_most(wrong, SIDE / 5);
            wo_sheet_destroy(&plain, &sheet);
            picture_free(&depth);
        }
    }
}

static void what_is_no_mixture_stays(void **state)
{
    (void)state;
    float before[SIDE * SIDE];
    int64_t count;
    wo_image depth = depth_image(solid_depth, NULL, CENTRE, square);
    wo_sheet sheet = repaired(&depth, square, before, &count);
    for (int i = 0; i < SIDE * SIDE; i++) {
        /* Beside the ball's outline its slope may go flat, and a little of what is behind. */
        const double r = hypot(i % SIDE + 0.5 - 15, i / SIDE + 0.5 - 17);
        const double changed = PX * ((double)sheet.v[i] - (double)before[i]);
        if (r < 5 || (r > 16 && i / SIDE < 30))
            assert_true(changed == 0);
        else
            assert_near(changed, 0, r < 11 ? 2.4 : 0.3);
    }
    wo_sheet_destroy(&plain, &sheet);
    picture_free(&depth);
    /* Steps and wires of depth at pixel centres: to the byte. */
    for (int turn = 0; turn < 12; turn++) {
        const edge e = {0.53 * turn, 0.3 * turn - 2, 0.9, 5, turn % 3 ? 0 : 0.7 + 0.1 * turn};
        depth = depth_image(edge_depth, &e, CENTRE, square);
        sheet = repaired(&depth, square, before, &count);
        assert_int_equal(count, 0);
        assert_memory_equal(sheet.v, before, sizeof before);
        wo_sheet_destroy(&plain, &sheet);
        picture_free(&depth);
    }
    /* A steep slope, to the corners of the picture. */
    depth = picture_make(square, 1);
    for (int32_t i = 0; i < SIDE * SIDE; i++)
        depth.data[i] = 1 / (0.95f - 0.015f * (float)(i % SIDE));
    sheet = repaired(&depth, square, before, &count);
    assert_int_equal(count, 0);
    wo_sheet_destroy(&plain, &sheet);
    picture_free(&depth);
    /* A step that no eye sees. */
    const edge small = {0.4, 0, 4, 4.4, 0};
    depth = depth_image(edge_depth, &small, SOFT, square);
    sheet = repaired(&depth, square, before, &count);
    assert_int_equal(count, 0);
    wo_sheet_destroy(&plain, &sheet);
    picture_free(&depth);
}

/* What lies beyond the margin changes nothing. */
static void the_margin_is_enough(void **state)
{
    (void)state;
    const wo_rect wide = {-40, -40, 40, 40};
    const wo_rect part = {-28, -30, 29, 31};
    wo_image depth = picture_make(wide, 1);
    rng r = {5};
    /* Smoothed noise: mixtures everywhere. */
    for (int32_t i = 0; i < 80 * 80; i++)
        depth.data[i] = (float)exp(rng_range(&r, -1, 2));
    int64_t count;
    int64_t in_part;
    wo_sheet all = repaired(&depth, wide, NULL, &count);
    wo_sheet some = repaired(&depth, part, NULL, &in_part);
    assert_true(count > 500 && in_part > 200 && in_part < count);
    const wo_rect inner = wo_rect_grow(part, -WO_SHEET_REPAIR_MARGIN, -WO_SHEET_REPAIR_MARGIN);
    for (int32_t y = inner.y1; y < inner.y2; y++)
        for (int32_t x = inner.x1; x < inner.x2; x++) {
            const float a = all.v[(y + 40) * 80 + x + 40];
            const float b = some.v[(y + 30) * 57 + x + 28];
            assert_memory_equal(&a, &b, sizeof a);
        }
    wo_sheet_destroy(&plain, &all);
    wo_sheet_destroy(&plain, &some);
    picture_free(&depth);
}

static void odd_depths(void **state)
{
    (void)state;
    const float odd[] = {NAN, INFINITY, -INFINITY, 0, -3, 1e-30f, 1e30f, 1, 2};
    rng r = {11};
    wo_image depth = picture_make(square, 1);
    for (int i = 0; i < SIDE * SIDE; i++)
        depth.data[i] = odd[rng_int(&r, 0, (int32_t)WO_COUNT(odd) - 1)];
    int64_t count;
    wo_sheet sheet = repaired(&depth, square, NULL, &count);
    for (int i = 0; i < SIDE * SIDE; i++)
        assert_true(isfinite(sheet.v[i]));
    wo_sheet_destroy(&plain, &sheet);
    const wo_rect one = {3, 3, 4, 4};
    sheet = repaired(&depth, one, NULL, &count);
    assert_int_equal(count, 0);
    wo_sheet_destroy(&plain, &sheet);
    picture_free(&depth);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_become_hard),
        cmocka_unit_test(what_is_no_mixture_stays),
        cmocka_unit_test(the_margin_is_enough),
        cmocka_unit_test(odd_depths),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
