/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/lens_fit.h"

#include "optics/least_squares.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

enum {
    SAMPLES = 320, /* rays of a field point and wavelength, in half the iris */
    ROWS_MIN = 20,
    SPOKES = 48,     /* on which the edge is looked for, in half the iris */
    EDGE_RINGS = 12, /* and fitted */
    HALVINGS = 8
};

/* Rays beyond the clear radii are fitted, too, so that what is open is not the fit's edge and the
   next field point's open part is known here: those a little beyond in full. */
#define BEYOND_CLIP      1.2
#define WEIGHT_CLIP      0.1
#define BEYOND_REACH     1.3 /* of max_px */
#define BEYOND_IRIS      1.25
#define WEIGHT_UNBOUNDED 0.3 /* of spokes that end at that, not at an edge */

/* Sides of the equations: what is even in t, what is odd. */
enum { EVEN_SIDES = 3, ODD_SIDES = 2 };

/* The factorised equations of a field point: R and Q^T b, without the rows that are 0. */
typedef struct point_fit {
    double even[WO_TABLE_EVEN_MAX * WO_TABLE_EVEN_MAX];
    double even_b[WO_TABLE_EVEN_MAX * WO_LINES_MAX * EVEN_SIDES];
    double odd[WO_TABLE_ODD_MAX * WO_TABLE_ODD_MAX];
    double odd_b[WO_TABLE_ODD_MAX * WO_LINES_MAX * ODD_SIDES];
    double residual[WO_TABLE_DEGREE_MAX + 1]; /* px */
    float clip[WO_LINES_MAX][WO_MODEL_CLIPS][WO_TABLE_CLIP_TERMS];
    float edge[WO_TABLE_EDGE_TERMS];
    int degree; /* the highest that there are rays for */
    bool good, dead;
} point_fit;

/* Of one worker. */
typedef struct work {
    wo_model_ray ray[WO_LINES_MAX * SAMPLES];
    double a[SAMPLES * WO_TABLE_EVEN_MAX];
    double b[SAMPLES * WO_LINES_MAX * WO_MODEL_CLIPS];
    double a_edge[SPOKES * EDGE_RINGS * WO_TABLE_EDGE_TERMS];
    double b_edge[SPOKES * EDGE_RINGS];
    double x[WO_TABLE_EVEN_MAX * WO_LINES_MAX * WO_MODEL_CLIPS];
    int row[SAMPLES];
} work;

struct wo_lens_fit {
    const wo_lens_model *model;
    wo_lens_request request;
    double u[SAMPLES][2];
    int nodes, first, step; /* the points made by the running call: first, first + step .. */
    double field;
    point_fit *point[WO_FIT_NODES_MAX];
    work *works; /* [workers] */
};

/* Number of terms s^i t^j, i + j <= degree, j = 0, 2, 4.. */
static int even_terms(int degree)
{
    int n = 0;
    for (int j = 0; j <= degree; j += 2)
        n += degree - j + 1;
    return n;
}

/* The terms by rising degree, so that those of a lower degree come first. */
static void terms_at(int degree, double s, double t2, double scale, double *row)
{
    int n = 0;
    double power_s[WO_TABLE_DEGREE_MAX + 1] = {1};
    double power_t[WO_TABLE_DEGREE_MAX + 1] = {1};
    for (int i = 1; i <= degree; i++) {
        power_s[i] = power_s[i - 1] * s;
        power_t[i] = power_t[i - 1] * t2;
    }
    for (int d = 0; d <= degree; d++)
        for (int j = 0; j <= d; j += 2)
            row[n++] = scale * power_s[d - j] * power_t[j / 2];
}

/* Coefficients of one side into rows of equal j, for a table of at least this degree. */
static void spread(const double *x, int sides, int side, int degree, int to_degree, float *out)
{
    int begin[WO_TABLE_DEGREE_MAX + 2] = {0};
    for (int j = 0; j <= to_degree; j += 2)
        begin[j + 2] = begin[j] + to_degree - j + 1;
    int n = 0;
    for (int d = 0; d <= degree; d++)
        for (int j = 0; j <= d; j += 2)
            out[begin[j] + d - j] = (float)x[(n++) * sides + side];
}

