/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_PLUGINS_OFX_GEOMETRY_H
#define WO_PLUGINS_OFX_GEOMETRY_H

#include "ofx_instance.h"

/* From canonical coordinates (square pixels, full size) to pixels and back:

       X = x * scale[0] / aspect,  Y = y * scale[1]

   Some hosts name the regions of clips, and the project's size, in pixels at the scale of the
   render instead. Who believes them at half scale fills a quarter of the picture. Where images of
   Source lie tells them from others: then X = x, Y = y.
*/

/* Fills time, scale, aspect, region and geometry of the action; does not fail, whatever the host
 * says. */
void wo_ofx_read_geometry(wo_ofx_action *action);

/* Smallest rectangle of pixels that holds a canonical one; sides without end stop at the frame and
   at Source's pixels. */
wo_rect wo_ofx_to_pixels(const wo_ofx_action *action, OfxRectD region);

/* Takes over how the host has rounded Source's region to pixels, if this image, the output, says
 * so. */
void wo_ofx_adopt_extent(wo_ofx_action *action, OfxPropertySetHandle image);

/* The same by an image of Source with these bounds, where it has pixels that by the host's regions
   cannot be there: true if that is because those are in pixels. extent and format are then what
   they say. */
bool wo_ofx_adopt_pixels(wo_ofx_action *action, OfxPropertySetHandle image, wo_rect bounds);

/* The same, and where the region of Source is plainly wrong, it reaches as far as its image. */
void wo_ofx_adopt_source(wo_ofx_action *action, OfxPropertySetHandle image, wo_rect bounds);

/* Where a clip has pixels, cut likewise; false if the host does not say. */
bool wo_ofx_clip_extent(const wo_ofx_action *action, size_t clip, wo_rect *extent);

/* The part of all, which is not empty, that somebody sees who looks at needed and takes the nearest
   pixel wherever there is none: the common part, or the edge of all that is nearest. Empty if
   needed is. */
wo_rect wo_ofx_visible(wo_rect needed, wo_rect all);

OfxRectD wo_ofx_to_canonical(const wo_ofx_action *action, wo_rect pixels);

#endif
