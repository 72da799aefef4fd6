/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "host_fixture.h"

#include "suites.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The parts below the plugins: property sets, handles, keys, number text, regions. */

/* Plugin functions called by hand, in no action: the host writes that down. */
static const OfxPropertySuiteV1 *const suite = &wo_property_suite;

static void properties_keep_their_kind(void **state)
{
    (void)state;
    wo_host *host = NULL;
    wo_props props;
    ok(wo_host_create(&(wo_host_config){.threads = 1}, &host, &ok_error));
    wo_props_init(&props, host, WO_PROPS_ACTION, "a set");
    wo_props_add_one(&props, "OfxInts", WO_PROP_INT, 2, true);
    wo_props_add_one(&props, "OfxTexts", WO_PROP_STRING, 0, true);
    wo_props_add_one(&props, "OfxFixed", WO_PROP_DOUBLE, 1, false);
    wo_props_add_one(&props, "OfxPointer", WO_PROP_POINTER, 1, true);
    wo_props_set_double(&props, "OfxFixed", 0, 1.5);
    assert_false(props.failed);
    const OfxPropertySetHandle set = (OfxPropertySetHandle)props.handle;
    const wo_frame frame = {.host = NULL};
    wo_frame_set(&frame); /* as if in an action */

    int ints[3] = {0}, count = 0;
    char *texts[3] = {0};
    double number = 0;
    void *pointer = NULL;
    const int two[] = {7, 8};
    const char *const three[] = {"a", "", "c"};
    assert_int_equal(suite->propSetIntN(set, "OfxInts", 2, two), kOfxStatOK);
    assert_int_equal(suite->propGetIntN(set, "OfxInts", 2, ints), kOfxStatOK);
    assert_true(ints[0] == 7 && ints[1] == 8);
    assert_int_equal(suite->propSetIntN(set, "OfxInts", 3, two), kOfxStatErrBadIndex);
    assert_int_equal(suite->propSetInt(set, "OfxInts", 2, 1), kOfxStatErrBadIndex);
    assert_int_equal(suite->propSetInt(set, "OfxInts", -1, 1), kOfxStatErrBadIndex);
    assert_int_equal(suite->propGetInt(set, "OfxInts", 2, ints), kOfxStatErrBadIndex);
    assert_int_equal(suite->propGetDouble(set, "OfxInts", 0, &number), kOfxStatErrValue);
    assert_int_equal(suite->propSetStringN(set, "OfxTexts", 3, three), kOfxStatOK);
    assert_int_equal(suite->propGetDimension(set, "OfxTexts", &count), kOfxStatOK);
    assert_int_equal(count, 3);
    assert_int_equal(suite->propGetStringN(set, "OfxTexts", 3, texts), kOfxStatOK);
    assert_string_equal(texts[2], "c");
    assert_int_equal(suite->propSetString(set, "OfxTexts", 3, "d"), kOfxStatOK); /* grows */
    assert_int_equal(suite->propSetString(set, "OfxTexts", 5, "f"), kOfxStatErrBadIndex);
    assert_int_equal(suite->propGetString(set, "OfxTexts", 4, texts), kOfxStatErrBadIndex);
    assert_int_equal(suite->propSetStringN(set, "OfxTexts", 1, three), kOfxStatOK); /* shrinks */
    assert_int_equal(suite->propGetDimension(set, "OfxTexts", &count), kOfxStatOK);
    assert_int_equal(count, 1);
    assert_int_equal(suite->propReset(set, "OfxTexts"), kOfxStatOK);
    assert_int_equal(suite->propGetDimension(set, "OfxTexts", &count), kOfxStatOK);
    assert_int_equal(count, 0);
    assert_int_equal(suite->propReset(set, "OfxInts"), kOfxStatOK);
    assert_int_equal(suite->propGetInt(set, "OfxInts", 1, ints), kOfxStatOK);
    assert_int_equal(ints[0], 0);
    assert_int_equal(suite->propSetDouble(set, "OfxFixed", 0, 2), kOfxStatErrValue);
    assert_int_equal(suite->propReset(set, "OfxFixed"), kOfxStatErrValue);
    assert_int_equal(suite->propGetDouble(set, "OfxFixed", 0, &number), kOfxStatOK);
    assert_true(number == 1.5);
    assert_int_equal(suite->propSetPointer(set, "OfxPointer", 0, &number), kOfxStatOK);
    assert_int_equal(suite->propGetPointer(set, "OfxPointer", 0, &pointer), kOfxStatOK);
    assert_ptr_equal(pointer, &number);
    const size_t before = wo_host_violation_count(host);
    assert_int_equal(suite->propGetInt(set, "OfxNot", 0, ints), kOfxStatErrUnknown);
    assert_int_equal(suite->propSetInt(set, "com.vendor.thing", 0, 1), kOfxStatErrUnknown);
    assert_int_equal(suite->propGetDimension(set, "OfxNot", &count), kOfxStatErrUnknown);
    assert_int_equal(wo_host_violation_count(host), before); /* asking is no breach */
    assert_int_equal(suite->propSetInt(set, "OfxNot", 0, 1), kOfxStatErrUnknown);
    assert_int_equal(wo_host_violation_count(host), before + 1);
    wo_frame_set(NULL);
    assert_int_equal(suite->propSetInt(set, "OfxInts", 0, 1), kOfxStatFailed); /* no action */
    wo_props_clear(&props);
    assert_int_equal(suite->propGetInt(set, "OfxInts", 0, ints), kOfxStatErrBadHandle);
    fixture_violation(host, "freed already");
    wo_host_destroy(&host);
}

