/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "io_child_private.h"

#include <errno.h>
#include <fcntl.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

const char *wo_io_shown(const char *path)
{
    const size_t length = strlen(path), most = 96;
    return length > most ? path + (length - most) : path;
}

char *wo_io_copy_text(const char *text)
{
    const size_t bytes = strlen(text) + 1;
    char *const copy = malloc(bytes);
    if (copy)
        memcpy(copy, text, bytes);
    return copy;
}

static wo_status no_memory(wo_error *error)
{
    return wo_fail(error, WO_ERR_NOMEM, "no memory for an image file");
}

locale_t wo_io_plain_locale(void)
{
    const locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    return plain == (locale_t)0 ? (locale_t)0 : uselocale(plain);
}

void wo_io_restore_locale(locale_t before)
{
    if (before == (locale_t)0)
        return;
    const locale_t plain = uselocale(before);
    freelocale(plain);
}

/* Size. */

static bool within_reach(wo_rect r)
{
    const int32_t most = WO_MAX_COORDINATE;
    return r.x1 >= -most && r.y1 >= -most && r.x2 <= most && r.y2 <= most;
}

wo_status wo_io_check_size(const char *path, wo_rect data_window, wo_rect display_window,
                           int64_t channels, uint64_t *total, wo_error *error)
{
    const wo_rect windows[] = {data_window, display_window};
    for (size_t i = 0; i < WO_COUNT(windows); i++) {
        const wo_rect r = windows[i];
        const int64_t width = (int64_t)r.x2 - r.x1, height = (int64_t)r.y2 - r.y1;
        if (width < 1 || height < 1 || width > WO_MAX_SIDE || height > WO_MAX_SIDE)
            return wo_fail(error, WO_ERR_RANGE,
                           "%s: %lld x %lld pixels, but 1 to %d a side are allowed",
                           wo_io_shown(path), (long long)width, (long long)height, WO_MAX_SIDE);
        if (!within_reach(r))
            return wo_fail(error, WO_ERR_RANGE, "%s: a window lies beyond +-%d pixels",
                           wo_io_shown(path), WO_MAX_COORDINATE);
    }
    if (channels < 1 || channels > WO_IO_MAX_CHANNELS)
        return wo_fail(error, WO_ERR_RANGE, "%s: %lld channels, but 1 to %d are allowed",
                       wo_io_shown(path), (long long)channels, WO_IO_MAX_CHANNELS);
    *total += (uint64_t)wo_rect_width(data_window) * (uint64_t)wo_rect_height(data_window) *
              (uint64_t)channels * sizeof(float);
    if (*total > WO_IO_MAX_BYTES)
        return wo_fail(error, WO_ERR_RANGE, "%s: pixels need more than %llu GiB of memory",
                       wo_io_shown(path), (unsigned long long)(WO_IO_MAX_BYTES >> 30));
    return WO_OK;
}

/* Files and parts. */

void wo_io_part_clear(wo_io_part *part)
{
    if (!part)
        return;
    free(part->name);
    for (int i = 0; part->channel_names && i < part->channels; i++)
        free(part->channel_names[i]);
    free(part->channel_names);
    free(part->pixels);
    free(part->fault);
    free(part->colour_space);
    for (size_t i = 0; i < part->attribute_count; i++) {
        free(part->attributes[i].name);
        free(part->attributes[i].text);
        free(part->attributes[i].kind);
    }
    free(part->attributes);
    *part = (wo_io_part){0};
}

void wo_io_file_destroy(wo_io_file **file)
{
    if (!file || !*file)
        return;
    for (size_t i = 0; i < (*file)->part_count; i++)
        wo_io_part_clear(&(*file)->parts[i]);
    free((*file)->parts);
    free((*file)->format);
    free(*file);
    *file = NULL;
}

