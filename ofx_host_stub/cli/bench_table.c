/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "bench.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

char *wo_bench_number(char *text, size_t size, double value)
{
    if (!isfinite(value)) {
        snprintf(text, size, "%s", "");
        return text;
    }
    snprintf(text, size, "%.7g", value);
    for (char *at = text; *at; at++)
        if (!strchr("0123456789+-e", *at))
            *at = '.';
    return text;
}

/* ------------------------------------------------------------------------------- sentences */

/* Appends to what text holds; what does not fit is cut. */
WO_PRINTF(3, 4) static void add(char *text, size_t size, const char *format, ...)
{
    const size_t used = strlen(text);
    va_list list;
    va_start(list, format);
    if (used + 1 < size)
        vsnprintf(text + used, size - used, format, list);
    va_end(list);
}

static void add_number(char *text, size_t size, double value, int decimals)
{
    char number[32];
    add(text, size, "%s", wo_plot_number(number, sizeof number, value, decimals));
}

static void add_front(const wo_bench *bench, const wo_bench_shot *shot, char *text, size_t size)
{
    const char *between = "On the front: ";
    for (int m = 0; m < bench->method_count; m++) {
        bool first = true;
        for (int s = 0; s < bench->setting_count; s++) {
            if (!wo_bench_on_front(bench, shot, m * bench->setting_count + s))
                continue;
            if (first)
                add(text, size, "%s%s (", between, bench->method[m]);
            add(text, size, "%s%s", first ? "" : ", ", bench->setting[s].text);
            between = "), ";
            first = false;
        }
    }
    add(text, size, "%s", *between == ')' ? ")." : "Nothing was rendered.");
}

static void add_share(const wo_bench *bench, double share, char *text, size_t size)
{
    if (isnan(share))
        return;
    const char *const base = bench->method[bench->base];
    const char *const rays = bench->setting[bench->base_setting].text;
    if (isinf(share)) {
        add(text, size, " It does not reach the error of %s %s.", base, rays);
        return;
    }
    add(text, size, " It reaches the error of %s %s in ", base, rays);
    add_number(text, size, share, 2);
    add(text, size, " of its time.");
}

void wo_bench_sentence(const wo_bench *bench, const wo_bench_shot *shot, char *text, size_t size)
{
    text[0] = '\0';
    if (shot->state != WO_BENCH_DONE) {
        add(text, size, "%s: %s", wo_bench_state_text(shot->state), shot->why);
        return;
    }
    add_front(bench, shot, text, size);
    const wo_bench_verdict verdict = wo_bench_judge(bench, shot);
    if (verdict.points == 0)
        return;
    add(text, size, " %s: %d of %d settings are beaten by no other method.",
        bench->method[bench->judged], verdict.unbeaten, verdict.points);
    add_share(bench, verdict.share, text, size);
}

static void add_summary(const wo_bench *bench, bool layers, char *text, size_t size)
{
    const wo_bench_summary sum = wo_bench_sum(bench, layers);
    if (sum.shots == 0)
        return;
    add(text, size, "%s: %s is on or left of the front of the others on %d of %d scenes",
        layers ? "All layers" : "Source and depth", bench->method[bench->judged], sum.on_front,
        sum.shots);
    if (sum.compared > 0)
        add(text, size, "; it reaches the error of %s %s in at most half its time on %d of %d",
            bench->method[bench->base], bench->setting[bench->base_setting].text, sum.halved,
            sum.compared);
    add(text, size, ".\n");
}

static void add_calibration(const wo_bench *bench, int method, char *text, size_t size)
{
    const wo_bench_calibration c = wo_bench_calibrate(bench, method);
    if (c.renders == 0)
        return;
    add(text, size, "Estimated errors%s%s: %d of %d renders (", method < 0 ? "" : " of ",
        method < 0 ? "" : bench->method[method], c.within, c.renders);
    add_number(text, size, 100.0 * c.within / c.renders, 1);
    add(text, size, " %%) are within a factor ");
    add_number(text, size, WO_BENCH_CALIBRATED, 2);
    add(text, size, " of the true sampling error; true over estimated is ");
    add_number(text, size, c.low, 2);
    add(text, size, " to ");
    add_number(text, size, c.high, 2);
    add(text, size, ", median ");
    add_number(text, size, c.median, 2);
    add(text, size, ".\n");
}

