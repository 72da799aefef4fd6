/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WIDEOPEN_STATUS_H
#define WIDEOPEN_STATUS_H

#include "wideopen/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Every status: name, short text. The enum and the texts come from this one list. */
#define WO_STATUS_LIST(X)                                                                          \
    X(WO_OK, "ok")                                                                                 \
    X(WO_ERR_ARGUMENT, "bad argument")                                                             \
    X(WO_ERR_RANGE, "value out of range")                                                          \
    X(WO_ERR_NOMEM, "out of memory")                                                               \
    X(WO_ERR_FORMAT, "unsupported or damaged data")                                                \
    X(WO_ERR_IO, "input or output failed")                                                         \
    X(WO_ERR_NOT_FOUND, "not found")                                                               \
    X(WO_ERR_UNSUPPORTED, "not supported")                                                         \
    X(WO_ERR_LIBRARY, "a library failed")                                                          \
    X(WO_ERR_INTERNAL, "internal fault")                                                           \
    X(WO_ABORTED, "aborted")

typedef enum wo_status {
#define WO_STATUS_ENUM(name, text) name,
    WO_STATUS_LIST(WO_STATUS_ENUM)
#undef WO_STATUS_ENUM
        WO_STATUS_COUNT
} wo_status;

/* What went wrong, in words: what was given, what is allowed, what to do. Owned by the caller,
   one per thread of work; a NULL pointer is legal wherever one is taken. */
typedef struct wo_error {
    wo_status status;
    char text[256];
} wo_error;

/* Short text of a status; never NULL, also for numbers outside the list. Any thread. */
const char *wo_status_text(wo_status status);

/* Writes status and text into *error (if not NULL) and returns status. Text beyond the buffer is
   cut. Any thread. */
wo_status wo_fail(wo_error *error, wo_status status, const char *format, ...) WO_PRINTF(3, 4);

/* Passes a failure up untouched. */
#define WO_TRY(call)                                                                               \
    do {                                                                                           \
        const wo_status wo_try_status = (call);                                                    \
        if (wo_try_status != WO_OK)                                                                \
            return wo_try_status;                                                                  \
    } while (0)

#ifdef __cplusplus
}
#endif
#endif
