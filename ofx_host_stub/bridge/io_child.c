/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _GNU_SOURCE
#include "io_child_private.h"

#include "beside.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

enum {
    MOST_IDLE = 4, /* helpers kept */
    PATIENCE = 10, /* seconds beyond the limits that the other side keeps by itself */
    PIPE_BYTES = 1 << 20
};

/* A running wideopen-read. */
typedef struct helper {
    pid_t pid;
    int socket;
    unsigned read; /* files that its present process has read */
} helper;

/* Those that have nothing to do. A fork of this program does not share them with it. */
static struct {
    pthread_mutex_t lock;
    pid_t owner;
    helper idle[MOST_IDLE];
    size_t count;
    unsigned files;
    bool go_on;
} pool = {.lock = PTHREAD_MUTEX_INITIALIZER, .files = 16};

void wo_io_files_per_process(unsigned files, bool behind_refused)
{
    pthread_mutex_lock(&pool.lock);
    pool.files = files > 0 ? files : 1;
    pool.go_on = behind_refused;
    pthread_mutex_unlock(&pool.lock);
}

/* Starting and ending helpers. */

static wo_status system_failure(const char *what, int number, wo_error *error)
{
    char words[80] = "";
    return wo_fail(error, WO_ERR_LIBRARY, "%s: %s", what, strerror_r(number, words, sizeof words));
}

static int spawn_on(const char *program, int end, pid_t *pid)
{
    static char name[] = WO_CHILD_PROGRAM;
    char *const words[] = {name, NULL};
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    sigset_t none, every;
    sigemptyset(&none);
    sigfillset(&every);
    int result = posix_spawn_file_actions_init(&files);
    if (result)
        return result;
    result = posix_spawnattr_init(&attributes);
    if (result) {
        posix_spawn_file_actions_destroy(&files);
        return result;
    }
    /* quiet, with nothing of ours but its end of the socket, in a group of its own: Ctrl-C is for
       us, who end by ourselves */
    if (!(result = posix_spawn_file_actions_adddup2(&files, end, WO_CHILD_SOCKET)) &&
        !(result = posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0)) &&
        !(result = posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0)) &&
        !(result = posix_spawn_file_actions_addopen(&files, 2, "/dev/null", O_WRONLY, 0)) &&
        !(result = posix_spawn_file_actions_addclosefrom_np(&files, WO_CHILD_SOCKET + 1)) &&
        !(result = posix_spawnattr_setpgroup(&attributes, 0)) &&
        !(result = posix_spawnattr_setsigmask(&attributes, &none)) &&
        !(result = posix_spawnattr_setsigdefault(&attributes, &every)) &&
        !(result = posix_spawnattr_setflags(
              &attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF)))
        result = posix_spawn(pid, program, &files, &attributes, words, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return result;
}

static wo_status start_helper(helper *made, wo_error *error)
{
    char program[PATH_MAX];
    int ends[2];
    if (!wo_beside_program(WO_CHILD_PROGRAM, program, sizeof program))
        return wo_fail(error, WO_ERR_LIBRARY,
                       "the system does not tell where " WO_CHILD_PROGRAM " is");
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends))
        return system_failure("no socket for " WO_CHILD_PROGRAM, errno, error);
    const int result = spawn_on(program, ends[1], &made->pid);
    close(ends[1]);
    if (result) {
        close(ends[0]);
        return wo_fail(error, WO_ERR_LIBRARY, "formats other than EXR need %s: %s",
                       wo_io_shown(program), strerrordesc_np(result));
    }
    made->socket = ends[0];
    made->read = 0;
    return WO_OK;
}

/* Its processes are gone when this returns. */
static void end_helper(helper *which)
{
    close(which->socket);
    kill(-which->pid, SIGKILL);
    while (waitpid(which->pid, NULL, 0) < 0 && errno == EINTR)
        ;
}

