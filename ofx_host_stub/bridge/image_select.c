/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "image_io_private.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

size_t wo_io_layer_length(const char *channel)
{
    const char *const dot = strrchr(channel, '.');
    return dot ? (size_t)(dot - channel) : 0;
}

static const char *last_word(const char *channel)
{
    const char *const dot = strrchr(channel, '.');
    return dot ? dot + 1 : channel;
}

static bool is_one_of(const char *word, const char *a, const char *b)
{
    return !strcasecmp(word, a) || !strcasecmp(word, b);
}

int wo_io_component(const char *channel)
{
    const char *const word = last_word(channel);
    if (is_one_of(word, "R", "red"))
        return 0;
    if (is_one_of(word, "G", "green"))
        return 1;
    if (is_one_of(word, "B", "blue"))
        return 2;
    return is_one_of(word, "A", "alpha") ? 3 : 4;
}

/* Selection. */

typedef int (*comparison)(const char *, const char *);

static int find_channel(const wo_io_part *part, const char *name, size_t length, bool any_case)
{
    for (int i = 0; i < part->channels; i++) {
        const char *const have = part->channel_names[i];
        if (strlen(have) == length &&
            !(any_case ? strncasecmp(have, name, length) : strncmp(have, name, length)))
            return i;
    }
    return -1;
}

/* Number of words separated by commas; 0 when one of them is empty. */
static int count_words(const char *list)
{
    int count = 0;
    for (const char *at = list;; at++) {
        const size_t length = strcspn(at, ",");
        if (length == 0)
            return 0;
        count++;
        at += length;
        if (!*at)
            return count;
    }
}

/* The channels of a list from its word number count on; false when they cannot be found. A name may
   hold commas itself: the longest that is one wins, unless nothing fits behind it. */
static bool pick_from(const wo_io_part *part, const char *list, bool any_case, wo_io_choice *found)
{
    if (found->count == WO_IO_MOST_CHOSEN)
        return false;
    for (size_t length = strlen(list);; length--) {
        const bool last = list[length] == '\0';
        if (!last && list[length] != ',' && length > 0)
            continue;
        const int index = length > 0 ? find_channel(part, list, length, any_case) : -1;
        if (index >= 0) {
            found->channels[found->count++] = index;
            if (last || pick_from(part, list + length + 1, any_case, found))
                return true;
            found->count--;
        }
        if (length == 0)
            return false;
    }
}

static wo_io_choice pick_channels(const wo_io_part *part, const char *list, bool any_case)
{
    wo_io_choice found = {.part = part};
    if (!pick_from(part, list, any_case, &found))
        found.count = 0;
    return found;
}

/* Does the channel belong to the layer, given in full or by its last words? */
static bool in_layer(const char *channel, const char *layer, bool any_case)
{
    const size_t have = wo_io_layer_length(channel), want = strlen(layer);
    if (have < want || (want == 0 && have > 0) || (have > want && channel[have - want - 1] != '.'))
        return false;
    const char *const tail = channel + (have - want);
    return !(any_case ? strncasecmp(tail, layer, want) : strncmp(tail, layer, want));
}

/* Channel of the layer whose last word is word, -1 when there is none. */
static int in_layer_called(const wo_io_part *part, const char *layer, bool any_case,
                           const char *word)
{
    for (int i = 0; i < part->channels; i++) {
        const char *const channel = part->channel_names[i];
        if (in_layer(channel, layer, any_case) && is_one_of(last_word(channel), word, word))
            return i;
    }
    return -1;
}

/* What a layer shows by itself: RGBA, RGB, XYZ, Y with A as RGBA, Y, Z, or its only channel. */
static wo_io_choice pick_layer(const wo_io_part *part, const char *layer, bool any_case)
{
    wo_io_choice found = {.part = part};
    int component[WO_IO_MOST_CHOSEN] = {-1, -1, -1, -1}, members = 0, only = -1;
    for (int i = part->channels - 1; i >= 0; i--) {
        const char *const channel = part->channel_names[i];
        if (!in_layer(channel, layer, any_case))
            continue;
        members++;
        only = i;
        const int kind = wo_io_component(channel);
        if (kind < 4)
            component[kind] = i;
    }
    const int x = in_layer_called(part, layer, any_case, "X");
    const int y = in_layer_called(part, layer, any_case, "Y");
    const int z = in_layer_called(part, layer, any_case, "Z");
    if (component[0] >= 0 && component[1] >= 0 && component[2] >= 0) {
        memcpy(found.channels, component, sizeof component);
        found.count = component[3] >= 0 ? 4 : 3;
    } else if (x >= 0 && y >= 0 && z >= 0) {
        found.channels[0] = x;
        found.channels[1] = y;
        found.channels[2] = z;
        found.count = 3;
    } else if (y >= 0 && component[3] >= 0) {
        for (int i = 0; i < 3; i++)
            found.channels[i] = y;
        found.channels[3] = component[3];
        found.count = 4;
    } else if (y >= 0 || z >= 0 || members == 1) {
        found.channels[0] = y >= 0 ? y : z >= 0 ? z : only;
        found.count = 1;
    }
    return found;
}

