/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "io_exr_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Attributes that are arrays of numbers: the words of wo_io_attribute.kind are EXR's own. */
typedef enum number_type { NUMBER_INT, NUMBER_UINT, NUMBER_FLOAT, NUMBER_DOUBLE } number_type;

typedef struct array_kind {
    const char *kind;
    exr_attribute_type_t type;
    number_type number;
    int count;
} array_kind;

#define LARGEST_ARRAY 16

static const array_kind array_kinds[] = {
    {"v2i", EXR_ATTR_V2I, NUMBER_INT, 2},
    {"v2f", EXR_ATTR_V2F, NUMBER_FLOAT, 2},
    {"v2d", EXR_ATTR_V2D, NUMBER_DOUBLE, 2},
    {"v3i", EXR_ATTR_V3I, NUMBER_INT, 3},
    {"v3f", EXR_ATTR_V3F, NUMBER_FLOAT, 3},
    {"v3d", EXR_ATTR_V3D, NUMBER_DOUBLE, 3},
    {"box2i", EXR_ATTR_BOX2I, NUMBER_INT, 4},
    {"box2f", EXR_ATTR_BOX2F, NUMBER_FLOAT, 4},
    {"m33f", EXR_ATTR_M33F, NUMBER_FLOAT, 9},
    {"m33d", EXR_ATTR_M33D, NUMBER_DOUBLE, 9},
    {"m44f", EXR_ATTR_M44F, NUMBER_FLOAT, 16},
    {"m44d", EXR_ATTR_M44D, NUMBER_DOUBLE, 16},
    {"chromaticities", EXR_ATTR_CHROMATICITIES, NUMBER_FLOAT, 8},
    {"rational", EXR_ATTR_RATIONAL, NUMBER_INT, 2},
    {"timecode", EXR_ATTR_TIMECODE, NUMBER_UINT, 2},
    {"keycode", EXR_ATTR_KEYCODE, NUMBER_INT, 7},
};

/* Told by members of wo_io_part, or made anew by the writer. */
static bool is_structural(const char *name)
{
    static const char *const names[] = {"channels",
                                        "dataWindow",
                                        "displayWindow",
                                        "lineOrder",
                                        "pixelAspectRatio",
                                        "name",
                                        "type",
                                        "version",
                                        "chunkCount",
                                        "tiles",
                                        "maxSamplesPerPixel",
                                        "preview",
                                        "deepImageState"};
    for (size_t i = 0; i < WO_COUNT(names); i++)
        if (!strcmp(name, names[i]))
            return true;
    return false;
}

static const char *const compressions[] = {"none",  "rle", "zips", "zip",  "piz",
                                           "pxr24", "b44", "b44a", "dwaa", "dwab"};

/* Names other programs expect to be of one kind; with another they refuse the whole file. */
static bool kind_conflicts(const wo_io_attribute *attribute)
{
    static const struct {
        const char *name, *kind;
        wo_io_type type;
    } known[] = {
        {"chromaticities", "chromaticities", WO_IO_TEXT},
        {"whiteLuminance", "", WO_IO_FLOAT},
        {"adoptedNeutral", "v2f", WO_IO_TEXT},
        {"renderingTransform", "", WO_IO_TEXT},
        {"lookModTransform", "", WO_IO_TEXT},
        {"xDensity", "", WO_IO_FLOAT},
        {"owner", "", WO_IO_TEXT},
        {"comments", "", WO_IO_TEXT},
        {"capDate", "", WO_IO_TEXT},
        {"utcOffset", "", WO_IO_FLOAT},
        {"longitude", "", WO_IO_FLOAT},
        {"latitude", "", WO_IO_FLOAT},
        {"altitude", "", WO_IO_FLOAT},
        {"focus", "", WO_IO_FLOAT},
        {"expTime", "", WO_IO_FLOAT},
        {"aperture", "", WO_IO_FLOAT},
        {"isoSpeed", "", WO_IO_FLOAT},
        {"keyCode", "keycode", WO_IO_TEXT},
        {"timeCode", "timecode", WO_IO_TEXT},
        {"wrapmodes", "", WO_IO_TEXT},
        {"framesPerSecond", "rational", WO_IO_TEXT},
        {"multiView", "stringvector", WO_IO_TEXT},
        {"worldToCamera", "m44f", WO_IO_TEXT},
        {"worldToNDC", "m44f", WO_IO_TEXT},
        {"originalDataWindow", "box2i", WO_IO_TEXT},
        {"view", "", WO_IO_TEXT},
        {"screenWindowCenter", "v2f", WO_IO_TEXT},
        {"screenWindowWidth", "", WO_IO_FLOAT},
        {"dwaCompressionLevel", "", WO_IO_FLOAT},
    };
    if (!strcmp(attribute->name, "envmap") || !strcmp(attribute->name, "idManifest"))
        return true;
    for (size_t i = 0; i < WO_COUNT(known); i++)
        if (!strcmp(attribute->name, known[i].name))
            return attribute->type != known[i].type || strcmp(attribute->kind, known[i].kind);
    return false;
}

