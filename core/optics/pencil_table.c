/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/pencil_table.h"

#include "optics/sampling.h"

#include <math.h>
#include <string.h>

struct wo_table_pencils {
    wo_lens_table *table;
    bool borrowed; /* the table */
    wo_table_function *eval;
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

/* Rays of one wavelength. */
static void make_rays(const wo_table_pencils *p, int line, field_point at, const float *x,
                      const float *y, const float *light, int count, int to, wo_pencil_room *room)
{
    float along[WO_PENCIL_PIECE + WO_LANES];
    float across[WO_PENCIL_PIECE + WO_LANES];
    wo_table_node node;
    wo_lens_table_node(p->table, line, at.h, &node);
    const float cf = (float)at.c;
    const float sf = (float)at.s;
    for (int i = 0; i < count; i++) {
        along[i] = cf * x[i] + sf * y[i];
        across[i] = cf * y[i] - sf * x[i];
    }
    memset(along + count, 0, WO_LANES * sizeof *along);
    memset(across + count, 0, WO_LANES * sizeof *across);
    float *const ax = room->ax + to;
    float *const ay = room->ay + to;
    float *const bx = room->bx + to;
    float *const by = room->by + to;
    float *const weight = room->weight[0] + to;
    const wo_table_rays out = {ax, ay, bx, by, weight, NULL};
    p->eval(p->table, &node, along, across, count, &out);
    const float fx = (float)p->options.focal_px;
    const float fy = (float)(p->options.focal_px * p->options.stretch);
    const float reach = (float)p->options.max_reach;
    const float v_limit = (float)p->options.v_limit;
    const float r = (float)p->bands.weight[line][0];
    const float g = (float)p->bands.weight[line][1];
    const float b = (float)p->bands.weight[line][2];
    for (int i = 0; i < count; i++) {
        const float a1 = (cf * ax[i] - sf * ay[i]) * fx;
        const float a2 = (sf * ax[i] + cf * ay[i]) * fy;
        const float b1 = (cf * bx[i] - sf * by[i]) * fx;
        const float b2 = (sf * bx[i] + cf * by[i]) * fy;
        const bool near = sqrtf(a1 * a1 + a2 * a2) + v_limit * sqrtf(b1 * b1 + b2 * b2) <= reach;
        ax[i] = near ? a1 : 0;
        ay[i] = near ? a2 : 0;
        bx[i] = near ? b1 : 0;
        by[i] = near ? b2 : 0;
        const float w = near ? weight[i] * light[i] : 0;
        weight[i] = w * r;
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
    for (int run = 0; run < 2 * p->table->lines; run++) {
        const int from = p->begin[run] > first ? p->begin[run] : first;
        const int to = p->begin[run + 1] < first + count ? p->begin[run + 1] : first + count;
        if (from < to)
            make_rays(p, run % p->table->lines, at, points + from, points + p->stride + from,
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

static void iris_piece(const wo_table_pencils *p, const wo_table_node *node, field_point at,
                       const float *s, const float *t, int count, const wo_table_rays *out)
{
    float along[WO_PENCIL_PIECE + WO_LANES] = {0};
    float across[WO_PENCIL_PIECE + WO_LANES] = {0};
    const float cf = (float)at.c;
    const float sf = (float)at.s;
    for (int i = 0; i < count; i++) {
        along[i] = cf * s[i] + sf * t[i];
        across[i] = cf * t[i] - sf * s[i];
    }
    p->eval(p->table, node, along, across, count, out);
    const float fx = (float)p->options.focal_px;
    const float fy = (float)(p->options.focal_px * p->options.stretch);
    const float reach = (float)p->options.max_reach;
    const float v_limit = (float)p->options.v_limit;
    for (int i = 0; i < count; i++) {
        const float a1 = (cf * out->ax[i] - sf * out->ay[i]) * fx;
        const float a2 = (sf * out->ax[i] + cf * out->ay[i]) * fy;
        const float b1 = (cf * out->bx[i] - sf * out->by[i]) * fx;
        const float b2 = (sf * out->bx[i] + cf * out->by[i]) * fy;
        const float far = sqrtf(a1 * a1 + a2 * a2) + v_limit * sqrtf(b1 * b1 + b2 * b2);
        out->clip[i] = fmaxf(out->clip[i], far / reach);
        out->ax[i] = a1;
        out->ay[i] = a2;
        out->bx[i] = b1;
        out->by[i] = b2;
    }
}

static void table_iris_rays(const void *self, double x, double y, int line, const float *s,
                            const float *t, int count, const wo_iris_rays *out)
{
    const wo_table_pencils *p = self;
    const field_point at = field_at(p, x, y);
    wo_table_node node;
    wo_lens_table_node(p->table, line, at.h, &node);
    for (int i = 0; i < count; i += WO_PENCIL_PIECE) {
        const int n = count - i < WO_PENCIL_PIECE ? count - i : WO_PENCIL_PIECE;
        const wo_table_rays part = {out->ax + i, out->ay + i,     out->bx + i,
                                    out->by + i, out->weight + i, out->clip + i};
        iris_piece(p, &node, at, s + i, t + i, n, &part);
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
    return (int)(count * (line + 1) / p->table->lines - count * line / p->table->lines);
}

static void share_rays(wo_table_pencils *p)
{
    const int lines = p->table->lines;
    for (int run = 0; run < 2 * lines; run++) {
        const int n = rays_of(p, run % lines);
        p->begin[run + 1] = p->begin[run] + (run < lines ? n / 2 : n - n / 2);
    }
    p->half = p->begin[lines];
}

/* Iris points of all sets: for each wavelength a lattice of its own, moved against the others'. */
static void make_points(wo_table_pencils *p, const wo_aperture_shape *shape)
{
    const int lines = p->table->lines;
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

/* Longest a and b of rays that get through, over all nodes; the difference between wavelengths. */
static void survey(wo_table_pencils *p, wo_table_facts *facts)
{
    enum { POINTS = 64 };
    float s[POINTS];
    float t[POINTS];
    float out[WO_LINES_MAX][5][POINTS];
    for (int i = 0; i < POINTS; i++) {
        const double r = i < POINTS / 2 ? 1 : sqrt((i - POINTS / 2 + 0.5) / (POINTS / 2));
        s[i] = (float)(r * cos(2.399963 * i));
        t[i] = (float)(r * sin(2.399963 * i));
    }
    const wo_lens_table *table = p->table;
    const double f = p->options.focal_px * fmax(1, p->options.stretch);
    double a_max = 0;
    double b_max = 0;
    double parted = 0;
    int seen = 0;
    int beyond = 0;
    p->uniform = table->clips == 0;
    for (int node = 0; node < table->lit; node++) {
        for (int line = 0; line < table->lines; line++) {
            float(*o)[POINTS] = out[line];
            const wo_table_rays rays = {o[0], o[1], o[2], o[3], o[4], NULL};
            p->eval(table, &table->node[line * table->nodes + node], s, t, POINTS, &rays);
            for (int i = 0; i < POINTS; i++) {
                p->uniform &= fabsf(o[4][i] - 1) < 1e-5f;
                if (!(o[4][i] > 0))
                    continue;
                seen++;
                beyond += f * (hypot((double)o[0][i], (double)o[1][i]) +
                               p->options.v_limit * hypot((double)o[2][i], (double)o[3][i])) >
                          p->options.max_reach;
                a_max = fmax(a_max, f * hypot((double)o[0][i], (double)o[1][i]));
                b_max = fmax(b_max, f * hypot((double)o[2][i], (double)o[3][i]));
                double d[4];
                for (int k = 0; k < 4; k++)
                    d[k] = f * (double)(o[k][i] - out[0][k][i]);
                if (out[0][4][i] > 0)
                    parted =
                        fmax(parted, hypot(d[0], d[1]) + p->options.v_limit * hypot(d[2], d[3]));
            }
        }
    }
    facts->aberration_px = a_max;
    facts->colour_px = parted;
    facts->beyond = seen > 0 ? (double)beyond / seen : 0;
    /* Between nodes and points it may be a little more. */
    p->reach_a = 1.05 * a_max + 0.01;
    p->reach_b = 1.05 * b_max;
}

static wo_status make_table(const wo_context *context, const wo_lens_model *model,
                            const wo_table_pencil_options *o, int wavelengths, wo_table_pencils *p,
                            wo_table_facts *facts, wo_error *error)
{
    wo_bands_make(wavelengths, &p->bands);
    if (wavelengths == 1)
        p->bands.nm[0] = model->reference_nm;
    wo_lens_table_destroy(context, &p->table);
    WO_TRY(wo_lens_table_create(context, model, p->bands.nm, p->bands.count, o->focal_px,
                                o->v_limit, WO_TABLE_PX, &p->table, error));
    survey(p, facts);
    return WO_OK;
}

/* For the points of so many rays as the options say. */
static wo_status make_room(const wo_context *context, wo_table_pencils *p, wo_error *error)
{
    share_rays(p);
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
    int wavelengths = options->wavelengths < options->count ? options->wavelengths : options->count;
    wo_status status = make_table(context, model, options, wavelengths, p, facts, error);
    const double colour_px = facts->colour_px;
    if (status == WO_OK && wavelengths > 1 && colour_px <= WO_COLOUR_PX) {
        status = make_table(context, model, options, 1, p, facts, error);
        facts->colour_px = colour_px;
    }
    if (status == WO_OK) {
        p->uniform &= p->table->lines == 1;
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
    facts->ideal = p->uniform && p->table->lines == 1 && facts->aberration_px < WO_IDEAL_PX;
    p->uniform &= shape.even;
    make_points(p, &shape);
    status = wo_iris_grids_create(context, &shape, p->grids, error);
    if (status != WO_OK) {
        wo_table_pencils_destroy(context, &p);
        return status;
    }
    facts->wavelengths = p->table->lines;
    facts->degree = p->table->degree;
    facts->nodes = p->table->nodes;
    facts->rms_px = p->table->rms_px;
    facts->field_lit = p->table->field_lit;
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
    for (int line = 0; line < table->lines; line++) {
        const wo_table_node *first = &table->node[line * table->nodes];
        for (int i = 1; i < table->lit; i++)
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
                     .colours = pencils->table->lines > 1,
                     .pencil = table_pencil,
                     .reach = table_reach,
                     .px_per_dioptre = pencils->options.px_per_dioptre,
                     .iris = {.grids = pencils->grids,
                              .same = !pencils->has_doors && same_nodes(pencils->table),
                              .lines = pencils->table->lines,
                              .line_weight = pencils->bands.weight,
                              .rays = table_iris_rays}};
}
