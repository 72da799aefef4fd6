/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _XOPEN_SOURCE 700
#include "image_io_private.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* Writing: to a new file beside the wanted one, then renamed over it. */

static wo_status system_failure(wo_error *error, const char *what, const char *path, int number)
{
    char words[80] = "";
    if (strerror_r(number, words, sizeof words))
        words[0] = '\0';
    return wo_fail(error, WO_ERR_IO, "cannot %s %s: %s", what, wo_io_shown(path), words);
}

static bool is_exr(const char *path)
{
    const char *const name = strrchr(path, '/');
    const char *const dot = strrchr(name ? name : path, '.');
    return dot && !strcasecmp(dot, ".exr");
}

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
    if (is_exr(path)) {
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
        return wo_fail(error, WO_ERR_UNSUPPORTED, "%s: %s holds%s%s%s samples only",
                       wo_io_shown(path), found->extension, found->has_byte ? " 8-bit" : "",
                       found->has_short ? " 16-bit" : "", found->has_single ? " float" : "");
    *format = found;
    return WO_OK;
}

/* Where a link points; a copy of path when it is none or points nowhere. NULL without memory. */
static char *final_path(const char *path)
{
    struct stat about;
    char *resolved = NULL;
    if (!lstat(path, &about) && S_ISLNK(about.st_mode))
        resolved = realpath(path, NULL);
    return resolved ? resolved : wo_io_copy_text(path);
}

/* Creates a file of a new name in the folder of path; the name is malloc-ed. */
static wo_status open_beside(const char *path, char **name, int *fd, wo_error *error)
{
    const char *const slash = strrchr(path, '/');
    const size_t folder = slash ? (size_t)(slash - path) + 1 : 0;
    const size_t size = folder + 64;
    *fd = -1;
    *name = malloc(size);
    if (!*name)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for a file name");
    memcpy(*name, path, folder);
    for (unsigned attempt = 0; attempt < 1000; attempt++) {
        struct timespec now = {0};
        clock_gettime(CLOCK_REALTIME, &now);
        snprintf(*name + folder, size - folder, ".wideopen-%ld-%lx-%u.tmp", (long)getpid(),
                 (unsigned long)now.tv_nsec, attempt);
        *fd = open(*name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (*fd >= 0)
            return WO_OK;
        if (errno != EEXIST)
            break;
    }
    const int number = errno;
    free(*name);
    *name = NULL;
    return system_failure(error, "create a file for", path, number);
}

wo_status wo_io_write(const char *path, const wo_io_part *parts, size_t part_count,
                      wo_io_depth depth, wo_error *error)
{
    const wo_io_format *format = NULL;
    WO_TRY(check_request(path, parts, part_count, depth, &format, error));

    struct stat about;
    char *const target = final_path(path);
    if (!target)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for a file name");
    const bool exists = !stat(target, &about);
    if (exists && !S_ISREG(about.st_mode)) {
        free(target);
        return wo_fail(error, WO_ERR_IO, "%s exists and is no ordinary file", wo_io_shown(path));
    }

    char *temporary = NULL;
    int fd = -1;
    wo_status status = open_beside(target, &temporary, &fd, error);
    if (status != WO_OK) {
        free(target);
        return status;
    }
    const locale_t before = wo_io_plain_locale();
    if (format)
        status = wo_io_oiio_write(path, fd, format, parts, depth, error);
    else
        status = wo_io_exr_write(path, fd, parts, part_count, depth, error);
    wo_io_restore_locale(before);
    if (status == WO_OK && exists && fchmod(fd, about.st_mode & 0777) && errno != EPERM)
        status = system_failure(error, "set the permissions of", path, errno);
    if (status == WO_OK && fsync(fd) && errno != EINVAL)
        status = system_failure(error, "write", path, errno);
    if (close(fd) && status == WO_OK)
        status = system_failure(error, "write", path, errno);
    if (status == WO_OK && rename(temporary, target))
        status = system_failure(error, "rename a finished file to", path, errno);
    if (status != WO_OK)
        unlink(temporary);
    free(temporary);
    free(target);
    return status;
}
