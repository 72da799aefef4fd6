/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_pixels.h"

#include <math.h>
#include <string.h>

size_t wo_depth_bytes(wo_depth depth)
{
    return depth == WO_DEPTH_FLOAT ? 4 : depth == WO_DEPTH_BYTE ? 1 : 2;
}

float wo_half_to_float(uint16_t half)
{
    const uint32_t sign = (uint32_t)(half & 0x8000u) << 16;
    const uint32_t exponent = (half >> 10) & 31u, fraction = half & 0x3ffu;
    float value;
    uint32_t bits;

    if (exponent == 0) {
        value = ldexpf((float)fraction, -24);
        return sign ? -value : value;
    }
    bits = sign | (exponent == 31 ? 0x7f800000u : (exponent + 112) << 23) | fraction << 13;
    memcpy(&value, &bits, sizeof value);
    return value;
}

uint16_t wo_float_to_half(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    const uint16_t sign = (uint16_t)((bits >> 16) & 0x8000u);
    const uint32_t magnitude = bits & 0x7fffffffu;

    if (magnitude > 0x7f800000u)
        return (uint16_t)(sign | 0x7e00u);
    if (magnitude >= 0x477ff000u) /* 65520: half way to what would follow 65504 */
        return (uint16_t)(sign | 0x7c00u);
    if (magnitude < 0x38800000u) /* below 2^-14: whole multiples of 2^-24 */
        return (uint16_t)(sign | (uint16_t)lrintf(ldexpf(fabsf(value), 24)));
    const uint32_t even = (magnitude >> 13) & 1u;
    return (uint16_t)(sign | ((magnitude + 0xfffu + even - (112u << 23)) >> 13));
}

static char *address(const wo_pixels *p, int32_t x, int32_t y)
{
    const ptrdiff_t pixel = (ptrdiff_t)wo_depth_bytes(p->depth) * p->components;
    return (char *)p->data + (ptrdiff_t)(y - p->bounds.y1) * p->row_bytes +
           (ptrdiff_t)(x - p->bounds.x1) * pixel;
}

static float load(const char *at, wo_depth depth)
{
    uint16_t word;
    float value;
    switch (depth) {
    case WO_DEPTH_BYTE:
        return (float)(unsigned char)*at / 255.0f;
    case WO_DEPTH_SHORT:
        memcpy(&word, at, sizeof word);
        return (float)word / 65535.0f;
    case WO_DEPTH_HALF:
        memcpy(&word, at, sizeof word);
        return wo_half_to_float(word);
    case WO_DEPTH_FLOAT:
        break;
    }
    memcpy(&value, at, sizeof value);
    return value;
}

/* Nearest of 0..top; written so that NaN gives 0. */
static unsigned quantise(float value, float top)
{
    return value > 0 ? (unsigned)lrintf(fminf(value, 1) * top) : 0;
}

static void save(char *at, wo_depth depth, float value)
{
    uint16_t word;
    switch (depth) {
    case WO_DEPTH_BYTE:
        *(unsigned char *)at = (unsigned char)quantise(value, 255);
        return;
    case WO_DEPTH_SHORT:
        word = (uint16_t)quantise(value, 65535);
        memcpy(at, &word, sizeof word);
        return;
    case WO_DEPTH_HALF:
        word = wo_float_to_half(value);
        memcpy(at, &word, sizeof word);
        return;
    case WO_DEPTH_FLOAT:
        break;
    }
    memcpy(at, &value, sizeof value);
}

static void map_components(const float *from, int32_t count, float *to, int32_t wanted)
{
    if (wanted == 1) {
        to[0] = from[count == 4 ? 3 : 0];
        return;
    }
    for (int32_t i = 0; i < 3; i++)
        to[i] = from[count == 1 ? 0 : i];
    if (wanted == 4)
        to[3] = count == 4 ? from[3] : 1;
}

void wo_pixels_read(const wo_pixels *from, const wo_image *to)
{
    const size_t bytes = wo_depth_bytes(from->depth);
    const ptrdiff_t step = (ptrdiff_t)bytes * from->components;
    for (int32_t y = to->bounds.y1; y < to->bounds.y2; y++) {
        const char *at = address(from, to->bounds.x1, y);
        float *target = wo_image_at(to, to->bounds.x1, y);
        for (int32_t x = to->bounds.x1; x < to->bounds.x2; x++) {
            float pixel[4] = {0, 0, 0, 0};
            for (int32_t i = 0; i < from->components; i++)
                pixel[i] = load(at + (size_t)i * bytes, from->depth);
            map_components(pixel, from->components, target, to->components);
            at += step;
            target += to->components;
        }
    }
}

void wo_pixels_write(const wo_image *from, const wo_pixels *to)
{
    const size_t bytes = wo_depth_bytes(to->depth);
    const int32_t first = to->components == 1 ? 3 : 0;
    for (int32_t y = from->bounds.y1; y < from->bounds.y2; y++) {
        char *at = address(to, from->bounds.x1, y);
        for (int32_t x = from->bounds.x1; x < from->bounds.x2; x++) {
            const float *const pixel = wo_image_at(from, x, y);
            for (int32_t i = 0; i < to->components; i++, at += bytes)
                save(at, to->depth, pixel[first + i]);
        }
    }
}