void wo_bench_conclusion(const wo_bench *bench, char *text, size_t size)
{
    int done = 0;
    text[0] = '\0';
    for (int i = 0; i < bench->shot_count; i++)
        done += bench->shots[i].state != WO_BENCH_WAITING;
    if (done < bench->shot_count)
        add(text, size, "Not finished: %d of %d scenes were benched.\n", done, bench->shot_count);
    add_summary(bench, true, text, size);
    add_summary(bench, false, text, size);
    add_calibration(bench, -1, text, size);
    for (int m = 0; m < bench->method_count; m++) {
        const int own = wo_bench_calibrate(bench, m).renders;
        if (own > 0 && own < wo_bench_calibrate(bench, -1).renders)
            add_calibration(bench, m, text, size);
    }
    const int failed = wo_bench_failures(bench);
    if (failed > 0)
        add(text, size, "%d failed.\n", failed);
}

/* ---------------------------------------------------------------------------------- tables */

static const char *cell(char *text, size_t size, double value, int decimals)
{
    return isnan(value) ? "-" : wo_plot_number(text, size, value, decimals);
}

static void print_point(const wo_bench *bench, const wo_bench_shot *shot, int number, FILE *out)
{
    const wo_bench_point *const p = &shot->points[number];
    const wo_bench_setting *const setting = &bench->setting[number % bench->setting_count];
    char t[8][32];
    fprintf(out, "  %-12s %-7s %7s", bench->method[number / bench->setting_count],
            setting->adaptive ? "target" : "samples", setting->text);
    if (p->state != WO_BENCH_DONE) {
        fprintf(out, "  %s: %s\n", wo_bench_state_text(p->state), p->why);
        return;
    }
    const int beaten = wo_bench_beaten(bench, shot, number);
    fprintf(out, " %9s %9s %7s %8s %8s %8s %8s", cell(t[0], 32, p->seconds, 3),
            cell(t[1], 32, p->rays / 1e6, 2), cell(t[2], 32, wo_bench_psnr(p->rmse), 2),
            cell(t[3], 32, p->ssim, 5), cell(t[4], 32, p->rmse, 5), cell(t[5], 32, p->sampling, 5),
            cell(t[6], 32, p->estimate, 5));
    if (beaten >= 0)
        fprintf(out, "  beaten by %s %s\n", bench->method[beaten / bench->setting_count],
                bench->setting[beaten % bench->setting_count].text);
    else
        fputs(wo_bench_on_front(bench, shot, number) ? "  front\n" : "\n", out);
}

void wo_bench_table(const wo_bench *bench, FILE *out)
{
    char text[4096], noise[32];
    for (int i = 0; i < bench->shot_count; i++) {
        const wo_bench_shot *const shot = &bench->shots[i];
        fprintf(out, "%s, %s", shot->scene, wo_bench_given(shot));
        if (shot->state == WO_BENCH_DONE) {
            fprintf(out, ": %dx%d", shot->width, shot->height);
            if (!isnan(shot->noise))
                fprintf(out, ", the reference's own noise %s",
                        wo_plot_number(noise, sizeof noise, shot->noise, 5));
            fprintf(out, "\n  %-12s %-15s %9s %9s %7s %8s %8s %8s %8s\n", "method", "setting",
                    bench->cpu_clock ? "cpu s" : "s", "Mrays", "psnr", "ssim", "rmse", "sampling",
                    "estimate");
            for (int p = 0; p < bench->method_count * bench->setting_count; p++)
                if (shot->points[p].state != WO_BENCH_LEFT_OUT)
                    print_point(bench, shot, p, out);
        }
        wo_bench_sentence(bench, shot, text, sizeof text);
        fprintf(out, "%s%s\n\n", shot->state == WO_BENCH_DONE ? "" : ", ", text);
    }
    wo_bench_conclusion(bench, text, sizeof text);
    fputs(text, out);
}

