/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "bench_request.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------------------------ lists */

bool wo_bench_split(const char *text, char words[][64], int most, int *count)
{
    *count = 0;
    for (;;) {
        const size_t length = strcspn(text, ",");
        if (length == 0 || length >= 64 || *count >= most)
            return false;
        memcpy(words[*count], text, length);
        words[(*count)++][length] = '\0';
        if (!text[length])
            return true;
        text += length + 1;
    }
}

/* One number of a list; whole numbers for rays. */
static bool read_setting(const char *word, bool adaptive, wo_bench_setting *setting)
{
    double value;
    if (!wo_read_numbers(word, &value, 1))
        return false;
    if (adaptive ? !(value > 0 && value <= 1) : !(value >= 1 && value <= 16384))
        return false;
    if (!adaptive && value != floor(value))
        return false;
    *setting = (wo_bench_setting){.adaptive = adaptive, .value = value};
    wo_bench_number(setting->text, sizeof setting->text, value);
    return true;
}

static int by_quality(const void *a, const void *b)
{
    const wo_bench_setting *const p = a, *const q = b;
    if (p->adaptive != q->adaptive)
        return p->adaptive ? 1 : -1;
    const int rising = (p->value > q->value) - (p->value < q->value);
    return p->adaptive ? -rising : rising;
}

static int add_settings(const wo_args *args, const char *option, bool adaptive,
                        const char *standard, wo_bench *bench)
{
    const char *const given = wo_args_value(args, option, 0);
    const char *const text = given ? given : standard;
    char words[WO_BENCH_SETTINGS][64];
    int count;
    if (strcmp(text, "none") == 0)
        return WO_EXIT_OK;
    if (!wo_bench_split(text, words, WO_BENCH_SETTINGS / 2, &count))
        return wo_usage_fault("bench", "%s %s: give 1 to %d numbers with commas, or none", option,
                              text, WO_BENCH_SETTINGS / 2);
    for (int i = 0; i < count; i++)
        if (!read_setting(words[i], adaptive, &bench->setting[bench->setting_count++]))
            return wo_usage_fault("bench", "%s: \"%s\" is no %s", option, words[i],
                                  adaptive ? "number above 0 and up to 1"
                                           : "whole number in 1..16384");
    return WO_EXIT_OK;
}

static bool repeated(const wo_bench *bench)
{
    for (int i = 1; i < bench->setting_count; i++)
        if (by_quality(&bench->setting[i - 1], &bench->setting[i]) == 0)
            return true;
    return false;
}

static int read_settings(const wo_args *args, wo_bench *bench)
{
    const bool quick = wo_args_count(args, "--quick") > 0;
    int code = add_settings(args, "--samples", false, quick ? "16,64" : "16,64,256", bench);
    if (code == WO_EXIT_OK)
        code = add_settings(args, "--targets", true, quick ? "0.008" : "0.016,0.008,0.004", bench);
    if (code != WO_EXIT_OK)
        return code;
    if (bench->setting_count == 0)
        return wo_usage_fault("bench", "--samples none and --targets none leave nothing to do");
    qsort(bench->setting, (size_t)bench->setting_count, sizeof bench->setting[0], by_quality);
    if (repeated(bench))
        return wo_usage_fault("bench", "a number is twice in --samples or --targets");
    return WO_EXIT_OK;
}

/* ----------------------------------------------------------------------------------- scenes */

static int unknown_scene(const char *name)
{
    const char *names[WO_BENCH_SCENES];
    char near[512];
    size_t count = 0;
    while (count < WO_COUNT(names) && wo_footage_scene_at(count)) {
        names[count] = wo_footage_scene_at(count)->name;
        count++;
    }
    wo_near_words(name, names, count, near, sizeof near);
    return wo_usage_fault("bench", "there is no scene %s; there is: %s", name, near);
}

/* The last name of a path, for people and files. */
static void name_of_folder(const char *path, char *name, size_t size)
{
    size_t end = strlen(path);
    while (end > 1 && path[end - 1] == '/')
        end--;
    size_t begin = end;
    while (begin > 0 && path[begin - 1] != '/')
        begin--;
    snprintf(name, size, "%.*s", (int)(end - begin), path + begin);
}