/* Is there a ray, and does it not go much too far? */
static bool exists(const wo_lens_fit *fit, const wo_model_ray *ray)
{
    const wo_lens_request *const r = &fit->request;
    return ray->weight > 0 && wo_lens_ray_reach(r, ray) <= BEYOND_REACH * r->max_px;
}

static void fit_clips(const wo_lens_fit *fit, int rows, work *w, point_fit *p)
{
    const int clips = fit->model->clips;
    const int lines = fit->request.lines;
    const int sides = lines * clips;
    int degree = WO_TABLE_CLIP_DEGREE;
    while (degree > 2 && 3 * even_terms(degree) > 2 * rows)
        degree -= 2;
    const int columns = even_terms(degree);
    for (int r = 0; r < rows; r++) {
        const int i = w->row[r];
        terms_at(degree, fit->u[i][0], fit->u[i][1] * fit->u[i][1], 1, w->a + r * columns);
        for (int k = 0; k < sides; k++)
            w->b[r * sides + k] = w->ray[k / clips * SAMPLES + i].clip[k % clips];
    }
    wo_qr_factor(w->a, rows, columns, w->b, sides);
    wo_qr_solve(w->a, columns, columns, w->b, sides, w->x);
    for (int k = 0; k < sides; k++)
        spread(w->x, sides, k, degree, WO_TABLE_CLIP_DEGREE, p->clip[k / clips][k % clips]);
}

/* What the rows after the first n hold that a degree leaves over: per ray, px. */
static double left_over(const wo_lens_fit *fit, const double *b, int rows, int n, int sides,
                        double weights, int line)
{
    const double v = fit->request.blur_dioptres;
    double sum = 0;
    for (int r = n; r < rows; r++) {
        const double a = b[r * sides + line];
        const double tilt = b[r * sides + fit->request.lines + line];
        sum += fmax(a * a, (fabs(a) + v * fabs(tilt)) * (fabs(a) + v * fabs(tilt)));
    }
    return fit->request.focal_px * sqrt(sum / weights);
}

/* Columns of b: a of all lines, b of all lines, then weights. Returns columns of a. */
static int make_rows(const wo_lens_fit *fit, work *w, int rows, int degree, bool odd,
                     double *weights)
{
    const wo_lens_model *model = fit->model;
    const int lines = fit->request.lines;
    const int columns = even_terms(odd ? degree - 1 : degree);
    const int sides = lines * (odd ? ODD_SIDES : EVEN_SIDES);
    *weights = 0;
    for (int r = 0; r < rows; r++) {
        const int i = w->row[r];
        double clip = 0;
        for (int line = 0; line < lines; line++)
            clip = fmax(clip, wo_model_ray_clip(model, &w->ray[line * SAMPLES + i]));
        const double weight = clip < BEYOND_CLIP ? 1 : WEIGHT_CLIP;
        const double t = fit->u[i][1];
        *weights += weight * weight;
        terms_at(odd ? degree - 1 : degree, fit->u[i][0], t * t, weight * (odd ? t : 1),
                 w->a + r * columns);
        double *b = w->b + r * sides;
        for (int line = 0; line < lines; line++) {
            const wo_model_ray *ray = &w->ray[line * SAMPLES + i];
            b[line] = weight * ray->a[odd];
            b[lines + line] = weight * ray->b[odd];
            if (!odd)
                b[2 * lines + line] = weight * ray->weight;
        }
    }
    return columns;
}

