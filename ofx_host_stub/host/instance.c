/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Highest style both sides know; the host knows up to Core and one config. */
static const char *common_style(const wo_props *plugin)
{
    static const char *const styles[] = {
        kOfxImageEffectColourManagementNone, kOfxImageEffectColourManagementBasic,
        kOfxImageEffectColourManagementCore, kOfxImageEffectColourManagementFull,
        kOfxImageEffectColourManagementOCIO};
    const char *theirs = wo_props_text(plugin, kOfxImageEffectPropColourManagementStyle, 0, "");
    size_t level = 0;
    for (size_t i = 0; i < WO_COUNT(styles); i++)
        if (strcmp(styles[i], theirs) == 0)
            level = i;
    if (!wo_props_has_text(plugin, kOfxImageEffectPropColourManagementAvailableConfigs,
                           WO_NATIVE_CONFIG))
        level = 0;
    return styles[level > 2 ? 2 : level];
}

static void describe_project(wo_host_instance *instance)
{
    const wo_host_project *p = &instance->project;
    const wo_entry *entry = instance->object.entry;
    const wo_props *plugin = &entry->descriptor->props;
    wo_props *props = &instance->object.props;
    const char *style = common_style(plugin);
    for (int i = 0; i < 2; i++) {
        wo_props_set_double(props, kOfxImageEffectPropProjectSize, i, p->size[i]);
        wo_props_set_double(props, kOfxImageEffectPropProjectOffset, i, p->offset[i]);
        wo_props_set_double(props, kOfxImageEffectPropProjectExtent, i, p->extent[i]);
    }
    wo_props_set_double(props, kOfxImageEffectPropProjectPixelAspectRatio, 0, p->pixel_aspect);
    wo_props_set_double(props, kOfxImageEffectInstancePropEffectDuration, 0,
                        p->last_frame - p->first_frame + 1);
    wo_props_set_double(props, kOfxImageEffectPropFrameRate, 0, p->frame_rate);
    wo_props_set_int(props, kOfxPropIsInteractive, 0, p->interactive);
    wo_props_set_int(props, kOfxImageEffectPropSupportsTiles, 0, entry->info.tiles);
    wo_props_set_pointer(props, kOfxImageEffectPropPluginHandle, 0, entry->plugin);
    wo_props_set_text(props, kOfxImageEffectPropColourManagementStyle, 0, style);
    if (strcmp(style, kOfxImageEffectColourManagementNone) != 0) {
        wo_props_set_text(props, kOfxImageEffectPropColourManagementConfig, 0, WO_NATIVE_CONFIG);
        wo_props_set_text(props, kOfxImageEffectPropDisplayColourspace, 0, "srgb_display");
    }
}

static wo_status check_project(wo_host_project *p, wo_error *error)
{
    for (int i = 0; i < 2; i++)
        if (!(p->size[i] > 0 && p->size[i] < WO_INFINITE && fabs(p->offset[i]) < WO_INFINITE))
            return wo_fail(error, WO_ERR_RANGE, "the project is %g x %g at %g, %g", p->size[0],
                           p->size[1], p->offset[0], p->offset[1]);
    for (int i = 0; i < 2; i++)
        if (!(p->extent[0] > 0 && p->extent[1] > 0))
            p->extent[i] = p->offset[i] + p->size[i];
    if (!(p->pixel_aspect > 0 && isfinite(p->pixel_aspect) && p->frame_rate > 0 &&
          isfinite(p->frame_rate) && p->last_frame >= p->first_frame))
        return wo_fail(error, WO_ERR_RANGE,
                       "the project has pixel aspect %g, frame rate %g, frames %g to %g",
                       p->pixel_aspect, p->frame_rate, p->first_frame, p->last_frame);
    return WO_OK;
}

static const wo_host_context_info *default_context(const wo_host_plugin *plugin)
{
    static const char *const order[] = {"General", "Filter", "Generator"};
    for (size_t i = 0; i < WO_COUNT(order); i++) {
        const wo_host_context_info *context = wo_host_find_context(plugin, order[i]);
        if (context)
            return context;
    }
    return NULL;
}

/* Puts an instance into the host's list; false when the plugin wants no other one beside it. */
static bool link_instance(wo_host *host, wo_host_instance *instance, wo_entry *entry)
{
    const bool single =
        wo_props_int(&entry->descriptor->props, kOfxImageEffectPluginPropSingleInstance, 0, 0);
    pthread_mutex_lock(&host->lock);
    const bool ok = !single || entry->instance_count == 0;
    if (ok) {
        instance->next = host->instances;
        host->instances = instance;
        entry->instance_count++;
    }
    pthread_mutex_unlock(&host->lock);
    return ok;
}

