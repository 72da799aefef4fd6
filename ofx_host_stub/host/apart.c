/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "apart.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

enum {
    AT_ONCE = 4,      /* describers that run beside each other */
    RESTARTS = 50,    /* of one binary */
    BURIAL_MS = 2000, /* a killed process may take to vanish */
    WORDS_MAX = 400   /* of the last that was said on 1 and 2 */
};

/* A describer at work. */
typedef struct job {
    wo_host *host;
    wo_binary *binary; /* NULL = free */
    pid_t pid;
    int results, words; /* where it writes; -1 = closed */
    int first;
    int count; /* of plugins; -1 = not said yet */
    int at;    /* plugin it is at; -1 = it loads the binary */
    char name[200];
    bool ended;
    const char *killed; /* why, or NULL */
    bool gone;          /* its number may be another's by now */
    int restarts;
    int64_t silence, total; /* limits, in milliseconds of the clock */
    char line[WO_LINE_MAX];
    size_t line_used;
    char said[WORDS_MAX + 1];
    size_t said_used;
} job;

static int64_t now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static int64_t patience(const job *it)
{
    const double ms = it->host->config.describe_seconds * 1000;
    return ms < 1e9 ? (int64_t)ms + 1 : 1000000000;
}

/* A line among the binary's failures. One that is lost for lack of memory harms nobody. */
static void fail_line(job *it, const char *format, ...) WO_PRINTF(2, 3);
static void fail_line(job *it, const char *format, ...)
{
    char text[1024], clean[1024];
    va_list args;
    va_start(args, format);
    const int used = snprintf(text, sizeof text, "%.500s: ", it->binary->bundle);
    vsnprintf(text + used, sizeof text - (size_t)used, format, args);
    va_end(args);
    wo_line_clean(clean, sizeof clean, text);
    (void)wo_texts_add(&it->binary->catalogue.failures, clean);
}

/* ---------------------------------------------------------------------------------------- start */

/* A pipe whose ends are no standard descriptors and are not inherited. */
static bool make_pipe(int ends[2])
{
    int low[2];
    if (pipe(low) != 0)
        return false;
    for (int i = 0; i < 2; i++) {
        ends[i] = fcntl(low[i], F_DUPFD_CLOEXEC, 10);
        close(low[i]);
    }
    const int flags = fcntl(ends[0], F_GETFL);
    if (ends[0] >= 0 && ends[1] >= 0 && fcntl(ends[0], F_SETFL, flags | O_NONBLOCK) == 0)
        return true;
    for (int i = 0; i < 2; i++)
        if (ends[i] >= 0)
            close(ends[i]);
    return false;
}

static int spawn_with(const job *it, char **argv, int results, int words, pid_t *pid)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    if (posix_spawn_file_actions_init(&files) != 0)
        return ENOMEM;
    if (posix_spawnattr_init(&attributes) != 0) {
        posix_spawn_file_actions_destroy(&files);
        return ENOMEM;
    }
    int why = posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    why = why ? why : posix_spawn_file_actions_adddup2(&files, words, 1);
    why = why ? why : posix_spawn_file_actions_adddup2(&files, words, 2);
    why = why ? why : posix_spawn_file_actions_adddup2(&files, results, WO_APART_RESULTS);
    why = why ? why : posix_spawnattr_setpgroup(&attributes, 0);
    why = why ? why : posix_spawnattr_setsigmask(&attributes, &none);
    why = why ? why : posix_spawnattr_setsigdefault(&attributes, &all);
    why =
        why ? why
            : posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK |
                                                        POSIX_SPAWN_SETSIGDEF);
    why = why ? why
              : posix_spawn(pid, it->host->describer.items[0], &files, &attributes, argv, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return why;
}

static int spawn(job *it)
{
    enum { OWN = 4 };
    char first[16], parent[32];
    int results[2], words[2];
    const wo_texts *command = &it->host->describer;
    char **argv = calloc(command->count + OWN + 1, sizeof *argv);
    if (!argv)
        return ENOMEM;
    for (size_t i = 0; i < command->count; i++)
        argv[i] = command->items[i];
    snprintf(first, sizeof first, "%d", it->first);
    snprintf(parent, sizeof parent, "%ld", (long)getpid());
    char *own[OWN] = {it->binary->bundle, it->binary->path, first, parent};
    memcpy(argv + command->count, own, sizeof own);
    int why = make_pipe(results) ? 0 : errno;
    if (why == 0 && !make_pipe(words)) {
        why = errno;
        close(results[0]);
        close(results[1]);
    } else if (why == 0) {
        why = spawn_with(it, argv, results[1], words[1], &it->pid);
        close(results[1]);
        close(words[1]);
        it->results = results[0];
        it->words = words[0];
    }
    free(argv);
    return why;
}

