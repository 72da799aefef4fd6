/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/aperture.h"

#include "optics/aperture_kernel.h"
#include "optics/pencil.h"

#include <math.h>

#define PI 3.14159265358979323846

/* Steps of the table. Where an obstruction leaves corners, area begins with the square of the
   angle, which takes more of them. */
enum { STEPS = 128, STEPS_OBSTRUCTED = 1024 };

/* Share of a valley's largest radius that a star keeps at curvature 0, and how that changes. */
#define STAR_VALLEY 0.55
#define STAR_BEND   0.45

/* The heart in units of half the square's diagonal: centre and radius of the circle around it. */
#define HEART_CENTRE 0.26120387496374148
#define HEART_RADIUS 1.2612038749637415

/* Optical density of the apodization glass at the rim at full strength. */
#define APODIZATION_DENSITY 2

#define GRAINS 24 /* per radius */

static bool in_range(double x, double low, double high)
{
    return x >= low && x <= high;
}

static wo_status validate_weights(const wo_aperture *a, wo_error *error)
{
    if (!in_range(a->apodization, 0, 1))
        return wo_fail(error, WO_ERR_RANGE, "apodization %g: must be 0..1", a->apodization);
    if (!in_range(a->edge, -1, 1))
        return wo_fail(error, WO_ERR_RANGE, "edge brightness %g: must be -1..1", a->edge);
    if (!in_range(a->ring_amount, 0, 1))
        return wo_fail(error, WO_ERR_RANGE, "amount of onion rings %g: must be 0..1",
                       a->ring_amount);
    if (a->ring_count < 0 || a->ring_count > WO_RINGS_MAX)
        return wo_fail(error, WO_ERR_RANGE, "%d onion rings: must be 0..%d", a->ring_count,
                       WO_RINGS_MAX);
    if (!in_range(a->grain_amount, 0, 1))
        return wo_fail(error, WO_ERR_RANGE, "amount of grain %g: must be 0..1", a->grain_amount);
    return WO_OK;
}

wo_status wo_aperture_validate(const wo_aperture *a, wo_error *error)
{
    if (!(a->blades == 0 || (a->blades >= 3 && a->blades <= WO_BLADES_MAX)))
        return wo_fail(error, WO_ERR_RANGE, "%d aperture blades: must be 0 (round) or 3..%d",
                       a->blades, WO_BLADES_MAX);
    if (!in_range(a->curvature, -1, 1))
        return wo_fail(error, WO_ERR_RANGE, "blade curvature %g: must be -1..1", a->curvature);
    if (!isfinite(a->rotation))
        return wo_fail(error, WO_ERR_RANGE, "aperture rotation %g: must be finite", a->rotation);
    if (!in_range(a->aspect, 0.1, 10))
        return wo_fail(error, WO_ERR_RANGE, "aperture aspect %g: must be 0.1..10", a->aspect);
    if ((int)a->form < WO_APERTURE_IRIS || (int)a->form > WO_APERTURE_HEART)
        return wo_fail(error, WO_ERR_RANGE, "aperture form %d: not known", (int)a->form);
    if (a->form == WO_APERTURE_STAR && a->blades == 0)
        return wo_fail(error, WO_ERR_RANGE, "a star without blades: must have 3..%d",
                       WO_BLADES_MAX);
    if (!in_range(a->opening, 0, 1))
        return wo_fail(error, WO_ERR_RANGE, "aperture opening %g: must be 0..1", a->opening);
    if (!in_range(a->obstruction, 0, WO_OBSTRUCTION_MAX))
        return wo_fail(error, WO_ERR_RANGE, "central obstruction %g: must be 0..%g", a->obstruction,
                       WO_OBSTRUCTION_MAX);
    return validate_weights(a, error);
}

/* At angle a from a vertex towards the middle of the blade. */
static double blade_radius(const wo_aperture *aperture, double a)
{
    const double half = PI / aperture->blades;
    const double straight = cos(half) / cos(a - half);
    const double c = aperture->curvature;
    return c >= 0 ? straight + c * (1 - straight) : straight * (1 + c * (1 - straight));
}

/* A straight line from the tip (1, 0) to the valley. */
static double star_radius(const wo_aperture *aperture, double a)
{
    const double half = PI / aperture->blades;
    const double valley = cos(half) * (STAR_VALLEY + STAR_BEND * aperture->curvature);
    const double across = valley * sin(half);
    return across / (across * cos(a) + (1 - valley * cos(half)) * sin(a));
}

