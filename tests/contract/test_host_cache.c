/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "apart_fixture.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#define TEST "org.wideopen.test."

/* A describer that cannot be started: what is found then is from the cache. */
static const char *const nobody[] = {"/nowhere/at/all", NULL};

static const char *const good[] = {WO_TEST_PLUGINS "/good", NULL};

static wo_host *survey(const char *const *folders, const char *const *describer, const char *cache)
{
    const wo_host_config config = {.threads = 2, .describer = describer, .describe_seconds = 60};
    wo_host *host = apart_host_with(config, folders, cache);
    ok(wo_host_survey(host, &ok_error));
    return host;
}

static bool finds_good(const char *const *folders, const char *const *describer, const char *cache)
{
    wo_host *host = survey(folders, describer, cache);
    const wo_host_found *found = apart_found(host, TEST "Good");
    const bool there = found != NULL;
    assert_int_equal(wo_host_failure_count(host), there ? 0 : 1);
    if (there) {
        assert_string_equal(found->label, "Good");
        assert_string_equal(found->group, "Tests/Good");
        assert_int_equal(found->context_count, 3);
        assert_string_equal(found->contexts[2], "Generator");
        assert_string_equal(found->bundle + strlen(found->bundle) - 15, "Good.ofx.bundle");
    }
    wo_host_destroy(&host);
    return there;
}

/* The only file in a folder; the test fails when there are others. */
static const char *only_file(const char *folder)
{
    static char path[1024];
    int count = 0;
    DIR *list = opendir(folder);
    assert_non_null(list);
    for (const struct dirent *item = readdir(list); item; item = readdir(list)) {
        if (strcmp(item->d_name, ".") == 0 || strcmp(item->d_name, "..") == 0)
            continue;
        snprintf(path, sizeof path, "%.500s/%.255s", folder, item->d_name);
        count++;
    }
    closedir(list);
    assert_int_equal(count, 1);
    return path;
}

static size_t read_file(const char *path, char *text, size_t size)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t count = fread(text, 1, size - 1, file);
    text[count] = '\0';
    assert_int_equal(fclose(file), 0);
    return count;
}

static void write_file(const char *path, const char *text, size_t count)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, count, file), count);
    assert_int_equal(fclose(file), 0);
}

/* The last line of a cache's file, as cache.c says it is. */
static void seal(char *text, size_t size)
{
    char *end = strstr(text, "\nend\t");
    unsigned long long h = 0xcbf29ce484222325u;
    assert_non_null(end);
    for (const char *c = text; c <= end; c++)
        h = (h ^ (unsigned char)*c) * 0x100000001b3u;
    snprintf(end + 1, size - (size_t)(end + 1 - text), "end\t%016llx\n", h);
}

static void put_in_place(char *text, const char *old, const char *new)
{
    char *at = strstr(text, old);
    assert_non_null(at);
    assert_int_equal(strlen(old), strlen(new));
    memcpy(at, new, strlen(new));
}

static void what_is_known_is_not_asked_again(void **state)
{
    const char *cache = apart_path("deep/er/cache");
    char first[8192], second[8192];
    (void)state;
    assert_false(finds_good(good, nobody, NULL));
    assert_false(finds_good(good, nobody, ""));
    assert_true(finds_good(good, NULL, NULL)); /* without a cache nothing is written */
    assert_int_equal(access(apart_path("deep"), F_OK), -1);
    assert_true(finds_good(good, NULL, cache));
    read_file(only_file(cache), first, sizeof first);
    struct stat status; /* a cache may be shared */
    const mode_t mask = umask(022);
    (void)umask(mask);
    assert_int_equal(stat(only_file(cache), &status), 0);
    assert_int_equal(status.st_mode & 0777, 0666 & ~mask);
    assert_true(finds_good(good, nobody, cache));
    assert_true(finds_good(good, NULL, cache));
    read_file(only_file(cache), second, sizeof second);
    assert_string_equal(first, second);
}

static void copy_good(const char *folder)
{
    static char bytes[1 << 22];
    static const char *const steps[] = {"", "/Good.ofx.bundle", "/Good.ofx.bundle/Contents",
                                        "/Good.ofx.bundle/Contents/" WO_TEST_ARCH};
    for (size_t i = 0; i < WO_COUNT(steps); i++)
        (void)mkdir(apart_path("%s%s", folder, steps[i]), 0700);
    const size_t count =
        read_file(WO_TEST_PLUGINS "/good/Good.ofx.bundle/Contents/" WO_TEST_ARCH "/Good.ofx", bytes,
                  sizeof bytes);
    write_file(apart_path("%s%s/Good.ofx", folder, steps[3]), bytes, count);
}

