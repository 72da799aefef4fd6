/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/point_spread.h"

#include "defocus/lens_rays.h"
#include "defocus/point_image.h"

#include <math.h>
#include <string.h>

/* Up to this radius an aperture is sampled on a grid of its own, above it by pixels. px */
#define SMALL_PX 8.0
enum { SMALL_GRID = 128 };
/* Offsets up to here are interpolated: |i| <= WO_SMOOTH_PX of the march. */
#define SMOOTH_PX (WO_SMOOTH_PX + 0.5)

static double *value_at(const wo_point_raster *raster, int channel, int32_t x, int32_t y)
{
    const ptrdiff_t w = wo_rect_width(raster->rect);
    const ptrdiff_t h = wo_rect_height(raster->rect);
    return raster->value + (channel * h + y - raster->rect.y1) * w + x - raster->rect.x1;
}

static wo_status make(const wo_context *context, int32_t reach, int channels,
                      wo_point_raster *raster, wo_error *error)
{
    const size_t side = 2 * (size_t)reach + 1;
    *raster =
        (wo_point_raster){.rect = {-reach, -reach, reach + 1, reach + 1}, .channels = channels};
    raster->value = wo_new(context, error, side * side, (size_t)channels * sizeof *raster->value);
    return raster->value ? WO_OK : WO_ERR_NOMEM;
}

void wo_point_raster_destroy(const wo_context *context, wo_point_raster *raster)
{
    wo_delete(context, raster->value);
    *raster = (wo_point_raster){0};
}

/* The interpolation of the march: weights of the pixels around the nearest one. */
static int32_t nearest(double d, double w[3])
{
    const double n = rint(d);
    const double t = d - n;
    w[0] = t * t - 0.5 * t;
    w[1] = 1 - 2 * t * t;
    w[2] = t * t + 0.5 * t;
    return (int32_t)n;
}

/* Light that goes to (ex, ey). */
static void drop(const wo_point_raster *raster, int channel, double ex, double ey, double light)
{
    double wx[3];
    double wy[3];
    const int32_t x = nearest(ex, wx);
    const int32_t y = nearest(ey, wy);
    if (fmax(fabs(ex), fabs(ey)) >= SMOOTH_PX) {
        *value_at(raster, channel, x, y) += light;
        return;
    }
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++)
            *value_at(raster, channel, x + i - 1, y + j - 1) += wx[i] * wy[j] * light;
}

/* The grid grows with the aperture, so that nothing jumps as the radius changes. */
static void raster_small(const wo_lens *lens, double v, double radius, wo_point_raster *raster)
{
    double line[4];
    for (int j = 0; j < SMALL_GRID; j++) {
        for (int i = 0; i < SMALL_GRID; i++) {
            const double ex = radius * ((2 * i + 1.0) / SMALL_GRID - 1);
            const double ey = radius * ((2 * j + 1.0) / SMALL_GRID - 1);
            const double light = lens->connect(lens->self, -ex, -ey, v, line);
            if (light > 0)
                drop(raster, 0, ex, ey, light);
        }
    }
}

/* Mean density over a pixel that the rim crosses. */
static double rim(const wo_lens *lens, double v, int sub, int32_t x, int32_t y)
{
    double sum = 0;
    double line[4];
    for (int i = 0; i < sub * sub; i++) {
        const double ex = x + (i % sub + 0.5) / sub - 0.5;
        const double ey = y + ((double)(i / sub) + 0.5) / sub - 0.5;
        sum += lens->connect(lens->self, -ex, -ey, v, line);
    }
    return sum / (sub * sub);
}

static void raster_large(const wo_lens *lens, double v, double radius, double *corners,
                         wo_point_raster *raster)
{
    const wo_rect r = raster->rect;
    const int32_t w = wo_rect_width(r);
    const int sub = radius < 4 * SMALL_PX ? 8 : 4;
    double line[4];
    double *below = corners;
    double *above = corners + w + 1;
    for (int32_t y = r.y1; y <= r.y2; y++) {
        for (int32_t x = r.x1; x <= r.x2; x++)
            above[x - r.x1] = lens->connect(lens->self, 0.5 - x, 0.5 - y, v, line);
        for (int32_t i = 0; y > r.y1 && i < w; i++) {
            const int32_t x = r.x1 + i;
            const double c[4] = {below[i], below[i + 1], above[i], above[i + 1]};
            const double middle = lens->connect(lens->self, -x, 1 - y, v, line);
            const bool flat = c[0] == middle && c[1] == middle && c[2] == middle && c[3] == middle;
            const bool crossed = !(middle > 0 && c[0] > 0 && c[1] > 0 && c[2] > 0 && c[3] > 0);
            /* Simpson's rule, where it is smooth. */
            *value_at(raster, 0, x, y - 1) = flat ? middle
                                             : crossed
                                                 ? rim(lens, v, sub, x, y - 1)
                                                 : (8 * middle + c[0] + c[1] + c[2] + c[3]) / 12;
        }
        double *const swap = below;
        below = above;
        above = swap;
    }
}

