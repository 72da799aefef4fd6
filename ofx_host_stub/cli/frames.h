/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_FRAMES_H
#define WO_CLI_FRAMES_H

#include "wideopen/status.h"

/* Frame numbers as people write them: "1001", "1001-1100", "1-9x2", several joined by commas. */

#define WO_FRAMES_MAX 1000000

typedef struct wo_frames {
    int *numbers; /* malloc-ed; freed by wo_frames_free */
    size_t count;
    int first, last; /* smallest and largest */
    int step;        /* between neighbours when it is the same everywhere, else 1 */
} wo_frames;

/* *frames is empty after a failure. */
WO_NODISCARD wo_status wo_frames_read(const char *text, wo_frames *frames, wo_error *error);
void wo_frames_free(wo_frames *frames);

#endif
