/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "host_fixture.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Parameters through the public functions: text in, text out, and what the plugin is told. */

static wo_host *host;
static wo_host_instance *instance;

static int set_up(void **state)
{
    (void)state;
    host = fixture_host("good", 1, true, 0);
    instance = fixture_instance(host, "Good", "General");
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    wo_host_instance_destroy(&instance);
    fixture_no_violations(host);
    wo_host_destroy(&host);
    return 0;
}

static void text_is_read_back(void **state)
{
    static const struct {
        const char *name, *text, *back;
    } cases[] = {
        {"gain", "2.8", "2.8"},
        {"gain", " 1e-3 ", "0.001"},
        {"count", "-7", "-7"},
        {"count", "3.0", "3"},
        {"invert", "true", "true"},
        {"invert", "OFF", "false"},
        {"invert", "1", "true"},
        {"shape", "Long Box", "Long Box"},
        {"shape", "hexagon", "Hexagon"},
        {"shape", "longBox", "Long Box"},
        {"shape", "0", "Box"},
        {"pick", "one", "one"},
        {"pick", "The Two", "two"},
        {"pick", "0", "one"},
        {"centre", "0.5,0.25", "0.5,0.25"},
        {"centre", "3, -4", "3,-4"},
        {"centre", "6", "6,6"},
        {"axis", "1,2,3", "1,2,3"},
        {"cells", "4,5", "4,5"},
        {"voxels", "9", "9,9,9"},
        {"tint", "0.1,0.2,0.3", "0.1,0.2,0.3"},
        {"paint", "1,0.5,0,1", "1,0.5,0,1"},
        {"note", "x@1:y, and so on", "x@1:y, and so on"},
        {"remark", "", ""},
        {"blob", "@1:2", "@1:2"},
    };
    char back[128];
    (void)state;
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        ok(wo_host_param_set_text(instance, cases[i].name, cases[i].text, &ok_error));
        const int length = wo_host_param_get_text(instance, cases[i].name, 1, back, sizeof back);
        assert_string_equal(back, cases[i].back);
        assert_int_equal(length, strlen(back));
        assert_int_equal(wo_host_param_key_count(instance, cases[i].name), 0);
    }
    assert_int_equal(wo_host_param_get_text(instance, "centre", 1, back, 2), 3); /* "6,6" is cut */
    assert_string_equal(back, "6");
}

static void defaults_are_those_described(void **state)
{
    double v[4];
    char text[64];
    (void)state;
    ok(wo_host_param_get(instance, "centre", 1, v, 2, &ok_error));
    assert_true(v[0] == 20 && v[1] == 7.5); /* fractions of 40 x 30 */
    ok(wo_host_param_get(instance, "gain", 1, v, 1, &ok_error));
    assert_true(v[0] == 1);
    assert_true(wo_host_param_get_text(instance, "pick", 1, text, sizeof text) > 0);
    assert_string_equal(text, "two");
    assert_true(wo_host_param_get_text(instance, "remark", 1, text, sizeof text) > 0);
    assert_string_equal(text, "a text, with commas");
}

