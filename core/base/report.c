/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/report.h"

#include "number.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const char *wo_stage_text(wo_stage stage)
{
    static const char *const texts[] = {
#define WO_STAGE_TEXT(name, text) text,
        WO_STAGE_LIST(WO_STAGE_TEXT)
#undef WO_STAGE_TEXT
    };
    _Static_assert(WO_COUNT(texts) == WO_STAGE_COUNT, "one text per stage");
    const unsigned index = (unsigned)stage;
    return index < WO_COUNT(texts) ? texts[index] : "unknown";
}

const char *wo_tile_class_text(wo_tile_class tile)
{
    static const char *const texts[] = {
#define WO_TILE_TEXT(name, text) text,
        WO_TILE_CLASS_LIST(WO_TILE_TEXT)
#undef WO_TILE_TEXT
    };
    _Static_assert(WO_COUNT(texts) == WO_TILE_CLASS_COUNT, "one text per class");
    const unsigned index = (unsigned)tile;
    return index < WO_COUNT(texts) ? texts[index] : "unknown";
}

static const char *or_empty(const char *text)
{
    return text ? text : "";
}

static int kept(const wo_report *report)
{
    const int count = report->left_out_count;
    return count < 0 ? 0 : count > WO_LEFT_OUT_MAX ? WO_LEFT_OUT_MAX : count;
}

void wo_report_leave_out(wo_report *report, const char *what, const char *why, double amount,
                         const char *unit)
{
    if (!report)
        return;
    const int count = kept(report);
    what = or_empty(what);
    why = or_empty(why);
    for (int i = 0; i < count; i++) {
        wo_left_out *const row = &report->left_out[i];
        if (strcmp(or_empty(row->what), what) == 0 && strcmp(or_empty(row->why), why) == 0) {
            row->amount += amount;
            return;
        }
    }
    if (count < WO_LEFT_OUT_MAX) {
        report->left_out[count] = (wo_left_out){what, why, amount, or_empty(unit)};
        report->left_out_count = count + 1;
    }
}

static int uses(const wo_report *report)
{
    const int count = report->camera_count;
    return count < 0 ? 0 : count > WO_CAMERA_USES_MAX ? WO_CAMERA_USES_MAX : count;
}

void wo_report_camera(wo_report *report, const char *key, double value, const char *unit,
                      const char *name, const char *why)
{
    if (!report || uses(report) == WO_CAMERA_USES_MAX)
        return;
    wo_camera_use *const use = &report->camera[uses(report)];
    *use = (wo_camera_use){
        .key = or_empty(key), .value = value, .unit = or_empty(unit), .why = or_empty(why)};
    snprintf(use->name, sizeof use->name, "%s", or_empty(name));
    report->camera_count = uses(report) + 1;
}

static int warned(const wo_report *report)
{
    const int count = report->warning_count;
    return count < 0 ? 0 : count > WO_WARNINGS_MAX ? WO_WARNINGS_MAX : count;
}

/* Room for a warning's text; NULL when the key has one or none is left. */
static wo_warning *new_warning(wo_report *report, const char *key)
{
    const int count = warned(report);
    for (int i = 0; i < count; i++)
        if (strcmp(or_empty(report->warnings[i].key), or_empty(key)) == 0)
            return NULL;
    if (count == WO_WARNINGS_MAX)
        return NULL;
    report->warning_count = count + 1;
    report->warnings[count].key = or_empty(key);
    return &report->warnings[count];
}

void wo_report_warn(wo_report *report, const char *key, const char *format, ...)
{
    wo_warning *const warning = report ? new_warning(report, key) : NULL;
    if (!warning)
        return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(warning->text, sizeof warning->text, format, arguments);
    va_end(arguments);
}

