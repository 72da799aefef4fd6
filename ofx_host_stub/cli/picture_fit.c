/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "picture_fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double wo_part_aspect(const wo_io_part *part)
{
    const double aspect = part->pixel_aspect;
    return isfinite(aspect) && aspect > 0 ? aspect : 1;
}

/* One direction of a resampling: old = (new - to) / scale + from, in pixels. */
typedef struct axis {
    double scale, from, to;
    int32_t low, high;   /* old pixels */
    int32_t first, last; /* new ones, last is not one */
} axis;

static bool set_ends(axis *a)
{
    const double first = floor((a->low - a->from) * a->scale + a->to + 1e-6);
    const double last = ceil((a->high - a->from) * a->scale + a->to - 1e-6);
    if (!(fabs(first) <= WO_MAX_COORDINATE) || !(fabs(last) <= WO_MAX_COORDINATE) ||
        !(last - first <= WO_MAX_SIDE))
        return false;
    a->first = (int32_t)first;
    a->last = last > first ? (int32_t)last : (int32_t)first + 1;
    return true;
}

static int32_t inside(double x, const axis *a)
{
    return x < a->low ? a->low : x >= a->high ? a->high - 1 : (int32_t)floor(x);
}

/* Weights of a new pixel: those of the old pixels that it covers, by how much of them, but at least
   one pixel wide, which interpolates. Returns their number; *start is the first. */
static int32_t weigh(const axis *a, int32_t i, float *weights, int32_t *start)
{
    const double centre = (i + 0.5 - a->to) / a->scale + a->from;
    const double half = 0.5 * fmax(1, 1 / a->scale);
    const int32_t last = inside(centre + half - 1e-9, a);
    double sum = 0;
    *start = inside(centre - half, a);
    for (int32_t x = *start; x <= last; x++) {
        const double covered = fmin(centre + half, x + 1) - fmax(centre - half, x);
        weights[x - *start] = (float)fmax(covered, 0);
        sum += fmax(covered, 0);
    }
    for (int32_t x = *start; x <= last; x++)
        weights[x - *start] = sum > 0 ? weights[x - *start] / (float)sum : x == *start;
    return last - *start + 1;
}

static void pick(const axis *across, const axis *up, const wo_image *from, const wo_image *to)
{
    const size_t pixel = (size_t)from->components * sizeof(float);
    for (int32_t y = up->first; y < up->last; y++) {
        const int32_t row = inside((y + 0.5 - up->to) / up->scale + up->from, up);
        for (int32_t x = across->first; x < across->last; x++) {
            const double at = (x + 0.5 - across->to) / across->scale + across->from;
            memcpy(wo_image_at(to, x, y), wo_image_at(from, inside(at, across), row), pixel);
        }
    }
}

/* Pixel i of a line of new ones from old ones that lie step floats apart. */
static void blend(const float *weights, int32_t count, const float *from, ptrdiff_t step,
                  int32_t components, float *to)
{
    for (int32_t c = 0; c < components; c++) {
        double sum = 0;
        for (int32_t k = 0; k < count; k++)
            if (weights[k] != 0) /* infinity times 0 is no number */
                sum += (double)weights[k] * (double)from[k * step + c];
        to[c] = (float)sum;
    }
}

static void smooth(const axis *across, const axis *up, const wo_image *from, const wo_image *middle,
                   const wo_image *to, float *weights)
{
    int32_t start;
    for (int32_t x = across->first; x < across->last; x++) {
        const int32_t count = weigh(across, x, weights, &start);
        for (int32_t y = up->low; y < up->high; y++)
            blend(weights, count, wo_image_at(from, start, y), from->components, from->components,
                  wo_image_at(middle, x, y));
    }
    for (int32_t y = up->first; y < up->last; y++) {
        const int32_t count = weigh(up, y, weights, &start);
        for (int32_t x = across->first; x < across->last; x++)
            blend(weights, count, wo_image_at(middle, x, start),
                  middle->row_bytes / (ptrdiff_t)sizeof(float), from->components,
                  wo_image_at(to, x, y));
    }
}

static bool make(wo_image *image, wo_rect bounds, int32_t components)
{
    const size_t row = (size_t)wo_rect_width(bounds) * (size_t)components * sizeof(float);
    *image = (wo_image){malloc(row * (size_t)wo_rect_height(bounds)), bounds, (ptrdiff_t)row,
                        components};
    return image->data != NULL;
}

static wo_status resample(const axis *across, const axis *up, bool nearest, wo_image *image,
                          wo_error *error)
{
    const int32_t n = image->components;
    const int32_t most = across->high - across->low > up->high - up->low
                             ? across->high - across->low
                             : up->high - up->low;
    wo_image middle = {0}, result = {0};
    float *const weights = malloc((size_t)most * sizeof *weights);
    bool ok =
        weights && make(&result, (wo_rect){across->first, up->first, across->last, up->last}, n) &&
        (nearest || make(&middle, (wo_rect){across->first, up->low, across->last, up->high}, n));
    if (ok && nearest)
        pick(across, up, image, &result);
    else if (ok)
        smooth(across, up, image, &middle, &result, weights);
    free(weights);
    free(middle.data);
    free(ok ? image->data : result.data);
    if (!ok)
        return wo_fail(error, WO_ERR_NOMEM, "no memory to resample %d x %d pixels",
                       (int)wo_rect_width(image->bounds), (int)wo_rect_height(image->bounds));
    *image = result;
    return WO_OK;
}

wo_status wo_picture_fit(const wo_project_pixels *project, const wo_io_part *part, bool nearest,
                         wo_image *image, wo_error *error)
{
    const wo_rect p = project->window, d = part->display_window, b = image->bounds;
    const double aspect = wo_part_aspect(part);
    const bool same_aspect = fabs(aspect / project->aspect - 1) < 1e-4;
    const double stretch = same_aspect ? 1 : aspect / project->aspect;
    /* A width that no whole number of the other pixels has. */
    const double slack = same_aspect ? 0 : fmax(1, stretch);
    const bool same = wo_rect_height(d) == wo_rect_height(p) &&
                      fabs(wo_rect_width(d) * stretch - wo_rect_width(p)) <= slack;
    axis across = {.scale = stretch, .low = b.x1, .high = b.x2};
    axis up = {.scale = 1, .low = b.y1, .high = b.y2};
    if (!same && project->size == WO_CLIP_SIZE_ERROR)
        return wo_fail(error, WO_ERR_RANGE,
                       "%d x %d px of aspect %g, but Source has %d x %d of aspect %g: give it the "
                       "same size, or let render scale it (--clip-size scale) or leave it where it "
                       "lies (keep)",
                       wo_rect_width(d), wo_rect_height(d), aspect, wo_rect_width(p),
                       wo_rect_height(p), project->aspect);
    if (!same && project->size == WO_CLIP_SIZE_SCALE) {
        across.scale = (double)wo_rect_width(p) / wo_rect_width(d);
        across.from = d.x1;
        across.to = p.x1;
        up.scale = (double)wo_rect_height(p) / wo_rect_height(d);
        up.from = d.y1;
        up.to = p.y1;
    } else if (same_aspect) {
        return WO_OK;
    }
    if (!set_ends(&across) || !set_ends(&up))
        return wo_fail(error, WO_ERR_RANGE, "%d x %d px cannot be scaled by %g x %g",
                       wo_rect_width(b), wo_rect_height(b), across.scale, up.scale);
    return resample(&across, &up, nearest, image, error);
}
