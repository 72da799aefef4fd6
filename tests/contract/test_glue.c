/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "strict_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <pthread.h>

/* The glue under the strict host: everything right, and not one violation. Odd hosts are the matter
   of test_glue_hosts.c and test_glue_images.c. */

static void the_description_is_the_table(void **state)
{
    (void)state;
    static const char *const contexts[] = {"Filter", "General"};
    wo_host *host = open_host(1, 0);
    const wo_host_plugin *const plugin = probe_of(host);
    assert_string_equal(plugin->identifier, "org.wideopen.test.Probe");
    assert_string_equal(plugin->label, probe_effect.label);
    assert_string_equal(plugin->group, "WideOpen/Test");
    assert_string_equal(plugin->description, probe_effect.help);
    assert_int_equal(plugin->context_name_count, 2);
    assert_int_equal(plugin->safety, WO_HOST_FULLY_SAFE);
    assert_true(plugin->tiles && plugin->multi_resolution && plugin->float_pixels);
    assert_false(plugin->temporal);
    assert_string_equal(plugin->colour_style, "OfxImageEffectColourManagementCore");
    for (size_t k = 0; k < WO_COUNT(contexts); k++) {
        const wo_host_context_info *const context = wo_host_find_context(plugin, contexts[k]);
        assert_non_null(context);
        assert_int_equal(context->clip_count, PROBE_CLIPS + 1);
        for (size_t i = 0; i < PROBE_CLIPS; i++) {
            const wo_clip *const row = &probe_effect.clips[i];
            const wo_host_clip_info *const clip = wo_host_find_clip(context, row->name);
            assert_non_null(clip);
            assert_string_equal(clip->label, row->label);
            assert_int_equal(clip->components, row->components);
            assert_int_equal(clip->optional, i > 0);
            assert_int_equal(clip->mask, row->mask);
            assert_true(clip->tiles);
            assert_false(clip->temporal || clip->output);
        }
        const wo_host_clip_info *const output = wo_host_find_clip(context, "Output");
        assert_non_null(output);
        assert_int_equal(output->components, WO_HOST_RGBA);
        for (size_t i = 0; i < probe_effect.param_count; i++) {
            static const wo_host_param_type kinds[] = {
                WO_HOST_PARAM_DOUBLE, WO_HOST_PARAM_INTEGER,   WO_HOST_PARAM_BOOLEAN,
                WO_HOST_PARAM_CHOICE, WO_HOST_PARAM_DOUBLE_2D, WO_HOST_PARAM_RGB,
                WO_HOST_PARAM_STRING};
            const wo_param *const row = &probe_effect.params[i];
            const wo_host_param_info *const param = wo_host_find_param(context, row->key);
            assert_non_null(param);
            assert_int_equal(param->kind, kinds[row->type]);
            assert_string_equal(param->label, row->label);
            assert_string_equal(param->script_name, row->key);
            assert_string_equal(param->parent, row->group);
            assert_memory_equal(param->hint, row->help, strlen(row->help));
            assert_int_equal(param->animates, row->animates);
            assert_int_equal(param->dimension, wo_param_values(row));
            assert_int_equal(param->choice_count, wo_param_choice_count(row));
            assert_false(param->secret);
            for (int j = 0; j < wo_param_values(row); j++)
                assert_true(param->initial[j] == row->initial[j]);
            for (int j = 0; row->type != WO_PARAM_BOOL && row->type != WO_PARAM_CHOICE &&
                            j < wo_param_values(row);
                 j++) {
                assert_true(param->min[j] == row->min && param->max[j] == row->max);
                assert_true(param->ui_min[j] == row->ui_min && param->ui_max[j] == row->ui_max);
            }
            for (size_t j = 0; j < param->choice_count; j++)
                assert_string_equal(param->choices[j], row->choice_labels[j]);
            if (row->type == WO_PARAM_STRING)
                assert_string_equal(param->initial_text, row->initial_text);
        }
        for (size_t i = 0; i < probe_effect.group_count; i++) {
            const wo_host_param_info *const group =
                wo_host_find_param(context, probe_effect.groups[i].key);
            assert_non_null(group);
            assert_int_equal(group->kind, WO_HOST_PARAM_GROUP);
            assert_string_equal(group->label, probe_effect.groups[i].label);
            assert_int_equal(group->open, probe_effect.groups[i].open);
        }
    }
    close_host(&host);
}

