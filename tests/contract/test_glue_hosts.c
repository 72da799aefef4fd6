/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "glue_fixture.h"

#include <limits.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* Hosts as they are, part one: suites, life and death, threads, memory, messages. Part two is
   test_glue_images.c. */

static const wo_rect full = {0, 0, 12, 7};

static void pictures(void)
{
    picture_make(&mock.pictures[0], full, kOfxBitDepthFloat, kOfxImageComponentRGBA, 0, 1);
    picture_make(&mock.pictures[MOCK_OUTPUT], full, kOfxBitDepthFloat, kOfxImageComponentRGBA, 0,
                 9);
}

static void assert_default_render(OfxImageEffectHandle effect)
{
    expected e;
    picture_fill(&mock.pictures[MOCK_OUTPUT], 0x7f);
    render(effect, full, kOfxStatOK);
    expect_defaults(&e);
    assert_output(expect_pixels(&e, full), full);
}

static void reload(unsigned flags)
{
    probe->mainEntry(kOfxActionUnload, NULL, NULL, NULL);
    mock.flags = flags;
    assert_int_equal(probe->mainEntry(kOfxActionLoad, NULL, NULL, NULL), kOfxStatOK);
}

static void the_binary_offers_its_plugins(void **state)
{
    (void)state;
    assert_int_equal(probe_count(), 3);
    assert_null(probe_get(3));
    assert_string_equal(probe_get(1)->pluginIdentifier, "org.wideopen.test.Demanding");
    assert_null(probe_get(-1));
    assert_ptr_equal(probe_get(0), probe);
    assert_string_equal(probe->pluginApi, "OfxImageEffectPluginAPI");
    assert_int_equal(probe->apiVersion, 1);
    assert_int_equal(probe_set_host(mock_host()), kOfxStatOK);
    assert_int_equal(probe_set_host(NULL), kOfxStatFailed);
}

static void needed_suites_are_demanded(void **state)
{
    static const unsigned lacks[] = {MOCK_NO_PROPERTIES, MOCK_NO_PARAMS};
    (void)state;
    for (size_t i = 0; i < WO_COUNT(lacks); i++) {
        probe->mainEntry(kOfxActionUnload, NULL, NULL, NULL);
        mock.flags = lacks[i];
        assert_int_equal(probe->mainEntry(kOfxActionLoad, NULL, NULL, NULL),
                         kOfxStatErrMissingHostFeature);
        OfxStatus status = kOfxStatOK;
        assert_null(mock_create(probe, kOfxImageEffectContextFilter, &status));
        assert_int_equal(status, kOfxStatErrMissingHostFeature);
    }
    reload(0);
    OfxStatus unloaded = kOfxStatOK;
    assert_int_equal(probe->mainEntry(kOfxActionUnload, NULL, NULL, NULL), kOfxStatOK);
    assert_null(mock_create(probe, kOfxImageEffectContextFilter, &unloaded));
    assert_int_equal(unloaded, kOfxStatErrMissingHostFeature);
    reload(0);
    assert_int_equal(probe->mainEntry(NULL, NULL, NULL, NULL), kOfxStatErrValue);
    assert_int_equal(probe->mainEntry(kOfxActionDescribe, NULL, NULL, NULL), kOfxStatErrBadHandle);
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    assert_int_equal(probe->mainEntry("OfxActionFromTheFuture", effect, NULL, NULL),
                     kOfxStatReplyDefault);
    assert_int_equal(probe->mainEntry(kOfxImageEffectActionRender, effect, NULL, NULL),
                     kOfxStatFailed);
    assert_int_equal(probe->mainEntry(kOfxImageEffectActionIsIdentity, effect, NULL, NULL),
                     kOfxStatReplyDefault);
    mock_destroy(probe, effect);
}

static void it_loads_and_describes_again_and_again(void **state)
{
    (void)state;
    pictures();
    for (int i = 0; i < 3; i++) {
        const OfxImageEffectHandle effect = create(kOfxImageEffectContextGeneral);
        assert_default_render(effect);
        mock_destroy(probe, effect);
        assert_int_equal(probe->mainEntry(kOfxActionUnload, NULL, NULL, NULL), kOfxStatOK);
        if (i == 1) /* some hosts set theirs only once */
            probe->setHost(mock_host());
        assert_int_equal(probe->mainEntry(kOfxActionLoad, NULL, NULL, NULL), kOfxStatOK);
    }
}

