/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "host_fixture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Every breach the plugin Bad can commit, and what the host must say about it. */
typedef struct misdeed {
    const char *name, *text;
} misdeed;

static const misdeed misdeeds[] = {
    /* Load, Describe */
    {"illegal load status", "OfxActionLoad: it answers kOfxStatErrBadIndex (10)"},
    {"no label", "OfxActionDescribe: it has no label"},
    {"no depths", "it supports no pixel depths"},
    {"bad safety", "\"quite\" is no degree of thread safety"},
    {"unknown property set", "propSetInt of \"OfxImageEffectPropNoSuchThing\" of the descriptor of "
                             "org.wideopen.test.Bad: there is no such property"},
    {"wrong type", "propSetDouble of \"OfxPropLabel\" of the descriptor of org.wideopen.test.Bad: "
                   "it is a string"},
    {"bad index", "the index is out of range"},
    {"gap in list", "the index is out of range"},
    {"read-only write", "\"OfxPropType\" of the descriptor of org.wideopen.test.Bad: it is "
                        "read-only"},
    {"host write", "\"OfxPropName\" of the host: it is read-only"},
    {"NULL string", "the value is NULL"},
    {"NULL property name", "the name is NULL"},
    {"clipDefine in describe", "OfxActionDescribe: clipDefine outside of"},
    {"paramDefine in describe", "OfxActionDescribe: paramDefine outside of"},
    {"multiThread with nothing", "multiThread with no function"},
    {"illegal describe status", "OfxActionDescribe: it answers kOfxStatReplyDefault"},
    /* DescribeInContext */
    {"no output", "the clip \"Output\" is not defined"},
    {"no components", "the clip \"Output\" supports no components"},
    {"default out of range", "the default of \"amount\" is 2, outside of"},
    {"range upside down", "the range of \"amount\" is 5 to 1"},
    {"parent is no group", "the parent of \"amount\" is \"nobody\", which is no group"},
    {"two of a name", "there are two parameters \"amount\""},
    {"two clips of a name", "there are two clips \"Source\""},
    {"choice without options", "choice \"empty\" has no options"},
    {"page of strangers", "page \"page\" holds \"stranger\", which is no parameter"},
    {"param handle of a descriptor", "paramGetValue of \"amount\", which is a descriptor's"},
    /* CreateInstance, DestroyInstance, Unload */
    {"leak memory", "OfxActionDestroyInstance: 123 bytes of memory (memoryAlloc) were not freed"},
    {"leak plugin memory", "OfxActionUnload: 321 bytes of memory (memoryAlloc) were not freed"},
    {"leak image memory", "456 bytes of image memory (imageMemoryAlloc) were not freed"},
    {"leak mutex", "OfxActionUnload: a mutex was not destroyed"},
    {"leak locked mutex", "OfxActionUnload: a mutex was not destroyed"},
    {"image in create", "clipGetImage of \"Source\" in an action without images"},
    {"illegal create status", "OfxActionCreateInstance: it answers kOfxStatReplyYes"},
    {"parameter after its life", "OfxActionUnload: paramGetValue: the parameter handle is freed "
                                 "already"},
    /* InstanceChanged */
    {"edit without end", "paramEditBegin without paramEditEnd"},
    {"end without edit", "paramEditEnd without paramEditBegin"},
    {"double free", "memoryFree of memory that memoryAlloc has not given, or that is free already"},
    {"free of a stranger", "memoryFree of memory that memoryAlloc has not given"},
    {"write past memory", "bytes outside of a block of 10 bytes of memory were written"},
    {"write before image memory", "bytes outside of a block of 10 bytes of image memory were "
                                  "written"},
    {"image memory freed twice", "imageMemoryFree: the image memory handle is freed already"},
    {"unlock of an unlocked mutex", "mutexUnLock of a mutex that this thread has not locked"},
    {"mutex destroyed twice", "mutexDestroy: the mutex handle is freed already"},
    {"locked mutex destroyed", "mutexDestroy of a mutex that is locked"},
    {"wrong kind of handle", "clipGetPropertySet: the clip handle is of another kind"},
    {"random handle", "getPropertySet: the effect handle is unknown"},
    {"pointer as handle", "propGetInt of \"OfxPropType\": the property set handle is "},
    {"NULL handle", "paramGetValue: the parameter handle is NULL"},
    {"NULL place", "paramGetValue: no place for the result"},
    {"value of a button", "paramGetValue of \"go\", which has no value"},
    {"derivative of a text", "paramGetDerivative of \"text\", which is a string"},
    {"param set to NaN", "paramSetValue of \"amount\" to "},
    {"text set to NULL", "paramSetValue of \"text\" to NULL"},
    {"copy between types", "paramCopy of \"text\" to \"amount\", which is of another type"},
    {"instance property write", "\"OfxImageEffectPropContext\" of the instance of "
                                "org.wideopen.test.Bad: it is read-only"},
    {"index beyond dimension", "the index is out of range"},
    {"count beyond dimension", "the index is out of range"},
    {"output in instance changed", "clipGetImage of the Output outside of"},
    {"clipDefine on instance", "OfxActionInstanceChanged: clipDefine outside of"},
    {"message of no type", "\"loud\" is no type of message"},
    {"progress without start", "progressUpdate without progressStart"},
    {"progress without end", "progressStart without progressEnd"},
    {"progress of 7", "progressUpdate to 7, which is not 0 to 1"},
    {"unasked report", "publish of a report that nobody has asked for"},
    {"suite without name", "fetchSuite with the name NULL"},
    {"suite of a stranger", "fetchSuite with a host handle that is not the host's"},
    {"stale arguments", "propGetDouble of \"OfxPropTime\": the property set handle is freed "
                        "already"},
    /* before pixels */
    {"components changed", "the components of \"Source\" cannot be changed in this context"},
    {"depth changed", "the depth of \"Source\" cannot be changed in this host"},
    {"aspect changed", "the pixel aspect of \"Output\" cannot be changed in this host"},
    {"rate changed", "the frame rate cannot be changed in this host"},
    {"fields changed", "the field order cannot be changed in this host"},
    {"no such alpha", "\"OfxSomehow\" is no state of premultiplication"},
    {"clip that is not there", "\"OfxImageClipPropComponents_Nobody\" of the answers: there is no "
                               "such property"},
    {"region of NaN", "OfxImageEffectActionGetRegionOfDefinition: the region is "},
    {"region upside down", "the region is 1e+06, 0 to "},
    {"interest of NaN", "the region of interest of \"Source\" is "},
    {"image in region", "clipGetImage of \"Source\" in an action without images"},
    {"identity with nobody", "identity with \"Nobody\", which is no input clip"},
    /* Render */
    {"another time", "clipGetImage of \"Source\" at another time without temporal access"},
    {"window not written", "pixels of the render window were not written"},
    {"write outside window", "pixels of the output outside of the render window were written"},
    {"write outside buffer", "bytes outside of the output image were written"},
    {"write a row too many", "bytes outside of the output image were written"},
    {"write into padding", "bytes outside of the output image were written"},
    {"write into input", "an image of the input \"Source\" was written to"},
    {"write outside input", "bytes outside of an image of the input \"Source\" were written"},
    {"set param in render", "OfxImageEffectActionRender: paramSetValue of amount in an action that "
                            "must not change parameters"},
    {"set param in a thread of render", "paramSetValue of amount in an action that must not"},
    {"edit in render", "paramEditBegin of the parameter set in an action that must not"},
    {"secret in render", "\"OfxParamPropSecret\" of parameter \"amount\": it may not be written in "
                         "this action"},
    {"write into arguments", "\"OfxPropTime\" of the arguments: it is read-only"},
    {"write into image properties", "\"OfxImagePropRowBytes\" of an image of \"Output\": it is "
                                    "read-only"},
    {"nested threads", "multiThread inside of multiThread"},
    {"output at another time", "clipGetImage of the Output at time 2, which is not the rendered "
                               "one"},
    {"goto time in render", "gotoTime in an action that must not move the time line"},
    {"leak input", "an image of \"Source\" was not released"},
    {"leak output", "an image of \"Output\" was not released"},
    {"double release", "clipReleaseImage: the image handle is freed already"},
    {"image kept for later", "OfxImageEffectActionEndSequenceRender: clipReleaseImage: the image "
                             "handle is freed already"},
    {"stale image", "the property set handle is freed already"},
    {"release of a parameter's set", "clipReleaseImage: the image handle is no image's"},
    {"illegal status", "OfxImageEffectActionRender: it answers kOfxStatReplyDefault (14)"},
    {"nonsense status", "it answers an unknown status (4711)"},
};

