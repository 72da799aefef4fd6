/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* A plugin that does everything right: box blur, gain, inversion and mask, with parameters of all
   kinds. A host that finds fault with it is at fault. */

#include "host_plugin.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef struct state { /* kOfxPropInstanceData */
    OfxImageClipHandle source, mask, output;
    OfxParamHandle radius, gain, invert;
    OfxMutexHandle mutex;
    OfxImageMemoryHandle memory;
    void *block;
    int changes;
} state;

/* ------------------------------------------------------------------------------------- describe */

static OfxStatus describe(OfxImageEffectHandle effect)
{
    static const char *const contexts[] = {kOfxImageEffectContextFilter,
                                           kOfxImageEffectContextGeneral,
                                           kOfxImageEffectContextGenerator};
    static const char *const slaves[] = {"mono"};
    OfxPropertySetHandle p = props_of(effect);
    char *path = NULL;
    if (ofx.prop->propGetString(p, kOfxPluginPropFilePath, 0, &path) != kOfxStatOK || !*path)
        return kOfxStatFailed;
    ofx.prop->propSetString(p, kOfxPropLabel, 0, "Good");
    ofx.prop->propSetString(p, kOfxPropPluginDescription, 0, "Blurs, brightens and inverts.");
    ofx.prop->propSetString(p, kOfxImageEffectPluginPropGrouping, 0, "Tests/Good");
    ofx.prop->propSetStringN(p, kOfxImageEffectPropSupportedContexts, 3, contexts);
    ofx.prop->propSetString(p, kOfxImageEffectPropSupportedPixelDepths, 0, kOfxBitDepthFloat);
    ofx.prop->propSetString(p, kOfxImageEffectPluginRenderThreadSafety, 0,
                            kOfxImageEffectRenderFullySafe);
    ofx.prop->propSetInt(p, kOfxImageEffectPropTemporalClipAccess, 0, 1);
    ofx.prop->propSetStringN(p, kOfxImageEffectPropClipPreferencesSlaveParam, 1, slaves);
    ofx.prop->propSetString(p, "OfxImageEffectPropColourManagementStyle", 0,
                            "OfxImageEffectColourManagementCore");
    ofx.prop->propSetString(p, "OfxImageEffectPropColourManagementAvailableConfigs", 0,
                            "ofx-native-v1.5_aces-v1.3_ocio-v2.3");
    return kOfxStatOK;
}

static void describe_double(OfxImageEffectHandle effect, const char *name, double value, double max,
                            const char *parent)
{
    OfxPropertySetHandle p = define_param(effect, kOfxParamTypeDouble, name);
    ofx.prop->propSetDouble(p, kOfxParamPropDefault, 0, value);
    ofx.prop->propSetDouble(p, kOfxParamPropMin, 0, 0);
    ofx.prop->propSetDouble(p, kOfxParamPropMax, 0, max);
    ofx.prop->propSetDouble(p, kOfxParamPropDisplayMax, 0, max / 2);
    ofx.prop->propSetString(p, kOfxParamPropHint, 0, "A number.");
    ofx.prop->propSetString(p, kOfxParamPropParent, 0, parent);
}