static void contexts_are_filter_and_general(void **state)
{
    (void)state;
    OfxStatus status = kOfxStatOK;
    assert_null(mock_create(probe, kOfxImageEffectContextPaint, &status));
    assert_int_equal(status, kOfxStatErrUnsupported);
    mock_destroy(probe, create(kOfxImageEffectContextFilter));
    mock_destroy(probe, create(kOfxImageEffectContextGeneral));
}

/* In a filter a host need not wire more than Source, so that nothing else may be demanded. */
static void filters_demand_source_only(void **state)
{
    (void)state;
    OfxPlugin *const demanding = probe_get(1);
    const struct {
        const char *context;
        int source, depth, mask, output;
    } rows[] = {{kOfxImageEffectContextFilter, 0, 1, 1, 0},
                {kOfxImageEffectContextGeneral, 0, 0, 1, 0}};
    demanding->setHost(mock_host());
    assert_int_equal(demanding->mainEntry(kOfxActionLoad, NULL, NULL, NULL), kOfxStatOK);
    for (size_t i = 0; i < WO_COUNT(rows); i++) {
        OfxStatus status = kOfxStatFailed;
        const OfxImageEffectHandle effect = mock_create(demanding, rows[i].context, &status);
        assert_non_null(effect);
        assert_int_equal(mock_clip_number(effect, "Source", kOfxImageClipPropOptional),
                         rows[i].source);
        assert_int_equal(mock_clip_number(effect, "Depth", kOfxImageClipPropOptional),
                         rows[i].depth);
        assert_int_equal(mock_clip_number(effect, "Mask", kOfxImageClipPropOptional), rows[i].mask);
        assert_int_equal(mock_clip_number(effect, "Output", kOfxImageClipPropOptional),
                         rows[i].output);
        assert_int_equal(mock_clip_number(effect, "Mask", kOfxImageClipPropIsMask), 1);
        assert_int_equal(mock_clip_number(effect, "Depth", kOfxImageClipPropIsMask), 0);
        mock_destroy(demanding, effect);
    }
    assert_int_equal(demanding->mainEntry(kOfxActionUnload, NULL, NULL, NULL), kOfxStatOK);
}

