/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "effect_table.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

void fault(faults *f, const char *format, ...)
{
    char text[512];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    if (f->out)
        fprintf(f->out, "%s\n", text);
    f->met = f->met || (f->wanted && strstr(text, f->wanted));
    f->count++;
}

static bool is_lower(char c)
{
    return c >= 'a' && c <= 'z';
}

static bool is_upper(char c)
{
    return c >= 'A' && c <= 'Z';
}

/* Letters and digits; the first letter small or large. */
static bool is_camel(const char *text, bool (*first)(char))
{
    if (!text || !first(text[0]))
        return false;
    for (const char *c = text; *c; c++)
        if (!is_lower(*c) && !is_upper(*c) && !(*c >= '0' && *c <= '9'))
            return false;
    return true;
}

/* A label: some text, printable, without blanks around it and without a full stop. */
static bool is_label(const char *text)
{
    const size_t length = text ? strlen(text) : 0;
    if (length == 0 || text[0] == ' ' || text[length - 1] == ' ' || text[length - 1] == '.')
        return false;
    for (size_t i = 0; i < length; i++)
        if (text[i] < ' ' || text[i] > '~')
            return false;
    return true;
}

/* A help text: whole sentences on one line, single blanks. */
static bool is_sentence(const char *text)
{
    const size_t length = text ? strlen(text) : 0;
    if (length < 2 || text[0] == ' ' || text[length - 1] != '.' || strstr(text, "  "))
        return false;
    for (size_t i = 0; i < length; i++)
        if (text[i] < ' ' || text[i] > '~')
            return false;
    return true;
}

static size_t field_size(wo_param_type type)
{
    switch (type) {
    case WO_PARAM_DOUBLE:
        return sizeof(double);
    case WO_PARAM_INT:
    case WO_PARAM_BOOL:
    case WO_PARAM_CHOICE:
        return sizeof(int32_t);
    case WO_PARAM_POINT:
        return 2 * sizeof(double);
    case WO_PARAM_COLOUR:
        return 3 * sizeof(double);
    case WO_PARAM_STRING:
        return WO_PARAM_STRING_SIZE;
    }
    return 0;
}

static size_t field_alignment(wo_param_type type)
{
    if (type == WO_PARAM_STRING)
        return 1;
    return type == WO_PARAM_INT || type == WO_PARAM_BOOL || type == WO_PARAM_CHOICE
               ? _Alignof(int32_t)
               : _Alignof(double);
}

/* Keys of choices: camelCase, or the lower_case names of files. */
static bool is_name(const char *text)
{
    if (is_camel(text, is_lower))
        return true;
    if (!is_lower(*text))
        return false;
    for (; *text; text++)
        if (!is_lower(*text) && !(*text >= '0' && *text <= '9') && *text != '_')
            return false;
    return true;
}

static bool is_whole(double value)
{
    return value == floor(value) && fabs(value) <= INT32_MAX;
}

/* Are label and key the same, but for case and what is no letter or digit? */
static bool reads_as(const char *label, const char *key)
{
    for (;; label++, key++) {
        while (*label && !isalnum((unsigned char)*label))
            label++;
        if (tolower((unsigned char)*label) != tolower((unsigned char)*key))
            return false;
        if (!*key)
            return true;
    }
}