static void close_end(int *end)
{
    if (*end >= 0)
        close(*end);
    *end = -1;
}

static void begin(job *it)
{
    it->results = it->words = -1;
    it->count = it->at = -1;
    it->name[0] = '\0';
    it->ended = false;
    it->killed = NULL;
    it->gone = false;
    it->line_used = it->said_used = 0;
    it->silence = now_ms() + patience(it);
    it->total = now_ms() + 10 * patience(it);
    const int why = spawn(it);
    if (why == 0)
        return;
    fail_line(it, "no process could be started that describes it: %s", strerror(why));
    close_end(&it->results);
    close_end(&it->words);
    it->binary = NULL;
}

static void kill_it(job *it, const char *why)
{
    if (it->killed)
        return;
    it->killed = why;
    if (it->gone)
        return;
    kill(-it->pid, SIGKILL);
    kill(it->pid, SIGKILL);
    it->silence = it->total = now_ms() + BURIAL_MS;
}

/* --------------------------------------------------------------------------------------- listen */

static bool take_line(job *it, char *line)
{
    int index = 0, used = 0;
    if (strcmp(line, "end") == 0)
        return it->ended = true;
    if (sscanf(line, "count\t%9d%n", &index, &used) == 1 && !line[used] && index > 0) {
        it->count = index;
        return true;
    }
    if (sscanf(line, "begin\t%9d%n", &index, &used) == 1 && index >= it->first &&
        index < it->count && (!line[used] || line[used] == '\t')) {
        it->at = index;
        wo_line_clean(it->name, sizeof it->name, line[used] ? line + used + 1 : "");
        return true;
    }
    return wo_catalogue_read(it->binary, line);
}

static bool take_results(job *it, const char *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (bytes[i] == '\0' || it->line_used + 1 >= sizeof it->line)
            return false;
        if (bytes[i] != '\n') {
            it->line[it->line_used++] = bytes[i];
            continue;
        }
        it->line[it->line_used] = '\0';
        it->line_used = 0;
        if (it->ended || !take_line(it, it->line))
            return false;
        it->silence = now_ms() + patience(it);
    }
    return true;
}

/* Keeps the end of what was said. */
static void take_words(job *it, const char *bytes, size_t count)
{
    if (count > WORDS_MAX) {
        bytes += count - WORDS_MAX;
        count = WORDS_MAX;
    }
    if (it->said_used + count > WORDS_MAX) {
        const size_t drop = it->said_used + count - WORDS_MAX;
        memmove(it->said, it->said + drop, it->said_used - drop);
        it->said_used -= drop;
    }
    memcpy(it->said + it->said_used, bytes, count);
    it->said_used += count;
}

/* Reads what there is, but no more at once than leaves time for the others. */
static void listen(job *it)
{
    char bytes[65536];
    for (int which = 0; which < 2; which++) {
        int *end = which == 0 ? &it->results : &it->words;
        const ssize_t got = *end < 0 ? -1 : read(*end, bytes, sizeof bytes);
        if (*end < 0 || (got < 0 && (errno == EAGAIN || errno == EINTR)))
            continue;
        if (got <= 0)
            close_end(end);
        else if (which == 1)
            take_words(it, bytes, (size_t)got);
        else if (!it->killed && !take_results(it, bytes, (size_t)got))
            kill_it(it, "its answer makes no sense");
    }
}

/* ------------------------------------------------------------------------------------------ end */

/* What the plugin was doing. */
static const char *doing(const job *it, char *text, size_t size)
{
    if (it->ended)
        snprintf(text, size, "it was unloaded");
    else if (it->at < 0)
        snprintf(text, size, "it was loaded");
    else if (it->name[0])
        snprintf(text, size, "%s described itself", it->name);
    else
        snprintf(text, size, "plugin %d was fetched", it->at);
    return text;
}

/* "; it said: LAST LINE", or nothing. */
static const char *last_words(job *it, char *text, size_t size)
{
    it->said[it->said_used] = '\0';
    for (size_t i = 0; i < it->said_used; i++)
        if (it->said[i] == '\0')
            it->said[i] = ' ';
    char *line = it->said + it->said_used;
    while (line > it->said && strchr(" \r\n\t", line[-1]))
        *--line = '\0';
    while (line > it->said && line[-1] != '\n')
        line--;
    snprintf(text, size, "%s%.200s", *line ? "; it said: " : "", line);
    return text;
}

