/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "host_fixture.h"

#include <float.h>
#include <limits.h>
#include <string.h>

static void plugin_is_described(void **state)
{
    (void)state;
    wo_host *host = fixture_host("good", 1, true, 0);
    const wo_host_plugin *p = NULL;
    assert_int_equal(wo_host_plugin_count(host), 1);
    ok(wo_host_find_plugin(host, "org.wideopen.test.Good", &p, &ok_error));
    assert_ptr_equal(p, wo_host_plugin_at(host, 0));
    assert_null(wo_host_plugin_at(host, 1));
    assert_string_equal(p->identifier, "org.wideopen.test.Good");
    assert_int_equal(p->version_major, 1);
    assert_int_equal(p->version_minor, 3);
    assert_string_equal(p->label, "Good");
    assert_string_equal(p->group, "Tests/Good");
    assert_string_equal(p->description, "Blurs, brightens and inverts.");
    assert_non_null(strstr(p->bundle, "Good.ofx.bundle"));
    assert_non_null(strstr(p->binary, "/Contents/" WO_TEST_ARCH "/Good.ofx"));
    assert_int_equal(p->context_name_count, 3);
    assert_int_equal(p->context_count, 3);
    assert_int_equal(p->safety, WO_HOST_FULLY_SAFE);
    assert_true(p->tiles && p->multi_resolution && p->temporal && p->float_pixels);
    assert_string_equal(p->colour_style, "OfxImageEffectColourManagementCore");
    assert_ptr_equal(wo_host_find_context(p, "Filter"),
                     wo_host_find_context(p, "OfxImageEffectContextFilter"));
    assert_null(wo_host_find_context(p, "Retimer"));
    fixture_no_violations(host);
    wo_host_destroy(&host);
}

static void clips_are_described(void **state)
{
    (void)state;
    wo_host *host = fixture_host("good", 1, true, 0);
    const wo_host_context_info *c = wo_host_find_context(wo_host_plugin_at(host, 0), "Filter");
    const wo_host_context_info *g = wo_host_find_context(wo_host_plugin_at(host, 0), "Generator");
    assert_int_equal(c->clip_count, 3);
    const wo_host_clip_info *source = wo_host_find_clip(c, "Source");
    const wo_host_clip_info *mask = wo_host_find_clip(c, "Mask");
    const wo_host_clip_info *output = wo_host_find_clip(c, "Output");
    assert_int_equal(source->components, WO_HOST_RGBA | WO_HOST_ALPHA);
    assert_true(source->temporal && source->tiles);
    assert_false(source->optional || source->mask || source->output);
    assert_int_equal(mask->components, WO_HOST_ALPHA);
    assert_true(mask->optional && mask->mask && !mask->temporal);
    assert_true(output->output);
    assert_true(wo_host_find_clip(g, "Source")->optional);
    assert_null(wo_host_find_clip(c, "Depth"));
    wo_host_destroy(&host);
}

