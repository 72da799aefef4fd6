/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/highlights_image.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* The pixel of a highlight is already as soft as the picture, so large discs need no soft edge. But
   discs up to SOFT px of reach have edges cut by the area of each pixel, so that they grow
   smoothly; from there to twice that it matters less and less, and then the middle of the pixel
   counts. The area is looked at in places of a lattice: no two are in one row or column, which a
   rim could reach at once. */
#define SOFT 2.0
enum { PLACES = 144, STRIDE = 89 };

/* Pictures of COUNTED px of extent or more are counted on some of their pixels only; MOST pixels
   are kept of the others. */
enum { COUNTED = 128, MOST = 1 << 24 };

int32_t wo_highlight_extent(float reach)
{
    return (int32_t)ceilf(reach + 0.5f);
}

double wo_highlight_density(const wo_lens *lens, int32_t dx, int32_t dy, float v, float reach,
                            double line[4])
{
    const double soft = fmin(fmax(2 - (double)reach / SOFT, 0), 1);
    double sum = 0;
    double middle[4];
    const double density = lens->connect(lens->self, dx, dy, v, middle);
    /* Corners and middle alike: the edge is elsewhere. */
    double corners[4] = {0};
    for (int i = 0; i < 4 && soft > 0; i++)
        corners[i] = lens->connect(lens->self, dx + (i & 1) - 0.5, dy + i / 2 - 0.5, v, line);
    const bool even = corners[0] == corners[1] && corners[0] == corners[2] &&
                      corners[0] == corners[3] && corners[0] == density &&
                      (corners[0] > 0 || dx * dx + dy * dy > 2);
    for (int i = 0; i < PLACES && soft > 0 && !even; i++) {
        const double x = dx + (i + 0.5) / PLACES - 0.5;
        const double y = dy + (STRIDE * i % PLACES + 0.5) / PLACES - 0.5;
        double inside[4];
        const double d = lens->connect(lens->self, x, y, v, inside);
        if (d > 0)
            memcpy(line, inside, sizeof inside);
        sum += d;
    }
    sum = soft * (even ? corners[0] : sum / PLACES);
    /* The ray through the middle, if it is there. */
    if (density > 0)
        memcpy(line, middle, sizeof middle);
    return sum + (1 - soft) * density;
}

/* Place of an offset in density: this is where the pixel sees the highlight from the other side. */
static ptrdiff_t place_of(const wo_highlight_image *image, int32_t dx, int32_t dy)
{
    return (image->extent - dy) * (2 * (ptrdiff_t)image->extent + 1) + image->extent - dx;
}

void wo_highlight_image_line(const wo_highlight_image *image, const wo_lens *lens, int32_t dx,
                             int32_t dy, double line[4])
{
    if (image->line)
        memcpy(line, image->line[place_of(image, dx, dy)], sizeof *image->line);
    else
        lens->connect(lens->self, dx, dy, image->v, line);
}

/* A highlight and its place in the list. */
typedef struct key {
    float v, reach;
    size_t at;
} key;

static int compare(const void *pa, const void *pb)
{
    const key *a = pa;
    const key *b = pb;
    return a->v != b->v ? (a->v > b->v) - (a->v < b->v) : (a->at > b->at) - (a->at < b->at);
}

typedef struct image_job {
    const wo_context *context;
    const wo_lens *lens;
    wo_highlights *highlights;
    atomic_bool stop;
} image_job;

static int32_t step_of(int32_t extent)
{
    return extent / COUNTED > 1 ? extent / COUNTED : 1;
}

/* Share and densities of one image. Large ones are counted on every step-th pixel of each row, each
   row from another start. */
static void make_image(void *user, size_t index, unsigned worker)
{
    (void)worker;
    image_job *job = user;
    wo_highlight_image *image = &job->highlights->images[index];
    const double golden = 0.6180339887498949;
    const int32_t r = image->extent;
    const int32_t step = step_of(r);
    double sum = 0;
    double line[4] = {0};
    if (wo_aborted(job->context)) {
        atomic_store(&job->stop, true);
        return;
    }
    for (int32_t dy = -r; dy <= r; dy++) {
        double whole;
        const int32_t start = (int32_t)(step * modf((dy + r) * golden, &whole));
        for (int32_t dx = start - r; dx <= r; dx += step) {
            const double d = wo_highlight_density(job->lens, dx, dy, image->v, image->reach, line);
            sum += d;
            if (image->density)
                image->density[place_of(image, dx, dy)] = (float)d;
            if (image->line)
                memcpy(image->line[place_of(image, dx, dy)], line, sizeof line);
        }
    }
    image->share = sum > 0 ? 1 / (sum * step) : 0;
}

