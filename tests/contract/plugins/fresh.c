/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* A plugin whose struct is made by OfxGetPlugin and freed by Unload, as many libraries do: who
   calls it again must have asked for it again. It paints grey, or refuses to with the message that
   the environment variable WO_TEST_REFUSES holds. */

#include "host_plugin.h"

#include <fenv.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static OfxPlugin *made;

static OfxStatus describe(OfxImageEffectHandle effect)
{
    OfxPropertySetHandle p = props_of(effect);
    ofx.prop->propSetString(p, kOfxPropLabel, 0, "Fresh");
    ofx.prop->propSetString(p, kOfxImageEffectPropSupportedPixelDepths, 0, kOfxBitDepthFloat);
    return ofx.prop->propSetString(p, kOfxImageEffectPropSupportedContexts, 0,
                                   kOfxImageEffectContextGenerator);
}

static OfxStatus render(OfxImageEffectHandle effect, OfxPropertySetHandle in)
{
    double time = 0;
    OfxRectI window = {0};
    picture output;
    const char *refuses = getenv("WO_TEST_REFUSES");
    if (refuses) {
        ofx.message->setPersistentMessage(effect, kOfxMessageError, "", "%s", refuses);
        return kOfxStatFailed;
    }
    ofx.prop->propGetDouble(in, kOfxPropTime, 0, &time);
    ofx.prop->propGetIntN(in, kOfxImageEffectPropRenderWindow, 4, &window.x1);
    if (picture_get(clip_of(effect, kOfxImageEffectOutputClipName), time, NULL, &output) !=
        kOfxStatOK)
        return kOfxStatFailed;
    for (int y = window.y1; y < window.y2; y++)
        for (int x = window.x1; x < window.x2; x++)
            for (int c = 0; c < output.components; c++)
                picture_at(&output, x, y)[c] = 0.5f;
    return ofx.effect->clipReleaseImage(output.handle);
}

static void stray(void)
{
    if (chdir("/") != 0)
        abort();
    umask(0777);
    fesetround(FE_UPWARD);
}

static OfxStatus main_entry(const char *action, const void *handle, OfxPropertySetHandle in,
                            OfxPropertySetHandle out)
{
    OfxImageEffectHandle effect = (OfxImageEffectHandle)(uintptr_t)handle;
    (void)out;
    if (!made)
        abort();
    if (getenv("WO_TEST_STRAYS"))
        stray();
    if (strcmp(action, kOfxActionLoad) == 0)
        return ofx_load() ? kOfxStatOK : kOfxStatFailed;
    if (strcmp(action, kOfxActionUnload) == 0) {
        *made = (OfxPlugin){0};
        free(made);
        made = NULL;
        return kOfxStatOK;
    }
    if (strcmp(action, kOfxActionDescribe) == 0)
        return describe(effect);
    if (strcmp(action, kOfxImageEffectActionDescribeInContext) == 0) {
        OfxPropertySetHandle p = define_clip(effect, kOfxImageEffectOutputClipName, false);
        return ofx.prop->propSetString(p, kOfxImageEffectPropSupportedComponents, 0,
                                       kOfxImageComponentRGBA);
    }
    if (strcmp(action, kOfxImageEffectActionRender) == 0)
        return render(effect, in);
    return kOfxStatReplyDefault;
}

static void set_host(OfxHost *host)
{
    ofx.host = host;
}

OfxExport int OfxGetNumberOfPlugins(void)
{
    return 1;
}

OfxExport OfxPlugin *OfxGetPlugin(int nth)
{
    if (nth != 0)
        return NULL;
    if (!made)
        made = malloc(sizeof *made);
    if (made)
        *made = (OfxPlugin){
            .pluginApi = kOfxImageEffectPluginApi,
            .apiVersion = kOfxImageEffectPluginApiVersion,
            .pluginIdentifier = "org.wideopen.test.Fresh",
            .pluginVersionMajor = 1,
            .setHost = set_host,
            .mainEntry = main_entry,
        };
    return made;
}