static void parameters_are_described(void **state)
{
    (void)state;
    wo_host *host = fixture_host("good", 1, true, 0);
    const wo_host_context_info *c = wo_host_find_context(wo_host_plugin_at(host, 0), "General");
    assert_int_equal(c->param_count, 19);
    assert_string_equal(c->params[0].name, "main"); /* in the order of definition */
    assert_int_equal(c->params[0].kind, WO_HOST_PARAM_GROUP);
    assert_false(c->params[0].open);
    const wo_host_param_info *gain = wo_host_find_param(c, "gain");
    assert_int_equal(gain->kind, WO_HOST_PARAM_DOUBLE);
    assert_string_equal(gain->type, "OfxParamTypeDouble");
    assert_string_equal(gain->label, "gain"); /* the name when there is no label */
    assert_string_equal(gain->hint, "A number.");
    assert_string_equal(gain->parent, "main");
    assert_string_equal(gain->double_type, "OfxParamDoubleTypePlain");
    assert_int_equal(gain->dimension, 1);
    assert_true(gain->initial[0] == 1 && gain->min[0] == 0 && gain->max[0] == 10);
    assert_true(gain->ui_min[0] == 0 && gain->ui_max[0] == 5); /* unset: the hard one */
    assert_true(gain->animates && gain->evaluates && gain->persistent && gain->enabled);
    assert_false(gain->secret);
    const wo_host_param_info *shape = wo_host_find_param(c, "shape");
    assert_int_equal(shape->choice_count, 3);
    assert_string_equal(shape->choices[1], "Long Box");
    assert_null(shape->choice_keys);
    assert_true(shape->initial[0] == 2 && shape->max[0] == 2 && shape->animates);
    const wo_host_param_info *pick = wo_host_find_param(c, "pick");
    assert_string_equal(pick->choice_keys[1], "two");
    assert_string_equal(pick->choices[1], "The Two");
    assert_string_equal(pick->initial_text, "two");
    assert_false(pick->animates);
    const wo_host_param_info *centre = wo_host_find_param(c, "centre");
    assert_true(centre->normalised && centre->initial[1] == 0.25 && centre->dimension == 2);
    assert_true(centre->min[0] == -DBL_MAX && centre->ui_max[1] == DBL_MAX);
    const wo_host_param_info *tint = wo_host_find_param(c, "tint");
    assert_true(tint->dimension == 3 && tint->ui_min[2] == 0 && tint->ui_max[2] == 1);
    assert_true(wo_host_find_param(c, "voxels")->min[2] == INT_MIN);
    assert_ptr_equal(wo_host_find_param(c, "remark"), wo_host_find_param(c, "note"));
    assert_string_equal(wo_host_find_param(c, "note")->initial_text, "a text, with commas");
    assert_string_equal(wo_host_find_param(c, "note")->string_mode, "OfxParamStringIsSingleLine");
    assert_int_equal(wo_host_find_param(c, "reset")->kind, WO_HOST_PARAM_PUSH_BUTTON);
    assert_null(wo_host_find_param(c, "nobody"));
    for (size_t i = 0; i < c->param_count; i++)
        assert_string_not_equal(wo_host_param_type_text(c->params[i].kind), "unknown");
    wo_host_destroy(&host);
}

static void instances_are_checked(void **state)
{
    (void)state;
    wo_host *host = fixture_host("good", 1, true, 0);
    const wo_host_plugin *plugin = wo_host_plugin_at(host, 0);
    wo_host_instance *instance = NULL;
    wo_error error = {0};
    wo_host_project project = WO_HOST_PROJECT_INIT;
    assert_int_equal(wo_host_instance_create(host, plugin, "Retimer", &project, &instance, &error),
                     WO_ERR_NOT_FOUND);
    project.size[0] = 0;
    assert_int_equal(wo_host_instance_create(host, plugin, NULL, &project, &instance, &error),
                     WO_ERR_RANGE);
    project.size[0] = 100;
    project.frame_rate = 0;
    assert_int_equal(wo_host_instance_create(host, plugin, NULL, &project, &instance, &error),
                     WO_ERR_RANGE);
    assert_null(instance);
    project.frame_rate = 24;
    ok(wo_host_instance_create(host, plugin, NULL, &project, &instance, &ok_error));
    assert_string_equal(wo_host_instance_context(instance)->short_name, "General");
    assert_ptr_equal(wo_host_instance_plugin(instance), plugin);
    ok(wo_host_purge(instance, &ok_error));
    ok(wo_host_sync(instance, &ok_error));
    wo_host_source source = WO_HOST_SOURCE_INIT;
    assert_int_equal(wo_host_set_clip(instance, "Nobody", &source, &error), WO_ERR_NOT_FOUND);
    assert_int_equal(wo_host_set_clip(instance, "Output", &source, &error), WO_ERR_NOT_FOUND);
    assert_int_equal(wo_host_set_clip(instance, "Source", &source, &error), WO_ERR_ARGUMENT);
    source.region = wo_host_still_region;
    source.pixels = wo_host_still_pixels;
    source.components = 2;
    assert_int_equal(wo_host_set_clip(instance, "Source", &source, &error), WO_ERR_ARGUMENT);
    ok(wo_host_set_clip(instance, "Source", NULL, &ok_error));
    wo_host_abort(instance); /* nothing to stop */
    wo_host_instance_destroy(&instance);
    wo_host_instance_destroy(&instance);
    fixture_no_violations(host);
    wo_host_destroy(&host);
    wo_host_destroy(&host);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plugin_is_described),
        cmocka_unit_test(clips_are_described),
        cmocka_unit_test(parameters_are_described),
        cmocka_unit_test(instances_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
