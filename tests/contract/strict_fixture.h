/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TESTS_STRICT_FIXTURE_H
#define WO_TESTS_STRICT_FIXTURE_H

#include "host.h"
#include "plugins/probe_effect.h"

#include <stdatomic.h>

/* The probe plugin under the strict host, a scene without files, and what must come out of it. */

/* A clip: noise in a rectangle, the same at every scale's pixels. */
typedef struct noise {
    wo_host_region region;
    int32_t components;
    unsigned seed;
    double aspect;
    bool missing; /* has no picture at any time */
} noise;

extern noise clips[PROBE_CLIPS];

float noise_at(const noise *n, int32_t x, int32_t y, int32_t component);
wo_host_source source_of(noise *n);
void reset_clips(double aspect);

/* What the host's abort callback looks at. */
typedef struct watcher {
    atomic_int polls;
    atomic_int stop_after; /* polls; < 0 = never */
} watcher;

extern watcher watch;

wo_host *open_host(unsigned threads, unsigned layout);
void assert_no_violations(wo_host *host);
void close_host(wo_host **host); /* with no violations */
const wo_host_plugin *probe_of(wo_host *host);

/* An instance in a project of 64x48; connect_clip and set fail the test if the host refuses. */
wo_host_instance *create(wo_host *host, const char *context, double aspect);
void connect_clip(wo_host_instance *instance, int clip);
void set(wo_host_instance *instance, const char *name, const char *text);

/* A render, and what the effect makes of it without a host. */
typedef struct setup {
    double scale[2];
    double aspect;
    bool connected[PROBE_CLIPS];
    probe_params params;
} setup;

setup default_setup(void); /* everything connected */
void connect_only_source(setup *s);
wo_host_render_args args_of(const setup *s);
wo_image expected(const setup *s); /* data is the caller's to free */

/* Renders and wants the expected bytes. */
void assert_render(wo_host_instance *instance, const setup *s, const wo_host_render_args *args);

#endif
