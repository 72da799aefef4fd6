/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/pencil_table.h"

#include "optics/sampling.h"

#include <math.h>
#include <string.h>

struct wo_table_pencils {
    wo_lens_table *table;       /* NULL = rays are traced one by one */
    const wo_lens_model *model; /* borrowed */
    bool borrowed;              /* the table */
    wo_table_function *eval;
    int lines;
    wo_lens_lit lit;
    double field_lit; /* tangent, the edge of the image circle: what is farther out is as there */
    double field;     /* the same of pencils, whose rays are few */
    wo_table_pencil_options options;
    wo_bands bands;
    bool uniform; /* all weights are 1 */
    bool has_doors;
    unsigned sets;
    int half;
    int begin[2 * WO_LINES_MAX + 1]; /* first ray of each wavelength of the first half of the rays,
                                        then of the second */
    size_t stride;                   /* floats of one coordinate of a set */
    float *points;           /* [sets][3][stride]: iris points and their weights, wavelength by
                                wavelength */
    double reach_a, reach_b; /* px, px per dioptre */
    wo_iris_grid grids[WO_IRIS_GRIDS]; /* borrowed like the table */
};

/* Of how many rays of a pencil that get through it takes a field point to have pencils of its own:
   where the lit part of the iris is so small that fewer of them would, pencils are those nearer to
   the axis. */
enum { RAYS_LIT = 6 };
#define PART_MOST 0.5 /* but they are not taken from where more of the iris is lit */

/* Where a point (x, y) px is: tangent and direction from the axis. */
typedef struct field_point {
    double h, c, s;
} field_point;

static field_point field_at(const wo_table_pencils *p, double x, double y)
{
    const double dx = (x - p->options.centre_x) / p->options.focal_px;
    const double dy = (y - p->options.centre_y) / (p->options.focal_px * p->options.stretch);
    const double h = hypot(dx, dy);
    return (field_point){h, h > 0 ? dx / h : 1, h > 0 ? dy / h : 0};
}

/* Rays of the model itself, as wo_table_function gives those of a table. */
static void trace_rays(const wo_table_pencils *p, int line, double h, const float *s,
                       const float *t, int count, const wo_table_rays *out)
{
    static const float blocked = 4;
    double u[WO_PENCIL_PIECE][2];
    wo_model_ray ray[WO_PENCIL_PIECE];
    for (int i = 0; i < count; i++) {
        u[i][0] = (double)s[i];
        u[i][1] = (double)t[i];
    }
    wo_lens_model_rays(p->model, h, &p->bands.nm[line], 1, (const double(*)[2])u, count, ray);
    for (int i = 0; i < count; i++) {
        const double clip = wo_model_ray_clip(p->model, &ray[i]);
        out->ax[i] = (float)ray[i].a[0];
        out->ay[i] = (float)ray[i].a[1];
        out->bx[i] = (float)ray[i].b[0];
        out->by[i] = (float)ray[i].b[1];
        out->weight[i] = out->clip || clip <= 1 ? (float)ray[i].weight : 0;
        if (out->clip)
            out->clip[i] = fminf((float)clip, blocked);
    }
}

/* count <= WO_PENCIL_PIECE rays of a wavelength through places (s, t) of the iris, with the field
   point in the direction +x: tangents and metres. */
static void upright_rays(const wo_table_pencils *p, int line, double h, const float *s,
                         const float *t, int count, const wo_table_rays *out)
{
    if (!p->table) {
        trace_rays(p, line, h, s, t, count, out);
        return;
    }
    wo_table_node node;
    wo_lens_table_node(p->table, line, h, &node);
    p->eval(p->table, &node, s, t, count, out);
}

/* How far a ray goes, in parts of what is allowed: above 1 it must not be. */
static float far_of(const wo_table_pencils *p, float ax, float ay, float bx, float by)
{
    const float a = sqrtf(ax * ax + ay * ay);
    const float b = sqrtf(bx * bx + by * by);
    const float all = (a + (float)p->options.v_limit * b) / (float)p->options.max_reach;
    return fmaxf(all, fmaxf(a / (float)p->reach_a, b / (float)p->reach_b));
}

