/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "render_input_private.h"

#include "bridge/colour_label.h"
#include "depth_channel.h"
#include "picture_file.h"
#include "sequence.h"

#include <limits.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

wo_status wo_inputs_create(wo_colour *colour, const char *in_space, wo_inputs **inputs,
                           wo_error *error)
{
    *inputs = calloc(1, sizeof **inputs);
    if (!*inputs)
        return wo_fail(error, WO_ERR_NOMEM, "out of memory for the clips");
    (*inputs)->colour = colour;
    (*inputs)->in_space = in_space;
    if (pthread_mutex_init(&(*inputs)->lock, NULL) != 0) {
        free(*inputs);
        *inputs = NULL;
        return wo_fail(error, WO_ERR_NOMEM, "the system has no lock left");
    }
    return WO_OK;
}

static void picture_clear(wo_input_picture *p)
{
    free(p->image.data);
    free(p->path);
    free(p->space);
    wo_io_file_destroy(&p->file);
    *p = (wo_input_picture){0};
}

static void files_close(wo_inputs *inputs)
{
    for (size_t i = 0; i < inputs->file_count; i++)
        wo_io_file_destroy(&inputs->files[i].file);
    inputs->file_count = inputs->file_next = 0;
}

static void input_free(wo_input *input)
{
    if (!input)
        return;
    for (size_t i = 0; i < input->picture_count; i++)
        picture_clear(&input->pictures[i]);
    free(input->pattern);
    free(input->channels);
    free(input);
}

void wo_inputs_destroy(wo_inputs **inputs)
{
    if (!*inputs)
        return;
    for (size_t i = 0; i < (*inputs)->count; i++)
        input_free((*inputs)->clips[i]);
    files_close(*inputs);
    pthread_mutex_destroy(&(*inputs)->lock);
    free(*inputs);
    *inputs = NULL;
}

/* -------------------------------------------------------------------------------- reading files */

static wo_status open_cached(wo_inputs *inputs, const char *path, const wo_io_file **file,
                             wo_error *error)
{
    for (size_t i = 0; i < inputs->file_count; i++)
        if (strcmp(inputs->files[i].path, path) == 0) {
            *file = inputs->files[i].file;
            return WO_OK;
        }
    wo_io_file *fresh = NULL;
    WO_TRY(wo_io_read(path, false, &fresh, error));
    wo_open_file *const slot = &inputs->files[inputs->file_next];
    wo_io_file_destroy(&slot->file);
    snprintf(slot->path, sizeof slot->path, "%s", path);
    slot->file = fresh;
    inputs->file_next = (inputs->file_next + 1) % WO_FILES_MAX;
    if (inputs->file_count < WO_FILES_MAX)
        inputs->file_count++;
    *file = fresh;
    return WO_OK;
}

/* Each file says for itself: a sequence may change on its way, and a farm may begin anywhere. */
static wo_status choose_space(const wo_inputs *inputs, const char *path, wo_input_picture *p,
                              wo_error *error)
{
    char space[256];
    if (inputs->in_space)
        snprintf(space, sizeof space, "%s", inputs->in_space);
    else
        WO_TRY(wo_label_space(inputs->colour, path, &p->file->parts[p->part], space, sizeof space,
                              NULL, error));
    p->path = strdup(path);
    p->space = strdup(space);
    return p->path && p->space ? WO_OK : wo_fail(error, WO_ERR_NOMEM, "out of memory for a name");
}

/* Files that are not kept as a whole for other clips: of them only what a clip wants is read. */
static bool is_large(const wo_io_file *file)
{
    uint64_t bytes = 0;
    for (size_t i = 0; i < file->part_count; i++) {
        const wo_io_part *const part = &file->parts[i];
        bytes += (uint64_t)wo_rect_width(part->data_window) *
                 (uint64_t)wo_rect_height(part->data_window) * (uint64_t)part->channels *
                 sizeof(float);
    }
    return bytes > (uint64_t)256 << 20;
}

static wo_status read_picture(wo_input *input, int frame, wo_input_picture *p, wo_error *error)
{
    char path[PATH_MAX];
    const wo_io_file *file;
    const wo_io_part *part = NULL;
    WO_TRY(wo_io_frame_path(input->pattern, frame, path, sizeof path, error));
    if (input->sequence && !wo_picture_exists(input->pattern, frame))
        return wo_sequence_lacks(input->pattern, frame, path, error);
    p->frame = frame;
    WO_TRY(wo_io_read(path, true, &p->file, error));
    if (is_large(p->file)) {
        wo_io_file_destroy(&p->file);
        WO_TRY(wo_io_read_view(path, input->channels, &p->file, &p->image, &p->part, error));
    } else {
        WO_TRY(open_cached(input->inputs, path, &file, error));
        WO_TRY(wo_io_select(file, input->channels, &p->image, &part, error));
        p->part = (size_t)(part - file->parts);
    }
    if (p->part >= p->file->part_count)
        return wo_fail(error, WO_ERR_FORMAT, "%s changed while it was read", path);
    p->own = p->image.components;
    return choose_space(input->inputs, path, p, error);
}

