/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "args.h"
#include "command.h"
#include "footage.h"
#include "json.h"
#include "text_file.h"
#include "threads.h"

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const wo_option options[] = {
    {"--output", "-o", "DIR", "Folder for the files; made when it does not exist.", false},
    {"--size", NULL, "WxH", "Size in pixels; the scene's own when not given.", false},
    {"--layers", NULL, "N", "Depth layers to make, 0..8; default 4.", false},
    {"--hits", NULL, NULL,
     "Make layer k of the k-th hits alone, as renderers do: edge pixels mix near and far.", false},
    {"--back-faces", NULL, NULL,
     "Peel the faces of solids that look away from the camera, too; a wide lens may see some.",
     false},
    {"--reference", NULL, "SPP",
     "Lens rays for each pixel of the reference, 16..1048576; default 0: no reference.", false},
    {"--overscan", NULL, "PX",
     "Pixels that pinhole and layers show beyond the frame on every side, up to a tenth of its "
     "shorter side; default 0.",
     false},
    {"--samples", NULL, "N", "Rays for each pixel of pinhole and layers, 1..256; default 32.",
     false},
    {"--seed", NULL, "S", "Another variant of the scene; default 0.", false},
    {"--fstop", NULL, "N", "f-number; the scene's own when not given.", false},
    {"--focus", NULL, "M", "Focus distance in metres; the scene's own when not given.", false},
    {"--blades", NULL, "N", "Aperture blades of the reference, 3..16; default 0: round.", false},
    {"--rotation", NULL, "DEG", "Angle of an aperture corner from the right, counter-clockwise.",
     false},
    {"--umbra", NULL, NULL, "Leave out what no lens ray can reach (Lee et al. 2010).", false},
    {"--threads", NULL, "N", "Threads; default 0: all cores.", false},
    {"--json", NULL, NULL, "Print what was made as JSON.", false},
    {"--progress", NULL, NULL, "Draw a progress bar even when stderr is no terminal.", false},
    {"--no-progress", NULL, NULL, "Draw no progress bar.", false},
};

static const wo_usage usage = {
    .command = "footage",
    .synopsis = "SCENE -o DIR [--size WxH] [--layers N] [--reference SPP]",
    .about = "Makes test footage: a procedural scene through a pinhole with depth and normals, its "
             "depth layers, and the truth: the same scene through a thin lens by brute force, with "
             "its standard error. `wideopen footage` alone lists the scenes.\n"
             "Files: " WO_FOOTAGE_PINHOLE " (rgba, depth, normal), " WO_FOOTAGE_LAYERS
             " (layer1, layer1_depth, ...), " WO_FOOTAGE_REFERENCE ", " WO_FOOTAGE_REFERENCE_ERROR
             " and scene.json, which says what they are.",
    .positionals = "SCENE",
    .positionals_min = 0,
    .positionals_max = 1,
    .options = options,
    .option_count = WO_COUNT(options),
    .after = "Example:\n  wideopen footage still-life -o shot --layers 4 --reference 1024\n",
};

static int list_scenes(const wo_args *args)
{
    const bool json = wo_args_count(args, "--json") > 0;
    wo_json out = {0};
    if (json) {
        wo_json_begin(&out, stdout);
        wo_json_array(&out, NULL);
    }
    for (size_t i = 0; wo_footage_scene_at(i); i++) {
        const wo_footage_scene *s = wo_footage_scene_at(i);
        if (json) {
            wo_json_object(&out, NULL);
            wo_json_text(&out, "name", s->name);
            wo_json_text(&out, "help", s->help);
            wo_json_close(&out);
        } else {
            printf("%-14s %s\n", s->name, s->help);
        }
    }
    if (json) {
        wo_json_close(&out);
    }
    return WO_EXIT_OK;
}

