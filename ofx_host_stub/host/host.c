/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "catalogue.h"

#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define VIOLATIONS_MAX 2000

void *wo_grow(void *array, size_t count, size_t *capacity, size_t size)
{
    if (count < *capacity)
        return array;
    const size_t more = *capacity ? *capacity * 2 : 8;
    if (more <= *capacity || more > SIZE_MAX / size)
        return NULL;
    void *grown = realloc(array, more * size);
    if (grown)
        *capacity = more;
    return grown;
}

char *wo_text_copy(const char *text)
{
    const size_t size = strlen(text) + 1;
    char *copy = malloc(size);
    if (copy)
        memcpy(copy, text, size);
    return copy;
}

bool wo_text_set(char **place, const char *text)
{
    char *copy = text ? wo_text_copy(text) : NULL;
    if (text && !copy)
        return false;
    free(*place);
    *place = copy;
    return true;
}

bool wo_texts_add(wo_texts *texts, const char *text)
{
    char *copy = wo_text_copy(text);
    char **items = wo_grow(texts->items, texts->count, &texts->capacity, sizeof *texts->items);
    if (items)
        texts->items = items;
    if (!items || !copy) {
        free(copy);
        return false;
    }
    texts->items[texts->count++] = copy;
    return true;
}

void wo_texts_clear(wo_texts *texts)
{
    for (size_t i = 0; i < texts->count; i++)
        free(texts->items[i]);
    free(texts->items);
    *texts = (wo_texts){0};
}

static void note(wo_host *host, bool failure, const char *format, va_list args)
{
    char text[1024];
    vsnprintf(text, sizeof text, format, args);
    pthread_mutex_lock(&host->lock);
    (void)wo_texts_add(&host->notes,
                       text); /* a note that is lost for lack of memory harms nobody */
    if (failure)
        (void)wo_texts_add(&host->failures, text);
    pthread_mutex_unlock(&host->lock);
}

void wo_note(wo_host *host, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    note(host, false, format, args);
    va_end(args);
}

void wo_note_failure(wo_host *host, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    note(host, true, format, args);
    va_end(args);
}

void wo_note_once(wo_host *host, const char *key, const char *format, ...)
{
    host = wo_host_to_blame(host);
    if (!host)
        return;
    pthread_mutex_lock(&host->lock);
    bool known = false;
    for (size_t i = 0; i < host->noted.count && !known; i++)
        known = strcmp(host->noted.items[i], key) == 0;
    if (!known)
        known = !wo_texts_add(&host->noted, key); /* without memory: silence */
    pthread_mutex_unlock(&host->lock);
    va_list args;
    va_start(args, format);
    if (!known)
        note(host, false, format, args);
    va_end(args);
}

static void violate(wo_host *host, const wo_frame *frame, const char *format, va_list args)
{
    char text[1024];
    int length = 0;
    if (frame && frame->host == host && frame->entry)
        length = snprintf(text, sizeof text, "%s: %s: ", frame->entry->info.identifier,
                          wo_action_text(frame->action));
    else
        length = snprintf(text, sizeof text, "outside of actions: ");
    if (length < 0 || (size_t)length >= sizeof text)
        length = 0;
    vsnprintf(text + length, sizeof text - (size_t)length, format, args);

    pthread_mutex_lock(&host->lock);
    bool known = false;
    for (size_t i = 0; i < host->violations.count && !known; i++)
        known = strcmp(host->violations.items[i], text) == 0;
    if (!known && host->violations.count < VIOLATIONS_MAX)
        (void)wo_texts_add(&host->violations, host->violations.count + 1 < VIOLATIONS_MAX
                                                  ? text
                                                  : "there were more than can be listed");
    pthread_mutex_unlock(&host->lock);
}

void wo_violate(wo_host *host, const char *format, ...)
{
    va_list args;
    host = wo_host_to_blame(host);
    va_start(args, format);
    if (host)
        violate(host, wo_frame_now(), format, args);
    va_end(args);
}

void wo_violate_in(const wo_frame *frame, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    violate(frame->host, frame, format, args);
    va_end(args);
}

size_t wo_host_violation_count(wo_host *host)
{
    pthread_mutex_lock(&host->lock);
    const size_t count = host->violations.count;
    pthread_mutex_unlock(&host->lock);
    return count;
}

const char *wo_host_violation(wo_host *host, size_t index)
{
    pthread_mutex_lock(&host->lock);
    const char *text = index < host->violations.count ? host->violations.items[index] : NULL;
    pthread_mutex_unlock(&host->lock);
    return text;
}

