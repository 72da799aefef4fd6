/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "picture_file.h"
#include "render_camera.h"
#include "render_job.h"
#include "sequence.h"
#include "session.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const wo_option options[] = {
    {"--clip", NULL, "NAME=FILE[:CHANNELS]",
     "Connect a clip. FILE may be a sequence (%04d or ####). CHANNELS picks channels, a layer or "
     "a part of the file: Z, R,G,B, diffuse, layer2, layer2:Z.",
     true},
    {"--set", NULL, "NAME=VALUE",
     "Set a parameter: a number, x,y, r,g,b, true, the name of a choice. NAME=@1:2.8,@25:16 sets "
     "keys at frames, straight lines between them.",
     true},
    {"--output", "-o", "FILE",
     "Where the picture goes: exr png tif tiff jpg dpx hdr tga bmp ppm. It appears under this "
     "name only when it is complete.",
     false},
    {"--frames", NULL, "LIST", "Frames: 12, 1001-1100, 1-100x2, several joined by commas.", false},
    {"--missing-frames", NULL, "WHAT",
     "A frame of a sequence that is not there: error (stop), skip (leave it out) or hold (the one "
     "before it stands in its place, before the first one the first).",
     false},
    {"--range", NULL, "A-B",
     "First and last frame of the shot that these are part of, for plugins that want to know; "
     "otherwise those of the sequences.",
     false},
    {"--context", NULL, "NAME",
     "General, Filter or Generator; without it the first of these that the plugin has.", false},
    {"--window", NULL, "X1,Y1,X2,Y2",
     "Render only these pixels (half open, y up, at the render scale); the output's data window.",
     false},
    {"--scale", NULL, "S", "Render scale, 0.01..1: 0.5 makes a picture of half the width.", false},
    {"--tile", NULL, "N", "Ask the plugin for tiles of N x N pixels, 8..65536.", false},
    {"--clip-size", NULL, "WHAT",
     "A clip whose picture is not as large as Source's: error (stop), scale (display window upon "
     "display window; depth and other numbers are picked, not mixed) or keep (it lies where its "
     "coordinates say). Another pixel aspect alone is always resampled.",
     false},
    {"--size", NULL, "WxH", "Size of the picture when there is no input; 1920x1080.", false},
    {"--threads", NULL, "N", "Threads the plugin may use; all cores.", false},
    {"--in-space", NULL, "NAME",
     "Colour space of the input files; otherwise what each says of itself, or by the rules of the "
     "colour configuration. Mattes, depth and other numbers are never converted.",
     false},
    {"--out-space", NULL, "NAME",
     "Colour space of the output; otherwise that of Source where both files are of one format, or "
     "by the rules of the configuration for its name. The file is labelled with it.",
     false},
    {"--ocio", NULL, "FILE",
     "OpenColorIO configuration; otherwise that of the variable OCIO, otherwise WideOpen's own.",
     false},
    {"--raw", NULL, "NAME", "Take this clip as numbers, not colours.", true},
    {"--bits", NULL, "KIND",
     "Samples of the output: auto, 8, 16, half or float; auto is half in EXR.", false},
    {"--no-metadata", NULL, NULL,
     "Keep the metadata of the files from the plugin. Otherwise it takes the camera from them "
     "(cameraFrom is metadata unless --set says otherwise). What --set says always wins.",
     false},
    {"--explain", NULL, NULL, "Print what would be done, on stdout, and render nothing.", false},
    {"--report", NULL, "FILE", "Write what was done and what it cost, as JSON.", false},
    {"--json", NULL, NULL, "Print the same JSON on stdout.", false},
    {"--strict", NULL, NULL,
     "Guard the plugin's memory, and end with code 1 when it breaks the rules of OpenFX. Breaches "
     "are always printed.",
     false},
    {"--progress", NULL, NULL, "Draw the progress bar even when stderr is no terminal.", false},
    {"--no-progress", NULL, NULL, "Draw no progress bar.", false},
    WO_OPTION_PLUGIN_PATH,
    WO_OPTION_PLUGIN_CACHE,
    WO_OPTION_PLUGIN_WAIT,
    WO_OPTION_NOTES,
};