static bool read_options(const wo_args *args, wo_footage_options *o, unsigned *threads)
{
    int layers = 4;
    int seed = 0;
    int count = 0;
    *o = (wo_footage_options){.scene = args->positionals[0],
                              .peel = wo_args_count(args, "--hits") ? WO_FOOTAGE_HITS
                                                                    : WO_FOOTAGE_PATCHES,
                              .back_faces = wo_args_count(args, "--back-faces") > 0,
                              .umbra = wo_args_count(args, "--umbra") > 0};
    const char *size = wo_args_value(args, "--size", 0);
    if (size && !wo_read_size(size, &o->width, &o->height)) {
        wo_usage_fault("footage", "--size %s: give WIDTHxHEIGHT, each 1..65536", size);
        return false;
    }
    if (!wo_args_int(args, "--layers", 0, WO_FOOTAGE_LAYERS_MAX, &layers) ||
        !wo_args_int(args, "--reference", 0, 1 << 20, &o->reference_spp) ||
        !wo_args_int(args, "--overscan", 0, 6554, &o->overscan) ||
        !wo_args_int(args, "--samples", 1, WO_FOOTAGE_SAMPLES_MAX, &o->samples) ||
        !wo_args_int(args, "--seed", 0, INT32_MAX, &seed) ||
        !wo_args_double(args, "--fstop", 0.01, 1e6, &o->f_stop) ||
        !wo_args_double(args, "--focus", 0.01, 1e9, &o->focus_m) ||
        !wo_args_int(args, "--blades", 0, 16, &o->blades) ||
        !wo_args_double(args, "--rotation", -1e6, 1e6, &o->rotation) ||
        !wo_args_int(args, "--threads", 0, 256, &count))
        return false;
    o->layers = layers;
    o->seed = (uint64_t)seed;
    *threads = (unsigned)count;
    return true;
}

static int unknown_scene(const char *name)
{
    const char *names[64];
    char near[256];
    size_t count = 0;
    while (count < WO_COUNT(names) && wo_footage_scene_at(count)) {
        names[count] = wo_footage_scene_at(count)->name;
        count++;
    }
    wo_near_words(name, names, count, near, sizeof near);
    return wo_usage_fault("footage", "there is no scene %s; there is: %s", name, near);
}

static void move_bar(void *user, double fraction)
{
    wo_bar_move(user, fraction);
}

static void print_file(wo_json *out, const char *name, const char *const *parts, int count)
{
    wo_json_object(out, NULL);
    wo_json_text(out, "name", name);
    wo_json_array(out, "parts");
    for (int i = 0; i < count; i++)
        wo_json_text(out, NULL, parts[i]);
    wo_json_close(out);
    wo_json_close(out);
}

static void print_files(wo_json *out, const wo_footage *set)
{
    static const char *const pinhole[] = {"rgba", "depth", "normal"};
    char names[2 * WO_FOOTAGE_LAYERS_MAX][24];
    const char *parts[2 * WO_FOOTAGE_LAYERS_MAX];
    for (int k = 0; k < 2 * set->layer_count; k++) {
        snprintf(names[k], sizeof names[k], k % 2 ? "layer%d_depth" : "layer%d", k / 2 + 1);
        parts[k] = names[k];
    }
    wo_json_array(out, "files");
    print_file(out, WO_FOOTAGE_PINHOLE, pinhole, WO_COUNT(pinhole));
    if (set->layer_count > 0)
        print_file(out, WO_FOOTAGE_LAYERS, parts, 2 * set->layer_count);
    if (set->reference.data) {
        print_file(out, WO_FOOTAGE_REFERENCE, NULL, 0);
        print_file(out, WO_FOOTAGE_REFERENCE_ERROR, NULL, 0);
    }
    wo_json_close(out);
}

