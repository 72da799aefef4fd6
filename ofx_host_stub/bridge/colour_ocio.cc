/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "colour.h"
#include "colour_apply.hh"
#include "guard.hh"
#include "image_io.h"
#include "own_config.hh"

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <sstream>
#include <string>
#include <unistd.h>
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
        const int missing = access(path, R_OK) == 0 ? 0 : errno;
        if (missing && std::strncmp(path, "ocio://", 7) != 0)
            return wo_fail(
                error, WO_ERR_LIBRARY, "cannot read the OpenColorIO configuration %s%s: %s", path,
                config && *config ? "" : " of the variable OCIO", std::strerror(missing));
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

/* What the configuration calls a standard space, or nothing. */
OCIO::ConstColorSpaceRcPtr find_standard(const OCIO::Config &config,
                                         const wo_colour_standard &standard)
{
    OCIO::ConstColorSpaceRcPtr space;
    if (*standard.id)
        space = config.getColorSpace(standard.id);
    for (size_t i = 0; !space && i < WO_COUNT(standard.names) && standard.names[i]; i++)
        space = config.getColorSpace(standard.names[i]);
    return space;
}

/* Finds a colour space by name, alias, role or standard. */
wo_status find_space(const wo_colour *colour, const char *name, OCIO::ConstColorSpaceRcPtr *space,
                     wo_error *error)
{
    if (!name || !*name)
        return wo_fail(error, WO_ERR_ARGUMENT, "no colour space was named");
    *space = colour->config->getColorSpace(name);
    if (*space)
        return WO_OK;
    const wo_colour_standard *const standard = wo_colour_standard_named(name);
    if (standard)
        *space = find_standard(*colour->config, *standard);
    if (*space)
        return WO_OK;
    return wo_fail(error, WO_ERR_NOT_FOUND, "no colour space '%.40s'; there are: %s", name,
                   joined(colour->names).c_str());
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
    const OCIO::Config &config = *colour->config;
    const OCIO::ConstProcessorRcPtr processor = config.getProcessor(source, target);
    if (processor->isNoOp())
        return WO_OK;
    const bool decodes =
        !wo_is_linear(config.getProcessor(source, config.getColorSpace(WO_COLOUR_WORKING)));
    wo_apply(processor, image,
             !premultiplied ? WO_APPLY_PLAIN
             : decodes      ? WO_APPLY_DECODE
                            : WO_APPLY_ENCODE);
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
        wo_apply(processor, image, WO_APPLY_ENCODE);
    return WO_OK;
}

wo_status put_name(const OCIO::ColorSpace &space, char *name, size_t size, wo_error *error)
{
    const int length = std::snprintf(name, size, "%s", space.getName());
    return length >= 0 && static_cast<size_t>(length) < size
               ? WO_OK
               : wo_fail(error, WO_ERR_RANGE, "the name of a colour space is longer than %zu",
                         size);
}

const wo_colour_standard *standard_of(const OCIO::ColorSpace &space)
{
    const wo_colour_standard *found = wo_colour_standard_named(space.getName());
    for (size_t i = 0; !found && i < space.getNumAliases(); i++)
        found = wo_colour_standard_named(space.getAlias(i));
    return found ? found : space.isData() ? wo_colour_standard_named("data") : nullptr;
}

OCIO::ConstColorSpaceRcPtr space_of_word(const wo_colour *colour, const char *word)
{
    OCIO::ConstColorSpaceRcPtr space;
    if (same_ignoring_case(word, "linear"))
        return colour->config->getColorSpace(WO_COLOUR_WORKING);
    (void)find_space(colour, word, &space, nullptr);
    return space;
}

