/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "colour_label.h"

#include "image_io_private.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define ID             "colorInteropID"
#define CHROMATICITIES "chromaticities"

/* Names of colour spaces, the most reliable first. */
static const char *const name_labels[] = {ID, "oiio:ColorSpace", "colorspace", "colorSpace"};

bool wo_label_is_one(const char *attribute)
{
    static const char *const others[] = {CHROMATICITIES, "acesImageContainerFlag",
                                         "Exif:ColorSpace", "dpx:Transfer", "dpx:Colorimetric"};
    for (size_t i = 0; i < WO_COUNT(name_labels); i++)
        if (!strcmp(attribute, name_labels[i]))
            return true;
    for (size_t i = 0; i < WO_COUNT(others); i++)
        if (!strcmp(attribute, others[i]))
            return true;
    return !strncmp(attribute, "ICCProfile", 10);
}

static bool read_primaries(const wo_io_part *part, float primaries[8])
{
    const wo_io_attribute *const said = wo_io_part_find(part, CHROMATICITIES);
    if (!said || said->type != WO_IO_TEXT)
        return false;
    const char *at = said->text;
    for (int i = 0; i < 8; i++) {
        char *end;
        primaries[i] = strtof(at, &end);
        if (end == at)
            return false;
        at = end;
    }
    return true;
}

static wo_colour_words words_of(const wo_io_part *part)
{
    wo_colour_words says = {.has_primaries = read_primaries(part, says.primaries)};
    size_t count = 0;
    for (size_t i = 0; i < WO_COUNT(name_labels); i++) {
        const wo_io_attribute *const said = wo_io_part_find(part, name_labels[i]);
        if (said && said->type == WO_IO_TEXT && said->text[0])
            says.words[count++] = said->text;
    }
    if (part->colour_space && part->colour_space[0])
        says.words[count] = part->colour_space;
    return says;
}

wo_status wo_label_space(const wo_colour *colour, const char *path, const wo_io_part *part,
                         char *space, size_t size, wo_colour_ground *ground, wo_error *error)
{
    if (!part)
        return wo_colour_of_file(colour, path, NULL, space, size, ground, error);
    const locale_t before = wo_io_plain_locale();
    const wo_colour_words says = words_of(part);
    wo_io_restore_locale(before);
    return wo_colour_of_file(colour, path, &says, space, size, ground, error);
}

const char *wo_label_unknown(const wo_colour *colour, const char *path, const wo_io_part *part)
{
    const wo_colour_words says = words_of(part);
    char name[256];
    const char *first = NULL;
    for (size_t i = 0; i < WO_COUNT(says.words) && says.words[i]; i++) {
        if (wo_colour_find(colour, says.words[i], name, sizeof name))
            return NULL;
        if (!first && strcasecmp(says.words[i], "unknown") != 0 &&
            strcasecmp(says.words[i], wo_io_usual_space(path)) != 0)
            first = says.words[i];
    }
    return first;
}

static wo_status set_colour_space(wo_io_part *part, const char *words, wo_error *error)
{
    char *const copy = wo_io_copy_text(words);
    if (!copy)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for a colour space");
    free(part->colour_space);
    part->colour_space = copy;
    return WO_OK;
}

static wo_status set_primaries(wo_io_part *part, const float p[8], wo_error *error)
{
    char text[160];
    float said[8];
    if (read_primaries(part, said) && wo_colour_same_primaries(said, p))
        return WO_OK;
    const locale_t before = wo_io_plain_locale();
    snprintf(text, sizeof text, "%.6g %.6g %.6g %.6g %.6g %.6g %.6g %.6g", (double)p[0],
             (double)p[1], (double)p[2], (double)p[3], (double)p[4], (double)p[5], (double)p[6],
             (double)p[7]);
    wo_io_restore_locale(before);
    return wo_io_part_add(part, CHROMATICITIES, WO_IO_TEXT, 0, text, CHROMATICITIES, error);
}

static wo_status copy_labels(const wo_io_part *from, wo_io_part *part, wo_error *error)
{
    for (size_t i = 0; i < from->attribute_count; i++)
        if (wo_label_is_one(from->attributes[i].name))
            WO_TRY(wo_io_part_set(part, &from->attributes[i], error));
    return set_colour_space(part, from->colour_space ? from->colour_space : "", error);
}

/* Does the file say something of its colours that is not what its space is known for? */
static bool is_foreign(const wo_colour *colour, const char *path, const wo_io_part *from,
                       const wo_colour_standard *standard)
{
    const wo_colour_words says = words_of(from);
    return wo_label_unknown(colour, path, from) ||
           (says.has_primaries && !wo_colour_standard_by_primaries(says.primaries) &&
            !(standard && wo_colour_same_primaries(says.primaries, standard->primaries)));
}

static bool has_name(const wo_io_part *part)
{
    for (size_t i = 0; i < WO_COUNT(name_labels); i++)
        if (wo_io_part_find(part, name_labels[i]))
            return true;
    return false;
}

wo_status wo_label_part(const wo_colour *colour, const char *space, const char *from_path,
                        const wo_io_part *from, wo_io_part *part, wo_error *error)
{
    const bool numbers = !space || wo_colour_is_data(colour, space);
    const wo_colour_standard *const standard =
        numbers ? wo_colour_standard_named("data") : wo_colour_standard_of(colour, space);
    if (from) {
        WO_TRY(copy_labels(from, part, error));
        if (numbers || is_foreign(colour, from_path, from, standard))
            return WO_OK;
    }
    const bool linear = (standard && standard->linear) ||
                        (space && wo_colour_is_same(colour, space, WO_COLOUR_WORKING));
    if (!from || linear || (standard && *standard->library))
        WO_TRY(set_colour_space(part,
                                linear     ? "Linear"
                                : standard ? standard->library
                                           : "",
                                error));
    if (standard && *standard->id)
        WO_TRY(wo_io_part_set_text(part, ID, standard->id, error));
    else if (space && !has_name(part))
        WO_TRY(wo_io_part_set_text(part, "colorSpace", space, error));
    return standard && standard->primaries[0] > 0 ? set_primaries(part, standard->primaries, error)
                                                  : WO_OK;
}
