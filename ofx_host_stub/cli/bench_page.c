/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "bench.h"

#include <math.h>
#include <string.h>

/* ----------------------------------------------------------------------------------- plots */

/* Colours that people with any colour vision tell apart; the judged method is black. */
static const char *const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                      "#b08000", "#56b4e9", "#7b4ab8"};
static const wo_pen noise_pen = {"#909090", 1, "2 3"};

static wo_pen pen_of(const wo_bench *bench, int method, bool adaptive)
{
    if (method == bench->judged)
        return (wo_pen){"#000000", 2.2, adaptive ? "6 4" : NULL};
    const int place = bench->judged >= 0 && method > bench->judged ? method - 1 : method;
    return (wo_pen){colours[(size_t)place % WO_COUNT(colours)], 1.5, adaptive ? "6 4" : NULL};
}

/* The finished points of a method; gives their number. */
static int curve_of(const wo_bench *bench, const wo_bench_shot *shot, int method, bool adaptive,
                    double *x, double *y, const char **texts)
{
    int count = 0;
    for (int s = 0; s < bench->setting_count; s++) {
        const wo_bench_point *const p = wo_bench_at(bench, shot, method, s);
        if (p->state != WO_BENCH_DONE || bench->setting[s].adaptive != adaptive)
            continue;
        x[count] = p->seconds;
        y[count] = p->rmse;
        texts[count++] = bench->setting[s].text;
    }
    return count;
}

static void draw_curve(const wo_plot *plot, const wo_pen *pen, const double *x, const double *y,
                       const char *const *texts, int count)
{
    double px[WO_BENCH_SETTINGS], py[WO_BENCH_SETTINGS];
    wo_plot_curve(plot, pen, x, y, count);
    for (int i = 0; i < count; i++) {
        px[i] = wo_plot_x(plot, x[i]);
        py[i] = wo_plot_y(plot, y[i]);
        if (isfinite(px[i]) && isfinite(py[i]))
            wo_svg_text(plot->svg, px[i] + 5, py[i] - 5, 9, WO_ANCHOR_START, false, texts[i]);
    }
    wo_svg_dots(plot->svg, pen->colour, pen->width > 2 ? 8 : 6, px, py, count);
}

static void draw_legend(const wo_bench *bench, const wo_bench_shot *shot, wo_svg *svg, double right)
{
    wo_pen pens[WO_BENCH_METHODS];
    const char *names[WO_BENCH_METHODS];
    double x[WO_BENCH_SETTINGS], y[WO_BENCH_SETTINGS];
    const char *texts[WO_BENCH_SETTINGS];
    int count = 0;
    for (int m = 0; m < bench->method_count; m++) {
        if (curve_of(bench, shot, m, false, x, y, texts) == 0 &&
            curve_of(bench, shot, m, true, x, y, texts) == 0)
            continue;
        pens[count] = pen_of(bench, m, false);
        names[count++] = bench->method[m];
    }
    wo_plot_legend(svg, right, 20, pens, names, count);
}

wo_status wo_bench_plot(const wo_bench *bench, const wo_bench_shot *shot, wo_svg *svg,
                        wo_error *error)
{
    enum { WIDTH = 860, HEIGHT = 480 };
    char title[128];
    double x[WO_BENCH_SETTINGS], y[WO_BENCH_SETTINGS];
    const char *texts[WO_BENCH_SETTINGS];
    wo_axis time = {
        1, 0, bench->cpu_clock ? "time of all processors for a render, s" : "time of a render, s",
        0, true};
    wo_axis size = {1, 0, "error: RMSE of the displayed value", 0, true};
    for (int m = 0; m < bench->method_count; m++)
        for (int adaptive = 0; adaptive < 2; adaptive++) {
            const int count = curve_of(bench, shot, m, adaptive, x, y, texts);
            wo_axis_cover(&time, x, count);
            wo_axis_cover(&size, y, count);
        }
    wo_axis_round(&time);
    wo_axis_round(&size);
    snprintf(title, sizeof title, "%s, %s", shot->scene,
             shot->layers ? "all layers" : "source and depth");
    wo_svg_begin(svg, WIDTH, HEIGHT, title);
    const wo_plot plot =
        wo_plot_begin(svg, (wo_box){4, 4, WIDTH - 8, HEIGHT - 8}, title, time, size);
    if (shot->noise >= plot.y.low && shot->noise <= plot.y.high) {
        const double ends[2] = {plot.x.low, plot.x.high}, level[2] = {shot->noise, shot->noise};
        wo_plot_curve(&plot, &noise_pen, ends, level, 2);
        wo_svg_text(svg, plot.box.x + 6, wo_plot_y(&plot, shot->noise) - 4, 9, WO_ANCHOR_START,
                    false, "noise of the reference");
    }
    for (int m = 0; m < bench->method_count; m++)
        for (int adaptive = 0; adaptive < 2; adaptive++) {
            const wo_pen pen = pen_of(bench, m, adaptive);
            const int count = curve_of(bench, shot, m, adaptive, x, y, texts);
            draw_curve(&plot, &pen, x, y, texts, count);
        }
    draw_legend(bench, shot, svg, WIDTH - 20);
    return wo_svg_finish(svg, error);
}

