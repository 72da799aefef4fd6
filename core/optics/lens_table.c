/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/lens_table.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

/* A little more than the pupil is fitted, so that its edge is not the fit's edge. */
#define BEYOND_CLIP 1.2

enum {
    SAMPLES = 320,     /* rays of one fit, in half the iris */
    VALIDATIONS = 400, /* random rays for the error */
    CLIP_SAMPLES_MIN = 40
};

/* Number of terms s^i t^j, i + j <= degree, j = 0, 2, 4.. */
static int even_terms(int degree)
{
    int n = 0;
    for (int j = 0; j <= degree; j += 2)
        n += degree - j + 1;
    return n;
}

static int terms_at(int degree, double s, double t2, double *row)
{
    int n = 0;
    double power = 1;
    for (int j = 0; j <= degree; j += 2) {
        double p = power;
        for (int i = 0; i <= degree - j; i++) {
            row[n++] = p;
            p *= s;
        }
        power *= t2;
    }
    return n;
}

/* Least squares by Householder reflections: a is [rows][columns] and b [rows][sides], both lost; x
   is [columns][sides]. Columns that depend on others get 0. */
static void solve(double *a, int rows, int columns, double *b, int sides, double *x)
{
    for (int k = 0; k < columns; k++) {
        double norm2 = 0;
        for (int i = k; i < rows; i++)
            norm2 += a[i * columns + k] * a[i * columns + k];
        const double norm = sqrt(norm2);
        if (norm < 1e-11) {
            a[k * columns + k] = 0;
            continue;
        }
        const double alpha = a[k * columns + k] > 0 ? -norm : norm;
        const double head = a[k * columns + k] - alpha;
        const double beta = -1 / (alpha * head); /* 2 / |w|^2, w = (head, rest) */
        for (int j = k + 1; j < columns; j++) {
            double dot = head * a[k * columns + j];
            for (int i = k + 1; i < rows; i++)
                dot += a[i * columns + k] * a[i * columns + j];
            dot *= beta;
            a[k * columns + j] -= dot * head;
            for (int i = k + 1; i < rows; i++)
                a[i * columns + j] -= dot * a[i * columns + k];
        }
        for (int j = 0; j < sides; j++) {
            double dot = head * b[k * sides + j];
            for (int i = k + 1; i < rows; i++)
                dot += a[i * columns + k] * b[i * sides + j];
            dot *= beta;
            b[k * sides + j] -= dot * head;
            for (int i = k + 1; i < rows; i++)
                b[i * sides + j] -= dot * a[i * columns + k];
        }
        a[k * columns + k] = alpha;
    }
    for (int j = 0; j < sides; j++) {
        for (int k = columns - 1; k >= 0; k--) {
            double sum = b[k * sides + j];
            for (int i = k + 1; i < columns; i++)
                sum -= a[k * columns + i] * x[i * sides + j];
            x[k * sides + j] = a[k * columns + k] != 0 ? sum / a[k * columns + k] : 0;
        }
    }
}

/* Rays of one node. */
typedef struct sample_set {
    int count;
    double s[SAMPLES], t[SAMPLES];
    wo_model_ray ray[SAMPLES];
} sample_set;

typedef struct work {
    double a[SAMPLES * WO_TABLE_EVEN_MAX];
    double b[SAMPLES * WO_MODEL_CLIPS];
    double x[WO_TABLE_EVEN_MAX * WO_MODEL_CLIPS];
} work;

typedef struct fit_job {
    const wo_lens_model *model;
    wo_lens_table *table;
    sample_set *samples; /* [lines][nodes] */
    work *works;         /* [workers] */
} fit_job;

static double clip_most(const wo_lens_model *model, const wo_model_ray *ray)
{
    double most = 0;
    for (int k = 0; k < model->clips; k++)
        most = fmax(most, ray->clip[k]);
    return most;
}

