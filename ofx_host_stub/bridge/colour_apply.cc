/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "colour_apply.hh"

#include <algorithm>
#include <cmath>
#include <vector>

namespace OCIO = OCIO_NAMESPACE;

namespace
{

/* The library's default takes short cuts in powers and logarithms that cost 1e-5 and more. */
OCIO::ConstCPUProcessorRcPtr exact(const OCIO::ConstProcessorRcPtr &processor)
{
    return processor->getOptimizedCPUProcessor(OCIO::BIT_DEPTH_F32, OCIO::BIT_DEPTH_F32,
                                               OCIO::OPTIMIZATION_LOSSLESS);
}

/* Multiples of one colour become the same multiples of its result. */
bool is_linear(const OCIO::ConstCPUProcessorRcPtr &processor)
{
    const float colours[3][3] = {{1.0f, 0.5f, 0.25f}, {0.1f, 0.7f, 0.9f}, {-0.2f, 0.3f, 1.0f}};
    for (const auto &colour : colours) {
        float one[3] = {colour[0], colour[1], colour[2]};
        processor->applyRGB(one);
        for (const float times : {0.0f, 1.0f / 64, 0.1f, 0.5f, 4.0f, 64.0f}) {
            float many[3] = {times * colour[0], times * colour[1], times * colour[2]};
            processor->applyRGB(many);
            for (int c = 0; c < 3; c++)
                if (!(std::fabs(many[c] - times * one[c]) <= 1e-5f * times + 1e-7f))
                    return false;
        }
    }
    return true;
}

bool keeps_black(const OCIO::ConstCPUProcessorRcPtr &processor)
{
    float black[3] = {0, 0, 0};
    processor->applyRGB(black);
    return std::max({std::fabs(black[0]), std::fabs(black[1]), std::fabs(black[2])}) <= 1e-5f;
}

/* The largest that is a number. */
float largest(const float *colour)
{
    float most = 0;
    for (int c = 0; c < 3; c++)
        most = colour[c] > most ? colour[c] : most;
    return most;
}

/* Largest code of a colour over a divisor. */
float code_of(const OCIO::ConstCPUProcessorRcPtr &processor, const float *colour, float divisor)
{
    float over[3] = {colour[0] / divisor, colour[1] / divisor, colour[2] / divisor};
    processor->applyRGB(over);
    return largest(over);
}

/* Between alpha and 1 the divisor that makes the largest code 1; codes fall as it grows. */
float encoding_divisor(const OCIO::ConstCPUProcessorRcPtr &processor, const float *colour,
                       float alpha)
{
    if (!(code_of(processor, colour, 1) < 1))
        return 1;
    float low = alpha, high = 1;
    for (int i = 0; i < 64 && low < high * (1 - 1e-7f); i++) {
        const float middle = std::sqrt(low) * std::sqrt(high);
        if (!(middle > low && middle < high))
            break;
        (code_of(processor, colour, middle) > 1 ? low : high) = middle;
    }
    return high;
}

/* What colour is divided by before and multiplied by afterwards; 1 leaves it alone. */
float divisor_of(const OCIO::ConstCPUProcessorRcPtr &processor, const float *pixel,
                 wo_apply_mode mode)
{
    const float alpha = pixel[3];
    if (!(alpha > 0) || std::isinf(alpha))
        return 1;
    if (alpha >= 1)
        return alpha;
    if (mode == WO_APPLY_DECODE)
        return std::max(alpha, std::min(largest(pixel), 1.0f));
    return code_of(processor, pixel, alpha) > 1 ? encoding_divisor(processor, pixel, alpha) : alpha;
}

} // namespace

bool wo_is_linear(const OCIO::ConstProcessorRcPtr &processor)
{
    return processor->isNoOp() || is_linear(exact(processor));
}

void wo_apply(const OCIO::ConstProcessorRcPtr &given, wo_image *image, wo_apply_mode mode)
{
    const OCIO::ConstCPUProcessorRcPtr processor = exact(given);
    const int width = wo_rect_width(image->bounds), components = image->components;
    const bool alpha = components == 4;
    const bool divides =
        alpha && mode != WO_APPLY_PLAIN && keeps_black(processor) && !is_linear(processor);
    /* the processor may touch alpha (a 4 x 4 matrix can), so that is put back */
    std::vector<float> alphas(alpha ? static_cast<size_t>(width) : 0), divisors(alphas.size(), 1);
    for (int32_t y = image->bounds.y1; y < image->bounds.y2; y++) {
        float *const row = wo_image_at(image, image->bounds.x1, y);
        for (size_t x = 0; x < alphas.size(); x++) {
            float *const pixel = row + 4 * x;
            alphas[x] = pixel[3];
            if (divides)
                divisors[x] = divisor_of(processor, pixel, mode);
            for (int c = 0; divides && c < 3; c++)
                pixel[c] /= divisors[x];
        }
        OCIO::PackedImageDesc desc(row, width, 1, components);
        processor->apply(desc);
        for (size_t x = 0; x < alphas.size(); x++) {
            float *const pixel = row + 4 * x;
            pixel[3] = alphas[x];
            for (int c = 0; divides && c < 3; c++)
                pixel[c] *= divisors[x];
        }
    }
}
