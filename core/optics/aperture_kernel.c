/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/aperture_kernel.h"

#include <math.h>

struct wo_kernel_table {
    int width, height;
    double side;    /* of a pixel */
    double largest; /* share of the brightest pixel */
    double *rows;   /* [height + 1] share of the light below a row */
    double *pixels; /* [height][width + 1] share of a row's light to the left of a pixel */
};

static wo_status check(const wo_aperture_kernel *kernel, wo_error *error)
{
    if (!kernel->data)
        return wo_fail(error, WO_ERR_ARGUMENT, "the aperture kernel has no pixels");
    if (kernel->width < 1 || kernel->width > WO_KERNEL_SIDE_MAX || kernel->height < 1 ||
        kernel->height > WO_KERNEL_SIDE_MAX)
        return wo_fail(error, WO_ERR_RANGE, "aperture kernel of %d x %d pixels: must be 1..%d",
                       kernel->width, kernel->height, WO_KERNEL_SIDE_MAX);
    return WO_OK;
}

static double light_at(const wo_aperture_kernel *kernel, int x, int y)
{
    const float value = kernel->data[(ptrdiff_t)y * kernel->row + x];
    return isfinite(value) && value > 0 ? (double)value : 0;
}

/* Distance of a pixel's farthest corner from the middle, in pixels. */
static double far_corner(const wo_aperture_kernel *kernel, int x, int y)
{
    return 0.5 *
           hypot(fabs(2.0 * x + 1 - kernel->width) + 1, fabs(2.0 * y + 1 - kernel->height) + 1);
}

static double size_of(const wo_aperture_kernel *kernel)
{
    double most = 0;
    for (int y = 0; y < kernel->height; y++)
        for (int x = 0; x < kernel->width; x++)
            if (light_at(kernel, x, y) > 0)
                most = fmax(most, far_corner(kernel, x, y));
    return most;
}

static void share(double *cumulative, int count)
{
    const double total = cumulative[count];
    for (int i = 0; total > 0 && i <= count; i++)
        cumulative[i] /= total;
}

static double *row_of(const wo_kernel_table *table, int y)
{
    return table->pixels + (size_t)y * ((size_t)table->width + 1);
}

static double share_of(const wo_kernel_table *table, int x, int y)
{
    const double *row = row_of(table, y);
    return (table->rows[y + 1] - table->rows[y]) * (row[x + 1] - row[x]);
}

static void fill(wo_kernel_table *table, const wo_aperture_kernel *kernel, double covered)
{
    for (int y = 0; y < table->height; y++) {
        double *row = row_of(table, y);
        for (int x = 0; x < table->width; x++) {
            const bool open = far_corner(kernel, x, y) > covered;
            row[x + 1] = row[x] + (open ? light_at(kernel, x, y) : 0);
        }
        table->rows[y + 1] = table->rows[y] + row[table->width];
        share(row, table->width);
    }
    share(table->rows, table->height);
    for (int y = 0; y < table->height; y++)
        for (int x = 0; x < table->width; x++)
            table->largest = fmax(table->largest, share_of(table, x, y));
}

wo_status wo_kernel_table_create(const wo_context *context, const wo_aperture_kernel *kernel,
                                 double obstruction, wo_kernel_table **out, wo_error *error)
{
    *out = NULL;
    WO_TRY(check(kernel, error));
    const double size = size_of(kernel);
    if (size == 0)
        return wo_fail(error, WO_ERR_RANGE, "the aperture kernel is dark: no value above 0");
    wo_kernel_table *table = wo_new(context, error, 1, sizeof *table);
    if (!table)
        return WO_ERR_NOMEM;
    table->width = kernel->width;
    table->height = kernel->height;
    table->side = 1 / size;
    const size_t rows = (size_t)kernel->height;
    table->rows = wo_new(context, error, rows + 1, sizeof *table->rows);
    if (table->rows)
        table->pixels =
            wo_new(context, error, rows * ((size_t)kernel->width + 1), sizeof *table->pixels);
    if (!table->pixels) {
        wo_kernel_table_destroy(context, &table);
        return WO_ERR_NOMEM;
    }
    fill(table, kernel, obstruction * size);
    *out = table;
    return WO_OK;
}

void wo_kernel_table_destroy(const wo_context *context, wo_kernel_table **table)
{
    if (*table) {
        wo_delete(context, (*table)->rows);
        wo_delete(context, (*table)->pixels);
    }
    wo_delete(context, *table);
    *table = NULL;
}

/* The lit one of count steps in which the share x of the light is reached, and how far into it. */
static int invert(const double *cumulative, int count, double x, double *part)
{
    int low = 0;
    int high = count - 1;
    x = fmin(x, 1 - 0x1p-53);
    while (low < high) {
        const int middle = (low + high) / 2;
        if (cumulative[middle + 1] > x)
            high = middle;
        else
            low = middle + 1;
    }
    *part = (x - cumulative[low]) / (cumulative[low + 1] - cumulative[low]);
    return low;
}

void wo_kernel_table_sample(const wo_kernel_table *table, double s, double t, double u[2])
{
    double across;
    double up;
    const int row = invert(table->rows, table->height, t, &up);
    const int column = invert(row_of(table, row), table->width, s, &across);
    u[0] = (column + across - 0.5 * table->width) * table->side;
    u[1] = (row + up - 0.5 * table->height) * table->side;
}

double wo_kernel_table_value(const wo_kernel_table *table, double x, double y)
{
    const double column = floor(x / table->side + 0.5 * table->width);
    const double row = floor(y / table->side + 0.5 * table->height);
    if (!(column >= 0 && column < table->width && row >= 0 && row < table->height))
        return 0;
    return share_of(table, (int)column, (int)row) / table->largest;
}

double wo_kernel_table_area(const wo_kernel_table *table)
{
    return table->side * table->side / table->largest;
}