bool wo_input_is_numbers(const wo_input *input, const wo_input_picture *p)
{
    return input->raw || wo_colour_is_data(input->inputs->colour, p->space);
}

static wo_status fit(const wo_input *input, wo_input_picture *p, wo_error *error)
{
    const wo_inputs *const inputs = input->inputs;
    wo_error why = {0};
    if (!inputs->main || input == inputs->main)
        return WO_OK;
    const wo_status status = wo_picture_fit(&inputs->pixels, &p->file->parts[p->part],
                                            input->raw && !input->clip->mask, &p->image, &why);
    return status == WO_OK ? WO_OK
                           : wo_fail(error, status, "clip %s: %.300s: %s", input->clip->name,
                                     input->pattern, why.text);
}

wo_status wo_input_make_linear(wo_input *input, wo_input_picture *p, wo_error *error)
{
    if (p->linear)
        return WO_OK;
    if (!wo_input_is_numbers(input, p))
        WO_TRY(
            wo_picture_linear(input->inputs->colour, p->file, p->part, p->space, &p->image, error));
    /* one frame may be grey, another have alpha: those around the one that is rendered follow it */
    if (input->components)
        WO_TRY(wo_picture_components(&p->image, input->components, error));
    WO_TRY(fit(input, p, error));
    p->linear = true;
    return WO_OK;
}

static wo_input_picture *free_slot(wo_input *input)
{
    const size_t room = input->clip->temporal ? WO_PICTURES_MAX : 2;
    if (input->picture_count < room)
        return &input->pictures[input->picture_count++];
    wo_input_picture *oldest = NULL;
    for (size_t i = 0; i < input->picture_count; i++) {
        wo_input_picture *const p = &input->pictures[i];
        if (p != input->present && (!oldest || p->used < oldest->used))
            oldest = p;
    }
    picture_clear(oldest);
    return oldest;
}

wo_status wo_input_fetch(wo_input *input, int frame, wo_input_picture **found, wo_error *error)
{
    const int wanted = input->sequence ? frame : 0;
    *found = NULL;
    for (size_t i = 0; i < input->picture_count && !*found; i++)
        if (input->pictures[i].file && input->pictures[i].frame == wanted)
            *found = &input->pictures[i];
    if (!*found) {
        wo_input_picture fresh = {0};
        const wo_status status = read_picture(input, wanted, &fresh, error);
        if (status != WO_OK) {
            picture_clear(&fresh);
            return status;
        }
        *found = free_slot(input);
        **found = fresh;
    }
    (*found)->used = ++input->inputs->clock;
    return WO_OK;
}

/* ------------------------------------------------------------------------------------ the clips */

/* Does the part have a vector's channel, "layer.X"? */
static bool has_vector(const wo_io_part *part, const char *layer)
{
    const size_t length = strlen(layer);
    for (int i = 0; i < part->channels; i++) {
        const char *const name = part->channel_names[i];
        if (strncasecmp(name, layer, length) == 0 && strcasecmp(name + length, ".X") == 0)
            return true;
    }
    return false;
}

static bool is_colour(const wo_input *input)
{
    if (*input->channels == '\0')
        return true;
    if (input->present->image.components >= 3)
        return !has_vector(wo_input_header(input), input->channels);
    static const char *const single[] = {"Y", "R", "G", "B"};
    const char *last = input->channels;
    for (const char *letter = last; *letter; letter++)
        if (*letter == '.' || *letter == ':')
            last = letter + 1;
    for (size_t i = 0; i < WO_COUNT(single); i++)
        if (strcasecmp(last, single[i]) == 0)
            return true;
    return false;
}

static bool guess_raw(const wo_input *input)
{
    const bool source = strcmp(input->clip->name, "Source") == 0;
    return input->clip->mask || !is_colour(input) ||
           (!source && input->present->image.components == 1);
}

static void show(wo_input *input, const wo_input_picture *p)
{
    input->present = p;
    input->raw = input->wished || guess_raw(input);
    snprintf(input->space, sizeof input->space, "%s", p->space);
}

