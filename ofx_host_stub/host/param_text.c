/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "internal.h"

#include <ctype.h>
#include <limits.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *wo_read_number(const char *text, double *value)
{
    const locale_t c = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
    if (c == (locale_t)0)
        return NULL;
    const locale_t before = uselocale(c);
    char *end = NULL;
    *value = strtod(text, &end);
    uselocale(before);
    freelocale(c);
    return end == text ? NULL : end;
}

int wo_print_number(char *buffer, size_t size, double value)
{
    const locale_t c = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
    const locale_t before = c != (locale_t)0 ? uselocale(c) : (locale_t)0;
    char text[40];
    int length = 0;
    for (int digits = 6; digits <= 17; digits++) { /* the fewest that read back as the same */
        length = snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            break;
    }
    if (c != (locale_t)0) {
        uselocale(before);
        freelocale(c);
    }
    snprintf(buffer, size, "%s", text);
    return length;
}

bool wo_words_match(const char *a, const char *b)
{
    for (;;) {
        while (*a && !isalnum((unsigned char)*a))
            a++;
        while (*b && !isalnum((unsigned char)*b))
            b++;
        if (tolower((unsigned char)*a) != tolower((unsigned char)*b))
            return false;
        if (!*a)
            return true;
        a++;
        b++;
    }
}

static const char *skip_blanks(const char *text)
{
    while (isspace((unsigned char)*text))
        text++;
    return text;
}

/* Index of a choice by key, label or number; the strictest reading that fits wins. -1 = none. */
static int find_choice(const wo_par *par, const char *text)
{
    const int count = wo_props_count(&par->props, kOfxParamPropChoiceOption);
    const int keys = wo_props_count(&par->props, kOfxParamPropChoiceEnum);
    for (int i = 0; i < count; i++)
        if ((i < keys &&
             strcmp(wo_props_text(&par->props, kOfxParamPropChoiceEnum, i, ""), text) == 0) ||
            strcmp(wo_props_text(&par->props, kOfxParamPropChoiceOption, i, ""), text) == 0)
            return i;
    double number = 0;
    const char *end = wo_read_number(text, &number);
    if (end && !*skip_blanks(end) && number >= 0 && number < count && number == floor(number))
        return (int)number;
    for (int i = 0; i < count; i++)
        if ((i < keys &&
             wo_words_match(wo_props_text(&par->props, kOfxParamPropChoiceEnum, i, ""), text)) ||
            wo_words_match(wo_props_text(&par->props, kOfxParamPropChoiceOption, i, ""), text))
            return i;
    return -1;
}

static wo_status no_such_choice(const wo_par *par, const char *text, wo_error *error)
{
    char list[150] = "";
    size_t used = 0;
    const int count = wo_props_count(&par->props, kOfxParamPropChoiceOption);
    for (int i = 0; i < count; i++) {
        const char *label = wo_props_text(&par->props, kOfxParamPropChoiceOption, i, "");
        if (used + strlen(label) + 8 >= sizeof list) {
            snprintf(list + used, sizeof list - used, ", ...");
            break;
        }
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", label);
    }
    return wo_fail(error, WO_ERR_RANGE, "%.40s has no choice \"%.30s\"; it has: %s", par->name,
                   text, list);
}

static wo_status check(const wo_par *par, int dimension, double value, wo_error *error)
{
    double min, max;
    wo_par_limits(par, dimension, &min, &max);
    if (!isfinite(value))
        return wo_fail(error, WO_ERR_RANGE, "%.60s must be a finite number", par->name);
    if (wo_par_is_integer(par) && value != floor(value))
        return wo_fail(error, WO_ERR_RANGE, "%.60s must be a whole number, not %g", par->name,
                       value);
    if (!(value >= min && value <= max))
        return wo_fail(error, WO_ERR_RANGE, "%.60s is %g; it may be %g to %g", par->name, value,
                       min, max);
    return WO_OK;
}

