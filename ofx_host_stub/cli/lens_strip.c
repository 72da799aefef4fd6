/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "bridge/picture.h"
#include "lens_panels.h"
#include "picture_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Density of rays on planes around the focus; every cell is as wide as every other. */

enum { SIDE = 176, STEPS = 9, CELLS = STEPS * WO_LENS_FIELDS, RAYS = 60000, SPECTRUM = 13 };
#define DISC 0.012 /* of the outermost planes, in parts of the focal length */

typedef struct strip {
    const wo_lens_view *view;
    double shift;                /* of the outermost planes, mm */
    double cell[WO_LENS_FIELDS]; /* side of the cells of a row, mm */
    double rgb[SPECTRUM][3];
    double full; /* area of the bundle on the axis, mm^2 */
    wo_image image[CELLS];
    char caption[CELLS][2][96];
    wo_picture_cell cells[CELLS];
} strip;

static double lobe(double nm, double centre, double below, double above)
{
    const double t = (nm - centre) / (nm < centre ? below : above);
    return exp(-0.5 * t * t);
}

static double line_nm(int i)
{
    return 430 + 20.0 * i;
}

/* Linear Rec.709 weights of the lines; together they are white. CIE 1931 by the Gaussians of Wyman,
   Sloan and Shirley 2013. */
