/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* number.c once more, with a C library whose locale writes a decimal comma. Such a locale need not
   be installed on the machine that runs this. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static int points_met;

/* A locale changes the conversions e, f, g and a; not the rest of the format. */
__attribute__((format(printf, 3, 4))) static int comma_snprintf(char *buffer, size_t size,
                                                                const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(buffer, size, format, arguments);
    va_end(arguments);
    char *const point = strchr(buffer, '.');
    assert_null(strstr(format, "%g"));
    assert_null(strstr(format, "%f"));
    if (strcmp(format, "%.*e") == 0 && point) {
        *point = ',';
        points_met++;
    }
    return length;
}

static double comma_strtod(const char *text, char **end)
{
    char copy[1024];
    assert_true(strlen(text) < sizeof copy);
    strcpy(copy, text);
    /* Here a point ends the number, and a comma is its decimal point. */
    if (strchr(copy, '.'))
        *strchr(copy, '.') = '\0';
    if (strchr(copy, ','))
        *strchr(copy, ',') = '.';
    assert_null(end);
    return strtod(copy, NULL);
}

#define snprintf        comma_snprintf
#define strtod          comma_strtod
#define wo_number_read  comma_number_read
#define wo_number_print comma_number_print
#include "core/base/number.c"

static void the_comma_library_would_break_plain_calls(void **state)
{
    (void)state;
    char text[32];
    snprintf(text, sizeof text, "%.*e", 2, 1.25);
    assert_string_equal(text, "1,25e+00");
    assert_true(strtod("1.5", NULL) == 1);
}

static void numbers_are_the_same(void **state)
{
    (void)state;
    static const struct {
        double value;
        const char *text;
    } rows[] = {{0.5, "0.5"},
                {-2.875, "-2.875"},
                {123456.789, "123456.789"},
                {1e-5, "0.00001"},
                {1.5e-300, "1.5e-300"},
                {1.25e20, "1.25e20"},
                {7, "7"},
                {1.0 / 3, "0.3333333333333333"}};
    points_met = 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[WO_NUMBER_SIZE];
        double value = 0;
        const char *end = NULL;
        wo_number_print(rows[i].value, text);
        assert_string_equal(text, rows[i].text);
        assert_true(wo_number_read(text, &end, &value));
        assert_int_equal(*end, '\0');
        assert_true(value == rows[i].value);
    }
    assert_true(points_met > 0);
}

static void a_comma_ends_a_number(void **state)
{
    (void)state;
    double value = 0;
    const char *end = NULL;
    assert_true(wo_number_read("2,5", &end, &value));
    assert_true(value == 2);
    assert_string_equal(end, ",5");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_comma_library_would_break_plain_calls),
        cmocka_unit_test(numbers_are_the_same),
        cmocka_unit_test(a_comma_ends_a_number),
    };
    return cmocka_run_group_tests_name("locale", tests, NULL, NULL);
}