static void parameters_are_those_of_the_table(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextGeneral);
    const struct {
        const char *param, *property, *value;
        int index;
    } rows[] = {
        {"", kOfxPropLabel, "Probe", 0},
        {"", kOfxImageEffectPluginPropGrouping, "WideOpen/Test", 0},
        {"", kOfxImageEffectPluginRenderThreadSafety, kOfxImageEffectRenderFullySafe, 0},
        {"", kOfxImageEffectPluginPropHostFrameThreading, "0", 0},
        {"", kOfxImageEffectPropSupportsTiles, "1", 0},
        {"", kOfxImageEffectPropSupportsMultiResolution, "1", 0},
        {"", kOfxImageEffectPropTemporalClipAccess, "0", 0},
        {"", kOfxImageEffectPropSupportedPixelDepths, kOfxBitDepthFloat, 0},
        {"radius", kOfxParamPropDefault, "2", 0},
        {"radius", kOfxParamPropMin, "0", 0},
        {"radius", kOfxParamPropMax, "1000", 0},
        {"radius", kOfxParamPropDisplayMin, "0", 0},
        {"radius", kOfxParamPropDisplayMax, "20", 0},
        {"radius", kOfxParamPropIncrement, "0.01", 0},
        {"radius", kOfxParamPropDigits, "2", 0},
        {"radius", kOfxParamPropDoubleType, kOfxParamDoubleTypePlain, 0},
        {"radius", kOfxParamPropHint, "Half the width of the box. [px]", 0},
        {"radius", kOfxParamPropScriptName, "radius", 0},
        {"radius", kOfxParamPropParent, "blur", 0},
        {"radius", kOfxParamPropAnimates, "1", 0},
        {"angle", kOfxParamPropDoubleType, kOfxParamDoubleTypeAngle, 0},
        {"repeats", kOfxParamPropMax, "9", 0},
        {"repeats", kOfxParamPropDisplayMax, "5", 0},
        {"repeats", kOfxParamPropAnimates, "1", 0},
        {"on", kOfxParamPropDefault, "1", 0},
        {"on", kOfxParamPropAnimates, "0", 0}, /* this host cannot */
        {"trouble", kOfxParamPropChoiceOption, "Be slow", 2},
        {"centre", kOfxParamPropDisplayMax, "2000", 1},
        {"centre", kOfxParamPropMin, "-5000", 1},
        {"tint", kOfxParamPropDefault, "1", 2},
        {"tint", kOfxParamPropDisplayMax, "1", 2},
        {"note", kOfxParamPropDefault, "nothing", 0},
        {"note", kOfxParamPropParent, "rest", 0},
        {"blur", kOfxParamPropGroupOpen, "1", 0},
        {"rest", kOfxParamPropGroupOpen, "0", 0},
        {"Controls", kOfxParamPropPageChild, "note", 7},
    };
    assert_int_equal(mock_param_count(effect), 8 + 2 + 1);
    for (size_t i = 0; i < WO_COUNT(rows); i++) {
        const char *const value =
            mock_param_text(effect, rows[i].param, rows[i].property, rows[i].index);
        if (!value)
            fail_msg("%s of %s is not set", rows[i].property, rows[i].param);
        assert_string_equal(value, rows[i].value);
    }
    assert_null(mock_param_text(effect, "trouble", kOfxParamPropChoiceOption, 5));
    mock_destroy(probe, effect);
}

static void types_the_host_lacks_are_done_without(void **state)
{
    static const char *const types[] = {
        kOfxParamTypeDouble, kOfxParamTypeInteger, kOfxParamTypeBoolean,
        kOfxParamTypeChoice, kOfxParamTypeRGB,     kOfxParamTypeDouble2D,
        kOfxParamTypeString, kOfxParamTypeGroup,   kOfxParamTypePage};
    (void)state;
    pictures();
    for (size_t i = 0; i < WO_COUNT(types); i++) {
        mock.refuse = types[i];
        const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
        assert_true(mock_param_count(effect) < 11);
        if (strcmp(types[i], kOfxParamTypeGroup) == 0)
            assert_null(mock_param_text(effect, "radius", kOfxParamPropParent, 0));
        assert_default_render(effect);
        mock_destroy(probe, effect);
    }
}

static void properties_the_host_lacks_are_done_without(void **state)
{
    static const char *const names[] = {kOfxImageEffectPluginPropHostFrameThreading,
                                        kOfxPropVersion,
                                        kOfxPropPluginDescription,
                                        kOfxImageEffectPluginRenderThreadSafety,
                                        kOfxParamPropDisplayMin,
                                        kOfxParamPropHint,
                                        kOfxParamPropDoubleType,
                                        kOfxImageClipPropIsMask,
                                        kOfxImagePropPixelAspectRatio,
                                        kOfxImageEffectPropPreMultiplication,
                                        kOfxImageClipPropConnected};
    (void)state;
    pictures();
    for (int i = 1; i < MOCK_OUTPUT; i++)
        mock.pictures[i].silent = true;
    for (size_t i = 0; i < WO_COUNT(names); i++) {
        mock.forget = names[i];
        const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
        assert_default_render(effect);
        mock_destroy(probe, effect);
    }
    /* But a plugin that cannot say its contexts is of no use. */
    OfxStatus status = kOfxStatOK;
    mock.forget = kOfxImageEffectPropSupportedContexts;
    assert_null(mock_create(probe, kOfxImageEffectContextFilter, &status));
    assert_int_equal(status, kOfxStatErrUnknown);
}

