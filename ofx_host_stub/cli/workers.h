/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_WORKERS_H
#define WO_CLI_WORKERS_H

#include "wideopen/context.h"

/* Threads for commands that compute by themselves. Every run starts its threads and joins them; a thread
   that cannot be started is done without. count 0: one per core. *count is borrowed by the runner
   and gets the number used. Does not fail. */
wo_runner wo_workers_make(unsigned *count);

#endif