/* At angle a from the notch, seen from a point inside the square and both discs: the farther of
   where the ray leaves the square and the disc on its side. */
static double heart_radius(double a)
{
    const double x = sin(a);
    const double y = cos(a);
    const double disc_y = 0.5 - HEART_CENTRE;
    const double along = 0.5 * x + disc_y * y;
    const double disc = along + sqrt(along * along + 0.5 - (0.25 + disc_y * disc_y));
    const double upper = x + y > 0 ? (1 - HEART_CENTRE) / (x + y) : INFINITY;
    const double lower = x - y > 0 ? (1 + HEART_CENTRE) / (x - y) : INFINITY;
    const double square = fmin(upper, lower);
    return fmax(disc, square) / HEART_RADIUS;
}

/* Boundary at angle a from the start of a part, whose second half mirrors the first. */
static double boundary(const wo_aperture_shape *shape, double a)
{
    if (shape->sectors == 0)
        return 1;
    const wo_aperture *aperture = &shape->aperture;
    a = fmin(a, 2 * PI / shape->sectors - a);
    double r;
    if (aperture->form == WO_APERTURE_STAR)
        r = star_radius(aperture, a);
    else if (aperture->form == WO_APERTURE_HEART)
        r = heart_radius(a);
    else
        r = blade_radius(aperture, a);
    return r + aperture->opening * (1 - r);
}

/* Twice the open area per angle. */
static double open_area(const wo_aperture_shape *shape, double a)
{
    const double r = boundary(shape, a);
    const double o = shape->aperture.obstruction;
    return fmax(r * r - o * o, 0);
}

/* Cumulative area over half a part by Simpson's rule on fine steps, then inverted. Angles without
   area are left out of the count; there is one such range before the first open angle at most, and
   one between open angles. */
static void make_sector(wo_aperture_shape *shape)
{
    enum { FINE = 2048 };
    double cumulative[FINE + 1] = {0};
    const double h = PI / shape->sectors / FINE;
    shape->steps = shape->aperture.obstruction > 0 ? STEPS_OBSTRUCTED : STEPS;
    int open = 0;
    bool was_open = false;
    for (int i = 0; i < FINE; i++) {
        const double a = h * i;
        const double piece =
            h / 12 *
            (open_area(shape, a) + 4 * open_area(shape, a + 0.5 * h) + open_area(shape, a + h));
        if (piece > 0) {
            if (open > 0 && !was_open)
                shape->dark_by = i - open - shape->dark_before;
            else if (open == 0)
                shape->dark_before = i;
            cumulative[open + 1] = cumulative[open] + piece;
            open++;
        } else if (was_open) {
            shape->dark_at = i;
        }
        was_open = piece > 0;
    }
    const double total = cumulative[open];
    int j = 0;
    for (int i = 0; i <= shape->steps; i++) {
        const double want = total * i / shape->steps;
        while (j < open - 1 && cumulative[j + 1] < want)
            j++;
        const double part = (want - cumulative[j]) / (cumulative[j + 1] - cumulative[j]);
        shape->sector[i] = (float)((j + part) / (2 * FINE));
    }
    shape->dark_before /= 2 * FINE;
    shape->dark_at = shape->dark_by > 0 ? shape->dark_at / (2 * FINE) : 1;
    shape->dark_by /= 2 * FINE;
    shape->area = 2 * total * shape->sectors * shape->scale_x * shape->scale_y;
}

/* What does not depend on where the open points lie. */
static void begin(const wo_aperture *aperture, wo_aperture_shape *shape)
{
    *shape = (wo_aperture_shape){
        .aperture = *aperture, .light = 1, .even = true, .scale_x = 1, .scale_y = 1, .dark_at = 1};
    shape->turn = fmod(aperture->rotation, 360) * (PI / 180);
    if (aperture->aspect < 1)
        shape->scale_x = aperture->aspect;
    else
        shape->scale_y = 1 / aperture->aspect;
}

