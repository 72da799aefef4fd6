/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/param.h"

#include "core/base/number.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

typedef struct sample {
    double stop;
    int32_t blades;
    int32_t on;
    int32_t shape;
    double centre[2];
    double tint[3];
    char file[WO_PARAM_STRING_SIZE];
    int32_t guard;
} sample;

static const char *const shapes[] = {"disc", "polygon", "polygonRound", NULL};

static const wo_param table[] = {
    {.key = "stop",
     .type = WO_PARAM_DOUBLE,
     .offset = offsetof(sample, stop),
     .initial = {2.8},
     .min = 0.5,
     .max = 64},
    {.key = "blades",
     .type = WO_PARAM_INT,
     .offset = offsetof(sample, blades),
     .initial = {6},
     .min = 3,
     .max = 16},
    {.key = "on", .type = WO_PARAM_BOOL, .offset = offsetof(sample, on), .initial = {1}},
    {.key = "shape",
     .type = WO_PARAM_CHOICE,
     .offset = offsetof(sample, shape),
     .initial = {1},
     .choices = shapes},
    {.key = "centre",
     .type = WO_PARAM_POINT,
     .offset = offsetof(sample, centre),
     .initial = {0.5, 0.25},
     .min = -1,
     .max = 1},
    {.key = "tint",
     .type = WO_PARAM_COLOUR,
     .offset = offsetof(sample, tint),
     .initial = {1, 0.5, 0},
     .min = 0,
     .max = 100},
    {.key = "file",
     .type = WO_PARAM_STRING,
     .offset = offsetof(sample, file),
     .initial_text = "none"},
};

enum { STOP, BLADES, ON, SHAPE, CENTRE, TINT, FILE_ };

static void fill(sample *s)
{
    memset(s, 0x55, sizeof *s);
    wo_params_default(table, WO_COUNT(table), s);
}

static void defaults_come_from_the_table(void **state)
{
    (void)state;
    sample s;
    fill(&s);
    assert_true(s.stop == 2.8);
    assert_int_equal(s.blades, 6);
    assert_int_equal(s.on, 1);
    assert_int_equal(s.shape, 1);
    assert_true(s.centre[0] == 0.5 && s.centre[1] == 0.25);
    assert_true(s.tint[0] == 1 && s.tint[1] == 0.5 && s.tint[2] == 0);
    assert_string_equal(s.file, "none");
    assert_int_equal(s.file[WO_PARAM_STRING_SIZE - 1], 0);
    assert_int_equal(s.guard, 0x55555555);
    assert_int_equal(wo_params_validate(table, WO_COUNT(table), &s, NULL), WO_OK);
}

static void rows_are_found_and_counted(void **state)
{
    (void)state;
    static const int values[] = {1, 1, 1, 1, 2, 3, 0};
    for (size_t i = 0; i < WO_COUNT(table); i++) {
        assert_ptr_equal(wo_param_find(table, WO_COUNT(table), table[i].key), &table[i]);
        assert_int_equal(wo_param_values(&table[i]), values[i]);
        assert_int_equal(wo_param_choice_count(&table[i]), i == SHAPE ? 3 : 0);
    }
    assert_null(wo_param_find(table, WO_COUNT(table), "sto"));
    assert_null(wo_param_find(table, WO_COUNT(table), NULL));
    assert_null(wo_param_find(table, 0, "stop"));
}

static void values_go_in_and_out(void **state)
{
    (void)state;
    static const double good[][3] = {{64}, {16}, {0}, {2}, {-1, 1}, {100, 0, 50}};
    sample s;
    fill(&s);
    for (size_t i = 0; i < WO_COUNT(good); i++) {
        double values[3] = {9, 9, 9};
        assert_int_equal(wo_param_set(&table[i], &s, good[i], NULL), WO_OK);
        wo_param_get(&table[i], &s, values);
        for (int j = 0; j < 3; j++)
            assert_true(values[j] == good[i][j]);
    }
    assert_true(s.stop == 64 && s.blades == 16 && s.on == 0 && s.shape == 2);
    assert_true(s.centre[1] == 1 && s.tint[2] == 50);
}

