/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_pixels.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

/* Value of a half by its definition. */
static double slow_half(unsigned half)
{
    const int exponent = (half >> 10) & 31;
    const double fraction = half & 1023, sign = half & 0x8000 ? -1 : 1;
    if (exponent == 31)
        return fraction != 0 ? NAN : sign * INFINITY;
    return sign * (exponent ? ldexp(1024 + fraction, exponent - 25) : ldexp(fraction, -24));
}

static void every_half_becomes_its_float(void **state)
{
    (void)state;
    for (unsigned h = 0; h < 65536; h++) {
        const float fast = wo_half_to_float((uint16_t)h);
        const double slow = slow_half(h);
        if (isnan(slow))
            assert_true(isnan(fast));
        else
            assert_true((double)fast == slow && !signbit(fast) == !signbit(slow));
    }
}

static void every_half_comes_back(void **state)
{
    (void)state;
    for (unsigned h = 0; h < 65536; h++) {
        const uint16_t back = wo_float_to_half(wo_half_to_float((uint16_t)h));
        if (isnan(slow_half(h)))
            assert_true(isnan(slow_half(back)));
        else
            assert_int_equal(back, h);
    }
}

/* Between two neighbours the nearer one wins, in the middle the even one. */
static void floats_round_to_the_nearest_half(void **state)
{
    (void)state;
    for (unsigned h = 0; h < 0x7bff; h++) {
        const double low = slow_half(h), high = slow_half(h + 1);
        const float middle = (float)((low + high) / 2);
        assert_true((double)middle == (low + high) / 2);
        assert_int_equal(wo_float_to_half(middle), h % 2 == 0 ? h : h + 1);
        assert_int_equal(wo_float_to_half(nextafterf(middle, 0)), h);
        assert_int_equal(wo_float_to_half(nextafterf(middle, INFINITY)), h + 1);
        assert_int_equal(wo_float_to_half(-middle), 0x8000u | (h % 2 == 0 ? h : h + 1));
    }
    assert_int_equal(wo_float_to_half(65504.0f), 0x7bff);
    assert_int_equal(wo_float_to_half(nextafterf(65520.0f, 0)), 0x7bff);
    assert_int_equal(wo_float_to_half(65520.0f), 0x7c00);
    assert_int_equal(wo_float_to_half(3e38f), 0x7c00);
    assert_int_equal(wo_float_to_half(-INFINITY), 0xfc00);
    assert_int_equal(wo_float_to_half(1e-45f), 0);
    assert_true(isnan(slow_half(wo_float_to_half(NAN))));
}

static void integers_are_rounded_and_clamped(void **state)
{
    static const struct {
        float value;
        unsigned byte, word;
    } rows[] = {{0, 0, 0},
                {1, 255, 65535},
                {2, 255, 65535},
                {-1, 0, 0},
                {NAN, 0, 0},
                {INFINITY, 255, 65535},
                {-INFINITY, 0, 0},
                {0.5f, 128, 32768},
                {1 / 255.0f, 1, 257},
                {1.49f / 255, 1, 383},
                {1.51f / 255, 2, 388}};
    (void)state;
    for (size_t i = 0; i < WO_COUNT(rows); i++) {
        float rgba[4] = {rows[i].value, 0, 0, 0};
        unsigned char bytes[4];
        uint16_t words[4];
        const wo_image from = {rgba, {0, 0, 1, 1}, 16, 4};
        const wo_pixels to8 = {bytes, {0, 0, 1, 1}, 4, 4, WO_DEPTH_BYTE};
        const wo_pixels to16 = {words, {0, 0, 1, 1}, 8, 4, WO_DEPTH_SHORT};
        wo_pixels_write(&from, &to8);
        wo_pixels_write(&from, &to16);
        assert_int_equal(bytes[0], rows[i].byte);
        assert_int_equal(words[0], rows[i].word);
    }
}

static void integers_come_back(void **state)
{
    (void)state;
    for (unsigned v = 0; v < 65536; v++) {
        uint16_t word = (uint16_t)v, back[4];
        float rgba[4];
        const wo_pixels in = {&word, {0, 0, 1, 1}, 2, 1, WO_DEPTH_SHORT};
        const wo_image view = {rgba, {0, 0, 1, 1}, 16, 4};
        const wo_pixels out = {back, {0, 0, 1, 1}, 8, 4, WO_DEPTH_SHORT};
        wo_pixels_read(&in, &view);
        wo_pixels_write(&view, &out);
        assert_int_equal(back[0], v);
        assert_int_equal(back[3], 65535);
    }
}

static void components_are_mapped(void **state)
{
    static const float from[4] = {0.1f, 0.2f, 0.3f, 0.4f};
    static const int32_t counts[3] = {1, 3, 4};
    static const float wanted[3][3][4] = {
        {{0.1f}, {0.1f, 0.1f, 0.1f}, {0.1f, 0.1f, 0.1f, 1}},
        {{0.1f}, {0.1f, 0.2f, 0.3f}, {0.1f, 0.2f, 0.3f, 1}},
        {{0.4f}, {0.1f, 0.2f, 0.3f}, {0.1f, 0.2f, 0.3f, 0.4f}},
    };
    (void)state;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            float source[4], to[5] = {9, 9, 9, 9, 9};
            memcpy(source, from, sizeof source);
            const wo_pixels in = {source, {7, 8, 8, 9}, 16, counts[i], WO_DEPTH_FLOAT};
            const wo_image out = {to, {7, 8, 8, 9}, 16, counts[j]};
            wo_pixels_read(&in, &out);
            for (int c = 0; c < counts[j]; c++)
                assert_true(to[c] == wanted[i][j][c]);
            assert_true(to[counts[j]] == 9);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_half_becomes_its_float),
        cmocka_unit_test(every_half_comes_back),
        cmocka_unit_test(floats_round_to_the_nearest_half),
        cmocka_unit_test(integers_are_rounded_and_clamped),
        cmocka_unit_test(integers_come_back),
        cmocka_unit_test(components_are_mapped),
    };
    return cmocka_run_group_tests_name("pixels of hosts", tests, NULL, NULL);
}