static void check_choices(const char *effect, const wo_param *p, faults *f)
{
    enum { MOST = 64 };
    int count = 0;
    if (p->type != WO_PARAM_CHOICE) {
        if (p->choices || p->choice_labels)
            fault(f, "%s.%s: choices for what is no choice", effect, p->key);
        return;
    }
    if (!p->choices) {
        fault(f, "%s.%s: a choice without choices", effect, p->key);
        return;
    }
    for (; count <= MOST && p->choices[count]; count++) {
        if (!is_name(p->choices[count]))
            fault(f, "%s.%s: the choice \"%s\" is no camelCase or lower_case name", effect, p->key,
                  p->choices[count]);
        for (int i = 0; i < count; i++)
            if (strcmp(p->choices[i], p->choices[count]) == 0)
                fault(f, "%s.%s: the choice \"%s\" stands there twice", effect, p->key,
                      p->choices[i]);
    }
    if (count < 2 || count > MOST)
        fault(f, "%s.%s: fewer than 2 or more than %d choices", effect, p->key, MOST);
    if (!(p->min == 0 && p->max == count - 1))
        fault(f, "%s.%s: the hard range is not 0..%d, the choices", effect, p->key, count - 1);
    for (int i = 0; p->choice_labels && i <= count && i <= MOST; i++)
        if (i == count ? p->choice_labels[i] != NULL : !is_label(p->choice_labels[i])) {
            fault(f, "%s.%s: the labels do not go with the choices", effect, p->key);
            return;
        }
    for (int i = 0; p->choice_labels && i < count; i++)
        if (!reads_as(p->choice_labels[i], p->choices[i]))
            fault(f, "%s.%s: \"%s\" is not the choice \"%s\" to hosts that know labels only",
                  effect, p->key, p->choice_labels[i], p->choices[i]);
}

static void check_numbers(const char *effect, const wo_param *p, faults *f)
{
    const bool whole = field_size(p->type) == sizeof(int32_t);
    if (p->type == WO_PARAM_STRING) {
        if (p->initial_text && strlen(p->initial_text) >= WO_PARAM_STRING_SIZE)
            fault(f, "%s.%s: the default text is too long", effect, p->key);
        return;
    }
    if (p->initial_text)
        fault(f, "%s.%s: a default text for a number", effect, p->key);
    if (!isfinite(p->min) || !isfinite(p->max) || !(p->min < p->max))
        fault(f, "%s.%s: no hard range", effect, p->key);
    if (!(p->ui_min < p->ui_max))
        fault(f, "%s.%s: no UI range", effect, p->key);
    if (!(p->ui_min >= p->min && p->ui_max <= p->max))
        fault(f, "%s.%s: the UI range is not inside the hard range", effect, p->key);
    for (int i = 0; i < 3; i++) {
        const double value = p->initial[i];
        if (i >= wo_param_values(p) ? value != 0 : !(value >= p->min && value <= p->max))
            fault(f, "%s.%s: the default is outside the hard range", effect, p->key);
        if (whole && !is_whole(value))
            fault(f, "%s.%s: the default is not a whole number", effect, p->key);
    }
    if (whole &&
        (!is_whole(p->min) || !is_whole(p->max) || !is_whole(p->ui_min) || !is_whole(p->ui_max)))
        fault(f, "%s.%s: the range does not consist of whole numbers", effect, p->key);
    if (p->type == WO_PARAM_BOOL && !(p->min == 0 && p->max == 1))
        fault(f, "%s.%s: the hard range is not 0..1", effect, p->key);
}

static void check_param(const wo_effect *e, size_t index, faults *f)
{
    const wo_param *const p = &e->params[index];
    const char *const key = p->key ? p->key : "(no key)";
    bool group_exists = false;

    if (!is_camel(p->key, is_lower)) {
        fault(f, "%s.%s: the key is not camelCase", e->name, key);
        return;
    }
    for (size_t i = 0; i < index; i++)
        if (e->params[i].key && strcmp(e->params[i].key, key) == 0)
            fault(f, "%s.%s: the key stands there twice", e->name, key);
    if (!is_label(p->label))
        fault(f, "%s.%s: no label, or one with a full stop or blanks around it", e->name, key);
    if (!is_sentence(p->help))
        fault(f, "%s.%s: the help is not sentences with a full stop", e->name, key);
    if (!p->unit)
        fault(f, "%s.%s: the unit is NULL", e->name, key);
    for (size_t i = 0; p->group && i < e->group_count; i++)
        if (e->groups[i].key && strcmp(e->groups[i].key, p->group) == 0)
            group_exists = true;
    if (!group_exists)
        fault(f, "%s.%s: the group \"%s\" does not exist", e->name, key,
              p->group ? p->group : "(NULL)");
    if (field_size(p->type) == 0) {
        fault(f, "%s.%s: unknown type", e->name, key);
        return;
    }
    check_choices(e->name, p, f);
    check_numbers(e->name, p, f);
}

