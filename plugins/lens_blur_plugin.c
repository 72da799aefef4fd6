/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_plugin.h"

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
};

wo_ofx_plugin *const wo_ofx_plugins[] = {&plugin, NULL};
