/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const wo_pen frame_pen = {"#404040", 1, NULL};
static const wo_pen grid_pen = {"#e4e4e4", 0.8, NULL};
static const wo_pen zero_pen = {"#a0a0a0", 0.8, NULL};

/* A range that can be divided: finite, rising, wide enough for doubles to tell its parts apart. */
static void sane_range(double *low, double *high)
{
    if (!isfinite(*low) || !isfinite(*high)) {
        *low = isfinite(*low) ? *low : isfinite(*high) ? *high - 1 : 0;
        *high = isfinite(*high) ? *high : *low + 1;
    }
    *low = fmin(fmax(*low, -1e300), 1e300);
    *high = fmin(fmax(*high, -1e300), 1e300);
    if (*low > *high) {
        const double swap = *low;
        *low = *high;
        *high = swap;
    }
    const double size = fmax(fabs(*low), fabs(*high));
    if (*high - *low <= size * 1e-9 || *high - *low < 1e-300) {
        const double margin = size > 1e-290 ? size * 0.1 : 1;
        *low -= margin;
        *high += margin;
    }
}

static void sane_log_range(double *low, double *high)
{
    *low = isfinite(*low) && *low >= 1e-100 ? fmin(*low, 1e100) : 1e-3;
    *high = isfinite(*high) && *high >= 1e-100 ? fmin(*high, 1e100) : *low * 10;
    if (*high < *low * 1.001) {
        *high = *low * 1.5;
        *low /= 1.5;
    }
}

/* First digits of the ticks of a decade; the coarse ones are among the fine ones. */
typedef struct log_digits {
    int count;
    double digit[10];
} log_digits;
static const log_digits coarse = {3, {1, 2, 5}};
static const log_digits fine = {10, {1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9}};

/* The n-th of ..., 0.5, 1, 2, 5, 10, ...; 0 is 1. */
static double log_tick(const log_digits *set, int n)
{
    const int power = n >= 0 ? n / set->count : -((set->count - 1 - n) / set->count);
    return set->digit[n - set->count * power] * pow(10, power);
}

/* The last one up to value. */
static int log_tick_below(const log_digits *set, double value)
{
    int n = set->count * (int)floor(log10(value)) - 1;
    while (log_tick(set, n + 1) <= value * (1 + 1e-9))
        n++;
    return n;
}

void wo_ticks_make_log(double low, double high, wo_ticks *ticks)
{
    *ticks = (wo_ticks){0};
    sane_log_range(&low, &high);
    const double decades = log10(high / low);
    const log_digits *const set = decades <= 1.0001 ? &fine : &coarse;
    const int stride = decades <= 5 ? 1 : 3 * (1 + (int)(decades / 10));
    int n = log_tick_below(set, low * (1 - 1e-6)) + 1;
    while (n % stride != 0)
        n++;
    for (; ticks->count < WO_TICKS_MAX && log_tick(set, n) <= high * (1 + 1e-6); n += stride)
        ticks->value[ticks->count++] = log_tick(set, n);
}

void wo_ticks_make(double low, double high, int wanted, wo_ticks *ticks)
{
    *ticks = (wo_ticks){0};
    sane_range(&low, &high);
    const int parts = wanted < 2 ? 2 : wanted > 16 ? 16 : wanted;
    const double rough = (high - low) / parts;
    const int power = (int)floor(log10(rough) + 1e-9);
    const double ten = pow(10, power), times = rough / ten;
    const int digit = times < 1.5 ? 1 : times < 3.5 ? 2 : times < 7.5 ? 5 : 10;
    ticks->step = digit * ten;
    const int decimals = digit == 10 ? -(power + 1) : -power;
    const double size = fmax(fabs(low), fabs(high));
    ticks->decimals = decimals > 7 || size >= 1e7 ? -1 : decimals > 0 ? decimals : 0;
    const double first = ceil(low / ticks->step - 1e-6);
    for (int i = 0; i < WO_TICKS_MAX; i++) {
        const double value = (first + i) * ticks->step;
        if (value > high + ticks->step * 1e-6)
            break;
        ticks->value[ticks->count++] = value == 0 ? 0 : value;
    }
}

/* |value| < 1e9, decimals up to 9. */
static void fixed_text(char *text, size_t size, double value, int decimals)
{
    long long scale = 1;
    for (int i = 0; i < decimals; i++)
        scale *= 10;
    const long long all = llround(fabs(value) * (double)scale);
    const char *const sign = value < 0 && all > 0 ? "-" : "";
    int length = snprintf(text, size, "%s%lld", sign, all / scale);
    bool first = true;
    for (; decimals > 0 && length > 0 && (size_t)length + 2 < size; decimals--) {
        if (first)
            text[length++] = '.';
        first = false;
        scale /= 10;
        text[length++] = (char)('0' + all / scale % 10);
        text[length] = '\0';
    }
}

