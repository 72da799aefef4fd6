/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* A binary that does not want this host (since 1.5 it may say so), and lacks everything else. */

#include "ofxCore.h"

OfxStatus OfxSetHost(const OfxHost *host)
{
#ifdef WO_TEST_LACKS_PLUGIN
    (void)host;
    return kOfxStatOK;
#else
    return host ? kOfxStatFailed : kOfxStatOK;
#endif
}

OfxExport int OfxGetNumberOfPlugins(void)
{
    return 1;
}

#ifndef WO_TEST_LACKS_PLUGIN
OfxPlugin *OfxGetPlugin(int nth)
{
    (void)nth;
    return NULL;
}
#endif
