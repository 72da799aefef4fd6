/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_host_stub/cli/plot.h"
#include "ofx_host_stub/cli/text_file.h"

#include <locale.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

static void check_ticks(double low, double high, int wanted, double first, double step, int count,
                        int decimals)
{
    wo_ticks ticks;
    wo_ticks_make(low, high, wanted, &ticks);
    assert_int_equal(ticks.count, count);
    assert_true(fabs(ticks.value[0] - first) <= step * 1e-9);
    assert_true(fabs(ticks.step - step) <= step * 1e-9);
    assert_int_equal(ticks.decimals, decimals);
}

static void test_ticks(void **state)
{
    (void)state;
    check_ticks(0, 10, 5, 0, 2, 6, 0);
    check_ticks(0, 1, 5, 0, 0.2, 6, 1);
    check_ticks(0, 1, 10, 0, 0.1, 11, 1);
    check_ticks(-3, 97, 5, 0, 20, 5, 0);
    check_ticks(-0.031, 0.024, 5, -0.03, 0.01, 6, 2);
    check_ticks(0, 4.9, 5, 0, 1, 5, 0);
    check_ticks(0, 3e-9, 3, 0, 1e-9, 4, -1);
    check_ticks(0, 4e8, 4, 0, 1e8, 5, -1);
}

static void test_ticks_degenerate(void **state)
{
    const double ranges[][2] = {{5, 5},          {0, 0},           {1, -1},         {NAN, 3},
                                {NAN, NAN},      {0, INFINITY},    {-INFINITY, 0},  {1e300, 1e300},
                                {-1e308, 1e308}, {1e12, 1e12 + 1}, {1e-300, 2e-300}};
    (void)state;
    for (size_t i = 0; i < WO_COUNT(ranges); i++)
        for (int wanted = -1; wanted < 30; wanted++) {
            wo_ticks ticks;
            wo_ticks_make(ranges[i][0], ranges[i][1], wanted, &ticks);
            assert_in_range(ticks.count, 1, WO_TICKS_MAX);
            for (int k = 0; k < ticks.count; k++) {
                assert_true(isfinite(ticks.value[k]));
                assert_true(k == 0 || ticks.value[k] > ticks.value[k - 1]);
            }
        }
}

static void check_log_ticks(double low, double high, int count, double first, double last)
{
    wo_ticks ticks;
    wo_ticks_make_log(low, high, &ticks);
    assert_int_equal(ticks.count, count);
    assert_true(fabs(ticks.value[0] / first - 1) < 1e-9);
    assert_true(fabs(ticks.value[count - 1] / last - 1) < 1e-9);
}

static void test_log_axis(void **state)
{
    (void)state;
    check_log_ticks(0.02, 0.5, 5, 0.02, 0.5);
    check_log_ticks(0.021, 10, 8, 0.05, 10);
    check_log_ticks(0.006, 0.016, 6, 0.006, 0.015);
    check_log_ticks(1, 1000, 10, 1, 1000);
    check_log_ticks(1e-4, 1e6, 6, 1e-4, 1e6);
    for (double low = 1e-9; low < 1e9; low *= 1.7)
        for (double high = low * 1.01; high < 1e12; high *= 3.1) {
            wo_axis axis = {low, high, NULL, 0, true};
            wo_ticks ticks;
            wo_axis_round(&axis);
            wo_ticks_make_log(axis.low, axis.high, &ticks);
            assert_true(axis.low <= low * 1.000001 && axis.high >= high * 0.999999);
            assert_true(axis.low > low / 2.51 && axis.high < high * 2.51);
            assert_in_range(ticks.count, 1, WO_TICKS_MAX);
        }
    const double values[] = {0, -1, NAN, 3, INFINITY, 70};
    wo_axis axis = {1, 0, NULL, 0, true};
    wo_axis_cover(&axis, values, WO_COUNT(values));
    wo_axis_round(&axis);
    assert_true(fabs(axis.low - 2) < 1e-9 && fabs(axis.high - 100) < 1e-9);
    const double odd[][2] = {{0, 0}, {-1, 5}, {NAN, NAN}, {INFINITY, 1}, {5, 5}, {9, 2}};
    for (size_t i = 0; i < WO_COUNT(odd); i++) {
        wo_axis any = {odd[i][0], odd[i][1], NULL, 0, true};
        wo_axis_round(&any);
        assert_true(any.low > 0 && any.high > any.low && isfinite(any.high));
    }
    wo_svg svg;
    wo_svg_begin(&svg, 100, 100, "log");
    const wo_plot plot = wo_plot_begin(&svg, (wo_box){0, 0, 100, 100}, NULL, axis, axis);
    assert_true(fabs(wo_plot_x(&plot, 2) - plot.box.x) < 1e-9);
    assert_true(fabs(wo_plot_x(&plot, sqrt(200)) - plot.box.x - plot.box.w / 2) < 1e-9);
    assert_true(isnan(wo_plot_y(&plot, 0)));
    wo_svg_free(&svg);
}

