/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "io_exr_private.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Whose call runs in this thread. The library complains while it holds the lock of its context, so
   the context cannot be asked for its user's data. */
static _Thread_local wo_exr_stream *current;

void wo_exr_begin(wo_exr_stream *stream)
{
    current = stream;
}

void wo_exr_end(void)
{
    current = NULL;
}

static void note_words(exr_const_context_t exr, exr_result_t result, const char *words)
{
    (void)exr;
    (void)result;
    if (current && !current->words[0] && words)
        snprintf(current->words, sizeof current->words, "%s", words);
}

static int64_t read_bytes(exr_const_context_t exr, void *user, void *buffer, uint64_t bytes,
                          uint64_t offset, exr_stream_error_func_ptr_t complain)
{
    wo_exr_stream *const stream = user;
    uint64_t done = 0;
    (void)exr;
    (void)complain;
    if (offset > INT64_MAX || bytes > INT64_MAX)
        return -1;
    while (done < bytes) {
        const uint64_t left = bytes - done, piece = left < (1u << 30) ? left : (1u << 30);
        const ssize_t got =
            pread(stream->fd, (char *)buffer + done, (size_t)piece, (off_t)(offset + done));
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0) {
            if (!stream->system_error)
                stream->system_error = errno;
            return -1;
        }
        if (got == 0)
            break;
        done += (uint64_t)got;
    }
    return (int64_t)done;
}

static int64_t write_bytes(exr_const_context_t exr, void *user, const void *buffer, uint64_t bytes,
                           uint64_t offset, exr_stream_error_func_ptr_t complain)
{
    wo_exr_stream *const stream = user;
    uint64_t done = 0;
    (void)exr;
    (void)complain;
    while (done < bytes) {
        const uint64_t left = bytes - done, piece = left < (1u << 30) ? left : (1u << 30);
        const ssize_t put =
            pwrite(stream->fd, (const char *)buffer + done, (size_t)piece, (off_t)(offset + done));
        if (put < 0 && errno == EINTR)
            continue;
        if (put <= 0) {
            if (!stream->system_error)
                stream->system_error = put < 0 ? errno : EIO;
            return -1;
        }
        done += (uint64_t)put;
    }
    return (int64_t)done;
}

static int64_t file_size(exr_const_context_t exr, void *user)
{
    (void)exr;
    return ((const wo_exr_stream *)user)->size;
}

void *wo_exr_get(size_t bytes)
{
    void *const memory = calloc(1, bytes ? bytes : 1);
    if (!memory && current)
        current->no_memory = true;
    return memory;
}

void *wo_exr_get_buffer(exr_transcoding_pipeline_buffer_id_t which, size_t bytes)
{
    (void)which;
    return wo_exr_get(bytes);
}

void wo_exr_put_buffer(exr_transcoding_pipeline_buffer_id_t which, void *memory)
{
    (void)which;
    free(memory);
}

exr_context_initializer_t wo_exr_settings(wo_exr_stream *stream)
{
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.error_handler_fn = note_words;
    settings.alloc_fn = wo_exr_get;
    settings.free_fn = free;
    settings.user_data = stream;
    settings.read_fn = read_bytes;
    settings.size_fn = file_size;
    settings.write_fn = write_bytes;
    settings.zip_level = 4;
    return settings;
}

wo_status wo_exr_failure(const wo_exr_stream *stream, exr_result_t result, wo_error *error)
{
    const char *const path = wo_io_shown(stream->path);
    if (stream->system_error) {
        char words[80] = "";
        if (strerror_r(stream->system_error, words, sizeof words))
            words[0] = '\0';
        return wo_fail(error, WO_ERR_IO, "%s: %s", path, words);
    }
    wo_status status = WO_ERR_FORMAT;
    if (stream->no_memory || result == EXR_ERR_OUT_OF_MEMORY)
        status = WO_ERR_NOMEM;
    else if (result == EXR_ERR_FEATURE_NOT_IMPLEMENTED)
        status = WO_ERR_UNSUPPORTED;
    return wo_fail(error, status, "%s: %s", path,
                   stream->words[0] ? stream->words : exr_get_default_error_message(result));
}
