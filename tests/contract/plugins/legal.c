/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* A plugin that uses rights few plugins use, and says what the host tells it. Any answer that is
   not the standard's makes the action fail. */

#include "host_plugin.h"

#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static OfxStatus failed;

static void must(OfxStatus status, OfxStatus wanted)
{
    if (status != wanted)
        failed = kOfxStatFailed;
}

static OfxPropertySetHandle param_props(OfxImageEffectHandle effect, const char *name)
{
    OfxParamHandle param = NULL;
    OfxPropertySetHandle props = NULL;
    must(ofx.param->paramGetHandle(params_of(effect), name, &param, &props), kOfxStatOK);
    return props;
}

/* Extensions of other hosts, in a host without them. */
static void set_extensions(OfxPropertySetHandle p)
{
    static const char *const names[] = {"OfxParamPropLayoutHint",
                                        "OfxParamPropLayoutPadWidth",
                                        "OfxImageEffectPropCanDistort",
                                        "OfxImageEffectPropRenderQualityDraft",
                                        "OfxImageEffectPropVegasUpliftGUID",
                                        "uk.co.thefoundry.OfxImageEffectPropMultiPlanar"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        must(ofx.prop->propSetInt(p, names[i], 0, 1), kOfxStatErrUnknown);
}

static OfxStatus describe(OfxImageEffectHandle effect)
{
    static const char *const contexts[] = {kOfxImageEffectContextFilter,
                                           kOfxImageEffectContextGeneral};
    OfxPropertySetHandle p = props_of(effect);
    ofx.prop->propSetString(p, kOfxPropLabel, 0, "Legal");
    ofx.prop->propSetStringN(p, kOfxImageEffectPropSupportedContexts, 2, contexts);
    ofx.prop->propSetString(p, kOfxImageEffectPropSupportedPixelDepths, 0, kOfxBitDepthFloat);
    set_extensions(p);
    return failed;
}

static OfxStatus describe_in_context(OfxImageEffectHandle effect)
{
    static const char *const source[] = {kOfxImageComponentRGB, kOfxImageComponentRGBA};
    static const char *const params[] = {"a", "b", "c"}, *const labels[] = {"The a", "The b"};
    static const int order[] = {2, 1};
    OfxPropertySetHandle p = define_clip(effect, kOfxImageEffectSimpleSourceClipName, false);
    ofx.prop->propSetStringN(p, kOfxImageEffectPropSupportedComponents, 2, source);
    p = define_clip(effect, "Mask", true);
    ofx.prop->propSetString(p, kOfxImageEffectPropSupportedComponents, 0, kOfxImageComponentAlpha);
    p = define_clip(effect, kOfxImageEffectOutputClipName, false);
    ofx.prop->propSetStringN(p, kOfxImageEffectPropSupportedComponents, 2, source);
    for (int i = 0; i < 3; i++)
        define_param(effect, kOfxParamTypeDouble, params[i]);
    const OfxPropertySetHandle keyed = define_param(effect, kOfxParamTypeStrChoice, "keyed");
    must(ofx.prop->propSetStringN(keyed, kOfxParamPropChoiceOption, 2, labels), kOfxStatOK);
    must(ofx.prop->propSetStringN(keyed, kOfxParamPropChoiceEnum, 2, params), kOfxStatOK);
    must(ofx.prop->propSetIntN(keyed, kOfxParamPropChoiceOrder, 2, order), kOfxStatOK);
    must(ofx.prop->propSetString(keyed, kOfxParamPropDefault, 0, "b"), kOfxStatOK);
    define_param(effect, kOfxParamTypePushButton, "tell");
    define_param(effect, kOfxParamTypePushButton, "change");
    define_param(effect, kOfxParamTypePushButton, "memory");
    set_extensions(p);
    return failed;
}

static int tell_clip(OfxImageEffectHandle effect, const char *name, char *text, size_t size)
{
    static const char *const words[] = {
        kOfxImageEffectPropComponents, kOfxImageEffectPropPixelDepth,
        kOfxImageClipPropUnmappedComponents, kOfxImageClipPropUnmappedPixelDepth,
        kOfxImageEffectPropPreMultiplication};
    OfxImageClipHandle clip = NULL;
    OfxPropertySetHandle p = NULL;
    OfxRectD region = {0, 0, 0, 0};
    char *word = NULL;
    int connected = -1, used = 0;
    double aspect = 0, rate = 0, range[2] = {0, 0}, unmapped[2] = {0, 0};
    ofx.effect->clipGetHandle(effect, name, &clip, &p);
    must(ofx.prop->propGetInt(p, kOfxImageClipPropConnected, 0, &connected), kOfxStatOK);
    used += snprintf(text, size, "%s %d", name, connected);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        must(ofx.prop->propGetString(p, words[i], 0, &word), kOfxStatOK);
        used += snprintf(text + used, size - (size_t)used, " %s", word);
    }
    must(ofx.prop->propGetDouble(p, kOfxImagePropPixelAspectRatio, 0, &aspect), kOfxStatOK);
    must(ofx.prop->propGetDouble(p, kOfxImageEffectPropFrameRate, 0, &rate), kOfxStatOK);
    must(ofx.prop->propGetDoubleN(p, kOfxImageEffectPropFrameRange, 2, range), kOfxStatOK);
    must(ofx.prop->propGetDoubleN(p, kOfxImageEffectPropUnmappedFrameRange, 2, unmapped),
         kOfxStatOK);
    if (memcmp(range, unmapped, sizeof range) != 0)
        failed = kOfxStatFailed;
    used += snprintf(text + used, size - (size_t)used, " %g %g %g-%g", aspect, rate, range[0],
                     range[1]);
    must(ofx.effect->clipGetRegionOfDefinition(clip, 3, &region), kOfxStatOK);
    used += snprintf(text + used, size - (size_t)used, " %g,%g,%g,%g", region.x1, region.y1,
                     region.x2, region.y2);
    used += snprintf(text + used, size - (size_t)used, "\n");
    return used;
}