/* Everything that is known of a set. */
static void print_set(FILE *file, const wo_footage *set, const char *folder)
{
    const wo_footage_options *const o = &set->options;
    wo_json out;
    wo_json_begin(&out, file);
    wo_json_object(&out, NULL);
    wo_json_text(&out, "scene", set->scene->name);
    if (folder)
        wo_json_text(&out, "folder", folder);
    wo_json_integer(&out, "width", o->width);
    wo_json_integer(&out, "height", o->height);
    wo_json_integer(&out, "overscan", o->overscan);
    wo_json_integer(&out, "seed", (long long)o->seed);
    wo_json_number(&out, "focalLength", o->focal_mm);
    wo_json_number(&out, "sensorWidth", WO_FOOTAGE_SENSOR_MM);
    wo_json_number(&out, "fStop", o->f_stop);
    wo_json_number(&out, "focusDistance", o->focus_m);
    wo_json_integer(&out, "blades", o->blades);
    wo_json_number(&out, "rotation", o->rotation);
    wo_json_integer(&out, "samples", o->samples);
    wo_json_integer(&out, "layers", set->layer_count);
    wo_json_text(&out, "peel", o->peel == WO_FOOTAGE_HITS ? "hits" : "patches");
    wo_json_bool(&out, "backFaces", o->back_faces);
    wo_json_array(&out, "layerPixels");
    for (int k = 0; k < set->layer_count; k++)
        wo_json_integer(&out, NULL, set->layer_pixels[k]);
    wo_json_close(&out);
    wo_json_integer(&out, "umbraDropped", set->umbra_dropped);
    wo_json_integer(&out, "deeperDropped", set->deeper_dropped);
    wo_json_integer(&out, "referenceSamples", o->reference_spp);
    wo_json_integer(&out, "referenceBatches", set->batches);
    wo_json_number(&out, "referenceNoisePsnr", set->reference.data ? set->noise_psnr : NAN);
    wo_json_number(&out, "seconds", set->seconds[0] + set->seconds[1] + set->seconds[2]);
    print_files(&out, set);
    wo_json_close(&out);
}

static wo_status save_facts(const wo_footage *set, const char *folder, wo_error *error)
{
    char path[PATH_MAX];
    const int used = snprintf(path, sizeof path, "%s/scene.json", folder);
    if (used < 0 || (size_t)used >= sizeof path)
        return wo_fail(error, WO_ERR_RANGE, "the path of the folder is too long");
    wo_text_out out;
    WO_TRY(wo_text_begin(&out, path, error));
    print_set(out.file, set, NULL);
    return wo_text_end(&out, error);
}

static int report(const wo_args *args, const wo_footage *set, const char *folder)
{
    wo_error error = {0};
    if (save_facts(set, folder, &error) != WO_OK)
        return wo_failure(&error);
    if (wo_args_count(args, "--json")) {
        print_set(stdout, set, folder);
        return WO_EXIT_OK;
    }
    wo_message("%s: %dx%d, %d layers in %s", set->scene->name, set->options.width,
               set->options.height, set->layer_count, folder);
    if (set->options.umbra)
        wo_message("%" PRId64 " patches that no lens ray can reach were left out",
                   set->umbra_dropped);
    if (set->reference.data)
        wo_message("reference of %d rays a pixel, its own noise at %.1f dB",
                   set->options.reference_spp, set->noise_psnr);
    return WO_EXIT_OK;
}

static int make(const wo_args *args)
{
    const char *folder = wo_args_value(args, "--output", 0);
    wo_footage_options o;
    unsigned threads;
    wo_error error = {0};
    if (!read_options(args, &o, &threads))
        return WO_EXIT_USAGE;
    if (!wo_footage_scene_find(o.scene))
        return unknown_scene(o.scene);
    if (!folder)
        return wo_usage_fault("footage", "-o DIR is needed: where the files go");
    if (mkdir(folder, 0777) != 0 && errno != EEXIST) {
        wo_message("%s: %s", folder, strerror(errno));
        return WO_EXIT_FAILURE;
    }
    wo_bar bar;
    wo_bar_begin(&bar,
                 wo_bar_wanted(wo_args_count(args, "--progress") > 0,
                               wo_args_count(args, "--no-progress") > 0),
                 o.scene);
    wo_interrupt_catch();
    wo_context context = WO_CONTEXT_INIT;
    context.runner = wo_threads_runner(&threads);
    context.aborted = wo_interrupted;
    context.progress = move_bar;
    context.progress_user = &bar;
    wo_footage *set = NULL;
    const wo_status status = wo_footage_render(&context, &o, folder, &set, &error);
    wo_bar_end(&bar);
    const int code = status == WO_OK ? report(args, set, folder) : wo_failure(&error);
    wo_footage_destroy(&context, &set);
    return code;
}

int wo_cmd_footage(int argc, char **argv)
{
    wo_args args;
    int code = wo_args_read(&args, &usage, argc, argv);
    if (code == WO_EXIT_OK && args.help)
        wo_args_help(&usage, stdout);
    else if (code == WO_EXIT_OK && args.positional_count == 0)
        code = list_scenes(&args);
    else if (code == WO_EXIT_OK)
        code = make(&args);
    wo_args_free(&args);
    return code;
}
