/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "colour.h"
#include "guard.hh"
#include "own_config.hh"

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace OCIO = OCIO_NAMESPACE;

struct wo_colour {
    OCIO::ConstConfigRcPtr config;
    std::string origin;
    std::string displays; /* "display: view, view" a line */
    std::vector<std::string> names;
};

namespace
{

std::string joined(const std::vector<std::string> &words)
{
    std::string result;
    for (const std::string &word : words)
        result += (result.empty() ? "" : ", ") + word;
    return result;
}

bool same_ignoring_case(const char *a, const char *b)
{
    for (; *a && *b; a++, b++)
        if (std::tolower(static_cast<unsigned char>(*a)) !=
            std::tolower(static_cast<unsigned char>(*b)))
            return false;
    return *a == *b;
}

std::string describe_displays(const OCIO::Config &config)
{
    std::string result;
    for (int d = 0; d < config.getNumDisplays(); d++) {
        const char *const display = config.getDisplay(d);
        std::vector<std::string> views;
        for (int v = 0; v < config.getNumViews(display); v++)
            views.emplace_back(config.getView(display, v));
        result += std::string(display) + ": " + joined(views) + "\n";
    }
    return result;
}

wo_status create(const char *config, wo_colour **colour, wo_error *error)
{
    const char *path = config && *config ? config : std::getenv("OCIO");
    auto made = std::make_unique<wo_colour>();
    /* its warnings go to stderr otherwise; OCIO_LOGGING_LEVEL brings them back */
    OCIO::SetLoggingLevel(OCIO::LOGGING_LEVEL_NONE);
    if (path && *path) {
        made->origin = path;
        made->config = OCIO::Config::CreateFromFile(path);
    } else {
        std::istringstream text(wo_own_config);
        made->origin = "built in";
        made->config = OCIO::Config::CreateFromStream(text);
    }
    for (int i = 0; i < made->config->getNumColorSpaces(); i++)
        made->names.emplace_back(made->config->getColorSpaceNameByIndex(i));
    made->displays = describe_displays(*made->config);
    if (!made->config->getColorSpace(WO_COLOUR_WORKING))
        return wo_fail(error, WO_ERR_FORMAT, "%s has no role %s", made->origin.c_str(),
                       WO_COLOUR_WORKING);
    *colour = made.release();
    return WO_OK;
}

/* Finds a colour space by name, alias or role. */
wo_status find_space(const wo_colour *colour, const char *name, OCIO::ConstColorSpaceRcPtr *space,
                     wo_error *error)
{
    if (!name || !*name)
        return wo_fail(error, WO_ERR_ARGUMENT, "no colour space was named");
    *space = colour->config->getColorSpace(name);
    if (*space)
        return WO_OK;
    return wo_fail(error, WO_ERR_NOT_FOUND, "no colour space '%.40s'; there are: %s", name,
                   joined(colour->names).c_str());
}

/* Alpha a pixel's colour is divided by; 1 where it is left alone. */
float divisor(float alpha)
{
    return alpha > 0 ? alpha : 1.0f;
}

/* Row by row, so that views with padded or upside-down rows work in place. The processor may touch
   alpha (a 4 x 4 matrix can), so that is put back. */
void apply(const OCIO::ConstCPUProcessorRcPtr &processor, wo_image *image, bool premultiplied)
{
    const int width = wo_rect_width(image->bounds), components = image->components;
    const bool alpha = components == 4;
    std::vector<float> alphas(alpha ? static_cast<size_t>(width) : 0);
    for (int32_t y = image->bounds.y1; y < image->bounds.y2; y++) {
        float *const row = wo_image_at(image, image->bounds.x1, y);
        for (size_t x = 0; x < alphas.size(); x++) {
            float *const pixel = row + 4 * x;
            alphas[x] = pixel[3];
            for (int c = 0; premultiplied && c < 3; c++)
                pixel[c] /= divisor(alphas[x]);
        }
        OCIO::PackedImageDesc desc(row, width, 1, components);
        processor->apply(desc);
        for (size_t x = 0; x < alphas.size(); x++) {
            float *const pixel = row + 4 * x;
            pixel[3] = alphas[x];
            for (int c = 0; premultiplied && c < 3; c++)
                pixel[c] *= divisor(alphas[x]);
        }
    }
}

/* The library's default takes short cuts in powers and logarithms that cost 1e-5 and more. */
OCIO::ConstCPUProcessorRcPtr exact(const OCIO::ConstProcessorRcPtr &processor)
{
    return processor->getOptimizedCPUProcessor(OCIO::BIT_DEPTH_F32, OCIO::BIT_DEPTH_F32,
                                               OCIO::OPTIMIZATION_LOSSLESS);
}

wo_status check_image(const wo_image *image, wo_error *error)
{
    WO_TRY(wo_image_validate(image, "picture", error));
    return image->data ? WO_OK : wo_fail(error, WO_ERR_ARGUMENT, "no picture to convert");
}

wo_status convert(const wo_colour *colour, const char *from, const char *to, wo_image *image,
                  bool premultiplied, wo_error *error)
{
    OCIO::ConstColorSpaceRcPtr source, target;
    WO_TRY(check_image(image, error));
    WO_TRY(find_space(colour, from, &source, error));
    WO_TRY(find_space(colour, to, &target, error));
    if (image->components == 1 || source->isData() || target->isData())
        return WO_OK;
    const OCIO::ConstProcessorRcPtr processor = colour->config->getProcessor(source, target);
    if (!processor->isNoOp())
        apply(exact(processor), image, premultiplied);
    return WO_OK;
}

bool has_display(const OCIO::Config &config, const char *name)
{
    for (int i = 0; i < config.getNumDisplays(); i++)
        if (!std::strcmp(config.getDisplay(i), name))
            return true;
    return false;
}

bool has_view(const OCIO::Config &config, const char *display, const char *name)
{
    for (int i = 0; i < config.getNumViews(display); i++)
        if (!std::strcmp(config.getView(display, i), name))
            return true;
    return false;
}

wo_status show(const wo_colour *colour, const char *from, const char *display, const char *view,
               wo_image *image, wo_error *error)
{
    const OCIO::Config &config = *colour->config;
    OCIO::ConstColorSpaceRcPtr source;
    WO_TRY(check_image(image, error));
    WO_TRY(find_space(colour, from, &source, error));
    const char *const screen = display && *display ? display : config.getDefaultDisplay();
    if (!has_display(config, screen))
        return wo_fail(error, WO_ERR_NOT_FOUND, "no display '%.40s'; there are: %s", screen,
                       colour->displays.c_str());
    const char *const look = view && *view ? view : config.getDefaultView(screen);
    if (!has_view(config, screen, look))
        return wo_fail(error, WO_ERR_NOT_FOUND, "no view '%.40s'; there are: %s", look,
                       colour->displays.c_str());
    if (image->components == 1 || source->isData())
        return WO_OK;
    const OCIO::DisplayViewTransformRcPtr transform = OCIO::DisplayViewTransform::Create();
    transform->setSrc(source->getName());
    transform->setDisplay(screen);
    transform->setView(look);
    const OCIO::ConstProcessorRcPtr processor = config.getProcessor(transform);
    if (!processor->isNoOp())
        apply(exact(processor), image, true);
    return WO_OK;
}

wo_status of_file(const wo_colour *colour, const char *path, const char *says, char *name,
                  size_t size, wo_error *error)
{
    OCIO::ConstColorSpaceRcPtr space;
    if (says && *says)
        space = colour->config->getColorSpace(says);
    if (!space && says && same_ignoring_case(says, "linear"))
        space = colour->config->getColorSpace(WO_COLOUR_WORKING);
    if (!space)
        space = colour->config->getColorSpace(colour->config->getColorSpaceFromFilepath(path));
    if (!space)
        return wo_fail(error, WO_ERR_NOT_FOUND, "%s has no rule for %.100s", colour->origin.c_str(),
                       path);
    const int length = std::snprintf(name, size, "%s", space->getName());
    return length >= 0 && static_cast<size_t>(length) < size
               ? WO_OK
               : wo_fail(error, WO_ERR_RANGE, "the name of a colour space is longer than %zu",
                         size);
}

} // namespace