/* Points of the upper half of the iris, every eighth on its edge. */
static void sample_node(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const fit_job *job = user;
    const wo_lens_table *table = job->table;
    sample_set *set = &job->samples[index];
    const int line = (int)index / table->nodes;
    const double h = table->field_max * (double)((int)index % table->nodes) / (table->nodes - 1);
    set->count = 0;
    for (int i = 0; i < SAMPLES; i++) {
        const double r = i % 8 == 0 ? 1 : sqrt((i + 0.5) / SAMPLES);
        const double angle = PI * fmod(i * 0.6180339887498949, 1);
        const double u[2] = {r * cos(angle), r * sin(angle)};
        wo_model_ray ray = {.weight = 0};
        if (!wo_lens_model_ray(job->model, h, u, table->nm[line], &ray))
            continue;
        set->s[set->count] = u[0];
        set->t[set->count] = u[1];
        set->ray[set->count++] = ray;
    }
}

/* How far out field points get light in every wavelength. */
static wo_status find_light(const fit_job *job, wo_error *error)
{
    wo_lens_table *table = job->table;
    table->lit = 0;
    for (bool lit = true; lit && table->lit < table->nodes; table->lit += lit) {
        for (int line = 0; line < table->lines; line++) {
            const sample_set *set = &job->samples[line * table->nodes + table->lit];
            int through = 0;
            for (int i = 0; i < set->count; i++)
                through += clip_most(job->model, &set->ray[i]) < BEYOND_CLIP;
            lit &= through >= CLIP_SAMPLES_MIN;
        }
    }
    if (table->lit < 4)
        return wo_fail(error, WO_ERR_UNSUPPORTED,
                       "the lens lights only %d of %d field points: its image circle is too small",
                       table->lit, table->nodes);
    table->field_lit = table->field_max * (table->lit - 1) / (table->nodes - 1);
    return WO_OK;
}

/* Copies coefficients of a lower degree into rows of the table's. */
static void spread(const double *x, int sides, int side, int degree, int to_degree, float *out)
{
    int from = 0;
    int to = 0;
    for (int j = 0; j <= to_degree; j += 2) {
        for (int i = 0; i <= to_degree - j; i++)
            out[to + i] = i <= degree - j ? (float)x[(from + i) * sides + side] : 0.0f;
        from += degree - j + 1 > 0 ? degree - j + 1 : 0;
        to += to_degree - j + 1;
    }
}

static void fit_clips(const fit_job *job, const sample_set *set, work *w, wo_table_node *node)
{
    const int clips = job->model->clips;
    int degree = WO_TABLE_CLIP_DEGREE;
    while (degree > 2 && 3 * even_terms(degree) > 2 * set->count)
        degree -= 2;
    const int columns = even_terms(degree);
    for (int i = 0; i < set->count; i++) {
        terms_at(degree, set->s[i], set->t[i] * set->t[i], w->a + i * columns);
        for (int k = 0; k < clips; k++)
            w->b[i * clips + k] = set->ray[i].clip[k];
    }
    solve(w->a, set->count, columns, w->b, clips, w->x);
    for (int k = 0; k < clips; k++)
        spread(w->x, clips, k, degree, WO_TABLE_CLIP_DEGREE, node->clip[k]);
}

static void fit_node(void *user, size_t index, unsigned worker)
{
    const fit_job *job = user;
    const sample_set *set = &job->samples[index];
    work *w = &job->works[worker];
    wo_table_node *node = &job->table->node[index];
    memset(node, 0, sizeof *node);
    if (set->count >= CLIP_SAMPLES_MIN && job->model->clips > 0)
        fit_clips(job, set, w, node);
    int used[SAMPLES];
    int rows = 0;
    for (int i = 0; i < set->count; i++)
        if (clip_most(job->model, &set->ray[i]) < BEYOND_CLIP)
            used[rows++] = i;
    if (rows < CLIP_SAMPLES_MIN)
        return;
    int degree = job->table->degree;
    while (degree > 1 && 4 * even_terms(degree) > 3 * rows)
        degree--;
    int columns = even_terms(degree);
    for (int r = 0; r < rows; r++) {
        const int i = used[r];
        terms_at(degree, set->s[i], set->t[i] * set->t[i], w->a + r * columns);
        w->b[r * 3] = set->ray[i].a[0];
        w->b[r * 3 + 1] = set->ray[i].b[0];
        w->b[r * 3 + 2] = set->ray[i].weight;
    }
    solve(w->a, rows, columns, w->b, 3, w->x);
    float *const even[3] = {node->ax, node->bx, node->weight};
    for (int k = 0; k < 3; k++)
        spread(w->x, 3, k, degree, job->table->degree, even[k]);
    /* Odd ones: t times a polynomial of one degree less, each row times t. */
    columns = even_terms(degree - 1);
    for (int r = 0; r < rows; r++) {
        const int i = used[r];
        const double t = set->t[i];
        terms_at(degree - 1, set->s[i], t * t, w->a + r * columns);
        for (int c = 0; c < columns; c++)
            w->a[r * columns + c] *= t;
        w->b[r * 2] = set->ray[i].a[1];
        w->b[r * 2 + 1] = set->ray[i].b[1];
    }
    solve(w->a, rows, columns, w->b, 2, w->x);
    float *const odd[2] = {node->ay, node->by};
    for (int k = 0; k < 2; k++)
        spread(w->x, 2, k, degree - 1, job->table->degree - 1, odd[k]);
}

