/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* A plugin that commits one breach of the standard, named by the environment variable
   WO_TEST_MISDEED, and is correct otherwise. */

#include "host_plugin.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static OfxPropertySetHandle kept_image;
static OfxParamHandle kept_param;
static OfxPropertySetHandle kept_arguments;

static bool misdeed(const char *name)
{
    const char *chosen = getenv("WO_TEST_MISDEED");
    return chosen && strcmp(chosen, name) == 0;
}

static OfxStatus describe(OfxImageEffectHandle effect)
{
    OfxPropertySetHandle p = props_of(effect);
    OfxPropertySetHandle clip = NULL;
    if (!misdeed("no label"))
        ofx.prop->propSetString(p, kOfxPropLabel, 0, "Bad");
    if (!misdeed("no depths"))
        ofx.prop->propSetString(p, kOfxImageEffectPropSupportedPixelDepths, 0, kOfxBitDepthFloat);
    ofx.prop->propSetString(p, kOfxImageEffectPropSupportedContexts, 0,
                            kOfxImageEffectContextFilter);
    ofx.prop->propSetString(p, kOfxImageEffectPropSupportedContexts, 1,
                            kOfxImageEffectContextGeneral);
    if (misdeed("frames of NaN") || misdeed("frames not in pairs"))
        ofx.prop->propSetInt(p, kOfxImageEffectPropTemporalClipAccess, 0, 1);
    if (misdeed("unknown property set"))
        ofx.prop->propSetInt(p, "OfxImageEffectPropNoSuchThing", 0, 1);
    if (misdeed("wrong type"))
        ofx.prop->propSetDouble(p, kOfxPropLabel, 0, 1);
    if (misdeed("bad index"))
        ofx.prop->propSetString(p, kOfxPropLabel, 1, "too many");
    if (misdeed("gap in list"))
        ofx.prop->propSetString(p, kOfxImageEffectPropSupportedContexts, 7, "far");
    if (misdeed("read-only write"))
        ofx.prop->propSetString(p, kOfxPropType, 0, "mine");
    if (misdeed("host write"))
        ofx.prop->propSetString(ofx.host->host, kOfxPropName, 0, "mine");
    if (misdeed("NULL string"))
        ofx.prop->propSetString(p, kOfxPropLabel, 0, NULL);
    if (misdeed("NULL property name"))
        ofx.prop->propSetInt(p, NULL, 0, 1);
    if (misdeed("bad safety"))
        ofx.prop->propSetString(p, kOfxImageEffectPluginRenderThreadSafety, 0, "quite");
    if (misdeed("clipDefine in describe"))
        ofx.effect->clipDefine(effect, "Early", &clip);
    if (misdeed("paramDefine in describe"))
        ofx.param->paramDefine(params_of(effect), kOfxParamTypeDouble, "early", &clip);
    if (misdeed("multiThread with nothing"))
        ofx.thread->multiThread(NULL, 1, NULL);
    if (misdeed("illegal describe status"))
        return kOfxStatReplyDefault;
    return kOfxStatOK;
}

static OfxStatus describe_in_context(OfxImageEffectHandle effect)
{
    OfxPropertySetHandle p = define_clip(effect, kOfxImageEffectSimpleSourceClipName, false);
    ofx.prop->propSetString(p, kOfxImageEffectPropSupportedComponents, 0, kOfxImageComponentRGBA);
    p = define_clip(effect, misdeed("no output") ? "Elsewhere" : kOfxImageEffectOutputClipName,
                    misdeed("no output"));
    if (!misdeed("no components"))
        ofx.prop->propSetString(p, kOfxImageEffectPropSupportedComponents, 0,
                                kOfxImageComponentRGBA);
    p = define_param(effect, kOfxParamTypeDouble, "amount");
    ofx.prop->propSetDouble(p, kOfxParamPropMax, 0, 1);
    if (misdeed("default out of range"))
        ofx.prop->propSetDouble(p, kOfxParamPropDefault, 0, 2);
    if (misdeed("range upside down"))
        ofx.prop->propSetDouble(p, kOfxParamPropMin, 0, 5);
    if (misdeed("parent is no group"))
        ofx.prop->propSetString(p, kOfxParamPropParent, 0, "nobody");
    if (misdeed("two of a name"))
        define_param(effect, kOfxParamTypeInteger, "amount");
    if (misdeed("two clips of a name"))
        define_clip(effect, kOfxImageEffectSimpleSourceClipName, true);
    if (misdeed("choice without options"))
        define_param(effect, kOfxParamTypeChoice, "empty");
    if (misdeed("page of strangers"))
        ofx.prop->propSetString(define_param(effect, kOfxParamTypePage, "page"),
                                kOfxParamPropPageChild, 0, "stranger");
    if (misdeed("param handle of a descriptor")) {
        double value = 0;
        ofx.param->paramGetValue(param_of(effect, "amount"), &value);
    }
    define_param(effect, kOfxParamTypePushButton, "go");
    define_param(effect, kOfxParamTypeString, "text");
    return kOfxStatOK;
}