static void optional_suites_are_optional(void **state)
{
    static const unsigned flags[] = {MOCK_NO_MEMORY,
                                     MOCK_NO_THREADS,
                                     MOCK_NO_MESSAGE1,
                                     MOCK_NO_MESSAGE2,
                                     MOCK_NO_PROGRESS,
                                     MOCK_NO_REPORT,
                                     MOCK_HOLLOW_MESSAGE2,
                                     MOCK_HOLLOW_THREADS,
                                     MOCK_HOLLOW_PROGRESS,
                                     MOCK_HOLLOW_EFFECT,
                                     MOCK_NO_INSTANCE_DATA,
                                     MOCK_NO_MEMORY | MOCK_HOLLOW_EFFECT,
                                     MOCK_NO_MEMORY | MOCK_NO_THREADS | MOCK_NO_MESSAGE1 |
                                         MOCK_NO_MESSAGE2 | MOCK_NO_PROGRESS | MOCK_NO_REPORT |
                                         MOCK_HOLLOW_EFFECT | MOCK_NO_INSTANCE_DATA};
    (void)state;
    pictures();
    for (size_t i = 0; i < WO_COUNT(flags); i++) {
        reload(flags[i]);
        const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
        assert_default_render(effect);
        assert_true(mock_set_number(effect, "trouble", PROBE_TROUBLE_FAIL, 0, 0));
        render(effect, full, kOfxStatFailed);
        mock_destroy(probe, effect);
    }
}

static void strange_threads_change_nothing(void **state)
{
    static const mock_threading kinds[] = {MOCK_THREADS_REAL, MOCK_THREADS_SERIAL,
                                           MOCK_THREADS_SAME, MOCK_THREADS_MORE,
                                           MOCK_THREADS_FAIL, MOCK_THREADS_EMPTY};
    (void)state;
    pictures();
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    for (size_t i = 0; i < WO_COUNT(kinds); i++)
        for (mock.cpus = 0; mock.cpus < 6; mock.cpus++) {
            mock.threading = kinds[i];
            mock.multi_thread_calls = 0;
            assert_default_render(effect);
            assert_int_equal(mock.multi_thread_calls, mock.cpus > 1);
        }
    mock.cpus = 4;
    mock.spawned = true;
    mock.multi_thread_calls = 0;
    assert_default_render(effect);
    assert_int_equal(mock.multi_thread_calls, 0);
    mock_destroy(probe, effect);
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    const unsigned flags[] = {0, MOCK_NO_MEMORY};
    picture_make(&mock.pictures[0], full, kOfxBitDepthByte, kOfxImageComponentRGB, 0, 1);
    picture_make(&mock.pictures[1], full, kOfxBitDepthHalf, kOfxImageComponentAlpha, 0, 2);
    picture_make(&mock.pictures[2], full, kOfxBitDepthShort, kOfxImageComponentRGBA, 0, 3);
    picture_make(&mock.pictures[MOCK_OUTPUT], full, kOfxBitDepthByte, kOfxImageComponentRGBA, 0, 9);
    for (size_t i = 0; i < WO_COUNT(flags); i++) {
        reload(flags[i]);
        mock.fail_after = 0;
        OfxStatus status = kOfxStatOK;
        assert_null(mock_create(probe, kOfxImageEffectContextGeneral, &status));
        assert_int_equal(status, kOfxStatErrMemory);
        mock.fail_after = -1;

        const OfxImageEffectHandle effect = create(kOfxImageEffectContextGeneral);
        const double scale[2] = {1, 1};
        char clip[64];
        OfxRectD needed;
        int failures = 0;
        mock.report_mode = kWideOpenReportRender;
        for (long n = 0; status != kOfxStatOK; n++) {
            mock_region(probe, effect, &needed); /* counts what has been allocated so far */
            mock.fail_after = mock.allocations + n;
            status = mock_render(probe, effect, full, scale, NULL);
            assert_int_equal(mock.live_images, 0);
            assert_int_equal(mock.live_blocks, 1); /* the instance's */
            if (status != kOfxStatOK) {
                assert_int_equal(status, kOfxStatErrMemory);
                assert_true(mock.persistent_set);
                failures++;
            }
            assert_true(n < 100);
        }
        /* params, output, three inputs, plan, workers, report */
        assert_int_equal(failures, 8);
        assert_false(mock.persistent_set);

        mock_region(probe, effect, &needed);
        mock.fail_after = mock.allocations;
        assert_int_equal(mock_identity(probe, effect, clip), kOfxStatErrMemory);
        mock.fail_after = mock.allocations;
        assert_int_equal(mock_needed(probe, effect, (OfxRectD){0, 0, 4, 4}, "Source", &needed),
                         kOfxStatErrMemory);
        mock.fail_after = -1;
        mock_destroy(probe, effect);
    }
}