static void check_number(double value, int decimals, const char *expected)
{
    char text[32];
    assert_string_equal(wo_plot_number(text, sizeof text, value, decimals), expected);
}

static void test_numbers(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        check_number(1.25, 2, "1.25");
        check_number(-0.004, 2, "0.00");
        check_number(-12.5, 1, "-12.5");
        check_number(7, 0, "7");
        check_number(NAN, 2, "-");
        check_number(-INFINITY, 2, "-infinite");
        check_number(1.5e-9, -1, "1.50e-9");
        check_number(0, -1, "0.00e0");
        check_number(9.999e12, 2, "1.00e13");
        setlocale(LC_ALL, "de_DE.UTF-8"); /* where it is installed, it writes 1,25 */
    }
    setlocale(LC_ALL, "C");
}

static void test_axes(void **state)
{
    const double values[] = {NAN, 0.013, -0.042, INFINITY};
    (void)state;
    wo_axis axis = {.low = 1, .high = 0};
    wo_axis_cover(&axis, values, 4);
    assert_true(axis.low == -0.042);
    assert_true(axis.high == 0.013);
    wo_axis_round(&axis);
    assert_true(fabs(axis.low - (-0.05)) < 1e-12);
    assert_true(fabs(axis.high - (0.02)) < 1e-12);
    wo_axis empty = {.low = 1, .high = 0};
    wo_axis_cover(&empty, values, 1);
    wo_axis_round(&empty);
    assert_true(empty.low == 0);
    assert_true(empty.high == 1);
}

static const wo_pen pen = {"#000000", 1, "4 2"};

static void draw(wo_svg *svg)
{
    const double x[] = {0, 1, NAN, 2, 3, 4}, y[] = {0, 1, 1, 2, INFINITY, 1e30};
    const char *const name = "a & b";
    wo_svg_begin(svg, 400, 300, "A <lens> & \"more\"");
    const wo_plot plot =
        wo_plot_begin(svg, (wo_box){0, 0, 400, 300}, "f/2 \xC2\xB5 \xFF\x01",
                      (wo_axis){0, 4, "x, mm", 0, false}, (wo_axis){0, 2, "y", 0, false});
    wo_plot_curve(&plot, &pen, x, y, 6);
    wo_plot_curve(&plot, &pen, x, y, 0);
    wo_plot_legend(svg, 390, 15, &pen, &name, 1);
    wo_svg_dots(svg, "#ff0000", 2, x, y, 6);
    assert_int_equal(wo_svg_finish(svg, NULL), WO_OK);
}

static int occurrences(const char *text, const char *word)
{
    int count = 0;
    for (const char *s = strstr(text, word); s; s = strstr(s + 1, word))
        count++;
    return count;
}

