/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "picture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static wo_error fault;

#define assert_ok(call)                                                                            \
    do {                                                                                           \
        if ((call) != WO_OK)                                                                       \
            fail_msg("%s", fault.text);                                                            \
    } while (0)

#define assert_fault(call, expected, words)                                                        \
    do {                                                                                           \
        fault.text[0] = '\0';                                                                      \
        const wo_status got = (call);                                                              \
        if (got != (expected) || !strstr(fault.text, words))                                       \
            fail_msg("%s, \"%s\" instead of %s, \"%s\"", wo_status_text(got), fault.text,          \
                     wo_status_text(expected), words);                                             \
    } while (0)

static void assert_near(double value, double wanted, double tolerance)
{
    if (!(fabs(value - wanted) <= tolerance))
        fail_msg("%.17g instead of %.17g", value, wanted);
}

/* A picture with a margin round it, so that row_bytes is not tight; upside down if asked. */
typedef struct canvas {
    float *memory;
    wo_image image;
} canvas;

static canvas make_canvas(int width, int height, int components, bool upside_down)
{
    canvas c = {0};
    const size_t row = (size_t)(width + 3) * (size_t)components;
    c.memory = calloc(row * (size_t)height, sizeof *c.memory);
    assert_non_null(c.memory);
    c.image = (wo_image){.data = c.memory,
                         .bounds = {-5, 7, -5 + width, 7 + height},
                         .row_bytes = (ptrdiff_t)(row * sizeof(float)),
                         .components = components};
    if (upside_down) {
        c.image.data = c.memory + row * (size_t)(height - 1);
        c.image.row_bytes = -c.image.row_bytes;
    }
    return c;
}

static float *pixel(const canvas *c, int x, int row_from_top)
{
    return wo_image_at(&c->image, c->image.bounds.x1 + x, c->image.bounds.y2 - 1 - row_from_top);
}

/* The pictures whose errors are known: exact in floats, made the same way elsewhere. */
static void fill_pair(const canvas *ref, const canvas *out, bool lamps)
{
    const int width = wo_rect_width(ref->image.bounds), height = wo_rect_height(ref->image.bounds);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            for (int c = 0; c < 3; c++) {
                double r = (x * 7 + y * 13 + c * 5 + x * y) % 64 / 64.0 + (x / 8 + y / 6) % 3 / 4.0;
                if (lamps && (x * 5 + y * 3) % 97 == 0)
                    r = 2000;
                pixel(ref, x, y)[c] = (float)r;
                pixel(out, x, y)[c] =
                    (float)(r + ((x * 11 + y * 3 + c * 29 + x * x) % 9 - 3) / 64.0);
            }
}

