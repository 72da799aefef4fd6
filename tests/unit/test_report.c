/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/report.h"

#include "core/base/number.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* A small strict reader of JSON: the end of one value, or NULL. */
static const char *read_value(const char *at);

static const char *blanks(const char *at)
{
    return at ? at + strspn(at, " \t\r\n") : NULL;
}

static const char *read_string(const char *at)
{
    if (*at++ != '"')
        return NULL;
    for (; *at != '"'; at++) {
        if ((unsigned char)*at < 0x20)
            return NULL;
        if (*at != '\\')
            continue;
        at++;
        if (*at == 'u') {
            if (strspn(at + 1, "0123456789abcdefABCDEF") < 4)
                return NULL;
            at += 4;
        } else if (*at == '\0' || !strchr("\"\\/bfnrt", *at)) {
            return NULL;
        }
    }
    return at + 1;
}

static const char *read_members(const char *at, char close, bool keys)
{
    at = blanks(at + 1);
    if (*at == close)
        return at + 1;
    for (;;) {
        if (keys) {
            at = blanks(read_string(at));
            if (!at || *at++ != ':')
                return NULL;
        }
        at = blanks(read_value(blanks(at)));
        if (!at)
            return NULL;
        if (*at == close)
            return at + 1;
        if (*at++ != ',')
            return NULL;
        at = blanks(at);
    }
}

static const char *read_value(const char *at)
{
    double number;
    const char *end;
    if (!at)
        return NULL;
    if (*at == '{')
        return read_members(at, '}', true);
    if (*at == '[')
        return read_members(at, ']', false);
    if (*at == '"')
        return read_string(at);
    if (strncmp(at, "null", 4) == 0)
        return at + 4;
    if ((*at == '-' || (*at >= '0' && *at <= '9')) && wo_number_read(at, &end, &number))
        return end;
    return NULL;
}

static bool is_json(const char *text)
{
    const char *const end = blanks(read_value(blanks(text)));
    return end && *end == '\0';
}

static void the_reader_of_these_tests_is_strict(void **state)
{
    (void)state;
    assert_true(is_json("{\"a\": [1, -2.5e3, null], \"b\": {}}"));
    assert_false(is_json("{\"a\": nan}"));
    assert_false(is_json("{\"a\": 1,}"));
    assert_false(is_json("{\"a\" 1}"));
    assert_false(is_json("{\"a\": \"\n\"}"));
    assert_false(is_json("{\"a\": \"\\q\"}"));
    assert_false(is_json("{\"a\": 1"));
    assert_false(is_json("{} {}"));
}

static char *json(const wo_report *report)
{
    const int length = wo_report_json(report, NULL, 0);
    assert_true(length > 0);
    char *const text = malloc((size_t)length + 1);
    assert_non_null(text);
    assert_int_equal(wo_report_json(report, text, (size_t)length + 1), length);
    assert_int_equal(strlen(text), length);
    return text;
}

static wo_report full(void)
{
    wo_report r = {.pixels = 100,
                   .rays = 6400,
                   .steps = INT64_MAX,
                   .guessed = 0.125,
                   .guessed_pixels = 3,
                   .sanitised_colour = 4,
                   .sanitised_depth = 5,
                   .edge_depth = 6,
                   .clamped_radius = 7,
                   .largest_radius = 12.5};
    for (int i = 0; i < WO_STAGE_COUNT; i++)
        r.seconds[i] = i + 0.5;
    for (int i = 0; i < WO_TILE_CLASS_COUNT; i++)
        r.tiles[i] = 10 + i;
    wo_report_leave_out(&r, "march", "one surface", 3, "tiles");
    return r;
}

static void names_exist(void **state)
{
    (void)state;
    assert_string_equal(wo_stage_text(WO_STAGE_INPUT), "input");
    assert_string_equal(wo_stage_text(WO_STAGE_OUTPUT), "output");
    assert_string_equal(wo_stage_text((wo_stage)WO_STAGE_COUNT), "unknown");
    assert_string_equal(wo_tile_class_text(WO_TILE_MARCH), "march");
    assert_string_equal(wo_tile_class_text((wo_tile_class)-1), "unknown");
}

