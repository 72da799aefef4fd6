/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "guard.hh"
#include "opencv_private.hh"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

cv::Mat wo_mat_of(const wo_image *image)
{
    const int width = wo_rect_width(image->bounds), height = wo_rect_height(image->bounds);
    cv::Mat mat(height, width, CV_32FC(image->components));
    for (int y = 0; y < height; y++)
        std::memcpy(mat.ptr(y), wo_image_at(image, image->bounds.x1, image->bounds.y2 - 1 - y),
                    static_cast<size_t>(width) * mat.elemSize());
    return mat;
}

wo_status wo_image_of(const cv::Mat &mat, wo_image *result, wo_error *error)
{
    cv::Mat floats;
    mat.convertTo(floats, CV_32F, mat.depth() == CV_8U ? 1.0 / 255 : 1.0);
    const size_t row = static_cast<size_t>(floats.cols) * floats.elemSize();
    auto *const data = static_cast<float *>(std::malloc(row * static_cast<size_t>(floats.rows)));
    if (!data)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for %d x %d pixels", mat.cols, mat.rows);
    *result = {data, {0, 0, mat.cols, mat.rows}, static_cast<ptrdiff_t>(row), mat.channels()};
    for (int y = 0; y < floats.rows; y++)
        std::memcpy(wo_image_at(result, 0, floats.rows - 1 - y), floats.ptr(y), row);
    return WO_OK;
}

