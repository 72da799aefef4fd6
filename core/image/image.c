/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/image.h"

static bool within_reach(int32_t coordinate)
{
    return coordinate >= -WO_MAX_COORDINATE && coordinate <= WO_MAX_COORDINATE;
}

wo_status wo_image_validate(const wo_image *image, const char *name, wo_error *error)
{
    if (!name)
        name = "image";
    if (!image)
        return wo_fail(error, WO_ERR_ARGUMENT, "%s: no image was given", name);
    if (!image->data)
        return WO_OK;
    if (image->components != 1 && image->components != 3 && image->components != 4)
        return wo_fail(error, WO_ERR_FORMAT, "%s: %d components a pixel, but 1, 3 or 4 are known",
                       name, (int)image->components);

    const wo_rect bounds = image->bounds;
    if (!within_reach(bounds.x1) || !within_reach(bounds.y1) || !within_reach(bounds.x2) ||
        !within_reach(bounds.y2))
        return wo_fail(error, WO_ERR_RANGE, "%s: bounds %d,%d..%d,%d lie outside %d..%d", name,
                       (int)bounds.x1, (int)bounds.y1, (int)bounds.x2, (int)bounds.y2,
                       -WO_MAX_COORDINATE, WO_MAX_COORDINATE);
    const int32_t width = wo_rect_width(bounds), height = wo_rect_height(bounds);
    if (width < 1 || height < 1 || width > WO_MAX_SIDE || height > WO_MAX_SIDE)
        return wo_fail(error, WO_ERR_RANGE, "%s: a picture of %dx%d pixels, but 1..%d a side fit",
                       name, (int)width, (int)height, WO_MAX_SIDE);

    const ptrdiff_t pixels = (ptrdiff_t)width * image->components * (ptrdiff_t)sizeof(float);
    if (height > 1 && image->row_bytes < pixels && image->row_bytes > -pixels)
        return wo_fail(error, WO_ERR_FORMAT, "%s: rows of %td bytes overlap, %td are needed", name,
                       image->row_bytes, pixels);
    if ((uintptr_t)image->data % sizeof(float) != 0 ||
        (height > 1 && image->row_bytes % (ptrdiff_t)sizeof(float) != 0))
        return wo_fail(error, WO_ERR_FORMAT, "%s: rows do not start on whole floats", name);
    return WO_OK;
}
