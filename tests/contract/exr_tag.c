/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "bridge/image_io.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* exr_tag IN OUT [NAME=VALUE | NAME::KIND=VALUE]...
   Copies an EXR file; every part gets these attributes and loses all others. VALUE is a float
   where it is a number and no KIND is given. KIND: text, or what wo_io_attribute.kind takes. */

static wo_status tag(wo_io_part *part, char *word, wo_error *error)
{
    char *const value = strchr(word, '=');
    if (!value)
        return wo_fail(error, WO_ERR_ARGUMENT, "%s has no =", word);
    *value = '\0';
    char *const kind = strstr(word, "::");
    if (kind)
        *kind = '\0';
    char *end;
    const double number = strtod(value + 1, &end);
    const bool plain = !kind || strcmp(kind + 2, "text") == 0;
    const wo_io_attribute attribute = {
        .name = word,
        .type = !kind && end != value + 1 && *end == '\0' ? WO_IO_FLOAT : WO_IO_TEXT,
        .number = number,
        .text = value + 1,
        .kind = plain ? NULL : kind + 2,
    };
    const wo_status status = wo_io_part_set(part, &attribute, error);
    if (kind)
        *kind = ':';
    *value = '=';
    return status;
}

static wo_status run(int argc, char **argv, wo_io_file **file, wo_error *error)
{
    WO_TRY(wo_io_read(argv[1], false, file, error));
    for (size_t i = 0; i < (*file)->part_count; i++) {
        wo_io_part *const part = &(*file)->parts[i];
        for (size_t k = 0; k < part->attribute_count; k++) {
            free(part->attributes[k].name);
            free(part->attributes[k].text);
            free(part->attributes[k].kind);
        }
        part->attribute_count = 0;
        for (int k = 3; k < argc; k++)
            WO_TRY(tag(part, argv[k], error));
    }
    return wo_io_write(argv[2], (*file)->parts, (*file)->part_count, WO_IO_AUTO, error);
}

int main(int argc, char **argv)
{
    wo_error error = {0};
    wo_io_file *file = NULL;
    if (argc < 3)
        return 2;
    const wo_status status = run(argc, argv, &file, &error);
    wo_io_file_destroy(&file);
    if (status != WO_OK)
        fprintf(stderr, "exr_tag: %s\n", error.text);
    return status != WO_OK;
}