static int by_offset(const void *a, const void *b)
{
    const wo_param *const one = *(const wo_param *const *)a;
    const wo_param *const other = *(const wo_param *const *)b;
    return (one->offset > other->offset) - (one->offset < other->offset);
}

/* Fields follow each other as the C compiler lays them out: no overlap, nothing without a row. */
static void check_fields(const wo_effect *e, faults *f)
{
    const wo_param **const sorted = calloc(e->param_count + 1, sizeof *sorted);
    size_t end = 0, widest = 1;
    if (!sorted)
        abort();
    for (size_t i = 0; i < e->param_count; i++)
        sorted[i] = &e->params[i];
    qsort(sorted, e->param_count, sizeof *sorted, by_offset);
    for (size_t i = 0; i < e->param_count; i++) {
        const wo_param *const p = sorted[i];
        const size_t align = field_alignment(p->type);
        const size_t expected = (end + align - 1) / align * align;
        if (p->offset < end)
            fault(f, "%s.%s: its field overlaps the one of %s", e->name, p->key,
                  i ? sorted[i - 1]->key : "nothing");
        else if (p->offset != expected)
            fault(f, "%s.%s: a field before it has no row, or the row has the wrong type", e->name,
                  p->key);
        end = p->offset + field_size(p->type);
        if (end > e->params_size)
            fault(f, "%s.%s: its field lies outside the struct", e->name, p->key);
        widest = align > widest ? align : widest;
    }
    if (end <= e->params_size && (end + widest - 1) / widest * widest != e->params_size)
        fault(f, "%s: the last fields of the struct have no row", e->name);
    free(sorted);
}

static void check_groups(const wo_effect *e, faults *f)
{
    for (size_t i = 0; i < e->group_count; i++) {
        const wo_param_group *const g = &e->groups[i];
        bool used = false;
        if (!is_camel(g->key, is_lower) || !is_label(g->label)) {
            fault(f, "%s: group %zu has no camelCase key or no label", e->name, i);
            continue;
        }
        for (size_t j = 0; j < i; j++)
            if (e->groups[j].key && strcmp(e->groups[j].key, g->key) == 0)
                fault(f, "%s: the group \"%s\" stands there twice", e->name, g->key);
        for (size_t j = 0; j < e->param_count; j++) {
            const wo_param *const p = &e->params[j];
            used = used || (p->group && strcmp(p->group, g->key) == 0);
            /* Hosts keep parameters and groups in one space of names. */
            if (p->key && strcmp(p->key, g->key) == 0)
                fault(f, "%s: \"%s\" is both a group and a parameter", e->name, g->key);
        }
        if (!used)
            fault(f, "%s: the group \"%s\" is empty", e->name, g->key);
    }
}

