/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "catalogue.h"

#include "apart.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

/* ------------------------------------------------------------------------------------- binaries */

void wo_binary_destroy(wo_binary **place)
{
    wo_binary *binary = *place;
    if (!binary)
        return;
    wo_catalogue_clear(&binary->catalogue);
    free(binary->bundle);
    free(binary->path);
    free(binary->real);
    free(binary);
    *place = NULL;
}

static wo_binary *binary_new(const wo_host *host, const char *bundle, const char *path)
{
    struct stat status;
    wo_binary *binary = calloc(1, sizeof *binary);
    if (!binary)
        return NULL;
    binary->bundle = wo_text_copy(bundle);
    binary->path = wo_text_copy(path);
    binary->real = realpath(path, NULL);
    binary->folder = host->folder_count;
    if (stat(path, &status) == 0) {
        binary->size = status.st_size;
        binary->seconds = status.st_mtim.tv_sec;
        binary->nanoseconds = status.st_mtim.tv_nsec;
    }
    if (!binary->bundle || !binary->path || !binary->real)
        wo_binary_destroy(&binary);
    return binary;
}

/* Loads a binary and describes all its plugins in this process. */
static void describe_here(wo_host *host, wo_binary *binary)
{
    const char *why = "";
    wo_module *module = wo_module_open(binary, &why);
    binary->known = true;
    if (!module) {
        wo_note_failure(host, "%s: %s", binary->bundle, why);
        return;
    }
    for (int i = 0; i < wo_module_count(module); i++)
        (void)wo_module_describe(host, binary, module, i);
    wo_module_close(&module);
}

void wo_binary_found(wo_host *host, const char *bundle, const char *path)
{
    wo_binary *binary = binary_new(host, bundle, path);
    wo_binary **binaries =
        wo_grow(host->binaries, host->binary_count, &host->binary_capacity, sizeof *host->binaries);
    if (binaries)
        host->binaries = binaries;
    if (!binary || !binaries) {
        wo_binary_destroy(&binary);
        wo_note(host, "%s: out of memory", bundle);
        return;
    }
    binaries[host->binary_count++] = binary;
    if (host->describer.count == 0)
        describe_here(host, binary);
}

/* --------------------------------------------------------------------------------------- survey */

/* What is new of a binary becomes the host's. */
static void tell(wo_host *host, const wo_binary *binary)
{
    const wo_catalogue *catalogue = &binary->catalogue;
    for (size_t i = 0; i < catalogue->notes.count; i++)
        wo_note(host, "%s", catalogue->notes.items[i]);
    for (size_t i = 0; i < catalogue->failures.count; i++)
        wo_note_failure(host, "%s", catalogue->failures.items[i]);
}

typedef enum doubt { /* of what the cache says */
                     DOUBT_NOTHING,
                     DOUBT_FAILURES,
                     DOUBT_ALL
} doubt;

/* Finds out what is in some binaries. */
static wo_status learn(wo_host *host, wo_binary *const *binaries, size_t count, doubt doubted,
                       wo_error *error)
{
    size_t missing = 0;
    wo_binary **apart = count ? malloc(count * sizeof *apart) : NULL;
    if (count && !apart)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for a list of plugins");
    for (size_t i = 0; i < count; i++) {
        wo_binary *binary = binaries[i];
        if (!binary->known) {
            binary->known = binary->recalled = wo_cache_read(host, binary);
            if (binary->known && binary->catalogue.failures.count == 0)
                tell(host, binary);
        }
        const bool failed = binary->catalogue.failures.count > 0;
        if (binary->recalled && doubted >= (failed ? DOUBT_FAILURES : DOUBT_ALL)) {
            wo_catalogue_clear(&binary->catalogue);
            binary->known = binary->recalled = false;
        }
        if (!binary->known)
            apart[missing++] = binary;
    }
    const wo_status status = wo_apart_describe(host, apart, missing, error);
    for (size_t i = 0; i < missing; i++) {
        if (status != WO_OK) {
            wo_catalogue_clear(&apart[i]->catalogue); /* what there is of it is half */
            continue;
        }
        apart[i]->known = true;
        tell(host, apart[i]);
        wo_cache_write(host, apart[i]);
    }
    free(apart);
    return status;
}

static bool is_found(const wo_host *host, const wo_host_found *info)
{
    for (size_t i = 0; i < host->found_count; i++) {
        const wo_host_found *other = host->found[i];
        if (strcmp(other->identifier, info->identifier) == 0 &&
            other->version_major == info->version_major &&
            other->version_minor >= info->version_minor)
            return true;
    }
    return false;
}

