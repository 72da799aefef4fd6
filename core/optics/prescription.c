/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "prescription_private.h"

#include <math.h>
#include <string.h>

#define CURVATURE_MAX     10.0
#define THICKNESS_MIN     (-1e4)
#define THICKNESS_MAX     1e5
#define SEMI_APERTURE_MAX 1e5
#define CONIC_MAX         1e6
#define ASPHERE_MAX       1e6
#define FOCAL_MAX         1e5
#define F_NUMBER_MIN      0.1
#define F_NUMBER_MAX      1e3
#define HALF_FIELD_MAX    150.0

bool wo_lens_name_legal(const char *name)
{
    size_t length = 0;
    for (; name[length]; length++) {
        const char c = name[length];
        if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
              c == '_' || c == '-'))
            return false;
    }
    return length > 0 && length < sizeof((wo_prescription *)0)->name;
}

/* Length of the UTF-8 character at text, 0 if it is none or a control character. */
static size_t character(const unsigned char *text, size_t bytes)
{
    static const unsigned lowest[] = {0, 0, 0xa0, 0x800, 0x10000};
    const size_t length = text[0] < 0x80             ? 1
                          : (text[0] & 0xe0) == 0xc0 ? 2
                          : (text[0] & 0xf0) == 0xe0 ? 3
                          : (text[0] & 0xf8) == 0xf0 ? 4
                                                     : 0;
    if (length < 2)
        return text[0] >= 0x20 && text[0] != 0x7f ? length : 0;
    if (length > bytes)
        return 0;
    unsigned code = text[0] & (0x7fu >> length);
    for (size_t i = 1; i < length; i++) {
        if ((text[i] & 0xc0) != 0x80)
            return 0;
        code = code << 6 | (text[i] & 0x3f);
    }
    const bool surrogate = code >= 0xd800 && code <= 0xdfff;
    return code >= lowest[length] && code <= 0x10ffff && !surrogate ? length : 0;
}

wo_status wo_line_check(const char *text, size_t bytes, size_t most, const char *what,
                        wo_error *error)
{
    if (bytes > most)
        return wo_fail(error, WO_ERR_RANGE, "%s of %zu bytes: must be at most %zu", what, bytes,
                       most);
    for (size_t at = 0; at < bytes;) {
        const size_t length = character((const unsigned char *)text + at, bytes - at);
        if (length == 0)
            return wo_fail(error, WO_ERR_FORMAT,
                           "%s, byte %zu is 0x%02x: must be UTF-8 without control characters", what,
                           at + 1, (unsigned)(unsigned char)text[at]);
        at += length;
    }
    if (bytes > 0 && (text[0] == ' ' || text[bytes - 1] == ' '))
        return wo_fail(error, WO_ERR_FORMAT, "%s: must not begin or end with a blank", what);
    return WO_OK;
}

static wo_status check_field(const char *text, size_t size, const char *what, wo_error *error)
{
    const char *const end = memchr(text, '\0', size);
    return wo_line_check(text, end ? (size_t)(end - text) : size, size - 1, what, error);
}

wo_status wo_lens_header_check(const wo_prescription *lens, wo_error *error)
{
    if (lens->name[0] &&
        (!memchr(lens->name, '\0', sizeof lens->name) || !wo_lens_name_legal(lens->name)))
        return wo_fail(error, WO_ERR_FORMAT,
                       "the lens's name: must be 1..%zu letters, digits, _ and -",
                       sizeof lens->name - 1);
    WO_TRY(check_field(lens->title, sizeof lens->title, "title", error));
    WO_TRY(check_field(lens->source, sizeof lens->source, "source", error));
    if (!(lens->focal_mm >= 0 && lens->focal_mm <= FOCAL_MAX))
        return wo_fail(error, WO_ERR_RANGE, "focal length %g mm: must be 0 (not said) to %g",
                       lens->focal_mm, FOCAL_MAX);
    if (!((lens->f_number >= F_NUMBER_MIN && lens->f_number <= F_NUMBER_MAX) ||
          lens->f_number == 0))
        return wo_fail(error, WO_ERR_RANGE, "f-number %g: must be %g..%g, or 0 (not said)",
                       lens->f_number, F_NUMBER_MIN, F_NUMBER_MAX);
    if (!(lens->half_field >= 0 && lens->half_field <= HALF_FIELD_MAX))
        return wo_fail(error, WO_ERR_RANGE, "half field %g degrees: must be 0 (not said) to %g",
                       lens->half_field, HALF_FIELD_MAX);
    return WO_OK;
}