void wo_host_violations_clear(wo_host *host)
{
    pthread_mutex_lock(&host->lock);
    wo_texts_clear(&host->violations);
    pthread_mutex_unlock(&host->lock);
}

size_t wo_host_note_count(const wo_host *host)
{
    return host->notes.count;
}

const char *wo_host_note(const wo_host *host, size_t index)
{
    return index < host->notes.count ? host->notes.items[index] : NULL;
}

size_t wo_host_failure_count(const wo_host *host)
{
    return host->failures.count;
}

const char *wo_host_failure(const wo_host *host, size_t index)
{
    return index < host->failures.count ? host->failures.items[index] : NULL;
}

unsigned wo_host_threads(const wo_host *host)
{
    return wo_pool_size(host->pool);
}

wo_status wo_host_create(const wo_host_config *config, wo_host **out, wo_error *error)
{
    static const wo_host_config nothing;
    *out = NULL;
    if (!config)
        config = &nothing;
    wo_host *host = calloc(1, sizeof *host);
    if (!host)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for a host");
    host->config = *config;
    host->config.directories = NULL;
    host->config.directory_count = 0;
    host->config.describer = NULL;
    host->config.cache = NULL;
    if (!(host->config.describe_seconds > 0))
        host->config.describe_seconds = 30;
    if (pthread_mutex_init(&host->lock, NULL) != 0) {
        free(host);
        return wo_fail(error, WO_ERR_NOMEM, "no mutex for a host");
    }
    wo_status status = WO_OK;
    bool copied = wo_text_set(&host->cache, config->cache && *config->cache ? config->cache : NULL);
    for (const char *const *word = config->describer; copied && word && *word; word++)
        copied = wo_texts_add(&host->describer, *word);
    if (!copied)
        status = wo_fail(error, WO_ERR_NOMEM, "no memory for the describer of plugins");
    if (!wo_process_enter(host, config) && status == WO_OK)
        status = wo_fail(error, WO_ERR_NOMEM, "no memory for the host's properties");
    if (status == WO_OK)
        status = wo_pool_create(config->threads, &host->pool, error);
    if (status != WO_OK) {
        wo_host_destroy(&host);
        return status;
    }
    for (size_t i = 0; i < config->directory_count; i++)
        wo_scan_directory(host, config->directories[i], true);
    if (config->search_path) {
        const char *paths = getenv("OFX_PLUGIN_PATH");
        if (paths)
            wo_scan_paths(host, paths);
        wo_scan_directory(host, "/usr/OFX/Plugins", false);
    }
    *out = host;
    return WO_OK;
}

void wo_host_unload(wo_host *host)
{
    while (host->instances) {
        wo_host_instance *instance = host->instances;
        wo_host_instance_destroy(&instance);
    }
    for (size_t i = 0; i < host->entry_count; i++)
        wo_entry_unload(host->entries[i]);
}

void wo_host_destroy(wo_host **place)
{
    wo_host *host = *place;
    if (!host)
        return;
    wo_host_unload(host);
    for (size_t i = 0; i < host->entry_count; i++)
        wo_entry_destroy(&host->entries[i]);
    free(host->entries);
    for (size_t i = 0; i < host->binary_count; i++)
        wo_binary_destroy(&host->binaries[i]);
    free(host->binaries);
    free(host->found);
    free(host->cache);
    wo_texts_clear(&host->describer);
    wo_pool_destroy(&host->pool);
    wo_process_leave(host);
    wo_texts_clear(&host->violations);
    wo_texts_clear(&host->notes);
    wo_texts_clear(&host->failures);
    wo_texts_clear(&host->noted);
    pthread_mutex_destroy(&host->lock);
    free(host);
    *place = NULL;
}

wo_status wo_host_scan(wo_host *host, const char *directory, wo_error *error)
{
    const size_t notes = host->notes.count;
    if (!directory || !*directory)
        return wo_fail(error, WO_ERR_ARGUMENT, "no directory to search");
    wo_scan_directory(host, directory, true);
    for (size_t i = notes; i < host->notes.count; i++)
        if (strstr(host->notes.items[i], "out of memory"))
            return wo_fail(error, WO_ERR_NOMEM, "%s", host->notes.items[i]);
    return WO_OK;
}

size_t wo_host_plugin_count(const wo_host *host)
{
    return host->entry_count;
}

const wo_host_plugin *wo_host_plugin_at(const wo_host *host, size_t index)
{
    return index < host->entry_count ? &host->entries[index]->info : NULL;
}
