/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "lines.h"
#include "prescription_private.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { GLASSES_MAX = 64, BYTES_MAX = 1 << 20 };

#define RADIUS_MIN 0.1

typedef struct parser {
    wo_lines *lines;
    wo_prescription *lens;
    unsigned seen; /* one bit for each keyword */
    int glasses;
    wo_glass glass[GLASSES_MAX];
} parser;

static wo_status pass(const parser *p, wo_status status, const wo_error *inner)
{
    return status == WO_OK ? WO_OK : wo_lines_fail(p->lines, status, "%s", inner->text);
}

static wo_status read_version(parser *p)
{
    double version;
    WO_TRY(wo_lines_number(p->lines, "the version of the format", &version));
    if (version != 1)
        return wo_lines_fail(p->lines, WO_ERR_UNSUPPORTED, "version %g of the format: must be 1",
                             version);
    return WO_OK;
}

static wo_status read_name(parser *p)
{
    char word[WO_WORD_SIZE];
    _Static_assert(sizeof word == sizeof p->lens->name, "a word is a name");
    WO_TRY(wo_lines_word(p->lines, "the name", word));
    if (!wo_lens_name_legal(word))
        return wo_lines_fail(p->lines, WO_ERR_FORMAT,
                             "name \"%s\": must be letters, digits, _ and -", word);
    memcpy(p->lens->name, word, sizeof word);
    return WO_OK;
}

static wo_status read_text(parser *p, const char *what, char *field, size_t size)
{
    wo_error inner;
    const char *text;
    size_t bytes;
    WO_TRY(wo_lines_rest(p->lines, what, &text, &bytes));
    WO_TRY(pass(p, wo_line_check(text, bytes, size - 1, what, &inner), &inner));
    if (field)
        memcpy(field, text, bytes);
    return WO_OK;
}

static wo_status read_title(parser *p)
{
    return read_text(p, "title", p->lens->title, sizeof p->lens->title);
}

static wo_status read_source(parser *p)
{
    return read_text(p, "source", p->lens->source, sizeof p->lens->source);
}

static wo_status read_note(parser *p)
{
    return read_text(p, "note", NULL, BYTES_MAX);
}

static wo_status read_header_number(parser *p, const char *what, double *value)
{
    wo_error inner;
    WO_TRY(wo_lines_number(p->lines, what, value));
    return pass(p, wo_lens_header_check(p->lens, &inner), &inner);
}

static wo_status read_focal(parser *p)
{
    return read_header_number(p, "the focal length", &p->lens->focal_mm);
}

static wo_status read_f_number(parser *p)
{
    return read_header_number(p, "the f-number", &p->lens->f_number);
}

static wo_status read_field(parser *p)
{
    return read_header_number(p, "the half field", &p->lens->half_field);
}

static const wo_glass *own_glass(const parser *p, const char *name)
{
    for (int i = 0; i < p->glasses; i++)
        if (wo_glass_name_is(p->glass[i].name, name))
            return &p->glass[i];
    return NULL;
}

static wo_status read_glass(parser *p)
{
    char name[WO_WORD_SIZE], formula[WO_WORD_SIZE];
    double a[6], low, high;
    wo_error inner;
    WO_TRY(wo_lines_word(p->lines, "the name of the glass", name));
    if (wo_glass_find(name) || own_glass(p, name))
        return wo_lines_fail(p->lines, WO_ERR_FORMAT,
                             "glass %s: there is one of this name already; must have another",
                             name);
    if (p->glasses == GLASSES_MAX)
        return wo_lines_fail(p->lines, WO_ERR_RANGE, "more than %d glasses", GLASSES_MAX);
    WO_TRY(wo_lines_word(p->lines, "the formula", formula));
    const bool sellmeier = strcmp(formula, "sellmeier") == 0;
    if (!sellmeier && strcmp(formula, "schott") != 0)
        return wo_lines_fail(p->lines, WO_ERR_FORMAT, "formula \"%s\": must be sellmeier or schott",
                             formula);
    for (int i = 0; i < 6; i++)
        WO_TRY(wo_lines_number(p->lines, "a coefficient", &a[i]));
    WO_TRY(wo_lines_number(p->lines, "the lowest wavelength", &low));
    WO_TRY(wo_lines_number(p->lines, "the highest wavelength", &high));
    const wo_dispersion kind = sellmeier ? WO_DISPERSION_SELLMEIER : WO_DISPERSION_SCHOTT;
    WO_TRY(
        pass(p, wo_glass_formula(name, kind, a, low, high, &p->glass[p->glasses], &inner), &inner));
    p->glasses++;
    return WO_OK;
}

wo_status wo_radius_read(const wo_lines *lines, double radius, double *curvature)
{
    *curvature = 0;
    if (radius == 0)
        return WO_OK;
    if (!(fabs(radius) >= RADIUS_MIN && fabs(radius) <= WO_RADIUS_MAX))
        return wo_lines_fail(lines, WO_ERR_RANGE,
                             "radius %g mm: must be %g..%g, or 0 or inf for a plane", radius,
                             RADIUS_MIN, WO_RADIUS_MAX);
    *curvature = 1 / radius;
    return WO_OK;
}

