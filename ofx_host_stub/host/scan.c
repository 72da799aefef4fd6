/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "catalogue.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/utsname.h>

#define DEPTH_MAX 40 /* of folders in folders */

static const char bundle_end[] = ".ofx.bundle";

/* Name of the folder inside Contents that holds this machine's binaries. */
static const char *architecture(char *buffer, size_t size)
{
    struct utsname name;
    if (uname(&name) != 0)
        return "Linux-x86-64";
    if (strcmp(name.sysname, "Darwin") == 0)
        return "MacOS";
    const char *machine = name.machine;
    if (strcmp(machine, "x86_64") == 0)
        machine = "x86-64";
    else if (machine[0] == 'i' && strcmp(machine + 2, "86") == 0)
        machine = "x86";
    snprintf(buffer, size, "%.20s-%.40s", name.sysname, machine);
    return buffer;
}

/* "a/b"; NULL when out of memory. */
static char *join(const char *a, const char *b)
{
    const size_t size = strlen(a) + strlen(b) + 2;
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%s/%s", a, b);
    return path;
}

static void scan_bundle(wo_host *host, const char *bundle, const char *name)
{
    char name_of_machine[64];
    const char *arch = architecture(name_of_machine, sizeof name_of_machine);
    const int stem = (int)(strlen(name) - (sizeof bundle_end - 1));
    const size_t size = strlen(bundle) + strlen(arch) + strlen(name) + 32;
    char *binary = malloc(size);
    if (!binary) {
        wo_note(host, "%s: out of memory", bundle);
        return;
    }
    snprintf(binary, size, "%s/Contents/%s/%.*s.ofx", bundle, arch, stem, name);
    struct stat status;
    if (stat(binary, &status) != 0 || !S_ISREG(status.st_mode))
        wo_note(host, "%s: no file %s", bundle, binary + strlen(bundle) + 1);
    else
        wo_binary_found(host, bundle, binary);
    free(binary);
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* Names in a folder, sorted, so that results do not depend on the file system. */
static bool list(const char *directory, wo_texts *names)
{
    DIR *folder = opendir(directory);
    if (!folder)
        return false;
    bool ok = true;
    for (const struct dirent *item = readdir(folder); item && ok; item = readdir(folder))
        if (item->d_name[0] != '.' && item->d_name[0] != '@')
            ok = wo_texts_add(names, item->d_name);
    closedir(folder);
    if (!ok)
        errno = ENOMEM;
    else if (names->count > 1)
        qsort(names->items, names->count, sizeof *names->items, by_name);
    return ok;
}

/* Folders that were searched: links may lead back, or to one place in many ways. */
typedef struct folders {
    struct folder {
        dev_t device;
        ino_t number;
    } * items;
    size_t count, capacity;
} folders;

/* True when the folder is new; *ok is false when there is no memory to remember it. */
static bool is_new(folders *seen, const struct stat *status, bool *ok)
{
    *ok = true;
    for (size_t i = 0; i < seen->count; i++)
        if (seen->items[i].device == status->st_dev && seen->items[i].number == status->st_ino)
            return false;
    struct folder *items = wo_grow(seen->items, seen->count, &seen->capacity, sizeof *items);
    *ok = items != NULL;
    if (!items) {
        errno = ENOMEM;
        return false;
    }
    seen->items = items;
    items[seen->count++] = (struct folder){status->st_dev, status->st_ino};
    return true;
}

static void scan(wo_host *host, const char *directory, folders *seen, int depth, bool must_exist)
{
    wo_texts names = {0};
    struct stat status;
    bool ok = stat(directory, &status) == 0;
    if (ok && !is_new(seen, &status, &ok) && ok)
        return;
    if (depth > DEPTH_MAX) {
        wo_note(host, "%s: too many folders in folders", directory);
        return;
    }
    if (!ok || !list(directory, &names)) {
        if (errno == ENOMEM)
            wo_note(host, "%s: out of memory", directory);
        else if (must_exist || errno != ENOENT)
            wo_note(host, "%s: %s", directory,
                    errno == ENOENT    ? "there is no such folder"
                    : errno == ENOTDIR ? "not a folder"
                                       : "unreadable");
        wo_texts_clear(&names);
        return;
    }
    for (size_t i = 0; i < names.count; i++) {
        const char *name = names.items[i];
        const size_t length = strlen(name);
        char *path = join(directory, name);
        if (!path) {
            wo_note(host, "%s: out of memory", directory);
            break;
        }
        const bool bundle = length >= sizeof bundle_end &&
                            strcmp(name + length - (sizeof bundle_end - 1), bundle_end) == 0;
        const bool folder = stat(path, &status) == 0 && S_ISDIR(status.st_mode);
        if (bundle && folder)
            scan_bundle(host, path, name);
        else if (bundle)
            wo_note(host, "%s: a bundle is a folder, this is none", path);
        else if (folder)
            scan(host, path, seen, depth + 1, true);
        free(path);
    }
    wo_texts_clear(&names);
}

void wo_scan_directory(wo_host *host, const char *directory, bool must_exist)
{
    folders seen = {0};
    host->folder_count++;
    scan(host, directory, &seen, 0, must_exist);
    free(seen.items);
}

void wo_scan_paths(wo_host *host, const char *paths)
{
    while (*paths) {
        const size_t length = strcspn(paths, ":;");
        if (length > 0) {
            char *directory = malloc(length + 1);
            if (!directory) {
                wo_note(host, "OFX_PLUGIN_PATH: out of memory");
                return;
            }
            memcpy(directory, paths, length);
            directory[length] = '\0';
            wo_scan_directory(host, directory, false);
            free(directory);
        }
        paths += length + (paths[length] != '\0');
    }
}