static void values_outside_the_range_are_refused(void **state)
{
    (void)state;
    static const struct {
        int row;
        double values[3];
    } bad[] = {
        {STOP, {0.499}},
        {STOP, {64.001}},
        {STOP, {NAN}},
        {STOP, {INFINITY}},
        {STOP, {-INFINITY}},
        {BLADES, {2}},
        {BLADES, {17}},
        {BLADES, {4.5}},
        {BLADES, {NAN}},
        {BLADES, {1e300}},
        {ON, {2}},
        {ON, {-1}},
        {ON, {0.5}},
        {SHAPE, {3}},
        {SHAPE, {-1}},
        {SHAPE, {0.5}},
        {CENTRE, {0, 1.5}},
        {CENTRE, {NAN, 0}},
        {TINT, {0, 0, -0.1}},
        {TINT, {0, INFINITY, 0}},
    };
    sample s, before;
    fill(&s);
    before = s;
    for (size_t i = 0; i < WO_COUNT(bad); i++) {
        wo_error error = {WO_OK, ""};
        assert_int_equal(wo_param_set(&table[bad[i].row], &s, bad[i].values, &error), WO_ERR_RANGE);
        assert_memory_equal(error.text, table[bad[i].row].key, strlen(table[bad[i].row].key));
        assert_memory_equal(&s, &before, sizeof s);
    }
    assert_int_equal(wo_param_set(&table[FILE_], &s, bad[0].values, NULL), WO_ERR_ARGUMENT);

    wo_error error;
    const double low[3] = {0.1};
    assert_int_equal(wo_param_set(&table[STOP], &s, low, &error), WO_ERR_RANGE);
    assert_string_equal(error.text, "stop: 0.1 is outside 0.5..64");
}

static void texts_go_in_and_out(void **state)
{
    (void)state;
    sample s;
    char longest[WO_PARAM_STRING_SIZE + 1];
    fill(&s);
    memset(longest, 'a', sizeof longest);
    longest[WO_PARAM_STRING_SIZE] = '\0';
    assert_int_equal(wo_param_set_text(&table[FILE_], &s, longest, NULL), WO_ERR_RANGE);
    assert_string_equal(wo_param_get_text(&table[FILE_], &s), "none");
    longest[WO_PARAM_STRING_SIZE - 1] = '\0';
    assert_int_equal(wo_param_set_text(&table[FILE_], &s, longest, NULL), WO_OK);
    assert_string_equal(wo_param_get_text(&table[FILE_], &s), longest);
    assert_int_equal(s.guard, 0x55555555);
    assert_int_equal(wo_param_set_text(&table[FILE_], &s, "", NULL), WO_OK);
    assert_string_equal(s.file, "");
    assert_int_equal(s.file[500], 0);
    assert_int_equal(wo_param_set_text(&table[FILE_], &s, NULL, NULL), WO_ERR_ARGUMENT);
    assert_int_equal(wo_param_set_text(&table[STOP], &s, "1", NULL), WO_ERR_ARGUMENT);
    assert_null(wo_param_get_text(&table[STOP], &s));
}

static void validation_finds_each_bad_row(void **state)
{
    (void)state;
    wo_error error;
    sample s;
    fill(&s);
    s.stop = NAN;
    assert_int_equal(wo_params_validate(table, WO_COUNT(table), &s, &error), WO_ERR_RANGE);
    assert_non_null(strstr(error.text, "stop"));
    fill(&s);
    s.shape = 3;
    assert_int_equal(wo_params_validate(table, WO_COUNT(table), &s, &error), WO_ERR_RANGE);
    assert_non_null(strstr(error.text, "shape"));
    fill(&s);
    s.tint[1] = -1;
    assert_int_equal(wo_params_validate(table, WO_COUNT(table), &s, &error), WO_ERR_RANGE);
    fill(&s);
    memset(s.file, 'x', sizeof s.file);
    assert_int_equal(wo_params_validate(table, WO_COUNT(table), &s, &error), WO_ERR_RANGE);
    assert_non_null(strstr(error.text, "file"));
}

