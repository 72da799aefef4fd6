/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_PLUGINS_OFX_PLUGIN_H
#define WO_PLUGINS_OFX_PLUGIN_H

#include "ofx_suites.h"
#include "wideopen/effect.h"

/* One effect as an OpenFX plugin. Constant but for host and suites, which setHost and the Load
   action fill; nothing in here is ever allocated, so that it survives any order of Load and
   Unload. Each plugin has its own, with two functions of its own that pass it on:

       static wo_ofx_plugin plugin;
       static void set_host(OfxHost *host) { plugin.host = host; }
       static OfxStatus main_entry(...)    { return wo_ofx_main(&plugin, ...); }
*/
typedef struct wo_ofx_plugin {
    OfxPlugin ofx;                    /* what the host sees */
    const char *group;                /* menu: "WideOpen" */
    const wo_effect *(*effect)(void); /* constant; NULL makes Load fail */

    /* Overlay over the viewer, drawn with OpenGL and with the draw suite; both NULL, or two more
       functions of the plugin's own that pass on to wo_ofx_overlay. */
    OfxPluginEntryPoint *overlay_gl, *overlay_draw;
    const OfxHost *host;
    wo_ofx_suites suites;
} wo_ofx_plugin;

/* The plugins of this bundle, ending with NULL; each bundle defines it once. */
extern wo_ofx_plugin *const wo_ofx_plugins[];

/* Every action of OfxPlugin.mainEntry. Any thread, as OpenFX says for each action. */
OfxStatus wo_ofx_main(wo_ofx_plugin *plugin, const char *action, const void *handle,
                      OfxPropertySetHandle in, OfxPropertySetHandle out);

#endif
