/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_overlay.h"

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

static OfxStatus overlay_gl(const char *action, const void *handle, OfxPropertySetHandle in,
                            OfxPropertySetHandle out)
{
    (void)out;
    return wo_ofx_overlay(&plugin, action, handle, in, true);
}

static OfxStatus overlay_draw(const char *action, const void *handle, OfxPropertySetHandle in,
                              OfxPropertySetHandle out)
{
    (void)out;
    return wo_ofx_overlay(&plugin, action, handle, in, false);
}

static const wo_effect *effect(void)
{
    return wo_effect_find("LensBlur");
}

static wo_ofx_plugin plugin = {
    .ofx = {.pluginApi = kOfxImageEffectPluginApi,
            .apiVersion = kOfxImageEffectPluginApiVersion,
            .pluginIdentifier = "org.wideopen.LensBlur",
            .pluginVersionMajor = WO_VERSION_MAJOR,
            .pluginVersionMinor = WO_VERSION_MINOR,
            .setHost = set_host,
            .mainEntry = main_entry},
    .group = "WideOpen",
    .effect = effect,
    .overlay_gl = overlay_gl,
    .overlay_draw = overlay_draw,
};

wo_ofx_plugin *const wo_ofx_plugins[] = {&plugin, NULL};
