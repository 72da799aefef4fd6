/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_RENDER_REPORT_H
#define WO_CLI_RENDER_REPORT_H

#include "host/host.h"
#include "json.h"
#include "render_input.h"

/* What a render command did, kept while it runs and written as one JSON object at its end:

   {"wideopen": version, "plugin", "version", "context", "threads",
    "clips": {name: {"file", "space"}}, "params": {name: text}, "keys": {name: count},
    "frames": [{"frame", "output", "space", "skipped", "window", "identity", "actions",
                "seconds": {"read", "render", "write"}, "rays", "reports": [...], "plan"}],
    "rays", "seconds", "warnings": [{"frame", "key", "text"}], "violations": [...], "ok", "error"}

   params are the values at the first frame, keys those that change over time. reports holds what
   the plugin said of itself, one object for each render action. rays is their sum, null when the
   plugin reports none. warnings holds the plugin's first
   of each key. */

typedef struct wo_frame_record {
    int frame;
    char *output; /* name of the file, NULL when none was written */
    char *space;  /* its colour space */
    wo_rect window;
    bool skipped; /* left out: a file of it is missing */
    bool identity;
    char identity_clip[64];
    unsigned actions;
    double read_seconds, render_seconds, write_seconds; /* wall clock */
    char **reports;                                     /* JSON texts */
    size_t report_count;
    char *plan;
} wo_frame_record;

typedef struct wo_param_record {
    const char *name; /* borrowed from the host */
    char *value;
    unsigned keys;
} wo_param_record;

typedef struct wo_warning_record {
    int frame;
    char *key, *text;
} wo_warning_record;

typedef struct wo_record {
    const wo_host_plugin *plugin; /* borrowed, as context */
    const wo_host_context_info *context;
    wo_param_record *params;
    size_t param_count;
    wo_frame_record *frames;
    size_t frame_count;
    wo_warning_record *warnings;
    size_t warning_count;
    double seconds;
} wo_record;

/* Keeps plugin, context and the parameters' values at a time; once. False without memory. */
bool wo_record_begin(wo_record *record, wo_host_instance *instance, double time);

/* Starts the next frame's record; NULL without memory. Good until the next one is started. */
wo_frame_record *wo_record_next(wo_record *record, int frame);

/* Keeps a text the plugin published in the latest frame; false without memory. Other kinds than
   "report", "plan" and "warning" are dropped. */
bool wo_record_publish(wo_record *record, const char *kind, const char *text);

/* Keeps a warning about the latest frame, if it is the first one of its key; false without memory.
 */
bool wo_record_warn(wo_record *record, const char *key, const char *text);

/* Keeps a warning about the latest frame; false without memory. */
bool wo_record_add_warning(wo_record *record, const char *key, const char *text);

void wo_record_free(wo_record *record);

/* Writes the object described above; wo_record_begin has been called. failed is NULL, or why the
   render failed. */
void wo_record_write(const wo_record *record, wo_host *host, const wo_inputs *inputs,
                     const wo_error *failed, FILE *out);

/* The same into a file that appears under its name only when it is complete. */
WO_NODISCARD wo_status wo_record_save(const wo_record *record, wo_host *host,
                                      const wo_inputs *inputs, const wo_error *failed,
                                      const char *path, wo_error *error);

#endif