static OfxStatus describe_in_context(OfxImageEffectHandle effect, OfxPropertySetHandle in)
{
    static const double point[] = {0.5, 0.25};
    static const char *const options[] = {"Box", "Long Box", "Hexagon"};
    static const char *const keys[] = {"one", "two"}, *const labels[] = {"The One", "The Two"};
    static const char *const children[] = {"radius", kOfxParamPageSkipRow, "gain"};
    char *context = NULL;
    OfxPropertySetHandle p;
    ofx.prop->propGetString(in, kOfxImageEffectPropContext, 0, &context);
    const bool generator = strcmp(context, kOfxImageEffectContextGenerator) == 0;

    p = define_clip(effect, kOfxImageEffectSimpleSourceClipName, generator);
    ofx.prop->propSetString(p, kOfxImageEffectPropSupportedComponents, 0, kOfxImageComponentRGBA);
    ofx.prop->propSetString(p, kOfxImageEffectPropSupportedComponents, 1, kOfxImageComponentAlpha);
    ofx.prop->propSetInt(p, kOfxImageEffectPropTemporalClipAccess, 0, 1);
    p = define_clip(effect, "Mask", true);
    ofx.prop->propSetString(p, kOfxImageEffectPropSupportedComponents, 0, kOfxImageComponentAlpha);
    ofx.prop->propSetInt(p, kOfxImageClipPropIsMask, 0, 1);
    p = define_clip(effect, kOfxImageEffectOutputClipName, false);
    ofx.prop->propSetString(p, kOfxImageEffectPropSupportedComponents, 0, kOfxImageComponentRGBA);
    ofx.prop->propSetString(p, kOfxImageEffectPropSupportedComponents, 1, kOfxImageComponentAlpha);

    p = define_param(effect, kOfxParamTypeGroup, "main");
    ofx.prop->propSetInt(p, kOfxParamPropGroupOpen, 0, 0);
    describe_double(effect, "radius", 0, 50, "main");
    describe_double(effect, "gain", 1, 10, "main");
    p = define_param(effect, kOfxParamTypeBoolean, "invert");
    ofx.prop->propSetInt(p, kOfxParamPropAnimates, 0, 1);
    define_param(effect, kOfxParamTypeBoolean, "mono");
    p = define_param(effect, kOfxParamTypeChoice, "shape");
    ofx.prop->propSetStringN(p, kOfxParamPropChoiceOption, 3, options);
    ofx.prop->propSetInt(p, kOfxParamPropDefault, 0, 2);
    ofx.prop->propSetInt(p, kOfxParamPropAnimates, 0, 1);
    p = define_param(effect, kOfxParamTypeStrChoice, "pick");
    ofx.prop->propSetStringN(p, kOfxParamPropChoiceOption, 2, labels);
    ofx.prop->propSetStringN(p, kOfxParamPropChoiceEnum, 2, keys);
    ofx.prop->propSetString(p, kOfxParamPropDefault, 0, "two");
    p = define_param(effect, kOfxParamTypeDouble2D, "centre");
    ofx.prop->propSetString(p, kOfxParamPropDoubleType, 0, kOfxParamDoubleTypeXYAbsolute);
    ofx.prop->propSetString(p, kOfxParamPropDefaultCoordinateSystem, 0,
                            kOfxParamCoordinatesNormalised);
    ofx.prop->propSetDoubleN(p, kOfxParamPropDefault, 2, point);
    define_param(effect, kOfxParamTypeDouble3D, "axis");
    define_param(effect, kOfxParamTypeInteger, "count");
    define_param(effect, kOfxParamTypeInteger2D, "cells");
    define_param(effect, kOfxParamTypeInteger3D, "voxels");
    define_param(effect, kOfxParamTypeRGB, "tint");
    define_param(effect, kOfxParamTypeRGBA, "paint");
    p = define_param(effect, kOfxParamTypeString, "note");
    ofx.prop->propSetString(p, kOfxParamPropDefault, 0, "a text, with commas");
    ofx.prop->propSetString(p, kOfxParamPropScriptName, 0, "remark");
    define_param(effect, kOfxParamTypeCustom, "blob");
    define_param(effect, kOfxParamTypePushButton, "reset");
    define_param(effect, kOfxParamTypePushButton, "probe");
    p = define_param(effect, kOfxParamTypePage, "page");
    ofx.prop->propSetStringN(p, kOfxParamPropPageChild, 3, children);
    return kOfxStatOK;
}

/* ------------------------------------------------------------------------------------- instance */

static state *state_of(OfxImageEffectHandle effect)
{
    void *data = NULL;
    ofx.prop->propGetPointer(props_of(effect), kOfxPropInstanceData, 0, &data);
    return data;
}