/* The same for the field point at: px, and clipped where they go too far. */
static void turned_rays(const wo_table_pencils *p, int line, field_point at, const float *s,
                        const float *t, int count, const wo_table_rays *out)
{
    float along[WO_PENCIL_PIECE + WO_LANES];
    float across[WO_PENCIL_PIECE + WO_LANES];
    const float cf = (float)at.c;
    const float sf = (float)at.s;
    for (int i = 0; i < count; i++) {
        along[i] = cf * s[i] + sf * t[i];
        across[i] = cf * t[i] - sf * s[i];
    }
    memset(along + count, 0, WO_LANES * sizeof *along);
    memset(across + count, 0, WO_LANES * sizeof *across);
    upright_rays(p, line, at.h, along, across, count, out);
    const float fx = (float)p->options.focal_px;
    const float fy = (float)(p->options.focal_px * p->options.stretch);
    for (int i = 0; i < count; i++) {
        const float a1 = (cf * out->ax[i] - sf * out->ay[i]) * fx;
        const float a2 = (sf * out->ax[i] + cf * out->ay[i]) * fy;
        const float b1 = (cf * out->bx[i] - sf * out->by[i]) * fx;
        const float b2 = (sf * out->bx[i] + cf * out->by[i]) * fy;
        const float far = far_of(p, a1, a2, b1, b2);
        const bool near = far <= 1;
        if (out->clip)
            out->clip[i] = fmaxf(out->clip[i], far);
        else
            out->weight[i] = near ? out->weight[i] : 0;
        const bool keep = near || out->clip;
        out->ax[i] = keep ? a1 : 0;
        out->ay[i] = keep ? a2 : 0;
        out->bx[i] = keep ? b1 : 0;
        out->by[i] = keep ? b2 : 0;
    }
}

/* Rays of one wavelength for a pencil. */
static void make_rays(const wo_table_pencils *p, int line, field_point at, const float *x,
                      const float *y, const float *light, int count, int to, wo_pencil_room *room)
{
    const wo_table_rays out = {room->ax + to, room->ay + to,        room->bx + to,
                               room->by + to, room->weight[0] + to, NULL};
    at.h = fmin(at.h, p->field);
    turned_rays(p, line, at, x, y, count, &out);
    const float r = (float)p->bands.weight[line][0];
    const float g = (float)p->bands.weight[line][1];
    const float b = (float)p->bands.weight[line][2];
    for (int i = 0; i < count; i++) {
        const float w = out.weight[i] * light[i];
        out.weight[i] = w * r;
        room->weight[1][to + i] = w * g;
        room->weight[2][to + i] = w * b;
    }
}

/* Takes the rays that barn doors stop. */
static void close_doors(const wo_table_pencils *p, double x, double y, const float *points,
                        int count, wo_pencil_room *room)
{
    const double fx = (x - p->options.centre_x) / p->options.half_diagonal;
    const double fy = (y - p->options.centre_y) / (p->options.half_diagonal * p->options.stretch);
    for (int i = 0; i < count; i++)
        if (!wo_barn_doors_pass(&p->options.doors, fx, fy, (double)points[i],
                                (double)points[p->stride + (size_t)i]))
            for (int k = 0; k < 3; k++)
                room->weight[k][i] = 0;
}

static void table_pencil(const void *self, double x, double y, unsigned set, int first,
                         wo_pencil_room *room, wo_pencil *out)
{
    const wo_table_pencils *p = self;
    const field_point at = field_at(p, x, y);
    const float *points = p->points + 3 * p->stride * set;
    const int left = p->options.count - first;
    const int count = left < WO_PENCIL_PIECE ? left : WO_PENCIL_PIECE;
    for (int run = 0; run < 2 * p->lines; run++) {
        const int from = p->begin[run] > first ? p->begin[run] : first;
        const int to = p->begin[run + 1] < first + count ? p->begin[run + 1] : first + count;
        if (from < to)
            make_rays(p, run % p->lines, at, points + from, points + p->stride + from,
                      points + 2 * p->stride + from, to - from, from - first, room);
    }
    if (p->has_doors)
        close_doors(p, x, y, points + first, count, room);
    *out =
        (wo_pencil){.count = count, .ax = room->ax, .ay = room->ay, .bx = room->bx, .by = room->by};
    for (int k = 0; k < 3 && !p->uniform; k++)
        out->weight[k] = room->weight[k];
}

/* How far a ray is beyond the doors; up to 1 they let it pass. */
static float door_clip(const wo_barn_doors *doors, double fx, double fy, double ux, double uy)
{
    const double across = fmax(ux + doors->right * fmax(fx, 0), -ux + doors->left * fmax(-fx, 0));
    const double along = fmax(uy + doors->top * fmax(fy, 0), -uy + doors->bottom * fmax(-fy, 0));
    return (float)fmax(across, along);
}

