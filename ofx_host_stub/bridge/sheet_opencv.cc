/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "guard.hh"
#include "opencv_private.hh"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace
{

constexpr int font = cv::FONT_HERSHEY_DUPLEX;

/* The font has ASCII only; everything else becomes one ? a character. */
std::string plain(const std::string &text)
{
    std::string result;
    for (const char letter : text) {
        const auto byte = static_cast<unsigned char>(letter);
        if (byte >= 0x20 && byte < 0x7f)
            result += letter;
        else if (byte < 0x20 || byte == 0x7f)
            result += ' ';
        else if (byte >= 0xc0)
            result += '?';
    }
    return result;
}

int text_width(const std::string &text, double scale)
{
    int below = 0;
    return cv::getTextSize(text, font, scale, 1, &below).width;
}

/* Cut so that it fits, with two dots for the rest. */
std::string shortened(const std::string &text, double scale, int most)
{
    if (text_width(text, scale) <= most)
        return text;
    size_t length = text.size();
    while (length > 0 && text_width(text.substr(0, length) + "..", scale) > most)
        length--;
    return length > 0 ? text.substr(0, length) + ".." : "";
}

} // namespace

int wo_draw_text(cv::Mat &canvas, const std::string &text, int x, int y, int size, int most,
                 const cv::Scalar &colour)
{
    const double scale = size / 22.0; /* capitals of the font are 22 pixels high at scale 1 */
    const std::string shown = shortened(plain(text), scale, most);
    if (shown.empty())
        return 0;
    cv::putText(canvas, shown, cv::Point(x, y + size / 2), font, scale, colour, 1, cv::LINE_AA);
    return text_width(shown, scale);
}

namespace
{

const cv::Scalar paper(38, 38, 38), place(24, 24, 24), bright(236, 236, 236), dim(168, 168, 168);

/* Pixels of everything on a sheet. */
struct Grid {
    int columns, rows;
    int cell_width, cell_height; /* of a picture */
    int gap, caption, head;
    int letter; /* height of capitals in captions */