static void command_line_values_are_read(void **state)
{
    (void)state;
    static const struct {
        int row;
        const char *text;
        double values[3];
    } good[] = {
        {STOP, "2.8", {2.8}},
        {STOP, " +1e1 ", {10}},
        {STOP, ".5", {0.5}},
        {STOP, "5.", {5}},
        {STOP, "0.0064E+4", {64}},
        {BLADES, "7", {7}},
        {BLADES, "7.0", {7}},
        {ON, "true", {1}},
        {ON, "false", {0}},
        {ON, "off", {0}},
        {ON, "yes", {1}},
        {ON, "0", {0}},
        {SHAPE, "polygon", {1}},
        {SHAPE, "polygonRound", {2}},
        {SHAPE, "0", {0}},
        {CENTRE, "-0.25,1", {-0.25, 1}},
        {CENTRE, " 0 , 1e-3 ", {0, 1e-3}},
        {TINT, "1,2,3", {1, 2, 3}},
    };
    static const struct {
        int row;
        const char *text;
    } bad[] = {
        {STOP, ""},      {STOP, "x"},     {STOP, "2.8 mm"},        {STOP, "2,8"},
        {STOP, "nan"},   {STOP, "inf"},   {STOP, "0x10"},          {STOP, "1e"},
        {STOP, "--2"},   {STOP, "1.2.3"}, {STOP, "1e999"},         {STOP, "."},
        {STOP, "0.1"},   {BLADES, "4.5"}, {BLADES, "99999999999"}, {ON, "maybe"},
        {ON, "truely"},  {ON, "2"},       {SHAPE, "poly"},         {SHAPE, "3"},
        {SHAPE, ""},     {CENTRE, "1"},   {CENTRE, "1,"},          {CENTRE, "1,1,1"},
        {CENTRE, "1;1"}, {TINT, "1,2"},   {TINT, "1,2,3,4"},
    };
    sample s;
    double values[3];
    for (size_t i = 0; i < WO_COUNT(good); i++) {
        fill(&s);
        assert_int_equal(wo_param_parse(&table[good[i].row], good[i].text, &s, NULL), WO_OK);
        wo_param_get(&table[good[i].row], &s, values);
        for (int j = 0; j < 3; j++)
            assert_true(values[j] == good[i].values[j]);
    }
    for (size_t i = 0; i < WO_COUNT(bad); i++) {
        sample before;
        wo_error error = {WO_OK, ""};
        fill(&s);
        before = s;
        assert_int_not_equal(wo_param_parse(&table[bad[i].row], bad[i].text, &s, &error), WO_OK);
        assert_true(error.text[0] != '\0');
        assert_memory_equal(&s, &before, sizeof s);
    }
    wo_error error;
    assert_int_equal(wo_param_parse(&table[SHAPE], "star", &s, &error), WO_ERR_ARGUMENT);
    assert_string_equal(error.text, "shape: \"star\" is none of disc, polygon, polygonRound");
    assert_int_equal(wo_param_parse(&table[STOP], NULL, &s, &error), WO_ERR_ARGUMENT);
    assert_int_equal(wo_param_parse(&table[FILE_], " a b, c ", &s, NULL), WO_OK);
    assert_string_equal(s.file, " a b, c ");
}

static void printed_values_read_back(void **state)
{
    (void)state;
    static const char *const expected[] = {"2.8",      "6",       "true", "polygon",
                                           "0.5,0.25", "1,0.5,0", "none"};
    sample s, again;
    char text[WO_PARAM_STRING_SIZE];
    fill(&s);
    for (size_t i = 0; i < WO_COUNT(table); i++) {
        assert_int_equal(wo_param_print(&table[i], &s, text, sizeof text), strlen(expected[i]));
        assert_string_equal(text, expected[i]);
        assert_int_equal(wo_param_print(&table[i], &s, NULL, 0), strlen(expected[i]));
        assert_int_equal(wo_param_print(&table[i], &s, text, 3), strlen(expected[i]));
        assert_int_equal(strlen(text), strlen(expected[i]) < 2 ? 1 : 2);
    }
    s.stop = 0.5 + DBL_EPSILON;
    s.centre[0] = -1.0 / 3;
    s.tint[2] = 1e-300;
    memset(&again, 0, sizeof again);
    for (size_t i = 0; i < WO_COUNT(table); i++) {
        wo_param_print(&table[i], &s, text, sizeof text);
        assert_int_equal(wo_param_parse(&table[i], text, &again, NULL), WO_OK);
    }
    assert_true(again.stop == s.stop && again.centre[0] == s.centre[0]);
    assert_true(again.tint[2] == s.tint[2]);
}

