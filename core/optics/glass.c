/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "prescription_private.h"

#include "base/number.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Wavelengths a formula may be said to hold for, and those of Abbe's model. */
#define NM_LOW       100.0
#define NM_HIGH      1e5
#define ABBE_NM_LOW  350.0
#define ABBE_NM_HIGH 1100.0

static const wo_glass catalogue[] = {
#define GLASS(label, index, abbe, b1, b2, b3, c1, c2, c3, low, high)                               \
    {.name = label,                                                                                \
     .kind = WO_DISPERSION_SELLMEIER,                                                              \
     .nd = index,                                                                                  \
     .vd = abbe,                                                                                   \
     .a = {b1, b2, b3, c1, c2, c3},                                                                \
     .low_nm = low,                                                                                \
     .high_nm = high},
#include "glass_catalogue.inc"
#undef GLASS
};

const wo_glass *wo_glass_at(size_t index)
{
    return index < WO_COUNT(catalogue) ? &catalogue[index] : NULL;
}

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

bool wo_glass_name_is(const char *a, const char *b)
{
    for (; *a && lower(*a) == lower(*b); a++, b++)
        ;
    return *a == *b;
}

const wo_glass *wo_glass_find(const char *name)
{
    for (size_t i = 0; i < WO_COUNT(catalogue); i++)
        if (wo_glass_name_is(catalogue[i].name, name))
            return &catalogue[i];
    return NULL;
}

bool wo_glass_same(const wo_glass *a, const wo_glass *b)
{
    bool same = strcmp(a->name, b->name) == 0 && a->kind == b->kind && a->nd == b->nd &&
                a->vd == b->vd && a->low_nm == b->low_nm && a->high_nm == b->high_nm;
    for (int i = 0; i < 6; i++)
        same = same && a->a[i] == b->a[i];
    return same;
}

static wo_glass constant(double nd)
{
    wo_glass glass;
    memset(&glass, 0, sizeof glass);
    glass.kind = WO_DISPERSION_NONE;
    glass.nd = nd;
    glass.low_nm = NM_LOW;
    glass.high_nm = NM_HIGH;
    return glass;
}

wo_glass wo_glass_air(void)
{
    wo_glass glass = constant(1);
    strcpy(glass.name, "air");
    return glass;
}

/* nd, or nd/vd, to as many digits as catalogues have. */
static void name_by_numbers(wo_glass *glass)
{
    char nd[WO_NUMBER_SIZE], vd[WO_NUMBER_SIZE];
    wo_number_print(round(glass->nd * 1e6) / 1e6, nd);
    wo_number_print(round(glass->vd * 1e3) / 1e3, vd);
    if (glass->vd == 0)
        snprintf(glass->name, sizeof glass->name, "%.12s", nd);
    else
        snprintf(glass->name, sizeof glass->name, "%.12s/%.12s", nd, vd);
}

wo_status wo_glass_abbe(double nd, double vd, wo_glass *glass, wo_error *error)
{
    *glass = wo_glass_air();
    if (!(nd >= 1 && nd <= 4))
        return wo_fail(error, WO_ERR_RANGE, "refractive index %g: must be 1..4", nd);
    if (!((vd >= 5 && vd <= 200) || vd == 0))
        return wo_fail(error, WO_ERR_RANGE, "Abbe number %g: must be 5..200, or 0 for none", vd);
    if (nd == 1 && vd == 0)
        return WO_OK;
    *glass = constant(nd);
    if (vd != 0) {
        glass->kind = WO_DISPERSION_ABBE;
        glass->vd = vd;
        glass->low_nm = ABBE_NM_LOW;
        glass->high_nm = ABBE_NM_HIGH;
    }
    name_by_numbers(glass);
    return WO_OK;
}

static double per_square(double nm)
{
    return 1e6 / (nm * nm);
}

/* Not limited to 1..4, and not a number where the formula has a pole or a negative square. */
static double formula(const wo_glass *glass, double nm)
{
    const double *const a = glass->a;
    const double l2 = nm * nm * 1e-6;
    switch (glass->kind) {
    case WO_DISPERSION_ABBE: {
        const double b = (glass->nd - 1) / glass->vd / (per_square(WO_NM_F) - per_square(WO_NM_C));
        return glass->nd + b * (per_square(nm) - per_square(WO_NM_D));
    }
    case WO_DISPERSION_SELLMEIER:
        return sqrt(1 + a[0] * l2 / (l2 - a[3]) + a[1] * l2 / (l2 - a[4]) +
                    a[2] * l2 / (l2 - a[5]));
    case WO_DISPERSION_SCHOTT: {
        const double i2 = 1 / l2;
        return sqrt(a[0] + a[1] * l2 + i2 * (a[2] + i2 * (a[3] + i2 * (a[4] + i2 * a[5]))));
    }
    case WO_DISPERSION_NONE:
        break;
    }
    return glass->nd;
}

