/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "bench_request.h"
#include "session.h"
#include "text_file.h"
#include "threads.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const wo_option options[] = {
    {"--output", "-o", "DIR", "Folder for results and footage; made when it does not exist.",
     false},
    {"--scenes", NULL, "A,B",
     "Scenes of `wideopen footage`; default six of them, or none with --scene-dir.", false},
    {"--scene-dir", NULL, "DIR",
     "Another scene: pinhole.exr, depth.exr, layer1.exr, layer1_depth.exr ..., and truth.exr or "
     "reference.exr; or what `wideopen footage` makes.",
     true},
    {"--given", NULL, "A,B",
     "What the plugin gets: layers (all of them), sd (one picture with its depth); default both.",
     false},
    {"--methods", NULL, "A,B", "Choices of the parameter method; default all but reference.",
     false},
    {"--samples", NULL, "N,M", "Rays of each pixel in fixed sampling, or none; default 16,64,256.",
     false},
    {"--targets", NULL, "X,Y",
     "Target errors of adaptive sampling, or none, for methods that estimate their error; default "
     "0.016,0.008,0.004.",
     false},
    {"--repeats", NULL, "N",
     "Runs of every setting, each with its own seed, 1..16; the best time counts; default 3.",
     false},
    {"--judge", NULL, "METHOD",
     "The method that the others are held against; default hybrid, or the plugin's default.",
     false},
    {"--tolerance", NULL, "X", "Part of a time that is noise of the clock, 0..1; default 0.1.",
     false},
    {"--clock", NULL, "WHICH",
     "The time that counts: wall, or cpu (of all threads together) where other work disturbs; "
     "default wall.",
     false},
    {"--converged", NULL, "N",
     "Rays of the pictures that sampling errors are taken from, 0 = none; default 4096.", false},
    {"--crop", NULL, "N", "Leave out a border of N pixels from the errors.", false},
    {"--size", NULL, "WxH", "Size of the scenes in pixels; default 640x360.", false},
    {"--reference", NULL, "SPP",
     "Rays of each pixel of the reference, 16..1048576; default 1024, and 4096 where 1024 are too "
     "noisy.",
     false},
    {"--footage-seed", NULL, "S", "Another variant of the scenes; default 0.", false},
    {"--fresh", NULL, NULL, "Make the footage again that is in DIR already.", false},
    {"--set", NULL, "NAME=VALUE", "A parameter of all renders.", true},
    {"--limit", NULL, "S", "A render that takes more seconds fails; default 300.", false},
    {"--quick", NULL, NULL,
     "A first look: one scene of 320x180, 16 and 64 rays, one target, one run.", false},
    {"--threads", NULL, "N", "Threads, 1..256; default all cores.", false},
    WO_OPTION_PLUGIN_PATH,
    WO_OPTION_PLUGIN_CACHE,
    WO_OPTION_PLUGIN_WAIT,
    {"--json", NULL, NULL, "Print JSON instead of tables.", false},
    {"--progress", NULL, NULL, "Draw a progress bar even when stderr is no terminal.", false},
    {"--no-progress", NULL, NULL, "Draw no progress bar.", false},
};

static const wo_usage usage = {
    .command = "bench",
    .synopsis = "[--scenes A,B] [--methods A,B] -o DIR",
    .about =
        "Error against run time of every method of LensBlur, with every setting on every scene, "
        "once with all layers and once with one picture and its depth. Time is that of the render "
        "action, planning included, as the best of interleaved runs; errors are against the "
        "scene's ray-traced reference.\n"
        "Files: bench.csv, a plot SCENE-layers.svg and SCENE-sd.svg for each scene, and "
        "bench.html with everything on one page; they are renewed after every scene. Footage is "
        "kept in DIR/footage: the first run makes it, which takes minutes, later ones find it. A "
        "render that fails is a row that says so; the exit code is then 1.",
    .positionals = "",
    .positionals_min = 0,
    .positionals_max = 0,
    .options = options,
    .option_count = WO_COUNT(options),
    .after = "Examples:\n  wideopen bench --quick -o look\n"
             "  wideopen bench --scenes fence,hair --methods rays,hybrid -o curves\n",
};

#define PLUGIN "LensBlur"

/* ---------------------------------------------------------------------------------- methods */