static wo_status take_helper(helper *taken, wo_error *error)
{
    bool found = false;
    pthread_mutex_lock(&pool.lock);
    if (pool.owner != getpid()) {
        for (size_t i = 0; i < pool.count; i++)
            close(pool.idle[i].socket);
        pool.count = 0;
        pool.owner = getpid();
    }
    if (pool.count > 0) {
        *taken = pool.idle[--pool.count];
        found = true;
    }
    pthread_mutex_unlock(&pool.lock);
    return found ? WO_OK : start_helper(taken, error);
}

static void give_helper(helper *given)
{
    bool kept = false;
    pthread_mutex_lock(&pool.lock);
    if (pool.count < MOST_IDLE) {
        pool.idle[pool.count++] = *given;
        kept = true;
    }
    pthread_mutex_unlock(&pool.lock);
    if (!kept)
        end_helper(given);
}

void wo_io_end_helpers(void)
{
    for (;;) {
        helper last;
        pthread_mutex_lock(&pool.lock);
        const bool any = pool.count > 0 && pool.owner == getpid();
        if (any)
            last = pool.idle[--pool.count];
        pthread_mutex_unlock(&pool.lock);
        if (!any)
            return;
        end_helper(&last);
    }
}

/* Reading from a descriptor. */

typedef enum flow { FLOW_OK, FLOW_END, FLOW_LATE } flow;

/* Waits until something can be read. */
static flow wait_for(int fd, unsigned seconds)
{
    struct pollfd entry = {.fd = fd, .events = POLLIN};
    int ready;
    do
        ready = poll(&entry, 1, seconds < INT_MAX / 1000 ? (int)seconds * 1000 : INT_MAX);
    while (ready < 0 && errno == EINTR);
    return ready > 0 ? FLOW_OK : ready == 0 ? FLOW_LATE : FLOW_END;
}

/* Exactly size bytes. */
static flow read_all(int fd, void *to, uint64_t size, unsigned seconds)
{
    char *at = to;
    while (size > 0) {
        const flow ready = wait_for(fd, seconds);
        if (ready != FLOW_OK)
            return ready;
        const ssize_t got = read(fd, at, size < (1u << 30) ? (size_t)size : (size_t)1 << 30);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            return FLOW_END;
        at += got;
        size -= (uint64_t)got;
    }
    return FLOW_OK;
}

/* One file on its way. */
typedef struct passage {
    const char *path;
    int pipe;
    uint64_t picture;  /* bytes, as far as is known */
    unsigned seconds;  /* the longest wait without progress */
    bool headers_only; /* what was asked */
    bool ended;        /* its END has come */
    wo_io_file *file;
} passage;

static wo_status out_of_place(wo_error *error)
{
    return wo_fail(error, WO_ERR_FORMAT, "the image library's words make no sense");
}

static wo_status take_head(passage *p, const wo_child_record *record, flow *state, wo_error *error)
{
    if (p->file || record->bytes > WO_CHILD_MAX_HEAD)
        return out_of_place(error);
    wo_wire wire = {malloc((size_t)record->bytes + 1), (size_t)record->bytes, 0};
    if (!wire.bytes)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for the head of %s", wo_io_shown(p->path));
    wo_status status = WO_OK;
    *state = read_all(p->pipe, wire.bytes, wire.size, p->seconds);
    if (*state == FLOW_OK)
        status = wo_wire_get_file(p->path, &wire, &p->file, error);
    free(wire.bytes);
    uint64_t bytes = 0;
    for (size_t i = 0; p->file && i < p->file->part_count; i++) {
        const wo_io_part *const part = &p->file->parts[i];
        bytes += (uint64_t)wo_rect_width(part->data_window) *
                 (uint64_t)wo_rect_height(part->data_window) * (uint64_t)part->channels * 4;
    }
    p->picture = bytes > p->picture ? bytes : p->picture;
    p->seconds = wo_child_wall_seconds(p->picture) + PATIENCE;
    return status;
}