wo_status wo_host_survey(wo_host *host, wo_error *error)
{
    if (host->describer.count > 0)
        WO_TRY(learn(host, host->binaries, host->binary_count, DOUBT_FAILURES, error));
    host->found_count = 0;
    for (size_t i = 0; i < host->binary_count; i++) {
        const wo_catalogue *catalogue = &host->binaries[i]->catalogue;
        for (size_t k = 0; k < catalogue->count; k++) {
            const wo_host_found *info = &catalogue->items[k].info;
            if (is_found(host, info)) {
                wo_note(host, "%s: %s was found before", info->bundle, info->identifier);
                continue;
            }
            const wo_host_found **found =
                wo_grow(host->found, host->found_count, &host->found_capacity, sizeof *found);
            if (!found)
                return wo_fail(error, WO_ERR_NOMEM, "no memory for a list of plugins");
            host->found = found;
            found[host->found_count++] = info;
        }
    }
    return WO_OK;
}

size_t wo_host_found_count(const wo_host *host)
{
    return host->found_count;
}

const wo_host_found *wo_host_found_at(const wo_host *host, size_t index)
{
    return index < host->found_count ? host->found[index] : NULL;
}

/* -------------------------------------------------------------------------------------- by name */

typedef struct match {
    const char *name;
    wo_binary *binary;
    wo_listed *item;
    bool whole; /* by its whole identifier */
    bool ambiguous;
} match;

static const char *last_part(const char *identifier)
{
    const char *dot = strrchr(identifier, '.');
    return dot ? dot + 1 : identifier;
}

static bool newer(const wo_host_found *a, const wo_host_found *b)
{
    if (a->version_major != b->version_major)
        return a->version_major > b->version_major;
    return a->version_minor > b->version_minor;
}

static void consider(match *best, wo_binary *binary)
{
    for (size_t i = 0; i < binary->catalogue.count; i++) {
        wo_listed *item = &binary->catalogue.items[i];
        const bool whole = strcmp(item->info.identifier, best->name) == 0;
        if (!whole && (best->whole || strcmp(last_part(item->info.identifier), best->name) != 0))
            continue;
        const bool first = !best->item || whole > best->whole;
        if (!first && strcmp(best->item->info.identifier, item->info.identifier) != 0) {
            best->ambiguous = true;
        } else if (first || newer(&item->info, &best->item->info)) {
            best->ambiguous = best->ambiguous && !whole;
            best->binary = binary;
            best->item = item;
            best->whole = whole;
        }
    }
}

/* Is a bundle named as a plugin is, or as the last part of its identifier? */
static bool is_namesake(const wo_binary *binary, const char *name)
{
    const char *slash = strrchr(binary->bundle, '/');
    const char *stem = slash ? slash + 1 : binary->bundle;
    const char *part = last_part(name);
    const size_t length = strlen(part);
    return strncmp(stem, part, length) == 0 && strcmp(stem + length, ".ofx.bundle") == 0;
}

/* Of the binaries of one folder: those that are namesakes, or those that are not. */
static wo_status ask(wo_host *host, size_t folder, bool namesakes, doubt doubted, match *best,
                     wo_error *error)
{
    wo_binary **binaries = malloc((host->binary_count + 1) * sizeof *binaries);
    size_t count = 0;
    if (!binaries)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for a list of plugins");
    for (size_t i = 0; i < host->binary_count; i++)
        if (host->binaries[i]->folder == folder &&
            is_namesake(host->binaries[i], best->name) == namesakes)
            binaries[count++] = host->binaries[i];
    wo_status status = WO_OK;
    if (host->describer.count > 0)
        status = learn(host, binaries, count, doubted, error);
    for (size_t i = 0; i < count && status == WO_OK; i++)
        consider(best, binaries[i]);
    free(binaries);
    return status;
}

static wo_status ask_all(wo_host *host, doubt doubted, match *best, wo_error *error)
{
    for (size_t folder = 0; folder <= host->folder_count && !best->item; folder++) {
        WO_TRY(ask(host, folder, true, doubted, best, error));
        if (!best->item)
            WO_TRY(ask(host, folder, false, doubted, best, error));
    }
    return WO_OK;
}

/* Adds a name to a comma-separated list, with "..." where it ends. */
static void list_name(char *list, size_t size, const char *name)
{
    const size_t used = strlen(list);
    const char *comma = used ? ", " : "";
    if (used + strlen(comma) + strlen(name) + 6 < size)
        snprintf(list + used, size - used, "%s%s", comma, name);
    else if (used + 6 < size && (used < 3 || strcmp(list + used - 3, "...") != 0))
        snprintf(list + used, size - used, ", ...");
}

