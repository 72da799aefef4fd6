/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* A binary with plugins no host can use, one of each kind, and one it can. */

#include "host_plugin.h"

#include <stdint.h>
#include <string.h>

static OfxStatus main_entry(const char *action, const void *handle, OfxPropertySetHandle in,
                            OfxPropertySetHandle out)
{
    OfxImageEffectHandle effect = (OfxImageEffectHandle)(uintptr_t)handle;
    OfxPropertySetHandle p;
    (void)in;
    (void)out;
    if (strcmp(action, kOfxActionLoad) == 0)
        return ofx_load() ? kOfxStatOK : kOfxStatFailed;
    if (strcmp(action, kOfxActionDescribe) == 0) {
        p = props_of(effect);
        ofx.prop->propSetString(p, kOfxPropLabel, 0, "Byte");
        ofx.prop->propSetString(p, kOfxImageEffectPropSupportedPixelDepths, 0, kOfxBitDepthByte);
        return ofx.prop->propSetString(p, kOfxImageEffectPropSupportedContexts, 0,
                                       kOfxImageEffectContextGenerator);
    }
    if (strcmp(action, kOfxImageEffectActionDescribeInContext) == 0) {
        p = define_clip(effect, kOfxImageEffectOutputClipName, false);
        return ofx.prop->propSetString(p, kOfxImageEffectPropSupportedComponents, 0,
                                       kOfxImageComponentRGBA);
    }
    return kOfxStatReplyDefault;
}

static OfxStatus refuse(const char *action, const void *handle, OfxPropertySetHandle in,
                        OfxPropertySetHandle out)
{
    (void)action;
    (void)handle;
    (void)in;
    (void)out;
    return kOfxStatFailed;
}

static OfxStatus paint_only(const char *action, const void *handle, OfxPropertySetHandle in,
                            OfxPropertySetHandle out)
{
    if (strcmp(action, kOfxActionDescribe) != 0)
        return main_entry(action, handle, in, out);
    OfxPropertySetHandle p = props_of((OfxImageEffectHandle)(uintptr_t)handle);
    ofx.prop->propSetString(p, kOfxPropLabel, 0, "Paint");
    ofx.prop->propSetString(p, kOfxImageEffectPropSupportedPixelDepths, 0, kOfxBitDepthFloat);
    return ofx.prop->propSetString(p, kOfxImageEffectPropSupportedContexts, 0,
                                   kOfxImageEffectContextPaint);
}

static void set_host(OfxHost *host)
{
    ofx.host = host;
}

#define API kOfxImageEffectPluginApi

static OfxPlugin plugins[] = {
    {"OfxSoundPluginAPI", 1, "org.wideopen.test.Sound", 1, 0, set_host, main_entry},
    {API, 9, "org.wideopen.test.Future", 1, 0, set_host, main_entry},
    {API, 1, NULL, 1, 0, set_host, main_entry},
    {API, 1, "", 1, 0, set_host, main_entry},
    {API, 1, "org.wideopen.test.NoHost", 1, 0, NULL, main_entry},
    {API, 1, "org.wideopen.test.NoMain", 1, 0, set_host, NULL},
    {NULL, 1, "org.wideopen.test.NoApi", 1, 0, set_host, main_entry},
    {API, 1, "org.wideopen.test.Refuses", 1, 0, set_host, refuse},
    {API, 1, "org.wideopen.test.Paint", 1, 0, set_host, paint_only},
    {API, 1, "org.wideopen.test.Byte", 2, 1, set_host, main_entry},
    {API, 1, "org.wideopen.test.Byte", 2, 0, set_host, main_entry}, /* an older one of the same */
    {API, 1, "org.other.Byte", 1, 0, set_host, main_entry},
};

#define COUNT (int)(sizeof plugins / sizeof plugins[0])

OfxExport int OfxGetNumberOfPlugins(void)
{
    return COUNT + 1; /* the last one is NULL */
}

OfxExport OfxPlugin *OfxGetPlugin(int nth)
{
    return nth >= 0 && nth < COUNT ? &plugins[nth] : NULL;
}
