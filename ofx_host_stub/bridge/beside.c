/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "beside.h"

#include <string.h>
#include <unistd.h>

bool wo_beside_program(const char *name, char *path, size_t size)
{
    const ssize_t length = readlink("/proc/self/exe", path, size - 1);
    if (length <= 0)
        return false;
    path[length] = '\0';
    char *const slash = strrchr(path, '/');
    const size_t letters = strlen(name) + 1;
    if (!slash || (size_t)(slash + 1 - path) + letters > size)
        return false;
    memcpy(slash + 1, name, letters);
    return true;
}
