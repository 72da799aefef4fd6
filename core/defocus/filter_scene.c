/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/filter_scene.h"

#include <math.h>
#include <string.h>

/* px on a side of a block that shares one shape; rays that are asked for its shape. */
enum { BLOCK = 128, SHAPE_RAYS = 2048 };
/* Smaller holes are not seen. */
#define HOLE_MIN 0.15f
/* Surfaces of a pixel closer than this in blur are one, px. */
#define TOGETHER_PX 0.5f

/* The circumference of a square on its corner, cut into equal parts. */
int wo_filter_bin(float x, float y)
{
    const float sum = fabsf(x) + fabsf(y);
    const float t = y / sum;
    const float turn = x >= 0 ? (y >= 0 ? t : 4 + t) : 2 - t;
    const int bin = (int)(turn * (WO_FILTER_BINS / 4.0f));
    return bin < WO_FILTER_BINS ? bin : WO_FILTER_BINS - 1;
}

/* Angle where a bin starts. */
static double bin_start(int bin)
{
    const double turn = 4.0 * bin / WO_FILTER_BINS;
    const double x = turn <= 2 ? 1 - turn : turn - 3;
    const double y = turn <= 1 ? turn : turn <= 3 ? 2 - turn : turn - 4;
    const double angle = atan2(y, x);
    return angle < 0 ? angle + 2 * 3.14159265358979323846 : angle;
}

/* What a pencil tells of the shape. */
typedef struct survey {
    double aa, ab, bb; /* sums of products of the rays' places and slopes */
    int rays, lit;
    int count[WO_FILTER_BINS];
    float least[WO_FILTER_BINS], most[WO_FILTER_BINS]; /* slope, px per dioptre */
} survey;

static void survey_pencil(const wo_pencil *pencil, survey *s)
{
    for (int i = 0; i < pencil->count; i++) {
        s->rays++;
        if (pencil->weight[0] &&
            !(pencil->weight[0][i] + pencil->weight[1][i] + pencil->weight[2][i] > 0))
            continue;
        const float ax = pencil->ax[i];
        const float ay = pencil->ay[i];
        const float bx = pencil->bx[i];
        const float by = pencil->by[i];
        s->lit++;
        s->aa += (double)(ax * ax + ay * ay);
        s->ab += (double)(ax * bx + ay * by);
        s->bb += (double)(bx * bx + by * by);
        if (bx == 0 && by == 0)
            continue;
        const float b = hypotf(bx, by);
        const int bin = wo_filter_bin(bx, by);
        s->least[bin] = s->count[bin] == 0 || b < s->least[bin] ? b : s->least[bin];
        s->most[bin] = fmaxf(s->most[bin], b);
        s->count[bin]++;
    }
}

static void shape_of_survey(const survey *s, const wo_lens *lens, wo_filter_shape *shape)
{
    *shape = (wo_filter_shape){.ppd = (float)lens->px_per_dioptre, .lit = 1};
    for (int i = 0; i < WO_FILTER_BINS; i++)
        shape->outer[i] = 1;
    if (s->lit == 0 || !(s->bb > 0))
        return;
    double area = 0;
    float hole = 1;
    float last = 0;
    for (int pass = 0; pass < 2; pass++) { /* a bin without rays is like the one before it */
        area = 0;
        for (int i = 0; i < WO_FILTER_BINS; i++) {
            if (s->count[i] > 0) {
                /* The farthest of n points is not quite on the boundary. */
                last = s->most[i] * sqrtf(1 + 1 / (float)s->count[i]);
                hole = fminf(hole, s->least[i] / s->most[i]);
            }
            shape->outer[i] = last;
            const double next =
                i + 1 < WO_FILTER_BINS ? bin_start(i + 1) : 2 * 3.14159265358979323846;
            area += 0.5 * (double)(last * last) * (next - bin_start(i));
        }
    }
    const double v0 = -s->ab / s->bb;
    const double rest = fmax(s->aa + s->ab * v0, 0);
    shape->ppd = (float)sqrt(area / 3.14159265358979323846);
    shape->v0 = (float)v0;
    shape->rest = (float)sqrt(rest / s->bb) * shape->ppd;
    shape->lit = (float)s->lit / (float)s->rays;
    shape->hole = hole > HOLE_MIN ? hole : 0;
    for (int i = 0; i < WO_FILTER_BINS; i++)
        shape->outer[i] /= shape->ppd;
}

static void measure(double reach, double *radius, double *area)
{
    enum { AROUND = 5 };
    double sum = 0;
    double moment = 0;
    for (int y = -AROUND; y <= AROUND; y++)
        for (int x = -AROUND; x <= AROUND; x++) {
            const double w = (double)wo_filter_soft((float)reach, hypotf((float)x, (float)y));
            sum += w;
            moment += w * x * x;
        }
    *radius = 2 * sqrt(moment / sum);
    *area = sum;
}