/* Values of a row of an image that differ by no more than this part of the largest are one step. */
#define IMAGE_NOISE (1.0 / 32)
/* Rows that are drawn at a time. */
enum { ROWS = 32 };

/* Dots of an image on their way into a raster. */
typedef struct dot_job {
    const wo_point_raster *raster;
    const double *colour;
} dot_job;

static void drop_dot(void *user, double x, double y, double light)
{
    const dot_job *job = user;
    const int colours = job->raster->channels == 4 ? 3 : 1;
    for (int k = 0; k < colours; k++)
        if (job->colour[k] > 0)
            drop(job->raster, k, x, y, light * job->colour[k]);
}

static wo_status draw_image(const wo_context *context, const wo_lens *lens,
                            const wo_point_image *image, wo_point_raster *raster, wo_error *error)
{
    const wo_rect r = image->rect;
    const int32_t w = wo_rect_width(r);
    double *room =
        wo_new(context, error, wo_point_image_draw_room(lens, image->v, ROWS), sizeof *room);
    wo_point_pixel *pixels = wo_new(context, error, (size_t)w * ROWS, sizeof *pixels);
    for (int32_t y1 = r.y1; room && pixels && y1 < r.y2; y1 += ROWS) {
        const int32_t y2 = y1 + ROWS < r.y2 ? y1 + ROWS : r.y2;
        wo_point_image_draw(image, y1, y2, false, room, pixels);
        const wo_point_pixel *p = pixels;
        for (int32_t y = y1; y < y2; y++)
            for (int32_t x = r.x1; x < r.x2; x++, p++)
                for (int k = 0; k < (raster->channels == 4 ? 3 : 1); k++)
                    *value_at(raster, k, x, y) = (double)p->light[k];
    }
    const bool done = room && pixels;
    wo_delete(context, room);
    wo_delete(context, pixels);
    raster->noise = IMAGE_NOISE;
    return done ? WO_OK : WO_ERR_NOMEM;
}

static wo_status raster_image(const wo_context *context, const wo_lens *lens, double x, double y,
                              double v, wo_point_raster *raster, wo_error *error)
{
    float *memory = wo_new(context, error, wo_point_image_room(lens, v), sizeof *memory);
    if (!memory)
        return WO_ERR_NOMEM;
    wo_point_image image;
    wo_point_image_make(lens, x, y, v, memory, &image);
    const wo_rect r = image.rect;
    const int32_t sides[] = {-r.x1, -r.y1, r.x2 - 1, r.y2 - 1};
    int32_t reach = 0;
    for (int i = 0; i < 4; i++)
        reach = sides[i] > reach ? sides[i] : reach;
    /* Dots go to the neighbours of their pixel, too. */
    wo_status status = make(context, reach + 1, lens->colours ? 4 : 1, raster, error);
    if (status == WO_OK && lens->reach(lens->self, v, v) >= SMOOTH_PX)
        status = draw_image(context, lens, &image, raster, error);
    else
        for (int line = 0; status == WO_OK && line < image.lines; line++) {
            dot_job job = {raster, image.line_colour[line]};
            wo_point_image_dots(&image, line, drop_dot, &job);
        }
    wo_delete(context, memory);
    return status;
}

/* Each channel's sum becomes 1; one without light is a point. */
static void normalise(wo_point_raster *raster)
{
    const size_t n = (size_t)wo_rect_width(raster->rect) * (size_t)wo_rect_height(raster->rect);
    const int colours = raster->channels == 4 ? 3 : 1;
    for (int k = 0; k < colours; k++) {
        double *const value = raster->value + (size_t)k * n;
        double sum = 0;
        for (size_t i = 0; i < n; i++)
            sum += value[i];
        if (!(sum > 0)) {
            memset(value, 0, n * sizeof *value);
            *value_at(raster, k, 0, 0) = sum = 1;
        }
        for (size_t i = 0; i < n; i++)
            value[i] /= sum;
    }
    for (size_t i = 0; i < n && colours == 3; i++)
        raster->value[3 * n + i] =
            (raster->value[i] + raster->value[n + i] + raster->value[2 * n + i]) / 3;
}