static void it_can_be_loaded_many_times(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        wo_host *host = open_host(2, 0);
        reset_clips(1);
        wo_host_instance *instance = create(host, "Filter", 1);
        connect_clip(instance, PROBE_SOURCE);
        setup s = default_setup();
        connect_only_source(&s);
        const wo_host_render_args args = args_of(&s);
        assert_render(instance, &s, &args);
        wo_host_instance_destroy(&instance);
        close_host(&host);
    }
}

static void optional_clips_may_be_missing(void **state)
{
    (void)state;
    static const char *const contexts[] = {"Filter", "General"};
    wo_host *host = open_host(2, 0);
    for (size_t k = 0; k < WO_COUNT(contexts); k++)
        for (unsigned bits = 0; bits < 16; bits++) {
            reset_clips(1);
            wo_host_instance *instance = create(host, contexts[k], 1);
            setup s = default_setup();
            const wo_host_render_args args = args_of(&s);
            connect_clip(instance, PROBE_SOURCE);
            for (int clip = 1; clip < PROBE_CLIPS; clip++) {
                s.connected[clip] = (bits >> (clip - 1)) & 1;
                /* Connected, but with nothing to give. */
                clips[clip].missing = !s.connected[clip] && bits & 8;
                if (s.connected[clip] || clips[clip].missing)
                    connect_clip(instance, clip);
            }
            assert_render(instance, &s, &args);
            wo_host_instance_destroy(&instance);
            assert_no_violations(host);
        }
    close_host(&host);
}

static void a_source_without_pictures_is_black(void **state)
{
    (void)state;
    wo_host *host = open_host(2, 0);
    reset_clips(1);
    clips[PROBE_SOURCE].missing = true;
    wo_host_instance *instance = create(host, "General", 1);
    const setup s = default_setup();
    const wo_host_render_args args = args_of(&s);
    wo_image got = {.data = NULL};
    connect_clip(instance, PROBE_SOURCE);
    connect_clip(instance, PROBE_DEPTH);
    assert_int_equal(wo_host_render(instance, &args, &got, NULL, NULL), WO_OK);
    for (int32_t y = got.bounds.y1; y < got.bounds.y2; y++)
        for (int32_t x = got.bounds.x1; x < got.bounds.x2; x++)
            for (int c = 0; c < 4; c++)
                assert_true(wo_image_at(&got, x, y)[c] == 0);
    wo_host_image_free(&got);
    wo_host_instance_destroy(&instance);
    close_host(&host);
}

static void scales_aspects_layouts_and_tiles_agree(void **state)
{
    (void)state;
    static const double scales[][2] = {{1, 1}, {0.5, 0.5}, {0.25, 0.25}, {0.5, 0.25}, {0.1, 0.1}};
    static const double aspects[] = {1, 2, 0.5};
    static const int32_t tiles[][2] = {{0, 0}, {16, 16}, {7, 5}, {0, 1}};
    static const unsigned layouts[] = {0, WO_HOST_NEGATIVE_ROWS, WO_HOST_LARGER_IMAGES,
                                       WO_HOST_NEGATIVE_ROWS | WO_HOST_PADDED_ROWS |
                                           WO_HOST_LARGER_IMAGES};
    for (size_t l = 0; l < WO_COUNT(layouts); l++) {
        wo_host *host = open_host(3, layouts[l]);
        for (size_t a = 0; a < WO_COUNT(aspects); a++) {
            reset_clips(aspects[a]);
            wo_host_instance *instance = create(host, "General", aspects[a]);
            for (int clip = 0; clip < PROBE_CLIPS; clip++)
                connect_clip(instance, clip);
            set(instance, "radius", "4");
            for (size_t k = 0; k < WO_COUNT(scales); k++)
                for (size_t t = 0; t < WO_COUNT(tiles); t++) {
                    setup s = default_setup();
                    s.params.radius = 4;
                    s.aspect = aspects[a];
                    memcpy(s.scale, scales[k], sizeof s.scale);
                    wo_host_render_args args = args_of(&s);
                    args.tile_width = tiles[t][0];
                    args.tile_height = tiles[t][1];
                    args.parallel_tiles = t == 2 ? 3 : 1;
                    assert_render(instance, &s, &args);
                }
            wo_host_instance_destroy(&instance);
        }
        close_host(&host);
    }
}