static void table_iris_rays(const void *self, double x, double y, int line, const float *s,
                            const float *t, int count, const wo_iris_rays *out)
{
    const wo_table_pencils *p = self;
    field_point at = field_at(p, x, y);
    at.h = fmin(at.h, p->field);
    for (int i = 0; i < count; i += WO_PENCIL_PIECE) {
        const int n = count - i < WO_PENCIL_PIECE ? count - i : WO_PENCIL_PIECE;
        const wo_table_rays part = {out->ax + i, out->ay + i,     out->bx + i,
                                    out->by + i, out->weight + i, out->clip + i};
        turned_rays(p, line, at, s + i, t + i, n, &part);
    }
    const double fx = (x - p->options.centre_x) / p->options.half_diagonal;
    const double fy = (y - p->options.centre_y) / (p->options.half_diagonal * p->options.stretch);
    for (int i = 0; p->has_doors && i < count; i++)
        out->clip[i] =
            fmaxf(out->clip[i], door_clip(&p->options.doors, fx, fy, (double)s[i], (double)t[i]));
}

static double table_reach(const void *self, double v_far, double v_near)
{
    const wo_table_pencils *p = self;
    return fmin(p->reach_a + p->reach_b * fmax(fabs(v_far), fabs(v_near)), p->options.max_reach);
}

/* Rays of a wavelength, in both halves. */
static int rays_of(const wo_table_pencils *p, int line)
{
    const int64_t count = p->options.count;
    return (int)(count * (line + 1) / p->lines - count * line / p->lines);
}

static void share_rays(wo_table_pencils *p)
{
    const int lines = p->lines;
    for (int run = 0; run < 2 * lines; run++) {
        const int n = rays_of(p, run % lines);
        p->begin[run + 1] = p->begin[run] + (run < lines ? n / 2 : n - n / 2);
    }
    p->half = p->begin[lines];
}

/* Iris points of all sets: for each wavelength a lattice of its own, moved against the others'. */
static void make_points(wo_table_pencils *p, const wo_aperture_shape *shape)
{
    const int lines = p->lines;
    for (unsigned set = 0; set < p->sets; set++) {
        float *const x = p->points + 3 * p->stride * set;
        float *const y = x + p->stride;
        float *const light = y + p->stride;
        for (int line = 0; line < lines; line++) {
            const int n = rays_of(p, line);
            for (int i = 0; i < n; i++) {
                const int to = i < n / 2 ? p->begin[line] + i : p->begin[lines + line] + i - n / 2;
                double u[2];
                wo_lattice_point(p->options.seed, set,
                                 wo_lattice_order(i, n) + (line + 0.5) / lines, n, line, shape, u);
                x[to] = (float)u[0];
                y[to] = (float)u[1];
                light[to] = (float)(wo_aperture_weight(shape, u[0], u[1]) / shape->light);
            }
        }
    }
}

/* Longest a and b of rays that get through, over the field; are they all alike in weight? */
static void survey(wo_table_pencils *p, wo_table_facts *facts)
{
    enum { FIELDS = 17, POINTS = 256 };
    float s[POINTS];
    float t[POINTS];
    float out[5][POINTS];
    const wo_table_rays rays = {out[0], out[1], out[2], out[3], out[4], NULL};
    for (int i = 0; i < POINTS; i++) {
        double u[2];
        wo_iris_place(i, POINTS, u);
        s[i] = (float)u[0];
        t[i] = (float)u[1];
    }
    const wo_table_pencil_options *o = &p->options;
    const double f = o->focal_px * fmax(1, o->stretch);
    double a_max = 0;
    double b_max = 0;
    p->uniform = p->model->clips == 0 && !(p->table && p->table->edge);
    for (int k = 0; k < FIELDS; k++) {
        for (int line = 0; line < p->lines; line++) {
            upright_rays(p, line, p->field_lit * k / (FIELDS - 1), s, t, POINTS, &rays);
            for (int i = 0; i < POINTS; i++) {
                const double a = f * hypot((double)out[0][i], (double)out[1][i]);
                const double b = f * hypot((double)out[2][i], (double)out[3][i]);
                p->uniform &= fabsf(out[4][i] - 1) < 1e-5f;
                if (!(out[4][i] > 0) || a + b * o->v_limit > o->max_reach)
                    continue;
                a_max = fmax(a_max, a);
                b_max = fmax(b_max, b);
            }
        }
    }
    facts->aberration_px = a_max;
    /* Between these it may be a little more; what goes farther is cut. */
    p->reach_a = 1.05 * a_max + 0.01;
    p->reach_b = 1.05 * b_max + 1e-6;
}

