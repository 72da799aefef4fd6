/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "apart_fixture.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#define TEST    "org.wideopen.test."
#define PATIENT 60 /* seconds: for what must not be killed on a busy machine */
#define HASTY   3  /* for what never answers */

static const char *const faulty[] = {WO_TEST_PLUGINS "/faulty", NULL};
static const char *const hanging[] = {WO_TEST_PLUGINS "/hanging", NULL};

/* Which of the three plugins of a binary are found: "FML". */
static void assert_has(const wo_host *host, const char *fault, const char *expected)
{
    static const char *const names[] = {"First", "Middle", "Last"};
    char found[4] = "---", identifier[128];
    for (int i = 0; i < 3; i++) {
        snprintf(identifier, sizeof identifier, TEST "%s.%s", fault, names[i]);
        if (apart_found(host, identifier))
            found[i] = names[i][0];
    }
    if (strcmp(found, expected) != 0)
        fail_msg("%s: %s instead of %s", fault, found, expected);
}

static void faults_stay_where_they_are(void **state)
{
    (void)state;
    wo_host *host = apart_host(faulty, NULL, PATIENT);
    ok(wo_host_survey(host, &ok_error));
    assert_has(host, "LoadCrash", "---");
    apart_failure(host, "/LoadCrash.ofx.bundle: crashed (signal 6, ", ") while it was loaded");
    apart_failure(host, "/LoadCrash.ofx.bundle: ", "; it said: missing");
    assert_has(host, "LoadExit", "---");
    apart_failure(host, "/LoadExit.ofx.bundle: ended its process (code ", "while it was loaded");
    assert_has(host, "LoadShout", "FML");
    assert_has(host, "DescribeCrash", "F-L");
    apart_failure(host, "/DescribeCrash.ofx.bundle: crashed (signal 6, ",
                  "while " TEST "DescribeCrash.Middle described itself");
    assert_has(host, "DescribeExit", "F-L");
    apart_failure(host, "/DescribeExit.ofx.bundle: ended its process (code 3) ",
                  "while " TEST "DescribeExit.Middle described itself");
    assert_has(host, "DescribeThread", "FML");
    /* Without a Source it is no filter, and with General no fault; the others are only filters. */
    assert_has(host, "DescribeMerge", "-M-");
    const wo_host_found *merge = apart_found(host, TEST "DescribeMerge.Middle");
    assert_int_equal(merge->context_count, 1);
    assert_string_equal(merge->contexts[0], "General");
    assert_int_equal(merge->breaches, 0);
    apart_failure(host, TEST "DescribeMerge.First", "the clip \"Source\" is not defined");
    apart_failure(host, TEST "DescribeMerge.Last", "kOfxStatFailed");
    assert_has(host, "DescribeWrong", "FML");
    assert_has(host, "UnloadCrash", "FML");
    apart_failure(host, "/UnloadCrash.ofx.bundle: crashed (signal 6, ", "while it was unloaded");
    assert_has(host, "CountMany", "---");
    apart_failure(host, "/CountMany.ofx.bundle: ", "too many plugins");
    assert_has(host, "CountNegative", "---");
    apart_failure(host, "/CountNegative.ofx.bundle: ", "no plugins");
    assert_has(host, "GetCrash", "F-L");
    apart_failure(host, "/GetCrash.ofx.bundle: crashed (signal 6, ", "while plugin 1 was fetched");
    assert_has(host, "GetNull", "F-L");
    apart_failure(host, "/GetNull.ofx.bundle: ", "plugin 1 is NULL");
    assert_int_equal(wo_host_failure_count(host), 11);
    /* What they say of themselves is one line; who breaks rules is told apart. */
    const wo_host_found *wrong = apart_found(host, TEST "DescribeWrong.Middle");
    assert_string_equal(wrong->label, "A label that is longer than any column");
    assert_int_equal(wrong->breaches, 2);
    assert_non_null(strstr(wrong->breach, "NoSuchThing"));
    assert_int_equal(apart_found(host, TEST "DescribeWrong.First")->breaches, 0);
    assert_int_equal(wrong->context_count, 1);
    assert_string_equal(wrong->contexts[0], "Generator");
    fixture_no_violations(host);
    assert_int_equal(wo_host_plugin_count(host), 0); /* nothing was loaded here */
    wo_host_destroy(&host);
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1); /* nobody is left */
    assert_int_equal(errno, ECHILD);
}