static wo_status take_pixels(passage *p, const wo_child_record *record, flow *state,
                             wo_error *error)
{
    if (!p->file || record->index >= p->file->part_count || p->headers_only)
        return out_of_place(error);
    wo_io_part *const part = &p->file->parts[record->index];
    const uint64_t bytes = (uint64_t)wo_rect_width(part->data_window) *
                           (uint64_t)wo_rect_height(part->data_window) * (uint64_t)part->channels *
                           sizeof *part->pixels;
    if (part->pixels || part->fault || record->bytes != bytes)
        return out_of_place(error);
    WO_TRY(wo_io_part_pixels(part, error));
    *state = read_all(p->pipe, part->pixels, bytes, p->seconds);
    return WO_OK;
}

/* A text of the record's length. */
static wo_status take_text(const passage *p, const wo_child_record *record,
                           char text[WO_CHILD_MAX_TEXT + 1], flow *state, wo_error *error)
{
    if (record->bytes > WO_CHILD_MAX_TEXT)
        return out_of_place(error);
    *state = read_all(p->pipe, text, record->bytes, p->seconds);
    text[record->bytes] = '\0';
    return WO_OK;
}

static wo_status take_fault(passage *p, const wo_child_record *record, flow *state, wo_error *error)
{
    char text[WO_CHILD_MAX_TEXT + 1];
    if (!p->file || record->index >= p->file->part_count || p->file->parts[record->index].pixels ||
        p->file->parts[record->index].fault)
        return out_of_place(error);
    WO_TRY(take_text(p, record, text, state, error));
    p->file->parts[record->index].fault = wo_io_copy_text(text);
    return p->file->parts[record->index].fault
               ? WO_OK
               : wo_fail(error, WO_ERR_NOMEM, "no memory for a text");
}

/* Is everything there that was asked for? */
static bool is_complete(const passage *p)
{
    for (size_t i = 0; p->file && !p->headers_only && i < p->file->part_count; i++)
        if (!p->file->parts[i].pixels && !p->file->parts[i].fault)
            return false;
    return p->file != NULL;
}

static wo_status take_end(passage *p, const wo_child_record *record, flow *state, wo_error *error)
{
    char text[WO_CHILD_MAX_TEXT + 1];
    WO_TRY(take_text(p, record, text, state, error));
    if (*state != FLOW_OK)
        return WO_OK;
    p->ended = true;
    if (record->index == WO_OK)
        return is_complete(p) ? WO_OK : out_of_place(error);
    return wo_fail(error,
                   record->index < WO_STATUS_COUNT ? (wo_status)record->index : WO_ERR_LIBRARY,
                   "%s", text);
}

/* Takes records until the END or the end of the pipe. */
static wo_status take_records(passage *p, flow *state, wo_error *error)
{
    *state = FLOW_OK;
    while (!p->ended && *state == FLOW_OK) {
        wo_child_record record;
        wo_status status = WO_OK;
        *state = read_all(p->pipe, &record, sizeof record, p->seconds);
        if (*state != FLOW_OK)
            break;
        if (record.kind == WO_CHILD_HEAD)
            status = take_head(p, &record, state, error);
        else if (record.kind == WO_CHILD_PIXELS)
            status = take_pixels(p, &record, state, error);
        else if (record.kind == WO_CHILD_FAULT)
            status = take_fault(p, &record, state, error);
        else if (record.kind == WO_CHILD_END)
            status = take_end(p, &record, state, error);
        else
            status = out_of_place(error);
        WO_TRY(status);
    }
    return WO_OK;
}

/* Reads on to the end of the pipe, so that the other side is never left in the middle. */
static flow drain(int pipe, unsigned seconds)
{
    char waste[4096];
    for (;;) {
        const flow ready = wait_for(pipe, seconds);
        if (ready != FLOW_OK)
            return ready;
        const ssize_t got = read(pipe, waste, sizeof waste);
        if (got == 0 || (got < 0 && errno != EINTR))
            return FLOW_END;
    }
}

/* One exchange. */