/* Freed handles stay invalid though their slots are used again, also by the next host. */
static void handles_do_not_come_back(void **state)
{
    static int object;
    void *old[64];
    (void)state;
    for (int life = 0; life < 3; life++) {
        wo_host *host = NULL;
        ok(wo_host_create(&(wo_host_config){.threads = 1}, &host, &ok_error));
        for (int i = 0; i < 64; i++) {
            void *handle = wo_handle_add(WO_HANDLE_MUTEX, &object);
            assert_non_null(handle);
            wo_process_lock();
            assert_ptr_equal(wo_handle_find(handle, WO_HANDLE_MUTEX), &object);
            assert_null(wo_handle_find(handle, WO_HANDLE_CLIP));
            assert_string_equal(wo_handle_fault(handle, WO_HANDLE_CLIP), "of another kind");
            wo_handle_remove(handle);
            wo_handle_remove(handle);
            assert_null(wo_handle_find(handle, WO_HANDLE_MUTEX));
            if (life > 0)
                assert_null(wo_handle_find(old[i], WO_HANDLE_MUTEX));
            for (int k = 0; k < i; k++)
                assert_ptr_not_equal(old[k], handle);
            assert_string_equal(wo_handle_fault(handle, WO_HANDLE_MUTEX), "freed already");
            wo_process_unlock();
            old[i] = handle;
        }
        wo_host_destroy(&host);
    }
}

static void numbers_are_read_and_printed(void **state)
{
    static const double values[] = {0, 1, -1, 0.1, 1.0 / 3, 1e-300, 1e300, 123456789, 2.8, -0.0};
    char text[64];
    double value = 0;
    (void)state;
    for (size_t i = 0; i < WO_COUNT(values); i++) {
        const int length = wo_print_number(text, sizeof text, values[i]);
        assert_int_equal(length, strlen(text));
        const char *end = wo_read_number(text, &value);
        assert_non_null(end);
        assert_int_equal(*end, 0);
        assert_true(value == values[i]);
    }
    wo_print_number(text, sizeof text, 0.1);
    assert_string_equal(text, "0.1");
    assert_null(wo_read_number("x", &value));
    assert_null(wo_read_number("", &value));
    assert_true(wo_words_match("Long Box", "longBox"));
    assert_true(wo_words_match("", " -"));
    assert_false(wo_words_match("Box", "Box 2"));
}

static wo_par *lone_parameter(wo_object *object, wo_entry *entry, wo_host *host, const char *type)
{
    entry->info.identifier = "org.test";
    assert_true(wo_object_init(object, host, entry, NULL, true));
    wo_par *par = wo_object_add_param(object, type, "p");
    assert_non_null(par);
    return par;
}

