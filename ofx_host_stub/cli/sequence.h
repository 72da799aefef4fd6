/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_SEQUENCE_H
#define WO_CLI_SEQUENCE_H

#include <wideopen/status.h>

#include <stdbool.h>

/* Which frames of a sequence lie on the disk. Between the first and the last some may be missing.
 */
typedef struct wo_sequence {
    int first, last;
    int nearest; /* to the frame that was asked for; the earlier of two */
    int held;    /* the last one up to it, or the first of all */
} wo_sequence;

/* pattern as wo_io_frame_path takes it. false: it has no mark, or there is no such file. */
bool wo_sequence_look(const char *pattern, int near, wo_sequence *found);

/* Fails, and says which frames there are in the place of one that has no file. */
WO_NODISCARD wo_status wo_sequence_lacks(const char *pattern, int frame, const char *path,
                                         wo_error *error);

#endif
