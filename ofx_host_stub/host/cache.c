/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "catalogue.h"

#include "wideopen/base.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* A file for each binary, named by a hash of its path:

       wideopen-plugins FORMAT VERSION
       file PATH
       bundle PATH
       state SIZE SECONDS NANOSECONDS
       made MACHINE SECONDS
       (lines of the catalogue)
       end HASH

   with tabulators between fields. VERSION is that of the host, whose judgement is written here.
   HASH is of all that stands before its line: a file that is cut or changed is as good as none.
   What had failed counts on the machine where it did, and not for long: somebody may have mended it
   without touching the binary. */

#define FORMAT         "wideopen-plugins\t1\t" WO_VERSION_TEXT
#define BYTES_MAX      (4l << 20)
#define FAILURE_COUNTS 3600 /* seconds */

/* FNV-1a, 64 bits. */
static uint64_t hash(const char *bytes, size_t count)
{
    uint64_t h = 0xcbf29ce484222325u;
    for (size_t i = 0; i < count; i++)
        h = (h ^ (unsigned char)bytes[i]) * 0x100000001b3u;
    return h;
}

static bool name_file(char *path, size_t size, const wo_host *host, const wo_binary *binary)
{
    const int used = snprintf(path, size, "%s/%016llx.txt", host->cache,
                              (unsigned long long)hash(binary->real, strlen(binary->real)));
    return used > 0 && (size_t)used < size;
}

static void name_machine(char *name, size_t size)
{
    char raw[256] = "";
    if (gethostname(raw, sizeof raw - 1) != 0)
        raw[0] = '\0';
    wo_line_clean(name, size, raw);
}

/* The first lines; false when a path has characters that end lines. */
static bool write_head(char *head, size_t size, const wo_binary *binary)
{
    if (strpbrk(binary->real, "\n\t") || strpbrk(binary->bundle, "\n\t"))
        return false;
    const int used =
        snprintf(head, size, FORMAT "\nfile\t%s\nbundle\t%s\nstate\t%lld\t%lld\t%lld\n",
                 binary->real, binary->bundle, (long long)binary->size, (long long)binary->seconds,
                 (long long)binary->nanoseconds);
    return used > 0 && (size_t)used < size;
}

/* ----------------------------------------------------------------------------------------- read */

/* The whole of a plain file that is not too large, with a 0 at its end; NULL for any other. */
static char *read_whole(const char *path, size_t *length)
{
    struct stat status;
    char *text = NULL;
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (file < 0)
        return NULL;
    if (fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0 &&
        status.st_size <= BYTES_MAX && (text = malloc((size_t)status.st_size + 1)))
        *length = (size_t)status.st_size;
    size_t used = 0;
    while (text && used < *length) {
        const ssize_t got = read(file, text + used, *length - used);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            break;
        used += (size_t)got;
    }
    close(file);
    if (text && used < *length) {
        free(text);
        return NULL;
    }
    if (text)
        text[used] = '\0';
    return text;
}

/* Cuts off the last line when it is the hash of what stands before it. */
static bool sound(char *text, size_t length)
{
    unsigned long long said = 0;
    char expected[64];
    if (strlen(text) != length || length < 2 || text[length - 1] != '\n')
        return false;
    char *last = text + length - 1;
    while (last > text && last[-1] != '\n')
        last--;
    said = hash(text, (size_t)(last - text));
    snprintf(expected, sizeof expected, "end\t%016llx\n", said);
    if (strcmp(last, expected) != 0)
        return false;
    *last = '\0';
    return true;
}

/* The line at *rest, ended by a 0; NULL when there is no more. */
static char *next_line(char **rest)
{
    char *line = *rest;
    char *end = strchr(line, '\n');
    if (!end)
        return NULL;
    *end = '\0';
    *rest = end + 1;
    return line;
}

/* Was it made here and lately? */
static bool made_here(const char *line)
{
    char machine[256], expected[300];
    name_machine(machine, sizeof machine);
    const int used = snprintf(expected, sizeof expected, "made\t%s\t", machine);
    if (strncmp(line, expected, (size_t)used) != 0)
        return false;
    const long long age = (long long)time(NULL) - strtoll(line + used, NULL, 10);
    return age >= 0 && age < FAILURE_COUNTS;
}

