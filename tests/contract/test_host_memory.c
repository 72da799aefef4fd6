/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "host_fixture.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Every allocation of the host fails once, in turn: no crash, no leak, a clean error, and the host
   works afterwards. The linker sends the host's and this test's calls here (--wrap); the plugin's
   own are left alone. */

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);

static atomic_long countdown = -1; /* to the call that fails; below 0: none does */

static bool fails(void)
{
    return atomic_load(&countdown) >= 0 && atomic_fetch_sub(&countdown, 1) == 0;
}

void *__wrap_malloc(size_t size)
{
    return fails() ? NULL : __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size)
{
    return fails() ? NULL : __real_calloc(count, size);
}

void *__wrap_realloc(void *memory, size_t size)
{
    return fails() ? NULL : __real_realloc(memory, size);
}

void *__wrap_aligned_alloc(size_t alignment, size_t size)
{
    return fails() ? NULL : __real_aligned_alloc(alignment, size);
}

static wo_status use_instance(wo_host_instance *instance, wo_host_still *still, wo_image *image,
                              wo_error *error)
{
    wo_host_source source = WO_HOST_SOURCE_INIT;
    const wo_host_preferences *preferences;
    const wo_host_render_args args = {
        .time = 1, .scale_x = 1, .scale_y = 1, .tile_width = 30, .tile_height = 30};
    source.user = still;
    source.region = wo_host_still_region;
    source.pixels = wo_host_still_pixels;
    source.colourspace = "lin_rec709_srgb";
    source.identity = "still";
    WO_TRY(wo_host_set_clip(instance, "Source", &source, error));
    WO_TRY(wo_host_param_set_text(instance, "gain", "key@1:2,key@5:3", error));
    WO_TRY(wo_host_param_set_text(instance, "note", "hello", error));
    WO_TRY(wo_host_param_press(instance, "reset", error));
    WO_TRY(wo_host_param_set_text(instance, "gain", "2", error));
    WO_TRY(wo_host_get_preferences(instance, &preferences, error));
    return wo_host_render(instance, &args, image, NULL, error);
}

static wo_status use_host(const wo_host_config *config, wo_host_still *still, wo_image *image,
                          wo_error *error)
{
    wo_host *host = NULL;
    const wo_host_plugin *plugin = NULL;
    wo_host_instance *instance = NULL;
    const wo_host_project project = WO_HOST_PROJECT_INIT;
    WO_TRY(wo_host_create(config, &host, error));
    wo_status status = wo_host_find_plugin(host, "Good", &plugin, error);
    if (status == WO_OK)
        status = wo_host_instance_create(host, plugin, "Filter", &project, &instance, error);
    if (status == WO_OK)
        status = use_instance(instance, still, image, error);
    wo_host_instance_destroy(&instance);
    wo_host_destroy(&host);
    return status;
}

static void every_allocation_fails_once(void **state)
{
    static const char *const directories[] = {WO_TEST_PLUGINS "/good"};
    const wo_host_config config = {
        .threads = 1, .directories = directories, .directory_count = 1, .strict = true};
    (void)state;
    wo_host_still still = {.image = fixture_picture((wo_rect){0, 0, 40, 30}, 4, 1)};
    long failures = 0, n = 0;
    /* Every one of the first 600, then every 23rd: all of them would take too long under the
     * sanitizers. */
    for (;; n += n < 600 ? 1 : 23) {
        wo_image image = {0};
        wo_error error = {0};
        atomic_store(&countdown, n);
        const wo_status status = use_host(&config, &still, &image, &error);
        const bool reached = atomic_exchange(&countdown, -1) < 0;
        if (status != WO_OK) {
            failures++;
            assert_int_equal(error.status, status);
            assert_true(error.text[0] != '\0');
            assert_null(image.data);
        }
        wo_host_image_free(&image);
        if (!reached) {
            assert_int_equal(status, WO_OK);
            break;
        }
    }
    print_message("%ld allocations, %ld failures tried were noticed\n", n, failures);
    assert_true(failures > 100); /* some failures cost no more than a note */
    free(still.image.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_allocation_fails_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