int wo_input_stand_in(const wo_input *input, int frame)
{
    wo_sequence there;
    const wo_missing_frames missing = input->inputs->missing;
    if (!input->sequence || (!input->clip->temporal && missing == WO_MISSING_ERROR) ||
        wo_picture_exists(input->pattern, frame) ||
        !wo_sequence_look(input->pattern, frame, &there))
        return frame;
    return missing == WO_MISSING_HOLD ? there.held : there.nearest;
}

/* Of a file of several layers the one that belongs to what the clip is the depth of. */
static bool find_beside_colour(const wo_input *input, const wo_io_file *file, char *channel,
                               size_t size)
{
    char name[128];
    const wo_input *const colour = wo_colour_of_depth(input->clip->name, name, sizeof name)
                                       ? wo_inputs_find(input->inputs, name)
                                       : NULL;
    return !*input->channels && colour && strcmp(colour->pattern, input->pattern) == 0 &&
           *colour->channels && wo_depth_channel(file, colour->channels, channel, size);
}

/* Depth of a file that shows a colour by itself. */
static wo_status find_depth(wo_input *input, int frame, wo_error *error)
{
    char path[PATH_MAX], channel[256];
    wo_io_file *file = NULL;
    if (!wo_is_depth_clip(input->clip->name) ||
        wo_io_frame_path(input->pattern, frame, path, sizeof path, NULL) != WO_OK ||
        wo_io_read(path, true, &file, NULL) != WO_OK)
        return WO_OK; /* reading its pixels will say why */
    input->found = find_beside_colour(input, file, channel, sizeof channel) ||
                   wo_depth_channel(file, input->channels, channel, sizeof channel);
    wo_io_file_destroy(&file);
    if (!input->found)
        return WO_OK;
    free(input->channels);
    input->channels = strdup(channel);
    return input->channels ? WO_OK
                           : wo_fail(error, WO_ERR_NOMEM, "out of memory for channel names");
}

static wo_status fill_input(wo_input *input, const char *spec, int frame, wo_error *error)
{
    wo_input_picture *first;
    wo_sequence there;
    WO_TRY(wo_picture_split(spec, frame, &input->pattern, &input->channels, error));
    input->sequence = wo_io_is_sequence(input->pattern);
    const int shown = wo_input_stand_in(input, frame);
    WO_TRY(find_depth(input, shown, error));
    WO_TRY(wo_input_fetch(input, shown, &first, error));
    input->first = input->last = shown;
    if (input->sequence && wo_sequence_look(input->pattern, shown, &there)) {
        input->first = there.first;
        input->last = there.last;
    }
    show(input, first);
    return WO_OK;
}

wo_status wo_inputs_add(wo_inputs *inputs, const wo_host_clip_info *clip, const char *spec,
                        int frame, wo_error *error)
{
    if (inputs->count >= WO_INPUTS_MAX)
        return wo_fail(error, WO_ERR_RANGE, "more than %d clips", WO_INPUTS_MAX);
    wo_input *const input = calloc(1, sizeof *input);
    if (!input)
        return wo_fail(error, WO_ERR_NOMEM, "out of memory for clip %s", clip->name);
    input->inputs = inputs;
    input->clip = clip;
    const wo_status status = fill_input(input, spec, frame, error);
    if (status != WO_OK)
        input_free(input);
    else
        inputs->clips[inputs->count++] = input;
    return status;
}

wo_input *wo_inputs_find(const wo_inputs *inputs, const char *clip)
{
    for (size_t i = 0; i < inputs->count; i++)
        if (strcmp(inputs->clips[i]->clip->name, clip) == 0)
            return inputs->clips[i];
    return NULL;
}

wo_input *wo_inputs_at(const wo_inputs *inputs, size_t index)
{
    return index < inputs->count ? inputs->clips[index] : NULL;
}

/* Pictures that a clip of one frame at a time will not be asked for again. */
static void drop_others(wo_input *input, int frame)
{
    input->present = NULL;
    if (!input->sequence || input->clip->temporal)
        return;
    for (size_t i = 0; i < input->picture_count; i++)
        if (input->pictures[i].frame != frame)
            picture_clear(&input->pictures[i]);
}

/* Reads anew what was brought into another form than is wanted now. */
static wo_status forget_linear(wo_input *input, wo_error *error)
{
    const int frame = input->present->frame;
    wo_input_picture *p;
    input->present = NULL;
    for (size_t i = 0; i < input->picture_count; i++)
        if (input->pictures[i].linear)
            picture_clear(&input->pictures[i]);
    WO_TRY(wo_input_fetch(input, frame, &p, error));
    show(input, p);
    return WO_OK;
}

