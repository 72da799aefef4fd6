/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "mock_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- effects and clips ---- */

static OfxStatus get_properties(OfxImageEffectHandle effect, OfxPropertySetHandle *props)
{
    *props = effect->props;
    return kOfxStatOK;
}

static OfxStatus get_params(OfxImageEffectHandle effect, OfxParamSetHandle *params)
{
    *params = &effect->params;
    return kOfxStatOK;
}

static OfxStatus clip_define(OfxImageEffectHandle effect, const char *name,
                             OfxPropertySetHandle *props)
{
    static const char *const names[MOCK_CLIPS] = {"Source", "Depth", "Mask", "Extra", "Output"};
    if (effect->clip_count == MOCK_CLIPS)
        return kOfxStatErrExists;
    const OfxImageClipHandle clip = &effect->clips[effect->clip_count++];
    snprintf(clip->name, sizeof clip->name, "%s", name);
    for (int i = 0; i < MOCK_CLIPS; i++)
        if (strcmp(names[i], name) == 0)
            clip->picture = &mock.pictures[i];
    clip->props = set_new();
    *props = clip->props;
    return clip->picture ? kOfxStatOK : kOfxStatErrValue;
}

static OfxStatus clip_get_handle(OfxImageEffectHandle effect, const char *name,
                                 OfxImageClipHandle *clip, OfxPropertySetHandle *props)
{
    for (int i = 0; i < effect->clip_count; i++)
        if (strcmp(effect->clips[i].name, name) == 0) {
            *clip = &effect->clips[i];
            put_int((*clip)->props, kOfxImageClipPropConnected, 0, (*clip)->picture->connected);
            if ((*clip)->picture->components)
                put_text((*clip)->props, kOfxImageEffectPropComponents, 0,
                         (*clip)->picture->components);
            if ((*clip)->picture->alpha)
                put_text((*clip)->props, kOfxImageEffectPropPreMultiplication, 0,
                         (*clip)->picture->alpha);
            for (int k = 0; k < 3 && (*clip)->picture->names[k]; k++)
                put_text((*clip)->props, kWideOpenClipPropMetadataNames, k,
                         (*clip)->picture->names[k]);
            for (int k = 0; k < 3 && (*clip)->picture->values[k]; k++)
                put_text((*clip)->props, kWideOpenClipPropMetadataValues, k,
                         (*clip)->picture->values[k]);
            if (props)
                *props = (*clip)->props;
            return kOfxStatOK;
        }
    return kOfxStatErrUnknown;
}

static void put_rect(OfxPropertySetHandle set, const char *name, wo_rect r)
{
    put_int(set, name, 0, r.x1);
    put_int(set, name, 1, r.y1);
    put_int(set, name, 2, r.x2);
    put_int(set, name, 3, r.y2);
}

static OfxStatus clip_get_image(OfxImageClipHandle clip, OfxTime time, const OfxRectD *region,
                                OfxPropertySetHandle *image)
{
    const mock_picture *const p = clip->picture;
    (void)time;
    *image = (OfxPropertySetHandle)(void *)&mock; /* a failure promises nothing about it */
    if (p->starved)
        return kOfxStatErrMemory;
    if (p->silent)
        return kOfxStatFailed;
    const OfxPropertySetHandle set = set_new();
    const bool part = !region && !wo_rect_empty(p->first);
    const wo_rect bounds = part ? p->first : p->bounds;
    char *data = p->data;
    if (part && data) {
        const int bytes = strcmp(p->components, kOfxImageComponentRGBA) == 0 ? 16 : 4;
        data += (ptrdiff_t)(bounds.y1 - p->bounds.y1) * p->row_bytes +
                (ptrdiff_t)(bounds.x1 - p->bounds.x1) * bytes;
    }
    put_pointer(set, kOfxImagePropData, 0, data);
    put_rect(set, kOfxImagePropBounds, bounds);
    put_int(set, kOfxImagePropRowBytes, 0, p->row_bytes);
    if (!wo_rect_empty(p->defined))
        put_rect(set, kOfxImagePropRegionOfDefinition, p->defined);
    put_text(set, kOfxImageEffectPropPixelDepth, 0, p->depth ? p->depth : kOfxBitDepthNone);
    put_text(set, kOfxImageEffectPropComponents, 0,
             p->components ? p->components : kOfxImageComponentNone);
    if (p->alpha)
        put_text(set, kOfxImageEffectPropPreMultiplication, 0, p->alpha);
    mock.live_images++;
    *image = set;
    return kOfxStatOK;
}