void wo_filter_discs_make(wo_filter_discs *discs)
{
    const double step = 1.0 / 256;
    double reach = 0.5;
    double r[2] = {0, 0};
    double area[2] = {1, 1};
    for (int i = 0; i < WO_FILTER_RADII + 2; i++) {
        const double want = (double)i / WO_FILTER_FINE;
        while (r[1] < want) {
            r[0] = r[1];
            area[0] = area[1];
            measure(reach += step, &r[1], &area[1]);
        }
        const double t = r[1] > r[0] ? (want - r[0]) / (r[1] - r[0]) : 1;
        discs->reach[i] = (float)(reach - step * (1 - t));
        discs->share[i] = (float)(1 / (area[0] + t * (area[1] - area[0])));
    }
}

typedef struct make_job {
    const wo_context *context;
    wo_filter_scene *scene;
    float *near[7];
    float *far[8];
    float *open;
} make_job;

static void shape_block(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const make_job *job = user;
    wo_filter_scene *scene = job->scene;
    const wo_lens *lens = scene->lens;
    const int32_t columns = wo_rect_width(scene->blocks);
    const int32_t bx = scene->blocks.x1 + (int32_t)index % columns;
    const int32_t by = scene->blocks.y1 + (int32_t)index / columns;
    survey s = {0};
    for (unsigned set = 0; set < lens->sets && s.rays < SHAPE_RAYS; set++) {
        for (int first = 0; first < lens->count; first += WO_PENCIL_PIECE) {
            wo_pencil_room room;
            wo_pencil pencil;
            if (wo_aborted(job->context))
                return;
            lens->pencil(lens->self, (bx + 0.5) * BLOCK, (by + 0.5) * BLOCK, set, first, &room,
                         &pencil);
            survey_pencil(&pencil, &s);
        }
    }
    shape_of_survey(&s, lens, &scene->shape[index]);
}

/* A surface of a pixel; v is NaN where there is none. */
typedef struct surface {
    float v;
    float c[4];
    float guessed; /* 0..1 */
} surface;

static surface behind(surface front, const surface *back)
{
    const float left = 1 - front.c[3];
    for (int k = 0; k < 4; k++)
        front.c[k] += left * back->c[k];
    front.guessed += left * back->c[3] * (back->guessed - front.guessed);
    return front;
}

/* The surfaces of one pixel of these sheets as two, nearest first. */
static void two_surfaces(const wo_stack *stack, const int *sheets, int sheet_count, ptrdiff_t at,
                         float together, surface out[2])
{
    surface list[WO_SHEETS_MAX];
    int count = 0;
    out[0] = out[1] = (surface){.v = NAN};
    for (int n = 0; n < sheet_count; n++) {
        const int s = sheets[n];
        const float v = stack->v[s][at];
        if (isnan(v))
            continue;
        int i = count++;
        for (; i > 0 && list[i - 1].v < v; i--)
            list[i] = list[i - 1];
        list[i] = (surface){
            v,
            {stack->c[s][0][at], stack->c[s][1][at], stack->c[s][2][at], stack->c[s][3][at]},
            stack->guessed[s] ? 1.0f : 0.0f};
    }
    int next = 0;
    for (int place = 0; place < 2 && next < count; place++) {
        out[place] = list[next++];
        /* What is left for the last place is put together whatever its depth. */
        while (next < count && (place == 1 || out[place].v - list[next].v < together)) {
            const float light = (1 - out[place].c[3]) * list[next].c[3];
            const float all = out[place].c[3] + light;
            if (place == 1 && all > 0)
                out[place].v += light / all * (list[next].v - out[place].v);
            out[place] = behind(out[place], &list[next++]);
        }
    }
}

/* The surfaces of the pixels of a vector. */
typedef struct surfaces {
    float v[WO_LANES];
    float c[4][WO_LANES];
    float guessed[WO_LANES];
} surfaces;

static void set(surfaces *to, int i, const surface *from)
{
    to->v[i] = from->v;
    for (int k = 0; k < 4; k++)
        to->c[k][i] = from->c[k];
    to->guessed[i] = from->guessed;
}