/* Adds weight times a node to another, seen from the other side of the axis when mirror is -1. */
static void add_rows(const float *from, int degree, int parity, double weight, bool mirror,
                     float *to)
{
    int at = 0;
    for (int j = 0; j <= degree; j += 2)
        for (int i = 0; i <= degree - j; i++, at++) {
            const double sign = mirror && ((i + parity) & 1) ? -1 : 1;
            to[at] += (float)(sign * weight) * from[at];
        }
}

void wo_lens_table_node(const wo_lens_table *table, int line, double h, wo_table_node *out)
{
    memset(out, 0, sizeof *out);
    const double at = fmin(fmax(h, 0) / table->field_max * (table->nodes - 1), table->lit - 1);
    int first = (int)at - 1;
    if (first > table->lit - 4)
        first = table->lit - 4;
    for (int k = 0; k < 4; k++) {
        double weight = 1;
        for (int m = 0; m < 4; m++)
            if (m != k)
                weight *= (at - (first + m)) / (double)(k - m);
        const bool mirror = first + k < 0;
        const int n = mirror ? -(first + k) : first + k;
        const wo_table_node *from = &table->node[(size_t)line * (size_t)table->nodes + (size_t)n];
        const int d = table->degree;
        add_rows(from->ax, d, 1, weight, mirror, out->ax);
        add_rows(from->bx, d, 1, weight, mirror, out->bx);
        add_rows(from->weight, d, 0, weight, mirror, out->weight);
        add_rows(from->ay, d - 1, 0, weight, mirror, out->ay);
        add_rows(from->by, d - 1, 0, weight, mirror, out->by);
        for (int c = 0; c < table->clips; c++)
            add_rows(from->clip[c], WO_TABLE_CLIP_DEGREE, 0, weight, mirror, out->clip[c]);
    }
}

static double unit(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) * 0x1p-24;
}

/* One random ray of the field, the wavelengths and the iris that gets through. */
typedef struct trial {
    bool valid;
    int line;
    double h, s, t;
    wo_model_ray ray;
} trial;

typedef struct trial_job {
    const wo_lens_model *model;
    const wo_lens_table *table;
    trial *trials;
} trial_job;

static void make_trial(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const trial_job *job = user;
    trial *t = &job->trials[index];
    uint32_t state = 0x9e3779b9u * (uint32_t)(index + 1);
    for (int k = 0; k < 4; k++)
        unit(&state);
    t->line = (int)(unit(&state) * job->table->lines);
    t->h = job->table->field_max * sqrt(unit(&state));
    const double r = sqrt(unit(&state));
    const double angle = 2 * PI * unit(&state);
    const double u[2] = {r * cos(angle), r * sin(angle)};
    t->s = u[0];
    t->t = u[1];
    t->ray = (wo_model_ray){.weight = 0};
    t->valid = wo_lens_model_ray(job->model, t->h, u, job->table->nm[t->line], &t->ray) &&
               clip_most(job->model, &t->ray) <= 1;
}