static OfxStatus clip_release_image(OfxPropertySetHandle image)
{
    mock.live_images--;
    set_free(image);
    return kOfxStatOK;
}

static OfxStatus clip_get_region(OfxImageClipHandle clip, OfxTime time, OfxRectD *region)
{
    const mock_picture *const p = clip->picture;
    (void)time;
    *region = p->region;
    if (p->region.x2 <= p->region.x1)
        *region = (OfxRectD){p->bounds.x1, p->bounds.y1, p->bounds.x2, p->bounds.y2};
    return p->connected ? kOfxStatOK : kOfxStatFailed;
}

const void *mock_effect_suite(bool hollow)
{
    static const OfxImageEffectSuiteV1 full = {
        .getPropertySet = get_properties,
        .getParamSet = get_params,
        .clipDefine = clip_define,
        .clipGetHandle = clip_get_handle,
        .clipGetImage = clip_get_image,
        .clipReleaseImage = clip_release_image,
        .clipGetRegionOfDefinition = clip_get_region,
        .abort = mock_abort,
        .imageMemoryAlloc = mock_image_alloc,
        .imageMemoryFree = mock_image_free,
        .imageMemoryLock = mock_image_lock,
        .imageMemoryUnlock = mock_image_unlock,
    };
    static const OfxImageEffectSuiteV1 empty = {
        .getPropertySet = get_properties,
        .getParamSet = get_params,
        .clipDefine = clip_define,
        .clipGetHandle = clip_get_handle,
        .clipGetImage = clip_get_image,
        .clipReleaseImage = clip_release_image,
        .clipGetRegionOfDefinition = clip_get_region,
    };
    return hollow ? &empty : &full;
}

/* ---- actions ---- */

static const void *fetch_suite(OfxPropertySetHandle host, const char *name, int version)
{
    return host ? mock_suite(name, version) : NULL;
}

OfxHost *mock_host(void)
{
    static struct OfxPropertySetStruct properties;
    static OfxHost hosts[2];
    static int calls;
    OfxHost *const host = &hosts[calls++ % 2];
    *host = (OfxHost){&properties, fetch_suite};
    put_int(&properties, kOfxImageEffectPropSupportsOverlays, 0, (mock.flags & MOCK_OVERLAYS) != 0);
    return host;
}

static void effect_free(OfxImageEffectHandle effect)
{
    for (int i = 0; i < effect->params.count; i++) {
        set_free(effect->params.items[i].props);
        free(effect->params.items[i].text);
    }
    for (int i = 0; i < effect->clip_count; i++)
        set_free(effect->clips[i].props);
    set_free(effect->props);
    free(effect);
}

/* One object is descriptor and instance, which no plugin can tell apart. */
OfxImageEffectHandle mock_create(OfxPlugin *plugin, const char *context, OfxStatus *status)
{
    const OfxImageEffectHandle effect = calloc(1, sizeof *effect);
    const OfxPropertySetHandle in = set_new();
    effect->props = set_new();
    put_text(in, kOfxImageEffectPropContext, 0, context);
    *status = plugin->mainEntry(kOfxActionDescribe, effect, NULL, NULL);
    if (*status == kOfxStatOK)
        *status = plugin->mainEntry(kOfxImageEffectActionDescribeInContext, effect, in, NULL);
    set_free(in);
    if (*status == kOfxStatOK) {
        take_defaults(effect);
        put_text(effect->props, kOfxImageEffectPropContext, 0, context);
        put_double(effect->props, kOfxImageEffectPropProjectSize, 0, 100);
        put_double(effect->props, kOfxImageEffectPropProjectSize, 1, 50);
        *status = plugin->mainEntry(kOfxActionCreateInstance, effect, NULL, NULL);
    }
    if (*status == kOfxStatOK)
        return effect;
    effect_free(effect);
    return NULL;
}