/* Expected numbers come from numpy and OpenCV's Python module. */
static void known_errors(void **state)
{
    (void)state;
    static const struct {
        int width, height;
        bool lamps;
        int crop;
        double wanted[6];
    } cases[] = {
        {64,
         48,
         false,
         0,
         {0.011766346339436188, 28.700651958214735, 30.011725984816326, 0.98946711232126905,
          0.078125, 1.020979020979021}},
        {64,
         48,
         true,
         0,
         {0.011673310603357414, 28.740326351453838, 30.036290192344488, 0.9895581726908631,
          0.078125, 1.0007469143586829}},
        {64,
         48,
         true,
         5,
         {0.011919921791778171, 28.701924156399222, 30.100083091384484, 0.99024874705635602,
          0.078125, 1.0007369048559589}},
        {7,
         5,
         false,
         0,
         {0.028677029651031777, 27.59647649173251, 28.255528880399666, 0.98609690900436631,
          0.078125, 1.0317460317460319}},
        {1,
         1,
         false,
         0,
         {0.080660492360121142, 37.884512070234557, 33.19583550344808, 0.99597209863756575,
          0.046875, 0.80000000000000004}},
        {333,
         1,
         true,
         0,
         {0.014615264746161262, 28.205155205265964, 29.638709131556912, 0.98479896577243742,
          0.078125, 1.0006311731290833}},
        {200,
         150,
         true,
         0,
         {0.01194474126932896, 28.741433168236739, 29.892705281718715, 0.98911574228722954,
          0.078125, 1.0007322199424691}},
    };
    for (size_t i = 0; i < WO_COUNT(cases); i++)
        for (int variant = 0; variant < 4; variant++) {
            canvas ref = make_canvas(cases[i].width, cases[i].height, 3 + (variant & 1), false);
            canvas out = make_canvas(cases[i].width, cases[i].height, 4, variant & 2);
            fill_pair(&ref, &out, cases[i].lamps);
            wo_picture_error e;
            assert_ok(wo_picture_compare(&ref.image, &out.image, cases[i].crop, &e, &fault));
            const double got[6] = {e.relmse, e.psnr_lin, e.psnr, e.ssim, e.max_error, e.energy};
            for (int k = 0; k < 6; k++)
                assert_near(got[k], cases[i].wanted[k], 1e-10 * fabs(cases[i].wanted[k]));
            assert_int_equal(e.nonfinite, 0);
            assert_int_equal(e.width, cases[i].width - 2 * cases[i].crop);
            free(ref.memory);
            free(out.memory);
        }
}

static void equal_pictures(void **state)
{
    (void)state;
    canvas ref = make_canvas(40, 30, 3, false), out = make_canvas(40, 30, 3, false);
    fill_pair(&ref, &out, true);
    wo_picture_error e;
    char text[512];
    assert_ok(wo_picture_compare(&ref.image, &ref.image, 0, &e, &fault));
    assert_near(e.relmse, 0, 0);
    assert_true(isinf(e.psnr) && e.psnr > 0);
    assert_true(isinf(e.psnr_lin));
    assert_near(e.ssim, 1, 1e-12);
    assert_near(e.energy, 1, 0);
    wo_picture_json(&e, text, sizeof text);
    assert_string_equal(text, "{\"width\": 40, \"height\": 30, \"relmse\": 0, \"psnr_lin\": null, "
                              "\"psnr\": null, \"ssim\": 1, \"max_error\": 0, \"energy\": 1, "
                              "\"nonfinite\": 0}");
    free(ref.memory);
    free(out.memory);
}

static void grey_counts_as_three(void **state)
{
    (void)state;
    canvas grey = make_canvas(20, 20, 1, false), colour = make_canvas(20, 20, 3, false);
    canvas out = make_canvas(20, 20, 3, false);
    for (int y = 0; y < 20; y++)
        for (int x = 0; x < 20; x++)
            for (int c = 0; c < 3; c++) {
                pixel(&grey, x, y)[0] = pixel(&colour, x, y)[c] = (float)(x * y) / 400;
                pixel(&out, x, y)[c] = (float)(x * y + c) / 410;
            }
    wo_picture_error one, three;
    assert_ok(wo_picture_compare(&grey.image, &out.image, 0, &one, &fault));
    assert_ok(wo_picture_compare(&colour.image, &out.image, 0, &three, &fault));
    assert_memory_equal(&one, &three, sizeof one);
    free(grey.memory);
    free(colour.memory);
    free(out.memory);
}