static const wo_usage usage = {
    .command = "render",
    .synopsis = "PLUGIN --clip NAME=FILE ... [--set NAME=VALUE ...] -o FILE",
    .about =
        "Runs a plugin on image files. PLUGIN is an identifier or its last part; wideopen render "
        "PLUGIN --help lists its clips and parameters, too.\n"
        "The display window of Source is the project, its data window the region of definition; "
        "its attributes are carried to the output. The plugin sees scene-linear Rec.709. An "
        "interrupt (Ctrl-C) stops the render, removes what is half written and ends with code 130.",
    .positionals = "PLUGIN",
    .positionals_min = 1,
    .positionals_max = 1,
    .options = options,
    .option_count = WO_COUNT(options),
    .after = "Examples:\n"
             "  wideopen render LensBlur --clip Source=shot.exr --clip Depth=shot.exr:Z \\\n"
             "      --set fStop=1.4 --set focusDistance=2.5 -o out.exr\n"
             "  wideopen render LensBlur --clip Source=a.####.exr --clip Depth=z.####.exr \\\n"
             "      --frames 1001-1100 --set focusDistance=@1001:2,@1100:8 -o out.####.exr\n",
};

/* --------------------------------------------------------------------- reading the command line */

static int read_window(wo_render_job *job)
{
    const char *const text = wo_args_value(job->args, "--window", 0);
    double v[4];
    if (!text)
        return WO_EXIT_OK;
    bool legal = wo_read_numbers(text, v, 4) && v[0] < v[2] && v[1] < v[3];
    for (int i = 0; legal && i < 4; i++)
        legal = floor(v[i]) == v[i] && fabs(v[i]) <= WO_MAX_COORDINATE;
    if (!legal)
        return wo_usage_fault("render",
                              "--window is \"%s\", but must be four whole numbers x1,y1,x2,y2 with "
                              "x1 < x2 and y1 < y2",
                              text);
    job->render.window = (wo_rect){(int32_t)v[0], (int32_t)v[1], (int32_t)v[2], (int32_t)v[3]};
    return WO_EXIT_OK;
}

static int read_bits(wo_render_job *job)
{
    static const char *const words[] = {"auto", "8", "16", "half", "float"};
    static const wo_io_depth depths[] = {WO_IO_AUTO, WO_IO_BYTE, WO_IO_SHORT, WO_IO_HALF,
                                         WO_IO_SINGLE};
    const char *const text = wo_args_value(job->args, "--bits", 0);
    for (size_t i = 0; i < WO_COUNT(words); i++)
        if (!text || strcmp(text, words[i]) == 0) {
            job->output.depth = depths[i];
            return WO_EXIT_OK;
        }
    return wo_usage_fault("render", "--bits is \"%s\", but must be auto, 8, 16, half or float",
                          text);
}

/* Index of the word that an option has, 0 without the option; -1: it is none of them. */
static int read_word(const wo_args *args, const char *option, const char *const words[3])
{
    const char *const text = wo_args_value(args, option, 0);
    for (int i = 0; i < 3; i++)
        if (!text || strcmp(text, words[i]) == 0)
            return i;
    wo_usage_fault("render", "%s is \"%s\", but must be %s, %s or %s", option, text, words[0],
                   words[1], words[2]);
    return -1;
}

static int read_rules(wo_render_job *job)
{
    static const char *const sizes[] = {"error", "scale", "keep"};
    static const char *const missing[] = {"error", "skip", "hold"};
    const int size = read_word(job->args, "--clip-size", sizes);
    const int frames = size < 0 ? -1 : read_word(job->args, "--missing-frames", missing);
    if (frames < 0)
        return WO_EXIT_USAGE;
    job->clip_size = (wo_clip_size)size;
    job->missing = (wo_missing_frames)frames;
    return WO_EXIT_OK;
}

static int read_numbers(wo_render_job *job)
{
    double scale = 1;
    int tile = 0;
    if (!wo_args_double(job->args, "--scale", 0.01, 1, &scale) ||
        !wo_args_int(job->args, "--tile", 8, WO_MAX_SIDE, &tile))
        return WO_EXIT_USAGE;
    job->render = (wo_host_render_args)WO_HOST_RENDER_INIT;
    job->render.scale_x = job->render.scale_y = scale;
    job->render.tile_width = job->render.tile_height = tile;
    const char *const size = wo_args_value(job->args, "--size", 0);
    int width = 1920, height = 1080;
    if (size && !wo_read_size(size, &width, &height))
        return wo_usage_fault("render", "--size is \"%s\", but must be WIDTHxHEIGHT, 1..65536 each",
                              size);
    job->project = (wo_rect){0, 0, width, height};
    job->pixel_aspect = 1;
    const int code = read_window(job);
    return code == WO_EXIT_OK ? read_bits(job) : code;
}

