/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "render_output.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *extension(const char *path)
{
    const char *const slash = strrchr(path, '/');
    const char *const dot = strrchr(slash ? slash : path, '.');
    return dot ? dot + 1 : "";
}

static bool is_one_of(const char *word, const char *const *words, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (strcasecmp(word, words[i]) == 0)
            return true;
    return false;
}

static wo_status check_folder(const char *path, wo_error *error)
{
    char folder[PATH_MAX] = ".";
    const char *const slash = strrchr(path, '/');
    if (slash)
        snprintf(folder, sizeof folder, "%.*s", slash == path ? 1 : (int)(slash - path), path);
    struct stat info;
    if (stat(folder, &info) != 0 || !S_ISDIR(info.st_mode))
        return wo_fail(error, WO_ERR_IO, "cannot write %s: there is no folder %s; make it first",
                       path, folder);
    if (access(folder, W_OK) != 0)
        return wo_fail(error, WO_ERR_IO, "cannot write %s: the folder %s is write-protected", path,
                       folder);
    return WO_OK;
}

wo_status wo_output_check(const wo_output *output, int frame, wo_error *error)
{
    static const char *const writable[] = {"exr", "png", "tif", "tiff", "jpg", "jpeg",
                                           "dpx", "hdr", "tga", "bmp",  "ppm"};
    char path[PATH_MAX];
    WO_TRY(wo_io_frame_path(output->pattern, frame, path, sizeof path, error));
    if (!is_one_of(extension(path), writable, WO_COUNT(writable)))
        return wo_fail(error, WO_ERR_UNSUPPORTED,
                       "cannot write %s: its extension must be one of exr png tif tiff jpg jpeg "
                       "dpx hdr tga bmp ppm",
                       path);
    if (strcasecmp(extension(path), "exr") == 0 &&
        (output->depth == WO_IO_BYTE || output->depth == WO_IO_SHORT))
        return wo_fail(error, WO_ERR_UNSUPPORTED,
                       "cannot write %s: EXR holds half or float, no integers; see --bits", path);
    return check_folder(path, error);
}

/* Attributes that say how the input file was stored, not what it shows. */
static bool is_storage(const wo_io_attribute *attribute, bool space_changed)
{
    static const char *const names[] = {"compression", "wideopen:flattenedDeep", "wideopen:madeBy"};
    return strncmp(attribute->name, "oiio:", 5) == 0 ||
           is_one_of(attribute->name, names, WO_COUNT(names)) ||
           (space_changed && strcmp(attribute->name, "chromaticities") == 0);
}

static wo_status copy_attributes(const wo_output *output, const wo_io_part *header,
                                 const char *space, wo_io_part *part, wo_error *error)
{
    const bool space_changed = header && strcmp(header->colour_space, space) != 0;
    for (size_t i = 0; header && i < header->attribute_count; i++)
        if (!is_storage(&header->attributes[i], space_changed))
            WO_TRY(wo_io_part_set(part, &header->attributes[i], error));
    if (header)
        part->pixel_aspect = header->pixel_aspect;
    return wo_io_part_set_text(part, "wideopen:madeBy", output->made_by, error);
}

static wo_status fill_part(wo_io_part *part, const wo_image *image, wo_rect display,
                           wo_error *error)
{
    static const char *const names[2][4] = {{"R", "G", "B", "A"}, {"Y", NULL, NULL, NULL}};
    const int components = image->components;
    WO_TRY(wo_io_part_init(part, NULL, image->bounds, display, names[components == 1], components,
                           error));
    const size_t row = (size_t)wo_rect_width(image->bounds) * (size_t)components;
    for (int y = image->bounds.y1; y < image->bounds.y2; y++)
        memcpy(part->pixels + (size_t)(y - image->bounds.y1) * row,
               wo_image_at(image, image->bounds.x1, y), row * sizeof(float));
    return WO_OK;
}

static wo_status convert(const wo_output *output, const char *path, const char *space,
                         wo_image *image, bool raw, wo_error *error)
{
    static const char *const straight[] = {"png", "tga"}; /* formats with unmultiplied colour */
    if (!raw)
        WO_TRY(wo_colour_convert(output->colour, WO_COLOUR_WORKING, space, image, error));
    if (!raw && image->components == 4 && is_one_of(extension(path), straight, WO_COUNT(straight)))
        wo_io_unpremultiply(image);
    return WO_OK;
}

wo_status wo_output_write(const wo_output *output, int frame, wo_image *image, wo_rect display,
                          const wo_io_part *header, bool raw, char *path, size_t path_size,
                          wo_error *error)
{
    char space[256] = "raw";
    WO_TRY(wo_io_frame_path(output->pattern, frame, path, path_size, error));
    if (!raw && output->space)
        snprintf(space, sizeof space, "%s", output->space);
    else if (!raw)
        WO_TRY(wo_colour_of_file(output->colour, path, "", space, sizeof space, error));
    WO_TRY(convert(output, path, space, image, raw, error));
    wo_io_part part = {0};
    wo_status status = fill_part(&part, image, display, error);
    if (status == WO_OK)
        status = copy_attributes(output, header, space, &part, error);
    if (status == WO_OK)
        status = wo_io_write(path, &part, 1, output->depth, error);
    wo_io_part_clear(&part);
    return status;
}
