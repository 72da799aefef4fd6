/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TESTS_MOCK_INTERNAL_H
#define WO_TESTS_MOCK_INTERNAL_H

#include "mock_host.h"

/* mock_host.c: suites without objects. mock_objects.c: property sets, parameters, clips, actions.
 */

const void *mock_suite(const char *name, int version);
const void *mock_property_suite(void);
const void *mock_param_suite(void);
const void *mock_effect_suite(bool hollow);

OfxStatus mock_image_alloc(OfxImageEffectHandle effect, size_t bytes, OfxImageMemoryHandle *handle);
OfxStatus mock_image_free(OfxImageMemoryHandle handle);
OfxStatus mock_image_lock(OfxImageMemoryHandle handle, void **data);
OfxStatus mock_image_unlock(OfxImageMemoryHandle handle);
int mock_abort(OfxImageEffectHandle effect);

void mock_settle(void);

/* Property sets alive; forgets them if told so. */
int mock_allocations_of_sets(bool forget);

#endif
