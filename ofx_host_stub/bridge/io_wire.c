/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "io_child_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Both ends are of one program and run on one machine: numbers go as they lie in memory. */

uint64_t wo_child_memory(uint64_t picture, uint64_t file)
{
    return ((uint64_t)256 << 20) + 3 * picture + 2 * file;
}

unsigned wo_child_seconds(uint64_t picture)
{
    return 10 + (unsigned)(picture >> 24);
}

unsigned wo_child_wall_seconds(uint64_t picture)
{
    return 30 + 4 * wo_child_seconds(picture);
}

/* To bytes. */

static bool put(wo_wire *wire, const void *from, size_t bytes)
{
    if (wire->used + bytes > wire->size) {
        const size_t size = 2 * (wire->used + bytes) + 4096;
        unsigned char *const grown = realloc(wire->bytes, size);
        if (!grown)
            return false;
        wire->bytes = grown;
        wire->size = size;
    }
    memcpy(wire->bytes + wire->used, from, bytes);
    wire->used += bytes;
    return true;
}

static bool put_text(wo_wire *wire, const char *text)
{
    const uint32_t length = text ? (uint32_t)strlen(text) : 0;
    return put(wire, &length, sizeof length) && put(wire, text ? text : "", length);
}

static bool put_attribute(wo_wire *wire, const wo_io_attribute *attribute)
{
    const int32_t type = (int32_t)attribute->type;
    return put(wire, &type, sizeof type) && put_text(wire, attribute->name) &&
           put_text(wire, attribute->kind) && put_text(wire, attribute->text) &&
           put(wire, &attribute->number, sizeof attribute->number);
}

static bool put_part(wo_wire *wire, const wo_io_part *part)
{
    const int32_t numbers[3] = {part->channels, part->bits, part->is_float};
    const uint32_t attributes = (uint32_t)part->attribute_count;
    bool complete = put_text(wire, part->name) &&
                    put(wire, &part->data_window, sizeof part->data_window) &&
                    put(wire, &part->display_window, sizeof part->display_window) &&
                    put(wire, &part->pixel_aspect, sizeof part->pixel_aspect) &&
                    put(wire, numbers, sizeof numbers) && put_text(wire, part->colour_space);
    for (int i = 0; complete && i < part->channels; i++)
        complete = put_text(wire, part->channel_names[i]);
    complete = complete && put(wire, &attributes, sizeof attributes);
    for (uint32_t i = 0; complete && i < attributes; i++)
        complete = put_attribute(wire, &part->attributes[i]);
    return complete;
}

wo_status wo_wire_put_file(const wo_io_file *file, wo_wire *wire, wo_error *error)
{
    const uint32_t parts = (uint32_t)file->part_count;
    bool complete = put(wire, &parts, sizeof parts) && put_text(wire, file->format);
    for (uint32_t i = 0; complete && i < parts; i++)
        complete = put_part(wire, &file->parts[i]);
    if (!complete)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for the head of a file");
    return WO_OK;
}

/* And back. The sender may be a process whose memory a damaged file has spoilt. */

static wo_status garbled(wo_error *error)
{
    return wo_fail(error, WO_ERR_FORMAT, "the image library's words make no sense");
}

static wo_status get(wo_wire *wire, void *to, size_t bytes, wo_error *error)
{
    if (bytes > wire->size - wire->used)
        return garbled(error);
    memcpy(to, wire->bytes + wire->used, bytes);
    wire->used += bytes;
    return WO_OK;
}

/* A text, malloc-ed in place of *text. */
static wo_status get_text(wo_wire *wire, char **text, wo_error *error)
{
    uint32_t length = 0;
    WO_TRY(get(wire, &length, sizeof length, error));
    if (length > wire->size - wire->used)
        return garbled(error);
    char *const made = malloc((size_t)length + 1);
    if (!made)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for the head of a file");
    memcpy(made, wire->bytes + wire->used, length);
    wire->used += length;
    made[length] = '\0';
    free(*text);
    *text = made;
    return WO_OK;
}

