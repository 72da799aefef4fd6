/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/lens_table.h"

#include "optics/lens_fit.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

enum { VALIDATIONS = 400, NODES_FIRST = 9, DEGREE_FIRST = 5, LIT_POINTS = 256 };

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
    const double at = fmin(fmax(h, 0) / table->field, 1) * (table->nodes - 1);
    int first = (int)at - 1;
    if (first > table->nodes - 4)
        first = table->nodes - 4;
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
        if (table->edge)
            add_rows(from->edge, WO_TABLE_EDGE_DEGREE, 0, weight, mirror, out->edge);
    }
}

/* One ray of the table, as a model gives it; false when it does not count. */
static bool table_ray(const wo_lens_table *table, const wo_lens_request *request, int line,
                      double h, const double u[2], wo_model_ray *ray)
{
    wo_table_node node;
    const float s[16] = {(float)u[0]};
    const float t[16] = {(float)u[1]};
    float out[5][16];
    const wo_table_rays rays = {out[0], out[1], out[2], out[3], out[4], NULL};
    wo_lens_table_node(table, line, h, &node);
    wo_table_eval_base(table, &node, s, t, 1, &rays);
    *ray = (wo_model_ray){.a = {(double)out[0][0], (double)out[1][0]},
                          .b = {(double)out[2][0], (double)out[3][0]},
                          .weight = (double)out[4][0]};
    static const wo_lens_model open = {.clips = 0};
    return h <= table->field && wo_lens_ray_counts(&open, request, ray);
}

static double unit(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) * 0x1p-24;
}

/* One random ray of the field, the wavelengths and the iris. */
typedef struct trial {
    bool counts;
    int line;
    double h, u[2];
    wo_model_ray ray;
} trial;

typedef struct trial_job {
    const wo_lens_model *model;
    const wo_lens_request *request;
    const wo_lens_table *table;
    double field;
    trial *trials;
    double *error_px;  /* [VALIDATIONS]; NAN: a ray that neither lets through */
    double *lit_error; /* [WO_LIT_FIELDS] */
} trial_job;

static void make_trial(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const trial_job *job = user;
    trial *t = &job->trials[index];
    uint32_t state = 0x9e3779b9u * (uint32_t)(index + 1);
    for (int k = 0; k < 4; k++)
        unit(&state);
    t->line = (int)(unit(&state) * job->request->lines);
    t->h = job->field * sqrt(unit(&state));
    const double r = sqrt(unit(&state));
    const double angle = 2 * PI * unit(&state);
    t->u[0] = r * cos(angle);
    t->u[1] = r * sin(angle);
    (void)wo_lens_model_ray(job->model, t->h, t->u, job->request->nm[t->line], &t->ray);
    t->counts = wo_lens_ray_counts(job->model, job->request, &t->ray);
}

/* How far in the iris it is from a trial to where the model's answer changes: the table's edge is
   off by so much. The nearest of some directions. */
static double off_edge(const trial_job *job, const trial *t)
{
    enum { DIRECTIONS = 8, STEPS = 12 };
    double u[DIRECTIONS][2];
    wo_model_ray ray[DIRECTIONS];
    double far = 1.0 / 512;
    for (int k = 0; k < STEPS; k++, far *= 2) {
        for (int i = 0; i < DIRECTIONS; i++) {
            u[i][0] = t->u[0] + far * cos(2 * PI * i / DIRECTIONS);
            u[i][1] = t->u[1] + far * sin(2 * PI * i / DIRECTIONS);
        }
        wo_lens_model_rays(job->model, t->h, &job->request->nm[t->line], 1, (const double(*)[2])u,
                           DIRECTIONS, ray);
        for (int i = 0; i < DIRECTIONS; i++)
            if (wo_lens_ray_counts(job->model, job->request, &ray[i]) != t->counts ||
                hypot(u[i][0], u[i][1]) > 1)
                return far;
    }
    return far;
}

static void measure_trial(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const trial_job *job = user;
    const wo_lens_request *r = job->request;
    const trial *t = &job->trials[index];
    wo_model_ray own;
    const bool counts = table_ray(job->table, r, t->line, t->h, t->u, &own);
    double *const error = &job->error_px[index];
    *error = NAN;
    if (counts != t->counts) {
        const double *const b = counts ? own.b : t->ray.b;
        const double radius = fmax(hypot(t->u[0], t->u[1]), 0.25);
        *error = r->focal_px * r->blur_dioptres * hypot(b[0], b[1]) / radius * off_edge(job, t);
        return;
    }
    for (int side = 0; counts && side < 2; side++) {
        const double dv = side * r->blur_dioptres;
        const double ex = own.a[0] - t->ray.a[0] + dv * (own.b[0] - t->ray.b[0]);
        const double ey = own.a[1] - t->ray.a[1] + dv * (own.b[1] - t->ray.b[1]);
        *error = fmax(side ? *error : 0, r->focal_px * hypot(ex, ey));
    }
}