static void parameters_reach_the_effect(void **state)
{
    (void)state;
    wo_host *host = open_host(2, 0);
    reset_clips(1);
    wo_host_instance *instance = create(host, "General", 1);
    for (int clip = 0; clip < PROBE_CLIPS; clip++)
        connect_clip(instance, clip);
    set(instance, "radius", "key@0:0,key@2:6");
    set(instance, "angle", "90");
    set(instance, "repeats", "3");
    set(instance, "centre", "10,-20");
    set(instance, "tint", "0.5,0.25,2");
    setup s = default_setup();
    s.params = (probe_params){.radius = 3,
                              .angle = 90,
                              .repeats = 3,
                              .on = 1,
                              .centre = {10, -20},
                              .tint = {0.5, 0.25, 2}};
    wo_host_render_args args = args_of(&s);
    assert_render(instance, &s, &args);
    args.time = 2;
    s.params.radius = 6;
    assert_render(instance, &s, &args);
    wo_host_instance_destroy(&instance);
    close_host(&host);
}

static void preferences_ask_for_linear_light(void **state)
{
    (void)state;
    wo_host *host = open_host(1, 0);
    reset_clips(1);
    wo_host_instance *instance = create(host, "General", 1);
    const wo_host_preferences *preferences = NULL;
    int checked = 0;
    for (int clip = 0; clip < PROBE_CLIPS; clip++)
        connect_clip(instance, clip);
    assert_int_equal(wo_host_get_preferences(instance, &preferences, NULL), WO_OK);
    assert_int_equal(preferences->alpha, WO_HOST_PREMULTIPLIED);
    assert_false(preferences->frame_varying);
    for (size_t i = 0; i < preferences->clip_count; i++) {
        const wo_host_clip_preference *const clip = &preferences->clips[i];
        if (strcmp(clip->clip, "Source") == 0) {
            assert_int_equal(clip->colourspace_count, 2);
            assert_string_equal(clip->colourspaces[0], "lin_rec709_srgb");
            assert_string_equal(clip->colourspaces[1], "ofx_scene_linear");
        } else if (strcmp(clip->clip, "Depth") == 0) {
            assert_int_equal(clip->colourspace_count, 1);
            assert_string_equal(clip->colourspaces[0], "ofx_raw");
        } else {
            assert_int_equal(clip->colourspace_count, strcmp(clip->clip, "Extra") == 0 ? 2 : 0);
        }
        if (strcmp(clip->clip, "Output") == 0)
            assert_int_equal(clip->components, 4);
        checked++;
    }
    assert_int_equal(checked, PROBE_CLIPS + 1);
    wo_host_instance_destroy(&instance);
    close_host(&host);
}

static void identity_costs_nothing(void **state)
{
    (void)state;
    wo_host *host = open_host(1, 0);
    reset_clips(1);
    wo_host_instance *instance = create(host, "Filter", 1);
    const setup s = default_setup();
    const wo_host_render_args args = args_of(&s);
    wo_image got = {.data = NULL};
    wo_host_render_result result;
    connect_clip(instance, PROBE_SOURCE);
    set(instance, "on", "false");
    assert_int_equal(wo_host_render(instance, &args, &got, &result, NULL), WO_OK);
    assert_true(result.identity);
    assert_string_equal(result.identity_clip, "Source");
    assert_int_equal(result.tiles, 0);
    assert_true(wo_image_at(&got, 3, 5)[2] == noise_at(&clips[0], 3, 5, 2));
    wo_host_image_free(&got);
    wo_host_instance_destroy(&instance);
    close_host(&host);
}

static void an_abort_ends_the_render_early(void **state)
{
    (void)state;
    for (unsigned threads = 1; threads <= 4; threads += 3) {
        wo_host *host = open_host(threads, 0);
        reset_clips(1);
        wo_host_instance *instance = create(host, "Filter", 1);
        const setup s = default_setup();
        const wo_host_render_args args = args_of(&s);
        wo_image got = {.data = NULL};
        connect_clip(instance, PROBE_SOURCE);
        set(instance, "trouble", "Wait"); /* for ever, but for the abort */
        atomic_store(&watch.stop_after, atomic_load(&watch.polls) + 50);
        assert_int_equal(wo_host_render(instance, &args, &got, NULL, NULL), WO_ABORTED);
        assert_null(got.data);
        assert_string_equal(wo_host_persistent_message(instance), "");

        /* The instance is as good as before. */
        atomic_store(&watch.stop_after, -1);
        set(instance, "trouble", "No trouble");
        setup after = default_setup();
        connect_only_source(&after);
        assert_render(instance, &after, &args);
        wo_host_instance_destroy(&instance);
        close_host(&host);
    }
}