static void who_hangs_is_killed_and_named(void **state)
{
    (void)state;
    wo_host *host = apart_host(hanging, NULL, HASTY);
    ok(wo_host_survey(host, &ok_error));
    apart_failure(host, "/LoadHang.ofx.bundle: was killed ", "while it was loaded");
    apart_failure(host, "/DescribeHang.ofx.bundle: was killed ",
                  "while " TEST "DescribeHang.Middle described itself");
    apart_failure(host, "/UnloadHang.ofx.bundle: was killed ", "while it was unloaded");
    assert_has(host, "LoadHang", "---");
    assert_has(host, "DescribeHang", "F-L");
    assert_has(host, "UnloadHang", "FML");
    wo_host_destroy(&host);
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
}

/* The bundle of the name is asked alone, its neighbours are neither waited for nor judged. */
static void only_the_nearest_is_asked(void **state)
{
    static const char *const neighbours[] = {"hanging/LoadHang", "hanging/DescribeHang",
                                             "faulty/LoadCrash", "faulty/DescribeWrong"};
    const char *const folders[] = {apart_path("near"), WO_TEST_PLUGINS "/hanging", NULL};
    (void)state;
    for (size_t i = 0; i < WO_COUNT(neighbours); i++)
        apart_link("near", neighbours[i]);
    apart_link("near", "good/Good");
    wo_host *host = apart_host_with((wo_host_config){.threads = 2, .strict = true}, folders, NULL);
    const wo_host_plugin *plugin = NULL;
    for (int i = 0; i < 2; i++) {
        ok(wo_host_find_plugin(host, i ? TEST "Good" : "Good", &plugin, &ok_error));
        assert_string_equal(plugin->identifier, TEST "Good");
        assert_int_equal(plugin->context_count, 3);
        assert_int_equal(wo_host_plugin_count(host), 1);
    }
    wo_host_instance *instance = fixture_instance(host, "Good", "Filter");
    wo_host_instance_destroy(&instance);
    assert_int_equal(wo_host_note_count(host), 0);
    wo_host_unload(host);
    fixture_no_violations(host);
    wo_host_destroy(&host);
}

/* Of a binary with a plugin that crashes the others can be used, and nothing else is fetched. */
static void one_of_many_is_loaded(void **state)
{
    (void)state;
    wo_host *host = apart_host(faulty, NULL, PATIENT);
    const wo_host_plugin *plugin = NULL;
    wo_error error = {0};
    ok(wo_host_find_plugin(host, TEST "GetCrash.Last", &plugin, &ok_error));
    ok(wo_host_find_plugin(host, TEST "DescribeCrash.First", &plugin, &ok_error));
    assert_int_equal(wo_host_plugin_count(host), 2);
    assert_int_equal(wo_host_find_plugin(host, TEST "DescribeCrash.Middle", &plugin, &error),
                     WO_ERR_NOT_FOUND);
    apart_failure(host, "DescribeCrash", "crashed");
    assert_int_equal(wo_host_find_plugin(host, "First", &plugin, &error), WO_ERR_ARGUMENT);
    assert_non_null(strstr(error.text, "may be any of"));
    wo_host_destroy(&host);
}

static void fresh_ones_render(void **state)
{
    static const char *const folders[] = {WO_TEST_PLUGINS "/fresh", NULL};
    (void)state;
    wo_host *host = apart_host(folders, NULL, PATIENT);
    ok(wo_host_survey(host, &ok_error));
    assert_int_equal(wo_host_failure_count(host), 0);
    wo_host_instance *instance = fixture_instance(host, "Fresh", NULL);
    wo_image image = fixture_render(instance, 1, 1, (wo_rect){0, 0, 8, 8}, 0, NULL);
    assert_float_equal(wo_image_at(&image, 7, 7)[0], 0.5, 0);
    wo_host_image_free(&image);
    wo_host_instance_destroy(&instance);
    wo_host_destroy(&host);
}