static wo_status read_shape(parser *p, wo_surface *s)
{
    char word[WO_WORD_SIZE];
    double radius;
    WO_TRY(wo_lines_word(p->lines, "the radius", word));
    if (strcmp(word, "inf") == 0)
        return WO_OK;
    if (strncmp(word, "c=", 2) == 0)
        return wo_lines_parse(p->lines, "the curvature", word + 2, &s->curvature);
    WO_TRY(wo_lines_parse(p->lines, "the radius", word, &radius));
    return wo_radius_read(p->lines, radius, &s->curvature);
}

static wo_status read_medium(parser *p, wo_glass *glass)
{
    char word[WO_WORD_SIZE];
    double nd, vd = 0;
    wo_error inner;
    WO_TRY(wo_lines_word(p->lines, "the medium", word));
    if (wo_glass_name_is(word, "air")) {
        *glass = wo_glass_air();
        return WO_OK;
    }
    if ((word[0] >= 'a' && word[0] <= 'z') || (word[0] >= 'A' && word[0] <= 'Z')) {
        const wo_glass *const own = own_glass(p, word);
        const wo_glass *const found = own ? own : wo_glass_find(word);
        if (!found)
            return wo_lines_fail(p->lines, WO_ERR_NOT_FOUND,
                                 "medium \"%s\": must be air, a glass of the catalogue or of a "
                                 "line above, ND/VD, or ND",
                                 word);
        *glass = *found;
        return WO_OK;
    }
    char *const slash = strchr(word, '/');
    if (slash) {
        *slash = '\0';
        WO_TRY(wo_lines_parse(p->lines, "the Abbe number", slash + 1, &vd));
    }
    WO_TRY(wo_lines_parse(p->lines, "the refractive index", word, &nd));
    return pass(p, wo_glass_abbe(nd, vd, glass, &inner), &inner);
}

/* A word behind the four columns; given holds a bit for each kind. */
static wo_status read_option(parser *p, wo_surface *s, unsigned *given)
{
    enum { STOP, CONIC, CYLINDER, ASPHERE };
    char word[WO_WORD_SIZE];
    WO_TRY(wo_lines_word(p->lines, "the option", word));
    unsigned kind;
    if (strcmp(word, "stop") == 0) {
        kind = STOP;
        s->stop = true;
    } else if (strncmp(word, "k=", 2) == 0) {
        kind = CONIC;
        WO_TRY(wo_lines_parse(p->lines, "the conic constant", word + 2, &s->conic));
    } else if (strcmp(word, "cylinder=x") == 0 || strcmp(word, "cylinder=y") == 0) {
        kind = CYLINDER;
        s->meridian = word[9] == 'x' ? WO_MERIDIAN_X : WO_MERIDIAN_Y;
    } else {
        int term = 0;
        char key[8] = "";
        for (; term < WO_ASPHERE_MAX; term++) {
            snprintf(key, sizeof key, "A%d=", 2 * term + 2);
            if (strncmp(word, key, strlen(key)) == 0)
                break;
        }
        if (term == WO_ASPHERE_MAX)
            return wo_lines_fail(p->lines, WO_ERR_FORMAT,
                                 "option \"%s\": must be stop, k=NUMBER, A2=NUMBER, A4= .. A%d=, "
                                 "cylinder=x or cylinder=y",
                                 word, 2 * WO_ASPHERE_MAX);
        kind = ASPHERE + (unsigned)term;
        WO_TRY(
            wo_lines_parse(p->lines, "the aspheric term", word + strlen(key), &s->asphere[term]));
        if (s->asphere_terms <= term)
            s->asphere_terms = term + 1;
    }
    if (*given & 1u << kind)
        return wo_lines_fail(p->lines, WO_ERR_FORMAT, "option \"%s\": must not be given twice",
                             word);
    *given |= 1u << kind;
    return WO_OK;
}

static wo_status read_surface(parser *p)
{
    wo_prescription *const lens = p->lens;
    if (lens->count == WO_SURFACES_MAX)
        return wo_lines_fail(p->lines, WO_ERR_RANGE, "more than %d surfaces", WO_SURFACES_MAX);
    wo_surface *const s = &lens->surface[lens->count];
    unsigned given = 0;
    wo_error inner;
    WO_TRY(read_shape(p, s));
    WO_TRY(wo_lines_number(p->lines, "the thickness", &s->thickness));
    WO_TRY(read_medium(p, &s->glass));
    WO_TRY(wo_lines_number(p->lines, "the semi-aperture", &s->semi_aperture));
    while (wo_lines_more(p->lines))
        WO_TRY(read_option(p, s, &given));
    WO_TRY(pass(p, wo_surface_check(s, &inner), &inner));
    if (s->stop) {
        if (lens->stop < lens->count && lens->surface[lens->stop].stop)
            return wo_lines_fail(p->lines, WO_ERR_FORMAT,
                                 "a second stop: surface %d is the stop already", lens->stop + 1);
        lens->stop = lens->count;
    }
    lens->count++;
    return WO_OK;
}

