/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/sheet.h"

#include "near.h"
#include "scenes.h"

#include <string.h>

static const wo_context plain = WO_CONTEXT_INIT;

static wo_sheet_source source_of(const wo_image *colour, const wo_image *depth)
{
    return (wo_sheet_source){.colour = colour,
                             .depth = depth,
                             .reading = {WO_DEPTH_DISTANCE, 1, 0.1, 100},
                             .extent = colour->bounds,
                             .format = colour->bounds,
                             .focal_px = 100,
                             .stretch = 1,
                             .v_min = -10,
                             .v_max = 10};
}

static wo_sheet load(const wo_sheet_source *source, wo_rect area, wo_rect counted,
                     wo_sheet_counts *counts)
{
    wo_sheet sheet;
    wo_error error = {WO_OK, ""};
    assert_int_equal(wo_sheet_create(&plain, area, &sheet, &error), WO_OK);
    assert_int_equal(wo_sheet_load(&plain, source, counted, &sheet, counts, &error), WO_OK);
    return sheet;
}

static size_t at(const wo_sheet *sheet, int32_t x, int32_t y)
{
    return (size_t)(y - sheet->area.y1) * (size_t)wo_rect_width(sheet->area) +
           (size_t)(x - sheet->area.x1);
}

static void assert_colour(const float c[4], float r, float g, float b, float a)
{
    const float want[4] = {r, g, b, a};
    for (int k = 0; k < 4; k++)
        assert_near((double)c[k], (double)want[k], 1e-7);
}

static int read_pixel(const float *pixel, int32_t components, wo_alpha alpha, float c[4])
{
    wo_image one = picture_make((wo_rect){0, 0, 1, 1}, components);
    picture_fill(&one, pixel);
    const int sanitised = wo_read_colour(&one, alpha, 0, 0, c);
    picture_free(&one);
    return sanitised;
}

static void colours_and_alphas(void **state)
{
    (void)state;
    float c[4];
    const float half[4] = {0.2f, 0.4f, -0.6f, 0.5f};
    assert_int_equal(read_pixel(half, 4, WO_ALPHA_PREMULTIPLIED, c), 0);
    assert_colour(c, 0.2f, 0.4f, -0.6f, 0.5f);
    assert_int_equal(read_pixel(half, 4, WO_ALPHA_UNPREMULTIPLIED, c), 0);
    assert_colour(c, 0.1f, 0.2f, -0.3f, 0.5f);
    assert_int_equal(read_pixel(half, 4, WO_ALPHA_OPAQUE, c), 0);
    assert_colour(c, 0.2f, 0.4f, -0.6f, 1);
    assert_int_equal(read_pixel(half, 3, WO_ALPHA_UNPREMULTIPLIED, c), 0);
    assert_colour(c, 0.2f, 0.4f, -0.6f, 1);
    assert_int_equal(read_pixel(half, 1, WO_ALPHA_PREMULTIPLIED, c), 0);
    assert_colour(c, 0.2f, 0.2f, 0.2f, 1);
    /* Coverage outside 0..1. */
    const float more[4] = {1, 2, 3, 1.5f};
    assert_int_equal(read_pixel(more, 4, WO_ALPHA_PREMULTIPLIED, c), 0);
    assert_colour(c, 1, 2, 3, 1);
    const float less[4] = {1, 2, 3, -1};
    assert_int_equal(read_pixel(less, 4, WO_ALPHA_UNPREMULTIPLIED, c), 0);
    assert_colour(c, 0, 0, 0, 0);
}

static void what_is_no_number_becomes_zero(void **state)
{
    (void)state;
    float c[4];
    const float bad[4] = {NAN, INFINITY, 3, 0.5f};
    assert_int_equal(read_pixel(bad, 4, WO_ALPHA_PREMULTIPLIED, c), 2);
    assert_colour(c, 0, 0, 3, 0.5f);
    const float bad_alpha[4] = {1, 1, -INFINITY, NAN};
    assert_int_equal(read_pixel(bad_alpha, 4, WO_ALPHA_UNPREMULTIPLIED, c), 2);
    assert_colour(c, 0, 0, 0, 0);
    /* An alpha that is not read is not counted. */
    assert_int_equal(read_pixel(bad_alpha, 4, WO_ALPHA_OPAQUE, c), 1);
    assert_colour(c, 1, 1, 0, 1);
    /* Finite, but so large that sums of it would not be. */
    const float huge[4] = {3e38f, -3e38f, 1, 1};
    assert_int_equal(read_pixel(huge, 4, WO_ALPHA_PREMULTIPLIED, c), 2);
    assert_true(c[0] > 1e29f && c[0] * 1e6f < INFINITY);
    assert_true(c[1] < -1e29f && c[1] * 1e6f > -INFINITY);
}

