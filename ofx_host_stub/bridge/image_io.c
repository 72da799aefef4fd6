/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "image_io_private.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

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
    WO_TRY(wo_io_check_whole(path, fd, format, error));
    return wo_io_oiio_read(path, format, headers_only, file, error);
}

wo_status wo_io_read(const char *path, bool headers_only, wo_io_file **file, wo_error *error)
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
        status = wo_io_exr_read(path, fd, headers_only, file, error);
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