wo_status wo_io_file_create(size_t part_count, wo_io_file **file, wo_error *error)
{
    *file = NULL;
    if (part_count < 1 || part_count > WO_IO_MAX_PARTS)
        return wo_fail(error, WO_ERR_RANGE, "%zu parts, but a file holds 1 to %d", part_count,
                       WO_IO_MAX_PARTS);
    wo_io_file *made = calloc(1, sizeof *made);
    if (!made)
        return no_memory(error);
    made->parts = calloc(part_count, sizeof *made->parts);
    made->format = wo_io_copy_text("");
    if (made->parts)
        made->part_count = part_count;
    if (!made->parts || !made->format) {
        wo_io_file_destroy(&made);
        return no_memory(error);
    }
    *file = made;
    return WO_OK;
}

wo_status wo_io_part_head(wo_io_part *part, const char *name, wo_rect data_window,
                          wo_rect display_window, const char *const *channel_names, int channels,
                          wo_error *error)
{
    uint64_t bytes = 0;
    wo_io_part_clear(part);
    WO_TRY(wo_io_check_size(name && *name ? name : "image", data_window, display_window, channels,
                            &bytes, error));
    part->data_window = data_window;
    part->display_window = display_window;
    part->pixel_aspect = 1;
    part->bits = 32;
    part->is_float = true;
    part->name = wo_io_copy_text(name ? name : "");
    part->colour_space = wo_io_copy_text("");
    part->channel_names = calloc((size_t)channels, sizeof *part->channel_names);
    bool complete = part->name && part->colour_space && part->channel_names;
    if (part->channel_names)
        part->channels = channels;
    for (int i = 0; complete && i < channels; i++)
        complete = (part->channel_names[i] = wo_io_copy_text(channel_names[i])) != NULL;
    if (!complete) {
        wo_io_part_clear(part);
        return no_memory(error);
    }
    return WO_OK;
}

wo_status wo_io_part_pixels(wo_io_part *part, wo_error *error)
{
    const size_t count = (size_t)wo_rect_width(part->data_window) *
                         (size_t)wo_rect_height(part->data_window) * (size_t)part->channels;
    part->pixels = calloc(count, sizeof *part->pixels);
    if (!part->pixels)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for %d x %d pixels of %d channels",
                       (int)wo_rect_width(part->data_window),
                       (int)wo_rect_height(part->data_window), part->channels);
    return WO_OK;
}

wo_status wo_io_part_init(wo_io_part *part, const char *name, wo_rect data_window,
                          wo_rect display_window, const char *const *channel_names, int channels,
                          wo_error *error)
{
    WO_TRY(
        wo_io_part_head(part, name, data_window, display_window, channel_names, channels, error));
    const wo_status status = wo_io_part_pixels(part, error);
    if (status != WO_OK)
        wo_io_part_clear(part);
    return status;
}

/* Attributes. */

const wo_io_attribute *wo_io_part_find(const wo_io_part *part, const char *name)
{
    for (size_t i = 0; i < part->attribute_count; i++)
        if (!strcmp(part->attributes[i].name, name))
            return &part->attributes[i];
    return NULL;
}

wo_status wo_io_part_set(wo_io_part *part, const wo_io_attribute *attribute, wo_error *error)
{
    if (!attribute->name || !attribute->name[0])
        return wo_fail(error, WO_ERR_ARGUMENT, "an attribute needs a name");
    if (part->attribute_count >= WO_IO_MAX_ATTRIBUTES && !wo_io_part_find(part, attribute->name))
        return wo_fail(error, WO_ERR_RANGE, "more than %d attributes", WO_IO_MAX_ATTRIBUTES);
    if (attribute->type == WO_IO_TEXT && !attribute->text)
        return wo_fail(error, WO_ERR_ARGUMENT, "attribute %s has no text", attribute->name);
    wo_io_attribute made = {.type = attribute->type, .number = attribute->number};
    made.name = wo_io_copy_text(attribute->name);
    made.kind = wo_io_copy_text(attribute->kind ? attribute->kind : "");
    if (attribute->type == WO_IO_TEXT)
        made.text = wo_io_copy_text(attribute->text);
    bool complete = made.name && made.kind && (made.text || attribute->type != WO_IO_TEXT);

    size_t index = 0;
    while (index < part->attribute_count && strcmp(part->attributes[index].name, attribute->name))
        index++;
    if (complete && index == part->attribute_count) {
        wo_io_attribute *const grown =
            realloc(part->attributes, (index + 1) * sizeof *part->attributes);
        complete = grown != NULL;
        if (grown) {
            part->attributes = grown;
            grown[index] = (wo_io_attribute){0};
            part->attribute_count++;
        }
    }
    wo_io_attribute *const old = complete ? &part->attributes[index] : &made;
    free(old->name);
    free(old->text);
    free(old->kind);
    if (!complete)
        return no_memory(error);
    *old = made;
    return WO_OK;
}