static OfxStatus create(OfxImageEffectHandle effect)
{
    state *s = calloc(1, sizeof *s);
    if (!s)
        return kOfxStatErrMemory;
    s->source = clip_of(effect, kOfxImageEffectSimpleSourceClipName);
    s->mask = clip_of(effect, "Mask");
    s->output = clip_of(effect, kOfxImageEffectOutputClipName);
    s->radius = param_of(effect, "radius");
    s->gain = param_of(effect, "gain");
    s->invert = param_of(effect, "invert");
    if (ofx.thread->mutexCreate(&s->mutex, 0) != kOfxStatOK ||
        ofx.effect->imageMemoryAlloc(effect, 1000, &s->memory) != kOfxStatOK ||
        ofx.memory->memoryAlloc(effect, 777, &s->block) != kOfxStatOK) {
        if (s->mutex)
            ofx.thread->mutexDestroy(s->mutex);
        if (s->memory)
            ofx.effect->imageMemoryFree(s->memory);
        free(s);
        return kOfxStatErrMemory;
    }
    ofx.prop->propSetPointer(props_of(effect), kOfxPropInstanceData, 0, s);
    return kOfxStatOK;
}

static OfxStatus destroy(OfxImageEffectHandle effect)
{
    state *s = state_of(effect);
    ofx.thread->mutexDestroy(s->mutex);
    ofx.effect->imageMemoryFree(s->memory);
    ofx.memory->memoryFree(s->block);
    free(s);
    return kOfxStatOK;
}

/* The button "probe" tries the calls that are of use in InstanceChanged; kOfxStatFailed when one of
   them answers wrongly. */
static OfxStatus probe(OfxImageEffectHandle effect)
{
    OfxParamSetHandle params = params_of(effect);
    OfxParamHandle gain = param_of(effect, "gain"), radius = param_of(effect, "radius");
    unsigned keys = 0;
    double time = 0, value = 0, first = 0, last = 0;
    int index = 0;
    bool ok = ofx.param->paramEditBegin(params, "probe") == kOfxStatOK;
    ok = ok && ofx.param->paramSetValueAtTime(gain, 10.0, 2.0) == kOfxStatOK;
    ok = ok && ofx.param->paramSetValueAtTime(gain, 20.0, 4.0) == kOfxStatOK;
    ok = ok && ofx.param->paramGetNumKeys(gain, &keys) == kOfxStatOK && keys == 2;
    ok = ok && ofx.param->paramGetKeyTime(gain, 1, &time) == kOfxStatOK && time == 20;
    ok = ok && ofx.param->paramGetKeyTime(gain, 2, &time) == kOfxStatErrBadIndex;
    ok = ok && ofx.param->paramGetKeyIndex(gain, 15, 1, &index) == kOfxStatOK && index == 1;
    ok = ok && ofx.param->paramGetKeyIndex(gain, 15, -1, &index) == kOfxStatOK && index == 0;
    ok = ok && ofx.param->paramGetKeyIndex(gain, 15, 0, &index) == kOfxStatFailed && index == -1;
    ok = ok && ofx.param->paramGetValueAtTime(gain, 15.0, &value) == kOfxStatOK && value == 3;
    ok = ok && ofx.param->paramGetDerivative(gain, 15.0, &value) == kOfxStatOK &&
         fabs(value - 0.2) < 1e-12;
    ok = ok && ofx.param->paramGetIntegral(gain, 10.0, 20.0, &value) == kOfxStatOK &&
         fabs(value - 30) < 1e-12;
    ok = ok && ofx.param->paramCopy(radius, gain, 5.0, NULL) == kOfxStatOK;
    ok = ok && ofx.param->paramGetValueAtTime(radius, 25.0, &value) == kOfxStatOK && value == 4;
    ok = ok && ofx.param->paramDeleteKey(radius, 25.0) == kOfxStatOK;
    ok = ok && ofx.param->paramDeleteKey(radius, 25.0) == kOfxStatErrBadIndex;
    ok = ok && ofx.param->paramDeleteAllKeys(radius) == kOfxStatOK;
    ok = ok && ofx.param->paramSetValue(radius, 0.0) == kOfxStatOK;
    ok = ok && ofx.param->paramSetValue(gain, 99.0) == kOfxStatOK; /* brought to its maximum */
    ok = ok && ofx.param->paramGetValue(gain, &value) == kOfxStatOK && value == 10;
    ok = ok && ofx.param->paramEditEnd(params) == kOfxStatOK;
    ok = ok && ofx.timeline->getTimeBounds(effect, &first, &last) == kOfxStatOK && first <= last;
    ok = ok && ofx.timeline->gotoTime(effect, first) == kOfxStatOK;
    ok = ok && ofx.timeline->getTime(effect, &time) == kOfxStatOK;
    ok = ok && ofx.progress->progressStart(effect, "probing", "probe") == kOfxStatOK;
    ok = ok && ofx.progress->progressUpdate(effect, 0.5) == kOfxStatOK;
    ok = ok && ofx.progress->progressEnd(effect) == kOfxStatOK;
    ok = ok &&
         ofx.message->message(effect, kOfxMessageMessage, "id", "%s %d", "found", 42) == kOfxStatOK;
    ok = ok && ofx.message->message(effect, kOfxMessageQuestion, "q", "sure?") == kOfxStatReplyYes;
    ok = ok && !ofx_fetch("uk.co.thefoundry.FnOfxImageEffectPlaneSuite", 2) &&
         !ofx_fetch(kOfxPropertySuite, 2);
    return ok ? kOfxStatOK : kOfxStatFailed;
}

