/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_suites.h"

#include <string.h>

static bool complete(const wo_ofx_suites *s)
{
    return s->property && s->property->propSetPointer && s->property->propSetString &&
           s->property->propSetDouble && s->property->propSetInt && s->property->propGetPointer &&
           s->property->propGetString && s->property->propGetDouble && s->property->propGetInt &&
           s->effect && s->effect->getPropertySet && s->effect->getParamSet &&
           s->effect->clipDefine && s->effect->clipGetHandle && s->effect->clipGetImage &&
           s->effect->clipReleaseImage && s->effect->clipGetRegionOfDefinition && s->param &&
           s->param->paramDefine && s->param->paramGetHandle &&
           (s->param->paramGetValueAtTime || s->param->paramGetValue);
}

OfxStatus wo_ofx_fetch_suites(const OfxHost *host, wo_ofx_suites *suites)
{
    *suites = (wo_ofx_suites){0};
    if (!host || !host->fetchSuite)
        return kOfxStatErrMissingHostFeature;
    const OfxPropertySetHandle h = host->host;
    suites->host = h;
    suites->property = host->fetchSuite(h, kOfxPropertySuite, 1);
    suites->effect = host->fetchSuite(h, kOfxImageEffectSuite, 1);
    suites->param = host->fetchSuite(h, kOfxParameterSuite, 1);
    if (!complete(suites)) {
        *suites = (wo_ofx_suites){0};
        return kOfxStatErrMissingHostFeature;
    }
    suites->memory = host->fetchSuite(h, kOfxMemorySuite, 1);
    suites->thread = host->fetchSuite(h, kOfxMultiThreadSuite, 1);
    suites->message = host->fetchSuite(h, kOfxMessageSuite, 1);
    suites->message2 = host->fetchSuite(h, kOfxMessageSuite, 2);
    suites->progress = host->fetchSuite(h, kOfxProgressSuite, 1);
    suites->progress2 = host->fetchSuite(h, kOfxProgressSuite, 2);
    suites->interact = host->fetchSuite(h, kOfxInteractSuite, 1);
    suites->draw = host->fetchSuite(h, kOfxDrawSuite, 1);
    suites->report = host->fetchSuite(h, kWideOpenReportSuite, 1);
    return kOfxStatOK;
}

OfxStatus wo_ofx_status(wo_status status)
{
    switch (status) {
    case WO_OK:
    case WO_ABORTED: /* the host asked for it and will not look at the pixels */
        return kOfxStatOK;
    case WO_ERR_NOMEM:
        return kOfxStatErrMemory;
    case WO_ERR_FORMAT:
        return kOfxStatErrImageFormat;
    case WO_ERR_ARGUMENT:
    case WO_ERR_RANGE:
    case WO_ERR_IO:
    case WO_ERR_NOT_FOUND:
    case WO_ERR_UNSUPPORTED:
    case WO_ERR_LIBRARY:
    case WO_ERR_INTERNAL:
    case WO_STATUS_COUNT:
        break;
    }
    return kOfxStatFailed;
}

int wo_ofx_get_int(const wo_ofx_suites *suites, OfxPropertySetHandle set, const char *name,
                   int fallback)
{
    int value = fallback;
    wo_ofx_read_ints(suites, set, name, 1, &value);
    return value;
}

double wo_ofx_get_double(const wo_ofx_suites *suites, OfxPropertySetHandle set, const char *name,
                         double fallback)
{
    double value = fallback;
    wo_ofx_read_doubles(suites, set, name, 1, &value);
    return value;
}

const char *wo_ofx_get_string(const wo_ofx_suites *suites, OfxPropertySetHandle set,
                              const char *name)
{
    char *value = NULL;
    if (!set || suites->property->propGetString(set, name, 0, &value) != kOfxStatOK)
        return NULL;
    return value;
}

void *wo_ofx_get_pointer(const wo_ofx_suites *suites, OfxPropertySetHandle set, const char *name)
{
    void *value = NULL;
    if (!set || suites->property->propGetPointer(set, name, 0, &value) != kOfxStatOK)
        return NULL;
    return value;
}

bool wo_ofx_read_ints(const wo_ofx_suites *suites, OfxPropertySetHandle set, const char *name,
                      int count, int *values)
{
    int read[4] = {0};
    if (!set || count > (int)WO_COUNT(read))
        return false;
    for (int i = 0; i < count; i++)
        if (suites->property->propGetInt(set, name, i, &read[i]) != kOfxStatOK)
            return false;
    memcpy(values, read, (size_t)count * sizeof *values);
    return true;
}

bool wo_ofx_read_doubles(const wo_ofx_suites *suites, OfxPropertySetHandle set, const char *name,
                         int count, double *values)
{
    double read[4] = {0};
    if (!set || count > (int)WO_COUNT(read))
        return false;
    for (int i = 0; i < count; i++)
        if (suites->property->propGetDouble(set, name, i, &read[i]) != kOfxStatOK)
            return false;
    memcpy(values, read, (size_t)count * sizeof *values);
    return true;
}

bool wo_ofx_has_string(const wo_ofx_suites *suites, OfxPropertySetHandle set, const char *name,
                       const char *value)
{
    int count = 0;
    if (!set || !suites->property->propGetDimension ||
        suites->property->propGetDimension(set, name, &count) != kOfxStatOK)
        return false;
    for (int i = 0; i < count; i++) {
        char *text = NULL;
        if (suites->property->propGetString(set, name, i, &text) == kOfxStatOK && text &&
            strcmp(text, value) == 0)
            return true;
    }
    return false;
}

OfxStatus wo_ofx_set_int(const wo_ofx_suites *suites, OfxPropertySetHandle set, const char *name,
                         int index, int value)
{
    return suites->property->propSetInt(set, name, index, value);
}

OfxStatus wo_ofx_set_double(const wo_ofx_suites *suites, OfxPropertySetHandle set, const char *name,
                            int index, double value)
{
    return suites->property->propSetDouble(set, name, index, value);
}

OfxStatus wo_ofx_set_string(const wo_ofx_suites *suites, OfxPropertySetHandle set, const char *name,
                            int index, const char *value)
{
    return suites->property->propSetString(set, name, index, value);
}
