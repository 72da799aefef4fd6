/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "guard.hh"
#include "image_io_private.h"
#include "io_oiio_private.hh"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

namespace
{

/* The library writes through this, so that a full disk is noticed whatever a format's writer does
   with its return values. */
class Drain final : public OIIO::Filesystem::IOProxy
{
  public:
    explicit Drain(const char *path, int fd) : IOProxy(path, Write), m_fd(fd) {}
    /* "file" would have writers take this for a class with a FILE in it */
    const char *proxytype() const override { return "descriptor"; }
    size_t write(const void *buffer, size_t size) override
    {
        const size_t done = pwrite(buffer, size, m_pos);
        m_pos += static_cast<int64_t>(done);
        return done;
    }
    size_t pwrite(const void *buffer, size_t size, int64_t offset) override
    {
        size_t done = 0;
        while (done < size) {
            const ssize_t put = ::pwrite(m_fd, static_cast<const char *>(buffer) + done,
                                         size - done, offset + static_cast<int64_t>(done));
            if (put < 0 && errno == EINTR)
                continue;
            if (put <= 0) {
                if (!m_failure)
                    m_failure = put < 0 ? errno : EIO;
                break;
            }
            done += static_cast<size_t>(put);
        }
        m_size = std::max(m_size, static_cast<size_t>(offset) + done);
        return done;
    }
    /* Some writers read back what they wrote. */
    size_t read(void *buffer, size_t size) override
    {
        const size_t done = pread(buffer, size, m_pos);
        m_pos += static_cast<int64_t>(done);
        return done;
    }
    size_t pread(void *buffer, size_t size, int64_t offset) override
    {
        const ssize_t got = ::pread(m_fd, buffer, size, offset);
        return got > 0 ? static_cast<size_t>(got) : 0;
    }
    size_t size() const override { return m_size; }
    int failure() const { return m_failure; }

  private:
    int m_fd;
    int m_failure = 0;
    size_t m_size = 0;
};

/* Clipped and rounded to one of the steps an integer format has; the library cuts 10 bits out of
   16 without rounding. */
float quantised(float value, float steps)
{
    return value >= 0.0f ? std::round(std::min(value, 1.0f) * steps) / steps : 0.0f;
}

/* The display window of the part, top row first, cut to channels, ready for the library. steps 0
   leaves the values alone. */
std::vector<float> picture_of(const wo_io_part *part, int channels, float steps)
{
    const wo_rect window = part->display_window, data = part->data_window;
    const wo_rect seen = wo_rect_intersect(window, data);
    const auto width = static_cast<size_t>(wo_rect_width(window));
    const auto height = static_cast<size_t>(wo_rect_height(window));
    const auto data_width = static_cast<size_t>(wo_rect_width(data));
    const auto from_stride = static_cast<size_t>(part->channels);
    const auto to_stride = static_cast<size_t>(channels);
    std::vector<float> pixels(width * height * to_stride, 0.0f);

    for (int32_t y = seen.y1; y < seen.y2; y++) {
        const float *from = part->pixels + (static_cast<size_t>(y - data.y1) * data_width +
                                            static_cast<size_t>(seen.x1 - data.x1)) *
                                               from_stride;
        float *to = pixels.data() + (static_cast<size_t>(window.y2 - 1 - y) * width +
                                     static_cast<size_t>(seen.x1 - window.x1)) *
                                        to_stride;
        for (int32_t x = seen.x1; x < seen.x2; x++, from += from_stride, to += to_stride)
            for (size_t c = 0; c < to_stride; c++) {
                const float value = from[std::min(c, from_stride - 1)];
                to[c] = steps > 0 ? quantised(value, steps) : value;
            }
    }
    return pixels;
}

/* To the nearest colour that HDR's three bytes and one exponent hold; the library cuts. */
void round_to_shared_exponent(std::vector<float> *pixels)
{
    for (size_t i = 0; i + 2 < pixels->size(); i += 3) {
        float *const pixel = pixels->data() + i;
        const float most = std::max({pixel[0], pixel[1], pixel[2]});
        int exponent = 0;
        if (!(most > 1e-32f) || std::isinf(most))
            continue;
        const float mantissa = std::frexp(most, &exponent);
        const int bits = mantissa * 256 + 0.5f >= 256 ? exponent - 7 : exponent - 8;
        for (int c = 0; c < 3; c++)
            if (pixel[c] > 0)
                pixel[c] = std::ldexp(std::floor(std::ldexp(pixel[c], -bits) + 0.5f), bits);
    }
}

OIIO::ImageSpec spec_of(const wo_io_part *part, const wo_io_format *format, int channels,
                        wo_io_depth depth)
{
    const wo_io_depth chosen = depth == WO_IO_AUTO ? format->automatic : depth;
    const OIIO::TypeDesc type = chosen == WO_IO_BYTE     ? OIIO::TypeDesc::UINT8
                                : chosen == WO_IO_SINGLE ? OIIO::TypeDesc::FLOAT
                                                         : OIIO::TypeDesc::UINT16;
    OIIO::ImageSpec spec(wo_rect_width(part->display_window), wo_rect_height(part->display_window),
                         channels, type);
    if (chosen == WO_IO_AUTO)
        spec.attribute("oiio:BitsPerSample", 10);
    for (size_t i = 0; i < part->attribute_count; i++) {
        const wo_io_attribute *const a = &part->attributes[i];
        const std::string name = a->name;
        if (name.compare(0, 5, "oiio:") == 0 || name.compare(0, 5, "tiff:") == 0 ||
            name.compare(0, 4, "dpx:") == 0 || name == "compression" || a->kind[0])
            continue;
        if (a->type == WO_IO_TEXT)
            spec.attribute(name, a->text);
        else if (a->type == WO_IO_INT)
            spec.attribute(name, static_cast<int>(std::lrint(a->number)));
        else
            spec.attribute(name, static_cast<float>(a->number));
    }
    if (part->pixel_aspect > 0 && part->pixel_aspect < 1e6)
        spec.attribute("PixelAspectRatio", static_cast<float>(part->pixel_aspect));
    if (part->colour_space && part->colour_space[0])
        spec.attribute("oiio:ColorSpace", part->colour_space);
    spec.alpha_channel = channels == 4 ? 3 : channels == 2 ? 1 : -1;
    /* Values go out as they are. TIFF can say which kind of alpha it holds; for the others the
       hint keeps the library from dividing. */
    const wo_io_attribute *const separate = wo_io_part_find(part, "oiio:UnassociatedAlpha");
    const bool is_tiff = !std::strcmp(format->library_name, "tiff");
    if (!is_tiff || (separate && separate->number != 0))
        spec.attribute("oiio:UnassociatedAlpha", 1);
    if (!std::strcmp(format->library_name, "jpeg"))
        spec.attribute("Compression", "jpeg:95");
    if (!std::strcmp(format->library_name, "png"))
        spec.attribute("png:compressionLevel", 4); /* half the time of 6, a tenth larger */
    return spec;
}

int channels_written(const wo_io_part *part, const wo_io_format *format)
{
    int channels = part->channels;
    /* the library ends the program over a DPX of grey and alpha */
    const bool no_grey_alpha = channels == 2 && !std::strcmp(format->library_name, "dpx");
    if ((!format->has_alpha && (channels == 2 || channels == 4)) || no_grey_alpha)
        channels--;
    return channels == 1 && !format->has_grey ? 3 : channels;
}

/* TIFF's writer reads back what it wrote when metadata has a directory of its own, and does so only
   from a file it opened by name: this one is in memory. */
class Scratch final
{
  public:
    Scratch() : m_fd(memfd_create("tiff", MFD_CLOEXEC))
    {
        if (m_fd < 0)
            throw std::system_error(errno, std::generic_category(), "no memory for a file");
    }
    Scratch(const Scratch &) = delete;
    Scratch &operator=(const Scratch &) = delete;
    ~Scratch() { close(m_fd); }
    std::string name() const { return "/proc/self/fd/" + std::to_string(m_fd); }
    void copy_to(Drain *drain) const
    {
        std::vector<char> buffer(1 << 20);
        for (int64_t at = 0;;) {
            const ssize_t got = pread(m_fd, buffer.data(), buffer.size(), at);
            if (got < 0 && errno == EINTR)
                continue;
            if (got <= 0 || drain->pwrite(buffer.data(), static_cast<size_t>(got), at) == 0)
                return;
            at += got;
        }
    }

