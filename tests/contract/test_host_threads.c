/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "host_fixture.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const wo_rect whole = {0, 0, 0, 0};

/* Several instances of several hosts at once, which share one binary: same pixels, no faults. */
typedef struct part {
    wo_host *host;
    wo_image image;
} part;

static void *life(void *user)
{
    part *p = user;
    wo_host_instance *instance = fixture_instance(p->host, "Good", "Filter");
    wo_host_still still = {.image = fixture_picture((wo_rect){0, 0, 40, 30}, 4, 5)};
    fixture_connect(instance, "Source", &still);
    ok(wo_host_param_set_text(instance, "radius", "3", &ok_error));
    for (int i = 0; i < 5; i++) {
        wo_host_image_free(&p->image);
        p->image = fixture_render(instance, 1, 1, whole, i % 2 ? 9 : 0, NULL);
    }
    wo_host_instance_destroy(&instance);
    free(still.image.data);
    return NULL;
}

static void many_at_once(void **state)
{
    enum { HOSTS = 2, LIVES = 3 };
    (void)state;
    wo_host *hosts[HOSTS];
    part parts[HOSTS * LIVES] = {0};
    pthread_t threads[HOSTS * LIVES];
    for (int i = 0; i < HOSTS; i++)
        hosts[i] = fixture_host("good", 3, true, WO_HOST_PADDED_ROWS);
    for (int i = 0; i < HOSTS * LIVES; i++) {
        parts[i].host = hosts[i % HOSTS];
        assert_int_equal(pthread_create(&threads[i], NULL, life, &parts[i]), 0);
    }
    for (int i = 0; i < HOSTS * LIVES; i++)
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    for (int i = 0; i < HOSTS * LIVES; i++) {
        fixture_same(&parts[0].image, &parts[i].image);
        if (i > 0)
            wo_host_image_free(&parts[i].image);
    }
    /* The first host goes; the other one still works. */
    fixture_no_violations(hosts[0]);
    wo_host_destroy(&hosts[0]);
    part last = {.host = hosts[1]};
    (void)life(&last);
    fixture_same(&parts[0].image, &last.image);
    fixture_no_violations(hosts[1]);
    wo_host_destroy(&hosts[1]);
    wo_host_image_free(&parts[0].image);
    wo_host_image_free(&last.image);
}

/* Tiles of one instance in parallel. */
static void tiles_at_once(void **state)
{
    (void)state;
    for (int strict = 0; strict < 2; strict++) {
        wo_host *host = fixture_host("good", 2, strict, 0);
        wo_host_instance *instance = fixture_instance(host, "Good", "Filter");
        wo_host_still still = {.image = fixture_picture((wo_rect){0, 0, 40, 30}, 4, 5)};
        wo_host_render_result result;
        wo_image image = {0};
        fixture_connect(instance, "Source", &still);
        ok(wo_host_param_set_text(instance, "radius", "2", &ok_error));
        wo_image reference = fixture_render(instance, 1, 1, whole, 0, &result);
        const wo_host_render_args args = {.time = 1,
                                          .scale_x = 1,
                                          .scale_y = 1,
                                          .tile_width = 8,
                                          .tile_height = 8,
                                          .parallel_tiles = 4};
        ok(wo_host_render(instance, &args, &image, &result, &ok_error));
        assert_int_equal(result.tiles, 6 * 5); /* 44 x 34 */
        fixture_same(&reference, &image);
        wo_host_image_free(&image);
        wo_host_image_free(&reference);
        wo_host_instance_destroy(&instance);
        fixture_no_violations(host);
        wo_host_destroy(&host);
        free(still.image.data);
    }
}

/* A source that takes its time, so that there is something to stop. */
typedef struct slow {
    wo_host_still still;
    atomic_int asked;
} slow;

static wo_status slow_region(void *user, double time, wo_host_region *region, wo_error *error)
{
    return wo_host_still_region(&((slow *)user)->still, time, region, error);
}

static wo_status slow_pixels(void *user, const wo_host_request *request, const wo_image *image,
                             wo_error *error)
{
    slow *s = user;
    const struct timespec pause = {.tv_nsec = 5000000};
    atomic_fetch_add(&s->asked, 1);
    nanosleep(&pause, NULL);
    return wo_host_still_pixels(&s->still, request, image, error);
}

typedef struct stopper {
    wo_host_instance *instance;
    slow *source;
} stopper;

static void *stop_soon(void *user)
{
    stopper *s = user;
    const struct timespec pause = {.tv_nsec = 1000000};
    while (atomic_load(&s->source->asked) < 3)
        nanosleep(&pause, NULL);
    wo_host_abort(s->instance);
    return NULL;
}

static bool always(void *user)
{
    atomic_fetch_add((atomic_int *)user, 1);
    return true;
}

