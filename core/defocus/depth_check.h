/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_DEPTH_CHECK_H
#define WO_CORE_DEFOCUS_DEPTH_CHECK_H

#include "defocus/sheet.h"
#include "wideopen/report.h"

typedef struct wo_depth_clip {
    const char *name;
    bool may_be_sky; /* the layer may hold sky alone: all zero, or farther than any scene */
    bool part;       /* the window is not the whole picture; of a part less can be said */
} wo_depth_clip;

/* Looks at the depth of a layer in window, where the layer shows something, and warns when it
   cannot be what it is read as: camera space, another unit, 0..1 or whole numbers as metres, a
   picture that ends early. Only what numbers alone can tell is told: sane depth gets no warning,
   and much that is wrong (centimetres as metres, ray distance as distance, 1/z as distance) looks
   sane. */
WO_NODISCARD wo_status wo_depth_check(const wo_context *context, const wo_sheet_source *source,
                                      wo_rect window, const wo_depth_clip *clip, wo_report *report,
                                      wo_error *error);

#endif