/* The label of a choice as a word: small letters, no blanks. */
static void word_of(const char *label, char *word, size_t size)
{
    size_t used = 0;
    for (; *label && used + 1 < size; label++)
        word[used++] =
            (char)(isalnum((unsigned char)*label) ? tolower((unsigned char)*label) : '-');
    word[used] = '\0';
}

static int add_method(const wo_host_param_info *param, const char *name, wo_bench_job *job)
{
    wo_bench *const bench = job->bench;
    const char *names[WO_BENCH_METHODS];
    char words[WO_BENCH_METHODS][32], near[512];
    size_t count = 0;
    for (; count < param->choice_count && count < WO_COUNT(names); count++) {
        word_of(param->choices[count], words[count], sizeof words[count]);
        names[count] = words[count];
        if (strcmp(names[count], name) != 0)
            continue;
        for (int m = 0; m < bench->method_count; m++)
            if (strcmp(bench->method[m], name) == 0)
                return wo_usage_fault("bench", "--methods: %s is there twice", name);
        job->choice[bench->method_count] = (int)count;
        snprintf(bench->method[bench->method_count++], sizeof bench->method[0], "%s", name);
        return WO_EXIT_OK;
    }
    wo_near_words(name, names, count, near, sizeof near);
    return wo_usage_fault("bench", "%s has no method %s; there is: %s", job->plugin->identifier,
                          name, near);
}

static int find_method(const wo_bench *bench, const char *name)
{
    for (int m = 0; m < bench->method_count; m++)
        if (strcmp(bench->method[m], name) == 0)
            return m;
    return -1;
}

static int choose_methods(const wo_args *args, wo_bench_job *job)
{
    wo_bench *const bench = job->bench;
    const wo_host_param_info *const param = wo_host_find_param(job->context, "method");
    const char *const list = wo_args_value(args, "--methods", 0);
    const char *const judge = wo_args_value(args, "--judge", 0);
    char words[WO_BENCH_METHODS][64];
    int count, code = WO_EXIT_OK;
    if (!param || param->kind != WO_HOST_PARAM_CHOICE || param->choice_count == 0) {
        wo_message("%s has no choice of methods: nothing to compare", job->plugin->identifier);
        return WO_EXIT_FAILURE;
    }
    if (list && !wo_bench_split(list, words, WO_BENCH_METHODS, &count))
        return wo_usage_fault("bench", "--methods %s: give names with commas", list);
    for (int i = 0; list && i < count && code == WO_EXIT_OK; i++)
        code = add_method(param, words[i], job);
    for (size_t i = 0; !list && i < param->choice_count && i < WO_BENCH_METHODS; i++) {
        word_of(param->choices[i], words[0], sizeof words[0]);
        if (strcmp(words[0], "reference") != 0 && code == WO_EXIT_OK)
            code = add_method(param, words[0], job);
    }
    if (code != WO_EXIT_OK)
        return code;
    const size_t initial = (size_t)param->initial[0];
    word_of(initial < param->choice_count ? param->choices[initial] : "", words[0],
            sizeof words[0]);
    bench->judged = find_method(bench, judge ? judge : "hybrid");
    if (judge && bench->judged < 0)
        return wo_usage_fault("bench", "--judge %s: no such method is benched", judge);
    if (bench->judged < 0)
        bench->judged = find_method(bench, words[0]);
    return WO_EXIT_OK;
}

/* The comparison that half the time is asked of: rays with 256 samples, or the most there are. */
static void choose_base(wo_bench *bench)
{
    bench->base = find_method(bench, "rays");
    bench->base_setting = -1;
    for (int i = 0; i < bench->setting_count; i++)
        if (!bench->setting[i].adaptive &&
            (bench->base_setting < 0 || bench->setting[i].value <= 256))
            bench->base_setting = i;
    if (bench->base_setting < 0)
        bench->base = -1;
}

/* -------------------------------------------------------------------------------- parameters */

