/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_TEXT_FILE_H
#define WO_CLI_TEXT_FILE_H

#include "bridge/new_file.h"

#include <stdio.h>

/* Small files as a whole. */

/* Reads at most limit bytes; a longer file is WO_ERR_RANGE. *text is malloc-ed, with a 0 behind its
 *length bytes; NULL after a failure. */
WO_NODISCARD wo_status wo_text_read(const char *path, size_t limit, char **text, size_t *length,
                                    wo_error *error);

/* A file on its way. It is written under another name first, so that path never holds half a file;
   what exists and is no ordinary file (a pipe, a device) is written into, links are followed.
   Between begin and end, of which the first must succeed, print to out->file; path must live until
   then. */
typedef struct wo_text_out {
    const char *path;
    FILE *file;
    bool direct;
    wo_new_file there; /* unless direct */
} wo_text_out;
WO_NODISCARD wo_status wo_text_begin(wo_text_out *out, const char *path, wo_error *error);
WO_NODISCARD wo_status wo_text_end(wo_text_out *out, wo_error *error);

/* Both at once, for a text in memory. */
WO_NODISCARD wo_status wo_text_save(const char *path, const char *text, size_t length,
                                    wo_error *error);

#endif
