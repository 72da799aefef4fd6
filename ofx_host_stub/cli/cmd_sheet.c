/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "args.h"
#include "bridge/picture.h"
#include "command.h"
#include "picture_file.h"

#include <stdlib.h>
#include <string.h>

enum { CELLS_MAX = 128 };

static const wo_option options[] = {
    {"--output", "-o", "FILE", "Where the sheet goes: png, jpg, tif ...", false},
    {"--title", NULL, "TEXT", "Line on top.", false},
    {"--subtitle", NULL, "TEXT", "Smaller line under the title.", false},
    {"--columns", NULL, "N", "Pictures in a row, 1..128; about as many as there are rows.", false},
    {"--width", NULL, "N", "Width of each picture in pixels, 16..8192; 480.", false},
    {"--ocio", NULL, "FILE",
     "OpenColorIO configuration; otherwise that of the variable OCIO, otherwise WideOpen's own.",
     false},
};

static const wo_usage usage = {
    .command = "sheet",
    .synopsis = "CAPTION=FILE ... -o FILE",
    .about = "Puts pictures side by side, each under the first shape's size, with captions below. "
             "A | in a caption starts its second line. FILE is FILE[:CHANNELS][*FACTOR]; FACTOR "
             "brings numbers into what can be seen. Without FILE the place stays empty.",
    .positionals = "CAPTION=FILE",
    .positionals_min = 1,
    .positionals_max = CELLS_MAX,
    .options = options,
    .option_count = WO_COUNT(options),
    .after = "Example:\n  wideopen sheet \"pinhole=a.exr\" \"lens|256 rays=b.exr\" -o sheet.png\n",
};

typedef struct sheet {
    const wo_args *args;
    wo_colour *colour;
    wo_image images[CELLS_MAX];
    char captions[CELLS_MAX][2][128];
    wo_picture_cell cells[CELLS_MAX];
    size_t count;
} sheet;

/* Cuts "*FACTOR" off the end of a name; 1 where there is none. */
static float take_factor(char *name)
{
    char *const star = strrchr(name, '*');
    if (!star || !star[1])
        return 1;
    char *end;
    const float factor = strtof(star + 1, &end);
    if (*end)
        return 1;
    *star = '\0';
    return factor;
}

static wo_status load(sheet *s, const char *text, wo_image *image, wo_error *error)
{
    char *const name = strdup(text);
    if (!name)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for a name");
    const float factor = take_factor(name);
    const wo_status status = wo_picture_load(s->colour, NULL, name, image, error);
    free(name);
    if (status != WO_OK)
        return status;
    const int32_t samples = wo_rect_width(image->bounds) * image->components;
    for (int32_t y = image->bounds.y1; y < image->bounds.y2; y++) {
        float *const row = wo_image_at(image, image->bounds.x1, y);
        for (int32_t i = 0; i < samples; i++)
            row[i] *= factor;
    }
    return WO_OK;
}

static int add_cell(sheet *s, const char *text)
{
    const char *const equals = strchr(text, '=');
    if (!equals)
        return wo_usage_fault("sheet", "\"%s\" must be CAPTION=FILE", text);
    const size_t length = (size_t)(equals - text);
    const size_t first = strcspn(text, "|") < length ? strcspn(text, "|") : length;
    const size_t i = s->count;
    snprintf(s->captions[i][0], sizeof s->captions[i][0], "%.*s", (int)first, text);
    if (first < length)
        snprintf(s->captions[i][1], sizeof s->captions[i][1], "%.*s", (int)(length - first - 1),
                 text + first + 1);
    wo_error error = {0};
    if (equals[1] && load(s, equals + 1, &s->images[i], &error) != WO_OK)
        return wo_failure(&error);
    s->cells[i] =
        (wo_picture_cell){equals[1] ? &s->images[i] : NULL,
                          true,
                          {s->captions[i][0], *s->captions[i][1] ? s->captions[i][1] : NULL}};
    s->count++;
    return WO_EXIT_OK;
}

static int make(sheet *s)
{
    const wo_args *const args = s->args;
    const char *const path = wo_args_value(args, "--output", 0);
    wo_picture_layout layout = {.title = wo_args_value(args, "--title", 0),
                                .subtitle = wo_args_value(args, "--subtitle", 0)};
    if (!path)
        return wo_usage_fault("sheet", "where should the sheet go? give -o FILE");
    if (!wo_args_int(args, "--columns", 1, CELLS_MAX, &layout.columns) ||
        !wo_args_int(args, "--width", 16, 8192, &layout.cell_width))
        return WO_EXIT_USAGE;
    wo_error error = {0};
    if (wo_colour_create(wo_args_value(args, "--ocio", 0), &s->colour, &error) != WO_OK)
        return wo_failure(&error);
    for (int i = 0; i < args->positional_count; i++) {
        const int code = add_cell(s, args->positionals[i]);
        if (code != WO_EXIT_OK)
            return code;
    }
    wo_image result = {0};
    wo_status status = wo_picture_sheet(&layout, s->cells, s->count, &result, &error);
    if (status == WO_OK)
        status = wo_picture_save(path, &result, &error);
    free(result.data);
    return status == WO_OK ? WO_EXIT_OK : wo_failure(&error);
}

static int run(const wo_args *args)
{
    sheet *const s = calloc(1, sizeof *s);
    if (!s) {
        wo_message("out of memory for the sheet");
        return WO_EXIT_FAILURE;
    }
    s->args = args;
    const int code = make(s);
    for (size_t i = 0; i < CELLS_MAX; i++)
        free(s->images[i].data);
    wo_colour_destroy(&s->colour);
    free(s);
    return code;
}

int wo_cmd_sheet(int argc, char **argv)
{
    wo_args args;
    int code = wo_args_read(&args, &usage, argc, argv);
    if (code == WO_EXIT_OK && args.help)
        wo_args_help(&usage, stdout);
    else if (code == WO_EXIT_OK)
        code = run(&args);
    wo_args_free(&args);
    return code;
}