/* A field of CSV; quoted when it must be. */
static void put_field(FILE *out, const char *text)
{
    if (!strpbrk(text, ",\"\r\n")) {
        fputs(text, out);
        return;
    }
    fputc('"', out);
    for (; *text; text++) {
        if (*text == '"')
            fputc('"', out);
        fputc(*text == '\n' || *text == '\r' ? ' ' : *text, out);
    }
    fputc('"', out);
}

static void put_point(const wo_bench *bench, const wo_bench_shot *shot, int number, FILE *out)
{
    const wo_bench_point *const p = &shot->points[number];
    const wo_bench_setting *const setting = &bench->setting[number % bench->setting_count];
    const bool done = p->state == WO_BENCH_DONE;
    const double values[] = {p->wall_seconds,
                             p->cpu_seconds,
                             p->own_seconds,
                             p->rays,
                             wo_bench_psnr(p->rmse),
                             p->ssim,
                             p->relmse,
                             p->rmse,
                             p->estimate,
                             p->sampling,
                             p->sampling / p->estimate};
    char text[32];
    put_field(out, shot->scene);
    fprintf(out, ",%s,%s,%s,%s,%s,%d", wo_bench_given(shot),
            bench->method[number / bench->setting_count], setting->adaptive ? "target" : "samples",
            setting->text, wo_bench_state_text(p->state), p->runs);
    for (size_t i = 0; i < WO_COUNT(values); i++)
        fprintf(out, ",%s", done ? wo_bench_number(text, sizeof text, values[i]) : "");
    if (done)
        fprintf(out, ",%d,%d,", wo_bench_on_front(bench, shot, number),
                wo_bench_beaten(bench, shot, number) >= 0);
    else
        fputs(",,,", out);
    put_field(out, p->why);
    fputs("\n", out);
}

/* A scene without renders is one row. */
static void put_missing(const wo_bench_shot *shot, FILE *out)
{
    put_field(out, shot->scene);
    fprintf(out, ",%s,,,,%s,0,,,,,,,,,,,,,,", wo_bench_given(shot),
            wo_bench_state_text(shot->state));
    put_field(out, shot->why);
    fputs("\n", out);
}

void wo_bench_csv(const wo_bench *bench, FILE *out)
{
    fputs("scene,given,method,sampling,setting,state,runs,seconds,cpu_seconds,plugin_seconds,rays,"
          "psnr,ssim,"
          "relmse,rmse,estimated_error,sampling_error,sampling_over_estimated,front,beaten,why\n",
          out);
    for (int i = 0; i < bench->shot_count; i++) {
        const wo_bench_shot *const shot = &bench->shots[i];
        if (shot->state == WO_BENCH_DONE)
            for (int p = 0; p < bench->method_count * bench->setting_count; p++)
                put_point(bench, shot, p, out);
        else if (shot->state != WO_BENCH_WAITING)
            put_missing(shot, out);
    }
}

static void json_point(const wo_bench *bench, const wo_bench_shot *shot, int number, wo_json *json)
{
    const wo_bench_point *const p = &shot->points[number];
    const wo_bench_setting *const setting = &bench->setting[number % bench->setting_count];
    wo_json_object(json, NULL);
    wo_json_text(json, "method", bench->method[number / bench->setting_count]);
    wo_json_text(json, "sampling", setting->adaptive ? "target" : "samples");
    wo_json_number(json, "setting", setting->value);
    wo_json_text(json, "state", wo_bench_state_text(p->state));
    if (p->why[0])
        wo_json_text(json, "why", p->why);
    if (p->state == WO_BENCH_DONE) {
        const int beaten = wo_bench_beaten(bench, shot, number);
        wo_json_integer(json, "runs", p->runs);
        wo_json_number(json, "seconds", p->wall_seconds);
        wo_json_number(json, "cpuSeconds", p->cpu_seconds);
        wo_json_number(json, "pluginSeconds", p->own_seconds);
        wo_json_number(json, "rays", p->rays);
        wo_json_number(json, "psnr", wo_bench_psnr(p->rmse));
        wo_json_number(json, "ssim", p->ssim);
        wo_json_number(json, "relmse", p->relmse);
        wo_json_number(json, "rmse", p->rmse);
        wo_json_number(json, "estimatedError", p->estimate);
        wo_json_number(json, "samplingError", p->sampling);
        wo_json_numbers(json, "samplingOverEstimated", p->ratio, p->runs);
        wo_json_bool(json, "front", wo_bench_on_front(bench, shot, number));
        wo_json_bool(json, "beaten", beaten >= 0);
    }
    wo_json_close(json);
}

