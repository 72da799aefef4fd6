/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "host_fixture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* What plugins may do and what they are told; the plugin Legal fails when an answer is wrong. */

static char said[4096]; /* the plugin's messages, one behind the other */

static bool listen(void *user, wo_host_message type, const char *id, const char *text)
{
    const size_t used = strlen(said);
    (void)user;
    (void)type;
    (void)id;
    snprintf(said + used, sizeof said - used, "%s", text);
    return true;
}

static wo_host *open_host(void)
{
    static const char *const directories[] = {WO_TEST_PLUGINS "/legal"};
    const wo_host_config config = {.threads = 2,
                                   .directories = directories,
                                   .directory_count = 1,
                                   .strict = true,
                                   .message = listen};
    wo_host *host = NULL;
    said[0] = '\0';
    ok(wo_host_create(&config, &host, &ok_error));
    return host;
}

static wo_host_instance *create(wo_host *host, const char *context)
{
    const wo_host_project project = {.size = {40, 30},
                                     .pixel_aspect = 1.5,
                                     .frame_rate = 30,
                                     .first_frame = 3,
                                     .last_frame = 90};
    const wo_host_plugin *plugin = NULL;
    wo_host_instance *instance = NULL;
    ok(wo_host_find_plugin(host, "Legal", &plugin, &ok_error));
    ok(wo_host_instance_create(host, plugin, context, &project, &instance, &ok_error));
    return instance;
}

static void connect(wo_host_instance *instance, const char *clip, wo_host_still *still)
{
    wo_host_source source = WO_HOST_SOURCE_INIT;
    source.user = still;
    source.components = still->image.components;
    source.alpha = WO_HOST_UNPREMULTIPLIED;
    source.pixel_aspect = still->pixel_aspect;
    source.frame_rate = 25;
    source.first_frame = 5;
    source.last_frame = 15;
    source.region = wo_host_still_region;
    source.pixels = wo_host_still_pixels;
    ok(wo_host_set_clip(instance, clip, &source, &ok_error));
}

static void press(wo_host_instance *instance, const char *button)
{
    said[0] = '\0';
    ok(wo_host_param_press(instance, button, &ok_error));
}

static void rights_are_granted(void **state)
{
    (void)state;
    static const char *const contexts[] = {"Filter", "General"};
    wo_host_still still = {.image = fixture_picture((wo_rect){0, 0, 40, 30}, 4, 1),
                           .pixel_aspect = 1};
    for (int i = 0; i < 2; i++) {
        wo_host *host = open_host();
        wo_host_instance *instance = create(host, contexts[i]);
        connect(instance, "Source", &still);
        wo_image image = fixture_render(instance, 3, 1, (wo_rect){0, 0, 0, 0}, 16, NULL);
        assert_int_equal(image.bounds.x2, 33);
        assert_true(image.data[0] == 0.5f);
        wo_host_image_free(&image);
        press(instance, "memory");
        assert_false(wo_host_param_visible(instance, "a"));
        assert_false(wo_host_param_enabled(instance, "a"));
        wo_host_unload(host);
        fixture_no_violations(host);
        wo_host_destroy(&host);
    }
    free(still.image.data);
}

/* One note for each name, however often and by however many objects it is set. */
static void extensions_are_noted_once(void **state)
{
    (void)state;
    static const char *const names[] = {"\"OfxParamPropLayoutHint\"",
                                        "\"OfxParamPropLayoutPadWidth\"",
                                        "\"OfxImageEffectPropCanDistort\"",
                                        "\"OfxImageEffectPropRenderQualityDraft\"",
                                        "\"OfxImageEffectPropVegasUpliftGUID\"",
                                        "\"uk.co.thefoundry.OfxImageEffectPropMultiPlanar\"",
                                        "\"OfxImageClipPropFormat\"",
                                        "\"OfxImageEffectPropIdentityPlane\""};
    wo_host_still still = {.image = fixture_picture((wo_rect){0, 0, 40, 30}, 4, 1),
                           .pixel_aspect = 1};
    wo_host *host = open_host();
    wo_host_instance *instance = create(host, "General");
    connect(instance, "Source", &still);
    for (int i = 0; i < 2; i++) {
        wo_image image = fixture_render(instance, 3, 1, (wo_rect){0, 0, 0, 0}, 0, NULL);
        wo_host_image_free(&image);
    }
    for (size_t i = 0; i < WO_COUNT(names); i++) {
        size_t count = 0;
        for (size_t k = 0; k < wo_host_note_count(host); k++)
            count += strstr(wo_host_note(host, k), names[i]) != NULL;
        if (count != 1)
            fail_msg("%zu notes about %s", count, names[i]);
    }
    fixture_no_violations(host);
    wo_host_destroy(&host);
    free(still.image.data);
}

#define PIXELS(kind)      "OfxImageComponent" kind " OfxBitDepthFloat "
#define SAME(kind)        PIXELS(kind) PIXELS(kind)
#define NOTHING_YET(kind) PIXELS(kind) "OfxImageComponentNone OfxBitDepthNone "
#define PREMULTIPLIED     "OfxImageAlphaPremultiplied "
#define UNPREMULTIPLIED   "OfxImageAlphaUnPremultiplied "
#define OPAQUE            "OfxImageOpaque "
#define UNCONNECTED_MASK  "Mask 0 " NOTHING_YET("Alpha") PREMULTIPLIED "1.5 30 3-90 0,0,0,0\n"