extern "C" wo_status wo_colour_create(const char *config, wo_colour **colour, wo_error *error)
{
    return wo_guard(error, __func__, [&]() -> wo_status {
        *colour = nullptr;
        return create(config, colour, error);
    });
}

extern "C" void wo_colour_destroy(wo_colour **colour)
{
    if (colour) {
        delete *colour;
        *colour = nullptr;
    }
}

extern "C" const char *wo_colour_origin(const wo_colour *colour)
{
    return colour->origin.c_str();
}

extern "C" size_t wo_colour_count(const wo_colour *colour)
{
    return colour->names.size();
}

extern "C" const char *wo_colour_name(const wo_colour *colour, size_t index)
{
    return index < colour->names.size() ? colour->names[index].c_str() : nullptr;
}

extern "C" wo_status wo_colour_of_file(const wo_colour *colour, const char *path, const char *says,
                                       char *name, size_t size, wo_error *error)
{
    return wo_guard(error, __func__,
                    [&]() -> wo_status { return of_file(colour, path, says, name, size, error); });
}

extern "C" bool wo_colour_is_data(const wo_colour *colour, const char *name)
{
    return wo_guard(nullptr, __func__, [&]() -> wo_status {
               OCIO::ConstColorSpaceRcPtr space;
               WO_TRY(find_space(colour, name, &space, nullptr));
               return space->isData() ? WO_OK : WO_ERR_ARGUMENT;
           }) == WO_OK;
}

extern "C" wo_status wo_colour_convert(const wo_colour *colour, const char *from, const char *to,
                                       wo_image *image, wo_error *error)
{
    return wo_guard(error, __func__,
                    [&]() -> wo_status { return convert(colour, from, to, image, true, error); });
}

extern "C" wo_status wo_colour_convert_straight(const wo_colour *colour, const char *from,
                                                const char *to, wo_image *image, wo_error *error)
{
    return wo_guard(error, __func__,
                    [&]() -> wo_status { return convert(colour, from, to, image, false, error); });
}

extern "C" wo_status wo_colour_display(const wo_colour *colour, const char *from,
                                       const char *display, const char *view, wo_image *image,
                                       wo_error *error)
{
    return wo_guard(error, __func__,
                    [&]() -> wo_status { return show(colour, from, display, view, image, error); });
}

extern "C" int wo_colour_list_displays(const wo_colour *colour, char *buffer, size_t size)
{
    return std::snprintf(buffer, size, "%s", colour->displays.c_str());
}