/* Reading. */

/* Shortest text that reads back as the same number. */
static int print_real(char *buffer, size_t size, double value, int digits, bool single)
{
    int length = 0;
    for (int most = single ? 9 : 17; digits <= most; digits++) {
        length = snprintf(buffer, size, "%.*g", digits, value);
        const double back = strtod(buffer, NULL);
        if (single ? (float)back == (float)value : back == value)
            break;
    }
    return length;
}

static int print_number(char *buffer, size_t size, const void *values, number_type type, size_t i)
{
    int32_t whole;
    uint32_t positive;
    float single;
    double real;
    const char *const at = values;
    switch (type) {
    case NUMBER_INT:
        memcpy(&whole, at + i * sizeof whole, sizeof whole);
        return snprintf(buffer, size, "%ld", (long)whole);
    case NUMBER_UINT:
        memcpy(&positive, at + i * sizeof positive, sizeof positive);
        return snprintf(buffer, size, "%lu", (unsigned long)positive);
    case NUMBER_FLOAT:
        memcpy(&single, at + i * sizeof single, sizeof single);
        return print_real(buffer, size, (double)single, 6, true);
    default:
        memcpy(&real, at + i * sizeof real, sizeof real);
        return print_real(buffer, size, real, 15, false);
    }
}

/* Numbers separated by spaces, malloc-ed. */
static char *print_numbers(const void *values, number_type type, size_t count)
{
    const size_t most = 28; /* characters of one number and a space */
    char *const text = malloc(count * most + 1);
    size_t used = 0;
    if (!text)
        return NULL;
    text[0] = '\0';
    for (size_t i = 0; i < count; i++) {
        if (i)
            text[used++] = ' ';
        const int length = print_number(text + used, most, values, type, i);
        used += length > 0 ? (size_t)length : 0;
    }
    return text;
}

static wo_status add_numbers(wo_io_part *part, const char *name, const char *kind,
                             const void *values, number_type type, size_t count, wo_error *error)
{
    char *const text = print_numbers(values, type, count);
    if (!text)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for attribute %s", name);
    const wo_status status = wo_io_part_add(part, name, WO_IO_TEXT, 0, text, kind, error);
    free(text);
    return status;
}

static wo_status add_strings(wo_io_part *part, const char *name,
                             const exr_attr_string_vector_t *list, wo_error *error)
{
    size_t bytes = 1;
    for (int32_t i = 0; i < list->n_strings; i++)
        bytes += strlen(list->strings[i].str) + 1;
    char *const text = malloc(bytes);
    if (!text)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for attribute %s", name);
    size_t used = 0;
    for (int32_t i = 0; i < list->n_strings; i++) {
        const size_t length = strlen(list->strings[i].str);
        if (i)
            text[used++] = '\n';
        memcpy(text + used, list->strings[i].str, length);
        used += length;
    }
    text[used] = '\0';
    const wo_status status = wo_io_part_add(part, name, WO_IO_TEXT, 0, text, "stringvector", error);
    free(text);
    return status;
}

static wo_status read_attribute(const exr_attribute_t *attribute, wo_io_part *part, wo_error *error)
{
    const char *const name = attribute->name;
    for (size_t i = 0; i < WO_COUNT(array_kinds); i++)
        if (array_kinds[i].type == attribute->type)
            return add_numbers(part, name, array_kinds[i].kind, attribute->rawptr,
                               array_kinds[i].number, (size_t)array_kinds[i].count, error);
    switch (attribute->type) {
    case EXR_ATTR_INT:
        return wo_io_part_add(part, name, WO_IO_INT, attribute->i, NULL, NULL, error);
    case EXR_ATTR_FLOAT:
        return wo_io_part_add(part, name, WO_IO_FLOAT, (double)attribute->f, NULL, NULL, error);
    case EXR_ATTR_DOUBLE:
        return wo_io_part_add(part, name, WO_IO_FLOAT, attribute->d, NULL, "double", error);
    case EXR_ATTR_STRING:
        return wo_io_part_add(part, name, WO_IO_TEXT, 0, attribute->string->str, NULL, error);
    case EXR_ATTR_COMPRESSION:
        if (attribute->uc >= WO_COUNT(compressions))
            return WO_OK;
        return wo_io_part_add(part, name, WO_IO_TEXT, 0, compressions[attribute->uc], NULL, error);
    case EXR_ATTR_FLOAT_VECTOR:
        return add_numbers(part, name, "floatvector", attribute->floatvector->arr, NUMBER_FLOAT,
                           (size_t)attribute->floatvector->length, error);
    case EXR_ATTR_STRING_VECTOR:
        return add_strings(part, name, attribute->stringvector, error);
    default: /* pictures, tables and kinds nobody here knows */
        return WO_OK;
    }
}