/* What a part shows by itself; a part of layers only shows the first with colour, else the first.
 */
static wo_io_choice pick_default(const wo_io_part *part)
{
    wo_io_choice found = pick_layer(part, "", false);
    for (int i = 0; i < part->channels && found.count < 3; i++) {
        char layer[256];
        const char *const channel = part->channel_names[i];
        const size_t length = wo_io_layer_length(channel);
        if (found.count > 0 && !wo_io_layer_length(part->channel_names[found.channels[0]]))
            break;
        if (length == 0 || length >= sizeof layer)
            continue;
        memcpy(layer, channel, length);
        layer[length] = '\0';
        const wo_io_choice other = pick_layer(part, layer, false);
        if (other.count > 2 || found.count == 0)
            found = other;
    }
    return found;
}

/* Channels or a layer of one part. */
static wo_io_choice pick_in_part(const wo_io_part *part, const char *words)
{
    wo_io_choice found = {.part = part};
    if (!*words)
        return pick_default(part);
    for (int any_case = 0; any_case < 2 && !found.count; any_case++) {
        found = pick_channels(part, words, any_case);
        if (!found.count)
            found = pick_layer(part, words, any_case);
    }
    if (!found.count && !strcasecmp(words, "rgba"))
        found = pick_channels(part, "R,G,B,A", true);
    if (!found.count && !strcasecmp(words, "rgb"))
        found = pick_channels(part, "R,G,B", true);
    return found;
}

static const char *name_of(const wo_io_part *part)
{
    return part->name ? part->name : "";
}

/* The part of this name, or of this number when it has none. */
static const wo_io_part *find_part(const wo_io_file *file, const char *name, size_t length)
{
    for (int any_case = 0; any_case < 2; any_case++)
        for (size_t i = 0; i < file->part_count; i++) {
            const char *const have = name_of(&file->parts[i]);
            if (strlen(have) == length &&
                !(any_case ? strncasecmp(have, name, length) : strncmp(have, name, length)))
                return &file->parts[i];
        }
    if (length < 1 || length > 6 || strspn(name, "0123456789") < length)
        return NULL;
    const size_t number = (size_t)strtoul(name, NULL, 10);
    return number < file->part_count && !*name_of(&file->parts[number]) ? &file->parts[number]
                                                                        : NULL;
}

static wo_io_choice pick(const wo_io_file *file, const char *words)
{
    wo_io_choice found = {0};
    for (int layers = 0; layers < 2; layers++)
        for (int any_case = 0; any_case < 2; any_case++)
            for (size_t i = 0; i < file->part_count; i++) {
                const wo_io_part *const part = &file->parts[i];
                found = layers ? pick_layer(part, words, any_case)
                               : pick_channels(part, words, any_case);
                if (found.count)
                    return found;
            }
    const wo_io_part *const named = find_part(file, words, strlen(words));
    if (named)
        return pick_default(named);
    for (const char *colon = strchr(words, ':'); colon; colon = strchr(colon + 1, ':')) {
        const wo_io_part *const part = find_part(file, words, (size_t)(colon - words));
        if (part)
            return pick_in_part(part, colon + 1);
    }
    for (size_t i = 0; i < file->part_count && !found.count; i++)
        found = pick_in_part(&file->parts[i], words);
    return found;
}

/* What the file has: "beauty: R G B A; depth: Z". */
static void list_contents(const wo_io_file *file, char *buffer, size_t size)
{
    size_t used = 0;
    buffer[0] = '\0';
    for (size_t i = 0; i < file->part_count; i++) {
        const wo_io_part *const part = &file->parts[i];
        for (int c = -1; c < part->channels; c++) {
            int length;
            if (c < 0 && *name_of(part))
                length =
                    snprintf(buffer + used, size - used, "%s%s:", i ? "; " : "", name_of(part));
            else if (c < 0)
                length = snprintf(buffer + used, size - used, "%s", i ? ";" : "");
            else
                length = snprintf(buffer + used, size - used, "%s%s", used ? " " : "",
                                  part->channel_names[c]);
            if (length < 0 || (size_t)length >= size - used) {
                snprintf(buffer + size - 5, 5, " ...");
                return;
            }
            used += (size_t)length;
        }
    }
}

wo_status wo_io_copy_choice(const wo_io_choice *found, wo_image *image, wo_error *error)
{
    const wo_io_part *const part = found->part;
    const size_t pixels =
        (size_t)wo_rect_width(part->data_window) * (size_t)wo_rect_height(part->data_window);
    const size_t count = (size_t)found->count, stride = (size_t)part->channels;
    float *const data = malloc(pixels * count * sizeof *data);
    if (!data)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for %d x %d pixels",
                       (int)wo_rect_width(part->data_window),
                       (int)wo_rect_height(part->data_window));
    for (size_t c = 0; c < count; c++) {
        const float *const from = part->pixels + found->channels[c];
        for (size_t i = 0; i < pixels; i++)
            data[i * count + c] = from[i * stride];
    }
    *image = (wo_image){
        .data = data,
        .bounds = part->data_window,
        .row_bytes = (ptrdiff_t)((size_t)wo_rect_width(part->data_window) * count * sizeof *data),
        .components = found->count};
    return WO_OK;
}

