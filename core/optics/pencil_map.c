/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/lens_diagram.h"

#include <math.h>

static bool size_in_range(int distances, int radii, int lines)
{
    return distances >= 2 && distances <= WO_PENCIL_DISTANCES_MAX && radii >= 2 &&
           radii <= WO_PENCIL_RADII_MAX && lines >= 1 && lines <= WO_PENCIL_LINES_MAX;
}

static wo_status check_lines(const double *nm, int lines, wo_error *error)
{
    for (int l = 0; l < lines; l++)
        if (!(nm[l] >= WO_DIAGRAM_NM_MIN && nm[l] <= WO_DIAGRAM_NM_MAX) ||
            (l > 0 && !(nm[l] > nm[l - 1])))
            return wo_fail(error, WO_ERR_RANGE,
                           "wavelength %d of the pencil map is %g nm: must rise within %g..%g", l,
                           nm[l], WO_DIAGRAM_NM_MIN, WO_DIAGRAM_NM_MAX);
    return WO_OK;
}

static wo_status check_scale(double k, double v_low, double v_high, wo_error *error)
{
    if (!(k > 0 && k <= 1e12))
        return wo_fail(error, WO_ERR_RANGE, "pencil map of %g px per dioptre: must be above 0", k);
    if (!(v_low >= -WO_DIAGRAM_SHIFT_MAX && v_high <= WO_DIAGRAM_SHIFT_MAX && v_low < v_high))
        return wo_fail(error, WO_ERR_RANGE,
                       "pencil map from %g to %g dioptres: must rise within %g either side", v_low,
                       v_high, WO_DIAGRAM_SHIFT_MAX);
    return WO_OK;
}

wo_status wo_pencil_map_new(const wo_context *context, int distances, int radii, int lines,
                            wo_pencil_map **map, wo_error *error)
{
    *map = NULL;
    if (!size_in_range(distances, radii, lines))
        return wo_fail(
            error, WO_ERR_RANGE,
            "pencil map of %d distances, %d radii, %d wavelengths: must be 2..%d, 2..%d, "
            "1..%d",
            distances, radii, lines, WO_PENCIL_DISTANCES_MAX, WO_PENCIL_RADII_MAX,
            WO_PENCIL_LINES_MAX);
    const size_t rows = (size_t)lines * (size_t)distances;
    wo_pencil_map *made = wo_new(context, error, 1, sizeof *made);
    if (!made)
        return WO_ERR_NOMEM;
    made->distances = distances;
    made->radii = radii;
    made->lines = lines;
    made->nm = wo_new(context, error, (size_t)lines, sizeof *made->nm);
    if (made->nm)
        made->height = wo_new(context, error, rows, sizeof *made->height);
    if (made->height)
        made->density = wo_new(context, error, rows * (size_t)radii, sizeof *made->density);
    if (!made->density) {
        wo_pencil_map_destroy(context, &made);
        return WO_ERR_NOMEM;
    }
    *map = made;
    return WO_OK;
}

void wo_pencil_map_destroy(const wo_context *context, wo_pencil_map **map)
{
    if (!map || !*map)
        return;
    wo_delete(context, (*map)->nm);
    wo_delete(context, (*map)->height);
    wo_delete(context, (*map)->density);
    wo_delete(context, *map);
    *map = NULL;
}

typedef struct job {
    const wo_context *context;
    wo_pencil_map *map;
    int rings;
    double *shift;  /* [lines][rings + 1] */
    double *energy; /* [workers][radii] */
} job;

/* Energy spread evenly over the area between radii whose squares are a and b, 0..1. */
static void deposit(double *energy, int radii, double a, double b, double amount)
{
    if (a > b) {
        const double swap = a;
        a = b;
        b = swap;
    }
    const int first = (int)fmin(sqrt(a) * radii, radii - 1);
    const int last = (int)fmin(sqrt(b) * radii, radii - 1);
    double left = amount;
    double from = a;
    for (int j = first; j < last; j++) {
        const double edge = (j + 1.0) / radii;
        const double part = fmin(fmax(amount * (edge * edge - from) / (b - a), 0), left);
        energy[j] += part;
        left -= part;
        from = edge * edge;
    }
    energy[last] += left;
}