wo_status wo_exr_read_attributes(const wo_exr_stream *stream, exr_const_context_t exr, int index,
                                 wo_io_part *part, wo_error *error)
{
    static const char *const space_names[] = {"colorInteropID", "oiio:ColorSpace", "colorspace",
                                              "colorSpace"};
    int32_t count = 0;
    exr_storage_t storage;
    WO_EXR_TRY(stream, exr_get_attribute_count(exr, index, &count));
    for (int32_t i = 0; i < count; i++) {
        const exr_attribute_t *attribute = NULL;
        WO_EXR_TRY(stream,
                   exr_get_attribute_by_index(exr, index, EXR_ATTR_LIST_FILE_ORDER, i, &attribute));
        if (!is_structural(attribute->name))
            WO_TRY(read_attribute(attribute, part, error));
    }
    for (size_t i = 0; i < WO_COUNT(space_names); i++) {
        const wo_io_attribute *const said = wo_io_part_find(part, space_names[i]);
        if (said && said->type == WO_IO_TEXT && said->text[0]) {
            char *const copy = wo_io_copy_text(said->text);
            if (!copy)
                return wo_fail(error, WO_ERR_NOMEM, "no memory for a colour space");
            free(part->colour_space);
            part->colour_space = copy;
            break;
        }
    }
    WO_EXR_TRY(stream, exr_get_storage(exr, index, &storage));
    if (storage == EXR_STORAGE_DEEP_SCANLINE || storage == EXR_STORAGE_DEEP_TILED)
        return wo_io_part_add(part, "wideopen:flattenedDeep", WO_IO_INT, 1, NULL, NULL, error);
    return WO_OK;
}

/* Writing. */

/* Reads exactly count numbers of text into values; false when there are more, fewer or others. */
static bool scan_numbers(const char *text, number_type type, size_t count, void *values)
{
    for (size_t i = 0; i < count; i++) {
        char *end = NULL;
        const double value = strtod(text, &end);
        if (end == text)
            return false;
        text = end;
        if (type == NUMBER_INT && value >= INT32_MIN && value <= INT32_MAX)
            ((int32_t *)values)[i] = (int32_t)value;
        else if (type == NUMBER_UINT && value >= 0 && value <= UINT32_MAX)
            ((uint32_t *)values)[i] = (uint32_t)value;
        else if (type == NUMBER_FLOAT)
            ((float *)values)[i] = (float)value;
        else if (type == NUMBER_DOUBLE)
            ((double *)values)[i] = value;
        else
            return false;
    }
    return text[strspn(text, " ")] == '\0';
}

static exr_result_t put_array(exr_context_t exr, int index, const array_kind *kind,
                              const char *name, const void *values)
{
    switch (kind->type) {
    case EXR_ATTR_V2I:
        return exr_attr_set_v2i(exr, index, name, values);
    case EXR_ATTR_V2F:
        return exr_attr_set_v2f(exr, index, name, values);
    case EXR_ATTR_V2D:
        return exr_attr_set_v2d(exr, index, name, values);
    case EXR_ATTR_V3I:
        return exr_attr_set_v3i(exr, index, name, values);
    case EXR_ATTR_V3F:
        return exr_attr_set_v3f(exr, index, name, values);
    case EXR_ATTR_V3D:
        return exr_attr_set_v3d(exr, index, name, values);
    case EXR_ATTR_BOX2I:
        return exr_attr_set_box2i(exr, index, name, values);
    case EXR_ATTR_BOX2F:
        return exr_attr_set_box2f(exr, index, name, values);
    case EXR_ATTR_M33F:
        return exr_attr_set_m33f(exr, index, name, values);
    case EXR_ATTR_M33D:
        return exr_attr_set_m33d(exr, index, name, values);
    case EXR_ATTR_M44F:
        return exr_attr_set_m44f(exr, index, name, values);
    case EXR_ATTR_M44D:
        return exr_attr_set_m44d(exr, index, name, values);
    case EXR_ATTR_CHROMATICITIES:
        return exr_attr_set_chromaticities(exr, index, name, values);
    case EXR_ATTR_RATIONAL:
        return exr_attr_set_rational(exr, index, name, values);
    case EXR_ATTR_TIMECODE:
        return exr_attr_set_timecode(exr, index, name, values);
    case EXR_ATTR_KEYCODE:
        return exr_attr_set_keycode(exr, index, name, values);
    default:
        return EXR_ERR_INVALID_ARGUMENT;
    }
}

