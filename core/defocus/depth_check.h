/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_DEFOCUS_DEPTH_CHECK_H
#define WO_CORE_DEFOCUS_DEPTH_CHECK_H

#include "defocus/sheet.h"
#include "wideopen/report.h"

/* Looks at the depth of a layer in window, where the layer shows something, and warns when it
   cannot be what it is read as: camera space, another unit, 0..1 or whole numbers as metres, a
   picture that ends early. Only what numbers alone can tell is told: sane depth gets no warning,
   and much that is wrong (centimetres as metres, ray distance as distance, 1/z as distance) looks
   sane. Of a part of a picture nothing can be said: window must be all of it. name is that of the
   clip; may_be_sky: a layer of sky alone is all zero, or farther than any scene. */
WO_NODISCARD wo_status wo_depth_check(const wo_context *context, const wo_sheet_source *source,
                                      wo_rect window, const char *name, bool may_be_sky,
                                      wo_report *report, wo_error *error);

#endif