static bool read_text(wo_binary *binary, char *text)
{
    char head[2 * PATH_MAX + 256];
    if (!write_head(head, sizeof head, binary) || strncmp(text, head, strlen(head)) != 0)
        return false;
    char *rest = text + strlen(head);
    const char *made = next_line(&rest);
    if (!made || strncmp(made, "made\t", 5) != 0)
        return false;
    for (char *line = next_line(&rest); line; line = next_line(&rest))
        if (!wo_catalogue_read(binary, line))
            return false;
    return binary->catalogue.failures.count == 0 || made_here(made);
}

bool wo_cache_read(const wo_host *host, wo_binary *binary)
{
    char path[PATH_MAX];
    size_t length = 0;
    if (!host->cache || !name_file(path, sizeof path, host, binary))
        return false;
    char *text = read_whole(path, &length);
    const bool ok = text && sound(text, length) && read_text(binary, text);
    free(text);
    if (!ok)
        wo_catalogue_clear(&binary->catalogue);
    return ok;
}

/* ---------------------------------------------------------------------------------------- write */

typedef struct text {
    char *bytes;
    size_t count, capacity;
    bool failed;
} text;

static void append(text *to, const char *line)
{
    const size_t length = strlen(line);
    while (!to->failed && to->capacity - to->count < length + 1) {
        const size_t more = to->capacity ? to->capacity * 2 : 4096;
        char *bytes = realloc(to->bytes, more);
        to->failed = bytes == NULL;
        if (bytes) {
            to->bytes = bytes;
            to->capacity = more;
        }
    }
    if (to->failed)
        return;
    memcpy(to->bytes + to->count, line, length + 1);
    to->count += length;
}

/* The folder and those above it. */
static void make_folders(const char *folder)
{
    char path[PATH_MAX];
    if (snprintf(path, sizeof path, "%s", folder) >= (int)sizeof path)
        return;
    for (char *c = path + 1; *c; c++) {
        if (*c != '/')
            continue;
        *c = '\0';
        (void)mkdir(path, 0700);
        *c = '/';
    }
    (void)mkdir(path, 0700);
}

static bool write_whole(int file, const char *bytes, size_t count)
{
    while (count > 0) {
        const ssize_t done = write(file, bytes, count);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0)
            return false;
        bytes += done;
        count -= (size_t)done;
    }
    return true;
}

/* A new file with a name of its own, which others may read as the user's files are; -1 = none. */
static int create(const wo_host *host, char *path, size_t size)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    const int used =
        snprintf(path, size, "%s/.wideopen-%lx-%llx-%lx", host->cache, (unsigned long)getpid(),
                 (unsigned long long)now.tv_sec, (unsigned long)now.tv_nsec);
    if (used < 0 || (size_t)used >= size) {
        errno = ENAMETOOLONG;
        return -1;
    }
    return open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
}

/* Under a name of its own first: readers see the old file or the new one, writers do not meet. */
static bool save(const wo_host *host, const char *path, const text *all)
{
    char temporary[PATH_MAX];
    int file = create(host, temporary, sizeof temporary);
    if (file < 0 && errno == ENOENT) {
        make_folders(host->cache);
        file = create(host, temporary, sizeof temporary);
    }
    if (file < 0)
        return false;
    bool ok = write_whole(file, all->bytes, all->count);
    ok = close(file) == 0 && ok;
    ok = ok && rename(temporary, path) == 0;
    if (!ok) {
        const int why = errno;
        (void)unlink(temporary);
        errno = why;
    }
    return ok;
}

void wo_cache_write(wo_host *host, const wo_binary *binary)
{
    char path[PATH_MAX], head[2 * PATH_MAX + 256], line[WO_LINE_MAX], machine[256];
    if (!host->cache || !name_file(path, sizeof path, host, binary) ||
        !write_head(head, sizeof head, binary))
        return;
    text all = {0};
    append(&all, head);
    name_machine(machine, sizeof machine);
    snprintf(line, sizeof line, "made\t%s\t%lld\n", machine, (long long)time(NULL));
    append(&all, line);
    for (size_t i = 0; wo_catalogue_line(&binary->catalogue, i, line); i++)
        append(&all, line);
    if (!all.failed) {
        snprintf(line, sizeof line, "end\t%016llx\n",
                 (unsigned long long)hash(all.bytes, all.count));
        append(&all, line);
    }
    if (!all.failed && !save(host, path, &all) && !host->cache_told) {
        host->cache_told = true;
        wo_note(host, "%s: what is known of plugins cannot be kept there: %s", host->cache,
                strerror(errno));
    }
    free(all.bytes);
}