static void test_drawing(void **state)
{
    wo_svg svg, again;
    (void)state;
    draw(&svg);
    draw(&again);
    assert_string_equal(svg.text, again.text);
    assert_int_equal(svg.length, strlen(svg.text));
    assert_non_null(strstr(svg.text, "<title>A &lt;lens&gt; &amp; &quot;more&quot;</title>"));
    assert_non_null(strstr(svg.text, ">f/2 \xC2\xB5 \xEF\xBF\xBD\xEF\xBF\xBD</text>"));
    assert_non_null(strstr(svg.text, "a &amp; b</text>"));
    assert_null(strstr(svg.text, "nan"));
    assert_null(strstr(svg.text, "inf"));
    assert_int_equal(occurrences(svg.text, "<g "), occurrences(svg.text, "</g>"));
    assert_int_equal(occurrences(svg.text, "<text"), occurrences(svg.text, "</text>"));
    assert_int_equal(occurrences(svg.text, "h0"), 4); /* the infinite point and the NaN are out */
    /* The curve: two points, a gap, one point, a gap, one point far outside: one line. */
    const char *const curve = strstr(svg.text, "stroke-dasharray=\"4 2\" d=\"M");
    assert_non_null(curve);
    char line[256];
    snprintf(line, sizeof line, "%.*s", (int)strcspn(curve, "\n"), curve);
    assert_int_equal(occurrences(line, "M"), 1);
    assert_int_equal(occurrences(line, "L"), 1);
    wo_svg_free(&svg);
    wo_svg_free(&again);
    assert_null(svg.text);
}

/* Open paths and dots end at the clip box. */
static void test_clip(void **state)
{
    (void)state;
    wo_svg svg;
    const wo_pen solid = {"#000000", 1, NULL};
    const double x[] = {-10, 5, 20, 20, 5, 5}, y[] = {5, 5, 20, 50, 50, 8};
    wo_svg_begin(&svg, 100, 100, "clip");
    wo_svg_clip_begin(&svg, (wo_box){0, 0, 10, 10});
    wo_svg_path(&svg, &solid, NULL, x, y, 6);
    wo_svg_line(&svg, &solid, -5, -5, 50, 50);
    wo_svg_line(&svg, &solid, -5, 5, 5, -50);
    wo_svg_dots(&svg, "#000000", 2, x, y, 6);
    wo_svg_clip_end(&svg);
    wo_svg_line(&svg, &solid, -5, 1, 50, 1);
    assert_int_equal(wo_svg_finish(&svg, NULL), WO_OK);
    assert_non_null(strstr(svg.text, "d=\"M0 5L5 5L10 10M5 10L5 8\""));
    assert_non_null(strstr(svg.text, "d=\"M0 0L10 10\""));
    assert_non_null(strstr(svg.text, "d=\"\""));
    assert_non_null(strstr(svg.text, "d=\"M5 5h0M5 8h0\""));
    assert_non_null(strstr(svg.text, "d=\"M-5 1L50 1\""));
    wo_svg_free(&svg);
}

static void test_files(void **state)
{
    char folder[] = "/tmp/wo_plot_XXXXXX", path[64], missing[96];
    char *text;
    size_t length;
    wo_error error = {0};
    (void)state;
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/a.svg", folder);
    snprintf(missing, sizeof missing, "%s/no/a.svg", folder);
    assert_int_equal(wo_text_save(path, "old", 3, &error), WO_OK);
    assert_int_equal(wo_text_save(path, "hello", 5, &error), WO_OK);
    assert_int_equal(wo_text_read(path, 5, &text, &length, &error), WO_OK);
    assert_int_equal(length, 5);
    assert_string_equal(text, "hello");
    free(text);
    assert_int_equal(wo_text_read(path, 4, &text, &length, &error), WO_ERR_RANGE);
    assert_null(text);
    assert_int_equal(wo_text_save(missing, "x", 1, &error), WO_ERR_IO);
    assert_non_null(strstr(error.text, missing));
    assert_int_equal(wo_text_read(missing, 4, &text, &length, &error), WO_ERR_IO);
    assert_int_equal(wo_text_read(folder, 4, &text, &length, &error), WO_ERR_IO);
    if (access("/dev/full", W_OK) == 0)
        assert_int_equal(wo_text_save("/dev/full", "x", 1, &error), WO_ERR_IO);
    assert_int_equal(remove(path), 0);
    assert_int_equal(rmdir(folder), 0); /* so nothing else was left in it */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ticks),    cmocka_unit_test(test_ticks_degenerate),
        cmocka_unit_test(test_log_axis), cmocka_unit_test(test_numbers),
        cmocka_unit_test(test_axes),     cmocka_unit_test(test_drawing),
        cmocka_unit_test(test_clip),     cmocka_unit_test(test_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
