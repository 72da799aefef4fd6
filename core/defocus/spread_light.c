/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/spread_light.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* Radii of point spreads, px: in steps of 1/RADII px up to 1 px, of 1/RADII of the radius up to
   RADIUS_EVEN, of 2 px from there on: never more than 1 px beside the true one. A quarter of them
   for each zone of a lens that has zones. */
#define RADII       64.0
#define RADIUS_EVEN 128.0
#define ZONE_FINE   0.25

static double number_of_radius(double r)
{
    if (r <= 1)
        return RADII * r;
    if (r <= RADIUS_EVEN)
        return RADII * (1 + log(r));
    return RADII * (1 + log(RADIUS_EVEN)) + (r - RADIUS_EVEN) * (RADII / RADIUS_EVEN);
}

static double radius_of_number(double n)
{
    if (n <= RADII)
        return n / RADII;
    const double even = RADII * (1 + log(RADIUS_EVEN));
    if (n <= even)
        return exp(n / RADII - 1);
    return RADIUS_EVEN + (n - even) * (RADIUS_EVEN / RADII);
}

/* Buckets are 2 BUCKET_EVEN / sqrt(samples) px of radius wide near the focus and grow in proportion
   from a radius of BUCKET_EVEN on. */
#define BUCKET_EVEN 4.0

#define BUCKET_FINEST 32.0

static double bucket_scale(const wo_defocus *scene)
{
    return fmin(0.5 * sqrt(scene->quality.samples), BUCKET_FINEST);
}

/* From the focus: 0, rising to the front. */
static int32_t bucket_from_focus(double scale, double r)
{
    return (int32_t)rint(copysign(scale * log1p(fabs(r) / BUCKET_EVEN), r));
}

int32_t wo_spread_light_bucket(const wo_spread_light *light, double v)
{
    return light->nearest - bucket_from_focus(light->scale, v * light->px_per_dioptre);
}

typedef struct light_job {
    const wo_defocus *scene;
    wo_spread_light *light;
    atomic_uchar *used; /* [places] */
    size_t *rows;       /* [h] lights of each row */
    uint32_t *bucket;   /* [workers][row_max] of the lights of a row */
    wo_light *room;     /* [workers][row_max] */
    size_t row_max;
    uint8_t *classes; /* [workers] most */
    atomic_bool failed;
} light_job;

static int compare_floats(const void *a, const void *b)
{
    const float x = *(const float *)a;
    const float y = *(const float *)b;
    return (x > y) - (x < y);
}

/* A piece is what lies in one block of a row of cells. Where it has one vergence, that one is used
   as it is. */
static bool level_piece(const wo_stack *stack, int s, int32_t x, int32_t y, float *v)
{
    const int32_t i = (x - stack->area.x1) / WO_BLOCK * (WO_BLOCK / WO_CELL);
    const int32_t j = (y - stack->area.y1) / WO_CELL;
    const wo_bounds *cell = stack->cells[s] + (ptrdiff_t)j * stack->cell_columns + i;
    *v = cell[0].v_min;
    for (int k = 0; k < WO_BLOCK / WO_CELL; k++)
        if (!(cell[k].v_min == *v && cell[k].v_max == *v))
            return false;
    return true;
}

static wo_status find_exact(const wo_defocus *scene, wo_spread_light *light, wo_error *error)
{
    const wo_stack *stack = scene->stack;
    const wo_rect r = light->rect;
    const size_t blocks = (size_t)(wo_rect_width(r) / WO_BLOCK + 2);
    const size_t most = blocks * (size_t)(wo_rect_height(r) / WO_CELL + 2);
    light->exact = wo_new(scene->context, error, most * (size_t)stack->sheets, sizeof(float));
    if (!light->exact)
        return WO_ERR_NOMEM;
    size_t n = 0;
    const wo_rect a = stack->area;
    for (int s = 0; s < stack->sheets; s++) {
        for (int32_t y = r.y1 - (r.y1 - a.y1) % WO_CELL; y < r.y2; y += WO_CELL)
            for (int32_t x = r.x1 - (r.x1 - a.x1) % WO_BLOCK; x < r.x2; x += WO_BLOCK) {
                float v;
                if (level_piece(stack, s, x, y, &v) && (n == 0 || light->exact[n - 1] != v))
                    light->exact[n++] = v;
            }
    }
    qsort(light->exact, n, sizeof(float), compare_floats);
    for (size_t i = 0; i < n; i++)
        if (i == 0 || light->exact[i] != light->exact[light->exact_count - 1])
            light->exact[light->exact_count++] = light->exact[i];
    return WO_OK;
}

