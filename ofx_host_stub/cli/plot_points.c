/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "plot.h"
#include "text_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A diagram with two logarithmic axes, for scripts:

       plot_points TITLE X_LABEL Y_LABEL OUTPUT.svg < POINTS

   Each line of POINTS is "GROUP LABEL X Y" with tabs between them. Points of one group have one
   colour and stand in the legend together; they are joined in their order unless the group's name
   begins with '.', which is not shown. Points that are not above zero are left out. Exit code 1:
   it could not be read or written; 2: wrong use. */

enum { POINTS = 256, GROUPS = 16, NAME = 64, WIDTH = 860, HEIGHT = 480 };

typedef struct points {
    int count, groups;
    char group_name[GROUPS][NAME], label[POINTS][NAME];
    int group[POINTS];
    double x[POINTS], y[POINTS];
} points;

static const char *const colours[] = {"#505050", "#0072b2", "#d55e00", "#009e73",
                                      "#cc79a7", "#b08000", "#56b4e9", "#7b4ab8"};

static int group_of(points *p, const char *name)
{
    int g = 0;
    while (g < p->groups && strcmp(p->group_name[g], name) != 0)
        g++;
    if (g == p->groups && g < GROUPS)
        snprintf(p->group_name[p->groups++], NAME, "%s", name);
    return g;
}

static bool read_points(FILE *in, points *p)
{
    char line[512], name[NAME];
    while (fgets(line, sizeof line, in)) {
        if (p->count == POINTS || sscanf(line, "%63[^\t]\t%63[^\t]\t%lf\t%lf", name,
                                         p->label[p->count], &p->x[p->count], &p->y[p->count]) != 4)
            return false;
        p->group[p->count] = group_of(p, name);
        if (p->group[p->count] == GROUPS)
            return false;
        p->count++;
    }
    return !ferror(in) && p->count > 0;
}

static void draw_group(const wo_plot *plot, const points *p, int group, const wo_pen *pen)
{
    double x[POINTS], y[POINTS];
    int count = 0;
    for (int i = 0; i < p->count; i++)
        if (p->group[i] == group) {
            x[count] = p->x[i];
            y[count++] = p->y[i];
        }
    if (p->group_name[group][0] != '.')
        wo_plot_curve(plot, pen, x, y, count);
    for (int i = 0, k = 0; i < p->count; i++)
        if (p->group[i] == group) {
            x[k] = wo_plot_x(plot, p->x[i]);
            y[k] = wo_plot_y(plot, p->y[i]);
            if (isfinite(x[k]) && isfinite(y[k]))
                wo_svg_text(plot->svg, x[k] + 5, y[k] - 5, 9, WO_ANCHOR_START, false, p->label[i]);
            k++;
        }
    wo_svg_dots(plot->svg, pen->colour, 7, x, y, count);
}

static void draw(const points *p, char *const *words, wo_svg *svg)
{
    wo_pen pens[GROUPS];
    const char *names[GROUPS];
    wo_axis x = {1, 0, words[1], 0, true}, y = {1, 0, words[2], 0, true};
    wo_axis_cover(&x, p->x, p->count);
    wo_axis_cover(&y, p->y, p->count);
    wo_axis_round(&x);
    wo_axis_round(&y);
    wo_svg_begin(svg, WIDTH, HEIGHT, words[0]);
    const wo_plot plot = wo_plot_begin(svg, (wo_box){4, 4, WIDTH - 8, HEIGHT - 8}, words[0], x, y);
    for (int g = 0; g < p->groups; g++) {
        pens[g] = (wo_pen){colours[(size_t)g % WO_COUNT(colours)], 1.5, NULL};
        names[g] = p->group_name[g] + (p->group_name[g][0] == '.');
        draw_group(&plot, p, g, &pens[g]);
    }
    wo_plot_legend(svg, WIDTH - 20, 20, pens, names, p->groups);
}

int main(int count, char **words)
{
    static points p;
    wo_svg svg = {0};
    wo_error error = {0};
    if (count != 5) {
        fprintf(stderr, "usage: plot_points TITLE X_LABEL Y_LABEL OUTPUT.svg < POINTS\n");
        return 2;
    }
    if (!read_points(stdin, &p)) {
        fprintf(stderr, "plot_points: the points are no lines of GROUP, LABEL, X, Y\n");
        return 1;
    }
    draw(&p, words + 1, &svg);
    const wo_status status = wo_svg_finish(&svg, &error) != WO_OK
                                 ? error.status
                                 : wo_text_save(words[4], svg.text, svg.length, &error);
    wo_svg_free(&svg);
    if (status != WO_OK)
        fprintf(stderr, "plot_points: %s\n", error.text);
    return status == WO_OK ? 0 : 1;
}