static void measure(wo_lens_table *table, const trial *trials, double focal_px,
                    double blur_dioptres)
{
    double sum = 0;
    int count = 0;
    table->worst_px = 0;
    for (int i = 0; i < VALIDATIONS; i++) {
        const trial *t = &trials[i];
        wo_table_node node;
        if (!t->valid || t->h > table->field_lit)
            continue;
        wo_lens_table_node(table, t->line, t->h, &node);
        float s[16] = {(float)t->s};
        float y[16] = {(float)t->t};
        float out[5][16];
        const wo_table_rays rays = {out[0], out[1], out[2], out[3], out[4], NULL};
        wo_table_eval_base(table, &node, s, y, 1, &rays);
        double worst = 0;
        for (int side = 0; side < 2; side++) {
            const double dv = side * blur_dioptres;
            const double ex =
                (double)out[0][0] - t->ray.a[0] + dv * ((double)out[2][0] - t->ray.b[0]);
            const double ey =
                (double)out[1][0] - t->ray.a[1] + dv * ((double)out[3][0] - t->ray.b[1]);
            worst = fmax(worst, focal_px * hypot(ex, ey));
        }
        sum += worst * worst;
        table->worst_px = fmax(table->worst_px, worst);
        count++;
    }
    table->rms_px = count > 0 ? sqrt(sum / count) : INFINITY;
}

static wo_status fit(const wo_context *context, const wo_lens_model *model, wo_lens_table *table,
                     const trial *trials, double focal_px, double blur_dioptres, double target_px,
                     wo_error *error)
{
    const size_t nodes = (size_t)table->lines * (size_t)table->nodes;
    fit_job job = {.model = model, .table = table};
    wo_status status = WO_ERR_NOMEM;
    job.samples = wo_new(context, error, nodes, sizeof *job.samples);
    job.works = wo_new(context, error, wo_workers(context), sizeof *job.works);
    wo_delete(context, table->node);
    table->node = wo_new(context, error, nodes, sizeof *table->node);
    if (job.samples && job.works && table->node) {
        wo_run(context, sample_node, &job, nodes);
        status = find_light(&job, error);
        for (int d = 5; status == WO_OK && d <= WO_TABLE_DEGREE_MAX && !wo_aborted(context);
             d += 2) {
            table->degree = d;
            wo_run(context, fit_node, &job, nodes);
            measure(table, trials, focal_px, blur_dioptres);
            if (table->rms_px <= target_px)
                break;
        }
    }
    wo_delete(context, job.samples);
    wo_delete(context, job.works);
    return wo_aborted(context) ? WO_ABORTED : status;
}

wo_status wo_lens_table_create(const wo_context *context, const wo_lens_model *model,
                               const double *nm, int lines, double focal_px, double blur_dioptres,
                               double target_px, wo_lens_table **table, wo_error *error)
{
    *table = NULL;
    if (lines < 1 || lines > WO_LINES_MAX)
        return wo_fail(error, WO_ERR_RANGE, "%d wavelengths: must be 1..%d", lines, WO_LINES_MAX);
    wo_lens_table *t = wo_new(context, error, 1, sizeof *t);
    trial *trials = wo_new(context, error, VALIDATIONS, sizeof *trials);
    wo_status status = t && trials ? WO_OK : WO_ERR_NOMEM;
    if (status == WO_OK) {
        t->lines = lines;
        t->clips = model->clips;
        t->field_max = model->field_max;
        memcpy(t->nm, nm, (size_t)lines * sizeof *nm);
        trial_job job = {model, t, trials};
        wo_run(context, make_trial, &job, VALIDATIONS);
        for (t->nodes = 9; status == WO_OK; t->nodes = 2 * t->nodes - 1) {
            status = fit(context, model, t, trials, focal_px, blur_dioptres, target_px, error);
            if (t->rms_px <= target_px || t->nodes >= 33)
                break;
        }
    }
    wo_delete(context, trials);
    if (status != WO_OK)
        wo_lens_table_destroy(context, &t);
    *table = t;
    return status;
}

void wo_lens_table_destroy(const wo_context *context, wo_lens_table **table)
{
    if (*table)
        wo_delete(context, (*table)->node);
    wo_delete(context, *table);
    *table = NULL;
}
