/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "picture_private.h"

#include <stdio.h>
#include <string.h>

void wo_picture_encode(wo_image *image)
{
    if (!image || !image->data)
        return;
    const int colours = image->components == 4 ? 3 : image->components;
    for (int32_t y = image->bounds.y1; y < image->bounds.y2; y++) {
        float *at = wo_image_at(image, image->bounds.x1, y);
        for (int32_t x = image->bounds.x1; x < image->bounds.x2; x++, at += image->components) {
            bool broken = false;
            for (int c = 0; c < colours; c++)
                broken = broken || isnan(at[c]);
            for (int c = 0; c < colours; c++)
                at[c] = (float)wo_seen((double)at[c]);
            if (broken && colours == 3) {
                at[0] = at[2] = 1;
                at[1] = 0;
            }
        }
    }
}

/* A number as JSON takes it, whatever the locale's decimal point. */
static void print_number(char *buffer, size_t size, double value)
{
    if (!isfinite(value)) {
        snprintf(buffer, size, "null");
        return;
    }
    snprintf(buffer, size, "%.9g", value);
    for (char *at = buffer; *at; at++)
        if (!strchr("0123456789+-e", *at))
            *at = '.';
}

int wo_picture_json(const wo_picture_error *result, char *buffer, size_t size)
{
    char words[6][32];
    const double numbers[6] = {result->relmse, result->psnr_lin,  result->psnr,
                               result->ssim,   result->max_error, result->energy};
    for (size_t i = 0; i < WO_COUNT(numbers); i++)
        print_number(words[i], sizeof words[i], numbers[i]);
    if (result->nonfinite)
        return snprintf(buffer, size, "{\"width\": %d, \"height\": %d, \"nonfinite\": %lld}",
                        (int)result->width, (int)result->height, (long long)result->nonfinite);
    return snprintf(buffer, size,
                    "{\"width\": %d, \"height\": %d, \"relmse\": %s, \"psnr_lin\": %s, "
                    "\"psnr\": %s, \"ssim\": %s, \"max_error\": %s, \"energy\": %s, "
                    "\"nonfinite\": 0}",
                    (int)result->width, (int)result->height, words[0], words[1], words[2], words[3],
                    words[4], words[5]);
}
