/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_PLUGINS_OFX_IMAGES_H
#define WO_PLUGINS_OFX_IMAGES_H

#include "ofx_instance.h"
#include "ofx_pixels.h"

/* One image of a host during a render action. Zeroed, it is closed. */
typedef struct wo_ofx_image {
    OfxPropertySetHandle handle;
    wo_pixels pixels; /* as the host stores them; data = NULL: there is no image */
    wo_image view;    /* as the core takes them; data = NULL: there is no image */
    float *own;       /* memory of the view where it is not the host's */
    wo_alpha alpha;
} wo_ofx_image;

/* Opens what is there of an input clip inside needed. No image is no failure; one whose own
   properties make no sense is. The view is the host's memory where that holds floats the core can
   take, which must not be written to; else a converted copy. Beyond the clip's own region colour
   and masks are zero as far as Source reaches; Source itself and data are left to the core, which
   repeats their edges. Close after any outcome. */
WO_NODISCARD wo_status wo_ofx_open_input(wo_ofx_action *action, size_t clip, wo_rect needed,
                                         wo_ofx_image *image);

/* Looks at Source's image for where it has pixels, when the host's words on that cannot be right.
 */
WO_NODISCARD wo_status wo_ofx_look_at_source(wo_ofx_action *action);

/* Opens the output for a window and cuts the window to what the host gave. The view is the host's
   memory, or own memory that wo_ofx_finish_output brings into the host's form. Close after any
   outcome. */
WO_NODISCARD wo_status wo_ofx_open_output(wo_ofx_action *action, wo_rect *window,
                                          wo_ofx_image *image);

void wo_ofx_finish_output(const wo_ofx_image *image);

/* Fills the output's view with transparent black. */
void wo_ofx_clear_output(const wo_ofx_image *image);

/* Releases handle and memory; takes closed images. */
void wo_ofx_close(wo_ofx_action *action, wo_ofx_image *image);

#endif
