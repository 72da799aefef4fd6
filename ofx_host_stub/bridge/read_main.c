/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _GNU_SOURCE
#include "io_child_private.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* wideopen-read: decodes image files for a program that started it (io_child_private.h). Of no use
   by hand. */

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
/* Sanitizers reserve terabytes of addresses: their own limit of one allocation takes the place of
   the limit of memory. A wild access ends the process as it does without them. */
enum { HAS_MEMORY_LIMIT = 0 };
const char *__asan_default_options(void);
const char *__asan_default_options(void)
{
    return "allocator_may_return_null=1:max_allocation_size_mb=1024:detect_leaks=0:"
           "handle_segv=0:handle_sigbus=0:handle_sigfpe=0:handle_abort=0:abort_on_error=1";
}
#else
enum { HAS_MEMORY_LIMIT = 1 };
#endif

enum { LEAVE_NO_REQUEST = 3, MOST_IDLE_DEATHS = 3, MOST_FILES_OPEN = 64 };

/* What one process knows. */
typedef struct reading {
    wo_child_request request;
    int file, pipe;
    uint64_t file_bytes;
} reading;

static bool send_all(int pipe, const void *bytes, uint64_t size)
{
    const char *at = bytes;
    while (size > 0) {
        const ssize_t put = write(pipe, at, size < (1u << 30) ? (size_t)size : (size_t)1 << 30);
        if (put < 0 && errno == EINTR)
            continue;
        if (put <= 0)
            return false;
        at += put;
        size -= (uint64_t)put;
    }
    return true;
}

static wo_status send_record(const reading *r, wo_child_kind kind, uint32_t index,
                             const void *bytes, uint64_t size, wo_error *error)
{
    const wo_child_record record = {(uint32_t)kind, index, size};
    alarm(0); /* the other end takes its time */
    if (!send_all(r->pipe, &record, sizeof record) || !send_all(r->pipe, bytes, size))
        return wo_fail(error, WO_ERR_IO, "the program that asked is gone");
    return WO_OK;
}

/* Limits. */

static void set_limit(int which, uint64_t value)
{
    struct rlimit limit;
    if (getrlimit((__rlimit_resource_t)which, &limit))
        return;
    limit.rlim_cur =
        limit.rlim_max != RLIM_INFINITY && value > limit.rlim_max ? limit.rlim_max : (rlim_t)value;
    (void)setrlimit((__rlimit_resource_t)which, &limit);
}

static uint64_t addresses_in_use(void)
{
    unsigned long long pages = 0;
    FILE *const file = fopen("/proc/self/statm", "r");
    if (!file || fscanf(file, "%llu", &pages) != 1)
        pages = 0;
    if (file)
        fclose(file);
    return pages * (uint64_t)sysconf(_SC_PAGESIZE);
}

/* Processor time of this process so far, in seconds, rounded up. */
static unsigned seconds_used(void)
{
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage)
               ? 0
               : (unsigned)usage.ru_utime.tv_sec + (unsigned)usage.ru_stime.tv_sec + 2;
}

static void limit_for(const reading *r, uint64_t picture)
{
    if (HAS_MEMORY_LIMIT)
        set_limit(RLIMIT_AS, addresses_in_use() + wo_child_memory(picture, r->file_bytes));
    set_limit(RLIMIT_CPU, seconds_used() + wo_child_seconds(picture));
    alarm(wo_child_wall_seconds(picture));
}

/* What comes of the file. */

static uint64_t bytes_of(const wo_io_part *part)
{
    return (uint64_t)wo_rect_width(part->data_window) *
           (uint64_t)wo_rect_height(part->data_window) * (uint64_t)part->channels * sizeof(float);
}

static wo_status send_head(void *to, const wo_io_file *file, wo_error *error)
{
    const reading *const r = to;
    wo_wire wire = {NULL, 0, 0};
    uint64_t picture = 0;
    wo_status status = wo_wire_put_file(file, &wire, error);
    if (status == WO_OK && wire.used > WO_CHILD_MAX_HEAD)
        status = wo_fail(error, WO_ERR_RANGE, "%s: attributes of more than %d MiB",
                         r->request.shown, (int)(WO_CHILD_MAX_HEAD >> 20));
    if (status == WO_OK)
        status = send_record(r, WO_CHILD_HEAD, 0, wire.bytes, wire.used, error);
    free(wire.bytes);
    for (size_t i = 0; i < file->part_count; i++)
        picture += bytes_of(&file->parts[i]);
    limit_for(r, picture);
    return status;
}

