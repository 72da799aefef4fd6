/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_PLUGINS_OFX_INSTANCE_H
#define WO_PLUGINS_OFX_INSTANCE_H

#include <stdatomic.h>

#include "ofx_memory.h"
#include "ofx_params.h"
#include "ofx_plugin.h"

/* All that lives between two actions of one instance: flags, so that a message is shown once and
   one render at a time owns the progress bar. Everything else is asked from the host anew. */
typedef struct wo_ofx_instance {
    atomic_bool complaining;
    atomic_uint_least64_t warning;   /* hash of the text beside the node, 0 = there is none */
    atomic_uint_least64_t kinds;     /* that it tells of, a bit for each, by the hash of its key */
    atomic_uint_least64_t place;     /* hash of the window that it is from */
    atomic_uint_least64_t popped_up; /* kinds that were told so */
    atomic_bool progressing;
} wo_ofx_instance;

/* Actions CreateInstance and DestroyInstance. */
OfxStatus wo_ofx_instance_create(const wo_ofx_plugin *plugin, OfxImageEffectHandle handle);
OfxStatus wo_ofx_instance_destroy(const wo_ofx_plugin *plugin, OfxImageEffectHandle handle);

/* One action on one instance, with everything about the instance that the actions want to know.
   Lives on the stack of the action. */
typedef struct wo_ofx_action {
    const wo_ofx_suites *suites;
    const wo_effect *effect;
    OfxImageEffectHandle handle;
    OfxPropertySetHandle properties; /* of the instance */
    OfxPropertySetHandle in, out;
    wo_ofx_instance *instance; /* NULL where the host keeps none */
    wo_ofx_memory memory;
    wo_context context; /* with the host's memory and nothing else */
    wo_error error;

    struct {
        OfxImageClipHandle handle; /* NULL = this context or host does not have it */
        OfxPropertySetHandle properties;
    } clips[WO_CLIPS_MAX]; /* in the order of wo_effect.clips */

    double time;
    double scale[2];
    double aspect;       /* of a pixel: width over height */
    double to_pixels[2]; /* from the host's regions: scale, and aspect in x */
    OfxRectD frame;      /* the project's, canonical and finite */
    OfxRectD region;     /* of definition of Source, likewise */
    bool endless;        /* it was cut to the frame */
    void *params;
    wo_ofx_lost lost; /* defaults among params that the host has not given */
    wo_geometry geometry;
} wo_ofx_action;

/* Opens the clips and fills all but time, params and geometry; does not fail. */
void wo_ofx_action_begin(wo_ofx_action *action, const wo_ofx_plugin *plugin,
                         OfxImageEffectHandle handle, OfxPropertySetHandle in,
                         OfxPropertySetHandle out);

/* Fills time, scale, params and geometry from the action's arguments. */
WO_NODISCARD wo_status wo_ofx_action_read(wo_ofx_action *action);

/* Gives back what reading took; shows the error of a failure to the user, or takes the last one
   away after a success. done says that the action has done what the user wants to see. */
OfxStatus wo_ofx_action_end(wo_ofx_action *action, wo_status status, bool done);

/* Shows the warnings of the render of a window to the user, after wo_ofx_action_end: beside the
   node, where they stay until that window, or the whole picture, is rendered without any, and are
   not told again for every tile; in hosts that cannot do that in a window, once for each kind. */
void wo_ofx_warn(const wo_ofx_action *action, const wo_report *report, wo_rect window);

/* Whether the host says that something is attached to a clip. */
bool wo_ofx_clip_connected(const wo_ofx_action *action, size_t clip);

#endif
