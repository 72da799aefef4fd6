/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "scenes.h"

#include "near.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

uint64_t rng_bits(rng *r)
{
    uint64_t x = r->state += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

double rng_unit(rng *r)
{
    return (double)(rng_bits(r) >> 11) * 0x1p-53;
}

double rng_range(rng *r, double low, double high)
{
    return low + (high - low) * rng_unit(r);
}

int32_t rng_int(rng *r, int32_t low, int32_t high)
{
    return low + (int32_t)(rng_bits(r) % (uint64_t)((int64_t)high - low + 1));
}

wo_image picture_make(wo_rect bounds, int32_t components)
{
    const size_t w = (size_t)wo_rect_width(bounds);
    const size_t h = (size_t)wo_rect_height(bounds);
    wo_image picture = {NULL, bounds, (ptrdiff_t)(w * (size_t)components * sizeof(float)),
                        components};
    picture.data = calloc(w * h * (size_t)components, sizeof *picture.data);
    assert_non_null(picture.data);
    return picture;
}

void picture_free(wo_image *picture)
{
    free(picture->data);
    *picture = (wo_image){0};
}

wo_image picture_relaid(const wo_image *picture, int32_t pad, bool upside_down)
{
    const int32_t w = wo_rect_width(picture->bounds) * picture->components + pad;
    const int32_t h = wo_rect_height(picture->bounds);
    float *memory = malloc((size_t)w * (size_t)h * sizeof *memory);
    assert_non_null(memory);
    for (size_t i = 0; i < (size_t)w * (size_t)h; i++)
        memory[i] = NAN;
    wo_image out = *picture;
    out.row_bytes = (ptrdiff_t)w * (ptrdiff_t)sizeof *memory;
    out.data = memory;
    if (upside_down) {
        out.data = memory + (size_t)w * (size_t)(h - 1);
        out.row_bytes = -out.row_bytes;
    }
    for (int32_t y = out.bounds.y1; y < out.bounds.y2; y++)
        memcpy(wo_image_at(&out, out.bounds.x1, y), wo_image_at(picture, out.bounds.x1, y),
               (size_t)(w - pad) * sizeof *memory);
    return out;
}

void picture_free_relaid(wo_image *picture, bool upside_down)
{
    if (upside_down)
        picture->data = wo_image_at(picture, picture->bounds.x1, picture->bounds.y2 - 1);
    picture_free(picture);
}

void picture_fill(const wo_image *picture, const float *pixel)
{
    for (int32_t y = picture->bounds.y1; y < picture->bounds.y2; y++)
        for (int32_t x = picture->bounds.x1; x < picture->bounds.x2; x++)
            memcpy(wo_image_at(picture, x, y), pixel, (size_t)picture->components * sizeof *pixel);
}

double picture_difference(const wo_image *a, const wo_image *b, wo_rect bounds)
{
    double worst = 0;
    assert_int_equal(a->components, b->components);
    for (int32_t y = bounds.y1; y < bounds.y2; y++) {
        const float *p = wo_image_at(a, bounds.x1, y);
        const float *q = wo_image_at(b, bounds.x1, y);
        for (int32_t i = 0; i < wo_rect_width(bounds) * a->components; i++) {
            const double d = fabs((double)p[i] - (double)q[i]);
            worst = d <= INFINITY ? fmax(worst, d) : INFINITY;
        }
    }
    return worst;
}

double picture_rms(const wo_image *a, const wo_image *b, wo_rect bounds)
{
    double sum = 0;
    const int32_t n = wo_rect_width(bounds) * a->components;
    for (int32_t y = bounds.y1; y < bounds.y2; y++) {
        const float *p = wo_image_at(a, bounds.x1, y);
        const float *q = wo_image_at(b, bounds.x1, y);
        for (int32_t i = 0; i < n; i++)
            sum += ((double)p[i] - (double)q[i]) * ((double)p[i] - (double)q[i]);
    }
    return sqrt(sum / ((double)n * wo_rect_height(bounds)));
}

bool picture_same_bytes(const wo_image *a, const wo_image *b, wo_rect bounds)
{
    const size_t bytes = (size_t)wo_rect_width(bounds) * (size_t)a->components * sizeof *a->data;
    for (int32_t y = bounds.y1; y < bounds.y2; y++)
        if (memcmp(wo_image_at(a, bounds.x1, y), wo_image_at(b, bounds.x1, y), bytes) != 0)
            return false;
    return a->components == b->components;
}

bool picture_finite(const wo_image *picture)
{
    const int32_t n = wo_rect_width(picture->bounds) * picture->components;
    for (int32_t y = picture->bounds.y1; y < picture->bounds.y2; y++) {
        const float *p = wo_image_at(picture, picture->bounds.x1, y);
        for (int32_t i = 0; i < n; i++)
            if (!isfinite(p[i]))
                return false;
    }
    return true;
}

void scene_init(scene *s, wo_rect extent)
{
    *s = (scene){.geometry = WO_GEOMETRY_INIT};
    s->geometry.format = s->geometry.extent = extent;
    wo_params_default(wo_lens_blur_table, WO_LENS_BLUR_PARAMS, &s->params);
}

void scene_free(scene *s)
{
    for (int i = 0; i < WO_LENS_BLUR_CLIPS; i++)
        picture_free(&s->clip[i]);
}

wo_image *scene_clip(scene *s, int clip, int32_t components)
{
    picture_free(&s->clip[clip]);
    s->clip[clip] = picture_make(s->geometry.extent, components);
    return &s->clip[clip];
}

void scene_px_per_dioptre(scene *s, double px)
{
    const double f = s->params.focal_length;
    s->params.f_stop =
        wo_rect_width(s->geometry.format) / s->params.sensor_width * f * f * 1e-3 / (2 * px);
}

wo_plan_args scene_args(const scene *s, wo_rect window)
{
    wo_plan_args args = {.geometry = s->geometry, .window = window, .inputs = s->clip};
    for (int i = 0; i < WO_LENS_BLUR_CLIPS; i++)
        args.geometry.connected[i] = s->clip[i].data != NULL;
    memcpy(args.alpha, s->alpha, sizeof args.alpha);
    return args;
}

wo_status scene_run(const scene *s, const wo_context *context, wo_rect window, const wo_image *out,
                    wo_report *report, wo_error *error)
{
    const wo_effect *effect = wo_effect_find("LensBlur");
    assert_non_null(effect);
    const wo_plan_args args = scene_args(s, window);
    return wo_effect_run(effect, context, &s->params, &args, out, report, error);
}

wo_image scene_render(const scene *s, wo_report *report)
{
    const wo_context context = WO_CONTEXT_INIT;
    wo_error error = {WO_OK, ""};
    wo_image out = picture_make(s->geometry.extent, 4);
    if (scene_run(s, &context, s->geometry.extent, &out, report, &error) != WO_OK)
        fail_msg("%s", error.text);
    return out;
}

wo_rect random_window(rng *r, wo_rect in, int32_t width, int32_t height)
{
    wo_rect window = {rng_int(r, in.x1, in.x2 - 1), rng_int(r, in.y1, in.y2 - 1), 0, 0};
    window.x2 = rng_int(r, window.x1 + 1, window.x1 + width);
    window.y2 = rng_int(r, window.y1 + 1, window.y1 + height);
    return window;
}

/* A view of the part of a picture that lies in r. */
static wo_image part_of(const wo_image *picture, wo_rect r)
{
    wo_image part = *picture;
    r = wo_rect_intersect(r, picture->bounds);
    if (!picture->data || wo_rect_empty(r))
        return (wo_image){0};
    part.data = wo_image_at(picture, r.x1, r.y1);
    part.bounds = r;
    return part;
}

void scene_check_window(const scene *s, const wo_context *context, wo_rect window,
                        const wo_image *whole)
{
    scene cut = *s;
    const wo_plan_args args = scene_args(s, window);
    for (size_t clip = 0; clip < WO_LENS_BLUR_CLIPS; clip++) {
        wo_rect needed;
        assert_int_equal(
            wo_lens_blur.region(&s->params, &args.geometry, window, clip, &needed, NULL), WO_OK);
        cut.clip[clip] = part_of(&s->clip[clip], needed);
        assert_true(!s->clip[clip].data || cut.clip[clip].data);
    }
    wo_image out = picture_make(window, 4);
    assert_int_equal(scene_run(&cut, context, window, &out, NULL, NULL), WO_OK);
    const wo_rect extent = s->geometry.extent;
    assert_true(picture_same_bytes(&out, whole, wo_rect_intersect(window, extent)));
    for (int32_t y = window.y1; y < window.y2; y++)
        for (int32_t x = window.x1; x < window.x2; x++)
            if (!wo_rect_contains(extent, (wo_rect){x, y, x + 1, y + 1}))
                for (int k = 0; k < 4; k++)
                    assert_true(wo_image_at(&out, x, y)[k] == 0);
    picture_free(&out);
}

/* A smooth pattern of three colours. */
static void pattern(float *c, int32_t x, int32_t y, double phase, double level)
{
    for (int k = 0; k < 3; k++)
        c[k] = (float)(level * (1 + 0.8 * sin(phase + k + 0.21 * x + 0.13 * k * y) *
                                        cos(phase - 0.17 * y + 0.05 * x)));
    c[3] = 1;
}

void scene_fill_busy(scene *s, uint64_t seed)
{
    rng r = {seed};
    const wo_rect e = s->geometry.extent;
    const int32_t w = wo_rect_width(e);
    const int32_t h = wo_rect_height(e);
    wo_image *const source = scene_clip(s, WO_CLIP_SOURCE, 4);
    wo_image *const depth = scene_clip(s, WO_CLIP_DEPTH, 1);
    const double phase = rng_range(&r, 0, 6);
    wo_rect box[2];
    double z[2];
    for (int i = 0; i < 2; i++) {
        box[i].x1 = rng_int(&r, e.x1, e.x1 + w / 2);
        box[i].y1 = rng_int(&r, e.y1, e.y1 + h / 2);
        box[i].x2 = box[i].x1 + w / 4 + 1;
        box[i].y2 = box[i].y1 + h / 3 + 1;
        z[i] = rng_range(&r, 0.6, 2);
    }
    for (int32_t y = e.y1; y < e.y2; y++) {
        for (int32_t x = e.x1; x < e.x2; x++) {
            float *const c = wo_image_at(source, x, y);
            pattern(c, x, y, phase, 0.5);
            double metres = 2.5 + 4.0 * (x - e.x1) / w + (y - e.y1 > h / 2 ? 3 : 0);
            for (int i = 0; i < 2; i++)
                if (wo_rect_contains(box[i], (wo_rect){x, y, x + 1, y + 1}) && z[i] < metres) {
                    metres = z[i];
                    pattern(c, y, x, 2 + i, 1.2);
                }
            *wo_image_at(depth, x, y) = (float)metres;
        }
    }
    /* A few lights, one beside another. */
    for (int i = 0; i < 3; i++) {
        float *const c =
            wo_image_at(source, rng_int(&r, e.x1, e.x2 - 1), rng_int(&r, e.y1, e.y2 - 1));
        c[0] = c[1] = c[2] = (float)rng_range(&r, 3, 400);
    }
}

void scene_fill_layers(scene *s, uint64_t seed)
{
    scene_fill_busy(s, seed);
    rng r = {seed ^ 77};
    const wo_rect e = s->geometry.extent;
    wo_image *const back = scene_clip(s, 2, 4);
    wo_image *const back_depth = scene_clip(s, 3, 1);
    for (int32_t y = e.y1; y < e.y2; y++) {
        for (int32_t x = e.x1; x < e.x2; x++) {
            pattern(wo_image_at(back, x, y), x, y, 4, 0.8);
            *wo_image_at(back_depth, x, y) = 12;
            float *const c = wo_image_at(&s->clip[WO_CLIP_SOURCE], x, y);
            const double wave = sin(0.3 * x) + sin(0.23 * y);
            const float a = wave > 0.6 ? 0 : wave > 0.4 ? (float)rng_unit(&r) : 1;
            for (int k = 0; k < 4; k++)
                c[k] *= a;
        }
    }
}

typedef struct team {
    void (*func)(void *job, size_t index, unsigned worker);
    void *job;
    size_t count;
    atomic_size_t next;
} team;

typedef struct member {
    team *team;
    unsigned worker;
} member;

static void *work(void *user)
{
    const member *m = user;
    team *t = m->team;
    for (size_t i = atomic_fetch_add(&t->next, 1); i < t->count; i = atomic_fetch_add(&t->next, 1))
        t->func(t->job, i, m->worker);
    return NULL;
}

enum { THREADS_MAX = 16 };

static unsigned threads_workers(void *user)
{
    const unsigned count = *(const unsigned *)user;
    return count < 1 ? 1 : count > THREADS_MAX ? THREADS_MAX : count;
}

static void threads_run(void *user, void (*func)(void *job, size_t index, unsigned worker),
                        void *job, size_t count)
{
    pthread_t threads[THREADS_MAX];
    member members[THREADS_MAX];
    team t = {.func = func, .job = job, .count = count};
    atomic_init(&t.next, 0);
    const unsigned workers = threads_workers(user);
    unsigned started = 0;
    for (unsigned i = 0; i < workers; i++) {
        members[i] = (member){&t, i};
        if (i > 0 && pthread_create(&threads[i], NULL, work, &members[i]) != 0)
            break;
        started = i + 1;
    }
    work(&members[0]);
    for (unsigned i = 1; i < started; i++)
        pthread_join(threads[i], NULL);
}

wo_runner threads_runner(const unsigned *count)
{
    union {
        const unsigned *from;
        void *to;
    } user = {.from = count};
    return (wo_runner){user.to, threads_workers, threads_run};
}