static wo_status get_attribute(wo_wire *wire, wo_io_part *part, wo_error *error)
{
    wo_io_attribute made = {.name = NULL};
    int32_t type = 0;
    WO_TRY(get(wire, &type, sizeof type, error));
    wo_status status = get_text(wire, &made.name, error);
    if (status == WO_OK)
        status = get_text(wire, &made.kind, error);
    if (status == WO_OK)
        status = get_text(wire, &made.text, error);
    if (status == WO_OK)
        status = get(wire, &made.number, sizeof made.number, error);
    if (status == WO_OK && (type < WO_IO_INT || type > WO_IO_TEXT || !made.name[0]))
        status = garbled(error);
    if (status == WO_OK) {
        made.type = (wo_io_type)type;
        status = wo_io_part_set(part, &made, error);
    }
    free(made.name);
    free(made.kind);
    free(made.text);
    return status;
}

static wo_status get_names(wo_wire *wire, char **names, int count, wo_error *error)
{
    for (int i = 0; i < count; i++)
        WO_TRY(get_text(wire, &names[i], error));
    return WO_OK;
}

static wo_status get_part(const char *path, wo_wire *wire, wo_io_part *part, uint64_t *bytes,
                          wo_error *error)
{
    wo_rect data, display;
    double aspect;
    int32_t numbers[3];
    uint32_t attributes = 0;
    char *name = NULL, *space = NULL;
    WO_TRY(get_text(wire, &name, error));
    wo_status status = get(wire, &data, sizeof data, error);
    if (status == WO_OK)
        status = get(wire, &display, sizeof display, error);
    if (status == WO_OK)
        status = get(wire, &aspect, sizeof aspect, error);
    if (status == WO_OK)
        status = get(wire, numbers, sizeof numbers, error);
    if (status == WO_OK)
        status = get_text(wire, &space, error);
    if (status == WO_OK)
        status = wo_io_check_size(path, data, display, numbers[0], bytes, error);
    char **const names = status == WO_OK ? calloc((size_t)numbers[0], sizeof *names) : NULL;
    if (status == WO_OK && !names)
        status = wo_fail(error, WO_ERR_NOMEM, "no memory for the head of a file");
    if (status == WO_OK)
        status = get_names(wire, names, numbers[0], error);
    if (status == WO_OK)
        status = wo_io_part_head(part, name, data, display, (const char *const *)names, numbers[0],
                                 error);
    for (int i = 0; names && i < numbers[0]; i++)
        free(names[i]);
    free((void *)names);
    free(name);
    if (status != WO_OK) {
        free(space);
        return status;
    }
    free(part->colour_space);
    part->colour_space = space;
    part->pixel_aspect = isfinite(aspect) && aspect > 0 && aspect < 1e6 ? aspect : 1;
    part->bits = numbers[1] > 0 && numbers[1] <= 64 ? numbers[1] : 32;
    part->is_float = numbers[2] != 0;
    WO_TRY(get(wire, &attributes, sizeof attributes, error));
    for (uint32_t i = 0; i < attributes; i++)
        WO_TRY(get_attribute(wire, part, error));
    return WO_OK;
}

wo_status wo_wire_get_file(const char *path, wo_wire *wire, wo_io_file **file, wo_error *error)
{
    uint32_t parts = 0;
    uint64_t bytes = 0;
    *file = NULL;
    WO_TRY(get(wire, &parts, sizeof parts, error));
    WO_TRY(wo_io_file_create(parts, file, error));
    wo_status status = get_text(wire, &(*file)->format, error);
    for (uint32_t i = 0; status == WO_OK && i < parts; i++)
        status = get_part(path, wire, &(*file)->parts[i], &bytes, error);
    if (status == WO_OK && wire->used != wire->size)
        status = garbled(error);
    if (status != WO_OK)
        wo_io_file_destroy(file);
    return status;
}
