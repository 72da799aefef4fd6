/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "svg.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void put_bytes(wo_svg *svg, const char *bytes, size_t count)
{
    if (svg->failed)
        return;
    if (svg->size - svg->length < count + 1) {
        const size_t size = (svg->length + count + 1) * 2 + 4096;
        char *const text = realloc(svg->text, size);
        if (!text) {
            svg->failed = true;
            return;
        }
        svg->text = text;
        svg->size = size;
    }
    memcpy(svg->text + svg->length, bytes, count);
    svg->length += count;
    svg->text[svg->length] = '\0';
}

static void put(wo_svg *svg, const char *text)
{
    put_bytes(svg, text, strlen(text));
}

/* Rounded to 1/100, without zeros at the end; clamped to +-1e6, which is far outside of any page.
 */
static void put_number(wo_svg *svg, double value)
{
    const double inside = fmin(fmax(isnan(value) ? 0 : value, -1e6), 1e6);
    const long hundredths = lround(inside * 100), size = labs(hundredths);
    char text[32];
    int length = snprintf(text, sizeof text, "%s%ld", hundredths < 0 ? "-" : "", size / 100);
    if (size % 100)
        length += snprintf(text + length, sizeof text - (size_t)length, ".%02ld", size % 100);
    if (size % 100 && text[length - 1] == '0')
        length--;
    put_bytes(svg, text, (size_t)length);
}

static void put_attribute(wo_svg *svg, const char *name, double value)
{
    put(svg, " ");
    put(svg, name);
    put(svg, "=\"");
    put_number(svg, value);
    put(svg, "\"");
}

/* Length of the well-formed UTF-8 sequence at s that XML allows, 0 when there is none. */
static size_t character_length(const unsigned char *s)
{
    if (s[0] < 0x80)
        return s[0] >= 0x20 && s[0] != 0x7F ? 1 : 0;
    const size_t length = s[0] >= 0xF0 ? 4 : s[0] >= 0xE0 ? 3 : 2;
    if (s[0] < 0xC2 || s[0] > 0xF4)
        return 0;
    for (size_t i = 1; i < length; i++)
        if ((s[i] & 0xC0) != 0x80)
            return 0;
    const bool overlong = (s[0] == 0xE0 && s[1] < 0xA0) || (s[0] == 0xF0 && s[1] < 0x90);
    const bool outside = (s[0] == 0xED && s[1] > 0x9F) || (s[0] == 0xF4 && s[1] > 0x8F) ||
                         (s[0] == 0xEF && s[1] == 0xBF && s[2] >= 0xBE);
    return overlong || outside ? 0 : length;
}

static void put_escaped(wo_svg *svg, const char *text)
{
    const unsigned char *s = (const unsigned char *)text;
    while (*s) {
        const size_t length = character_length(s);
        if (length == 0)
            put(svg, "\xEF\xBF\xBD");
        else if (*s == '&')
            put(svg, "&amp;");
        else if (*s == '<')
            put(svg, "&lt;");
        else if (*s == '>')
            put(svg, "&gt;");
        else if (*s == '"')
            put(svg, "&quot;");
        else
            put_bytes(svg, (const char *)s, length);
        s += length ? length : 1;
    }
}

static void put_pen(wo_svg *svg, const wo_pen *pen)
{
    if (!pen) {
        put(svg, " stroke=\"none\"");
        return;
    }
    put(svg, " stroke=\"");
    put(svg, pen->colour);
    put(svg, "\"");
    put_attribute(svg, "stroke-width", pen->width);
    if (pen->dash) {
        put(svg, " stroke-dasharray=\"");
        put(svg, pen->dash);
        put(svg, "\"");
    }
}

void wo_svg_begin(wo_svg *svg, double width, double height, const char *title)
{
    *svg = (wo_svg){0};
    put(svg, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
             "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\"");
    put_attribute(svg, "width", width);
    put_attribute(svg, "height", height);
    put(svg, " viewBox=\"0 0 ");
    put_number(svg, width);
    put(svg, " ");
    put_number(svg, height);
    put(svg, "\" font-family=\"Helvetica, Arial, sans-serif\" stroke-linejoin=\"round\">\n<title>");
    put_escaped(svg, title);
    put(svg, "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n");
}

void wo_svg_line(wo_svg *svg, const wo_pen *pen, double x1, double y1, double x2, double y2)
{
    const double x[2] = {x1, x2}, y[2] = {y1, y2};
    wo_svg_path(svg, pen, NULL, x, y, 2);
}

static void put_point(wo_svg *svg, const char *verb, double x, double y)
{
    put(svg, verb);
    put_number(svg, x);
    put(svg, " ");
    put_number(svg, y);
}

