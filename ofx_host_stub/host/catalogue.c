/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "catalogue.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One line for each plugin, note and failure, its fields between tabulators:

       plugin INDEX MAJOR MINOR CONTEXTS BREACHES identifier label group breach
       note text
       fail text

   CONTEXTS is a sum of 1 for the first of context_names, 2 for the second, 4 for the third. */

enum { NUMBERS = 5, TEXTS = 4, TEXT_MAX = 900 };

static const char *const context_names[WO_HOST_CONTEXTS] = {"Filter", "General", "Generator"};

static void item_clear(wo_listed *item)
{
    free((void *)item->info.identifier);
    free((void *)item->info.label);
    free((void *)item->info.group);
    free((void *)item->info.breach);
}

void wo_catalogue_clear(wo_catalogue *catalogue)
{
    for (size_t i = 0; i < catalogue->count; i++)
        item_clear(&catalogue->items[i]);
    free(catalogue->items);
    wo_texts_clear(&catalogue->notes);
    wo_texts_clear(&catalogue->failures);
    *catalogue = (wo_catalogue){0};
}

void wo_line_clean(char *to, size_t size, const char *text)
{
    size_t used = 0;
    for (; *text && used + 1 < size; text++) {
        const unsigned char c = (unsigned char)*text;
        to[used++] = c < ' ' || c == 127 ? ' ' : *text;
    }
    /* A letter of several bytes is kept whole or not at all. */
    if (*text && ((unsigned char)*text & 0xc0) == 0x80) {
        while (used > 0 && ((unsigned char)to[used - 1] & 0xc0) == 0x80)
            used--;
        used -= used > 0;
    }
    to[used] = '\0';
}

static char *clean_copy(const char *text)
{
    char clean[TEXT_MAX];
    wo_line_clean(clean, sizeof clean, text);
    return wo_text_copy(clean);
}

/* Adds an item; the texts are copied. */
static bool add(wo_binary *binary, const wo_listed *from)
{
    wo_catalogue *catalogue = &binary->catalogue;
    wo_listed *items =
        wo_grow(catalogue->items, catalogue->count, &catalogue->capacity, sizeof *items);
    if (!items)
        return false;
    catalogue->items = items;
    wo_listed item = *from;
    item.info.bundle = binary->bundle;
    item.info.identifier = wo_text_copy(from->info.identifier);
    item.info.label = clean_copy(from->info.label);
    item.info.group = clean_copy(from->info.group);
    item.info.breach = clean_copy(from->info.breach);
    if (!item.info.identifier || !item.info.label || !item.info.group || !item.info.breach) {
        item_clear(&item);
        return false;
    }
    items[catalogue->count++] = item;
    return true;
}

static void set_contexts(wo_host_found *info, unsigned bits)
{
    info->context_count = 0;
    for (unsigned i = 0; i < WO_HOST_CONTEXTS; i++)
        if (bits & 1u << i)
            info->contexts[info->context_count++] = context_names[i];
}

static unsigned context_bits(const wo_host_found *info)
{
    unsigned bits = 0;
    for (size_t i = 0; i < info->context_count; i++)
        for (unsigned k = 0; k < WO_HOST_CONTEXTS; k++)
            if (strcmp(info->contexts[i], context_names[k]) == 0)
                bits |= 1u << k;
    return bits;
}

bool wo_catalogue_take(wo_binary *binary, wo_entry *entry, size_t breaches, const char *breach)
{
    const wo_host_plugin *plugin = &entry->info;
    wo_listed item = {
        .info = {.identifier = plugin->identifier,
                 .label = plugin->label,
                 .group = plugin->group,
                 .version_major = plugin->version_major,
                 .version_minor = plugin->version_minor,
                 .breaches = breaches,
                 .breach = breach},
        .index = entry->index,
        .entry = entry,
    };
    for (size_t i = 0; i < plugin->context_count && i < WO_HOST_CONTEXTS; i++)
        item.info.contexts[item.info.context_count++] = plugin->contexts[i].short_name;
    return add(binary, &item);
}

bool wo_catalogue_line(const wo_catalogue *catalogue, size_t i, char line[WO_LINE_MAX])
{
    char clean[TEXT_MAX];
    if (i < catalogue->count) {
        const wo_listed *item = &catalogue->items[i];
        const wo_host_found *info = &item->info;
        wo_line_clean(clean, sizeof clean, info->identifier);
        snprintf(line, WO_LINE_MAX, "plugin\t%d\t%u\t%u\t%u\t%zu\t%s\t%s\t%s\t%s\n", item->index,
                 info->version_major, info->version_minor, context_bits(info), info->breaches,
                 clean, info->label, info->group, info->breach);
        return true;
    }
    i -= catalogue->count;
    const bool note = i < catalogue->notes.count;
    const wo_texts *texts = note ? &catalogue->notes : &catalogue->failures;
    if (!note)
        i -= catalogue->notes.count;
    if (i >= texts->count)
        return false;
    wo_line_clean(clean, sizeof clean, texts->items[i]);
    snprintf(line, WO_LINE_MAX, "%s\t%s\n", note ? "note" : "fail", clean);
    return true;
}

/* The next field of a line; NULL at its end. */
static char *field(char **rest)
{
    char *start = *rest;
    if (!start)
        return NULL;
    char *tab = strchr(start, '\t');
    if (tab)
        *tab = '\0';
    *rest = tab ? tab + 1 : NULL;
    return start;
}

static bool number(const char *text, unsigned *value)
{
    const size_t digits = strspn(text, "0123456789");
    if (digits == 0 || digits > 9 || text[digits])
        return false;
    *value = (unsigned)strtoul(text, NULL, 10);
    return true;
}

static bool read_plugin(wo_binary *binary, char *rest)
{
    unsigned numbers[NUMBERS];
    const char *texts[TEXTS];
    for (int i = 0; i < NUMBERS; i++) {
        const char *text = field(&rest);
        if (!text || !number(text, &numbers[i]))
            return false;
    }
    for (int i = 0; i < TEXTS; i++)
        if (!(texts[i] = field(&rest)))
            return false;
    if (rest || !*texts[0] || numbers[0] >= WO_BINARY_PLUGINS_MAX ||
        numbers[3] >= 1u << WO_HOST_CONTEXTS || binary->catalogue.count >= WO_BINARY_PLUGINS_MAX)
        return false;
    wo_listed item = {
        .info = {.identifier = texts[0],
                 .label = texts[1],
                 .group = texts[2],
                 .version_major = numbers[1],
                 .version_minor = numbers[2],
                 .breaches = numbers[4],
                 .breach = texts[3]},
        .index = (int)numbers[0],
    };
    set_contexts(&item.info, numbers[3]);
    return add(binary, &item);
}

bool wo_catalogue_read(wo_binary *binary, char *line)
{
    char *rest = line;
    wo_catalogue *catalogue = &binary->catalogue;
    for (const char *c = line; *c; c++)
        if (((unsigned char)*c < ' ' && *c != '\t') || *c == 127)
            return false;
    const char *word = field(&rest);
    if (strcmp(word, "plugin") == 0)
        return read_plugin(binary, rest);
    const bool note = strcmp(word, "note") == 0;
    wo_texts *texts = note ? &catalogue->notes : &catalogue->failures;
    if ((!note && strcmp(word, "fail") != 0) || !rest || strchr(rest, '\t') ||
        texts->count >= WO_BINARY_PLUGINS_MAX)
        return false;
    return wo_texts_add(texts, rest);
}