static void errors_are_shown_and_go_away(void **state)
{
    (void)state;
    wo_host *host = open_host(2, 0);
    reset_clips(1);
    wo_host_instance *instance = create(host, "Filter", 1);
    setup s = default_setup();
    connect_only_source(&s);
    wo_host_render_args args = args_of(&s);
    args.tile_width = 20;
    wo_image got = {.data = NULL};
    wo_error error = {WO_OK, ""};
    connect_clip(instance, PROBE_SOURCE);
    set(instance, "trouble", "Fail");
    set(instance, "note", "of 100% kind");
    assert_int_not_equal(wo_host_render(instance, &args, &got, NULL, &error), WO_OK);
    assert_string_equal(wo_host_persistent_message(instance),
                        "trouble was asked for: of 100% kind");
    set(instance, "trouble", "No trouble");
    assert_render(instance, &s, &args);
    assert_string_equal(wo_host_persistent_message(instance), "");
    wo_host_instance_destroy(&instance);
    close_host(&host);
}

typedef struct published {
    int plans, reports, warnings;
    char text[4096], said[256];
} published;

static void keep(void *user, const char *kind, const char *text)
{
    published *const p = user;
    p->plans += strcmp(kind, "plan") == 0;
    p->reports += strcmp(kind, "report") == 0;
    if (strcmp(kind, "warning") == 0) {
        const size_t used = strlen(p->said);
        p->warnings++;
        snprintf(p->said + used, sizeof p->said - used, "%s\n", text);
    }
    snprintf(p->text, sizeof p->text, "%s", text);
}

static void plans_and_reports_are_published(void **state)
{
    (void)state;
    wo_host *host = open_host(2, 0);
    reset_clips(2);
    wo_host_instance *instance = create(host, "General", 2);
    setup s = default_setup();
    published p = {0};
    s.aspect = 2;
    s.scale[0] = s.scale[1] = 0.5;
    s.connected[PROBE_MASK] = s.connected[PROBE_EXTRA] = false;
    wo_host_render_args args = args_of(&s);
    args.report = WO_HOST_REPORT_RENDER;
    args.report_user = &p;
    args.publish = keep;
    connect_clip(instance, PROBE_SOURCE);
    connect_clip(instance, PROBE_DEPTH);
    assert_render(instance, &s, &args);
    assert_int_equal(p.reports, 1);
    assert_int_equal(p.plans, 0);
    assert_non_null(strstr(p.text, "\"pixels\": "));

    wo_image got = {.data = NULL};
    wo_error error = {WO_OK, ""};
    args.report = WO_HOST_REPORT_EXPLAIN;
    if (wo_host_render(instance, &args, &got, NULL, &error) != WO_OK)
        fail_msg("%s", error.text);
    wo_host_image_free(&got);
    assert_int_equal(p.plans, 1);
    assert_int_equal(p.reports, 1);
    assert_non_null(strstr(p.text, "format=0,0,16,24\nextent=-2,2,16,20\n"));
    assert_non_null(strstr(p.text, "scale=0.500000\nstretch=2.000000\n"));
    assert_non_null(strstr(p.text, "connected=1100\npixels=4300\n"));
    wo_host_instance_destroy(&instance);
    close_host(&host);
}

/* A host that asks for reports gets the warnings there, and not as messages, too. */
static void warnings_are_published(void **state)
{
    (void)state;
    wo_host *host = open_host(1, 0);
    reset_clips(1);
    wo_host_instance *instance = create(host, "Filter", 1);
    published p = {0};
    wo_host_render_args args = WO_HOST_RENDER_INIT;
    wo_image got = {.data = NULL};
    args.report_user = &p;
    args.publish = keep;
    args.report = WO_HOST_REPORT_RENDER;
    connect_clip(instance, PROBE_SOURCE);
    assert_int_equal(wo_host_param_set_text(instance, "note", "a: b", NULL), WO_OK);
    assert_int_equal(wo_host_render(instance, &args, &got, NULL, NULL), WO_OK);
    wo_host_image_free(&got);
    assert_int_equal(p.warnings, 0);
    assert_int_equal(wo_host_param_set_text(instance, "trouble", "warn", NULL), WO_OK);
    assert_int_equal(wo_host_render(instance, &args, &got, NULL, NULL), WO_OK);
    wo_host_image_free(&got);
    assert_string_equal(p.said, "probe-note: the note is a: b\nprobe-rows: some rows are odd\n");
    assert_non_null(strstr(p.text, "\"warnings\": [{\"key\": \"probe-note\", "));
    p = (published){0};
    args.report = WO_HOST_REPORT_EXPLAIN;
    assert_int_equal(wo_host_render(instance, &args, &got, NULL, NULL), WO_OK);
    wo_host_image_free(&got);
    assert_int_equal(p.plans, 1);
    assert_string_equal(p.said, "probe-note: the note is a: b\n");
    assert_string_equal(wo_host_persistent_message(instance), "");

    args.report = WO_HOST_REPORT_NONE;
    assert_int_equal(wo_host_render(instance, &args, &got, NULL, NULL), WO_OK);
    wo_host_image_free(&got);
    assert_string_equal(wo_host_persistent_message(instance),
                        "the note is a: b\nsome rows are odd");
    wo_host_instance_destroy(&instance);
    close_host(&host);
}