static OfxStatus changed(OfxImageEffectHandle effect, OfxPropertySetHandle in)
{
    char *name = NULL, *type = NULL, *reason = NULL;
    state_of(effect)->changes++;
    ofx.prop->propGetString(in, kOfxPropType, 0, &type);
    ofx.prop->propGetString(in, kOfxPropName, 0, &name);
    ofx.prop->propGetString(in, kOfxPropChangeReason, 0, &reason);
    if (strcmp(type, kOfxTypeParameter) != 0 || strcmp(reason, kOfxChangeUserEdited) != 0)
        return kOfxStatReplyDefault;
    if (strcmp(name, "probe") == 0)
        return probe(effect);
    if (strcmp(name, "reset") == 0) {
        OfxPropertySetHandle props = NULL;
        ofx.param->paramSetValue(param_of(effect, "gain"), 1.0);
        ofx.param->paramSetValue(param_of(effect, "note"), "reset was pressed");
        ofx.param->paramGetPropertySet(param_of(effect, "count"), &props);
        return ofx.prop->propSetInt(props, kOfxParamPropSecret, 0, 1);
    }
    return kOfxStatReplyDefault;
}

/* -------------------------------------------------------------------------------- before pixels */

static OfxStatus preferences(OfxImageEffectHandle effect, OfxPropertySetHandle out)
{
    int mono = 0;
    char *context = NULL;
    ofx.param->paramGetValue(param_of(effect, "mono"), &mono);
    ofx.prop->propGetString(props_of(effect), kOfxImageEffectPropContext, 0, &context);
    ofx.prop->propSetString(out, "OfxImageClipPropPreferredColourspaces_Source", 0,
                            "lin_rec709_srgb");
    if (mono && strcmp(context, kOfxImageEffectContextGeneral) == 0) {
        ofx.prop->propSetString(out, "OfxImageClipPropComponents_Source", 0,
                                kOfxImageComponentAlpha);
        ofx.prop->propSetString(out, "OfxImageClipPropComponents_Output", 0,
                                kOfxImageComponentAlpha);
        return ofx.prop->propSetString(out, kOfxImageEffectPropPreMultiplication, 0,
                                       kOfxImageOpaque);
    }
    return kOfxStatOK;
}

static double radius_at(OfxImageEffectHandle effect, double time)
{
    double radius = 0;
    ofx.param->paramGetValueAtTime(state_of(effect)->radius, time, &radius);
    return floor(radius);
}

static OfxStatus region(OfxImageEffectHandle effect, OfxPropertySetHandle in,
                        OfxPropertySetHandle out)
{
    double time = 0;
    OfxRectD r;
    ofx.prop->propGetDouble(in, kOfxPropTime, 0, &time);
    const double radius = radius_at(effect, time);
    if (ofx.effect->clipGetRegionOfDefinition(state_of(effect)->source, time, &r) != kOfxStatOK ||
        r.x2 <= r.x1)
        return kOfxStatReplyDefault;
    const double grown[] = {r.x1 - radius, r.y1 - radius, r.x2 + radius, r.y2 + radius};
    return ofx.prop->propSetDoubleN(out, kOfxImageEffectPropRegionOfDefinition, 4, grown);
}

