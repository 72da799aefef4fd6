/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "apart_fixture.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define DESCRIBER "--describer"

char apart_root[64];

void apart_main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], DESCRIBER) == 0)
        exit(wo_host_describer(argc - 2, argv + 2));
}

int apart_set_up(void **state)
{
    (void)state;
    snprintf(apart_root, sizeof apart_root, "/tmp/wo_apart_XXXXXX");
    return mkdtemp(apart_root) ? 0 : -1;
}

static int drop(const char *path, const struct stat *status, int type, struct FTW *walk)
{
    (void)status;
    (void)type;
    (void)walk;
    return remove(path);
}

int apart_tear_down(void **state)
{
    (void)state;
    return nftw(apart_root, drop, 16, FTW_DEPTH | FTW_PHYS);
}

const char *apart_path(const char *format, ...)
{
    static char paths[64][512];
    static int next;
    char *path = paths[next++ % 64];
    va_list args;
    const int used = snprintf(path, 512, "%s/", apart_root);
    va_start(args, format);
    vsnprintf(path + used, (size_t)(512 - used), format, args);
    va_end(args);
    return path;
}

void apart_link(const char *folder, const char *bundle)
{
    char target[1024];
    const char *name = strrchr(bundle, '/');
    assert_non_null(name);
    (void)mkdir(apart_path("%s", folder), 0700);
    snprintf(target, sizeof target, "%s/%s.ofx.bundle", WO_TEST_PLUGINS, bundle);
    assert_int_equal(symlink(target, apart_path("%s%s.ofx.bundle", folder, name)), 0);
}

wo_host *apart_host_with(wo_host_config config, const char *const *folders, const char *cache)
{
    static const char *const describer[] = {"/proc/self/exe", DESCRIBER, NULL};
    wo_host *host = NULL;
    config.directories = folders;
    while (folders[config.directory_count])
        config.directory_count++;
    if (!config.describer)
        config.describer = describer;
    config.cache = cache;
    ok(wo_host_create(&config, &host, &ok_error));
    assert_int_equal(wo_host_plugin_count(host), 0);
    return host;
}

wo_host *apart_host(const char *const *folders, const char *cache, double seconds)
{
    return apart_host_with((wo_host_config){.threads = 8, .describe_seconds = seconds}, folders,
                           cache);
}

const wo_host_found *apart_found(const wo_host *host, const char *identifier)
{
    for (size_t i = 0; i < wo_host_found_count(host); i++)
        if (strcmp(wo_host_found_at(host, i)->identifier, identifier) == 0)
            return wo_host_found_at(host, i);
    return NULL;
}

void apart_failure(const wo_host *host, const char *a, const char *b)
{
    for (size_t i = 0; i < wo_host_failure_count(host); i++)
        if (strstr(wo_host_failure(host, i), a) && strstr(wo_host_failure(host, i), b))
            return;
    for (size_t i = 0; i < wo_host_failure_count(host); i++)
        print_error("failure: %s\n", wo_host_failure(host, i));
    fail_msg("no failure says \"%s\" and \"%s\"", a, b);
}
