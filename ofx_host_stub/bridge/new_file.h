/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_NEW_FILE_H
#define WO_BRIDGE_NEW_FILE_H

#include "wideopen/status.h"

/* A file that appears under its name only when it is complete: it is written beside it under
   another, then renamed over it. What was there before survives a failure. */
typedef struct wo_new_file {
    char *target;    /* path, or where it leads when it is a symbolic link */
    char *temporary; /* the other name */
    int fd;          /* open for reading and writing */
    bool exists;     /* target does; its permissions are kept */
    unsigned mode;
    int slot;
} wo_new_file;

/* Links are followed to their end, which need not exist. What exists and is no ordinary file is
   refused. After a failure there is nothing to end. */
WO_NODISCARD wo_status wo_new_file_begin(const char *path, wo_new_file *file, wo_error *error);

/* With WO_OK so far: makes it last and renames it; else, or when that fails, removes it. Closes fd
   unless that is -1 by now. Gives so_far, or what failed here. */
WO_NODISCARD wo_status wo_new_file_end(wo_new_file *file, wo_status so_far, wo_error *error);

/* Removes all that are not ended, as the last act of a program that is told to go; a signal handler
   may call it. */
void wo_new_file_remove_all(void);

#endif