char *wo_plot_number(char *text, size_t size, double value, int decimals)
{
    if (!isfinite(value)) {
        snprintf(text, size, "%s", isnan(value) ? "-" : value > 0 ? "infinite" : "-infinite");
        return text;
    }
    if (decimals >= 0 && fabs(value) < 1e9) {
        fixed_text(text, size, value, decimals > 9 ? 9 : decimals);
        return text;
    }
    int power = value == 0 ? 0 : (int)floor(log10(fabs(value)));
    double mantissa = value == 0 ? 0 : value / pow(10, power);
    if (fabs(mantissa) >= 9.995) {
        mantissa /= 10;
        power++;
    }
    char digits[32];
    fixed_text(digits, sizeof digits, mantissa, 2);
    snprintf(text, size, "%se%d", digits, power);
    return text;
}

void wo_axis_cover(wo_axis *axis, const double *values, int count)
{
    for (int i = 0; i < count; i++) {
        if (!isfinite(values[i]) || (axis->log && values[i] <= 0))
            continue;
        const bool empty = axis->low > axis->high;
        axis->low = empty ? values[i] : fmin(axis->low, values[i]);
        axis->high = empty ? values[i] : fmax(axis->high, values[i]);
    }
}

static int wanted_ticks(const wo_axis *axis)
{
    return axis->ticks ? axis->ticks : 5;
}

void wo_axis_round(wo_axis *axis)
{
    wo_ticks ticks;
    if (axis->low > axis->high) {
        axis->low = 0;
        axis->high = 1;
    }
    if (axis->log) {
        sane_log_range(&axis->low, &axis->high);
        const log_digits *const set = axis->high <= 4 * axis->low ? &fine : &coarse;
        axis->low = log_tick(set, log_tick_below(set, axis->low));
        axis->high = log_tick(set, log_tick_below(set, axis->high * (1 - 1e-6)) + 1);
        return;
    }
    sane_range(&axis->low, &axis->high);
    for (int i = 0; i < 4; i++) { /* a wider range may have coarser ticks */
        wo_ticks_make(axis->low, axis->high, wanted_ticks(axis), &ticks);
        axis->low = floor(axis->low / ticks.step + 1e-6) * ticks.step;
        axis->high = ceil(axis->high / ticks.step - 1e-6) * ticks.step;
    }
}

void wo_axis_widen(wo_axis *axis, double least)
{
    const double missing = least - (axis->high - axis->low);
    if (axis->low <= axis->high && missing > 0) {
        axis->low -= missing / 2;
        axis->high += missing / 2;
    }
}

static double along(const wo_axis *axis, double value)
{
    if (axis->log)
        return value > 0 ? log(value / axis->low) / log(axis->high / axis->low) : NAN;
    return (value - axis->low) / (axis->high - axis->low);
}

double wo_plot_x(const wo_plot *plot, double x)
{
    return plot->box.x + along(&plot->x, x) * plot->box.w;
}

double wo_plot_y(const wo_plot *plot, double y)
{
    return plot->box.y + (1 - along(&plot->y, y)) * plot->box.h;
}

static void axis_ticks(const wo_axis *axis, wo_ticks *ticks)
{
    if (axis->log)
        wo_ticks_make_log(axis->low, axis->high, ticks);
    else
        wo_ticks_make(axis->low, axis->high, wanted_ticks(axis), ticks);
}

static char *tick_text(const wo_axis *axis, const wo_ticks *ticks, int i, char *text, size_t size)
{
    int decimals = ticks->decimals;
    if (axis->log) {
        const int power = (int)floor(log10(ticks->value[i]) + 1e-6);
        const bool half = fabs(ticks->value[i] / pow(10, power) - 1.5) < 1e-6;
        decimals = power < -6 || power > 6 ? -1 : power < half ? half - power : 0;
    }
    return wo_plot_number(text, size, ticks->value[i], decimals);
}