static OfxStatus create(OfxImageEffectHandle effect)
{
    void *block = NULL;
    OfxImageMemoryHandle memory = NULL;
    OfxMutexHandle mutex = NULL;
    picture p;
    kept_param = param_of(effect, "amount");
    if (misdeed("leak memory"))
        ofx.memory->memoryAlloc(effect, 123, &block);
    if (misdeed("leak plugin memory"))
        ofx.memory->memoryAlloc(NULL, 321, &block);
    if (misdeed("leak image memory"))
        ofx.effect->imageMemoryAlloc(effect, 456, &memory);
    if (misdeed("leak mutex"))
        ofx.thread->mutexCreate(&mutex, 0);
    if (misdeed("leak locked mutex"))
        ofx.thread->mutexCreate(&mutex, 2);
    if (misdeed("image in create"))
        (void)picture_get(clip_of(effect, kOfxImageEffectSimpleSourceClipName), 0, NULL, &p);
    if (misdeed("illegal create status"))
        return kOfxStatReplyYes;
    return kOfxStatOK;
}

/* What the button "go" does: everything that goes wrong outside of renders. */
static OfxStatus changed(OfxImageEffectHandle effect)
{
    void *block = NULL;
    char *text = NULL;
    double number = 0;
    int index = 0;
    OfxMutexHandle mutex = NULL;
    OfxImageMemoryHandle memory = NULL;
    OfxPropertySetHandle p = NULL;
    picture image;
    if (misdeed("edit without end"))
        ofx.param->paramEditBegin(params_of(effect), "edit");
    if (misdeed("end without edit"))
        ofx.param->paramEditEnd(params_of(effect));
    if (misdeed("double free")) {
        ofx.memory->memoryAlloc(effect, 10, &block);
        ofx.memory->memoryFree(block);
        ofx.memory->memoryFree(block);
    }
    if (misdeed("free of a stranger"))
        ofx.memory->memoryFree(&block);
    if (misdeed("write past memory")) {
        ofx.memory->memoryAlloc(effect, 10, &block);
        ((char *)block)[10] = 1;
        ofx.memory->memoryFree(block);
    }
    if (misdeed("write before image memory")) {
        ofx.effect->imageMemoryAlloc(effect, 10, &memory);
        ofx.effect->imageMemoryLock(memory, &block);
        ((char *)block)[-1] = 1;
        ofx.effect->imageMemoryUnlock(memory);
        ofx.effect->imageMemoryFree(memory);
    }
    if (misdeed("image memory freed twice")) {
        ofx.effect->imageMemoryAlloc(effect, 10, &memory);
        ofx.effect->imageMemoryFree(memory);
        ofx.effect->imageMemoryFree(memory);
    }
    if (misdeed("unlock of an unlocked mutex")) {
        ofx.thread->mutexCreate(&mutex, 0);
        ofx.thread->mutexUnLock(mutex);
        ofx.thread->mutexDestroy(mutex);
    }
    if (misdeed("mutex destroyed twice")) {
        ofx.thread->mutexCreate(&mutex, 0);
        ofx.thread->mutexDestroy(mutex);
        ofx.thread->mutexDestroy(mutex);
    }
    if (misdeed("locked mutex destroyed")) {
        ofx.thread->mutexCreate(&mutex, 1);
        ofx.thread->mutexDestroy(mutex);
    }
    if (misdeed("wrong kind of handle"))
        ofx.effect->clipGetPropertySet((OfxImageClipHandle)(void *)effect, &p);
    if (misdeed("random handle"))
        ofx.effect->getPropertySet((OfxImageEffectHandle)(uintptr_t)0x1234567890abcdefu, &p);
    if (misdeed("pointer as handle"))
        ofx.prop->propGetInt((OfxPropertySetHandle)(void *)&image, kOfxPropType, 0, &index);
    if (misdeed("NULL handle"))
        ofx.param->paramGetValue(NULL, &number);
    if (misdeed("NULL place"))
        ofx.param->paramGetValue(param_of(effect, "amount"), (double *)NULL);
    if (misdeed("value of a button"))
        ofx.param->paramGetValue(param_of(effect, "go"), &number);
    if (misdeed("derivative of a text"))
        ofx.param->paramGetDerivative(param_of(effect, "text"), 0.0, &text);
    if (misdeed("param set to NaN"))
        ofx.param->paramSetValue(param_of(effect, "amount"), (double)NAN);
    if (misdeed("text set to NULL"))
        ofx.param->paramSetValue(param_of(effect, "text"), (const char *)NULL);
    if (misdeed("copy between types"))
        ofx.param->paramCopy(param_of(effect, "amount"), param_of(effect, "text"), 0, NULL);
    if (misdeed("instance property write"))
        ofx.prop->propSetString(props_of(effect), kOfxImageEffectPropContext, 0, "mine");
    if (misdeed("stale arguments"))
        ofx.prop->propGetDouble(kept_arguments, kOfxPropTime, 0, &number);
    if (misdeed("index beyond dimension"))
        ofx.prop->propGetDouble(props_of(effect), kOfxImageEffectPropProjectSize, 2, &number);
    if (misdeed("count beyond dimension"))
        ofx.prop->propGetDoubleN(props_of(effect), kOfxImageEffectPropProjectSize, 3, &number);
    if (misdeed("output in instance changed"))
        (void)picture_get(clip_of(effect, kOfxImageEffectOutputClipName), 0, NULL, &image);
    if (misdeed("clipDefine on instance"))
        ofx.effect->clipDefine(effect, "Late", &p);
    if (misdeed("message of no type"))
        ofx.message->message(effect, "loud", "", "hello");
    if (misdeed("progress without start"))
        ofx.progress->progressUpdate(effect, 0.5);
    if (misdeed("progress without end"))
        ofx.progress->progressStart(effect, "long", "");
    if (misdeed("progress of 7"))
        if (ofx.progress->progressStart(effect, "long", "") == kOfxStatOK) {
            ofx.progress->progressUpdate(effect, 7);
            ofx.progress->progressEnd(effect);
        }
    if (misdeed("unasked report"))
        ofx.report->publish(effect, "report", "{}");
    if (misdeed("suite without name"))
        (void)ofx.host->fetchSuite(ofx.host->host, NULL, 1);
    if (misdeed("suite of a stranger"))
        (void)ofx.host->fetchSuite(NULL, kOfxPropertySuite, 1);
    if (misdeed("fatal"))
        return kOfxStatErrFatal;
    return kOfxStatOK;
}