/* Misdeeds after which there is no plugin, no instance, or no picture. */
static bool ends_in(const char *name, const char *const *list)
{
    for (; *list; list++)
        if (strcmp(name, *list) == 0)
            return true;
    return false;
}

static const char *const no_plugin[] = {"illegal load status", "illegal describe status",
                                        "no output", NULL};
static const char *const no_instance[] = {"illegal create status", "no depths", NULL};
static const char *const no_picture[] = {"illegal status", "nonsense status", NULL};

/* One life of a plugin: everything is called once, in order; tiles, so that there is an outside. */
static void live(wo_host *host, const char *name)
{
    const wo_host_plugin *plugin = NULL;
    wo_host_instance *instance = NULL;
    const wo_host_project project = {
        .size = {40, 30}, .pixel_aspect = 1, .frame_rate = 24, .first_frame = 1, .last_frame = 10};
    wo_error error = {0};
    const wo_status found = wo_host_find_plugin(host, "Bad", &plugin, &error);
    if ((found != WO_OK) != ends_in(name, no_plugin))
        fail_msg("%s: finding the plugin: %s", name, error.text);
    if (found != WO_OK)
        return;
    const wo_status made =
        wo_host_instance_create(host, plugin, "Filter", &project, &instance, &error);
    if ((made != WO_OK) != ends_in(name, no_instance))
        fail_msg("%s: making an instance: %s", name, error.text);
    if (made != WO_OK)
        return;
    wo_host_still still = {.image = fixture_picture((wo_rect){0, 0, 40, 30}, 4, 1)};
    wo_image image = {0};
    const wo_host_render_args args = {
        .time = 1, .scale_x = 1, .scale_y = 1, .tile_width = 16, .tile_height = 16};
    fixture_connect(instance, "Source", &still);
    const wo_status status = wo_host_render(instance, &args, &image, NULL, &error);
    if ((status != WO_OK) != ends_in(name, no_picture))
        fail_msg("%s: rendering: %s", name, error.text);
    wo_host_image_free(&image);
    ok(wo_host_param_press(instance, "go", &ok_error));
    wo_host_instance_destroy(&instance);
    free(still.image.data);
}

