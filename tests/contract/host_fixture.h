/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TEST_HOST_FIXTURE_H
#define WO_TEST_HOST_FIXTURE_H

#include "host.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* What the tests of the host share. */

/* A host with the plugins of one folder below WO_TEST_PLUGINS ("good", "bad", "odd", "shy"). */
wo_host *fixture_host(const char *folder, unsigned threads, bool strict, unsigned layout);

/* An instance of the folder's plugin; project 40 x 30, frames 1 to 100. */
wo_host_instance *fixture_instance(wo_host *host, const char *plugin, const char *context);

/* A picture of pseudo-random values 0..1, the same for the same arguments. data is malloc-ed. */
wo_image fixture_picture(wo_rect bounds, int32_t components, uint32_t seed);

/* Connects a picture, which must live as long as the clip is used. */
void fixture_connect(wo_host_instance *instance, const char *clip, wo_host_still *still);

/* Renders with the defaults and these. */
wo_image fixture_render(wo_host_instance *instance, double time, double scale, wo_rect window,
                        int32_t tile, wo_host_render_result *result);

/* Fails the test when two pictures differ in one bit; padding does not count. */
void fixture_same(const wo_image *a, const wo_image *b);

/* Fails the test, showing them, when the host has written down violations. */
void fixture_no_violations(wo_host *host);

/* Fails the test, showing them, unless one violation contains the text. */
void fixture_violation(wo_host *host, const char *text);

/* Text of the last message plugins sent to hosts of fixture_host; number of progress calls. */
extern char fixture_message[4096];
extern int fixture_progress_calls;

#define ok(call)                                                                                   \
    do {                                                                                           \
        wo_error ok_error = {0};                                                                   \
        const wo_status ok_status = (call);                                                        \
        if (ok_status != WO_OK)                                                                    \
            fail_msg("%s: %s: %s", #call, wo_status_text(ok_status), ok_error.text);               \
    } while (0)

#endif