/* An instance without pictures tries what every render will be given. */
static int check_sets(const wo_args *args, wo_bench_job *job)
{
    static const char *const own[] = {"method",      "sampling", "samples",
                                      "targetError", "seed",     "output"};
    const wo_host_project project = WO_HOST_PROJECT_INIT;
    wo_host_instance *instance = NULL;
    wo_error error = {0};
    int code = WO_EXIT_OK;
    if (wo_host_instance_create(job->host, job->plugin, job->context->name, &project, &instance,
                                &error) != WO_OK)
        return wo_failure(&error);
    for (int i = 0; i < wo_args_count(args, "--set") && code == WO_EXIT_OK; i++) {
        const char *const text = wo_args_value(args, "--set", i);
        const size_t length = strcspn(text, "=");
        char name[128];
        if (length == 0 || length >= sizeof name || !text[length]) {
            code = wo_usage_fault("bench", "--set is \"%s\", but must be NAME=VALUE", text);
            break;
        }
        snprintf(name, sizeof name, "%.*s", (int)length, text);
        for (size_t k = 0; k < WO_COUNT(own); k++)
            if (strcmp(name, own[k]) == 0)
                code = wo_usage_fault("bench", "--set %s: bench sets it itself", name);
        if (code == WO_EXIT_OK &&
            wo_host_param_set_text(instance, name, text + length + 1, &error) != WO_OK)
            code = wo_usage_fault("bench", "--set %s: %s", text, error.text);
    }
    wo_host_instance_destroy(&instance);
    return code;
}

static int open_plugin(wo_bench_request *r, wo_bench_job *job)
{
    const wo_host_config config = {
        .threads = r->threads, .background = true, .user = job, .aborted = wo_bench_stopped};
    const int code = wo_session_open(r->args, config, &job->host);
    if (code != WO_EXIT_OK)
        return code;
    job->plugin = wo_session_plugin(job->host, PLUGIN);
    if (!job->plugin)
        return WO_EXIT_FAILURE;
    job->context = wo_session_context(job->plugin, NULL, "bench");
    if (!job->context)
        return WO_EXIT_FAILURE;
    job->bench->plugin = job->plugin->identifier;
    job->bench->version[0] = job->plugin->version_major;
    job->bench->version[1] = job->plugin->version_minor;
    job->bench->threads = wo_host_threads(job->host);
    const int chosen = choose_methods(r->args, job);
    if (chosen != WO_EXIT_OK)
        return chosen;
    choose_base(job->bench);
    return check_sets(r->args, job);
}

/* ----------------------------------------------------------------------------------- the run */

static wo_status path_in(const wo_bench_request *r, char *path, size_t size, const char *name,
                         wo_error *error)
{
    const int used = snprintf(path, size, "%s/%s", r->output, name);
    if (used < 0 || (size_t)used >= size)
        return wo_fail(error, WO_ERR_RANGE, "the path of the folder is too long");
    return WO_OK;
}

static wo_status save_plot(const wo_bench_request *r, const wo_bench *bench,
                           const wo_bench_shot *shot, wo_error *error)
{
    char name[128], path[PATH_MAX];
    wo_svg svg = {0};
    snprintf(name, sizeof name, "%s-%s.svg", shot->scene, wo_bench_given(shot));
    WO_TRY(path_in(r, path, sizeof path, name, error));
    wo_status status = wo_bench_plot(bench, shot, &svg, error);
    if (status == WO_OK)
        status = wo_text_save(path, svg.text, svg.length, error);
    wo_svg_free(&svg);
    return status;
}

/* What is known so far; written anew after every shot, so that a run that is cut off is not lost.
 */
static wo_status save(const wo_bench_request *r, const wo_bench *bench, const wo_bench_shot *shot,
                      wo_error *error)
{
    char path[PATH_MAX];
    wo_text_out out;
    if (shot->state == WO_BENCH_DONE)
        WO_TRY(save_plot(r, bench, shot, error));
    WO_TRY(path_in(r, path, sizeof path, "bench.csv", error));
    WO_TRY(wo_text_begin(&out, path, error));
    wo_bench_csv(bench, out.file);
    WO_TRY(wo_text_end(&out, error));
    WO_TRY(path_in(r, path, sizeof path, "bench.html", error));
    WO_TRY(wo_text_begin(&out, path, error));
    const wo_status status = wo_bench_page(bench, out.file, error);
    const wo_status ended = wo_text_end(&out, status == WO_OK ? error : NULL);
    return status == WO_OK ? ended : status;
}

static void move_bar(void *user, double fraction)
{
    wo_bar_move(user, fraction);
}

