/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/image.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define RECT(...) ((wo_rect){__VA_ARGS__})

static const wo_rect all = {INT32_MIN, INT32_MIN, INT32_MAX, INT32_MAX};

static void assert_rect(wo_rect r, int32_t x1, int32_t y1, int32_t x2, int32_t y2)
{
    assert_int_equal(r.x1, x1);
    assert_int_equal(r.y1, y1);
    assert_int_equal(r.x2, x2);
    assert_int_equal(r.y2, y2);
}

static void sizes(void **state)
{
    (void)state;
    assert_int_equal(wo_rect_width(RECT(-3, 1, 5, 2)), 8);
    assert_int_equal(wo_rect_height(RECT(-3, 1, 5, 2)), 1);
    assert_int_equal(wo_rect_width(RECT(5, 0, 3, 9)), 0);
    assert_int_equal(wo_rect_height(RECT(5, 0, 3, 9)), 0);
    assert_int_equal(wo_rect_width(all), INT32_MAX);
    assert_int_equal(wo_rect_height(all), INT32_MAX);
    assert_true(wo_rect_empty(RECT(0, 0, 0, 5)));
    assert_true(wo_rect_empty(RECT(0, 5, 5, 4)));
    assert_true(wo_rect_empty(RECT(INT32_MAX, 0, INT32_MIN, 5)));
    assert_false(wo_rect_empty(RECT(0, 0, 1, 1)));
}

static void intersections(void **state)
{
    (void)state;
    assert_rect(wo_rect_intersect(RECT(0, 0, 10, 10), RECT(5, -5, 20, 5)), 5, 0, 10, 5);
    assert_rect(wo_rect_intersect(RECT(0, 0, 10, 10), RECT(10, 0, 20, 10)), 0, 0, 0, 0);
    assert_rect(wo_rect_intersect(RECT(0, 0, 10, 10), RECT(7, 7, 7, 9)), 0, 0, 0, 0);
    assert_rect(wo_rect_intersect(RECT(9, 9, 2, 2), RECT(0, 0, 10, 10)), 0, 0, 0, 0);
    assert_rect(wo_rect_intersect(all, RECT(-7, 3, 8, 4)), -7, 3, 8, 4);
}

static void unions(void **state)
{
    (void)state;
    assert_rect(wo_rect_union(RECT(0, 0, 1, 1), RECT(5, -5, 6, 0)), 0, -5, 6, 1);
    assert_rect(wo_rect_union(RECT(3, 3, 3, 9), RECT(5, 5, 6, 6)), 5, 5, 6, 6);
    assert_rect(wo_rect_union(RECT(5, 5, 6, 6), RECT(3, 3, 3, 9)), 5, 5, 6, 6);
    assert_rect(wo_rect_union(RECT(4, 4, 4, 4), RECT(3, 3, 3, 9)), 0, 0, 0, 0);
}

static void growing(void **state)
{
    (void)state;
    assert_rect(wo_rect_grow(RECT(0, 0, 4, 4), 2, 1), -2, -1, 6, 5);
    assert_rect(wo_rect_grow(RECT(0, 0, 4, 4), -1, 0), 1, 0, 3, 4);
    assert_rect(wo_rect_grow(RECT(0, 0, 4, 4), -2, 0), 0, 0, 0, 0);
    assert_rect(wo_rect_grow(RECT(1, 1, 1, 1), 5, 5), 0, 0, 0, 0);
    assert_rect(wo_rect_grow(RECT(0, 0, 4, 4), INT32_MAX, INT32_MAX), -INT32_MAX, -INT32_MAX,
                INT32_MAX, INT32_MAX);
    assert_rect(wo_rect_grow(all, 1, 1), INT32_MIN, INT32_MIN, INT32_MAX, INT32_MAX);
    assert_rect(wo_rect_grow(RECT(0, 0, 4, 4), INT32_MIN, 0), 0, 0, 0, 0);
}

static void containing(void **state)
{
    (void)state;
    assert_true(wo_rect_contains(RECT(0, 0, 4, 4), RECT(0, 0, 4, 4)));
    assert_true(wo_rect_contains(RECT(0, 0, 4, 4), RECT(1, 1, 2, 2)));
    assert_true(wo_rect_contains(RECT(0, 0, 4, 4), RECT(9, 9, 9, 9)));
    assert_true(wo_rect_contains(RECT(0, 0, 0, 0), RECT(9, 9, 9, 9)));
    assert_false(wo_rect_contains(RECT(0, 0, 4, 4), RECT(0, 0, 5, 4)));
    assert_false(wo_rect_contains(RECT(0, 0, 4, 4), RECT(-1, 0, 4, 4)));
    assert_false(wo_rect_contains(RECT(0, 0, 4, 4), RECT(0, -1, 4, 4)));
    assert_false(wo_rect_contains(RECT(0, 0, 4, 4), RECT(0, 0, 4, 5)));
    assert_true(wo_rect_equal(RECT(1, 2, 3, 4), RECT(1, 2, 3, 4)));
    assert_false(wo_rect_equal(RECT(1, 2, 3, 4), RECT(1, 2, 3, 5)));
    assert_true(wo_rect_equal(RECT(1, 2, 1, 4), RECT(7, 7, 7, 7)));
    assert_false(wo_rect_equal(RECT(1, 2, 1, 4), RECT(0, 0, 1, 1)));
}

