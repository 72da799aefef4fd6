/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_IO_OIIO_PRIVATE_HH
#define WO_BRIDGE_IO_OIIO_PRIVATE_HH

/* What io_oiio_read.cc and io_oiio_write.cc share. */
#include "image_io_private.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <string>

inline std::string one_line(std::string words)
{
    std::replace(words.begin(), words.end(), '\n', ' ');
    while (!words.empty() && words.back() == ' ')
        words.pop_back();
    return words.empty() ? "the image library gives no reason" : words;
}

/* The library keeps its words per thread and per reader: fetched at once, both places emptied. */
template <typename Object>
std::string words_of(Object *object)
{
    const std::string general = OIIO::geterror();
    const std::string own = object ? object->geterror() : std::string();
    return one_line(own.empty() ? general : own);
}

inline wo_status failure(wo_error *error, wo_status status, const char *path,
                         const std::string &words)
{
    return wo_fail(error, status, "%s: %s", wo_io_shown(path), words.c_str());
}

inline int bits_of(const OIIO::ImageSpec &spec)
{
    const int said = spec.get_int_attribute("oiio:BitsPerSample", 0);
    return said > 0 && said <= 32 ? said : static_cast<int>(spec.format.size() * 8);
}

#endif