cv::Mat wo_resized(const cv::Mat &mat, int width, int height)
{
    const bool smaller = width <= mat.cols && height <= mat.rows;
    cv::Mat result;
    cv::resize(mat, result, cv::Size(width, height), 0, 0,
               smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
    return result;
}

namespace
{

constexpr double luma_weights[3] = {0.2126, 0.7152, 0.0722};

/* Sample c (0..2) of a pixel; a grey one counts for all three. */
double colour_of(const float *pixel, int components, int c)
{
    return static_cast<double>(pixel[components == 1 ? 0 : c]);
}

wo_status check_pair(const wo_image *ref, const wo_image *out, int32_t crop, wo_error *error)
{
    WO_TRY(wo_image_validate(ref, "reference", error));
    WO_TRY(wo_image_validate(out, "picture", error));
    if (!ref->data || !out->data)
        return wo_fail(error, WO_ERR_ARGUMENT, "a picture to compare is missing");
    const int32_t width = wo_rect_width(ref->bounds), height = wo_rect_height(ref->bounds);
    if (width != wo_rect_width(out->bounds) || height != wo_rect_height(out->bounds))
        return wo_fail(error, WO_ERR_ARGUMENT, "sizes differ: %d x %d and %d x %d", width, height,
                       wo_rect_width(out->bounds), wo_rect_height(out->bounds));
    if (crop < 0 || width - 2 * int64_t(crop) < 1 || height - 2 * int64_t(crop) < 1)
        return wo_fail(error, WO_ERR_RANGE, "a border of %d pixels leaves nothing of %d x %d", crop,
                       width, height);
    return WO_OK;
}

/* Row y (from the bottom) of the window inside the border. */
const float *row_of(const wo_image *image, int32_t crop, int32_t y)
{
    return wo_image_at(image, image->bounds.x1 + crop, image->bounds.y1 + crop + y);
}

int64_t count_nonfinite(const wo_image *image, int32_t crop, int32_t width, int32_t height)
{
    const int components = image->components;
    int64_t count = 0;
    for (int32_t y = 0; y < height; y++) {
        const float *at = row_of(image, crop, y);
        for (int32_t x = 0; x < width; x++, at += components)
            for (int c = 0; c < std::min(components, 3); c++)
                count += !std::isfinite(at[c]);
    }
    return components == 1 ? 3 * count : count;
}

struct Sums {
    double relative = 0, linear = 0, seen = 0, ref = 0, out = 0, largest = 0;
};

double clipped(double value)
{
    return std::clamp(value, 0.0, 1.0);
}

/* Adds up one row and keeps its seen luma. */
void add_row(const float *ref, int ref_components, const float *out, int out_components,
             int32_t width, Sums &sums, double *ref_luma, double *out_luma)
{
    Sums row;
    for (int32_t x = 0; x < width; x++, ref += ref_components, out += out_components) {
        double luma_r = 0, luma_o = 0;
        for (int c = 0; c < 3; c++) {
            const double r = colour_of(ref, ref_components, c);
            const double o = colour_of(out, out_components, c);
            const double error = o - r, linear = clipped(o) - clipped(r);
            const double seen_r = wo_seen(r), seen_o = wo_seen(o);
            row.relative += error * error / (r * r + 0.01);
            row.linear += linear * linear;
            row.seen += (seen_o - seen_r) * (seen_o - seen_r);
            row.ref += r;
            row.out += o;
            sums.largest = std::max(sums.largest, std::abs(error));
            luma_r += seen_r * luma_weights[c];
            luma_o += seen_o * luma_weights[c];
        }
        ref_luma[x] = luma_r;
        out_luma[x] = luma_o;
    }
    sums.relative += row.relative;
    sums.linear += row.linear;
    sums.seen += row.seen;
    sums.ref += row.ref;
    sums.out += row.out;
}

cv::Mat blurred(const cv::Mat &mat)
{
    cv::Mat result;
    cv::GaussianBlur(mat, result, cv::Size(11, 11), 1.5);
    return result;
}

double mean_ssim(const cv::Mat &a, const cv::Mat &b)
{
    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    const cv::Mat mean_a = blurred(a), mean_b = blurred(b);
    const cv::Mat square_a = blurred(a.mul(a)), square_b = blurred(b.mul(b));
    const cv::Mat product = blurred(a.mul(b));
    double total = 0;
    for (int y = 0; y < a.rows; y++) {
        double row = 0;
        for (int x = 0; x < a.cols; x++) {
            const double ma = mean_a.at<double>(y, x), mb = mean_b.at<double>(y, x);
            const double va = square_a.at<double>(y, x) - ma * ma;
            const double vb = square_b.at<double>(y, x) - mb * mb;
            const double vab = product.at<double>(y, x) - ma * mb;
            row +=
                (2 * ma * mb + c1) * (2 * vab + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
        }
        total += row;
    }
    return total / (static_cast<double>(a.rows) * a.cols);
}

double decibel(double mean_square)
{
    return mean_square > 0 ? -10 * std::log10(mean_square)
                           : std::numeric_limits<double>::infinity();
}

wo_status compare(const wo_image *ref, const wo_image *out, int32_t crop, wo_picture_error *result,
                  wo_error *error)
{
    WO_TRY(check_pair(ref, out, crop, error));
    const int32_t width = wo_rect_width(ref->bounds) - 2 * crop;
    const int32_t height = wo_rect_height(ref->bounds) - 2 * crop;
    result->width = width;
    result->height = height;
    const int64_t bad = count_nonfinite(ref, crop, width, height);
    if (bad)
        return wo_fail(error, WO_ERR_FORMAT, "%lld samples of the reference are NaN or infinite",
                       static_cast<long long>(bad));
    result->nonfinite = count_nonfinite(out, crop, width, height);
    if (result->nonfinite)
        return WO_OK;

    Sums sums;
    cv::Mat ref_luma(height, width, CV_64F), out_luma(height, width, CV_64F);
    for (int32_t y = 0; y < height; y++)
        add_row(row_of(ref, crop, y), ref->components, row_of(out, crop, y), out->components, width,
                sums, ref_luma.ptr<double>(y), out_luma.ptr<double>(y));
    const double samples = 3.0 * width * height;
    result->relmse = sums.relative / samples;
    result->psnr_lin = decibel(sums.linear / samples);
    result->psnr = decibel(sums.seen / samples);
    result->ssim = mean_ssim(ref_luma, out_luma);
    result->max_error = sums.largest;
    result->energy = sums.ref != 0 ? sums.out / sums.ref : std::numeric_limits<double>::quiet_NaN();
    return WO_OK;
}

wo_status resize(const wo_image *image, int32_t width, int32_t height, wo_image *result,
                 wo_error *error)
{
    WO_TRY(wo_image_validate(image, "picture", error));
    if (!image->data)
        return wo_fail(error, WO_ERR_ARGUMENT, "no picture to resize");
    if (width < 1 || height < 1 || width > WO_MAX_SIDE || height > WO_MAX_SIDE)
        return wo_fail(error, WO_ERR_RANGE, "%d x %d pixels, but 1 to %d a side are allowed", width,
                       height, WO_MAX_SIDE);
    return wo_image_of(wo_resized(wo_mat_of(image), width, height), result, error);
}

/* False colour. */

struct Stop {
    double at;
    cv::Vec3f colour; /* RGB, 0..1 */
};

cv::Vec3f along(const Stop *stops, size_t count, double at)
{
    size_t i = 1;
    while (i + 1 < count && at > stops[i].at)
        i++;
    const Stop &low = stops[i - 1], &high = stops[i];
    const double t = std::clamp((at - low.at) / (high.at - low.at), 0.0, 1.0);
    return low.colour * (1 - t) + high.colour * t;
}

/* value is -1..1 of the limit for signed pictures, 0..1 for magnitudes. */
cv::Vec3f false_colour(wo_picture_difference kind, double value)
{
    static const Stop magnitude[] = {{0, {0, 0, 0}},
                                     {0.25, {0.25f, 0.07f, 0.43f}},
                                     {0.5, {0.70f, 0.17f, 0.35f}},
                                     {0.75, {0.97f, 0.55f, 0.16f}},
                                     {1, {1, 1, 0.90f}}};
    static const Stop both[] = {{-1, {0.55f, 0.85f, 1}},
                                {-0.5, {0.10f, 0.35f, 0.90f}},
                                {0, {0.08f, 0.08f, 0.08f}},
                                {0.5, {0.90f, 0.20f, 0.10f}},
                                {1, {1, 0.85f, 0.50f}}};
    return kind == WO_DIFFERENCE_SIGNED ? along(both, WO_COUNT(both), value)
                                        : along(magnitude, WO_COUNT(magnitude), value);
}

/* Seen difference of one pixel: the largest of the channels, or luma with its sign. */
double pixel_difference(wo_picture_difference kind, const float *ref, int ref_components,
                        const float *out, int out_components)
{
    double largest = 0, luma = 0;
    for (int c = 0; c < 3; c++) {
        const double d =
            wo_seen(colour_of(out, out_components, c)) - wo_seen(colour_of(ref, ref_components, c));
        largest = std::max(largest, std::abs(d));
        luma += d * luma_weights[c];
    }
    return kind == WO_DIFFERENCE_SIGNED ? luma : largest;
}

bool is_finite(const float *pixel, int components)
{
    bool finite = true;
    for (int c = 0; c < std::min(components, 3); c++)
        finite = finite && std::isfinite(pixel[c]);
    return finite;
}

/* Differences, NaN where out is not finite; the largest one goes into *largest. */
cv::Mat difference_of(const wo_image *ref, const wo_image *out, wo_picture_difference kind,
                      double *largest)
{
    const cv::Mat a = wo_mat_of(ref), b = wo_mat_of(out);
    cv::Mat result(a.size(), CV_64F);
    *largest = 0;
    for (int y = 0; y < a.rows; y++)
        for (int x = 0; x < a.cols; x++) {
            const float *const r = a.ptr<float>(y) + x * a.channels();
            const float *const o = b.ptr<float>(y) + x * b.channels();
            double value = std::numeric_limits<double>::quiet_NaN();
            if (is_finite(o, b.channels())) {
                value = pixel_difference(kind, r, a.channels(), o, b.channels());
                *largest = std::max(*largest, std::abs(value));
            }
            result.at<double>(y, x) = value;
        }
    return result;
}

void draw_scale(cv::Mat &bar, wo_picture_difference kind, double limit)
{
    const bool both = kind == WO_DIFFERENCE_SIGNED;
    const int height = 2 * bar.rows / 5;
    for (int x = 0; x < bar.cols; x++) {
        const double t = bar.cols > 1 ? double(x) / (bar.cols - 1) : 0;
        const cv::Vec3f colour = false_colour(kind, both ? 2 * t - 1 : t) * 255;
        bar.rowRange(0, height).col(x).setTo(cv::Scalar(colour[0], colour[1], colour[2]));
    }
    char low[32], high[32];
    std::snprintf(low, sizeof low, both ? "-%.3g darker" : "0", limit);
    std::snprintf(high, sizeof high, both ? "brighter %.3g" : "%.3g", limit);
    const int size = std::max(7, bar.rows / 3), middle = height + (bar.rows - height) / 2;
    const cv::Scalar ink(220, 220, 220);
    cv::Mat nowhere(1, 1, CV_8UC3);
    const int width = wo_draw_text(nowhere, high, 0, 0, size, bar.cols / 2, ink);
    wo_draw_text(bar, low, 2, middle, size, bar.cols / 2, ink);
    wo_draw_text(bar, high, bar.cols - width - 2, middle, size, bar.cols / 2, ink);
}

wo_status show_difference(const wo_image *ref, const wo_image *out, wo_picture_difference kind,
                          double limit, wo_image *result, wo_error *error)
{
    WO_TRY(check_pair(ref, out, 0, error));
    if (!(limit >= 0 && limit <= 1))
        return wo_fail(error, WO_ERR_RANGE, "a limit of %g is outside 0..1", limit);
    double largest = 0;
    const cv::Mat values = difference_of(ref, out, kind, &largest);
    const double scale = limit > 0 ? limit : std::max(largest, 1e-6);
    const int bar = std::clamp(values.rows / 10, 24, 120);
    cv::Mat picture(values.rows + bar, values.cols, CV_8UC3, cv::Scalar(28, 28, 28));
    for (int y = 0; y < values.rows; y++)
        for (int x = 0; x < values.cols; x++) {
            const double value = values.at<double>(y, x);
            const cv::Vec3f colour =
                std::isnan(value) ? cv::Vec3f(1, 0, 1) : false_colour(kind, value / scale);
            picture.at<cv::Vec3b>(y, x) = cv::Vec3b(cv::saturate_cast<uchar>(colour[0] * 255),
                                                    cv::saturate_cast<uchar>(colour[1] * 255),
                                                    cv::saturate_cast<uchar>(colour[2] * 255));
        }
    cv::Mat scale_bar = picture.rowRange(values.rows, values.rows + bar);
    draw_scale(scale_bar, kind, scale);
    return wo_image_of(picture, result, error);
}

} // namespace

extern "C" wo_status wo_picture_compare(const wo_image *ref, const wo_image *out, int32_t crop,
                                        wo_picture_error *result, wo_error *error)
{
    return wo_guard(error, __func__, [&]() -> wo_status {
        *result = {};
        return compare(ref, out, crop, result, error);
    });
}

extern "C" wo_status wo_picture_resize(const wo_image *image, int32_t width, int32_t height,
                                       wo_image *result, wo_error *error)
{
    return wo_guard(error, __func__, [&]() -> wo_status {
        *result = {};
        return resize(image, width, height, result, error);
    });
}

extern "C" wo_status wo_picture_show_difference(const wo_image *ref, const wo_image *out,
                                                wo_picture_difference kind, double limit,
                                                wo_image *result, wo_error *error)
{
    return wo_guard(error, __func__, [&]() -> wo_status {
        *result = {};
        return show_difference(ref, out, kind, limit, result, error);
    });
}