static bool send_request(const helper *with, const wo_child_request *request, int file, int pipe)
{
    union {
        struct cmsghdr head;
        char bytes[CMSG_SPACE(2 * sizeof(int))];
    } control = {.bytes = {0}};
    const int both[2] = {file, pipe};
    struct iovec part = {(void *)(uintptr_t)request, sizeof *request};
    struct msghdr message = {.msg_iov = &part,
                             .msg_iovlen = 1,
                             .msg_control = &control,
                             .msg_controllen = sizeof control};
    struct cmsghdr *const head = CMSG_FIRSTHDR(&message);
    head->cmsg_level = SOL_SOCKET;
    head->cmsg_type = SCM_RIGHTS;
    head->cmsg_len = CMSG_LEN(sizeof both);
    memcpy(CMSG_DATA(head), both, sizeof both);
    ssize_t sent;
    do
        sent = sendmsg(with->socket, &message, MSG_NOSIGNAL);
    while (sent < 0 && errno == EINTR);
    return sent == (ssize_t)sizeof *request;
}

static bool take_reply(const helper *with, wo_child_reply *words)
{
    if (wait_for(with->socket, PATIENCE) != FLOW_OK)
        return false;
    ssize_t got;
    do
        got = recv(with->socket, words, sizeof *words, 0);
    while (got < 0 && errno == EINTR);
    return got == (ssize_t)sizeof *words && words->mark == WO_CHILD_MARK;
}

/* Why a process ended that said nothing. */
static wo_status explain(const passage *p, const wo_child_request *request, int state,
                         wo_error *error)
{
    const char *const path = wo_io_shown(p->path), *const kind = request->extension;
    const int number = WIFSIGNALED(state) ? WTERMSIG(state) : 0;
    if (number == SIGXCPU || number == SIGALRM)
        return wo_fail(error, WO_ERR_FORMAT,
                       "%s: the %s reader took more than %u s and was stopped: the file is damaged",
                       path, kind,
                       number == SIGXCPU ? wo_child_seconds(p->picture)
                                         : wo_child_wall_seconds(p->picture));
    if (number == SIGKILL)
        return wo_fail(error, WO_ERR_NOMEM,
                       "%s: the %s reader was killed, as the system does when memory runs out",
                       path, kind);
    if (number)
        return wo_fail(error, WO_ERR_FORMAT,
                       "%s: the %s reader crashed (signal %d): the file is damaged", path, kind,
                       number);
    return wo_fail(error, WO_ERR_FORMAT,
                   "%s: the %s reader ended without a word (status %d): the file is damaged", path,
                   kind, WEXITSTATUS(state));
}

/* *usable is false when the helper cannot be used any more; *again when the file is to be tried
   once more with another. */
static wo_status exchange(helper *with, const wo_child_request *request, passage *p, int file,
                          bool *usable, bool *again, wo_error *error)
{
    int ends[2];
    flow state;
    wo_child_reply words;
    *usable = false;
    *again = false;
    if (pipe2(ends, O_CLOEXEC)) {
        *usable = true;
        return system_failure("no pipe for " WO_CHILD_PROGRAM, errno, error);
    }
    (void)fcntl(ends[0], F_SETPIPE_SZ, PIPE_BYTES);
    if (!send_request(with, request, file, ends[1])) {
        close(ends[0]);
        close(ends[1]);
        *again = true; /* it ended while it was idle */
        return wo_fail(error, WO_ERR_LIBRARY, "%s: " WO_CHILD_PROGRAM " does not listen",
                       wo_io_shown(p->path));
    }
    close(ends[1]);
    p->pipe = ends[0];
    const wo_status status = take_records(p, &state, error);
    const flow rest = state == FLOW_LATE ? FLOW_LATE : drain(ends[0], p->seconds);
    close(ends[0]);
    if (state == FLOW_LATE || rest == FLOW_LATE)
        return wo_fail(error, WO_ERR_FORMAT,
                       "%s: the %s reader said nothing for %u seconds: the file is damaged",
                       wo_io_shown(p->path), request->extension, p->seconds);
    if (!take_reply(with, &words)) {
        *again = true;
        return wo_fail(error, WO_ERR_LIBRARY, "%s: " WO_CHILD_PROGRAM " is gone",
                       wo_io_shown(p->path));
    }
    *usable = true;
    const unsigned before = with->read;
    with->read = words.ended ? 0 : before + 1;
    if (status != WO_OK || p->ended)
        return status;
    /* a process that has read other files may suffer from one of them */
    *again = before > 0;
    return explain(p, request, words.state, error);
}