static void broken_samples_are_counted(void **state)
{
    (void)state;
    canvas ref = make_canvas(40, 30, 4, false), out = make_canvas(40, 30, 4, true);
    fill_pair(&ref, &out, false);
    wo_picture_error e;
    char text[512];
    pixel(&out, 3, 4)[0] = NAN;
    pixel(&out, 3, 5)[2] = INFINITY;
    pixel(&out, 39, 29)[1] = -INFINITY;
    pixel(&out, 8, 8)[3] = NAN; /* alpha does not count */
    assert_ok(wo_picture_compare(&ref.image, &out.image, 0, &e, &fault));
    assert_int_equal(e.nonfinite, 3);
    assert_near(e.relmse, 0, 0);
    assert_near(e.ssim, 0, 0);
    wo_picture_json(&e, text, sizeof text);
    assert_string_equal(text, "{\"width\": 40, \"height\": 30, \"nonfinite\": 3}");
    assert_ok(wo_picture_compare(&ref.image, &out.image, 3, &e, &fault));
    assert_int_equal(e.nonfinite, 2);
    pixel(&ref, 0, 0)[0] = NAN;
    assert_fault(wo_picture_compare(&ref.image, &out.image, 0, &e, &fault), WO_ERR_FORMAT,
                 "1 samples of the reference");
    free(ref.memory);
    free(out.memory);
}

static void bad_pairs(void **state)
{
    (void)state;
    canvas a = make_canvas(40, 30, 3, false), b = make_canvas(40, 31, 3, false);
    wo_picture_error e;
    wo_image none = {0};
    assert_fault(wo_picture_compare(&a.image, &b.image, 0, &e, &fault), WO_ERR_ARGUMENT,
                 "40 x 30 and 40 x 31");
    assert_fault(wo_picture_compare(&a.image, &a.image, 15, &e, &fault), WO_ERR_RANGE, "border");
    assert_fault(wo_picture_compare(&a.image, &a.image, -1, &e, &fault), WO_ERR_RANGE, "border");
    assert_fault(wo_picture_compare(&a.image, &a.image, INT32_MAX, &e, &fault), WO_ERR_RANGE,
                 "border");
    assert_fault(wo_picture_compare(&none, &a.image, 0, &e, &fault), WO_ERR_ARGUMENT, "missing");
    assert_fault(wo_picture_compare(&a.image, &none, 0, &e, &fault), WO_ERR_ARGUMENT, "missing");
    assert_int_equal(wo_picture_compare(&a.image, &b.image, 0, &e, NULL), WO_ERR_ARGUMENT);
    /* nothing but black: no energy to compare */
    assert_ok(wo_picture_compare(&a.image, &a.image, 0, &e, &fault));
    assert_true(isnan(e.energy));
    free(a.memory);
    free(b.memory);
}

static void sizes_change(void **state)
{
    (void)state;
    canvas a = make_canvas(40, 30, 3, true);
    wo_image small, large;
    for (int y = 0; y < 30; y++)
        for (int x = 0; x < 40; x++)
            for (int c = 0; c < 3; c++)
                pixel(&a, x, y)[c] = (float)(x + 100 * y);
    assert_ok(wo_picture_resize(&a.image, 20, 15, &small, &fault));
    assert_int_equal(wo_rect_width(small.bounds), 20);
    assert_int_equal(wo_rect_height(small.bounds), 15);
    for (int y = 0; y < 15; y++)
        for (int x = 0; x < 20; x++) /* the mean of four; row 0 of small is the bottom */
            assert_near((double)wo_image_at(&small, x, y)[1],
                        2 * x + 0.5 + 100 * (2 * (14 - y) + 0.5), 1e-3);
    assert_ok(wo_picture_resize(&a.image, 80, 60, &large, &fault));
    assert_near((double)wo_image_at(&large, 41, 30)[0], 20.25 + 100 * 14.25, 0.01);
    free(small.data);
    free(large.data);
    assert_fault(wo_picture_resize(&a.image, 0, 5, &small, &fault), WO_ERR_RANGE, "0 x 5");
    assert_null(small.data);
    assert_fault(wo_picture_resize(&a.image, 5, 70000, &small, &fault), WO_ERR_RANGE, "70000");
    free(a.memory);
}