static uint32_t place_of(const wo_spread_light *light, wo_spread_place at)
{
    const double r = at.v * light->px_per_dioptre;
    const double n = fmin(rint(light->fine * number_of_radius(fabs(r))), light->radii);
    const int32_t zx = wo_floor_div(at.x, WO_ZONE) - light->zones.x1;
    const int32_t zy = wo_floor_div(at.y, WO_ZONE) - light->zones.y1;
    const int32_t zone = light->same ? 0 : zy * wo_rect_width(light->zones) + zx;
    return (uint32_t)zone * (uint32_t)(2 * light->radii + 1) +
           (uint32_t)((int32_t)copysign(n, r) + light->radii);
}

/* The place of a vergence that find_exact found. */
static uint32_t exact_place(const wo_spread_light *light, float v)
{
    size_t low = 0;
    size_t high = light->exact_count - 1;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (light->exact[middle] < v)
            low = middle + 1;
        else
            high = middle;
    }
    return (uint32_t)(light->places - light->exact_count + low);
}

const wo_point_spread *wo_spread_light_at(const wo_spread_light *light, wo_spread_place place)
{
    return &light->spreads[place_of(light, place)];
}

/* Lights of one row on their way into the list. */
typedef struct row_sink {
    wo_light *list; /* NULL = only count */
    uint32_t *bucket;
    size_t count;
    int classes;
} row_sink;

static void put(row_sink *sink, int32_t x, uint32_t place, uint32_t bucket, int plane,
                const float c[4])
{
    if (sink->list) {
        wo_light *to = &sink->list[sink->count];
        *to = (wo_light){x, place, (uint32_t)plane, {0}};
        memcpy(to->c, c, sizeof to->c);
        sink->bucket[sink->count] = bucket;
    }
    sink->count++;
}

/* left: the part of it that nothing in the pixel hides; clear: the part of what it lets through
   that meets anything else behind. */
static void put_surface(row_sink *sink, int32_t x, uint32_t place, uint32_t bucket, bool guessed,
                        bool coloured, const float c[4], float left, float clear)
{
    const int kind = guessed ? WO_LIGHT_GUESSED : WO_LIGHT_GIVEN;
    const float peak = fmaxf(fabsf(c[0]), fmaxf(fabsf(c[1]), fabsf(c[2])));
    int class = 0;
    for (float limit = 16; !(peak < limit) && class < WO_LIGHT_CLASSES - 1; limit *= 4096)
        class ++;
    const float all[4] = {left * c[0], left * c[1], left * c[2], left * c[3]};
    if (class == 0) {
        put(sink, x, place, bucket, kind, all);
    } else {
        put(sink, x, place, bucket, kind + WO_LIGHT_KINDS * class,
            (const float[4]){all[0], all[1], all[2], 0});
        put(sink, x, place, bucket, kind, (const float[4]){0, 0, 0, all[3]});
        sink->classes = class > sink->classes ? class : sink->classes;
    }
    if (c[3] < 1 && clear > 0) {
        const float open = clear * left * (1 - c[3]);
        put(sink, x, place, bucket, WO_LIGHT_CLEAR, (const float[4]){open, open, open, open});
    }
    if (coloured)
        put(sink, x, place, bucket, WO_LIGHT_COVER, (const float[4]){all[3], all[3], all[3], 0});
}

/* Two surfaces in one pixel. When their radii differ by less than NEAR_PX, what one hides of the
   other, and the gaps in it that show the other, are the same for every ray: the one behind loses
   what the one before covers, and the two add up. From WIDE_PX on a ray that goes through one meets
   the other anywhere: that is left to the laying of buckets. In between, some of both. */
