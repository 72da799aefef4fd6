/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "picture_file.h"
#include "render_input_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---------------------------------------------------------------------------------- the metadata
 */

enum { NUMBER_SIZE = 40 };

/* The shortest number that is the same in the file: a float of 1.4 is 1.39999998 as a double. */
static const char *attribute_text(const wo_io_attribute *attribute, char number[NUMBER_SIZE])
{
    const double value = attribute->number;
    const bool single = !strcmp(attribute->kind, "");
    if (attribute->type == WO_IO_TEXT)
        return attribute->text;
    if (attribute->type == WO_IO_INT) {
        snprintf(number, NUMBER_SIZE, "%.0f", value);
        return number;
    }
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(number, NUMBER_SIZE, "%.*g", digits, value);
        const double back = strtod(number, NULL);
        if (back == value || (single && (float)back == (float)value))
            break;
    }
    return number;
}

static void give_metadata(const wo_input *input, const wo_input_picture *p,
                          wo_host_add_metadata *add, void *to)
{
    const wo_io_part *const part = &p->file->parts[p->part];
    char number[NUMBER_SIZE];
    if (!input->inputs->own)
        return;
    for (size_t i = 0; i < part->attribute_count; i++)
        add(to, part->attributes[i].name, attribute_text(&part->attributes[i], number));
    add(to, "wideopen:own", input->inputs->own);
}

void wo_inputs_pass_metadata(wo_inputs *inputs, const char *own)
{
    inputs->own = own;
}

void wo_input_metadata(const wo_input *input, wo_host_add_metadata *add, void *to)
{
    give_metadata(input, input->present, add, to);
}

/* ------------------------------------------------------------------------------ the host's side */

double wo_input_aspect(const wo_input *input, const wo_input_picture *p)
{
    const wo_inputs *const inputs = input->inputs;
    return inputs->main && input != inputs->main ? inputs->pixels.aspect
                                                 : wo_part_aspect(&p->file->parts[p->part]);
}

static int frame_at(double time)
{
    return (int)lround(fmin(fmax(time, -1e8), 1e8));
}

static bool is_missing(const wo_input *input, int frame)
{
    return input->inputs->missing != WO_MISSING_HOLD && input->sequence &&
           !wo_picture_exists(input->pattern, frame);
}

/* Within the sequence: its first frame, its last, or between them. */
static bool is_gap(const wo_input *input, int frame)
{
    return frame >= input->first && frame <= input->last;
}

/* The linear picture of a frame; the lock is held. Beyond the ends of a sequence there is none,
   WO_ERR_NOT_FOUND; one that is missing between them is a failure. */
static wo_status picture_at(wo_input *input, int frame, wo_input_picture **p, wo_error *error)
{
    if (is_missing(input, frame))
        return wo_fail(error, is_gap(input, frame) ? WO_ERR_IO : WO_ERR_NOT_FOUND,
                       "%s has no frame %d; its frames are %d to %d", input->pattern, frame,
                       input->first, input->last);
    if (input->inputs->missing == WO_MISSING_HOLD)
        frame = wo_input_stand_in(input, frame);
    WO_TRY(wo_input_fetch(input, frame, p, error));
    return wo_input_make_linear(input, *p, error);
}

static wo_status host_region(void *user, double time, wo_host_region *region, wo_error *error)
{
    wo_input *const input = user;
    int frame = frame_at(time);
    wo_input_picture *p;
    pthread_mutex_lock(&input->inputs->lock);
    /* Where the missing one would be is no failure yet: it may not be wanted. */
    if (is_missing(input, frame) && is_gap(input, frame))
        frame = wo_input_stand_in(input, frame);
    const wo_status status = picture_at(input, frame, &p, error);
    input->missed |= status == WO_ERR_NOT_FOUND;
    if (status == WO_OK) {
        const wo_rect b = p->image.bounds;
        const double aspect = wo_input_aspect(input, p);
        *region = (wo_host_region){b.x1 * aspect, b.y1, b.x2 * aspect, b.y2};
    }
    pthread_mutex_unlock(&input->inputs->lock);
    return status;
}