static void the_srgb_curve(void **state)
{
    (void)state;
    static const double given[] = {-1, 0, 0.001, 0.0031308, 0.21404114, 0.5, 1, 7};
    static const double wanted[] = {0, 0, 0.01292, 0.040449936, 0.5, 0.735356983, 1, 1};
    canvas a = make_canvas(8, 1, 4, false);
    for (int x = 0; x < 8; x++)
        for (int c = 0; c < 4; c++)
            pixel(&a, x, 0)[c] = (float)given[x];
    wo_picture_encode(&a.image);
    for (int x = 0; x < 8; x++) {
        for (int c = 0; c < 3; c++)
            assert_near((double)pixel(&a, x, 0)[c], wanted[x], 1e-6);
        assert_near((double)pixel(&a, x, 0)[3], given[x], 1e-6);
    }
    pixel(&a, 2, 0)[1] = NAN;
    wo_picture_encode(&a.image);
    assert_near((double)pixel(&a, 2, 0)[0], 1, 0);
    assert_near((double)pixel(&a, 2, 0)[1], 0, 0);
    assert_near((double)pixel(&a, 2, 0)[2], 1, 0);
    free(a.memory);
}

/* Brightness of a pixel of a result, from the top left. */
static double level(const wo_image *image, int x, int row_from_top)
{
    const float *const p = wo_image_at(image, x, image->bounds.y2 - 1 - row_from_top);
    return (double)(p[0] + p[1] + p[2]) / 3;
}

static void differences_are_shown(void **state)
{
    (void)state;
    canvas ref = make_canvas(300, 200, 3, false), out = make_canvas(300, 200, 3, true);
    wo_image map;
    for (int y = 0; y < 200; y++)
        for (int x = 0; x < 300; x++)
            for (int c = 0; c < 3; c++) {
                pixel(&ref, x, y)[c] = 0.5f;
                pixel(&out, x, y)[c] = x < 100 ? 0.5f : x < 200 ? 0.4f : 0.6f;
            }
    pixel(&out, 50, 20)[0] = NAN;
    assert_ok(wo_picture_show_difference(&ref.image, &out.image, WO_DIFFERENCE_MAGNITUDE, 0.1, &map,
                                         &fault));
    assert_int_equal(wo_rect_width(map.bounds), 300);
    assert_true(wo_rect_height(map.bounds) > 200);
    assert_int_equal(map.components, 3);
    assert_near(level(&map, 10, 10), 0, 0.01);
    assert_true(level(&map, 150, 10) > 0.3);
    const float *broken = wo_image_at(&map, 50, map.bounds.y2 - 21);
    assert_true(broken[0] == 1 && broken[1] == 0 && broken[2] == 1);
    free(map.data);

    assert_ok(
        wo_picture_show_difference(&ref.image, &out.image, WO_DIFFERENCE_SIGNED, 0, &map, &fault));
    const float *darker = wo_image_at(&map, 150, map.bounds.y2 - 11);
    assert_true(darker[2] > darker[0] + 0.2f);
    const float *brighter = wo_image_at(&map, 250, map.bounds.y2 - 11);
    assert_true(brighter[0] > brighter[2] + 0.2f);
    free(map.data);
    assert_fault(
        wo_picture_show_difference(&ref.image, &out.image, WO_DIFFERENCE_SIGNED, NAN, &map, &fault),
        WO_ERR_RANGE, "limit");
    free(ref.memory);
    free(out.memory);
}

/* Number of pixels of a window of rows that are brighter than the paper by far: letters. */
static int letters_in(const wo_image *sheet, int from_row, int to_row)
{
    int count = 0;
    for (int row = from_row; row < to_row; row++)
        for (int x = 0; x < wo_rect_width(sheet->bounds); x++)
            count += level(sheet, x, row) > 0.5;
    return count;
}