wo_status wo_io_part_add(wo_io_part *part, const char *name, wo_io_type type, double number,
                         const char *text, const char *kind, wo_error *error)
{
    const wo_io_attribute attribute = {.name = (char *)(uintptr_t)name,
                                       .type = type,
                                       .number = number,
                                       .text = (char *)(uintptr_t)text,
                                       .kind = (char *)(uintptr_t)kind};
    return wo_io_part_set(part, &attribute, error);
}

wo_status wo_io_part_set_number(wo_io_part *part, const char *name, double number, wo_error *error)
{
    return wo_io_part_add(part, name, WO_IO_FLOAT, number, NULL, NULL, error);
}

wo_status wo_io_part_set_text(wo_io_part *part, const char *name, const char *text, wo_error *error)
{
    return wo_io_part_add(part, name, WO_IO_TEXT, 0, text, NULL, error);
}

/* Formats. */

const wo_io_format *wo_io_format_of(const char *path)
{
    static const wo_io_format formats[] = {
        /* extension, library's name, read, write, automatic, byte, short, single, alpha, grey */
        {"png", "png", true, true, WO_IO_BYTE, true, true, false, true, true},
        {"tif", "tiff", true, true, WO_IO_SHORT, true, true, true, true, true},
        {"tiff", "tiff", true, true, WO_IO_SHORT, true, true, true, true, true},
        {"jpg", "jpeg", true, true, WO_IO_BYTE, true, false, false, false, true},
        {"jpeg", "jpeg", true, true, WO_IO_BYTE, true, false, false, false, true},
        {"dpx", "dpx", true, true, WO_IO_AUTO, true, true, false, true, true},
        {"hdr", "hdr", true, true, WO_IO_SINGLE, false, false, true, false, false},
        {"tga", "targa", true, true, WO_IO_BYTE, true, false, false, true, true},
        {"bmp", "bmp", true, true, WO_IO_BYTE, true, false, false, false, false},
        {"ppm", "pnm", true, true, WO_IO_BYTE, true, false, false, false, false},
        {"cin", "cineon", true, false, WO_IO_AUTO, false, false, false, false, false},
        {"pgm", "pnm", true, false, WO_IO_AUTO, false, false, false, false, false},
        {"pnm", "pnm", true, false, WO_IO_AUTO, false, false, false, false, false},
        {"webp", "webp", true, false, WO_IO_AUTO, false, false, false, false, false},
        {"jp2", "jpeg2000", true, false, WO_IO_AUTO, false, false, false, false, false},
    };
    const char *const name = strrchr(path, '/');
    const char *const dot = strrchr(name ? name : path, '.');
    for (size_t i = 0; dot && i < WO_COUNT(formats); i++)
        if (!strcasecmp(dot + 1, formats[i].extension))
            return &formats[i];
    return NULL;
}

bool wo_io_is_exr(const char *path)
{
    const char *const name = strrchr(path, '/');
    const char *const dot = strrchr(name ? name : path, '.');
    return dot && !strcasecmp(dot, ".exr");
}

bool wo_io_same_format(const char *path, const char *other)
{
    const wo_io_format *const a = wo_io_format_of(path), *const b = wo_io_format_of(other);
    if (wo_io_is_exr(path) || wo_io_is_exr(other))
        return wo_io_is_exr(path) && wo_io_is_exr(other);
    return a && b && !strcmp(a->library_name, b->library_name);
}

const char *wo_io_usual_space(const char *path)
{
    static const struct {
        const char *library_name, *space;
    } unusual[] = {{"hdr", "linear"}, {"dpx", "KodakLog"}, {"cineon", "KodakLog"}};
    if (wo_io_is_exr(path))
        return "linear";
    const wo_io_format *const format = wo_io_format_of(path);
    for (size_t i = 0; format && i < WO_COUNT(unusual); i++)
        if (!strcmp(format->library_name, unusual[i].library_name))
            return unusual[i].space;
    return format ? "sRGB" : "";
}