static wo_status host_pixels(void *user, const wo_host_request *request, const wo_image *image,
                             wo_error *error)
{
    wo_input *const input = user;
    wo_input_picture *p;
    pthread_mutex_lock(&input->inputs->lock);
    wo_status status = picture_at(input, frame_at(request->time), &p, error);
    if (status == WO_OK) {
        input->given = true;
        wo_host_still still = {.image = p->image,
                               .pixel_aspect = wo_input_aspect(input, p),
                               .nearest = wo_input_is_numbers(input, p)};
        status = wo_host_still_pixels(&still, request, image, error);
    }
    pthread_mutex_unlock(&input->inputs->lock);
    return status;
}

static wo_status host_metadata(void *user, double time, wo_host_add_metadata *add, void *to,
                               wo_error *error)
{
    wo_input *const input = user;
    wo_input_picture *p;
    pthread_mutex_lock(&input->inputs->lock);
    const int frame = frame_at(time);
    const wo_status status = is_missing(input, frame)
                                 ? wo_fail(error, WO_ERR_NOT_FOUND, "no frame %d", frame)
                                 : picture_at(input, frame, &p, error);
    if (status == WO_OK)
        give_metadata(input, p, add, to);
    pthread_mutex_unlock(&input->inputs->lock);
    return status;
}

bool wo_input_frames(const wo_input *input, int *first, int *last)
{
    *first = input->first;
    *last = input->last;
    return input->sequence;
}

wo_status wo_inputs_check_given(const wo_inputs *inputs, int frame, wo_error *error)
{
    for (size_t i = 0; i < inputs->count; i++) {
        const wo_input *const input = inputs->clips[i];
        if (input->missed && !input->given && is_missing(input, frame))
            return wo_fail(error, WO_ERR_IO,
                           "clip %s: %s has no frame %d, its frames are %d to %d, and the plugin "
                           "has taken none of these",
                           input->clip->name, input->pattern, frame, input->first, input->last);
    }
    return WO_OK;
}

static double rate_of(const wo_input_picture *p, double otherwise)
{
    const wo_io_part *const part = &p->file->parts[p->part];
    const wo_io_attribute *rate = wo_io_part_find(part, "framesPerSecond");
    if (!rate)
        rate = wo_io_part_find(part, "FramesPerSecond");
    double value = rate ? rate->number : 0;
    if (rate && rate->type == WO_IO_TEXT) {
        double numbers[2] = {0, 1}; /* a fraction */
        char *end;
        numbers[0] = strtod(rate->text, &end);
        if (*end)
            numbers[1] = strtod(end + 1, NULL);
        value = numbers[0] / numbers[1];
    }
    return value >= 0.1 && value <= 1000 ? value : otherwise; /* NaN fails */
}

double wo_input_rate(const wo_input *input, double otherwise)
{
    return rate_of(input->present, otherwise);
}

wo_host_source wo_input_source(wo_input *input, const wo_host_project *project)
{
    wo_host_source source = WO_HOST_SOURCE_INIT;
    source.user = input;
    source.components = input->present->image.components;
    if (!wo_input_is_raw(input) && source.components == 1)
        source.components = 3; /* what make_linear gives */
    input->components = source.components;
    source.alpha = source.components == 4 ? WO_HOST_PREMULTIPLIED : WO_HOST_OPAQUE;
    source.pixel_aspect = wo_input_aspect(input, input->present);
    source.frame_rate = rate_of(input->present, project->frame_rate);
    source.first_frame = input->sequence ? input->first : project->first_frame;
    source.last_frame = input->sequence ? input->last : project->last_frame;
    if (!input->clip->mask)
        source.colourspace = wo_input_is_raw(input) ? WO_OFX_SPACE_RAW : WO_OFX_SPACE_WORKING;
    source.region = host_region;
    source.pixels = host_pixels;
    source.metadata = host_metadata;
    return source;
}