static void sheets(void **state)
{
    (void)state;
    canvas red = make_canvas(64, 36, 3, false), tall = make_canvas(20, 80, 1, true);
    for (int y = 0; y < 36; y++)
        for (int x = 0; x < 64; x++) {
            pixel(&red, x, y)[0] = 0.21404114f;
            pixel(&red, x, y)[1] = y < 18 ? 1.0f : 0.0f;
        }
    for (int y = 0; y < 80; y++)
        for (int x = 0; x < 20; x++)
            pixel(&tall, x, y)[0] = 0.25f;
    const wo_picture_cell cells[3] = {
        {.image = &red.image, .linear = true, .caption = {"red below", "second line"}},
        {.image = &tall.image, .caption = {"tall", NULL}},
        {.image = NULL,
         .caption = {"nothing", "a line that is much too long for its cell, "
                                "and so it is cut short somewhere"}}};
    const wo_picture_layout layout = {
        .title = "Title", .subtitle = "and more", .columns = 2, .cell_width = 160};
    wo_image sheet;
    assert_ok(wo_picture_sheet(&layout, cells, 3, &sheet, &fault));
    /* letter 9, gap 9, caption 36, head 45, cells 160 x 90 */
    assert_int_equal(wo_rect_width(sheet.bounds), 2 * 169 + 9);
    assert_int_equal(wo_rect_height(sheet.bounds), 45 + 2 * 135 + 9);
    assert_int_equal(sheet.components, 3);
    const float *const below = wo_image_at(&sheet, 9 + 80, sheet.bounds.y2 - 1 - (54 + 70));
    assert_near((double)below[0], 0.5, 0.003);
    assert_near((double)below[1], 0, 0.003);
    const float *const above = wo_image_at(&sheet, 9 + 80, sheet.bounds.y2 - 1 - (54 + 20));
    assert_near((double)above[1], 1, 0.003);
    assert_near(level(&sheet, 9 + 169 + 80, 54 + 45), 0.25, 0.003);
    assert_near(level(&sheet, 9 + 169 + 20, 54 + 45), 24.0 / 255, 0.001); /* beside the tall one */
    assert_true(letters_in(&sheet, 8, 30) > 100);                         /* title */
    assert_true(letters_in(&sheet, 54 + 90, 54 + 126) > 100);             /* captions */
    for (int x = 1; x < 9; x++)                                           /* the frame stays free */
        for (int row = 0; row < wo_rect_height(sheet.bounds); row++)
            assert_near(level(&sheet, x, row), 38.0 / 255, 0.001);
    free(sheet.data);
    free(red.memory);
    free(tall.memory);
}

static void bad_sheets(void **state)
{
    (void)state;
    canvas a = make_canvas(64, 36, 3, false);
    wo_picture_cell cell = {.image = &a.image};
    wo_picture_layout layout = {0};
    wo_image sheet;
    assert_fault(wo_picture_sheet(&layout, &cell, 0, &sheet, &fault), WO_ERR_ARGUMENT, "sheet");
    layout.cell_width = 9000;
    assert_fault(wo_picture_sheet(&layout, &cell, 1, &sheet, &fault), WO_ERR_RANGE, "9000");
    layout.cell_width = -1;
    assert_fault(wo_picture_sheet(&layout, &cell, 1, &sheet, &fault), WO_ERR_RANGE, "-1");
    layout.cell_width = 16;
    a.image.components = 2;
    assert_fault(wo_picture_sheet(&layout, &cell, 1, &sheet, &fault), WO_ERR_FORMAT, "sheet");
    a.image.components = 3;
    assert_ok(wo_picture_sheet(&layout, &cell, 1, &sheet, &fault));
    assert_int_equal(wo_rect_width(sheet.bounds), 16 + 2 * 9);
    free(sheet.data);
    free(a.memory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_errors),
        cmocka_unit_test(equal_pictures),
        cmocka_unit_test(grey_counts_as_three),
        cmocka_unit_test(broken_samples_are_counted),
        cmocka_unit_test(bad_pairs),
        cmocka_unit_test(sizes_change),
        cmocka_unit_test(the_srgb_curve),
        cmocka_unit_test(differences_are_shown),
        cmocka_unit_test(sheets),
        cmocka_unit_test(bad_sheets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