/* How far rays move on the sensor from one field point to the next that has pencils of its own,
   WO_PENCIL_SERVES px on: RMS over the iris at the worst place. */
static double step_of(const wo_table_pencils *p)
{
    enum { FIELDS = 9, POINTS = 64 };
    float s[POINTS];
    float t[POINTS];
    float out[2][5][POINTS];
    const double f = p->options.focal_px;
    const double next = WO_PENCIL_SERVES / f;
    double most = 0;
    for (int i = 0; i < POINTS; i++) {
        double u[2];
        wo_iris_place(i, POINTS, u);
        s[i] = (float)u[0];
        t[i] = (float)u[1];
    }
    for (int k = 0; k < FIELDS; k++) {
        const double h = (p->field - next) * k / (FIELDS - 1);
        double sum = 0;
        int count = 0;
        for (int side = 0; side < 2 && h >= 0; side++) {
            float(*const o)[POINTS] = out[side];
            const wo_table_rays rays = {o[0], o[1], o[2], o[3], o[4], NULL};
            upright_rays(p, p->lines / 2, h + side * next, s, t, POINTS, &rays);
        }
        for (int i = 0; i < POINTS && h >= 0; i++) {
            const double dx = (double)(out[1][0][i] - out[0][0][i]);
            const double dy = (double)(out[1][1][i] - out[0][1][i]);
            const bool both = out[0][4][i] > 0 && out[1][4][i] > 0;
            sum += both ? dx * dx + dy * dy : 0;
            count += both;
        }
        most = fmax(most, count > 0 ? f * sqrt(sum / count) : 0);
    }
    return most;
}

static bool good_enough(const wo_table_facts *facts)
{
    return facts->rms_px <= WO_TABLE_MOST_PX && facts->lit_error <= WO_TABLE_MOST_LIT;
}

static wo_status make_table(const wo_context *context, const wo_lens_request *request,
                            wo_table_pencils *p, wo_table_facts *facts, wo_error *error)
{
    const wo_status status =
        wo_lens_table_create(context, p->model, request, &p->lit, WO_TABLE_PX, &p->table, error);
    if (status == WO_ERR_UNSUPPORTED) {
        facts->rms_px = INFINITY;
        return WO_OK;
    }
    if (status != WO_OK)
        return status;
    facts->degree = p->table->degree;
    facts->nodes = p->table->nodes;
    facts->rms_px = p->table->rms_px;
    facts->lit_error = p->table->lit_error;
    if (good_enough(facts))
        p->field_lit = p->table->field;
    else
        wo_lens_table_destroy(context, &p->table);
    return WO_OK;
}

/* Finds out about the lens, and how its rays are best made. */
static wo_status know_lens(const wo_context *context, int wavelengths, wo_table_pencils *p,
                           wo_table_facts *facts, wo_error *error)
{
    const wo_table_pencil_options *o = &p->options;
    wo_bands_make(wavelengths, &p->bands);
    wo_lens_request request = {.nm = p->bands.nm,
                               .lines = p->bands.count,
                               .focal_px = o->focal_px * fmax(1, o->stretch),
                               .blur_dioptres = o->v_limit,
                               .max_px = o->max_reach};
    WO_TRY(wo_lens_lit_measure(context, p->model, &request, &p->lit, error));
    p->field_lit = p->lit.field;
    wo_lens_survey(p->model, &request, p->lit.field, &facts->colour_px, &facts->beyond);
    if (wavelengths == 1 || facts->colour_px <= WO_COLOUR_PX) {
        wo_bands_make(1, &p->bands);
        p->bands.nm[0] = p->model->reference_nm;
        request.lines = 1;
    }
    p->lines = p->bands.count;
    if (!o->exact)
        WO_TRY(make_table(context, &request, p, facts, error));
    facts->exact = p->table == NULL;
    survey(p, facts);
    return WO_OK;
}

/* For the points of so many rays as the options say. */
static wo_status make_room(const wo_context *context, wo_table_pencils *p, wo_error *error)
{
    share_rays(p);
    p->field =
        fmin(wo_lens_lit_field(&p->lit, fmin((double)RAYS_LIT / p->options.count, PART_MOST)),
             p->field_lit);
    p->sets = wo_lattice_sets(p->options.count);
    p->stride = (size_t)p->options.count + WO_LANES;
    p->points = wo_new(context, error, 3 * p->stride * p->sets, sizeof *p->points);
    return p->points ? WO_OK : WO_ERR_NOMEM;
}