static OfxStatus needed(OfxImageEffectHandle effect, OfxPropertySetHandle in,
                        OfxPropertySetHandle out)
{
    double time = 0, r[4] = {0};
    ofx.prop->propGetDouble(in, kOfxPropTime, 0, &time);
    ofx.prop->propGetDoubleN(in, kOfxImageEffectPropRegionOfInterest, 4, r);
    const double radius = radius_at(effect, time);
    const double grown[] = {r[0] - radius, r[1] - radius, r[2] + radius, r[3] + radius};
    return ofx.prop->propSetDoubleN(out, "OfxImageClipPropRoI_Source", 4, grown);
}

static int is_connected(OfxImageClipHandle clip)
{
    OfxPropertySetHandle p = NULL;
    int connected = 0;
    ofx.effect->clipGetPropertySet(clip, &p);
    ofx.prop->propGetInt(p, kOfxImageClipPropConnected, 0, &connected);
    return connected;
}

static OfxStatus identity(OfxImageEffectHandle effect, OfxPropertySetHandle in,
                          OfxPropertySetHandle out)
{
    double time = 0, gain = 0;
    int invert = 0;
    const state *s = state_of(effect);
    ofx.prop->propGetDouble(in, kOfxPropTime, 0, &time);
    ofx.param->paramGetValueAtTime(s->gain, time, &gain);
    ofx.param->paramGetValueAtTime(s->invert, time, &invert);
    if (radius_at(effect, time) > 0 || gain != 1 || invert || is_connected(s->mask) ||
        !is_connected(s->source))
        return kOfxStatReplyDefault;
    return ofx.prop->propSetString(out, kOfxPropName, 0, kOfxImageEffectSimpleSourceClipName);
}

/* --------------------------------------------------------------------------------------- render */

typedef struct work {
    OfxImageEffectHandle effect;
    const state *s;
    const picture *source, *mask, *output;
    OfxRectI window;
    int rx, ry;
    float gain;
    int invert, masked;
    int rows_done;
} work;

static float sample(const picture *p, int x, int y, int c)
{
    if (!p->data || x < p->bounds.x1 || x >= p->bounds.x2 || y < p->bounds.y1 || y >= p->bounds.y2)
        return 0;
    return picture_at(p, x, y)[c < p->components ? c : 0];
}

static void pixel(const work *w, int x, int y, float *to)
{
    for (int c = 0; c < w->output->components; c++) {
        float sum = 0;
        for (int dy = -w->ry; dy <= w->ry; dy++)
            for (int dx = -w->rx; dx <= w->rx; dx++)
                sum += sample(w->source, x + dx, y + dy, c);
        sum *= w->gain / (float)((2 * w->rx + 1) * (2 * w->ry + 1));
        if (w->invert && c < 3)
            sum = 1 - sum;
        if (w->masked) /* where the mask has no picture it is 0 */
            sum *= sample(w->mask, x, y, 0);
        to[c] = sum;
    }
}

static void rows(unsigned int index, unsigned int count, void *user)
{
    work *w = user;
    const int height = w->window.y2 - w->window.y1;
    const int first = w->window.y1 + (int)((long long)height * index / count);
    const int last = w->window.y1 + (int)((long long)height * (index + 1) / count);
    void *scratch = NULL;
    unsigned here = 0;
    ofx.thread->multiThreadIndex(&here);
    const size_t size = (size_t)(w->window.x2 - w->window.x1) * 4 * sizeof(float);
    if (here != index || !ofx.thread->multiThreadIsSpawnedThread() ||
        ofx.memory->memoryAlloc(w->effect, size, &scratch) != kOfxStatOK)
        return;
    for (int y = first; y < last && !ofx.effect->abort(w->effect); y++) {
        float *to = scratch;
        for (int x = w->window.x1; x < w->window.x2; x++, to += w->output->components)
            pixel(w, x, y, to);
        memcpy(picture_at(w->output, w->window.x1, y), scratch,
               (size_t)(w->window.x2 - w->window.x1) * (size_t)w->output->components *
                   sizeof(float));
        ofx.thread->mutexLock(w->s->mutex);
        w->rows_done++;
        ofx.thread->mutexUnLock(w->s->mutex);
    }
    ofx.memory->memoryFree(scratch);
}