/* ------------------------------------------------------------------------------------ page */

static void put_text(FILE *out, const char *text)
{
    for (; *text; text++) {
        if (*text == '&')
            fputs("&amp;", out);
        else if (*text == '<')
            fputs("&lt;", out);
        else if (*text == '>')
            fputs("&gt;", out);
        else if (*text == '"')
            fputs("&quot;", out);
        else
            fputc(*text, out);
    }
}

static void put_number(FILE *out, double value, int decimals)
{
    char text[32];
    fprintf(out, "<td>%s</td>",
            isnan(value) ? "" : wo_plot_number(text, sizeof text, value, decimals));
}

static const char head[] =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<title>WideOpen: error against run time</title>\n<style>\n"
    "body { font: 15px/1.45 sans-serif; color: #202020; background: #ffffff; max-width: 900px;\n"
    "       margin: 2em auto; padding: 0 1em; }\n"
    "h2 { margin-top: 2em; }\n"
    "svg { max-width: 100%; height: auto; }\n"
    "table { border-collapse: collapse; margin: 0.8em 0; font-size: 13px; }\n"
    "th, td { border-bottom: 1px solid #e0e0e0; padding: 2px 10px; text-align: right; }\n"
    "th { border-bottom: 2px solid #808080; }\n"
    "td.name, th.name { text-align: left; }\n"
    "tr.front { background: #eaf4ea; }\n"
    "tr.beaten td { color: #808080; }\n"
    "tr.failed td { color: #b00020; }\n"
    "summary { cursor: pointer; }\n"
    "</style>\n</head>\n<body>\n<h1>Error against run time</h1>\n";

static void put_facts(const wo_bench *bench, FILE *out)
{
    char text[4096], number[32];
    fputs("<p>", out);
    put_text(out, bench->plugin);
    fprintf(
        out,
        " %u.%u, %u threads. Time is %s, the best of %d interleaved runs, planning included; each "
        "run has a seed of its own, and errors are means over the runs. Errors are against the "
        "ray-traced reference, root mean squares of the displayed value (sRGB curve, black 0, "
        "white 1); 0.004 is one step of an 8-bit display. Sampling error: against the method's "
        "own picture with %d rays a pixel.</p>\n",
        bench->version[0], bench->version[1], bench->threads,
        bench->cpu_clock ? "that of all processors together" : "by the clock on the wall",
        bench->runs, bench->converged);
    fprintf(out,
            "<p>A setting is beaten when one of another method has no more error in less time, "
            "by more than %s %% of the time. An error counts as reached",
            wo_plot_number(number, sizeof number, 100 * bench->time_tolerance, 1));
    fprintf(out,
            " when it is exceeded by no more than %s %%. Rows in green are on the front: no other "
            "setting is better in one and at least as good in the other.</p>\n<ul>\n",
            wo_plot_number(number, sizeof number, 100 * WO_BENCH_REACHED, 1));
    wo_bench_conclusion(bench, text, sizeof text);
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
        fputs("<li>", out);
        put_text(out, line);
        fputs("</li>\n", out);
    }
    fputs("</ul>\n", out);
}

static void put_overview(const wo_bench *bench, FILE *out)
{
    fputs("<table>\n<tr><th class=\"name\">scene</th><th class=\"name\">given</th>"
          "<th>unbeaten</th><th>of</th><th>share of time</th></tr>\n",
          out);
    for (int i = 0; i < bench->shot_count; i++) {
        const wo_bench_shot *const shot = &bench->shots[i];
        const wo_bench_verdict verdict = wo_bench_judge(bench, shot);
        if (verdict.points == 0)
            continue;
        fprintf(out, "<tr><td class=\"name\"><a href=\"#shot%d\">", i);
        put_text(out, shot->scene);
        fprintf(out, "</a></td><td class=\"name\">%s</td><td>%d</td><td>%d</td>",
                wo_bench_given(shot), verdict.unbeaten, verdict.points);
        put_number(out, verdict.share, 2);
        fputs("</tr>\n", out);
    }
    fputs("</table>\n", out);
}

