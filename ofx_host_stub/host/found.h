/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_HOST_FOUND_H
#define WO_HOST_FOUND_H

#include "host.h"

#ifdef __cplusplus
extern "C" {
#endif

/* All plugins that there are, found out without risk for this process: see config.describer. */

#define WO_HOST_CONTEXTS 3 /* that this host can run: Filter, General, Generator */

/* What is known of a plugin without loading it here. Texts are on one line. */
typedef struct wo_host_found {
    const char *identifier;
    const char *label;
    const char *group;
    unsigned version_major, version_minor;
    const char *bundle;
    const char *contexts[WO_HOST_CONTEXTS]; /* short names */
    size_t context_count;
    size_t breaches;    /* of the standard, when it was described */
    const char *breach; /* the first of them, or "" */
} wo_host_found;

/* Finds out about every plugin that was found: asks the cache and, for what is not there or had
   failed, the describer. Of two with one identifier and major version the first in the order of the
   search stands, or both when the second has a higher minor version. WO_ABORTED when it was
   stopped. */
WO_NODISCARD wo_status wo_host_survey(wo_host *host, wo_error *error);

/* What wo_host_survey has found. */
size_t wo_host_found_count(const wo_host *host);
const wo_host_found *wo_host_found_at(const wo_host *host, size_t index);

/* The work of a describer: a program that has been started by config.describer calls it with the
   arguments behind that command line and returns what it returns, if it returns. It describes the
   plugins of one binary and writes what it finds to a pipe it was given; plugins may do to this
   process what they like. */
int wo_host_describer(int argc, char **argv);

/* Those of the notes that tell of a plugin that should work and does not: it cannot be loaded,
   crashes, hangs, refuses to describe itself. */
size_t wo_host_failure_count(const wo_host *host);
const char *wo_host_failure(const wo_host *host, size_t index);

#ifdef __cplusplus
}
#endif
#endif
