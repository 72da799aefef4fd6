/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "lens_panels.h"
#include "pencil_map_file.h"

#include <math.h>

enum { DISTANCES = 257, RADII = 256 };

/* As far from the focus as the bokeh strip goes, or ten times as far as any zone. */
static double range_of(const wo_lens_view *view, const wo_diagram *diagram)
{
    double range = fabs(12 * view->f_number / view->first[1].efl);
    for (int l = 0; l < diagram->lines; l++)
        for (int i = 0; i < diagram->zones; i++)
            range = fmax(range, 10 * fabs(diagram->shift[l][i]));
    return fmin(range, WO_DIAGRAM_SHIFT_MAX);
}

wo_status wo_lens_pencil_map_save(const wo_lens_view *view, const char *path, wo_error *error)
{
    const wo_context context = WO_CONTEXT_INIT;
    const double nm[WO_LENS_LINES] = {WO_NM_F, WO_NM_D, WO_NM_C};
    wo_diagram diagram;
    wo_pencil_map *map = NULL;
    WO_TRY(wo_lens_needs_image(view, error));
    WO_TRY(wo_diagram_of_lens(&view->lens, 0, view->vf, nm, WO_LENS_LINES, &diagram, error));
    const double range = range_of(view, &diagram);
    const double micrometres = fabs(diagram.radius * view->first[1].efl);
    wo_status status = wo_pencil_map_create(&context, &diagram, micrometres, -range, range,
                                            DISTANCES, RADII, nm, WO_LENS_LINES, &map, error);
    if (status == WO_OK)
        status = wo_pencil_map_save(path, map, error);
    wo_pencil_map_destroy(&context, &map);
    return status;
}
