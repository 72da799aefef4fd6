/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "depth_channel.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

bool wo_is_depth_clip(const char *clip)
{
    const size_t length = strlen(clip);
    return strncmp(clip, "Depth", 5) == 0 ||
           (length > 5 && strcmp(clip + length - 5, "Depth") == 0);
}

bool wo_is_coloured(const wo_image *image)
{
    if (image->components < 3)
        return false;
    for (int32_t y = image->bounds.y1; y < image->bounds.y2; y++)
        for (int32_t x = image->bounds.x1; x < image->bounds.x2; x++) {
            const float *p = wo_image_at(image, x, y);
            if (memcmp(p, p + 1, sizeof *p) != 0 || memcmp(p, p + 2, sizeof *p) != 0)
                return true;
        }
    return false;
}

/* A channel's name is LAYER.WORD; length of the layer. */
static size_t layer_of(const char *channel)
{
    const char *const dot = strrchr(channel, '.');
    return dot ? (size_t)(dot - channel) : 0;
}

static const char *word_of(const char *channel)
{
    const char *const dot = strrchr(channel, '.');
    return dot ? dot + 1 : channel;
}

static bool is_word(const char *text, size_t length, const char *const *words)
{
    for (; *words; words++)
        if (strlen(*words) == length && strncasecmp(text, *words, length) == 0)
            return true;
    return false;
}

/* Is layer.WORD among the channels of the part, for one of the words? */
static bool has(const wo_io_part *part, const char *layer, size_t length, const char *const *words)
{
    for (int i = 0; i < part->channels; i++) {
        const char *const name = part->channel_names[i];
        if (layer_of(name) == length && strncasecmp(name, layer, length) == 0 &&
            is_word(word_of(name), strlen(word_of(name)), words))
            return true;
    }
    return false;
}

static const char *const x_words[] = {"X", NULL}, *const y_words[] = {"Y", NULL},
                         *const z_words[] = {"Z", NULL}, *const red_words[] = {"R", "red", NULL},
                         *const green_words[] = {"G", "green", NULL},
                         *const depth_words[] = {"depth", "zdepth", NULL},
                         *const layer_words[] = {"depth", "zdepth", "Z", NULL};

static bool is_colour(const wo_io_part *part, const char *layer, size_t length)
{
    return has(part, layer, length, red_words) && has(part, layer, length, green_words);
}

/* How much a channel looks like depth; 0 = not at all. */
static int likeness(const wo_io_part *part, const char *channel)
{
    const size_t length = layer_of(channel);
    const char *const word = word_of(channel);
    size_t start = length; /* of the last word of the layer */
    while (start > 0 && channel[start - 1] != '.')
        start--;
    const bool in_depth = is_word(channel + start, length - start, layer_words);
    if (is_word(word, strlen(word), z_words))
        return has(part, channel, length, x_words) && has(part, channel, length, y_words) ? 0
               : length == 0                                                              ? 6
               : in_depth                                                                 ? 5
                                                                                          : 3;
    if (is_word(word, strlen(word), depth_words))
        return length == 0 ? 4 : 3;
    return !in_depth                                ? 0
           : is_word(word, strlen(word), red_words) ? 2
           : has(part, channel, length, red_words)  ? 0
                                                    : 1;
}

typedef struct place {
    size_t part;
    int channel;
    int likeness;
} place;

/* Is it the layer, or one that goes on after it, as layer1_depth and layer1.depth do after layer1?
 */
static bool belongs(const char *name, size_t length, const char *layer)
{
    const size_t begin = strlen(layer);
    return length >= begin && strncasecmp(name, layer, begin) == 0 &&
           (length == begin || name[begin] == '_' || name[begin] == '.');
}

/* The best channel of a part, of all of them or of those that belong to a layer. */
static void look(const wo_io_file *file, size_t index, const char *layer, place *best)
{
    const wo_io_part *const part = &file->parts[index];
    for (int i = 0; i < part->channels; i++) {
        const char *const name = part->channel_names[i];
        if (layer && !belongs(name, layer_of(name), layer))
            continue;
        const int like = likeness(part, name);
        if (like > best->likeness)
            *best = (place){index, i, like};
    }
}

/* Words for a channel: its name, and its part's where another part has that name, too. */
static bool name_it(const wo_io_file *file, const place *at, char *channel, size_t size)
{
    const wo_io_part *const part = &file->parts[at->part];
    const char *const name = part->channel_names[at->channel];
    bool alone = true;
    for (size_t p = 0; p < at->part; p++)
        for (int i = 0; i < file->parts[p].channels; i++)
            alone = alone && strcasecmp(file->parts[p].channel_names[i], name) != 0;
    const int length = alone ? snprintf(channel, size, "%s", name)
                       : part->name && part->name[0]
                           ? snprintf(channel, size, "%s:%s", part->name, name)
                           : snprintf(channel, size, "%zu:%s", at->part, name);
    return length > 0 && (size_t)length < size && !strpbrk(name, ",:");
}

/* Does a part show colour when nothing is said? */
static bool shows_colour(const wo_io_part *part)
{
    for (int i = 0; i < part->channels; i++)
        if (is_colour(part, part->channel_names[i], layer_of(part->channel_names[i])))
            return true;
    return false;
}

/* The depth of a layer or a part that shows colour. */
static void look_beside(const wo_io_file *file, const char *words, place *best)
{
    bool colour = false;
    for (size_t p = 0; p < file->part_count && !best->likeness; p++) {
        const wo_io_part *const part = &file->parts[p];
        if (is_colour(part, words, strlen(words))) {
            look(file, p, words, best);
        } else if (part->name && strcasecmp(part->name, words) == 0 && shows_colour(part)) {
            colour = true;
            look(file, p, NULL, best);
        }
    }
    for (size_t p = 0; colour && p < file->part_count && !best->likeness; p++) {
        const char *const name = file->parts[p].name;
        if (name && belongs(name, strlen(name), words))
            look(file, p, NULL, best);
    }
}

bool wo_depth_channel(const wo_io_file *file, const char *words, char *channel, size_t size)
{
    place best = {0};
    if (*words)
        look_beside(file, words, &best);
    else if (shows_colour(&file->parts[0]))
        for (size_t p = 0; p < file->part_count; p++)
            look(file, p, NULL, &best);
    return best.likeness > 0 && name_it(file, &best, channel, size);
}

bool wo_colour_of_depth(const char *clip, char *colour, size_t size)
{
    const size_t length = strlen(clip);
    if (!wo_is_depth_clip(clip))
        return false;
    const int written = strcmp(clip, "Depth") == 0 ? snprintf(colour, size, "Source")
                        : strncmp(clip, "Depth", 5) == 0
                            ? snprintf(colour, size, "Layer%s", clip + 5)
                            : snprintf(colour, size, "%.*s", (int)(length - 5), clip);
    return written > 0 && (size_t)written < size;
}