static void tell_clips(OfxImageEffectHandle effect)
{
    static const char *const names[] = {"Source", "Mask", "Output"};
    char text[2048];
    int used = 0;
    for (int i = 0; i < 3; i++)
        used += tell_clip(effect, names[i], text + used, sizeof text - (size_t)used);
    ofx.message->message(effect, kOfxMessageLog, "", "%s", text);
}

static void use_memory(OfxImageEffectHandle effect)
{
    OfxImageMemoryHandle memory = NULL;
    OfxMutexHandle mutex = NULL;
    void *data = NULL;
    must(ofx.effect->imageMemoryAlloc(effect, 10, &memory), kOfxStatOK);
    must(ofx.effect->imageMemoryUnlock(memory), kOfxStatOK); /* has no effect */
    must(ofx.effect->imageMemoryLock(memory, &data), kOfxStatOK);
    must(ofx.effect->imageMemoryLock(memory, &data), kOfxStatOK);
    must(ofx.effect->imageMemoryFree(memory), kOfxStatOK); /* whatever is locked */
    must(ofx.thread->mutexCreate(&mutex, -2), kOfxStatOK);
    must(ofx.thread->mutexLock(mutex), kOfxStatOK);
    must(ofx.thread->mutexUnLock(mutex), kOfxStatOK);
    must(ofx.thread->mutexDestroy(mutex), kOfxStatOK);
}

static OfxStatus changed(OfxImageEffectHandle effect, OfxPropertySetHandle in)
{
    char *name = NULL, *reason = NULL;
    ofx.prop->propGetString(in, kOfxPropName, 0, &name);
    ofx.prop->propGetString(in, kOfxPropChangeReason, 0, &reason);
    if (strcmp(reason, kOfxChangePluginEdited) == 0)
        ofx.message->message(effect, kOfxMessageLog, "", "%s ", name);
    if (strcmp(name, "tell") == 0)
        tell_clips(effect);
    if (strcmp(name, "memory") == 0)
        use_memory(effect);
    if (strcmp(name, "change") == 0) {
        must(ofx.param->paramSetValue(param_of(effect, "c"), 1.0), kOfxStatOK);
        must(ofx.param->paramSetValue(param_of(effect, "a"), 1.0), kOfxStatOK);
        must(ofx.param->paramSetValue(param_of(effect, "b"), 1.0), kOfxStatOK);
        must(ofx.param->paramSetValue(param_of(effect, "c"), 2.0), kOfxStatOK);
    }
    return failed;
}

/* What a parameter looks like may follow anything but the making of pixels. */
static void dress(OfxImageEffectHandle effect, OfxStatus wanted)
{
    const OfxPropertySetHandle p = param_props(effect, "a");
    must(ofx.prop->propSetString(p, kOfxPropLabel, 0, "Alpha"), wanted);
    must(ofx.prop->propSetString(p, kOfxParamPropHint, 0, "The first."), wanted);
    must(ofx.prop->propSetDouble(p, kOfxParamPropMin, 0, -5), wanted);
    must(ofx.prop->propSetDouble(p, kOfxParamPropMax, 0, 5), wanted);
    must(ofx.prop->propSetDouble(p, kOfxParamPropDisplayMin, 0, 0), wanted);
    must(ofx.prop->propSetDouble(p, kOfxParamPropDisplayMax, 0, 4), wanted);
    must(ofx.prop->propSetDouble(p, kOfxParamPropDefault, 0, 1), wanted);
    must(ofx.prop->propSetDouble(p, kOfxParamPropIncrement, 0, 0.5), wanted);
    must(ofx.prop->propSetInt(p, kOfxParamPropDigits, 0, 1), wanted);
    must(ofx.prop->propSetInt(p, kOfxParamPropShowTimeMarker, 0, 1), wanted);
    must(ofx.prop->propSetInt(p, kOfxParamPropEnabled, 0, 0), wanted);
    must(ofx.prop->propSetInt(p, kOfxParamPropSecret, 0, 1), wanted);
}