static wo_status read_with_helper(const wo_child_request *request, passage *p, int file,
                                  wo_error *error)
{
    bool usable, again = true;
    wo_status status = WO_OK;
    for (int tries = 0; again && tries < 2; tries++) {
        helper with;
        wo_io_file_destroy(&p->file);
        p->ended = false;
        p->picture = request->promised;
        p->seconds = wo_child_wall_seconds(p->picture) + PATIENCE;
        WO_TRY(take_helper(&with, error));
        status = exchange(&with, request, p, file, &usable, &again, error);
        if (usable)
            give_helper(&with);
        else
            end_helper(&with);
    }
    return status;
}

static wo_child_request request_for(const char *path, const char *library, const char *extension)
{
    wo_child_request request = {.mark = WO_CHILD_MARK, .part = -1};
    pthread_mutex_lock(&pool.lock);
    request.files = pool.files;
    request.go_on = pool.go_on;
    pthread_mutex_unlock(&pool.lock);
    snprintf(request.library, sizeof request.library, "%s", library);
    for (size_t i = 0; extension[i] && i + 1 < sizeof request.extension; i++)
        request.extension[i] = (char)toupper((unsigned char)extension[i]);
    snprintf(request.shown, sizeof request.shown, "%s", wo_io_shown(path));
    return request;
}

/* A file of which no part can be read is refused for what the first says. */
static wo_status refuse_if_empty(const wo_io_file *file, wo_error *error)
{
    for (size_t i = 0; i < file->part_count; i++)
        if (!file->parts[i].fault)
            return WO_OK;
    return wo_fail(error, WO_ERR_FORMAT, "%s", file->parts[0].fault);
}

wo_status wo_io_read_apart(const char *path, int fd, const wo_io_format *format, bool headers_only,
                           uint64_t promised, wo_io_file **file, wo_error *error)
{
    passage p = {.path = path, .pipe = -1, .headers_only = headers_only};
    wo_child_request request = request_for(path, format->library_name, format->extension);
    request.headers_only = headers_only;
    request.promised = promised;
    wo_status status = read_with_helper(&request, &p, fd, error);
    if (status == WO_OK)
        status = refuse_if_empty(p.file, error);
    if (status == WO_OK)
        *file = p.file;
    else
        wo_io_file_destroy(&p.file);
    return status;
}

/* The other library's order of channels to ours. */
static wo_status take_part(const char *path, const wo_io_part *from, wo_io_part *part,
                           wo_error *error)
{
    const size_t stride = (size_t)part->channels;
    const size_t pixels =
        (size_t)wo_rect_width(part->data_window) * (size_t)wo_rect_height(part->data_window);
    if (from->channels != part->channels ||
        wo_rect_width(from->data_window) != wo_rect_width(part->data_window) ||
        wo_rect_height(from->data_window) != wo_rect_height(part->data_window))
        return wo_fail(error, WO_ERR_FORMAT, "%s: two libraries read its header differently",
                       wo_io_shown(path));
    for (size_t c = 0; c < stride; c++) {
        size_t k = 0;
        while (k < stride && strcmp(from->channel_names[k], part->channel_names[c]))
            k++;
        if (k == stride)
            return wo_fail(error, WO_ERR_FORMAT, "%s: two libraries name its channels differently",
                           wo_io_shown(path));
        for (size_t i = 0; i < pixels; i++)
            part->pixels[i * stride + c] = from->pixels[i * stride + k];
    }
    return WO_OK;
}

wo_status wo_io_exr_pixels_apart(const char *path, int fd, int part_index, wo_io_part *part,
                                 wo_error *error)
{
    passage p = {.path = path, .pipe = -1};
    wo_child_request request = request_for(path, "openexr", "exr");
    request.part = part_index;
    wo_status status = read_with_helper(&request, &p, fd, error);
    if (status == WO_OK)
        status = refuse_if_empty(p.file, error);
    if (status == WO_OK)
        status = take_part(path, &p.file->parts[0], part, error);
    wo_io_file_destroy(&p.file);
    return status;
}