static void measure(const wo_context *context, const trial_job *job, wo_lens_table *table)
{
    wo_run(context, measure_trial, (void *)job, VALIDATIONS);
    double sum = 0;
    int count = 0;
    table->worst_px = 0;
    for (int i = 0; i < VALIDATIONS; i++) {
        const double e = job->error_px[i];
        if (!(e >= 0))
            continue;
        sum += e * e;
        table->worst_px = fmax(table->worst_px, e);
        count++;
    }
    table->rms_px = count > 0 ? sqrt(sum / count) : INFINITY;
}

/* Lit parts of the iris at fields of the whole picture, by the table and by the model. */
static void measure_lit(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const trial_job *job = user;
    const wo_lens_request *r = job->request;
    const int line = r->lines / 2;
    const double h = job->model->field_max * (double)index / (WO_LIT_FIELDS - 1);
    double u[LIT_POINTS][2];
    wo_model_ray ray[LIT_POINTS];
    for (int i = 0; i < LIT_POINTS; i++) {
        const double radius = sqrt((i + 0.5) / LIT_POINTS);
        u[i][0] = radius * cos(2.399963229728653 * i + 1);
        u[i][1] = radius * sin(2.399963229728653 * i + 1);
    }
    wo_lens_model_rays(job->model, h, &r->nm[line], 1, (const double(*)[2])u, LIT_POINTS, ray);
    int more = 0;
    for (int i = 0; i < LIT_POINTS; i++) {
        wo_model_ray own;
        more += table_ray(job->table, r, line, h, u[i], &own);
        more -= wo_lens_ray_counts(job->model, r, &ray[i]);
    }
    job->lit_error[index] = fabs((double)more) / LIT_POINTS;
}

/* The lowest degree that will do with so many field points, or the highest. */
static void choose_degree(const wo_context *context, const wo_lens_fit *fit, const trial_job *job,
                          double target_px, wo_lens_table *table)
{
    int degree = DEGREE_FIRST;
    while (degree < WO_TABLE_DEGREE_MAX && wo_lens_fit_residual(fit, degree) > target_px)
        degree += 2;
    for (; degree <= WO_TABLE_DEGREE_MAX && !wo_aborted(context); degree += 2) {
        table->degree = degree;
        wo_lens_fit_solve(context, fit, degree, table->node);
        measure(context, job, table);
        if (table->rms_px <= target_px)
            return;
    }
}

static wo_status fit_table(const wo_context *context, const wo_lens_lit *lit, double target_px,
                           trial_job *job, wo_lens_table *table, wo_error *error)
{
    wo_lens_fit *fit;
    WO_TRY(wo_lens_fit_create(context, job->model, job->request, &fit, error));
    wo_status status = WO_OK;
    table->field = wo_lens_fit_field(fit, lit->field);
    if (!(table->field > 0))
        status =
            wo_fail(error, WO_ERR_UNSUPPORTED, "the lens lets too few rays through for a table");
    for (table->nodes = NODES_FIRST; status == WO_OK; table->nodes = 2 * table->nodes - 1) {
        status = wo_lens_fit_nodes(context, fit, table->field, table->nodes, error);
        if (status != WO_OK)
            break;
        table->edge = wo_lens_fit_edge(fit);
        wo_delete(context, table->node);
        table->node = wo_new(context, error, (size_t)table->lines * (size_t)table->nodes,
                             sizeof *table->node);
        if (!table->node) {
            status = WO_ERR_NOMEM;
            break;
        }
        choose_degree(context, fit, job, target_px, table);
        if (wo_aborted(context))
            status = WO_ABORTED;
        else if (table->rms_px <= target_px || table->nodes >= WO_FIT_NODES_MAX)
            break;
    }
    wo_lens_fit_destroy(context, &fit);
    return status;
}

wo_status wo_lens_table_create(const wo_context *context, const wo_lens_model *model,
                               const wo_lens_request *request, const wo_lens_lit *lit,
                               double target_px, wo_lens_table **table, wo_error *error)
{
    *table = NULL;
    if (request->lines < 1 || request->lines > WO_LINES_MAX)
        return wo_fail(error, WO_ERR_RANGE, "%d wavelengths: must be 1..%d", request->lines,
                       WO_LINES_MAX);
    wo_lens_table *t = wo_new(context, error, 1, sizeof *t);
    trial *trials = wo_new(context, error, VALIDATIONS, sizeof *trials);
    double *errors = wo_new(context, error, VALIDATIONS, sizeof *errors);
    double lit_error[WO_LIT_FIELDS];
    wo_status status = t && trials && errors ? WO_OK : WO_ERR_NOMEM;
    if (status == WO_OK) {
        t->lines = request->lines;
        t->clips = model->clips;
        memcpy(t->nm, request->nm, (size_t)request->lines * sizeof *request->nm);
        trial_job job = {.model = model,
                         .request = request,
                         .table = t,
                         .field = lit->field,
                         .trials = trials,
                         .error_px = errors,
                         .lit_error = lit_error};
        wo_run(context, make_trial, &job, VALIDATIONS);
        status = fit_table(context, lit, target_px, &job, t, error);
        if (status == WO_OK)
            wo_run(context, measure_lit, &job, WO_LIT_FIELDS);
        for (int i = 0; status == WO_OK && i < WO_LIT_FIELDS; i++)
            t->lit_error = fmax(t->lit_error, lit_error[i]);
    }
    wo_delete(context, trials);
    wo_delete(context, errors);
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