/* A camera that pulls focus. */
static wo_status metadata(void *user, double time, wo_host_add_metadata *add, void *to,
                          wo_error *error)
{
    const noise *const n = user;
    char focus[32];
    (void)error;
    if (n->missing)
        return wo_fail(error, WO_ERR_NOT_FOUND, "no picture");
    snprintf(focus, sizeof focus, "%g", time);
    if (n == &clips[PROBE_DEPTH])
        add(to, "focus", focus);
    if (n != &clips[PROBE_SOURCE])
        add(to, "aperture", "11"); /* Source comes first */
    add(to, "exr/aperture", n == &clips[PROBE_SOURCE] ? "4" : "22");
    add(to, "", "");
    return WO_OK;
}

static void explain(wo_host_instance *instance, double time, published *p)
{
    wo_error error = {WO_OK, ""};
    wo_image got = {.data = NULL};
    wo_host_render_args args = WO_HOST_RENDER_INIT;
    args.time = time;
    args.report = WO_HOST_REPORT_EXPLAIN;
    args.report_user = p;
    args.publish = keep;
    if (wo_host_render(instance, &args, &got, NULL, &error) != WO_OK)
        fail_msg("%s", error.text);
    wo_host_image_free(&got);
}

static void metadata_is_that_of_the_frame(void **state)
{
    (void)state;
    wo_host *host = open_host(1, 0);
    reset_clips(1);
    wo_host_instance *instance = create(host, "General", 1);
    published p = {0};
    for (int i = 0; i < 3; i++) {
        wo_host_source source = source_of(&clips[i]);
        source.metadata = metadata;
        assert_int_equal(wo_host_set_clip(instance, probe_effect.clips[i].name, &source, NULL),
                         WO_OK);
    }
    static const double times[] = {3, 8, 3};
    for (size_t i = 0; i < WO_COUNT(times); i++) {
        char wanted[64];
        explain(instance, times[i], &p);
        snprintf(wanted, sizeof wanted, "camera=4 exr/aperture %g\n", times[i]);
        assert_non_null(strstr(p.text, wanted));
    }
    clips[PROBE_DEPTH].missing = true; /* no picture, no metadata, no failure */
    explain(instance, 5, &p);
    assert_non_null(strstr(p.text, "camera=4 exr/aperture 0\n"));
    connect_clip(instance, PROBE_SOURCE); /* without metadata */
    explain(instance, 5, &p);
    assert_non_null(strstr(p.text, "camera=0  0\n"));
    wo_host_instance_destroy(&instance);
    close_host(&host);
}

typedef struct racer {
    wo_host_instance *instance;
    setup s;
    wo_image wanted;
    int wrong;
} racer;

static void *race(void *user)
{
    racer *const r = user;
    const wo_host_render_args args = args_of(&r->s);
    for (int round = 0; round < 10; round++) {
        wo_image got = {.data = NULL};
        r->wrong += wo_host_render(r->instance, &args, &got, NULL, NULL) != WO_OK;
        for (int32_t y = r->wanted.bounds.y1; got.data && y < r->wanted.bounds.y2; y++)
            r->wrong += memcmp(wo_image_at(&r->wanted, r->wanted.bounds.x1, y),
                               wo_image_at(&got, r->wanted.bounds.x1, y),
                               (size_t)wo_rect_width(r->wanted.bounds) * 16) != 0;
        wo_host_image_free(&got);
    }
    return NULL;
}