wo_status wo_surface_check(const wo_surface *s, wo_error *error)
{
    if (!(fabs(s->curvature) <= CURVATURE_MAX))
        return wo_fail(error, WO_ERR_RANGE,
                       "curvature %g /mm: must be %g..%g (a radius of 0 or inf is a plane)",
                       s->curvature, -CURVATURE_MAX, CURVATURE_MAX);
    if (!(s->thickness >= THICKNESS_MIN && s->thickness <= THICKNESS_MAX))
        return wo_fail(error, WO_ERR_RANGE, "thickness %g mm: must be %g..%g", s->thickness,
                       THICKNESS_MIN, THICKNESS_MAX);
    if (!(s->semi_aperture >= 0 && s->semi_aperture <= SEMI_APERTURE_MAX))
        return wo_fail(error, WO_ERR_RANGE, "semi-aperture %g mm: must be 0 (unlimited) to %g",
                       s->semi_aperture, SEMI_APERTURE_MAX);
    if (s->stop && s->semi_aperture == 0)
        return wo_fail(error, WO_ERR_RANGE,
                       "semi-aperture 0 at the stop: must be the radius of the iris fully open");
    if (!(fabs(s->conic) <= CONIC_MAX))
        return wo_fail(error, WO_ERR_RANGE, "conic constant %g: must be %g..%g", s->conic,
                       -CONIC_MAX, CONIC_MAX);
    if (!(s->asphere_terms >= 0 && s->asphere_terms <= WO_ASPHERE_MAX))
        return wo_fail(error, WO_ERR_RANGE, "%d aspheric terms: must be 0..%d", s->asphere_terms,
                       WO_ASPHERE_MAX);
    for (int i = 0; i < WO_ASPHERE_MAX; i++)
        if (!(fabs(s->asphere[i]) <= ASPHERE_MAX) || (i >= s->asphere_terms && s->asphere[i] != 0))
            return wo_fail(error, WO_ERR_RANGE,
                           "A%d = %g: must be %g..%g, and 0 beyond the terms that count", 2 * i + 2,
                           s->asphere[i], -ASPHERE_MAX, ASPHERE_MAX);
    if (s->meridian != WO_MERIDIAN_BOTH && s->meridian != WO_MERIDIAN_X &&
        s->meridian != WO_MERIDIAN_Y)
        return wo_fail(error, WO_ERR_ARGUMENT, "meridian %d: must be both, x or y",
                       (int)s->meridian);
    return wo_glass_check(&s->glass, error);
}

bool wo_glass_own(const wo_glass *glass)
{
    return (glass->kind == WO_DISPERSION_SELLMEIER || glass->kind == WO_DISPERSION_SCHOTT) &&
           !wo_glass_find(glass->name);
}

/* Glasses of one name must be one glass: the text names them. */
static wo_status check_names(const wo_prescription *lens, int index, wo_error *error)
{
    const wo_glass *const glass = &lens->surface[index].glass;
    for (int i = 0; i < index && wo_glass_own(glass); i++) {
        const wo_glass *const other = &lens->surface[i].glass;
        if (wo_glass_own(other) && wo_glass_name_is(glass->name, other->name) &&
            !wo_glass_same(glass, other))
            return wo_fail(error, WO_ERR_ARGUMENT,
                           "surfaces %d and %d: two glasses must not share the name %s", i + 1,
                           index + 1, glass->name);
    }
    return WO_OK;
}

/* Does light change its direction somewhere? */
static bool has_power(const wo_prescription *lens)
{
    double before = 1;
    for (int i = 0; i < lens->count; i++) {
        const wo_surface *const s = &lens->surface[i];
        bool curved = s->curvature != 0;
        for (int k = 0; k < s->asphere_terms; k++)
            curved = curved || s->asphere[k] != 0;
        if (curved && s->glass.nd != before)
            return true;
        before = s->glass.nd;
    }
    return false;
}

wo_status wo_prescription_validate(const wo_prescription *lens, wo_error *error)
{
    WO_TRY(wo_lens_header_check(lens, error));
    if (!lens->name[0])
        return wo_fail(error, WO_ERR_ARGUMENT, "the lens has no name: must have one");
    if (!(lens->count >= 1 && lens->count <= WO_SURFACES_MAX))
        return wo_fail(error, WO_ERR_RANGE, "%d surfaces: must be 1..%d", lens->count,
                       WO_SURFACES_MAX);
    int stops = 0;
    for (int i = 0; i < lens->count; i++) {
        wo_error inner;
        const wo_status status = wo_surface_check(&lens->surface[i], &inner);
        if (status != WO_OK)
            return wo_fail(error, status, "surface %d: %s", i + 1, inner.text);
        WO_TRY(check_names(lens, i, error));
        stops += lens->surface[i].stop;
    }
    if (stops != 1)
        return wo_fail(error, WO_ERR_FORMAT, "%d surfaces are the stop: must be exactly one",
                       stops);
    if (!(lens->stop >= 0 && lens->stop < lens->count && lens->surface[lens->stop].stop))
        return wo_fail(error, WO_ERR_ARGUMENT, "stop %d: must be the index of the stop",
                       lens->stop);
    if (!has_power(lens))
        return wo_fail(error, WO_ERR_FORMAT,
                       "no surface has power: must have a curved one between two media");
    return WO_OK;
}

void wo_prescription_scale(wo_prescription *lens, double factor)
{
    if (!(factor > 0 && isfinite(factor)))
        return;
    lens->focal_mm *= factor;
    for (int i = 0; i < lens->count && i < WO_SURFACES_MAX; i++) {
        wo_surface *const s = &lens->surface[i];
        s->curvature /= factor;
        s->thickness *= factor;
        s->semi_aperture *= factor;
        double per = 1 / factor;
        for (int k = 0; k < WO_ASPHERE_MAX; k++, per /= factor * factor)
            s->asphere[k] *= per;
    }
}

const char *wo_lens_name_at(size_t index)
{
    return index < wo_lens_text_count ? wo_lens_texts[index].name : NULL;
}

wo_status wo_lens_find(const char *name, wo_prescription *lens, wo_error *error)
{
    memset(lens, 0, sizeof *lens);
    for (size_t i = 0; i < wo_lens_text_count; i++) {
        const wo_lens_text *const found = &wo_lens_texts[i];
        if (strcmp(found->name, name) == 0)
            return wo_prescription_parse(found->text, strlen(found->text), name, lens, error);
    }
    return wo_fail(
        error, WO_ERR_NOT_FOUND, "no lens is called \"%.64s\": there are %zu, from %s to %s", name,
        wo_lens_text_count, wo_lens_texts[0].name, wo_lens_texts[wo_lens_text_count - 1].name);
}
