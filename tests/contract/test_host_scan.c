/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "host_fixture.h"

#include <errno.h>
#include <fenv.h>
#include <ftw.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Folders made for one test. */
static char root[64];

static int set_up(void **state)
{
    (void)state;
    snprintf(root, sizeof root, "/tmp/wo_scan_XXXXXX");
    return mkdtemp(root) ? 0 : -1;
}

static int drop(const char *path, const struct stat *status, int type, struct FTW *walk)
{
    (void)status;
    (void)type;
    (void)walk;
    return remove(path);
}

static int tear_down(void **state)
{
    (void)state;
    return nftw(root, drop, 16, FTW_DEPTH | FTW_PHYS);
}

static void folder(const char *path)
{
    char whole[1024];
    snprintf(whole, sizeof whole, "%s/%s", root, path);
    for (char *c = whole + strlen(root) + 1;; c++) {
        if (*c && *c != '/')
            continue;
        const char was = *c;
        *c = '\0';
        if (mkdir(whole, 0700) != 0)
            assert_int_equal(errno, EEXIST);
        if (!was)
            return;
        *c = was;
    }
}

static void file(const char *path, const void *bytes, size_t count)
{
    char whole[1024];
    snprintf(whole, sizeof whole, "%s/%s", root, path);
    FILE *f = fopen(whole, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(bytes, 1, count, f), count);
    assert_int_equal(fclose(f), 0);
}

/* A bundle with these bytes where the binary belongs. */
static void bundle(const char *where, const char *name, const void *bytes, size_t count)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s.ofx.bundle/Contents/%s", where, name, WO_TEST_ARCH);
    folder(path);
    snprintf(path, sizeof path, "%s/%s.ofx.bundle/Contents/%s/%s.ofx", where, name, WO_TEST_ARCH,
             name);
    file(path, bytes, count);
}

static void link_to(const char *from, const char *target)
{
    char whole[1024];
    snprintf(whole, sizeof whole, "%s/%s", root, from);
    assert_int_equal(symlink(target, whole), 0);
}

static wo_host *scan(void)
{
    const char *directories[] = {root};
    const wo_host_config config = {.threads = 1, .directories = directories, .directory_count = 1};
    wo_host *host = NULL;
    ok(wo_host_create(&config, &host, &ok_error));
    return host;
}

static bool noted(const wo_host *host, const char *text)
{
    for (size_t i = 0; i < wo_host_note_count(host); i++)
        if (strstr(wo_host_note(host, i), text))
            return true;
    return false;
}

/* The first bytes of the true plugin: a damaged binary. */
static size_t true_plugin(unsigned char *bytes, size_t size)
{
    FILE *f =
        fopen(WO_TEST_PLUGINS "/good/Good.ofx.bundle/Contents/" WO_TEST_ARCH "/Good.ofx", "rb");
    assert_non_null(f);
    const size_t count = fread(bytes, 1, size, f);
    assert_int_equal(fclose(f), 0);
    return count;
}

static void hostile_files(void **state)
{
    static unsigned char bytes[4096];
    (void)state;
    const size_t count = true_plugin(bytes, sizeof bytes);
    bundle("a", "Empty", "", 0);
    bundle("a", "Text", "no plugin at all\n", 17);
    bundle("a", "Cut", bytes, count);
    bytes[4] = 9; /* neither 32 nor 64 bits */
    bundle("a", "Alien", bytes, count);
    folder("a/Hollow.ofx.bundle");
    folder("a/OtherMachine.ofx.bundle/Contents/Win64");
    folder("a/Folder.ofx.bundle/Contents/" WO_TEST_ARCH "/Folder.ofx");
    file("a/Loose.ofx", bytes, count);
    file("a/File.ofx.bundle", "x", 1);
    link_to("a/Lost.ofx.bundle", "nowhere");
    folder("a/.ofx.bundle");
    wo_host *host = scan();
    assert_int_equal(wo_host_plugin_count(host), 0);
    assert_true(noted(host, "Empty.ofx.bundle: "));
    assert_true(noted(host, "Text.ofx.bundle: "));
    assert_true(noted(host, "Cut.ofx.bundle: "));
    assert_true(noted(host, "Alien.ofx.bundle: "));
    assert_true(noted(host, "Hollow.ofx.bundle: no file Contents/"));
    assert_true(noted(host, "OtherMachine.ofx.bundle: no file Contents/"));
    assert_true(noted(host, "Folder.ofx.bundle: no file Contents/"));
    assert_true(noted(host, "File.ofx.bundle: a bundle is a folder"));
    assert_true(noted(host, "Lost.ofx.bundle: a bundle is a folder"));
    assert_int_equal(wo_host_note_count(host), 9);
    assert_null(wo_host_note(host, 9));
    const wo_host_plugin *plugin = NULL;
    wo_error error = {0};
    assert_int_equal(wo_host_find_plugin(host, "Any", &plugin, &error), WO_ERR_NOT_FOUND);
    assert_string_equal(error.text, "no plugin \"Any\"; there are none at all");
    assert_int_equal(wo_host_find_plugin(host, "", &plugin, &error), WO_ERR_ARGUMENT);
    wo_host_destroy(&host);
}