static OfxStatus preferences(OfxImageEffectHandle effect, OfxPropertySetHandle out)
{
    static const int format[] = {0, 0, 40, 30};
    dress(effect, kOfxStatOK);
    must(ofx.prop->propSetIntN(out, "OfxImageClipPropFormat", 4, format), kOfxStatErrUnknown);
    return failed;
}

static OfxStatus render(OfxImageEffectHandle effect, OfxPropertySetHandle in)
{
    OfxRectI w = {0, 0, 0, 0};
    picture output, source;
    const OfxRectD wide = {-1e6, -1e6, 1e6, 1e6};
    double time = 0;
    ofx.prop->propGetDouble(in, kOfxPropTime, 0, &time);
    ofx.prop->propGetIntN(in, kOfxImageEffectPropRenderWindow, 4, &w.x1);
    /* more than was asked for beforehand, cut to what there is */
    must(picture_get(clip_of(effect, kOfxImageEffectSimpleSourceClipName), time, &wide, &source),
         kOfxStatOK);
    if (source.bounds.x2 - source.bounds.x1 < w.x2 - w.x1)
        failed = kOfxStatFailed;
    must(ofx.effect->clipReleaseImage(source.handle), kOfxStatOK);
    if (picture_get(clip_of(effect, kOfxImageEffectOutputClipName), time, NULL, &output) !=
        kOfxStatOK)
        return kOfxStatFailed;
    for (int y = w.y1; y < w.y2; y++)
        for (int x = w.x1; x < w.x2; x++)
            for (int c = 0; c < output.components; c++)
                picture_at(&output, x, y)[c] = 0.5f;
    ofx.effect->clipReleaseImage(output.handle);
    return failed;
}

/* A thread that nobody waits for; it is still at work when the plugin is unloaded. */
static void *linger(void *user)
{
    const struct timespec moment = {.tv_nsec = 2000000};
    (void)user;
    for (int i = 0; i < 50; i++)
        nanosleep(&moment, NULL);
    return NULL;
}

static void start_lingering(void)
{
    pthread_t thread;
    if (getenv("WO_TEST_LINGER") && pthread_create(&thread, NULL, linger, NULL) == 0)
        pthread_detach(thread);
}

static OfxStatus main_entry(const char *action, const void *handle, OfxPropertySetHandle in,
                            OfxPropertySetHandle out)
{
    OfxImageEffectHandle effect = (OfxImageEffectHandle)(uintptr_t)handle;
    failed = kOfxStatOK;
    if (strcmp(action, kOfxActionUnload) == 0)
        start_lingering();
    if (strcmp(action, kOfxActionLoad) == 0)
        return ofx_load() ? kOfxStatOK : kOfxStatErrMissingHostFeature;
    if (strcmp(action, kOfxActionDescribe) == 0)
        return describe(effect);
    if (strcmp(action, kOfxImageEffectActionDescribeInContext) == 0)
        return describe_in_context(effect);
    if (strcmp(action, kOfxActionCreateInstance) == 0) {
        tell_clips(effect);
        return failed;
    }
    if (strcmp(action, kOfxActionInstanceChanged) == 0)
        return changed(effect, in);
    if (strcmp(action, kOfxImageEffectActionGetClipPreferences) == 0)
        return preferences(effect, out);
    if (strcmp(action, kOfxImageEffectActionGetRegionOfDefinition) == 0) {
        static const double sides[] = {1, 2, 33, 24};
        dress(effect, kOfxStatOK);
        must(ofx.prop->propSetDoubleN(out, kOfxImageEffectPropRegionOfDefinition, 4, sides),
             kOfxStatOK);
        return failed;
    }
    if (strcmp(action, kOfxImageEffectActionIsIdentity) == 0) {
        dress(effect, kOfxStatOK);
        tell_clips(effect);
        must(ofx.prop->propSetString(out, "OfxImageEffectPropIdentityPlane", 0, "colour"),
             kOfxStatErrUnknown);
        return failed == kOfxStatOK ? kOfxStatReplyDefault : failed;
    }
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
    .pluginIdentifier = "org.wideopen.test.Legal",
    .pluginVersionMajor = 1,
    .pluginVersionMinor = 0,
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