static void put_row(const wo_bench *bench, const wo_bench_shot *shot, int number, FILE *out)
{
    const wo_bench_point *const p = &shot->points[number];
    const wo_bench_setting *const setting = &bench->setting[number % bench->setting_count];
    const char *const kind = p->state != WO_BENCH_DONE                   ? "failed"
                             : wo_bench_on_front(bench, shot, number)    ? "front"
                             : wo_bench_beaten(bench, shot, number) >= 0 ? "beaten"
                                                                         : "near";
    fprintf(out, "<tr class=\"%s\"><td class=\"name\">", kind);
    put_text(out, bench->method[number / bench->setting_count]);
    fprintf(out, "</td><td class=\"name\">%s %s</td>", setting->adaptive ? "target" : "samples",
            setting->text);
    if (p->state != WO_BENCH_DONE) {
        fprintf(out, "<td class=\"name\" colspan=\"8\">%s: ", wo_bench_state_text(p->state));
        put_text(out, p->why);
        fputs("</td></tr>\n", out);
        return;
    }
    put_number(out, p->seconds, 3);
    put_number(out, p->rays / 1e6, 2);
    put_number(out, wo_bench_psnr(p->rmse), 2);
    put_number(out, p->ssim, 5);
    put_number(out, p->relmse, 6);
    put_number(out, p->rmse, 5);
    put_number(out, p->sampling, 5);
    put_number(out, p->estimate, 5);
    fputs("</tr>\n", out);
}

static void put_table(const wo_bench *bench, const wo_bench_shot *shot, FILE *out)
{
    fputs("<details><summary>All settings</summary>\n<table>\n<tr><th class=\"name\">method</th>"
          "<th class=\"name\">setting</th><th>s</th><th>Mrays</th><th>PSNR, dB</th><th>SSIM</th>"
          "<th>relMSE</th><th>RMSE</th><th>sampling</th><th>estimated</th></tr>\n",
          out);
    for (int p = 0; p < bench->method_count * bench->setting_count; p++)
        if (shot->points[p].state != WO_BENCH_LEFT_OUT)
            put_row(bench, shot, p, out);
    fputs("</table></details>\n", out);
}

/* The least error and the least time of each method. */
static void put_best(const wo_bench *bench, const wo_bench_shot *shot, FILE *out)
{
    fputs("<table>\n<tr><th class=\"name\">method</th><th class=\"name\">least error</th>"
          "<th>RMSE</th><th>s</th><th class=\"name\">least time</th><th>RMSE</th><th>s</th></tr>\n",
          out);
    for (int m = 0; m < bench->method_count; m++) {
        int exact = -1, fast = -1;
        for (int s = 0; s < bench->setting_count; s++) {
            const wo_bench_point *const p = wo_bench_at(bench, shot, m, s);
            if (p->state != WO_BENCH_DONE)
                continue;
            if (exact < 0 || p->rmse < wo_bench_at(bench, shot, m, exact)->rmse)
                exact = s;
            if (fast < 0 || p->seconds < wo_bench_at(bench, shot, m, fast)->seconds)
                fast = s;
        }
        if (exact < 0)
            continue;
        fputs("<tr><td class=\"name\">", out);
        put_text(out, bench->method[m]);
        fputs("</td>", out);
        for (int i = 0; i < 2; i++) {
            const int s = i == 0 ? exact : fast;
            const wo_bench_point *const p = wo_bench_at(bench, shot, m, s);
            fprintf(out, "<td class=\"name\">%s %s</td>",
                    bench->setting[s].adaptive ? "target" : "samples", bench->setting[s].text);
            put_number(out, p->rmse, 5);
            put_number(out, p->seconds, 3);
        }
        fputs("</tr>\n", out);
    }
    fputs("</table>\n", out);
}

static wo_status put_shot(const wo_bench *bench, int number, FILE *out, wo_error *error)
{
    const wo_bench_shot *const shot = &bench->shots[number];
    char text[4096];
    fprintf(out, "<h2 id=\"shot%d\">", number);
    put_text(out, shot->scene);
    fprintf(out, ", %s</h2>\n<p>", shot->layers ? "all layers" : "source and depth");
    if (shot->state == WO_BENCH_DONE) {
        char noise[32];
        fprintf(out, "%d x %d px", shot->width, shot->height);
        if (shot->layers)
            fprintf(out, ", %d layers", shot->given);
        if (!isnan(shot->noise))
            fprintf(out, ", the reference's own noise %s",
                    wo_plot_number(noise, sizeof noise, shot->noise, 5));
        fputs(". ", out);
    }
    wo_bench_sentence(bench, shot, text, sizeof text);
    put_text(out, text);
    fputs("</p>\n", out);
    if (shot->state != WO_BENCH_DONE)
        return WO_OK;
    wo_svg svg = {0};
    const wo_status status = wo_bench_plot(bench, shot, &svg, error);
    if (status == WO_OK)
        fputs(strstr(svg.text, "<svg"), out);
    wo_svg_free(&svg);
    put_best(bench, shot, out);
    put_table(bench, shot, out);
    return status;
}

wo_status wo_bench_page(const wo_bench *bench, FILE *out, wo_error *error)
{
    fputs(head, out);
    put_facts(bench, out);
    put_overview(bench, out);
    wo_status status = WO_OK;
    for (int i = 0; i < bench->shot_count && status == WO_OK; i++)
        if (bench->shots[i].state != WO_BENCH_WAITING)
            status = put_shot(bench, i, out, error);
    fputs("</body>\n</html>\n", out);
    return status;
}