double wo_glass_index(const wo_glass *glass, double nm, bool *clamped)
{
    double at = isnan(nm) ? WO_NM_D : nm;
    if (glass->kind != WO_DISPERSION_NONE && !(at >= glass->low_nm && at <= glass->high_nm)) {
        at = at < glass->low_nm ? glass->low_nm : glass->high_nm;
        if (clamped)
            *clamped = true;
    }
    const double n = formula(glass, at);
    if (!(n >= 1))
        return 1;
    return n > 4 ? 4 : n;
}

bool wo_glass_name_legal(const char *name)
{
    size_t length = 0;
    for (; name[length]; length++) {
        const char c = lower(name[length]);
        const bool letter = c >= 'a' && c <= 'z';
        const bool other = (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.' || c == '+';
        if (!letter && (length == 0 || !other))
            return false;
    }
    return length > 0 && length < sizeof((wo_glass *)0)->name && !wo_glass_name_is(name, "air") &&
           !wo_glass_name_is(name, "inf") && !wo_glass_name_is(name, "nan");
}

static wo_status check_samples(const wo_glass *glass, wo_error *error)
{
    enum { STEPS = 2000 };
    for (int i = 0; i <= STEPS; i++) {
        const double nm =
            i == STEPS ? glass->high_nm
                       : glass->low_nm + (glass->high_nm - glass->low_nm) * (double)i / STEPS;
        const double n = formula(glass, nm);
        if (!(n >= 1 && n <= 4))
            return wo_fail(error, WO_ERR_RANGE,
                           "glass %s has the refractive index %g at %g nm: must be 1..4",
                           glass->name, n, nm);
    }
    return WO_OK;
}

wo_status wo_glass_formula(const char *name, wo_dispersion kind, const double a[6], double low_nm,
                           double high_nm, wo_glass *glass, wo_error *error)
{
    *glass = wo_glass_air();
    if (!name || !wo_glass_name_legal(name))
        return wo_fail(error, WO_ERR_ARGUMENT,
                       "the name of a glass: must be a letter and up to 30 letters, digits, or any "
                       "of - _ . +, and none of air, inf, nan");
    if (kind != WO_DISPERSION_SELLMEIER && kind != WO_DISPERSION_SCHOTT)
        return wo_fail(error, WO_ERR_ARGUMENT,
                       "glass %s: must be of Sellmeier's or Schott's formula", name);
    if (!(low_nm >= NM_LOW && high_nm <= NM_HIGH && low_nm < high_nm))
        return wo_fail(error, WO_ERR_RANGE,
                       "glass %s holds for %g..%g nm: must be a range within %g..%g", name, low_nm,
                       high_nm, NM_LOW, NM_HIGH);
    wo_glass made = constant(1);
    made.kind = kind;
    made.low_nm = low_nm;
    made.high_nm = high_nm;
    memcpy(made.a, a, sizeof made.a);
    strcpy(made.name, name);
    for (int i = 0; i < 6; i++)
        if (!isfinite(a[i]))
            return wo_fail(error, WO_ERR_RANGE, "coefficient %d of glass %s: must be finite", i + 1,
                           name);
    for (int i = 3; i < 6 && kind == WO_DISPERSION_SELLMEIER; i++)
        if (a[i] >= low_nm * low_nm * 1e-6 && a[i] <= high_nm * high_nm * 1e-6)
            return wo_fail(error, WO_ERR_RANGE,
                           "glass %s: C%d = %g um^2 is a pole at %g nm, within %g..%g", name, i - 2,
                           a[i], 1e3 * sqrt(a[i]), low_nm, high_nm);
    WO_TRY(check_samples(&made, error));

    made.nd = wo_glass_index(&made, WO_NM_D, NULL);
    const double spread =
        wo_glass_index(&made, WO_NM_F, NULL) - wo_glass_index(&made, WO_NM_C, NULL);
    made.vd = spread > 0 ? (made.nd - 1) / spread : 0;
    *glass = made;
    return WO_OK;
}

wo_status wo_glass_check(const wo_glass *glass, wo_error *error)
{
    wo_glass made;
    const wo_glass *want = &made;
    if (!memchr(glass->name, '\0', sizeof glass->name))
        return wo_fail(error, WO_ERR_ARGUMENT, "the name of a glass: must end within its field");
    switch (glass->kind) {
    case WO_DISPERSION_NONE:
    case WO_DISPERSION_ABBE:
        WO_TRY(wo_glass_abbe(glass->nd, glass->vd, &made, error));
        break;
    default:
        want = wo_glass_find(glass->name);
        if (!want) {
            WO_TRY(wo_glass_formula(glass->name, glass->kind, glass->a, glass->low_nm,
                                    glass->high_nm, &made, error));
            want = &made;
        }
    }
    if (!wo_glass_same(want, glass))
        return wo_fail(error, WO_ERR_ARGUMENT,
                       "glass \"%s\": must be one of the catalogue, or as wo_glass_abbe or "
                       "wo_glass_formula make it",
                       glass->name);
    return WO_OK;
}
