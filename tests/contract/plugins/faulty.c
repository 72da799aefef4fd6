/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* A binary of three plugins, First, FAULT and Last, of which the one in the middle does what no
   host wants to live through; some do it while the binary is loaded. FAULT is the word
   WO_TEST_FAULT. */

#include "host_plugin.h"

#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define PREFIX "org.wideopen.test." WO_TEST_FAULT "."

static bool fault(const char *name)
{
    return strcmp(WO_TEST_FAULT, name) == 0;
}

static void hang(void)
{
    for (;;)
        pause();
}

static void *forever(void *nothing)
{
    hang();
    return nothing;
}

static void shout(void)
{
    static char line[65536];
    memset(line, 'x', sizeof line - 1);
    line[sizeof line - 2] = '\n';
    for (int i = 0; i < 160; i++) {
        fputs(line, i % 2 ? stdout : stderr);
        fflush(stdout);
    }
}

__attribute__((constructor)) static void loading(void)
{
    if (fault("LoadCrash")) {
        fputs("the licence\x1b[31m is\nmissing\n", stderr);
        abort();
    }
    if (fault("LoadExit"))
        exit(0);
    if (fault("LoadHang"))
        hang();
    if (fault("LoadShout"))
        shout();
}

static OfxStatus describe(OfxImageEffectHandle effect, bool faulty)
{
    pthread_t thread;
    OfxPropertySetHandle p = props_of(effect);
    if (faulty && fault("DescribeCrash"))
        abort();
    if (faulty && fault("DescribeExit"))
        _exit(3);
    if (faulty && fault("DescribeHang"))
        hang();
    if (faulty && fault("DescribeThread"))
        (void)pthread_create(&thread, NULL, forever, NULL);
    if (faulty && fault("DescribeWrong")) {
        ofx.prop->propSetInt(p, "OfxImageEffectPropNoSuchThing", 0, 1);
        ofx.prop->propSetDouble(p, kOfxPropLabel, 0, 1);
    }
    ofx.prop->propSetString(p, kOfxPropLabel, 0,
                            faulty ? "A label that is longer\tthan\nany column" : "Harmless");
    ofx.prop->propSetString(p, kOfxImageEffectPropSupportedPixelDepths, 0, kOfxBitDepthFloat);
    if (fault("DescribeMerge")) {
        ofx.prop->propSetString(p, kOfxImageEffectPropSupportedContexts, 0,
                                kOfxImageEffectContextFilter);
        return faulty ? ofx.prop->propSetString(p, kOfxImageEffectPropSupportedContexts, 1,
                                                kOfxImageEffectContextGeneral)
                      : kOfxStatOK;
    }
    return ofx.prop->propSetString(p, kOfxImageEffectPropSupportedContexts, 0,
                                   kOfxImageEffectContextGenerator);
}

static OfxStatus act(const char *action, const void *handle, bool faulty)
{
    OfxImageEffectHandle effect = (OfxImageEffectHandle)(uintptr_t)handle;
    if (strcmp(action, kOfxActionLoad) == 0)
        return ofx_load() ? kOfxStatOK : kOfxStatFailed;
    if (strcmp(action, kOfxActionUnload) == 0) {
        if (faulty && fault("UnloadCrash"))
            abort();
        if (faulty && fault("UnloadHang"))
            hang();
        return kOfxStatOK;
    }
    if (strcmp(action, kOfxActionDescribe) == 0)
        return describe(effect, faulty);
    if (strcmp(action, kOfxImageEffectActionDescribeInContext) == 0) {
        OfxPropertySetHandle p;
        if (fault("DescribeMerge")) {
            p = define_clip(effect, "A", false);
            ofx.prop->propSetString(p, kOfxImageEffectPropSupportedComponents, 0,
                                    kOfxImageComponentRGBA);
        }
        p = define_clip(effect, kOfxImageEffectOutputClipName, false);
        return ofx.prop->propSetString(p, kOfxImageEffectPropSupportedComponents, 0,
                                       kOfxImageComponentRGBA);
    }
    return kOfxStatReplyDefault;
}

static OfxStatus harmless(const char *action, const void *handle, OfxPropertySetHandle in,
                          OfxPropertySetHandle out)
{
    (void)in;
    (void)out;
    return act(action, handle, false);
}

static OfxStatus faulty(const char *action, const void *handle, OfxPropertySetHandle in,
                        OfxPropertySetHandle out)
{
    (void)in;
    (void)out;
    return act(action, handle, true);
}

static void set_host(OfxHost *host)
{
    ofx.host = host;
}

#define PLUGIN(name, entry)                                                                        \
    {                                                                                              \
        .pluginApi = kOfxImageEffectPluginApi, .apiVersion = kOfxImageEffectPluginApiVersion,      \
        .pluginIdentifier = PREFIX name, .pluginVersionMajor = 1, .setHost = set_host,             \
        .mainEntry = entry                                                                         \
    }

static OfxPlugin plugins[] = {
    PLUGIN("First", harmless),
    PLUGIN("Middle", faulty),
    PLUGIN("Last", harmless),
};

OfxExport int OfxGetNumberOfPlugins(void)
{
    if (fault("CountMany"))
        return 2000000000;
    if (fault("CountNegative"))
        return -3;
    return 3;
}

OfxExport OfxPlugin *OfxGetPlugin(int nth)
{
    if (nth == 1 && fault("GetCrash"))
        abort();
    if (nth == 1 && fault("GetNull"))
        return NULL;
    return nth >= 0 && nth < 3 ? &plugins[nth] : NULL;
}