/* Is NAME=FILE[:CHANNELS] a sequence? *there is 0 where it has no file. */
static bool is_sequence(const char *clip, wo_sequence *there)
{
    const char *const equals = strchr(clip, '=');
    char *file, *channels;
    if (wo_picture_split(equals ? equals + 1 : clip, 1, &file, &channels, NULL) != WO_OK)
        return false;
    const bool result = wo_io_is_sequence(file);
    if (!result || !wo_sequence_look(file, 1, there))
        *there = (wo_sequence){0};
    free(file);
    free(channels);
    return result;
}

static bool any_sequence(const wo_args *args, wo_sequence *there)
{
    for (int i = 0; i < wo_args_count(args, "--clip"); i++)
        if (is_sequence(wo_args_value(args, "--clip", i), there))
            return true;
    return false;
}

static int want_frames(const wo_sequence *there)
{
    if (!there->last && !there->first)
        return wo_usage_fault("render", "a clip is a sequence: say which frames, --frames 1-100");
    return wo_usage_fault("render", "a clip is a sequence: say which frames, as in --frames %d-%d",
                          there->first, there->last);
}

static int read_frames(wo_render_job *job)
{
    const char *const text = wo_args_value(job->args, "--frames", 0);
    const char *const output = wo_args_value(job->args, "--output", 0);
    wo_error error = {0};
    wo_sequence there;
    if (!text && any_sequence(job->args, &there))
        return want_frames(&there);
    const wo_status status = wo_frames_read(text ? text : "1", &job->frames, &error);
    if (status == WO_ERR_NOMEM)
        return wo_failure(&error);
    if (status != WO_OK)
        return wo_usage_fault("render", "--frames: %s", error.text);
    if (!job->explain && !output)
        return wo_usage_fault("render", "where should the picture go? give -o FILE");
    if (!job->explain && job->frames.count > 1 && !wo_io_is_sequence(output))
        return wo_usage_fault("render",
                              "%zu frames would all be written to %s; put #### into its name",
                              job->frames.count, output);
    job->output.pattern = output;
    return WO_EXIT_OK;
}

static int read_range(wo_render_job *job)
{
    const char *const text = wo_args_value(job->args, "--range", 0);
    wo_error error = {0};
    if (!text)
        return WO_EXIT_OK;
    const wo_status status = wo_frames_read(text, &job->range, &error);
    if (status == WO_ERR_NOMEM)
        return wo_failure(&error);
    return status == WO_OK ? WO_EXIT_OK : wo_usage_fault("render", "--range: %s", error.text);
}

static int read_job(wo_render_job *job)
{
    const wo_args *const args = job->args;
    job->explain = wo_args_count(args, "--explain") > 0;
    job->metadata = wo_args_count(args, "--no-metadata") == 0;
    job->output.space = wo_args_value(args, "--out-space", 0);
    int code = read_numbers(job);
    if (code == WO_EXIT_OK)
        code = read_rules(job);
    if (code == WO_EXIT_OK)
        code = read_frames(job);
    return code == WO_EXIT_OK ? read_range(job) : code;
}

/* ----------------------------------------------------------------------------------- the plugin */

static int open_plugin(wo_render_job *job)
{
    wo_host_config config = {
        .background = true, .user = job, .progress = wo_render_progress, .aborted = wo_interrupted};
    int threads = 0;
    if (!wo_args_int(job->args, "--threads", 1, 1024, &threads))
        return WO_EXIT_USAGE;
    config.threads = (unsigned)threads;
    config.strict = wo_args_count(job->args, "--strict") > 0;
    const int code = wo_session_open(job->args, config, &job->host);
    if (code != WO_EXIT_OK)
        return code;
    job->plugin = wo_session_plugin(job->host, job->args->positionals[0]);
    if (wo_args_count(job->args, "--notes"))
        wo_session_notes(job->host);
    if (job->plugin)
        job->context =
            wo_session_context(job->plugin, wo_args_value(job->args, "--context", 0), "render");
    return job->context ? WO_EXIT_OK : WO_EXIT_USAGE;
}

static int print_help(wo_render_job *job)
{
    wo_args_help(&usage, stdout);
    if (job->args->positional_count == 0)
        return WO_EXIT_OK;
    const int code = open_plugin(job);
    if (code != WO_EXIT_OK)
        return code;
    printf("\nClips of %s (%s):\n", job->plugin->identifier, job->context->short_name);
    wo_print_clips(stdout, job->context);
    printf("\nParameters, for --set:\n");
    wo_print_params(stdout, job->context);
    return WO_EXIT_OK;
}