static void fit_rays(const wo_lens_fit *fit, work *w, int rows, point_fit *p)
{
    const int lines = fit->request.lines;
    double residual2[WO_TABLE_DEGREE_MAX + 1][WO_LINES_MAX] = {{0}};
    double weights;
    p->degree = WO_TABLE_DEGREE_MAX;
    while (p->degree > 1 && 4 * even_terms(p->degree) > 3 * rows)
        p->degree--;
    for (int odd = 0; odd < 2; odd++) {
        const int columns = make_rows(fit, w, rows, p->degree, odd, &weights);
        const int sides = lines * (odd ? ODD_SIDES : EVEN_SIDES);
        wo_qr_factor(w->a, rows, columns, w->b, sides);
        memcpy(odd ? p->odd : p->even, w->a, (size_t)(columns * columns) * sizeof(double));
        memcpy(odd ? p->odd_b : p->even_b, w->b, (size_t)(columns * sides) * sizeof(double));
        for (int d = 1; d <= WO_TABLE_DEGREE_MAX; d++)
            for (int line = 0; line < lines; line++) {
                const int of = d < p->degree ? d : p->degree;
                const double r =
                    left_over(fit, w->b, rows, even_terms(odd ? of - 1 : of), sides, weights, line);
                residual2[d][line] += r * r;
            }
    }
    for (int d = 1; d <= WO_TABLE_DEGREE_MAX; d++) {
        p->residual[d] = 0;
        for (int line = 0; line < lines; line++)
            p->residual[d] = fmax(p->residual[d], sqrt(residual2[d][line]));
    }
}

/* Radii up to which there are rays, spoke by spoke; at most BEYOND_IRIS. */
static void find_edge(const wo_lens_fit *fit, double h, double radius[SPOKES])
{
    double low[SPOKES] = {0};
    double high[SPOKES];
    double u[SPOKES][2];
    wo_model_ray ray[SPOKES];
    for (int i = 0; i < SPOKES; i++)
        high[i] = BEYOND_IRIS;
    for (int k = 0; k <= HALVINGS; k++) {
        for (int i = 0; i < SPOKES; i++) {
            const double angle = PI * (i + 0.5) / SPOKES;
            const double r = k == 0 ? BEYOND_IRIS : 0.5 * (low[i] + high[i]);
            u[i][0] = r * cos(angle);
            u[i][1] = r * sin(angle);
        }
        wo_lens_model_rays(fit->model, h, &fit->model->reference_nm, 1, (const double(*)[2])u,
                           SPOKES, ray);
        for (int i = 0; i < SPOKES; i++) {
            const double r = hypot(u[i][0], u[i][1]);
            if (exists(fit, &ray[i]))
                low[i] = r;
            else
                high[i] = r;
        }
    }
    for (int i = 0; i < SPOKES; i++)
        radius[i] = low[i];
}

/* (r / radius)^2 as a polynomial, best near the edge. */
static void fit_edge(const wo_lens_fit *fit, double h, work *w, point_fit *p)
{
    static const double rings[EDGE_RINGS] = {0.15, 0.4, 0.6,  0.75, 0.85, 0.92,
                                             0.97, 1,   1.03, 1.08, 1.15, 1.25};
    double radius[SPOKES];
    find_edge(fit, h, radius);
    int rows = 0;
    for (int i = 0; i < SPOKES; i++) {
        const double angle = PI * (i + 0.5) / SPOKES;
        const bool unbounded = radius[i] >= BEYOND_IRIS;
        for (int k = 0; k < EDGE_RINGS; k++) {
            const double r = rings[k] * radius[i];
            if (r > BEYOND_IRIS)
                continue;
            const double near = exp(-100 * (rings[k] - 1) * (rings[k] - 1));
            const double weight = unbounded ? WEIGHT_UNBOUNDED : WEIGHT_CLIP + near;
            const double s = r * cos(angle);
            const double t = r * sin(angle);
            terms_at(WO_TABLE_EDGE_DEGREE, s, t * t, weight,
                     w->a_edge + rows * WO_TABLE_EDGE_TERMS);
            w->b_edge[rows++] = weight * rings[k] * rings[k];
        }
    }
    wo_qr_factor(w->a_edge, rows, WO_TABLE_EDGE_TERMS, w->b_edge, 1);
    wo_qr_solve(w->a_edge, WO_TABLE_EDGE_TERMS, WO_TABLE_EDGE_TERMS, w->b_edge, 1, w->x);
    spread(w->x, 1, 0, WO_TABLE_EDGE_DEGREE, WO_TABLE_EDGE_DEGREE, p->edge);
}