static void nothing(unsigned int index, unsigned int count, void *user)
{
    (void)index;
    (void)count;
    (void)user;
}

static void nested(unsigned int index, unsigned int count, void *user)
{
    (void)index;
    (void)count;
    *(OfxStatus *)user = ofx.thread->multiThread(nothing, 2, NULL);
}

static void set_in_thread(unsigned int index, unsigned int count, void *user)
{
    (void)count;
    if (index == 0)
        ofx.param->paramSetValue(param_of(user, "amount"), 0.5);
}

static void fill(const picture *p, OfxRectI w)
{
    for (int y = w.y1; y < w.y2; y++)
        for (int x = w.x1; x < w.x2; x++)
            for (int c = 0; c < p->components; c++)
                picture_at(p, x, y)[c] = 0.25f;
}

static OfxStatus render(OfxImageEffectHandle effect, OfxPropertySetHandle in)
{
    OfxImageClipHandle source_clip = clip_of(effect, kOfxImageEffectSimpleSourceClipName);
    OfxImageClipHandle output_clip = clip_of(effect, kOfxImageEffectOutputClipName);
    OfxRectI window = {0};
    OfxStatus status = kOfxStatOK;
    picture source, output;
    double time = 0, number = 0;
    ofx.prop->propGetDouble(in, kOfxPropTime, 0, &time);
    ofx.prop->propGetIntN(in, kOfxImageEffectPropRenderWindow, 4, &window.x1);
    if (picture_get(output_clip, time, NULL, &output) != kOfxStatOK)
        return kOfxStatFailed;
    const OfxStatus got =
        picture_get(source_clip, misdeed("another time") ? time + 1 : time, NULL, &source);
    if (misdeed("window not written"))
        window.x2--;
    fill(&output, window);
    if (misdeed("write outside window"))
        picture_at(&output, output.bounds.x1, output.bounds.y1)[0] = 1;
    if (misdeed("write outside buffer"))
        picture_at(&output, output.bounds.x1, output.bounds.y1)[-1] = 1;
    if (misdeed("write a row too many"))
        picture_at(&output, output.bounds.x1, output.bounds.y2)[0] = 1;
    if (misdeed("write into padding"))
        picture_at(&output, output.bounds.x2, output.bounds.y1)[1] = 1;
    if (misdeed("write into input"))
        picture_at(&source, source.bounds.x1, source.bounds.y1)[0] += 1;
    if (misdeed("write outside input"))
        picture_at(&source, source.bounds.x1, source.bounds.y1)[-1] = 1;
    if (misdeed("set param in render") && ofx.param->paramSetValue(kept_param, 0.5) == kOfxStatOK)
        status = kOfxStatErrMemory; /* the host should have refused */
    if (misdeed("set param in a thread of render"))
        ofx.thread->multiThread(set_in_thread, 2, effect);
    if (misdeed("edit in render"))
        ofx.param->paramEditBegin(params_of(effect), "edit");
    if (misdeed("secret in render")) {
        OfxPropertySetHandle p = NULL;
        ofx.param->paramGetPropertySet(kept_param, &p);
        ofx.prop->propSetInt(p, kOfxParamPropSecret, 0, 1);
    }
    if (misdeed("write into arguments"))
        ofx.prop->propSetDouble(in, kOfxPropTime, 0, 7);
    if (misdeed("write into image properties"))
        ofx.prop->propSetInt(output.handle, kOfxImagePropRowBytes, 0, 7);
    if (misdeed("nested threads")) {
        OfxStatus inner = kOfxStatOK;
        ofx.thread->multiThread(nested, 1, &inner);
        if (inner != kOfxStatErrExists)
            status = kOfxStatErrMemory;
    }
    if (misdeed("output at another time")) {
        picture again;
        if (picture_get(output_clip, time + 1, NULL, &again) == kOfxStatOK)
            ofx.effect->clipReleaseImage(again.handle);
    }
    if (misdeed("goto time in render"))
        ofx.timeline->gotoTime(effect, 3);
    kept_image = output.handle;
    kept_arguments = in;
    if (got == kOfxStatOK && !misdeed("leak input"))
        ofx.effect->clipReleaseImage(source.handle);
    if (!misdeed("leak output"))
        ofx.effect->clipReleaseImage(output.handle);
    if (misdeed("double release"))
        ofx.effect->clipReleaseImage(output.handle);
    if (misdeed("stale image"))
        ofx.prop->propGetDouble(output.handle, kOfxImagePropPixelAspectRatio, 0, &number);
    if (misdeed("release of a parameter's set")) {
        OfxPropertySetHandle p = NULL;
        ofx.param->paramGetPropertySet(kept_param, &p);
        ofx.effect->clipReleaseImage(p);
    }
    if (misdeed("illegal status"))
        return kOfxStatReplyDefault;
    if (misdeed("nonsense status"))
        return 4711;
    return status;
}

