/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/*
 * Property suite: the only way to read or write a property set.
 *
 * A property has a name, one storage type (pointer, string, double or int) and a dimension. Setting
 * the index that equals the dimension of a property of free dimension makes it one longer. Answers
 * besides kOfxStatOK: kOfxStatErrBadHandle, kOfxStatErrUnknown (no such property),
 * kOfxStatErrBadIndex, kOfxStatErrValue (wrong type or illegal value).
 */

#ifndef WO_OFX_PROPERTY_H
#define WO_OFX_PROPERTY_H

#include "ofxCore.h"

#ifdef __cplusplus
extern "C" {
#endif

#define kOfxPropertySuite "OfxPropertySuite"

/* Version 1. Indices count from 0; the N functions move the first `count` values. Strings given are
 * copied by the host. Strings got belong to the host and live until the property is changed or the
 * set goes away. */
typedef struct OfxPropertySuiteV1 {
    OfxStatus (*propSetPointer)(OfxPropertySetHandle properties, const char *property, int index,
                                void *value);
    OfxStatus (*propSetString)(OfxPropertySetHandle properties, const char *property, int index,
                               const char *value);
    OfxStatus (*propSetDouble)(OfxPropertySetHandle properties, const char *property, int index,
                               double value);
    OfxStatus (*propSetInt)(OfxPropertySetHandle properties, const char *property, int index,
                            int value);

    OfxStatus (*propSetPointerN)(OfxPropertySetHandle properties, const char *property, int count,
                                 void *const *value);
    OfxStatus (*propSetStringN)(OfxPropertySetHandle properties, const char *property, int count,
                                const char *const *value);
    OfxStatus (*propSetDoubleN)(OfxPropertySetHandle properties, const char *property, int count,
                                const double *value);
    OfxStatus (*propSetIntN)(OfxPropertySetHandle properties, const char *property, int count,
                             const int *value);

    OfxStatus (*propGetPointer)(OfxPropertySetHandle properties, const char *property, int index,
                                void **value);
    OfxStatus (*propGetString)(OfxPropertySetHandle properties, const char *property, int index,
                               char **value);
    OfxStatus (*propGetDouble)(OfxPropertySetHandle properties, const char *property, int index,
                               double *value);
    OfxStatus (*propGetInt)(OfxPropertySetHandle properties, const char *property, int index,
                            int *value);

    OfxStatus (*propGetPointerN)(OfxPropertySetHandle properties, const char *property, int count,
                                 void **value);
    OfxStatus (*propGetStringN)(OfxPropertySetHandle properties, const char *property, int count,
                                char **value);
    OfxStatus (*propGetDoubleN)(OfxPropertySetHandle properties, const char *property, int count,
                                double *value);
    OfxStatus (*propGetIntN)(OfxPropertySetHandle properties, const char *property, int count,
                             int *value);

    /* Back to the default value and dimension. */
    OfxStatus (*propReset)(OfxPropertySetHandle properties, const char *property);
    OfxStatus (*propGetDimension)(OfxPropertySetHandle properties, const char *property,
                                  int *count);
} OfxPropertySuiteV1;

#ifdef __cplusplus
}
#endif

#endif