wo_status wo_host_instance_create(wo_host *host, const wo_host_plugin *plugin, const char *context,
                                  const wo_host_project *project, wo_host_instance **out,
                                  wo_error *error)
{
    *out = NULL;
    wo_entry *entry = plugin->internal;
    const wo_host_context_info *info =
        context ? wo_host_find_context(plugin, context) : default_context(plugin);
    if (!info)
        return wo_fail(error, WO_ERR_NOT_FOUND, "%.80s has no context \"%.60s\"",
                       plugin->identifier, context ? context : "");
    if (!entry->loaded)
        return wo_fail(error, WO_ERR_ARGUMENT, "%.80s is unloaded", plugin->identifier);
    if (!plugin->float_pixels)
        return wo_fail(error, WO_ERR_UNSUPPORTED, "%.80s does not take 32-bit float pixels",
                       plugin->identifier);
    wo_host_project checked = *project;
    WO_TRY(check_project(&checked, error));

    wo_host_instance *instance = calloc(1, sizeof *instance);
    if (!instance)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for an instance");
    instance->context = info;
    instance->project = checked;
    instance->time = checked.first_frame;
    instance->preferences_stale = instance->colourspace_stale = true;
    if (!link_instance(host, instance, entry)) {
        free(instance);
        return wo_fail(error, WO_ERR_UNSUPPORTED, "%.80s wants one instance at a time",
                       plugin->identifier);
    }
    pthread_mutex_init(&instance->lock, NULL);
    pthread_mutex_init(&instance->publish_lock, NULL);

    const wo_object *described = entry->contexts[info - plugin->contexts];
    instance->clip_preferences = calloc(info->clip_count, sizeof *instance->clip_preferences);
    bool ok = wo_object_init(&instance->object, host, entry, info->name, true);
    ok = ok && wo_object_copy(&instance->object, described, &checked) && instance->clip_preferences;
    if (ok) {
        describe_project(instance);
        ok = wo_clips_describe(instance);
    }
    if (!ok || instance->object.props.failed) {
        wo_host_instance_destroy(&instance);
        return wo_fail(error, WO_ERR_NOMEM, "no memory for an instance of %.80s",
                       plugin->identifier);
    }
    wo_frame frame = {.action = WO_ACTION_CREATE, .time = instance->time, .scale = {1, 1}};
    const wo_status status = wo_act_on(instance, &frame, NULL, NULL, NULL, error);
    if (status != WO_OK) {
        wo_host_instance_destroy(&instance);
        return status;
    }
    instance->alive = true;
    instance->notify = true;
    *out = instance;
    return WO_OK;
}

static void unlink_instance(wo_host *host, const wo_host_instance *instance, wo_entry *entry)
{
    pthread_mutex_lock(&host->lock);
    wo_host_instance **link = &host->instances;
    while (*link && *link != instance)
        link = &(*link)->next;
    if (*link)
        *link = instance->next;
    entry->instance_count--;
    pthread_mutex_unlock(&host->lock);
}

void wo_host_instance_destroy(wo_host_instance **place)
{
    wo_host_instance *instance = *place;
    if (!instance)
        return;
    wo_object *object = &instance->object;
    wo_host *host = object->host;
    wo_entry *entry = object->entry;
    wo_frame frame = {
        .action = WO_ACTION_DESTROY, .object = object, .time = instance->time, .scale = {1, 1}};
    if (instance->alive)
        (void)wo_act(entry, &frame, NULL, NULL);
    frame.outer = wo_frame_now();
    frame.host = host;
    frame.entry = entry;
    wo_frame_set(&frame);
    wo_memory_check_left(NULL, object);
    wo_frame_set(frame.outer);
    unlink_instance(host, instance, entry);
    wo_object_clear(object);
    free(instance->clip_preferences);
    free(instance->persistent);
    free(instance->progress);
    pthread_mutex_destroy(&instance->lock);
    pthread_mutex_destroy(&instance->publish_lock);
    free(instance);
    *place = NULL;
}

const wo_host_plugin *wo_host_instance_plugin(const wo_host_instance *instance)
{
    return &instance->object.entry->info;
}

const wo_host_context_info *wo_host_instance_context(const wo_host_instance *instance)
{
    return instance->context;
}

static wo_status plain_action(wo_host_instance *instance, wo_action action, wo_error *error)
{
    wo_frame frame = {.action = action, .time = instance->time, .scale = {1, 1}};
    return wo_act_on(instance, &frame, NULL, NULL, NULL, error);
}

wo_status wo_host_purge(wo_host_instance *instance, wo_error *error)
{
    return plain_action(instance, WO_ACTION_PURGE, error);
}

wo_status wo_host_sync(wo_host_instance *instance, wo_error *error)
{
    return plain_action(instance, WO_ACTION_SYNC, error);
}