static double crossing(const job *j, const double *shift, int ring, double v)
{
    return (double)ring / j->rings * (v - shift[ring]);
}

static void fill_row(void *user, size_t index, unsigned worker)
{
    const job *const j = user;
    if (wo_aborted(j->context))
        return;
    const wo_pencil_map *const map = j->map;
    const size_t line = index / (size_t)map->distances;
    const double t = (double)(index % (size_t)map->distances) / (map->distances - 1);
    const double v = map->v_low + t * (map->v_high - map->v_low);
    const double *const shift = j->shift + line * ((size_t)j->rings + 1);
    double *const energy = j->energy + (size_t)worker * (size_t)map->radii;
    float *const density = map->density + index * (size_t)map->radii;
    double top = 0;
    for (int i = 0; i <= j->rings; i++)
        top = fmax(top, fabs(crossing(j, shift, i, v)));
    map->height[index] = map->k * top;
    if (!(top > 0)) {
        for (int i = 0; i < map->radii; i++)
            density[i] = 1;
        return;
    }
    for (int i = 0; i < map->radii; i++)
        energy[i] = 0;
    double r0 = 0;
    for (int i = 0; i < j->rings; i++) {
        const double r1 = crossing(j, shift, i + 1, v) / top;
        const double rho0 = (double)i / j->rings;
        const double rho1 = (i + 1.0) / j->rings;
        if ((r0 < 0 && r1 > 0) || (r0 > 0 && r1 < 0)) {
            const double zero = rho0 + (rho1 - rho0) * (r0 / (r0 - r1));
            deposit(energy, map->radii, 0, r0 * r0, (zero - rho0) * (zero + rho0));
            deposit(energy, map->radii, 0, r1 * r1, (rho1 - zero) * (rho1 + zero));
        } else
            deposit(energy, map->radii, r0 * r0, r1 * r1, (rho1 - rho0) * (rho1 + rho0));
        r0 = r1;
    }
    const double whole = (double)map->radii * map->radii;
    for (int i = 0; i < map->radii; i++)
        density[i] = (float)(energy[i] * whole / (2.0 * i + 1));
}

static wo_status fill(const wo_context *context, const wo_diagram *diagram, wo_pencil_map *map,
                      wo_error *error)
{
    job j = {.context = context, .map = map};
    /* Rings finer than the radii of the map and than the zones of the diagram. */
    j.rings = map->radii < 256 ? 2048 : 8 * map->radii;
    const size_t nodes = (size_t)j.rings + 1;
    j.shift = wo_new(context, error, (size_t)map->lines * nodes, sizeof *j.shift);
    if (j.shift)
        j.energy = wo_new(context, error, (size_t)wo_workers(context) * (size_t)map->radii,
                          sizeof *j.energy);
    if (j.energy) {
        for (int l = 0; l < map->lines; l++)
            for (int i = 0; i <= j.rings; i++)
                j.shift[(size_t)l * nodes + (size_t)i] =
                    wo_diagram_at(diagram, (double)i / j.rings, map->nm[l]);
        wo_run(context, fill_row, &j, (size_t)map->lines * (size_t)map->distances);
    }
    const bool filled = j.energy;
    wo_delete(context, j.shift);
    wo_delete(context, j.energy);
    if (!filled)
        return WO_ERR_NOMEM;
    return wo_aborted(context) ? wo_fail(error, WO_ABORTED, "aborted") : WO_OK;
}

wo_status wo_pencil_map_create(const wo_context *context, const wo_diagram *diagram, double k,
                               double v_low, double v_high, int distances, int radii,
                               const double *nm, int lines, wo_pencil_map **map, wo_error *error)
{
    *map = NULL;
    WO_TRY(wo_diagram_validate(diagram, error));
    WO_TRY(check_scale(k, v_low, v_high, error));
    wo_pencil_map *made = NULL;
    WO_TRY(wo_pencil_map_new(context, distances, radii, lines, &made, error));
    wo_status status = check_lines(nm, lines, error);
    if (status == WO_OK) {
        made->k = k;
        made->v_low = v_low;
        made->v_high = v_high;
        for (int l = 0; l < lines; l++)
            made->nm[l] = nm[l];
        status = fill(context, diagram, made, error);
    }
    if (status != WO_OK) {
        wo_pencil_map_destroy(context, &made);
        return status;
    }
    *map = made;
    return WO_OK;
}