static double field_of(const wo_lens_fit *fit, int node)
{
    return fit->field * node / (fit->nodes - 1);
}

/* Traces the samples of a field point and lists those with rays in every wavelength. */
static int take_samples(const wo_lens_fit *fit, double h, work *w)
{
    const int lines = fit->request.lines;
    wo_lens_model_rays(fit->model, h, fit->request.nm, lines, (const double(*)[2])fit->u, SAMPLES,
                       w->ray);
    int rows = 0;
    for (int i = 0; i < SAMPLES; i++) {
        bool all = true;
        for (int line = 0; line < lines; line++)
            all &= exists(fit, &w->ray[line * SAMPLES + i]);
        w->row[rows] = i;
        rows += all;
    }
    return rows;
}

/* Does a sample without a ray lie where the clips of a wavelength let light through? */
static bool needs_edge(const wo_lens_fit *fit, const work *w, int rows, const point_fit *p)
{
    double term[WO_TABLE_CLIP_TERMS];
    float order[WO_TABLE_CLIP_TERMS];
    double index[WO_TABLE_CLIP_TERMS];
    for (int k = 0; k < WO_TABLE_CLIP_TERMS; k++)
        index[k] = k;
    spread(index, 1, 0, WO_TABLE_CLIP_DEGREE, WO_TABLE_CLIP_DEGREE, order);
    int next = 0;
    for (int i = 0; i < SAMPLES; i++) {
        if (next < rows && w->row[next] == i) {
            next++;
            continue;
        }
        terms_at(WO_TABLE_CLIP_DEGREE, fit->u[i][0], fit->u[i][1] * fit->u[i][1], 1, term);
        for (int line = 0; line < fit->request.lines; line++) {
            double most = 0;
            for (int c = 0; c < fit->model->clips; c++) {
                double clip = 0;
                for (int k = 0; k < WO_TABLE_CLIP_TERMS; k++)
                    clip += (double)p->clip[line][c][k] * term[(int)order[k]];
                most = fmax(most, clip);
            }
            if (most < BEYOND_CLIP)
                return true;
        }
    }
    return false;
}

static void make_point(void *user, size_t index, unsigned worker)
{
    const wo_lens_fit *fit = user;
    work *w = &fit->works[worker];
    const int node = fit->first + fit->step * (int)index;
    point_fit *p = fit->point[node];
    const int rows = take_samples(fit, field_of(fit, node), w);
    p->good = rows >= ROWS_MIN;
    if (!p->good)
        return;
    if (fit->model->clips > 0)
        fit_clips(fit, rows, w, p);
    p->dead = needs_edge(fit, w, rows, p);
    fit_rays(fit, w, rows, p);
}

static void make_edge(void *user, size_t index, unsigned worker)
{
    const wo_lens_fit *fit = user;
    point_fit *p = fit->point[index];
    if (p->edge[0] == 0 && p->good)
        fit_edge(fit, field_of(fit, (int)index), &fit->works[worker], p);
}

wo_status wo_lens_fit_create(const wo_context *context, const wo_lens_model *model,
                             const wo_lens_request *request, wo_lens_fit **fit, wo_error *error)
{
    *fit = NULL;
    wo_lens_fit *f = wo_new(context, error, 1, sizeof *f);
    if (!f)
        return WO_ERR_NOMEM;
    f->model = model;
    f->request = *request;
    for (int i = 0; i < SAMPLES; i++) {
        const double r = i % 8 == 0 ? 1 : sqrt((i + 0.5) / SAMPLES);
        const double angle = PI * fmod(i * 0.6180339887498949, 1);
        f->u[i][0] = r * cos(angle);
        f->u[i][1] = r * sin(angle);
    }
    f->works = wo_new(context, error, wo_workers(context), sizeof *f->works);
    if (!f->works) {
        wo_lens_fit_destroy(context, &f);
        return WO_ERR_NOMEM;
    }
    *fit = f;
    return WO_OK;
}

void wo_lens_fit_destroy(const wo_context *context, wo_lens_fit **fit)
{
    if (*fit) {
        for (int i = 0; i < WO_FIT_NODES_MAX; i++)
            wo_delete(context, (*fit)->point[i]);
        wo_delete(context, (*fit)->works);
    }
    wo_delete(context, *fit);
    *fit = NULL;
}

