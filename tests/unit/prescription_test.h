/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TESTS_PRESCRIPTION_TEST_H
#define WO_TESTS_PRESCRIPTION_TEST_H

#include "wideopen/prescription.h"

#include "near.h"

#include <string.h>

enum { LENS_TEXT_SIZE = 64 * 1024 };

static inline bool same_surface(const wo_surface *a, const wo_surface *b)
{
    bool same = a->curvature == b->curvature && a->conic == b->conic &&
                a->asphere_terms == b->asphere_terms && a->thickness == b->thickness &&
                a->semi_aperture == b->semi_aperture && a->meridian == b->meridian &&
                a->stop == b->stop;
    for (int i = 0; i < WO_ASPHERE_MAX; i++)
        same = same && a->asphere[i] == b->asphere[i];
    const wo_glass *const g = &a->glass, *const h = &b->glass;
    for (int i = 0; i < 6; i++)
        same = same && g->a[i] == h->a[i];
    return same && strcmp(g->name, h->name) == 0 && g->kind == h->kind && g->nd == h->nd &&
           g->vd == h->vd && g->low_nm == h->low_nm && g->high_nm == h->high_nm;
}

/* The first member that differs, or NULL. */
static inline const char *difference(const wo_prescription *a, const wo_prescription *b)
{
    if (strcmp(a->name, b->name) != 0)
        return "name";
    if (strcmp(a->title, b->title) != 0)
        return "title";
    if (strcmp(a->source, b->source) != 0)
        return "source";
    if (a->focal_mm != b->focal_mm || a->f_number != b->f_number || a->half_field != b->half_field)
        return "a number of the header";
    if (a->count != b->count || a->stop != b->stop)
        return "count or stop";
    for (int i = 0; i < a->count; i++)
        if (!same_surface(&a->surface[i], &b->surface[i]))
            return "a surface";
    return NULL;
}

/* What is wrong with lens once it is printed and read again, or NULL. */
static inline const char *round_trip(const wo_prescription *lens, wo_error *error)
{
    static char text[LENS_TEXT_SIZE];
    wo_prescription again;
    const size_t length = wo_prescription_print(lens, text, sizeof text);
    if (length >= sizeof text || strlen(text) != length)
        return "the length";
    if (wo_prescription_parse(text, length, "again", &again, error) != WO_OK)
        return error->text;
    return difference(lens, &again);
}

static inline wo_prescription parse_as(const char *text, const char *name)
{
    wo_error error = {WO_OK, ""};
    wo_prescription lens;
    if (wo_prescription_parse(text, strlen(text), name, &lens, &error) != WO_OK)
        fail_msg("%s", error.text);
    return lens;
}

static inline wo_prescription builtin(const char *name)
{
    wo_error error = {WO_OK, ""};
    wo_prescription lens;
    if (wo_lens_find(name, &lens, &error) != WO_OK)
        fail_msg("%s", error.text);
    return lens;
}

#endif
