/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "prescription_private.h"

#include "base/number.h"

#include <math.h>
#include <string.h>

typedef struct printer {
    char *text;
    size_t size;
    size_t length; /* with what had no room */
} printer;

static void put(printer *out, const char *text)
{
    for (; *text; text++, out->length++)
        if (out->length + 1 < out->size)
            out->text[out->length] = *text;
}

static void put_number(printer *out, const char *before, double value)
{
    char number[WO_NUMBER_SIZE];
    wo_number_print(value, number);
    put(out, before);
    put(out, number);
}

static void put_text(printer *out, const char *keyword, const char *text)
{
    if (!text[0])
        return;
    put(out, keyword);
    put(out, text);
    put(out, "\n");
}

static void put_value(printer *out, const char *keyword, double value)
{
    if (value == 0)
        return;
    put_number(out, keyword, value);
    put(out, "\n");
}

/* The shortest radius that has this curvature; the curvature where no radius has it. */
static void put_shape(printer *out, double curvature)
{
    if (curvature == 0) {
        put(out, " 0");
        return;
    }
    char best[WO_NUMBER_SIZE] = "";
    double radius = 1 / curvature;
    for (int i = 0; i < 2; i++)
        radius = nextafter(radius, -INFINITY);
    for (int i = -2; i <= 2; i++, radius = nextafter(radius, INFINITY)) {
        char number[WO_NUMBER_SIZE];
        if (!(fabs(radius) <= WO_RADIUS_MAX) || 1 / radius != curvature)
            continue;
        wo_number_print(radius, number);
        if (!best[0] || strlen(number) < strlen(best))
            memcpy(best, number, sizeof best);
    }
    if (!best[0]) {
        put_number(out, " c=", curvature);
        return;
    }
    put(out, " ");
    put(out, best);
}

static void put_medium(printer *out, const wo_glass *glass)
{
    if (glass->kind == WO_DISPERSION_NONE && glass->nd == 1) {
        put(out, " air");
    } else if (glass->kind == WO_DISPERSION_NONE) {
        put_number(out, " ", glass->nd);
    } else if (glass->kind == WO_DISPERSION_ABBE) {
        put_number(out, " ", glass->nd);
        put_number(out, "/", glass->vd);
    } else {
        put(out, " ");
        put(out, glass->name);
    }
}

static void put_surface(printer *out, const wo_surface *s)
{
    static const char *const terms[WO_ASPHERE_MAX] = {
        " A2=", " A4=", " A6=", " A8=", " A10=", " A12=", " A14=", " A16="};
    put(out, "surface");
    put_shape(out, s->curvature);
    put_number(out, " ", s->thickness);
    put_medium(out, &s->glass);
    put_number(out, " ", s->semi_aperture);
    if (s->stop)
        put(out, " stop");
    if (s->conic != 0)
        put_number(out, " k=", s->conic);
    for (int i = 0; i < s->asphere_terms && i < WO_ASPHERE_MAX; i++)
        if (s->asphere[i] != 0 || i + 1 == s->asphere_terms)
            put_number(out, terms[i], s->asphere[i]);
    if (s->meridian != WO_MERIDIAN_BOTH)
        put(out, s->meridian == WO_MERIDIAN_X ? " cylinder=x" : " cylinder=y");
    put(out, "\n");
}

/* The glasses that are not in the catalogue, each once. */
static void put_glasses(printer *out, const wo_prescription *lens, int count)
{
    for (int i = 0; i < count; i++) {
        const wo_glass *const glass = &lens->surface[i].glass;
        bool again = !wo_glass_own(glass);
        for (int j = 0; j < i && !again; j++)
            again = wo_glass_name_is(lens->surface[j].glass.name, glass->name);
        if (again)
            continue;
        put(out, "glass ");
        put(out, glass->name);
        put(out, glass->kind == WO_DISPERSION_SELLMEIER ? " sellmeier" : " schott");
        for (int k = 0; k < 6; k++)
            put_number(out, " ", glass->a[k]);
        put_number(out, " ", glass->low_nm);
        put_number(out, " ", glass->high_nm);
        put(out, "\n");
    }
}

size_t wo_prescription_print(const wo_prescription *lens, char *text, size_t size)
{
    const int count = lens->count < WO_SURFACES_MAX ? lens->count : WO_SURFACES_MAX;
    printer out = {text, size, 0};
    put(&out, "lens 1\n");
    put_text(&out, "name ", lens->name);
    put_text(&out, "title ", lens->title);
    put_text(&out, "source ", lens->source);
    put_value(&out, "focal ", lens->focal_mm);
    put_value(&out, "fnumber ", lens->f_number);
    put_value(&out, "field ", lens->half_field);
    put_glasses(&out, lens, count);
    for (int i = 0; i < count; i++)
        put_surface(&out, &lens->surface[i]);
    if (size > 0)
        text[out.length < size ? out.length : size - 1] = '\0';
    return out.length;
}