static void renders_can_be_stopped(void **state)
{
    (void)state;
    wo_host *host = fixture_host("good", 2, true, 0);
    wo_host_instance *instance = fixture_instance(host, "Good", "Filter");
    slow source = {.still = {.image = fixture_picture((wo_rect){0, 0, 40, 30}, 4, 5)}};
    wo_host_source s = WO_HOST_SOURCE_INIT;
    s.user = &source;
    s.region = slow_region;
    s.pixels = slow_pixels;
    ok(wo_host_set_clip(instance, "Source", &s, &ok_error));
    ok(wo_host_param_set_text(instance, "gain", "2", &ok_error));
    const wo_host_render_args args = {
        .time = 1, .scale_x = 1, .scale_y = 1, .tile_width = 2, .tile_height = 2};
    wo_image image = {0};
    wo_error error = {0};
    wo_host_render_result result;
    pthread_t thread;
    stopper stop = {instance, &source};
    assert_int_equal(pthread_create(&thread, NULL, stop_soon, &stop), 0);
    assert_int_equal(wo_host_render(instance, &args, &image, &result, &error), WO_ABORTED);
    assert_int_equal(pthread_join(thread, NULL), 0);
    assert_null(image.data);
    assert_true(result.tiles < 300);
    /* The next one is not stopped by the last one's wish. */
    ok(wo_host_param_set_text(instance, "gain", "1", &ok_error));
    ok(wo_host_render(instance, &args, &image, &result, &ok_error));
    assert_true(result.identity);
    wo_host_image_free(&image);
    wo_host_instance_destroy(&instance);
    fixture_no_violations(host);
    wo_host_destroy(&host);
    free(source.still.image.data);
}

static void hosts_can_be_asked_to_stop(void **state)
{
    static const char *const directories[] = {WO_TEST_PLUGINS "/good"};
    (void)state;
    atomic_int asked = 0;
    const wo_host_config config = {.threads = 2,
                                   .directories = directories,
                                   .directory_count = 1,
                                   .user = &asked,
                                   .aborted = always};
    wo_host *host = NULL;
    ok(wo_host_create(&config, &host, &ok_error));
    wo_host_instance *instance = fixture_instance(host, "Good", "Generator");
    wo_image image = {0};
    wo_error error = {0};
    const wo_host_render_args args = {.time = 1, .scale_x = 1, .scale_y = 1};
    assert_int_equal(wo_host_render(instance, &args, &image, NULL, &error), WO_ABORTED);
    assert_true(atomic_load(&asked) > 0);
    assert_null(image.data);
    wo_host_destroy(&host);
}

/* A graph: the source of one instance is what another one renders, asked for on any thread. */
typedef struct node {
    wo_host_instance *instance;
    atomic_int renders;
} node;

static wo_status node_region(void *user, double time, wo_host_region *region, wo_error *error)
{
    return wo_host_get_region(((node *)user)->instance, time, 1, 1, region, NULL, error);
}

static wo_status node_pixels(void *user, const wo_host_request *request, const wo_image *image,
                             wo_error *error)
{
    node *n = user;
    wo_image view = *image;
    const wo_host_render_args args = {.time = request->time,
                                      .scale_x = request->scale_x,
                                      .scale_y = request->scale_y,
                                      .window = request->region};
    atomic_fetch_add(&n->renders, 1);
    return wo_host_render(n->instance, &args, &view, NULL, error);
}

static void graphs_are_pulled(void **state)
{
    (void)state;
    wo_host *host = fixture_host("good", 3, true, WO_HOST_NEGATIVE_ROWS);
    wo_host_still still = {.image = fixture_picture((wo_rect){0, 0, 40, 30}, 4, 5)};
    node first = {.instance = fixture_instance(host, "Good", "Filter")};
    wo_host_instance *second = fixture_instance(host, "Good", "General");
    fixture_connect(first.instance, "Source", &still);
    ok(wo_host_param_set_text(first.instance, "gain", "2", &ok_error));
    wo_host_source source = WO_HOST_SOURCE_INIT;
    source.user = &first;
    source.region = node_region;
    source.pixels = node_pixels;
    ok(wo_host_set_clip(second, "Source", &source, &ok_error));
    ok(wo_host_param_set_text(second, "gain", "3", &ok_error));
    wo_image image = fixture_render(second, 1, 1, whole, 10, NULL);
    assert_int_equal(atomic_load(&first.renders), 12);
    for (int32_t y = 0; y < 30; y++)
        for (int32_t x = 0; x < 40; x++)
            assert_float_equal(wo_image_at(&image, x, y)[2], 6 * wo_image_at(&still.image, x, y)[2],
                               1e-6);
    wo_host_image_free(&image);
    wo_host_instance_destroy(&second);
    wo_host_instance_destroy(&first.instance);
    fixture_no_violations(host);
    wo_host_destroy(&host);
    free(still.image.data);
}

static void thread_counts(void **state)
{
    (void)state;
    wo_host *host = NULL;
    ok(wo_host_create(&(wo_host_config){.threads = 5}, &host, &ok_error));
    assert_int_equal(wo_host_threads(host), 5);
    wo_host_destroy(&host);
    ok(wo_host_create(NULL, &host, &ok_error));
    assert_true(wo_host_threads(host) >= 1);
    wo_host_destroy(&host);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(many_at_once),           cmocka_unit_test(tiles_at_once),
        cmocka_unit_test(renders_can_be_stopped), cmocka_unit_test(hosts_can_be_asked_to_stop),
        cmocka_unit_test(graphs_are_pulled),      cmocka_unit_test(thread_counts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