static void keys_are_ordered_and_joined(void **state)
{
    (void)state;
    wo_host *host = NULL;
    wo_object object;
    wo_entry entry = {0};
    double v[4] = {0};
    ok(wo_host_create(&(wo_host_config){.threads = 1}, &host, &ok_error));
    wo_par *par = lone_parameter(&object, &entry, host, kOfxParamTypeDouble2D);
    static const double times[] = {10, 0, 20, 5, 15};
    for (size_t i = 0; i < WO_COUNT(times); i++) {
        v[0] = times[i] * 2;
        v[1] = -times[i];
        assert_true(wo_par_set_key(par, times[i], v, NULL));
    }
    assert_int_equal(par->key_count, 5);
    assert_int_equal(wo_props_int(&par->props, kOfxParamPropIsAnimating, 0, 0), 1);
    for (double t = 0; t <= 20; t += 0.5) {
        wo_par_at(par, t, v);
        assert_true(v[0] == 2 * t && v[1] == -t);
    }
    wo_par_at(par, -7, v);
    assert_true(v[0] == 0);
    wo_par_at(par, 99, v);
    assert_true(v[0] == 40);
    assert_int_equal(wo_par_find_key(par, 5, 0), 1);
    assert_int_equal(wo_par_find_key(par, 5, 1), 2);
    assert_int_equal(wo_par_find_key(par, 5, -1), 0);
    assert_int_equal(wo_par_find_key(par, 0, -1), -1);
    assert_int_equal(wo_par_find_key(par, 20, 1), -1);
    assert_int_equal(wo_par_find_key(par, 3, 0), -1);
    wo_par_slope(par, 7, v);
    assert_true(v[0] == 2 && v[1] == -1);
    wo_par_slope(par, 25, v);
    assert_true(v[0] == 0);
    wo_par_integral(par, 0, 20, v);
    assert_true(v[0] == 400 && v[1] == -200);
    wo_par_integral(par, 20, 0, v);
    assert_true(v[0] == -400);
    wo_par_integral(par, 18, 25, v); /* 18 to 20 rises to 40, then stays */
    assert_true(v[0] == 38 * 2 + 40 * 5);
    v[0] = v[1] = 77;
    assert_true(wo_par_set_key(par, 5, v, NULL)); /* replaces */
    assert_int_equal(par->key_count, 5);
    assert_false(wo_par_delete_key(par, 6));
    for (size_t i = 0; i < WO_COUNT(times); i++)
        assert_true(wo_par_delete_key(par, times[i]));
    assert_int_equal(wo_props_int(&par->props, kOfxParamPropIsAnimating, 0, 1), 0);
    wo_par_at(par, 3, v);
    assert_true(v[0] == 30); /* the last key's value stays */
    wo_object_clear(&object);
    wo_host_destroy(&host);
}

static void keys_of_whole_things_step(void **state)
{
    (void)state;
    wo_host *host = NULL;
    wo_object object;
    wo_entry entry = {0};
    double v[4] = {0};
    ok(wo_host_create(&(wo_host_config){.threads = 1}, &host, &ok_error));
    wo_par *text = lone_parameter(&object, &entry, host, kOfxParamTypeString);
    assert_true(wo_par_set_key(text, 1, NULL, "one"));
    assert_true(wo_par_set_key(text, 5, NULL, "five"));
    assert_string_equal(wo_par_text_at(text, 0), "one");
    assert_string_equal(wo_par_text_at(text, 4.9), "one");
    assert_string_equal(wo_par_text_at(text, 5), "five");
    assert_true(wo_par_delete_key(text, 5));
    assert_true(wo_par_delete_key(text, 1));
    assert_string_equal(wo_par_text_at(text, 9), "one");
    wo_par *whole = wo_object_add_param(&object, kOfxParamTypeInteger, "whole");
    wo_par *flag = wo_object_add_param(&object, kOfxParamTypeBoolean, "flag");
    assert_true(wo_par_set_key(whole, 0, (double[4]){0}, NULL));
    assert_true(wo_par_set_key(whole, 4, (double[4]){2}, NULL));
    assert_true(wo_par_set_key(flag, 0, (double[4]){0}, NULL));
    assert_true(wo_par_set_key(flag, 4, (double[4]){1}, NULL));
    static const double wholes[] = {0, 1, 1, 2, 2}; /* 0, 0.5, 1, 1.5, 2 rounded to nearest */
    for (int t = 0; t <= 4; t++) {
        wo_par_at(whole, t, v);
        assert_true(v[0] == wholes[t]);
        wo_par_at(flag, t, v);
        assert_true(v[0] == (t == 4));
    }
    wo_props_set_text(&whole->props, kOfxParamInterpType, 0, kOfxParamInterpTypeConstantStep);
    wo_par_at(whole, 3, v);
    assert_true(v[0] == 0);
    wo_par_integral(flag, 0, 6, v);
    assert_true(v[0] == 2);
    wo_object_clear(&object);
    wo_host_destroy(&host);
}

