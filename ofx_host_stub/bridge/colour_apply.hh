/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_COLOUR_APPLY_HH
#define WO_BRIDGE_COLOUR_APPLY_HH

#include "wideopen/image.h"

#include <OpenColorIO/OpenColorIO.h>

/* How a processor meets alpha. Decoding comes from codes, encoding goes to them: it is there that
   colour is not to go beyond 1 because of alpha (colour.h). */
enum wo_apply_mode { WO_APPLY_PLAIN, WO_APPLY_DECODE, WO_APPLY_ENCODE };

/* Applies in place, row by row, so that padded and upside-down views work. Alpha stays. */
void wo_apply(const OCIO_NAMESPACE::ConstProcessorRcPtr &processor, wo_image *image,
              wo_apply_mode mode);

/* Is twice the light twice the result, everywhere? */
bool wo_is_linear(const OCIO_NAMESPACE::ConstProcessorRcPtr &processor);

#endif