void mock_destroy(OfxPlugin *plugin, OfxImageEffectHandle effect)
{
    plugin->mainEntry(kOfxActionDestroyInstance, effect, NULL, NULL);
    effect_free(effect);
    mock_settle();
}

void mock_set_property(OfxImageEffectHandle effect, const char *name, int count,
                       const double *values)
{
    prop *const p = prop_find(effect->props, name);
    if (p) {
        prop_clear(p);
        *p = effect->props->items[--effect->props->count];
    }
    for (int i = 0; i < count; i++)
        put_double(effect->props, name, i, values[i]);
}

OfxStatus mock_render(OfxPlugin *plugin, OfxImageEffectHandle effect, wo_rect window,
                      const double scale[2], const char *field)
{
    const OfxPropertySetHandle in = set_new();
    put_double(in, kOfxPropTime, 0, 1);
    put_rect(in, kOfxImageEffectPropRenderWindow, window);
    for (int i = 0; scale && i < 2; i++)
        put_double(in, kOfxImageEffectPropRenderScale, i, scale[i]);
    if (field)
        put_text(in, kOfxImageEffectPropFieldToRender, 0, field);
    const OfxStatus status = plugin->mainEntry(kOfxImageEffectActionRender, effect, in, NULL);
    set_free(in);
    mock_settle();
    return status;
}

OfxStatus mock_identity(OfxPlugin *plugin, OfxImageEffectHandle effect, char clip[64])
{
    const OfxPropertySetHandle in = set_new(), out = set_new();
    char *name = NULL;
    put_double(in, kOfxPropTime, 0, 1);
    put_rect(in, kOfxImageEffectPropRenderWindow, (wo_rect){0, 0, 4, 4});
    const OfxStatus status = plugin->mainEntry(kOfxImageEffectActionIsIdentity, effect, in, out);
    get_text(out, kOfxPropName, 0, &name);
    snprintf(clip, 64, "%s", name ? name : "");
    set_free(in);
    set_free(out);
    mock_settle();
    return status;
}

static void read_rect(OfxPropertySetHandle set, const char *name, OfxRectD *r)
{
    *r = (OfxRectD){0, 0, 0, 0};
    get_double(set, name, 0, &r->x1);
    get_double(set, name, 1, &r->y1);
    get_double(set, name, 2, &r->x2);
    get_double(set, name, 3, &r->y2);
}

OfxStatus mock_region(OfxPlugin *plugin, OfxImageEffectHandle effect, OfxRectD *region)
{
    const OfxPropertySetHandle in = set_new(), out = set_new();
    put_double(in, kOfxPropTime, 0, 1);
    const OfxStatus status =
        plugin->mainEntry(kOfxImageEffectActionGetRegionOfDefinition, effect, in, out);
    read_rect(out, kOfxImageEffectPropRegionOfDefinition, region);
    set_free(in);
    set_free(out);
    mock_settle();
    return status;
}

OfxStatus mock_needed(OfxPlugin *plugin, OfxImageEffectHandle effect, OfxRectD region,
                      const char *clip, OfxRectD *needed)
{
    const OfxPropertySetHandle in = set_new(), out = set_new();
    const double sides[4] = {region.x1, region.y1, region.x2, region.y2};
    char name[64];
    snprintf(name, sizeof name, "OfxImageClipPropRoI_%s", clip);
    put_double(in, kOfxPropTime, 0, 1);
    for (int i = 0; i < 4; i++)
        put_double(in, kOfxImageEffectPropRegionOfInterest, i, sides[i]);
    const OfxStatus status =
        plugin->mainEntry(kOfxImageEffectActionGetRegionsOfInterest, effect, in, out);
    read_rect(out, name, needed);
    set_free(in);
    set_free(out);
    mock_settle();
    return status;
}