void wo_report_add(wo_report *total, const wo_report *part)
{
    if (!total || !part)
        return;
    /* A fraction of light: the parts count by their pixels. */
    const double pixels = (double)total->pixels + (double)part->pixels;
    if (pixels > 0)
        total->guessed =
            (total->guessed * (double)total->pixels + part->guessed * (double)part->pixels) /
            pixels;
    for (int i = 0; i < WO_STAGE_COUNT; i++)
        total->seconds[i] += part->seconds[i];
    for (int i = 0; i < WO_TILE_CLASS_COUNT; i++) {
        total->tiles[i] += part->tiles[i];
        total->square_error[i] += part->square_error[i];
        total->error_pixels[i] += part->error_pixels[i];
    }
    total->pixels += part->pixels;
    total->rays += part->rays;
    total->steps += part->steps;
    total->guessed_pixels += part->guessed_pixels;
    total->sanitised_colour += part->sanitised_colour;
    total->sanitised_depth += part->sanitised_depth;
    total->edge_depth += part->edge_depth;
    total->mixed_depth += part->mixed_depth;
    total->clamped_radius += part->clamped_radius;
    total->largest_radius = fmax(total->largest_radius, part->largest_radius);
    for (int i = 0; i < kept(part); i++) {
        const wo_left_out *const row = &part->left_out[i];
        wo_report_leave_out(total, row->what, row->why, row->amount, row->unit);
    }
    if (uses(total) == 0) {
        memcpy(total->camera, part->camera, sizeof total->camera);
        total->camera_count = uses(part);
    }
    for (int i = 0; i < warned(part); i++)
        wo_report_warn(total, part->warnings[i].key, "%s", part->warnings[i].text);
}

/* Text that grows in a buffer of the caller and keeps counting when the buffer is full. */
typedef struct writer {
    char *buffer;
    size_t size;
    size_t length;
} writer;

static void put_bytes(writer *out, const char *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++, out->length++)
        if (out->length + 1 < out->size)
            out->buffer[out->length] = bytes[i];
}

WO_PRINTF(2, 3) static void put(writer *out, const char *format, ...)
{
    char text[128];
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (length > 0)
        put_bytes(out, text, (size_t)length < sizeof text ? (size_t)length : sizeof text - 1);
}

/* Bytes of the well-formed UTF-8 sequence at text, 0 if it is none. */
static size_t utf8_length(const unsigned char *text)
{
    const unsigned char lead = text[0];
    const size_t length = lead < 0x80                   ? 1
                          : lead >= 0xc2 && lead < 0xe0 ? 2
                          : lead >= 0xe0 && lead < 0xf0 ? 3
                          : lead >= 0xf0 && lead < 0xf5 ? 4
                                                        : 0;
    for (size_t i = 1; i < length; i++)
        if ((text[i] & 0xc0) != 0x80)
            return 0;
    /* Overlong forms, surrogates, beyond the last code point. */
    if ((lead == 0xe0 && text[1] < 0xa0) || (lead == 0xed && text[1] > 0x9f) ||
        (lead == 0xf0 && text[1] < 0x90) || (lead == 0xf4 && text[1] > 0x8f))
        return 0;
    return length;
}

static void put_string(writer *out, const char *text)
{
    put_bytes(out, "\"", 1);
    for (const unsigned char *at = (const unsigned char *)or_empty(text); *at;) {
        const size_t length = utf8_length(at);
        if (length == 0)
            put(out, "\\ufffd");
        else if (*at < 0x20 || *at == 0x7f)
            put(out, "\\u%04x", *at);
        else if (*at == '"' || *at == '\\')
            put(out, "\\%c", *at);
        else
            put_bytes(out, (const char *)at, length);
        at += length ? length : 1;
    }
    put_bytes(out, "\"", 1);
}

static void put_number(writer *out, double value)
{
    char text[WO_NUMBER_SIZE];
    wo_number_print(value, text);
    put(out, "%s", isfinite(value) ? text : "null");
}

static void put_count(writer *out, const char *key, int64_t value)
{
    put(out, "\"%s\": %" PRId64 ", ", key, value);
}

