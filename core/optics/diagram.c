/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/lens_diagram.h"

#include <math.h>

/* Where a zone of power phi' instead of phi focuses: the sensor stays where it is, so 1/s' = phi -
   v gives v' - v = phi' - phi. A zone that brings a distant object to a focus dz behind the
   paraxial focus has phi' = 1 / (f + dz), so its shift is -dz / (f (f + dz)): short focus, positive
   shift, nearer objects in focus. The presets are tables of f * shift, which no scaling of a lens
   changes.

   Colour is that of thin lenses of real glasses: f * shift = sum p_j (n_j - n_jd) / (n_jd - 1) with
   p_j the share of the power, 1 for a singlet and what unites F and C for a pair of glasses.
   Spherical aberration is sum (s_i + t_i x) rho^2i with x = (n - n_d) / (n_F - n_C) of N-BK7,
   traced exactly at the f-number n_ref and scaled by (n_ref / N)^2. In the corrected types the
   spherochromatism t is balanced as designers do, F and C meeting in the zone of half the area; the
   traced AC508-250-A does: its paraxial F - C is 65e-5 where this gives 58e-5. */

enum { TERMS = 3 };

typedef struct preset {
    const char *first, *second; /* NULL: none */
    double n_ref;
    double s[TERMS], t[TERMS];
} preset;

static const preset presets[WO_DIAGRAM_PRESET_COUNT] = {
    [WO_DIAGRAM_PERFECT] = {NULL, NULL, 1, {0}, {0}},
    /* Thorlabs biconvex N-BK7, f 50, full aperture */
    [WO_DIAGRAM_SPHERICAL] =
        {"N-BK7", NULL, 1.9617, {9988e-5, 872e-5, 191e-5}, {185e-5, 28e-5, 15e-5}},
    /* plano-hyperbolic N-BK7: no spherical aberration at d by its shape */
    [WO_DIAGRAM_ASPHERICAL] = {"N-BK7", NULL, 1.9617, {0}, {-250e-5, 58e-5, -10e-5}},
    /* Thorlabs AC508-250-A, N-BK7 and SF2, bent until its marginal rays, too, focus short: the
       bending adds primary aberration of all colours alike */
    [WO_DIAGRAM_ACHROMAT_A] =
        {"N-BK7", "SF2", 4.922, {112e-5, -83e-5, -10e-5}, {-110e-5, -11e-5, -1e-5}},
    /* the same as it is sold: the zone at 0.7 focuses with the paraxial rays */
    [WO_DIAGRAM_ACHROMAT_B] =
        {"N-BK7", "SF2", 4.922, {44e-5, -83e-5, -10e-5}, {-110e-5, -11e-5, -1e-5}},
    /* colour of S-FPL53 with N-BK7, zones of the fluorite zoom of US 5,537,259 (Canon) */
    [WO_DIAGRAM_APOCHROMAT] =
        {"S-FPL53", "N-BK7", 2.9, {-23e-5, 66e-5, -42e-5}, {52e-5, -11e-5, -15e-5}},
};

static const double line_nm[WO_DIAGRAM_LINES] = {400, 410, 422, 435.83,  450, 467, WO_NM_F, 506,
                                                 526, 546, 566, WO_NM_D, 610, 633, WO_NM_C, 700};

/* Change of power of a thin lens of power 1. */
static double colour_power(const wo_glass *g, double nm)
{
    const double nd = wo_glass_index(g, WO_NM_D, NULL);
    return (wo_glass_index(g, nm, NULL) - nd) / (nd - 1);
}

/* 1 / Abbe number */
static double dispersion(const wo_glass *g)
{
    return colour_power(g, WO_NM_F) - colour_power(g, WO_NM_C);
}

static double colour_of(const preset *p, double nm)
{
    if (!p->first)
        return 0;
    const wo_glass *const a = wo_glass_find(p->first);
    if (!p->second)
        return colour_power(a, nm);
    const wo_glass *const b = wo_glass_find(p->second);
    const double va = 1 / dispersion(a);
    const double vb = 1 / dispersion(b);
    return (va * colour_power(a, nm) - vb * colour_power(b, nm)) / (va - vb);
}

static double even_polynomial(const double a[TERMS], double rho2)
{
    double sum = 0;
    for (int i = TERMS - 1; i >= 0; i--)
        sum = (sum + a[i]) * rho2;
    return sum;
}

