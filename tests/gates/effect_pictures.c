/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "effect_table.h"

#include <stdlib.h>
#include <string.h>

/* The list of the pictures of parameters, footage/parameter_pictures.txt, which says what its lines
   are. */

enum { FIELDS = 4, ROWS_MAX = 512 };

typedef struct list {
    const wo_effect *effect;
    void *params; /* room to try values in */
    const char *group;
    int shown[ROWS_MAX]; /* how often, by row */
    faults *faults;
} list;

/* Text without the blanks around it. */
static char *trimmed(char *text)
{
    text += strspn(text, " ");
    size_t length = strlen(text);
    while (length > 0 && text[length - 1] == ' ')
        text[--length] = '\0';
    return text;
}

/* The next word of *text, cut off, or NULL. */
static char *next_word(char **text)
{
    char *const word = *text + strspn(*text, " ");
    char *const end = word + strcspn(word, " ");
    *text = *end ? end + 1 : end;
    *end = '\0';
    return *word ? word : NULL;
}

/* Is key, whose # stands for any number, this name? */
static bool is_name(const char *key, const char *name)
{
    const size_t stem = strcspn(key, "#");
    const size_t digits = strspn(name + (strlen(name) < stem ? 0 : stem), "0123456789");
    if (!key[stem])
        return strcmp(key, name) == 0;
    return strncmp(key, name, stem) == 0 && digits > 0 && strlen(name) == stem + digits;
}

static void try_value(const list *l, const wo_param *row, const char *value)
{
    wo_error error = {WO_OK, ""};
    if (wo_param_parse(row, value, l->params, &error) != WO_OK)
        fault(l->faults, "list of pictures: %s: %s", row->key, error.text);
}

/* "KEY=VALUE ..." */
static void try_settings(const list *l, const char *key, char *text)
{
    for (char *word; (word = next_word(&text));) {
        char *const equals = strchr(word, '=');
        if (equals)
            *equals = '\0';
        const wo_param *const row = wo_param_find(l->effect->params, l->effect->param_count, word);
        if (equals && row)
            try_value(l, row, equals + 1);
        else
            fault(l->faults, "list of pictures: %s: %s is no setting", key, word);
    }
}

static void try_values(const list *l, const wo_param *row, const char *text)
{
    char words[512];
    char *at = words;
    int count = 0;
    snprintf(words, sizeof words, "%s", text);
    for (char *word; (word = next_word(&at)); count++) {
        word[strcspn(word, "*")] = '\0';
        try_value(l, row, word);
    }
    if (count < 2)
        fault(l->faults, "list of pictures: %s: fewer than two values", row->key);
}

static void read_line(list *l, char *line)
{
    char *field[FIELDS];
    for (int i = 0; i < FIELDS; i++) {
        char *const bar = strchr(line, '|');
        if (!bar != (i == FIELDS - 1)) {
            fault(l->faults, "list of pictures: not %d fields: %.60s", FIELDS, line);
            return;
        }
        if (bar)
            *bar = '\0';
        field[i] = trimmed(line);
        line = bar ? bar + 1 : line;
    }
    int matches = 0;
    for (size_t i = 0; i < l->effect->param_count; i++) {
        const wo_param *const row = &l->effect->params[i];
        if (!is_name(field[0], row->key))
            continue;
        matches++;
        l->shown[i]++;
        if (!l->group || strcmp(row->group, l->group) != 0)
            fault(l->faults, "list of pictures: %s is not in group %s", row->key,
                  l->group ? l->group : "(none)");
        try_values(l, row, field[1]);
    }
    if (matches == 0)
        fault(l->faults, "list of pictures: no parameter is called %s", field[0]);
    try_settings(l, field[0], field[3]);
}

void pictures_check(const wo_effect *e, const char *text, const char *folder, faults *f)
{
    list l = {.effect = e, .params = calloc(1, e->params_size), .faults = f};
    char *const copy = malloc(strlen(text) + 1);
    if (!l.params || !copy || e->param_count > ROWS_MAX)
        abort();
    wo_params_default(e->params, e->param_count, l.params);
    strcpy(copy, text);
    for (char *line = copy, *next; line; line = next) {
        next = strchr(line, '\n');
        if (next)
            *next++ = '\0';
        char *const begin = trimmed(line);
        if (*begin == '[') {
            begin[strcspn(begin, "]")] = '\0';
            l.group = begin + 1;
        } else if (*begin && *begin != '#') {
            read_line(&l, begin);
        }
    }
    for (size_t i = 0; i < e->param_count; i++)
        if (l.shown[i] != 1)
            fault(f, "list of pictures: %s is shown %d times", e->params[i].key, l.shown[i]);
    for (size_t i = 0; folder && i < e->group_count; i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/parameters-%s.png", folder, e->groups[i].key);
        FILE *const file = fopen(path, "rb");
        if (!file)
            fault(f,
                  "no picture of the parameters of %s; make one with "
                  "footage/parameter_pictures.sh",
                  e->groups[i].key);
        else
            fclose(file);
    }
    free(copy);
    free(l.params);
}