static wo_status send_pixels(void *to, size_t index, const wo_io_part *part, wo_error *error)
{
    const reading *const r = to;
    WO_TRY(send_record(r, WO_CHILD_PIXELS, (uint32_t)index, part->pixels, bytes_of(part), error));
    alarm(wo_child_wall_seconds(bytes_of(part)));
    return WO_OK;
}

static wo_status send_fault(void *to, size_t index, const char *text, wo_error *error)
{
    return send_record(to, WO_CHILD_FAULT, (uint32_t)index, text, strlen(text), error);
}

/* False when the process should end. */
static bool serve(reading *r)
{
    struct stat about;
    char path[40];
    wo_error error = {0};
    const wo_child_sink sink = {send_head, send_pixels, send_fault, r};
    snprintf(path, sizeof path, "/proc/self/fd/%d", r->file);
    r->file_bytes = fstat(r->file, &about) ? 0 : (uint64_t)about.st_size;
    limit_for(r, r->request.promised);
    const wo_status status = wo_io_oiio_read(&r->request, path, r->file_bytes, &sink, &error);
    const bool sent = send_record(r, WO_CHILD_END, (uint32_t)status, error.text, strlen(error.text),
                                  NULL) == WO_OK;
    close(r->file);
    close(r->pipe);
    return sent && (status == WO_OK || r->request.go_on);
}

/* The socket. */

/* Waits for a request; false at the end of the other side, or for what is no request. */
static bool receive(reading *r)
{
    union {
        struct cmsghdr head;
        char bytes[CMSG_SPACE(2 * sizeof(int))];
    } control;
    struct iovec part = {&r->request, sizeof r->request};
    struct msghdr message = {.msg_iov = &part,
                             .msg_iovlen = 1,
                             .msg_control = &control,
                             .msg_controllen = sizeof control};
    ssize_t got;
    do
        got = recvmsg(WO_CHILD_SOCKET, &message, MSG_CMSG_CLOEXEC);
    while (got < 0 && errno == EINTR);
    const struct cmsghdr *const head = CMSG_FIRSTHDR(&message);
    if (got != (ssize_t)sizeof r->request || r->request.mark != WO_CHILD_MARK || !head ||
        head->cmsg_type != SCM_RIGHTS || head->cmsg_len != CMSG_LEN(2 * sizeof(int)))
        return false;
    int both[2];
    memcpy(both, CMSG_DATA(head), sizeof both);
    r->file = both[0];
    r->pipe = both[1];
    return true;
}

static void reply(bool ended, int state)
{
    const wo_child_reply words = {WO_CHILD_MARK, ended, state};
    while (send(WO_CHILD_SOCKET, &words, sizeof words, MSG_NOSIGNAL) < 0 && errno == EINTR)
        ;
}

/* A process reads so many files as the requests say. */
static int read_files(volatile int *busy)
{
    static reading r;
    (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (uint32_t files = 1;; files++) {
        if (!receive(&r))
            return LEAVE_NO_REQUEST;
        *busy = 1;
        if (!serve(&r) || files >= r.request.files)
            return 0;
        *busy = 0;
        reply(false, 0);
    }
}

int main(void)
{
    int kind = 0;
    socklen_t size = sizeof kind;
    if (getsockopt(WO_CHILD_SOCKET, SOL_SOCKET, SO_TYPE, &kind, &size) || kind != SOCK_SEQPACKET) {
        (void)fprintf(stderr, "%s reads image files for the programs of WideOpen\n",
                      WO_CHILD_PROGRAM);
        return 2;
    }
    int *const busy =
        mmap(NULL, sizeof *busy, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (busy == MAP_FAILED)
        return 1;
    set_limit(RLIMIT_CORE, 0);
    set_limit(RLIMIT_FSIZE, 0);
    set_limit(RLIMIT_NOFILE, MOST_FILES_OPEN);
    for (int deaths = 0; deaths < MOST_IDLE_DEATHS;) {
        int state = 0;
        *busy = 0;
        const pid_t child = fork();
        if (child < 0)
            return 1;
        if (child == 0)
            _exit(read_files(busy));
        while (waitpid(child, &state, 0) < 0 && errno == EINTR)
            ;
        if (WIFEXITED(state) && WEXITSTATUS(state) == LEAVE_NO_REQUEST)
            return 0;
        if (*busy)
            reply(true, state);
        else
            deaths++;
    }
    return 1;
}