static bool read_boolean(const char *text, double *value)
{
    static const char *const yes[] = {"true", "on", "yes", "1"};
    static const char *const no[] = {"false", "off", "no", "0"};
    for (size_t i = 0; i < WO_COUNT(yes); i++) {
        if (wo_words_match(text, yes[i]) || wo_words_match(text, no[i])) {
            *value = wo_words_match(text, yes[i]);
            return true;
        }
    }
    return false;
}

/* Reads one value: par->dimension numbers, or a text that comes back in *word. */
static wo_status read_value(const wo_par *par, const char *text, double values[4],
                            const char **word, wo_error *error)
{
    memset(values, 0, 4 * sizeof *values);
    *word = text;
    if (par->kind == WO_HOST_PARAM_CHOICE || par->kind == WO_HOST_PARAM_STR_CHOICE) {
        const int index = find_choice(par, text);
        if (index < 0)
            return no_such_choice(par, text, error);
        values[0] = index;
        *word = wo_props_text(&par->props, kOfxParamPropChoiceEnum, index,
                              wo_props_text(&par->props, kOfxParamPropChoiceOption, index, ""));
        return WO_OK;
    }
    if (par->is_text)
        return WO_OK;
    if (par->kind == WO_HOST_PARAM_BOOLEAN) {
        if (!read_boolean(text, &values[0]))
            return wo_fail(error, WO_ERR_ARGUMENT, "%.60s is true or false, not \"%.40s\"",
                           par->name, text);
        return WO_OK;
    }
    const char *at = text;
    int count = 0;
    for (;;) {
        at = count < 4 ? wo_read_number(at, &values[count]) : NULL;
        if (!at)
            break;
        count++;
        at = skip_blanks(at);
        if (*at != ',')
            break;
        at++;
    }
    if (!at || *at || (count != par->dimension && count != 1))
        return wo_fail(error, WO_ERR_ARGUMENT, "%.60s takes %d number%s, not \"%.60s\"", par->name,
                       par->dimension, par->dimension > 1 ? "s, as in 1,2" : "", text);
    for (int i = 0; i < par->dimension; i++) {
        if (count == 1)
            values[i] = values[0];
        WO_TRY(check(par, i, values[i], error));
    }
    return WO_OK;
}

/* Start of the next "@frame:" at or after text; *lead is where it, with a comma and the word key
   before it, begins. */
static const char *next_key(const char *text, const char **lead)
{
    for (const char *at = strchr(text, '@'); at; at = strchr(at + 1, '@')) {
        double frame;
        const char *end = wo_read_number(at + 1, &frame);
        const char *start = at;
        if (!end || *end != ':')
            continue;
        if (start - text >= 3 && strncmp(start - 3, "key", 3) == 0)
            start -= 3;
        while (start > text && start[-1] == ' ')
            start--;
        if (start > text && start[-1] != ',')
            continue;
        *lead = start > text ? start - 1 : start;
        return at;
    }
    return NULL;
}

static bool is_animation(const char *text)
{
    const char *lead = NULL;
    return next_key(text, &lead) && lead == text;
}

static wo_status set_keys(wo_par *par, char *text, wo_error *error)
{
    const char *lead;
    char *at = text + (next_key(text, &lead) - text);
    double values[4];
    const char *word;
    if (!wo_par_animates(par))
        return wo_fail(error, WO_ERR_UNSUPPORTED, "%.60s cannot change over time", par->name);
    wo_par_clear_keys(par);
    while (at) {
        double frame = 0;
        const char *value = wo_read_number(at + 1, &frame) + 1;
        const char *next = next_key(value, &lead);
        if (next)
            text[lead - text] = '\0';
        if (!isfinite(frame))
            return wo_fail(error, WO_ERR_RANGE, "a key of %.60s has no frame", par->name);
        WO_TRY(read_value(par, value, values, &word, error));
        if (!wo_par_set_key(par, frame, values, word))
            return wo_fail(error, WO_ERR_NOMEM, "no memory for a key of %.60s", par->name);
        at = next ? text + (next - text) : NULL;
    }
    memcpy(par->value, par->keys[0].value, sizeof par->value);
    if (par->is_text && !wo_text_set(&par->text, par->keys[0].text))
        return wo_fail(error, WO_ERR_NOMEM, "no memory for %.60s", par->name);
    return WO_OK;
}