/* Folders go before names and versions. */
static void nearer_folders_win(void **state)
{
    const char *const folders[] = {apart_path("one"), WO_TEST_PLUGINS "/odd",
                                   WO_TEST_PLUGINS "/good", NULL};
    (void)state;
    apart_link("one", "odd/Odd");
    wo_host *host = apart_host(folders, NULL, PATIENT);
    const wo_host_plugin *plugin = NULL;
    ok(wo_host_find_plugin(host, TEST "Byte", &plugin, &ok_error));
    assert_non_null(strstr(plugin->bundle, "/one/"));
    assert_int_equal(plugin->version_minor, 1);
    ok(wo_host_find_plugin(host, "Good", &plugin, &ok_error));
    ok(wo_host_survey(host, &ok_error));
    assert_int_equal(wo_host_found_count(host), 3); /* two Bytes and Good, each once */
    apart_failure(host, TEST "Refuses", "kOfxStatFailed");
    wo_host_destroy(&host);
}

static bool at_once(void *user)
{
    (void)user;
    return true;
}

static bool soon(void *user)
{
    return ++*(int *)user > 5;
}

static void surveys_can_be_stopped(void **state)
{
    int calls = 0;
    const wo_host_config configs[] = {{.threads = 8, .aborted = at_once},
                                      {.threads = 8, .aborted = soon, .user = &calls}};
    (void)state;
    for (size_t i = 0; i < WO_COUNT(configs); i++) {
        wo_host *host = apart_host_with(configs[i], hanging, NULL);
        wo_error error = {0};
        assert_int_equal(wo_host_survey(host, &error), WO_ABORTED);
        wo_host_destroy(&host);
        assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    }
    /* What was half known is not kept. */
    wo_host *host = apart_host_with(configs[1], faulty, NULL);
    calls = 0;
    wo_error error = {0};
    assert_int_equal(wo_host_survey(host, &error), WO_ABORTED);
    calls = -1000000;
    ok(wo_host_survey(host, &ok_error));
    assert_int_equal(wo_host_failure_count(host), 11);
    assert_has(host, "DescribeCrash", "F-L");
    for (size_t i = 0; i < wo_host_note_count(host); i++)
        assert_null(strstr(wo_host_note(host, i), "found before"));
    wo_host_destroy(&host);
}

static void describers_may_be_anything(void **state)
{
    static const char *const programs[][4] = {
        {"/nowhere/at/all", NULL},
        {"/bin/true", NULL},
        {"/bin/sh", "-c", "echo nonsense >&3; sleep 100", NULL},
        {"/bin/sh", "-c", "while :; do echo xxxxxxxxxxxxxxxxxxxxxxx; done >&3", NULL},
        {"/bin/sh", "-c", "sleep 100 & printf 'count\\t3\\nbegin\\t7\\n' >&3; sleep 100", NULL},
        {"/bin/sh", "-c", "sleep 100 & exec 1>&- 2>&- 3>&-; kill -9 $$", NULL},
    };
    static const char *const says[] = {"no process could be started",
                                       "ended its process (code 0)",
                                       "makes no sense",
                                       "makes no sense",
                                       "makes no sense",
                                       "crashed (signal 9"};
    static const char *const folders[] = {WO_TEST_PLUGINS "/good", NULL};
    (void)state;
    for (size_t i = 0; i < WO_COUNT(programs); i++) {
        const wo_host_config config = {.threads = 1, .describer = programs[i]};
        wo_host *host = apart_host_with(config, folders, NULL);
        ok(wo_host_survey(host, &ok_error));
        assert_int_equal(wo_host_found_count(host), 0);
        apart_failure(host, "/Good.ofx.bundle: ", says[i]);
        assert_int_equal(wo_host_failure_count(host), 1);
        wo_host_destroy(&host);
    }
}

#define with_folder(test) cmocka_unit_test_setup_teardown(test, apart_set_up, apart_tear_down)

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faults_stay_where_they_are),
        cmocka_unit_test(who_hangs_is_killed_and_named),
        with_folder(only_the_nearest_is_asked),
        cmocka_unit_test(one_of_many_is_loaded),
        cmocka_unit_test(fresh_ones_render),
        with_folder(nearer_folders_win),
        cmocka_unit_test(surveys_can_be_stopped),
        cmocka_unit_test(describers_may_be_anything),
    };
    apart_main(argc, argv);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