static wo_status put_floats(const wo_exr_stream *stream, exr_context_t exr, int index,
                            const wo_io_attribute *attribute, wo_error *error)
{
    size_t count = 0;
    for (const char *at = attribute->text; *at; count++) {
        char *end = NULL;
        (void)strtod(at, &end);
        if (end == at)
            return wo_fail(error, WO_ERR_ARGUMENT, "attribute %s: '%.60s' is no list of numbers",
                           attribute->name, attribute->text);
        at = end + strspn(end, " ");
    }
    float *const values = calloc(count ? count : 1, sizeof *values);
    if (!values)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for attribute %s", attribute->name);
    (void)scan_numbers(attribute->text, NUMBER_FLOAT, count, values);
    const exr_result_t result =
        exr_attr_set_float_vector(exr, index, attribute->name, (int32_t)count, values);
    free(values);
    WO_EXR_TRY(stream, result);
    return WO_OK;
}

static wo_status put_strings(const wo_exr_stream *stream, exr_context_t exr, int index,
                             const wo_io_attribute *attribute, wo_error *error)
{
    size_t count = 1, used = 0;
    for (const char *at = attribute->text; *at; at++)
        count += *at == '\n';
    char *const text = wo_io_copy_text(attribute->text);
    const char **const lines = calloc(count, sizeof *lines);
    exr_result_t result = EXR_ERR_OUT_OF_MEMORY;
    if (text && lines) {
        for (char *at = text; at; used++) {
            char *const end = strchr(at, '\n');
            lines[used] = at;
            if (end)
                *end = '\0';
            at = end ? end + 1 : NULL;
        }
        result = exr_attr_set_string_vector(exr, index, attribute->name, (int32_t)used, lines);
    }
    free(text);
    free((void *)lines);
    WO_EXR_TRY(stream, result);
    return WO_OK;
}

static wo_status put_attribute(const wo_exr_stream *stream, exr_context_t exr, int index,
                               const wo_io_attribute *attribute, wo_error *error)
{
    union {
        int32_t ints[LARGEST_ARRAY];
        float floats[LARGEST_ARRAY];
        double doubles[LARGEST_ARRAY];
    } values = {.doubles = {0}};
    const char *const name = attribute->name, *const kind = attribute->kind;
    const double number = attribute->number;

    if (attribute->type == WO_IO_INT && number >= INT32_MIN && number <= INT32_MAX) {
        WO_EXR_TRY(stream, exr_attr_set_int(exr, index, name, (int32_t)number));
        return WO_OK;
    }
    if (attribute->type != WO_IO_TEXT) {
        const bool fits = isnan(number) || isinf(number) || fabs(number) <= 3.4e38;
        if (fits && strcmp(kind, "double"))
            WO_EXR_TRY(stream, exr_attr_set_float(exr, index, name, (float)number));
        else
            WO_EXR_TRY(stream, exr_attr_set_double(exr, index, name, number));
        return WO_OK;
    }
    if (!strcmp(kind, "floatvector"))
        return put_floats(stream, exr, index, attribute, error);
    if (!strcmp(kind, "stringvector"))
        return put_strings(stream, exr, index, attribute, error);
    for (size_t i = 0; i < WO_COUNT(array_kinds); i++) {
        const array_kind *const array = &array_kinds[i];
        if (strcmp(kind, array->kind))
            continue;
        if (!scan_numbers(attribute->text, array->number, (size_t)array->count, &values))
            return wo_fail(error, WO_ERR_ARGUMENT, "attribute %s: '%.60s' are not %d numbers", name,
                           attribute->text, array->count);
        WO_EXR_TRY(stream, put_array(exr, index, array, name, &values));
        return WO_OK;
    }
    WO_EXR_TRY(stream, exr_attr_set_string(exr, index, name, attribute->text));
    return WO_OK;
}

wo_status wo_exr_write_attributes(const wo_exr_stream *stream, exr_context_t exr, int index,
                                  const wo_io_part *part, wo_error *error)
{
    for (size_t i = 0; i < part->attribute_count; i++) {
        const wo_io_attribute *const attribute = &part->attributes[i];
        if (is_structural(attribute->name) || !strcmp(attribute->name, "compression") ||
            !strncmp(attribute->name, "oiio:", 5) || kind_conflicts(attribute))
            continue;
        WO_TRY(put_attribute(stream, exr, index, attribute, error));
    }
    return WO_OK;
}
