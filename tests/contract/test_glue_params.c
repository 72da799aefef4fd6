/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "glue_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

/* Hosts that do without some parameter: its default is taken, and the user is told. */

static const wo_rect full = {0, 0, 12, 7};

static void pictures(void)
{
    picture_make(&mock.pictures[0], full, kOfxBitDepthFloat, kOfxImageComponentRGBA, 0, 1);
    picture_make(&mock.pictures[MOCK_OUTPUT], full, kOfxBitDepthFloat, kOfxImageComponentRGBA, 0,
                 9);
}

/* One parameter of each type; what it is set to, and what that makes of the effect's. */
typedef struct row {
    const char *name;
    double values[3];
} row;

static const row rows[] = {
    {"radius", {5, 0, 0}},  {"angle", {30, 0, 0}},   {"repeats", {3, 0, 0}}, {"on", {0, 0, 0}},
    {"trouble", {4, 0, 0}}, {"centre", {40, 60, 0}}, {"tint", {0.5, 2, 3}},  {"note", {0, 0, 0}},
};

static void set_all(OfxImageEffectHandle effect)
{
    for (size_t i = 0; i < WO_COUNT(rows); i++) {
        const double *const v = rows[i].values;
        mock_set_number(effect, rows[i].name, v[0], v[1], v[2]);
    }
    mock_set_text(effect, "note", "mine");
}

/* What the effect gets of what was set: all but the lost one; "" loses all. */
static void expect_all_but(expected *e, const char *lost)
{
    expect_defaults(e);
    for (size_t i = 0; i < WO_COUNT(rows) && *lost; i++)
        for (size_t k = 0; k < probe_effect.param_count; k++) {
            const wo_param *const param = &probe_effect.params[k];
            if (strcmp(rows[i].name, lost) == 0 || strcmp(rows[i].name, param->key) != 0)
                continue;
            const wo_status set = param->type == WO_PARAM_STRING
                                      ? wo_param_set_text(param, &e->params, "mine", NULL)
                                      : wo_param_set(param, &e->params, rows[i].values, NULL);
            assert_int_equal(set, WO_OK);
        }
}

static void assert_told(const char *name)
{
    assert_true(mock.persistent_set);
    assert_non_null(strstr(mock.message, "this host gives no value of"));
    assert_non_null(strstr(mock.message, name));
    assert_non_null(strstr(mock.message, "the default is taken"));
}

static void each_may_be_lost_in_each_way(void **state)
{
    (void)state;
    pictures();
    for (size_t i = 0; i < WO_COUNT(rows); i++)
        for (int lose = MOCK_LOSE_DEFINE; lose < MOCK_LOSSES; lose++) {
            expected e;
            mock.lost = rows[i].name;
            mock.lose = (mock_loss)lose;
            mock.message[0] = '\0';
            mock.persistent_set = false;
            const OfxImageEffectHandle effect = create(kOfxImageEffectContextGeneral);
            set_all(effect);
            picture_fill(&mock.pictures[MOCK_OUTPUT], 0x7f);
            render(effect, full, kOfxStatOK);
            expect_all_but(&e, lose == MOCK_LOSE_AT_TIME ? "nothing" : rows[i].name);
            assert_output(expect_pixels(&e, full), full);
            /* what is said may be about the trouble that was asked for, too */
            if (lose != MOCK_LOSE_AT_TIME)
                assert_told(rows[i].name);
            else
                assert_null(strstr(mock.message, "no value"));
            assert_non_null(strstr(explain(effect, full, NULL), e.params.note));
            mock_destroy(probe, effect);
        }
}

static void all_may_be_lost(void **state)
{
    (void)state;
    pictures();
    for (int lose = MOCK_LOSE_DEFINE; lose < MOCK_LOSSES; lose++) {
        expected e;
        mock.lost = "";
        mock.lose = (mock_loss)lose;
        const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
        set_all(effect);
        picture_fill(&mock.pictures[MOCK_OUTPUT], 0x7f);
        render(effect, full, kOfxStatOK);
        expect_all_but(&e, lose == MOCK_LOSE_AT_TIME ? "nothing" : "");
        assert_output(expect_pixels(&e, full), full);
        if (lose != MOCK_LOSE_AT_TIME)
            assert_told("radius, angle, repeats, on, trouble, centre, tint, note:");
        mock_destroy(probe, effect);
    }
}

static void a_host_may_know_one_time_only(void **state)
{
    (void)state;
    expected e;
    pictures();
    assert_int_equal(probe->mainEntry(kOfxActionUnload, NULL, NULL, NULL), kOfxStatOK);
    mock.flags = MOCK_TIMELESS;
    assert_int_equal(probe->mainEntry(kOfxActionLoad, NULL, NULL, NULL), kOfxStatOK);
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    set_all(effect);
    mock_set_number(effect, "trouble", 0, 0, 0);
    render(effect, full, kOfxStatOK);
    expect_all_but(&e, "trouble");
    assert_output(expect_pixels(&e, full), full);
    assert_false(mock.persistent_set);
    mock_destroy(probe, effect);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, fixture_load, fixture_unload)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(each_may_be_lost_in_each_way),
        TEST(all_may_be_lost),
        TEST(a_host_may_know_one_time_only),
    };
    return cmocka_run_group_tests_name("glue and parameters", tests, fixture_open, fixture_close);
}
