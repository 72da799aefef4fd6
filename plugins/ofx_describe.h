/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_PLUGINS_OFX_DESCRIBE_H
#define WO_PLUGINS_OFX_DESCRIBE_H

#include "ofx_plugin.h"

/* Actions Describe and DescribeInContext: the tables of the effect become labels, clips and
   parameters of the host. Every number parameter gets both its ranges, for hosts that insist on
   them. */
OfxStatus wo_ofx_describe(const wo_ofx_plugin *plugin, OfxImageEffectHandle handle);
OfxStatus wo_ofx_describe_in_context(const wo_ofx_plugin *plugin, OfxImageEffectHandle handle,
                                     OfxPropertySetHandle in);

/* OpenFX names of the components or-ed in WO_COMPONENT_*, best first; how many. */
int wo_ofx_components(uint32_t components, const char *names[3]);

#endif
