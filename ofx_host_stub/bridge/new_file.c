/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _XOPEN_SOURCE 700
#include "new_file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* Names a signal handler can find. A slot is set while it is FILLING, used while it is LIVE. */
enum { SLOTS = 16, FREE = 0, FILLING, LIVE };
static char slot_names[SLOTS][PATH_MAX];
static atomic_int slot_states[SLOTS];

static int take_slot(void)
{
    for (int i = 0; i < SLOTS; i++) {
        int free_state = FREE;
        if (atomic_compare_exchange_strong(&slot_states[i], &free_state, FILLING))
            return i;
    }
    return -1;
}

/* A name that does not fit is forgotten, as is one without a slot. */
static void fill_slot(int slot, const char *name)
{
    if (slot < 0)
        return;
    atomic_store(&slot_states[slot], FILLING);
    if (strlen(name) < sizeof slot_names[slot]) {
        strcpy(slot_names[slot], name);
        atomic_store(&slot_states[slot], LIVE);
    }
}

static void give_slot(int slot)
{
    if (slot >= 0)
        atomic_store(&slot_states[slot], FREE);
}

void wo_new_file_remove_all(void)
{
    const int before = errno;
    for (int i = 0; i < SLOTS; i++)
        if (atomic_load(&slot_states[i]) == LIVE)
            unlink(slot_names[i]);
    errno = before;
}

static const char *shown(const char *path)
{
    const size_t length = strlen(path), most = 96;
    return length > most ? path + (length - most) : path;
}

static wo_status failure(wo_error *error, const char *what, const char *path, int number)
{
    char words[80] = "";
    if (strerror_r(number, words, sizeof words))
        words[0] = '\0';
    return wo_fail(error, WO_ERR_IO, "cannot %s %s: %s", what, shown(path), words);
}

static size_t folder_length(const char *path)
{
    const char *const slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

/* folder_of's folder and name, malloc-ed with room to spare; folder_of NULL: name alone. */
static char *beside(const char *folder_of, const char *name, size_t room)
{
    const size_t folder = folder_of ? folder_length(folder_of) : 0;
    char *const made = malloc(folder + strlen(name) + 1 + room);
    if (made) {
        memcpy(made, folder_of ? folder_of : "", folder);
        strcpy(made + folder, name);
    }
    return made;
}

/* Where a chain of links ends, whether something is there or not. */
static wo_status follow(const char *path, char **end, wo_error *error)
{
    enum { LINKS_MAX = 40 };
    char *now = beside(NULL, path, 0);
    for (int i = 0; now && i < LINKS_MAX; i++) {
        char leads[PATH_MAX];
        const ssize_t length = readlink(now, leads, sizeof leads - 1);
        if (length <= 0) {
            *end = now;
            return WO_OK;
        }
        leads[length] = '\0';
        char *const next = beside(leads[0] == '/' ? NULL : now, leads, 0);
        free(now);
        now = next;
    }
    if (!now)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for a file name");
    free(now);
    return failure(error, "write", path, ELOOP);
}

/* Creates a file of a new name in the target's folder. */
static wo_status create(const char *path, wo_new_file *file, wo_error *error)
{
    const size_t folder = folder_length(file->target);
    enum { ROOM = 64 };
    file->temporary = beside(file->target, "", ROOM);
    if (!file->temporary)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for a file name");
    for (unsigned attempt = 0; attempt < 1000; attempt++) {
        struct timespec now = {0};
        clock_gettime(CLOCK_REALTIME, &now);
        snprintf(file->temporary + folder, ROOM, ".wideopen-%ld-%lx-%u.tmp", (long)getpid(),
                 (unsigned long)now.tv_nsec, attempt);
        fill_slot(file->slot, file->temporary);
        file->fd = open(file->temporary, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file->fd >= 0)
            return WO_OK;
        if (errno != EEXIST)
            break;
    }
    return failure(error, "create a file for", path, errno);
}

static void forget(wo_new_file *file)
{
    give_slot(file->slot);
    free(file->temporary);
    free(file->target);
    *file = (wo_new_file){.fd = -1, .slot = -1};
}

wo_status wo_new_file_begin(const char *path, wo_new_file *file, wo_error *error)
{
    struct stat about;
    *file = (wo_new_file){.fd = -1, .slot = -1};
    WO_TRY(follow(path, &file->target, error));
    file->exists = !stat(file->target, &about);
    file->mode = file->exists ? about.st_mode & 0777 : 0;
    file->slot = take_slot();
    const wo_status status =
        file->exists && !S_ISREG(about.st_mode)
            ? wo_fail(error, WO_ERR_IO, "%s exists and is no ordinary file", shown(path))
            : create(path, file, error);
    if (status != WO_OK)
        forget(file);
    return status;
}

wo_status wo_new_file_end(wo_new_file *file, wo_status so_far, wo_error *error)
{
    wo_status status = so_far;
    const char *const name = file->target;
    if (file->fd >= 0) {
        if (status == WO_OK && file->exists && fchmod(file->fd, (mode_t)file->mode) &&
            errno != EPERM)
            status = failure(error, "set the permissions of", name, errno);
        if (status == WO_OK && fsync(file->fd) && errno != EINVAL)
            status = failure(error, "write", name, errno);
        if (close(file->fd) && status == WO_OK)
            status = failure(error, "write", name, errno);
    }
    if (status == WO_OK && rename(file->temporary, file->target))
        status = failure(error, "rename a finished file to", name, errno);
    if (status != WO_OK)
        unlink(file->temporary);
    forget(file);
    return status;
}