static void each_is_found(void **state)
{
    (void)state;
    for (size_t i = 0; i < WO_COUNT(misdeeds); i++) {
        const misdeed *m = &misdeeds[i];
        assert_int_equal(setenv("WO_TEST_MISDEED", m->name, 1), 0);
        wo_host *host = fixture_host("bad", 2, true, WO_HOST_PADDED_ROWS);
        live(host, m->name);
        wo_host_unload(host);
        fixture_violation(host, m->text);
        wo_host_destroy(&host);
    }
    unsetenv("WO_TEST_MISDEED");
}

/* Frames that are no ranges; what would have been without an answer is taken. */
static void times_are_ranges(void **state)
{
    static const misdeed rows[] = {
        {"time domain upside down", "the time domain is 5 to 1"},
        {"frames of NaN", "the frames needed of \"Source\" are "},
        {"frames not in pairs", "the frames needed of \"Source\" are 3 numbers, not pairs"},
    };
    (void)state;
    for (size_t i = 0; i < WO_COUNT(rows); i++) {
        assert_int_equal(setenv("WO_TEST_MISDEED", rows[i].name, 1), 0);
        wo_host *host = fixture_host("bad", 1, true, 0);
        wo_host_instance *instance = fixture_instance(host, "Bad", "General");
        wo_host_still still = {.image = fixture_picture((wo_rect){0, 0, 40, 30}, 4, 1)};
        double first = 0, last = 0, ranges[2][2];
        fixture_connect(instance, "Source", &still);
        ok(wo_host_get_time_domain(instance, &first, &last, &ok_error));
        assert_true(first == 1 && last == 1);
        ok(wo_host_get_frames_needed(instance, 2, ranges, 2, &ok_error));
        assert_true(ranges[0][0] == 2 && ranges[0][1] == 2);
        fixture_violation(host, rows[i].text);
        assert_int_equal(wo_host_violation_count(host), 1);
        wo_host_destroy(&host);
        free(still.image.data);
    }
    unsetenv("WO_TEST_MISDEED");
}

/* The same life without a misdeed leaves none; nor does a host without strictness see what is not
 * there. */
static void innocence_is_found_as_well(void **state)
{
    (void)state;
    for (int strict = 0; strict < 2; strict++) {
        wo_host *host = fixture_host("bad", 2, strict, 0);
        live(host, "none");
        wo_host_unload(host);
        fixture_no_violations(host);
        wo_host_destroy(&host);
    }
}

/* An instance that has declared itself broken is not called again. */
static void fatal_is_final(void **state)
{
    (void)state;
    wo_host *host = fixture_host("bad", 1, true, 0);
    wo_host_instance *instance = fixture_instance(host, "Bad", NULL);
    wo_error error = {0};
    setenv("WO_TEST_MISDEED", "fatal", 1);
    assert_int_equal(wo_host_param_press(instance, "go", &error), WO_ERR_LIBRARY);
    unsetenv("WO_TEST_MISDEED");
    assert_int_equal(wo_host_param_press(instance, "go", &error), WO_ERR_LIBRARY);
    assert_non_null(strstr(error.text, "broken"));
    wo_host_instance_destroy(&instance);
    wo_host_destroy(&host);
}

/* Many different breaches do not fill the memory. */
static void violations_are_counted_once(void **state)
{
    (void)state;
    wo_host *host = fixture_host("bad", 1, true, 0);
    wo_host_instance *instance = fixture_instance(host, "Bad", NULL);
    setenv("WO_TEST_MISDEED", "NULL handle", 1);
    for (int i = 0; i < 10; i++)
        ok(wo_host_param_press(instance, "go", &ok_error));
    assert_int_equal(wo_host_violation_count(host), 1);
    assert_null(wo_host_violation(host, 1));
    wo_host_violations_clear(host);
    assert_int_equal(wo_host_violation_count(host), 0);
    unsetenv("WO_TEST_MISDEED");
    wo_host_destroy(&host); /* and the instance with it */
}

int main(void)
{
    unsetenv("WO_TEST_MISDEED");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(innocence_is_found_as_well),
        cmocka_unit_test(each_is_found),
        cmocka_unit_test(times_are_ranges),
        cmocka_unit_test(fatal_is_final),
        cmocka_unit_test(violations_are_counted_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
