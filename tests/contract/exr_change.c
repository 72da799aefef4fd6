/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "bridge/image_io.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* exr_change IN OUT [WORD=NUMBER]...
   Copies an EXR file, changed: aspect=A says pixels of that aspect, columns=N and rows=N keep the
   last of every N (of a data window from 0 on), times=F multiplies channels called Z. */

static void thin_out(wo_io_part *part, int32_t columns, int32_t rows)
{
    const int32_t old = wo_rect_width(part->data_window);
    const int32_t w = old / columns, h = wo_rect_height(part->data_window) / rows;
    const size_t n = (size_t)part->channels;
    for (int32_t y = 0; y < h; y++)
        for (int32_t x = 0; x < w; x++)
            memmove(part->pixels + (size_t)(y * w + x) * n,
                    part->pixels +
                        (size_t)((y * rows + rows - 1) * old + x * columns + columns - 1) * n,
                    n * sizeof(float));
    part->data_window = part->display_window = (wo_rect){0, 0, w, h};
}

static void multiply(wo_io_part *part, float factor)
{
    const size_t pixels =
        (size_t)wo_rect_width(part->data_window) * (size_t)wo_rect_height(part->data_window);
    for (int c = 0; c < part->channels; c++) {
        const char *const dot = strrchr(part->channel_names[c], '.');
        if (strcmp(dot ? dot + 1 : part->channel_names[c], "Z") != 0)
            continue;
        for (size_t i = 0; i < pixels; i++)
            part->pixels[i * (size_t)part->channels + (size_t)c] *= factor;
    }
}

static bool change(wo_io_part *part, const char *word)
{
    const char *const value = strchr(word, '=');
    const double number = value ? atof(value + 1) : 0;
    if (number == 0)
        return false;
    if (strncmp(word, "aspect=", 7) == 0)
        part->pixel_aspect = number;
    else if (strncmp(word, "columns=", 8) == 0)
        thin_out(part, (int32_t)number, 1);
    else if (strncmp(word, "rows=", 5) == 0)
        thin_out(part, 1, (int32_t)number);
    else if (strncmp(word, "times=", 6) == 0)
        multiply(part, (float)number);
    else
        return false;
    return true;
}

static wo_status run(int argc, char **argv, wo_io_file **file, wo_error *error)
{
    WO_TRY(wo_io_read(argv[1], false, file, error));
    for (size_t i = 0; i < (*file)->part_count; i++)
        for (int k = 3; k < argc; k++)
            if (!change(&(*file)->parts[i], argv[k]))
                return wo_fail(error, WO_ERR_ARGUMENT, "what is %s?", argv[k]);
    return wo_io_write(argv[2], (*file)->parts, (*file)->part_count, WO_IO_SINGLE, error);
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
        fprintf(stderr, "exr_change: %s\n", error.text);
    return status != WO_OK;
}
