/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* The parameter tables of all effects: are they sound, and do the pages about them say the same?

   usage: effect_table check          checks the tables
          effect_table pages FOLDER   compares the pages in FOLDER with the tables
          effect_table page EFFECT    prints the page of an effect
          effect_table pictures EFFECT LIST FOLDER
                                      compares the list of the pictures of its parameters with
                                      the table, and looks for the pictures in FOLDER
          effect_table selftest       shows that these checks find mistakes
   Exit 0: all is well. 1: it is not (each fault is printed). 2: wrong use. */

#define _POSIX_C_SOURCE 200809L

#include "effect_table.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>

static int usage(void)
{
    fputs("usage: effect_table check | pages FOLDER | page EFFECT | pictures EFFECT LIST FOLDER | "
          "selftest\n",
          stderr);
    return 2;
}

static void check_all(faults *f)
{
    if (!wo_effects[0])
        fault(f, "there is no effect");
    for (size_t i = 0; wo_effects[i]; i++) {
        check_effect(wo_effects[i], f);
        if (wo_effect_find(wo_effects[i]->name) != wo_effects[i])
            fault(f, "%s: found by name is another effect", wo_effects[i]->name);
    }
}

static bool read_text(const char *path, page *text)
{
    char part[4096];
    FILE *const file = fopen(path, "rb");
    if (!file)
        return false;
    while (fgets(part, sizeof part, file))
        page_add(text, "%s", part);
    fclose(file);
    return true;
}

static void check_pictures(const char *name, const char *path, const char *folder, faults *f)
{
    const wo_effect *const effect = wo_effect_find(name);
    page text = {0};
    if (!effect || !read_text(path, &text))
        fault(f, "%s, %s: no such effect or list", name, path);
    else
        pictures_check(effect, text.data ? text.data : "", folder, f);
    page_free(&text);
}

static void check_page(const wo_effect *effect, const char *folder, faults *f)
{
    char path[4096], name[128];
    page text = {0};
    page_name(effect, name);
    snprintf(path, sizeof path, "%s/%s", folder, name);
    if (!read_text(path, &text)) {
        fault(f, "%s: there is no page core/effects/%s; make one with: effect_table page %s",
              effect->name, name, effect->name);
        return;
    }
    page_check(effect, text.data ? text.data : "", f);
    page_free(&text);
}

static bool is_page_of_an_effect(const char *file)
{
    for (size_t i = 0; wo_effects[i]; i++) {
        char name[128];
        page_name(wo_effects[i], name);
        if (strcmp(name, file) == 0)
            return true;
    }
    return false;
}

static void check_pages(const char *folder, faults *f)
{
    DIR *const directory = opendir(folder);
    if (!directory) {
        fault(f, "%s: cannot be read", folder);
        return;
    }
    for (const struct dirent *entry; (entry = readdir(directory));) {
        const char *const end = strrchr(entry->d_name, '.');
        if (end && strcmp(end, ".md") == 0 && !is_page_of_an_effect(entry->d_name))
            fault(f, "%s: a page about no effect", entry->d_name);
    }
    closedir(directory);
    for (size_t i = 0; wo_effects[i]; i++)
        check_page(wo_effects[i], folder, f);
}

static int print_page(const char *name)
{
    const wo_effect *const effect = wo_effect_find(name);
    page text = {0};
    if (!effect) {
        fprintf(stderr, "effect_table: no effect is called %s\n", name);
        return 2;
    }
    page_write(effect, &text);
    fputs(text.data, stdout);
    page_free(&text);
    return 0;
}

int main(int argc, char **argv)
{
    faults f = {.out = stdout};
    if (argc == 2 && strcmp(argv[1], "check") == 0)
        check_all(&f);
    else if (argc == 3 && strcmp(argv[1], "pages") == 0)
        check_pages(argv[2], &f);
    else if (argc == 3 && strcmp(argv[1], "page") == 0)
        return print_page(argv[2]);
    else if (argc == 5 && strcmp(argv[1], "pictures") == 0)
        check_pictures(argv[2], argv[3], argv[4], &f);
    else if (argc == 2 && strcmp(argv[1], "selftest") == 0)
        check_checks(&f);
    else
        return usage();
    printf("%d faults\n", f.count);
    return f.count > 0;
}