static void a_report_is_one_json_object(void **state)
{
    (void)state;
    const wo_report r = full();
    char *const text = json(&r);
    assert_true(is_json(text));
    assert_non_null(strstr(text, "\"input\": 0.5,"));
    assert_non_null(strstr(text, "\"total\": 12.5}"));
    assert_non_null(strstr(text, "\"steps\": 9223372036854775807,"));
    assert_non_null(strstr(text, "\"tiles\": {\"empty\": 10, \"sharp\": 11, "));
    assert_non_null(strstr(text, "\"guessed\": 0.125,"));
    assert_non_null(strstr(text, "\"clamped_radius\": 7,"));
    assert_non_null(strstr(text, "[{\"what\": \"march\", \"why\": \"one surface\", "
                                 "\"amount\": 3, \"unit\": \"tiles\"}]"));
    free(text);
    char *const zero = json(&(wo_report){.pixels = 0});
    assert_true(is_json(zero));
    assert_non_null(strstr(zero, "\"left_out\": []"));
    free(zero);
}

static void odd_texts_and_numbers_stay_json(void **state)
{
    (void)state;
    wo_report r = full();
    r.seconds[0] = NAN;
    r.largest_radius = INFINITY;
    wo_report_leave_out(&r, "quote \" backslash \\ tab \t", "gr\xc3\xbc\xc3\x9f", -INFINITY, NULL);
    wo_report_leave_out(&r, "broken \xff \xc3", "\xed\xa0\x80 \xc0\xaf \xf4\x90\x80\x80", 1,
                        "\x7f");
    char *const text = json(&r);
    assert_true(is_json(text));
    assert_non_null(strstr(text, "\"input\": null"));
    assert_non_null(strstr(text, "\"largest_radius\": null"));
    assert_non_null(strstr(text, "quote \\\" backslash \\\\ tab \\u0009"));
    assert_non_null(strstr(text, "gr\xc3\xbc\xc3\x9f"));
    assert_non_null(strstr(text, "broken \\ufffd \\ufffd"));
    for (const char *at = text; *at; at++)
        assert_false((unsigned char)*at >= 0xed);
    free(text);
}

static void short_buffers_hold_an_empty_object(void **state)
{
    (void)state;
    const wo_report r = full();
    const int length = wo_report_json(&r, NULL, 0);
    char text[2048];
    assert_true((size_t)length < sizeof text);
    for (size_t size = 1; size <= (size_t)length; size++) {
        memset(text, 'g', sizeof text);
        assert_int_equal(wo_report_json(&r, text, size), length);
        assert_string_equal(text, size > 2 ? "{}" : "");
        assert_int_equal(text[size], 'g');
    }
}

static void omissions_add_up_and_stop_at_the_limit(void **state)
{
    (void)state;
    wo_report r = {.pixels = 0};
    static const char *const names[] = {"a", "b", "c", "d", "e", "f", "g", "h", "i",
                                        "j", "k", "l", "m", "n", "o", "p", "q", "r"};
    _Static_assert(WO_COUNT(names) > WO_LEFT_OUT_MAX, "more names than rows");
    for (int round = 1; round <= 2; round++) {
        for (size_t i = 0; i < WO_COUNT(names); i++)
            wo_report_leave_out(&r, names[i], "same", 1.5, "px");
        assert_int_equal(r.left_out_count, WO_LEFT_OUT_MAX);
        for (int i = 0; i < WO_LEFT_OUT_MAX; i++)
            assert_true(r.left_out[i].amount == 1.5 * round);
    }
    r.left_out_count = 1;
    wo_report_leave_out(&r, "a", "other", 2, "px");
    assert_int_equal(r.left_out_count, 2);
    assert_string_equal(r.left_out[1].why, "other");
    r.left_out_count = 1000;
    wo_report_leave_out(&r, "z", "z", 2, "px");
    assert_int_equal(r.left_out_count, 1000);
    wo_report_leave_out(NULL, "z", "z", 2, "px");
}