  private:
    int m_fd;
};

/* False, with the library's words, when it did not succeed. */
bool put_image(const wo_io_format *format, const OIIO::ImageSpec &spec, const float *pixels,
               const std::string &name, Drain *drain, std::string *words)
{
    const std::unique_ptr<OIIO::ImageOutput> output =
        OIIO::ImageOutput::create(format->library_name);
    if (!output || (drain && !output->supports("ioproxy"))) {
        *words = words_of(output.get());
        return false;
    }
    output->threads(1);
    if (drain)
        output->set_ioproxy(drain);
    const bool written = output->open(name, spec) &&
                         output->write_image(OIIO::TypeDesc::FLOAT, pixels) && output->close();
    if (!written)
        *words = words_of(output.get());
    return written;
}

wo_status write_file(const char *path, int fd, const wo_io_format *format, const wo_io_part *part,
                     wo_io_depth depth, wo_error *error)
{
    const int channels = channels_written(part, format);
    const OIIO::ImageSpec spec = spec_of(part, format, channels, depth);
    const float steps =
        spec.format.is_floating_point() ? 0.0f : static_cast<float>((1u << bits_of(spec)) - 1);
    std::vector<float> pixels = picture_of(part, channels, steps);
    if (!std::strcmp(format->library_name, "hdr"))
        round_to_shared_exponent(&pixels);
    Drain drain(path, fd);
    std::string words;
    bool written;
    if (!std::strcmp(format->library_name, "tiff")) {
        const Scratch scratch;
        errno = 0;
        written = put_image(format, spec, pixels.data(), scratch.name(), nullptr, &words);
        /* its writer does not always tell */
        if (errno == EFBIG || errno == ENOSPC || errno == EDQUOT)
            return failure(error, WO_ERR_IO, path, std::generic_category().message(errno));
        if (written)
            scratch.copy_to(&drain);
    } else {
        written = put_image(format, spec, pixels.data(), std::string("image.") + format->extension,
                            &drain, &words);
    }
    (void)OIIO::geterror();
    if (drain.failure())
        return failure(error, WO_ERR_IO, path, std::generic_category().message(drain.failure()));
    return written ? WO_OK : failure(error, WO_ERR_LIBRARY, path, words);
}

} // namespace

extern "C" wo_status wo_io_oiio_write(const char *path, int fd, const wo_io_format *format,
                                      const wo_io_part *part, wo_io_depth depth, wo_error *error)
{
    return wo_guard(error, __func__, [&]() -> wo_status {
        return write_file(path, fd, format, part, depth, error);
    });
}