wo_status wo_table_pencils_again(const wo_context *context, const wo_table_pencils *first,
                                 const wo_aperture *aperture, int count, wo_table_pencils **pencils,
                                 wo_error *error)
{
    *pencils = NULL;
    if (count < 1)
        return wo_fail(error, WO_ERR_RANGE, "%d samples: at least 1 is needed", count);
    wo_table_pencils *p = wo_new(context, error, 1, sizeof *p);
    if (!p)
        return WO_ERR_NOMEM;
    *p = *first;
    p->borrowed = true;
    p->options.count = count;
    p->points = NULL;
    const wo_status status = make_room(context, p, error);
    if (status != WO_OK) {
        wo_table_pencils_destroy(context, &p);
        return status;
    }
    wo_aperture_shape shape;
    wo_aperture_make(aperture, &shape);
    make_points(p, &shape);
    *pencils = p;
    return WO_OK;
}

wo_status wo_table_pencils_create(const wo_context *context, const wo_lens_model *model,
                                  const wo_table_pencil_options *options,
                                  wo_table_pencils **pencils, wo_table_facts *facts,
                                  wo_error *error)
{
    *pencils = NULL;
    *facts = (wo_table_facts){0};
    WO_TRY(wo_aperture_validate(options->aperture, error));
    if (options->count < 1)
        return wo_fail(error, WO_ERR_RANGE, "%d samples: at least 1 is needed", options->count);
    wo_table_pencils *p = wo_new(context, error, 1, sizeof *p);
    if (!p)
        return WO_ERR_NOMEM;
    p->options = *options;
    p->options.aperture = NULL;
    p->eval = wo_table_choose(wo_cpu_detect(context->cpu));
    p->model = model;
    const int wavelengths =
        options->wavelengths < options->count ? options->wavelengths : options->count;
    wo_status status = know_lens(context, wavelengths, p, facts, error);
    if (status == WO_OK) {
        p->uniform &= p->lines == 1;
        status = make_room(context, p, error);
    }
    if (status != WO_OK) {
        wo_table_pencils_destroy(context, &p);
        return status;
    }
    wo_aperture_shape shape;
    wo_aperture_make(options->aperture, &shape);
    const wo_barn_doors *doors = &options->doors;
    p->has_doors = doors->left != 0 || doors->right != 0 || doors->bottom != 0 || doors->top != 0;
    p->uniform &= !p->has_doors;
    facts->ideal = p->uniform && p->lines == 1 && facts->aberration_px < WO_IDEAL_PX;
    p->uniform &= shape.even;
    make_points(p, &shape);
    status = wo_iris_grids_create(context, &shape, p->grids, error);
    if (status != WO_OK) {
        wo_table_pencils_destroy(context, &p);
        return status;
    }
    facts->wavelengths = p->lines;
    facts->step_px = step_of(p);
    facts->field_lit = p->field_lit;
    *pencils = p;
    return WO_OK;
}

void wo_table_pencils_destroy(const wo_context *context, wo_table_pencils **pencils)
{
    if (*pencils) {
        if (!(*pencils)->borrowed) {
            wo_lens_table_destroy(context, &(*pencils)->table);
            wo_iris_grids_destroy(context, (*pencils)->grids);
        }
        wo_delete(context, (*pencils)->points);
    }
    wo_delete(context, *pencils);
    *pencils = NULL;
}

/* Have all field points that get light the same rays? */
static bool same_nodes(const wo_lens_table *table)
{
    if (!table)
        return false;
    for (int line = 0; line < table->lines; line++) {
        const wo_table_node *first = &table->node[line * table->nodes];
        for (int i = 1; i < table->nodes; i++)
            if (memcmp(first, first + i, sizeof *first) != 0)
                return false;
    }
    return true;
}

wo_lens wo_table_pencils_lens(const wo_table_pencils *pencils)
{
    return (wo_lens){.self = pencils,
                     .sets = pencils->sets,
                     .count = pencils->options.count,
                     .half = pencils->half,
                     .colours = pencils->lines > 1,
                     .pencil = table_pencil,
                     .reach = table_reach,
                     .px_per_dioptre = pencils->options.px_per_dioptre,
                     .iris = {.grids = pencils->grids,
                              .same = !pencils->has_doors && same_nodes(pencils->table),
                              .lines = pencils->lines,
                              .line_weight = pencils->bands.weight,
                              .rays = table_iris_rays}};
}