wo_status wo_pencil_map_validate(const wo_pencil_map *map, wo_error *error)
{
    if (!size_in_range(map->distances, map->radii, map->lines))
        return wo_fail(error, WO_ERR_RANGE, "pencil map of %d distances, %d radii, %d wavelengths",
                       map->distances, map->radii, map->lines);
    WO_TRY(check_scale(map->k, map->v_low, map->v_high, error));
    WO_TRY(check_lines(map->nm, map->lines, error));
    const size_t rows = (size_t)map->lines * (size_t)map->distances;
    for (size_t i = 0; i < rows; i++) {
        const float *const density = map->density + i * (size_t)map->radii;
        double sum = 0;
        bool legal = map->height[i] >= 0 && isfinite(map->height[i]);
        for (int r = 0; r < map->radii; r++) {
            legal = legal && density[r] >= 0;
            sum += (double)density[r] * (2.0 * r + 1);
        }
        sum /= (double)map->radii * map->radii;
        if (!legal || !(fabs(sum - 1) <= 1e-3))
            return wo_fail(error, WO_ERR_FORMAT,
                           "row %zu of the pencil map (height %g) holds %g of the light: must be 1",
                           i, map->height[i], sum);
    }
    return WO_OK;
}

/* Entry below and the part of the way to the next one. */
typedef struct place {
    size_t low, high;
    double part;
} place;

static place place_of(double x, int count)
{
    if (!(x > 0))
        return (place){0, 0, 0};
    if (x >= count - 1)
        return (place){(size_t)count - 1, (size_t)count - 1, 0};
    const size_t low = (size_t)x;
    return (place){low, low + 1, x - (double)low};
}

static place line_of(const wo_pencil_map *map, double nm)
{
    const int last = map->lines - 1;
    if (!(nm > map->nm[0]))
        return (place){0, 0, 0};
    if (nm >= map->nm[last])
        return (place){(size_t)last, (size_t)last, 0};
    size_t l = 0;
    while (nm >= map->nm[l + 1])
        l++;
    return (place){l, l + 1, (nm - map->nm[l]) / (map->nm[l + 1] - map->nm[l])};
}

static place row_of(const wo_pencil_map *map, double v)
{
    return place_of((v - map->v_low) / (map->v_high - map->v_low) * (map->distances - 1),
                    map->distances);
}

static double mix(double a, double b, double part)
{
    return a + part * (b - a);
}

static double height_at(const wo_pencil_map *map, place line, place row)
{
    const double *const a = map->height + line.low * (size_t)map->distances;
    const double *const b = map->height + line.high * (size_t)map->distances;
    return mix(mix(a[row.low], a[row.high], row.part), mix(b[row.low], b[row.high], row.part),
               line.part);
}

double wo_pencil_map_height(const wo_pencil_map *map, double v, double nm)
{
    return height_at(map, line_of(map, nm), row_of(map, v));
}

static double density_at(const wo_pencil_map *map, size_t line, size_t row, place radius)
{
    const size_t index = line * (size_t)map->distances + row;
    const float *const density = map->density + index * (size_t)map->radii;
    return mix((double)density[radius.low], (double)density[radius.high], radius.part);
}

double wo_pencil_map_at(const wo_pencil_map *map, double v, double r, double nm)
{
    const place line = line_of(map, nm);
    const place row = row_of(map, v);
    const double height = height_at(map, line, row);
    const double away = fabs(r);
    if (!(away <= height))
        return 0;
    const place radius = place_of(height > 0 ? away / height * map->radii - 0.5 : 0, map->radii);
    return mix(mix(density_at(map, line.low, row.low, radius),
                   density_at(map, line.low, row.high, radius), row.part),
               mix(density_at(map, line.high, row.low, radius),
                   density_at(map, line.high, row.high, radius), row.part),
               line.part);
}