static OfxStatus preferences(OfxPropertySetHandle out)
{
    if (misdeed("components changed"))
        ofx.prop->propSetString(out, "OfxImageClipPropComponents_Source", 0,
                                kOfxImageComponentAlpha);
    if (misdeed("depth changed"))
        ofx.prop->propSetString(out, "OfxImageClipPropDepth_Source", 0, kOfxBitDepthByte);
    if (misdeed("aspect changed"))
        ofx.prop->propSetDouble(out, "OfxImageClipPropPAR_Output", 0, 2);
    if (misdeed("rate changed"))
        ofx.prop->propSetDouble(out, kOfxImageEffectPropFrameRate, 0, 12);
    if (misdeed("fields changed"))
        ofx.prop->propSetString(out, kOfxImageClipPropFieldOrder, 0, kOfxImageFieldLower);
    if (misdeed("no such alpha"))
        ofx.prop->propSetString(out, kOfxImageEffectPropPreMultiplication, 0, "OfxSomehow");
    if (misdeed("clip that is not there"))
        ofx.prop->propSetString(out, "OfxImageClipPropComponents_Nobody", 0,
                                kOfxImageComponentRGBA);
    return kOfxStatOK;
}

static OfxStatus region(OfxImageEffectHandle effect, OfxPropertySetHandle out)
{
    picture p;
    if (misdeed("region of NaN"))
        ofx.prop->propSetDouble(out, kOfxImageEffectPropRegionOfDefinition, 0, (double)NAN);
    if (misdeed("region upside down"))
        ofx.prop->propSetDouble(out, kOfxImageEffectPropRegionOfDefinition, 0, 1e6);
    if (misdeed("image in region"))
        (void)picture_get(clip_of(effect, kOfxImageEffectSimpleSourceClipName), 0, NULL, &p);
    return kOfxStatOK;
}