static void draw_x_axis(const wo_plot *plot)
{
    const wo_box b = plot->box;
    const double bottom = b.y + b.h;
    wo_ticks ticks;
    char text[32];
    axis_ticks(&plot->x, &ticks);
    for (int i = 0; i < ticks.count; i++) {
        const double at = wo_plot_x(plot, ticks.value[i]);
        wo_svg_line(plot->svg, ticks.value[i] == 0 ? &zero_pen : &grid_pen, at, b.y, at, bottom);
        wo_svg_line(plot->svg, &frame_pen, at, bottom, at, bottom + 4);
        wo_svg_text(plot->svg, at, bottom + 16, 11, WO_ANCHOR_MIDDLE, false,
                    tick_text(&plot->x, &ticks, i, text, sizeof text));
    }
    wo_svg_text(plot->svg, b.x + b.w / 2, bottom + 32, 12, WO_ANCHOR_MIDDLE, false, plot->x.label);
}

static void draw_y_axis(const wo_plot *plot)
{
    const wo_box b = plot->box;
    wo_ticks ticks;
    char text[32];
    axis_ticks(&plot->y, &ticks);
    for (int i = 0; i < ticks.count; i++) {
        const double at = wo_plot_y(plot, ticks.value[i]);
        wo_svg_line(plot->svg, ticks.value[i] == 0 ? &zero_pen : &grid_pen, b.x, at, b.x + b.w, at);
        wo_svg_line(plot->svg, &frame_pen, b.x - 4, at, b.x, at);
        wo_svg_text(plot->svg, b.x - 7, at + 4, 11, WO_ANCHOR_END, false,
                    tick_text(&plot->y, &ticks, i, text, sizeof text));
    }
    wo_svg_text_up(plot->svg, b.x - 42, b.y + b.h / 2, 12, WO_ANCHOR_MIDDLE, plot->y.label);
}

static void sane_axis(wo_axis *axis)
{
    if (axis->log)
        sane_log_range(&axis->low, &axis->high);
    else
        sane_range(&axis->low, &axis->high);
}

wo_plot wo_plot_begin(wo_svg *svg, wo_box box, const char *title, wo_axis x, wo_axis y)
{
    const double left = y.label ? 58 : 12, below = x.label ? 42 : 12;
    wo_plot plot = {svg, {box.x + left, box.y + 30, box.w - left - 16, box.h - 30 - below}, x, y};
    sane_axis(&plot.x);
    sane_axis(&plot.y);
    if (title)
        wo_svg_text(svg, box.x + 12, box.y + 18, 13, WO_ANCHOR_START, true, title);
    if (x.label)
        draw_x_axis(&plot);
    if (y.label)
        draw_y_axis(&plot);
    const wo_box b = plot.box;
    const double fx[] = {b.x, b.x + b.w, b.x + b.w, b.x, b.x};
    const double fy[] = {b.y, b.y, b.y + b.h, b.y + b.h, b.y};
    wo_svg_path(svg, &frame_pen, NULL, fx, fy, 5);
    return plot;
}

void wo_plot_curve(const wo_plot *plot, const wo_pen *pen, const double *x, const double *y,
                   int count)
{
    double *const at = malloc((size_t)(count > 0 ? count : 1) * 2 * sizeof *at);
    if (!at) {
        plot->svg->failed = true;
        return;
    }
    for (int i = 0; i < count; i++) {
        at[i] = wo_plot_x(plot, x[i]);
        at[count + i] = wo_plot_y(plot, y[i]);
    }
    wo_svg_clip_begin(plot->svg, plot->box);
    wo_svg_path(plot->svg, pen, NULL, at, at + count, count);
    wo_svg_clip_end(plot->svg);
    free(at);
}

double wo_plot_text_width(const char *text, double size, bool bold)
{
    double width = 0;
    for (const unsigned char *s = (const unsigned char *)text; *s; s++) {
        if ((*s & 0xC0) == 0x80)
            continue;
        if (*s >= 0xE0) /* may be as wide as high */
            width += 1.1;
        else if (strchr("WMmw@%", *s))
            width += 1.1;
        else if (strchr("iIjlftr1.,:;'|!()[]/ ", *s))
            width += 0.45;
        else
            width += (*s >= 'A' && *s <= 'Z') || *s >= 0x80 ? 0.82 : 0.71;
    }
    return width * size * (bold ? 1 : 0.89);
}

void wo_plot_legend(wo_svg *svg, double x, double y, const wo_pen *pens, const char *const *names,
                    int count)
{
    for (int i = count - 1; i >= 0; i--) {
        wo_svg_text(svg, x, y, 11, WO_ANCHOR_END, false, names[i]);
        x -= wo_plot_text_width(names[i], 11, false) + 5;
        wo_svg_line(svg, &pens[i], x - 22, y - 4, x, y - 4);
        x -= 22 + 12;
    }
}