wo_status wo_io_choose(const wo_io_file *file, const char *channels, wo_io_choice *chosen,
                       wo_error *error)
{
    char contents[160];
    const char *const words = channels ? channels : "";
    *chosen = (wo_io_choice){.part = 0};
    const wo_io_choice found = *words ? pick(file, words) : pick_default(&file->parts[0]);
    list_contents(file, contents, sizeof contents);
    if (!found.count && !*words)
        return wo_fail(error, WO_ERR_NOT_FOUND, "no colour or depth to choose by itself among %s",
                       contents);
    if (!found.count && count_words(words) > WO_IO_MOST_CHOSEN)
        return wo_fail(error, WO_ERR_UNSUPPORTED, "'%.40s': choose 1, 3 or 4 channels of %s", words,
                       contents);
    if (!found.count)
        return wo_fail(error, WO_ERR_NOT_FOUND, "no channel, layer or part '%.40s' among %s", words,
                       contents);
    if (found.count == 2)
        return wo_fail(error, WO_ERR_UNSUPPORTED, "'%.40s' is 2 channels; choose 1, 3 or 4 of %s",
                       words, contents);
    *chosen = found;
    return WO_OK;
}

wo_status wo_io_select(const wo_io_file *file, const char *channels, wo_image *image,
                       const wo_io_part **part, wo_error *error)
{
    wo_io_choice found;
    *image = (wo_image){0};
    if (part)
        *part = NULL;
    WO_TRY(wo_io_choose(file, channels, &found, error));
    if (found.part->fault)
        return wo_fail(error, WO_ERR_FORMAT, "%s", found.part->fault);
    if (!found.part->pixels)
        return wo_fail(error, WO_ERR_ARGUMENT, "only the header of the file was read");
    WO_TRY(wo_io_copy_choice(&found, image, error));
    if (part)
        *part = found.part;
    return WO_OK;
}

/* Alpha. */

static void scale_colour(wo_image *image, bool divide)
{
    if (!image || !image->data || image->components != 4)
        return;
    for (int32_t y = image->bounds.y1; y < image->bounds.y2; y++) {
        float *at = wo_image_at(image, image->bounds.x1, y);
        for (int32_t x = image->bounds.x1; x < image->bounds.x2; x++, at += 4) {
            const float factor = !divide ? at[3] : at[3] > 0 ? 1 / at[3] : 1;
            for (int c = 0; c < 3; c++)
                at[c] *= factor;
        }
    }
}

void wo_io_premultiply(wo_image *image)
{
    scale_colour(image, false);
}

void wo_io_unpremultiply(wo_image *image)
{
    scale_colour(image, true);
}

/* Sequences. */

/* Length of the mark at text and the digits it wants; 0 when there is none. */
static size_t mark_at(const char *text, int *digits)
{
    const size_t hashes = strspn(text, "#");
    *digits = 0;
    if (hashes >= 2) {
        *digits = hashes < 10 ? (int)hashes : 9;
        return hashes;
    }
    if (text[0] != '%')
        return 0;
    size_t length = 1;
    const bool zero = text[length] == '0';
    if (zero)
        length++;
    if (text[length] >= '1' && text[length] <= '9') {
        *digits = zero ? text[length] - '0' : 0;
        length++;
    }
    return text[length] == 'd' ? length + 1 : 0;
}

/* Length of what is there under just this name, the file or leading folders: a mark in it is none.
 */
static size_t literal_length(const char *pattern)
{
    char path[PATH_MAX];
    struct stat about;
    for (size_t length = strlen(pattern); length > 0; length--) {
        if (length >= sizeof path || (pattern[length] && pattern[length - 1] != '/'))
            continue;
        memcpy(path, pattern, length);
        path[length] = '\0';
        if (!stat(path, &about) && S_ISDIR(about.st_mode) == (pattern[length - 1] == '/'))
            return length;
    }
    return 0;
}

bool wo_io_is_sequence(const char *pattern)
{
    int digits;
    if (!pattern)
        return false;
    for (const char *at = pattern + literal_length(pattern); *at; at++)
        if (mark_at(at, &digits))
            return true;
    return false;
}

wo_status wo_io_frame_path(const char *pattern, int frame, char *buffer, size_t size,
                           wo_error *error)
{
    size_t used = 0;
    const char *const marks = pattern + literal_length(pattern);
    if (size > 0)
        buffer[0] = '\0';
    for (const char *at = pattern; *at;) {
        char text[16];
        int digits = 0;
        const size_t mark = at >= marks ? mark_at(at, &digits) : 0;
        if (mark)
            snprintf(text, sizeof text, "%0*d", digits, frame);
        else
            snprintf(text, sizeof text, "%c", *at);
        const size_t length = strlen(text);
        if (used + length + 1 > size)
            return wo_fail(error, WO_ERR_RANGE, "the path of frame %d of %s is longer than %zu",
                           frame, wo_io_shown(pattern), size);
        memcpy(buffer + used, text, length + 1);
        used += length;
        at += mark ? mark : 1;
    }
    return WO_OK;
}
