/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_camera.h"

#include "wideopen/ofx_camera.h"

/* More attributes of one picture than any file has. */
enum { ATTRIBUTES_MAX = 10000 };

static int count_of(const wo_ofx_suites *s, OfxPropertySetHandle set)
{
    int names = 0, values = 0;
    if (!set || !s->property->propGetDimension ||
        s->property->propGetDimension(set, kWideOpenClipPropMetadataNames, &names) != kOfxStatOK ||
        s->property->propGetDimension(set, kWideOpenClipPropMetadataValues, &values) != kOfxStatOK)
        return 0;
    const int both = names < values ? names : values;
    return both < ATTRIBUTES_MAX ? both : ATTRIBUTES_MAX;
}

static void read_clip(const wo_ofx_suites *s, OfxPropertySetHandle set, wo_camera *camera)
{
    const int count = count_of(s, set);
    for (int i = 0; i < count; i++) {
        char *name = NULL, *value = NULL;
        if (s->property->propGetString(set, kWideOpenClipPropMetadataNames, i, &name) ==
                kOfxStatOK &&
            s->property->propGetString(set, kWideOpenClipPropMetadataValues, i, &value) ==
                kOfxStatOK &&
            name && value)
            wo_camera_read(camera, name, value);
    }
}

void wo_ofx_read_camera(wo_ofx_action *action)
{
    for (size_t i = 0; i < action->effect->clip_count; i++)
        if (action->geometry.connected[i] && (i == 0 || action->effect->clips[i].data))
            read_clip(action->suites, action->clips[i].properties, &action->geometry.camera);
}
