/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_overlay.h"
#include "probe_effect.h"

#include <string.h>

static wo_ofx_plugin plugin;

static void set_host(OfxHost *host)
{
    plugin.host = host;
}

static OfxStatus main_entry(const char *action, const void *handle, OfxPropertySetHandle in,
                            OfxPropertySetHandle out)
{
    return wo_ofx_main(&plugin, action, handle, in, out);
}

static const wo_effect *effect(void)
{
    return &probe_effect;
}

static wo_ofx_plugin plugin = {
    .ofx = {.pluginApi = kOfxImageEffectPluginApi,
            .apiVersion = kOfxImageEffectPluginApiVersion,
            .pluginIdentifier = "org.wideopen.test.Probe",
            .pluginVersionMajor = 1,
            .pluginVersionMinor = 0,
            .setHost = set_host,
            .mainEntry = main_entry},
    .group = "WideOpen/Test",
    .effect = effect,
};

/* The same with a Depth it will not go without, where the context lets it. */
static wo_ofx_plugin demanding;

static void demanding_set_host(OfxHost *host)
{
    demanding.host = host;
}

static OfxStatus demanding_entry(const char *action, const void *handle, OfxPropertySetHandle in,
                                 OfxPropertySetHandle out)
{
    return wo_ofx_main(&demanding, action, handle, in, out);
}

static const wo_effect *demanding_effect(void)
{
    static wo_clip clips[PROBE_CLIPS];
    static wo_effect effect_with_depth;
    memcpy(clips, probe_effect.clips, sizeof clips);
    clips[PROBE_DEPTH].optional = false;
    effect_with_depth = probe_effect;
    effect_with_depth.name = "Demanding";
    effect_with_depth.clips = clips;
    return &effect_with_depth;
}

static wo_ofx_plugin demanding = {
    .ofx = {.pluginApi = kOfxImageEffectPluginApi,
            .apiVersion = kOfxImageEffectPluginApiVersion,
            .pluginIdentifier = "org.wideopen.test.Demanding",
            .pluginVersionMajor = 1,
            .pluginVersionMinor = 0,
            .setHost = demanding_set_host,
            .mainEntry = demanding_entry},
    .group = "WideOpen/Test",
    .effect = demanding_effect,
};

/* The one with handles. */
static wo_ofx_plugin pointing;

static void pointing_set_host(OfxHost *host)
{
    pointing.host = host;
}

static OfxStatus pointing_entry(const char *action, const void *handle, OfxPropertySetHandle in,
                                OfxPropertySetHandle out)
{
    return wo_ofx_main(&pointing, action, handle, in, out);
}

static OfxStatus pointing_gl(const char *action, const void *handle, OfxPropertySetHandle in,
                             OfxPropertySetHandle out)
{
    (void)out;
    return wo_ofx_overlay(&pointing, action, handle, in, true);
}

static OfxStatus pointing_draw(const char *action, const void *handle, OfxPropertySetHandle in,
                               OfxPropertySetHandle out)
{
    (void)out;
    return wo_ofx_overlay(&pointing, action, handle, in, false);
}

static wo_ofx_plugin pointing = {
    .ofx = {.pluginApi = kOfxImageEffectPluginApi,
            .apiVersion = kOfxImageEffectPluginApiVersion,
            .pluginIdentifier = "org.wideopen.test.Pointing",
            .pluginVersionMajor = 1,
            .pluginVersionMinor = 0,
            .setHost = pointing_set_host,
            .mainEntry = pointing_entry},
    .group = "WideOpen/Test",
    .effect = pointing_effect,
    .overlay_gl = pointing_gl,
    .overlay_draw = pointing_draw,
};

wo_ofx_plugin *const wo_ofx_plugins[] = {&plugin, &demanding, &pointing, NULL};