/* Keys go into a spare first: text with a fault in it changes nothing. */
static wo_status set_animation(wo_par *par, const char *text, wo_error *error)
{
    char *copy = wo_text_copy(text);
    if (!copy)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for %.60s", par->name);
    wo_par spare = *par;
    spare.keys = NULL;
    spare.key_count = spare.key_capacity = 0;
    spare.text = NULL;
    wo_status status = set_keys(&spare, copy, error);
    if (status == WO_OK && !wo_par_copy(par, &spare, 0, NULL))
        status = wo_fail(error, WO_ERR_NOMEM, "no memory for %.60s", par->name);
    wo_par_free_values(&spare);
    free(copy);
    wo_par_show_animating(par);
    return status;
}

/* Parameter by name or script name, with a value or of any kind. */
static wo_status find(wo_host_instance *instance, const char *name, bool valued, wo_par **par,
                      wo_error *error)
{
    *par = wo_object_param(&instance->object, name);
    for (size_t i = 0; !*par && i < instance->object.param_count; i++) {
        wo_par *p = instance->object.params[i];
        if (strcmp(wo_props_text(&p->props, kOfxParamPropScriptName, 0, ""), name) == 0)
            *par = p;
    }
    if (!*par)
        return wo_fail(error, WO_ERR_NOT_FOUND, "%.60s has no parameter \"%.60s\"",
                       instance->object.entry->info.identifier, name);
    if (valued && (*par)->dimension == 0 && !(*par)->is_text)
        return wo_fail(error, WO_ERR_UNSUPPORTED, "%.60s is a %s, it has no value", name,
                       wo_host_param_type_text((*par)->kind));
    return WO_OK;
}

static wo_status changed(wo_host_instance *instance, const wo_par *par, wo_error *error)
{
    wo_mark_changed(instance, par->name);
    if (!instance->notify)
        return WO_OK;
    return wo_tell_changed(instance, kOfxTypeParameter, par->name, kOfxChangeUserEdited, error);
}

wo_status wo_host_param_set_text(wo_host_instance *instance, const char *name, const char *text,
                                 wo_error *error)
{
    wo_par *par;
    double values[4];
    const char *word;
    WO_TRY(find(instance, name, true, &par, error));
    if (!text)
        return wo_fail(error, WO_ERR_ARGUMENT, "no value for %.60s", name);
    if ((wo_par_animates(par) || !par->is_text) && is_animation(text)) {
        WO_TRY(set_animation(par, text, error));
        return changed(instance, par, error);
    }
    WO_TRY(read_value(par, text, values, &word, error));
    if (!wo_par_set(par, values, word))
        return wo_fail(error, WO_ERR_NOMEM, "no memory for %.60s", name);
    return changed(instance, par, error);
}

static wo_status check_values(const wo_par *par, const double *values, int count, double out[4],
                              wo_error *error)
{
    if (par->is_text || count != par->dimension || !values)
        return wo_fail(error, WO_ERR_ARGUMENT, "%.60s takes %d numbers, not %d", par->name,
                       par->dimension, count);
    memset(out, 0, 4 * sizeof *out);
    for (int i = 0; i < count; i++) {
        WO_TRY(check(par, i, values[i], error));
        out[i] = values[i];
    }
    return WO_OK;
}

wo_status wo_host_param_set(wo_host_instance *instance, const char *name, const double *values,
                            int count, wo_error *error)
{
    wo_par *par;
    double checked[4];
    WO_TRY(find(instance, name, true, &par, error));
    WO_TRY(check_values(par, values, count, checked, error));
    if (!wo_par_set(par, checked, NULL))
        return wo_fail(error, WO_ERR_NOMEM, "no memory for %.60s", name);
    return changed(instance, par, error);
}