static void names_with_at_are_skipped(void **state)
{
    (void)state;
    folder("deep/er/still");
    folder("@off");
    link_to("deep/er/still/Good.ofx.bundle", WO_TEST_PLUGINS "/good/Good.ofx.bundle");
    link_to("@off/Odd.ofx.bundle", WO_TEST_PLUGINS "/odd/Odd.ofx.bundle");
    link_to("deep/@Bad.ofx.bundle", WO_TEST_PLUGINS "/bad/Bad.ofx.bundle");
    link_to("deep/er/round", root); /* folders in a circle come to an end */
    wo_host *host = scan();
    assert_int_equal(wo_host_plugin_count(host), 1);
    assert_string_equal(wo_host_plugin_at(host, 0)->identifier, "org.wideopen.test.Good");
    assert_int_equal(wo_host_note_count(host), 0);
    wo_host_destroy(&host);
}

static void folders_may_be_missing(void **state)
{
    const char *directories[] = {"/nowhere/at/all", root};
    const wo_host_config config = {.threads = 1, .directories = directories, .directory_count = 2};
    wo_host *host = NULL;
    (void)state;
    file("plain", "x", 1);
    ok(wo_host_create(&config, &host, &ok_error));
    assert_int_equal(wo_host_note_count(host), 1);
    assert_string_equal(wo_host_note(host, 0), "/nowhere/at/all: there is no such folder");
    char path[128];
    snprintf(path, sizeof path, "%s/plain", root);
    ok(wo_host_scan(host, path, &ok_error));
    assert_true(noted(host, "plain: not a folder"));
    wo_host_destroy(&host);
}

static void odd_plugins_are_left_out(void **state)
{
    (void)state;
    wo_host *host = fixture_host("odd", 1, true, 0);
    const wo_host_plugin *plugin = NULL;
    wo_error error = {0};
    assert_int_equal(wo_host_plugin_count(host), 2);
    assert_true(noted(host, "plugin 0 is no image effect"));
    assert_true(noted(host, "plugin 1 is for another version of the API"));
    assert_true(noted(host, "plugin 2 has no identifier"));
    assert_true(noted(host, "plugin 3 has no identifier"));
    assert_true(noted(host, "plugin 4 lacks a function"));
    assert_true(noted(host, "plugin 5 lacks a function"));
    assert_true(noted(host, "plugin 6 is no image effect"));
    assert_true(noted(host, "org.wideopen.test.Refuses does not describe itself: kOfxStatFailed"));
    assert_true(noted(host, "org.wideopen.test.Paint has no context this host can run"));
    assert_true(noted(host, "org.wideopen.test.Byte was found before"));
    assert_true(noted(host, "plugin 12 is NULL"));
    assert_int_equal(wo_host_find_plugin(host, "Byte", &plugin, &error), WO_ERR_ARGUMENT);
    assert_non_null(strstr(error.text, "org.wideopen.test.Byte, org.other.Byte"));
    assert_int_equal(wo_host_find_plugin(host, "Sharp", &plugin, &error), WO_ERR_NOT_FOUND);
    assert_non_null(strstr(error.text, "there is: org.wideopen.test.Byte, org.other.Byte"));
    assert_int_equal(wo_host_find_plugin(host, "TEST.by", &plugin, &error), WO_ERR_NOT_FOUND);
    assert_string_equal(error.text, "no plugin \"TEST.by\"; did you mean org.wideopen.test.Byte");
    ok(wo_host_find_plugin(host, "org.wideopen.test.Byte", &plugin, &ok_error));
    assert_int_equal(plugin->version_minor, 1);
    assert_false(plugin->float_pixels);
    const wo_host_project project = WO_HOST_PROJECT_INIT;
    wo_host_instance *instance = NULL;
    assert_int_equal(wo_host_instance_create(host, plugin, NULL, &project, &instance, &error),
                     WO_ERR_UNSUPPORTED);
    fixture_no_violations(host);
    wo_host_destroy(&host);
}

static void binaries_may_refuse(void **state)
{
    (void)state;
    wo_host *host = fixture_host("shy", 1, true, 0);
    assert_int_equal(wo_host_plugin_count(host), 0);
    assert_true(noted(host, "Shy.ofx.bundle: it does not want this host"));
    assert_true(noted(host, "Half.ofx.bundle: it exports no OfxGetPlugin"));
    wo_host_destroy(&host);
}