static void write_failure(job *it, int status, bool known)
{
    char what[300], words[256];
    doing(it, what, sizeof what);
    last_words(it, words, sizeof words);
    if (it->killed)
        fail_line(it, "%s while %s%s", it->killed, what, words);
    else if (known && WIFSIGNALED(status))
        fail_line(it, "crashed (signal %d, %s) while %s%s", WTERMSIG(status),
                  strsignal(WTERMSIG(status)), what, words);
    else if (known && WIFEXITED(status))
        fail_line(it, "ended its process (code %d) while %s%s", WEXITSTATUS(status), what, words);
    else
        fail_line(it, "vanished while %s%s", what, words);
}

/* The process is gone. known: *status is what waitpid said. */
static void finish(job *it, int status, bool known)
{
    it->gone = true;
    for (int i = 0; i < 64 && (it->results >= 0 || it->words >= 0); i++)
        listen(it); /* what stands in the pipes yet */
    close_end(&it->results);
    close_end(&it->words);
    if (!it->ended || it->killed || (known && status != 0))
        write_failure(it, status, known);
    const int next = it->at + 1;
    const bool more = !it->ended && it->at >= it->first && next < it->count;
    if (!more || it->restarts >= RESTARTS) {
        if (more)
            fail_line(it, "the plugins behind number %d were not looked at", it->at);
        it->binary = NULL;
        return;
    }
    it->restarts++;
    it->first = next;
    begin(it);
}

static void look_after(job *it)
{
    siginfo_t gone = {.si_pid = 0};
    if (waitid(P_PID, (id_t)it->pid, &gone, WEXITED | WNOHANG | WNOWAIT) != 0 && errno == ECHILD) {
        finish(it, 0, false); /* somebody else has waited for it */
        return;
    }
    if (gone.si_pid == it->pid) {
        int status = 0;
        kill(-it->pid, SIGKILL); /* what it has started, too; its number is not given away yet */
        const bool known = waitpid(it->pid, &status, 0) == it->pid;
        finish(it, status, known);
        return;
    }
    const int64_t now = now_ms();
    if (now < it->silence && now < it->total)
        return;
    if (it->killed) {
        finish(it, 0, false); /* the system does not let go of it */
        return;
    }
    static const char *const texts[] = {"was killed after it had taken too long in all",
                                        "was killed after it had not answered in time"};
    kill_it(it, texts[now >= it->silence]);
}

/* Sleeps until there is something to read, or for a moment. */
static void wait_for_news(const job *jobs)
{
    struct pollfd ends[2 * AT_ONCE];
    nfds_t count = 0;
    bool closing = false;
    for (int i = 0; i < AT_ONCE; i++) {
        if (!jobs[i].binary)
            continue;
        if (jobs[i].results >= 0)
            ends[count++] = (struct pollfd){.fd = jobs[i].results, .events = POLLIN};
        else
            closing = true; /* it will be gone in a moment */
        if (jobs[i].words >= 0)
            ends[count++] = (struct pollfd){.fd = jobs[i].words, .events = POLLIN};
    }
    (void)poll(ends, count, closing ? 2 : 50);
}

wo_status wo_apart_describe(wo_host *host, wo_binary *const *binaries, size_t count,
                            wo_error *error)
{
    const wo_host_config *config = &host->config;
    size_t next = 0, running = 0;
    if (count == 0)
        return WO_OK;
    job *jobs = calloc(AT_ONCE, sizeof *jobs);
    if (!jobs)
        return wo_fail(error, WO_ERR_NOMEM, "no memory to describe plugins");
    bool stop = false;
    do {
        stop = stop || (config->aborted && config->aborted(config->user));
        running = 0;
        for (size_t i = 0; i < AT_ONCE; i++) {
            job *it = &jobs[i];
            if (!it->binary && next < count && !stop) {
                *it = (job){.host = host, .binary = binaries[next++]};
                begin(it);
            }
            running += it->binary != NULL;
            if (it->binary && stop) {
                it->restarts = RESTARTS;
                kill_it(it, "was stopped");
            }
        }
        wait_for_news(jobs);
        for (size_t i = 0; i < AT_ONCE; i++) {
            if (jobs[i].binary)
                listen(&jobs[i]);
            if (jobs[i].binary)
                look_after(&jobs[i]);
        }
    } while (running > 0 || (next < count && !stop));
    free(jobs);
    return stop ? wo_fail(error, WO_ABORTED, "stopped while plugins were looked at") : WO_OK;
}
