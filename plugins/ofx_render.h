/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_PLUGINS_OFX_RENDER_H
#define WO_PLUGINS_OFX_RENDER_H

#include "ofx_plugin.h"

/* Action Render. Any thread, also several windows of one instance at once. */
OfxStatus wo_ofx_render(const wo_ofx_plugin *plugin, OfxImageEffectHandle handle,
                        OfxPropertySetHandle in);

#endif