static void check_clips(const wo_effect *e, faults *f)
{
    const uint32_t every = WO_COMPONENT_ALPHA | WO_COMPONENT_RGB | WO_COMPONENT_RGBA;
    if (e->clip_count < 1 || e->clip_count > WO_CLIPS_MAX) {
        fault(f, "%s: fewer than 1 or more than %d clips", e->name, WO_CLIPS_MAX);
        return;
    }
    for (size_t i = 0; i < e->clip_count; i++) {
        const wo_clip *const c = &e->clips[i];
        if (!is_camel(c->name, is_upper)) {
            fault(f, "%s: the name of clip %zu is not CamelCase", e->name, i);
            continue;
        }
        for (size_t j = 0; j < i; j++)
            if (e->clips[j].name && strcmp(e->clips[j].name, c->name) == 0)
                fault(f, "%s: the clip %s stands there twice", e->name, c->name);
        if (i == 0 && (strcmp(c->name, "Source") != 0 || c->optional))
            fault(f, "%s: the first clip is not a Source that must be there", e->name);
        if (strcmp(c->name, "Output") == 0)
            fault(f, "%s: the name Output is taken", e->name);
        if (!is_label(c->label))
            fault(f, "%s: clip %s has no label", e->name, c->name);
        if (!is_sentence(c->help))
            fault(f, "%s: the help of clip %s is not sentences with a full stop", e->name, c->name);
        if (c->components == 0 || (c->components & ~every))
            fault(f, "%s: clip %s takes no components, or unknown ones", e->name, c->name);
        if (c->mask && !c->optional)
            fault(f, "%s: the mask %s is not optional", e->name, c->name);
    }
}

/* The defaults pass the effect's own checks, and every value survives being printed and read. */
static void check_defaults(const wo_effect *e, faults *f)
{
    char *const params = calloc(1, e->params_size);
    char *const again = calloc(1, e->params_size);
    wo_error error = {WO_OK, ""};
    if (!params || !again)
        abort();
    wo_params_default(e->params, e->param_count, params);
    wo_params_default(e->params, e->param_count, again);
    if (wo_params_validate(e->params, e->param_count, params, &error) != WO_OK)
        fault(f, "%s: the defaults are not valid: %s", e->name, error.text);
    for (size_t i = 0; i < e->param_count; i++) {
        char text[WO_PARAM_STRING_SIZE];
        const int length = wo_param_print(&e->params[i], params, text, sizeof text);
        if (length < 0 || (size_t)length >= sizeof text ||
            wo_param_parse(&e->params[i], text, again, &error) != WO_OK ||
            memcmp(params, again, e->params_size) != 0)
            fault(f, "%s.%s: the default does not survive printing and reading", e->name,
                  e->params[i].key);
    }
    free(params);
    free(again);
}

/* What is marked for overlays belongs to points, and the effect uses no more than there are. */
static void check_handles(const wo_effect *e, faults *f)
{
    int marks = 0, points = 0;
    bool joined = false;
    for (size_t i = 0; i < e->param_count; i++) {
        marks += e->params[i].overlay;
        points += e->params[i].overlay && e->params[i].type == WO_PARAM_POINT;
    }
    if (points == 0 && (marks > 0 || e->handles))
        fault(f, "%s: an overlay without a point", e->name);
    if (!e->handles)
        return;
    char *const params = calloc(1, e->params_size);
    if (!params)
        abort();
    wo_params_default(e->params, e->param_count, params);
    const int used = e->handles(params, &joined);
    if (used < 0 || used > points)
        fault(f, "%s: %d of %d handles are in use", e->name, used, points);
    free(params);
}

void check_effect(const wo_effect *e, faults *f)
{
    const int before = f->count;
    if (!is_camel(e->name, is_upper)) {
        fault(f, "an effect whose name is not CamelCase");
        return;
    }
    if (!is_label(e->label))
        fault(f, "%s: no label", e->name);
    if (!is_sentence(e->help))
        fault(f, "%s: the help is not sentences with a full stop", e->name);
    if (!e->region || !e->identity || !e->plan_create || !e->plan_print || !e->render ||
        !e->plan_destroy)
        fault(f, "%s: a function is missing", e->name);
    for (size_t i = 0; i < e->param_count; i++)
        check_param(e, i, f);
    check_groups(e, f);
    check_clips(e, f);
    /* What follows needs a sound table. */
    if (f->count == before)
        check_fields(e, f);
    if (f->count == before)
        check_defaults(e, f);
    if (f->count == before)
        check_handles(e, f);
}
