/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "args.h"
#include "bridge/picture.h"
#include "command.h"
#include "picture_file.h"

#include <inttypes.h>
#include <stdlib.h>

static const wo_option options[] = {
    {"--json", NULL, NULL, "Print JSON; what is infinite (PSNR of equal pictures) becomes null.",
     false},
    {"--crop", NULL, "N", "Leave out a border of N pixels.", false},
    {"--diff", NULL, "FILE", "Save a picture of the difference in false colour, with its scale.",
     false},
    {"--limit", NULL, "X",
     "Difference at the end of that scale, in sRGB values, 0.001..1; the largest one present.",
     false},
    {"--in-space", NULL, "NAME",
     "Colour space of both files; otherwise by the rules of the colour configuration.", false},
    {"--ocio", NULL, "FILE",
     "OpenColorIO configuration; otherwise that of the variable OCIO, otherwise WideOpen's own.",
     false},
};

static const wo_usage usage = {
    .command = "compare",
    .synopsis = "REF OUT [--json] [--crop N] [--diff FILE]",
    .about =
        "Says how far OUT is from REF; both are FILE[:CHANNELS], of one size, or OUT covers REF "
        "and "
        "what lies around it is not compared. Red, green and blue count, alpha does not.\n"
        "relmse: mean of (out - ref)^2 / (ref^2 + 0.01). psnr: dB, values clipped to 0..1 and put "
        "on the sRGB curve; psnr_lin: clipped only. ssim: of the luma of the former, 11 x 11 "
        "Gaussian of sigma 1.5. max_error: largest absolute difference. energy: sum of OUT over "
        "sum of REF. nonfinite: samples of OUT that are NaN or infinite; if there are any, the "
        "rest means nothing and the exit code is 1.",
    .positionals = "REF OUT",
    .positionals_min = 2,
    .positionals_max = 2,
    .options = options,
    .option_count = WO_COUNT(options),
    .after = "Example:\n  wideopen compare reference.exr out.exr --crop 35 --diff difference.png\n",
};

static int print_result(const wo_args *args, const wo_picture_error *result)
{
    if (wo_args_count(args, "--json")) {
        char json[1024];
        const int length = wo_picture_json(result, json, sizeof json);
        if (length < 0 || (size_t)length >= sizeof json)
            return WO_EXIT_FAILURE;
        puts(json);
    } else if (result->nonfinite == 0) {
        printf("relmse %.6g  psnr %.3f  psnr_lin %.3f  ssim %.5f  max_error %.6g  energy %.6g  "
               "nonfinite 0\n",
               result->relmse, result->psnr, result->psnr_lin, result->ssim, result->max_error,
               result->energy);
    } else {
        printf("nonfinite %" PRId64 "\n", result->nonfinite);
    }
    if (result->nonfinite == 0)
        return WO_EXIT_OK;
    wo_message("%s holds %" PRId64 " samples that are no finite numbers", args->positionals[1],
               result->nonfinite);
    return WO_EXIT_FAILURE;
}

static wo_status save_difference(const wo_image *ref, const wo_image *out, double limit,
                                 const char *path, wo_error *error)
{
    wo_image shown = {0};
    WO_TRY(wo_picture_show_difference(ref, out, WO_DIFFERENCE_MAGNITUDE, limit, &shown, error));
    const wo_status status = wo_picture_save(path, &shown, error);
    free(shown.data);
    return status;
}

/* The border goes, so that the difference shown is the difference counted. */
static bool crop_view(wo_image *image, int crop)
{
    const wo_rect inner = wo_rect_grow(image->bounds, -crop, -crop);
    if (wo_rect_empty(inner))
        return false;
    image->data = wo_image_at(image, inner.x1, inner.y1);
    image->bounds = inner;
    return true;
}

static int compare(const wo_args *args, wo_image ref, wo_image out)
{
    int crop = 0;
    double limit = 0;
    wo_error error = {0};
    wo_picture_error result;
    if (!wo_args_int(args, "--crop", 0, 65536, &crop) ||
        !wo_args_double(args, "--limit", 0.001, 1, &limit))
        return WO_EXIT_USAGE;
    const int width = wo_rect_width(ref.bounds), height = wo_rect_height(ref.bounds);
    if (wo_rect_contains(out.bounds, ref.bounds)) {
        out.data = wo_image_at(&out, ref.bounds.x1, ref.bounds.y1);
        out.bounds = ref.bounds;
    }
    if (width != wo_rect_width(out.bounds) || height != wo_rect_height(out.bounds)) {
        wo_message("sizes differ: %s is %dx%d, %s is %dx%d", args->positionals[0], width, height,
                   args->positionals[1], wo_rect_width(out.bounds), wo_rect_height(out.bounds));
        return WO_EXIT_FAILURE;
    }
    if (!crop_view(&ref, crop) || !crop_view(&out, crop)) {
        wo_message("--crop %d leaves nothing of %dx%d pixels", crop, width, height);
        return WO_EXIT_FAILURE;
    }
    if (wo_picture_compare(&ref, &out, 0, &result, &error) != WO_OK)
        return wo_failure(&error);
    const int code = print_result(args, &result);
    const char *const path = wo_args_value(args, "--diff", 0);
    if (path && save_difference(&ref, &out, limit, path, &error) != WO_OK)
        return wo_failure(&error);
    return code;
}

static int run(const wo_args *args)
{
    const char *const space = wo_args_value(args, "--in-space", 0);
    wo_colour *colour = NULL;
    wo_image ref = {0}, out = {0};
    wo_error error = {0};
    int code;
    if (wo_colour_create(wo_args_value(args, "--ocio", 0), &colour, &error) != WO_OK)
        return wo_failure(&error);
    if (wo_picture_check_space(colour, space, &error) != WO_OK)
        code = wo_usage_fault("compare", "--in-space: %s", error.text);
    else if (wo_picture_load(colour, space, args->positionals[0], &ref, &error) != WO_OK ||
             wo_picture_load(colour, space, args->positionals[1], &out, &error) != WO_OK)
        code = wo_failure(&error);
    else
        code = compare(args, ref, out);
    free(ref.data);
    free(out.data);
    wo_colour_destroy(&colour);
    return code;
}

int wo_cmd_compare(int argc, char **argv)
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