static void search_path(void **state)
{
    static const char separators[] = ":;";
    (void)state;
    for (int i = 0; i < 2; i++) {
        char path[2048];
        const char s = separators[i];
        snprintf(path, sizeof path, "%c%s/nowhere%c%s/good%c%c%s/odd%c", s, root, s,
                 WO_TEST_PLUGINS, s, s, WO_TEST_PLUGINS, s);
        assert_int_equal(setenv("OFX_PLUGIN_PATH", path, 1), 0);
        const wo_host_config config = {.threads = 1, .search_path = true};
        wo_host *host = NULL;
        ok(wo_host_create(&config, &host, &ok_error));
        const wo_host_plugin *plugin = NULL;
        ok(wo_host_find_plugin(host, "Good", &plugin, &ok_error));
        ok(wo_host_find_plugin(host, "org.other.Byte", &plugin, &ok_error));
        wo_host_destroy(&host);
    }
    assert_int_equal(unsetenv("OFX_PLUGIN_PATH"), 0);
}

static void scanning_again_adds_nothing(void **state)
{
    (void)state;
    wo_host *host = scan();
    wo_error error = {0};
    assert_int_equal(wo_host_plugin_count(host), 0);
    ok(wo_host_scan(host, WO_TEST_PLUGINS "/good", &ok_error));
    assert_int_equal(wo_host_plugin_count(host), 1);
    ok(wo_host_scan(host, WO_TEST_PLUGINS "/good", &ok_error));
    assert_int_equal(wo_host_plugin_count(host), 1);
    assert_true(noted(host, "was found before"));
    assert_int_equal(wo_host_scan(host, "", &error), WO_ERR_ARGUMENT);
    wo_host_destroy(&host);
}

/* Two lives of the struct in one host, and two hosts after each other and at once. */
static void plugins_are_fetched_again_after_unload(void **state)
{
    (void)state;
    for (int life = 0; life < 2; life++) {
        wo_host *host = fixture_host("fresh", 1, true, 0);
        wo_host *other = fixture_host("fresh", 1, true, 0);
        assert_int_equal(wo_host_plugin_count(host), 1);
        wo_host_instance *instance = fixture_instance(host, "Fresh", NULL);
        wo_image image = fixture_render(instance, 1, 1, (wo_rect){0, 0, 8, 8}, 0, NULL);
        assert_float_equal(wo_image_at(&image, 7, 7)[0], 0.5, 0);
        wo_host_image_free(&image);
        wo_host_destroy(&other);
        wo_host_instance_destroy(&instance);
        fixture_no_violations(host);
        assert_string_equal(wo_host_plugin_at(host, 0)->identifier, "org.wideopen.test.Fresh");
        wo_host_unload(host);
        assert_string_equal(wo_host_plugin_at(host, 0)->identifier, "org.wideopen.test.Fresh");
        wo_host_destroy(&host);
    }
}

/* The working directory, the mask of new files and the rounding of this thread are the caller's. */
static void plugins_change_nothing_of_the_process(void **state)
{
    char before[PATH_MAX], after[PATH_MAX];
    (void)state;
    assert_non_null(getcwd(before, sizeof before));
    const mode_t mask = umask(027);
    assert_int_equal(setenv("WO_TEST_STRAYS", "1", 1), 0);
    wo_host *host = fixture_host("fresh", 1, true, 0);
    wo_host_instance *instance = fixture_instance(host, "Fresh", NULL);
    wo_image image = fixture_render(instance, 1, 1, (wo_rect){0, 0, 8, 8}, 0, NULL);
    const int rounding = fegetround();
    const mode_t left = umask(mask);
    assert_non_null(getcwd(after, sizeof after));
    assert_int_equal(unsetenv("WO_TEST_STRAYS"), 0);
    assert_int_equal(rounding, FE_TONEAREST);
    assert_int_equal(left, 027);
    assert_string_equal(after, before);
    wo_host_image_free(&image);
    wo_host_instance_destroy(&instance);
    wo_host_destroy(&host);
}

#define with_folder(test) cmocka_unit_test_setup_teardown(test, set_up, tear_down)

int main(void)
{
    const struct CMUnitTest tests[] = {
        with_folder(hostile_files),
        with_folder(names_with_at_are_skipped),
        with_folder(folders_may_be_missing),
        cmocka_unit_test(odd_plugins_are_left_out),
        cmocka_unit_test(binaries_may_refuse),
        with_folder(search_path),
        with_folder(scanning_again_adds_nothing),
        cmocka_unit_test(plugins_are_fetched_again_after_unload),
        cmocka_unit_test(plugins_change_nothing_of_the_process),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
