/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TEST_APART_FIXTURE_H
#define WO_TEST_APART_FIXTURE_H

#include "host_fixture.h"

#include "found.h"

/* What the tests of plugins in other processes share. */

/* Runs the describer, and does not return, when a test was started as one. */
void apart_main(int argc, char **argv);

/* A folder for one test: cmocka's set-up and tear-down. */
extern char apart_root[64];
int apart_set_up(void **state);
int apart_tear_down(void **state);

/* Path of a thing below the folder; good for sixty more calls. */
const char *apart_path(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Puts a link to a bundle below WO_TEST_PLUGINS ("good/Good") into a folder below apart_root. */
void apart_link(const char *folder, const char *bundle);

/* A host for folders (NULL at their end; whole paths), with a cache or NULL. */
wo_host *apart_host(const char *const *folders, const char *cache, double seconds);

/* The same with other config. */
wo_host *apart_host_with(wo_host_config config, const char *const *folders, const char *cache);

/* What a survey has found; NULL when there is no such plugin. */
const wo_host_found *apart_found(const wo_host *host, const char *identifier);

/* Fails the test unless one failure contains both texts. */
void apart_failure(const wo_host *host, const char *a, const char *b);

#endif