static void json_shot(const wo_bench *bench, const wo_bench_shot *shot, wo_json *json)
{
    char text[4096];
    const wo_bench_verdict verdict = wo_bench_judge(bench, shot);
    wo_json_object(json, NULL);
    wo_json_text(json, "scene", shot->scene);
    wo_json_text(json, "given", wo_bench_given(shot));
    wo_json_text(json, "state", wo_bench_state_text(shot->state));
    if (shot->state == WO_BENCH_DONE) {
        wo_bench_sentence(bench, shot, text, sizeof text);
        wo_json_integer(json, "width", shot->width);
        wo_json_integer(json, "height", shot->height);
        wo_json_integer(json, "layers", shot->given);
        wo_json_number(json, "referenceNoise", shot->noise);
        wo_json_integer(json, "judgedSettings", verdict.points);
        wo_json_integer(json, "judgedUnbeaten", verdict.unbeaten);
        wo_json_number(json, "shareOfBaseTime", verdict.share);
        wo_json_text(json, "sentence", text);
        wo_json_array(json, "points");
        for (int p = 0; p < bench->method_count * bench->setting_count; p++)
            json_point(bench, shot, p, json);
        wo_json_close(json);
    } else {
        wo_json_text(json, "why", shot->why);
    }
    wo_json_close(json);
}

static void json_summary(const wo_bench *bench, bool layers, wo_json *json)
{
    const wo_bench_summary sum = wo_bench_sum(bench, layers);
    wo_json_object(json, layers ? "layers" : "sd");
    wo_json_integer(json, "scenes", sum.shots);
    wo_json_integer(json, "onFront", sum.on_front);
    wo_json_integer(json, "compared", sum.compared);
    wo_json_integer(json, "halved", sum.halved);
    wo_json_close(json);
}

void wo_bench_json(const wo_bench *bench, FILE *out)
{
    wo_json json;
    const wo_bench_calibration c = wo_bench_calibrate(bench, -1);
    char version[32];
    snprintf(version, sizeof version, "%u.%u", bench->version[0], bench->version[1]);
    wo_json_begin(&json, out);
    wo_json_object(&json, NULL);
    wo_json_text(&json, "wideopen", WO_VERSION_TEXT);
    wo_json_text(&json, "plugin", bench->plugin);
    wo_json_text(&json, "version", version);
    wo_json_integer(&json, "threads", bench->threads);
    wo_json_integer(&json, "repeats", bench->runs);
    wo_json_integer(&json, "convergedSamples", bench->converged);
    wo_json_text(&json, "clock", bench->cpu_clock ? "cpu" : "wall");
    wo_json_number(&json, "timeTolerance", bench->time_tolerance);
    wo_json_number(&json, "reachedWithin", WO_BENCH_REACHED);
    wo_json_text(&json, "judged", bench->judged >= 0 ? bench->method[bench->judged] : NULL);
    wo_json_array(&json, "scenes");
    for (int i = 0; i < bench->shot_count; i++)
        json_shot(bench, &bench->shots[i], &json);
    wo_json_close(&json);
    wo_json_object(&json, "summary");
    json_summary(bench, true, &json);
    json_summary(bench, false, &json);
    wo_json_object(&json, "calibration");
    wo_json_integer(&json, "renders", c.renders);
    wo_json_integer(&json, "within", c.within);
    wo_json_number(&json, "factor", WO_BENCH_CALIBRATED);
    wo_json_number(&json, "low", c.low);
    wo_json_number(&json, "median", c.median);
    wo_json_number(&json, "high", c.high);
    wo_json_close(&json);
    wo_json_integer(&json, "failed", wo_bench_failures(bench));
    wo_json_close(&json);
    wo_json_close(&json);
}