static void wrong_text_changes_nothing(void **state)
{
    static const struct {
        const char *name, *text;
        wo_status status;
        const char *says;
    } cases[] = {
        {"gain", "fast", WO_ERR_ARGUMENT, "takes 1 number, not \"fast\""},
        {"gain", "", WO_ERR_ARGUMENT, "takes 1 number"},
        {"gain", "1,2", WO_ERR_ARGUMENT, "takes 1 number"},
        {"gain", "2x", WO_ERR_ARGUMENT, "takes 1 number"},
        {"gain", "11", WO_ERR_RANGE, "gain is 11; it may be 0 to 10"},
        {"gain", "-0.5", WO_ERR_RANGE, "0 to 10"},
        {"gain", "nan", WO_ERR_RANGE, "finite"},
        {"gain", "inf", WO_ERR_RANGE, "finite"},
        {"count", "1.5", WO_ERR_RANGE, "whole number"},
        {"count", "1e10", WO_ERR_RANGE, "it may be"},
        {"centre", "1,2,3", WO_ERR_ARGUMENT, "takes 2 numbers"},
        {"centre", "1,", WO_ERR_ARGUMENT, "takes 2 numbers"},
        {"paint", "1,2,3,4,5", WO_ERR_ARGUMENT, "takes 4 numbers"},
        {"invert", "maybe", WO_ERR_ARGUMENT, "true or false"},
        {"shape", "star", WO_ERR_RANGE, "no choice \"star\"; it has: Box, Long Box, Hexagon"},
        {"shape", "3", WO_ERR_RANGE, "no choice"},
        {"shape", "-1", WO_ERR_RANGE, "no choice"},
        {"pick", "three", WO_ERR_RANGE, "The One, The Two"},
        {"nobody", "1", WO_ERR_NOT_FOUND, "no parameter \"nobody\""},
        {"reset", "1", WO_ERR_UNSUPPORTED, "no value"},
        {"main", "1", WO_ERR_UNSUPPORTED, "no value"},
        {"gain", "key@1:2,key@2:99", WO_ERR_RANGE, "0 to 10"},
        {"gain", "@1:,@2:3", WO_ERR_ARGUMENT, "takes 1 number"},
        {"mono", "@1:1,@2:0", WO_ERR_UNSUPPORTED, "cannot change over time"},
        {"gain", "@inf:1", WO_ERR_RANGE, "no frame"},
    };
    (void)state;
    ok(wo_host_param_set_text(instance, "gain", "key@1:2,key@3:4", &ok_error));
    ok(wo_host_param_set_text(instance, "shape", "Box", &ok_error));
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        wo_error error = {0};
        double value = 0;
        assert_int_equal(wo_host_param_set_text(instance, cases[i].name, cases[i].text, &error),
                         cases[i].status);
        assert_int_equal(error.status, cases[i].status);
        if (!strstr(error.text, cases[i].says))
            fail_msg("\"%s\" does not say \"%s\"", error.text, cases[i].says);
        assert_int_equal(wo_host_param_key_count(instance, "gain"), 2);
        ok(wo_host_param_get(instance, "gain", 2, &value, 1, &ok_error));
        assert_true(value == 3);
        ok(wo_host_param_get(instance, "shape", 2, &value, 1, &ok_error));
        assert_true(value == 0);
    }
    assert_int_equal(wo_host_param_set_text(instance, "gain", NULL, NULL), WO_ERR_ARGUMENT);
}

static void animation_is_read(void **state)
{
    double v[4];
    char text[64];
    (void)state;
    ok(wo_host_param_set_text(instance, "gain", "key@1:1.4,key@25:2.8", &ok_error));
    assert_int_equal(wo_host_param_key_count(instance, "gain"), 2);
    ok(wo_host_param_get(instance, "gain", 13, v, 1, &ok_error));
    assert_float_equal(v[0], 2.1, 1e-12);
    ok(wo_host_param_set_text(instance, "gain", "@25:2, @-1.5:1, @30:4", &ok_error));
    assert_int_equal(wo_host_param_key_count(instance, "gain"), 3);
    ok(wo_host_param_get(instance, "gain", -5, v, 1, &ok_error));
    assert_true(v[0] == 1);
    ok(wo_host_param_set_text(instance, "centre", "key@1:0,0,key@25:10,4", &ok_error));
    ok(wo_host_param_get(instance, "centre", 13, v, 2, &ok_error));
    assert_true(v[0] == 5 && v[1] == 2);
    ok(wo_host_param_set_text(instance, "shape", "@1:Long Box,@9:box", &ok_error));
    assert_true(wo_host_param_get_text(instance, "shape", 8, text, sizeof text) > 0);
    assert_string_equal(text, "Long Box");
    assert_true(wo_host_param_get_text(instance, "shape", 9, text, sizeof text) > 0);
    assert_string_equal(text, "Box");
    v[0] = 0.5;
    ok(wo_host_param_set_at(instance, "gain", 40, v, 1, &ok_error));
    assert_int_equal(wo_host_param_key_count(instance, "gain"), 4);
    ok(wo_host_param_set(instance, "gain", v, 1, &ok_error));
    assert_int_equal(wo_host_param_key_count(instance, "gain"), 0);
    assert_int_equal(wo_host_param_key_count(instance, "nobody"), 0);
    assert_int_equal(wo_host_param_set_at(instance, "mono", 1, v, 1, NULL), WO_ERR_RANGE);
    v[0] = 1;
    assert_int_equal(wo_host_param_set_at(instance, "mono", 1, v, 1, NULL), WO_ERR_UNSUPPORTED);
    assert_int_equal(wo_host_param_set(instance, "centre", v, 1, NULL), WO_ERR_ARGUMENT);
    assert_int_equal(wo_host_param_set(instance, "note", v, 1, NULL), WO_ERR_ARGUMENT);
    assert_int_equal(wo_host_param_get(instance, "centre", 1, v, 3, NULL), WO_ERR_ARGUMENT);
    v[0] = (double)NAN;
    assert_int_equal(wo_host_param_set(instance, "gain", v, 1, NULL), WO_ERR_RANGE);
    assert_int_equal(wo_host_param_get_text(instance, "reset", 1, text, sizeof text), -1);
}