static void a_message_stays_until_the_next_success(void **state)
{
    (void)state;
    char clip[64];
    pictures();
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    mock_set_number(effect, "trouble", PROBE_TROUBLE_FAIL, 0, 0);
    mock_set_text(effect, "note", "50%s %n off");
    render(effect, full, kOfxStatFailed);
    assert_true(mock.persistent_set);
    assert_int_equal(mock.messages, 0);
    assert_string_equal(mock.message, "trouble was asked for: 50%s %n off");
    mock_set_number(effect, "trouble", PROBE_TROUBLE_NONE, 0, 0);
    assert_int_equal(mock_identity(probe, effect, clip), kOfxStatReplyDefault);
    assert_true(mock.persistent_set); /* nothing has been rendered yet */
    render(effect, full, kOfxStatOK);
    assert_false(mock.persistent_set);
    mock_destroy(probe, effect);
}

static void a_message_pops_up_only_once(void **state)
{
    (void)state;
    pictures();
    reload(MOCK_NO_MESSAGE2);
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    for (int round = 1; round <= 2; round++) {
        mock_set_number(effect, "trouble", PROBE_TROUBLE_FAIL, 0, 0);
        for (int tile = 0; tile < 4; tile++)
            render(effect, (wo_rect){tile * 3, 0, tile * 3 + 3, 7}, kOfxStatFailed);
        assert_int_equal(mock.messages, round);
        mock_set_number(effect, "trouble", PROBE_TROUBLE_NONE, 0, 0);
        render(effect, full, kOfxStatOK);
    }
    mock_destroy(probe, effect);
}

/* Beside the node, told again only when the text changes, and gone with the whole picture that
   gives no cause; an error takes its place and gives it back. */
static void a_warning_stays_while_there_is_cause(void **state)
{
    (void)state;
    pictures();
    reload(MOCK_NO_REPORT);
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    mock_set_number(effect, "trouble", PROBE_TROUBLE_WARN, 0, 0);
    mock_set_text(effect, "note", "100%s");
    for (int tile = 0; tile < 4; tile++)
        render(effect, (wo_rect){tile * 3, 0, tile * 3 + 3, 7}, kOfxStatOK);
    assert_true(mock.persistent_set);
    assert_int_equal(mock.persistent, 1);
    assert_int_equal(mock.messages, 0);
    assert_string_equal(mock.message, "the note is 100%s\nsome rows are odd");
    mock_set_text(effect, "note", "new");
    render(effect, full, kOfxStatOK);
    assert_int_equal(mock.persistent, 2);
    assert_string_equal(mock.message, "the note is new\nsome rows are odd");

    mock_set_number(effect, "trouble", PROBE_TROUBLE_FAIL, 0, 0);
    render(effect, full, kOfxStatFailed);
    assert_string_equal(mock.message, "trouble was asked for: new");
    mock_set_number(effect, "trouble", PROBE_TROUBLE_WARN, 0, 0);
    render(effect, full, kOfxStatOK);
    assert_string_equal(mock.message, "the note is new\nsome rows are odd");
    assert_true(mock.persistent_set);

    mock_set_number(effect, "trouble", PROBE_TROUBLE_NONE, 0, 0);
    render(effect, (wo_rect){0, 0, 3, 7}, kOfxStatOK);
    assert_true(mock.persistent_set); /* a part of the picture clears nobody */
    render(effect, full, kOfxStatOK);
    assert_false(mock.persistent_set);

    /* A host that never renders the whole at once: tiles give and take, and say it once. */
    const int told = mock.persistent;
    mock_set_number(effect, "trouble", PROBE_TROUBLE_WARN, 0, 0);
    for (int tile = 0; tile < 4; tile++) {
        mock_set_text(effect, "note", tile % 2 ? "odd" : "even");
        render(effect, (wo_rect){tile * 3, 0, tile * 3 + 3, 7}, kOfxStatOK);
    }
    assert_int_equal(mock.persistent, told + 1);
    mock_set_number(effect, "trouble", PROBE_TROUBLE_NONE, 0, 0);
    render(effect, (wo_rect){6, 0, 9, 7}, kOfxStatOK);
    assert_true(mock.persistent_set);
    render(effect, (wo_rect){0, 0, 3, 7}, kOfxStatOK);
    assert_false(mock.persistent_set);
    mock_destroy(probe, effect);
}