static int open_files(wo_render_job *job)
{
    wo_error error = {0};
    if (wo_colour_create(wo_args_value(job->args, "--ocio", 0), &job->colour, &error) != WO_OK)
        return wo_failure(&error);
    job->output.colour = job->colour;
    const char *const in_space = wo_args_value(job->args, "--in-space", 0);
    if (wo_picture_check_space(job->colour, in_space, &error) != WO_OK)
        return wo_usage_fault("render", "--in-space: %s", error.text);
    if (wo_picture_check_space(job->colour, job->output.space, &error) != WO_OK)
        return wo_usage_fault("render", "--out-space: %s", error.text);
    if (wo_inputs_create(job->colour, in_space, &job->inputs, &error) != WO_OK)
        return wo_failure(&error);
    wo_inputs_set_missing(job->inputs, job->missing);
    wo_camera_own(job->args, job->own, sizeof job->own);
    wo_inputs_pass_metadata(job->inputs, job->metadata ? job->own : NULL);
    if (!job->explain && wo_output_check(&job->output, job->frames.first, &error) != WO_OK)
        return wo_failure(&error);
    return wo_render_add_clips(job);
}

/* -------------------------------------------------------------------------------------- the run */

static int write_reports(wo_render_job *job, const wo_error *failed)
{
    const char *const path = wo_args_value(job->args, "--report", 0);
    wo_error error = {0};
    if (wo_args_count(job->args, "--json"))
        wo_record_write(&job->record, job->host, job->inputs, failed, stdout);
    if (path && wo_record_save(&job->record, job->host, job->inputs, failed, path, &error) != WO_OK)
        return wo_failure(&error);
    return WO_EXIT_OK;
}

static int render_all(wo_render_job *job)
{
    wo_error error = {0};
    int code = WO_EXIT_OK;
    if (wo_render_frames(job, &error) != WO_OK)
        code = wo_failure(&error);
    if (!job->record.plugin &&
        !wo_record_begin(&job->record, job->instance, job->frames.numbers[0]))
        return WO_EXIT_FAILURE;
    wo_host_instance_destroy(&job->instance);
    const size_t violations = wo_session_violations(job->host);
    job->judged = true;
    const int written = write_reports(job, code == WO_EXIT_OK ? NULL : &error);
    if (code == WO_EXIT_OK)
        code = written;
    if (code == WO_EXIT_OK && wo_args_count(job->args, "--strict") && violations > 0) {
        wo_message("%s broke the rules of OpenFX", job->plugin->identifier);
        code = WO_EXIT_FAILURE;
    }
    return code;
}

static int run(wo_render_job *job)
{
    int code = read_job(job);
    if (code == WO_EXIT_OK)
        code = open_plugin(job);
    const double start = wo_seconds();
    if (code == WO_EXIT_OK)
        code = open_files(job);
    job->opening_seconds = wo_seconds() - start;
    if (code != WO_EXIT_OK)
        return code;
    char made_by[256];
    snprintf(made_by, sizeof made_by, "%s %u.%u", job->plugin->identifier,
             job->plugin->version_major, job->plugin->version_minor);
    job->output.made_by = made_by;
    wo_error error = {0};
    if (wo_render_make_instance(job, &error) != WO_OK)
        return wo_failure(&error);
    code = wo_render_set_params(job);
    return code == WO_EXIT_OK ? render_all(job) : code;
}

int wo_cmd_render(int argc, char **argv)
{
    wo_args args;
    wo_render_job job = {.args = &args};
    if (pthread_mutex_init(&job.lock, NULL) != 0) {
        wo_message("the system has no lock left");
        return WO_EXIT_FAILURE;
    }
    int code = wo_args_read(&args, &usage, argc, argv);
    if (code == WO_EXIT_OK) {
        wo_interrupt_catch();
        code = args.help ? print_help(&job) : run(&job);
    }
    wo_host_instance_destroy(&job.instance);
    if (!job.judged) /* it has not come to a render */
        (void)wo_session_violations(job.host);
    wo_host_destroy(&job.host);
    wo_inputs_destroy(&job.inputs);
    wo_colour_destroy(&job.colour);
    wo_record_free(&job.record);
    wo_frames_free(&job.frames);
    wo_frames_free(&job.range);
    pthread_mutex_destroy(&job.lock);
    wo_args_free(&args);
    return code;
}