static void other_locales_change_nothing(void **state)
{
    static const char *const names[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "C"};
    double value = 0;
    char text[32];
    (void)state;
    for (size_t i = 0; i < WO_COUNT(names) && !setlocale(LC_ALL, names[i]); i++)
        continue;
    ok(wo_host_param_set_text(instance, "gain", "2.5", &ok_error));
    ok(wo_host_param_get(instance, "gain", 1, &value, 1, &ok_error));
    assert_int_equal(wo_host_param_get_text(instance, "gain", 1, text, sizeof text), 3);
    setlocale(LC_ALL, "C");
    assert_true(value == 2.5);
    assert_string_equal(text, "2.5");
}

/* Buttons, what plugins set in answer, messages, questions, progress, keys: the plugin itself
   checks the answers of the suites. */
static void buttons_do_their_work(void **state)
{
    wo_error error = {0};
    double value = 0;
    char text[64];
    (void)state;
    fixture_message[0] = '\0';
    fixture_progress_calls = 0;
    ok(wo_host_param_press(instance, "probe", &ok_error));
    assert_string_equal(fixture_message, "found 42");
    assert_int_equal(fixture_progress_calls, 2); /* 0.5, and the end */
    ok(wo_host_param_get(instance, "gain", 1, &value, 1, &ok_error));
    assert_true(value == 10); /* 99 was set: brought to its maximum */
    assert_true(wo_host_param_visible(instance, "count"));
    ok(wo_host_param_press(instance, "reset", &ok_error));
    assert_false(wo_host_param_visible(instance, "count"));
    assert_true(wo_host_param_enabled(instance, "count"));
    assert_false(wo_host_param_enabled(instance, "nobody"));
    ok(wo_host_param_get(instance, "gain", 1, &value, 1, &ok_error));
    assert_true(value == 1);
    assert_true(wo_host_param_get_text(instance, "note", 1, text, sizeof text) > 0);
    assert_string_equal(text, "reset was pressed");
    assert_int_equal(wo_host_param_press(instance, "gain", &error), WO_ERR_ARGUMENT);
    assert_int_equal(wo_host_param_press(instance, "nobody", &error), WO_ERR_NOT_FOUND);
    assert_string_equal(wo_host_persistent_message(instance), "");
    wo_host_set_notify(instance, false);
    ok(wo_host_param_set_text(instance, "gain", "3", &ok_error));
}

#define with_instance(test) cmocka_unit_test_setup_teardown(test, set_up, tear_down)

/* What a plugin says when it fails arrives whole: in the error, or else as a message. */
static void reasons_arrive_whole(void **state)
{
    char reason[3001];
    (void)state;
    wo_host *fresh = fixture_host("fresh", 1, false, 0);
    wo_host_instance *one = fixture_instance(fresh, "Fresh", NULL);
    const wo_host_render_args args = {.time = 1, .scale_x = 1, .scale_y = 1};
    static const size_t lengths[] = {20, 150, 3000};
    for (size_t i = 0; i < WO_COUNT(lengths); i++) {
        wo_image image = {0};
        wo_error error = {0};
        for (size_t k = 0; k < lengths[i]; k++)
            reason[k] = (char)('a' + k % 26);
        reason[lengths[i]] = '\0';
        assert_int_equal(setenv("WO_TEST_REFUSES", reason, 1), 0);
        fixture_message[0] = '\0';
        assert_int_equal(wo_host_render(one, &args, &image, NULL, &error), WO_ERR_LIBRARY);
        assert_int_equal(unsetenv("WO_TEST_REFUSES"), 0);
        assert_non_null(strstr(error.text, "Render: kOfxStatFailed: abc"));
        if (lengths[i] < sizeof error.text - 60) {
            assert_non_null(strstr(error.text, reason));
            assert_string_equal(fixture_message, "");
        } else {
            assert_string_equal(fixture_message, reason);
        }
        assert_string_equal(wo_host_persistent_message(one), reason);
    }
    wo_host_instance_destroy(&one);
    wo_host_destroy(&fresh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reasons_arrive_whole),
        with_instance(text_is_read_back),
        with_instance(defaults_are_those_described),
        with_instance(wrong_text_changes_nothing),
        with_instance(animation_is_read),
        with_instance(other_locales_change_nothing),
        with_instance(buttons_do_their_work),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