wo_status wo_lens_fit_nodes(const wo_context *context, wo_lens_fit *fit, double field, int nodes,
                            wo_error *error)
{
    const bool doubled = fit->nodes > 0 && nodes == 2 * fit->nodes - 1;
    for (int i = fit->nodes - 1; doubled && i > 0; i--) {
        fit->point[2 * i] = fit->point[i];
        fit->point[i] = NULL;
    }
    fit->nodes = nodes;
    fit->field = field;
    fit->first = doubled;
    fit->step = doubled ? 2 : 1;
    for (int i = fit->first; i < nodes; i += fit->step) {
        wo_delete(context, fit->point[i]);
        if (!(fit->point[i] = wo_new(context, error, 1, sizeof *fit->point[i])))
            return WO_ERR_NOMEM;
    }
    wo_run(context, make_point, fit, (size_t)((nodes - fit->first + fit->step - 1) / fit->step));
    if (wo_lens_fit_edge(fit))
        wo_run(context, make_edge, fit, (size_t)nodes);
    return WO_OK;
}

double wo_lens_fit_field(const wo_lens_fit *fit, double field)
{
    if (take_samples(fit, field, fit->works) >= ROWS_MIN)
        return field;
    double low = 0;
    double high = field;
    for (int i = 0; i < HALVINGS; i++) {
        const double h = 0.5 * (low + high);
        *(take_samples(fit, h, fit->works) >= ROWS_MIN ? &low : &high) = h;
    }
    return low;
}

bool wo_lens_fit_edge(const wo_lens_fit *fit)
{
    bool dead = false;
    for (int i = 0; i < fit->nodes; i++)
        dead |= fit->point[i]->dead;
    return dead;
}

double wo_lens_fit_residual(const wo_lens_fit *fit, int degree)
{
    double most = 0;
    for (int i = 0; i < fit->nodes; i++)
        if (fit->point[i]->good)
            most = fmax(most, fit->point[i]->residual[degree]);
    return most;
}

typedef struct solve_job {
    const wo_lens_fit *fit;
    int degree;
    wo_table_node *node;
} solve_job;

static void solve_point(void *user, size_t index, unsigned worker)
{
    const solve_job *job = user;
    const wo_lens_fit *fit = job->fit;
    const point_fit *p = fit->point[index];
    double *x = fit->works[worker].x;
    const int lines = fit->request.lines;
    for (int line = 0; line < lines; line++)
        memset(&job->node[line * fit->nodes + (int)index], 0, sizeof *job->node);
    if (!p->good)
        return;
    const int d = job->degree < p->degree ? job->degree : p->degree;
    const int even = lines * EVEN_SIDES;
    const int odd = lines * ODD_SIDES;
    wo_qr_solve(p->even, even_terms(p->degree), even_terms(d), p->even_b, even, x);
    for (int line = 0; line < lines; line++) {
        wo_table_node *node = &job->node[line * fit->nodes + (int)index];
        spread(x, even, line, d, job->degree, node->ax);
        spread(x, even, lines + line, d, job->degree, node->bx);
        spread(x, even, 2 * lines + line, d, job->degree, node->weight);
        memcpy(node->clip, p->clip[line], sizeof node->clip);
        memcpy(node->edge, p->edge, sizeof node->edge);
    }
    wo_qr_solve(p->odd, even_terms(p->degree - 1), even_terms(d - 1), p->odd_b, odd, x);
    for (int line = 0; line < lines; line++) {
        wo_table_node *node = &job->node[line * fit->nodes + (int)index];
        spread(x, odd, line, d - 1, job->degree - 1, node->ay);
        spread(x, odd, lines + line, d - 1, job->degree - 1, node->by);
    }
}

void wo_lens_fit_solve(const wo_context *context, const wo_lens_fit *fit, int degree,
                       wo_table_node *node)
{
    solve_job job = {fit, degree, node};
    wo_run(context, solve_point, &job, (size_t)fit->nodes);
}
