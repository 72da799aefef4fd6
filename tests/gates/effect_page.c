/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "effect_table.h"

#include "core/base/number.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 100 };

void page_add(page *p, const char *format, ...)
{
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    const int length = vsnprintf(NULL, 0, format, args);
    va_end(args);
    if (length < 0)
        abort();
    const size_t needed = p->used + (size_t)length + 1;
    if (needed > p->room) {
        p->room = 2 * needed;
        p->data = realloc(p->data, p->room);
        if (!p->data)
            abort();
    }
    vsnprintf(p->data + p->used, p->room - p->used, format, again);
    va_end(again);
    p->used += (size_t)length;
}

void page_free(page *p)
{
    free(p->data);
    *p = (page){0};
}

/* text as lines of COLUMNS; the first begins with first, the others with as many blanks. */
static void add_lines(page *p, const char *first, const char *text)
{
    const int indent = (int)strlen(first);
    int column = indent;
    page_add(p, "%s", first);
    while (*text) {
        const int word = (int)strcspn(text, " ");
        if (column > indent && column + 1 + word > COLUMNS) {
            page_add(p, "\n%*s", indent, "");
            column = indent;
        } else if (column > indent) {
            page_add(p, " ");
            column++;
        }
        page_add(p, "%.*s", word, text);
        column += word;
        text += word;
        while (*text == ' ')
            text++;
    }
    page_add(p, "\n");
}

/* "* `name`: help", and below it what else is known. */
static void add_bullet(page *p, const char *name, const char *help, const page *facts)
{
    page text = {0};
    page_add(&text, "`%s`: %s", name, help);
    /* Lines after the first are indented by two blanks, as Markdown wants. */
    add_lines(p, "* ", text.data);
    add_lines(p, "  - ", facts->data);
    page_free(&text);
}

static void add_clip(page *p, const wo_clip *clip)
{
    static const struct {
        uint32_t bit;
        const char *name;
    } names[] = {
        {WO_COMPONENT_RGBA, "RGBA"}, {WO_COMPONENT_RGB, "RGB"}, {WO_COMPONENT_ALPHA, "alpha"}};
    page facts = {0};
    const char *comma = "";
    for (size_t i = 0; i < WO_COUNT(names); i++)
        if (clip->components & names[i].bit) {
            page_add(&facts, "%s%s", comma, names[i].name);
            comma = ", ";
        }
    page_add(&facts, "; %s%s%s", clip->optional ? "optional" : "must be connected",
             clip->mask ? "; a mask" : "", clip->data ? "; numbers, not colour" : "");
    add_bullet(p, clip->name, clip->help, &facts);
    page_free(&facts);
}

static void add_range(page *facts, const wo_param *param)
{
    char low[WO_NUMBER_SIZE], high[WO_NUMBER_SIZE];
    wo_number_print(param->min, low);
    wo_number_print(param->max, high);
    page_add(facts, ", range %s to %s", low, high);
    if (param->ui_min > param->min || param->ui_max < param->max) {
        wo_number_print(param->ui_min, low);
        wo_number_print(param->ui_max, high);
        page_add(facts, ", slider %s to %s", low, high);
    }
}

static void add_choices(page *facts, const wo_param *param)
{
    for (int i = 0; i < wo_param_choice_count(param); i++) {
        page_add(facts, "%s`%s`", i ? ", " : ", one of ", param->choices[i]);
        if (param->choice_labels)
            page_add(facts, " (%s)", param->choice_labels[i]);
    }
}

static void add_param(page *p, const wo_param *param, const void *defaults)
{
    static const char *const kinds[] = {
        [WO_PARAM_DOUBLE] = "number", [WO_PARAM_INT] = "whole number",
        [WO_PARAM_BOOL] = "switch",   [WO_PARAM_CHOICE] = "choice",
        [WO_PARAM_POINT] = "point",   [WO_PARAM_COLOUR] = "scene-linear colour",
        [WO_PARAM_STRING] = "text"};
    page facts = {0};
    char text[WO_PARAM_STRING_SIZE];
    wo_param_print(param, defaults, text, sizeof text);
    page_add(&facts, "%s: %s", param->label, kinds[param->type]);
    if (param->unit[0])
        page_add(&facts, " [%s]", param->unit);
    if (text[0])
        page_add(&facts, ", default `%s`", text);
    if (param->type == WO_PARAM_CHOICE)
        add_choices(&facts, param);
    else if (param->type != WO_PARAM_STRING && param->type != WO_PARAM_BOOL)
        add_range(&facts, param);
    if (param->animates)
        page_add(&facts, ", may change over time");
    add_bullet(p, param->key, param->help, &facts);
    page_free(&facts);
}