static const struct {
    const char *word;
    wo_status (*read)(parser *p);
    bool many;
} keywords[] = {
    {"lens", read_version, false},     {"name", read_name, false},   {"title", read_title, false},
    {"source", read_source, false},    {"note", read_note, true},    {"focal", read_focal, false},
    {"fnumber", read_f_number, false}, {"field", read_field, false}, {"glass", read_glass, true},
    {"surface", read_surface, true},
};

static wo_status read_line(parser *p)
{
    char word[WO_WORD_SIZE];
    WO_TRY(wo_lines_word(p->lines, "the keyword", word));
    if (p->seen == 0 && strcmp(word, keywords[0].word) != 0)
        return wo_lines_fail(p->lines, WO_ERR_FORMAT,
                             "\"%s\": a lens must begin with \"lens 1\", or with numbers", word);
    for (unsigned i = 0; i < WO_COUNT(keywords); i++) {
        if (strcmp(word, keywords[i].word) != 0)
            continue;
        if (p->seen & 1u << i && !keywords[i].many)
            return wo_lines_fail(p->lines, WO_ERR_FORMAT, "%s: must not be given twice", word);
        p->seen |= 1u << i;
        WO_TRY(keywords[i].read(p));
        return wo_lines_done(p->lines);
    }
    return wo_lines_fail(p->lines, WO_ERR_FORMAT,
                         "\"%s\": must be name, title, source, note, focal, fnumber, field, glass "
                         "or surface",
                         word);
}

wo_status wo_lens_read(wo_lines *lines, wo_prescription *lens)
{
    parser p;
    memset(&p, 0, sizeof p);
    p.lines = lines;
    p.lens = lens;
    while (wo_lines_next(lines))
        if (wo_lines_more(lines))
            WO_TRY(read_line(&p));
    if (p.seen == 0)
        return wo_lines_fail(lines, WO_ERR_FORMAT,
                             "no text: a lens must begin with \"lens 1\", or with numbers");
    return WO_OK;
}

static const char *base_of(const char *path)
{
    const char *base = path;
    for (; *path; path++)
        if ((*path == '/' || *path == '\\') && path[1])
            base = path + 1;
    return base;
}

/* The file's name without folder and ending, made an identifier. */
static void name_by_file(const char *file, char *name, size_t size)
{
    const char *const base = base_of(file);
    const char *const dot = strrchr(base, '.');
    const size_t length = dot && dot > base ? (size_t)(dot - base) : strlen(base);
    snprintf(name, size, "%.*s", (int)(length < size ? length : size - 1), base);
    for (char *at = name; *at; at++) {
        const char one[2] = {*at, '\0'};
        if (!wo_lens_name_legal(one))
            *at = '_';
    }
    if (!name[0])
        snprintf(name, size, "lens");
}

static bool begins_with_number(wo_lines lines)
{
    while (wo_lines_next(&lines))
        if (wo_lines_more(&lines))
            return (*lines.at >= '0' && *lines.at <= '9') || *lines.at == '.' || *lines.at == '-' ||
                   *lines.at == '+';
    return false;
}

static wo_status parse(wo_lines *lines, wo_prescription *lens)
{
    wo_error inner;
    if (begins_with_number(*lines))
        WO_TRY(wo_dat_read(lines, lens));
    else
        WO_TRY(wo_lens_read(lines, lens));
    if (!lens->name[0])
        name_by_file(lines->file, lens->name, sizeof lens->name);
    const wo_status status = wo_prescription_validate(lens, &inner);
    return status == WO_OK ? WO_OK : wo_lines_fail(lines, status, "%s", inner.text);
}

wo_status wo_prescription_parse(const char *text, size_t bytes, const char *name,
                                wo_prescription *lens, wo_error *error)
{
    /* Long paths must leave room for the message. */
    enum { FILE_MAX = 80 };
    const char *file = name && *name ? name : "lens";
    if (strlen(file) > FILE_MAX)
        file = base_of(file);
    char cut[FILE_MAX + 1];
    snprintf(cut, sizeof cut, "%s", file);
    memset(lens, 0, sizeof *lens);
    if (bytes > BYTES_MAX)
        return wo_fail(error, WO_ERR_RANGE, "%s: %zu bytes: must be at most %d", cut, bytes,
                       (int)BYTES_MAX);
    wo_lines lines = wo_lines_begin(text ? text : "", text ? bytes : 0, cut, error);
    const wo_status status = parse(&lines, lens);
    if (status != WO_OK)
        memset(lens, 0, sizeof *lens);
    return status;
}