static OfxStatus render(OfxImageEffectHandle effect, OfxPropertySetHandle in)
{
    const state *s = state_of(effect);
    picture source, mask, output;
    double time = 0, scale[2] = {0}, gain = 0;
    unsigned cpus = 1;
    void *memory = NULL;
    work w = {.effect = effect, .s = s, .source = &source, .mask = &mask, .output = &output};
    ofx.prop->propGetDouble(in, kOfxPropTime, 0, &time);
    ofx.prop->propGetDoubleN(in, kOfxImageEffectPropRenderScale, 2, scale);
    ofx.prop->propGetIntN(in, kOfxImageEffectPropRenderWindow, 4, &w.window.x1);
    ofx.param->paramGetValueAtTime(s->gain, time, &gain);
    ofx.param->paramGetValueAtTime(s->invert, time, &w.invert);
    w.gain = (float)gain;
    w.rx = (int)(radius_at(effect, time) * scale[0]);
    w.ry = (int)(radius_at(effect, time) * scale[1]);
    if (ofx.report->mode(effect) == kWideOpenReportExplain)
        return ofx.report->publish(effect, "plan", "it blurs") ? kOfxStatFailed : kOfxStatOK;
    if (picture_get(s->output, time, NULL, &output) != kOfxStatOK)
        return kOfxStatFailed;
    (void)picture_get(s->source, time, NULL, &source);
    (void)picture_get(s->mask, time, NULL, &mask);
    w.masked = is_connected(s->mask);
    ofx.effect->imageMemoryLock(s->memory, &memory);
    ofx.thread->multiThreadNumCPUs(&cpus);
    const OfxStatus status = ofx.thread->multiThread(rows, cpus, &w);
    ofx.effect->imageMemoryUnlock(s->memory);
    if (mask.handle)
        ofx.effect->clipReleaseImage(mask.handle);
    if (source.handle)
        ofx.effect->clipReleaseImage(source.handle);
    ofx.effect->clipReleaseImage(output.handle);
    if (ofx.report->mode(effect) == kWideOpenReportRender)
        ofx.report->publish(effect, "report", "{\"rows\": 1}");
    return status;
}

static OfxStatus main_entry(const char *action, const void *handle, OfxPropertySetHandle in,
                            OfxPropertySetHandle out)
{
    OfxImageEffectHandle effect = (OfxImageEffectHandle)(uintptr_t)handle;
    if (strcmp(action, kOfxActionLoad) == 0)
        return ofx_load() ? kOfxStatOK : kOfxStatErrMissingHostFeature;
    if (strcmp(action, kOfxActionDescribe) == 0)
        return describe(effect);
    if (strcmp(action, kOfxImageEffectActionDescribeInContext) == 0)
        return describe_in_context(effect, in);
    if (strcmp(action, kOfxActionCreateInstance) == 0)
        return create(effect);
    if (strcmp(action, kOfxActionDestroyInstance) == 0)
        return destroy(effect);
    if (strcmp(action, kOfxActionInstanceChanged) == 0)
        return changed(effect, in);
    if (strcmp(action, kOfxImageEffectActionGetClipPreferences) == 0)
        return preferences(effect, out);
    if (strcmp(action, kOfxImageEffectActionGetRegionOfDefinition) == 0)
        return region(effect, in, out);
    if (strcmp(action, kOfxImageEffectActionGetRegionsOfInterest) == 0)
        return needed(effect, in, out);
    if (strcmp(action, kOfxImageEffectActionIsIdentity) == 0)
        return identity(effect, in, out);
    if (strcmp(action, kOfxImageEffectActionRender) == 0)
        return render(effect, in);
    return kOfxStatReplyDefault;
}

static void set_host(OfxHost *host)
{
    ofx.host = host;
}

static OfxPlugin plugin = {
    .pluginApi = kOfxImageEffectPluginApi,
    .apiVersion = kOfxImageEffectPluginApiVersion,
    .pluginIdentifier = "org.wideopen.test.Good",
    .pluginVersionMajor = 1,
    .pluginVersionMinor = 3,
    .setHost = set_host,
    .mainEntry = main_entry,
};

OfxExport int OfxGetNumberOfPlugins(void)
{
    return 1;
}

OfxExport OfxPlugin *OfxGetPlugin(int nth)
{
    return nth == 0 ? &plugin : NULL;
}
