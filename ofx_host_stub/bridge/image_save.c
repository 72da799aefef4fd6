/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _XOPEN_SOURCE 700
#include "image_io_private.h"
#include "new_file.h"

/* Writing: into a file that appears when it is complete. */

static wo_status check_part(const char *path, const wo_io_part *part, uint64_t *bytes,
                            wo_error *error)
{
    if (!part->pixels || !part->channel_names)
        return wo_fail(error, WO_ERR_ARGUMENT, "%s: a part without pixels cannot be written",
                       wo_io_shown(path));
    WO_TRY(wo_io_check_size(path, part->data_window, part->display_window, part->channels, bytes,
                            error));
    for (int i = 0; i < part->channels; i++)
        if (!part->channel_names[i] || !part->channel_names[i][0])
            return wo_fail(error, WO_ERR_ARGUMENT, "%s: channel %d has no name", wo_io_shown(path),
                           i);
    return WO_OK;
}

static wo_status check_request(const char *path, const wo_io_part *parts, size_t part_count,
                               wo_io_depth depth, const wo_io_format **format, wo_error *error)
{
    uint64_t bytes = 0;
    *format = NULL;
    if (!path || !path[0])
        return wo_fail(error, WO_ERR_ARGUMENT, "no file name was given");
    if (!parts || part_count < 1 || part_count > WO_IO_MAX_PARTS)
        return wo_fail(error, WO_ERR_ARGUMENT, "%s: %zu parts, but a file holds 1 to %d",
                       wo_io_shown(path), part_count, WO_IO_MAX_PARTS);
    for (size_t i = 0; i < part_count; i++)
        WO_TRY(check_part(path, &parts[i], &bytes, error));
    if (wo_io_is_exr(path)) {
        if (depth == WO_IO_BYTE || depth == WO_IO_SHORT)
            return wo_fail(error, WO_ERR_UNSUPPORTED, "%s: EXR holds half or float, no integers",
                           wo_io_shown(path));
        return WO_OK;
    }

    const wo_io_format *const found = wo_io_format_of(path);
    if (!found || !found->writable)
        return wo_fail(error, WO_ERR_UNSUPPORTED,
                       "%s: its extension is none of exr png tif tiff jpg jpeg dpx hdr tga bmp ppm",
                       wo_io_shown(path));
    if (part_count > 1)
        return wo_fail(error, WO_ERR_UNSUPPORTED, "%s: %zu parts need EXR", wo_io_shown(path),
                       part_count);
    if (parts[0].channels > 4)
        return wo_fail(error, WO_ERR_UNSUPPORTED,
                       "%s: %d channels need EXR, %s takes 1 to 4; select some", wo_io_shown(path),
                       parts[0].channels, found->extension);
    const bool fits = depth == WO_IO_AUTO || (depth == WO_IO_BYTE && found->has_byte) ||
                      (depth == WO_IO_SHORT && found->has_short) ||
                      (depth == WO_IO_SINGLE && found->has_single);
    if (!fits)
        return wo_fail(
            error, WO_ERR_UNSUPPORTED, "%s: the samples of %s are %s%s%s only; see --bits",
            wo_io_shown(path), found->extension, found->has_byte ? "8" : "",
            found->has_short ? (found->has_byte ? " or 16" : "16") : "",
            found->has_single ? (found->has_byte || found->has_short ? " or float" : "float") : "");
    *format = found;
    return WO_OK;
}

wo_status wo_io_write(const char *path, const wo_io_part *parts, size_t part_count,
                      wo_io_depth depth, wo_error *error)
{
    const wo_io_format *format = NULL;
    wo_new_file file;
    WO_TRY(check_request(path, parts, part_count, depth, &format, error));
    WO_TRY(wo_new_file_begin(path, &file, error));
    const locale_t before = wo_io_plain_locale();
    const wo_status status = format
                                 ? wo_io_oiio_write(path, file.fd, format, parts, depth, error)
                                 : wo_io_exr_write(path, file.fd, parts, part_count, depth, error);
    wo_io_restore_locale(before);
    return wo_new_file_end(&file, status, error);
}