static void depths(void **state)
{
    (void)state;
    const wo_rect r = {-2, 3, 4, 7};
    wo_image colour = picture_make(r, 4);
    wo_image depth = picture_make(r, 4);
    picture_fill(&colour, (const float[4]){1, 1, 1, 1});
    picture_fill(&depth, (const float[4]){2, 4, 8, 0.05f});
    wo_sheet_counts counts = {0};
    wo_sheet_source source = source_of(&colour, &depth);
    source.v_origin = 0.1;
    const double want[] = {0.4, 0.15, 0.025, 10};
    for (int channel = 0; channel < 4; channel++) {
        source.depth_channel = channel;
        wo_sheet sheet = load(&source, r, r, &counts);
        assert_true(sheet.any);
        for (size_t i = 0; i < 24; i++)
            assert_near((double)sheet.v[i], want[channel], 1e-7);
        wo_sheet_destroy(&plain, &sheet);
        assert_null(sheet.v);
    }
    assert_int_equal(counts.clamped_radius, 24);
    assert_int_equal(counts.sanitised_depth, 0);
    /* A single channel whatever is asked for; no depth at all is infinitely far. */
    wo_image single = picture_make(r, 1);
    picture_fill(&single, (const float[1]){5});
    source.depth = &single;
    wo_sheet sheet = load(&source, r, r, &counts);
    assert_near((double)sheet.v[7], 0.1, 1e-7);
    wo_sheet_destroy(&plain, &sheet);
    const wo_image nothing = {0};
    for (int i = 0; i < 2; i++) {
        source.depth = i ? &nothing : NULL;
        sheet = load(&source, r, r, &counts);
        assert_near((double)sheet.v[7], -0.1, 1e-7);
        wo_sheet_destroy(&plain, &sheet);
    }
    assert_int_equal(counts.sanitised_depth, 0);
    picture_free(&colour);
    picture_free(&depth);
    picture_free(&single);
}

static void distance_from_the_camera(void **state)
{
    (void)state;
    const wo_rect r = {0, 0, 5, 3};
    wo_image colour = picture_make(r, 3);
    wo_image depth = picture_make(r, 1);
    picture_fill(&colour, (const float[3]){1, 1, 1});
    picture_fill(&depth, (const float[1]){4});
    wo_sheet_counts counts = {0};
    wo_sheet_source source = source_of(&colour, &depth);
    source.reading.mode = WO_DEPTH_RAY;
    source.focal_px = 2;
    source.stretch = 0.5;
    wo_sheet sheet = load(&source, r, r, &counts);
    /* The axis goes through (2.5, 1.5), the middle of pixel (2, 1). */
    assert_near((double)sheet.v[at(&sheet, 2, 1)], 0.25, 1e-7);
    assert_near((double)sheet.v[at(&sheet, 4, 1)], sqrt(1 + 1) / 4, 1e-7);
    assert_near((double)sheet.v[at(&sheet, 2, 2)], sqrt(1 + 1) / 4, 1e-7);
    assert_near((double)sheet.v[at(&sheet, 0, 0)], sqrt(1 + 1 + 1) / 4, 1e-7);
    wo_sheet_destroy(&plain, &sheet);
    picture_free(&colour);
    picture_free(&depth);
}

static void empty_pixels_and_counts(void **state)
{
    (void)state;
    const wo_rect r = {0, 0, 4, 4};
    wo_image colour = picture_make(r, 4);
    wo_image depth = picture_make(r, 1);
    const float depths_of[4] = {NAN, -1, 0, INFINITY};
    for (int32_t y = 0; y < 4; y++)
        for (int32_t x = 0; x < 4; x++) {
            *wo_image_at(&depth, x, y) = depths_of[x];
            float *c = wo_image_at(&colour, x, y);
            c[0] = y == 1 ? NAN : y == 3 ? 0 : 1;
            c[3] = y == 2 || y == 3 ? 0 : 1; /* row 2: light without coverage; row 3: nothing */
        }
    wo_sheet_counts counts = {0};
    const wo_sheet_source source = source_of(&colour, &depth);
    wo_sheet sheet = load(&source, r, r, &counts);
    for (int32_t x = 0; x < 4; x++) {
        assert_near((double)sheet.v[at(&sheet, x, 0)], 0, 0);
        assert_near((double)sheet.v[at(&sheet, x, 1)], 0, 0);
        assert_near((double)sheet.v[at(&sheet, x, 2)], 0, 0);
        assert_true(isnan(sheet.v[at(&sheet, x, 3)]));
    }
    /* Empty pixels need no depth; the others were all bad. */
    assert_int_equal(counts.sanitised_depth, 12);
    assert_int_equal(counts.sanitised_colour, 4);
    wo_sheet_destroy(&plain, &sheet);
    /* Only what lies inside the window is counted. */
    counts = (wo_sheet_counts){0};
    sheet = load(&source, r, (wo_rect){1, 1, 3, 4}, &counts);
    assert_int_equal(counts.sanitised_depth, 4);
    assert_int_equal(counts.sanitised_colour, 2);
    wo_sheet_destroy(&plain, &sheet);
    /* A layer of nothing says so. */
    picture_fill(&colour, (const float[4]){0, 0, 0, 0});
    sheet = load(&source, r, r, &counts);
    assert_false(sheet.any);
    wo_sheet_destroy(&plain, &sheet);
    picture_free(&colour);
    picture_free(&depth);
}

