/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "lines.h"
#include "prescription_private.h"

/* The lens files of pbrt (Kolb, Mitchell and Hanrahan 1995): a row for each surface with radius,
   thickness, index of the medium behind, and clear diameter. An index of 0 is air; at the iris it
   is the medium that is there. */
static wo_status read_row(wo_lines *lines, wo_prescription *lens)
{
    static const char *const names[] = {"the radius", "the thickness", "the refractive index",
                                        "the diameter"};
    double row[4];
    for (int i = 0; i < 4; i++)
        WO_TRY(wo_lines_number(lines, names[i], &row[i]));
    WO_TRY(wo_lines_done(lines));
    if (lens->count == WO_SURFACES_MAX)
        return wo_lines_fail(lines, WO_ERR_RANGE, "more than %d surfaces", WO_SURFACES_MAX);

    wo_surface *const s = &lens->surface[lens->count];
    const wo_glass before = lens->count ? s[-1].glass : wo_glass_air();
    s->stop = row[0] == 0 && (row[2] == 0 || (row[2] == 1 && before.nd == 1));
    if (s->stop) {
        for (int i = 0; i < lens->count; i++)
            if (lens->surface[i].stop)
                return wo_lines_fail(lines, WO_ERR_FORMAT,
                                     "a second iris: surface %d is one already", i + 1);
        lens->stop = lens->count;
    }
    s->thickness = row[1];
    s->semi_aperture = row[3] / 2;
    wo_error inner;
    WO_TRY(wo_radius_read(lines, row[0], &s->curvature));
    s->glass = before;
    wo_status status =
        s->stop ? WO_OK : wo_glass_abbe(row[2] == 0 ? 1 : row[2], 0, &s->glass, &inner);
    if (status == WO_OK)
        status = wo_surface_check(s, &inner);
    if (status != WO_OK)
        return wo_lines_fail(lines, status, "%s", inner.text);
    lens->count++;
    return WO_OK;
}

wo_status wo_dat_read(wo_lines *lines, wo_prescription *lens)
{
    while (wo_lines_next(lines))
        if (wo_lines_more(lines))
            WO_TRY(read_row(lines, lens));
    return WO_OK;
}
