/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "text_file.h"

#include <errno.h>
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

wo_status wo_text_begin(wo_text_out *out, const char *path, wo_error *error)
{
    struct stat info;
    out->path = path;
    out->direct = lstat(path, &info) == 0 && !S_ISREG(info.st_mode);
    const int used =
        out->direct ? snprintf(out->name, sizeof out->name, "%s", path)
                    : snprintf(out->name, sizeof out->name, "%s.%ld.tmp", path, (long)getpid());
    if (used < 0 || (size_t)used >= sizeof out->name)
        return failure(error, "write", path, ENAMETOOLONG);
    out->file = fopen(out->name, "wb");
    return out->file ? WO_OK : failure(error, "write", path, errno);
}

wo_status wo_text_end(wo_text_out *out, wo_error *error)
{
    const int write_number = errno;
    const bool complete = !ferror(out->file);
    const bool closed = fclose(out->file) == 0;
    if (complete && closed && (out->direct || rename(out->name, out->path) == 0))
        return WO_OK;
    const int number = complete ? errno : write_number;
    if (!out->direct)
        remove(out->name);
    return failure(error, "write", out->path, number);
}

wo_status wo_text_save(const char *path, const char *text, size_t length, wo_error *error)
{
    wo_text_out out;
    WO_TRY(wo_text_begin(&out, path, error));
    fwrite(text, 1, length, out.file);
    return wo_text_end(&out, error);
}