static void put_camera(writer *out, const wo_report *report)
{
    put(out, ", \"camera\": [");
    for (int i = 0; i < uses(report); i++) {
        const wo_camera_use *const use = &report->camera[i];
        const bool known = or_empty(use->key)[0] != 0;
        put(out, "%s{\"name\": ", i ? ", " : "");
        put_string(out, use->name);
        if (known) {
            put(out, ", \"param\": ");
            put_string(out, use->key);
            put(out, ", \"value\": ");
            put_number(out, use->value);
            put(out, ", \"unit\": ");
            put_string(out, use->unit);
        }
        put(out, ", \"used\": %s, \"why\": ", or_empty(use->why)[0] ? "false" : "true");
        put_string(out, use->why);
        put(out, "}");
    }
    put(out, "]");
}

static void put_warnings(writer *out, const wo_report *report)
{
    put(out, ", \"warnings\": [");
    for (int i = 0; i < warned(report); i++) {
        put(out, "%s{\"key\": ", i ? ", " : "");
        put_string(out, report->warnings[i].key);
        put(out, ", \"text\": ");
        put_string(out, report->warnings[i].text);
        put(out, "}");
    }
    put(out, "]");
}

/* Root mean squares; null where nothing was estimated. */
static void put_errors(writer *out, const wo_report *report)
{
    double square = 0;
    int64_t pixels = 0;
    put(out, "\"estimated_error\": {");
    for (int i = 0; i < WO_TILE_CLASS_COUNT; i++) {
        put(out, "\"%s\": ", wo_tile_class_text((wo_tile_class)i));
        put_number(out, sqrt(report->square_error[i] / (double)report->error_pixels[i]));
        put(out, ", ");
        square += report->square_error[i];
        pixels += report->error_pixels[i];
    }
    put(out, "\"all\": ");
    put_number(out, sqrt(square / (double)pixels));
    put(out, "}, ");
}

int wo_report_json(const wo_report *report, char *buffer, size_t size)
{
    writer out = {buffer, size, 0};
    double total = 0;

    put(&out, "{\"seconds\": {");
    for (int i = 0; i < WO_STAGE_COUNT; i++) {
        put(&out, "\"%s\": ", wo_stage_text((wo_stage)i));
        put_number(&out, report->seconds[i]);
        put(&out, ", ");
        total += report->seconds[i];
    }
    put(&out, "\"total\": ");
    put_number(&out, total);
    put(&out, "}, ");
    put_count(&out, "pixels", report->pixels);
    put_count(&out, "rays", report->rays);
    put_count(&out, "steps", report->steps);
    put(&out, "\"tiles\": {");
    for (int i = 0; i < WO_TILE_CLASS_COUNT; i++)
        put(&out, "%s\"%s\": %" PRId64, i ? ", " : "", wo_tile_class_text((wo_tile_class)i),
            report->tiles[i]);
    put(&out, "}, ");
    put_errors(&out, report);
    put(&out, "\"guessed\": ");
    put_number(&out, report->guessed);
    put(&out, ", ");
    put_count(&out, "guessed_pixels", report->guessed_pixels);
    put_count(&out, "sanitised_colour", report->sanitised_colour);
    put_count(&out, "sanitised_depth", report->sanitised_depth);
    put_count(&out, "edge_depth", report->edge_depth);
    put_count(&out, "mixed_depth", report->mixed_depth);
    put_count(&out, "clamped_radius", report->clamped_radius);
    put(&out, "\"largest_radius\": ");
    put_number(&out, report->largest_radius);
    put(&out, ", \"left_out\": [");
    for (int i = 0; i < kept(report); i++) {
        const wo_left_out *const row = &report->left_out[i];
        put(&out, "%s{\"what\": ", i ? ", " : "");
        put_string(&out, row->what);
        put(&out, ", \"why\": ");
        put_string(&out, row->why);
        put(&out, ", \"amount\": ");
        put_number(&out, row->amount);
        put(&out, ", \"unit\": ");
        put_string(&out, row->unit);
        put(&out, "}");
    }
    put(&out, "]");
    put_camera(&out, report);
    put_warnings(&out, report);
    put(&out, "}");

    /* Half an object is of no use to a parser: what does not fit becomes an empty one. */
    if (size > 0) {
        if (out.length < size)
            buffer[out.length] = '\0';
        else
            snprintf(buffer, size, "%s", size > 2 ? "{}" : "");
    }
    return (int)out.length;
}