/* Pixels of an image if it is to be kept: large ones, and those of fewer than least highlights, are
 * not. */
static size_t room_of(const wo_highlight_image *image, size_t least)
{
    const size_t side = 2 * (size_t)image->extent + 1;
    return step_of(image->extent) > 1 || image->uses < least ? 0 : side * side;
}

static bool is_soft(const wo_highlight_image *image)
{
    return (double)image->reach < 2 * SOFT;
}

/* Pixels of all images that are kept. */
static size_t room_of_all(const wo_highlights *highlights, size_t least, bool soft_ones)
{
    size_t pixels = 0;
    for (size_t i = 0; i < highlights->image_count; i++)
        if (!soft_ones || is_soft(&highlights->images[i]))
            pixels += room_of(&highlights->images[i], least);
    return pixels;
}

static wo_status give_room(const wo_context *context, wo_highlights *highlights, wo_error *error)
{
    const size_t limit = context && context->max_bytes ? context->max_bytes / sizeof(float) : MOST;
    const size_t most = limit < MOST ? limit : MOST;
    size_t least = 1;
    while (room_of_all(highlights, least, false) > most ||
           room_of_all(highlights, least, true) > most / 8)
        least *= 2;
    const size_t pixels = room_of_all(highlights, least, false);
    const size_t soft = room_of_all(highlights, least, true);
    if (pixels > 0 && !(highlights->densities =
                            wo_new_raw(context, error, pixels, sizeof *highlights->densities)))
        return WO_ERR_NOMEM;
    if (soft > 0 &&
        !(highlights->lines = wo_new_raw(context, error, soft, sizeof *highlights->lines)))
        return WO_ERR_NOMEM;
    float *next = highlights->densities;
    double(*next_line)[4] = highlights->lines;
    for (size_t i = 0; i < highlights->image_count; i++) {
        wo_highlight_image *image = &highlights->images[i];
        const size_t room = room_of(image, least);
        if (room == 0)
            continue;
        image->density = next;
        next += room;
        if (is_soft(image)) {
            image->line = next_line;
            next_line += room;
        }
    }
    return WO_OK;
}

wo_status wo_highlight_images_make(const wo_context *context, const wo_lens *lens,
                                   wo_highlights *highlights, wo_error *error)
{
    const size_t count = highlights->count;
    wo_status status = WO_ERR_NOMEM;
    size_t images = 0;
    key *keys = wo_new(context, error, count, sizeof *keys);
    if (!keys)
        return WO_ERR_NOMEM;
    for (size_t i = 0; i < count; i++)
        keys[i] = (key){highlights->list[i].v, highlights->list[i].reach, i};
    qsort(keys, count, sizeof *keys, compare);
    for (size_t i = 0; i < count; i++)
        images += i == 0 || keys[i].v != keys[i - 1].v;
    highlights->images = wo_new(context, error, images, sizeof *highlights->images);
    if (!highlights->images)
        goto done;
    for (size_t i = 0; i < count; i++) {
        if (i == 0 || keys[i].v != keys[i - 1].v)
            highlights->images[highlights->image_count++] =
                (wo_highlight_image){.v = keys[i].v,
                                     .reach = keys[i].reach,
                                     .extent = wo_highlight_extent(keys[i].reach)};
        highlights->images[highlights->image_count - 1].uses++;
        highlights->list[keys[i].at].image = highlights->image_count - 1;
    }
    status = give_room(context, highlights, error);
    if (status != WO_OK)
        goto done;
    image_job job = {.context = context, .lens = lens, .highlights = highlights};
    wo_run(context, make_image, &job, images);
    if (atomic_load(&job.stop))
        status = wo_fail(error, WO_ABORTED, "stopped by the user");
done:
    wo_delete(context, keys);
    return status;
}
