/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/status.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static void every_status_has_its_own_text(void **state)
{
    (void)state;
    for (int i = 0; i < WO_STATUS_COUNT; i++) {
        assert_non_null(wo_status_text((wo_status)i));
        assert_true(strlen(wo_status_text((wo_status)i)) > 1);
        for (int j = 0; j < i; j++)
            assert_string_not_equal(wo_status_text((wo_status)i), wo_status_text((wo_status)j));
    }
    assert_string_equal(wo_status_text(WO_OK), "ok");
    assert_string_equal(wo_status_text(WO_ABORTED), "aborted");
}

static void numbers_outside_the_list_have_a_text_too(void **state)
{
    (void)state;
    assert_string_equal(wo_status_text((wo_status)WO_STATUS_COUNT), "unknown status");
    assert_string_equal(wo_status_text((wo_status)1000), "unknown status");
    assert_string_equal(wo_status_text((wo_status)-1), "unknown status");
}

static void failing_fills_the_error(void **state)
{
    (void)state;
    wo_error error = {WO_OK, ""};
    assert_int_equal(wo_fail(&error, WO_ERR_RANGE, "radius %d is outside 0..%d", 7, 5),
                     WO_ERR_RANGE);
    assert_int_equal(error.status, WO_ERR_RANGE);
    assert_string_equal(error.text, "radius 7 is outside 0..5");
    assert_int_equal(wo_fail(NULL, WO_ERR_IO, "%s", "nobody listens"), WO_ERR_IO);
}

static void long_text_is_cut(void **state)
{
    (void)state;
    struct {
        wo_error error;
        char guard[8];
    } box;
    memset(&box, 'g', sizeof box);
    char text[1000];
    memset(text, 'x', sizeof text);
    text[sizeof text - 1] = '\0';
    wo_fail(&box.error, WO_ERR_IO, "%s", text);
    assert_int_equal(strlen(box.error.text), sizeof box.error.text - 1);
    assert_memory_equal(box.guard, "gggggggg", 8);
}

static int tries;

static wo_status fails_with(wo_status status)
{
    WO_TRY(status);
    tries++;
    return WO_OK;
}

static void try_passes_failures_up(void **state)
{
    (void)state;
    tries = 0;
    assert_int_equal(fails_with(WO_ERR_NOMEM), WO_ERR_NOMEM);
    assert_int_equal(tries, 0);
    assert_int_equal(fails_with(WO_OK), WO_OK);
    assert_int_equal(tries, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_status_has_its_own_text),
        cmocka_unit_test(numbers_outside_the_list_have_a_text_too),
        cmocka_unit_test(failing_fills_the_error),
        cmocka_unit_test(long_text_is_cut),
        cmocka_unit_test(try_passes_failures_up),
    };
    return cmocka_run_group_tests_name("status", tests, NULL, NULL);
}