static OfxStatus main_entry(const char *action, const void *handle, OfxPropertySetHandle in,
                            OfxPropertySetHandle out)
{
    OfxImageEffectHandle effect = (OfxImageEffectHandle)(uintptr_t)handle;
    if (strcmp(action, kOfxActionLoad) == 0) {
        if (!ofx_load())
            return kOfxStatErrMissingHostFeature;
        return misdeed("illegal load status") ? kOfxStatErrBadIndex : kOfxStatOK;
    }
    if (strcmp(action, kOfxActionDescribe) == 0)
        return describe(effect);
    if (strcmp(action, kOfxImageEffectActionDescribeInContext) == 0)
        return describe_in_context(effect);
    if (strcmp(action, kOfxActionCreateInstance) == 0)
        return create(effect);
    if (strcmp(action, kOfxActionInstanceChanged) == 0)
        return changed(effect);
    if (strcmp(action, kOfxImageEffectActionGetClipPreferences) == 0)
        return preferences(out);
    if (strcmp(action, kOfxImageEffectActionGetRegionOfDefinition) == 0)
        return region(effect, out);
    if (strcmp(action, kOfxImageEffectActionGetRegionsOfInterest) == 0 &&
        misdeed("interest of NaN"))
        return ofx.prop->propSetDouble(out, "OfxImageClipPropRoI_Source", 2, (double)NAN);
    if (strcmp(action, kOfxImageEffectActionGetTimeDomain) == 0 &&
        misdeed("time domain upside down")) {
        ofx.prop->propSetDouble(out, kOfxImageEffectPropFrameRange, 0, 5);
        return ofx.prop->propSetDouble(out, kOfxImageEffectPropFrameRange, 1, 1);
    }
    if (strcmp(action, kOfxImageEffectActionGetFramesNeeded) == 0 && misdeed("frames of NaN"))
        return ofx.prop->propSetDouble(out, "OfxImageClipPropFrameRange_Source", 0, (double)NAN);
    if (strcmp(action, kOfxImageEffectActionGetFramesNeeded) == 0 && misdeed("frames not in pairs"))
        return ofx.prop->propSetDouble(out, "OfxImageClipPropFrameRange_Source", 2, 7);
    if (strcmp(action, kOfxImageEffectActionIsIdentity) == 0 && misdeed("identity with nobody"))
        return ofx.prop->propSetString(out, kOfxPropName, 0, "Nobody");
    if (strcmp(action, kOfxImageEffectActionRender) == 0)
        return render(effect, in);
    if (strcmp(action, kOfxImageEffectActionEndSequenceRender) == 0 &&
        misdeed("image kept for later"))
        ofx.effect->clipReleaseImage(kept_image);
    if (strcmp(action, kOfxActionUnload) == 0 && misdeed("parameter after its life")) {
        double value = 0;
        ofx.param->paramGetValue(kept_param, &value);
    }
    if (strcmp(action, kOfxActionDestroyInstance) == 0)
        return kOfxStatErrBadIndex; /* ignored by the standard: no breach */
    return kOfxStatReplyDefault;
}

static void set_host(OfxHost *host)
{
    ofx.host = host;
}

static OfxPlugin plugin = {
    .pluginApi = kOfxImageEffectPluginApi,
    .apiVersion = kOfxImageEffectPluginApiVersion,
    .pluginIdentifier = "org.wideopen.test.Bad",
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