static void put(float *const planes[7], ptrdiff_t at, const surfaces *s,
                const wo_filter_discs *discs, const wo_filter_shape *shape)
{
    float d[WO_LANES];
    float reach[WO_LANES];
    float share[WO_LANES];
    float light[4][WO_LANES];
    for (int i = 0; i < WO_LANES; i++) {
        const bool any = s->v[i] == s->v[i];
        const float v = any ? s->v[i] : shape->v0;
        const float far = (v - shape->v0) * shape->ppd;
        wo_filter_disc(discs, wo_filter_radius(shape, far), shape->hole, &reach[i], &share[i]);
        d[i] = any ? far : WO_FILTER_NONE;
        reach[i] = any ? reach[i] : WO_FILTER_NONE;
        share[i] = any ? share[i] : 0;
    }
    for (int i = 0; i < WO_LANES; i++) {
        const bool any = s->v[i] == s->v[i];
        for (int k = 0; k < 3; k++)
            light[k][i] = any ? s->c[k][i] * share[i] : 0;
        light[3][i] = any ? s->c[3][i] : 0;
    }
    memcpy(planes[0] + at, d, sizeof d);
    memcpy(planes[1] + at, reach, sizeof reach);
    memcpy(planes[2] + at, share, sizeof share);
    memcpy(planes[3] + at, light[3], sizeof light[3]);
    for (int k = 0; k < 3; k++)
        memcpy(planes[4 + k] + at, light[k], sizeof light[k]);
}

/* Sheets that hold anything in a block of flags. */
static int sheets_of(const wo_stack *stack, int32_t x, int32_t y, int sheets[WO_SHEETS_MAX])
{
    int count = 0;
    unsigned flags = 0;
    for (int s = 0; s < stack->sheets; s++) {
        const wo_bounds b =
            wo_stack_bounds(stack, s, (wo_rect){x, y, x + WO_BLOCK, y + WO_CELL}, &flags);
        if (b.v_min <= b.v_max)
            sheets[count++] = s;
    }
    return count;
}

/* Those of the sheets that hold any of sixteen pixels. */
static int sheets_at(const wo_stack *stack, const int *sheets, int count, ptrdiff_t from,
                     int here[WO_SHEETS_MAX])
{
    int found = 0;
    for (int n = 0; n < count; n++) {
        int any = 0;
        for (int i = 0; i < WO_LANES; i++)
            any |= stack->v[sheets[n]][from + i] == stack->v[sheets[n]][from + i];
        if (any)
            here[found++] = sheets[n];
    }
    return found;
}

/* Sixteen pixels of one run. */
static uint8_t fill_vector(const make_job *job, const int *sheets, int count,
                           const wo_filter_shape *shape, ptrdiff_t from, ptrdiff_t to)
{
    const wo_stack *stack = job->scene->stack;
    const float together = TOGETHER_PX / shape->ppd;
    int here[WO_SHEETS_MAX];
    surfaces pair[2];
    uint8_t flags = 0;
    count = sheets_at(stack, sheets, count, from, here);
    if (count == 1) {
        memcpy(pair[0].v, stack->v[here[0]] + from, sizeof pair[0].v);
        for (int k = 0; k < 4; k++)
            memcpy(pair[0].c[k], stack->c[here[0]][k] + from, sizeof pair[0].c[k]);
    }
    for (int i = 0; i < WO_LANES && count != 1; i++) {
        surface two[2];
        two_surfaces(stack, here, count, from + i, together, two);
        set(&pair[0], i, &two[0]);
        set(&pair[1], i, &two[1]);
        flags |= two[1].v == two[1].v ? WO_FILTER_FAR : 0;
    }
    put(job->near, to, &pair[0], &job->scene->discs, shape);
    /* What is left 0 counts as nothing. */
    if (flags & WO_FILTER_FAR) {
        put(job->far, to, &pair[1], &job->scene->discs, shape);
        memcpy(job->far[7] + to, pair[1].guessed, sizeof pair[1].guessed);
    }
    for (int i = 0; i < WO_LANES; i++) {
        job->open[to + i] = 1 - stack->opaque[from + i];
        flags |= job->open[to + i] > 0 ? WO_FILTER_OPEN : 0;
    }
    return flags;
}

static uint8_t fill_block(const make_job *job, int32_t x, int32_t y1)
{
    const wo_filter_scene *scene = job->scene;
    const wo_filter_shape *shape = wo_filter_shape_at(scene, x, y1);
    int sheets[WO_SHEETS_MAX];
    const int count = sheets_of(scene->stack, x, y1, sheets);
    uint8_t flags = 0;
    for (int32_t y = y1; y < y1 + WO_CELL; y++)
        for (int run = 0; run < WO_PHASES; run++)
            flags |= fill_vector(job, sheets, count, shape, wo_stack_at(scene->stack, x + run, y),
                                 (y - scene->area.y1) * scene->view.row + run * scene->view.run +
                                     (x - scene->area.x1) / WO_PHASES);
    return flags;
}

static void fill_row(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const make_job *job = user;
    const wo_filter_scene *scene = job->scene;
    const wo_rect a = scene->area;
    const int32_t y = a.y1 + (int32_t)index * WO_CELL;
    uint8_t *flags = scene->flags + index * (size_t)(wo_rect_width(a) / WO_BLOCK);
    if (wo_aborted(job->context))
        return;
    for (int32_t x = a.x1; x < a.x2; x += WO_BLOCK)
        *flags++ = fill_block(job, x, y);
}

