/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_plugin.h"

/* The three functions a host looks for in the binary; nothing else of it is visible. */

int OfxGetNumberOfPlugins(void)
{
    int count = 0;
    while (wo_ofx_plugins[count])
        count++;
    return count;
}

OfxPlugin *OfxGetPlugin(int nth)
{
    return nth >= 0 && nth < OfxGetNumberOfPlugins() ? &wo_ofx_plugins[nth]->ofx : NULL;
}

/* This host is only promised until OfxGetPlugin; each plugin is told its own by setHost. */
OfxStatus OfxSetHost(const OfxHost *host)
{
    return host && host->fetchSuite ? kOfxStatOK : kOfxStatFailed;
}
