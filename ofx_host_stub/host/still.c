/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "internal.h"

#include <math.h>

static double aspect_of(const wo_host_still *still)
{
    return still->pixel_aspect > 0 ? still->pixel_aspect : 1;
}

wo_status wo_host_still_region(void *user, double time, wo_host_region *region, wo_error *error)
{
    const wo_host_still *still = user;
    const wo_rect b = still->image.bounds;
    const double aspect = aspect_of(still);
    (void)time;
    if (!still->image.data)
        return wo_fail(error, WO_ERR_NOT_FOUND, "the picture has no pixels");
    *region = (wo_host_region){b.x1 * aspect, b.y1, b.x2 * aspect, b.y2};
    return WO_OK;
}

/* The pixels of the full size that pixel i at a scale covers, cut to low..high. */
static void covered(int32_t i, double scale, int32_t low, int32_t high, int32_t *first,
                    int32_t *last)
{
    const double a = floor(i / scale + 1e-6), b = ceil((i + 1) / scale - 1e-6);
    *first = a < low ? low : a > high ? high : (int32_t)a;
    *last = b < low ? low : b > high ? high : (int32_t)b;
}

static void average(const wo_image *from, int32_t x1, int32_t x2, int32_t y1, int32_t y2, float *to)
{
    for (int32_t c = 0; c < from->components; c++) {
        double sum = 0;
        for (int32_t y = y1; y < y2; y++)
            for (int32_t x = x1; x < x2; x++)
                sum += (double)wo_image_at(from, x, y)[c];
        to[c] = (float)(sum / ((double)(x2 - x1) * (y2 - y1)));
    }
}

wo_status wo_host_still_pixels(void *user, const wo_host_request *request, const wo_image *image,
                               wo_error *error)
{
    const wo_host_still *still = user;
    const wo_image *from = &still->image;
    const wo_rect b = from->bounds, w = image->bounds;
    if (!from->data)
        return wo_fail(error, WO_ERR_NOT_FOUND, "the picture has no pixels");
    if (from->components != image->components)
        return wo_fail(error, WO_ERR_ARGUMENT, "the picture has %d components, not %d",
                       from->components, image->components);
    if (request->scale_x == 1 && request->scale_y == 1) {
        wo_copy_window(from, image, wo_rect_intersect(w, b));
        return WO_OK;
    }
    for (int32_t y = w.y1; y < w.y2; y++) {
        int32_t y1, y2;
        covered(y, request->scale_y, b.y1, b.y2, &y1, &y2);
        for (int32_t x = w.x1; y1 < y2 && x < w.x2; x++) {
            int32_t x1, x2;
            covered(x, request->scale_x, b.x1, b.x2, &x1, &x2);
            if (x1 >= x2)
                continue;
            if (still->nearest) {
                const float *pixel =
                    wo_image_at(from, x1 + (x2 - 1 - x1) / 2, y1 + (y2 - 1 - y1) / 2);
                for (int32_t c = 0; c < from->components; c++)
                    wo_image_at(image, x, y)[c] = pixel[c];
            } else {
                average(from, x1, x2, y1, y2, wo_image_at(image, x, y));
            }
        }
    }
    return WO_OK;
}
