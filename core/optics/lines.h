/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_OPTICS_LINES_H
#define WO_CORE_OPTICS_LINES_H

#include "wideopen/status.h"

/* A text read line by line and word by word: words stand between blanks, a comment goes from # to
   the end of the line. Any bytes are legal input; nothing is allocated. */

#define WO_WORD_SIZE 64

typedef struct wo_lines {
    const char *file; /* for messages */
    const char *next; /* the next line */
    const char *end;  /* of the text */
    const char *at;   /* in this line */
    const char *stop; /* of this line */
    int line;         /* its number, from 1 */
    wo_error *error;
} wo_lines;

wo_lines wo_lines_begin(const char *text, size_t bytes, const char *file, wo_error *error);
/* Goes to the next line; false behind the last. */
bool wo_lines_next(wo_lines *lines);

/* Fails as "FILE:LINE: text". */
wo_status wo_lines_fail(const wo_lines *lines, wo_status status, const char *format, ...)
    WO_PRINTF(3, 4);

/* Whether another word stands in this line. */
bool wo_lines_more(wo_lines *lines);
/* The next word; printable ASCII. what names it where it is missing. */
wo_status wo_lines_word(wo_lines *lines, const char *what, char word[WO_WORD_SIZE]);
/* The whole of text as a finite number. */
wo_status wo_lines_parse(const wo_lines *lines, const char *what, const char *text, double *value);
/* The next word as a number. */
wo_status wo_lines_number(wo_lines *lines, const char *what, double *value);
/* What is left of the line without the blanks around it; # is nothing special. */
wo_status wo_lines_rest(wo_lines *lines, const char *what, const char **text, size_t *bytes);
/* Nothing more may stand in this line. */
wo_status wo_lines_done(wo_lines *lines);

#endif