/* What the file itself says, or nothing. */
OCIO::ConstColorSpaceRcPtr space_told(const wo_colour *colour, const char *format_holds,
                                      const wo_colour_words &says)
{
    OCIO::ConstColorSpaceRcPtr space;
    for (size_t i = 0; i < WO_COUNT(says.words) && says.words[i] && !space; i++)
        if (*says.words[i] && !same_ignoring_case(says.words[i], format_holds) &&
            !same_ignoring_case(says.words[i], "unknown"))
            space = space_of_word(colour, says.words[i]);
    if (!space && says.has_primaries) {
        const wo_colour_standard *const standard = wo_colour_standard_by_primaries(says.primaries);
        if (standard && standard != wo_colour_standard_named("lin_rec709_scene"))
            space = find_standard(*colour->config, *standard);
    }
    return space;
}

wo_status of_file(const wo_colour *colour, const char *path, const wo_colour_words *says,
                  char *name, size_t size, wo_colour_ground *ground, wo_error *error)
{
    const OCIO::Config &config = *colour->config;
    const char *const format_holds = wo_io_usual_space(path);
    const wo_colour_words nothing = {};
    wo_colour_ground why = WO_COLOUR_TOLD;
    OCIO::ConstColorSpaceRcPtr space = space_told(colour, format_holds, says ? *says : nothing);
    if (!space && !config.filepathOnlyMatchesDefaultRule(path)) {
        why = WO_COLOUR_RULE;
        space = config.getColorSpace(config.getColorSpaceFromFilepath(path));
    }
    if (!space) {
        const bool linear = same_ignoring_case(format_holds, "linear");
        why = WO_COLOUR_ASSUMED;
        if (*format_holds && !linear)
            space = space_of_word(colour, format_holds);
        if (!space)
            space = config.getColorSpace(config.getColorSpaceFromFilepath(path));
        if (linear && (!space || space->isData()))
            space = config.getColorSpace(WO_COLOUR_WORKING);
    }
    if (ground)
        *ground = why;
    if (!space)
        return wo_fail(error, WO_ERR_NOT_FOUND, "%s has no rule for %.100s", colour->origin.c_str(),
                       path);
    return put_name(*space, name, size, error);
}

} // namespace

extern "C" wo_status wo_colour_create(const char *config, wo_colour **colour, wo_error *error)
{
    return wo_guard(error, "the OpenColorIO configuration", [&]() -> wo_status {
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

extern "C" bool wo_colour_find(const wo_colour *colour, const char *word, char *name, size_t size)
{
    return wo_guard(nullptr, __func__, [&]() -> wo_status {
               const OCIO::ConstColorSpaceRcPtr space = space_of_word(colour, word);
               return space ? put_name(*space, name, size, nullptr) : WO_ERR_NOT_FOUND;
           }) == WO_OK;
}

extern "C" const wo_colour_standard *wo_colour_standard_of(const wo_colour *colour,
                                                           const char *name)
{
    const wo_colour_standard *found = nullptr;
    const wo_status status = wo_guard(nullptr, __func__, [&]() -> wo_status {
        OCIO::ConstColorSpaceRcPtr space;
        WO_TRY(find_space(colour, name, &space, nullptr));
        found = standard_of(*space);
        return WO_OK;
    });
    return status == WO_OK ? found : nullptr;
}

extern "C" wo_status wo_colour_of_file(const wo_colour *colour, const char *path,
                                       const wo_colour_words *says, char *name, size_t size,
                                       wo_colour_ground *ground, wo_error *error)
{
    return wo_guard(error, __func__, [&]() -> wo_status {
        return of_file(colour, path, says, name, size, ground, error);
    });
}

extern "C" bool wo_colour_is_same(const wo_colour *colour, const char *a, const char *b)
{
    return wo_guard(nullptr, __func__, [&]() -> wo_status {
               OCIO::ConstColorSpaceRcPtr first, second;
               WO_TRY(find_space(colour, a, &first, nullptr));
               WO_TRY(find_space(colour, b, &second, nullptr));
               return std::strcmp(first->getName(), second->getName()) ? WO_ERR_ARGUMENT : WO_OK;
           }) == WO_OK;
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