/* What the group's parameters do, in one picture. */
static void add_picture(page *p, const wo_param_group *group)
{
    page_add(p, "![What the parameters of %s do](../../footage/pictures/parameters-%s.png)\n",
             group->label, group->key);
}

void page_write(const wo_effect *e, page *p)
{
    char *const defaults = calloc(1, e->params_size);
    if (!defaults)
        abort();
    wo_params_default(e->params, e->param_count, defaults);
    page_add(p, "# %s\n\n", e->label);
    add_lines(p, "", e->help);
    page_add(p, "\n## Clips\n\n");
    for (size_t i = 0; i < e->clip_count; i++)
        add_clip(p, &e->clips[i]);
    page_add(p, "\n## Parameters\n");
    for (size_t i = 0; i < e->group_count; i++) {
        page_add(p, "\n### %s\n\n", e->groups[i].label);
        add_picture(p, &e->groups[i]);
        page_add(p, "\n");
        for (size_t j = 0; j < e->param_count; j++)
            if (strcmp(e->params[j].group, e->groups[i].key) == 0)
                add_param(p, &e->params[j], defaults);
    }
    free(defaults);
}

void page_name(const wo_effect *e, char name[128])
{
    size_t used = 0;
    for (const char *c = e->name; *c && used < 120; c++) {
        const bool upper = *c >= 'A' && *c <= 'Z';
        if (upper && used > 0)
            name[used++] = '_';
        name[used++] = upper ? (char)(*c - 'A' + 'a') : *c;
    }
    memcpy(name + used, ".md", 4);
}

/* Reads a page piece by piece: a piece is a heading, a bullet with all its lines, or a paragraph,
   with single blanks instead of line ends and indents. */
typedef struct reader {
    const char *at;
    page piece;
    char section; /* C or P in the sections of clips and parameters, else 0 */
} reader;

/* Is this a line that begins a new piece? */
static bool begins_piece(const char *line)
{
    return *line == '#' || *line == '\n' || *line == '\0' || strncmp(line, "* ", 2) == 0;
}

static bool next_piece(reader *r)
{
    page_free(&r->piece);
    while (*r->at == '\n')
        r->at++;
    if (*r->at == '\0')
        return false;
    const bool heading = *r->at == '#';
    do {
        const char *line = r->at + strspn(r->at, " ");
        const size_t length = strcspn(line, "\n");
        page_add(&r->piece, "%s%.*s", r->piece.used ? " " : "", (int)length, line);
        r->at = line + length;
        if (*r->at == '\n')
            r->at++;
    } while (!heading && !begins_piece(r->at));
    if (strncmp(r->piece.data, "## ", 3) == 0)
        r->section = strcmp(r->piece.data, "## Clips") == 0        ? 'C'
                     : strcmp(r->piece.data, "## Parameters") == 0 ? 'P'
                                                                   : 0;
    return true;
}

/* The next bullet of the two sections that follow the tables, with its section before it. */
static const char *next_bullet(reader *r)
{
    while (next_piece(r))
        if (r->section && strncmp(r->piece.data, "* ", 2) == 0)
            return r->piece.data;
    return NULL;
}

void page_check(const wo_effect *e, const char *text, faults *f)
{
    page expected = {0};
    char name[128];
    page_name(e, name);
    page_write(e, &expected);
    reader own = {.at = text}, table = {.at = expected.data};

    for (int i = 0; i < 2; i++)
        if (!next_piece(&table) || !next_piece(&own) ||
            strcmp(table.piece.data, own.piece.data) != 0)
            fault(f, "%s: the page does not begin with: %.200s", name,
                  table.piece.data ? table.piece.data : "");
    for (;;) {
        const char *const wanted = next_bullet(&table);
        const char *const found = next_bullet(&own);
        if (!wanted && !found)
            break;
        if (!wanted || !found || table.section != own.section || strcmp(wanted, found) != 0) {
            fault(f, "%s: the page says\n    %.200s\nand the table\n    %.200s", name,
                  found ? found : "nothing more", wanted ? wanted : "nothing more");
            break;
        }
    }
    for (size_t i = 0; i < e->group_count; i++) {
        page picture = {0};
        add_picture(&picture, &e->groups[i]);
        if (!strstr(text, picture.data))
            fault(f, "%s: the page shows no picture of group %s", name, e->groups[i].key);
        page_free(&picture);
    }
    page_free(&table.piece);
    page_free(&own.piece);
    page_free(&expected);
}