static int read_scenes(wo_bench_request *r)
{
    static const char *const standard[] = {"still-life", "fence",         "night-lights",
                                           "two-planes", "slanted-plane", "hair"};
    const wo_args *const args = r->args;
    const char *const text = wo_args_value(args, "--scenes", 0);
    r->folder_count = wo_args_count(args, "--scene-dir");
    if (text && !wo_bench_split(text, r->scene, WO_BENCH_SCENES, &r->scene_count))
        return wo_usage_fault("bench", "--scenes %s: give names with commas", text);
    if (!text && wo_args_count(args, "--quick") && r->folder_count == 0)
        snprintf(r->scene[r->scene_count++], sizeof r->scene[0], "still-life");
    else if (!text && r->folder_count == 0)
        for (size_t i = 0; i < WO_COUNT(standard); i++)
            snprintf(r->scene[r->scene_count++], sizeof r->scene[0], "%s", standard[i]);
    for (int i = 0; i < r->scene_count; i++)
        if (!wo_footage_scene_find(r->scene[i]))
            return unknown_scene(r->scene[i]);
    if (r->scene_count + r->folder_count > WO_BENCH_SCENES)
        return wo_usage_fault("bench", "more than %d scenes", WO_BENCH_SCENES);
    for (int i = 0; i < r->folder_count; i++)
        name_of_folder(wo_args_value(args, "--scene-dir", i), r->scene[r->scene_count++],
                       sizeof r->scene[0]);
    for (int i = 0; i < r->scene_count; i++)
        for (int k = 0; k < i; k++)
            if (strcmp(r->scene[i], r->scene[k]) == 0)
                return wo_usage_fault("bench",
                                      "two scenes are called %s: their files would "
                                      "overwrite each other",
                                      r->scene[i]);
    return WO_EXIT_OK;
}

static int read_given(wo_bench_request *r)
{
    const char *const text = wo_args_value(r->args, "--given", 0);
    char words[2][64];
    int count;
    if (!text) {
        r->given[0] = r->given[1] = true;
        return WO_EXIT_OK;
    }
    if (!wo_bench_split(text, words, 2, &count))
        return wo_usage_fault("bench", "--given %s: layers, sd, or both with a comma", text);
    for (int i = 0; i < count; i++) {
        if (strcmp(words[i], "layers") != 0 && strcmp(words[i], "sd") != 0)
            return wo_usage_fault("bench", "--given: \"%s\" is neither layers nor sd", words[i]);
        r->given[strcmp(words[i], "sd") == 0] = true;
    }
    return WO_EXIT_OK;
}

static int read_footage(wo_bench_request *r)
{
    wo_footage_options *const o = &r->footage;
    const bool quick = wo_args_count(r->args, "--quick") > 0;
    const char *const size = wo_args_value(r->args, "--size", 0);
    int seed = 0;
    *o = (wo_footage_options){.width = quick ? 320 : 640,
                              .height = quick ? 180 : 360,
                              .reference_spp = quick ? 256 : 0,
                              .layers = 4};
    if (size && !wo_read_size(size, &o->width, &o->height))
        return wo_usage_fault("bench", "--size %s: give WIDTHxHEIGHT, each 1..65536", size);
    if (!wo_args_int(r->args, "--reference", 16, 1 << 20, &o->reference_spp) ||
        !wo_args_int(r->args, "--footage-seed", 0, INT_MAX, &seed))
        return WO_EXIT_USAGE;
    const int shorter = o->width < o->height ? o->width : o->height;
    o->overscan = shorter / 10;
    o->seed = (uint64_t)seed;
    return WO_EXIT_OK;
}

static int read_numbers(wo_bench_request *r, wo_bench_job *job)
{
    wo_bench *const bench = job->bench;
    const bool quick = wo_args_count(r->args, "--quick") > 0;
    int threads = 0;
    bench->runs = quick ? 1 : 3;
    bench->converged = quick ? 1024 : 4096;
    bench->time_tolerance = 0.1;
    job->limit = 300;
    if (!wo_args_int(r->args, "--repeats", 1, WO_BENCH_RUNS, &bench->runs) ||
        !wo_args_int(r->args, "--converged", 0, 16384, &bench->converged) ||
        !wo_args_int(r->args, "--crop", 0, 65536, &bench->crop) ||
        !wo_args_int(r->args, "--threads", 1, 256, &threads) ||
        !wo_args_double(r->args, "--tolerance", 0, 1, &bench->time_tolerance) ||
        !wo_args_double(r->args, "--limit", 0.001, 1e6, &job->limit))
        return WO_EXIT_USAGE;
    const char *const clock = wo_args_value(r->args, "--clock", 0);
    if (clock && strcmp(clock, "wall") != 0 && strcmp(clock, "cpu") != 0)
        return wo_usage_fault("bench", "--clock %s: wall or cpu", clock);
    bench->cpu_clock = clock && strcmp(clock, "cpu") == 0;
    r->threads = (unsigned)threads;
    r->progress = wo_bar_wanted(wo_args_count(r->args, "--progress") > 0,
                                wo_args_count(r->args, "--no-progress") > 0);
    r->output = wo_args_value(r->args, "--output", 0);
    if (!r->output)
        return wo_usage_fault("bench", "-o DIR is needed: where the results go");
    const int used = snprintf(r->root, sizeof r->root, "%s/footage", r->output);
    if (used < 0 || (size_t)used + 300 > sizeof r->root)
        return wo_usage_fault("bench", "-o: the path is too long");
    return WO_EXIT_OK;
}

int wo_bench_read(wo_bench_request *request, const wo_args *args, wo_bench_job *job)
{
    request->args = args;
    int code = read_numbers(request, job);
    if (code == WO_EXIT_OK)
        code = read_settings(args, job->bench);
    if (code == WO_EXIT_OK)
        code = read_given(request);
    if (code == WO_EXIT_OK)
        code = read_footage(request);
    return code == WO_EXIT_OK ? read_scenes(request) : code;
}