static void a_changed_binary_is_another(void **state)
{
    const char *cache = apart_path("cache");
    (void)state;
    copy_good("mine");
    const char *const mine[] = {apart_path("mine"), NULL};
    const char *binary = apart_path("mine/Good.ofx.bundle/Contents/" WO_TEST_ARCH "/Good.ofx");
    assert_true(finds_good(mine, NULL, cache));
    assert_true(finds_good(mine, nobody, cache));
    const struct timespec times[2] = {{.tv_sec = 1000000000, .tv_nsec = 5},
                                      {.tv_sec = 1000000000, .tv_nsec = 5}};
    assert_int_equal(utimensat(AT_FDCWD, binary, times, 0), 0);
    assert_false(finds_good(mine, nobody, cache));
    assert_true(finds_good(mine, NULL, cache));
    assert_true(finds_good(mine, nobody, cache));
    FILE *file = fopen(binary, "ab");
    assert_non_null(file);
    assert_int_equal(fputc('x', file), 'x');
    assert_int_equal(fclose(file), 0);
    assert_int_equal(utimensat(AT_FDCWD, binary, times, 0), 0); /* another size alone */
    assert_false(finds_good(mine, nobody, cache));
    assert_true(finds_good(mine, NULL, cache));
}

static void damaged_files_are_made_anew(void **state)
{
    const char *cache = apart_path("cache");
    char whole[8192], text[8192], path[1024];
    (void)state;
    assert_true(finds_good(good, NULL, cache));
    snprintf(path, sizeof path, "%s", only_file(cache));
    const size_t count = read_file(path, whole, sizeof whole);
    for (size_t i = 0; i < count; i += i < 40 ? 1 : 7) { /* cut; one bit wrong; 0 */
        write_file(path, whole, i);
        assert_false(finds_good(good, nobody, cache));
        for (int how = 0; how < 2; how++) {
            memcpy(text, whole, count);
            text[i] = how ? '\0' : (char)(text[i] ^ 4);
            write_file(path, text, count);
            assert_false(finds_good(good, nobody, cache));
        }
    }
    assert_true(finds_good(good, NULL, cache));
    assert_true(finds_good(good, nobody, cache));
}

static void lines_that_are_none_are_refused(void **state)
{
    static const char *const lines[] = {
        "plugin\t0\t1\t0\t7\t0\ta.b\tlabel\tgroup\n",         /* a field is missing */
        "plugin\t0\t1\t0\t7\t0\ta.b\tlabel\tgroup\t\tmore\n", /* one too many */
        "plugin\t0\t1\t0\t9\t0\ta.b\tlabel\tgroup\t\n",       /* unknown contexts */
        "plugin\t-1\t1\t0\t7\t0\ta.b\tlabel\tgroup\t\n",
        "plugin\t1000\t1\t0\t7\t0\ta.b\tlabel\tgroup\t\n",
        "plugin\t0\t99999999999\t0\t7\t0\ta.b\tlabel\tgroup\t\n",
        "plugin\t0\t1\t0\t7\t0\t\tlabel\tgroup\t\n",            /* no identifier */
        "plugin\t0\t1\t0\t7\t0\ta.b\tla\x1b[31mbel\tgroup\t\n", /* paints the terminal */
        "plugin\n",
        "note\n",
        "fail\n",
        "note\ta\tb\n",
        "stranger\ta\n",
        "\n",
    };
    const char *cache = apart_path("cache");
    char whole[8192], text[16384], path[1024];
    (void)state;
    assert_true(finds_good(good, NULL, cache));
    snprintf(path, sizeof path, "%s", only_file(cache));
    read_file(path, whole, sizeof whole);
    char *end = strstr(whole, "\nend\t");
    assert_non_null(end);
    for (size_t i = 0; i < WO_COUNT(lines); i++) {
        snprintf(text, sizeof text, "%.*s%s%s", (int)(end + 1 - whole), whole, lines[i], end + 1);
        seal(text, sizeof text);
        write_file(path, text, strlen(text));
        if (finds_good(good, nobody, cache))
            fail_msg("line %zu was taken", i);
    }
}