static void measure_light(wo_aperture_shape *shape)
{
    enum { SIDE = 256 };
    const wo_aperture *a = &shape->aperture;
    shape->even = a->apodization == 0 && a->edge == 0 &&
                  (a->ring_amount == 0 || a->ring_count == 0) && a->grain_amount == 0 &&
                  !(shape->kernel && a->obstruction > 0);
    if (shape->even)
        return;
    double sum = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        double u[2];
        wo_aperture_sample(shape, (i % SIDE + 0.5) / SIDE, ((double)(i / SIDE) + 0.5) / SIDE, u);
        sum += wo_aperture_weight(shape, u[0], u[1]);
    }
    shape->light = sum / (SIDE * SIDE);
}

void wo_aperture_make(const wo_aperture *aperture, wo_aperture_shape *shape)
{
    begin(aperture, shape);
    const double o = aperture->obstruction;
    if (aperture->form == WO_APERTURE_HEART) {
        shape->sectors = 1;
        shape->start = PI / 2;
    } else {
        shape->sectors = aperture->blades;
    }
    if (shape->sectors > 0)
        make_sector(shape);
    else
        shape->area = PI * (1 - o * o) * shape->scale_x * shape->scale_y;
    measure_light(shape);
}

wo_status wo_aperture_make_kernel(const wo_context *context, const wo_aperture *aperture,
                                  const wo_aperture_kernel *kernel, wo_aperture_shape *shape,
                                  wo_error *error)
{
    *shape = (wo_aperture_shape){0};
    WO_TRY(wo_aperture_validate(aperture, error));
    wo_aperture_shape made;
    begin(aperture, &made);
    WO_TRY(wo_kernel_table_create(context, kernel, aperture->obstruction, &made.kernel, error));
    made.area = wo_kernel_table_area(made.kernel) * made.scale_x * made.scale_y;
    measure_light(&made);
    if (!(made.light > 0)) {
        wo_aperture_destroy(context, &made);
        return wo_fail(error, WO_ERR_RANGE, "the aperture kernel lets no light through");
    }
    *shape = made;
    return WO_OK;
}

void wo_aperture_destroy(const wo_context *context, wo_aperture_shape *shape)
{
    wo_kernel_table_destroy(context, &shape->kernel);
}

/* Shirley and Chiu's concentric map, 1997: unit square to radius and angle in turns, 0..1. */
static void concentric(double s, double t, double *radius, double *turns)
{
    const double a = 2 * s - 1;
    const double b = 2 * t - 1;
    double angle;
    if (fabs(a) > fabs(b)) {
        *radius = fabs(a);
        angle = 0.125 * (b / a) + (a < 0 ? 0.5 : 0);
    } else {
        *radius = fabs(b);
        angle = b != 0 ? 0.25 - 0.125 * (a / b) + (b < 0 ? 0.5 : 0) : 0;
    }
    *turns = angle - floor(angle);
}

/* Angle from the start of the boundary; *limit is the boundary there. */
static double angle_of(const wo_aperture_shape *shape, double turns, double *limit)
{
    *limit = 1;
    if (shape->sectors == 0)
        return 2 * PI * turns;
    double whole;
    const double within = modf(turns * shape->sectors, &whole);
    const double at = fmin(within, 1 - within) * (2 * shape->steps);
    const int i = at < shape->steps - 1 ? (int)at : shape->steps - 1;
    double part = shape->sector[i] + (at - i) * (shape->sector[i + 1] - shape->sector[i]);
    part += shape->dark_before;
    part += part > shape->dark_at ? shape->dark_by : 0;
    part = within > 0.5 ? 1 - part : part;
    const double inside = part * 2 * PI / shape->sectors;
    *limit = boundary(shape, inside);
    return 2 * PI * whole / shape->sectors + inside;
}

void wo_aperture_polar(const wo_aperture_shape *shape, double radius, double turns, double u[2])
{
    double limit;
    const double angle = angle_of(shape, turns - floor(turns), &limit) + shape->start + shape->turn;
    const double o = shape->aperture.obstruction;
    if (o > 0)
        radius = sqrt(o * o + fmax(limit * limit - o * o, 0) * radius * radius);
    else
        radius *= limit;
    u[0] = radius * cos(angle) * shape->scale_x;
    u[1] = radius * sin(angle) * shape->scale_y;
}

