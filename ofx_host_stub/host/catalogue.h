/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_HOST_CATALOGUE_H
#define WO_HOST_CATALOGUE_H

#include "internal.h"

/* Binaries, and what is known of their plugins without loading them. */

#define WO_BINARY_PLUGINS_MAX 1000 /* plugins in one binary */

typedef struct wo_listed { /* a plugin of a binary */
    wo_host_found info;    /* its texts but bundle and contexts are owned */
    int index;             /* in the binary */
    wo_entry *entry;       /* when it is described here */
} wo_listed;

typedef struct wo_catalogue { /* what is known of the plugins of a binary */
    wo_listed *items;
    size_t count, capacity;
    wo_texts notes, failures; /* no failure is among these notes */
} wo_catalogue;

struct wo_binary { /* a file that may hold plugins */
    char *bundle, *path;
    char *real;                         /* path, absolute and without links */
    size_t folder;                      /* number of the search that found it */
    int64_t size, seconds, nanoseconds; /* of the file and of its last change */
    bool known;                         /* the catalogue is filled */
    bool recalled;                      /* from the cache */
    wo_catalogue catalogue;
};

/* catalogue.c. What is read is checked: lines may come from anywhere. */
void wo_catalogue_clear(wo_catalogue *catalogue);
/* Adds an entry that is described here; false when out of memory. */
WO_NODISCARD bool wo_catalogue_take(wo_binary *binary, wo_entry *entry, size_t breaches,
                                    const char *breach);
/* A text with control characters and what is too long taken away. */
#define WO_LINE_MAX 4096
void wo_line_clean(char *to, size_t size, const char *text);
/* Writes item i, then notes, then failures as lines with "\n"; false beyond the last. */
bool wo_catalogue_line(const wo_catalogue *catalogue, size_t i, char line[WO_LINE_MAX]);
/* Takes a line without its "\n", which is changed; false when it is none. */
WO_NODISCARD bool wo_catalogue_read(wo_binary *binary, char *line);

/* cache.c. True when the cache knows the binary; the catalogue is empty before and filled after. */
bool wo_cache_read(const wo_host *host, wo_binary *binary);
void wo_cache_write(wo_host *host, const wo_binary *binary);

/* find.c. A binary was found; without a describer it is described at once. */
void wo_binary_found(wo_host *host, const char *bundle, const char *path);
void wo_binary_destroy(wo_binary **binary);

/* load.c. Maps a binary; NULL with the reason in *why. Its plugins are asked for by number. */
wo_module *wo_module_open(const wo_binary *binary, const char **why);
void wo_module_close(wo_module **module);
int wo_module_count(const wo_module *module);
/* Identifier of a plugin, NULL for one that is none for us. */
const char *wo_module_identifier(wo_module *module, int index);
/* Makes an entry of a plugin and describes it; what stands in the way becomes a note and NULL. */
wo_entry *wo_module_describe(wo_host *host, wo_binary *binary, wo_module *module, int index);

#endif