static void edges_take_the_depth_beside_them(void **state)
{
    (void)state;
    const wo_rect r = {0, 0, 12, 5};
    wo_image colour = picture_make(r, 4);
    wo_image depth = picture_make(r, 1);
    /* Columns: 0..2 a surface at 2 m, 3 and 4 its antialiased rim without depth, 5..6 empty, 7 a
       rim pixel too far from any depth but 9's; 9..11 covered, at 1 m only in 10 and 11. */
    const float coverage[12] = {1, 1, 1, 0.6f, 0.2f, 0, 0, 0.5f, 0, 1, 1, 1};
    const float metres[12] = {2, 2, 2, 0, INFINITY, 0, 0, NAN, 0, -1, 1, 1};
    for (int32_t y = 0; y < 5; y++)
        for (int32_t x = 0; x < 12; x++) {
            float *c = wo_image_at(&colour, x, y);
            c[0] = c[1] = c[2] = c[3] = coverage[x];
            *wo_image_at(&depth, x, y) = metres[x];
        }
    *wo_image_at(&depth, 2, 2) = 1.25f; /* nearest of the neighbours */
    wo_sheet_counts counts = {0};
    const wo_sheet_source source = source_of(&colour, &depth);
    wo_sheet sheet = load(&source, r, r, &counts);
    assert_near((double)sheet.v[at(&sheet, 3, 0)], 0.5, 1e-7);
    assert_near((double)sheet.v[at(&sheet, 3, 1)], 0.8, 1e-7);
    assert_near((double)sheet.v[at(&sheet, 3, 3)], 0.8, 1e-7);
    assert_near((double)sheet.v[at(&sheet, 3, 4)], 0.5, 1e-7);
    /* Two away: found in the second ring, by its own depth, not by what column 3 was given. */
    for (int32_t y = 0; y < 5; y++)
        assert_near((double)sheet.v[at(&sheet, 4, y)], 0.8, 1e-7);
    for (int32_t y = 0; y < 5; y++) {
        assert_true(isnan(sheet.v[at(&sheet, 5, y)]));
        /* Nothing with a depth within reach; fully covered pixels are far away for real. */
        assert_near((double)sheet.v[at(&sheet, 7, y)], 0, 0);
        assert_near((double)sheet.v[at(&sheet, 9, y)], 0, 0);
    }
    assert_int_equal(counts.edge_depth, 10);
    assert_int_equal(counts.sanitised_depth, 20);
    wo_sheet_destroy(&plain, &sheet);
    picture_free(&colour);
    picture_free(&depth);
}

static void beyond_the_bounds(void **state)
{
    (void)state;
    wo_image colour = picture_make((wo_rect){2, 2, 4, 3}, 4);
    wo_image depth = picture_make((wo_rect){3, 0, 4, 5}, 1);
    for (int32_t x = 2; x < 4; x++) {
        float *c = wo_image_at(&colour, x, 2);
        c[0] = (float)x;
        c[3] = 1;
    }
    for (int32_t y = 0; y < 5; y++)
        *wo_image_at(&depth, 3, y) = (float)(y + 1);
    wo_sheet_counts counts = {0};
    wo_sheet_source source = source_of(&colour, &depth);
    source.extent = (wo_rect){-1, -1, 7, 7};
    wo_sheet sheet = load(&source, source.extent, source.extent, &counts);
    for (int32_t y = -1; y < 7; y++)
        for (int32_t x = -1; x < 7; x++) {
            assert_near((double)sheet.c[at(&sheet, x, y)][0], x < 3 ? 2 : 3, 0);
            const double z = y < 0 ? 1 : y > 4 ? 5 : y + 1;
            assert_near((double)sheet.v[at(&sheet, x, y)], 1 / z, 1e-7);
        }
    wo_sheet_destroy(&plain, &sheet);
    picture_free(&colour);
    picture_free(&depth);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colours_and_alphas),
        cmocka_unit_test(what_is_no_number_becomes_zero),
        cmocka_unit_test(depths),
        cmocka_unit_test(distance_from_the_camera),
        cmocka_unit_test(empty_pixels_and_counts),
        cmocka_unit_test(edges_take_the_depth_beside_them),
        cmocka_unit_test(beyond_the_bounds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