wo_status wo_diagram_make(wo_diagram_preset type, double focal_mm, double f_number, double residual,
                          wo_diagram *diagram, wo_error *error)
{
    *diagram = (wo_diagram){0};
    if ((int)type < 0 || type >= WO_DIAGRAM_PRESET_COUNT)
        return wo_fail(error, WO_ERR_ARGUMENT, "aberration preset %d: must be 0..%d", (int)type,
                       WO_DIAGRAM_PRESET_COUNT - 1);
    if (!(focal_mm >= 1 && focal_mm <= 1e6))
        return wo_fail(error, WO_ERR_RANGE, "focal length %g mm: must be 1..1e6", focal_mm);
    if (!(f_number >= 0.5 && f_number <= 1e3))
        return wo_fail(error, WO_ERR_RANGE, "f-number %g: must be 0.5..1000", f_number);
    if (!(residual >= 0 && residual <= 10))
        return wo_fail(error, WO_ERR_RANGE, "residual aberration %g: must be 0..10", residual);
    const preset *const p = &presets[type];
    const double scale = residual * 1e3 / focal_mm;
    const double aperture = p->n_ref / f_number * (p->n_ref / f_number);
    const wo_glass *const crown = wo_glass_find("N-BK7");
    const double balance = p->second ? even_polynomial(p->t, 0.5) : 0;
    diagram->zones = WO_DIAGRAM_ZONES;
    diagram->lines = WO_DIAGRAM_LINES;
    diagram->radius = focal_mm / (2 * f_number);
    for (int l = 0; l < diagram->lines; l++) {
        const double x = colour_power(crown, line_nm[l]) / dispersion(crown);
        const double colour = colour_of(p, line_nm[l]);
        diagram->nm[l] = line_nm[l];
        for (int i = 0; i < diagram->zones; i++) {
            const double rho = (double)i / (diagram->zones - 1);
            const double zone =
                even_polynomial(p->s, rho * rho) + x * (even_polynomial(p->t, rho * rho) - balance);
            diagram->shift[l][i] = scale * (colour + aperture * zone);
        }
    }
    return WO_OK;
}

/* Slope at zone i, per zone: limited so that no interval overshoots (Fritsch and Butland 1984); the
   diagram is even in rho and ends at 1. */
static double zone_slope(const double *y, int zones, int i)
{
    if (i == 0)
        return 0;
    const double before = y[i] - y[i - 1];
    if (i == zones - 1) {
        if (zones == 2)
            return 2 * before;
        const double slope = 1.5 * before - 0.5 * (y[i - 1] - y[i - 2]);
        if (!(slope * before > 0))
            return 0;
        return fabs(slope) > 3 * fabs(before) ? 3 * before : slope;
    }
    const double after = y[i + 1] - y[i];
    if ((before > 0) != (after > 0) || before == 0 || after == 0)
        return 0;
    return 2 / (1 / before + 1 / after);
}

static double at_zone(const double *y, int zones, double rho)
{
    const double x = rho * (zones - 1);
    const int i = x < zones - 2 ? (int)x : zones - 2;
    const double t = x - i;
    const double m0 = zone_slope(y, zones, i), m1 = zone_slope(y, zones, i + 1);
    const double step = y[i + 1] - y[i];
    return y[i] + t * (m0 + t * (3 * step - 2 * m0 - m1 + t * (m0 + m1 - 2 * step)));
}

double wo_diagram_at(const wo_diagram *diagram, double rho, double nm)
{
    const int last = diagram->lines - 1;
    const double *const lines = diagram->nm;
    rho = rho > 0 ? fmin(rho, 1) : 0;
    if (!(nm > lines[0]))
        return at_zone(diagram->shift[0], diagram->zones, rho);
    if (nm >= lines[last])
        return at_zone(diagram->shift[last], diagram->zones, rho);
    int l = 0;
    while (nm >= lines[l + 1])
        l++;
    const double t = (nm - lines[l]) / (lines[l + 1] - lines[l]);
    return (1 - t) * at_zone(diagram->shift[l], diagram->zones, rho) +
           t * at_zone(diagram->shift[l + 1], diagram->zones, rho);
}

wo_status wo_diagram_validate(const wo_diagram *diagram, wo_error *error)
{
    if (!(diagram->zones >= 2 && diagram->zones <= WO_DIAGRAM_ZONES))
        return wo_fail(error, WO_ERR_RANGE, "aberration diagram of %d zones: must be 2..%d",
                       diagram->zones, WO_DIAGRAM_ZONES);
    if (!(diagram->lines >= 1 && diagram->lines <= WO_DIAGRAM_LINES))
        return wo_fail(error, WO_ERR_RANGE, "aberration diagram of %d wavelengths: must be 1..%d",
                       diagram->lines, WO_DIAGRAM_LINES);
    if (!(diagram->radius >= 0 && isfinite(diagram->radius)))
        return wo_fail(error, WO_ERR_RANGE,
                       "pupil radius of the aberration diagram is %g mm: must be 0 (not said) or "
                       "above",
                       diagram->radius);
    for (int l = 0; l < diagram->lines; l++) {
        if (!(diagram->nm[l] >= WO_DIAGRAM_NM_MIN && diagram->nm[l] <= WO_DIAGRAM_NM_MAX))
            return wo_fail(error, WO_ERR_RANGE,
                           "wavelength %d of the aberration diagram is %g nm: must be %g..%g", l,
                           diagram->nm[l], WO_DIAGRAM_NM_MIN, WO_DIAGRAM_NM_MAX);
        if (l > 0 && !(diagram->nm[l] > diagram->nm[l - 1]))
            return wo_fail(error, WO_ERR_RANGE,
                           "wavelengths of the aberration diagram must rise: %g nm follows %g nm",
                           diagram->nm[l], diagram->nm[l - 1]);
        for (int i = 0; i < diagram->zones; i++)
            if (!(fabs(diagram->shift[l][i]) <= WO_DIAGRAM_SHIFT_MAX))
                return wo_fail(error, WO_ERR_RANGE,
                               "shift of zone %d at %g nm is %g dioptres: must be within %g", i,
                               diagram->nm[l], diagram->shift[l][i], WO_DIAGRAM_SHIFT_MAX);
    }
    return WO_OK;
}