/* Reading. */

static wo_status open_file(const char *path, int *fd, wo_error *error)
{
    char words[80] = "";
    struct stat about;
    *fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (*fd < 0) {
        if (strerror_r(errno, words, sizeof words))
            words[0] = '\0';
        return wo_fail(error, WO_ERR_IO, "cannot open %s: %s", wo_io_shown(path), words);
    }
    if (!fstat(*fd, &about) && S_ISREG(about.st_mode)) {
        if (about.st_size > 0)
            return WO_OK;
        close(*fd);
        return wo_fail(error, WO_ERR_FORMAT, "%s is empty", wo_io_shown(path));
    }
    close(*fd);
    return wo_fail(error, WO_ERR_IO, "%s is no ordinary file", wo_io_shown(path));
}

static wo_status read_other(const char *path, int fd, const wo_io_format *format, bool headers_only,
                            wo_io_file **file, wo_error *error)
{
    uint64_t promised;
    WO_TRY(wo_io_check_whole(path, fd, format, &promised, error));
    WO_TRY(wo_io_read_apart(path, fd, format, headers_only, promised, file, error));
    for (size_t i = 0; i < (*file)->part_count; i++)
        WO_TRY(wo_io_part_upright(&(*file)->parts[i], error));
    return WO_OK;
}

/* Reads a file, or of an EXR a view of it when image is not NULL. */
static wo_status read_any(const char *path, bool headers_only, const char *channels,
                          wo_io_file **file, wo_image *image, size_t *part, wo_error *error)
{
    static const unsigned char exr_mark[4] = {0x76, 0x2f, 0x31, 0x01};
    unsigned char mark[4] = {0};
    int fd = -1;

    *file = NULL;
    if (!path || !path[0])
        return wo_fail(error, WO_ERR_ARGUMENT, "no file name was given");
    WO_TRY(open_file(path, &fd, error));
    const locale_t before = wo_io_plain_locale();
    wo_status status;
    const wo_io_format *const format = wo_io_format_of(path);
    const ssize_t got = pread(fd, mark, sizeof mark, 0);
    if (got == (ssize_t)sizeof mark && !memcmp(mark, exr_mark, sizeof mark))
        status = image ? wo_io_exr_read_view(path, fd, channels, file, image, part, error)
                       : wo_io_exr_read(path, fd, headers_only, file, error);
    else if (got < 0)
        status = wo_fail(error, WO_ERR_IO, "cannot read %s", wo_io_shown(path));
    else if (format)
        status = read_other(path, fd, format, headers_only, file, error);
    else
        status = wo_fail(error, WO_ERR_FORMAT,
                         "%s is no EXR, and its extension is none of png tif tiff jpg jpeg dpx cin "
                         "hdr tga bmp ppm pgm pnm webp jp2",
                         wo_io_shown(path));
    wo_io_restore_locale(before);
    close(fd);
    if (status != WO_OK)
        wo_io_file_destroy(file);
    return status;
}

wo_status wo_io_read(const char *path, bool headers_only, wo_io_file **file, wo_error *error)
{
    return read_any(path, headers_only, NULL, file, NULL, NULL, error);
}

wo_status wo_io_read_view(const char *path, const char *channels, wo_io_file **file,
                          wo_image *image, size_t *part, wo_error *error)
{
    const wo_io_part *chosen = NULL;
    *image = (wo_image){0};
    *part = 0;
    WO_TRY(read_any(path, false, channels, file, image, part, error));
    if (image->data)
        return WO_OK;
    const wo_status status = wo_io_select(*file, channels, image, &chosen, error);
    if (status != WO_OK) {
        wo_io_file_destroy(file);
        return status;
    }
    *part = (size_t)(chosen - (*file)->parts);
    for (size_t i = 0; i < (*file)->part_count; i++) {
        free((*file)->parts[i].pixels);
        (*file)->parts[i].pixels = NULL;
    }
    return WO_OK;
}
