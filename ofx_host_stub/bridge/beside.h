/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_BESIDE_H
#define WO_BRIDGE_BESIDE_H

#include <stdbool.h>
#include <stddef.h>

/* Path of something in the folder of the running program, there or not; false when the system does
   not tell where that is, or the path is too long. Any thread. */
bool wo_beside_program(const char *name, char *path, size_t size);

#endif