static void addresses_of_pixels(void **state)
{
    (void)state;
    float pixels[4][12];
    const wo_image up = {&pixels[0][0], {-1, 2, 2, 6}, (ptrdiff_t)sizeof pixels[0], 4};
    assert_ptr_equal(wo_image_at(&up, -1, 2), &pixels[0][0]);
    assert_ptr_equal(wo_image_at(&up, 1, 5), &pixels[3][8]);
    const wo_image down = {&pixels[3][0], {-1, 2, 2, 6}, -(ptrdiff_t)sizeof pixels[0], 4};
    assert_ptr_equal(wo_image_at(&down, -1, 2), &pixels[3][0]);
    assert_ptr_equal(wo_image_at(&down, 0, 5), &pixels[0][4]);
}

static void good_views_pass(void **state)
{
    (void)state;
    float pixels[64] = {0};
    wo_error error = {WO_OK, ""};
    const wo_image views[] = {
        {NULL, {0, 0, 0, 0}, 0, 0},
        {NULL, {5, 5, 1, 1}, 3, 77},
        {pixels, {0, 0, 4, 4}, 64, 4},
        {pixels, {-2, -2, 2, 2}, -64, 4},
        {pixels, {0, 0, 4, 4}, 80, 3},
        {pixels, {0, 0, 4, 1}, 0, 1},
        {pixels,
         {WO_MAX_COORDINATE - 4, -WO_MAX_COORDINATE, WO_MAX_COORDINATE, 2 - WO_MAX_COORDINATE},
         16,
         1},
    };
    for (size_t i = 0; i < WO_COUNT(views); i++)
        assert_int_equal(wo_image_validate(&views[i], "view", &error), WO_OK);
}

static void bad_views_fail(void **state)
{
    (void)state;
    float pixels[64] = {0};
    const struct {
        wo_image image;
        wo_status status;
    } bad[] = {
        {{pixels, {0, 0, 4, 4}, 64, 2}, WO_ERR_FORMAT},
        {{pixels, {0, 0, 4, 4}, 64, 0}, WO_ERR_FORMAT},
        {{pixels, {0, 0, 4, 4}, 64, -4}, WO_ERR_FORMAT},
        {{pixels, {0, 0, 0, 4}, 64, 4}, WO_ERR_RANGE},
        {{pixels, {4, 0, 0, 4}, 64, 4}, WO_ERR_RANGE},
        {{pixels, {0, 0, WO_MAX_SIDE + 1, 1}, 1 << 24, 4}, WO_ERR_RANGE},
        {{pixels, {INT32_MIN, 0, INT32_MAX, 1}, 64, 4}, WO_ERR_RANGE},
        {{pixels, {WO_MAX_COORDINATE, 0, WO_MAX_COORDINATE + 1, 1}, 64, 4}, WO_ERR_RANGE},
        {{pixels, {0, 0, 4, 4}, 60, 4}, WO_ERR_FORMAT},
        {{pixels, {0, 0, 4, 4}, -60, 4}, WO_ERR_FORMAT},
        {{pixels, {0, 0, 4, 4}, 0, 4}, WO_ERR_FORMAT},
        {{pixels, {0, 0, 4, 4}, 66, 4}, WO_ERR_FORMAT},
    };
    for (size_t i = 0; i < WO_COUNT(bad); i++) {
        wo_error error = {WO_OK, ""};
        assert_int_equal(wo_image_validate(&bad[i].image, "Depth", &error), bad[i].status);
        assert_int_equal(error.status, bad[i].status);
        assert_memory_equal(error.text, "Depth: ", 7);
    }
    assert_int_equal(wo_image_validate(NULL, NULL, NULL), WO_ERR_ARGUMENT);

    wo_image odd = {pixels, {0, 0, 4, 2}, 64, 4};
    char *const shifted = (char *)pixels + 2;
    memcpy(&odd.data, &shifted, sizeof shifted);
    assert_int_equal(wo_image_validate(&odd, "odd", NULL), WO_ERR_FORMAT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes),           cmocka_unit_test(intersections),
        cmocka_unit_test(unions),          cmocka_unit_test(growing),
        cmocka_unit_test(containing),      cmocka_unit_test(addresses_of_pixels),
        cmocka_unit_test(good_views_pass), cmocka_unit_test(bad_views_fail),
    };
    return cmocka_run_group_tests_name("rect", tests, NULL, NULL);
}