static void make_spectrum(double rgb[SPECTRUM][3])
{
    static const double matrix[3][3] = {{3.2404542, -1.5371385, -0.4985314},
                                        {-0.9692660, 1.8760108, 0.0415560},
                                        {0.0556434, -0.2040259, 1.0572252}};
    double sum[3] = {0, 0, 0};
    for (int i = 0; i < SPECTRUM; i++) {
        const double nm = line_nm(i);
        const double xyz[3] = {
            1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
                0.065 * lobe(nm, 501.1, 20.4, 26.2),
            0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
            1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
        for (int c = 0; c < 3; c++) {
            rgb[i][c] = matrix[c][0] * xyz[0] + matrix[c][1] * xyz[1] + matrix[c][2] * xyz[2];
            sum[c] += rgb[i][c];
        }
    }
    for (int i = 0; i < SPECTRUM; i++)
        for (int c = 0; c < 3; c++)
            rgb[i][c] /= sum[c];
}

static double step_shift(const strip *s, int step)
{
    return s->shift * (2.0 * step / (STEPS - 1) - 1);
}

static void splat(const wo_image *image, double x, double y, const float rgb[3])
{
    const double fx = floor(x - 0.5), fy = floor(y - 0.5);
    if (!(fx >= 0 && fy >= 0 && fx < SIDE - 1 && fy < SIDE - 1))
        return;
    const float ax = (float)(x - 0.5 - fx), ay = (float)(y - 0.5 - fy);
    for (int k = 0; k < 4; k++) {
        const float w = (k & 1 ? ax : 1 - ax) * (k & 2 ? ay : 1 - ay);
        float *const pixel = wo_image_at(image, (int)fx + (k & 1), (int)fy + (k >> 1));
        for (int c = 0; c < 3; c++)
            pixel[c] += w * rgb[c];
    }
}

/* Middle of what lands on the plane z. */
static void centroid(const wo_bundle *b, double z, double centre[2])
{
    double sum[2] = {0, 0};
    int count = 0;
    for (int i = 0; i < b->count; i++) {
        if (b->rays.outcome[i] != WO_RAY_PASSED)
            continue;
        const double t = (z - b->rays.z[i]) / b->rays.dz[i];
        sum[0] += b->rays.x[i] + t * b->rays.dx[i];
        sum[1] += b->rays.y[i] + t * b->rays.dy[i];
        count++;
    }
    centre[0] = count ? sum[0] / count : 0;
    centre[1] = count ? sum[1] / count : 0;
}

static void add_line(strip *s, const wo_bundle *b, int row, int line, double centres[STEPS][2])
{
    const double px = SIDE / s->cell[row], base = wo_lens_sensor_z(s->view);
    for (int step = 0; step < STEPS; step++) {
        const double shift = step_shift(s, step), z = base + shift;
        /* Exposed for a uniform disc of the size that the f-number gives, and a little. */
        const double r = fabs(shift) / (2 * s->view->f_number), least = 0.1 * s->cell[0];
        const double gain =
            0.4 * 3.14159265 * (r * r + least * least) * px * px * b->area / s->full;
        float rgb[3];
        for (int c = 0; c < 3; c++)
            rgb[c] = (float)(gain * s->rgb[line][c]);
        for (int i = 0; i < b->count; i++) {
            if (b->rays.outcome[i] != WO_RAY_PASSED)
                continue;
            const double t = (z - b->rays.z[i]) / b->rays.dz[i];
            const double x = b->rays.x[i] + t * b->rays.dx[i] - centres[step][0];
            const double y = b->rays.y[i] + t * b->rays.dy[i] - centres[step][1];
            splat(&s->image[row * STEPS + step], SIDE / 2.0 + x * px, SIDE / 2.0 + y * px, rgb);
        }
    }
}

/* As wide as the light on the outermost planes, but not less than on the axis. */
static double cell_of(const strip *s, const wo_bundle *b, double centres[STEPS][2])
{
    double half = 0;
    for (int step = 0; step < STEPS; step += STEPS - 1) {
        const double z = wo_lens_sensor_z(s->view) + step_shift(s, step);
        for (int i = 0; i < b->count; i++) {
            if (b->rays.outcome[i] != WO_RAY_PASSED)
                continue;
            const double t = (z - b->rays.z[i]) / b->rays.dz[i];
            half = fmax(half, fabs(b->rays.x[i] + t * b->rays.dx[i] - centres[step][0]));
            half = fmax(half, fabs(b->rays.y[i] + t * b->rays.dy[i] - centres[step][1]));
        }
    }
    return fmax(1.8 * DISC * fabs(s->view->first[1].efl), 2.3 * half);
}

static bool draw_row(strip *s, int row)
{
    const double field = wo_lens_fields[row] * s->view->half_field;
    const unsigned flags = WO_TRACE_CLIP | WO_TRACE_IRIS;
    wo_bundle b;
    if (!wo_bundle_fill(s->view, s->view->across, field, RAYS, &b))
        return row > 0; /* off the axis nothing may get through */
    double centres[STEPS][2];
    wo_bundle_trace(s->view, &s->view->system, s->view->across, field, flags, &b);
    int passed = 0;
    for (int i = 0; i < b.count; i++)
        passed += b.rays.outcome[i] == WO_RAY_PASSED;
    if (row == 0)
        s->full = fmax(passed, 1) * b.area;
    for (int step = 0; step < STEPS; step++)
        centroid(&b, wo_lens_sensor_z(s->view) + step_shift(s, step), centres[step]);
    s->cell[row] = cell_of(s, &b, centres);
    for (int line = 0; line < SPECTRUM; line++) {
        wo_system system;
        wo_system_make(&s->view->lens, line_nm(line), &system);
        wo_bundle_scatter(&b, s->view->across, line);
        wo_bundle_trace(s->view, &system, s->view->across, field, flags, &b);
        add_line(s, &b, row, line, centres);
    }
    wo_bundle_free(&b);
    return true;
}

static bool prepare(strip *s)
{
    for (int i = 0; i < CELLS; i++) {
        float *const data = calloc((size_t)SIDE * SIDE * 3, sizeof *data);
        if (!data)
            return false;
        s->image[i] = (wo_image){data, {0, 0, SIDE, SIDE}, SIDE * 3 * (ptrdiff_t)sizeof(float), 3};
        s->cells[i] = (wo_picture_cell){&s->image[i], true, {s->caption[i][0], s->caption[i][1]}};
    }
    return true;
}

static void caption(strip *s)
{
    for (int i = 0; i < CELLS; i++) {
        const int row = i / STEPS;
        char shift[32], field[32], cell[32];
        wo_plot_number(shift, sizeof shift, step_shift(s, i % STEPS), 3);
        wo_plot_number(field, sizeof field, wo_lens_fields[row] * s->view->half_field, 1);
        wo_plot_number(cell, sizeof cell, s->cell[row], s->cell[row] < 1 ? 3 : 2);
        snprintf(s->caption[i][0], sizeof s->caption[i][0], "%s mm", shift);
        snprintf(s->caption[i][1], sizeof s->caption[i][1], "%s deg, %s mm", field, cell);
    }
}

static wo_status save(strip *s, const char *path, wo_error *error)
{
    char title[200], subtitle[200], fno[32];
    const wo_prescription *const lens = &s->view->lens;
    snprintf(title, sizeof title, "%s: bokeh through focus",
             lens->title[0] ? lens->title : lens->name);
    snprintf(
        subtitle, sizeof subtitle,
        "f/%s, sensor moved from the paraxial focus (+ away from the lens); below: field, width of "
        "the square",
        wo_plot_number(fno, sizeof fno, s->view->f_number, 2));
    const wo_picture_layout layout = {title, subtitle, STEPS, SIDE, SIDE};
    wo_image result = {0};
    wo_status status = wo_picture_sheet(&layout, s->cells, CELLS, &result, error);
    if (status == WO_OK)
        status = wo_picture_save(path, &result, error);
    free(result.data);
    return status;
}

wo_status wo_lens_strip_save(const wo_lens_view *view, const char *path, wo_error *error)
{
    WO_TRY(wo_lens_needs_image(view, error));
    strip *const s = calloc(1, sizeof *s);
    if (!s)
        return wo_fail(error, WO_ERR_NOMEM, "out of memory for the bokeh strip");
    const double disc = DISC * fabs(view->first[1].efl);
    s->view = view;
    s->shift = disc * view->f_number;
    for (int row = 0; row < WO_LENS_FIELDS; row++)
        s->cell[row] = 1.8 * disc;
    make_spectrum(s->rgb);
    bool complete = prepare(s);
    for (int row = 0; row < WO_LENS_FIELDS && complete; row++)
        complete = draw_row(s, row);
    caption(s);
    const wo_status status =
        complete ? save(s, path, error)
                 : wo_fail(error, WO_ERR_UNSUPPORTED,
                           "no light gets through %s, or no memory is left", view->lens.name);
    for (int i = 0; i < CELLS; i++)
        free(s->image[i].data);
    free(s);
    return status;
}
