/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "render_output.h"

#include "bridge/colour_label.h"

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
    if (stat(path, &info) == 0 && !S_ISREG(info.st_mode))
        return wo_fail(error, WO_ERR_IO, "cannot write %s: it exists and is no ordinary file",
                       path);
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
static bool is_storage(const wo_io_attribute *attribute)
{
    static const char *const names[] = {"compression", "wideopen:flattenedDeep", "wideopen:madeBy"};
    return strncmp(attribute->name, "oiio:", 5) == 0 ||
           is_one_of(attribute->name, names, WO_COUNT(names));
}

static wo_status copy_attributes(const wo_output *output, const wo_io_part *header,
                                 wo_io_part *part, wo_error *error)
{
    for (size_t i = 0; header && i < header->attribute_count; i++)
        if (!is_storage(&header->attributes[i]) && !wo_label_is_one(header->attributes[i].name))
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

/* Do the configuration's rules treat the names alike? */
static bool ruled_alike(const wo_colour *colour, const char *a, const char *b)
{
    char first[256], second[256];
    return wo_label_space(colour, a, NULL, first, sizeof first, NULL, NULL) == WO_OK &&
           wo_label_space(colour, b, NULL, second, sizeof second, NULL, NULL) == WO_OK &&
           strcmp(first, second) == 0;
}

static wo_status choose_space(const wo_output *output, const wo_origin *origin, wo_written *written,
                              wo_error *error)
{
    const char *const space = output->space ? output->space
                              : origin && origin->space &&
                                      wo_io_same_format(origin->path, written->path) &&
                                      ruled_alike(output->colour, origin->path, written->path)
                                  ? origin->space
                                  : NULL;
    if (!space)
        return wo_label_space(output->colour, written->path, NULL, written->space,
                              sizeof written->space, NULL, error);
    snprintf(written->space, sizeof written->space, "%s", space);
    return WO_OK;
}

/* How colour lies beside alpha in a format. */
typedef enum alpha_kind {
    ALPHA_MULTIPLIED, /* as codes */
    ALPHA_STRAIGHT,
    ALPHA_SILENT /* the format has none or says nothing of it: light is multiplied, then encoded */
} alpha_kind;

static alpha_kind alpha_of(const char *path, const wo_origin *origin)
{
    static const char *const straight[] = {"png", "tga"}, *const either[] = {"tif", "tiff"};
    const char *const ending = extension(path);
    if (is_one_of(ending, straight, WO_COUNT(straight)))
        return ALPHA_STRAIGHT;
    if (strcasecmp(ending, "exr") == 0)
        return ALPHA_MULTIPLIED;
    if (!is_one_of(ending, either, WO_COUNT(either)))
        return ALPHA_SILENT;
    const wo_io_attribute *const said =
        origin && wo_io_same_format(origin->path, path)
            ? wo_io_part_find(origin->header, "oiio:UnassociatedAlpha")
            : NULL;
    return said && said->type != WO_IO_TEXT && said->number != 0 ? ALPHA_STRAIGHT
                                                                 : ALPHA_MULTIPLIED;
}

static wo_status convert(const wo_output *output, const char *space, alpha_kind alpha,
                         wo_image *image, wo_error *error)
{
    if (alpha == ALPHA_MULTIPLIED)
        return wo_colour_convert(output->colour, WO_COLOUR_WORKING, space, image, error);
    if (alpha == ALPHA_STRAIGHT)
        wo_io_unpremultiply(image);
    return wo_colour_convert_straight(output->colour, WO_COLOUR_WORKING, space, image, error);
}

static wo_status label(const wo_output *output, const wo_origin *origin, bool raw,
                       const wo_written *written, wo_io_part *part, wo_error *error)
{
    const bool kept =
        origin && !origin->forced &&
        (raw ? !origin->space
             : origin->space && wo_colour_is_same(output->colour, origin->space, written->space));
    WO_TRY(copy_attributes(output, origin ? origin->header : NULL, part, error));
    return wo_label_part(output->colour, raw ? NULL : written->space, origin ? origin->path : NULL,
                         kept ? origin->header : NULL, part, error);
}

/* Samples that half cannot hold, where the file is in half. */
static int64_t count_cut(const wo_output *output, const wo_image *image, const char *path)
{
    const float most = 65504;
    int64_t count = 0;
    if (strcasecmp(extension(path), "exr") != 0 ||
        (output->depth != WO_IO_AUTO && output->depth != WO_IO_HALF))
        return 0;
    for (int32_t y = image->bounds.y1; y < image->bounds.y2; y++) {
        const float *const row = wo_image_at(image, image->bounds.x1, y);
        const size_t samples = (size_t)wo_rect_width(image->bounds) * (size_t)image->components;
        for (size_t i = 0; i < samples; i++)
            count += row[i] > most || row[i] < -most;
    }
    return count;
}

/* Would the file be read in another space? Only asked where it is not in that of its name. */
static bool is_unsaid(const wo_output *output, const wo_written *written)
{
    char found[256];
    wo_io_file *file = NULL;
    if (wo_label_space(output->colour, written->path, NULL, found, sizeof found, NULL, NULL) ==
            WO_OK &&
        wo_colour_is_same(output->colour, found, written->space))
        return false;
    const bool same = wo_io_read(written->path, true, &file, NULL) == WO_OK &&
                      wo_label_space(output->colour, written->path, &file->parts[0], found,
                                     sizeof found, NULL, NULL) == WO_OK &&
                      wo_colour_is_same(output->colour, found, written->space);
    wo_io_file_destroy(&file);
    return !same;
}

wo_status wo_output_write(const wo_output *output, int frame, wo_image *image, wo_rect display,
                          const wo_origin *origin, bool raw, wo_written *written, wo_error *error)
{
    *written = (wo_written){.space = "raw"};
    WO_TRY(wo_io_frame_path(output->pattern, frame, written->path, sizeof written->path, error));
    const alpha_kind alpha = alpha_of(written->path, origin);
    if (!raw) {
        WO_TRY(choose_space(output, origin, written, error));
        WO_TRY(convert(output, written->space, alpha, image, error));
    }
    written->cut = count_cut(output, image, written->path);
    wo_io_part part = {0};
    wo_status status = fill_part(&part, image, display, error);
    if (status == WO_OK)
        status = label(output, origin, raw, written, &part, error);
    if (status == WO_OK && alpha == ALPHA_STRAIGHT)
        status = wo_io_part_set_number(&part, "oiio:UnassociatedAlpha", 1, error);
    if (status == WO_OK)
        status = wo_io_write(written->path, &part, 1, output->depth, error);
    wo_io_part_clear(&part);
    if (status == WO_OK && !raw)
        written->unsaid = is_unsaid(output, written);
    return status;
}