/* Is a name part of an identifier or a label, in whatever case? */
static bool resembles(const char *text, const char *name)
{
    const size_t length = strlen(name);
    for (; *text; text++)
        if (strncasecmp(text, name, length) == 0)
            return true;
    return false;
}

/* There may be several versions of one plugin. */
static bool is_listed(const char *list, const char *name)
{
    const size_t length = strlen(name);
    for (const char *at = strstr(list, name); at; at = strstr(at + 1, name))
        if ((at == list || at[-1] == ' ') && (at[length] == ',' || !at[length]))
            return true;
    return false;
}

/* The binaries that were asked and what they have, for the texts of misses; alike: only what
   resembles the name. Returns how many there are. */
static size_t list_asked(const wo_host *host, const match *best, bool alike, char *list,
                         size_t size)
{
    size_t count = 0;
    for (size_t i = 0; i < host->binary_count; i++) {
        const wo_binary *binary = host->binaries[i];
        if (best->ambiguous && binary->folder != best->binary->folder)
            continue;
        for (size_t k = 0; k < binary->catalogue.count; k++) {
            const wo_host_found *info = &binary->catalogue.items[k].info;
            const char *identifier = info->identifier;
            if (best->ambiguous && strcmp(last_part(identifier), best->name) != 0)
                continue;
            if (alike && !resembles(identifier, best->name) && !resembles(info->label, best->name))
                continue;
            count++;
            if (!is_listed(list, identifier))
                list_name(list, size, identifier);
        }
    }
    return count;
}

static wo_status miss(const wo_host *host, const match *best, wo_error *error)
{
    char list[180] = "";
    if (best->ambiguous) {
        list_asked(host, best, false, list, sizeof list);
        return wo_fail(error, WO_ERR_ARGUMENT, "\"%.40s\" may be any of: %s", best->name, list);
    }
    const char *words = "did you mean ";
    if (!list_asked(host, best, true, list, sizeof list))
        words = list_asked(host, best, false, list, sizeof list) ? "there is: "
                                                                 : "there are none at all";
    return wo_fail(error, WO_ERR_NOT_FOUND, "no plugin \"%.40s\"; %s%s", best->name, words, list);
}

/* Loads the plugin that was found into this process. *stale: the cache did not tell the truth. */
static wo_status bring_here(wo_host *host, const match *best, bool *stale, wo_error *error)
{
    wo_listed *item = best->item;
    wo_binary *binary = best->binary;
    const char *why = "";
    const size_t failures = host->failures.count;
    *stale = false;
    if (item->entry)
        return WO_OK;
    wo_module *module = wo_module_open(binary, &why);
    if (!module)
        return wo_fail(error, WO_ERR_LIBRARY, "%s: %s", binary->bundle, why);
    const char *identifier =
        item->index < wo_module_count(module) ? wo_module_identifier(module, item->index) : NULL;
    *stale = !identifier || strcmp(identifier, item->info.identifier) != 0;
    wo_entry *entry = NULL;
    if (!*stale) {
        wo_catalogue aside = binary->catalogue;
        binary->catalogue = (wo_catalogue){0};
        entry = wo_module_describe(host, binary, module, item->index);
        wo_catalogue_clear(&binary->catalogue);
        binary->catalogue = aside;
    }
    wo_module_close(&module);
    item->entry = entry;
    if (entry)
        return WO_OK;
    if (host->failures.count > failures)
        return wo_fail(error, WO_ERR_LIBRARY, "%s", host->failures.items[host->failures.count - 1]);
    return wo_fail(error, WO_ERR_LIBRARY, "%s: %s cannot be loaded", binary->bundle, best->name);
}

wo_status wo_host_find_plugin(wo_host *host, const char *name, const wo_host_plugin **plugin,
                              wo_error *error)
{
    *plugin = NULL;
    if (!name || !*name)
        return wo_fail(error, WO_ERR_ARGUMENT, "no plugin name given");
    for (int attempt = 0;; attempt++) {
        match best = {.name = name};
        bool stale;
        WO_TRY(ask_all(host, DOUBT_NOTHING, &best, error));
        if (!best.item) /* that shall not be the fault of the cache */
            WO_TRY(ask_all(host, DOUBT_ALL, &best, error));
        if (!best.item || best.ambiguous)
            return miss(host, &best, error);
        const wo_status status = bring_here(host, &best, &stale, error);
        if (status == WO_OK) {
            *plugin = &best.item->entry->info;
            return WO_OK;
        }
        if (!stale || attempt > 0)
            return status;
        wo_catalogue_clear(&best.binary->catalogue);
        best.binary->known = true; /* but not from the cache */
        WO_TRY(wo_apart_describe(host, &best.binary, 1, error));
        wo_cache_write(host, best.binary);
    }
}