#define NEAR_PX 1.0f
#define WIDE_PX 8.0f

static float apart(float px)
{
    return fminf(fmaxf((px - NEAR_PX) / (WIDE_PX - NEAR_PX), 0), 1);
}

/* All that lies in one pixel, from front to back. */
static void put_pixel(const light_job *job, int32_t x, int32_t y, const bool level[WO_SHEETS_MAX],
                      row_sink *sink)
{
    const wo_stack *stack = job->scene->stack;
    const wo_spread_light *light = job->light;
    const ptrdiff_t at = wo_stack_at(stack, x, y);
    int order[WO_SHEETS_MAX];
    int n = 0;
    for (int s = 0; s < stack->sheets; s++) {
        const float v = stack->v[s][at];
        if (isnan(v))
            continue;
        int i = n++;
        for (; i > 0 && stack->v[order[i - 1]][at] < v; i--)
            order[i] = order[i - 1];
        order[i] = s;
    }
    for (int i = 0; i < n; i++) {
        const int s = order[i];
        const float v = stack->v[s][at];
        const int32_t b = wo_spread_light_bucket(light, (double)v);
        const float scale = (float)light->px_per_dioptre;
        float left = 1;
        for (int j = 0; j < i; j++)
            left *=
                1 - stack->c[order[j]][3][at] * (1 - apart(scale * (stack->v[order[j]][at] - v)));
        const float clear = i + 1 < n ? apart(scale * (v - stack->v[order[i + 1]][at])) : 1;
        if (!(left > 0))
            continue;
        const float c[4] = {stack->c[s][0][at], stack->c[s][1][at], stack->c[s][2][at],
                            stack->c[s][3][at]};
        const uint32_t place =
            level[s] ? exact_place(light, v) : place_of(light, (wo_spread_place){x, y, (double)v});
        if (!sink->list)
            atomic_store_explicit(&job->used[place], 1, memory_order_relaxed);
        put_surface(sink, x, place, (uint32_t)b, stack->guessed[s], !light->same, c, left, clear);
    }
}

static void put_row(const light_job *job, int32_t y, row_sink *sink)
{
    const wo_spread_light *light = job->light;
    const wo_stack *stack = job->scene->stack;
    bool level[WO_SHEETS_MAX] = {false};
    for (int32_t x = light->rect.x1; x < light->rect.x2; x++) {
        if (x == light->rect.x1 || (x - stack->area.x1) % WO_BLOCK == 0) {
            float v;
            for (int s = 0; s < stack->sheets && light->exact_count > 0; s++)
                level[s] = level_piece(stack, s, x, y, &v);
        }
        put_pixel(job, x, y, level, sink);
    }
}

static void count_row(void *user, size_t index, unsigned worker)
{
    light_job *job = user;
    row_sink sink = {.list = NULL};
    if (wo_aborted(job->scene->context))
        return;
    put_row(job, job->light->rect.y1 + (int32_t)index, &sink);
    job->rows[index] = sink.count;
    if (sink.classes > job->classes[worker])
        job->classes[worker] = (uint8_t)sink.classes;
}

/* Sorts the lights of a row by buckets. */
static void sort_row(void *user, size_t index, unsigned worker)
{
    light_job *job = user;
    wo_spread_light *light = job->light;
    const size_t buckets = (size_t)light->buckets;
    size_t *const first = light->first + index * (buckets + 1);
    row_sink sink = {.list = job->room + worker * job->row_max,
                     .bucket = job->bucket + worker * job->row_max};
    if (wo_aborted(job->scene->context))
        return;
    put_row(job, light->rect.y1 + (int32_t)index, &sink);
    const size_t start = index > 0 ? job->rows[index - 1] : 0;
    for (size_t i = 0; i < sink.count; i++)
        first[sink.bucket[i] + 1]++;
    first[0] = start;
    for (size_t b = 0; b < buckets; b++)
        first[b + 1] += first[b];
    /* first[b] runs to the end of its bucket, which is the start of the next. */
    for (size_t i = 0; i < sink.count; i++)
        light->list[first[sink.bucket[i]]++] = sink.list[i];
    for (size_t b = buckets; b > 0; b--)
        first[b] = first[b - 1];
    first[0] = start;
}