void wo_aperture_sample(const wo_aperture_shape *shape, double s, double t, double u[2])
{
    if (shape->kernel) {
        double at[2];
        wo_kernel_table_sample(shape->kernel, s, t, at);
        u[0] = (at[0] * cos(shape->turn) - at[1] * sin(shape->turn)) * shape->scale_x;
        u[1] = (at[0] * sin(shape->turn) + at[1] * cos(shape->turn)) * shape->scale_y;
        return;
    }
    double radius;
    double turns;
    concentric(s, t, &radius, &turns);
    wo_aperture_polar(shape, radius, turns, u);
}

/* Noise of one value in -1..1 for each point of a grid, smooth in between. */
static double grain(uint32_t seed, double x, double y)
{
    const double gx = fmin(fmax((x + 1) * GRAINS, 0), 2 * GRAINS);
    const double gy = fmin(fmax((y + 1) * GRAINS, 0), 2 * GRAINS);
    const double fx = gx - floor(gx);
    const double fy = gy - floor(gy);
    const double sx = fx * fx * (3 - 2 * fx);
    const double sy = fy * fy * (3 - 2 * fy);
    double sum = 0;
    for (uint32_t i = 0; i < 4; i++) {
        const uint32_t column = (uint32_t)gx + i % 2;
        const uint32_t row = (uint32_t)gy + i / 2;
        const double value = wo_hash(wo_hash(seed + 256 * row + column) + seed) * 0x1p-31 - 1;
        sum += value * (i % 2 ? sx : 1 - sx) * (i / 2 ? sy : 1 - sy);
    }
    return sum;
}

double wo_aperture_weight(const wo_aperture_shape *shape, double x, double y)
{
    if (shape->even)
        return 1;
    const wo_aperture *a = &shape->aperture;
    x /= shape->scale_x;
    y /= shape->scale_y;
    const double r2 = fmin(x * x + y * y, 1);
    if (shape->kernel && r2 < a->obstruction * a->obstruction)
        return 0;
    double weight = pow(10, -APODIZATION_DENSITY * a->apodization * r2);
    const double lit = a->edge >= 0 ? r2 : 1 - r2;
    weight *= 1 + fabs(a->edge) * (4 * lit * lit * lit - 1);
    if (a->ring_count > 0)
        weight *= 1 + a->ring_amount * cos(2 * PI * a->ring_count * sqrt(r2));
    if (a->grain_amount > 0)
        weight *= 1 + a->grain_amount * grain(a->grain_seed, x, y);
    return weight;
}

/* What the boundary or the kernel lets through. */
static double clear_at(const wo_aperture_shape *shape, double x, double y)
{
    x /= shape->scale_x;
    y /= shape->scale_y;
    const double r2 = x * x + y * y;
    const double o = shape->aperture.obstruction;
    if (!(r2 <= 1 && r2 >= o * o))
        return 0;
    if (shape->kernel) {
        const double c = cos(shape->turn);
        const double s = sin(shape->turn);
        return wo_kernel_table_value(shape->kernel, x * c + y * s, y * c - x * s);
    }
    if (shape->sectors == 0)
        return 1;
    const double span = 2 * PI / shape->sectors;
    double angle = fmod(atan2(y, x) - shape->turn - shape->start, span);
    if (angle < 0)
        angle += span;
    const double r = boundary(shape, angle);
    return r2 <= r * r ? 1 : 0;
}

bool wo_aperture_inside(const wo_aperture_shape *shape, double x, double y)
{
    return clear_at(shape, x, y) > 0;
}

double wo_aperture_density(const wo_aperture_shape *shape, double x, double y)
{
    const double through = clear_at(shape, x, y);
    if (through == 0)
        return 0;
    return through * wo_aperture_weight(shape, x, y) / (shape->area * shape->light);
}

void wo_aperture_mask(const wo_aperture_shape *shape, int size, float *mask)
{
    enum { SUB = 8 };
    for (int y = 0; y < size; y++) {
        for (int x = 0; x < size; x++) {
            double sum = 0;
            for (int i = 0; i < SUB * SUB; i++) {
                const double px = 2 * (x + (i % SUB + 0.5) / SUB) / size - 1;
                const double py = 2 * (y + ((double)(i / SUB) + 0.5) / SUB) / size - 1;
                const double through = clear_at(shape, px, py);
                sum += through > 0 ? through * wo_aperture_weight(shape, px, py) : 0;
            }
            mask[(size_t)y * (size_t)size + (size_t)x] = (float)(sum / (SUB * SUB));
        }
    }
}
