/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_PICTURE_PRIVATE_H
#define WO_BRIDGE_PICTURE_PRIVATE_H

#include "picture.h"

#include <math.h>

/* Clipped to 0..1 and put on the sRGB curve. */
static inline double wo_seen(double linear)
{
    if (!(linear > 0))
        return 0;
    if (linear >= 1)
        return 1;
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

#endif