/* Vergence and place that a point spread stands for. */
static wo_spread_place stands_for(const wo_spread_light *light, size_t place)
{
    const size_t exact = light->places - light->exact_count;
    if (place >= exact)
        return (wo_spread_place){0, 0, (double)light->exact[place - exact]};
    const size_t radii = 2 * (size_t)light->radii + 1;
    const int32_t zone = (int32_t)(place / radii);
    const int32_t n = (int32_t)(place % radii) - light->radii;
    const int32_t columns = wo_rect_width(light->zones);
    const double v = copysign(radius_of_number(abs(n) / light->fine), n) / light->px_per_dioptre;
    return (wo_spread_place){(light->zones.x1 + zone % columns) * WO_ZONE + WO_ZONE / 2,
                             (light->zones.y1 + zone / columns) * WO_ZONE + WO_ZONE / 2, v};
}

static void make_spread(void *user, size_t index, unsigned worker)
{
    (void)worker;
    light_job *job = user;
    const wo_context *context = job->scene->context;
    if (!atomic_load_explicit(&job->used[index], memory_order_relaxed) || wo_aborted(context))
        return;
    const wo_spread_place at = stands_for(job->light, index);
    wo_point_raster raster;
    wo_status status =
        wo_point_raster_create(context, job->scene->lens, at.x, at.y, at.v, &raster, NULL);
    if (status == WO_OK)
        status = wo_point_spread_create(context, &raster, &job->light->spreads[index], NULL);
    wo_point_raster_destroy(context, &raster);
    if (status != WO_OK)
        atomic_store(&job->failed, true);
}

/* Which buckets and point spreads there are. */
static wo_status survey(light_job *job, wo_error *error)
{
    wo_spread_light *light = job->light;
    const wo_stack *stack = job->scene->stack;
    const wo_lens *lens = job->scene->lens;
    const bool zoned = !lens->connect;
    wo_bounds all = {INFINITY, -INFINITY};
    for (int s = 0; s < stack->sheets; s++) {
        unsigned flags = 0;
        const wo_bounds bounds = wo_stack_bounds(stack, s, light->rect, &flags);
        all.v_min = fminf(all.v_min, bounds.v_min);
        all.v_max = fmaxf(all.v_max, bounds.v_max);
    }
    if (!(all.v_min <= all.v_max))
        all = (wo_bounds){0, 0};
    light->px_per_dioptre = lens->px_per_dioptre;
    light->fine = zoned ? ZONE_FINE : 1;
    light->same = !zoned;
    const double r_min = (double)all.v_min * light->px_per_dioptre;
    const double r_max = (double)all.v_max * light->px_per_dioptre;
    light->radii =
        (int32_t)rint(light->fine * number_of_radius(fmax(fabs(r_min), fabs(r_max)))) + 1;
    job->light->nearest = bucket_from_focus(job->light->scale, r_max);
    light->buckets = job->light->nearest - bucket_from_focus(job->light->scale, r_min) + 1;
    const wo_rect r = light->rect;
    light->zones = (wo_rect){0, 0, 1, 1};
    if (zoned)
        light->zones =
            (wo_rect){wo_floor_div(r.x1, WO_ZONE), wo_floor_div(r.y1, WO_ZONE),
                      wo_floor_div(r.x2 - 1, WO_ZONE) + 1, wo_floor_div(r.y2 - 1, WO_ZONE) + 1};
    else
        WO_TRY(find_exact(job->scene, light, error));
    light->places = (size_t)wo_rect_width(light->zones) * (size_t)wo_rect_height(light->zones) *
                        (2 * (size_t)light->radii + 1) +
                    light->exact_count;
    return WO_OK;
}