static void give_planes(make_job *job, size_t plane)
{
    wo_filter_scene *scene = job->scene;
    float *next = scene->memory;
    job->open = next;
    for (int i = 0; i < 7; i++)
        job->near[i] = next += plane;
    for (int i = 0; i < 8 && scene->stack->sheets > 1; i++)
        job->far[i] = next += plane;
    wo_filter_picture *pictures[2] = {&scene->view.near, &scene->view.far};
    for (int i = 0; i < 2; i++) {
        float *const *p = i == 0 ? job->near : job->far;
        *pictures[i] = (wo_filter_picture){.d = p[0],
                                           .reach = p[1],
                                           .share = p[2],
                                           .cover = p[3],
                                           .c = {p[4], p[5], p[6]},
                                           .guessed = i == 1 ? job->far[7] : NULL};
    }
    scene->view.open = job->open;
}

wo_status wo_filter_scene_create(const wo_context *context, const wo_stack *stack,
                                 const wo_lens *lens, wo_rect area, wo_filter_scene *scene,
                                 wo_error *error)
{
    /* Rows end in spare floats, so that a vector that starts inside never leaves the memory. */
    enum { SPARE = WO_LANES };
    const wo_rect a = wo_stack_grid(area);
    *scene = (wo_filter_scene){.stack = stack, .lens = lens, .area = a};
    if (stack->sheets == 0 || wo_rect_empty(area))
        return WO_OK;
    scene->blocks = (wo_rect){wo_floor_div(a.x1, BLOCK), wo_floor_div(a.y1, BLOCK),
                              wo_floor_div(a.x2 - 1, BLOCK) + 1, wo_floor_div(a.y2 - 1, BLOCK) + 1};
    const size_t blocks =
        (size_t)wo_rect_width(scene->blocks) * (size_t)wo_rect_height(scene->blocks);
    const size_t rows = (size_t)(wo_rect_height(a) / WO_CELL);
    scene->view.run = wo_rect_width(a) / WO_PHASES + SPARE;
    scene->view.row = scene->view.run * WO_PHASES;
    const size_t plane = (size_t)scene->view.row * rows * WO_CELL;
    const size_t planes = stack->sheets > 1 ? 16 : 8;
    scene->shape = wo_new(context, error, blocks, sizeof *scene->shape);
    if (scene->shape)
        scene->flags = wo_new(context, error, rows * (size_t)(wo_rect_width(a) / WO_BLOCK),
                              sizeof *scene->flags);
    if (scene->flags)
        scene->memory = wo_new_large(context, error, plane, planes * sizeof *scene->memory);
    if (!scene->memory) {
        wo_filter_scene_destroy(context, scene);
        return WO_ERR_NOMEM;
    }
    make_job job = {.context = context, .scene = scene};
    give_planes(&job, plane);
    wo_filter_discs_make(&scene->discs);
    wo_run(context, shape_block, &job, blocks);
    wo_run(context, fill_row, &job, rows);
    if (!wo_aborted(context))
        return WO_OK;
    wo_filter_scene_destroy(context, scene);
    return wo_fail(error, WO_ABORTED, "stopped by the user");
}

void wo_filter_scene_destroy(const wo_context *context, wo_filter_scene *scene)
{
    wo_delete(context, scene->shape);
    wo_delete(context, scene->memory);
    wo_delete(context, scene->flags);
    *scene = (wo_filter_scene){0};
}

const wo_filter_shape *wo_filter_shape_at(const wo_filter_scene *scene, int32_t x, int32_t y)
{
    const int32_t column = wo_floor_div(x, BLOCK) - scene->blocks.x1;
    const int32_t row = wo_floor_div(y, BLOCK) - scene->blocks.y1;
    return &scene->shape[row * wo_rect_width(scene->blocks) + column];
}

wo_filter_view wo_filter_view_of(const wo_filter_scene *scene, wo_rect r)
{
    const wo_rect a = scene->area;
    const ptrdiff_t columns = wo_rect_width(a) / WO_BLOCK;
    uint8_t flags = 0;
    for (int32_t j = (r.y1 - a.y1) / WO_CELL; j <= (r.y2 - 1 - a.y1) / WO_CELL; j++)
        for (int32_t i = (r.x1 - a.x1) / WO_BLOCK; i <= (r.x2 - 1 - a.x1) / WO_BLOCK; i++)
            flags |= scene->flags[j * columns + i];
    wo_filter_view view = scene->view;
    if (!(flags & WO_FILTER_FAR))
        view.far.d = NULL;
    if (!(flags & WO_FILTER_OPEN))
        view.open = NULL;
    return view;
}
