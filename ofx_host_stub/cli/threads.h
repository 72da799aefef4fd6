/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_THREADS_H
#define WO_CLI_THREADS_H

#include "wideopen/context.h"

/* A runner for the core on count threads (0 = all cores). *count is borrowed and filled in. */
wo_runner wo_threads_runner(unsigned *count);

#endif
