/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_GATES_EFFECT_TABLE_H
#define WO_GATES_EFFECT_TABLE_H

#include "wideopen/effect.h"

#include <stdio.h>

/* What is wrong, counted, and printed to out unless that is NULL. met becomes true with the first
   text that holds wanted. */
typedef struct faults {
    FILE *out;
    int count;
    const char *wanted;
    bool met;
} faults;

void fault(faults *f, const char *format, ...) WO_PRINTF(2, 3);

/* The tables of one effect: parameters, groups, clips, names. */
void check_effect(const wo_effect *effect, faults *f);

/* A text that grows; data is NULL while it is empty. Ends the program when memory is short. */
typedef struct page {
    char *data;
    size_t used, room;
} page;

void page_add(page *p, const char *format, ...) WO_PRINTF(2, 3);
void page_free(page *p);

/* The documentation of an effect as a page of Markdown. */
void page_write(const wo_effect *effect, page *p);

/* Compares a page with the tables: title, first paragraph, every bullet below "Clips" and
   "Parameters", and a picture of each group. Other text and other sections are free. */
void page_check(const wo_effect *effect, const char *text, faults *f);

/* Name of an effect's page: "LensBlur" becomes "lens_blur.md". */
void page_name(const wo_effect *effect, char name[128]);

/* Compares the list of the pictures of an effect's parameters (footage/parameter_pictures.txt) with
   its table: every row is shown once, below its group, with two or more values that it takes. Is
   there a sheet for each group in folder? NULL: not looked for. */
void pictures_check(const wo_effect *effect, const char *text, const char *folder, faults *f);

/* Tables and pages with one mistake each; a mistake that is not found is a fault. */
void check_checks(faults *f);

#endif