static void two_instances_work_side_by_side(void **state)
{
    (void)state;
    static const char *const radii[] = {"1", "5"};
    wo_host *host = open_host(2, 0);
    racer racers[2];
    pthread_t threads[2];
    reset_clips(1);
    for (int i = 0; i < 2; i++) {
        racers[i] = (racer){.instance = create(host, "General", 1), .s = default_setup()};
        racers[i].s.params.radius = i ? 5 : 1;
        for (int clip = 0; clip < PROBE_CLIPS; clip++)
            connect_clip(racers[i].instance, clip);
        set(racers[i].instance, "radius", radii[i]);
        racers[i].wanted = expected(&racers[i].s);
    }
    for (int i = 0; i < 2; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, race, &racers[i]), 0);
    for (int i = 0; i < 2; i++)
        pthread_join(threads[i], NULL);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(racers[i].wrong, 0);
        free(racers[i].wanted.data);
        wo_host_instance_destroy(&racers[i].instance);
    }
    close_host(&host);
}

/* Renders of one instance at once share a progress bar, of which there is one. */
static void tiles_of_one_instance_may_overlap(void **state)
{
    (void)state;
    wo_host *host = open_host(4, 0);
    reset_clips(1);
    wo_host_instance *instance = create(host, "General", 1);
    setup s = default_setup();
    s.params.trouble = PROBE_TROUBLE_SLOW;
    wo_host_render_args args = args_of(&s);
    args.tile_height = 2;
    args.parallel_tiles = 4;
    for (int clip = 0; clip < PROBE_CLIPS; clip++)
        connect_clip(instance, clip);
    set(instance, "trouble", "Be slow");
    assert_render(instance, &s, &args);
    wo_host_instance_destroy(&instance);
    close_host(&host);
}

static void unpremultiplied_sources_are_not_copied(void **state)
{
    (void)state;
    wo_host *host = open_host(1, 0);
    reset_clips(1);
    wo_host_instance *instance = create(host, "Filter", 1);
    const setup s = default_setup();
    const wo_host_render_args args = args_of(&s);
    wo_image got = {.data = NULL};
    wo_host_render_result result;
    wo_host_source source = source_of(&clips[0]);
    source.alpha = WO_HOST_UNPREMULTIPLIED;
    assert_int_equal(wo_host_set_clip(instance, "Source", &source, NULL), WO_OK);
    set(instance, "on", "false");
    set(instance, "radius", "0");
    assert_int_equal(wo_host_render(instance, &args, &got, &result, NULL), WO_OK);
    assert_false(result.identity);
    const float *const pixel = wo_image_at(&got, 7, 9);
    assert_true(fabsf(pixel[1] - noise_at(&clips[0], 7, 9, 1) * noise_at(&clips[0], 7, 9, 3)) <
                1e-6f);
    wo_host_image_free(&got);
    wo_host_instance_destroy(&instance);
    close_host(&host);
}

static void it_outlives_purging_and_syncing(void **state)
{
    (void)state;
    wo_host *host = open_host(1, 0);
    reset_clips(1);
    wo_host_instance *instance = create(host, "Filter", 1);
    assert_int_equal(wo_host_purge(instance, NULL), WO_OK);
    assert_int_equal(wo_host_sync(instance, NULL), WO_OK);
    wo_host_instance_destroy(&instance);
    close_host(&host);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_description_is_the_table),
        cmocka_unit_test(it_can_be_loaded_many_times),
        cmocka_unit_test(optional_clips_may_be_missing),
        cmocka_unit_test(a_source_without_pictures_is_black),
        cmocka_unit_test(scales_aspects_layouts_and_tiles_agree),
        cmocka_unit_test(parameters_reach_the_effect),
        cmocka_unit_test(preferences_ask_for_linear_light),
        cmocka_unit_test(identity_costs_nothing),
        cmocka_unit_test(an_abort_ends_the_render_early),
        cmocka_unit_test(errors_are_shown_and_go_away),
        cmocka_unit_test(plans_and_reports_are_published),
        cmocka_unit_test(warnings_are_published),
        cmocka_unit_test(metadata_is_that_of_the_frame),
        cmocka_unit_test(two_instances_work_side_by_side),
        cmocka_unit_test(tiles_of_one_instance_may_overlap),
        cmocka_unit_test(unpremultiplied_sources_are_not_copied),
        cmocka_unit_test(it_outlives_purging_and_syncing),
    };
    return cmocka_run_group_tests_name("glue under the strict host", tests, NULL, NULL);
}