/* Where the main clip's picture is of another format than the last, the others come on its pixels
   anew. */
static wo_status follow_main(wo_inputs *inputs, wo_error *error)
{
    if (!inputs->main)
        return WO_OK;
    const wo_io_part *const header = wo_input_header(inputs->main);
    wo_project_pixels *const pixels = &inputs->pixels;
    const double aspect = wo_part_aspect(header);
    if (wo_rect_equal(header->display_window, pixels->window) && aspect == pixels->aspect)
        return WO_OK;
    pixels->window = header->display_window;
    pixels->aspect = aspect;
    for (size_t i = 0; i < inputs->count; i++)
        if (inputs->clips[i] != inputs->main)
            WO_TRY(forget_linear(inputs->clips[i], error));
    return WO_OK;
}

/* The clip has the components of the frame that is rendered. */
static wo_status follow_present(wo_input *input, wo_error *error)
{
    const int own = input->present->own;
    const int components = own == 1 && !wo_input_is_raw(input) ? 3 : own;
    if (!input->components || components == input->components)
        return WO_OK;
    WO_TRY(forget_linear(input, error));
    input->components = components;
    return WO_OK;
}

static wo_status prepare_all(wo_inputs *inputs, int frame, wo_error *error)
{
    for (size_t i = 0; i < inputs->count; i++) {
        wo_input *const input = inputs->clips[i];
        wo_input_picture *p;
        const int shown = wo_input_stand_in(input, frame);
        drop_others(input, shown);
        WO_TRY(wo_input_fetch(input, shown, &p, error));
        input->missed = input->given = false;
        show(input, p);
    }
    WO_TRY(follow_main(inputs, error));
    for (size_t i = 0; i < inputs->count; i++) {
        wo_input *const input = inputs->clips[i];
        wo_input_picture *p;
        WO_TRY(follow_present(input, error));
        WO_TRY(wo_input_fetch(input, input->present->frame, &p, error));
        WO_TRY(wo_input_make_linear(input, p, error));
    }
    return WO_OK;
}

wo_status wo_inputs_prepare(wo_inputs *inputs, int frame, wo_error *error)
{
    pthread_mutex_lock(&inputs->lock);
    const wo_status status = prepare_all(inputs, frame, error);
    files_close(inputs);
    pthread_mutex_unlock(&inputs->lock);
    return status;
}

void wo_inputs_set_missing(wo_inputs *inputs, wo_missing_frames missing)
{
    inputs->missing = missing;
}

void wo_inputs_fit(wo_inputs *inputs, const wo_input *main, const wo_project_pixels *pixels)
{
    inputs->main = main;
    inputs->pixels = *pixels;
}

const wo_input *wo_inputs_missing(const wo_inputs *inputs, int frame)
{
    for (size_t i = 0; i < inputs->count; i++) {
        const wo_input *const input = inputs->clips[i];
        if (input->sequence && !input->clip->temporal && !wo_picture_exists(input->pattern, frame))
            return input;
    }
    return NULL;
}

bool wo_input_is_held(const wo_input *input, int frame, int *held)
{
    *held = input->present->frame;
    return input->sequence && input->inputs->missing == WO_MISSING_HOLD && *held != frame;
}

const char *wo_input_found(const wo_input *input)
{
    return input->found ? input->channels : NULL;
}

bool wo_input_is_coloured_depth(const wo_input *input)
{
    return wo_is_depth_clip(input->clip->name) && wo_is_coloured(&input->present->image);
}

const char *wo_input_clip(const wo_input *input)
{
    return input->clip->name;
}

const char *wo_input_file(const wo_input *input)
{
    return input->pattern;
}

const char *wo_input_space(const wo_input *input)
{
    return input->raw || wo_colour_is_data(input->inputs->colour, input->space) ? "raw"
                                                                                : input->space;
}

wo_origin wo_input_origin(const wo_input *input)
{
    return (wo_origin){.header = wo_input_header(input),
                       .path = input->present->path,
                       .space = wo_input_is_raw(input) ? NULL : input->present->space,
                       .forced = input->inputs->in_space != NULL};
}

bool wo_input_is_raw(const wo_input *input)
{
    return wo_input_is_numbers(input, input->present);
}

void wo_input_set_raw(wo_input *input, bool raw)
{
    input->wished = raw;
    input->raw = raw || guess_raw(input);
}

const wo_io_part *wo_input_header(const wo_input *input)
{
    return &input->present->file->parts[input->present->part];
}