/* What stands where the file belongs is no file, or cannot be read or written. */
static void odd_places(void **state)
{
    const char *cache = apart_path("cache");
    char path[1024];
    (void)state;
    assert_true(finds_good(good, NULL, cache));
    snprintf(path, sizeof path, "%s", only_file(cache));

    assert_int_equal(unlink(path), 0);
    assert_int_equal(mkfifo(path, 0600), 0);
    assert_true(finds_good(good, NULL, cache));
    assert_true(finds_good(good, nobody, cache)); /* replaced */

    write_file(apart_path("other"), "untouched", 9);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(symlink(apart_path("other"), path), 0);
    assert_true(finds_good(good, NULL, cache));
    assert_true(finds_good(good, nobody, cache));
    char text[64];
    read_file(apart_path("other"), text, sizeof text);
    assert_string_equal(text, "untouched");

    assert_int_equal(unlink(path), 0);
    assert_int_equal(symlink("/dev/zero", path), 0);
    assert_true(finds_good(good, NULL, cache));

    assert_int_equal(unlink(path), 0);
    assert_int_equal(mkdir(path, 0700), 0);
    assert_int_equal(mkdir(apart_path("cache/%s/x", strrchr(path, '/')), 0700), 0);
    assert_true(finds_good(good, NULL, cache));
    only_file(cache); /* no half-written one is left */

    const char *const nowhere[] = {"/dev/null/cache", apart_path("other")};
    for (size_t i = 0; i < WO_COUNT(nowhere); i++) {
        wo_host *host = survey(good, NULL, nowhere[i]);
        assert_non_null(apart_found(host, TEST "Good"));
        assert_int_equal(wo_host_failure_count(host), 0);
        assert_non_null(strstr(wo_host_note(host, 0), "cannot be kept there"));
        wo_host_destroy(&host);
    }
}

/* A cache that lies with the right hash costs time and nothing else. */
static void lies_are_found_out(void **state)
{
    const char *cache = apart_path("cache");
    char text[8192], path[1024];
    const wo_host_plugin *plugin = NULL;
    wo_error error = {0};
    (void)state;
    assert_true(finds_good(good, NULL, cache));
    snprintf(path, sizeof path, "%s", only_file(cache));
    read_file(path, text, sizeof text);
    put_in_place(text, TEST "Good", TEST "Evil");
    seal(text, sizeof text);
    static const char *const names[] = {"Evil", "Good"};
    for (int i = 0; i < 2; i++) {
        write_file(path, text, strlen(text));
        wo_host *host = apart_host(good, cache, 60);
        const wo_status status = wo_host_find_plugin(host, names[i], &plugin, &error);
        assert_int_equal(status, i == 0 ? WO_ERR_NOT_FOUND : WO_OK);
        wo_host_destroy(&host);
        assert_true(finds_good(good, nobody, cache)); /* mended */
    }
}

static void failures_are_asked_for_again(void **state)
{
    static const char *const folders[] = {WO_TEST_PLUGINS "/hanging", NULL};
    const char *cache = apart_path("cache");
    (void)state;
    wo_host *host = apart_host(folders, cache, 2);
    ok(wo_host_survey(host, &ok_error));
    assert_int_equal(wo_host_failure_count(host), 3);
    wo_host_destroy(&host);
    /* Whoever looks for another plugin does not wait for them again. */
    host = apart_host_with((wo_host_config){.threads = 2, .describer = nobody}, folders, cache);
    const wo_host_plugin *plugin = NULL;
    ok(wo_host_find_plugin(host, TEST "DescribeHang.Last", &plugin, &ok_error));
    assert_int_equal(wo_host_failure_count(host), 0);
    /* A list tries again. */
    ok(wo_host_survey(host, &ok_error));
    apart_failure(host, "LoadHang", "no process could be started");
    wo_host_destroy(&host);
}

/* A farm: many begin at once with nothing known. */
static void many_processes(void **state)
{
    enum { PROCESSES = 12 };
    const char *cache = apart_path("cache");
    pid_t pids[PROCESSES];
    (void)state;
    for (int i = 0; i < PROCESSES; i++) {
        pids[i] = fork();
        assert_true(pids[i] >= 0);
        if (pids[i] == 0) {
            bool there = true;
            for (int k = 0; k < 3; k++)
                there = finds_good(good, NULL, cache) && there;
            _exit(there ? 0 : 1);
        }
    }
    for (int i = 0; i < PROCESSES; i++) {
        int status = 0;
        assert_int_equal(waitpid(pids[i], &status, 0), pids[i]);
        assert_int_equal(status, 0);
    }
    only_file(cache);
    assert_true(finds_good(good, nobody, cache));
}

#define with_folder(test) cmocka_unit_test_setup_teardown(test, apart_set_up, apart_tear_down)

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        with_folder(what_is_known_is_not_asked_again),
        with_folder(a_changed_binary_is_another),
        with_folder(damaged_files_are_made_anew),
        with_folder(lines_that_are_none_are_refused),
        with_folder(odd_places),
        with_folder(lies_are_found_out),
        with_folder(failures_are_asked_for_again),
        with_folder(many_processes),
    };
    apart_main(argc, argv);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
