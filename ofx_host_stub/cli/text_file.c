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
    *out = (wo_text_out){.path = path};
    out->direct = stat(path, &info) == 0 && !S_ISREG(info.st_mode);
    if (out->direct) {
        out->file = fopen(path, "wb");
        return out->file ? WO_OK : failure(error, "write", path, errno);
    }
    WO_TRY(wo_new_file_begin(path, &out->there, error));
    const int own = dup(out->there.fd); /* is closed with the stream, before the file is ended */
    out->file = own >= 0 ? fdopen(own, "wb") : NULL;
    if (out->file)
        return WO_OK;
    const wo_status status = failure(error, "write", path, errno);
    if (own >= 0)
        close(own);
    return wo_new_file_end(&out->there, status, error);
}

wo_status wo_text_end(wo_text_out *out, wo_error *error)
{
    const int before = errno; /* of a write that failed on the way */
    const bool complete = !ferror(out->file);
    const bool closed = fclose(out->file) == 0;
    const wo_status status =
        complete && closed ? WO_OK : failure(error, "write", out->path, complete ? errno : before);
    return out->direct ? status : wo_new_file_end(&out->there, status, error);
}

wo_status wo_text_save(const char *path, const char *text, size_t length, wo_error *error)
{
    wo_text_out out;
    WO_TRY(wo_text_begin(&out, path, error));
    fwrite(text, 1, length, out.file);
    return wo_text_end(&out, error);
}
