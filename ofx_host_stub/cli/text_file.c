/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "text_file.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static wo_status failure(wo_error *error, const char *verb, const char *path, int number)
{
    return wo_fail(error, WO_ERR_IO, "cannot %s %s: %s", verb, path, strerror(number));
}

wo_status wo_text_read(const char *path, size_t limit, char **text, size_t *length, wo_error *error)
{
    *text = NULL;
    FILE *const in = fopen(path, "rb");
    if (!in)
        return failure(error, "read", path, errno);
    char *const buffer = malloc(limit + 1);
    if (!buffer) {
        fclose(in);
        return wo_fail(error, WO_ERR_NOMEM, "out of memory for %s", path);
    }
    errno = 0;
    *length = fread(buffer, 1, limit, in);
    const bool more = *length == limit && fgetc(in) != EOF;
    const int number = ferror(in) ? (errno ? errno : EIO) : 0;
    fclose(in);
    if (number || more) {
        free(buffer);
        return number ? failure(error, "read", path, number)
                      : wo_fail(error, WO_ERR_RANGE, "%s is longer than %zu bytes", path, limit);
    }
    buffer[*length] = '\0';
    *text = buffer;
    return WO_OK;
}

wo_status wo_text_save(const char *path, const char *text, size_t length, wo_error *error)
{
    char name[PATH_MAX];
    struct stat info;
    const bool direct = lstat(path, &info) == 0 && !S_ISREG(info.st_mode);
    const int used = direct ? snprintf(name, sizeof name, "%s", path)
                            : snprintf(name, sizeof name, "%s.%ld.tmp", path, (long)getpid());
    if (used < 0 || (size_t)used >= sizeof name)
        return failure(error, "write", path, ENAMETOOLONG);
    FILE *const out = fopen(name, "wb");
    if (!out)
        return failure(error, "write", path, errno);
    const bool complete = fwrite(text, 1, length, out) == length;
    const int write_number = errno;
    const bool closed = fclose(out) == 0;
    if (complete && closed && (direct || rename(name, path) == 0))
        return WO_OK;
    const int number = complete ? errno : write_number;
    if (!direct)
        remove(name);
    return failure(error, "write", path, number);
}