/* The folder of scene number i; made when it is one of ours. */
static wo_status find_folder(wo_bench_request *r, wo_bench_job *job, int i, char *folder,
                             size_t size, wo_error *error)
{
    const int own = r->scene_count - r->folder_count;
    if (i >= own) {
        const int used =
            snprintf(folder, size, "%s", wo_args_value(r->args, "--scene-dir", i - own));
        return used >= 0 && (size_t)used < size
                   ? WO_OK
                   : wo_fail(error, WO_ERR_RANGE, "the path of --scene-dir is too long");
    }
    wo_context context = WO_CONTEXT_INIT;
    char label[96];
    context.runner = wo_threads_runner(&r->threads);
    context.aborted = wo_interrupted;
    context.progress = move_bar;
    context.progress_user = &job->bar;
    r->footage.scene = r->scene[i];
    snprintf(label, sizeof label, "footage %s", r->scene[i]);
    wo_bar_begin(&job->bar, r->progress, label);
    const wo_status status = wo_bench_footage(
        &context, r->footage, r->root, wo_args_count(r->args, "--fresh") > 0, folder, size, error);
    wo_bar_end(&job->bar);
    return status;
}

/* One scene as often as it is given. */
static wo_status run_scene(wo_bench_request *r, wo_bench_job *job, int i, int *number,
                           wo_error *error)
{
    wo_bench *const bench = job->bench;
    char folder[PATH_MAX], label[96];
    wo_error why = {0};
    const wo_status found = find_folder(r, job, i, folder, sizeof folder, &why);
    if (wo_interrupted(NULL))
        return wo_fail(error, WO_ABORTED, "interrupted");
    for (int g = 0; g < 2; g++) {
        if (!r->given[g])
            continue;
        wo_bench_shot *const shot = &bench->shots[(*number)++];
        if (found == WO_OK) {
            snprintf(label, sizeof label, "%s, %s", shot->scene, wo_bench_given(shot));
            wo_bar_begin(&job->bar, r->progress, label);
            job->rendered = 0;
            job->to_render =
                bench->method_count * (bench->setting_count * bench->runs + (bench->converged > 0));
            const wo_status status = wo_bench_shoot(job, folder, shot, error);
            wo_bar_end(&job->bar);
            WO_TRY(status);
        } else {
            shot->state = WO_BENCH_FAILED;
            snprintf(shot->why, sizeof shot->why, "%s", why.text);
        }
        WO_TRY(save(r, bench, shot, error));
    }
    return WO_OK;
}

static int run_all(wo_bench_request *r, wo_bench_job *job)
{
    wo_bench *const bench = job->bench;
    wo_error error = {0};
    int number = 0;
    bench->shots = calloc((size_t)r->scene_count * 2, sizeof *bench->shots);
    if (!bench->shots || wo_colour_create(NULL, &job->colour, &error) != WO_OK) {
        if (!bench->shots)
            wo_fail(&error, WO_ERR_NOMEM, "out of memory for the results");
        return wo_failure(&error);
    }
    if (mkdir(r->output, 0777) != 0 && errno != EEXIST) {
        wo_message("%s: %s", r->output, strerror(errno));
        return WO_EXIT_FAILURE;
    }
    for (int i = 0; i < r->scene_count; i++)
        for (int g = 0; g < 2; g++) {
            if (!r->given[g])
                continue;
            wo_bench_shot *const shot = &bench->shots[bench->shot_count++];
            shot->layers = g == 0;
            snprintf(shot->scene, sizeof shot->scene, "%s", r->scene[i]);
        }
    for (int i = 0; i < r->scene_count; i++)
        if (run_scene(r, job, i, &number, &error) != WO_OK)
            return wo_failure(&error);
    if (wo_args_count(r->args, "--json"))
        wo_bench_json(bench, stdout);
    else
        wo_bench_table(bench, stdout);
    wo_message("%s/bench.html shows it all", r->output);
    const int failed = wo_bench_failures(bench);
    if (failed > 0)
        wo_message("%d failed; the tables say why", failed);
    return failed > 0 ? WO_EXIT_FAILURE : WO_EXIT_OK;
}

static int run(const wo_args *args)
{
    wo_bench bench = {.judged = -1, .base = -1};
    wo_bench_job job = {.bench = &bench, .args = args};
    wo_bench_request r = {0};
    int code = wo_bench_read(&r, args, &job);
    wo_interrupt_catch();
    if (code == WO_EXIT_OK)
        code = open_plugin(&r, &job);
    if (code == WO_EXIT_OK)
        code = run_all(&r, &job);
    for (int i = 0; bench.shots && i < bench.shot_count; i++)
        free(bench.shots[i].points);
    free(bench.shots);
    (void)wo_session_violations(job.host);
    wo_host_destroy(&job.host);
    wo_colour_destroy(&job.colour);
    return code;
}

int wo_cmd_bench(int argc, char **argv)
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
