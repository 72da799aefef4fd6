/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* How many wavelengths a bokeh in colour needs: for every aberration preset, the light of the
   R, G and B discs that 3, 8, 16 and 32 lines put elsewhere than 64 do, and what a map costs. */
#include "wideopen/lens_diagram.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { FULL = 64, RADII = 128, BINS = 96, DISTANCES = 17 };

static const double focal_mm = 50, f_number = 2, reach = 4; /* dioptres either side */

static const char *const preset_names[] = {
#define NAME(name, key, label) key,
    WO_DIAGRAM_PRESET_LIST(NAME)
#undef NAME
};

/* Bands with soft shoulders: B 400-500, G 500-590, R 590-700 nm. */
static double weight(int channel, double nm)
{
    static const double edge[] = {700, 590, 500, 400};
    const double above = 1 / (1 + exp((edge[channel + 1] - nm) / 6));
    const double below = 1 / (1 + exp((nm - edge[channel]) / 6));
    return above * below;
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static wo_pencil_map *map_of(const wo_diagram *d, int lines, double *took)
{
    double nm[FULL];
    wo_pencil_map *map = NULL;
    wo_error error;
    for (int l = 0; l < lines; l++)
        nm[l] = 400 + 300 * (l + 0.5) / lines;
    const double start = seconds();
    if (wo_pencil_map_create(NULL, d, 1, -reach, reach, DISTANCES, RADII, nm, lines, &map,
                             &error) != WO_OK) {
        fprintf(stderr, "%s\n", error.text);
        exit(1);
    }
    *took = seconds() - start;
    return map;
}

/* Light of one row within radius r. */
static double within(const wo_pencil_map *map, int row, double r)
{
    const double height = map->height[row];
    const double x = height > 0 ? fmin(r / height, 1) * RADII : RADII;
    double sum = 0;
    for (int j = 0; j < RADII && j < x; j++) {
        const double outer = fmin(x, j + 1.0);
        sum += (double)map->density[row * RADII + j] * (outer * outer - (double)j * j);
    }
    return sum / (RADII * RADII);
}

/* Light in rings up to radius top. */
static void bokeh(const wo_pencil_map *map, int distance, int channel, double top,
                  double ring[BINS])
{
    double whole = 0;
    for (int i = 0; i < BINS; i++)
        ring[i] = 0;
    for (int l = 0; l < map->lines; l++) {
        const double w = weight(channel, map->nm[l]);
        double before = 0;
        whole += w;
        for (int i = 0; i < BINS; i++) {
            const double up = within(map, l * DISTANCES + distance, top * (i + 1) / BINS);
            ring[i] += w * (up - before);
            before = up;
        }
    }
    for (int i = 0; i < BINS; i++)
        ring[i] /= whole;
}

/* Mean and largest part of the light of a channel that lies elsewhere, over channels and distances;
   the focus itself, where blur is smallest, is left out of the mean. */
static void compare(const wo_pencil_map *few, const wo_pencil_map *full, double *mean, double *most)
{
    int count = 0;
    *mean = *most = 0;
    for (int d = 0; d < DISTANCES; d++) {
        if (d == DISTANCES / 2)
            continue;
        double top = 0;
        for (int l = 0; l < full->lines; l++)
            top = fmax(top, full->height[l * DISTANCES + d]);
        for (int c = 0; c < 3; c++) {
            double a[BINS], b[BINS], sum = 0;
            bokeh(few, d, c, top * 1.02, a);
            bokeh(full, d, c, top * 1.02, b);
            for (int i = 0; i < BINS; i++)
                sum += 0.5 * fabs(a[i] - b[i]);
            *mean += sum;
            *most = fmax(*most, sum);
            count++;
        }
    }
    *mean /= count;
}

int main(void)
{
    static const int counts[] = {3, 8, 16, 32};
    printf("%g mm f/%g, +-%g dioptres, %% of a channel's light that lies elsewhere than with %d "
           "wavelengths: mean (worst)\n%-12s",
           focal_mm, f_number, reach, FULL, "");
    for (size_t i = 0; i < WO_COUNT(counts); i++)
        printf("%16d", counts[i]);
    printf("%20s\n", "64 lines, ms/line");
    for (int p = 0; p < WO_DIAGRAM_PRESET_COUNT; p++) {
        wo_diagram diagram;
        double took, ignored, mean, most;
        if (wo_diagram_make((wo_diagram_preset)p, focal_mm, f_number, 1, &diagram, NULL) != WO_OK)
            return 1;
        wo_pencil_map *full = map_of(&diagram, FULL, &took);
        printf("%-12s", preset_names[p]);
        for (size_t i = 0; i < WO_COUNT(counts); i++) {
            wo_pencil_map *few = map_of(&diagram, counts[i], &ignored);
            compare(few, full, &mean, &most);
            printf("%8.2f (%5.2f)", 100 * mean, 100 * most);
            wo_pencil_map_destroy(NULL, &few);
        }
        printf("%16.2f\n", took * 1e3 / FULL);
        wo_pencil_map_destroy(NULL, &full);
    }
    return 0;
}
