/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_TEXT_FILE_H
#define WO_CLI_TEXT_FILE_H

#include "wideopen/status.h"

/* Small files as a whole. */

/* Reads at most limit bytes; a longer file is WO_ERR_RANGE. *text is malloc-ed, with a 0 behind its
 *length bytes; NULL after a failure. */
WO_NODISCARD wo_status wo_text_read(const char *path, size_t limit, char **text, size_t *length,
                                    wo_error *error);

/* Writes under another name first, so that path never holds half a file. What exists and is no
   ordinary file (a pipe, a link, a device) is written into. */
WO_NODISCARD wo_status wo_text_save(const char *path, const char *text, size_t length,
                                    wo_error *error);

#endif