wo_status wo_host_param_set_at(wo_host_instance *instance, const char *name, double time,
                               const double *values, int count, wo_error *error)
{
    wo_par *par;
    double checked[4];
    WO_TRY(find(instance, name, true, &par, error));
    WO_TRY(check_values(par, values, count, checked, error));
    if (!isfinite(time))
        return wo_fail(error, WO_ERR_RANGE, "a key of %.60s has no frame", name);
    if (!wo_par_animates(par))
        return wo_fail(error, WO_ERR_UNSUPPORTED, "%.60s cannot change over time", name);
    if (!wo_par_set_key(par, time, checked, NULL))
        return wo_fail(error, WO_ERR_NOMEM, "no memory for %.60s", name);
    return changed(instance, par, error);
}

wo_status wo_host_param_get(wo_host_instance *instance, const char *name, double time,
                            double *values, int count, wo_error *error)
{
    wo_par *par;
    double all[4];
    WO_TRY(find(instance, name, true, &par, error));
    if (par->is_text || count != par->dimension)
        return wo_fail(error, WO_ERR_ARGUMENT, "%.60s has %d numbers, not %d", name, par->dimension,
                       count);
    wo_par_at(par, time, all);
    memcpy(values, all, (size_t)count * sizeof *values);
    return WO_OK;
}

int wo_host_param_get_text(wo_host_instance *instance, const char *name, double time, char *buffer,
                           size_t size)
{
    wo_par *par;
    double values[4];
    if (find(instance, name, true, &par, NULL) != WO_OK)
        return -1;
    if (par->is_text)
        return snprintf(buffer, size, "%s", wo_par_text_at(par, time));
    wo_par_at(par, time, values);
    if (par->kind == WO_HOST_PARAM_BOOLEAN)
        return snprintf(buffer, size, "%s", values[0] != 0 ? "true" : "false");
    if (par->kind == WO_HOST_PARAM_CHOICE)
        return snprintf(buffer, size, "%s",
                        wo_props_text(&par->props, kOfxParamPropChoiceOption, (int)values[0], ""));
    char text[4 * 40] = "";
    size_t used = 0;
    for (int i = 0; i < par->dimension; i++) {
        if (i > 0)
            text[used++] = ',';
        used += (size_t)wo_print_number(text + used, sizeof text - used, values[i]);
    }
    return snprintf(buffer, size, "%s", text);
}

unsigned wo_host_param_key_count(wo_host_instance *instance, const char *name)
{
    wo_par *par;
    return find(instance, name, true, &par, NULL) == WO_OK ? (unsigned)par->key_count : 0;
}

wo_status wo_host_param_press(wo_host_instance *instance, const char *name, wo_error *error)
{
    wo_par *par;
    WO_TRY(find(instance, name, false, &par, error));
    if (par->kind != WO_HOST_PARAM_PUSH_BUTTON)
        return wo_fail(error, WO_ERR_ARGUMENT, "%.60s is no button but a %s", name,
                       wo_host_param_type_text(par->kind));
    wo_mark_changed(instance, par->name);
    return wo_tell_changed(instance, kOfxTypeParameter, par->name, kOfxChangeUserEdited, error);
}

bool wo_host_param_visible(wo_host_instance *instance, const char *name)
{
    wo_par *par;
    return find(instance, name, false, &par, NULL) == WO_OK &&
           !wo_props_int(&par->props, kOfxParamPropSecret, 0, 0);
}

bool wo_host_param_enabled(wo_host_instance *instance, const char *name)
{
    wo_par *par;
    return find(instance, name, false, &par, NULL) == WO_OK &&
           wo_props_int(&par->props, kOfxParamPropEnabled, 0, 0);
}

void wo_host_set_notify(wo_host_instance *instance, bool notify)
{
    instance->notify = notify;
}