    int step_x() const { return cell_width + gap; }
    int step_y() const { return cell_height + caption + gap; }
    int64_t width() const { return int64_t(columns) * step_x() + gap; }
    int64_t height() const { return int64_t(head) + int64_t(rows) * step_y() + gap; }
};

const wo_image *first_picture(const wo_picture_cell *cells, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (cells[i].image && cells[i].image->data)
            return cells[i].image;
    return nullptr;
}

bool has_line(const wo_picture_cell *cells, size_t count, int line)
{
    return std::any_of(cells, cells + count, [line](const wo_picture_cell &cell) {
        return cell.caption[line] && cell.caption[line][0];
    });
}

/* Columns that make the whole about as wide as high. */
int choose_columns(size_t count, double cell_aspect)
{
    const double side = std::sqrt(static_cast<double>(count) / cell_aspect);
    return static_cast<int>(std::clamp(std::round(side), 1.0, static_cast<double>(count)));
}

Grid plan_grid(const wo_picture_layout *layout, const wo_picture_cell *cells, size_t count)
{
    Grid grid = {};
    const wo_image *const first = first_picture(cells, count);
    const double shape =
        first ? double(wo_rect_height(first->bounds)) / wo_rect_width(first->bounds) : 9.0 / 16;
    grid.cell_width = layout->cell_width > 0 ? layout->cell_width : 480;
    grid.cell_height =
        layout->cell_height > 0
            ? layout->cell_height
            : static_cast<int>(std::clamp(std::round(grid.cell_width * shape), 1.0, 65536.0));
    grid.letter = std::clamp(grid.cell_width / 40, 9, 16);
    grid.gap = std::max(8, grid.letter);
    grid.caption = (has_line(cells, count, 0) + has_line(cells, count, 1)) * 2 * grid.letter;
    const bool title = layout->title && layout->title[0];
    const bool subtitle = layout->subtitle && layout->subtitle[0];
    grid.head = title * 3 * grid.letter + subtitle * 2 * grid.letter;
    grid.columns = layout->columns > 0
                       ? static_cast<int>(std::min<size_t>(size_t(layout->columns), count))
                       : choose_columns(count, double(grid.step_x()) / grid.step_y());
    grid.rows = static_cast<int>((count + size_t(grid.columns) - 1) / size_t(grid.columns));
    return grid;
}

/* What a sample looks like, clipped to 0..1; NaN is black. */
void make_visible(cv::Mat &mat, bool linear)
{
    const int samples = mat.cols * mat.channels();
    for (int y = 0; y < mat.rows; y++) {
        auto *const row = mat.ptr<float>(y);
        for (int i = 0; i < samples; i++)
            row[i] = linear           ? static_cast<float>(wo_seen(static_cast<double>(row[i])))
                     : row[i] >= 0.0f ? std::min(row[i], 1.0f)
                                      : 0.0f;
    }
}

/* The picture as 8-bit RGB, scaled to fill most_width or most_height. */
cv::Mat fitted(const wo_picture_cell &cell, int most_width, int most_height)
{
    cv::Mat mat = wo_mat_of(cell.image);
    if (mat.channels() == 4)
        cv::cvtColor(mat, mat, cv::COLOR_RGBA2RGB);
    make_visible(mat, cell.linear);
    if (mat.channels() == 1)
        cv::cvtColor(mat, mat, cv::COLOR_GRAY2RGB);
    const double factor = std::min(double(most_width) / mat.cols, double(most_height) / mat.rows);
    const int width = std::clamp(static_cast<int>(std::lround(mat.cols * factor)), 1, most_width);
    const int height = std::clamp(static_cast<int>(std::lround(mat.rows * factor)), 1, most_height);
    cv::Mat result;
    wo_resized(mat, width, height).convertTo(result, CV_8U, 255);
    return result;
}

void draw_cell(cv::Mat &sheet, const Grid &grid, const wo_picture_cell &cell, size_t index)
{
    const int column = static_cast<int>(index % size_t(grid.columns));
    const int row = static_cast<int>(index / size_t(grid.columns));
    const int x = grid.gap + column * grid.step_x();
    const int y = grid.head + grid.gap + row * grid.step_y();
    sheet(cv::Rect(x, y, grid.cell_width, grid.cell_height)).setTo(place);
    if (cell.image && cell.image->data) {
        const cv::Mat picture = fitted(cell, grid.cell_width, grid.cell_height);
        picture.copyTo(
            sheet(cv::Rect(x + (grid.cell_width - picture.cols) / 2,
                           y + (grid.cell_height - picture.rows) / 2, picture.cols, picture.rows)));
    }
    int line_y = y + grid.cell_height + grid.letter + grid.letter / 4;
    for (int line = 0; line < 2; line++)
        if (cell.caption[line] && cell.caption[line][0]) {
            wo_draw_text(sheet, cell.caption[line], x + 2, line_y, grid.letter, grid.cell_width - 4,
                         line ? dim : bright);
            line_y += 2 * grid.letter;
        }
}

wo_status check_cells(const wo_picture_layout *layout, const wo_picture_cell *cells, size_t count,
                      wo_error *error)
{
    if (!layout || !cells || count < 1 || count > 10000)
        return wo_fail(error, WO_ERR_ARGUMENT, "%zu pictures, but a sheet shows 1 to 10000", count);
    if (layout->columns < 0 || layout->cell_width < 0 || layout->cell_height < 0 ||
        layout->cell_width > 8192 || layout->cell_height > 8192)
        return wo_fail(error, WO_ERR_RANGE, "cells of %d x %d pixels, but 0 to 8192 are allowed",
                       layout->cell_width, layout->cell_height);
    for (size_t i = 0; i < count; i++)
        if (cells[i].image)
            WO_TRY(wo_image_validate(cells[i].image, "picture of a sheet", error));
    return WO_OK;
}

wo_status draw_sheet(const wo_picture_layout *layout, const wo_picture_cell *cells, size_t count,
                     wo_image *result, wo_error *error)
{
    WO_TRY(check_cells(layout, cells, count, error));
    const Grid grid = plan_grid(layout, cells, count);
    if (grid.width() > WO_MAX_SIDE || grid.height() > WO_MAX_SIDE)
        return wo_fail(error, WO_ERR_RANGE, "a sheet of %lld x %lld pixels, but %d a side fit",
                       static_cast<long long>(grid.width()), static_cast<long long>(grid.height()),
                       WO_MAX_SIDE);
    cv::Mat sheet(static_cast<int>(grid.height()), static_cast<int>(grid.width()), CV_8UC3, paper);
    const int inside = sheet.cols - 2 * grid.gap;
    int y = grid.gap + grid.letter;
    if (layout->title && layout->title[0]) {
        wo_draw_text(sheet, layout->title, grid.gap, y, grid.letter * 3 / 2, inside, bright);
        y += 5 * grid.letter / 2;
    }
    if (layout->subtitle && layout->subtitle[0])
        wo_draw_text(sheet, layout->subtitle, grid.gap, y, grid.letter, inside, dim);
    for (size_t i = 0; i < count; i++)
        draw_cell(sheet, grid, cells[i], i);
    return wo_image_of(sheet, result, error);
}

} // namespace

extern "C" wo_status wo_picture_sheet(const wo_picture_layout *layout, const wo_picture_cell *cells,
                                      size_t count, wo_image *result, wo_error *error)
{
    return wo_guard(error, __func__, [&]() -> wo_status {
        *result = {};
        return draw_sheet(layout, cells, count, result, error);
    });
}