wo_status wo_point_raster_create(const wo_context *context, const wo_lens *lens, double x, double y,
                                 double v, wo_point_raster *raster, wo_error *error)
{
    *raster = (wo_point_raster){0};
    const double radius = lens->reach(lens->self, v, v);
    wo_status status = WO_OK;
    if (radius < WO_SHARP_PX) {
        status = make(context, 0, 1, raster, error);
    } else if (!lens->connect) {
        status = raster_image(context, lens, x, y, v, raster, error);
    } else {
        status = make(context, (int32_t)(radius + 0.5) + 1, 1, raster, error);
        if (status == WO_OK && radius <= SMALL_PX) {
            raster_small(lens, v, radius, raster);
        } else if (status == WO_OK) {
            const size_t w = (size_t)wo_rect_width(raster->rect);
            double *corners = wo_new(context, error, 2 * (w + 1), sizeof *corners);
            if (corners)
                raster_large(lens, v, radius, corners, raster);
            else
                status = WO_ERR_NOMEM;
            wo_delete(context, corners);
        }
    }
    if (status == WO_OK)
        normalise(raster);
    else
        wo_point_raster_destroy(context, raster);
    return status;
}

/* The steps of a row; returns how many. to: NULL = only count. */
static uint32_t row_steps(const wo_point_raster *raster, int32_t y, const double noise[4],
                          wo_point_step *to)
{
    const wo_rect r = raster->rect;
    uint32_t count = 0;
    float last[4] = {0};
    for (int32_t x = r.x1, end; x < r.x2; x = end) {
        double low[4];
        double high[4];
        double sum[4] = {0};
        for (end = x; end < r.x2; end++) {
            bool alike = true;
            for (int k = 0; k < raster->channels; k++) {
                const double value = *value_at(raster, k, end, y);
                low[k] = end == x ? value : fmin(low[k], value);
                high[k] = end == x ? value : fmax(high[k], value);
                /* What is dark stays dark: no light beyond the rim. */
                alike &= high[k] - low[k] <= noise[k] && (low[k] != 0) == (high[k] != 0);
            }
            if (!alike)
                break;
            for (int k = 0; k < raster->channels; k++)
                sum[k] += *value_at(raster, k, end, y);
        }
        float level[4];
        for (int k = 0; k < 4; k++)
            level[k] = (float)(sum[raster->channels == 4 ? k : 0] / (end - x));
        if (memcmp(level, last, sizeof level) == 0)
            continue;
        if (to) {
            to[count].x = x;
            memcpy(to[count].level, level, sizeof level);
        }
        count++;
        memcpy(last, level, sizeof level);
    }
    const float zero[4] = {0};
    if (memcmp(last, zero, sizeof zero) != 0) {
        if (to)
            to[count] = (wo_point_step){.x = r.x2};
        count++;
    }
    return count;
}

wo_status wo_point_spread_create(const wo_context *context, const wo_point_raster *raster,
                                 wo_point_spread *spread, wo_error *error)
{
    *spread = (wo_point_spread){.rect = raster->rect};
    const wo_rect r = raster->rect;
    const size_t n = (size_t)wo_rect_width(r) * (size_t)wo_rect_height(r);
    double noise[4] = {0};
    for (int k = 0; k < raster->channels; k++) {
        for (size_t i = 0; i < n; i++)
            noise[k] = fmax(noise[k], raster->value[(size_t)k * n + i]);
        noise[k] *= raster->noise;
    }
    const size_t h = (size_t)wo_rect_height(r);
    if (!(spread->first = wo_new(context, error, h + 1, sizeof *spread->first)))
        return WO_ERR_NOMEM;
    for (size_t y = 0; y < h; y++)
        spread->first[y + 1] = spread->first[y] + row_steps(raster, r.y1 + (int32_t)y, noise, NULL);
    if (!(spread->steps = wo_new(context, error, spread->first[h], sizeof *spread->steps))) {
        wo_point_spread_destroy(context, spread);
        return WO_ERR_NOMEM;
    }
    for (size_t y = 0; y < h; y++)
        (void)row_steps(raster, r.y1 + (int32_t)y, noise, spread->steps + spread->first[y]);
    return WO_OK;
}

void wo_point_spread_destroy(const wo_context *context, wo_point_spread *spread)
{
    wo_delete(context, spread->first);
    wo_delete(context, spread->steps);
    *spread = (wo_point_spread){0};
}
