/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/status.h"

#include <stdarg.h>
#include <stdio.h>

const char *wo_status_text(wo_status status)
{
    static const char *const texts[] = {
#define WO_STATUS_TEXT(name, text) text,
        WO_STATUS_LIST(WO_STATUS_TEXT)
#undef WO_STATUS_TEXT
    };
    _Static_assert(WO_COUNT(texts) == WO_STATUS_COUNT, "one text per status");

    const unsigned index = (unsigned)status;
    return index < WO_COUNT(texts) ? texts[index] : "unknown status";
}

wo_status wo_fail(wo_error *error, wo_status status, const char *format, ...)
{
    if (error) {
        va_list arguments;
        va_start(arguments, format);
        error->status = status;
        if (vsnprintf(error->text, sizeof error->text, format, arguments) < 0)
            snprintf(error->text, sizeof error->text, "%s", wo_status_text(status));
        va_end(arguments);
    }
    return status;
}