static void regions_and_pixels(void **state)
{
    (void)state;
    static const struct {
        wo_host_region region;
        double sx, sy, aspect;
        wo_rect pixels;
    } cases[] = {
        {{0, 0, 10, 10}, 1, 1, 1, {0, 0, 10, 10}},
        {{0, 0, 10, 10}, 0.5, 0.25, 1, {0, 0, 5, 3}},
        {{-0.5, 0.5, 9.5, 9.2}, 1, 1, 1, {-1, 0, 10, 10}},
        {{0, 0, 20, 10}, 1, 1, 2, {0, 0, 10, 10}},
        {{0, 0, 3, 3}, 1.0 / 3, 1.0 / 3, 1, {0, 0, 1, 1}},
        {{5, 5, 5, 9}, 1, 1, 1, {0, 0, 0, 0}},
        {{5, 5, 4, 9}, 1, 1, 1, {0, 0, 0, 0}},
        {{0, 0, (double)NAN, 9}, 1, 1, 1, {0, 0, 0, 0}},
        {{-1e30, -1e30, 1e30, 1e30},
         1,
         1,
         1,
         {-WO_MAX_COORDINATE, -WO_MAX_COORDINATE, WO_MAX_COORDINATE, WO_MAX_COORDINATE}},
    };
    for (size_t i = 0; i < WO_COUNT(cases); i++)
        assert_true(wo_rect_equal(
            wo_region_pixels(cases[i].region, cases[i].sx, cases[i].sy, cases[i].aspect),
            cases[i].pixels));
    /* There and back again is the same, at all scales. */
    for (int32_t x = -1000; x < 1000; x += 13)
        for (double scale = 0.03; scale < 2; scale *= 1.37) {
            const wo_rect r = {x, x / 2, x + 7, x / 2 + 11};
            assert_true(
                wo_rect_equal(wo_region_pixels(wo_pixels_region(r, scale, scale / 3, 1.0940), scale,
                                               scale / 3, 1.0940),
                              r));
        }
}

static void components_are_converted(void **state)
{
    (void)state;
    const float rgba[] = {1, 2, 3, 4}, rgb[] = {5, 6, 7}, one[] = {8};
    float to[4] = {0};
    wo_convert_row(rgba, 4, to, 1, 1);
    assert_true(to[0] == 4);
    wo_convert_row(rgba, 4, to, 3, 1);
    assert_true(to[0] == 1 && to[2] == 3);
    wo_convert_row(rgb, 3, to, 4, 1);
    assert_true(to[0] == 5 && to[2] == 7 && to[3] == 1);
    wo_convert_row(rgb, 3, to, 1, 1);
    assert_true(to[0] == 5);
    wo_convert_row(one, 1, to, 4, 1);
    assert_true(to[0] == 8 && to[1] == 8 && to[2] == 8 && to[3] == 1);
    wo_convert_row(one, 1, to, 3, 1);
    assert_true(to[2] == 8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(properties_keep_their_kind),
        cmocka_unit_test(handles_do_not_come_back),
        cmocka_unit_test(numbers_are_read_and_printed),
        cmocka_unit_test(keys_are_ordered_and_joined),
        cmocka_unit_test(keys_of_whole_things_step),
        cmocka_unit_test(regions_and_pixels),
        cmocka_unit_test(components_are_converted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
