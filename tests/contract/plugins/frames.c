/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Twice as fast: at each time Source's picture from twice as far behind its first frame, at most
   its last. Says what it is told about times. */

#include "host_plugin.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

static OfxStatus describe(OfxImageEffectHandle effect)
{
    OfxPropertySetHandle p = props_of(effect);
    ofx.prop->propSetString(p, kOfxPropLabel, 0, "Frames");
    ofx.prop->propSetString(p, kOfxImageEffectPropSupportedContexts, 0,
                            kOfxImageEffectContextFilter);
    ofx.prop->propSetString(p, kOfxImageEffectPropSupportedPixelDepths, 0, kOfxBitDepthFloat);
    ofx.prop->propSetInt(p, kOfxImageEffectPropTemporalClipAccess, 0, 1);
    return kOfxStatOK;
}

static OfxStatus describe_in_context(OfxImageEffectHandle effect)
{
    static const char *const clips[] = {kOfxImageEffectSimpleSourceClipName,
                                        kOfxImageEffectOutputClipName};
    static const char *const components[] = {kOfxImageComponentRGBA, kOfxImageComponentRGB};
    for (int i = 0; i < 2; i++) {
        OfxPropertySetHandle p = define_clip(effect, clips[i], false);
        ofx.prop->propSetStringN(p, kOfxImageEffectPropSupportedComponents, 2, components);
        ofx.prop->propSetInt(p, kOfxImageEffectPropTemporalClipAccess, 0, 1);
    }
    define_param(effect, kOfxParamTypeBoolean, "beyond");
    define_param(effect, kOfxParamTypeBoolean, "tell");
    return kOfxStatOK;
}

static bool is_set(OfxImageEffectHandle effect, const char *name)
{
    int value = 0;
    ofx.param->paramGetValue(param_of(effect, name), &value);
    return value != 0;
}

static void range_of(OfxImageEffectHandle effect, const char *clip, double range[2])
{
    OfxPropertySetHandle p = NULL;
    ofx.effect->clipGetPropertySet(clip_of(effect, clip), &p);
    ofx.prop->propGetDoubleN(p, kOfxImageEffectPropFrameRange, 2, range);
}

static double wanted(OfxImageEffectHandle effect, double time)
{
    double range[2] = {0, 0};
    range_of(effect, kOfxImageEffectSimpleSourceClipName, range);
    const double at = range[0] + 2 * (time - range[0]);
    if (is_set(effect, "beyond"))
        return range[1] + 1;
    return at < range[1] ? at : range[1];
}

static OfxStatus frames_needed(OfxImageEffectHandle effect, OfxPropertySetHandle in,
                               OfxPropertySetHandle out)
{
    double time = 0;
    ofx.prop->propGetDouble(in, kOfxPropTime, 0, &time);
    const double range[2] = {wanted(effect, time), wanted(effect, time)};
    return ofx.prop->propSetDoubleN(out, "OfxImageClipPropFrameRange_Source", 2, range);
}

static OfxStatus begin(OfxImageEffectHandle effect, OfxPropertySetHandle in)
{
    double source[2] = {0, 0}, output[2] = {0, 0}, line[2] = {0, 0}, now[2] = {0, 0};
    double rate = 0, duration = 0;
    OfxPropertySetHandle p = NULL;
    if (!is_set(effect, "tell"))
        return kOfxStatReplyDefault;
    range_of(effect, kOfxImageEffectSimpleSourceClipName, source);
    range_of(effect, kOfxImageEffectOutputClipName, output);
    ofx.timeline->getTimeBounds(effect, &line[0], &line[1]);
    ofx.effect->clipGetPropertySet(clip_of(effect, kOfxImageEffectSimpleSourceClipName), &p);
    ofx.prop->propGetDouble(p, kOfxImageEffectPropFrameRate, 0, &rate);
    ofx.prop->propGetDouble(props_of(effect), kOfxImageEffectInstancePropEffectDuration, 0,
                            &duration);
    ofx.prop->propGetDoubleN(in, kOfxImageEffectPropFrameRange, 2, now);
    ofx.message->message(effect, kOfxMessageLog, "",
                         "source %g-%g output %g-%g line %g-%g duration %g rate %g now %g-%g",
                         source[0], source[1], output[0], output[1], line[0], line[1], duration,
                         rate, now[0], now[1]);
    return kOfxStatOK;
}

static OfxStatus render(OfxImageEffectHandle effect, OfxPropertySetHandle in)
{
    OfxRectI w = {0, 0, 0, 0};
    picture source, output;
    double time = 0;
    ofx.prop->propGetDouble(in, kOfxPropTime, 0, &time);
    ofx.prop->propGetIntN(in, kOfxImageEffectPropRenderWindow, 4, &w.x1);
    if (picture_get(clip_of(effect, kOfxImageEffectOutputClipName), time, NULL, &output) !=
        kOfxStatOK)
        return kOfxStatFailed;
    const bool there = picture_get(clip_of(effect, kOfxImageEffectSimpleSourceClipName),
                                   wanted(effect, time), NULL, &source) == kOfxStatOK;
    for (int y = w.y1; y < w.y2; y++)
        for (int x = w.x1; x < w.x2; x++)
            for (int c = 0; c < output.components; c++) {
                const bool inside = there && x >= source.bounds.x1 && x < source.bounds.x2 &&
                                    y >= source.bounds.y1 && y < source.bounds.y2;
                picture_at(&output, x, y)[c] = inside ? picture_at(&source, x, y)[c] : 0;
            }
    if (there)
        ofx.effect->clipReleaseImage(source.handle);
    ofx.effect->clipReleaseImage(output.handle);
    return kOfxStatOK;
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
        return describe_in_context(effect);
    if (strcmp(action, kOfxImageEffectActionGetFramesNeeded) == 0)
        return frames_needed(effect, in, out);
    if (strcmp(action, kOfxImageEffectActionBeginSequenceRender) == 0)
        return begin(effect, in);
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
    .pluginIdentifier = "org.wideopen.test.Frames",
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
