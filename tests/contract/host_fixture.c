/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "host_fixture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

char fixture_message[4096];
int fixture_progress_calls;

static bool take_message(void *user, wo_host_message type, const char *id, const char *text)
{
    (void)user;
    (void)id;
    if (type != WO_HOST_MESSAGE_QUESTION)
        snprintf(fixture_message, sizeof fixture_message, "%s", text);
    return true;
}

static bool take_progress(void *user, const char *label, double fraction)
{
    (void)user;
    (void)label;
    (void)fraction;
    fixture_progress_calls++;
    return true;
}

wo_host *fixture_host(const char *folder, unsigned threads, bool strict, unsigned layout)
{
    char path[1024];
    const char *directories[] = {path};
    wo_host *host = NULL;
    snprintf(path, sizeof path, "%s/%s", WO_TEST_PLUGINS, folder);
    const wo_host_config config = {
        .threads = threads,
        .directories = directories,
        .directory_count = 1,
        .strict = strict,
        .layout = layout,
        .message = take_message,
        .progress = take_progress,
    };
    ok(wo_host_create(&config, &host, &ok_error));
    assert_non_null(host);
    return host;
}

wo_host_instance *fixture_instance(wo_host *host, const char *name, const char *context)
{
    const wo_host_plugin *plugin = NULL;
    wo_host_instance *instance = NULL;
    wo_host_project project = WO_HOST_PROJECT_INIT;
    project.size[0] = 40;
    project.size[1] = 30;
    project.last_frame = 100;
    ok(wo_host_find_plugin(host, name, &plugin, &ok_error));
    ok(wo_host_instance_create(host, plugin, context, &project, &instance, &ok_error));
    return instance;
}

wo_image fixture_picture(wo_rect bounds, int32_t components, uint32_t seed)
{
    const size_t row = (size_t)wo_rect_width(bounds) * (size_t)components;
    const size_t count = row * (size_t)wo_rect_height(bounds);
    wo_image image = {.data = malloc(count * sizeof(float)),
                      .bounds = bounds,
                      .row_bytes = (ptrdiff_t)(row * sizeof(float)),
                      .components = components};
    assert_non_null(image.data);
    for (size_t i = 0; i < count; i++) {
        seed = seed * 1664525u + 1013904223u;
        image.data[i] = (float)(seed >> 8) / 16777216.0f;
    }
    return image;
}

void fixture_connect(wo_host_instance *instance, const char *clip, wo_host_still *still)
{
    wo_host_source source = WO_HOST_SOURCE_INIT;
    source.user = still;
    source.components = still->image.components;
    source.pixel_aspect = still->pixel_aspect > 0 ? still->pixel_aspect : 1;
    source.region = wo_host_still_region;
    source.pixels = wo_host_still_pixels;
    ok(wo_host_set_clip(instance, clip, &source, &ok_error));
}

wo_image fixture_render(wo_host_instance *instance, double time, double scale, wo_rect window,
                        int32_t tile, wo_host_render_result *result)
{
    wo_image image = {0};
    const wo_host_render_args args = {.time = time,
                                      .scale_x = scale,
                                      .scale_y = scale,
                                      .window = window,
                                      .tile_width = tile,
                                      .tile_height = tile};
    ok(wo_host_render(instance, &args, &image, result, &ok_error));
    return image;
}

void fixture_same(const wo_image *a, const wo_image *b)
{
    assert_true(wo_rect_equal(a->bounds, b->bounds));
    assert_int_equal(a->components, b->components);
    const size_t length = (size_t)wo_rect_width(a->bounds) * (size_t)a->components * sizeof(float);
    for (int32_t y = a->bounds.y1; y < a->bounds.y2; y++)
        assert_memory_equal(wo_image_at(a, a->bounds.x1, y), wo_image_at(b, b->bounds.x1, y),
                            length);
}

void fixture_no_violations(wo_host *host)
{
    for (size_t i = 0; i < wo_host_violation_count(host); i++)
        print_error("violation: %s\n", wo_host_violation(host, i));
    assert_int_equal(wo_host_violation_count(host), 0);
}

void fixture_violation(wo_host *host, const char *text)
{
    for (size_t i = 0; i < wo_host_violation_count(host); i++)
        if (strstr(wo_host_violation(host, i), text))
            return;
    for (size_t i = 0; i < wo_host_violation_count(host); i++)
        print_error("violation: %s\n", wo_host_violation(host, i));
    fail_msg("no violation says \"%s\"", text);
}
