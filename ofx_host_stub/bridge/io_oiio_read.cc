/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "guard.hh"
#include "io_child_private.h"
#include "io_oiio_private.hh"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <vector>

namespace
{

/* Attributes. */

template <typename Number>
std::string print_numbers(const OIIO::ParamValue &value, size_t count, const char *form)
{
    std::string text;
    for (size_t i = 0; i < count; i++) {
        char word[40];
        std::snprintf(word, sizeof word, form, static_cast<const Number *>(value.data())[i]);
        text += (i ? " " : "") + std::string(word);
    }
    return text;
}

const char *array_kind(OIIO::TypeDesc type, size_t count)
{
    if (type.basetype == OIIO::TypeDesc::FLOAT)
        return count == 2    ? "v2f"
               : count == 3  ? "v3f"
               : count == 9  ? "m33f"
               : count == 16 ? "m44f"
                             : "";
    return count == 2 ? "v2i" : count == 3 ? "v3i" : count == 4 ? "box2i" : "";
}

wo_status add_attribute(wo_io_part *part, const OIIO::ParamValue &value, wo_error *error)
{
    const OIIO::TypeDesc type = value.type();
    const size_t count = type.basevalues();
    const char *const name = value.name().c_str();
    const bool is_int = type.basetype == OIIO::TypeDesc::INT;
    const bool is_float = type.basetype == OIIO::TypeDesc::FLOAT;

    if (!*name || count < 1 || value.nvalues() != 1)
        return WO_OK;
    if (type == OIIO::TypeDesc::STRING)
        return wo_io_part_add(part, name, WO_IO_TEXT, 0, value.get_string().c_str(), nullptr,
                              error);
    if (count == 1 && type.basetype != OIIO::TypeDesc::STRING) {
        const bool fraction = is_float || type.basetype == OIIO::TypeDesc::DOUBLE ||
                              type.basetype == OIIO::TypeDesc::HALF;
        const double number = fraction && type.basetype == OIIO::TypeDesc::DOUBLE
                                  ? *static_cast<const double *>(value.data())
                              : fraction ? static_cast<double>(value.get_float())
                                         : static_cast<double>(value.get_int());
        return wo_io_part_add(part, name, fraction ? WO_IO_FLOAT : WO_IO_INT, number, nullptr,
                              nullptr, error);
    }
    if (count > 16 || !(is_int || is_float))
        return WO_OK;
    const std::string text = is_int ? print_numbers<int>(value, count, "%d")
                                    : print_numbers<float>(value, count, "%.9g");
    return wo_io_part_add(part, name, WO_IO_TEXT, 0, text.c_str(), array_kind(type, count), error);
}

wo_rect rectangle(int64_t x1, int64_t y1, int64_t width, int64_t height)
{
    const auto cut = [](int64_t value) {
        return static_cast<int32_t>(std::clamp<int64_t>(value, INT32_MIN, INT32_MAX));
    };
    return {cut(x1), cut(y1), cut(x1 + width), cut(y1 + height)};
}

wo_status fill_head(wo_io_part *part, const wo_child_request *request, const OIIO::ImageSpec &spec,
                    uint64_t *bytes, wo_error *error)
{
    const bool framed = spec.full_width > 0 && spec.full_height > 0;
    const int64_t frame_width = framed ? spec.full_width : spec.width;
    const int64_t frame_height = framed ? spec.full_height : spec.height;
    const int64_t left = framed ? int64_t(spec.x) - spec.full_x : 0;
    const int64_t top = framed ? int64_t(spec.y) - spec.full_y : 0;
    const wo_rect data = rectangle(left, frame_height - top - spec.height, spec.width, spec.height);
    const wo_rect display = rectangle(0, 0, frame_width, frame_height);

    WO_TRY(wo_io_check_size(request->shown, data, display, spec.nchannels, bytes, error));
    if (spec.depth > 1 || spec.deep)
        return wo_fail(error, WO_ERR_UNSUPPORTED, "%s: volumes and deep pictures of this format",
                       request->shown);
    std::vector<const char *> names;
    for (int i = 0; i < spec.nchannels; i++)
        names.push_back(spec.channelnames[static_cast<size_t>(i)].c_str());
    WO_TRY(wo_io_part_head(part, spec.get_string_attribute("oiio:subimagename").c_str(), data,
                           display, names.data(), spec.nchannels, error));
    const double aspect = static_cast<double>(spec.get_float_attribute("PixelAspectRatio", 1.0f));
    part->pixel_aspect = aspect > 0 && aspect < 1e6 ? aspect : 1;
    part->bits = bits_of(spec);
    part->is_float = spec.format.is_floating_point();
    for (const OIIO::ParamValue &value : spec.extra_attribs)
        if (value.name() != "PixelAspectRatio" && value.name() != "oiio:subimagename" &&
            value.name() != "oiio:ColorSpace")
            WO_TRY(add_attribute(part, value, error));
    /* PNM files say nothing; the library makes them Rec.709, other programs write sRGB */
    const bool silent = !std::strcmp(request->library, "pnm");
    char *const space =
        wo_io_copy_text(silent ? "" : spec.get_string_attribute("oiio:ColorSpace").c_str());
    if (!space)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for a colour space");
    std::free(part->colour_space);
    part->colour_space = space;
    return WO_OK;
}

void flip_rows(wo_io_part *part)
{
    const size_t row =
        static_cast<size_t>(wo_rect_width(part->data_window)) * static_cast<size_t>(part->channels);
    const size_t height = static_cast<size_t>(wo_rect_height(part->data_window));
    for (size_t y = 0; y < height / 2; y++)
        std::swap_ranges(part->pixels + y * row, part->pixels + (y + 1) * row,
                         part->pixels + (height - 1 - y) * row);
}

/* Headers that claim far more than the format can pack into the file's length. WebP and JPEG 2000
   can say "all the same" in a few bytes. */
bool is_plausible(const wo_child_request *request, const OIIO::ImageSpec &spec, uint64_t file_bytes)
{
    const bool terse =
        !std::strcmp(request->library, "webp") || !std::strcmp(request->library, "jpeg2000");
    return terse || spec.image_bytes(true) / 4096 <= file_bytes;
}

/* The pixels of one subimage whose head is filled; what is wrong goes into *error. */
wo_status read_pixels(OIIO::ImageInput *input, const wo_child_request *request, int index,
                      uint64_t file_bytes, wo_io_part *part, wo_error *error)
{
    const OIIO::ImageSpec spec = input->spec(index);
    if (spec.width != wo_rect_width(part->data_window) ||
        spec.height != wo_rect_height(part->data_window) || spec.nchannels != part->channels)
        return failure(error, WO_ERR_FORMAT, request->shown, "its head reads differently twice");
    if (!is_plausible(request, spec, file_bytes))
        return failure(error, WO_ERR_FORMAT, request->shown,
                       "the file is too short for its picture");
    WO_TRY(wo_io_part_pixels(part, error));
    if (!input->read_image(index, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, part->pixels))
        return failure(error, WO_ERR_FORMAT, request->shown, words_of(input));
    flip_rows(part);
    return WO_OK;
}

wo_status send_parts(OIIO::ImageInput *input, const wo_child_request *request, int first,
                     uint64_t file_bytes, wo_io_file *file, const wo_child_sink *sink,
                     wo_error *error)
{
    for (size_t i = 0; i < file->part_count; i++) {
        wo_io_part *const part = &file->parts[i];
        wo_error own = {};
        const wo_status status =
            read_pixels(input, request, first + static_cast<int>(i), file_bytes, part, &own);
        if (status != WO_OK && file->part_count == 1)
            return wo_fail(error, status, "%s", own.text);
        WO_TRY(status == WO_OK ? sink->pixels(sink->to, i, part, error)
                               : sink->fault(sink->to, i, own.text, error));
        std::free(part->pixels);
        part->pixels = nullptr;
    }
    return WO_OK;
}

int count_parts(OIIO::ImageInput *input)
{
    int count = 1;
    while (count <= WO_IO_MAX_PARTS && input->seek_subimage(count, 0))
        count++;
    (void)words_of(input);
    return count;
}

wo_status read_file(const wo_child_request *request, const char *path, uint64_t file_bytes,
                    const wo_child_sink *sink, wo_io_file **file, wo_error *error)
{
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(request->library);
    if (!input)
        return failure(error, WO_ERR_UNSUPPORTED, request->shown,
                       words_of<OIIO::ImageInput>(nullptr));
    OIIO::ImageSpec spec, config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    if (!input->open(path, spec, config))
        return failure(error, WO_ERR_FORMAT, request->shown, words_of(input.get()));
    input->threads(1);

    const int first = request->part < 0 ? 0 : request->part;
    const int count = request->part < 0 ? count_parts(input.get()) : 1;
    if (count > WO_IO_MAX_PARTS)
        return wo_fail(error, WO_ERR_RANGE, "%s: more than %d pictures in one file", request->shown,
                       WO_IO_MAX_PARTS);
    WO_TRY(wo_io_file_create(static_cast<size_t>(count), file, error));
    std::free((*file)->format);
    (*file)->format = wo_io_copy_text(request->library);
    if (!(*file)->format)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for an image file");
    uint64_t bytes = 0;
    for (int i = 0; i < count; i++) {
        spec = input->spec(first + i);
        if (spec.nchannels < 1)
            return failure(error, WO_ERR_FORMAT, request->shown, words_of(input.get()));
        WO_TRY(fill_head(&(*file)->parts[i], request, spec, &bytes, error));
    }
    WO_TRY(sink->head(sink->to, *file, error));
    if (request->headers_only)
        return WO_OK;
    return send_parts(input.get(), request, first, file_bytes, *file, sink, error);
}

/* The library's exceptions on damaged files: a size that no vector can have, a place outside. */
wo_status read_guarded(const wo_child_request *request, const char *path, uint64_t file_bytes,
                       const wo_child_sink *sink, wo_io_file **file, wo_error *error)
{
    try {
        return read_file(request, path, file_bytes, sink, file, error);
    } catch (const std::bad_alloc &) {
        return wo_fail(error, WO_ERR_FORMAT,
                       "%s: the %s reader wants far more memory than the picture can need: the "
                       "file is damaged",
                       request->shown, request->extension);
    } catch (const std::length_error &) {
        return wo_fail(error, WO_ERR_FORMAT,
                       "%s: the %s reader met an impossible size: the file is damaged",
                       request->shown, request->extension);
    } catch (const std::logic_error &problem) {
        return wo_fail(error, WO_ERR_FORMAT, "%s: the %s reader gave up (%s): the file is damaged",
                       request->shown, request->extension, problem.what());
    }
}

} // namespace

extern "C" wo_status wo_io_oiio_read(const wo_child_request *request, const char *path,
                                     uint64_t file_bytes, const wo_child_sink *sink,
                                     wo_error *error)
{
    /* The library's own parallel way through TIFF strips trusts their sizes; libtiff's does not. */
    OIIO::attribute("tiff:multithread", 0);
    OIIO::attribute("threads", 1);
    wo_io_file *file = nullptr;
    const wo_status status = wo_guard(error, __func__, [&]() -> wo_status {
        return read_guarded(request, path, file_bytes, sink, &file, error);
    });
    wo_io_file_destroy(&file);
    return status;
}