static bool in_box(const wo_svg *svg, double x, double y)
{
    return !svg->clipped ||
           (x >= svg->left && x <= svg->right && y >= svg->top && y <= svg->bottom);
}

/* Narrows the part from..to of a line to where start + t step is in low..high. */
static void narrow(double start, double step, double low, double high, double *from, double *to)
{
    if (step == 0) {
        if (start < low || start > high)
            *to = -1;
        return;
    }
    const double a = (low - start) / step;
    const double b = (high - start) / step;
    *from = fmax(*from, fmin(a, b));
    *to = fmin(*to, fmax(a, b));
}

/* The part of a line that is in the box (Liang and Barsky 1984). *at: where the last one ended. */
static void put_clipped(wo_svg *svg, double x, double y, double x2, double y2, double at[2])
{
    double from = 0;
    double to = 1;
    narrow(x, x2 - x, svg->left, svg->right, &from, &to);
    narrow(y, y2 - y, svg->top, svg->bottom, &from, &to);
    if (from > to)
        return;
    const double begin[2] = {x + from * (x2 - x), y + from * (y2 - y)};
    if (begin[0] != at[0] || begin[1] != at[1])
        put_point(svg, "M", begin[0], begin[1]);
    at[0] = to < 1 ? x + to * (x2 - x) : x2;
    at[1] = to < 1 ? y + to * (y2 - y) : y2;
    put_point(svg, "L", at[0], at[1]);
}

void wo_svg_path(wo_svg *svg, const wo_pen *pen, const char *fill, const double *x, const double *y,
                 int count)
{
    put(svg, "<path fill=\"");
    put(svg, fill ? fill : "none");
    put(svg, "\"");
    put_pen(svg, pen);
    put(svg, " d=\"");
    bool inside = false;
    double at[2] = {NAN, NAN};
    for (int i = 0; i < count; i++) {
        const bool good = isfinite(x[i]) && isfinite(y[i]);
        if (good && svg->clipped && !fill && inside)
            put_clipped(svg, x[i - 1], y[i - 1], x[i], y[i], at);
        else if (good && (fill || !svg->clipped))
            put_point(svg, inside ? "L" : "M", x[i], y[i]);
        inside = good;
    }
    put(svg, fill && inside ? "Z\"/>\n" : "\"/>\n");
}

void wo_svg_dots(wo_svg *svg, const char *colour, double diameter, const double *x, const double *y,
                 int count)
{
    const wo_pen pen = {colour, diameter, NULL};
    put(svg, "<path fill=\"none\" stroke-linecap=\"round\"");
    put_pen(svg, &pen);
    put(svg, " d=\"");
    for (int i = 0; i < count; i++)
        if (isfinite(x[i]) && isfinite(y[i]) && in_box(svg, x[i], y[i])) {
            put_point(svg, "M", x[i], y[i]);
            put(svg, "h0");
        }
    put(svg, "\"/>\n");
}

static void put_text(wo_svg *svg, double size, wo_anchor anchor, const char *text)
{
    static const char *const anchors[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
    put(svg, anchors[anchor]);
    put_attribute(svg, "font-size", size);
    put(svg, " fill=\"#202020\">");
    put_escaped(svg, text);
    put(svg, "</text>\n");
}

void wo_svg_text(wo_svg *svg, double x, double y, double size, wo_anchor anchor, bool bold,
                 const char *text)
{
    put(svg, "<text");
    put_attribute(svg, "x", x);
    put_attribute(svg, "y", y);
    put(svg, bold ? " font-weight=\"bold\"" : "");
    put_text(svg, size, anchor, text);
}

void wo_svg_text_up(wo_svg *svg, double x, double y, double size, wo_anchor anchor,
                    const char *text)
{
    put(svg, "<text transform=\"translate(");
    put_number(svg, x);
    put(svg, " ");
    put_number(svg, y);
    put(svg, ") rotate(-90)\"");
    put_text(svg, size, anchor, text);
}

void wo_svg_clip_begin(wo_svg *svg, wo_box box)
{
    svg->clipped = true;
    svg->left = box.x;
    svg->top = box.y;
    svg->right = box.x + box.w;
    svg->bottom = box.y + box.h;
}

void wo_svg_clip_end(wo_svg *svg)
{
    svg->clipped = false;
}

wo_status wo_svg_finish(wo_svg *svg, wo_error *error)
{
    put(svg, "</svg>\n");
    return svg->failed ? wo_fail(error, WO_ERR_NOMEM, "out of memory for the drawing") : WO_OK;
}

void wo_svg_free(wo_svg *svg)
{
    free(svg->text);
    *svg = (wo_svg){0};
}