static void parts_make_a_total(void **state)
{
    (void)state;
    const wo_report part = full();
    wo_report total = {.pixels = 0};
    wo_report_add(&total, &part);
    assert_memory_equal(total.seconds, part.seconds, sizeof part.seconds);
    assert_memory_equal(total.tiles, part.tiles, sizeof part.tiles);
    assert_true(total.guessed == part.guessed);

    wo_report other = {.pixels = 300, .rays = 1, .guessed = 0.5, .largest_radius = 3};
    wo_report_leave_out(&other, "march", "one surface", 4, "tiles");
    wo_report_leave_out(&other, "mask", "none", 1, "clips");
    total.steps = 1;
    wo_report_add(&total, &other);
    assert_int_equal(total.pixels, 400);
    assert_int_equal(total.rays, 6401);
    assert_int_equal(total.edge_depth, 6);
    assert_true(fabs(total.guessed - (0.125 * 100 + 0.5 * 300) / 400) < 1e-15);
    assert_true(total.largest_radius == 12.5);
    assert_int_equal(total.left_out_count, 2);
    assert_true(total.left_out[0].amount == 7);
    assert_string_equal(total.left_out[1].what, "mask");
    wo_report_add(NULL, &other);
    wo_report_add(&total, NULL);
    assert_int_equal(total.pixels, 400);
}

static void warnings_are_said_once(void **state)
{
    (void)state;
    char longest[2 * WO_WARNING_SIZE];
    wo_report r = {.pixels = 0};
    memset(longest, 'x', sizeof longest - 1);
    longest[sizeof longest - 1] = '\0';
    wo_report_warn(&r, "depth-negative", "%d %% of the \"depth\" is negative", 93);
    wo_report_warn(&r, "depth-negative", "%d %% of the depth is negative", 5);
    wo_report_warn(&r, "longest", "%s", longest);
    assert_int_equal(r.warning_count, 2);
    assert_string_equal(r.warnings[0].text, "93 % of the \"depth\" is negative");
    assert_int_equal(strlen(r.warnings[1].text), WO_WARNING_SIZE - 1);
    char *text = json(&r);
    assert_true(is_json(text));
    assert_non_null(strstr(text, "\"warnings\": [{\"key\": \"depth-negative\", \"text\": "
                                 "\"93 % of the \\\"depth\\\" is negative\"}, {\"key\": "
                                 "\"longest\", "));
    free(text);

    wo_report total = {.pixels = 0};
    wo_report_warn(&total, "longest", "short %s", "%s");
    wo_report_add(&total, &r);
    wo_report_add(&total, &r);
    assert_int_equal(total.warning_count, 2);
    assert_string_equal(total.warnings[0].text, "short %s");
    assert_string_equal(total.warnings[1].text, r.warnings[0].text);

    static const char *const keys[] = {"a", "b", "c", "d", "e", "f", "g", "h", "i", "j"};
    _Static_assert(WO_COUNT(keys) > WO_WARNINGS_MAX, "more keys than rows");
    for (size_t i = 0; i < WO_COUNT(keys); i++)
        wo_report_warn(&total, keys[i], "%s", keys[i]);
    assert_int_equal(total.warning_count, WO_WARNINGS_MAX);
    wo_report_warn(NULL, "a", "a");
    text = json(&(wo_report){.pixels = 0});
    assert_non_null(strstr(text, "\"warnings\": []"));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_reader_of_these_tests_is_strict),
        cmocka_unit_test(names_exist),
        cmocka_unit_test(a_report_is_one_json_object),
        cmocka_unit_test(odd_texts_and_numbers_stay_json),
        cmocka_unit_test(short_buffers_hold_an_empty_object),
        cmocka_unit_test(omissions_add_up_and_stop_at_the_limit),
        cmocka_unit_test(parts_make_a_total),
        cmocka_unit_test(warnings_are_said_once),
    };
    return cmocka_run_group_tests_name("report", tests, NULL, NULL);
}