/* How far the lights of each bucket go. */
static void find_reach(const light_job *job)
{
    const wo_spread_light *light = job->light;
    for (size_t i = 0; i < light->places; i++) {
        if (!light->spreads[i].first)
            continue;
        const double v = stands_for(light, i).v;
        const wo_rect r = light->spreads[i].rect;
        /* A rounded radius may lie in the bucket next to those of its lights. */
        const int32_t b = wo_spread_light_bucket(light, v);
        for (int32_t k = b - 1; k <= b + 1; k++)
            if (k >= 0 && k < light->buckets && light->reach[k] < r.x2)
                light->reach[k] = r.x2;
    }
}

static wo_status aborted(const wo_context *context, wo_error *error)
{
    return wo_aborted(context) ? wo_fail(error, WO_ABORTED, "stopped by the user") : WO_OK;
}

static wo_status fill(light_job *job, const wo_spread_place *asked, size_t asked_count,
                      wo_error *error)
{
    wo_spread_light *light = job->light;
    const wo_context *context = job->scene->context;
    const size_t h = (size_t)wo_rect_height(light->rect);
    const size_t workers = wo_workers(context);
    WO_TRY(survey(job, error));
    const size_t buckets = (size_t)light->buckets;
    if (!(job->used = wo_new(context, error, light->places, sizeof *job->used)) ||
        !(job->rows = wo_new(context, error, h, sizeof *job->rows)) ||
        !(job->classes = wo_new(context, error, workers, sizeof *job->classes)) ||
        !(light->spreads = wo_new(context, error, light->places, sizeof *light->spreads)) ||
        !(light->reach = wo_new(context, error, buckets, sizeof *light->reach)) ||
        !(light->first = wo_new(context, error, h * (buckets + 1), sizeof *light->first)))
        return WO_ERR_NOMEM;
    for (size_t i = 0; i < asked_count; i++)
        atomic_store(&job->used[place_of(light, asked[i])], 1);
    wo_run(context, count_row, job, h);
    WO_TRY(aborted(context, error));
    wo_run(context, make_spread, job, light->places);
    WO_TRY(aborted(context, error));
    if (atomic_load(&job->failed))
        return wo_fail(error, WO_ERR_NOMEM, "no memory for the point spreads");
    find_reach(job);
    uint8_t classes = 0;
    for (size_t i = 0; i < workers; i++)
        classes = job->classes[i] > classes ? job->classes[i] : classes;
    light->planes = WO_LIGHT_KINDS * (classes + 1);
    for (size_t y = 0; y < h; y++) {
        job->row_max = job->rows[y] > job->row_max ? job->rows[y] : job->row_max;
        light->count = job->rows[y] += light->count;
    }
    if (light->count == 0)
        return WO_OK;
    if (!(light->list = wo_new_large(context, error, light->count, sizeof *light->list)) ||
        !(job->room = wo_new(context, error, workers * job->row_max, sizeof *job->room)) ||
        !(job->bucket = wo_new(context, error, workers * job->row_max, sizeof *job->bucket)))
        return WO_ERR_NOMEM;
    wo_run(context, sort_row, job, h);
    return aborted(context, error);
}

wo_status wo_spread_light_create(const wo_defocus *scene, wo_rect rect,
                                 const wo_spread_place *asked, size_t asked_count,
                                 wo_spread_light *light, wo_error *error)
{
    const wo_context *context = scene->context;
    *light = (wo_spread_light){.rect = rect};
    light->scale = bucket_scale(scene);
    light_job job = {.scene = scene, .light = light};
    const wo_status status = fill(&job, asked, asked_count, error);
    wo_delete(context, (void *)job.used);
    wo_delete(context, job.rows);
    wo_delete(context, job.classes);
    wo_delete(context, job.room);
    wo_delete(context, job.bucket);
    if (status != WO_OK)
        wo_spread_light_destroy(context, light);
    return status;
}

void wo_spread_light_destroy(const wo_context *context, wo_spread_light *light)
{
    for (size_t i = 0; light->spreads && i < light->places; i++)
        wo_point_spread_destroy(context, &light->spreads[i]);
    wo_delete(context, light->spreads);
    wo_delete(context, light->list);
    wo_delete(context, light->first);
    wo_delete(context, light->reach);
    wo_delete(context, light->exact);
    *light = (wo_spread_light){0};
}