static void a_warning_pops_up_once_for_each_kind(void **state)
{
    (void)state;
    pictures();
    reload(MOCK_NO_MESSAGE2);
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    for (int round = 0; round < 3; round++) {
        mock_set_text(effect, "note", round ? "other" : "one");
        mock_set_number(effect, "trouble", PROBE_TROUBLE_WARN, 0, 0);
        render(effect, full, kOfxStatOK);
        render(effect, full, kOfxStatOK);
        mock_set_number(effect, "trouble", PROBE_TROUBLE_NONE, 0, 0);
        render(effect, full, kOfxStatOK);
    }
    assert_int_equal(mock.messages, 1);
    assert_string_equal(mock.message, "the note is one\nsome rows are odd");
    mock_destroy(probe, effect);
}

static void an_abort_stops_the_render(void **state)
{
    (void)state;
    picture_make(&mock.pictures[0], (wo_rect){0, 0, 40, 400}, kOfxBitDepthFloat,
                 kOfxImageComponentRGBA, 0, 1);
    picture_make(&mock.pictures[MOCK_OUTPUT], (wo_rect){0, 0, 40, 400}, kOfxBitDepthFloat,
                 kOfxImageComponentRGBA, 0, 9);
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    picture_fill(&mock.pictures[MOCK_OUTPUT], 0);
    mock.abort_after = 100;
    mock.report_mode = kWideOpenReportRender;
    render(effect, (wo_rect){0, 0, 40, 400}, kOfxStatOK);
    assert_string_equal(mock.published, ""); /* no report of half a picture */
    assert_int_equal(mock.persistent, 0);
    assert_true(picture_value(&mock.pictures[MOCK_OUTPUT], 0, 0, 3) != 0);
    assert_true(picture_value(&mock.pictures[MOCK_OUTPUT], 0, 399, 3) == 0);
    assert_true(mock.progress_last < 0.5);
    mock_destroy(probe, effect);
}

static void the_progress_bar_rises_and_can_cancel(void **state)
{
    (void)state;
    pictures();
    const unsigned flags[] = {0, MOCK_HOLLOW_PROGRESS};
    for (size_t i = 0; i < WO_COUNT(flags); i++) {
        reload(flags[i]);
        const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
        mock.progress_starts = mock.progress_ends = 0;
        mock.progress_last = 0;
        mock.cancel = false;
        assert_default_render(effect);
        assert_int_equal(mock.progress_starts, 1);
        assert_int_equal(mock.progress_ends, 1);
        assert_true(mock.progress_last > 0 && mock.progress_last <= 1);

        mock.cancel = true;
        mock.progress_last = 0;
        mock_set_number(effect, "trouble", PROBE_TROUBLE_SLOW, 0, 0);
        picture_fill(&mock.pictures[MOCK_OUTPUT], 0);
        mock.cpus = 1;
        render(effect, full, kOfxStatOK);
        assert_true(picture_value(&mock.pictures[MOCK_OUTPUT], 0, 6, 3) == 0);
        assert_int_equal(mock.progress_ends, 2);
        mock_destroy(probe, effect);
    }
}

