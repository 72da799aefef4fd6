/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "sequence.h"

#include "bridge/image_io.h"
#include "picture_file.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FRAME_MAX = 100000000 };

/* Length of pattern up to the end of the first name in it that has a mark; 0 when none has. */
static size_t marked_length(const char *pattern)
{
    char part[PATH_MAX];
    size_t length = 0;
    while (pattern[length]) {
        length += strspn(pattern + length, "/");
        length += strcspn(pattern + length, "/");
        if (length + 1 >= sizeof part)
            return 0;
        /* with its slash, which tells a folder that is there */
        const size_t bytes = length + (pattern[length] == '/');
        memcpy(part, pattern, bytes);
        part[bytes] = '\0';
        if (wo_io_is_sequence(part))
            return length;
    }
    return 0;
}

static const char *last_name(const char *path)
{
    const char *const slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* Where the number stands in the last name of part: what two numbers of one length tell apart. */
static bool number_place(const char *part, size_t *place)
{
    char a[PATH_MAX], b[PATH_MAX];
    if (wo_io_frame_path(part, 1111, a, sizeof a, NULL) != WO_OK ||
        wo_io_frame_path(part, 2222, b, sizeof b, NULL) != WO_OK)
        return false;
    const char *const name = last_name(a), *const other = last_name(b);
    for (*place = 0; name[*place] == other[*place]; ++*place)
        if (!name[*place])
            return false;
    return true;
}

/* Is name what the last name of part is at some frame? */
static bool frame_of(const char *part, size_t place, const char *name, int *frame)
{
    char path[PATH_MAX], *end;
    if (strlen(name) <= place)
        return false;
    errno = 0;
    const long number = strtol(name + place, &end, 10);
    if (errno || end == name + place || number < -FRAME_MAX || number > FRAME_MAX)
        return false;
    *frame = (int)number;
    return wo_io_frame_path(part, *frame, path, sizeof path, NULL) == WO_OK &&
           strcmp(last_name(path), name) == 0;
}

static void take(wo_sequence *found, bool any, int frame, int near)
{
    if (!any) {
        *found = (wo_sequence){frame, frame, frame, frame};
        return;
    }
    const long long distance = llabs((long long)frame - near);
    const long long best = llabs((long long)found->nearest - near);
    if (distance < best || (distance == best && frame < found->nearest))
        found->nearest = frame;
    if (found->held > near ? frame < found->held : frame <= near && frame > found->held)
        found->held = frame;
    found->first = frame < found->first ? frame : found->first;
    found->last = frame > found->last ? frame : found->last;
}

bool wo_sequence_look(const char *pattern, int near, wo_sequence *found)
{
    char part[PATH_MAX], folder[PATH_MAX];
    const size_t length = marked_length(pattern);
    size_t place;
    bool any = false;
    if (length == 0)
        return false;
    memcpy(part, pattern, length);
    part[length] = '\0';
    const size_t before = (size_t)(last_name(part) - part);
    memcpy(folder, part, before);
    snprintf(folder + before, sizeof folder - before, "%s", before ? "" : ".");
    DIR *const directory = number_place(part, &place) ? opendir(folder) : NULL;
    if (!directory)
        return false;
    for (const struct dirent *entry; (entry = readdir(directory));) {
        int frame;
        /* behind a folder with a mark there are more names */
        if (!frame_of(part, place, entry->d_name, &frame) ||
            (pattern[length] && !wo_picture_exists(pattern, frame)))
            continue;
        take(found, any, frame, near);
        any = true;
    }
    closedir(directory);
    return any;
}

wo_status wo_sequence_lacks(const char *pattern, int frame, const char *path, wo_error *error)
{
    wo_sequence there;
    if (!wo_sequence_look(pattern, frame, &there))
        return wo_fail(error, WO_ERR_IO, "there is no %s, nor any other frame of %s", path,
                       pattern);
    return wo_fail(error, WO_ERR_IO,
                   "there is no %s (frames %d to %d); --missing-frames skip leaves such a frame "
                   "out, hold repeats the one before it",
                   path, there.first, there.last);
}
