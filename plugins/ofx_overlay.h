/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_PLUGINS_OFX_OVERLAY_H
#define WO_PLUGINS_OFX_OVERLAY_H

#include "ofx_plugin.h"

/* Handles over the viewer of a host: a circle with a cross for each point parameter that the effect
   marks wo_param.overlay and that wo_effect.handles says is in use. They are dragged with the pen;
   one drag is one edit of the parameter, to be undone at once. All of it is optional: every handle
   is a parameter with numbers, too. */

/* In the Describe action of the effect: offers the overlay if there are handles, and the host says
   that it supports overlays and has the interact suite; the one for the draw suite if it has that.
   Does not fail. */
void wo_ofx_overlay_describe(const wo_ofx_plugin *plugin, OfxPropertySetHandle effect);

/* Every action of an overlay's entry point; handle is the OfxInteractHandle. may_gl says that this
   is the entry point of OpenGL overlays, whose host makes a context current before it wants
   something drawn. Host thread only, as OpenFX says. */
OfxStatus wo_ofx_overlay(const wo_ofx_plugin *plugin, const char *action, const void *handle,
                         OfxPropertySetHandle in, bool may_gl);

#endif