static uint64_t next(uint64_t *seed)
{
    *seed ^= *seed << 13;
    *seed ^= *seed >> 7;
    *seed ^= *seed << 17;
    return *seed;
}

static void any_double_survives_printing(void **state)
{
    (void)state;
    static const double special[] = {
        0,       -0.0,    1,    0.1,     1e15,     123456789012345678.0,
        1e16,    1e-5,    9e-6, DBL_MIN, DBL_MAX,  DBL_TRUE_MIN,
        1 / 3.0, 2 / 3.0, 1e22, 1e23,    -1.5e-17, 99999.5};
    uint64_t seed = 0x9e3779b97f4a7c15u;
    for (size_t i = 0; i < 20000; i++) {
        char text[WO_NUMBER_SIZE + 1];
        double value, again = 7;
        const char *end = NULL;
        const uint64_t bits = next(&seed);
        memcpy(&value, &bits, sizeof value);
        if (i < WO_COUNT(special))
            value = special[i];
        if (!isfinite(value))
            continue;
        text[WO_NUMBER_SIZE] = 'g';
        const int length = wo_number_print(value, text);
        assert_int_equal(length, strlen(text));
        assert_true(length < WO_NUMBER_SIZE);
        assert_int_equal(text[WO_NUMBER_SIZE], 'g');
        assert_true(wo_number_read(text, &end, &again));
        assert_int_equal(*end, '\0');
        assert_memory_equal(&again, &value, sizeof value);
    }
}

static void numbers_look_as_people_write_them(void **state)
{
    (void)state;
    static const struct {
        double value;
        const char *text;
    } rows[] = {{0, "0"},
                {1, "1"},
                {-2.5, "-2.5"},
                {0.001, "0.001"},
                {100, "100"},
                {1e15, "1000000000000000"},
                {1e16, "1e16"},
                {1.25e20, "1.25e20"},
                {1e-5, "0.00001"},
                {1.5e-6, "1.5e-6"},
                {123.456, "123.456"},
                {NAN, "nan"},
                {INFINITY, "inf"},
                {-INFINITY, "-inf"}};
    for (size_t i = 0; i < WO_COUNT(rows); i++) {
        char text[WO_NUMBER_SIZE];
        wo_number_print(rows[i].value, text);
        assert_string_equal(text, rows[i].text);
    }
}

static void long_numbers_are_exact(void **state)
{
    (void)state;
    char text[3000];
    double value = 0;
    /* 1 followed by 2000 zeros, brought back by its exponent; and the same behind the point. */
    memset(text, '0', sizeof text);
    text[0] = '1';
    snprintf(text + 2001, sizeof text - 2001, "e-2000");
    assert_true(wo_number_read(text, NULL, &value));
    assert_true(value == 1);
    memset(text, '0', sizeof text);
    text[1] = '.';
    snprintf(text + 2001, sizeof text - 2001, "25e2000");
    assert_true(wo_number_read(text, NULL, &value));
    assert_true(value == 25.0 * 10 / 100);
    assert_true(wo_number_read("1e-99999999999999999999", NULL, &value));
    assert_true(value == 0);
    assert_false(wo_number_read("1e99999999999999999999", NULL, &value));
    /* Half way between two doubles goes to the even one, a hair above goes up. */
    assert_true(wo_number_read("9007199254740993", NULL, &value));
    assert_true(value == 9007199254740992.0);
    assert_true(wo_number_read("9007199254740993.00000000000000000001", NULL, &value));
    assert_true(value == 9007199254740994.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_come_from_the_table),
        cmocka_unit_test(rows_are_found_and_counted),
        cmocka_unit_test(values_go_in_and_out),
        cmocka_unit_test(values_outside_the_range_are_refused),
        cmocka_unit_test(texts_go_in_and_out),
        cmocka_unit_test(validation_finds_each_bad_row),
        cmocka_unit_test(command_line_values_are_read),
        cmocka_unit_test(printed_values_read_back),
        cmocka_unit_test(any_double_survives_printing),
        cmocka_unit_test(numbers_look_as_people_write_them),
        cmocka_unit_test(long_numbers_are_exact),
    };
    return cmocka_run_group_tests_name("param", tests, NULL, NULL);
}