static void reports_are_published_when_asked_for(void **state)
{
    (void)state;
    pictures();
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    assert_default_render(effect);
    assert_string_equal(mock.kind, "");
    mock.report_mode = kWideOpenReportRender;
    assert_default_render(effect);
    assert_string_equal(mock.kind, "report");
    assert_non_null(strstr(mock.published, "\"pixels\": 84,"));
    assert_non_null(strstr(mock.published, "this is a box"));
    mock_set_text(effect, "note", "remember");
    picture_fill(&mock.pictures[MOCK_OUTPUT], 0);
    assert_non_null(strstr(explain(effect, full, NULL), "note=remember\n"));
    assert_true(picture_value(&mock.pictures[MOCK_OUTPUT], 5, 5, 0) ==
                0); /* nothing was rendered */
    mock_destroy(probe, effect);
}

static void values_beyond_the_range_are_met(void **state)
{
    (void)state;
    static char longest[2000];
    expected e;
    pictures();
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    mock_set_number(effect, "angle", 1e9, 0, 0);
    mock_set_number(effect, "repeats", -5, 0, 0);
    mock_set_number(effect, "on", 77, 0, 0);
    mock_set_number(effect, "tint", -1, 1e30, INFINITY);
    mock_set_text(effect, "note", NULL);
    render(effect, full, kOfxStatOK);
    expect_defaults(&e);
    e.params.angle = 360;
    e.params.tint[0] = 0;
    e.params.tint[1] = e.params.tint[2] = 8;
    assert_output(expect_pixels(&e, full), full);

    mock_set_number(effect, "angle", NAN, 0, 0);
    render(effect, full, kOfxStatFailed);
    assert_non_null(strstr(mock.message, "angle: nan is outside"));
    mock_set_number(effect, "angle", 0, 0, 0);
    mock_set_number(effect, "trouble", 9, 0, 0);
    render(effect, full, kOfxStatFailed);
    assert_non_null(strstr(mock.message, "trouble: 9"));
    mock_set_number(effect, "trouble", 0, 0, 0);
    memset(longest, 'x', sizeof longest - 1);
    mock_set_text(effect, "note", longest);
    render(effect, full, kOfxStatFailed);
    assert_non_null(strstr(mock.message, "note:"));
    mock_destroy(probe, effect);
}

static void metadata_is_taken_where_it_is_offered(void **state)
{
    (void)state;
    pictures();
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextGeneral);
    assert_non_null(strstr(explain(effect, full, NULL), "camera=0  0\n"));
    mock.pictures[0].names[0] = "nothing";
    mock.pictures[0].names[1] = "exr/aperture";
    mock.pictures[0].names[2] = "focus"; /* a name too many */
    mock.pictures[0].values[0] = "";
    mock.pictures[0].values[1] = "5.6";
    assert_non_null(strstr(explain(effect, full, NULL), "camera=5.6 exr/aperture 0\n"));
    mock.forget = kWideOpenClipPropMetadataValues;
    assert_non_null(strstr(explain(effect, full, NULL), "camera=0  0\n"));
    mock.forget = NULL;
    mock_destroy(probe, effect);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, fixture_load, fixture_unload)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(the_binary_offers_its_plugins),
        TEST(needed_suites_are_demanded),
        TEST(it_loads_and_describes_again_and_again),
        TEST(contexts_are_filter_and_general),
        TEST(filters_demand_source_only),
        TEST(parameters_are_those_of_the_table),
        TEST(types_the_host_lacks_are_done_without),
        TEST(properties_the_host_lacks_are_done_without),
        TEST(optional_suites_are_optional),
        TEST(strange_threads_change_nothing),
        TEST(every_allocation_may_fail),
        TEST(a_message_stays_until_the_next_success),
        TEST(a_message_pops_up_only_once),
        TEST(a_warning_stays_while_there_is_cause),
        TEST(a_warning_pops_up_once_for_each_kind),
        TEST(an_abort_stops_the_render),
        TEST(the_progress_bar_rises_and_can_cancel),
        TEST(reports_are_published_when_asked_for),
        TEST(values_beyond_the_range_are_met),
        TEST(metadata_is_taken_where_it_is_offered),
    };
    return cmocka_run_group_tests_name("glue and odd hosts", tests, fixture_open, fixture_close);
}