static void clips_say_what_would_come(void **state)
{
    (void)state;
    wo_host_still rgba = {.image = fixture_picture((wo_rect){0, 0, 20, 10}, 4, 1),
                          .pixel_aspect = 2};
    wo_host_still rgb = {.image = fixture_picture((wo_rect){0, 0, 20, 10}, 3, 1),
                         .pixel_aspect = 2};
    wo_host_still one = {.image = fixture_picture((wo_rect){0, 0, 20, 10}, 1, 1),
                         .pixel_aspect = 2};
    wo_host *host = open_host();

    /* CreateInstance: nothing is connected; the first kind each clip takes, those of the project */
    wo_host_instance *instance = create(host, "Filter");
    static const char at_first[] = "Source 0 " NOTHING_YET("RGB") OPAQUE
        "1.5 30 3-90 0,0,0,0\n" UNCONNECTED_MASK "Output 1 " SAME("RGB") PREMULTIPLIED
        "1.5 30 3-90 0,0,40,30\n";
    assert_string_equal(said, at_first);

    /* connected: what the source is, mapped where the clip does not take it; the Output follows
       before the plugin has a say */
    connect(instance, "Source", &rgba);
    press(instance, "tell");
    assert_string_equal(said, "Source 1 " SAME("RGBA") UNPREMULTIPLIED
                        "2 25 5-15 0,0,40,10\n" UNCONNECTED_MASK "Output 1 " SAME("RGBA")
                            UNPREMULTIPLIED "2 25 5-15 0,0,40,10\n");
    connect(instance, "Source", &one);
    press(instance, "tell");
    assert_string_equal(said, "Source 1 " PIXELS("RGB") PIXELS("Alpha") OPAQUE
                        "2 25 5-15 0,0,40,10\n" UNCONNECTED_MASK "Output 1 " SAME("RGB") OPAQUE
                        "2 25 5-15 0,0,40,10\n");
    connect(instance, "Source", &rgb);
    connect(instance, "Mask", &one);
    press(instance, "tell");
    assert_string_equal(said, "Source 1 " SAME("RGB") OPAQUE "2 25 5-15 0,0,40,10\n"
                                                             "Mask 1 " SAME("Alpha") UNPREMULTIPLIED
                        "2 25 5-15 0,0,40,10\n"
                        "Output 1 " SAME("RGB") OPAQUE "2 25 5-15 0,0,40,10\n");

    /* where the plugin has pixels is what it has said */
    said[0] = '\0';
    wo_image image = fixture_render(instance, 3, 1, (wo_rect){0, 0, 0, 0}, 0, NULL);
    wo_host_image_free(&image);
    assert_non_null(strstr(said, "Output 1 " SAME("RGB") OPAQUE "2 25 5-15 1,2,33,24\n"));

    /* disconnected: as at first */
    ok(wo_host_set_clip(instance, "Source", NULL, &ok_error));
    ok(wo_host_set_clip(instance, "Mask", NULL, &ok_error));
    press(instance, "tell");
    assert_string_equal(said, at_first);

    fixture_no_violations(host);
    wo_host_destroy(&host);
    free(rgba.image.data);
    free(rgb.image.data);
    free(one.image.data);
}

/* Where the plugin chooses, the Output has as many components at first as the inputs have at most:
   plugins that copy one into the other do not write past the end. */
static void the_output_follows_all_inputs(void **state)
{
    (void)state;
    const struct {
        int32_t source, mask;
        const char *output;
    } rows[] = {{3, 0, "Output 1 " SAME("RGB") OPAQUE},
                {3, 1, "Output 1 " SAME("RGB") OPAQUE},
                {4, 0, "Output 1 " SAME("RGBA") UNPREMULTIPLIED},
                {0, 0, "Output 1 " SAME("RGB") PREMULTIPLIED}};
    for (size_t i = 0; i < WO_COUNT(rows); i++) {
        wo_host *host = open_host();
        wo_host_instance *instance = create(host, "General");
        wo_host_still stills[2] = {{.pixel_aspect = 1}, {.pixel_aspect = 1}};
        const int32_t counts[2] = {rows[i].source, rows[i].mask};
        for (int k = 0; k < 2; k++) {
            if (counts[k] == 0)
                continue;
            stills[k].image = fixture_picture((wo_rect){0, 0, 4, 4}, counts[k], 1);
            connect(instance, k ? "Mask" : "Source", &stills[k]);
        }
        press(instance, "tell");
        assert_non_null(strstr(said, rows[i].output));
        fixture_no_violations(host);
        wo_host_destroy(&host);
        free(stills[0].image.data);
        free(stills[1].image.data);
    }
}

static void own_changes_arrive_in_their_order(void **state)
{
    (void)state;
    wo_host *host = open_host();
    wo_host_instance *instance = create(host, "Filter");
    press(instance, "change");
    assert_string_equal(said, "c a b ");
    wo_host_destroy(&host);
}

/* A plugin's own threads run on after Unload, in code that must still be there. */
static void threads_may_outlive_the_plugin(void **state)
{
    (void)state;
    const struct timespec until = {.tv_nsec = 200000000};
    assert_int_equal(setenv("WO_TEST_LINGER", "1", 1), 0);
    wo_host *host = open_host();
    wo_host_destroy(&host);
    unsetenv("WO_TEST_LINGER");
    nanosleep(&until, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rights_are_granted),
        cmocka_unit_test(extensions_are_noted_once),
        cmocka_unit_test(clips_say_what_would_come),
        cmocka_unit_test(the_output_follows_all_inputs),
        cmocka_unit_test(own_changes_arrive_in_their_order),
        cmocka_unit_test(threads_may_outlive_the_plugin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
